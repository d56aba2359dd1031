//! The equations that `derive` prints: every notation, and a text that reads back as the same expression.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev::model::{Loaded, ModelBuilder, Style};
use chetaev::symbolic::Expr;
use chetaev_tests::places::{gallery, root, scratch};
use chetaev_tests::program::{run, text};
use chetaev_tests::studied::loaded;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

fn derived(model: &Path, notation: &str) -> String {
    let finished = run(&["derive", text(model), "--as", notation]);
    assert_eq!(
        finished.status,
        Some(0),
        "{}: {}",
        model.display(),
        finished.both()
    );
    finished.out
}

/// `{` and `}`, `(` and `)`, … in pairs.
fn balanced(content: &str) -> bool {
    let mut open = Vec::new();
    for letter in content.chars() {
        match letter {
            '(' | '[' | '{' => open.push(letter),
            ')' | ']' | '}' => {
                let partner = open.pop();
                if !matches!(
                    (partner, letter),
                    (Some('('), ')') | (Some('['), ']') | (Some('{'), '}')
                ) {
                    return false;
                }
            }
            _ => {}
        }
    }
    open.is_empty()
}

#[test]
fn every_notation_is_printed_for_every_model() {
    for model in gallery() {
        let name = model.display();
        let plain = derived(&model, "text");
        assert!(
            plain.contains(" = ") && plain.contains("''"),
            "{name}\n{plain}"
        );
        let latex = derived(&model, "latex");
        assert!(
            latex.contains("\\ddot") && balanced(&latex),
            "{name}\n{latex}"
        );
        let sympy = derived(&model, "sympy");
        assert!(sympy.contains("Eq(") && balanced(&sympy), "{name}\n{sympy}");
        let mathml = derived(&model, "mathml");
        assert!(
            mathml.contains("<math") && nested(&mathml),
            "{name}\n{mathml}"
        );
    }
}

/// Bricard's linkage: five of its constraints demand what four do, at no position that is met by chance.
#[test]
fn a_linkage_that_is_overconstrained_is_derived_where_it_starts() {
    let model = root().join("gallery/bodies/bricard.toml");
    let finished = run(&["derive", text(&model)]);
    assert_eq!(finished.status, Some(0), "{}", finished.err);
    assert!(finished.both().contains("left out"), "{}", finished.err);
}

/// One root, and elements closed in the order opposite to that in which they were opened.
fn nested(markup: &str) -> bool {
    let mut open: Vec<&str> = Vec::new();
    let mut roots = 0;
    for tag in markup
        .split('<')
        .skip(1)
        .filter_map(|t| t.split('>').next())
    {
        if tag.starts_with('!') || tag.ends_with('/') {
            continue;
        }
        let name = tag
            .trim_start_matches('/')
            .split_whitespace()
            .next()
            .unwrap_or("");
        match tag.starts_with('/') {
            false => {
                roots += usize::from(open.is_empty());
                open.push(name);
            }
            true if open.pop() == Some(name) => {}
            true => return false,
        }
    }
    open.is_empty() && roots == 1
}

/// Sides of all equations in the JSON of a model.
fn sides(model: &Path) -> Vec<String> {
    let value: Value = serde_json::from_str(&derived(model, "json")).expect("JSON");
    let mut found = Vec::new();
    for formulation in value.as_array().expect("a list") {
        for group in formulation["groups"].as_array().expect("groups") {
            for equation in group["equations"].as_array().expect("equations") {
                found.extend(
                    ["left", "right"]
                        .iter()
                        .filter_map(|s| equation[s].as_str())
                        .map(str::to_owned),
                );
            }
        }
    }
    found
}

/// Parse(print(e)) = e, with what the program prints: reading a side and printing it gives the same handle when read again.
#[test]
fn printed_text_reads_back_as_the_same_expression() {
    let mut seen = 0;
    for path in gallery() {
        let Loaded {
            model: Some(model), ..
        } = loaded(&path, &[])
        else {
            panic!("{} is right", path.display());
        };
        for side in sides(&path) {
            // A solution of a linear system is printed with a list of what its names stand for, which is no expression.
            if side.contains("\nwhere\n") {
                continue;
            }
            let first = model
                .expression(&side)
                .unwrap_or_else(|d| panic!("{}: {}", path.display(), d.render(Style::Plain)));
            let printed = model.graph.text(first);
            // So are the quasi-velocities of a frame that is stated by its fields.
            if printed.contains("\nwhere\n") {
                continue;
            }
            let again: Expr = model
                .expression(&printed)
                .unwrap_or_else(|d| panic!("{}", d.render(Style::Plain)));
            assert_eq!(first, again, "{}: {side}", path.display());
            // Names that are definitions are read as what they stand for, and print as that; so are the derivatives of masses.
            let defined = [&model.quasi_velocities, &model.defines];
            if defined.iter().all(|names| names.is_empty()) && model.masses.is_empty() {
                assert_eq!(model.graph.text(first), side, "{}", path.display());
            }
            seen += 1;
        }
    }
    assert!(seen > 100, "{seen} sides were read");
}

/// The equations of the skate as anybody writes them down.
#[test]
fn the_skate_has_the_equations_of_the_books() {
    let skate = ModelBuilder::new("skate")
        .coordinates(["x", "y", "phi"])
        .parameter("m", "1")
        .parameter("J", "1")
        .lagrangian("1/2 m (x'^2 + y'^2) + 1/2 J phi'^2")
        .constraint("blade", "x' sin(phi) = y' cos(phi)");
    let folder = chetaev_tests::places::scratch("derive");
    let path = folder.join("skate.toml");
    std::fs::write(&path, skate.to_toml()).expect("a scratch file");
    let finished = run(&["derive", text(&path), "--formulation", "routh"]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    for equation in [
        "m x'' = lambda_blade sin(phi)",
        "m y'' = -lambda_blade cos(phi)",
        "J phi'' = 0",
    ] {
        assert!(
            finished.out.contains(equation),
            "{equation} is not in\n{}",
            finished.out
        );
    }
}

/// Titles of the groups of every formulation, with the number of their equations.
fn groups(model: &Path) -> Vec<(String, String, usize)> {
    let value: Value = serde_json::from_str(&derived(model, "json")).expect("JSON");
    let mut found = Vec::new();
    for formulation in value.as_array().expect("a list") {
        for group in formulation["groups"].as_array().expect("groups") {
            found.push((
                formulation["formulation"].as_str().expect("a name").into(),
                group["title"].as_str().expect("a title").into(),
                group["equations"].as_array().expect("equations").len(),
            ));
        }
    }
    found
}

/// What is wrong with a module, looked at line by line: every name is assigned before it is used, and no model name twice.
fn slips(module: &str) -> Vec<String> {
    let mut known: BTreeSet<&str> = BTreeSet::new();
    let mut declared: BTreeSet<&str> = BTreeSet::new();
    let mut found = Vec::new();
    for line in module.lines() {
        let code = line.trim_end();
        if code.is_empty() || code.starts_with('#') {
            continue;
        }
        if let Some(name) = code.strip_prefix("import sympy as ") {
            // Words of Python in the equations.
            known.extend([name, "evaluate", "False"]);
            continue;
        }
        let (target, value) = match code.split_once(" = ") {
            Some((target, value)) if !code.starts_with(' ') => (Some(target), value),
            _ => (None, code),
        };
        for word in words(value) {
            if !known.contains(word) {
                found.push(format!("`{word}` is not known in `{code}`"));
            }
        }
        if let Some(target) = target {
            let name = target.split('[').next().unwrap_or(target);
            let declares = value.starts_with("sp.Symbol(") || value.starts_with("sp.Function(");
            if declares && !declared.insert(name) {
                found.push(format!("`{name}` is declared twice"));
            }
            known.insert(name);
        }
    }
    found
}

/// Names that a piece of Python uses: no attributes, keywords of calls, strings or numbers.
fn words(code: &str) -> Vec<&str> {
    let outside = code.split('\'').step_by(2);
    let begins = |c: char| c.is_ascii_alphabetic() || c == '_';
    let mut found = Vec::new();
    for piece in outside {
        let mut rest = piece;
        while let Some(at) = rest.find(begins) {
            let attribute = rest[..at].ends_with('.');
            let tail = &rest[at..];
            let end = tail
                .find(|c: char| !c.is_ascii_alphanumeric() && c != '_')
                .unwrap_or(tail.len());
            let keyword = tail[end..].starts_with("=True");
            let constant = &tail[..end] == "True";
            if !attribute && !keyword && !constant {
                found.push(&tail[..end]);
            }
            rest = &tail[end..];
        }
    }
    found
}

#[test]
fn what_is_written_for_sympy_is_one_module_for_every_model() {
    for model in gallery() {
        let name = model.display();
        let module = derived(&model, "sympy");
        assert!(module.starts_with("import sympy as sp\n"), "{name}");
        assert_eq!(module.matches("import ").count(), 1, "{name}");
        assert!(balanced(&module), "{name}");
        assert_eq!(slips(&module), Vec::<String>::new(), "{name}\n{module}");
        for (formulation, title, count) in groups(&model) {
            assert_eq!(
                module.matches(&format!("\n{formulation} = {{}}\n")).count(),
                1,
                "{name}"
            );
            let head = format!("\n{formulation}['{title}'] = [");
            let (_, list) = module
                .split_once(&head)
                .unwrap_or_else(|| panic!("{name} has no {head}"));
            let list = list.split("\n]").next().unwrap_or(list);
            assert_eq!(
                list.lines()
                    .filter(|l| l.trim().starts_with("sp.Eq("))
                    .count(),
                count,
                "{name}: {title}"
            );
        }
    }
}

#[test]
fn the_slips_of_a_module_are_really_looked_for() {
    let good = "import sympy as sp\nm = sp.Symbol('m', real=True)\nrouth = {}\nrouth['a'] = [\n    sp.Eq(m, 0),\n]\n";
    assert_eq!(slips(good), Vec::<String>::new());
    assert!(!slips(&good.replace("sp.Eq(m", "sp.Eq(k")).is_empty());
    assert!(!slips(&good.replace("import sympy as sp\n", "")).is_empty());
    assert!(!slips(&good.replace("routh = {}\n", "m = sp.Symbol('m', real=True)\n")).is_empty());
}

/// Python names that the model would take, a control, quasi-velocities, and sums longer than Python's compiler bears.
#[test]
fn modules_with_awkward_names_and_long_sums_run() {
    let long: Vec<String> = (1..=300).map(|i| format!("sin({i} x)/{i}")).collect();
    let system = ModelBuilder::new("awkward")
        .coordinates(["x", "y", "lambda", "routh"])
        .parameter("sp", "1")
        .parameter("w_1", "2")
        .control("steer", "sin(t)")
        .lagrangian("1/2 sp (x'^2 + y'^2 + lambda'^2) + 1/2 w_1 routh'^2")
        .force("x", &format!("steer + {}", long.join(" + ")))
        .constraint("blade", "y' cos(routh) = x' sin(routh)")
        .quasi_velocity("u", "x' cos(routh) + y' sin(routh)")
        .quasi_velocity("w", "routh'")
        .quasi_velocity("z", "lambda'");
    let folder = chetaev_tests::places::scratch("derive-module");
    let path = folder.join("model.toml");
    std::fs::write(&path, system.to_toml()).expect("a scratch file");
    let module = derived(&path, "sympy");
    assert_eq!(slips(&module), Vec::<String>::new(), "{module}");
    assert!(
        module.contains("steer = sp.Function('steer', real=True)(t)\n"),
        "{module}"
    );
    assert!(
        module.contains("routh_ = sp.Function('routh', real=True)(t)\n"),
        "{module}"
    );
    assert!(module.contains("sp.Add("), "{module}");
    std::fs::write(folder.join("equations.py"), &module).expect("a scratch file");
    let check = "import sympy as sp, equations as e\n\
        assert all(isinstance(q, (sp.Eq, sp.logic.boolalg.BooleanAtom)) for d in (e.routh, e.maggi) for l in d.values() for q in l)\n\
        x, r, l = e.x, e.routh_, e.lambda_blade\n\
        q = e.routh['equations of motion'][0]\n\
        s = e.steer + sum(sp.sin(i*x)/i for i in range(1, 301))\n\
        rest = e.sp_*x.diff(e.t, 2) - s + l*sp.sin(r)\n\
        d = (q.lhs - q.rhs).subs({l: 2, r: 1, e.steer: 5}).subs(x, 3).doit() - rest.subs({l: 2, r: 1, e.steer: 5}).subs(x, 3).doit()\n\
        d2 = (q.lhs - q.rhs).subs({l: 2, r: 1, e.steer: 5}).subs(x, 3).doit() + rest.subs({l: 2, r: 1, e.steer: 5}).subs(x, 3).doit()\n\
        assert min(abs(sp.N(d)), abs(sp.N(d2))) < 1e-9, (d, d2)\n";
    let python = std::process::Command::new("python3")
        .args(["-c", "import sympy"])
        .output();
    // The structure is tested above; where there is no SymPy, it cannot be run.
    if !python.is_ok_and(|p| p.status.success()) {
        return;
    }
    let ran = std::process::Command::new("python3")
        .args(["-c", check])
        .current_dir(&folder)
        .output()
        .expect("python3 runs");
    assert!(
        ran.status.success(),
        "{}\n{module}",
        String::from_utf8_lossy(&ran.stderr)
    );
}

fn runs(command: &str) -> bool {
    let asked = std::process::Command::new(command)
        .arg("--version")
        .output();
    asked.is_ok_and(|p| p.status.success())
}

fn json_of(arguments: &[&str]) -> Value {
    let finished = run(arguments);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    finished.json()
}

#[test]
fn data_have_general_forms_objects_and_the_state() {
    let model = "gallery/particle-y-dx/model.toml";
    let list = json_of(&[
        "derive",
        model,
        "--formulation",
        "canonical",
        "--formulation",
        "voronets",
        "--as",
        "json",
    ]);
    let (canonical, voronets) = (&list[0], &list[1]);
    assert_eq!(canonical["formulation"], "canonical");
    assert_eq!(canonical["state"], serde_json::json!(["p_x", "p_y", "p_z"]));
    assert_eq!(voronets["state"], serde_json::json!(["x'", "y'"]));
    for one in [canonical, voronets] {
        let form = one["groups"][0]["general_form"].as_str().unwrap_or("");
        assert!(form.contains(" = ") && form.contains('∂'), "{form}");
        assert!(one["requires"].as_array().is_some_and(|l| !l.is_empty()));
        assert!(one["sources"][0]["key"].is_string(), "{one}");
        for object in one["objects"].as_array().expect("objects") {
            for field in ["name", "value", "latex", "meaning"] {
                assert!(
                    object[field].as_str().is_some_and(|s| !s.is_empty()),
                    "{object}"
                );
            }
        }
    }
    let names: Vec<&str> = voronets["objects"]
        .as_array()
        .expect("objects")
        .iter()
        .filter_map(|o| o["name"].as_str())
        .collect();
    assert_eq!(names, ["Lstar", "theta_z", "A_z_x", "A_z_y"]);
}

#[test]
fn all_formulations_of_a_model_are_one_python_module() {
    let python = runs("python3");
    for file in ["chaplygin-sleigh", "appell-hamel"] {
        let model = format!("gallery/{file}/model.toml");
        let finished = run(&["derive", &model, "--all", "--as", "sympy"]);
        assert_eq!(finished.status, Some(0), "{}", finished.both());
        let module = finished.out;
        assert!(balanced(&module), "{file}");
        assert_eq!(slips(&module), Vec::<String>::new(), "{file}");
        for name in [
            "routh",
            "canonical_reduced",
            "vakonomic",
            "volterra_second",
            "jacobi",
        ] {
            assert_eq!(
                module.matches(&format!("\n{name} = {{}}\n")).count(),
                1,
                "{file}: {name}"
            );
        }
        if python {
            let folder = chetaev_tests::places::scratch(&format!("derive-all-{file}"));
            std::fs::write(folder.join("equations.py"), &module).expect("a scratch file");
            let compiled = std::process::Command::new("python3")
                .args(["-m", "py_compile", "equations.py"])
                .current_dir(&folder)
                .output()
                .expect("python3 runs");
            assert!(
                compiled.status.success(),
                "{file}: {}",
                String::from_utf8_lossy(&compiled.stderr)
            );
        }
    }
}

fn compared(model: &str, a: &str, b: &str) -> String {
    let finished = run(&["derive", model, "--compare", a, b]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    finished.out
}

#[test]
fn comparisons_say_why_differences_vanish() {
    let particle = "gallery/particle-y-dx/model.toml";
    let text = compared(particle, "volterra-first", "maggi");
    assert_eq!(text.matches("proved equal").count(), 2, "{text}");
    assert!(text.contains("accelerations free"), "{text}");
    assert!(!text.contains("vanishes only"), "{text}");
    // Voronets's form has the constraints in it, and Routh's has not.
    let text = compared("gallery/chaplygin-sleigh/model.toml", "routh", "voronets");
    assert!(
        text.contains("proved equal on the constraint manifold"),
        "{text}"
    );
    assert!(text.contains("different unknowns"), "{text}");
    assert!(
        text.contains("vanishes only where the constraints hold"),
        "{text}"
    );
    // The extremals of the particle are other curves.
    let text = compared(particle, "routh", "vakonomic");
    assert!(
        text.contains("kappa_rolling") && text.contains("refuted"),
        "{text}"
    );
}

#[test]
fn what_does_not_apply_says_which_requirement_fails() {
    let model = "gallery/isokinetic-particle/model.toml";
    let finished = run(&["derive", model, "--all"]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let refusals: Vec<&str> = finished
        .out
        .lines()
        .filter(|l| l.contains("does not apply"))
        .collect();
    let expected = [
        ("newton-euler", "model.bodies", "no bodies"),
        (
            "volterra-first-cartesian",
            "model.particles",
            "no particles",
        ),
        (
            "volterra-second-cartesian",
            "model.particles",
            "no particles",
        ),
        // p·v = m v·v is constant on v·v = c², so the restricted Lagrangian has no velocities (theory of the reduced form).
        (
            "canonical-reduced",
            "model.restricted-hessian-regular",
            "vanishes identically",
        ),
        (
            "jacobi",
            "model.constraints-homogeneous",
            "does not vanish: it is",
        ),
    ];
    assert_eq!(refusals.len(), expected.len(), "{refusals:?}");
    for (refusal, (name, hypothesis, evidence)) in refusals.iter().zip(expected) {
        for word in [name, hypothesis, evidence] {
            assert!(refusal.contains(word), "no `{word}` in {refusal}");
        }
    }
    for (name, hypothesis, _) in expected {
        let finished = run(&["derive", model, "--formulation", name]);
        assert_eq!(finished.status, Some(2), "{}", finished.both());
        assert!(finished.err.contains(hypothesis), "{}", finished.err);
        assert!(finished.out.is_empty(), "{}", finished.out);
    }
    let skipped = json_of(&["derive", model, "--all", "--as", "json"]);
    let skipped = skipped.as_array().expect("a list");
    let count = skipped
        .iter()
        .filter(|f| f["not_derived"].is_string())
        .count();
    assert_eq!(count, expected.len());
    for arguments in [
        ["--formulation", "canonicl"].as_slice(),
        &["--compare", "routh", "canonicl"],
    ] {
        let finished = run(&[&["derive", model], arguments].concat());
        assert_eq!(finished.status, Some(2), "{}", finished.both());
        assert!(finished.err.contains("'canonical'"), "{}", finished.err);
    }
}

/// The extremum asks for its own matrix only. By hand for L = −x²/2 and f = y' − x'²/2, whose W is zero: ∂L/∂x = −x,
/// ∂f/∂x' = −x', ∂f/∂y' = 1, so that x = κ x'' + κ' x' and 0 = −κ'.
#[test]
fn an_extremum_is_derived_where_the_motion_is_not_determined() {
    let folder = chetaev_tests::places::scratch("derive-extremum");
    let path = folder.join("model.toml");
    let model = "coordinates = [\"x\", \"y\"]\nlagrangian = { L = \"-x^2/2\" }\nconstraints = [\"y' = x'^2/2\"]\n";
    std::fs::write(&path, model).expect("a scratch file");
    let finished = run(&["derive", text(&path), "--formulation", "vakonomic"]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    for line in ["x = kappa_1 x'' + x' kappa_1'", "0 = -kappa_1'"] {
        assert!(
            finished.out.lines().any(|l| l == line),
            "{line}\n{}",
            finished.out
        );
    }
    let finished = run(&["derive", text(&path), "--formulation", "maggi"]);
    assert!(
        finished.both().contains("model.accelerations-unique"),
        "{}",
        finished.both()
    );
}

#[test]
fn a_comparison_takes_no_notation() {
    let particle = "gallery/particle-y-dx/model.toml";
    let finished = run(&[
        "derive",
        particle,
        "--compare",
        "maggi",
        "voronets",
        "--as",
        "json",
    ]);
    assert_eq!(finished.status, Some(2), "{}", finished.both());
    assert!(finished.err.contains("--compare"), "{}", finished.err);
}

/// Steps are written as text and as a document of LaTeX; other notations, and formulations without steps, are refused with what there is.
#[test]
fn derivations_are_written_step_by_step() {
    let sleigh = root().join("gallery/chaplygin-sleigh/model.toml");
    let steps = |arguments: &[&str]| {
        let mut words = vec!["derive", text(&sleigh), "--steps"];
        words.extend(arguments);
        run(&words)
    };
    let plain = steps(&[]);
    assert_eq!(plain.status, Some(0), "{}", plain.both());
    for line in [
        "     C_w = -m a u w",
        "     u' = a w^2",
        "     lambda_blade = m J u w/(J + m a^2)",
    ] {
        assert!(
            plain.out.lines().any(|own| own == line),
            "{line}\n{}",
            plain.out
        );
    }
    let latex = steps(&["--as", "latex", "--formulation", "maggi"]);
    assert_eq!(latex.status, Some(0), "{}", latex.both());
    assert!(is_a_document(&latex.out), "{}", latex.out);
    let other = steps(&["--as", "json"]);
    assert!(other.status != Some(0) && other.both().contains("--as latex"));
    let none = steps(&["--formulation", "gauss"]);
    assert!(none.both().contains("`reduced`"), "{}", none.both());
}

/// Environments are closed in the order opposite to that in which they were opened, braces are in pairs, and every line of an
/// alignment has one place to align at.
fn is_a_document(latex: &str) -> bool {
    let mut open = Vec::new();
    for part in latex.split('\\').skip(1) {
        if let Some(rest) = part.strip_prefix("begin{") {
            open.push(rest.split('}').next());
        } else if let Some(rest) = part.strip_prefix("end{") {
            if open.pop() != Some(rest.split('}').next()) {
                return false;
            }
        }
    }
    let aligned = latex.split("\\begin{align}\n").skip(1);
    let mut aligned = aligned.filter_map(|rest| rest.split("\n\\end{align}").next());
    let is_aligned = aligned.all(|lines| lines.split("\\\\\n").all(|line| line.contains('&')));
    open.is_empty()
        && balanced(latex)
        && is_aligned
        && latex.starts_with("\\documentclass")
        && latex.trim_end().ends_with("\\end{document}")
}

/// A symbol that the model states stands in the equations and in the table of symbols, with its unit and what it is.
#[test]
fn symbols_of_the_model_are_typeset() {
    let folder = scratch("symbols");
    let path = folder.join("model.toml");
    let model = "coordinates = { theta = { unit = \"rad\", description = \"angle\" } }\n[parameters]\nm = { value = 1, unit = \"kg\", latex = 'm_{\\mathrm{bob}}', description = \"mass\" }\nlam = { value = 2, unit = \"N m/rad\" }\nrR = { value = 1, unit = \"m\" }\n[lagrangian]\nT = \"1/2 m rR^2 theta'^2\"\nV = \"1/2 lam theta^2\"\n";
    std::fs::write(&path, model).expect("a scratch folder");
    let latex = derived(&path, "latex");
    assert!(is_a_document(&latex), "{latex}");
    for own in [
        "m_{\\mathrm{bob}} r_R^2 \\ddot{\\theta}",
        "\\lambda \\theta",
        "$m_{\\mathrm{bob}}$ & \\texttt{m} & parameter: mass & $\\mathrm{kg}$",
        "$\\theta$ & \\texttt{theta} & coordinate: angle & $\\mathrm{rad}$",
    ] {
        assert!(latex.contains(own), "{own}\n{latex}");
    }
}

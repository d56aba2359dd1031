//! Models that must be refused because of their text, after the section "Rejections" of the published reference cases.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev_model::{load, Loaded, NoFiles, Severity, Style};

fn read(text: &str) -> Loaded {
    load("model.toml", text, &NoFiles, &[])
}

/// The model is refused, and the message a person reads contains each of the words.
fn refused(text: &str, words: &[&str]) -> String {
    let loaded = read(text);
    assert!(loaded.model.is_none(), "accepted: {text}");
    let message = loaded.diagnostics.render(Style::Plain);
    for word in words {
        assert!(
            word.split('|').any(|word| message.contains(word)),
            "{word} is missing in\n{message}"
        );
    }
    message
}

#[test]
fn unknown_symbol() {
    let message = refused(
        "coordinates = [\"x\", \"theta\"]\nparameters = { m = 1, R = 0.5 }\n[lagrangian]\nL = \"m*(x'^2 + R^2*thta'^2)/2\"\n",
        &["thta", "did you mean `theta`?", "model.toml:4:20"],
    );
    // The offending text is underlined: four letters, not five with the prime.
    assert!(
        message.contains("                    ^^^^ not defined"),
        "{message}"
    );
}

#[test]
fn derivative_of_parameter() {
    refused(
        "coordinates = [\"x\"]\nparameters = { m = 1 }\n[lagrangian]\nL = \"m'*x'^2/2\"",
        &["`m` is a parameter", "4:6"],
    );
}

#[test]
fn wrong_arity() {
    refused(
        "coordinates = [\"x\"]\nparameters = { m = 1 }\nlagrangian = \"m*x'^2/2 - sin(x, 2)\"",
        &["`sin` takes one argument, not 2"],
    );
}

#[test]
fn unbalanced_parenthesis() {
    refused(
        "coordinates = [\"x\"]\nparameters = { m = 1 }\nlagrangian = \"m*(x'^2/2 - cos(x)\"",
        &["parenthes", "add `)`", "3:17"],
    );
}

#[test]
fn circular_definition() {
    let message = refused(
        "coordinates = [\"x\"]\nparameters = { m = 1 }\nlagrangian = \"m*x'^2/2 - u\"\n[define]\nu = \"v + x\"\nv = \"u - x\"",
        &["`u` and `v` need each other"],
    );
    assert!(
        message.ends_with("1 error"),
        "the circle is reported once: {message}"
    );
    refused(
        "coordinates = [\"x\"]\nlagrangian = \"x'^2\"\n[define]\nu = \"2 u\"",
        &["`u` needs `u` itself"],
    );
    refused("coordinates = [\"x\"]\nlagrangian = \"x'^2\"\n[parameters]\na = \"b\"\nb = \"c + 1\"\nc = \"a\"", &["`a`, `b` and `c`"]);
}

#[test]
fn reserved_parameter_name() {
    refused(
        "coordinates = [\"x\"]\nparameters = { m = 1, t = 3 }\nlagrangian = \"m*x'^2/2\"",
        &["`t` is the time", "2:23"],
    );
    refused(
        "coordinates = [\"x\"]\nparameters = { sin = 1 }\nlagrangian = \"x'^2\"",
        &["`sin` is a function"],
    );
    refused(
        "coordinates = [\"lambda_a\"]\nlagrangian = \"1\"",
        &["lambda_"],
    );
    refused(
        "coordinates = [\"x\", \"x\"]\nlagrangian = \"x'^2\"",
        &["`x` is a coordinate already"],
    );
}

#[test]
fn constraint_without_coordinate() {
    let model = |equation: &str| {
        format!("coordinates = [\"x\"]\nparameters = {{ m = 1 }}\nlagrangian = \"x'^2\"\nconstraints = {{ rod = \"{equation}\" }}")
    };
    refused(
        &model("m = 2"),
        &["no coordinate occurs in the constraint `rod`"],
    );
    refused(&model("x' = x'"), &["both sides are the same"]);
    refused(&model("x'"), &["left = right"]);
}

#[test]
fn all_errors_are_reported_at_once() {
    let text = r#"
cordinates = ["x"]
coordinates = ["x", "y"]
[parameters]
m = "1 + "
t = 2
[lagrangian]
T = "m*x''^2 + sin(x, 2)"
V = "g y"
[constraints]
one = "x' = z'"
two = "x' + (y'"
[initial]
q = 1
x = "y"
[simulation]
t_end = "x"
methd = "rk"
"#;
    let loaded = read(text);
    let lines: Vec<usize> = loaded
        .diagnostics
        .to_data()
        .iter()
        .filter(|d| d.severity == Severity::Error.word())
        .map(|d| d.at.line)
        .collect();
    assert_eq!(
        lines,
        [2, 5, 6, 8, 8, 9, 11, 12, 14, 15, 17, 18],
        "{}",
        loaded.diagnostics
    );
}

#[test]
fn a_suggestion_carried_out_gives_a_model() {
    let text = "coordinates = [\"x\", \"theta\"]\nlagrangian = \"x'^2 + thta'^2\"\n";
    let data = read(text).diagnostics.to_data();
    let suggestion = data[0].suggestion.clone().unwrap();
    let mut fixed = text.to_owned();
    fixed.replace_range(
        suggestion.at.start..suggestion.at.end,
        &suggestion.replacement,
    );
    assert!(read(&fixed).model.is_some(), "{fixed}");
}

/// Wrong models of the gallery that this crate refuses: the first line says what the message contains.
#[test]
fn wrong_particles_and_frames_of_the_gallery() {
    for text in [
        include_str!("../../../../gallery/wrong/massless-particle.toml"),
        include_str!("../../../../gallery/wrong/two-thrusts.toml"),
        include_str!("../../../../gallery/wrong/mass-without-start.toml"),
        include_str!("../../../../gallery/wrong/velocity-in-position.toml"),
        include_str!("../../../../gallery/wrong/incomplete-frame.toml"),
        include_str!("../../../../gallery/wrong/dependent-fields.toml"),
    ] {
        let first = text.lines().next().unwrap();
        let words = first
            .strip_prefix("# expect: exit 2; message contains: ")
            .unwrap();
        let message = refused(text, &words.split(", ").collect::<Vec<_>>());
        assert!(message.ends_with("1 error"), "{message}");
    }
}

#[test]
fn the_degree_of_a_search() {
    let text = |degree: &str| {
        let head = "coordinates = [\"x\"]\nlagrangian = \"x'^2/2\"\n[search]\n";
        format!("{head}degree = {degree}\n")
    };
    for degree in ["1", "7", "-3"] {
        refused(
            &text(degree),
            &["`degree` must be a number from 2 to 6", "4:10"],
        );
    }
    refused(&text("2.5"), &["`degree` must be an integer"]);
    refused(
        &text("3\ndegre = 3"),
        &["`degre` is no key of [search]", "did you mean `degree`?"],
    );
    let model = read(&text("3")).model.expect("a degree in range");
    assert_eq!(model.search_degree, Some(3));
}

/// The function of an event that never changes has no zeros to be met; one that is constant on pieces has.
#[test]
fn events_that_cannot_happen() {
    let text = |when: &str| {
        format!(
            "coordinates = [\"x\", \"y\"]\nlagrangian = \"(x'^2 + y'^2)/2\"\n[parameters]\nk = 1\n[events.e]\nwhen = \"{when}\"\n"
        )
    };
    for when in [
        "1",
        "cos(x)^2 + sin(x)^2 - 1",
        "cos(x)^2 + sin(x)^2 - 2",
        "(x' + y')^2 - x'^2 - 2 x' y' - y'^2",
        "k (cosh(t)^2 - sinh(t)^2) - k^2",
        "k - 1",
    ] {
        refused(&text(when), &["zero never or always", "model.toml:6:"]);
    }
    for when in [
        "sign(x) - 1",
        "abs(x) - x",
        "cos(x)^2 - sin(x)^2",
        "k x",
        "t - 1",
        "atan(x) + atan(1/x) - 1",
    ] {
        let loaded = read(&text(when));
        assert!(loaded.model.is_some(), "{when}: {}", loaded.diagnostics);
    }
}

#[test]
fn an_unknown_version_of_the_format_is_refused_at_its_place() {
    let model = "coordinates = [\"x\"]\nlagrangian = \"x'^2/2\"\n";
    for accepted in ["", "chetaev = \"1\"\n", "chetaev = 1\n"] {
        assert!(
            read(&format!("{accepted}{model}")).model.is_some(),
            "{accepted}"
        );
    }
    let later = format!("chetaev = \"2\"\n{model}");
    refused(
        &later,
        &[
            "`2` is not a version",
            "model.toml:1:11",
            "read as version 1",
        ],
    );
    let wrong = format!("chetaev = [1]\n{model}");
    refused(
        &wrong,
        &["must be a version", "not an array", "model.toml:1:11"],
    );
    // An included file of another version is refused at its own place.
    let files = std::collections::BTreeMap::from([("base.toml".to_owned(), later)]);
    let loaded = load("model.toml", "include = \"base.toml\"\n", &files, &[]);
    assert!(loaded.model.is_none());
    let message = loaded.diagnostics.render(Style::Plain);
    assert!(message.contains("base.toml:1:11"), "{message}");
}

/// What `check` offers to write in place of a text, carried out; none where nothing is offered.
fn carried_out(text: &str) -> Vec<String> {
    let loaded = read(text);
    let offered = loaded
        .diagnostics
        .list
        .iter()
        .filter_map(|d| d.suggestion.as_ref());
    offered
        .map(|own| {
            let span = own.place.span;
            format!(
                "{}{}{}",
                &text[..span.start],
                own.replacement,
                &text[span.end..]
            )
        })
        .collect()
}

fn with_energy(kinetic: &str, potential: &str) -> String {
    format!("coordinates = [\"x\", \"theta\"]\nparameters = {{ m = 1, l = 2, g = 9, k = 3 }}\n[lagrangian]\nT = \"{kinetic} + 1/2 m l^2 theta'^2\"\nV = \"{potential}\"\n")
}

/// Derivatives as other programs write them: what is offered is read, and is the derivative.
#[test]
fn derivatives_of_other_programs_are_offered_as_primes() {
    let right = read(&with_energy("1/2 m x'^2", "0")).model.unwrap();
    for written in [
        "1/2 m (dx/dt)^2",
        "1/2 m xdot^2",
        "1/2 m x_dot^2",
        "1/2 m diff(x, t)^2",
        "1/2 m Derivative(x, t)^2",
        "1/2 m x'(t)^2",
    ] {
        let offered = carried_out(&with_energy(written, "0"));
        assert_eq!(offered.len(), 1, "{written}: {offered:?}");
        let loaded = read(&offered[0]);
        let model = loaded
            .model
            .unwrap_or_else(|| panic!("{written}: {}", loaded.diagnostics));
        let text = |model: &chetaev_model::Model| model.graph.text(model.lagrangian);
        assert_eq!(text(&model), text(&right), "{written}");
    }
    // What is differentiated in dx/dt^2 is not said, and nothing is offered.
    assert_eq!(
        carried_out(&with_energy("1/2 m dx/dt^2", "0")),
        Vec::<String>::new()
    );
}

/// What is not available is refused with a way round, and no suggestion that would be read as something else.
#[test]
fn what_other_languages_have_is_refused_with_a_way_round() {
    for (potential, words) in [
        (
            "if x > 0 then x else 0",
            ["join the cases smoothly", "[events]"],
        ),
        ("x > 0 ? x : 0", ["join the cases smoothly", "[events]"]),
        ("min(1, x)", ["sqrt((a - b)^2 + eps^2)", "[events]"]),
        ("if(x > 0, x, 0)", ["tanh", "[events]"]),
        ("sat(x)", ["L tanh(x/L)", "saturation"]),
        ("interp(x)", ["there are no tables", "formula"]),
        ("x % 2", ["jumps", "not available"]),
        ("k |x|", ["abs(x)", "absolute"]),
        ("np.sin(x)", ["write sin(x)", "by themselves"]),
    ] {
        let text = with_energy("1/2 m x'^2", potential);
        refused(&text, &words);
        assert_eq!(carried_out(&text), Vec::<String>::new(), "{potential}");
    }
    for (potential, right) in [("½ k x^2", "1/2 k x^2"), ("k sin x", "k sin(x)")] {
        let offered = carried_out(&with_energy("1/2 m x'^2", potential));
        let expected = read(&with_energy("1/2 m x'^2", right)).model.unwrap();
        let model = read(&offered[0]).model.unwrap();
        assert_eq!(
            model.graph.text(model.lagrangian),
            expected.graph.text(expected.lagrangian)
        );
    }
    let comma = with_energy("1/2 m x'^2", "0").replace(
        "parameters = { m = 1, l = 2, g = 9, k = 3 }",
        "[parameters]\nl = 2\nm = 1,5",
    );
    let offered = carried_out(&comma);
    assert!(
        offered[0].ends_with(&comma[comma.find(",5").unwrap() + 2..])
            && offered[0].contains("m = 1.5")
    );
    let table = "coordinates = [\"x\"]\nparameters = { k = [[0, 1]] }\nlagrangian = \"k x'^2\"\n";
    refused(table, &["there are no tables of numbers"]);
}

/// Angles may be in degrees; other units stand beside their number.
#[test]
fn degrees_are_numbers() {
    let start = |value: &str| {
        let text = format!(
            "coordinates = [\"x\"]\nlagrangian = \"x'^2/2 - cos(x)\"\n[initial]\nx = \"{value}\"\n"
        );
        let model = read(&text)
            .model
            .unwrap_or_else(|| panic!("{}", read(&text).diagnostics));
        let given = model.initial.values.values().next().unwrap().value;
        model.graph.text(given)
    };
    assert_eq!(start("30 deg"), start("pi/6"));
    assert_eq!(start("2*15 degrees + 0"), start("pi/6"));
    let twice = "coordinates = [\"x\"]\n[parameters]\na = { value = \"30 deg\", unit = \"deg\" }\n[lagrangian]\nL = \"x'^2/2 - cos(x - a)\"\n";
    refused(twice, &["its unit is stated as `deg`"]);
    // A name of the model is what it says.
    let named = "coordinates = [\"x\"]\nparameters = { deg = 2 }\nlagrangian = \"deg x'^2/2\"\n";
    let model = read(named).model.unwrap();
    assert!(model.graph.text(model.lagrangian).contains("deg"));
}

#[test]
fn numbers_have_units() {
    let mass = |value: &str| {
        let text = format!(
            "coordinates = [\"x\"]\nparameters = {{ m = {value}, k = 2 }}\nlagrangian = \"m x'^2/2 - k x^2\"\n"
        );
        let model = read(&text)
            .model
            .unwrap_or_else(|| panic!("{}", read(&text).diagnostics));
        let own = model.parameters.iter().find(|own| own.name == "m").unwrap();
        let unit = own.unit.as_ref().map(|unit| unit.dimension.to_string());
        (model.graph.text(own.value.unwrap()), unit)
    };
    let kilograms = |text: &str| (text.to_owned(), Some("kg".to_owned()));
    assert_eq!(mass("\"8 kg\""), kilograms("8"));
    assert_eq!(mass("\"250 g\""), kilograms("1/4"));
    assert_eq!(
        mass("{ value = \"250 g\", unit = \"kg\" }"),
        kilograms("1/4")
    );
    // A name of the model is what it says.
    assert_eq!(mass("\"8 k\"").0, "16");
    refused(
        "coordinates = [\"x\"]\nparameters = { m = { value = \"8 s\", unit = \"kg\" } }\nlagrangian = \"m x'^2/2\"\n",
        &["in `s`", "stated as `kg`"],
    );
    // In a formula a number has no unit, and where to state one is said.
    let weight = "coordinates = [\"x\"]\nparameters = { k = 1 }\nlagrangian = \"k x'^2/2\"\n[initial]\nx = \"1 kg\"\n";
    refused(
        weight,
        &["state the unit beside the number", "unit = \"kg\""],
    );
    assert_eq!(carried_out(weight), Vec::<String>::new());
}

#[test]
fn symbols_in_latex_are_read_or_refused() {
    let with = |latex: &str| {
        format!("coordinates = [\"x\"]\n[parameters]\nm = {{ value = 1, latex = '{latex}' }}\n[lagrangian]\nL = \"m x'^2/2\"\n")
    };
    let model = read(&with(r"\hat m_{\mathrm{p}}")).model.unwrap();
    assert_eq!(model.symbols["m"], r"\hat m_{\mathrm{p}}");
    refused(
        &with(r"\input{x}"),
        &["cannot be typeset", "input", "model.toml:3:26"],
    );
    refused(&with("x_"), &["cannot be typeset"]);
}

//! What the model file says and what it is read as.
#![allow(clippy::unwrap_used)] // a panic is how a test fails

use std::collections::BTreeMap;

use chetaev_model::{load, reload, Loaded, Model, NoFiles, Relation};
use chetaev_symbolic::{Expr, Rational};

const SLEIGH: &str = include_str!("../../../../gallery/chaplygin-sleigh/model.toml");

fn model(text: &str) -> Model {
    accept(load("model.toml", text, &NoFiles, &[]))
}

fn accept(loaded: Loaded) -> Model {
    loaded
        .into_result()
        .map(|(model, _)| model)
        .unwrap_or_else(|diagnostics| panic!("{diagnostics}"))
}

fn number(text: &str) -> Rational {
    chetaev_symbolic::syntax::lexer::exact_number(text).unwrap()
}

/// The value of a parameter as an exact number.
fn value(model: &Model, name: &str) -> Rational {
    let parameter = model
        .parameters
        .iter()
        .find(|parameter| parameter.name == name)
        .unwrap();
    model
        .graph
        .as_number(parameter.value.unwrap())
        .unwrap()
        .clone()
}

#[test]
fn chaplygin_sleigh() {
    let loaded = load("gallery/chaplygin-sleigh/model.toml", SLEIGH, &NoFiles, &[]);
    assert!(loaded.diagnostics.list.is_empty(), "{}", loaded.diagnostics);
    let model = accept(loaded);
    let g = &model.graph;
    assert_eq!(model.name, "chaplygin-sleigh");
    let (x1, y1, phi, phi1) = (
        model.jet(0, 1),
        model.jet(1, 1),
        model.jet(2, 0),
        model.jet(2, 1),
    );
    let (m, j, a) = (g.symbol("m", 0), g.symbol("J", 0), g.symbol("a", 0));
    let half = g.number(number("0.5"));
    let along = g.sub(x1, g.mul(&[a, phi1, g.sin(phi)]));
    let across = g.add(&[y1, g.mul(&[a, phi1, g.cos(phi)])]);
    let square = |e: Expr| g.powi(e, 2);
    let kinetic = g.add(&[
        g.mul(&[half, m, g.add(&[square(along), square(across)])]),
        g.mul(&[half, j, square(phi1)]),
    ]);
    assert_eq!(model.lagrangian, kinetic);
    assert_eq!(model.kinetic, Some(kinetic));
    assert_eq!(model.potential, None);
    let blade = &model.constraints[0];
    assert_eq!((blade.name.as_str(), blade.order), ("blade", 1));
    assert_eq!(
        blade.f,
        g.sub(g.mul(&[y1, g.cos(phi)]), g.mul(&[x1, g.sin(phi)]))
    );
    assert_eq!(model.multiplier(0), "lambda_blade");
    assert_eq!(value(&model, "a"), number("0.25"));
    let speed = model.parameters[4].value.unwrap();
    assert!(g.symbols_in(&[speed]).is_empty());
    let v = g.evaluate_f64(&[speed], &|_| None).unwrap()[0];
    assert!((v - 1.2048340134640954).abs() < 1e-14, "{v}"); // 2.1 sqrt(0.49375/1.5)
    assert_eq!(model.initial.values.len(), 6);
    assert_eq!(model.initial.values[&(2, 1)].value, g.symbol("W", 0));
    assert_eq!(model.assumptions[0].relation, Relation::Greater);
    assert_eq!(
        model
            .expect
            .verdicts
            .iter()
            .filter(|e| e.subject.as_deref() == Some("weak"))
            .count(),
        1
    );
    assert_eq!(model.drawing.as_ref().unwrap().elements.len(), 4);
}

const PENDULUM: &str = r#"
coordinates = ["θ"]
[parameters]
l = 0.1
g = "9.81"
m = "2/3"
[lagrangian]
T = "1/2 m l^2 θ'^2"
V = "-m g l cos(theta)"
"#;

#[test]
fn greek_letters_and_exact_numbers() {
    let model = model(PENDULUM);
    assert_eq!(model.coordinates[0].name, "theta");
    assert_eq!(model.coordinate("θ"), Some(0));
    assert_eq!(value(&model, "l").to_string(), "1/10");
    assert_eq!(value(&model, "g").to_string(), "981/100");
    assert_eq!(value(&model, "m").to_string(), "2/3");
}

#[test]
fn overrides_are_exact_and_reach_what_depends_on_them() {
    let text = format!("{PENDULUM}\n[simulation]\nt_end = 1\n");
    let text = text.replace("m = \"2/3\"", "m = \"2/3\"\nw = \"g/l\"");
    let set = |pairs: &[(&str, &str)]| {
        let pairs: Vec<(String, String)> = pairs
            .iter()
            .map(|(a, b)| (a.to_string(), b.to_string()))
            .collect();
        load("model.toml", &text, &NoFiles, &pairs)
    };
    let changed = accept(set(&[("l", "0.3")]));
    assert_eq!(value(&changed, "l").to_string(), "3/10");
    assert_eq!(value(&changed, "w").to_string(), "327/10");
    let wrong = set(&[("ll", "0.3")]);
    let message = wrong.diagnostics.to_string();
    assert!(
        wrong.model.is_none()
            && message.contains("did you mean `l`?")
            && message.contains("--set ll=0.3"),
        "{message}"
    );
    let wrong = set(&[("l", "0.3 +")]).diagnostics.to_string();
    assert!(wrong.contains("--set l=0.3 +:1:7"), "{wrong}");
}

#[test]
fn includes_are_merged_and_problems_name_the_right_file() {
    let text = "include = \"common/base.toml\"\n[parameters]\nm = 2\n[initial]\ntheta = 1\n";
    let base = PENDULUM.replace("m = \"2/3\"", "m = { value = 1, description = \"mass\" }");
    let mut files = BTreeMap::from([("a/common/base.toml".to_owned(), base.clone())]);
    let model = accept(load("a/model.toml", text, &files, &[]));
    assert_eq!(value(&model, "m").to_string(), "2");
    assert_eq!(model.parameters[2].description, "mass");
    assert_eq!(model.name, "a");
    let again = accept(reload(&model.text));
    assert_eq!(value(&again, "m").to_string(), "2");

    files.insert(
        "a/common/base.toml".to_owned(),
        base.replace("cos(theta)", "cos(thta)"),
    );
    let message = load("a/model.toml", text, &files, &[])
        .diagnostics
        .to_string();
    assert!(message.contains("a/common/base.toml:9:17"), "{message}");
    files.insert(
        "a/common/base.toml".to_owned(),
        "include = \"../model.toml\"".to_owned(),
    );
    let message = load("a/model.toml", text, &files, &[])
        .diagnostics
        .to_string();
    assert!(message.contains("includes itself"), "{message}");
    let message = load("b/model.toml", text, &files, &[])
        .diagnostics
        .to_string();
    assert!(
        message.contains("`b/common/base.toml` cannot be read"),
        "{message}"
    );
}

#[test]
fn definitions_may_come_in_any_order_and_be_differentiated() {
    let model = model(
        "coordinates = [\"x\"]\nlagrangian = \"x'^2/2\"\n[define]\nb = \"2 a\"\na = \"x^2\"\n[constraints]\nc = \"b' = 1\"\nd = \"b'' = x\"",
    );
    let g = &model.graph;
    let (x, x1, x2) = (model.jet(0, 0), model.jet(0, 1), model.jet(0, 2));
    assert_eq!(model.constraints[0].left, g.mul(&[g.integer(4), x, x1]));
    assert_eq!(model.constraints[0].order, 1);
    assert_eq!(model.constraints[1].order, 2);
    let four = g.integer(4);
    assert_eq!(
        model.constraints[1].left,
        g.add(&[g.mul(&[four, g.powi(x1, 2)]), g.mul(&[four, x, x2])])
    );
    assert_eq!(
        model
            .defines
            .iter()
            .map(|d| d.name.as_str())
            .collect::<Vec<_>>(),
        ["a", "b"]
    );
}

const CHAIN: &str = r#"
[sizes]
n = 2
[indices]
i = "1..n"
[coordinates]
x = ""
"theta_{i}" = ""
"#;

#[test]
fn families_are_expanded_over_their_indices() {
    let text = CHAIN
        .replace("[coordinates]\nx = \"\"\n\"theta_{i}\" = \"\"\n", "")
        .replace("[sizes]", "coordinates = [\"x\", \"theta_{i}\"]\n[sizes]")
        + r#"
[parameters]
"l_{i}" = "1/i"
[define]
"p_{i}" = "x + sum(j = 1..i, l_{j} sin(theta_{j}))"
[lagrangian]
T = "1/2 sum(i = 1..n, p_{i}'^2)"
[constraints]
"axle_{i}" = "theta_{i}' = i x'"
[initial]
"theta_{i}'" = "i/10"
"#;
    let set = [("n".to_owned(), "3".to_owned())];
    let model = accept(load("model.toml", &text, &NoFiles, &set));
    assert_eq!(
        model
            .coordinates
            .iter()
            .map(|c| c.name.as_str())
            .collect::<Vec<_>>(),
        ["x", "theta_1", "theta_2", "theta_3"]
    );
    assert_eq!(value(&model, "l_3").to_string(), "1/3");
    let g = &model.graph;
    let p2 = model
        .defines
        .iter()
        .find(|d| d.name == "p_2")
        .unwrap()
        .value;
    let l = |i: i64| g.symbol(&format!("l_{i}"), 0);
    let sine = |i: usize| g.sin(model.jet(i, 0));
    assert_eq!(
        p2,
        g.add(&[
            model.jet(0, 0),
            g.mul(&[l(1), sine(1)]),
            g.mul(&[l(2), sine(2)])
        ])
    );
    assert_eq!(
        model
            .constraints
            .iter()
            .map(|c| c.name.as_str())
            .collect::<Vec<_>>(),
        ["axle_1", "axle_2", "axle_3"]
    );
    assert_eq!(
        model.constraints[2].f,
        g.sub(model.jet(3, 1), g.mul(&[g.integer(3), model.jet(0, 1)]))
    );
    assert_eq!(
        g.as_number(model.initial.values[&(2, 1)].value)
            .unwrap()
            .to_string(),
        "1/5"
    );
    assert_eq!(model.sizes, [("n".to_owned(), 3)]);
}

#[test]
fn unnamed_constraints_are_numbered() {
    let model = model("coordinates = [\"x\", \"y\"]\nlagrangian = \"x'^2 + y'^2\"\nconstraints = [\"x' = y\", { name = \"b\", equation = \"x = y\" }]");
    assert_eq!(model.multiplier(0), "lambda_1");
    assert_eq!(model.multiplier(1), "lambda_b");
    assert_eq!(model.constraints[1].order, 0);
}

#[test]
fn controls_velocities_forces_and_the_rest() {
    let text = r#"
coordinates = ["x", "y"]
parameters = ["m", "k"]
[controls]
u = "sin(3 t)"
[lagrangian]
T = "1/2 m (x'^2 + (y' + u')^2)"
[forces]
y = "-k y'"
x = "u - t"
rayleigh = "k x'^2/2"
[constraints]
c = "x' = u y'"
[velocities]
independent = ["y'"]
[quasi_velocities]
w = "2 y'"
[initial]
"x''" = 1
kappa_c = "k"
project = true
[simulation]
t_end = "2 pi/3"
tolerance = 1e-9
output = { times = [0, "1/2", 1] }
state = "full"
[expect]
model.chaplygin = ["proved", "conditional"]
stop = { at = 1, reason = "rank" }
"#;
    let model = model(text);
    let g = &model.graph;
    assert_eq!(
        model
            .forces
            .iter()
            .map(|f| f.coordinate)
            .collect::<Vec<_>>(),
        [0, 1]
    );
    assert!(model.rayleigh.is_some());
    assert_eq!(
        model.controls[0].law,
        Some(g.sin(g.mul(&[g.integer(3), model.time])))
    );
    assert_eq!(model.independent, Some(vec![1]));
    assert_eq!(model.quasi_velocities[0].name, "w");
    assert_eq!(model.initial.extra[0].name, "kappa_c");
    assert!(model.initial.project && model.initial.values.contains_key(&(0, 2)));
    assert_eq!(model.parameters[0].value, None);
    assert_eq!(model.expect.verdicts[0].claim, "model.chaplygin");
    assert_eq!(model.expect.stop.as_ref().unwrap().reason, "rank");
    assert_eq!(model.simulation.tolerance, Some(number("1e-9")));
}

#[test]
fn expressions_about_a_finished_model() {
    let model = accept(load("m", SLEIGH, &NoFiles, &[]));
    let g = &model.graph;
    let of = |text: &str| model.expression(text);
    assert_eq!(of("v").unwrap(), model.defines[0].value);
    assert_eq!(
        of("v'").unwrap(),
        model.total_derivative(model.defines[0].value)
    );
    assert_eq!(
        of("x'' + lambda_blade").unwrap(),
        g.add(&[model.jet(0, 2), g.symbol("lambda_blade", 0)])
    );
    assert!(of("x + w2")
        .unwrap_err()
        .to_string()
        .contains("unknown name `w2`"));
    assert!(of("m'").is_err());
}

#[test]
fn what_the_motion_needs_is_named() {
    let model = model("coordinates = [\"x\"]\nparameters = [\"m\"]\ncontrols = { u = {} }\nlagrangian = \"m x'^2 + u x\"");
    let missing = model.missing_for_motion();
    assert_eq!(missing.len(), 2);
    assert!(missing[0].message.contains("`m`") && missing[1].message.contains("`u`"));
    assert!(accept(load("m", SLEIGH, &NoFiles, &[]))
        .missing_for_motion()
        .is_empty());
}

#[test]
fn assumptions_are_expanded_and_compared_with_the_values() {
    let text = |l: &str| {
        format!("coordinates = [\"x\"]\nassumptions = [\"l_{{i}} > 0\", \"0 <= x < pi\"]\nlagrangian = \"x'^2\"\n[sizes]\nn = 2\n[indices]\ni = \"1..n\"\n[parameters]\n\"l_{{i}}\" = \"{l}\"\n")
    };
    let good = model(&text("i/2"));
    assert_eq!(good.assumptions.len(), 4);
    assert_eq!(good.assumptions[1].left, good.graph.symbol("l_2", 0));
    assert_eq!(good.assumptions[3].right, good.graph.pi());
    let bad = load("m", &text("i - 1"), &NoFiles, &[]);
    assert!(
        bad.diagnostics
            .to_string()
            .contains("`l_{i} > 0` does not hold"),
        "{}",
        bad.diagnostics
    );
}

#[test]
fn a_model_can_be_shared_between_threads() {
    fn shared<T: Send + Sync>() {}
    shared::<Model>();
    shared::<Loaded>();
}

#[test]
fn two_equality_signs_are_one() {
    let with = |sign: &str| {
        let text = format!("coordinates = [\"x\", \"y\"]\nlagrangian = \"x'^2 + y'^2\"\nconstraints = [\"y' {sign} 2 x'\"]\n");
        let (model, diagnostics) = load("model.toml", &text, &NoFiles, &[])
            .into_result()
            .unwrap_or_else(|problems| panic!("{problems}"));
        assert!(diagnostics.list.is_empty(), "{diagnostics}");
        model.graph.text(model.constraints[0].f)
    };
    assert_eq!(with("=="), with("="));
}

#[test]
fn output_is_a_number_of_intervals_in_two_notations() {
    let with = |output: &str| {
        let text = format!("coordinates = [\"x\"]\nlagrangian = \"x'^2\"\n[simulation]\nt_end = 1\noutput = {output}\n");
        let loaded = load("model.toml", &text, &NoFiles, &[]);
        let model = loaded
            .model
            .unwrap_or_else(|| panic!("{}", loaded.diagnostics));
        format!("{:?}", model.simulation.output)
    };
    assert_eq!(with("{ points = 40 }"), with("40"));
    assert_ne!(with("{ points = 40 }"), with("41"));
}

#[test]
fn constants_are_read_with_the_parameters_of_the_model() {
    let text = "coordinates = [\"x\"]\nlagrangian = \"x'^2/2\"\n[parameters]\nl = 9\nk = {}\n";
    let (model, _) = load("model.toml", text, &NoFiles, &[])
        .into_result()
        .unwrap_or_else(|problems| panic!("{problems}"));
    let value = |text: &str| model.constant_value("--t-end", text);
    assert_eq!(value("sqrt(l)/2"), Ok(1.5));
    assert_eq!(value("0.1"), Ok(0.1));
    assert_eq!(value("-2 pi"), Ok(-std::f64::consts::TAU));
    for (wrong, words) in [
        ("k", "`k` has no value"),
        ("x' + t", "have no value"),
        ("sqrt(-l)", "finite real"),
        ("", "--t-end"),
        ("1e400", "finite"),
    ] {
        let problem = value(wrong)
            .expect_err(wrong)
            .render(chetaev_model::Style::Plain);
        assert!(problem.contains(words), "{wrong}: {problem}");
    }
}

#[test]
fn crossings_are_equations() {
    let with = |crossings: &str| {
        let text = format!("coordinates = [\"x\", \"y\"]\nlagrangian = \"x'^2 + y'^2\"\n[simulation]\nt_end = 1\ncrossings = {crossings}\n");
        load("model.toml", &text, &NoFiles, &[])
    };
    let loaded = with("[\"y = x^2\", \"x' + y' = 0\"]");
    let model = loaded
        .model
        .unwrap_or_else(|| panic!("{}", loaded.diagnostics));
    let g = &model.graph;
    let crossings = model.simulation.crossings.iter();
    let read: Vec<(&str, String)> = crossings.map(|(t, e)| (t.as_str(), g.text(*e))).collect();
    let expected = [("y = x^2", "y - x^2"), ("x' + y' = 0", "x' + y'")];
    assert_eq!(read, expected.map(|(t, e)| (t, e.to_owned())));
    for wrong in ["[\"y\"]", "[\"y < x\"]", "\"y = x\"", "[1]", "[\"y = w\"]"] {
        assert!(with(wrong).model.is_none(), "{wrong}");
    }
}

//! Equations that somebody states, and other models, against the motion: right and wrong ones from textbooks.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev_mechanics::claims::{Context, Prepared, Registry, CLAIMS};
use chetaev_mechanics::{Prover, System};
use chetaev_model::load;
use chetaev_symbolic::Verdict;
use std::collections::BTreeMap;

fn verdict(text: &str, claim: &str) -> Verdict {
    verdict_with(text, claim, &[])
}

fn verdict_with(text: &str, claim: &str, files: &[(&str, &str)]) -> Verdict {
    decided(&system(text, files), claim)
}

/// The system of a model with other files beside it.
fn system(text: &str, files: &[(&str, &str)]) -> System {
    let files: BTreeMap<String, String> = files
        .iter()
        .map(|(path, text)| ((*path).to_owned(), (*text).to_owned()))
        .collect();
    let (model, _) = load("model.toml", text, &files, &[])
        .into_result()
        .unwrap_or_else(|problems| panic!("{problems}"));
    System::from_model(&model).unwrap()
}

fn decided(system: &System, claim: &str) -> Verdict {
    let prepared = Prepared::new(system).unwrap();
    let registry = Registry::new(&[CLAIMS]);
    let cx = Context::new(
        system,
        &prepared.terms,
        &prepared.selection,
        &registry,
        Prover::default(),
    );
    cx.finding(claim).verdict.clone()
}

/// Chaplygin's sleigh with its mass centre above the blade: what the model states to be zero is zero in stated equations too, which hold
/// for every l (Neimark, Fufaev 1972, chapter III).
#[test]
fn zeros_that_are_stated_count_in_stated_equations() {
    let sleigh = r#"
coordinates = ["x", "y", "phi"]
[parameters]
m = 1
J = 2
l = 0
[lagrangian]
L = "1/2 m (x'^2 + y'^2) + 1/2 J phi'^2 + m l phi' (y' cos(phi) - x' sin(phi))"
[constraints]
blade = "x' sin(phi) = y' cos(phi)"
[equations]
paper = ["m (x'' cos(phi) + y'' sin(phi)) = m l phi'^2", "J phi'' = -m l phi' (x' cos(phi) + y' sin(phi))"]
slip = ["m (x'' cos(phi) + y'' sin(phi)) = m l phi'^2 + m phi'", "J phi'' = -m l phi' (x' cos(phi) + y' sin(phi))"]
"#;
    let at_zero = system(sleigh, &[]).for_stated_zeros().unwrap();
    proved(&decided(&at_zero, "equations.stated#paper"));
    refuted(&decided(&at_zero, "equations.stated#slip"), &[]);
}

/// r' = a φ' is Chaplygin's for any a that is not zero, as φ is cyclic and dependent (S. A. Chaplygin 1897): 1 in units of an atom is 1e-12 in others.
#[test]
fn a_small_number_is_none() {
    for a in ["1e-12", "1e-3", "1", "1e9"] {
        let text = format!(
            "coordinates = [\"r\", \"phi\"]\nparameters = {{ a = {a} }}\n[lagrangian]\nL = \"1/2 (r'^2 + r^2 phi'^2) + 1/r\"\n\
             [constraints]\nc = \"r' = a phi'\"\n"
        );
        proved(&verdict(&text, "model.chaplygin"));
    }
}

/// |x'| is x' for every velocity that the model assumes, and has a corner where it assumes nothing.
#[test]
fn constraints_are_linear_for_the_velocities_that_are_assumed() {
    let text = |assumed: &str| {
        format!(
            "coordinates = [\"x\", \"y\", \"z\"]\n{assumed}[lagrangian]\nT = \"1/2 (x'^2 + y'^2 + z'^2)\"\n\
             [constraints]\nc = \"sqrt(x'^2) = y\"\nd = \"z' = y abs(x')\"\n"
        )
    };
    let claim = "model.constraints-linear";
    proved(&verdict(&text("assumptions = [\"x' > 0\"]\n"), claim));
    proved(&verdict(&text("assumptions = [\"x' < 0\"]\n"), claim));
    refuted(&verdict(&text(""), claim), &[]);
}

#[track_caller]
fn proved(verdict: &Verdict) {
    assert!(matches!(verdict, Verdict::Proved(_)), "{verdict:#?}");
}

/// Refuted, with all of these words in the sentence.
#[track_caller]
fn refuted(verdict: &Verdict, words: &[&str]) {
    assert!(matches!(verdict, Verdict::Refuted(_)), "{verdict:#?}");
    for word in words {
        assert!(verdict.detail().contains(word), "`{word}` in {verdict:#?}");
    }
}

#[track_caller]
fn conditional(verdict: &Verdict, condition: &str) {
    let Verdict::Conditional {
        condition: found, ..
    } = verdict
    else {
        panic!("{verdict:#?}");
    };
    assert_eq!(found, condition, "{verdict:#?}");
}

/// Chaplygin's skate on an inclined plane (Neimark and Fufaev 1972, ch. III § 1).
const SKATE: &str = r#"
coordinates = ["x", "y", "phi"]
assumptions = ["m > 0", "J > 0"]
[parameters]
m = 1
J = 0.4
g = 9.81
slope = 0.5
[lagrangian]
T = "1/2 m (x'^2 + y'^2) + 1/2 J phi'^2"
V = "-m g x sin(slope)"
[constraints]
blade = "y' cos(phi) = x' sin(phi)"
"#;

fn skate(equations: &str) -> Verdict {
    let text = format!("{SKATE}[equations.book]\n{equations}");
    verdict(&text, "equations.stated#book")
}

#[test]
fn the_equations_of_the_skate_are_right_in_any_form() {
    // With the multiplier of the model, whose constraint is y' cos φ − x' sin φ.
    proved(&skate(
        r#"equations = ["m x'' = m g sin(slope) - lambda_blade sin(phi)", "m y'' = lambda_blade cos(phi)", "J phi'' = 0"]"#,
    ));
    // With a reaction of its own, of the opposite sign.
    proved(&skate(
        r#"unknowns = ["N"]
           equations = ["m x'' = m g sin(slope) + N sin(phi)", "m y'' = -N cos(phi)", "phi'' = 0"]"#,
    ));
    // Without reactions: along the blade, and about the vertical.
    proved(&skate(
        r#"equations = ["x'' cos(phi) + y'' sin(phi) = g sin(slope) cos(phi)", "phi'' = 0"]"#,
    ));
}

#[test]
fn a_wrong_term_is_printed_and_a_state_where_it_matters() {
    let found = skate(
        r#"unknowns = ["N"]
           equations = ["m x'' = m g sin(slope) + N sin(phi)", "m y'' = -N cos(phi)", "J phi'' = m x' y'"]"#,
    );
    refuted(
        &found,
        &[
            "left minus right of equation `3` is -m x' y' on the motion",
            "phi'' = ",
            "the motion has phi'' = 0",
        ],
    );
    let found = skate(
        r#"equations = { x = "m x'' = m g sin(slope) - lambda_blade sin(phi)", y = "m y'' = lambda_blade cos(phi) + m g phi'^2", phi = "J phi'' = 0" }"#,
    );
    refuted(
        &found,
        &["left minus right of equation `y` is -m g phi'^2 on the motion"],
    );
}

#[test]
fn a_multiplier_is_that_of_the_model() {
    let found = skate(
        r#"equations = ["m x'' = m g sin(slope) + lambda_blade sin(phi)", "m y'' = -lambda_blade cos(phi)", "J phi'' = 0"]"#,
    );
    refuted(
        &found,
        &["opposite sign", "the accelerations are right", "unknowns"],
    );
}

#[test]
fn too_few_equations_are_said() {
    let found = skate(r#"equations = ["x'' cos(phi) + y'' sin(phi) = g sin(slope) cos(phi)"]"#);
    refuted(
        &found,
        &["too few equations", "phi''", "1 equation is missing"],
    );
    // An unknown too many.
    let found = skate(
        r#"unknowns = ["N", "M"]
           equations = ["m x'' = m g sin(slope) + N sin(phi)", "m y'' = -N cos(phi)", "J phi'' = M"]"#,
    );
    refuted(&found, &["too few equations", "phi''"]);
}

#[test]
fn equations_that_nothing_satisfies_are_said() {
    let found = skate(
        r#"equations = ["x'' cos(phi) + y'' sin(phi) = g sin(slope) cos(phi)", "phi'' = 0", "J phi'' = m"]"#,
    );
    refuted(&found, &["no accelerations satisfy all the equations"]);
}

/// E² = 0, |E| = 0, E² + F² = 0 say E = 0 for real accelerations, although their Jacobian vanishes there: with E of the motion of
/// a particle under z' = y x' (by elimination of the multiplier: (1 + y²) x'' + y (x' y' + 1) = 0, y'' = 0).
#[test]
fn powers_and_sums_of_squares_say_what_their_bases_do() {
    let model = |first: &str, second: &str| {
        format!(
            "coordinates = [\"x\", \"y\", \"z\"]\n[lagrangian]\nL = \"1/2 (x'^2 + y'^2 + z'^2) - z\"\n\
             [constraints]\nc = \"z' = y x'\"\n[equations]\nown = [\"{first}\", \"{second}\"]\n"
        )
    };
    let claim = "equations.stated#own";
    let e = "((1 + y^2) x'' + y (x' y' + 1))";
    let alone = [
        format!("{e}^2 = 0"),
        format!("{e}^3 = 0"),
        format!("abs({e}) = 0"),
        format!("exp({e}) = 1"),
        format!("(2 + x'^2) {e}^2 = 0"),
    ];
    for first in &alone {
        proved(&verdict(&model(first, "y'' = 0"), claim));
    }
    let sum = format!("{e}^2 + y''^2 = 0");
    proved(&verdict(&model(&sum, "0 = 0"), claim));
    let wrong = "((1 + y^2) x'' + y (x' y' - 1))^2 = 0";
    refuted(
        &verdict(&model(wrong, "y'' = 0"), claim),
        &["which vanishes where equation `1` holds"],
    );
    let both = format!("{e}^2 + (y'' - x')^2 = 0");
    refuted(
        &verdict(&model(&both, "0 = 0"), claim),
        &["which vanishes where equation `1` holds"],
    );
    let few = format!("{e}^2 = 0");
    refuted(&verdict(&model(&few, "0 = 0"), claim), &["too few"]);
}

#[test]
fn right_for_the_parameters_stated_only() {
    // A homogeneous disc rolling upright, its moment of inertia put in: J = m r²/2 (Neimark and Fufaev 1972, ch. II).
    let disc = r#"
coordinates = ["s", "psi"]
[parameters]
m = 2
r = 1
J = 1
k = 3
[lagrangian]
T = "1/2 m s'^2 + 1/2 J psi'^2"
V = "1/2 k s^2"
[constraints]
rolling = "s' = r psi'"
[equations.homogeneous]
equations = ["3/2 m s'' = -k s"]
[equations.inhomogeneous]
equations = ["7/5 m s'' = -k s"]
"#;
    conditional(
        &verdict(disc, "equations.stated#homogeneous"),
        "m r^2 - 2 J = 0",
    );
    refuted(&verdict(disc, "equations.stated#inhomogeneous"), &["s''"]);
    // Where J is so by definition, they are right.
    let tied = disc.replace("J = 1", "J = \"1/2 m r^2\"");
    proved(&verdict(&tied, "equations.stated#homogeneous"));
}

/// A pendulum in Cartesian coordinates; the constraint counts with the position.
const CARTESIAN: &str = r#"
coordinates = ["x", "y"]
assumptions = ["m > 0", "l > 0"]
[parameters]
m = 1
l = 2
g = 9.81
[lagrangian]
T = "1/2 m (x'^2 + y'^2)"
V = "m g y"
[constraints]
rod = "x^2 + y^2 = l^2"
"#;

#[test]
fn positions_belong_to_the_constraint_set() {
    // x² + y² is l² at admissible positions only.
    let text = format!(
        "{CARTESIAN}[equations.tension]\nunknowns = [\"S\"]\nequations = [\"m l x'' = -S x\", \"m l y'' = -S y - m g l\", \"S l = m (x'^2 + y'^2) l - m g y l\"]\n"
    );
    // S = m v²/l − m g y/l.
    let right = text.replace(
        "S l = m (x'^2 + y'^2) l - m g y l",
        "S = m (x'^2 + y'^2)/l - m g y/l",
    );
    proved(&verdict(&right, "equations.stated#tension"));
    refuted(
        &verdict(&text, "equations.stated#tension"),
        &["equation `3`"],
    );
}

#[test]
fn spurious_solutions_are_named() {
    let oscillator = |equations: &str| {
        let text = format!(
            "coordinates = [\"x\"]\nassumptions = [\"m > 0\", \"c > 0\"]\nparameters = {{ m = 1, c = 2 }}\nlagrangian = {{ T = \"1/2 m x'^2\", V = \"1/2 c x^2\" }}\n[equations]\na = [{equations}]\n"
        );
        verdict(&text, "equations.stated#a")
    };
    proved(&oscillator("\"m x'' + c x = 0\""));
    // The energy, differentiated: rest at any place satisfies it too.
    let found = oscillator("\"x' (m x'' + c x) = 0\"");
    conditional(&found, "x' ≠ 0");
    // A factor that is never zero loses nothing.
    proved(&oscillator("\"(1 + x'^2) (m x'' + c x) = 0\""));
    // A second solution at every state.
    let found = oscillator("\"(m x'' + c x) (x'' - 1) = 0\"");
    refuted(&found, &["too many solutions"]);
    // Squared, it is the same.
    let found = oscillator("\"(x'')^2 = (c x/m)^2\"");
    refuted(&found, &["too many solutions"]);
    // The energy with its constant holds at some states only.
    let found = oscillator("\"m x'^2 + c x^2 = 7\", \"m x'' + c x = 0\"");
    refuted(&found, &["equation `1`"]);
}

/// Appell's and Hamel's example (Hamel 1949, § 225), z' = a √(x'² + y'²).
#[test]
fn appell_and_hamel() {
    let text = r#"
coordinates = ["x", "y", "z"]
assumptions = ["m > 0", "a > 0", "z' > 0"]
parameters = { m = 1, g = 9.81, a = 0.5 }
lagrangian = { T = "1/2 m (x'^2 + y'^2 + z'^2)", V = "m g z" }
[constraints]
cone = "z' = a sqrt(x'^2 + y'^2)"
[equations.hamel]
unknowns = ["mu"]
equations = ["m x'' = -mu a^2 x'/z'", "m y'' = -mu a^2 y'/z'", "m z'' = mu - m g"]
[equations.reduced]
equations = ["x'' y' = x' y''", "(1 + a^2) (x' x'' + y' y'') = -a g sqrt(x'^2 + y'^2)"]
[equations.wrong]
equations = ["x'' y' = x' y''", "(1 - a^2) (x' x'' + y' y'') = -a g sqrt(x'^2 + y'^2)"]
"#;
    proved(&verdict(text, "equations.stated#hamel"));
    let found = verdict(text, "equations.stated#reduced");
    assert!(
        matches!(found, Verdict::Proved(_) | Verdict::Conditional { .. }),
        "{found:#?}"
    );
    refuted(&verdict(text, "equations.stated#wrong"), &["equation `2`"]);
}

/// The same pendulum by its angle from the vertical, and what is wrong with others.
const POLAR: &str = r#"
coordinates = ["theta"]
[parameters]
M = 3
l = 2
g = 9.81
[lagrangian]
T = "1/2 M l^2 theta'^2"
V = "-M g l cos(theta)"
"#;

const POLAR_BESIDE_CARTESIAN: &str = "[twin.cartesian]\nmodel = \"cartesian.toml\"\nparameters = { m = \"M\" }\nmap = { x = \"l sin(theta)\", y = \"-l cos(theta)\" }\n";

fn twins(text: &str, other: &str) -> Verdict {
    let claim = text
        .split("[twin.")
        .nth(1)
        .and_then(|rest| rest.split(']').next());
    let path = text
        .split("model = \"")
        .nth(1)
        .and_then(|rest| rest.split('"').next());
    let claim = format!("model.same-motion#{}", claim.unwrap());
    verdict_with(text, &claim, &[(path.unwrap(), other)])
}

#[test]
fn a_pendulum_in_two_kinds_of_coordinates_is_one() {
    let text = format!("{POLAR}{POLAR_BESIDE_CARTESIAN}");
    let found = twins(&text, CARTESIAN);
    proved(&found);
    assert!(found.detail().contains("of dimension 2"), "{found:#?}");
    // The other way round: the angle is a function of the place.
    let text = format!(
        "{CARTESIAN}[twin.polar]\nmodel = \"polar.toml\"\nparameters = {{ M = \"m\" }}\nmap = {{ theta = \"atan2(x, -y)\" }}\n"
    );
    proved(&twins(&text, POLAR));
}

#[test]
fn another_pendulum_is_refuted_with_its_numbers() {
    let text = format!("{POLAR}{POLAR_BESIDE_CARTESIAN}");
    // In the other one the weight points the other way.
    let other = CARTESIAN.replace("V = \"m g y\"", "V = \"-m g y\"");
    refuted(
        &twins(&text, &other),
        &[
            "the accelerations differ",
            "there the other model has x'' = ",
        ],
    );
    // A rod twice as long: images are not admissible.
    let other = CARTESIAN.replace("= l^2", "= 4 l^2");
    refuted(
        &twins(&text, &other),
        &["are none of the other", "constraint `rod`"],
    );
    // No rod at all: more states than ours.
    let other = CARTESIAN.replace("[constraints]\nrod = \"x^2 + y^2 = l^2\"\n", "");
    refuted(&twins(&text, &other), &["dimension 2", "dimension 4"]);
    // A map that forgets the angle.
    let text = text.replace(
        "x = \"l sin(theta)\", y = \"-l cos(theta)\"",
        "x = \"l\", y = \"0 l\"",
    );
    refuted(&twins(&text, CARTESIAN), &["have the same image"]);
}

/// The skate by its place and direction, and by arc length along the blade turned by a fixed angle.
#[test]
fn nonholonomic_twins() {
    let turned = format!(
        "{}[twin.turned]\nmodel = \"skate.toml\"\nmap = {{ x = \"x cos(c) - y sin(c)\", y = \"x sin(c) + y cos(c)\", phi = \"phi + c\" }}\n",
        SKATE
            .replace("V = \"-m g x sin(slope)\"", "V = \"-m g (x cos(c) - y sin(c)) sin(slope)\"")
            .replace("slope = 0.5", "slope = 0.5\nc = 0.3")
    );
    proved(&twins(&turned, SKATE));
    let level = SKATE.replace("V = \"-m g x sin(slope)\"", "");
    refuted(&twins(&turned, &level), &["the accelerations differ"]);
}

#[test]
fn what_a_twin_needs_is_said() {
    let text = format!("{POLAR}{POLAR_BESIDE_CARTESIAN}");
    let problem = |text: &str, other: &str| {
        let files = BTreeMap::from([("cartesian.toml".to_owned(), other.to_owned())]);
        let loaded = load("model.toml", text, &files, &[]);
        assert!(loaded.model.is_none(), "{text}");
        loaded.diagnostics.to_string()
    };
    let missing = text.replace(", y = \"-l cos(theta)\"", "");
    assert!(problem(&missing, CARTESIAN).contains("does not say what `y`"));
    let unknown = text.replace("parameters = { m = \"M\" }", "");
    // The mass of the other has a value, which then counts.
    let files = BTreeMap::from([("cartesian.toml".to_owned(), CARTESIAN.to_owned())]);
    assert!(load("model.toml", &unknown, &files, &[]).model.is_some());
    let differing = problem(&text, &CARTESIAN.replace("l = 2", "l = 3"));
    assert!(
        differing.contains("the parameter `l` is 2 here and 3"),
        "{differing}"
    );
    let broken = problem(&text, &CARTESIAN.replace("V = \"m g y\"", "V = \"m g z\""));
    assert!(broken.contains("cartesian.toml"), "{broken}");
}

/// Whoever derives by hand states a circle and its derivative. The positions are still those of the circle, where the speed keeps the point.
#[test]
fn a_position_whose_derivative_is_stated_too_still_holds() {
    let stated = [
        "p = \"x^2 + y^2 = 1\"",
        "v = \"x x' + y y' = 0\"\np = \"x^2 + y^2 = 1\"",
        "p = \"x^2 + y^2 = 1\"\nv = \"x x' + y y' = 0\"",
    ];
    for constraints in stated {
        let text = format!(
            "name = \"circle\"\ncoordinates = [\"x\", \"y\"]\nparameters = {{ m = {{}} }}\nassumptions = [\"m > 0\"]\n\
             lagrangian = {{ T = \"1/2 m (x'^2 + y'^2)\" }}\n[constraints]\n{constraints}\n[equations]\n\
             right = [\"x'' = -x (x'^2 + y'^2)\", \"y'' = -y (x'^2 + y'^2)\"]\n\
             wrong = [\"x'' = -2 x (x'^2 + y'^2)\", \"y'' = -2 y (x'^2 + y'^2)\"]\n"
        );
        proved(&verdict(&text, "equations.stated#right"));
        refuted(
            &verdict(&text, "equations.stated#wrong"),
            &["the motion does not satisfy"],
        );
    }
}

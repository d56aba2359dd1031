//! First integrals where something jumps: at corners, and from one component of the constraints to another.

use chetaev::geometry::noether::found::found;
use chetaev::symbolic::Verdict;
use chetaev_tests::searched::{in_context, made_up};

/// Functions that say nothing of the motion are called trivial, and those that jump are none that keep their value: a point falls
/// through x = 0 to and fro.
#[test]
fn constants_and_functions_that_jump() {
    let model = made_up(
        r#"
name = "bouncing"
coordinates = ["x", "y"]
[parameters]
k = 2
[lagrangian]
L = "(x'^2 + y'^2)/2 - abs(x)"
[integrals]
side = "sign(x)"
quotient = "abs(x)/x"
turns = "atan(x) + atan(1/x)"
number = "3 k"
flight = "y'"
"#,
    );
    in_context(&model, |cx| {
        for name in ["side", "quotient", "turns"] {
            let finding = cx.finding(&format!("noether.inverse#{name}"));
            let is_conditional = matches!(finding.verdict, Verdict::Conditional { .. });
            assert!(is_conditional, "{name}: {:?}", finding.verdict);
        }
        let number = cx.finding("noether.inverse#number");
        assert!(number.verdict.detail().contains("trivial"));
        let flight = cx.finding("noether.inverse#flight");
        let detail = flight.verdict.detail();
        assert!(matches!(flight.verdict, Verdict::Proved(_)) && !detail.contains("trivial"));
    });
}

/// |x'| = y' keeps y - x while x' > 0 and y + x while x' < 0; x + 2 y on neither side.
#[test]
fn integrals_on_one_side_of_a_corner() {
    let model = made_up(
        "name = \"corner\"\ncoordinates = [\"x\", \"y\"]\nlagrangian = \"(x'^2 + y'^2)/2\"\n[constraints]\na = \"abs(x') = y'\"\n[integrals]\nforward = \"y - x\"\nbackward = \"y + x\"\nneither = \"x + 2 y\"\n",
    );
    in_context(&model, |cx| {
        for (name, side) in [("forward", "x' > 0"), ("backward", "x' < 0")] {
            let finding = cx.finding(&format!("noether.inverse#{name}"));
            let Verdict::Conditional { condition, .. } = &finding.verdict else {
                panic!("{name}: {}", finding.verdict.detail());
            };
            assert!(condition.contains(side), "{name}: {condition}");
        }
        let finding = cx.finding("noether.inverse#neither");
        assert_eq!(
            finding.verdict.word(),
            "refuted",
            "{}",
            finding.verdict.detail()
        );
    });
}

/// (x x' + y y')² + x x' + y y' = 0 has two components, on which points of a search would be mixed: what is kept is said of each by itself,
/// x² + y² on the first and x y' - y x' (or a function of both) there too.
#[test]
fn components_are_searched_one_by_one() {
    let text = "name = \"branches\"\ncoordinates = [\"x\", \"y\"]\nlagrangian = \"(x'^2 + y'^2)/2\"\n[constraints]\nc = \"(x x' + y y')^2 + x x' + y y' = 0\"\n[initial]\nx = 1\n\"y'\" = 1\n";
    in_context(&made_up(text), |cx| {
        let finding = cx.finding("noether.family");
        let detail = finding.verdict.detail();
        assert_eq!(finding.verdict.word(), "proved", "{detail}");
        let components = [
            "on the component x x' + y y' = 0",
            "on the component x x' + y y' + 1 = 0",
        ];
        assert!(components.iter().all(|c| detail.contains(c)), "{detail}");
        let g = &cx.system.graph;
        let shown: Vec<String> = finding.formulas.iter().map(|f| g.text(f.right)).collect();
        assert!(shown.iter().any(|e| e == "x^2 + y^2"), "{shown:?}");
        assert!(shown.len() >= 4, "{shown:?}");
    });
}

/// z' = sign(y) x' keeps x z' - z x' on either side of y = 0; where y passes through 0 z' jumps, and so does it.
#[test]
fn integrals_under_constraints_that_jump() {
    let text = "name = \"jump\"\ncoordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n[constraints]\nc = \"z' = sign(y) x'\"\n";
    in_context(&made_up(text), |cx| {
        let count = found(cx).as_ref().as_ref().map_or(0, |f| f.integrals.len());
        assert!(count > 0);
        for j in 1..=count {
            let finding = cx.finding(&format!("noether.integral#{j}"));
            let detail = finding.verdict.detail();
            assert!(detail.contains("while y keeps its sign"), "{detail}");
        }
    });
}

/// L = (x'² + y'²)/2 + sign(x) x' y: x' + y sign(x) jumps by 2 y where x passes through 0, as x' does not. Dry friction: |x'| + µ t is kept
/// until the motion stops.
#[test]
fn integrals_of_motions_that_jump() {
    let step = "name = \"step\"\ncoordinates = [\"x\", \"y\"]\nlagrangian = \"(x'^2 + y'^2)/2 + sign(x) x' y\"\n[integrals]\nenergy = \"(x'^2 + y'^2)/2\"\n";
    let friction = "name = \"friction\"\ncoordinates = [\"x\"]\nparameters = { mu = 1 }\nassumptions = [\"mu > 0\"]\nlagrangian = \"x'^2/2\"\n[forces]\nx = \"-mu sign(x')\"\n[integrals]\na = \"abs(x') + mu t\"\n";
    for (text, name, argument) in [(step, "energy", "x"), (friction, "a", "x'")] {
        in_context(&made_up(text), |cx| {
            let finding = cx.finding(&format!("noether.inverse#{name}"));
            let detail = finding.verdict.detail();
            let expected = format!("while {argument} keeps its sign");
            assert!(detail.contains(&expected), "{detail}");
        });
    }
}

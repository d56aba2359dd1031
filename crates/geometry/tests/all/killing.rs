//! Fields and gauges that are found by the Killing-type equations, and generalized momenta (T3 §6, §7, §8).

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::{expr, framed, system, with_context as with};
use chetaev_geometry::noether::embedded::Embedded;
use chetaev_geometry::noether::killing::{solutions, Solution};
use chetaev_geometry::noether::motion::Motion;
use chetaev_mechanics::{Characteristics, System};
use chetaev_symbolic::{Expr, Verdict};

#[derive(Clone, Copy, PartialEq)]
enum Chart {
    /// Independent velocities.
    Natural,
    /// The quasi-velocities of the model, or what is chosen for the constraints.
    Adapted,
}

/// All solutions with ξ and g of these functions.
fn solved(system: &System, chart: Chart, fields: &[&str], gauges: &[&str]) -> Vec<Solution> {
    with(system, |cx| {
        let n = match chart {
            Chart::Adapted => Embedded::of(cx).unwrap(),
            Chart::Natural => {
                let chart = Characteristics::independent_velocities(system, cx.terms, cx.selection);
                Embedded::by(cx, Some(chart.unwrap())).unwrap()
            }
        };
        let read = |texts: &[&str]| -> Vec<Expr> {
            let texts = texts.iter();
            texts.map(|text| expr(&system.graph, text)).collect()
        };
        solutions(cx, &n, &read(fields), &read(gauges)).unwrap()
    })
}

/// The integrals of the solutions and those expected span the same functions, and each solution is proved.
fn are(system: &System, found: &[Solution], expected: &[&str]) {
    let g = &system.graph;
    let texts: Vec<String> = found.iter().map(|s| g.text(s.integral)).collect();
    assert_eq!(found.len(), expected.len(), "{texts:?}");
    for solution in found {
        let verdict = &solution.verdict;
        assert!(matches!(verdict, Verdict::Proved(_)), "{verdict:?}");
    }
    with(system, |cx| {
        let motion = Motion::of(cx).unwrap();
        let rank = |es: &[Expr]| {
            let matrix = motion.gradients(es);
            let rank = cx.prover.rank(system, &matrix, &motion.manifold);
            rank.unwrap().maximum
        };
        let own: Vec<Expr> = found.iter().map(|s| s.integral).collect();
        for wanted in expected {
            let mut all = own.clone();
            all.push(expr(g, wanted));
            assert_eq!(rank(&all), rank(&own), "{wanted} is not among {texts:?}");
        }
    });
}

const PARTICLE: &str = "(x'^2 + y'^2 + z'^2)/2";
const PLANE: (&str, &str) = ("c", "z' - y x'");
const ROOTS: [&str; 7] = [
    "1",
    "y",
    "y^2",
    "sqrt(1+y^2)",
    "y sqrt(1+y^2)",
    "1/sqrt(1+y^2)",
    "y/sqrt(1+y^2)",
];

/// T3 §8.2: with {1, y, y²} and the roots the generalized momenta are √(1+y²) x' and y', in both charts; without roots y' alone.
#[test]
fn momenta_of_the_particle() {
    let natural = system("x y z", PARTICLE, &[PLANE]);
    let adapted = framed(
        "x y z",
        PARTICLE,
        &[PLANE],
        &[("h", "x'"), ("k", "y'"), ("s", "z' - y x'")],
        &[],
    );
    for (system, chart) in [(&natural, Chart::Natural), (&adapted, Chart::Adapted)] {
        let polynomials = solved(system, chart, &ROOTS[..3], &[]);
        are(system, &polynomials, &["y'"]);
        let roots = solved(system, chart, &ROOTS, &[]);
        are(system, &roots, &["y'", "sqrt(1+y^2) x'"]);
    }
    // ψ = (1/√(1+y²), 0), and ξ = -ψ up to a factor.
    let found = solved(&adapted, Chart::Adapted, &["1/sqrt(1+y^2)"], &[]);
    let [one] = &found[..] else {
        panic!("one solution is expected, as y' needs the constant");
    };
    assert!(adapted.graph.is_zero(one.xi[1]) && !adapted.graph.is_zero(one.xi[0]));
}

/// T3 §8.4: the sled's four as generalized momenta in its frame.
#[test]
fn momenta_of_the_sled() {
    let along = "(x' cos(phi) + y' sin(phi))";
    let sled = framed(
        "x y phi",
        "m (x'^2 + y'^2 + b^2 phi'^2)/2",
        &[("blade", "x' sin(phi) - y' cos(phi)")],
        &[
            ("u", along),
            ("w", "phi'"),
            ("s", "y' cos(phi) - x' sin(phi)"),
        ],
        &[],
    );
    let functions = ["1", "x", "y", "sin(phi)", "cos(phi)"];
    let four = solved(&sled, Chart::Adapted, &functions, &[]);
    let x = format!("phi' x - {along} sin(phi)");
    let y = format!("phi' y + {along} cos(phi)");
    are(&sled, &four, &[along, "phi'", &x, &y]);
}

/// T3 §8.5: fields with velocities. The ratio, the one with the time, and the energy with δ = 0, ξ = -η; no others.
#[test]
fn fields_of_appells_machine() {
    let appell = system(
        "x y z",
        "m (x'^2 + y'^2 + z'^2)/2 - m g z",
        &[("cone", "z' - a sqrt(x'^2 + y'^2)")],
    );
    let rho = "sqrt(x'^2 + y'^2)";
    let fields = [
        "x'",
        "y'",
        &format!("x'/{rho}"),
        &format!("y'/{rho}"),
        "1/y'",
        "x'/y'^2",
    ];
    let gauges = ["t", "z", "x'^2 + y'^2", "x'/y'"];
    let found = solved(&appell, Chart::Natural, &fields, &gauges);
    let energy = "m (1 + a^2) (x'^2 + y'^2)/2 + m g z";
    let time = format!("{rho} + g a t/(1 + a^2)");
    are(&appell, &found, &["x'/y'", &time, energy]);
    // The field of the ratio, found by itself: ξ = (-1, η1/η2)/(m η2) for g = η1/η2.
    let found = solved(&appell, Chart::Natural, &fields[4..], &gauges[3..]);
    let [ratio] = &found[..] else {
        panic!("one solution is expected");
    };
    let g = &appell.graph;
    let scale = g.div(ratio.gauge, expr(g, "x'/y'"));
    with(&appell, |cx| {
        let motion = Motion::of(cx).unwrap();
        for (&xi, wanted) in ratio.xi.iter().zip(["-1/(m y')", "x'/(m y'^2)"]) {
            let difference = g.sub(xi, g.mul(&[scale, expr(g, wanted)]));
            let same = cx
                .prover
                .identity(&appell, &[difference], &motion.manifold, "");
            assert!(matches!(same, Verdict::Proved(_)), "{same:?}");
        }
    });
}

/// T3 §6, case 1: x x' + y y' = 0 is holonomic. In the frame X1 = x ∂y - y ∂x, X2 = ∂z, X3 = x ∂x + y ∂y, with gravity along z, the
/// constant field along X1 gives the moment of momentum; with the gauge t the fall joins it.
#[test]
fn a_holonomic_constraint_in_its_frame() {
    let cylinder = framed(
        "x y z",
        "m (x'^2 + y'^2 + z'^2)/2 - m g z",
        &[("c", "x x' + y y'")],
        &[
            ("u", "(x y' - y x')/(x^2 + y^2)"),
            ("w", "z'"),
            ("s", "(x x' + y y')/(x^2 + y^2)"),
        ],
        &[],
    );
    let moment = "m (x^2 + y^2) (x y' - y x')/(x^2 + y^2)";
    let found = solved(&cylinder, Chart::Adapted, &["1"], &[]);
    are(&cylinder, &found, &[moment]);
    let g = &cylinder.graph;
    assert!(g.is_zero(found[0].xi[1]) && g.is_zero(found[0].gauge));
    let found = solved(&cylinder, Chart::Adapted, &["1"], &["t", "z"]);
    are(&cylinder, &found, &[moment, "z' + g t"]);
    // The bracket of the leaf with the fields across it vanishes: no reaction and no L_α stay in the equations.
    with(&cylinder, |cx| {
        let n = Embedded::of(cx).unwrap();
        let all = n.gyro.concat().into_iter().chain(n.gyro_time.clone());
        let all: Vec<Expr> = all.collect();
        let verdict = cx.prover.identity(&cylinder, &all, n.manifold(), "");
        assert!(matches!(verdict, Verdict::Proved(_)), "{verdict:?}");
    });
}

/// T3 §6, case 2: L = v²/2 with the force Q = -c v, which is no potential's: δ = 0, ξ = -1, g = c q solve (14), G = v + c q. As Ω is not
/// closed, L_ȲΩ = Ȳ ⌟ dΩ need not vanish for the field of an integral: here it is c dv ∧ dt.
#[test]
fn friction_in_the_natural_basis() {
    let body = framed("q", "q'^2/2", &[], &[], &[("q", "-c q'")]);
    let found = solved(&body, Chart::Natural, &["1"], &["q"]);
    are(&body, &found, &["q' + c q"]);
    let g = &body.graph;
    let ratio = g.div(found[0].gauge, found[0].xi[0]);
    assert_eq!(ratio, expr(g, "-c q"));
    // Without the gauge there is none.
    are(&body, &solved(&body, Chart::Natural, &["1"], &[]), &[]);
}

/// Where a force pulls along x the momentum along x has no field, and that along y keeps its own.
#[test]
fn a_potential_that_the_printed_condition_forgets() {
    let pulled = framed(
        "x y z",
        "(x'^2 + y'^2 + z'^2)/2 - c x",
        &[PLANE],
        &[("h", "x'"), ("k", "y'"), ("s", "z' - y x'")],
        &[],
    );
    let found = solved(&pulled, Chart::Adapted, &ROOTS, &[]);
    are(&pulled, &found, &["y'"]);
}

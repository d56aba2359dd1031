//! Dimensions and closed forms of T3 §8, from families that are given.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::{expr, system, with_motion as with};
use chetaev_geometry::noether::family::{Family, Letter};
use chetaev_geometry::noether::search::{exhaust, Exhausted, Integral, Table};
use chetaev_geometry::noether::special::{Special, Term, Tie};
use chetaev_mechanics::System;
use chetaev_symbolic::{Expr, Rational, Verdict};

fn letters(system: &System, texts: &[&str]) -> Vec<Letter> {
    let g = &system.graph;
    texts.iter().map(|t| Letter::plain(expr(g, t))).collect()
}

fn search(system: &System, velocities: &[&str], functions: &[&str], degree: u32) -> Exhausted {
    let (velocities, functions) = (letters(system, velocities), letters(system, functions));
    let family = Family::over(&velocities, &functions, degree);
    with(system, |cx, motion| exhaust(cx, motion, &family).unwrap())
}

/// The integrals are these up to constant factors.
fn are(system: &System, found: &Exhausted, expected: &[&str]) {
    let texts: Vec<String> = found.integrals.iter().map(|i| text(system, i)).collect();
    assert_eq!(found.dimension, expected.len(), "{texts:?}");
    assert_eq!(found.integrals.len(), expected.len(), "{texts:?}");
    assert!(
        found.error_bound_log2 < -100.0,
        "{}",
        found.error_bound_log2
    );
    for wanted in expected {
        let is_there = found
            .integrals
            .iter()
            .any(|i| is_multiple(system, i, wanted));
        assert!(is_there, "{wanted} is not among {texts:?}");
    }
}

/// Proportional: `G dH - H dG = 0` in every direction along N.
fn is_multiple(system: &System, integral: &Integral, wanted: &str) -> bool {
    let g = &system.graph;
    let wanted = expr(g, wanted);
    with(system, |cx, motion| {
        let gradients = motion.gradients(&[integral.value, wanted]);
        let residuals: Vec<_> = gradients[0]
            .iter()
            .zip(&gradients[1])
            .map(|(&da, &db)| g.sub(g.mul(&[integral.value, db]), g.mul(&[wanted, da])))
            .collect();
        let same = cx.prover.identity(system, &residuals, &motion.manifold, "");
        matches!(same, Verdict::Proved(_)) && matches!(integral.verdict, Verdict::Proved(_))
    })
}

fn text(system: &System, integral: &Integral) -> String {
    system.graph.text(integral.shown)
}

const PARTICLE: &str = "(x'^2 + y'^2 + z'^2)/2";

/// T3 §8.2: dimensions 1, 3, 2, 5.
#[test]
fn particle_on_z_is_y_dx() {
    let system = system("x y z", PARTICLE, &[("c", "z' - y x'")]);
    let polynomials = ["y", "y^2"];
    let roots = ["y", "y^2", "sqrt(1+y^2)", "y sqrt(1+y^2)"];
    let velocities = ["x'", "y'"];
    are(
        &system,
        &search(&system, &velocities, &polynomials, 1),
        &["y'"],
    );
    are(
        &system,
        &search(&system, &velocities, &polynomials, 2),
        &["y'", "(1+y^2) x'^2", "y'^2"],
    );
    are(
        &system,
        &search(&system, &velocities, &roots, 1),
        &["y'", "sqrt(1+y^2) x'"],
    );
    let five = search(&system, &velocities, &roots, 2);
    assert_eq!(five.dimension, 5);
    assert_eq!(five.integrals.len(), 5);
    assert_eq!(five.integrals.iter().filter(|i| i.independent).count(), 2);
}

const SLED: &str = "m (x'^2 + y'^2 + b^2 phi'^2)/2";
const BLADE: (&str, &str) = ("blade", "x' sin(phi) - y' cos(phi)");
/// η1 along the blade and η2 = φ'.
const ALONG: &str = "(x' cos(phi) + y' sin(phi))";

/// T3 §8.4: exactly four linear in η over {1, x, y, sin φ, cos φ}.
#[test]
fn sled_on_the_level() {
    let system = system("x y phi", SLED, &[BLADE]);
    let found = search(
        &system,
        &[ALONG, "phi'"],
        &["x", "y", "sin(phi)", "cos(phi)"],
        1,
    );
    let x = format!("phi' x - {ALONG} sin(phi)");
    let y = format!("phi' y + {ALONG} cos(phi)");
    are(&system, &found, &[ALONG, "phi'", &x, &y]);
    assert!(
        found.integrals.iter().all(|i| i.independent),
        "4 of 5 dimensions of N"
    );
}

/// T3 §8.4 on a slope: four of degree two, two more with {φ, sin φ cos φ, sin² φ}, one of which depends on the others.
#[test]
fn sled_on_a_slope() {
    let slope = format!("{SLED} + m gamma x");
    let system = system("x y phi", &slope, &[BLADE]);
    let functions = ["x", "y", "sin(phi)", "cos(phi)"];
    are(
        &system,
        &search(&system, &[ALONG, "phi'"], &functions, 1),
        &["phi'"],
    );
    let fall = format!("{ALONG} phi' - gamma sin(phi)");
    let energy = format!("{ALONG}^2 - 2 gamma x");
    let square = "phi'^2".to_owned();
    let found = search(&system, &[ALONG, "phi'"], &functions, 2);
    let texts: Vec<String> = found.integrals.iter().map(|i| text(&system, i)).collect();
    are(&system, &found, &["phi'", &energy, &fall, &square]);
    let more = [
        "x",
        "y",
        "sin(phi)",
        "cos(phi)",
        "phi",
        "sin(phi) cos(phi)",
        "sin(phi)^2",
    ];
    let found = search(&system, &[ALONG, "phi'"], &more, 2);
    let texts_more: Vec<String> = found.integrals.iter().map(|i| text(&system, i)).collect();
    assert_eq!(found.dimension, 6, "{texts:?} {texts_more:?}");
    assert_eq!(
        found.integrals.iter().filter(|i| i.independent).count(),
        4,
        "{texts_more:?}"
    );
}

const APPELL: &str = "m (x'^2 + y'^2 + z'^2)/2 - m g z";
const CONE: (&str, &str) = ("cone", "z' - a sqrt(x'^2 + y'^2)");

/// T3 §8.5: one of degree 1, with the time; the energy besides at degree 2; the ratio among the quotients.
#[test]
fn appells_example() {
    let system = system("x y z", APPELL, &[CONE]);
    let velocities = ["x'", "y'", "z'"];
    let time = "z' + a^2 g t/(1 + a^2)";
    let energy = "m (x'^2 + y'^2 + z'^2)/2 + m g z";
    are(
        &system,
        &search(&system, &velocities, &["t", "z"], 1),
        &[time],
    );
    are(
        &system,
        &search(&system, &velocities, &["t", "z"], 2),
        &[time, energy],
    );
    let mut family = Family::over(&letters(&system, &velocities), &[], 0);
    for member in [
        vec![(0, 1), (1, -1)],
        vec![(1, 1), (0, -1)],
        vec![(0, 1), (2, -1)],
    ] {
        family.push(member);
    }
    let found = with(&system, |cx, motion| exhaust(cx, motion, &family).unwrap());
    assert_eq!(found.dimension, 3);
    assert!(found.integrals[0].independent && !found.integrals[1].independent);
}

const TOP: &str = "(I1 (phi' sin(theta) sin(psi) + theta' cos(psi))^2 + I2 (phi' sin(theta) cos(psi) - theta' sin(psi))^2 + I3 (phi' cos(theta) + psi')^2)/2";
const OMEGA: [&str; 3] = [
    "(phi' sin(theta) sin(psi) + theta' cos(psi))",
    "(phi' sin(theta) cos(psi) - theta' sin(psi))",
    "(phi' cos(theta) + psi')",
];

/// T3 §8.6: none of degree 1, two of degree 2, one of degree 1 where I1 = I2.
#[test]
fn eulers_top() {
    let general = system("phi theta psi", TOP, &[]);
    are(&general, &search(&general, &OMEGA, &[], 1), &[]);
    let found = search(&general, &OMEGA, &[], 2);
    let texts: Vec<String> = found.integrals.iter().map(|i| text(&general, i)).collect();
    assert_eq!(
        (found.dimension, found.integrals.len()),
        (2, 2),
        "{texts:?}"
    );
    let symmetric = system("phi theta psi", &TOP.replace("I2", "I1"), &[]);
    are(&symmetric, &search(&symmetric, &OMEGA, &[], 1), &[OMEGA[2]]);
}

/// T3 §8.6: η3 where I1 = I2 is found and reported by the search for general moments of inertia.
#[test]
fn special_values_of_parameters() {
    let general = system("phi theta psi", TOP, &[]);
    let family = Family::over(&letters(&general, &OMEGA), &[], 2);
    with(&general, |cx, motion| {
        let g = &general.graph;
        // For all moments of inertia: energy, and the square of the moment of momentum, of which those at special values are roots.
        let usual = [1, 2].map(|power| {
            let square = |i: usize| format!("I{}^{power}*({})^2", i + 1, OMEGA[i]);
            expr(g, &[0, 1, 2].map(square).join(" + "))
        });
        let table = Table::beside(motion, &family.letters, 7, &usual).unwrap();
        let symbol = |name: &str| g.intern_symbol(name, 0);
        let tie = |parameter: &str, other: &str| Tie::Equal(symbol(parameter), symbol(other));
        let ties = [tie("I2", "I1"), tie("I3", "I1")];
        let (special, missed) = table.special(cx, &[family], &ties, &[]);
        assert_eq!((special.len(), missed.len()), (2, 0));
        assert_eq!(special[0].integrals, [expr(g, OMEGA[2])]);
        assert_eq!(special[1].integrals, [expr(g, OMEGA[1])]);
    });
}

/// What is found automatically: T3 §8.2 and §8.5 without hints, and a system without integrals says what was exhausted.
#[test]
fn automatic_families() {
    let particle = system("x y z", PARTICLE, &[("c", "z' - y x'")]);
    let finding = crate::common::finding(&particle, "noether.family");
    assert!(
        matches!(finding.verdict, Verdict::Proved(_)),
        "{:?}",
        finding.verdict
    );
    let shown: Vec<String> = finding
        .formulas
        .iter()
        .map(|f| particle.graph.text(f.right))
        .collect();
    for wanted in ["y'", "x' sqrt(1 + y^2)"] {
        assert!(
            shown.iter().any(|text| text == wanted),
            "{wanted} is not among {shown:?}"
        );
    }
    let appell = system("x y z", APPELL, &[CONE]);
    let found = with(&appell, |cx, _| chetaev_geometry::noether::found::found(cx));
    let found = found.as_ref().as_ref().unwrap();
    for wanted in ["x'/y'", "sqrt(x'^2 + y'^2) + g a t/(1 + a^2)"] {
        let mut gradients: Vec<_> = found.integrals.iter().map(|i| i.value).collect();
        gradients.push(expr(&appell.graph, wanted));
        let rank = with(&appell, |cx, motion| {
            let matrix = motion.gradients(&gradients);
            cx.prover
                .rank(&appell, &matrix, &motion.manifold)
                .unwrap()
                .maximum
        });
        assert_eq!(
            rank,
            found.integrals.len(),
            "{wanted} is no function of those found"
        );
    }
    let driven = system("x", "x'^2/2 - x^4 + x t^3", &[]);
    let finding = crate::common::finding(&driven, "noether.family");
    let detail = finding.verdict.detail();
    assert!(matches!(finding.verdict, Verdict::Proved(_)) && finding.formulas.is_empty());
    assert!(
        detail.contains("exhausted") && detail.contains("dimension 0"),
        "{detail}"
    );
}

/// The Lane-Emden equation of index five, x'' + 2 x'/t + x^5 = 0, keeps t³ x'²/2 + t² x x'/2 + t³ x⁶/6 (by
/// Noether's theorem for the scaling t -> s t, x -> x/√s): its family has to grow as far as t³ x⁶, and says how far it has grown.
#[test]
fn families_grow_with_the_budget() {
    let star = system("x", "t^2 (x'^2/2 - x^6/6)", &[]);
    let finding = crate::common::finding(&star, "noether.family");
    let found = with(&star, |cx, _| chetaev_geometry::noether::found::found(cx));
    let integrals = &found.as_ref().as_ref().unwrap().integrals;
    assert_eq!(integrals.len(), 1, "{:?}", finding.verdict);
    let wanted = "t^3 x'^2/2 + t^2 x x'/2 + t^3 x^6/6";
    assert!(is_multiple(&star, &integrals[0], wanted));
    let detail = finding.verdict.detail();
    let weights = detail.split("weight up to ").skip(1);
    let weights = weights.filter_map(|rest| rest.split(' ').next()?.parse::<u32>().ok());
    assert!(weights.max() >= Some(12), "{detail}");
}

/// A homogeneous sphere that rolls keeps the velocity of its centre and its spin about the vertical.
#[test]
fn rolling_sphere() {
    let sphere = system(
        "x y phi theta psi",
        "m (x'^2 + y'^2)/2 + J (phi'^2 + theta'^2 + psi'^2 + 2 phi' psi' cos(theta))/2",
        &[
            (
                "roll_x",
                "x' - r (theta' sin(phi) - psi' sin(theta) cos(phi))",
            ),
            (
                "roll_y",
                "y' + r (theta' cos(phi) + psi' sin(theta) sin(phi))",
            ),
        ],
    );
    let velocities = ["x'", "y'", "phi'", "theta'", "psi'"];
    let found = search(&sphere, &velocities, &["sin(theta)", "cos(theta)"], 1);
    // The angular velocity ω is constant in space, so its product with the axis of the ball is constant too: ω·(ω × e) = 0.
    let spin = "psi' + phi' cos(theta)";
    are(
        &sphere,
        &found,
        &["x'", "y'", "phi' + psi' cos(theta)", spin],
    );
}

/// Values of one parameter where more integrals appear: Hénon's and Heiles' potential with C = -6 D has a second integral quadratic in
/// the velocities (Bountis, Segur and Vivaldi, Phys. Rev. A 25, 1982); two springs with frequencies as 1 : 2.
#[test]
fn critical_values_of_parameters() {
    let at = |lagrangian: &str, names: [&str; 2], factor: (i64, u64), expected: &str| {
        let top = system("x y", lagrangian, &[]);
        crate::common::with_context(&top, |cx| {
            let found = chetaev_geometry::noether::found::found(cx);
            let found = found.as_ref().as_ref().unwrap();
            let g = &top.graph;
            let [parameter, other] = names.map(|name| g.intern_symbol(name, 0));
            let term = Term {
                coefficient: Rational::from_parts(factor.0.into(), factor.1.into()),
                powers: vec![(other, 1)],
            };
            let wanted = Tie::Is(parameter, vec![term]);
            let specials = &found.special.found;
            let special = specials.iter().find(|special| special.tie == wanted);
            let special = special.unwrap_or_else(|| panic!("{names:?} {specials:?}"));
            let [integral] = special.integrals[..] else {
                panic!("{special:?}");
            };
            // Proportional, by values at some places.
            let expected = expr(g, expected);
            let ratio = |seed: u64| {
                let point = crate::common::anywhere(g, &[integral, expected], seed);
                let values = crate::common::values(g, &[integral, expected], &point);
                values[0] / values[1]
            };
            let first = ratio(1);
            assert!(first.is_finite() && first != 0.0);
            assert!((2..6).all(|seed| (ratio(seed) / first - 1.0).abs() < 1e-9));
        });
    };
    // In the form (x'^2 + y'^2 + A x² + B y²)/2 + D x² y - C y³/3 with A = B = 1, the sign of C turned, and times D².
    at(
        "(x'^2 + y'^2)/2 - (x^2 + y^2)/2 - D x^2 y - C y^3/3",
        ["C", "D"],
        (6, 1),
        "D^2 (x^4 + 4 x^2 y^2) - 4 D x' (x' y - y' x) + 4 D x^2 y + 3 (x'^2 + x^2)",
    );
    at(
        "(x'^2 + y'^2)/2 - (a x^2 + b y^2)/2",
        ["b", "a"],
        (4, 1),
        "x' (x y' - y x') + a x^2 y",
    );
    // Frequencies occur as squares: the negative value is the same.
    at(
        "(x'^2 + y'^2)/2 - (a^2 x^2 + b^2 y^2)/2",
        ["b", "a"],
        (2, 1),
        "x' (x y' - y x') + a^2 x^2 y",
    );
}

/// Special values that need two conditions: Hénon's and Heiles' potential separates in x + y and x - y where both frequencies are
/// equal and C = -D (Aizawa and Saito, J. Phys. Soc. Japan 32, 1972), which neither does alone.
#[test]
fn critical_values_beside_an_equality() {
    let text = "(x'^2 + y'^2)/2 - (A x^2 + B y^2)/2 - D x^2 y + C y^3/3";
    let top = system("x y", text, &[]);
    let found = with(&top, |cx, _| chetaev_geometry::noether::found::found(cx));
    let found = found.as_ref().as_ref().unwrap();
    let g = &top.graph;
    let at: Vec<(Expr, Expr)> = [("C", "-D"), ("B", "A"), ("A", "2/7"), ("D", "3/5")]
        .map(|(name, value)| (expr(g, name), expr(g, value)))
        .to_vec();
    let replaced = |e: Expr| g.substitute(g.substitute(e, &at), &at);
    let here = |special: &&Special| {
        let pairs = special.tie.pairs(g);
        let holds = |&(a, b): &(Expr, Expr)| g.is_zero(replaced(g.sub(a, b)));
        pairs.len() == 2 && pairs.iter().all(holds)
    };
    let own: Vec<&Special> = found.special.found.iter().filter(here).collect();
    // The energy is what it is, not a multiple of it.
    assert!(found
        .integrals
        .iter()
        .any(|i| i.name.is_some() && i.value == top.energy()));
    let [special] = own[..] else {
        panic!("{:?}", found.special.found);
    };
    let [integral] = special.integrals[..] else {
        panic!("{special:?}");
    };
    let wanted = expr(g, "x' y' + A x y + D (x y^2 + x^3/3)");
    let es = [replaced(integral), replaced(wanted)];
    let ratio = |seed: u64| {
        let values = crate::common::values(g, &es, &crate::common::anywhere(g, &es, seed));
        values[0] / values[1]
    };
    assert!((2..6).all(|seed| (ratio(seed) / ratio(1) - 1.0).abs() < 1e-9));
}

/// Two equalities at once, each of which adds nothing: x⁴ and y⁴ in x + y and x − y, and Hénon's and Heiles' potential with the other
/// sign of C.
#[test]
fn two_equalities_at_once() {
    for (potential, wanted) in [
        (
            "C x^3 y + D x y^3",
            "x' y' + 2 B x y + D (x^4 + 6 x^2 y^2 + y^4)/4",
        ),
        ("D x^2 y + C y^3/3", "x' y' + 2 B x y + D (x y^2 + x^3/3)"),
    ] {
        let text = format!("(x'^2 + y'^2)/2 - A x^2 - B y^2 - ({potential})");
        let own = system("x y", &text, &[]);
        let g = &own.graph;
        let found = with(&own, |cx, _| chetaev_geometry::noether::found::found(cx));
        let found = found.as_ref().as_ref().unwrap();
        let equal = [("C", "D"), ("A", "B")];
        let both = |special: &&Special| {
            let pairs = special.tie.pairs(g);
            let (pair, turned) = (|(a, b)| (expr(g, a), expr(g, b)), |(a, b)| (b, a));
            let is_one = |own| pairs.contains(&pair(own)) || pairs.contains(&turned(pair(own)));
            pairs.len() == 2 && equal.into_iter().all(is_one)
        };
        let pairs: Vec<&Special> = found.special.found.iter().filter(both).collect();
        let [special] = pairs[..] else {
            panic!("{:?}", found.special.found);
        };
        let [integral] = special.integrals[..] else {
            panic!("{special:?}");
        };
        let es = [integral, expr(g, wanted)];
        let ratio = |seed: u64| {
            let values = crate::common::values(g, &es, &crate::common::anywhere(g, &es, seed));
            values[0] / values[1]
        };
        assert!((2..6).all(|seed| (ratio(seed) / ratio(1) - 1.0).abs() < 1e-9));
    }
}

/// What a special value adds is no function of what there is anyhow. On a surface of constant curvature there are three linear integrals,
/// which in the plane, a = 0, are x', y' and x y' - y x'; only the place at time zero is new. The skate drifting with b has
/// x' cos φ + y' sin φ - b φ and t φ' - φ for all b; nothing is new with b = 0. With the drift a t of z' - y x' the
/// quotient of sqrt(1 + y²) x' y' + a sqrt(1 + y²) and y' is simpler where a = 0; t y' - y is kept for all a.
#[test]
fn special_values_add_what_is_new() {
    let new = |system: &System| -> Vec<String> {
        crate::common::with_context(system, |cx| {
            let found = chetaev_geometry::noether::found::found(cx);
            let found = found.as_ref().as_ref().unwrap();
            let specials = found.special.found.iter();
            let integrals = specials.flat_map(|special| special.integrals.clone());
            integrals.map(|e| system.graph.text(e)).collect()
        })
    };
    // Garnier's potential is that of a central force where both frequencies are equal; the energy is there anyhow.
    let garnier = "(x'^2 + y'^2)/2 - a x^2 - b y^2 - e (x^2 + y^2)^2";
    let central = new(&system("x y", garnier, &[]));
    assert!(
        central.iter().all(|text| text == "x y' - y x'"),
        "{central:?}"
    );
    let curved = system("x y", "(x'^2 + y'^2)/(1 + a*(x^2 + y^2))^2/2", &[]);
    assert_eq!(new(&curved), ["t x' - x"]);
    let skate = system(
        "x y phi",
        "(m*(x'^2 + y'^2) + J*phi'^2)/2",
        &[("f", "y'*cos(phi) - x'*sin(phi) - b")],
    );
    assert_eq!(new(&skate), Vec::<String>::new());
    let drifting = system("x y z", PARTICLE, &[("c", "z' - y x' - a t")]);
    assert_eq!(new(&drifting), ["x' sqrt(1 + y^2)"]);
}

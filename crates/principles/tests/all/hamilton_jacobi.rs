//! The generalized method of Hamilton and Jacobi on the systems of T1 §6.1 (capability C11).

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::worked::{self, text};
use crate::common::{expr, finding, system, with_context, Text};
use chetaev_mechanics::system::CompleteIntegral;
use chetaev_mechanics::System;
use chetaev_principles::hamilton_jacobi::{elementary, levi_civita, separated, verified, Extremum};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::{Expr, Symbol};

const APPLICABLE: &str = "hamilton-jacobi.applicable";

fn word(system: &System, e: Expr) -> &'static str {
    let none = Assumptions::new();
    decide_zero(&system.graph, &ZeroTest::everywhere(&[e], &none)).word()
}

#[track_caller]
fn assert_hamiltonian(stated: &Text, expected: &str) {
    let system = system(stated);
    let g = &system.graph;
    let extremum = with_context(&system, |cx| Extremum::new(cx).unwrap());
    let difference = g.sub(extremum.hamiltonian, expr(g, expected));
    assert_eq!(word(&system, difference), "proved");
    // v = ∂H₁/∂π.
    for (&v, &pi) in extremum.velocities.iter().zip(&extremum.symbols) {
        let slope = g.diff(extremum.hamiltonian, pi);
        assert_eq!(word(&system, g.sub(v, slope)), "proved");
    }
}

#[test]
fn hamiltonians_of_the_extremum() {
    assert_hamiltonian(
        &worked::DISC,
        "(pi_theta + R (pi_x cos(phi) + pi_y sin(phi)))^2/(2 (I + m R^2)) + pi_phi^2/(2 J)",
    );
    assert_hamiltonian(
        &worked::PARTICLE,
        "1/2 ((pi_x + y pi_z)^2/(1 + y^2) + pi_y^2)",
    );
    // Affine: the part of the constraint free of velocities stays.
    let affine = text("x y", "1/2 (x'^2 + y'^2)", &[("c", "y' - b")]);
    assert_hamiltonian(&affine, "pi_x^2/2 + b pi_y - b^2/2");
}

/// The flow of H₁ of S4 is not its motion: y'' = −∂H₁/∂y − … does not vanish, where y'' = 0 on motions.
#[test]
fn the_particle_is_refused() {
    let particle = system(&worked::PARTICLE);
    let g = &particle.graph;
    let extremum = with_context(&particle, |cx| Extremum::new(cx).unwrap());
    let slope = g.diff(extremum.hamiltonian, g.intern_symbol("y", 0));
    let rate = g.neg(slope);
    let expected = expr(g, "(pi_x + y pi_z) (y pi_x - pi_z)/(1 + y^2)^2");
    assert_eq!(word(&particle, g.sub(rate, expected)), "proved");
    assert_eq!(word(&particle, rate), "refuted");
    let found = finding(&particle, APPLICABLE);
    assert_eq!(
        found.verdict.word(),
        "conditional",
        "{}",
        found.verdict.detail()
    );
    assert!(found.verdict.detail().contains("x' = 0 or y' = 0"));
}

#[test]
fn where_it_applies() {
    for (stated, expected) in [
        (&worked::DISC, "proved"),
        (&worked::CONE, "proved"),
        (&worked::INTEGRABLE, "proved"),
        (&worked::SKATE, "conditional"),
        (&worked::LEVEL_SKATE, "conditional"),
    ] {
        let system = system(stated);
        let found = finding(&system, APPLICABLE);
        let (word, detail) = (found.verdict.word(), found.verdict.detail());
        assert_eq!(word, expected, "{detail}");
    }
    let damped = Text {
        coordinates: "q",
        lagrangian: "1/2 q'^2",
        forces: &[("q", "-q'")],
        constraints: &[],
    };
    let found = finding(&system(&damped), APPLICABLE);
    assert_eq!(found.verdict.word(), "not-applicable");
}

fn integral(
    system: &System,
    action: &str,
    constants: &[&str],
    quadratures: &[(&str, &str)],
    motion: &[(&str, &str)],
) -> CompleteIntegral {
    let g = &system.graph;
    let symbol = |name: &str| -> Symbol { g.intern_symbol(name, 0) };
    CompleteIntegral {
        action: expr(g, action),
        constants: constants.iter().map(|name| symbol(name)).collect(),
        quadratures: quadratures
            .iter()
            .map(|(q, e)| (system.coordinate_index(q).unwrap(), expr(g, e)))
            .collect(),
        motion: motion
            .iter()
            .map(|(a, e)| (symbol(a), expr(g, e)))
            .collect(),
    }
}

/// Verdicts on the equation, det ∂²S/∂q∂α, Jacobi's theorem, and the motion.
fn words(system: &System, integral: &CompleteIntegral) -> [&'static str; 4] {
    with_context(system, |cx| {
        let extremum = Extremum::new(cx).unwrap();
        let found = verified(cx, &extremum, integral).unwrap();
        [
            found.equation.word(),
            found.nondegenerate.word(),
            found.theorem.word(),
            found.motion.word(),
        ]
    })
}

const DISC_ACTION: &str = "-E t + ax x + ay y + at theta";
const DISC_INTEGRAND: &str =
    "sqrt(2 J (E - (at + R (ax cos(phi) + ay sin(phi)))^2/(2 (I + m R^2))))";

/// S2: the complete integral of T1 §6.1 gives motions with ax = ay = 0 put in after differentiation, and only then.
#[test]
fn the_disc_is_integrated() {
    let disc = system(&worked::DISC);
    let constants = ["E", "ax", "ay", "at"];
    let quadratures = [("phi", DISC_INTEGRAND)];
    let zero = [("ax", "0"), ("ay", "0")];
    let s = integral(&disc, DISC_ACTION, &constants, &quadratures, &zero);
    assert_eq!(words(&disc, &s), ["proved"; 4]);
    let general = integral(&disc, DISC_ACTION, &constants, &quadratures, &[]);
    let found = with_context(&disc, |cx| {
        verified(cx, &Extremum::new(cx).unwrap(), &general).unwrap()
    });
    let detail = found.motion.detail();
    assert!(
        detail.contains("of a curve less that of the motion"),
        "{detail}"
    );
    assert_eq!(
        words(&disc, &general),
        ["proved", "proved", "proved", "refuted"]
    );
    // Zero before differentiation: two constants, and two of the four integrals are lost.
    let early = [("phi", "sqrt(2 J (E - at^2/(2 (I + m R^2))))")];
    let lost = integral(&disc, "-E t + at theta", &["E", "at"], &early, &[]);
    let found = words(&disc, &lost);
    assert_eq!((found[0], found[1]), ("proved", "refuted"));
    // A wrong S.
    let wrong = [("phi", "sqrt(2 J (E - at^2/(2 (I + m R^2))))")];
    let wrong = integral(&disc, DISC_ACTION, &constants, &wrong, &zero);
    assert_eq!(words(&disc, &wrong)[0], "refuted");
}

/// x = βx + R (θ'/φ') sin φ along S_α = β with ax = ay = 0.
#[test]
fn the_path_of_the_disc() {
    let disc = system(&worked::DISC);
    let g = &disc.graph;
    // ∂S/∂ax = x + ∫ ∂(integrand)/∂ax dφ, at ax = ay = 0.
    let slope = g.diff(expr(g, DISC_INTEGRAND), g.intern_symbol("ax", 0));
    let zero = [(expr(g, "ax"), g.zero()), (expr(g, "ay"), g.zero())];
    let slope = g.substitute(slope, &zero);
    // With at = (I + m R²) θ' and √(2 J (E − …)) = J φ' it is −R θ'/φ' cos φ.
    let rates = [
        (expr(g, "at"), expr(g, "(I + m R^2) a")),
        (expr(g, "E"), expr(g, "(I + m R^2) a^2/2 + J b^2/2")),
    ];
    let slope = g.substitute(slope, &rates);
    let squared = g.sub(g.mul(&[slope, slope]), expr(g, "(R a/b cos(phi))^2"));
    assert_eq!(word(&disc, squared), "proved");
}

#[test]
fn separation() {
    // S2 separates by itself, with ax = ay = 0 found from κ.
    let disc = system(&worked::DISC);
    with_context(&disc, |cx| {
        let extremum = Extremum::new(cx).unwrap();
        let integral = separated(cx, &extremum).unwrap();
        let names: Vec<String> = integral
            .motion
            .iter()
            .map(|&(s, _)| disc.graph.symbol_text(s))
            .collect();
        assert_eq!(names, ["alpha_x", "alpha_y"]);
        let found = verified(cx, &extremum, &integral).unwrap();
        assert_eq!(found.motion.word(), "proved", "{}", found.motion.detail());
    });
    let found = finding(&disc, "hamilton-jacobi.applicable#separated");
    assert_eq!(found.verdict.word(), "proved", "{}", found.verdict.detail());
    // Levi-Civita: polar coordinates separate Kepler's problem; a coupling x y does not separate in x, y.
    for (lagrangian, coordinates, expected) in [
        ("1/2 (r'^2 + r^2 phi'^2) + 1/r", "r phi", "proved"),
        (
            "1/2 (r'^2 + r^2 phi'^2) + (1 + cos(phi)/r)/r",
            "r phi",
            "proved",
        ),
        ("1/2 (r'^2 + r^2 phi'^2) + cos(phi)/r", "r phi", "refuted"),
        ("1/2 (x'^2 + y'^2) - x y", "x y", "refuted"),
        ("1/2 (x'^2 + y'^2) - x^2 - y^4", "x y", "proved"),
    ] {
        let system = system(&text(coordinates, lagrangian, &[]));
        let conditions = with_context(&system, |cx| levi_civita(cx, &Extremum::new(cx).unwrap()));
        assert_eq!(conditions.len(), 1);
        assert_eq!(word(&system, conditions[0]), expected, "{lagrangian}");
        let found = finding(&system, "hamilton-jacobi.applicable#separated");
        assert_eq!(found.verdict.word(), expected, "{}", found.verdict.detail());
    }
}

/// The complete integral of systems that contain two coordinates in H₁ and more, with the squares of the momenta by quadrature.
#[track_caller]
fn assert_separated(stated: &Text, expected: &[(&str, &str)]) {
    let system = system(stated);
    let g = &system.graph;
    with_context(&system, |cx| {
        let extremum = Extremum::new(cx).unwrap();
        let integral = separated(cx, &extremum).unwrap();
        assert_eq!(integral.quadratures.len(), expected.len());
        for (name, square) in expected {
            let own = system.coordinate_index(name).unwrap();
            let (_, found) = integral
                .quadratures
                .iter()
                .find(|(i, _)| *i == own)
                .unwrap();
            let difference = g.sub(g.mul(&[*found, *found]), expr(g, square));
            assert_eq!(
                word(&system, difference),
                "proved",
                "{name}: {}",
                g.text(*found)
            );
        }
        let found = verified(cx, &extremum, &integral).unwrap();
        let words = [
            &found.equation,
            &found.nondegenerate,
            &found.theorem,
            &found.motion,
        ];
        assert_eq!(words.map(|v| v.word()), ["proved"; 4]);
    });
    let found = finding(&system, "hamilton-jacobi.applicable#separated");
    assert_eq!(found.verdict.word(), "proved", "{}", found.verdict.detail());
}

/// Stäckel systems in their coordinates; alpha of a coordinate is the square of its momentum where the others' terms were taken.
#[test]
fn separation_with_several_coordinates() {
    // Two oscillators, one of them of the fourth degree: E − α/2 is the energy of the first.
    assert_separated(
        &text("x y", "1/2 (x'^2 + y'^2) - x^2 - y^4", &[]),
        &[("x", "2 E - alpha_y - 2 x^2"), ("y", "alpha_y - 2 y^4")],
    );
    // Kepler in space, r² π_r² + 2 V r² … = 2 E r²: at θ = π/2 the moment of momentum is α_θ + α_φ².
    assert_separated(
        &text(
            "r theta phi",
            "1/2 (r'^2 + r^2 theta'^2 + r^2 sin(theta)^2 phi'^2) + k/r",
            &[],
        ),
        &[
            ("r", "2 E + 2 k/r - (alpha_theta + alpha_phi^2)/r^2"),
            (
                "theta",
                "alpha_theta + alpha_phi^2 - alpha_phi^2/sin(theta)^2",
            ),
        ],
    );
    // Kepler in a uniform field, by parabolic coordinates x = u v, y = (u² − v²)/2, r = (u² + v²)/2:
    // π_u² − 2 k + b u⁴ − 2 E u² and π_v² − 2 k − b v⁴ − 2 E v² are opposite constants.
    assert_separated(
        &text(
            "u v",
            "1/2 (u^2 + v^2) (u'^2 + v'^2) + 2 k/(u^2 + v^2) - b/2 (u^2 - v^2)",
            &[],
        ),
        &[
            ("u", "4 k - alpha_v + 2 E u^2 - b u^4"),
            ("v", "alpha_v + 2 E v^2 + b v^4"),
        ],
    );
}

/// The rolling disc with a mass on a spring beside it, and a spring that turns it: φ and s are contained in H₁, and the motions have
/// α_x = α_y = 0 as without them.
#[test]
fn separation_of_a_nonholonomic_motion() {
    let disc = text(
        "theta phi s x y",
        "I/2 theta'^2 + J/2 phi'^2 + s'^2/2 - k/2 s^2 - c/2 phi^2 + m/2 (x'^2 + y'^2)",
        &[
            ("rolling_x", "x' - R cos(phi) theta'"),
            ("rolling_y", "y' - R sin(phi) theta'"),
        ],
    );
    let theta = "(alpha_theta + R (alpha_x cos(phi) + alpha_y sin(phi)))^2/(I + m R^2)";
    let phi = format!("J (2 E - alpha_s - {theta} - c phi^2)");
    let s = "alpha_s - k s^2";
    assert_separated(&disc, &[("phi", &phi), ("s", s)]);
}

/// Integrals of roots of polynomials of degree two are written out: their derivatives are the integrands, by differences.
#[test]
fn elementary_quadratures() {
    let oscillator = system(&text("x y", "1/2 (x'^2 + y'^2) - x^2 + x - 2 y^2", &[]));
    let unstable = system(&text("x", "1/2 x'^2 + x^2 - x", &[]));
    let falling = system(&text("x y", "1/2 (x'^2 + y'^2) - g y", &[]));
    for system in [oscillator, unstable, falling] {
        let g = &system.graph;
        with_context(&system, |cx| {
            let integral = separated(cx, &Extremum::new(cx).unwrap()).unwrap();
            for (i, integrand) in integral.quadratures {
                let q = system.coordinates[i].q_symbol;
                let closed = elementary(cx, integrand, q)[0].value;
                let at = |x: f64| {
                    let value = |s: Symbol| match g.symbol_text(s).as_str() {
                        "E" => Some(5.0),
                        "g" => Some(9.81),
                        _ if s == q => Some(x),
                        _ => Some(1.5),
                    };
                    g.evaluate_f64(&[closed, integrand], &value).unwrap()
                };
                let (low, high) = (at(0.1 - 1e-4), at(0.1 + 1e-4));
                let slope = (high[0] - low[0]) / 2e-4;
                assert!((slope - at(0.1)[1]).abs() < 1e-7, "{slope} {:?}", at(0.1));
            }
        });
    }
    let quartic = system_of_degree_four();
    with_context(&quartic, |cx| {
        let integral = separated(cx, &Extremum::new(cx).unwrap()).unwrap();
        let (i, integrand) = integral.quadratures[0];
        assert!(elementary(cx, integrand, quartic.coordinates[i].q_symbol).is_empty());
    });
}

fn system_of_degree_four() -> System {
    system(&text("x", "1/2 x'^2 - x^4", &[]))
}

/// Where a constraint holds a coordinate, H₁ may contain it and not its momentum: ½ X'² + x² y = E cannot hold for all y. And H₁ free of
/// such a coordinate separates, with quadratures for the others; a momentum that occurs linearly is found from a linear equation.
#[test]
fn coordinates_without_their_momenta() {
    const SEPARATED: &str = "hamilton-jacobi.applicable#separated";
    let held = text("x y", "1/2 (x'^2 + y'^2) - x^2 y", &[("c", "y'")]);
    let two = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2)",
        &[("c", "z' - y x'"), ("h", "y'")],
    );
    for stated in [&held, &two] {
        let found = finding(&system(stated), SEPARATED);
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), "refuted", "{detail}");
        assert!(detail.contains("contains y and not π_y"), "{detail}");
    }
    let free = text("x y", "1/2 (x'^2 + y'^2)", &[("c", "y'")]);
    let product = text("x y", "x' y' - x", &[]);
    let factor = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2)",
        &[("c", "(1 + x^2) (z' - y x')")],
    );
    for stated in [&free, &product, &factor] {
        let found = finding(&system(stated), SEPARATED);
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), "proved", "{detail}");
        assert!(!detail.contains("not even"), "{detail}");
    }
    // π_x π_y + x = E: π_x = (E − x)/α_y.
    let product = system(&product);
    let g = &product.graph;
    with_context(&product, |cx| {
        let integral = separated(cx, &Extremum::new(cx).unwrap()).unwrap();
        let (i, found) = integral.quadratures[0];
        assert_eq!(product.coordinates[i].name, "x");
        let difference = g.sub(found, expr(g, "(E - x)/alpha_y"));
        assert_eq!(word(&product, difference), "proved", "{}", g.text(found));
    });
}

/// The derivative of an antiderivative, by differences at a point, is the integrand there.
#[track_caller]
fn assert_antiderivative(
    system: &System,
    value: Expr,
    integrand: Expr,
    q: Symbol,
    numbers: &[(&str, f64)],
) {
    let g = &system.graph;
    let at = |x: f64| {
        let known = |s: Symbol| {
            let text = g.symbol_text(s);
            let own = numbers.iter().find(|(name, _)| *name == text);
            own.map(|&(_, x)| x).or((s == q).then_some(x))
        };
        g.evaluate_f64(&[value, integrand], &known).unwrap()
    };
    for x in [0.8, 1.1, 1.7] {
        let slope = (at(x + 1e-5)[0] - at(x - 1e-5)[0]) / 2e-5;
        assert!(
            (slope - at(x)[1]).abs() < 1e-7,
            "{slope} {:?} at {x}",
            at(x)
        );
    }
}

/// Kepler's radial integral ∫√(2 m E + 2 m k/r − α²/r²) dr, for an ellipse and a hyperbola. Over a period of an ellipse with k = m = 1 it is
/// 2π (k √(m/(−2 E)) − α) (A. Sommerfeld 1916), so that from pericentre to apocentre it is half of that.
#[test]
fn the_radial_integral_of_kepler() {
    let kepler = text("r phi", "m/2 (r'^2 + r^2 phi'^2) + k/r", &[]);
    let kepler = system(&kepler);
    let g = &kepler.graph;
    with_context(&kepler, |cx| {
        let integral = separated(cx, &Extremum::new(cx).unwrap()).unwrap();
        let (i, integrand) = integral.quadratures[0];
        let q = kepler.coordinates[i].q_symbol;
        let found = elementary(cx, integrand, q);
        assert_eq!(found.len(), 2);
        for energy in [-0.2, 0.3] {
            let numbers = [("m", 1.0), ("k", 1.0), ("alpha_phi", 0.9), ("E", energy)];
            let value = |e: Expr| {
                let known = |s: Symbol| {
                    let text = g.symbol_text(s);
                    numbers.iter().find(|(name, _)| *name == text).map(|n| n.1)
                };
                g.evaluate_f64(&[e], &known).unwrap()[0]
            };
            let own = found
                .iter()
                .find(|f| f.positive.iter().all(|&e| value(e) > 0.0))
                .unwrap();
            assert_antiderivative(&kepler, own.value, integrand, q, &numbers);
        }
        let (alpha, energy) = (0.9_f64, -0.2_f64);
        let numbers = [("m", 1.0), ("k", 1.0), ("alpha_phi", alpha), ("E", energy)];
        let at = |x: f64| {
            let known = |s: Symbol| {
                let text = g.symbol_text(s);
                let own = numbers.iter().find(|(name, _)| *name == text);
                own.map(|n| n.1).or((s == q).then_some(x))
            };
            g.evaluate_f64(&[found[0].value], &known).unwrap()[0]
        };
        // 2 E r² + 2 r − α² = 0.
        let root = (1.0 + 2.0 * energy * alpha * alpha).sqrt();
        let (low, high) = (
            (1.0 - root) / (-2.0 * energy),
            (1.0 + root) / (-2.0 * energy),
        );
        let half = std::f64::consts::PI * (1.0 / (-2.0 * energy).sqrt() - alpha);
        let inner = 1e-9;
        let difference = at(high * (1.0 - inner)) - at(low * (1.0 + inner));
        assert!((difference - half).abs() < 1e-3, "{difference} {half}");
    });
}

/// √X/q with a factor outside the root, and B = 0, C = 0: free fall along a ray, a free particle, and a cone.
#[test]
fn roots_over_the_coordinate() {
    let any = system(&text("r", "1/2 r'^2", &[]));
    let g = &any.graph;
    let q = any.coordinates[0].q_symbol;
    let numbers = [("a", 0.7), ("b", 3.0)];
    with_context(&any, |cx| {
        for integrand in [
            "sqrt(b - a^2/r^2)",
            "sqrt(b r - a^2)/r",
            "a sqrt(5 + b r - r^2)/r - 2",
            "sqrt(3/r - a^2/r^2)",
            "sqrt(2 r^2 + b r)/r",
            "a + b sqrt(4 r^2 - a^2)/r",
            "sqrt(2 b/r^2 - a^2)",
            "sqrt(5/r^2 - a^2)",
            "sqrt(2 b/r^2 + 3/r - a^2)",
        ] {
            let integrand = expr(g, integrand);
            let found = elementary(cx, integrand, q);
            let text = g.text(integrand);
            let own = found.last().unwrap_or_else(|| panic!("{text}"));
            assert_antiderivative(&any, own.value, integrand, q, &numbers);
        }
    });
}

/// A function is offered only where it may be real: not one for −w² > 0. Where a sign is open there is one for each.
#[test]
fn functions_that_are_nowhere_real() {
    let any = system(&text("r", "1/2 r'^2", &[]));
    let g = &any.graph;
    let q = any.coordinates[0].q_symbol;
    with_context(&any, |cx| {
        for (integrand, count) in [
            ("sqrt(b - w^2 r^2)", 1),
            ("sqrt(b + w^2 r^2)", 1),
            ("sqrt(b + c r^2)", 2),
            ("sqrt(b/r^2 - w^2)", 2),
            ("sqrt(w^2/r^2 + b/r + c)", 2),
            ("sqrt(a/r^2 + b/r + c)", 4),
        ] {
            let found = elementary(cx, expr(g, integrand), q);
            assert_eq!(found.len(), count, "{integrand}");
            for positive in found.iter().flat_map(|f| &f.positive) {
                let text = g.text(*positive);
                assert!(!text.contains('w'), "{integrand}: {text} > 0");
            }
        }
    });
}

/// z' = r² φ' in polar coordinates: λ = 0, so κ = 0 and the momenta are those of motions, with p_z = m z' = m r² φ' = p_φ. Cylinder
/// coordinates separate, and the constants of motions are tied by α_z = α_φ.
#[test]
fn constants_of_motions_that_are_equal() {
    let polar = text(
        "r phi z",
        "m/2 (r'^2 + r^2 phi'^2 + z'^2)",
        &[("c", "z' - r^2 phi'")],
    );
    let polar = system(&polar);
    let found = finding(&polar, "hamilton-jacobi.applicable#separated");
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "proved", "{detail}");
    assert!(
        detail.contains("alpha_z = alpha_phi put in after"),
        "{detail}"
    );
    with_context(&polar, |cx| {
        let integral = separated(cx, &Extremum::new(cx).unwrap()).unwrap();
        let g = &polar.graph;
        // (π_φ + r² π_z)²/(r² (1 + r²)) + π_r² = 2 m E.
        let expected = expr(g, "2 m E - (alpha_phi + r^2 alpha_z)^2/(r^2 (1 + r^2))");
        let square = g.powi(integral.quadratures[0].1, 2);
        assert_eq!(word(&polar, g.sub(square, expected)), "proved");
    });
}

/// S4: the equation separates, its curves are extremals. Those with α_x = α_z = 0 go along y, as the motions with x' = 0 do.
#[test]
fn extremals_that_are_motions() {
    let found = finding(
        &system(&worked::PARTICLE),
        "hamilton-jacobi.applicable#separated",
    );
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "proved", "{detail}");
    assert!(
        detail.contains("is a complete integral of S_t + H₁ = 0"),
        "{detail}"
    );
    assert!(
        detail.contains("not all of them are motions (motions are those with x' = 0 or y' = 0)"),
        "{detail}"
    );
    assert!(
        detail.contains("those with alpha_x = 0, alpha_z = 0 put in after differentiation are motions with x' = 0"),
        "{detail}"
    );
    assert!(!detail.contains("motions with y' = 0"), "{detail}");
    let captions: Vec<&str> = found.formulas.iter().map(|f| f.caption.as_str()).collect();
    assert!(
        captions.iter().any(|c| c.starts_with("S_y = ∫ g dy")),
        "{captions:?}"
    );
    assert_eq!(
        captions.iter().filter(|c| c.contains("(Jacobi)")).count(),
        3
    );
}

/// π and H₁ by (q, v, κ) where the constraint is nonlinear: of Appell and Hamel's π_z = m z' + κ, and H₁ is the energy, as f is homogeneous; on
/// motions κ = m ρ/a + C, so that π_x = −C a x'/ρ.
#[test]
fn momenta_of_a_nonlinear_constraint() {
    let cone = system(&worked::CONE);
    let g = &cone.graph;
    let found = finding(&cone, APPLICABLE);
    let detail = found.verdict.detail();
    let why =
        "H₁ is written by (q, v, κ) and not by (q, π, t): `cone` is nonlinear in the velocities";
    assert!(detail.contains(why), "{detail}");
    let value = |start: &str, left: Option<&str>| {
        let is_own = |f: &&chetaev_mechanics::claims::Formula| {
            f.caption.starts_with(start) && left.map(|s| expr(g, s)) == f.left
        };
        found.formulas.iter().find(is_own).map(|f| f.right)
    };
    let energy = value("H₁ = Σ π v − L by (q, v, κ)", None).unwrap();
    let expected = expr(g, "1/2 m (x'^2 + y'^2 + z'^2) + m g z");
    let difference = g.substitute(
        g.sub(energy, expected),
        &[(expr(g, "z'"), expr(g, "a sqrt(x'^2 + y'^2)"))],
    );
    assert_eq!(word(&cone, difference), "proved", "{}", g.text(energy));
    for (name, expected) in [
        ("pi_x", "-const_cone a x'/sqrt(x'^2 + y'^2)"),
        ("pi_y", "-const_cone a y'/sqrt(x'^2 + y'^2)"),
    ] {
        let along = value("the same along every motion", Some(name)).unwrap();
        assert_eq!(word(&cone, g.sub(along, expr(g, expected))), "proved");
    }
}

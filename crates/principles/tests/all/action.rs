//! Principles of least action: the identity (18), Lagrange's (19) and Jacobi's (21), (22) principles, and the parametric form (28)–(31)
//! of T1, on the systems named there.
//! (Capabilities C8, C9, C13.)

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::worked::{self, text};
use crate::common::{expr, finding, system, with_context, Text};
use chetaev_mechanics::claims::formulation::derive;
use chetaev_mechanics::{Context, Equations, Manifold, System};
use chetaev_principles::action::Asynchronous;
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::{Expr, Verdict};

/// A charge in a uniform magnetic field.
const CHARGE: Text = text("x y", "1/2 (x'^2 + y'^2) + B/2 (x y' - y x')", &[]);
/// A point thrown.
const THROWN: Text = text("x y", "1/2 (x'^2 + y'^2) - g y", &[]);
/// Affine, with forces of the reaction that work.
const AFFINE: Text = text(
    "x y z",
    "1/2 (x'^2 + y'^2 + z'^2)",
    &[("c", "z' - y x' - b")],
);
/// The time in a homogeneous constraint.
const RHEONOMIC: Text = text("x y", "1/2 (x'^2 + y'^2)", &[("c", "y' - t x'")]);
/// The time in the Lagrangian.
const DRIVEN: Text = text("x", "1/2 m x'^2 - x sin(t)", &[]);

fn word(stated: &Text, id: &str) -> (&'static str, String) {
    let system = system(stated);
    let found = finding(&system, id);
    (found.verdict.word(), found.verdict.detail().to_string())
}

#[track_caller]
fn assert_word(stated: &Text, id: &str, expected: &str) -> String {
    let (word, detail) = word(stated, id);
    assert_eq!(word, expected, "{id}: {detail}");
    detail
}

/// With y' = t x' no varied curve of the same energy has fixed ends, so Lagrange's action is stationary on every motion, Hamilton's
/// only at rest: where the constraints contain the time one does not tell the other.
#[test]
fn constraints_with_the_time_part_lagrange_from_hamilton() {
    let detail = assert_word(&RHEONOMIC, "action.lagrange", "proved");
    let open = "is open: the constraints contain the time";
    assert!(detail.contains(open), "{detail}");
    assert_word(&RHEONOMIC, "hamilton.stationary", "refuted");
}

/// (18) holds for every system: with forces, with the time, with any constraints.
#[test]
fn the_action_changes_by_its_end_terms() {
    for stated in [
        &worked::SKATE,
        &worked::DISC,
        &worked::CONE,
        &worked::PARTICLE,
        &AFFINE,
        &RHEONOMIC,
        &DRIVEN,
        &CHARGE,
    ] {
        assert_word(stated, "action.identity", "proved");
    }
    let damped = Text {
        coordinates: "q",
        lagrangian: "1/2 m q'^2 - 1/2 c q^2",
        forces: &[("q", "-k q'")],
        constraints: &[],
    };
    let detail = assert_word(&damped, "action.identity", "proved");
    assert!(detail.contains("∫Σ Q δq dt"), "{detail}");
}

fn refuted(cx: &Context<'_>, residual: Expr) {
    let verdict = cx
        .prover
        .identity(cx.system, &[residual], &Manifold::default(), "");
    assert_eq!(verdict.word(), "refuted", "{}", verdict.detail());
}

/// Without H Δt, or with Δv = D(Δq), the identity is wrong.
#[test]
fn wrong_end_terms_and_rules() {
    let system = system(&worked::PARTICLE);
    with_context(&system, |cx| {
        let g = &system.graph;
        let varied = Asynchronous::new(&system);
        let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
        let pairs = momenta.iter().zip(varied.coordinates());
        let momentum: Vec<Expr> = pairs.map(|(&p, d)| g.mul(&[p, d])).collect();
        let lefts = system.lagrange_left_sides();
        let pairs = lefts.iter().zip(&varied.displacements);
        let work: Vec<Expr> = pairs.map(|(&e, &d)| g.mul(&[e, d])).collect();
        let shared = [
            varied.vary(system.lagrangian),
            g.mul(&[system.lagrangian, varied.time_rate]),
            g.add(&work),
        ];
        let without_energy = g.neg(varied.derivative(g.add(&momentum)));
        refuted(cx, g.add(&[g.add(&shared), without_energy]));
        let energy = g.mul(&[system.energy(), varied.time]);
        let ends = g.sub(g.add(&momentum), energy);
        let right = g.add(&[g.add(&shared), g.neg(varied.derivative(ends))]);
        let free = Manifold::default();
        let verdict = cx.prover.identity(&system, &[right], &free, "");
        assert_eq!(verdict.word(), "proved");
        // Δv without the change of the time adds Σ p v D(Δt).
        let slip: Vec<Expr> = momenta
            .iter()
            .zip(&system.coordinates)
            .map(|(&p, c)| g.mul(&[p, c.v, varied.time_rate]))
            .collect();
        refuted(cx, g.add(&[right, g.add(&slip)]));
    });
}

#[test]
fn lagranges_principle() {
    for stated in [
        &worked::SKATE,
        &worked::DISC,
        &worked::CONE,
        &worked::PARTICLE,
        &worked::INTEGRABLE,
        &RHEONOMIC,
        &CHARGE,
    ] {
        assert_word(stated, "action.lagrange", "proved");
    }
    let detail = assert_word(&worked::PARTICLE, "action.lagrange", "proved");
    assert!(detail.contains("x' = 0"), "{detail}");
    let detail = assert_word(&AFFINE, "action.lagrange", "not-applicable");
    assert!(detail.contains("∂f/∂v·v"), "{detail}");
    assert_word(&DRIVEN, "action.lagrange", "not-applicable");
}

/// T1 §5.3: on S4 with Δq = (a, b, y a), ΔH = 0 is an equation for D(Δt), and the integrand is D(Σ p Δq).
#[test]
fn lagranges_principle_of_the_particle() {
    let system = system(&worked::PARTICLE);
    let g = &system.graph;
    let read = |text: &str| expr(g, text);
    let varied = Asynchronous::total(&system);
    let energy = varied.vary(system.energy());
    let rate = g.div(
        g.substitute(energy, &[(varied.time_rate, g.zero())]),
        read("x'^2 + y'^2 + z'^2"),
    );
    let integrand = read("x'^2 + y'^2 + z'^2");
    let left = g.add(&[
        varied.vary(integrand),
        g.mul(&[integrand, varied.time_rate]),
        g.neg(varied.derivative(read("x' Delta_x + y' Delta_y + z' Delta_z"))),
    ]);
    let left = g.substitute(left, &[(varied.time_rate, rate)]);
    let virtual_ones = [
        ("Delta_z'", "y Delta_x' + y' Delta_x"),
        ("Delta_z", "y Delta_x"),
        ("z''", "y x'' + x' y'"),
        ("z'", "y x'"),
    ];
    let motion = [("x''", "-y x' y'/(1 + y^2)"), ("y''", "0")];
    let put = |e: Expr, pairs: &[(&str, &str)]| {
        let pairs: Vec<(Expr, Expr)> = pairs.iter().map(|(a, b)| (read(a), read(b))).collect();
        g.substitute(e, &pairs)
    };
    let on_motion = put(put(left, &virtual_ones), &motion);
    let none = Assumptions::new();
    let word = |e: Expr| decide_zero(g, &ZeroTest::everywhere(&[e], &none)).word();
    assert_eq!(word(on_motion), "proved");
    // Not on other curves, and not for other displacements.
    assert_eq!(word(put(left, &virtual_ones)), "refuted");
    let others = [("z''", "y x'' + x' y'"), ("z'", "y x'")];
    assert_eq!(word(put(put(left, &others), &motion)), "refuted");
}

/// The stated path equations, left minus right, with functions of τ put in.
fn on_path(path: &Equations, system: &System, curve: &[(&str, &str)]) -> Vec<Expr> {
    let g = &system.graph;
    let tau = g.intern_symbol("tau", 0);
    let mut pairs: Vec<(Expr, Expr)> = Vec::new();
    for &(name, value) in curve {
        let value = expr(g, value);
        if let Some(i) = system.coordinate_index(name) {
            let first = g.diff(value, tau);
            let w = &path.variables[i];
            pairs.push((system.coordinates[i].q, value));
            pairs.push((w.value, first));
            pairs.push((g.symbol(&w.name, 1), g.diff(first, tau)));
        } else {
            pairs.push((expr(g, name), value));
        }
    }
    let stated = path.groups[0].equations.iter();
    let residuals: Vec<Expr> = stated.map(|e| g.sub(e.left, e.right)).collect();
    g.substitute_all(&residuals, &pairs)
}

/// Largest residual along τ = 0.1 … 1.3.
fn residual_along(system: &System, residuals: &[Expr], parameters: &[(&str, f64)]) -> f64 {
    let g = &system.graph;
    let value = |tau: f64| {
        let values = g.evaluate_f64(residuals, &|s| match g.symbol_name(s) {
            "tau" => Some(tau),
            name => parameters.iter().find(|(n, _)| *n == name).map(|(_, x)| *x),
        });
        values.unwrap()
    };
    let points = (1..=7).map(|j| 0.1 + 0.17 * f64::from(j));
    points.flat_map(value).fold(0.0, |m: f64, x| m.max(x.abs()))
}

#[track_caller]
fn assert_path(stated: &Text, curve: &[(&str, &str)], parameters: &[(&str, f64)], holds: bool) {
    let system = system(stated);
    let path = with_context(&system, |cx| derive(cx, "jacobi").unwrap());
    let residuals = on_path(&path, &system, curve);
    let size = residual_along(&system, &residuals, parameters);
    assert_eq!(size < 1e-12, holds, "{curve:?}: {size:e}");
    assert!(holds || size > 1e-3, "{size:e}");
}

/// T1 §5.4: S4 with h = 1, circles of radius √(2h)/B one way only, and a parabola.
#[test]
fn paths_of_jacobis_principle() {
    let particle = [
        ("x", "asinh(tau)"),
        ("y", "tau"),
        ("z", "sqrt(1 + tau^2)"),
        ("h", "1"),
        ("mu_c", "(1 + tau^2)^(-3/2)"),
    ];
    assert_path(&worked::PARTICLE, &particle, &[], true);
    let mut wrong = particle;
    wrong[4].1 = "0";
    assert_path(&worked::PARTICLE, &wrong, &[], false);
    let clockwise = [
        ("x", "sqrt(2 h)/B cos(tau)"),
        ("y", "-sqrt(2 h)/B sin(tau)"),
    ];
    let field = [("B", 1.7), ("h", 0.6)];
    assert_path(&CHARGE, &clockwise, &field, true);
    let reversed = [clockwise[0], ("y", "sqrt(2 h)/B sin(tau)")];
    assert_path(&CHARGE, &reversed, &field, false);
    // x' = 2, y' = 3 − g t at the start, h = 13/2.
    let parabola = [("x", "2 tau"), ("y", "3 tau - g tau^2/2"), ("h", "13/2")];
    assert_path(&THROWN, &parabola, &[("g", 1.3)], true);
    let other_energy = [parabola[0], parabola[1], ("h", "7")];
    assert_path(&THROWN, &other_energy, &[("g", 1.3)], false);
}

#[test]
fn jacobis_principle() {
    for stated in [
        &worked::SKATE,
        &worked::DISC,
        &worked::CONE,
        &worked::PARTICLE,
        &CHARGE,
        &THROWN,
    ] {
        let detail = assert_word(stated, "action.jacobi", "proved");
        // Nothing is known of the sign of a mass that is a letter.
        let is_positive = !stated.lagrangian.contains('m');
        assert_eq!(
            detail.contains("fails at rest only"),
            is_positive,
            "{detail}"
        );
    }
    for (stated, hypothesis) in [
        (&AFFINE, "model.constraints-homogeneous"),
        (&RHEONOMIC, "model.constraints-scleronomic"),
        (&DRIVEN, "model.lagrangian-autonomous"),
    ] {
        let detail = assert_word(stated, "action.jacobi", "not-applicable");
        assert!(detail.contains(hypothesis), "{detail}");
    }
    let indefinite = text("x y", "1/2 (x'^2 - y'^2) - x", &[]);
    let detail = assert_word(&indefinite, "action.jacobi", "proved");
    assert!(detail.contains("where L₂(q, v) = 0"), "{detail}");
    // Rolling coins are stationary for every motion, skates are not.
    let coin = assert_word(&worked::DISC, "action.jacobi", "proved");
    assert!(coin.contains("for every motion"), "{coin}");
    let skate = assert_word(&worked::LEVEL_SKATE, "action.jacobi", "proved");
    assert!(skate.contains("exactly where Hamilton's is"), "{skate}");
}

/// z' = a y x' + b x y' is integrable for a = b (A = a − b), so that least action is stationary for every motion there, as Hamilton's is.
#[test]
fn particular_parameters_are_those_of_hamilton() {
    let lagrangian = "1/2 (x'^2 + y'^2 + z'^2)";
    let stated = text("x y z", lagrangian, &[("c", "z' - a y x' - b x y'")]);
    for id in ["action.lagrange", "action.jacobi"] {
        let detail = assert_word(&stated, id, "proved");
        assert!(detail.contains("exactly where Hamilton's is"), "{detail}");
        assert!(
            detail.contains("where b = a, every motion does"),
            "{detail}"
        );
    }
}

#[test]
fn parametric_principle() {
    for stated in [&worked::SKATE, &worked::CONE, &worked::PARTICLE, &CHARGE] {
        let detail = assert_word(stated, "action.parametric", "proved");
        assert!(detail.contains("Jacobi's"), "{detail}");
    }
    for stated in [&AFFINE, &RHEONOMIC, &DRIVEN] {
        let detail = assert_word(stated, "action.parametric", "proved");
        assert!(detail.contains("stops at `model."), "{detail}");
        assert!(detail.contains("K is an integral"), "{detail}");
    }
    let singular = text("x y", "1/2 x'^2", &[("c", "y' - x x'")]);
    let detail = assert_word(&singular, "action.parametric", "proved");
    assert!(detail.contains("more than one relation"), "{detail}");
}

/// T1 §6.4: with K² in the place of K the canonical equations say nothing, dK² = 0 where K = 0; with e^s K they do.
#[test]
fn the_square_of_k_is_none() -> Result<(), SolveError> {
    let system = system(&worked::PARTICLE);
    let g = &system.graph;
    let k = expr(g, "p_t + (p_x^2 + p_y^2 + p_z^2)/2");
    let on_zero = [(expr(g, "p_t"), expr(g, "-(p_x^2 + p_y^2 + p_z^2)/2"))];
    let momenta = ["p_x", "p_y", "p_z", "p_t"].map(|name| g.intern_symbol(name, 0));
    let rates = |of: Expr| g.substitute_all(&g.gradient(of, &momenta), &on_zero);
    let none = Assumptions::new();
    let vanish = |es: &[Expr]| decide_zero(g, &ZeroTest::everywhere(es, &none)).word();
    assert_eq!(vanish(&rates(g.mul(&[k, k]))), "proved");
    assert_eq!(vanish(&rates(k)), "refuted");
    // Another function with the same zeros changes τ alone: x'_a are proportional.
    let scaled = rates(g.mul(&[expr(g, "2 + x^2"), k]));
    let ratio: Vec<Expr> = scaled
        .iter()
        .zip(rates(k))
        .map(|(&a, b)| g.sub(a, g.mul(&[expr(g, "2 + x^2"), b])))
        .collect();
    assert_eq!(vanish(&ratio), "proved");
    Ok(())
}

/// T1 §6.3, S4: Λ = (x'² + y'² + z'²)/(2 t'), F = (z' − y x')/t', and y = (p, −H).
#[test]
fn extended_functions_of_the_particle() {
    let system = system(&worked::PARTICLE);
    let g = &system.graph;
    let equations = with_context(&system, |cx| derive(cx, "parametric").unwrap());
    let object = |name: &str| {
        let found = equations.objects.iter().find(|o| o.name == name);
        found.unwrap().value
    };
    let none = Assumptions::new();
    let same = |e: Expr, text: &str| {
        let difference = g.sub(e, expr(g, text));
        let word = decide_zero(g, &ZeroTest::everywhere(&[difference], &none)).word();
        assert_eq!(word, "proved", "{text}");
    };
    let lagrangian = object("Lambda");
    same(lagrangian, "(w_x^2 + w_y^2 + w_z^2)/(2 w_t)");
    same(object("F_c"), "(w_z - y w_x)/w_t");
    let momenta = ["w_x", "w_t"].map(|w| g.diff(lagrangian, g.intern_symbol(w, 0)));
    same(momenta[0], "w_x/w_t");
    same(momenta[1], "-((w_x/w_t)^2 + (w_y/w_t)^2 + (w_z/w_t)^2)/2");
}

/// μ is t'² λ, not λ, unless τ is the time.
#[test]
fn multipliers_of_the_parameter() {
    let system = system(&worked::PARTICLE);
    let g = &system.graph;
    let equations = with_context(&system, |cx| derive(cx, "parametric").unwrap());
    let object = equations.objects.iter().find(|o| o.name == "mu_c").unwrap();
    let difference = g.sub(object.value, expr(g, "w_t^2 (w_x/w_t) (w_y/w_t)/(1 + y^2)"));
    let none = Assumptions::new();
    let verdict = |e: Expr| decide_zero(g, &ZeroTest::everywhere(&[e], &none));
    let on_set = |e: Expr| g.substitute(e, &[(expr(g, "w_z"), expr(g, "y w_x"))]);
    assert!(matches!(verdict(on_set(difference)), Verdict::Proved(_)));
    let same = g.sub(object.value, expr(g, "(w_x/w_t) (w_y/w_t)/(1 + y^2)"));
    assert_eq!(verdict(on_set(same)).word(), "refuted");
}

/// ½ (x' + y')² has a singular ∂²L/∂v∂v that no coordinate shows by itself: no H, and the rest is decided as with a mass that is zero.
#[test]
fn parametric_form_with_a_singular_mass_matrix() {
    let singular = text("x y z", "1/2 (x' + y')^2 + z'^2/2", &[("c", "y' - x'")]);
    let found = finding(&system(&singular), "action.parametric");
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "proved", "{detail}");
    assert!(detail.contains("more than one relation"), "{detail}");
}

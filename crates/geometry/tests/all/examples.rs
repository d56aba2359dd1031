//! Closed forms of T3 §6 and §8 that the other files do not look at, and a table of which test checks what.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::{expr, framed, system, with_motion as with};
use chetaev_geometry::noether::embedded::Embedded;
use chetaev_geometry::noether::family::{Family, Letter};
use chetaev_geometry::noether::generator::Generator;
use chetaev_geometry::noether::search::exhaust;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::{Characteristics, Manifold, System};
use chetaev_symbolic::{Expr, Graph, Verdict};
use std::path::Path;

fn natural<'a>(cx: &Context<'a>) -> Embedded<'a> {
    let chart = Characteristics::independent_velocities(cx.system, cx.terms, cx.selection);
    Embedded::by(cx, Some(chart.unwrap())).unwrap()
}

/// Whether functions vanish on a manifold: a verdict, never a guess.
fn vanish(cx: &Context<'_>, manifold: &Manifold, residuals: &[Expr]) -> bool {
    match cx.prover.identity(cx.system, residuals, manifold, "") {
        Verdict::Proved(_) => true,
        Verdict::Refuted(_) => false,
        other => panic!("{other:?}"),
    }
}

/// Whether `X̄G` is a given function, or zero.
fn rate_is(system: &System, integral: &str, rate: &str) -> bool {
    let g = &system.graph;
    with(system, |cx, motion| {
        let own = motion.derivatives(&[expr(g, integral)])[0];
        vanish(cx, &motion.manifold, &[g.sub(own, expr(g, rate))])
    })
}

fn is_kept(system: &System, integral: &str) -> bool {
    rate_is(system, integral, "0")
}

const SLED: &str = "m (x'^2 + y'^2 + b^2 phi'^2)/2";
const BLADE: (&str, &str) = ("blade", "x' sin(phi) - y' cos(phi)");
const ALONG: &str = "(x' cos(phi) + y' sin(phi))";

/// T3 §8.4 on a slope: the two that {φ, sin φ cos φ, sin² φ} add, in closed form; the first is a function of the others.
#[test]
fn the_sled_on_a_slope_in_closed_form() {
    let slope = system("x y phi", &format!("{SLED} + m gamma x"), &[BLADE]);
    let first = format!("2 phi'^2 x - 2 {ALONG} phi' sin(phi) + gamma sin(phi)^2");
    let second =
        format!("2 phi'^2 y + 2 {ALONG} phi' cos(phi) - gamma sin(phi) cos(phi) - gamma phi");
    for integral in [&first, &second] {
        assert!(is_kept(&slope, integral), "{integral}");
    }
    let (fall, energy) = (
        format!("({ALONG} phi' - gamma sin(phi))"),
        format!("({ALONG}^2 - 2 gamma x)"),
    );
    let difference = format!("gamma ({first}) - {fall}^2 + phi'^2 {energy}");
    let g = &slope.graph;
    with(&slope, |cx, motion| {
        assert!(vanish(cx, &motion.manifold, &[expr(g, &difference)]));
        let four: Vec<Expr> = ["phi'", &fall, &energy, &second]
            .iter()
            .map(|text| expr(g, text))
            .collect();
        let rank = |es: &[Expr]| {
            let matrix = motion.gradients(es);
            let rank = cx.prover.rank(&slope, &matrix, &motion.manifold);
            rank.unwrap().maximum
        };
        assert_eq!(rank(&four), 4);
        assert_eq!(rank(&[&four[..], &[expr(g, &first)]].concat()), 4);
    });
    // Of the signs and factors each one matters.
    assert!(!is_kept(&slope, &first.replace("+ gamma", "- gamma")));
    assert!(!is_kept(
        &slope,
        &second.replace("- gamma phi", "+ gamma phi")
    ));
}

/// T3 §8.4: λ = -m φ' (x' cos φ + y' sin φ) and φ'' = 0; in the frame η1' = η2' = 0, on a slope η1' = γ cos φ.
#[test]
fn the_sled_in_its_frame() {
    let level = system("x y phi", SLED, &[BLADE]);
    assert!(is_kept(&level, ALONG) && is_kept(&level, "phi'"));
    let slope = system("x y phi", &format!("{SLED} + m gamma x"), &[BLADE]);
    assert!(rate_is(&slope, ALONG, "gamma cos(phi)") && is_kept(&slope, "phi'"));
    let speed = format!("-phi' {ALONG} sin(phi)");
    assert!(rate_is(&level, "x'", &speed));
}

const APPELL: &str = "m (x'^2 + y'^2 + z'^2)/2 - m g z";
const CONE: (&str, &str) = ("cone", "z' - a sqrt(x'^2 + y'^2)");
const RHO: &str = "sqrt(x'^2 + y'^2)";

/// T3 §8.5: C, ∂C, L̄, L_3, K = G = 0, the equations, the eigenvalues of W̄, and the Killing equations as they are written there.
#[test]
fn appells_machine_in_closed_form() {
    let appell = system("x y z", APPELL, &[CONE]);
    let g = &appell.graph;
    for (v, rate) in [("x'", "x'"), ("y'", "y'")] {
        assert!(rate_is(
            &appell,
            v,
            &format!("-g a {rate}/((1 + a^2) {RHO})")
        ));
    }
    with(&appell, |cx, _| {
        let n = natural(cx);
        let is = |e: Expr, text: &str| vanish(cx, n.manifold(), &[g.sub(e, expr(g, text))]);
        let slopes = n.embedding.slopes[0].clone();
        assert!(is(slopes[0], &format!("a x'/{RHO}")) && is(slopes[1], &format!("a y'/{RHO}")));
        let bends = n.by_speeds(&slopes);
        for (i, j, text) in [
            (0, 0, "y'^2"),
            (1, 1, "x'^2"),
            (0, 1, "-x' y'"),
            (1, 0, "-x' y'"),
        ] {
            assert!(is(bends[i][j], &format!("a ({text})/{RHO}^3")));
        }
        assert!(is(
            n.terms.lagrangian,
            "m (1 + a^2) (x'^2 + y'^2)/2 - m g z"
        ));
        assert!(is(n.terms.dependent_momenta[0], &format!("m a {RHO}")));
        let brackets = [n.terms.k.concat(), n.terms.g.concat()].concat();
        assert!(vanish(cx, n.manifold(), &brackets));
        // Along η the eigenvalue is m (1 + a²), across it m.
        let row = |i: usize, v: [&str; 2]| {
            let parts = [0, 1].map(|j| g.mul(&[n.mass[i][j], expr(g, v[j])]));
            g.add(&parts)
        };
        for i in 0..2 {
            let along = format!("m (1 + a^2) {}", ["x'", "y'"][i]);
            let across = format!("m {}", ["(-y')", "x'"][i]);
            assert!(is(row(i, ["x'", "y'"]), &along) && is(row(i, ["-y'", "x'"]), &across));
        }
        killing_as_written(cx, &n);
    });
}

/// The left sides of T3 §8.5 for a field and a gauge that solve nothing.
fn killing_as_written(cx: &Context<'_>, n: &Embedded<'_>) {
    let g = &cx.system.graph;
    let (xi, gauge) = (["x' y' + y", "y'^2 - t x'"], "x' z + y'^2 t");
    let generator = Generator {
        integral: g.zero(),
        delta: g.zero(),
        xi: xi.iter().map(|e| expr(g, e)).collect(),
        chi: xi.iter().map(|e| expr(g, e)).collect(),
        zeta: vec![g.zero(); 2],
        gauge: n.restricted(expr(g, gauge)),
    };
    let [first, second] = xi;
    // ∂ξ and ∂g by hand.
    let speeds = [("y'", "-t", "z", "y'"), ("x'", "2 y'", "2 y' t", "-x'")];
    let cross = format!("m a^2 (y' ({first}) - x' ({second}))/{RHO}^2");
    for (i, (of_first, of_second, of_gauge, factor)) in speeds.into_iter().enumerate() {
        let text = format!(
            "{factor} {cross} + m (1 + a^2) (x' ({of_first}) + y' ({of_second})) - ({of_gauge})"
        );
        let difference = g.sub(generator.killing_speeds(n)[i], expr(g, &text));
        assert!(vanish(cx, n.manifold(), &[difference]), "{text}");
    }
    // (14b): p_i Zξ^i is there for a field that depends on the place and the time.
    let drift = format!(
        "-m g a (x' ({first}) + y' ({second}))/{RHO} + m (1 + a^2) (x' y' + y' (-x')) - (x' a {RHO} + y'^2)"
    );
    let difference = g.sub(generator.killing_drift(n), expr(g, &drift));
    assert!(vanish(cx, n.manifold(), &[difference]), "{drift}");
}

/// T3 §8.5: the square of the integral with the time is in the family when t² is, and not before.
#[test]
fn the_square_of_the_time_brings_a_square() {
    let appell = system("x y z", APPELL, &[CONE]);
    let g = &appell.graph;
    let letters = |texts: &[&str]| -> Vec<Letter> {
        let texts = texts.iter();
        texts.map(|t| Letter::plain(expr(g, t))).collect()
    };
    let dimension = |functions: &[&str]| {
        let family = Family::over(&letters(&["x'", "y'", "z'"]), &letters(functions), 2);
        with(&appell, |cx, motion| exhaust(cx, motion, &family).unwrap())
    };
    assert_eq!(dimension(&["t", "z"]).dimension, 2);
    let more = dimension(&["t", "z", "t^2"]);
    assert_eq!(more.dimension, 3);
    assert_eq!(more.integrals.iter().filter(|i| i.independent).count(), 2);
}

/// T3 §6, inverse theorem: any gauge instead of any δ, `δ = (g - G + p_i W̄^ij ∂_jG)/L̄`, also solves (14).
#[test]
fn a_generator_with_a_gauge_of_choice() {
    let appell = system("x y z", APPELL, &[CONE]);
    let g = &appell.graph;
    with(&appell, |cx, _| {
        let n = natural(cx);
        let integral = expr(g, "x'/y'");
        for gauge in ["0", "t", "x'/y' + z"] {
            let still = Generator::of(&n, integral, g.zero()).unwrap();
            let gauge = n.restricted(expr(g, gauge));
            // With δ = 0 the gauge is G + p_i χ^i.
            let delta = g.div(g.sub(gauge, still.gauge), n.terms.lagrangian);
            let moving = Generator::of(&n, integral, delta).unwrap();
            let mut residuals = moving.killing_speeds(&n);
            residuals.push(moving.killing_drift(&n));
            residuals.push(g.sub(moving.gauge, gauge));
            assert!(vanish(cx, n.manifold(), &residuals));
        }
    });
}

const TOP: &str = "(I1 (phi' sin(theta) sin(psi) + theta' cos(psi))^2 + I2 (phi' sin(theta) cos(psi) - theta' sin(psi))^2 + I3 (phi' cos(theta) + psi')^2)/2";
const OMEGA: [(&str, &str); 3] = [
    ("w1", "phi' sin(theta) sin(psi) + theta' cos(psi)"),
    ("w2", "phi' sin(theta) cos(psi) - theta' sin(psi)"),
    ("w3", "phi' cos(theta) + psi'"),
];

/// T3 §8.6: Σ I η² and Σ I² η² are what degree two has; the brackets of the fields enter (10), whose part with L_α is void.
#[test]
fn eulers_top_in_closed_form() {
    let top = framed("phi theta psi", TOP, &[], &OMEGA, &[]);
    let g = &top.graph;
    let sum = |power: u32| {
        let parts = OMEGA.iter().enumerate();
        let parts = parts.map(|(i, (_, w))| format!("I{}^{power} ({w})^2", i + 1));
        parts.collect::<Vec<String>>().join(" + ")
    };
    for power in [1, 2] {
        assert!(is_kept(&top, &sum(power)));
    }
    assert!(!is_kept(&top, &sum(3)));
    with(&top, |cx, motion| {
        let letters: Vec<Letter> = OMEGA
            .iter()
            .map(|(_, w)| Letter::plain(expr(g, w)))
            .collect();
        let found = exhaust(cx, motion, &Family::over(&letters, &[], 2)).unwrap();
        let mut all: Vec<Expr> = found.integrals.iter().map(|i| i.value).collect();
        assert_eq!(all.len(), 2);
        all.extend([expr(g, &sum(1)), expr(g, &sum(2))]);
        let rank = cx
            .prover
            .rank(&top, &motion.gradients(&all), &motion.manifold);
        assert_eq!(rank.unwrap().maximum, 2);
        let n = Embedded::of(cx).unwrap();
        assert!(n.terms.dependent_momenta.is_empty() && n.embedding.slopes.is_empty());
        assert!(!vanish(cx, n.manifold(), &n.terms.k.concat()));
    });
}

/// Three components.
type Vector = [Expr; 3];

fn vector(g: &Graph, texts: [&str; 3]) -> Vector {
    texts.map(|text| expr(g, text))
}

fn dot(g: &Graph, a: &Vector, b: &Vector) -> Expr {
    let parts: Vec<Expr> = a.iter().zip(b).map(|(&x, &y)| g.mul(&[x, y])).collect();
    g.add(&parts)
}

fn cross(g: &Graph, a: &Vector, b: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| g.sub(g.mul(&[a[i], b[j]]), g.mul(&[a[j], b[i]])))
}

fn minus(g: &Graph, a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| g.sub(a[i], b[i]))
}

/// T3 (18), (18a) for two particles, a point and a direction that are free functions of the time: identities before any equation of
/// motion, with m r'' for the forces. Without the motion of the point they fail.
#[test]
fn moving_axes_as_identities() {
    let names = "x1 y1 z1 x2 y2 z2 a1 a2 a3 e1 e2 e3";
    let lagrangian: Vec<String> = names.split(' ').map(|q| format!("{q}'^2/2")).collect();
    let free = system(names, &lagrangian.join(" + "), &[]);
    let g = &free.graph;
    let moved = |v: &Vector| v.map(|e| free.total_derivative(e));
    let (axis, point) = (vector(g, ["e1", "e2", "e3"]), vector(g, ["a1", "a2", "a3"]));
    let (mut momentum, mut moment) = (vec![g.zero(); 3], g.zero());
    let (mut force, mut torque, mut spin) = (g.zero(), g.zero(), g.zero());
    for (mass, place) in [("m1", ["x1", "y1", "z1"]), ("m2", ["x2", "y2", "z2"])] {
        let (mass, place) = (expr(g, mass), vector(g, place));
        let speed = moved(&place);
        let impulse = speed.map(|e| g.mul(&[mass, e]));
        let push = moved(&impulse);
        let arm = minus(g, &place, &point);
        for (sum, part) in momentum.iter_mut().zip(impulse) {
            *sum = g.add(&[*sum, part]);
        }
        moment = g.add(&[moment, dot(g, &cross(g, &arm, &impulse), &axis)]);
        force = g.add(&[force, dot(g, &push, &axis)]);
        torque = g.add(&[torque, dot(g, &cross(g, &arm, &push), &axis)]);
        spin = g.add(&[spin, dot(g, &cross(g, &arm, &impulse), &moved(&axis))]);
    }
    let momentum: Vector = [momentum[0], momentum[1], momentum[2]];
    let carried = dot(g, &momentum, &cross(g, &moved(&point), &axis));
    let along = g.sub(
        free.total_derivative(dot(g, &momentum, &axis)),
        g.add(&[dot(g, &momentum, &moved(&axis)), force]),
    );
    let about = free.total_derivative(moment);
    with(&free, |cx, _| {
        let none = Manifold::default();
        let whole = g.sub(about, g.add(&[carried, spin, torque]));
        assert!(vanish(cx, &none, &[along, whole]));
        assert!(!vanish(cx, &none, &[g.add(&[whole, carried])]));
    });
}

/// T3 §8.3 for the skate: along the blade the momentum is kept; along a fixed direction its rate is λ (e_x sin φ - e_y cos φ); on an
/// incline the force along the blade is m γ cos φ.
#[test]
fn momenta_of_the_skate() {
    let level = system("x y phi", SLED, &[BLADE]);
    let blade = format!("m {ALONG}");
    assert!(is_kept(&level, &blade));
    let reaction = format!("(-m phi' {ALONG})");
    let fixed = format!("{reaction} (c sin(phi) - s cos(phi))");
    assert!(rate_is(&level, "m (c x' + s y')", &fixed));
    assert!(!is_kept(&level, "m (c x' + s y')"));
    let incline = system("x y phi", &format!("{SLED} + m gamma x"), &[BLADE]);
    assert!(rate_is(&incline, &blade, "m gamma cos(phi)"));
}

/// T3 §8.3: a particle on a line that turns, r = s e(t), keeps neither its momentum along the line, d/dt (m s') = m s θ'² with
/// e = (cos θ, sin θ), θ = t²/2, nor anything that its energy would give; (18a) is its equation of motion.
#[test]
fn a_particle_on_a_turning_line() {
    let (x, y) = ("s cos(t^2/2)", "s sin(t^2/2)");
    let square = "s'^2 + s^2 t^2";
    let line = system("s", &format!("m ({square})/2"), &[]);
    assert!(rate_is(&line, "m s'", "m s t^2"));
    // K·e' + F·e with F·e = 0: no force acts along the line.
    let g = &line.graph;
    let speed = |text: &str| line.total_derivative(expr(g, text));
    let turned = [expr(g, "-t sin(t^2/2)"), expr(g, "t cos(t^2/2)")];
    let carried = [x, y]
        .into_iter()
        .zip(turned)
        .map(|(place, e)| g.mul(&[expr(g, "m"), speed(place), e]));
    let carried = g.add(&carried.collect::<Vec<Expr>>());
    with(&line, |cx, motion| {
        let difference = g.sub(carried, expr(g, "m s t^2"));
        assert!(vanish(cx, &motion.manifold, &[difference]));
    });
}

const FORMS: &str = "crates/mechanics/tests/all/formulations";
const HERE: &str = "crates/geometry/tests/all";
const WHOLE: &str = "tests/tests/all";
const PRINCIPLES: &str = "crates/principles/tests/all";
const LAWS: &str = "crates/laws/src";

/// Section of T3, what is checked, where, and the test.
const MAP: &str = "\
§1 | brackets of frames, antisymmetry | forms/acceptance_frames.rs | brackets_of_frames
§1 | Jacobi's identity with the index 0 | forms/acceptance_frames.rs | jacobi_identity_of_frames
§1 | both sides of (1) | forms/acceptance_frames.rs | both_sides_of_the_structure_equations
§1 | rotations | forms/frames.rs | structure_coefficients_of_rotations
§1 | the sled's frame | forms/frames.rs | structure_coefficients_of_the_sled
§2 | Θ of one coordinate | forms/acceptance_frames.rs | the_cartan_form_of_one_coordinate
§2 | (4) against d | forms/acceptance_frames.rs | the_exterior_derivative_of_cartan_forms
§2 | another frame, the same Θ | forms/acceptance_frames.rs | a_change_of_the_frame_leaves_the_cartan_form
§2 | the claim cartan.form | here/generators.rs | cartan_forms
§3 | the list of examples, weak and strong | here/frobenius.rs | verdicts_of_the_literature
§3 | sub-systems | here/frobenius.rs | sub_systems_are_reported
§3 | a factor changes the strong test only | here/frobenius.rs | a_factor_changes_the_strong_condition_only
§3 | remark 3° | here/frobenius.rs | the_cartan_form_of_a_total_derivative_is_exact
§3 | remark 3° in frames, Θ(hf) | forms/acceptance_frames.rs | cartan_forms_of_total_derivatives_and_products
§3 | the three-form of z' - y x' | forms/acceptance_frames.rs | the_three_form_of_frobenius
§4 | X ⌟ Ω = 0 | forms/acceptance_embedding.rs | the_lagrange_field_annihilates_the_two_form
§4 | R2 and R3 | forms/acceptance_embedding.rs | regularity_of_the_lagrange_field
§4 | Euler's equations | forms/frames.rs | euler_equations_of_a_free_body
§5 | (10) is (7) on N | forms/acceptance_embedding.rs | the_embedded_equations_are_the_contracted_ones
§5 | W̄ = Bᵀ W B | forms/acceptance_embedding.rs | the_mass_matrix_of_the_embedding
§5 | G + A ∂C is the curvature | forms/acceptance_embedding.rs | the_bracket_part_is_the_curvature
§5 | (11a) | forms/acceptance_embedding.rs | the_bracket_lemma
§5 | Ω̄ is a restriction | forms/acceptance_embedding.rs | the_embedded_two_form_is_a_restriction
§5 | Lemmas 1 and 2 | forms/acceptance_embedding.rs | the_kernel_and_the_image_of_the_embedded_two_form
§5 | the claim noether.embedded | here/generators.rs | the_motion_is_the_kernel
§5 | integrable constraints close V̄ | forms/acceptance_embedding.rs | integrable_constraints_close_the_fields
§5 | rank 2k, not 2k + 1 | forms/corrections/zhao.rs | zhao_lemma_1_the_rank_is_even
§5 | (12) with frozen accelerations | forms/corrections/zhao.rs | zhao_12_nielsen_with_frozen_accelerations
§6 | Theorems A and B in two charts, δ = 0, 1, a function | here/generators.rs | noethers_theorem_for_the_examples
§6 | what is no integral fails (14b) | here/generators.rs | what_is_no_integral_has_no_generator
§6 | the sign in (13) | forms/corrections/zhao.rs | zhao_13_the_sign_of_the_momenta
§6 | the indices of (15b), (15c) | here/generators.rs | zhao_15_the_indices_of_the_structure_equations
§6 | (16) | forms/corrections/zhao.rs | zhao_16_the_velocity_part_of_the_generator
§6 | acceptance of (16) | here/generators.rs | components_along_the_velocities
§6 | case 1, holonomic | here/killing.rs | a_holonomic_constraint_in_its_frame
§6 | case 2, friction | here/killing.rs | friction_in_the_natural_basis
§6 | case 3, adapted frame | here/killing.rs | momenta_of_the_particle
§6 | inverse theorem with g given | here/examples.rs | a_generator_with_a_gauge_of_choice
§6 | inverse theorem for what a model states | whole/symmetries.rs | integrals_on_a_part_of_the_states
§6 | Theorem C, the extension searched | whole/symmetries.rs | the_sled_by_its_reduced_system
§7 | direct search, small families | here/first_integrals.rs | particle_on_z_is_y_dx
§7 | Killing-type search | here/killing.rs | fields_of_appells_machine
§7 | generalized momenta | here/killing.rs | momenta_of_the_sled
§7 | special values of parameters | here/first_integrals.rs | special_values_of_parameters
§7 | families without hints, what was exhausted | here/first_integrals.rs | automatic_families
§7 | random systems with a known integral | whole/laws.rs | known_integrals
§7 | false integrals are seen | laws/laws/integrals.rs | small_changes_along_a_motion_are_seen
§8.1 | conditions of the energy, its rate | princ/energy.rs | the_rate_of_the_energy_is_the_closed_form
§8.1 | gyroscopic forces | princ/energy.rs | gyroscopic_forces_have_no_power
§8.1 | affine constraints | princ/acceptance.rs | energy_laws_of_affine_and_nonlinear_constraints
§8.1 | δ = 1 and δ = 0 | here/generators.rs | the_energy_is_translation_in_time
§8.2 | (17) with ψ^i X_i L̄ | forms/corrections/zhao.rs | zhao_17_generalized_momentum
§8.2 | a potential | here/killing.rs | a_potential_that_the_printed_condition_forgets
§8.2 | the frame and its equations | forms/frames.rs | the_particle_in_its_adapted_frame
§8.2 | dimensions 1, 3, 2, 5 | here/first_integrals.rs | particle_on_z_is_y_dx
§8.2 | ψ = (1/√(1+y²), 0) | here/killing.rs | momenta_of_the_particle
§8.3 | (18), (18a) | here/examples.rs | moving_axes_as_identities
§8.3 | a turning line | here/examples.rs | a_particle_on_a_turning_line
§8.3 | the skate: blade, fixed direction, incline | here/examples.rs | momenta_of_the_skate
§8.3 | the search for directions | whole/symmetries.rs | momentum_along_the_blade
§8.3 | the search for axes | whole/symmetries.rs | two_projectiles
§8.3 | directions that turn with the time | here/moving.rs | blades_that_are_turned
§8.3 | unit vectors, the point of contact | here/moving.rs | what_is_the_same_is_named_once
§8.4 | λ, φ'' = 0, the frame | here/examples.rs | the_sled_in_its_frame
§8.4 | the extension of the reaction | forms/corrections/zhao.rs | zhao_sled_extension_of_the_reaction
§8.4 | four linear ones | here/first_integrals.rs | sled_on_the_level
§8.4 | the slope: dimensions 1, 4, 6 | here/first_integrals.rs | sled_on_a_slope
§8.4 | the slope: closed forms, the dependence | here/examples.rs | the_sled_on_a_slope_in_closed_form
§8.5 | C, W̄, (14), the equations | here/examples.rs | appells_machine_in_closed_form
§8.5 | W̄ is not the Hessian of L̄ | here/generators.rs | embedded_mass_matrix
§8.5 | ξ and g of the ratio | here/generators.rs | appells_ratio
§8.5 | ξ with the mass | forms/corrections/zhao.rs | zhao_appell_the_mass_in_the_generator
§8.5 | the path | forms/corrections/zhao.rs | zhao_appell_the_path
§8.5 | families of degree 1 and 2, the ratio | here/first_integrals.rs | appells_example
§8.5 | t² brings the square | here/examples.rs | the_square_of_the_time_brings_a_square
§8.5 | λ | forms/acceptance_motion.rs | accelerations_and_multipliers_of_the_notes
§8.6 | dimensions 0, 2, 1 | here/first_integrals.rs | eulers_top
§8.6 | both quadratic ones, (10) without constraints | here/examples.rs | eulers_top_in_closed_form
§9 | an implicit constraint | forms/acceptance_motion.rs | an_implicit_constraint
§10 | identities of the exterior calculus | laws/laws/exterior.rs | -
";

#[test]
fn every_check_has_its_test() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    for line in MAP.lines() {
        let parts: Vec<&str> = line.split(" | ").collect();
        let [section, what, place, test] = parts[..] else {
            panic!("{line}");
        };
        let (folder, file) = place.split_once('/').unwrap();
        let folder = match folder {
            "forms" => FORMS,
            "here" => HERE,
            "whole" => WHOLE,
            "princ" => PRINCIPLES,
            "laws" => LAWS,
            other => panic!("{other} is no folder"),
        };
        let text = std::fs::read_to_string(root.join(folder).join(file)).unwrap();
        let text = text.replace("\r\n", "\n");
        // A law has no name of its own; that it is among the laws is looked at by those.
        let is_there = match test {
            "-" => !text.is_empty(),
            _ => text.lines().zip(text.lines().skip(1)).any(|(above, line)| {
                above.trim() == "#[test]" && line.trim().starts_with(&format!("fn {test}("))
            }),
        };
        assert!(
            is_there,
            "{section}, {what}: {folder}/{file} has no `{test}`"
        );
    }
    for section in [
        "§1", "§2", "§3", "§4", "§5", "§6", "§7", "§8.1", "§8.2", "§8.3", "§8.4", "§8.5", "§8.6",
    ] {
        let covered = MAP
            .lines()
            .any(|line| line.starts_with(&format!("{section} |")));
        assert!(covered, "{section} has no test");
    }
}

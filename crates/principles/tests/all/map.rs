//! Which test checks what: the acceptance checks of T1 (§1–§9, capabilities C1–C22), each with a file and a test in it. A test
//! reads this table and fails where something that it names is gone. The last test is the numerical check of (19) that T1 §8 suggests.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::worked::PARTICLE;
use crate::common::{expr, system, with_context};
use chetaev_mechanics::claims::formulation::{derive, REFERENCE};
use chetaev_symbolic::{Expr, Symbol};
use std::path::Path;

const FORMS: &str = "crates/mechanics/tests/all/formulations";
const HERE: &str = "crates/principles/tests/all";
const WHOLE: &str = "tests/tests/all";

/// Section, what is checked, where, and the test. Folders: `forms`, `here`, `whole` for the three constants above.
const MAP: &str = "\
§0 C1 | f_v B = 0, (C) and (C') give one space | forms/acceptance_motion.rs | virtual_displacements
§0 C1 | the square of a constraint is rejected | whole/formulations.rs | the_square_of_a_constraint_is_named_as_such
§0 C1 | R1–R5; R2 without R3 and R3 without R2 | forms/acceptance_motion.rs | regularity_of_the_worked_systems
§1 C2 | accelerations and λ of S1–S4, Df = 0, residual zero | forms/acceptance_motion.rs | accelerations_and_multipliers_of_the_notes
§1 C2 | motions in closed form, the cycloid | forms/acceptance_motion.rs | motions_in_closed_form
§1 C2 | S3 stops where ρ = 0 | forms/acceptance_motion.rs | the_machine_of_appell_and_hamel_runs_down
§1 | the skate to 1e-9 at t = 1 | whole/textbook.rs | skate_on_the_incline
§1 | parametric constraints f(q, v, t, u), δu = 0 | here/controls.rs | the_forms_hold_with_controls
§2 C4 | the central identity (4a) | forms/acceptance_variation.rs | the_central_identity
§2 C3 | δf of S1 and S3 | here/variations.rs | varied_skate
§2 C3 | δf of S3, zero on motions | here/variations.rs | varied_cone
§2 C3 | A of S1–S4 and of z' = y x' + x y' | here/variations.rs | curvature_coefficients
§2 C3 | e^x (z' − y x' − x y'): E[f] ≠ 0, δf = 0 | forms/acceptance_variation.rs | an_integrable_constraint_with_a_factor
§2 C3 | Σ A v = 0 for homogeneous constraints | here/variations.rs | the_actual_velocity_violates_nothing
§2 C3 | A without solved constraints | forms/acceptance_variation.rs | the_curvature_from_the_euler_operator
§3 C4 | three integrands are one | forms/acceptance_variation.rs | three_integrands_of_hamiltons_principle_are_one
§3 C4 | the fourth differs by δp (q' − ∂H/∂p) | forms/acceptance_variation.rs | the_fourth_integrand_differs_by_the_kinematic_law
§3 C4 | four forms of S1–S4 give the motion | here/hamilton.rs | worked_systems
§3 C4 | (9) of S4 and S1 | here/hamilton.rs | local_equations_of_the_particle
§3 | Lagrange's equations for L* are refuted | here/hamilton.rs | dropped_terms_are_refuted
§3 | what motions reach from one point | here/hamilton.rs | constants_and_ends
§4.1 | Kerner's theorem, not for nonlinear constraints | here/hamilton.rs | kerner
§4.2 | (14) with constants c | here/acceptance.rs | chaplygin_systems_with_constants
§4.2 | (15) is not enough beyond Chaplygin's systems | forms/corrections/rumyantsev.rs | rumyantsev_suslov_condition_beyond_chaplygin
§4.3 C6 | the table: verdicts | here/coincidence.rs | table_of_coincidence
§4.3 C6 | the table: S1 with subsets | here/stationary.rs | skates
§4.3 C6 | the table: S4 with subsets | here/stationary.rs | particle
§4.3 C6 | the table: κ of S2, S3 and of an integrable constraint | here/stationary.rs | multipliers_in_closed_form
§4.3 C6 | the table: motions put into (11) | here/acceptance.rs | motions_of_the_skate_that_are_extremals
§4.3 | (15) of S1–S4 | here/stationary.rs | suslovs_condition
§4.3 C5 | (11) of S4 | forms/vakonomic.rs | particle_as_printed
§4.3 C5 | (11) of S1 | forms/vakonomic.rs | skate_as_printed
§4.3 C5 | (11) of S3 | forms/vakonomic.rs | appell_hamel_as_printed
§4.3 C5 | R5 of S3: κ = m ρ/a | forms/vakonomic.rs | singular_set_of_appell_hamel
§4.4 C5 | B^T F_vv B of S3 | here/acceptance.rs | second_variation_of_the_cone
§4.4 C5 | conjugate times k π/w and the index | whole/principles.rs | conjugate_times_of_an_oscillator
§5.1 C7 | y' = t x' | here/acceptance.rs | energy_of_a_rheonomic_homogeneous_constraint
§5.1 C7 | z' = y x' + b, S3, v·v = c² | here/acceptance.rs | energy_laws_of_affine_and_nonlinear_constraints
§5.2 | (18) | here/action.rs | the_action_changes_by_its_end_terms
§5.3 C8 | pointwise identity of S4 | forms/acceptance_canonical.rs | least_action_of_lagrange
§5.3 C8 | Δq free, not δq | here/action.rs | lagranges_principle_of_the_particle
§5.4 C9 | J1–J6 one by one | forms/jacobi.rs | hypotheses_by_name
§5.4 C9 | S4 along its path | forms/jacobi.rs | particle_along_its_path
§5.4 C9 | circles in a field, one way only | forms/jacobi.rs | circles_in_a_field
§5.4 C9 | the parabola | forms/jacobi.rs | parabola_of_a_fall
§6.1 C11 | S2: S and its motion | here/hamilton_jacobi.rs | the_disc_is_integrated
§6.1 C11 | S2: the path | here/hamilton_jacobi.rs | the_path_of_the_disc
§6.1 C11 | S4 is refused | here/hamilton_jacobi.rs | the_particle_is_refused
§6.1 | separation in the coordinates given | here/hamilton_jacobi.rs | separation_with_several_coordinates
§6.1 | quadratures along computed motions | whole/principles.rs | quadratures_along_motions
§6.2 C12 | S4: (1 + y²)^(−1/2) | here/chaplygin_multiplier.rs | particle
§6.2 C12 | S1: cos φ, for any U(x, φ) | here/chaplygin_multiplier.rs | skate
§6.2 C12 | the offset sleigh has none | here/chaplygin_multiplier.rs | sleigh
§6.2 C12 | the tau-motion is (9) | forms/acceptance_canonical.rs | the_reducing_multiplier_of_the_skate
§6.2 | three independent velocities | here/chaplygin_multiplier.rs | three_velocities
§6.3 C13 | Λ, F, the identity, (29) | forms/acceptance_canonical.rs | the_parametric_equations_are_dependent
§6.3 C13 | μ = t'² λ | forms/parametric.rs | multipliers_scale_with_the_square_of_the_parameter
§6.3 C13 | to Lagrange's and Jacobi's principles | forms/acceptance_canonical.rs | from_the_extended_space_to_jacobi
§6.4 C13 | D K = 0, Jacobi's K | forms/acceptance_canonical.rs | relations_of_the_extended_phase_space_are_integrals
§6.4 C13 | K² is none | here/action.rs | the_square_of_k_is_none
§7.1 C14 | generalized Lagrange relations (33) | forms/acceptance_state_space.rs | generalized_relations_of_lagrange
§7.2 C14 | the pointwise identity of Z | forms/acceptance_state_space.rs | the_density_of_the_second_kind
§7.2 C14 | closed equations of S4 | forms/acceptance_state_space.rs | closed_equations_of_the_particle
§7.2 C14 | L = q1 v2 − V and (v1 + v2)²/2 | here/second_kind.rs | kinematics_that_does_not_follow
§7.2 | three end conditions, wrong ones refuted | here/second_kind.rs | wrong_end_conditions
§7.3 C15 | (40) with a coupled mass matrix | here/second_kind.rs | chetaevs_condition_in_momenta
§7.4 C16 | a symbolic operator of first order | forms/acceptance_state_space.rs | the_universal_relation_is_a_gauge
§7.4 C16 | the four operators | forms/acceptance_state_space.rs | the_four_operators
§7.4 C16 | the damped oscillator | here/second_kind.rs | damped_oscillator
§7.4 C16 | Vujanović's operator where p = 0 | here/second_kind.rs | vujanovics_operator_without_momentum
§7.4 C16 | S4 with Suslov's operator is (9) | forms/acceptance_state_space.rs | the_particle_with_suslovs_operator
§3 C10 | (10) of S4 | forms/canonical.rs | particle_in_closed_form
§9.1 C17 | S4 with the Jacobi sum −1/(1 + y²) | forms/canonical_reduced.rs | bracket_and_jacobi_sum
§9.1 C17 | isokinetic: not applicable | forms/canonical_reduced.rs | isokinetic_particle_does_not_apply
§9.2 C18 | S1, S3, S4, polar | forms/gibbs_appell.rs | the_acceleration_energies_of_the_notes
§9.3 C19 | S1 | forms/kane.rs | the_skate_of_the_notes
§9.3 C19 | S2 | forms/kane.rs | the_disc_of_the_notes
§9.3 C19 | S3 | forms/kane.rs | the_machine_of_appell_and_hamel
§9.4 C20 | S4: the minimum and where | forms/gauss.rs | the_particle_of_the_notes
§9.4 C20 | an indefinite W | forms/gauss.rs | an_indefinite_mass_matrix_makes_it_stationary_only
§9.5 C21 | (52) for m = 1..4 | forms/nielsen.rs | the_forms_of_order_one_to_four
§9.5 C21 | frozen accelerations | forms/nielsen.rs | accelerations_are_frozen
§9.6 C22 | z'³ + z' = x'y' | forms/acceptance_motion.rs | an_implicit_constraint
§8 | (19) by numbers | here/map.rs | least_action_by_numbers
";

/// Section, what is checked, path, test.
fn rows() -> impl Iterator<Item = (&'static str, &'static str, String, &'static str)> {
    MAP.lines().map(|line| {
        let mut parts = line.split(" | ");
        let mut next = || parts.next().unwrap();
        let (section, what, place, test) = (next(), next(), next(), next());
        let (folder, file) = place.split_once('/').unwrap();
        let folder = match folder {
            "forms" => FORMS,
            "here" => HERE,
            "whole" => WHOLE,
            other => panic!("{other} is no folder"),
        };
        (section, what, format!("{folder}/{file}"), test)
    })
}

#[test]
fn every_check_has_its_test() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    for (section, what, file, test) in rows() {
        let text = std::fs::read_to_string(root.join(&file)).unwrap();
        let stated = format!("#[test]\nfn {test}(");
        let is_there = text.replace("\r\n", "\n").contains(&stated);
        assert!(is_there, "{section}, {what}: {file} has no test `{test}`");
    }
    for capability in 1..=22 {
        let name = format!("C{capability}");
        let covered = rows().any(|row| row.0.split(' ').any(|word| word == name));
        assert!(covered, "{name} has no test");
    }
}

/// S4 along accelerations given as expressions, by the rule of Runge and Kutta: rows of (q, v) at equal steps up to t = 1.
fn followed(
    system: &chetaev_mechanics::System,
    accelerations: &[Expr],
    steps: usize,
) -> Vec<[f64; 6]> {
    let g = &system.graph;
    let symbols: Vec<Symbol> = system
        .coordinate_symbols()
        .into_iter()
        .chain(system.velocity_symbols())
        .collect();
    let rate = |y: &[f64; 6]| -> [f64; 6] {
        let value = |s: Symbol| symbols.iter().position(|&own| own == s).map(|i| y[i]);
        let a = g.evaluate_f64(accelerations, &value).unwrap();
        [y[3], y[4], y[5], a[0], a[1], a[2]]
    };
    let moved = |y: &[f64; 6], k: &[f64; 6], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
    let h = 1.0 / steps as f64;
    let mut rows = vec![[0.0, 0.0, 0.0, 1.0, 1.0, 0.0]];
    for j in 0..steps {
        let y = rows[j];
        let k1 = rate(&y);
        let k2 = rate(&moved(&y, &k1, h / 2.0));
        let k3 = rate(&moved(&y, &k2, h / 2.0));
        let k4 = rate(&moved(&y, &k3, h));
        rows.push(std::array::from_fn(|i| {
            y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i])
        }));
    }
    rows
}

/// `∫2T dt` over √(2h), the length, of the curve moved by e (a, b, y a): by Simpson's rule.
fn length(rows: &[[f64; 6]], e: f64) -> f64 {
    let steps = rows.len() - 1;
    let at = |j: usize| {
        let t = j as f64 / steps as f64;
        let [_, y, _, vx, vy, vz] = rows[j];
        let (a, da) = (t * t * (1.0 - t), 2.0 * t - 3.0 * t * t);
        let db = 1.0 - 2.0 * t;
        let moved = [vx + e * da, vy + e * db, vz + e * (vy * a + y * da)];
        moved.iter().map(|v| v * v).sum::<f64>().sqrt()
    };
    let weight = |j: usize| match j {
        0 => 1.0,
        j if j == steps => 1.0,
        j if j % 2 == 1 => 4.0,
        _ => 2.0,
    };
    (0..=steps).map(|j| weight(j) * at(j)).sum::<f64>() / (3 * steps) as f64
}

/// T1 §8: of a virtual displacement of size e, the isoenergetic action of S4 (without forces, the length) changes by O(e²) along the
/// motion, and by O(e) along an admissible curve that is none: that of Lagrange's equations for L*.
#[test]
fn least_action_by_numbers() {
    let system = system(&PARTICLE);
    let right = with_context(&system, |cx| derive(cx, REFERENCE).unwrap().accelerations);
    let wrong = [
        "-2 y x' y'/(1 + y^2)",
        "0",
        "-2 y^2 x' y'/(1 + y^2) + x' y'",
    ];
    let wrong: Vec<Expr> = wrong.iter().map(|e| expr(&system.graph, e)).collect();
    let order = |accelerations: &[Expr]| {
        let rows = followed(&system, accelerations, 400);
        let last = rows[400];
        let change = |e: f64| (length(&rows, e) - length(&rows, 0.0)).abs();
        // z' = y x' all the way.
        assert!((last[5] - last[1] * last[3]).abs() < 1e-9);
        (change(1e-3) / change(5e-4)).log2()
    };
    let (of_motion, of_wrong) = (order(&right), order(&wrong));
    assert!((of_motion - 2.0).abs() < 0.01, "{of_motion}");
    assert!((of_wrong - 1.0).abs() < 0.1, "{of_wrong}");
}

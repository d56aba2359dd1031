//! Forms in momenta, in state space, in extended spaces, and in the time of Jacobi.

use super::{FIELD, FIELD_GROUP, MOTION, OBJECTS};
use chetaev_tests::pages::Book::{Rate, Value};
use chetaev_tests::pages::Page;

/// H = (p_x² + p_y² + p_z²)/2, p_x' = -λ y, p_y' = 0, p_z' = λ; in extended phase space K = p_t + H.
/// rumyantsev1982 (canonical equations with multipliers; canonical equations of extended phase space).
#[test]
fn canonical_equations_of_the_particle() {
    Page {
        model: "particle-y-dx",
        formulation: "canonical",
        group: MOTION,
        names: &["p_x", "p_y", "p_z", "lambda_rolling"],
        equations: &[
            ("x' = p_x/m", Value("x' - p_x/m")),
            ("y' = p_y/m", Value("y' - p_y/m")),
            ("z' = p_z/m", Value("z' - p_z/m")),
            ("p_x' = -lambda_rolling y", Rate("p_x", "lambda_rolling y")),
            ("p_y' = 0", Rate("p_y", "0")),
            ("p_z' = lambda_rolling", Rate("p_z", "-lambda_rolling")),
        ],
    }
    .check();
    Page {
        model: "particle-y-dx",
        formulation: "canonical",
        group: OBJECTS,
        names: &["H", "p_x", "p_y", "p_z"],
        equations: &[(
            "H = (p_x^2 + p_y^2 + p_z^2)/(2 m)",
            Value("H - (p_x^2 + p_y^2 + p_z^2)/(2 m)"),
        )],
    }
    .check();
    Page {
        model: "particle-y-dx",
        formulation: "parametric-canonical",
        group: OBJECTS,
        names: &["K", "p_x", "p_y", "p_z", "p_t"],
        equations: &[(
            "K = p_t + (p_x^2 + p_y^2 + p_z^2)/(2 m)",
            Value("K - p_t - (p_x^2 + p_y^2 + p_z^2)/(2 m)"),
        )],
    }
    .check();
}

/// p̃_x = (1 + y²) x', p̃_y = y', H̃ = (p̃_x²/(1 + y²) + p̃_y²)/2, θ = y p̃_x/(1 + y²), and p̃_x' = y p̃_x p̃_y/(1 + y²), p̃_y' = 0,
/// z' = y p̃_x/(1 + y²). bates1993; rumyantsev1982 (canonical equations without multipliers).
#[test]
fn reduced_canonical_equations_of_the_particle() {
    Page {
        model: "particle-y-dx",
        formulation: "canonical-reduced",
        group: MOTION,
        names: &["ptilde_x", "ptilde_y"],
        equations: &[
            (
                "x' = ptilde_x/(m y^2 + m)",
                Value("x' - ptilde_x/(m (1 + y^2))"),
            ),
            ("y' = ptilde_y/m", Value("y' - ptilde_y/m")),
            (
                "z' = y ptilde_x/(m y^2 + m)",
                Value("z' - y ptilde_x/(m (1 + y^2))"),
            ),
            (
                "ptilde_x' = y ptilde_x ptilde_y/(m y^2 + m)",
                Rate("ptilde_x", "-y ptilde_x ptilde_y/(m (1 + y^2))"),
            ),
            ("ptilde_y' = 0", Rate("ptilde_y", "0")),
        ],
    }
    .check();
    Page {
        model: "particle-y-dx",
        formulation: "canonical-reduced",
        group: OBJECTS,
        names: &["Htilde", "ptilde_x", "ptilde_y", "theta_z", "R_z_x_y"],
        equations: &[
            (
                "Htilde = ptilde_y^2/(2 m) + ptilde_x^2/(2 m (y^2 + 1))",
                Value("Htilde - (ptilde_x^2/(1 + y^2) + ptilde_y^2)/(2 m)"),
            ),
            (
                "ptilde_x = m (y^2 + 1) x'",
                Value("ptilde_x - m (1 + y^2) x'"),
            ),
            ("ptilde_y = m y'", Value("ptilde_y - m y'")),
            (
                "theta_z = ptilde_x y/(y^2 + 1)",
                Value("theta_z - y ptilde_x/(1 + y^2)"),
            ),
            ("R_z_x_y = 1", Value("R_z_x_y - 1")),
        ],
    }
    .check();
}

/// Planck's particle: H = c √(m²c² + p²) − F y and q' = ∂H/∂p = c p/√(m²c² + p²); λ from D(c (p_z − y p_x)/√(m²c² + p²)) = 0,
/// which on the constraint is c p_x p_y/((1 + y²) √(m²c² + p²)).
#[test]
fn a_relativistic_particle_in_canonical_form() {
    Page {
        model: "relativistic-particle",
        formulation: "canonical",
        group: MOTION,
        names: &["p_x", "p_y", "p_z", "lambda_rolling"],
        equations: &[
            (
                "x' = c p_x/sqrt(p_x^2 + p_y^2 + p_z^2 + m^2 c^2)",
                Value("x' - c p_x/sqrt(m^2 c^2 + p_x^2 + p_y^2 + p_z^2)"),
            ),
            (
                "y' = c p_y/sqrt(p_x^2 + p_y^2 + p_z^2 + m^2 c^2)",
                Value("y' - c p_y/sqrt(m^2 c^2 + p_x^2 + p_y^2 + p_z^2)"),
            ),
            (
                "z' = c p_z/sqrt(p_x^2 + p_y^2 + p_z^2 + m^2 c^2)",
                Value("z' - c p_z/sqrt(m^2 c^2 + p_x^2 + p_y^2 + p_z^2)"),
            ),
            ("p_x' = -lambda_rolling y", Rate("p_x", "lambda_rolling y")),
            ("p_y' = F", Rate("p_y", "-F")),
            ("p_z' = lambda_rolling", Rate("p_z", "-lambda_rolling")),
        ],
    }
    .check();
    Page {
        model: "relativistic-particle",
        formulation: "canonical",
        group: OBJECTS,
        names: &["H", "p_x", "p_y", "p_z"],
        equations: &[(
            "H = c sqrt(p_x^2 + p_y^2 + p_z^2 + m^2 c^2) - F y",
            Value("H - c sqrt(m^2 c^2 + p_x^2 + p_y^2 + p_z^2) + F y"),
        )],
    }
    .check();
    Page {
        model: "relativistic-particle",
        formulation: "canonical",
        group: "multipliers",
        names: &["p_x", "p_y", "p_z", "lambda_rolling"],
        equations: &[(
            "lambda_rolling = p_y (F p_z - p_x (F y - c sqrt(p_x^2 + p_y^2 + p_z^2 + m^2 c^2)))/((p_z y + p_x)^2 + p_y^2 (y^2 + 1) + m^2 c^2 (y^2 + 1))",
            Value("lambda_rolling - p_y (F (p_z - y p_x) + c p_x sqrt(m^2 c^2 + p_x^2 + p_y^2 + p_z^2))/((p_x + y p_z)^2 + (1 + y^2) (m^2 c^2 + p_y^2))"),
        )],
    }
    .check();
}

/// Θ(L) = L dt + ∂L/∂v (dq - v dt), and X ⌟ Ω along dq is D ∂L/∂v - ∂L/∂q - λ ∂f/∂v. cartan1922; zhao, (3)-(7).
#[test]
fn lagrange_vector_field_of_the_particle() {
    Page {
        model: "particle-y-dx",
        formulation: "lagrange-vector-field",
        group: FIELD_GROUP,
        names: &["lambda_rolling"],
        equations: &[
            (
                "m x'' + lambda_rolling y = 0",
                Rate("m x'", "lambda_rolling y"),
            ),
            ("m y'' = 0", Rate("m y'", "0")),
            (
                "m z'' - lambda_rolling = 0",
                Rate("m z'", "-lambda_rolling"),
            ),
        ],
    }
    .check();
    Page {
        model: "particle-y-dx",
        formulation: "lagrange-vector-field",
        group: OBJECTS,
        names: &["Theta_t", "Theta_x", "Theta_y", "Theta_z"],
        equations: &[
            (
                "Theta_t = -1/2 m (x'^2 + y'^2 + z'^2)",
                Value("Theta_t - m (x'^2 + y'^2 + z'^2)/2 + m x' x' + m y' y' + m z' z'"),
            ),
            ("Theta_x = m x'", Value("Theta_x - m x'")),
            ("Theta_y = m y'", Value("Theta_y - m y'")),
            ("Theta_z = m z'", Value("Theta_z - m z'")),
        ],
    }
    .check();
}

/// Λ = (x'² + y'² + z'²)/(2 t'), F = (z' - y x')/t', and d/dτ ∂Λ/∂x'_a - ∂Λ/∂x_a = μ ∂F/∂x'_a for x, y, z and t.
/// rumyantsev1982 (parametric form of the equations).
#[test]
fn parametric_equations_of_the_particle() {
    Page {
        model: "particle-y-dx",
        formulation: "parametric",
        group: OBJECTS,
        names: &["Lambda", "F_rolling", "w_x", "w_y", "w_z", "w_t"],
        equations: &[
            (
                "Lambda = m (w_x^2 + w_y^2 + w_z^2)/(2 w_t)",
                Value("Lambda - m (w_x^2 + w_y^2 + w_z^2)/(2 w_t)"),
            ),
            (
                "F_rolling = (w_z - w_x y)/w_t",
                Value("F_rolling - (w_z - y w_x)/w_t"),
            ),
        ],
    }
    .check();
    Page {
        model: "particle-y-dx",
        formulation: "parametric",
        group: MOTION,
        names: &["w_x", "w_y", "w_z", "w_t", "mu_rolling"],
        equations: &[
            ("m w_x'/w_t - m w_x w_t'/w_t^2 = -mu_rolling y/w_t", Rate("m w_x/w_t", "mu_rolling y/w_t")),
            ("m w_y'/w_t - m w_y w_t'/w_t^2 = 0", Rate("m w_y/w_t", "0")),
            ("m w_z'/w_t - m w_z w_t'/w_t^2 = mu_rolling/w_t", Rate("m w_z/w_t", "-mu_rolling/w_t")),
            ("m (w_x^2 + w_y^2 + w_z^2) w_t'/w_t^3 - m w_x w_x'/w_t^2 - m w_y w_y'/w_t^2 - m w_z w_z'/w_t^2 = mu_rolling (y w_x - w_z)/w_t^2", Rate("-m (w_x^2 + w_y^2 + w_z^2)/(2 w_t^2)", "mu_rolling (w_z - y w_x)/w_t^2")),
        ],
    }
    .check();
}

/// P = √(2h) √(x'² + y'²) + B (x y' - y x')/2 for the charge, P = √(2h) √(x'² + y'² + z'²) for the particle with unit mass, and
/// d/dτ ∂P/∂q' - ∂P/∂q = μ ∂f/∂q'. rumyantsev1982, (4.12); landau1976, sec. 44.
#[test]
fn jacobi_equations_of_a_charge_and_of_the_particle() {
    Page {
        model: FIELD,
        formulation: "jacobi",
        group: OBJECTS,
        names: &["P", "h", "w_x", "w_y"],
        equations: &[(
            "P = 1/2 B w_y x - 1/2 B w_x y + sqrt(2) sqrt(h) sqrt(w_x^2 + w_y^2)",
            Value("P - sqrt(2 h) sqrt(w_x^2 + w_y^2) - B (x w_y - y w_x)/2"),
        )],
    }
    .check();
    Page {
        model: FIELD,
        formulation: "jacobi",
        group: MOTION,
        names: &["h", "w_x", "w_y"],
        equations: &[
            ("sqrt(2) w_y^2 w_x' sqrt(h)/(w_x^2 + w_y^2)^(3/2) - sqrt(2) w_x w_y w_y' sqrt(h)/(w_x^2 + w_y^2)^(3/2) - B w_y = 0", Value("sqrt(2 h) (w_x'/sqrt(w_x^2 + w_y^2) - w_x (w_x w_x' + w_y w_y')/sqrt(w_x^2 + w_y^2)^3) - B w_y")),
            ("sqrt(2) w_x^2 w_y' sqrt(h)/(w_x^2 + w_y^2)^(3/2) - sqrt(2) w_x w_y w_x' sqrt(h)/(w_x^2 + w_y^2)^(3/2) + B w_x = 0", Value("sqrt(2 h) (w_y'/sqrt(w_x^2 + w_y^2) - w_y (w_x w_x' + w_y w_y')/sqrt(w_x^2 + w_y^2)^3) + B w_x")),
        ],
    }
    .check();
    Page {
        model: "particle-y-dx",
        formulation: "jacobi",
        group: OBJECTS,
        names: &["P", "h", "w_x", "w_y", "w_z"],
        equations: &[(
            "P = sqrt(2) sqrt(m (w_x^2 + w_y^2 + w_z^2)) sqrt(h)",
            Value("P - sqrt(2 h) sqrt(m (w_x^2 + w_y^2 + w_z^2))"),
        )],
    }
    .check();
}

/// Z = (v·v)/2 + (Dq - v)·v; Dv_x = -y λ, Dv_y = 0, Dv_z = λ. zhu1998, closed equations of the state space.
#[test]
fn state_space_equations_of_the_particle() {
    Page {
        model: "particle-y-dx",
        formulation: "state-space",
        group: OBJECTS,
        names: &["Z", "Dq_x", "Dq_y", "Dq_z"],
        equations: &[(
            "Z = -1/2 m (x'^2 + y'^2 + z'^2 - 2 Dq_x x' - 2 Dq_y y' - 2 Dq_z z')",
            Value(
                "Z - m ((x'^2 + y'^2 + z'^2)/2 + (Dq_x - x') x' + (Dq_y - y') y' + (Dq_z - z') z')",
            ),
        )],
    }
    .check();
    Page {
        model: "particle-y-dx",
        formulation: "state-space",
        group: MOTION,
        names: &["Dv_x", "Dv_y", "Dv_z", "lambda_rolling"],
        equations: &[
            (
                "m Dv_x = -lambda_rolling y",
                Value("m Dv_x + lambda_rolling y"),
            ),
            ("m Dv_y = 0", Value("m Dv_y")),
            ("m Dv_z = lambda_rolling", Value("m Dv_z - lambda_rolling")),
        ],
    }
    .check();
}

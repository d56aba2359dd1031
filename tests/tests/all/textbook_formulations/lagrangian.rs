//! Forms in the coordinates and their velocities: Voronets, Chaplygin, Volterra, Nielsen, Gauss, and the constrained extremum.

use super::{EXTREMUM, MOTION, NIELSEN, OBJECTS, POLAR, REDUCED, ROD};
use chetaev_tests::pages::Book::{Rate, Value};
use chetaev_tests::pages::Page;

/// With L* = ((1 + y²) x'² + y'²)/2, θ = y x', A_x = y', A_y = -x': (1 + y²) x'' + 2 y x' y' = y x' y' and y'' - y x'² = -y x' x'.
/// voronets1901; rumyantsev1982 (Hamilton's principle in the form of Voronets).
#[test]
fn voronets_equations_of_the_particle() {
    Page {
        model: "particle-y-dx",
        formulation: "voronets",
        group: MOTION,
        names: &[],
        equations: &[
            (
                "m (y^2 + 1) x'' + 2 m y x' y' = m y x' y'",
                Value("m ((1 + y^2) x'' + 2 y x' y' - y x' y')"),
            ),
            (
                "m y'' - m y x'^2 = -m y x'^2",
                Value("m (y'' - y x'^2 + y x' x')"),
            ),
        ],
    }
    .check();
    Page {
        model: "particle-y-dx",
        formulation: "voronets",
        group: OBJECTS,
        names: &["Lstar", "theta_z", "A_z_x", "A_z_y"],
        equations: &[
            (
                "Lstar = 1/2 m ((y^2 + 1) x'^2 + y'^2)",
                Value("Lstar - m ((1 + y^2) x'^2 + y'^2)/2"),
            ),
            ("theta_z = m y x'", Value("theta_z - m y x'")),
            ("A_z_x = y'", Value("A_z_x - y'")),
            ("A_z_y = -x'", Value("A_z_y + x'")),
        ],
    }
    .check();
}

/// With y' = x' tan φ: θ = m x' tan φ, A_x = φ'/cos² φ, A_φ = -x'/cos² φ, and
/// m x''/cos² φ + m x' φ' sin φ/cos³ φ = m G, J φ'' = 0. chaplygin1897, § 1; neimark-fufaev1972, ch. III.
#[test]
fn chaplygin_equations_of_the_skate() {
    Page {
        model: "skate-incline",
        formulation: "chaplygin",
        group: MOTION,
        names: &[],
        equations: &[
            ("m x''/cos(phi)^2 + 2 m x' phi' sin(phi)/cos(phi)^3 - m gs = m x' phi' sin(phi)/cos(phi)^3", Value("m x''/cos(phi)^2 + m x' phi' sin(phi)/cos(phi)^3 - m gs")),
            ("J phi'' - m x'^2 sin(phi)/cos(phi)^3 = -m x'^2 sin(phi)/cos(phi)^3", Value("J phi''")),
        ],
    }
    .check();
    Page {
        model: "skate-incline",
        formulation: "chaplygin",
        group: OBJECTS,
        names: &["theta_y", "A_y_x", "A_y_phi"],
        equations: &[
            (
                "theta_y = m x' sin(phi)/cos(phi)",
                Value("theta_y - m x' tan(phi)"),
            ),
            ("A_y_x = phi'/cos(phi)^2", Value("A_y_x - phi'/cos(phi)^2")),
            ("A_y_phi = -x'/cos(phi)^2", Value("A_y_phi + x'/cos(phi)^2")),
        ],
    }
    .check();
}

/// For the virtual displacements δz = ρ (x' δx + y' δy)/s the equations m x'' + (m z'' + m g) ρ x'/s = 0, with y likewise, in which
/// z'' = ρ (x' x'' + y' y'')/s; the curvature A_x = ρ y' (y' x'' - x' y'')/s³; the least constraint m g²/(2 (1 + ρ²)).
/// appell1911; hamel1949; neimark-fufaev1972, ch. IV.
#[test]
fn appell_and_hamel_in_several_forms() {
    appell_and_hamel_on_the_constraints();
    Page {
        model: "appell-hamel",
        formulation: "lagrange-dalembert",
        group: MOTION,
        names: &[],
        equations: &[
            (
                "m x'' + m rho x' (z'' + g)/sqrt(x'^2 + y'^2) = 0",
                Value("m x'' + (m z'' + m g) rho x'/s"),
            ),
            (
                "m y'' + m rho y' (z'' + g)/sqrt(x'^2 + y'^2) = 0",
                Value("m y'' + (m z'' + m g) rho y'/s"),
            ),
        ],
    }
    .check();
    Page {
        model: "appell-hamel",
        formulation: "volterra-second",
        group: MOTION,
        names: &[],
        equations: &[
            ("m (x'' ((1 + rho^2) x'^2 + y'^2) + rho^2 x' y' y'')/(x'^2 + y'^2) = -m rho g x'/sqrt(x'^2 + y'^2)", Value("m x'' + rho x'/s (m rho (x' x'' + y' y'')/s + m g)")),
            ("m (rho^2 x' y' x'' + y'' (x'^2 + (1 + rho^2) y'^2))/(x'^2 + y'^2) = -m rho g y'/sqrt(x'^2 + y'^2)", Value("m y'' + rho y'/s (m rho (x' x'' + y' y'')/s + m g)")),
        ],
    }
    .check();
    Page {
        model: "appell-hamel",
        formulation: "boltzmann-hamel",
        group: MOTION,
        names: &[],
        equations: &[
            ("m (x'' ((1 + rho^2) x'^2 + y'^2) + rho^2 x' y' y'' + rho g x' sqrt(x'^2 + y'^2))/(x'^2 + y'^2) = 0", Value("m x'' + rho x'/s (m rho (x' x'' + y' y'')/s + m g)")),
            ("m (rho^2 x' y' x'' + y'' (x'^2 + (1 + rho^2) y'^2) + rho g y' sqrt(x'^2 + y'^2))/(x'^2 + y'^2) = 0", Value("m y'' + rho y'/s (m rho (x' x'' + y' y'')/s + m g)")),
        ],
    }
    .check();
    Page {
        model: "appell-hamel",
        formulation: "voronets",
        group: OBJECTS,
        names: &["Lstar", "A_z_x", "A_z_y", "theta_z"],
        equations: &[
            (
                "Lstar = 1/2 m ((1 + rho^2) x'^2 + (1 + rho^2) y'^2 - 2 g z)",
                Value("Lstar - m/2 (1 + rho^2) (x'^2 + y'^2) + m g z"),
            ),
            (
                "theta_z = m rho sqrt(x'^2 + y'^2)",
                Value("theta_z - m rho sqrt(x'^2 + y'^2)"),
            ),
            (
                "A_z_x = rho y' (y' x'' - x' y'')/(x'^2 + y'^2)^(3/2)",
                Value("A_z_x - rho y' (y' x'' - x' y'')/sqrt(x'^2 + y'^2)^3"),
            ),
            (
                "A_z_y = -rho x' (y' x'' - x' y'')/(x'^2 + y'^2)^(3/2)",
                Value("A_z_y - rho x' (x' y'' - y' x'')/sqrt(x'^2 + y'^2)^3"),
            ),
        ],
    }
    .check();
    Page {
        model: "appell-hamel",
        formulation: "gauss",
        group: OBJECTS,
        names: &["Z_motion"],
        equations: &[(
            "Z_motion = m g^2/(2 (1 + rho^2))",
            Value("Z_motion - m g^2/(2 (1 + rho^2))"),
        )],
    }
    .check();
}

/// L̄ = ½ m (1 + ρ²) s² − m g z (T3 §8.5), p̃ = m (1 + ρ²) v, and in closed form (T1 §9.1)
/// H̃ = p̃²/(2 m (1 + ρ²)) + m g z, p̃' = −m g ρ p̃/|p̃|.
fn appell_and_hamel_on_the_constraints() {
    Page {
        model: "appell-hamel",
        formulation: "boltzmann-hamel",
        group: OBJECTS,
        names: &["Lbar", "L_z", "p_x", "p_y"],
        equations: &[
            (
                "Lbar = 1/2 m ((1 + rho^2) x'^2 + (1 + rho^2) y'^2 - 2 g z)",
                Value("Lbar - m/2 (1 + rho^2) (x'^2 + y'^2) + m g z"),
            ),
            (
                "L_z = m rho sqrt(x'^2 + y'^2)",
                Value("L_z - m rho sqrt(x'^2 + y'^2)"),
            ),
            ("p_x = m (1 + rho^2) x'", Value("p_x - m (1 + rho^2) x'")),
            ("p_y = m (1 + rho^2) y'", Value("p_y - m (1 + rho^2) y'")),
        ],
    }
    .check();
    Page {
        model: "appell-hamel",
        formulation: "canonical-reduced",
        group: MOTION,
        names: &["ptilde_x", "ptilde_y"],
        equations: &[
            (
                "x' = ptilde_x/(m + m rho^2)",
                Value("x' - ptilde_x/(m (1 + rho^2))"),
            ),
            (
                "y' = ptilde_y/(m + m rho^2)",
                Value("y' - ptilde_y/(m (1 + rho^2))"),
            ),
            (
                "z' = rho sqrt(ptilde_x^2 + ptilde_y^2)/(m + m rho^2)",
                Value("z' - rho sqrt(ptilde_x^2 + ptilde_y^2)/(m (1 + rho^2))"),
            ),
            (
                "ptilde_x' = -m rho g ptilde_x/sqrt(ptilde_x^2 + ptilde_y^2)",
                Rate("ptilde_x", "m g rho ptilde_x/sqrt(ptilde_x^2 + ptilde_y^2)"),
            ),
            (
                "ptilde_y' = -m rho g ptilde_y/sqrt(ptilde_x^2 + ptilde_y^2)",
                Rate("ptilde_y", "m g rho ptilde_y/sqrt(ptilde_x^2 + ptilde_y^2)"),
            ),
        ],
    }
    .check();
    Page {
        model: "appell-hamel",
        formulation: "canonical-reduced",
        group: OBJECTS,
        names: &["Htilde", "ptilde_x", "ptilde_y"],
        equations: &[
            (
                "Htilde = (ptilde_x^2 + ptilde_y^2)/(2 (m + m rho^2)) + m g z",
                Value("Htilde - (ptilde_x^2 + ptilde_y^2)/(2 m (1 + rho^2)) - m g z"),
            ),
            (
                "ptilde_x = m (1 + rho^2) x'",
                Value("ptilde_x - m (1 + rho^2) x'"),
            ),
            (
                "ptilde_y = m (1 + rho^2) y'",
                Value("ptilde_y - m (1 + rho^2) y'"),
            ),
        ],
    }
    .check();
}

/// The least value of Z = (x''² + y''² + z''²)/2 is (x' y')²/(2 (1 + y²)); the reaction is that of Routh. gauss1829; udwadia-kalaba1992.
#[test]
fn gauss_principle_of_the_particle() {
    Page {
        model: "particle-y-dx",
        formulation: "gauss",
        group: MOTION,
        names: &["lambda_rolling"],
        equations: &[
            (
                "x'' = -lambda_rolling y/m",
                Value("x'' + lambda_rolling y/m"),
            ),
            ("y'' = 0", Value("y''")),
            ("z'' = lambda_rolling/m", Value("z'' - lambda_rolling/m")),
        ],
    }
    .check();
    Page {
        model: "particle-y-dx",
        formulation: "gauss",
        group: OBJECTS,
        names: &["Z", "Z_motion"],
        equations: &[
            (
                "Z = 1/2 m (x''^2 + y''^2 + z''^2)",
                Value("Z - m (x''^2 + y''^2 + z''^2)/2"),
            ),
            (
                "Z_motion = m x'^2 y'^2/(2 (y^2 + 1))",
                Value("Z_motion - m (x' y')^2/(2 (1 + y^2))"),
            ),
        ],
    }
    .check();
}

/// (x' - κ y)' = 0, y'' = -κ x', (z' + κ)' = 0 for the particle; (m x' + κ sin φ)' = m G, (m y' - κ cos φ)' = 0,
/// J φ'' = κ (x' cos φ + y' sin φ) for the skate; (m x' - κ ρ x'/s)' = 0, likewise y, and m z'' + m g = -κ' for Appell's machine.
/// rumyantsev1982 (the problem of Lagrange); arnold2006, ch. 1 § 4.
#[test]
fn extremals_of_the_particle_the_skate_and_appells_machine() {
    Page {
        model: "particle-y-dx",
        formulation: "vakonomic",
        group: EXTREMUM,
        names: &["kappa_rolling"],
        equations: &[
            (
                "m x'' = kappa_rolling y' + y kappa_rolling'",
                Rate("m x' - kappa_rolling y", "0"),
            ),
            (
                "m y'' = -kappa_rolling x'",
                Value("m y'' + kappa_rolling x'"),
            ),
            ("m z'' = -kappa_rolling'", Rate("m z' + kappa_rolling", "0")),
        ],
    }
    .check();
    Page {
        model: "skate-incline",
        formulation: "vakonomic",
        group: EXTREMUM,
        names: &["kappa_blade"],
        equations: &[
            (
                "m x'' - m gs = -kappa_blade phi' cos(phi) - kappa_blade' sin(phi)",
                Rate("m x' + kappa_blade sin(phi)", "-m gs"),
            ),
            (
                "m y'' = kappa_blade' cos(phi) - kappa_blade phi' sin(phi)",
                Rate("m y' - kappa_blade cos(phi)", "0"),
            ),
            (
                "J phi'' = kappa_blade (x' cos(phi) + y' sin(phi))",
                Value("J phi'' - kappa_blade (x' cos(phi) + y' sin(phi))"),
            ),
        ],
    }
    .check();
    Page {
        model: "appell-hamel",
        formulation: "vakonomic",
        group: EXTREMUM,
        names: &["kappa_cone"],
        equations: &[
            ("m x'' = rho (kappa_cone y' (y' x'' - x' y'') + x' kappa_cone' (x'^2 + y'^2))/(x'^2 + y'^2)^(3/2)", Rate("m x' - kappa_cone rho x'/sqrt(x'^2 + y'^2)", "0")),
            ("m y'' = rho (-kappa_cone x' (y' x'' - x' y'') + y' kappa_cone' (x'^2 + y'^2))/(x'^2 + y'^2)^(3/2)", Rate("m y' - kappa_cone rho y'/sqrt(x'^2 + y'^2)", "0")),
            ("m z'' + m g = -kappa_cone'", Rate("m z' + kappa_cone", "m g")),
        ],
    }
    .check();
}

/// DT = m (r' r'' + r r' θ'² + r² θ' θ''), so that ∂DT/∂r' - 2 ∂T/∂r = m (r'' - r θ'²); on the manifold of the particle
/// (1 + y²) x'' + y x' y' = 0, y'' = 0. nielsen1935; tzenoff1924, § 1.
#[test]
fn nielsen_equations_in_polar_coordinates_and_of_the_particle() {
    Page {
        model: POLAR,
        formulation: "nielsen",
        group: NIELSEN,
        names: &[],
        equations: &[
            ("m r'' - m r theta'^2 = 0", Value("m (r'' - r theta'^2)")),
            (
                "m r^2 theta'' + 2 m r r' theta' = 0",
                Value("m (r^2 theta'' + 2 r r' theta')"),
            ),
        ],
    }
    .check();
    Page {
        model: POLAR,
        formulation: "nielsen",
        group: OBJECTS,
        names: &["DLstar"],
        equations: &[(
            "DLstar = m (r' r'' + r theta' (r theta'' + r' theta'))",
            Value("DLstar - m (r' r'' + r r' theta'^2 + r^2 theta' theta'')"),
        )],
    }
    .check();
    Page {
        model: "particle-y-dx",
        formulation: "nielsen",
        group: REDUCED,
        names: &[],
        equations: &[
            (
                "m (y^2 + 1) x'' + 2 m y x' y' = m y x' y'",
                Value("m ((1 + y^2) x'' + y x' y')"),
            ),
            ("m y'' - m y x'^2 = -m y x'^2", Value("m y''")),
        ],
    }
    .check();
}

/// The same equations of the sleigh in blade speeds; for a pendulum in Cartesian coordinates, x² + y² = l² and w = (x y' - y x')/l²,
/// m l² w' = -m g x times l²/(x² + y²). volterra1898, §§ 1-2; qiao-volterra (2.14), (3.29).
#[test]
fn volterra_equations_of_the_sleigh_and_of_a_rod() {
    Page {
        model: "chaplygin-sleigh",
        formulation: "volterra-first",
        group: MOTION,
        names: &["u", "w"],
        equations: &[
            ("m u' - m a w^2 = 0", Value("m (u' - a w^2)")),
            (
                "(J + m a^2) w' + m a u w = 0",
                Value("(J + m a^2) w' + m a u w"),
            ),
        ],
    }
    .check();
    Page {
        model: "chaplygin-sleigh",
        formulation: "volterra-second",
        group: MOTION,
        names: &["u", "w"],
        equations: &[
            ("m u' - m a w^2 = 0", Value("m (u' - a w^2)")),
            (
                "(J + m a^2) w' + m a u w = 0",
                Value("(J + m a^2) w' + m a u w"),
            ),
        ],
    }
    .check();
    Page {
        model: ROD,
        formulation: "volterra-first-cartesian",
        group: MOTION,
        names: &["w"],
        equations: &[(
            "m l^4 w'/(x^2 + y^2) = -m l^2 g x/(x^2 + y^2)",
            Value("(m l^2 w' + m g x) l^2/(x^2 + y^2)"),
        )],
    }
    .check();
}

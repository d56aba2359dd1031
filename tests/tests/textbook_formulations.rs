//! The textbook systems in the formulations in which their books treat them: what `derive` prints is the text reviewed here,
//! and is proved equal to the book's own equations.
//!
//! Sources are keys of docs/references.bib. A book's equation is multiplied by what the formulation multiplies it with (a
//! mass, mostly), so that the difference of both has to vanish identically.

use chetaev_tests::pages::Book::{Rate, Value};
use chetaev_tests::pages::Page;

const MOTION: &str = "equations of motion";
const OBJECTS: &str = "objects";
const EXTREMUM: &str = "equations of the extremum";
const NIELSEN: &str = "equations with multipliers";
const REDUCED: &str = "equations on the constraint manifold";
const FIELD_GROUP: &str = "components of X ⌟ Ω along dq";
/// A pendulum in Cartesian coordinates.
const ROD: &str = r#"
name = "rod"
coordinates = ["x", "y"]
parameters = { m = 1.2, l = 0.5, g = 9.81 }
assumptions = ["m > 0", "l > 0"]
[particles.bob]
mass = "m"
position = ["x", "y"]
force = [0, "-m g"]
[constraints]
rod = "x^2 + y^2 = l^2"
[quasi_velocities]
w = "(x y' - y x')/l^2"
[initial]
y = "-l"
"#;

/// A skate of two particles on an incline, S1 of the notes with J = m l²: the blade is midway between them.
const SKATE_OF_PARTICLES: &str = r#"
name = "skate-of-particles"
coordinates = ["x", "y", "phi"]
parameters = { m = 1.2, l = 0.5, gs = 4 }
assumptions = ["m > 0", "l > 0"]
[particles.front]
mass = "m/2"
position = ["x + l cos(phi)", "y + l sin(phi)"]
force = ["m gs/2", 0]
[particles.rear]
mass = "m/2"
position = ["x - l cos(phi)", "y - l sin(phi)"]
force = ["m gs/2", 0]
[constraints]
blade = "x' sin(phi) = y' cos(phi)"
[quasi_velocities]
u = "x' cos(phi) + y' sin(phi)"
w = "phi'"
"#;

/// A free particle in polar coordinates.
const POLAR: &str = r#"
name = "polar-particle"
coordinates = ["r", "theta"]
parameters = { m = 1.2 }
assumptions = ["m > 0", "r > 0"]
[particles.point]
mass = "m"
position = ["r cos(theta)", "r sin(theta)"]
"#;

/// A charge in a uniform magnetic field, mass 1.
const FIELD: &str = r#"
name = "charge-in-a-field"
coordinates = ["x", "y"]
parameters = { B = 1.5 }
[lagrangian]
L = "1/2 (x'^2 + y'^2) + 1/2 B (x y' - y x')"
"#;

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

/// S = (x''² + y''² + (y x'' + x' y')²)/2 for the particle, m (u'² + u² w²)/2 + J w'²/2 for the skate with right sides
/// m G cos φ and 0, and m ((r'' - r θ'²)² + (r θ'' + 2 r' θ')²)/2 in polar coordinates. Terms without accelerations are left out,
/// since they give nothing. gibbs1879; appell1900b, §§ 1-4; neimark-fufaev1972, ch. III.
#[test]
fn gibbs_appell_equations() {
    Page {
        model: "particle-y-dx",
        formulation: "gibbs-appell",
        group: MOTION,
        names: &[],
        equations: &[
            (
                "m (y^2 + 1) x'' + m y x' y' = 0",
                Value("m ((1 + y^2) x'' + y x' y')"),
            ),
            ("m y'' = 0", Value("m y''")),
        ],
    }
    .check();
    Page {
        model: "particle-y-dx",
        formulation: "gibbs-appell",
        group: OBJECTS,
        names: &["S"],
        equations: &[(
            "S = 1/2 m (x'' (y^2 x'' + x'' + 2 y x' y') + y''^2)",
            Value("S - m (x''^2 + y''^2 + (y x'' + x' y')^2)/2 + m (x' y')^2/2"),
        )],
    }
    .check();
    Page {
        model: SKATE_OF_PARTICLES,
        formulation: "gibbs-appell",
        group: MOTION,
        names: &["u", "w"],
        equations: &[
            ("m u' = m gs cos(phi)", Value("m u' - m gs cos(phi)")),
            ("m l^2 w' = 0", Value("m l^2 w'")),
        ],
    }
    .check();
    Page {
        model: SKATE_OF_PARTICLES,
        formulation: "gibbs-appell",
        group: OBJECTS,
        names: &["S", "u", "w"],
        equations: &[(
            "S = 1/2 m (u'^2 + l^2 w'^2)",
            Value("S - m (u'^2 + u^2 w^2)/2 - m l^2 w'^2/2 + m u^2 w^2/2"),
        )],
    }
    .check();
    Page {
        model: POLAR,
        formulation: "gibbs-appell",
        group: MOTION,
        names: &[],
        equations: &[
            ("m r'' - m r theta'^2 = 0", Value("m (r'' - r theta'^2)")),
            (
                "m r^2 theta'' + 2 m r r' theta' = 0",
                Value("m r (r theta'' + 2 r' theta')"),
            ),
        ],
    }
    .check();
    Page {
        model: POLAR,
        formulation: "gibbs-appell",
        group: OBJECTS,
        names: &["S"],
        equations: &[
            ("S = 1/2 m (r (r theta''^2 - 2 theta'^2 r'' + 4 r' theta' theta'') + r''^2)", Value("S - m ((r'' - r theta'^2)^2 + (r theta'' + 2 r' theta')^2)/2 + m (r^2 theta'^4 + 4 r'^2 theta'^2)/2")),
        ],
    }
    .check();
}

/// F = (m G cos φ, 0) and F* = (-m u', -J w') for the skate; F* = (-(I + m R²) u1', -J u2') for the vertical disc.
/// kane-levinson1985, ch. 6.
#[test]
fn kane_equations_of_the_skate_and_the_disc() {
    Page {
        model: SKATE_OF_PARTICLES,
        formulation: "kane",
        group: OBJECTS,
        names: &["u", "w", "F_u", "F_w", "Fstar_u", "Fstar_w"],
        equations: &[
            ("F_u = m gs cos(phi)", Value("F_u - m gs cos(phi)")),
            ("Fstar_u = -m u'", Value("Fstar_u + m u'")),
            ("F_w = 0", Value("F_w")),
            ("Fstar_w = -m l^2 w'", Value("Fstar_w + m l^2 w'")),
        ],
    }
    .check();
    Page {
        model: SKATE_OF_PARTICLES,
        formulation: "kane",
        group: MOTION,
        names: &["u", "w"],
        equations: &[
            ("-m u' + m gs cos(phi) = 0", Value("m gs cos(phi) - m u'")),
            ("-m l^2 w' = 0", Value("-m l^2 w'")),
        ],
    }
    .check();
    Page {
        model: "vertical-rolling-disc",
        formulation: "kane",
        group: OBJECTS,
        names: &[
            "rolling",
            "turning",
            "F_rolling",
            "F_turning",
            "Fstar_rolling",
            "Fstar_turning",
        ],
        equations: &[
            ("F_rolling = 0", Value("F_rolling")),
            (
                "Fstar_rolling = -(I + m R^2) rolling'",
                Value("Fstar_rolling + (I + m R^2) rolling'"),
            ),
            ("F_turning = 0", Value("F_turning")),
            (
                "Fstar_turning = -J turning'",
                Value("Fstar_turning + J turning'"),
            ),
        ],
    }
    .check();
}

/// m (u' - a w²) = 0, (J + m a²) w' + m a u w = 0, from L̄ = (m u² + (J + m a²) w²)/2 and the momentum m a w across the blade.
/// hamel1904; neimark-fufaev1972, ch. III; bloch2003, sec. 1.7.
#[test]
fn boltzmann_hamel_equations_of_the_sleigh() {
    Page {
        model: "chaplygin-sleigh",
        formulation: "boltzmann-hamel",
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
        formulation: "boltzmann-hamel",
        group: OBJECTS,
        names: &["u", "w", "Lbar", "L_eta_blade", "p_u", "p_w"],
        equations: &[
            (
                "Lbar = 1/2 m u^2 + 1/2 (J + m a^2) w^2",
                Value("Lbar - (m u^2 + (J + m a^2) w^2)/2"),
            ),
            ("L_eta_blade = m a w", Value("L_eta_blade - m a w")),
            ("p_u = m u", Value("p_u - m u")),
            ("p_w = (J + m a^2) w", Value("p_w - (J + m a^2) w")),
        ],
    }
    .check();
}

/// I1 w1' = (I2 - I3) w2 w3 and so on cyclically, with [X1, X2] = X3 and so on. euler1765; poincare1901; hamel1904; landau1976, sec. 36.
#[test]
fn euler_equations_of_the_rigid_body() {
    Page {
        model: "rigid-body",
        formulation: "boltzmann-hamel",
        group: MOTION,
        names: &["w1", "w2", "w3"],
        equations: &[
            (
                "I1 w1' - (I2 - I3) w2 w3 = 0",
                Value("I1 w1' - (I2 - I3) w2 w3"),
            ),
            (
                "I2 w2' + (I1 - I3) w1 w3 = 0",
                Value("I2 w2' - (I3 - I1) w3 w1"),
            ),
            (
                "I3 w3' - (I1 - I2) w1 w2 = 0",
                Value("I3 w3' - (I1 - I2) w1 w2"),
            ),
        ],
    }
    .check();
    Page {
        model: "rigid-body",
        formulation: "poincare-chetaev",
        group: MOTION,
        names: &["w1", "w2", "w3"],
        equations: &[
            (
                "I1 w1' - (I2 - I3) w2 w3 = 0",
                Value("I1 w1' - (I2 - I3) w2 w3"),
            ),
            (
                "I2 w2' + (I1 - I3) w1 w3 = 0",
                Value("I2 w2' - (I3 - I1) w3 w1"),
            ),
            (
                "I3 w3' - (I1 - I2) w1 w2 = 0",
                Value("I3 w3' - (I1 - I2) w1 w2"),
            ),
        ],
    }
    .check();
    Page {
        model: "rigid-body",
        formulation: "boltzmann-hamel",
        group: OBJECTS,
        names: &["C_w1_w2_w3", "C_w1_w3_w2", "C_w2_w3_w1"],
        equations: &[
            ("C_w1_w2_w3 = 1", Value("C_w1_w2_w3 - 1")),
            ("C_w1_w3_w2 = -1", Value("C_w1_w3_w2 + 1")),
            ("C_w2_w3_w1 = 1", Value("C_w2_w3_w1 - 1")),
        ],
    }
    .check();
}

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
        names: &["Zmotion"],
        equations: &[(
            "Zmotion = m g^2/(2 (1 + rho^2))",
            Value("Zmotion - m g^2/(2 (1 + rho^2))"),
        )],
    }
    .check();
}

/// L̄ = ½ m (1 + ρ²) s² − m g z (theory 3 §8.5), p̃ = m (1 + ρ²) v, and in closed form (theory 1 §9.1)
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
        names: &["Z", "Zmotion"],
        equations: &[
            (
                "Z = 1/2 m (x''^2 + y''^2 + z''^2)",
                Value("Z - m (x''^2 + y''^2 + z''^2)/2"),
            ),
            (
                "Zmotion = m x'^2 y'^2/(2 (y^2 + 1))",
                Value("Zmotion - m (x' y')^2/(2 (1 + y^2))"),
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
            "P = sqrt(2) sqrt(h) sqrt(m w_x^2 + m w_y^2 + m w_z^2)",
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

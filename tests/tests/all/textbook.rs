//! The equations that `derive` prints for the systems that textbooks treat, held against the textbooks twice: the text is
//! exactly the one reviewed here, and what it says is proved equal to the book's own equation, typed in as the book has it.
//!
//! Sources are keys of docs/references.bib. A book's equation is multiplied by what the formulation multiplies it with (a
//! mass, mostly), so that the difference of both has to vanish identically.
use chetaev_tests::pages::Book::{Rate, Value};
use chetaev_tests::pages::Page;

const ROUTH: &str = "routh";
const MAGGI: &str = "maggi";
const MOTION: &str = "equations of motion";
const MULTIPLIERS: &str = "multipliers";

/// With u the speed of the blade and w the yaw rate: u' = a w^2, (J + m a^2) w' = -m a u w.
/// chaplygin1911; caratheodory1933; neimark-fufaev1972, ch. II; bloch2003, sec. 1.7.
#[test]
fn chaplygin_sleigh() {
    Page {
        model: "chaplygin-sleigh",
        formulation: MAGGI,
        group: MOTION,
        names: &[],
        equations: &[
            ("m u' - m a w^2 = 0", Value("m (u' - a w^2)")),
            (
                "(J + m a^2) w' + m a u w = 0",
                Value("(J + m a^2) w' + m a u w"),
            ),
        ],
    }
    .check();
}

/// u' = 0, w' = 0; the reaction across the blade is m u w. neimark-fufaev1972, ch. II; arnold2006, sec. 1.4.
#[test]
fn skate_on_the_level() {
    Page {
        model: "skate-level",
        formulation: MAGGI,
        group: MOTION,
        names: &[],
        equations: &[("m u' = 0", Value("m u'")), ("J w' = 0", Value("J w'"))],
    }
    .check();
    Page {
        model: "skate-level",
        formulation: ROUTH,
        group: MULTIPLIERS,
        names: &[],
        equations: &[(
            "lambda_blade = -m phi' (x' cos(phi) + y' sin(phi))",
            Value("lambda_blade + m u w"),
        )],
    }
    .check();
}

/// u' = g sin(α) cos(φ), φ'' = 0, λ = -m u φ' - m g sin(α) sin(φ), where x points down the slope.
/// neimark-fufaev1972, ch. II; bloch2003, sec. 1.6.
#[test]
fn skate_on_the_incline() {
    Page {
        model: "skate-incline",
        formulation: MAGGI,
        group: MOTION,
        names: &[],
        equations: &[
            ("m u' - m gs cos(phi) = 0", Value("m (u' - gs cos(phi))")),
            ("J w' = 0", Value("J phi''")),
        ],
    }
    .check();
    Page {
        model: "skate-incline",
        formulation: ROUTH,
        group: MULTIPLIERS,
        names: &[],
        equations: &[(
            "lambda_blade = -m (phi' (x' cos(phi) + y' sin(phi)) + gs sin(phi))",
            Value("lambda_blade + m u phi' + m gs sin(phi)"),
        )],
    }
    .check();
}

/// (I + m R^2) θ'' = 0, J φ'' = 0, λ_1 = -m R φ' θ' sin(φ), λ_2 = m R φ' θ' cos(φ). bloch2003, sec. 1.4.
#[test]
fn vertical_rolling_disc() {
    Page {
        model: "vertical-rolling-disc",
        formulation: MAGGI,
        group: MOTION,
        names: &[],
        equations: &[
            ("(I + m R^2) rolling' = 0", Value("(I + m R^2) theta''")),
            ("J turning' = 0", Value("J phi''")),
        ],
    }
    .check();
    Page {
        model: "vertical-rolling-disc",
        formulation: ROUTH,
        group: MULTIPLIERS,
        names: &[],
        equations: &[
            (
                "lambda_along_x = -m R theta' phi' sin(phi)",
                Value("lambda_along_x + m R phi' theta' sin(phi)"),
            ),
            (
                "lambda_along_y = m R theta' phi' cos(phi)",
                Value("lambda_along_y - m R phi' theta' cos(phi)"),
            ),
        ],
    }
    .check();
}

/// (1 + y^2) x'' + y x' y' = 0, y'' = 0, λ = m x' y'/(1 + y^2). rosenberg1977; pars1965; bates1993.
#[test]
fn particle_with_z_rate_y_x_rate() {
    Page {
        model: "particle-y-dx",
        formulation: MAGGI,
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
        formulation: ROUTH,
        group: MULTIPLIERS,
        names: &[],
        equations: &[(
            "lambda_rolling = m x' y'/(y^2 + 1)",
            Value("lambda_rolling - m x' y'/(1 + y^2)"),
        )],
    }
    .check();
}

/// The momenta A φ' sin²θ + C (ψ' + φ' cos θ) cos θ and C (ψ' + φ' cos θ) are kept, and
/// A θ'' = A φ'² sin θ cos θ - C (ψ' + φ' cos θ) φ' sin θ + m g l sin θ. whittaker1937, sec. 71; klein-sommerfeld1910.
#[test]
fn heavy_top() {
    Page {
        model: "heavy-top",
        formulation: ROUTH,
        group: MOTION,
        names: &[],
        equations: &[
            (
                "(A sin(theta)^2 + C cos(theta)^2) phi'' + C psi'' cos(theta) + 2 (A - C) phi' theta' sin(theta) cos(theta) - C theta' psi' sin(theta) = 0",
                Rate("A phi' sin(theta)^2 + C (psi' + phi' cos(theta)) cos(theta)", "0"),
            ),
            (
                "A theta'' - (A - C) phi'^2 sin(theta) cos(theta) + C phi' psi' sin(theta) - mgl sin(theta) = 0",
                Value("A theta'' - A phi'^2 sin(theta) cos(theta) + C (psi' + phi' cos(theta)) phi' sin(theta) - mgl sin(theta)"),
            ),
            (
                "C (phi'' cos(theta) + psi'' - phi' theta' sin(theta)) = 0",
                Rate("C (psi' + phi' cos(theta))", "0"),
            ),
        ],
    }
    .check();
}

/// From L = m l² a'² + m l² b'²/2 + m l² a' b' cos(a - b) + 2 m g l cos a + m g l cos b. landau1976, sec. 5, problem 1,
/// with equal masses and lengths.
#[test]
fn double_pendulum() {
    Page {
        model: "double-pendulum",
        formulation: ROUTH,
        group: MOTION,
        names: &[],
        equations: &[
            (
                "2 m l^2 a'' + m l^2 b'' cos(a - b) + m l^2 b'^2 sin(a - b) + 2 m l g sin(a) = 0",
                Rate(
                    "2 m l^2 a' + m l^2 b' cos(a - b)",
                    "m l^2 a' b' sin(a - b) + 2 m g l sin(a)",
                ),
            ),
            (
                "m l^2 a'' cos(a - b) + m l^2 b'' - m l^2 a'^2 sin(a - b) + m l g sin(b) = 0",
                Rate(
                    "m l^2 b' + m l^2 a' cos(a - b)",
                    "-m l^2 a' b' sin(a - b) + m g l sin(b)",
                ),
            ),
        ],
    }
    .check();
}

/// With the spin w = ψ' + φ' sin θ: A (φ'' cos θ - 2 φ' θ' sin θ) + C θ' w = 0,
/// (A + m r²) θ'' + A φ'² sin θ cos θ - (C + m r²) w φ' cos θ - m g r sin θ = 0, (C + m r²) w' + m r² φ' θ' cos θ = 0.
/// neimark-fufaev1972; oreilly1996. The first printed equation belongs to φ: it is the first of the book times cos θ plus
/// the third times sin θ.
#[test]
fn falling_rolling_disc() {
    Page {
        model: "falling-rolling-disc",
        formulation: MAGGI,
        group: MOTION,
        names: &[],
        equations: &[
            (
                "(A cos(theta)^2 + (Cc + m r^2) sin(theta)^2) phi'' + (Cc + m r^2) psi'' sin(theta) - 2 (A - Cc - m r^2) phi' theta' sin(theta) cos(theta) + Cc theta' psi' cos(theta) = 0",
                Value("cos(theta) (A (phi'' cos(theta) - 2 phi' theta' sin(theta)) + Cc theta' (psi' + phi' sin(theta))) + sin(theta) ((Cc + m r^2) (psi'' + phi'' sin(theta) + phi' theta' cos(theta)) + m r^2 phi' theta' cos(theta))"),
            ),
            (
                "(A + m r^2) theta'' + (A - Cc - m r^2) phi'^2 sin(theta) cos(theta) - (Cc + m r^2) phi' psi' cos(theta) - m r g sin(theta) = 0",
                Value("(A + m r^2) theta'' + A phi'^2 sin(theta) cos(theta) - (Cc + m r^2) (psi' + phi' sin(theta)) phi' cos(theta) - m g r sin(theta)"),
            ),
            (
                "(Cc + m r^2) phi'' sin(theta) + (Cc + m r^2) psi'' + (Cc + 2 m r^2) phi' theta' cos(theta) = 0",
                Rate("(Cc + m r^2) (psi' + phi' sin(theta))", "m r^2 phi' theta' cos(theta)"),
            ),
        ],
    }
    .check();
}

/// The center of the ball circles at the rate k Ω/(1 + k) (2/7 of the table's for a homogeneous ball):
/// x'' = -k Ω y'/(1 + k), y'' = k Ω x'/(1 + k). earnshaw1844; milne1948; neimark-fufaev1972.
#[test]
fn sphere_on_a_turntable() {
    Page {
        model: "sphere-on-turntable",
        formulation: ROUTH,
        group: MULTIPLIERS,
        names: &[],
        equations: &[
            (
                "lambda_roll_x = -m kap Om y'/(1 + kap)",
                Value("lambda_roll_x + m kap/(1 + kap) Om y'"),
            ),
            (
                "lambda_roll_y = m kap Om x'/(1 + kap)",
                Value("lambda_roll_y - m kap/(1 + kap) Om x'"),
            ),
        ],
    }
    .check();
}

/// m x'' = -ρ λ x'/s, m y'' = -ρ λ y'/s, m z'' = λ - m g with s² = x'² + y'², and λ = m g/(1 + ρ²).
/// appell1911; hamel1949; neimark-fufaev1972, ch. IV.
#[test]
fn appell_and_hamel() {
    Page {
        model: "appell-hamel",
        formulation: ROUTH,
        group: MOTION,
        names: &[],
        equations: &[
            (
                "m x'' = -rho lambda_cone x'/sqrt(x'^2 + y'^2)",
                Value("m x'' + rho lambda_cone x'/sqrt(x'^2 + y'^2)"),
            ),
            (
                "m y'' = -rho lambda_cone y'/sqrt(x'^2 + y'^2)",
                Value("m y'' + rho lambda_cone y'/sqrt(x'^2 + y'^2)"),
            ),
            (
                "m z'' + m g = lambda_cone",
                Value("m z'' - lambda_cone + m g"),
            ),
        ],
    }
    .check();
    Page {
        model: "appell-hamel",
        formulation: ROUTH,
        group: MULTIPLIERS,
        names: &[],
        equations: &[(
            "lambda_cone = m g/(1 + rho^2)",
            Value("lambda_cone - m g/(1 + rho^2)"),
        )],
    }
    .check();
}

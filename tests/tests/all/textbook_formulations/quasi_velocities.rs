//! Forms in quasi-velocities: Gibbs and Appell, Kane, Boltzmann and Hamel, Euler.

use super::{MOTION, OBJECTS, POLAR, SKATE_OF_PARTICLES};
use chetaev_tests::pages::Book::Value;
use chetaev_tests::pages::Page;

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

/// With the moment I ω + I₁₃ (ω₃, 0, ω₁) and ω₃ = 0: I₁ ω₁' = -I₁₃ ω₁ ω₂, I₂ ω₂' = I₁₃ ω₁², whatever the form; the third of Euler's
/// equations gives the reaction. suslov1946, sec. 53; bloch2003, sec. 8.6; fedorov-kozlov1995.
#[test]
fn suslovs_equations() {
    for formulation in ["boltzmann-hamel", "gibbs-appell", "maggi"] {
        Page {
            model: "suslov",
            formulation,
            group: MOTION,
            names: &["w1", "w2"],
            equations: &[
                ("I1 w1' + I13 w1 w2 = 0", Value("I1 w1' + I13 w1 w2")),
                ("I2 w2' - I13 w1^2 = 0", Value("I2 w2' - I13 w1^2")),
            ],
        }
        .check();
    }
    Page {
        model: "suslov",
        formulation: "gibbs-appell",
        group: OBJECTS,
        names: &["w1", "w2", "S"],
        equations: &[(
            "S = 1/2 I1 w1'^2 + 1/2 I2 w2'^2 + I13 w1 (w2 w1' - w1 w2')",
            Value("S - (I1 w1'^2 + I2 w2'^2)/2 - I13 w1 (w2 w1' - w1 w2')"),
        )],
    }
    .check();
}

/// M' = M × ω with M = I ω + m r² (ω - (ω·γ) γ), γ the vertical in the body with γ' = γ × ω: since ω·γ' = 0, the terms with γ'
/// drop out and (I₁ + m r²) ω₁' - m r² (ω'·γ) γ₁ = (I₂ - I₃) ω₂ ω₃, and so on. chaplygin1903; borisov-mamaev2001.
#[test]
fn the_sphere_of_chaplygin() {
    Page {
        model: "chaplygin-sphere",
        formulation: "maggi",
        group: MOTION,
        names: &["w1", "w2", "w3"],
        equations: &[
            (
                "(I1 + m r^2 - m r^2 sin(theta)^2 sin(psi)^2) w1' - m r^2 w2' sin(theta)^2 sin(psi) cos(psi) - m r^2 w3' sin(theta) cos(theta) sin(psi) - (I2 - I3) w2 w3 = 0",
                Value("(I1 + m r^2) w1' - m r^2 (w1' sin(theta) sin(psi) + w2' sin(theta) cos(psi) + w3' cos(theta)) sin(theta) sin(psi) - (I2 - I3) w2 w3"),
            ),
            (
                "(I2 + m r^2 - m r^2 sin(theta)^2 cos(psi)^2) w2' - m r^2 w1' sin(theta)^2 sin(psi) cos(psi) - m r^2 w3' sin(theta) cos(theta) cos(psi) + (I1 - I3) w1 w3 = 0",
                Value("(I2 + m r^2) w2' - m r^2 (w1' sin(theta) sin(psi) + w2' sin(theta) cos(psi) + w3' cos(theta)) sin(theta) cos(psi) - (I3 - I1) w3 w1"),
            ),
            (
                "(I3 + m r^2 sin(theta)^2) w3' - m r^2 w1' sin(theta) cos(theta) sin(psi) - m r^2 w2' sin(theta) cos(theta) cos(psi) - (I1 - I2) w1 w2 = 0",
                Value("(I3 + m r^2) w3' - m r^2 (w1' sin(theta) sin(psi) + w2' sin(theta) cos(psi) + w3' cos(theta)) cos(theta) - (I1 - I2) w1 w2"),
            ),
        ],
    }
    .check();
}

/// The skate on an incline with T and V stated: F = (m G cos φ, 0) with G = g s, F* = (-m u', -J w'). kane-levinson1985, ch. 6;
/// T1 §9.3.
#[test]
fn kanes_forces_of_a_potential() {
    Page {
        model: "skate-incline",
        formulation: "kane",
        group: OBJECTS,
        names: &["u", "w", "F_u", "F_w", "Fstar_u", "Fstar_w"],
        equations: &[
            ("F_u = m gs cos(phi)", Value("F_u - m gs cos(phi)")),
            ("Fstar_u = -m u'", Value("Fstar_u + m u'")),
            ("F_w = 0", Value("F_w")),
            ("Fstar_w = -J w'", Value("Fstar_w + J w'")),
        ],
    }
    .check();
}

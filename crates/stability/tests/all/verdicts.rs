//! What is stated of the stability of steady motions, against the literature: the verdicts are those of the books, the critical values closed
//! forms.
#![allow(
    clippy::unwrap_used,
    clippy::excessive_precision,
    reason = "test code fails where it stands; values have the digits of their source"
)]

use crate::common::{disc, Case};
use chetaev_symbolic::Verdict;

/// The numbers in a condition.
fn numbers(condition: &str) -> Vec<f64> {
    condition
        .split_whitespace()
        .filter_map(|word| word.parse().ok())
        .collect()
}

const SLEIGH: &str = r#"
coordinates = ["x", "y", "phi"]
parameters = { m = 2, J = 0.3, a = 0.25, u = 1.2 }
[define]
cx = "x + a cos(phi)"
cy = "y + a sin(phi)"
[lagrangian]
T = "1/2 m (cx'^2 + cy'^2) + 1/2 J phi'^2"
[constraints]
blade = "x' sin(phi) = y' cos(phi)"
[steady.straight]
phi = 0
"x'" = "u"
"phi'" = 0
"#;

/// Mass ahead: stable by Lyapunov and Malkin; behind: unstable; at rest by the energy (Neimark and Fufaev 1972).
#[test]
fn the_sleigh() {
    let case = Case::new(SLEIGH);
    assert_eq!(case.said("stability.asymptotic", "straight"), "u > 0");
    assert_eq!(case.said("stability.nonlinear", "straight"), "u >= 0");
    assert_eq!(case.said("stability.linear", "straight"), "u >= 0");
    assert_eq!(case.said("stability.spectral", "straight"), "u >= 0");
    let Verdict::Conditional {
        proof,
        counterexample,
        ..
    } = case.verdict("stability.nonlinear", "straight")
    else {
        panic!("conditional");
    };
    assert!(
        proof.detail.contains("Lyapunov and Malkin"),
        "{}",
        proof.detail
    );
    // −m a u/(J + m a²) at the speed of the counterexample.
    let own = counterexample.unwrap();
    let at = own.point[0].exact.as_ref().unwrap().to_f64().value();
    let expected = -2.0 * 0.25 * at / (0.3 + 2.0 * 0.0625);
    let low: f64 = own.residual.0.parse().unwrap();
    assert!(
        (low - expected).abs() < 1e-14 * expected,
        "{low} {expected}"
    );
}

/// Stable, and never asymptotically, where ω² > A m g r/(C (C + m r²)), and Ω² > m g r/(A + m r²) (Routh 1905).
#[test]
fn the_disc() {
    let case = Case::new(&disc(
        "w = 2, Om = 6",
        r#"[steady.rolling]
theta = 0
"theta'" = 0
"psi'" = "w"
"phi'" = 0
[steady.spinning]
theta = 0
"theta'" = 0
"phi'" = "Om"
"psi'" = 0
"#,
    ));
    let weight: f64 = 1.5 * 9.81 * 0.4;
    let cases = [
        ("rolling", (0.06 * weight / (0.12 * (0.12 + 0.24))).sqrt()),
        ("spinning", (weight / (0.06 + 0.24)).sqrt()),
    ];
    for (motion, critical) in cases {
        assert_eq!(case.said("stability.asymptotic", motion), "refuted");
        for claim in [
            "stability.spectral",
            "stability.linear",
            "stability.nonlinear",
        ] {
            let found = numbers(&case.said(claim, motion));
            assert_eq!(found.len(), 2, "{claim} {motion}");
            assert!(
                (found[1] - critical).abs() < 1e-14 * critical,
                "{claim} {found:?} {critical}"
            );
            assert_eq!(found[0], -found[1]);
        }
    }
}

pub(crate) const TOP: &str = r#"
coordinates = ["a", "b", "c"]
parameters = { A = 0.0025, C = 0.0009, w = 0.2943, n = 80 }
[lagrangian]
T = "1/2 A (a'^2 cos(b)^2 + b'^2) + 1/2 C (c' - a' sin(b))^2"
V = "w cos(a) cos(b)"
[integrals]
vertical = "-A b' sin(a) + A a' cos(b) cos(a) sin(b) + C (c' - a' sin(b)) cos(a) cos(b)"
[steady.sleeping]
a = 0
b = 0
"a'" = 0
"b'" = 0
"c'" = "n"
"#;

/// Lagrange's top sleeps where C² n² > 4 A m g l, in angles that do not spin; the integrals prove it (Chetaev 1954).
#[test]
fn the_sleeping_top() {
    let case = Case::new(TOP);
    for claim in ["stability.linear", "stability.nonlinear"] {
        let found = case.said(claim, "sleeping");
        let values = numbers(&found);
        assert_eq!(values.len(), 2, "{claim}: {found}");
        assert!(
            (values[1] - 60.2771377334170815).abs() < 1e-12,
            "{claim}: {found}"
        );
        // The border belongs to what is stable of the top itself, not of its linear equations.
        let sign = if claim == "stability.linear" { "" } else { "=" };
        assert!(
            found.starts_with(&format!("n <{sign} ")) && found.contains(&format!("n >{sign} ")),
            "{found}"
        );
    }
    assert_eq!(case.said("stability.asymptotic", "sleeping"), "refuted");
}

/// At equality the linear part has chains and grows like t; the top is stable all the same, by the term of fourth order: the reduced potential is
/// (C² n²/48 A + m g l/24) θ⁴ + … there.
#[test]
fn the_top_at_its_critical_spin() {
    let text = TOP.replace(
        "A = 0.0025, C = 0.0009, w = 0.2943, n = 80",
        "A = 1, C = 2, w = 1",
    );
    let case = Case::new(&text.replace("= \"n\"", "= 1"));
    assert_eq!(case.said("stability.spectral", "sleeping"), "proved");
    let Verdict::Refuted(own) = case.verdict("stability.linear", "sleeping") else {
        panic!("a chain");
    };
    assert!(
        own.detail.contains("multiplicity 2 and 1 eigenvectors"),
        "{}",
        own.detail
    );
    let own = case.verdict("stability.nonlinear", "sleeping");
    assert_eq!(own.word(), "proved");
    assert!(own.detail().contains("term of order 4"), "{}", own.detail());
    // Where the spin is left in, its critical value √(4 A w)/C = √10 belongs to the condition.
    let text = TOP.replace(
        "A = 0.0025, C = 0.0009, w = 0.2943, n = 80",
        "A = 1, C = 0.2, w = 0.1, n = 4",
    );
    let found = Case::new(&text).said("stability.nonlinear", "sleeping");
    assert!(found.contains("n >= 3.16227766016837"), "{found}");
    assert!(found.contains("n <= -3.16227766016837"), "{found}");
}

/// Nutation about the two regular precessions: Ω² sin² θ + (C n/A − 2 Ω cos θ)² (Routh 1905); both are stable.
#[test]
fn the_precessing_top() {
    let case = Case::new(
        r#"
coordinates = ["phi", "theta", "psi"]
parameters = { A = 0.0025, C = 0.0009, w = 0.2943, W = 4 }
[lagrangian]
T = "1/2 A (theta'^2 + phi'^2 sin(theta)^2) + 1/2 C (psi' + phi' cos(theta))^2"
V = "w cos(theta)"
[steady.precession]
theta = "acos(3/5)"
"theta'" = 0
"phi'" = "W"
"psi'" = "(3/5 A W^2 + w)/(C W) - 3/5 W"
"#,
    );
    assert_eq!(case.said("steady.stated", "precession"), "proved");
    for claim in ["stability.linear", "stability.nonlinear"] {
        // For W = 0 there is no such motion.
        assert_eq!(case.said(claim, "precession"), "proved", "{claim}");
    }
}

/// The restricted problem of three bodies at a triangular point.
pub(crate) fn triangular(mu: &str) -> Case {
    Case::new(&format!(
        r#"
coordinates = ["x", "y"]
parameters = {{ mu = {mu} }}
[lagrangian]
L = "1/2 (x'^2 + y'^2) + x y' - y x' + (x^2 + y^2)/2 + (1 - mu)/sqrt((x + mu)^2 + y^2) + mu/sqrt((x - 1 + mu)^2 + y^2)"
[steady.L4]
x = "1/2 - mu"
y = "sqrt(3)/2"
"x'" = 0
"y'" = 0
"#
    ))
}

/// λ⁴ + λ² + (27/4) μ (1 − μ): bounded linear motions below Routh's ratio, unstable above; of the nonlinear motion nothing follows, and it is
/// unstable at the resonances (Gascheau 1843; Markeev 1969).
#[test]
fn the_triangular_point() {
    for mu in ["0.01215", "0.02429389714", "0.01351601602"] {
        let case = triangular(mu);
        assert_eq!(case.said("stability.linear", "L4"), "proved");
        assert!(case
            .said("stability.nonlinear", "L4")
            .starts_with("undecided"));
    }
    let case = triangular("0.05");
    let Verdict::Refuted(own) = case.verdict("stability.nonlinear", "L4") else {
        panic!("unstable");
    };
    let low: f64 = own.residual.0.parse().unwrap();
    assert!((low - 0.18198568988426841).abs() < 1e-15);
}

/// Two coordinates on a hill, with a gyroscopic force and damping.
pub(crate) fn gyroscopic(d: &str, gyro: &str) -> Case {
    Case::new(&format!(
        r#"
coordinates = ["x", "y"]
parameters = {{ G = {gyro}, d = {d} }}
[lagrangian]
L = "1/2 (x'^2 + y'^2) + 1/2 (x^2 + 2 y^2) + G/2 (y x' - x y')"
[forces]
x = "-d x'"
y = "-d y'"
[steady.up]
x = 0
y = 0
"x'" = 0
"y'" = 0
"#
    ))
}

/// Gyroscopic forces stabilize what dissipation makes unstable again (Thomson and Tait 1879, Chetaev 1946).
#[test]
fn gyroscopic_stabilization() {
    assert_eq!(
        gyroscopic("0", "3").said("stability.linear", "up"),
        "proved"
    );
    // The equations are linear themselves, so that there is no other motion.
    assert_eq!(
        gyroscopic("0", "3").said("stability.nonlinear", "up"),
        "proved"
    );
    assert_eq!(
        gyroscopic("0", "2").said("stability.spectral", "up"),
        "refuted"
    );
    assert_eq!(
        gyroscopic("0.1", "3").said("stability.nonlinear", "up"),
        "refuted"
    );
}

/// A kinematic chain of two trailers: −v/Lᵢ, stable exactly forwards (Laumond 1993).
#[test]
fn trailers() {
    let model = |v: &str| {
        Case::new(&format!(
            r#"
coordinates = ["x", "y", "a", "b", "c"]
parameters = {{ v = {v}, m = 1 }}
[lagrangian]
T = "1/2 m (x'^2 + y'^2 + a'^2 + b'^2 + c'^2)"
[constraints]
drive_x = "x' = v cos(a)"
drive_y = "y' = v sin(a)"
ahead = "a' = 0"
first = "2 b' = v sin(a - b)"
second = "3 c' = v cos(a - b) sin(b - c)"
[steady.straight]
a = 0
b = 0
c = 0
"#
        ))
    };
    for claim in ["stability.asymptotic", "stability.nonlinear"] {
        assert_eq!(model("1.5").said(claim, "straight"), "proved", "{claim}");
        let Verdict::Refuted(own) = model("-1.5").verdict(claim, "straight") else {
            panic!("{claim}");
        };
        let low: f64 = own.residual.0.parse().unwrap();
        assert!((low - 0.75).abs() < 1e-15, "{low}");
    }
}

/// A rattleback: half axes, depth of the mass centre, three moments and the product of inertia, spin.
pub(crate) fn stone(m: [&str; 9]) -> Case {
    let [semi_a, semi_b, semi_c, h, ia, ib, ic, id, n] = m;
    Case::new(&format!(
        r#"
coordinates = ["x", "y", "ga", "al", "be"]
parameters = {{ m = 1, a = {semi_a}, b = {semi_b}, c = {semi_c}, h = {h}, A = {ia}, B = {ib}, Cz = {ic}, D = {id}, g = 9.81, n = {n} }}
[quasi_velocities]
w1 = "al' cos(be) - ga' cos(al) sin(be)"
w2 = "be' + ga' sin(al)"
w3 = "al' sin(be) + ga' cos(al) cos(be)"
[define]
n1 = "-cos(al) sin(be)"
n2 = "sin(al)"
n3 = "cos(al) cos(be)"
H = "sqrt(a^2 n1^2 + b^2 n2^2 + c^2 n3^2)"
r1 = "-a^2 n1/H"
r2 = "-b^2 n2/H"
r3 = "h - c^2 n3/H"
z = "H - h n3"
nd1 = "n2 w3 - n3 w2"
nd2 = "n3 w1 - n1 w3"
nd3 = "n1 w2 - n2 w1"
vz = "(a^2 n1 nd1 + b^2 n2 nd2 + c^2 n3 nd3)/H - h nd3"
c1 = "w2 r3 - w3 r2"
c2 = "w3 r1 - w1 r3"
c3 = "w1 r2 - w2 r1"
a1_x = "cos(ga) cos(be) - sin(ga) sin(al) sin(be)"
a1_y = "sin(ga) cos(be) + cos(ga) sin(al) sin(be)"
a2_x = "-sin(ga) cos(al)"
a2_y = "cos(ga) cos(al)"
a3_x = "cos(ga) sin(be) + sin(ga) sin(al) cos(be)"
a3_y = "sin(ga) sin(be) - cos(ga) sin(al) cos(be)"
[lagrangian]
T = "1/2 m (x'^2 + y'^2 + vz^2) + 1/2 (A w1^2 + B w2^2 + Cz w3^2) + D w1 w2"
V = "m g z"
[constraints]
roll_x = "x' + a1_x c1 + a2_x c2 + a3_x c3 = 0"
roll_y = "y' + a1_y c1 + a2_y c2 + a3_y c3 = 0"
[steady.spinning]
al = 0
be = 0
"al'" = 0
"be'" = 0
"ga'" = "n"
"#
    ))
}

/// λ⁴ + αnλ³ + (b₀ + b₂n²)λ² + αn³λ + e₀ + e₂n² + e₄n⁴: stable in one direction of spin above a threshold where b₀ > e₂, in none otherwise (Bondi 1986).
#[test]
fn the_rattleback() {
    let kane = stone([
        "0.2", "0.03", "0.02", "0.01", "0.0002", "0.0016", "0.0017", "-0.00002", "5",
    ]);
    assert_eq!(kane.said("stability.asymptotic", "spinning"), "refuted");
    // At rest it stands by its energy; spun it is stable in neither direction.
    assert_eq!(kane.said("stability.nonlinear", "spinning"), "n = 0");
    // So the stability is another there alone.
    let critical = kane.verdict("stability.critical", "n");
    assert_eq!(
        critical.detail(),
        "the spectral stability of spinning changes at n = 0 (with all eigenvalues on the axis or left of it there alone, unstable on both sides)"
    );
    let other = stone([
        "0.1",
        "0.06",
        "0.05",
        "0.005",
        "0.00061",
        "0.00125",
        "0.001292",
        "-0.000064",
        "10",
    ]);
    // At the threshold itself the first Lyapunov coefficient on the level of the energy is negative.
    for (claim, start) in [
        ("stability.asymptotic", "n > "),
        ("stability.nonlinear", "n >= "),
    ] {
        let found = other.said(claim, "spinning");
        let values = numbers(&found);
        assert!(
            values
                .first()
                .is_some_and(|own| (own - 20.7582375224592356).abs() < 1e-13),
            "{claim}: {found}"
        );
        assert!(found.starts_with(start), "{claim}: {found}");
    }
}

/// Where the second variation is degenerate the term of fourth order decides: x⁴ is stable and −x⁴ is not.
#[test]
fn what_higher_terms_decide() {
    for (sign, expected) in [("-", "proved"), ("+", "refuted")] {
        let case = Case::new(&format!(
            r#"
coordinates = ["x", "y", "z"]
parameters = {{ k = 1 }}
[lagrangian]
L = "1/2 (x'^2 + y'^2 + z'^2) {sign} 1/4 x^4 - 1/2 k y^2"
[steady.rest]
x = 0
y = 0
"x'" = 0
"y'" = 0
"z'" = 0
"#
        ));
        assert_eq!(case.said("stability.spectral", "rest"), "proved");
        let Verdict::Refuted(own) = case.verdict("stability.linear", "rest") else {
            panic!("a chain");
        };
        assert!(
            own.detail.contains("multiplicity 3 and 2 eigenvectors"),
            "{}",
            own.detail
        );
        assert_eq!(case.said("stability.nonlinear", "rest"), expected);
    }
}

/// Masses and lengths of very different sizes, and a constraint that is stated twice, change nothing.
#[test]
fn scales_and_redundant_constraints() {
    let scaled = SLEIGH
        .replace(
            "m = 2, J = 0.3, a = 0.25",
            "m = 2e-30, J = 3e-11, a = 2.5e9",
        )
        .replace(
            "blade =",
            "again = \"2 x' sin(phi) = 2 y' cos(phi)\"\nblade =",
        );
    let case = Case::new(&scaled);
    assert_eq!(case.said("stability.nonlinear", "straight"), "u >= 0");
    assert_eq!(case.said("stability.critical", "u"), "proved");
}

/// Hanging by the energy, inverted unstable by an enclosed eigenvalue.
#[test]
fn the_double_pendulum_hangs() {
    let case = Case::gallery("double-pendulum");
    assert_eq!(case.said("stability.nonlinear", "hanging"), "proved");
    assert_eq!(case.said("stability.linear", "hanging"), "proved");
    assert_eq!(case.said("stability.nonlinear", "inverted"), "refuted");
}

/// Dissipation that does not reach all motions leaves eigenvalues on the axis; the energy, which never grows, proves the equilibrium stable where it has
/// a minimum, and nothing where it has none (Thomson and Tait 1879, Chetaev 1946).
#[test]
fn dissipation_that_reaches_one_motion_only() {
    let model = |stiffness: &str, damping: &str| {
        Case::new(&format!(
            r#"
coordinates = ["x", "y"]
parameters = {{ k = {stiffness} }}
[lagrangian]
L = "1/2 (x'^2 + y'^2) - 1/2 k x^2 - y^2 - 1/4 y^4"
[forces]
x = "-({damping}) x'"
[steady.rest]
x = 0
y = 0
"x'" = 0
"y'" = 0
"#
        ))
    };
    assert_eq!(
        model("1", "1/5").said("stability.asymptotic", "rest"),
        "refuted"
    );
    assert_eq!(
        model("1", "1/5").said("stability.nonlinear", "rest"),
        "proved"
    );
    assert_eq!(
        model("-1", "1/5").said("stability.nonlinear", "rest"),
        "refuted"
    );
    // Driven instead of damped.
    assert_eq!(
        model("1", "-1/5").said("stability.nonlinear", "rest"),
        "refuted"
    );
    // A force that is no dissipation of second degree: open, as the linear equations and the energy say nothing.
    assert!(model("1", "x")
        .said("stability.nonlinear", "rest")
        .starts_with("undecided"));
}

/// On the circle x² + y² = 1 every place is one of rest, reached by damping, whether the motion is stated by numbers or by an angle.
#[test]
fn a_place_on_a_curve_of_equilibria_given_by_numbers() {
    for stated in [
        "x = 0.6\ny = 0.8",
        "x = \"cos(b)\"\ny = \"sin(b)\"",
        "x = \"2^(-1/2)\"\ny = \"-2^(-1/2)\"",
    ] {
        let case = Case::new(&format!(
            r#"
coordinates = ["x", "y"]
parameters = {{ b = 1 }}
[lagrangian]
T = "1/2 (x'^2 + y'^2)"
[forces]
x = "-x' - (x^2 + y^2 - 1) x"
y = "-y' - (x^2 + y^2 - 1) y"
[steady.o]
{stated}
"x'" = 0
"y'" = 0
"#
        ));
        assert_eq!(case.said("stability.asymptotic", "o"), "proved", "{stated}");
        assert_eq!(case.said("stability.nonlinear", "o"), "proved", "{stated}");
    }
    // At the centre, where the other factors vanish, it is no member: the eigenvalues are (−1 ± √5)/2.
    let centre = Case::new(
        r#"
coordinates = ["x", "y"]
[lagrangian]
T = "1/2 (x'^2 + y'^2)"
[forces]
x = "-x' - (x^2 + y^2 - 1) x"
y = "-y' - (x^2 + y^2 - 1) y"
[steady.o]
x = 0
y = 0
"x'" = 0
"y'" = 0
"#,
    );
    assert_eq!(centre.said("stability.nonlinear", "o"), "refuted");
}

/// A force that contains the time is no Lagrangian that does: rest at x = 0 is there for all times, and is not looked at.
#[test]
fn a_force_of_the_time_blames_no_lagrangian() {
    let case = Case::new(
        r#"
coordinates = ["x"]
[lagrangian]
T = "1/2 x'^2"
[forces]
x = "-(1 + cos(t)/3) x - x'"
[steady.o]
x = 0
"x'" = 0
"#,
    );
    assert_eq!(case.verdict("steady.stated", "o").word(), "undecided");
}

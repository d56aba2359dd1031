//! What theorems say where the linear equations decide nothing: normal forms whose answer is known, systems of the literature.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use crate::common::Case;
use chetaev_symbolic::Verdict;

/// A first-order system in the velocities of ignorable coordinates of mass 1, about a state.
fn first_order(rates: &[(&str, &str)], at: &[&str], further: &str) -> Case {
    let names: Vec<&str> = rates.iter().map(|own| own.0).collect();
    let coordinates: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    let squares: Vec<String> = names.iter().map(|name| format!("1/2 {name}'^2")).collect();
    let forces: Vec<String> = rates
        .iter()
        .map(|(name, rate)| format!("{name} = \"{rate}\""))
        .collect();
    let steady: Vec<String> = names
        .iter()
        .zip(at)
        .map(|(name, at)| format!("\"{name}'\" = \"{at}\""))
        .collect();
    Case::new(&format!(
        "coordinates = [{}]\n{further}\n[lagrangian]\nT = \"{}\"\n[forces]\n{}\n[steady.state]\n{}\n",
        coordinates.join(", "),
        squares.join(" + "),
        forces.join("\n"),
        steady.join("\n")
    ))
}

fn detail(case: &Case, motion: &str) -> String {
    case.verdict("stability.nonlinear", motion)
        .detail()
        .to_owned()
}

/// A particle with friction in a potential without a quadratic term.
fn with_friction(force: &str) -> Case {
    Case::new(&format!(
        "coordinates = [\"x\"]\n[lagrangian]\nT = \"1/2 x'^2\"\n[forces]\nx = \"{force}\"\n[steady.rest]\nx = 0\n\"x'\" = 0\n"
    ))
}

/// Lyapunov's critical case of one zero eigenvalue: x' = −x³, x³, x², and −x⁵ after cancellation by `x'`.
#[test]
fn one_zero_eigenvalue() {
    for (force, expected) in [
        ("-x' - x^3", "proved"),
        ("-x' + x^3", "refuted"),
        ("-x' - x^2", "refuted"),
        ("-2 x' - sin(x)^5", "proved"),
        ("-x' - x^3 + 7 x'^2", "proved"),
        // −x' − x² + x x' with x' ≈ −x²: still −x² first.
        ("-x' - x^2 + x x'", "refuted"),
    ] {
        let case = with_friction(force);
        assert_eq!(
            case.said("stability.nonlinear", "rest"),
            expected,
            "{force}"
        );
        assert!(
            detail(&case, "rest").contains("one zero eigenvalue"),
            "{force}"
        );
    }
}

/// A chain of two zeros: a cusp, a saddle, and where further terms decide; beside a variable that dies away and bends the manifold.
#[test]
fn two_zero_eigenvalues() {
    for (force, expected) in [
        ("x^2", "refuted"),
        ("x^3 + x'^2", "refuted"),
        ("x^2 x' + x^3 - x'^3", "refuted"),
        ("-x^3 - x^2 x'", "undecided"),
    ] {
        let found = with_friction(force).said("stability.nonlinear", "rest");
        assert!(found.starts_with(expected), "{force}: {found}");
    }
    // b = a² + …, so that a' = c, c' = a b = a³; with −3 a b it is −a³ + …
    for (rate, expected) in [("a' b'", "refuted"), ("-3 a' b'", "undecided")] {
        let case = first_order(
            &[("a", "c'"), ("c", rate), ("b", "-b' + a'^2")],
            &["0", "0", "0"],
            "",
        );
        let found = case.said("stability.nonlinear", "state");
        assert!(found.starts_with(expected), "{rate}: {found}");
    }
}

/// The noncritical variable feeds back: a' = a b, b' = −b + σ a² is a' = σ a³ on the centre manifold (Carr 1981, ch. 1).
#[test]
fn the_centre_manifold_bends() {
    for (sigma, expected) in [("-1", "proved"), ("1", "refuted")] {
        let case = first_order(
            &[("a", "a' b'"), ("b", &format!("-b' + {sigma} a'^2"))],
            &["0", "0"],
            "",
        );
        assert_eq!(case.said("stability.nonlinear", "state"), expected);
    }
    // a' = a b, b' = −b + a² − 2 b²: b = a² − … again, and unstable; a' = a³ + a b, b' = −b − 2 a²: −1 in all, stable (ibid.).
    let case = first_order(
        &[("a", "a'^3 + a' b'"), ("b", "-b' - 2 a'^2")],
        &["0", "0"],
        "",
    );
    assert_eq!(case.said("stability.nonlinear", "state"), "proved");
}

/// Pure potentials, also where the second variation vanishes in a plane: definite, saddle and monkey saddle.
#[test]
fn degenerate_potentials() {
    for (potential, expected) in [
        ("x^4", "proved"),
        ("-x^4", "refuted"),
        ("x^3", "refuted"),
        ("1/2 y^2 + x y^2 + x^4", "proved"),
        // y = −x² on the bottom of the valley: 1/2 y² + x² y + c x⁴ is (c − 1/2) x⁴ there.
        ("1/2 y^2 + x^2 y + x^4", "proved"),
        ("1/2 y^2 + x^2 y + 1/4 x^4", "refuted"),
        ("1/2 y^2 + x^2 y + 1/2 x^4 + x^6", "proved"),
        ("x^4 + y^4 - x^2 y^2", "proved"),
        ("x^4 + y^4 - 3 x^2 y^2", "refuted"),
        ("x^3 - 3 x y^2", "refuted"),
    ] {
        let case = Case::new(&format!(
            "coordinates = [\"x\", \"y\"]\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2) + 1/2 x^2 y'^2\"\nV = \"{potential}\"\n[steady.rest]\nx = 0\ny = 0\n\"x'\" = 0\n\"y'\" = 0\n"
        ));
        let found = case.said("stability.nonlinear", "rest");
        assert_eq!(found, expected, "{potential}");
    }
    // Semidefinite quartic: nothing is said.
    let case = Case::new(
        "coordinates = [\"x\", \"y\"]\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2)\"\nV = \"x^2 y^2\"\n[steady.rest]\nx = 0\ny = 0\n\"x'\" = 0\n\"y'\" = 0\n",
    );
    assert!(case
        .said("stability.nonlinear", "rest")
        .starts_with("undecided"));
}

/// A bead on a wire y = c x⁴ with its height as a second coordinate, under a constraint that is stated twice.
#[test]
fn a_bead_on_a_flat_wire() {
    for (c, expected) in [("1", "proved"), ("-1", "refuted")] {
        let case = Case::new(&format!(
            "coordinates = [\"x\", \"y\"]\nparameters = {{ m = 3, g = 9.81 }}\n[lagrangian]\nT = \"1/2 m (x'^2 + y'^2)\"\nV = \"m g y\"\n[constraints]\nwire = \"y = {c} x^4\"\nagain = \"2 y = 2 ({c}) x^4\"\n[steady.rest]\nx = 0\ny = 0\n\"x'\" = 0\n"
        ));
        assert_eq!(case.said("stability.nonlinear", "rest"), expected, "{c}");
    }
}

/// A gyroscopic force keeps a particle on a quartic hill, or not; natural systems only are refuted by their potential.
#[test]
fn a_hill_with_gyroscopic_forces_is_open() {
    let case = Case::new(
        "coordinates = [\"x\", \"y\"]\n[lagrangian]\nL = \"1/2 (x'^2 + y'^2) + x y' - y x' + x^4 + y^4\"\n[steady.rest]\nx = 0\ny = 0\n\"x'\" = 0\n\"y'\" = 0\n",
    );
    assert!(case
        .said("stability.nonlinear", "rest")
        .starts_with("undecided"));
}

/// Hopf points with known first Lyapunov coefficients: Lorenz 2.66e-4, the Brusselator −0.324, Watt's governor negative.
#[test]
fn hopf_points() {
    let lorenz = first_order(
        &[
            ("x", "10 (y' - x')"),
            ("y", "470/19 x' - y' - x' z'"),
            ("z", "x' y' - 8/3 z'"),
        ],
        &[
            "sqrt(8/3 (470/19 - 1))",
            "sqrt(8/3 (470/19 - 1))",
            "470/19 - 1",
        ],
        "",
    );
    assert_eq!(lorenz.said("stability.nonlinear", "state"), "refuted");
    let Verdict::Refuted(own) = lorenz.verdict("stability.nonlinear", "state") else {
        panic!("refuted");
    };
    assert!(
        own.detail.contains("first Lyapunov coefficient"),
        "{}",
        own.detail
    );
    let brusselator = first_order(
        &[
            ("x", "1.3 - (2.69 + 1) x' + x'^2 y'"),
            ("y", "2.69 x' - x'^2 y'"),
        ],
        &["1.3", "2.69/1.3"],
        "",
    );
    assert_eq!(brusselator.said("stability.nonlinear", "state"), "proved");
}

/// w' = i w + c w |w|² beside a conserved b: on each level c decides.
#[test]
fn a_pair_on_the_levels_of_an_integral() {
    for (sign, expected) in [("-", "proved"), ("+", "refuted")] {
        let case = first_order(
            &[
                ("p", &format!("-q' {sign} p' (p'^2 + q'^2) + b' p'")),
                ("q", &format!("p' {sign} q' (p'^2 + q'^2) + b' q'")),
                ("b", "0"),
            ],
            &["0", "0", "0"],
            "",
        );
        assert_eq!(case.said("stability.nonlinear", "state"), expected);
        let said = detail(&case, "state");
        assert!(said.contains("on the level of the momentum of b"), "{said}");
    }
    // The level bends: with the integral b + k (p² + q²)/2 the growth b turns into −k |w|²/2 there.
    for (k, expected) in [("1", "proved"), ("-1", "refuted")] {
        let case = first_order(
            &[
                ("p", "-q' + b' p'"),
                ("q", "p' + b' q'"),
                ("b", &format!("-({k}) b' (p'^2 + q'^2)")),
            ],
            &["0", "0", "0"],
            &format!("[integrals]\nI = \"b' + ({k}) (p'^2 + q'^2)/2\"\n"),
        );
        assert_eq!(case.said("stability.nonlinear", "state"), expected, "{k}");
    }
}

/// Without an integral oscillations drift along the family: a' = −b + c a, b' = a + c b, c' = e (a² + b²) (Fiedler, Liebscher, Alexander 2000).
#[test]
fn a_pair_on_a_line_of_equilibria() {
    for (e, expected) in [("-2", "proved"), ("2", "refuted")] {
        let case = first_order(
            &[
                ("a", "-b' + c' a'"),
                ("b", "a' + c' b'"),
                ("c", &format!("{e} (a'^2 + b'^2)")),
            ],
            &["0", "0", "0"],
            "",
        );
        assert_eq!(case.said("stability.nonlinear", "state"), expected, "{e}");
        assert!(detail(&case, "state").contains("Fiedler"));
    }
}

/// x'' = −x + x'² keeps no energy that is known, and is reversible; with a drop of friction it is not.
#[test]
fn reversal() {
    let rest = "\n[steady.rest]\nx = 0\n\"x'\" = 0\n";
    let case = |force: &str| {
        Case::new(&format!(
            "coordinates = [\"x\"]\n[lagrangian]\nT = \"1/2 x'^2\"\n[forces]\nx = \"{force}\"{rest}"
        ))
    };
    let own = case("-x + x'^2 + x^2");
    assert_eq!(own.said("stability.nonlinear", "rest"), "proved");
    assert!(detail(&own, "rest").contains("reversal"));
    assert_eq!(
        case("-x + x'^2 - x'^3").said("stability.nonlinear", "rest"),
        "proved"
    );
    assert!(!detail(&case("-x + x'^2 - x'^3"), "rest").contains("reversal"));
    assert_eq!(
        case("-x + x'^2 + x'^3").said("stability.nonlinear", "rest"),
        "refuted"
    );
}

/// A trailer runs straight behind its car, and both turn round where the car's yaw rate is not exactly zero.
#[test]
fn the_trailer_drifts() {
    let case = Case::new(
        r#"
coordinates = ["x", "y", "t0", "t1"]
parameters = { m = 2, J = 0.5, M = 0.5, J1 = 0.05, d = 0.6, v = 1.2 }
[define]
x1 = "x - d cos(t1)"
y1 = "y - d sin(t1)"
[lagrangian]
T = "1/2 m (x'^2 + y'^2) + 1/2 J t0'^2 + 1/2 M (x1'^2 + y1'^2) + 1/2 J1 t1'^2"
[constraints]
car = "x' sin(t0) = y' cos(t0)"
axle = "x1' sin(t1) = y1' cos(t1)"
[integrals]
yaw = "t0'"
[steady.driving]
t0 = 0
t1 = 0
"x'" = "v"
"t0'" = 0
"#,
    );
    let verdict = case.verdict("stability.nonlinear", "driving");
    assert_eq!(verdict.word(), "refuted");
    // At rest nothing is known.
    let said = verdict.detail();
    assert!(
        said.ends_with("false for v < 0 or v > 0, and not decided at v = 0"),
        "{said}"
    );
    assert_eq!(case.said("stability.asymptotic", "driving"), "refuted");
}

/// A sliding tippe top where its spin becomes unstable: at a given value K of Jellett's integral the energy without sliding is, with y = 1 − cos θ and
/// R = 1, m g a y + K²/(2 D), D = A (2 y − y²) + C (1 − a − y)²; where its slope at y = 0 vanishes, 2 D'² − D D'' decides (Karapetyan and Kuleshov
/// 2002). With A = 1.8 and C = 2 that is 2 · 0.4² − 1.28 · 0.4 < 0, with A = 2.4 it is 2 · 1.6² + 1.28 · 0.8 > 0.
#[test]
fn the_tippe_top_at_its_threshold() {
    for (inertia, is_stable) in [("0.0000018", false), ("0.0000024", true)] {
        let case = Case::gallery_with(
            "tippe-top",
            "A = { value = 0.0000018",
            &format!("A = {{ value = {inertia}"),
        );
        let found = case.said("stability.nonlinear", "below");
        assert!(
            !detail(&case, "below").contains("nothing is said"),
            "{inertia}"
        );
        assert_eq!(found.contains("<="), is_stable, "{inertia}: {found}");
    }
}

/// The benchmark bicycle at its weave speed: simulated on the energy of the upright motion there, its lean dies away like t^(−1/2).
#[test]
fn the_bicycle_at_its_weave_speed() {
    let case = Case::gallery("whipple-bicycle");
    let found = case.said("stability.nonlinear", "upright");
    assert!(
        found.starts_with("4.292382536341104 <= v < 6.024262015388359"),
        "{found}"
    );
    assert!(detail(&case, "upright").contains("on the level of the energy is negative"));
}

/// Equations that are linear themselves are decided by their eigenvectors. x'' = −x + y, y'' = −y has the solution x = t sin t/2, y = cos t, and x'' = x +
/// 2 y', y'' = y − 2 x' has (λ² + 1)² with one vector, as with ζ = x + i y the solutions of ζ'' + 2 i ζ' − ζ = 0 are (a + b t) e^(−i t): both are unstable.
/// With 3 in the place of 2 ζ turns with (−3 ± √5)/2 and stays bounded. Beside a cubic force nothing of that follows.
#[test]
fn equations_that_are_linear_themselves() {
    let cases = [
        ("-x + y", "-y", "refuted"),
        ("x + 2 y'", "y - 2 x'", "refuted"),
        ("x + 3 y'", "y - 3 x'", "proved"),
        ("-x + y - x^2 y", "-y", "undecided"),
    ];
    for (x, y, expected) in cases {
        let case = Case::new(&format!(
            "coordinates = [\"x\", \"y\"]\nlagrangian = \"1/2 x'^2 + 1/2 y'^2\"\nforces = {{ x = \"{x}\", y = \"{y}\" }}\n[steady.rest]\nx = 0\ny = 0\n\"x'\" = 0\n\"y'\" = 0\n"
        ));
        let found = case.verdict("stability.nonlinear", "rest");
        assert_eq!(found.word(), expected, "{x}, {y}: {}", found.detail());
    }
}

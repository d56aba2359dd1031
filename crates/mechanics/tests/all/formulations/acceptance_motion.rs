//! Acceptance of T1 §0 (virtual displacements, regularity), §1 (accelerations, multipliers and motions of S1–S4) and §4
//! (numbers of constants, the conditions (13)–(15), the second variation), the change of multipliers with the form of a
//! constraint (T0 §3, T3 §3), and the implicit constraint z'³ + z' = x'y': capabilities C1, C2, C5, C6 and C22.
//!
//! The separating examples for R2 and R3 are in `corrections.rs`, R4 and R5 in `hypotheses.rs`, the equations (11) in
//! `vakonomic.rs`; the refusal of f² = 0 is a test of the command line.

use crate::formulations::acceptance_support::{chart, motion, Sheet};
use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, SKATE};
use crate::formulations::voronets::CUBIC;
use chetaev_mechanics::curvature::curvature;
use chetaev_mechanics::Characteristics;
use chetaev_symbolic::Expr;

/// S1 has the displacements (cos φ, sin φ, 0) and (0, 0, 1), and for S1–S4 every choice of dependent velocities spans the same
/// space, which f_v annihilates: (C) and (C').
#[test]
fn virtual_displacements() {
    let case = Case::new(SKATE);
    let s = Sheet::of(&case);
    let b = chart(&case, &[1]).basis;
    for stated in [["cos(phi)", "sin(phi)", "0"], ["0", "0", "1"]] {
        let stated = s.all(&stated);
        for (row, &entry) in b.iter().zip(&stated) {
            s.same(s.dot(row, &[stated[0], stated[2]]), entry);
        }
    }
    let cases = [
        (SKATE, vec![vec![0], vec![1]]),
        (DISC, vec![vec![2, 3], vec![0, 2], vec![0, 3]]),
        (APPELL_HAMEL, vec![vec![2], vec![0], vec![1]]),
        (PARTICLE, vec![vec![2], vec![0]]),
    ];
    for (text, choices) in cases {
        let case = Case::new(text);
        let s = Sheet::of(&case);
        let cx = case.context();
        let zero = s.read("0");
        let charts: Vec<Characteristics> = choices.iter().map(|d| chart(&case, d)).collect();
        for from in &charts {
            for sigma in 0..from.k() {
                let column = from.column(sigma);
                for row in &cx.terms.jacobian {
                    assert!(case.equal_on_constraints(s.dot(row, &column), zero));
                }
                for to in &charts {
                    let weights: Vec<Expr> = to.independent.iter().map(|&i| column[i]).collect();
                    for (row, &entry) in to.basis.iter().zip(&column) {
                        assert!(
                            case.equal_on_constraints(s.dot(row, &weights), entry),
                            "{text}"
                        );
                    }
                }
            }
        }
    }
}

/// λ and a of S1–S4 as printed, and 2n - r constants.
#[test]
fn accelerations_and_multipliers_of_the_notes() {
    let rho = "sqrt(x'^2 + y'^2)";
    let horizontal = |v: &str| format!("-g a {v}/((1 + a^2) {rho})");
    let cases: [(&str, Vec<String>, Vec<&str>); 4] = [
        (
            SKATE,
            vec![
                "G cos(phi)^2 - (x' cos(phi) + y' sin(phi)) phi' sin(phi)".into(),
                "G sin(phi) cos(phi) + (x' cos(phi) + y' sin(phi)) phi' cos(phi)".into(),
                "0".into(),
            ],
            vec!["-m (x' cos(phi) + y' sin(phi)) phi' - m G sin(phi)"],
        ),
        (
            DISC,
            vec![
                "0".into(),
                "0".into(),
                "-R theta' phi' sin(phi)".into(),
                "R theta' phi' cos(phi)".into(),
            ],
            vec!["-m R theta' phi' sin(phi)", "m R theta' phi' cos(phi)"],
        ),
        (
            APPELL_HAMEL,
            vec![
                horizontal("x'"),
                horizontal("y'"),
                "-g a^2/(1 + a^2)".into(),
            ],
            vec!["m g/(1 + a^2)"],
        ),
        (
            PARTICLE,
            vec![
                "-y x' y'/(1 + y^2)".into(),
                "0".into(),
                "x' y'/(1 + y^2)".into(),
            ],
            vec!["x' y'/(1 + y^2)"],
        ),
    ];
    for (text, accelerations, multipliers) in cases {
        let case = Case::new(text);
        let (n, r) = (case.system.n(), multipliers.len());
        let routh = case.equations("routh");
        for (&found, printed) in routh.accelerations.iter().zip(&accelerations) {
            assert!(
                case.equal_on_constraints(found, case.read(printed)),
                "{printed}"
            );
        }
        for ((_, found), printed) in routh.multipliers.iter().zip(multipliers) {
            assert!(
                case.equal_on_constraints(*found, case.read(printed)),
                "{printed}"
            );
        }
        // Df = 0 with these accelerations.
        let s = Sheet::of(&case);
        let cx = case.context();
        for &f in &cx.terms.constraints {
            let rate =
                s.g.substitute(case.system.total_derivative(f), &motion(&case));
            assert!(case.equal_on_constraints(rate, s.read("0")), "{text}");
        }
        // Constants: q and admissible v; for the constrained extremum κ(0) as well.
        let basis = chetaev_mechanics::claims::formulation::basis(&cx);
        let independent = basis.independent_velocities().unwrap().k();
        assert_eq!(n + independent, 2 * n - r);
        assert_eq!(n + case.equations("vakonomic").variables.len() - r, 2 * n);
    }
}

/// Residuals `q'' - a` of Routh's equations and f at a motion given as functions of the time.
fn residuals(case: &Case, stated: &[(&str, &str)]) -> (Vec<Expr>, Vec<Expr>) {
    let s = Sheet::of(case);
    let values: Vec<Expr> = stated.iter().map(|(_, e)| s.read(e)).collect();
    let rates: Vec<Expr> = values.iter().map(|&e| s.by(e, "t")).collect();
    let seconds: Vec<Expr> = rates.iter().map(|&e| s.by(e, "t")).collect();
    let mut pairs = Vec::new();
    for (i, (name, _)) in stated.iter().enumerate() {
        pairs.push((s.read(name), values[i]));
        pairs.push((s.read(&format!("{name}'")), rates[i]));
    }
    let accelerations = case.equations("routh").accelerations;
    let put = |e: Expr| s.g.substitute(e, &pairs);
    let of_motion = accelerations
        .iter()
        .zip(&seconds)
        .map(|(&a, &b)| s.sub(put(a), b))
        .collect();
    let cx = case.context();
    let of_constraints = cx.terms.constraints.iter().map(|&f| put(f)).collect();
    (of_motion, of_constraints)
}

/// S1 on a level plane: a circle; on the incline from rest: a cycloid that does not drift down the slope. S4: x = asinh t, y = t,
/// z = √(1 + t²) - 1. A drift along x is no motion.
#[test]
fn motions_in_closed_form() {
    let level = SKATE.replace("V = \"-m G x\"", "V = \"0\"");
    let circle = [
        ("x", "u/w sin(w t)"),
        ("y", "u/w (1 - cos(w t))"),
        ("phi", "w t"),
    ];
    let cycloid = [
        ("x", "G/(2 w^2) sin(w t)^2"),
        ("y", "G/(2 w^2) (w t - sin(2 w t)/2)"),
        ("phi", "w t"),
    ];
    let slope = [("x", "asinh(t)"), ("y", "t"), ("z", "sqrt(1 + t^2) - 1")];
    for (text, stated) in [
        (level.as_str(), circle),
        (SKATE, cycloid),
        (PARTICLE, slope),
    ] {
        let case = Case::new(text);
        let s = Sheet::of(&case);
        let (of_motion, of_constraints) = residuals(&case, &stated);
        for e in of_motion.into_iter().chain(of_constraints) {
            s.vanishes(e);
        }
    }
    let case = Case::new(SKATE);
    let s = Sheet::of(&case);
    // λ = -2 m G sin(w t) on the cycloid, -m u w on the circle.
    let multiplier = s.read("-m (x' cos(phi) + y' sin(phi)) phi' - m G sin(phi)");
    let on_cycloid = s.put(
        multiplier,
        &[
            ("x'", "G/w sin(w t) cos(w t)"),
            ("y'", "G/w sin(w t)^2"),
            ("phi'", "w"),
            ("phi", "w t"),
        ],
    );
    s.equal(on_cycloid, "-2 m G sin(w t)");
    let at_one = [("G", "1"), ("w", "1"), ("t", "1")];
    let place = [cycloid[0].1, cycloid[1].1].map(|e| s.put(s.read(e), &at_one));
    let place = s.g.evaluate_f64(&place, &|_| None).unwrap();
    assert!((place[0] - 0.354036709136785).abs() < 1e-15);
    assert!((place[1] - 0.272675643293579).abs() < 1e-15);
    let (wrong, _) = residuals(
        &case,
        &[("x", "G/(2 w^2) sin(w t)^2 + t"), cycloid[1], cycloid[2]],
    );
    s.fails(wrong[0]);
}

/// S3: ψ' = 0 and ρ + g a t/(1 + a²) is constant, so that ρ = 0 at t = ρ(0)(1 + a²)/(g a).
#[test]
fn the_machine_of_appell_and_hamel_runs_down() {
    let case = Case::new(APPELL_HAMEL);
    let s = Sheet::of(&case);
    let motion = motion(&case);
    for integral in ["sqrt(x'^2 + y'^2) + g a t/(1 + a^2)", "y'/x'"] {
        let rate = case.system.total_derivative(s.read(integral));
        let along = s.g.substitute(rate, &motion);
        assert!(case.equal_on_constraints(along, s.read("0")), "{integral}");
    }
    let end = s.put(
        s.read("rho_0 - g a t/(1 + a^2)"),
        &[("t", "rho_0 (1 + a^2)/(g a)")],
    );
    s.vanishes(end);
}

/// Condition (15), Σ θ_l A^l_s = 0: identically for S2, on motions for S3, not for S4, where the sums are (y x'y', -y x'²), and
/// not for S1.
#[test]
fn the_condition_of_suslovs_form() {
    let sums = |text: &str, dependent: &[usize]| {
        let case = Case::new(text);
        let s = Sheet::of(&case);
        let c = chart(&case, dependent);
        let a = curvature(&case.system, &c);
        let theta: Vec<Expr> = dependent
            .iter()
            .map(|&d| {
                let v = case.system.coordinates[d].v_symbol;
                c.restrict(&case.system, &[s.g.diff(case.system.lagrangian, v)])[0]
            })
            .collect();
        let sums: Vec<Expr> = (0..c.k())
            .map(|sigma| {
                let column: Vec<Expr> = a.iter().map(|row| row[sigma]).collect();
                s.dot(&theta, &column)
            })
            .collect();
        (case, sums)
    };
    let (disc, found) = sums(DISC, &[2, 3]);
    for e in found {
        assert!(disc.equal(e, disc.read("0")));
    }
    let (particle, found) = sums(PARTICLE, &[2]);
    for (e, printed) in found.iter().zip(["y x' y'", "-y x'^2"]) {
        assert!(particle.equal(*e, particle.read(printed)));
    }
    let (skate, found) = sums(SKATE, &[1]);
    assert!(!skate.equal(found[0], skate.read("0")));
    let (cone, found) = sums(APPELL_HAMEL, &[2]);
    let motion = motion(&cone);
    for e in found {
        assert!(!cone.equal_on_constraints(e, cone.read("0")));
        let along = cone.system.graph.substitute(e, &motion);
        assert!(cone.equal_on_constraints(along, cone.read("0")));
    }
}

/// Whether the motion solves (11) with these multipliers, functions of (q, v).
fn is_extremal(case: &Case, kappa: &[(&str, &str)]) -> bool {
    let s = Sheet::of(case);
    let motion = motion(case);
    let mut pairs = motion.clone();
    for (name, value) in kappa {
        let value = s.read(value);
        let rate = s.g.substitute(case.system.total_derivative(value), &motion);
        pairs.push((s.read(name), value));
        pairs.push((s.read(&format!("{name}'")), rate));
    }
    let stated = case.equations("vakonomic");
    stated.groups[0].equations.iter().all(|e| {
        let residual = s.g.substitute(s.sub(e.left, e.right), &pairs);
        case.equal_on_constraints(residual, s.read("0"))
    })
}

/// The motions of S2 solve (11) with κ = (-m x', -m y'), those of S3 with κ = m ρ/a + C for every C, those of the integrable
/// constraint with κ' = -λ. κ = 0 works where λ = 0 only, and κ = -θ does not work for S3.
#[test]
fn multipliers_of_the_extremum_along_motions() {
    let disc = Case::new(DISC);
    let own = [("kappa_rolling_x", "-m x'"), ("kappa_rolling_y", "-m y'")];
    assert!(is_extremal(&disc, &own));
    let none = [("kappa_rolling_x", "0"), ("kappa_rolling_y", "0")];
    assert!(!is_extremal(&disc, &none));
    let cone = Case::new(APPELL_HAMEL);
    assert!(is_extremal(
        &cone,
        &[("kappa_cone", "m sqrt(x'^2 + y'^2)/a + C")]
    ));
    assert!(!is_extremal(
        &cone,
        &[("kappa_cone", "-m a sqrt(x'^2 + y'^2)")]
    ));
    assert!(!is_extremal(&cone, &[("kappa_cone", "0")]));
    // z = x y is the leaf; λ = z'', so κ = C - z'.
    let saddle = Case::new(&PARTICLE.replace("z' = y x'", "z' = y x' + x y'"));
    assert!(is_extremal(&saddle, &[("kappa_c", "C - z'")]));
    assert!(!is_extremal(&saddle, &[("kappa_c", "C + z'")]));
    let particle = Case::new(PARTICLE);
    assert!(!is_extremal(&particle, &[("kappa_c", "-z'")]));
    assert!(!is_extremal(&particle, &[("kappa_c", "0")]));
}

/// (15a) for L = (v² - w² q²)/2: the extremal variations that start at zero are multiples of sin(w t)/w. They vanish at π/w, and
/// not between; so t_c - t_0 = π/w, and the index counts the multiples of π/w.
#[test]
fn the_conjugate_time_of_an_oscillator() {
    let text = r#"
coordinates = ["x"]
parameters = { w = {} }
assumptions = ["w > 0"]
lagrangian = { L = "1/2 (x'^2 - w^2 x^2)" }
"#;
    let case = Case::new(text);
    let s = Sheet::of(&case).positive(&["w", "t"]);
    let acceleration = case.equations("routh").accelerations[0];
    // The linearized equation of a solution η.
    let eta = s.read("sin(w t)/w");
    let linearized = s.along(acceleration, &[("x", eta), ("x'", s.by(eta, "t"))]);
    s.same(s.by(s.by(eta, "t"), "t"), linearized);
    s.vanishes(s.put(eta, &[("t", "0")]));
    s.equal(s.put(s.by(eta, "t"), &[("t", "0")]), "1");
    for multiple in 1..4 {
        s.vanishes(s.put(eta, &[("t", &format!("{multiple} pi/w"))]));
    }
    // Between: η(c π/w) = sin(c π)/w > 0 for 0 < c < 1.
    for c in ["1/6", "1/2", "5/6", "19/20"] {
        let value = s.mul(s.read("w"), s.put(eta, &[("t", &format!("{c} pi/w"))]));
        let value = s.g.evaluate_f64(&[value], &|_| Some(1.7)).unwrap()[0];
        assert!(value > 0.1, "{c}: {value}");
    }
    s.fails(s.put(eta, &[("t", "pi/(2 w)")]));
}

/// S3: Bᵀ F_vv B with F = L + κ f and κ = m ρ/a + C has the value m (1 + a²) along the motion and -C a/ρ across it, and no mixed
/// one.
#[test]
fn the_second_variation_of_appell_and_hamel() {
    let case = Case::new(APPELL_HAMEL);
    let s = Sheet::of(&case).positive(&["rho"]);
    let cx = case.context();
    let f = s.sum(&[
        case.system.lagrangian,
        s.mul(s.read("kappa"), cx.terms.constraints[0]),
    ]);
    let v = case.system.velocity_symbols();
    let gradient = s.g.gradient(f, &v);
    let hessian = s.g.jacobian(&gradient, &v);
    let polar = [
        ("x'", "rho cos(psi)"),
        ("y'", "rho sin(psi)"),
        ("kappa", "m rho/a + C"),
    ];
    let along = s.all(&["cos(psi)", "sin(psi)", "a"]);
    let across = s.all(&["-sin(psi)", "cos(psi)", "0"]);
    for direction in [&along, &across] {
        let row = s.dot(&cx.terms.jacobian[0], direction);
        s.vanishes(s.put(row, &polar));
    }
    let form = |a: &[Expr], b: &[Expr]| {
        let rows: Vec<Expr> = hessian.iter().map(|row| s.dot(row, b)).collect();
        s.put(s.dot(a, &rows), &polar)
    };
    s.equal(form(&along, &along), "m (1 + a^2)");
    s.equal(form(&across, &across), "-C a/rho");
    s.vanishes(form(&along, &across));
}

/// R1–R5 of the worked systems: all hold, R5 off a subset.
#[test]
fn regularity_of_the_worked_systems() {
    for text in [SKATE, DISC, APPELL_HAMEL, PARTICLE] {
        let case = Case::new(text);
        for claim in [
            "model.constraints-independent",
            "model.accelerations-unique",
            "model.hessian-regular",
            "model.restricted-hessian-regular",
            "model.constrained-extremum-regular",
        ] {
            expect(&case, claim, "proved");
        }
    }
}

/// (13') off Chaplygin's case: D(κ + θ) = ∂L*/∂z on the motions of S3, with κ = m ρ/a, θ = m a ρ and ∂L*/∂z = -m g.
#[test]
fn the_rate_of_the_multiplier_beyond_chaplygin() {
    let case = Case::new(APPELL_HAMEL);
    let s = Sheet::of(&case);
    let theta = s.by(case.system.lagrangian, "z'");
    assert!(case.equal_on_constraints(theta, s.read("m a sqrt(x'^2 + y'^2)")));
    let sum = s.sum(&[s.read("m sqrt(x'^2 + y'^2)/a"), theta]);
    let rate =
        s.g.substitute(case.system.total_derivative(sum), &motion(&case));
    s.equal(s.by(case.system.lagrangian, "z"), "-m g");
    assert!(case.equal_on_constraints(rate, s.read("-m g")));
    let other = s.sum(&[s.read("-m sqrt(x'^2 + y'^2)/a"), theta]);
    let rate =
        s.g.substitute(case.system.total_derivative(other), &motion(&case));
    assert!(!case.equal_on_constraints(rate, s.read("-m g")));
}

/// λ̂ = H^{-T} λ for f̂ = H f: h f, the quadratic form of the cone, and two constraints mixed; accelerations do not change. For
/// f = M Dg this is λ_g = Mᵀ λ_f.
#[test]
fn multipliers_of_constraints_written_otherwise() {
    let check = |other: &str, acceleration: &str, multipliers: &[&str]| {
        let rewritten = Case::new(other);
        let routh = rewritten.equations("routh");
        let first = rewritten.system.coordinate_index("x").unwrap();
        let stated = rewritten.read(acceleration);
        assert!(
            rewritten.equal_on_constraints(routh.accelerations[first], stated),
            "{other}"
        );
        for ((_, found), printed) in routh.multipliers.iter().zip(multipliers) {
            let printed = rewritten.read(printed);
            assert!(rewritten.equal_on_constraints(*found, printed), "{other}");
        }
    };
    let scaled = PARTICLE.replace("z' = y x'", "exp(x) (z' - y x') = 0");
    check(&scaled, "-y x' y'/(1 + y^2)", &["exp(-x) x' y'/(1 + y^2)"]);
    let square = APPELL_HAMEL.replace("z' = a sqrt(x'^2 + y'^2)", "(x'^2 + y'^2 - z'^2/a^2)/2 = 0");
    // On z' = a ρ this is -g a x'/((1 + a²) ρ) and λ̂ = -m g a/((1 + a²) ρ).
    check(
        &square,
        "-g a^2 x'/((1 + a^2) z')",
        &["-m g a^2/((1 + a^2) z')"],
    );
    let (x, y) = ("-m R sin(phi) phi' theta'", "m R cos(phi) phi' theta'");
    // f̂ = H f with H = [[1, x], [0, 2]]: λ̂ = H^{-T} λ.
    let mixed = DISC
        .replace(
            "\"x' = R cos(phi) theta'\"",
            "\"x' - R cos(phi) theta' + x (y' - R sin(phi) theta') = 0\"",
        )
        .replace(
            "\"y' = R sin(phi) theta'\"",
            "\"2 y' = 2 R sin(phi) theta'\"",
        );
    check(
        &mixed,
        "-R sin(phi) phi' theta'",
        &[x, &format!("({y} - x ({x}))/2")],
    );
}

/// z'³ + z' = x'y', f_d = 3 z'² + 1: φ_x = y'/f_d, φ_y = x'/f_d, φ_xx = -6 z' φ_x²/f_d, φ_xy = (1 - 6 z' φ_x φ_y)/f_d,
/// a^s = -g φ_s/(1 + φ_x² + φ_y²), λ = m g/(f_d (1 + φ_x² + φ_y²)).
#[test]
fn an_implicit_constraint() {
    let case = Case::new(CUBIC);
    let s = Sheet::of(&case);
    let c = chart(&case, &[2]);
    let (fd, phi_x, phi_y) = ("(3 z'^2 + 1)", "(y'/(3 z'^2 + 1))", "(x'/(3 z'^2 + 1))");
    let slopes = c.by_parameters(&case.system, &c.solved);
    let second = c.by_parameters(&case.system, &slopes[0]);
    let length = format!("(1 + {phi_x}^2 + {phi_y}^2)");
    let routh = case.equations("routh");
    let stated = [
        (slopes[0][0], phi_x.to_string()),
        (slopes[0][1], phi_y.to_string()),
        (second[0][0], format!("-6 z' {phi_x}^2/{fd}")),
        (second[0][1], format!("(1 - 6 z' {phi_x} {phi_y})/{fd}")),
        (second[1][0], format!("(1 - 6 z' {phi_x} {phi_y})/{fd}")),
        (routh.accelerations[0], format!("-g {phi_x}/{length}")),
        (routh.accelerations[1], format!("-g {phi_y}/{length}")),
        (routh.multipliers[0].1, format!("m g/({fd} {length})")),
    ];
    for (found, printed) in stated {
        assert!(
            case.equal_on_constraints(found, s.read(&printed)),
            "{printed}"
        );
    }
    // ∂φ_x/∂x' with z' held fixed is not φ_xx.
    assert!(!case.equal_on_constraints(second[0][0], s.read("0")));
    expect(&case, "formulation.equivalent#voronets", "proved");
}

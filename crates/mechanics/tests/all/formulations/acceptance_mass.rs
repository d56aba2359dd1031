//! Acceptance of T2 §1: the point law of Meshchersky with all laws of masses and all modes of thrust, the closed forms
//! (1a)–(1d), and E1, the rocket on Appell's constraint (§6).

use crate::formulations::common::{expect, Case};
use chetaev_mechanics::card::Relation;
use chetaev_mechanics::claims::mass::balance_residuals;
use chetaev_mechanics::{mass, particles, FORMULATIONS};
use chetaev_symbolic::{Expr, Verdict};

/// A particle of mass `mu` in the plane with this thrust, gravity and a nonlinear force, in the coordinates of `position`.
fn particle(coordinates: &str, position: &str, law: &str, mass: &str, thrust: &str) -> Case {
    Case::new(&format!(
        r#"
coordinates = {coordinates}
parameters = {{ b = {{}}, c = {{}}, g = {{}}, k = {{}} }}
{law}
[particles.p]
mass = "{mass}"
position = {position}
force = ["-k x'", "-g"]
thrust = {thrust}
"#
    ))
}

/// Every equivalent form: proved, or not applicable for the reason that begins with one of `excuses`; how many are proved.
fn proved_forms(case: &Case, excuses: &[&str]) -> usize {
    let equivalent = FORMULATIONS
        .iter()
        .filter(|f| f.card().relation == Relation::Equivalent);
    let mut proved = 0;
    for formulation in equivalent {
        let name = formulation.card().name;
        for claim in ["equivalent", "identity"] {
            if claim == "identity" && formulation.card().identity.is_none() {
                continue;
            }
            let finding = case.finding(&format!("formulation.{claim}#{name}"));
            match &finding.verdict {
                Verdict::Proved(_) => proved += usize::from(claim == "equivalent"),
                // There are particles only.
                Verdict::NotApplicable { hypothesis, .. }
                    if hypothesis == "model.bodies" || excuses.contains(&hypothesis.as_str()) => {}
                other => panic!("{claim}#{name}: {} {}", other.word(), other.detail()),
            }
        }
    }
    proved
}

const THRUSTS: &[&str] = &[
    "\"isotropic\"",
    "{ relative_velocity = [\"-c\", \"y x'\"] }",
    "{ exhaust_speed = \"c\" }",
    "{ absolute_velocity = [\"t\", \"-c\"] }",
    "{ force = [\"c t\", \"-x y'\"] }",
];

/// In the Cartesian plane: masses of t, of q, and with laws of their own, with all five kinds of thrust.
#[test]
fn all_laws_with_all_thrusts() {
    let own = |rate: &str| format!("[masses]\nM = {{ rate = \"{rate}\", initial = 2 }}");
    let laws = [
        (String::new(), "2 - b t"),
        (String::new(), "exp(-b t) + x^2"),
        (own("-b M"), "M"),
        (own("-b M^2 + t x"), "2 M + 1"),
        (own("b M (x'^2 + y'^2)"), "M"),
    ];
    for (law, mass) in &laws {
        for thrust in THRUSTS {
            let case = particle("[\"x\", \"y\"]", "[\"x\", \"y\"]", law, mass, thrust);
            expect(&case, "mass.balance", "proved");
            let excuses = [
                "model.masses-of-time",
                "model.forces-absent",
                "model.lagrangian-autonomous",
            ];
            let proved = proved_forms(&case, &excuses);
            assert!(proved >= 18, "{mass}, {thrust}: {proved} proved");
        }
    }
}

/// Positions that move with the time, in coordinates that are not Cartesian.
#[test]
fn moving_curved_coordinates() {
    for (law, mass) in [
        ("", "2 - b t + y"),
        ("[masses]\nM = { rate = \"-k M y'^2\", initial = 2 }", "M"),
    ] {
        for thrust in THRUSTS {
            let position = "[\"x + y^2\", \"t x y\"]";
            let case = particle("[\"x\", \"y\"]", position, law, mass, thrust);
            expect(&case, "mass.balance", "proved");
            for name in ["maggi", "kane", "gibbs-appell", "canonical", "nielsen"] {
                expect(&case, &format!("formulation.equivalent#{name}"), "proved");
            }
        }
    }
}

/// Where masses contain velocities only the forms apply that are built from the particle law, and they agree.
#[test]
fn masses_of_velocities() {
    for thrust in THRUSTS {
        let mass = "1 + b (x'^2 + y'^2)/2 + x y'";
        let case = particle("[\"x\", \"y\"]", "[\"x\", \"y\"]", "", mass, thrust);
        expect(&case, "mass.balance", "proved");
        let free = "model.masses-free-of-velocity";
        let excuses = [free, "model.masses-of-time", "model.forces-absent"];
        assert_eq!(proved_forms(&case, &excuses), 3, "{thrust}");
        expect(&case, free, "refuted");
        expect(&case, "formulation.equivalent#maggi", "proved");
        expect(&case, "formulation.equivalent#lagrange-dalembert", "proved");
        expect(&case, "formulation.equivalent#reduced", "proved");
    }
}

/// M_eff = Σ [ μ Jᵀ J − Jᵀ u ∂μ/∂v ], not symmetric: u = (-c, y x'), ∂μ/∂v = (b x', b y' + x).
#[test]
fn the_matrix_of_inertia_is_not_symmetric() {
    let mass = "1 + b (x'^2 + y'^2)/2 + x y'";
    let case = particle("[\"x\", \"y\"]", "[\"x\", \"y\"]", "", mass, THRUSTS[1]);
    let matrix = &case.context().terms.mass_matrix;
    let expected = [
        [format!("{mass} + c b x'"), "c (b y' + x)".into()],
        ["-y x' b x'".into(), format!("{mass} - y x' (b y' + x)")],
    ];
    for (row, expected) in matrix.iter().zip(&expected) {
        for (&entry, text) in row.iter().zip(expected) {
            assert!(case.equal(entry, case.read(text)), "{text}");
        }
    }
}

/// The classical error, R alone on the right, is refuted, and so are Ψ without the slopes of the mass, and Ψ with μ' ξ' twice.
#[test]
fn wrong_reactive_forces_are_refuted() {
    for (law, mass) in [
        ("", "2 - b t"),
        ("", "exp(-b t) + x^2"),
        ("[masses]\nM = { rate = \"b M x'\", initial = 2 }", "M"),
    ] {
        let case = particle("[\"x\", \"y\"]", "[\"x\", \"y\"]", law, mass, THRUSTS[1]);
        let (system, g) = (&case.system, &case.system.graph);
        let cx = case.context();
        let p = &system.particles[0];
        let rate = system.total_derivative(p.mass);
        let carried: Vec<Expr> = particles::velocity(system, p)
            .into_iter()
            .map(|own| g.mul(&[rate, own]))
            .collect();
        let right = balance_residuals(system);
        let free = chetaev_mechanics::Manifold::default();
        for factor in [1, -1] {
            let wrong: Vec<Expr> = right
                .iter()
                .zip(&carried)
                .map(|(&e, &carried)| g.add(&[e, g.mul(&[g.integer(factor), carried])]))
                .collect();
            let verdict = cx.prover.identity(system, &wrong, &free, "");
            assert_eq!(verdict.word(), "refuted", "{mass}");
        }
        if mass.contains('x') && law.is_empty() {
            let half = g.div(system.graph.one(), g.integer(2));
            let speed = case.read("x'^2 + y'^2");
            let slope = g.gradient(p.mass, &system.coordinate_symbols())[0];
            let wrong = g.add(&[right[0], g.mul(&[half, speed, slope])]);
            let verdict = cx.prover.identity(system, &[wrong], &free, "");
            assert_eq!(verdict.word(), "refuted");
        }
    }
}

/// One particle on a vertical line.
fn vertical(mass: &str, force: &str, thrust: &str, law: &str) -> Case {
    Case::new(&format!(
        "coordinates = [\"x\"]\nparameters = {{ b = {{}}, beta = {{}}, c = {{}}, g = {{}}, X = {{}}, mu0 = {{}}, v0 = {{}} }}\n{law}\n\
         [particles.p]\nmass = \"{mass}\"\nposition = [\"x\"]\nforce = [\"{force}\"]\nthrust = {thrust}\n"
    ))
}

/// (1a): v = v0 − g t + c ln(μ0/μ), (1b): μ v = μ0 v0 + g (μ0 t + b t²/2), (1c): v' = −g whatever μ: the derivatives of the closed
/// forms are the accelerations.
#[test]
fn closed_forms_of_the_point_law() {
    let burning = "mu0 exp(-b t) + t^2";
    let upwards = "{ relative_velocity = [\"-c\"] }";
    for (law, mass, thrust, speed) in [
        (
            "",
            burning,
            upwards,
            format!("v0 - g t + c log(mu0/({burning}))"),
        ),
        (
            "",
            "mu0 + b t",
            "{ absolute_velocity = [0] }",
            "(mu0 v0 - g (mu0 t + b t^2/2))/(mu0 + b t)".into(),
        ),
        ("", burning, "\"isotropic\"", "v0 - g t".into()),
    ] {
        let case = vertical(mass, &format!("-({mass}) g"), thrust, law);
        let g = &case.system.graph;
        let speed = case.read(&speed);
        let found = case.equations("routh").accelerations[0];
        let on_motion = g.substitute(found, &[(case.read("x'"), speed)]);
        assert!(
            case.equal(on_motion, case.system.total_derivative(speed)),
            "{mass}"
        );
        expect(&case, "mass.balance", "proved");
    }
}

/// (1d): μ = μ0 + β v²/2, u = −c, force X: (μ + c β v) v' = X.
#[test]
fn a_mass_that_grows_with_the_speed() {
    let mass = "mu0 + beta x'^2/2";
    let case = vertical(mass, "X", "{ relative_velocity = [\"-c\"] }", "");
    let found = case.equations("routh").accelerations[0];
    let expected = case.read(&format!("X/({mass} + c beta x')"));
    assert!(case.equal(found, expected));
    let thrust = mass::thrust(&case.system, &case.system.particles[0]);
    assert!(case.equal(thrust[0], case.read("-c beta x' x''")));
}

/// E1, with μ(t) = 2 − b t and with a law of its own.
fn rocket(mass: &str, law: &str) -> Case {
    Case::new(&format!(
        r#"
coordinates = ["x", "y", "z"]
parameters = {{ a = {{}}, b = {{}}, c = {{}}, g = {{}} }}
assumptions = ["a > 0", "x'^2 + y'^2 > 0"]
{law}
[particles.rocket]
mass = "{mass}"
position = ["x", "y", "z"]
force = [0, 0, "-({mass}) g"]
thrust = {{ exhaust_speed = "c" }}
[constraints]
cone = "z' = a sqrt(x'^2 + y'^2)"
"#
    ))
}

#[test]
fn the_rocket_on_appells_constraint() {
    let own = "[masses]\nM = { rate = \"-b\", initial = 2 }";
    for (mass, law, rate) in [("2 - b t", "", "-b"), ("M", own, "-b")] {
        let case = rocket(mass, law);
        expect(&case, "mass.balance", "proved");
        let routh = case.equations("routh");
        // λ = μ g/(1 + a²): the thrust has no component normal to the constraint.
        let (_, lambda) = routh.multipliers[0];
        let expected = case.read(&format!("({mass}) g/(1 + a^2)"));
        assert!(case.equal_on_constraints(lambda, expected));
        // P2' = 0, and P1' = −g a/(1 + a²) − c μ'/(μ sqrt(1 + a²)) for the horizontal speed P1.
        let a = &routh.accelerations;
        let g = &case.system.graph;
        let (x, y) = (case.read("x'"), case.read("y'"));
        let turning = g.sub(g.mul(&[x, a[1]]), g.mul(&[y, a[0]]));
        assert!(case.equal_on_constraints(turning, g.zero()));
        let speed = case.read("sqrt(x'^2 + y'^2)");
        let along = g.div(g.add(&[g.mul(&[x, a[0]]), g.mul(&[y, a[1]])]), speed);
        // |ξ'| = sqrt(1 + a²) P1 on the constraint.
        let size = "sqrt(x'^2 + y'^2 + z'^2)";
        let expected = case.read(&format!(
            "-g a/(1 + a^2) - c ({rate}) sqrt(x'^2 + y'^2)/(({mass}) {size})"
        ));
        assert!(case.equal_on_constraints(along, expected));
        let excuses = ["model.forces-absent", "model.lagrangian-autonomous"];
        assert!(proved_forms(&case, &excuses) >= 20);
    }
}

/// Ẽ = (−μ g a, 0) and Ψ̃ = (μ' [(1 + a²) P1 − c sqrt(1 + a²)], 0) along the characteristics of E1, here with y' = 0, where the
/// speed is |x'| = P1 and the first direction is (1, 0, a).
#[test]
fn the_forces_along_the_characteristics_of_the_rocket() {
    let case = Case::new(
        r#"
coordinates = ["x", "z"]
parameters = { a = {}, b = {}, c = {}, g = {} }
assumptions = ["a > 0", "x' > 0"]
[particles.rocket]
mass = "2 - b t"
position = ["x", "z"]
force = [0, "-(2 - b t) g"]
thrust = { exhaust_speed = "c" }
[constraints]
slope = "z' = a x'"
"#,
    );
    for name in ["volterra-first", "volterra-second-cartesian"] {
        let equations = case.equations(name);
        let force = case.object(&equations, "Etilde_x");
        assert!(case.equal(force, case.read("-(2 - b t) g a")), "{name}");
        let reactive = case.object(&equations, "Psitilde_x");
        let speed = "sqrt(x'^2 + a^2 x'^2)";
        let expected = format!("-b ((1 + a^2) x' - c (1 + a^2) x'/{speed})");
        assert!(case.equal(reactive, case.read(&expected)), "{name}");
    }
}

/// A model that states T with named masses and no thrust: isotropic change, as the particles it is the energy of.
#[test]
fn a_stated_energy_with_named_masses_changes_isotropically() {
    for masses in [
        "m = \"3 - b t\"",
        "m = \"3 + theta^2\"",
        "m = { rate = \"-b m theta'\", initial = 3 }",
    ] {
        let common = format!(
            "coordinates = [\"theta\", \"s\"]\nparameters = {{ b = {{}}, g = {{}} }}\n[masses]\n{masses}\n"
        );
        let stated = format!(
            "{common}[define]\nI = \"m s^2\"\n[lagrangian]\nT = \"1/2 I theta'^2 + 1/2 m s'^2\"\n\
             [forces]\ntheta = \"-m g s sin(theta)\"\ns = \"m g cos(theta)\"\n"
        );
        let particle = format!(
            "{common}[particles.p]\nmass = \"m\"\nposition = [\"s sin(theta)\", \"-s cos(theta)\"]\nforce = [0, \"-m g\"]\n"
        );
        let (stated, particle) = (Case::new(&stated), Case::new(&particle));
        let of = |case: &Case| -> Vec<String> {
            let g = &case.system.graph;
            let found = case.equations("routh").accelerations;
            found.into_iter().map(|e| g.text(e)).collect()
        };
        for (a, b) in of(&stated).iter().zip(of(&particle)) {
            let (a, b) = (stated.read(a), stated.read(&b));
            assert!(stated.equal(a, b), "{masses}");
        }
        // Without inertia of its own nothing pushes: the mass drops out.
        let fall = stated.equations("routh").accelerations[1];
        assert!(stated.equal(fall, stated.read("s theta'^2 + g cos(theta)")));
        expect(&stated, "mass.balance", "not-applicable");
        expect(&particle, "mass.balance", "proved");
    }
}

/// Stated reactive forces go before computed ones.
#[test]
fn reactive_forces_may_be_stated() {
    let case = Case::new(
        "coordinates = [\"x\"]\nparameters = { c = {}, b = {} }\nmasses = { M = \"3 - b t\" }\n\
         lagrangian = { T = \"1/2 M x'^2\" }\nreactive_forces = { x = \"b (c - x')\" }\n",
    );
    let found = case.equations("routh").accelerations[0];
    assert!(case.equal(found, case.read("b c/(3 - b t)")));
    let none = Case::new(
        "coordinates = [\"x\"]\nmasses = { M = \"3 - t\" }\nlagrangian = \"1/2 M x'^2\"\nreactive_forces = {}\n",
    );
    let found = none.equations("routh").accelerations[0];
    assert!(none.equal(found, none.read("x'/(3 - t)")));
}

/// Two particles share one mass with a law of its own; the energy is not conserved, and no action is.
#[test]
fn two_particles_share_one_mass() {
    let case = Case::new(
        r#"
coordinates = ["x", "y"]
parameters = { k = {} }
masses = { M = { rate = "-k M x'^2", initial = 1 } }
constraints = { rod = "x' = 2 y'" }
[particles.a]
mass = "M"
position = ["x"]
thrust = { relative_velocity = ["1"] }
[particles.b]
mass = "2 M"
position = ["y"]
"#,
    );
    expect(&case, "mass.balance", "proved");
    expect(&case, "model.masses-of-time", "refuted");
    expect(
        &case,
        "formulation.equivalent#volterra-first-cartesian",
        "not-applicable",
    );
    expect(&case, "formulation.equivalent#nielsen", "proved");
    // (M 4 + 2 M) y'' = 2 M' u with u = 1 and M' = -4 k M y'^2.
    let found = case.equations("maggi").accelerations[1];
    assert!(case.equal_on_constraints(found, case.read("-4 k y'^2/3")));
}

//! Acceptance of T1 §4.2, §4.3 and §5.1, exact: on which motions of S1 and S4 the constrained extremum coincides with the
//! motion (last column of the table of §4.3), condition (14) with constants, the three systems of the energy law (16), (17), and
//! for which systems the method of Hamilton and Jacobi applies (capabilities C6, C7, C11).
//!
//! The verdicts of the table are in `coincidence.rs`, further energy laws in `energy.rs`.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::{expr, finding, system, Text};
use chetaev_mechanics::claims::formulation::{derive, manifold};
use chetaev_mechanics::{Context, Equations, Prepared, Prover, Registry, System};
use chetaev_principles::energy::{energy_rate, reaction_speed};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::Expr;

const SKATE: Text = Text {
    coordinates: "x y phi",
    lagrangian: "m/2 (x'^2 + y'^2) + J/2 phi'^2 + m G x",
    forces: &[],
    constraints: &[("blade", "x' sin(phi) - y' cos(phi)")],
};
const DISC: Text = Text {
    coordinates: "theta phi x y",
    lagrangian: "I/2 theta'^2 + J/2 phi'^2 + m/2 (x'^2 + y'^2)",
    forces: &[],
    constraints: &[
        ("rolling_x", "x' - R cos(phi) theta'"),
        ("rolling_y", "y' - R sin(phi) theta'"),
    ],
};
const PARTICLE: Text = Text {
    coordinates: "x y z",
    lagrangian: "1/2 (x'^2 + y'^2 + z'^2)",
    forces: &[],
    constraints: &[("c", "z' - y x'")],
};

/// A system with its motion and the equations of the extremum.
struct Beside {
    system: System,
    routh: Equations,
    extremum: Option<Equations>,
}

fn beside(text: &Text, with_extremum: bool) -> Beside {
    let system = system(text);
    let (routh, extremum) = with(&system, |cx| {
        let extremum = with_extremum.then(|| derive(cx, "vakonomic").unwrap());
        (derive(cx, "routh").unwrap(), extremum)
    });
    Beside {
        system,
        routh,
        extremum,
    }
}

fn with<T>(system: &System, look: impl FnOnce(&Context<'_>) -> T) -> T {
    let prepared = Prepared::new(system).unwrap();
    let registry = Registry::new(&[]);
    let cx = Context::new(
        system,
        &prepared.terms,
        &prepared.selection,
        &registry,
        Prover::default(),
    );
    look(&cx)
}

impl Beside {
    fn read(&self, text: &str) -> Expr {
        expr(&self.system.graph, text)
    }

    fn put(&self, e: Expr, pairs: &[(&str, &str)]) -> Expr {
        let pairs: Vec<(Expr, Expr)> = pairs
            .iter()
            .map(|(a, b)| (self.read(a), self.read(b)))
            .collect();
        self.system.graph.substitute(e, &pairs)
    }

    /// De along the motion.
    fn rate(&self, e: Expr) -> Expr {
        let coordinates = self.system.coordinates.iter();
        let motion: Vec<(Expr, Expr)> = coordinates
            .zip(&self.routh.accelerations)
            .map(|(c, &a)| (c.a, a))
            .collect();
        self.system
            .graph
            .substitute(self.system.total_derivative(e), &motion)
    }

    fn word(&self, e: Expr) -> &'static str {
        let assumptions = Assumptions::new();
        decide_zero(
            &self.system.graph,
            &ZeroTest::everywhere(&[e], &assumptions),
        )
        .word()
    }

    #[track_caller]
    fn equal(&self, e: Expr, text: &str) {
        let difference = self.system.graph.sub(e, self.read(text));
        assert_eq!(self.word(difference), "proved", "{text}");
    }

    /// The word of the verdict on `e = text` on the constraints.
    fn on_constraints(&self, e: Expr, text: &str) -> &'static str {
        let difference = self.system.graph.sub(e, self.read(text));
        with(&self.system, |cx| {
            cx.prover
                .identity(&self.system, &[difference], &manifold(cx), "")
                .word()
        })
    }

    /// Left minus right sides of (11) with the accelerations of the motion, κ and κ', at a state.
    fn extremal(&self, state: &[(&str, &str)]) -> Vec<Expr> {
        let g = &self.system.graph;
        let coordinates = self.system.coordinates.iter();
        let motion: Vec<(Expr, Expr)> = coordinates
            .zip(&self.routh.accelerations)
            .map(|(c, &a)| (c.a, a))
            .collect();
        let stated = &self.extremum.as_ref().unwrap().groups[0].equations;
        stated
            .iter()
            .map(|e| g.substitute(g.sub(e.left, e.right), &motion))
            .map(|e| self.put(e, state))
            .collect()
    }

    #[track_caller]
    fn solves(&self, state: &[(&str, &str)], expected: bool) {
        let words: Vec<_> = self
            .extremal(state)
            .into_iter()
            .map(|e| self.word(e))
            .collect();
        let all = words.iter().all(|&w| w == "proved");
        assert_eq!(all, expected, "{state:?}: {words:?}");
        assert!(all || words.contains(&"refuted"), "{words:?}");
    }
}

/// S1. (12) is κ φ' = 0 and κ u = 0, so κ = 0 where the skate moves or turns, and (13) demands λ = 0 along the motion:
/// u φ' + G sin φ = 0. Its rate is 2 G φ' cos φ, so on an incline φ' = 0 and sin φ = 0; on a level plane u φ' = 0 is kept.
#[test]
fn motions_of_the_skate_that_are_extremals() {
    let b = beside(&SKATE, true);
    let g = &b.system.graph;
    let blade = [("x'", "u cos(phi)"), ("y'", "u sin(phi)")];
    let multiplier = b.put(b.routh.multipliers[0].1, &blade);
    b.equal(multiplier, "-m (u phi' + G sin(phi))");
    let power = b.read("(x' cos(phi) + y' sin(phi)) phi' + G sin(phi)");
    b.equal(b.put(b.rate(power), &blade), "2 G phi' cos(phi)");
    // Straight along the fall line, κ = 0; and the rest across it with κ' = -λ = m G.
    let still = [("kappa_blade", "0"), ("kappa_blade'", "0")];
    let at = |more: &[(&'static str, &'static str)]| -> Vec<(&'static str, &'static str)> {
        more.iter().copied().chain(still).collect()
    };
    let fall = at(&[("x'", "u"), ("y'", "0"), ("phi'", "0"), ("phi", "0")]);
    b.solves(&fall, true);
    let rest = [
        ("kappa_blade'", "m G"),
        ("x'", "0"),
        ("y'", "0"),
        ("phi'", "0"),
        ("phi", "pi/2"),
    ];
    b.solves(&rest, true);
    // Oblique straight lines and the cycloid are not extremals.
    b.solves(
        &at(&[("x'", "u cos(phi)"), ("y'", "u sin(phi)"), ("phi'", "0")]),
        false,
    );
    let cycloid = at(&[
        ("x'", "G/w sin(phi) cos(phi)"),
        ("y'", "G/w sin(phi)^2"),
        ("phi'", "w"),
    ]);
    b.solves(&cycloid, false);
    let any = [
        ("x'", "G/w sin(phi) cos(phi)"),
        ("y'", "G/w sin(phi)^2"),
        ("phi'", "w"),
    ];
    // With any κ, κ': the equation of φ demands κ u = 0, that along the displacement of the blade κ φ' = 0.
    let free = b.extremal(&any);
    b.equal(free[2], "-kappa_blade G/w sin(phi)");
    let along = g.add(&[
        g.mul(&[free[0], b.read("cos(phi)")]),
        g.mul(&[free[1], b.read("sin(phi)")]),
    ]);
    b.equal(along, "kappa_blade w");
    // On a level plane: straight glides and pure spins.
    let level = Text {
        lagrangian: "m/2 (x'^2 + y'^2) + J/2 phi'^2",
        ..SKATE
    };
    let b = beside(&level, true);
    b.solves(
        &at(&[("x'", "u cos(phi)"), ("y'", "u sin(phi)"), ("phi'", "0")]),
        true,
    );
    b.solves(&at(&[("x'", "0"), ("y'", "0")]), true);
    b.solves(&at(&[("x'", "u cos(phi)"), ("y'", "u sin(phi)")]), false);
}

/// S4: only y' = 0 or x' = 0, with κ = 0.
#[test]
fn motions_of_the_particle_that_are_extremals() {
    let b = beside(&PARTICLE, true);
    let at = |v: &'static str| [(v, "0"), ("kappa_c", "0"), ("kappa_c'", "0")];
    b.solves(&at("x'"), true);
    b.solves(&at("y'"), true);
    b.solves(&[("kappa_c", "0"), ("kappa_c'", "0")], false);
    let free = b.extremal(&[]);
    // y'' = 0 along the motion leaves κ x' = 0, and x with y times z leaves κ y' = 0.
    b.equal(free[1], "kappa_c x'");
    let g = &b.system.graph;
    let along = g.add(&[free[0], g.mul(&[b.read("y"), free[2]])]);
    b.equal(along, "-kappa_c y'");
    assert_eq!(
        b.on_constraints(b.routh.multipliers[0].1, "x' y'/(1 + y^2)"),
        "proved"
    );
}

/// (14): with κ = c - θ, S2 needs c = 0, and S4 has no constant c.
#[test]
fn chaplygin_systems_with_constants() {
    let b = beside(&DISC, true);
    let at = |c: [&'static str; 2]| [("kappa_rolling_x", c[0]), ("kappa_rolling_y", c[1])];
    let rates = [
        ("kappa_rolling_x'", "m R sin(phi) phi' theta'"),
        ("kappa_rolling_y'", "-m R cos(phi) phi' theta'"),
    ];
    let state = |c| at(c).into_iter().chain(rates).collect::<Vec<_>>();
    b.solves(
        &state(["-m R cos(phi) theta'", "-m R sin(phi) theta'"]),
        true,
    );
    b.solves(
        &state(["c - m R cos(phi) theta'", "-m R sin(phi) theta'"]),
        false,
    );
    let b = beside(&PARTICLE, true);
    let kappa = [("kappa_c", "c - y x'"), ("kappa_c'", "-x' y'/(1 + y^2)")];
    b.solves(&kappa, false);
}

/// y' = t x': λ = x'/(1 + t²), x' √(1 + t²) and H are constant although the constraint depends on the time.
#[test]
fn energy_of_a_rheonomic_homogeneous_constraint() {
    let b = beside(
        &Text {
            coordinates: "x y",
            lagrangian: "1/2 (x'^2 + y'^2)",
            forces: &[],
            constraints: &[("c", "y' - t x'")],
        },
        false,
    );
    let on_set = [("y'", "t x'")];
    b.equal(b.put(b.routh.multipliers[0].1, &on_set), "x'/(1 + t^2)");
    b.equal(b.put(b.rate(b.read("x' sqrt(1 + t^2)")), &on_set), "0");
    b.equal(b.put(b.system.energy(), &on_set), "(x' sqrt(1 + t^2))^2/2");
    let rate = energy_rate(&b.system, &b.routh.accelerations);
    assert_eq!(b.on_constraints(rate, "0"), "proved");
}

/// z' = y x' + b: D H = b λ with λ = x'y'/(1 + y²); (17) fails by b. S3: (17) holds by f = 0, v·f_v = f, and D H = 0. v·v = c²:
/// v·f_v is 2 c².
#[test]
fn energy_laws_of_affine_and_nonlinear_constraints() {
    let speed = |b: &Beside| with(&b.system, |cx| reaction_speed(cx, 0));
    let affine = Text {
        constraints: &[("c", "z' - y x' - b")],
        ..PARTICLE
    };
    let b = beside(&affine, false);
    let rate = energy_rate(&b.system, &b.routh.accelerations);
    assert_eq!(b.on_constraints(rate, "b x' y'/(1 + y^2)"), "proved");
    assert_eq!(b.on_constraints(rate, "0"), "refuted");
    assert_eq!(b.on_constraints(speed(&b), "b"), "proved");
    let b = beside(
        &Text {
            coordinates: "x y z",
            lagrangian: "m/2 (x'^2 + y'^2 + z'^2) - m g z",
            forces: &[],
            constraints: &[("cone", "z' - a sqrt(x'^2 + y'^2)")],
        },
        false,
    );
    let rate = energy_rate(&b.system, &b.routh.accelerations);
    assert_eq!(b.on_constraints(rate, "0"), "proved");
    assert_eq!(b.on_constraints(speed(&b), "0"), "proved");
    b.equal(speed(&b), "z' - a sqrt(x'^2 + y'^2)");
    assert_ne!(b.word(speed(&b)), "proved");
    let b = beside(
        &Text {
            coordinates: "x y",
            lagrangian: "m/2 (x'^2 + y'^2) - m g y",
            forces: &[],
            constraints: &[("speed", "x'^2 + y'^2 - c^2")],
        },
        false,
    );
    assert_eq!(b.on_constraints(speed(&b), "2 c^2"), "proved");
}

/// T1 §4.4, S3: `B^T F_vv B` with κ = m ρ/a + C is m (1 + a²) along the motion and −C a/ρ across it, so that the sign of C decides
/// on Legendre's condition; T1 §4.3: the bordered determinant is −m (1 + a²)(m − κ a/ρ), zero at C = 0.
#[test]
fn second_variation_of_the_cone() {
    let cone = Text {
        coordinates: "x y z",
        lagrangian: "m/2 (x'^2 + y'^2 + z'^2) - m g z",
        forces: &[],
        constraints: &[("cone", "z' - a sqrt(x'^2 + y'^2)")],
    };
    let b = beside(&cone, true);
    let g = &b.system.graph;
    let augmented = g.add(&[
        b.system.lagrangian,
        b.read("kappa_cone (z' - a sqrt(x'^2 + y'^2))"),
    ]);
    let velocities = b.system.velocity_symbols();
    let hessian = g.jacobian(&g.gradient(augmented, &velocities), &velocities);
    let along = ["x'/sqrt(x'^2 + y'^2)", "y'/sqrt(x'^2 + y'^2)", "a"];
    let across = ["-y'/sqrt(x'^2 + y'^2)", "x'/sqrt(x'^2 + y'^2)", "0"];
    let form = |u: [&str; 3], v: [&str; 3]| {
        let mut parts = Vec::new();
        for (i, row) in hessian.iter().enumerate() {
            for (j, &entry) in row.iter().enumerate() {
                parts.push(g.mul(&[b.read(u[i]), entry, b.read(v[j])]));
            }
        }
        let kappa = [("kappa_cone", "m sqrt(x'^2 + y'^2)/a + C")];
        b.put(g.add(&parts), &kappa)
    };
    b.equal(form(along, along), "m (1 + a^2)");
    b.equal(form(across, across), "-C a/sqrt(x'^2 + y'^2)");
    b.equal(form(along, across), "0");
    let determinant = with(&b.system, |cx| {
        let basis = chetaev_mechanics::claims::formulation::basis(cx);
        let matrix = chetaev_mechanics::formulations::extremum_matrix(&basis);
        chetaev_symbolic::matrix::determinant(g, &matrix)
    });
    b.equal(
        determinant,
        "-m (1 + a^2) (m - kappa_cone a/sqrt(x'^2 + y'^2))",
    );
}

/// The method of Hamilton and Jacobi integrates the motion where every motion is an extremal: S2 with its κ, not S4.
#[test]
fn where_hamilton_and_jacobi_apply() {
    for (text, word) in [
        (&DISC, "proved"),
        (&PARTICLE, "refuted"),
        (&SKATE, "refuted"),
    ] {
        let system = system(text);
        let found = finding(&system, "formulation.vakonomic-coincides#inclusion");
        assert_eq!(found.verdict.word(), word, "{}", found.verdict.detail());
    }
}

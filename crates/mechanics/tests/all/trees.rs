//! Random trees of bodies: Newton and Euler's, Kane's, Gibbs and Appell's and Maggi's equations are those of Routh, and slips in what is kept of a body are
//! refuted each time.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "test code fails where it stands"
)]

use chetaev_mechanics::claims::formulation::{derive, equivalence};
use chetaev_mechanics::claims::{Context, Prepared, Registry, CLAIMS};
use chetaev_mechanics::{Prover, System};
use chetaev_model::mechanism::Mechanism;
use chetaev_model::{load, NoFiles};
use chetaev_symbolic::{Rational, Verdict};
use std::fmt::Write as _;

/// Most bodies of a tree, and how many trees of each size are looked at. The trees of all sizes together take some seconds.
const TREES: &[(u64, u64)] = &[(1, 10), (2, 20), (3, 12), (4, 6), (8, 2)];

/// Numbers without a pattern (D. E. Knuth, The Art of Computer Programming 2, § 3.3.4, line 26 of table 1).
struct Random(u64);

impl Random {
    fn below(&mut self, most: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % most
    }

    fn one_of<'a>(&mut self, all: &[&'a str]) -> &'a str {
        all[self.below(all.len() as u64) as usize]
    }

    /// A tenth of a whole number from 1.
    fn positive(&mut self) -> String {
        format!("{}", (1 + self.below(20)) as f64 / 10.0)
    }

    fn vector(&mut self) -> String {
        let mut own = || (self.below(21) as f64 - 10.0) / 10.0;
        format!("[{}, {}, {}]", own(), own(), own())
    }
}

/// A tree of so many bodies. The first one turns in space; chains of up to 8 bodies hang by joints with one motion, as otherwise by any.
fn tree(count: u64, seed: u64) -> String {
    let mut random = Random(seed.wrapping_mul(1_000).wrapping_add(count));
    let mut text = "[bodies]\n".to_owned();
    for i in 0..count {
        // Second moments are positive, so that the inertia is that of a body.
        let [p, q, r] = [0; 3].map(|_| (1 + random.below(9)) as f64 / 10.0);
        let (mass, center, x, z) = (
            random.positive(),
            random.vector(),
            random.positive(),
            random.positive(),
        );
        let inertia = format!("xx = {:.1}, yy = {:.1}, zz = {:.1}", q + r, p + r, p + q);
        let _ = writeln!(text, "b{i} = {{ mass = {mass}, center = {center}, inertia = {{ {inertia}, turn = {{ x = {x}, z = {z} }} }} }}");
    }
    text += "[joints]\n";
    let root = random.one_of(&["free", "spherical", "universal"]);
    let _ = writeln!(text, "j0 = {{ type = \"{root}\", child = \"b0\" }}");
    for i in 1..count {
        let parent = random.below(i);
        let kinds: &[&str] = match count {
            5.. => &["revolute", "prismatic", "fixed"],
            _ => &[
                "revolute",
                "prismatic",
                "universal",
                "cylindrical",
                "spherical",
                "planar",
            ],
        };
        let kind = random.one_of(kinds);
        let at = random.vector();
        let mut entries =
            format!("type = \"{kind}\", parent = \"b{parent}\", child = \"b{i}\", at = {at}");
        let _ = write!(entries, ", tilt = {{ y = {} }}", random.positive());
        if matches!(kind, "revolute" | "prismatic") {
            let axis = random.one_of(&["x", "y", "z"]);
            let _ = write!(
                entries,
                ", axis = \"{axis}\", spring = {}, damper = {}",
                random.positive(),
                random.positive()
            );
        }
        let _ = writeln!(text, "j{i} = {{ {entries} }}");
    }
    // A ball or a blade of the last body, where the first is free.
    if root == "free" && count < 4 {
        let kind = random.one_of(&["rolling", "blade", "rolling-without-spinning", "sliding"]);
        let size = match kind {
            "blade" | "sliding" => "at = [0.1, 0.2, 0]".to_owned(),
            _ => format!("radius = {}", random.positive()),
        };
        let _ = writeln!(
            text,
            "[contacts]\nfoot = {{ type = \"{kind}\", body = \"b{}\", {size} }}",
            count - 1
        );
    }
    let force = random.vector();
    let _ = writeln!(
        text,
        "[forces]\npush = {{ body = \"b{}\", at = [0.3, 0, 0.1], in = \"b0\", force = {force} }}",
        count - 1
    );
    text
}

fn system_of(text: &str) -> System {
    let loaded = load("tree.toml", text, &NoFiles, &[]);
    let (model, _) = loaded
        .into_result()
        .unwrap_or_else(|problems| panic!("{text}{problems}"));
    System::from_model(&model).unwrap()
}

/// What is known of the equations of a form beside Routh's.
fn compared(system: &System, forms: &[&str]) -> Vec<Verdict> {
    let system = system.for_parameter_values().unwrap();
    let prepared = Prepared::new(&system).unwrap();
    let registry = Registry::new(&[CLAIMS]);
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(&system, terms, selection, &registry, Prover::default());
    let reference = derive(&cx, "routh").unwrap();
    let all = forms
        .iter()
        .map(|form| equivalence(&cx, &reference, &derive(&cx, form).unwrap()));
    all.collect()
}

#[test]
fn all_forms_are_the_same_equations_of_random_trees() {
    const FORMS: &[&str] = &["newton-euler", "kane", "gibbs-appell", "maggi"];
    for (count, most) in TREES {
        for seed in 0..*most {
            let text = tree(*count, seed);
            for (form, verdict) in FORMS.iter().zip(compared(&system_of(&text), FORMS)) {
                assert!(
                    matches!(verdict, Verdict::Proved(_)),
                    "{form}: {verdict:?}\n{text}"
                );
            }
        }
    }
}

#[test]
fn slips_in_random_trees_are_refuted() {
    type Slip = (&'static str, fn(&System, &mut Mechanism));
    const SLIPS: &[Slip] = &[
        ("the gyroscopic term is dropped", |system, all| {
            all.bodies[0].turning = [system.graph.zero(); 3];
        }),
        ("the inertia is taken in other axes", |_, all| {
            let own = all.bodies[0].inertia;
            // The axes x, y, z are called y, z, x.
            all.bodies[0].inertia =
                std::array::from_fn(|i| std::array::from_fn(|j| own[(i + 1) % 3][(j + 1) % 3]));
        }),
        ("Steiner's term has the wrong sign", |system, all| {
            let (g, body) = (&system.graph, &mut all.bodies[0]);
            // 2 m d² (1 − e e) for a centre that is shifted by d along the third axis.
            let moved = g.mul(&[body.mass, g.number(Rational::from(1) / Rational::from(5))]);
            for i in 0..2 {
                body.inertia[i][i] = g.add(&[body.inertia[i][i], moved]);
            }
        }),
    ];
    for seed in 0..10 {
        let text = tree(2, seed);
        for (name, change) in SLIPS {
            let mut system = system_of(&text);
            let mut mechanism = system.mechanism.take().unwrap();
            change(&system, &mut mechanism);
            system.mechanism = Some(mechanism);
            let verdict = compared(&system, &["newton-euler"]).remove(0);
            assert!(
                matches!(verdict, Verdict::Refuted(_)),
                "{name}: {verdict:?}\n{text}"
            );
        }
    }
}

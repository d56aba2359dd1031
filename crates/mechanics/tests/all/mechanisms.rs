//! Random trees and closed chains of bodies: Newton and Euler's, Kane's, Gibbs and Appell's and Maggi's equations are those of Routh, and slips in what is
//! kept of a body are refuted each time. A run takes a fifth of fifty of each (`chetaev_tests::extent`), a full one five hundred.
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

#[path = "../../../../tests/src/extent.rs"]
#[allow(
    dead_code,
    unreachable_pub,
    reason = "public where the tests of the workspace are"
)]
mod extent;

use extent::Extent;

/// How many bodies the fifty trees have, the most in the last ones, and how many the fifty closed chains.
const TREES: &[u64] = &[2, 1, 3, 2, 4, 3, 2, 1, 3, 8];
const CHAINS: &[u64] = &[2, 3, 2, 4, 3, 2, 5, 3, 2, 8];

/// How many are looked at, and in a full run.
const USUAL: u64 = 50;
const MANY: u64 = 500;

/// The numbers of the random cases that this run takes.
fn numbers() -> Vec<u64> {
    let extent = Extent::of_run(std::path::Path::new(env!("CARGO_MANIFEST_DIR")));
    let count = if extent == Extent::Full { MANY } else { USUAL };
    // Each part has cases of all sizes: ten numbers in a row are one part.
    (0..count)
        .filter(|number| extent.takes(number / 10))
        .collect()
}

fn size(sizes: &[u64], number: u64) -> u64 {
    sizes[(number % sizes.len() as u64) as usize]
}

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

/// So many bodies with inertias in axes of any directions.
fn bodies(count: u64, random: &mut Random) -> String {
    let mut text = "[bodies]\n".to_owned();
    for i in 0..count {
        // Second moments are positive, so that the inertia is that of a body, and different, so that it is that of no ball, which has no gyroscopic term.
        let steps = [0; 3].map(|_| (1 + random.below(4)) as f64 / 10.0);
        let [p, q, r] = [steps[0], steps[0] + steps[1], steps.iter().sum()];
        let (mass, center, x, z) = (
            random.positive(),
            random.vector(),
            random.positive(),
            random.positive(),
        );
        let inertia = format!("xx = {:.1}, yy = {:.1}, zz = {:.1}", q + r, p + r, p + q);
        let _ = writeln!(text, "b{i} = {{ mass = {mass}, center = {center}, inertia = {{ {inertia}, turn = {{ x = {x}, z = {z} }} }} }}");
    }
    text
}

/// A chain of so many bodies whose last one is tied to the ground, or to the first one, by a joint that closes it. Where all coordinates are zero all axes are
/// those of the ground, so that it is known where the chain closes. With `turns` the first body turns in space.
fn closed_chain(count: u64, seed: u64, turns: bool) -> String {
    let mut random = Random(seed.wrapping_mul(7_919).wrapping_add(count));
    let mut text = bodies(count, &mut random);
    text += "[joints]\n";
    let roots: &[(&str, u64)] = if turns {
        &[("spherical", 3)]
    } else {
        &[
            ("revolute", 1),
            ("universal", 2),
            ("spherical", 3),
            ("planar", 3),
        ]
    };
    let kinds: &[(&str, u64)] = match count {
        4.. => &[("revolute", 1), ("revolute", 1), ("prismatic", 1)],
        _ => &[
            ("revolute", 1),
            ("universal", 2),
            ("cylindrical", 2),
            ("spherical", 3),
        ],
    };
    let mut freedom = 0;
    let mut reach = [0i64; 3];
    let mut from_first = [0i64; 3];
    for i in 0..count {
        let all = if i == 0 { roots } else { kinds };
        let (kind, own) = all[random.below(all.len() as u64) as usize];
        freedom += own;
        let at = [0; 3].map(|_| random.below(21) as i64 - 10);
        for axis in 0..3 {
            reach[axis] += at[axis];
            from_first[axis] += if i == 0 { 0 } else { at[axis] };
        }
        let parent = match i {
            0 => String::new(),
            _ => format!(", parent = \"b{}\"", i - 1),
        };
        let axis = match kind {
            "revolute" | "prismatic" => format!(", axis = \"{}\"", random.one_of(&["x", "y", "z"])),
            _ => String::new(),
        };
        let tilt = format!(
            "tilt = {{ y = {}, x = {} }}",
            random.positive(),
            random.positive()
        );
        let _ = writeln!(
            text,
            "j{i} = {{ type = \"{kind}\", child = \"b{i}\", at = {}, {tilt}{parent}{axis} }}",
            tenths(at)
        );
    }
    // Of the joints that leave a motion, one; a chain of three and more bodies may close on its first one.
    let on_first = count > 2 && freedom > 5 && random.below(2) == 0;
    let free = if on_first { freedom - 3 } else { freedom };
    let closing: Vec<(&str, u64)> = [
        ("spherical", 3),
        ("planar", 3),
        ("universal", 4),
        ("cylindrical", 4),
        ("revolute", 5),
    ]
    .into_iter()
    .filter(|(_, taken)| *taken < free && (!turns || *taken < 4))
    .collect();
    let end = [0; 3].map(|_| random.below(21) as i64 - 10);
    let start = if on_first { from_first } else { reach };
    let whole: [i64; 3] = std::array::from_fn(|axis| start[axis] + end[axis]);
    let parent = if on_first { ", parent = \"b0\"" } else { "" };
    let (at, child_at) = (tenths(whole), tenths(end));
    let child = format!(
        "child = \"b{}\", at = {at}, child_at = {child_at}{parent}",
        count - 1
    );
    match closing.len() {
        // Too few motions for a joint: the distance of two points stays.
        0 => {
            let far: [i64; 3] = [whole[0] + 7, whole[1] - 3, whole[2] + 2];
            let _ = writeln!(text, "rod = {{ type = \"rope\", body = \"b{}\", at = {child_at}, to = \"ground\", to_at = {}, length = \"sqrt(62)/10\" }}", count - 1, tenths(far));
        }
        n => {
            let (kind, _) = closing[random.below(n as u64) as usize];
            let _ = writeln!(text, "loop = {{ type = \"{kind}\", {child} }}");
        }
    }
    let force = random.vector();
    let _ = writeln!(
        text,
        "[forces]\npush = {{ body = \"b0\", at = [0.3, 0, 0.1], in = \"b{}\", force = {force} }}",
        count - 1
    );
    text
}

fn tenths(v: [i64; 3]) -> String {
    let [x, y, z] = v.map(|own| own as f64 / 10.0);
    format!("[{x}, {y}, {z}]")
}

/// A tree of so many bodies. The first one turns in space; chains of up to 8 bodies hang by joints with one motion, as otherwise by any.
fn tree(count: u64, seed: u64) -> String {
    let mut random = Random(seed.wrapping_mul(1_000).wrapping_add(count));
    let mut text = bodies(count, &mut random);
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

/// Forms that are derived each by its own rule.
const FORMS: &[&str] = &["newton-euler", "kane", "gibbs-appell", "maggi"];

#[track_caller]
fn same_equations(text: &str) {
    for (form, verdict) in FORMS.iter().zip(compared(&system_of(text), FORMS)) {
        assert!(
            matches!(verdict, Verdict::Proved(_)),
            "{form}: {verdict:?}\n{text}"
        );
    }
}

#[test]
fn all_forms_are_the_same_equations_of_random_trees() {
    for number in numbers() {
        same_equations(&tree(size(TREES, number), number));
    }
}

#[test]
fn all_forms_are_the_same_equations_of_random_closed_chains() {
    for number in numbers() {
        same_equations(&closed_chain(size(CHAINS, number), number, false));
    }
}

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

fn slips_are_refuted(text: &str) {
    for (name, change) in SLIPS {
        let mut system = system_of(text);
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

#[test]
fn slips_in_random_trees_are_refuted() {
    for number in numbers() {
        slips_are_refuted(&tree(2, number));
    }
}

#[test]
fn slips_in_random_closed_chains_are_refuted() {
    for number in numbers() {
        slips_are_refuted(&closed_chain(2 + number % 2, number, true));
    }
}

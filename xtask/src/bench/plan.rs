//! Who is measured at what: items, participants, settings.

/// A participant at an item.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Participant {
    /// `chetaev`, or the name of a file of `bench/peers`.
    pub(crate) peer: &'static str,
    /// `text`, `derived` or `hand`.
    pub(crate) form: &'static str,
    /// Mode, method or formulation.
    pub(crate) variant: &'static str,
}

/// Participants measured side by side.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Item {
    /// `derive`, `rhs`, `trajectory`, `ensemble`, `drift`, `main-job` or `table`.
    pub(crate) kind: &'static str,
    /// The system.
    pub(crate) system: &'static str,
    /// Tolerance of integrations.
    pub(crate) tolerance: Option<f64>,
    /// Repeats.
    pub(crate) rounds: usize,
    /// Seconds of the processor after which a participant is not asked again, and is ended where it is at work.
    pub(crate) cap: f64,
    /// Trajectories of an ensemble.
    pub(crate) count: u64,
    /// Steps of a long run.
    pub(crate) steps: u64,
    /// In the order in which they are asked first.
    pub(crate) participants: Vec<Participant>,
}

const fn who(peer: &'static str, form: &'static str, variant: &'static str) -> Participant {
    Participant {
        peer,
        form,
        variant,
    }
}

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Extent {
    /// Under an hour instead of hours: fewer tolerances and repeats.
    pub(crate) quick: bool,
    /// Others beside us.
    pub(crate) peers: bool,
}

/// All items, the short ones first.
pub(crate) fn items(extent: Extent) -> Vec<Item> {
    let mut items = vec![main_job(extent)];
    items.extend(derivations(extent));
    items.extend(right_hand_sides(extent));
    items.extend(trajectories(extent));
    items.push(ensemble(extent));
    items.extend(long_runs(extent));
    items.extend(table(extent));
    for item in &mut items {
        item.participants
            .retain(|p| extent.peers || p.peer == "chetaev");
    }
    items
}

fn item(extent: Extent, kind: &'static str, system: &'static str) -> Item {
    Item {
        kind,
        system,
        tolerance: None,
        rounds: if extent.quick { 3 } else { 9 },
        cap: if extent.quick { 20.0 } else { 120.0 },
        count: 0,
        steps: 0,
        participants: Vec::new(),
    }
}

fn main_job(extent: Extent) -> Item {
    Item {
        participants: vec![who("chetaev", "text", "study")],
        ..item(extent, "main-job", "sleigh")
    }
}

/// The rows of the table of multi-level principles, each studied at d = 3.
pub(crate) const TABLE: &[&str] = &[
    "p4p", "p4c", "p4pb", "p4cb", "p3p", "p3c", "p3pb", "p3cb", "p3p1", "p3c1", "p3p0", "p3c0",
    "p2p", "p2c", "p2pb", "p2cb", "p2p0", "p2c0", "p2p1", "p2c1", "p1p", "p1c", "p0p", "p0c", "pp",
    "pc",
];

fn table(extent: Extent) -> Vec<Item> {
    let of = |&row: &&'static str| Item {
        rounds: if extent.quick { 1 } else { 3 },
        cap: 120.0,
        participants: vec![who("chetaev", "text", "study")],
        ..item(extent, "table", row)
    };
    TABLE.iter().map(of).collect()
}

/// The number of links of a snake; 0 for other systems.
pub(crate) fn links(system: &str) -> u32 {
    let size = system.strip_prefix("snake-");
    size.and_then(|n| n.parse().ok()).unwrap_or(0)
}

const ALL: &[&str] = &[
    "sleigh",
    "disc",
    "rattleback",
    "appell-hamel",
    "bicycle",
    "snake-2",
    "snake-4",
    "snake-8",
    "snake-16",
    "snake-32",
    "snake-64",
    "snake-128",
];

fn derivations(extent: Extent) -> Vec<Item> {
    let of = |&system: &&'static str| {
        let n = links(system);
        let mut list = vec![
            who("chetaev", "text", "flow"),
            who("chetaev", "text", "boltzmann-hamel"),
            who("casadi", "derived", "reduced"),
            who("casadi", "derived", "bordered"),
            who("heyoka", "derived", "plain"),
            who("heyoka", "derived", "compact"),
        ];
        // Kane's method of SymPy takes linear constraints.
        if system != "appell-hamel" && n <= 8 {
            list.push(who("sympy", "derived", "Kane"));
        }
        if extent.quick {
            // Minutes of gcc, and of one system of equations after the other.
            list.retain(|p| match p.peer {
                "chetaev" => true,
                "sympy" => n <= 4,
                _ => n < 64 && (n < 32 || p.variant != "bordered"),
            });
        }
        Item {
            cap: match (extent.quick, system) {
                (true, "bicycle" | "snake-32") => 90.0,
                (true, _) => 20.0,
                (false, _) => 300.0,
            },
            rounds: if extent.quick { 3 } else { 5 },
            participants: list,
            ..item(extent, "derive", system)
        }
    };
    ALL.iter().map(of).collect()
}

/// Our forms of which the right-hand side is measured.
const FORMS: &[(&str, &str)] = &[
    ("reduced", "reduced batch"),
    ("kane", "kane batch"),
    ("boltzmann-hamel", "boltzmann-hamel batch"),
    ("voronets", "voronets batch"),
];

fn right_hand_sides(extent: Extent) -> Vec<Item> {
    let of = |&system: &&'static str| {
        let mut list = vec![who("chetaev", "text", "flow")];
        for (one, many) in FORMS {
            list.extend([who("chetaev", "text", one), who("chetaev", "text", many)]);
        }
        list.extend([
            who("casadi", "derived", "reduced"),
            who("casadi", "derived", "bordered"),
            who("heyoka", "derived", "scalar"),
            who("heyoka", "derived", "batch"),
        ]);
        if system != "bicycle" {
            list.extend([
                who("gcc", "hand", "C"),
                who("casadi", "hand", "C"),
                who("heyoka", "hand", "scalar"),
                who("heyoka", "hand", "batch"),
                who("numba", "hand", "loop"),
                who("symjit", "hand", "arrays"),
            ]);
        }
        Item {
            participants: list,
            ..item(extent, "rhs", system)
        }
    };
    ALL[..10].iter().map(of).collect()
}

fn trajectories(extent: Extent) -> Vec<Item> {
    let tolerances = |system: &str| -> &[f64] {
        match (extent.quick, system) {
            (true, "disc") => &[1e-15, 1e-12, 1e-9, 1e-6],
            // Those of the targets.
            (true, _) => &[1e-15, 1e-9],
            (false, _) => &[
                1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6,
            ],
        }
    };
    let mut items = Vec::new();
    for &system in &ALL[..10] {
        for &tolerance in tolerances(system) {
            items.push(Item {
                tolerance: Some(tolerance),
                rounds: if extent.quick { 3 } else { 7 },
                cap: match (extent.quick, links(system)) {
                    (true, 0..=4) => 20.0,
                    // Their peers compile for long.
                    (true, _) => 60.0,
                    (false, _) => 120.0,
                },
                participants: integrators(extent, system, tolerance),
                ..item(extent, "trajectory", system)
            });
        }
    }
    items
}

fn integrators(extent: Extent, system: &str, tolerance: f64) -> Vec<Participant> {
    let n = links(system);
    let mut list = vec![
        who("chetaev", "text", "taylor"),
        who("chetaev", "text", "taylor, boltzmann-hamel"),
    ];
    // Error estimates of Runge–Kutta pairs drown in rounding below.
    let loose = tolerance >= 1e-13;
    if loose {
        list.push(who("chetaev", "text", "dormand-prince-853"));
    }
    if system != "bicycle" {
        if n <= 8 {
            list.push(who("heyoka", "hand", "plain"));
        }
        list.push(who("heyoka", "hand", "compact"));
        if loose {
            list.extend([
                who("numba", "hand", "DOP853"),
                who("numba", "hand", "LSODA"),
                who("diffrax", "hand", "Tsit5"),
                who("diffrax", "hand", "Dopri8"),
                who("casadi", "hand", "cvodes"),
            ]);
        }
    }
    list.push(who("heyoka", "derived", "compact"));
    // Half a minute of compilation for the disc; over every cap for what is larger.
    if !extent.quick && matches!(system, "sleigh" | "disc" | "snake-2") {
        list.push(who("heyoka", "derived", "plain"));
    }
    if extent.quick && n > 0 {
        list.retain(|p| match p.variant {
            "taylor" | "DOP853" | "plain" => true,
            "compact" => p.form == "hand" || n <= 8,
            _ => false,
        });
    }
    list
}

fn ensemble(extent: Extent) -> Item {
    Item {
        tolerance: Some(1e-9),
        count: if extent.quick { 200 } else { 10_000 },
        rounds: if extent.quick { 3 } else { 5 },
        participants: vec![
            who("chetaev", "text", "taylor"),
            who("heyoka", "hand", "call"),
            who("heyoka", "hand", "reused"),
            who("diffrax", "hand", "Tsit5"),
            who("diffrax", "hand", "Dopri8"),
        ],
        ..item(extent, "ensemble", "disc")
    }
}

fn long_runs(extent: Extent) -> Vec<Item> {
    let of = |system: &'static str| Item {
        tolerance: Some(1e-15),
        steps: 1_000_000,
        rounds: 1,
        cap: if extent.quick { 120.0 } else { 600.0 },
        participants: vec![
            who("chetaev", "text", "taylor"),
            who("heyoka", "hand", "plain"),
        ],
        ..item(extent, "drift", system)
    };
    ["disc", "rattleback"].map(of).to_vec()
}

//! The targets, each a ratio of figures of one run.

use super::results::{Results, Row};
use super::words::{figure, megabytes, power, ratio, time};

/// One target with what was measured.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Target {
    /// What is compared.
    pub(crate) what: String,
    /// What is asked for, in words.
    pub(crate) limit: String,
    /// What was measured, in words; why not, where it was not.
    pub(crate) measured: Result<String, String>,
    /// Whether the target is met; `None` where it was not measured.
    pub(crate) met: Option<bool>,
}

impl Target {
    /// A target that a number is at most `limit`.
    fn at_most(what: String, limit: f64, found: Result<f64, String>) -> Target {
        Target {
            what,
            limit: format!("≤ {}", ratio(limit)),
            met: found.as_ref().ok().map(|x| *x <= limit),
            measured: found.map(ratio),
        }
    }
}

/// Rows of an item and system that pass.
struct Rows<'a>(Vec<&'a Row>);

impl<'a> Rows<'a> {
    fn of(results: &'a Results, item: &'a str, system: &'a str) -> Rows<'a> {
        Rows(results.of(item, system).collect())
    }

    fn by(&self, peer: &str, form: &str) -> Rows<'a> {
        let rows = self.0.iter().copied();
        Rows(rows.filter(|r| r.peer == peer && r.form == form).collect())
    }

    fn where_variant(&self, test: impl Fn(&str) -> bool) -> Rows<'a> {
        let rows = self.0.iter().copied();
        Rows(rows.filter(|r| test(&r.variant)).collect())
    }

    fn at(&self, tolerance: f64) -> Rows<'a> {
        let rows = self.0.iter().copied();
        Rows(rows.filter(|r| r.tolerance == Some(tolerance)).collect())
    }

    /// The fastest whose time counts.
    fn fastest(&self, who: &str) -> Result<&'a Row, String> {
        let counting = self.0.iter().copied().filter(|row| row.time().is_some());
        let fastest = counting.min_by(|a, b| {
            let time = |row: &Row| row.time().unwrap_or(f64::INFINITY);
            time(a).total_cmp(&time(b))
        });
        fastest.ok_or_else(|| match self.0.first() {
            None => format!("{who} was not measured"),
            Some(row) => format!("{who}: {}", row.reason),
        })
    }

    fn time(&self, who: &str) -> Result<f64, String> {
        Ok(self.fastest(who)?.time().unwrap_or(f64::NAN))
    }
}

fn batch(variant: &str) -> bool {
    variant.ends_with("batch")
}

/// All targets, in the order of the page.
pub(crate) fn targets(results: &Results) -> Vec<Target> {
    let mut list = derivation(results);
    list.extend(right_hand_side(results));
    for tolerance in [1e-15, 1e-9] {
        list.extend(trajectories(results, tolerance));
    }
    list.extend(ensemble(results));
    list.extend(drift(results));
    list.extend(main_job(results));
    list.extend(rows_of_the_table(results));
    list
}

fn derivation(results: &Results) -> Vec<Target> {
    let mut list = Vec::new();
    let compared: [(&str, &[(&str, f64)]); 2] = [
        (
            "bicycle",
            &[
                ("sympy", 1.0 / 300.0),
                ("casadi", 1.0 / 20.0),
                ("heyoka", 1.0 / 20.0),
            ],
        ),
        (
            "snake-32",
            &[("casadi", 1.0 / 50.0), ("heyoka", 1.0 / 30.0)],
        ),
    ];
    for (system, peers) in compared {
        let rows = Rows::of(results, "derive", system);
        let ours = || rows.by("chetaev", "text").time("chetaev");
        for &(peer, limit) in peers {
            let found = ours().and_then(|o| Ok(o / rows.by(peer, "derived").time(peer)?));
            let what = format!("{system}: derivation and native code, over {peer}");
            list.push(Target::at_most(what, limit, found));
        }
        if system == "bicycle" {
            let alone = || {
                let row = rows.by("casadi", "derived").fastest("casadi")?;
                row.part("derive").ok_or("casadi: no part".to_string())
            };
            let found = ours().and_then(|o| Ok(o / alone()?));
            let what = "bicycle: derivation and native code, over casadi's derivation alone";
            list.push(Target::at_most(what.into(), 1.0, found));
        }
    }
    let rows = Rows::of(results, "derive", "snake-128");
    let found = rows.by("chetaev", "text").time("chetaev");
    list.push(Target {
        what: "snake-128: derivation and native code".into(),
        limit: "seconds (< 10 s)".into(),
        met: found.as_ref().ok().map(|x| *x < 10.0),
        measured: found.map(time),
    });
    list
}

fn right_hand_side(results: &Results) -> Vec<Target> {
    let mut list = Vec::new();
    for system in ["disc", "rattleback", "snake-8"] {
        let rows = Rows::of(results, "rhs", system);
        let ours = rows.by("chetaev", "text");
        let (one, many) = (ours.where_variant(|v| !batch(v)), ours.where_variant(batch));
        let found = one
            .time("chetaev")
            .and_then(|o| Ok(o / rows.by("gcc", "hand").time("gcc")?));
        let what = format!("{system}: right-hand side, over gcc's hand form");
        list.push(Target::at_most(what, 1.0, found));
        let found = many
            .time("chetaev, batch")
            .and_then(|m| Ok(m / one.time("chetaev")?));
        let what = format!("{system}: right-hand side batched, over our own of one state");
        list.push(Target::at_most(what, 0.35, found));
        let theirs = rows.by("heyoka", "hand").where_variant(batch);
        let found = many
            .time("chetaev, batch")
            .and_then(|m| Ok(m / theirs.time("heyoka, batch")?));
        let what =
            format!("{system}: right-hand side batched, over heyoka's batch of the hand form");
        list.push(Target::at_most(what, 0.6, found));
    }
    let rows = Rows::of(results, "rhs", "bicycle");
    let one = rows.by("chetaev", "text").where_variant(|v| !batch(v));
    let found = one
        .time("chetaev")
        .and_then(|o| Ok(o / rows.by("casadi", "derived").time("casadi")?));
    list.push(Target::at_most(
        "bicycle: right-hand side, over casadi's C".into(),
        0.7,
        found,
    ));
    list
}

/// Our errors may be larger by this factor where errors are called equal.
pub(crate) const EQUAL: f64 = 3.0;

/// Errors up to this are all of the size of rounding.
const ROUNDING: f64 = 10.0 * f64::EPSILON;

/// Our least time at an error not larger than that of a row, over its time; `None` where we never come so close.
fn at_equal_error(ours: &Rows<'_>, theirs: &Row) -> Result<Option<f64>, String> {
    ours.fastest("chetaev")?;
    let error = theirs.deviation.ok_or("no error is known")?;
    let reached = |row: &&&Row| {
        row.deviation
            .is_some_and(|d| d <= (EQUAL * error).max(ROUNDING))
    };
    let rows = Rows(ours.0.iter().filter(reached).copied().collect());
    let time = rows.time("chetaev").ok();
    Ok(time.map(|time| time / theirs.time().unwrap_or(f64::NAN)))
}

fn trajectories(results: &Results, tolerance: f64) -> Vec<Target> {
    let mut list = Vec::new();
    let asked = power(tolerance);
    let mut compare = |system: &str, name: &str, limit: f64, theirs: Rows<'_>| {
        let ours = Rows::of(results, "trajectory", system).by("chetaev", "text");
        let found = theirs
            .fastest(name)
            .and_then(|row| at_equal_error(&ours, row));
        let what = format!("{system}: trajectory at the error of {name} at {asked}");
        list.push(match found {
            Ok(Some(ratio)) => Target::at_most(what, limit, Ok(ratio)),
            Ok(None) => Target {
                measured: Ok("we come so close at no tolerance measured".into()),
                met: Some(false),
                ..Target::at_most(what, limit, Err(String::new()))
            },
            Err(why) => Target::at_most(what, limit, Err(why)),
        });
    };
    for system in ["disc", "rattleback", "snake-2", "snake-4", "snake-8"] {
        let at = Rows::of(results, "trajectory", system).at(tolerance);
        compare(system, "heyoka's hand form", 1.0, at.by("heyoka", "hand"));
        compare(
            system,
            "heyoka's derived form",
            0.1,
            at.by("heyoka", "derived"),
        );
        if tolerance >= 1e-13 {
            let theirs = at.by("numba", "hand").where_variant(|v| v == "DOP853");
            compare(system, "DOP853 over Numba", 0.1, theirs);
        }
    }
    for system in ["snake-16", "snake-32"] {
        let at = Rows::of(results, "trajectory", system).at(tolerance);
        let theirs = at.by("heyoka", "hand").where_variant(|v| v == "compact");
        compare(system, "heyoka's compact mode, hand form,", 0.3, theirs);
    }
    list
}

fn ensemble(results: &Results) -> Vec<Target> {
    let rows = Rows::of(results, "ensemble", "disc");
    let compare = |name: &str, least: f64, theirs: Rows<'_>| {
        // How many more trajectories in a second of the processor.
        let ours = rows.by("chetaev", "text").time("chetaev");
        let found = ours.and_then(|o| Ok(theirs.time(name)? / o));
        Target {
            what: format!("ensemble of discs at 1e-9 in a second of the processor, over {name}"),
            limit: format!("≥ {}", figure(least)),
            met: found.as_ref().ok().map(|x| *x >= least),
            measured: found.map(figure),
        }
    };
    let heyoka = rows.by("heyoka", "hand");
    vec![
        compare(
            "heyoka's ensemble call",
            6.0,
            heyoka.where_variant(|v| v == "call"),
        ),
        compare(
            "heyoka's integrator reused",
            1.0,
            heyoka.where_variant(|v| v == "reused"),
        ),
        compare("diffrax", 30.0, rows.by("diffrax", "hand")),
    ]
}

fn drift(results: &Results) -> Vec<Target> {
    let of = |system: &'static str| {
        let rows = Rows::of(results, "drift", system).by("chetaev", "text");
        let found = rows.fastest("chetaev").and_then(|row| {
            let figures = (row.part("largest"), row.part("steps"));
            let (Some(largest), Some(steps)) = figures else {
                return Err("no figures".to_string());
            };
            // A random walk of roundings, with room for its constant.
            Ok((largest, 10.0 * f64::EPSILON * steps.sqrt()))
        });
        Target {
            what: format!("{system}: largest relative error of the energy over the long run"),
            limit: "≤ 10 ε √steps".into(),
            met: found.as_ref().ok().map(|(largest, limit)| largest <= limit),
            measured: found
                .map(|(largest, limit)| format!("{} of {}", power(largest), power(limit))),
        }
    };
    ["disc", "rattleback"].map(of).to_vec()
}

fn main_job(results: &Results) -> Vec<Target> {
    let rows = Rows::of(results, "main-job", "sleigh");
    let row = rows.fastest("chetaev");
    let wall = row.clone().map(|row| super::results::median(&row.wall));
    let memory = row.and_then(|row| row.part("memory").ok_or("no figure".to_string()));
    vec![
        Target {
            what: "main job, whole process, sleigh: wall".into(),
            limit: "< 0.3 s".into(),
            met: wall.as_ref().ok().map(|x| *x < 0.3),
            measured: wall.map(time),
        },
        Target {
            what: "main job, whole process, sleigh: memory".into(),
            limit: "< 100 MB".into(),
            met: memory.as_ref().ok().map(|x| *x < 1e8),
            measured: memory.map(|x| megabytes(x as u64)),
        },
    ]
}

/// The largest figures of all rows; nothing where they were not measured.
fn rows_of_the_table(results: &Results) -> Vec<Target> {
    let all = super::plan::TABLE.iter();
    let rows: Vec<&Row> = all.flat_map(|row| results.of("table", row)).collect();
    if rows.is_empty() {
        return Vec::new();
    }
    let largest = |figure: &dyn Fn(&Row) -> Option<f64>| {
        let found = rows.iter().map(|row| {
            let own = figure(row).filter(|_| row.counts());
            own.ok_or_else(|| format!("{}: {}", row.system, row.reason))
        });
        found.reduce(|a, b| Ok(a?.max(b?))).unwrap_or(Ok(0.0))
    };
    let wall = largest(&|row| Some(super::results::median(&row.wall)));
    let memory = largest(&|row| row.parts["memory"].as_f64());
    let what = format!("{} rows of the table of elasticity at d = 3", rows.len());
    vec![
        Target {
            what: format!("{what}: wall of the slowest"),
            limit: "≤ 10 s".into(),
            met: wall.as_ref().ok().map(|x| *x <= 10.0),
            measured: wall.map(time),
        },
        Target {
            what: format!("{what}: largest memory"),
            limit: "≤ 500 MB".into(),
            met: memory.as_ref().ok().map(|x| *x <= 5e8),
            measured: memory.map(|x| megabytes(x as u64)),
        },
    ]
}

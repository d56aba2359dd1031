//! The page of the book, its plots, and the figures of the README; nothing in them is typed by hand.

use super::plan::links;
use super::plot::{Line, Plot};
use super::results::{write_whole, Results, Row};
use super::tables;
use super::targets::EQUAL;
use super::words::{figure, megabytes};
use super::workplace::root;
use std::fmt::Write;
use std::path::Path;

/// The first and the last line of what is generated in the README.
pub(crate) const MARKS: [&str; 2] = ["<!-- benchmark: begin -->", "<!-- benchmark: end -->"];

/// An item, in words.
pub(crate) fn item_name(item: &str) -> &str {
    match item {
        "derive" => "derivation and native code",
        "rhs" => "right-hand side",
        "main-job" => "main job",
        "drift" => "long run",
        "table" => "row of the table of elasticity, d = 3",
        other => other,
    }
}

/// Writes the page, its plots and the README's part.
pub(crate) fn write(results: &Results) -> Result<(), String> {
    let folder = root().join("docs/book/benchmark");
    forget_plots(&folder);
    for (name, svg) in plots(results) {
        write_whole(&folder.join(name), &svg)?;
    }
    write_whole(&root().join("docs/book/benchmark.md"), &page(results))?;
    let path = root().join("README.md");
    let readme = std::fs::read_to_string(&path).map_err(|p| p.to_string())?;
    let readme = with_claims(&readme, results).ok_or("README.md has no marks of the benchmark")?;
    write_whole(&path, &readme)
}

/// Removes the plots of other results.
fn forget_plots(folder: &Path) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        if entry.path().extension().is_some_and(|e| e == "svg") {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// The README with its figures in the place of those that stand there.
pub(crate) fn with_claims(readme: &str, results: &Results) -> Option<String> {
    let (before, rest) = readme.split_once(MARKS[0])?;
    let (_, after) = rest.split_once(MARKS[1])?;
    let mut text = format!("{before}{}\n", MARKS[0]);
    let _ = writeln!(
        text,
        "Measured by `cargo xtask bench --peers`; [the benchmark](docs/book/benchmark.md) has the conditions, all figures, and where others are faster.{}\n",
        provisional(results)
    );
    for claim in tables::claims(results) {
        let _ = writeln!(text, "- {claim}");
    }
    Some(format!("{text}{}{after}", MARKS[1]))
}

/// What a reader must know before comparing.
fn caution(results: &Results) -> String {
    let mut text = String::new();
    if results.quick {
        text += " These are figures of a quick run, with few repeats.";
    }
    if let Some((low, high)) = results.load() {
        if high > 1.5 {
            let _ = write!(
                text,
                " **The machine had other work: its load average was {} to {}, so treat the timings as provisional.**",
                figure(low),
                figure(high)
            );
        }
    }
    text
}

/// The same in one sentence for the README.
fn provisional(results: &Results) -> &'static str {
    let is_shared = results.load().is_some_and(|(_, high)| high > 1.5);
    if results.quick || is_shared {
        " Treat these timings as provisional: they are of a quick run on a machine that had other work."
    } else {
        ""
    }
}

const INTRODUCTION: &str = "\
# The benchmark

What Chetaev needs from the text of a model to equations, native code and trajectories, beside the tools that people use for this. \
`cargo xtask bench --peers` measures all of it in one run and writes this page, its plots and the figures in the README from \
`bench/results.json`; nothing here is typed by hand. `cargo xtask bench --help` says how to run a part of it.

*Hand form*: compact reduced equations found by a person, given to the tool (`bench/systems`). *Derived form*: what the tool makes of the \
Lagrangian and the constraints by differentiation and elimination. Chetaev always starts from the text of the model. Participants are \
processes that take turns within one item, bound to one processor; times are seconds of that processor, the median of the \
repeats with the smallest and the largest. An answer is compared with the reference before its time counts: accelerations may be off by \
1e-9, the ends of trajectories by 1e-2 (their errors stand beside their times). References of accelerations are \
computed with 60 digits by mpmath from the Lagrangian itself; every hand form agrees with them to 1e-15. Code is compiled anew each time, never taken from a cache.

";

/// The page.
pub(crate) fn page(results: &Results) -> String {
    let mut text = INTRODUCTION.to_string();
    text += &conditions(results);
    text += "## Targets\n\nRatios of figures of this run; below one, we are faster, except for the ensembles, where it is above. \
             Where several forms or modes of a participant were measured, its fastest counts, ours too.\n\n";
    text += &tables::target_table(results);
    text += &where_we_lose(results);
    text += "## Derivation and native code\n\nFrom nothing to the first accelerations by compiled code.\n\n";
    if growth(results).is_some() {
        text += "![growth with the number of links](benchmark/growth.svg)\n\n";
    }
    text += &tables::derivations(results);
    text += "## Right-hand side\n\nFor one state, averaged over 1024 of them in a compiled loop. Variants named batch evaluate several states at once.\n\n";
    text += &tables::right_hand_sides(results);
    let _ = write!(
        text,
        "## Trajectories\n\nTime over the error of the coordinates at the end, |Δq|/max(1, |q|). Compilation is not part of the time. In the targets our \
         error may be {EQUAL} times theirs, and counts as reached where it is of the size of rounding.\n\n"
    );
    for system in results.systems("trajectory") {
        let _ = writeln!(text, "### {system}\n");
        if let Some(words) = results.references.get(system) {
            let _ = writeln!(text, "Reference: {words}.\n");
        }
        if trajectory_plot(results, system).svg().is_some() {
            let _ = writeln!(
                text,
                "![work and precision](benchmark/trajectory-{system}.svg)\n"
            );
        }
        text += &tables::trajectories(results, system);
    }
    text += "## Ensembles\n\nDiscs of different lean and spin on one thread, to t = 10.\n\n";
    text += &tables::ensembles(results);
    text += "## Long runs\n\nTaylor steps at tolerance 1e-15; relative error of the energy.\n\n";
    for system in results.systems("drift") {
        if drift_plot(results, system).svg().is_some() {
            let _ = writeln!(
                text,
                "![error of the energy](benchmark/drift-{system}.svg)\n"
            );
        }
    }
    text += &tables::long_runs(results);
    text += "## Memory\n\nLargest memory of the processes that derive; programs they run, such as gcc, included where that is more.\n\n";
    text += &tables::memory(results);
    text += "## What does not count\n\nWrong answers, refusals, and what did not finish in its time.\n\n";
    text += &tables::excluded(results);
    text.trim_end().to_string() + "\n"
}

fn conditions(results: &Results) -> String {
    let machine = &results.machine;
    let mut text = String::from("## Conditions\n\n");
    let _ = writeln!(
        text,
        "{}: {}, {} cores ({}), {}, {}.{}\n",
        results.date,
        machine.processor,
        machine.cores,
        machine.vectors,
        megabytes(machine.memory),
        machine.system,
        caution(results)
    );
    if let Some((low, high)) = results.load() {
        let _ = writeln!(
            text,
            "Load average while measuring: {} to {}.\n",
            figure(low),
            figure(high)
        );
    }
    let versions: Vec<String> = results
        .versions
        .iter()
        .map(|(name, version)| match version.contains(name.as_str()) {
            true => version.clone(),
            false => format!("{name} {version}"),
        })
        .collect();
    let _ = writeln!(text, "Versions: {}.\n", versions.join("; "));
    text
}

fn where_we_lose(results: &Results) -> String {
    let losses = tables::losses(results);
    let mut text = String::from("## Where others are faster\n\nAt the same item and tolerance, whatever the error reached.\n\n");
    for loss in &losses {
        let _ = writeln!(text, "- {loss}");
    }
    match losses.is_empty() {
        true => text + "Nowhere in this run.\n\n",
        false => text + "\n",
    }
}

/// All plots with the names of their files.
pub(crate) fn plots(results: &Results) -> Vec<(String, String)> {
    let mut found = Vec::new();
    if let Some(svg) = growth(results) {
        found.push(("growth.svg".to_string(), svg));
    }
    for system in results.systems("trajectory") {
        if let Some(svg) = trajectory_plot(results, system).svg() {
            found.push((format!("trajectory-{system}.svg"), svg));
        }
    }
    for system in results.systems("drift") {
        if let Some(svg) = drift_plot(results, system).svg() {
            found.push((format!("drift-{system}.svg"), svg));
        }
    }
    found
}

/// Lines by participant, in the order of the rows; ours first.
fn lines<'a>(
    rows: impl Iterator<Item = &'a Row>,
    point: impl Fn(&Row) -> Option<(f64, f64)>,
) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    for row in rows.filter(|row| row.counts()) {
        let Some(point) = point(row) else {
            continue;
        };
        let name = row.who();
        match lines.iter_mut().find(|line| line.name == name) {
            Some(line) => line.points.push(point),
            None => lines.push(Line {
                name,
                points: vec![point],
                is_ours: row.is_ours(),
            }),
        }
    }
    lines.sort_by_key(|line| !line.is_ours);
    for line in &mut lines {
        line.points.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    lines
}

fn growth(results: &Results) -> Option<String> {
    let rows = results.rows.iter();
    let rows = rows.filter(|row| row.item == "derive" && links(&row.system) > 0);
    let plot = Plot {
        title: "Derivation and native code of a snake".into(),
        axes: ["links".into(), "seconds".into()],
        lines: lines(rows, |row| {
            Some((f64::from(links(&row.system)), row.time()?))
        }),
    };
    plot.svg()
}

fn trajectory_plot(results: &Results, system: &str) -> Plot {
    let point = |row: &Row| Some((row.deviation?.max(1e-17), row.time()?));
    Plot {
        title: format!("One trajectory: {system}"),
        axes: ["error at the end".into(), "seconds".into()],
        lines: lines(results.of("trajectory", system), point),
    }
}

fn drift_plot(results: &Results, system: &str) -> Plot {
    let rows = results.of("drift", system).filter(|row| row.counts());
    let line = |row: &Row| {
        let [steps, errors] = row.curve.as_ref()?;
        let points = steps.iter().zip(errors).map(|(x, y)| (*x, y.abs()));
        Some(Line {
            name: row.who(),
            points: points.collect(),
            is_ours: row.is_ours(),
        })
    };
    Plot {
        title: format!("Error of the energy over steps: {system}"),
        axes: ["steps".into(), "relative error".into()],
        lines: rows.filter_map(line).collect(),
    }
}

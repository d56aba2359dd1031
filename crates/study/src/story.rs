//! What the variational principles say of a system, as a story for a terminal: `chetaev principles MODEL`.

use crate::beside::{number, told, Beside};
use crate::layout::hanging;
use crate::plain;
use crate::study::{Decided, Study};
use crate::summary::{bold, coloured, Style};
use chetaev_mechanics::Formula;
use chetaev_symbolic::{Expr, Function, Node, Verdict};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// A chapter: its title, what it is about, and the claims it tells of, by id or by what ids begin with.
struct Chapter {
    title: &'static str,
    opening: &'static str,
    claims: &'static [&'static str],
}

/// The chapters in the order in which one follows from another.
const CHAPTERS: &[Chapter] = &[
    Chapter {
        title: "What is δv?",
        opening: "Virtual displacements satisfy Σ ∂f/∂v δq = 0. What the variation of a velocity is has to be agreed upon: δv = D(δq) for all velocities \
                  (Hölder), so that curves are varied into curves; or for the independent ones with δf = 0 (Suslov), so that varied states are admissible.",
        claims: &["variation."],
    },
    Chapter {
        title: "Hamilton's principle in four forms",
        opening: "All have virtual δq that vanish at the ends. Each form is built by its own rule, integrated by parts, and compared with the equations it must give.",
        claims: &[
            "hamilton.hoelder",
            "hamilton.voronets",
            "hamilton.suslov",
            "hamilton.helmholtz-poincare",
            "hamilton.forms-equivalent",
            "hamilton.central-identity",
        ],
    },
    Chapter {
        title: "Is the action stationary?",
        opening: "∫δL dt = 0 for virtual δq is not δ∫L dt = 0 among admissible curves. Curves that make the action stationary solve \
                  D(∂L/∂v) − ∂L/∂q = Σ κ E[f] − Σ κ' ∂f/∂v with multipliers κ(t); a motion with the reactions λ is among them where Σ κ E[f]·δq = 0 and κ' = ρ − λ.",
        claims: &[
            "hamilton.stationary",
            "hamilton.stationary-suslov",
            "formulation.vakonomic-coincides",
            "hamilton.kerner",
            "hamilton.constants",
            "hamilton.endpoints",
        ],
    },
    Chapter {
        title: "Energy and least action",
        opening: "Now the times vary too: Δq = δq + v Δt, Δv = D(Δq) − v D(Δt). At fixed energy this gives least action in the forms of Lagrange and Jacobi.",
        claims: &["energy.integral", "action."],
    },
    Chapter {
        title: "Hamilton and Jacobi, Chaplygin",
        opening: "The extremum for L + Σ κ f has the momenta π = p + Σ κ ∂f/∂v and the Hamiltonian H₁ = Σ π v − L; S_t + H₁(q, S_q, t) = 0 integrates the motions \
                  where the action is stationary. Another way to Hamilton's equations is another time, dτ = N dt.",
        claims: &["hamilton-jacobi.", "chaplygin."],
    },
    Chapter {
        title: "q and v on the same footing",
        opening: "On a curve (q(t), v(t)) Dq need not be v: with Z = L + Σ (Dq − v) ∂L/∂v, ∫(δZ + Σ Q δq) dt = 0 gives Dq = v and the equations of motion. \
                  With Dq = v on the true path δv cancels, and any linear relation δv = A(δq) may be imposed.",
        claims: &["second-kind.", "universal-relation"],
    },
    Chapter {
        title: "Numbers as a witness",
        opening: "Integrals over the computed motion, independent of all proofs above.",
        claims: &["witness."],
    },
];

/// The story: the system, chapter after chapter each principle with its formulas for this system and the verdict, and the
/// constrained extremum beside the motion where it was computed.
pub fn story(study: &Study, style: Style) -> String {
    let mut text = String::new();
    system(&mut text, study, style);
    for chapter in CHAPTERS {
        let told = of_chapter(study, chapter);
        if told.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n{}", bold(style, chapter.title));
        paragraph(&mut text, chapter.opening, 0);
        let mut title = "";
        for decided in told {
            if decided.title != title {
                title = decided.title;
                let _ = writeln!(text, "\n  {title}");
            }
            verdict(&mut text, study, decided, style);
        }
    }
    comparison(&mut text, study, style);
    text
}

/// The same in short: of each chapter what holds, and where what does not hold everywhere does.
pub fn outline(study: &Study, style: Style) -> String {
    let mut text = String::new();
    system(&mut text, study, style);
    for chapter in CHAPTERS {
        let told = of_chapter(study, chapter);
        if told.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n{}", bold(style, chapter.title));
        for (word, titles) in by_verdict(study, &told) {
            let word = coloured(style, word);
            // Colours take no room.
            let shown = hanging(&" ".repeat(VERDICT), &titles);
            let _ = write!(text, "  {word} {}", shown.trim_start());
        }
        for decided in told.iter().filter(|d| !d.is_as_expected()) {
            let expected = decided.expected.join(" or ");
            let words = format!("{}: the model expects {expected}", decided.full_id());
            text.push_str(&hanging("! ", &words));
        }
    }
    comparison(&mut text, study, style);
    text
}

/// Characters before what was found in the outline.
const VERDICT: usize = 17;

/// The verdicts of a chapter.
fn of_chapter<'a>(study: &'a Study, chapter: &Chapter) -> Vec<&'a Decided> {
    let ids = chapter.claims.iter();
    ids.flat_map(|id| study.verdicts.iter().filter(move |d| is_of(d, id)))
        .collect()
}

/// What was proved by its titles in one line; everything else by itself, with where it holds or why it does not.
fn by_verdict(study: &Study, told: &[&Decided]) -> Vec<(&'static str, String)> {
    let mut lines: Vec<(&'static str, String)> = Vec::new();
    let mut counts: BTreeMap<(&'static str, &'static str), usize> = BTreeMap::new();
    for decided in told {
        let word = decided.finding.verdict.word();
        let is_alike = matches!(word, "proved" | "numerical" | "not-applicable");
        if !is_alike {
            lines.push((word, of_one(study, decided)));
            continue;
        }
        let count = counts.entry((word, decided.title)).or_default();
        *count += 1;
    }
    for word in ["not-applicable", "numerical", "proved"] {
        let of_word = told.iter().filter(|d| d.finding.verdict.word() == word);
        let mut titles: Vec<String> = Vec::new();
        for decided in of_word {
            if let Some(count) = counts.remove(&(word, decided.title)) {
                titles.push(match count {
                    1 => decided.title.to_owned(),
                    count => format!("{} ({count} cases)", decided.title),
                });
            }
        }
        if !titles.is_empty() {
            lines.insert(0, (word, titles.join("; ")));
        }
    }
    lines
}

/// A claim that is not proved: where it holds, or why it does not.
fn of_one(study: &Study, decided: &Decided) -> String {
    let verdict = &decided.finding.verdict;
    let told = match verdict {
        Verdict::Conditional { condition, .. } => format!("where {condition}"),
        _ => {
            let told = plain::told(verdict.detail()).0;
            told.split("; ").next().unwrap_or_default().to_owned()
        }
    };
    let told = match told.char_indices().nth(SHORT) {
        Some((end, _)) => format!("{} …", &told[..end]),
        None => told,
    };
    format!(
        "{}: {}",
        decided.title,
        plain::written(&study.system, &told)
    )
}

/// Characters that are told of a claim in the outline.
const SHORT: usize = 160;

/// The motion and the constrained extremum, where they are compared, and what a reader must know.
fn comparison(text: &mut String, study: &Study, style: Style) {
    if let Some(beside) = study.motion.as_ref().and_then(|m| m.beside.as_ref()) {
        let _ = writeln!(
            text,
            "\n{}",
            bold(style, "The motion and the constrained extremum")
        );
        match beside {
            Ok(found) => extremum(text, study, found),
            Err(why) => paragraph(text, &format!("There is no extremum to compare: {why}."), 0),
        }
    }
    for notice in &study.notices {
        text.push_str(&hanging("note: ", notice));
    }
}

/// Whether a verdict is of a claim, by its id or the beginning of it.
fn is_of(decided: &Decided, id: &str) -> bool {
    match id.ends_with('.') {
        true => decided.claim.starts_with(id),
        false => decided.claim == id,
    }
}

fn system(text: &mut String, study: &Study, style: Style) {
    let (system, g) = (&study.system, &study.system.graph);
    let _ = writeln!(text, "{}", bold(style, &study.model.name));
    let _ = writeln!(text, "  L = {}", g.text(system.lagrangian));
    for constraint in &system.constraints {
        let _ = writeln!(
            text,
            "  {}: {} = 0",
            constraint.name,
            g.text(constraint.stated)
        );
    }
    let forced = system.coordinates.iter().zip(&system.forces);
    for (c, &force) in forced.filter(|(_, force)| !g.is_zero(**force)) {
        let _ = writeln!(text, "  Q_{} = {}", c.name, g.text(force));
    }
}

fn verdict(text: &mut String, study: &Study, decided: &Decided, style: Style) {
    let word = decided.finding.verdict.word();
    let _ = writeln!(
        text,
        "  {} {}",
        coloured(style, word).trim_end(),
        decided.full_id()
    );
    if !decided.is_as_expected() {
        let _ = writeln!(
            text,
            "    the model expects: {}",
            decided.expected.join(" or ")
        );
    }
    let written = |words: &str| plain::written(&study.system, words);
    for formula in &decided.finding.formulas {
        let _ = writeln!(text, "    {}", written(&line(study, formula)));
    }
    let (mut told, _) = plain::told(decided.finding.verdict.detail());
    if let (Verdict::NotApplicable { .. }, Some((first, _))) =
        (&decided.finding.verdict, told.split_once("; "))
    {
        // The rest is told where the hypothesis is.
        told = first.to_string();
    }
    let found = counterexample(study, decided);
    if found.is_some() {
        // What does not vanish, and where, is told of the counterexample.
        let parts = told
            .split("; ")
            .filter(|part| !part.contains("does not vanish: it"));
        told = parts.collect::<Vec<&str>>().join("; ");
    }
    if !told.is_empty() {
        paragraph(text, &format!("{}.", written(&told)), 4);
    }
    if let Some(found) = found {
        paragraph(text, &written(&found), 4);
    }
}

/// The state at which a claim fails, with the values that the proof used.
fn counterexample(study: &Study, decided: &Decided) -> Option<String> {
    let (found, where_) = match &decided.finding.verdict {
        Verdict::Refuted(found) => (found, "It fails at"),
        Verdict::Conditional {
            counterexample: Some(found),
            ..
        } => (found, "Elsewhere it fails, as at"),
        _ => return None,
    };
    if found.point.is_empty() {
        return None;
    }
    let shown = |text: &str| text.parse().map_or(text.to_string(), number);
    let point: Vec<String> = found
        .point
        .iter()
        .map(|p| {
            let unit = angle_unit(study, &p.name);
            match (&p.exact, &p.enclosure) {
                (Some(exact), _) => format!("{} = {exact}{unit}", p.name),
                (None, Some((low, _))) => format!("{} ≈ {}{unit}", p.name, shown(low)),
                (None, None) => p.name.clone(),
            }
        })
        .collect();
    let (low, high) = &found.residual;
    let about = if low == high { "is" } else { "is about" };
    let value = format!("{} {about} {}, not 0", found.quantity, shown(low));
    Some(format!("{where_} {}: {value}.", point.join(", ")))
}

/// " rad" after the value of a coordinate the sine or cosine of which occurs: numbers of a proof are radians, whatever the unit of the model.
fn angle_unit(study: &Study, name: &str) -> &'static str {
    let (system, g) = (&study.system, &study.system.graph);
    let Some(coordinate) = system.coordinates.iter().find(|c| c.name == name) else {
        return "";
    };
    let mut all = vec![system.lagrangian];
    all.extend(&system.forces);
    all.extend(system.constraints.iter().map(|c| c.stated));
    let is_circular = |e: Expr| match g.node(e) {
        Node::Apply {
            function: Function::Sin | Function::Cos | Function::Tan,
            arguments,
        } => g.contains_any(arguments[0], &[coordinate.q_symbol]),
        _ => false,
    };
    match g.reachable(&all).into_iter().any(is_circular) {
        true => " rad",
        false => "",
    }
}

/// "caption: left = right".
fn line(study: &Study, formula: &Formula) -> String {
    let g = &study.system.graph;
    match formula.left {
        Some(left) => format!(
            "{}: {} = {}",
            formula.caption,
            g.text(left),
            g.text(formula.right)
        ),
        None => format!("{}: {}", formula.caption, g.text(formula.right)),
    }
}

/// Words in lines of a terminal.
fn paragraph(text: &mut String, words: &str, indent: usize) {
    text.push_str(&hanging(&" ".repeat(indent + 2), words));
}

/// Rows of the table of both curves.
const ROWS: usize = 8;

fn extremum(text: &mut String, study: &Study, found: &Beside) {
    let Some(motion) = &study.motion else {
        return;
    };
    for words in told(study, motion, found) {
        paragraph(text, &words, 0);
    }
    table(text, study, &motion.evidence.run, &found.run);
}

/// Coordinates of the motion and of the extremum at some times.
fn table(
    text: &mut String,
    study: &Study,
    motion: &chetaev_motion::Run,
    extremum: &chetaev_motion::Run,
) {
    let shared = motion.asked().min(extremum.asked());
    if shared < 2 {
        return;
    }
    let names: Vec<&str> = study
        .system
        .coordinates
        .iter()
        .map(|c| c.name.as_str())
        .collect();
    let head: Vec<String> = names
        .iter()
        .flat_map(|name| [format!("{name:>12}"), format!("{:>12}", "extremum")])
        .collect();
    let _ = writeln!(text, "\n  {:>10}{}", "t", head.concat());
    for k in 0..=ROWS {
        let j = k * (shared - 1) / ROWS;
        let (a, b) = (motion.row(j), extremum.row(j));
        let values: Vec<String> = motion
            .layout
            .q()
            .take(names.len())
            .flat_map(|i| [format!("{:>12.5}", a[i]), format!("{:>12.5}", b[i])])
            .collect();
        let _ = writeln!(text, "  {:>10.4}{}", motion.times[j], values.concat());
    }
}

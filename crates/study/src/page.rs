//! The report of a study: plain data for the report crate.

use crate::record::bound_text;
use crate::study::{stop_is_expected, Decided, Motion, Study};
use crate::table::Table;
use crate::typeset;
use chetaev_integrate::Note;
use chetaev_mechanics::claims::formulation::derive;
use chetaev_mechanics::{Context, Equations, Finding, Prover};
use chetaev_model::drawing::Shape as Drawn;
use chetaev_motion::observe::Observer;
use chetaev_report::data::{
    Animation, Assumption, ChartSwitch, Claim, Element, Equation, EquationSection, Fact, Figure,
    Formula, InitialValue, ModelSource, Origin, Parameter, Portrait, Report, Reproducibility,
    Series, SeriesGroup, Shape, Source, SourceFile, Stop, Tint, Trajectory, Verdict as Word,
};
use chetaev_symbolic::print::Options;
use chetaev_symbolic::{rational, Expr, Verdict};

/// The HTML page of a study.
pub fn page(study: &Study, command: Option<String>, files: &[String]) -> String {
    chetaev_report::render(&report(study, command, files))
}

/// The report as data.
pub fn report(study: &Study, command: Option<String>, files: &[String]) -> Report {
    let model = &study.model;
    let options = typeset::print_options(&study.system);
    Report {
        title: title(&model.name),
        subtitle: Some(subtitle(study)),
        description: paragraphs(&model.description),
        history: paragraphs(&model.history),
        sources: model
            .source
            .iter()
            .map(|text| Source {
                text: text.clone(),
                link: None,
            })
            .collect(),
        facts: facts(study),
        parameters: parameters(study, &options),
        assumptions: assumptions(study),
        initial: initial(study, &options),
        sections: sections(study, &options),
        claims: study
            .verdicts
            .iter()
            .map(|d| claim(study, d, &options))
            .collect(),
        trajectory: study.motion.as_ref().map(|m| trajectory(study, m, files)),
        figures: study.motion.as_ref().map(figures).unwrap_or_default(),
        animation: study.motion.as_ref().and_then(|m| animation(study, m)),
        model: Some(source(study)),
        notices: study.notices.clone(),
        reproducibility: Reproducibility {
            version: env!("CARGO_PKG_VERSION").into(),
            seed: Some(Prover::default().seed),
            command,
            details: Vec::new(),
        },
    }
}

/// `chaplygin-sleigh` becomes "Chaplygin sleigh"; a name with spaces stays.
fn title(name: &str) -> String {
    let spaced = if name.contains(' ') {
        name.to_string()
    } else {
        name.replace('-', " ")
    };
    let mut letters = spaced.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => spaced,
    }
}

fn subtitle(study: &Study) -> String {
    let (n, k) = (
        study.system.n(),
        study.system.n() - study.prepared.selection.rows.len(),
    );
    format!(
        "{n} coordinates, {} constraints, {k} independent velocities",
        study.system.constraints.len()
    )
}

fn paragraphs(text: &str) -> Vec<String> {
    text.split("\n\n")
        .map(|p| p.trim().replace('\n', " "))
        .filter(|p| !p.is_empty())
        .collect()
}

fn fact(label: &str, value: String, symbol: Option<&str>, claim: Option<&str>) -> Fact {
    Fact {
        label: label.into(),
        value,
        symbol: symbol.map(String::from),
        note: None,
        claim: claim.map(String::from),
    }
}

fn facts(study: &Study) -> Vec<Fact> {
    let system = &study.system;
    let r = study.prepared.selection.rows.len();
    let names: Vec<&str> = system.coordinates.iter().map(|c| c.name.as_str()).collect();
    let mut facts = vec![
        fact(
            "Coordinates",
            format!("{}: {}", system.n(), names.join(", ")),
            Some("n"),
            None,
        ),
        fact(
            "Independent constraints",
            r.to_string(),
            Some("r"),
            Some("model.constraints-independent"),
        ),
        fact(
            "Independent velocities",
            (system.n() - r).to_string(),
            Some("k"),
            Some("model.accelerations-unique"),
        ),
    ];
    for c in &system.constraints {
        let time = if c.rheonomic {
            "rheonomic"
        } else {
            "scleronomic"
        };
        facts.push(fact(
            &format!("Constraint {}", c.name),
            format!("{}, {time}", c.kind.word()),
            None,
            Some("model.constraints-linear"),
        ));
    }
    facts
}

fn symbol(study: &Study, name: &str, options: &Options) -> Formula {
    let g = &study.model.graph;
    let order = name.chars().filter(|&c| c == '\'').count() as u32;
    typeset::expression(g, g.symbol(name.trim_end_matches('\''), order), options).formula
}

fn parameters(study: &Study, options: &Options) -> Vec<Parameter> {
    let g = &study.model.graph;
    study
        .model
        .parameters
        .iter()
        .map(|p| {
            let number = p
                .value
                .and_then(|v| g.evaluate_f64(&[v], &|_| None).ok())
                .map(|v| v[0]);
            let value = p.value.map(|v| match (g.as_number(v), number) {
                (Some(exact), _) if exact.is_int() => exact.to_string(),
                (_, Some(number)) => significant(number),
                _ => g.text(v),
            });
            let stated = p
                .definition
                .filter(|&d| g.as_number(d).is_none())
                .map(|d| g.text(d));
            Parameter {
                name: symbol(study, &p.name, options),
                value: match (value, stated) {
                    (Some(value), Some(stated)) => Some(format!("{value} = {stated}")),
                    (value, stated) => value.or(stated),
                },
                unit: p.unit.as_ref().map(|u| u.text.clone()),
                range: p
                    .range
                    .map(|(low, high)| format!("{} … {}", g.text(low), g.text(high))),
                description: (!p.description.is_empty()).then(|| p.description.clone()),
            }
        })
        .collect()
}

/// Ten significant digits without trailing zeros.
fn significant(x: f64) -> String {
    let magnitude = if x == 0.0 {
        0
    } else {
        x.abs().log10().floor() as i32
    };
    if !(-4..12).contains(&magnitude) {
        return format!("{x:.6e}");
    }
    let decimals = (9 - magnitude).max(0) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_string()
    } else {
        text
    }
}

fn assumptions(study: &Study) -> Vec<Assumption> {
    study
        .system
        .assumptions
        .iter()
        .map(|a| Assumption {
            formula: Formula {
                text: a.text.clone(),
                ..Formula::default()
            },
            note: None,
        })
        .collect()
}

fn initial(study: &Study, options: &Options) -> Vec<InitialValue> {
    let Some(motion) = &study.motion else {
        return Vec::new();
    };
    let model = &study.model;
    let n = study.system.n();
    motion
        .evidence
        .start
        .iter()
        .enumerate()
        .map(|(place, (name, value))| {
            let given = model.initial.values.get(&(place % n, (place / n) as u32));
            let projected = motion
                .start
                .completed
                .iter()
                .any(|(changed, _)| changed == name);
            InitialValue {
                name: symbol(study, name, options),
                value: *value,
                stated: given.map(|g| g.text.clone()),
                unit: None,
                origin: match (given, projected) {
                    (_, true) => Origin::Projected,
                    (Some(_), _) => Origin::Given,
                    _ => Origin::Default,
                },
            }
        })
        .collect()
}

fn sections(study: &Study, options: &Options) -> Vec<EquationSection> {
    let mut sections = vec![lagrangian(study, options)];
    if !study.system.constraints.is_empty() {
        sections.push(constraints(study, options));
    }
    let known = crate::registry::registry();
    let prepared = &study.prepared;
    let cx = Context::new(
        &study.system,
        &prepared.terms,
        &prepared.selection,
        &known,
        Prover::default(),
    );
    if let Ok(routh) = derive(&cx, "routh") {
        sections.push(formulation(study, &routh, options, "Routh's equations with multipliers", &[
            "Lagrange's equations of all coordinates; the reaction of each constraint f = left − right is λ ∂f/∂q′.",
        ]));
        if !routh.multipliers.is_empty() {
            sections.push(multipliers(study, &routh, options));
        }
    }
    if let Ok(maggi) = derive(&cx, "maggi") {
        let explanation = "Lagrange's left sides contracted with a basis of virtual displacements: one equation for each independent velocity or quasi-velocity, no multipliers.";
        let mut section = formulation(study, &maggi, options, "Maggi's equations", &[explanation]);
        section.claim = Some("formulation.equivalent#maggi".into());
        sections.push(section);
    }
    sections
}

fn lagrangian(study: &Study, options: &Options) -> EquationSection {
    let g = &study.model.graph;
    let mut equations = Vec::new();
    let parts = [("T", study.model.kinetic), ("V", study.model.potential)];
    for (name, value) in parts {
        if let Some(value) = value {
            equations.push(typeset::equation(g, g.symbol(name, 0), value, options));
        }
    }
    if study.model.kinetic.is_none() {
        equations.push(typeset::equation(
            g,
            g.symbol("L", 0),
            study.model.lagrangian,
            options,
        ));
    }
    for (c, &force) in study.system.coordinates.iter().zip(&study.system.forces) {
        if !g.is_zero(force) {
            equations.push(typeset::equation(
                g,
                g.symbol(&format!("Q_{}", c.name), 0),
                force,
                options,
            ));
        }
    }
    for d in &study.model.defines {
        let mut equation = typeset::equation(g, g.symbol(&d.name, 0), d.value, options);
        equation.caption = (!d.description.is_empty()).then(|| d.description.clone());
        equations.push(equation);
    }
    EquationSection {
        id: "lagrangian".into(),
        title: "Lagrangian".into(),
        equations,
        ..EquationSection::default()
    }
}

fn constraints(study: &Study, options: &Options) -> EquationSection {
    let g = &study.model.graph;
    let equations = study
        .model
        .constraints
        .iter()
        .map(|c| Equation {
            label: Some(c.name.clone()),
            caption: (!c.description.is_empty()).then(|| c.description.clone()),
            ..typeset::equation(g, c.left, c.right, options)
        })
        .collect();
    EquationSection {
        id: "constraints".into(),
        title: "Constraints".into(),
        equations,
        claim: Some("model.constraints-independent".into()),
        ..EquationSection::default()
    }
}

fn formulation(
    study: &Study,
    derived: &Equations,
    options: &Options,
    title: &str,
    explanation: &[&str],
) -> EquationSection {
    let g = &study.model.graph;
    let mut equations = Vec::new();
    for group in &derived.groups {
        if derived.formulation == "routh" && group.title == "constraints" {
            continue;
        }
        let readable = typeset::readable(&study.system, derived, &group.equations);
        for ((left, right), stated) in readable.into_iter().zip(&group.equations) {
            equations.push(Equation {
                label: Some(stated.label.clone()),
                ..typeset::equation(g, left, right, options)
            });
        }
    }
    EquationSection {
        id: derived.formulation.into(),
        title: title.into(),
        formulation: Some(derived.formulation.into()),
        explanation: explanation.iter().map(|s| s.to_string()).collect(),
        collapsed: equations.len() > 16,
        equations,
        ..EquationSection::default()
    }
}

fn multipliers(study: &Study, routh: &Equations, options: &Options) -> EquationSection {
    let g = &study.model.graph;
    let values: Vec<Expr> = routh.multipliers.iter().map(|(_, value)| *value).collect();
    let short = typeset::simplified(&study.system, &values);
    let closed = short.iter().all(|&value| typeset::is_legible(g, value));
    let equations = routh
        .objects
        .iter()
        .zip(short)
        .filter(|(_, value)| typeset::is_legible(g, *value))
        .map(|(object, value)| Equation {
            caption: Some(object.meaning.clone()),
            ..typeset::equation(g, g.symbol(&object.name, 0), value, options)
        })
        .collect();
    EquationSection {
        id: "reactions".into(),
        title: "Reactions".into(),
        explanation: vec![if closed {
            "The multipliers as functions of coordinates and velocities, from the equations of motion and the constraints differentiated once.".into()
        } else {
            "Multipliers that are too long to read as formulas are the solution of a linear system: Routh's equations above together with the constraints differentiated once.".into()
        }],
        equations,
        ..EquationSection::default()
    }
}

fn word(verdict: &str) -> Word {
    Word::ALL
        .into_iter()
        .find(|w| w.key() == verdict)
        .unwrap_or(Word::Undecided)
}

fn claim(study: &Study, decided: &Decided, options: &Options) -> Claim {
    let finding: &Finding = &decided.finding;
    let g = &study.model.graph;
    let mut claim = Claim {
        claim: decided.claim.into(),
        subject: decided.subject.clone(),
        title: Some(decided.title.into()),
        verdict: word(finding.verdict.word()),
        detail: finding.verdict.detail().into(),
        requires: decided.requires.clone(),
        expected: decided.expected.first().map(|w| word(w)),
        seconds: Some(decided.seconds),
        formulas: finding
            .formulas
            .iter()
            .map(|f| {
                let short = typeset::simplified(&study.system, &[f.right])[0];
                let printed = match f.left {
                    Some(left) => typeset::equation(g, left, short, options),
                    None => typeset::expression(g, short, options),
                };
                Equation {
                    caption: Some(f.caption.clone()),
                    ..printed
                }
            })
            .collect(),
        ..Claim::default()
    };
    evidence(&mut claim, &finding.verdict);
    claim
}

fn evidence(claim: &mut Claim, verdict: &Verdict) {
    match verdict {
        Verdict::Proved(proof) | Verdict::Conditional { proof, .. } => {
            claim.method = Some(proof.method.word().into());
            claim.on = Some(proof.on.clone());
            claim.error_bound = proof.error_bound_log2.map(bound_text);
            claim.samples = (proof.samples > 0).then_some(u64::from(proof.samples));
            claim.seed = proof.seed;
        }
        Verdict::Numerical(evidence) => {
            claim.on = Some(evidence.region.clone());
            claim.samples = Some(u64::from(evidence.samples));
            claim.residual = Some(format!("{:.2e}", evidence.residual));
            claim.seed = evidence.seed;
        }
        Verdict::Refuted(c) => {
            let point: Vec<String> = c
                .point
                .iter()
                .map(|p| match (&p.exact, &p.enclosure) {
                    (Some(exact), _) => format!("{} = {exact}", p.name),
                    (None, Some((low, high))) if low == high => format!("{} = {low}", p.name),
                    (None, Some((low, high))) => format!("{} in [{low}, {high}]", p.name),
                    _ => p.name.clone(),
                })
                .collect();
            let at = if point.is_empty() {
                String::new()
            } else {
                format!("at {}: ", point.join(", "))
            };
            claim.counterexample = Some(format!(
                "{at}{} in [{}, {}]",
                c.quantity, c.residual.0, c.residual.1
            ));
        }
        Verdict::NotApplicable { hypothesis, .. } => claim.condition = Some(hypothesis.clone()),
        Verdict::Undecided { .. } => {}
    }
    if let Verdict::Conditional { condition, .. } = verdict {
        claim.condition = Some(condition.clone());
    }
}

fn trajectory(study: &Study, motion: &Motion, files: &[String]) -> Trajectory {
    let evidence = &motion.evidence;
    let run = &evidence.run;
    let table = Table::new(study, motion);
    let n = study.system.n();
    let mut series: Vec<Series> = Vec::new();
    for (i, (name, values)) in table.names.iter().zip(table.columns).enumerate().skip(1) {
        let group = match i {
            i if i <= n => SeriesGroup::Coordinates,
            i if i <= 2 * n => SeriesGroup::Velocities,
            i if i <= 3 * n => continue,
            _ if name.starts_with("lambda_") => SeriesGroup::Multipliers,
            _ if name == "energy" => SeriesGroup::Energy,
            _ => SeriesGroup::Integrals,
        };
        let unit = (i <= n)
            .then(|| {
                study.model.coordinates[i - 1]
                    .unit
                    .as_ref()
                    .map(|u| u.text.clone())
            })
            .flatten();
        series.push(Series {
            name: name.clone(),
            group,
            values,
            unit,
            ..Series::default()
        });
    }
    let followed = std::iter::once(&evidence.energy).chain(&evidence.integrals);
    for f in followed {
        let start = f.values.first().copied().unwrap_or(0.0);
        series.push(drift(
            &format!("{} − start", f.name),
            f.values.iter().map(|x| (x - start).abs()).collect(),
            evidence.tolerance,
        ));
    }
    for f in &evidence.residuals {
        let name = format!("constraint {}", f.name);
        series.push(drift(
            &name,
            f.values.iter().map(|x| x.abs()).collect(),
            evidence.tolerance,
        ));
    }
    Trajectory {
        times: run.times.clone(),
        time_unit: study.model.has_units.then(|| "s".into()),
        series,
        stop: Stop {
            reason: run.ending.reason.clone(),
            early: !run.ending.finished,
            expected: stop_is_expected(&study.model, motion),
        },
        statistics: statistics(motion),
        chart_switches: run
            .chart_changes
            .iter()
            .map(|(t, c)| ChartSwitch {
                time: *t,
                detail: format!(
                    "other independent velocities: smallest pivot {:.2e} → {:.2e}",
                    c.pivot_before, c.pivot_after
                ),
            })
            .collect(),
        portraits: portraits(study),
        files: files.to_vec(),
    }
}

fn drift(name: &str, values: Vec<f64>, tolerance: f64) -> Series {
    Series {
        name: name.into(),
        group: SeriesGroup::Drifts,
        values,
        tolerance: Some(tolerance),
        ..Series::default()
    }
}

fn statistics(motion: &Motion) -> Vec<Fact> {
    let evidence = &motion.evidence;
    let run = &evidence.run;
    let s = &run.statistics;
    let mut facts = vec![
        fact(
            "Equations integrated",
            run.formulation.into(),
            None,
            Some("motion.formulations-agree"),
        ),
        fact(
            "Method",
            run.method.into(),
            None,
            Some("motion.method-order"),
        ),
        fact(
            "Tolerance",
            format!("{:.0e}", motion.settings.tolerance),
            None,
            None,
        ),
        fact(
            "Steps",
            format!("{} accepted, {} rejected", s.steps, s.rejected),
            None,
            None,
        ),
        fact("Evaluations", s.evaluations.to_string(), None, None),
        fact("Factorizations", s.factorizations.to_string(), None, None),
        fact("Chart changes", s.chart_switches.to_string(), None, None),
    ];
    if let Some(error) = evidence.global_error {
        facts.push(fact(
            "Estimated global error",
            format!("{error:.1e}"),
            None,
            None,
        ));
    }
    for note in &run.notes {
        if let Note::Stiff { t, steps_ahead, .. } = note {
            facts.push(fact(
                "Advice",
                format!("the problem looks stiff from t = {t:.4} on (about {steps_ahead:.0} more steps); an implicit method would need far fewer"),
                None,
                None,
            ));
        }
    }
    facts
}

/// The path in the first two coordinates, and each of the first coordinates against its velocity.
fn portraits(study: &Study) -> Vec<Portrait> {
    let names: Vec<&str> = study
        .system
        .coordinates
        .iter()
        .map(|c| c.name.as_str())
        .collect();
    let mut portraits = Vec::new();
    if names.len() >= 2 {
        portraits.push(Portrait {
            horizontal: names[0].into(),
            vertical: names[1].into(),
            title: None,
            equal: true,
        });
    }
    for name in names.iter().rev().take(3).rev() {
        portraits.push(Portrait {
            horizontal: (*name).into(),
            vertical: format!("{name}'"),
            title: None,
            equal: false,
        });
    }
    portraits
}

/// Error against step size.
fn figures(motion: &Motion) -> Vec<Figure> {
    let Some(orders) = &motion.evidence.orders else {
        return Vec::new();
    };
    let explanation = match orders.observed {
        Some(observed) => format!(
            "A piece of the motion with fixed steps: observed order {observed:.2}, nominal {}.",
            orders.nominal
        ),
        None => "A piece of the motion with fixed steps: all errors are at round-off.".into(),
    };
    vec![Figure {
        title: "Order of the method on this model".into(),
        explanation: vec![explanation],
        horizontal: "step".into(),
        abscissae: orders.steps.clone(),
        series: vec![Series {
            name: "error".into(),
            group: SeriesGroup::Errors,
            values: orders.errors.clone(),
            ..Series::default()
        }],
        logarithmic_horizontal: true,
        logarithmic_vertical: true,
        marks: true,
        claim: Some("motion.method-order".into()),
        ..Figure::default()
    }]
}

/// The drawing of the model evaluated along the motion.
fn animation(study: &Study, motion: &Motion) -> Option<Animation> {
    let drawing = study.model.drawing.as_ref()?;
    let run = &motion.evidence.run;
    let expressions: Vec<Expr> = drawing
        .elements
        .iter()
        .flat_map(|e| e.shape.expressions())
        .collect();
    let mut observer = Observer::new(
        &study.system,
        &study.prepared.terms,
        &motion.binding,
        &expressions,
    )
    .ok()?;
    let series = observer.along(run);
    let mut start = 0;
    let elements = drawing
        .elements
        .iter()
        .map(|element| {
            let width = element.shape.expressions().len();
            let columns = &series[start..start + width];
            start += width;
            Element {
                name: element.name.clone(),
                shape: shape(&element.shape),
                tint: tint(&element.color),
                values: (0..run.len())
                    .flat_map(|j| columns.iter().map(move |c| c[j]))
                    .collect(),
            }
        })
        .collect();
    Some(Animation {
        spatial: drawing.spatial,
        times: run.times.clone(),
        elements,
        bounds: drawing.bounds.as_ref().map(|b| {
            b.iter()
                .map(|(low, high)| [rational::to_f64(low), rational::to_f64(high)])
                .collect()
        }),
        ground: drawing.ground,
        camera: drawing
            .camera
            .as_ref()
            .map(|(a, b)| [rational::to_f64(a), rational::to_f64(b)]),
        unit: None,
        description: (!drawing.description.is_empty()).then(|| drawing.description.clone()),
    })
}

fn shape(drawn: &Drawn) -> Shape {
    match drawn {
        Drawn::Point { .. } => Shape::Point,
        Drawn::Segment { .. } => Shape::Segment,
        Drawn::Arrow { .. } => Shape::Arrow,
        Drawn::Circle { .. } => Shape::Circle,
        Drawn::Sphere { .. } => Shape::Sphere,
        Drawn::Wheel { .. } => Shape::Wheel,
        Drawn::Blade { .. } => Shape::Blade,
        Drawn::Polyline {
            points,
            closed,
            filled,
        } => Shape::Polyline {
            points: points.len(),
            closed: *closed,
            filled: *filled,
        },
        Drawn::Trail { .. } => Shape::Trail,
        Drawn::Label { text, .. } => Shape::Label { text: text.clone() },
    }
}

fn tint(name: &str) -> Tint {
    match name {
        "muted" => Tint::Muted,
        "blue" => Tint::Blue,
        "red" => Tint::Red,
        "green" => Tint::Green,
        "amber" => Tint::Amber,
        "violet" => Tint::Violet,
        _ => Tint::Ink,
    }
}

fn source(study: &Study) -> ModelSource {
    let text = &study.model.text;
    let mut files = vec![SourceFile {
        name: text.path.clone(),
        text: text.text.clone(),
    }];
    files.extend(text.includes.iter().map(|(name, text)| SourceFile {
        name: name.clone(),
        text: text.clone(),
    }));
    ModelSource {
        files,
        overrides: text
            .overrides
            .iter()
            .map(|(name, value)| format!("{name} = {value}"))
            .collect(),
    }
}

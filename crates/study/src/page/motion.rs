//! The computed motion: curves, integrals and drifts with the verdicts on them, the course of the run.

use super::claims::word;
use super::{fact, unit};
use crate::expectations::stop_is_expected;
use crate::kept::Kept;
use crate::motion_evidence::Followed;
use crate::plain;
use crate::record::zero_word;
use crate::study::{Motion, Study};
use crate::table::Table;
use crate::typeset::{in_line, letters, Typesetter};
use crate::witness;
use chetaev_geometry::noether::claims::symmetry_named;
use chetaev_report::data::{
    ChartSwitch, Conserved, EventMet, Fact, Figure, Portrait, Series, SeriesGroup, Stop,
    Trajectory, Verdict as Word,
};

/// The motion.
pub(super) fn trajectory(
    study: &Study,
    motion: &Motion,
    set: &Typesetter<'_>,
    files: &[String],
) -> Trajectory {
    let run = &motion.evidence.run;
    let mut series = curves(study, motion);
    series.extend(found(study, motion));
    series.extend(beside(study, motion));
    series.extend(drifts(study, motion));
    Trajectory {
        times: run.times.clone(),
        time_unit: study.model.has_units.then(|| "s".into()),
        conserved: conserved(study, motion, set, &series),
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
                    "other velocities are taken as independent: the smallest pivot changes from {} to {}",
                    pivot(c.pivot_before),
                    pivot(c.pivot_after)
                ),
            })
            .collect(),
        events: events_met(motion),
        portraits: portraits(study, motion),
        files: files.to_vec(),
    }
}

fn events_met(motion: &Motion) -> Vec<EventMet> {
    let met = motion.evidence.run.events.iter();
    met.map(|met| EventMet {
        time: met.t,
        detail: format!(
            "event `{}`: {}",
            motion.settings.events[met.event].name,
            match zero_word(met.kind) {
                "grazing" => "its function touches zero",
                "rising" => "its function rises through zero",
                _ => "its function falls through zero",
            }
        ),
    })
    .collect()
}

/// The name of a curve of the constrained extremum.
fn of_extremum(name: &str) -> String {
    format!("{name} of the extremum")
}

/// Coordinates and velocities of the constrained extremum beside the motion, and its multipliers.
fn beside(study: &Study, motion: &Motion) -> Vec<Series> {
    let Some(found) = motion.extremum() else {
        return Vec::new();
    };
    let (run, rows) = (&found.run, motion.evidence.run.len());
    let n = study.system.n();
    let coordinates = &study.system.coordinates;
    let column = |i: usize| -> Vec<f64> {
        let value = |j: usize| match j < run.len() {
            true => run.row(j)[i],
            false => f64::NAN,
        };
        (0..rows).map(value).collect()
    };
    let mut series = Vec::new();
    for (order, range) in [(0, run.layout.q()), (1, run.layout.v())] {
        for (c, i) in coordinates.iter().zip(range) {
            let name = format!("{}{}", c.name, "'".repeat(order));
            series.push(Series {
                label: Some(format!("{}, extremum", letters(&name))),
                name: of_extremum(&name),
                group: match order {
                    0 => SeriesGroup::Coordinates,
                    _ => SeriesGroup::Velocities,
                },
                values: column(i),
                unit: unit(study, (series.len()) % n, order),
                ..Series::default()
            });
        }
    }
    for (name, i) in run.own.iter().zip(run.layout.own()) {
        series.push(Series {
            name: name.clone(),
            label: Some(letters(name)),
            group: SeriesGroup::Multipliers,
            values: column(i),
            ..Series::default()
        });
    }
    series
}

fn pivot(value: f64) -> String {
    if value.abs() < 1e-3 {
        format!("{value:.1e}")
    } else {
        format!("{value:.3}")
    }
}

/// What was recorded, but for the accelerations.
fn curves(study: &Study, motion: &Motion) -> Vec<Series> {
    let table = Table::new(study, motion);
    let (n, masses) = (study.system.n(), study.system.masses.len());
    let mut series = Vec::new();
    for (i, (name, values)) in table.names.iter().zip(table.columns).enumerate().skip(1) {
        let is_mass = (n + 1..=n + masses).contains(&i);
        // The place among coordinates, velocities and accelerations.
        let place = if i <= n { i } else { i - masses };
        let group = match place {
            _ if is_mass => SeriesGroup::Coordinates,
            i if i <= n => SeriesGroup::Coordinates,
            i if i <= 2 * n => SeriesGroup::Velocities,
            i if i <= 3 * n => continue,
            _ if name.starts_with("lambda_") => SeriesGroup::Multipliers,
            _ if study.model.sensors.iter().any(|own| own.name == *name) => SeriesGroup::Other,
            _ if name == "energy" => SeriesGroup::Energy,
            _ => SeriesGroup::Integrals,
        };
        let label = match group {
            SeriesGroup::Energy => None,
            SeriesGroup::Integrals => name.strip_prefix("integral_").map(str::to_owned),
            _ => Some(letters(name)),
        };
        series.push(Series {
            name: name.clone(),
            label,
            group,
            values,
            unit: match is_mass {
                true => mass_unit(study, name),
                false if place <= 2 * n => unit(study, (place - 1) % n, (place - 1) / n),
                false => None,
            },
            ..Series::default()
        });
    }
    series
}

/// The values of the integrals found; the energy has its curve.
fn found(study: &Study, motion: &Motion) -> Vec<Series> {
    let others = motion.found.others.iter();
    others
        .map(|own| Series {
            name: format!("first integral {}", own.name),
            label: Some(numbered(study, own)),
            group: SeriesGroup::Integrals,
            values: own.values.clone(),
            ..Series::default()
        })
        .collect()
}

/// The number of an integral that was found, with its formula where that is short.
fn numbered(study: &Study, own: &Followed) -> String {
    let text = study.system.graph.text(own.shown);
    match text.chars().count() <= SHORT {
        true => format!("{}: {}", own.name, in_line(&text)),
        false => format!("first integral {}", own.name),
    }
}

/// Formulas up to this length stand in the legends of plots.
const SHORT: usize = 32;

/// What should keep its value: the integrals that the model states and those that were found, each with its symmetry and where its
/// drift is among the series.
fn conserved(
    study: &Study,
    motion: &Motion,
    set: &Typesetter<'_>,
    series: &[Series],
) -> Vec<Conserved> {
    let stated = motion.evidence.integrals.iter();
    let stated = stated.map(|own| (own, "noether.inverse", drift_of_stated(own)));
    let energy = motion.found.energy.as_ref().map(|own| &own.name);
    let found = motion.found.all().into_iter().map(|own| {
        let drift = match energy == Some(&own.name) {
            true => "drift of energy".to_owned(),
            false => drift_of_found(own),
        };
        (own, "noether.integral", drift)
    });
    stated
        .chain(found)
        .map(|(own, claim, drift)| {
            let claim = format!("{claim}#{}", own.name);
            let decided = study.verdicts.iter().find(|d| d.full_id() == claim);
            let symmetry = decided.and_then(|d| symmetry_named(d.finding.verdict.detail()));
            let printed = set.expression(set.simplified(&[own.shown]).pop().unwrap_or(own.shown));
            Conserved {
                name: own.name.clone(),
                formula: printed.formula,
                omitted: printed.omitted.is_some(),
                origin: symmetry.map(|text| plain::written(&study.system, text)),
                start: own.values.first().copied().unwrap_or(f64::NAN),
                drift: Some(drift).filter(|drift| series.iter().any(|s| s.name == *drift)),
                is_enforced: own.kept.is_some(),
                claim: decided.map(|_| claim),
            }
        })
        .collect()
}

/// The name of the series with the drift of an integral that the model states.
fn drift_of_stated(own: &Followed) -> String {
    format!("drift of integral {}", own.name)
}

/// The same of one that was found.
fn drift_of_found(own: &Followed) -> String {
    format!("drift of first integral {}", own.name)
}

fn mass_unit(study: &Study, name: &str) -> Option<String> {
    let mass = study.model.masses.iter().find(|m| m.name == name)?;
    Some(mass.unit.as_ref()?.text.clone())
}

/// Deviations of energy and integrals from their initial values and residuals of the constraints, each with the claim
/// that judges it. What is no integral does not drift, it changes, and is left out.
fn drifts(study: &Study, motion: &Motion) -> Vec<Series> {
    let evidence = &motion.evidence;
    let mut series = Vec::new();
    let mut push = |name: String, label: String, values: &[f64], claim: String| {
        let decided = study.verdicts.iter().find(|d| d.full_id() == claim);
        let verdict = decided.map(|d| word(d.finding.verdict.word()));
        if verdict == Some(Word::NotApplicable) {
            return;
        }
        series.push(Series {
            name,
            label: Some(label),
            group: SeriesGroup::Drifts,
            values: values.iter().map(|x| x.abs()).collect(),
            tolerance: decided.and_then(|d| bound_of(d.finding.verdict.detail())),
            claim: decided.map(|_| claim),
            ..Series::default()
        });
    };
    push(
        "drift of energy".into(),
        "energy".into(),
        &evidence.energy.changes,
        "motion.energy-drift".into(),
    );
    for f in &evidence.integrals {
        push(
            drift_of_stated(f),
            format!("integral {}", f.name),
            &f.changes,
            format!("motion.integral-drift#{}", f.name),
        );
    }
    for f in &motion.found.others {
        push(
            drift_of_found(f),
            numbered(study, f),
            &f.changes,
            format!("motion.integral-drift#{}", f.name),
        );
    }
    for f in &evidence.residuals {
        push(
            format!("drift of constraint {}", f.name),
            format!("constraint {}", f.name),
            &f.changes,
            "motion.constraint-drift".into(),
        );
    }
    series
}

/// The bound that a verdict on a drift names at the end of its sentence.
fn bound_of(detail: &str) -> Option<f64> {
    let (_, bound) = detail.rsplit_once("bound ")?;
    bound.trim().parse().ok()
}

fn statistics(motion: &Motion) -> Vec<Fact> {
    let evidence = &motion.evidence;
    let run = &evidence.run;
    let s = &run.statistics;
    let mut facts = vec![
        fact(
            "Equations integrated",
            match run.formulation {
                "routh" => "Routh".into(),
                "maggi" => "Maggi".into(),
                other => other.into(),
            },
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
            format!("{:e}", motion.settings.tolerance),
            None,
            None,
        ),
        fact(
            "Arithmetic",
            match motion.settings.precise {
                Some(_) => "double-double (31 digits)".into(),
                None => "double".into(),
            },
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
    facts.extend(projected(motion));
    if let Some(error) = evidence.global_error {
        facts.push(fact(
            "Estimated global error",
            format!("{error:.1e}"),
            None,
            None,
        ));
    }
    facts
}

/// Which integrals were kept by projection, how often and how far.
fn projected(motion: &Motion) -> Option<Fact> {
    let kept = Kept::of(motion)?;
    let all = kept.report.steps;
    let each = kept
        .integrals()
        .map(|(number, _, steps)| match steps == all {
            true => number.to_string(),
            false => format!("{number} (after {steps} of {all} steps)"),
        });
    let each: Vec<String> = each.collect();
    let label = match each.len() {
        1 => "First integral kept by projection",
        _ => "First integrals kept by projection",
    };
    let mut fact = fact(label, each.join(", "), None, None);
    fact.note = Some(kept.moves());
    Some(fact)
}

/// The path in the first two coordinates, and each of the first coordinates against its velocity.
fn portraits(study: &Study, motion: &Motion) -> Vec<Portrait> {
    let beside = |horizontal: &str, vertical: &str| {
        motion.extremum()?;
        Some((of_extremum(horizontal), of_extremum(vertical)))
    };
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
            equal: true,
            beside: beside(names[0], names[1]),
            ..Portrait::default()
        });
    }
    for name in names.iter().rev().take(3).rev() {
        portraits.push(Portrait {
            horizontal: (*name).into(),
            vertical: format!("{name}'"),
            beside: beside(name, &format!("{name}'")),
            ..Portrait::default()
        });
    }
    portraits
}

/// Error against step size, and first variations against it.
pub(super) fn figures(motion: &Motion) -> Vec<Figure> {
    orders(motion)
        .into_iter()
        .chain(first_variations(motion))
        .chain(conjugate_times(motion))
        .chain(PICTURES.iter().filter_map(|picture| picture.of(motion)))
        .collect()
}

/// A picture of what a witness computed.
struct Picture {
    figure: witness::Figure,
    title: &'static str,
    explanation: &'static str,
    claim: &'static str,
}

static PICTURES: [Picture; 4] = [
    Picture {
        figure: witness::Figure::Action,
        title: "Least action beside the motion",
        explanation: "The first variation of each action of curves beside the motion, at its energy or at varied times, over the sizes of its terms: it goes to zero with the step of the quadrature, down to the accuracy of the motion.",
        claim: "witness.action",
    },
    Picture {
        figure: witness::Figure::SecondKind,
        title: "Principles of the second kind along the motion",
        explanation: "q and v are varied independently, with differences of the positions and momenta at the rows as their rates: each statement goes to zero with the step.",
        claim: "witness.second-kind",
    },
    Picture {
        figure: witness::Figure::Operators,
        title: "Operators δv = A(δq) along the motion",
        explanation: "The principle with δv by each operator, on all and on some of the velocities: each goes to zero with the step, whatever A is.",
        claim: "witness.universal-relation",
    },
    Picture {
        figure: witness::Figure::OtherTime,
        title: "Equations in another time against the motion",
        explanation: "The largest distance of the positions integrated in τ from those of the motion at the time that came out: it falls with the fourth power of the step, down to the accuracy of the motion.",
        claim: "witness.other-time",
    },
];

impl Picture {
    /// The picture by the step, where something was computed for it.
    fn of(&self, motion: &Motion) -> Option<Figure> {
        let shown = motion.witness.shown.iter();
        let own: Vec<&witness::Shown> = shown.filter(|s| s.figure == self.figure).collect();
        let first = own.first()?;
        let smallest = first.refined.steps.first()?;
        // Stretches differ, and with them their steps: all are counted in the smallest.
        let multiples = first.refined.steps.iter().map(|step| step / smallest);
        Some(Figure {
            title: self.title.into(),
            explanation: vec![self.explanation.into()],
            horizontal: "step over the smallest".into(),
            abscissae: multiples.collect(),
            series: own
                .iter()
                .map(|shown| Series {
                    name: shown.name.clone(),
                    group: SeriesGroup::Errors,
                    values: shown.refined.residuals.clone(),
                    ..Series::default()
                })
                .collect(),
            logarithmic_horizontal: true,
            logarithmic_vertical: true,
            marks: true,
            claim: Some(format!("{}#{}", self.claim, first.subject)),
            ..Figure::default()
        })
    }
}

/// The first variation of each form by the step of the quadrature, and that of the action among admissible neighbours.
fn first_variations(motion: &Motion) -> Option<Figure> {
    let forms = &motion.witness.first;
    let steps = forms.first()?.refined.steps.clone();
    let mut series: Vec<Series> = forms
        .iter()
        .map(|found| Series {
            name: found.form.whose().into(),
            group: SeriesGroup::Errors,
            values: found.refined.residuals.clone(),
            ..Series::default()
        })
        .collect();
    if let Some(found) = &motion.witness.neighbours {
        series.push(Series {
            name: "action of admissible neighbours".into(),
            group: SeriesGroup::Errors,
            values: vec![found.change; steps.len()],
            ..Series::default()
        });
    }
    Some(Figure {
        title: "First variations along the motion".into(),
        explanation: vec![
            "|∫ δ dt| over the integral of the sizes of its terms, for random virtual displacements that vanish at the ends, by the step of the trapezoidal rule: it goes to zero for each form of Hamilton’s principle.".into(),
            "For neighbours that satisfy the constraints, δ∫L dt is zero only where the motion makes the action stationary.".into(),
        ],
        horizontal: "step".into(),
        abscissae: steps,
        series,
        logarithmic_horizontal: true,
        logarithmic_vertical: true,
        marks: true,
        claim: Some("witness.first-variation#hoelder".into()),
        ..Figure::default()
    })
}

/// The determinant whose zeros conjugate times are.
fn conjugate_times(motion: &Motion) -> Option<Figure> {
    let found = motion.witness.conjugate.as_ref()?;
    let values = found.determinants.iter().map(|(_, value)| *value);
    let largest = values.clone().fold(0.0_f64, |m, x| m.max(x.abs()));
    if largest == 0.0 || !largest.is_finite() || found.legendre.is_err() {
        return None;
    }
    let kept = match found.times.first() {
        None => "It has no zero here: the action is a weak minimum on the whole interval.".into(),
        Some(first) => format!(
            "The first zero, t = {first:.6}, is where the action stops being a weak minimum."
        ),
    };
    Some(Figure {
        title: "Conjugate times".into(),
        explanation: vec![
            "The determinant of extremals that start beside the motion from its first position, over its largest value: zero where some of them meet the motion again to first order.".into(),
            kept,
        ],
        horizontal: "t".into(),
        abscissae: found.determinants.iter().map(|(t, _)| *t).collect(),
        series: vec![Series {
            name: "determinant".into(),
            group: SeriesGroup::Other,
            values: values.map(|x| x / largest).collect(),
            ..Series::default()
        }],
        claim: Some("witness.index".into()),
        ..Figure::default()
    })
}

fn orders(motion: &Motion) -> Option<Figure> {
    let orders = motion.evidence.orders.as_ref()?;
    let explanation = match orders.observed {
        Some(observed) => format!(
            "A piece of the motion with fixed steps: observed order {observed:.2}, nominal {}.",
            orders.nominal
        ),
        None => {
            "A piece of the motion with fixed steps: no order could be read off its errors.".into()
        }
    };
    Some(Figure {
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
    })
}

#[cfg(test)]
mod tests {
    use super::bound_of;

    #[test]
    fn the_bound_of_a_drift_is_read_from_its_verdict() {
        let detail = "largest drift of the energy: 1.07e-10 at t = 2.3 over 601 states, tolerance asked 1e-11, bound 1.1e-8";
        assert_eq!(bound_of(detail), Some(1.1e-8));
        assert_eq!(bound_of("no motion was computed"), None);
    }
}

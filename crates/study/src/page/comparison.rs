//! The motion beside the constrained extremum, for the page.

use super::{fact, unit};
use crate::beside::{number, told, Beside, Gap};
use crate::study::{Motion, Study};
use crate::typeset::letters;
use chetaev_report::data::{Comparison, Fact, Figure, Series, SeriesGroup};

/// What the story of the comparison rests on.
const CLAIMS: [&str; 3] = [
    "hamilton.stationary",
    "formulation.vakonomic-coincides#system",
    "witness.stationary",
];

/// The comparison, where one was asked for.
pub(super) fn comparison(study: &Study, motion: &Motion) -> Option<Comparison> {
    let title = "The motion and the constrained extremum".to_string();
    let found = match motion.beside.as_ref()? {
        Ok(found) => found,
        Err(why) => {
            return Some(Comparison {
                title,
                paragraphs: vec![format!("There is no extremum to compare: {why}.")],
                ..Comparison::default()
            })
        }
    };
    let decided: Vec<String> = study.verdicts.iter().map(|d| d.full_id()).collect();
    let claims = CLAIMS.map(String::from).into_iter();
    Some(Comparison {
        title,
        paragraphs: told(study, motion, found),
        facts: facts(study, motion, found),
        claims: claims.filter(|id| decided.contains(id)).collect(),
        figures: figures(study, motion, found),
        has_path: study.system.n() >= 2,
    })
}

/// κ(0), and the largest distance in each coordinate.
fn facts(study: &Study, motion: &Motion, found: &Beside) -> Vec<Fact> {
    let multipliers = found.kappa.iter().map(|(name, value)| {
        let own = name.strip_prefix("kappa_").unwrap_or(name);
        let label = format!("Multiplier of {own} at the start");
        fact(&label, number(*value), Some("κ(0)"), None)
    });
    let gaps = found.gaps.iter().map(|gap| {
        let (row, distance) = gap.largest();
        let name = &study.system.coordinates[gap.coordinate].name;
        let unit = unit(study, gap.coordinate, 0).map_or(String::new(), |u| format!(" {u}"));
        let second = if study.model.has_units { " s" } else { "" };
        Fact {
            note: Some(format!(
                "at t = {}{second}",
                number(motion.evidence.run.times[row])
            )),
            ..fact(
                &format!("Largest distance in {}", letters(name)),
                format!("{}{unit}", number(distance)),
                None,
                None,
            )
        }
    });
    multipliers.chain(gaps).collect()
}

/// More curves than these in one figure are not told apart.
const CURVES: usize = 8;

/// The distance over the time, coordinates of one unit in one figure.
fn figures(study: &Study, motion: &Motion, found: &Beside) -> Vec<Figure> {
    let mut units: Vec<Option<String>> = Vec::new();
    for gap in &found.gaps {
        let unit = unit(study, gap.coordinate, 0);
        if !units.contains(&unit) {
            units.push(unit);
        }
    }
    units
        .into_iter()
        .map(|unit| figure(study, motion, found, unit))
        .collect()
}

fn figure(study: &Study, motion: &Motion, found: &Beside, shared: Option<String>) -> Figure {
    let of_unit = |gap: &&Gap| unit(study, gap.coordinate, 0) == shared;
    let gaps: Vec<&Gap> = found.gaps.iter().filter(of_unit).take(CURVES).collect();
    let names: Vec<&str> = gaps
        .iter()
        .map(|gap| study.system.coordinates[gap.coordinate].name.as_str())
        .collect();
    let rows = gaps.iter().map(|gap| gap.values.len()).min().unwrap_or(0);
    let series = gaps.iter().zip(&names).map(|(gap, name)| Series {
        name: format!("distance in {name}"),
        label: Some(letters(name)),
        group: SeriesGroup::Other,
        values: gap.values.clone(),
        unit: shared.clone(),
        ..Series::default()
    });
    Figure {
        title: format!("Distance in {} over the time", names.join(", ")),
        explanation: vec!["|motion − extremum| in each coordinate.".into()],
        horizontal: "t".into(),
        horizontal_unit: study.model.has_units.then(|| "s".into()),
        abscissae: motion.evidence.run.times[..rows].to_vec(),
        series: series.collect(),
        ..Figure::default()
    }
}

//! The notices of a record against those of the replay.

use super::texts::{self, Agreement};
use super::{Replay, Verified};
use crate::record::Record;

/// One line on the notices; none where there are none.
pub(super) fn compare(record: &Record, replayed: &Record) -> Option<Verified> {
    // That a study was interrupted is nothing that a replay says.
    let stated = record.notices.iter();
    let stated: Vec<String> = stated
        .filter(|notice| !notice.starts_with("interrupted"))
        .cloned()
        .collect();
    let found = &replayed.notices;
    if stated.is_empty() && found.is_empty() {
        return None;
    }
    Some(Verified {
        claim: "notices".into(),
        recorded: stated.len().to_string(),
        replay: replay((record, &stated), replayed),
    })
}

fn replay((record, stated): (&Record, &Vec<String>), replayed: &Record) -> Replay {
    let found = &replayed.notices;
    let tolerance = record
        .trajectory
        .as_ref()
        .map_or(1e-9, |t| (1e4 * t.tolerance).max(1e-9));
    let agreement = |a: &str, b: &str| texts::compare(a, b, tolerance);
    // Each may come later than where it is sought, so that one left out or added is named itself.
    let unmatched = |from: &[String], among: &[String]| {
        let lost = |own: &&String| {
            among
                .iter()
                .all(|other| agreement(own, other) == Agreement::Other)
        };
        from.iter().find(lost).cloned()
    };
    let difference = match (unmatched(stated, found), unmatched(found, stated)) {
        (Some(text), _) => Some(format!("the replay does not say \"{text}\"")),
        (None, Some(text)) => Some(format!("the record leaves out \"{text}\"")),
        (None, None) if stated.len() != found.len() => {
            Some("a notice is stated more than once".to_owned())
        }
        (None, None) => None,
    };
    match difference {
        Some(what) if record.chetaev != replayed.chetaev => Replay::Remark {
            what: format!("written by version {}: {what}", record.chetaev),
        },
        Some(what) => Replay::Numbers { what },
        None if stated == found => Replay::Confirmed,
        None => Replay::Remark {
            what: "the same notices, with other last digits or in another order".into(),
        },
    }
}

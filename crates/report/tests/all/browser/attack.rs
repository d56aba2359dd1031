//! A page whose every text tries to break out of its place.

use chetaev_report::data::*;

const ATTACK: &str = "\"'></script></style></title></textarea><script>window.attacked = 1</script><img src=x onerror='window.attacked = 1'><!-- <![CDATA[ {{x}} ${x} \u{2028}\u{0}";

/// The sleigh's page with every text replaced.
pub(crate) fn report() -> Report {
    let value = serde_json::to_value(super::sleigh::report()).expect("a report is JSON");
    let mut report: Report = serde_json::from_value(poisoned(value)).expect("still a report");
    if let Some(trajectory) = &mut report.trajectory {
        trajectory.series[0].values[3] = f64::NAN;
        trajectory.series[1].values[5] = f64::INFINITY;
        trajectory.portraits = vec![Portrait {
            horizontal: ATTACK.into(),
            vertical: ATTACK.into(),
            ..Portrait::default()
        }];
    }
    if let Some(animation) = &mut report.animation {
        animation.elements[0].values[7] = f64::NAN;
    }
    report
}

/// Every string that is not one of an enumeration becomes the attack.
fn poisoned(value: serde_json::Value) -> serde_json::Value {
    use serde_json::Value;
    match value {
        Value::Array(items) => items.into_iter().map(poisoned).collect(),
        Value::Object(fields) => fields
            .into_iter()
            .map(|(name, value)| {
                let is_word = ["verdict", "origin", "group", "kind", "tint", "expected"]
                    .contains(&name.as_str());
                let value = if is_word { value } else { poisoned(value) };
                (name, value)
            })
            .collect::<serde_json::Map<_, _>>()
            .into(),
        Value::String(_) => Value::String(ATTACK.into()),
        other => other,
    }
}

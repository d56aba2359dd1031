//! A run of a hundred thousand samples and many series, to feel the weight of a page.

use chetaev_report::data::*;

pub(crate) fn report() -> Report {
    let times: Vec<f64> = (0..100_000).map(|i| f64::from(i) * 1e-2).collect();
    let series = (0..12)
        .map(|j| Series {
            name: format!("q_{j}"),
            group: if j < 6 {
                SeriesGroup::Coordinates
            } else {
                SeriesGroup::Drifts
            },
            values: times
                .iter()
                .map(|t| {
                    let wave = (t * (1.0 + 0.1 * f64::from(j))).sin() * (t * 0.01).cos();
                    if j < 6 {
                        wave
                    } else {
                        wave * 1e-10
                    }
                })
                .collect(),
            tolerance: (j >= 6).then_some(1e-9),
            ..Series::default()
        })
        .collect();
    Report {
        title: "Long run".into(),
        trajectory: Some(Trajectory {
            times,
            series,
            portraits: vec![Portrait {
                horizontal: "q_0".into(),
                vertical: "q_1".into(),
                ..Portrait::default()
            }],
            ..Trajectory::default()
        }),
        ..Report::default()
    }
}

//! A report with long formulas, names with subscripts and drifts with claims.

use chetaev_report::data::{
    Claim, Equation, EquationSection, Formula, Report, Series, SeriesGroup, Trajectory, Verdict,
};

fn long_equation() -> Equation {
    let term = "<mrow><mi>a</mi><mo>&#x2062;</mo><mover><mi>φ</mi><mo>˙</mo></mover></mrow>";
    let sum = vec![term; 60].join("<mo>+</mo>");
    Equation {
        formula: Formula {
            mathml: Some(format!(
                "<math><mrow><mi>T</mi><mo>=</mo><mrow>{sum}</mrow></mrow></math>"
            )),
            ..Formula::default()
        },
        ..Equation::default()
    }
}

fn series(name: &str, label: &str, group: SeriesGroup) -> Series {
    Series {
        name: name.into(),
        label: Some(label.into()),
        group,
        values: (0..40).map(|i| 1e-10 * f64::from(i)).collect(),
        ..Series::default()
    }
}

pub(crate) fn report() -> Report {
    let claim = |id: &str, verdict| Claim {
        claim: id.into(),
        verdict,
        detail: "largest drift 3.9e-9, bound 1e-8".into(),
        ..Claim::default()
    };
    let drift = |label: &str, tolerance: f64, claim: &str| Series {
        tolerance: Some(tolerance),
        claim: Some(claim.into()),
        ..series(&format!("drift of {label}"), label, SeriesGroup::Drifts)
    };
    Report {
        title: "Names".into(),
        sections: vec![EquationSection {
            title: "Lagrangian".into(),
            equations: vec![long_equation()],
            ..EquationSection::default()
        }],
        claims: vec![
            claim("motion.energy-drift", Verdict::Numerical),
            claim("motion.constraint-drift", Verdict::Refuted),
        ],
        trajectory: Some(Trajectory {
            times: (0..40).map(f64::from).collect(),
            series: vec![
                series("phi'", "φ\u{307}", SeriesGroup::Velocities),
                series("lambda_blade", "λ_{blade}", SeriesGroup::Multipliers),
                drift("energy", 1e-8, "motion.energy-drift"),
                drift("constraint blade", 1e-12, "motion.constraint-drift"),
            ],
            ..Trajectory::default()
        }),
        ..Report::default()
    }
}

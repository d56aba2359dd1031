//! What claims on motions have in common: their subjects, their hypothesis, and what contradicts them.

use crate::about::About;
use crate::enclosure::right_of_axis;
use crate::spectrum::Polynomial;
use chetaev_mechanics::claims::Context;
use chetaev_symbolic::verdict::Counterexample;
use dashu_ratio::RBig;

/// One for each motion that the model names.
pub(crate) fn motions(cx: &Context<'_>) -> Vec<Option<String>> {
    let motions = cx.system.steady.iter();
    motions.map(|s| Some(s.name.clone())).collect()
}

/// The motion is what is asked for.
pub(crate) fn requires(subject: Option<&str>) -> Vec<String> {
    vec![format!("steady.stated#{}", subject.unwrap_or_default())]
}

/// An eigenvalue right of the axis, enclosed.
pub(crate) fn unstable(about: &About<'_>, at: Option<&RBig>) -> Counterexample {
    let factors = about.question.spectrum.factors.iter();
    let factors: Vec<Polynomial> = factors.map(|(f, _)| f.clone()).collect();
    let found = right_of_axis(about.graph(), &factors, about.question.over.zip(at));
    let sentence = "the linear equations about the steady motion have an eigenvalue right of the axis: by Lyapunov's first method the motion is unstable";
    match found {
        Some(own) => Counterexample {
            point: Vec::new(),
            quantity: "the real part of an eigenvalue".into(),
            residual: own.real,
            detail: match own.imaginary {
                None => sentence.into(),
                Some((low, high)) => {
                    format!("{sentence}; its imaginary part is in [{low}, {high}]")
                }
            },
        },
        None => counted(
            "the number of eigenvalues right of the axis is at least",
            1,
            sentence.into(),
        ),
    }
}

/// A number of things that should be zero.
pub(crate) fn counted(quantity: &str, count: usize, detail: String) -> Counterexample {
    Counterexample {
        point: Vec::new(),
        quantity: quantity.into(),
        residual: (count.to_string(), count.to_string()),
        detail,
    }
}

//! What is known about a claim.
//!
//! There is no conversion to `bool`: a caller has to say what each of the six verdicts means for it.

mod union;

pub use union::Part;

use crate::rational::Rational;

/// How a proof was made (T6).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Method {
    /// True by construction; the detail says why.
    Structural,
    /// Exact arithmetic: normal form, or an exact evaluation.
    Exact,
    /// Evaluation at random points of random prime fields, with a proven bound on the probability of error.
    Modular,
}

impl Method {
    /// The word used in `study.json`.
    pub fn word(self) -> &'static str {
        match self {
            Method::Structural => "structural",
            Method::Exact => "exact",
            Method::Modular => "modular",
        }
    }
}

/// What every proof says of itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Proof {
    /// How it was made.
    pub method: Method,
    /// Where the statement holds: everywhere, on the constraint manifold, on a named branch, under which
    /// assumptions, outside which singular set.
    pub on: String,
    /// Base-2 logarithm of the proven bound on the probability of error; `None` for a proof without error.
    pub error_bound_log2: Option<f64>,
    /// Number of random points used.
    pub samples: u32,
    /// Seed of the random choices.
    pub seed: Option<u64>,
    /// One sentence a person understands.
    pub detail: String,
}

impl Proof {
    /// A proof by exact arithmetic.
    pub fn exact(on: impl Into<String>, detail: impl Into<String>) -> Proof {
        Proof {
            method: Method::Exact,
            on: on.into(),
            error_bound_log2: None,
            samples: 0,
            seed: None,
            detail: detail.into(),
        }
    }

    /// A statement true by construction.
    pub fn structural(on: impl Into<String>, detail: impl Into<String>) -> Proof {
        Proof {
            method: Method::Structural,
            ..Proof::exact(on, detail)
        }
    }
}

/// One named value at a counterexample: exact, or enclosed.
#[derive(Clone, Debug, PartialEq)]
pub struct PointValue {
    /// The symbol, with primes.
    pub name: String,
    /// The exact rational value of independent data.
    pub exact: Option<Rational>,
    /// Decimal lower and upper bound of dependent data.
    pub enclosure: Option<(String, String)>,
}

/// A point where all hypotheses hold and the claim fails.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterexample {
    /// The data, independent first.
    pub point: Vec<PointValue>,
    /// What was evaluated.
    pub quantity: String,
    /// Decimal lower and upper bound of the residual; they exclude zero.
    pub residual: (String, String),
    /// One sentence a person understands.
    pub detail: String,
}

/// Samples without a proof.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// How many points.
    pub samples: u32,
    /// From which region.
    pub region: String,
    /// Decimal digits used.
    pub digits: u32,
    /// The largest scaled residual.
    pub residual: f64,
    /// Seed of the random choices.
    pub seed: Option<u64>,
    /// Why no proof was possible.
    pub why_no_proof: String,
}

/// What is known about a claim (the catalogue of claims, "Verdicts").
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub enum Verdict {
    /// True; by which method and where.
    Proved(Proof),
    /// Supported by samples only.
    Numerical(Evidence),
    /// False; a concrete counterexample.
    Refuted(Counterexample),
    /// False in general, true exactly on a stated subset.
    Conditional {
        /// The equations of the subset.
        condition: String,
        /// How the subset was established.
        proof: Proof,
        /// Why it is false elsewhere, when a point was computed.
        counterexample: Option<Counterexample>,
    },
    /// A hypothesis fails.
    NotApplicable {
        /// The claim id of the hypothesis, with its subject after `#`.
        hypothesis: String,
        /// Why it fails.
        detail: String,
    },
    /// Not decided.
    Undecided {
        /// What was tried and where it stopped.
        tried: String,
    },
}

impl Verdict {
    /// The word used in `study.json`.
    pub fn word(&self) -> &'static str {
        match self {
            Verdict::Proved(_) => "proved",
            Verdict::Numerical(_) => "numerical",
            Verdict::Refuted(_) => "refuted",
            Verdict::Conditional { .. } => "conditional",
            Verdict::NotApplicable { .. } => "not-applicable",
            Verdict::Undecided { .. } => "undecided",
        }
    }

    /// Shorthand for [`Verdict::Undecided`].
    pub fn undecided(tried: impl Into<String>) -> Verdict {
        Verdict::Undecided {
            tried: tried.into(),
        }
    }

    /// Shorthand for [`Verdict::NotApplicable`].
    pub fn not_applicable(hypothesis: impl Into<String>, detail: impl Into<String>) -> Verdict {
        Verdict::NotApplicable {
            hypothesis: hypothesis.into(),
            detail: detail.into(),
        }
    }

    /// Conjunction. A refutation wins, then what makes the question meaningless, then what is open, then the
    /// weaker kind of truth; two proofs add their error bounds.
    pub fn and(self, other: Verdict) -> Verdict {
        if self.rank() > other.rank() {
            return other.and(self);
        }
        match (self, other) {
            (Verdict::Proved(a), Verdict::Proved(b)) => Verdict::Proved(join(a, b)),
            (Verdict::Numerical(a), Verdict::Numerical(b)) => {
                Verdict::Numerical(if a.residual >= b.residual { a } else { b })
            }
            (
                Verdict::Conditional {
                    condition: a,
                    proof,
                    counterexample,
                },
                Verdict::Conditional { condition: b, .. },
            ) => Verdict::Conditional {
                condition: if a == b { a } else { format!("{a} and {b}") },
                proof,
                counterexample,
            },
            (first, _) => first,
        }
    }

    fn rank(&self) -> u8 {
        match self {
            Verdict::Refuted(_) => 0,
            Verdict::NotApplicable { .. } => 1,
            Verdict::Undecided { .. } => 2,
            Verdict::Conditional { .. } => 3,
            Verdict::Numerical(_) => 4,
            Verdict::Proved(_) => 5,
        }
    }

    /// One sentence a person understands.
    pub fn detail(&self) -> &str {
        match self {
            Verdict::Proved(proof) => &proof.detail,
            Verdict::Numerical(evidence) => &evidence.why_no_proof,
            Verdict::Refuted(counterexample) => &counterexample.detail,
            Verdict::Conditional { proof, .. } => &proof.detail,
            Verdict::NotApplicable { detail, .. } => detail,
            Verdict::Undecided { tried } => tried,
        }
    }

    /// The verdict with `sentence` put before what it says already.
    pub fn prefixed(mut self, sentence: &str) -> Verdict {
        self.prefix(sentence);
        self
    }

    /// Puts `sentence` before what the verdict says already.
    pub fn prefix(&mut self, sentence: &str) {
        let detail = match self {
            Verdict::Proved(proof) | Verdict::Conditional { proof, .. } => &mut proof.detail,
            Verdict::Numerical(evidence) => &mut evidence.why_no_proof,
            Verdict::Refuted(counterexample) => &mut counterexample.detail,
            Verdict::NotApplicable { detail, .. } => detail,
            Verdict::Undecided { tried } => tried,
        };
        *detail = match detail.is_empty() {
            true => sentence.to_owned(),
            false => format!("{sentence}; {detail}"),
        };
    }
}

fn join(a: Proof, b: Proof) -> Proof {
    let error_bound_log2 = match (a.error_bound_log2, b.error_bound_log2) {
        (Some(x), Some(y)) => Some(x.max(y) + 1.0),
        (x, y) => x.or(y),
    };
    let detail = if a.detail == b.detail {
        a.detail
    } else {
        format!("{}; {}", a.detail, b.detail)
    };
    Proof {
        method: a.method.max(b.method),
        on: if a.on == b.on {
            a.on
        } else {
            format!("{} and {}", a.on, b.on)
        },
        error_bound_log2,
        samples: a.samples.max(b.samples),
        seed: a.seed.or(b.seed),
        detail,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<Verdict> {
        vec![
            Verdict::Proved(Proof::exact("everywhere", "identity")),
            Verdict::Numerical(Evidence {
                samples: 3,
                region: "unit box".into(),
                digits: 16,
                residual: 1e-12,
                seed: Some(1),
                why_no_proof: "log and atan".into(),
            }),
            Verdict::Refuted(Counterexample {
                point: vec![],
                quantity: "E".into(),
                residual: ("1".into(), "2".into()),
                detail: "E is not zero".into(),
            }),
            Verdict::Conditional {
                condition: "x = 0".into(),
                proof: Proof::exact("x = 0", "factor"),
                counterexample: None,
            },
            Verdict::not_applicable("model.chaplygin", "L depends on y"),
            Verdict::undecided("time"),
        ]
    }

    #[test]
    fn conjunction_is_defined_for_all_pairs_and_commutes_in_kind() {
        for a in all() {
            for b in all() {
                let (ab, ba) = (a.clone().and(b.clone()), b.clone().and(a.clone()));
                assert_eq!(ab.word(), ba.word());
            }
            assert_eq!(a.clone().and(all()[0].clone()).word(), a.word());
            assert_eq!(a.clone().and(all()[2].clone()).word(), "refuted");
        }
    }

    #[test]
    fn error_bounds_add() {
        let bounded = |bound| {
            Verdict::Proved(Proof {
                error_bound_log2: Some(bound),
                method: Method::Modular,
                ..Proof::exact("everywhere", "identity")
            })
        };
        let Verdict::Proved(proof) = bounded(-110.0).and(bounded(-120.0)) else {
            unreachable!()
        };
        assert_eq!(proof.error_bound_log2, Some(-109.0));
        assert_eq!(proof.method, Method::Modular);
    }
}

//! What the verdicts on several parts say together of their union: the one place that knows it.
//!
//! A statement about all states, or about all values of the parameters, is asked on parts of them where these differ: components of
//! constraints, sides of corners, values that a model states. True on all parts it is true; false on all it is false; true on some and
//! false on others it is conditional, and the condition names those on which it is true. A part that was not decided leaves the
//! statement open, as long as no other part refutes it.

use super::{join, Verdict};

/// A part, with what is known on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Where that is, for a sentence: "where x > 0", "for k = 1".
    pub place: String,
    /// The equations and signs that single the part out.
    pub condition: String,
    /// What is known there.
    pub verdict: Verdict,
}

impl Part {
    fn holds(&self) -> bool {
        matches!(self.verdict, Verdict::Proved(_) | Verdict::Numerical(_))
    }

    /// Where it holds on this part, and how that is said beside the others: a condition needs the part's own beside it, unless it
    /// holds on all others anyway.
    fn holds_where(&self, others: &[&Part]) -> Option<String> {
        let mut others = others.iter().filter(|other| !std::ptr::eq(**other, self));
        match &self.verdict {
            _ if self.holds() => Some(self.condition.clone()),
            Verdict::Conditional { condition, .. } if others.all(|other| other.holds()) => {
                Some(condition.clone())
            }
            Verdict::Conditional { condition, .. } => {
                Some(format!("{condition}, with {}", self.condition))
            }
            _ => None,
        }
    }
}

impl Verdict {
    /// The verdict on the union of parts, which cover all there is. Parts on which a hypothesis fails are named and do not count.
    pub fn union(parts: Vec<Part>) -> Verdict {
        let detail = told(&parts);
        let is_not_applicable = |p: &&Part| matches!(p.verdict, Verdict::NotApplicable { .. });
        let asked = parts.iter().filter(|p| !is_not_applicable(p));
        let asked: Vec<&Part> = asked.collect();
        let Some(first) = asked.first() else {
            let first = parts.into_iter().next();
            let nothing = || Verdict::undecided("there is no part");
            return first.map_or_else(nothing, |part| with_detail(part.verdict, detail));
        };
        let find = |is: fn(&Verdict) -> bool| asked.iter().find(|p| is(&p.verdict));
        let refuted = find(|v| matches!(v, Verdict::Refuted(_)));
        let open = find(|v| matches!(v, Verdict::Undecided { .. }));
        let conditional = find(|v| matches!(v, Verdict::Conditional { .. }));
        let holds = asked.iter().any(|p| p.holds()) || conditional.is_some();
        let verdict = match (refuted, open, conditional) {
            (Some(refuted), ..) if !holds => refuted.verdict.clone(),
            (None, Some(open), _) => open.verdict.clone(),
            (None, None, None) => {
                let all = asked.iter().map(|p| p.verdict.clone());
                all.reduce(Verdict::and)
                    .unwrap_or_else(|| first.verdict.clone())
            }
            _ => partly(&asked),
        };
        with_detail(verdict, detail)
    }
}

/// The verdict where a statement holds on some of the parts, or on parts of them.
fn partly(asked: &[&Part]) -> Verdict {
    let conditions = asked.iter().filter_map(|p| match &p.verdict {
        Verdict::Conditional { condition, .. } => Some(condition),
        _ => None,
    });
    let conditions: Vec<&String> = conditions.collect();
    let is_the_same =
        conditions.len() == asked.len() && conditions.windows(2).all(|w| w[0] == w[1]);
    let condition = match conditions.first() {
        Some(&one) if is_the_same => one.clone(),
        _ => {
            let places = asked.iter().filter_map(|p| p.holds_where(asked));
            places.collect::<Vec<String>>().join(", or ")
        }
    };
    let proofs = asked.iter().filter_map(|p| match &p.verdict {
        Verdict::Proved(proof) | Verdict::Conditional { proof, .. } => Some(proof.clone()),
        _ => None,
    });
    let counterexample = asked.iter().find_map(|p| match &p.verdict {
        Verdict::Refuted(found) => Some(found.clone()),
        Verdict::Conditional { counterexample, .. } => counterexample.clone(),
        _ => None,
    });
    match proofs.reduce(join) {
        Some(proof) => Verdict::Conditional {
            condition,
            proof,
            counterexample,
        },
        None => Verdict::undecided(format!("samples support it where {condition}")),
    }
}

/// What is said of the parts: once where it is the same on all.
fn told(parts: &[Part]) -> String {
    let detail = |p: &Part| p.verdict.detail().to_owned();
    match parts.first() {
        Some(first) if parts.iter().all(|p| detail(p) == detail(first)) => detail(first),
        _ => {
            let said = parts.iter().map(|p| match &p.verdict {
                Verdict::Undecided { tried } => format!("{}, undecided: {tried}", p.place),
                Verdict::NotApplicable { detail, .. } => {
                    format!("{}, not applicable: {detail}", p.place)
                }
                other => format!("{}: {}", p.place, other.detail()),
            });
            said.collect::<Vec<String>>().join("; ")
        }
    }
}

fn with_detail(mut verdict: Verdict, sentence: String) -> Verdict {
    match &mut verdict {
        Verdict::Proved(proof) | Verdict::Conditional { proof, .. } => proof.detail = sentence,
        Verdict::Numerical(evidence) => evidence.why_no_proof = sentence,
        Verdict::Refuted(found) => found.detail = sentence,
        Verdict::NotApplicable { detail, .. } => *detail = sentence,
        Verdict::Undecided { tried } => *tried = sentence,
    }
    verdict
}

#[cfg(test)]
mod tests {
    use super::super::{Counterexample, Proof};
    use super::*;

    fn part(condition: &str, verdict: Verdict) -> Part {
        Part {
            place: format!("where {condition}"),
            condition: condition.into(),
            verdict,
        }
    }

    fn proved(detail: &str) -> Verdict {
        Verdict::Proved(Proof::exact("everywhere", detail))
    }

    fn refuted() -> Verdict {
        Verdict::Refuted(Counterexample {
            point: vec![],
            quantity: "f".into(),
            residual: ("1".into(), "1".into()),
            detail: "f is 1".into(),
        })
    }

    fn conditional(condition: &str) -> Verdict {
        Verdict::Conditional {
            condition: condition.into(),
            proof: Proof::exact("everywhere", "solved"),
            counterexample: None,
        }
    }

    fn word(a: Verdict, b: Verdict) -> (&'static str, Option<String>) {
        let verdict = Verdict::union(vec![part("x > 0", a), part("x < 0", b)]);
        let condition = match &verdict {
            Verdict::Conditional { condition, .. } => Some(condition.clone()),
            _ => None,
        };
        (verdict.word(), condition)
    }

    #[test]
    fn what_holds_on_all_parts_is_proved_and_what_holds_on_some_is_conditional() {
        let only = |condition: &str| ("conditional", Some(condition.to_owned()));
        assert_eq!(word(proved("a"), proved("a")), ("proved", None));
        assert_eq!(word(proved("a"), refuted()), only("x > 0"));
        assert_eq!(word(refuted(), proved("a")), only("x < 0"));
        assert_eq!(word(refuted(), refuted()), ("refuted", None));
        let condition = "x > 0, or y = 0";
        assert_eq!(word(proved("a"), conditional("y = 0")), only(condition));
        assert_eq!(
            word(conditional("y = 0"), conditional("y = 0")),
            only("y = 0")
        );
        assert_eq!(
            word(conditional("y = 0"), refuted()),
            only("y = 0, with x > 0")
        );
    }

    #[test]
    fn an_open_part_leaves_the_statement_open_unless_another_refutes_it() {
        let open = || Verdict::undecided("work");
        assert_eq!(word(proved("a"), open()).0, "undecided");
        assert_eq!(word(refuted(), open()).0, "refuted");
        assert_eq!(word(conditional("y = 0"), open()).0, "undecided");
    }

    #[test]
    fn a_part_on_which_the_question_has_no_meaning_does_not_count() {
        let none = || Verdict::not_applicable("model.chaplygin", "L depends on y");
        assert_eq!(word(proved("a"), none()).0, "proved");
        assert_eq!(word(none(), refuted()).0, "refuted");
        assert_eq!(word(none(), none()).0, "not-applicable");
    }

    #[test]
    fn the_same_sentence_is_said_once() {
        let union = |a, b| Verdict::union(vec![part("x > 0", proved(a)), part("x < 0", proved(b))]);
        assert_eq!(union("a", "a").detail(), "a");
        assert_eq!(union("a", "b").detail(), "where x > 0: a; where x < 0: b");
    }
}

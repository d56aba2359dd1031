//! The driver of the zero test.

use std::collections::BTreeSet;

use super::assumptions::Assumptions;
use super::branches;
use super::eliminate::{eliminate_all, Eliminated};
use super::evaluate::Parametrization;
use super::exact::{self, Exact};
use super::modular::{self, Finding, Outcome, Plan};
use super::prepare::{prepare, Question};
use super::program::{Generator, Program};
use super::refute::{self, Claim, Search};
use super::straighten::straightened;
use crate::graph::Graph;
use crate::node::{Expr, Symbol};
use crate::verdict::{Evidence, Method, Proof, Verdict};

/// The question: do all residuals vanish where the conditions hold?
#[derive(Clone, Copy, Debug)]
pub struct ZeroTest<'a> {
    /// The expressions claimed to be zero.
    pub residuals: &'a [Expr],
    /// Symbols determined exactly: each is replaced by its expression (which may be a component of a solve and may use
    /// other symbols of this list, without circles).
    pub solved: &'a [(Symbol, Expr)],
    /// Nonlinear constraints `f = 0`, each with the symbol it determines; one that names a symbol for the second time holds besides.
    pub implicit: &'a [(Expr, Symbol)],
    /// Signs and ranges that may be used.
    pub assumptions: &'a Assumptions,
    /// How it is to be decided.
    pub options: Options,
}

/// How a zero test is carried out. The default reaches an error bound of 2^(−100).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Seed of every random choice; stated in the verdict.
    pub seed: u64,
    /// The bound on the probability of error to reach, as its log2.
    pub error_bound_log2: f64,
    /// Turns every circle by a rational rotation of this parameter (numerator, denominator): another parametrization
    /// for a replay (T6 §6.6).
    pub rotation: Option<(i64, i64)>,
    /// At most so many operations are evaluated by the modular proof.
    pub budget: u64,
    /// Should small questions be decided by exact normal forms first? A replay leaves this out.
    pub exact: bool,
    /// Should a counterexample be looked for?
    pub refute: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            seed: 1,
            error_bound_log2: -100.0,
            rotation: None,
            budget: 2_000_000_000,
            exact: true,
            refute: true,
        }
    }
}

impl Options {
    /// For a replay (T6 §6.6): other primes and points than those of `self`, and circles parametrized from another point.
    #[must_use]
    pub fn replay(self) -> Self {
        let seed = self
            .seed
            .wrapping_mul(0x9e37_79b9_7f4a_7c15)
            .wrapping_add(0x5eed);
        let numerator = (seed >> 32 & 0x3ff) as i64 + 1;
        Self {
            seed,
            rotation: Some((numerator, 1031)),
            exact: false,
            ..self
        }
    }
}

impl<'a> ZeroTest<'a> {
    /// The test of residuals everywhere, with no assumptions used.
    pub fn everywhere(residuals: &'a [Expr], assumptions: &'a Assumptions) -> Self {
        Self {
            residuals,
            solved: &[],
            implicit: &[],
            assumptions,
            options: Options::default(),
        }
    }
}

/// Decides whether all residuals are identically zero.
///
/// * `proved` exactly when the difference cancels in canonical form or its normal form is zero (the latter confirmed by the modular
///   test, which is independent of it); otherwise modularly, with the error bound asked for.
/// * `refuted` with a verified counterexample.
/// * `conditional` when a nonlinear constraint factors and the identity holds on some of its components only.
/// * `numerical` when it vanishes at every point evaluated and no proof was possible; `undecided` otherwise.
pub fn decide_zero(graph: &Graph, test: &ZeroTest<'_>) -> Verdict {
    let eliminated = eliminate_all(
        graph,
        test.solved,
        test.residuals,
        test.implicit,
        test.assumptions,
    );
    let Eliminated {
        roots,
        implicit,
        assumptions,
        solved,
    } = match eliminated {
        Ok(eliminated) => eliminated,
        Err(tried) => return Verdict::undecided(tried),
    };
    if roots.iter().all(|&residual| graph.is_zero(residual)) {
        let detail = "the difference cancels in canonical form, by exact rational arithmetic";
        return Verdict::Proved(Proof::exact(place(test, &[]), detail));
    }
    let case = Case {
        graph,
        test,
        residuals: &roots,
        implicit: &implicit,
        assumptions: &assumptions,
        solved: &solved,
    };
    case.decide()
}

/// A question after the elimination of what is solved.
#[derive(Clone, Copy)]
struct Case<'a> {
    graph: &'a Graph,
    test: &'a ZeroTest<'a>,
    residuals: &'a [Expr],
    implicit: &'a [(Expr, Symbol)],
    assumptions: &'a Assumptions,
    solved: &'a [(Symbol, Expr)],
}

impl Case<'_> {
    fn decide(self) -> Verdict {
        // One constraint is easily solved for its symbol; several are, jointly, where they can be.
        let several = self.test.implicit.len() > 1;
        if let Some(proved) = several.then(|| self.decide_straight()).flatten() {
            return proved;
        }
        let stated = self.decide_as_stated();
        match stated {
            Verdict::Undecided { .. } | Verdict::Numerical(_) if !several => {
                self.decide_straight().unwrap_or(stated)
            }
            _ => stated,
        }
    }

    /// Proves the residuals zero as functions of free data on the constraints.
    fn decide_straight(self) -> Option<Verdict> {
        let test = self.test;
        let straight = straightened(
            self.graph,
            test.residuals,
            test.implicit,
            test.solved,
            test.assumptions,
        )?;
        let question = Question {
            outputs: &straight,
            constraints: &[],
            assumptions: self.assumptions,
        };
        let mut program = prepare(self.graph, &question);
        // Conditions are stated in the symbols of the question.
        program.conditions = self.program().conditions;
        let plan = plan_of(&self.test.options, 1, straight.len());
        match modular::decide(&program, &plan) {
            Outcome::Found(finding) if finding.maximum == 0 => {
                let verdict = self.conclude(&program, Outcome::Found(finding));
                matches!(verdict, Verdict::Proved(_)).then_some(verdict)
            }
            _ => None,
        }
    }

    fn program(self) -> Program {
        let question = Question {
            outputs: self.residuals,
            constraints: self.implicit,
            assumptions: self.assumptions,
        };
        prepare(self.graph, &question)
    }

    fn decide_as_stated(self) -> Verdict {
        let program = self.program();
        let plan = plan_of(&self.test.options, 1, self.residuals.len());
        let outcome = modular::decide(&program, &plan);
        let exact = if self.test.options.exact && !is_apart(&program, &outcome) {
            exact::decide(self.graph, self.residuals, self.assumptions)
        } else {
            Exact::Open
        };
        match exact {
            Exact::Zero => self.confirm(&program, outcome),
            Exact::Separated => {
                let detail = "each number is enclosed closer to zero than any number of its degree and size but zero can be";
                Verdict::Proved(Proof::exact(place(self.test, &program.conditions), detail))
            }
            Exact::Undefined => Verdict::undecided(
                "the expression is nowhere defined: a denominator vanishes identically",
            ),
            Exact::Open => self.conclude(&program, outcome),
        }
    }

    /// The normal form is zero: does the modular test agree?
    fn confirm(self, program: &Program, outcome: Outcome) -> Verdict {
        let agrees = match &outcome {
            Outcome::Found(finding) if finding.maximum == 0 => {
                format!(
                    ", confirmed at {} random points of prime fields",
                    finding.samples
                )
            }
            // The modular test may know fewer relations than the normal form; only a counterexample contradicts.
            Outcome::Found(_) => match self.conclude(program, outcome) {
                Verdict::Refuted(counterexample) => {
                    return Verdict::undecided(format!(
                        "the normal form is zero, but {}: two methods disagree",
                        counterexample.detail
                    ))
                }
                _ => String::new(),
            },
            _ => String::new(),
        };
        let detail = format!("the normal form over the field of its generators is zero{agrees}");
        Verdict::Proved(Proof::exact(place(self.test, &program.conditions), detail))
    }

    fn conclude(self, program: &Program, outcome: Outcome) -> Verdict {
        let finding = match outcome {
            Outcome::Found(finding) => finding,
            Outcome::Nowhere { samples } => {
                return Verdict::undecided(format!(
                    "the expression is nowhere defined: a denominator vanished at each of {samples} random points"
                ))
            }
            Outcome::Empty { samples } => {
                return Verdict::undecided(format!(
                    "the constraints have no solution over any of {samples} random points"
                ))
            }
            Outcome::Open { why } => return self.search(&why),
        };
        match (finding.minimum, finding.maximum, finding.error_bound_log2) {
            (0, 0, Some(bound)) => {
                Verdict::Proved(modular_proof(self.test, program, &finding, bound))
            }
            (0, 0, None) => self.search(&finding.why_no_bound),
            (0, _, _) => self.on_branches(&finding),
            _ => self.search(&not_zero(program)),
        }
    }

    fn on_branches(self, finding: &Finding) -> Verdict {
        if self.implicit.is_empty() {
            let count = finding.suspects;
            return self.search(&format!(
                "zero for some signs of {count} dependent radicals and not for others"
            ));
        }
        let test = ZeroTest {
            residuals: self.residuals,
            solved: &[],
            implicit: self.implicit,
            assumptions: self.assumptions,
            options: self.test.options,
        };
        if let Some(verdict) = branches::by_factors(self.graph, &test) {
            return verdict;
        }
        let vanishing = finding.parts.get(&0).copied().unwrap_or(0);
        let all: usize = finding.parts.values().sum();
        self.search(&format!(
            "zero for {vanishing} of {all} solutions over a point only, which belong to components of the constraints, or to signs of roots that no real state has"
        ))
    }

    fn search(self, why: &str) -> Verdict {
        if !self.test.options.refute {
            return Verdict::undecided(why);
        }
        // A point is enclosed by as many equations as it has unknowns; that others hold there would have to be proved.
        let symbols: BTreeSet<Symbol> = self.implicit.iter().map(|(_, s)| *s).collect();
        if symbols.len() < self.implicit.len() {
            return Verdict::undecided(why);
        }
        let claim = Claim {
            residuals: self.residuals,
            constraints: self.implicit,
            solved: self.solved,
            assumptions: self.assumptions,
        };
        let seed = self.test.options.seed;
        match refute::search(self.graph, &claim, seed) {
            Search::Found(counterexample) => Verdict::Refuted(*counterexample),
            Search::Vanishing {
                points,
                largest,
                bits,
            } => Verdict::Numerical(Evidence {
                samples: points,
                region: "small rational data".to_owned(),
                digits: (bits as f64 * std::f64::consts::LOG10_2) as u32,
                residual: largest,
                seed: Some(seed),
                why_no_proof: why.to_owned(),
            }),
            Search::NoPoint => Verdict::undecided(format!(
                "{why}; no point was found at which all is defined and the assumptions hold"
            )),
        }
    }
}

/// Whether no normal form can be zero: something is not zero at a point, and is built of symbols by arithmetic alone.
fn is_apart(program: &Program, outcome: &Outcome) -> bool {
    let is_symbol = |own: &Generator| matches!(own, Generator::Symbol(_));
    let is_rational =
        program.circles == 0 && program.radicals == 0 && program.generators.iter().all(is_symbol);
    is_rational && matches!(outcome, Outcome::Found(finding) if finding.minimum > 0)
}

pub(super) fn plan_of(options: &Options, rows: usize, columns: usize) -> Plan {
    Plan {
        seed: options.seed,
        error_bound_log2: options.error_bound_log2,
        parametrization: Parametrization {
            rotation: options.rotation,
        },
        budget: options.budget,
        rows,
        columns,
    }
}

fn modular_proof(test: &ZeroTest<'_>, program: &Program, finding: &Finding, bound: f64) -> Proof {
    let samples = finding.samples;
    let cut = match finding.cuts {
        0 => String::new(),
        n => format!(", {n} large subexpressions taken as free"),
    };
    let points = if samples == 1 { "point" } else { "points" };
    Proof {
        method: Method::Modular,
        on: if finding.are_regular {
format!(
                "{} and the constraints determine the symbols that they are solved for",
                place(test, &program.conditions)
            )
} else {
place(test, &program.conditions)
},
        error_bound_log2: Some(bound),
        samples,
        seed: Some(test.options.seed),
        detail: format!("zero at {samples} random {points} of prime fields of 62 bits{cut}; wrong with probability below 2^{bound:.0}"),
    }
}

/// Where the statement holds.
fn place(test: &ZeroTest<'_>, conditions: &[String]) -> String {
    let mut place = match (test.solved.is_empty(), test.implicit.is_empty()) {
        (true, true) => "wherever both sides are defined".to_owned(),
        (false, true) => "on the constraint manifold, wherever both sides are defined".to_owned(),
        (_, false) => {
            "on every component of the constraint manifold, wherever both sides are defined"
                .to_owned()
        }
    };
    if !conditions.is_empty() {
        place.push_str(", that is ");
        place.push_str(&conditions.join(" and "));
    }
    place
}

/// That a normal form is not zero, with what was taken to be independent in it.
fn not_zero(program: &Program) -> String {
    let kinds = generators(program);
    if kinds.is_empty() {
        return "it is not zero by exact arithmetic".to_owned();
    }
    format!("it does not cancel where {kinds} are taken to be independent")
}

/// The kinds of generators, for people.
fn generators(program: &Program) -> String {
    let mut kinds: Vec<&str> = program
        .generators
        .iter()
        .map(|generator| match generator {
            Generator::Symbol(_) => "symbols",
            Generator::Dependent(_) => "dependent symbols",
            Generator::Transcendental { text, .. } => text.as_str(),
        })
        .collect();
    if program.circles > 0 {
        kinds.push("angles");
    }
    if program.radicals > 0 {
        kinds.push("radicals");
    }
    kinds.sort_unstable();
    kinds.dedup();
    kinds.join(", ")
}

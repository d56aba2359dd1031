//! Ranks of matrices: over a ring at a point, and the generic rank as a public question.

use super::assumptions::Assumptions;
use super::decide::{plan_of, Options};
use super::eliminate::{eliminate_all, Eliminated};
use super::modular::{self, Finding, Outcome};
use super::prepare::{prepare, Question};
use super::ring::Ring;
use crate::graph::Graph;
use crate::meter;
use crate::node::{Expr, Symbol};
use crate::number::ball::Precision;
use crate::verdict::{Method, Proof, Verdict};

/// Rows and columns of a largest minor that is not zero; as many of each as the rank.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pivots {
    /// Rows, taken from the top: a row is left out when it depends on those above it.
    pub rows: Vec<usize>,
    /// The column of the pivot of each of these rows.
    pub columns: Vec<usize>,
}

/// The rank of a row-major matrix by elimination with unit pivots; `None` when only zero divisors are left in a row.
pub(super) fn rank_over<R: Ring>(
    ring: &R,
    rows: usize,
    columns: usize,
    entries: &[R::Element],
) -> Option<Pivots> {
    let minus_one = ring.field().neg(ring.field().one());
    let mut pivots = Pivots::default();
    let mut reduced: Vec<Vec<R::Element>> = Vec::new();
    for row in 0..rows {
        let mut current: Vec<R::Element> =
            entries.get(row * columns..(row + 1) * columns)?.to_vec();
        for (pivot_row, &column) in reduced.iter().zip(&pivots.columns) {
            let factor = current[column].clone();
            if ring.is_zero(&factor) {
                continue;
            }
            meter::spend(columns as u64);
            for (entry, pivot_entry) in current.iter_mut().zip(pivot_row) {
                let product = ring.mul(&factor, pivot_entry);
                ring.add_scaled(entry, &product, minus_one);
            }
        }
        if current.iter().all(|entry| ring.is_zero(entry)) {
            continue;
        }
        let (column, reciprocal) = current
            .iter()
            .enumerate()
            .find_map(|(column, entry)| Some((column, ring.invert(entry)?)))?;
        let normalized = current
            .iter()
            .map(|entry| ring.mul(entry, &reciprocal))
            .collect();
        reduced.push(normalized);
        pivots.rows.push(row);
        pivots.columns.push(column);
        if pivots.rows.len() == columns {
            break;
        }
    }
    Some(pivots)
}

/// The question for the generic rank of a matrix of expressions.
#[derive(Clone, Copy, Debug)]
pub struct RankTest<'a> {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// Row-major entries, `rows · columns` of them.
    pub entries: &'a [Expr],
    /// Symbols determined exactly; see [`ZeroTest::solved`](super::ZeroTest::solved).
    pub solved: &'a [(Symbol, Expr)],
    /// Nonlinear constraints, each with the symbol it determines.
    pub implicit: &'a [(Expr, Symbol)],
    /// Signs and ranges that may be used.
    pub assumptions: &'a Assumptions,
    /// How it is to be decided.
    pub options: Options,
}

/// The rank of a matrix at generic points.
#[derive(Clone, Debug)]
pub struct GenericRank {
    /// The smallest generic rank over the components of the constraints.
    pub minimum: usize,
    /// The largest. Equal to `minimum` unless the constraints have components of different rank.
    pub maximum: usize,
    /// Independent rows and columns, as many as `maximum`.
    pub pivots: Pivots,
    /// The rank is at least `minimum` outside of a thin set: a minor is not zero.
    pub at_least: Verdict,
    /// The rank is at most `maximum` everywhere.
    pub at_most: Verdict,
}

/// Finds the generic rank of a matrix on the constraints.
///
/// A minor that is not zero at a point proves the lower bound; the upper bound is modular, with its error bound stated.
///
/// # Errors
/// [`Verdict::Undecided`] when no point could be used, or when the matrix is nowhere defined.
pub fn generic_rank(graph: &Graph, test: &RankTest<'_>) -> Result<GenericRank, Box<Verdict>> {
    let undecided = |tried: String| Box::new(Verdict::undecided(tried));
    if test.entries.len() != test.rows * test.columns {
        return Err(undecided(
            "the matrix does not have rows times columns entries".to_owned(),
        ));
    }
    let eliminated = eliminate_all(
        graph,
        test.solved,
        test.entries,
        test.implicit,
        test.assumptions,
    );
    let Eliminated {
        roots: entries,
        implicit,
        assumptions,
        ..
    } = eliminated.map_err(undecided)?;
    let question = Question {
        outputs: &entries,
        constraints: &implicit,
        assumptions: &assumptions,
    };
    let program = prepare(graph, &question);
    let plan = plan_of(&test.options, test.rows, test.columns);
    let finding = match modular::decide(&program, &plan) {
        Outcome::Found(finding) => finding,
        Outcome::Nowhere { .. } => {
            return Err(undecided("the matrix is nowhere defined".to_owned()))
        }
        Outcome::Empty { .. } => {
            return Err(undecided("the constraints have no solutions".to_owned()))
        }
        Outcome::Open { why } => return Err(undecided(why)),
    };
    let certain =
        program.faithful || is_regular_at_a_point(graph, test, &entries, &assumptions, &finding);
    Ok(GenericRank {
        minimum: finding.minimum,
        maximum: finding.maximum,
        pivots: finding.pivots.clone(),
        at_least: at_least(&finding, certain),
        at_most: at_most(test, &finding),
    })
}

/// The determinant of a square matrix is not identically zero on any component of the constraints.
///
/// `proved` by a point where it is not zero; `refuted` is never said here, because that is a statement about all points:
/// where the determinant vanishes identically (on some component) the verdict is `undecided` with the rank in it,
/// and [`generic_rank`] has the proof.
pub fn generic_determinant_nonzero(graph: &Graph, test: &RankTest<'_>) -> Verdict {
    match generic_rank(graph, test) {
        Ok(rank) if rank.minimum == test.rows && test.rows == test.columns => rank.at_least,
        Ok(rank) => Verdict::undecided(format!("the rank is {} of {}", rank.minimum, test.rows)),
        Err(verdict) => *verdict,
    }
}

fn at_least(finding: &Finding, certain: bool) -> Verdict {
    let rank = finding.minimum;
    if rank == 0 {
        return Verdict::Proved(Proof::structural("everywhere", "no rank is below zero"));
    }
    if !certain {
        return Verdict::undecided(format!(
            "a minor of size {rank} is not zero in the field of its generators, whose independence is not known"
        ));
    }
    Verdict::Proved(Proof {
        samples: finding.samples,
        ..Proof::exact(
            "outside of the zeros of a minor that does not vanish identically",
            format!(
                "a minor of size {rank} is not zero at a point of a prime field, hence not zero"
            ),
        )
    })
}

fn at_most(test: &RankTest<'_>, finding: &Finding) -> Verdict {
    let rank = finding.maximum;
    if rank == test.rows.min(test.columns) {
        return Verdict::Proved(Proof::structural(
            "everywhere",
            "no rank exceeds the size of the matrix",
        ));
    }
    let Some(bound) = finding.error_bound_log2 else {
        return Verdict::undecided(finding.why_no_bound.clone());
    };
    Verdict::Proved(Proof {
        method: Method::Modular,
        on: if finding.are_regular {
"wherever the matrix is defined and the constraints determine the symbols that they are solved for"
} else {
"wherever the matrix is defined"
}
        .to_owned(),
        error_bound_log2: Some(bound),
        samples: finding.samples,
        seed: Some(test.options.seed),
        detail: format!(
            "rank {rank} at {} random points of prime fields of 62 bits; larger with probability below 2^{bound:.0}",
            finding.samples
        ),
    })
}

/// Is the minor of the pivots regular at some point with rational data, by a verified solve?
fn is_regular_at_a_point(
    graph: &Graph,
    test: &RankTest<'_>,
    entries: &[Expr],
    assumptions: &Assumptions,
    finding: &Finding,
) -> bool {
    if !test.implicit.is_empty() || finding.minimum != finding.maximum {
        return false;
    }
    let Pivots { rows, columns } = &finding.pivots;
    let minor: Vec<Expr> = rows
        .iter()
        .flat_map(|row| {
            columns
                .iter()
                .map(move |column| entries[row * test.columns + column])
        })
        .collect();
    let precision = Precision::new(192);
    super::refute::is_regular_somewhere(graph, &minor, assumptions, &precision, test.options.seed)
}

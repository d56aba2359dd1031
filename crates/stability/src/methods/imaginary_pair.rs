//! One pair on the imaginary axis, all other eigenvalues left of it: Lyapunov's second critical case (Lyapunov 1892, §§ 33–41; Malkin 1952).
//!
//! By Orlando's formula that is so where Hurwitz's determinants are positive but the last but one, which is zero (Liu 1994). On the centre manifold
//! `w' = iω w + c₁ w |w|² + …`, and the real part of c₁, whose sign is that of the first Lyapunov coefficient, decides (Kuznetsov 2004, § 5.4). Zeros
//! of a family of steady motions are taken out by integrals: on their levels the pair is alone, and c₁ is that of the level. A
//! family of one dimension without an integral has `w' = (iω + α y) w + …`, `y' = e |w|² + …`: where α e is positive motions leave, where
//! it is negative they go from one member of the family to another near by (Fiedler, Liebscher, Alexander 2000, J. Differential Equations 167).
//! All numbers are enclosed.

use crate::about::About;
use crate::hurwitz::{determinants, Boundary, Crossing};
use crate::integrals::Jet;
use crate::isolation::Root;
use crate::levels::Levels;
use crate::lines::{Lines, Vector};
use crate::question::Place;
use crate::real_roots::ball;
use crate::steady::{closed, kernel};
use crate::theorem::{Answer, Instability, Method};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::number::ball::solve;
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::{Expr, Graph, Symbol};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// A pair is on the axis, beside the zeros of a family.
pub(crate) struct ImaginaryPair;

impl Method for ImaginaryPair {
    fn answer(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Answer {
        // What is enclosed at one value of a parameter says nothing of an interval.
        let is_asked = matches!(place, Place::OnAxis | Place::NotLeft) && at.is_none();
        if !is_asked || about.question.over.is_some() {
            return Answer::NotApplicable;
        }
        let last = last_but_one(about);
        let sign = last.and_then(|e| about.question.sign(about.graph(), e, None));
        if sign != Some(Ordering::Equal) {
            return Answer::NotApplicable;
        }
        answer(about, None)
    }

    fn at_boundary(&self, about: &About<'_>, boundary: &Boundary) -> Answer {
        match about.question.over {
            Some(symbol) if boundary.crossing == Crossing::Pair => {
                let root = refined(about, symbol, &boundary.root);
                answer(about, Some((symbol, &root)))
            }
            _ => Answer::NotApplicable,
        }
    }
}

/// The last but one of Hurwitz's determinants of the characteristic polynomial.
fn last_but_one(about: &About<'_>) -> Option<Expr> {
    let polynomial = about.question.polynomial.as_ref()?;
    let list = determinants(about.graph(), &polynomial.coefficients);
    list.len().checked_sub(2).map(|at| list[at])
}

/// Halvings of the enclosure of a boundary.
const HALVINGS: usize = 160;

/// A narrower enclosure of a boundary, since what is computed from it is a difference of large numbers: between signs of the last but one of
/// Hurwitz's determinants that differ.
fn refined(about: &About<'_>, symbol: Symbol, root: &Root) -> Root {
    let (g, precision) = (about.graph(), Precision::new(2 * BITS));
    let mut found = root.clone();
    let Some(own) = last_but_one(about) else {
        return found;
    };
    let sign = |at: &RBig| {
        let value = |s: Symbol| (s == symbol).then(|| precision.rational(at));
        let ball = g.enclose(&[own], &precision, &value).ok()?.pop()?;
        ball.sign()
    };
    let (low, high) = (sign(&found.low), sign(&found.high));
    if low.is_none() || high.is_none() || low == high {
        return found;
    }
    for _ in 0..HALVINGS {
        let middle = (&found.low + &found.high) / RBig::from(2);
        match sign(&middle) {
            Some(Ordering::Equal) | None => break,
            own if own == low => found.low = middle,
            Some(_) => found.high = middle,
        }
    }
    found
}

/// What decides, enclosed.
enum Deciding {
    /// Re c₁ on the levels of these integrals.
    Levels(Ball, String),
    /// α e.
    Family(Ball),
}

fn answer(about: &About<'_>, at: Option<(Symbol, &Root)>) -> Answer {
    let Some(found) = deciding(about, at) else {
        return Answer::NotApplicable;
    };
    let others = match about.question.linear.family {
        0 => "all others",
        _ => "all others but the zeros of the family",
    };
    let pair =
        format!("a pair of eigenvalues is on the imaginary axis and {others} lie left of it");
    let (ball, quantity, stable, unstable) = match &found {
        Deciding::Levels(ball, levels) => (
            ball,
            "the real part of c in w' = i omega w + c w |w|^2 on the centre manifold",
            format!("by Lyapunov's theorem on a pair of imaginary eigenvalues: {pair}, and the first Lyapunov coefficient{levels} is negative"),
            format!("by Lyapunov's theorem on a pair of imaginary eigenvalues: {pair}, and the first Lyapunov coefficient{levels} is positive: the motion is unstable"),
        ),
        Deciding::Family(ball) => (
            ball,
            "the product of the growth of the pair along the family and of the drift along the family by the square of the amplitude",
            format!("by the theorem of Fiedler, Liebscher and Alexander: {pair}, and oscillations drift to where they die away"),
            format!("by the theorem of Fiedler, Liebscher and Alexander: {pair}, and oscillations drift to where they grow: the motion is unstable"),
        ),
    };
    match ball.sign() {
        Some(Ordering::Less) => Answer::Stable(stable),
        Some(Ordering::Greater) => Answer::Unstable(Instability {
            quantity: quantity.into(),
            bounds: ball.to_decimal_interval(20),
            why: unstable,
        }),
        Some(Ordering::Equal) | None => Answer::Open(format!(
            "{pair}, and the first Lyapunov coefficient may be zero"
        )),
    }
}

/// Bits of the enclosures.
const BITS: usize = 384;

fn deciding(about: &About<'_>, at: Option<(Symbol, &Root)>) -> Option<Deciding> {
    let (g, own, question) = (about.graph(), &about.expansion, &about.question);
    if !own.own.characteristics.manifold.implicit.is_empty() || !own.is_smooth() {
        return None;
    }
    let precision = Precision::new(BITS);
    let over = at.map(|(symbol, root)| (symbol, ball(&root.low, &root.high)));
    let numbers = Numbers {
        g,
        precision: &precision,
        over,
    };
    let coefficients = &question.polynomial.as_ref()?.coefficients;
    let frequency = numbers.frequency(coefficients)?;
    let lines = Lines::new(own, &precision, numbers.over.clone())?;
    let slopes = lines.slopes()?;
    let pair = Pair::of(&precision, &slopes, &frequency)?;
    let (zeros, finite) = (question.zeros(), own.reduction().dependent.len());
    let levels = Levels::of(own, about.integrals());
    let levels = if levels.jets.len() < zeros + finite && finite == 0 {
        Levels::of(own, &[about.integrals(), about.transported()].concat())
    } else {
        levels
    };
    if levels.jets.len() == zeros + finite {
        let c = pair.on_levels(&numbers, &lines, &levels.jets)?;
        return Some(Deciding::Levels(c, levels.text()));
    }
    if zeros == 1 && question.linear.family == 1 && levels.jets.len() == finite {
        let found = pair.along_family(about, &numbers, &lines)?;
        return Some(Deciding::Family(found));
    }
    None
}

/// Expressions in numbers.
struct Numbers<'a> {
    g: &'a Graph,
    precision: &'a Precision,
    over: Option<(Symbol, Ball)>,
}

impl Numbers<'_> {
    fn of(&self, es: &[Expr]) -> Option<Vec<Ball>> {
        let value = |s: Symbol| {
            let own = self.over.as_ref().filter(|(symbol, _)| *symbol == s);
            own.map(|(_, ball)| ball.clone())
        };
        self.g.enclose(es, self.precision, &value).ok()
    }

    /// ω, where one pair is on the axis and all other zeros lie left of it; that the last but one determinant is zero is known.
    fn frequency(&self, coefficients: &[Expr]) -> Option<Ball> {
        let list = determinants(self.g, coefficients);
        let others = list.len().checked_sub(2)?;
        let mut positive = list[..others].to_vec();
        positive.extend([*coefficients.first()?, *coefficients.last()?]);
        let signs = self.of(&positive)?;
        let is_positive = |ball: &Ball| ball.sign() == Some(Ordering::Greater);
        if !signs.iter().all(is_positive) {
            return None;
        }
        let [constant, slope] = common_factor(self.g, coefficients)?;
        let found = self.of(&[constant, slope])?;
        self.precision
            .sqrt(&self.precision.div(&found[0], &found[1]).ok()?)
            .ok()
    }
}

/// The greatest common divisor `b + a μ` of the even and the odd part of a polynomial, in `μ = λ²`, where it is of degree one: by the first
/// subresultant.
fn common_factor(g: &Graph, coefficients: &[Expr]) -> Option<[Expr; 2]> {
    let even: Vec<Expr> = coefficients.iter().step_by(2).copied().collect();
    let odd: Vec<Expr> = coefficients.iter().skip(1).step_by(2).copied().collect();
    match (even.as_slice(), odd.as_slice()) {
        (&[b, a], _) | (_, &[b, a]) => return Some([b, a]),
        ([_], _) | (_, [_] | []) => return None,
        _ => {}
    }
    let (e, o) = (even.len() - 1, odd.len() - 1);
    let rows = e + o - 2;
    // Coefficients descending, the leading one first.
    let row = |own: &[Expr], shift: usize| -> Vec<Expr> {
        let zeros = std::iter::repeat_n(g.zero(), shift);
        let all = zeros.chain(own.iter().rev().copied());
        let mut all: Vec<Expr> = all.collect();
        all.resize(e + o, g.zero());
        all
    };
    let mut matrix: Vec<Vec<Expr>> = (0..o - 1).map(|shift| row(&even, shift)).collect();
    matrix.extend((0..e - 1).map(|shift| row(&odd, shift)));
    let minor = |last: usize| {
        let columns = (0..rows - 1).chain([last]);
        let columns: Vec<usize> = columns.collect();
        let of = |row: &Vec<Expr>| columns.iter().map(|&c| row[c]).collect();
        let own: Vec<Vec<Expr>> = matrix.iter().map(of).collect();
        closed(g, determinant(g, &own))
    };
    Some([minor(rows), minor(rows - 1)])
}

/// Eigenvectors of the pair: `A q = iω q`, `Aᵀ p = −iω p`.
struct Pair<'a> {
    precision: &'a Precision,
    slopes: &'a [Vec<Ball>],
    frequency: Ball,
    right: Vector,
    left: Vector,
}

impl<'a> Pair<'a> {
    fn of(precision: &'a Precision, slopes: &'a [Vec<Ball>], frequency: &Ball) -> Option<Pair<'a>> {
        let n = slopes.len();
        let transposed: Vec<Vec<Ball>> = (0..n)
            .map(|r| (0..n).map(|c| slopes[c][r].clone()).collect())
            .collect();
        let mut found = None;
        // One component is 1, and one equation follows from the others: those for which the rest is regular.
        'places: for column in 0..n {
            for row in 0..n {
                let right = null_vector(precision, slopes, frequency, (row, column));
                let left = null_vector(precision, &transposed, &frequency.neg(), (column, row));
                if let Some(pair) = right.zip(left) {
                    found = Some(pair);
                    break 'places;
                }
            }
        }
        let (right, left) = found?;
        Some(Pair {
            precision,
            slopes,
            frequency: frequency.clone(),
            right,
            left,
        })
    }

    /// `⟨p, v⟩/⟨p, q⟩`, the real part.
    fn projected(&self, v: &Vector) -> Option<Ball> {
        let p = self.precision;
        let (above, below) = (self.left.product(p, v)?, self.left.product(p, &self.right)?);
        let sum = |a: (&Ball, &Ball), b: (&Ball, &Ball)| {
            p.add(&p.mul(a.0, a.1).ok()?, &p.mul(b.0, b.1).ok()?).ok()
        };
        let size = sum((&below.0, &below.0), (&below.1, &below.1))?;
        p.div(&sum((&above.0, &below.0), (&above.1, &below.1))?, &size)
            .ok()
    }

    /// Re c₁ with `2 c₁ = ⟨p, C(q, q, q̄) + 2 B(q, h₁₁) + B(q̄, h₂₀)⟩`, where `A h₁₁ = −B(q, q̄)` on the levels and `(2iω − A) h₂₀ = B(q, q)`.
    fn on_levels(&self, numbers: &Numbers<'_>, lines: &Lines<'_>, jets: &[Jet]) -> Option<Ball> {
        let p = self.precision;
        let q = &self.right;
        let conjugate = q.conjugate();
        let constant = self.constant(numbers, jets, &lines.second(q, &conjugate)?)?;
        let doubled = self.doubled(&lines.second(q, q)?)?;
        let cubic = lines.third(q)?;
        let twice = lines.second(q, &constant)?;
        let all = cubic.plus(p, &twice)?.plus(p, &twice)?;
        let all = all.plus(p, &lines.second(&conjugate, &doubled)?)?;
        Some(self.projected(&all)?.shift(-1))
    }

    /// h₁₁, by the regular matrix `A + Gᵀ G`, G the gradients of the integrals, in whose levels h₁₁ bends: `G h₁₁ = −F''(q, q̄)`.
    fn constant(&self, numbers: &Numbers<'_>, jets: &[Jet], second: &Vector) -> Option<Vector> {
        let p = self.precision;
        let n = self.slopes.len();
        let mut matrix: Vec<Ball> = self.slopes.concat();
        let mut right: Vec<Ball> = second.re.iter().map(Ball::neg).collect();
        for jet in jets {
            let gradient = numbers.of(&jet.gradient)?;
            let hessian = numbers.of(&jet.hessian.concat())?;
            let mut bend = Ball::zero();
            for part in [&self.right.re, &self.right.im] {
                for r in 0..n {
                    for c in 0..n {
                        let product = p
                            .mul(&p.mul(&part[r], &hessian[r * n + c]).ok()?, &part[c])
                            .ok()?;
                        bend = p.add(&bend, &product).ok()?;
                    }
                }
            }
            for r in 0..n {
                for c in 0..n {
                    let product = p.mul(&gradient[r], &gradient[c]).ok()?;
                    matrix[r * n + c] = p.add(&matrix[r * n + c], &product).ok()?;
                }
                right[r] = p.sub(&right[r], &p.mul(&gradient[r], &bend).ok()?).ok()?;
            }
        }
        let re = solve(p, n, matrix, &[right]).ok()?.pop()?;
        Some(Vector {
            im: vec![Ball::zero(); n],
            re,
        })
    }

    /// h₂₀.
    fn doubled(&self, second: &Vector) -> Option<Vector> {
        let n = self.slopes.len();
        let negative = |row: &Vec<Ball>| row.iter().map(Ball::neg).collect();
        let matrix: Vec<Vec<Ball>> = self.slopes.iter().map(negative).collect();
        let all: Vec<usize> = (0..n).collect();
        shifted_solution(
            self.precision,
            &matrix,
            &self.frequency.shift(1),
            (&all, &all),
            second,
        )
    }

    /// α e: `α = Re ⟨p, B(q, n)⟩` along the tangent n of the family, `e = P B(q, q̄)` with the left null vector P, `P n = 1`.
    fn along_family(
        &self,
        about: &About<'_>,
        numbers: &Numbers<'_>,
        lines: &Lines<'_>,
    ) -> Option<Ball> {
        let (g, own) = (about.graph(), &about.expansion);
        let p = self.precision;
        let slopes = own.slopes();
        let n = slopes.len();
        let finite = own.finite_equations().into_iter().map(|(_, row)| row);
        let matrix: Vec<Vec<Expr>> = slopes.iter().cloned().chain(finite).collect();
        let (tangents, divisors) = kernel(g, &matrix, n);
        let [tangent] = tangents.as_slice() else {
            return None;
        };
        let transposed: Vec<Vec<Expr>> = (0..n)
            .map(|c| slopes.iter().map(|row| row[c]).collect())
            .collect();
        let (left, further) = kernel(g, &transposed, n);
        let masses = own.masses();
        let of_rates = |w: &Vec<Expr>| -> Vec<Expr> {
            let column = |c: usize| {
                let terms = w.iter().zip(&masses).map(|(&w, row)| g.mul(&[w, row[c]]));
                closed(g, g.add(&terms.collect::<Vec<_>>()))
            };
            (0..n).map(column).collect()
        };
        let product = |a: &[Expr], b: &[Expr]| {
            let terms = a.iter().zip(b).map(|(&a, &b)| g.mul(&[a, b]));
            closed(g, g.add(&terms.collect::<Vec<_>>()))
        };
        let lefts = left.iter().map(of_rates);
        let mut lefts = lefts.map(|own| (product(&own, tangent), own));
        let (size, left) = lefts.find(|(size, _)| !g.is_zero(*size))?;
        let divisors = numbers.of(&[divisors, further, vec![size]].concat())?;
        if !divisors.iter().all(Ball::excludes_zero) {
            return None;
        }
        let size = divisors.last()?;
        let tangent = Vector {
            re: numbers.of(tangent)?,
            im: vec![Ball::zero(); n],
        };
        let growth = self.projected(&lines.second(&self.right, &tangent)?)?;
        let drift = lines.second(&self.right, &self.right.conjugate())?;
        let mut along = Ball::zero();
        for (a, b) in numbers.of(&left)?.iter().zip(&drift.re) {
            along = p.add(&along, &p.mul(a, b).ok()?).ok()?;
        }
        p.mul(&growth, &p.div(&along, size).ok()?).ok()
    }
}

/// x with `(A − iω) x = 0` and one component 1; one equation is left out.
fn null_vector(
    precision: &Precision,
    matrix: &[Vec<Ball>],
    frequency: &Ball,
    (row, column): (usize, usize),
) -> Option<Vector> {
    let n = matrix.len();
    let rows: Vec<usize> = (0..n).filter(|&r| r != row).collect();
    let columns: Vec<usize> = (0..n).filter(|&c| c != column).collect();
    let re = (0..n).map(|r| matrix[r][column].neg()).collect();
    let mut im = vec![Ball::zero(); n];
    im[column] = frequency.clone();
    let right = Vector { re, im };
    let found = shifted_solution(
        precision,
        matrix,
        &frequency.neg(),
        (&rows, &columns),
        &right,
    )?;
    let mut whole = Vector {
        re: vec![Ball::zero(); n],
        im: vec![Ball::zero(); n],
    };
    whole.re[column] = Ball::integer(1);
    for (at, &c) in columns.iter().enumerate() {
        whole.re[c] = found.re[at].clone();
        whole.im[c] = found.im[at].clone();
    }
    Some(whole)
}

/// x with `(A + iσ) x = b` in these rows and columns, as a real system of twice the size.
fn shifted_solution(
    precision: &Precision,
    matrix: &[Vec<Ball>],
    shift: &Ball,
    (rows, columns): (&[usize], &[usize]),
    right: &Vector,
) -> Option<Vector> {
    let m = rows.len();
    let mut whole = vec![Ball::zero(); 4 * m * m];
    for (r, &row) in rows.iter().enumerate() {
        for (c, &column) in columns.iter().enumerate() {
            whole[r * 2 * m + c] = matrix[row][column].clone();
            whole[(m + r) * 2 * m + m + c] = matrix[row][column].clone();
            if row == column {
                whole[r * 2 * m + m + c] = shift.neg();
                whole[(m + r) * 2 * m + c] = shift.clone();
            }
        }
    }
    let of = |part: &[Ball]| -> Vec<Ball> { rows.iter().map(|&r| part[r].clone()).collect() };
    let right = [of(&right.re), of(&right.im)].concat();
    let mut re = solve(precision, 2 * m, whole, &[right]).ok()?.pop()?;
    let im = re.split_off(m);
    Some(Vector { re, im })
}

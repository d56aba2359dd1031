//! Continuation of solutions of `F(x, p) = 0` in the parameter p by pseudo-arclength (Keller 1977; Allgower and Georg 1990).
//!
//! The equations may have a family of solutions at every p by structure, and more equations than independent ones, as finite constraints and
//! integrals make them. The family is cut by the plane through the start that is orthogonal to it, and what is left is solved by Gauss and
//! Newton's method; so the curve that is followed is transversal to the family, and no eigenvalue zero of it hides a bifurcation.

use crate::branch::{scaled, Branch, End, Equations, Kind, Point, Special};
use crate::error::OrbitError;
use crate::hopf::WithoutLyapunov;
use crate::solution::{aside, is_done, is_solved, ordinary, scale, unscaled};
use crate::subspace::{decomposed, kernel, least_squares};
use chetaev_symbolic::meter::spend;
use nalgebra::{Complex, DMatrix, DVector};

/// Steps to the next point.
const STEPS: usize = 20;
/// Work that an evaluation of the equations counts as; somebody may stop it there.
const EVALUATION: u64 = 5_000;
/// Lengths of steps along the curve, in units of the range and of the size of the unknowns.
const FIRST: f64 = 0.02;
const SHORTEST: f64 = 1e-7;

/// How far, and how finely, a curve is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// At most so many points on each side of the start.
    pub points: usize,
    /// The longest step along the curve, in units of the range and of the size of the unknowns.
    pub step: f64,
}

impl Default for Pace {
    fn default() -> Pace {
        Pace {
            points: 500,
            step: 0.05,
        }
    }
}

/// The curve of solutions through one near a guess, over a range of the parameter.
///
/// # Errors
/// [`OrbitError`] where there is no solution near the guess.
pub fn follow(
    equations: &mut dyn Equations,
    (guess, p): (&[f64], f64),
    range: (f64, f64),
    pace: Pace,
) -> Result<Branch, OrbitError> {
    let p = p.clamp(range.0, range.1);
    let (mut start, family) = ordinary(equations, (guess, p), range)?;
    let (x, p) = (&start.unknowns, start.parameter);
    equations.begin(x, p, &aside(p, range))?;
    start.spectrum = equations.spectrum(x, p, family)?;
    let mut walk = Walk::new(equations, &start, family, range)?;
    let mut ends = [End::Range; 2];
    let (mut all, mut special) = (Vec::new(), Vec::new());
    for (side, end) in ends.iter_mut().enumerate() {
        let mut own = Vec::new();
        let mut happened = Vec::new();
        *end = walk.walk(&start, side == 1, pace, (&mut own, &mut happened))?;
        if side == 0 {
            own.reverse();
            happened.reverse();
            own.push(start.clone());
        }
        all.extend(own);
        special.extend(happened);
        if *end == End::Closed {
            all.insert(0, start.clone());
            ends = [End::Closed; 2];
            break;
        }
    }
    for own in special.iter_mut().map(|own| &mut own.point).chain(&mut all) {
        own.spectrum = std::mem::take(&mut own.spectrum).completed();
    }
    Ok(Branch {
        points: all,
        special,
        family,
        ends,
    })
}

/// Points that are nearer to each other, in parts of their size, are one.
const SAME: f64 = 1e-8;
/// A test that falls to this part of what it was vanishes to rounding.
const SPECIAL: f64 = 1e-9;
/// A step that would end where something happens is made so much shorter.
const BESIDE: f64 = 0.83;

/// A curve on its way; vectors are unknowns in units of their scales, then the parameter in units of the range.
struct Walk<'e> {
    equations: &'e mut dyn Equations,
    scale: Vec<f64>,
    range: (f64, f64),
    family: usize,
    /// The size below which eigenvalues are small.
    unit: f64,
    /// Where the family is cut, and its directions.
    anchor: DVector<f64>,
    across: DMatrix<f64>,
}

impl Walk<'_> {
    fn new<'e>(
        equations: &'e mut dyn Equations,
        start: &Point,
        family: usize,
        range: (f64, f64),
    ) -> Result<Walk<'e>, OrbitError> {
        let scale = scale(&start.unknowns);
        let own = equations.evaluate(&start.unknowns, start.parameter)?;
        let across = kernel(&scaled(&own.by_unknowns, &scale), family);
        let unknowns = start.unknowns.iter().zip(&scale).map(|(x, s)| x / s);
        Ok(Walk {
            equations,
            range,
            family,
            unit: smallest(&start.spectrum.values),
            anchor: DVector::from_iterator(scale.len(), unknowns),
            across: across.ok_or(OrbitError::NoEigenvalues)?,
            scale,
        })
    }

    fn width(&self) -> f64 {
        self.range.1 - self.range.0
    }

    fn pack(&self, point: &Point) -> DVector<f64> {
        let unknowns = point.unknowns.iter().zip(&self.scale).map(|(x, s)| x / s);
        let parameter = (point.parameter - self.range.0) / self.width();
        DVector::from_iterator(self.scale.len() + 1, unknowns.chain([parameter]))
    }

    fn unpack(&self, y: &DVector<f64>) -> (Vec<f64>, f64) {
        let m = self.scale.len();
        let unknowns = unscaled(&y.rows(0, m).into(), &self.scale);
        (unknowns, self.range.0 + y[m] * self.width())
    }

    /// F and the conditions of the cut, with their derivatives.
    fn system(&mut self, y: &DVector<f64>) -> Result<(DVector<f64>, DMatrix<f64>), OrbitError> {
        spend(EVALUATION);
        let (x, p) = self.unpack(y);
        let own = self.equations.evaluate(&x, p)?;
        let (rows, m) = (own.residual.len(), x.len());
        let offset = DVector::from(y.rows(0, m)) - &self.anchor;
        let cut = self.across.tr_mul(&offset);
        let mut residual = own.residual.resize_vertically(rows + self.family, 0.0);
        residual.rows_mut(rows, self.family).copy_from(&cut);
        let mut matrix = DMatrix::zeros(rows + self.family, m + 1);
        let by_unknowns = scaled(&own.by_unknowns, &self.scale);
        matrix.view_mut((0, 0), (rows, m)).copy_from(&by_unknowns);
        let width = self.width();
        matrix
            .view_mut((0, m), (rows, 1))
            .copy_from(&(own.by_parameter * width));
        matrix
            .view_mut((rows, 0), (self.family, m))
            .copy_from(&self.across.transpose());
        Ok((residual, matrix))
    }

    /// The solution in the plane through a guess with this normal, and how many steps it took.
    fn correct(
        &mut self,
        guess: &DVector<f64>,
        normal: &DVector<f64>,
    ) -> Result<(DVector<f64>, usize), OrbitError> {
        let mut y = guess.clone();
        let mut last = f64::INFINITY;
        let mut residual = f64::NAN;
        for step in 0..STEPS {
            let (f, matrix) = self.system(&y)?;
            residual = f.amax();
            let rows = f.len();
            let mut right = (-f).resize_vertically(rows + 1, 0.0);
            right[rows] = normal.dot(&(guess - &y));
            let mut square = matrix.resize_vertically(rows + 1, 0.0);
            square.row_mut(rows).copy_from(&normal.transpose());
            let change = least_squares(&square, &right, f64::EPSILON);
            let change = change.ok_or(OrbitError::NoEigenvalues)?;
            let size = change.norm();
            if !size.is_finite() || size > 0.5 * (1.0 + y.norm()) {
                break;
            }
            y += change;
            if is_done(size, last, y.norm()) {
                if !is_solved(residual, &square, y.norm()) {
                    break;
                }
                return Ok((y, step));
            }
            last = size;
        }
        Err(OrbitError::NotConverged {
            what: self.equations.what(),
            steps: STEPS,
            residual,
        })
    }

    fn tangent(&mut self, y: &DVector<f64>) -> Result<DVector<f64>, OrbitError> {
        let (_, matrix) = self.system(y)?;
        let found = kernel(&matrix, 1).ok_or(OrbitError::NoEigenvalues)?;
        Ok(found.column(0).into())
    }

    fn point(&mut self, y: &DVector<f64>) -> Result<Point, OrbitError> {
        let (unknowns, parameter) = self.unpack(y);
        let spectrum = self.equations.spectrum(&unknowns, parameter, self.family)?;
        Ok(Point {
            parameter,
            unknowns,
            spectrum,
        })
    }

    /// Points from the start on, with a growing or falling parameter at first.
    fn walk(
        &mut self,
        start: &Point,
        is_upwards: bool,
        pace: Pace,
        (points, special): (&mut Vec<Point>, &mut Vec<Special>),
    ) -> Result<End, OrbitError> {
        let m = self.scale.len();
        let mut at = Stand {
            y: self.pack(start),
            tangent: DVector::zeros(m + 1),
            point: start.clone(),
            s: 0.0,
        };
        self.equations.accepted(&start.unknowns, start.parameter)?;
        at.tangent = self.tangent(&at.y)?;
        if (at.tangent[m] > 0.0) != is_upwards {
            at.tangent.neg_mut();
        }
        let first = at.clone();
        let mut runs_back = false;
        let mut before: Option<Stand> = None;
        let mut happened = Vec::new();
        let mut length = FIRST.min(pace.step);
        let end = loop {
            if points.len() >= pace.points {
                break End::Points;
            }
            if is_at_end(&at.y) && (at.tangent[m] > 0.0) == (at.y[m] >= 1.0) {
                break End::Range;
            }
            let found = self.step(&at, length);
            let is_back = found
                .as_ref()
                .is_some_and(|own| self.runs_back(&at, &own.0));
            runs_back |= is_back;
            let Some((next, steps)) = found.filter(|_| !is_back) else {
                length *= 0.5;
                if length < SHORTEST {
                    break if runs_back { End::Steady } else { End::Lost };
                }
                continue;
            };
            if !points.is_empty() && self.is_closed(&first, &at, &next) {
                let s = at.s + (&first.y - &at.y).norm();
                self.between(&at, &Stand { s, ..first }, &mut happened);
                break End::Closed;
            }
            // Where something happens at a point itself no sign changes on either side of it.
            let beside = if self.is_special(&at, &next) {
                self.step(&at, BESIDE * length)
            } else {
                None
            };
            let (next, steps) = beside.unwrap_or((next, steps));
            let is_out = next.y[m] < 0.0 || next.y[m] > 1.0;
            let next = if is_out {
                self.at_border(&at, &next)
            } else {
                Some(next)
            };
            let Some(next) = next else {
                break End::Lost;
            };
            self.between(&at, &next, &mut happened);
            if let Some(before) = &before {
                self.touching(before, &at, &next, &mut happened);
            }
            points.push(next.point.clone());
            self.equations
                .accepted(&next.point.unknowns, next.point.parameter)?;
            if is_at_end(&next.y) {
                break End::Range;
            }
            before = Some(std::mem::replace(&mut at, next));
            if steps <= 3 {
                length = (1.5 * length).min(pace.step);
            }
        };
        happened.sort_by(|a, b| a.0.total_cmp(&b.0));
        special.extend(happened.into_iter().map(|(_, own)| own));
        Ok(end)
    }

    fn runs_back(&mut self, before: &Stand, after: &Stand) -> bool {
        let [a, b] = [before, after].map(|own| (&own.point.unknowns[..], own.point.parameter));
        self.equations.runs_back(a, b).unwrap_or(false)
    }

    /// Whether the curve passes its first point between two others, in the same direction.
    fn is_closed(&mut self, first: &Stand, a: &Stand, b: &Stand) -> bool {
        let (from, to) = (&a.y - &first.y, &b.y - &first.y);
        let [before, after] = [&from, &to].map(|own| own.dot(&first.tangent));
        let length = (&to - &from).norm();
        let is_near = from.norm() < 2.0 * length && to.norm() < 2.0 * length;
        if !(is_near && before < 0.0 && after >= 0.0 && a.tangent.dot(&first.tangent) > 0.0) {
            return false;
        }
        let guess = &a.y + (&to - &from) * (before / (before - after));
        let found = self.correct(&guess, &first.tangent);
        found.is_ok_and(|(y, _)| (&y - &first.y).norm() < SAME * (1.0 + y.norm()))
    }

    /// Whether a test vanishes at a point, to rounding of what it is at the one before; one that does not vanish everywhere is no number there.
    fn is_special(&self, before: &Stand, at: &Stand) -> bool {
        (0..self.tests(at).len()).any(|test| {
            let [a, b] = [before, at].map(|own| self.value(Sign::Test(test), own));
            !a.is_nan() && (b.is_nan() || b.abs() < SPECIAL * a.abs())
        })
    }

    /// The next point at this length, where the direction does not change much.
    fn step(&mut self, at: &Stand, length: f64) -> Option<(Stand, usize)> {
        let guess = &at.y + &at.tangent * length;
        let (y, steps) = self.correct(&guess, &at.tangent).ok()?;
        let mut tangent = self.tangent(&y).ok()?;
        if tangent.dot(&at.tangent) < 0.0 {
            tangent.neg_mut();
        }
        if tangent.dot(&at.tangent) < 0.8 || (&y - &at.y).norm() > 3.0 * length {
            return None;
        }
        let s = at.s + (&y - &at.y).norm();
        let point = self.point(&y).ok()?;
        Some((
            Stand {
                y,
                tangent,
                point,
                s,
            },
            steps,
        ))
    }

    /// The point at the end of the range between two points.
    fn at_border(&mut self, at: &Stand, next: &Stand) -> Option<Stand> {
        let m = self.scale.len();
        let border = if next.y[m] > 1.0 { 1.0 } else { 0.0 };
        let part = (border - at.y[m]) / (next.y[m] - at.y[m]);
        let mut guess = &at.y + (&next.y - &at.y) * part;
        guess[m] = border;
        let mut normal = DVector::zeros(m + 1);
        normal[m] = 1.0;
        let (mut y, _) = self.correct(&guess, &normal).ok()?;
        y[m] = border;
        let point = self.point(&y).ok()?;
        Some(Stand {
            tangent: next.tangent.clone(),
            s: at.s + (&y - &at.y).norm(),
            y,
            point,
        })
    }

    /// What happens between two points.
    fn between(&mut self, a: &Stand, b: &Stand, happened: &mut Vec<(f64, Special)>) {
        let turns = self.value(Sign::Growth, a) * self.value(Sign::Growth, b) < 0.0;
        let known = happened.len();
        let mut is_located = false;
        for test in 0..self.tests(a).len() {
            let sign = Sign::Test(test);
            let [left, right] = [a, b].map(|own| self.value(sign, own));
            if left * right < 0.0 {
                let found = self.locate(sign, a, b);
                is_located |= test == 0 && found.is_some();
                let Some(own) = found else { continue };
                // What jumps from one sign to the other has a pole between.
                if self.value_within(sign, &own).abs() > JUMP * left.abs().min(right.abs()) {
                    let kind = Kind::Infinity;
                    let point = own.point;
                    happened.push((own.s, Special { kind, point }));
                    continue;
                }
                let is_branching = turns && self.is_branching(a, &own);
                happened.extend(self.special(test, own, turns).map(|(s, mut own)| {
                    if is_branching && own.kind == Kind::Fold {
                        own.kind = Kind::Pitchfork;
                    }
                    (s, own)
                }));
            }
        }
        if happened.len() == known && !turns {
            self.several(a, b, happened);
        }
        // Where two branches meet, one may turn back without a change of sign of its eigenvalue, as at a pitchfork.
        if turns && !is_located {
            if let Some(own) = self.locate(Sign::Growth, a, b) {
                let kind = if self.is_branching(a, &own) {
                    Kind::Pitchfork
                } else {
                    Kind::Fold
                };
                happened.push((
                    own.s,
                    Special {
                        kind,
                        point: own.point,
                    },
                ));
            }
        }
    }

    /// Whether another curve crosses at a point: two directions solve the linear equations there, and one beside it.
    fn is_branching(&mut self, beside: &Stand, own: &Stand) -> bool {
        let m = self.scale.len();
        let mut second = |y: &DVector<f64>| {
            let (_, matrix) = self.system(y).ok()?;
            let values = decomposed(&matrix)?.s;
            values.get(m.checked_sub(1)?).copied()
        };
        let pair = second(&own.y).zip(second(&beside.y));
        pair.is_some_and(|(there, beside)| there < BRANCHING * beside)
    }

    /// Several eigenvalues that pass the axis at once, so that no product of them changes its sign.
    fn several(&mut self, a: &Stand, b: &Stand, happened: &mut Vec<(f64, Special)>) {
        let ends = self.count(a, NEAR_AXIS).zip(self.count(b, NEAR_AXIS));
        let Some((from, to)) = ends else {
            return;
        };
        if from == to {
            return;
        }
        let (mut low, mut high) = (0.0, 1.0);
        let mut found = None;
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            let Some(own) = self.on_chord(a, b, middle) else {
                return;
            };
            let count = self.count(&own, ON_AXIS);
            found = Some(own);
            match count {
                Some(count) if count == from => low = middle,
                Some(count) if count == to => high = middle,
                // They pass one after the other.
                Some(_) => {
                    if let Some(own) = found {
                        self.between(a, &own, happened);
                        self.between(&own, b, happened);
                    }
                    return;
                }
                None => break,
            }
        }
        let Some(own) = found else { return };
        let size = largest(&own.point.spectrum.values);
        let is_on_axis = |l: &&Complex<f64>| l.im >= 0.0 && l.re.abs() < NEAR_AXIS * size;
        let values = own.point.spectrum.values.iter();
        let on_axis: Vec<Complex<f64>> = values.filter(is_on_axis).copied().collect();
        let pairs = on_axis.iter().filter(|l| l.im > NEAR_AXIS * size);
        let mut kinds: Vec<Kind> = pairs
            .map(|l| Kind::Hopf {
                frequency: l.im,
                first_lyapunov: Err(WithoutLyapunov::Several),
            })
            .collect();
        if on_axis.len() > kinds.len() {
            kinds.push(Kind::BranchPoint);
        }
        for kind in kinds {
            let point = own.point.clone();
            happened.push((own.s, Special { kind, point }));
        }
    }

    /// How many eigenvalues lie right of the axis; `None` where one lies on it, to a part of the largest.
    fn count(&self, at: &Stand, part: f64) -> Option<usize> {
        let values = &at.point.spectrum.values;
        let size = largest(values);
        let mut count = 0;
        for value in values {
            let beyond = self.equations.beyond(*value, size)?;
            if beyond.abs() < part {
                return None;
            }
            count += usize::from(beyond > 0.0);
        }
        Some(count)
    }

    fn special(&mut self, test: usize, own: Stand, turns: bool) -> Option<(f64, Special)> {
        let at = (&own.point.unknowns[..], own.point.parameter);
        let kind = self.equations.kind(test, at, &own.point.spectrum, turns);
        let point = own.point;
        Some((
            own.s,
            Special {
                kind: kind.ok()??,
                point,
            },
        ))
    }

    /// Two zeros of a test that lie between points of the same sign: towards where it is smallest its sign is looked at.
    fn touching(&mut self, a: &Stand, b: &Stand, c: &Stand, happened: &mut Vec<(f64, Special)>) {
        for test in 0..self.tests(b).len() {
            let sign = Sign::Test(test);
            let [low, middle, high] = [a, b, c].map(|own| self.value(sign, own));
            let is_same = low * middle > 0.0 && middle * high > 0.0;
            if !(is_same && middle.abs() < low.abs() && middle.abs() < high.abs()) {
                continue;
            }
            if let Some(inside) = self.other_sign(sign, [a, b, c]) {
                for (a, c) in [(a, &inside), (&inside, c)] {
                    let growth = [a, c].map(|own| self.value(Sign::Growth, own));
                    let turns = growth[0] * growth[1] < 0.0;
                    let own = self.locate(sign, a, c);
                    let own = own.and_then(|own| self.special(test, own, turns));
                    let near = LOCATED_TWICE * (c.s - a.s);
                    let is_known = |(s, own): &(f64, Special)| {
                        let same = |(t, known): &(f64, Special)| {
                            (s - t).abs() <= near && own.kind.is_like(known.kind)
                        };
                        happened.iter().any(same)
                    };
                    let own = own.filter(|own| !is_known(own));
                    happened.extend(own);
                }
            }
        }
    }

    /// A point at which a test has another sign than at three points between which its size has a minimum.
    fn other_sign(&mut self, sign: Sign, three: [&Stand; 3]) -> Option<Stand> {
        let mut three = three.map(Clone::clone);
        let outside = self.value(sign, &three[1]);
        for _ in 0..HALVINGS {
            let [a, b, c] = &three;
            let (left, right) = (self.halfway(a, b)?, self.halfway(b, c)?);
            let (at_left, at_right) = (self.value(sign, &left), self.value(sign, &right));
            let middle = self.value(sign, b).abs();
            if at_left * outside < 0.0 {
                return Some(left);
            }
            if at_right * outside < 0.0 {
                return Some(right);
            }
            let [a, b, c] = three;
            three = if at_left.abs() < middle.min(at_right.abs()) {
                [a, left, b]
            } else if at_right.abs() < middle {
                [b, right, c]
            } else {
                [left, b, right]
            };
        }
        None
    }

    fn tests(&self, at: &Stand) -> Vec<f64> {
        self.equations.tests(&at.point.spectrum.values, self.unit)
    }

    /// What is looked at, at a point beside which it may change its sign; no number where it vanishes identically.
    fn value(&self, sign: Sign, at: &Stand) -> f64 {
        let vanish = self.equations.vanish(&at.point.spectrum.values);
        if matches!(sign, Sign::Test(test) if vanish.get(test) == Some(&true)) {
            f64::NAN
        } else {
            self.value_within(sign, at)
        }
    }

    /// The same between two points at which it does not vanish.
    fn value_within(&self, sign: Sign, at: &Stand) -> f64 {
        match sign {
            Sign::Growth => at.tangent[self.scale.len()],
            Sign::Test(test) => self.tests(at).get(test).copied().unwrap_or(f64::NAN),
        }
    }

    fn halfway(&mut self, a: &Stand, b: &Stand) -> Option<Stand> {
        self.on_chord(a, b, 0.5)
    }

    /// The point of the curve in the plane across a chord.
    fn on_chord(&mut self, a: &Stand, b: &Stand, part: f64) -> Option<Stand> {
        let chord = &b.y - &a.y;
        let (y, _) = self
            .correct(&(&a.y + &chord * part), &chord.normalize())
            .ok()?;
        let mut tangent = self.tangent(&y).ok()?;
        if tangent.dot(&chord) < 0.0 {
            tangent.neg_mut();
        }
        let s = a.s + part * (b.s - a.s);
        let point = self.point(&y).ok()?;
        Some(Stand {
            y,
            tangent,
            point,
            s,
        })
    }

    /// The zero between two points of opposite sign to rounding, by false position with halved weights (Dowell and Jarratt 1971).
    fn locate(&mut self, sign: Sign, a: &Stand, b: &Stand) -> Option<Stand> {
        let mut ends = [0.0, 1.0];
        let mut values = [self.value(sign, a), self.value(sign, b)];
        let mut best = None;
        let mut kept = 2;
        for _ in 0..60 {
            let part = (ends[0] * values[1] - ends[1] * values[0]) / (values[1] - values[0]);
            let Some(own) = self.on_chord(a, b, part) else {
                break;
            };
            let value = self.value_within(sign, &own);
            best = Some(own);
            if !value.is_finite() || value == 0.0 {
                break;
            }
            let side = usize::from(value * values[1] > 0.0);
            let moved = (part - ends[side]).abs();
            (ends[side], values[side]) = (part, value);
            if kept == side {
                values[1 - side] *= 0.5;
            }
            kept = side;
            if moved.min(ends[1] - ends[0]) < LOCATED {
                break;
            }
        }
        best
    }
}

/// The size of the smallest eigenvalue that is none by rounding; 1 where there is none.
fn smallest(values: &[Complex<f64>]) -> f64 {
    let least = SPECIAL * largest(values);
    let sizes = values.iter().map(|l| l.norm()).filter(|l| *l > least);
    let found = sizes.fold(f64::INFINITY, f64::min);
    if found.is_finite() {
        found
    } else {
        1.0
    }
}

/// The size of the largest eigenvalue.
fn largest(values: &[Complex<f64>]) -> f64 {
    let sizes = values.iter().map(|l| l.norm());
    sizes.fold(f64::MIN_POSITIVE, f64::max)
}

/// A place between two points is found where it moves by less, in parts of their distance.
const LOCATED: f64 = 1e-15;
/// Places that are found in two ways differ by less.
const LOCATED_TWICE: f64 = 1e-7;
/// A test that is a larger part than this of what it is beside its change of sign does not pass through zero there.
const JUMP: f64 = 1e-2;
/// A singular value below this part of what it is beside belongs to a second direction.
const BRANCHING: f64 = 1e-3;
/// Eigenvalues nearer to the axis are on it.
const ON_AXIS: f64 = 1e-12;
/// The same where several pass at once, which is found by bisection.
const NEAR_AXIS: f64 = 1e-6;
/// Bisections of a step for them.
const BISECTIONS: usize = 44;

/// Whether the parameter is at an end of the range.
fn is_at_end(y: &DVector<f64>) -> bool {
    y.iter().next_back().is_some_and(|p| *p <= 0.0 || *p >= 1.0)
}

/// How often a distance is halved in search of another sign.
const HALVINGS: usize = 16;

/// A point with its place on the curve.
#[derive(Clone)]
struct Stand {
    y: DVector<f64>,
    tangent: DVector<f64>,
    point: Point,
    /// How far it is from the start, along chords.
    s: f64,
}

/// What is looked at for a change of sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sign {
    /// A test of the equations, by its number.
    Test(usize),
    /// Whether the parameter grows along the curve.
    Growth,
}

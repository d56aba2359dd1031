//! Where a steady motion is stable in the plane of two parameters: `chetaev stability --over a=0:1,b=0:2`.
//!
//! The linear equations are exact in both parameters. On a grid the eigenvalues say on which side of the axis they lie; between two places of
//! different kinds the boundary is located by bisection, and the places are joined to curves (marching squares). The functions whose zeros these
//! curves are, factors of the constant coefficient, of Hurwitz's last determinant but one and of the leading coefficient (Liénard and Chipart
//! 1914), are given exactly where they are short, else with decimal coefficients.

use super::decimal::same_zeros;
use super::{at, check_parameter, motions, range, with_values, Range, StabilityError, Wanted};
use crate::start;
use chetaev_mechanics::{SteadyMotion, System};
use chetaev_model::Model;
use chetaev_stability::admissible_values::AdmissiblePlaces;
use chetaev_stability::eigenvalues::{eigenvalues, zeros_of, Complex};
use chetaev_stability::expansion::Expansion;
use chetaev_stability::guess::near;
use chetaev_stability::hurwitz::determinants;
use chetaev_stability::question::{values_but_these, Place, Question};
use chetaev_stability::reduction::Speeds;
use chetaev_stability::steady_set::steady_set;
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::parallel::on_threads;
use chetaev_symbolic::{Expr, Graph, Rational, Symbol};
use serde_json::{json, Value};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// Intervals on each side of the grid.
pub const SIDE: usize = 200;
/// Bisections of an edge of the grid: to the rounding of the parameters.
const HALVINGS: usize = 48;
/// Where eigenvalues come in opposite pairs none is left of the axis; this part of the largest counts as on it.
const ON_AXIS: f64 = 1e-7;
/// The same of a pair that lies on the axis along an edge of the map: simple eigenvalues are known to rounding.
const ROUNDING: f64 = 1e-13;
/// Longer equations have decimal coefficients.
const LONGEST: usize = 400;

/// What a motion is at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// No eigenvalue lies right of the axis: for pairs on it, linear motions grow no faster than a power of the time.
    Stable,
    /// One does.
    Unstable,
    /// There is no such motion, as what it states is not real, or not what the model assumes.
    NoMotion,
}

/// A boundary of stability.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// `zero` where a real eigenvalue passes through zero, `pair` where a pair passes the axis, `collision` where two imaginary pairs meet, `infinity`
    /// where an eigenvalue goes there, `end` where the motion ceases to be.
    pub kind: &'static str,
    /// Values of both parameters along it.
    pub points: Vec<(f64, f64)>,
}

impl Curve {
    /// What happens along it.
    pub fn what(&self) -> &'static str {
        match self.kind {
            "pair" => "a pair of eigenvalues passes the axis",
            "collision" => "two pairs of eigenvalues meet",
            "infinity" => "an eigenvalue goes to infinity",
            "end" => "the motion ceases to be",
            _ => "an eigenvalue passes through zero",
        }
    }
}

/// Stability over two parameters.
#[derive(Clone, Debug)]
pub struct StabilityMap {
    /// The name of the model.
    pub name: String,
    /// The name of the motion.
    pub motion: String,
    /// The parameters with their ranges.
    pub ranges: [Range; 2],
    /// Intervals on each side of the grid.
    pub side: usize,
    /// The largest real part of an eigenvalue that is no zero of the family, at `side` + 1 values of the first parameter for each of the second.
    pub growth: Vec<f64>,
    /// What the motion is there.
    pub kinds: Vec<Kind>,
    /// Boundaries.
    pub curves: Vec<Curve>,
    /// Functions on whose zeros they lie.
    pub equations: Vec<Equation>,
}

/// A function on whose zeros boundaries lie.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Equation {
    /// What passes there; `opposite` where two eigenvalues are and nothing passes.
    pub kind: &'static str,
    /// The function, a polynomial in both parameters with decimal coefficients where the exact one is long.
    pub function: String,
    /// Whether its coefficients are rounded.
    pub is_rounded: bool,
}

/// How a map is computed; the map does not depend on the threads.
pub struct Course<'t> {
    /// Intervals on each side of the grid.
    pub side: usize,
    /// Threads.
    pub threads: usize,
    /// Hears which part is done.
    pub tell: &'t mut dyn FnMut(f64),
}

/// The map of a model over `a=FROM:TO,b=FROM:TO`, [`SIDE`] intervals wide and high, on all processors.
///
/// # Errors
/// [`StabilityError`].
pub fn map(
    model: &Model,
    wanted: &Wanted<'_>,
    tell: &mut dyn FnMut(f64),
) -> Result<StabilityMap, StabilityError> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let side = SIDE;
    let course = Course {
        side,
        threads,
        tell,
    };
    Ok(Asked::new(model, wanted)?.map(course))
}

/// A motion with its linear equations, exact in two parameters.
pub struct Asked {
    system: System,
    motion: SteadyMotion,
    question: Question,
    /// Where the motion is.
    places: AdmissiblePlaces,
    ranges: [Range; 2],
}

impl Asked {
    /// What is asked of a model over `a=FROM:TO,b=FROM:TO`.
    ///
    /// # Errors
    /// [`StabilityError`].
    pub fn new(model: &Model, wanted: &Wanted<'_>) -> Result<Asked, StabilityError> {
        let text = wanted.over.unwrap_or_default();
        let wrong = || StabilityError::Range { text: text.into() };
        let all: Vec<Range> = text
            .split(',')
            .map(|own| range(model, own))
            .collect::<Result<_, _>>()?;
        let ranges: [Range; 2] = all.try_into().map_err(|_| wrong())?;
        if ranges[0].symbol == ranges[1].symbol {
            let name = ranges[0].name.clone();
            return Err(StabilityError::SameParameter { name });
        }
        let mut system = System::from_model(model)?;
        let prepared = start::prepared(model, &system)?;
        let (terms, selection) = (&prepared.terms, &prepared.selection);
        let values = values_but_these(&system, &ranges.clone().map(|own| own.symbol));
        let found = || steady_set(&system, terms, selection, &values);
        let mut motions = motions(model, &system, wanted.about, &found)?;
        for range in &ranges {
            check_parameter(&system, &motions, range)?;
        }
        let given = wanted.at.map(|text| at(model, text)).transpose()?;
        if let Some(name) = with_values(&mut system, &mut motions, &given.unwrap_or_default()) {
            let text = wanted.at.unwrap_or_default().into();
            let why = format!("`{name}` is neither a control nor a parameter of the motion");
            return Err(StabilityError::At { text, why });
        }
        let motion = motions
            .into_iter()
            .next()
            .ok_or(StabilityError::SeveralMotions { names: Vec::new() })?;
        let motion = near(&system, terms, selection, (&motion, &values))?.into_owned();
        let own = (&values[..], Speeds::Suitable);
        let about = Expansion::in_speeds(&system, terms, selection, &motion, own)?;
        let question = Question::about(&about, None);
        let places = AdmissiblePlaces::new(&system, &about.found, &values);
        Ok(Asked {
            places,
            motion,
            question,
            ranges,
            system,
        })
    }

    /// Whether both parameters occur in the linear equations.
    pub fn depends_on_both(&self) -> bool {
        let linear = &self.question.linear;
        let entries = [linear.left.concat(), linear.right.concat()].concat();
        let g = &self.system.graph;
        let occurs = |own: &Range| g.any_contains_any(&entries, &[own.symbol]);
        self.ranges.iter().all(occurs)
    }

    /// The map.
    pub fn map(self, course: Course<'_>) -> StabilityMap {
        let (side, threads) = (course.side.max(1), course.threads);
        let grid = Grid {
            g: &self.system.graph,
            question: &self.question,
            places: &self.places,
            over: self.ranges.clone().map(|own| own.symbol),
            ranges: &self.ranges,
            side,
            threads,
        };
        let (growth, kinds) = grid.sampled(course.tell);
        let dividing = grid.dividing();
        let (curves, used) = grid.curves(&dividing, &kinds);
        StabilityMap {
            curves,
            equations: grid.equations(&dividing, &used),
            growth,
            kinds,
            side,
            name: self.system.name.clone(),
            motion: self.motion.name.clone(),
            ranges: self.ranges,
        }
    }
}

/// The question over a grid of two parameters.
struct Grid<'a> {
    g: &'a Graph,
    question: &'a Question,
    places: &'a AdmissiblePlaces,
    over: [Symbol; 2],
    ranges: &'a [Range; 2],
    side: usize,
    threads: usize,
}

/// A place between two neighbours of the grid: column, row, and whether the next one lies above.
type Edge = (usize, usize, bool);

impl Grid<'_> {
    fn place(&self, column: f64, row: f64) -> (f64, f64) {
        let at = |range: &Range, part: f64| {
            let (low, high) = (range.low.to_f64().value(), range.high.to_f64().value());
            low + (high - low) * part / self.side as f64
        };
        (at(&self.ranges[0], column), at(&self.ranges[1], row))
    }

    fn value(&self, s: Symbol, (x, y): (f64, f64)) -> Option<f64> {
        let mut both = self.over.iter().zip([x, y]);
        both.find(|(own, _)| **own == s).map(|(_, value)| value)
    }

    /// The eigenvalue farthest right, and the size of the largest; `None` where there is no motion, or no number.
    fn rightmost(&self, place: (f64, f64)) -> Option<(Complex<f64>, f64)> {
        let value = |s: Symbol| self.value(s, place);
        if !self.places.contain(self.g, &value) {
            return None;
        }
        let numbers = |es: &[Expr]| self.g.evaluate_f64(es, &value).ok();
        let found = match &self.question.polynomial {
            Some(own) => {
                let list = numbers(&own.coefficients)?;
                let mut found = zeros_of(&list)?;
                found.extend(vec![Complex::new(0.0, 0.0); own.further_zeros]);
                found
            }
            None => {
                let linear = &self.question.linear;
                let matrix = |rows: &[Vec<Expr>]| -> Option<Vec<Vec<f64>>> {
                    rows.iter().map(|row| numbers(row)).collect()
                };
                let mut found = eigenvalues(&matrix(&linear.left)?, &matrix(&linear.right)?)?;
                found.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
                found.split_off(linear.family.min(found.len()))
            }
        };
        let size = found
            .iter()
            .map(|l| l.norm())
            .fold(f64::MIN_POSITIVE, f64::max);
        let last = found.into_iter().max_by(|a, b| a.re.total_cmp(&b.re));
        Some((last.unwrap_or_default(), size))
    }

    fn kind(&self, place: (f64, f64), own: Option<(Complex<f64>, f64)>) -> Kind {
        let allowed = if self.question.spectrum.paired.is_some() {
            ON_AXIS
        } else {
            ROUNDING
        };
        match own {
            Some((l, size)) if l.re <= allowed * size => Kind::Stable,
            None if !self.places.contain(self.g, &|s| self.value(s, place)) => Kind::NoMotion,
            _ => Kind::Unstable,
        }
    }

    fn kind_at(&self, place: (f64, f64)) -> Kind {
        self.kind(place, self.rightmost(place))
    }

    fn sampled(&self, tell: &mut dyn FnMut(f64)) -> (Vec<f64>, Vec<Kind>) {
        let one = |row: usize| -> Vec<(f64, Kind)> {
            let growth = |own: Option<(Complex<f64>, f64)>| own.map_or(f64::NAN, |own| own.0.re);
            let found = (0..=self.side).map(|column| {
                let place = self.place(column as f64, row as f64);
                let own = self.rightmost(place);
                let is_near = own.is_some_and(|(l, size)| l.re.abs() <= ON_AXIS * size);
                let exact = || self.exact_kind(column, row);
                let exact = is_near.then(exact).flatten();
                (growth(own), exact.unwrap_or_else(|| self.kind(place, own)))
            });
            found.collect()
        };
        let rows = self.side + 1;
        let mut tell = |row: usize| tell(row as f64 / rows as f64);
        let found = on_threads(self.threads, rows, one, &mut tell);
        found.into_iter().flatten().unzip()
    }

    /// What the motion is at a place of the grid where an eigenvalue is near the axis: on which side of it rounding does not say.
    fn exact_kind(&self, column: usize, row: usize) -> Option<Kind> {
        let own = self.ranges.iter().zip([column, row]);
        let values = own.map(|(range, at)| {
            let part = Rational::from(at) / Rational::from(self.side);
            let value = &range.low + (&range.high - &range.low) * part;
            (self.g.symbol_expr(range.symbol), self.g.number(value))
        });
        let values: Vec<(Expr, Expr)> = values.collect();
        match self.question.place_with(self.g, &values)? {
            Place::Left | Place::OnAxis => Some(Kind::Stable),
            Place::Right => Some(Kind::Unstable),
            Place::NotLeft => None,
        }
    }

    /// The place of the boundary on an edge whose ends differ, with what passes there and the function that vanishes.
    fn located(
        &self,
        dividing: &[Dividing],
        (column, row, is_upwards): Edge,
        [first, last]: [Kind; 2],
    ) -> Located {
        let at = |part: f64| {
            let (dx, dy) = if is_upwards { (0.0, part) } else { (part, 0.0) };
            self.place(column as f64 + dx, row as f64 + dy)
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.kind_at(at(middle)) == first {
                low = middle;
            } else {
                high = middle;
            }
        }
        let middle = 0.5 * (low + high);
        let place = at(middle);
        if first == Kind::NoMotion || last == Kind::NoMotion {
            return (place, "end", None);
        }
        let changes = |own: &Dividing| {
            let sides = [middle - BESIDE, middle + BESIDE];
            let signs = sides.map(|part| self.number(own.function, at(part)));
            signs[0] * signs[1] < 0.0
        };
        match dividing.iter().position(changes) {
            Some(own) => (place, dividing[own].kind, Some(own)),
            None => {
                let kind = self.kind_near(place);
                let mut all = dividing.iter();
                let own = all.position(|own| own.kind == kind && self.vanishes_about(own, place));
                (place, kind, own)
            }
        }
    }

    /// Whether a function changes its sign about a place, as where a boundary runs along an edge.
    fn vanishes_about(&self, own: &Dividing, place: (f64, f64)) -> bool {
        let (origin, cell) = (self.place(0.0, 0.0), self.place(BESIDE, BESIDE));
        let (dx, dy) = (cell.0 - origin.0, cell.1 - origin.1);
        let beside = [(dx, 0.0), (-dx, 0.0), (0.0, dy), (0.0, -dy)];
        let signs = beside.map(|(x, y)| self.number(own.function, (place.0 + x, place.1 + y)));
        signs[0] * signs[1] < 0.0 || signs[2] * signs[3] < 0.0
    }

    fn number(&self, e: Expr, place: (f64, f64)) -> f64 {
        let found = self.g.evaluate_f64(&[e], &|s| self.value(s, place));
        found.map_or(f64::NAN, |found| found[0])
    }

    /// What passes at a place where no function changes its sign, as where several eigenvalues pass at once.
    fn kind_near(&self, place: (f64, f64)) -> &'static str {
        let is_pair = |(l, size): (Complex<f64>, f64)| l.im.abs() > 1e-5 * size;
        if self.rightmost(place).is_some_and(is_pair) {
            "pair"
        } else {
            "zero"
        }
    }

    /// The boundaries, joined from cell to cell, and which of the functions vanish on them.
    fn curves(&self, dividing: &[Dividing], kinds: &[Kind]) -> (Vec<Curve>, BTreeSet<usize>) {
        let side = self.side;
        let kind = |column: usize, row: usize| kinds[row * (side + 1) + column];
        let ends = |&(c, r, up): &Edge| {
            let other = if up { kind(c, r + 1) } else { kind(c + 1, r) };
            [kind(c, r), other]
        };
        let mut joined: BTreeMap<Edge, Vec<Edge>> = BTreeMap::new();
        for row in 0..side {
            for column in 0..side {
                let edges = [
                    (column, row, false),
                    (column + 1, row, true),
                    (column, row + 1, false),
                    (column, row, true),
                ];
                let differs = |edge: &Edge| {
                    let [first, last] = ends(edge);
                    first != last
                };
                let crossed: Vec<Edge> = edges.into_iter().filter(differs).collect();
                for pair in crossed.chunks_exact(2) {
                    joined.entry(pair[0]).or_default().push(pair[1]);
                    joined.entry(pair[1]).or_default().push(pair[0]);
                }
            }
        }
        let crossed: Vec<Edge> = joined.keys().copied().collect();
        let located = |at: usize| self.located(dividing, crossed[at], ends(&crossed[at]));
        let located = on_threads(self.threads, crossed.len(), located, &mut |_| {});
        let used = located.iter().filter_map(|own| own.2).collect();
        let places: BTreeMap<Edge, Located> = crossed.iter().copied().zip(located).collect();
        let meeting = |a: Located, b: Located| {
            let functions = [dividing.get(a.2?)?.function, dividing.get(b.2?)?.function];
            self.meeting(functions, (a.0, b.0))
        };
        let pieces = |chain: &Vec<Edge>| by_kind(chain.iter().map(|edge| places[edge]), &meeting);
        (chains(joined).iter().flat_map(pieces).collect(), used)
    }

    /// Where two functions vanish together near places of a boundary at which one of them does each, by Newton's method from between them: where
    /// boundaries meet; `None` where that is not within two cells.
    fn meeting(&self, functions: [Expr; 2], (a, b): Pair) -> Option<(f64, f64)> {
        let (start, g) = ((0.5 * (a.0 + b.0), 0.5 * (a.1 + b.1)), self.g);
        let slopes = functions.map(|e| self.over.map(|s| g.diff(e, s)));
        let mut at = start;
        for _ in 0..MEETING {
            let [f, h] = functions.map(|e| self.number(e, at));
            let [[a, b], [c, d]] = slopes.map(|row| row.map(|e| self.number(e, at)));
            let determinant = a * d - b * c;
            at.0 -= (d * f - b * h) / determinant;
            at.1 -= (a * h - c * f) / determinant;
        }
        let (origin, cell) = (self.place(0.0, 0.0), self.place(1.0, 1.0));
        let near = |x: f64, y: f64, width: f64| (x - y).abs() <= 2.0 * width.abs();
        let is_near =
            near(at.0, start.0, cell.0 - origin.0) && near(at.1, start.1, cell.1 - origin.1);
        is_near.then_some(at)
    }

    /// Functions on whose zeros boundaries may lie, as those of one parameter do.
    fn dividing(&self) -> Vec<Dividing> {
        let g = self.g;
        let mut found: Vec<Dividing> = Vec::new();
        for own in self.question.deciding(g) {
            let list = determinants(g, &own.coefficients);
            let pair = if own.is_paired { "collision" } else { "pair" };
            let all = [
                ("zero", own.coefficients.first()),
                (pair, list.len().checked_sub(2).map(|i| &list[i])),
                ("infinity", own.coefficients.last()),
            ];
            for (kind, e) in all {
                let occurring = e.and_then(|&e| factors(g, e, &self.over));
                for (function, _) in occurring.unwrap_or_default() {
                    let is_known = found.iter().any(|own| own.function == function);
                    if !is_known && g.contains_any(function, &self.over) {
                        found.push(Dividing { kind, function });
                    }
                }
            }
        }
        found
    }

    /// The functions with what happens on their zeros, those that are too long to be read with decimal coefficients. Where Hurwitz's last determinant but one vanishes two
    /// eigenvalues are opposite (Orlando 1911): a pair on the axis where that is a boundary, and otherwise perhaps λ and −λ.
    fn equations(&self, all: &[Dividing], used: &BTreeSet<usize>) -> Vec<Equation> {
        let read = |(at, own): (usize, &Dividing)| {
            let is_of_pairs = matches!(own.kind, "pair" | "collision");
            let kind = if is_of_pairs && !used.contains(&at) {
                "opposite"
            } else {
                own.kind
            };
            let exact = self.g.text(own.function);
            let is_rounded = exact.len() > LONGEST;
            let function = if is_rounded {
                same_zeros(self.g, own.function, &self.over)?
            } else {
                exact
            };
            Some(Equation {
                kind,
                function,
                is_rounded,
            })
        };
        all.iter().enumerate().filter_map(read).collect()
    }
}

/// A function that vanishes where something happens to eigenvalues.
struct Dividing {
    kind: &'static str,
    function: Expr,
}

/// A place of a boundary, what passes there, and the number of the function that vanishes.
type Located = ((f64, f64), &'static str, Option<usize>);

/// Two places.
type Pair = ((f64, f64), (f64, f64));

/// Steps to where boundaries meet.
const MEETING: usize = 30;

/// How far from a boundary signs are compared, in parts of an edge.
const BESIDE: f64 = 1e-4;

/// Chains of edges: open ones from an end, then closed ones.
fn chains(mut joined: BTreeMap<Edge, Vec<Edge>>) -> Vec<Vec<Edge>> {
    let mut found = Vec::new();
    loop {
        let ends = joined.iter().find(|(_, others)| others.len() == 1);
        let start = ends.or_else(|| joined.iter().next()).map(|(edge, _)| *edge);
        let Some(start) = start else {
            return found;
        };
        let mut chain = vec![start];
        let mut at = start;
        while let Some(next) = joined.get_mut(&at).and_then(Vec::pop) {
            if let Some(others) = joined.get_mut(&next) {
                if let Some(place) = others.iter().position(|own| *own == at) {
                    others.remove(place);
                }
            }
            chain.push(next);
            at = next;
        }
        joined.retain(|_, others| !others.is_empty());
        found.push(chain);
    }
}

/// Pieces of a chain of places of the same kind, each up to where it meets the next, if that is known.
fn by_kind(
    places: impl Iterator<Item = Located>,
    meeting: &dyn Fn(Located, Located) -> Option<(f64, f64)>,
) -> Vec<Curve> {
    let mut found: Vec<Curve> = Vec::new();
    let mut before: Option<Located> = None;
    for own in places {
        let (place, kind, _) = own;
        match found.last_mut() {
            Some(last) if last.kind == kind => last.points.push(place),
            last => {
                let corner = before.and_then(|before| meeting(before, own));
                if let (Some(last), Some(corner)) = (last, corner) {
                    last.points.push(corner);
                }
                let points = corner.into_iter().chain([place]);
                found.push(Curve {
                    kind,
                    points: points.collect(),
                });
            }
        }
        before = Some(own);
    }
    found.retain(|own| own.points.len() > 1);
    found
}

/// Columns and rows of the map in a terminal.
const WIDTH: usize = 60;
const HEIGHT: usize = 20;

impl StabilityMap {
    /// What the motion is at a place of the grid.
    pub(crate) fn kind_at(&self, column: usize, row: usize) -> Kind {
        self.kinds[row * (self.side + 1) + column]
    }

    /// The map in characters, with the boundaries.
    pub fn text(&self) -> String {
        let [x, y] = &self.ranges;
        let blank = if self.kinds.contains(&Kind::NoMotion) {
            "; blank: there is no such motion"
        } else {
            ""
        };
        let mut text = format!("{}, steady motion `{}`: `.` no eigenvalue right of the axis, `#` unstable, by eigenvalues on a grid{blank}\n\n", self.name, self.motion);
        for line in (0..=HEIGHT).rev() {
            let row = line * self.side / HEIGHT;
            let head = match line {
                HEIGHT => format!("{} = {}", y.name, y.high.to_f64().value()),
                0 => format!("{} = {}", y.name, y.low.to_f64().value()),
                _ => String::new(),
            };
            let mark = |c: usize| match self.kind_at(c * self.side / WIDTH, row) {
                Kind::Stable => '.',
                Kind::Unstable => '#',
                Kind::NoMotion => ' ',
            };
            let marks: String = (0..=WIDTH).map(mark).collect();
            let _ = writeln!(text, "{head:>14} {marks}");
        }
        let ends = (x.low.to_f64().value(), x.high.to_f64().value());
        let _ = writeln!(text, "{:>14} {} = {} to {}\n", "", x.name, ends.0, ends.1);
        for curve in &self.curves {
            let what = curve.what();
            let (Some(a), Some(b)) = (curve.points.first(), curve.points.last()) else {
                continue;
            };
            let _ = writeln!(
                text,
                "boundary from ({:.9}, {:.9}) to ({:.9}, {:.9}), {} places: {what}",
                a.0,
                a.1,
                b.0,
                b.1,
                curve.points.len()
            );
        }
        for own in &self.equations {
            let what = match own.kind {
                "pair" => "pairs pass where boundaries are zeros of",
                "collision" => "two pairs meet where boundaries are zeros of",
                "opposite" => "two eigenvalues are opposite, and the stability is the same on both sides, on zeros of",
                "infinity" => "an eigenvalue goes to infinity on zeros of",
                _ => "eigenvalues are zero on zeros of",
            };
            let _ = writeln!(text, "{what} {}", own.function);
        }
        text
    }

    /// The map as JSON: growth over the grid, boundaries, their equations.
    pub fn json(&self) -> Value {
        let number = |x: f64| if x.is_finite() { json!(x) } else { Value::Null };
        let rows = self.growth.chunks_exact(self.side + 1);
        let rows = rows.map(|row| row.iter().map(|x| number(*x)).collect::<Vec<_>>());
        let range = |own: &Range| json!({"parameter": own.name, "from": own.low.to_f64().value(), "to": own.high.to_f64().value()});
        json!({
            "system": self.name,
            "motion": self.motion,
            "evidence": "numerical",
            "ranges": self.ranges.iter().map(range).collect::<Vec<_>>(),
            "growth": rows.collect::<Vec<_>>(),
            "has_motion": self.kinds.chunks_exact(self.side + 1).map(|row| row.iter().map(|own| *own != Kind::NoMotion).collect::<Vec<_>>()).collect::<Vec<_>>(),
            "boundaries": self.curves.iter().map(|own| json!({
                "kind": own.kind,
                "points": own.points.iter().map(|(x, y)| json!([x, y])).collect::<Vec<_>>(),
            })).collect::<Vec<_>>(),
            "equations": self.equations.iter().map(|own| json!({"kind": own.kind, "function": own.function, "rounded": own.is_rounded})).collect::<Vec<_>>(),
        })
    }
}

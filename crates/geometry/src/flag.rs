//! What a distribution generates by brackets: its flag, with the values that a function's derivatives along it force on the brackets.
//!
//! The fields live on (t, q). With `D¹ = span E_a` and `D^{j+1} = D^j + [D¹, D^j]` the generic ranks are the growth vector; where
//! they reach the dimension, any two places are joined by admissible curves (Chow 1939, Rashevskii 1938). A function σ with
//! `E_a σ = c_a` has `[E_a, E_b] σ = E_a c_b - E_b c_a`; it exists near almost every point exactly when these values agree wherever a
//! bracket is a combination of fields already there. It is enough to look at brackets with the fields of D¹: the others follow
//! from these by Jacobi's identity.

use chetaev_mechanics::characteristics::derive_along;
use chetaev_mechanics::{Characteristics, Context, Manifold, System};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// A field on (t, q) with the derivative of σ along it.
#[derive(Clone, Debug)]
pub struct Directed {
    /// dt of the field: zero or one, or zero for brackets.
    pub time: Expr,
    /// The components along the coordinates, and after them along masses with a law of their own, where these are looked at.
    pub place: Vec<Expr>,
    /// The derivative of σ along the field; zero where there is no σ in question.
    pub value: Expr,
}

/// Why a flag is not known.
#[derive(Clone, Debug)]
pub enum Obstacle {
    /// A sentence.
    Undecided(String),
    /// The values contradict each other: a determinant that would vanish, with the verdict that it does not.
    Contradiction(Box<Verdict>),
}

/// The fields generated, with the number of those of each step.
#[derive(Clone, Debug)]
pub struct Flag {
    /// Independent fields, those of D¹ first.
    pub fields: Vec<Directed>,
    /// The growth vector.
    pub growth: Vec<usize>,
    /// The verdicts on the ranks.
    pub verdict: Verdict,
}

/// The fields Y_i of constraints affine in the velocities, on (t, q), and Y_0.
///
/// # Errors
/// A sentence that says why there are none.
pub fn horizontal(
    system: &System,
    chart: &Characteristics,
) -> Result<(Vec<Directed>, Directed), String> {
    let g = &system.graph;
    let speeds: Vec<Expr> = chart.parameters.iter().map(|p| p.value).collect();
    let own: Vec<_> = chart.parameters.iter().map(|p| p.symbol).collect();
    let entries = chart.basis.concat();
    if chart.implicit().next().is_some() || g.any_contains_any(&entries, &own) {
        return Err("the constraints are not affine in the velocities".into());
    }
    let at_rest: Vec<(Expr, Expr)> = speeds.iter().map(|&s| (s, g.zero())).collect();
    let fields = (0..chart.k())
        .map(|i| Directed {
            time: g.zero(),
            place: chart.column(i),
            value: g.zero(),
        })
        .collect();
    let drift = Directed {
        time: g.one(),
        place: g.substitute_all(&chart.velocities, &at_rest),
        value: g.zero(),
    };
    Ok((fields, drift))
}

/// `[U, V]` with `[U, V] σ`.
pub fn bracket(system: &System, u: &Directed, v: &Directed) -> Directed {
    let g = &system.graph;
    let with = |field: &Directed| {
        let mut all = field.place.clone();
        all.push(field.value);
        all
    };
    let along = |field: &Directed, es: &[Expr]| {
        let (place, masses) = field.place.split_at(system.n());
        let symbols = system.masses.iter().map(|m| m.symbol);
        let masses: Vec<(Symbol, Expr)> = symbols.zip(masses.iter().copied()).collect();
        derive_along(system, es, place, field.time, &masses)
    };
    let forward = along(u, &with(v));
    let backward = along(v, &with(u));
    let mut place: Vec<Expr> = forward
        .into_iter()
        .zip(backward)
        .map(|(a, b)| g.sub(a, b))
        .collect();
    let value = place.pop().unwrap_or(g.zero());
    Directed {
        time: g.zero(),
        place,
        value,
    }
}

/// The row of a field in a matrix whose rank is asked for.
fn row(field: &Directed, with_time: bool, with_value: bool) -> Vec<Expr> {
    let mut row = Vec::new();
    row.extend(with_time.then_some(field.time));
    row.extend(&field.place);
    row.extend(with_value.then_some(field.value));
    row
}

/// How many brackets are formed at most.
const BRACKETS: usize = 60;

/// The nodes that a field may have which is differentiated once more: brackets of long fields grow by a factor at each step.
const NODES: usize = 20_000;

impl Flag {
    /// The flag of fields; `with_time` where they live on (t, q) and not on q alone, `valued` where σ is looked for.
    ///
    /// # Errors
    /// [`Obstacle`].
    pub fn of(
        cx: &Context<'_>,
        generators: &[Directed],
        with_time: bool,
        valued: bool,
    ) -> Result<Flag, Obstacle> {
        let mut growing = Growing::new(cx, generators, with_time, valued);
        for field in generators {
            growing.take(field.clone())?;
        }
        let mut growth = vec![growing.fields.len()];
        let (mut first, mut formed) = (0, 0);
        loop {
            let last = growing.fields.len();
            for place in first..last {
                for (number, generator) in generators.iter().enumerate() {
                    if place <= number && first == 0 {
                        continue;
                    }
                    formed += 1;
                    if formed > BRACKETS || cx.is_out_of_time() {
                        let tried = format!("{BRACKETS} brackets or the time were spent");
                        return Err(Obstacle::Undecided(tried));
                    }
                    let field = &growing.fields[place];
                    let size = cx.system.graph.reachable(&row(field, true, valued)).len();
                    if size > NODES {
                        let ranks: Vec<String> = growth.iter().map(usize::to_string).collect();
                        let tried = format!(
                            "after the ranks {} a bracket has {size} nodes, more than {NODES}",
                            ranks.join(", ")
                        );
                        return Err(Obstacle::Undecided(tried));
                    }
                    let next = bracket(cx.system, generator, field);
                    growing.take(next)?;
                }
            }
            if growing.fields.len() == last {
                break;
            }
            growth.push(growing.fields.len());
            first = last;
        }
        Ok(Flag {
            verdict: growing.verdict(),
            fields: growing.fields,
            growth,
        })
    }
}

/// The ranks of the derived flag: of D, of D + [D, D], and so on with brackets of all fields at each step. Those of the Pfaff system of the
/// forms that vanish on D are what is missing.
///
/// # Errors
/// [`Obstacle`].
pub fn derived(
    cx: &Context<'_>,
    generators: &[Directed],
    with_time: bool,
) -> Result<Vec<usize>, Obstacle> {
    let mut growing = Growing::new(cx, generators, with_time, false);
    for field in generators {
        growing.take(field.clone())?;
    }
    let (mut ranks, mut first, mut formed) = (vec![growing.fields.len()], 0, 0);
    loop {
        let last = growing.fields.len();
        let pairs = (first..last).flat_map(|i| (0..i).map(move |j| (i, j)));
        for (i, j) in pairs {
            formed += 1;
            let (u, v) = (&growing.fields[j], &growing.fields[i]);
            let graph = &cx.system.graph;
            let size = [u, v].map(|f| graph.reachable(&row(f, true, false)).len());
            if formed > BRACKETS || cx.is_out_of_time() || size.iter().any(|&s| s > NODES) {
                return Err(Obstacle::Undecided("the work was spent".into()));
            }
            let next = bracket(cx.system, u, v);
            growing.take(next)?;
        }
        if growing.fields.len() == last {
            return Ok(ranks);
        }
        ranks.push(growing.fields.len());
        first = last;
    }
}

struct Growing<'c, 'a> {
    cx: &'c Context<'a>,
    with_time: bool,
    valued: bool,
    fields: Vec<Directed>,
    independent: Option<Verdict>,
    dependent: Vec<Verdict>,
    full: usize,
}

impl<'c, 'a> Growing<'c, 'a> {
    fn new(
        cx: &'c Context<'a>,
        generators: &[Directed],
        with_time: bool,
        valued: bool,
    ) -> Growing<'c, 'a> {
        Growing {
            cx,
            with_time,
            valued,
            fields: Vec::new(),
            independent: None,
            dependent: Vec::new(),
            full: generators.first().map_or(0, |f| f.place.len()) + usize::from(with_time),
        }
    }

    /// All that was found of ranks.
    fn verdict(&self) -> Verdict {
        let all = self.independent.iter().chain(&self.dependent).cloned();
        let none = Verdict::undecided("there are no fields");
        let mut verdict = all.reduce(Verdict::and).unwrap_or(none);
        // What is said of each bracket that adds nothing is the same but for figures.
        if let (Verdict::Proved(proof), [first, _, ..]) = (&mut verdict, &self.dependent[..]) {
            let independent = self.independent.iter().map(|v| v.detail().to_owned());
            let many = self.dependent.len();
            let last = format!(
                "{many} brackets add nothing, the first by {}",
                first.detail()
            );
            let parts: Vec<String> = independent.chain([last]).collect();
            proof.detail = parts.join("; ");
        }
        verdict
    }

    /// Adds a field that is independent of those before; looks at the value of one that is not.
    fn take(&mut self, field: Directed) -> Result<(), Obstacle> {
        let g = &self.cx.system.graph;
        let is_zero = field.place.iter().all(|&e| g.is_zero(e)) && g.is_zero(field.time);
        let count = self.fields.len();
        let independent = !is_zero && count < self.full && self.rank(&field, false)?.0 > count;
        if independent {
            self.fields.push(field);
            return Ok(());
        }
        if !self.valued || (is_zero && g.is_zero(field.value)) {
            return Ok(());
        }
        let (rank, columns) = self.rank(&field, true)?;
        match rank > count {
            false => Ok(()),
            true => Err(self.contradiction(&field, &columns)),
        }
    }

    /// The rank with one more field, and independent columns.
    fn rank(&mut self, field: &Directed, valued: bool) -> Result<(usize, Vec<usize>), Obstacle> {
        let all = self.fields.iter().chain([field]);
        let matrix: Vec<Vec<Expr>> = all.map(|f| row(f, self.with_time, valued)).collect();
        let cx = self.cx;
        let rank = cx
            .prover
            .rank(cx.system, &matrix, &Manifold::default())
            .map_err(|verdict| Obstacle::Undecided(verdict.detail().to_owned()))?;
        // That a set is independent is proved once, for all of it.
        if rank.maximum < matrix.len() {
            self.dependent.push(rank.at_most);
        } else if rank.minimum == rank.maximum {
            self.independent = Some(rank.at_least);
        } else {
            self.independent = Some(self.at_a_point(&matrix, &rank.pivots.columns)?);
        }
        Ok((rank.maximum, rank.pivots.columns))
    }

    /// Roots in the fields may have relations, as √(3 - 2√2) = √2 - 1: over a prime field they have either sign, and the rank differs. A real
    /// point decides.
    fn at_a_point(&self, matrix: &[Vec<Expr>], columns: &[usize]) -> Result<Verdict, Obstacle> {
        let cx = self.cx;
        let minor = matrix
            .iter()
            .map(|row| columns.iter().map(|&c| row[c]).collect());
        let minor: Vec<Vec<Expr>> = minor.collect();
        let what = "a minor of the fields and their brackets";
        let found = cx
            .prover
            .determinant_at_a_point(cx.system, &minor, &Manifold::default(), what);
        match found {
            Some(verdict @ Verdict::Proved(_)) => Ok(verdict),
            _ => Err(Obstacle::Undecided(
                "the rank of the fields depends on the signs of roots that occur, and no real point was found that decides".into(),
            )),
        }
    }

    /// The minor that would vanish if the values agreed.
    fn contradiction(&self, field: &Directed, columns: &[usize]) -> Obstacle {
        let cx = self.cx;
        let all = self.fields.iter().chain([field]);
        let matrix: Vec<Vec<Expr>> = all
            .map(|f| {
                let row = row(f, self.with_time, true);
                columns.iter().map(|&c| row[c]).collect()
            })
            .collect();
        if matrix.len() > 7 || columns.len() != matrix.len() {
            return Obstacle::Undecided("the brackets contradict each other modulo a prime".into());
        }
        let minor = determinant(&cx.system.graph, &matrix);
        let on = "in the coordinates";
        let verdict = cx
            .prover
            .identity(cx.system, &[minor], &Manifold::default(), on);
        Obstacle::Contradiction(Box::new(verdict))
    }
}

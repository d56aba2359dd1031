//! Functions kept by fields whose brackets are combinations of them, by quadratures.
//!
//! Where m fields on N variables are in involution, N - m functions are kept. The fields are solved for dependent variables, which gives
//! forms `dw = Σ a_i dx_i`. One of them is integrated where w alone of the dependent variables occurs in it: if it is exact, linear in w,
//! or separable. Then w is eliminated by the constant that it is integrated with, and the same is done with the other forms on the leaf;
//! in what is found constants are replaced by the functions that they are values of. Antiderivatives may miss something, so every
//! function is proved by whoever asks.

use super::primitive::{expanded, primitive, tidy};
use crate::noether::shown::is_constant;
use chetaev_mechanics::System;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::rational::content;
use chetaev_symbolic::{Expr, Function, Graph, Node, Rational, Symbol};

/// The most choices of dependent variables.
const CHOICES: usize = 24;

/// Fields with larger components, in nodes, are not looked at.
const NODES: usize = 400;

/// A variable of the space.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Variable {
    /// The time, with the controls.
    Time,
    /// A coordinate.
    Place(Symbol),
}

/// Fields with their variables.
pub(super) struct Fields<'a> {
    /// The system whose variables they are.
    pub(super) system: &'a System,
    /// One for each column of the rows; those are wanted as dependent ones first that stand first in `preferred`.
    pub(super) variables: Vec<Variable>,
    /// The components of the fields.
    pub(super) rows: Vec<Vec<Expr>>,
    /// Places of the variables in the order in which they are wanted as dependent ones.
    pub(super) preferred: Vec<Variable>,
}

/// One function found.
struct Quadrature {
    function: Expr,
    variable: Variable,
    /// The variable by the others and the value of the function, where that was solved.
    solved: Option<Expr>,
}

/// `dw = Σ a_i dx_i`.
struct Form {
    of: Variable,
    slopes: Vec<(Variable, Expr)>,
}

impl Fields<'_> {
    /// Functions that the fields keep, as many as were found; `is_kept` proves one.
    pub(super) fn integrals(mut self, is_kept: &dyn Fn(Expr) -> bool) -> Vec<Expr> {
        let system = self.system;
        let g = &system.graph;
        let (mut found, mut constants): (Vec<Expr>, Vec<(Expr, Expr)>) = (Vec::new(), Vec::new());
        while self.variables.len() > self.rows.len() {
            let value = g.symbol(&format!("kept[{}]", found.len()), 0);
            let Some(next) = self.next(value) else {
                break;
            };
            let function = g.substitute(next.function, &constants);
            let shown = presented(system, function);
            if !is_kept(shown) {
                break;
            }
            found.push(shown);
            let Some(solved) = next.solved else {
                break;
            };
            constants.push((value, function));
            self.eliminate(next.variable, solved);
        }
        found
    }

    /// Leaves out a variable that the others give.
    fn eliminate(&mut self, variable: Variable, value: Expr) {
        let g = &self.system.graph;
        let own = variable.expr(g);
        let Some(place) = self.variables.iter().position(|&v| v == variable) else {
            return;
        };
        self.variables.remove(place);
        self.preferred.retain(|&v| v != variable);
        for row in &mut self.rows {
            row.remove(place);
            let replaced = g.substitute_all(row, &[(own, value)]);
            *row = replaced.into_iter().map(|e| tidy(g, e)).collect();
        }
    }

    /// One function, with dependent variables for which there is one.
    fn next(&self, value: Expr) -> Option<Quadrature> {
        let count = self.variables.len() - self.rows.len();
        let choices = combinations(&self.preferred, count, CHOICES);
        for forms in choices.iter().filter_map(|own| self.solved_for(own)) {
            let is_constant = |form: &&Form| form.slopes.is_empty();
            let constant = forms.iter().find(is_constant);
            if let Some(form) = constant {
                return Some(Quadrature {
                    function: form.of.expr(&self.system.graph),
                    variable: form.of,
                    solved: Some(value),
                });
            }
            let found = forms
                .iter()
                .find_map(|form| self.integrated(form, &forms, value));
            if found.is_some() {
                return found;
            }
        }
        None
    }

    /// The forms for a choice of dependent variables, by elimination; `None` where the others are not independent on the fields.
    fn solved_for(&self, dependent: &[Variable]) -> Option<Vec<Form>> {
        let g = &self.system.graph;
        let mut rows = self.rows.clone();
        if g.reachable(&rows.concat()).len() > NODES {
            return None;
        }
        let places = 0..self.variables.len();
        let (own, others): (Vec<usize>, Vec<usize>) =
            places.partition(|&i| dependent.contains(&self.variables[i]));
        for (done, &column) in others.iter().enumerate() {
            let candidates = (done..rows.len()).filter(|&i| !g.is_zero(rows[i][column]));
            let pivot = candidates.min_by_key(|&i| g.reachable(&[rows[i][column]]).len())?;
            rows.swap(done, pivot);
            let by = rows[done][column];
            let unit: Vec<Expr> = rows[done].iter().map(|&e| tidy(g, g.div(e, by))).collect();
            for (i, row) in rows.iter_mut().enumerate() {
                let factor = row[column];
                if i == done || g.is_zero(factor) {
                    continue;
                }
                for (e, &u) in row.iter_mut().zip(&unit) {
                    *e = tidy(g, g.sub(*e, g.mul(&[factor, u])));
                }
            }
            rows[done] = unit;
            if g.reachable(&rows.concat()).len() > NODES {
                return None;
            }
        }
        let form = |&w: &usize| Form {
            of: self.variables[w],
            slopes: others
                .iter()
                .enumerate()
                .map(|(i, &x)| (self.variables[x], rows[i][w]))
                .filter(|(_, a)| !g.is_zero(*a))
                .collect(),
        };
        Some(own.iter().map(form).collect())
    }

    /// The form integrated, where no other dependent variable occurs in it.
    fn integrated(&self, form: &Form, all: &[Form], value: Expr) -> Option<Quadrature> {
        let others = all.iter().map(|f| f.of).filter(|&w| w != form.of);
        for other in others {
            if form.slopes.iter().any(|&(_, a)| self.contains(a, other)) {
                return None;
            }
        }
        // The time is no variable to be solved for where controls are functions of it.
        let Variable::Place(w) = form.of else {
            return None;
        };
        self.exact_or_linear(form, w, value)
            .or_else(|| self.separated(form, w))
    }

    /// `dw = (p_i w + q_i) dx_i`: kept is `w exp(-∫p) - ∫ q exp(-∫p)`.
    fn exact_or_linear(&self, form: &Form, w: Symbol, value: Expr) -> Option<Quadrature> {
        let g = &self.system.graph;
        let own = g.symbol_expr(w);
        let split = form.slopes.iter().map(|&(x, a)| {
            let p = tidy(g, g.diff(a, w));
            let q = tidy(g, g.substitute(a, &[(own, g.zero())]));
            (!g.contains_any(p, &[w])).then_some((x, p, q))
        });
        let split: Vec<(Variable, Expr, Expr)> = split.collect::<Option<_>>()?;
        let rates: Vec<(Variable, Expr)> = split.iter().map(|&(x, p, _)| (x, p)).collect();
        let factor = exponential(g, g.neg(self.potential(&rates)?));
        let scaled = split.iter().map(|&(x, _, q)| (x, g.mul(&[q, factor])));
        let rest = self.potential(&scaled.collect::<Vec<_>>())?;
        Some(Quadrature {
            function: g.sub(g.mul(&[own, factor]), rest),
            variable: form.of,
            solved: Some(g.div(g.add(&[value, rest]), factor)),
        })
    }

    /// `dw = φ(w) b_i(x) dx_i`: kept is `∫ dw/φ - ∫ b`.
    fn separated(&self, form: &Form, w: Symbol) -> Option<Quadrature> {
        let g = &self.system.graph;
        let mut common: Option<Expr> = None;
        let mut rates = Vec::new();
        for &(x, a) in &form.slopes {
            let parts = factored(g, a)?;
            let with = parts
                .factors
                .iter()
                .filter(|(f, _)| g.contains_any(*f, &[w]));
            let own: Vec<Expr> = with.map(|&(f, n)| g.powi(f, n)).collect();
            let own = tidy(g, g.mul(&own));
            let is_of_place = |e: Expr| {
                let symbols = g.symbols_in(&[e]);
                let mut others = self.variables.iter().filter(|&&v| v != form.of);
                let is_time = |s: &Symbol| self.system.prescribed_rate(*s).is_some();
                !others.any(|&v| self.contains(e, v)) && !symbols.iter().any(is_time)
            };
            if !is_of_place(own) || common.is_some_and(|known| known != own) {
                return None;
            }
            common = Some(own);
            rates.push((x, tidy(g, g.div(a, own))));
        }
        let left = primitive(g, tidy(g, g.div(g.one(), common?)), w)?;
        Some(Quadrature {
            function: g.sub(left, self.potential(&rates)?),
            variable: form.of,
            solved: None,
        })
    }

    /// A function with these derivatives, where they belong together: by one variable after the other, the time last, as a control is a
    /// function of it.
    fn potential(&self, slopes: &[(Variable, Expr)]) -> Option<Expr> {
        let g = &self.system.graph;
        let mut ordered = slopes.to_vec();
        ordered.sort_by_key(|(x, _)| *x == Variable::Time);
        let mut sum = g.zero();
        let mut done: Vec<Variable> = Vec::new();
        for (x, slope) in ordered {
            let rest = tidy(g, g.sub(slope, self.derivative(sum, x)));
            done.push(x);
            if g.is_zero(rest) {
                continue;
            }
            if done.iter().any(|&v| v != x && self.contains(rest, v)) {
                return None;
            }
            let own = match x {
                Variable::Place(s) => s,
                Variable::Time => self.time_alone(rest)?,
            };
            sum = g.add(&[sum, primitive(g, rest, own)?]);
        }
        Some(sum)
    }

    /// The symbol of the time, where no control occurs.
    fn time_alone(&self, e: Expr) -> Option<Symbol> {
        let g = &self.system.graph;
        let symbols = g.symbols_in(&[e]);
        let t = g.intern_symbol("t", 0);
        let is_other = |s: &Symbol| *s != t && self.system.prescribed_rate(*s).is_some();
        (!symbols.iter().any(is_other)).then_some(t)
    }

    fn contains(&self, e: Expr, v: Variable) -> bool {
        match v {
            Variable::Time => self.system.is_rheonomic(e),
            Variable::Place(s) => self.system.graph.contains_any(e, &[s]),
        }
    }

    fn derivative(&self, e: Expr, by: Variable) -> Expr {
        match by {
            Variable::Time => self.system.time_derivative(e),
            Variable::Place(s) => self.system.graph.diff(e, s),
        }
    }
}

impl Variable {
    fn expr(self, g: &Graph) -> Expr {
        match self {
            Variable::Time => g.symbol("t", 0),
            Variable::Place(s) => g.symbol_expr(s),
        }
    }
}

/// Subsets of a size, those of the first elements first, at most so many.
fn combinations(all: &[Variable], size: usize, most: usize) -> Vec<Vec<Variable>> {
    if size == 0 {
        return vec![Vec::new()];
    }
    let mut found = Vec::new();
    for (i, &first) in all.iter().enumerate() {
        for mut rest in combinations(&all[i + 1..], size - 1, most - found.len()) {
            rest.insert(0, first);
            found.push(rest);
        }
        if found.len() >= most {
            break;
        }
    }
    found
}

/// The parts of a sum.
fn parts(g: &Graph, e: Expr) -> Vec<Expr> {
    match g.node(e) {
        Node::Sum { constant, terms } => {
            let own = terms.iter().map(|(term, c)| g.scale(c, *term));
            own.chain([g.number(constant.clone())]).collect()
        }
        _ => vec![e],
    }
}

/// The argument of a logarithm and what it is multiplied by.
fn logarithm(g: &Graph, e: Expr) -> Option<(Expr, Expr)> {
    let is_log = |f: Expr| match g.node(f) {
        Node::Apply {
            function: Function::Log,
            arguments,
        } => Some(arguments[0]),
        _ => None,
    };
    let factors = match g.node(e) {
        Node::Product { factors, .. } => factors.to_vec(),
        _ => vec![e],
    };
    let mut own = factors.iter().filter_map(|&f| Some((f, is_log(f)?)));
    let (log, argument) = own.next()?;
    Some((argument, g.div(e, log)))
}

/// `exp e`, logarithms in e as powers.
fn exponential(g: &Graph, e: Expr) -> Expr {
    let (mut factors, mut rest) = (Vec::new(), Vec::new());
    for part in parts(g, expanded(g, e)) {
        match logarithm(g, part) {
            Some((argument, c)) => factors.push(g.pow(argument, c)),
            None => rest.push(part),
        }
    }
    factors.push(g.exp(g.add(&rest)));
    g.mul(&factors)
}

/// A kept function as a person writes it: without logarithms where its exponential has none, without fractions, constant terms and constant
/// factors, and not with a minus in front.
fn presented(system: &System, e: Expr) -> Expr {
    let g = &system.graph;
    let e = tidy(g, e);
    let all = parts(g, e);
    let logs: Vec<Expr> = all
        .iter()
        .filter_map(|&part| logarithm(g, part).map(|(_, c)| c))
        .collect();
    let ratios = |by: Expr| {
        let own = logs.iter().map(|&c| g.as_number(g.div(c, by)).cloned());
        own.collect::<Option<Vec<Rational>>>()
    };
    if let Some((&first, ratios)) = logs
        .first()
        .and_then(|first| Some((first, ratios(*first)?)))
    {
        let unit = g.number(content(ratios.iter()));
        let whole = exponential(g, g.div(g.add(&all), g.mul(&[unit, first])));
        return tidy(g, whole);
    }
    let scaled = match g.node(e) {
        Node::Sum { terms, .. } => {
            let unit = content(terms.iter().map(|(_, c)| c));
            let own = terms
                .iter()
                .map(|(term, c)| g.scale(&(c.clone() / unit.clone()), *term));
            tidy(g, g.add(&own.collect::<Vec<Expr>>()))
        }
        Node::Product { factors, .. } => {
            let own = factors.iter().copied();
            g.mul(
                &own.filter(|&f| !is_constant(system, f))
                    .collect::<Vec<Expr>>(),
            )
        }
        _ => e,
    };
    match g.text(scaled).starts_with('-') {
        true => g.neg(scaled),
        false => scaled,
    }
}

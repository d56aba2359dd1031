//! Functions kept by fields whose brackets are combinations of them, by quadratures.
//!
//! Where m fields on N variables are in involution, N - m functions are kept. The fields are solved for dependent variables, which gives
//! forms `dw = Σ a_i dx_i`. One of them is integrated where w alone of the dependent variables occurs in it: if it is exact, linear in w
//! or in a function of w, separable, or has a symmetry (see [`substitution`](super::substitution)); several together where they are linear
//! with constant coefficients (see [`eigenvectors`](super::eigenvectors)). Then w is eliminated by the constant that it is integrated with,
//! where that is solved for w, and the same is done with the other forms on the leaf; in what is found constants are replaced by the
//! functions that they are values of. Antiderivatives may miss something, so every function is proved by whoever asks.

use super::presented::{exponential, presented};
use super::primitive::{primitive, tidy};
use super::solved::{has_value, is_independent, solved};
use crate::noether::motion::Motion;
use chetaev_mechanics::System;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::{Expr, Graph, Symbol};

/// The most choices of dependent variables.
const CHOICES: usize = 24;

/// Of so many choices symmetries and eigenvectors are looked for.
const CHOICES_OF_SYMMETRY: usize = 4;

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
    /// The motion of the system whose variables they are.
    pub(super) motion: &'a Motion<'a>,
    /// Where random points begin.
    pub(super) seed: u64,
    /// Whether the time is spent.
    pub(super) is_out_of_time: &'a dyn Fn() -> bool,
    /// One for each column of the rows; those are wanted as dependent ones first that stand first in `preferred`.
    pub(super) variables: Vec<Variable>,
    /// The components of the fields.
    pub(super) rows: Vec<Vec<Expr>>,
    /// Places of the variables in the order in which they are wanted as dependent ones.
    pub(super) preferred: Vec<Variable>,
}

/// Functions found together.
pub(super) struct Quadrature {
    /// What is kept.
    pub(super) functions: Vec<Expr>,
    /// The dependent variables whose forms were integrated.
    pub(super) variables: Vec<Variable>,
    /// What was solved for them.
    pub(super) solved: Option<Solved>,
}

/// Dependent variables by the others and by constants.
pub(super) struct Solved {
    /// Constants, each with the function that it is a value of.
    pub(super) constants: Vec<(Expr, Expr)>,
    /// One for each dependent variable.
    pub(super) values: Vec<Expr>,
}

/// `dw = Σ a_i dx_i`.
#[derive(Clone)]
pub(super) struct Form {
    pub(super) of: Variable,
    pub(super) slopes: Vec<(Variable, Expr)>,
}

/// A way to integrate one form in a symbol that stands in it, with a constant for what is kept.
type Method<'a> = fn(&Fields<'a>, &Form, Symbol, Expr) -> Option<Quadrature>;

impl Quadrature {
    /// One function of one variable, with the variable by the value of the function where that was solved.
    pub(super) fn one(
        variable: Variable,
        function: Expr,
        value: Expr,
        solved: Option<Expr>,
    ) -> Quadrature {
        Quadrature {
            functions: vec![function],
            variables: vec![variable],
            solved: solved.map(|own| Solved {
                constants: vec![(value, function)],
                values: vec![own],
            }),
        }
    }
}

impl<'a> Fields<'a> {
    /// The system whose variables they are.
    pub(super) fn system(&self) -> &'a System {
        self.motion.system
    }

    /// Functions that the fields keep, as many as were found; `is_kept` proves one.
    pub(super) fn integrals(mut self, is_kept: &dyn Fn(Expr) -> bool) -> Vec<Expr> {
        let system = self.system();
        let g = &system.graph;
        let (mut found, mut constants): (Vec<Expr>, Vec<(Expr, Expr)>) = (Vec::new(), Vec::new());
        let mut spent: Vec<Variable> = Vec::new();
        while self.variables.len() > self.rows.len() + spent.len() && !(self.is_out_of_time)() {
            let Some(next) = self.next(constants.len(), &spent) else {
                break;
            };
            let whole = |e: Expr| g.substitute(e, &constants);
            let count = found.len();
            for function in next.functions.iter().map(|&e| whole(e)) {
                let shown = presented(system, function);
                let proved = [shown, function].into_iter().find(|&e| is_kept(e));
                found.extend(proved);
            }
            match next.solved {
                Some(own) if found.len() == count + next.functions.len() => {
                    let new = own.constants.iter().map(|&(value, e)| (value, whole(e)));
                    constants.extend(new.collect::<Vec<_>>());
                    for (&variable, &value) in next.variables.iter().zip(&own.values) {
                        self.eliminate(variable, value);
                    }
                }
                _ => spent.extend(next.variables),
            }
        }
        found
    }

    /// Leaves out a variable that the others give.
    fn eliminate(&mut self, variable: Variable, value: Expr) {
        let g = &self.system().graph;
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

    /// What is found next, by the plainest method that finds something for a choice of dependent variables; not for those `spent`, whose
    /// forms are integrated already.
    fn next(&self, count: usize, spent: &[Variable]) -> Option<Quadrature> {
        let g = &self.system().graph;
        let value = g.symbol(&format!("kept[{count}]"), 0);
        let size = self.variables.len() - self.rows.len();
        let choices = combinations(&self.preferred, size, CHOICES);
        let all = choices.iter();
        let all = all.filter(|own| spent.iter().all(|v| own.contains(v)));
        let all: Vec<Vec<Form>> = all.filter_map(|own| self.solved_for(own)).collect();
        let few = &all[..all.len().min(CHOICES_OF_SYMMETRY)];
        let single = |choices: &[Vec<Form>], method: Method<'a>| {
            choices.iter().find_map(|forms| {
                let mut own = forms.iter().filter(|form| !spent.contains(&form.of));
                own.find_map(|form| self.integrated(form, forms, value, method))
            })
        };
        single(&all, Self::exact_or_linear)
            .or_else(|| {
                few.iter()
                    .find_map(|own| self.linear_system(own, spent, count))
            })
            .or_else(|| single(&all, Self::separated))
            .or_else(|| single(&all, Self::linear_in_function))
            .or_else(|| single(few, Self::by_symmetry))
    }

    /// The forms for a choice of dependent variables, by elimination; `None` where the others are not independent on the fields.
    fn solved_for(&self, dependent: &[Variable]) -> Option<Vec<Form>> {
        let g = &self.system().graph;
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

    /// The form integrated by a method, where no other dependent variable occurs in it.
    fn integrated(
        &self,
        form: &Form,
        all: &[Form],
        value: Expr,
        method: Method<'a>,
    ) -> Option<Quadrature> {
        let mut others = all.iter().map(|f| f.of).filter(|&w| w != form.of);
        if others.any(|w| form.slopes.iter().any(|&(_, a)| self.contains(a, w))) {
            return None;
        }
        let g = &self.system().graph;
        match form.of {
            _ if form.slopes.is_empty() => {
                let own = form.of.expr(g);
                Some(Quadrature::one(form.of, own, value, Some(value)))
            }
            // The time is no variable to be solved for where controls are functions of it.
            Variable::Time => None,
            Variable::Place(w) => method(self, form, w, value),
        }
    }

    /// `dw = (p_i w + q_i) dx_i`: kept is `w exp(-∫p) - ∫ q exp(-∫p)`.
    pub(super) fn exact_or_linear(
        &self,
        form: &Form,
        w: Symbol,
        value: Expr,
    ) -> Option<Quadrature> {
        let g = &self.system().graph;
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
        let function = g.sub(g.mul(&[own, factor]), rest);
        let solved = g.div(g.add(&[value, rest]), factor);
        Some(Quadrature::one(form.of, function, value, Some(solved)))
    }

    /// `dw = φ(w) b_i(x) dx_i`: kept is `∫ dw/φ - ∫ b`.
    fn separated(&self, form: &Form, w: Symbol, value: Expr) -> Option<Quadrature> {
        let g = &self.system().graph;
        let (common, rates) = self
            .split_by_factors(form, w)
            .or_else(|| self.split_by_values(form, w))?;
        let left = primitive(g, tidy(g, g.div(g.one(), common)), w)?;
        let right = self.potential(&rates)?;
        let function = g.sub(left, right);
        let solved = solved(g, left, w, g.add(&[value, right]));
        match solved {
            Some(own) => Some(Quadrature::one(form.of, function, value, Some(own))),
            None => Some(self.as_solved(form.of, function, w, value)),
        }
    }

    /// A function found, with the variable by its value where that is solved for it as it stands, or as it is presented.
    pub(super) fn as_solved(
        &self,
        of: Variable,
        function: Expr,
        w: Symbol,
        value: Expr,
    ) -> Quadrature {
        let (system, g) = (self.system(), &self.system().graph);
        let all = [function, presented(system, function)].into_iter();
        let mut all = all.filter_map(|e| Some((e, solved(g, e, w, value)?)));
        match all.next() {
            Some((e, own)) => Quadrature::one(of, e, value, Some(own)),
            None => Quadrature::one(of, function, value, None),
        }
    }

    /// φ and b by the factors of the slopes.
    fn split_by_factors(&self, form: &Form, w: Symbol) -> Option<(Expr, Vec<(Variable, Expr)>)> {
        let g = &self.system().graph;
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
            if !self.is_of(own, form.of) || common.is_some_and(|known| known != own) {
                return None;
            }
            common = Some(own);
            rates.push((x, tidy(g, g.div(a, own))));
        }
        Some((common?, rates))
    }

    /// φ and b by the slopes at one value of w: `exp(x - w)` is `exp(-w)` times its value at zero.
    fn split_by_values(&self, form: &Form, w: Symbol) -> Option<(Expr, Vec<(Variable, Expr)>)> {
        let g = &self.system().graph;
        let own = g.symbol_expr(w);
        [0, 1].into_iter().find_map(|start| {
            let mut common: Option<Expr> = None;
            let mut rates = Vec::new();
            for &(x, a) in &form.slopes {
                let b = tidy(g, g.substitute(a, &[(own, g.integer(start))]));
                if !has_value(g, b) {
                    return None;
                }
                let ratio = g.div(a, b);
                let others = g.symbols_in(&[ratio]).into_iter();
                let others: Vec<Symbol> = others
                    .filter(|&s| s != w && self.system().moves(g.symbol_name(s)))
                    .collect();
                if !is_independent(g, ratio, &others) {
                    return None;
                }
                let ratio = tidy(g, ratio);
                if !self.is_of(ratio, form.of) || common.is_some_and(|known| known != ratio) {
                    return None;
                }
                common = Some(ratio);
                rates.push((x, b));
            }
            Some((common?, rates))
        })
    }

    /// Whether of the variables this one alone occurs, and not the time.
    fn is_of(&self, e: Expr, variable: Variable) -> bool {
        let symbols = self.system().graph.symbols_in(&[e]);
        let mut others = self.variables.iter().filter(|&&v| v != variable);
        let is_time = |s: &Symbol| self.system().prescribed_rate(*s).is_some();
        !others.any(|&v| self.contains(e, v)) && !symbols.iter().any(is_time)
    }

    /// A function with these derivatives, where they belong together: by one variable after the other, in this order or the other way
    /// round, the time last, as a control is a function of it.
    pub(super) fn potential(&self, slopes: &[(Variable, Expr)]) -> Option<Expr> {
        let mut ordered = slopes.to_vec();
        ordered.sort_by_key(|(x, _)| *x == Variable::Time);
        self.potential_by(&ordered).or_else(|| {
            ordered.reverse();
            ordered.sort_by_key(|(x, _)| *x == Variable::Time);
            (ordered.len() > 1).then(|| self.potential_by(&ordered))?
        })
    }

    fn potential_by(&self, slopes: &[(Variable, Expr)]) -> Option<Expr> {
        let g = &self.system().graph;
        let mut sum = g.zero();
        let mut done: Vec<Variable> = Vec::new();
        for &(x, slope) in slopes {
            let rest = tidy(g, g.sub(slope, self.derivative(sum, x)));
            let rest = self.without(rest, &done)?;
            done.push(x);
            if g.is_zero(rest) {
                continue;
            }
            let own = match x {
                Variable::Place(s) => s,
                Variable::Time => self.time_alone(rest)?,
            };
            sum = g.add(&[sum, primitive(g, rest, own)?]);
        }
        Some(sum)
    }

    /// An expression that does not depend on some variables without them.
    fn without(&self, e: Expr, variables: &[Variable]) -> Option<Expr> {
        let g = &self.system().graph;
        let left = variables.iter().filter(|&&v| self.contains(e, v));
        let left: Option<Vec<Symbol>> = left
            .map(|&v| match v {
                Variable::Place(s) => Some(s),
                Variable::Time => None,
            })
            .collect();
        let left = left?;
        if left.is_empty() {
            return Some(e);
        }
        if !is_independent(g, e, &left) {
            return None;
        }
        let ones = left.iter().map(|&s| (g.symbol_expr(s), g.one()));
        Some(tidy(g, g.substitute(e, &ones.collect::<Vec<_>>())))
    }

    /// The symbol of the time, where no control occurs.
    fn time_alone(&self, e: Expr) -> Option<Symbol> {
        let g = &self.system().graph;
        let symbols = g.symbols_in(&[e]);
        let t = g.intern_symbol("t", 0);
        let is_other = |s: &Symbol| *s != t && self.system().prescribed_rate(*s).is_some();
        (!symbols.iter().any(is_other)).then_some(t)
    }

    /// Whether a variable occurs in an expression.
    pub(super) fn contains(&self, e: Expr, v: Variable) -> bool {
        match v {
            Variable::Time => self.system().is_rheonomic(e),
            Variable::Place(s) => self.system().graph.contains_any(e, &[s]),
        }
    }

    /// The derivative by a variable.
    pub(super) fn derivative(&self, e: Expr, by: Variable) -> Expr {
        match by {
            Variable::Time => self.system().time_derivative(e),
            Variable::Place(s) => self.system().graph.diff(e, s),
        }
    }
}

impl Variable {
    /// The variable as an expression.
    pub(super) fn expr(self, g: &Graph) -> Expr {
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

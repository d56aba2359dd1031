//! Forms that are linear with constant coefficients: `dw = (M w β_i + h_i) dx_i` with a matrix M of constants.
//!
//! For `c M = λ c` the form `u = c·w` has `du = (λ β_i u + c·h_i) dx_i`, which is linear in u alone. For a pair of complex eigenvalues
//! `λ = μ ± iν` and `c·w = P + iQ` what is kept of homogeneous forms is `(P² + Q²) exp(-2μB)` and `atan2(Q, P) - νB` with `dB = β_i dx_i`.

use super::presented::is_fixed;
use super::primitive::tidy;
use super::quadrature::{Fields, Form, Quadrature, Solved, Variable};
use super::solved::root;
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::System;
use chetaev_symbolic::factors::{coefficients, factors};
use chetaev_symbolic::matrix::{determinant, inverse, null_space};
use chetaev_symbolic::quadratic_factors::linear_and_quadratic;
use chetaev_symbolic::rational::content;
use chetaev_symbolic::simplify::length;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Function, Graph, Node, Rational, Symbol};

/// The most forms together.
const LARGEST: usize = 4;

/// Forms that depend on each other's variables alone.
struct Block {
    variables: Vec<Symbol>,
    matrix: Vec<Vec<Expr>>,
    /// β_i.
    rates: Vec<(Variable, Expr)>,
    /// h_i, one for each variable.
    rest: Vec<(Variable, Vec<Expr>)>,
}

/// A real eigenvalue, or the real and the imaginary part of a pair.
enum Eigenvalue {
    Real(Expr),
    Pair(Expr, Expr),
}

/// What an eigenvalue gives.
struct Part {
    functions: Vec<Expr>,
    /// Constants with the functions that they are values of.
    constants: Vec<(Expr, Expr)>,
    /// Linear functions of the variables with their values.
    rows: Vec<(Vec<Expr>, Expr)>,
}

impl Fields<'_> {
    /// What is kept by eigenvectors of forms that are linear together with constant coefficients.
    pub(super) fn linear_system(
        &self,
        forms: &[Form],
        spent: &[Variable],
        count: usize,
    ) -> Option<Quadrature> {
        let g = &self.system().graph;
        forms.iter().find_map(|form| {
            let block = self.block(form, forms, spent)?;
            let mut parts: Vec<Part> = Vec::new();
            for value in block.eigenvalues(self)? {
                let done: usize = parts.iter().map(|part| part.rows.len()).sum();
                let constant = |i: usize| g.symbol(&format!("kept[{}]", count + done + i), 0);
                parts.extend(match value {
                    Eigenvalue::Real(own) => self.along_real(&block, own, constant(0)),
                    Eigenvalue::Pair(re, im) => {
                        self.along_pair(&block, (re, im), [constant(0), constant(1)])
                    }
                });
            }
            block.together(g, parts)
        })
    }

    /// The forms on which this one depends, where they are linear with constant coefficients.
    fn block(&self, form: &Form, forms: &[Form], spent: &[Variable]) -> Option<Block> {
        let g = &self.system().graph;
        let mut own = vec![form];
        let mut done = 0;
        while let Some(&next) = own.get(done) {
            done += 1;
            let occurs = |f: &&Form| next.slopes.iter().any(|&(_, a)| self.contains(a, f.of));
            for other in forms.iter().filter(occurs) {
                if !own.iter().any(|f| f.of == other.of) {
                    own.push(other);
                }
            }
        }
        if !(2..=LARGEST).contains(&own.len()) || own.iter().any(|f| spent.contains(&f.of)) {
            return None;
        }
        let symbol = |f: &&Form| match f.of {
            Variable::Place(s) => Some(s),
            Variable::Time => None,
        };
        let variables: Vec<Symbol> = own.iter().map(symbol).collect::<Option<_>>()?;
        let zeros: Vec<(Expr, Expr)> = variables
            .iter()
            .map(|&s| (g.symbol_expr(s), g.zero()))
            .collect();
        let (mut matrix, mut rates, mut rest) = (None, Vec::new(), Vec::new());
        for x in self.independent(&own) {
            let slopes = own.iter().map(|f| f.slope(g, x));
            let slopes: Vec<Expr> = slopes.collect();
            let entries = |&a: &Expr| -> Vec<Expr> {
                let by = variables.iter().map(|&w| tidy(g, g.diff(a, w)));
                by.collect()
            };
            let linear: Vec<Vec<Expr>> = slopes.iter().map(entries).collect();
            if g.any_contains_any(&linear.concat(), &variables) {
                return None;
            }
            let free = g.substitute_all(&slopes, &zeros);
            rest.push((x, free.into_iter().map(|e| tidy(g, e)).collect()));
            if linear.concat().iter().all(|&e| g.is_zero(e)) {
                continue;
            }
            rates.push((x, self.as_multiple(&linear, &mut matrix)?));
        }
        Some(Block {
            variables,
            matrix: matrix?,
            rates,
            rest,
        })
    }

    /// The variables by whose differentials the forms are given.
    fn independent(&self, forms: &[&Form]) -> Vec<Variable> {
        let mut found: Vec<Variable> = Vec::new();
        for &(x, _) in forms.iter().flat_map(|f| &f.slopes) {
            if !found.contains(&x) {
                found.push(x);
            }
        }
        found
    }

    /// What a matrix is a multiple of the known one by; the first becomes known, by one of its entries, if its ratios are constant.
    fn as_multiple(
        &self,
        linear: &[Vec<Expr>],
        matrix: &mut Option<Vec<Vec<Expr>>>,
    ) -> Option<Expr> {
        let g = &self.system().graph;
        let all = linear.concat();
        let over = |by: Expr| -> Vec<Vec<Expr>> {
            let rows = linear.iter();
            let rows = rows.map(|row| row.iter().map(|&e| tidy(g, g.div(e, by))).collect());
            rows.collect()
        };
        let by = match &*matrix {
            None if all.iter().all(|&e| is_fixed(self.system(), e)) => g.one(),
            None => {
                let first = *all.iter().find(|&&e| !g.is_zero(e))?;
                match g.text(first).starts_with('-') {
                    true => g.neg(first),
                    false => first,
                }
            }
            Some(known) => {
                let known = known.concat();
                let (&e, &unit) = all.iter().zip(&known).find(|(_, &k)| !g.is_zero(k))?;
                tidy(g, g.div(e, unit))
            }
        };
        if g.is_zero(by) {
            return None;
        }
        let scaled = over(by);
        if !scaled.concat().iter().all(|&e| is_fixed(self.system(), e)) {
            return None;
        }
        let known = matrix.get_or_insert_with(|| scaled.clone());
        (*known == scaled).then_some(by)
    }

    /// `c·w` for a real eigenvalue.
    fn along_real(&self, block: &Block, value: Expr, constant: Expr) -> Option<Part> {
        let g = &self.system().graph;
        let vector = null_vector(g, &block.transposed_less(g, value))?;
        let u = g.symbol("part[w]", 0);
        let slopes = block.rest.iter().map(|(x, own)| {
            let rate = block.rates.iter().find(|(y, _)| y == x);
            let rate = rate.map_or(g.zero(), |&(_, beta)| g.mul(&[value, beta, u]));
            (*x, g.add(&[rate, dot(g, &vector, own)]))
        });
        let form = Form {
            of: Variable::Place(*block.variables.first()?),
            slopes: slopes.collect(),
        };
        let found = self.exact_or_linear(&form, g.as_symbol(u)?, constant)?;
        let combined = dot(g, &vector, &block.places(g));
        let function = g.substitute(found.functions[0], &[(u, combined)]);
        Some(Part {
            functions: vec![function],
            constants: vec![(constant, function)],
            rows: vec![(vector, found.solved?.values[0])],
        })
    }

    /// The two functions of a pair of eigenvalues.
    fn along_pair(
        &self,
        block: &Block,
        (re, im): (Expr, Expr),
        constants: [Expr; 2],
    ) -> Option<Part> {
        let g = &self.system().graph;
        let places = block.places(g);
        let [c, d] = block.pair(g, re, im)?;
        // That of the other eigenvalue where it is written without a minus.
        let is_other = g.text(tidy(g, dot(g, &d, &places))).starts_with('-');
        let (d, im) = match is_other {
            true => (d.into_iter().map(|e| g.neg(e)).collect(), g.neg(im)),
            false => (d, im),
        };
        let length = self.potential(&block.rates)?;
        let turned = g.mul(&[im, length]);
        let shrinks = g.exp(g.neg(g.mul(&[re, length])));
        let turn = |a: Expr, b: Expr, sin: Expr| {
            let cos = g.cos(turned);
            let own = g.sub(g.mul(&[cos, a]), g.mul(&[sin, b]));
            [own, g.add(&[g.mul(&[sin, a]), g.mul(&[cos, b])])]
        };
        let sin = g.sin(turned);
        // exp(-λB) (a + ib).
        let back = |a: Expr, b: Expr| turn(a, b, g.neg(sin)).map(|e| g.mul(&[shrinks, e]));
        let forcing = block.rest.iter();
        let forcing = forcing.map(|(x, own)| (*x, back(dot(g, &c, own), dot(g, &d, own))));
        let forcing: Vec<(Variable, [Expr; 2])> = forcing.collect();
        let integral = |i: usize| {
            let own = forcing.iter().map(|&(x, pair)| (x, pair[i]));
            self.potential(&own.collect::<Vec<_>>())
        };
        let integrals = [integral(0)?, integral(1)?];
        let (p, q) = (dot(g, &c, &places), dot(g, &d, &places));
        let own = back(p, q);
        let kept = [0, 1].map(|i| g.sub(own[i], integrals[i]));
        // exp(λB) (a + ib) with what is kept.
        let [a, b] = [0, 1].map(|i| g.add(&[constants[i], integrals[i]]));
        let [first, second] = turn(a, b, sin).map(|e| g.div(e, shrinks));
        let is_homogeneous = integrals.iter().all(|&e| g.is_zero(e));
        let functions = match is_homogeneous {
            true => {
                let square = tidy(g, g.add(&[g.powi(p, 2), g.powi(q, 2)]));
                let angle = g.apply(Function::Atan2, &[q, p]);
                vec![g.mul(&[square, g.powi(shrinks, 2)]), g.sub(angle, turned)]
            }
            false => kept.to_vec(),
        };
        Some(Part {
            functions,
            constants: constants.into_iter().zip(kept).collect(),
            rows: vec![(c, first), (d, second)],
        })
    }
}

impl Form {
    fn slope(&self, g: &Graph, by: Variable) -> Expr {
        let own = self.slopes.iter().find(|(x, _)| *x == by);
        own.map_or(g.zero(), |&(_, a)| a)
    }
}

impl Block {
    fn places(&self, g: &Graph) -> Vec<Expr> {
        self.variables.iter().map(|&w| g.symbol_expr(w)).collect()
    }

    /// `Mᵀ - λ`.
    fn transposed_less(&self, g: &Graph, value: Expr) -> Vec<Vec<Expr>> {
        let size = 0..self.matrix.len();
        let entry = |i: usize, k: usize| match i == k {
            true => g.sub(self.matrix[k][i], value),
            false => self.matrix[k][i],
        };
        size.clone()
            .map(|i| size.clone().map(|k| entry(i, k)).collect())
            .collect()
    }

    /// The eigenvalues that are roots of factors of the first and second degree, real ones first.
    fn eigenvalues(&self, fields: &Fields<'_>) -> Option<Vec<Eigenvalue>> {
        let g = &fields.system().graph;
        let root = g.symbol("part[root]", 0);
        let symbol = g.as_symbol(root)?;
        let polynomial = determinant(g, &self.transposed_less(g, root));
        let mut found = Vec::new();
        for (factor, _) in factors(g, polynomial, &[symbol])? {
            let list = coefficients(g, factor, symbol)?;
            let numbers: Option<Vec<Rational>> =
                list.iter().map(|&c| g.as_number(c).cloned()).collect();
            let parts = match numbers {
                Some(numbers) if numbers.len() > 2 => linear_and_quadratic(&numbers)
                    .into_iter()
                    .map(|own| own.into_iter().map(|c| g.number(c)).collect())
                    .collect(),
                _ => vec![list],
            };
            for part in parts {
                found.extend(roots(fields, &part));
            }
        }
        found.sort_by_key(|value| matches!(value, Eigenvalue::Pair(..)));
        Some(found)
    }

    /// The real and imaginary part of an eigenvector: `ν v` and `-(Mᵀ - μ) v` where `(Mᵀ - μ)² v = -ν² v`, without a common
    /// fraction.
    fn pair(&self, g: &Graph, re: Expr, im: Expr) -> Option<[Vec<Expr>; 2]> {
        let shifted = self.transposed_less(g, re);
        let size = 0..shifted.len();
        let square = g.powi(im, 2);
        let entry = |i: usize, k: usize| {
            let column: Vec<Expr> = shifted.iter().map(|row| row[k]).collect();
            let own = dot(g, &shifted[i], &column);
            let diagonal = if i == k { square } else { g.zero() };
            tidy(g, g.add(&[own, diagonal]))
        };
        let whole: Vec<Vec<Expr>> = size
            .clone()
            .map(|i| size.clone().map(|k| entry(i, k)).collect())
            .collect();
        let vector = null_vector(g, &whole)?;
        let scaled = |own: &[Expr], by: Expr| -> Vec<Expr> {
            own.iter().map(|&e| tidy(g, g.mul(&[by, e]))).collect()
        };
        let turned: Vec<Expr> = shifted.iter().map(|row| dot(g, row, &vector)).collect();
        let minus = g.integer(-1);
        // Either is written shorter.
        let times = [scaled(&vector, im), scaled(&turned, minus)];
        let over = [vector, scaled(&turned, g.div(minus, im))];
        let size = |pair: &[Vec<Expr>; 2]| -> u64 {
            let all = pair.iter().flatten();
            all.map(|&e| length(g, e)).sum()
        };
        let [first, second] = match size(&over) <= size(&times) {
            true => over,
            false => times,
        };
        let all = first.iter().chain(&second).map(|&e| coefficient(g, e));
        let unit = Rational::ONE / content(all.collect::<Vec<Rational>>().iter());
        Some([first, second].map(|own| own.iter().map(|&e| g.scale(&unit, e)).collect()))
    }

    /// All that eigenvalues give, solved for as many variables.
    fn together(&self, g: &Graph, parts: Vec<Part>) -> Option<Quadrature> {
        let rows = parts.iter().flat_map(|part| part.rows.iter());
        let rows: Vec<&(Vec<Expr>, Expr)> = rows.collect();
        let size = self.variables.len();
        let sets = (0..1_usize << size).filter(|set| set.count_ones() as usize == rows.len());
        let chosen = |set: usize| (0..size).filter(move |i| set >> i & 1 == 1);
        let square = |set: usize| -> Vec<Vec<Expr>> {
            let rows = rows.iter();
            rows.map(|(row, _)| chosen(set).map(|i| row[i]).collect())
                .collect()
        };
        let is_regular = |&set: &usize| !g.is_zero(tidy(g, determinant(g, &square(set))));
        let set = sets.into_iter().find(is_regular).filter(|&set| set > 0)?;
        let inverse = inverse(g, &square(set)).ok()?;
        let places = self.places(g);
        let right = rows.iter().map(|(row, value)| {
            let others = (0..size).filter(|i| set >> i & 1 == 0);
            let others = others.map(|i| g.mul(&[row[i], places[i]]));
            g.sub(*value, g.add(&others.collect::<Vec<Expr>>()))
        });
        let right: Vec<Expr> = right.collect();
        let values = inverse.iter().map(|row| tidy(g, dot(g, row, &right)));
        let solved = Solved {
            values: values.collect(),
            constants: parts
                .iter()
                .flat_map(|part| part.constants.clone())
                .collect(),
        };
        let own = chosen(set).map(|i| Variable::Place(self.variables[i]));
        Some(Quadrature {
            variables: own.collect(),
            functions: parts.into_iter().flat_map(|part| part.functions).collect(),
            solved: Some(solved),
        })
    }
}

/// The roots of a polynomial of the first or second degree, its coefficients ascending.
fn roots(fields: &Fields<'_>, list: &[Expr]) -> Vec<Eigenvalue> {
    let g = &fields.system().graph;
    match *list {
        [c, b] => vec![Eigenvalue::Real(tidy(g, g.neg(g.div(c, b))))],
        [c, b, a] => {
            let four = g.mul(&[g.integer(4), a, c]);
            let discriminant = tidy(g, g.sub(g.powi(b, 2), four));
            let twice = g.mul(&[g.integer(2), a]);
            let middle = tidy(g, g.neg(g.div(b, twice)));
            if is_negative(fields.system(), discriminant) {
                let root = root(g, g.neg(discriminant));
                return vec![Eigenvalue::Pair(middle, tidy(g, g.div(root, twice)))];
            }
            let aside = g.div(root(g, discriminant), twice);
            [g.add(&[middle, aside]), g.sub(middle, aside)]
                .map(|e| Eigenvalue::Real(tidy(g, e)))
                .into_iter()
                .collect()
        }
        _ => Vec::new(),
    }
}

/// Whether an expression without places is negative: as far as is known, by the values that the model states, or as it is written.
fn is_negative(system: &System, e: Expr) -> bool {
    let g = &system.graph;
    let sign = known_sign(g, e, &assumptions(system));
    let stated = |s: Symbol| {
        let mut own = system.parameters.iter();
        let own = own.find(|p| p.name == g.symbol_name(s));
        own.and_then(|p| g.evaluate_f64(&[p.value?], &|_| None).ok())
            .map(|v| v[0])
    };
    if sign.is_nonpositive() || sign.is_nonnegative() {
        return sign.is_nonpositive();
    }
    match g.evaluate_f64(&[e], &stated) {
        Ok(at) => at[0] < 0.0,
        Err(_) => g.text(e).starts_with('-'),
    }
}

/// The number before a product.
fn coefficient(g: &Graph, e: Expr) -> Rational {
    match g.node(e) {
        Node::Number(value) => value.clone(),
        Node::Product { coefficient, .. } => coefficient.clone(),
        _ => Rational::ONE,
    }
}

fn dot(g: &Graph, a: &[Expr], b: &[Expr]) -> Expr {
    let products = a.iter().zip(b).map(|(&x, &y)| g.mul(&[x, y]));
    g.add(&products.collect::<Vec<Expr>>())
}

/// A vector that a matrix takes to zero.
fn null_vector(g: &Graph, matrix: &[Vec<Expr>]) -> Option<Vec<Expr>> {
    let tidied = matrix
        .iter()
        .map(|row| row.iter().map(|&e| tidy(g, e)).collect());
    let tidied: Vec<Vec<Expr>> = tidied.collect();
    let space = null_space(g, &tidied, matrix.len()).ok()?;
    space.into_iter().next()
}

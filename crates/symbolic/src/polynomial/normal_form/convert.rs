//! From the expression graph to rational functions, node by node.

use rustc_hash::FxHashMap;

use super::super::rational_function::RationalFunction;
use super::field::Field;
use super::trigonometry::Pair;
use super::Stop;
use crate::rational::Rational;
use crate::{Expr, Function, Node};

/// Forms of the nodes met so far; solves have one form per component.
type Forms = FxHashMap<Expr, RationalFunction>;

impl Field<'_> {
    /// The forms of several expressions.
    pub(super) fn convert(&mut self, es: &[Expr]) -> Result<Vec<RationalFunction>, Stop> {
        let mut forms = Forms::default();
        let mut solved: FxHashMap<Expr, Vec<RationalFunction>> = FxHashMap::default();
        for positive in self.options.positive.clone() {
            self.convert_below(positive, &mut forms, &mut solved)?;
            if let Some(form) = forms.get(&positive).cloned() {
                let sign = form.numerator().mul(form.denominator(), &self.meter)?;
                self.nonnegative.push(sign.primitive_part());
            }
        }
        for angle in self.options.base_angles.clone() {
            self.convert_below(angle, &mut forms, &mut solved)?;
            if let Some(form) = forms.get(&angle).cloned() {
                self.pair(Pair::Circular, &form, angle)?;
            }
        }
        let mut results = Vec::with_capacity(es.len());
        for &e in es {
            self.convert_below(e, &mut forms, &mut solved)?;
            results.push(
                forms
                    .get(&e)
                    .cloned()
                    .unwrap_or_else(RationalFunction::zero),
            );
        }
        Ok(results)
    }

    /// Converts everything below `root` in depth-first order, which depends on nothing but the structure, so that
    /// generators are numbered the same way however the graph was built.
    fn convert_below(
        &mut self,
        root: Expr,
        forms: &mut Forms,
        solved: &mut FxHashMap<Expr, Vec<RationalFunction>>,
    ) -> Result<(), Stop> {
        let g = self.g;
        let mut stack = vec![(root, false)];
        while let Some((e, children_done)) = stack.pop() {
            if forms.contains_key(&e) || solved.contains_key(&e) {
                continue;
            }
            if children_done {
                self.convert_node(e, forms, solved)?;
                continue;
            }
            stack.push((e, true));
            if !self.options.expand_solves && matches!(g.node(e), Node::Entry { .. }) {
                continue;
            }
            let first = stack.len();
            g.node(e).for_each_child(|child| stack.push((child, false)));
            stack[first..].reverse();
        }
        Ok(())
    }

    fn convert_node(
        &mut self,
        e: Expr,
        forms: &mut Forms,
        solved: &mut FxHashMap<Expr, Vec<RationalFunction>>,
    ) -> Result<(), Stop> {
        let g = self.g;
        // Children were converted before; a matrix has no form and is never asked for one.
        let form = |forms: &Forms, e: Expr| {
            forms
                .get(&e)
                .cloned()
                .unwrap_or_else(RationalFunction::zero)
        };
        let value = match g.node(e) {
            Node::Number(value) => RationalFunction::constant(value),
            Node::Pi | Node::Symbol(_) => self.free(e),
            Node::Algebraic(own) => self.algebraic(e, own),
            Node::Sum { constant, terms } => {
                let mut parts = vec![RationalFunction::constant(constant)];
                for (term, coefficient) in terms.iter() {
                    let coefficient = RationalFunction::constant(coefficient);
                    parts.push(self.mul(&coefficient, &form(forms, *term))?);
                }
                self.sum(parts)?
            }
            Node::Product {
                coefficient,
                factors,
            } => {
                let mut product = RationalFunction::constant(coefficient);
                for &factor in factors.iter() {
                    product = self.mul(&product, &form(forms, factor))?;
                }
                product
            }
            Node::Power { base, exponent } => {
                let (base_form, exponent_form) = (form(forms, *base), form(forms, *exponent));
                self.power(e, (*base, base_form), (*exponent, exponent_form))?
            }
            Node::Apply {
                function,
                arguments,
            } => {
                let forms: Vec<RationalFunction> =
                    arguments.iter().map(|&a| form(forms, a)).collect();
                self.function(e, *function, &forms, arguments)?
            }
            Node::Matrix { .. } => return Ok(()),
            Node::Solve { matrix, rhs } => {
                let Node::Matrix { entries, .. } = g.node(*matrix) else {
                    return Err(Stop::Undefined);
                };
                let entries: Vec<RationalFunction> =
                    entries.iter().map(|&a| form(forms, a)).collect();
                let rhs: Vec<RationalFunction> = rhs.iter().map(|&b| form(forms, b)).collect();
                if entries.len() != rhs.len() * rhs.len() {
                    return Err(Stop::Undefined);
                }
                let solution = self.solve(&entries, &rhs)?;
                solved.insert(e, solution);
                return Ok(());
            }
            Node::Entry { of, index } => {
                match solved.get(of).and_then(|s| s.get(*index as usize)) {
                    Some(component) => component.clone(),
                    None => self.free(e),
                }
            }
        };
        forms.insert(e, value);
        Ok(())
    }

    fn power(
        &mut self,
        e: Expr,
        (base, base_form): (Expr, RationalFunction),
        (exponent, exponent_form): (Expr, RationalFunction),
    ) -> Result<RationalFunction, Stop> {
        if let Some(n) = exponent_form.as_rational() {
            return self.rational_power(&base_form, &n, Some(e));
        }
        if !self.options.expand_angles {
            return Ok(self.free(e));
        }
        // x^a = exp(a log x), which is what a power with a variable exponent means.
        let g = self.g;
        let log_expr = g.apply(Function::Log, &[base]);
        let log = self.function(log_expr, Function::Log, &[base_form], &[base])?;
        let product = self.mul(&exponent_form, &log)?;
        self.exponential(&product, g.mul(&[exponent, log_expr]))
    }

    fn function(
        &mut self,
        e: Expr,
        function: Function,
        forms: &[RationalFunction],
        arguments: &[Expr],
    ) -> Result<RationalFunction, Stop> {
        use Function::*;
        let ([form], [argument]) = (forms, arguments) else {
            return self.opaque(e, function, forms);
        };
        match function {
            Sin | Cos | Tan | Cot | Sec | Csc => {
                let (s, c) = self.pair(Pair::Circular, form, *argument)?;
                let one = RationalFunction::one();
                match function {
                    Sin => Ok(s),
                    Cos => Ok(c),
                    Tan => self.div(&s, &c),
                    Cot => self.div(&c, &s),
                    Sec => self.div(&one, &c),
                    _ => self.div(&one, &s),
                }
            }
            Sinh | Cosh | Tanh => {
                let (s, c) = self.pair(Pair::Hyperbolic, form, *argument)?;
                match function {
                    Sinh => Ok(s),
                    Cosh => Ok(c),
                    _ => self.div(&s, &c),
                }
            }
            Exp => self.exponential(form, *argument),
            Abs => self.absolute(form),
            _ => self.opaque(e, function, forms),
        }
    }

    /// A function about which nothing is known, except that equal arguments give equal values and odd functions change
    /// sign with their argument.
    fn opaque(
        &mut self,
        e: Expr,
        function: Function,
        forms: &[RationalFunction],
    ) -> Result<RationalFunction, Stop> {
        use Function::*;
        let zero = forms.len() == 1 && forms[0].is_zero();
        if zero && matches!(function, Asin | Atan | Asinh | Atanh | Sign) {
            return Ok(RationalFunction::zero());
        }
        if zero && function == Log {
            return Err(Stop::Undefined);
        }
        if function == Log && forms[0].as_rational().is_some_and(|r| r == Rational::ONE) {
            return Ok(RationalFunction::zero());
        }
        let odd = matches!(function, Asin | Atan | Asinh | Atanh | Sign);
        let known: Vec<(Vec<RationalFunction>, usize)> = self
            .opaque
            .iter()
            .filter(|(f, _, _)| *f == function)
            .map(|(_, arguments, generator)| (arguments.clone(), *generator))
            .collect();
        for (arguments, generator) in known {
            if arguments.len() != forms.len() {
                continue;
            }
            let mut same = true;
            for (a, b) in arguments.iter().zip(forms) {
                same = same && self.equal(a, b)?;
            }
            if same {
                return Ok(self.generator(generator));
            }
            if odd && self.equal(&arguments[0], &forms[0].neg())? {
                return Ok(self.generator(generator).neg());
            }
        }
        let form = self.free(e);
        if let Some(generator) = self.generator_of(e) {
            self.opaque.push((function, forms.to_vec(), generator));
        }
        Ok(form)
    }
}

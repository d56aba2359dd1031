//! Constitutive functions of a space: declared, stated by a value or a gradient, differentiated, applied, and undone by their conjugates.
//!
//! A function applied to arguments is a symbol of the graph with derivatives of its own. Applications are known by function, slots
//! of differentiation and arguments, so that one symbol never means two things.

use super::cache::Asked;
use super::{pairs, Space};
use chetaev_symbolic::{Expr, Symbol, Verdict};
use std::collections::{BTreeMap, BTreeSet};

/// What a constitutive function is.
#[derive(Clone, Debug)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// The rank of its argument.
    pub rank: usize,
    /// How often each independent component of the argument counts in a contraction.
    pub multiplicities: Vec<i64>,
    /// The Legendre conjugate.
    pub conjugate: Option<usize>,
    /// How its values are stated, as it is written; nothing where it may be any function.
    pub written: Option<String>,
}

/// A constitutive function, differentiated and applied.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Application {
    pub(super) function: usize,
    /// Slots by which is differentiated, ascending.
    pub(super) by: Vec<usize>,
    pub(super) arguments: Vec<Expr>,
}

/// Expressions in place-holders for the argument of a function.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    slots: Vec<Expr>,
    values: Vec<Expr>,
}

impl Space {
    /// Declares a constitutive function; the one of the same name where there is one.
    pub fn function(&self, function: Function) -> usize {
        let mut all = self.functions.borrow_mut();
        if let Some(at) = all.iter().position(|own| own.name == function.name) {
            return at;
        }
        all.push(function);
        all.len() - 1
    }

    /// A name for a function of another file that is not the one that the space has by this name.
    pub fn unused_function_name(&self, name: &str, of: &str) -> String {
        let mut own = format!("{name} of {of}");
        while self.function_named(&own).is_some() {
            own.push('*');
        }
        own
    }

    /// A value in the place-holders of a function, at arguments.
    pub(crate) fn at_arguments(&self, function: usize, value: Expr, arguments: &[Expr]) -> Expr {
        self.put_in(&self.slots(function), value, arguments)
    }

    /// The gradient of a value in the place-holders of a function.
    pub(crate) fn gradient_of_value(&self, function: usize, value: Expr) -> Vec<Expr> {
        let slots = self.slots(function);
        let rule = |arguments: &[Expr]| self.put_in(&slots, value, arguments);
        let slope = |k: usize| self.derived_rule(function, &[k], &slots, &rule);
        (0..slots.len()).map(slope).collect()
    }

    /// Declares two functions as Legendre conjugates.
    pub fn conjugate(&self, one: usize, other: usize) {
        let mut all = self.functions.borrow_mut();
        all[one].conjugate = Some(other);
        all[other].conjugate = Some(one);
        self.cache.clear();
    }

    /// Place-holders for the argument of a function.
    pub fn slots(&self, function: usize) -> Vec<Expr> {
        let count = self.functions.borrow()[function].multiplicities.len();
        (0..count)
            .map(|slot| self.graph.symbol(&format!("slot {slot}"), 0))
            .collect()
    }

    /// States the gradient of a function, in its place-holders.
    pub fn state_gradient(&self, function: usize, values: Vec<Expr>) {
        let slots = self.slots(function);
        self.gradients
            .borrow_mut()
            .insert(function, Rule { slots, values });
        self.cache.clear();
    }

    /// States the value of a function, in its place-holders.
    pub fn state_body(&self, function: usize, value: Expr) {
        let slots = self.slots(function);
        let values = vec![value];
        self.bodies
            .borrow_mut()
            .insert(function, Rule { slots, values });
        self.conjugations.borrow_mut().clear();
        self.known.borrow_mut().clear();
        self.cache.clear();
    }

    /// Keeps the determinant of the gradient of a function that is linear.
    pub(crate) fn note_determinant(&self, function: usize, determinant: Expr) {
        self.determinants.borrow_mut().insert(function, determinant);
    }

    /// The determinant of the gradient of a function that is linear, where its conjugate has no formula.
    pub(crate) fn determinant_of(&self, function: usize) -> Option<Expr> {
        self.determinants.borrow().get(&function).copied()
    }

    /// What must not vanish so that functions have the conjugates that were computed for them.
    pub(crate) fn determinants(&self) -> Vec<Expr> {
        self.determinants.borrow().values().copied().collect()
    }

    /// What `decide` says of a pair of functions, asked once; while it is asked, nothing is known of the pair.
    pub(crate) fn decided_once(
        &self,
        pair: (usize, usize),
        decide: &dyn Fn() -> Option<Verdict>,
    ) -> Option<Verdict> {
        if let Some(known) = self.conjugations.borrow().get(&pair) {
            return known.clone();
        }
        let open = Verdict::undecided("the functions are stated by each other");
        self.conjugations.borrow_mut().insert(pair, Some(open));
        let decided = self.cache.while_open(decide);
        self.conjugations.borrow_mut().insert(pair, decided.clone());
        decided
    }

    /// The stated value of a function, differentiated by slots and applied.
    pub fn body(&self, function: usize, by: &[usize], arguments: &[Expr]) -> Option<Expr> {
        let rule = self.bodies.borrow().get(&function).cloned()?;
        let value = *rule.values.first()?;
        let inner = |arguments: &[Expr]| self.put_in(&rule.slots, value, arguments);
        Some(self.derived_rule(function, by, arguments, &inner))
    }

    fn put_in(&self, slots: &[Expr], value: Expr, arguments: &[Expr]) -> Expr {
        self.replace(value, &|symbol| {
            let own = self.graph.symbol_expr(symbol);
            let at = slots.iter().position(|&s| s == own)?;
            arguments.get(at).copied()
        })
    }

    /// The expression with every function replaced by its stated value, where one is stated.
    pub fn explicit(&self, e: Expr) -> Expr {
        self.once(Asked::Explicit(e), || self.with_formulas(e))
    }

    fn with_formulas(&self, e: Expr) -> Expr {
        let stated: Vec<usize> = self.bodies.borrow().keys().copied().collect();
        stated.into_iter().fold(e, |e, function| {
            let rule = |arguments: &[Expr]| {
                let zero = self.graph.zero();
                self.body(function, &[], arguments).unwrap_or(zero)
            };
            self.replace_function(e, function, &rule)
        })
    }

    /// A constitutive function.
    pub fn function_at(&self, at: usize) -> Function {
        self.functions.borrow()[at].clone()
    }

    /// The function of a name.
    pub fn function_named(&self, name: &str) -> Option<usize> {
        self.functions
            .borrow()
            .iter()
            .position(|own| own.name == name)
    }

    /// Gives arguments a name for reading.
    pub fn name_arguments(&self, arguments: &[Expr], name: &str) {
        let mut all = self.arguments.borrow_mut();
        if !all.contains_key(arguments) {
            let own = unused(&all, name);
            all.insert(arguments.to_vec(), own);
        }
    }

    /// A function differentiated by `slots` and applied: the tensor of its derivatives, so that off the diagonal each of two
    /// equal components has half of the derivative by the one unknown.
    pub fn apply(&self, function: usize, slots: &[usize], arguments: &[Expr]) -> Expr {
        let mut by = slots.to_vec();
        by.sort_unstable();
        let application = Application {
            function,
            by,
            arguments: arguments.to_vec(),
        };
        if let Some(&known) = self.known.borrow().get(&application) {
            return known;
        }
        // What is asked for while it is looked for stands for itself.
        if !self.sought.borrow_mut().insert(application.clone()) {
            return self.intern(&application);
        }
        let value = self.cache.while_open(|| {
            self.conjugated(&application)
                .or_else(|| self.by_gradient(&application))
                .unwrap_or_else(|| self.intern(&application))
        });
        self.sought.borrow_mut().remove(&application);
        self.known.borrow_mut().insert(application, value);
        value
    }

    /// All first derivatives.
    pub fn gradient(&self, function: usize, arguments: &[Expr]) -> Vec<Expr> {
        (0..arguments.len())
            .map(|slot| self.apply(function, &[slot], arguments))
            .collect()
    }

    fn by_gradient(&self, application: &Application) -> Option<Expr> {
        let [slot] = application.by[..] else {
            return None;
        };
        let rule = self
            .gradients
            .borrow()
            .get(&application.function)
            .cloned()?;
        let value = *rule.values.get(slot)?;
        Some(self.put_in(&rule.slots, value, &application.arguments))
    }

    fn intern(&self, application: &Application) -> Expr {
        let function = self.function_at(application.function);
        let primes = "'".repeat(application.by.len());
        let slots: Vec<String> = application
            .by
            .iter()
            .map(|&slot| self.slot_name(&function, slot))
            .collect();
        let of = self.argument_name(&application.arguments);
        let indices = if slots.is_empty() || function.rank == 0 {
            String::new()
        } else {
            format!("_{}", slots.concat())
        };
        let name = format!("{}{primes}{indices}({of})", function.name);
        let symbol = self.graph.intern_symbol(&name, 0);
        self.applications
            .borrow_mut()
            .insert(symbol, application.clone());
        self.graph.symbol_expr(symbol)
    }

    fn slot_name(&self, function: &Function, slot: usize) -> String {
        match function.rank {
            2 => {
                let (i, j) = pairs(self.dimensions())[slot];
                format!("{}{}", i + 1, j + 1)
            }
            _ => (slot + 1).to_string(),
        }
    }

    fn argument_name(&self, arguments: &[Expr]) -> String {
        let mut names = self.arguments.borrow_mut();
        let next = names.values().filter(|name| name.starts_with('#')).count() + 1;
        let single = match arguments {
            [one] => Some(self.graph.text(*one)),
            _ => None,
        };
        if let Some(known) = names.get(arguments) {
            return known.clone();
        }
        let made = unused(&names, &single.unwrap_or_else(|| format!("#{next}")));
        names.insert(arguments.to_vec(), made.clone());
        made
    }

    /// Arguments that have a name.
    pub(crate) fn named_arguments(&self) -> Vec<Vec<Expr>> {
        let names = self.arguments.borrow();
        let own = names.iter().filter(|(_, name)| !name.starts_with('#'));
        own.map(|(arguments, _)| arguments.clone()).collect()
    }

    /// Arguments that have no name of their own, with the names made for them.
    pub fn unnamed_arguments(&self) -> Vec<(String, Vec<Expr>)> {
        let names = self.arguments.borrow();
        let own = names.iter().filter(|(_, name)| name.starts_with('#'));
        own.map(|(arguments, name)| (name.clone(), arguments.clone()))
            .collect()
    }

    /// `B'(A'(X)) = X` and `B(A'(X)) = X A'(X) − A(X)` for Legendre conjugates.
    fn conjugated(&self, application: &Application) -> Option<Expr> {
        let function = self.function_at(application.function);
        function.conjugate?;
        if application.by.len() > 1 {
            return None;
        }
        let conjugate = self.undoing(application.function)?;
        let inner = self.inverse_image(conjugate, &application.arguments)?;
        let g = &self.graph;
        match application.by[..] {
            [slot] => inner.get(slot).copied(),
            _ => {
                let mut terms: Vec<Expr> = Vec::new();
                for ((&x, &y), &m) in inner
                    .iter()
                    .zip(&application.arguments)
                    .zip(&function.multiplicities)
                {
                    terms.push(g.mul(&[g.integer(m), x, y]));
                }
                terms.push(g.neg(self.apply(conjugate, &[], &inner)));
                Some(g.add(&terms))
            }
        }
    }

    /// X with `function'(X) = arguments`, where X occurs as an argument of a function in them.
    fn inverse_image(&self, function: usize, arguments: &[Expr]) -> Option<Vec<Expr>> {
        let g = &self.graph;
        let occurring = g.symbols_in(arguments);
        let mut candidates: Vec<Vec<Expr>> = Vec::new();
        {
            let known = self.applications.borrow();
            for symbol in occurring {
                if let Some(application) = known.get(&symbol) {
                    let own = &application.arguments;
                    if own.len() == arguments.len() && !candidates.contains(own) {
                        candidates.push(own.clone());
                    }
                }
            }
        }
        if self.is_known_alone(function) {
            candidates.extend(self.arguments_within(arguments));
        }
        candidates.into_iter().find(|candidate| {
            let image = self.gradient(function, candidate);
            let image: Vec<Expr> = image.into_iter().map(|e| self.explicit(e)).collect();
            let differences: Vec<Expr> = image
                .iter()
                .zip(arguments)
                .map(|(&a, &b)| g.sub(a, b))
                .collect();
            differences.iter().all(|&e| g.is_zero(e)) || self.vanish(&differences)
        })
    }

    /// Whether a function has a formula and its conjugate has none.
    pub(crate) fn is_known_alone(&self, function: usize) -> bool {
        let other = self.function_at(function).conjugate;
        self.is_known(function) && other.is_some_and(|own| !self.is_known(own))
    }

    /// A function in an expression of which the values are not free and not given by a formula either: they are known through the conjugate,
    /// or up to a constant through the gradient.
    pub(crate) fn unsettled(&self, e: Expr) -> Option<String> {
        let is_half_known = |own: usize| {
            let other = self.function_at(own).conjugate;
            // What is left of a function with a gradient are its values, which this gives up to a constant.
            let is_stated = self.gradients.borrow().contains_key(&own);
            let by_gradient = is_stated && !self.bodies.borrow().contains_key(&own);
            let is_special = self.specialised.borrow().contains(&own);
            is_special || by_gradient || other.is_some_and(|other| self.is_known_alone(other))
        };
        let mut applied = self.functions_in(e).into_iter();
        let own = applied.find(|&own| is_half_known(own))?;
        Some(self.function_at(own).name)
    }

    /// The function that another one is with special values by which it is stated, of which nothing else is known.
    pub(crate) fn specialised(&self, function: usize) -> usize {
        let own = self.function_at(function);
        let at = self.function(Function {
            name: format!("{} with the special values", own.name),
            conjugate: None,
            written: None,
            ..own
        });
        self.specialised.borrow_mut().insert(at);
        at
    }

    /// Whether what is stated of a function, or of those by which it is stated, or of their conjugates, contains one of these functions or symbols.
    pub(crate) fn is_stated_by(
        &self,
        function: usize,
        functions: &BTreeSet<usize>,
        symbols: &BTreeSet<Symbol>,
    ) -> bool {
        let (mut met, mut open) = (BTreeSet::new(), vec![function]);
        while let Some(own) = open.pop() {
            if !met.insert(own) {
                continue;
            }
            if functions.contains(&own) {
                return true;
            }
            let rules = [&self.bodies, &self.gradients].map(|all| all.borrow().get(&own).cloned());
            let values = rules.into_iter().flatten().flat_map(|rule| rule.values);
            for e in values {
                if !self.symbols_in(&[e]).is_disjoint(symbols) {
                    return true;
                }
                open.extend(self.functions_in(e));
            }
            open.extend(self.function_at(own).conjugate);
        }
        false
    }

    /// Whether a function is stated by formulas, if through other functions.
    fn is_known(&self, function: usize) -> bool {
        let mut met = BTreeSet::new();
        let mut open = vec![function];
        while let Some(own) = open.pop() {
            if !met.insert(own) {
                continue;
            }
            let value = self.bodies.borrow().get(&own).cloned();
            let Some(rule) = value.or_else(|| self.gradients.borrow().get(&own).cloned()) else {
                return false;
            };
            open.extend(rule.values.iter().flat_map(|&e| self.functions_in(e)));
        }
        true
    }

    /// The gradient of a function by its value or as it is stated, in its place-holders; `None` where it is not stated, or by other
    /// functions of which nothing is known.
    pub(crate) fn formula_of_gradient(&self, function: usize) -> Option<Vec<Expr>> {
        let slots = self.slots(function);
        let of_value = (0..slots.len()).map(|k| self.body(function, &[k], &slots));
        if let Some(own) = of_value.collect::<Option<Vec<Expr>>>() {
            return Some(own);
        }
        let stated = self.gradients.borrow().get(&function).cloned()?;
        let values = stated.values.iter();
        let values: Vec<Expr> = values
            .map(|&e| self.put_in(&stated.slots, e, &slots))
            .collect();
        let symbols = self.graph.symbols_in(&values);
        let is_abstract = symbols.into_iter().any(|s| self.is_application(s));
        (!is_abstract).then_some(values)
    }

    /// Arguments of which others may be the image by a formula: tensors with a name, and jets for one argument, that occur in them.
    fn arguments_within(&self, images: &[Expr]) -> Vec<Vec<Expr>> {
        let occurring = self.symbols_in(images);
        let mut found = self.named_arguments();
        if images.len() == 1 {
            let jets = self.jets_in(images).into_iter();
            found.extend(jets.map(|jet| vec![self.jet(jet.component, &jet.by)]));
        }
        found.retain(|own| own.len() == images.len() && self.symbols_in(own).is_subset(&occurring));
        found
    }

    /// Replaces a constitutive function by another rule for its values; derivatives follow from the rule.
    pub fn replace_function(
        &self,
        e: Expr,
        function: usize,
        rule: &dyn Fn(&[Expr]) -> Expr,
    ) -> Expr {
        let g = &self.graph;
        let mut pairs = Vec::new();
        for symbol in g.symbols_in(&[e]) {
            let application = self.applications.borrow().get(&symbol).cloned();
            let Some(own) = application else { continue };
            let arguments: Vec<Expr> = own
                .arguments
                .iter()
                .map(|&a| self.replace_function(a, function, rule))
                .collect();
            let new = if own.function == function {
                self.derived_rule(function, &own.by, &arguments, rule)
            } else {
                self.apply(own.function, &own.by, &arguments)
            };
            pairs.push((g.symbol_expr(symbol), new));
        }
        g.substitute(e, &pairs)
    }

    /// The expression with one symbol for applications of a function whose arguments are proved equal, such as `((1 − β) s)/(1 − β)` and s.
    pub fn unified(&self, e: Expr) -> Expr {
        let g = &self.graph;
        let mut kept: Vec<(Application, Expr)> = Vec::new();
        let mut pairs = Vec::new();
        for symbol in g.symbols_in(&[e]) {
            let Some(own) = self.applications.borrow().get(&symbol).cloned() else {
                continue;
            };
            let is_same = |(other, _): &&(Application, Expr)| {
                let pairs = own.arguments.iter().zip(&other.arguments);
                let differences: Vec<Expr> = pairs.map(|(&a, &b)| g.sub(a, b)).collect();
                own.function == other.function && own.by == other.by && self.vanish(&differences)
            };
            match kept.iter().find(is_same) {
                Some((_, same)) => pairs.push((g.symbol_expr(symbol), *same)),
                None => kept.push((own, g.symbol_expr(symbol))),
            }
        }
        g.substitute(e, &pairs)
    }

    /// The tensor derivative of a rule at arguments.
    fn derived_rule(
        &self,
        function: usize,
        by: &[usize],
        arguments: &[Expr],
        rule: &dyn Fn(&[Expr]) -> Expr,
    ) -> Expr {
        let g = &self.graph;
        if by.is_empty() {
            return rule(arguments);
        }
        let multiplicities = self.function_at(function).multiplicities;
        // Names of their own: the rule may have been stated in the place-holders of another function.
        let slots: Vec<Expr> = (0..arguments.len())
            .map(|slot| g.symbol(&format!("place {slot}"), 0))
            .collect();
        let mut value = rule(&slots);
        for &slot in by {
            let wanted = g.as_symbol(slots[slot]);
            let one = g.one();
            let raw = self.derive(value, &|s| (Some(s) == wanted).then_some(one));
            value = g.div(raw, g.integer(multiplicities[slot]));
        }
        self.replace(value, &|symbol| {
            let at = slots.iter().position(|&s| g.as_symbol(s) == Some(symbol))?;
            Some(arguments[at])
        })
    }

    /// The first derivatives of functions that a conjugate undoes and that occur: function and arguments.
    pub(crate) fn gradients_in(&self, es: &[Expr]) -> Vec<(usize, Vec<Expr>)> {
        let mut found: Vec<(usize, Vec<Expr>)> = Vec::new();
        for symbol in self.graph.symbols_in(es) {
            let application = self.applications.borrow().get(&symbol).cloned();
            let Some(own) = application else {
                continue;
            };
            let is_undone = own.by.len() == 1 && self.undoing(own.function).is_some();
            let pair = (own.function, own.arguments);
            if is_undone && !found.contains(&pair) {
                found.push(pair);
            }
        }
        found
    }

    /// Constitutive functions that occur in an expression.
    pub(crate) fn functions_in(&self, e: Expr) -> BTreeSet<usize> {
        let known = self.applications.borrow();
        let mut found = BTreeSet::new();
        let mut open = vec![e];
        while let Some(e) = open.pop() {
            let own = self.graph.symbols_in(&[e]).into_iter();
            for application in own.filter_map(|symbol| known.get(&symbol)) {
                found.insert(application.function);
                open.extend(&application.arguments);
            }
        }
        found
    }

    /// Whether a symbol is a constitutive function applied.
    pub fn is_application(&self, symbol: Symbol) -> bool {
        self.applications.borrow().contains_key(&symbol)
    }
}

/// The name, or one made from it where it stands for other arguments already: one symbol never means two things.
fn unused(names: &BTreeMap<Vec<Expr>, String>, name: &str) -> String {
    let is_taken = |wanted: &str| names.values().any(|own| own == wanted);
    if !is_taken(name) {
        return name.to_owned();
    }
    let mut count = 2;
    while is_taken(&format!("{name} of {count}")) {
        count += 1;
    }
    format!("{name} of {count}")
}

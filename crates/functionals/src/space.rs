//! Jets of fields over space: components, their derivatives as symbols, total derivatives, and constitutive functions.
//!
//! A component and each of its derivatives is a symbol of the graph. A constitutive function applied to arguments is a symbol
//! too, which is differentiated by the chain rule through its own derivatives; a function and its Legendre conjugate undo each
//! other wherever one is applied to the gradient of the other. Both are exact, so that what is proved holds for every energy.

use chetaev_symbolic::zero::assumptions::{Assumption, Assumptions, Relation, SignSet};
use chetaev_symbolic::zero::{decide_zero, known_sign, Options, ZeroTest};
use chetaev_symbolic::{Expr, Graph, Symbol, Verdict};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

/// A derivative: the independent variables by which is differentiated, ascending, each as often as it is.
pub type Multi = Vec<usize>;

/// An independent variable.
#[derive(Clone, Debug)]
pub struct Coordinate {
    /// Its name.
    pub name: String,
    /// What stands for it behind a comma.
    pub suffix: String,
    /// Its symbol.
    pub expr: Expr,
    /// Whether it is the time.
    pub is_time: bool,
}

/// A component of a tensor that depends on place.
#[derive(Clone, Debug)]
pub struct Component {
    /// Its name, `s_12`.
    pub name: String,
    /// Which tensor it belongs to.
    pub tensor: String,
    /// How often it occurs in the tensor: twice off the diagonal of a symmetric one.
    pub multiplicity: i64,
    /// Whether it is varied in the interior; data are not varied, and fields of the boundary are varied there only.
    pub is_varied: bool,
    /// Whether it lives on a piece of the boundary only, so that it may be continued off it at will.
    pub is_of_boundary: bool,
}

/// A component differentiated.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Jet {
    /// Which component.
    pub component: usize,
    /// By what it is differentiated.
    pub by: Multi,
}

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
}

/// A constitutive function, differentiated and applied.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Application {
    function: usize,
    /// Slots by which is differentiated, ascending.
    by: Vec<usize>,
    arguments: Vec<Expr>,
}

/// Expressions in place-holders for the argument of a function.
#[derive(Clone, Debug)]
struct Rule {
    slots: Vec<Expr>,
    values: Vec<Expr>,
}

/// All symbols of a functional with their calculus.
pub struct Space {
    /// The expressions.
    pub graph: Graph,
    /// Independent variables, those of space first.
    pub coordinates: Vec<Coordinate>,
    components: RefCell<Vec<Component>>,
    functions: RefCell<Vec<Function>>,
    gradients: RefCell<BTreeMap<usize, Rule>>,
    bodies: RefCell<BTreeMap<usize, Rule>>,
    jets: RefCell<BTreeMap<Symbol, Jet>>,
    applications: RefCell<BTreeMap<Symbol, Application>>,
    known: RefCell<BTreeMap<Application, Expr>>,
    /// Whether pairs of functions are conjugates by their formulas; nothing where one has none.
    conjugations: RefCell<BTreeMap<(usize, usize), Option<Verdict>>>,
    /// The normal, and the distance from the boundary, inwards negative.
    normal: Vec<Symbol>,
    distance: Symbol,
    /// What is assumed of fields, data and parameters.
    assumptions: RefCell<Assumptions>,
    /// Names of arguments, for reading.
    arguments: RefCell<BTreeMap<Vec<Expr>, String>>,
    display: RefCell<BTreeMap<String, String>>,
}

impl std::fmt::Debug for Space {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Space")
            .field("components", &self.components)
            .finish_non_exhaustive()
    }
}

impl Space {
    /// A space with these independent variables: name, what stands behind a comma, and whether it is the time.
    pub fn new(variables: &[(String, String, bool)]) -> Space {
        let graph = Graph::new();
        let coordinates = variables
            .iter()
            .map(|(name, suffix, is_time)| Coordinate {
                name: name.clone(),
                suffix: suffix.clone(),
                expr: graph.symbol(name, 0),
                is_time: *is_time,
            })
            .collect();
        let d = variables.iter().filter(|(_, _, is_time)| !is_time).count();
        let normal = (1..=d)
            .map(|i| graph.intern_symbol(&format!("n_{i}"), 0))
            .collect();
        let distance = graph.intern_symbol("distance from the boundary", 0);
        Space {
            graph,
            coordinates,
            normal,
            distance,
            components: RefCell::default(),
            functions: RefCell::default(),
            gradients: RefCell::default(),
            bodies: RefCell::default(),
            jets: RefCell::default(),
            applications: RefCell::default(),
            known: RefCell::default(),
            conjugations: RefCell::default(),
            assumptions: RefCell::default(),
            arguments: RefCell::default(),
            display: RefCell::default(),
        }
    }

    /// The number of dimensions of space.
    pub fn dimensions(&self) -> usize {
        self.coordinates.iter().filter(|c| !c.is_time).count()
    }

    pub(crate) fn normals(&self) -> &[Symbol] {
        &self.normal
    }

    pub(crate) fn distance(&self) -> Symbol {
        self.distance
    }

    /// Adds a component; the one of the same name where there is one.
    pub fn component(&self, component: Component) -> usize {
        let mut all = self.components.borrow_mut();
        if let Some(at) = all.iter().position(|own| own.name == component.name) {
            return at;
        }
        all.push(component);
        all.len() - 1
    }

    /// A component.
    pub fn component_at(&self, at: usize) -> Component {
        self.components.borrow()[at].clone()
    }

    /// The component of a name.
    pub fn component_named(&self, name: &str) -> Option<usize> {
        self.components
            .borrow()
            .iter()
            .position(|own| own.name == name)
    }

    /// The symbol of a jet.
    pub fn jet(&self, component: usize, by: &[usize]) -> Expr {
        let mut by = by.to_vec();
        by.sort_unstable();
        let name = self.components.borrow()[component].name.clone();
        let suffix: String = by
            .iter()
            .map(|&i| self.coordinates[i].suffix.as_str())
            .collect();
        let full = if by.is_empty() {
            name.clone()
        } else {
            format!("{name},{suffix}")
        };
        let symbol = self.graph.intern_symbol(&full, 0);
        self.jets
            .borrow_mut()
            .entry(symbol)
            .or_insert(Jet { component, by });
        if !suffix.is_empty() {
            let (head, indices) = name.rsplit_once('_').unwrap_or((&name, ""));
            let lower = format!("{indices},{suffix}");
            let shown = chetaev_symbolic::print::with_indices(head, &[], &[&lower]);
            self.display.borrow_mut().insert(full, shown);
        }
        self.graph.symbol_expr(symbol)
    }

    /// How names of jets are typeset.
    pub fn display(&self) -> BTreeMap<String, String> {
        self.display.borrow().clone()
    }

    /// The jet that a symbol is.
    pub fn as_jet(&self, symbol: Symbol) -> Option<Jet> {
        self.jets.borrow().get(&symbol).cloned()
    }

    /// Declares a constitutive function; the one of the same name where there is one.
    pub fn function(&self, function: Function) -> usize {
        let mut all = self.functions.borrow_mut();
        if let Some(at) = all.iter().position(|own| own.name == function.name) {
            return at;
        }
        all.push(function);
        all.len() - 1
    }

    /// Declares two functions as Legendre conjugates.
    pub fn conjugate(&self, one: usize, other: usize) {
        let mut all = self.functions.borrow_mut();
        all[one].conjugate = Some(other);
        all[other].conjugate = Some(one);
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
        let decided = decide();
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

    /// An expression where an independent variable has a value.
    pub fn at(&self, e: Expr, axis: usize, value: Expr) -> Expr {
        let own = self
            .coordinates
            .get(axis)
            .and_then(|c| self.graph.as_symbol(c.expr));
        self.replace(e, &|symbol| (Some(symbol) == own).then_some(value))
    }

    /// Assumes a comparison of fields, data and parameters.
    pub fn assume(&self, own: Assumption) {
        let mut all = self.assumptions.borrow_mut();
        if !all.list().contains(&own) {
            all.assume(own.left, own.relation, own.right);
        }
    }

    /// What is assumed.
    pub fn assumptions(&self) -> Assumptions {
        self.assumptions.borrow().clone()
    }

    /// The signs that an expression can have where what is assumed holds, as far as its structure tells.
    pub fn sign(&self, e: Expr) -> SignSet {
        if self.is_slope_of_undone(e) {
            return SignSet::POSITIVE.or(SignSet::NEGATIVE);
        }
        known_sign(&self.graph, e, &self.assumptions.borrow())
    }

    /// Whether an expression is the second derivative of a function of one argument whose conjugate undoes its gradient: of
    /// `B'(A'(x)) = x` follows `B''(A'(x)) A''(x) = 1`.
    fn is_slope_of_undone(&self, e: Expr) -> bool {
        let symbol = self.graph.as_symbol(e);
        let own = symbol.and_then(|s| self.applications.borrow().get(&s).cloned());
        own.is_some_and(|own| {
            own.by.len() == 2 && own.arguments.len() == 1 && self.undoing(own.function).is_some()
        })
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
        let value = self
            .conjugated(&application)
            .or_else(|| self.by_gradient(&application))
            .unwrap_or_else(|| self.intern(&application));
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
        let has_formula = |own: usize| self.formula_of_gradient(own).is_some();
        has_formula(function) && other.is_some_and(|own| !has_formula(own))
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

    /// Whether an expression vanishes at random points of prime fields, so that a proof of it is worth its time.
    pub(crate) fn seems_to_vanish(&self, e: Expr) -> bool {
        let (residuals, assumptions) = ([e], Assumptions::new());
        let test = ZeroTest {
            options: Options {
                refute: false,
                exact: false,
                ..Options::default()
            },
            ..ZeroTest::everywhere(&residuals, &assumptions)
        };
        matches!(decide_zero(&self.graph, &test), Verdict::Proved(_))
    }

    /// Whether all expressions are proved to vanish identically in the symbols that occur.
    pub fn vanish(&self, residuals: &[Expr]) -> bool {
        matches!(self.vanishing(residuals, false), Verdict::Proved(_))
    }

    /// Whether all expressions vanish identically, with the evidence. The normal n is a unit vector.
    pub fn vanishing(&self, residuals: &[Expr], refute: bool) -> Verdict {
        self.vanishing_where(residuals, refute, &[])
    }

    /// The same where other expressions are not negative.
    pub fn vanishing_where(&self, residuals: &[Expr], refute: bool, known: &[Expr]) -> Verdict {
        let mut assumptions = self.assumptions();
        for &e in known {
            assumptions.assume(e, Relation::GreaterOrEqual, self.graph.zero());
        }
        self.vanishing_under(residuals, refute, &assumptions)
    }

    /// The same under these assumptions alone.
    pub fn vanishing_under(
        &self,
        residuals: &[Expr],
        refute: bool,
        assumed: &Assumptions,
    ) -> Verdict {
        let mut assumptions = Assumptions::new();
        for own in assumed.list() {
            let (left, right) = (self.on_sphere(own.left), self.on_sphere(own.right));
            assumptions.assume(left, own.relation, right);
        }
        let test = |residuals: &[Expr], refute: bool| {
            let test = ZeroTest {
                options: Options {
                    refute,
                    ..Options::default()
                },
                ..ZeroTest::everywhere(residuals, &assumptions)
            };
            decide_zero(&self.graph, &test)
        };
        let on_sphere: Vec<Expr> = residuals.iter().map(|&e| self.on_sphere(e)).collect();
        if on_sphere == residuals {
            return test(residuals, refute);
        }
        match test(residuals, false) {
            Verdict::Proved(proof) => Verdict::Proved(proof),
            _ => test(&on_sphere, refute),
        }
    }

    /// The normal as a point of the unit sphere, by stereographic projection; in one dimension it is forward.
    pub(crate) fn on_sphere(&self, e: Expr) -> Expr {
        let g = &self.graph;
        let d = self.dimensions();
        let normals = &self.normal;
        let occurring = self.symbols_in(&[e]);
        if normals.iter().all(|n| !occurring.contains(n)) {
            return e;
        }
        let at: Vec<Expr> = (2..=d)
            .map(|i| g.symbol(&format!("normal_{i}"), 0))
            .collect();
        let square: Vec<Expr> = at.iter().map(|&a| g.powi(a, 2)).collect();
        let square = g.add(&square);
        let below = g.powi(g.add(&[g.one(), square]), -1);
        self.replace(e, &|symbol| {
            let place = normals.iter().position(|&n| n == symbol)?;
            Some(match place {
                0 => g.mul(&[g.sub(g.one(), square), below]),
                i => g.mul(&[g.integer(2), at[i - 1], below]),
            })
        })
    }

    /// `Σ value(symbol) ∂e/∂symbol`, through the arguments of constitutive functions.
    pub fn derive(&self, e: Expr, value: &dyn Fn(Symbol) -> Option<Expr>) -> Expr {
        let g = &self.graph;
        let full = |symbol: Symbol| -> Option<Expr> {
            let application = self.applications.borrow().get(&symbol).cloned();
            let Some(application) = application else {
                return value(symbol);
            };
            let multiplicities = self.function_at(application.function).multiplicities;
            let mut terms = Vec::new();
            for (slot, &argument) in application.arguments.iter().enumerate() {
                let rate = self.derive(argument, value);
                if g.is_zero(rate) {
                    continue;
                }
                let mut by = application.by.clone();
                by.push(slot);
                let slope = self.apply(application.function, &by, &application.arguments);
                terms.push(g.mul(&[g.integer(multiplicities[slot]), slope, rate]));
            }
            (!terms.is_empty()).then(|| g.add(&terms))
        };
        g.derive(&[e], &full).swap_remove(0)
    }

    /// The partial derivative by a jet.
    pub fn partial(&self, e: Expr, jet: &Jet) -> Expr {
        let wanted = self.jet(jet.component, &jet.by);
        let symbol = self.graph.as_symbol(wanted);
        let one = self.graph.one();
        self.derive(e, &|s| (Some(s) == symbol).then_some(one))
    }

    /// The total derivative by an independent variable; the normal is that of a piece and of the surfaces parallel to it.
    pub fn total(&self, e: Expr, axis: usize) -> Expr {
        let coordinate = self.graph.as_symbol(self.coordinates[axis].expr);
        let one = self.graph.one();
        self.derive(e, &|symbol| {
            if Some(symbol) == coordinate {
                return Some(one);
            }
            if symbol == self.distance {
                return self.normal().get(axis).copied();
            }
            if let Some(at) = self.normal.iter().position(|&n| n == symbol) {
                return self.curvature_at(at, axis);
            }
            let jet = self.as_jet(symbol)?;
            let mut by = jet.by;
            by.push(axis);
            Some(self.jet(jet.component, &by))
        })
    }

    /// Several total derivatives.
    pub fn totals(&self, e: Expr, by: &[usize]) -> Expr {
        by.iter().fold(e, |e, &axis| self.total(e, axis))
    }

    /// Replaces symbols, those in arguments of constitutive functions too.
    pub fn replace(&self, e: Expr, value: &dyn Fn(Symbol) -> Option<Expr>) -> Expr {
        let g = &self.graph;
        let mut pairs = Vec::new();
        for symbol in g.symbols_in(&[e]) {
            let application = self.applications.borrow().get(&symbol).cloned();
            let new = match application {
                Some(own) => {
                    let arguments: Vec<Expr> = own
                        .arguments
                        .iter()
                        .map(|&a| self.replace(a, value))
                        .collect();
                    (arguments != own.arguments)
                        .then(|| self.apply(own.function, &own.by, &arguments))
                }
                None => value(symbol),
            };
            if let Some(new) = new {
                pairs.push((g.symbol_expr(symbol), new));
            }
        }
        if pairs.is_empty() {
            e
        } else {
            g.substitute(e, &pairs)
        }
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

    /// All jets that occur, in arguments of constitutive functions too.
    pub fn jets_in(&self, es: &[Expr]) -> BTreeSet<Jet> {
        let mut found = BTreeSet::new();
        for symbol in self.symbols_in(es) {
            found.extend(self.as_jet(symbol));
        }
        found
    }

    /// All symbols that occur, in arguments too, without those of functions.
    pub fn symbols_in(&self, es: &[Expr]) -> BTreeSet<Symbol> {
        let mut found = BTreeSet::new();
        for symbol in self.graph.symbols_in(es) {
            let application = self.applications.borrow().get(&symbol).cloned();
            match application {
                Some(own) => found.extend(self.symbols_in(&own.arguments)),
                None => {
                    found.insert(symbol);
                }
            }
        }
        found
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

/// The independent components of a symmetric tensor: 11, 12, …, 22, ….
pub fn pairs(dimensions: usize) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    for i in 0..dimensions {
        for j in i..dimensions {
            found.push((i, j));
        }
    }
    found
}

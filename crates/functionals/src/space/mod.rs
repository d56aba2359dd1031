//! Jets of fields over space: components, their derivatives as symbols, total derivatives, and constitutive functions.
//!
//! * here: coordinates, components, jets and their calculus,
//! * `constitution`: constitutive functions and their conjugates,
//! * `zero`: what vanishes, and of which sign, under the assumptions.
//!
//! A component and each of its derivatives is a symbol of the graph. A constitutive function applied to arguments is a symbol
//! too, which is differentiated by the chain rule through its own derivatives; a function and its Legendre conjugate undo each
//! other wherever one is applied to the gradient of the other. Both are exact, so that what is proved holds for every energy.

mod cache;
mod constitution;
mod zero;

use cache::{Asked, Cache};
pub use constitution::Function;
pub(crate) use zero::not_sought;

use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::{Expr, Graph, Symbol, Verdict};
use constitution::{Application, Rule};
use rustc_hash::FxHashMap;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

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
    /// Independent variables on which it does not depend.
    pub constant_along: Vec<usize>,
}

/// A component differentiated.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Jet {
    /// Which component.
    pub component: usize,
    /// By what it is differentiated.
    pub by: Multi,
}

/// All symbols of a functional with their calculus.
pub struct Space {
    /// The expressions, which spaces beside each other share.
    pub graph: Rc<Graph>,
    /// Independent variables, those of space first.
    pub coordinates: Vec<Coordinate>,
    components: RefCell<Vec<Component>>,
    functions: RefCell<Vec<Function>>,
    gradients: RefCell<BTreeMap<usize, Rule>>,
    bodies: RefCell<BTreeMap<usize, Rule>>,
    jets: RefCell<BTreeMap<Symbol, Jet>>,
    applications: RefCell<BTreeMap<Symbol, Application>>,
    known: RefCell<BTreeMap<Application, Expr>>,
    /// Functions with special values that reach them through what they are stated by: what they are then is not known.
    specialised: RefCell<BTreeSet<usize>>,
    /// Applications whose values are being looked for.
    sought: RefCell<BTreeSet<Application>>,
    /// The determinants of linear gradients from which the conjugate was computed, or which have none.
    determinants: RefCell<BTreeMap<usize, Expr>>,
    /// Whether pairs of functions are conjugates by their formulas; nothing where one has none.
    conjugations: RefCell<BTreeMap<(usize, usize), Option<Verdict>>>,
    /// The normal, and the distance from the boundary, inwards negative.
    normal: Vec<Symbol>,
    distance: Symbol,
    /// What is assumed of fields, data and parameters.
    assumptions: RefCell<Assumptions>,
    /// Whether expressions vanish, as far as that was asked.
    vanishing: RefCell<BTreeMap<Expr, bool>>,
    /// The symbols that occur in an expression, those of functions too. The same ones are asked for at each step of an elimination.
    symbols: RefCell<FxHashMap<Expr, Rc<[Symbol]>>>,
    /// Whether an expression has a jet with a coefficient without jets.
    linear: RefCell<FxHashMap<Expr, bool>>,
    /// Derivatives and formulas that were asked for.
    cache: Cache,
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
        Space::on(Rc::new(Graph::new()), variables)
    }

    /// Another space with the same expressions and independent variables, in which nothing else is known.
    pub fn beside(&self) -> Space {
        let variables = self.coordinates.iter();
        let variables = variables.map(|own| (own.name.clone(), own.suffix.clone(), own.is_time));
        Space::on(Rc::clone(&self.graph), &variables.collect::<Vec<_>>())
    }

    fn on(graph: Rc<Graph>, variables: &[(String, String, bool)]) -> Space {
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
            specialised: RefCell::default(),
            sought: RefCell::default(),
            determinants: RefCell::default(),
            conjugations: RefCell::default(),
            assumptions: RefCell::default(),
            vanishing: RefCell::default(),
            symbols: RefCell::default(),
            linear: RefCell::default(),
            cache: Cache::default(),
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

    /// Whether a component depends on an independent variable.
    pub fn varies_along(&self, component: usize, axis: usize) -> bool {
        let all = self.components.borrow();
        !all[component].constant_along.contains(&axis)
    }

    /// Whether it depends on all of them: else what holds of it at one place holds of it at others.
    pub fn varies_everywhere(&self, component: usize) -> bool {
        let mut axes = 0..self.coordinates.len();
        axes.all(|axis| self.varies_along(component, axis))
    }

    /// The symbol of a jet; zero where the component does not depend on a variable.
    pub fn jet(&self, component: usize, by: &[usize]) -> Expr {
        let mut by = by.to_vec();
        by.sort_unstable();
        if !by.iter().all(|&axis| self.varies_along(component, axis)) {
            return self.graph.zero();
        }
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

    /// An expression where an independent variable has a value.
    pub fn at(&self, e: Expr, axis: usize, value: Expr) -> Expr {
        let own = self
            .coordinates
            .get(axis)
            .and_then(|c| self.graph.as_symbol(c.expr));
        self.replace(e, &|symbol| (Some(symbol) == own).then_some(value))
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
        let Some(symbol) = symbol.filter(|&own| self.depends(e, own)) else {
            return self.graph.zero();
        };
        self.once(Asked::Partial(e, symbol), || {
            self.derive(e, &|s| (s == symbol).then_some(one))
        })
    }

    /// The total derivative by an independent variable; the normal is that of a piece and of the surfaces parallel to it.
    pub fn total(&self, e: Expr, axis: usize) -> Expr {
        self.once(Asked::Total(e, axis), || self.derived_along(e, axis))
    }

    fn derived_along(&self, e: Expr, axis: usize) -> Expr {
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
        for &symbol in self.written_in(e).iter() {
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

    /// Puts values in for symbols: what stands for a field, or for a derivative of one, has its derivatives stand for theirs.
    pub fn put(&self, e: Expr, pairs: &[(Expr, Expr)]) -> Expr {
        self.replace(e, &|symbol| self.value_among(pairs, symbol))
    }

    fn value_among(&self, pairs: &[(Expr, Expr)], symbol: Symbol) -> Option<Expr> {
        let g = &self.graph;
        let own = g.symbol_expr(symbol);
        if let Some((_, value)) = pairs.iter().find(|(left, _)| *left == own) {
            return Some(*value);
        }
        let jet = self.as_jet(symbol)?;
        let above = |(left, value): &(Expr, Expr)| {
            let of = self.as_jet(g.as_symbol(*left)?)?;
            let beyond = rest(&jet.by, &of.by).filter(|_| of.component == jet.component)?;
            Some((beyond, *value))
        };
        let all = pairs.iter().filter_map(above);
        let (beyond, value) = all.min_by_key(|(beyond, _)| beyond.len())?;
        Some(self.totals(value, &beyond))
    }

    /// All jets that occur, in arguments of constitutive functions too.
    pub fn jets_in(&self, es: &[Expr]) -> BTreeSet<Jet> {
        let mut found = BTreeSet::new();
        for symbol in self.symbols_in(es) {
            found.extend(self.as_jet(symbol));
        }
        found
    }

    /// Whether an expression is linear in a jet, with a coefficient in which no jet occurs. Kept: the same equations are asked often.
    pub(crate) fn is_linear_in_a_jet(&self, e: Expr) -> bool {
        if let Some(&known) = self.linear.borrow().get(&e) {
            return known;
        }
        let jets = self.jets_in(&[e]);
        let mut slopes = jets.iter().map(|jet| self.partial(e, jet));
        let found = slopes.any(|slope| self.jets_in(&[slope]).is_empty());
        self.linear.borrow_mut().insert(e, found);
        found
    }

    /// Whether an independent variable occurs, in arguments too.
    pub(crate) fn is_of_place(&self, es: &[Expr]) -> bool {
        let symbols = self.symbols_in(es);
        let mut places = self
            .coordinates
            .iter()
            .filter_map(|c| self.graph.as_symbol(c.expr));
        places.any(|place| symbols.contains(&place))
    }

    /// All symbols that occur, in arguments too, without those of functions.
    pub fn symbols_in(&self, es: &[Expr]) -> BTreeSet<Symbol> {
        let mut found = BTreeSet::new();
        for symbol in es.iter().flat_map(|&e| self.written_in(e).to_vec()) {
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

    /// Whether a constitutive function occurs.
    pub(crate) fn has_applications(&self, e: Expr) -> bool {
        let applications = self.applications.borrow();
        self.written_in(e)
            .iter()
            .any(|symbol| applications.contains_key(symbol))
    }

    /// Whether a symbol occurs, in arguments too.
    fn depends(&self, e: Expr, wanted: Symbol) -> bool {
        let symbols = self.written_in(e);
        let applications = self.applications.borrow();
        let mut all = symbols.iter();
        all.any(|symbol| {
            let application = applications.get(symbol);
            *symbol == wanted
                || application.is_some_and(|own| {
                    let mut arguments = own.arguments.iter();
                    arguments.any(|&argument| self.depends(argument, wanted))
                })
        })
    }

    /// The symbols in an expression, those of functions too, not those in their arguments.
    fn written_in(&self, e: Expr) -> Rc<[Symbol]> {
        if let Some(known) = self.symbols.borrow().get(&e) {
            return Rc::clone(known);
        }
        let found: Rc<[Symbol]> = self.graph.symbols_in(&[e]).into_iter().collect();
        self.symbols.borrow_mut().insert(e, Rc::clone(&found));
        found
    }
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

/// By what one derivative is differentiated to give another; nothing where it does not.
pub(crate) fn rest(more: &[usize], less: &[usize]) -> Option<Vec<usize>> {
    let mut rest = more.to_vec();
    for axis in less {
        let at = rest.iter().position(|own| own == axis)?;
        rest.remove(at);
    }
    Some(rest)
}

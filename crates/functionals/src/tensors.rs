//! What names mean, and index notation written out in components.

use crate::notation::{free_letters, Atom, Index, Kind, Names, Node};
use crate::space::{pairs, Space};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::{Expr, Function};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// The function of a tensor of rank two that every functional knows.
pub const DETERMINANT: &str = "det";

/// What kind of tensor a field, data or a parameter is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One component.
    Scalar,
    /// A vector.
    Vector,
    /// A symmetric tensor of rank two: a component off the diagonal is one unknown.
    Symmetric,
    /// A tensor of rank two.
    Matrix,
    /// A tensor of elastic constants: symmetric within each pair of indices, and in the two pairs.
    Elastic,
    /// A tensor of rank four that is symmetric within each pair of indices only.
    Minor,
}

impl Shape {
    /// The words of model files.
    pub const WORDS: [(&'static str, Shape); 6] = [
        ("scalar", Shape::Scalar),
        ("vector", Shape::Vector),
        ("symmetric", Shape::Symmetric),
        ("matrix", Shape::Matrix),
        ("elastic", Shape::Elastic),
        ("minor", Shape::Minor),
    ];

    /// The number of indices.
    pub fn rank(self) -> usize {
        match self {
            Shape::Scalar => 0,
            Shape::Vector => 1,
            Shape::Symmetric | Shape::Matrix => 2,
            Shape::Elastic | Shape::Minor => 4,
        }
    }

    /// The word of model files.
    pub fn word(self) -> &'static str {
        let mut known = Self::WORDS.into_iter();
        known
            .find(|(_, shape)| *shape == self)
            .map_or("", |(word, _)| word)
    }

    /// The independent components, each with how often it occurs.
    pub fn components(self, d: usize) -> Vec<(Vec<usize>, i64)> {
        match self {
            Shape::Scalar => vec![(Vec::new(), 1)],
            Shape::Vector => (0..d).map(|i| (vec![i], 1)).collect(),
            Shape::Symmetric => pairs(d)
                .into_iter()
                .map(|(i, j)| (vec![i, j], if i == j { 1 } else { 2 }))
                .collect(),
            Shape::Matrix => tuples(2, d).into_iter().map(|t| (t, 1)).collect(),
            Shape::Elastic | Shape::Minor => {
                let all = tuples(4, d).into_iter();
                let independent = all.filter(|t| self.canonical(t) == *t);
                independent.map(|t| (t, 1)).collect()
            }
        }
    }

    /// The independent component that indices name.
    pub fn canonical(self, indices: &[usize]) -> Vec<usize> {
        let mut own = indices.to_vec();
        match self {
            Shape::Symmetric => own.sort_unstable(),
            Shape::Elastic | Shape::Minor => {
                if let [i, j, k, l] = own[..] {
                    let (mut one, mut other) = ((i.min(j), i.max(j)), (k.min(l), k.max(l)));
                    if self == Shape::Elastic && other < one {
                        std::mem::swap(&mut one, &mut other);
                    }
                    own = vec![one.0, one.1, other.0, other.1];
                }
            }
            _ => {}
        }
        own
    }
}

/// All tuples of indices.
pub fn tuples(rank: usize, d: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for _ in 0..rank {
        all = all
            .into_iter()
            .flat_map(|tuple: Vec<usize>| {
                (0..d).map(move |i| {
                    let mut longer = tuple.clone();
                    longer.push(i);
                    longer
                })
            })
            .collect();
    }
    all
}

/// What a name stands for.
#[derive(Clone, Debug)]
pub struct Tensor {
    /// Its rank.
    pub rank: usize,
    /// Its components, the last index running fastest.
    pub components: Vec<Expr>,
}

impl Tensor {
    /// The component at indices from 0.
    pub fn at(&self, indices: &[usize], d: usize) -> Option<Expr> {
        let place = indices.iter().fold(0, |place, i| place * d + i);
        self.components.get(place).copied()
    }
}

/// The names of one functional.
#[derive(Clone, Debug)]
pub struct Scope {
    /// The symbols.
    pub space: Rc<Space>,
    /// Tensors by name.
    pub tensors: BTreeMap<String, Tensor>,
    /// Integers by name.
    pub sizes: BTreeMap<String, i64>,
    /// Definitions by name: the letters of the left side, and the right side.
    pub definitions: BTreeMap<String, (Vec<char>, Node)>,
    /// Kinds of fields, data and parameters by name.
    pub shapes: BTreeMap<String, Shape>,
    /// Constitutive functions by name, where another file of the same space states others of that name.
    pub functions: BTreeMap<String, usize>,
    /// Those that may be any here, though another file of the same space states a formula.
    pub any: BTreeSet<usize>,
}

impl Names for Scope {
    fn is_zero(&self, scalar: &Node) -> bool {
        let value = self.value(scalar, &Places::new());
        self.space.graph.is_zero(value)
    }

    fn rank(&self, name: &str) -> Option<usize> {
        if self.sizes.contains_key(name) || name == "pi" {
            return Some(0);
        }
        if self.coordinate(name).is_some() {
            return Some(0);
        }
        self.tensors.get(name).map(|tensor| tensor.rank)
    }

    fn function(&self, name: &str) -> Option<usize> {
        if name == DETERMINANT {
            return Some(2);
        }
        let at = self.function_named(name)?;
        Some(self.space.function_at(at).rank)
    }

    fn coordinate(&self, name: &str) -> Option<usize> {
        self.space.coordinates.iter().position(|c| c.name == name)
    }

    fn dimensions(&self) -> usize {
        self.space.dimensions()
    }

    fn all(&self) -> Vec<String> {
        let tensors = self.tensors.keys().cloned();
        let coordinates = self.space.coordinates.iter().map(|c| c.name.clone());
        let sizes = self.sizes.keys().cloned();
        tensors.chain(coordinates).chain(sizes).collect()
    }
}

/// Values of letters.
pub type Places = BTreeMap<char, usize>;

impl Scope {
    /// The constitutive function of a name.
    pub fn function_named(&self, name: &str) -> Option<usize> {
        let own = self.functions.get(name).copied();
        own.or_else(|| self.space.function_named(name))
    }

    /// All components of an expression, its free letters in the given order, the last running fastest.
    pub fn components(&self, node: &Node, letters: &[char]) -> Vec<Expr> {
        let d = self.space.dimensions();
        tuples(letters.len(), d)
            .into_iter()
            .map(|tuple| {
                let places = letters.iter().copied().zip(tuple).collect();
                self.value(node, &places)
            })
            .collect()
    }

    /// Whether a name is a tensor of rank two with equal components off the diagonal.
    pub fn is_symmetric(&self, name: &str) -> bool {
        let d = self.space.dimensions();
        let Some(own) = self.tensors.get(name).filter(|own| own.rank == 2) else {
            return false;
        };
        let mut all = pairs(d).into_iter();
        all.all(|(i, j)| own.at(&[i, j], d) == own.at(&[j, i], d))
    }

    /// The value of a checked expression where its free letters have `places`.
    pub fn value(&self, node: &Node, places: &Places) -> Expr {
        let g = &self.space.graph;
        match &node.kind {
            Kind::Number(value) => g.number(value.clone()),
            Kind::Atom(atom) => self.summed(&letters_at(atom), places, &|own| self.atom(atom, own)),
            Kind::Sum(terms) => {
                let values: Vec<Expr> = terms
                    .iter()
                    .map(|(minus, term)| {
                        let value = self.value(term, places);
                        if *minus {
                            g.neg(value)
                        } else {
                            value
                        }
                    })
                    .collect();
                g.add(&values)
            }
            Kind::Product(factors) => {
                let letters: Vec<char> = factors
                    .iter()
                    .flat_map(|(_, factor)| seen(factor))
                    .collect();
                self.summed(&letters, places, &|own| {
                    let values: Vec<Expr> = factors
                        .iter()
                        .map(|(divides, factor)| {
                            let value = self.value(factor, own);
                            if *divides {
                                g.powi(value, -1)
                            } else {
                                value
                            }
                        })
                        .collect();
                    g.mul(&values)
                })
            }
            Kind::Power(base, exponent) => {
                g.pow(self.value(base, places), self.value(exponent, places))
            }
            Kind::Apply(function, arguments) => self.applied(*function, arguments, places),
            Kind::Root(inner) => g.sqrt(self.value(inner, places)),
            Kind::Derivative(inner, derivatives) => {
                let mut letters = free_letters(inner);
                letters.extend(letters_in(derivatives));
                self.summed(&letters, places, &|own| {
                    let axes = axes(derivatives, own);
                    self.space.totals(self.value(inner, own), &axes)
                })
            }
        }
    }

    fn applied(&self, function: Function, arguments: &[Node], places: &Places) -> Expr {
        let values: Vec<Expr> = arguments.iter().map(|a| self.value(a, places)).collect();
        self.space.graph.apply(function, &values)
    }

    /// The sum over all letters that occur twice and have no value yet.
    fn summed(&self, letters: &[char], places: &Places, value: &dyn Fn(&Places) -> Expr) -> Expr {
        // What occurs twice is summed over here, whatever the letter means outside.
        let mut bound: Vec<char> = Vec::new();
        for letter in letters {
            let count = letters.iter().filter(|own| *own == letter).count();
            if count == 2 && !bound.contains(letter) {
                bound.push(*letter);
            }
        }
        if bound.is_empty() {
            return value(places);
        }
        let d = self.space.dimensions();
        let terms: Vec<Expr> = tuples(bound.len(), d)
            .into_iter()
            .map(|tuple| {
                let mut own = places.clone();
                own.extend(bound.iter().copied().zip(tuple));
                value(&own)
            })
            .collect();
        self.space.graph.add(&terms)
    }

    fn atom(&self, atom: &Atom, places: &Places) -> Expr {
        let g = &self.space.graph;
        let indices = axes(&atom.indices, places);
        let by = axes(&atom.derivatives, places);
        let value = match &atom.argument {
            Some(argument) => self.application(atom, argument, &indices),
            None => self.named(&atom.name, &indices).unwrap_or_else(|| g.zero()),
        };
        self.space.totals(value, &by)
    }

    fn named(&self, name: &str, indices: &[usize]) -> Option<Expr> {
        let g = &self.space.graph;
        if let Some(size) = self.sizes.get(name) {
            return Some(g.integer(*size));
        }
        if name == "pi" {
            return Some(g.pi());
        }
        if let Some(axis) = self.coordinate(name) {
            return Some(self.space.coordinates[axis].expr);
        }
        self.tensors.get(name)?.at(indices, self.space.dimensions())
    }

    /// The independent components of the argument of a function.
    pub fn argument(&self, function: usize, argument: &Node) -> Vec<Expr> {
        let d = self.space.dimensions();
        let rank = self.space.function_at(function).rank;
        let slots: Vec<Vec<usize>> = match rank {
            2 => pairs(d).into_iter().map(|(i, j)| vec![i, j]).collect(),
            rank => tuples(rank, d),
        };
        if let Kind::Atom(atom) = &argument.kind {
            if atom.indices.is_empty() && rank > 0 {
                let at = |slot: &Vec<usize>| self.named(&atom.name, slot);
                return slots.iter().filter_map(at).collect();
            }
        }
        let letters = free_letters(argument);
        slots
            .into_iter()
            .map(|slot| {
                let places = letters.iter().copied().zip(slot).collect();
                self.value(argument, &places)
            })
            .collect()
    }

    /// The determinant of a tensor of rank two, which need not be symmetric.
    fn determinant(&self, argument: &Node) -> Expr {
        let d = self.space.dimensions();
        let rows = match &argument.kind {
            Kind::Atom(atom) if atom.indices.is_empty() => tuples(2, d)
                .iter()
                .filter_map(|slot| self.named(&atom.name, slot))
                .collect(),
            _ => self.components(argument, &free_letters(argument)),
        };
        let rows: Vec<Vec<Expr>> = rows.chunks(d).map(<[Expr]>::to_vec).collect();
        determinant(&self.space.graph, &rows)
    }

    fn application(&self, atom: &Atom, argument: &Node, indices: &[usize]) -> Expr {
        let g = &self.space.graph;
        if atom.name == DETERMINANT {
            return self.determinant(argument);
        }
        let Some(function) = self.function_named(&atom.name) else {
            return g.zero();
        };
        let arguments = self.argument(function, argument);
        let own = self.space.function_at(function);
        let d = self.space.dimensions();
        let slots: Vec<usize> = match own.rank {
            0 => vec![0; atom.primes as usize],
            rank => indices.chunks(rank).map(|one| slot(rank, one, d)).collect(),
        };
        // Of functions that undo each other nothing but that is used; of others the formula.
        let is_undone = own.conjugate.is_some() && self.space.undoing(function).is_some();
        let is_opaque = is_undone || self.any.contains(&function);
        let stated = if is_opaque {
            None
        } else {
            self.space.body(function, &slots, &arguments)
        };
        stated.unwrap_or_else(|| self.space.apply(function, &slots, &arguments))
    }
}

fn slot(rank: usize, indices: &[usize], d: usize) -> usize {
    match (rank, indices) {
        (2, [i, j]) => {
            let wanted = (*i.min(j), *i.max(j));
            pairs(d)
                .iter()
                .position(|&pair| pair == wanted)
                .unwrap_or(0)
        }
        _ => indices.iter().fold(0, |place, i| place * d + i),
    }
}

fn letters_in(indices: &[Index]) -> impl Iterator<Item = char> + '_ {
    indices.iter().filter_map(|index| match index {
        Index::Letter(letter) => Some(*letter),
        Index::Place(_) => None,
    })
}

fn letters_at(atom: &Atom) -> Vec<char> {
    letters_in(&atom.indices)
        .chain(letters_in(&atom.derivatives))
        .collect()
}

/// The letters of a factor that its product sees: a trace is summed over where it is written.
fn seen(node: &Node) -> Vec<char> {
    match &node.kind {
        Kind::Atom(atom) => {
            let own = letters_at(atom);
            let once = |letter: &char| own.iter().filter(|l| *l == letter).count() == 1;
            own.iter().copied().filter(once).collect()
        }
        _ => free_letters(node),
    }
}

fn axes(indices: &[Index], places: &Places) -> Vec<usize> {
    indices
        .iter()
        .map(|index| match index {
            Index::Place(place) => *place,
            Index::Letter(letter) => places.get(letter).copied().unwrap_or(0),
        })
        .collect()
}

//! What is printed: statements, and the definitions of the names they use.

use super::formula::{Formula, Reference};
use super::layout::Layout;
use super::order::Order;
use super::share::Plan;
use super::Options;
use crate::graph::Graph;
use crate::node::{Expr, Node};
use rustc_hash::{FxHashMap, FxHashSet};

#[derive(Clone, Debug)]
pub(crate) enum Statement {
    Expression(Formula),
    Equation(Formula, Formula),
}

/// The system A s = b.
#[derive(Clone, Debug)]
pub(crate) struct LinearSystem {
    /// Names of the components of s.
    pub(crate) unknowns: Vec<String>,
    /// A, row by row.
    pub(crate) matrix: Vec<Formula>,
    /// b.
    pub(crate) rhs: Vec<Formula>,
}

#[derive(Clone, Debug)]
pub(crate) enum Definition {
    Shared { name: String, value: Formula },
    System(LinearSystem),
}

/// A name of the model that occurs in a document.
#[derive(Clone, Debug)]
pub(crate) struct Name {
    pub(crate) name: String,
    /// Whether it depends on the time.
    pub(crate) moves: bool,
}

/// Expressions or equations laid out for printing, with the definitions of the intermediate results that they share.
///
/// Render it in any [`Format`](super::Format); the notation is the same in all of them.
#[derive(Clone, Debug)]
pub struct Document {
    pub(crate) statements: Vec<Statement>,
    pub(crate) definitions: Vec<Definition>,
    pub(crate) names: Vec<Name>,
    pub(crate) display: std::collections::BTreeMap<String, String>,
}

impl Document {
    /// The names that the definitions introduce, in their order.
    pub(crate) fn defined(&self) -> Vec<&str> {
        self.definitions
            .iter()
            .flat_map(|definition| match definition {
                Definition::Shared { name, .. } => vec![name.as_str()],
                Definition::System(system) => system.unknowns.iter().map(String::as_str).collect(),
            })
            .collect()
    }
}

impl LinearSystem {
    /// The equations of the system one by one: left and right sides, zero coefficients left out.
    pub(crate) fn rows(&self) -> Vec<(Formula, &Formula)> {
        let n = self.unknowns.len();
        self.matrix
            .chunks(n.max(1))
            .zip(&self.rhs)
            .map(|(row, rhs)| (self.row(row), rhs))
            .collect()
    }

    fn row(&self, row: &[Formula]) -> Formula {
        let mut terms = Vec::new();
        for (entry, unknown) in row.iter().zip(&self.unknowns) {
            if entry.is_digit("0") {
                continue;
            }
            let (negative, value) = entry.clone().times(Formula::symbol(unknown));
            terms.push(super::formula::Term { negative, value });
        }
        match terms.len() {
            0 => Formula::integer(0),
            1 => {
                let term = terms.swap_remove(0);
                Formula::signed(term.negative, term.value)
            }
            _ => Formula::Sum(terms),
        }
    }
}

/// What has to be laid out before it can be named.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Piece {
    Shared(Expr),
    System(Expr),
}

impl Piece {
    fn of(reference: Reference) -> Piece {
        match reference {
            Reference::Shared(e) => Piece::Shared(e),
            Reference::Unknown { solve, .. } => Piece::System(solve),
        }
    }
}

enum Task {
    LayOut(Piece),
    Number(Piece, Definition),
}

/// Builds documents over one set of expressions.
pub(crate) struct Builder<'a> {
    g: &'a Graph,
    layout: Layout<'a>,
    tasks: Vec<Task>,
    started: FxHashSet<Piece>,
    definitions: Vec<Definition>,
    prefixes: [String; 2],
    counts: [usize; 2],
    names: FxHashMap<Reference, String>,
}

impl<'a> Builder<'a> {
    pub(crate) fn new(
        g: &'a Graph,
        plan: &'a Plan,
        order: &'a Order<'a>,
        taken: &[&str],
    ) -> Builder<'a> {
        Builder {
            g,
            layout: Layout {
                g,
                plan,
                order,
                references: Vec::new(),
                defining: None,
            },
            tasks: Vec::new(),
            started: FxHashSet::default(),
            definitions: Vec::new(),
            prefixes: [
                free_prefix(&["w", "v", "c"], taken),
                free_prefix(&["s", "z", "y"], taken),
            ],
            counts: [0, 0],
            names: FxHashMap::default(),
        }
    }

    /// Lays out a formula and everything it refers to.
    pub(crate) fn formula(&mut self, lay_out: impl FnOnce(&mut Layout<'a>) -> Formula) -> Formula {
        let formula = lay_out(&mut self.layout);
        self.schedule();
        while let Some(task) = self.tasks.pop() {
            match task {
                Task::LayOut(piece) => {
                    if self.started.insert(piece) {
                        let definition = self.lay_out(piece);
                        self.tasks.push(Task::Number(piece, definition));
                        self.schedule();
                    } else {
                        // Numbered already, or below this piece, which a graph without cycles excludes.
                        continue;
                    }
                }
                Task::Number(piece, definition) => self.number(piece, definition),
            }
        }
        formula
    }

    /// What was referred to first is numbered first.
    fn schedule(&mut self) {
        let references = std::mem::take(&mut self.layout.references);
        let pieces = references.into_iter().rev().map(Piece::of);
        self.tasks.extend(pieces.map(Task::LayOut));
    }

    fn lay_out(&mut self, piece: Piece) -> Definition {
        match piece {
            Piece::Shared(e) => Definition::Shared {
                name: String::new(),
                value: self.layout.definition(e),
            },
            Piece::System(solve) => Definition::System(self.system(solve)),
        }
    }

    fn system(&mut self, solve: Expr) -> LinearSystem {
        let (entries, rhs): (&[Expr], &[Expr]) = match self.g.node(solve) {
            Node::Solve { matrix, rhs } => match self.g.node(*matrix) {
                Node::Matrix { entries, .. } => (entries, rhs),
                _ => (&[], rhs),
            },
            _ => (&[], &[]),
        };
        LinearSystem {
            unknowns: vec![String::new(); rhs.len()],
            matrix: entries.iter().map(|&e| self.layout.formula(e)).collect(),
            rhs: rhs.iter().map(|&e| self.layout.formula(e)).collect(),
        }
    }

    fn next_name(&mut self, kind: usize) -> String {
        self.counts[kind] += 1;
        format!("{}_{}", self.prefixes[kind], self.counts[kind])
    }

    fn number(&mut self, piece: Piece, mut definition: Definition) {
        match (piece, &mut definition) {
            (Piece::Shared(e), Definition::Shared { name, .. }) => {
                *name = self.next_name(0);
                self.names.insert(Reference::Shared(e), name.clone());
            }
            (Piece::System(solve), Definition::System(system)) => {
                for (index, unknown) in system.unknowns.iter_mut().enumerate() {
                    *unknown = self.next_name(1);
                    let index = index as u32;
                    self.names
                        .insert(Reference::Unknown { solve, index }, unknown.clone());
                }
            }
            _ => {}
        }
        self.definitions.push(definition);
    }

    pub(crate) fn finish(
        mut self,
        mut statements: Vec<Statement>,
        names: Vec<Name>,
        options: &Options,
    ) -> Document {
        let table = std::mem::take(&mut self.names);
        // An index beyond the system is a malformed graph; it still gets a readable sign.
        let name = |reference| {
            table
                .get(&reference)
                .cloned()
                .unwrap_or_else(|| "_".to_string())
        };
        for statement in &mut statements {
            match statement {
                Statement::Expression(e) => e.resolve(&name),
                Statement::Equation(left, right) => {
                    left.resolve(&name);
                    right.resolve(&name);
                }
            }
        }
        for definition in &mut self.definitions {
            match definition {
                Definition::Shared { value, .. } => value.resolve(&name),
                Definition::System(system) => {
                    let parts = system.matrix.iter_mut().chain(&mut system.rhs);
                    parts.for_each(|part| part.resolve(&name));
                }
            }
        }
        Document {
            statements,
            definitions: self.definitions,
            names,
            display: options.display.clone(),
        }
    }
}

/// The first letter that the model does not use for a numbered name.
fn free_prefix(letters: &[&str], taken: &[&str]) -> String {
    let is_free = |prefix: &str| {
        !taken.iter().any(|own| {
            let rest = own.strip_prefix(prefix);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
        })
    };
    let mut last = String::new();
    for letter in letters {
        if is_free(letter) {
            return (*letter).to_string();
        }
        last = (*letter).to_string();
    }
    while !is_free(&last) {
        last.push_str("aux");
    }
    last
}

//! The syntax tree: flat, with children before their parents, so that every pass over it is a loop.

use dashu_ratio::RBig;

use super::functions::Builtin;
use super::span::Span;

/// Place of a node in its [`Tree`]. A child is always smaller than its parent.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub(crate) u32);

impl NodeId {
    /// Position in the tree; usable as an index into tables over all nodes.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Operations on two operands.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash)]
pub enum Binary {
    /// `a + b`
    Add,
    /// `a - b`
    Subtract,
    /// `a * b`, and `a b`
    Multiply,
    /// `a / b`
    Divide,
    /// `a ^ b`
    Power,
}

/// A piece of a name: `theta_{i-1}` is the text `theta_` followed by an index.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NamePart {
    /// Letters, digits and underscores, Greek letters written out.
    Text(String),
    /// An integer expression, the index of a family.
    Index(NodeId),
}

/// One node of the tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Node {
    /// An exact number.
    Number(RBig),
    /// A name with its primes.
    Name {
        /// The pieces; one text if the name has no index in braces.
        parts: Vec<NamePart>,
        /// Number of primes, the order of differentiation.
        order: u32,
        /// The name without its primes.
        letters: Span,
        /// Whether an opening parenthesis follows, so that a function may have been meant.
        before_parenthesis: bool,
    },
    /// `-a`
    Negate(NodeId),
    /// An operation on two operands.
    Binary {
        /// Which operation.
        operation: Binary,
        /// Left operand.
        left: NodeId,
        /// Right operand.
        right: NodeId,
    },
    /// A function applied to arguments; the number of arguments is that of the function.
    Call {
        /// Which function.
        function: Builtin,
        /// Its arguments.
        arguments: Vec<NodeId>,
        /// `n` in `sin^n(x)`, which means (sin x)^n.
        power: Option<RBig>,
    },
    /// `sum(index = from..to, body)`, both ends included.
    Sum {
        /// Name of the index.
        index: String,
        /// First value.
        from: NodeId,
        /// Last value.
        to: NodeId,
        /// What is summed.
        body: NodeId,
    },
    /// A part that could not be read; a diagnostic says why.
    Error,
}

/// How two sides compare.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash)]
pub enum Relation {
    /// `=`
    Equal,
    /// `!=`
    NotEqual,
    /// `<`
    Less,
    /// `<=`
    LessOrEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterOrEqual,
}

impl Relation {
    /// The sign as it is written in ASCII.
    pub fn sign(self) -> &'static str {
        match self {
            Relation::Equal => "=",
            Relation::NotEqual => "!=",
            Relation::Less => "<",
            Relation::LessOrEqual => "<=",
            Relation::Greater => ">",
            Relation::GreaterOrEqual => ">=",
        }
    }
}

/// Nodes of one parsed text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tree {
    nodes: Vec<Node>,
    spans: Vec<Span>,
}

impl Tree {
    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there is no node.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The node at a place.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0 as usize]
    }

    /// The text of a node, without parentheses around it.
    pub fn span(&self, id: NodeId) -> Span {
        self.spans[id.0 as usize]
    }

    /// All nodes, children before their parents.
    pub fn iter(&self) -> impl Iterator<Item = (NodeId, &Node)> {
        self.nodes
            .iter()
            .enumerate()
            .map(|(place, node)| (NodeId(place as u32), node))
    }

    /// Whether two parts of short texts are read alike.
    pub(crate) fn means_same(&self, a: NodeId, other: &Tree, b: NodeId) -> bool {
        let same = |a: NodeId, b: NodeId| self.means_same(a, other, b);
        let all = |a: &[NodeId], b: &[NodeId]| {
            a.len() == b.len() && a.iter().zip(b).all(|(&a, &b)| same(a, b))
        };
        match (self.node(a), other.node(b)) {
            (Node::Negate(a), Node::Negate(b)) => same(*a, *b),
            (
                Node::Binary {
                    operation,
                    left,
                    right,
                },
                Node::Binary {
                    operation: own,
                    left: a,
                    right: b,
                },
            ) => operation == own && same(*left, *a) && same(*right, *b),
            (
                Node::Call {
                    function,
                    arguments,
                    power,
                },
                Node::Call {
                    function: own,
                    arguments: others,
                    power: raised,
                },
            ) => function == own && power == raised && all(arguments, others),
            (Node::Number(a), Node::Number(b)) => a == b,
            // Names by their letters, and by the indices in them.
            (
                Node::Name {
                    parts: a, order, ..
                },
                Node::Name {
                    parts: b,
                    order: own,
                    ..
                },
            ) => {
                let part = |(a, b): (&NamePart, &NamePart)| match (a, b) {
                    (NamePart::Text(a), NamePart::Text(b)) => a == b,
                    (NamePart::Index(a), NamePart::Index(b)) => same(*a, *b),
                    _ => false,
                };
                order == own && a.len() == b.len() && a.iter().zip(b).all(part)
            }
            (
                Node::Sum {
                    index,
                    from,
                    to,
                    body,
                },
                Node::Sum {
                    index: own,
                    from: a,
                    to: b,
                    body: c,
                },
            ) => index == own && same(*from, *a) && same(*to, *b) && same(*body, *c),
            _ => false,
        }
    }

    pub(crate) fn push(&mut self, node: Node, span: Span) -> NodeId {
        let id = NodeId(self.nodes.len() as u32);
        self.nodes.push(node);
        self.spans.push(span);
        id
    }

    /// The name of a node that is a name without indices, with its order.
    pub fn plain_name(&self, id: NodeId) -> Option<(&str, u32)> {
        match self.node(id) {
            Node::Name { parts, order, .. } => match parts.as_slice() {
                [NamePart::Text(name)] => Some((name, *order)),
                _ => None,
            },
            _ => None,
        }
    }
}

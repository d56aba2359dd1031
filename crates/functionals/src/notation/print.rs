//! Index notation as text, LaTeX and MathML.

use super::apart::apart;
use super::{Atom, Index, Kind, Node};
use crate::tensors::Scope;
use chetaev_symbolic::print::Format;
use chetaev_symbolic::{rational, Graph, Rational};

/// An expression in a format, in which no index stands more than twice in a term; text reads back as the same expression.
pub fn written(node: &Node, scope: &Scope, format: Format) -> String {
    let inner = written_inside(node, scope, format);
    match format {
        Format::Mathml => format!("<math>{inner}</math>"),
        _ => inner,
    }
}

/// `expression = 0`.
pub fn written_equation(node: &Node, scope: &Scope, format: Format) -> String {
    let inner = written_inside(node, scope, format);
    match format {
        Format::Mathml => format!("<math>{inner}<mo>=</mo><mn>0</mn></math>"),
        _ => format!("{inner} = 0"),
    }
}

fn written_inside(node: &Node, scope: &Scope, format: Format) -> String {
    spelled(&apart(node, scope), scope, format)
}

/// An expression with the letters that it has.
pub(super) fn spelled(node: &Node, scope: &Scope, format: Format) -> String {
    let writer = Writer {
        scope,
        heads: Graph::new(),
        format,
    };
    writer.node(node, Binding::Sum)
}

/// How tightly what stands around binds.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Binding {
    Sum,
    Product,
    Power,
}

struct Writer<'s> {
    scope: &'s Scope,
    heads: Graph,
    format: Format,
}

impl Writer<'_> {
    fn node(&self, node: &Node, around: Binding) -> String {
        match &node.kind {
            Kind::Number(value) => self.number(value, around),
            Kind::Atom(atom) => self.atom(atom),
            Kind::Sum(parts) => {
                let inner = self.sum(parts);
                let is_alone = parts.len() == 1 && parts.iter().all(|(minus, _)| !minus);
                if around > Binding::Sum && !is_alone {
                    self.fenced(&inner)
                } else {
                    inner
                }
            }
            Kind::Product(factors) => {
                let inner = self.product(factors);
                if around > Binding::Product {
                    self.fenced(&inner)
                } else {
                    inner
                }
            }
            Kind::Power(base, exponent) => {
                let (base, exponent) = (
                    self.node(base, Binding::Power),
                    self.node(exponent, Binding::Power),
                );
                match self.format {
                    Format::Latex => format!("{base}^{{{exponent}}}"),
                    Format::Mathml => {
                        format!("<msup><mrow>{base}</mrow><mrow>{exponent}</mrow></msup>")
                    }
                    _ => format!("{base}^{exponent}"),
                }
            }
            Kind::Apply(function, arguments) => {
                let own: Vec<String> = arguments
                    .iter()
                    .map(|a| self.node(a, Binding::Sum))
                    .collect();
                let inner = self.fenced(&own.join(", "));
                match self.format {
                    Format::Latex => format!("\\operatorname{{{}}}{inner}", function.name()),
                    Format::Mathml => format!("<mi>{}</mi>{inner}", function.name()),
                    _ => format!("{}{inner}", function.name()),
                }
            }
            Kind::Root(inner) => {
                let inner = self.node(inner, Binding::Sum);
                match self.format {
                    Format::Latex => format!("\\sqrt{{{inner}}}"),
                    Format::Mathml => format!("<msqrt>{inner}</msqrt>"),
                    _ => format!("sqrt({inner})"),
                }
            }
            Kind::Derivative(inner, by) => {
                let inner = self.fenced(&self.node(inner, Binding::Sum));
                self.indexed(&inner, &[], by)
            }
        }
    }

    fn number(&self, value: &Rational, around: Binding) -> String {
        let g = &self.heads;
        let e = g.number(value.clone());
        let own = match self.format {
            Format::Latex => g.latex(e),
            Format::Mathml => inside(&g.mathml(e)),
            _ => g.text(e),
        };
        let is_plain = rational::to_i64(value).is_some_and(|n| n >= 0);
        if around == Binding::Power && !is_plain {
            self.fenced(&own)
        } else {
            own
        }
    }

    fn sum(&self, parts: &[(bool, Node)]) -> String {
        let (plus, minus) = match self.format {
            Format::Mathml => ("<mo>+</mo>", "<mo>−</mo>"),
            _ => (" + ", " - "),
        };
        let mut out = String::new();
        for (at, (is_minus, part)) in parts.iter().enumerate() {
            let sign = match (at, is_minus) {
                (0, false) => "",
                (0, true) if self.format == Format::Mathml => minus,
                (0, true) => "-",
                (_, false) => plus,
                (_, true) => minus,
            };
            out.push_str(sign);
            out.push_str(&self.node(part, Binding::Product));
        }
        out
    }

    fn product(&self, factors: &[(bool, Node)]) -> String {
        let mut out = String::new();
        for (at, (divides, factor)) in factors.iter().enumerate() {
            // A fraction stands first, and binds as a factor.
            let around = match (&factor.kind, at) {
                (Kind::Number(_), 0) => Binding::Product,
                _ => Binding::Power,
            };
            let own = self.node(factor, around);
            match (at, divides, self.format) {
                (0, false, _) => {}
                (_, true, Format::Mathml) => {
                    out.push_str("<mo lspace=\"0\" rspace=\"0\">/</mo>");
                }
                (0, true, _) => out.push_str("1/"),
                (_, true, _) => out.push('/'),
                (_, false, Format::Mathml) => out.push_str("<mspace width=\"0.17em\"></mspace>"),
                (_, false, Format::Latex) => out.push_str(" \\, "),
                (_, false, _) => out.push(' '),
            }
            out.push_str(&own);
        }
        out
    }

    fn atom(&self, atom: &Atom) -> String {
        let e = self.heads.symbol(&atom.name, 0);
        let head = match self.format {
            Format::Latex => self.heads.latex(e),
            Format::Mathml => inside(&self.heads.mathml(e)),
            _ => atom.name.clone(),
        };
        let own = match &atom.argument {
            Some(argument) => {
                let head = self.primed(&head, atom.primes as usize, &atom.indices);
                let inner = format!("{head}{}", self.fenced(&self.node(argument, Binding::Sum)));
                self.indexed(&inner, &[], &atom.derivatives)
            }
            None => self.indexed(&head, &atom.indices, &atom.derivatives),
        };
        own
    }

    /// The head of a function with its primes, and with indices below them.
    fn primed(&self, head: &str, primes: usize, indices: &[Index]) -> String {
        match (self.format, primes) {
            (_, 0) => self.indexed(head, indices, &[]),
            (Format::Mathml, _) => {
                let all = format!("<mo lspace=\"0\" rspace=\"0\">{}</mo>", "′".repeat(primes));
                let (below, _) = self.places(indices, &[]);
                let below: String = below.iter().map(|own| format!("<mi>{own}</mi>")).collect();
                if below.is_empty() {
                    format!("<msup><mrow>{head}</mrow>{all}</msup>")
                } else {
                    format!("<msubsup><mrow>{head}</mrow><mrow>{below}</mrow>{all}</msubsup>")
                }
            }
            _ => self.indexed(&format!("{head}{}", "'".repeat(primes)), indices, &[]),
        }
    }

    /// Indices and derivatives as they are written.
    fn places(&self, indices: &[Index], by: &[Index]) -> (Vec<String>, Vec<String>) {
        let one = |index: &Index, is_derivative: bool| match index {
            Index::Letter(letter) => letter.to_string(),
            Index::Place(at) if is_derivative => {
                let own = self.scope.space.coordinates.get(*at);
                own.map_or_else(String::new, |c| c.suffix.clone())
            }
            Index::Place(at) => (at + 1).to_string(),
        };
        let lower: Vec<String> = indices.iter().map(|i| one(i, false)).collect();
        (lower, by.iter().map(|i| one(i, true)).collect())
    }

    /// What stands behind an underscore and behind the comma.
    fn indexed(&self, head: &str, indices: &[Index], by: &[Index]) -> String {
        if indices.is_empty() && by.is_empty() {
            return head.to_owned();
        }
        let (lower, behind) = self.places(indices, by);
        match self.format {
            Format::Latex => {
                let comma = if by.is_empty() { "" } else { "," };
                format!("{head}_{{{}{comma}{}}}", lower.concat(), behind.concat())
            }
            Format::Mathml => {
                let mut inner = String::new();
                for letter in lower.iter() {
                    inner.push_str(&format!("<mi>{letter}</mi>"));
                }
                if !by.is_empty() {
                    inner.push_str("<mo lspace=\"0\" rspace=\"0\">,</mo>");
                }
                for letter in behind.iter() {
                    inner.push_str(&format!("<mi>{letter}</mi>"));
                }
                format!("<msub><mrow>{head}</mrow><mrow>{inner}</mrow></msub>")
            }
            _ => {
                let lower = if lower.is_empty() {
                    String::new()
                } else {
                    format!("_{}", lower.concat())
                };
                let comma = if by.is_empty() { "" } else { "," };
                format!("{head}{lower}{comma}{}", behind.concat())
            }
        }
    }

    fn fenced(&self, inner: &str) -> String {
        match self.format {
            Format::Latex => format!("\\left({inner}\\right)"),
            Format::Mathml => format!("<mrow><mo>(</mo>{inner}<mo>)</mo></mrow>"),
            _ => format!("({inner})"),
        }
    }
}

/// The content of a `<math>` element.
fn inside(math: &str) -> String {
    let start = math.find('>').map_or(0, |at| at + 1);
    let end = math.rfind("</math>").unwrap_or(math.len());
    math.get(start..end).unwrap_or(math).to_owned()
}

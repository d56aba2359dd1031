//! Tokens to trees.

use super::{Atom, Index, Kind, Names, Node};
use crate::tensors::{tuples, DETERMINANT};
use chetaev_symbolic::syntax::ast::Relation;
use chetaev_symbolic::syntax::lexer::{tokens, Token, TokenKind};
use chetaev_symbolic::syntax::names::{closest, normalized};
use chetaev_symbolic::syntax::{Diagnostic, Span};
use chetaev_symbolic::zero::assumptions::Relation as Comparison;
use chetaev_symbolic::{Function, Rational};

/// Deepest nesting: reading recurses on parentheses.
const DEEPEST: usize = 100;

/// Reads an expression; `None` where something is wrong, which is then in `problems`.
pub fn parse(text: &str, names: &dyn Names, problems: &mut Vec<Diagnostic>) -> Option<Node> {
    let mut reader = Reader::new(text, names, problems);
    let node = reader.sum()?;
    reader.end()?;
    reader.finished(node)
}

/// Reads `left = right`, or an expression that is claimed to be zero.
pub fn parse_sides(
    text: &str,
    names: &dyn Names,
    problems: &mut Vec<Diagnostic>,
) -> Option<(Node, Option<Node>)> {
    let mut reader = Reader::new(text, names, problems);
    let left = reader.sum()?;
    let right = match reader.kind() {
        Some(TokenKind::Relation(Relation::Equal)) => {
            reader.at += 1;
            Some(reader.sum()?)
        }
        _ => None,
    };
    reader.end()?;
    reader.finished((left, right))
}

/// Reads a comparison, or several in a row: `0 < a < b`.
pub fn parse_comparison(
    text: &str,
    names: &dyn Names,
    problems: &mut Vec<Diagnostic>,
) -> Option<(Vec<Node>, Vec<Comparison>)> {
    let mut reader = Reader::new(text, names, problems);
    let mut sides = vec![reader.sum()?];
    let mut relations = Vec::new();
    while let Some(TokenKind::Relation(written)) = reader.kind().cloned() {
        let span = reader.span();
        let Some(relation) = comparison(written) else {
            let message = "an assumption is a comparison, and this is an equation";
            reader.at += 1;
            if matches!(
                reader.kind(),
                Some(TokenKind::Relation(Relation::Greater | Relation::Less))
            ) {
                let span = span.to(reader.span());
                let message = "this sign has no meaning";
                return reader.fail(
                    Diagnostic::error("not-a-comparison", span, message).hint("write >= or <="),
                );
            }
            return reader.fail(
                Diagnostic::error("not-a-comparison", span, message)
                    .hint("an equation that holds beforehand is stated in [equations] and named under `imposed`"),
            );
        };
        reader.at += 1;
        relations.push(relation);
        sides.push(reader.sum()?);
    }
    reader.end()?;
    if relations.is_empty() {
        let span = Span::new(0, text.len());
        return reader.fail(
            Diagnostic::error("not-a-comparison", span, "an assumption is a comparison")
                .hint("such as \"E > 0\" or \"det(delta_ij + u_i,j) > 0\""),
        );
    }
    reader.finished((sides, relations))
}

fn comparison(written: Relation) -> Option<Comparison> {
    match written {
        Relation::Equal => None,
        Relation::Less => Some(Comparison::Less),
        Relation::LessOrEqual => Some(Comparison::LessOrEqual),
        Relation::Greater => Some(Comparison::Greater),
        Relation::GreaterOrEqual => Some(Comparison::GreaterOrEqual),
        Relation::NotEqual => Some(Comparison::NotEqual),
    }
}

struct Reader<'a> {
    text: &'a str,
    tokens: Vec<Token>,
    at: usize,
    depth: usize,
    names: &'a dyn Names,
    problems: &'a mut Vec<Diagnostic>,
    before: usize,
}

impl<'a> Reader<'a> {
    fn new(text: &'a str, names: &'a dyn Names, problems: &'a mut Vec<Diagnostic>) -> Self {
        let before = problems.len();
        let (tokens, found) = tokens(text);
        problems.extend(found);
        Reader {
            text,
            tokens,
            at: 0,
            depth: 0,
            names,
            problems,
            before,
        }
    }

    fn finished<T>(&self, value: T) -> Option<T> {
        let own = &self.problems[self.before..];
        own.iter().all(|d| !d.is_error()).then_some(value)
    }

    fn kind(&self) -> Option<&TokenKind> {
        self.tokens.get(self.at).map(|token| &token.kind)
    }

    fn span(&self) -> Span {
        match self.tokens.get(self.at) {
            Some(token) => token.span,
            None => Span::empty(self.text.len()),
        }
    }

    fn last_end(&self) -> usize {
        match self.at.checked_sub(1).and_then(|i| self.tokens.get(i)) {
            Some(token) => token.span.end,
            None => 0,
        }
    }

    fn fail<T>(&mut self, diagnostic: Diagnostic) -> Option<T> {
        self.problems.push(diagnostic);
        None
    }

    fn end(&mut self) -> Option<()> {
        if self.at == self.tokens.len() {
            return Some(());
        }
        let span = self.span();
        let written = span.text(self.text).to_owned();
        self.fail(Diagnostic::error(
            "unexpected-token",
            span,
            format!("`{written}` does not belong here"),
        ))
    }

    fn sum(&mut self) -> Option<Node> {
        self.depth += 1;
        if self.depth > DEEPEST {
            let span = self.span();
            return self.fail(Diagnostic::error(
                "too-deep",
                span,
                "parentheses are nested too deeply",
            ));
        }
        let start = self.span();
        let mut terms = vec![(false, self.product()?)];
        loop {
            let minus = match self.kind() {
                Some(TokenKind::Plus) => false,
                Some(TokenKind::Minus) => true,
                _ => break,
            };
            self.at += 1;
            terms.push((minus, self.product()?));
        }
        self.depth -= 1;
        let span = Span::new(start.start, self.last_end());
        Some(match terms.len() {
            1 => terms.swap_remove(0).1,
            _ => Node {
                kind: Kind::Sum(terms),
                span,
            },
        })
    }

    fn product(&mut self) -> Option<Node> {
        let start = self.span();
        let mut minus = false;
        while let Some(TokenKind::Minus | TokenKind::Plus) = self.kind() {
            minus ^= self.kind() == Some(&TokenKind::Minus);
            self.at += 1;
        }
        let mut factors = vec![(false, self.power()?)];
        loop {
            let divides = match self.kind() {
                Some(TokenKind::Star) => false,
                Some(TokenKind::Slash) => true,
                Some(TokenKind::Name(_) | TokenKind::Number(_) | TokenKind::Open) => {
                    factors.push((false, self.power()?));
                    continue;
                }
                _ => break,
            };
            self.at += 1;
            factors.push((divides, self.power()?));
        }
        let span = Span::new(start.start, self.last_end());
        let product = match factors.len() {
            1 => factors.swap_remove(0).1,
            _ => Node {
                kind: Kind::Product(factors),
                span,
            },
        };
        Some(if minus {
            Node {
                kind: Kind::Sum(vec![(true, product)]),
                span,
            }
        } else {
            product
        })
    }

    fn power(&mut self) -> Option<Node> {
        let base = self.primary()?;
        if self.kind() != Some(&TokenKind::Caret) {
            return Some(base);
        }
        self.at += 1;
        let mut minus = false;
        while self.kind() == Some(&TokenKind::Minus) {
            self.at += 1;
            minus = !minus;
        }
        let mut exponent = self.power()?;
        if minus {
            exponent = Node {
                span: exponent.span,
                kind: Kind::Sum(vec![(true, exponent)]),
            };
        }
        Some(Node {
            span: base.span.to(exponent.span),
            kind: Kind::Power(Box::new(base), Box::new(exponent)),
        })
    }

    fn primary(&mut self) -> Option<Node> {
        let span = self.span();
        match self.kind().cloned() {
            Some(TokenKind::Number(value)) => {
                self.at += 1;
                Some(Node {
                    kind: Kind::Number(value),
                    span,
                })
            }
            Some(TokenKind::Open) => {
                self.at += 1;
                let inner = self.sum()?;
                self.close(span)?;
                let derivatives = self.derivatives()?;
                let span = Span::new(span.start, self.last_end());
                Some(if derivatives.is_empty() {
                    Node { span, ..inner }
                } else {
                    Node {
                        kind: Kind::Derivative(Box::new(inner), derivatives),
                        span,
                    }
                })
            }
            Some(TokenKind::Name(name)) => {
                self.at += 1;
                self.name(&name, span)
            }
            _ => {
                let written = span.text(self.text).to_owned();
                let message = if written.is_empty() {
                    "the expression ends too early".to_owned()
                } else {
                    format!("`{written}` does not belong here")
                };
                self.fail(Diagnostic::error("unexpected-token", span, message))
            }
        }
    }

    fn close(&mut self, opened: Span) -> Option<()> {
        if self.kind() == Some(&TokenKind::Close) {
            self.at += 1;
            return Some(());
        }
        self.fail(
            Diagnostic::error(
                "unclosed-parenthesis",
                opened,
                "this parenthesis is never closed",
            )
            .label("opened here"),
        )
    }

    /// Derivatives behind a comma that touches what stands before and behind it.
    fn derivatives(&mut self) -> Option<Vec<Index>> {
        let Some(comma) = self.tokens.get(self.at) else {
            return Some(Vec::new());
        };
        let Some(next) = self.tokens.get(self.at + 1) else {
            return Some(Vec::new());
        };
        let touches = comma.span.start == self.last_end() && comma.span.end == next.span.start;
        let is_index = matches!(next.kind, TokenKind::Name(_) | TokenKind::Number(_));
        if comma.kind != TokenKind::Comma || !touches || !is_index {
            return Some(Vec::new());
        }
        let mut span = next.span;
        self.at += 2;
        // A number ends where letters begin: `w,1j`.
        while let Some(more) = self.tokens.get(self.at) {
            let is_index = matches!(more.kind, TokenKind::Name(_) | TokenKind::Number(_));
            if !is_index || more.span.start != span.end {
                break;
            }
            span = span.to(more.span);
            self.at += 1;
        }
        let text = span.text(self.text).to_owned();
        if let Some(axis) = self.names.coordinate(&normalized(&text)) {
            return Some(vec![Index::Place(axis)]);
        }
        match &self.readings(&text)[..] {
            [] => {}
            [one] => return Some(one.iter().map(|&axis| Index::Place(axis)).collect()),
            _ => {
                let message = format!("the derivative by `{text}` has two readings");
                return self.fail(
                    Diagnostic::error("bad-index", span, message)
                        .hint("put each derivative into parentheses of its own: (u,a),b"),
                );
            }
        }
        let mut found = Vec::new();
        for letter in text.chars() {
            let own = normalized(&letter.to_string());
            match self.names.coordinate(&own) {
                Some(axis) => found.push(Index::Place(axis)),
                None => found.push(self.index(letter, span)?),
            }
        }
        Some(found)
    }

    /// By which coordinates is differentiated where a text is nothing but their names one after the other: each way to read it, ascending.
    fn readings(&self, text: &str) -> Vec<Vec<usize>> {
        if text.is_empty() {
            return vec![Vec::new()];
        }
        let mut found: Vec<Vec<usize>> = Vec::new();
        let ends = text.char_indices().map(|(at, c)| at + c.len_utf8());
        for end in ends {
            let (head, rest) = text.split_at(end);
            let Some(axis) = self.names.coordinate(&normalized(head)) else {
                continue;
            };
            for mut own in self.readings(rest) {
                own.push(axis);
                own.sort_unstable();
                if !found.contains(&own) {
                    found.push(own);
                }
            }
        }
        found
    }

    fn index(&mut self, letter: char, span: Span) -> Option<Index> {
        if self.names.coordinate(&letter.to_string()).is_some() {
            let message = format!("`{letter}` is a coordinate, and no index");
            return self.fail(
                Diagnostic::error("bad-index", span, message)
                    .hint(format!("a derivative stands behind a comma: u,{letter}")),
            );
        }
        let dimensions = self.names.dimensions();
        if let Some(digit) = letter.to_digit(10) {
            let place = digit as usize;
            if place == 0 || place > dimensions {
                return self.fail(
                    Diagnostic::error(
                        "index-out-of-range",
                        span,
                        format!("the index {place} is out of range: the space has {dimensions} dimensions"),
                    )
                    .hint("indices run from 1; `--set d=3` changes the number of dimensions"),
                );
            }
            return Some(Index::Place(place - 1));
        }
        if matches!(letter, 't' | 'x' | 'y' | 'z') {
            let (what, hint) = match letter {
                't' => ("the time", "[domain] time = \"t\" declares it"),
                _ => ("a coordinate", "[domain] coordinates = [\"x\", \"y\"] declares coordinates; of a family x_i the derivatives are u,1 and u,i"),
            };
            return self.fail(
                Diagnostic::error(
                    "bad-index",
                    span,
                    format!("`{letter}` reads as {what}, which this functional does not have"),
                )
                .hint(hint)
                .hint("an index that is summed over has another letter, such as i, j, k"),
            );
        }
        if letter.is_ascii_lowercase() {
            return Some(Index::Letter(letter));
        }
        self.fail(
            Diagnostic::error("bad-index", span, format!("`{letter}` is no index")).hint(
                "an index is a small letter, a number from 1, or behind a comma a coordinate",
            ),
        )
    }

    fn name(&mut self, written: &str, span: Span) -> Option<Node> {
        let mut primes = 0;
        let mut tail = None;
        if let Some(TokenKind::Primes(count)) = self.kind() {
            primes = *count;
            self.at += 1;
            // `A'_ij(e)`: the indices follow the primes.
            if let Some(TokenKind::Name(rest)) = self.kind().cloned() {
                let touches = self.span().start == self.last_end();
                if let Some(indices) = rest.strip_prefix('_').filter(|_| touches) {
                    tail = Some((indices.to_owned(), self.span()));
                    self.at += 1;
                }
            }
        }
        if primes == 0 && self.kind() == Some(&TokenKind::Open) {
            if let Some(letters) = written.strip_prefix("sum_") {
                return self.sum_over(letters, span);
            }
            if let Some(node) = self.elementary(written, span)? {
                return Some(node);
            }
        }
        let (name, letters) = self.split(written, primes, tail.as_ref(), span)?;
        let mut indices = Vec::new();
        for letter in letters.chars() {
            indices.push(self.index(letter, span)?);
        }
        let argument = match self.names.function(&name) {
            Some(_) => Some(Box::new(self.argument(&name)?)),
            None => {
                self.not_of_place(&name, span)?;
                None
            }
        };
        let derivatives = self.derivatives()?;
        Some(Node {
            kind: Kind::Atom(Atom {
                name,
                primes,
                indices,
                derivatives,
                argument,
            }),
            span: Span::new(span.start, self.last_end()),
        })
    }

    /// `q(x)` would be a product: what depends on the place is written without it.
    fn not_of_place(&mut self, name: &str, span: Span) -> Option<()> {
        let touches = self.kind() == Some(&TokenKind::Open) && self.span().start == self.last_end();
        let is_name = self.names.coordinate(name).is_none();
        let mut at = self.at + 1;
        let mut is_place = touches && is_name;
        let place_start = self.span().start;
        while is_place {
            let own = self.tokens.get(at).map(|token| token.span.text(self.text));
            is_place = own.is_some_and(|text| self.names.coordinate(text).is_some());
            match self.tokens.get(at + 1).map(|token| &token.kind) {
                Some(TokenKind::Comma) if is_place => at += 2,
                Some(TokenKind::Close) if is_place => break,
                _ => is_place = false,
            }
        }
        if !is_place {
            return Some(());
        }
        let end = self
            .tokens
            .get(at + 1)
            .map_or(span.end, |token| token.span.end);
        let written = Span::new(place_start, end).text(self.text).to_owned();
        self.fail(
            Diagnostic::error(
                "unexpected-token",
                Span::new(span.start, end),
                format!("`{name}{written}` would be a product"),
            )
            .hint(format!(
                "fields and data depend on the place anyway: write {name}, or {name} * {written} for the product"
            )),
        )
    }

    /// `sum_ij(…)`: the sum over all values of the letters, whatever stands in the parentheses.
    fn sum_over(&mut self, letters: &str, span: Span) -> Option<Node> {
        let opened = self.span();
        self.at += 1;
        let inner = self.sum()?;
        self.close(opened)?;
        let span = Span::new(span.start, self.last_end());
        let letters: Vec<char> = letters.chars().collect();
        let terms = tuples(letters.len(), self.names.dimensions())
            .into_iter()
            .map(|tuple| {
                let places: Vec<(char, usize)> = letters.iter().copied().zip(tuple).collect();
                (false, placed(&inner, &places))
            })
            .collect();
        let kind = Kind::Sum(terms);
        Some(Node { kind, span })
    }

    fn argument(&mut self, name: &str) -> Option<Node> {
        let opened = self.span();
        if self.kind() != Some(&TokenKind::Open) {
            return self.fail(
                Diagnostic::error(
                    "argument-missing",
                    opened,
                    format!("the function `{name}` needs its argument"),
                )
                .hint(format!("write {name}(…)")),
            );
        }
        self.at += 1;
        if let Some(bare) = self.bare_tensor(name) {
            self.at += 2;
            return Some(bare);
        }
        let inner = self.sum()?;
        self.close(opened)?;
        Some(inner)
    }

    /// A tensor named without its indices as the whole argument: `A(e)`.
    fn bare_tensor(&self, function: &str) -> Option<Node> {
        let token = self.tokens.get(self.at)?;
        let TokenKind::Name(name) = &token.kind else {
            return None;
        };
        let closes = self.tokens.get(self.at + 1)?.kind == TokenKind::Close;
        let rank = self.names.rank(name)?;
        (closes && rank > 0 && Some(rank) == self.names.function(function)).then(|| Node {
            kind: Kind::Atom(Atom {
                name: name.clone(),
                primes: 0,
                indices: Vec::new(),
                derivatives: Vec::new(),
                argument: None,
            }),
            span: token.span,
        })
    }

    /// `sin(x)` and the like; `Some(None)` where the name is none of them.
    fn elementary(&mut self, name: &str, span: Span) -> Option<Option<Node>> {
        let function = Function::ALL.into_iter().find(|f| f.name() == name);
        let function = match (function, name) {
            (Some(function), _) => Some(function),
            (None, "ln") => Some(Function::Log),
            (None, "sqrt") => None,
            _ => return Some(None),
        };
        if self.names.rank(name).is_some() || self.names.function(name).is_some() {
            return Some(None);
        }
        let opened = self.span();
        self.at += 1;
        let mut arguments = vec![self.sum()?];
        while self.kind() == Some(&TokenKind::Comma) {
            self.at += 1;
            arguments.push(self.sum()?);
        }
        self.close(opened)?;
        let span = Span::new(span.start, self.last_end());
        let wanted = function.map_or(1, Function::arity);
        if arguments.len() != wanted {
            return self.fail(Diagnostic::error(
                "wrong-arguments",
                span,
                format!(
                    "`{name}` takes {wanted} argument{}",
                    if wanted == 1 { "" } else { "s" }
                ),
            ));
        }
        let kind = match function {
            Some(function) => Kind::Apply(function, arguments),
            None => Kind::Root(Box::new(arguments.swap_remove(0))),
        };
        Some(Some(Node { kind, span }))
    }

    /// The declared name and the letters of its indices.
    fn split(
        &mut self,
        written: &str,
        primes: u32,
        tail: Option<&(String, Span)>,
        span: Span,
    ) -> Option<(String, String)> {
        if let Some((indices, _)) = tail.filter(|_| written != DETERMINANT) {
            if self.names.function(written).is_some() {
                return Some((written.to_owned(), indices.clone()));
            }
        }
        if primes > 0 && (self.names.function(written).is_none() || written == DETERMINANT) {
            return self.fail(
                Diagnostic::error(
                    "prime-of-field",
                    span,
                    format!("`{written}` has no derivative written with primes"),
                )
                .hint("derivatives of fields and of det(…) stand behind a comma: u_k,i or w,xx"),
            );
        }
        let known = |name: &str| {
            let rank = self.names.rank(name);
            rank.or_else(|| self.names.function(name).map(|_| 0))
        };
        if known(written) == Some(0) {
            return Some((written.to_owned(), String::new()));
        }
        let (name, letters) = written.rsplit_once('_').unwrap_or((written, ""));
        match known(name) {
            Some(rank) if rank == letters.chars().count() => {
                Some((name.to_owned(), letters.to_owned()))
            }
            Some(rank) => {
                let counted = letters.chars().count();
                let message = match rank {
                    1 => format!("`{name}` has one index, not {counted}"),
                    _ => format!("`{name}` has {rank} indices, not {counted}"),
                };
                let example: String = "ijkl".chars().take(rank).collect();
                let hint = match rank {
                    0 if self.names.coordinate(letters).is_some() => {
                        format!("a derivative stands behind a comma: {name},{letters}")
                    }
                    0 => format!("write {name}"),
                    _ => format!("write {name}_{example}"),
                };
                self.fail(Diagnostic::error("wrong-rank", span, message).hint(hint))
            }
            None => {
                let all = self.names.all();
                let near = closest(name, all.iter().map(String::as_str));
                let mut diagnostic =
                    Diagnostic::error("unknown-name", span, format!("`{name}` is not declared"));
                if let Some(near) = near {
                    let replacement = if letters.is_empty() {
                        near.to_owned()
                    } else {
                        format!("{near}_{letters}")
                    };
                    diagnostic = diagnostic
                        .hint(format!("did you mean `{near}`?"))
                        .suggest(span, replacement);
                }
                self.fail(diagnostic)
            }
        }
    }
}

/// The expression where letters have values.
fn placed(node: &Node, places: &[(char, usize)]) -> Node {
    let index = |index: &Index| match index {
        Index::Letter(letter) => {
            let known = places.iter().find(|(own, _)| own == letter);
            known.map_or(*index, |(_, place)| Index::Place(*place))
        }
        Index::Place(_) => *index,
    };
    let of = |node: &Node| Box::new(placed(node, places));
    let all = |parts: &[(bool, Node)]| -> Vec<(bool, Node)> {
        parts
            .iter()
            .map(|(sign, part)| (*sign, placed(part, places)))
            .collect()
    };
    let kind = match &node.kind {
        Kind::Number(value) => Kind::Number(value.clone()),
        Kind::Atom(atom) => Kind::Atom(Atom {
            name: atom.name.clone(),
            primes: atom.primes,
            indices: atom.indices.iter().map(index).collect(),
            derivatives: atom.derivatives.iter().map(index).collect(),
            // The letters of an argument are its own.
            argument: atom.argument.clone(),
        }),
        Kind::Sum(terms) => Kind::Sum(all(terms)),
        Kind::Product(factors) => Kind::Product(all(factors)),
        Kind::Power(base, exponent) => Kind::Power(of(base), of(exponent)),
        Kind::Apply(function, arguments) => Kind::Apply(
            *function,
            arguments.iter().map(|a| placed(a, places)).collect(),
        ),
        Kind::Root(inner) => Kind::Root(of(inner)),
        Kind::Derivative(inner, by) => Kind::Derivative(of(inner), by.iter().map(index).collect()),
    };
    Node {
        kind,
        span: node.span,
    }
}

impl Node {
    /// A number as an expression.
    pub fn number(value: i64, span: Span) -> Node {
        Node {
            kind: Kind::Number(Rational::from(value)),
            span,
        }
    }
}

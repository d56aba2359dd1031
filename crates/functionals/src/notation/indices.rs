//! The summation convention: which indices are free, which are summed over, and what breaks the rule.

use super::{Atom, Index, Kind, Names, Node};
use chetaev_symbolic::syntax::{Diagnostic, Span};
use chetaev_symbolic::Rational;
use std::collections::BTreeMap;

/// What the letters of a piece do.
#[derive(Clone, Debug, Default)]
struct Letters {
    /// How often each occurs where the summation convention sees it; the place of the last occurrence.
    seen: BTreeMap<char, (usize, Span)>,
    /// How many sums stand inside each other here.
    sums: u32,
}

/// A sum with more terms than this is refused: written out it would fill the memory before anything is said of it.
const MOST_TERMS: usize = 100_000;

impl Letters {
    fn free(&self) -> Vec<char> {
        let once = self.seen.iter().filter(|(_, (count, _))| *count == 1);
        once.map(|(letter, _)| *letter).collect()
    }

    /// No letters, around parts with so many sums.
    fn of_scalar(parts: impl IntoIterator<Item = u32>) -> Letters {
        Letters {
            sums: parts.into_iter().max().unwrap_or(0),
            ..Letters::default()
        }
    }

    fn add(&mut self, letter: char, count: usize, span: Span) {
        let entry = self.seen.entry(letter).or_insert((0, span));
        entry.0 += count;
        entry.1 = span;
    }
}

/// Checks an expression whose free indices must be `wanted`, in any order; problems are added.
pub fn check(node: &Node, wanted: &[char], names: &dyn Names, problems: &mut Vec<Diagnostic>) {
    let before = problems.len();
    let letters = letters_of(node, names, problems);
    if problems.len() > before {
        return;
    }
    let mut own = letters.free();
    let mut wanted = wanted.to_vec();
    own.sort_unstable();
    wanted.sort_unstable();
    if own != wanted {
        problems.push(mismatch(node.span, &own, &wanted));
    }
}

/// The free letters of an expression in the order of their first occurrence.
pub fn free_letters(node: &Node) -> Vec<char> {
    let mut order = Vec::new();
    collect(node, &mut order);
    let mut distinct: Vec<char> = Vec::new();
    for &letter in &order {
        if !distinct.contains(&letter) {
            distinct.push(letter);
        }
    }
    struct Anything;
    impl Names for Anything {
        fn rank(&self, _: &str) -> Option<usize> {
            None
        }
        fn function(&self, _: &str) -> Option<usize> {
            None
        }
        fn coordinate(&self, _: &str) -> Option<usize> {
            None
        }
        fn dimensions(&self) -> usize {
            0
        }
        fn all(&self) -> Vec<String> {
            Vec::new()
        }
    }
    let free = letters_of(node, &Anything, &mut Vec::new()).free();
    distinct.retain(|letter| free.contains(letter));
    distinct
}

fn collect(node: &Node, order: &mut Vec<char>) {
    let mut push = |indices: &[Index]| {
        order.extend(indices.iter().filter_map(|index| match index {
            Index::Letter(letter) => Some(*letter),
            Index::Place(_) => None,
        }));
    };
    match &node.kind {
        Kind::Number(_) => {}
        Kind::Atom(atom) => {
            push(&atom.indices);
            push(&atom.derivatives);
        }
        Kind::Sum(parts) | Kind::Product(parts) => {
            parts.iter().for_each(|(_, part)| collect(part, order));
        }
        Kind::Power(base, exponent) => {
            collect(base, order);
            collect(exponent, order);
        }
        Kind::Apply(_, arguments) => arguments.iter().for_each(|a| collect(a, order)),
        Kind::Root(inner) => collect(inner, order),
        Kind::Derivative(inner, derivatives) => {
            collect(inner, order);
            push2(derivatives, order);
        }
    }
}

fn push2(indices: &[Index], order: &mut Vec<char>) {
    for index in indices {
        if let Index::Letter(letter) = index {
            order.push(*letter);
        }
    }
}

fn letters_of(node: &Node, names: &dyn Names, problems: &mut Vec<Diagnostic>) -> Letters {
    match &node.kind {
        Kind::Number(_) => Letters::default(),
        Kind::Atom(atom) => of_atom(atom, node.span, names, problems),
        Kind::Sum(terms) => of_sum(terms, names, problems),
        Kind::Product(factors) => of_product(factors, node.span, names, problems),
        Kind::Power(base, exponent) => {
            let parts = [base, exponent].map(|part| scalar(part, "a power", names, problems));
            Letters::of_scalar(parts)
        }
        Kind::Apply(_, arguments) => {
            let what = "the argument of a function";
            Letters::of_scalar(arguments.iter().map(|a| scalar(a, what, names, problems)))
        }
        Kind::Root(inner) => Letters::of_scalar([scalar(inner, "a square root", names, problems)]),
        Kind::Derivative(inner, derivatives) => {
            let own = letters_of(inner, names, problems);
            let mut letters = Letters::of_scalar([own.sums]);
            for letter in own.free() {
                letters.add(letter, 1, inner.span);
            }
            add_all(&mut letters, derivatives, node.span);
            thrice(&letters, problems);
            summed(&mut letters, node.span, names, problems);
            letters
        }
    }
}

fn add_all(letters: &mut Letters, indices: &[Index], span: Span) {
    for index in indices {
        if let Index::Letter(letter) = index {
            letters.add(*letter, 1, span);
        }
    }
}

fn of_atom(atom: &Atom, span: Span, names: &dyn Names, problems: &mut Vec<Diagnostic>) -> Letters {
    let mut letters = Letters::default();
    add_all(&mut letters, &atom.indices, span);
    add_all(&mut letters, &atom.derivatives, span);
    thrice(&letters, problems);
    if let Some(argument) = &atom.argument {
        let before = problems.len();
        let own = letters_of(argument, names, problems).free();
        let known = names.function(&atom.name);
        let rank = known.unwrap_or(0);
        // A tensor may be named without its indices: A(e) is A(e_ij).
        let bare = matches!(&argument.kind, Kind::Atom(a) if a.indices.is_empty());
        if problems.len() == before && !bare && known.is_some() && own.len() != rank {
            problems.push(
                Diagnostic::error(
                    "index-mismatch",
                    argument.span,
                    format!(
                        "the argument of `{}` needs {rank} free indices, and this has {}",
                        atom.name,
                        own.len()
                    ),
                )
                .hint("the free indices of an argument are its own: A(e_ij) is A(e)"),
            );
        }
        let wanted = rank * atom.primes as usize;
        if atom.indices.len() != wanted && names.function(&atom.name).is_some() {
            problems.push(Diagnostic::error(
                "wrong-rank",
                span,
                format!(
                    "this derivative of `{}` has {wanted} indices, not {}",
                    atom.name,
                    atom.indices.len()
                ),
            ));
        }
    }
    letters
}

/// A part that must be a scalar; how many sums stand inside each other in it.
fn scalar(node: &Node, what: &str, names: &dyn Names, problems: &mut Vec<Diagnostic>) -> u32 {
    let before = problems.len();
    let own = letters_of(node, names, problems);
    let free = own.free();
    if problems.len() == before && !free.is_empty() {
        problems.push(
            Diagnostic::error(
                "index-mismatch",
                node.span,
                format!("{what} must be a scalar, and this has {}", told(&free)),
            )
            .hint("write a square as a product: u_i u_i"),
        );
    }
    own.sums
}

fn of_sum(terms: &[(bool, Node)], names: &dyn Names, problems: &mut Vec<Diagnostic>) -> Letters {
    let mut first: Option<(Vec<char>, Span)> = None;
    let mut sums = 0;
    for (_, term) in terms {
        let before = problems.len();
        let own = letters_of(term, names, problems);
        sums = sums.max(own.sums);
        let free = own.free();
        if problems.len() > before {
            continue;
        }
        match &first {
            None => first = Some((free, term.span)),
            Some((wanted, span)) if *wanted != free => {
                let other = mismatch(term.span, &free, wanted);
                problems.push(other.related(*span, format!("this term has {}", told(wanted))));
            }
            Some(_) => {}
        }
    }
    let mut letters = Letters::of_scalar([sums]);
    if let Some((free, span)) = first {
        free.into_iter()
            .for_each(|letter| letters.add(letter, 1, span));
    }
    letters
}

fn of_product(
    factors: &[(bool, Node)],
    span: Span,
    names: &dyn Names,
    problems: &mut Vec<Diagnostic>,
) -> Letters {
    let mut letters = Letters::default();
    for (divides, factor) in factors {
        if *divides {
            letters.sums = letters
                .sums
                .max(scalar(factor, "a divisor", names, problems));
            let is_written = matches!(&factor.kind, Kind::Number(n) if *n == Rational::ZERO);
            let message = if is_written {
                "division by zero"
            } else {
                "division by zero for the values that the model states"
            };
            if is_written || (problems.is_empty() && names.is_zero(factor)) {
                problems.push(Diagnostic::error("division-by-zero", factor.span, message));
            }
            continue;
        }
        let own = letters_of(factor, names, problems);
        letters.sums = letters.sums.max(own.sums);
        // Letters summed over inside parentheses are their own; at a name they count.
        let counts_all = matches!(factor.kind, Kind::Atom(_));
        for (letter, (count, span)) in own.seen {
            if count == 1 || counts_all {
                letters.add(letter, count, span);
            }
        }
    }
    thrice(&letters, problems);
    summed(&mut letters, span, names, problems);
    letters
}

/// Counts the letters that are summed over here, and refuses sums that are too long to be written out.
fn summed(letters: &mut Letters, span: Span, names: &dyn Names, problems: &mut Vec<Diagnostic>) {
    let own = letters.seen.values().filter(|(count, _)| *count == 2);
    letters.sums = letters.sums.saturating_add(own.count() as u32);
    let d = names.dimensions();
    if d.saturating_pow(letters.sums) > MOST_TERMS {
        letters.seen.clear();
        let message = format!(
            "the sum over {} indices has more than {MOST_TERMS} terms in {d} dimensions",
            letters.sums
        );
        letters.sums = 0;
        problems.push(
            Diagnostic::error("too-many-terms", span, message)
                .hint("a product of sums is written shorter: (u_i u_i)^2"),
        );
    }
}

fn thrice(letters: &Letters, problems: &mut Vec<Diagnostic>) {
    for (letter, (count, span)) in &letters.seen {
        if *count > 2 {
            let unused = ('i'..='n').find(|own| !letters.seen.contains_key(own));
            let mut diagnostic = Diagnostic::error(
                "index-thrice",
                *span,
                format!("the index `{letter}` is used {count} times in one product"),
            )
            .label("here once more")
            .hint("an index occurs once where it is free and twice where it is summed over");
            if let Some(other) = unused {
                diagnostic = diagnostic.hint(format!("rename one pair, for example to `{other}`"));
            }
            problems.push(diagnostic);
        }
    }
}

fn told(letters: &[char]) -> String {
    match letters {
        [] => "no free index".into(),
        [one] => format!("the free index {one}"),
        many => {
            let all: Vec<String> = many.iter().map(char::to_string).collect();
            format!("the free indices {}", all.join(", "))
        }
    }
}

fn mismatch(span: Span, own: &[char], wanted: &[char]) -> Diagnostic {
    let message = format!("this has {}, and it needs {}", told(own), told(wanted));
    let diagnostic = Diagnostic::error("index-mismatch", span, message);
    let extra: Vec<char> = own
        .iter()
        .filter(|l| !wanted.contains(l))
        .copied()
        .collect();
    let missing: Vec<char> = wanted
        .iter()
        .filter(|l| !own.contains(l))
        .copied()
        .collect();
    match (&extra[..], &missing[..]) {
        ([one], [other]) => diagnostic.hint(format!("did you mean `{other}` in place of `{one}`?")),
        (['n'], []) => diagnostic
            .hint("an index n is one like the others: the derivative along the normal n of a field w is `n_i w,i`"),
        _ => diagnostic.hint("free indices are the same in all terms and on both sides"),
    }
}

//! Special values of parameters, fields and constitutive functions, put in for what they replace.

use crate::functional::{Constitutive, Functional, Interval, Special, SpecialKind};
use crate::smoothness::Region;
use crate::space::{not_sought, Space};
use chetaev_symbolic::{Expr, Symbol, Verdict};
use std::collections::BTreeSet;

/// Why special values are none of this functional: another value is stated for a parameter or a function, or functions are put in for
/// conjugates that are none of each other, or they violate on a box what the model assumes.
pub(super) fn unfit(
    functional: &Functional,
    values: &[Special],
    intervals: &[Interval],
) -> Option<Verdict> {
    if let Some(stated) = stated_otherwise(functional, values) {
        return Some(Verdict::not_applicable("parameters", stated));
    }
    if let Some(violated) = violated(functional, values, intervals) {
        let said = format!("the stated values violate what the model assumes, {violated}");
        return Some(Verdict::not_applicable("assumptions", said));
    }
    let space = &*functional.space;
    let all: Vec<(usize, Expr)> = functions(values).collect();
    all.iter().find_map(|&(function, value)| {
        let other = space.function_at(function).conjugate?;
        let &(_, conjugate) = all.iter().find(|(own, _)| *own == other)?;
        let names = [function, other].map(|own| space.function_at(own).name);
        match space.are_conjugates((function, value), conjugate) {
            Verdict::Proved(_) => None,
            Verdict::Refuted(_) => Some(Verdict::not_applicable(
                format!("functional.legendre#{}", names[0]),
                format!(
                    "what is put in for {} and {} are no conjugates",
                    names[0], names[1]
                ),
            )),
            _ => Some(Verdict::undecided(format!(
                "whether what is put in for {} and {} are conjugates was not decided",
                names[0], names[1]
            ))),
        }
    })
}

/// Something that the model assumes and that is false for special values, somewhere on a box with its boundary.
pub(super) fn violated(
    functional: &Functional,
    values: &[Special],
    intervals: &[Interval],
) -> Option<String> {
    let space = &*functional.space;
    let g = &space.graph;
    // So many at most stand between a value and what it needs.
    let put =
        |e: Expr| (0..=values.len()).fold(space.explicit(e), |e, _| put_in(functional, values, e));
    let box_of_values = intervals.iter().map(|own| Interval {
        axis: own.axis,
        lower: put(own.lower),
        upper: put(own.upper),
    });
    // What is assumed of fields and data holds on the boundary too, where conditions use it.
    let region = Region::new(space, box_of_values.collect(), true);
    let all = space.assumptions();
    let own = all.list().iter().find(|own| {
        let before = space.explicit(g.sub(own.left, own.right));
        let after = put(before);
        // What is not touched is no matter of the values.
        after != before && region.contradicts(after, own.relation)
    })?;
    let (left, right) = (g.text(own.left), g.text(own.right));
    Some(format!("{left} {} {right}", own.relation.symbol()))
}

/// A value that is stated, and is another than the one that is to be put in.
fn stated_otherwise(functional: &Functional, values: &[Special]) -> Option<String> {
    let space = &*functional.space;
    let g = &space.graph;
    let stated = functional.values();
    let pairs = values.iter().flat_map(|special| match &special.what {
        SpecialKind::Symbols(pairs) => pairs.as_slice(),
        SpecialKind::Size | SpecialKind::Function { .. } => &[],
    });
    let mut other = pairs.filter_map(|(symbol, special)| {
        let (_, value) = stated.iter().find(|(own, _)| own == symbol)?;
        let differs = !g.is_zero(g.sub(*value, *special));
        differs.then(|| {
            let (name, value) = (g.text(*symbol), g.text(*value));
            format!("{name} = {value} is stated, and only what has no stated value can be given another one here")
        })
    });
    other.next().or_else(|| {
        let mut all = functions(values);
        all.find_map(|(function, value)| {
            let own = space.body(function, &[], &space.slots(function))?;
            let is_same = space.vanish(&[g.sub(own, value)]);
            let name = space.function_at(function).name;
            (!is_same).then(|| format!("another value of {name} is stated"))
        })
    })
}

fn functions(values: &[Special]) -> impl Iterator<Item = (usize, Expr)> + '_ {
    values.iter().filter_map(|special| match special.what {
        SpecialKind::Function { function, value } => Some((function, value)),
        SpecialKind::Size | SpecialKind::Symbols(_) => None,
    })
}

/// An expression with special values: functions first, with those conjugates that are computed from them, then symbols, which may occur
/// in what is put in for functions.
pub(super) fn put_in(functional: &Functional, values: &[Special], e: Expr) -> Expr {
    let space = &*functional.space;
    let mut all: Vec<(usize, Expr)> = functions(values).collect();
    for (function, value) in functions(values) {
        let other = space.function_at(function).conjugate;
        let other = other.filter(|other| all.iter().all(|(own, _)| own != other));
        all.extend(other.zip(space.conjugate_of_value(function, value)));
    }
    let each = |e: Expr| {
        all.iter().fold(e, |e, &(function, value)| {
            space.replace_function(e, function, &|arguments| {
                space.at_arguments(function, value, arguments)
            })
        })
    };
    // One may stand in what is put in for another.
    let e = (0..all.len()).fold(space.explicit(e), |e, _| each(e));
    // What is left of functions that are stated by what is put in is not what they were.
    let (put, symbols) = reached(space, values);
    let left = space.functions_in(e).into_iter();
    let left = left.filter(|&own| space.is_stated_by(own, &put, &symbols));
    let e = left.fold(e, |e, function| {
        let special = space.specialised(function);
        space.replace_function(e, function, &|arguments| {
            space.apply(special, &[], arguments)
        })
    });
    values.iter().fold(e, |e, special| match &special.what {
        SpecialKind::Size | SpecialKind::Function { .. } => e,
        SpecialKind::Symbols(pairs) => space.put(e, pairs),
    })
}

/// An expression of another functional that is one for every function: for those of this one with the special values.
pub(super) fn instance(
    (functional, values): (&Functional, &[Special]),
    other: &Functional,
    e: Expr,
) -> Expr {
    let space = &*functional.space;
    let is_open = |own: &Constitutive| own.value.is_none() && own.gradient.is_none();
    let is_any = |own: &&Constitutive| {
        let conjugate = space.function_at(own.function).conjugate;
        let mut all = other.functions.iter();
        is_open(own) && all.all(|f| Some(f.function) != conjugate || is_open(f))
    };
    let any = other.functions.iter().filter(is_any);
    any.fold(e, |e, own| {
        let function = own.function;
        let Some(value) = space.body(function, &[], &space.slots(function)) else {
            return e;
        };
        let value = put_in(functional, values, value);
        space.replace_function(e, function, &|arguments| {
            space.at_arguments(function, value, arguments)
        })
    })
}

/// A verdict on expressions with special values: nothing is refuted where a function is left that is known through what was put in, whose
/// values are not free.
pub(super) fn where_settled(
    functional: &Functional,
    values: &[Special],
    es: &[Expr],
    verdict: Verdict,
) -> Verdict {
    if !matches!(verdict, Verdict::Refuted(_)) {
        return verdict;
    }
    let space = &*functional.space;
    let (put, symbols) = reached(space, values);
    let mut left = es.iter().flat_map(|&e| space.functions_in(e));
    match left.find(|&own| space.is_stated_by(own, &put, &symbols)) {
        Some(own) => Verdict::undecided(not_sought(&space.function_at(own).name)),
        None => verdict,
    }
}

/// The functions and the symbols that are put in for.
fn reached(space: &Space, values: &[Special]) -> (BTreeSet<usize>, BTreeSet<Symbol>) {
    let put = functions(values).map(|(own, _)| own).collect();
    let pairs = values.iter().flat_map(|special| match &special.what {
        SpecialKind::Symbols(pairs) => pairs.as_slice(),
        SpecialKind::Size | SpecialKind::Function { .. } => &[],
    });
    let symbols = pairs.filter_map(|(symbol, _)| space.graph.as_symbol(*symbol));
    (put, symbols.collect())
}

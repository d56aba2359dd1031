//! Words for numbers of things and for lists of names, as messages of all layers have them.

use chetaev_symbolic::verdict::Counterexample;

/// "x = 1, y' in [0.5, 0.6]": the data of a counterexample whose names are relevant.
pub fn point(found: &Counterexample, is_relevant: impl Fn(&str) -> bool) -> String {
    let values: Vec<String> = found
        .point
        .iter()
        .filter(|p| is_relevant(&p.name))
        .map(|p| match (&p.exact, &p.enclosure) {
            (Some(exact), _) => format!("{} = {exact}", p.name),
            (None, Some((low, high))) if low == high => format!("{} = {low}", p.name),
            (None, Some((low, high))) => format!("{} in [{low}, {high}]", p.name),
            _ => p.name.clone(),
        })
        .collect();
    values.join(", ")
}

/// "`a`, `b`".
pub fn quoted<T: AsRef<str>>(names: impl IntoIterator<Item = T>) -> String {
    let quoted: Vec<String> = names
        .into_iter()
        .map(|name| format!("`{}`", name.as_ref()))
        .collect();
    quoted.join(", ")
}

/// "the constraint", "the constraint, differentiated once", "the constraint, differentiated 2 times".
pub fn differentiated_so(what: &str, times: u32) -> String {
    match times {
        0 => what.to_string(),
        1 => format!("{what}, differentiated once"),
        times => format!("{what}, differentiated {times} times"),
    }
}

/// "no constraints", "1 constraint", "2 constraints".
pub fn counted(count: usize, one: &str, many: &str) -> String {
    match count {
        0 => format!("no {many}"),
        1 => format!("1 {one}"),
        count => format!("{count} {many}"),
    }
}

//! Words for numbers of things and for lists of names, as messages of all layers have them.

use chetaev_symbolic::verdict::Counterexample;

/// A number as a person writes it, to six digits: `0.25`, `1.76e11`.
pub fn number(x: f64) -> String {
    significant(x, 6)
}

/// A number to ten digits, where six would not tell two events apart.
pub fn precise_number(x: f64) -> String {
    significant(x, 10)
}

fn significant(x: f64, digits: usize) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let places = digits - 1;
    let rounded = format!("{x:.places$e}").parse::<f64>().unwrap_or(x);
    if (1e-4..1e6).contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

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

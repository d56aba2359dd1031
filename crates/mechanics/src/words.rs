//! Words for numbers of things and for lists of names, as messages of all layers have them.

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

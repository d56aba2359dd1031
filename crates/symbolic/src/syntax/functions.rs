//! The functions that can be written, with their other names and numbers of arguments.

/// A function that an expression may call.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)] // each is the function its name says; a sentence would repeat it
pub enum Builtin {
    Sin,
    Cos,
    Tan,
    Cot,
    Sec,
    Csc,
    Asin,
    Acos,
    Atan,
    Atan2,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Exp,
    Log,
    Sqrt,
    Abs,
    Sign,
}

/// Every function with its name, its other names, and the number of its arguments.
const TABLE: &[(Builtin, &str, &[&str], usize)] = &[
    (Builtin::Sin, "sin", &[], 1),
    (Builtin::Cos, "cos", &[], 1),
    (Builtin::Tan, "tan", &["tg"], 1),
    (Builtin::Cot, "cot", &["ctg"], 1),
    (Builtin::Sec, "sec", &[], 1),
    (Builtin::Csc, "csc", &["cosec"], 1),
    (Builtin::Asin, "asin", &["arcsin"], 1),
    (Builtin::Acos, "acos", &["arccos"], 1),
    (Builtin::Atan, "atan", &["arctan"], 1),
    (Builtin::Atan2, "atan2", &["arctan2"], 2),
    (Builtin::Sinh, "sinh", &["sh"], 1),
    (Builtin::Cosh, "cosh", &["ch"], 1),
    (Builtin::Tanh, "tanh", &["th"], 1),
    (Builtin::Asinh, "asinh", &["arsinh", "arcsinh"], 1),
    (Builtin::Acosh, "acosh", &["arcosh", "arccosh"], 1),
    (Builtin::Atanh, "atanh", &["artanh", "arctanh"], 1),
    (Builtin::Exp, "exp", &[], 1),
    (Builtin::Log, "log", &["ln"], 1),
    (Builtin::Sqrt, "sqrt", &[], 1),
    (Builtin::Abs, "abs", &[], 1),
    (Builtin::Sign, "sign", &["sgn"], 1),
];

/// The short names that other traditions give to functions, but that people also use for quantities (`th`, `ch`,
/// `sh`, `tg`): they are read as names, and are only mentioned when such a name is unknown.
const TRADITIONAL: &[&str] = &["tg", "ctg", "cosec", "sh", "ch", "th"];

impl Builtin {
    /// The function of this name; `ln` is `log`, `arcsin` is `asin`, and so on.
    pub fn of_name(name: &str) -> Option<Builtin> {
        if TRADITIONAL.contains(&name) {
            return None;
        }
        Self::of_any_name(name)
    }

    /// As [`Builtin::of_name`], with the traditional names (`tg`, `sh`, …) that are not read as functions.
    pub fn of_any_name(name: &str) -> Option<Builtin> {
        TABLE
            .iter()
            .find(|(_, own, others, _)| *own == name || others.contains(&name))
            .map(|row| row.0)
    }

    fn row(self) -> &'static (Builtin, &'static str, &'static [&'static str], usize) {
        // The table is written in the order of the enumeration, which a test checks.
        &TABLE[self as usize]
    }

    /// The name under which it is printed.
    pub fn name(self) -> &'static str {
        self.row().1
    }

    /// Number of arguments it takes.
    pub fn arity(self) -> usize {
        self.row().3
    }

    /// Every name of a function, for suggestions.
    pub fn all_names() -> impl Iterator<Item = &'static str> {
        TABLE.iter().map(|row| row.1)
    }
}

/// Whether an expression reads this name as something of its own, so that nothing else may be called so: the time,
/// π, the functions, `sum`.
pub fn is_reserved(name: &str) -> bool {
    name == "t" || name == "pi" || name == "sum" || Builtin::of_name(name).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn table_is_in_the_order_of_the_enumeration() {
        for (place, row) in TABLE.iter().enumerate() {
            assert_eq!(row.0 as usize, place);
            assert_eq!(Builtin::of_name(row.1), Some(row.0));
        }
    }

    #[test]
    fn traditional_names_stay_free_for_quantities() {
        assert_eq!(Builtin::of_name("th"), None);
        assert_eq!(Builtin::of_any_name("th"), Some(Builtin::Tanh));
        assert_eq!(Builtin::of_name("ln"), Some(Builtin::Log));
        assert_eq!(Builtin::of_name("arctan"), Some(Builtin::Atan));
    }
}

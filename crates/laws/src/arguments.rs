//! The arguments of a run of the laws.
//!
//! Plain standard library: the task runner reads the same file, so that it refuses a slip before anything is built.

/// The names of the families, in the order they are run.
pub const FAMILY_NAMES: [&str; 20] = [
    "polynomial-linear",
    "trigonometric-linear",
    "polynomial-nonlinear",
    "trigonometric-nonlinear",
    "nonquadratic",
    "rheonomic-affine",
    "radicals",
    "moving-frame",
    "singular",
    "particles",
    "chaplygin",
    "variable-mass",
    "velocity-mass",
    "second-order-linear",
    "second-order-nonlinear",
    "third-order-linear",
    "third-order-nonlinear",
    "integrable",
    "symmetric",
    "sparse",
];

/// Systems of each family without `--full`.
pub const USUAL_COUNT: u64 = 50;

/// Systems of each family with `--full`.
pub const FULL_COUNT: u64 = 500;

/// What `--help` says.
pub const HELP: &str = "\
Random systems and the laws they must obey

Usage: cargo xtask laws [--full | --count N] [--family NAME] [--seed N]

  --full           500 systems of each family (otherwise 50)
  --count N        N systems of each family
  --family NAME    only this family; may be repeated
  --seed N         only the system with this seed; its model is printed with the verdict of every law
  --help           this text

Families: polynomial-linear, trigonometric-linear, polynomial-nonlinear, trigonometric-nonlinear, nonquadratic,
rheonomic-affine, radicals, moving-frame, singular, particles, chaplygin, variable-mass, velocity-mass,
second-order-linear, second-order-nonlinear, third-order-linear, third-order-nonlinear, integrable,
symmetric, sparse.

Exit status: 0 all laws hold, 1 a law fails, 2 the arguments are wrong.

Examples:
  cargo xtask laws
  cargo xtask laws --full
  cargo xtask laws --family trigonometric-nonlinear --seed 17
";

/// What was asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Arguments {
    /// Names of families.
    pub families: Vec<String>,
    /// Systems of each family.
    pub count: u64,
    /// Only this one.
    pub seed: Option<u64>,
    /// Only the help text.
    pub help: bool,
}

/// Reads the arguments.
///
/// # Errors
/// A sentence naming the slip and what is possible.
pub fn parse(arguments: &[String]) -> Result<Arguments, String> {
    let mut parsed = Arguments {
        families: Vec::new(),
        count: USUAL_COUNT,
        seed: None,
        help: false,
    };
    let mut counted_by: Option<&str> = None;
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        let (name, inline) = match argument.split_once('=') {
            Some((name, value)) => (name, Some(value.to_string())),
            None => (argument.as_str(), None),
        };
        let mut value = || {
            inline
                .clone()
                .or_else(|| rest.next().cloned())
                .ok_or_else(|| format!("`{name}` needs a value"))
        };
        match name {
            "--family" => parsed.families.push(family(&value()?)?),
            "--seed" => parsed.seed = Some(number(name, &value()?)?),
            "--count" => {
                parsed.count = number(name, &value()?)?;
                only_one_count(&mut counted_by, "--count")?;
            }
            "--full" if inline.is_none() => {
                parsed.count = FULL_COUNT;
                only_one_count(&mut counted_by, "--full")?;
            }
            "--help" | "-h" => parsed.help = true,
            _ => {
                return Err(format!(
                    "unknown argument `{argument}`; `cargo xtask laws --help` lists the known ones"
                ))
            }
        }
    }
    if let (Some(by), Some(_)) = (counted_by, parsed.seed) {
        return Err(format!(
            "`{by}` and `--seed` exclude each other: a seed names one system"
        ));
    }
    if parsed.families.is_empty() {
        parsed.families = FAMILY_NAMES.map(str::to_string).to_vec();
    }
    Ok(parsed)
}

fn only_one_count<'a>(counted_by: &mut Option<&'a str>, name: &'a str) -> Result<(), String> {
    match counted_by.replace(name) {
        Some(before) => Err(format!("`{before}` and `{name}` exclude each other")),
        None => Ok(()),
    }
}

fn number(name: &str, value: &str) -> Result<u64, String> {
    value
        .parse()
        .map_err(|_| format!("`{name}` needs a whole number, not `{value}`"))
}

fn family(name: &str) -> Result<String, String> {
    if FAMILY_NAMES.contains(&name) {
        Ok(name.to_string())
    } else {
        Err(format!(
            "no family is called `{name}`; there are {}",
            FAMILY_NAMES.join(", ")
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Result<Arguments, String> {
        let words: Vec<String> = line.split_whitespace().map(str::to_string).collect();
        parse(&words)
    }

    #[test]
    fn a_run_is_asked_for_in_words() {
        let all = read("").unwrap();
        let every = FAMILY_NAMES.len();
        assert_eq!((all.families.len(), all.count, all.seed), (every, 50, None));
        assert_eq!(read("--full").unwrap().count, 500);
        let one = read("--family nonquadratic --seed=17").unwrap();
        assert_eq!(
            (one.families, one.seed),
            (vec!["nonquadratic".into()], Some(17))
        );
        assert!(read("-h").unwrap().help);
        assert!(FAMILY_NAMES.iter().all(|name| HELP.contains(name)));
    }

    #[test]
    fn slips_are_named() {
        for (line, part) in [
            ("--bogus", "`--bogus`"),
            ("--full=3", "`--full=3`"),
            ("--seed", "needs a value"),
            ("--count many", "`many`"),
            ("--family quantum", "`quantum`"),
            ("--full --count 3", "exclude"),
            ("--full --seed 3", "exclude"),
        ] {
            let slip = read(line).unwrap_err();
            assert!(slip.contains(part), "{line}: {slip}");
        }
    }
}

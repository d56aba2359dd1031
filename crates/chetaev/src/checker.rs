//! The checker of the folder `checker`: a program in Python that shares no code with these crates and examines a record.

macro_rules! files {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../../checker/", $name)))),*]
    };
}

/// Names and texts of its files, as they stand in the repository; `check_study.py` is what Python is to run.
pub const FILES: &[(&str, &str)] = files![
    "check_study.py",
    "closure.py",
    "densities.py",
    "differentials.py",
    "equations.py",
    "expressions.py",
    "fields.py",
    "functionals.py",
    "index_notation.py",
    "intervals.py",
    "jets.py",
    "reduced.py",
    "rules.py",
    "systems.py",
    "variations.py",
    "claims/actions.py",
    "claims/closed_forms.py",
    "claims/contents.py",
    "claims/degeneration.py",
    "claims/degrees.py",
    "claims/descent.py",
    "claims/dimensions.py",
    "claims/duality.py",
    "claims/extremum.py",
    "claims/first_variation.py",
    "claims/forms.py",
    "claims/frobenius.py",
    "claims/geometry.py",
    "claims/hoelder.py",
    "claims/identities.py",
    "claims/integrals.py",
    "claims/legendre.py",
    "claims/measure.py",
    "claims/multiplier.py",
    "claims/noether.py",
    "claims/positive.py",
    "claims/principles.py",
    "claims/ranks.py",
    "claims/rates.py",
    "claims/second_kind.py",
    "claims/stated.py",
    "claims/stationary.py",
    "claims/suslov.py",
    "claims/volterra.py",
];

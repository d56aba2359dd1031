//! The table of multi-level principles (T4 §3) with energies that are stated: what is proved of a row for every energy holds for each, and
//! neither formulas nor their conjugates make counterexamples. E3 is the energy that is not quadratic.

use crate::extent::Extent;
use crate::table::{studied_with_energy, unproved, ROWS};

const ANY: &str = "energy-abstract";
const QUADRATIC: &str = "energy-quadratic";
const E3: &str = "energy-cosh";

/// An energy and values of sizes.
type Case = (&'static str, &'static [(&'static str, &'static str)]);

/// Those that take minutes for all rows.
const LONG: &[Case] = &[
    (QUADRATIC, &[("d", "2")]),
    (E3, &[("d", "2")]),
    (ANY, &[("d", "3"), ("nonlinear", "0")]),
    (QUADRATIC, &[("d", "3"), ("nonlinear", "0")]),
    (E3, &[("d", "3"), ("nonlinear", "0")]),
    (QUADRATIC, &[("d", "3")]),
    (E3, &[("d", "3")]),
];

fn proved(row: &str, (energy, set): Case) {
    let study = studied_with_energy(row, energy, set);
    let found: Vec<String> = unproved(row, &study).collect();
    assert!(found.is_empty(), "{energy} {set:?}: {}", found.join("\n"));
}

#[test]
fn rows_with_an_energy_that_is_stated_are_proved_in_one_dimension() {
    for row in ROWS {
        for energy in [QUADRATIC, E3] {
            proved(row, (energy, &[("d", "1")]));
        }
    }
}

/// In several dimensions all of the rows are long: a fifth of them, as of the other long tests.
#[test]
fn rows_with_an_energy_that_is_stated_are_proved_in_several_dimensions() {
    let extent = Extent::of_run(std::path::Path::new(env!("CARGO_MANIFEST_DIR")));
    let all = LONG
        .iter()
        .flat_map(|case| ROWS.iter().map(move |row| (*row, *case)));
    for (_, (row, case)) in (0..).zip(all).filter(|(number, _)| extent.takes(*number)) {
        proved(row, case);
    }
}

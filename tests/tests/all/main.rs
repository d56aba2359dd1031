//! All integration tests of this package in one program, so that the package is linked once. A test is run by its module and name:
//! `cargo test -p chetaev-tests --test all MODULE::`.

mod book;
mod citations;
mod command_line;
mod constraints;
mod derive;
mod derive_code;
mod double_double;
mod edge_cases;
mod ensembles;
mod events;
mod first_integrals;
mod formulations;
mod gallery;
mod gallery_formulations;
mod higher_order;
mod laws;
mod layers;
mod measures;
mod messages;
mod motion;
mod mutants;
mod principles;
mod published;
mod record;
mod series;
mod sheets;
mod special_values;
mod start;
mod strata;
mod symmetries;
mod textbook;
mod textbook_formulations;
mod variable_mass;
mod verify;
mod wrong;

//! All integration tests of this package in one program, so that the package is linked once. A test is run by its module and name:
//! `cargo test -p chetaev-model --test all MODULE::`.

mod bodies;
mod common;
mod complete_integral;
mod documentation;
mod equations;
mod frames;
mod loads;
mod masses;
mod particles;
mod reading;
mod rejections;
mod robustness;
mod units;
mod variation;
mod where_clause;

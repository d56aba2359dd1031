//! The command line of Chetaev.
fn main() {}

//! Zero testing: exact normal form, modular proof, verified refutation.

//! Sparse multivariate polynomials over the rationals and over prime fields.

//! Exact expressions: their calculus, zero testing and printing; owns Verdict. Knows nothing of mechanics.

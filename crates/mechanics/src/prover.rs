//! The bridge between claims about systems and zero tests of expressions.

use crate::characteristics::Manifold;
use crate::system::System;
use chetaev_symbolic::{Expr, Verdict};

/// How hard to try, and with which random choices.
#[derive(Clone, Debug)]
pub struct Prover {
    /// Seed of all random choices; stated in the verdicts.
    pub seed: u64,
    /// Replay with another parametrization of the circle and no simplification (theory 6.6).
    pub replay: bool,
}

impl Default for Prover {
    fn default() -> Prover {
        Prover {
            seed: 0x43_68_65_74_61_65_76,
            replay: false,
        }
    }
}

impl Prover {
    /// Decides whether every residual vanishes on `manifold`; `on` says in words where that is.
    pub fn identity(
        &self,
        _system: &System,
        _residuals: &[Expr],
        _manifold: &Manifold,
        _on: &str,
    ) -> Verdict {
        Verdict::undecided("no zero test is linked in")
    }

    /// Decides whether a square matrix is nonsingular at almost every point of `manifold`; `what` names its determinant.
    pub fn nonsingular(
        &self,
        _system: &System,
        _matrix: &[Vec<Expr>],
        _manifold: &Manifold,
        _what: &str,
    ) -> Verdict {
        Verdict::undecided("no zero test is linked in")
    }

    /// The verdict on independence when some constraints were left out: `follows` says whether they vanish where the
    /// `rank` independent ones do.
    pub fn dependent_rows(
        &self,
        _system: &System,
        _follows: Verdict,
        _names: &str,
        _rank: usize,
    ) -> Verdict {
        Verdict::undecided("no zero test is linked in")
    }
}

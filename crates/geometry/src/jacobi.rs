//! `frame.jacobi`: the structure coefficients of the frame of a model are those of a Lie bracket (T3 §1).
//!
//! `Σ_cyc ( X_a C^e_bc + C^e_ad C^d_bc ) = 0` for all a, b, c from 0 to n, X_0 with the time in it.

use chetaev_mechanics::characteristics::derive_along;
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::{Frame, Manifold, System};
use chetaev_symbolic::{Expr, Verdict};

/// `frame.jacobi`.
#[derive(Clone, Copy, Debug)]
pub struct FrameJacobi;

impl Claim for FrameJacobi {
    fn id(&self) -> &'static str {
        "frame.jacobi"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "The structure coefficients of the frame satisfy Jacobi's identity"
    }

    fn explanation(&self) -> &'static str {
        "The fields X_s of the frame of the model, and X_0, which carries the time, have brackets [X_s, X_u] = C^w_su X_w. They are \
         antisymmetric by construction, and Jacobi's identity for three fields becomes \
         Σ ( X_a C^e_bc + C^e_ad C^d_bc ) = 0, summed over the cyclic permutations of a, b, c: a test of the coefficients and of the fields \
         together."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec!["model.frame-regular".into()]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        match Frame::stated(cx.system, cx.terms, cx.selection) {
            Some(_) => vec![None],
            None => Vec::new(),
        }
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let frame = match Frame::stated(cx.system, cx.terms, cx.selection) {
            Some(Ok((frame, _))) => frame,
            Some(Err(problem)) => return Verdict::undecided(problem.to_string()).into(),
            None => return Verdict::undecided("the model states no frame").into(),
        };
        let structure = Structure::of(cx.system, &frame);
        let mut residuals = structure.residuals(cx.system, &frame);
        residuals.push(cx.system.graph.zero());
        let on = "identically in q, t";
        Finding {
            verdict: cx
                .prover
                .identity(cx.system, &residuals, &Manifold::default(), on),
            formulas: structure.formulas(&frame),
        }
    }
}

/// `C^w_su`, w from 1, s and u from 0.
struct Structure {
    zero: Expr,
    listed: Vec<(usize, usize, usize, Expr)>,
}

impl Structure {
    fn of(system: &System, frame: &Frame) -> Structure {
        Structure {
            zero: system.graph.zero(),
            listed: frame.structure_coefficients(system),
        }
    }

    fn at(&self, system: &System, w: usize, s: usize, u: usize) -> Expr {
        let found = |s, u| {
            let mut listed = self.listed.iter();
            listed.find(|c| (c.0, c.1, c.2) == (w, s, u)).map(|c| c.3)
        };
        match (found(s, u), found(u, s)) {
            (Some(c), _) => c,
            (None, Some(c)) => system.graph.neg(c),
            (None, None) => self.zero,
        }
    }

    fn residuals(&self, system: &System, frame: &Frame) -> Vec<Expr> {
        let (g, n) = (&system.graph, system.n());
        let mut residuals = Vec::new();
        for a in 0..=n {
            for b in a + 1..=n {
                for c in b + 1..=n {
                    for e in 1..=n {
                        let parts = [(a, b, c), (b, c, a), (c, a, b)]
                            .map(|(x, y, z)| self.cyclic_part(system, frame, e, [x, y, z]));
                        residuals.push(g.add(&parts));
                    }
                }
            }
        }
        residuals.retain(|&e| !g.is_zero(e));
        residuals
    }

    /// `X_a C^e_bc + C^e_ad C^d_bc`.
    fn cyclic_part(&self, system: &System, frame: &Frame, e: usize, [a, b, c]: [usize; 3]) -> Expr {
        let g = &system.graph;
        let (field, time) = match a {
            0 => (&frame.drift, g.one()),
            a => (&frame.fields[a - 1], g.zero()),
        };
        let coefficient = self.at(system, e, b, c);
        let mut parts = derive_along(system, &[coefficient], field, time, &[]);
        for d in 1..=system.n() {
            let factors = [self.at(system, e, a, d), self.at(system, d, b, c)];
            if factors.iter().all(|&f| !g.is_zero(f)) {
                parts.push(g.mul(&factors));
            }
        }
        g.add(&parts)
    }

    fn formulas(&self, frame: &Frame) -> Vec<Formula> {
        let name = |s: usize| match s {
            0 => "X_0".to_owned(),
            s => format!("X_{}", frame.speeds[s - 1].name.trim_end_matches('\'')),
        };
        let listed = self.listed.iter().take(SHOWN);
        listed
            .map(|&(w, s, u, c)| Formula {
                caption: format!("component of [{}, {}] along {}", name(s), name(u), name(w)),
                left: None,
                right: c,
            })
            .collect()
    }
}

/// The most coefficients shown.
const SHOWN: usize = 12;

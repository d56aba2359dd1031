//! Fields without their poles: where one velocity is solved for, its coefficient may vanish.

use crate::flag::Directed;
use chetaev_mechanics::Context;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::{simplify, Expr, Graph};

/// The fields times their denominators, which span the same where neither vanishes, and are defined at more places; `None` where they
/// have none. Fields that are solved for one velocity say nothing of where its coefficient vanishes: `x z' = y x'` at x = 0.
pub(super) fn without_poles(cx: &Context<'_>, fields: &[Directed]) -> Option<Vec<Directed>> {
    let g = &cx.system.graph;
    let simple = |e: Expr| simplify::simplify(g, e, &simplify::Options::default());
    let is_whole = |field: &Directed| denominator(g, &field.place) == Some(g.one());
    let fields: Vec<Directed> = fields
        .iter()
        .map(|field| Directed {
            place: field
                .place
                .iter()
                .map(|&e| simplify::by_quotients(g, e))
                .collect(),
            ..field.clone()
        })
        .collect();
    if fields.iter().all(is_whole) {
        return None;
    }
    let scaled = fields.into_iter().map(|field| {
        // What cannot be factorized stays as it is.
        let by = denominator(g, &field.place).unwrap_or(g.one());
        let times = |e: Expr| simple(g.mul(&[by, e]));
        Directed {
            time: times(field.time),
            place: field.place.iter().map(|&e| times(e)).collect(),
            ..field
        }
    });
    Some(scaled.collect())
}

/// The least common denominator; `None` where one of the expressions cannot be factorized.
fn denominator(g: &Graph, es: &[Expr]) -> Option<Expr> {
    let mut powers: Vec<(Expr, i64)> = Vec::new();
    for &e in es.iter().filter(|&&e| !g.is_zero(e)) {
        for (factor, power) in factored(g, e)?.factors {
            if power >= 0 {
                continue;
            }
            match powers.iter_mut().find(|(own, _)| *own == factor) {
                Some((_, own)) => *own = (*own).max(-power),
                None => powers.push((factor, -power)),
            }
        }
    }
    let factors = powers.iter().map(|&(factor, power)| g.powi(factor, power));
    Some(g.mul(&factors.collect::<Vec<Expr>>()))
}

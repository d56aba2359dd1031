//! Ways of solving the constraints for velocities.

use super::candidates;
use crate::characteristics::Parameter;
use crate::elimination::{new_speed, Elimination, Start, Step, Writing};
use crate::system::System;
use crate::terms::MotionTerms;
use chetaev_symbolic::simplify::{simplify_all, Options};
use chetaev_symbolic::{Expr, Function, Node, Symbol};

/// Systems of more coordinates than these are taken as the constraints give them.
pub(super) const SEARCHED: usize = 8;

/// Admissible velocities in speeds.
#[derive(Clone, Debug)]
pub(super) struct Basis {
    pub(super) speeds: Vec<Parameter>,
    pub(super) meanings: Vec<String>,
    pub(super) velocities: Vec<Expr>,
}

/// In which order speeds are taken: with poles nowhere as far as that is possible.
const STEPS: [Step; 4] = [
    Step::Constant,
    Step::Rotation,
    Step::Along,
    Step::Nonvanishing,
];

/// So many pairs of a plane and an angle are tried as axes that turn.
const MOST_AXES: usize = 6;

/// All bases, in a fixed order.
pub(super) fn all(
    system: &System,
    terms: &MotionTerms,
    rows: &[usize],
    start: &Start,
) -> Vec<Basis> {
    let constraints: Vec<Expr> = rows.iter().map(|&row| terms.constraints[row]).collect();
    let new = || Elimination::new(system, Writing::Coefficients);
    let solve = |from: Elimination<'_>, steps: &[Step]| {
        let own = from.by_steps(&constraints, steps, start)?;
        Some(basis(own))
    };
    let mut found = Vec::new();
    found.extend(solve(new(), &STEPS));
    if system.n() > SEARCHED {
        return found;
    }
    let axes = axes(system, &constraints);
    for (pair, angle) in axes {
        // Axes that turn with a body: what is across may vanish by the constraints together.
        let steps = [
            Step::Constant,
            Step::Along,
            Step::Nonvanishing,
            Step::Rotation,
        ];
        found.extend(solve(new().turned(pair, angle), &steps));
    }
    if let Some(own) = found
        .first()
        .and_then(|base| of_kinetic_energy(system, base, start))
    {
        found.push(own);
    }
    found
}

fn basis(own: Elimination<'_>) -> Basis {
    let meaning = |p: &Parameter| {
        let begins = |word: &str| p.name.starts_with(word);
        match p.definition == p.value {
            true => String::new(),
            false if begins("speed") => {
                "speed along the direction that the constraints leave".into()
            }
            false => "rate along the direction that the constraints leave".into(),
        }
    };
    Basis {
        meanings: own.speeds.iter().map(meaning).collect(),
        speeds: own.speeds,
        velocities: own.velocities,
    }
}

/// Pairs of coordinates that are no angles of the constraints, with angles whose sines and cosines occur there.
fn axes(system: &System, constraints: &[Expr]) -> Vec<([usize; 2], Expr)> {
    let g = &system.graph;
    let mut angles: Vec<Symbol> = Vec::new();
    for e in g.reachable(constraints) {
        if let Node::Apply {
            function: Function::Sin | Function::Cos,
            arguments,
        } = g.node(e)
        {
            angles.extend(g.symbols_in(arguments));
        }
    }
    let places = system.coordinates.iter();
    let turning = places.clone().filter(|c| angles.contains(&c.q_symbol));
    let turning: Vec<Expr> = turning.map(|c| c.q).collect();
    let flat: Vec<usize> = (0..system.n())
        .filter(|&i| {
            let c = &system.coordinates[i];
            !angles.contains(&c.q_symbol) && g.any_contains_any(constraints, &[c.v_symbol])
        })
        .collect();
    let pairs = flat.windows(2).map(|pair| [pair[0], pair[1]]);
    pairs
        .flat_map(|pair| turning.iter().map(move |&angle| (pair, angle)))
        .take(MOST_AXES)
        .collect()
}

/// The first linear forms of the kinetic energy that are independent on the constraints, in the place of all speeds; `None` where there
/// are too few, or they are singular at the start.
fn of_kinetic_energy(system: &System, base: &Basis, start: &Start) -> Option<Basis> {
    let g = &system.graph;
    let k = base.speeds.len();
    let symbols: Vec<Symbol> = base.speeds.iter().map(|p| p.symbol).collect();
    let places = system.coordinates.iter().zip(&base.velocities);
    let pairs: Vec<(Expr, Expr)> = places.map(|(c, &v)| (c.v, v)).collect();
    let mut forms: Vec<(Parameter, Expr)> = Vec::new();
    for (i, form) in candidates::forms(system).into_iter().enumerate() {
        let own = g.substitute(form, &pairs);
        let mut all: Vec<Expr> = forms.iter().map(|(_, e)| *e).collect();
        all.push(own);
        let is_single = g.as_symbol(form).is_some();
        if forms.len() < k
            && !g.is_zero(own)
            && start.is_independent(g, &g.jacobian(&all, &symbols))
        {
            let name = format!("{}{i}", candidates::FORM);
            let mut speed = new_speed(g, &name, form);
            if is_single {
                let known = base.speeds.iter().find(|p| p.value == form);
                speed = known?.clone();
            }
            forms.push((speed, own));
        }
    }
    if forms.len() < k || k == 0 {
        return None;
    }
    let rows: Vec<Expr> = forms.iter().map(|(_, e)| *e).collect();
    let at_rest: Vec<(Expr, Expr)> = base.speeds.iter().map(|p| (p.value, g.zero())).collect();
    let right: Vec<Expr> = forms
        .iter()
        .map(|(p, e)| g.sub(p.value, g.substitute(*e, &at_rest)))
        .collect();
    let matrix = simplify_all(
        g,
        &g.jacobian(&rows, &symbols).concat(),
        &Options::default(),
    );
    let solved = g.solve(&matrix, &right).ok()?;
    let solved = simplify_all(g, &solved, &Options::default());
    let old: Vec<(Expr, Expr)> = (base.speeds.iter().zip(&solved))
        .map(|(p, &e)| (p.value, e))
        .collect();
    let velocities = g.substitute_all(&base.velocities, &old);
    Some(Basis {
        meanings: forms
            .iter()
            .map(|(p, _)| {
                if p.definition == p.value {
                    String::new()
                } else {
                    "as the kinetic energy is written".into()
                }
            })
            .collect(),
        speeds: forms.into_iter().map(|(p, _)| p).collect(),
        velocities: simplify_all(g, &velocities, &Options::default()),
    })
}

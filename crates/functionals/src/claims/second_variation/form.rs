//! The second variation as a quadratic form on an interval.

use super::super::solution::rough;
use super::super::special_values::{put_in, unfit};
use crate::functional::{Functional, Interval, Role, Side, Solution, Special, SpecialKind};
use crate::read::on_side;
use crate::space::Jet;
use crate::variation::{variation, Trace};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::{Expr, Verdict};

/// What the second variation is about.
pub(super) const CLAIM: &str = "functional.second-variation";

/// `∫ (v'ᵀ P v' + 2 v'ᵀ Q v + vᵀ R v) dx + Σ_ends vᵀ B v` at a solution.
pub(super) struct Form<'f> {
    pub functional: &'f Functional,
    pub solution: &'f Solution,
    pub components: Vec<usize>,
    /// ∂²L/∂u'_a ∂u'_b.
    pub p: Vec<Vec<Expr>>,
    /// ∂²L/∂u'_a ∂u_b.
    pub q: Vec<Vec<Expr>>,
    /// ∂²L/∂u_a ∂u_b.
    pub r: Vec<Vec<Expr>>,
    pub interval: Interval,
    /// The lower and the upper end.
    pub ends: [End; 2],
}

/// What holds at an end.
pub(super) struct End {
    /// Which components are given.
    pub fixed: Vec<bool>,
    /// The second derivatives of the density there.
    pub b: Vec<Vec<Expr>>,
}

type Step<T> = Result<T, Box<Verdict>>;

fn not_applicable(why: String) -> Box<Verdict> {
    Box::new(Verdict::not_applicable(CLAIM, why))
}

impl<'f> Form<'f> {
    pub(super) fn of(functional: &'f Functional, solution: &'f Solution) -> Step<Form<'f>> {
        let space = &*functional.space;
        if let Some(unfit) = unfit(functional, &solution.values, &solution.intervals) {
            return Err(Box::new(unfit));
        }
        // What holds by a definition restricts nothing.
        let mut imposed = functional.with_role(Role::Imposed);
        if let Some(own) = imposed.find(|own| !space.vanish(&own.residuals)) {
            let said = format!("({}) is imposed, so that not all variations are admitted; the condition of Jacobi for these is not decided", own.label);
            return Err(not_applicable(said));
        }
        if let Some(field) = functional.fields.iter().find(|field| field.on.is_some()) {
            let said = format!("`{}` lives on the boundary and is varied there", field.name);
            return Err(not_applicable(said));
        }
        let components: Vec<usize> = functional
            .interior()
            .flat_map(|f| f.components.clone())
            .collect();
        let jets = space.jets_in(&[functional.density]);
        if let Some(jet) = jets
            .iter()
            .find(|jet| jet.by.len() > 1 && components.contains(&jet.component))
        {
            let name = space.component_at(jet.component).name;
            let said = format!("the density has a second derivative of {name}; Jacobi's condition is decided for first ones");
            return Err(not_applicable(said));
        }
        let idle = components.iter().find(|&&component| {
            let mut own = jets.iter().filter(|jet| jet.component == component);
            !own.any(|jet| jet.by.len() == 1)
        });
        if let Some(&component) = idle {
            let name = space.component_at(component).name;
            let said = format!("the density has no derivative of {name}, so that Legendre's P is singular: where such a field is not eliminated a principle is one of stationarity");
            return Err(not_applicable(said));
        }
        let [interval] = &solution.intervals[..] else {
            return Err(Box::new(Verdict::undecided(
                "the ends of the interval are not stated",
            )));
        };
        let mut own = Form {
            functional,
            solution,
            p: Vec::new(),
            q: Vec::new(),
            r: Vec::new(),
            interval: Interval {
                axis: 0,
                lower: Expr::clone(&interval.lower),
                upper: interval.upper,
            },
            ends: [End::free(), End::free()],
            components,
        };
        own.interval.lower = own.at(interval.lower);
        own.interval.upper = own.at(interval.upper);
        own.p = own.hessian(functional.density, (&[0], &[0]));
        own.q = own.hessian(functional.density, (&[0], &[]));
        own.r = own.hessian(functional.density, (&[], &[]));
        own.ends = [own.end(false)?, own.end(true)?];
        own.is_stationary()?;
        Ok(own)
    }

    /// How many components are varied.
    pub(super) fn count(&self) -> usize {
        self.components.len()
    }

    /// Whether it vanishes for all variations, as all its coefficients do.
    pub(super) fn is_zero(&self) -> bool {
        let space = &*self.functional.space;
        let inside = [&self.p, &self.q, &self.r].into_iter();
        let mut all = inside.chain(self.ends.iter().map(|end| &end.b));
        all.all(|own| {
            let mut entries = own.iter().flatten();
            entries.all(|&e| space.graph.is_zero(e) || space.vanish(&[e]))
        })
    }

    /// Whether Legendre's P is singular everywhere.
    pub(super) fn is_singular(&self) -> bool {
        let space = &*self.functional.space;
        space.vanish(&[determinant(&space.graph, &self.p)])
    }

    fn hessian(&self, density: Expr, (one, other): (&[usize], &[usize])) -> Vec<Vec<Expr>> {
        let space = &*self.functional.space;
        let jet = |component: usize, by: &[usize]| Jet {
            component,
            by: by.to_vec(),
        };
        let row = |&a: &usize| {
            let slope = space.partial(density, &jet(a, one));
            let entry = |&b: &usize| self.at(space.partial(slope, &jet(b, other)));
            self.components.iter().map(entry).collect()
        };
        self.components.iter().map(row).collect()
    }

    fn end(&self, is_upper: bool) -> Step<End> {
        let space = &*self.functional.space;
        let sides = self.solution.pieces.iter();
        let mut here = sides.filter(
            |(_, side)| matches!(side, Side::Flat { is_upper: own, .. } if *own == is_upper),
        );
        let Some((name, side)) = here.next() else {
            return Err(Box::new(Verdict::undecided(
                "which pieces of the boundary are the ends of the interval is not stated",
            )));
        };
        let Some(piece) = self.functional.piece(name) else {
            return Err(Box::new(Verdict::undecided(
                "a piece of the boundary is not stated",
            )));
        };
        let density = on_side(&self.functional.scope, side, piece.density);
        let jets = space.jets_in(&[density]);
        if let Some(jet) = jets
            .iter()
            .find(|jet| !jet.by.is_empty() && self.components.contains(&jet.component))
        {
            let component = space.component_at(jet.component).name;
            return Err(not_applicable(format!(
                "the density on {name} has a derivative of {component}"
            )));
        }
        let Side::Flat { at, .. } = side else {
            return Err(Box::new(Verdict::undecided(
                "an end of the interval is not stated",
            )));
        };
        let place = |e: Expr| {
            let variable = space.coordinates.first().map(|c| c.expr);
            variable.map_or(e, |x| space.graph.substitute(e, &[(x, self.at(*at))]))
        };
        let b = self.hessian(density, (&[], &[]));
        Ok(End {
            fixed: self
                .components
                .iter()
                .map(|&c| piece.fixed.contains(&(c, false)))
                .collect(),
            b: b.into_iter()
                .map(|row| row.into_iter().map(place).collect())
                .collect(),
        })
    }

    /// The second variation decides at stationary fields only.
    fn is_stationary(&self) -> Step<()> {
        let space = &*self.functional.space;
        let name = &self.solution.name;
        if let Some((what, why)) = rough(self.functional, self.solution) {
            return Err(Box::new(Verdict::not_applicable(
                format!("functional.solution#{name}"),
                format!("{what} was not shown to be smooth on the body: {why}"),
            )));
        }
        let varied = variation(self.functional);
        let varied = varied.map_err(|problem| Box::new(Verdict::undecided(problem.to_string())))?;
        let mut residuals: Vec<Expr> = varied.euler.iter().map(|(_, e)| self.at(*e)).collect();
        for on in &varied.pieces {
            let side = self
                .solution
                .pieces
                .iter()
                .find(|(name, _)| *name == on.piece);
            let Some((_, Side::Flat { at, .. })) = side else {
                continue;
            };
            let values = on.conditions.iter().filter(|c| c.trace == Trace::Value);
            let variable = space.coordinates.first().map(|c| c.expr);
            residuals.extend(values.filter_map(|c| {
                let own = on_side(&self.functional.scope, &side?.1, c.value);
                Some(
                    space
                        .graph
                        .substitute(self.at(own), &[(variable?, self.at(*at))]),
                )
            }));
        }
        if residuals
            .iter()
            .all(|&e| space.graph.is_zero(e) || space.vanish(&[e]))
        {
            return Ok(());
        }
        Err(Box::new(Verdict::not_applicable(
            format!("functional.solution#{name}"),
            "the stated fields are not proved to make the functional stationary",
        )))
    }

    /// Stated values put in.
    pub(super) fn at(&self, e: Expr) -> Expr {
        let space = &*self.functional.space;
        let is_function = |s: &&Special| matches!(s.what, SpecialKind::Function { .. });
        let functions: Vec<Special> = self
            .solution
            .values
            .iter()
            .filter(is_function)
            .cloned()
            .collect();
        let e = put_in(self.functional, &functions, e);
        let mut pairs = self.functional.values();
        for special in &self.solution.values {
            if let SpecialKind::Symbols(own) = &special.what {
                pairs.extend(own.iter().copied());
            }
        }
        space.put(space.explicit(e), &pairs)
    }
}

impl End {
    fn free() -> End {
        End {
            fixed: Vec::new(),
            b: Vec::new(),
        }
    }
}

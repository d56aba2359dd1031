//! First integrals about a steady motion: their values up to the second order, exact in the parameters.
//!
//! Three sources: functions that are known to be candidates (the energy, the momenta of ignorable coordinates, what the model states), each
//! kept only after its rate was proved to vanish, or never to be positive; finite constraints; and where all other quasi-velocities x change with
//! the velocities of the coordinates only, `x' = Σ g_a(x, r) r_a'` with a flat connection, the integrals by which x is transported: the
//! momentum equations of Zenkov, Bloch and Marsden (1998), §§ 3–4. The latter exist without being known in finite terms (for the disc they are
//! hypergeometric, Appell and Korteweg 1900); their derivatives at the motion follow from the equation `I_r + I_x g = 0`.

use crate::expansion::Expansion;
use crate::real_roots::sign_of;
use crate::reduction::without;
use crate::steady::closed;
use chetaev_mechanics::characteristics::Direction;
use chetaev_mechanics::constraint::ConstraintKind;
use chetaev_mechanics::prover::assumptions;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::node::{Function, Node};
use chetaev_symbolic::zero::{decide_zero, known_sign, Options, ZeroTest};
use chetaev_symbolic::{Expr, Graph, Symbol, Verdict};
use std::cmp::Ordering;

/// An integral, or a function that never grows, up to the second order in the deviations of the variables from the motion.
#[derive(Clone, Debug)]
pub struct Jet {
    /// What it is.
    pub name: String,
    /// The first derivatives by the variables: coordinates that are not ignorable, then quasi-velocities.
    pub gradient: Vec<Expr>,
    /// The second ones.
    pub hessian: Vec<Vec<Expr>>,
    /// Whether it is no integral, and never grows along any motion.
    pub falls: bool,
    /// It as a function of the variables, where it is known in finite terms.
    pub value: Option<Expr>,
}

impl Expansion<'_> {
    /// Integrals that are known in finite terms, and finite constraints.
    pub fn integrals(&self) -> Vec<Jet> {
        let system = self.system;
        let g = self.graph();
        let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
        let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
        let products = momenta.iter().zip(&velocities);
        let products: Vec<Expr> = products.map(|(&p, &v)| g.mul(&[p, v])).collect();
        let energy = g.sub(g.add(&products), system.lagrangian);
        let mut candidates = vec![(ENERGY.to_owned(), energy)];
        for j in self.own.ignorable(system) {
            let name = format!("the momentum of {}", system.coordinates[j].name);
            candidates.push((name, momenta[j]));
        }
        let stated = system.integrals.iter();
        candidates.extend(stated.map(|(name, e)| (format!("the integral {name}"), *e)));
        let mut known: Vec<Expr> = Vec::new();
        let mut found: Vec<Jet> = Vec::new();
        for (name, e) in candidates {
            let Some(own) = self.of_variables(e).filter(|own| !known.contains(own)) else {
                continue;
            };
            known.push(own);
            let flat = self.flat(&[own], 2);
            if flat.corner.is_some() {
                continue;
            }
            let rate = self.rate(own);
            let is_conserved = rate.is_some_and(|rate| self.vanish(&[rate]));
            if is_conserved || rate.is_some_and(|rate| self.is_dissipated(rate)) {
                let jet = Jet {
                    falls: !is_conserved,
                    ..self.jet(name, own)
                };
                let is_known =
                    |own: &Jet| own.gradient == jet.gradient && own.hessian == jet.hessian;
                if !found.iter().any(is_known) {
                    found.push(jet);
                }
            }
        }
        let finite = self.finite().into_iter();
        let smooth = finite.filter(|&e| self.flat(&[e], 2).corner.is_none());
        found.extend(smooth.map(|e| self.jet(FINITE.into(), e)));
        found
    }

    /// A function as one of the variables, with values for controls and parameters; `None` where it is none.
    fn of_variables(&self, e: Expr) -> Option<Expr> {
        let g = self.graph();
        let own = self.own.characteristics.restrict(self.system, &[e]);
        let own = g.substitute_all(&own, &self.placed_by_constraints());
        let own = g.substitute_all(&own, &self.controls(&own));
        self.without_ignorable(g.substitute_all(&own, &self.values)[0])
    }

    /// Ignorable coordinates that finite constraints give as functions of others, as the height of a bead on a wire.
    fn placed_by_constraints(&self) -> Vec<(Expr, Expr)> {
        let (g, system) = (self.graph(), self.system);
        let rows = self.selection.rows.iter();
        let constraints = rows.map(|&row| &system.constraints[self.terms.constraint_index[row]]);
        let finite = constraints.filter(|c| c.kind == ConstraintKind::Holonomic);
        let ignorable = self.own.ignorable(system);
        let mut found: Vec<(Expr, Expr)> = Vec::new();
        for own in finite {
            let stated = g.substitute(own.stated, &found);
            let solved = ignorable.iter().find_map(|&j| {
                let c = &system.coordinates[j];
                let slope = closed(g, g.diff(stated, c.q_symbol));
                let is_number = g.as_number(slope).is_some() && !g.is_zero(slope);
                let rest = g.substitute(stated, &[(c.q, g.zero())]);
                is_number.then(|| (c.q, g.neg(g.div(rest, slope))))
            });
            found.extend(solved);
        }
        found
    }

    /// A function of coordinates and quasi-velocities without ignorable coordinates and the time; `None` where it depends on them.
    pub(crate) fn without_ignorable(&self, e: Expr) -> Option<Expr> {
        let g = self.graph();
        let mut own = vec![e];
        for j in self.own.ignorable(self.system) {
            let c = &self.system.coordinates[j];
            if g.any_contains_any(&own, &[c.q_symbol]) {
                own = without(g, &own, c.q)?;
            }
        }
        own.pop()
            .filter(|&e| !g.contains_any(e, &[g.intern_symbol("t", 0)]))
    }

    /// The rate of a function along all motions.
    fn rate(&self, e: Expr) -> Option<Expr> {
        let g = self.graph();
        let c = &self.own.characteristics;
        let direction = Direction {
            time: g.one(),
            coordinates: c.velocities.clone(),
            parameters: self.own.equations.rates(g)?,
        };
        let rate = c.along(self.system, &[e], &direction);
        let rate = g.substitute_all(&rate, &self.controls(&rate));
        g.substitute_all(&rate, &self.values).pop()
    }

    /// Whether a rate is proved to be nowhere positive: by the signs of its terms, as `−c |x'| x'²` is, or as `−Pᵀ Q P` with constant Q none of
    /// whose principal minors is negative, which is dissipation by Rayleigh's function (Thomson and Tait 1879).
    fn is_dissipated(&self, rate: Expr) -> bool {
        let g = self.graph();
        // Most momenta grow in some states: those are found before anything is multiplied out.
        if self.is_somewhere_positive(rate) {
            return false;
        }
        let rate = closed(g, self.without_signs(rate));
        if known_sign(g, rate, &assumptions(self.system)).is_nonpositive() {
            return true;
        }
        let speeds = &self.own.characteristics.parameters;
        let second = |e: Expr| -> Vec<Expr> {
            let by = self.own.characteristics.by_parameters(self.system, &[e]);
            by.concat()
        };
        let half = |e: &Expr| closed(g, g.div(g.neg(*e), g.integer(2)));
        let rows = second(rate).into_iter().map(|e| self.at(&second(e)));
        let form: Vec<Vec<Expr>> = rows.map(|row| row.iter().map(half).collect()).collect();
        let mut terms = vec![rate];
        for (row, one) in form.iter().zip(speeds) {
            terms.extend(
                row.iter()
                    .zip(speeds)
                    .map(|(&q, other)| g.mul(&[q, one.value, other.value])),
            );
        }
        is_semidefinite(g, &form) && self.vanish(&[g.add(&terms)])
    }

    /// Whether a function is positive at a state that the constraints and the assumptions admit: `f + |f|` is not zero there.
    fn is_somewhere_positive(&self, f: Expr) -> bool {
        let g = self.graph();
        let implicit = self.own.characteristics.manifold.implicit.clone();
        let constraints = [implicit, self.finite_with_unknowns()].concat();
        let options = Options {
            exact: false,
            ..Options::default()
        };
        let twice = g.add(&[f, g.abs(f)]);
        matches!(
            self.decided(&[twice], &constraints, options),
            Verdict::Refuted(_)
        )
    }

    /// A function with f/|f| for the sign of f, so that `sign(f) f` is seen to be |f|.
    fn without_signs(&self, e: Expr) -> Expr {
        let g = self.graph();
        let as_quotient = |e: Expr| match g.node(e) {
            Node::Apply {
                function: Function::Sign,
                arguments,
            } => {
                let f = *arguments.first()?;
                Some((e, g.div(f, g.abs(f))))
            }
            _ => None,
        };
        let signs: Vec<(Expr, Expr)> = g
            .reachable(&[e])
            .into_iter()
            .filter_map(as_quotient)
            .collect();
        g.substitute(e, &signs)
    }

    /// Whether functions of the variables are proved to vanish: wherever the finite constraints have what values they have, since the equations of
    /// motion keep these; else on the constraints.
    pub(crate) fn vanish(&self, es: &[Expr]) -> bool {
        let implicit = self.own.characteristics.manifold.implicit.clone();
        let finite = self.finite_with_unknowns();
        self.vanish_on(es, &implicit)
            || !finite.is_empty() && self.vanish_on(es, &[implicit, finite].concat())
    }

    /// Finite constraints, each with a coordinate that occurs in it and that it determines.
    fn finite_with_unknowns(&self) -> Vec<(Expr, Symbol)> {
        let g = self.graph();
        let determined = self.reduction().dependent.into_iter();
        let coordinate = |(at, _): (usize, Vec<Expr>)| {
            self.system.coordinates[self.own.coordinates[at]].q_symbol
        };
        let mut free: Vec<Symbol> = determined.map(coordinate).collect();
        let finite = self.finite().into_iter();
        let pair = |e: Expr| {
            let place = free.iter().position(|&s| g.contains_any(e, &[s]))?;
            Some((g.substitute(e, &self.values), free.remove(place)))
        };
        finite.filter_map(pair).collect()
    }

    fn vanish_on(&self, es: &[Expr], implicit: &[(Expr, Symbol)]) -> bool {
        let verdict = self.decided(es, implicit, Options::default());
        matches!(verdict, Verdict::Proved(_))
    }

    /// Whether functions of the variables vanish where constraints hold.
    fn decided(&self, es: &[Expr], implicit: &[(Expr, Symbol)], options: Options) -> Verdict {
        let assumptions = assumptions(self.system);
        let test = ZeroTest {
            residuals: es,
            solved: &[],
            implicit,
            assumptions: &assumptions,
            options,
        };
        decide_zero(self.graph(), &test)
    }

    /// First and second derivatives at the motion.
    fn jet(&self, name: String, e: Expr) -> Jet {
        let flat = self.flat(&[e], 2).functions;
        let first: Vec<Expr> = flat.iter().flat_map(|&e| self.derivatives(e)).collect();
        Jet {
            name,
            gradient: self.at(&first),
            falls: false,
            value: Some(e),
            hessian: first
                .iter()
                .map(|&e| self.at(&self.derivatives(e)))
                .collect(),
        }
    }

    /// The derivatives of a function by the variables.
    pub(crate) fn derivatives(&self, e: Expr) -> Vec<Expr> {
        let c = &self.own.characteristics;
        let by = |&j: &usize| c.along(self.system, &[e], &self.unit(j));
        let mut found: Vec<Expr> = self.own.coordinates.iter().flat_map(by).collect();
        found.extend(c.by_parameters(self.system, &[e]).concat());
        found
    }

    /// The integrals of transport; none where the equations are not of that kind.
    pub fn transported(&self) -> Vec<Jet> {
        self.transport()
            .map(|own| own.jets(self))
            .unwrap_or_default()
    }

    fn transport(&self) -> Option<Transport> {
        let g = self.graph();
        let speeds = &self.own.characteristics.parameters;
        let place = |rate: &Expr| speeds.iter().position(|p| p.value == *rate);
        let shape: Option<Vec<usize>> = self.own.rates.iter().map(place).collect();
        let shape = shape.filter(|own| !own.is_empty() && self.finite().is_empty())?;
        let rest: Vec<usize> = (0..speeds.len()).filter(|s| !shape.contains(s)).collect();
        let rates = self.own.equations.rates(g)?;
        let rates = g.substitute_all(&rates, &self.controls(&rates));
        let rates = g.substitute_all(&rates, &self.values);
        let of_rest: Vec<Expr> = rest.iter().map(|&s| closed(g, rates[s])).collect();
        let columns = shape.iter().map(|&a| {
            let by = of_rest
                .iter()
                .map(|&e| closed(g, g.diff(e, speeds[a].symbol)));
            by.collect::<Vec<Expr>>()
        });
        let own = Transport {
            columns: columns.collect(),
            rest,
            shape,
        };
        (!own.rest.is_empty() && own.is_flat(self, &of_rest)).then_some(own)
    }
}

/// What a finite constraint is called among integrals.
pub(crate) const FINITE: &str = "a finite constraint";

/// What the energy is called among integrals.
pub(crate) const ENERGY: &str = "the energy";

/// Forms in more variables are not looked at: 2ⁿ minors.
const LARGEST: usize = 8;

/// Whether no principal minor of a symmetric matrix of numbers is negative.
fn is_semidefinite(g: &Graph, form: &[Vec<Expr>]) -> bool {
    let n = form.len();
    let is_right = |chosen: usize| {
        let places: Vec<usize> = (0..n).filter(|place| chosen >> place & 1 == 1).collect();
        let row = |&r: &usize| places.iter().map(|&c| form[r][c]).collect();
        let minor: Vec<Vec<Expr>> = places.iter().map(row).collect();
        sign_of(g, determinant(g, &minor)).is_some_and(|sign| sign != Ordering::Less)
    };
    n <= LARGEST && (1..1_usize << n).all(is_right)
}

/// `x' = Σ g_a(x, r) r_a'`.
struct Transport {
    /// The quasi-velocities x.
    rest: Vec<usize>,
    /// The quasi-velocities r'.
    shape: Vec<usize>,
    /// g, a column for each a.
    columns: Vec<Vec<Expr>>,
}

impl Transport {
    /// Whether the rates are of this form and the connection is flat, as it always is for one coordinate.
    fn is_flat(&self, about: &Expansion<'_>, rates: &[Expr]) -> bool {
        let g = about.graph();
        let speeds = &about.own.characteristics.parameters;
        let moving: Vec<_> = self.shape.iter().map(|&s| speeds[s].symbol).collect();
        let mut residuals = Vec::new();
        for (row, &rate) in rates.iter().enumerate() {
            let terms = self.shape.iter().zip(&self.columns);
            let terms: Vec<Expr> = terms
                .map(|(&s, own)| g.mul(&[own[row], speeds[s].value]))
                .collect();
            residuals.push(g.sub(rate, g.add(&terms)));
        }
        for own in &self.columns {
            residuals.extend(own.iter().flat_map(|&e| g.gradient(e, &moving)));
        }
        for a in 0..self.columns.len() {
            for b in 0..a {
                let (first, second) = (self.second(about, a, b), self.second(about, b, a));
                let pairs = first.into_iter().zip(second);
                residuals.extend(pairs.map(|(x, y)| g.sub(x, y)));
            }
        }
        about.vanish(&residuals)
    }

    /// `∂g_a/∂r_b + (∂g_a/∂x) g_b`, the derivative of g_a along r_b with x transported.
    fn second(&self, about: &Expansion<'_>, a: usize, b: usize) -> Vec<Expr> {
        let g = about.graph();
        let symbols = about.variables();
        let count = about.own.coordinates.len();
        let of = |&e: &Expr| {
            let mut terms = vec![g.diff(e, symbols[b])];
            let along = self.rest.iter().zip(&self.columns[b]);
            terms.extend(along.map(|(&s, &by)| g.mul(&[g.diff(e, symbols[count + s]), by])));
            g.add(&terms)
        };
        self.columns[a].iter().map(of).collect()
    }

    /// `I_x = 1`, `I_r = −g`, `I_xx = 0`, `I_xr = −g_x`, and `I_rr` is minus the derivative of g along r with the sign of a transport back.
    fn jets(&self, about: &Expansion<'_>) -> Vec<Jet> {
        let g = about.graph();
        let symbols = about.variables();
        let (n, count) = (symbols.len(), about.own.coordinates.len());
        let at = |e: Expr| about.at(&[e])[0];
        let mut found = Vec::new();
        for (row, &own) in self.rest.iter().enumerate() {
            let mut gradient = vec![g.zero(); n];
            let mut hessian = vec![vec![g.zero(); n]; n];
            gradient[count + own] = g.one();
            for (a, column) in self.columns.iter().enumerate() {
                gradient[a] = g.neg(at(column[row]));
                for &x in &self.rest {
                    let mixed = g.neg(at(g.diff(column[row], symbols[count + x])));
                    hessian[a][count + x] = mixed;
                    hessian[count + x][a] = mixed;
                }
                for (b, other) in self.columns.iter().enumerate() {
                    let along = self.rest.iter().zip(column);
                    let terms =
                        along.map(|(&x, &by)| g.mul(&[g.diff(other[row], symbols[count + x]), by]));
                    let back = g.add(&terms.collect::<Vec<_>>());
                    hessian[a][b] = closed(g, at(g.sub(back, g.diff(column[row], symbols[b]))));
                }
            }
            found.push(Jet {
                name: format!(
                    "what {} becomes by transport",
                    about.own.characteristics.parameters[own].name
                ),
                gradient,
                hessian,
                falls: false,
                value: None,
            });
        }
        found
    }
}

//! The system for the parameters that a model states to be zero, and with the laws of controls that it states.
//!
//! Claims are decided for arbitrary parameters, so that one verdict holds for a family of systems. A parameter that is stated to
//! be zero is an exception: a plane without slope, a drift switched off. What a model with it says is asked about that system.
//! So it is with a parameter that others define, which never has another value, and with a control: z' = u x' with u = 2 is
//! integrable, although with most u(t) it is not.

use crate::constraint::Constraint;
use crate::system::{System, Thrust};
use chetaev_symbolic::Expr;

/// Derivatives of a control up to this order may occur in a model.
const HIGHEST: u32 = 8;

impl System {
    /// Pairs (parameter, 0) of the parameters that the model states to be zero, and (parameter, definition) of those that others define,
    /// of those that occur in L, the forces or the constraints. One over whose values a steady motion is judged stays open.
    pub fn stated_zeros(&self) -> Vec<(Expr, Expr)> {
        let (g, occurring) = (&self.graph, self.occurring());
        let tied = self.tied(&occurring);
        let inside: Vec<Expr> = tied.iter().map(|&(_, definition)| definition).collect();
        let all = [occurring, g.reachable(&inside)].concat();
        let mut zeros = self.parameter_values();
        let is_over = |parameter: Expr| {
            let mut over = self.steady.iter().filter_map(|own| own.over);
            over.any(|own| g.as_symbol(parameter) == Some(own))
        };
        zeros.retain(|&(parameter, value)| {
            g.is_zero(value) && all.contains(&parameter) && !is_over(parameter)
        });
        let is_zero = |e: Expr| zeros.iter().any(|&(zero, _)| zero == e);
        let others = tied
            .into_iter()
            .filter(|&(parameter, _)| !is_zero(parameter));
        let defined: Vec<(Expr, Expr)> = others
            .map(|(parameter, definition)| (parameter, g.substitute(definition, &zeros)))
            .collect();
        [zeros, defined].concat()
    }

    /// Of the parameters that occur those that their definitions tie to others that occur, with these definitions, free of parameters that
    /// have their own. A parameter whose definition contains one that stands nowhere else, as an initial value, is as free as that.
    fn tied(&self, occurring: &[Expr]) -> Vec<(Expr, Expr)> {
        let g = &self.graph;
        let own = self.definitions.iter();
        let all: Vec<(Expr, Expr)> = own
            .filter(|(parameter, _)| occurring.contains(parameter))
            .map(|&(parameter, definition)| (parameter, self.with_definitions(definition)))
            .collect();
        let symbols = |e: Expr| g.symbols_in(&[e]).into_iter().map(|s| g.symbol_expr(s));
        let is_free = |place: usize| {
            let mut own = symbols(all[place].1);
            own.any(|s| {
                let mut others = all.iter().enumerate().filter(|(other, _)| *other != place);
                !occurring.contains(&s) && !others.any(|(_, &(_, e))| symbols(e).any(|o| o == s))
            })
        };
        let places = (0..all.len()).filter(|&place| !is_free(place));
        places.map(|place| all[place]).collect()
    }

    /// The system with the values of all parameters that have one. `None` where masses vary, or where it is no system then.
    pub fn for_parameter_values(&self) -> Option<System> {
        self.for_values(self.parameter_values())
    }

    /// What occurs in L, the forces or the constraints.
    fn occurring(&self) -> Vec<Expr> {
        let mut all = vec![self.lagrangian];
        all.extend(self.forces.iter().chain(&self.reactive_forces));
        all.extend(self.constraints.iter().map(|c| c.stated));
        self.graph.reachable(&all)
    }

    /// [`System::stated_zeros`], and (control, law) of the controls that occur.
    pub fn stated_values(&self) -> Vec<(Expr, Expr)> {
        let mut values = self.stated_zeros();
        values.extend(self.laws_of_controls());
        values
    }

    /// Pairs (control, law) of the controls that occur, where the model states a law.
    pub fn laws_of_controls(&self) -> Vec<(Expr, Expr)> {
        let (g, occurring) = (&self.graph, self.occurring());
        let occurs = |name: &str| {
            let mut orders = (0..=HIGHEST).map(|order| g.symbol(name, order));
            orders.any(|u| occurring.contains(&u))
        };
        let controls = self.controls.iter().filter(|control| occurs(&control.name));
        let laws = controls.filter_map(|u| Some((g.symbol(&u.name, 0), u.law?)));
        laws.collect()
    }

    /// The system with the laws of controls put in that the model states. `None` as for [`System::for_stated_values`].
    pub fn for_laws_of_controls(&self) -> Option<System> {
        self.for_values(self.laws_of_controls())
    }

    /// The system with the parameters put in that are stated to be zero or defined by others. `None` as for [`System::for_stated_values`].
    pub fn for_stated_zeros(&self) -> Option<System> {
        self.for_values(self.stated_zeros())
    }

    /// The system with these values put in. `None` where there are none, where it is no system then, or where masses vary.
    pub fn for_stated_values(&self) -> Option<System> {
        self.for_values(self.stated_values())
    }

    /// Pairs (parameter, definition) of the parameters that the model defines by others, of those that occur in the constraints. Definitions
    /// are free of parameters that have definitions of their own.
    pub fn definitions_in_constraints(&self) -> Vec<(Expr, Expr)> {
        self.tied(&self.occurring_in_constraints())
    }

    /// Pairs (parameter, value) of the parameters with values that occur in the constraints.
    pub fn values_in_constraints(&self) -> Vec<(Expr, Expr)> {
        let occurring = self.occurring_in_constraints();
        let mut values = self.parameter_values();
        values.retain(|(parameter, _)| occurring.contains(parameter));
        values
    }

    fn occurring_in_constraints(&self) -> Vec<Expr> {
        let stated: Vec<Expr> = self.constraints.iter().map(|c| c.stated).collect();
        self.graph.reachable(&stated)
    }

    /// The system with what parameters in its constraints are put in, for questions about the constraints alone: laws of masses
    /// keep their parameters. `None` where there are none, or it is no system then.
    pub fn with_constraints_for(&self, values: Vec<(Expr, Expr)>) -> Option<System> {
        (!values.is_empty()).then(|| self.put_in(values)).flatten()
    }

    /// The system with these values of parameters, (parameter, value). `None` where masses vary, or where it is no system then.
    pub fn with_parameters(&self, values: &[(Expr, Expr)]) -> Option<System> {
        self.for_values(values.to_vec())
    }

    fn for_values(&self, values: Vec<(Expr, Expr)>) -> Option<System> {
        if values.is_empty() || self.has_varying_masses() {
            return None;
        }
        self.put_in(values)
    }

    /// Whether masses have laws of their own, or what particles lose has its own velocity: such systems are not made for values.
    pub fn has_varying_masses(&self) -> bool {
        let thrust = |p: &crate::system::Particle| !matches!(p.thrust, Thrust::Isotropic);
        !self.masses.is_empty() || self.particles.iter().any(thrust)
    }

    fn put_in(&self, values: Vec<(Expr, Expr)>) -> Option<System> {
        let values = self.with_rates(values);
        let g = self.graph.clone();
        let mut system = self.clone();
        for e in system.expressions() {
            *e = g.substitute(*e, &values);
        }
        let stated = std::mem::take(&mut system.constraints);
        for constraint in stated {
            let value = g.substitute(constraint.stated, &values);
            let classified = Constraint::classify(&system, constraint.name, value).ok()?;
            system.constraints.push(classified);
        }
        system
            .assumptions
            .retain(|a| !g.symbols_in(&[a.left, a.right]).is_empty());
        let is_put_in = |name: &str| values.iter().any(|&(own, _)| own == g.symbol(name, 0));
        system.controls.retain(|control| !is_put_in(&control.name));
        Some(system)
    }

    /// Values of symbols with those of the derivatives of controls. Laws contain the time and parameters alone, some of which have values here.
    fn with_rates(&self, values: Vec<(Expr, Expr)>) -> Vec<(Expr, Expr)> {
        let g = &self.graph;
        let controls = self.controls.iter().filter_map(|c| Some((&c.name, c.law?)));
        let is_control = |e: Expr| self.controls.iter().any(|c| g.symbol(&c.name, 0) == e);
        let (laws, mut all): (Vec<_>, Vec<_>) =
            values.into_iter().partition(|&(own, _)| is_control(own));
        let is_stated = |e: Expr| laws.iter().any(|&(own, _)| own == e);
        let mut rates = Vec::new();
        for (name, law) in controls.filter(|(name, _)| is_stated(g.symbol(name, 0))) {
            let mut value = g.substitute(law, &all);
            for order in 0..=HIGHEST {
                rates.push((g.symbol(name, order), value));
                value = self.time_derivative(value);
            }
        }
        all.extend(rates);
        all
    }

    /// Everything in which parameters may occur, but for the constraints.
    fn expressions(&mut self) -> Vec<&mut Expr> {
        let mut all: Vec<&mut Expr> = vec![&mut self.lagrangian];
        all.extend(self.kinetic.iter_mut().chain(&mut self.potential));
        all.extend(self.rayleigh.iter_mut());
        all.extend(self.forces.iter_mut().chain(&mut self.reactive_forces));
        all.extend(self.controls.iter_mut().flat_map(|c| &mut c.law));
        all.extend(self.mass_functions.iter_mut().map(|(_, e)| e));
        all.extend(self.quasi_velocities.iter_mut().map(|p| &mut p.definition));
        if let Some(frame) = &mut self.frame {
            all.extend(frame.fields.iter_mut().flatten().chain(&mut frame.drift));
        }
        all.extend(
            self.characteristics
                .iter_mut()
                .flat_map(|c| &mut c.formulas),
        );
        for particle in &mut self.particles {
            all.push(&mut particle.mass);
            all.extend(particle.position.iter_mut().chain(&mut particle.force));
        }
        let objects = self.mechanism.iter_mut();
        all.extend(objects.flat_map(|own| own.expressions()));
        all.extend(self.definitions.iter_mut().map(|(_, e)| e));
        let conditions = self.integral_conditions.iter_mut();
        all.extend(conditions.flat_map(|(_, left, right, _)| [left, right]));
        all.extend(&mut self.search_functions);
        all.extend(self.integrals.iter_mut().map(|(_, e)| e));
        all.extend(self.integral_forms.iter_mut().map(|form| &mut form.value));
        let equations = self.equations.iter_mut().flat_map(|set| &mut set.equations);
        all.extend(equations.flat_map(|(_, left, right)| [left, right]));
        all.extend(self.start.iter_mut().map(|(_, e)| e));
        for motion in &mut self.steady {
            let given = motion.positions.iter_mut().chain(&mut motion.velocities);
            all.extend(given.flatten());
        }
        for twin in &mut self.twins {
            all.extend(
                twin.map
                    .iter_mut()
                    .chain(twin.symbols.iter_mut().map(|(_, e)| e)),
            );
        }
        let variations = self.variations.iter_mut().flat_map(|v| &mut v.relations);
        all.extend(variations.map(|(_, e)| e));
        if let Some(complete) = &mut self.complete_integral {
            all.push(&mut complete.action);
            all.extend(complete.quadratures.iter_mut().map(|(_, e)| e));
            all.extend(complete.motion.iter_mut().map(|(_, e)| e));
        }
        all.extend(
            self.assumptions
                .iter_mut()
                .flat_map(|a| [&mut a.left, &mut a.right]),
        );
        all
    }
}

//! What a formulation delivers: equations in its own notation, intermediate objects, and a first-order system.

use crate::characteristics::{derive_along, Characteristics};
use crate::frame::Speed;
use crate::system::{Coordinate, System};
use chetaev_symbolic::print::with_indices;
use chetaev_symbolic::{Expr, Symbol};

/// One equation, `left = right`.
#[derive(Clone, Debug)]
pub struct Equation {
    /// What it belongs to, for example the coordinate or the parameter.
    pub label: String,
    /// Left side.
    pub left: Expr,
    /// Right side.
    pub right: Expr,
}

impl Equation {
    /// One equation for each coordinate, named after it.
    pub fn of_coordinates(
        system: &System,
        lefts: impl IntoIterator<Item = Expr>,
        rights: impl IntoIterator<Item = Expr>,
    ) -> Vec<Equation> {
        let sides = lefts.into_iter().zip(rights);
        sides
            .zip(&system.coordinates)
            .map(|((left, right), c)| Equation {
                label: c.name.clone(),
                left,
                right,
            })
            .collect()
    }
}

/// A named intermediate object, for example `lambda_blade` or an entry of B.
#[derive(Clone, Debug)]
pub struct NamedExpr {
    /// The name as a symbol, with subscripts after underscores: `theta_z`, `A_z_x`.
    pub name: String,
    /// Its value.
    pub value: Expr,
    /// What it is, in a few words.
    pub meaning: String,
    /// The name with upper and lower indices, where its source has both: as [`with_indices`] writes it.
    pub typeset: Option<String>,
    /// Whether it is one of many components of which only those that do not vanish are of interest.
    pub is_component: bool,
}

impl NamedExpr {
    /// An object with its name, value and meaning.
    pub fn new(name: impl Into<String>, value: Expr, meaning: impl Into<String>) -> NamedExpr {
        NamedExpr {
            name: name.into(),
            value,
            meaning: meaning.into(),
            typeset: None,
            is_component: false,
        }
    }

    /// The same with the indices of its source: a letter, upper and lower indices.
    pub fn with_indices(self, letter: &str, upper: &[&str], lower: &[&str]) -> NamedExpr {
        NamedExpr {
            typeset: Some(with_indices(letter, upper, lower)),
            ..self
        }
    }

    /// A component of an array, of interest where it does not vanish.
    pub fn component(
        name: impl Into<String>,
        value: Expr,
        meaning: impl Into<String>,
    ) -> NamedExpr {
        NamedExpr {
            is_component: true,
            ..NamedExpr::new(name, value, meaning)
        }
    }
}

/// The general form of equations in the notation of their source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Schema {
    /// For a terminal: `D(∂L/∂v^i) − ∂L/∂q^i = Q_i + Σ_l λ_l ∂f^l/∂v^i`.
    pub text: &'static str,
    /// The same for LaTeX in mathematical mode.
    pub latex: &'static str,
}

/// A group of equations with a heading.
#[derive(Clone, Debug)]
pub struct EquationGroup {
    /// Heading, for example "equations of motion".
    pub title: String,
    /// Their general form, where there is one.
    pub schema: Option<Schema>,
    /// The equations.
    pub equations: Vec<Equation>,
}

/// A variable of a formulation's state beside the coordinates.
#[derive(Clone, Debug)]
pub struct StateVariable {
    /// The name: `x'`, `p_x`, `kappa_blade`.
    pub name: String,
    /// The variable.
    pub value: Expr,
    /// Its symbol.
    pub symbol: Symbol,
    /// Its rate as a function of the state.
    pub rate: Expr,
    /// What it is as a function of (q, v, t); `None` for data of its own, such as the multipliers of an extremum.
    pub definition: Option<Expr>,
}

impl StateVariable {
    /// A coordinate's velocity, q'.
    pub fn of_velocity(coordinate: &Coordinate, rate: Expr) -> StateVariable {
        StateVariable {
            name: format!("{}'", coordinate.name),
            value: coordinate.v,
            symbol: coordinate.v_symbol,
            rate,
            definition: Some(coordinate.v),
        }
    }

    /// A quasi-velocity of a frame.
    pub fn of_speed(speed: &Speed, rate: Expr) -> StateVariable {
        StateVariable {
            name: speed.name.clone(),
            value: speed.value,
            symbol: speed.symbol,
            rate,
            definition: Some(speed.definition),
        }
    }
}

/// A square matrix of functions of the state whose determinant must not vanish.
#[derive(Clone, Debug)]
pub struct RegularMatrix {
    /// What it is, in words and formulas.
    pub name: &'static str,
    /// Row by row.
    pub rows: Vec<Vec<Expr>>,
}

/// The equations of motion in one formulation.
///
/// Its first-order system has the state (q, masses with a law of their own, variables): `q' = velocities`,
/// `variables' = rates`.
#[derive(Clone, Debug)]
pub struct Equations {
    /// Name of the formulation in the registry.
    pub formulation: &'static str,
    /// The equations as the formulation states them.
    pub groups: Vec<EquationGroup>,
    /// Intermediate objects, printed with the equations.
    pub objects: Vec<NamedExpr>,
    /// The state beside the coordinates.
    pub variables: Vec<StateVariable>,
    /// q' as functions of the state; length n.
    pub velocities: Vec<Expr>,
    /// q'' as functions of the state; length n.
    pub accelerations: Vec<Expr>,
    /// Masses with a law of their own, which are states too, with their rates as functions of the state.
    pub masses: Vec<(Symbol, Expr)>,
    /// Relations between the variables that hold along every motion, with the variable each determines: `f = 0` for
    /// dependent velocities that stay symbols.
    pub relations: Vec<(Expr, Symbol)>,
    /// Multipliers by index of their constraint in the system; empty where the formulation has none.
    pub multipliers: Vec<(usize, Expr)>,
    /// Whether the variables depend on which velocities were chosen as independent.
    pub is_chart: bool,
    /// q^(m) as functions of the state for constraints of order m ≥ 2; empty for those of first order.
    pub highest: Vec<Expr>,
    /// Functions of the state that vanish along every admissible motion: conditions on the initial data that the equations
    /// keep, as lower constraints and equations of motion that were differentiated.
    pub conditions: Vec<NamedExpr>,
    /// A matrix that must be nonsingular for the equations to be an ordinary differential equation in their state, where that
    /// depends on data of its own.
    pub regular: Option<RegularMatrix>,
    /// The equations of motion as functions on the jet of kinematic characteristics, where they are stated so.
    pub on_characteristics: Option<(Characteristics, Vec<Expr>)>,
}

impl Equations {
    /// Equations with the state (q, v) and these accelerations; groups, objects and multipliers empty.
    pub fn in_velocities(
        formulation: &'static str,
        system: &System,
        accelerations: Vec<Expr>,
    ) -> Equations {
        let variables = system
            .coordinates
            .iter()
            .zip(&accelerations)
            .map(|(c, &rate)| StateVariable::of_velocity(c, rate))
            .collect();
        Equations {
            formulation,
            groups: Vec::new(),
            objects: Vec::new(),
            variables,
            velocities: system.coordinates.iter().map(|c| c.v).collect(),
            masses: system.masses.iter().map(|m| (m.symbol, m.rate)).collect(),
            accelerations,
            relations: Vec::new(),
            multipliers: Vec::new(),
            is_chart: false,
            highest: Vec::new(),
            conditions: Vec::new(),
            regular: None,
            on_characteristics: None,
        }
    }

    /// Equations with the state (q, P) and these P'; where constraints stay implicit, their dependent quasi-velocities are
    /// variables too.
    pub fn in_characteristics(
        formulation: &'static str,
        system: &System,
        characteristics: &Characteristics,
        rates: &[Expr],
    ) -> Equations {
        let g = &system.graph;
        let known: Vec<(Expr, Expr)> = characteristics
            .parameters
            .iter()
            .zip(rates)
            .map(|(p, &rate)| (p.rate, rate))
            .collect();
        let mut speeds: Vec<(&crate::frame::Speed, Expr)> = characteristics
            .parameters
            .iter()
            .zip(rates.iter().copied())
            .collect();
        let implicit: Vec<(Expr, &crate::frame::Speed)> = characteristics.implicit().collect();
        let dependent: Vec<Expr> = implicit.iter().map(|(_, speed)| speed.value).collect();
        let moved = characteristics.total_derivative(system, &dependent);
        let moved = g.substitute_all(&moved, &known);
        speeds.extend(implicit.iter().zip(moved).map(|((_, s), rate)| (*s, rate)));
        let variables = speeds
            .into_iter()
            .map(|(speed, rate)| StateVariable {
                name: speed.name.clone(),
                value: speed.value,
                symbol: speed.symbol,
                rate,
                definition: Some(speed.definition),
            })
            .collect();
        Equations {
            formulation,
            groups: Vec::new(),
            objects: Vec::new(),
            variables,
            velocities: characteristics.velocities.clone(),
            masses: system.mass_rates(&characteristics.velocities),
            accelerations: g.substitute_all(&characteristics.accelerations, &known),
            relations: implicit.iter().map(|(f, s)| (*f, s.symbol)).collect(),
            multipliers: Vec::new(),
            is_chart: characteristics.frame.is_natural(system),
            highest: Vec::new(),
            conditions: Vec::new(),
            regular: None,
            on_characteristics: None,
        }
    }

    /// Equations with any state: accelerations are the rates of the velocities along the flow.
    pub fn in_state(
        formulation: &'static str,
        system: &System,
        variables: Vec<StateVariable>,
        velocities: Vec<Expr>,
    ) -> Equations {
        let rates: Vec<(Symbol, Expr)> = variables.iter().map(|x| (x.symbol, x.rate)).collect();
        let one = system.graph.one();
        Equations {
            formulation,
            groups: Vec::new(),
            objects: Vec::new(),
            accelerations: derive_along(system, &velocities, &velocities, one, &rates),
            variables,
            masses: system.mass_rates(&velocities),
            velocities,
            relations: Vec::new(),
            multipliers: Vec::new(),
            is_chart: false,
            highest: Vec::new(),
            conditions: Vec::new(),
            regular: None,
            on_characteristics: None,
        }
    }

    /// Adds a group of equations.
    #[must_use]
    pub fn with_group(
        mut self,
        title: &str,
        schema: Option<Schema>,
        equations: Vec<Equation>,
    ) -> Equations {
        self.groups.push(EquationGroup {
            title: title.into(),
            schema,
            equations,
        });
        self
    }

    /// Adds intermediate objects.
    #[must_use]
    pub fn with_objects(mut self, objects: impl IntoIterator<Item = NamedExpr>) -> Equations {
        self.objects.extend(objects);
        self
    }

    /// Adds the multipliers of the constraints with these indices.
    #[must_use]
    pub fn with_multipliers(mut self, indices: Vec<usize>, values: Vec<Expr>) -> Equations {
        self.multipliers = indices.into_iter().zip(values).collect();
        self
    }

    /// The laws of the masses that have one, as a group of equations `M' = Φ`; `None` without such masses.
    pub fn laws_of_masses(&self, system: &System) -> Option<EquationGroup> {
        let g = &system.graph;
        let masses = system.masses.iter().zip(&self.masses);
        let laws: Vec<Equation> = masses
            .map(|(m, &(_, right))| Equation {
                label: m.name.clone(),
                left: g.symbol(&m.name, 1),
                right,
            })
            .collect();
        (!laws.is_empty()).then(|| EquationGroup {
            title: "masses".into(),
            schema: None,
            equations: laws,
        })
    }

    /// The rates of the variables.
    pub fn rates(&self) -> Vec<Expr> {
        self.variables.iter().map(|x| x.rate).collect()
    }

    /// Functions of the state as functions of (q, v, t) and of what the state has beyond them.
    ///
    /// The velocities as functions of the state are read as v at once, so that a radical of momenta becomes the radical of
    /// velocities that it is; that they are v is [`velocity_residuals`](Equations::velocity_residuals).
    pub fn in_natural_state(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        let g = &system.graph;
        let velocities: Vec<(Expr, Expr)> = self
            .velocities
            .iter()
            .zip(&system.coordinates)
            .filter(|(&v, _)| g.as_symbol(v).is_none() && g.as_number(v).is_none())
            .map(|(&v, c)| (v, c.v))
            .collect();
        let es = g.substitute_all(es, &velocities);
        g.substitute_all(&es, &self.definitions())
    }

    /// `q'(q, variables, t) - v` with the variables replaced by their definitions: zero on the constraints.
    pub fn velocity_residuals(&self, system: &System) -> Vec<Expr> {
        let g = &system.graph;
        g.substitute_all(&self.velocities, &self.definitions())
            .into_iter()
            .zip(&system.coordinates)
            .map(|(velocity, c)| g.sub(velocity, c.v))
            .filter(|&e| !g.is_zero(e))
            .collect()
    }

    fn definitions(&self) -> Vec<(Expr, Expr)> {
        self.variables
            .iter()
            .filter_map(|x| Some((x.value, x.definition?)))
            .filter(|(value, definition)| value != definition)
            .collect()
    }
}

/// A name that nothing in the system has: `wanted`, with underscores behind it where needed.
pub fn unused_name(system: &System, wanted: &str) -> String {
    let mut name = wanted.to_string();
    while is_used(system, &name) {
        name.push('_');
    }
    name
}

/// The first of some letters that nothing in the system is called, for a quantity of the theory in a sentence; the first one with
/// underscores where all are used.
pub fn unused_letter(system: &System, wanted: &[&str]) -> String {
    let mut free = wanted.iter().filter(|name| !is_used(system, name));
    match free.next() {
        Some(name) => (*name).to_owned(),
        None => unused_name(system, wanted.first().copied().unwrap_or_default()),
    }
}

fn is_used(system: &System, name: &str) -> bool {
    system.moves(name)
        || system.controls.iter().any(|c| c.name == name)
        || system.parameters.iter().any(|p| p.name == name)
        || system.quasi_velocities.iter().any(|u| u.name == name)
        || (system.characteristics.iter()).any(|c| c.parameters.iter().any(|p| p == name))
}

/// Gives intermediate objects names that nothing in the system and no other object has.
pub fn keep_names_apart(system: &System, objects: &mut [NamedExpr]) {
    let mut taken = std::collections::BTreeSet::new();
    for object in objects {
        let mut name = unused_name(system, &object.name);
        while taken.contains(&name) {
            name = unused_name(system, &format!("{name}_"));
        }
        taken.insert(name.clone());
        object.name = name;
    }
}

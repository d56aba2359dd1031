//! The public face of a formulation: plain data.

/// The principle a formulation rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Principle {
    /// d'Alembert–Lagrange with Chetaev's condition.
    DalembertLagrangeChetaev,
    /// Gauss's least constraint.
    Gauss,
    /// Jourdain: virtual velocities.
    Jourdain,
    /// Hamilton's, in the form of Hölder, Voronets or Suslov, or on the phase space of Helmholtz and Poincaré.
    Hamilton,
    /// Jacobi's least action at fixed energy, read in Hölder's sense.
    Jacobi,
    /// A principle of the second kind, in which coordinates and velocities vary independently.
    SecondKind,
    /// The constrained extremum.
    Vakonomic,
}

impl Principle {
    /// Its name for people.
    pub fn words(self) -> &'static str {
        match self {
            Principle::DalembertLagrangeChetaev => "d'Alembert–Lagrange with Chetaev's condition",
            Principle::Gauss => "Gauss, least constraint",
            Principle::Jourdain => "Jourdain, virtual velocities",
            Principle::Hamilton => {
                "Hamilton, in the form of Hölder, Voronets or Suslov, or on the phase space"
            }
            Principle::Jacobi => "Jacobi, least action at fixed energy, in Hölder's sense",
            Principle::SecondKind => "second kind: coordinates and velocities vary independently",
            Principle::Vakonomic => "constrained extremum of the action",
        }
    }
}

/// What is claimed of a formulation beside the reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// It is what the others are compared with.
    Reference,
    /// Its accelerations are those of the reference: `formulation.equivalent#NAME`.
    Equivalent,
    /// It is another system, whose motions may coincide with those of the reference: never equivalent in general.
    Coincidence,
}

/// A source with its equation numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Source {
    /// Key in `docs/references.bib`.
    pub key: &'static str,
    /// Equation numbers or section.
    pub place: &'static str,
}

/// What a formulation is, what it needs and where it comes from.
#[derive(Clone, Copy, Debug)]
pub struct Card {
    /// Name in the registry and in claims: `formulation.equivalent#NAME`.
    pub name: &'static str,
    /// Title for people.
    pub title: &'static str,
    /// One sentence: what the equations are.
    pub statement: &'static str,
    /// The principle.
    pub principle: Principle,
    /// What is claimed of it.
    pub relation: Relation,
    /// Claim ids that must hold.
    pub requires: &'static [&'static str],
    /// The identity that holds before any equation of motion is used, `formulation.identity#NAME`, in one sentence.
    pub identity: Option<&'static str>,
    /// What the equations are solved for.
    pub unknowns: &'static str,
    /// The highest order of constraints that its rule takes.
    pub highest_order: u32,
    /// Sources.
    pub sources: &'static [Source],
}

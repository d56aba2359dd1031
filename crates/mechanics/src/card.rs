//! The public face of a formulation: plain data.

/// The principle a formulation rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Principle {
    /// d'Alembert–Lagrange with Chetaev's condition.
    DalembertLagrangeChetaev,
    /// Gauss's least constraint.
    Gauss,
    /// Jourdain.
    Jourdain,
    /// The constrained extremum.
    Vakonomic,
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
    /// Claim ids that must hold.
    pub requires: &'static [&'static str],
    /// What the equations are solved for.
    pub unknowns: &'static str,
    /// Sources.
    pub sources: &'static [Source],
}

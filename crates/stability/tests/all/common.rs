//! A model with what is derived from it once.
#![allow(
    clippy::unwrap_used,
    clippy::result_large_err,
    reason = "test code fails where it stands"
)]

use chetaev_mechanics::claims::{Context, Registry};
use chetaev_mechanics::prover::Prover;
use chetaev_mechanics::{Prepared, SteadyMotion, System};
use chetaev_model::{load, Model};
use chetaev_stability::characteristic::Characteristic;
use chetaev_stability::claims::CLAIMS;
use chetaev_stability::eigenvalues::{as_known, Known};
use chetaev_stability::hurwitz::{ranges, Ranges};
use chetaev_stability::linearization::{linearize, Linearization, LinearizationError};
use chetaev_stability::spectrum::Spectrum;
use chetaev_symbolic::{Expr, Rational, Verdict};
use std::collections::BTreeMap;

/// A system with what is derived from it once.
pub(crate) struct Case {
    pub(crate) model: Model,
    pub(crate) system: System,
    pub(crate) prepared: Prepared,
}

impl Case {
    pub(crate) fn new(text: &str) -> Case {
        let loaded = load(
            "case.toml",
            &format!("name = \"case\"\n{text}"),
            &BTreeMap::new(),
            &[],
        );
        let model = loaded
            .model
            .unwrap_or_else(|| panic!("{}", loaded.diagnostics));
        let system = System::from_model(&model).unwrap();
        Case {
            prepared: Prepared::new(&system).unwrap(),
            model,
            system,
        }
    }

    pub(crate) fn gallery(name: &str) -> Case {
        Case::gallery_with(name, "", "")
    }

    /// A model of the gallery with one text for another.
    pub(crate) fn gallery_with(name: &str, own: &str, other: &str) -> Case {
        let path = format!(
            "{}/../../gallery/{name}/model.toml",
            env!("CARGO_MANIFEST_DIR")
        );
        let text = std::fs::read_to_string(path).unwrap();
        let start = text.find("\nname = ").map_or(0, |at| at + 1);
        let rest = text[start..].split_once('\n').unwrap().1;
        assert!(rest.contains(own), "{name}: {own}");
        if own.is_empty() {
            Case::new(rest)
        } else {
            Case::new(&rest.replace(own, other))
        }
    }

    pub(crate) fn read(&self, text: &str) -> Expr {
        self.model.expression(text).unwrap()
    }

    /// A motion from pairs of a coordinate or velocity and its value; other positions and velocities are not given.
    pub(crate) fn motion(&self, given: &[(&str, &str)]) -> SteadyMotion {
        let of = |name: String| {
            given
                .iter()
                .find(|(own, _)| *own == name)
                .map(|(_, value)| self.read(value))
        };
        let names = self.system.coordinates.iter().map(|c| &c.name);
        SteadyMotion {
            name: "asked".into(),
            positions: names.clone().map(|name| of(name.clone())).collect(),
            velocities: names.map(|name| of(format!("{name}'"))).collect(),
            guesses: Vec::new(),
            over: None,
        }
    }

    /// The values of all parameters but one, as the model states them.
    pub(crate) fn values(&self, but: &str) -> Vec<(Expr, Expr)> {
        let parameters = self.system.parameters.iter().filter(|p| p.name != but);
        parameters
            .filter_map(|p| Some((p.expr, p.value?)))
            .collect()
    }

    pub(crate) fn linear(
        &self,
        motion: &SteadyMotion,
        but: &str,
    ) -> Result<Linearization, LinearizationError> {
        let (terms, selection) = (&self.prepared.terms, &self.prepared.selection);
        linearize(&self.system, terms, selection, motion, &self.values(but))
    }

    pub(crate) fn number(&self, e: Expr, free: &[(&str, f64)]) -> f64 {
        let g = &self.system.graph;
        let value = |s| {
            free.iter()
                .find(|(name, _)| *name == g.symbol_name(s))
                .map(|(_, value)| *value)
        };
        g.evaluate_f64(&[e], &value).unwrap()[0]
    }

    pub(crate) fn numbers(&self, rows: &[Vec<Expr>], free: &[(&str, f64)]) -> Vec<Vec<f64>> {
        let row = |row: &Vec<Expr>| row.iter().map(|&e| self.number(e, free)).collect();
        rows.iter().map(row).collect()
    }

    pub(crate) fn ranges(
        &self,
        linear: &Linearization,
        symbol: &str,
        low: i64,
        high: i64,
    ) -> Ranges {
        let g = &self.system.graph;
        let polynomial = Characteristic::of(g, linear).unwrap();
        let symbol = g.intern_symbol(symbol, 0);
        let deciding = Spectrum::of(g, &polynomial).deciding(g);
        let leading = *polynomial.coefficients.last().unwrap();
        ranges(
            g,
            &deciding,
            leading,
            symbol,
            &Rational::from(low),
            &Rational::from(high),
        )
        .unwrap()
    }

    /// The eigenvalues about a motion at the values that the model states, without zeros of the family.
    pub(crate) fn spectrum(&self, motion: &SteadyMotion) -> Vec<(f64, f64)> {
        let linear = self.linear(motion, "").unwrap();
        let (left, right) = (
            self.numbers(&linear.left, &[]),
            self.numbers(&linear.right, &[]),
        );
        let known = Known {
            zeros: linear.family,
            others: Vec::new(),
        };
        let found = as_known(&left, &right, &known).unwrap();
        let found = found.iter().map(|l| (l.re, l.im));
        found.filter(|l| *l != (0.0, 0.0)).collect()
    }

    /// A motion that the model names.
    pub(crate) fn named(&self, name: &str) -> &SteadyMotion {
        let mut all = self.system.steady.iter();
        all.find(|own| own.name == name).unwrap()
    }

    /// The verdict on a claim of this crate, at the values that the model states.
    pub(crate) fn verdict(&self, claim: &str, subject: &str) -> Verdict {
        self.verdict_on(claim, Some(subject))
    }

    /// The verdict on a claim that is made of the system as a whole.
    pub(crate) fn verdict_of_all(&self, claim: &str) -> Verdict {
        self.verdict_on(claim, None)
    }

    fn verdict_on(&self, claim: &str, subject: Option<&str>) -> Verdict {
        let registry = Registry::new(&[CLAIMS]);
        let Prepared {
            terms, selection, ..
        } = &self.prepared;
        let cx = Context::new(&self.system, terms, selection, &registry, Prover::default());
        let own = registry.find(claim).unwrap();
        own.decide(&cx, subject).verdict
    }

    /// `proved`, `refuted`, the condition, or what was tried.
    pub(crate) fn said(&self, claim: &str, subject: &str) -> String {
        match self.verdict(claim, subject) {
            Verdict::Conditional { condition, .. } => condition,
            Verdict::Undecided { tried } => format!("undecided: {tried}"),
            other => other.word().into(),
        }
    }
}

/// Each of the eigenvalues is found once, to this part of the largest, and there are no others.
pub(crate) fn are_eigenvalues(found: &[(f64, f64)], expected: &[(f64, f64)], part: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    let sizes = expected.iter().map(|l| l.0.hypot(l.1));
    let size = sizes.fold(0.0, f64::max);
    for &(re, im) in expected {
        let is_near = |own: &&(f64, f64)| (own.0 - re).hypot(own.1 - im) < part * size;
        let count = found.iter().filter(is_near).count();
        assert_eq!(count, 1, "{re} {im}: {found:?}");
    }
}

/// A disc that rolls on a plane, θ its lean, A and Cc its moments across and along the axis, with further parameters and motions.
pub(crate) fn disc(parameters: &str, motions: &str) -> String {
    format!(
        r#"
coordinates = ["x", "y", "phi", "theta", "psi"]
parameters = {{ m = 1.5, r = 0.4, A = 0.06, Cc = 0.12, g = 9.81, {parameters} }}
[define]
cx = "x + r sin(phi) sin(theta)"
cy = "y - r cos(phi) sin(theta)"
cz = "r cos(theta)"
[lagrangian]
T = "1/2 m (cx'^2 + cy'^2 + cz'^2) + 1/2 A (theta'^2 + phi'^2 cos(theta)^2) + 1/2 Cc (psi' + phi' sin(theta))^2"
V = "m g cz"
[constraints]
roll_x = "x' = r psi' cos(phi)"
roll_y = "y' = r psi' sin(phi)"
{motions}"#
    )
}

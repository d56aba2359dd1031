//! Systems of the notes on the theory as models, and what tests ask of them.

use chetaev_mechanics::claims::formulation::derive;
use chetaev_mechanics::claims::CLAIMS;
use chetaev_mechanics::{Context, Equations, Finding, Prepared, Prover, Registry, System};
use chetaev_model::load;
use chetaev_symbolic::syntax::lower::{lower, Resolution, Scope};
use chetaev_symbolic::syntax::parse_expression;
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::{Expr, Graph, Verdict};
use std::collections::BTreeMap;
use std::sync::Arc;

/// S1: a skate on an incline, G = g sin α (T1 §0).
pub const SKATE: &str = r#"
coordinates = ["x", "y", "phi"]
parameters = { m = {}, J = {}, G = {} }
assumptions = ["m > 0", "J > 0"]
lagrangian = { T = "1/2 m (x'^2 + y'^2) + 1/2 J phi'^2", V = "-m G x" }
constraints = { blade = "x' sin(phi) = y' cos(phi)" }
"#;

/// S2: a vertical rolling disc.
pub const DISC: &str = r#"
coordinates = ["theta", "phi", "x", "y"]
parameters = { m = {}, I = {}, J = {}, R = {} }
assumptions = ["m > 0", "I > 0", "J > 0", "R > 0"]
lagrangian = { L = "1/2 I theta'^2 + 1/2 J phi'^2 + 1/2 m (x'^2 + y'^2)" }
constraints = { rolling_x = "x' = R cos(phi) theta'", rolling_y = "y' = R sin(phi) theta'" }
"#;

/// S3: the machine of Appell and Hamel.
pub const APPELL_HAMEL: &str = r#"
coordinates = ["x", "y", "z"]
parameters = { m = {}, g = {}, a = {} }
assumptions = ["m > 0", "a > 0"]
lagrangian = { T = "1/2 m (x'^2 + y'^2 + z'^2)", V = "m g z" }
constraints = { cone = "z' = a sqrt(x'^2 + y'^2)" }
"#;

/// S4: a particle with z' = y x'.
pub const PARTICLE: &str = r#"
coordinates = ["x", "y", "z"]
lagrangian = { L = "1/2 (x'^2 + y'^2 + z'^2)" }
constraints = { c = "z' = y x'" }
"#;

/// A particle in polar coordinates, without constraints.
pub const POLAR: &str = r#"
coordinates = ["r", "theta"]
parameters = { m = {} }
assumptions = ["m > 0", "r > 0"]
lagrangian = { L = "1/2 m (r'^2 + r^2 theta'^2)" }
"#;

/// A system with what is derived from it once.
pub struct Case {
    pub system: System,
    prepared: Prepared,
    registry: Registry,
}

impl Case {
    /// From the text of a model file.
    pub fn new(text: &str) -> Case {
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
            registry: Registry::new(&[CLAIMS]),
            system,
        }
    }

    pub fn context(&self) -> Context<'_> {
        let (terms, selection) = (&self.prepared.terms, &self.prepared.selection);
        Context::new(
            &self.system,
            terms,
            selection,
            &self.registry,
            Prover::default(),
        )
    }

    /// The finding on a claim.
    pub fn finding(&self, claim: &str) -> Arc<Finding> {
        self.context().finding(claim)
    }

    /// The word of the verdict on a claim, and its detail.
    pub fn verdict(&self, claim: &str) -> (&'static str, String) {
        let finding = self.finding(claim);
        (finding.verdict.word(), finding.verdict.detail().to_string())
    }

    /// The equations of a formulation.
    pub fn equations(&self, name: &str) -> Equations {
        derive(&self.context(), name).unwrap()
    }

    /// An expression as a person writes it: `x'` is a velocity, `x''` an acceleration, any other name a symbol.
    pub fn read(&self, text: &str) -> Expr {
        read(&self.system.graph, text)
    }

    /// The value of an intermediate object.
    pub fn object(&self, equations: &Equations, name: &str) -> Expr {
        let found = equations.objects.iter().find(|o| o.name == name);
        let names: Vec<&str> = equations.objects.iter().map(|o| o.name.as_str()).collect();
        found
            .unwrap_or_else(|| panic!("no object {name} among {names:?}"))
            .value
    }

    /// Whether two expressions are equal as functions of free symbols.
    pub fn equal(&self, a: Expr, b: Expr) -> bool {
        let g = &self.system.graph;
        let difference = [g.sub(a, b)];
        let assumptions = Assumptions::new();
        let verdict = decide_zero(g, &ZeroTest::everywhere(&difference, &assumptions));
        matches!(verdict, Verdict::Proved(_))
    }

    /// Whether two expressions are equal on the constraints.
    pub fn equal_on_constraints(&self, a: Expr, b: Expr) -> bool {
        let cx = self.context();
        let manifold = chetaev_mechanics::claims::formulation::manifold(&cx);
        let difference = [self.system.graph.sub(a, b)];
        let verdict = cx.prover.identity(&self.system, &difference, &manifold, "");
        matches!(verdict, Verdict::Proved(_))
    }
}

/// Asserts the verdict on a claim.
#[track_caller]
pub fn expect(case: &Case, claim: &str, word: &str) {
    let (found, detail) = case.verdict(claim);
    assert_eq!(found, word, "{claim}: {detail}");
}

/// Every name is a symbol.
struct Letters<'g>(&'g Graph);

impl Scope for Letters<'_> {
    fn resolve(&self, name: &str, order: u32) -> Resolution {
        Resolution::Known(self.0.symbol(name, order))
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

/// Reads an expression.
#[track_caller]
pub fn read(g: &Graph, text: &str) -> Expr {
    let parsed = parse_expression(text);
    assert!(!parsed.has_errors(), "{text}");
    let mut diagnostics = Vec::new();
    let root = parsed.root();
    let value = lower(g, &parsed.tree, root, &Letters(g), &[], &mut diagnostics);
    value.unwrap_or_else(|| panic!("{text}: {diagnostics:?}"))
}

//! First integrals and densities of Darboux polynomials, and forms with unknowns that are solved for.

use crate::common::{expr, finding, framed, system};
use chetaev_mechanics::system::{IntegralForm, Unknown};
use chetaev_mechanics::System;

/// A limit cycle: `u' = u - v - u Q`, `v' = u + v - v Q` with Q = u² + v².
fn limit_cycle() -> System {
    framed(
        "x y",
        "(x'^2 + y'^2)/2",
        &[],
        &[],
        &[
            ("x", "x' - y' - x'^3 - x' y'^2"),
            ("y", "x' + y' - x'^2 y' - y'^3"),
        ],
    )
}

/// The same of the speed u along a blade and its rate of turning w.
fn driven_blade() -> System {
    let speed = "(x' cos(phi) + y' sin(phi))";
    let along = format!("({speed} (1 - {speed}^2 - phi'^2) - phi')");
    framed(
        "x y phi",
        "(x'^2 + y'^2 + phi'^2)/2",
        &[("blade", "x' sin(phi) - y' cos(phi)")],
        &[("u", "x' cos(phi) + y' sin(phi)"), ("w", "phi'")],
        &[
            ("x", &format!("cos(phi) {along}")),
            ("y", &format!("sin(phi) {along}")),
            ("phi", &format!("phi' (1 - {speed}^2 - phi'^2) + {speed}")),
        ],
    )
}

/// What was found, each proved.
fn texts(system: &System, id: &str) -> Vec<String> {
    let finding = finding(system, id);
    assert_eq!(
        finding.verdict.word(),
        "proved",
        "{}",
        finding.verdict.detail()
    );
    let formulas = finding.formulas.iter();
    formulas.map(|f| system.graph.text(f.right)).collect()
}

/// The polar angle turns uniformly, and d(ln Q/(Q - 1))/dt = 2 by partial fractions.
#[test]
fn products_and_arguments_of_a_limit_cycle() {
    assert_eq!(
        texts(&limit_cycle(), "noether.family"),
        [
            "exp(2 t) (x'^2 + y'^2 - 1)/(x'^2 + y'^2)",
            "atan2(y', x') - t"
        ]
    );
    let detail = finding(&limit_cycle(), "noether.family");
    let detail = detail.verdict.detail().to_owned();
    assert!(
        detail.contains("exhausted: Darboux polynomials"),
        "{detail}"
    );
}

/// div X = 2 - 4 Q, and the cofactors of Q and Q - 1 are 2 - 2 Q and -2 Q: the density is 1/(Q |Q - 1|).
#[test]
fn a_density_that_contains_velocities() {
    let own = driven_blade();
    assert_eq!(
        texts(&own, "noether.family"),
        [
            "(u^2 - 1 + w^2) exp(2 t)/(u^2 + w^2)",
            "atan2(phi', x' cos(phi) + y' sin(phi)) - t"
        ]
    );
    let measure = finding(&own, "measure.invariant");
    assert_eq!(measure.verdict.word(), "refuted");
    let detail = measure.verdict.detail();
    assert!(
        detail.contains("N = 1/((u^2 + w^2) abs(u^2 - 1 + w^2))"),
        "{detail}"
    );
    let count = finding(&own, "liouville.integrable");
    assert_eq!(count.verdict.word(), "proved", "{}", count.verdict.detail());
}

fn with_form(mut own: System, value: &str, unknowns: &[(&str, &[&str])]) -> System {
    let g = own.graph.clone();
    let unknowns = unknowns.iter().map(|(name, arguments)| Unknown {
        symbol: g.symbol(name, 0),
        arguments: arguments.iter().map(|a| g.symbol(a, 0)).collect(),
    });
    let form = IntegralForm {
        name: "G".into(),
        value: expr(&g, value),
        unknowns: unknowns.collect(),
    };
    own.integral_forms.push(form);
    own
}

/// The energies of two uncoupled motions, one of them with a potential.
#[test]
fn unknown_constants_and_functions() {
    let own = system("x y", "(m x'^2 + m y'^2)/2 - k x^2/2 - x^4", &[]);
    let own = with_form(
        own,
        "a x'^2 + b y'^2 + h",
        &[("a", &[]), ("b", &[]), ("h", &["x"])],
    );
    assert_eq!(
        texts(&own, "noether.form#G"),
        ["y'^2", "m x'^2 + 2 x^4 + k x^2"]
    );
}

/// x' is no integral with a force, whatever it is multiplied by; the moment of momentum of a central force is, once.
#[test]
fn unknown_constants_alone() {
    let own = system("x y", "(x'^2 + y'^2)/2 - (x^2 + y^2)^2", &[]);
    let moment = with_form(own.clone(), "a x y' + b y x'", &[("a", &[]), ("b", &[])]);
    assert_eq!(texts(&moment, "noether.form#G").len(), 1);
    let none = with_form(own, "a x' + b y'", &[("a", &[]), ("b", &[])]);
    assert_eq!(finding(&none, "noether.form#G").verdict.word(), "refuted");
}

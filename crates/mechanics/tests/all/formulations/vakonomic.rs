//! The constrained extremum (T1 §4.1, §4.3, §6.1).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, SKATE};
use crate::formulations::states::vanishes;
use chetaev_mechanics::Equations;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::Expr;

const NAME: &str = "vakonomic";

/// Left minus right side of the equation of a coordinate, as stated, and as printed.
fn stated(case: &Case, equations: &Equations, coordinate: &str) -> Expr {
    let found = equations.groups[0].equations.iter();
    let e = found.clone().find(|e| e.label == coordinate).unwrap();
    case.system.graph.sub(e.left, e.right)
}

fn assert_printed(case: &Case, printed: &[(&str, &str)]) {
    let equations = case.equations(NAME);
    for (coordinate, expected) in printed {
        let found = stated(case, &equations, coordinate);
        assert!(case.equal(found, case.read(expected)), "{coordinate}");
    }
}

/// S4: (x' − κ y)' = 0, y'' = −κ x', (z' + κ)' = 0.
#[test]
fn particle_as_printed() {
    let case = Case::new(PARTICLE);
    expect(&case, "model.constrained-extremum-regular", "proved");
    let x = "x'' - kappa_c' y - kappa_c y'";
    assert_printed(
        &case,
        &[("x", x), ("y", "y'' + kappa_c x'"), ("z", "z'' + kappa_c'")],
    );
}

/// S1: (m x' + κ sin φ)' = m G, (m y' − κ cos φ)' = 0, J φ'' = κ (x' cos φ + y' sin φ).
#[test]
fn skate_as_printed() {
    assert_printed(
        &Case::new(SKATE),
        &[
            (
                "x",
                "m x'' + kappa_blade' sin(phi) + kappa_blade cos(phi) phi' - m G",
            ),
            (
                "y",
                "m y'' - kappa_blade' cos(phi) + kappa_blade sin(phi) phi'",
            ),
            ("phi", "J phi'' - kappa_blade (x' cos(phi) + y' sin(phi))"),
        ],
    );
}

/// S3 along and across the horizontal direction: m ρ' = a κ', (m ρ − κ a) ψ' = 0, m z'' + m g = −κ'; hence
/// κ' = −m g/(1 + a²).
#[test]
fn appell_hamel_as_printed() {
    let case = Case::new(APPELL_HAMEL);
    let g = &case.system.graph;
    let equations = case.equations(NAME);
    let polar: Vec<(Expr, Expr)> = [
        ("x'", "rho cos(psi)"),
        ("y'", "rho sin(psi)"),
        ("x''", "rho' cos(psi) - rho psi' sin(psi)"),
        ("y''", "rho' sin(psi) + rho psi' cos(psi)"),
        ("rho", "exp(k)"),
    ]
    .iter()
    .map(|(a, b)| (case.read(a), case.read(b)))
    .collect();
    let [x, y, z] = ["x", "y", "z"].map(|c| stated(&case, &equations, c));
    let project = |c: &str, s: &str| {
        let projected = g.add(&[g.mul(&[case.read(c), x]), g.mul(&[case.read(s), y])]);
        g.substitute(g.substitute(projected, &polar[..4]), &polar[4..])
    };
    let printed = |text: &str| g.substitute(case.read(text), &polar[4..]);
    let along = project("cos(psi)", "sin(psi)");
    assert!(case.equal(along, printed("m rho' - a kappa_cone'")));
    let across = project("-sin(psi)", "cos(psi)");
    assert!(case.equal(across, printed("(m rho - kappa_cone a) psi'")));
    assert!(case.equal(z, case.read("m z'' + m g + kappa_cone'")));
    let rate = equations.variables.last().unwrap().rate;
    assert!(case.equal_on_constraints(rate, case.read("-m g/(1 + a^2)")));
}

/// S3: the bordered determinant is −m (1 + a²)(m − κ a/ρ), so κ = m ρ/a is singular.
#[test]
fn singular_set_of_appell_hamel() {
    let case = Case::new(APPELL_HAMEL);
    expect(&case, "model.constrained-extremum-regular", "proved");
    let g = &case.system.graph;
    let equations = case.equations(NAME);
    let size = 4;
    let lefts: Vec<Expr> = ["x", "y", "z"]
        .map(|c| stated(&case, &equations, c))
        .to_vec();
    let f = case.read("z'' - a (x' x'' + y' y'')/sqrt(x'^2 + y'^2)");
    let unknown = ["x''", "y''", "z''", "kappa_cone'"].map(|s| case.read(s));
    let symbols: Vec<_> = unknown.iter().map(|&e| g.as_symbol(e).unwrap()).collect();
    let mut rows = g.jacobian(&lefts, &symbols);
    rows.push(g.gradient(f, &symbols));
    assert_eq!(rows.len(), size);
    let printed = case.read("-m (1 + a^2) (m - kappa_cone a/sqrt(x'^2 + y'^2))");
    assert!(case.equal(determinant(g, &rows), printed));
}

/// H1 of S2 and of S4 as functions of the extremal momenta.
#[test]
fn extremal_hamiltonians() {
    let disc = "(pi_theta + R (pi_x cos(phi) + pi_y sin(phi)))^2/(2 (I + m R^2)) + pi_phi^2/(2 J)";
    let particle = "((pi_x + y pi_z)^2/(1 + y^2) + pi_y^2)/2";
    for (text, printed) in [(DISC, disc), (PARTICLE, particle)] {
        let case = Case::new(text);
        let g = &case.system.graph;
        let equations = case.equations(NAME);
        let momenta: Vec<(Expr, Expr)> = case
            .system
            .coordinates
            .iter()
            .map(|c| format!("pi_{}", c.name))
            .map(|name| (case.read(&name), case.object(&equations, &name)))
            .collect();
        let expected = g.substitute(case.read(printed), &momenta);
        let found = case.object(&equations, "H1");
        assert!(case.equal_on_constraints(found, expected));
    }
}

/// The flow of H1 is (11): q' = ∂H1/∂π, π' = −∂H1/∂q. S4, with the velocities by the momenta.
#[test]
fn characteristics_of_the_extremal_hamiltonian() {
    let case = Case::new(PARTICLE);
    let (system, g) = (&case.system, &case.system.graph);
    let equations = case.equations(NAME);
    let rates: Vec<_> = equations
        .variables
        .iter()
        .map(|x| (x.symbol, x.rate))
        .collect();
    let hamiltonian = case.read("((pi_x + y pi_z)^2/(1 + y^2) + pi_y^2)/2");
    let names = ["x", "y", "z"];
    let momenta: Vec<(Expr, Expr)> = names
        .iter()
        .map(|c| {
            (
                case.read(&format!("pi_{c}")),
                case.object(&equations, &format!("pi_{c}")),
            )
        })
        .collect();
    for (c, &(pi, definition)) in names.iter().zip(&momenta) {
        let symbol = |e: Expr| g.as_symbol(e).unwrap();
        let flow = g.substitute(g.diff(hamiltonian, symbol(pi)), &momenta);
        assert!(case.equal_on_constraints(flow, case.read(&format!("{c}'"))));
        let slope = g.substitute(g.diff(hamiltonian, symbol(case.read(c))), &momenta);
        let moved = chetaev_mechanics::characteristics::derive_along(
            system,
            &[definition],
            &equations.velocities,
            g.one(),
            &rates,
        );
        assert!(case.equal_on_constraints(g.add(&[moved[0], slope]), g.zero()));
    }
}

/// κ is data of its own: a variable without definition, and the equation is no equivalent form.
#[test]
fn multipliers_are_states() {
    let case = Case::new(PARTICLE);
    let equations = case.equations(NAME);
    let kappa = equations.variables.last().unwrap();
    assert_eq!(kappa.name, "kappa_c");
    assert!(kappa.definition.is_none());
    let routh = case.equations("routh");
    let difference = case
        .system
        .graph
        .sub(equations.accelerations[1], routh.accelerations[1]);
    assert!(!vanishes(&case, difference));
}

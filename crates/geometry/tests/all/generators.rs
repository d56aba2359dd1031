//! Generators of first integrals and the embedded 2-form: the values of T3 §6 and §8, and the printed errors refuted.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::{expr, system, with_context as with};
use chetaev_geometry::noether::embedded::Embedded;
use chetaev_geometry::noether::generator::Generator;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::{Characteristics, System};
use chetaev_symbolic::{Expr, Verdict};

fn vanish(cx: &Context<'_>, n: &Embedded<'_>, residuals: &[Expr]) -> bool {
    let verdict = cx.prover.identity(cx.system, residuals, n.manifold(), "");
    match verdict {
        Verdict::Proved(_) => true,
        Verdict::Refuted(_) => false,
        other => panic!("{other:?}"),
    }
}

fn natural<'a>(cx: &Context<'a>) -> Embedded<'a> {
    let chart = Characteristics::independent_velocities(cx.system, cx.terms, cx.selection);
    Embedded::by(cx, Some(chart.unwrap())).unwrap()
}

/// Everything that Noether's theorem says of an integral, in the adapted and in the natural frame, with δ = 0, 1 and a
/// function.
fn theorem_holds(system: &System, integral: &str) {
    with(system, |cx| {
        let g = &system.graph;
        for n in [Embedded::of(cx).unwrap(), natural(cx)] {
            let deltas = [g.zero(), g.one(), g.mul(&[g.symbol("t", 0), n.speeds()[0]])];
            for delta in deltas {
                let generator = Generator::of(&n, expr(g, integral), delta).unwrap();
                let mut residuals = generator.killing_speeds(&n);
                residuals.push(generator.killing_drift(&n));
                residuals.extend(generator.along_fields(&n));
                residuals.push(generator.along_time(&n));
                residuals.extend(generator.contraction(&n));
                assert!(vanish(cx, &n, &residuals), "{integral}");
            }
        }
    });
}

const APPELL: &str = "m (x'^2 + y'^2 + z'^2)/2 - m g z";
const CONE: (&str, &str) = ("cone", "z' - a sqrt(x'^2 + y'^2)");
const PARTICLE: &str = "(x'^2 + y'^2 + z'^2)/2";
const SLED: &str = "m (x'^2 + y'^2 + b^2 phi'^2)/2";

#[test]
fn noethers_theorem_for_the_examples() {
    let appell = system("x y z", APPELL, &[CONE]);
    theorem_holds(&appell, "x'/y'");
    theorem_holds(&appell, "sqrt(x'^2 + y'^2) + g a t/(1 + a^2)");
    theorem_holds(&appell, "m (x'^2 + y'^2 + z'^2)/2 + m g z");
    let particle = system("x y z", PARTICLE, &[("c", "z' - y x'")]);
    theorem_holds(&particle, "sqrt(1 + y^2) x'");
    let sled = system("x y phi", SLED, &[("blade", "y' - x' tan(phi)")]);
    theorem_holds(&sled, "x'/cos(phi)");
    theorem_holds(&sled, "phi' x - y'");
}

/// A function that is no integral fails (14b), and nothing else can hold.
#[test]
fn what_is_no_integral_has_no_generator() {
    let particle = system("x y z", PARTICLE, &[("c", "z' - y x'")]);
    with(&particle, |cx| {
        let g = &particle.graph;
        let n = Embedded::of(cx).unwrap();
        let generator = Generator::of(&n, expr(g, "x'"), g.zero()).unwrap();
        assert!(
            vanish(cx, &n, &generator.killing_speeds(&n)),
            "(14a) holds for any function"
        );
        assert!(!vanish(cx, &n, &[generator.killing_drift(&n)]));
    });
}

fn zeta_is(system: &System, integral: &str, expected: [&str; 2], printed: [&str; 2]) {
    with(system, |cx| {
        let g = &system.graph;
        let n = natural(cx);
        let generator = Generator::of(&n, expr(g, integral), g.zero()).unwrap();
        let minus = |texts: [&str; 2]| -> Vec<Expr> {
            let pairs = generator.zeta.iter().zip(texts);
            pairs
                .map(|(&zeta, text)| g.sub(zeta, expr(g, text)))
                .collect()
        };
        assert!(vanish(cx, &n, &minus(expected)), "{integral}");
        assert!(
            !vanish(cx, &n, &minus(printed)),
            "the printed formula for {integral}"
        );
    });
}

/// T3 §6, acceptance for (16): ζ by (15b), and what the shorter printed formula gives.
#[test]
fn components_along_the_velocities() {
    let appell = system("x y z", APPELL, &[CONE]);
    let rho = "sqrt(x'^2 + y'^2)";
    let first = format!("-a g/(m (1 + a^2) y' {rho})");
    let second = format!("x'/y' a g/(m (1 + a^2) y' {rho})");
    zeta_is(&appell, "x'/y'", ["0", "0"], [&first, &second]);
    let particle = system("x y z", PARTICLE, &[("c", "z' - y x'")]);
    zeta_is(&particle, "y'", ["x' y/(1 + y^2)", "0"], ["0", "0"]);
    let sled = system("x y phi", SLED, &[("blade", "y' - x' tan(phi)")]);
    zeta_is(&sled, "x'/cos(phi)", ["0", "0"], ["phi' sin(phi)/m", "0"]);
}

/// T3 §8.5: ξ and g of the ratio; without the factor 1/m of the print they do not solve (14).
#[test]
fn appells_ratio() {
    let appell = system("x y z", APPELL, &[CONE]);
    with(&appell, |cx| {
        let g = &appell.graph;
        let n = natural(cx);
        let generator = Generator::of(&n, expr(g, "x'/y'"), g.zero()).unwrap();
        let is = |e: Expr, text: &str| vanish(cx, &n, &[g.sub(e, expr(g, text))]);
        assert!(is(generator.xi[0], "-1/(m y')") && is(generator.xi[1], "x'/(m y'^2)"));
        assert!(is(generator.gauge, "x'/y'"));
        let printed = Generator {
            xi: vec![expr(g, "-1/y'"), expr(g, "x'/y'^2")],
            chi: vec![expr(g, "-1/y'"), expr(g, "x'/y'^2")],
            ..generator
        };
        assert!(!vanish(cx, &n, &printed.killing_speeds(&n)));
    });
}

/// T3 §8.1, §8.5: the energy with δ = 1 has ξ = 0 and g = 0; with δ = 0 it has ξ = -η.
#[test]
fn the_energy_is_translation_in_time() {
    let appell = system("x y z", APPELL, &[CONE]);
    with(&appell, |cx| {
        let g = &appell.graph;
        let n = natural(cx);
        let energy = appell.energy();
        let moving = Generator::of(&n, energy, g.one()).unwrap();
        let mut zeros = moving.xi.clone();
        zeros.push(moving.gauge);
        assert!(vanish(cx, &n, &zeros));
        let still = Generator::of(&n, energy, g.zero()).unwrap();
        let sums: Vec<Expr> = still
            .xi
            .iter()
            .zip(n.speeds())
            .map(|(&xi, eta)| g.add(&[xi, eta]))
            .collect();
        assert!(vanish(cx, &n, &sums));
    });
}

/// T3 §5, Appell: W̄ from the full Lagrangian, and not the Hessian of L̄.
#[test]
fn embedded_mass_matrix() {
    let appell = system("x y z", APPELL, &[CONE]);
    with(&appell, |cx| {
        let g = &appell.graph;
        let n = natural(cx);
        let entry = |text: &str| expr(g, text);
        let expected = [
            "m (1 + a^2) - m a^2 y'^2/(x'^2 + y'^2)",
            "m a^2 x' y'/(x'^2 + y'^2)",
            "m a^2 x' y'/(x'^2 + y'^2)",
            "m (1 + a^2) - m a^2 x'^2/(x'^2 + y'^2)",
        ];
        let residuals: Vec<Expr> = n
            .mass
            .concat()
            .iter()
            .zip(expected)
            .map(|(&w, e)| g.sub(w, entry(e)))
            .collect();
        assert!(vanish(cx, &n, &residuals));
        let hessian: Vec<Expr> = n
            .hessian
            .concat()
            .iter()
            .zip(expected)
            .map(|(&w, e)| g.sub(w, entry(e)))
            .collect();
        assert!(!vanish(cx, &n, &hessian));
    });
}

/// Catalogue of claims, §6, `noether.embedded`, for linear and nonlinear constraints, and without any.
#[test]
fn the_motion_is_the_kernel() {
    let systems = [
        system("x y z", APPELL, &[CONE]),
        system("x y z", PARTICLE, &[("c", "z' - y x'")]),
        system("x y phi", SLED, &[("blade", "x' sin(phi) - y' cos(phi)")]),
        system("x y", "(x'^2 + y'^2)/2 - x^2 y", &[]),
    ];
    for system in &systems {
        let finding = crate::common::finding(system, "noether.embedded");
        assert!(
            matches!(finding.verdict, Verdict::Proved(_)),
            "{:?}",
            finding.verdict
        );
    }
}

/// Catalogue of claims, §6, `cartan.form`: for the Lagrangian and for nonlinear constraints.
#[test]
fn cartan_forms() {
    let appell = system("x y z", APPELL, &[CONE]);
    for subject in ["L", "cone"] {
        let finding = crate::common::finding(&appell, &format!("cartan.form#{subject}"));
        assert!(
            matches!(finding.verdict, Verdict::Proved(_)),
            "{subject}: {:?}",
            finding.verdict
        );
    }
}

/// (15b) and (15c) by their terms, with the indices of `Y_jp_i` and of `S_ji` in their order or exchanged, for δ = 0.
fn structure(n: &Embedded<'_>, field: &Generator, momenta: bool, brackets: bool) -> Vec<Expr> {
    let (g, k) = (&n.system.graph, n.k());
    let sum = |parts: Vec<Expr>| g.add(&parts);
    let along = |j: usize, i: usize| match momenta {
        true => n.momenta_along[i][j],
        false => n.momenta_along[j][i],
    };
    let bracket = |j: usize, i: usize| match brackets {
        true => n.gyro[i][j],
        false => n.gyro[j][i],
    };
    let (p, speeds) = (&n.terms.momenta, n.speeds());
    let (of_xi, of_gauge) = (n.along_fields(&field.xi), n.along_fields(&[field.gauge]));
    let mut residuals: Vec<Expr> = (0..k)
        .map(|i| {
            let terms = (0..k).flat_map(|j| {
                [
                    g.mul(&[p[j], of_xi[i][j]]),
                    g.mul(&[n.mass[i][j], field.zeta[j]]),
                    g.mul(&[along(j, i), field.xi[j]]),
                    g.neg(g.mul(&[bracket(j, i), field.xi[j]])),
                ]
            });
            sum(terms.chain([g.neg(of_gauge[i][0])]).collect())
        })
        .collect();
    let (of_xi, of_gauge) = (n.along_time(&field.xi), n.along_time(&[field.gauge]));
    let terms = (0..k).flat_map(|i| {
        let pushed = g.add(&[n.gyro_time[i], n.terms.slopes[i], n.terms.forces[i]]);
        let changed = (0..k).flat_map(|j| {
            [
                g.mul(&[g.sub(n.hessian[i][j], n.turning[i][j]), field.zeta[j]]),
                g.mul(&[along(j, i), field.xi[j]]),
            ]
        });
        let changed = sum(changed.collect());
        [
            g.mul(&[p[i], of_xi[i]]),
            g.mul(&[pushed, field.xi[i]]),
            g.neg(g.mul(&[speeds[i], changed])),
        ]
    });
    residuals.push(sum(terms.chain([g.neg(of_gauge[0])]).collect()));
    residuals
}

/// T3 (15b), (15c): the placement of the indices that the print confuses. `(Y_jp_i) ξ^j` and `S_ji ξ^j` are summed over their first
/// index; with the two exchanged the equations fail for the sled in independent velocities.
#[test]
fn zhao_15_the_indices_of_the_structure_equations() {
    let sled = system("x y phi", SLED, &[("blade", "y' - x' tan(phi)")]);
    with(&sled, |cx| {
        let g = &sled.graph;
        let n = natural(cx);
        for integral in ["x'/cos(phi)", "phi' x - y'"] {
            let generator = Generator::of(&n, expr(g, integral), g.zero()).unwrap();
            let holds = |momenta: bool, brackets: bool| {
                vanish(cx, &n, &structure(&n, &generator, momenta, brackets))
            };
            assert!(holds(false, false), "{integral}");
            assert!(!holds(true, false), "{integral}: Y_ip_j");
            assert!(!holds(false, true), "{integral}: S_ij");
        }
    });
}

//! Zhao, The differential geometric principle of nonholonomic mechanical systems of Chetaev's type.

use super::manifold::{on_manifold, Chart, OnManifold};
use crate::formulations::common::{Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::formulations::nielsen::expect_different;
use chetaev_symbolic::Expr;

/// S4 with a potential c x, in the frame X1 = ∂x + y ∂z, X2 = ∂y, X3 = ∂z: the metric of the frame is not constant.
const PULLED: &str = r#"
coordinates = ["x", "y", "z"]
parameters = { c = {} }
assumptions = ["c > 0"]
lagrangian = { T = "1/2 (x'^2 + y'^2 + z'^2)", V = "c x" }
constraints = { slope = "z' = y x'" }
[moving_frame.fields]
h = { x = 1, z = "y" }
k = { y = 1 }
s = { z = 1 }
"#;

/// S1 on a level plane with x', φ' independent: y' = tan φ x'.
const SLED: &str = r#"
coordinates = ["x", "y", "phi"]
parameters = { m = {}, J = {} }
assumptions = ["m > 0", "J > 0"]
lagrangian = { T = "1/2 m (x'^2 + y'^2) + 1/2 J phi'^2" }
constraints = { blade = "x' sin(phi) = y' cos(phi)" }
velocities = { independent = ["x'", "phi'"] }
"#;

/// Zhao, Lemma 1: the rank of Ω̄ is 2k, not 2k + 1. The motion is in the kernel, and W̄ is regular.
#[test]
fn zhao_lemma_1_the_rank_is_even() {
    for (text, chart) in [
        (APPELL_HAMEL, Chart::Natural),
        (DISC, Chart::Adapted),
        (PULLED, Chart::Adapted),
        (SLED, Chart::Natural),
    ] {
        on_manifold(text, chart, |n| {
            let g = &n.case.system.graph;
            let mut motion = vec![g.one()];
            motion.extend(vec![g.zero(); n.k()]);
            motion.extend(n.accelerations());
            for e in n.contracted(&motion) {
                n.vanishes(e);
            }
            let determinant = g.sub(
                g.mul(&[n.mass[0][0], n.mass[1][1]]),
                g.mul(&[n.mass[0][1], n.mass[1][0]]),
            );
            n.fails(determinant);
        });
    }
}

/// Left side of (12) minus P_i for the rate of L̄ that is given.
fn nielsen(n: &OnManifold<'_>, rate: Expr) -> Vec<Expr> {
    let (g, terms) = (&n.case.system.graph, &n.terms);
    let two = g.integer(2);
    n.by_speeds(rate)
        .into_iter()
        .enumerate()
        .map(|(i, slope)| {
            let lost = [
                n.dot(&terms.k[i], &terms.momenta),
                g.mul(&[two, terms.slopes[i]]),
                n.dot(&n.turning(i), &terms.dependent_momenta),
                terms.forces[i],
            ];
            g.sub(slope, g.add(&lost))
        })
        .collect()
}

/// Zhao (12): with the accelerations frozen it is (10) identically. With the bracket as printed, [X̄, ∂_i] = -Y_i, the
/// accelerations may be put in first, and the form is wrong by (∂_iA^j) p_j.
#[test]
fn zhao_12_nielsen_with_frozen_accelerations() {
    for (text, chart) in [
        (PARTICLE, Chart::Adapted),
        (PULLED, Chart::Adapted),
        (SKATE, Chart::Adapted),
        (POLAR, Chart::Natural),
    ] {
        on_manifold(text, chart, |n| {
            let (g, terms) = (&n.case.system.graph, &n.terms);
            let chart = &n.embedding.chart;
            let rate = chart.total_derivative(&n.case.system, &[terms.lagrangian])[0];
            for (i, left) in nielsen(n, rate).into_iter().enumerate() {
                let embedded = g.sub(
                    terms.moved[i],
                    g.add(&[
                        n.slope(i),
                        n.dot(&n.turning(i), &terms.dependent_momenta),
                        g.neg(n.dot(&terms.g[i], &terms.dependent_momenta)),
                    ]),
                );
                n.vanishes(g.sub(left, embedded));
            }
        });
    }
    printed_nielsen(PARTICLE, Chart::Adapted);
    printed_nielsen(POLAR, Chart::Natural);
}

fn printed_nielsen(text: &str, chart: Chart) {
    on_manifold(text, chart, |n| {
        let g = &n.case.system.graph;
        let substituted = n.along(n.terms.lagrangian);
        let slopes: Vec<Vec<Expr>> = n
            .accelerations()
            .into_iter()
            .map(|a| n.by_speeds(a))
            .collect();
        let printed = nielsen(n, substituted);
        for (i, &left) in printed.iter().enumerate() {
            let column: Vec<Expr> = slopes.iter().map(|row| row[i]).collect();
            let excess = n.dot(&column, &n.terms.momenta);
            n.vanishes(g.sub(n.moving(left), excess));
        }
        assert!(printed
            .iter()
            .any(|&left| n.word(n.moving(left)) == "refuted"));
        // The bracket itself, on L̄: X̄∂_iL̄ - ∂_iX̄L̄ = -Y_iL̄ - (∂_iA^j) p_j.
        let of_rate = n.by_speeds(substituted);
        let commutators: Vec<Expr> = (0..n.k())
            .map(|i| g.sub(n.along(n.terms.momenta[i]), of_rate[i]))
            .map(|e| g.neg(e))
            .collect();
        for (i, &commutator) in commutators.iter().enumerate() {
            let column: Vec<Expr> = slopes.iter().map(|row| row[i]).collect();
            let excess = n.dot(&column, &n.terms.momenta);
            n.vanishes(g.sub(commutator, g.add(&[n.terms.slopes[i], excess])));
        }
    });
}

/// Zhao (13): G = g - L̄δ - p_iχ^i. With the opposite sign of the last term, as in one printed version, δ = 1 does not give
/// the energy of the machine of Appell and Hamel; and δ of the inverse theorem has the sign that belongs to it.
#[test]
fn zhao_13_the_sign_of_the_momenta() {
    on_manifold(APPELL_HAMEL, Chart::Natural, |n| {
        let g = &n.case.system.graph;
        let speeds: Vec<Expr> = n
            .embedding
            .chart
            .parameters
            .iter()
            .map(|p| p.value)
            .collect();
        let work = n.dot(&n.terms.momenta, &speeds);
        // δ = 1, ξ = 0, g = 0: χ = -η.
        let energy = g.sub(work, n.terms.lagrangian);
        let printed = g.sub(g.neg(work), n.terms.lagrangian);
        n.equal(energy, "1/2 m (1 + a^2) (x'^2 + y'^2) + m g z");
        n.vanishes(n.along(energy));
        n.fails(n.along(printed));
        // Inverse theorem with g = 0: L̄ δ = -G + p_i W̄^ij ∂_jG, and δ = 1 for the energy.
        let generator = g.solve(&n.mass.concat(), &n.by_speeds(energy)).unwrap();
        let action = n.dot(&n.terms.momenta, &generator);
        n.vanishes(g.sub(g.sub(action, energy), n.terms.lagrangian));
        n.fails(g.sub(g.add(&[action, energy]), n.terms.lagrangian));
    });
}

/// ζ by (16), or by the shorter formula that is printed; δ = 0, with χ = ξ.
fn zeta(n: &OnManifold<'_>, chi: &[Expr], printed: bool) -> Vec<Expr> {
    let (g, terms) = (&n.case.system.graph, &n.terms);
    let k = n.k();
    let moved: Vec<Expr> = (0..k)
        .map(|l| {
            let turned: Vec<Expr> = terms.k.iter().map(|row| row[l]).collect();
            g.add(&[n.along(chi[l]), n.dot(&turned, chi)])
        })
        .collect();
    let system = &n.case.system;
    let dependent = &n.embedding.chart.dependent;
    let of_force: Vec<Vec<Expr>> = terms.forces.iter().map(|&p| n.by_speeds(p)).collect();
    let of_momenta: Vec<Vec<Expr>> = terms
        .dependent_momenta
        .iter()
        .map(|&l| n.by_speeds(l))
        .collect();
    let right: Vec<Expr> = (0..k)
        .map(|j| {
            let mut parts = vec![n.dot(&n.mass[j], &moved)];
            for i in 0..k {
                let turning = n.turning(i);
                let mut inner = vec![of_force[i][j]];
                for (alpha, &d) in dependent.iter().enumerate() {
                    let slope = n.by_speeds(n.embedding.slopes[alpha][i])[j];
                    inner.push(g.neg(g.mul(&[slope, system.forces[d]])));
                    if !printed {
                        inner.push(g.neg(g.mul(&[slope, n.reactions[alpha]])));
                        inner.push(g.mul(&[of_momenta[alpha][j], n.moving(turning[alpha])]));
                    }
                }
                parts.push(g.mul(&[g.add(&inner), chi[i]]));
            }
            g.add(&parts)
        })
        .collect();
    g.solve(&n.mass.concat(), &right).unwrap()
}

/// Zhao's ζ: with all terms of (16) Ȳ ⌟ Ω̄ = dG holds, with the printed ones it does not (T3 §6).
#[test]
fn zhao_16_the_velocity_part_of_the_generator() {
    let particle = format!("{PARTICLE}velocities = {{ independent = [\"x'\", \"y'\"] }}\n");
    let machine = format!("{APPELL_HAMEL}velocities = {{ independent = [\"x'\", \"y'\"] }}\n");
    let cases = [
        (
            machine.as_str(),
            "x'/y'",
            ["0", "0"],
            [
                "-a g/(m (1 + a^2) y' sqrt(x'^2 + y'^2))",
                "a g x'/(m (1 + a^2) y'^2 sqrt(x'^2 + y'^2))",
            ],
        ),
        (particle.as_str(), "y'", ["x' y/(1 + y^2)", "0"], ["0", "0"]),
        (SLED, "x'/cos(phi)", ["0", "0"], ["phi' sin(phi)/m", "0"]),
    ];
    for (text, integral, corrected, printed) in cases {
        on_manifold(text, Chart::Natural, |n| {
            let g = &n.case.system.graph;
            let integral = n.read(integral);
            n.vanishes(n.along(integral));
            let slopes: Vec<Expr> = n.by_speeds(integral).iter().map(|&e| g.neg(e)).collect();
            let chi = g.solve(&n.mass.concat(), &slopes).unwrap();
            let target = n.differential(integral);
            let residuals = |zeta: &[Expr]| -> Vec<Expr> {
                let field: Vec<Expr> = [&[g.zero()], &chi[..], zeta].concat();
                let contracted = n.contracted(&field);
                let pairs = contracted.iter().zip(&target);
                pairs.map(|(&a, &b)| g.sub(a, b)).collect()
            };
            let full = zeta(n, &chi, false);
            for (&e, text) in full.iter().zip(corrected) {
                n.equal(e, text);
            }
            for e in residuals(&full) {
                n.vanishes(e);
            }
            let short = zeta(n, &chi, true);
            for (&e, text) in short.iter().zip(printed) {
                n.equal(e, text);
            }
            assert!(residuals(&short).iter().any(|&e| n.word(e) == "refuted"));
        });
    }
}

/// Zhao (17) for G = ψ^ip_i in an adapted frame: the condition lacks ψ^iX_iL̄. Without it √(1+y²) x' passes under a force along
/// x, where it is no integral, and y' is rejected although it is one.
#[test]
fn zhao_17_generalized_momentum() {
    on_manifold(PULLED, Chart::Adapted, |n| {
        let (g, terms) = (&n.case.system.graph, &n.terms);
        let condition = |psi: &[Expr], complete: bool| {
            let moved: Vec<Expr> = psi.iter().map(|&e| n.frozen(e)).collect();
            let mut parts = vec![n.dot(&terms.momenta, &moved)];
            for (i, &factor) in psi.iter().enumerate() {
                let mut inner = vec![
                    n.dot(&terms.k[i], &terms.momenta),
                    n.dot(&terms.g[i], &terms.dependent_momenta),
                    terms.forces[i],
                ];
                if complete {
                    inner.push(terms.slopes[i]);
                }
                parts.push(g.mul(&[factor, g.add(&inner)]));
            }
            g.add(&parts)
        };
        let along_x = [n.read("1/sqrt(1 + y^2)"), g.zero()];
        let along_y = [g.zero(), g.one()];
        for psi in [&along_x, &along_y] {
            let rate = n.along(n.dot(psi, &terms.momenta));
            n.vanishes(g.sub(rate, condition(psi, true)));
        }
        n.equal(n.dot(&along_x, &terms.momenta), "sqrt(1 + y^2) h");
        n.equal(condition(&along_x, true), "-c/sqrt(1 + y^2)");
        n.vanishes(condition(&along_x, false));
        n.fails(n.along(n.dot(&along_x, &terms.momenta)));
        n.vanishes(condition(&along_y, true));
        n.equal(condition(&along_y, false), "-y h^2");
    });
}

/// Zhao's sled: Z = ∂_φ is a symmetry of the reduced 2-form for the gyroscopic extension of the reaction, not for λ ∂f. The
/// 2-form depends on φ through its forces only, and both extensions keep f. On f = 0 they are the same force.
#[test]
fn zhao_sled_extension_of_the_reaction() {
    let case = Case::new(SLED);
    let (g, system) = (&case.system.graph, &case.system);
    let field = case.equations("lagrange-vector-field");
    let phi = system.coordinates[2].q_symbol;
    let zero = g.zero();
    for object in field.objects.iter().filter(|o| o.name.starts_with("Theta")) {
        assert!(case.equal(g.diff(object.value, phi), zero));
    }
    let lambda = "(-m phi' (x' cos(phi) + y' sin(phi)))";
    let printed = [
        case.read(&format!("{lambda} sin(phi)")),
        case.read(&format!("-{lambda} cos(phi)")),
        zero,
    ];
    let gyroscopic = [case.read("-m phi' y'"), case.read("m phi' x'"), zero];
    let masses = [case.read("m"), case.read("m"), case.read("J")];
    let rate = |e: Expr, forces: &[Expr; 3]| {
        let accelerations: Vec<(Expr, Expr)> = (0..3)
            .map(|i| (system.coordinates[i].a, g.div(forces[i], masses[i])))
            .collect();
        g.substitute_all(&[system.total_derivative(e)], &accelerations)[0]
    };
    let f = system.constraints[0].f;
    let integral = g.diff(f, phi);
    for forces in [&printed, &gyroscopic] {
        assert!(case.equal(rate(f, forces), zero));
        assert!(case.equal_on_constraints(rate(integral, forces), zero));
    }
    for (&a, &b) in printed.iter().zip(&gyroscopic) {
        assert!(case.equal_on_constraints(a, b));
    }
    assert!(case.equal(rate(integral, &gyroscopic), zero));
    let left_over = case.read("-phi' (x' sin(phi) - y' cos(phi))");
    assert!(case.equal(rate(integral, &printed), left_over));
    for force in gyroscopic {
        assert!(case.equal(g.diff(force, phi), zero));
    }
    let slope = g.diff(printed[0], phi);
    expect_different(&case, slope, zero);
}

/// Left minus right sides of the Killing equations (14a), (14b) with δ = 0.
fn killing(n: &OnManifold<'_>, xi: &[Expr], gauge: Expr) -> Vec<Expr> {
    let (g, terms) = (&n.case.system.graph, &n.terms);
    let of_gauge = n.by_speeds(gauge);
    let of_xi: Vec<Vec<Expr>> = xi.iter().map(|&e| n.by_speeds(e)).collect();
    let slopes = &n.embedding.slopes;
    let mut residuals: Vec<Expr> = (0..n.k())
        .map(|i| {
            let column: Vec<Expr> = of_xi.iter().map(|row| row[i]).collect();
            let mut parts = vec![n.dot(&terms.momenta, &column), g.neg(of_gauge[i])];
            for (row, &momentum) in slopes.iter().zip(&terms.dependent_momenta) {
                let turned: Vec<Expr> = row.iter().map(|&c| n.by_speeds(c)[i]).collect();
                parts.push(g.mul(&[momentum, n.dot(&turned, xi)]));
            }
            g.add(&parts)
        })
        .collect();
    let moved: Vec<Expr> = xi.iter().map(|&e| n.frozen(e)).collect();
    let slopes: Vec<Expr> = (0..n.k()).map(|i| n.slope(i)).collect();
    residuals.push(g.add(&[
        n.dot(&terms.momenta, &moved),
        n.dot(&slopes, xi),
        g.neg(n.frozen(gauge)),
    ]));
    residuals
}

/// Zhao, example of Appell: ξ = (-1/(m η2), η1/(m η2²)) with g = η1/η2 solves the Killing equations; without 1/m, as printed,
/// it does not.
#[test]
fn zhao_appell_the_mass_in_the_generator() {
    on_manifold(APPELL_HAMEL, Chart::Natural, |n| {
        let gauge = n.read("x'/y'");
        n.vanishes(n.along(gauge));
        let corrected = [n.read("-1/(m y')"), n.read("x'/(m y'^2)")];
        for e in killing(n, &corrected, gauge) {
            n.vanishes(e);
        }
        let printed = [n.read("-1/y'"), n.read("x'/y'^2")];
        let residuals = killing(n, &printed, gauge);
        assert!(residuals.iter().any(|&e| n.word(e) == "refuted"));
    });
}

/// Zhao, example of Appell: with c = η2/η1 the path is √(1+c²) (x - x0) = √(1+c²) (y - y0)/c = (z - z0)/a; the printed last
/// factor is 1/c. The rates, squared so that no branch has to be named.
#[test]
fn zhao_appell_the_path() {
    on_manifold(APPELL_HAMEL, Chart::Natural, |n| {
        let c = n.read("y'/x'");
        n.vanishes(n.along(c));
        let rate = n.embedding.chart.velocities[2];
        let g = &n.case.system.graph;
        let square = |e: Expr| g.mul(&[e, e]);
        let along_x = n.read("(1 + (y'/x')^2) x'^2");
        let along_y = n.read("(1 + (y'/x')^2) (y'/(y'/x'))^2");
        let corrected = square(g.div(rate, n.read("a")));
        n.vanishes(g.sub(along_x, corrected));
        n.vanishes(g.sub(along_y, corrected));
        n.fails(g.sub(along_x, square(g.div(rate, c))));
    });
}

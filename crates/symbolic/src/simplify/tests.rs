//! Textbook forms (T1 §1, T3 §8, reference cases) reached from the formulas a derivation produces.

use super::*;
use crate::polynomial::normal_form::normal_form;
use crate::polynomial::normal_form::tests::read;
use crate::rational::Rational;

/// The simplified expression is exactly what the text says.
fn check(input: &str, expected: &str) {
    let g = Graph::new();
    let found = simplify(&g, read(&g, input), &Options::default());
    assert_eq!(g.text(found), g.text(read(&g, expected)), "from {input}");
}

fn symbols(g: &Graph, names: &[(&str, u32)]) -> Vec<Expr> {
    names
        .iter()
        .map(|&(name, order)| g.symbol(name, order))
        .collect()
}

#[test]
fn common_factors_are_cancelled_and_pulled_out() {
    check("(x^2 - y^2)/(x - y)", "x + y");
    check("m a x + m a y", "m a (x + y)");
    check("m x'/(m + m a^2)", "x'/(1 + a^2)");
    check("m (x + y)^2/(x + y)^3", "m/(x + y)");
    check("x^2 + 2 x y + y^2", "(x + y)^2");
    check("a b + a c + b d + c d", "(a + d) (b + c)");
}

#[test]
fn sums_over_a_root() {
    check(
        "m c^2 sqrt(1 - v^2/c^2) + m v^2/sqrt(1 - v^2/c^2) - F y",
        "m c^2/sqrt(1 - v^2/c^2) - F y",
    );
    check(
        "x^2/sqrt(x^2 + y^2) + y^2/sqrt(x^2 + y^2)",
        "sqrt(x^2 + y^2)",
    );
}

#[test]
fn pythagoras_goes_both_ways() {
    check("m cos(phi)^2 + m sin(phi)^2", "m");
    check("J + m a^2 sin(phi)^2 + m a^2 cos(phi)^2", "J + m a^2");
    check("J + m a^2 - m a^2 cos(phi)^2", "J + m a^2 sin(phi)^2");
    check("(1 - cos(phi)^2)/sin(phi)", "sin(phi)");
    check("x'^2 cos(phi)^2 + x'^2 sin(phi)^2 + y'^2", "x'^2 + y'^2");
    check("cosh(x)^2 - 1", "sinh(x)^2");
    check("sin(phi)^4 + 2 sin(phi)^2 cos(phi)^2 + cos(phi)^4", "1");
}

#[test]
fn readable_input_is_left_alone() {
    for text in [
        "cos(alpha - beta)",
        "m g/(1 + a^2)",
        "x/(1 + a) + y/(1 + b)",
        "(x + y)^2",
        "tan(phi) x'",
        "m sec(phi)^2 x''",
        "sqrt((x - 1)^2 + y^2)",
        "m/2 (x'^2 + y'^2)",
        "abs(x) y",
    ] {
        check(text, text);
    }
}

/// T1 S4 and T3 §8.2.
#[test]
fn particle_multiplier() {
    check("-m ((-y) (x' y')/(1 + y^2)) y + m x' y'/(1+y^2)", "m x' y'");
    check("m (x' y' - y^2 x' y'/(1 + y^2))", "m x' y'/(1 + y^2)");
}

/// A bordered system as Routh's equations pose it; the unknowns are the accelerations and λ.
fn routh_lambda(g: &Graph, mass: &[&str], force: &[&str], jacobian: &[&str], rate: &str) -> Expr {
    let n = mass.len();
    let size = n + 1;
    let mut matrix = vec![g.zero(); size * size];
    let mut rhs: Vec<Expr> = force.iter().map(|f| read(g, f)).collect();
    for i in 0..n {
        matrix[i * size + i] = read(g, mass[i]);
        let j = read(g, jacobian[i]);
        matrix[i * size + n] = g.neg(j);
        matrix[n * size + i] = j;
    }
    rhs.push(read(g, rate));
    g.solve(&matrix, &rhs).unwrap()[n]
}

/// T1 S1 on the level: λ = -m u φ' with u = x' cos φ + y' sin φ.
#[test]
fn skate_multiplier() {
    let g = Graph::new();
    let lambda = routh_lambda(
        &g,
        &["m", "m", "J"],
        &["0", "0", "0"],
        &["sin(phi)", "-cos(phi)", "0"],
        "-(x' cos(phi) + y' sin(phi)) phi'",
    );
    let found = simplify(&g, lambda, &Options::default());
    assert_eq!(
        g.text(found),
        g.text(read(&g, "-m phi' (x' cos(phi) + y' sin(phi))"))
    );
}

#[test]
fn skate_multiplier_on_the_incline() {
    let g = Graph::new();
    let lambda = routh_lambda(
        &g,
        &["m", "m", "J"],
        &["m G", "0", "0"],
        &["sin(phi)", "-cos(phi)", "0"],
        "-(x' cos(phi) + y' sin(phi)) phi'",
    );
    let found = simplify(&g, lambda, &Options::default());
    let expected = "-m (G sin(phi) + phi' (x' cos(phi) + y' sin(phi)))";
    assert_eq!(g.text(found), g.text(read(&g, expected)));
}

/// T1 S3: λ = m g/(1+a²).
#[test]
fn appell_hamel_multiplier() {
    let g = Graph::new();
    let lambda = routh_lambda(
        &g,
        &["m", "m", "m"],
        &["0", "0", "-m g"],
        &["-a x'/sqrt(x'^2 + y'^2)", "-a y'/sqrt(x'^2 + y'^2)", "1"],
        "0",
    );
    let found = simplify(&g, lambda, &Options::default());
    assert_eq!(g.text(found), g.text(read(&g, "m g/(1 + a^2)")));
}

/// T1 S4: λ = m x' y'/(1+y²).
#[test]
fn particle_multiplier_by_routh() {
    let g = Graph::new();
    let lambda = routh_lambda(
        &g,
        &["m", "m", "m"],
        &["0", "0", "0"],
        &["-y", "0", "1"],
        "x' y'",
    );
    let found = simplify(&g, lambda, &Options::default());
    assert_eq!(g.text(found), g.text(read(&g, "m x' y'/(1 + y^2)")));
}

/// The Chaplygin sleigh contracted with the virtual displacement along φ and expanded, as Maggi's equation comes out.
#[test]
fn chaplygin_sleigh_equation() {
    let g = Graph::new();
    let expanded = read(
        &g,
        "J phi'' + m a^2 phi'' sin(phi)^2 + m a^2 phi'' cos(phi)^2 + m a phi' x' cos(phi) + m a phi' y' sin(phi)",
    );
    let accelerations = symbols(&g, &[("x", 2), ("y", 2), ("phi", 2)]);
    let velocities = symbols(&g, &[("x", 1), ("y", 1), ("phi", 1)]);
    let found = collect(
        &g,
        expanded,
        &[&accelerations, &velocities],
        &Options::default(),
    );
    let expected = "(J + m a^2) phi'' + m a phi' (x' cos(phi) + y' sin(phi))";
    assert_eq!(g.text(found), g.text(read(&g, expected)));
}

/// T1 §3, S1: (9) with θ = m tan φ x'.
#[test]
fn skate_voronets_keeps_tangents() {
    let g = Graph::new();
    let e = read(
        &g,
        "m (1 + tan(phi)^2) x'' + 2 m tan(phi) sec(phi)^2 x' phi' - m tan(phi) sec(phi)^2 x' phi'",
    );
    let accelerations = symbols(&g, &[("x", 2), ("phi", 2)]);
    let velocities = symbols(&g, &[("x", 1), ("phi", 1)]);
    let found = collect(&g, e, &[&accelerations, &velocities], &Options::default());
    let expected = "m sec(phi)^2 x'' + m sec(phi)^2 tan(phi) x' phi'";
    assert_eq!(g.text(found), g.text(read(&g, expected)));
}

#[test]
fn double_pendulum_keeps_differences_of_angles() {
    check(
        "m l1 l2 (cos(alpha) cos(beta) + sin(alpha) sin(beta)) + m l1 l2 cos(alpha - beta)",
        "2 m l1 l2 cos(alpha - beta)",
    );
}

#[test]
fn roots_cancel() {
    check(
        "a x' sqrt(x'^2 + y'^2)/(x'^2 + y'^2)",
        "a x'/sqrt(x'^2 + y'^2)",
    );
    check("(x^2 + y^2)/sqrt(x^2 + y^2)", "sqrt(x^2 + y^2)");
    check("sqrt(m x^2 cos(phi)^2 + m x^2 sin(phi)^2)", "sqrt(m x^2)");
}

#[test]
fn dependent_velocities_are_eliminated() {
    let g = Graph::new();
    let e = read(&g, "x'^2 + y'^2 + z'^2");
    let solved = [(g.symbol("z", 1), read(&g, "y x'"))];
    let found = eliminate(&g, e, &solved, &Options::default());
    assert_eq!(g.text(found), g.text(read(&g, "(1 + y^2) x'^2 + y'^2")));
}

#[test]
fn linear_coefficients() {
    let g = Graph::new();
    let e = read(
        &g,
        "(x' + y')^2 - x'^2 - y'^2 - 2 x' y' + m x' cos(phi) - y'/(1 + a) + b",
    );
    let v = symbols(&g, &[("x", 1), ("y", 1)]);
    let form = linear_form(&g, e, &v, &Budget::DISPLAY)
        .unwrap()
        .expect("linear");
    let expected: Vec<Expr> = ["m cos(phi)", "-1/(1 + a)", "b"]
        .iter()
        .map(|t| read(&g, t))
        .collect();
    assert_eq!(form.coefficients, expected[..2]);
    assert_eq!(form.remainder, expected[2]);
    for text in ["x'^2", "1/x'", "sin(x')", "x' y'"] {
        assert_eq!(
            linear_form(&g, read(&g, text), &v, &Budget::DISPLAY),
            Ok(None),
            "{text}"
        );
    }
}

#[test]
fn parts_of_each_degree() {
    let g = Graph::new();
    let v = symbols(&g, &[("x", 1), ("y", 1)]);
    let e = read(&g, "m/2 (x'^2 + y'^2) + b x x' - m g y");
    let parts = homogeneous_parts(&g, e, &v, &Budget::DISPLAY)
        .unwrap()
        .expect("polynomial");
    let found: Vec<(u32, String)> = parts.iter().map(|p| (p.degree, g.text(p.value))).collect();
    let expected = [(0, "-m g y"), (1, "b x x'"), (2, "m/2 (x'^2 + y'^2)")];
    let expected: Vec<(u32, String)> = expected
        .iter()
        .map(|&(d, t)| (d, g.text(read(&g, t))))
        .collect();
    assert_eq!(found, expected);
}

#[test]
fn homogeneity_is_euler_s_identity() {
    let g = Graph::new();
    let v = symbols(&g, &[("x", 1), ("y", 1), ("z", 1)]);
    let degree = |text: &str| homogeneity(&g, read(&g, text), &v, &Budget::PROOF).unwrap();
    assert_eq!(degree("z' - a sqrt(x'^2 + y'^2)"), Some(Rational::ONE));
    assert_eq!(degree("x'^2/y'^3"), Some(crate::rational::integer(-1)));
    assert_eq!(degree("sqrt(x' y')/m"), Some(Rational::ONE));
    assert_eq!(degree("x' + 1"), None);
    assert_eq!(degree("x'^2 + y'"), None);
}

/// Whatever the input, the value stays and the length does not grow.
#[test]
fn simplification_keeps_values_and_never_lengthens() {
    use crate::number::random::Random;
    let mut random = Random::new(11);
    for round in 0..120 {
        let g = Graph::new();
        let e = random_expression(&g, &mut random, 4);
        let s = simplify(&g, e, &Options::default());
        assert!(
            length(&g, s) <= length(&g, e),
            "{}: {} became {}",
            round,
            g.text(e),
            g.text(s)
        );
        if let Ok(form) = normal_form(&g, g.sub(e, s), &Budget::PROOF) {
            assert!(form.is_zero(), "{} is not {}", g.text(e), g.text(s));
        }
        assert_eq!(s, simplify(&g, e, &Options::default()));
    }
}

fn random_expression(g: &Graph, random: &mut crate::number::random::Random, depth: u32) -> Expr {
    let leaf = |random: &mut crate::number::random::Random| match random.below(6) {
        0 => g.integer(random.between(-3, 3)),
        n => g.symbol(["a", "m", "x", "y", "phi"][n as usize - 1], 0),
    };
    if depth == 0 {
        return leaf(random);
    }
    let child = |random: &mut _| random_expression(g, random, depth - 1);
    match random.below(8) {
        0 | 1 => {
            let (a, b) = (child(random), child(random));
            g.add(&[a, b])
        }
        2 | 3 => {
            let (a, b) = (child(random), child(random));
            g.mul(&[a, b])
        }
        4 => {
            let (a, b) = (child(random), child(random));
            g.div(a, g.add(&[b, g.symbol("z", 0)]))
        }
        5 => {
            let a = child(random);
            g.powi(a, 2)
        }
        6 => g.sin(g.symbol("phi", 0)),
        _ => g.cos(g.symbol("phi", 0)),
    }
}

#[test]
fn large_input_is_returned_quickly() {
    let g = Graph::new();
    let mut e = g.symbol("x", 0);
    for i in 0..300 {
        e = g.add(&[g.powi(e, 2), g.symbol(&format!("a_{i}"), 0)]);
    }
    assert_eq!(simplify(&g, e, &Options::default()), e);
}

#[test]
fn closed_forms_are_given_where_they_are_short() {
    let g = Graph::new();
    let names = |prefix: &str, n: usize| -> Vec<Expr> {
        (0..n)
            .map(|i| g.symbol(&format!("{prefix}{i}"), 0))
            .collect()
    };
    let small = g.solve(&names("a", 4), &names("b", 2)).unwrap()[0];
    let form = closed_form(&g, small, &Options::default()).expect("a quotient of two determinants");
    assert_eq!(
        g.text(form),
        g.text(read(&g, "(a3 b0 - a1 b1)/(a0 a3 - a1 a2)"))
    );
    let large = g.solve(&names("a", 36), &names("b", 6)).unwrap()[0];
    assert_eq!(closed_form(&g, large, &Options::default()), None);
    assert_eq!(simplify(&g, large, &Options::default()), large);
}

/// With θ and φ + θ both in the data, the difference of the two angles is what the formula is about.
#[test]
fn addition_theorems_are_used_backwards() {
    check(
        "sin(theta + phi) cos(theta) - cos(theta + phi) sin(theta)",
        "sin(phi)",
    );
    check("a cos(theta + phi) sin(theta + phi) + b (cos(theta + phi) cos(phi) + sin(theta + phi) sin(phi))",
          "a cos(theta + phi) sin(theta + phi) + b cos(theta)");
}

#[test]
fn a_name_given_twice_in_a_group_is_collected_once() {
    let g = Graph::new();
    let e = read(&g, "m*(1 + y^2)*x'' + m*x''*c + m*y*x'*y'");
    let x2 = g.symbol("x", 2);
    let collected = collect(&g, e, &[&[x2, x2], &[]], &Options::default());
    let difference = g.sub(e, collected);
    assert!(g.is_zero(simplify(&g, difference, &Options::default())));
}

#[test]
fn products_of_two_angles_become_functions_of_sums_and_differences() {
    check(
        "m l (cos(alpha) cos(beta) + sin(alpha) sin(beta))",
        "m l cos(alpha - beta)",
    );
    check(
        "sin(alpha) cos(beta) + cos(alpha) sin(beta)",
        "sin(alpha + beta)",
    );
    check(
        "cos(alpha) sin(beta) - sin(alpha) cos(beta)",
        "-sin(alpha - beta)",
    );
    check(
        "a cos(alpha) cos(beta) - a sin(alpha) sin(beta) + b sin(alpha)",
        "a cos(alpha + beta) + b sin(alpha)",
    );
    check(
        "cos(alpha) cos(beta) cos(gamma) - sin(alpha) sin(beta) cos(gamma) - sin(alpha) cos(beta) sin(gamma) - cos(alpha) sin(beta) sin(gamma)",
        "cos(alpha + beta + gamma)",
    );
    for text in [
        "2 cos(alpha) cos(beta) + sin(alpha) sin(beta)",
        "a cos(alpha) cos(beta) + b sin(alpha) sin(beta)",
    ] {
        check(text, text);
    }
}

/// landau1976, sec. 5, problem 1, as Lagrange's equations give it from Cartesian coordinates.
#[test]
fn double_pendulum_equation() {
    let g = Graph::new();
    let e = read(
        &g,
        "l (m (l a'' cos(a) - l a'^2 sin(a) + l b'' cos(b) - l b'^2 sin(b)) cos(a) + m (l a'' sin(a) + l a'^2 cos(a) + l b'' sin(b) + l b'^2 cos(b)) sin(a) + m g sin(a))",
    );
    let accelerations = symbols(&g, &[("a", 2), ("b", 2)]);
    let velocities = symbols(&g, &[("a", 1), ("b", 1)]);
    let found = collect(&g, e, &[&accelerations, &velocities], &Options::default());
    let expected = "m l^2 a'' + m l^2 cos(a - b) b'' + m l^2 sin(a - b) b'^2 + m g l sin(a)";
    assert_eq!(g.text(found), g.text(read(&g, expected)));
}

/// A chain of n rods: about n³ terms when multiplied out, about n when ordered.
#[test]
fn large_equations_are_ordered_all_the_same() {
    let g = Graph::new();
    let n = 24;
    let name = |letter: &str, i: usize| format!("{letter}_{i}");
    let angle = |i, order| g.symbol(&name("q", i), order);
    let length_of = |i| g.symbol(&name("d", i), 0);
    // Moment of the forces of inertia about the first joint, times the first length.
    let mut terms = Vec::new();
    for j in 1..=n {
        let mut sums = [Vec::new(), Vec::new()];
        for i in 1..=j {
            let (s, c) = (g.sin(angle(i, 0)), g.cos(angle(i, 0)));
            let (v2, a) = (g.powi(angle(i, 1), 2), angle(i, 2));
            sums[0].push(g.mul(&[length_of(i), g.sub(g.mul(&[a, c]), g.mul(&[v2, s]))]));
            sums[1].push(g.mul(&[length_of(i), g.add(&[g.mul(&[a, s]), g.mul(&[v2, c])])]));
        }
        let (s, c) = (g.sin(angle(1, 0)), g.cos(angle(1, 0)));
        let across = g.add(&[g.mul(&[c, g.add(&sums[0])]), g.mul(&[s, g.add(&sums[1])])]);
        terms.push(g.mul(&[g.symbol(&name("M", j), 0), across]));
    }
    let e = g.add(&terms);
    let accelerations: Vec<Expr> = (1..=n).map(|i| angle(i, 2)).collect();
    let velocities: Vec<Expr> = (1..=n).map(|i| angle(i, 1)).collect();
    let found = collect(&g, e, &[&accelerations, &velocities], &Options::default());
    // Σ_i (M_i + … + M_n) d_i (q_i'' cos(q_1 - q_i) + q_i'^2 sin(q_1 - q_i))
    let expected: Vec<Expr> = (1..=n)
        .flat_map(|i| {
            let mass: Vec<Expr> = (i..=n).map(|j| g.symbol(&name("M", j), 0)).collect();
            let common = g.mul(&[g.add(&mass), length_of(i)]);
            let difference = g.sub(angle(1, 0), angle(i, 0));
            let v2 = g.powi(angle(i, 1), 2);
            [
                g.mul(&[common, angle(i, 2), g.cos(difference)]),
                g.mul(&[common, v2, g.sin(difference)]),
            ]
        })
        .collect();
    assert_eq!(g.text(found), g.text(g.add(&expected)));
}

/// d_i = sin(d_(i-1)) d_(i-1): as a tree 2^300 nodes.
#[test]
fn definitions_nested_hundreds_deep_are_printed_with_names() {
    let g = Graph::new();
    let mut d = g.symbol("x", 1);
    for _ in 0..300 {
        d = g.mul(&[g.sin(d), d]);
    }
    assert_eq!(g.tree_size(d), u64::MAX);
    assert_eq!(simplify(&g, d, &Options::default()), d);
    let velocity = g.symbol("x", 1);
    assert_eq!(collect(&g, d, &[&[], &[velocity]], &Options::default()), d);
    let text = g.text(d);
    assert!(text.len() < 1_000_000, "{} signs", text.len());
}

/// Even powers of what is not negative stand before a root; √(y²) is |y|, and stays.
#[test]
fn squares_stand_outside_roots() {
    check("sqrt((1 + y^2)^(-2))", "1/(1 + y^2)");
    check("sqrt(c/(1 + 2 y^2 + y^4))", "sqrt(c)/(1 + y^2)");
    check("(3 (2 + cos(x))^2 y^2)^(1/2)", "(2 + cos(x)) sqrt(3 y^2)");
    check("sqrt(x/y^2)", "sqrt(x/y^2)");
    check("sqrt(y^2)", "sqrt(y^2)");
}

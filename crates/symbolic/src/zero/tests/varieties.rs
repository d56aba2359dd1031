//! Identities modulo constraints.

use super::*;
use crate::node::Symbol;

fn decide_on(g: &Graph, residual: &str, constraints: &[(&str, &str)]) -> Verdict {
    let residuals = [parse(g, residual)];
    let implicit: Vec<(Expr, Symbol)> = constraints
        .iter()
        .map(|(f, symbol)| (parse(g, f), g.as_symbol(parse(g, symbol)).unwrap()))
        .collect();
    let assumptions = Assumptions::new();
    decide_zero(
        g,
        &ZeroTest {
            implicit: &implicit,
            ..ZeroTest::everywhere(&residuals, &assumptions)
        },
    )
}

#[test]
fn quadratic_constraint() {
    let g = Graph::new();
    let circle = [("x'^2 + y'^2 - c^2", "y'")];
    assert_eq!(decide_on(&g, "x'^2 + y'^2 - c^2", &circle).word(), "proved");
    assert_eq!(
        decide_on(&g, "x'^4 - (c^2 - y'^2)^2", &circle).word(),
        "proved"
    );
    assert_eq!(
        decide_on(&g, "1/(c - x') - (c + x')/y'^2", &circle).word(),
        "proved"
    );
    let verdict = decide_on(&g, "x' - c", &circle);
    assert_eq!(verdict.word(), "refuted");
    assert_eq!(decide_on(&g, "x'^2 - y'^2", &circle).word(), "refuted");
}

/// Both roots contain both dependent velocities: in x + y and z + w instead of x and z the constraints are solved by hand.
#[test]
fn roots_that_are_not_triangular() {
    let g = Graph::new();
    let roots = [
        ("y' - sqrt((x' + y')^2 + 2*(z' + w')^2 + 1)", "y'"),
        ("w' - 2*sqrt((x' + y')^2 + (2 + sin(q))*(z' + w')^2)", "w'"),
    ];
    let square = "y'^2 - (x' + y')^2 - 2*(z' + w')^2 - 1";
    assert_eq!(decide_on(&g, square, &roots).word(), "proved");
    let quotient = "(x' + y')/sqrt((x' + y')^2 + (2 + sin(q))*(z' + w')^2) - 2*(x' + y')/w'";
    assert_eq!(decide_on(&g, quotient, &roots).word(), "proved");
    // Along the constraints, not beside them; and the other sign of the root is not on them.
    assert_ne!(decide_on(&g, "y' - w'", &roots).word(), "proved");
    let other = "y' + sqrt((x' + y')^2 + 2*(z' + w')^2 + 1)";
    assert_ne!(decide_on(&g, other, &roots).word(), "proved");
}

/// One root contains all velocities; in x' + y' instead of x' the constraint is solved by hand.
#[test]
fn a_root_of_every_velocity() {
    let g = Graph::new();
    let root = [("2*x' - 3*sqrt((x' + y')^2 + 1)", "x'")];
    let square = "4*x'^2/9 - (x' + y')^2 - 1";
    assert_eq!(decide_on(&g, square, &root).word(), "proved");
    // The same root with its radicand written out.
    let written = "sqrt(x'^2 + 2*x'*y' + y'^2 + 1) - 2*x'/3";
    assert_eq!(decide_on(&g, written, &root).word(), "proved");
}

/// Real solutions in y' lie above x' > 4000 only.
#[test]
fn counterexamples_far_away_are_found() {
    let g = Graph::new();
    let root = [("x' - 4000*sqrt(1 + y'^2)", "y'")];
    assert_eq!(decide_on(&g, "y'^2 - x'", &root).word(), "refuted");
}

#[test]
fn a_constraint_without_rational_points() {
    // x'² + y'² = 3 has no rational point; the counterexample has x' rational and y' enclosed.
    let g = Graph::new();
    let circle = [("x'^2 + y'^2 - 3", "y'")];
    assert_eq!(
        decide_on(&g, "(x' + y')*(x' - y') - 2*x'^2 + 3", &circle).word(),
        "proved"
    );
    let Verdict::Refuted(counterexample) = decide_on(&g, "y' - x'", &circle) else {
        panic!()
    };
    let names: Vec<&str> = counterexample
        .point
        .iter()
        .map(|value| value.name.as_str())
        .collect();
    assert_eq!(names, ["x'", "y'"]);
    assert!(counterexample.point[0].exact.is_some());
    assert!(counterexample.point[1].exact.is_none() && counterexample.point[1].enclosure.is_some());
}

#[test]
fn appell_hamel_for_either_symbol() {
    let g = Graph::new();
    for symbol in ["z'", "x'"] {
        let f = [("z' - a*sqrt(x'^2 + y'^2)", symbol)];
        assert_eq!(
            decide_on(&g, "z'^2 - a^2*(x'^2 + y'^2)", &f).word(),
            "proved",
            "{symbol}"
        );
        assert_eq!(
            decide_on(&g, "x'/sqrt(x'^2 + y'^2) - a*x'/z'", &f).word(),
            "proved",
            "{symbol}"
        );
        // The other sign of the root is not on the constraint.
        assert_eq!(
            decide_on(&g, "z' + a*sqrt(x'^2 + y'^2)", &f).word(),
            "refuted",
            "{symbol}"
        );
        assert_eq!(
            decide_on(&g, "z'^2 - a*(x'^2 + y'^2)", &f).word(),
            "refuted",
            "{symbol}"
        );
    }
}

#[test]
fn the_implicit_cubic() {
    // T1 §9.6: f = z'^3 + z' − x'y', f_d = 3z'² + 1; φ_xy = (1 − 6z' φ_x φ_y)/f_d against d/dx' of φ_y = x'/f_d.
    let g = Graph::new();
    let f = [("z'^3 + z' - x'*y'", "z'")];
    let phi_xy = "(1 - 6*z'*(y'/(3*z'^2+1))*(x'/(3*z'^2+1)))/(3*z'^2+1)";
    let direct = "1/(3*z'^2+1) - x'*6*z'*(y'/(3*z'^2+1))/(3*z'^2+1)^2";
    assert_eq!(
        decide_on(&g, &format!("{phi_xy} - ({direct})"), &f).word(),
        "proved"
    );
    assert_eq!(
        decide_on(&g, "z'^5 - (x'*y' - z')*z'^2", &f).word(),
        "proved"
    );
    assert_eq!(
        decide_on(&g, "z'^5 - (x'*y' + z')*z'^2", &f).word(),
        "refuted"
    );
}

#[test]
fn an_identity_on_one_branch_only() {
    // x'² = y'² is x' = y' or x' = −y'.
    let g = Graph::new();
    let f = [("x'^2 - y'^2", "x'")];
    assert_eq!(decide_on(&g, "x'^2 - y'^2", &f).word(), "proved");
    let verdict = decide_on(&g, "x' - y'", &f);
    assert!(
        matches!(verdict, Verdict::Refuted(_) | Verdict::Conditional { .. }),
        "{verdict:?}"
    );
    // A denominator that vanishes on one branch leaves the other.
    assert_eq!(decide_on(&g, "(x' + y')/(x' - y')", &f).word(), "proved");
    let verdict = decide_on(&g, "x'*(x' - y')/(x' - y') - y'", &f);
    assert!(
        matches!(verdict, Verdict::Refuted(_) | Verdict::Conditional { .. }),
        "{verdict:?}"
    );
}

#[test]
fn several_constraints_one_after_another() {
    let g = Graph::new();
    let f = [("y'^2 - x'^2 - 1", "y'"), ("z'^2 - y' - x'", "z'")];
    assert_eq!(
        decide_on(&g, "(z'^2 - x')^2 - x'^2 - 1", &f).word(),
        "proved"
    );
    assert_eq!(decide_on(&g, "z'^2*(y' - x') - 1", &f).word(), "proved");
    assert_eq!(decide_on(&g, "z'^2*(y' + x') - 1", &f).word(), "refuted");
    let linear_first = [("x'^2 - y^2*z'^2", "x'"), ("z' - 1", "z'")];
    assert_eq!(decide_on(&g, "x'^2 - y^2", &linear_first).word(), "proved");
    let mixed = [("x' + z' - y", "x'"), ("x'^2 + z'^2 - 1", "z'")];
    assert_eq!(decide_on(&g, "2*x'*z' - y^2 + 1", &mixed).word(), "proved");
    assert_eq!(decide_on(&g, "2*x'*z' - y^2", &mixed).word(), "refuted");
    let tangled = [("y' - z'^2", "y'"), ("z'^3 - y' - x'", "z'")];
    let verdict = decide_on(&g, "y' - z'^2", &tangled);
    assert!(!matches!(verdict, Verdict::Refuted(_)), "{verdict:?}");
}

#[test]
fn a_square_as_constraint() {
    let g = Graph::new();
    let f = [("(z' - y*x')^2", "z'")];
    assert_eq!(decide_on(&g, "z' - y*x'", &f).word(), "proved");
}

#[test]
fn solved_symbols_are_replaced_in_order() {
    let g = Graph::new();
    let symbol = |name: &str| g.as_symbol(parse(&g, name)).unwrap();
    let solved = [
        (symbol("y'"), parse(&g, "tan(phi)*x'")),
        (symbol("z'"), parse(&g, "x'*y' + y'")),
    ];
    let residuals = [parse(&g, "z'*cos(phi)^2 - x'*sin(phi)*cos(phi)*(x' + 1)")];
    let assumptions = Assumptions::new();
    let test = ZeroTest {
        solved: &solved,
        ..ZeroTest::everywhere(&residuals, &assumptions)
    };
    assert_eq!(decide_zero(&g, &test).word(), "proved");
    let circular = [
        (symbol("y'"), parse(&g, "z'")),
        (symbol("z'"), parse(&g, "y'")),
    ];
    let test = ZeroTest {
        solved: &circular,
        ..test
    };
    assert_eq!(decide_zero(&g, &test).word(), "undecided");
}

#[test]
fn counterexamples_on_bounded_varieties_are_found() {
    let g = Graph::new();
    let sphere = [("x'^2 + y'^2 + z'^2 - 1", "x'")];
    assert_eq!(decide_on(&g, "z'", &sphere).word(), "refuted");
    assert_eq!(decide_on(&g, "z'*y'", &sphere).word(), "refuted");
    let quartic = [("x'^4 + y'^4 + z'^4 - 1", "z'")];
    assert_eq!(decide_on(&g, "x'*y'", &quartic).word(), "refuted");
    assert_eq!(decide_on(&g, "z' - 1", &quartic).word(), "refuted");
    let small = [("x'^2 + y'^2 + z'^2 - 1/100", "z'")];
    assert_eq!(decide_on(&g, "x' - 2*y'", &small).word(), "refuted");
}

/// Three cranks of length 1, the second and third pivots at (1, 0) and (2, 0), on a bar of length 2: the bar stays parallel, so that the last
/// constraint follows from the others. No order solves them one after the other, and angles are dependent.
#[test]
fn three_cranks_on_one_bar() {
    let g = Graph::new();
    let cranks = [
        ("x - cos(a)", "x"),
        ("y - sin(a)", "y"),
        ("x + cos(phi) - 1 - cos(b)", "b"),
        ("x + 2*cos(phi) - 2 - cos(c)", "c"),
        ("y + 2*sin(phi) - sin(c)", "phi"),
        // Holds besides: it contains b, whose cosine alone the others determine.
        ("y + sin(phi) - sin(b)", "b"),
    ];
    for residual in ["sin(phi)", "cos(phi) - 1", "cos(b) - x", "sin(c) - y"] {
        let verdict = decide_on(&g, residual, &cranks);
        assert_eq!(verdict.word(), "proved", "{residual}: {verdict:?}");
    }
    for residual in ["x - y", "sin(b) + sin(c)", "sin(a) - 1"] {
        let verdict = decide_on(&g, residual, &cranks);
        assert_ne!(verdict.word(), "proved", "{residual}");
    }
    // Where the bar may turn, three constraints fewer, nothing of the kind is true.
    assert_ne!(decide_on(&g, "sin(phi)", &cranks[..3]).word(), "proved");
}

/// A four-bar linkage in dependent angles: what its closure determines, and Freudenstein's equation between the two cranks.
#[test]
fn a_linkage_is_solved_for_its_angles() {
    let g = Graph::new();
    let closure = [
        ("a*cos(u) + b*cos(v) - c*cos(w) - d", "v"),
        ("a*sin(u) + b*sin(v) - c*sin(w)", "w"),
    ];
    let freudenstein = "2*a*d*cos(u) - 2*c*d*cos(w) + 2*a*c*cos(u - w) + b^2 - a^2 - c^2 - d^2";
    let verdict = decide_on(&g, freudenstein, &closure);
    assert_eq!(verdict.word(), "proved", "{verdict:?}");
    let wrong = "2*a*d*cos(u) - 2*c*d*cos(w) + 2*a*c*cos(u + w) + b^2 - a^2 - c^2 - d^2";
    assert_ne!(decide_on(&g, wrong, &closure).word(), "proved");
}

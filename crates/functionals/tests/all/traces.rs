//! What is imposed inside binds the variations on the boundary together or leaves them arbitrary there: on paper, by the solutions of what is imposed.

use crate::table::{decided, studied_text};
use chetaev_functionals::Study;

/// On 0 < x < 2, with `imposed` inside, an equation `inside` that is stated there, and p, q, … on the ends.
fn on_line(
    density: &str,
    imposed: &str,
    inside: &str,
    ends: [&str; 2],
    stated: [&str; 2],
) -> Study {
    let mut labels = vec!["\"i\""];
    let mut equations = format!("b = \"{imposed}\"\ni = \"{inside}\"\n");
    for (label, place, equation) in [("l", "x = 0", stated[0]), ("r", "x = 2", stated[1])] {
        for (k, equation) in equation.split(';').filter(|e| !e.is_empty()).enumerate() {
            equations.push_str(&format!(
                "{label}{k} = {{ equation = \"{equation}\", on = \"{place}\" }}\n"
            ));
            labels.push(match (label, k) {
                ("l", 0) => "\"l0\"",
                ("l", _) => "\"l1\"",
                (_, 0) => "\"r0\"",
                _ => "\"r1\"",
            });
        }
    }
    let text = format!(
        r#"
kind = "functional"
name = "line"
density = "{density}"
imposed = ["b"]
yields = [{}]
[domain]
coordinates = ["x"]
intervals = {{ x = [0, 2] }}
[fields]
u = "scalar"
[data]
f = "scalar"
p = {{ kind = "scalar", on = "x = 0" }}
a = {{ kind = "scalar", on = "x = 0" }}
q = {{ kind = "scalar", on = "x = 2" }}
b = {{ kind = "scalar", on = "x = 2" }}
[boundary]
"x = 0" = {}
"x = 2" = {}
[equations]
{equations}"#,
        labels.join(", "),
        ends[0],
        ends[1]
    );
    studied_text("p4p", &text, &[])
}

/// By hand: δu = c where u' = 0 is imposed, δu = c₀ + c₁ x where u'' is, and so on; the values at the ends are as many as there are, or fewer.
#[test]
fn solutions_that_are_polynomials_decide_on_a_line() {
    const P: &str = "\"-p u\"";
    const Q: &str = "\"-q u\"";
    const HELD: &str = "{ fixed = [\"u\"] }";
    let none = "\"0\"";
    for (density, imposed, inside, ends, stated, word) in [
        // p + q = 0 alone.
        (
            "0 u",
            "u,x = 0",
            "u,xx = 0",
            [P, Q],
            ["p = 0", "q = 0"],
            "undecided",
        ),
        (
            "0 u",
            "u,x = f",
            "u,xx = f,x",
            [P, Q],
            ["p = 0", "q = 0"],
            "undecided",
        ),
        // δu = 0: nothing follows for q.
        (
            "0 u",
            "u,x = 0",
            "u,xx = 0",
            [HELD, Q],
            ["", "q = 0"],
            "undecided",
        ),
        // The load at one end only.
        (
            "0 u",
            "u,x = 0",
            "u,xx = 0",
            [P, none],
            ["p = 0", ""],
            "proved",
        ),
        // Every constant is stationary, as δu is the same at both ends.
        (
            "0 u",
            "u,x = 0",
            "u,xx = 0",
            ["\"-u\"", "\"u\""],
            ["", ""],
            "undecided",
        ),
        // What is stated inside and does not hold is refuted whatever is at the ends.
        (
            "0 u",
            "u,x = 0",
            "u = 0",
            [P, Q],
            ["p = 0", "q = 0"],
            "refuted",
        ),
        (
            "0 u",
            "u,xx = 0",
            "u,xxx = 0",
            [P, Q],
            ["p = 0", "q = 0"],
            "proved",
        ),
        (
            "0 u",
            "u,xx = 0",
            "u,xxx = 0",
            [P, Q],
            ["p = 0", "q = u"],
            "refuted",
        ),
        (
            "1/2 u,x^2 + f u",
            "u,xx = f",
            "u,xxx = f,x",
            [none, none],
            ["u,x = 0", "u,x = 0"],
            "proved",
        ),
        // δu' is the same at both ends.
        (
            "0 u",
            "u,xx = 0",
            "u,xxx = 0",
            ["\"-p u,x\"", "\"-q u,x\""],
            ["p = 0", "q = 0"],
            "undecided",
        ),
        // Four values at the ends of cubics; five conditions of three constants.
        (
            "0 u",
            "u,xxxx = 0",
            "u,xxxxx = 0",
            ["\"-p u - a u,x\"", "\"-q u - b u,x\""],
            ["p = 0;a = 0", "q = 0;b = 0"],
            "proved",
        ),
        (
            "0 u",
            "u,xxx = 0",
            "u,xxxx = 0",
            ["\"-p u - a u,x\"", "\"-q u - b u,x\""],
            ["p = 0;a = 0", "q = 0;b = 0"],
            "undecided",
        ),
        // With k = π²/4 an eigenvalue: δu = sin(π x/2) and cos(π x/2), so that δu(0) = −δu(2); with k = 1 it is none.
        (
            "1/2 u,x^2 - 1/8 pi^2 u^2",
            "u,xx + 1/4 pi^2 u = 0",
            "u,xxx + 1/4 pi^2 u,x = 0",
            [P, Q],
            ["-u,x = p", "u,x = q"],
            "undecided",
        ),
    ] {
        let study = on_line(density, imposed, inside, ends, stated);
        let verdict = decided(&study, "functional.euler");
        let said = verdict.detail();
        assert_eq!(
            verdict.word(),
            word,
            "{density}, {imposed}, {ends:?}: {said}"
        );
        if word == "undecided" {
            assert!(said.contains("only taken together"), "{said}");
        }
        assert!(word != "proved" || !said.contains("Dirichlet"), "{said}");
    }
}

/// In the unit square, with an energy whose Euler equation is what is imposed, free on all faces.
fn on_square(density: &str, imposed: &str, slopes: [&str; 2]) -> (String, String) {
    let [x, y] = slopes;
    let text = format!(
        r#"
kind = "functional"
name = "square"
density = "{density}"
imposed = ["b"]
yields = ["l", "r", "d", "t"]
[domain]
coordinates = ["x", "y"]
intervals = {{ x = [0, 1], y = [0, 1] }}
[fields]
u = "scalar"
[boundary]
"x = 0" = "0"
"x = 1" = "0"
"y = 0" = "0"
"y = 1" = "0"
[equations]
b = "{imposed}"
l = {{ equation = "{x}", on = "x = 0" }}
r = {{ equation = "{x}", on = "x = 1" }}
d = {{ equation = "{y}", on = "y = 0" }}
t = {{ equation = "{y}", on = "y = 1" }}
"#
    );
    let study = studied_text("p4p", &text, &[]);
    let verdict = decided(&study, "functional.euler");
    (verdict.word().to_owned(), verdict.detail().to_owned())
}

/// Harmonic functions have any values on the boundary, and solutions of the wave equation have not: of u = a(x + y) + b(x − y) the values at the
/// corners add up, u(0,0) + u(1,1) = u(1,0) + u(0,1) where it is u,xx = u,yy (d'Alembert 1747).
#[test]
fn only_an_elliptic_equation_leaves_values_arbitrary() {
    let (word, said) = on_square(
        "1/2 u,x^2 + 1/2 u,y^2",
        "u,xx + u,yy = 0",
        ["u,x = 0", "u,y = 0"],
    );
    assert_eq!(word, "proved", "{said}");
    assert!(!said.contains("Dirichlet"), "{said}");
    for (density, imposed, slopes) in [
        (
            "1/2 u,x^2 - 1/2 u,y^2",
            "u,xx = u,yy",
            ["u,x = 0", "u,y = 0"],
        ),
        ("1/2 u,x^2", "u,xx = 0", ["u,x = 0", "u = u"]),
        ("1/2 u,x u,y", "u,xy = 0", ["u,y = 0", "u,x = 0"]),
        // Helmholtz's equation may have an eigenvalue here.
        (
            "1/2 u,x^2 + 1/2 u,y^2 - pi^2 u^2",
            "u,xx + u,yy + 2 pi^2 u = 0",
            ["u,x = 0", "u,y = 0"],
        ),
        // The same fields, by an equation that is not linear; u = sin πx sin πy is stationary, and its slopes do not vanish.
        (
            "1/2 u,x^2 + 1/2 u,y^2 - pi^2 u^2",
            "(1 + u^2) (u,xx + u,yy + 2 pi^2 u) = 0",
            ["u,x = 0", "u,y = 0"],
        ),
        // About u = x y the equation of Monge and Ampère is that of waves.
        (
            "1/2 u,x^2 + 1/2 u,y^2",
            "u,xx u,yy - u,xy^2 = -1",
            ["u,x = 0", "u,y = 0"],
        ),
        // Of one type on one side of x = 0 and of another on the other (Tricomi 1923).
        (
            "1/2 u,x^2 + 1/2 u,y^2",
            "u,xx + x u,yy = 0",
            ["u,x = 0", "u,y = 0"],
        ),
        (
            "1/2 u,x^2 + 1/2 u,y^2",
            "2 u,xx + 5 u,xy + 2 u,yy = 0",
            ["u,x = 0", "u,y = 0"],
        ),
    ] {
        let (word, said) = on_square(density, imposed, slopes);
        assert_eq!(word, "undecided", "{imposed}: {said}");
    }
}

/// The system of Bitsadze (1948) is elliptic, and of −u₁ + i u₂ = f(z) + z̄ h(z) the values on a circle are bound to each other: no condition on
/// them is proved but where the model states that the problem is solvable.
#[test]
fn an_elliptic_system_need_not_be_solvable() {
    let text = |solvable: &str| {
        format!(
            r#"
kind = "functional"
name = "bitsadze"
density = "0"
yields = ["r"]
imposed = ["c"]
{solvable}
[sizes]
d = 2
[domain]
coordinates = "x_i"
boundary = ["S"]
[fields]
u = "vector"
[data]
g = {{ kind = "vector", on = "S" }}
[boundary]
S = "g_k u_k"
[equations]
c = "u_i,jj - 2 u_j,ij = 0"
r = {{ equation = "g_k = 0", on = "S" }}
"#
        )
    };
    let said = |solvable: &str| {
        let study = studied_text("p4p", &text(solvable), &[]);
        let verdict = decided(&study, "functional.euler");
        (verdict.word().to_owned(), verdict.detail().to_owned())
    };
    let (word, why) = said("");
    assert_eq!(word, "undecided", "{why}");
    assert!(why.contains("solvable = [\"c\"]"), "{why}");
    let (word, why) = said("solvable = [\"c\"]");
    assert_eq!(word, "proved", "{why}");
    assert!(why.contains("as the model states"), "{why}");
}

/// Every constant is stationary where −u on one end and u on the other are all there is.
#[test]
fn fields_are_not_refuted_by_conditions_that_hold_together() {
    let text = r#"
kind = "functional"
name = "pair"
density = "0 u"
imposed = ["b"]
[domain]
coordinates = ["x"]
intervals = { x = [0, 1] }
[fields]
u = "scalar"
[boundary]
"x = 0" = "-u"
"x = 1" = "u"
[equations]
b = "u,x = 0"
[solutions.a.fields]
u = "1"
"#;
    let study = studied_text("p4p", text, &[]);
    let verdict = decided(&study, "functional.solution");
    assert_eq!(verdict.word(), "undecided", "{}", verdict.detail());
}

//! Lines of displayed equations: nothing is lost where they are broken, and no line is too wide.

use super::super::{Document, Options};
use crate::graph::Graph;
use crate::node::Expr;

/// The display, and the same without breaks, spaces, dots and the sizes of parentheses.
fn displayed(g: &Graph, left: Expr, right: Expr) -> (String, String) {
    let document = Document::equations(g, &[(left, right)], &Options::default());
    let display = document.latex_display();
    let mut bare = display.clone();
    for mark in [
        "\\begin{align}",
        "\\end{align}",
        "\\begin{equation}",
        "\\end{equation}",
        "\\notag",
        "\\\\\n",
        "\\qquad",
        "\\quad",
        "\\cdot",
        "\\Bigl",
        "\\Bigr",
        "\\left",
        "\\right",
        "&",
        " ",
        "\n",
    ] {
        bare = bare.replace(mark, "");
    }
    (display, bare)
}

fn sum(g: &Graph, terms: u32) -> Expr {
    let terms: Vec<Expr> = (1..=terms)
        .map(|k| {
            g.mul(&[
                g.integer(i64::from(k)),
                g.symbol(&format!("a_{k}"), 0),
                g.symbol("x", 2),
            ])
        })
        .collect();
    g.add(&terms)
}

#[test]
fn short_equations_stay_on_their_line() {
    let g = Graph::new();
    let (display, _) = displayed(&g, g.symbol("x", 2), g.symbol("F", 0));
    assert_eq!(
        display,
        "\\begin{equation}\n\\ddot{x} = F\n\\end{equation}\n"
    );
}

#[test]
fn long_sums_are_broken_before_their_signs() {
    let g = Graph::new();
    let (display, bare) = displayed(&g, g.symbol("y", 1), sum(&g, 60));
    let lines: Vec<&str> = display
        .lines()
        .filter(|line| line.contains("\\ddot"))
        .collect();
    assert!(lines.len() > 4, "{display}");
    assert!(lines[0].starts_with("\\dot{y} &= "), "{display}");
    assert!(
        lines[1..]
            .iter()
            .all(|line| line.starts_with("&\\qquad  + ")),
        "{display}"
    );
    assert!(
        lines.iter().all(|line| line.matches(" + ").count() < 20),
        "{display}"
    );
    // One number for one equation, and every term is there, once.
    assert_eq!(display.matches("\\notag").count(), lines.len() - 1);
    for k in 1..=60 {
        let index = if k < 10 {
            k.to_string()
        } else {
            format!("{{{k}}}")
        };
        assert_eq!(
            bare.matches(&format!("a_{index}\\ddot{{x}}")).count(),
            1,
            "{k}: {bare}"
        );
    }
}

#[test]
fn wide_fractions_and_products_are_broken_inside() {
    let g = Graph::new();
    let quotient = g.div(sum(&g, 40), g.symbol("M", 0));
    let product = g.mul(&[
        quotient,
        g.add(&[g.one(), g.pow(sum(&g, 30), g.integer(3))]),
    ]);
    let (display, bare) = displayed(&g, sum(&g, 50), product);
    assert!(bare.contains("\\frac{1}{M}("), "{bare}");
    let widest = display
        .lines()
        .map(|line| line.matches("\\ddot").count())
        .max();
    assert!(
        widest.is_some_and(|count| (3..20).contains(&count)),
        "{display}"
    );
    // Parentheses close what they open, and the equation has one number.
    assert_eq!(bare.matches('(').count(), bare.matches(')').count());
    assert_eq!(bare.matches("\\ddot{x}").count(), 50 + 30 + 40, "{bare}");
    assert_eq!(
        display.matches("\\\\\n").count(),
        display.matches("\\notag").count()
    );
}

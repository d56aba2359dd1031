//! Darboux polynomials of the literature.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

mod common;

use chetaev_integrals::darboux::{pairs, Darboux, Work};
use chetaev_symbolic::Graph;
use common::flow;

fn show(rates: &[(&str, &str)], degree: u32) {
    let g = Graph::new();
    let flow = flow(&g, rates);
    let start = std::time::Instant::now();
    let found = pairs(
        &flow,
        Work {
            degree,
            ..Work::default()
        },
        7,
    );
    println!("--- {rates:?} open {} {:?}", found.open, start.elapsed());
    for own in &found.found {
        match own {
            Darboux::One(e) => println!("   {}", g.text(*e)),
            Darboux::Conjugate {
                first,
                second,
                square,
            } => println!(
                "   ({}) +- sqrt({}) ({})",
                g.text(*first),
                g.text(*square),
                g.text(*second)
            ),
        }
    }
    for f in &found.families {
        println!(
            "   {} {} {:?}",
            f.degree,
            f.exhausted,
            f.letters.iter().map(|&e| g.text(e)).collect::<Vec<_>>()
        );
    }
}

#[test]
fn look() {
    show(
        &[
            ("u", "u - v - u (u^2 + v^2)"),
            ("v", "u + v - v (u^2 + v^2)"),
        ],
        4,
    );
    show(&[("x", "a x - b x y"), ("y", "c x y - d y")], 3);
    show(
        &[
            ("u", "u (1 - u^2 - w^2) - w"),
            ("w", "w (1 - u^2 - w^2) + u"),
            ("p", "w"),
            ("x", "u cos(p)"),
            ("y", "u sin(p)"),
        ],
        3,
    );
    show(&[("x", "y"), ("y", "a x + b y")], 3);
    show(
        &[
            ("w1", "(B - C) w2 w3/A"),
            ("w2", "(C - A) w3 w1/B"),
            ("w3", "(A-B) w1 w2/C"),
        ],
        2,
    );
    show(
        &[
            ("x", "x (1 + a y + b z)"),
            ("y", "y (1 + c x + d z)"),
            ("z", "z (1 + e x + f y)"),
        ],
        2,
    );
    show(
        &[
            ("x", "s (y - x)"),
            ("y", "r x - y - x z"),
            ("z", "x y - b z"),
        ],
        2,
    );
}

//! What is printed in index notation: no index stands more than twice in a term, and what is read again is the same expression.

use crate::table::{loaded_text, row_text, ROWS};
use chetaev_functionals::functional::Functional;
use chetaev_functionals::notation::equations::{euler, natural};
use chetaev_functionals::notation::{check, free_letters, parse, written, Index, Kind, Node};
use chetaev_functionals::variation::variation;
use chetaev_symbolic::print::Format;
use std::collections::BTreeMap;

/// How often each letter stands in the longest term: terms of a sum stand beside each other, factors and arguments together.
fn counts(node: &Node) -> BTreeMap<char, usize> {
    let mut found = BTreeMap::new();
    let mut add = |other: BTreeMap<char, usize>| {
        for (letter, count) in other {
            *found.entry(letter).or_insert(0) += count;
        }
    };
    let of = |indices: &[Index]| -> BTreeMap<char, usize> {
        let mut own = BTreeMap::new();
        for index in indices {
            if let Index::Letter(letter) = index {
                *own.entry(*letter).or_insert(0) += 1;
            }
        }
        own
    };
    match &node.kind {
        Kind::Number(_) => {}
        Kind::Atom(atom) => {
            add(of(&atom.indices));
            add(of(&atom.derivatives));
            if let Some(argument) = &atom.argument {
                // The slots of an argument stand once here and once more in each other place of theirs.
                add(counts(argument));
            }
        }
        Kind::Sum(terms) => {
            let mut most: BTreeMap<char, usize> = BTreeMap::new();
            for (_, term) in terms {
                for (letter, count) in counts(term) {
                    let own = most.entry(letter).or_insert(0);
                    *own = count.max(*own);
                }
            }
            add(most);
        }
        Kind::Product(factors) => factors.iter().for_each(|(_, own)| add(counts(own))),
        Kind::Power(base, exponent) => {
            add(counts(base));
            add(counts(exponent));
        }
        Kind::Apply(_, arguments) => arguments.iter().for_each(|own| add(counts(own))),
        Kind::Root(inner) => add(counts(inner)),
        Kind::Derivative(inner, by) => {
            add(counts(inner));
            add(of(by));
        }
    }
    found
}

/// Everything that is shown in index notation: densities, Euler equations, natural conditions.
fn shown(functional: &Functional) -> Vec<(String, Node)> {
    let mut found = vec![("density".to_owned(), functional.tree.clone())];
    let pieces = functional.pieces.iter();
    let densities = pieces.filter_map(|p| Some((p.name.clone(), p.tree.clone()?)));
    found.extend(densities);
    let variation = variation(functional).unwrap();
    let inside = euler(functional, &variation).into_iter().flatten();
    found.extend(inside.map(|own| (own.of, own.value)));
    for piece in &functional.pieces {
        let own = natural(functional, piece).unwrap_or_default();
        found.extend(own.into_iter().map(|own| (own.of, own.value)));
    }
    found
}

/// The texts of everything that is shown; each reads back as the same expression, and has no index more than twice.
fn texts(functional: &Functional) -> Vec<String> {
    let (scope, space) = (&functional.scope, &*functional.space);
    let mut found = Vec::new();
    for (of, node) in shown(functional) {
        let text = written(&node, scope, Format::Text);
        let mut problems = Vec::new();
        let again = parse(&text, scope, &mut problems);
        let again = again.unwrap_or_else(|| panic!("{of}: {text}: {problems:?}"));
        let letters = free_letters(&node);
        check(&again, &letters, scope, &mut problems);
        assert!(problems.is_empty(), "{of}: {text}: {problems:?}");
        let (a, b) = (
            scope.components(&node, &letters),
            scope.components(&again, &letters),
        );
        let differences: Vec<_> = a
            .iter()
            .zip(b)
            .map(|(&a, b)| space.graph.sub(a, b))
            .collect();
        assert!(space.vanish(&differences), "{of}: {text}");
        for (letter, count) in counts(&again) {
            assert!(count <= 2, "{of}: {letter} stands {count} times in {text}");
        }
        let in_math = written(&node, scope, Format::Mathml);
        assert!(in_math.contains("<math>"), "{in_math}");
        found.push(text);
    }
    found
}

#[test]
fn rows_of_the_table_are_printed_as_they_are_read() {
    for row in ROWS {
        for nonlinear in ["0", "1"] {
            let set = [("d", "2"), ("nonlinear", nonlinear)];
            let problem = loaded_text(row, &row_text(row), &set);
            assert!(!texts(&problem.functional).is_empty());
        }
    }
}

#[test]
fn classical_functionals_are_printed_as_they_are_read() {
    let folder = format!("{}/../../gallery/fields", env!("CARGO_MANIFEST_DIR"));
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path().join("model.toml");
        let Ok(text) = std::fs::read_to_string(path) else {
            continue;
        };
        count += texts(&loaded_text("p4p", &text, &[]).functional).len();
    }
    assert!(count > 30, "{count}");
}

fn of_density(density: &str, more: &str) -> Functional {
    let text = format!(
        r#"
kind = "functional"
name = "own"
density = "{density}"
[sizes]
d = 2
[domain]
coordinates = "x_i"
boundary = ["S"]
[fields]
u = "vector"
s = "symmetric"
[boundary]
S = "0"
{more}
"#
    );
    loaded_text("p4p", &text, &[]).functional
}

#[test]
fn letters_of_powers_and_of_arguments_are_their_own() {
    // The gradient of (u_k,i u_k,i)² is 4 (u_l,j u_l,j) u_k,i: with the letters of the density i and k would stand four times.
    let functions = "[functions]\nB = { of = \"symmetric\" }";
    for (density, more) in [
        ("(u_k,i u_k,i)^2", ""),
        ("(u_k,i u_k,i) (u_k,i u_k,i) s_ik s_ik", ""),
        ("(u_i u_i)^3 (u_k,i u_k,i)^2", ""),
        ("sqrt(1 + u_k,i u_k,i) u_i u_i", ""),
        ("exp(u_k,i u_k,i) (u_i,i)^2", ""),
        ("B(2 s_ij) s_ij s_ij", functions),
        ("s_ij B'_ij(s_ij/2 + u_i,j/4 + u_j,i/4)", functions),
        ("(u_i s_ij),j (u_i s_ij),j", ""),
    ] {
        let own = texts(&of_density(density, more));
        assert!(own.len() > 1, "{density}: {own:?}");
    }
}

#[test]
fn equations_of_many_fields_have_index_notation() {
    // Each field stands in one term of a long density: the others are none of its business.
    let count = 900;
    let names: Vec<String> = (0..count).map(|i| format!("f{i}")).collect();
    let each = |of: &dyn Fn(&String) -> String, between: &str| {
        let all: Vec<String> = names.iter().map(of).collect();
        all.join(between)
    };
    let text = format!(
        "kind = \"functional\"\nname = \"many\"\ndensity = \"{}\"\n[sizes]\nd = 2\n[domain]\ncoordinates = \"x_i\"\nboundary = [\"S\"]\n[fields]\n{}\n[boundary]\nS = \"0\"\n",
        each(&|f| format!("{f},i {f},i"), " + "),
        each(&|f| format!("{f} = \"scalar\""), "\n"),
    );
    let functional = loaded_text("p4p", &text, &[]).functional;
    let variation = variation(&functional).unwrap();
    let all = euler(&functional, &variation);
    assert!(all.iter().all(Option::is_some));
    let last = all.last().unwrap().as_ref().unwrap();
    let text = written(&last.value, &functional.scope, Format::Text);
    assert_eq!(text, "-(2 f899,i),i");
}

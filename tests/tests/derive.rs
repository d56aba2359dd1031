//! The equations that `derive` prints: every notation, and a text that reads back as the same expression.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev::model::{Loaded, ModelBuilder, Style};
use chetaev::symbolic::Expr;
use chetaev_tests::places::gallery;
use chetaev_tests::program::{run, text};
use chetaev_tests::studied::loaded;
use serde_json::Value;
use std::path::Path;

fn derived(model: &Path, notation: &str) -> String {
    let finished = run(&["derive", text(model), "--as", notation]);
    assert_eq!(
        finished.status,
        Some(0),
        "{}: {}",
        model.display(),
        finished.both()
    );
    finished.out
}

/// `{` and `}`, `(` and `)`, … in pairs.
fn balanced(content: &str) -> bool {
    let mut open = Vec::new();
    for letter in content.chars() {
        match letter {
            '(' | '[' | '{' => open.push(letter),
            ')' | ']' | '}' => {
                let partner = open.pop();
                if !matches!(
                    (partner, letter),
                    (Some('('), ')') | (Some('['), ']') | (Some('{'), '}')
                ) {
                    return false;
                }
            }
            _ => {}
        }
    }
    open.is_empty()
}

#[test]
fn every_notation_is_printed_for_every_model() {
    for model in gallery() {
        let name = model.display();
        let plain = derived(&model, "text");
        assert!(
            plain.contains(" = ") && plain.contains("''"),
            "{name}\n{plain}"
        );
        let latex = derived(&model, "latex");
        assert!(
            latex.contains("\\ddot") && balanced(&latex),
            "{name}\n{latex}"
        );
        let sympy = derived(&model, "sympy");
        assert!(sympy.contains("Eq(") && balanced(&sympy), "{name}\n{sympy}");
        let mathml = derived(&model, "mathml");
        assert!(
            mathml.contains("<math") && nested(&mathml),
            "{name}\n{mathml}"
        );
    }
}

/// Elements closed in the order opposite to that in which they were opened.
fn nested(markup: &str) -> bool {
    let mut open: Vec<&str> = Vec::new();
    for tag in markup
        .split('<')
        .skip(1)
        .filter_map(|t| t.split('>').next())
    {
        if tag.starts_with('!') || tag.ends_with('/') {
            continue;
        }
        let name = tag
            .trim_start_matches('/')
            .split_whitespace()
            .next()
            .unwrap_or("");
        match tag.starts_with('/') {
            false => open.push(name),
            true if open.pop() == Some(name) => {}
            true => return false,
        }
    }
    open.is_empty()
}

/// Sides of all equations in the JSON of a model.
fn sides(model: &Path) -> Vec<String> {
    let value: Value = serde_json::from_str(&derived(model, "json")).expect("JSON");
    let mut found = Vec::new();
    for formulation in value.as_array().expect("a list") {
        for group in formulation["groups"].as_array().expect("groups") {
            for equation in group["equations"].as_array().expect("equations") {
                found.extend(
                    ["left", "right"]
                        .iter()
                        .filter_map(|s| equation[s].as_str())
                        .map(str::to_owned),
                );
            }
        }
    }
    found
}

/// Parse(print(e)) = e, with what the program prints: reading a side and printing it gives the same handle when read again.
#[test]
fn printed_text_reads_back_as_the_same_expression() {
    let mut seen = 0;
    for path in gallery() {
        let Loaded {
            model: Some(model), ..
        } = loaded(&path, &[])
        else {
            panic!("{} is right", path.display());
        };
        for side in sides(&path) {
            // A solution of a linear system is printed with a list of what its names stand for, which is no expression.
            if side.contains("\nwhere\n") {
                continue;
            }
            let first = model
                .expression(&side)
                .unwrap_or_else(|d| panic!("{}: {}", path.display(), d.render(Style::Plain)));
            let again: Expr = model
                .expression(&model.graph.text(first))
                .unwrap_or_else(|d| panic!("{}", d.render(Style::Plain)));
            assert_eq!(first, again, "{}: {side}", path.display());
            // Names that are definitions are read as what they stand for, and print as that.
            if model.quasi_velocities.is_empty() && model.defines.is_empty() {
                assert_eq!(model.graph.text(first), side, "{}", path.display());
            }
            seen += 1;
        }
    }
    assert!(seen > 100, "{seen} sides were read");
}

/// The equations of the skate as anybody writes them down.
#[test]
fn the_skate_has_the_equations_of_the_books() {
    let skate = ModelBuilder::new("skate")
        .coordinates(["x", "y", "phi"])
        .parameter("m", "1")
        .parameter("J", "1")
        .lagrangian("1/2 m (x'^2 + y'^2) + 1/2 J phi'^2")
        .constraint("blade", "x' sin(phi) = y' cos(phi)");
    let folder = chetaev_tests::places::scratch("derive");
    let path = folder.join("skate.toml");
    std::fs::write(&path, skate.to_toml()).expect("a scratch file");
    let finished = run(&["derive", text(&path), "--formulation", "routh"]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    for equation in [
        "m x'' = lambda_blade sin(phi)",
        "m y'' = -lambda_blade cos(phi)",
        "J phi'' = 0",
    ] {
        assert!(
            finished.out.contains(equation),
            "{equation} is not in\n{}",
            finished.out
        );
    }
}

//! What the first page shows is what the program does.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::places::{root, scratch};
use chetaev_tests::program::{run, text};

/// The content of the first block of a language.
fn block<'a>(page: &'a str, language: &str) -> &'a str {
    let open = format!("```{language}\n");
    let (_, rest) = page.split_once(&open).expect("a block of the language");
    rest.split_once("```").expect("the block ends").0
}

/// The model of the README is read, and what is printed of it stands beside it, line for line.
#[test]
fn the_model_of_the_readme_gives_what_stands_beside_it() {
    let page = std::fs::read_to_string(root().join("README.md")).expect("a README");
    let folder = scratch("readme");
    let model = folder.join("model.toml");
    std::fs::write(&model, block(&page, "toml")).expect("a scratch file");
    let finished = run(&["study", text(&model), "--out", text(&folder.join("out"))]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let mut printed = finished.out.lines();
    for line in block(&page, "text").lines() {
        assert!(
            printed.any(|own| own == line),
            "`{line}` is not printed there\n{}",
            finished.out
        );
    }
}

/// Two commands set everything up: one runs the main job, one all tests.
#[test]
fn two_commands_are_enough() {
    let page = std::fs::read_to_string(root().join("README.md")).expect("a README");
    let (_, rest) = page.split_once("## Two commands\n").expect("the section");
    let section = rest.split("\n## ").next().expect("its text");
    let commands: Vec<&str> = section
        .lines()
        .filter_map(|line| line.strip_prefix("    "))
        .collect();
    assert_eq!(
        commands,
        [
            "cargo run --release -- study gallery/chaplygin-sleigh/model.toml",
            "cargo xtask test",
        ]
    );
}

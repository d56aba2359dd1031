//! The edges between crates are those of ARCHITECTURE.md, and no others: the manifests are read, not the intentions.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::places::root;
use std::collections::{BTreeMap, BTreeSet};

type Edges = BTreeMap<String, BTreeSet<String>>;

/// Packages that test the whole and may depend on anything.
const OUTSIDE: &[&str] = &["chetaev-tests", "xtask"];

/// The list under `## Allowed edges`.
fn allowed(text: &str) -> Edges {
    let (_, section) = text
        .split_once("## Allowed edges")
        .expect("ARCHITECTURE.md has a section on edges");
    let section = section.split("\n## ").next().unwrap_or(section);
    section
        .lines()
        .filter_map(|line| line.strip_prefix("- "))
        .map(|line| {
            let (from, to) = line.split_once("->").expect("`- crate -> crates`");
            let to = to.split(',').map(str::trim).filter(|c| !c.is_empty());
            (from.trim().to_string(), to.map(String::from).collect())
        })
        .collect()
}

/// Edges between workspace packages, as cargo sees them; development dependencies are left out because nothing ships with them.
fn present() -> Edges {
    let output = std::process::Command::new(env!("CARGO"))
        .args([
            "metadata",
            "--format-version",
            "1",
            "--no-deps",
            "--offline",
        ])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    let data: serde_json::Value =
        serde_json::from_slice(&output.stdout).expect("cargo metadata is JSON");
    let packages = data["packages"].as_array().expect("packages");
    let names: BTreeSet<&str> = packages.iter().filter_map(|p| p["name"].as_str()).collect();
    let edges_of = |package: &serde_json::Value| {
        let dependencies = package["dependencies"].as_array().expect("dependencies");
        dependencies
            .iter()
            .filter(|d| d["kind"] != "dev")
            .filter_map(|d| d["name"].as_str())
            .filter(|name| names.contains(name))
            .map(short)
            .collect::<BTreeSet<String>>()
    };
    packages
        .iter()
        .filter(|p| !OUTSIDE.iter().any(|&o| p["name"] == o))
        .map(|p| (short(p["name"].as_str().expect("a name")), edges_of(p)))
        .collect()
}

fn short(name: &str) -> String {
    name.strip_prefix("chetaev-").unwrap_or(name).to_string()
}

/// Edges of `present` that `allowed` lacks, as `from -> to`.
fn forbidden(present: &Edges, allowed: &Edges) -> Vec<String> {
    let mut found = Vec::new();
    for (from, to) in present {
        match allowed.get(from) {
            None => found.push(format!("{from} is not in the list")),
            Some(list) => found.extend(to.difference(list).map(|c| format!("{from} -> {c}"))),
        }
    }
    found
}

fn architecture() -> Edges {
    allowed(&std::fs::read_to_string(root().join("ARCHITECTURE.md")).expect("ARCHITECTURE.md"))
}

#[test]
fn every_edge_is_allowed() {
    assert_eq!(forbidden(&present(), &architecture()), Vec::<String>::new());
}

#[test]
fn the_list_names_existing_crates_and_edges_in_use() {
    let present = present();
    let unused: Vec<String> = architecture()
        .iter()
        .flat_map(|(from, to)| {
            let used = present.get(from).cloned();
            match used {
                None => vec![format!("{from} does not exist")],
                Some(used) => to
                    .difference(&used)
                    .map(|c| format!("{from} -> {c} is not used"))
                    .collect(),
            }
        })
        .collect();
    assert_eq!(unused, Vec::<String>::new());
}

#[test]
fn the_list_has_no_cycle() {
    let allowed = architecture();
    let mut done: BTreeSet<String> = BTreeSet::new();
    while done.len() < allowed.len() {
        let next: Vec<String> = allowed
            .iter()
            .filter(|(from, to)| !done.contains(*from) && to.is_subset(&done))
            .map(|(from, _)| from.clone())
            .collect();
        assert!(!next.is_empty(), "a cycle among the crates beside {done:?}");
        done.extend(next);
    }
}

#[test]
fn an_edge_upwards_is_found() {
    let mut present = present();
    present
        .entry("symbolic".into())
        .or_default()
        .insert("motion".into());
    present
        .entry("report".into())
        .or_default()
        .insert("mechanics".into());
    assert_eq!(
        forbidden(&present, &architecture()),
        ["report -> mechanics", "symbolic -> motion"]
    );
}

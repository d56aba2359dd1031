//! The edges between crates are those of ARCHITECTURE.md, and no others: the manifests are read, not the intentions. Nor does a
//! package have more than one program of integration tests, or a file of tests that none of them contains.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::places::{root, scratch};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

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

/// Names in a folder, in order.
fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.expect("the folder can be read").file_name())
        .map(|name| name.to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// What is wrong with a folder of integration tests. Each program links the whole workspace beneath it, so there is one; a file
/// that it does not name would pass without having run.
fn astray(folder: &Path) -> Vec<String> {
    let there = |name: &str| folder.join(name).display().to_string();
    let beside = names_in(folder).into_iter().filter(|name| name != "all");
    let mut wrong: Vec<String> = beside
        .map(|name| format!("{} is not in the folder `all`", there(&name)))
        .collect();
    let program = std::fs::read_to_string(folder.join("all/main.rs")).unwrap_or_default();
    for name in names_in(&folder.join("all")) {
        let module = name.strip_suffix(".rs").unwrap_or(&name);
        let declared = format!("mod {module};");
        if module != "main" && !program.lines().any(|line| line == declared) {
            wrong.push(format!("{} lacks `{declared}`", there("all/main.rs")));
        }
    }
    wrong
}

#[test]
fn a_package_has_one_program_of_integration_tests_with_all_files_in_it() {
    let crates = names_in(&root().join("crates"));
    let mut folders: Vec<PathBuf> = crates
        .iter()
        .map(|name| root().join("crates").join(name).join("tests"))
        .collect();
    folders.push(root().join("tests/tests"));
    folders.retain(|folder| folder.is_dir());
    assert!(folders.len() > 10, "{folders:?}");
    let wrong: Vec<String> = folders.iter().flat_map(|folder| astray(folder)).collect();
    assert_eq!(wrong, Vec::<String>::new());
}

#[test]
fn a_file_that_no_program_names_is_found() {
    let folder = scratch("layers-astray");
    std::fs::create_dir(folder.join("all")).expect("a folder");
    for (file, text) in [
        ("all/main.rs", "mod known;\n"),
        ("all/known.rs", ""),
        ("all/forgotten.rs", ""),
        ("beside.rs", ""),
    ] {
        std::fs::write(folder.join(file), text).expect("a file");
    }
    let wrong = astray(&folder).join("\n");
    assert_eq!(wrong.lines().count(), 2, "{wrong}");
    assert!(wrong.contains("beside.rs is not in"), "{wrong}");
    assert!(wrong.contains("lacks `mod forgotten;`"), "{wrong}");
}

//! Functionals over space as people see them: the summary, the report, and LaTeX.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::functional::PUT_IN;
use chetaev_tests::places::{root, scratch};
use chetaev_tests::program::{ok, run, text};
use serde_json::json;

/// Every functional of the gallery, by its path from the root.
fn functionals() -> Vec<String> {
    let mut found = Vec::new();
    for group in ["elasticity", "fields"] {
        let folder = root().join("gallery").join(group);
        for entry in std::fs::read_dir(folder).expect("a group") {
            let name = entry.expect("an entry").file_name();
            let path = format!("gallery/{group}/{}/model.toml", name.display());
            if root().join(&path).is_file() {
                found.push(path);
            }
        }
    }
    found.sort();
    assert!(found.len() >= 39, "{}", found.len());
    found
}

/// Longest line that a person reads without trouble.
const WIDEST: usize = 110;

#[test]
fn summaries_of_functionals_fit_a_terminal() {
    let folder = scratch("functional-summaries");
    for path in functionals() {
        let out = ok(&["study", &path, "--out", text(&folder)]).out;
        for line in out.lines().filter(|line| !line.starts_with("report: ")) {
            assert!(line.chars().count() <= WIDEST, "{path}: {line}");
            assert_eq!(line.trim_end(), line, "{path}");
        }
    }
}

/// Rows of LaTeX are whole: braces close, and what is to the left has its right.
#[test]
fn equations_of_functionals_are_a_document_of_latex() {
    for path in functionals() {
        let out = ok(&["derive", &path, "--as", "latex"]).out;
        assert!(out.starts_with("\\documentclass{article}"), "{path}");
        assert!(out.ends_with("\\end{document}\n"), "{path}");
        assert!(out.is_ascii(), "{path}: {out}");
        for name in ["align*", "document"] {
            let count = |what: &str| out.matches(&format!("\\{what}{{{name}}}")).count();
            assert_eq!(count("begin"), count("end"), "{path}");
        }
        for row in out.lines() {
            let count = |what: &str| row.matches(what).count();
            assert_eq!(count("{"), count("}"), "{path}: {row}");
            assert_eq!(count("\\left("), count("\\right)"), "{path}: {row}");
            assert!(!row.contains("mathrm{1,"), "{path}: {row}");
        }
    }
}

/// The text of a page, without tags, scripts and the model file.
fn shown(page: &str) -> String {
    let body = page.split_once("<h1>").expect("a heading").1;
    let body = body.split("<section id=\"model\"").next().expect("a page");
    let mut out = String::new();
    for part in body.split('<') {
        let (tag, words) = part.split_once('>').unwrap_or(("", part));
        // Commands for copying and places on the page are written as in the model.
        if !tag.starts_with("code") {
            out.push_str(words);
        }
    }
    out
}

#[test]
fn reports_of_functionals_are_typeset() {
    let folder = scratch("functional-report");
    let path = "gallery/elasticity/p2c1/model.toml";
    ok(&["study", path, "--set", "d=2", "--out", text(&folder)]);
    let page = std::fs::read_to_string(folder.join("report.html")).expect("a report");
    let words = shown(&page);
    for raw in ["S_u", "S_s", "u_k", "s_ij"] {
        let at = words.find(raw);
        let near = at.map(|at| words[at..].chars().take(60).collect::<String>());
        assert_eq!(near, None, "{raw}");
    }
    for said in [
        "The functional",
        "That of δs vanishes identically.",
        "Each level imposes",
        "Green's strain of the displacement",
    ] {
        let escaped = said.replace('\'', "&#39;");
        assert!(words.contains(said) || words.contains(&escaped), "{said}");
    }
    // Equations that have numbers of their own get no others.
    assert!(!page.contains("<span class=\"number\">"));
}

#[test]
fn ritz_has_a_table_and_a_picture() {
    let folder = scratch("functional-ritz");
    let path = "gallery/fields/simply-supported-plate/model.toml";
    ok(&["study", path, "--out", text(&folder)]);
    let page = std::fs::read_to_string(folder.join("report.html")).expect("a report");
    let words = shown(&page);
    // Navier's series for the middle (Timoshenko and Woinowsky-Krieger, § 30): 0.00406.
    assert!(words.contains("0.0040623") && words.contains("Relative error"));
    assert!(page.contains("<figure class=\"map\">") && page.contains("<p class=\"scale\">"));
    // What is exact at every degree has no picture of its errors.
    ok(&[
        "study",
        "gallery/fields/bar/model.toml",
        "--out",
        text(&folder),
    ]);
    let page = std::fs::read_to_string(folder.join("report.html")).expect("a report");
    assert!(!shown(&page).contains("Convergence of Ritz"));
}

/// In the row of level 2 with a splitting tensor the traction of the mixed stress on S_u is varied as a whole; which values it takes is decided by a
/// matrix of moduli, and the condition is said to hold where it takes all (T4 §4).
#[test]
fn a_condition_of_a_traction_says_where_it_holds() {
    let folder = scratch("functional-tractions");
    let path = "gallery/elasticity/p2p/model.toml";
    let claims = ["--claims", "functional.legendre"];
    let out = ok(&["study", path, claims[0], claims[1], "--out", text(&folder)]).out;
    assert!(out.contains("where δPm_k takes all values"), "{out}");
    let page = std::fs::read_to_string(folder.join("report.html")).expect("a report");
    assert!(shown(&page).contains("takes all values"));
}

/// The equation of u has no short form in index notation where its density is no polynomial in a component; that is said, and it stands in components.
#[test]
fn an_equation_without_indices_is_named() {
    let folder = scratch("functional-indices");
    let path = folder.join("mixed.toml");
    let model = "kind = \"functional\"\nname = \"mixed\"\ndensity = \"1/2 s_ij s_ij + s_ij u_i,j + sin(u_1) + 1/2 v_i v_i\"\n[sizes]\nd = 2\n[domain]\n\
                 coordinates = \"x_i\"\nboundary = [\"S\"]\n[fields]\ns = \"symmetric\"\nu = \"vector\"\nv = \"vector\"\n[boundary]\nS = { fixed = [\"u_1\"] }\n";
    std::fs::write(&path, model).expect("a model");
    let out = ok(&["study", text(&path), "--out", text(&folder)]).out;
    assert!(out.contains("δu in components only"), "{out}");
    assert!(out.contains("δv_k         v_k = 0"), "{out}");
    assert!(!out.contains("δs in components only"), "{out}");
    let page = std::fs::read_to_string(folder.join("report.html")).expect("a report");
    assert!(shown(&page).contains("no short form in index notation"));
}

/// v = u' is put in, so that 2 u'' = 0 and 2 u' = 0 are what is left: in the record, and in each notation of `derive`.
#[test]
fn what_is_put_in_is_recorded_and_derived() {
    let folder = scratch("functional-put-in");
    let path = folder.join("put-in.toml");
    std::fs::write(&path, PUT_IN).expect("a model");
    let record = ok(&["study", text(&path), "--out", text(&folder), "--json"]).json();
    let own = &record["functional"]["put_in"];
    assert_eq!(own["values"], json!([{"of": "v", "value": "u,x"}]));
    let zeros = |list: &str| -> Vec<String> {
        let all = own[list].as_array().expect("a list").iter();
        all.map(|e| format!("{} {} {}", e["on"], e["of"], e["zero"]))
            .collect()
    };
    assert_eq!(zeros("euler"), [r#"null "δu" "-2 u,xx""#]);
    assert_eq!(zeros("boundary"), [r#""x = 1" "δu" "2 u,x""#]);
    let recorded = folder.join("study.json");
    let replay = ok(&["verify", text(&recorded)]);
    assert!(!replay.both().contains("DISAGREES"), "{}", replay.both());
    let other = std::fs::read_to_string(&recorded).expect("a record");
    let changed = other.replace("\"value\": \"u,x\"", "\"value\": \"u,xx\"");
    assert_ne!(changed, other);
    std::fs::write(&recorded, changed).expect("a record");
    assert!(run(&["verify", text(&recorded)])
        .both()
        .contains("DISAGREES"));
    for (notation, wanted) in [
        ("text", "v - u,x = 0"),
        ("sympy", "u_x"),
        ("json", "-2 u,xx = 0"),
        ("latex", "Euler equations with that"),
    ] {
        let out = ok(&["derive", text(&path), "--as", notation]).out;
        assert!(out.contains("imposed, to be put in"), "{notation}: {out}");
        assert!(out.contains(wanted), "{notation}: {out}");
    }
    let none = ok(&["derive", "gallery/elasticity/p4p/model.toml"]).out;
    assert!(!none.contains("put in"), "{none}");
}

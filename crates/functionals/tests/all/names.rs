//! Names that mean something in every functional are refused with what they mean, at their place, and with nothing else.

use crate::table::read_text;
use chetaev_functionals::load;
use chetaev_model::{NoFiles, Style};

/// A functional in which a name is declared somewhere.
fn said(section: &str, entry: &str, more: &str) -> String {
    let text = format!(
        "kind = \"functional\"\nname = \"own\"\ndensity = \"u,i u,i{more}\"\n[sizes]\nd = 2\n[domain]\ncoordinates = \"x_i\"\ntime = \"t\"\nboundary = [\"S\"]\n[fields]\nu = \"scalar\"\n{}{section}\n{entry}\n[boundary]\nS = \"0\"\n",
        if section == "[fields]" { "# " } else { "" }
    );
    let loaded = read_text("p4p", &text, &[]);
    assert!(loaded.problem.is_none(), "{section} {entry}");
    loaded.diagnostics.render(Style::Plain)
}

#[test]
fn reserved_names_are_told_with_what_they_mean() {
    let meanings = [
        ("n", "the outward normal"),
        ("delta", "the unit tensor"),
        ("epsilon", "the permutation symbol"),
        ("curvature", "the curvature of the boundary"),
        ("pi", "the number π"),
        ("d", "the number of dimensions"),
        ("x", "the place"),
        ("x_1", "a coordinate"),
        ("t", "the time"),
        ("sin", "the function sin"),
        ("sqrt", "the square root"),
        ("sum", "the sign of a sum"),
    ];
    for (name, meaning) in meanings {
        for (section, value) in [
            ("[fields]", "\"vector\""),
            ("[data]", "\"scalar\""),
            ("[parameters]", "{}"),
            ("[functions]", "{ of = \"scalar\" }"),
            ("[define]", "\"u u\""),
        ] {
            let said = said(
                section,
                &format!("{name} = {value}"),
                &format!(" + {name} u"),
            );
            let wanted = format!("`{name}` is {meaning}; choose another name");
            assert!(said.contains(&wanted), "{section} {name}: {said}");
            // The line of the name, and no error that follows from it.
            assert!(said.contains(":13:1"), "{section} {name}: {said}");
            assert!(said.contains("\n1 error"), "{section} {name}: {said}");
        }
    }
}

#[test]
fn sizes_and_independent_variables_have_names_of_their_own() {
    let read = |coordinates: &str, time: &str, size: &str| {
        let text = format!(
            "kind = \"functional\"\nname = \"own\"\ndensity = \"u u\"\n[sizes]\n{size} = 2\n[domain]\ncoordinates = [{coordinates}]\n{time}\nboundary = [\"S\"]\n[fields]\nu = \"scalar\"\n[boundary]\nS = \"0\"\n"
        );
        let loaded = read_text("p4p", &text, &[]);
        (
            loaded.problem.is_some(),
            loaded.diagnostics.render(Style::Plain),
        )
    };
    assert!(read("\"x\", \"y\"", "time = \"t\"", "m").0);
    for (coordinates, time, size, name) in [
        ("\"n\", \"y\"", "", "m", "n"),
        ("\"x\", \"pi\"", "", "m", "pi"),
        ("\"x\", \"y\"", "time = \"delta\"", "m", "delta"),
        ("\"x\", \"y\"", "", "n", "n"),
    ] {
        let (is_read, said) = read(coordinates, time, size);
        assert!(
            !is_read && said.contains(&format!("`{name}` is the")),
            "{said}"
        );
    }
}

#[test]
fn a_name_is_declared_once_in_all_sections() {
    for (section, entry) in [
        ("[data]", "u = \"vector\""),
        ("[parameters]", "u = {}"),
        ("[functions]", "u = { of = \"scalar\" }"),
        ("[define]", "u = \"1\""),
    ] {
        let said = said(section, entry, "");
        assert!(said.contains("`u` is declared twice"), "{section}: {said}");
    }
    let said = said(
        "[functions]\nW = { of = \"scalar\" }\n[define]",
        "W = \"u u\"",
        "",
    );
    assert!(said.contains("`W` is declared twice"), "{said}");
}

#[test]
fn a_model_without_a_name_has_that_of_its_file() {
    let text = "kind = \"functional\"\ndensity = \"u,x^2\"\n[domain]\ncoordinates = [\"x\"]\nintervals = { x = [0, 1] }\n[fields]\nu = \"scalar\"\n\
                [boundary]\n\"x = 0\" = \"0\"\n\"x = 1\" = \"0\"\n";
    for (path, name) in [
        ("a/string.toml", "string"),
        ("membrane.toml", "membrane"),
        // A folder has the name where the file is the model of it.
        ("a/catenary/model.toml", "catenary"),
    ] {
        let loaded = load(path, text, &NoFiles, &[]);
        assert_eq!(loaded.problem.unwrap().functional.name, name);
    }
}

//! Functions of which half is known: through their conjugate, their gradient, special values, or by the file of another functional.

use crate::table::decided;
use chetaev_functionals::{load, study, Study};
use chetaev_model::{Files, Style};

/// The file of another functional.
struct Other(String);

impl Files for Other {
    fn read(&self, path: &str) -> Result<String, String> {
        if path.ends_with("other.toml") {
            Ok(self.0.clone())
        } else {
            Err(format!("there is no file {path}"))
        }
    }
}

const FRAME: &str = r#"kind = "functional"
name = "NAME"
[sizes]
d = 2
[domain]
coordinates = "x_i"
boundary = ["S"]
[fields]
u = "vector"
s = "symmetric"
[parameters]
k = {}
[define]
eps_ij = "1/2 (u_i,j + u_j,i)"
[boundary]
S = { fixed = ["u"] }
"#;

/// A functional in the plane with a density, functions and further sections.
fn text(name: &str, density: &str, functions: &str, further: &str) -> String {
    let frame = FRAME.replace("NAME", name);
    let density = format!("density = \"{density}\"\n[sizes]");
    let frame = frame.replace("[sizes]", &density);
    format!("{frame}[functions]\n{functions}\n{further}")
}

pub(crate) fn studied(text: &str, other: &str) -> Study {
    let loaded = load("own.toml", text, &Other(other.into()), &[]);
    let problem = loaded.problem;
    match problem {
        Some(problem) => study(problem, &|_| true, &|| 0.0),
        None => panic!("{}", loaded.diagnostics.render(Style::Plain)),
    }
}

fn said(study: &Study, claim: &str) -> String {
    let verdict = decided(study, claim);
    format!("{}: {}", verdict.word(), verdict.detail())
}

const ANY: &str = "A = { of = \"symmetric\" }";
const SQUARE: &str = "A = { of = \"symmetric\", value = \"1/2 X_ij X_ij\" }";
const TIMES_K: &str = "A = { of = \"symmetric\", value = \"k X_ij X_ij\" }";

fn becomes(at: &str) -> String {
    format!("[degenerations.it]\nbecomes = \"other.toml\"\nat = {{ {at} }}\n")
}

/// What another file says of A is nothing that this file says of its own.
#[test]
fn a_formula_in_another_file_is_not_one_here() {
    let stated = "[equations]\nm = \"eps_ij,i = 0\"\n";
    let own = |functions: &str, at: &str| {
        text(
            "own",
            "A(eps) + s_ij s_ij",
            functions,
            &format!("{stated}{}", becomes(at)),
        )
        .replace("[sizes]", "yields = [\"m\"]\n[sizes]")
    };
    let other = |functions: &str| text("other", "A(eps) + s_ij s_ij", functions, "");
    let is = |own: &str, other: &str, claim: &str, wanted: &str| {
        let found = said(&studied(own, other), claim);
        assert!(found.starts_with(wanted), "{claim}: {found}");
    };
    is(&own(ANY, ""), &other(SQUARE), "functional.euler", "refuted");
    is(
        &own(ANY, ""),
        &other(SQUARE),
        "functional.degeneration",
        "refuted",
    );
    // A is put in, or it is any function there.
    let put = "\"A(X)\" = \"1/2 X_ij X_ij\"";
    is(
        &own(ANY, put),
        &other(SQUARE),
        "functional.degeneration",
        "proved",
    );
    is(
        &own(SQUARE, ""),
        &other(ANY),
        "functional.degeneration",
        "proved",
    );
    is(
        &own(TIMES_K, "k = \"1/2\""),
        &other(ANY),
        "functional.degeneration",
        "proved",
    );
    is(
        &own(TIMES_K, "k = \"1/2\""),
        &other(SQUARE),
        "functional.degeneration",
        "proved",
    );
    is(
        &own(TIMES_K, "k = \"1\""),
        &other(SQUARE),
        "functional.degeneration",
        "refuted",
    );
    is(
        &own(SQUARE, put),
        &other(SQUARE),
        "functional.degeneration",
        "proved",
    );
    let twice = "\"A(X)\" = \"X_ij X_ij\"";
    is(
        &own(SQUARE, twice),
        &other(SQUARE),
        "functional.degeneration",
        "not-applicable",
    );
}

/// Special values reach the formulas of conjugates, and the conjugate of what is put in is no function of its own.
#[test]
fn special_values_reach_conjugates() {
    let pair = "W = { of = \"symmetric\", conjugate = \"V\" }\nV = { of = \"symmetric\", conjugate = \"W\" }";
    let explicit = "W = { of = \"symmetric\", conjugate = \"V\", value = \"k X_ij X_ij\" }\n\
                    V = { of = \"symmetric\", conjugate = \"W\", value = \"X_ij X_ij/(4 k)\" }";
    let computed = "W = { of = \"symmetric\", conjugate = \"V\", value = \"k X_ij X_ij\" }\n\
                    V = { of = \"symmetric\", conjugate = \"W\" }";
    let found = |functions: &str, at: &str, target: &str| {
        let own = text("own", "V(s) + u_i u_i", functions, &becomes(at));
        let other = text("other", target, "", "").replace("[functions]\n", "");
        said(&studied(&own, &other), "functional.degeneration")
    };
    let is = |found: String, wanted: &str| assert!(found.starts_with(wanted), "{found}");
    is(
        found(explicit, "k = \"1\"", "s_ij s_ij/4 + u_i u_i"),
        "proved",
    );
    is(
        found(computed, "k = \"1\"", "s_ij s_ij/4 + u_i u_i"),
        "proved",
    );
    is(
        found(computed, "k = \"1\"", "s_ij s_ij/3 + u_i u_i"),
        "refuted",
    );
    let half = "\"W(X)\" = \"1/2 X_ij X_ij\"";
    is(found(pair, half, "s_ij s_ij/2 + u_i u_i"), "proved");
    is(found(pair, half, "s_ij s_ij + u_i u_i"), "refuted");
    // Where the conjugate is not computed nothing is refuted.
    let quartic = "\"W(X)\" = \"1/4 (X_ij X_ij)^2\"";
    is(found(pair, quartic, "s_ij s_ij + u_i u_i"), "undecided");
    // What is put in for conjugates has to be such.
    let none = "\"W(X)\" = \"1/2 X_ij X_ij\", \"V(X)\" = \"X_ij X_ij\"";
    is(found(pair, none, "s_ij s_ij + u_i u_i"), "not-applicable");
    // The value of k holds in what is put in, too.
    let both = "k = \"1\", \"W(X)\" = \"k X_ij X_ij\"";
    is(found(pair, both, "s_ij s_ij/4 + u_i u_i"), "proved");
}

/// Conjugates, assumptions and values that another file states are nothing that is known here.
#[test]
fn what_another_file_states_is_not_known_here() {
    let stated = "[equations]\nm = \"eps_ij,i = 0\"\n";
    let pair = "A = { of = \"symmetric\", conjugate = \"C\" }\n\
                C = { of = \"symmetric\", value = \"X_ij X_ij\" }";
    let yields = |text: String| text.replace("[sizes]", "yields = [\"m\"]\n[sizes]");
    let own = |functions: &str| {
        yields(text(
            "own",
            "A(eps) + s_ij s_ij",
            functions,
            &format!("{stated}{}", becomes("")),
        ))
    };
    let other = text("other", "A(eps) + s_ij s_ij", pair, "");
    for functions in [ANY, SQUARE] {
        let study = studied(&own(functions), &other);
        let relation = said(&study, "functional.degeneration");
        assert!(relation.starts_with("refuted"), "{functions}: {relation}");
        let euler = said(&study, "functional.euler");
        // With s free beside it, s = 0 is an Euler equation that is not stated.
        assert!(euler.starts_with("refuted"), "{functions}: {euler}");
    }
    // Where k may vanish nothing follows for u, whatever the other file assumes.
    let plain = |name: &str, further: &str| text(name, "k u_i u_i + s_ij s_ij", ANY, further);
    let zero = "[equations]\nm = \"u_i = 0\"\nn = \"s_ij = 0\"\n";
    let own = plain("own", &format!("{zero}{}", becomes("")));
    let own = own.replace("[sizes]", "yields = [\"m\", \"n\"]\n[sizes]");
    let data = "[data]\nk = \"scalar\"\n";
    let own = own.replace("[parameters]\nk = {}\n", data);
    let other = plain("other", "").replace("[parameters]\nk = {}\n", data);
    let assumed = other.replace("[sizes]", "assumptions = [\"k > 0\"]\n[sizes]");
    let euler = said(&studied(&own, &assumed), "functional.euler");
    assert!(euler.starts_with("refuted"), "{euler}");
    // A value that the other file states for a parameter is one of it.
    let valued = plain("other", "").replace("k = {}", "k = \"2\"");
    let found = |at: &str| {
        let own = plain("own", &becomes(at));
        said(&studied(&own, &valued), "functional.degeneration")
    };
    assert!(found("").starts_with("refuted"), "{}", found(""));
    assert!(
        found("k = \"2\"").starts_with("proved"),
        "{}",
        found("k = \"2\"")
    );
}

/// One text in two files is one function only where the names in it mean the same, and values of parameters that the other file alone
/// declares hold there.
#[test]
fn one_text_is_one_function_where_its_names_mean_the_same() {
    let pair = "A = { of = \"symmetric\", conjugate = \"B\", value = \"k X_ij X_ij\" }\n\
                B = { of = \"symmetric\", conjugate = \"A\" }";
    let quartic = pair.replace("k X_ij X_ij", "k (X_ij X_ij)^2");
    let with = |text: String, k: &str| text.replace("k = {}", &format!("k = \"{k}\""));
    let found = |functions: &str, here: &str, there: &str| {
        let own = text("own", "B(eps) + s_ij s_ij", functions, &becomes(""));
        let other = text("other", "B(eps) + s_ij s_ij", functions, "");
        said(
            &studied(&with(own, here), &with(other, there)),
            "functional.degeneration",
        )
    };
    assert!(found(pair, "1", "1").starts_with("proved"));
    assert!(
        found(pair, "1", "2").starts_with("refuted"),
        "{}",
        found(pair, "1", "2")
    );
    assert!(found(&quartic, "1", "1").starts_with("proved"));
    assert!(
        found(&quartic, "1", "2").starts_with("undecided"),
        "{}",
        found(&quartic, "1", "2")
    );
    // At k = 2 what is half known is another function.
    let own = text("own", "B(eps) + s_ij s_ij", &quartic, &becomes("k = \"2\""));
    let other = text("other", "B(eps) + s_ij s_ij", &quartic, "");
    let special = said(&studied(&own, &other), "functional.degeneration");
    assert!(special.starts_with("undecided"), "{special}");
    // A parameter of the other file alone has its value.
    let own = text("own", "eps_ij eps_ij", ANY, &becomes("")).replace("k = {}", "");
    let other = with(
        text(
            "other",
            "A(eps)",
            "A = { of = \"symmetric\", value = \"k X_ij X_ij/2\" }",
            "",
        ),
        "2",
    );
    let alone = said(&studied(&own, &other), "functional.degeneration");
    assert!(alone.starts_with("proved"), "{alone}");
}

/// Functionals over different bodies are not compared, and names of other kinds are no common names.
#[test]
fn bodies_and_kinds_are_compared() {
    let line = |name: &str, l: &str, further: &str| {
        format!(
            r#"kind = "functional"
name = "{name}"
density = "u,x^2"
[domain]
coordinates = ["x"]
intervals = {{ x = [0, "l"] }}
[fields]
u = "scalar"
[parameters]
l = "{l}"
[boundary]
"x = 0" = {{ fixed = ["u"] }}
"x = l" = {{ fixed = ["u"] }}
{further}"#
        )
    };
    let found = |there: &str| {
        let own = line("own", "1", "[degenerations.it]\nbecomes = \"other.toml\"\n");
        said(
            &studied(&own, &line("other", there, "")),
            "functional.degeneration",
        )
    };
    assert!(found("1").starts_with("proved"), "{}", found("1"));
    assert!(found("2").starts_with("undecided"), "{}", found("2"));
    let own = text("own", "s_ij s_ij", ANY, &becomes(""));
    let matrix = own.replace("s = \"symmetric\"", "s = \"matrix\"");
    let loaded = load("own.toml", &own, &Other(matrix), &[]);
    let told = loaded.diagnostics.render(Style::Plain);
    assert!(told.contains("`s` is of another kind"), "{told}");
}

/// The values of a function with a gradient alone are not free.
#[test]
fn a_gradient_alone_makes_no_counterexample() {
    let chained = "A = { of = \"symmetric\", value = \"1/2 X_ij X_ij\" }\n\
                   M = { of = \"symmetric\", gradient = \"2 A'_ij(X)\" }";
    // M is even, whatever its constant.
    let own = text(
        "own",
        "M(eps) - M(-eps_ij) + s_ij s_ij",
        chained,
        &becomes(""),
    );
    let other = text("other", "s_ij s_ij", "", "").replace("[functions]\n", "");
    let found = said(&studied(&own, &other), "functional.degeneration");
    assert!(found.starts_with("undecided"), "{found}");
}

/// A conjugate inside of what it is asked for ends: these overflowed the stack.
#[test]
fn conjugates_within_each_other_end() {
    let line = |value: &str, stated: &str| {
        format!(
            r#"kind = "functional"
name = "line"
density = "u,x s - B(s)"
yields = ["m"]
[domain]
coordinates = ["x"]
intervals = {{ x = [0, 1] }}
[fields]
s = "scalar"
u = "scalar"
[functions]
A = {{ of = "scalar", conjugate = "B", value = "{value}" }}
B = {{ of = "scalar", conjugate = "A" }}
[boundary]
"x = 0" = {{ fixed = ["u"] }}
"x = 1" = {{ fixed = ["u"] }}
[equations]
m = "s = {stated}"
"#
        )
    };
    for (value, stated) in [
        ("cosh(X) - 1", "2 A'(u,x)"),
        ("cosh(X) - 1", "A'(u,x) + 1"),
        ("1/4 X^4", "2 A'(u,x)"),
    ] {
        let found = said(&studied(&line(value, stated), ""), "functional.euler");
        assert!(!found.starts_with("proved"), "{found}");
    }
}

/// What is wrong with names and gradients is told.
#[test]
fn what_is_wrong_is_told() {
    let told = |text: &str| {
        let loaded = load("own.toml", text, &Other(String::new()), &[]);
        assert!(loaded.problem.is_none());
        loaded.diagnostics.render(Style::Plain)
    };
    let own = text("own", "A(eps) + s_ij s_ij", ANY, "");
    let of_definition = told(&own.replace("[\"u\"]", "[\"eps\"]"));
    assert!(
        of_definition.contains("`eps` is a definition"),
        "{of_definition}"
    );
    let twice = told(&own.replace("[\"u\"]", "[\"u\", \"u\"]"));
    assert!(twice.contains("`u` is declared twice"), "{twice}");
    let pieces = told(&own.replace("[\"S\"]", "[\"S\", \"S\"]"));
    assert!(pieces.contains("`S` is declared twice"), "{pieces}");
    let minor = own.replace(
        ANY,
        "A = { of = \"symmetric\", gradient = \"c_ijkl X_kl\" }",
    );
    let gradient = told(&minor.replace("k = {}", "c = { kind = \"minor\" }"));
    assert!(gradient.contains("\"elastic\""), "{gradient}");
}

/// Two files that assume opposite things have nothing to be compared for; the rest of the study stands.
#[test]
fn assumptions_that_contradict_each_other_are_said() {
    let file = |assumed: &str| {
        let own = text("own", "k A(eps)", SQUARE, "");
        format!("assumptions = [\"{assumed}\"]\n{own}")
    };
    let own = format!("{}{}", file("k > 0"), becomes(""));
    let same = studied(&own, &file("k > 0"));
    assert!(said(&same, "functional.degeneration").starts_with("proved"));
    let opposite = said(&studied(&own, &file("k < 0")), "functional.degeneration");
    assert!(opposite.starts_with("not-applicable"), "{opposite}");
    assert!(opposite.contains("`k < 0` contradicts"), "{opposite}");
}

/// Greek letters in names of fields, coordinates and definitions are their names, and pieces are called as the user calls them.
#[test]
fn names_in_greek_letters() {
    let text = r#"
kind = "functional"
name = "γ"
density = "1/2 γ_i γ_i"
yields = ["m"]
[domain]
coordinates = ["ξ", "η"]
boundary = ["Γ"]
[fields]
"φ" = "scalar"
[define]
"γ_i" = "φ,i"
[boundary]
"Γ" = { fixed = ["φ"] }
[equations]
m = "φ,ξξ + φ,ηη = 0"
"#;
    let found = said(&studied(text, ""), "functional.euler");
    assert!(found.starts_with("proved"), "{found}");
}

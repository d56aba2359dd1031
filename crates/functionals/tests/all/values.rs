//! Values that a model states for parameters: what is said is said of the functional with them.

use crate::table::{read_text, row_text, studied, studied_text};
use chetaev_model::Style;

/// A rod of stiffness E that a load F draws, held at both ends: u,xx + F/E = 0, with l = 2, E = F = 1 by u = x - x²/2, of value -1/3.
fn rod(stiffness: &str, value: &str) -> String {
    format!(
        "kind = \"functional\"\nname = \"rod\"\ndensity = \"E/2 u,x^2 - F u\"\nyields = [\"a\"]\n\
         [domain]\ncoordinates = [\"x\"]\nintervals = {{ x = [0, \"l\"] }}\n[fields]\nu = \"scalar\"\n\
         [parameters]\nl = \"2\"\nE = \"{stiffness}\"\nF = \"1\"\n\
         [boundary]\n\"x = 0\" = {{ fixed = [\"u\"] }}\n\"x = l\" = {{ fixed = [\"u\"] }}\n\
         [equations]\na = \"u,xx + F/E = 0\"\n\
         [solutions.s]\nvalue = \"{value}\"\nfields = {{ u = \"x - x^2/2\" }}\n"
    )
}

fn word(study: &chetaev_functionals::Study, claim: &str) -> &'static str {
    let mut all = study.verdicts.iter();
    let found = all.find(|d| d.claim == claim);
    found.map_or("not there", |d| d.finding.verdict.word())
}

#[test]
fn a_solution_is_that_of_the_values_stated() {
    let right = studied_text("p4p", &rod("1", "-1/3"), &[]);
    assert_eq!(word(&right, "functional.euler"), "proved");
    assert_eq!(word(&right, "functional.solution"), "proved");
    let wrong = studied_text("p4p", &rod("1", "-1/2"), &[]);
    assert_eq!(word(&wrong, "functional.solution"), "refuted");
    // Twice as stiff it goes half as far.
    let stiff = studied_text("p4p", &rod("2", "-1/3"), &[]);
    assert_eq!(word(&stiff, "functional.euler"), "proved");
    assert_eq!(word(&stiff, "functional.solution"), "refuted");
}

/// The Euler equation is printed as it is, and no claim is made of it.
#[test]
fn without_stated_equations_the_euler_equations_are_printed_only() {
    let text = rod("1", "-1/3");
    let (text, _) = text.split_once("[equations]").unwrap();
    let text = text.replace("yields = [\"a\"]\n", "");
    let study = studied_text("p4p", &text, &[]);
    let verdict = crate::table::decided(&study, "functional.euler");
    assert_eq!(verdict.word(), "not-applicable");
    assert!(
        verdict.detail().contains("states no field equations"),
        "{}",
        verdict.detail()
    );
    let f = &study.problem.functional;
    let euler = chetaev_functionals::variation::variation(f).unwrap().euler;
    // δ(E/2 u'² − F u) = −E u'' − F.
    let [(_, own)] = euler[..] else {
        panic!("one field")
    };
    let printed = f
        .space
        .graph
        .text(f.space.graph.substitute(own, &f.values()));
    assert_eq!(printed, "-1 - u,xx");
}

#[test]
fn a_stiffness_of_zero_divides_nothing() {
    let loaded = read_text("p4p", &rod("0", "0"), &[]);
    assert!(loaded.problem.is_none());
    let told = loaded.diagnostics.render(Style::Plain);
    assert!(told.contains("zero"), "{told}");
}

/// With β = 1 the equation of the stress is 0 = 0, and with β = 0 that of the strain (T4 §3: any β but 0 and 1): the Euler equations
/// are fewer than those stated.
#[test]
fn splits_that_split_nothing_are_not_proved() {
    let d = ("d", "1");
    let divided = read_text("p4pb", &row_text("p4pb"), &[d, ("beta", "1")]);
    assert!(divided.problem.is_none());
    for (row, beta) in [("p2pb", "1"), ("p3pb", "0")] {
        let singular = studied(row, &[d, ("beta", beta)]);
        assert_ne!(word(&singular, "functional.euler"), "proved", "{row}");
        let regular = studied(row, &[d, ("beta", "1/3")]);
        assert_eq!(word(&regular, "functional.euler"), "proved", "{row}");
        assert!(regular.is_as_expected(), "{row}");
    }
}

/// p3pb is there for β = 1, where the level above it, which divides by 1 − β, is not: what it says for itself is said.
#[test]
fn a_level_above_that_is_not_there_stops_nothing() {
    let study = studied("p3pb", &[("d", "1"), ("beta", "1")]);
    assert_eq!(word(&study, "functional.euler"), "proved");
    assert_eq!(word(&study, "functional.descent"), "not-applicable");
    let of_tensor = read_text("p4p", &row_text("p4p"), &[("d", "1"), ("beta", "1")]);
    let told = of_tensor.diagnostics.render(Style::Plain);
    assert!(told.contains("no single value"), "{told}");
    assert!(!told.contains("not declared"), "{told}");
}

/// A plate on a box with two free faces that meet. For ν = 1 its density is the square of Δw, and no condition is left at the corner.
#[test]
fn what_is_divided_by_is_said_where_it_is_needed_only() {
    let text = r#"
kind = "functional"
name = "plate"
density = "D/2 (w,ii w,jj - 2 (1 - nu) (w,xx w,yy - w,xy^2)) - q w"
yields = ["a", "mx", "vx", "my", "vy", "c"]
[domain]
coordinates = ["x", "y"]
intervals = { x = [0, "a"], y = [0, "b"] }
[parameters]
a = "1"
b = "1"
D = {}
nu = {}
[data]
q = "scalar"
[fields]
w = "scalar"
[boundary]
"x = 0" = { fixed = ["w", "w,n"] }
"y = 0" = { fixed = ["w", "w,n"] }
"x = a" = "0"
"y = b" = "0"
[equations]
a = "D w,iijj = q"
mx = { equation = "w,xx + nu w,yy = 0", on = "x = a" }
vx = { equation = "w,xxx + (2 - nu) w,xyy = 0", on = "x = a" }
my = { equation = "w,yy + nu w,xx = 0", on = "y = b" }
vy = { equation = "w,yyy + (2 - nu) w,xxy = 0", on = "y = b" }
c = { equation = "w,xy = 0", on = "x = a, y = b" }
"#;
    let study = studied_text("p4p", text, &[]);
    let verdict = crate::table::decided(&study, "functional.euler");
    assert_eq!(verdict.word(), "proved", "{}", verdict.detail());
    assert!(
        verdict.detail().ends_with("where D ≠ 0 and nu - 1 ≠ 0"),
        "{}",
        verdict.detail()
    );
    for (nu, word) in [
        ("0", "proved"),
        ("2", "proved"),
        ("1/3", "proved"),
        ("1", "refuted"),
    ] {
        let study = studied_text("p4p", text, &[("nu", nu)]);
        let verdict = crate::table::decided(&study, "functional.euler");
        assert_eq!(verdict.word(), word, "ν = {nu}: {}", verdict.detail());
    }
}

#[test]
fn fields_that_are_free_together_are_named_together() {
    let text = rod("1", "-1/3")
        .replace("E/2 u,x^2 - F u", "E/2 u,x^2 - F u + 1/2 (v - w)^2")
        .replace(
            "u = \"scalar\"\n",
            "u = \"scalar\"\nv = \"scalar\"\nw = \"scalar\"\n",
        )
        .replace("yields = [\"a\"]", "yields = [\"a\", \"b\"]")
        .replace("[solutions.s]", "b = \"v = w\"\n[solutions.s]");
    // A solution would have to state v and w too.
    let (text, _) = text.split_once("[solutions.s]").unwrap();
    let study = studied_text("p4p", text, &[]);
    let verdict = crate::table::decided(&study, "functional.euler");
    assert_eq!(verdict.word(), "proved");
    assert!(
        verdict
            .detail()
            .contains("v and w are not determined together"),
        "{}",
        verdict.detail()
    );
}

#[test]
fn a_solution_states_every_field() {
    let text = rod("1", "-1/3").replace("fields = { u", "fields = { v");
    let told = crate::table::read_text("p4p", &text, &[]);
    let said = told.diagnostics.render(chetaev_model::Style::Plain);
    assert!(said.contains("does not state the field `u`"), "{said}");
}

/// A string whose density depends on place alone: ρ u_tt = T u_xx and the energy are those of the textbooks.
#[test]
fn data_may_depend_on_some_variables_alone() {
    let text = |rho: &str, equation: &str| {
        format!(
            "kind = \"functional\"\nname = \"string\"\ndensity = \"1/2 rho u,t^2 - 1/2 u,x^2\"\nyields = [\"w\"]\nsymmetries = [\"translations\"]\n[domain]\n\
             coordinates = [\"x\"]\ntime = \"t\"\nintervals = {{ x = [0, 1] }}\n[data]\nrho = {rho}\n[fields]\nu = \"scalar\"\n[boundary]\n\
             \"x = 0\" = {{ fixed = [\"u\"] }}\n\"x = 1\" = {{ fixed = [\"u\"] }}\n[equations]\nw = \"{equation}\"\n"
        )
    };
    let word = |text: &str, claim: &str| {
        let study = studied_text("p4p", text, &[]);
        let mut all = study.verdicts.iter();
        let own = all
            .find(|d| d.full_id() == claim)
            .map(|d| d.finding.verdict.word());
        own.unwrap_or_else(|| {
            panic!(
                "{:?}",
                study
                    .verdicts
                    .iter()
                    .map(|d| d.full_id())
                    .collect::<Vec<_>>()
            )
        })
    };
    let of_place = "{ kind = \"scalar\", of = [\"x\"] }";
    let wave = text(of_place, "rho u,tt = u,xx");
    assert_eq!(word(&wave, "functional.euler#string"), "proved");
    assert_eq!(word(&wave, "functional.noether#translation-t"), "proved");
    let both = text("\"scalar\"", "rho u,tt + rho,t u,t = u,xx");
    assert_eq!(word(&both, "functional.euler#string"), "proved");
    assert_eq!(word(&both, "functional.noether#translation-t"), "refuted");
    let wrong = text("{ kind = \"scalar\", of = [\"z\"] }", "rho u,tt = u,xx");
    let told = crate::table::read_text("p4p", &wrong, &[]);
    let said = told.diagnostics.render(chetaev_model::Style::Plain);
    assert!(said.contains("`z` is no independent variable"), "{said}");
}

/// A load that is the same at all places is none near one: EI w'' = q (l − x)²/2 follows from it at a free end, and a flux k of x alone has no
/// derivative along the face x = 1.
#[test]
fn data_of_some_variables_alone_are_no_loads_at_one_place() {
    let word = |text: &str| {
        let study = studied_text("p4p", text, &[]);
        crate::table::decided(&study, "functional.euler")
            .word()
            .to_owned()
    };
    let beam = "kind = \"functional\"\nname = \"m\"\ndensity = \"1/2 w,xx^2 - q w\"\nyields = [\"m\"]\n[domain]\ncoordinates = [\"x\"]\nintervals = { x = [0, 1] }\n\
        [data]\nq = { kind = \"scalar\", of = [] }\n[fields]\nw = \"scalar\"\n[boundary]\n\"x = 0\" = { fixed = [\"w\", \"w,n\"] }\n\"x = 1\" = \"0\"\n[equations]\nm = \"w,xx = q/2 (1 - x)^2\"\n";
    assert_ne!(word(beam), "refuted");
    let flux = "kind = \"functional\"\nname = \"m\"\ndensity = \"1/2 u,i u,i - f u\"\nyields = [\"e\", \"r\", \"s\"]\n[domain]\ncoordinates = [\"x\", \"y\"]\n\
        intervals = { x = [0, 1], y = [0, 1] }\n[data]\nf = \"scalar\"\nk = { kind = \"scalar\", of = [\"x\"] }\n[fields]\nu = \"scalar\"\n[boundary]\n\"x = 0\" = { fixed = [\"u\"] }\n\
        \"x = 1\" = \"-k u\"\n\"y = 0\" = { fixed = [\"u\"] }\n\"y = 1\" = { fixed = [\"u\"] }\n[equations]\ne = \"u,ii + f = 0\"\n\
        r = { equation = \"u,x = k\", on = \"x = 1\" }\ns = { equation = \"u,xy = 0\", on = \"x = 1\" }\n";
    assert_eq!(word(flux), "proved");
}

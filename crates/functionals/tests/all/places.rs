//! Where equations hold: places inside of the body, faces at which a variable has its value, and assumptions that hold with the equations.

use crate::table::{decided, studied_text};

/// Fields on an interval of x, with conditions at both ends.
fn text(head: &str, interval: &str, fields: &[&str], ends: [&str; 2], equations: &str) -> String {
    let fields: Vec<String> = fields.iter().map(|f| format!("{f} = \"scalar\"")).collect();
    format!(
        "kind = \"functional\"\nname = \"places\"\n{head}\n[domain]\ncoordinates = [\"x\"]\nintervals = {{ x = {interval} }}\n\
         [fields]\n{}\n[parameters]\nEA = {{}}\nl = {{}}\nP = {{}}\nnu = {{}}\n[boundary]\n{}\n[equations]\n{equations}\n",
        fields.join("\n"),
        ends.join("\n")
    )
}

fn word(text: &str, claim: &str) -> (&'static str, String) {
    let study = studied_text("p4p", text, &[]);
    let own = decided(&study, claim);
    (own.word(), own.detail().to_owned())
}

fn euler(text: &str) -> &'static str {
    word(text, "functional.euler").0
}

/// A tapered bar EA (1 − x/(2 l)) drawn by P: at x = l half of EA is left.
#[test]
fn a_variable_has_its_value_on_its_own_face() {
    let bar = |end: &str| {
        text(
            "density = \"EA/2 (1 - x/(2 l)) u,x^2\"\nyields = [\"a\", \"b\"]",
            "[0, \"l\"]",
            &["u"],
            ["\"x = 0\" = { fixed = [\"u\"] }", "\"x = l\" = \"-P u\""],
            &format!(
                "a = \"((1 - x/(2 l)) u,x),x = 0\"\nb = {{ equation = \"{end}\", on = \"x = l\" }}"
            ),
        )
    };
    assert_eq!(euler(&bar("EA u,x = 2 P")), "proved");
    assert_eq!(euler(&bar("EA u,x = P")), "refuted");
    // (x − 1) u' = 0 says nothing at x = 1.
    let lost = text(
        "density = \"1/2 u,x^2\"\nyields = [\"a\", \"b\"]",
        "[0, 1]",
        &["u"],
        ["\"x = 0\" = { fixed = [\"u\"] }", "\"x = 1\" = \"0\""],
        "a = \"u,xx = 0\"\nb = { equation = \"(x - 1) u,x = 0\", on = \"x = 1\" }",
    );
    assert_eq!(euler(&lost), "refuted");
}

/// A disc in its radius: at the centre no condition is left, since r vanishes there; a rotating beam has no tension at its tip.
#[test]
fn what_was_divided_by_may_vanish_on_a_face() {
    let disc = text(
        "density = \"x/2 u,x^2\"\nyields = [\"a\"]",
        "[0, 1]",
        &["u"],
        ["\"x = 0\" = \"0\"", "\"x = 1\" = { fixed = [\"u\"] }"],
        "a = \"x u,xx + u,x = 0\"",
    );
    assert_eq!(euler(&disc), "proved");
    let beam = |stated: &str| {
        text(
            "density = \"1/2 w,xx^2 + 1/4 (1 - x^2) w,x^2\"\nyields = [\"a\", \"b\", \"c\"]",
            "[0, 1]",
            &["w"],
            ["\"x = 0\" = { fixed = [\"w\", \"w,n\"] }", "\"x = 1\" = \"0\""],
            &format!(
                "a = \"w,xxxx = ((1 - x^2) w,x),x/2\"\nb = {{ equation = \"w,xx = 0\", on = \"x = 1\" }}\n\
                 c = {{ equation = \"{stated}\", on = \"x = 1\" }}"
            ),
        )
    };
    assert_eq!(euler(&beam("w,xxx = 0")), "proved");
    assert_eq!(euler(&beam("w,xxx = w,x")), "refuted");
}

#[test]
fn a_counterexample_lies_inside_of_the_body() {
    let string = |interval: &str, stated: &str| {
        text(
            "density = \"1/2 u,x^2 + x u\"\nyields = [\"a\"]",
            interval,
            &["u"],
            ["", ""],
            &format!("a = \"{stated}\""),
        )
        .replace("[boundary]\n\n", "[boundary]\n")
    };
    let with_ends = |interval: &str, stated: &str, ends: [&str; 2]| {
        let fixed = ends.map(|end| format!("\"x = {end}\" = {{ fixed = [\"u\"] }}"));
        string(interval, stated).replace(
            "[boundary]\n",
            &format!("[boundary]\n{}\n", fixed.join("\n")),
        )
    };
    assert_eq!(
        euler(&with_ends("[0, 1]", "u,xx = abs(x)", ["0", "1"])),
        "proved"
    );
    assert_eq!(
        euler(&with_ends("[-1, 0]", "u,xx = -abs(x)", ["-1", "0"])),
        "proved"
    );
    assert_eq!(
        euler(&with_ends("[-1, 1]", "u,xx = abs(x)", ["-1", "1"])),
        "refuted"
    );
}

#[test]
fn assumptions_hold_where_the_equations_do() {
    let product = |assumption: &str, stated: &str| {
        text(
            &format!(
                "density = \"q k (u - 1/2)\"\nyields = [\"a\", \"b\"]\nassumptions = [\"{assumption}\"]"
            ),
            "[0, 1]",
            &["q", "u"],
            [
                "\"x = 0\" = { fixed = [\"q\", \"u\"] }",
                "\"x = 1\" = { fixed = [\"q\", \"u\"] }",
            ],
            &format!("a = \"{stated}\"\nb = \"q = 0\""),
        )
        .replace("[parameters]", "[data]\nk = \"scalar\"\n[parameters]")
    };
    for assumption in [
        "k^2 > 0",
        "abs(k) > 0",
        "k l > 1",
        "exp(k) > 1",
        "k (k - 1) > 0",
    ] {
        assert_eq!(
            euler(&product(assumption, "u = 1/2")),
            "proved",
            "{assumption}"
        );
        assert_eq!(
            euler(&product(assumption, "u = 1")),
            "refuted",
            "{assumption}"
        );
    }
    assert_eq!(euler(&product("l > 1", "u = 1/2")), "refuted");
}

#[test]
fn a_stated_solution_is_smooth_on_the_body_and_as_assumed() {
    let string = |u: &str, f: &str, more: &str| {
        format!(
            "kind = \"functional\"\nname = \"s\"\ndensity = \"1/2 u,x^2 - f u\"\n{more}\n[domain]\ncoordinates = [\"x\"]\n\
             intervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n[data]\nf = \"scalar\"\n[boundary]\n\
             \"x = 0\" = {{ fixed = [\"u\"] }}\n\"x = 1\" = {{ fixed = [\"u\"] }}\n[solutions.s]\nfields = {{ u = \"{u}\", f = \"{f}\" }}\n"
        )
    };
    let of = |u: &str, f: &str, more: &str| word(&string(u, f, more), "functional.solution").0;
    // |x − 1/2| is no solution: with v = x (1 − x) the first variation is −1/2.
    assert_eq!(of("abs(x - 1/2)", "0", ""), "undecided");
    assert_eq!(of("log(x - 3)", "1/(x - 3)^2", ""), "undecided");
    assert_eq!(of("x^3", "-6 x", ""), "proved");
    assert_eq!(of("x^3", "6 x", ""), "refuted");
    assert_eq!(
        of("x^3", "-6 x", "assumptions = [\"u < 0\"]"),
        "not-applicable"
    );
    // The integral of |x| is no polynomial's.
    let unsmooth = string("x^3", "-6 abs(x)", "").replace("fields =", "value = \"9/10\"\nfields =");
    assert_ne!(word(&unsmooth, "functional.solution").0, "refuted");
}

/// W'' may vanish for some W, and does not where its sign is assumed or a conjugate undoes W'.
#[test]
fn a_function_of_which_nothing_is_known_may_vanish() {
    let of = |assumptions: &str, functions: &str| {
        text(
            &format!("density = \"W(u,x)\"\nyields = [\"a\"]\n{assumptions}"),
            "[0, 1]",
            &["u"],
            [
                "\"x = 0\" = { fixed = [\"u\"] }",
                "\"x = 1\" = { fixed = [\"u\"] }",
            ],
            "a = \"u,xx = 0\"",
        )
        .replace(
            "[parameters]",
            &format!("[functions]\n{functions}\n[parameters]"),
        )
    };
    let alone = "W = { of = \"scalar\" }";
    let pair =
        "W = { of = \"scalar\", conjugate = \"V\" }\nV = { of = \"scalar\", conjugate = \"W\" }";
    assert_eq!(euler(&of("", alone)), "undecided");
    assert_eq!(
        euler(&of("assumptions = [\"W''(u,x) > 0\"]", alone)),
        "proved"
    );
    assert_eq!(euler(&of("", pair)), "proved");
}

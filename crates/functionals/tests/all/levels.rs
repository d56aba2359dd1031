//! Relations that T4 §3 and §4 state beside the table: what may stand on the boundary, what depends on the factor, where there is a
//! minimum, and modulo what the pairs of the lowest levels are dual.

use crate::extent::Extent;
use crate::table::{decided, loaded_text, row_text, studied_text, ROWS};
use chetaev_functionals::notation::parse;
use chetaev_functionals::space::Jet;
use std::collections::BTreeMap;

/// The text of a row with replacements, each of which has to be possible.
fn changed(row: &str, replaced: &[(&str, &str)]) -> String {
    replaced.iter().fold(row_text(row), |text, (from, to)| {
        assert!(text.contains(from), "{row} has no `{from}`");
        text.replace(from, to)
    })
}

type Set<'a> = &'a [(&'a str, &'a str)];

const LINE: Set<'static> = &[("d", "1")];
const PLANE: Set<'static> = &[("d", "2")];

#[track_caller]
fn says(row: &str, text: &str, set: Set<'_>, (claim, word, part): (&str, &str, &str)) {
    let study = studied_text(row, text, set);
    let verdict = decided(&study, claim);
    let detail = verdict.detail();
    assert_eq!(verdict.word(), word, "{row}: {detail}");
    assert!(detail.contains(part), "{row}: {detail}");
}

/// P1p with the displacement given on S_u beforehand: the usual potential energy.
const HELD: [(&str, &str); 3] = [
    ("S_u = \"-P_k (u_k - ubar_k)\"", "S_u = { fixed = [\"u\"] }"),
    ("\"2\", \"3\"]", "\"2\", \"3\", \"5\"]"),
    ("\"4\", \"5\", \"6\"]", "\"4\", \"6\"]"),
];

#[test]
fn the_potential_energy_is_that_of_level_one_where_displacements_are_given() {
    let text = changed("p1p", &HELD);
    let rest = text.find("[duality]").unwrap();
    let descent =
        "[descent]\nfrom = \"../p1p/model.toml\"\nimposing = [\"5\"]\nmultiplier = \"-P_k\"\n";
    let text = text[..rest].to_owned() + descent;
    for verdict in [
        (
            "functional.euler",
            "proved",
            "equivalent to (4) and (6), where (2), (3) and (5) hold beforehand",
        ),
        ("functional.descent", "proved", "imposing (5) on p1p"),
        // The traction is the multiplier of the displacement.
        (
            "functional.multipliers",
            "proved",
            "with the multiplier -P_k",
        ),
    ] {
        says("p1p", &text, PLANE, verdict);
    }
    // A divergence more in the density is nothing of which the interior knows.
    let (own, more) = (
        "density = \"A(D) - F_k u_k\"",
        "density = \"A(D) - F_k u_k + u_k,k\"",
    );
    assert!(text.contains(own), "{text}");
    let verdict = ("functional.descent", "undecided", "by a divergence");
    says("p1p", &text.replace(own, more), PLANE, verdict);
    // Given displacements yield nothing of the traction on S_u, and with another traction on S_s it is another body.
    let all = text.replace("\"4\", \"6\"]", "\"4\", \"6\", \"11\"]");
    let all = all + "[equations]\n11 = { equation = \"P_k = 0\", on = \"S_u\" }\n";
    says("p1p", &all, PLANE, ("functional.euler", "refuted", "(11)"));
}

/// The bar of E1 with numbers, of stiffness `energy`, held beforehand.
fn held_bar(energy: &str) -> String {
    let text = changed("p1p", &HELD[..1]);
    let text = text.replace("\"4\", \"5\", \"6\"]", "\"4\", \"6\"]");
    let function = format!("\"A(X)\" = \"{energy} X_ij X_ij\"\n");
    let solution = "[solutions.bar]\nparameters = []\nintervals = { x_1 = [0, \"3/2\"] }\npieces = { S_u = \"x_1 = 0\", S_s = \"x_1 = 3/2\" }\n\
        [solutions.bar.fields]\n\"B(X)\" = \"X_ij X_ij/4\"\nu_1 = \"x_1 - x_1^2/4\"\ne_11 = \"1 - x_1/2\"\ns_11 = \"2 - x_1\"\nF_1 = \"1\"\nubar_1 = \"0\"\nPbar_1 = \"1/2\"\n";
    let includes = ", \"../common/bar.toml\", \"../common/bar-p.toml\"";
    assert!(text.contains(includes));
    text.replace(includes, "") + solution + &function
}

/// The energy of the bar has a minimum where displacements are given; the functionals above are stationary only (T4 §4).
#[test]
fn the_minimum_is_that_of_the_potential_energy() {
    let linear: Set<'_> = &[("d", "1"), ("nonlinear", "0")];
    let claim = "functional.second-variation";
    says(
        "p1p",
        &held_bar("1"),
        linear,
        ("functional.solution", "proved", ""),
    );
    says("p1p", &held_bar("1"), linear, (claim, "proved", ""));
    // A bar that pushes when it is drawn.
    let study = studied_text("p1p", &held_bar("-1"), linear);
    assert_ne!(decided(&study, claim).word(), "proved");
    for row in ["p4p", "p4pb", "p3p1", "p3c1", "p2c", "p2cb", "p2c1"] {
        says(
            row,
            &row_text(row),
            linear,
            (
                claim,
                "not-applicable",
                "a principle is one of stationarity",
            ),
        );
    }
}

/// What stands for the trace of a field of the interior on the boundary, and the equation that it yields.
struct Independent {
    from: &'static str,
    to: &'static str,
    field: &'static str,
    equation: &'static str,
}

const INDEPENDENT: [Independent; 3] = [
    Independent {
        from: "-P_k (u_k - ubar_k)",
        to: "-Pb_k (u_k - ubar_k)",
        field: "Pb = { kind = \"vector\", on = \"S_u\" }",
        equation: "{ equation = \"Pb_k = P_k\", on = \"S_u\" }",
    },
    Independent {
        from: "-Pm_k (u_k - ubar_k)",
        to: "-Pb_k (u_k - ubar_k)",
        field: "Pb = { kind = \"vector\", on = \"S_u\" }",
        equation: "{ equation = \"Pb_k = P_k\", on = \"S_u\" }",
    },
    Independent {
        from: "(P_k - Pbar_k) u_k",
        to: "(P_k - Pbar_k) ub_k",
        field: "ub = { kind = \"vector\", on = \"S_s\" }",
        equation: "{ equation = \"ub_k = u_k\", on = \"S_s\" }",
    },
];

/// A row above level 0 with a field of its own on the boundary; P0p and P0c have it in the gallery.
fn with_own_field(row: &str) -> Option<String> {
    let text = row_text(row);
    let own = INDEPENDENT.iter().find(|own| text.contains(own.from))?;
    let fields = format!("[fields]\n{}\n", own.field);
    let mut yields = vec!["yields = [\"11\""];
    let mut equations = format!("11 = {}\n", own.equation);
    if row == "p2c1" {
        // The stress field is on S_s as it is on S_u: its traction is the one of the displacement.
        yields.push("\"12\"");
        equations += "12 = { equation = \"P_k = Pm_k\", on = \"S_s\" }\n";
    }
    let yields = yields.join(", ") + ", ";
    let text = changed(
        row,
        &[
            (own.from, own.to),
            ("[fields]\n", &fields),
            ("yields = [", &yields),
        ],
    );
    let headed = format!("[equations]\n{equations}");
    Some(match text.contains("[equations]\n") {
        true => text.replace("[equations]\n", &headed),
        false => text + "\n" + &headed,
    })
}

fn independent(row: &str, set: Set<'_>) -> bool {
    let Some(text) = with_own_field(row) else {
        return false;
    };
    says(row, &text, set, ("functional.euler", "proved", "(11)"));
    true
}

#[test]
fn tractions_and_displacements_on_the_boundary_may_be_fields_of_their_own() {
    let rows = ROWS.iter().filter(|row| independent(row, LINE));
    assert_eq!(rows.count(), 22);
    // With the factor 2 the field is half the traction.
    let text = with_own_field("p3pb").unwrap();
    let text = text.replace("-Pb_k (u_k", "-2 Pb_k (u_k");
    says("p3pb", &text, LINE, ("functional.euler", "refuted", "(11)"));
    let extent = Extent::of_run(std::path::Path::new(env!("CARGO_MANIFEST_DIR")));
    extent.of(ROWS).into_iter().for_each(|row| {
        independent(row, PLANE);
    });
}

/// The sum on S_u is (P − Pb) (u − ubar) where Pb is a field of its own: that of P and P^m vanishes with (3).
#[test]
fn the_field_of_a_traction_makes_a_pair_dual_modulo_conditions() {
    for row in ["p3pb", "p2pb", "p1p"] {
        let text = with_own_field(row).unwrap();
        let second = "on S_u modulo (5), of second order with (5) and (11)";
        says(row, &text, LINE, ("functional.duality", "proved", second));
    }
}

/// T4 §1, §3: level 0 and the last pair agree modulo (4) and (3) in the interior, and on the boundary modulo its conditions.
#[test]
fn the_lowest_levels_are_dual_modulo_equations() {
    let fields = "in the interior modulo (4), on S_u modulo (5), of second order with (5) and (7), on S_s modulo (6), of second order with (6) and (8)";
    for row in ["p0p", "p0c"] {
        says(
            row,
            &row_text(row),
            PLANE,
            ("functional.duality", "proved", fields),
        );
    }
    // (3) is the definition of the stress in Pp, and an equation in Pc.
    let last = "in the interior modulo (3) and (4), on S_u modulo ";
    for row in ["pp", "pc"] {
        let twice = row_text(row).replace("flux = \"t_ik u_k\"", "flux = \"2 t_ik u_k\"");
        let of = |word, part| ("functional.duality", word, part);
        says(row, &row_text(row), PLANE, of("proved", last));
        says(row, &twice, PLANE, of("refuted", "2 t_ik u_k"));
    }
    // The stress field of P2c1 has its traction on S_u alone, beside that of the displacement: they agree with (3) (T4 §1).
    let mixed = "to zero on S_u modulo ";
    for row in ["p2p1", "p2c1"] {
        let wrong = row_text(row).replace("flux = \"t_ik u_k\"", "flux = \"s_ik u_k\"");
        says(
            row,
            &row_text(row),
            PLANE,
            ("functional.duality", "proved", mixed),
        );
        says(
            row,
            &wrong,
            PLANE,
            ("functional.duality", "refuted", "s_ik u_k"),
        );
    }
    says(
        "p1p",
        &row_text("p1p"),
        PLANE,
        ("functional.duality", "proved", "identically"),
    );
}

/// T4 §4, the pitfall: with P from s alone terms are left on S_u, which vanish with the trace of (3); for any splitting tensor.
#[test]
fn on_level_two_the_traction_of_the_stress_alone_needs_the_law_for_any_tensor() {
    let alone = changed("p2p", &[("-Pm_k (u_k", "-P_k (u_k")]);
    let of = |claim, part| (claim, "proved", part);
    let euler = "functional.euler";
    says(
        "p2p",
        &alone,
        PLANE,
        of(euler, "on S_u and S_s with the trace of (3)"),
    );
    says(
        "p2p",
        &row_text("p2p"),
        PLANE,
        of(euler, "on S_s with the trace of (3)"),
    );
    says(
        "p2p",
        &alone,
        PLANE,
        of("functional.duality", "identically"),
    );
    let mixed = "on S_u modulo (3)";
    says(
        "p2p",
        &row_text("p2p"),
        PLANE,
        of("functional.duality", mixed),
    );
}

/// P2p1 has no stress field, and cannot write the flux of the pair: P2c1 states it.
#[test]
fn the_pair_without_a_stress_in_one_of_its_functionals_is_dual() {
    says(
        "p2c1",
        &row_text("p2c1"),
        PLANE,
        ("functional.duality", "proved", "on S_u modulo (3)"),
    );
    let text = row_text("p2c1").replace("D_ij s_ij - A(D)", "D_ij s_ij - 2 A(D)");
    let claim = ("functional.duality", "refuted", "not the divergence");
    says("p2c1", &text, PLANE, claim);
}

/// T4 §3: neither the Euler equations nor the natural conditions depend on β; the second variation does, by β A'', β and (1 − β) B''.
#[test]
fn the_second_variation_depends_on_the_factor() {
    let text = row_text("p3pb").replace("energy-abstract", "energy-cosh");
    let f = loaded_text("p3pb", &text, LINE).functional;
    let (space, g) = (&*f.space, &f.space.graph);
    let jet = |name: &str| Jet {
        component: space.component_named(name).unwrap(),
        by: Vec::new(),
    };
    let (e, s) = (jet("e_11"), jet("s_11"));
    for (one, two, wanted) in [
        (&e, &e, "beta cosh(e_11)"),
        (&e, &s, "-beta"),
        (&s, &s, "-(1 - beta)/sqrt(1 + s_11^2)"),
    ] {
        let node = parse(wanted, &f.scope, &mut Vec::new()).unwrap();
        let wanted = f.scope.value(&node, &BTreeMap::new());
        let density = space.explicit(f.density);
        let found = space.explicit(space.partial(space.partial(density, one), two));
        assert!(space.vanish(&[g.sub(found, wanted)]), "{}", g.text(found));
    }
}

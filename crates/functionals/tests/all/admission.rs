//! What is imposed beforehand has to be possible: of no field nothing is proved.

use crate::table::{decided, studied_text};
use chetaev_functionals::Study;

fn studied(imposed: &[(&str, &str)], more: &str) -> Study {
    let labels: Vec<String> = (0..imposed.len()).map(|k| format!("\"i{k}\"")).collect();
    let stated: Vec<String> = imposed
        .iter()
        .enumerate()
        .map(|(k, (e, on))| match *on {
            "" => format!("i{k} = \"{e}\""),
            on => format!("i{k} = {{ equation = \"{e}\", on = \"{on}\" }}"),
        })
        .collect();
    let text = format!(
        r#"
kind = "functional"
name = "imposed"
density = "1/2 u,x^2 + 1/2 u,y^2 - f u"
yields = ["a"]
imposed = [{}]
symmetries = ["translations"]
[domain]
coordinates = ["x", "y"]
intervals = {{ x = [0, 1], y = [0, 1] }}
[fields]
u = "scalar"
[data]
f = "scalar"
g = "scalar"
[parameters]
k = {{ description = "a number" }}
[boundary]
"x = 0" = {{ fixed = ["u"] }}
"x = 1" = {{ fixed = ["u"] }}
"y = 0" = {{ fixed = ["u"] }}
"y = 1" = {{ fixed = ["u"] }}
[equations]
a = "u,xx + u,yy + f = 0"
{}
{more}
"#,
        labels.join(", "),
        stated.join("\n")
    );
    studied_text("p4p", &text, &[])
}

fn euler(study: &Study) -> (&'static str, String) {
    let verdict = decided(study, "functional.euler");
    (verdict.word(), verdict.detail().to_owned())
}

#[test]
fn conditions_that_contradict_each_other_leave_nothing_to_claim() {
    let cases: &[&[(&str, &str)]] = &[
        &[("u = 1", ""), ("u = 2", "")],
        &[("1 = 2", "")],
        &[("x = 1/2", "")],
        &[("u^2 = -1", "")],
        &[("u,x^2 + u,y^2 + 1 = 0", "")],
        &[("exp(u) = 0", "")],
        &[("abs(u) = -1", "")],
        &[("u,x = u", ""), ("u,xx = u + 1", "")],
        // By the integrability condition u,xy = u,yx only.
        &[("u,x = y", ""), ("u,y = 0", "")],
        &[("u (u - 1) = 0", ""), ("u = 2", "")],
        &[("u = 1", "x = 0"), ("u = 2", "x = 0")],
        &[("u = 0", ""), ("u = 1", "y = 1")],
        // On one face the data of the other: at the corner both are to hold.
        &[("u = 1", "x = 0"), ("u = 2", "y = 0")],
        &[("u = x + 1", "x = 0"), ("u = 0", "")],
    ];
    for imposed in cases {
        let study = studied(imposed, "");
        for decided in &study.verdicts {
            let verdict = &decided.finding.verdict;
            assert_eq!(
                verdict.word(),
                "not-applicable",
                "{imposed:?}: {}",
                decided.full_id()
            );
            assert!(
                verdict
                    .detail()
                    .contains("no field satisfies what is imposed"),
                "{}",
                verdict.detail()
            );
        }
    }
}

#[test]
fn conditions_that_can_hold_together_are_no_contradiction() {
    let cases: &[&[(&str, &str)]] = &[
        &[("u,x = y", ""), ("u,y = x", "")],
        &[("u = 1", "x = 0"), ("u = 2", "x = 1")],
        &[("u = 1", "x = 0"), ("u = 1 + x", "y = 0")],
        &[("u,xx + u,yy + f = 0", "")],
        &[],
    ];
    for imposed in cases {
        let (word, detail) = euler(&studied(imposed, ""));
        // Of the first the variations are constants, for which no equation was derived.
        let wanted = if imposed.first() == Some(&("u,x = y", "")) {
            "undecided"
        } else {
            "proved"
        };
        assert_eq!(word, wanted, "{imposed:?}: {detail}");
    }
}

#[test]
fn what_is_imposed_twice_is_said() {
    let equation = "u,xx + u,yy + f = 0";
    for second in ["2 u,xx + 2 u,yy + 2 f = 0", "u,xxx + u,xyy + f,x = 0"] {
        let (word, detail) = euler(&studied(&[(equation, ""), (second, "")], ""));
        assert_eq!(word, "proved", "{detail}");
        assert!(
            detail.contains("(i1) imposed besides, which follows from the others"),
            "{detail}"
        );
    }
}

#[test]
fn what_restricts_data_or_parameters_is_a_condition() {
    for (imposed, condition) in [
        (&[("u = 0", ""), ("u = g", ""), ("f = 0", "")][..], "g = 0"),
        (
            &[("u,xx + u,yy + f = 0", ""), ("u = k", ""), ("u = 1", "")][..],
            "k",
        ),
    ] {
        let study = studied(imposed, "");
        let own = study
            .verdicts
            .iter()
            .find(|d| d.claim == "functional.euler")
            .unwrap();
        match &own.finding.verdict {
            chetaev_symbolic::Verdict::Conditional { condition: own, .. } => {
                assert!(own.contains(condition), "{own}");
            }
            other => panic!("{imposed:?}: {} {}", other.word(), other.detail()),
        }
    }
}

#[test]
fn what_agrees_at_a_corner_follows_from_nothing() {
    let text = |value: &str| {
        format!(
            r#"
kind = "functional"
name = "membrane"
density = "1/2 u,i u,i"
yields = ["a"]
imposed = ["b", "c"]
[domain]
coordinates = ["x", "y"]
intervals = {{ x = [0, 1], y = [0, 1] }}
[fields]
u = "scalar"
[boundary]
"x = 0" = "0"
"x = 1" = {{ fixed = ["u"] }}
"y = 0" = "0"
"y = 1" = {{ fixed = ["u"] }}
[equations]
a = "u,ii = 0"
b = {{ equation = "u = 0", on = "x = 0" }}
c = {{ equation = "u = {value}", on = "y = 0" }}
"#
        )
    };
    let study = studied_text("p4p", &text("0"), &[]);
    let (word, detail) = euler(&study);
    assert_eq!(word, "proved", "{detail}");
    assert!(!detail.contains("follows from the others"), "{detail}");
    let study = studied_text("p4p", &text("1"), &[]);
    let (word, detail) = euler(&study);
    assert_eq!(word, "not-applicable", "{detail}");
    assert!(detail.contains("where x = 0 and y = 0 meet"), "{detail}");
}

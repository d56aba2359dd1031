//! What a proof asks for is said, and no more: regular matrices, conjugates, derivatives of the densities.

use crate::table::{decided, studied, studied_text};
use chetaev_symbolic::Verdict;

/// Algebraic fields on a body of `d` dimensions with a free surface: the verdict on the Euler equations, with its words.
fn of_fields(
    d: usize,
    fields: &str,
    parameters: &str,
    density: &str,
    stated: &[&str],
) -> (String, String) {
    let labels: Vec<String> = (0..stated.len()).map(|k| format!("\"e{k}\"")).collect();
    let own = stated.iter().enumerate();
    let equations: Vec<String> = own.map(|(k, e)| format!("e{k} = \"{e}\"")).collect();
    let text = format!(
        "kind = \"functional\"\nname = \"own\"\ndensity = \"{density}\"\nyields = [{}]\n[sizes]\nd = {d}\n\
         [domain]\ncoordinates = \"x_i\"\nboundary = [\"S\"]\n[fields]\n{fields}\n[parameters]\n{parameters}\n\
         [boundary]\nS = \"0\"\n[equations]\n{}\n",
        labels.join(", "),
        equations.join("\n")
    );
    let study = studied_text("p4p", &text, &[]);
    let verdict = decided(&study, "functional.euler");
    (verdict.word().to_owned(), verdict.detail().to_owned())
}

/// Where C is singular some strain is left free.
#[test]
fn a_large_matrix_of_parameters_has_to_be_regular() {
    for d in [2, 3] {
        let (word, detail) = of_fields(
            d,
            "e = \"symmetric\"",
            "C = { kind = \"elastic\" }",
            "C_ijkl e_ij e_kl/2",
            &["e_ij = 0"],
        );
        assert_eq!(word, "proved", "{detail}");
        let is_said = detail.contains("≠ 0")
            || detail.contains("coefficients of e, in which parameters stand, is regular");
        assert!(is_said, "d = {d}: {detail}");
    }
}

/// m² ≠ p q is all that is needed, whatever is eliminated first.
#[test]
fn conditions_do_not_depend_on_the_order_of_the_fields() {
    let density = "p a^2/2 + m a b + q b^2/2";
    for fields in [
        "a = \"scalar\"\nb = \"scalar\"",
        "b = \"scalar\"\na = \"scalar\"",
    ] {
        let (word, detail) = of_fields(
            1,
            fields,
            "p = {}\nq = {}\nm = {}",
            density,
            &["a = 0", "b = 0"],
        );
        assert_eq!(word, "proved", "{detail}");
        assert_eq!(detail.matches('≠').count(), 1, "{detail}");
        assert!(detail.contains("m^2"), "{detail}");
    }
}

/// |u|³ and u^(4/3) have derivatives at zero, |u| has none: whether |u| + u²/2 is stationary there, no Euler equation says.
#[test]
fn derivatives_at_zero_are_those_of_the_power() {
    for (density, wanted) in [
        ("abs(u)^3", "proved"),
        ("u^(4/3)", "proved"),
        ("abs(u) + u^2/2", "undecided"),
    ] {
        let (word, detail) = of_fields(1, "u = \"scalar\"", "", density, &["u = 0"]);
        assert_eq!(word, wanted, "{density}: {detail}");
        assert!(!detail.contains("!="), "{density}: {detail}");
    }
}

/// The last factor of the condition on S_u is the equation itself: it is a case, and nothing to divide by.
#[test]
fn what_is_stated_is_not_divided_by() {
    for row in ["p4p", "p3p", "p2p0"] {
        let study = studied(row, &[("d", "1")]);
        let verdict = decided(&study, "functional.euler");
        let detail = verdict.detail();
        assert_eq!(verdict.word(), "proved", "{row}: {detail}");
        assert!(
            !detail.contains("ubar_1 ≠ 0") && !detail.contains("n_1 ≠ 0"),
            "{row}: {detail}"
        );
    }
}

/// A piece without a place may be empty, so that it fixes no constant.
#[test]
fn a_piece_that_may_be_empty_fixes_nothing() {
    let text = "kind = \"functional\"\nname = \"own\"\ndensity = \"u,1^2/2\"\nyields = [\"e\"]\n[sizes]\nd = 1\n\
         [domain]\ncoordinates = \"x_i\"\nboundary = [\"S_u\", \"S_s\"]\n[fields]\nu = \"scalar\"\n\
         [boundary]\nS_u = { fixed = [\"u\"] }\nS_s = \"0\"\n[equations]\ne = \"u,1 = 0\"\n";
    let study = studied_text("p4p", text, &[]);
    let verdict = decided(&study, "functional.euler");
    assert_ne!(verdict.word(), "proved", "{}", verdict.detail());
}

fn mixed(lambda: &str, mu: &str) -> String {
    format!(
        "kind = \"functional\"\nname = \"mixed\"\ndensity = \"e_ij s_ij - B(s) - F_k u_k\"\n\
         yields = [\"material\", \"balance\", \"held\"]\n[sizes]\nd = 3\n[domain]\ncoordinates = \"x_i\"\nboundary = [\"S_u\"]\n\
         [parameters]\nlambda = {lambda}\nmu = {mu}\n[fields]\ns = \"symmetric\"\nu = \"vector\"\n\
         [data]\nF = {{ kind = \"vector\" }}\nubar = {{ kind = \"vector\", on = \"S_u\" }}\n[functions]\n\
         A = {{ of = \"symmetric\", value = \"lambda/2 X_ii X_jj + mu X_ij X_ij\", conjugate = \"B\" }}\n\
         B = {{ of = \"symmetric\", conjugate = \"A\" }}\n[define]\ne_ij = \"1/2 (u_i,j + u_j,i)\"\nP_k = \"n_i s_ik\"\n\
         [boundary]\nS_u = \"-P_k (u_k - ubar_k)\"\n[equations]\nmaterial = \"s_ij = A'_ij(e)\"\nbalance = \"s_ik,i + F_k = 0\"\n\
         held = {{ equation = \"u_k = ubar_k\", on = \"S_u\" }}\n"
    )
}

/// 3λ + 2μ = 0: every pressure is without strain, and the energy has no conjugate.
#[test]
fn an_energy_with_a_singular_gradient_has_no_conjugate() {
    let study = studied_text("p4p", &mixed("\"-2\"", "\"3\""), &[]);
    let legendre = decided(&study, "functional.legendre");
    assert!(
        legendre.detail().contains("no conjugate"),
        "{}",
        legendre.detail()
    );
    let euler = decided(&study, "functional.euler");
    assert_ne!(euler.word(), "proved", "{}", euler.detail());
    let study = studied_text("p4p", &mixed("{}", "{}"), &[]);
    let euler = decided(&study, "functional.euler");
    let detail = euler.detail();
    assert_eq!(euler.word(), "proved", "{detail}");
    assert!(
        detail.contains("mu ≠ 0") && detail.contains("lambda"),
        "{detail}"
    );
}

/// A bar of a nanometre, and one of an astronomical unit.
#[test]
fn bodies_of_any_size_have_counterexamples() {
    for length in ["1/1000000000", "150000000000", "1"] {
        for (equation, wanted) in [
            ("u,xx + 2 = 0", "refuted"),
            ("u,xx + 1 = 0", "proved"),
            ("u,xx + 1 + x = 0", "refuted"),
        ] {
            let text = format!(
                "kind = \"functional\"\nname = \"bar\"\ndensity = \"u,x^2/2 - u\"\nyields = [\"e\"]\n[domain]\ncoordinates = [\"x\"]\n\
                 intervals = {{ x = [0, \"{length}\"] }}\n[fields]\nu = \"scalar\"\n[boundary]\n\"x = 0\" = {{ fixed = [\"u\"] }}\n\
                 \"x = {length}\" = {{ fixed = [\"u\"] }}\n[equations]\ne = \"{equation}\"\n"
            );
            let study = studied_text("p4p", &text, &[]);
            let verdict = decided(&study, "functional.euler");
            assert_eq!(
                verdict.word(),
                wanted,
                "{length}, {equation}: {}",
                verdict.detail()
            );
        }
    }
}

fn solution(density: &str, interval: &str, ends: &str, equation: &str, own: &str) -> Verdict {
    let text = format!(
        "kind = \"functional\"\nname = \"own\"\ndensity = \"{density}\"\nyields = [\"e\"]\n[domain]\ncoordinates = [\"r\"]\n\
         intervals = {{ r = {interval} }}\n[fields]\nw = \"scalar\"\n[boundary]\n{ends}\n[equations]\ne = \"{equation}\"\n\
         [solutions.s]\nfields = {{ w = \"{own}\" }}\n"
    );
    decided(&studied_text("p4p", &text, &[]), "functional.solution").clone()
}

/// A membrane between two circles, by hand: (r w')' = -r, w(1) = 0, w'(2) = 0. And an exponential with fixed ends.
#[test]
fn solutions_need_not_be_polynomials() {
    let ends = "\"r = 1\" = { fixed = [\"w\"] }\n\"r = 2\" = \"0\"";
    let membrane = "r (1/2 w,r^2 - w)";
    let equation = "w,rr + w,r/r + 1 = 0";
    for (own, wanted) in [
        ("2 log(r) - (r^2 - 1)/4", "proved"),
        ("3 log(r) - (r^2 - 1)/4", "refuted"),
    ] {
        let verdict = solution(membrane, "[1, 2]", ends, equation, own);
        assert_eq!(verdict.word(), wanted, "{own}: {}", verdict.detail());
    }
    let ends = "\"r = 1\" = { fixed = [\"w\"] }\n\"r = 2\" = { fixed = [\"w\"] }";
    for (own, wanted) in [("exp(r)", "proved"), ("exp(2 r)", "refuted")] {
        let verdict = solution("w,r^2/2 + w^2/2", "[1, 2]", ends, "w,rr = w", own);
        assert_eq!(verdict.word(), wanted, "{own}: {}", verdict.detail());
    }
}

/// (1 − β)/(1 − β) is one for β ≠ 1, and no number there: what cancels is said, as what stays.
#[test]
fn what_is_divided_by_is_named_also_where_it_cancels() {
    let euler = |density: &str, more: &str| {
        let text = format!(
            "kind = \"functional\"\nname = \"m\"\ndensity = \"{density}\"\nyields = [\"e\"]\n{more}[domain]\ncoordinates = [\"x\"]\n\
             intervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n[data]\nf = \"scalar\"\n[parameters]\nbeta = {{}}\n[define]\nr = \"(1 - beta)/(1 - beta)\"\n\
             [boundary]\n\"x = 0\" = {{ fixed = [\"u\"] }}\n\"x = 1\" = {{ fixed = [\"u\"] }}\n[equations]\ne = \"u,xx + f = 0\"\n"
        );
        let study = studied_text("p4p", &text, &[]);
        let verdict = decided(&study, "functional.euler");
        assert_eq!(verdict.word(), "proved", "{density}: {}", verdict.detail());
        verdict.detail().to_owned()
    };
    for density in [
        "(1 - beta)/(1 - beta) 1/2 u,x^2 - f u",
        "r/2 u,x^2 - f u",
        "(1 - beta) (1 - beta)^(-1) 1/2 u,x^2 - f u",
        "1/2 u,x^2 - 2 f (u - beta u)/(2 - 2 beta)",
    ] {
        let detail = euler(density, "");
        assert!(detail.contains("beta - 1 ≠ 0"), "{density}: {detail}");
        // Where it is assumed nothing is to be said.
        let detail = euler(density, "assumptions = [\"beta > 2\"]\n");
        assert!(!detail.contains('≠'), "{density}: {detail}");
    }
    assert!(!euler("1/2 u,x^2 - f u", "").contains('≠'));
    assert!(euler("1/2 u,x^2 - f u^2/u", "").contains("u != 0"));
}

/// atan(tan u') is u' between its jumps, where u' is an odd multiple of π/2; asin and acosh have derivatives inside of where they are defined alone.
#[test]
fn poles_and_ends_of_functions_are_said() {
    for (density, stated, said) in [
        ("atan(tan(u,x)) + u,x^2/2", "u,xx + q = 0", "cos(u,x) != 0"),
        (
            "atan(1/cot(u,x)) + u,x^2/2",
            "u,xx + q = 0",
            "sin(u,x) != 0",
        ),
        ("u,x^2/2", "u,xx + q + 0 acosh(u) = 0", ""),
        (
            "u,x^2/2 + sin(asin(u,x)) + asin(u,x) + acos(u,x)",
            "u,xx + q = 0",
            "1 - u,x^2 > 0",
        ),
    ] {
        let text = format!(
            "kind = \"functional\"\nname = \"own\"\ndensity = \"{density} - q u\"\nyields = [\"e\"]\n[domain]\n\
             coordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n[data]\nq = \"scalar\"\n[boundary]\n\
             \"x = 0\" = {{ fixed = [\"u\"] }}\n\"x = 1\" = {{ fixed = [\"u\"] }}\n[equations]\ne = \"{stated}\"\n"
        );
        let study = studied_text("p4p", &text, &[]);
        let own = decided(&study, "functional.euler");
        assert_eq!(own.word(), "proved", "{density}: {}", own.detail());
        assert!(own.detail().contains(said), "{density}: {}", own.detail());
    }
}

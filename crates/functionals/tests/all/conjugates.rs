//! Functions that are stated as Legendre conjugates and are none: the relation is refuted, and no proof uses it.

use crate::table::studied_text;
use chetaev_functionals::Study;

/// The functional of Hellinger and Reissner for a body with these two functions.
fn studied(d: &str, energy: &str, complementary: &str) -> Study {
    let text = format!(
        r#"
kind = "functional"
name = "hellinger-reissner"
density = "e_ij s_ij - B(s) - F_k u_k"
yields = ["material", "balance", "held", "pulled"]
[sizes]
d = {d}
[domain]
coordinates = "x_i"
boundary = ["S_u", "S_s"]
[fields]
s = "symmetric"
u = "vector"
[data]
F = "vector"
ubar = {{ kind = "vector", on = "S_u" }}
Pbar = {{ kind = "vector", on = "S_s" }}
[functions]
A = {{ of = "symmetric", conjugate = "B", value = "{energy}" }}
B = {{ of = "symmetric", conjugate = "A", value = "{complementary}" }}
[define]
e_ij = "1/2 (u_i,j + u_j,i)"
P_k = "n_i s_ik"
[boundary]
S_u = "-P_k (u_k - ubar_k)"
S_s = "-Pbar_k u_k"
[equations]
material = "s_ij = A'_ij(e)"
balance = "s_ik,i + F_k = 0"
held = {{ equation = "u_k = ubar_k", on = "S_u" }}
pulled = {{ equation = "P_k = Pbar_k", on = "S_s" }}
"#
    );
    studied_text("p4p", &text, &[])
}

/// The words of the verdicts on a claim, with what they say.
fn said(study: &Study, claim: &str) -> Vec<(String, String)> {
    let own = study.verdicts.iter().filter(|d| d.claim == claim);
    let of = |d: &chetaev_functionals::Decided| {
        let verdict = &d.finding.verdict;
        (verdict.word().to_owned(), verdict.detail().to_owned())
    };
    own.map(of).collect()
}

/// Pairs of which one gradient does not undo the other, although each does so on the values of the other.
const SINGULAR: &[(&str, &str, &str)] = &[
    // The deviator alone: the mean stress stays free of the strain.
    (
        "2",
        "(X_11 - X_22)^2/4 + X_12^2",
        "(X_11 - X_22)^2/4 + X_12^2",
    ),
    // The trace alone.
    ("2", "X_ii X_jj/2", "X_ii X_jj/8"),
    // One component alone.
    ("2", "X_11^2/2", "X_11^2/2"),
    // Nothing at all.
    ("1", "0", "0"),
    ("1", "X_11", "0"),
    // A square root undoes a square for positive strains only: e = −1 has s = 1, and B'(1) = 1.
    ("1", "X_11^3/3", "2/3 X_11^(3/2)"),
];

#[test]
fn a_singular_pair_is_refuted_and_proves_nothing() {
    for (d, energy, complementary) in SINGULAR {
        let study = studied(d, energy, complementary);
        let relations = said(&study, "functional.legendre");
        assert_eq!(relations.len(), 2);
        for (word, detail) in relations {
            assert_eq!(word, "refuted", "{energy}: {detail}");
        }
        for (word, detail) in said(&study, "functional.euler") {
            assert_eq!(word, "refuted", "{energy}: {detail}");
        }
    }
}

#[test]
fn a_regular_pair_is_proved_by_formula_or_by_a_definite_hessian() {
    let pairs = [
        ("2", "X_ij X_ij", "X_ij X_ij/4"),
        ("1", "X_11^4/4 + X_11^2/2 - X_11^4/4", "X_11^2/2"),
        // sinh and asinh; exp and log.
        (
            "2",
            "sum_ij(cosh(X_ij) - 1)",
            "sum_ij(X_ij asinh(X_ij) - sqrt(1 + X_ij^2) + 1)",
        ),
        ("1", "exp(X_11)", "X_11 log(X_11) - X_11"),
    ];
    for (d, energy, complementary) in pairs {
        let study = studied(d, energy, complementary);
        let claims = ["functional.legendre", "functional.euler"];
        for (word, detail) in claims.iter().flat_map(|claim| said(&study, claim)) {
            assert_eq!(word, "proved", "{energy}: {detail}");
        }
    }
}

#[test]
fn a_hessian_that_is_definite_off_a_gap_proves_nothing() {
    // A' = X − 1/X has two values of X for each of its own, although A'' = 1 + 1/X² is positive.
    let study = studied(
        "1",
        "X_11^2/2 - log(X_11^2)/2",
        "X_11^2/4 + X_11 sqrt(X_11^2 + 4)/4 + asinh(X_11/2)",
    );
    for (word, detail) in said(&study, "functional.legendre") {
        assert_ne!(word, "proved", "{detail}");
    }
    for (word, detail) in said(&study, "functional.euler") {
        assert_ne!(word, "proved", "{detail}");
    }
}

/// Of two conjugates one has a formula: that of the other follows where the gradient is linear, and is not guessed at where it is not.
#[test]
fn what_is_known_of_one_function_is_known_of_its_conjugate() {
    let word = |functions: &str, density: &str, stated: &str| {
        let text = format!(
            "kind = \"functional\"\nname = \"c\"\ndensity = \"{density}\"\nyields = [\"a\", \"b\", \"c\"]\n\
             assumptions = [\"E > 0\"]\n[domain]\ncoordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n\
             [fields]\nu = \"scalar\"\ne = \"scalar\"\ns = \"scalar\"\n[parameters]\nE = {{}}\n[functions]\n{functions}\n[boundary]\n\
             \"x = 0\" = {{ fixed = [\"u\"] }}\n\"x = 1\" = {{ fixed = [\"u\"] }}\n[equations]\na = \"{stated}\"\n\
             b = \"e = u,x\"\nc = \"s,x = 0\"\n"
        );
        let study = studied_text("p4p", &text, &[]);
        crate::table::decided(&study, "functional.euler")
            .word()
            .to_owned()
    };
    let of_a = |value: &str| {
        format!("A = {{ of = \"scalar\", value = \"{value}\", conjugate = \"B\" }}\nB = {{ of = \"scalar\", conjugate = \"A\" }}")
    };
    let of_b = "A = { of = \"scalar\", conjugate = \"B\" }\nB = { of = \"scalar\", value = \"X^2/(2 E)\", conjugate = \"A\" }";
    let densities = ["A(e) + s (u,x - e)", "s u,x - B(s) + (e - u,x)^2"];
    for functions in [of_a("E/2 X^2").as_str(), of_b] {
        for density in densities {
            for stated in ["s = E e", "s = A'(e)", "e = B'(s)", "e = s/E"] {
                assert_eq!(
                    word(functions, density, stated),
                    "proved",
                    "{functions} {density} {stated}"
                );
            }
            for stated in ["s = 2 E e", "e = 2 B'(s)"] {
                assert_eq!(
                    word(functions, density, stated),
                    "refuted",
                    "{functions} {density} {stated}"
                );
            }
        }
    }
    // s = sinh e is e = B'(s) for A = cosh e: it is true, and never refuted.
    let functions = of_a("cosh(X)");
    assert_eq!(word(&functions, densities[0], "s = sinh(e)"), "proved");
    assert_eq!(word(&functions, densities[1], "s = sinh(e)"), "proved");
    assert_ne!(
        word(&functions, densities[1], "s = 2 sinh(e/2) cosh(e/2)"),
        "refuted"
    );
}

/// A bar with two wells: A = (e² − 1)² has A'' = 12 e² − 4, which is negative at 0 and 8 at 1, so that its stress has up to three
/// strains, and no complementary energy undoes it. With one well, A = e⁴ + e², there is one.
#[test]
fn an_energy_with_two_wells_has_no_conjugate() {
    let study = |value: &str| {
        let text = format!(
            "kind = \"functional\"\nname = \"wells\"\ndensity = \"s u,x - B(s)\"\nyields = [\"a\", \"b\"]\n\
             [domain]\ncoordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\ns = \"scalar\"\n[functions]\n\
             A = {{ of = \"scalar\", value = \"{value}\", conjugate = \"B\" }}\nB = {{ of = \"scalar\", conjugate = \"A\" }}\n\
             [boundary]\n\"x = 0\" = {{ fixed = [\"u\"] }}\n\"x = 1\" = {{ fixed = [\"u\"] }}\n\
             [equations]\na = \"s = A'(u,x)\"\nb = \"s,x = 0\"\n"
        );
        studied_text("p4p", &text, &[])
    };
    // A'' = 3 X² − 100 is negative up to 5.8; exp X − 2 has its zero at log 2; − sin X has many.
    for value in ["(X^2 - 1)^2", "X^4/4 - 50 X^2", "exp(X) - X^2", "sin(X)"] {
        let two = study(value);
        let relations = said(&two, "functional.legendre");
        assert_eq!(relations.len(), 2);
        for (word, detail) in relations {
            assert_eq!(word, "not-applicable", "{detail}");
            assert!(detail.contains("opposite signs"), "{detail}");
        }
        for (word, detail) in said(&two, "functional.euler") {
            assert!(
                word == "undecided" || word == "not-applicable",
                "{word} {detail}"
            );
        }
    }
    // X + sign X is no linear gradient, so that no conjugate is computed as if it were.
    for (_, detail) in said(&study("X^2/2 + abs(X)"), "functional.legendre") {
        assert!(!detail.contains("computed"), "{detail}");
    }
    let one = study("X^4 + X^2");
    for (word, detail) in said(&one, "functional.euler") {
        assert_eq!(word, "proved", "{detail}");
    }
}

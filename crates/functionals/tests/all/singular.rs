//! Equations that are solved by dividing by fields or data: what follows where that does not vanish need not follow where it does.

use crate::table::{decided, studied_text};

/// Two fields with loads p and q in an interval, both held at the ends.
fn euler(
    density: &str,
    data: &str,
    assumptions: &str,
    stated: &[String; 2],
) -> (&'static str, String) {
    let held = "{ fixed = [\"v\", \"w\"] }";
    let text = format!(
        "kind = \"functional\"\nname = \"m\"\ndensity = \"{density}\"\nyields = [\"a\", \"b\"]\nassumptions = [{assumptions}]\n[domain]\n\
         coordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n[fields]\nv = \"scalar\"\nw = \"scalar\"\n[data]\n{data}\n\
         [boundary]\n\"x = 0\" = {held}\n\"x = 1\" = {held}\n[equations]\na = \"{}\"\nb = \"{}\"\n",
        stated[0], stated[1]
    );
    let study = studied_text("p4p", &text, &[]);
    let own = decided(&study, "functional.euler");
    (own.word(), own.detail().to_owned())
}

const STRINGS: &str = "v,x^2/2 - p v + w,x^2/2 - q w";
const LOADS: &str = "p = \"scalar\"\nq = \"scalar\"";

/// With A = v'' + p and B = w'' + q the equations v A + w B = 0 and −w A + v B = 0 hold for v = w = 0 whatever the loads, where A = p and B = q do
/// not vanish. Where v² + w² is assumed to be positive they say A = B = 0, as where the matrix has the determinant 1.
#[test]
fn a_determinant_of_fields_may_vanish() {
    let (a, b) = ("(v,xx + p)", "(w,xx + q)");
    let turned = [format!("v {a} + w {b} = 0"), format!("-w {a} + v {b} = 0")];
    let (word, detail) = euler(STRINGS, LOADS, "", &turned);
    assert_eq!(word, "refuted", "{detail}");
    let (word, detail) = euler(STRINGS, LOADS, "\"v > 0\"", &turned);
    assert_eq!(word, "proved", "{detail}");
    let sheared = [format!("{a} + w {b} = 0"), format!("{b} = 0")];
    let (word, detail) = euler(STRINGS, LOADS, "", &sheared);
    assert_eq!(word, "proved", "{detail}");
    assert!(!detail.contains("where"), "{detail}");
}

/// The same with coefficients that are given: r = s = 0 leaves nothing of the equations, so that they cannot be proved to be equivalent
/// without saying that r² + s² does not vanish.
#[test]
fn a_determinant_of_data_may_vanish() {
    let data = &format!("{LOADS}\nr = \"scalar\"\ns = \"scalar\"");
    let (a, b) = ("(v,xx + p)", "(w,xx + q)");
    let turned = [format!("r {a} + s {b} = 0"), format!("-s {a} + r {b} = 0")];
    let (word, detail) = euler(STRINGS, data, "", &turned);
    assert_ne!(word, "proved", "{detail}");
    let (word, detail) = euler(STRINGS, data, "\"r > 0\"", &turned);
    assert_eq!(word, "proved", "{detail}");
}

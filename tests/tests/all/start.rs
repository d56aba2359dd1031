//! Where a motion begins that nobody asked for.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev_tests::runs::{ended_text, Ask, Ended};

fn study(body: &str) -> Ended {
    ended_text(body, &Ask::default())
}

/// An expectation about a subject that does not exist can never be met.
#[test]
fn an_expectation_of_an_unknown_subject_is_unmet() {
    let body = "coordinates = [\"x\"]\nlagrangian = \"x'^2/2\"\n[expect]\n";
    let misspelt = study(&format!(
        "{body}\"formulation.equivalent#magi\" = \"proved\"\n"
    ));
    assert_eq!(misspelt.exit, 1);
    assert!(misspelt.text.contains("maggi"), "{}", misspelt.text);
    let right = study(&format!(
        "{body}\"formulation.equivalent#maggi\" = \"proved\"\n"
    ));
    assert_eq!(right.exit, 0, "{}", right.text);
}

/// Polar coordinates have no inertia in phi at the origin; a model without initial data does not mean to begin there.
#[test]
fn a_singular_origin_that_nobody_asked_for_is_a_note() {
    let polar = "coordinates = [\"r\", \"phi\"]\nlagrangian = \"(r'^2 + r^2 phi'^2)/2\"\n";
    let quotient = "coordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\nconstraints = [\"x'/y' = z\"]\n";
    for body in [polar, quotient] {
        let ended = study(body);
        let study = ended.study.unwrap_or_else(|| panic!("{}", ended.text));
        assert_eq!(ended.exit, 0);
        assert!(study.motion.is_none());
        assert!(study.notices.iter().any(|n| n.contains("[initial]")));
    }
    let asked = study(&format!("{polar}[initial]\nr = 0\nphi = 0\n"));
    assert_eq!(asked.exit, 2);
    // A system that is singular everywhere is refused all the same.
    let massless = "coordinates = [\"x\", \"y\"]\nlagrangian = \"x'^2/2 - y^2\"\n";
    assert_eq!(study(massless).exit, 2);
}

/// The cone q_3' = 3/2 √(…) is narrow, and least steps in the kinetic metric cross it to and fro: from rest its residual is
/// 3/2 √162, and every velocity q_3' above that satisfies it with q_1' = q_2' = 0.
#[test]
fn a_state_on_a_narrow_cone_of_velocities_is_found() {
    let cone = "\
coordinates = [\"q_1\", \"q_2\", \"q_3\"]
lagrangian = \"(20 q_1' + q_2' + q_3')^2/64 + 5 q_1'^2/4 + 5 (2 q_2' - 4 q_3')^2/2 + 5 q_2'^2/8 + 5 q_3'^2/8\"
constraints = [\"q_3' = 3/2 sqrt(4 (3 q_1' + 18 q_2')^2 + 90 q_1'^2 + 36 q_2'^2 + 162)\"]
[simulation]
t_end = 0.1
";
    let ended = study(cone);
    let found = ended.study.unwrap_or_else(|| panic!("{}", ended.text));
    assert_eq!(ended.exit, 0, "{}", ended.text);
    let motion = found.motion.expect("a motion from a state that was found");
    let [a, b, c] = motion.start.v[..] else {
        panic!("three velocities: {:?}", motion.start.v);
    };
    let root = 4.0 * (3.0 * a + 18.0 * b).powi(2) + 90.0 * a * a + 36.0 * b * b + 162.0;
    assert!((c - 1.5 * root.sqrt()).abs() < 1e-9, "{a} {b} {c}");
}

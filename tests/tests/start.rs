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

//! Maggi's equations (T2 §3).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};

#[test]
fn maggi_is_equivalent_to_routh() {
    for text in [SKATE, DISC, APPELL_HAMEL, PARTICLE, POLAR] {
        expect(&Case::new(text), "formulation.equivalent#maggi", "proved");
    }
}

/// Any choice of kinematic characteristics gives the same motion: an adapted frame, a whole frame, and dependent
/// quasi-velocities that stay implicit.
#[test]
fn quasi_velocities_of_every_kind() {
    let adapted = "[quasi_velocities]\nu = \"x' cos(phi) + y' sin(phi)\"\nw = \"phi'\"\n";
    let whole = format!("{adapted}s = \"y' cos(phi) - x' sin(phi)\"\n");
    for frame in [adapted, &whole] {
        let case = Case::new(&format!("{SKATE}{frame}"));
        let names: Vec<String> = case
            .equations("maggi")
            .variables
            .iter()
            .map(|v| v.name.clone())
            .collect();
        assert_eq!(names, ["u", "w"]);
        expect(&case, "formulation.equivalent#maggi", "proved");
    }
    let quasi = "[quasi_velocities]\nu = \"x' + y'\"\nw = \"x' - 2 y'\"\n";
    let squared = APPELL_HAMEL.replace("z' = a sqrt(x'^2 + y'^2)", "z'^2 = a^2 (x'^2 + y'^2)");
    assert_ne!(squared, APPELL_HAMEL);
    // Affine in z', solved; quadratic in it, implicit.
    for (text, relations) in [(APPELL_HAMEL, 0), (squared.as_str(), 1)] {
        let case = Case::new(&format!("{text}{quasi}"));
        assert_eq!(case.equations("maggi").relations.len(), relations);
        expect(&case, "formulation.equivalent#maggi", "proved");
    }
}

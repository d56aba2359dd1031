//! Special values of parameters at which there are more first integrals, or simpler ones.
#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "test code fails where it stands"
)]

use chetaev::symbolic::Verdict;
use chetaev_tests::searched::{made_up, within};

/// The special values of a model, with what is found there, as text.
fn specials(text: &str) -> Vec<(String, Vec<String>)> {
    within(&made_up(text), |cx, found| {
        let g = &cx.system.graph;
        let special = found.special.found.iter().map(|special| {
            let pairs = special.tie.pairs(g).into_iter();
            let pairs = pairs.map(|(a, b)| format!("{} = {}", g.text(a), g.text(b)));
            let pairs: Vec<String> = pairs.collect();
            let integrals = special.integrals.iter().map(|&e| g.text(e));
            (pairs.join(", "), integrals.collect())
        });
        special.collect()
    })
}

/// Suslov's body with w3 = 0: at K = 0, where a momentum vanishes, w1' = w2' = 0; where I2 = 1 + K² the reaction vanishes, and the moment of
/// momentum is constant in space. The skate under drag keeps u θ' where d/J = -c/m. All by hand.
#[test]
fn special_values_that_are_sums_or_make_momenta_vanish() {
    let suslov = "name = \"suslov\"\nparameters = [\"I2\", \"K\"]\nassumptions = [\"0 < theta < pi\"]\n[coordinates]\nphi = { unit = \"rad\" }\ntheta = { unit = \"rad\" }\npsi = { unit = \"rad\" }\n\
        [quasi_velocities]\nw1 = \"phi' sin(theta) sin(psi) + theta' cos(psi)\"\nw2 = \"phi' sin(theta) cos(psi) - theta' sin(psi)\"\n[define]\nw3 = \"phi' cos(theta) + psi'\"\n\
        [lagrangian]\nT = \"1/2 (w1^2 + I2 w2^2 + w3^2) + K w1 w3\"\n[constraints]\nc = \"w3 = 0\"\n";
    let found = specials(suslov);
    let at = |tie: &str| found.iter().find(|(own, _)| own == tie).map(|(_, own)| own);
    let zero = at("K = 0").unwrap_or_else(|| panic!("{found:?}"));
    assert!(
        zero.iter().any(|e| e == "w1") && zero.iter().any(|e| e == "w2"),
        "{zero:?}"
    );
    assert!(at("I2 = 1 + K^2").is_some(), "{found:?}");
    let skate = "name = \"skate\"\ncoordinates = [\"x\", \"y\", \"th\"]\nparameters = [\"m\", \"J\", \"c\", \"d\"]\nlagrangian = \"m (x'^2 + y'^2)/2 + J th'^2/2\"\n\
        [forces]\nx = \"-c x'\"\ny = \"-c y'\"\nth = \"-d th'\"\n[constraints]\nb = \"x' sin(th) = y' cos(th)\"\n";
    let found = specials(skate);
    let others: Vec<&String> = found
        .iter()
        .map(|(tie, _)| tie)
        .filter(|tie| !["c = 0", "d = 0"].contains(&&tie[..]))
        .collect();
    // Where J = m d/c speed and turning fade alike: the path is a circle, and y'/θ' - x is kept.
    assert_eq!(others, ["J = -m d/c", "J = m d/c"], "{found:?}");
    let of_circle = |(tie, own): &(String, Vec<String>)| {
        tie == "J = m d/c" && own.iter().any(|e| e == "y'/th' - x")
    };
    assert!(found.iter().any(of_circle), "{found:?}");
}

/// What L is where a parameter is zero has more integrals, by hand: quartic oscillators apart (the classical 0, 2 and 6 of
/// x⁴ + b x² y² + y⁴), a centre without its dipole, a swinging weight without gravity, Kepler's problem without 1/r² (Laplace's vector),
/// a sphere without a force, an inverse square without a spring.
#[test]
fn special_values_that_are_zero() {
    let planar = "coordinates = [\"x\", \"y\"]\n";
    let polar = "coordinates = [\"r\", \"th\"]\n";
    let model = |coordinates: &str, parameters: &str, t: &str, v: &str| {
        let list: Vec<String> = parameters.split(' ').map(|p| format!("\"{p}\"")).collect();
        let list = list.join(", ");
        format!("name = \"own\"\n{coordinates}parameters = [{list}]\n[lagrangian]\nT = \"{t}\"\nV = \"{v}\"\n")
    };
    let flat = "1/2 (x'^2 + y'^2)";
    for (text, tie, integral) in [
        (
            model(planar, "b", flat, "x^4 + b x^2 y^2 + y^4"),
            "b = 0",
            "x'^2 + 2 x^4",
        ),
        (
            model(planar, "b", flat, "x^4 + b x^2 y^2 + y^4"),
            "b = 6",
            "x' y' + 4 x^3 y + 4 x y^3",
        ),
        (
            model(polar, "e", "1/2 (r'^2 + r^2 th'^2)", "1/r + e r cos(th)"),
            "e = 0",
            "r^2 th'",
        ),
        (
            model(
                polar,
                "m M g",
                "1/2 (m + M) r'^2 + 1/2 m r^2 th'^2",
                "M g r - m g r cos(th)",
            ),
            "g = 0",
            "r^2 th'",
        ),
        (
            model(polar, "m k b", "1/2 m (r'^2 + r^2 th'^2)", "-k/r - b/r^2"),
            "b = 0",
            "m r^2 r' th' sin(th) + m r^3 th'^2 cos(th) - k cos(th)",
        ),
        (
            model(planar, "w a b", flat, "1/2 w^2 (x^2 + y^2) + a/x^2 + b/y^2"),
            "w = 0",
            "t x'^2 - x x' + 2 a t/x^2",
        ),
    ] {
        let found = specials(&text);
        let own = found.iter().find(|(own, _)| own == tie);
        let own = own.map(|(_, own)| own.as_slice()).unwrap_or_default();
        assert!(own.iter().any(|e| e == integral), "{text}{tie}: {found:?}");
    }
}

/// Springs between M > 0 and m > 0: M = -m is excluded whatever k is. Where y has no inertia no motion is determined: nothing is kept at
/// e = 0.
#[test]
fn special_values_that_are_none() {
    let springs = "name = \"springs\"\ncoordinates = [\"x\", \"y\"]\nparameters = [\"M\", \"m\", \"k\"]\nassumptions = [\"M > 0\", \"m > 0\"]\nlagrangian = \"M x'^2/2 + m y'^2/2 - k M m (x - y)^2/2\"\n";
    let ties: Vec<String> = specials(springs).into_iter().map(|(tie, _)| tie).collect();
    assert_eq!(ties, ["k = 0"]);
    let massless = "name = \"massless\"\ncoordinates = [\"x\", \"y\"]\nparameters = [\"e\"]\nlagrangian = \"(x'^2 + e y'^2)/2 - e x y\"\n";
    assert_eq!(specials(massless), []);
}

/// x'' = sin(w t): where w = 0 the particle is free. Hénon and Heiles'
/// system of the 16 : 1 case (Kasperczuk 1994) falls apart at D = 0, where x'² + A x² is simpler than the integral of degree four.
#[test]
fn special_values_in_functions_and_simpler_integrals() {
    let forced = "name = \"forced\"\ncoordinates = [\"x\"]\nparameters = [\"w\"]\nlagrangian = \"x'^2/2 + x sin(w t)\"\n";
    let free = ["x'", "t x' - x"].map(str::to_owned).to_vec();
    assert_eq!(specials(forced), [("w = 0".to_owned(), free)]);
    let quartic = "name = \"quartic\"\ncoordinates = [\"x\", \"y\"]\nparameters = [\"A\", \"D\"]\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2)\"\nV = \"1/2 A x^2 + 8 A y^2 + D x^2 y + 16/3 D y^3\"\n[search]\ndegree = 4\n";
    let found = specials(quartic);
    let [(tie, integrals)] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!(
        (&tie[..], &integrals[..]),
        ("D = 0", &["x'^2 + A x^2".to_owned()][..])
    );
}

/// Chaplygin's sleigh whose inertia J > 0 has no value: at J = 3 a² there is a further integral (checked by hand), at J = -3 a²/4 too,
/// which the assumption excludes.
#[test]
fn special_values_without_the_others_values_satisfy_the_assumptions() {
    let text = "name = \"sleigh\"\ncoordinates = [\"x\", \"y\", \"phi\"]\nparameters = {a = {}, J = {}}\nassumptions = [\"J > 0\", \"a > 0\"]\n\
        lagrangian = \"((x' - a phi' sin(phi))^2 + (y' + a phi' cos(phi))^2 + J phi'^2)/2\"\n[constraints]\nb = \"x' sin(phi) = y' cos(phi)\"\n";
    within(&made_up(text), |cx, found| {
        let g = &cx.system.graph;
        let specials = found.special.found.iter();
        let values: Vec<f64> = specials
            .flat_map(|special| special.tie.pairs(g))
            .flat_map(|(_, value)| g.evaluate_f64(&[value], &|_| Some(1.0)).expect("a value"))
            .collect();
        assert!(values.contains(&3.0), "{values:?}");
        assert!(values.iter().all(|&value| value > 0.0), "{values:?}");
    });
}

/// For all u(t) only y' and t y' - y are kept of x'' = u; for u = sin(3 t) also x' + cos(3 t)/3, which is no integral for other u.
#[test]
fn laws_of_controls_are_special_values() {
    let text = "name = \"driven\"\ncoordinates = [\"x\", \"y\"]\ncontrols = {u = \"sin(3 t)\"}\nlagrangian = \"(x'^2 + y'^2)/2\"\n[forces]\nx = \"u\"\n[integrals]\nG = \"x' + cos(3 t)/3\"\nF = \"x' + cos(2 t)/2\"\n";
    within(&made_up(text), |cx, found| {
        let family = cx.finding("noether.family");
        let said = family.verdict.detail();
        assert!(said.contains("this is for any function u(t)"), "{said}");
        let law = "for u = sin(3 t), as the model states: 3 x' + cos(3 t), ";
        assert!(said.contains(law), "{said}");
        assert_eq!(found.integrals.len(), 2, "{said}");
        match &cx.finding("noether.inverse#G").verdict {
            Verdict::Conditional { condition, .. } => assert_eq!(condition, "u = sin(3 t)"),
            other => panic!("{other:?}"),
        }
        assert_eq!(cx.finding("noether.inverse#F").verdict.word(), "refuted");
    });
}

/// `y' = u x'` is homogeneous: the energy is kept, but a control is a function of the time, whose shifts are no symmetry.
#[test]
fn controls_are_functions_of_the_time() {
    let text = "name = \"driven\"\ncoordinates = [\"x\", \"y\"]\ncontrols = {u = {}}\nlagrangian = \"(x'^2 + y'^2)/2 - y\"\n[constraints]\nc = \"y' = u x'\"\n";
    within(&made_up(text), |cx, _| {
        let found = cx.finding("noether.integral#1");
        let said = found.verdict.detail();
        assert!(said.contains("no symmetry under shifts of time"), "{said}");
    });
}

/// Where z' = a y x' becomes z' = 0 the plane motion of a free particle is left, with z, x', y' and x y' - y x'; with a - 1 in the place of
/// a that is so for the value that the model states. What is found for all a, x' √(1 + a² y²) among it, says nothing of z.
#[test]
fn constraints_that_lose_their_velocities_at_special_values() {
    for (factor, tie) in [("a", "a = 0"), ("(a - 1)", "a = 1")] {
        let text = format!(
            "name = \"plane\"\ncoordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n[parameters]\na = 1\n[constraints]\nc = \"z' = {factor} y x'\"\n"
        );
        let found = specials(&text);
        let own = found.iter().find(|(own, _)| own == tie);
        let (_, own) = own.unwrap_or_else(|| panic!("{found:?}"));
        assert!(own.contains(&"z".to_owned()), "{own:?}");
        assert!(own.contains(&"x y' - y x'".to_owned()), "{own:?}");
        assert_eq!(own.len(), 2, "{own:?}");
    }
}

/// On the cone z'² = a² (x'² + y'²) with uniform forces along x and z: with the reaction λ (-a² x', -a² y', z') and a = 1 the rate of x' z' is -gz x' - gx z',
/// that of y' z' is -gz y', whatever gx and gz are that the model states too.
#[test]
fn only_the_stated_values_that_matter_are_named() {
    let cone = "name = \"cone\"\ncoordinates = [\"x\", \"y\", \"z\"]\n[parameters]\na = 1\ngz = 2\ngx = 3\n[lagrangian]\nT = \"(x'^2 + y'^2 + z'^2)/2\"\nV = \"gz z + gx x\"\n[constraints]\nc = \"z'^2 = a^2 (x'^2 + y'^2)\"\n";
    let found = specials(cone);
    let own = found.iter().find(|(own, _)| own == "a = 1");
    let (_, own) = own.unwrap_or_else(|| panic!("{found:?}"));
    let mut own = own.clone();
    own.sort();
    assert_eq!(own, ["x' z' + gz x + gx z", "y' z' + gz y"], "{found:?}");
}

/// Beside letters with roots: z' = a y x' + (1 - a) x y' is z' = x y' at a = 0, z' = y x' at a = 1, and 2 z' = (x y)' at a = 1/2 (by hand).
#[test]
fn special_values_beside_roots() {
    let text = "name = \"mixed\"\ncoordinates = [\"x\", \"y\", \"z\"]\nparameters = [\"a\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n[constraints]\nc = \"z' = a y x' + (1 - a) x y'\"\n";
    let found = specials(text);
    for (tie, integral) in [
        ("a = 0", "y' sqrt(1 + x^2)"),
        ("a = 1", "x' sqrt(1 + y^2)"),
        ("a = 1/2", "x y - 2 z"),
    ] {
        let own = found.iter().find(|(own, _)| own == tie);
        let own = own.map(|(_, own)| own.as_slice()).unwrap_or_default();
        assert!(own.iter().any(|e| e == integral), "{tie}: {found:?}");
    }
}

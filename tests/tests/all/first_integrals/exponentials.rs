//! First integrals with exponentials, of linear motions and of rates that vanish.

use super::contains;

/// Linear motions: (x ± y) e^(∓t) of x' = y, y' = x; the eigenvalues (-3 ± √5)/2 and the double one -1 of damped springs; the speed
/// under drag and gravity, m y' + m²g/c, falls as e^(-c t/m).
#[test]
fn eigenfunctions_with_exponentials() {
    let model = |coordinates: &str, lagrangian: &str, rest: &str, integrals: &str| {
        format!(
            "name = \"linear\"\ncoordinates = [{coordinates}]\nlagrangian = \"{lagrangian}\"\n{rest}\n[integrals]\n{integrals}\n"
        )
    };
    let space = "(x'^2 + y'^2 + z'^2)/2";
    contains(
        &model(
            "\"x\", \"y\", \"z\"",
            space,
            "[constraints]\na = \"x' = y\"\nb = \"y' = x\"\nc = \"z' = x y\"",
            "a = \"(x + y) exp(-t)\"\nb = \"(x - y) exp(t)\"\nc = \"2 z - x^2\"",
        ),
        3,
    );
    contains(
        &model(
            "\"x\", \"y\"",
            "(x'^2 + y'^2)/2",
            "[constraints]\na = \"x' = x + y\"",
            "a = \"(x + y + y') exp(-t)\"\nb = \"y'\"",
        ),
        3,
    );
    contains(
        &model(
            "\"x\"",
            "x'^2/2 - x^2/2",
            "[forces]\nx = \"-3 x'\"",
            "a = \"(2 x' + (3 + sqrt(5)) x) exp((3 - sqrt(5)) t/2)\"\nb = \"(2 x' + (3 - sqrt(5)) x) exp((3 + sqrt(5)) t/2)\"",
        ),
        2,
    );
    contains(
        &model(
            "\"x\"",
            "x'^2/2 - x^2/2",
            "[forces]\nx = \"-2 x'\"",
            "a = \"(x' + x) exp(t)\"\nb = \"(x - t (x' + x)) exp(t)\"",
        ),
        2,
    );
    contains(
        "name = \"drag\"\ncoordinates = [\"y\"]\nparameters = { m = 2, c = 3, g = 1 }\nlagrangian = \"m y'^2/2 - m g y\"\n[forces]\ny = \"-c y'\"\n[integrals]\na = \"(y' + m g/c) exp(c t/m)\"\n",
        2,
    );
}

/// Underdamped and undamped oscillators (by hand): `e^(c t) (x'² + c x x' + k x²)` whatever the sign of c² - 4 k, and the phase; two that
/// are coupled, by their sum and difference; one with a periodic force; a central force with drag keeps `e^(c t) (x y' - y x')`.
#[test]
fn eigenfunctions_that_turn() {
    let model = |coordinates: &str, lagrangian: &str, rest: &str, integrals: &str| {
        format!("name = \"turning\"\ncoordinates = [{coordinates}]\nlagrangian = \"{lagrangian}\"\n{rest}\n[integrals]\n{integrals}\n")
    };
    contains(
        &model(
            "\"x\"",
            "x'^2/2 - 2 x^2",
            "",
            "a = \"x' sin(2 t) - 2 x cos(2 t)\"\nb = \"x' cos(2 t) + 2 x sin(2 t)\"",
        ),
        2,
    );
    // The moment of momentum of two equal damped oscillators decays as exp(-c t), whatever k is.
    contains(
        &model(
            "\"x\", \"y\"",
            "(x'^2 + y'^2)/2 - k (x^2 + y^2)/2",
            "parameters = { c = {}, k = {} }\n[forces]\nx = \"-c x'\"\ny = \"-c y'\"",
            "a = \"(x y' - y x') exp(c t)\"\nb = \"(x'^2 + c x x' + k x^2) exp(c t)\"",
        ),
        3,
    );
    let damped = "[forces]\nx = \"-c x'\"";
    contains(
        &model(
            "\"x\"",
            "x'^2/2 - k x^2/2",
            &format!("parameters = [\"c\", \"k\"]\n{damped}"),
            "a = \"exp(c t) (x'^2 + c x x' + k x^2)\"",
        ),
        1,
    );
    contains(
        &model(
            "\"x\"",
            "x'^2/2 - x^2",
            "[forces]\nx = \"-2 x'\"",
            "a = \"exp(2 t) (x'^2 + 2 x x' + 2 x^2)\"\nb = \"exp(t) ((x' + x) cos(t) + x sin(t))\"",
        ),
        2,
    );
    contains(
        &model(
            "\"x\", \"y\"",
            "(x'^2 + y'^2)/2 - (x^2 + y^2)/2 - (x - y)^2/2",
            "[forces]\nx = \"-x'/5\"\ny = \"-y'/5\"",
            "a = \"exp(t/5) ((x' + y')^2 + (x + y) (x' + y')/5 + (x + y)^2)\"\nb = \"exp(t/5) ((x' - y')^2 + (x - y) (x' - y')/5 + 3 (x - y)^2)\"",
        ),
        4,
    );
    // x'' + x = 3 sin(2 t): x + sin(2 t) is free.
    contains(
        &model(
            "\"x\"",
            "x'^2/2 - x^2/2 + 3 x sin(2 t)",
            "",
            "a = \"(x' + 2 cos(2 t))^2 + (x + sin(2 t))^2\"",
        ),
        2,
    );
    contains(
        &model(
            "\"x\", \"y\"",
            "(x'^2 + y'^2)/2 - k (x^2 + y^2)^2/2",
            "parameters = [\"c\", \"k\"]\n[forces]\nx = \"-c x'\"\ny = \"-c y'\"",
            "a = \"exp(c t) (x y' - y x')\"",
        ),
        1,
    );
}

/// Drag that grows with v² (by hand): `(k x'² - g) e^(-2 k x)` where it drives, `1/v - k t` in the plane; the isokinetic particle in
/// a linear field keeps `y' e^(-x²/2c²)`; `1/x' - 1/y'` under x'³ + y'³ + z'³ = 1; the momentum beside a control.
#[test]
fn rates_that_vanish_speeds_and_reciprocals() {
    let model = |coordinates: &str, rest: &str| {
        format!("name = \"made-up\"\ncoordinates = [{coordinates}]\n{rest}\n")
    };
    contains(
        &model(
            "\"x\"",
            "parameters = [\"k\", \"g\"]\nlagrangian = \"x'^2/2 - g x\"\n[forces]\nx = \"k x'^2\"\n[integrals]\na = \"(k x'^2 - g) exp(-2 k x)\"",
        ),
        1,
    );
    contains(
        &model(
            "\"x\", \"y\"",
            "parameters = [\"k\"]\nlagrangian = \"(x'^2 + y'^2)/2\"\n[forces]\nx = \"-k x' sqrt(x'^2 + y'^2)\"\ny = \"-k y' sqrt(x'^2 + y'^2)\"\n[integrals]\na = \"1/sqrt(x'^2 + y'^2) - k t\"\nb = \"x'/y'\"",
        ),
        3,
    );
    contains(
        &model(
            "\"x\", \"y\", \"z\"",
            "parameters = [\"c\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n[forces]\nx = \"-x\"\n[constraints]\na = \"x'^2 + y'^2 + z'^2 = c^2\"\n[integrals]\na = \"y' exp(-x^2/(2 c^2))\"\nb = \"y'/z'\"",
        ),
        3,
    );
    contains(
        &model(
            "\"x\"",
            "lagrangian = \"x'^2/2\"\n[controls]\nu = \"sin(3 t)\"\n[forces]\nx = \"u'\"\n[integrals]\na = \"x' - u\"",
        ),
        1,
    );
}

/// A bead on a turning rod, as a particle: r'' = w² r although sines and cosines of w t stand in its place, whose rates have the eigenvalues ±iw;
/// (r' - w r) exp(w t) and the energy of the turning frame are kept.
#[test]
fn a_bead_on_a_turning_rod() {
    let text = "name = \"rod\"\ncoordinates = [\"r\"]\nparameters = {m = 1, w = 1}\n[particles.p]\nmass = \"m\"\nposition = [\"r cos(w t)\", \"r sin(w t)\"]\nforce = [\"0\", \"0\"]\n[integrals]\ndecay = \"(r' - w r) exp(w t)\"\n";
    contains(text, 2);
}

//! Invariant measures, growth vectors and integrability by quadratures of the gallery and of models made up, as the literature has
//! them.
#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "test code fails where it stands"
)]

use chetaev::geometry::measure::measure;
use chetaev::mechanics::{Context, Prepared, Prover, System};
use chetaev::model::{load, NoFiles, Style};
use chetaev::study::registry;
use chetaev_tests::studied::{gallery_path, loaded};
use chetaev_tests::words::{in_parallel, none};

fn with<T>(system: &System, ask: impl FnOnce(&Context<'_>) -> T) -> T {
    let prepared = Prepared::new(system).expect("independent velocities");
    let known = registry();
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(system, terms, selection, &known, Prover::default());
    ask(&cx)
}

fn gallery(name: &str) -> System {
    let model = loaded(&gallery_path(&format!("{name}/model.toml")), &[]).model;
    System::from_model(&model.expect("the model is right")).expect("a system")
}

fn stated(text: &str) -> System {
    let loaded = load("model.toml", text, &NoFiles, &[]);
    match loaded.into_result() {
        Ok((model, _)) => System::from_model(&model).expect("a system"),
        Err(problems) => panic!("{text}{}", problems.render(Style::Plain)),
    }
}

/// System, claim, verdict, and what its sentence says.
type Expected = (&'static str, &'static str, &'static str, &'static str);

const GALLERY: &[Expected] = &[
    // A knife edge in the plane; Brockett's and Nelson's examples, and every text on nonholonomic path planning.
    ("skate-level", "distribution.growth", "proved", "(2, 3)"),
    (
        "vertical-rolling-disc",
        "distribution.growth",
        "proved",
        "(2, 3, 4)",
    ),
    // A ball that may spin: Montgomery 2002, section 6.
    (
        "chaplygin-sphere",
        "distribution.growth",
        "proved",
        "(3, 5)",
    ),
    // Through its mass centre the sleigh keeps the volume, beside it motions run into a line of steady ones: Bloch 2003, section 1.7.
    ("skate-level", "measure.invariant", "proved", "N = 1"),
    (
        "chaplygin-sleigh",
        "measure.invariant",
        "refuted",
        "no other smooth positive density",
    ),
    // The divergence is -y y'/(1 + y^2).
    (
        "particle-y-dx",
        "measure.invariant",
        "proved",
        "N = sqrt(1 + y^2)",
    ),
    (
        "vertical-rolling-disc",
        "measure.invariant",
        "proved",
        "N = 1",
    ),
    // Chaplygin 1903.
    (
        "chaplygin-sphere",
        "measure.invariant",
        "proved",
        "N = sqrt(",
    ),
    // Kozlov 1988: the axis of the constraint is no eigenvector of the inertia.
    (
        "suslov",
        "measure.invariant",
        "refuted",
        "no other smooth positive density",
    ),
    // Liouville's theorem in velocities, N = det W.
    (
        "heavy-top",
        "measure.invariant",
        "proved",
        "N = sin(theta)^2",
    ),
    // Spinning upright is steady, but asymptotically stable in one direction (Walker 1896): the volume shrinks on it.
    (
        "rattleback",
        "measure.invariant",
        "refuted",
        "the motion with w3 alone",
    ),
    // ρ' is constant and the direction is kept, so the divergence of the motion is that of 1/ρ across.
    (
        "appell-hamel",
        "measure.invariant",
        "proved",
        "N = 1/sqrt(x'^2 + y'^2)",
    ),
    // The direction of x', y' and the speed with the logarithm of the mass keep their values.
    (
        "rocket-on-appells-constraint",
        "liouville.integrable",
        "proved",
        "without a measure",
    ),
    // A linear equation for the speed with coefficients that depend on the time: its density is free of the place.
    ("sand-cart", "liouville.integrable", "proved", "a measure"),
    // Chaplygin 1903: integrable by Euler's and Jacobi's theorem.
    (
        "chaplygin-sphere",
        "liouville.integrable",
        "proved",
        "the measure",
    ),
    (
        "chaplygin-sleigh",
        "liouville.integrable",
        "proved",
        "without a measure",
    ),
    // Lagrange's top: the nutation with energy and two momenta.
    (
        "heavy-top",
        "liouville.integrable",
        "proved",
        "after phi, psi are left out",
    ),
    ("suslov", "liouville.integrable", "undecided", "missing"),
];

#[test]
fn the_gallery_as_the_literature_has_it() {
    let failures = in_parallel(GALLERY, |&(name, claim, verdict, part)| {
        with(&gallery(name), |cx| {
            let found = cx.finding(claim);
            let (word, detail) = (found.verdict.word(), found.verdict.detail());
            let right = word == verdict && detail.contains(part);
            match right {
                true => Vec::new(),
                false => vec![format!("{name}: {claim} is {word}: {detail}")],
            }
        })
    });
    none(failures.into_iter().flatten().collect());
}

/// Kozlov 1988: Suslov's problem has an invariant measure where the axis is an eigenvector of the inertia.
#[test]
fn suslov_with_an_axis_of_inertia() {
    let text = r#"
name = "suslov with a principal axis"
coordinates = ["phi", "theta", "psi"]
assumptions = ["0 < theta < pi"]
[lagrangian]
L = "(2 w1^2 + 3 w2^2 + 4 w3^2)/2"
[quasi_velocities]
w1 = "phi' sin(theta) sin(psi) + theta' cos(psi)"
w2 = "phi' sin(theta) cos(psi) - theta' sin(psi)"
w3 = "phi' cos(theta) + psi'"
[constraints]
axis = "w3 = 0"
"#;
    with(&stated(text), |cx| {
        let finding = cx.finding("measure.invariant");
        let detail = finding.verdict.detail();
        assert_eq!(finding.verdict.word(), "proved", "{detail}");
        assert!(detail.contains("N = sin(theta)"), "{detail}");
    });
}

/// A constraint that can be integrated: the circle on which the point stays is not left.
#[test]
fn integrable_constraints_do_not_reach_everything() {
    let text = r#"
name = "circle"
coordinates = ["xi", "y", "z"]
[lagrangian]
L = "(xi'^2 + y'^2 + z'^2)/2"
[constraints]
f = "xi xi' + y y' = 0"
"#;
    with(&stated(text), |cx| {
        let finding = cx.finding("distribution.growth");
        assert_eq!(finding.verdict.word(), "refuted");
        assert!(finding.verdict.detail().contains("growth vector is (2)"));
        let kept = chetaev::geometry::noether::found::found(cx);
        let kept = kept.as_ref().as_ref().expect("a search");
        let g = &cx.system.graph;
        let shown: Vec<String> = kept.integrals.iter().map(|i| g.text(i.shown)).collect();
        assert!(
            shown.iter().any(|s| s == "y^2 + xi^2" || s == "xi^2 + y^2"),
            "{shown:?}"
        );
    });
}

/// A damped point: the volume shrinks, and no density in the position makes up for it.
#[test]
fn damping_leaves_no_measure() {
    let text = r#"
name = "damped"
coordinates = ["x", "y"]
[lagrangian]
L = "(x'^2 + y'^2)/2 - x^4"
[forces]
x = "-x'"
"#;
    with(&stated(text), |cx| {
        let finding = cx.finding("measure.invariant");
        assert_eq!(
            finding.verdict.word(),
            "refuted",
            "{}",
            finding.verdict.detail()
        );
    });
}

/// Densities contain the time where the motion does: for y' = t x' with unit masses x'' = -t x'/(1 + t^2).
#[test]
fn densities_in_the_time() {
    let text = r#"
name = "rheonomic"
coordinates = ["x", "y"]
[lagrangian]
L = "(x'^2 + y'^2)/2"
[constraints]
f = "y' = t x'"
"#;
    with(&stated(text), |cx| {
        let found = measure(cx);
        let found = found.as_ref().as_ref().expect("a measure");
        let density = found.density.expect("a formula");
        assert_eq!(cx.system.graph.text(density), "sqrt(t^2 + 1)");
    });
}

/// A user's function of the position in the family.
#[test]
fn functions_of_the_user_join_the_family() {
    let text = |more: &str| {
        format!(
            "name = \"own\"\ncoordinates = [\"x\", \"y\"]\n[lagrangian]\nL = \"(x'^2 + y'^2)/2\"\n[forces]\nx = \"x' y'/(1 + y^2)\"\n{more}"
        )
    };
    // ln x' - atan y is kept, and so is x' exp(-atan y).
    let count = |more: &str| {
        with(&stated(&text(more)), |cx| {
            let found = chetaev::geometry::noether::found::found(cx);
            let found = found.as_ref().as_ref().expect("a search");
            found.integrals.len()
        })
    };
    // Both are found without that function too, as all three integrals that two coordinates can have; with it none is lost.
    assert_eq!(count(""), 3);
    assert_eq!(count("[search]\nfunctions = [\"exp(-atan(y))\"]\n"), 3);
}

/// The only density of coordinates is exp(2 x), up to a factor: it contains the ignorable x, so that the motion reduced by x has
/// no measure of that kind, although the whole motion has one. The springs of y and z are coupled so that few integrals are known.
#[test]
fn a_density_that_contains_what_is_left_out_is_none_of_the_reduced_motion() {
    let text = "name = \"drag\"\ncoordinates = [\"x\", \"y\", \"z\"]\n\
        lagrangian = \"1/2 (x'^2 + y'^2 + z'^2) - 1/2 (y^2 + z^2) - y^2 z^2\"\n[forces]\nx = \"-x'^2\"\n";
    with(&stated(text), |cx| {
        let measure = cx.finding("measure.invariant");
        assert_eq!(
            measure.verdict.word(),
            "proved",
            "{}",
            measure.verdict.detail()
        );
        let integrable = cx.finding("liouville.integrable");
        let (word, detail) = (integrable.verdict.word(), integrable.verdict.detail());
        assert_eq!(word, "undecided", "{detail}");
        assert!(detail.contains("after x"), "{detail}");
    });
}

/// A model of coordinates that are lengths with forces only, T = Σ q'²/2.
fn forced(coordinates: &str, forces: &[(&str, &str)], more: &str) -> System {
    let names: Vec<&str> = coordinates.split(' ').collect();
    let squares: Vec<String> = names.iter().map(|q| format!("{q}'^2")).collect();
    let forces: String = forces
        .iter()
        .map(|(q, force)| format!("{q} = \"{force}\"\n"))
        .collect();
    let list: Vec<String> = names.iter().map(|q| format!("\"{q}\"")).collect();
    stated(&format!(
        "name = \"forced\"\ncoordinates = [{}]\n{more}\n[lagrangian]\nT = \"({})/2\"\n[forces]\n{forces}",
        list.join(", "),
        squares.join(" + ")
    ))
}

fn verdict(system: &System) -> (String, String) {
    with(system, |cx| {
        let verdict = &cx.finding("measure.invariant").verdict;
        (verdict.word().to_owned(), verdict.detail().to_owned())
    })
}

/// With w = 1 + x², x'' = -w y'/(1 + 2 e x'), y'' = w (x' + e x'²): the density 1 + 2 e x' is kept, and with √(1 + x'²) for x'² it
/// is 1 + e x'/√(1 + x'²).
#[test]
fn densities_with_velocities_are_not_excluded() {
    let models: [[(&str, &str); 2]; 2] = [
        [
            ("x", "-(1 + x^2) y'/(1 + x'/2)"),
            ("y", "(1 + x^2) (x' + x'^2/4)"),
        ],
        [
            ("x", "-(1 + x^2) y'/(1 + x'/(2 sqrt(1 + x'^2)))"),
            ("y", "(1 + x^2) (x' + (sqrt(1 + x'^2) - 1)/2)"),
        ],
    ];
    for forces in models {
        let (word, detail) = verdict(&forced("x y", &forces, ""));
        assert_eq!(word, "undecided", "{detail}");
        assert!(detail.contains("are not excluded"), "{detail}");
    }
}

/// The angle φ enters the density exp(φ) of φ'' = sin φ, ψ'' = -φ' ψ': smooth on the line, and nothing that returns after a turn.
#[test]
fn coordinates_without_units_are_no_angles() {
    let text = |unit: &str, parameter: &str| {
        format!(
            "name = \"turning\"\nlagrangian = \"(phi'^2 + psi'^2)/2 - k cos(phi)\"\n[coordinates]\nphi = {unit}\npsi = {unit}\n[parameters]\nk = {parameter}\n[forces]\npsi = \"-phi' psi'\"\n"
        )
    };
    let (word, detail) = verdict(&stated(&text("{}", "1")));
    assert_eq!(word, "proved", "{detail}");
    assert!(
        detail.contains("exp(phi)") && detail.contains("phi is counted as of the whole line"),
        "{detail}"
    );
    let parameter = "{ value = 1, unit = \"1/s^2\" }";
    let (word, detail) = verdict(&stated(&text("{ unit = \"rad\" }", parameter)));
    assert_eq!(word, "undecided", "{detail}");
}

/// A blade that has to drift: nothing is at rest, so nothing is said of densities there.
#[test]
fn rest_that_is_not_admissible_excludes_nothing() {
    let text = r#"
name = "drifting sleigh"
coordinates = ["x", "y", "phi"]
[lagrangian]
T = "1/2 (x'^2 + y'^2) + 1/4 phi'^2 + 3/10 phi' (y' cos(phi) - x' sin(phi))"
[constraints]
blade = "x' sin(phi) - y' cos(phi) = 2/5"
"#;
    let (word, detail) = verdict(&stated(text));
    assert_eq!(word, "undecided", "{detail}");
}

/// x'' = -c x': at rest nothing moves, so `N div X̄ = -c N` would vanish there. The density exp(c t) changes with the time, and the
/// same equations from a Lagrangian with the time have the same verdict.
#[test]
fn damping_is_refuted_for_densities_free_of_the_time() {
    let own = "[search]\nfunctions = [\"exp(t/3)\"]";
    let (word, detail) = verdict(&forced("x", &[("x", "-x'/3")], own));
    assert_eq!(word, "refuted", "{detail}");
    assert!(detail.contains("free of the time"), "{detail}");
    assert!(detail.contains("N = exp(t/3)"), "{detail}");
    let (force, _) = verdict(&forced("x", &[("x", "-2 x - x'/3")], ""));
    let lagrangian = "name = \"osc\"\ncoordinates = [\"x\"]\n\
        lagrangian = \"exp(t/3) (1/2 x'^2 - x^2)\"\n";
    let (time, detail) = verdict(&stated(lagrangian));
    assert_eq!((&force[..], &time[..]), ("refuted", "refuted"), "{detail}");
}

/// x'' = -a x'² keeps N = exp(2 a x) dx dx', which does not return on a circle.
#[test]
fn densities_return_after_a_turn() {
    let text = |unit: &str| {
        format!(
            "name = \"drag\"\n[coordinates]\nx = {{ unit = \"{unit}\" }}\n[parameters]\n\
             a = {{ value = 0.5, unit = \"1/({unit})\" }}\nm = {{ value = 1, unit = \"kg\" }}\n\
             [lagrangian]\nT = \"1/2 m x'^2\"\n[forces]\nx = \"-a m x'^2\"\n"
        )
    };
    let (word, detail) = verdict(&stated(&text("rad")));
    assert_eq!(word, "refuted", "{detail}");
    assert!(detail.contains("turn"), "{detail}");
    let (word, detail) = verdict(&stated(&text("m")));
    assert_eq!(word, "proved", "{detail}");
    // ln N = 2 a x, as -div X̄ = 2 a x'.
    assert!(detail.contains("for N = exp(2 a x)"), "{detail}");
}

/// Liouville's density in velocities is the determinant of ∂²L/∂v², here (1 - v²/c²)^(-2) for two dimensions, not its root.
#[test]
fn the_density_of_a_relativistic_point() {
    let text = r#"
name = "relativistic"
coordinates = ["x", "y"]
[parameters]
c = 3
m = 1
E = 0.5
[lagrangian]
L = "-m c^2 sqrt(1 - (x'^2 + y'^2)/c^2) + E x"
"#;
    with(&stated(text), |cx| {
        let finding = cx.finding("measure.invariant");
        let detail = finding.verdict.detail();
        assert_eq!(finding.verdict.word(), "proved", "{detail}");
        assert!(detail.contains("η = (x', y')"), "{detail}");
        assert!(!detail.contains("root"), "{detail}");
    });
}

/// The measure of one motion in other velocities has another density, so these are named: with u along the blade it is 1, with y'
/// for it 1/sin φ, as u = y'/sin φ.
#[test]
fn the_velocities_of_a_density_are_named() {
    let text = |more: &str| {
        format!(
            "name = \"blade\"\ncoordinates = [\"x\", \"y\", \"phi\"]\n[lagrangian]\n\
             T = \"1/2 (x'^2 + y'^2 + phi'^2)\"\n{more}[constraints]\nblade = \"x' sin(phi) - y' cos(phi) = 0\"\n"
        )
    };
    let own = "[quasi_velocities]\nu = \"x' cos(phi) + y' sin(phi)\"\nw = \"phi'\"\n";
    let (_, detail) = verdict(&stated(&text(own)));
    assert!(
        detail.contains("η = (u, w), is invariant for N = 1;"),
        "{detail}"
    );
    let (_, detail) = verdict(&stated(&text("")));
    assert!(
        detail.contains("η = (x', phi'), is invariant for N = 1/abs(cos(phi));")
            || detail.contains("η = (y', phi'), is invariant for N = 1/abs(sin(phi));"),
        "{detail}"
    );
}

/// Separable constraints: y' = k y x' keeps y exp(-k x), x y' = k y x' keeps y x^(-k).
#[test]
fn integrals_of_constraints_are_named() {
    let found = |constraint: &str| {
        let text = format!(
            "name = \"int\"\ncoordinates = [\"x\", \"y\"]\n[parameters]\nk = 2\n[lagrangian]\n\
             T = \"1/2 (x'^2 + y'^2)\"\n[constraints]\nf = \"{constraint}\"\n"
        );
        with(&stated(&text), |cx| {
            let finding = cx.finding("model.constraints-integrable#weak");
            let g = &cx.system.graph;
            let formulas = finding.formulas.iter().map(|f| g.text(f.right));
            let detail = finding.verdict.detail().to_owned();
            (formulas.collect::<Vec<String>>(), detail)
        })
    };
    for (constraint, integral) in [
        ("y' = k y x'", "y exp(-k x)"),
        ("x y' = k y x'", "y x^(-k)"),
        ("x x' + y y' = 0", "x^2 + y^2"),
        ("3 x y' + 2 y x' = 0", "x^2 y^3"),
        ("cos(x) y' = 0", "y"),
    ] {
        let (formulas, detail) = found(constraint);
        assert_eq!(formulas, [integral], "{detail}");
        assert!(detail.contains(integral), "{detail}");
    }
}

/// Where brackets are independent is said: [∂y, ∂x + z y ∂z] = z ∂z, so that nothing leads off the plane z = 0; with y² ∂z (Martinet 1970)
/// one bracket is 2 y ∂z, and on y = 0 it takes two. tan φ of a skate has its poles, and no zero of the minor sec² φ.
#[test]
fn where_brackets_are_independent() {
    for (constraint, says) in [
        (
            "z' = z y x'",
            "(2, 3) where z ≠ 0 (elsewhere it was not looked at): every",
        ),
        (
            "z' = y^2 x'",
            "(2, 3) where y ≠ 0 (elsewhere it was not looked at): every",
        ),
        ("z' = y x'", "(2, 3): every configuration nearby"),
        (
            "x' sin(y) = z' cos(y)",
            "(2, 3): every configuration nearby",
        ),
    ] {
        let text = format!(
            "name = \"d\"\ncoordinates = [\"x\", \"y\", \"z\"]\n[lagrangian]\n\
             T = \"1/2 (x'^2 + y'^2 + z'^2)\"\n[constraints]\nf = \"{constraint}\"\n"
        );
        with(&stated(&text), |cx| {
            let finding = cx.finding("distribution.growth");
            let detail = finding.verdict.detail();
            assert!(detail.contains(says), "{constraint}: {detail}");
        });
    }
}

/// What constraints keep counts among the integrals, though it is in no family: with x y² z³ and the energy, and from the plane path
/// z = 0 of a coordinate that is fixed the coordinate itself.
#[test]
fn what_constraints_keep_is_an_integral() {
    let text = r#"
name = "kept"
coordinates = ["x", "y", "z", "phi"]
assumptions = ["x > 0", "y > 0", "z > 0"]
[lagrangian]
T = "1/2 (x'^2 + y'^2 + z'^2 + phi'^2)"
[constraints]
f = "x'/x + 2 y'/y + 3 z'/z = 0"
h = "phi' = 0"
"#;
    with(&stated(text), |cx| {
        let finding = cx.finding("noether.family");
        let g = &cx.system.graph;
        let shown: Vec<String> = finding.formulas.iter().map(|f| g.text(f.right)).collect();
        for integral in ["x y^2 z^3", "phi"] {
            assert!(shown.iter().any(|text| text == integral), "{shown:?}");
        }
    });
}

/// A mass with a law of its own is a state beside the coordinates: by hand, a drop that gathers fog at rest has `z'' = g - k z'²` and
/// `m' = k m z'`, whose divergence `-k z'` is that of 1/m; and a point of mass m + t with `m' = k x'` has the variables x', m and t.
#[test]
fn masses_with_a_law_of_their_own_are_states() {
    let drop = r#"
name = "drop"
coordinates = ["z"]
parameters = { k = 0.1, g = 9.8 }
masses = { m = { rate = "k m z'", initial = 1 } }
[particles.drop]
mass = "m"
position = ["z"]
force = ["m g"]
thrust = { absolute_velocity = [0] }
"#;
    with(&stated(drop), |cx| {
        let finding = cx.finding("measure.invariant");
        let detail = finding.verdict.detail();
        assert_eq!(finding.verdict.word(), "proved", "{detail}");
        let wanted = "N dq dη dM, with η = (z') and M = (m), is invariant for N = m;";
        assert!(detail.starts_with(wanted), "{detail}");
    });
    let point = r#"
name = "point"
coordinates = ["x"]
parameters = { k = 0.1, c = 2 }
masses = { m = { rate = "k x'", initial = 5 } }
[particles.p]
mass = "m + t"
position = ["x"]
force = ["-c x'^2"]
"#;
    with(&stated(point), |cx| {
        let finding = cx.finding("liouville.integrable");
        let detail = finding.verdict.detail();
        assert_eq!(finding.verdict.word(), "undecided", "{detail}");
        assert!(
            detail.contains("3 variables (the time is one of them) after x is left out"),
            "{detail}"
        );
    });
}

/// What a mass that grows by itself, or a coordinate, makes up for in the divergence is no measure of the rest: `x'' = -k x' - x` damps.
#[test]
fn a_measure_of_more_variables_is_none_of_fewer() {
    let text = r#"
name = "damped"
coordinates = ["x"]
parameters = { k = 0.1 }
masses = { m = { rate = "k m", initial = 5 } }
[particles.p]
mass = "m"
position = ["x"]
force = ["-m (k x' + x)"]
"#;
    with(&stated(text), |cx| {
        let finding = cx.finding("liouville.integrable");
        let detail = finding.verdict.detail();
        // m (x'^2 + k x x' + x^2) is an integral of the three variables, which keep dx dx' dm, and another one is the angle of
        // (x, x') in normal form, which grows with ln m.
        assert_eq!(finding.verdict.word(), "proved", "{detail}");
        assert!(
            detail.contains("3 variables, with 2 independent integrals"),
            "{detail}"
        );
    });
    let grown = r#"
name = "grown"
coordinates = ["x", "u", "y"]
[lagrangian]
L = "x'^2/2 + u'^2/2 - x^2/2"
[forces]
x = "-2 x'"
[constraints]
c = "y' = 2 y"
"#;
    with(&stated(grown), |cx| {
        assert_eq!(cx.finding("measure.invariant").verdict.word(), "proved");
        let finding = cx.finding("liouville.integrable");
        // The same with y for m, and u': two integrals of four variables.
        assert_eq!(finding.verdict.word(), "proved");
    });
}

/// A jet against the velocity has a divergence with the speed in it, which is not defined at rest: it is not affine.
#[test]
fn divergences_that_are_not_defined_at_rest() {
    let text = r#"
name = "jet"
coordinates = ["x", "z"]
parameters = { g = 9.81, c = 30, b = 0.2 }
[masses]
shell = "3 - b t"
[particles.rocket]
mass = "shell"
position = ["x", "z"]
force = [0, "-shell g"]
thrust = { exhaust_speed = "c" }
"#;
    with(&stated(text), |cx| {
        let finding = cx.finding("measure.invariant");
        let detail = finding.verdict.detail();
        assert_eq!(finding.verdict.word(), "undecided", "{detail}");
        assert!(
            detail.contains("is not affine in the velocities"),
            "{detail}"
        );
    });
}

/// x' = -x contracts all states to x = 0, and so does the circle with φ' = sin φ from its source to its sink: what keeps the formulas
/// 1/x and 1/sin φ is infinite there, and no smooth measure is kept. Of x' y = y' x the pole is that of the velocities chosen.
#[test]
fn formulas_that_are_infinite_at_sources_are_no_densities() {
    let text = |coordinates: &str, lagrangian: &str, constraint: &str| {
        format!(
            "name = \"flow\"\ncoordinates = [{coordinates}]\nlagrangian = \"{lagrangian}\"\n[constraints]\na = \"{constraint}\"\n"
        )
    };
    let plane = "\"x\", \"y\"";
    for constraint in ["x' = -x", "x' = 3 x", "x' = sin(x)"] {
        let (word, detail) = verdict(&stated(&text(plane, "(x'^2 + y'^2)/2", constraint)));
        assert_eq!(word, "refuted", "{constraint}: {detail}");
        assert!(detail.contains("neither zero nor infinite"), "{detail}");
    }
    let space = "\"x\", \"y\", \"z\"";
    let level = text(space, "(x'^2 + y'^2 + z'^2)/2", "x' y = y' x");
    let (word, detail) = verdict(&stated(&level));
    assert_eq!(word, "proved", "{detail}");
    assert!(
        detail.contains("where y = 0 these variables do not determine the motion"),
        "{detail}"
    );
}

/// x' = -x drives all to x = 0, which the corner of the other constraint hides from states of rest: 1/|x| is a density on each side.
#[test]
fn densities_end_where_they_are_infinite() {
    let model = "name = \"flow\"\ncoordinates = [\"x\", \"y\", \"w\"]\nlagrangian = \"(x'^2 + y'^2 + w'^2)/2\"\n[constraints]\na = \"x' = -x\"\nb = \"abs(y') = w'\"\n";
    let (word, detail) = verdict(&stated(model));
    assert_eq!(word, "proved", "{detail}");
    assert!(
        detail.contains("not where x = 0") && detail.contains("1/abs(x)"),
        "{detail}"
    );
}

/// Where the divergence is the rate of a polynomial in the velocities, as -1 is that of -(x + x') for x'' = 1 - x', and x that of
/// x x' - x'³/3 for y' = y x and x'' = 1: an exponential is smooth and positive everywhere, other than 1/y. With w = 1 + x² and
/// x'' = -w y', y'' = w (x' + y'²/4) the divergence w y'/2 is the rate of -x'/2.
#[test]
fn exponentials_of_velocities() {
    let drag = "name = \"drag\"\ncoordinates = [\"x\"]\nlagrangian = \"x'^2/2\"\n[forces]\nx = \"1 - x'\"\n";
    let carried = "name = \"carried\"\ncoordinates = [\"x\", \"y\"]\nlagrangian = \"(x'^2 + y'^2)/2 + x\"\n[constraints]\na = \"y' = y x\"\n";
    let forces = [("x", "-(1 + x^2) y'"), ("y", "(1 + x^2) (x' + y'^2/4)")];
    for (model, density) in [
        (stated(drag), "exp(x' + x)"),
        (stated(carried), "exp(x'^3/3 - x x')"),
        (forced("x y", &forces, ""), "exp(x'/2)"),
    ] {
        let (word, detail) = verdict(&model);
        assert_eq!(word, "proved", "{detail}");
        assert!(detail.contains(density), "{detail}");
    }
}

/// A mass that vanishes on a plane: the motion is straight and keeps dx dz dx' dz', and N = 1 is neither zero nor infinite anywhere. The
/// same with a mass that is spent.
#[test]
fn masses_that_vanish_leave_the_density_alone() {
    let place = "name = \"m\"\ncoordinates = [\"x\", \"z\"]\nparameters = { b = 0.3 }\n[masses]\nm = \"1 - b x\"\n\
        [particles.a]\nmass = \"m\"\nposition = [\"x\", \"z\"]\n";
    let time = "name = \"m\"\ncoordinates = [\"x\"]\nparameters = { b = 0.3 }\nmasses = { m = \"3 - b t\" }\n\
        [lagrangian]\nT = \"1/2 m x'^2\"\n";
    for text in [place, time] {
        let (word, detail) = verdict(&stated(text));
        assert_eq!(word, "proved", "{detail}");
        assert!(detail.contains("N = 1;"), "{detail}");
        assert!(!detail.contains("N is zero or infinite"), "{detail}");
    }
}

/// What is known of a measure is told as it is: with a mass that is lost the divergence -1/m - 1/5 is that of exp(5/m)/m; with a control u no
/// formula is found for exp(∫u dt); and with dry friction between two bodies it is kept off the jumps.
#[test]
fn measures_are_told_as_they_are_known() {
    let lost =
        "name = \"m\"\ncoordinates = [\"x\"]\nmasses = { m = { rate = \"-m/5\", initial = 1 } }\n\
        [lagrangian]\nT = \"1/2 m x'^2\"\nV = \"1/2 x^2\"\n[forces]\nx = \"-x'\"\n";
    let (word, detail) = verdict(&stated(lost));
    assert_eq!(word, "proved", "{detail}");
    assert!(detail.contains("N = exp(5/m)/m"), "{detail}");
    let control = "name = \"u\"\ncoordinates = [\"x\"]\ncontrols = { u = {} }\n\
        [lagrangian]\nT = \"1/2 x'^2\"\nV = \"1/2 x^2\"\n[forces]\nx = \"-u x'\"\n";
    let friction = "name = \"f\"\ncoordinates = [\"x\", \"y\"]\nparameters = { c = 0.3 }\n\
        [lagrangian]\nT = \"1/2 (x'^2 + y'^2)\"\nV = \"1/2 x^2 + y^2 + x^4\"\n\
        [forces]\nx = \"-c sign(x' - y')\"\ny = \"c sign(x' - y')\"\n";
    for (text, says) in [
        (control, "exists near almost every place, without a formula"),
        (friction, "an invariant measure is known where x' - y' ≠ 0"),
    ] {
        with(&stated(text), |cx| {
            let finding = cx.finding("liouville.integrable");
            let detail = finding.verdict.detail();
            assert_eq!(finding.verdict.word(), "undecided", "{detail}");
            assert!(detail.contains(says), "{detail}");
        });
    }
}

/// A body with I1 = I3 held so that w1 = w3: by hand `M' = M × w + λ (e1 - e3)` with M = (I1 w1, I2 w2, I1 w1) leaves w1 and w2 constant.
/// For arbitrary moments only the energy is kept, and no measure.
#[test]
fn integrals_and_measures_are_counted_for_the_same_parameters() {
    let text = r#"
name = "stated"
coordinates = ["phi", "theta", "psi"]
assumptions = ["I1 > 0", "I2 > 0", "I3 > 0", "0 < theta < pi"]
parameters = { I1 = 3, I2 = 2, I3 = 3 }
[define]
w1 = "phi' sin(theta) sin(psi) + theta' cos(psi)"
w2 = "phi' sin(theta) cos(psi) - theta' sin(psi)"
w3 = "phi' cos(theta) + psi'"
[lagrangian]
T = "1/2 (I1 w1^2 + I2 w2^2 + I3 w3^2)"
[constraints]
axis = "w1 = w3"
"#;
    with(&stated(text), |cx| {
        let finding = cx.finding("liouville.integrable");
        let (word, detail) = (finding.verdict.word(), finding.verdict.detail());
        assert_eq!(word, "conditional", "{detail}");
        assert!(
            detail.starts_with("for I1 = I3, as the model states, "),
            "{detail}"
        );
        let (_, general) = detail.split_once("for arbitrary values").expect("both");
        assert!(general.contains("1 integral"), "{detail}");
        assert!(!general.contains("measure is known"), "{detail}");
    });
}

/// Chaplygin's density is the root of a polynomial of the moments in cosines, times sin θ, with units as without them.
#[test]
fn chaplygins_density_is_readable() {
    with(&gallery("chaplygin-sphere"), |cx| {
        let found = measure(cx);
        let found = found.as_ref().as_ref().expect("a measure");
        let text = cx.system.graph.text(found.density.expect("a formula"));
        assert!(
            text.starts_with("sqrt(") && text.ends_with(" sin(theta)"),
            "{text}"
        );
        assert!(text.chars().count() < 300, "{text}");
        assert!(!text.contains("abs"), "{text}");
        let finding = cx.finding("measure.invariant");
        if let chetaev::symbolic::Verdict::Proved(proof) = &finding.verdict {
            assert!(!proof.on.contains("the argument of"), "{}", proof.on);
        }
    });
}

/// x'' = 0 for a mass that leaks by m' = -k m: N = 1/m is kept where m > 0, and m = 0 is no state at which the system might stay.
#[test]
fn a_mass_that_has_vanished_is_no_state() {
    let text = "name = \"leak\"\ncoordinates = [\"x\"]\nparameters = {k = 0.5}\nmasses = {m = {rate = \"-k m\", initial = 2}}\nlagrangian = \"m x'^2/2\"\n";
    let (found, detail) = verdict(&stated(text));
    assert_eq!(found, "proved", "{detail}");
}

/// On the sphere of speeds |v| = c the chart (y', z') ends at x' = 0, where the motion is determined: W = 1 and the gradient is 2 v. The
/// density exp(-27 z/c²) of these variables, for V = 9 z, is exp(-27 z/c²) |x'/y'| in (x', z'); the area of the sphere times exp(-18 z/c²),
/// that is c exp(-18 z/c²)/|x'| in (y', z'), is smooth and positive. So is dy dy' with x' = 0, x y' = z' and z' for y': N = 1/|x|. Where
/// x = y = 0 the constraint x x' + y y' = 0 has no gradient.
#[test]
fn densities_are_sought_that_do_not_end_with_the_variables() {
    let text = |coordinates: &str, lagrangian: &str, rest: &str| {
        format!(
            "name = \"c\"\ncoordinates = [{coordinates}]\nlagrangian = \"{lagrangian}\"\n{rest}"
        )
    };
    let space = "\"x\", \"y\", \"z\"";
    let free = "(x'^2 + y'^2 + z'^2)/2";
    let sphere = text(
        space,
        "(x'^2 + y'^2 + z'^2)/2 - 9 z",
        "parameters = { c = 2 }\n[constraints]\na = \"x'^2 + y'^2 + z'^2 = c^2\"\n[initial]\n\"x'\" = 2\n",
    );
    let chart = text(
        space,
        free,
        "[constraints]\na = \"x' = 0\"\nb = \"x y' = z'\"\n[velocities]\nindependent = [\"z'\"]\n",
    );
    let plane = text(
        "\"x\", \"y\"",
        "(x'^2 + y'^2)/2",
        "[constraints]\na = \"x x' + y y' = 0\"\n[initial]\nx = 1\n",
    );
    let ends =
        "these variables do not determine the motion; in others N is neither zero nor infinite";
    for (model, words) in [
        (
            sphere,
            ["N = sqrt((y'^2 + z'^2)/x'^2 + 1) exp(-18 z/c^2)", ends],
        ),
        (chart, ["N = sqrt(1 + 1/x^2)", ends]),
        (
            plane,
            [
                "where x^2 + y^2 = 0 the mass matrices are singular or infinite",
                "whatever N is there",
            ],
        ),
    ] {
        let (word, detail) = verdict(&stated(&model));
        assert_eq!(word, "proved", "{detail}");
        for words in words {
            assert!(detail.contains(words), "no `{words}` in: {detail}");
        }
    }
}

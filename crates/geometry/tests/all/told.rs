//! What verdicts on first integrals say: trivial functions, symmetries, numbers of integrals, special values of parameters, and what
//! functions of the model's own and a larger budget change.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::{expr, finding, framed, system, with_context};
use chetaev_geometry::noether::found::{found, Found};
use chetaev_mechanics::{Context, Prepared, Prover, Registry, System};
use std::collections::BTreeSet;

/// The verdict on a function that the model states as an integral.
fn stated(mut system: System, value: &str) -> (&'static str, String) {
    let g = std::sync::Arc::clone(&system.graph);
    system.integrals.push(("own".into(), expr(&g, value)));
    let found = finding(&system, "noether.inverse#own");
    (found.verdict.word(), found.verdict.detail().to_owned())
}

/// Constants in disguise are no integrals, everywhere or on the constraints.
#[test]
fn constants_are_trivial() {
    let particle = || {
        system(
            "x y z",
            "(x'^2 + y'^2 + z'^2)/2 - c*x",
            &[("f", "z' - y*x'")],
        )
    };
    for (value, says) in [
        ("sin(x)^2 + cos(x)^2", "is the constant 1;"),
        ("cosh(y)^2 - sinh(y)^2 + 2", "is the constant 3;"),
        ("(x*z + y*z)/(x + y)/z", "is the constant 1;"),
        (
            "(x + y)^2 - x^2 - 2*x*y - y^2 + 1/2",
            "is the constant 1/2;",
        ),
        ("3 + z' - y*x'", "is the constant 3 on the constraints;"),
        ("z' - y*x'", "vanishes on the constraints"),
    ] {
        let (word, detail) = stated(particle(), value);
        assert_eq!(word, "proved", "{value}: {detail}");
        let expected = detail.starts_with("trivial") && detail.contains(says);
        assert!(expected, "{value}: {detail}");
    }
    let (word, detail) = stated(particle(), "y'");
    assert_eq!(word, "proved", "{detail}");
    assert!(!detail.contains("trivial"), "{detail}");
}

/// On a circle x² + y² is fixed, and so are functions of it and of its rate; x is not.
#[test]
fn what_holonomic_constraints_fix_is_trivial() {
    let pendulum = || system("x y", "(x'^2 + y'^2)/2 - 3*y", &[("c", "x^2 + y^2 - 4")]);
    for value in [
        "x^2 + y^2",
        "exp(x^2 + y^2) + x*x' + y*y'",
        "(x^2 + y^2 - 4)*x'",
    ] {
        let (word, detail) = stated(pendulum(), value);
        assert_eq!(word, "proved", "{value}: {detail}");
        assert!(detail.starts_with("trivial"), "{value}: {detail}");
    }
    let (word, detail) = stated(pendulum(), "(x'^2 + y'^2)/2 + 3*y");
    assert_eq!(word, "proved", "{detail}");
    assert!(!detail.contains("trivial"), "{detail}");
    assert_eq!(stated(pendulum(), "x").0, "refuted");
}

/// `ρ x'` of `z' = y x'` belongs to a field that is no shift: `∂x + y ∂z` times a function; y' to virtual displacements along y, which
/// are no symmetry of the system, as its constraint contains y.
#[test]
fn symmetries_are_named_as_what_they_are() {
    let particle = system("x y z", "(x'^2 + y'^2 + z'^2)/2", &[("f", "z' - y*x'")]);
    let said: Vec<String> = (1..=3)
        .map(|j| {
            let found = finding(&particle, &format!("noether.integral#{j}"));
            found.verdict.detail().to_owned()
        })
        .collect();
    let says = |words: &str| said.iter().any(|detail| detail.contains(words));
    let along_y = "it belongs to the virtual displacements along y, which change neither L nor the forces; the constraint `f` contains y";
    assert!(says(along_y), "{said:#?}");
    assert!(!says("the symmetry under shifts of y"), "{said:#?}");
    assert!(says("∂/∂x") && says("∂/∂z"), "{said:#?}");
    assert!(!says("under shifts of x"), "{said:#?}");
    // A body's angular velocity is the speed of no coordinate.
    let top = framed(
        "phi theta psi",
        "A*(theta'^2 + phi'^2*sin(theta)^2)/2 + C*(psi' + phi'*cos(theta))^2/2 - cos(theta)",
        &[],
        &[
            ("w1", "phi'*sin(theta)*sin(psi) + theta'*cos(psi)"),
            ("w2", "phi'*sin(theta)*cos(psi) - theta'*sin(psi)"),
            ("w3", "phi'*cos(theta) + psi'"),
        ],
        &[],
    );
    with_context(&top, |cx| {
        let found = found(cx);
        let found: &Found = found.as_ref().as_ref().unwrap();
        for j in 1..=found.integrals.len() {
            let verdict = &cx.finding(&format!("noether.integral#{j}")).verdict;
            let detail = verdict.detail();
            assert!(!detail.contains("shifts of w"), "{detail}");
            let known = ["shifts of psi", "shifts of phi", "shifts of time"];
            assert!(known.iter().any(|k| detail.contains(k)), "{detail}");
        }
    });
}

/// Which independent velocities are cyclic, by hand: on the level skate both `3 w` and `2 u` are driven by nothing, on a slope only
/// `3 w`; beside the blade the mass centre drives both; of Euler's top `w3` where A = B; of `z' = y x'` the momentum `y'` only, as
/// `((1 + y²) x')' = y x' y'`.
#[test]
fn cyclic_velocities_are_named() {
    let skate = |lagrangian: &str| {
        let blade = [("blade", "x'*sin(phi) - y'*cos(phi)")];
        let speeds = [("u", "x'*cos(phi) + y'*sin(phi)"), ("w", "phi'")];
        framed("x y phi", lagrangian, &blade, &speeds, &[])
    };
    let top = |second: &str| {
        let lagrangian = format!("(A*w1^2 + {second}*w2^2 + C*w3^2)/2")
            .replace("w1", "(phi'*sin(theta)*sin(psi) + theta'*cos(psi))")
            .replace("w2", "(phi'*sin(theta)*cos(psi) - theta'*sin(psi))")
            .replace("w3", "(phi'*cos(theta) + psi')");
        let speeds = [
            ("w1", "phi'*sin(theta)*sin(psi) + theta'*cos(psi)"),
            ("w2", "phi'*sin(theta)*cos(psi) - theta'*sin(psi)"),
            ("w3", "phi'*cos(theta) + psi'"),
        ];
        framed("phi theta psi", &lagrangian, &[], &speeds, &[])
    };
    let particle = system("x y z", "(x'^2 + y'^2 + z'^2)/2", &[("f", "z' - y*x'")]);
    let level = "x'^2 + y'^2 + 3*phi'^2/2";
    for (own, all) in [
        (skate(level), "the independent velocities u, w are cyclic"),
        (
            skate(&format!("{level} + x")),
            "the independent velocity w is cyclic",
        ),
        (
            skate(&format!("{level} + phi'*(y'*cos(phi) - x'*sin(phi))")),
            "",
        ),
        (top("B"), ""),
        (top("A"), "the independent velocity w3 is cyclic"),
        (particle, "the independent velocity y' is cyclic"),
    ] {
        let found = finding(&own, "liouville.integrable");
        let detail = found.verdict.detail();
        match all {
            "" => assert!(!detail.contains("cyclic"), "{detail}"),
            all => assert!(detail.contains(all), "{detail}"),
        }
    }
    let said = said_of(&skate(level), "u");
    let cyclic = "the momentum of the cyclic independent velocity u, which nothing drives";
    assert!(said.contains(cyclic), "{said}");
}

/// What is said of the integral of a system that is a certain function.
fn said_of(system: &System, function: &str) -> String {
    let g = &system.graph;
    with_context(system, |cx| {
        let found = found(cx);
        let found: &Found = found.as_ref().as_ref().unwrap();
        let wanted = expr(g, function);
        let is_it = |shown| g.is_zero(g.sub(shown, wanted)) || g.is_zero(g.add(&[shown, wanted]));
        let place = found.integrals.iter().position(|i| is_it(i.shown));
        let place = place.unwrap_or_else(|| panic!("{function} was not found"));
        let finding = cx.finding(&format!("noether.integral#{}", place + 1));
        finding.verdict.detail().to_owned()
    })
}

/// The energy is kept where constraints are homogeneous, though they contain the time: the system has no symmetry under its shifts. Of
/// `z' + t` under gravity the motion has one under shifts of z, though L changes by a constant; a constraint `y = t` is another one later.
#[test]
fn symmetries_are_those_of_the_system() {
    let turning = system("x y", "(x'^2 + y'^2)/2 - g*y", &[("c", "y' - a*t*x'")]);
    let energy = said_of(&turning, "x'^2/2 + y'^2/2 + g*y");
    assert!(
        energy.contains("the constraint `c` contains t, so that the system has no symmetry under shifts of time"),
        "{energy}"
    );
    let resting = system("x y", "(x'^2 + y'^2)/2 - g*y", &[("c", "y' - a*y*x'")]);
    let energy = said_of(&resting, "x'^2/2 + y'^2/2 + g*y");
    assert!(
        energy.contains("it belongs to the symmetry under shifts of time"),
        "{energy}"
    );
    let falling = system("x y z", "(x'^2 + y'^2 + z'^2)/2 - z", &[("c", "y' - x*x'")]);
    let momentum = said_of(&falling, "z' + t");
    assert!(
        momentum.contains("it belongs to the symmetry under shifts of z"),
        "{momentum}"
    );
    let moved = system("x y", "(x'^2 + y'^2)/2", &[("c", "y - t")]);
    let stated = with_context(&moved, |cx| {
        let found = found(cx);
        let found: &Found = found.as_ref().as_ref().unwrap();
        (1..=found.integrals.len())
            .map(|j| {
                cx.finding(&format!("noether.integral#{j}"))
                    .verdict
                    .detail()
                    .to_owned()
            })
            .collect::<Vec<String>>()
    });
    assert!(
        !stated
            .iter()
            .any(|s| s.contains("the symmetry under shifts of time")),
        "{stated:#?}"
    );
}

/// One more is one more.
#[test]
fn numbers_agree_with_their_nouns() {
    let falling = system("x", "x'^2/2 - cos(x)", &[]);
    let detail = finding(&falling, "noether.family")
        .verdict
        .detail()
        .to_owned();
    assert!(!detail.contains("two of these"), "{detail}");
    for text in ["1 is a", "1 are", "ones 1 "] {
        assert!(!detail.contains(text), "{detail}");
    }
}

/// Whether special values were looked at is said, also where nothing is found there.
#[test]
fn special_values_are_accounted_for() {
    let says = |lagrangian: &str| {
        let own = system("x y", lagrangian, &[]);
        finding(&own, "noether.family").verdict.detail().to_owned()
    };
    // Two springs of different strength: of equal strength the momentum is one more.
    let springs = says("(x'^2 + y'^2)/2 - a*x^2 - b*y^2");
    assert!(
        springs.contains("there are further or simpler ones where"),
        "{springs}"
    );
    let pendulum = says("x'^2/2 + y'^2/2 - k*cos(x) - k*cos(y)^3");
    assert!(
        pendulum.contains("exhausted: where parameters are equal or zero or as stated, "),
        "{pendulum}"
    );
    let free = says("x'^2/2 + y'^2/2 - cos(x) - cos(y)^3");
    assert!(!free.contains("parameters"), "{free}");
}

/// Twelve functions of the model's own take nothing away: all families without them are searched as they are without them.
#[test]
fn functions_of_the_model_are_additional() {
    let usual = system("x y z", "(x'^2 + y'^2 + z'^2)/2", &[("f", "z' - y*x'")]);
    let mut own = system("x y z", "(x'^2 + y'^2 + z'^2)/2", &[("f", "z' - y*x'")]);
    let g = std::sync::Arc::clone(&own.graph);
    for k in 1..=12 {
        let function = format!("log({k} + x^2 + {k}*y^2)");
        own.search_functions.push(expr(&g, &function));
    }
    let searched = |system: &System| {
        with_context(system, |cx| {
            let found = found(cx);
            let found: &Found = found.as_ref().as_ref().unwrap();
            let shown = found.integrals.iter().map(|i| system.graph.text(i.shown));
            let families = found.families.iter();
            let families = families.map(|f| (f.family.words.clone(), f.dimension));
            let momenta = found.momenta.iter().map(|m| (m.weight, m.dimension));
            (
                shown.collect::<BTreeSet<String>>(),
                families.collect::<Vec<_>>(),
                momenta.collect::<Vec<_>>(),
            )
        })
    };
    let ((shown, families, momenta), (more, all, every)) = (searched(&usual), searched(&own));
    assert!(shown.is_subset(&more), "{shown:?} of {more:?}");
    assert_eq!(all[..families.len()], families[..]);
    assert!(all.len() > families.len());
    assert_eq!(every[..momenta.len()], momenta[..]);
}

/// Of `z' = y x'` the functions of degree two are y', ρ x', ρ = √(1 + y²), and their three products (T3 §8.2); of a free particle in a plane
/// under gravity x'² is one, while x' times the energy is of degree three.
#[test]
fn products_are_marked() {
    let products = |own: &System, factors: [&str; 2]| {
        let g = &own.graph;
        with_context(own, |cx| {
            let found = found(cx);
            let found: &Found = found.as_ref().as_ref().unwrap();
            let place = |text: &str| {
                let wanted = expr(g, text);
                let at = |i: &chetaev_geometry::noether::search::Integral| {
                    g.is_zero(g.sub(i.shown, wanted))
                };
                found.integrals.iter().position(at).unwrap()
            };
            let [a, b] = factors.map(place);
            let detail = cx.finding("noether.family").verdict.detail().to_owned();
            let marked = |i: usize, j: usize| {
                let (i, j) = (i.min(j), i.max(j));
                let named = match i == j {
                    true => format!("G{}^2", i + 1),
                    false => format!("G{} G{}", i + 1, j + 1),
                };
                let listed = found.dependent.products.contains(&(i, j));
                assert_eq!(detail.contains(&named), listed, "{named}: {detail}");
                listed
            };
            [marked(a, a), marked(a, b), marked(b, b)]
        })
    };
    let particle = system("x y z", "(x'^2 + y'^2 + z'^2)/2", &[("f", "z' - y*x'")]);
    assert_eq!(products(&particle, ["y'", "x'*sqrt(1 + y^2)"]), [true; 3]);
    let falling = system("x y", "(x'^2 + y'^2)/2 - y", &[]);
    let energy = "(x'^2 + y'^2)/2 + y";
    assert_eq!(products(&falling, ["x'", energy]), [true, false, false]);
}

/// Four times the work looks among more quotients and more generalized momenta.
#[test]
fn quotients_and_momenta_grow_with_the_budget() {
    let thrown = system("x y", "(x'^2 + y'^2)/2 - y", &[]);
    let prepared = Prepared::new(&thrown).unwrap();
    let registry = Registry::new(&[chetaev_mechanics::claims::CLAIMS, chetaev_geometry::CLAIMS]);
    let sizes = |work: f64| {
        let (terms, selection) = (&prepared.terms, &prepared.selection);
        let cx = Context::new(&thrown, terms, selection, &registry, Prover::default());
        let cx = cx.allowing(work);
        let found = found(&cx);
        let found: &Found = found.as_ref().as_ref().unwrap();
        let quotients = found
            .families
            .iter()
            .find(|f| f.family.words.starts_with("quotients"));
        let momenta = found.momenta.first().unwrap();
        (
            quotients.unwrap().family.members.len(),
            momenta.functions.len(),
        )
    };
    let (small, large) = (sizes(1.0), sizes(4.0));
    assert!(
        large.0 > small.0 && large.1 > small.1,
        "{small:?} {large:?}"
    );
}

/// Three bodies on rods: T + V as the model states it, not `Σ p v - L` worked out.
#[test]
fn the_energy_is_shown_as_the_model_states_it() {
    let kinetic = "m*(x'^2 + y'^2)/2 + M*((x' + d*a'*sin(a))^2 + (y' - d*a'*cos(a))^2)/2 \
        + N*((x' + d*a'*sin(a) + e*b'*sin(b))^2 + (y' - d*a'*cos(a) - e*b'*cos(b))^2)/2";
    let lagrangian = format!("{kinetic} - m*g*y + k*(x*y' - y*x')");
    let chain = system("x y a b", &lagrangian, &[]);
    let g = &chain.graph;
    with_context(&chain, |cx| {
        let found = found(cx);
        let found: &Found = found.as_ref().as_ref().unwrap();
        let name = Some("the energy".to_owned());
        let energy = found.integrals.iter().find(|i| i.name == name).unwrap();
        let expected = expr(g, &format!("{kinetic} + m*g*y"));
        assert_eq!(g.text(energy.shown), g.text(expected));
    });
}

/// The special cases: no constraints with and without a frame; `[X, Y] ≠ 0` across `z' = y x'`; `x x' + y y' = 0`, whose fields commute; a
/// cone in the velocities, which is none of them.
#[test]
fn special_cases_of_the_embedded_equations_are_named() {
    let says = |system: &System| {
        let verdict = finding(system, "noether.embedded").verdict.clone();
        assert_eq!(verdict.word(), "proved", "{}", verdict.detail());
        let detail = verdict.detail().to_owned();
        assert!(detail.contains("its kernel is the line of X̄"), "{detail}");
        detail
    };
    let kinetic = "(x'^2 + y'^2 + z'^2)/2";
    let free = says(&system("x y z", kinetic, &[]));
    assert!(
        free.contains("the natural basis without constraints"),
        "{free}"
    );
    let turned = framed("x", "x'^2/2 - x", &[], &[("u", "x'*exp(x)")], &[]);
    let turned = says(&turned);
    assert!(
        turned.contains("quasi-velocities without constraints"),
        "{turned}"
    );
    let contact = says(&system("x y z", kinetic, &[("c", "z' - y*x'")]));
    assert!(
        contact.contains("the case of an adapted frame"),
        "{contact}"
    );
    let circles = says(&system("x y z", kinetic, &[("c", "x*x' + y*y'")]));
    assert!(circles.contains("the holonomic case"), "{circles}");
    let cone = says(&system("x y z", kinetic, &[("c", "z'^2 - x'^2 - y'^2")]));
    assert!(cone.contains("none of the special cases"), "{cone}");
}

/// What was found is one short sentence; each family that was exhausted is a part of its own, in which none of it is lost.
#[test]
fn families_are_listed_after_a_short_sentence() {
    let contact = system("x y z", "(x'^2 + y'^2 + z'^2)/2", &[("c", "z' - y*x'")]);
    with_context(&contact, |cx| {
        let found = found(cx);
        let found: &Found = found.as_ref().as_ref().unwrap();
        let detail = cx.finding("noether.family").verdict.detail().to_owned();
        let mut parts = detail.split("; exhausted: ");
        let first = parts.next().unwrap();
        assert!(first.chars().count() < 400, "{first}");
        let parts: Vec<&str> = parts.collect();
        for (searched, part) in found.families.iter().zip(&parts) {
            assert!(part.starts_with(&searched.family.words), "{part}");
            assert!(
                part.ends_with(&format!("dimension {}", searched.dimension)),
                "{part}"
            );
        }
        assert!(parts.len() >= found.families.len());
    });
}

/// The rate of log(x) has a value where log(x) has none: such states refute nothing, and functions that have a value far from the origin
/// only are decided there. The motions are x = x0 cos t + v0 sin t, and uniform ones.
#[test]
fn functions_are_decided_where_they_have_a_value() {
    let oscillator = || system("x", "x'^2/2 - x^2/2", &[]);
    // x |x| is x^2 for x > 0, where the logarithms cancel, and -x^2 elsewhere.
    let (word, detail) = stated(oscillator(), "x'^2 + x*abs(x) + log(x) - log(abs(x))");
    assert_eq!(word, "proved", "{detail}");
    assert!(
        detail.starts_with("it has a real value where x > 0 only"),
        "{detail}"
    );
    let (word, detail) = stated(oscillator(), "x'^2 + x*abs(x) + log(-x) - log(abs(x))");
    assert_eq!(word, "refuted", "{detail}");
    assert!(detail.contains(" x = -"), "{detail}");
    for (value, symbol) in [
        ("log(x')", "x'"),
        ("sqrt(x' - 5)", "x'"),
        ("x*log(x - 100)", "x"),
    ] {
        let (word, detail) = stated(oscillator(), value);
        assert_eq!(word, "refuted", "{value}: {detail}");
        let (_, at) = detail.split_once(&format!(" {symbol} = ")).unwrap();
        let digits = at.find(|c: char| !"-0123456789".contains(c));
        let at: f64 = at[..digits.unwrap_or(at.len())].parse().unwrap();
        let least = value.chars().filter(char::is_ascii_digit);
        let least: f64 = least.collect::<String>().parse().unwrap_or(0.0);
        assert!(at > least, "{value} has no value there: {detail}");
    }
    let (word, detail) = stated(system("x", "x'^2/2", &[]), "sqrt(x' - 5)");
    assert_eq!(word, "proved", "{detail}");
}

/// With z' = t x' + x + y' the motion is x'' (t² + 2) + 2 t x' = 0: (t² + 2) x' is kept, a function of three integrals found that contain
/// x, y and z, which shifts of x change at rates with the factor t. Three variables t, x', y', one integral, and the density.
#[test]
fn integrals_are_counted_where_shifts_act_with_the_time() {
    let own = system(
        "x y z",
        "(x'^2 + y'^2 + z'^2)/2",
        &[("f", "z' - t*x' - x - y'")],
    );
    let found = finding(&own, "liouville.integrable");
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "proved", "{detail}");
    assert!(detail.contains("with 1 integral of them"), "{detail}");
}

//! Integrals of the literature that the families chosen for a system contain, and how families grow.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::{expr, framed, system, with_context, with_motion};
use chetaev_geometry::noether::found::{found, Found};
use chetaev_geometry::noether::motion::Motion;
use chetaev_geometry::noether::search::Integral;
use chetaev_mechanics::{Context, System};
use chetaev_symbolic::{Expr, Verdict};

/// The rank of the derivatives of functions along the constraint manifold.
fn rank(cx: &Context<'_>, motion: &Motion<'_>, functions: &[Expr]) -> usize {
    let matrix = motion.gradients(functions);
    let rank = cx.prover.rank(cx.system, &matrix, &motion.manifold);
    rank.unwrap().maximum
}

/// So many independent integrals are found; these, which are integrals, are functions of them and of what the constraints fix.
fn contains(system: &System, count: usize, known: &[&str]) {
    with_motion(system, |cx, motion| {
        let g = &system.graph;
        let found = found(cx);
        let found: &Found = found.as_ref().as_ref().unwrap();
        let shown: Vec<String> = found.integrals.iter().map(|i| g.text(i.shown)).collect();
        assert_eq!((found.integrals.len(), found.open), (count, 0), "{shown:?}");
        let mut values = system.fixed_functions();
        values.extend(found.integrals.iter().map(|i| i.value));
        let own = rank(cx, motion, &values);
        assert_eq!(own, values.len(), "{shown:?} depend on each other");
        for text in known {
            let value = expr(g, text);
            let verdict = motion.is_integral(cx, value);
            assert!(matches!(verdict, Verdict::Proved(_)), "{text}: {verdict:?}");
            values.push(value);
            assert_eq!(rank(cx, motion, &values), own, "{text} beside {shown:?}");
            values.pop();
        }
    });
}

/// Neumann 1859, the integral in the form of Uhlenbeck (Moser 1980): `F = x² + (x y' - y x')²/(a - b) + (x z' - z x')²/(a - c)` on the
/// unit sphere; on one of any radius x² counts r² times.
#[test]
fn neumann() {
    let sphere = system(
        "x y z",
        "(x'^2 + y'^2 + z'^2)/2 - (a x^2 + b y^2 + c z^2)/2",
        &[("sphere", "x^2 + y^2 + z^2 - 1")],
    );
    let wanted = "x^2 (x^2 + y^2 + z^2) + (x y' - y x')^2/(a - b) + (x z' - z x')^2/(a - c)";
    contains(&sphere, 2, &[wanted]);
}

/// Joachimsthal 1843: along a geodesic of an ellipsoid the product of the squares of the distance of the tangent plane and of the
/// diameter along the tangent is constant.
#[test]
fn joachimsthal() {
    let ellipsoid = system(
        "x y z",
        "(x'^2 + y'^2 + z'^2)/2",
        &[("ellipsoid", "x^2/a + y^2/b + z^2/c - 1")],
    );
    let wanted = "(x^2/a^2 + y^2/b^2 + z^2/c^2) (x'^2/a + y'^2/b + z'^2/c)";
    contains(&ellipsoid, 2, &[wanted]);
}

/// Forces as the inverse cubes of distances scale with the time: `2 t E - Σ x x'` and `t² E - t Σ x x' + Σ x²/2` (Calogero 1971).
#[test]
fn calogero() {
    let kinetic = "(x'^2 + y'^2 + z'^2)/2";
    let potential = "(g/(x - y)^2 + g/(y - z)^2 + g/(z - x)^2)";
    let three = system("x y z", &format!("{kinetic} - {potential}"), &[]);
    let energy = format!("({kinetic} + {potential})");
    let first = format!("2 t {energy} - x x' - y y' - z z'");
    let second = format!("t^2 {energy} - t (x x' + y y' + z z') + (x^2 + y^2 + z^2)/2");
    // Six functions of the six data, one of which contains the time; all are reached but the cubic one.
    contains(
        &three,
        5,
        &[
            &first,
            &second,
            "x' + y' + z'",
            "t (x' + y' + z') - x - y - z",
        ],
    );
}

/// Hénon 1974 and Flaschka 1974: three particles of Toda's on a circle, `p₁p₂p₃ - p₁ e^(q₂-q₃) - p₂ e^(q₃-q₁) - p₃ e^(q₁-q₂)`; and on a
/// line. It is of degree three, which is not searched unless the model asks for it.
#[test]
fn toda() {
    let kinetic = "(x'^2 + y'^2 + z'^2)/2 - exp(x - y) - exp(y - z)";
    let sum = "x' + y' + z'";
    let mut circle = system("x y z", &format!("{kinetic} - exp(z - x)"), &[]);
    contains(&circle, 3, &[sum]);
    circle.search_degree = Some(3);
    let cubic = "x' y' z' - x' exp(y - z) - y' exp(z - x) - z' exp(x - y)";
    contains(&circle, 4, &[sum, cubic]);
    let mut line = system("x y z", kinetic, &[]);
    line.search_degree = Some(3);
    contains(&line, 4, &["x' y' z' - x' exp(y - z) - z' exp(x - y)"]);
}

/// Kowalevski 1889: moments of inertia as 2 : 2 : 1 and the centre of mass in the plane of the equal ones.
#[test]
fn kovalevskaya() {
    let p = "(phi' sin(theta) sin(psi) + theta' cos(psi))";
    let q = "(phi' sin(theta) cos(psi) - theta' sin(psi))";
    let r = "(phi' cos(theta) + psi')";
    let mut top = framed(
        "phi theta psi",
        &format!("I (2 {p}^2 + 2 {q}^2 + {r}^2)/2 - c sin(theta) sin(psi)"),
        &[],
        &[("p", p), ("q", q), ("r", r)],
        &[],
    );
    top.angles = ["phi", "theta", "psi"].map(String::from).to_vec();
    top.search_degree = Some(4);
    let (re, im) = ("c/I sin(theta) sin(psi)", "c/I sin(theta) cos(psi)");
    let quartic = format!("({p}^2 - {q}^2 - {re})^2 + (2 {p} {q} - {im})^2");
    contains(&top, 3, &[&quartic]);
}

/// A homogeneous ball that rolls on an inclined plane, with five parameters: `(I + m r²) x' - m r² g s t` and the energy's part
/// `(I + m r²) x' y' - m r² g s y`, as y' is constant; the spin about the normal.
#[test]
fn ball_on_an_incline() {
    let turn = "phi'^2 + theta'^2 + psi'^2 + 2 phi' psi' cos(theta)";
    let ball = system(
        "x y phi theta psi",
        &format!("m (x'^2 + y'^2)/2 + I ({turn})/2 + m g s x"),
        &[
            (
                "roll_x",
                "x' - r (theta' sin(phi) - psi' sin(theta) cos(phi))",
            ),
            (
                "roll_y",
                "y' + r (theta' cos(phi) + psi' sin(theta) sin(phi))",
            ),
        ],
    );
    let known = [
        "y'",
        "phi' + psi' cos(theta)",
        "(I + m r^2) x' - m r^2 g s t",
        "(I + m r^2) x' y' - m r^2 g s y",
    ];
    contains(&ball, 5, &known);
}

/// More work makes families larger, less than usual no smaller: under the force y'' = x⁸ the function x' y' - x⁹/9 is constant as
/// x' is, and x⁹ is beyond the usual weight.
#[test]
fn families_grow_with_the_work() {
    let pushed = framed("x y", "(x'^2 + y'^2)/2", &[], &[], &[("y", "x^8")]);
    let g = &pushed.graph;
    let wanted = expr(g, "x' y' - x^9/9");
    let searched = |work: f64| {
        with_context(&pushed, |cx| {
            let cx = Context::new(
                cx.system,
                cx.terms,
                cx.selection,
                cx.registry(),
                cx.prover.clone(),
            );
            let cx = cx.allowing(work);
            let motion = Motion::of(&cx).unwrap();
            let found = found(&cx);
            let found = found.as_ref().as_ref().unwrap();
            let mut values: Vec<Expr> = found.integrals.iter().map(|i| i.value).collect();
            values.push(wanted);
            let is_found = rank(&cx, &motion, &values) < values.len();
            let sizes = found.families.iter().map(|f| f.family.members.len());
            let finding = cx.finding("noether.family");
            let said = finding.verdict.detail();
            assert!(said.contains("larger with a larger time budget"), "{said}");
            (is_found, sizes.collect::<Vec<usize>>())
        })
    };
    let (usual, sizes) = searched(1.0);
    assert!(!usual);
    assert_eq!(searched(0.1).1, sizes);
    let (more, larger) = searched(2.0);
    assert!(more);
    assert!(
        sizes[..2].iter().zip(&larger).all(|(a, b)| a < b),
        "{sizes:?} {larger:?}"
    );
}

/// Terms of degree six in ten velocities alone are 5005: none are formed, and the verdict says so.
#[test]
fn what_is_too_much_is_said() {
    let names: Vec<String> = (0..10).map(|i| format!("x{i}")).collect();
    let kinetic: Vec<String> = names.iter().map(|x| format!("{x}'^2/2")).collect();
    let lagrangian = format!("{} - {}", kinetic.join(" + "), names.join(" "));
    let mut many = system(&names.join(" "), &lagrangian, &[]);
    many.search_degree = Some(6);
    let finding = crate::common::finding(&many, "noether.family");
    let said = finding.verdict.detail();
    let words = "only the energy, as polynomials of degree 6 in the velocities are too many";
    assert!(said.contains(words), "{said}");
}

/// Kepler's problem in spherical coordinates: the energy, the moment of momentum in space and, beside it, the component of Laplace's
/// vector along the axis (`v × L - k r/r`), a complete set for three coordinates and a motion free of the time.
#[test]
fn kepler_in_spherical_coordinates() {
    let kepler = system(
        "r theta phi",
        "m*(r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2)/2 + k/r",
        &[],
    );
    let known = [
        "r^2*(theta'*sin(phi) + phi'*sin(theta)*cos(theta)*cos(phi))",
        "r^2*(theta'*cos(phi) - phi'*sin(theta)*cos(theta)*sin(phi))",
        "r^2*sin(theta)^2*phi'",
        "m*(r^3*cos(theta)*(theta'^2 + sin(theta)^2*phi'^2) + r^2*r'*theta'*sin(theta)) - k*cos(theta)",
    ];
    contains(&kepler, 5, &known);
}

/// Separable systems, by what separates: a charge in the field of a dipole beside an elastic force, `p_θ² + p_φ²/sin² θ + 2 m a cos θ`; the
/// hydrogen atom in a field, in parabolic coordinates (Epstein 1916), `p_u²/2m + p_φ²/(2 m u²) + f u⁴/2 - u² H`; two fixed centres in the
/// plane, in elliptic coordinates (Euler 1760), `p_x²/2 - a cosh x - cosh² x H`.
#[test]
fn separable_systems() {
    let dipole = system(
        "r theta phi",
        "m*(r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2)/2 - a*cos(theta)/r^2 - b*r^2/2",
        &[],
    );
    let of_angles = "m*r^4*(theta'^2 + sin(theta)^2*phi'^2) + 2*a*cos(theta)";
    contains(&dipole, 3, &[of_angles]);
    let energy =
        "(m/2*((u^2 + v^2)*(u'^2 + v'^2) + u^2*v^2*phi'^2) - 2*k/(u^2 + v^2) + f*(u^2 - v^2)/2)";
    let stark = system(
        "u v phi",
        "m/2*((u^2 + v^2)*(u'^2 + v'^2) + u^2*v^2*phi'^2) + 2*k/(u^2 + v^2) - f*(u^2 - v^2)/2",
        &[],
    );
    let separated = format!("m*(u^2 + v^2)^2*u'^2/2 + m*u^2*v^4*phi'^2/2 + f*u^4/2 - u^2*{energy}");
    contains(&stark, 3, &[&separated]);
    let metric = "(cosh(x)^2 - cos(y)^2)";
    let potential = format!("(a*cosh(x) + b*cos(y))/{metric}");
    let centres = system(
        "x y",
        &format!("{metric}*(x'^2 + y'^2)/2 + {potential}"),
        &[],
    );
    let separated = format!(
        "{metric}^2*x'^2/2 - a*cosh(x) - cosh(x)^2*({metric}*(x'^2 + y'^2)/2 - {potential})"
    );
    contains(&centres, 2, &[&separated]);
}

/// Geodesics of the hyperbolic plane `dy² + cosh² y dx²`: with X = (cosh y cosh x, cosh y sinh x, sinh y) on the hyperboloid the moments are
/// `X0 X2' - X2 X0'` and `X1 X2' - X2 X1'`, which contain exp(±x) although x occurs nowhere.
#[test]
fn moments_in_the_hyperbolic_plane() {
    let plane = system("x y", "(y'^2 + cosh(y)^2*x'^2)/2", &[]);
    let known = [
        "y'*cosh(x) - sinh(y)*cosh(y)*sinh(x)*x'",
        "y'*sinh(x) - sinh(y)*cosh(y)*cosh(x)*x'",
        "cosh(y)^2*x'",
    ];
    contains(&plane, 3, &known);
}

/// `x'' = -s x' y'/y`, `y'' = -k y'²/y`: `(ln x')' = -s (ln y)'` and `(ln y')' = -k (ln y)'`, so x' |y|^s and y' |y|^k keep their values for
/// all s and k. With friction, `y'' = -c y' - k y'²/y`, the second is y' |y|^k exp(c t).
#[test]
fn products_of_any_powers() {
    let forced = |of_y: &str| {
        let forces = [("x", "-s*x'*y'/y"), ("y", of_y)];
        framed("x y", "(x'^2 + y'^2)/2", &[], &[], &forces)
    };
    for (of_y, wanted) in [
        ("-k*y'^2/y", ["x'*abs(y)^s", "y'*abs(y)^k"]),
        ("-c*y' - k*y'^2/y", ["x'*abs(y)^s", "y'*abs(y)^k*exp(c*t)"]),
        ("-y'^2/(2*y)", ["x'*abs(y)^s", "y*y'^2"]),
    ] {
        let own = forced(of_y);
        with_motion(&own, |cx, _| {
            let g = &own.graph;
            let found = found(cx);
            let found: &Found = found.as_ref().as_ref().unwrap();
            let texts: Vec<String> = found.integrals.iter().map(|i| g.text(i.shown)).collect();
            for text in wanted.map(|text| g.text(expr(g, text))) {
                assert!(texts.contains(&text), "{text}: {texts:?}");
            }
            let proved = |i: &Integral| matches!(i.verdict, Verdict::Proved(_));
            assert!(found.integrals.iter().all(proved), "{texts:?}");
        });
    }
}

/// Coefficients with roots of numbers, in denominators too: a uniform field E across a magnetic field B in the plane keeps the guiding centre
/// `x' - B y - E_x t`, `y' + B x - E_y t` for `x'' = B y' + E_x`, `y'' = -B x' + E_y`. With
/// `B = 1/√3` and `E = (1/(2 + √3), √3)` and unit mass nothing else is new but the energy.
#[test]
fn coefficients_with_roots_of_numbers() {
    let field = framed(
        "x y",
        "(x'^2 + y'^2)/2 + x/(2 + sqrt(3)) + y*sqrt(3)",
        &[],
        &[],
        &[("x", "y'/sqrt(3)"), ("y", "-x'/sqrt(3)")],
    );
    let known = [
        "x' - y/sqrt(3) - t/(2 + sqrt(3))",
        "y' + x/sqrt(3) - sqrt(3)*t",
    ];
    // Beside these the energy, and the velocity less its mean, which turns at the rate 1/√3: all that are there.
    contains(&field, 4, &known);
}

/// `x'' = g - 3 s x'²/(1 + s x)` keeps `(1 + s x)⁶ x'² - 2 g (1 + s x)⁷/(7 s)`, whose last term is a polynomial of seven terms where a
/// constant is left out.
#[test]
fn powers_are_written_as_powers() {
    let own = framed("x", "x'^2/2", &[], &[], &[("x", "g - 3*s*x'^2/(1 + s*x)")]);
    with_motion(&own, |cx, motion| {
        let g = &own.graph;
        let found = found(cx);
        let found: &Found = found.as_ref().as_ref().unwrap();
        let texts: Vec<String> = found.integrals.iter().map(|i| g.text(i.shown)).collect();
        assert!(texts.iter().any(|t| t.contains(")^7")), "{texts:?}");
        for integral in &found.integrals {
            let verdict = motion.is_integral(cx, integral.value);
            assert!(matches!(verdict, Verdict::Proved(_)), "{texts:?}");
        }
    });
}

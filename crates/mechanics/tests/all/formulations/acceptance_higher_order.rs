//! Acceptance of T2 §2, §5 and §6: one constraint of orders one, two and three, the pendulum as a constraint of order two,
//! E1 in polar characteristics, E2 with thrust, and the determinant (13) on both branches of E3.

use crate::formulations::acceptance_support::Sheet;
use crate::formulations::common::{expect, Case};
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::order::determined::with_multipliers;
use chetaev_symbolic::Expr;

const GENERALIZED: [&str; 4] = ["routh", "maggi", "volterra-first", "volterra-second"];
const CARTESIAN: [&str; 2] = ["volterra-first-cartesian", "volterra-second-cartesian"];
const VOLTERRA: [&str; 4] = [
    "volterra-first",
    "volterra-second",
    "volterra-first-cartesian",
    "volterra-second-cartesian",
];

/// `left - right` of the equations of motion.
fn residuals(case: &Case, form: &str) -> Vec<Expr> {
    let equations = &case.equations(form).groups[0].equations;
    let pairs = equations
        .iter()
        .map(|e| case.system.graph.sub(e.left, e.right));
    pairs.collect()
}

/// (2a): the knife edge in the place of its derivative of this order.
fn knife_edge(order: u32) -> Case {
    Case::new(&format!(
        r#"
coordinates = ["x", "y", "phi"]
lagrangian = {{ T = "1/2 (x'^2 + y'^2 + phi'^2)" }}
[constraints]
blade = {{ equation = "x' sin(phi) = y' cos(phi)", lifted = {order} }}
"#
    ))
}

/// On f = x' sin(phi) - y' cos(phi) = 0 and, for m = 3, D f = 0. With m ≤ 2 the accelerations are functions of the state. With m = 3
/// they are variables of it, determined by D f = 0 and the equations of motion that were passed over, and so is λ = -phi' u.
#[test]
fn the_knife_edge_has_the_same_accelerations_in_all_three_orders() {
    let expected = ["-phi' y'", "phi' x'", "0"];
    let along = [("x'", "u cos(phi)"), ("y'", "u sin(phi)")];
    for form in GENERALIZED {
        for order in [1, 2] {
            let case = knife_edge(order);
            let s = Sheet::of(&case);
            for (a, text) in case.equations(form).accelerations.into_iter().zip(expected) {
                let wanted = s.put(s.read(text), &along);
                s.same(s.put(a, &along), wanted);
            }
        }
        let case = knife_edge(3);
        let s = Sheet::of(&case);
        let equations = case.equations(form);
        let mut unknowns = vec!["x''", "y''", "phi''"];
        let mut wanted: Vec<Expr> = s.all(&expected);
        if form == "routh" {
            unknowns.push("lambda_blade");
            wanted.push(s.read("-phi' (x' cos(phi) + y' sin(phi))"));
        }
        let once = s.read("x'' sin(phi) - y'' cos(phi) + phi' (x' cos(phi) + y' sin(phi))");
        let mut system: Vec<Expr> = equations.conditions.iter().map(|c| c.value).collect();
        system.push(once);
        assert_eq!(system.len(), unknowns.len(), "{form}");
        let symbols: Vec<_> = unknowns.iter().map(|u| s.symbol(u)).collect();
        let at_zero: Vec<(&str, &str)> = unknowns.iter().map(|&u| (u, "0")).collect();
        let right: Vec<Expr> = system
            .iter()
            .map(|&e| s.g.neg(s.put(e, &at_zero)))
            .collect();
        let matrix = s.g.jacobian(&system, &symbols).concat();
        let found = s.g.solve(&matrix, &right).unwrap();
        for (found, wanted) in found.into_iter().zip(&wanted) {
            s.same(s.put(found, &along), s.put(*wanted, &along));
        }
        // The third derivatives are the rates of these accelerations.
        let motion: Vec<(&str, Expr)> = unknowns.iter().copied().zip(wanted.clone()).collect();
        let names = ["x", "y", "phi"];
        for (third, &second) in equations.highest.iter().zip(&wanted) {
            let rate = s.put_all(s.rate(second, &names), &motion);
            let third = s.put_all(*third, &motion);
            s.same(s.put(third, &along), s.put(rate, &along));
        }
    }
}

/// Off f = 0 the lifted edge slips: the accelerations of m = 2 are not those of f = 0, where `x'' = -phi' y'`.
#[test]
fn a_slipping_edge_has_other_accelerations() {
    let case = knife_edge(2);
    let s = Sheet::of(&case);
    // λ = -phi' (x' cos(phi) + y' sin(phi)), x'' = λ sin(phi).
    let a = case.equations("maggi").accelerations[0];
    s.equal(a, "-phi' (x' cos(phi) + y' sin(phi)) sin(phi)");
    s.differ(a, s.read("-phi' y'"));
}

/// The pendulum of T2 §2, F = (ξ² + η² - l²)/2 with gravity along η, as a constraint of the order m in Cartesian coordinates.
fn pendulum(order: u32, formulas: [&str; 2]) -> Case {
    let primes = "'".repeat(order as usize);
    let [xi, eta] = formulas;
    Case::new(&format!(
        r#"
coordinates = ["xi", "eta"]
parameters = {{ mu = {{}}, g = {{}}, l = {{}} }}
assumptions = ["mu > 0", "l > 0", "xi^2 + eta^2 > 0"]
[particles.bob]
mass = "mu"
position = ["xi", "eta"]
force = ["0", "-mu g"]
[constraints]
thread = {{ equation = "1/2 (xi^2 + eta^2 - l^2) = 0", lifted = {order} }}
[characteristics]
parameters = ["P"]
"xi{primes}" = "{xi}"
"eta{primes}" = "{eta}"
"#
    ))
}

const FALLING: [&str; 2] = [
    "-P eta - xi (xi'^2 + eta'^2)/(xi^2 + eta^2)",
    "P xi - eta (xi'^2 + eta'^2)/(xi^2 + eta^2)",
];

/// m = 1: μ [ (ξ² + η²) P' + g ξ ] = 0; m = 2: μ [ (ξ² + η²) P + g ξ ] = 0, in V1 and V2, before ξ² + η² = l² is used.
#[test]
fn the_pendulum_as_a_constraint_of_orders_one_and_two() {
    for (order, formulas, expected) in [
        (1, ["-P eta", "P xi"], "mu ((xi^2 + eta^2) P' + g xi)"),
        (2, FALLING, "mu ((xi^2 + eta^2) P + g xi)"),
    ] {
        let case = pendulum(order, formulas);
        let s = Sheet::of(&case);
        expect(&case, "order.characteristics", "proved");
        for form in VOLTERRA {
            s.equal(residuals(&case, form)[0], expected);
            expect(&case, &format!("formulation.equivalent#{form}"), "proved");
            expect(&case, &format!("formulation.identity#{form}"), "proved");
        }
    }
    // Without the centripetal part the second derivatives leave the circle.
    let wrong = pendulum(2, ["-P eta", "P xi"]);
    expect(&wrong, "order.characteristics", "refuted");
}

/// In its angle, r'' = 0 in the place of r = l: on r = l and r' = 0 it is l θ'' + g cos θ = 0, what P = θ'' makes of the Cartesian
/// equation.
#[test]
fn the_pendulum_of_order_two_in_its_angle() {
    let case = Case::new(
        r#"
coordinates = ["r", "theta"]
parameters = { mu = {}, g = {}, l = {} }
assumptions = ["mu > 0", "l > 0", "r > 0"]
lagrangian = { T = "1/2 mu (r'^2 + r^2 theta'^2)", V = "mu g r sin(theta)" }
constraints = { thread = { equation = "r = l", lifted = 2 } }
"#,
    );
    let s = Sheet::of(&case);
    let hanging = [("r", "l"), ("r'", "0")];
    for form in GENERALIZED {
        let a = case.equations(form).accelerations;
        s.vanishes(a[0]);
        s.equal(s.put(a[1], &hanging), "-g cos(theta)/l");
        s.equal(a[1], "-(g r cos(theta) + 2 r r' theta')/r^2");
    }
}

/// E1 in polar characteristics, with any mass μ(t).
const ROCKET: &str = r#"
coordinates = ["x", "y", "z"]
parameters = { a = {}, c = {}, g = {} }
controls = { mu = {} }
assumptions = ["a > 0", "P1 > 0", "mu > 0"]
[particles.rocket]
mass = "mu"
position = ["x", "y", "z"]
force = [0, 0, "-mu g"]
thrust = { exhaust_speed = "c" }
[constraints]
cone = "z' = a sqrt(x'^2 + y'^2)"
[characteristics]
parameters = ["P1", "P2"]
"x'" = "P1 cos(P2)"
"y'" = "P1 sin(P2)"
"z'" = "a P1"
"#;

#[test]
fn e1_in_polar_characteristics() {
    let case = Case::new(ROCKET);
    let s = Sheet::of(&case).positive(&["a", "P1", "mu"]);
    expect(&case, "order.characteristics", "proved");
    for form in VOLTERRA {
        expect(&case, &format!("formulation.equivalent#{form}"), "proved");
        let equations = case.equations(form);
        let [one, two] = &equations.groups[0].equations[..] else {
            panic!("{form}: two equations");
        };
        s.equal(case.object(&equations, "Ttilde"), "1/2 mu (1 + a^2) P1^2");
        s.equal(one.left, "(1 + a^2) (mu P1' + mu' P1)");
        s.equal(two.left, "mu P1^2 P2'");
        s.equal(one.right, "-mu g a + mu' ((1 + a^2) P1 - c sqrt(1 + a^2))");
        s.vanishes(two.right);
        s.equal(case.object(&equations, "Etilde_P1"), "-mu g a");
        let reactive = case.object(&equations, "Psitilde_P1");
        s.equal(reactive, "mu' ((1 + a^2) P1 - c sqrt(1 + a^2))");
    }
    for form in VOLTERRA.into_iter().chain(["maggi"]) {
        let variables = case.equations(form).variables;
        let rate = |name: &str| variables.iter().find(|x| x.name == name).unwrap().rate;
        s.equal(rate("P1"), "-g a/(1 + a^2) - c mu'/(mu sqrt(1 + a^2))");
        s.vanishes(rate("P2"));
    }
}

/// Σ μ ξ' D B_1 = 0 and Σ μ ξ' D B_2 = -μ P1² P2', while ∂T̃/∂P2 = 0: what turns makes the whole of the second equation.
#[test]
fn e1_the_turning_of_the_characteristics() {
    let case = Case::new(ROCKET);
    let s = Sheet::of(&case);
    let cx = case.context();
    let c = basis(&cx).kinematic_characteristics().unwrap();
    let momenta = s.all(&["mu P1 cos(P2)", "mu P1 sin(P2)", "mu a P1"]);
    let columns = [
        s.all(&["cos(P2)", "sin(P2)", "a"]),
        s.all(&["-P1 sin(P2)", "P1 cos(P2)", "0"]),
    ];
    for (sigma, (column, expected)) in columns.iter().zip(["0", "-mu P1^2 P2'"]).enumerate() {
        let found = c.column(sigma);
        for (&found, &own) in found.iter().zip(column) {
            s.same(found, own);
        }
        let turning = s.dot(&momenta, &c.total_derivative(&case.system, &found));
        s.equal(turning, expected);
    }
    let equations = case.equations("volterra-first-cartesian");
    s.vanishes(s.by(case.object(&equations, "Ttilde"), "P2"));
    // Without the turning the second equation would say nothing.
    s.fails(equations.groups[0].equations[1].left);
}

/// E2 with any mass μ(t) and a thrust against the velocity; P is the rate of the speed.
fn steered(thrust: &str) -> Case {
    Case::new(&format!(
        r#"
coordinates = ["x", "y"]
parameters = {{ c = {{}}, g = {{}}, gamma = {{}} }}
controls = {{ mu = {{}} }}
assumptions = ["mu > 0", "gamma > 0", "x'^2 + y'^2 > 0"]
define = {{ v = "sqrt(x'^2 + y'^2)" }}
[particles.rocket]
mass = "mu"
position = ["x", "y"]
force = [0, "-mu g"]
thrust = {thrust}
[constraints]
bend = "x' y'' - y' x'' = gamma v^3"
[characteristics]
parameters = ["P"]
"x''" = "P x'/v - gamma v y'"
"y''" = "P y'/v + gamma v x'"
"#
    ))
}

/// v' = -g sin θ - c μ'/μ, θ' = γ v, hence θ'' + γ g sin θ = -γ c μ'/μ: without thrust a pendulum of the length 1/γ, whatever the mass
/// does. λ = μ (γ v + g cos θ/v): the thrust has no part across the path.
#[test]
fn e2_with_thrust_and_without() {
    let v = "sqrt(x'^2 + y'^2)";
    for (thrust, push) in [
        ("{ exhaust_speed = \"c\" }", "-c mu'/mu"),
        ("\"isotropic\"", "0"),
    ] {
        let case = steered(thrust);
        let s = Sheet::of(&case).positive(&["mu", "gamma"]);
        for claim in ["order.characteristics", "order.determined", "mass.balance"] {
            expect(&case, claim, "proved");
        }
        let speed_rate = format!("(-g y'/{v} + ({push}))");
        for form in GENERALIZED.into_iter().chain(CARTESIAN) {
            let a = case.equations(form).accelerations;
            let on_motion = [("x''", a[0]), ("y''", a[1])];
            s.equal(a[0], &format!("{speed_rate} x'/{v} - gamma {v} y'"));
            s.equal(a[1], &format!("{speed_rate} y'/{v} + gamma {v} x'"));
            let turning = s.read("(x' y'' - y' x'')/(x'^2 + y'^2)");
            s.equal(s.put_all(turning, &on_motion), &format!("gamma {v}"));
            let rate = s.rate(s.read(&format!("gamma {v}")), &["x", "y"]);
            let pendulum = s.sum(&[
                s.put_all(rate, &on_motion),
                s.read(&format!("gamma g y'/{v}")),
            ]);
            s.equal(pendulum, &format!("gamma ({push})"));
            let energy = s.rate(s.read("1/2 (x'^2 + y'^2) + g y"), &["x", "y"]);
            let power = format!("({push}) {v}");
            s.equal(s.put_all(energy, &on_motion), &power);
        }
        for form in VOLTERRA.into_iter().chain(["maggi"]) {
            let found = residuals(&case, form)[0];
            s.equal(found, &format!("mu (P + g y'/{v} - ({push}))"));
        }
        let lambda = format!("mu (gamma {v} + g x'/(x'^2 + y'^2))");
        let a = case.equations("routh").accelerations;
        let cx = case.context();
        for e in with_multipliers(&basis(&cx)).equations {
            let with_reaction = s.put(e, &[("lambda_bend", &lambda)]);
            s.vanishes(s.put_all(with_reaction, &[("x''", a[0]), ("y''", a[1])]));
        }
    }
}

/// Without forces the motion is uniform on a circle of the radius 1/γ: |v|, and the centre at the distance 1/γ along the normal,
/// rest.
#[test]
fn e2_a_free_particle_runs_uniformly_on_a_circle() {
    let case = steered("\"isotropic\"");
    let s = Sheet::of(&case).positive(&["gamma"]);
    let v = "sqrt(x'^2 + y'^2)";
    let a = case.equations("volterra-second").accelerations;
    for constant in [
        v.to_string(),
        format!("x - y'/(gamma {v})"),
        format!("y + x'/(gamma {v})"),
    ] {
        let rate = s.rate(s.read(&constant), &["x", "y"]);
        let rate = s.put_all(rate, &[("x''", a[0]), ("y''", a[1])]);
        s.vanishes(s.put(rate, &[("g", "0")]));
    }
}

/// E3, F = -k (x, y).
const MAGNITUDE: &str = r#"
coordinates = ["x", "y"]
parameters = { m = {}, k = {}, alpha = {} }
assumptions = ["m > 0", "alpha > 0", "k > 0"]
lagrangian = { T = "1/2 m (x'^2 + y'^2)", V = "1/2 k (x^2 + y^2)" }
constraints = { push = "x''^2 + y''^2 = alpha^2" }
"#;

/// On the branches (x'', y'') = ±α F/|F| with λ = (m ∓ |F|/α)/2 the equations hold, and (13) is ±α|F| with B = (-α sin θ, α cos θ),
/// so that it vanishes with F only. The determinant of the whole system for (x'', y'', λ) is 4 times that: |A|² = 4 α².
#[test]
fn e3_the_determinant_on_both_branches() {
    let case = Case::new(MAGNITUDE);
    let s = Sheet::of(&case).positive(&["m", "alpha", "k", "x^2 + y^2"]);
    let cx = case.context();
    let determined = with_multipliers(&basis(&cx));
    assert!(!determined.linear);
    let jacobian = s.g.jacobian(&determined.equations, &determined.unknowns);
    let r = "sqrt(x^2 + y^2)";
    for (sign, other) in [("", "-"), ("-", "")] {
        let branch = [
            ("x''", format!("{other}alpha x/{r}")),
            ("y''", format!("{other}alpha y/{r}")),
            ("lambda_push", format!("(m + ({other}k {r}/alpha))/2")),
        ];
        let branch: Vec<(&str, &str)> = branch.iter().map(|(a, b)| (*a, b.as_str())).collect();
        for &e in &determined.equations {
            s.vanishes(s.put(e, &branch));
        }
        // B = (-y'', x''), as α (cos θ, sin θ) = (x'', y'').
        let b = s.all(&["-y''", "x''"]);
        let rows: Vec<Expr> = jacobian[..2]
            .iter()
            .map(|row| s.dot(&row[..2], &b))
            .collect();
        let form = s.put(s.dot(&b, &rows), &branch);
        s.equal(form, &format!("{sign}alpha k {r}"));
        let whole = s.put(determinant(&s, &jacobian), &branch);
        s.equal(whole, &format!("{sign}4 alpha k {r}"));
    }
}

/// The same with P = θ, where Maggi's equation is X sin θ - Y cos θ = 0 up to the factor α, free of the mass, and (13) is its
/// derivative by θ.
#[test]
fn e3_in_the_angle_of_the_acceleration() {
    let case = Case::new(&format!(
        "{MAGNITUDE}[characteristics]\nparameters = [\"theta\"]\n\"x''\" = \"alpha cos(theta)\"\n\"y''\" = \"alpha sin(theta)\"\n"
    ));
    let s = Sheet::of(&case).positive(&["m", "alpha", "k", "x^2 + y^2"]);
    let r = "sqrt(x^2 + y^2)";
    for form in &GENERALIZED[1..] {
        let found = residuals(&case, form)[0];
        s.equal(found, "alpha (-k x sin(theta) + k y cos(theta))");
        let slope = s.by(found, "theta");
        for (sign, other) in [("", "-"), ("-", "")] {
            let branch = [
                ("cos(theta)", format!("{other}x/{r}")),
                ("sin(theta)", format!("{other}y/{r}")),
            ];
            let branch: Vec<(&str, &str)> = branch.iter().map(|(a, b)| (*a, b.as_str())).collect();
            s.vanishes(s.put(found, &branch));
            s.equal(s.put(slope, &branch), &format!("{sign}alpha k {r}"));
        }
    }
}

/// Of a matrix of three rows.
fn determinant(s: &Sheet, rows: &[Vec<Expr>]) -> Expr {
    let minor =
        |i: usize, j: usize| s.sub(s.mul(rows[1][i], rows[2][j]), s.mul(rows[1][j], rows[2][i]));
    s.sum(&[
        s.mul(rows[0][0], minor(1, 2)),
        s.mul(rows[0][1], minor(2, 0)),
        s.mul(rows[0][2], minor(0, 1)),
    ])
}

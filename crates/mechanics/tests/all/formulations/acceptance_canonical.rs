//! Acceptance of T1 §5.3 and §6: Lagrange's least action on S4, the Hamilton–Jacobi method on S2 and its failure on S4,
//! Chaplygin's reducing multiplier (25)–(27), the extended configuration space (28), (29) with the chain to Jacobi's principle,
//! and the relations K of the extended phase space (30), (31) (capabilities C8, C11, C12, C13).
//!
//! H1 of S2 and S4 is compared with the derived one in `vakonomic.rs`, (29) of S4 in `parametric.rs`, K of S4 in
//! `parametric_canonical.rs`; momenta of the reduced time are in `corrections.rs`.

use crate::formulations::acceptance_support::{chart, motion, Sheet};
use crate::formulations::common::{Case, APPELL_HAMEL, DISC, PARTICLE, SKATE};
use chetaev_mechanics::curvature::curvature;
use chetaev_mechanics::Characteristics;
use chetaev_symbolic::Expr;

/// (19) on S4 with Δq = (a(t), b(t), y a(t)) and Δt from ΔH = 0: Δ(p·v) + (p·v) D(Δt) - D(Σ p Δq) = 0 on the motion, not on
/// another curve of the constraint with the same energy law.
#[test]
fn least_action_of_lagrange() {
    let case = Case::new(PARTICLE);
    let s = Sheet::of(&case);
    let moving = ["x", "y", "z", "a", "b"];
    let (q, v) = (["x", "y", "z"], ["x'", "y'", "z'"]);
    let shift = s.all(&["a", "b", "y a"]);
    let rates: Vec<Expr> = shift.iter().map(|&e| s.rate(e, &moving)).collect();
    let h = case.system.energy();
    let (of_q, of_v) = (s.gradient(h, &q), s.gradient(h, &v));
    let velocity = s.all(&v);
    let stretch = s.g.div(
        s.sum(&[s.dot(&of_q, &shift), s.dot(&of_v, &rates)]),
        s.dot(&of_v, &velocity),
    );
    // Δv = D(Δq) - v D(Δt).
    let of_velocity: Vec<Expr> = rates
        .iter()
        .zip(&velocity)
        .map(|(&r, &v)| s.sub(r, s.mul(v, stretch)))
        .collect();
    let delta = |e: Expr| {
        let parts = [
            s.dot(&s.gradient(e, &q), &shift),
            s.dot(&s.gradient(e, &v), &of_velocity),
        ];
        s.sum(&parts)
    };
    s.vanishes(delta(h));
    let p = s.gradient(case.system.lagrangian, &v);
    let action = s.dot(&p, &velocity);
    let boundary = s.rate(s.dot(&p, &shift), &moving);
    let identity = s.sub(s.sum(&[delta(action), s.mul(action, stretch)]), boundary);
    let on_motion = s.g.substitute(identity, &motion(&case));
    assert!(case.equal_on_constraints(on_motion, s.read("0")));
    // Straight in the plane of x and y, z'' = y' x' by the constraint.
    let other = s.put(identity, &[("x''", "0"), ("y''", "0"), ("z''", "x' y'")]);
    assert!(!case.equal_on_constraints(other, s.read("0")));
}

const H1_OF_THE_DISC: &str =
    "(pi_theta + R (pi_x cos(phi) + pi_y sin(phi)))^2/(2 (I + m R^2)) + pi_phi^2/(2 J)";
/// ∂S/∂φ of the complete integral, whose quadrature is not carried out.
const SLOPE_OF_THE_DISC: &str =
    "sqrt(2 J (E - (al_theta + R (al_x cos(phi) + al_y sin(phi)))^2/(2 (I + m R^2))))";

/// S2: S = -E t + α_x x + α_y y + α_θ θ + ∫ W dφ solves S_t + H1(q, S_q) = 0, with det S_qα = ∂W/∂E ≠ 0. The integrals β = S_α
/// at α_x = α_y = 0 are x = β_x + R (θ'/φ') sin φ, y = β_y - R (θ'/φ') cos φ: the rolling motion.
#[test]
fn the_complete_integral_of_the_disc() {
    let case = Case::new(DISC);
    let s = Sheet::of(&case).positive(&["m", "R", "I", "J"]);
    let slope = s.read(SLOPE_OF_THE_DISC);
    let energy = s.put_all(
        s.read(H1_OF_THE_DISC),
        &[
            ("pi_theta", s.read("al_theta")),
            ("pi_x", s.read("al_x")),
            ("pi_y", s.read("al_y")),
            ("pi_phi", slope),
        ],
    );
    s.equal(energy, "E");
    // S_qα in (x, y, θ, φ) and (α_x, α_y, α_θ, E) is triangular with this last entry.
    s.vanishes(s.sub(s.mul(s.by(slope, "E"), slope), s.read("J")));
    let rolling = [("al_x", "0"), ("al_y", "0")];
    // θ' = ∂H1/∂π_θ and φ' = ∂H1/∂π_φ there.
    let spin = s.read("al_theta/(I + m R^2)");
    let turn = s.g.div(s.put(slope, &rolling), s.read("J"));
    for (alpha, printed) in [("al_x", "-R cos(phi)"), ("al_y", "-R sin(phi)")] {
        let found = s.put(s.by(slope, alpha), &rolling);
        s.same(s.mul(found, turn), s.mul(s.read(printed), spin));
        // Setting α to zero first loses the integral.
        s.vanishes(s.by(s.put(slope, &rolling), alpha));
    }
    // The antiderivatives by φ at constant θ', φ', and the motion.
    let place = [
        ("x", "be_x + R w/n sin(phi)"),
        ("y", "be_y - R w/n cos(phi)"),
    ];
    for (q, value) in place {
        let value = s.read(value);
        let rate = s.along(value, &[("phi", s.read("n"))]);
        let b = if q == "x" {
            "R cos(phi) w"
        } else {
            "R sin(phi) w"
        };
        s.equal(rate, b);
        let second = s.along(rate, &[("phi", s.read("n"))]);
        let c = case.system.coordinate_index(q).unwrap();
        let stated = case.equations("routh").accelerations[c];
        assert!(case.equal_on_constraints(s.put(second, &[("n", "phi'"), ("w", "theta'")]), stated));
    }
    // κ = (-m x', -m y') means π_x = π_y = 0.
    let stated = case.equations("vakonomic");
    let along = [("kappa_rolling_x", "-m x'"), ("kappa_rolling_y", "-m y'")];
    for name in ["pi_x", "pi_y"] {
        let momentum = s.put(case.object(&stated, name), &along);
        assert!(case.equal_on_constraints(momentum, s.read("0")));
    }
}

/// S4: the flow of H1 has y'' = (π_x + y π_z)(y π_x - π_z)/(1 + y²)², not 0. That the motions are not
/// among the extremals is a verdict tested with the claims of the principles.
#[test]
fn the_flow_of_h1_is_not_the_motion_of_the_particle() {
    let s = Sheet::new();
    let h = s.read("((pi_x + y pi_z)^2/(1 + y^2) + pi_y^2)/2");
    s.equal(s.by(h, "pi_y"), "pi_y");
    let second = s.g.neg(s.by(h, "y"));
    s.equal(second, "(pi_x + y pi_z) (y pi_x - pi_z)/(1 + y^2)^2");
    s.fails(second);
    // Along the motion with π = p + κ f_v: zero where κ x' = 0 only, since y'' = -κ x'.
    let momenta = [
        ("pi_x", "x' - kappa y"),
        ("pi_y", "y'"),
        ("pi_z", "y x' + kappa"),
    ];
    s.equal(s.put(second, &momenta), "-kappa x'");
}

/// Systems with two independent velocities, given by the dependent coordinates.
struct Reduction {
    case: Case,
    q: [&'static str; 2],
    slopes: Vec<Vec<Expr>>,
    curvatures: Vec<Expr>,
    coefficients: Vec<Vec<Expr>>,
    theta: Vec<Expr>,
    momenta: Vec<Expr>,
    chart: Characteristics,
}

fn reduction(text: &str, q: [&'static str; 2], dependent: &[usize]) -> Reduction {
    let case = Case::new(text);
    let s = Sheet::of(&case);
    let chart = chart(&case, dependent);
    let slopes: Vec<Vec<Expr>> = dependent.iter().map(|&d| chart.basis[d].clone()).collect();
    let curvatures = slopes
        .iter()
        .map(|a| s.sub(s.by(a[0], q[1]), s.by(a[1], q[0])))
        .collect();
    let kinetic = case.system.kinetic.unwrap_or(case.system.lagrangian);
    let restricted = chart.restrict(&case.system, &[kinetic])[0];
    let rates = q.map(|name| format!("{name}'"));
    let rates = [rates[0].as_str(), rates[1].as_str()];
    let momenta = s.gradient(restricted, &rates);
    let mass: Vec<Expr> = momenta
        .iter()
        .flat_map(|&p| s.gradient(p, &rates))
        .collect();
    let theta: Vec<Expr> = dependent
        .iter()
        .map(|&d| {
            let full = s.g.diff(kinetic, case.system.coordinates[d].v_symbol);
            chart.restrict(&case.system, &[full])[0]
        })
        .collect();
    // θ = t·v and P = M v, so θ = (M⁻¹ t)·P.
    let coefficients = theta
        .iter()
        .map(|&e| s.g.solve(&mass, &s.gradient(e, &rates)).unwrap())
        .collect();
    Reduction {
        q,
        slopes,
        curvatures,
        coefficients,
        theta,
        momenta,
        chart,
        case,
    }
}

impl Reduction {
    /// Σ_l B^l_s c_l.
    fn gyro(&self, s: &Sheet, index: usize) -> Expr {
        let column: Vec<Expr> = self.coefficients.iter().map(|b| b[index]).collect();
        s.dot(&column, &self.curvatures)
    }

    /// d/dq2 (Σ B_2 c) + d/dq1 (Σ B_1 c).
    fn closedness(&self, s: &Sheet) -> Expr {
        s.sum(&[
            s.by(self.gyro(s, 1), self.q[1]),
            s.by(self.gyro(s, 0), self.q[0]),
        ])
    }

    /// θ, A and B agree: the right sides of (25) are Σ θ_l A^l_s.
    fn check_definitions(&self, s: &Sheet) {
        let a = curvature(&self.case.system, &self.chart);
        let rates = self.q.map(|q| s.read(&format!("{q}'")));
        for (row, &c) in a.iter().zip(&self.curvatures) {
            assert!(self.case.equal(row[0], s.mul(c, rates[1])));
            assert!(self.case.equal(row[1], s.g.neg(s.mul(c, rates[0]))));
        }
        for (&theta, b) in self.theta.iter().zip(&self.coefficients) {
            assert!(self.case.equal(theta, s.dot(b, &self.momenta)));
        }
        assert_eq!(self.slopes.len(), self.theta.len());
    }

    /// (25): D P_1 - ∂(Θ + U)/∂q_1 = q_2' S and D P_2 - ∂(Θ + U)/∂q_2 = -q_1' S along the motion.
    fn check_equations(&self, gyro: Expr) {
        let s = Sheet::of(&self.case);
        let full = self
            .chart
            .restrict(&self.case.system, &[self.case.system.lagrangian])[0];
        let along = motion(&self.case);
        for (index, sign) in [1, -1].into_iter().enumerate() {
            let rate = self.case.system.total_derivative(self.momenta[index]);
            let left = s.sub(s.g.substitute(rate, &along), s.by(full, self.q[index]));
            let other = s.read(&format!("{}'", self.q[1 - index]));
            let right = s.g.mul(&[s.g.integer(sign), other, gyro]);
            assert!(self.case.equal_on_constraints(left, right));
        }
    }

    /// (26) and (27) for the multiplier, and the canonical equations in τ of Ĥ for the momenta N P along the motion.
    fn check_multiplier(&self, reducer: &str, hamiltonian: &str) {
        let s = Sheet::of(&self.case);
        let reducer = s.read(reducer);
        let logarithmic = |q: &str| s.g.div(s.by(reducer, q), reducer);
        assert!(self.case.equal(logarithmic(self.q[0]), self.gyro(&s, 1)));
        assert!(self
            .case
            .equal(logarithmic(self.q[1]), s.g.neg(self.gyro(&s, 0))));
        s.vanishes(self.closedness(&s));
        let gyro = s.dot(&self.theta, &self.curvatures);
        self.check_equations(gyro);
        let condition = s.sum(&[
            s.mul(reducer, gyro),
            s.mul(self.momenta[0], s.by(reducer, self.q[1])),
            s.g.neg(s.mul(self.momenta[1], s.by(reducer, self.q[0]))),
        ]);
        s.vanishes(condition);
        let momenta: Vec<Expr> = self.momenta.iter().map(|&p| s.mul(reducer, p)).collect();
        let own = [("p_1", momenta[0]), ("p_2", momenta[1])];
        let hamiltonian = s.read(hamiltonian);
        let moving = motion(&self.case);
        let rate = |e: Expr| {
            let rate = self.case.system.total_derivative(e);
            s.g.div(s.g.substitute(rate, &moving), reducer)
        };
        for (index, name) in ["p_1", "p_2"].iter().enumerate() {
            let q = self.q[index];
            let velocity = s.put_all(s.by(hamiltonian, name), &own);
            assert!(self.case.equal_on_constraints(rate(s.read(q)), velocity));
            let slope = s.put_all(s.by(hamiltonian, q), &own);
            let residual = s.sum(&[rate(momenta[index]), slope]);
            assert!(
                self.case.equal_on_constraints(residual, s.read("0")),
                "{name}"
            );
        }
    }
}

/// S1: B = (sin φ cos φ, 0), c = sec²φ, N = cos φ and Θ̂ = m u_x²/2 + J cos²φ u_φ²/2, for the incline and another U(x, φ).
#[test]
fn the_reducing_multiplier_of_the_skate() {
    for (text, potential) in [
        (SKATE.to_string(), "-m G x"),
        (
            SKATE.replace("-m G x", "-m G x + x sin(phi)"),
            "-m G x + x sin(phi)",
        ),
    ] {
        let r = reduction(&text, ["x", "phi"], &[1]);
        let s = Sheet::of(&r.case);
        r.check_definitions(&s);
        let printed = [
            (r.slopes[0][0], "sin(phi)/cos(phi)"),
            (r.curvatures[0], "1/cos(phi)^2"),
            (r.coefficients[0][0], "sin(phi) cos(phi)"),
            (r.coefficients[0][1], "0"),
        ];
        for (found, text) in printed {
            assert!(r.case.equal(found, s.read(text)), "{text}");
        }
        let hamiltonian = format!("p_1^2/(2 m) + p_2^2/(2 J cos(phi)^2) + ({potential})");
        r.check_multiplier("cos(phi)", &hamiltonian);
    }
}

/// S4: B_1 = y/(1 + y²), N = (1 + y²)^(-1/2), Θ̂ = (u_x² + u_y²/(1 + y²))/2. The multiplier is unique up to a factor: N² is none.
#[test]
fn the_reducing_multiplier_of_the_particle() {
    let r = reduction(PARTICLE, ["x", "y"], &[2]);
    let s = Sheet::of(&r.case);
    r.check_definitions(&s);
    assert!(r.case.equal(r.coefficients[0][0], s.read("y/(1 + y^2)")));
    assert!(r.case.equal(r.coefficients[0][1], s.read("0")));
    assert!(r.case.equal(r.curvatures[0], s.read("1")));
    r.check_multiplier("1/sqrt(1 + y^2)", "p_1^2/2 + (1 + y^2) p_2^2/2");
    let wrong = s.read("1/(1 + y^2)");
    let logarithmic = s.g.div(s.by(wrong, "y"), wrong);
    assert!(!r.case.equal(logarithmic, s.g.neg(r.gyro(&s, 0))));
}

/// S2 has two dependent velocities and needs no reduction: Σ B c = 0 and N = 1.
#[test]
fn the_disc_needs_no_multiplier() {
    let r = reduction(DISC, ["theta", "phi"], &[2, 3]);
    let s = Sheet::of(&r.case);
    r.check_definitions(&s);
    r.check_multiplier("1", "p_1^2/(2 (I + m R^2)) + p_2^2/(2 J)");
}

/// The sleigh with its centre of mass at a distance from the contact: the condition of closedness fails, there is no multiplier.
#[test]
fn the_sleigh_has_no_multiplier() {
    let sleigh = r#"
coordinates = ["x", "y", "phi"]
parameters = { m = {}, J = {}, e = {} }
assumptions = ["m > 0", "J > 0", "e > 0"]
lagrangian = { T = "1/2 m ((x' - e sin(phi) phi')^2 + (y' + e cos(phi) phi')^2) + 1/2 J phi'^2" }
constraints = { blade = "x' sin(phi) = y' cos(phi)" }
"#;
    let r = reduction(sleigh, ["x", "phi"], &[1]);
    let s = Sheet::of(&r.case);
    r.check_definitions(&s);
    s.fails(r.closedness(&s));
    s.vanishes(s.put(r.closedness(&s), &[("e", "0")]));
}

/// Λ and F for arbitrary L and f: (28) and the partial derivatives after it.
#[test]
fn homogeneous_functions_of_the_extended_space() {
    let s = Sheet::new();
    let l = s.arbitrary("c", &["x", "y", "v_x", "v_y", "t"]);
    let f = s.arbitrary("e", &["x", "y", "v_x", "v_y", "t"]);
    let lift = |e: Expr| s.put(e, &[("v_x", "w_x/w_t"), ("v_y", "w_y/w_t")]);
    let time = s.read("w_t");
    let (big_l, big_f) = (s.mul(lift(l), time), lift(f));
    let (v, w) = (["v_x", "v_y"], ["w_x", "w_y"]);
    let p = s.gradient(l, &v);
    let energy = s.sub(s.dot(&p, &s.all(&v)), l);
    let slopes = s.gradient(f, &v);
    for i in 0..2 {
        s.same(s.by(big_l, w[i]), lift(p[i]));
        s.same(s.mul(time, s.by(big_f, w[i])), lift(slopes[i]));
    }
    s.same(s.by(big_l, "w_t"), s.g.neg(lift(energy)));
    let power = s.dot(&slopes, &s.all(&v));
    s.same(s.mul(time, s.by(big_f, "w_t")), s.g.neg(lift(power)));
    for name in ["x", "y", "t"] {
        s.same(s.by(big_l, name), s.mul(time, lift(s.by(l, name))));
        s.same(s.by(big_f, name), lift(s.by(f, name)));
    }
    // Degrees 1 and 0; δq = v δt is virtual: Σ ∂F/∂x'_a x'_a = 0.
    let names = ["w_x", "w_y", "w_t"];
    let rates = s.all(&names);
    s.same(s.dot(&s.gradient(big_l, &names), &rates), big_l);
    s.vanishes(s.dot(&s.gradient(big_f, &names), &rates));
}

/// (29) for arbitrary L and f: one identity for arbitrary curves and μ, and the component of t is the energy equation,
/// dH/dτ + t' L_t = (1/t') Σ μ v ∂f/∂v.
#[test]
fn the_parametric_equations_are_dependent() {
    let s = Sheet::new();
    let l = s.arbitrary("c", &["x", "y", "v_x", "v_y", "k"]);
    let f = s.arbitrary("e", &["x", "y", "v_x", "v_y", "k"]);
    // The time is the coordinate k here, so that `t` does not run by itself; x', y', k' are derivatives by τ.
    let lift = |e: Expr| s.put(e, &[("v_x", "x'/k'"), ("v_y", "y'/k'")]);
    let (big_l, big_f) = (s.mul(lift(l), s.read("k'")), lift(f));
    let names = ["x", "y", "k"];
    let components: Vec<Expr> = s
        .euler(big_l, &names)
        .into_iter()
        .zip(names)
        .map(|(e, name)| {
            let reaction = s.mul(s.read("mu"), s.by(big_f, &format!("{name}'")));
            s.sum(&[s.g.neg(e), s.g.neg(reaction)])
        })
        .collect();
    s.vanishes(s.dot(&components, &s.all(&["x'", "y'", "k'"])));
    s.fails(components[2]);
    let p = s.gradient(l, &["v_x", "v_y"]);
    let v = s.all(&["v_x", "v_y"]);
    let energy = lift(s.sub(s.dot(&p, &v), l));
    let power = lift(s.dot(&s.gradient(f, &["v_x", "v_y"]), &v));
    let stated = s.sum(&[
        s.rate(energy, &names),
        s.mul(s.read("k'"), lift(s.by(l, "k"))),
        s.g.neg(s.g.div(s.mul(s.read("mu"), power), s.read("k'"))),
    ]);
    s.vanishes(s.sum(&[components[2], stated]));
}

/// The chain of eliminations for L = L_2 + L_1 + L_0: without the cyclic t the Routhian Λ - (∂Λ/∂t') t' is (Σ p v) t', the
/// integrand of (19), and with t' = √(F/(h + L_0)) it is √(2 (h + L_0)) √(2 F) + φ_1, that of (21).
#[test]
fn from_the_extended_space_to_jacobi() {
    let s = Sheet::new().positive(&["F", "k"]);
    let quadratic = "1/2 ((1 + x^2) v_x^2 + 2 x y v_x v_y + (2 + y^2) v_y^2)";
    let l = s.read(&format!("{quadratic} + y v_x - x^2 v_y - x y"));
    let lift = |e: Expr| s.put(e, &[("v_x", "w_x/w_t"), ("v_y", "w_y/w_t")]);
    let big_l = s.mul(lift(l), s.read("w_t"));
    let routhian = s.sub(big_l, s.mul(s.by(big_l, "w_t"), s.read("w_t")));
    let p = s.gradient(l, &["v_x", "v_y"]);
    let action = s.dot(&p, &s.all(&["v_x", "v_y"]));
    s.same(routhian, s.mul(lift(action), s.read("w_t")));
    // H = h fixes t'; h + L_0 =: k, F = ½ a_ij q'q'.
    let metric = s.put(s.read(quadratic), &[("v_x", "w_x"), ("v_y", "w_y")]);
    let energy = lift(s.sub(action, l));
    let level = s.sub(
        s.mul(energy, s.read("w_t^2")),
        s.mul(s.read("h"), s.read("w_t^2")),
    );
    s.vanishes(s.sub(
        level,
        s.sub(metric, s.mul(s.read("h - x y"), s.read("w_t^2"))),
    ));
    // The Routhian is 2 F/t' + φ_1.
    let linear = s.read("y w_x - x^2 w_y");
    let short = s.sum(&[s.mul(s.read("2"), s.g.div(metric, s.read("w_t"))), linear]);
    s.same(routhian, short);
    s.equal(
        s.put(s.read("2 F/w_t"), &[("w_t", "sqrt(F/k)")]),
        "sqrt(2 k) sqrt(2 F)",
    );
}

/// Jacobi's K = ½ (h + L_0)⁻¹ b_ij (p_i - a_i)(p_j - a_j) - 1 vanishes identically at p_i = ∂P/∂q'^i; with p_i - a_i replaced by
/// p_i it does not.
#[test]
fn jacobis_relation_of_the_momenta() {
    let s = Sheet::new();
    let metric = s.read("1/2 ((1 + x^2) w_x^2 + 2 x y w_x w_y + (2 + y^2) w_y^2)");
    let level = s.read("h - x y");
    let two = s.read("2");
    let linear = s.read("y w_x - x^2 w_y");
    let density = s.sum(&[
        s.mul(s.g.sqrt(s.mul(two, level)), s.g.sqrt(s.mul(two, metric))),
        linear,
    ]);
    let w = ["w_x", "w_y"];
    let momenta = s.gradient(density, &w);
    let offsets = s.gradient(linear, &w);
    let matrix: Vec<Expr> = s
        .gradient(metric, &w)
        .into_iter()
        .flat_map(|e| s.gradient(e, &w))
        .collect();
    let relation = |p: &[Expr]| {
        let raised = s.g.solve(&matrix, p).unwrap();
        let form = s.g.div(s.dot(p, &raised), s.mul(two, level));
        s.sub(form, s.read("1"))
    };
    let shifted: Vec<Expr> = momenta
        .iter()
        .zip(&offsets)
        .map(|(&p, &a)| s.sub(p, a))
        .collect();
    s.vanishes(relation(&shifted));
    s.fails(relation(&momenta));
}

/// DK = 0 along (31) for an arbitrary K(x, y) and the nonholonomic F of S3 and of S4, of degree 0; with t'F, of degree 1, only
/// where F = 0. The standard K gives t' = 1 and y_t' = -H_t - Σ μ v ∂f/∂v.
#[test]
fn relations_of_the_extended_phase_space_are_integrals() {
    let s = Sheet::new();
    let (x, y) = (["x", "y", "z", "t"], ["p_x", "p_y", "p_z", "p_t"]);
    let names: Vec<&str> = x.iter().chain(&y).copied().collect();
    let k = s.arbitrary("c", &names);
    let w = ["w_x", "w_y", "w_z", "w_t"];
    let rate_of = |k: Expr, f: Expr| {
        let velocities = s.gradient(k, &y);
        let pairs: Vec<(&str, Expr)> = w.iter().copied().zip(velocities.clone()).collect();
        let slopes = s.gradient(k, &x);
        let mut rates: Vec<(&str, Expr)> = x.iter().copied().zip(velocities).collect();
        for i in 0..4 {
            let reaction = s.mul(s.read("mu"), s.put_all(s.by(f, w[i]), &pairs));
            rates.push((y[i], s.sub(reaction, slopes[i])));
        }
        (s.along(k, &rates), s.put_all(f, &pairs), rates)
    };
    for f in ["(w_z - a sqrt(w_x^2 + w_y^2))/w_t", "(w_z - y w_x)/w_t"] {
        let (rate, _, _) = rate_of(k, s.read(f));
        s.vanishes(rate);
    }
    let (rate, f, _) = rate_of(k, s.read("w_z - y w_x"));
    s.same(rate, s.mul(s.read("mu"), f));
    s.fails(rate);
    // K = p_t + H with H = p·p/2 + t x.
    let standard = s.read("p_t + 1/2 (p_x^2 + p_y^2 + p_z^2) + t x");
    let (_, _, rates) = rate_of(standard, s.read("(w_z - y w_x + b w_t)/w_t"));
    s.equal(rates[3].1, "1");
    s.equal(rates[7].1, "-x - mu (p_z - y p_x)");
}

/// Relations with the same zero set change the parameter only: for K̂ = h K the rates are h times those of K where K = 0, with
/// μ̂ = h² μ. K² has no gradient there.
#[test]
fn relations_with_the_same_zero_set() {
    let s = Sheet::new();
    let (x, y) = (["x", "y", "z", "t"], ["p_x", "p_y", "p_z", "p_t"]);
    let w = ["w_x", "w_y", "w_z", "w_t"];
    let k = s.read("p_t + 1/2 (p_x^2 + p_y^2 + p_z^2) + t x");
    let factor = s.read("2 + x p_y + t^2");
    let f = s.read("(w_z - a sqrt(w_x^2 + w_y^2))/w_t");
    let rates = |k: Expr, mu: Expr| -> Vec<Expr> {
        let velocities = s.gradient(k, &y);
        let pairs: Vec<(&str, Expr)> = w.iter().copied().zip(velocities.clone()).collect();
        let mut rates = velocities;
        for i in 0..4 {
            let reaction = s.mul(mu, s.put_all(s.by(f, w[i]), &pairs));
            rates.push(s.sub(reaction, s.by(k, x[i])));
        }
        rates
    };
    let on_level = |e: Expr| s.put(e, &[("p_t", "-1/2 (p_x^2 + p_y^2 + p_z^2) - t x")]);
    let known = Sheet {
        g: s.g.clone(),
        known: {
            let mut known = chetaev_symbolic::zero::assumptions::Assumptions::new();
            known.positive(&s.g, factor);
            known
        },
    };
    let mu = s.read("mu");
    let scaled = rates(s.mul(factor, k), s.g.mul(&[factor, factor, mu]));
    for (a, b) in scaled.into_iter().zip(rates(k, mu)) {
        known.vanishes(on_level(s.sub(a, s.mul(factor, b))));
    }
    for name in x.iter().chain(&y) {
        s.vanishes(on_level(s.by(s.mul(k, k), name)));
    }
}

/// (24): H1 = H + Σ κ v ∂f/∂v, which is H on the constraint where f is homogeneous (S3, S4), and differs from it by κ t for
/// z' = y x' + t; and (23).
#[test]
fn the_extremal_hamiltonian() {
    let affine = PARTICLE.replace("z' = y x'", "z' = y x' + t");
    for (text, name, power) in [
        (APPELL_HAMEL, "cone", "0"),
        (PARTICLE, "c", "0"),
        (affine.as_str(), "c", "t"),
    ] {
        let case = Case::new(text);
        let s = Sheet::of(&case);
        let stated = case.equations("vakonomic");
        let kappa = s.read(&format!("kappa_{name}"));
        let cx = case.context();
        let v = case.system.velocity_symbols();
        let velocities: Vec<Expr> = case.system.coordinates.iter().map(|c| c.v).collect();
        let slopes = s.g.gradient(cx.terms.constraints[0], &v);
        let printed = s.sum(&[
            case.system.energy(),
            s.mul(kappa, s.dot(&slopes, &velocities)),
        ]);
        let found = case.object(&stated, "H1");
        assert!(case.equal_on_constraints(found, printed));
        let shift = s.sub(found, case.system.energy());
        assert!(case.equal_on_constraints(shift, s.mul(kappa, s.read(power))));
        let momenta = s.g.gradient(case.system.lagrangian, &v);
        for (i, c) in case.system.coordinates.iter().enumerate() {
            let printed = s.sum(&[momenta[i], s.mul(kappa, slopes[i])]);
            let found = case.object(&stated, &format!("pi_{}", c.name));
            assert!(case.equal_on_constraints(found, printed));
        }
    }
}

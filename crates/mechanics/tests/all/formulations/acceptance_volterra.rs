//! Acceptance of T2 §3 and §4 for m = 1: the lemmas (8), (9), (2.10), (2.18), (3.16), (3.26) and (12) for arbitrary T1(t,q,v),
//! masses μ(t), and characteristics q' = φ(t,q,P); first and second form term for term; the pendulum in its angle.
//!
//! Both forms on worked systems are in `volterra.rs`, the pendulum in Cartesian coordinates in `volterra_cartesian.rs`.

use crate::formulations::acceptance_support::Sheet;
use crate::formulations::common::Case;
use chetaev_symbolic::Expr;

const Q: [&str; 2] = ["x", "y"];
const V: [&str; 2] = ["v_x", "v_y"];
/// What moves: q is replaced by φ after the differentiation.
const MOVING: [&str; 5] = ["x", "y", "P", "mu_1", "mu_2"];

/// q' = φ(t, q, P) with arbitrary φ, n = 2 and k = 1.
struct Jet {
    s: Sheet,
    phi: Vec<Expr>,
    basis: Vec<Expr>,
}

fn jet() -> Jet {
    let s = Sheet::new();
    let phi: Vec<Expr> = ["f", "g"]
        .iter()
        .map(|prefix| s.arbitrary(prefix, &["x", "y", "P", "t"]))
        .collect();
    Jet {
        basis: phi.iter().map(|&e| s.by(e, "P")).collect(),
        phi,
        s,
    }
}

impl Jet {
    /// v = φ.
    fn restrict(&self, e: Expr) -> Expr {
        self.s
            .put_all(e, &[("v_x", self.phi[0]), ("v_y", self.phi[1])])
    }

    /// D on the jet (t, q, P, P').
    fn rate(&self, e: Expr) -> Expr {
        let raw = self.s.rate(e, &MOVING);
        self.s
            .put_all(raw, &[("x'", self.phi[0]), ("y'", self.phi[1])])
    }

    /// ∂/∂π = Σ B_s ∂/∂q^s with P held fixed.
    fn by_quasi(&self, e: Expr) -> Expr {
        self.s.dot(&self.s.gradient(e, &Q), &self.basis)
    }

    fn dot(&self, a: &[Expr], f: impl Fn(usize) -> Expr) -> Expr {
        let b: Vec<Expr> = (0..a.len()).map(f).collect();
        self.s.dot(a, &b)
    }
}

/// (2.10) and (2.18) with m = 1, in Cartesian coordinates with two different masses μ(t).
#[test]
fn lemmas_in_cartesian_coordinates() {
    let j = jet();
    let s = &j.s;
    let masses = s.all(&["mu_1", "mu_2"]);
    let momenta: Vec<Expr> = (0..2).map(|i| s.mul(masses[i], j.phi[i])).collect();
    let kinetic = s.mul(s.read("1/2"), s.dot(&momenta, &j.phi));
    let by_p = s.by(kinetic, "P");
    s.same(by_p, s.dot(&momenta, &j.basis));
    // (2.10)
    let left = j.dot(&j.basis, |i| j.rate(momenta[i]));
    let turning = j.dot(&momenta, |i| j.rate(j.basis[i]));
    s.same(left, s.sub(j.rate(by_p), turning));
    s.fails(s.sub(left, j.rate(by_p)));
    // (2.18): the braces have the factor m - 1 = 0.
    let by_quasi = j.by_quasi(kinetic);
    let bracket = j.dot(&momenta, |i| j.by_quasi(j.phi[i]));
    s.same(by_quasi, bracket);
    // (2.13) and (2.20) are the same equation; both are Σ (μ ξ'' + μ' ξ') B.
    let first = s.sub(j.rate(by_p), turning);
    let second = s.sum(&[j.rate(by_p), s.g.neg(by_quasi), s.g.neg(turning), bracket]);
    s.same(first, second);
    let newton = j.dot(&j.basis, |i| {
        let acceleration = s.mul(masses[i], j.rate(j.phi[i]));
        let loss = s.mul(s.read(["mu_1'", "mu_2'"][i]), j.phi[i]);
        s.sum(&[acceleration, loss])
    });
    s.same(first, newton);
}

/// (3.16) and (3.26) with m = 1 for arbitrary T1(t, q, v); the last sum of (3.26) must not be lost.
#[test]
fn lemmas_in_generalized_coordinates() {
    let j = jet();
    let s = &j.s;
    let kinetic = s.arbitrary("c", &["x", "y", "v_x", "v_y", "t"]);
    let full = s.gradient(kinetic, &V);
    let momenta: Vec<Expr> = full.iter().map(|&p| j.restrict(p)).collect();
    let slopes: Vec<Expr> = Q.iter().map(|q| j.restrict(s.by(kinetic, q))).collect();
    let restricted = j.restrict(kinetic);
    let by_p = s.by(restricted, "P");
    s.same(by_p, s.dot(&momenta, &j.basis));
    // (3.16)
    let lagrange = j.dot(&j.basis, |i| s.sub(j.rate(momenta[i]), slopes[i]));
    let turning = j.dot(&momenta, |i| j.rate(j.basis[i]));
    let metric = s.dot(&slopes, &j.basis);
    let first = s.sum(&[j.rate(by_p), s.g.neg(turning), s.g.neg(metric)]);
    s.same(lagrange, first);
    s.fails(s.sub(lagrange, s.sum(&[first, metric])));
    // (3.26)
    let bracket = j.dot(&momenta, |i| j.by_quasi(j.phi[i]));
    let by_quasi = j.by_quasi(restricted);
    s.same(by_quasi, s.sum(&[bracket, metric]));
    s.fails(s.sub(by_quasi, bracket));
    // (3.19) = (3.28).
    let second = s.sum(&[j.rate(by_p), s.g.neg(by_quasi), s.g.neg(turning), bracket]);
    s.same(first, second);
}

/// (12) with m = 1 for arbitrary ξ(q, t): D(∂ξ'/∂P) - ∂ξ'/∂π = Σ (∂ξ/∂q^s)(D B_s - ∂φ^s/∂π).
#[test]
fn the_chain_rule_of_the_brackets() {
    let j = jet();
    let s = &j.s;
    let place = s.arbitrary("e", &["x", "y", "t"]);
    let slopes = s.gradient(place, &Q);
    let velocity = s.sum(&[s.by(place, "t"), s.dot(&slopes, &j.phi)]);
    let left = s.sub(j.rate(s.by(velocity, "P")), j.by_quasi(velocity));
    let right = j.dot(&slopes, |i| s.sub(j.rate(j.basis[i]), j.by_quasi(j.phi[i])));
    s.same(left, right);
    // Constant B, Volterra's original case: nothing remains of the brackets.
    let constant = [
        ("f_2_3", "0"),
        ("f_1_3", "0"),
        ("g_2_3", "0"),
        ("g_1_3", "0"),
    ];
    let constant: Vec<(&str, &str)> = constant
        .into_iter()
        .chain([
            ("f_3_3", "0"),
            ("g_3_3", "0"),
            ("f_3_4", "0"),
            ("g_3_4", "0"),
        ])
        .chain(["f_1", "f_2", "g_1", "g_2"].map(|c| (c, "0")))
        .chain(["f_1_1", "f_1_2", "f_2_2", "g_1_1", "g_1_2", "g_2_2"].map(|c| (c, "0")))
        .chain(["f_1_4", "f_2_4", "g_1_4", "g_2_4"].map(|c| (c, "0")))
        .collect();
    s.vanishes(s.put(right, &constant));
    s.fails(right);
}

/// The general lemma, ∂(D^p F)/∂x^(s) = Σ_j C(p,j) D^{p-j}(∂F/∂x^(s-j)), for p ≤ 3 and a function of t, q and v; (8) and (9) are
/// its cases.
#[test]
fn derivatives_of_total_derivatives() {
    let s = Sheet::new();
    let f = s.read("t x^2 y' + y x'^3 + (1 + t^2) x' y'^2 + x y");
    let names = ["x", "y"];
    let repeated = |e: Expr, times: usize| (0..times).fold(e, |e, _| s.rate(e, &names));
    let symbol = |order: usize| format!("x{}", "'".repeat(order));
    for p in 1..=3 {
        let total = repeated(f, p);
        for order in 0..=p + 1 {
            let mut binomial = 1;
            let mut parts = Vec::new();
            for j in 0..=p.min(order) {
                let inner = repeated(s.by(f, &symbol(order - j)), p - j);
                parts.push(s.mul(s.g.integer(binomial), inner));
                binomial = binomial * (p - j) as i64 / (j + 1) as i64;
            }
            s.same(s.by(total, &symbol(order)), s.sum(&parts));
        }
    }
    // (9) with m = 2: ∂T'/∂q'' = p and ∂T'/∂q' = D p + ∂T/∂q; without the last term it is wrong.
    let (once, momentum) = (repeated(f, 1), s.by(f, "x'"));
    s.same(s.by(once, "x''"), momentum);
    let moved = s.rate(momentum, &names);
    s.same(s.by(once, "x'"), s.sum(&[moved, s.by(f, "x")]));
    s.differ(s.by(once, "x'"), moved);
}

/// The pendulum of T2 §2 in its angle, ξ = l cos θ and η = l sin θ with gravity along η: l θ'' + g cos θ = 0, and P = θ'
/// turns μ [(ξ² + η²) P' + g ξ] = 0 into μ l times it. In both forms.
#[test]
fn the_pendulum_in_its_angle() {
    let text = r#"
coordinates = ["theta"]
parameters = { mu = {}, g = {}, l = {} }
assumptions = ["mu > 0", "l > 0"]
lagrangian = { T = "1/2 mu l^2 theta'^2", V = "mu g l sin(theta)" }
"#;
    let case = Case::new(text);
    let s = Sheet::of(&case);
    let cartesian = s.put(
        s.read("mu ((xi^2 + eta^2) P' + g xi)"),
        &[
            ("xi", "l cos(theta)"),
            ("eta", "l sin(theta)"),
            ("P'", "theta''"),
        ],
    );
    s.equal(cartesian, "mu l (l theta'' + g cos(theta))");
    for form in ["volterra-first", "volterra-second"] {
        let stated = &case.equations(form).groups[0].equations[0];
        s.same(s.sub(stated.left, stated.right), cartesian);
    }
}

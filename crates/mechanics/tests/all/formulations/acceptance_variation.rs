//! Acceptance of T1 §2 and §3: the central identity (4a), the variation of a constraint under the definitions of Hölder
//! (5)–(7) and of Suslov (8), E[f] beside its contraction with virtual displacements, the curvature without solved constraints,
//! and the integrands of the four forms of Hamilton's principle (capabilities C3 and C4).
//!
//! The tables of A are in `voronets.rs`, the equations (9) and (10) in `voronets.rs` and `canonical.rs`.

use crate::formulations::acceptance_support::{chart, motion, Sheet};
use crate::formulations::common::{Case, APPELL_HAMEL, DISC, PARTICLE, SKATE};
use crate::formulations::voronets::CUBIC;
use chetaev_mechanics::curvature::curvature;
use chetaev_mechanics::{Characteristics, Prepared, Selection, System, SystemParts};
use chetaev_symbolic::Expr;

const Q: [&str; 3] = ["x", "y", "z"];
const V: [&str; 3] = ["x'", "y'", "z'"];

/// δF for δq = d_q, δv as given.
fn variation(s: &Sheet, f: Expr, names: &[&str], dv: &[Expr]) -> Expr {
    let dq: Vec<Expr> = names.iter().map(|q| s.read(&format!("d_{q}"))).collect();
    let mut parts = Vec::new();
    for (i, q) in names.iter().enumerate() {
        parts.push(s.mul(s.by(f, q), dq[i]));
        parts.push(s.mul(s.by(f, &format!("{q}'")), dv[i]));
    }
    s.sum(&parts)
}

fn displacements(s: &Sheet, names: &[&str]) -> (Vec<Expr>, Vec<Expr>) {
    let read = |suffix: &str| {
        names
            .iter()
            .map(|q| s.read(&format!("d_{q}{suffix}")))
            .collect()
    };
    (read(""), read("'"))
}

/// (4a) minus (1) for arbitrary L, Q, δq and δv, and that a wrong sign of the last sum is found.
#[test]
fn the_central_identity() {
    let s = Sheet::new();
    let names = ["x", "y"];
    let l = s.arbitrary("c", &["x", "y", "x'", "y'", "t"]);
    let (dq, d_dq) = displacements(&s, &names);
    let dv = s.all(&["w_x", "w_y"]);
    let forces = s.all(&["Q_x", "Q_y"]);
    let p = s.gradient(l, &["x'", "y'"]);
    let rate = s.rate(s.dot(&p, &dq), &["x", "y", "d_x", "d_y"]);
    let varied = variation(&s, l, &names, &dv);
    let work = s.dot(&forces, &dq);
    let gap: Vec<Expr> = d_dq.iter().zip(&dv).map(|(&a, &b)| s.sub(a, b)).collect();
    let last = s.dot(&p, &gap);
    let principle = s.sum(&[s.dot(&s.euler(l, &names), &dq), work]);
    let central = s.sub(rate, s.sum(&[varied, work, last]));
    s.vanishes(s.sum(&[central, principle]));
    let wrong = s.sum(&[s.sub(rate, s.sum(&[varied, work])), last]);
    s.fails(s.sum(&[wrong, principle]));
}

/// A system z' = φ(x, y, z, x', y', t) with arbitrary L and φ, all coefficients parameters.
struct General {
    s: Sheet,
    system: System,
    phi: Expr,
    curvature: Vec<Expr>,
}

fn general() -> General {
    let s = Sheet::new();
    let g = s.g.clone();
    let l = s.arbitrary("c", &["x", "y", "z", "x'", "y'", "z'", "t"]);
    let phi = s.arbitrary("e", &["x", "y", "z", "x'", "y'", "t"]);
    let parts = SystemParts {
        name: "general".into(),
        coordinates: Q.iter().map(|q| q.to_string()).collect(),
        lagrangian: Some(l),
        constraints: vec![("c".into(), s.sub(s.read("z'"), phi))],
        ..SystemParts::default()
    };
    let system = System::new(g, parts).unwrap();
    let prepared = Prepared::new(&system).unwrap();
    let selection = Selection {
        rows: vec![0],
        dependent: vec![2],
    };
    let chart =
        Characteristics::independent_velocities(&system, &prepared.terms, &selection).unwrap();
    let curvature = curvature(&system, &chart).swap_remove(0);
    General {
        curvature,
        s,
        system,
        phi,
    }
}

impl General {
    /// On the manifold: z' = φ. The curvature and the momenta may contain the symbol z'.
    fn restrict(&self, e: Expr) -> Expr {
        let s = &self.s;
        let rate = s.rate(self.phi, &Q);
        let e = s.put_all(e, &[("z''", rate)]);
        s.put_all(e, &[("z'", self.phi)])
    }

    /// δq with the virtual δz, and D(δq).
    fn virtual_displacement(&self) -> (Vec<Expr>, Vec<Expr>) {
        let s = &self.s;
        let slopes = s.gradient(self.phi, &["x'", "y'"]);
        let independent = s.all(&["d_x", "d_y"]);
        let dz = s.dot(&slopes, &independent);
        let rate = s.rate(dz, &["x", "y", "z", "d_x", "d_y"]);
        let dq = vec![independent[0], independent[1], dz];
        let d_dq = vec![s.read("d_x'"), s.read("d_y'"), rate];
        (
            dq.into_iter().map(|e| self.restrict(e)).collect(),
            d_dq.into_iter().map(|e| self.restrict(e)).collect(),
        )
    }

    /// The variation of a function of (q, v, t).
    fn varied(&self, f: Expr, dq: &[Expr], dv: &[Expr]) -> Expr {
        let s = &self.s;
        let mut parts = Vec::new();
        for i in 0..3 {
            parts.push(s.mul(self.restrict(s.by(f, Q[i])), dq[i]));
            parts.push(s.mul(self.restrict(s.by(f, V[i])), dv[i]));
        }
        s.sum(&parts)
    }

    /// Σ A_s δq^s.
    fn turning(&self, dq: &[Expr]) -> Expr {
        let parts: Vec<Expr> = self.curvature.iter().map(|&a| self.restrict(a)).collect();
        self.s.dot(&parts, &dq[..2])
    }
}

/// (5), (6) and (8) with the curvature of the product, for arbitrary φ; with the last term of (7) lost they fail.
#[test]
fn the_variation_of_the_dependent_velocity() {
    let n = general();
    let s = &n.s;
    let (dq, holder) = n.virtual_displacement();
    let turning = n.turning(&dq);
    let of_phi = n.varied(n.phi, &dq, &holder);
    // (6)
    s.same(holder[2], s.sum(&[of_phi, turning]));
    // (5): δf = Σ E_i[f] δq^i, and for f = z' - φ it is Σ A_s δq^s.
    let f = s.sub(s.read("z'"), n.phi);
    let of_f = n.varied(f, &dq, &holder);
    let euler: Vec<Expr> = s.euler(f, &Q).into_iter().map(|e| n.restrict(e)).collect();
    s.same(of_f, s.dot(&euler, &dq));
    s.same(of_f, turning);
    // (8): under Suslov's rule δf = 0, and δ_S v differs from D(δq) by the curvature.
    let suslov = vec![holder[0], holder[1], of_phi];
    s.vanishes(n.varied(f, &dq, &suslov));
    s.same(suslov[2], s.sub(holder[2], turning));
    // (7) without the product of ∂φ/∂z and ∂φ/∂v.
    let slope = n.restrict(s.by(n.phi, "z"));
    let lost = s.mul(slope, dq[2]);
    s.fails(s.sub(of_f, s.sum(&[turning, lost])));
}

/// Hölder's, Voronets' and Suslov's integrands are one function, Σ (L_q δq + p D(δq)), for arbitrary L(q,v,t), φ and δq.
#[test]
fn three_integrands_of_hamiltons_principle_are_one() {
    let n = general();
    let s = &n.s;
    let l = n.system.lagrangian;
    let (dq, holder) = n.virtual_displacement();
    let common = {
        let slopes: Vec<Expr> = Q.iter().map(|q| n.restrict(s.by(l, q))).collect();
        let p: Vec<Expr> = V.iter().map(|v| n.restrict(s.by(l, v))).collect();
        s.sum(&[s.dot(&slopes, &dq), s.dot(&p, &holder)])
    };
    let of_phi = n.varied(n.phi, &dq, &holder);
    let theta = n.restrict(s.by(l, "z'"));
    let restricted = n.restrict(l);
    // δL*, with δz from (C') and D(δq^s); L* contains no z'.
    let of_restricted = n.varied(restricted, &dq, &holder);
    let gap = s.sub(holder[2], of_phi);
    s.same(n.varied(l, &dq, &holder), common);
    s.same(s.sum(&[of_restricted, s.mul(theta, gap)]), common);
    let suslov = n.varied(l, &dq, &[holder[0], holder[1], of_phi]);
    s.same(suslov, of_restricted);
    s.same(s.sum(&[suslov, s.mul(theta, n.turning(&dq))]), common);
    // δL* alone is not the integrand.
    s.fails(s.sub(of_restricted, common));
}

/// The integrand of Helmholtz and Poincaré differs from the others by Σ δp_i (q'^i - ∂H/∂p_i), for an arbitrary L with a
/// regular Hessian, δq virtual or not, δp free.
#[test]
fn the_fourth_integrand_differs_by_the_kinematic_law() {
    let s = Sheet::new();
    let l = s.arbitrary("c", &["x", "y", "z", "u_x", "u_y", "u_z", "t"]);
    let (u, p) = (["u_x", "u_y", "u_z"], ["p_x", "p_y", "p_z"]);
    // v(q, p, t) from p = ∂L/∂v, linear in v.
    let stated = s.gradient(l, &u);
    let rows: Vec<Expr> = stated.iter().flat_map(|&e| s.gradient(e, &u)).collect();
    let rest: Vec<Expr> = stated
        .iter()
        .zip(p)
        .map(|(&e, p)| {
            s.sub(
                s.read(p),
                s.put(e, &[("u_x", "0"), ("u_y", "0"), ("u_z", "0")]),
            )
        })
        .collect();
    let v = s.g.solve(&rows, &rest).unwrap();
    let at = |e: Expr| s.put_all(e, &[("u_x", v[0]), ("u_y", v[1]), ("u_z", v[2])]);
    let hamiltonian = s.sub(s.dot(&s.all(&p), &v), at(l));
    let (dq, d_dq) = displacements(&s, &Q);
    let dp = s.all(&["d_p_x", "d_p_y", "d_p_z"]);
    let slopes = s.gradient(hamiltonian, &p);
    let mut varied = s.sum(&[s.dot(&dp, &s.all(&V)), s.dot(&s.all(&p), &d_dq)]);
    for i in 0..3 {
        let of_h = s.sum(&[
            s.mul(s.by(hamiltonian, Q[i]), dq[i]),
            s.mul(slopes[i], dp[i]),
        ]);
        varied = s.sub(varied, of_h);
    }
    let of_l: Vec<Expr> = Q.iter().map(|q| at(s.by(l, q))).collect();
    let common = s.sum(&[s.dot(&of_l, &dq), s.dot(&s.all(&p), &d_dq)]);
    let gap: Vec<Expr> = s
        .all(&V)
        .into_iter()
        .zip(&slopes)
        .map(|(a, &b)| s.sub(a, b))
        .collect();
    let difference = s.sub(varied, common);
    s.same(difference, s.dot(&dp, &gap));
    s.fails(difference);
}

/// E_i[f] of every constraint, as a function of (q, v, a).
fn euler_rows(case: &Case) -> Vec<Vec<Expr>> {
    let s = Sheet::of(case);
    let names: Vec<&str> = case
        .system
        .coordinates
        .iter()
        .map(|c| c.name.as_str())
        .collect();
    let cx = case.context();
    cx.terms
        .constraints
        .iter()
        .map(|&f| s.euler(f, &names))
        .collect()
}

/// S1 with δq = (cos φ ds, sin φ ds, dφ): δf = -φ' ds + u dφ. S3 with δq along and across: δf = a ψ' dn; it vanishes on every
/// motion, where ψ' = 0, although no motion makes E[f] vanish off that.
#[test]
fn variations_of_the_constraints_of_the_notes() {
    let skate = Case::new(SKATE);
    let s = Sheet::of(&skate);
    let rows = euler_rows(&skate);
    let dq = s.all(&["cos(phi) ds", "sin(phi) ds", "dphi"]);
    let of_f = s.put(
        s.dot(&rows[0], &dq),
        &[("x'", "u cos(phi)"), ("y'", "u sin(phi)")],
    );
    s.equal(of_f, "-phi' ds + u dphi");

    let cone = Case::new(APPELL_HAMEL);
    let s = Sheet::of(&cone).positive(&["rho"]);
    let rows = euler_rows(&cone);
    let polar = [
        ("x''", "rho' cos(psi) - rho psi' sin(psi)"),
        ("y''", "rho' sin(psi) + rho psi' cos(psi)"),
        ("x'", "rho cos(psi)"),
        ("y'", "rho sin(psi)"),
    ];
    let row: Vec<Expr> = rows[0].iter().map(|&e| s.put(e, &polar)).collect();
    for (e, printed) in row.iter().zip(["-a psi' sin(psi)", "a psi' cos(psi)", "0"]) {
        s.equal(*e, printed);
    }
    let dq = s.all(&[
        "cos(psi) ds - sin(psi) dn",
        "sin(psi) ds + cos(psi) dn",
        "a ds",
    ]);
    s.equal(s.dot(&row, &dq), "a psi' dn");
    // Case (i): zero with the accelerations of the motion put in.
    let g = &cone.system.graph;
    let motion = motion(&cone);
    for e in curvature(&cone.system, &chart(&cone, &[2])).concat() {
        assert!(!cone.equal_on_constraints(e, g.zero()));
        assert!(cone.equal_on_constraints(g.substitute(e, &motion), g.zero()));
    }
}

/// f = e^x (z' - y x' - x y'): E[f] is not zero, its contraction with virtual displacements is, on f = 0. For z' - y x' - x y'
/// itself E[f] = 0; for the nonintegrable z' - y x' the contraction is not zero.
#[test]
fn an_integrable_constraint_with_a_factor() {
    let with = |constraint: &str| Case::new(&PARTICLE.replace("z' = y x'", constraint));
    let contraction = |case: &Case| {
        let rows = euler_rows(case);
        let c = chart(case, &[2]);
        c.contract(&case.system, &rows[0])
    };
    let case = with("exp(x) (z' - y x' - x y') = 0");
    let zero = case.read("0");
    let rows = euler_rows(&case);
    assert!(rows[0].iter().any(|&e| !case.equal_on_constraints(e, zero)));
    for e in contraction(&case) {
        assert!(case.equal_on_constraints(e, zero));
    }
    let plain = with("z' = y x' + x y'");
    for e in euler_rows(&plain).concat() {
        assert!(plain.equal(e, plain.read("0")));
    }
    let particle = Case::new(PARTICLE);
    let of_f = contraction(&particle);
    assert!(!particle.equal_on_constraints(of_f[0], particle.read("0")));
}

/// A^l_s = Σ_m [f_d⁻¹]^l_m Σ_i E_i[f^m] B_is on Df = 0, also for a constraint that is not solved; and the rows do not depend on
/// how f is written: h f has the same.
#[test]
fn the_curvature_from_the_euler_operator() {
    let scaled = SKATE.replace(
        "x' sin(phi) = y' cos(phi)",
        "(2 + cos(x)) (x' sin(phi) - y' cos(phi)) = 0",
    );
    let cases = [
        (SKATE, vec![1]),
        (scaled.as_str(), vec![1]),
        (DISC, vec![2, 3]),
        (APPELL_HAMEL, vec![2]),
        (PARTICLE, vec![2]),
        (CUBIC, vec![2]),
    ];
    for (text, dependent) in cases {
        let case = Case::new(text);
        let g = &case.system.graph;
        let c = chart(&case, &dependent);
        let cx = case.context();
        let by_solved = curvature(&case.system, &c);
        let contracted: Vec<Vec<Expr>> = euler_rows(&case)
            .iter()
            .map(|row| c.contract(&case.system, row))
            .collect();
        let matrix: Vec<Expr> = cx
            .terms
            .jacobian
            .iter()
            .flat_map(|row| dependent.iter().map(|&d| row[d]))
            .collect();
        for sigma in 0..c.k() {
            let column: Vec<Expr> = contracted.iter().map(|row| row[sigma]).collect();
            let solved = g.solve(&matrix, &column).unwrap();
            for (l, e) in solved.into_iter().enumerate() {
                let difference = c.on_jet(&case.system, &[g.sub(e, by_solved[l][sigma])]);
                let verdict = cx
                    .prover
                    .identity(&case.system, &difference, &c.manifold, "");
                assert_eq!(verdict.word(), "proved", "{text}");
            }
        }
    }
}

/// Σ A_s v^s vanishes for constraints homogeneous of degree 1 without time (`voronets.rs`); with the time in z' = t x' it is x'.
#[test]
fn the_contraction_needs_constraints_without_time() {
    let case = Case::new(&PARTICLE.replace("z' = y x'", "z' = t x'"));
    let s = Sheet::of(&case);
    let a = curvature(&case.system, &chart(&case, &[2]));
    let contracted = s.dot(&a[0], &s.all(&["x'", "y'"]));
    s.equal(contracted, "x'");
}

/// f^l = M^l_m(q) Dg^m with two constraints: A = 0 and δf = 0 for virtual δq, but E[f] ≠ 0; with one term of Dg changed A ≠ 0.
#[test]
fn integrable_constraints_mixed_by_functions() {
    let text = |first: &str| {
        let second = "(w' - 2 x x')";
        format!(
            "coordinates = [\"x\", \"y\", \"z\", \"w\"]\nlagrangian = {{ L = \"1/2 (x'^2 + y'^2 + z'^2 + w'^2)\" }}\n\
             constraints = {{ a = \"{first} + y {second} = 0\", b = \"exp(x) {second} - y^2 {first} = 0\" }}\n"
        )
    };
    let curvatures = |case: &Case| curvature(&case.system, &chart(case, &[2, 3])).concat();
    let case = Case::new(&text("(z' - y x' - x y')"));
    let zero = case.read("0");
    for e in curvatures(&case) {
        assert!(case.equal_on_constraints(e, zero));
    }
    let rows = euler_rows(&case);
    assert!(rows
        .concat()
        .iter()
        .any(|&e| !case.equal_on_constraints(e, zero)));
    let c = chart(&case, &[2, 3]);
    let s = Sheet::of(&case);
    // Df = 0 gives the dependent accelerations.
    for row in &rows {
        for e in c.contract(&case.system, row) {
            let on_set = c.on_jet(&case.system, &[e])[0];
            s.vanishes(on_set);
        }
    }
    let other = Case::new(&text("(z' - y x' - 2 x y')"));
    let found = curvatures(&other);
    assert!(found
        .iter()
        .any(|&e| !other.equal_on_constraints(e, other.read("0"))));
}

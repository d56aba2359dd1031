//! Acceptance of T1 §7 (Zhu): the identities (33), (34), (35), the kinematic law and singular Hessians, (40), the universal
//! relation (41)–(43) with a symbolic operator of first order, the four operators, the damped oscillator and S4 with operator 3
//! (capabilities C14, C15, C16).
//!
//! L(q,v,t) is arbitrary up to its second derivatives; v and Dq are different symbols (`v_x` and `x'`) where the theory keeps them
//! apart. Z, λ and H of S4 and of the coupled mass matrix are in `state_space.rs` and `state_space_canonical.rs`.

use crate::formulations::acceptance_support::{chart, Sheet};
use crate::formulations::common::{Case, PARTICLE};
use chetaev_mechanics::curvature::curvature;
use chetaev_symbolic::Expr;

/// What moves along a curve of the state space.
const MOVING: [&str; 8] = ["x", "y", "v_x", "v_y", "d_x", "d_y", "d_v_x", "d_v_y"];
const Q: [&str; 2] = ["x", "y"];
const V: [&str; 2] = ["v_x", "v_y"];

/// Two coordinates, with v apart from Dq.
struct Plane {
    s: Sheet,
    lagrangian: Expr,
    momenta: Vec<Expr>,
}

fn plane() -> Plane {
    let s = Sheet::new();
    let lagrangian = s.arbitrary("c", &["x", "y", "v_x", "v_y", "t"]);
    Plane {
        momenta: s.gradient(lagrangian, &V),
        lagrangian,
        s,
    }
}

impl Plane {
    fn rate(&self, e: Expr) -> Expr {
        self.s.rate(e, &MOVING)
    }

    /// δ with δ(Dq) = D(δq).
    fn varied(&self, e: Expr) -> Expr {
        let s = &self.s;
        let rates: Vec<(String, Expr)> = Q
            .iter()
            .chain(&V)
            .flat_map(|name| {
                [
                    (name.to_string(), s.read(&format!("d_{name}"))),
                    (format!("{name}'"), s.read(&format!("d_{name}'"))),
                ]
            })
            .collect();
        let rates: Vec<(&str, Expr)> = rates.iter().map(|(n, e)| (n.as_str(), *e)).collect();
        s.along(e, &rates)
    }

    /// Dq - v.
    fn gap(&self) -> Vec<Expr> {
        let s = &self.s;
        vec![s.read("x' - v_x"), s.read("y' - v_y")]
    }

    fn z(&self) -> Expr {
        let s = &self.s;
        s.sum(&[self.lagrangian, s.dot(&self.gap(), &self.momenta)])
    }

    /// The left side of (34).
    fn principle(&self) -> Expr {
        let s = &self.s;
        let mut parts = Vec::new();
        for i in 0..2 {
            let euler = s.sum(&[
                s.g.neg(self.rate(self.momenta[i])),
                s.by(self.lagrangian, Q[i]),
                s.read(["Q_x", "Q_y"][i]),
            ]);
            parts.push(s.mul(euler, s.read(["d_x", "d_y"][i])));
            parts.push(s.mul(self.gap()[i], self.varied(self.momenta[i])));
        }
        s.sum(&parts)
    }
}

/// (33): ∂u/∂v^s = ∂r/∂q^s, and D(∂r/∂q^s) = ∂u/∂q^s + Σ (Dq^j - v^j) ∂²r/∂q^s∂q^j for arbitrary r(q,t).
#[test]
fn generalized_relations_of_lagrange() {
    let s = Sheet::new();
    let r = s.arbitrary("c", &["x", "y", "t"]);
    let slopes = s.gradient(r, &Q);
    let u = s.sum(&[s.by(r, "t"), s.dot(&slopes, &s.all(&V))]);
    for i in 0..2 {
        s.same(s.by(u, V[i]), slopes[i]);
        let second = s.gradient(slopes[i], &Q);
        let gap = s.all(&["x' - v_x", "y' - v_y"]);
        let rate = s.rate(slopes[i], &MOVING);
        let stated = s.sum(&[s.by(u, Q[i]), s.dot(&second, &gap)]);
        s.same(rate, stated);
        s.differ(rate, s.by(u, Q[i]));
    }
}

/// (32) in generalized coordinates is (34): the second derivatives of r cancel. One component of one particle with an arbitrary
/// r(q,t); others add.
#[test]
fn the_particle_principle_is_the_lagrange_form() {
    let s = Sheet::new();
    let r = s.arbitrary("c", &["x", "y", "t"]);
    let slopes = s.gradient(r, &Q);
    let u = s.sum(&[s.by(r, "t"), s.dot(&slopes, &s.all(&V))]);
    let lagrangian = s.mul(s.read("m/2"), s.g.powi(u, 2));
    let p = Plane {
        momenta: s.gradient(lagrangian, &V),
        lagrangian,
        s,
    };
    let s = &p.s;
    let newton = s.sub(s.read("F"), s.mul(s.read("m"), p.rate(u)));
    let kinematic = s.mul(s.read("m"), s.sub(p.rate(r), u));
    let stated = s.sum(&[s.mul(newton, p.varied(r)), s.mul(kinematic, p.varied(u))]);
    let force = s.read("F");
    let lagrange = s.put_all(
        p.principle(),
        &[
            ("Q_x", s.mul(force, slopes[0])),
            ("Q_y", s.mul(force, slopes[1])),
        ],
    );
    s.same(stated, lagrange);
}

/// (35): (34) = δZ + Σ Q δq - D(Σ p δq) on arbitrary curves; Z varied by v^j gives Σ_s W_js (Dq^s - v^s), and δv occurs through
/// these sums only.
#[test]
fn the_density_of_the_second_kind() {
    let p = plane();
    let s = &p.s;
    let z = p.z();
    let displacement = s.all(&["d_x", "d_y"]);
    let boundary = p.rate(s.dot(&p.momenta, &displacement));
    let work = s.dot(&s.all(&["Q_x", "Q_y"]), &displacement);
    let stated = s.sub(s.sum(&[p.varied(z), work]), boundary);
    s.same(stated, p.principle());
    s.differ(s.sum(&[p.varied(z), work]), p.principle());
    for (j, v) in V.iter().enumerate() {
        let row = s.gradient(p.momenta[j], &V);
        let kinematic = s.dot(&row, &p.gap());
        s.same(s.by(z, v), kinematic);
        s.same(s.by(p.principle(), &format!("d_{v}")), kinematic);
        s.vanishes(s.by(z, &format!("{v}'")));
    }
    // Euler's expressions of Z by q are those of (38) where Dq = v.
    for (i, q) in Q.iter().enumerate() {
        let of_z = s.sub(s.by(z, q), p.rate(s.by(z, &format!("{q}'"))));
        let on_path = [("x'", "v_x"), ("y'", "v_y")];
        let lagrange = s.sub(s.by(p.lagrangian, q), p.rate(p.momenta[i]));
        s.same(s.put(of_z, &on_path), s.put(lagrange, &on_path));
        s.differ(of_z, lagrange);
    }
}

/// A singular Hessian does not give Dq = v: L = q1 v2 - V leaves no equation, L = (v1 + v2)²/2 the sum only.
#[test]
fn singular_hessians_leave_the_kinematics_open() {
    let laws = |text: &str| {
        let s = Sheet::new();
        let lagrangian = s.read(text);
        let p = Plane {
            momenta: s.gradient(lagrangian, &V),
            lagrangian,
            s,
        };
        let z = p.z();
        let found = p.s.gradient(z, &V);
        (p, found)
    };
    let (p, found) = laws("x v_y - x^2 y");
    for e in found {
        p.s.vanishes(e);
    }
    let (p, found) = laws("1/2 (v_x + v_y)^2");
    for e in found {
        p.s.equal(e, "x' + y' - v_x - v_y");
    }
    let (p, found) = laws("1/2 v_x^2 + 1/2 v_y^2");
    p.s.equal(found[0], "x' - v_x");
}

/// (38) of S4: Dv_x = -y λ, Dv_y = 0, Dv_z = λ with f = v_z - y v_x, and λ = v_x Dy/(1 + y²), on arbitrary curves q(t).
#[test]
fn closed_equations_of_the_particle() {
    let s = Sheet::new();
    let moving = ["x", "y", "z", "v_x", "v_y", "v_z"];
    let z = s.read("(v_x^2 + v_y^2 + v_z^2)/2 + (x' - v_x) v_x + (y' - v_y) v_y + (z' - v_z) v_z");
    let f = s.read("v_z - y v_x");
    let mut rates = Vec::new();
    for q in ["x", "y", "z"] {
        s.equal(s.by(z, &format!("v_{q}")), &format!("{q}' - v_{q}"));
        let euler = s.sub(s.rate(s.by(z, &format!("{q}'")), &moving), s.by(z, q));
        s.equal(euler, &format!("v_{q}'"));
        let reaction = s.mul(s.read("lambda"), s.by(f, &format!("v_{q}")));
        rates.push((format!("v_{q}'"), reaction));
    }
    let rates: Vec<(&str, Expr)> = rates.iter().map(|(n, e)| (n.as_str(), *e)).collect();
    let of_f = s.put_all(s.rate(f, &moving), &rates);
    s.vanishes(s.put(of_f, &[("lambda", "v_x y'/(1 + y^2)")]));
    s.fails(s.put(of_f, &[("lambda", "v_x x'/(1 + y^2)")]));
}

/// (40): (∂u/∂p) H_pp⁻¹ = ∂f/∂v at v = ∂H/∂p for arbitrary L with a regular Hessian and arbitrary f; ∂u/∂p alone is not.
#[test]
fn chetaevs_condition_in_momenta() {
    let p = plane();
    let s = &p.s;
    let f = s.arbitrary("e", &["x", "y", "v_x", "v_y", "t"]);
    let names = ["p_x", "p_y"];
    let hessian: Vec<Expr> = p.momenta.iter().flat_map(|&e| s.gradient(e, &V)).collect();
    let at_rest = [("v_x", "0"), ("v_y", "0")];
    let right: Vec<Expr> = p
        .momenta
        .iter()
        .zip(names)
        .map(|(&e, name)| s.sub(s.read(name), s.put(e, &at_rest)))
        .collect();
    let v = s.g.solve(&hessian, &right).unwrap();
    let at = |e: Expr| s.put_all(e, &[("v_x", v[0]), ("v_y", v[1])]);
    let h = s.sub(s.dot(&s.all(&names), &v), at(p.lagrangian));
    let by_p = s.gradient(h, &names);
    let second: Vec<Expr> = by_p.iter().flat_map(|&e| s.gradient(e, &names)).collect();
    for (&a, &b) in by_p.iter().zip(&v) {
        s.same(a, b);
    }
    let u = s.gradient(at(f), &names);
    // H_pp is symmetric, so the row times its inverse is a solution of a linear system.
    let gradient = s.g.solve(&second, &u).unwrap();
    for (&e, name) in gradient.iter().zip(V) {
        s.same(e, at(s.by(f, name)));
    }
    s.differ(u[0], at(s.by(f, "v_x")));
}

/// An integrand linear in δq and D(δq), and the covector that multiplies δq after integration by parts.
fn covector(p: &Plane, integrand: Expr, moving: &[&str]) -> Vec<Expr> {
    let s = &p.s;
    ["d_x", "d_y"]
        .iter()
        .map(|d| {
            let of_rate = s.rate(s.by(integrand, &format!("{d}'")), moving);
            s.sub(s.by(integrand, d), of_rate)
        })
        .collect()
}

/// The integrand (43), or (41) where δv is left free, with v = Dq on the path.
fn integrand(p: &Plane, relation: &[Expr]) -> Expr {
    let s = &p.s;
    let mut parts = Vec::new();
    for i in 0..2 {
        let (q, d) = (Q[i], ["d_x", "d_y"][i]);
        parts.push(s.mul(s.by(p.lagrangian, q), s.read(d)));
        parts.push(s.mul(p.momenta[i], relation[i]));
        let gap = s.sub(s.read(&format!("{d}'")), relation[i]);
        parts.push(s.mul(p.momenta[i], gap));
        parts.push(s.mul(s.read(["Q_x", "Q_y"][i]), s.read(d)));
    }
    s.sum(&parts)
}

/// A symbolic relation δv^s = Σ_j (a_sj δq^j + b_sj D(δq^j)) with coefficients that change along the path.
fn symbolic_relation(s: &Sheet) -> Vec<Expr> {
    ["1", "2"]
        .iter()
        .map(|i| s.read(&format!("a{i}1 d_x + a{i}2 d_y + b{i}1 d_x' + b{i}2 d_y'")))
        .collect()
}

/// (41)–(43): with any relation the covector is L_q - Dp + Q, with no coefficient of the relation left; δv that stays free has
/// the coefficient 0. First kind, intermediate and second kind.
#[test]
fn the_universal_relation_is_a_gauge() {
    let p = plane();
    let s = &p.s;
    let mut moving = MOVING.to_vec();
    moving.extend([
        "a11", "a12", "a21", "a22", "b11", "b12", "b21", "b22", "Q_x", "Q_y",
    ]);
    let full = symbolic_relation(s);
    let free = s.all(&["w_x", "w_y"]);
    for relation in [full.clone(), vec![full[0], free[1]], free.clone()] {
        let principle = integrand(&p, &relation);
        for name in ["w_x", "w_y"] {
            s.vanishes(s.by(principle, name));
        }
        for (i, e) in covector(&p, principle, &moving).into_iter().enumerate() {
            let euler = s.sub(s.by(p.lagrangian, Q[i]), s.rate(p.momenta[i], &moving));
            s.same(e, s.sum(&[euler, s.read(["Q_x", "Q_y"][i])]));
        }
    }
}

/// If Dq = v is not imposed, the relation δv = D(δq) turns (37) into other equations: L = v²/2 - V(q) gives q'' = -V' and nothing
/// on v.
#[test]
fn the_kinematic_law_is_a_hypothesis_of_the_first_kind() {
    let s = Sheet::new();
    let lagrangian = s.read("1/2 v_x^2 + 1/2 v_y^2 - x^2 y");
    let p = Plane {
        momenta: s.gradient(lagrangian, &V),
        lagrangian,
        s,
    };
    let s = &p.s;
    let tied = s.put_all(
        p.varied(p.z()),
        &[("d_v_x", s.read("d_x'")), ("d_v_y", s.read("d_y'"))],
    );
    let found = covector(&p, tied, &MOVING);
    s.equal(found[0], "-2 x y - x''");
    s.equal(found[1], "-x^2 - y''");
}

/// The four operators: what (43) becomes, and that every one gives L_q - Dp + Q.
#[test]
fn the_four_operators() {
    let p = plane();
    let s = &p.s;
    let mut moving = MOVING.to_vec();
    moving.extend(["Q_x", "Q_y"]);
    let displacement = s.all(&["d_x", "d_y"]);
    let rates = s.all(&["d_x'", "d_y'"]);
    let forces = s.all(&["Q_x", "Q_y"]);
    let slopes = s.gradient(p.lagrangian, &Q);
    let work = s.dot(&forces, &displacement);
    let of_q = s.dot(&slopes, &displacement);
    let varied = |dv: &[Expr]| s.sum(&[of_q, s.dot(&p.momenta, dv)]);
    // 1: δv = 0.
    let zero = s.all(&["0", "0"]);
    let central = s.sum(&[of_q, s.dot(&p.momenta, &rates), work]);
    s.same(integrand(&p, &zero), central);
    // 2: Hölder.
    s.same(integrand(&p, &rates), s.sum(&[varied(&rates), work]));
    // 4: Vujanović, ∫ δL dt.
    let vujanovic: Vec<Expr> = (0..2)
        .map(|i| {
            let shift = s.mul(s.g.div(forces[i], p.momenta[i]), displacement[i]);
            s.sum(&[rates[i], shift])
        })
        .collect();
    s.same(integrand(&p, &vujanovic), varied(&vujanovic));
    s.differ(integrand(&p, &vujanovic), varied(&rates));
    // Without the poles p_s = 0: any relation with Σ p_s (A_s - D δq^s) = Σ Q_s δq^s.
    let square = s.dot(&p.momenta, &p.momenta);
    let regular: Vec<Expr> = (0..2)
        .map(|i| {
            let shift = s.g.div(s.mul(p.momenta[i], work), square);
            s.sum(&[rates[i], shift])
        })
        .collect();
    s.same(integrand(&p, &regular), varied(&regular));
    for relation in [zero, rates.clone(), vujanovic, regular] {
        for (i, e) in covector(&p, integrand(&p, &relation), &moving)
            .into_iter()
            .enumerate()
        {
            let euler = s.sub(slopes[i], s.rate(p.momenta[i], &moving));
            s.same(e, s.sum(&[euler, forces[i]]));
        }
    }
}

/// The damped oscillator: operator 4 is δv = D(δq) - (g/m) δq, and ∫ δL dt = 0 gives m q'' + g q' + c q = 0. Hölder's rule in
/// ∫ δL dt loses the damping.
#[test]
fn the_damped_oscillator() {
    let s = Sheet::new();
    let l = s.read("1/2 (m v^2 - c q^2)");
    let relation = s.sum(&[
        s.read("d'"),
        s.mul(s.g.div(s.read("-g v"), s.by(l, "v")), s.read("d")),
    ]);
    s.equal(relation, "d' - g/m d");
    let equation = |relation: Expr| {
        let varied = s.sum(&[
            s.mul(s.by(l, "q"), s.read("d")),
            s.mul(s.by(l, "v"), relation),
        ]);
        let varied = s.put(varied, &[("v", "q'")]);
        s.sub(s.by(varied, "d"), s.rate(s.by(varied, "d'"), &["q"]))
    };
    s.equal(equation(relation), "-(m q'' + g q' + c q)");
    s.equal(equation(s.read("d'")), "-(m q'' + c q)");
}

/// S4 with operator 3: the integrand is Suslov's, and integrated by parts with virtual δq it is (9).
#[test]
fn the_particle_with_suslovs_operator() {
    let case = Case::new(PARTICLE);
    let s = Sheet::of(&case);
    let a = curvature(&case.system, &chart(&case, &[2]));
    let l = case.system.lagrangian;
    let names = ["x", "y", "d_x", "d_y"];
    let on_set = [("z'", "y x'")];
    let dq = s.all(&["d_x", "d_y", "y d_x"]);
    let holder = s.all(&["d_x'", "d_y'", "y d_x' + y' d_x"]);
    let turning = s.dot(&a[0], &dq[..2]);
    let suslov = [holder[0], holder[1], s.sub(holder[2], turning)];
    let p = s.gradient(l, &["x'", "y'", "z'"]);
    // (43) with δv = A(δq).
    let varied = s.sum(&[
        s.dot(&s.gradient(l, &["x", "y", "z"]), &dq),
        s.dot(&p, &suslov),
    ]);
    let gap: Vec<Expr> = holder
        .iter()
        .zip(&suslov)
        .map(|(&a, &b)| s.sub(a, b))
        .collect();
    let principle = s.put(s.sum(&[varied, s.dot(&p, &gap)]), &on_set);
    // δ_S L + θ Σ A δq, with δ_S L = δL*.
    let restricted = s.read("1/2 ((1 + y^2) x'^2 + y'^2)");
    let of_restricted = s.along(
        restricted,
        &[("x'", holder[0]), ("y'", holder[1]), ("y", dq[1])],
    );
    let own = s.sum(&[of_restricted, s.mul(s.read("y x'"), turning)]);
    s.same(principle, own);
    let stated = [
        "-((1 + y^2) x'' + 2 y x' y') + y x' y'",
        "-(y'' - y x'^2) - y x' x'",
    ];
    for (d, printed) in ["d_x", "d_y"].iter().zip(stated) {
        let of_rate = s.rate(s.by(own, &format!("{d}'")), &names);
        s.equal(s.sub(s.by(own, d), of_rate), printed);
    }
}

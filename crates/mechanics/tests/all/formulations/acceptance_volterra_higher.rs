//! Acceptance of T2 §4 for m = 2 and 3: the lemmas (8), (2.10) and (2.18) in Cartesian coordinates with two masses μ(t), and
//! E8, a metric that depends on coordinates and time, with a mass μ(t).

use crate::formulations::acceptance_support::Sheet;
use crate::formulations::common::{expect, Case};
use chetaev_symbolic::Expr;

fn primes(name: &str, order: usize) -> String {
    format!("{name}{}", "'".repeat(order))
}

/// q^(m) = φ(t, q, …, q^(m-1), P), n = 2 and k = 1, on the sheet of names.
struct Jet<'a> {
    s: &'a Sheet,
    m: usize,
    names: [&'a str; 2],
    /// What moves beside the coordinates and P.
    masses: &'a [&'a str],
    phi: [Expr; 2],
    basis: Vec<Expr>,
}

impl<'a> Jet<'a> {
    fn new(
        s: &'a Sheet,
        m: usize,
        names: [&'a str; 2],
        masses: &'a [&'a str],
        phi: [Expr; 2],
    ) -> Jet<'a> {
        Jet {
            basis: phi.iter().map(|&e| s.by(e, "P")).collect(),
            s,
            m,
            names,
            masses,
            phi,
        }
    }

    /// q^(m) = φ.
    fn restrict(&self, e: Expr) -> Expr {
        let [x, y] = self.names.map(|n| primes(n, self.m));
        self.s.put_all(e, &[(&x, self.phi[0]), (&y, self.phi[1])])
    }

    /// D before q^(m) = φ is inserted.
    fn free_rate(&self, e: Expr) -> Expr {
        let moving: Vec<&str> = self.names.iter().chain(self.masses).copied().collect();
        self.s.rate(e, &[&moving[..], &["P"]].concat())
    }

    /// D on the jet (t, q, …, q^(m-1), P, P').
    fn rate(&self, e: Expr) -> Expr {
        self.restrict(self.free_rate(e))
    }

    /// D^(m-1) e before q^(m) = φ is inserted.
    fn lifted(&self, e: Expr) -> Expr {
        (1..self.m).fold(e, |e, _| self.free_rate(e))
    }

    /// ∂/∂π = Σ B_s ∂/∂q^s(m-1) with P held fixed.
    fn by_quasi(&self, e: Expr) -> Expr {
        let lower = self.names.map(|n| primes(n, self.m - 1));
        let slopes = self.s.gradient(e, &lower.each_ref().map(String::as_str));
        self.s.dot(&slopes, &self.basis)
    }

    fn dot(&self, a: &[Expr], f: impl Fn(usize) -> Expr) -> Expr {
        let b: Vec<Expr> = (0..a.len()).map(f).collect();
        self.s.dot(a, &b)
    }

    fn times(&self, factor: usize, e: Expr) -> Expr {
        self.s.mul(self.s.g.integer(factor as i64), e)
    }
}

/// (8), (2.10), (2.18), and V1 = V2 = Σ (μ ξ'' + μ' ξ') B, for arbitrary φ and two different masses μ(t).
#[test]
fn lemmas_of_order_two_and_three_in_cartesian_coordinates() {
    for m in [2, 3] {
        let s = Sheet::new();
        let mut names: Vec<String> = (0..m)
            .flat_map(|order| ["x", "y"].map(|name| primes(name, order)))
            .collect();
        names.extend(["P".to_string(), "t".to_string()]);
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let phi = ["f", "g"].map(|prefix| s.arbitrary(prefix, &names));
        let j = Jet::new(&s, m, ["x", "y"], &["mu_1", "mu_2"], phi);
        let momenta = s.all(&["mu_1 x'", "mu_2 y'"]);
        let kinetic = s.read("1/2 (mu_1 x'^2 + mu_2 y'^2)");
        let lifted = j.lifted(kinetic);
        // (8)
        for (i, name) in ["x", "y"].into_iter().enumerate() {
            s.same(s.by(lifted, &primes(name, m)), momenta[i]);
            let slope = s.by(lifted, &primes(name, m - 1));
            s.same(slope, j.times(m - 1, j.free_rate(momenta[i])));
        }
        let restricted = j.restrict(lifted);
        let by_p = s.by(restricted, "P");
        s.same(by_p, s.dot(&momenta, &j.basis));
        // (2.10)
        let left = j.dot(&j.basis, |i| j.rate(momenta[i]));
        let turning = j.dot(&momenta, |i| j.rate(j.basis[i]));
        let braces = s.sub(j.rate(by_p), turning);
        s.same(left, braces);
        s.differ(left, j.rate(by_p));
        // (2.18): the second term in the braces has a minus, and their factor is m - 1.
        let by_quasi = j.by_quasi(restricted);
        let bracket = j.dot(&momenta, |i| j.by_quasi(j.phi[i]));
        s.same(by_quasi, s.sum(&[bracket, j.times(m - 1, braces)]));
        let printed = s.sum(&[j.rate(by_p), turning]);
        s.differ(by_quasi, s.sum(&[bracket, j.times(m - 1, printed)]));
        s.differ(by_quasi, s.sum(&[bracket, j.times(m, braces)]));
        // V1 and V2; without the factors m the second is none.
        let second = |factor: usize| {
            s.sum(&[
                j.times(factor, j.rate(by_p)),
                s.g.neg(by_quasi),
                s.g.neg(j.times(factor, turning)),
                bracket,
            ])
        };
        s.same(braces, second(m));
        s.differ(braces, second(1));
        let newton = j.dot(&j.basis, |i| {
            let texts = [["mu_1 x''", "mu_1' x'"], ["mu_2 y''", "mu_2' y'"]];
            j.restrict(s.sum(&s.all(&texts[i])))
        });
        s.same(braces, newton);
        // μ' ξ' is no force, but it may not be forgotten either.
        let constant = j.dot(&j.basis, |i| {
            j.restrict(s.read(["mu_1 x''", "mu_2 y''"][i]))
        });
        s.differ(braces, constant);
    }
}

/// Two particles on a line each, with masses that are any functions of the time, and formulas of the order m.
fn pair(constraint: &str, formulas: [(&str, &str); 2]) -> Case {
    let [(one, first), (two, second)] = formulas;
    Case::new(&format!(
        r#"
coordinates = ["x", "y"]
controls = {{ mu_1 = {{}}, mu_2 = {{}} }}
assumptions = ["mu_1 > 0", "mu_2 > 0"]
[particles.a]
mass = "mu_1"
position = ["x"]
force = ["-x y' + t"]
thrust = {{ relative_velocity = ["y"] }}
[particles.b]
mass = "mu_2"
position = ["y"]
[constraints]
c = "{constraint}"
[characteristics]
parameters = ["P"]
"{one}" = "{first}"
"{two}" = "{second}"
"#
    ))
}

/// The forms of the program are proved with their lemmas, named (2.10) and (2.18), and equal Σ (μ ξ'' - X - R) B by hand.
#[test]
fn two_particles_with_masses_of_time() {
    for (m, case) in [
        (
            2,
            pair(
                "(x'' - x' y) y'^2 = y''^2",
                [("x''", "P^2 + x' y"), ("y''", "P y'")],
            ),
        ),
        (
            3,
            pair(
                "(x''' - y'' x) y'^2 = y'''^2",
                [("x'''", "P^2 + y'' x"), ("y'''", "P y'")],
            ),
        ),
    ] {
        let s = Sheet::of(&case);
        expect(&case, "order.characteristics", "proved");
        expect(&case, "model.masses-of-time", "proved");
        for (form, lemma) in [
            ("volterra-first-cartesian", "(2.10)"),
            ("volterra-second-cartesian", "(2.18)"),
        ] {
            for claim in [
                format!("formulation.equivalent#{form}"),
                format!("formulation.identity#{form}"),
                format!("formulation.identity#{form}-special"),
            ] {
                expect(&case, &claim, "proved");
            }
            let cx = case.context();
            let basis = chetaev_mechanics::claims::formulation::basis(&cx);
            let formulation = chetaev_mechanics::formulation(form).unwrap();
            let stated = formulation.special_identities(&basis).unwrap();
            assert!(stated.iter().any(|i| i.statement.contains(lemma)), "{form}");
            // R = μ_1' y along x.
            let newton = s.sum(&[
                s.mul(s.read("2 P"), s.read("mu_1 x'' + x y' - t - mu_1' y")),
                s.mul(s.read("y'"), s.read("mu_2 y''")),
            ]);
            let newton = match m {
                2 => s.put(newton, &[("x''", "P^2 + x' y"), ("y''", "P y'")]),
                _ => newton,
            };
            let equation = &case.equations(form).groups[0].equations[0];
            s.same(s.sub(equation.left, equation.right), newton);
        }
    }
}

/// E8 with any mass μ(t).
const E8: [(usize, &str, [&str; 2]); 3] = [
    (1, "(q2' - q1) q2^2 = (q1' - t)^2", ["P q2 + t", "P^2 + q1"]),
    (
        2,
        "(q1'' - q1' q2) q2'^2 = q2''^2",
        ["P^2 + q1' q2", "P q2'"],
    ),
    (
        3,
        "(q1''' - q2'' q1) q2'^2 = q2'''^2",
        ["P^2 + q2'' q1", "P q2'"],
    ),
];

const KINETIC: &str = "1/2 mu (q1'^2 + (q1^2 + t) q2'^2 + q2 q1' q2')";

fn curved(m: usize, constraint: &str, [first, second]: [&str; 2]) -> Case {
    let [one, two] = ["q1", "q2"].map(|q| primes(q, m));
    let kinetic = KINETIC.replace("mu", "M");
    Case::new(&format!(
        r#"
coordinates = ["q1", "q2"]
controls = {{ mu = {{}} }}
masses = {{ M = "mu" }}
assumptions = ["mu > 0"]
lagrangian = {{ T = "{kinetic}" }}
[constraints]
c = "{constraint}"
[characteristics]
parameters = ["P"]
"{one}" = "{first}"
"{two}" = "{second}"
"#
    ))
}

/// V1q and V2q are Σ 𝓛_s[T] B_s, derived here with the derivatives of T alone; Ψ̃ = Σ μ'/μ p_s B_s, the change being isotropic. V1 copied
/// into the curved chart, D ∂T̃/∂P - Σ p_s D B_s, is refuted: its defect is Σ ∂T/∂q^s B_s.
#[test]
fn e8_with_a_mass_of_time() {
    for (m, constraint, formulas) in E8 {
        let case = curved(m, constraint, formulas);
        let s = Sheet::of(&case);
        let phi = formulas.map(|f| s.read(f));
        let j = Jet::new(&s, m, ["q1", "q2"], &["mu"], phi);
        let kinetic = s.read(KINETIC);
        let raw = s.gradient(kinetic, &["q1'", "q2'"]);
        let slopes = s.gradient(kinetic, &["q1", "q2"]);
        let momenta: Vec<Expr> = raw.iter().map(|&p| j.restrict(p)).collect();
        let lagrange = j.dot(&j.basis, |i| {
            s.sub(j.rate(momenta[i]), j.restrict(slopes[i]))
        });
        let reactive = s.mul(s.read("mu'/mu"), s.dot(&momenta, &j.basis));
        for form in ["volterra-first", "volterra-second"] {
            for claim in [
                format!("formulation.equivalent#{form}"),
                format!("formulation.identity#{form}"),
                format!("formulation.identity#{form}-special"),
            ] {
                expect(&case, &claim, "proved");
            }
            let equations = case.equations(form);
            let equation = &equations.groups[0].equations[0];
            s.same(equation.left, lagrange);
            s.same(equation.right, reactive);
            s.same(case.object(&equations, "Psitilde_P"), reactive);
            let restricted = j.restrict(j.lifted(kinetic));
            s.same(case.object(&equations, "Ttilde"), restricted);
        }
        let by_p = s.by(j.restrict(j.lifted(kinetic)), "P");
        let turning = j.dot(&momenta, |i| j.rate(j.basis[i]));
        let shortened = s.sub(j.rate(by_p), turning);
        s.differ(shortened, lagrange);
        let defect = match m {
            1 => "mu q1 q2 (P^2 + q1)^2 + mu P (P q2 + t) (P^2 + q1)",
            _ => "1/2 mu q2'^2 (4 P q1 + q1')",
        };
        s.equal(s.sub(shortened, lagrange), defect);
    }
}

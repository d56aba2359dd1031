//! Acceptance of T3 §1–§3: structure coefficients of moving frames (antisymmetry, Jacobi's identity, both sides of (1)),
//! Cartan forms (3) and (4) in frames, that a change of the frame leaves Θ(F) alone, remark 3° and Θ(hf), and the 3-form of
//! z' - y x'.
//!
//! The coefficients of the rotation group and of the sled are in `frames.rs`; the list of integrable and other constraints is
//! in the tests of the crate for geometry.

use crate::formulations::acceptance_support::Sheet;
use crate::formulations::common::{Case, PARTICLE, SKATE};
use chetaev_mechanics::Frame;
use chetaev_symbolic::Expr;

const BLADE: &str = r#"
[moving_frame.fields]
u = { x = "cos(phi)", y = "sin(phi)" }
w = { phi = 1 }
s = { x = "-sin(phi)", y = "cos(phi)" }
"#;

const BODY: &str = r#"
coordinates = ["psi", "theta", "phi"]
parameters = { I_1 = {}, I_2 = {}, I_3 = {} }
lagrangian = { L = "1/2 (I_1 p^2 + I_2 q^2 + I_3 r^2)" }
[quasi_velocities]
p = "psi' sin(theta) sin(phi) + theta' cos(phi)"
q = "psi' sin(theta) cos(phi) - theta' sin(phi)"
r = "psi' cos(theta) + phi'"
"#;

/// Forms with explicit time and parts along dt; the coefficients C_0 do not vanish.
const TURNING: &str = r#"
coordinates = ["x", "y", "z"]
parameters = { Omega = {} }
lagrangian = { L = "1/2 (x'^2 + y'^2 + z'^2)" }
[quasi_velocities]
p = "x' cos(Omega t) + y' sin(Omega t) - Omega z y"
q = "-x' sin(Omega t) + y' cos(Omega t) + t x"
r = "(1 + x^2) z' + y x' + t"
"#;

/// A frame of a system with the fields X_0, X_1.. on (t, q), the coefficients C^w_su, and the forms ω^s on (dt, dq, dη).
struct Moving {
    case: Case,
    frame: Frame,
    /// X_s by components along (t, q), s = 0..n.
    fields: Vec<Vec<Expr>>,
    /// `c[w][s][u]`, all of 0..n; w = 0 is zero.
    c: Vec<Vec<Vec<Expr>>>,
    n: usize,
}

fn moving(text: &str) -> Moving {
    let case = Case::new(text);
    let cx = case.context();
    let basis = chetaev_mechanics::claims::formulation::basis(&cx);
    let (frame, _) = Frame::adapted(basis.system, basis.terms, basis.selection).unwrap();
    let g = &case.system.graph;
    let n = case.system.n();
    let mut fields = vec![std::iter::once(g.one())
        .chain(frame.drift.clone())
        .collect()];
    fields.extend(frame.fields.iter().map(|x| {
        let field: Vec<Expr> = std::iter::once(g.zero()).chain(x.clone()).collect();
        field
    }));
    let mut c = vec![vec![vec![g.zero(); n + 1]; n + 1]; n + 1];
    for (w, s, u, value) in frame.structure_coefficients(&case.system) {
        c[w][s][u] = value;
        c[w][u][s] = g.neg(value);
    }
    Moving {
        case,
        frame,
        fields,
        c,
        n,
    }
}

impl Moving {
    fn sheet(&self) -> Sheet {
        Sheet::of(&self.case)
    }

    /// X e for a function of (t, q).
    fn along(&self, field: &[Expr], e: Expr) -> Expr {
        let g = &self.case.system.graph;
        let coordinates = self.case.system.coordinates.iter();
        let mut parts = vec![g.mul(&[field[0], self.case.system.time_derivative(e)])];
        parts.extend(
            coordinates
                .zip(&field[1..])
                .map(|(c, &x)| g.mul(&[x, g.diff(e, c.q_symbol)])),
        );
        g.add(&parts)
    }

    fn bracket(&self, a: usize, b: usize) -> Vec<Expr> {
        let g = &self.case.system.graph;
        (0..=self.n)
            .map(|i| {
                let forward = self.along(&self.fields[a], self.fields[b][i]);
                g.sub(forward, self.along(&self.fields[b], self.fields[a][i]))
            })
            .collect()
    }

    /// ω^w on (dt, dq, dη): a^w_u dq^u - a^w_u X_0^u dt; w from 1, and ω^0 = dt.
    fn form(&self, w: usize) -> Vec<Expr> {
        let s = self.sheet();
        let zero = s.read("0");
        let mut form = vec![zero; 2 * self.n + 1];
        if w == 0 {
            form[0] = s.read("1");
            return form;
        }
        let row = &self.frame.forms[w - 1];
        form[0] = s.g.neg(s.dot(row, &self.frame.drift));
        form[1..=self.n].copy_from_slice(row);
        form
    }

    fn speeds(&self) -> Vec<Expr> {
        self.frame.speeds.iter().map(|s| s.value).collect()
    }

    /// θ^s = ω^s - η^s dt, s from 0.
    fn contact(&self, s: usize) -> Vec<Expr> {
        let mut form = self.form(s + 1);
        form[0] = self.sheet().sub(form[0], self.speeds()[s]);
        form
    }

    /// The components of dF on (dt, dq, dη).
    fn differential(&self, e: Expr) -> Vec<Expr> {
        let system = &self.case.system;
        let mut parts = vec![system.time_derivative(e)];
        parts.extend(system.graph.gradient(e, &system.coordinate_symbols()));
        let symbols: Vec<_> = self.frame.speeds.iter().map(|s| s.symbol).collect();
        parts.extend(system.graph.gradient(e, &symbols));
        parts
    }

    /// dα as an antisymmetric matrix.
    fn exterior(&self, form: &[Expr]) -> Vec<Vec<Expr>> {
        let g = &self.case.system.graph;
        let by: Vec<Vec<Expr>> = form.iter().map(|&e| self.differential(e)).collect();
        let size = form.len();
        (0..size)
            .map(|a| (0..size).map(|b| g.sub(by[b][a], by[a][b])).collect())
            .collect()
    }

    /// α ∧ β as an antisymmetric matrix.
    fn wedge(&self, a: &[Expr], b: &[Expr]) -> Vec<Vec<Expr>> {
        let s = self.sheet();
        (0..a.len())
            .map(|i| {
                (0..a.len())
                    .map(|j| s.sub(s.mul(a[i], b[j]), s.mul(a[j], b[i])))
                    .collect()
            })
            .collect()
    }

    fn scaled(&self, factor: Expr, form: &[Expr]) -> Vec<Expr> {
        form.iter().map(|&e| self.sheet().mul(factor, e)).collect()
    }

    fn total(&self, forms: &[Vec<Expr>]) -> Vec<Expr> {
        let s = self.sheet();
        (0..forms[0].len())
            .map(|i| s.sum(&forms.iter().map(|f| f[i]).collect::<Vec<_>>()))
            .collect()
    }

    /// ∂_sF by the quasi-velocities.
    fn slopes(&self, e: Expr) -> Vec<Expr> {
        let symbols: Vec<_> = self.frame.speeds.iter().map(|s| s.symbol).collect();
        self.case.system.graph.gradient(e, &symbols)
    }

    /// Θ(F) = F dt + (∂_sF) θ^s.
    fn cartan(&self, e: Expr) -> Vec<Expr> {
        let mut parts = vec![self.scaled(e, &self.form(0))];
        for (s, slope) in self.slopes(e).into_iter().enumerate() {
            parts.push(self.scaled(slope, &self.contact(s)));
        }
        self.total(&parts)
    }

    /// Γ^w_s = C^w_0s + C^w_us η^u, s and w from 1.
    fn gamma(&self, w: usize, s: usize) -> Expr {
        let sheet = self.sheet();
        let speeds = self.speeds();
        let mut parts = vec![self.c[w][0][s]];
        parts.extend((1..=self.n).map(|u| sheet.mul(self.c[w][u][s], speeds[u - 1])));
        sheet.sum(&parts)
    }

    /// The right side of (4); with Γ of this sign.
    fn exterior_by_frame(&self, e: Expr, sign: i64) -> Vec<Vec<Expr>> {
        let s = self.sheet();
        let slopes = self.slopes(e);
        let dt = self.form(0);
        let size = dt.len();
        let mut found = vec![vec![s.read("0"); size]; size];
        let mut add = |other: Vec<Vec<Expr>>| {
            for (row, more) in found.iter_mut().zip(other) {
                for (entry, extra) in row.iter_mut().zip(more) {
                    *entry = s.sum(&[*entry, extra]);
                }
            }
        };
        for i in 0..self.n {
            let mut parts: Vec<Expr> = (0..self.n)
                .map(|w| {
                    let product = s.mul(self.gamma(w + 1, i + 1), slopes[w]);
                    s.mul(s.g.integer(-sign), product)
                })
                .collect();
            parts.push(s.g.neg(self.along(&self.fields[i + 1], e)));
            let first = self.total(&[
                self.differential(slopes[i]),
                self.scaled(s.sum(&parts), &dt),
            ]);
            add(self.wedge(&first, &self.contact(i)));
            for u in 0..self.n {
                let products: Vec<Expr> = (0..self.n)
                    .map(|w| s.mul(self.c[w + 1][u + 1][i + 1], slopes[w]))
                    .collect();
                let half = s.mul(s.read("-1/2"), s.sum(&products));
                add(self.wedge(&self.scaled(half, &self.contact(u)), &self.contact(i)));
            }
        }
        found
    }
}

fn frames() -> [Moving; 4] {
    [
        moving(&format!("{SKATE}{BLADE}")),
        moving(BODY),
        moving(TURNING),
        moving(PARTICLE),
    ]
}

/// `[X_s, X_u] = C^w_su X_w` and `[X_0, X_u] = C^w_0u X_w` for both orders of s, u.
#[test]
fn brackets_of_frames() {
    for m in frames() {
        let s = m.sheet();
        for (a, b) in (0..=m.n).flat_map(|a| (0..=m.n).map(move |b| (a, b))) {
            for (i, component) in m.bracket(a, b).into_iter().enumerate() {
                let parts: Vec<Expr> = (1..=m.n)
                    .map(|w| s.mul(m.c[w][a][b], m.fields[w][i]))
                    .collect();
                s.same(component, s.sum(&parts));
            }
        }
    }
}

/// `Σ_cyc ( X_a C^e_bc + C^e_ad C^d_bc ) = 0`, with the index 0 too.
#[test]
fn jacobi_identity_of_frames() {
    for m in frames() {
        let s = m.sheet();
        for a in 0..=m.n {
            for b in a + 1..=m.n {
                for c in b + 1..=m.n {
                    for e in 1..=m.n {
                        let mut parts = Vec::new();
                        for (a, b, c) in [(a, b, c), (b, c, a), (c, a, b)] {
                            parts.push(m.along(&m.fields[a], m.c[e][b][c]));
                            parts.extend((1..=m.n).map(|d| s.mul(m.c[e][a][d], m.c[d][b][c])));
                        }
                        s.vanishes(s.sum(&parts));
                    }
                }
            }
        }
    }
    // The frame that turns has coefficients of the time, and they are not constant.
    let m = moving(TURNING);
    let s = m.sheet();
    assert!((1..=m.n).any(|w| s.word(m.c[w][0][1]) == "refuted"));
}

/// (1): dω^w = -C^w_0u dt∧ω^u - ½ C^w_su ω^s∧ω^u; with the other sign, which many books use, it fails.
#[test]
fn both_sides_of_the_structure_equations() {
    for m in frames() {
        let s = m.sheet();
        for w in 1..=m.n {
            let left = m.exterior(&m.form(w));
            let mut right = vec![vec![s.read("0"); 2 * m.n + 1]; 2 * m.n + 1];
            for a in 0..=m.n {
                for b in a + 1..=m.n {
                    let form = m.scaled(s.g.neg(m.c[w][a][b]), &m.form(a));
                    for (row, more) in right.iter_mut().zip(m.wedge(&form, &m.form(b))) {
                        for (entry, extra) in row.iter_mut().zip(more) {
                            *entry = s.sum(&[*entry, extra]);
                        }
                    }
                }
            }
            let mut is_zero = true;
            for (&a, &b) in left.concat().iter().zip(&right.concat()) {
                s.same(a, b);
                is_zero &= s.word(a) == "proved";
            }
            let mutant = left.concat().into_iter().zip(right.concat());
            let found = mutant
                .map(|(a, b)| s.word(s.sum(&[a, b])))
                .any(|word| word == "refuted");
            assert_eq!(found, !is_zero);
        }
    }
}

/// n = 1: Θ(½ v² - V) = v dq - (½ v² + V) dt.
#[test]
fn the_cartan_form_of_one_coordinate() {
    let m = moving("coordinates = [\"x\"]\nlagrangian = { L = \"1/2 x'^2 - x^4 + x\" }\n");
    let s = m.sheet();
    let form = m.cartan(m.case.system.lagrangian);
    s.equal(form[0], "-(1/2 x'^2 + x^4 - x)");
    s.equal(form[1], "x'");
    s.equal(form[2], "0");
}

/// A polynomial of (t, q, η) of degree three in the quasi-velocities.
fn polynomial(m: &Moving) -> Expr {
    let s = m.sheet();
    let names: Vec<&str> = m
        .case
        .system
        .coordinates
        .iter()
        .map(|c| c.name.as_str())
        .collect();
    let eta = m.speeds();
    let [a, b, c] = [names[0], names[1], names[2]];
    s.sum(&[
        s.g.mul(&[s.read(&format!("{a} {b} + t")), s.g.powi(eta[0], 2), eta[1]]),
        s.g.mul(&[s.read(&format!("{c}^2 - 3 t {a}")), s.g.powi(eta[2], 3)]),
        s.g.mul(&[s.read(&format!("1 + {b}^2")), eta[0], eta[2]]),
        s.g.mul(&[s.read(&format!("{a} {c}")), eta[1]]),
        s.read(&format!("t {a} - {b} {c}^2")),
    ])
}

/// (4) is the exterior derivative of (3), for a polynomial F in frames that are not natural; Γ of the other sign is refuted.
#[test]
fn the_exterior_derivative_of_cartan_forms() {
    for m in frames() {
        let s = m.sheet();
        let f = polynomial(&m);
        let direct = m.exterior(&m.cartan(f)).concat();
        for (&a, &b) in direct.iter().zip(&m.exterior_by_frame(f, 1).concat()) {
            s.same(a, b);
        }
        if !m.frame.is_natural(&m.case.system) && s.word(m.gamma(1, 2)) == "refuted" {
            let wrong = m.exterior_by_frame(f, -1).concat();
            let mut pairs = direct.iter().zip(&wrong);
            assert!(pairs.any(|(&a, &b)| s.word(s.sub(a, b)) == "refuted"));
        }
    }
}

/// Θ(F) is the same form in every frame: its components along dt and dq in the natural frame, with v by η, are those in this
/// frame. dΘ(F) is in the ideal of the contact forms: it vanishes on the horizontal field and the fields ∂_s, any two of them.
#[test]
fn a_change_of_the_frame_leaves_the_cartan_form() {
    for m in frames() {
        let s = m.sheet();
        let system = &m.case.system;
        let v = m.frame.velocities(system, &m.speeds());
        let f = system.lagrangian;
        let in_velocities = {
            let names: Vec<String> = system
                .coordinates
                .iter()
                .map(|c| format!("{}'", c.name))
                .collect();
            let text = format!("t {} {} + {}^3", names[0], names[1], names[2]);
            s.sum(&[f, s.read(&text)])
        };
        let by_speeds: Vec<(Expr, Expr)> = system
            .coordinates
            .iter()
            .zip(&v)
            .map(|(c, &v)| (c.v, v))
            .collect();
        let put = |e: Expr| s.g.substitute(e, &by_speeds);
        let own = m.cartan(put(in_velocities));
        let p = s.g.gradient(in_velocities, &system.velocity_symbols());
        let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
        s.same(own[0], put(s.sub(in_velocities, s.dot(&p, &velocities))));
        for (i, &momentum) in p.iter().enumerate() {
            s.same(own[1 + i], put(momentum));
            s.vanishes(own[1 + m.n + i]);
        }
        let matrix = m.exterior(&own);
        // X ⌟ Θ(F) = F for every X with dt(X) = 1 along the velocities.
        let mut along = vec![s.read("1")];
        along.extend(v.clone());
        s.same(s.dot(&along, &own[..=m.n]), put(in_velocities));
        let zero = s.read("0");
        let mut horizontal = vec![s.read("1")];
        horizontal.extend(v);
        horizontal.extend(vec![zero; m.n]);
        for vertical in 0..m.n {
            let column: Vec<Expr> = matrix.iter().map(|row| row[1 + m.n + vertical]).collect();
            s.vanishes(s.dot(&horizontal, &column));
            for other in 0..m.n {
                s.vanishes(matrix[1 + m.n + other][1 + m.n + vertical]);
            }
        }
    }
}

/// Remark 3°: Θ(Dg) = dg in every frame, with moving frames and g(t, q). And Θ(hf) = hΘ(f) + f (∂_sh) θ^s.
#[test]
fn cartan_forms_of_total_derivatives_and_products() {
    for m in frames() {
        let s = m.sheet();
        let names: Vec<&str> = m
            .case
            .system
            .coordinates
            .iter()
            .map(|c| c.name.as_str())
            .collect();
        let [a, b, c] = [names[0], names[1], names[2]];
        let holonomic = s.read(&format!("{a}^2 {b} + t sin({c}) - {b} {c}"));
        let mut parts = vec![m.along(&m.fields[0], holonomic)];
        for (i, speed) in m.speeds().into_iter().enumerate() {
            parts.push(s.mul(speed, m.along(&m.fields[i + 1], holonomic)));
        }
        let total = s.sum(&parts);
        for (&found, &stated) in m.cartan(total).iter().zip(&m.differential(holonomic)) {
            s.same(found, stated);
        }
        for entry in m.exterior(&m.cartan(total)).concat() {
            s.vanishes(entry);
        }
        let (f, h) = (polynomial(&m), s.sum(&[s.read("2 + t"), m.speeds()[1]]));
        let mut forms = vec![m.scaled(h, &m.cartan(f))];
        for (i, slope) in m.slopes(h).into_iter().enumerate() {
            forms.push(m.scaled(s.mul(f, slope), &m.contact(i)));
        }
        let product = m.cartan(s.mul(h, f));
        for (&found, &stated) in product.iter().zip(&m.total(&forms)) {
            s.same(found, stated);
        }
    }
}

/// `dΘ(f) ∧ Θ(f)` of z' - y x' is dx∧dy∧dz up to sign, that of z' - y x' - x y' vanishes, and that of h f with h = h(q) is h² times
/// the first.
#[test]
fn the_three_form_of_frobenius() {
    let m = moving(
        "coordinates = [\"x\", \"y\", \"z\"]\nlagrangian = { L = \"x'^2 + y'^2 + z'^2\" }\n",
    );
    let s = m.sheet();
    let three = |f: &str| {
        let form = m.cartan(s.read(f));
        let d = m.exterior(&form);
        // (dΘ∧Θ)(∂x, ∂y, ∂z)
        s.sum(&[
            s.mul(d[1][2], form[3]),
            s.mul(d[2][3], form[1]),
            s.mul(d[3][1], form[2]),
        ])
    };
    let found = three("z' - y x'");
    s.equal(found, "1");
    s.vanishes(three("z' - y x' - x y'"));
    s.equal(three("(2 + x^2) (z' - y x')"), "(2 + x^2)^2");
}

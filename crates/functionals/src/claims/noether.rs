//! `functional.noether`: symmetries of a functional and the currents without divergence that they give.

use super::{Claim, Context, Finding, Formula};
use crate::elimination::{Group, Solved};
use crate::functional::{Field, Functional, Role};
use crate::space::{Component, Jet, Space};

use crate::variation::{flux, Form, Variation};
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{rational, simplify, Expr, Rational, Verdict};
use std::collections::BTreeMap;

/// `functional.noether#SYMMETRY`.
pub(super) struct Noether;

impl Claim for Noether {
    fn id(&self) -> &'static str {
        "functional.noether"
    }

    fn title(&self) -> &'static str {
        "The symmetry gives a current whose divergence vanishes for all solutions"
    }

    fn explanation(&self) -> &'static str {
        "Noether's theorem for fields (E. Noether, Invariante Variationsprobleme, 1918). A translation, a rotation or a scaling ξ of the \
         independent variables, with what it does to the fields, η, has the current C_i = L ξ_i + Σ p_ci Q_c with Q = η − ξ_k u,k; for \
         translations these are the rows of the energy–momentum tensor. First the identity D_i C_i + Σ E_c Q_c = S is proved, in which \
         the defect S is the change of the density under the symmetry; then S is looked at where the Euler equations hold. In elasticity the \
         integrals of the currents over closed surfaces are J (translations: the body is homogeneous and no force acts on it), L (rotations: it is \
         isotropic as well) and M (scalings: the energy is homogeneous in the gradient; the exponent by which the fields are scaled follows \
         from its degree). Where a hypothesis fails the claim is refuted, and the defect is shown. Data are not moved by the symmetry. \
         `symmetries` in the model says what is asked."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let all = generators(cx.functional());
        all.into_iter().map(|own| Some(own.name)).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let all = generators(cx.functional());
        let own = all
            .into_iter()
            .find(|own| Some(own.name.as_str()) == subject);
        match (own, &cx.variation) {
            (Some(own), Ok(variation)) => decided(cx.functional(), variation, own),
            (None, _) => Verdict::undecided("there is no such symmetry").into(),
            (_, Err(problem)) => Verdict::undecided(problem.to_string()).into(),
        }
    }
}

/// A symmetry: how independent variables and components move.
struct Generator {
    name: String,
    words: String,
    xi: Vec<Expr>,
    eta: BTreeMap<usize, Expr>,
    /// Whether the exponents of the fields are still to be found.
    is_scaling: bool,
}

/// Noether's current with the defect.
pub struct Current {
    /// One component for each independent variable.
    pub flux: Vec<Expr>,
    /// What its divergence is for solutions.
    pub defect: Expr,
    /// The characteristics of the components.
    pub characteristics: BTreeMap<usize, Expr>,
}

fn generators(functional: &Functional) -> Vec<Generator> {
    let space = &*functional.space;
    let g = &space.graph;
    let n = space.coordinates.len();
    let d = space.dimensions();
    let zeros = || vec![g.zero(); n];
    let mut found = Vec::new();
    for word in &functional.symmetries {
        match word.as_str() {
            "translations" => found.extend((0..n).map(|axis| {
                let mut xi = zeros();
                xi[axis] = g.one();
                let name = &space.coordinates[axis].name;
                Generator {
                    name: format!("translation-{name}"),
                    words: format!("the translation along {name}"),
                    xi,
                    eta: BTreeMap::new(),
                    is_scaling: false,
                }
            })),
            "rotations" => {
                for a in 0..d {
                    for b in a + 1..d {
                        found.push(rotation(functional, a, b));
                    }
                }
            }
            _ => found.push(Generator {
                name: "scaling".into(),
                words: "the scaling of the independent variables".into(),
                xi: space.coordinates.iter().map(|c| c.expr).collect(),
                eta: BTreeMap::new(),
                is_scaling: true,
            }),
        }
    }
    found
}

/// The rotation by which x_a moves towards x_b, of vectors and tensors too.
fn rotation(functional: &Functional, a: usize, b: usize) -> Generator {
    let space = &*functional.space;
    let g = &space.graph;
    let mut xi = vec![g.zero(); space.coordinates.len()];
    xi[a] = g.neg(space.coordinates[b].expr);
    xi[b] = space.coordinates[a].expr;
    let mut eta = BTreeMap::new();
    let d = space.dimensions();
    // (ω v)_a = −v_b, (ω v)_b = v_a.
    let turned = |at: usize| match at {
        _ if at == a => Some((b, -1)),
        _ if at == b => Some((a, 1)),
        _ => None,
    };
    for field in functional.interior() {
        let Some(tensor) = functional.scope.tensors.get(&field.name) else {
            continue;
        };
        let components = field.shape.components(d);
        for ((indices, _), &component) in components.iter().zip(&field.components) {
            let mut terms = Vec::new();
            for (place, &index) in indices.iter().enumerate() {
                let Some((other, sign)) = turned(index) else {
                    continue;
                };
                let mut own = indices.clone();
                own[place] = other;
                let value = tensor.at(&own, d).unwrap_or_else(|| g.zero());
                terms.push(g.mul(&[g.integer(sign), value]));
            }
            eta.insert(component, g.add(&terms));
        }
    }
    let name = |at: usize| space.coordinates[at].name.clone();
    Generator {
        name: format!("rotation-{}-{}", name(a), name(b)),
        words: format!("the rotation in the plane of {} and {}", name(a), name(b)),
        xi,
        eta,
        is_scaling: false,
    }
}

/// The current of a symmetry, by the name it has in claims; for tests and programs.
pub fn current(functional: &Functional, name: &str) -> Option<Current> {
    let own = generators(functional)
        .into_iter()
        .find(|own| own.name == name)?;
    let (own, _) = settled(functional, own);
    current_of(functional, &own)
}

fn current_of(functional: &Functional, own: &Generator) -> Option<Current> {
    let space = &*functional.space;
    let g = &space.graph;
    let density = functional.density;
    let varied: Vec<usize> = functional
        .interior()
        .flat_map(|f| f.components.clone())
        .collect();
    let mut characteristics = BTreeMap::new();
    for &component in &varied {
        let mut terms = vec![own.eta.get(&component).copied().unwrap_or_else(|| g.zero())];
        for (axis, &xi) in own.xi.iter().enumerate() {
            terms.push(g.neg(g.mul(&[xi, space.jet(component, &[axis])])));
        }
        characteristics.insert(component, g.add(&terms));
    }
    let forms: Vec<Form> = flux(space, density, &varied).ok()?;
    let flux = forms
        .iter()
        .zip(&own.xi)
        .map(|(form, &xi)| {
            let mut terms = vec![g.mul(&[density, xi])];
            for (jet, &value) in form {
                let q = characteristics.get(&jet.component).copied();
                let q = q.unwrap_or_else(|| g.zero());
                terms.push(g.mul(&[value, space.totals(q, &jet.by)]));
            }
            g.add(&terms)
        })
        .collect();
    Some(Current {
        flux,
        defect: defect(functional, own, &varied),
        characteristics,
    })
}

/// `pr X(L) + L div ξ`: varied fields with their derivatives move, data keep their values as functions of place.
fn defect(functional: &Functional, own: &Generator, varied: &[usize]) -> Expr {
    let space = &*functional.space;
    let g = &space.graph;
    let density = functional.density;
    let symbols: Vec<_> = space
        .coordinates
        .iter()
        .filter_map(|c| g.as_symbol(c.expr))
        .collect();
    let divergence: Vec<Expr> = own
        .xi
        .iter()
        .enumerate()
        .map(|(i, &xi)| space.total(xi, i))
        .collect();
    let mut terms = vec![g.mul(&[density, g.add(&divergence)])];
    // Explicit places.
    terms.push(space.derive(density, &|symbol| {
        let at = symbols.iter().position(|&own| own == symbol)?;
        Some(own.xi[at])
    }));
    for jet in space.jets_in(&[density]) {
        let slope = space.partial(density, &jet);
        let rate = if varied.contains(&jet.component) {
            prolonged(space, own, &jet)
        } else {
            let along = own.xi.iter().enumerate().map(|(i, &xi)| {
                let mut by = jet.by.clone();
                by.push(i);
                g.mul(&[xi, space.jet(jet.component, &by)])
            });
            g.add(&along.collect::<Vec<_>>())
        };
        terms.push(g.mul(&[slope, rate]));
    }
    g.add(&terms)
}

/// How a derivative moves: `φ^{Jk} = D_k φ^J − u_{Ji} D_k ξ_i`.
fn prolonged(space: &Space, own: &Generator, jet: &Jet) -> Expr {
    let g = &space.graph;
    let mut rate = own
        .eta
        .get(&jet.component)
        .copied()
        .unwrap_or_else(|| g.zero());
    let mut so_far: Vec<usize> = Vec::new();
    for &k in &jet.by {
        let mut terms = vec![space.total(rate, k)];
        for (i, &xi) in own.xi.iter().enumerate() {
            let mut by = so_far.clone();
            by.push(i);
            let moved = g.mul(&[space.jet(jet.component, &by), space.total(xi, k)]);
            terms.push(g.neg(moved));
        }
        rate = g.add(&terms);
        so_far.push(k);
    }
    rate
}

/// A scaling with the exponents of its fields, and what they are.
fn settled(functional: &Functional, own: Generator) -> (Generator, Vec<(String, Rational)>) {
    if !own.is_scaling {
        return (own, Vec::new());
    }
    let fields: Vec<&Field> = functional.interior().collect();
    let exponents = exponents(functional, &own, &fields);
    let g = &functional.space.graph;
    let mut eta = BTreeMap::new();
    let mut told = Vec::new();
    for (field, exponent) in fields.iter().zip(exponents) {
        for &component in &field.components {
            let value = functional.space.jet(component, &[]);
            eta.insert(component, g.mul(&[g.number(exponent.clone()), value]));
        }
        told.push((field.name.clone(), exponent));
    }
    (Generator { eta, ..own }, told)
}

/// Exponents for which the density without its data is homogeneous, found at points where it has simple values; for a density that is not,
/// those of a quadratic one.
fn exponents(functional: &Functional, own: &Generator, fields: &[&Field]) -> Vec<Rational> {
    let space = &*functional.space;
    let g = &space.graph;
    let n = space.coordinates.len() as i64;
    let otherwise = rational::ratio(2 - n, 2).unwrap_or(Rational::ZERO);
    let of = |weights: &[i64]| {
        let mut eta = BTreeMap::new();
        for (field, &weight) in fields.iter().zip(weights) {
            for &component in &field.components {
                eta.insert(
                    component,
                    g.mul(&[g.integer(weight), space.jet(component, &[])]),
                );
            }
        }
        let own = Generator {
            name: String::new(),
            words: String::new(),
            xi: own.xi.clone(),
            eta,
            is_scaling: false,
        };
        let varied: Vec<usize> = fields.iter().flat_map(|f| f.components.clone()).collect();
        space.explicit(defect(functional, &own, &varied))
    };
    let zero = vec![0; fields.len()];
    let base = of(&zero);
    let slopes: Vec<Expr> = (0..fields.len())
        .map(|k| {
            let mut weights = zero.clone();
            weights[k] = 1;
            g.sub(of(&weights), base)
        })
        .collect();
    let mut all = slopes;
    all.push(base);
    let rows: Vec<Vec<f64>> = (1..=fields.len() as u64 + 4)
        .filter_map(|seed| sampled(functional, &all, seed))
        .collect();
    let found = solved(rows, fields.len());
    found
        .into_iter()
        .map(|value| value.and_then(simple).unwrap_or_else(|| otherwise.clone()))
        .collect()
}

/// Values at a point: data vanish, everything else has values that depend on its name only.
fn sampled(functional: &Functional, es: &[Expr], seed: u64) -> Option<Vec<f64>> {
    let space = &*functional.space;
    let is_data = |component: &Component| !component.is_varied;
    let values = space.graph.evaluate_f64(es, &|symbol| {
        if let Some(jet) = space.as_jet(symbol) {
            if is_data(&space.component_at(jet.component)) {
                return Some(0.0);
            }
        }
        let name = space.graph.symbol_name(symbol);
        let mut hash = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        for byte in name.bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
            hash ^= hash >> 29;
        }
        Some(0.25 + (hash % 1000) as f64 / 800.0)
    });
    values.ok().filter(|own| own.iter().all(|v| v.is_finite()))
}

/// The solution of `Σ row_k x_k + row_last = 0` by elimination; what is free is left open.
fn solved(mut rows: Vec<Vec<f64>>, count: usize) -> Vec<Option<f64>> {
    let mut found = vec![None; count];
    let mut next = 0;
    let mut pivots = Vec::new();
    for column in 0..count {
        let best = (next..rows.len())
            .max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()));
        let Some(best) = best.filter(|&r| rows[r][column].abs() > 1e-9) else {
            continue;
        };
        rows.swap(next, best);
        let own: Vec<f64> = rows[next].iter().map(|v| v / rows[next][column]).collect();
        for (r, row) in rows.iter_mut().enumerate() {
            let factor = row[column];
            if r != next {
                row.iter_mut().zip(&own).for_each(|(v, o)| *v -= factor * o);
            }
        }
        rows[next] = own;
        pivots.push((next, column));
        next += 1;
    }
    let is_consistent = rows.iter().skip(next).all(|row| row[count].abs() < 1e-7);
    for (row, column) in pivots.into_iter().filter(|_| is_consistent) {
        found[column] = Some(-rows[row][count]);
    }
    found
}

/// A fraction with a small denominator.
fn simple(value: f64) -> Option<Rational> {
    (1..=24).find_map(|below: i64| {
        let above = (value * below as f64).round();
        ((above / below as f64 - value).abs() < 1e-7)
            .then(|| rational::ratio(above as i64, below))
            .flatten()
    })
}

fn decided(functional: &Functional, variation: &Variation, own: Generator) -> Finding {
    let space = &*functional.space;
    let g = &space.graph;
    let words = own.words.clone();
    let (own, exponents) = settled(functional, own);
    let Some(current) = current_of(functional, &own) else {
        return Verdict::undecided("the density contains derivatives of higher order than two")
            .into();
    };
    let mut terms: Vec<Expr> = current
        .flux
        .iter()
        .enumerate()
        .map(|(i, &c)| space.total(c, i))
        .collect();
    for &(component, value) in &variation.euler {
        let multiplicity = g.integer(space.component_at(component).multiplicity);
        let q = current
            .characteristics
            .get(&component)
            .copied()
            .unwrap_or_else(|| g.zero());
        terms.push(g.mul(&[multiplicity, value, q]));
    }
    terms.push(g.neg(current.defect));
    let identity = g.add(&terms);
    let is_identity = g.is_zero(identity)
        || space.vanish(&[identity])
        || space.vanish(&[space.explicit(identity)]);
    if !is_identity {
        return Verdict::undecided(format!(
            "the divergence of the current of {words} was not proved to be its defect on solutions"
        ))
        .into();
    }
    let verdict = on_solutions(functional, variation, &current, &words, &exponents);
    Finding {
        verdict,
        formulas: formulas(functional, &current),
    }
}

fn on_solutions(
    functional: &Functional,
    variation: &Variation,
    current: &Current,
    words: &str,
    exponents: &[(String, Rational)],
) -> Verdict {
    let space = &*functional.space;
    let imposed = functional
        .with_role(Role::Imposed)
        .filter(|e| e.on.is_none());
    let imposed = imposed.map(|e| Group {
        label: e.label.clone(),
        equations: e.residuals.clone(),
    });
    let mut groups: Vec<Group> = imposed.collect();
    groups.extend(functional.interior().map(|field| {
        Group {
            label: field.name.clone(),
            equations: variation
                .euler
                .iter()
                .filter(|(component, _)| field.components.contains(component))
                .map(|(_, value)| *value)
                .collect(),
        }
    }));
    let scaled: Vec<String> = exponents
        .iter()
        .map(|(name, exponent)| format!("{name} with the exponent {exponent}"))
        .collect();
    let scaled = if scaled.is_empty() {
        String::new()
    } else {
        format!(" ({})", scaled.join(", "))
    };
    let explicit = space.explicit(current.defect);
    if space.vanish(&[current.defect]) || space.vanish(&[explicit]) {
        return Verdict::Proved(Proof::exact(
            "all solutions",
            format!("{words}{scaled} leaves the density as it is, and the divergence of its current is Σ E Q, which vanishes for solutions"),
        ));
    }
    let solved = Solved::new(space).with(&groups);
    match solved.verdict(current.defect) {
        Verdict::Proved(proof) => Verdict::Proved(Proof {
            on: "all solutions".into(),
            detail: format!("the defect of {words}{scaled} vanishes where the Euler equations hold"),
            ..proof
        }),
        Verdict::Refuted(found) if solved.left.is_empty() => Verdict::Refuted(found).prefixed(
            &format!("the current of {words}{scaled} has a divergence, the defect shown"),
        ),
        Verdict::Refuted(_) => Verdict::undecided(format!(
            "the defect of {words} does not vanish identically, and the Euler equations could not be solved"
        )),
        other => other,
    }
}

/// Longer formulas are left to programs.
const LONGEST: u64 = 1_500;

fn formulas(functional: &Functional, current: &Current) -> Vec<Formula> {
    let space = &*functional.space;
    let g = &space.graph;
    let mut found = Vec::new();
    let mut show = |caption: String, e: Expr| {
        if g.is_zero(e) || simplify::length(g, e) > LONGEST {
            return;
        }
        let value = simplify::simplify(g, e, &simplify::Options::default());
        found.push(Formula::new(caption, value));
    };
    for (coordinate, &e) in space.coordinates.iter().zip(&current.flux) {
        show(format!("the current along {}", coordinate.name), e);
    }
    if !space.vanish(&[current.defect]) {
        show(
            "the defect: the divergence of the current for solutions".into(),
            current.defect,
        );
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{simple, solved};

    #[test]
    fn exponents_are_fractions() {
        let rows = vec![
            vec![2.0, 0.0, 1.0],
            vec![0.0, 3.0, -1.0],
            vec![2.0, 3.0, 0.0],
        ];
        let own: Vec<_> = solved(rows, 2)
            .into_iter()
            .map(|v| v.and_then(simple))
            .collect();
        let text: Vec<String> = own.into_iter().flatten().map(|r| r.to_string()).collect();
        assert_eq!(text, ["-1/2", "1/3"]);
        assert!(solved(vec![vec![1.0, 1.0], vec![1.0, 2.0]], 1)[0].is_none());
    }
}

//! `functional.noether`: symmetries of a functional and the currents without divergence that they give.

use super::potential::with_divergence;
use super::reduction::restricted;
use super::{Claim, Context, Finding, Formula};
use crate::elimination::{Group, Solved};
use crate::functional::{Functional, Role};
use crate::space::{not_sought, Jet, Space};
use crate::variation::{euler_expression, flux, is_divergence, Form, Variation};
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
         from its degree). Where S is the divergence of a K, whatever the fields are, the density is changed by that alone, and the current that is shown \
         is C − K. Where a hypothesis fails the claim is refuted, and the defect is shown. Data are not moved by the symmetry. \
         `symmetries` in the model says what is asked."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let all = generators(cx.functional());
        all.into_iter().map(|own| Some(own.name)).collect()
    }

    fn differentiates(&self) -> bool {
        true
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let all = generators(cx.functional());
        let own = all
            .into_iter()
            .find(|own| Some(own.name.as_str()) == subject);
        match (own, &cx.variation) {
            (Some(own), Ok(variation)) => match inside(cx.functional(), variation) {
                Some(why) => Verdict::undecided(why).into(),
                None => decided(cx.functional(), variation, own),
            },
            (None, _) => Verdict::undecided("there is no such symmetry").into(),
            (_, Err(problem)) => Verdict::undecided(problem.to_string()).into(),
        }
    }
}

/// Why solutions do not satisfy the Euler equations: what is imposed in the interior restricts the variations.
fn inside(functional: &Functional, variation: &Variation) -> Option<String> {
    let mut own = functional.clone();
    own.equations.retain(|e| e.on.is_none());
    restricted(&own, variation)
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
    let (own, ..) = settled(functional, own);
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

/// A scaling with the exponents of its fields, and what they are in words.
/// A generator with exponents where it is a scaling, what is said of them, and where none were found a function whose values are not known
/// well enough to say that there are none.
fn settled(functional: &Functional, own: Generator) -> (Generator, String, Option<String>) {
    if !own.is_scaling {
        return (own, String::new(), None);
    }
    let scaling = Scaling::new(functional, &own);
    let found = scaling.exponents();
    let space = &*functional.space;
    let g = &space.graph;
    let own_eta = |(&component, &exponent): (&usize, &Expr)| {
        (component, g.mul(&[exponent, space.jet(component, &[])]))
    };
    let eta = scaling.components.iter().zip(&found.values).map(own_eta);
    let eta = eta.collect();
    let open = (!found.exist).then(|| space.unsettled(space.explicit(functional.density)));
    (
        Generator { eta, ..own },
        scaling.told(&found),
        open.flatten(),
    )
}

/// The exponents by which the components of the fields are scaled: unknowns in which the defect is affine, `S = S_0 + Σ ε_c S_c`.
struct Scaling<'f> {
    functional: &'f Functional,
    components: Vec<usize>,
    /// S_c for every component, and S_0 behind them.
    defects: Vec<Expr>,
}

/// Exponents, one for each component.
struct Exponents {
    values: Vec<Expr>,
    /// Other exponents that do as well: directions in which all of them may be changed.
    directions: Vec<Vec<Expr>>,
    /// Whether there are any for which the equations hold.
    exist: bool,
}

impl<'f> Scaling<'f> {
    fn new(functional: &'f Functional, own: &Generator) -> Scaling<'f> {
        let space = &*functional.space;
        let g = &space.graph;
        let fields = functional.interior();
        let components: Vec<usize> = fields.flat_map(|f| f.components.clone()).collect();
        let of = |only: Option<usize>| {
            let eta = only.map(|component| (component, space.jet(component, &[])));
            let own = Generator {
                name: String::new(),
                words: String::new(),
                xi: own.xi.clone(),
                eta: eta.into_iter().collect(),
                is_scaling: false,
            };
            space.explicit(defect(functional, &own, &components))
        };
        let base = of(None);
        let mut defects: Vec<Expr> = components
            .iter()
            .map(|&component| g.sub(of(Some(component)), base))
            .collect();
        defects.push(base);
        Scaling {
            functional,
            components,
            defects,
        }
    }

    /// Exponents for which the defect vanishes; else those for which it is a divergence; else those for which it vanishes without data.
    /// Components of one tensor have one exponent where that can be.
    fn exponents(&self) -> Exponents {
        let space = &*self.functional.space;
        let varied = &self.components;
        let euler = |&component: &usize| -> Vec<Expr> {
            let own = self.defects.iter();
            own.map(|&e| euler_expression(space, e, component))
                .collect()
        };
        let of_divergence: Vec<Vec<Expr>> = varied.iter().map(euler).collect();
        let systems = [
            (vec![self.defects.clone()], false),
            (of_divergence, false),
            (vec![self.defects.clone()], true),
        ];
        for (system, is_free_of_data) in &systems {
            for are_tensors in [true, false] {
                let found = self.solved(system, *is_free_of_data, are_tensors);
                if let Some((values, directions)) = found {
                    let exist = !is_free_of_data;
                    return Exponents {
                        values,
                        directions,
                        exist,
                    };
                }
            }
        }
        Exponents {
            values: vec![self.otherwise(); varied.len()],
            directions: Vec::new(),
            exist: false,
        }
    }

    /// The exponent for a quadratic density.
    fn otherwise(&self) -> Expr {
        let n = self.functional.space.coordinates.len() as i64;
        let own = rational::ratio(2 - n, 2).unwrap_or(Rational::ZERO);
        self.functional.space.graph.number(own)
    }

    /// The solution of equations that are affine in the exponents and hold for all jets: from their values at some, which are necessary,
    /// and then proved to be enough.
    fn solved(
        &self,
        system: &[Vec<Expr>],
        is_free_of_data: bool,
        are_tensors: bool,
    ) -> Option<(Vec<Expr>, Vec<Vec<Expr>>)> {
        let space = &*self.functional.space;
        let g = &space.graph;
        let count = self.components.len();
        let mut rows = if are_tensors {
            self.tensors()
        } else {
            Vec::new()
        };
        for row in system {
            for seed in 1..=count as u64 + 3 {
                let at = |&e: &Expr| self.at_point(e, seed, is_free_of_data);
                rows.push(row.iter().map(at).collect());
            }
        }
        let (values, directions) = affine_solution(space, rows, count, self.otherwise())?;
        let holds = |x: &[Expr], is_affine: bool| {
            system.iter().all(|row| {
                let mut terms: Vec<Expr> =
                    row.iter().zip(x).map(|(&r, &x)| g.mul(&[r, x])).collect();
                terms.extend(row.last().filter(|_| is_affine));
                let sum = g.add(&terms);
                let sum = if is_free_of_data {
                    self.without_data(sum)
                } else {
                    sum
                };
                g.is_zero(sum) || space.vanish(&[sum])
            })
        };
        let directions: Vec<Vec<Expr>> = directions
            .into_iter()
            .filter(|own| holds(own, false))
            .collect();
        holds(&values, true).then_some((values, directions))
    }

    /// Equal exponents for the components of a tensor.
    fn tensors(&self) -> Vec<Vec<Expr>> {
        let g = &self.functional.space.graph;
        let count = self.components.len();
        let place = |component: &usize| self.components.iter().position(|own| own == component);
        let mut rows = Vec::new();
        for field in self.functional.interior() {
            for pair in field.components.windows(2) {
                let mut row = vec![g.zero(); count + 1];
                if let [Some(one), Some(other)] = [place(&pair[0]), place(&pair[1])] {
                    row[one] = g.one();
                    row[other] = g.integer(-1);
                }
                rows.push(row);
            }
        }
        rows
    }

    fn is_data(&self, component: usize) -> bool {
        !self.functional.space.component_at(component).is_varied
    }

    fn without_data(&self, e: Expr) -> Expr {
        let space = &*self.functional.space;
        space.replace(e, &|symbol| {
            let jet = space.as_jet(symbol)?;
            self.is_data(jet.component).then(|| space.graph.zero())
        })
    }

    /// Jets and places with rational values that depend on their names and the seed only; parameters stay.
    fn at_point(&self, e: Expr, seed: u64, is_free_of_data: bool) -> Expr {
        let space = &*self.functional.space;
        let g = &space.graph;
        space.replace(e, &|symbol| {
            let jet = space.as_jet(symbol);
            let is_place = space
                .coordinates
                .iter()
                .any(|c| g.as_symbol(c.expr) == Some(symbol));
            match jet {
                Some(jet) if is_free_of_data && self.is_data(jet.component) => Some(g.zero()),
                None if !is_place => None,
                _ => Some(g.number(small(g.symbol_name(symbol), seed))),
            }
        })
    }

    fn told(&self, found: &Exponents) -> String {
        let space = &*self.functional.space;
        let g = &space.graph;
        let name = |at: usize| {
            let component = space.component_at(self.components[at]);
            let field = self
                .functional
                .interior()
                .find(|f| f.name == component.tensor);
            let places = field.map_or(Vec::new(), |f| {
                let own = f.components.iter();
                own.filter_map(|c| self.components.iter().position(|own| own == c))
                    .collect()
            });
            let are_equal = places.iter().all(|&k| found.values[k] == found.values[at])
                && found
                    .directions
                    .iter()
                    .all(|d| places.iter().all(|&k| d[k] == d[at]));
            if are_equal {
                component.tensor
            } else {
                component.name
            }
        };
        let mut said: Vec<(String, Expr)> = Vec::new();
        for (at, &value) in found.values.iter().enumerate() {
            let own = (name(at), value);
            if !said.contains(&own) {
                said.push(own);
            }
        }
        let each = said
            .iter()
            .map(|(name, value)| format!("{name} with the exponent {}", g.text(*value)));
        let mut words = each.collect::<Vec<_>>().join(", ");
        if !found.exist {
            words.push_str("; there are no exponents for which the defect vanishes");
        }
        for direction in &found.directions {
            let mut own: Vec<String> = Vec::new();
            for (at, &factor) in direction.iter().enumerate().filter(|(_, &e)| !g.is_zero(e)) {
                let text = format!("{} by {}", name(at), g.text(factor));
                if !own.contains(&text) {
                    own.push(text);
                }
            }
            words.push_str(&format!(
                "; as well with any multiple of a change of {}",
                own.join(", ")
            ));
        }
        format!(" ({words})")
    }
}

/// A small rational number that is not zero.
fn small(name: &str, seed: u64) -> Rational {
    let mut hash = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    for byte in name.bytes() {
        hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        hash ^= hash >> 29;
    }
    rational::ratio((hash % 40) as i64 + 3, 8).unwrap_or(Rational::ZERO)
}

/// All solutions of `Σ row_k x_k + row_last = 0`: one in which what is free is `free`, and the directions of the others. `None` where there
/// is none.
fn affine_solution(
    space: &Space,
    mut rows: Vec<Vec<Expr>>,
    count: usize,
    free: Expr,
) -> Option<(Vec<Expr>, Vec<Vec<Expr>>)> {
    let g = &space.graph;
    let vanishes = |e: Expr| g.is_zero(e) || (g.as_number(e).is_none() && space.vanish(&[e]));
    let mut pivots: Vec<usize> = Vec::new();
    for column in 0..count {
        let next = pivots.len();
        let Some(best) = (next..rows.len()).find(|&r| !vanishes(rows[r][column])) else {
            continue;
        };
        rows.swap(next, best);
        let pivot = rows[next][column];
        let own: Vec<Expr> = rows[next].iter().map(|&v| g.div(v, pivot)).collect();
        for (r, row) in rows.iter_mut().enumerate() {
            let factor = row[column];
            if r == next || g.is_zero(factor) {
                continue;
            }
            for (value, &above) in row.iter_mut().zip(&own) {
                *value = g.sub(*value, g.mul(&[factor, above]));
            }
        }
        rows[next] = own;
        pivots.push(column);
    }
    if rows[pivots.len()..].iter().any(|row| !vanishes(row[count])) {
        return None;
    }
    let short = |e: Expr| simplify::simplify(g, e, &simplify::Options::default());
    let open: Vec<usize> = (0..count).filter(|c| !pivots.contains(c)).collect();
    let mut values = vec![free; count];
    for (row, &column) in rows.iter().zip(&pivots) {
        let mut terms = vec![row[count]];
        terms.extend(open.iter().map(|&c| g.mul(&[row[c], free])));
        values[column] = short(g.neg(g.add(&terms)));
    }
    let direction = |&own: &usize| {
        let mut along = vec![g.zero(); count];
        along[own] = g.one();
        for (row, &column) in rows.iter().zip(&pivots) {
            along[column] = short(g.neg(row[own]));
        }
        along
    };
    let directions = open.iter().map(direction).collect();
    Some((values, directions))
}

fn decided(functional: &Functional, variation: &Variation, own: Generator) -> Finding {
    let space = &*functional.space;
    let g = &space.graph;
    let words = own.words.clone();
    let (own, scaled, open) = settled(functional, own);
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
    let words = format!("{words}{scaled}");
    let verdict = on_solutions(functional, variation, &current, &words);
    let is_open = !matches!(verdict, Verdict::Proved(_));
    if is_open && has_no_equations(functional, variation, current.defect) {
        return up_to_divergence(functional, current, &words);
    }
    let verdict = match (verdict, open) {
        (Verdict::Refuted(_), Some(function)) => Verdict::undecided(not_sought(&function)),
        (verdict, _) => verdict,
    };
    Finding {
        verdict,
        formulas: formulas(functional, &current),
    }
}

/// A symmetry whose defect is the divergence of a K, whatever the fields are: the current without K has none for solutions.
fn up_to_divergence(functional: &Functional, current: Current, words: &str) -> Finding {
    let space = &*functional.space;
    let g = &space.graph;
    let varied: Vec<usize> = current.characteristics.keys().copied().collect();
    let Some(added) = with_divergence(space, current.defect, &varied) else {
        return Finding {
            verdict: Verdict::undecided(format!(
                "the defect of {words} is a divergence, as its Euler expressions vanish, but of what was not found, so that no current without divergence is \
                 known"
            )),
            formulas: formulas(functional, &current),
        };
    };
    let pairs = current.flux.iter().zip(&added);
    let conserved = Current {
        flux: pairs.map(|(&own, &added)| g.sub(own, added)).collect(),
        defect: g.zero(),
        characteristics: current.characteristics,
    };
    let mut formulas = formulas(functional, &conserved);
    let along = space.coordinates.iter().zip(added);
    formulas.extend(along.filter_map(|(coordinate, e)| {
        shown(functional, format!("{ADDED} along {}", coordinate.name), e)
    }));
    let detail = format!(
        "{words} leaves the density as it is up to the divergence of a K, which is shown, and the divergence of the current without K, which is the one shown, \
         is Σ E Q, which vanishes for solutions"
    );
    Finding {
        verdict: Verdict::Proved(Proof::exact("all solutions", detail)),
        formulas,
    }
}

/// What is left out of Noether's current so that its divergence vanishes.
const ADDED: &str = "K, whose divergence is the change of the density,";

fn on_solutions(
    functional: &Functional,
    variation: &Variation,
    current: &Current,
    words: &str,
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
    let explicit = space.explicit(current.defect);
    if space.vanish(&[current.defect]) || space.vanish(&[explicit]) {
        return Verdict::Proved(Proof::exact(
            "all solutions",
            format!("{words} leaves the density as it is, and the divergence of its current is Σ E Q, which vanishes for solutions"),
        ));
    }
    let solved = Solved::new(space).with(&groups);
    match solved.verdict(current.defect) {
        Verdict::Proved(proof) => Verdict::Proved(Proof {
            on: "all solutions".into(),
            detail: format!("the defect of {words} vanishes where the Euler equations hold"),
            ..proof
        }),
        Verdict::Refuted(found) => Verdict::Refuted(found).prefixed(&format!(
            "the current of {words} has a divergence, the defect shown"
        )),
        other => other,
    }
}

/// Whether an expression is a divergence, whatever the fields are.
fn has_no_equations(functional: &Functional, variation: &Variation, e: Expr) -> bool {
    let space = &*functional.space;
    let varied = variation.euler.iter().map(|(component, _)| *component);
    is_divergence(space, space.explicit(e), varied)
}

/// Longer formulas are left to programs.
const LONGEST: u64 = 1_500;

fn formulas(functional: &Functional, current: &Current) -> Vec<Formula> {
    let space = &*functional.space;
    let along = space.coordinates.iter().zip(&current.flux);
    let along = along.map(|(own, &e)| (format!("the current along {}", own.name), e));
    let has_defect = !space.vanish(&[current.defect]);
    let defect = has_defect.then(|| {
        let caption = "the defect: the divergence of the current for solutions";
        (caption.to_owned(), current.defect)
    });
    let all = along.chain(defect);
    all.filter_map(|(caption, e)| shown(functional, caption, e))
        .collect()
}

/// A formula, where it is not zero and not too long to be shown.
fn shown(functional: &Functional, caption: String, e: Expr) -> Option<Formula> {
    let g = &functional.space.graph;
    if g.is_zero(e) || simplify::length(g, e) > LONGEST {
        return None;
    }
    let value = simplify::simplify(g, e, &simplify::Options::default());
    Some(Formula::new(caption, value))
}

#[cfg(test)]
mod tests {
    use super::affine_solution;
    use crate::space::Space;
    use chetaev_symbolic::Expr;

    #[test]
    fn all_exponents_are_found() {
        let space = Space::new(&[("x".into(), "x".into(), false)]);
        let g = &space.graph;
        let of = |rows: &[&[i64]]| -> Vec<Vec<Expr>> {
            let row = |row: &&[i64]| row.iter().map(|&n| g.integer(n)).collect();
            rows.iter().map(row).collect()
        };
        let solved = |rows: &[&[i64]]| affine_solution(&space, of(rows), 2, g.one());
        let text = |es: &[Expr]| es.iter().map(|&e| g.text(e)).collect::<Vec<_>>();
        let (values, directions) = solved(&[&[2, 0, 1], &[0, 3, -1], &[2, 3, 0]]).unwrap();
        assert_eq!(text(&values), ["-1/2", "1/3"]);
        assert!(directions.is_empty());
        // One equation for two of them: what is free takes the value given, and the other follows.
        let (values, directions) = solved(&[&[2, 4, -10]]).unwrap();
        assert_eq!(text(&values), ["3", "1"]);
        assert_eq!(text(&directions[0]), ["-2", "1"]);
        assert!(solved(&[&[1, 1, 1], &[1, 1, 2]]).is_none());
    }
}

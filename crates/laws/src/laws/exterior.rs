//! Identities of the exterior calculus, for forms and fields built of what a system is made of.

use super::{Expected, Kind, Subject, Trial};
use chetaev_geometry::cartan::CartanForm;
use chetaev_geometry::exterior::{Coframe, Field, Form, Space};
use chetaev_mechanics::{Frame, Manifold};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::{Expr, Verdict};
use std::time::Instant;

/// Forms of larger systems have too many components.
const COORDINATES: usize = 3;

/// d² = 0, Cartan's formula, the Leibniz rule, Jacobi's identity, pull-back commutes with d, and Θ(F) is the same in every frame.
pub(super) fn identities(subject: &Subject<'_>) -> Option<Trial> {
    let system = subject.cx.system;
    // A mass with a law of its own is no function on the jet space.
    if system.n() > COORDINATES || !system.masses.is_empty() {
        return None;
    }
    let start = Instant::now();
    let mut residuals = on_jets(subject);
    let framed = in_frames(subject);
    residuals.extend(framed.iter().flatten());
    let prover = &subject.cx.prover;
    let everywhere = "at all states";
    let on_jets = prover.identity(system, &residuals, &Manifold::default(), everywhere);
    let there = prover.identity(
        system,
        &pulled_back(subject),
        &subject.natural.manifold,
        "on the constraint manifold",
    );
    Some(Trial {
        kind: Kind::Other,
        formulation: "",
        law: "identities of the exterior calculus",
        about: String::new(),
        expected: Expected::Proved,
        verdict: match framed {
            Some(_) => on_jets.and(there),
            // A frame that is none, as its claim says, gives no contact forms.
            None if is_irregular(subject) => on_jets.and(there),
            None => Verdict::undecided("the contact forms of the frame are dependent"),
        },
        seconds: start.elapsed().as_secs_f64(),
    })
}

fn is_irregular(subject: &Subject<'_>) -> bool {
    let finding = subject.cx.finding("model.frame-regular");
    matches!(finding.verdict, Verdict::Refuted(_))
}

/// Functions of the state: what the system is made of, and products of its variables.
fn functions(subject: &Subject<'_>) -> Vec<Expr> {
    let (system, g) = (subject.cx.system, &subject.cx.system.graph);
    let mut all = vec![g.one(), g.symbol("t", 0), system.lagrangian];
    all.extend(&subject.cx.terms.constraints);
    for c in &system.coordinates {
        all.extend([c.q, c.v, g.mul(&[c.q, c.v]), g.sin(c.q)]);
    }
    all
}

struct Drawn<'a> {
    space: Space<'a>,
    functions: Vec<Expr>,
    random: Random,
}

impl Drawn<'_> {
    /// Components, most of them zero.
    fn components(&mut self) -> Vec<Expr> {
        let g = self.space.graph();
        (0..self.space.dimension())
            .map(|_| match self.random.below(2) {
                0 => g.zero(),
                _ => self.functions[self.random.below(self.functions.len() as u64) as usize],
            })
            .collect()
    }

    fn form(&mut self) -> Form {
        let components = self.components();
        self.space.one_form(&components)
    }

    fn field(&mut self) -> Field {
        Field {
            components: self.components(),
        }
    }
}

fn drawn<'a>(subject: &Subject<'a>) -> Drawn<'a> {
    Drawn {
        space: Space::Jet(subject.cx.system),
        functions: functions(subject),
        random: Random::stream(subject.seed, 0xd0d0),
    }
}

fn on_jets(subject: &Subject<'_>) -> Vec<Expr> {
    let mut drawn = drawn(subject);
    let (a, b) = (drawn.form(), drawn.form());
    let (x, y, z) = (drawn.field(), drawn.field(), drawn.field());
    let (space, g) = (drawn.space, drawn.space.graph());
    let product = a.wedge(g, &b);
    let mut all = a.d(&space).d(&space).residuals();
    all.extend(product.d(&space).d(&space).residuals());
    // Cartan's formula for a 1-form and a 2-form.
    for form in [&a, &product] {
        let both = form
            .contracted(g, &x)
            .d(&space)
            .plus(g, &form.d(&space).contracted(g, &x));
        all.extend(form.lie(&space, &x).minus(g, &both).residuals());
    }
    let leibniz = a.d(&space).wedge(g, &b).minus(g, &a.wedge(g, &b.d(&space)));
    all.extend(product.d(&space).minus(g, &leibniz).residuals());
    // dα(X, Y) = X(α(Y)) - Y(α(X)) - α([X, Y]).
    let along = |f: &Field, e: Expr| f.derivatives(&space, &[e])[0];
    all.push(g.add(&[
        a.d(&space).on(g, &[&x, &y]),
        g.neg(along(&x, a.on(g, &[&y]))),
        along(&y, a.on(g, &[&x])),
        a.on(g, &[&x.bracket(&space, &y)]),
    ]));
    let cyclic = [(&x, &y, &z), (&y, &z, &x), (&z, &x, &y)]
        .map(|(x, y, z)| x.bracket(&space, &y.bracket(&space, z)));
    all.extend(
        cyclic[0]
            .plus(&space, &cyclic[1])
            .plus(&space, &cyclic[2])
            .components,
    );
    all
}

/// The pull-back of dα is d of the pull-back, and that of a product the product.
fn pulled_back(subject: &Subject<'_>) -> Vec<Expr> {
    let mut drawn = drawn(subject);
    let (a, b) = (drawn.form(), drawn.form());
    let (jets, g) = (drawn.space, drawn.space.graph());
    let there = Space::Constraint(subject.cx.system, &subject.natural);
    let pull = |form: &Form| there.pulled_back(form);
    let mut all = pull(&a.d(&jets)).minus(g, &pull(&a).d(&there)).residuals();
    let product = pull(&a).wedge(g, &pull(&b));
    all.extend(pull(&a.wedge(g, &b)).minus(g, &product).residuals());
    all.push(g.zero());
    all
}

/// Θ(L) and Θ(f) by (3) in the adapted frame are those in the natural one; components in the contact basis make forms and fields
/// again, and pairings are the same in it.
fn in_frames(subject: &Subject<'_>) -> Option<Vec<Expr>> {
    let (cx, system, g) = (subject.cx, subject.cx.system, &subject.cx.system.graph);
    let space = Space::Jet(system);
    let (frame, _) = Frame::adapted(system, cx.terms, cx.selection).ok()?;
    let coframe = Coframe::contact(&space, &frame).ok()?;
    let mut all = Vec::new();
    let mut drawn = drawn(subject);
    let (form, field) = (drawn.form(), drawn.field());
    let components = coframe.field_components(&space, &field);
    let again = coframe.field(&space, &components).components;
    let pairs = again.iter().zip(&field.components);
    all.extend(pairs.map(|(&a, &b)| g.sub(a, b)));
    let of_form = coframe.components(&space, &form);
    let products = of_form.iter().map(|(a, &e)| g.mul(&[e, components[a[0]]]));
    let paired = g.add(&products.collect::<Vec<Expr>>());
    all.push(g.sub(paired, form.on(g, &[&field])));
    let functions = [system.lagrangian].into_iter();
    for f in functions.chain(cx.terms.constraints.iter().copied()) {
        let theta = CartanForm::of(system, f).form(&space);
        let components = coframe.components(&space, &theta);
        // F dt + (∂F/∂η^s) θ^s: ∂/∂η^s is the dual field of dη^s.
        let n = system.n();
        let mut sum = space.differential(0).times(g, f);
        for s in 0..n {
            let slope = coframe.fields[1 + n + s].derivatives(&space, &[f])[0];
            sum = sum.plus(g, &coframe.forms[1 + s].times(g, slope));
        }
        all.extend(theta.minus(g, &sum).residuals());
        let again = coframe.form(&space, 1, &components);
        all.extend(theta.minus(g, &again).residuals());
    }
    Some(all)
}

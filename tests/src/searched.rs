//! Systems of models with the first integrals that are found for them.

use chetaev::geometry::noether::found::{found, Found};
use chetaev::geometry::noether::motion::Motion;
use chetaev::mechanics::{Context, Prepared, Prover, System};
use chetaev::model::{load, Model, NoFiles, Style};
use chetaev::study::registry;
use chetaev::symbolic::Expr;

/// Asks about what the search finds for a model.
pub fn within<T>(model: &Model, ask: impl FnOnce(&Context<'_>, &Found) -> T) -> T {
    in_context(model, |cx| {
        let found = found(cx);
        ask(cx, found.as_ref().as_ref().expect("a search"))
    })
}

/// Asks about a model's system.
pub fn in_context<T>(model: &Model, ask: impl FnOnce(&Context<'_>) -> T) -> T {
    let system = System::from_model(model).expect("a system");
    let prepared = Prepared::new(&system).expect("independent velocities");
    let known = registry();
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(&system, terms, selection, &known, Prover::default());
    ask(&cx)
}

/// The rank of the derivatives of functions along the constraint manifold.
pub fn rank(cx: &Context<'_>, functions: &[Expr]) -> usize {
    let motion = Motion::of(cx).expect("accelerations");
    let matrix = motion.gradients(functions);
    let rank = cx.prover.rank(cx.system, &matrix, &motion.manifold);
    rank.expect("a rank").maximum
}

/// A model from its text.
pub fn made_up(text: &str) -> Model {
    match load("model.toml", text, &NoFiles, &[]).into_result() {
        Ok((model, _)) => model,
        Err(problems) => panic!("{text}{}", problems.render(Style::Plain)),
    }
}

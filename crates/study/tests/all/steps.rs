//! Derivations step by step: the skate and Chaplygin's sleigh as they are done by hand, and a step that is not true.
#![allow(clippy::unwrap_used)] // a panic is how a test fails

use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::steps::{steps, StepKind, Steps};
use chetaev_mechanics::{formulation, Context, Manifold, Prepared, Prover, System};
use chetaev_model::{load, NoFiles};
use chetaev_study::board::{board, checked, Board, BoardStep, Checked};
use chetaev_study::page::report;
use chetaev_study::{registry, study, ClaimSelection, Hooks, StudyOptions};
use chetaev_symbolic::meter::Work;
use chetaev_symbolic::{Expr, Verdict};

const SLEIGH: &str = include_str!("../../../../gallery/chaplygin-sleigh/model.toml");
const SKATE: &str = include_str!("../../../../gallery/skate-level/model.toml");

fn system(text: &str) -> System {
    let (model, _) = load("model.toml", text, &NoFiles, &[])
        .into_result()
        .unwrap();
    System::from_model(&model).unwrap()
}

fn with_context<T>(system: &System, what: impl FnOnce(&Context<'_>) -> T) -> T {
    let (prepared, known) = (Prepared::new(system).unwrap(), registry());
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    what(&Context::new(
        system,
        terms,
        selection,
        &known,
        Prover::default(),
    ))
}

fn derived(system: &System, name: &str) -> Board {
    let known = formulation(name).unwrap();
    with_context(system, |cx| {
        board(cx, known, &Work::of_seconds(60.0)).unwrap()
    })
}

fn step(board: &Board, kind: StepKind) -> &BoardStep {
    let found = board.steps.iter().find(|step| step.kind == kind);
    found.unwrap_or_else(|| panic!("{kind:?} is missing"))
}

/// The right side of the formula whose left side is the name.
fn value(system: &System, board: &Board, kind: StepKind, name: &str) -> Expr {
    let g = &system.graph;
    let own = &step(board, kind).pairs;
    let found = own.iter().find(|&&(left, _)| g.text(left) == name);
    found.unwrap_or_else(|| panic!("{kind:?} has no {name}")).1
}

fn are_equal(system: &System, a: Expr, b: Expr) {
    let g = &system.graph;
    let verdict = Prover::default().identity(system, &[g.sub(a, b)], &Manifold::default(), "");
    let is_proved = matches!(verdict, Verdict::Proved(_));
    assert!(is_proved, "{} is not {}", g.text(a), g.text(b));
}

/// Products of symbols, added.
fn sum(system: &System, terms: &[&[&str]]) -> Expr {
    let g = &system.graph;
    let factor = |name: &&str| match name.parse::<i64>() {
        Ok(number) => g.integer(number),
        Err(_) => match name.strip_suffix('\'') {
            Some(bare) => g.symbol(bare, 1),
            None => g.symbol(name, 0),
        },
    };
    let term = |names: &&[&str]| g.mul(&names.iter().map(factor).collect::<Vec<_>>());
    g.add(&terms.iter().map(term).collect::<Vec<_>>())
}

/// Whether all equations of a step are those of a list, in order and up to a factor that is no zero.
fn are_equations(system: &System, found: &BoardStep, expected: &[Expr]) {
    let g = &system.graph;
    assert_eq!(found.pairs.len(), expected.len());
    for (&(left, right), &own) in found.pairs.iter().zip(expected) {
        are_equal(system, g.sub(left, right), own);
    }
}

/// Chaplygin 1911, Carathéodory 1933: with the mass centre a ahead of the blade, u' = a w² and (J + m a²) w' = −m a u w; the
/// reaction of the blade is m J u w/(J + m a²). By hand, L* = m (u² + a² w²)/2 + J w²/2, and the curvature terms are m a w² and −m a u w.
#[test]
fn the_sleigh_is_derived_as_by_hand() {
    let system = system(SLEIGH);
    let g = &system.graph;
    let board = derived(&system, "reduced");
    assert!(board.steps.iter().all(BoardStep::is_written));
    let twice = g.mul(&[
        g.integer(2),
        value(&system, &board, StepKind::RestrictedLagrangian, "Lstar"),
    ]);
    let energy = sum(
        &system,
        &[
            &["m", "u", "u"],
            &["m", "a", "a", "w", "w"],
            &["J", "w", "w"],
        ],
    );
    are_equal(&system, twice, energy);
    let momentum = |name| value(&system, &board, StepKind::Momenta, name);
    are_equal(&system, momentum("p_u"), sum(&system, &[&["m", "u"]]));
    are_equal(
        &system,
        momentum("p_w"),
        sum(&system, &[&["J", "w"], &["m", "a", "a", "w"]]),
    );
    let term = |name| value(&system, &board, StepKind::CurvatureTerms, name);
    are_equal(&system, term("C_u"), sum(&system, &[&["m", "a", "w", "w"]]));
    are_equal(
        &system,
        term("C_w"),
        sum(&system, &[&["-1", "m", "a", "u", "w"]]),
    );
    let first = sum(&system, &[&["m", "u'"], &["-1", "m", "a", "w", "w"]]);
    let second = sum(
        &system,
        &[&["J", "w'"], &["m", "a", "a", "w'"], &["m", "a", "u", "w"]],
    );
    are_equations(&system, step(&board, StepKind::Collected), &[first, second]);
    let reaction = value(&system, &board, StepKind::Reactions, "lambda_blade");
    let inertia = sum(&system, &[&["J"], &["m", "a", "a"]]);
    let own = g.mul(&[reaction, inertia]);
    are_equal(&system, own, sum(&system, &[&["m", "J", "u", "w"]]));
    // The steps come in the order of a lecture: the reactions last.
    let kinds: Vec<StepKind> = board.steps.iter().map(|step| step.kind).collect();
    assert_eq!(kinds.first(), Some(&StepKind::Lagrangian));
    assert_eq!(kinds.last(), Some(&StepKind::Reactions));
}

/// The skate on level ice, Neimark and Fufaev 1972: m u' = 0, J w' = 0, no curvature term, and the reaction −m u w of
/// x' sin φ − y' cos φ = 0.
#[test]
fn the_skate_is_derived_as_by_hand() {
    let system = system(SKATE);
    for name in ["reduced", "maggi"] {
        let board = derived(&system, name);
        assert!(board.steps.iter().all(BoardStep::is_written), "{name}");
        let reaction = value(&system, &board, StepKind::Reactions, "lambda_blade");
        are_equal(&system, reaction, sum(&system, &[&["-1", "m", "u", "w"]]));
    }
    let board = derived(&system, "reduced");
    assert_eq!(step(&board, StepKind::CurvatureTerms).pairs, []);
    let equations = [sum(&system, &[&["m", "u'"]]), sum(&system, &[&["J", "w'"]])];
    are_equations(&system, step(&board, StepKind::Collected), &equations);
    let own = step(&derived(&system, "maggi"), StepKind::Contracted).clone();
    are_equations(&system, &own, &equations);
    // Voronets: one of x' and y' by the other, so that x' sin φ − y' cos φ vanishes.
    let board = derived(&system, "voronets");
    assert!(board.steps.iter().all(BoardStep::is_written));
    let g = &system.graph;
    let phi = g.symbol("phi", 0);
    let of_blade = &step(&board, StepKind::AdmissibleVelocities).pairs;
    let blade = g.sub(
        g.mul(&[g.symbol("x", 1), g.sin(phi)]),
        g.mul(&[g.symbol("y", 1), g.cos(phi)]),
    );
    assert_eq!(of_blade.len(), 1);
    are_equal(&system, g.substitute(blade, of_blade), g.zero());
    // With multipliers the coordinates are those of the model: m x'' = λ sin φ.
    let board = derived(&system, "routh");
    assert!(board.steps.iter().all(BoardStep::is_written));
    let (left, right) = step(&board, StepKind::WithMultipliers).pairs[0];
    let force = g.mul(&[g.symbol("lambda_blade", 0), g.sin(phi)]);
    let inertia = g.mul(&[g.symbol("m", 0), g.symbol("x", 2)]);
    are_equal(&system, g.sub(left, right), g.sub(inertia, force));
}

/// Every step that is proved is refuted when its first formula is spoilt, and is not written then; the others stand.
#[test]
fn a_spoilt_step_is_refuted_and_not_written() {
    let system = system(SLEIGH);
    let g = &system.graph;
    for name in ["reduced", "maggi", "routh", "voronets"] {
        let known = formulation(name).unwrap();
        with_context(&system, |cx| {
            let steps: Steps = steps(name, &basis(cx)).unwrap().unwrap();
            let right = checked(cx, known.card(), &steps, &Work::of_seconds(60.0));
            for (at, own) in right.steps.iter().enumerate() {
                if own.checked != Checked::Proved || own.kind == StepKind::SolvedForAll {
                    continue;
                }
                let mut spoilt = steps.clone();
                let formula = &mut spoilt.steps[at].formulas[0];
                formula.right = g.add(&[formula.right, g.symbol("m", 0)]);
                spoilt.steps = vec![spoilt.steps[at].clone()];
                let board = checked(cx, known.card(), &spoilt, &Work::of_seconds(60.0));
                let found = &board.steps[0];
                let is_refuted = matches!(
                    &found.checked,
                    Checked::NotProved(verdict) if matches!(**verdict, Verdict::Refuted(_))
                );
                assert!(is_refuted, "{name} {:?}: {:?}", own.kind, found.checked);
                assert!(found.pairs.is_empty() && !found.is_written());
            }
        });
    }
}

/// The page asks for the derivation, and what it folds below is the whole of it.
#[test]
fn the_report_has_an_exercise_with_its_solution_folded() {
    let (model, _) = load("model.toml", SLEIGH, &NoFiles, &[])
        .into_result()
        .unwrap();
    let options = StudyOptions {
        claims: ClaimSelection {
            words: vec!["model.constraints-linear".to_owned()],
        },
        ..StudyOptions::default()
    };
    let mut hooks = Hooks {
        clock: &|| 0.0,
        interrupt: None,
        progress: &mut |_, _| (),
    };
    let page = report(&study(model, options, &mut hooks).unwrap(), None, &[]);
    let sections = page.sections.iter();
    let exercises: Vec<_> = sections.filter(|own| own.exercise.is_some()).collect();
    let [own] = exercises.as_slice() else {
        panic!("{} exercises", exercises.len())
    };
    assert!(own.collapsed);
    let steps = derived(&system(SLEIGH), "reduced").steps.len();
    let headings = own.equations.iter().filter(|line| line.heading.is_some());
    assert_eq!(headings.count(), steps);
    // Of the sleigh only the slopes along the quasi-velocities are all zero.
    let said = own
        .equations
        .iter()
        .filter_map(|line| line.omitted.as_deref());
    assert_eq!(said.collect::<Vec<_>>(), ["All of them vanish."]);
}

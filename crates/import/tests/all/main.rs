//! All integration tests of this package in one program: what is imported is read as a model.
#![allow(
    clippy::panic,
    clippy::expect_used,
    clippy::unwrap_used,
    reason = "test code fails where it stands"
)]

mod bounds;
mod mjcf;
mod urdf;

use chetaev_import::{import, Imported};
use chetaev_model::{load, Model, NoFiles};
use chetaev_symbolic::Expr;

/// A description that is read, and its text as a model.
#[track_caller]
fn model(text: &str) -> (Imported, Model) {
    let imported = import(text).unwrap_or_else(|problem| panic!("{problem}"));
    let loaded = load("model.toml", &imported.text, &NoFiles, &[]);
    let (model, found) = loaded
        .into_result()
        .unwrap_or_else(|problems| panic!("{}{problems}", imported.text));
    assert!(found.list.is_empty(), "{}{found}", imported.text);
    (imported, model)
}

/// The value of an expression where all that is not named here is a parameter.
#[track_caller]
fn value(model: &Model, e: Expr, state: &[(&str, f64)]) -> f64 {
    let g = &model.graph;
    let values: Vec<(Expr, f64)> = model
        .parameters
        .iter()
        .filter_map(|own| {
            Some((
                own.symbol,
                g.evaluate_f64(&[own.value?], &|_| None).ok()?[0],
            ))
        })
        .collect();
    let of = |symbol| {
        let text = g.symbol_text(symbol);
        let stated = state
            .iter()
            .find(|(name, _)| *name == text)
            .map(|(_, x)| *x);
        let own = || {
            values
                .iter()
                .find(|(own, _)| g.as_symbol(*own) == Some(symbol))
                .map(|(_, x)| *x)
        };
        stated.or_else(own)
    };
    g.evaluate_f64(&[e], &of)
        .unwrap_or_else(|problem| panic!("{problem:?}"))[0]
}

type Vector = [f64; 3];

fn plus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| a[i] + b[i])
}

/// Rodrigues's formula: a vector turned about a unit axis.
fn turned(axis: Vector, angle: f64, v: Vector) -> Vector {
    let size = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let n = axis.map(|x| x / size);
    let dot: f64 = (0..3).map(|i| n[i] * v[i]).sum();
    let cross: Vector =
        std::array::from_fn(|i| n[(i + 1) % 3] * v[(i + 2) % 3] - n[(i + 2) % 3] * v[(i + 1) % 3]);
    std::array::from_fn(|i| {
        v[i] * angle.cos() + cross[i] * angle.sin() + n[i] * dot * (1.0 - angle.cos())
    })
}

//! An ensemble of discs on one thread.

use crate::clock::per_unit;
use crate::prepared::{words, Prepared, Source};
use crate::question::Question;
use crate::trajectory::settings;
use crate::Ready;
use chetaev::ensemble::outcome::Shape;
use chetaev::ensemble::pool::run;
use chetaev::ensemble::{Member, Members, Routh};
use chetaev::motion::{ConsistentState, InitialData, RunSettings};
use serde_json::json;
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

/// The members of `bench/systems/ensemble.py`.
#[derive(Debug)]
struct Discs {
    count: usize,
    settings: RunSettings,
}

/// (q, v) of a member; lean and spin by the golden ratio and the root of two.
fn disc(index: u64) -> (Vec<f64>, Vec<f64>) {
    let i = index as f64;
    let lean = 0.2 + 0.1 * (0.6180339887 * i).fract();
    let spin = 6.5 + (0.4142135624 * i).fract();
    let (s, c) = 0.4_f64.sin_cos();
    (
        vec![0.0, 0.0, 0.4, lean, -0.3],
        vec![0.3 * spin * c, 0.3 * spin * s, 0.6, 0.35, spin],
    )
}

impl Members for Discs {
    fn count(&self) -> u64 {
        self.count as u64
    }

    fn member(&self, index: u64) -> Result<Member, String> {
        let (q, v) = disc(index);
        Ok(Member {
            parameters: None,
            data: InitialData {
                t: 0.0,
                q,
                v,
                q_fixed: vec![true; 5],
                // The velocities of the contact follow from the rolling.
                v_fixed: vec![false, false, true, true, true],
                project: false,
            },
            settings: self.settings.clone(),
        })
    }

    fn check(&self, _: u64, _: &ConsistentState) -> Result<(), String> {
        Ok(())
    }
}

/// `count` discs to `t_end`; the answer is q at the end of about twenty of them.
///
/// # Errors
/// What is wrong with the model or a member.
pub fn ensemble(question: &Question) -> Result<Ready, String> {
    let source = Source::of(&question.root, &question.system)?;
    let (q, v) = disc(0);
    let prepared = Prepared::new(&source, &[q, v].concat())?;
    let (settings, count) = (settings(question), question.count);
    let once = move || {
        let subject = prepared.subject();
        let compiled = subject.compile_routh(&settings).map_err(words)?;
        let members = Discs {
            count,
            settings: settings.clone(),
        };
        let shape = Shape {
            state: 10,
            kept: 0,
            events: 0,
            samples: 0,
        };
        ends(&Routh::new(members, subject, compiled, shape), count)
    };
    let every = (count / 20).max(1);
    let answer: Vec<Vec<f64>> = once()?
        .iter()
        .step_by(every)
        .map(|end| end[..5].to_vec())
        .collect();
    Ok(Ready {
        answer: json!(answer),
        info: json!({}),
        measure: Box::new(move || per_unit(count as f64, || once().map(|_| ()))),
    })
}

/// The states at the ends, in order.
fn ends(work: &Routh<'_, Discs>, count: usize) -> Result<Vec<Vec<f64>>, String> {
    let mut ends = vec![Vec::new(); count];
    let mut problem = None;
    let nobody = AtomicBool::new(false);
    let all = std::iter::once(0..count as u64).collect::<Vec<_>>();
    run(work, (&all, 1), &nobody, |batch| {
        for (index, outcome) in batch {
            if let Some(reason) = outcome.reason {
                problem = Some(reason);
                return ControlFlow::Break(());
            }
            ends[index as usize] = outcome.end;
        }
        ControlFlow::Continue(())
    });
    match problem {
        Some(reason) => Err(reason),
        None => Ok(ends),
    }
}

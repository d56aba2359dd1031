//! One item: all participants are made ready, then measured in turn, round by round.

use super::judge;
use super::plan::{Item, Participant};
use super::results::{Row, Status};
use super::talk::{Silence, Talk};
use super::workplace::Workplace;
use crate::err;
use serde_json::{json, Value};

/// A participant at work.
struct Seat {
    row: Row,
    talk: Option<Talk>,
    expected: Option<Vec<Vec<f64>>>,
}

/// Measures those participants of an item that `wanted` names.
pub(crate) fn measure(place: &Workplace, item: &Item, wanted: &[&Participant]) -> Vec<Row> {
    let reference = place.reference(item.system);
    let mut seats: Vec<Seat> = wanted
        .iter()
        .map(|participant| {
            err(&format!("  {} {}", participant.peer, participant.variant));
            let seat = prepare(place, item, participant, &reference);
            err(&format!(": {}\n", seat.word()));
            seat
        })
        .collect();
    for round in 0..item.rounds {
        let count = seats.len().max(1);
        for place_in_turn in 0..seats.len() {
            // Everybody is first once.
            seats[(place_in_turn + round) % count].measure(item);
        }
    }
    seats.into_iter().map(Seat::leave).collect()
}

fn question(item: &Item, participant: &Participant, reference: &Value, place: &Workplace) -> Value {
    let mut asked = json!({
        "do": "prepare",
        "item": item.kind,
        "system": item.system,
        "form": participant.form,
        "variant": participant.variant,
        "tolerance": item.tolerance,
        "count": item.count,
        "steps": item.steps,
        "t_end": reference["t_end"],
        "root": place.root(),
        "program": place.program(),
        "scratch": place.scratch(),
    });
    for key in ["states", "start", "hand_states", "hand_start", "energy"] {
        asked[key] = reference[key].clone();
    }
    if item.kind == "ensemble" {
        asked["t_end"] = reference["ensemble_t_end"].clone();
    }
    asked
}

fn prepare(place: &Workplace, item: &Item, participant: &Participant, reference: &Value) -> Seat {
    let mut seat = Seat {
        row: Row {
            item: item.kind.into(),
            system: item.system.into(),
            peer: participant.peer.into(),
            form: participant.form.into(),
            variant: participant.variant.into(),
            tolerance: item.tolerance,
            load: [super::machine::load(); 2],
            ..Row::default()
        },
        talk: None,
        expected: judge::expected(reference, item.kind, participant.form, item.count),
    };
    if seat.expected.is_none() && matches!(item.kind, "derive" | "rhs" | "trajectory" | "ensemble")
    {
        seat.row.status = Status::Unchecked;
        seat.row.reason = "there is no reference".into();
    }
    let started = place.command(participant.peer).and_then(|command| {
        let log = place.log()?;
        Talk::start(command, log).map_err(|silence| format!("{silence:?}"))
    });
    let mut talk = match started {
        Ok(talk) => talk,
        Err(problem) => return seat.failed(problem),
    };
    let asked = question(item, participant, reference, place);
    match talk.ask(&asked, item.cap) {
        Err(silence) => return seat.silent(silence),
        Ok(answer) => {
            seat.row.info = answer["info"].clone();
            seat.talk = Some(talk);
            if !answer["answer"].is_null() {
                seat.judge(item.kind, &answer["answer"]);
            }
        }
    }
    seat
}

impl Seat {
    fn failed(mut self, reason: String) -> Seat {
        self.fail(Status::Failed, reason);
        self
    }

    fn silent(mut self, silence: Silence) -> Seat {
        self.hush(silence);
        self
    }

    fn hush(&mut self, silence: Silence) {
        match silence {
            Silence::Late(seconds) => {
                self.fail(Status::Late, format!("not finished after {seconds:.0} s"));
            }
            Silence::Refused(reason) | Silence::Gone(reason) => self.fail(Status::Failed, reason),
        }
    }

    fn fail(&mut self, status: Status, reason: String) {
        self.row.status = status;
        self.row.reason = reason;
        self.talk = None;
    }

    /// Compares an answer; a wrong one ends the participation.
    fn judge(&mut self, kind: &str, answer: &Value) {
        let Some(expected) = &self.expected else {
            return;
        };
        match judge::deviation(kind, answer, expected) {
            None => self.fail(
                Status::Wrong,
                "the answer has another shape, or no numbers".into(),
            ),
            Some(off) => {
                self.row.deviation = Some(self.row.deviation.map_or(off, |old| old.max(off)));
                if off > judge::limit(kind) {
                    self.fail(Status::Wrong, format!("off by {off:.1e}"));
                }
            }
        }
    }

    fn measure(&mut self, item: &Item) {
        let Some(talk) = &mut self.talk else {
            return;
        };
        if talk.processor() > item.cap {
            return;
        }
        match talk.ask(&json!({"do": "measure"}), item.cap) {
            // What was measured before counts.
            Err(Silence::Late(_)) if !self.row.seconds.is_empty() => self.talk = None,
            Err(silence) => self.hush(silence),
            Ok(found) => {
                let number = |key: &str| found[key].as_f64();
                self.row.seconds.extend(number("seconds"));
                self.row.wall.extend(number("wall"));
                self.row.parts = found["parts"].clone();
                self.row.curve = serde_json::from_value(found["curve"].clone()).ok();
                if !found["answer"].is_null() {
                    self.judge(item.kind, &found["answer"]);
                }
            }
        }
    }

    fn word(&self) -> String {
        match self.row.status {
            Status::Right | Status::Unchecked => "ready".into(),
            _ => self.row.reason.clone(),
        }
    }

    fn leave(mut self) -> Row {
        if let Some(mut talk) = self.talk.take() {
            if let Ok(last) = talk.ask(&json!({"do": "quit"}), 10.0) {
                let bytes = |key: &str| last[key].as_u64().unwrap_or(0);
                self.row.memory = bytes("memory").max(bytes("children"));
                self.row.before = bytes("before");
            }
        }
        self.row.load[1] = super::machine::load();
        if self.row.counts() || self.row.status != Status::Right {
            return self.row;
        }
        self.row.status = Status::Failed;
        self.row.reason = "nothing was measured".into();
        self.row
    }
}

//! Work that is counted, so that a budget means the same on every machine; and stopped, so that nothing runs on when it is spent or when
//! somebody has had enough.
//!
//! What costs time (nodes made, terms of polynomials, operations in prime fields and in balls) is counted where it is done, by
//! [`spend`]. [`within`] sets the limit for a piece of work. Where the limit is exceeded, or the work is stopped from outside, the
//! piece ends at once, by unwinding to `within`, which returns why. Nothing is lost but the piece: graphs only grow, and
//! caches keep what is complete. Outside of `within` nothing is limited.

use std::cell::{Cell, RefCell};
use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};
use std::sync::atomic::{AtomicU64, AtomicU8, Ordering};
use std::sync::{Arc, OnceLock};

/// Units of work that count as one second: about what a processor of 2020 does. The rate is fixed, so that a budget in seconds is the
/// same work everywhere.
pub const UNITS_PER_SECOND: f64 = 1e8;

/// Units are added to the account when so many have come together.
const TOGETHER: u64 = 20_000;

/// Why a piece of work ended early.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stopped {
    /// The work allowed was spent.
    Spent,
    /// Somebody interrupted it.
    Interrupted,
    /// It took far more time than its work should.
    Late,
}

const RUNNING: u8 = 0;

impl Stopped {
    fn code(self) -> u8 {
        match self {
            Stopped::Spent => 1,
            Stopped::Interrupted => 2,
            Stopped::Late => 3,
        }
    }

    fn of_code(code: u8) -> Option<Stopped> {
        [Stopped::Spent, Stopped::Interrupted, Stopped::Late]
            .into_iter()
            .find(|reason| reason.code() == code)
    }
}

/// An amount of work, what of it is spent, and whether it is to stop. Shared by the threads that do the work and those that watch.
#[derive(Debug)]
pub struct Work {
    limit: u64,
    spent: AtomicU64,
    stop: AtomicU8,
}

impl Work {
    /// So many units.
    pub fn of_units(limit: u64) -> Arc<Work> {
        Arc::new(Work {
            limit,
            spent: AtomicU64::new(0),
            stop: AtomicU8::new(RUNNING),
        })
    }

    /// So many seconds by [`UNITS_PER_SECOND`].
    pub fn of_seconds(seconds: f64) -> Arc<Work> {
        // Numbers beyond the range saturate; what is no number allows nothing.
        Work::of_units((seconds * UNITS_PER_SECOND) as u64)
    }

    /// Without a limit, to be stopped from outside only.
    pub fn unlimited() -> Arc<Work> {
        Work::of_units(u64::MAX)
    }

    /// Units spent so far, up to what threads have not added yet.
    pub fn spent(&self) -> u64 {
        self.spent.load(Ordering::Relaxed)
    }

    /// Whether the limit is exceeded.
    pub fn is_spent(&self) -> bool {
        self.spent() > self.limit
    }

    /// Ends the work soon. The first reason counts.
    pub fn stop(&self, reason: Stopped) {
        let stop = &self.stop;
        let _ = stop.compare_exchange(RUNNING, reason.code(), Ordering::Relaxed, Ordering::Relaxed);
    }

    /// Why it is to end.
    pub fn stopped(&self) -> Option<Stopped> {
        Stopped::of_code(self.stop.load(Ordering::Relaxed))
    }

    fn add(&self, units: u64) -> Option<Stopped> {
        let before = self.spent.fetch_add(units, Ordering::Relaxed);
        if before.saturating_add(units) > self.limit {
            self.stop(Stopped::Spent);
        }
        self.stopped()
    }
}

struct Local {
    pending: Cell<u64>,
    work: RefCell<Option<Arc<Work>>>,
}

thread_local! {
    static LOCAL: Local = const {
        Local {
            pending: Cell::new(0),
            work: RefCell::new(None),
        }
    };
}

/// What unwinds; nobody else catches it.
struct Unwinding;

/// How a piece of work is left where nothing unwinds, as in a browser: a panic ends the whole program there.
pub trait Escape: Sync {
    /// Does something, and says whether it was left by [`Escape::leave`]. What was owned on the way is not dropped then.
    fn attempt(&self, what: &mut dyn FnMut()) -> bool;

    /// Goes back to the innermost [`Escape::attempt`].
    fn leave(&self) -> !;
}

static ESCAPE: OnceLock<&'static dyn Escape> = OnceLock::new();

/// Leaves pieces of work by `escape` in place of unwinding, from now on. The first one counts.
pub fn escape_by(escape: &'static dyn Escape) {
    let _ = ESCAPE.set(escape);
}

/// Does something, which may be left; what it gave otherwise.
fn attempted<T>(what: impl FnOnce() -> T) -> Result<T, Box<dyn std::any::Any + Send>> {
    let Some(escape) = ESCAPE.get() else {
        return catch_unwind(AssertUnwindSafe(what));
    };
    let (mut what, mut found) = (Some(what), None);
    escape.attempt(&mut || found = what.take().map(|what| what()));
    found.ok_or_else(|| Box::new(Unwinding) as _)
}

/// Counts units of work. Does not return where the work is to stop.
#[inline]
pub fn spend(units: u64) {
    let due = LOCAL.with(|local| {
        let pending = local.pending.get().saturating_add(units);
        local.pending.set(pending);
        pending >= TOGETHER
    });
    if due {
        settle();
    }
}

/// Adds what has come together to the account.
#[cold]
fn settle() {
    let stopped = LOCAL.with(|local| {
        let pending = local.pending.replace(0);
        let work = local.work.borrow();
        work.as_ref().and_then(|work| work.add(pending))
    });
    // A second unwinding while one is going on would abort.
    if stopped.is_some() && !std::thread::panicking() {
        match ESCAPE.get() {
            Some(escape) => escape.leave(),
            None => resume_unwind(Box::new(Unwinding)),
        }
    }
}

/// The work of this thread replaced by another one until this is dropped.
struct Replaced {
    outer: Option<Arc<Work>>,
}

impl Replaced {
    fn by(work: Option<Arc<Work>>) -> Replaced {
        LOCAL.with(|local| {
            // What was done before belongs to the outer one, which looks at it when it goes on.
            let pending = local.pending.replace(0);
            let outer = local.work.replace(work);
            if let Some(outer) = &outer {
                let _ = outer.add(pending);
            }
            Replaced { outer }
        })
    }
}

impl Drop for Replaced {
    fn drop(&mut self) {
        LOCAL.with(|local| {
            let pending = local.pending.replace(0);
            let inner = local.work.replace(self.outer.take());
            if let Some(inner) = inner {
                let _ = inner.add(pending);
            }
        });
    }
}

/// Does something within an amount of work. What an outer `within` allows does not count inside.
///
/// # Errors
/// Why it ended early.
pub fn within<T>(work: &Arc<Work>, what: impl FnOnce() -> T) -> Result<T, Stopped> {
    if let Some(reason) = work.stopped() {
        return Err(reason);
    }
    let replaced = Replaced::by(Some(Arc::clone(work)));
    let found = attempted(what);
    drop(replaced);
    match found {
        Ok(found) => Ok(found),
        Err(payload) if payload.is::<Unwinding>() => Err(work.stopped().unwrap_or(Stopped::Spent)),
        Err(payload) => resume_unwind(payload),
    }
}

/// The work that this thread does its own within, for threads that help it.
pub fn current() -> Option<Arc<Work>> {
    LOCAL.with(|local| local.work.borrow().clone())
}

/// Does a part of the work of another thread; where that stops, so does this, by unwinding to whoever joins the thread.
pub fn helping<T>(work: Option<Arc<Work>>, what: impl FnOnce() -> T) -> T {
    let _replaced = Replaced::by(work);
    what()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn busy(units: u64) -> u64 {
        (0..units)
            .map(|i| {
                spend(1);
                i & 1
            })
            .sum()
    }

    #[test]
    fn what_is_spent_ends_and_the_rest_goes_on() {
        let work = Work::of_units(100_000);
        assert_eq!(within(&work, || busy(50_000)), Ok(25_000));
        assert_eq!(within(&work, || busy(1_000_000)), Err(Stopped::Spent));
        // It stays spent.
        assert_eq!(within(&work, || 1), Err(Stopped::Spent));
        assert!(work.is_spent());
        // Outside nothing is limited.
        assert_eq!(busy(1_000_000), 500_000);
    }

    #[test]
    fn the_same_work_ends_at_the_same_place() {
        let reached = || {
            let work = Work::of_units(1_000_000);
            let mut place = 0;
            let ended = within(&work, || {
                for i in 0.. {
                    spend(7);
                    place = i;
                }
            });
            assert_eq!(ended, Err(Stopped::Spent));
            place
        };
        assert_eq!(reached(), reached());
    }

    #[test]
    fn an_inner_piece_that_is_spent_does_not_end_the_outer_one() {
        let (outer, inner) = (Work::of_units(10_000_000), Work::of_units(50_000));
        let found = within(&outer, || {
            let ended = within(&inner, || busy(1_000_000));
            (ended, busy(100))
        });
        assert_eq!(found, Ok((Err(Stopped::Spent), 50)));
    }

    #[test]
    fn another_thread_stops_it() {
        let work = Work::unlimited();
        let ended = std::thread::scope(|scope| {
            let watched = Arc::clone(&work);
            scope.spawn(move || {
                std::thread::sleep(std::time::Duration::from_millis(20));
                watched.stop(Stopped::Interrupted);
            });
            within(&work, || busy(u64::MAX))
        });
        assert_eq!(ended, Err(Stopped::Interrupted));
    }

    #[test]
    fn a_helping_thread_ends_with_the_work() {
        let work = Work::of_units(100_000);
        let ended = within(&work, || {
            let own = current();
            let joined = std::thread::scope(|scope| {
                scope
                    .spawn(move || helping(own, || busy(10_000_000)))
                    .join()
            });
            match joined {
                Ok(found) => found,
                Err(payload) => resume_unwind(payload),
            }
        });
        assert_eq!(ended, Err(Stopped::Spent));
    }

    #[test]
    fn other_panics_are_none_of_ours() {
        let found = catch_unwind(|| within(&Work::unlimited(), || resume_unwind(Box::new(7_i32))));
        assert_eq!(found.unwrap_err().downcast_ref::<i32>(), Some(&7));
    }
}

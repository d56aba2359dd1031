//! Trajectories on threads.
//!
//! Whoever is free takes the next trajectory from a common counter, so that no thread waits while there are trajectories, however
//! few and however long. What has ended is taken over by the calling thread many times a second, and given to the sink: a
//! process that is killed loses what was under way and what ended in that moment. When the sink is slow the threads wait, and memory
//! stays bounded.

use crate::outcome::Outcome;
use std::ops::{ControlFlow, Range};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How long what has ended waits for the sink at most, and how long an interrupt goes unseen.
const MOMENT: Duration = Duration::from_millis(50);
/// So many numbers go to the sink at once.
const ENOUGH: usize = 1 << 16;
/// Threads wait while so many numbers wait for the sink.
const MOST: usize = 1 << 21;

/// Trajectories that have ended, by number.
pub type Batch = Vec<(u64, Outcome)>;

/// Computes trajectories, on one thread.
pub trait Worker {
    /// Computes the trajectories whose numbers `next` gives, until it gives none, and gives each to `done` as it ends; those
    /// that are under way when `interrupt` becomes true are dropped. What a trajectory gives depends on its number alone.
    fn work(
        &mut self,
        next: &dyn Fn() -> Option<u64>,
        done: &dyn Fn(u64, Outcome),
        interrupt: &AtomicBool,
    );
}

/// An ensemble: makes a worker for each thread.
pub trait Work: Sync {
    /// A worker, made and used on the thread that calls, that has at most `most` trajectories under way at a time.
    fn worker(&self, most: usize) -> Box<dyn Worker + '_>;

    /// Number of trajectories.
    fn count(&self) -> u64;
}

/// Computes the trajectories `wanted`, ascending ranges of numbers, on `threads` threads and gives them to `sink` as they end, in
/// batches ordered by number, on the calling thread. Ends early when the sink breaks or `interrupt` becomes true: then what has
/// ended before an interrupt still goes to the sink, and what was under way is lost.
pub fn run(
    work: &dyn Work,
    (wanted, threads): (&[Range<u64>], usize),
    interrupt: &AtomicBool,
    mut sink: impl FnMut(Batch) -> ControlFlow<()>,
) {
    let queue = Queue::new(wanted);
    let threads = threads.clamp(1, usize::try_from(queue.count.max(1)).unwrap_or(usize::MAX));
    // A thread that takes several side by side leaves the others theirs.
    let most = usize::try_from(queue.count).unwrap_or(usize::MAX) / threads;
    let ended = Ended::new(threads);
    let stop = AtomicBool::new(interrupt.load(Ordering::Relaxed));
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let _leaving = Leaving(&ended);
                let next = || match stop.load(Ordering::Relaxed) {
                    true => None,
                    false => queue.next(),
                };
                let done = |index, outcome| ended.put(index, outcome);
                work.worker(most.max(1)).work(&next, &done, &stop);
            });
        }
        // However this thread leaves, the others learn it.
        let _closing = Closing(&ended, &stop);
        loop {
            let (mut batch, is_last) = ended.take();
            if interrupt.load(Ordering::Relaxed) {
                stop.store(true, Ordering::Relaxed);
            }
            batch.sort_by_key(|(index, _)| *index);
            if (!batch.is_empty() && sink(batch).is_break()) || is_last {
                break;
            }
        }
    });
}

/// Numbers that nobody has taken.
struct Queue {
    /// How many numbers come before each range, and where it begins.
    ranges: Vec<(u64, u64)>,
    count: u64,
    taken: AtomicU64,
}

impl Queue {
    fn new(wanted: &[Range<u64>]) -> Queue {
        let mut count = 0;
        let mut ranges = Vec::with_capacity(wanted.len());
        for range in wanted.iter().filter(|range| range.start < range.end) {
            ranges.push((count, range.start));
            count += range.end - range.start;
        }
        Queue {
            ranges,
            count,
            taken: AtomicU64::new(0),
        }
    }

    fn next(&self) -> Option<u64> {
        let place = self.taken.fetch_add(1, Ordering::Relaxed);
        if place >= self.count {
            return None;
        }
        let after = self.ranges.partition_point(|(before, _)| *before <= place);
        let (before, start) = self.ranges.get(after.checked_sub(1)?)?;
        Some(start + (place - before))
    }
}

/// What has ended and waits for the sink.
struct Ended {
    waiting: Mutex<Waiting>,
    /// There is enough for the sink, or nobody works.
    ready: Condvar,
    /// The sink has taken everything.
    taken: Condvar,
}

struct Waiting {
    batch: Batch,
    numbers: usize,
    /// Threads at work.
    threads: usize,
    /// Nobody takes any more.
    is_closed: bool,
}

impl Ended {
    fn new(threads: usize) -> Ended {
        Ended {
            waiting: Mutex::new(Waiting {
                batch: Batch::new(),
                numbers: 0,
                threads,
                is_closed: false,
            }),
            ready: Condvar::new(),
            taken: Condvar::new(),
        }
    }

    /// A thread that panicked leaves whole entries behind.
    fn lock(&self) -> MutexGuard<'_, Waiting> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn put(&self, index: u64, outcome: Outcome) {
        let waiting = self.lock();
        let is_full = |waiting: &mut Waiting| waiting.numbers >= MOST && !waiting.is_closed;
        let waiting = self.taken.wait_while(waiting, is_full);
        let mut waiting = waiting.unwrap_or_else(PoisonError::into_inner);
        waiting.numbers += outcome.numbers();
        waiting.batch.push((index, outcome));
        if waiting.numbers >= ENOUGH {
            self.ready.notify_one();
        }
    }

    /// What has ended since, and whether nothing will follow.
    fn take(&self) -> (Batch, bool) {
        let is_early = |waiting: &mut Waiting| waiting.numbers < ENOUGH && waiting.threads > 0;
        let waited = self.ready.wait_timeout_while(self.lock(), MOMENT, is_early);
        let (mut waiting, _) = waited.unwrap_or_else(PoisonError::into_inner);
        waiting.numbers = 0;
        self.taken.notify_all();
        (std::mem::take(&mut waiting.batch), waiting.threads == 0)
    }
}

/// A thread leaves.
struct Leaving<'a>(&'a Ended);

impl Drop for Leaving<'_> {
    fn drop(&mut self) {
        self.0.lock().threads -= 1;
        self.0.ready.notify_one();
    }
}

/// The calling thread leaves.
struct Closing<'a>(&'a Ended, &'a AtomicBool);

impl Drop for Closing<'_> {
    fn drop(&mut self) {
        self.1.store(true, Ordering::Relaxed);
        self.0.lock().is_closed = true;
        self.0.taken.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome::Shape;
    use std::collections::BTreeSet;

    const EIGHT: &[Range<u64>] = &[0..4, 4..8];

    const SHAPE: Shape = Shape {
        state: 1,
        kept: 0,
        events: 0,
        samples: 0,
    };

    /// Trajectories of some milliseconds each; those from `stuck` on run until they are interrupted. A worker fills its places first, as
    /// that of [`crate::Routh`] does.
    struct Slow {
        stuck: u64,
        places: usize,
        threads: Mutex<BTreeSet<String>>,
    }

    struct Thread<'a>(&'a Slow, usize);

    impl Worker for Thread<'_> {
        fn work(
            &mut self,
            next: &dyn Fn() -> Option<u64>,
            done: &dyn Fn(u64, Outcome),
            interrupt: &AtomicBool,
        ) {
            loop {
                let taken: Vec<u64> = std::iter::from_fn(next).take(self.1).collect();
                if taken.is_empty() {
                    return;
                }
                let own = format!("{:?}", std::thread::current().id());
                self.0.threads.lock().unwrap().insert(own);
                for index in taken {
                    while index >= self.0.stuck && !interrupt.load(Ordering::Relaxed) {
                        std::thread::sleep(Duration::from_millis(1));
                    }
                    if index >= self.0.stuck {
                        return;
                    }
                    std::thread::sleep(Duration::from_millis(20));
                    done(index, Outcome::not_started(SHAPE, String::new()));
                }
            }
        }
    }

    impl Work for Slow {
        fn worker(&self, most: usize) -> Box<dyn Worker + '_> {
            Box::new(Thread(self, self.places.min(most)))
        }

        fn count(&self) -> u64 {
            1000
        }
    }

    fn slow(stuck: u64, places: usize) -> Slow {
        Slow {
            stuck,
            places,
            threads: Mutex::default(),
        }
    }

    #[test]
    fn few_trajectories_occupy_all_threads() {
        for count in [4, 8, 9] {
            let work = slow(1000, 4);
            let mut found = Vec::new();
            run(
                &work,
                (&[3..5, 7..5 + count], 4),
                &AtomicBool::new(false),
                |batch| {
                    found.extend(batch.iter().map(|(index, _)| *index));
                    ControlFlow::Continue(())
                },
            );
            found.sort_unstable();
            let wanted: Vec<u64> = (3..5).chain(7..5 + count).collect();
            assert_eq!(found, wanted);
            assert_eq!(work.threads.lock().unwrap().len(), 4, "{count}");
        }
    }

    #[test]
    fn what_has_ended_is_handed_over_while_others_are_under_way() {
        let interrupt = AtomicBool::new(false);
        let mut found = Vec::new();
        run(&slow(3, 1), (EIGHT, 2), &interrupt, |batch| {
            found.extend(batch.iter().map(|(index, _)| *index));
            interrupt.store(found.len() == 3, Ordering::Relaxed);
            ControlFlow::Continue(())
        });
        found.sort_unstable();
        assert_eq!(found, [0, 1, 2]);
    }

    #[test]
    fn a_sink_that_breaks_ends_what_is_under_way() {
        let nobody = AtomicBool::new(false);
        let mut batches = 0;
        run(&slow(1, 1), (EIGHT, 2), &nobody, |_| {
            batches += 1;
            ControlFlow::Break(())
        });
        assert_eq!(batches, 1);
    }
}

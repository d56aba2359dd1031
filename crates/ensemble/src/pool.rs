//! Blocks of trajectories on threads.
//!
//! Whoever is free takes the next block from a common counter, so that no thread waits while there are blocks. Finished
//! blocks go through a channel of bounded length to the calling thread, which gives them to the sink: when the sink is slow
//! the threads wait, and memory stays bounded.

use crate::outcome::Outcome;
use std::ops::{ControlFlow, Range};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::sync_channel;

/// A finished block.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Its number.
    pub number: u64,
    /// Its trajectories.
    pub range: Range<u64>,
    /// One for each, in order.
    pub outcomes: Vec<Outcome>,
}

/// Computes blocks, on one thread.
pub trait Worker {
    /// The outcomes of the trajectories of a range, in order; `None` when it was interrupted. What a trajectory gives depends
    /// on its number alone.
    fn block(&mut self, range: Range<u64>, interrupt: &AtomicBool) -> Option<Vec<Outcome>>;
}

/// An ensemble: makes a worker for each thread.
pub trait Work: Sync {
    /// A worker, made and used on the thread that calls.
    fn worker(&self) -> Box<dyn Worker + '_>;

    /// Number of trajectories.
    fn count(&self) -> u64;
}

/// Number of blocks of `size` trajectories.
pub fn blocks(count: u64, size: u64) -> u64 {
    count.div_ceil(size)
}

/// The trajectories of a block.
pub fn range(block: u64, count: u64, size: u64) -> Range<u64> {
    block * size..((block + 1) * size).min(count)
}

/// Computes `wanted` blocks of `size` trajectories on `threads` threads and gives them to `sink` as they are finished, in any
/// order, on the calling thread. Ends early when the sink breaks or `interrupt` becomes true; blocks that are not finished
/// then are lost.
pub fn run(
    work: &dyn Work,
    (size, wanted, threads): (u64, &[u64], usize),
    interrupt: &AtomicBool,
    mut sink: impl FnMut(Block) -> ControlFlow<()>,
) {
    let next = AtomicUsize::new(0);
    let ended = AtomicBool::new(false);
    let threads = threads.clamp(1, wanted.len().max(1));
    let (sender, receiver) = sync_channel::<Block>(threads);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            let sender = sender.clone();
            let (next, ended) = (&next, &ended);
            scope.spawn(move || {
                let mut worker = work.worker();
                while !ended.load(Ordering::Relaxed) && !interrupt.load(Ordering::Relaxed) {
                    let Some(&number) = wanted.get(next.fetch_add(1, Ordering::Relaxed)) else {
                        return;
                    };
                    let range = range(number, work.count(), size);
                    let Some(outcomes) = worker.block(range.clone(), interrupt) else {
                        return;
                    };
                    let block = Block {
                        number,
                        range,
                        outcomes,
                    };
                    // Nobody listens after a break.
                    if sender.send(block).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        for block in receiver.iter() {
            if sink(block).is_break() {
                ended.store(true, Ordering::Relaxed);
                break;
            }
        }
        // Threads that wait to send must learn that nobody listens.
        drop(receiver);
    });
}

//! Many motions of one system: thousands of starts and values of parameters.
//!
//! ```text
//! Members ──Routh──▶ Worker, one for each thread ──pool──▶ blocks of outcomes, in any order ──▶ sink
//!                                                          Columns ──▶ bytes ──▶ journal, archive
//! ```
//!
//! The trajectories are numbered and cut into blocks of one size. [`pool::run`] hands blocks to threads and finished blocks
//! to a sink; at most a few are in memory. What a trajectory gives depends on nothing but itself: not on the block, the
//! thread or the trajectories before it. [`columns`] turns blocks into bytes, [`journal`] tells which of them were written
//! before a process ended, [`archive`] makes one NumPy archive of them. Files, clocks and signals come from outside.

pub mod archive;
pub mod columns;
pub mod journal;
pub mod outcome;
pub mod pool;
pub mod routh;

pub use columns::{Column, Columns, Kind};
pub use journal::{Journal, Record};
pub use outcome::{Outcome, Seen, StopCode};
pub use pool::{Block, Work, Worker};
pub use routh::{Member, Members, Routh};

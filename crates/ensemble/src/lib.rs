//! Many motions of one system: thousands of starts and values of parameters.
//!
//! ```text
//! Members ──Routh──▶ Worker, one for each thread ──pool──▶ batches of outcomes, as they end ──▶ sink
//!                                                          Columns ──▶ bytes ──▶ journal, archive
//! ```
//!
//! The trajectories are numbered. [`pool::run`] hands them to threads, and those that have ended to a sink, in batches as they
//! come; at most a few are in memory. What a trajectory gives depends on nothing but itself: not on the batch, the
//! thread or the trajectories before it. [`columns`] turns batches into bytes, [`journal`] tells which of them were written
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
pub use pool::{Batch, Work, Worker};
pub use routh::{Member, Members, Routh};

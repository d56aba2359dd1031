//! Storage that machine code works in, as plain data: it exists, empty, where there is no machine code.
#![cfg_attr(not(all(unix, target_arch = "x86_64")), allow(dead_code))]

use crate::evaluate::PivotRange;
use crate::factor::range;
use crate::lanes::LANES;
use std::sync::Arc;

/// States that machine code takes at once where their numbers lie side by side, four by four.
pub(crate) const SIDE_BY_SIDE: usize = 4;

const LINE: usize = 8;
const HALF: usize = LINE / 2;

/// One cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Line([f64; LINE]);

/// Constants, spilled values and matrices of one run at a time.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    lines: Vec<Line>,
    /// Which machine code it belongs to.
    owner: u64,
}

impl Frame {
    pub(crate) fn new(bytes: usize, owner: u64) -> Frame {
        let lines = vec![Line([0.0; LINE]); bytes.div_ceil(8 * LINE)];
        Frame { lines, owner }
    }

    #[inline]
    pub(crate) fn owner(&self) -> u64 {
        self.owner
    }

    #[inline]
    pub(crate) fn lines(&mut self) -> &mut [Line] {
        &mut self.lines
    }

    /// The number at a byte.
    fn at(&self, offset: usize) -> f64 {
        self.lines[offset / 8 / LINE].0[offset / 8 % LINE]
    }

    /// Writes numbers from a byte on.
    pub(crate) fn write(&mut self, offset: i32, numbers: impl Iterator<Item = f64>) {
        for (i, number) in (offset as usize / 8..).zip(numbers) {
            self.lines[i / LINE].0[i % LINE] = number;
        }
    }
}

/// Where the pivots of a matrix are in a frame.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Pivots {
    /// Byte of the first.
    pub(crate) cells: i32,
    pub(crate) size: usize,
}

/// The frames of a workspace, and where to find pivots in them.
#[derive(Clone, Debug)]
pub(crate) struct Frames {
    /// One; of a block, one for each run, if what the prologue factorizes has to be kept for each.
    pub(crate) frames: Vec<Frame>,
    /// The bits of the states whose last evaluation was the interpreter's.
    pub(crate) interpreted: u32,
    /// By matrix; none for those of the prologue.
    pub(crate) pivots: Arc<[Option<Pivots>]>,
    /// States of a run.
    pub(crate) lanes: usize,
    /// Of a block: for each run the pivots of all matrices, which the next run overwrites in the frame.
    pub(crate) kept: Vec<f64>,
}

impl Frames {
    /// How many numbers are kept of each run.
    pub(crate) fn kept_per_run(pivots: &[Option<Pivots>], lanes: usize) -> usize {
        pivots.iter().flatten().map(|p| p.size).sum::<usize>() * lanes
    }

    /// The frame for one run of a block.
    #[inline]
    pub(crate) fn frame(&mut self, run: usize) -> Option<&mut Frame> {
        let count = self.frames.len();
        self.frames.get_mut(if count == 1 { 0 } else { run })
    }

    /// Keeps the pivots of a run of a block.
    #[inline]
    pub(crate) fn keep(&mut self, run: usize) {
        let count = self.kept.len() / (LANES / self.lanes);
        let frame = if self.frames.len() == 1 { 0 } else { run };
        let Some(frame) = self.frames.get(frame) else {
            return;
        };
        let mut kept = &mut self.kept[run * count..];
        for pivots in self.pivots.iter().flatten() {
            let (these, rest) = kept.split_at_mut(pivots.size * self.lanes);
            // Cells of four are halves of lines, and cells of eight are lines.
            let (to, _) = these.as_chunks_mut::<HALF>();
            let first = pivots.cells as usize / 8 / HALF;
            for (half, to) in (first..).zip(to) {
                let (halves, _) = frame.lines[half / 2].0.as_chunks::<HALF>();
                *to = halves[half % 2];
            }
            kept = rest;
        }
    }

    /// The pivots of a matrix in one state; none where the interpreter has them.
    pub(crate) fn pivots(&self, matrix: usize, state: usize) -> Option<PivotRange> {
        if self.interpreted >> state & 1 != 0 {
            return None;
        }
        let pivots = (*self.pivots.get(matrix)?)?;
        let (run, lane) = (state / self.lanes, state % self.lanes);
        if self.kept.is_empty() {
            let frame = self.frames.first()?;
            let at = |i: usize| frame.at(pivots.cells as usize + 8 * (i * self.lanes + lane));
            return Some(range((0..pivots.size).map(at)));
        }
        let before: usize = self.pivots[..matrix].iter().flatten().map(|p| p.size).sum();
        let start = run * Self::kept_per_run(&self.pivots, self.lanes) + before * self.lanes;
        let at = |i: usize| self.kept.get(start + i * self.lanes + lane);
        Some(range((0..pivots.size).filter_map(at).copied()))
    }
}

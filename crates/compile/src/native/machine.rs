//! Machine code of one program for one width.
#![allow(unsafe_code)] // Calls machine code through a pointer.

use super::assembler::Width;
use super::code::{Base, Code};
use super::emit;
use super::memory::Pages;
use super::registers;
use super::translate::{self, Translated};
use crate::frames::{Frame, Frames, Pivots, SIDE_BY_SIDE};
use crate::lanes::{Lanes, LANES};
use crate::program::Program;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::Arc;

/// Frame, variables, register file of the prologue, outputs, and how many groups; the lanes without a result.
type Entry = unsafe extern "sysv64" fn(*mut f64, *const f64, *const f64, *mut f64, u64) -> u64;

/// The body of a program as machine code.
#[derive(Debug)]
pub(crate) struct Machine {
    pages: Pages,
    width: Width,
    /// Tells its frames from those of others.
    id: u64,
    initial: Vec<(i32, u64, usize)>,
    /// Bytes of a frame.
    frame: usize,
    pivots: Arc<[Option<Pivots>]>,
    copied: Vec<(usize, i32)>,
    /// How many numbers are read of the slices given.
    variables: usize,
    file: usize,
    /// By number of groups: how many numbers they write.
    outputs: Vec<usize>,
    bytes: usize,
}

/// What a run reads and writes, from the first number of its first state on.
pub(crate) struct Data<'a> {
    pub(crate) variables: &'a [f64],
    pub(crate) file: &'a [f64],
    pub(crate) outputs: &'a mut [f64],
}

static MACHINES: AtomicU64 = AtomicU64::new(0);

impl Machine {
    /// Compiles the body; `None` where code cannot be made or placed, or this processor cannot run it.
    pub(crate) fn new(program: &Program, width: Width) -> Option<Machine> {
        Machine::with_stride(program, width, translate::stride(width))
    }

    /// The same for four states whose numbers lie side by side, one [`Four`] after the other.
    pub(crate) fn of_four(program: &Program) -> Option<Machine> {
        Machine::with_stride(program, Width::Four, size_of::<Four>() as i32)
    }

    fn with_stride(program: &Program, width: Width, bytes: i32) -> Option<Machine> {
        if !super::can_run(width) {
            return None;
        }
        let Translated {
            code,
            pivots,
            copied,
        } = translate::translate(program, width, bytes);
        let stride = bytes as usize / 8;
        let reach = |count: usize| match count {
            0 => 0,
            _ => (count - 1) * stride + width.lanes(),
        };
        let outputs = (0..=program.outputs.len()).map(|g| reach(program.output_count_of(g)));
        let homes = code.values.iter().filter_map(|info| info.home);
        let file = homes.filter(|place| place.base == Base::File);
        let file = file.map(|place| place.offset as usize / 8 + width.lanes());
        let file = file.max().unwrap_or(0);
        let (variables, outputs) = (reach(program.layout.variables), outputs.collect());
        let machine = Machine::place(code, width, (variables, file, outputs))?;
        Some(Machine {
            pivots: pivots.into(),
            copied,
            ..machine
        })
    }

    /// Straight-line code with one group, which reads and writes so many numbers of the file and of the outputs, and no
    /// variables; `None` as for [`Machine::new`].
    pub(crate) fn of_code(
        code: Code,
        width: Width,
        file: usize,
        outputs: usize,
    ) -> Option<Machine> {
        if !super::can_run(width) {
            return None;
        }
        Machine::place(code, width, (0, file, vec![0, outputs]))
    }

    /// Assigns registers, writes the bytes and makes them executable; how many numbers of variables and file are read, and by
    /// number of groups how many outputs are written.
    fn place(
        code: Code,
        width: Width,
        (variables, file, outputs): (usize, usize, Vec<usize>),
    ) -> Option<Machine> {
        let allocated = registers::allocate(&code, width);
        let bytes = emit::emit(&allocated.steps, width)?;
        Some(Machine {
            pages: Pages::new(&bytes)?,
            width,
            id: MACHINES.fetch_add(1, Ordering::Relaxed),
            initial: code.initial,
            // One number more, for instructions that read sixteen bytes at the last.
            frame: allocated.frame as usize + 8,
            pivots: Arc::default(),
            copied: Vec::new(),
            variables,
            file,
            outputs,
            bytes: bytes.len(),
        })
    }

    /// Frames with the constants in them.
    pub(crate) fn frames(&self) -> Frames {
        let mut frame = Frame::new(self.frame, self.id);
        for &(offset, bits, copies) in &self.initial {
            frame.write(offset, std::iter::repeat_n(f64::from_bits(bits), copies));
        }
        let lanes = self.width.lanes();
        let runs = match self.width {
            Width::One => 1,
            Width::Four | Width::Eight => LANES / lanes,
        };
        let count = if self.copied.is_empty() { 1 } else { runs };
        let kept = if runs == 1 {
            0
        } else {
            runs * Frames::kept_per_run(&self.pivots, lanes)
        };
        Frames {
            frames: vec![frame; count],
            interpreted: 0,
            pivots: self.pivots.clone(),
            lanes,
            kept: vec![f64::NAN; kept],
        }
    }

    /// Matrices of the prologue whose factors a frame has to have: index, and the byte from which they are.
    pub(crate) fn copied(&self) -> &[(usize, i32)] {
        &self.copied
    }

    /// How many states it takes at once.
    pub(crate) fn lanes(&self) -> usize {
        self.width.lanes()
    }

    /// Length of the code.
    pub(crate) fn bytes(&self) -> usize {
        self.bytes
    }

    /// Computes the first `groups` groups; the bits of the result are the lanes without one. `None` if a slice is
    /// too short, the frame is not of this code, or there are no such groups.
    #[inline]
    pub(crate) fn run(&self, frame: &mut Frame, groups: usize, data: Data<'_>) -> Option<u64> {
        let fits = frame.owner() == self.id
            && data.variables.len() >= self.variables
            && data.file.len() >= self.file
            && data.outputs.len() >= *self.outputs.get(groups)?;
        if !fits || groups == 0 {
            return None;
        }
        // SAFETY: the pages hold a function of this type, as `emit` writes it.
        let entry: Entry = unsafe { std::mem::transmute(self.pages.start()) };
        // SAFETY: the frame was made by this machine, and the code stays within its bytes; it reads variables and
        // file and writes outputs within the numbers compared above; and this processor has the instructions used,
        // or there would be no machine.
        Some(unsafe {
            entry(
                frame.lines().as_mut_ptr().cast(),
                data.variables.as_ptr(),
                data.file.as_ptr(),
                data.outputs.as_mut_ptr(),
                groups as u64,
            )
        })
    }
}

/// A number of each of four states.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(32))]
pub(crate) struct Four(pub(crate) [f64; SIDE_BY_SIDE]);

/// The numbers of all states, one after the other.
pub(crate) fn flat(fours: &[Four]) -> &[f64] {
    // SAFETY: `Four` is an array of that many numbers, whose size is a multiple of its alignment.
    unsafe { std::slice::from_raw_parts(fours.as_ptr().cast(), fours.len() * SIDE_BY_SIDE) }
}

/// The numbers of all states, one after the other.
pub(crate) fn flat_mut(fours: &mut [Four]) -> &mut [f64] {
    // SAFETY: as above, and the borrow is passed on.
    unsafe { std::slice::from_raw_parts_mut(fours.as_mut_ptr().cast(), fours.len() * SIDE_BY_SIDE) }
}

/// The numbers of lanes, one after the other.
pub(crate) fn numbers(lanes: &[Lanes]) -> &[f64] {
    // SAFETY: `Lanes` is an array of that many numbers, whose size is a multiple of its alignment.
    unsafe { std::slice::from_raw_parts(lanes.as_ptr().cast(), lanes.len() * LANES) }
}

/// The numbers of lanes, one after the other.
pub(crate) fn numbers_mut(lanes: &mut [Lanes]) -> &mut [f64] {
    // SAFETY: as above, and the borrow is passed on.
    unsafe { std::slice::from_raw_parts_mut(lanes.as_mut_ptr().cast(), lanes.len() * LANES) }
}

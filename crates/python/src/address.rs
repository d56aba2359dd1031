//! Compiled functions for callers that know C only: one address for all of them, and data that say which is meant.
#![allow(unsafe_code)] // States and values come as pointers.

use crate::program::{Program, Ready};
use numpy::ndarray::Array1;
use numpy::PyArray1;
use pyo3::prelude::*;
use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, LazyLock, Mutex, PoisonError, RwLock};

/// The functions by their numbers; of those that live no more, how many values they had.
static KNOWN: LazyLock<RwLock<HashMap<u64, Known>>> = LazyLock::new(RwLock::default);
/// The number of the next one. Doubles hold all that are reached.
static NEXT: AtomicU64 = AtomicU64::new(1);

/// What a number stands for.
enum Known {
    Living(Arc<Room>),
    Dead(usize),
}

/// A function, and storage for it with the parameters that it is prepared for.
struct Room {
    program: Arc<Program>,
    count: usize,
    free: Mutex<Vec<(Vec<f64>, Ready)>>,
}

/// The way to a function, as long as this lives.
pub(crate) struct Door {
    number: u64,
    size: usize,
}

impl Door {
    /// A way to a function of so many parameters.
    pub(crate) fn new(program: Arc<Program>, parameters: &[f64]) -> Door {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let size = program.size();
        let room = Room {
            program,
            count: parameters.len(),
            free: Mutex::default(),
        };
        let mut known = KNOWN.write().unwrap_or_else(PoisonError::into_inner);
        known.insert(number, Known::Living(Arc::new(room)));
        Door { number, size }
    }

    /// Where the function in C is.
    pub(crate) fn address(&self) -> usize {
        let called: unsafe extern "C" fn(f64, *const f64, *mut f64, *const f64) = called;
        called as usize
    }
}

/// What is handed over as the last argument: the number of a function, then its parameters. An array lends the memory, and keeps this and so the
/// way to the function.
#[pyclass(frozen)]
pub(crate) struct Data {
    numbers: Array1<f64>,
    _door: Arc<Door>,
}

impl Data {
    /// The array that callers hand over.
    ///
    /// # Errors
    /// There is no memory.
    pub(crate) fn array<'py>(
        py: Python<'py>,
        door: Arc<Door>,
        parameters: &[f64],
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let number = std::iter::once(door.number as f64);
        let own = Data {
            numbers: number.chain(parameters.iter().copied()).collect(),
            _door: door,
        };
        let own = Bound::new(py, own)?;
        let kept = own.clone().into_any();
        // SAFETY: The array keeps its owner, whose numbers stay where they are and are neither read nor written here.
        Ok(unsafe { PyArray1::borrow_from_array(&own.get().numbers, kept) })
    }
}

impl Drop for Door {
    fn drop(&mut self) {
        let mut known = KNOWN.write().unwrap_or_else(PoisonError::into_inner);
        known.insert(self.number, Known::Dead(self.size));
    }
}

impl Room {
    /// The values at a state, not a number where the parameters have none.
    fn values(&self, t: f64, y: &[f64], parameters: &[f64], values: &mut [f64]) {
        let free = || self.free.lock().unwrap_or_else(PoisonError::into_inner);
        let known = free().pop();
        let known = known.filter(|(own, _)| own == parameters);
        let known = known.or_else(|| {
            let ready = self.program.ready(parameters).ok()?;
            Some((parameters.to_vec(), ready))
        });
        match known {
            Some((own, mut ready)) => {
                values.copy_from_slice(self.program.at(&mut ready, t, y.iter().copied()));
                free().push((own, ready));
            }
            None => values.fill(f64::NAN),
        }
    }
}

/// The values of the function that `data` names at the time t and the state y; not a number where it lives no more, and nothing where no function
/// had this number.
///
/// # Safety
/// `data` are those of a [`Data`], `y` and `values` have as many numbers as the state and the values of its function.
unsafe extern "C" fn called(t: f64, y: *const f64, values: *mut f64, data: *const f64) {
    if y.is_null() || values.is_null() || data.is_null() {
        return;
    }
    // SAFETY: `data` begins with the number.
    let number = unsafe { *data } as u64;
    let known = KNOWN.read().unwrap_or_else(PoisonError::into_inner);
    let room = match known.get(&number) {
        Some(Known::Living(room)) => room.clone(),
        Some(Known::Dead(size)) => {
            // SAFETY: the caller hands over as many values as the function had.
            unsafe { std::slice::from_raw_parts_mut(values, *size) }.fill(f64::NAN);
            return;
        }
        None => return,
    };
    drop(known);
    // SAFETY: the caller hands over arrays of these lengths.
    let (parameters, y, values) = unsafe {
        (
            std::slice::from_raw_parts(data.add(1), room.count),
            std::slice::from_raw_parts(y, room.program.width()),
            std::slice::from_raw_parts_mut(values, room.program.size()),
        )
    };
    room.values(t, y, parameters, values);
}

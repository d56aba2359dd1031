//! Compiled functions for callers that know C only: one address for all of them, and data that say which is meant.
#![allow(unsafe_code)] // States and values come as pointers.

use crate::program::{Program, Ready};
use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, LazyLock, Mutex, PoisonError, RwLock};

/// The functions that live, by their numbers.
static LIVING: LazyLock<RwLock<HashMap<u64, Arc<Room>>>> = LazyLock::new(RwLock::default);
/// The number of the next one. Doubles hold all that are reached.
static NEXT: AtomicU64 = AtomicU64::new(1);

/// A function, and storage for it with the parameters that it is prepared for.
struct Room {
    program: Arc<Program>,
    count: usize,
    free: Mutex<Vec<(Vec<f64>, Ready)>>,
}

/// The way to a function, as long as this lives.
pub(crate) struct Door {
    number: u64,
}

impl Door {
    /// A way to a function of so many parameters.
    pub(crate) fn new(program: Arc<Program>, parameters: &[f64]) -> Door {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let room = Room {
            program,
            count: parameters.len(),
            free: Mutex::default(),
        };
        let mut living = LIVING.write().unwrap_or_else(PoisonError::into_inner);
        living.insert(number, Arc::new(room));
        Door { number }
    }

    /// Where the function in C is.
    pub(crate) fn address(&self) -> usize {
        let called: unsafe extern "C" fn(f64, *const f64, *mut f64, *const f64) = called;
        called as usize
    }

    /// What is handed over as its last argument.
    pub(crate) fn data(&self, parameters: &[f64]) -> Vec<f64> {
        let mut data = vec![self.number as f64];
        data.extend(parameters);
        data
    }
}

impl Drop for Door {
    fn drop(&mut self) {
        let mut living = LIVING.write().unwrap_or_else(PoisonError::into_inner);
        living.remove(&self.number);
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

/// The values of the function that `data` names at the time t and the state y; nothing where it lives no more.
///
/// # Safety
/// `data` are those of a [`Door`], `y` and `values` have as many numbers as the state and the values of its function.
unsafe extern "C" fn called(t: f64, y: *const f64, values: *mut f64, data: *const f64) {
    if y.is_null() || values.is_null() || data.is_null() {
        return;
    }
    // SAFETY: `data` begins with the number.
    let number = unsafe { *data } as u64;
    let living = LIVING.read().unwrap_or_else(PoisonError::into_inner);
    let room = living.get(&number).cloned();
    drop(living);
    let Some(room) = room else {
        return;
    };
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

//! Independent parts of a search, on all processors.

use chetaev_symbolic::meter;
use std::sync::atomic::{AtomicUsize, Ordering};

/// `part(0)`, `part(1)`, … in this order, each computed by whichever thread is free; what they are does not depend on their number. One
/// thread where there are no others, as in a browser.
pub(super) fn in_parallel<T: Send>(count: usize, part: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let workers = workers.min(count);
    if workers < 2 {
        return (0..count).map(part).collect();
    }
    let next = AtomicUsize::new(0);
    let own_work = meter::current();
    let work = || {
        let places = std::iter::from_fn(|| Some(next.fetch_add(1, Ordering::Relaxed)));
        let own = places.take_while(|&place| place < count);
        own.map(|place| (place, part(place))).collect::<Vec<_>>()
    };
    let mut found = std::thread::scope(|scope| {
        let others: Vec<_> = (1..workers)
            .map(|_| scope.spawn(|| meter::helping(own_work.clone(), work)))
            .collect();
        let mut found = work();
        for other in others {
            match other.join() {
                Ok(own) => found.extend(own),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        found
    });
    found.sort_by_key(|(place, _)| *place);
    found.into_iter().map(|(_, part)| part).collect()
}

//! Independent parts of a computation, on all processors.

use crate::meter;
use std::sync::atomic::{AtomicUsize, Ordering};

/// `part(0)`, `part(1)`, … in this order, each computed by whichever thread is free; what they are does not depend on their number. One
/// thread where there are no others, as in a browser.
pub fn in_parallel<T: Send>(count: usize, part: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    on_threads(workers, count, part, &mut |_| {})
}

/// The same on so many threads; `tell` hears on the calling thread how many parts have been begun.
pub fn on_threads<T: Send>(
    threads: usize,
    count: usize,
    part: impl Fn(usize) -> T + Sync,
    tell: &mut dyn FnMut(usize),
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let take = || Some(next.fetch_add(1, Ordering::Relaxed)).filter(|&place| place < count);
    let own_work = meter::current();
    let work = || {
        let places = std::iter::from_fn(take);
        places.map(|place| (place, part(place))).collect::<Vec<_>>()
    };
    let mut here = || {
        let places = std::iter::from_fn(take);
        let told = places.inspect(|&place| tell(place));
        told.map(|place| (place, part(place))).collect::<Vec<_>>()
    };
    if threads.min(count) < 2 {
        return here().into_iter().map(|(_, part)| part).collect();
    }
    let mut found = std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads.min(count))
            .map(|_| scope.spawn(|| meter::helping(own_work.clone(), work)))
            .collect();
        let mut found = here();
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

#[cfg(test)]
mod tests {
    use super::on_threads;

    #[test]
    fn parts_come_in_their_order_and_are_told() {
        for threads in [1, 2, 5] {
            let mut told = Vec::new();
            let found = on_threads(threads, 40, |i| i * i, &mut |place| told.push(place));
            assert_eq!(found, (0..40).map(|i| i * i).collect::<Vec<_>>());
            assert!(told.is_sorted() && told.len() <= 40, "{told:?}");
        }
        assert!(on_threads(3, 0, |i| i, &mut |_| {}).is_empty());
    }
}

//! Words that a message must contain.

/// Entries of `wanted` that do not occur in `text`, in any case of letters; `a|b` means one of them.
pub fn missing<'w>(text: &str, wanted: impl IntoIterator<Item = &'w str>) -> Vec<String> {
    let text = text.to_lowercase();
    wanted
        .into_iter()
        .filter(|entry| {
            !entry
                .split('|')
                .any(|word| text.contains(&word.to_lowercase()))
        })
        .map(str::to_owned)
        .collect()
}

/// Nothing failed.
///
/// # Panics
/// With all failures.
pub fn none(failures: Vec<String>) {
    assert!(
        failures.is_empty(),
        "{} failures\n{}",
        failures.len(),
        failures.join("\n")
    );
}

/// Runs `work` on every item, on as many threads as there are cores, and returns the results in order.
pub fn in_parallel<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let next = std::sync::atomic::AtomicUsize::new(0);
    let threads = std::thread::available_parallelism().map_or(2, usize::from);
    let worker = || {
        let mut done = Vec::new();
        loop {
            let i = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            match items.get(i) {
                Some(item) => done.push((i, work(item))),
                None => break done,
            }
        }
    };
    let mut all: Vec<(usize, R)> = std::thread::scope(|scope| {
        let handles: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        handles
            .into_iter()
            .flat_map(|handle| match handle.join() {
                Ok(done) => done,
                Err(panic) => std::panic::resume_unwind(panic),
            })
            .collect()
    });
    all.sort_by_key(|(i, _)| *i);
    all.into_iter().map(|(_, result)| result).collect()
}

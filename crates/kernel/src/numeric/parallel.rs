//! One function of many values, on all processors where there is more than one value and a thread can be started.

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::OnceLock;

/// The function of every item, in the order of the items; the results do not depend on the number of threads.
pub fn map<T: Sync, R: Send>(items: &[T], function: impl Fn(&T) -> R + Sync + Send) -> Vec<R> {
    let pool = if items.len() < 2 { None } else { threads() };
    map_on(pool, items, function)
}

fn map_on<T: Sync, R: Send>(
    pool: Option<&ThreadPool>,
    items: &[T],
    function: impl Fn(&T) -> R + Sync + Send,
) -> Vec<R> {
    match pool {
        Some(pool) => pool.install(|| items.par_iter().map(function).collect()),
        None => items.iter().map(function).collect(),
    }
}

/// The results of two functions, at the same time where there is a second one and a thread can be started.
pub fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: Option<impl FnOnce() -> B + Send>,
) -> (A, Option<B>) {
    match second {
        None => (first(), None),
        Some(second) => match threads() {
            Some(pool) => {
                let (a, b) = pool.install(|| rayon::join(first, second));
                (a, Some(b))
            }
            None => (first(), Some(second())),
        },
    }
}

/// The threads, started at the first use: as many as there are processors, or as `RAYON_NUM_THREADS` says. `None` where the
/// system cannot start threads; rayon's own pool would end the program there.
fn threads() -> Option<&'static ThreadPool> {
    static POOL: OnceLock<Option<ThreadPool>> = OnceLock::new();
    POOL.get_or_init(|| ThreadPoolBuilder::new().build().ok()).as_ref()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_is_kept_with_threads_and_without() {
        let items: Vec<u32> = (0..1000).collect();
        let expected: Vec<u32> = items.iter().map(|item| item * 3).collect();
        let pool = ThreadPoolBuilder::new().num_threads(3).build().expect("threads");
        for pool in [Some(&pool), None] {
            assert_eq!(map_on(pool, &items, |item| item * 3), expected);
        }
        assert_eq!(map(&items, |item| item * 3), expected);
        assert_eq!(both(|| 1, Some(|| 2)), (1, Some(2)));
        assert_eq!(both(|| 1, None::<fn() -> u8>), (1, None));
    }
}

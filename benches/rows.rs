//! What the curves near and through rows cost by themselves: `cargo bench --bench rows`. The smoothing of 3600 rows is to take at most 50 ms.

#![allow(clippy::expect_used, missing_docs, reason = "a benchmark fails loudly")]

use camgen::numeric::bounded_jerk::{monotonic, smoothed};
use camgen::numeric::least_jerk::{NodeInterval, least_jerk};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

/// Rise, dwell and fall by 3-4-5 over a ring, rounded to a step, as intervals.
fn ring(count: u32, step: f64) -> Vec<NodeInterval> {
    let law = |x: f64| x * x * x * (10.0 - 15.0 * x + 6.0 * x * x);
    let lift = |x: f64| match x {
        x if x < 0.3 => law(x / 0.3),
        x if x < 0.4 => 1.0,
        x if x < 0.7 => law((0.7 - x) / 0.3),
        _ => 0.0,
    };
    let row = |at: u32| (10.0 * lift(f64::from(at % count) / f64::from(count)) / step).round() * step;
    (0..count).map(|at| Some((1.0 / f64::from(count), row(at + 1) - row(at)))).collect()
}

fn curves(criterion: &mut Criterion) {
    for count in [360, 900, 1800, 3600, 7200, 14400] {
        for step in [1e-2, 1e-3] {
            let ring = ring(count, step);
            let free = vec![[None; 3]; ring.len()];
            let id = format!("smoothing/{count} rows rounded to {step} of 10");
            criterion.bench_function(&id, |b| b.iter(|| smoothed(black_box(&ring), &free, 0.5 * step)));
        }
        let ring = ring(count, 1e-9);
        let free = vec![[None; 3]; ring.len()];
        criterion.bench_function(&format!("monotonic/{count} rows"), |b| b.iter(|| monotonic(black_box(&ring), &free)));
        let free = vec![[None; 2]; ring.len()];
        criterion.bench_function(&format!("natural/{count} rows"), |b| b.iter(|| least_jerk(black_box(&ring), &free)));
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = curves
}
criterion_main!(benches);

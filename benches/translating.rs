//! What equation (18) and the plate cost: `cargo bench --bench translating`.

#![allow(clippy::expect_used, missing_docs, reason = "a benchmark fails loudly")]

use camgen::body::{Body, Request};
use camgen::domains::press::motion::equation_18::{ExactOn, Mechanism, Solution, Solver, Stations};
use camgen::domains::press::wedge::{LAW_TOLERANCE, Wedge};
use camgen::machine::Machine;
use camgen::table::Table;
use camgen::verify::rolling;
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

fn plate(column: &str) -> Wedge {
    let machine = Machine::load("dpi", &[format!("buffer.column={column}")]).expect("embedded").0;
    Wedge::solve(&machine, 35.0, Solver::Ode { tolerance: LAW_TOLERANCE }, ExactOn::Braking).expect("a plate")
}

fn equation(criterion: &mut Criterion) {
    for column in ["matched", "return"] {
        let mechanism: Mechanism = *plate(column).mechanism();
        for (name, tolerance) in [("1e-3", 1e-6), ("1e-6", 1e-9), ("1e-9", 1e-12), ("1e-12", 1e-15)] {
            let id = format!("(18) {column}/ode to {name} mm");
            criterion.bench_function(&id, |b| b.iter(|| Solution::new(black_box(&mechanism), tolerance)));
        }
        for stations in [18, 180, 1800, 18_000] {
            let id = format!("(18) {column}/paper, {stations} stations");
            criterion.bench_function(&id, |b| b.iter(|| Stations::new(black_box(&mechanism), stations)));
        }
        let free = Mechanism { friction_angle: 0.0, efficiency: 1.0, ..mechanism };
        let id = format!("(18) {column}/ode to 1e-9 mm without friction and loss");
        criterion.bench_function(&id, |b| b.iter(|| Solution::new(black_box(&free), 1e-12)));
    }
}

fn stages(criterion: &mut Criterion) {
    let plate = plate("matched");
    criterion.bench_function("plate/outline 5 um", |b| b.iter(|| black_box(&plate).draw(&Request::within(5e-6))));
    let drawn = plate.draw(&Request::within(5e-6)).expect("an outline");
    let contour = &drawn.parts[0].outline.contour;
    criterion.bench_function("plate/rolling", |b| {
        b.iter(|| rolling::roll(black_box(&plate), (plate.curves(), &[false, true]), contour, 0.005));
    });
    criterion.bench_function("plate/table", |b| b.iter(|| Table::from_rows(&black_box(&plate).rows(720))));
}

criterion_group!(benches, equation, stages);
criterion_main!(benches);

//! What a conoid costs, stage by stage: `cargo bench --bench conoid`.

#![allow(clippy::expect_used, missing_docs, reason = "a benchmark fails loudly")]

use camgen::body::{Body, Request};
use camgen::domains::press::conoid::between::{self, residual};
use camgen::domains::press::conoid::{Conoid, Interpolation, flank};
use camgen::geometry::solid::flank_solid;
use camgen::machine::Machine;
use camgen::profile::outline::MotionTolerance;
use camgen::table::Table;
use camgen::verify::{self, Evidence};
use camgen::write::{step, stl};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

fn stages(criterion: &mut Criterion) {
    let machine = Machine::load("dpi", &[]).expect("embedded").0;
    for count in [4, 9] {
        let speeds: Vec<f64> = (0..count).map(|i| 20.0 + 15.0 * f64::from(i) / f64::from(count - 1)).collect();
        let name = |stage: &str| format!("conoid of {count}/{stage}");
        criterion.bench_function(&name("solve"), |b| b.iter(|| Conoid::solve(&machine, black_box(&speeds))));
        let conoid = Conoid::solve(&machine, &speeds).expect("a conoid");
        criterion.bench_function(&name("cut, a point"), |b| b.iter(|| conoid.cut(0, black_box(-0.1), 0.05)));
        criterion.bench_function(&name("between"), |b| b.iter(|| residual(black_box(&conoid), Interpolation::Smooth)));
        criterion
            .bench_function(&name("sections 5 um"), |b| b.iter(|| black_box(&conoid).draw(&Request::within(5e-6))));
        criterion.bench_function(&name("flank 5 um"), |b| b.iter(|| flank::flank(black_box(&conoid), 0.005)));
        let drawn = flank::flank(&conoid, 0.005).expect("a flank");
        let request = Request { flank: true, ..Request::within(5e-6) };
        let whole = conoid.draw(&request).expect("sections and a flank");
        let evidence =
            Evidence { drawn: Some(&whole), ..Evidence::without_files(&conoid, 0.005, MotionTolerance::ANY) };
        criterion
            .bench_function(&name("checks, sphere on the flank"), |b| b.iter(|| verify::run(black_box(&evidence))));
        let solid = flank_solid(&drawn.patches, &[], (0.0, 120.0), drawn.volume).expect("a solid");
        criterion.bench_function(&name("step"), |b| b.iter(|| step::write(black_box(&solid), "conoid", None)));
        criterion.bench_function(&name("stl"), |b| b.iter(|| stl::write(black_box(&drawn), Some(25.0), "cam")));
        criterion.bench_function(&name("table"), |b| b.iter(|| Table::from_rows(&black_box(&conoid).rows(720))));
    }
    criterion.bench_function("conoid/fewest sections for 2 N", |b| {
        b.iter(|| between::fewest(black_box(&machine), 20.0, 35.0, 2.0));
    });
}

criterion_group!(benches, stages);
criterion_main!(benches);

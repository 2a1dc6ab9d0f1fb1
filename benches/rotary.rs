//! What a rotary cam costs, stage by stage: `cargo bench`.

#![allow(clippy::expect_used, missing_docs, reason = "a benchmark fails loudly")]

use camgen::cam::rotary::Rotary;
use camgen::checks::{self, Subject};
use camgen::drawing;
use camgen::law::Law;
use camgen::machine::Machine;
use camgen::output::{csv, dxf, svg};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

fn dpi() -> Rotary {
    let machine = Machine::load("dpi", &[]).expect("embedded").0;
    Rotary::solve(&machine, 35.0).expect("a cam")
}

fn law(criterion: &mut Criterion) {
    let cam = dpi();
    let balance = *cam.balance();
    criterion.bench_function("law/displacement", |b| b.iter(|| balance.displacement(black_box(0.07))));
    let (piece, angle) = cam.disc.law.locate(1.0);
    criterion.bench_function("law/jet", |b| b.iter(|| cam.disc.law.jet(piece, black_box(angle))));
    criterion.bench_function("cam/profile point", |b| b.iter(|| cam.disc.profile(piece, black_box(angle))));
}

fn stages(criterion: &mut Criterion) {
    let machine = Machine::load("dpi", &[]).expect("embedded").0;
    criterion.bench_function("machine/load", |b| b.iter(|| Machine::load(black_box("dpi"), &[])));
    criterion.bench_function("cam/solve", |b| b.iter(|| Rotary::solve(black_box(&machine), 35.0)));
    let cam = dpi();
    for tolerance in [1e-4, 5e-6, 1e-6, 5e-8] {
        let id = format!("drawing/outline {tolerance:e} m");
        criterion.bench_function(&id, |b| b.iter(|| drawing::part(black_box(&cam), tolerance)));
    }
    let part = drawing::part(&cam, 5e-6).expect("an outline");
    let subject = Subject { rotary: &cam, outline: Some(&part.outline.contour) };
    criterion.bench_function("checks", |b| b.iter(|| checks::run(black_box(&subject))));
    let report = drawing::report(&cam, Some(&part), 5e-6, checks::run(&subject));
    let sheet = drawing::sheet(&cam, &part, &report).expect("a sheet");
    let entities = part.entities();
    criterion.bench_function("output/dxf", |b| b.iter(|| dxf::write(black_box(&entities), dxf::Version::R2000)));
    criterion.bench_function("drawing/sheet", |b| b.iter(|| drawing::sheet(black_box(&cam), &part, &report)));
    criterion.bench_function("output/svg", |b| b.iter(|| svg::write(black_box(&sheet), svg::TEMPLATE)));
    criterion.bench_function("drawing/table", |b| b.iter(|| drawing::table(black_box(&cam), 720)));
    let table = drawing::table(&cam, 720);
    criterion.bench_function("output/csv", |b| b.iter(|| csv::write(black_box(&table))));
}

criterion_group!(benches, law, stages);
criterion_main!(benches);

//! What a rotary cam costs, stage by stage: `cargo bench`.

#![allow(clippy::expect_used, missing_docs, reason = "a benchmark fails loudly")]

use camgen::body::disc::Disc;
use camgen::drawing::{self};
use camgen::geometry::contour::{Contour, Vertex};
use camgen::geometry::solid::solid;
use camgen::machine::Machine;
use camgen::motion::Motion;
use camgen::reading;
use camgen::verify::{self, Subject, file, rolling};
use camgen::write::dxf::{self, Version};
use camgen::write::{csv, proof, step, svg};
use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::Vector2;
use std::hint::black_box;

fn dpi() -> Disc {
    let machine = Machine::load("dpi", &[]).expect("embedded").0;
    Disc::solve(&machine, 35.0).expect("a cam")
}

fn law(criterion: &mut Criterion) {
    let cam = dpi();
    let balance = *cam.balance();
    criterion.bench_function("law/displacement", |b| b.iter(|| balance.displacement(black_box(0.07))));
    let (piece, angle) = cam.curves.law.locate(1.0);
    criterion.bench_function("law/jet", |b| b.iter(|| cam.curves.law.jet(piece, black_box(angle))));
    criterion.bench_function("cam/profile point", |b| b.iter(|| cam.curves.profile(piece, black_box(angle))));
}

fn stages(criterion: &mut Criterion) {
    let machine = Machine::load("dpi", &[]).expect("embedded").0;
    criterion.bench_function("machine/load", |b| b.iter(|| Machine::load(black_box("dpi"), &[])));
    criterion.bench_function("cam/solve", |b| b.iter(|| Disc::solve(black_box(&machine), 35.0)));
    let cam = dpi();
    for tolerance in [1e-4, 1e-5, 5e-6, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12] {
        let id = format!("drawing/outline {tolerance:e} m");
        criterion.bench_function(&id, |b| b.iter(|| drawing::part(black_box(&cam), tolerance)));
    }
    let part = drawing::part(&cam, 5e-6).expect("an outline");
    criterion
        .bench_function("output/write and read back", |b| b.iter(|| proof::write(black_box(&part), Version::R2000)));
    let written = proof::write(&part, Version::R2000).expect("one outline");
    let rolled = rolling::roll(&cam, &written.outline, 0.005);
    criterion.bench_function("checks/rolling", |b| b.iter(|| rolling::roll(&cam, black_box(&written.outline), 0.005)));
    let subject = Subject {
        cam: &cam,
        outline: Some(&written.outline),
        rolled: Some(&rolled),
        balancing: None,
        tolerance_mm: 0.005,
    };
    criterion.bench_function("checks", |b| b.iter(|| checks::run(black_box(&subject))));
    let report = drawing::report(&cam, Some(&part), Some(rolled.clone()), 5e-6, checks::run(&subject));
    let sheet = drawing::sheet::disc(&cam, &part, &report).expect("a sheet");
    let entities = part.entities();
    criterion.bench_function("output/dxf", |b| b.iter(|| dxf::write(black_box(&entities), dxf::Version::R2000)));
    criterion.bench_function("drawing/sheet", |b| b.iter(|| drawing::sheet::disc(black_box(&cam), &part, &report)));
    criterion.bench_function("output/svg", |b| b.iter(|| svg::write(black_box(&sheet), svg::TEMPLATE)));
    criterion.bench_function("drawing/table", |b| b.iter(|| drawing::table(black_box(&cam), 720)));
    let points = drawing::table(&cam, 10_000).rows;
    let chords = points.iter().map(|row| Vertex { point: Vector2::new(row[10], row[11]), bulge: 0.0 }).collect();
    let chords = [(drawing::Layer::CamProfile, drawing::Entity::Polyline(Contour { vertices: chords }))];
    let chords = dxf::write(&chords, Version::R2000);
    criterion.bench_function("check/10 000 segments", |b| {
        b.iter(|| file::check(&cam, &reading::read(black_box(&chords), 5e-4).expect("read"), 0.005));
    });
    criterion.bench_function("drawing/solid", |b| b.iter(|| solid(black_box(&part), 30.0)));
    let body = solid(&part, 30.0).expect("a solid");
    criterion.bench_function("output/step", |b| b.iter(|| step::write(black_box(&body), "cam")));
    let table = drawing::table(&cam, 720);
    criterion.bench_function("output/csv", |b| b.iter(|| csv::write(black_box(&table))));
}

criterion_group!(benches, law, stages);
criterion_main!(benches);

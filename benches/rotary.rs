//! What a rotary cam costs, stage by stage: `cargo bench`.

#![allow(clippy::expect_used, missing_docs, reason = "a benchmark fails loudly")]

use camgen::body::disc::Disc;
use camgen::body::{Body, Layer, Request};
use camgen::domains::press::MachineOfPress;
use camgen::domains::press::SpecOfPress;
use camgen::domains::press::rotary;
use camgen::geometry::Entity;
use camgen::geometry::contour::{Contour, Vertex};
use camgen::machine::Machine;
use camgen::motion::laws::{LAWS, LawTask};
use camgen::pipeline::Spec;
use camgen::profile::outline::MotionTolerance;
use camgen::table::Table;
use camgen::tool_files::dxf::{self, Version, proof};
use camgen::verify::{self, Evidence, rolling};
use camgen::write::{csv, step, svg};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

fn dpi() -> Disc {
    let machine = Machine::load("dpi", &[]).expect("embedded").0;
    rotary::disc(&machine, 35.0).expect("a cam")
}

fn motion(criterion: &mut Criterion) {
    let cam = dpi();
    let bottom_law = cam.machine().press().expect("a press").bottom_law(35.0);
    criterion.bench_function("law/displacement", |b| b.iter(|| bottom_law.displacement(black_box(0.07))));
    let curves = cam.curves();
    let (piece, angle) = curves.motion.locate(1.0);
    criterion.bench_function("law/jet", |b| b.iter(|| curves.motion.jet(piece, black_box(angle))));
    for law in LAWS.iter().filter(|law| law.serves_rests()) {
        let curve = law.solve(&LawTask::default()).expect("it serves rests");
        let at = |x: f64| curve.values_at(curve.part_of(x), x);
        criterion.bench_function(&format!("law/{}", law.name), |b| b.iter(|| at(black_box(0.37))));
    }
    criterion.bench_function("cam/profile point", |b| b.iter(|| curves.profile(piece, black_box(angle))));
}

fn stages(criterion: &mut Criterion) {
    let machine = Machine::load("dpi", &[]).expect("embedded").0;
    criterion.bench_function("machine/load", |b| b.iter(|| Machine::load(black_box("dpi"), &[])));
    criterion.bench_function("cam/solve", |b| b.iter(|| rotary::disc(black_box(&machine), 35.0)));
    let cam = dpi();
    for tolerance in [1e-4, 1e-5, 5e-6, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12] {
        let id = format!("drawing/outline {tolerance:e} m");
        criterion.bench_function(&id, |b| b.iter(|| black_box(&cam).draw(&Request::within(tolerance))));
    }
    let drawn = cam.draw(&Request::within(5e-6)).expect("an outline");
    let part = &drawn.parts[0];
    criterion
        .bench_function("output/write and read back", |b| b.iter(|| proof::write(black_box(part), Version::R2000)));
    let written = proof::write(part, Version::R2000).expect("one outline");
    let roll = |outline: &Contour| rolling::roll(&cam, (cam.curves(), &[false]), outline, 0.005);
    let rolled = [roll(&written.outlines[0])];
    criterion.bench_function("checks/rolling", |b| b.iter(|| roll(black_box(&written.outlines[0]))));
    let outlines =
        [verify::WrittenOutline { cut: 0, z: 0.0, contour: written.outlines[0].clone(), others: written.others }];
    let evidence = Evidence {
        drawn: Some(&drawn),
        outlines: &outlines,
        rolled: &rolled,
        ..Evidence::without_files(&cam, 0.005, MotionTolerance::ANY)
    };
    criterion.bench_function("checks", |b| b.iter(|| verify::run(black_box(&evidence))));
    let solved = Spec::rotary(machine, 35.0).solve().expect("a cam");
    let proven = solved.draw(5e-6).expect("an outline").prove().expect("one outline");
    let report = proven.lazy_report();
    let rendering = proven.rendering(&report, 720, svg::TEMPLATE).expect("an outline");
    let sheet = svg::drawing(&rendering, "1/2").expect("a sheet");
    let entities = part.entities();
    criterion.bench_function("output/dxf", |b| b.iter(|| dxf::write(black_box(&entities), Version::R2000)));
    criterion.bench_function("drawing/sheet", |b| b.iter(|| svg::drawing(black_box(&rendering), "1/2")));
    criterion.bench_function("output/svg", |b| b.iter(|| svg::write(black_box(&sheet), svg::TEMPLATE)));
    criterion.bench_function("drawing/table", |b| b.iter(|| Table::from_rows(&black_box(&cam).rows(720))));
    let points = cam.rows(10_000);
    let chords = points.iter().map(|row| Vertex::new(row.profile.expect("a profile"), 0.0)).collect();
    let chords = [(Layer::CamProfile, Entity::Polyline(Contour { vertices: chords }))];
    let chords = dxf::write(&chords, Version::R2000);
    criterion.bench_function("check/10 000 segments", |b| b.iter(|| solved.check(black_box(&chords), 5e-6)));
    criterion.bench_function("drawing/solid", |b| b.iter(|| black_box(part).solid(30.0)));
    let body = part.solid(30.0).expect("a solid");
    criterion.bench_function("output/step", |b| b.iter(|| step::write(black_box(&body), "cam", None)));
    let table = proven.table(720);
    criterion.bench_function("output/csv", |b| {
        b.iter(|| csv::write(black_box(&table), camgen::units::LengthUnit::Millimetre));
    });
}

criterion_group!(benches, motion, stages);
criterion_main!(benches);

//! camgen's offset and arcs beside those of `cavalier_contours` and kurbo, on the same pitch curve at the same true error:
//! `cargo bench --bench peers`. The table of true errors and counts is printed first. `benches/peers/` has the Python peers.

#![allow(clippy::expect_used, clippy::print_stdout, missing_docs, reason = "a benchmark fails loudly and prints")]

use camgen::body::disc::Disc;
use camgen::domains::press::rotary;
use camgen::geometry::CurvePoint;
use camgen::geometry::contour::{Contour, Vertex};
use camgen::geometry::edge_tree::EdgeTree;
use camgen::machine::Machine;
use camgen::profile::outline::{self, pitch_within};
use cavalier_contours::polyline::{PlineSource, PlineSourceMut, PlineVertex, Polyline};
use criterion::{Criterion, criterion_group, criterion_main};
use kurbo::offset::offset_cubic;
use kurbo::{BezPath, CubicBez, ParamCurve, Point};
use nalgebra::Vector2;
use std::hint::black_box;

const TOLERANCES: [f64; 3] = [10e-6, 5e-6, 1e-6];
/// Points of the exact profile at which a peer's offset is measured.
const PLACES: u32 = 4000;

fn dpi() -> Disc {
    let machine = Machine::load("dpi", &[]).expect("embedded").0;
    rotary::disc(&machine, 35.0).expect("a cam")
}

/// The pitch curve as arcs within a tolerance (m), for `cavalier_contours`.
fn pitch_arcs(cam: &Disc, tolerance: f64) -> Polyline<f64> {
    let mut line = Polyline::new_closed();
    for vertex in pitch_within(cam.curves(), tolerance).expect("arcs").contour.vertices {
        line.add_vertex(PlineVertex::new(vertex.point.x, vertex.point.y, vertex.bulge().expect("an arc")));
    }
    line
}

fn as_contour(line: &Polyline<f64>) -> Contour {
    let vertex = |v: PlineVertex<f64>| Vertex::new(Vector2::new(v.x, v.y), v.bulge);
    Contour { vertices: line.iter_vertexes().map(vertex).collect() }
}

/// The pitch curve as cubics through its points and tangents, `spans` to a piece, mm, for kurbo.
fn pitch_cubics(cam: &Disc, spans: u32) -> Vec<CubicBez> {
    let point = |v: Vector2<f64>| Point::new(v.x, v.y);
    let of_piece = |(index, piece): (usize, &camgen::motion::Piece)| {
        let step = (piece.end - piece.start) / f64::from(spans);
        let frame = |i: u32| cam.curves().contact(index, piece.start + step * f64::from(i)).curve.scaled(1e3);
        let cubic = |i: u32| {
            let (a, b) = (frame(i), frame(i + 1));
            let third = step / 3.0;
            let (first, second) = (a.point + a.tangent * (a.speed * third), b.point - b.tangent * (b.speed * third));
            CubicBez::new(point(a.point), point(first), point(second), point(b.point))
        };
        (0..spans).map(cubic).collect::<Vec<_>>()
    };
    cam.curves().motion.pieces().iter().enumerate().flat_map(of_piece).collect()
}

fn kurbo_offset(cubics: &[CubicBez], distance: f64, tolerance: f64) -> Vec<BezPath> {
    let offset = |cubic: &CubicBez| {
        let mut path = BezPath::new();
        offset_cubic(*cubic, distance, tolerance, &mut path);
        path
    };
    cubics.iter().map(offset).collect()
}

/// Largest distance of the exact profile from an outline, mm.
fn true_error(cam: &Disc, outline: &Contour) -> f64 {
    let track = EdgeTree::new(outline);
    let place = |i: u32| {
        let (piece, angle) = cam.curves().motion.locate(std::f64::consts::TAU * f64::from(i) / f64::from(PLACES));
        let exact = cam.curves().profile(piece, angle).point * 1e3;
        track.nearest(exact).map_or(f64::INFINITY, |nearest| nearest.left.abs())
    };
    (0..PLACES).map(place).fold(0.0, f64::max)
}

/// A path as chords so fine that they do not matter, 1e-4 of a segment.
fn flattened(paths: &[BezPath]) -> Contour {
    let mut vertices = Vec::new();
    for segment in paths.iter().flat_map(BezPath::segments) {
        for i in 0..100 {
            let p = segment.eval(f64::from(i) / 100.0);
            vertices.push(Vertex::new(Vector2::new(p.x, p.y), 0.0));
        }
    }
    Contour { vertices }
}

fn offsets(criterion: &mut Criterion) {
    let cam = dpi();
    println!("{:>8} {:>28} {:>12} {:>14}", "tol/µm", "offset by", "segments", "true error/µm");
    for tolerance in TOLERANCES {
        let name = format!("{:.0} µm", 1e6 * tolerance);
        let own = outline::profile(cam.curves(), tolerance).expect("an outline");
        let tell = |what: &str, count: usize, error: f64| {
            println!("{:>8} {what:>28} {count:>12} {:>14.4}", 1e6 * tolerance, 1e3 * error);
        };
        tell("camgen, arcs", own.contour.vertices.len(), true_error(&cam, &own.contour));
        let arcs = pitch_arcs(&cam, tolerance);
        let moved = arcs.parallel_offset(30.0);
        let first = moved.first().expect("an offset");
        tell("cavalier_contours, arcs", first.vertex_count(), true_error(&cam, &as_contour(first)));
        // As few spans as reach the tolerance; finding them is not timed.
        let with = |spans: u32| kurbo_offset(&pitch_cubics(&cam, spans), 30.0, 0.5e3 * tolerance);
        let reaches = |spans: &u32| true_error(&cam, &flattened(&with(*spans))) <= 1e3 * tolerance;
        let spans = (6..100).find(reaches).expect("enough spans");
        let moved = with(spans);
        tell(
            "kurbo, cubics (no arcs)",
            moved.iter().map(|path| path.segments().count()).sum(),
            true_error(&cam, &flattened(&moved)),
        );

        criterion.bench_function(&format!("peers/{name}/camgen: exact offset and its arcs"), |b| {
            b.iter(|| outline::profile(black_box(cam.curves()), tolerance));
        });
        criterion.bench_function(&format!("peers/{name}/cavalier_contours: offset of given arcs"), |b| {
            b.iter(|| black_box(&arcs).parallel_offset(30.0));
        });
        criterion.bench_function(&format!("peers/{name}/cavalier_contours: arcs of the pitch curve and offset"), |b| {
            b.iter(|| pitch_arcs(black_box(&cam), tolerance).parallel_offset(30.0));
        });
        criterion.bench_function(&format!("peers/{name}/kurbo: cubics and offset"), |b| {
            b.iter(|| kurbo_offset(&pitch_cubics(black_box(&cam), spans), 30.0, 0.5e3 * tolerance));
        });
    }
}

/// The offset alone, of points of the pitch curve that are given, at the numbers of points of a fine table.
fn points(criterion: &mut Criterion) {
    let cam = dpi();
    for many in [3600_u32, 36_000] {
        let place = |i: u32| cam.curves().motion.locate(std::f64::consts::TAU * f64::from(i) / f64::from(many));
        let pitch: Vec<CurvePoint> =
            (0..many).map(place).map(|(piece, angle)| cam.curves().contact(piece, angle).curve).collect();
        let mut line = Polyline::new_closed();
        for frame in &pitch {
            line.add_vertex(PlineVertex::new(1e3 * frame.point.x, 1e3 * frame.point.y, 0.0));
        }
        criterion.bench_function(&format!("peers/{many} points/camgen: offset of given pitch points"), |b| {
            b.iter(|| black_box(&pitch).iter().map(|frame| frame.offset_inward(0.03).point).collect::<Vec<_>>());
        });
        criterion.bench_function(&format!("peers/{many} points/cavalier_contours: offset of given chords"), |b| {
            b.iter(|| black_box(&line).parallel_offset(30.0));
        });
        criterion.bench_function(&format!("peers/{many} points/camgen: law, pitch curve and offset"), |b| {
            let exact = |(piece, angle)| cam.curves().profile(piece, angle).point;
            b.iter(|| (0..many).map(place).map(exact).collect::<Vec<_>>());
        });
    }
}

criterion_group!(benches, offsets, points);
criterion_main!(benches);

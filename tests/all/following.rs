//! Right chains of every kind are followed: whatever the lengths of their segments, their rounding, their gaps and their starts.

use crate::common::random::Random;
use camgen::body::Layer;
use camgen::domains::press::SpecOfPress;
use camgen::domains::press::motion::equation_18::{ExactOn, Solver};
use camgen::geometry::boundary::Boundary;
use camgen::geometry::contour::{Contour, Vertex};
use camgen::geometry::following::follow;
use camgen::geometry::{CurvePoint, Entity};
use camgen::machine::Machine;
use camgen::pipeline::{Cam, Spec};
use camgen::report::Verdict;
use camgen::tool_files::dxf::{self, Version};
use nalgebra::Vector2;

fn machine(overrides: &[&str]) -> Machine {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    Machine::load("dpi", &overrides).expect("valid").0
}

fn plate() -> Cam {
    Spec::translating(machine(&[]), 35.0, SOLVER, ExactOn::Braking).solve().expect("a plate")
}

fn cams() -> Vec<Cam> {
    let rotary = |overrides: &[&str]| Spec::rotary(machine(overrides), 35.0).solve().expect("a cam");
    let blend = ["transition.kind=blend", "transition.width=30deg"];
    vec![rotary(&[]), rotary(&["cam.rotation=ccw", "follower.roller.offset=15mm"]), rotary(&blend), plate()]
}

/// How the places of a chain lie along a stretch.
#[derive(Debug, Clone, Copy)]
enum Spread {
    Even,
    Random,
    /// Beside each place another nearer than this, mm.
    Pairs(f64, f64),
}

/// Places on the exact outline: as many between two borders of stretches as asked, with the borders or without them.
fn places(boundary: &Boundary<'_>, count: u32, spread: Spread, borders: bool, draw: &mut Random) -> Vec<CurvePoint> {
    let mut found = Vec::new();
    for (index, stretch) in boundary.stretches().iter().enumerate() {
        let mut shares = Vec::new();
        let length = (stretch.to - stretch.from) * boundary.ends(index).expect("a stretch")[0].speed;
        for step in 1..=count {
            let phase = if matches!(spread, Spread::Random) { draw.next() } else { 0.5 };
            let share = (f64::from(step) - phase) / f64::from(count);
            shares.push(share);
            if let Spread::Pairs(least, most) = spread {
                shares.push(share + draw.log_between(least, most) / length);
            }
        }
        shares.retain(|share| *share < 1.0);
        if borders || boundary.starts_at_corner(index) {
            found.push(boundary.ends(index).expect("a stretch")[0]);
        }
        found.extend(
            shares
                .iter()
                .filter_map(|share| boundary.point_at(index, stretch.from + share * (stretch.to - stretch.from))),
        );
        if boundary.starts_at_corner(index + 1) {
            found.push(boundary.ends(index).expect("a stretch")[1]);
        }
    }
    found
}

/// A chain through places, arcs by their headings or lines; at a corner there are two places, of which one is written.
fn chain(places: &[CurvePoint], arcs: bool) -> Vec<Vertex> {
    let next = places.iter().skip(1).chain(places.first());
    let vertex = |(here, next): (&CurvePoint, &CurvePoint)| {
        let turn = libm::atan2(here.tangent.perp(&next.tangent), here.tangent.dot(&next.tangent));
        let distinct = (next.point - here.point).norm() > 1e-12;
        distinct.then(|| Vertex::new(here.point, if arcs { libm::tan(0.25 * turn) } else { 0.0 }))
    };
    places.iter().zip(next).filter_map(vertex).collect()
}

/// The chain from another of its vertices on.
fn started(mut vertices: Vec<Vertex>, draw: &mut Random) -> Vec<Vertex> {
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "an index"
    )]
    let first = (draw.next() * vertices.len() as f64) as usize;
    vertices.rotate_left(first);
    vertices
}

#[test]
fn right_chains_of_every_kind_are_followed() {
    let mut draw = Random(29);
    let round = |value: f64, decimals: i32| (value * 10_f64.powi(decimals)).round() / 10_f64.powi(decimals);
    for (number, cam) in cams().iter().enumerate() {
        let boundary = cam.body().boundary(&cam.body().cuts()[0]).expect("an envelope").expect("a profile");
        let stretches = u32::try_from(boundary.stretches().len()).expect("few");
        let spreads = [
            (Spread::Even, 12),
            (Spread::Random, 12),
            (Spread::Pairs(1e-9, 1e-8), 13),
            (Spread::Pairs(1e-8, 1e-6), 12),
            (Spread::Pairs(1e-6, 1e-5), 12),
            (Spread::Pairs(1e-5, 1e-4), 9),
            (Spread::Pairs(4e-6, 1e-4), 6),
            (Spread::Even, 6),
            (Spread::Even, 5),
        ];
        for (spread, decimals) in spreads {
            // The whole chain of as many segments once for each cam.
            let most = if matches!((spread, decimals), (Spread::Even, 12)) { 50_000 } else { 8000 };
            for count in [4, 5, 9, 40, most / stretches] {
                for (arcs, borders) in [(true, true), (true, false), (false, true), (false, false)] {
                    let mut vertices = chain(&places(&boundary, count, spread, borders, &mut draw), arcs);
                    // An arc of hardly any curvature where a line would do, as programs write it.
                    let noise = if draw.next() < 0.3 { 1e-13 } else { 0.0 };
                    // Ends joined within a tenth of a tolerance of 5 µm, where the segments are long.
                    let gap = if count < 10 && matches!(spread, Spread::Even) { 2.5e-4 } else { 0.0 };
                    for vertex in &mut vertices {
                        let away = Vector2::new(draw.between(-gap, gap), draw.between(-gap, gap));
                        vertex.point = (vertex.point + away).map(|value| round(value, decimals));
                        let bulge = vertex.bulge().expect("an arc") + draw.between(-noise, noise);
                        *vertex = Vertex::new(vertex.point, bulge);
                    }
                    let vertices = started(vertices, &mut draw);
                    let name = format!("cam {number}, {spread:?}, {decimals} decimals, {count}, {arcs}, {borders}");
                    let longest = vertices.iter().zip(vertices.iter().skip(1));
                    let longest = longest.map(|(a, b)| (b.point - a.point).norm()).fold(0.0, f64::max);
                    let contour = Contour { vertices };
                    let found = follow(&contour, &boundary).unwrap_or_else(|lost| panic!("{name}: {lost:?}"));
                    // A chord sags by its square over eight radii; no radius here is below 30 mm, of chord or of profile.
                    let sag = longest * longest / (8.0 * 15.0) + 2.0 * gap + 10_f64.powi(-decimals) + 1e-9;
                    assert!(found.distance <= sag, "{name}: {found:?}, not {sag}");
                }
            }
        }
    }
}

const SOLVER: Solver = Solver::Ode { tolerance: 1e-12 };

/// A tooth on the straight end of a plate is a kink, although the corners of that end are intended.
#[test]
fn a_tooth_on_the_end_of_a_plate_is_a_kink() {
    let cam = plate();
    let drawing = cam.draw(5e-6).expect("drawn");
    let vertices = drawing.prove().expect("proved").outlines()[0].contour.vertices.clone();
    let check = |vertices: Vec<Vertex>| {
        let entity = Entity::Polyline(Contour { vertices });
        let report = cam.check(&dxf::write(&[(Layer::CamProfile, entity)], Version::R2000), 5e-6).expect("read");
        let finding = report.checks.iter().find(|finding| finding.check == "tangency").expect("tangency");
        (finding.verdict, finding.value)
    };
    assert_eq!(check(vertices.clone()).0, Verdict::Pass);
    let count = vertices.len();
    let upright = |i: &usize| {
        let along = vertices[(i + 1) % count].point - vertices[*i].point;
        along.x.abs() < 1e-9 && along.y.abs() > 1.0
    };
    let ends: Vec<usize> = (0..count).filter(upright).collect();
    assert_eq!(ends.len(), 2, "two straight ends");
    for end in ends {
        // 3 µm over 5 µm: 31° at its foot.
        let (from, to) = (vertices[end].point, vertices[(end + 1) % count].point);
        let (middle, along) = (0.5 * (from + to), (to - from).normalize());
        let out = Vector2::new(along.y, -along.x);
        let at = |by: f64, off: f64| Vertex::new(middle + along * by + out * off, 0.0);
        let mut toothed = vertices.clone();
        toothed.splice(end..=end, [vertices[end], at(-0.005, 0.0), at(0.0, 0.003), at(0.005, 0.0)]);
        let (verdict, kink) = check(toothed);
        assert!(verdict == Verdict::Fail && (kink - 61.928).abs() < 0.01, "{kink}");
    }
}

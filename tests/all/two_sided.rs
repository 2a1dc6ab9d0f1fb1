//! Outlines that a roller does not feel, or that lie right only where somebody looks: told by the distance both ways.

use crate::common::random::Random;
use camgen::body::Layer;
use camgen::domains::press::SpecOfPress;
use camgen::geometry::contour::{Contour, Vertex};
use camgen::geometry::{CurvePoint, Entity};
use camgen::machine::Machine;
use camgen::pipeline::{Cam, Spec};
use camgen::report::{Finding, Report, Verdict};
use camgen::tool_files::dxf::{self, Version};
use nalgebra::Vector2;
use std::f64::consts::{PI, TAU};

fn cam(overrides: &[&str]) -> Cam {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let machine = Machine::load("dpi", &overrides).expect("valid").0;
    Spec::rotary(machine, 35.0).solve().expect("a cam")
}

/// The file of an outline with the bore of the default cam.
fn file(vertices: Vec<Vertex>) -> Vec<u8> {
    let outline = (Layer::CamProfile, Entity::Polyline(Contour { vertices }));
    dxf::write(&[outline, (Layer::Bore, Entity::Circle(Vector2::zeros(), 25.0))], Version::R2000)
}

fn written(cam: &Cam, tolerance: f64) -> Vec<Vertex> {
    let proven = cam.draw(tolerance).expect("drawn").prove().expect("proved");
    proven.outlines()[0].contour.vertices.clone()
}

fn found(report: &Report, check: &str) -> Finding {
    let finding = report.checks.iter().find(|finding| finding.check == check);
    finding.unwrap_or_else(|| panic!("no {check}: {:?}", report.checks)).clone()
}

fn outline(cam: &Cam, vertices: Vec<Vertex>, tolerance: f64) -> Finding {
    found(&cam.check(&file(vertices), tolerance).expect("a DXF file"), "outline")
}

/// The exact profile at a cam angle, mm.
fn exact(cam: &Cam, angle: f64) -> CurvePoint {
    let curves = camgen::body::curves(cam.body()).expect("a plane cam");
    let (piece, inside) = curves.motion.locate(angle);
    curves.profile(piece, inside).scaled(1e3)
}

/// A chain through the profile moved outwards by `away` (mm) of the cam angle: lines, or arcs by the headings of the profile.
fn chain(cam: &Cam, count: u32, arcs: bool, from: f64, away: impl Fn(f64) -> f64) -> Vec<Vertex> {
    let at = |i: u32| {
        let angle = from + TAU * f64::from(i) / f64::from(count);
        let curve = exact(cam, angle);
        (curve.point + curve.outward() * away(angle), curve.tangent)
    };
    let vertex = |i: u32| {
        let ((point, heading), (_, next)) = (at(i), at(i + 1));
        let turn = heading.perp(&next).atan2(heading.dot(&next));
        Vertex::new(point, if arcs { (0.25 * turn).tan() } else { 0.0 })
    };
    (0..count).map(vertex).collect()
}

/// A smooth hump of a height and width about a place.
fn hump(height: f64, at: f64, width: f64) -> impl Fn(f64) -> f64 {
    move |angle| {
        let away = (angle - at + PI).rem_euclid(TAU) - PI;
        if away.abs() < width { height * (0.5 * PI * away / width).cos().powi(2) } else { 0.0 }
    }
}

/// An outline with a slot so wide and deep (mm) in the middle of its longest arc, the dwell, and the radius of that arc, mm; `narrows` is
/// the width of its bottom over that of its mouth, 0 for a notch.
fn sawn(vertices: Vec<Vertex>, (width, depth, narrows): (f64, f64, f64)) -> (Vec<Vertex>, f64) {
    let longest = |a: &(usize, f64), b: &(usize, f64)| a.1.total_cmp(&b.1);
    let contour = Contour { vertices: vertices.clone() };
    let lengths = contour.edges().map(|edge| edge.length()).enumerate();
    let (dwell, _) = lengths.max_by(longest).expect("segments");
    let segment = contour.edges().nth(dwell).and_then(|edge| edge.segment()).expect("a segment");
    let (centre, radius, sweep) = (segment.centre(), segment.radius(), segment.sweep());
    let begin = (segment.start - centre).y.atan2((segment.start - centre).x);
    let polar = |angle: f64, r: f64| centre + Vector2::new(angle.cos(), angle.sin()) * r;
    let half = 0.5 * width / radius;
    let (left, right) = (begin + 0.5 * sweep - half, begin + 0.5 * sweep + half);
    let arc = |angle: f64| (0.25 * angle).tan();
    let (left_lip, right_lip) = (polar(left, radius), polar(right, radius));
    let out = Vector2::new((begin + 0.5 * sweep).cos(), (begin + 0.5 * sweep).sin());
    let (middle, reach) = (0.5 * (left_lip + right_lip) - out * depth, 0.5 * narrows * (right_lip - left_lip));
    let mut slot = vec![
        Vertex::new(segment.start, arc(left - begin)),
        Vertex::new(left_lip, 0.0),
        Vertex::new(middle - reach, 0.0),
        Vertex::new(middle + reach, 0.0),
        Vertex::new(right_lip, arc(begin + sweep - right)),
    ];
    slot.dedup_by(|next, before| next.point == before.point);
    let mut sawn = vertices;
    sawn.splice(dwell..=dwell, slot);
    (sawn, radius)
}

/// How far the roller of 30 mm hangs over a mouth so wide in a circle, mm: its distance from either lip in the middle, less its radius.
fn sag(width: f64, radius: f64) -> f64 {
    let half = 0.5 * width / radius;
    Vector2::new(radius + 30.0 - radius * half.cos(), radius * half.sin()).norm() - 30.0
}

/// Between the lips of a slot or a notch the roller hangs over, which no place along an edge shows: gap and slope are 0 at both.
#[test]
fn a_slot_into_which_a_roller_sags_is_felt() {
    let cam = cam(&[]);
    let whole = written(&cam, 5e-6);
    for slot in [(1.2, 175.0, 1.0), (1.2, 0.5, 1.0), (1.7, 0.5, 0.0), (4.0, 1.0, 0.0), (4.0, 1.0, 0.5)] {
        let (sawn, radius) = sawn(whole.clone(), slot);
        let report = cam.check(&file(sawn), 5e-6).expect("a DXF file");
        let rolling = found(&report, "rolling");
        let sag = sag(slot.0, radius);
        // The arc lies beside the exact circle by the rounding of its fit, a nanometre.
        assert!((rolling.value - sag).abs() < 1e-6, "{slot:?}: {sag} {rolling:?}");
        assert_eq!(rolling.verdict, Verdict::Fail);
    }
}

/// The deeper of two notches is found beside the other, whichever comes first.
#[test]
fn no_notch_hides_another() {
    let cam = cam(&[]);
    let whole = written(&cam, 5e-6);
    for (one, other) in [(4.0, 4.1), (4.1, 4.0), (3.0, 3.2), (3.2, 3.0), (1.9, 2.0), (2.0, 1.9), (6.0, 6.5), (6.5, 6.0)]
    {
        let (first, radius) = sawn(whole.clone(), (one, 1.0, 0.0));
        let (both, _) = sawn(first, (other, 1.0, 0.0));
        let rolling = found(&cam.check(&file(both), 5e-6).expect("a DXF file"), "rolling");
        let sag = sag(f64::max(one, other), radius);
        assert!((rolling.value - sag).abs() < 1e-6, "{one} {other}: {sag} {rolling:?}");
    }
}

/// A dwell of chords in an outline of many short arcs, each of which the roller meets in one place: a vertex, which is right.
#[test]
fn chords_on_a_dwell_are_felt_among_many_arcs() {
    let cam = cam(&[]);
    let curves = camgen::body::curves(cam.body()).expect("a plane cam");
    let longest =
        |a: &&camgen::motion::Piece, b: &&camgen::motion::Piece| (a.end - a.start).total_cmp(&(b.end - b.start));
    let rest = curves.motion.pieces().iter().filter(|piece| piece.dwell).max_by(longest).expect("a dwell");
    let (count, apart) = (4320, 32);
    let arcs = chain(&cam, count, true, rest.start + TAU / f64::from(count), |_| 0.0);
    let radius = arcs[0].point.norm();
    let on_dwell = arcs.iter().take_while(|vertex| (vertex.point.norm() - radius).abs() < 1e-9).count();
    let kept = on_dwell / apart;
    let chords = arcs.iter().step_by(apart).take(kept).map(|vertex| Vertex::new(vertex.point, 0.0));
    let whole: Vec<Vertex> = chords.chain(arcs.iter().skip(kept * apart).copied()).collect();
    assert!(kept > 5 && whole.len() > 2000, "{kept} {}", whole.len());
    let rolling = found(&cam.check(&file(whole), 5e-6).expect("a DXF file"), "rolling");
    let half = 0.5 * (arcs[0].point - arcs[apart].point).norm();
    let sagitta = radius - (radius * radius - half * half).sqrt();
    assert!((rolling.value - sagitta).abs() < 1e-6, "{sagitta} {rolling:?}");
    assert_eq!(rolling.verdict, Verdict::Fail);
}

/// A slot 0.7 mm wide through the shaft: the roller bridges its mouth.
#[test]
fn a_slot_is_no_cam_although_a_roller_does_not_feel_it() {
    let cam = cam(&[]);
    let (sawn, _) = sawn(written(&cam, 5e-6), (0.7, 175.0, 1.0));
    let report = cam.check(&file(sawn), 5e-6).expect("a DXF file");
    assert_eq!(found(&report, "rolling").verdict, Verdict::Pass, "the roller does not feel it");
    let finding = found(&report, "outline");
    assert_eq!(finding.verdict, Verdict::Fail, "{finding:?}");
    // The bottom of the slot lies 175 mm below one side of the dwell, nearer to the other side of the cam.
    assert!((20.0..175.0).contains(&finding.value), "{finding:?}");
    assert!(finding.note_words().contains("turns back"), "{finding:?}");
}

/// Whiskers, spurs, teeth and loops, out of the metal and into it.
#[test]
fn spurs_teeth_and_loops_are_told() {
    let cam = cam(&[]);
    let whole = chain(&cam, 1440, true, 0.0, |_| 0.0);
    assert_eq!(outline(&cam, whole.clone(), 5e-6).verdict, Verdict::Pass);
    for at in [3_usize, 270, 700, 1100, 1439] {
        let (here, next) = (whole[at], whole[(at + 1) % whole.len()]);
        let along = (next.point - here.point).normalize();
        let out = Vector2::new(along.y, -along.x);
        let v = |along_by: f64, out_by: f64| Vertex::new(here.point + along * along_by + out * out_by, 0.0);
        for (what, detour, least) in [
            ("whisker", vec![v(0.0, 0.0), v(0.0, 0.3), v(0.001, 0.0)], 0.299),
            ("spur inwards", vec![v(0.0, 0.0), v(0.05, -0.4), v(0.1, 0.0)], 0.39),
            ("tooth", vec![v(0.0, 0.0), v(0.02, 0.02), v(0.06, -0.02), v(0.08, 0.0)], 0.0199),
            ("loop", vec![v(0.0, 0.0), v(0.1, 0.02), v(0.05, 0.04), v(0.05, -0.02)], 0.039),
            ("step back", vec![v(0.0, 0.0), v(0.2, 0.0), v(0.1, 0.0)], 0.0),
        ] {
            let mut edited = whole.clone();
            edited.splice(at..=at, detour);
            let finding = outline(&cam, edited, 5e-6);
            assert_eq!(finding.verdict, Verdict::Fail, "{what} at {at}: {finding:?}");
            assert!(finding.value >= least && finding.value < least + 0.02, "{what} at {at}: {finding:?}");
        }
    }
}

/// A hump half as high again as the tolerance, for any number of segments and at any place: told as high as it is.
#[test]
fn a_hump_between_the_places_is_told() {
    for (overrides, tolerance_um, height_um) in
        [(vec![], 5.0, 7.5), (vec![], 0.5, 2.0), (vec!["cam.base_radius=200mm", "buffer.column=return"], 5.0, 40.0)]
    {
        let cam = cam(&overrides);
        for count in [120, 330, 721, 10_000] {
            for at in [270.25_f64, 0.1, 91.0, 137.77, 359.99] {
                for sign in [1.0, -1.0] {
                    let away = hump(sign * 1e-3 * height_um, at.to_radians(), 3.0 * TAU / f64::from(count));
                    let on_vertex = at.to_radians() - TAU;
                    let finding = outline(&cam, chain(&cam, count, true, on_vertex, away), 1e-6 * tolerance_um);
                    assert_eq!(finding.verdict, Verdict::Fail, "{count} {at} {sign}: {finding:?}");
                    // A vertex stands on its top, where a chain of arcs also bulges a little beyond or not.
                    assert!(finding.value > 1e-3 * height_um - 1e-9, "{count} {at} {sign}: {finding:?}");
                }
            }
        }
    }
}

/// Chains within the tolerance pass, whichever way they are written.
#[test]
fn right_outlines_pass_in_every_dress() {
    let cam = cam(&[]);
    let rounded = |vertices: Vec<Vertex>, decimals: i32| -> Vec<Vertex> {
        let unit = 10_f64.powi(decimals);
        let round = |value: f64| (value * unit).round() / unit;
        vertices.into_iter().map(|v| Vertex { point: v.point.map(round), ..v }).collect()
    };
    for count in [700, 2000, 9000, 50_000] {
        for arcs in [true, false] {
            for (from, decimals) in [(0.0, 12), (1.0, 6), (4.7, 5)] {
                let vertices = rounded(chain(&cam, count, arcs, from, |angle| 2e-3 * (3.0 * angle).sin()), decimals);
                let finding = outline(&cam, vertices, 5e-6);
                assert_eq!(finding.verdict, Verdict::Pass, "{count} {arcs} {from}: {finding:?}");
                // The chords of the dwell sag by R (2π/n)²/8.
                let sag = if arcs { 2e-5 } else { 185.0 * (TAU / f64::from(count)).powi(2) / 8.0 };
                assert!((finding.value - 2e-3).abs() < 1.5e-5 + sag, "{count} {arcs} {from}: {finding:?}");
            }
        }
    }
}

/// The distance of a point from the profile by brute force: chords of a thousandth of a degree, 4 nm from it at the most.
struct Dense(Vec<(f64, Vector2<f64>)>);

impl Dense {
    fn new(cam: &Cam) -> Self {
        let mut points: Vec<(f64, Vector2<f64>)> = (0..360_000)
            .map(|i| exact(cam, f64::from(i) * TAU / 360_000.0).point)
            .map(|point| (point.y.atan2(point.x), point))
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self(points)
    }

    fn distance(&self, point: Vector2<f64>) -> f64 {
        let (n, polar) = (self.0.len(), point.y.atan2(point.x));
        let nearest = self.0.partition_point(|(angle, _)| *angle < polar);
        let at = |i: usize| self.0[(i + n) % n].1;
        let chord = |i: usize| {
            let (a, b) = (at(i), at(i + 1));
            let share = ((point - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
            (point - a - (b - a) * share).norm()
        };
        (nearest + n - 60..nearest + n + 60).map(chord).fold(f64::INFINITY, f64::min)
    }
}

/// Random chains with humps, steps, waves and kinks: what is told is what a dense measurement finds.
#[test]
fn the_told_distance_is_that_of_a_dense_measurement() {
    let cam = cam(&[]);
    let dense = Dense::new(&cam);
    let mut draw = Random(13);
    for case in 0..60 {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below a thousand")]
        let count = draw.between(40.0, 940.0) as u32;
        let (height, at, width) = (0.02 * draw.next() - 0.01, TAU * draw.next(), 0.01 + 0.2 * draw.next());
        let (wave, waves) = (0.004 * draw.next(), 1.0 + 60.0 * draw.next());
        let local = hump(height, at, width);
        let step = 0.003 * draw.next();
        let away = |angle: f64| local(angle) + wave * (waves * angle).sin() + if angle > at { step } else { 0.0 };
        let vertices = chain(&cam, count, case % 3 != 0, 0.0, away);
        let contour = Contour { vertices: vertices.clone() };
        let points =
            contour.edges().flat_map(|edge| (0..200).map(move |i| edge.point_and_tangent(f64::from(i) / 200.0).0));
        let most = points.map(|point| dense.distance(point)).fold(0.0, f64::max);
        let finding = outline(&cam, vertices, 5e-6);
        // 200 places of a segment miss a maximum by d'' h²/8: less than a thousandth of what it rises.
        assert!(finding.value > most - 5e-6 && finding.value < most * 1.001 + 1e-5, "case {case}: {most} {finding:?}");
    }
}

/// Largest gap and lift error are those of the roller put at 60 000 places.
#[test]
fn rolling_tells_its_maxima() {
    use camgen::geometry::edge_tree::EdgeTree;
    for (overrides, tolerance) in [(vec![], 5e-6), (vec!["follower.roller.offset=20mm"], 5e-5), (vec![], 5e-8)] {
        let cam = cam(&overrides);
        let proven = cam.draw(tolerance).expect("drawn").prove().expect("proved");
        let rolled = proven.rolled().expect("rolled");
        let track = EdgeTree::new(&proven.outlines()[0].contour);
        let curves = camgen::body::curves(cam.body()).expect("plane");
        let (mut gap, mut lift) = (0.0_f64, 0.0_f64);
        for i in 0..60_000 {
            let (piece, angle) = curves.motion.locate(f64::from(i) * TAU / 60_000.0);
            let touch = curves.touch(piece, angle);
            let centre = touch.curve.point * 1e3;
            let clear = |moved: f64| -track.nearest(centre + touch.drive * moved).expect("finite").left - 30.0;
            gap = gap.max(clear(0.0).abs());
            let cosine = touch.drive.dot(&touch.curve.outward());
            let mut moved = 0.0;
            for _ in 0..4 {
                moved -= clear(moved) / cosine;
            }
            lift = lift.max(moved.abs());
        }
        let told = rolled.lift_error_max_mm.expect("it touches");
        // Between two of 60 000 places a maximum rises by (h/l)², an arc l being 80 times as long as their step h at the least.
        assert!((-1e-9..2e-4 * gap).contains(&(rolled.gap_mm.abs() - gap)), "{overrides:?}: {rolled:?} {gap}");
        assert!((-1e-9..2e-4 * lift).contains(&(told - lift)), "{overrides:?}: {rolled:?} {lift}");
    }
}

/// Under a flat face the largest gap is that of the face put at 60 000 places against the outline's own support.
#[test]
fn rolling_tells_the_maximum_of_a_face() {
    let machine = Machine::load("valve", &[]).expect("valid").0;
    let cam = Spec::of_program(machine, None).expect("a program").solve().expect("a cam");
    for tolerance in [5e-5, 5e-6] {
        let proven = cam.draw(tolerance).expect("drawn").prove().expect("proved");
        let rolled = proven.rolled().expect("rolled");
        let segments = proven.outlines()[0].contour.segments().expect("arcs and lines");
        let support = |normal: Vector2<f64>| {
            let of_each = segments.iter().map(|segment| {
                let ends = segment.start.dot(&normal).max(segment.end.dot(&normal));
                let first = segment.start_tangent();
                let outward = Vector2::new(first.y, -first.x);
                let turn = libm::atan2(outward.perp(&normal), outward.dot(&normal));
                if segment.bulge > 0.0 && (0.0..=segment.sweep()).contains(&turn.rem_euclid(TAU)) {
                    segment.centre().dot(&normal) + segment.radius()
                } else {
                    ends
                }
            });
            of_each.fold(f64::NEG_INFINITY, f64::max)
        };
        let curves = camgen::body::curves(cam.body()).expect("plane");
        let gap = (0..60_000).map(|i| {
            let (piece, angle) = curves.motion.locate(f64::from(i) * TAU / 60_000.0);
            let curve = curves.touch(piece, angle).curve;
            let outward = curve.outward();
            let drawn =
                if cam.body().cuts()[0].mirrored == [true] { Vector2::new(outward.x, -outward.y) } else { outward };
            ((curve.point * 1e3).dot(&outward) - support(drawn)).abs()
        });
        let gap = gap.fold(0.0, f64::max);
        assert!((-1e-10..2e-4 * gap).contains(&(rolled.gap_mm.abs() - gap)), "{tolerance}: {} {gap}", rolled.gap_mm);
    }
}

/// Taken for inches the outline runs near the centres of curvature of the exact one, where no distance can be bounded: the
/// search ends all the same.
#[test]
fn outline_scaled_to_inches_fails() {
    let overrides = ["cam.rotation=ccw", "follower.roller.offset=15mm", "buffer.column=return"];
    let cam = cam(&overrides);
    for tolerance in [5e-6, 50e-9] {
        let mut vertices = written(&cam, tolerance);
        for vertex in &mut vertices {
            vertex.point /= 25.4;
        }
        let report = cam.check(&file(vertices), tolerance).expect("it reads");
        assert_eq!(found(&report, "outline").verdict, Verdict::Fail);
    }
}

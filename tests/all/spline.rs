//! Outlines of cubic splines: proved from their written bytes as arcs are, and read exactly from files of any program.

use camgen::body::Request;
use camgen::domains::press::SpecOfPress;
use camgen::domains::press::motion::equation_18::{ExactOn, Solver};
use camgen::geometry::contour::{Contour, Edge};
use camgen::geometry::cubics::{self, CurveRun, runs};
use camgen::geometry::following::follow;
use camgen::geometry::{ChainTolerance, CurvePoint, MILLIMETRES};
use camgen::machine::Machine;
use camgen::pipeline::{Cam, Spec};
use camgen::profile::outline::{Fit, SegmentKind, Side};
use camgen::reading;
use camgen::report::Verdict;
use camgen::tool_files::dxf::Version;
use camgen::tool_files::dxf::proof;
use nalgebra::Vector2;

fn machine(overrides: &[&str]) -> Machine {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    Machine::load("dpi", &overrides).expect("valid").0
}

fn rotary(overrides: &[&str]) -> Cam {
    Spec::rotary(machine(overrides), 35.0).solve().expect("a cam")
}

fn splines(tolerance: f64, side: Side) -> Request {
    Request::within(Fit { side, laid: SegmentKind::Splines, ..Fit::from(tolerance) })
}

/// The outline of the first part, and the verdicts.
fn proved(cam: &Cam, request: Request, name: &str) -> (Contour, f64) {
    let proven = cam.draw(request).expect("drawn").prove().expect("proved");
    for finding in proven.findings() {
        assert!(!matches!(finding.verdict, Verdict::Fail), "{name}: {finding:?}");
    }
    let part = proven.drawn().and_then(|drawn| drawn.parts.first()).expect("a part");
    let told = proven.findings().iter().find(|finding| finding.check == "outline").expect("checked").value;
    (part.outline.contour.clone(), told)
}

/// Every kind of cam on every side: all checks pass, the proof finds what the fit told, and the spans are fewer than the arcs.
#[test]
fn splines_are_proved_as_arcs_are() {
    let kinds = [
        ("rotary", rotary(&[])),
        ("turned, offset", rotary(&["cam.rotation=ccw", "follower.roller.offset=12mm"])),
        ("corners", rotary(&["buffer.column=return", "transition.kind=none", "limits.continuity=0"])),
        (
            "plate",
            Spec::translating(machine(&[]), 35.0, Solver::Ode { tolerance: 1e-15 }, ExactOn::Braking)
                .solve()
                .expect("a plate"),
        ),
        ("conoid", Spec::conoid(machine(&[]), vec![20.0, 35.0], None).solve().expect("a conoid")),
    ];
    for (name, cam) in kinds {
        for (tolerance, side) in [(5e-6, Side::Both), (5e-7, Side::Both), (5e-6, Side::Inside)] {
            let (contour, told) = proved(&cam, splines(tolerance, side), name);
            let arcs = cam.draw(Request::within(Fit { side, ..Fit::from(tolerance) })).expect("drawn");
            let arcs = arcs.drawn().and_then(|drawn| drawn.parts.first()).expect("a part").outline.contour.arcs();
            assert!(
                contour.cubics() > 0 && contour.vertices.len() <= arcs,
                "{name}: {} {arcs}",
                contour.vertices.len()
            );
            let found = runs(&contour).iter().filter(|run| matches!(run, CurveRun::Spline(_))).count();
            assert!(found <= 8, "{name}: one spline for each piece, not {found}");
            assert!(told <= 1e3 * tolerance, "{name}: {told}");
        }
    }
}

/// The proof of the bytes tells the distance that the fit was certified with.
#[test]
fn the_proof_finds_what_the_fit_told() {
    for tolerance in [5e-5, 5e-6, 5e-7, 5e-8] {
        let cam = rotary(&[]);
        let drawing = cam.draw(splines(tolerance, Side::Both)).expect("drawn");
        let told = drawing.drawn().and_then(|drawn| drawn.parts.first()).expect("a part").outline.deviation;
        let (_, found) = proved(&cam, splines(tolerance, Side::Both), "rotary");
        assert!(found <= told + 1e-10 && found >= 0.98 * told, "{tolerance}: {found} {told}");
    }
}

/// A span moved by 20 µm is told, where it is.
#[test]
fn a_moved_control_point_is_found() {
    let cam = rotary(&[]);
    let (contour, _) = proved(&cam, splines(5e-6, Side::Both), "rotary");
    let boundary = cam.body().boundary(&cam.body().cuts()[0]).expect("a profile").expect("a profile");
    let right = follow(&contour, &boundary).expect("followed").distance;
    assert!(right <= 5e-3);
    let at = contour.vertices.iter().position(|vertex| vertex.bulge().is_none()).expect("a cubic") + 3;
    let mut edges: Vec<Edge> = contour.edges().collect();
    let Edge::Cubic(mut cubic) = edges[at] else { panic!("a cubic") };
    cubic.points[1] += Vector2::new(0.02, 0.02);
    cubic.points[2] += Vector2::new(0.02, 0.02);
    edges[at] = Edge::Cubic(cubic);
    let found = follow(&Contour::from_edges(edges), &boundary).expect("followed");
    assert!(found.distance > 0.01 && (found.at - cubic.points[1]).norm() < 20.0, "{found:?}");
}

/// The bytes of every version but R12 are read back to the control points that were drawn; R12 is refused.
#[test]
fn every_version_with_splines_holds_them() {
    let cam = rotary(&[]);
    let drawing = cam.draw(splines(5e-6, Side::Both)).expect("drawn");
    let part = drawing.drawn().and_then(|drawn| drawn.parts.first()).expect("a part");
    for (name, version) in Version::ALL {
        if version == Version::R12 {
            assert_eq!(proof::write(part, version).expect_err("no splines").what, "DXF R12 has no SPLINE");
            continue;
        }
        let written = proof::write(part, version).expect(name);
        let reading = reading::read(&written.bytes, 1e-6).expect(name);
        assert_eq!((reading.chains.len(), reading.splines, reading.unreadable.len()), (1, 0, 0), "{name}");
        let cubics = |contour: &Contour| -> Vec<_> {
            contour.edges().filter_map(|edge| if let Edge::Cubic(cubic) = edge { Some(cubic) } else { None }).collect()
        };
        let (drawn, found) = (cubics(&part.outline.contour), cubics(&written.outlines[0]));
        assert_eq!(drawn.len(), found.len(), "{name}");
        for (a, b) in drawn.iter().zip(&found) {
            for (p, q) in a.points.iter().zip(&b.points) {
                assert!((p - q).norm() < 1e-11, "{name}: {p} {q}");
            }
        }
    }
}

/// An acceleration of the follower that is kept to a share: spans against the N_a of arcs, the largest |dκ_pitch| ℓ²/(2 ε cos α)
/// summed up, which counts one arc for each 2 ε of change of the law's acceleration.
#[test]
fn an_acceleration_is_kept_with_fewer_spans_than_arcs() {
    let cam = rotary(&[]);
    let curves = camgen::body::curves(cam.body()).expect("plane");
    let pieces = curves.motion.pieces();
    let places = |index: usize| {
        let piece = &pieces[index];
        (0..=2000).map(move |i| piece.start + (piece.end - piece.start) * f64::from(i) / 2000.0)
    };
    let second = |index: usize, at: f64| MILLIMETRES * curves.contact(index, at).lift.dds;
    let curved: Vec<usize> = (0..pieces.len()).filter(|index| !pieces[*index].dwell).collect();
    let all = |f: &dyn Fn(usize, f64) -> f64| -> Vec<Vec<f64>> {
        curved.iter().map(|index| places(*index).map(|at| f(*index, at)).collect()).collect()
    };
    let most = all(&|index, at| second(index, at).abs()).concat().into_iter().fold(0.0, f64::max);
    let changes = all(&second).iter().flat_map(|row| row.windows(2)).map(|pair| (pair[1] - pair[0]).abs()).sum::<f64>();
    let radius = MILLIMETRES * curves.offset();
    for (share, fewer) in [(0.05, 0.6), (0.01, 0.3)] {
        let limit = share * most;
        let by_arcs = changes / (2.0 * limit);
        let mut spans = 0.0;
        for index in &curved {
            let allowed = |at: f64, profile: &CurvePoint| {
                let contact = curves.contact(*index, at);
                let speed = MILLIMETRES * contact.curve.speed;
                let offset = 1.0 + radius * profile.curvature;
                let curvature = limit * libm::cos(contact.pressure_angle) / (speed * speed) * offset * offset;
                ChainTolerance::symmetric(f64::INFINITY, curvature)
            };
            let curve = |at: f64| curves.profile(*index, at).scaled(MILLIMETRES);
            let piece = &pieces[*index];
            let fitted = cubics::fit(curve, (piece.start, piece.end), 5e-3, &allowed).expect("a spline");
            assert!(fitted.deviation <= 5e-3);
            spans += f64::from(u32::try_from(fitted.spline.spans()).expect("few"));
        }
        println!("{share}: {spans} spans, {by_arcs:.1} arcs by theory");
        assert!(spans < fewer * by_arcs, "{share}: {spans} spans, {by_arcs} arcs");
    }
}

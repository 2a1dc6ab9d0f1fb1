//! The moving picture of a brake as its roll runs down.

use super::PLACES;
use super::braking::LoadedBrake;
use super::picture::BrakeOutline;
use camgen_cams::body::picture::bracket;
use camgen_cams::report::mechanism::{CoordinateTrack, MechanismView, MovingMechanism, RigidPart, circle, line};
use camgen_cams::report::sheet::SheetShape;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// Samples of the picture.
const SAMPLES: u32 = PLACES / 2;
/// Room about what moves, over the larger side, and length of the arrow of the weight, over the largest radius.
const MARGIN: f64 = 0.05;
const WEIGHT: f64 = 0.35;

/// The mechanism from the run-down roll to the full one.
pub(super) fn mechanism(braking: &LoadedBrake<'_>) -> MovingMechanism {
    let stands: Vec<_> = braking.radii(SAMPLES).filter_map(|radius| braking.brake.at(radius).ok()).collect();
    let places: Vec<BrakeOutline> = stands.iter().rev().map(|pose| BrakeOutline::new(braking, pose)).collect();
    let at: Vec<f64> = stands.iter().rev().map(|pose| MILLIMETRES * pose.radius).collect();
    #[expect(clippy::cast_precision_loss, reason = "a hundred")]
    let turn_deg = (0..at.len()).map(|index| 360.0 * index as f64 / (at.len().max(2) - 1) as f64).collect();
    let turned: Vec<f64> = stands.iter().rev().map(|pose| pose.theta.to_degrees()).collect();
    let view = MechanismView {
        rpm: None,
        shaft_speed: None,
        returns: true,
        place: "roll_radius_mm",
        at,
        turn_deg,
        extents: extents(&places),
        parts: parts(braking, &places, &turned),
    };
    let notes = vec![
        "Roll, pulleys, pivot and centre of gravity are to scale; the frame is drawn as lines, the outer run of the belt is omitted."
            .into(),
        "The picture runs from the run-down roll to the full roll and back.".into(),
    ];
    MovingMechanism { views: vec![view], notes, solid: None }
}

fn extents(places: &[BrakeOutline]) -> Extents {
    let mut points = Vec::new();
    for lying in places {
        let roll = Vector2::repeat(lying.roll);
        let pulley = Vector2::repeat(lying.pulley);
        points.extend([roll, -roll, lying.pivot, lying.centre, lying.right + pulley, lying.right - pulley]);
        points.extend([lying.left + pulley, lying.left - pulley]);
    }
    let least = points.iter().fold(Vector2::repeat(f64::INFINITY), |low, point| low.inf(point));
    let largest = points.iter().fold(Vector2::repeat(f64::NEG_INFINITY), |high, point| high.sup(point));
    let margin = Vector2::repeat(MARGIN * (largest - least).max());
    Extents { least: least - margin, largest: largest + margin }
}

/// The parts from the back to the front.
fn parts(braking: &LoadedBrake<'_>, places: &[BrakeOutline], turned: &[f64]) -> Vec<RigidPart> {
    let Some(full) = places.last() else { return Vec::new() };
    let roll: Vec<f64> = places.iter().map(|lying| lying.roll).collect();
    let paper = RigidPart {
        stretch: CoordinateTrack::from(roll.clone()),
        height: CoordinateTrack::from(roll),
        ..RigidPart::new("bed", vec![circle(0.0, 0.0, 1.0)])
    };
    let pulley = RigidPart::new("roller", vec![circle(0.0, 0.0, full.pulley)]);
    let arms = [full.right, full.left, full.centre].map(|end| end - full.pivot);
    let frame = RigidPart::new("follower", arms.map(|arm| line((0.0, 0.0), (arm.x, arm.y))).to_vec());
    // The frame is drawn as at the full roll, the last sample.
    let frame = frame.at(full.pivot.x, full.pivot.y).turned(turned.to_vec());
    let drop = WEIGHT * MILLIMETRES * braking.brake.roll().largest_radius;
    let weight = RigidPart::new("arrow", vec![line((0.0, 0.0), (0.0, -drop))]);
    vec![
        paper,
        span(places, 0),
        span(places, 1),
        frame,
        moved(pulley.clone(), places, |lying| lying.right).named("p1", 0.0, 0.0),
        moved(pulley, places, |lying| lying.left).named("p2", 0.0, 0.0),
        moved(weight, places, |lying| lying.centre).named("G", 0.0, 0.0),
        RigidPart::new("ground", bracket(full.pivot, (0.8 * full.pulley, 1.0))),
        RigidPart::new("pin", vec![circle(full.pivot.x, full.pivot.y, 0.35 * full.pulley)]).named(
            "O",
            full.pivot.x,
            full.pivot.y,
        ),
        RigidPart::new("ground", vec![circle(0.0, 0.0, 0.3 * full.pulley)]),
    ]
}

/// A part that moves with a point of the frame.
fn moved(part: RigidPart, places: &[BrakeOutline], point: fn(&BrakeOutline) -> Vector2<f64>) -> RigidPart {
    let (x, y): (Vec<f64>, Vec<f64>) = places.iter().map(|lying| (point(lying).x, point(lying).y)).unzip();
    part.at(x, y)
}

/// A span of the belt between a pulley and the roll: a line of unit length, turned and stretched.
fn span(places: &[BrakeOutline], which: usize) -> RigidPart {
    let ends: Vec<[Vector2<f64>; 2]> = places.iter().filter_map(|lying| lying.spans.get(which).copied()).collect();
    let (x, y): (Vec<f64>, Vec<f64>) = ends.iter().map(|[from, _]| (from.x, from.y)).unzip();
    let across: Vec<Vector2<f64>> = ends.iter().map(|[from, to]| to - from).collect();
    let turn: Vec<f64> = across.iter().map(|span| libm::atan2(span.y, span.x).to_degrees()).collect();
    let shape = SheetShape::Line(Vector2::zeros(), Vector2::new(1.0, 0.0));
    let part = RigidPart::new("normal", vec![shape]).at(x, y).turned(turn);
    RigidPart { stretch: across.iter().map(Vector2::norm).collect::<Vec<f64>>().into(), ..part }
}

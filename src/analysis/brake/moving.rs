//! The brake as its roll runs down, for a picture.

use super::PLACES;
use super::braking::Braking;
use super::picture::Lying;
use crate::geometry::MILLIMETRES;
use crate::geometry::contour::Extents;
use crate::report::mechanism::{Mechanism, Rigid, Track, View, circle, line};
use crate::report::sheet::Shape;
use nalgebra::Vector2;

/// Samples of the picture.
const SAMPLES: u32 = PLACES / 2;
/// Room about what moves, over the larger side, and length of the arrow of the weight, over the largest radius.
const MARGIN: f64 = 0.05;
const WEIGHT: f64 = 0.35;

/// The mechanism from the roll that has run down to the full one.
pub(super) fn mechanism(braking: &Braking<'_>) -> Mechanism {
    let stands: Vec<_> = braking.radii(SAMPLES).filter_map(|radius| braking.brake.at(radius).ok()).collect();
    let places: Vec<Lying> = stands.iter().rev().map(|stand| Lying::new(braking, stand)).collect();
    let at: Vec<f64> = stands.iter().rev().map(|stand| MILLIMETRES * stand.radius).collect();
    #[expect(clippy::cast_precision_loss, reason = "a hundred")]
    let turn_deg = (0..at.len()).map(|index| 360.0 * index as f64 / (at.len().max(2) - 1) as f64).collect();
    let turned: Vec<f64> = stands.iter().rev().map(|stand| stand.theta.to_degrees()).collect();
    let view = View {
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
        "Roll, pulleys, pivot and centre of gravity are to scale; the frame is drawn as lines, the belt's outer run is left out."
            .into(),
        "The picture runs from the roll run down to the full one and back.".into(),
    ];
    Mechanism { views: vec![view], notes, solid: None }
}

fn extents(places: &[Lying]) -> Extents {
    let corner = |lying: &Lying| {
        let roll = Vector2::repeat(lying.roll);
        let pulley = Vector2::repeat(lying.pulley);
        [roll, -roll, lying.pivot, lying.centre, lying.right + pulley, lying.right - pulley]
            .into_iter()
            .chain([lying.left + pulley, lying.left - pulley])
            .collect::<Vec<_>>()
    };
    let points: Vec<Vector2<f64>> = places.iter().flat_map(corner).collect();
    let least = points.iter().fold(Vector2::repeat(f64::INFINITY), |low, point| low.inf(point));
    let largest = points.iter().fold(Vector2::repeat(f64::NEG_INFINITY), |high, point| high.sup(point));
    let margin = Vector2::repeat(MARGIN * (largest - least).max());
    Extents { least: least - margin, largest: largest + margin }
}

/// The parts from the back to the front.
fn parts(braking: &Braking<'_>, places: &[Lying], turned: &[f64]) -> Vec<Rigid> {
    let Some(full) = places.last() else { return Vec::new() };
    let roll: Vec<f64> = places.iter().map(|lying| lying.roll).collect();
    let grown = |part: Rigid| Rigid { stretch: Track::from(roll.clone()), height: Track::from(roll.clone()), ..part };
    let moved = |part: Rigid, of: fn(&Lying) -> Vector2<f64>| {
        let (x, y): (Vec<f64>, Vec<f64>) = places.iter().map(|lying| (of(lying).x, of(lying).y)).unzip();
        part.at(x, y)
    };
    let pulley = || Rigid::new("roller", vec![circle(0.0, 0.0, full.pulley)]);
    let own = |at: Vector2<f64>| at - full.pivot;
    let arm = |at: Vector2<f64>| line((0.0, 0.0), (own(at).x, own(at).y));
    let frame = Rigid::new("follower", vec![arm(full.right), arm(full.left), arm(full.centre)]);
    // The frame's own shape is that at the full roll, the last sample.
    let frame = frame.at(full.pivot.x, full.pivot.y).turned(turned.to_vec());
    let drop = WEIGHT * MILLIMETRES * braking.brake.roll().largest_radius;
    let weight = Rigid::new("arrow", vec![line((0.0, 0.0), (0.0, -drop))]);
    vec![
        grown(Rigid::new("bed", vec![circle(0.0, 0.0, 1.0)])),
        span(places, 0),
        span(places, 1),
        frame,
        moved(pulley(), |lying| lying.right).named("p1", 0.0, 0.0),
        moved(pulley(), |lying| lying.left).named("p2", 0.0, 0.0),
        moved(weight, |lying| lying.centre).named("G", 0.0, 0.0),
        Rigid::new("ground", vec![circle(full.pivot.x, full.pivot.y, 0.5 * full.pulley)]).named(
            "O",
            full.pivot.x,
            full.pivot.y,
        ),
        Rigid::new("ground", vec![circle(0.0, 0.0, 0.3 * full.pulley)]),
    ]
}

/// A span of the belt between a pulley and the roll: a line of unit length, turned and stretched.
fn span(places: &[Lying], which: usize) -> Rigid {
    let ends: Vec<[Vector2<f64>; 2]> = places.iter().filter_map(|lying| lying.spans.get(which).copied()).collect();
    let (x, y): (Vec<f64>, Vec<f64>) = ends.iter().map(|[from, _]| (from.x, from.y)).unzip();
    let across: Vec<Vector2<f64>> = ends.iter().map(|[from, to]| to - from).collect();
    let turn: Vec<f64> = across.iter().map(|span| libm::atan2(span.y, span.x).to_degrees()).collect();
    let shape = Shape::Line(Vector2::zeros(), Vector2::new(1.0, 0.0));
    let part = Rigid::new("normal", vec![shape]).at(x, y).turned(turn);
    Rigid { stretch: across.iter().map(Vector2::norm).collect::<Vec<f64>>().into(), ..part }
}

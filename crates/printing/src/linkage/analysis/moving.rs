//! The linkage as it moves over a turn of its driving crank, for a picture.

use super::from_base;
use super::picture::{LinkagePicture, Places, SLIDER, SLOT};
use crate::press::bed_motion::{DragLink, Linkage};
use camgen_cams::report::mechanism::{MechanismView, MovingMechanism, RigidPart, circle, line, rectangle};
use camgen_cams::report::sheet::SheetShape;
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::{Contour, Extents, Vertex};
use nalgebra::Vector2;

/// Half the width of a link over the crank O2C: two shafts a tenth of it apart can still be distinguished.
const HALF: f64 = 0.035;
/// Radius of a pin, and of a shaft, over half the width of a link.
const PIN: f64 = 0.55;
const SHAFT: f64 = 1.3;
/// Distance of the top of a letter above its joint, or of its middle next to it, over the crank O2C.
const LETTER: f64 = 0.14;
/// Room about what moves, over the larger side.
const MARGIN: f64 = 0.03;

/// The mechanism at this many crank angles of a turn, and once more at its end.
pub(super) fn mechanism(lying: &LinkagePicture<'_>, rows: u32, shaft_speed: f64) -> MovingMechanism {
    let cranks: Vec<f64> = (0..=rows).map(|i| 360.0 * (f64::from(i) / f64::from(rows))).collect();
    let covered = lying.covered();
    let margin = Vector2::repeat(MARGIN * covered.size().max() + LETTER * lying.crank);
    let view = MechanismView {
        rpm: None,
        shaft_speed: Some(shaft_speed).filter(|speed| speed.is_finite()),
        returns: false,
        place: "crank_deg",
        at: cranks.clone(),
        turn_deg: cranks.clone(),
        extents: Extents { least: covered.least - margin, largest: covered.largest + margin },
        parts: parts(lying, &cranks),
    };
    let plain =
        "The links are bars in one plane; their widths and the size of the slider are not those of the machine.";
    let mut notes = vec![plain.to_owned()];
    notes.extend(lying.assumed());
    MovingMechanism { views: vec![view], notes, solid: None }
}

/// The parts from the back to the front; cranks in degrees from the line of the slider.
fn parts(lying: &LinkagePicture<'_>, cranks: &[f64]) -> Vec<RigidPart> {
    let thetas: Vec<f64> = cranks.iter().map(|crank| from_base(lying.data, crank.to_radians())).collect();
    let places: Vec<Places> = thetas.iter().map(|theta| lying.places(*theta)).collect();
    let half = HALF * lying.crank;
    let crank: Vec<Vector2<f64>> = places.iter().map(|joints| joints.crank).collect();
    let slider: Vec<Vector2<f64>> = places.iter().map(|joints| joints.slider).collect();
    let paths = lying.paths().into_iter().map(|(_, points)| SheetShape::Path(points)).collect();
    let [from, to] = lying.guide();
    let mut parts = vec![
        RigidPart::new("ghost", paths),
        RigidPart::new("mark", vec![line((from.x, from.y), (to.x, to.y))]),
        bed(lying, &slider),
    ];
    let mut pins = vec![("C", LETTER, crank.clone())];
    if lying.data.linkage != Linkage::Yoke {
        parts.push(between(&crank, &slider, half));
        // Its letter is above the slider.
        pins.push(("D", 0.5 * SLIDER[1] + LETTER, slider));
    }
    match lying.data.linkage {
        Linkage::SixBar(link, _) => {
            let beta: Vec<f64> =
                thetas.iter().map(|theta| lying.data.linkage.slider_crank_angle(*theta).to_degrees()).collect();
            let joints: Vec<[Vector2<f64>; 3]> = places.iter().filter_map(|joints| joints.drag_link).collect();
            let shaft = joints.first().map_or_else(Vector2::zeros, |[shaft, ..]| *shaft);
            let driving: Vec<Vector2<f64>> = joints.iter().map(|[_, driving, _]| *driving).collect();
            let driven: Vec<Vector2<f64>> = joints.iter().map(|[.., driven]| *driven).collect();
            parts.push(between(&driving, &driven, half));
            parts.push(driven_crank(lying, &link).turned(beta));
            let arm = bar(&[Vector2::zeros(), Vector2::new(lying.driving_crank(), 0.0)], half);
            parts.push(RigidPart::new("crank", vec![arm]).at(shaft.x, shaft.y).turned(cranks.to_vec()));
            parts.push(shaft_at("O1", shaft, -1.0, lying.crank));
            pins.extend([("A", LETTER, driving), ("B", LETTER, driven)]);
        }
        Linkage::Yoke | Linkage::CrankSlider(_) => {
            let arm = bar(&[Vector2::zeros(), Vector2::new(lying.crank, 0.0)], half);
            parts.push(RigidPart::new("crank", vec![arm]).turned(cranks.to_vec()));
        }
    }
    parts.push(shaft_at("O2", Vector2::zeros(), 1.0, lying.crank));
    parts.extend(pins.into_iter().map(|(letter, above, at)| pin(letter, above, &at, lying.crank)));
    parts
}

/// The crank O2C and the driven crank O2B as one part, C along its own x.
fn driven_crank(lying: &LinkagePicture<'_>, link: &DragLink) -> RigidPart {
    let back = lying.data.base_angle - link.turn;
    let arm = link.follower * lying.driving_crank();
    let ends = [Vector2::zeros(), Vector2::new(lying.crank, 0.0), arm * Vector2::new(libm::cos(back), libm::sin(back))];
    RigidPart::new("crank", vec![bar(&ends, HALF * lying.crank)])
}

/// The slider, or the slotted link of a yoke, with its bed.
fn bed(lying: &LinkagePicture<'_>, slider: &[Vector2<f64>]) -> RigidPart {
    let [wide, high] = SLOT;
    let pin = 2.0 * HALF * PIN;
    let shapes = match lying.data.linkage {
        Linkage::Yoke => {
            let slot = centred_rectangle(pin, high - (wide - pin), lying.crank);
            vec![centred_rectangle(wide, high, lying.crank), slot]
        }
        Linkage::CrankSlider(_) | Linkage::SixBar(..) => {
            vec![centred_rectangle(SLIDER[0], SLIDER[1], lying.crank)]
        }
    };
    let below = if lying.data.linkage == Linkage::Yoke { SLOT[1] } else { SLIDER[1] };
    moved(RigidPart::new("bed", shapes), slider).named("bed", 0.0, -(0.5 * below + 0.2 * LETTER) * lying.crank)
}

/// A rectangle about the origin, its sides in cranks O2C.
fn centred_rectangle(wide: f64, high: f64, crank: f64) -> SheetShape {
    let (x, y) = (0.5 * wide * crank, 0.5 * high * crank);
    rectangle((-x, x), (-y, y))
}

/// A link from one joint to another, along its own x.
fn between(from: &[Vector2<f64>], to: &[Vector2<f64>], half: f64) -> RigidPart {
    let length = from.first().zip(to.first()).map_or(0.0, |(from, to)| (to - from).norm());
    let mut before = 0.0;
    // The angle grows over a turn, without a jump from +180° to −180°.
    let turn = from.iter().zip(to).map(|(from, to)| {
        let along = to - from;
        let angle = libm::atan2(along.y, along.x).to_degrees();
        before = angle + 360.0 * ((before - angle) / 360.0).round();
        before
    });
    let turn: Vec<f64> = turn.collect();
    moved(RigidPart::new("follower", vec![bar(&[Vector2::zeros(), Vector2::new(length, 0.0)], half)]), from)
        .turned(turn)
}

/// A part that moves with a joint.
fn moved(part: RigidPart, joint: &[Vector2<f64>]) -> RigidPart {
    let (x, y): (Vec<f64>, Vec<f64>) = joint.iter().map(|at| (at.x, at.y)).unzip();
    part.at(x, y)
}

/// A pin with its letter at a distance above it, in cranks O2C.
fn pin(letter: &str, above: f64, at: &[Vector2<f64>], crank: f64) -> RigidPart {
    moved(RigidPart::new("roller", vec![circle(0.0, 0.0, PIN * HALF * crank)]), at).named(letter, 0.0, above * crank)
}

/// A shaft in the frame with its letter below it, to one side.
fn shaft_at(letter: &str, at: Vector2<f64>, side: f64, crank: f64) -> RigidPart {
    let letter_at = at + Vector2::new(side * 0.6 * LETTER, -SHAFT * HALF) * crank;
    RigidPart::new("ground", vec![circle(at.x, at.y, SHAFT * HALF * crank)]).named(letter, letter_at.x, letter_at.y)
}

/// A body with up to three joints: everything within a margin of the figure they span.
fn bar(joints: &[Vector2<f64>], half: f64) -> SheetShape {
    let corners = spanned(joints);
    let mut vertices = Vec::with_capacity(2 * corners.len());
    for (index, corner) in corners.iter().enumerate() {
        let before = side(&corners, index + corners.len() - 1);
        let behind = side(&corners, index);
        let [end, start] = [before, behind].map(|along| corner + half * Vector2::new(along.y, -along.x));
        let turned = libm::atan2(before.perp(&behind), before.dot(&behind)).abs();
        vertices.push(Vertex::new(end, libm::tan(0.25 * turned)));
        vertices.push(Vertex::new(start, 0.0));
    }
    SheetShape::Entity(Entity::Polyline(Contour { vertices }))
}

/// Direction of the side from a corner to the next, counted around.
fn side(corners: &[Vector2<f64>], index: usize) -> Vector2<f64> {
    let [from, to] = [index, index + 1].map(|index| corners.get(index % corners.len()).copied().unwrap_or_default());
    (to - from).normalize()
}

/// The corners of the figure that two or three joints span, counter-clockwise; of joints on one line the two ends.
fn spanned(places: &[Vector2<f64>]) -> Vec<Vector2<f64>> {
    let [a, b, c] = *places else { return places.to_vec() };
    let (turn, sides) = ((b - a).perp(&(c - a)), [(b - a).norm(), (c - b).norm(), (a - c).norm()]);
    let longest = sides.into_iter().fold(0.0, f64::max);
    if turn.abs() < FLAT * longest * longest {
        let ends = [[a, b], [b, c], [c, a]].into_iter().zip(sides).find(|(_, side)| *side >= longest);
        return ends.map(|(ends, _)| ends.to_vec()).unwrap_or_default();
    }
    if turn > 0.0 { vec![a, b, c] } else { vec![a, c, b] }
}

/// A triangle with less than this share of the square of its longest side is drawn as a line: its rounded corners would not be visible.
const FLAT: f64 = 1e-6;

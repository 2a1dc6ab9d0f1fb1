//! How the plate, its rollers, the bell crank and the bottom move over the stroke.

use super::Wedge;
use crate::press::picture::{BufferPicture, PressPose, buffer};
use camgen_cams::body::Drawn;
use camgen_cams::body::picture::{Cover, bracket, range};
use camgen_cams::report::mechanism::{MechanismView, MovingMechanism, RigidPart, circle, line, rectangle};
use camgen_cams::report::sheet::SheetShape;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::motion::Motion;
use nalgebra::Vector2;

/// What is not modelled of a plate.
pub(super) const NOT_MODELLED: &[&str] = &[
    "Friction: only that of equation (18), the friction angle at the roller and the efficiency of the bell crank.",
    "Mass of the bell crank: it enters the closing force only where the file gives a mass of the follower.",
];

/// The plate at a sample, mm.
struct PlatePose {
    x: f64,
    turn_deg: f64,
    roller: Vector2<f64>,
    normal_deg: f64,
    psi_deg: f64,
    pose: PressPose,
}

/// The mechanism of a plate as it moves.
pub(super) fn build(plate: &Wedge, drawn: &Drawn, samples: u32) -> MovingMechanism {
    let Some(part) = drawn.parts.first() else { return MovingMechanism::default() };
    let start = plate.motion.range().0;
    let bed = &plate.mechanism().bottom_law;
    let before = bed.crank_before(start);
    let steps = samples.max(1);
    let mut samples = Vec::new();
    for i in 0..=steps {
        let crank = before + (bed.dead() - before) * f64::from(i) / f64::from(steps);
        samples.push(sample(plate, if i == steps { plate.stroke() } else { bed.overrun(crank) }, crank));
    }
    let mut cover = Cover::nothing();
    let outline = SheetShape::Entity(Entity::Polyline(part.outline.contour.clone()));
    let mut parts = parts(plate, &samples, outline, &mut cover);
    parts.extend(rollers(plate, &samples));
    let size = cover.0.largest - cover.0.least;
    let view = MechanismView {
        rpm: None,
        shaft_speed: Some(plate.crank_speed),
        returns: true,
        place: "x_mm",
        at: samples.iter().map(|at| at.x).collect(),
        turn_deg: samples.iter().map(|at| at.turn_deg).collect(),
        extents: cover.with_margin(0.03 * size.x.max(size.y)),
        parts,
    };
    let notes = vec![
        "Plate, rollers, bell crank, bottom, air column and overrun are to one scale; rods and bed are schematic."
            .into(),
        "The cylinder of the lower roller's bell crank is shown; the other one is its mirror image.".into(),
    ];
    MovingMechanism { views: vec![view], notes, solid: None }
}

fn sample(plate: &Wedge, x: f64, crank: f64) -> PlatePose {
    let (piece, x) = plate.motion.locate(x);
    let (bottom, contact) = (plate.motion.bottom(piece, x), plate.curves().contact(piece, x));
    let roller = contact.curve.point - Vector2::new(x, 0.0);
    let normal = contact.curve.outward();
    let ratio = if x < 0.0 { 1.0 } else { 1.0 + plate.mechanism().air(x, bottom.s) };
    PlatePose {
        x: MILLIMETRES * x + 0.0,
        turn_deg: crank.to_degrees(),
        roller: roller * MILLIMETRES,
        normal_deg: libm::atan2(normal.y, normal.x).to_degrees(),
        psi_deg: plate.mechanism().psi(bottom.s).to_degrees(),
        pose: PressPose { crank, overrun: plate.place(crank), bottom: bottom.s, ratio },
    }
}

/// All but the rollers, from the back to the front.
fn parts(plate: &Wedge, samples: &[PlatePose], outline: SheetShape, cover: &mut Cover) -> Vec<RigidPart> {
    let (l1, l2) = (MILLIMETRES * plate.data.roller_arm, MILLIMETRES * plate.data.bottom_arm);
    let (radius, delta) = (MILLIMETRES * plate.data.roller_radius, plate.data.delta);
    let away = MILLIMETRES * plate.follower.axis_distance + l1 * libm::cos(delta);
    let pivot = Vector2::new(-l1 * libm::sin(delta), -away);
    let poses: Vec<PressPose> = samples.iter().map(|at| at.pose).collect();
    let of = BufferPicture::new(&plate.cylinder, plate.mechanism().bottom_law.by_crank());
    let plate_end = MILLIMETRES * plate.run_out().x;
    let half_height = 0.5 * MILLIMETRES * plate.height;
    let clear = half_height + 2.4 * radius + 0.55 * of.bore();
    let axis_y = (pivot.y + l2).max(clear);
    // The bed's body is behind the plate.
    let width = 0.4 * of.stroke();
    let place_x = (plate_end + 0.5 * radius - of.rod() - of.column()).max(pivot.x + 1.5 * radius + of.stroke() * 0.6);
    let place = Vector2::new(place_x, axis_y);
    let mut parts = buffer(&of, &poses, place, width, cover);
    let xs: Vec<f64> = samples.iter().map(|at| -at.x).collect();
    let body = place.x + of.column() + of.rod();
    let bed = vec![
        rectangle((plate_end - 0.2 * radius, body), (-0.4 * half_height, 0.4 * half_height)),
        rectangle((body, body + width), (-0.4 * half_height, axis_y - 0.5 * of.bore())),
    ];
    parts.push(RigidPart::new("bed", bed).at(xs.clone(), 0.0));
    parts.push(RigidPart::new("cam", vec![outline]).at(xs, 0.0).named("plate", 0.5 * plate_end, 0.0));
    parts.push(RigidPart::new("ground", vec![line((-1.1 * l1.max(radius), 0.0), (1.2 * plate_end, 0.0))]));
    let bell_crank = BellCrankPicture { pivot, roller_arm: l1, bottom_arm: l2, delta, radius };
    parts.extend(bell_crank.parts(samples));
    parts.push(bell_crank.rod(samples, place, &of));
    let rollers = range(samples.iter().map(|at| at.roller.y));
    cover.add((pivot.x - radius, body + width), (rollers.0 - radius, -rollers.0 + radius));
    cover.add((pivot.x - radius, pivot.x + radius), (pivot.y - 2.2 * radius, (pivot.y + l2).max(-pivot.y + radius)));
    parts
}

/// The bell crank of the lower roller, mm.
struct BellCrankPicture {
    pivot: Vector2<f64>,
    roller_arm: f64,
    bottom_arm: f64,
    /// Angle between the arms, rad.
    delta: f64,
    /// Of the roller.
    radius: f64,
}

impl BellCrankPicture {
    /// The rod from the upper arm to the bottom: its head has a slot, along which the end of the arm slides.
    fn rod(&self, samples: &[PlatePose], place: Vector2<f64>, buffer: &BufferPicture) -> RigidPart {
        let half = 0.18 * self.radius;
        let end_y = self.pivot.y + self.bottom_arm;
        let bottoms: Vec<f64> = samples.iter().map(|at| place.x + MILLIMETRES * at.pose.bottom).collect();
        let back = self.pivot.x - place.x;
        let thick = 0.04 * buffer.bore() + 0.02 * buffer.stroke();
        let (low, high) = (end_y.min(place.y) - 0.8 * self.radius, end_y.max(place.y) + 0.4 * self.radius);
        let shapes = vec![
            rectangle((back, -thick), (-half, half)),
            rectangle((back - 1.2 * half, back + 1.2 * half), (low - place.y, high - place.y)),
        ];
        RigidPart::new("follower", shapes).at(bottoms, place.y)
    }

    fn half_width(&self) -> f64 {
        0.22 * self.radius
    }

    /// The arms about the pivot, of the lower roller for a side of 1 and of the upper one, without its other arm, for −1.
    fn arms(&self, side: f64) -> Vec<SheetShape> {
        let (half, l1, l2) = (self.half_width(), self.roller_arm, self.bottom_arm);
        // At ψ = 0 the roller's arm is at Δ from the other one, which is across the bed.
        let end = Vector2::new(l1 * libm::sin(self.delta), side * l1 * libm::cos(self.delta));
        let across = Vector2::new(-end.y, end.x).normalize() * half;
        let arm = [across, end + across, end - across, -across, across];
        let mut shapes = vec![SheetShape::Path(arm.to_vec()), circle(0.0, 0.0, 1.6 * half)];
        if side > 0.0 {
            shapes.extend([rectangle((-half, half), (1.6 * half, l2 - 1.2 * half)), circle(0.0, l2, 1.2 * half)]);
        }
        shapes
    }

    fn parts(&self, samples: &[PlatePose]) -> Vec<RigidPart> {
        let (half, pivot) = (self.half_width(), self.pivot);
        let turns: Vec<f64> = samples.iter().map(|at| -at.psi_deg).collect();
        let mirrored: Vec<f64> = samples.iter().map(|at| at.psi_deg).collect();
        let lower = RigidPart::new("follower", self.arms(1.0)).at(pivot.x, pivot.y).turned(turns);
        vec![
            RigidPart::new("ghost", self.arms(-1.0)).at(pivot.x, -pivot.y).turned(mirrored),
            RigidPart::new("ground", bracket(pivot, (2.6 * half, -1.0))),
            lower.named("bell crank", 0.0, -8.0 * half),
            RigidPart::new("pin", vec![circle(pivot.x, pivot.y, 0.6 * half)]),
        ]
    }
}

fn rollers(plate: &Wedge, samples: &[PlatePose]) -> Vec<RigidPart> {
    let radius = MILLIMETRES * plate.data.roller_radius;
    let roller = RigidPart::new("roller", vec![circle(0.0, 0.0, radius), circle(0.0, 0.0, 0.12 * radius)]);
    let x: Vec<f64> = samples.iter().map(|at| at.roller.x).collect();
    let y: Vec<f64> = samples.iter().map(|at| at.roller.y).collect();
    let upper_y: Vec<f64> = y.iter().map(|y| -y).collect();
    let normals: Vec<f64> = samples.iter().map(|at| at.normal_deg).collect();
    vec![
        roller.clone().at(x.clone(), upper_y),
        roller.at(x.clone(), y.clone()),
        RigidPart::new("normal", vec![line((-radius, 0.0), (1.9 * radius, 0.0))]).at(x, y).turned(normals),
    ]
}

//! Followers: from parameter and lift to the curve that the follower describes on the cam.
//!
//! A follower returns a point of a curve with tangent, curvature and slope of the curvature, how far inwards of that curve the
//! profile lies, and the direction in which it is driven. For a roller the curve is the path of its centre (the pitch curve)
//! and the distance its radius; a flat face has no pitch curve: its curve is the profile itself and the distance 0. What
//! follows from these (profile, pressure angle, undercut, size, rolling) is common to all followers and is derived once, in
//! `profile` and `verify`.

mod bell_crank;
mod flat;
mod knife;
pub mod place;
mod placed;
mod plate_roller;
mod swinging_flat;
mod swinging_roller;
mod translating_roller;

pub use bell_crank::BellCrank;
pub use flat::FlatFace;
pub use place::FollowerPlacement;
pub use plate_roller::PlateRoller;
pub use swinging_flat::SwingingFlat;
pub use swinging_roller::SwingingRoller;
pub use translating_roller::{Crown, RollerData, TranslatingRoller};

use crate::document::Presence::{Default, Optional};
use crate::document::cams::MAKE;
use crate::document::range::{HEAVIEST, LARGEST_FORCE, LONGEST};
use crate::document::{Field, Key, KeySection, Reader, TableReader, above, within};
use crate::geometry::CurvePoint;
use crate::motion::{Jet, Quantity};
use crate::units::Dimension::{Force, Inertia, Length, Mass};
use nalgebra::Vector2;
use std::sync::Arc;

/// A kind of follower, chosen in a file by its table.
#[derive(Debug)]
pub struct FollowerKind {
    /// Its table, `[follower.roller]`.
    pub section: &'static KeySection,
    /// The quantity of its lift.
    pub quantity: Quantity,
    /// Reads it from its table.
    read: fn(&TableReader<'_>) -> Option<FollowerData>,
}

impl FollowerKind {
    /// Whether it swings about a pivot.
    #[must_use]
    pub fn swings(&self) -> bool {
        self.quantity == Quantity::Angle
    }
}

/// Every kind of follower: a new one is a file with its geometry and its table, and one line here.
pub const FOLLOWERS: &[FollowerKind] =
    &[translating_roller::KIND, swinging_roller::KIND, flat::KIND, swinging_flat::KIND, knife::KIND];

/// A follower as a file describes it.
#[derive(Debug, Clone)]
pub struct FollowerData {
    /// Path of its table, for messages.
    pub path: &'static str,
    /// The follower itself, not yet sized.
    pub shape: Arc<dyn Follower>,
    /// Mass that moves with it along its path, kg; for a swinging follower the moment of inertia about its pivot, kg·m².
    pub mass: Option<f64>,
    /// Force that presses it onto the cam in addition to the load, N.
    pub preload: Option<f64>,
    /// Increase of that force with the lift, N/m.
    pub spring_rate: f64,
    /// Radius of its roller's rim along the axis, m, where the rim is crowned.
    pub crown_radius: Option<f64>,
    /// The arm of a roller that swings, m.
    pub arm: Option<f64>,
    /// Data that only a translating roller has.
    pub roller: Option<RollerData>,
    /// Data that only a flat face has.
    pub face: Option<FaceData>,
    /// Which dimension of its place is chosen with the size of the cam.
    pub place: Option<FollowerPlacement>,
}

/// A flat face as a file describes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceData {
    /// Its width along the path of the contact, m.
    pub width: Option<f64>,
    /// What is in its middle.
    pub middle: FaceMiddle,
}

/// What is in the middle of a flat face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FaceMiddle {
    /// Its stem.
    Stem,
    /// The middle of the contact: the face is placed where the cam touches it.
    Anywhere,
}

impl FollowerData {
    /// A follower without a description of forces, roller and face.
    fn new(path: &'static str, shape: Arc<dyn Follower>) -> Self {
        Self {
            path,
            shape,
            mass: None,
            preload: None,
            spring_rate: 0.0,
            crown_radius: None,
            arm: None,
            roller: None,
            face: None,
            place: None,
        }
    }

    /// The follower inside of a cam whose metal lies around its roller; `None` where it is no roller.
    #[must_use]
    pub fn inside(&self) -> Option<Self> {
        let shape = self.shape.of_radius(-self.shape.element().offset())?;
        Some(Self { shape, place: self.place.map(FollowerPlacement::inside), ..self.clone() })
    }

    /// A translating roller with its path on the other side of the shaft; `None` for other followers, and where the path goes through the
    /// shaft.
    #[must_use]
    pub fn with_opposite_offset(&self) -> Option<Self> {
        let roller = self.roller.filter(|roller| roller.offset != 0.0)?;
        let roller = RollerData { offset: -roller.offset, ..roller };
        let shape = Arc::new(TranslatingRoller::new(1.0 + roller.offset.abs(), roller.offset, roller.radius));
        Some(Self { shape, roller: Some(roller), ..self.clone() })
    }
}

/// Mass of a follower on a straight path, a key of its table.
const MASS: Field<f64> = Field::quantity(
    "mass",
    "of everything that moves with the follower along its path; enables the check force_closure",
    Optional("40 kg"),
    Mass,
    above(0.0, HEAVIEST),
)
.also(&["weight"]);
/// Preload of a follower on a straight path, a key of its table.
const PRELOAD: Field<f64> = Field::quantity(
    "preload",
    "spring or weight that presses the follower onto the cam in addition to the air",
    Optional("1600 N"),
    Force,
    within(0.0, LARGEST_FORCE),
);
/// Moment of inertia of a follower that swings, a key of its table.
const INERTIA: Field<f64> = Field::quantity(
    "inertia",
    "moment of inertia about the pivot of everything that swings with the follower; enables the check force_closure",
    Optional("0.02 kg*m2"),
    Inertia,
    above(0.0, HEAVIEST),
);
/// Crown of a roller, a key of its table.
const CROWN_RADIUS: Field<f64> = Field::quantity(
    "crown_radius",
    "radius of a crowned rim along the roller's axis, for the contact stress; a straight rim when absent",
    Optional("500 mm"),
    Length,
    above(0.0, LONGEST),
)
.only(&[MAKE]);
const CROWN_DIAMETER: Key =
    CROWN_RADIUS.diameter("crown_diameter", "diameter of the crown, in the place of its radius", "1000 mm");

/// Offset of a roller or a knife edge on a straight path, a key of its table; `None` is `auto`.
const OFFSET: Field<Option<f64>> = Field::words_or_quantity(
    "offset",
    "distance of its path from the shaft, positive against the rotation of the cam; \"auto\" (with a motion program): that of the smallest cam",
    Default("0 mm"),
    (&["auto"], &[None]),
    (Length, within(-LONGEST, LONGEST), Some),
);

/// Width of a flat face, a key of its table.
const WIDTH: Field<f64> = Field::quantity(
    "width",
    "width of the face; enables the check face_width",
    Optional("60 mm"),
    Length,
    above(0.0, LONGEST),
);

/// The one follower of a file.
pub fn read(reader: &Reader<'_>) -> Option<FollowerData> {
    let mut given = FOLLOWERS.iter().filter_map(|kind| Some((kind, reader.find(kind.section)?)));
    let Some((kind, table)) = given.next() else {
        if !FOLLOWERS.iter().any(|kind| reader.is_explained(kind.section)) {
            reader.fail("no follower is given".into(), Some(format!("add one of the tables {}", known_tables())));
        }
        return None;
    };
    if let Some((other, _)) = given.next() {
        let message = format!("two followers: [{}] and [{}]", kind.section.path, other.section.path);
        reader.fail(message, Some(format!("a cam has one; give one of {}", known_tables())));
    }
    (kind.read)(&table)
}

fn known_tables() -> String {
    FOLLOWERS.iter().map(|kind| format!("[{}]", kind.section.path)).collect::<Vec<_>>().join(", ")
}

/// The part of the follower that touches the cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Element {
    /// A roller of this radius, m.
    Roller {
        /// Radius, m; negative of a flank that lies around its roller, as the outer one of a groove.
        radius: f64,
    },
    /// A flat face.
    Face,
}

impl Element {
    /// How far inwards of the follower's curve the profile lies, m.
    #[must_use]
    pub fn offset(self) -> f64 {
        match self {
            Element::Roller { radius } => radius,
            Element::Face => 0.0,
        }
    }
}

/// A follower at a value of the motion's parameter, m and rad, in the frame of the cam: the cam angle θ of a disc, the
/// travel or overrun x of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Point of the follower's curve: the path of a roller's centre, the profile under a flat face.
    pub curve: CurvePoint,
    /// Unit vector in which the element moves when the lift grows.
    pub drive: Vector2<f64>,
    /// Derivative of the angle of `drive` by the parameter.
    pub drive_turn: f64,
}

/// What carries the element, seen from the shaft: x along the direction in which the cam angle is counted, y at +90° to it
/// in the frame of a cam that turns clockwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Carrier {
    /// A stem on a straight path.
    Straight,
    /// A stem on a straight path that carries a face.
    Stem {
        /// Distance of the stem from the shaft along y, m.
        offset: f64,
        /// Angle of the face's normal from the path, rad.
        tilt: f64,
    },
    /// An arm about a pivot at this place, m.
    Arm {
        /// The place, m.
        pivot: Vector2<f64>,
    },
}

/// A flat face where it touches the cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceTouch {
    /// Where on the face, m: from its stem, positive against the rotation of the cam, or from its pivot.
    pub place: f64,
    /// Rate at which the face's normal turns on the cam, by the parameter: an envelope exists where it is above 0.
    pub turn: f64,
    /// Travel of the face along its normal there for a unit of lift, m/m or m/rad.
    pub along_normal: f64,
}

/// A follower outside the cam.
pub trait Follower: std::fmt::Debug + Send + Sync {
    /// The element that touches the cam.
    fn element(&self) -> Element;

    /// Whether it takes a lift in metres or in radians.
    fn quantity(&self) -> Quantity {
        Quantity::Length
    }

    /// The follower at a value of the parameter for the lift there.
    fn touch(&self, parameter: f64, lift: &Jet) -> Touch;

    /// The follower where sine and cosine of the parameter are known, for several lifts at one place.
    fn touch_turned(&self, parameter: f64, _sin: f64, _cos: f64, lift: &Jet) -> Touch {
        self.touch(parameter, lift)
    }

    /// Only the point of the curve and the drive, where sine and cosine of the parameter are known.
    fn point_turned(&self, parameter: f64, sin: f64, cos: f64, lift: &Jet) -> (Vector2<f64>, Vector2<f64>) {
        let Touch { curve, drive, .. } = self.touch_turned(parameter, sin, cos, lift);
        (curve.point, drive)
    }

    /// The parameter at which a point of the follower's curve (m, seen from the cam) is reached, whatever the lift: the
    /// inverse of the curve. For a roller it follows from the point, for a face from the outward normal of the cam there. NaN for a
    /// point that is never reached.
    fn parameter_of(&self, point: Vector2<f64>, outward: Vector2<f64>) -> f64;

    /// Smallest radius of its curve, at lift 0, about the shaft, m: the prime radius of a roller, the base radius of a face.
    /// `None` where the cam has no such radius.
    fn prime_radius(&self) -> Option<f64> {
        None
    }

    /// Travel of the point of its curve along the drive for a unit of lift, m/m or m/rad.
    fn leverage(&self, _lift: &Jet) -> f64 {
        1.0
    }

    /// Derivatives by the parameter, at a lift, of the speed of its curve, and of the rate at which its drive turns; `None` where they are not known.
    fn speed_slopes(&self, _lift: &Jet) -> Option<[f64; 2]> {
        None
    }

    /// Whether it is symmetric, so that the mirrored motion gives the mirrored curve.
    fn is_symmetric(&self) -> bool {
        false
    }

    /// How a flat face touches at a lift; `None` for a roller.
    fn on_face(&self, _lift: &Jet) -> Option<FaceTouch> {
        None
    }

    /// What carries the element, for a picture of it.
    fn carrier(&self) -> Carrier {
        Carrier::Straight
    }

    /// Which dimension of its place may be chosen with the size of the cam; `None` where there is none.
    fn place(&self) -> Option<FollowerPlacement> {
        None
    }

    /// The follower on a cam with another prime radius, m; `None` where it cannot reach.
    fn sized(&self, _prime_radius: f64) -> Option<Box<dyn Follower>> {
        None
    }

    /// A roller of another radius on the same path, m; negative where the metal lies around it. `None` where it is no roller.
    fn of_radius(&self, _radius: f64) -> Option<Arc<dyn Follower>> {
        None
    }

    /// The prime radii it can have, m: above 0, or the offset of a roller; up to infinity, or the reach of an arm.
    fn prime_radii(&self) -> (f64, f64) {
        (0.0, f64::INFINITY)
    }

    /// The lifts it can follow, m or rad.
    fn reach(&self) -> (f64, f64) {
        (f64::NEG_INFINITY, f64::INFINITY)
    }
}

#[cfg(test)]
mod tests;

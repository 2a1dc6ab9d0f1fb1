//! The translating roller, centred or offset.

use super::{
    CROWN_DIAMETER, CROWN_RADIUS, Element, Follower, FollowerData, FollowerKind, FollowerPlacement, MASS, PRELOAD,
    Touch,
};
use crate::document::Presence::{Default, Optional, Required};
use crate::document::cams::{SURFACES, TURNING};
use crate::document::range::LONGEST;
use crate::document::{Field, Key, KeySection, Occurrence, TableReader, above};
use crate::geometry::CurvePoint;
use crate::motion::{Jet, Quantity};
use crate::units::Dimension::Length;
use nalgebra::Vector2;
use std::sync::Arc;

/// Shape of a roller's rim along its axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crown {
    /// A sphere of the roller's radius.
    Sphere,
    /// Straight.
    Cylinder,
}

/// The translating roller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollerData {
    /// Radius, m.
    pub radius: f64,
    /// Offset of its path from the shaft, m.
    pub offset: f64,
    /// Shape of its rim on a conoid.
    pub crown: Crown,
    /// Width of a cylindrical rim, m.
    pub width: Option<f64>,
}

const RADIUS: Field<f64> =
    Field::quantity("radius", "radius of the roller", Required("30 mm"), Length, above(0.0, LONGEST))
        .also(&["size", "r"]);
const DIAMETER: Key = RADIUS.diameter("diameter", "diameter of the roller, in the place of its radius", "60 mm");
const OFFSET: Field<Option<f64>> = super::OFFSET.only(TURNING);
const CROWN: Field<Crown> = Field::words(
    "crown",
    "shape of its rim: \"sphere\", or \"cylinder\", which needs a width and is checked for edge contact",
    Default("sphere"),
    &["sphere", "cylinder"],
    &[Crown::Sphere, Crown::Cylinder],
)
.only(SURFACES);
const WIDTH: Field<f64> =
    Field::quantity("width", "width of a cylindrical rim", Optional("20 mm"), Length, above(0.0, LONGEST))
        .only(SURFACES);

/// `[follower.roller]`.
pub(super) const KIND: FollowerKind = FollowerKind { section: &SECTION, quantity: Quantity::Length, read };

const SECTION: KeySection = KeySection {
    path: "follower.roller",
    about: "the follower: a translating roller",
    occurs: Occurrence::Optional,
    cams: &[],
    keys: &[
        RADIUS.key,
        DIAMETER,
        OFFSET.key,
        MASS.key,
        PRELOAD.key,
        CROWN.key,
        WIDTH.key,
        CROWN_RADIUS.key,
        CROWN_DIAMETER,
    ],
};

fn read(table: &TableReader<'_>) -> Option<FollowerData> {
    let crown = table.get(&CROWN);
    if crown == Some(Crown::Cylinder) && !table.has(&WIDTH) {
        let help = Some("add follower.roller.width".into());
        table.fail(&CROWN, "a cylindrical roller needs a width".into(), help);
    }
    let (radius, given) = (table.get(&RADIUS)?, table.get(&OFFSET)?);
    let (offset, place) = (given.unwrap_or(0.0), given.is_none().then_some(FollowerPlacement::Offset { radius }));
    // Replaced when the cam is sized; until then large enough to reach.
    let shape = Arc::new(TranslatingRoller::new(1.0 + offset.abs(), offset, radius));
    let roller = RollerData { radius, offset, crown: crown?, width: table.get(&WIDTH) };
    let (mass, preload, crown_radius) = (table.get(&MASS), table.get(&PRELOAD), table.get(&CROWN_RADIUS));
    let roller = Some(roller);
    Some(FollowerData { mass, preload, crown_radius, roller, place, ..FollowerData::new(SECTION.path, shape) })
}

/// By which share the prime radius must exceed the offset: at the offset itself the roller would be at the side of
/// the cam, with a pressure angle of 90°.
const OFFSET_MARGIN: f64 = 1e-6;

/// A roller on a straight path at distance `offset` from the shaft.
///
/// Its centre is u·û(θ) + ε·n̂(θ), u = √(R_p² − ε²) + s, û the direction of the path and n̂ = û turned by +90°; ε > 0
/// lies along the follower's apparent motion, against the rotation of the cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TranslatingRoller {
    prime_radius: f64,
    offset: f64,
    roller_radius: f64,
    /// √(R_p² − ε²), m.
    height: f64,
}

impl TranslatingRoller {
    /// Prime radius, offset and roller radius in m; |offset| < prime radius.
    #[must_use]
    pub fn new(prime_radius: f64, offset: f64, roller_radius: f64) -> Self {
        let height = ((prime_radius - offset) * (prime_radius + offset)).sqrt();
        Self { prime_radius, offset, roller_radius, height }
    }
}

impl Follower for TranslatingRoller {
    fn element(&self) -> Element {
        Element::Roller { radius: self.roller_radius }
    }

    fn touch(&self, angle: f64, lift: &Jet) -> Touch {
        let (sin, cos) = libm::sincos(angle);
        self.touch_turned(angle, sin, cos, lift)
    }

    fn touch_turned(&self, _: f64, sin: f64, cos: f64, lift: &Jet) -> Touch {
        let along = Vector2::new(cos, sin);
        let across = Vector2::new(-sin, cos);
        let (offset, u) = (self.offset, self.height + lift.s);
        // û' = n̂ and n̂' = −û.
        let curve = CurvePoint::from_derivatives(
            along * u + across * offset,
            along * (lift.ds - offset) + across * u,
            along * (lift.dds - u) + across * (2.0 * lift.ds - offset),
            along * (lift.ddds - 3.0 * lift.ds + offset) + across * (3.0 * lift.dds - u),
        );
        Touch { curve, drive: along, drive_turn: 1.0 }
    }

    fn point_turned(&self, _: f64, sin: f64, cos: f64, lift: &Jet) -> (Vector2<f64>, Vector2<f64>) {
        let along = Vector2::new(cos, sin);
        (along * (self.height + lift.s) + Vector2::new(-sin, cos) * self.offset, along)
    }

    fn parameter_of(&self, centre: Vector2<f64>, _: Vector2<f64>) -> f64 {
        let height = ((centre.norm() - self.offset) * (centre.norm() + self.offset)).max(0.0).sqrt();
        libm::atan2(centre.y, centre.x) - libm::atan2(self.offset, height)
    }

    fn is_symmetric(&self) -> bool {
        self.offset == 0.0
    }

    fn prime_radius(&self) -> Option<f64> {
        Some(self.prime_radius)
    }

    fn place(&self) -> Option<FollowerPlacement> {
        Some(FollowerPlacement::Offset { radius: self.roller_radius })
    }

    /// |C'|² = (s' − ε)² + u², u = √(R_p² − ε²) + s; the drive turns with the cam.
    fn speed_slopes(&self, lift: &Jet) -> Option<[f64; 2]> {
        let (across, along) = (lift.ds - self.offset, self.height + lift.s);
        Some([(across * lift.dds + along * lift.ds) / libm::hypot(across, along), 0.0])
    }

    fn sized(&self, prime_radius: f64) -> Option<Box<dyn Follower>> {
        (self.offset.abs() < prime_radius)
            .then(|| Box::new(Self::new(prime_radius, self.offset, self.roller_radius)) as Box<dyn Follower>)
    }

    fn of_radius(&self, radius: f64) -> Option<Arc<dyn Follower>> {
        Some(Arc::new(Self { roller_radius: radius, ..*self }))
    }

    fn prime_radii(&self) -> (f64, f64) {
        (self.offset.abs() * (1.0 + OFFSET_MARGIN), f64::INFINITY)
    }
}

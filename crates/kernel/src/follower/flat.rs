//! The flat face on a straight path, square to it or tilted.

use super::{
    Carrier, Element, FaceData, FaceMiddle, FaceTouch, Follower, FollowerData, FollowerKind, MASS, PRELOAD, Touch,
    WIDTH,
};
use crate::document::Presence::Default;
use crate::document::cams::MAKE;
use crate::document::range::LONGEST;
use crate::document::{Field, KeySection, Occurrence, TableReader, within};
use crate::geometry::CurvePoint;
use crate::motion::{Jet, Quantity};
use crate::units::Dimension::{Angle, Length};
use nalgebra::Vector2;
use std::f64::consts::FRAC_PI_3;
use std::sync::Arc;

/// Largest tilt, rad: the pressure angle is equal to it, and beyond it a stem jams in its guide.
const STEEPEST: f64 = FRAC_PI_3;

const TILT: Field<f64> = Field::quantity(
    "tilt",
    "angle of the face's normal from its path, positive against the rotation of the cam, -60 deg to 60 deg",
    Default("0 deg"),
    Angle,
    within(-STEEPEST, STEEPEST),
);
const OFFSET: Field<f64> = Field::quantity(
    "offset",
    "distance of its stem from the shaft, positive against the rotation of the cam; the profile does not depend on it",
    Default("0 mm"),
    Length,
    within(-LONGEST, LONGEST),
);

/// `[follower.flat]`.
pub(super) const KIND: FollowerKind = FollowerKind { section: &SECTION, quantity: Quantity::Length, read };

const SECTION: KeySection = KeySection {
    path: "follower.flat",
    about: "the follower: a flat face on a straight path, square to it or tilted",
    occurs: Occurrence::Optional,
    cams: &[MAKE],
    keys: &[TILT.key, OFFSET.key, WIDTH.key, MASS.key, PRELOAD.key],
};

fn read(table: &TableReader<'_>) -> Option<FollowerData> {
    // Replaced when the cam is sized.
    let shape = FlatFace::tilted(1.0, table.get(&TILT)?, table.get(&OFFSET)?);
    let face = FaceData { width: table.get(&WIDTH), middle: FaceMiddle::Stem };
    let (mass, preload) = (table.get(&MASS), table.get(&PRELOAD));
    Some(FollowerData { mass, preload, face: Some(face), ..FollowerData::new(SECTION.path, Arc::new(shape)) })
}

/// A face whose normal N has the angle β = θ + δ, and whose distance from the shaft is p = R_b + s cos δ. The profile is the
/// envelope of its lines: with T = N turned by +90°,
///
/// ```text
/// P = p N + p' T = p N + s' cos δ T,   P' = ρ T,   ρ = p + p'' = R_b + (s + s'') cos δ
/// ```
///
/// The stem, parallel to û at the distance e along n̂, meets the face at F = h û + e n̂ with F·N = p, so that
/// F·T = e/cos δ − p tan δ, and the contact is
///
/// ```text
/// (P − F)·T = s' cos δ + s sin δ + (R_b sin δ − e)/cos δ
/// ```
///
/// away from it along the face. The direction of motion is û, at −δ from N: the pressure angle is −δ everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlatFace {
    base_radius: f64,
    tilt: f64,
    offset: f64,
    /// sin δ and cos δ.
    sine: f64,
    cosine: f64,
}

impl FlatFace {
    /// Square to its path, with the stem in line with the shaft, on a cam of a base radius, m.
    #[must_use]
    pub fn new(base_radius: f64) -> Self {
        Self::tilted(base_radius, 0.0, 0.0)
    }

    /// Its normal at an angle (rad, below a quarter turn) from its path, its stem at a distance from the shaft (m), both positive
    /// against the rotation of the cam; on a cam of a base radius, m.
    #[must_use]
    pub fn tilted(base_radius: f64, tilt: f64, offset: f64) -> Self {
        Self { base_radius, tilt, offset, sine: libm::sin(tilt), cosine: libm::cos(tilt) }
    }
}

impl Follower for FlatFace {
    fn element(&self) -> Element {
        Element::Face
    }

    fn touch(&self, angle: f64, lift: &Jet) -> Touch {
        let (sin, cos) = libm::sincos(angle + self.tilt);
        let (normal, along) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
        let support = self.base_radius + lift.s * self.cosine;
        // P' = ρ T: ρ is the speed, negative where the profile has turned back on itself.
        let radius = support + lift.dds * self.cosine;
        let curve = CurvePoint {
            point: normal * support + along * (lift.ds * self.cosine),
            tangent: along,
            speed: radius,
            curvature: 1.0 / radius,
            curvature_slope: -(lift.ds + lift.ddds) * self.cosine / (radius * radius * radius),
        };
        Touch { curve, drive: Vector2::new(libm::cos(angle), libm::sin(angle)), drive_turn: 1.0 }
    }

    fn parameter_of(&self, _: Vector2<f64>, outward: Vector2<f64>) -> f64 {
        libm::atan2(outward.y, outward.x) - self.tilt
    }

    fn is_symmetric(&self) -> bool {
        self.tilt == 0.0
    }

    fn prime_radius(&self) -> Option<f64> {
        Some(self.base_radius)
    }

    fn on_face(&self, lift: &Jet) -> Option<FaceTouch> {
        let at_rest = (self.base_radius * self.sine - self.offset) / self.cosine;
        let place = lift.ds * self.cosine + lift.s * self.sine + at_rest;
        Some(FaceTouch { place, turn: 1.0, along_normal: self.cosine })
    }

    fn carrier(&self) -> Carrier {
        Carrier::Stem { offset: self.offset, tilt: self.tilt }
    }

    fn sized(&self, prime_radius: f64) -> Option<Box<dyn Follower>> {
        Some(Box::new(Self { base_radius: prime_radius, ..*self }))
    }
}

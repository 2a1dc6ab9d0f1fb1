//! The flat face on a straight path, square to it.

use super::{Element, Follower, FollowerData, FollowerKind, MASS, PRELOAD, Touch};
use crate::document::cams::MAKE;
use crate::document::{Occurs, Section, Table};
use crate::geometry::CurvePoint;
use crate::motion::Jet;
use nalgebra::Vector2;
use std::sync::Arc;

/// `[follower.flat]`.
pub(super) const KIND: FollowerKind = FollowerKind { section: &SECTION, read };

const SECTION: Section = Section {
    path: "follower.flat",
    about: "the follower: a flat face, square to its straight path",
    occurs: Occurs::Optional,
    cams: &[MAKE],
    keys: &[MASS.key, PRELOAD.key],
};

fn read(table: &Table<'_>) -> Option<FollowerData> {
    // Made for a size when the cam is sized.
    let shape = Arc::new(FlatFace { base_radius: 1.0 });
    Some(FollowerData {
        path: SECTION.path,
        shape,
        mass: table.get(&MASS),
        preload: table.get(&PRELOAD),
        spring_rate: 0.0,
        roller: None,
    })
}

/// A face whose distance from the shaft is p = R_b + s: the profile is the envelope of its lines,
/// P = p û + s' n̂, with the radius of curvature ρ = p + s''.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlatFace {
    base_radius: f64,
}

impl FlatFace {
    /// On a cam of a base radius, m.
    #[must_use]
    pub fn new(base_radius: f64) -> Self {
        Self { base_radius }
    }
}

impl Follower for FlatFace {
    fn element(&self) -> Element {
        Element::Face
    }

    fn touch(&self, angle: f64, lift: &Jet) -> Touch {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        let (along, across) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
        let support = self.base_radius + lift.s;
        // P' = ρ n̂: ρ is the speed, negative where the profile has turned back on itself.
        let radius = support + lift.dds;
        let curve = CurvePoint {
            point: along * support + across * lift.ds,
            tangent: across,
            speed: radius,
            curvature: 1.0 / radius,
            curvature_slope: -(lift.ds + lift.ddds) / (radius * radius * radius),
        };
        Touch { curve, drive: along, drive_turn: 1.0 }
    }

    fn parameter_of(&self, _: Vector2<f64>, outward: Vector2<f64>) -> f64 {
        libm::atan2(outward.y, outward.x)
    }

    fn prime_radius(&self) -> Option<f64> {
        Some(self.base_radius)
    }

    fn sized(&self, prime_radius: f64) -> Option<Box<dyn Follower>> {
        Some(Box::new(Self { base_radius: prime_radius }))
    }
}

//! The swinging flat face: a straight face on an arm about a pivot.

use super::{
    Carrier, Element, FaceData, FaceMiddle, FaceTouch, Follower, FollowerData, FollowerKind, INERTIA, Touch, WIDTH,
};
use crate::document::Presence::{Default, Required};
use crate::document::cams::MAKE;
use crate::document::range::LONGEST;
use crate::document::{Field, KeySection, Occurrence, TableReader, above, within};
use crate::geometry::CurvePoint;
use crate::motion::{Jet, Quantity};
use crate::units::Dimension::Length;
use nalgebra::Vector2;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::sync::Arc;

const PIVOT_DISTANCE: Field<f64> =
    Field::quantity("pivot_distance", "from the shaft to the pivot", Required("150 mm"), Length, above(0.0, LONGEST));
const FACE_OFFSET: Field<f64> = Field::quantity(
    "face_offset",
    "distance of the face from its pivot, positive towards the cam; below pivot_distance",
    Default("0 mm"),
    Length,
    within(-LONGEST, LONGEST),
);

const SIDE: Field<f64> = Field::words(
    "side",
    "\"trailing\" (the contact behind its pivot, seen in the rotation of the cam) or \"leading\"",
    Default("trailing"),
    &["trailing", "leading"],
    &[1.0, -1.0],
);

/// `[follower.swinging-flat]`.
pub(super) const KIND: FollowerKind = FollowerKind { section: &SECTION, quantity: Quantity::Angle, read };

const SECTION: KeySection = KeySection {
    path: "follower.swinging-flat",
    about: "the follower: a flat face on a swinging arm",
    occurs: Occurrence::Optional,
    cams: &[MAKE],
    keys: &[PIVOT_DISTANCE.key, FACE_OFFSET.key, SIDE.key, WIDTH.key, INERTIA.key],
};

fn read(table: &TableReader<'_>) -> Option<FollowerData> {
    let (pivot_distance, face_offset) = (table.get(&PIVOT_DISTANCE), table.get(&FACE_OFFSET));
    if let (Some(distance), Some(offset)) = (pivot_distance, face_offset)
        && offset >= distance
    {
        let (offset, distance) = (table.typed(&FACE_OFFSET), table.typed(&PIVOT_DISTANCE));
        let help = Some("the face would lie beyond the shaft".into());
        table.fail(&FACE_OFFSET, format!("face_offset must be below pivot_distance: {offset} ≥ {distance}"), help);
        return None;
    }
    let shape = SwingingFlat::new(pivot_distance?, face_offset?, table.get(&SIDE)?);
    let face = FaceData { width: table.get(&WIDTH), middle: FaceMiddle::Anywhere };
    Some(FollowerData {
        mass: table.get(&INERTIA),
        face: Some(face),
        ..FollowerData::new(SECTION.path, Arc::new(shape))
    })
}

/// By which share the base radius must stay below the reach of the face, and the arm short of where the contact
/// would come to the pivot.
const REACH_MARGIN: f64 = 1e-6;

/// A face at the distance f from a pivot at a·û(θ), towards the cam.
///
/// ψ = ψ0 + lift is the angle at the pivot between the face and the line of centres. The normal N of the face has the direction
/// β = θ + τ (ψ − π/2), τ = 1 for a face behind its pivot (trailing), −1 for one before it. The pivot lies a û·N = a sin ψ from the
/// shaft along N, so that the face has the distance p = a sin ψ − f, and sin ψ0 = (R_b + f)/a. The profile is the envelope of its
/// lines: with T = N turned by +90°, β' = 1 + τ ψ' and q = p'/β' = a cos ψ ψ'/β',
///
/// ```text
/// P = p N + q T,   P' = (p β' + q') T = ρ β' T,   ρ = p + q'/β' = p + a G/β'³,   G = cos ψ ψ'' − sin ψ ψ'² β'
/// ```
///
/// The pivot is at τ a cos ψ along T, so that the contact is ℓ = a cos ψ − τ q = a cos ψ/β' away from it along −τ T. The face
/// turns about its pivot with τ: the contact moves along ℓ N − τ f T, and tan α = −τ f/ℓ. All this needs β' > 0: else the face
/// turns backwards on the cam, and its positions have no envelope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SwingingFlat {
    pivot_distance: f64,
    face_offset: f64,
    side: f64,
    base_radius: f64,
    /// ψ0, rad.
    start: f64,
}

impl SwingingFlat {
    /// Pivot distance and face offset in m, the offset the smaller; side 1 trailing, −1 leading. Until the cam is sized, its face is at 45°
    /// to the line of shaft and pivot.
    #[must_use]
    pub fn new(pivot_distance: f64, face_offset: f64, side: f64) -> Self {
        let base_radius = pivot_distance * libm::sin(FRAC_PI_4) - face_offset;
        Self { pivot_distance, face_offset, side, base_radius, start: FRAC_PI_4 }
    }

    /// ℓ and its derivative by the parameter, m.
    fn lever(&self, lift: &Jet) -> (f64, f64) {
        let psi = self.start + lift.s;
        let (sin, cos) = libm::sincos(psi);
        let turn = 1.0 + self.side * lift.ds;
        let lever = self.pivot_distance * cos / turn;
        (lever, -(self.pivot_distance * sin * lift.ds + lever * self.side * lift.dds) / turn)
    }
}

impl Follower for SwingingFlat {
    fn element(&self) -> Element {
        Element::Face
    }

    fn quantity(&self) -> Quantity {
        Quantity::Angle
    }

    fn touch(&self, angle: f64, lift: &Jet) -> Touch {
        let (a, f, t) = (self.pivot_distance, self.face_offset, self.side);
        let psi = self.start + lift.s;
        let (sp, cp) = libm::sincos(psi);
        let [d1, d2, d3] = [lift.ds, lift.dds, lift.ddds];
        let heading = angle + t * (psi - FRAC_PI_2);
        let (sin, cos) = libm::sincos(heading);
        let (normal, along) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
        let turn = 1.0 + t * d1;
        let cube = turn * turn * turn;
        let support = a * sp - f;
        let bend = cp * d2 - sp * d1 * d1 * turn;
        let radius = support + a * bend / cube;
        // G' by the product rule, with β'' = τ ψ''.
        let bend_slope = cp * d3 - sp * d1 * d2 * (1.0 + 2.0 * turn) - cp * d1 * d1 * d1 * turn - sp * d1 * d1 * t * d2;
        let radius_slope = a * (cp * d1 + (bend_slope - 3.0 * bend * t * d2 / turn) / cube);
        let curve = CurvePoint {
            point: normal * support + along * (a * cp * d1 / turn),
            tangent: along,
            speed: radius * turn,
            curvature: 1.0 / radius,
            curvature_slope: -radius_slope / (turn * radius * radius * radius),
        };
        let (lever, lever_slope) = self.lever(lift);
        let reach = (lever * lever + f * f).sqrt();
        // The direction of motion is at atan2(−τ f, ℓ) from the normal.
        Touch {
            curve,
            drive: normal * (lever / reach) - along * (t * f / reach),
            drive_turn: turn + t * f * lever_slope / (reach * reach),
        }
    }

    fn leverage(&self, lift: &Jet) -> f64 {
        libm::hypot(self.lever(lift).0, self.face_offset)
    }

    /// The normal gives β, the distance of its line p, and that ψ.
    fn parameter_of(&self, point: Vector2<f64>, outward: Vector2<f64>) -> f64 {
        let psi = libm::asin((point.dot(&outward) + self.face_offset) / self.pivot_distance);
        libm::atan2(outward.y, outward.x) - self.side * (psi - FRAC_PI_2)
    }

    fn on_face(&self, lift: &Jet) -> Option<FaceTouch> {
        let lever = self.lever(lift).0;
        Some(FaceTouch { place: lever, turn: 1.0 + self.side * lift.ds, along_normal: lever })
    }

    fn carrier(&self) -> Carrier {
        Carrier::Arm { pivot: Vector2::new(self.pivot_distance, 0.0) }
    }

    fn prime_radius(&self) -> Option<f64> {
        Some(self.base_radius)
    }

    fn sized(&self, prime_radius: f64) -> Option<Box<dyn Follower>> {
        let (least, largest) = self.prime_radii();
        if !(least..=largest).contains(&prime_radius) {
            return None;
        }
        let start = libm::asin((prime_radius + self.face_offset) / self.pivot_distance);
        Some(Box::new(Self { base_radius: prime_radius, start, ..*self }))
    }

    fn prime_radii(&self) -> (f64, f64) {
        let (a, f) = (self.pivot_distance, self.face_offset);
        ((-f).max(0.0) * (1.0 + REACH_MARGIN), (a - f) * (1.0 - REACH_MARGIN))
    }

    /// ψ stays between 0 and π/2, where the contact reaches the pivot.
    fn reach(&self) -> (f64, f64) {
        (-self.start, FRAC_PI_2 * (1.0 - REACH_MARGIN) - self.start)
    }
}

//! Places of a profile for a measuring machine: numbered, each with its normal, the centre of a probing ball that touches there, and its zone.

use crate::body::part_tolerance::PartTolerance;
use crate::body::{Body, Request};
use crate::machine::Rotation;
use camgen_kernel::geometry::{MILLIMETRES, radius_of_curvature};
use nalgebra::Vector2;

/// Places of a cut, one for each degree of the cam.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct InspectionList {
    /// Which of the cuts of its body they are on.
    pub cut: usize,
    /// Radius of the ball, mm.
    pub ball_radius: f64,
    /// How far the profile may lie from its place along the normal, either way, mm.
    pub zone: f64,
    /// The places.
    pub places: Vec<InspectionPlace>,
}

/// A place of a profile, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct InspectionPlace {
    /// Cam angle of the contact of the follower, degrees.
    pub cam_deg: f64,
    /// Angle of the place about the shaft on the drawing, degrees.
    pub polar_deg: f64,
    /// The place.
    pub point: Vector2<f64>,
    /// Unit normal out of the metal.
    pub normal: Vector2<f64>,
    /// Radius of curvature, positive where convex; infinite where straight.
    pub radius: f64,
}

/// Places over a turn.
const PLACES: u32 = 360;

/// Why a cam has no list of places.
pub(super) fn unfit(body: &dyn Body) -> Option<&'static str> {
    let turns = body.cuts().iter().all(|cut| cut.curves.is_some_and(|curves| curves.motion.period().is_some()));
    (!turns || body.cuts().is_empty())
        .then_some("a place is numbered by the angle of a cam that turns and has one outline over its thickness")
}

/// The lists for every cut of a body; none where they were not requested.
pub(super) fn lists(body: &dyn Body, request: &Request) -> Vec<InspectionList> {
    let Some(asked) = request.inspection.filter(|_| unfit(body).is_none()) else { return Vec::new() };
    let zone = 0.5 * PartTolerance::of(body).width;
    let flipped = body.machine().cam.rotation == Rotation::CounterClockwise;
    let turned = |v: Vector2<f64>| if flipped { Vector2::new(v.x, -v.y) } else { v };
    let cuts = body.cuts();
    let of = |(cut, curves): (usize, camgen_kernel::profile::Curves<'_>)| {
        let place = |step: u32| {
            let cam_deg = 360.0 * f64::from(step) / f64::from(PLACES);
            let (piece, angle) = curves.motion.locate(cam_deg.to_radians());
            let found = curves.profile(piece, angle);
            let normal = found.outward() * curves.metal_side();
            let point = turned(found.point * MILLIMETRES);
            let polar = libm::atan2(point.y, point.x).to_degrees();
            InspectionPlace {
                cam_deg,
                polar_deg: if polar < 0.0 { polar + 360.0 } else { polar },
                point,
                normal: turned(normal),
                radius: radius_of_curvature(curves.metal_side() * found.curvature),
            }
        };
        let (ball_radius, zone) = (MILLIMETRES * asked.ball_radius, MILLIMETRES * zone);
        InspectionList { cut, ball_radius, zone, places: (0..PLACES).map(place).collect() }
    };
    cuts.iter().enumerate().filter_map(|(index, cut)| Some(of((index, cut.curves?)))).collect()
}

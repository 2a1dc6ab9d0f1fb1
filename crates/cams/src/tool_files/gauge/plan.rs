//! The lift of a gauge follower: a ball, a roller or a flat face that is guided on a line through the axis of the cam, as measuring
//! instruments for camshafts have it, whatever the follower of the cam itself.
//!
//! A ball or a roller of radius r whose centre moves along the direction u keeps clear of a point q of the profile where the centre is at least
//! q·u + √(r² − (q×u)²) from the axis; a face perpendicular to u at least q·u. The follower rests at the largest of these over the profile. The
//! largest value of a smooth function is found to rounding even where its place is found to half of the digits.

use crate::body::{Body, Cut, Gauge, Request};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::Curves;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// The lift of a gauge follower, one row for each degree of the cam.
#[derive(Debug, Clone, PartialEq)]
pub struct GaugeTable {
    /// Which of the cuts of its body it runs on.
    pub cut: usize,
    /// The follower.
    pub gauge: Gauge,
    /// Cam angle, degrees, and distance of the centre, or of the face, from the axis, mm.
    pub rows: Vec<[f64; 2]>,
}

/// Rows over a turn.
const ROWS: u32 = 360;
/// Places of the profile in a radian of each piece of the motion, and the fewest of a piece.
const PER_RADIAN: f64 = 1200.0;
const FEWEST: u32 = 16;
/// Steps in which the place of contact is narrowed down by the golden section.
const STEPS: u32 = 48;
/// Puts points beside the follower behind those on which it may rest.
const FAR: f64 = 1e6;
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Why a cam has no table for a gauge follower.
pub(super) fn unfit(body: &dyn Body) -> Option<&'static str> {
    let cuts = body.cuts();
    let turns = cuts.iter().all(|cut| cut.curves.is_some_and(|curves| curves.motion.period().is_some()));
    let outside = cuts.first().is_some_and(|cut| !cut.is_hollow());
    if cuts.is_empty() || !turns {
        return Some("a gauge follower runs on a cam that turns and has one outline over its thickness");
    }
    if cuts.iter().any(Cut::is_undercut) {
        return Some("its profile is undercut");
    }
    (!outside).then_some("a gauge follower runs on the outside of a cam")
}

/// The distance of a follower that rests on a point, in a direction; `None` where the point is beside it.
pub(super) fn rests_on(gauge: Gauge, point: Vector2<f64>, direction: Vector2<f64>) -> Option<f64> {
    let (along, across) = (point.dot(&direction), direction.perp(&point));
    match gauge {
        Gauge::Flat => Some(along),
        Gauge::Round(radius) => {
            let radius = MILLIMETRES * radius;
            (across.abs() <= radius).then(|| along + ((radius - across) * (radius + across)).sqrt())
        }
    }
}

/// The table of a body, by the cam angle, which runs against the rotation of the cam; `None` where it was not requested.
#[must_use]
pub fn table(body: &dyn Body, request: &Request) -> Option<GaugeTable> {
    let gauge = request.gauge.filter(|_| unfit(body).is_none())?;
    let curves = body.cuts().first()?.curves?;
    let profile = SampledProfile::of(curves);
    let row = |step: u32| {
        let cam_deg = 360.0 * f64::from(step) / f64::from(ROWS);
        Some([cam_deg, profile.distance(gauge, cam_deg.to_radians())?])
    };
    Some(GaugeTable { cut: 0, gauge, rows: (0..ROWS).map(row).collect::<Option<_>>()? })
}

/// The profile of a clockwise cam at many places.
struct SampledProfile<'a> {
    curves: Curves<'a>,
    /// Piece, parameter, the step to the next place of the piece, and the point, mm.
    places: Vec<(usize, f64, f64, Vector2<f64>)>,
}

impl<'a> SampledProfile<'a> {
    fn of(curves: Curves<'a>) -> Self {
        let mut places = Vec::new();
        for (piece, own) in curves.motion.pieces().iter().enumerate() {
            let length = own.end - own.start;
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few thousand places")]
            let count = ((length * PER_RADIAN).min(TAU * PER_RADIAN) as u32).max(FEWEST);
            let step = length / f64::from(count);
            places.extend((0..=count).map(|index| {
                let at = own.start + step * f64::from(index);
                (piece, at, step, MILLIMETRES * curves.profile(piece, at).point)
            }));
        }
        Self { curves, places }
    }

    /// Where a follower in the direction of a cam angle rests, mm from the axis.
    fn distance(&self, gauge: Gauge, angle: f64) -> Option<f64> {
        let (sin, cos) = libm::sincos(angle);
        let direction = Vector2::new(cos, sin);
        // Beside a follower that is smaller than the steps the nearest points lead to it.
        let beside = |point: Vector2<f64>| {
            if point.dot(&direction) > 0.0 { -FAR * direction.perp(&point).abs() } else { f64::NEG_INFINITY }
        };
        let at = |point: Vector2<f64>| rests_on(gauge, point, direction).unwrap_or_else(|| beside(point));
        let valued = self.places.iter().map(|place| (at(place.3), place));
        let (_, best) = valued.max_by(|a, b| a.0.total_cmp(&b.0))?;
        let (piece, middle, step, point) = *best;
        let own = self.curves.motion.pieces().get(piece)?;
        let (mut low, mut high) = ((middle - step).max(own.start), (middle + step).min(own.end));
        let value = |parameter: f64| at(MILLIMETRES * self.curves.profile(piece, parameter).point);
        let mut largest = at(point);
        let [mut left, mut right] = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        let (mut at_left, mut at_right) = (value(left), value(right));
        for _ in 0..STEPS {
            largest = largest.max(at_left).max(at_right);
            if at_left > at_right {
                (high, right, at_right) = (right, left, at_left);
                left = high - GOLDEN * (high - low);
                at_left = value(left);
            } else {
                (low, left, at_left) = (left, right, at_right);
                right = low + GOLDEN * (high - low);
                at_right = value(right);
            }
        }
        Some(largest).filter(|largest| *largest > 0.0)
    }
}

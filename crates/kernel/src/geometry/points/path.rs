//! The exact curve that a table of points represents, by a length that runs on from stretch to stretch.

use super::{Interpolant, not_around};
use crate::geometry::CurvePoint;
use crate::geometry::boundary::Boundary;
use crate::numeric::{quadrature, root};
use crate::refusal::Refusal;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Rows nearer to each other along the curve lie at one place, mm: above the rounding of their coordinates.
const SAME_ROW: f64 = 1e-6;
/// Stretches shorter than this are ignored, mm.
const NO_LENGTH: f64 = 1e-12;
/// Places in a stretch at which the direction about the shaft is checked for polar coordinates.
const LOOKED_AT: u32 = 8;
/// A stretch whose ends and middle have equal distances from the shaft, and whose curvature is the inverse, to this share is a
/// circle about the shaft.
const ROUND: f64 = 1e-11;

/// Places along an open curve from which the one nearest to a row is found, and steps of doing that.
const LOOKED_ALONG: u32 = 8192;
const REFINED: u32 = 12;
/// So near to its ends the first and the last row of an open curve must be, mm: above the rounding of three decimals.
const AT_END: f64 = 1e-3;

/// Curvatures that differ by more than this share of the larger count as a jump.
const JUMP: f64 = 1e-6;

/// A stretch with the length at which it starts.
#[derive(Debug, Clone, Copy)]
struct PathPart {
    /// Its number in the boundary.
    index: usize,
    /// Its parameter at either end.
    from: f64,
    to: f64,
    /// Length from the start of the curve to its own start, and its own length, mm.
    start: f64,
    length: f64,
    /// Polar angle at either end, counted on round the shaft, rad.
    angles: (f64, f64),
}

/// A place on the curve: the number of a stretch, and its parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PathPlace {
    pub(super) part: usize,
    pub(super) parameter: f64,
}

/// The exact curve, mm, with the shaft at the origin.
#[derive(Debug)]
pub struct ExactPath<'a> {
    boundary: Boundary<'a>,
    parts: Vec<PathPart>,
    closed: bool,
    length: f64,
}

impl<'a> ExactPath<'a> {
    /// A curve that closes, or runs from its first stretch to its last.
    #[must_use]
    pub fn new(boundary: Boundary<'a>, closed: bool) -> Self {
        let (mut parts, mut start, mut angle): (Vec<PathPart>, f64, Option<f64>) = (Vec::new(), 0.0, None);
        for (index, stretch) in boundary.stretches().iter().enumerate() {
            let length = quadrature::integrate(
                |at| boundary.point_at(index, at).map_or(0.0, |point| point.speed),
                (stretch.from, stretch.to),
                1,
            );
            let Some([first, last]) = boundary.ends(index).filter(|_| length > NO_LENGTH) else { continue };
            let from = angle.unwrap_or_else(|| libm::atan2(first.point.y, first.point.x));
            let to = from + libm::atan2(first.point.perp(&last.point), first.point.dot(&last.point));
            parts.push(PathPart { index, from: stretch.from, to: stretch.to, start, length, angles: (from, to) });
            start += length;
            angle = Some(to);
        }
        Self { boundary, parts, closed, length: start }
    }

    /// Whether it is closed.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Its length, mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Number of its stretches.
    pub(super) fn parts(&self) -> usize {
        self.parts.len()
    }

    fn part(&self, part: usize) -> Option<&PathPart> {
        self.parts.get(part % self.parts.len().max(1))
    }

    /// The parameters at which a stretch starts and ends.
    pub(super) fn range(&self, part: usize) -> (f64, f64) {
        self.part(part).map_or((0.0, 0.0), |part| (part.from, part.to))
    }

    /// The length at which a stretch ends, mm; the index counts on round the curve.
    pub(super) fn end_of(&self, part: usize) -> f64 {
        let rounds = part / self.parts.len().max(1);
        #[expect(clippy::cast_precision_loss, reason = "one round or two")]
        let before = self.length * rounds as f64;
        self.part(part).map_or(f64::INFINITY, |part| before + part.start + part.length)
    }

    /// The point at a place; the index of a stretch counts on round the curve.
    pub(super) fn point(&self, place: PathPlace) -> Option<CurvePoint> {
        self.boundary.point_at(self.part(place.part)?.index, place.parameter)
    }

    /// The place at a length from the start, mm; beyond the end of a closed curve it goes on with the first stretch.
    pub(super) fn place(&self, length: f64) -> PathPlace {
        let count = self.parts.len();
        let beyond = self.closed && length >= self.length;
        let within = if beyond { length - self.length } else { length };
        let found = self.parts.partition_point(|part| part.start <= within).saturating_sub(1);
        let parameter = self.parts.get(found).map_or(0.0, |part| {
            let share = ((within - part.start) / part.length).clamp(0.0, 1.0);
            if share < 1.0 { part.from + share * (part.to - part.from) } else { part.to }
        });
        PathPlace { part: if beyond { found + count } else { found }, parameter }
    }

    /// The length at which a place lies, mm.
    pub(super) fn length_at(&self, place: PathPlace) -> f64 {
        self.part(place.part).map_or(f64::NAN, |part| {
            let share = (place.parameter - part.from) / (part.to - part.from);
            self.end_of(place.part) - part.length * (1.0 - share)
        })
    }

    /// Number of corners.
    #[must_use]
    pub fn corners(&self) -> usize {
        self.joints(false).0.len()
    }

    /// The lengths at which it has a corner, and those at which a circle about the shaft begins or ends or, if requested,
    /// the curvature jumps, mm.
    pub(super) fn joints(&self, jumps: bool) -> (Vec<f64>, Vec<f64>) {
        let round: Vec<bool> = self.parts.iter().map(|part| self.is_round(part)).collect();
        let (mut corners, mut changes) = (Vec::new(), Vec::new());
        let before = round.iter().cycle().skip(round.len().saturating_sub(1));
        for (index, ((part, round), before)) in self.parts.iter().zip(&round).zip(before).enumerate() {
            if index == 0 && !self.closed {
                continue;
            }
            if self.boundary.starts_at_corner(part.index) {
                corners.push(part.start);
            } else if round != before || (jumps && self.jumps_at(part.index)) {
                changes.push(part.start);
            }
        }
        (corners, changes)
    }

    /// The lengths at which the curvature jumps without a corner, mm, with the points there.
    pub(super) fn jumps(&self) -> Vec<(f64, CurvePoint)> {
        let starts = self.parts.iter().skip(usize::from(!self.closed));
        let jumps = starts.filter(|part| !self.boundary.starts_at_corner(part.index) && self.jumps_at(part.index));
        jumps.filter_map(|part| Some((part.start, self.boundary.ends(part.index)?[0]))).collect()
    }

    /// Whether the curvature jumps where a stretch of the boundary starts.
    fn jumps_at(&self, index: usize) -> bool {
        let count = self.boundary.stretches().len();
        let before = self.boundary.ends(index + count - 1).map(|ends| ends[1].curvature);
        let after = self.boundary.ends(index).map(|ends| ends[0].curvature);
        !before.zip(after).is_some_and(|(a, b)| (a - b).abs() <= JUMP * a.abs().max(b.abs()))
    }

    fn is_round(&self, part: &PathPart) -> bool {
        let middle = 0.5 * (part.from + part.to);
        match [part.from, middle, part.to].map(|at| {
            let point = self.boundary.point_at(part.index, at)?;
            let radius = point.point.norm();
            ((point.curvature * radius - 1.0).abs() <= ROUND).then_some(radius)
        }) {
            [Some(a), Some(b), Some(c)] => (a - b).abs() <= ROUND * a && (c - b).abs() <= ROUND * a,
            _ => false,
        }
    }

    /// Refuses a curve that does not go round the shaft once in one sense.
    ///
    /// # Errors
    /// [`Refusal`] where it turns back, or does not go round exactly once.
    pub(super) fn check_goes_round(&self) -> Result<(), Refusal> {
        for part in &self.parts {
            for i in 0..=LOOKED_AT {
                let parameter = part.from + (part.to - part.from) * f64::from(i) / f64::from(LOOKED_AT);
                let point = self.boundary.point_at(part.index, parameter);
                if !point.is_some_and(|point| point.point.perp(&point.tangent) > 0.0) {
                    let polar_deg = point.map_or(f64::NAN, |p| libm::atan2(p.point.y, p.point.x).to_degrees());
                    return Err(not_around(polar_deg));
                }
            }
        }
        let ends = self.parts.first().zip(self.parts.last());
        let turned = ends.map_or(0.0, |(first, last)| last.angles.1 - first.angles.0);
        let once = self.closed && (turned - TAU).abs() < 1e-6;
        if once { Ok(()) } else { Err(not_around(0.0)) }
    }

    /// The lengths at which the rows of an interpolated curve lie, mm: on a closed curve that goes round the shaft each on the ray of its row,
    /// on an open one where it is nearest to its row, from end to end.
    ///
    /// # Errors
    /// [`Refusal`] where a closed curve does not go round, or the rows do not run along the curve once in its direction.
    pub fn places_of(&self, curve: &Interpolant) -> Result<Vec<f64>, Refusal> {
        let point = |index: usize| {
            let (from, to) = curve.range(index.min(curve.count().saturating_sub(1)))?;
            let at = if index < curve.count() {
                curve.point_at(index, from)?
            } else {
                curve.point_at(index.checked_sub(1)?, to)?
            };
            Some(at.point)
        };
        if !self.closed {
            return self.places_along(&(0..=curve.count()).filter_map(point).collect::<Vec<_>>());
        }
        self.check_goes_round()?;
        let mut places: Vec<f64> = Vec::with_capacity(curve.count() + 1);
        for index in 0..=curve.count() {
            let on_ray = point(index).and_then(|row| self.on_ray(libm::atan2(row.y, row.x)));
            let (mut length, _) =
                on_ray.ok_or_else(|| Refusal::new(format!("row {} does not lie beside the curve", index + 1)))?;
            if let Some(last) = places.last() {
                // Beyond the end of the curve it goes on with its start.
                if length + 0.5 * self.length < *last {
                    length += self.length;
                }
                // Two rows at one place differ by rounding.
                if length < *last - SAME_ROW {
                    return Err(Refusal::new(format!("row {} lies behind the row before it", index + 1)));
                }
                length = length.max(*last);
            }
            places.push(length);
        }
        let round = places.last().zip(places.first()).map_or(0.0, |(last, first)| last - first);
        if (round - self.length).abs() > SAME_ROW {
            return Err(Refusal::new(format!("the rows cover {round:.6} mm of {:.6} mm round the cam", self.length)));
        }
        Ok(places)
    }

    /// The lengths at which an open curve is nearest to points along it, mm; the first and the last belong to its ends.
    fn places_along(&self, points: &[Vector2<f64>]) -> Result<Vec<f64>, Refusal> {
        let step = self.length / f64::from(LOOKED_ALONG);
        let at = |length: f64| self.point(self.place(length.clamp(0.0, self.length)));
        let away = |length: f64, point: Vector2<f64>| at(length).map_or(f64::NAN, |on| (on.point - point).norm());
        let mut places = Vec::with_capacity(points.len());
        let mut near = 0.0;
        for (index, point) in points.iter().enumerate() {
            while near < self.length && away(near + step, *point) <= away(near, *point) {
                near += step;
            }
            let mut length = near.min(self.length);
            for _ in 0..REFINED {
                let Some(on) = at(length) else { break };
                length = (length + (point - on.point).dot(&on.tangent)).clamp(near - step, near + step);
            }
            let last = places.last().copied().unwrap_or(0.0);
            if !(length >= last - SAME_ROW) {
                return Err(Refusal::new(format!("row {} lies behind the row before it", index + 1)));
            }
            places.push(length.clamp(last, self.length));
        }
        if let [first, .., last] = places.as_mut_slice() {
            if *first > AT_END || self.length - *last > AT_END {
                let (from, to, length) = (*first, *last, self.length);
                return Err(Refusal::new(format!(
                    "the rows run from {from:.6} to {to:.6} mm of a curve of {length:.6} mm"
                )));
            }
            (*first, *last) = (0.0, self.length);
        }
        Ok(places)
    }

    /// Where the ray at a polar angle from the shaft meets a curve that goes round: the length there, mm, and the distance from
    /// the shaft, mm.
    pub(super) fn on_ray(&self, angle: f64) -> Option<(f64, f64)> {
        let (first, last) = (self.parts.first()?, self.parts.last()?);
        let mut seen = angle;
        while seen < first.angles.0 {
            seen += TAU;
        }
        while seen > last.angles.1.max(first.angles.0 + TAU) {
            seen -= TAU;
        }
        let ray = Vector2::new(libm::cos(angle), libm::sin(angle));
        let found = self.parts.partition_point(|part| part.angles.0 <= seen).saturating_sub(1);
        // Rounding may take the ray past the end of its stretch.
        let around = [found, found + 1, (found + self.parts.len()).saturating_sub(1)];
        for index in around.map(|index| index % self.parts.len()) {
            let part = self.parts.get(index)?;
            let across =
                |at: f64| self.boundary.point_at(part.index, at).map_or(f64::NAN, |point| ray.perp(&point.point));
            if let Ok(parameter) = root::bracketed(across, part.from, part.to, 0.0) {
                let away = self.boundary.point_at(part.index, parameter)?.point.dot(&ray);
                return Some((self.length_at(PathPlace { part: index, parameter }), away)).filter(|_| away > 0.0);
            }
        }
        // The ray goes through the end of a stretch, to rounding.
        let part = self.parts.get(found)?;
        let [start, end] = *self.boundary.ends(part.index)?;
        let at_end = ray.perp(&end.point).abs() < ray.perp(&start.point).abs();
        let (point, length) = if at_end { (end, part.start + part.length) } else { (start, part.start) };
        (ray.perp(&point.point).abs() < 1e-9).then(|| (length, point.point.dot(&ray)))
    }
}

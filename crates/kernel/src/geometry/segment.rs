//! A circular arc or a straight line by its ends and its bulge, millimetres.

use super::{left_of, rotated};
use nalgebra::Vector2;

/// A point counts as near the centre of an arc when the square of its distance from there, over the radius, is less.
const NEAR_CENTRE: f64 = 1e-4;

/// An arc or a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Start, mm.
    pub start: Vector2<f64>,
    /// End, mm.
    pub end: Vector2<f64>,
    /// tan(sweep/4).
    pub bulge: f64,
}

impl Segment {
    /// Signed angle swept, rad; 0 for a line.
    #[must_use]
    pub fn sweep(&self) -> f64 {
        4.0 * libm::atan(self.bulge)
    }

    /// Signed radius, mm, positive where the segment turns left; infinite for a line.
    #[must_use]
    pub fn radius(&self) -> f64 {
        // chord = 2 R sin(sweep/2), sin(sweep/2) = 2 b/(1 + b²).
        let b = self.bulge;
        (self.end - self.start).norm() * (1.0 + b * b) / (4.0 * b)
    }

    /// An arc as equal cubics that sweep at most so much, rad: the two inner points and the end of each, mm. A cubic of 45° is off its arc by 4e-6 of the radius
    /// (M. Goldapp, Computer Aided Geometric Design 8, 1991).
    #[must_use]
    pub fn cubics(&self, longest: f64) -> Vec<[Vector2<f64>; 3]> {
        let (sweep, centre) = (self.sweep(), self.centre());
        let count = (sweep.abs() / longest).ceil().max(1.0);
        let step = sweep / count;
        let handle = 4.0 / 3.0 * libm::tan(0.25 * step);
        let from = self.start - centre;
        let (mut found, mut number) = (Vec::new(), 0.0);
        while number < count {
            let [start, end] = [number * step, (number + 1.0) * step].map(|turn| {
                let (sin, cos) = libm::sincos(turn);
                rotated(from, sin, cos)
            });
            let last = if number + 1.0 < count { centre + end } else { self.end };
            found.push([centre + start + left_of(start) * handle, centre + end - left_of(end) * handle, last]);
            number += 1.0;
        }
        found
    }

    /// Centre of an arc, mm; meaningless for a line.
    #[must_use]
    pub fn centre(&self) -> Vector2<f64> {
        let chord = self.end - self.start;
        let left = Vector2::new(-chord.y, chord.x);
        // Distance of the centre from the chord over its length: (1 − b²)/(4 b), to the left.
        (self.start + self.end) * 0.5 + left * ((1.0 - self.bulge * self.bulge) / (4.0 * self.bulge))
    }

    /// Mirrored about the X axis and reversed: the same side stays on its left.
    #[must_use]
    pub fn mirrored_about_x(&self) -> Self {
        let [start, end] = [self.end, self.start].map(|point| Vector2::new(point.x, -point.y));
        Self { start, end, bulge: self.bulge }
    }

    /// Angles of the radii of an arc to its ends, degrees, in the order in which it is run counter-clockwise.
    #[must_use]
    pub fn angles(&self) -> (f64, f64) {
        let centre = self.centre();
        let [start, end] =
            [self.start - centre, self.end - centre].map(|away| libm::atan2(away.y, away.x).to_degrees());
        if self.bulge > 0.0 { (start, end) } else { (end, start) }
    }

    /// Middle of the segment, mm: off the chord by the sagitta, half the chord times the bulge, to the right.
    #[must_use]
    pub fn middle(&self) -> Vector2<f64> {
        let chord = self.end - self.start;
        (self.start + self.end) * 0.5 + Vector2::new(chord.y, -chord.x) * (0.5 * self.bulge)
    }

    /// Point and unit tangent at a share of the sweep, 0 the start, 1 the end.
    #[must_use]
    pub fn point_and_tangent(&self, share: f64) -> (Vector2<f64>, Vector2<f64>) {
        self.places()(share)
    }

    /// Points and unit tangents at many shares: their common terms are computed once.
    pub fn places(&self) -> impl Fn(f64) -> (Vector2<f64>, Vector2<f64>) {
        let (start, chord, tangent) = (self.start, self.end - self.start, self.start_tangent());
        let arc = (self.bulge != 0.0).then(|| (self.radius(), self.sweep()));
        // The part of an arc up to a place is an arc; the angle between its chord and the heading at the start is half its own sweep.
        move |share: f64| {
            let Some((radius, sweep)) = arc else { return (start + chord * share, tangent) };
            let (sin, cos) = libm::sincos(0.5 * sweep * share);
            let along = rotated(tangent, sin, cos);
            (start + along * (2.0 * radius * sin), rotated(along, sin, cos))
        }
    }

    /// Length, mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        if self.bulge == 0.0 { (self.end - self.start).norm() } else { (self.radius() * self.sweep()).abs() }
    }

    /// Unit tangent at the start: the chord turned right by half the sweep.
    #[must_use]
    pub fn start_tangent(&self) -> Vector2<f64> {
        self.tangent(-1.0)
    }

    /// Unit tangent at the end: the chord turned left by half the sweep.
    #[must_use]
    pub fn end_tangent(&self) -> Vector2<f64> {
        self.tangent(1.0)
    }

    fn tangent(&self, side: f64) -> Vector2<f64> {
        let chord = (self.end - self.start).normalize();
        let b2 = self.bulge * self.bulge;
        let (cos, sin) = ((1.0 - b2) / (1.0 + b2), side * 2.0 * self.bulge / (1.0 + b2));
        Vector2::new(cos * chord.x - sin * chord.y, sin * chord.x + cos * chord.y)
    }

    /// Exact extents, including the bulging of an arc.
    #[must_use]
    pub fn extents(&self) -> Extents {
        let mut extents = Extents { least: self.start.inf(&self.end), largest: self.start.sup(&self.end) };
        if self.bulge == 0.0 {
            return extents;
        }
        let (centre, radius) = (self.centre(), self.radius().abs());
        for direction in [Vector2::x(), Vector2::y(), -Vector2::x(), -Vector2::y()] {
            let point = centre + direction * radius;
            // The arc lies to the right of its chord when it turns left, and vice versa.
            if (self.end - self.start).perp(&(point - self.start)) * self.bulge < 0.0 {
                extents = extents.with(&Extents { least: point, largest: point });
            }
        }
        extents
    }

    /// How far the segment reaches in a direction (a unit vector) from the origin, mm.
    #[must_use]
    pub fn farthest(&self, direction: Vector2<f64>) -> f64 {
        let ends = self.start.dot(&direction).max(self.end.dot(&direction));
        if self.bulge == 0.0 {
            return ends;
        }
        let top = self.centre() + direction * self.radius().abs();
        // The arc lies to the right of its chord when it turns left, and vice versa.
        let on_arc = (self.end - self.start).perp(&(top - self.start)) * self.bulge < 0.0;
        if on_arc { top.dot(&direction) } else { ends }
    }

    /// The point of the segment nearest to a given point.
    #[must_use]
    pub fn nearest(&self, point: Vector2<f64>) -> NearestOnSegment {
        let chord = self.end - self.start;
        let heading = self.start_tangent();
        let d = point - self.start;
        if self.bulge == 0.0 {
            let along = d.dot(&heading);
            if (0.0..=chord.norm()).contains(&along) {
                let left = heading.perp(&d);
                return NearestOnSegment { left, foot: self.start + heading * along, tangent: heading };
            }
        } else {
            let curvature = 1.0 / self.radius();
            // Signed distance without cancellation of a large radius, see `geometry::arcs`.
            let g = 2.0 * heading.perp(&d) - curvature * d.norm_squared();
            // From the centre to the point, over the radius: the normal at the foot, to the left; its square is 1 − κ g.
            let normal = Vector2::new(-heading.y, heading.x) - d * curvature;
            let square = 1.0 - curvature * g;
            // Near the centre the difference is only rounding, and its root a million times more.
            let from_centre = if square > NEAR_CENTRE { square.sqrt() } else { normal.norm() };
            let left = g / (1.0 + from_centre);
            if normal.norm_squared() > 0.0 {
                let normal = normal.normalize();
                let foot = point - normal * left;
                // The arc lies to the right of its chord when it turns left, and vice versa.
                if chord.perp(&(foot - self.start)) * self.bulge <= 0.0 {
                    return NearestOnSegment { left, foot, tangent: Vector2::new(normal.y, -normal.x) };
                }
            }
        }
        let (foot, tangent) = if d.norm_squared() <= (point - self.end).norm_squared() {
            (self.start, heading)
        } else {
            (self.end, self.end_tangent())
        };
        let away = point - foot;
        NearestOnSegment { left: away.norm().copysign(tangent.perp(&away)), foot, tangent }
    }

    /// Area between the segment and the origin, mm², and its first moments ∫x dA, ∫y dA, mm³, signed.
    ///
    /// The triangle (origin, start, end) plus the circular segment over the chord, which has area
    /// R²(sweep − sin sweep)/2 and its centroid at distance 4 R sin³(sweep/2)/(3 (sweep − sin sweep)) from the centre.
    #[must_use]
    pub fn area_and_moments(&self) -> (f64, Vector2<f64>) {
        let triangle = 0.5 * self.start.perp(&self.end);
        let moment = (self.start + self.end) * (triangle / 3.0);
        if self.bulge == 0.0 {
            return (triangle, moment);
        }
        let (sweep, radius) = (self.sweep(), self.radius());
        let cap = 0.5 * radius * radius * sweep_minus_sine(sweep);
        let half_sine = 2.0 * self.bulge / (1.0 + self.bulge * self.bulge);
        let chord = (self.end - self.start).normalize();
        let right = Vector2::new(chord.y, -chord.x);
        let cap_moment = self.centre() * cap + right * (2.0 / 3.0 * radius * radius * radius * half_sine.powi(3));
        (triangle + cap, moment + cap_moment)
    }
}

/// The point of a segment nearest to a given one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestOnSegment {
    /// Distance, mm, positive when the given point lies to the left of the segment: inside a counter-clockwise chain.
    pub left: f64,
    /// The nearest point.
    pub foot: Vector2<f64>,
    /// Unit tangent there.
    pub tangent: Vector2<f64>,
}

/// x − sin x without cancellation at small x (series to x¹¹, exact to rounding below 0.5).
pub(crate) fn sweep_minus_sine(x: f64) -> f64 {
    if x.abs() > 0.5 {
        return x - libm::sin(x);
    }
    let x2 = x * x;
    let tail = 1.0 - x2 / 20.0 * (1.0 - x2 / 42.0 * (1.0 - x2 / 72.0 * (1.0 - x2 / 110.0)));
    x * x2 / 6.0 * tail
}

/// Corners of the smallest upright rectangle, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extents {
    /// Smallest x and y.
    pub least: Vector2<f64>,
    /// Largest x and y.
    pub largest: Vector2<f64>,
}

impl Extents {
    /// The smallest extents that contain both.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        Self { least: self.least.inf(&other.least), largest: self.largest.sup(&other.largest) }
    }

    /// Largest x and y minus smallest.
    #[must_use]
    pub fn size(&self) -> Vector2<f64> {
        self.largest - self.least
    }
}

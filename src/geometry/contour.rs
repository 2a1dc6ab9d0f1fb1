//! A closed chain of circular arcs and lines in the drawing plane, millimetres: what a shop cuts.
//!
//! A vertex carries the bulge of the segment that leaves it, tan(sweep/4), positive where the segment turns left; 0 is
//! a straight line. The last segment ends in the first vertex.

use nalgebra::Vector2;

/// A point is near the centre of an arc when the square of its distance from there, over the radius, is less.
const NEAR_CENTRE: f64 = 1e-4;

/// A vertex and the bulge of the segment to the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// Place, mm.
    pub point: Vector2<f64>,
    /// tan(sweep/4) of the segment that starts here.
    pub bulge: f64,
}

/// One segment of a chain.
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

    /// Centre of an arc, mm; meaningless for a line.
    #[must_use]
    pub fn centre(&self) -> Vector2<f64> {
        let chord = self.end - self.start;
        let left = Vector2::new(-chord.y, chord.x);
        // Distance of the centre from the chord over its length: (1 − b²)/(4 b), to the left.
        (self.start + self.end) * 0.5 + left * ((1.0 - self.bulge * self.bulge) / (4.0 * self.bulge))
    }

    /// Middle of the segment, mm: off the chord by the sagitta, half the chord times the bulge, to the right.
    #[must_use]
    pub fn middle(&self) -> Vector2<f64> {
        let chord = self.end - self.start;
        (self.start + self.end) * 0.5 + Vector2::new(chord.y, -chord.x) * (0.5 * self.bulge)
    }

    /// Point and unit tangent at a share of the sweep, 0 the start, 1 the end.
    #[must_use]
    pub fn at(&self, share: f64) -> (Vector2<f64>, Vector2<f64>) {
        // The part of an arc up to there is an arc whose chord leaves the start turned by half its own sweep.
        let chord = self.end - self.start;
        if self.bulge == 0.0 {
            return (self.start + chord * share, self.start_tangent());
        }
        let (radius, half) = (self.radius(), 0.5 * self.sweep() * share);
        let (sin, cos) = (libm::sin(half), libm::cos(half));
        let turned = |v: Vector2<f64>| Vector2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y);
        let along = turned(self.start_tangent());
        (self.start + along * (2.0 * radius * sin), turned(along))
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

    /// Exact extents, the bulging of an arc included.
    #[must_use]
    pub fn extents(&self) -> Extents {
        let mut extents = Extents { least: self.start.inf(&self.end), largest: self.start.sup(&self.end) };
        if self.bulge == 0.0 {
            return extents;
        }
        let (centre, radius) = (self.centre(), self.radius().abs());
        for direction in [Vector2::x(), Vector2::y(), -Vector2::x(), -Vector2::y()] {
            let point = centre + direction * radius;
            // The arc lies to the right of its chord when it turns left, and the other way round.
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
        // The arc lies to the right of its chord when it turns left, and the other way round.
        let on_arc = (self.end - self.start).perp(&(top - self.start)) * self.bulge < 0.0;
        if on_arc { top.dot(&direction) } else { ends }
    }

    /// The nearest point of the segment, seen from a point.
    #[must_use]
    pub fn nearest(&self, point: Vector2<f64>) -> Nearest {
        let chord = self.end - self.start;
        let heading = self.start_tangent();
        let d = point - self.start;
        if self.bulge == 0.0 {
            let along = d.dot(&heading);
            if (0.0..=chord.norm()).contains(&along) {
                let left = heading.perp(&d);
                return Nearest { left, foot: self.start + heading * along, tangent: heading };
            }
        } else {
            let curvature = 1.0 / self.radius();
            // Signed distance without cancellation of a large radius, see `geometry::arcs`.
            let g = 2.0 * heading.perp(&d) - curvature * d.norm_squared();
            // From the centre to the point, over the radius: the normal at the foot, to the left; its square is 1 − κ g.
            let normal = Vector2::new(-heading.y, heading.x) - d * curvature;
            let square = 1.0 - curvature * g;
            // Near the centre the difference is rounding only, and its root a million times more.
            let from_centre = if square > NEAR_CENTRE { square.sqrt() } else { normal.norm() };
            let left = g / (1.0 + from_centre);
            if normal.norm_squared() > 0.0 {
                let normal = normal.normalize();
                let foot = point - normal * left;
                // The arc lies to the right of its chord when it turns left, and the other way round.
                if chord.perp(&(foot - self.start)) * self.bulge <= 0.0 {
                    return Nearest { left, foot, tangent: Vector2::new(normal.y, -normal.x) };
                }
            }
        }
        let (foot, tangent) = if d.norm_squared() <= (point - self.end).norm_squared() {
            (self.start, heading)
        } else {
            (self.end, self.end_tangent())
        };
        let away = point - foot;
        Nearest { left: away.norm().copysign(tangent.perp(&away)), foot, tangent }
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
pub struct Nearest {
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

/// A closed chain.
#[derive(Debug, Clone, PartialEq)]
pub struct Contour {
    /// Its vertices, two at the least.
    pub vertices: Vec<Vertex>,
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
    /// The smallest that holds both.
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

impl Contour {
    /// A full circle, counter-clockwise, as two half arcs.
    #[must_use]
    pub fn circle(centre: Vector2<f64>, radius: f64) -> Self {
        let right = Vector2::new(radius, 0.0);
        let half = |point| Vertex { point, bulge: 1.0 };
        Self { vertices: vec![half(centre + right), half(centre - right)] }
    }

    /// The segments in order.
    pub fn segments(&self) -> impl Iterator<Item = Segment> + '_ {
        let ends = self.vertices.iter().skip(1).chain(self.vertices.first());
        self.vertices.iter().zip(ends).map(|(a, b)| Segment { start: a.point, end: b.point, bulge: a.bulge })
    }

    /// How many of its segments are arcs.
    #[must_use]
    pub fn arcs(&self) -> usize {
        self.vertices.iter().filter(|vertex| vertex.bulge != 0.0).count()
    }

    /// Enclosed area, mm², positive counter-clockwise, and its centroid, mm.
    #[must_use]
    pub fn area_and_centroid(&self) -> (f64, Vector2<f64>) {
        let (area, moment) = self
            .segments()
            .map(|segment| segment.area_and_moments())
            .fold((0.0, Vector2::zeros()), |sum, next| (sum.0 + next.0, sum.1 + next.1));
        (area, moment / area)
    }

    /// Length of the whole chain, mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.segments().map(|segment| segment.length()).sum()
    }

    /// How often the chain runs round: 1 for a simple one run counter-clockwise, −1 clockwise.
    #[must_use]
    pub fn turns(&self) -> f64 {
        let swept: f64 = self.segments().map(|segment| segment.sweep()).sum();
        let kinks: f64 = self.tangent_breaks().iter().sum();
        ((swept + kinks) / std::f64::consts::TAU).round()
    }

    /// Turn of the tangent at the start of each segment, rad: 0 where the chain is smooth.
    #[must_use]
    pub fn tangent_breaks(&self) -> Vec<f64> {
        let segments: Vec<Segment> = self.segments().collect();
        let before = segments.iter().cycle().skip(segments.len().saturating_sub(1));
        before
            .zip(&segments)
            .map(|(before, after)| {
                let (a, b) = (before.end_tangent(), after.start_tangent());
                libm::atan2(a.perp(&b), a.dot(&b))
            })
            .collect()
    }

    /// Exact extents, the bulging of arcs included.
    #[must_use]
    pub fn extents(&self) -> Extents {
        let first = self.vertices.first().map_or_else(Vector2::zeros, |v| v.point);
        let start = Extents { least: first, largest: first };
        self.segments().fold(start, |extents, segment| extents.with(&segment.extents()))
    }

    /// The same chain run the other way.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let segments: Vec<Segment> = self.segments().collect();
        Self { vertices: segments.iter().rev().map(|s| Vertex { point: s.end, bulge: -s.bulge }).collect() }
    }

    /// Mirrored about the X axis and turned round, so that it still runs the same way; starts with the mirror of the
    /// same segment.
    #[must_use]
    pub fn mirrored_about_x(&self) -> Self {
        let n = self.vertices.len();
        // Segment i runs from vertex i to i+1; mirrored it runs from i+1 to i with the same bulge.
        let vertices = (0..n)
            .filter_map(|step| {
                let (start, segment) = ((n + 1 - step) % n, (n - step) % n);
                let (start, segment) = (self.vertices.get(start)?, self.vertices.get(segment)?);
                Some(Vertex { point: Vector2::new(start.point.x, -start.point.y), bulge: segment.bulge })
            })
            .collect();
        Self { vertices }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_circle_has_the_measures_of_a_circle() {
        let centre = Vector2::new(3.0, -2.0);
        let circle = Contour::circle(centre, 5.0);
        let (area, centroid) = circle.area_and_centroid();
        assert!((area - 25.0 * PI).abs() < 1e-13);
        assert!((centroid - centre).norm() < 1e-14);
        assert_eq!((circle.turns(), circle.reversed().turns()), (1.0, -1.0));
        let twice = Contour { vertices: [&circle.vertices[..], &circle.vertices[..]].concat() };
        assert_eq!(twice.turns(), 2.0);
        assert!((circle.length() - 10.0 * PI).abs() < 1e-13);
        assert!(circle.tangent_breaks().iter().all(|turn| turn.abs() < 1e-15));
        let extents = circle.extents();
        assert!((extents.least - Vector2::new(-2.0, -7.0)).norm() < 1e-14);
        assert!((extents.largest - Vector2::new(8.0, 3.0)).norm() < 1e-14);
    }

    /// From places about the centre of an arc it is as far as the radius, less what they are off to its side.
    #[test]
    fn an_arc_is_its_radius_from_its_centre() {
        let arc = Segment {
            start: Vector2::new(335.226_644_976_63, -40.517_138_248_16),
            end: Vector2::new(333.019_936_248_02, -26.603_447_175_485),
            bulge: -0.119_060_786_373,
        };
        let middle = arc.middle() - arc.centre();
        let (along, across) = (middle.normalize(), Vector2::new(-middle.y, middle.x).normalize());
        for step in [0.0, 1e-13, 1e-10, 1e-7, 1e-5, 1e-3, 0.1, 0.3] {
            for place in [along * step, along * -step, across * step, across * -step] {
                let nearest = arc.nearest(arc.centre() + place);
                // The chord sees 27° of the circle: the ends are nearer than the arc only from places beyond its centre.
                let ends = (arc.start - arc.centre() - place).norm().min((arc.end - arc.centre() - place).norm());
                let on_circle = arc.radius().abs() - place.norm();
                let exact = if place.dot(&along) > 0.5 * place.norm() { on_circle } else { ends };
                // Twelve decimals of the ends leave 1e-11 mm of the radius; rounding is a thousandth of that.
                assert!((nearest.left.abs() - exact).abs() < 1e-11, "{place:?}: {nearest:?} {exact}");
            }
        }
    }

    /// A slot: two lines and two half circles; measures in closed form.
    #[test]
    fn a_slot_has_the_measures_of_a_slot() {
        let at = |x: f64, y: f64, bulge: f64| Vertex { point: Vector2::new(x, y), bulge };
        let slot =
            Contour { vertices: vec![at(0.0, -1.0, 0.0), at(4.0, -1.0, 1.0), at(4.0, 1.0, 0.0), at(0.0, 1.0, 1.0)] };
        let (area, centroid) = slot.area_and_centroid();
        assert!((area - (8.0 + PI)).abs() < 1e-14);
        assert!((centroid - Vector2::new(2.0, 0.0)).norm() < 1e-14);
        assert!(slot.tangent_breaks().iter().all(|turn| turn.abs() < 1e-15));
        assert!((slot.extents().size() - Vector2::new(6.0, 2.0)).norm() < 1e-14);
        let quarter =
            Segment { start: Vector2::new(1.0, 0.0), end: Vector2::new(0.0, 1.0), bulge: libm::tan(PI / 8.0) };
        let (area, moment) = quarter.area_and_moments();
        assert!((area - PI / 4.0).abs() < 1e-15, "{area}");
        assert!((moment - Vector2::new(1.0, 1.0) / 3.0).norm() < 1e-15, "{moment}");
        assert!((quarter.middle().norm() - 1.0).abs() < 1e-15);
        assert!((quarter.centre()).norm() < 1e-15 && (quarter.radius() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn the_nearest_point_is_the_nearest_of_many() {
        let at = |x: f64, y: f64| Vector2::new(x, y);
        for bulge in [0.0, 1e-7, 0.2, -0.2, 0.9, -1.7] {
            let segment = Segment { start: at(1.0, 2.0), end: at(5.0, 3.0), bulge };
            assert!((segment.at(1.0).0 - segment.end).norm() < 1e-13);
            assert!((segment.at(1.0).1 - segment.end_tangent()).norm() < 1e-13);
            assert!((segment.at(0.5).0 - segment.middle()).norm() < 1e-13);
            for (x, y) in [(3.0, 0.0), (0.0, 0.0), (9.0, 9.0), (3.0, 2.4), (2.0, 7.0), (4.0, -3.0)] {
                let nearest = segment.nearest(at(x, y));
                let scan = (0..=20_000)
                    .map(|i| (segment.at(f64::from(i) / 2e4).0 - at(x, y)).norm())
                    .fold(f64::INFINITY, f64::min);
                assert!((nearest.left.abs() - scan).abs() < 1e-6, "{bulge} ({x}, {y}): {nearest:?} {scan}");
                assert!(((nearest.foot - at(x, y)).norm() - nearest.left.abs()).abs() < 1e-8, "{bulge}: {nearest:?}");
            }
        }
        let left = Segment { start: at(0.0, 0.0), end: at(2.0, 0.0), bulge: 0.0 };
        assert_eq!(left.nearest(at(1.0, 3.0)).left, 3.0);
        assert_eq!(left.nearest(at(1.0, -3.0)).left, -3.0);
    }

    #[test]
    fn mirroring_twice_is_nothing_and_once_keeps_the_sense() {
        let at = |x: f64, y: f64, bulge: f64| Vertex { point: Vector2::new(x, y), bulge };
        let chain =
            Contour { vertices: vec![at(0.0, 0.0, 0.1), at(4.0, 0.0, 0.0), at(4.0, 3.0, -0.2), at(1.0, 5.0, 0.3)] };
        let mirrored = chain.mirrored_about_x();
        assert_eq!(mirrored.mirrored_about_x(), chain);
        let ((a, ca), (b, cb)) = (chain.area_and_centroid(), mirrored.area_and_centroid());
        assert!((a - b).abs() < 1e-13 && (ca.x - cb.x).abs() < 1e-13 && (ca.y + cb.y).abs() < 1e-13);
        assert_eq!(mirrored.vertices[0].bulge, 0.1, "the first segment stays the first");
    }
}

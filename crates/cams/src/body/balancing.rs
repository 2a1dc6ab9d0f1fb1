//! The static unbalance of a disc and the holes that cancel it.
//!
//! The holes are a row: equal ones on a circle about the shaft, evenly spaced, symmetric about the heavy side. n holes of radius
//! a at the distance ρ, Δ apart, take away π a² ρ sin(nΔ/2)/sin(Δ/2). The largest row of n is found by branch and bound over ρ
//! and Δ: the room at a centre, the distance from the nearest contour, changes by no more than the centre moves, so a rectangle of
//! (ρ, Δ) has an upper bound from its middle. The reported least possible unbalance is the least for such rows.

use camgen_kernel::geometry::contour::{Contour, Edge};
use nalgebra::Vector2;
use std::f64::consts::{PI, TAU};

/// Most holes that are tried.
pub const MOST_HOLES: u32 = 12;
/// Metal between neighbouring holes, over their radius.
const BETWEEN: f64 = 0.25;
/// Metal around a hole where the machine file gives no limit for the wall, mm.
const LEAST_WALL: f64 = 1.0;
/// By how much the largest row may exceed the one that is found, as a share, and how often rectangles are quartered to get there.
const SHARE: f64 = 1e-3;
const ROUNDS: u32 = 16;
/// Rectangles of one search; beyond, the bound stays as it is.
const MOST_RECTANGLES: usize = 20_000;

/// A row of equal holes; mm and rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HoleRow {
    /// Number of holes.
    pub count: u32,
    /// Radius of each.
    pub radius: f64,
    /// Distance of their centres from the shaft.
    pub distance: f64,
    /// Angle between neighbours.
    pub apart: f64,
}

/// Why a disc stays out of balance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BalanceFailure {
    /// Area moment that no row within the band goes below, mm³.
    pub least: f64,
    /// The row that takes away the most, if any fits.
    pub best: Option<HoleRow>,
    /// A band of radii in which a row cancels it all, if one does, mm.
    pub band: Option<(f64, f64)>,
}

/// The result of balancing, in the drawing plane, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Balancing {
    /// Holes, centre and radius; none when it could not be done.
    pub holes: Vec<(Vector2<f64>, f64)>,
    /// Area moment about the shaft before, mm³.
    pub before: f64,
    /// Area moment about the shaft after, mm³.
    pub after: f64,
    /// Why it could not be done.
    pub unbalanced: Option<BalanceFailure>,
}

/// First moment of a face about the shaft, mm³.
#[must_use]
pub fn moment(contour: &Contour) -> Vector2<f64> {
    let (area, centroid) = contour.area_and_centroid();
    centroid * area
}

impl HoleRow {
    /// Area moment that it takes away, mm³.
    #[must_use]
    pub fn moment(&self) -> f64 {
        PI * self.radius * self.radius * self.distance * in_step(self.count, self.apart)
    }

    /// Angle of a hole from the heavy side, rad.
    fn angle(&self, index: u32) -> f64 {
        (f64::from(index) - 0.5 * f64::from(self.count - 1)) * self.apart
    }
}

/// sin(nΔ/2)/sin(Δ/2), the vector sum of n unit vectors: falls from n at 0 to 0 at Δ = 2π/n.
fn in_step(count: u32, apart: f64) -> f64 {
    let half = 0.5 * apart;
    if count == 1 || half <= 0.0 {
        return f64::from(count);
    }
    (libm::sin(f64::from(count) * half) / libm::sin(half)).max(0.0)
}

/// The face into which holes are drilled.
struct Face {
    outline: Vec<Edge>,
    /// Bore with its keyway.
    bore: Vec<Edge>,
    /// Unit vector to the heavy side.
    heavy: Vector2<f64>,
    /// Least and largest radius that a hole may reach, mm.
    band: (f64, f64),
    /// Metal that stays around a hole, mm.
    wall: f64,
}

/// A rectangle of distances and angles between holes.
type Rectangle = ((f64, f64), (f64, f64));

impl Face {
    /// Distance of a point of the metal from the nearest contour, mm; negative outside the metal.
    fn room(&self, point: Vector2<f64>) -> f64 {
        let left = |edges: &[Edge]| {
            let nearest = edges.iter().map(|edge| edge.nearest(point).left);
            nearest.min_by(|a, b| a.abs().total_cmp(&b.abs()))
        };
        let from_bore = left(&self.bore).map_or(f64::INFINITY, |left| -left);
        left(&self.outline).unwrap_or(0.0).min(from_bore)
    }

    fn centre(&self, distance: f64, angle: f64) -> Vector2<f64> {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        Vector2::new(cos * self.heavy.x - sin * self.heavy.y, sin * self.heavy.x + cos * self.heavy.y) * distance
    }

    /// A radius that no hole of a row in a rectangle exceeds, and the moment such a row does not exceed; both are reached where
    /// the rectangle is a point.
    fn bound(&self, count: u32, (distance, apart): Rectangle) -> (f64, f64) {
        let middle = |(low, high): (f64, f64)| 0.5 * (low + high);
        let half = |(low, high): (f64, f64)| 0.5 * (high - low);
        let row = HoleRow { count, radius: 0.0, distance: middle(distance), apart: middle(apart) };
        let room = |index: u32| {
            let steps = (f64::from(index) - 0.5 * f64::from(count - 1)).abs();
            self.room(self.centre(row.distance, row.angle(index))) + half(distance) + distance.1 * steps * half(apart)
        };
        let around = (0..count).map(room).fold(f64::INFINITY, f64::min) - self.wall;
        let mut radius = around.min(distance.1 - self.band.0).min(self.band.1 - distance.0);
        let last_to_first = (0.5 * (TAU - f64::from(count - 1) * apart.0)).min(0.5 * PI);
        for angle in [0.5 * apart.1, last_to_first] {
            if count > 1 {
                let to_middle = distance.1 * libm::sin(angle);
                radius = radius.min(to_middle / (1.0 + 0.5 * BETWEEN)).min(to_middle - 0.5 * self.wall);
            }
        }
        let radius = radius.max(0.0);
        (radius, PI * radius * radius * distance.1 * in_step(count, apart.0))
    }

    /// The row of so many holes that takes away the most, or the first found that takes `wanted` (mm³); and what no row of so
    /// many exceeds.
    fn largest(&self, count: u32, wanted: f64) -> (HoleRow, f64) {
        let spread = if count == 1 { 0.0 } else { TAU / f64::from(count) };
        let mut rectangles = vec![(f64::INFINITY, (self.band, (0.0, spread)))];
        let mut best = HoleRow { count, radius: 0.0, distance: self.band.0, apart: 0.0 };
        for _ in 0..ROUNDS {
            let mut next = Vec::new();
            for (_, rectangle) in &rectangles {
                for quarter in quarters(*rectangle, count) {
                    let (distance, apart) = (0.5 * (quarter.0.0 + quarter.0.1), 0.5 * (quarter.1.0 + quarter.1.1));
                    let (radius, taken) = self.bound(count, ((distance, distance), (apart, apart)));
                    if taken > best.moment() {
                        best = HoleRow { count, radius, distance, apart };
                    }
                    if taken >= wanted {
                        return (best, f64::INFINITY);
                    }
                    next.push((self.bound(count, quarter).1, quarter));
                }
            }
            let enough = best.moment() * (1.0 + SHARE);
            next.retain(|(bound, _)| *bound > enough);
            rectangles = next;
            if rectangles.is_empty() || rectangles.len() > MOST_RECTANGLES {
                break;
            }
        }
        let open = rectangles.iter().map(|(bound, _)| *bound).fold(0.0, f64::max);
        (best, open.max(best.moment() * (1.0 + SHARE)))
    }

    /// The row of the fewest holes that takes away a moment (mm³), or the row that takes the most and what none exceeds.
    fn row_for(&self, wanted: f64) -> Result<HoleRow, (HoleRow, f64)> {
        let (mut best, mut limit) = (HoleRow { count: 1, radius: 0.0, distance: self.band.0, apart: 0.0 }, 0.0_f64);
        for count in 1..=MOST_HOLES {
            let (row, bound) = self.largest(count, wanted);
            if row.moment() >= wanted {
                let unit = HoleRow { radius: 1.0, ..row };
                return Ok(HoleRow { radius: (wanted / unit.moment()).sqrt(), ..row });
            }
            limit = limit.max(bound);
            if row.moment() > best.moment() {
                best = row;
            }
        }
        Err((best, limit))
    }
}

/// The four quarters of a rectangle; of a single hole, which has no spacing, two halves.
fn quarters((distance, apart): Rectangle, count: u32) -> Vec<Rectangle> {
    let halves = |(low, high): (f64, f64)| {
        let middle = 0.5 * (low + high);
        [(low, middle), (middle, high)]
    };
    let spacings = if count == 1 { vec![apart] } else { halves(apart).to_vec() };
    halves(distance).into_iter().flat_map(|distance| spacings.iter().map(move |apart| (distance, *apart))).collect()
}

/// The row of the fewest holes within a band of radii (mm) that cancels the moment of the face, with `wall` (mm) of metal, at
/// least a millimetre, to the outline, to the bore with its keyway and to other holes, and between holes. A disc whose centre of mass is nearer to
/// the shaft than `negligible` (mm) needs none.
#[must_use]
pub fn balance(
    (outline, bore, others): (&Contour, Option<&Contour>, &[Contour]),
    band: (f64, f64),
    wall: f64,
    negligible: f64,
) -> Balancing {
    let moment = bore.into_iter().chain(others).fold(moment(outline), |left, hole| left - moment(hole));
    let before = moment.norm();
    let none = Balancing { holes: Vec::new(), before, after: before, unbalanced: None };
    if before <= negligible * outline.area_and_centroid().0 {
        return none;
    }
    let bore_edges = bore.into_iter().chain(others).flat_map(Contour::edges).collect();
    let (wall, heavy) = (wall.max(LEAST_WALL), moment / before);
    let face = Face { outline: outline.edges().collect(), bore: bore_edges, heavy, band, wall };
    match face.row_for(before) {
        Ok(row) => {
            let hole = |index: u32| (face.centre(row.distance, row.angle(index)), row.radius);
            let holes: Vec<(Vector2<f64>, f64)> = (0..row.count).map(hole).collect();
            let left = holes.iter().fold(moment, |m, (centre, radius)| m - centre * (PI * radius * radius));
            Balancing { holes, after: left.norm(), ..none }
        }
        Err((best, limit)) => {
            let widest = widest(outline, bore, wall);
            let wider = Face { band: widest, ..face };
            let band = (widest.0 < widest.1 && wider.row_for(before).is_ok()).then_some(widest);
            let best = (best.radius > 0.0).then_some(best);
            Balancing { unbalanced: Some(BalanceFailure { least: (before - limit).max(0.0), best, band }), ..none }
        }
    }
}

/// The widest band of whole millimetres in which holes may lie, mm.
fn widest(outline: &Contour, bore: Option<&Contour>, wall: f64) -> (f64, f64) {
    let farthest = |contour: &Contour| contour.vertices.iter().map(|vertex| vertex.point.norm()).fold(0.0, f64::max);
    let inner = bore.map_or(0.0, |bore| {
        bore.edges().map(|edge| edge.nearest(Vector2::zeros()).foot.norm()).fold(f64::INFINITY, f64::min)
    });
    ((inner + wall).ceil(), (farthest(outline) - wall).floor())
}

#[cfg(test)]
mod tests {
    use super::*;
    use camgen_kernel::geometry::contour::Vertex;

    #[test]
    fn an_eccentric_disc_is_balanced_within_its_band() {
        let disc = Contour::circle(Vector2::new(3.0, 4.0), 100.0);
        assert!((moment(&disc).norm() - 5.0 * PI * 1e4).abs() < 1e-8);
        for (band, count) in [((10.0, 80.0), 1), ((20.0, 80.0), 2)] {
            let balancing = balance((&disc, None, &[]), band, 2.0, 1e-9);
            assert_eq!(balancing.holes.len(), count, "{balancing:?}");
            assert!(balancing.after < 1e-9 * balancing.before);
            for (centre, radius) in &balancing.holes {
                assert!(centre.norm() + radius <= band.1 + 1e-9 && centre.norm() - radius >= band.0 - 1e-9);
                assert!(centre.dot(&Vector2::new(3.0, 4.0)) > 0.0, "on the heavy side");
            }
        }
        let narrow = balance((&disc, None, &[]), (60.0, 61.0), 2.0, 1e-9);
        assert!(narrow.holes.is_empty() && narrow.after == narrow.before, "{narrow:?}");
        let centred = Contour::circle(Vector2::zeros(), 100.0);
        assert_eq!(balance((&centred, None, &[]), (20.0, 80.0), 2.0, 1e-9).holes.len(), 0);
    }

    /// A thin band about a centred bore, where the largest row is known: twelve holes, each as wide as the band. The
    /// reported least unbalance is within a thousandth of what they take.
    #[test]
    fn the_least_unbalance_is_that_of_the_largest_row() {
        let disc = Contour::circle(Vector2::new(6.0, 0.0), 100.0);
        let balancing = balance((&disc, Some(&Contour::circle(Vector2::zeros(), 20.0)), &[]), (60.0, 70.0), 2.0, 1e-9);
        let unbalanced = balancing.unbalanced.expect("too narrow");
        let known = |count: u32| {
            let apart = 2.0 * libm::asin(5.0 * (1.0 + 0.5 * BETWEEN) / 65.0).max(libm::asin((5.0 + 1.0) / 65.0));
            HoleRow { count, radius: 5.0, distance: 65.0, apart }.moment()
        };
        let most = (1..=MOST_HOLES).map(known).fold(0.0, f64::max);
        let taken = unbalanced.best.expect("a row").moment();
        assert!(taken <= most * 1.001 && taken >= most * 0.998, "{taken} {most}");
        assert!(unbalanced.least <= balancing.before - most + 1e-6, "a true bound");
        assert!(unbalanced.least >= balancing.before - most * 1.004, "a near one");
        let band = unbalanced.band.expect("a wider band does");
        assert!(
            balance((&disc, Some(&Contour::circle(Vector2::zeros(), 20.0)), &[]), band, 2.0, 1e-9).unbalanced.is_none()
        );
    }

    /// Area moment and least distance by points on the contours: nothing of the code's own forms. A keyway on the heavy side is
    /// avoided.
    #[test]
    fn holes_keep_the_wall_to_keyway_and_each_other() {
        let disc = Contour::circle(Vector2::new(9.0, 0.0), 100.0);
        let (half, bottom) = (12.0_f64, 52.0);
        let edge = (30.0_f64 * 30.0 - half * half).sqrt();
        let round = libm::tan(0.25 * (PI - libm::asin(half / 30.0)));
        let at = |x: f64, y: f64, bulge: f64| Vertex::new(Vector2::new(x, y), bulge);
        let bore = Contour {
            vertices: vec![
                at(edge, half, round),
                at(-30.0, 0.0, round),
                at(edge, -half, 0.0),
                at(bottom, -half, 0.0),
                at(bottom, half, 0.0),
            ],
        };
        let wall = 4.0;
        let balancing = balance((&disc, Some(&bore), &[]), (36.0, 95.0), wall, 1e-9);
        assert!(!balancing.holes.is_empty(), "{balancing:?}");
        let holes: Vec<Contour> =
            balancing.holes.iter().map(|(centre, radius)| Contour::circle(*centre, *radius)).collect();
        let all: Vec<&Contour> = std::iter::once(&disc).chain([&bore]).chain(&holes).collect();
        // The polygon of many points: its moment errs by the square of the step, so two steps give the limit.
        let points = |contour: &Contour, parts: u32| -> Vec<Vector2<f64>> {
            contour
                .edges()
                .flat_map(|s| (0..parts).map(move |i| s.point_and_tangent(f64::from(i) / f64::from(parts)).0))
                .collect()
        };
        let polygon = |contour: &Contour, parts: u32| {
            let points = points(contour, parts);
            let pairs = points.iter().zip(points.iter().cycle().skip(1));
            pairs.map(|(a, b)| (a + b) * (a.perp(b) / 6.0)).fold(Vector2::zeros(), |sum, next| sum + next)
        };
        let exact = |contour: &Contour| (polygon(contour, 2000) * 4.0 - polygon(contour, 1000)) / 3.0;
        let left = all.iter().skip(1).fold(exact(&disc), |sum, hole| sum - exact(hole));
        assert!(left.norm() < 1e-8 * balancing.before, "{left}");
        for (index, first) in all.iter().enumerate() {
            for second in all.iter().skip(index + 1) {
                let others = points(second, 600);
                for point in points(first, 600) {
                    let gap = others.iter().map(|other| (point - other).norm()).fold(f64::INFINITY, f64::min);
                    assert!(gap >= wall - 1e-9, "{gap}");
                }
            }
        }
        for (centre, _) in &balancing.holes {
            assert!(centre.x > bottom || centre.y.abs() > half, "a hole in the keyway is no hole: {centre}");
        }
    }
}

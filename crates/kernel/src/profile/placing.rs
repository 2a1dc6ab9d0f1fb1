//! The smallest cam over every place of a roller that keeps a pressure angle: the point of a convex region that is nearest to the
//! roller at rest ([`FollowerPlacement`]), hence a global optimum.
//!
//! The region is given by a half-plane for each cam angle and each sign of the pressure angle. It is found by exchange: the nearest
//! point of a few half-planes violates others, of which the worst of every piece of the motion are added until none is violated.

use crate::follower::place::{FollowerPlacement, HalfPlane};
use crate::motion::Motion;
use crate::numeric::extremum::{self, Extremum};
use nalgebra::Vector2;

/// Rounds of the exchange. Each settles the violated conditions to second order, so that few are needed.
const ROUNDS: usize = 60;
/// By how much a condition may be violated, over the size of the figures in it: rounding.
const BROKEN: f64 = 1e-14;
/// The allowed violation for a point that was computed from two of the conditions.
const KEPT: f64 = 3e-14;
/// The sine of the angle between borders below which they are parallel.
const PARALLEL: f64 = 1e-14;
/// A condition binds if its margin is below this share of the prime radius.
const BINDS: f64 = 1e-9;

/// A condition that the smallest cam just keeps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BindingPressureAngle {
    /// The motion's parameter, rad.
    pub at: f64,
    /// Whether it is the limit of negative pressure angles.
    pub falling: bool,
}

/// The smallest cam by the pressure angle alone.
#[derive(Debug, Clone, PartialEq)]
pub struct SmallestShaftPlace {
    /// The place of the shaft, as [`FollowerPlacement`] counts it, m.
    pub shaft: Vector2<f64>,
    /// Prime radius, m.
    pub prime_radius: f64,
    /// The conditions that bind there: one or two.
    pub binding: Vec<BindingPressureAngle>,
}

/// A condition, and the cam angle and limit it comes from.
struct AngleCondition {
    plane: HalfPlane,
    of: BindingPressureAngle,
}

/// The smallest cam with pressure angles up to `limits` (rad; positive and negative ones) over every place of the follower; `None`
/// where no place keeps them.
#[must_use]
pub fn nearest(motion: &dyn Motion, place: FollowerPlacement, limits: [f64; 2]) -> Option<SmallestShaftPlace> {
    let roller = place.of_roller();
    let mut held: Vec<AngleCondition> = Vec::new();
    let mut shaft = roller;
    for _ in 0..ROUNDS {
        let before = held.len();
        for (limit, falling) in limits.into_iter().zip([false, true]) {
            held.extend(broken(motion, place, limit, falling, shaft));
        }
        if held.len() == before {
            return Some(found(place, shaft, &held));
        }
        shaft = nearest_in(roller, &held)?;
    }
    Some(found(place, shaft, &held))
}

/// The most violated condition of every piece, for a place of the shaft, where one is violated.
fn broken(
    motion: &dyn Motion,
    place: FollowerPlacement,
    limit: f64,
    falling: bool,
    shaft: Vector2<f64>,
) -> Vec<AngleCondition> {
    let size = shaft.norm() + place.of_roller().norm();
    let pieces = motion.distinct().iter().enumerate().filter(|(index, _)| motion.is_rolled(*index));
    let conditions = pieces.filter_map(|(index, piece)| {
        let cells = motion.cells(index);
        let Extremum { at, value } = extremum::largest_with_slope(
            |at| {
                let plane = place.condition(&motion.jet(index, at), limit, falling);
                (plane.least - plane.normal.dot(&shaft), plane.least_slope - plane.normal_slope.dot(&shaft))
            },
            (piece.start, piece.end),
            cells,
        );
        let plane = place.condition(&motion.jet(index, at), limit, falling);
        (value > BROKEN * (size + plane.least.abs()))
            .then_some(AngleCondition { plane, of: BindingPressureAngle { at, falling } })
    });
    conditions.collect()
}

/// The point of an intersection of half-planes that is nearest to another; `None` where they have no point in common.
///
/// One half-plane after the other is added: where it cuts off the nearest point so far, the new one lies on its border (R. Seidel, "Small-dimensional
/// linear programming and convex hulls made easy", Discrete & Computational Geometry 6, 1991).
fn nearest_in(from: Vector2<f64>, held: &[AngleCondition]) -> Option<Vector2<f64>> {
    let size = held.iter().fold(from.norm(), |size, held| size.max(held.plane.least.abs()));
    let mut nearest = from;
    for (index, condition) in held.iter().enumerate() {
        let HalfPlane { normal, least, .. } = condition.plane;
        if least - normal.dot(&nearest) > KEPT * (size + nearest.norm()) {
            nearest = nearest_on_border(from, &condition.plane, held.get(..index).unwrap_or_default(), size)?;
        }
    }
    Some(nearest)
}

/// Where a border leaves another half-plane, and that one.
type BorderEnd = (f64, HalfPlane);

/// The point of a half-plane's border that is nearest to another point and lies in other half-planes: the foot, or a crossing of borders.
fn nearest_on_border(
    from: Vector2<f64>,
    border: &HalfPlane,
    others: &[AngleCondition],
    size: f64,
) -> Option<Vector2<f64>> {
    let along = Vector2::new(-border.normal.y, border.normal.x);
    let foot = from + border.normal * ((border.least - border.normal.dot(&from)) / border.normal.norm_squared());
    // The range of the border within the others, by the distance from the foot over the size of `along`, and which of them end it.
    let mut low: Option<BorderEnd> = None;
    let mut high: Option<BorderEnd> = None;
    for AngleCondition { plane, .. } in others {
        let (slope, lack) = (plane.normal.dot(&along), plane.least - plane.normal.dot(&foot));
        let at = lack / slope;
        if slope.abs() < PARALLEL {
            if lack > KEPT * (size + foot.norm()) {
                return None;
            }
        } else if slope > 0.0 && low.is_none_or(|(least, _)| at > least) {
            low = Some((at, *plane));
        } else if slope < 0.0 && high.is_none_or(|(most, _)| at < most) {
            high = Some((at, *plane));
        }
    }
    if let (Some((least, _)), Some((most, _))) = (low, high)
        && (least - most) * along.norm() > KEPT * (size + foot.norm())
    {
        return None;
    }
    Some(match (low, high) {
        (Some((least, plane)), _) if least > 0.0 => crossing(border, &plane),
        (_, Some((most, plane))) if most < 0.0 => crossing(border, &plane),
        _ => foot,
    })
}

/// Where the borders of two half-planes cross.
fn crossing(border: &HalfPlane, other: &HalfPlane) -> Vector2<f64> {
    let turn = border.normal.perp(&other.normal);
    let x = border.least * other.normal.y - other.least * border.normal.y;
    Vector2::new(x, border.normal.x * other.least - other.normal.x * border.least) / turn
}

fn found(place: FollowerPlacement, shaft: Vector2<f64>, held: &[AngleCondition]) -> SmallestShaftPlace {
    let prime_radius = (shaft - place.of_roller()).norm();
    let mut binding: Vec<BindingPressureAngle> = Vec::new();
    for AngleCondition { plane, of } in held.iter().rev() {
        let near =
            |other: &BindingPressureAngle| other.falling == of.falling && (other.at - of.at).abs() < BINDS.sqrt();
        let room = plane.normal.dot(&shaft) - plane.least;
        if room <= BINDS * (prime_radius + plane.least.abs()) && !binding.iter().any(near) {
            binding.push(*of);
        }
    }
    binding.sort_by(|a, b| a.at.total_cmp(&b.at));
    SmallestShaftPlace { shaft, prime_radius, binding }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::Quantity;
    use crate::motion::laws::named;
    use crate::motion::program::Program;

    /// Rise modified-sine in 120°, dwell 30°, return 3-4-5 in 150°, dwell.
    fn program(quantity: Quantity, lift: f64) -> Program {
        let deg = |degrees: f64| degrees.to_radians();
        let segments = [
            (named("modified-sine"), deg(120.0), lift),
            (None, deg(30.0), lift),
            (named("3-4-5"), deg(150.0), 0.0),
            (None, deg(60.0), 0.0),
        ];
        Program::new(quantity, 0.0, &segments).expect("a program")
    }

    fn near(found: f64, exact: f64) {
        assert!((found - exact).abs() < 1e-10 * exact.abs(), "{found} {exact}");
    }

    /// Golden numbers of 40-digit arithmetic.
    #[test]
    fn smallest_cams_under_a_translating_roller() {
        let motion = program(Quantity::Length, 0.03);
        let place = FollowerPlacement::Offset { radius: 0.015 };
        let deg = |degrees: f64| degrees.to_radians();
        for (limits, prime_radius, offset, height) in [
            ([30.0, 30.0], 27.968_068_710_370_43, 1.797_435_224_662_283, 27.910_250_697_568_89),
            ([30.0, 45.0], 19.621_874_916_440_54, 7.425_167_245_611_903, 18.162_732_905_901_87),
        ] {
            let found = nearest(&motion, place, limits.map(deg)).expect("a place");
            near(1e3 * found.prime_radius, prime_radius);
            near(1e3 * found.shaft.y, offset);
            near(1e3 * found.shaft.x, height);
            assert_eq!(found.binding.len(), 2, "{found:?}");
        }
    }

    #[test]
    fn smallest_cams_under_a_lever() {
        let motion = program(Quantity::Angle, 20.0_f64.to_radians());
        for (side, prime_radius, pivot, start) in [
            (1.0, 28.477_661_783_476_55, 119.275_452_412_615_7, 13.499_189_508_884_52),
            (-1.0, 28.088_205_874_136_27, 115.025_474_656_966_2, 14.111_938_284_913_35),
        ] {
            let place = FollowerPlacement::Pivot { arm: 0.11, radius: 0.016, side };
            let found = nearest(&motion, place, [35.0_f64.to_radians(); 2]).expect("a place");
            near(1e3 * found.prime_radius, prime_radius);
            near(1e3 * place.chosen(found.shaft), pivot);
            near(libm::atan2(found.shaft.y, found.shaft.x).to_degrees(), start);
        }
    }

    /// A swing so large that no place keeps a small angle throughout.
    #[test]
    fn a_limit_without_a_place_is_refused() {
        let motion = program(Quantity::Angle, 100.0_f64.to_radians());
        let place = FollowerPlacement::Pivot { arm: 0.11, radius: 0.016, side: 1.0 };
        assert_eq!(nearest(&motion, place, [10.0_f64.to_radians(); 2]), None);
    }
}

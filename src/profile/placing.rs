//! The smallest cam over every place of a roller that keeps a pressure angle: the point of a convex region that is nearest to the
//! roller at rest ([`Place`]), hence a global optimum.
//!
//! The region is given by a half-plane for each cam angle and each sign of the pressure angle. It is found by exchange: the nearest
//! point of a few half-planes breaks others, of which the worst of every piece of the motion are added until none is broken.

use crate::follower::place::{HalfPlane, Place};
use crate::motion::{Motion, Piece};
use crate::numeric::extremum::{self, Extremum};
use nalgebra::Vector2;

/// Rounds of the exchange. Each settles the broken places to second order, so that few are needed.
const ROUNDS: usize = 60;
/// By how much a condition may be broken, over the size of the figures in it: rounding.
const BROKEN: f64 = 1e-14;
/// The same for a point that was computed from two of the conditions.
const KEPT: f64 = 3e-14;
/// A condition that has no more room than this share of the prime radius binds.
const BINDS: f64 = 1e-9;

/// A condition that the smallest cam just keeps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Binding {
    /// The motion's parameter, rad.
    pub at: f64,
    /// It is the limit of negative pressure angles.
    pub falling: bool,
}

/// The smallest cam by the pressure angle alone.
#[derive(Debug, Clone, PartialEq)]
pub struct Nearest {
    /// The place of the shaft, as [`Place`] counts it, m.
    pub shaft: Vector2<f64>,
    /// Prime radius, m.
    pub prime_radius: f64,
    /// The conditions that hold it there: one or two.
    pub binding: Vec<Binding>,
}

/// A condition at an angle.
struct Held {
    plane: HalfPlane,
    of: Binding,
}

/// The smallest cam with pressure angles of at most `limits` (rad; positive and negative ones) over every place of the follower; `None`
/// where no place keeps them.
#[must_use]
pub fn nearest(motion: &dyn Motion, place: Place, limits: [f64; 2]) -> Option<Nearest> {
    let roller = place.of_roller();
    let mut held: Vec<Held> = Vec::new();
    let mut shaft = roller;
    for _ in 0..ROUNDS {
        let before = held.len();
        for (limit, falling) in limits.into_iter().zip([false, true]) {
            held.extend(broken(motion, place, (limit, falling), shaft));
        }
        if held.len() == before {
            return Some(found(place, shaft, &held));
        }
        shaft = nearest_in(roller, &held)?;
    }
    Some(found(place, shaft, &held))
}

/// The condition of every piece that the shaft breaks most, where it breaks one.
fn broken(motion: &dyn Motion, place: Place, (limit, falling): (f64, bool), shaft: Vector2<f64>) -> Vec<Held> {
    let size = shaft.norm() + place.of_roller().norm();
    let worst = |(index, piece): (usize, &Piece)| {
        let plane = |at: f64| place.condition(&motion.jet(index, at), limit, falling);
        let lack = |at: f64| {
            let plane = plane(at);
            (plane.least - plane.normal.dot(&shaft), plane.least_slope - plane.normal_slope.dot(&shaft))
        };
        let cells = motion.cells(index);
        let Extremum { at, value } = extremum::largest_with_slope(lack, (piece.start, piece.end), cells);
        let plane = plane(at);
        (value > BROKEN * (size + plane.least.abs())).then_some(Held { plane, of: Binding { at, falling } })
    };
    let pieces = motion.distinct().iter().enumerate().filter(|(index, _)| motion.is_rolled(*index));
    pieces.filter_map(worst).collect()
}

/// The point of half-planes that is nearest to another: that point, its foot on a border, or the crossing of two.
fn nearest_in(from: Vector2<f64>, held: &[Held]) -> Option<Vector2<f64>> {
    let size = held.iter().fold(from.norm(), |size, held| size.max(held.plane.least.abs()));
    let kept = |q: &Vector2<f64>| {
        held.iter().all(|held| held.plane.least - held.plane.normal.dot(q) <= KEPT * (size + q.norm()))
    };
    let foot = |held: &Held| {
        let HalfPlane { normal, least, .. } = held.plane;
        from + normal * ((least - normal.dot(&from)) / normal.norm_squared())
    };
    let crossing = |one: &Held, other: &Held| {
        let (a, b) = (one.plane, other.plane);
        let turn = a.normal.perp(&b.normal);
        let point =
            Vector2::new(a.least * b.normal.y - b.least * a.normal.y, a.normal.x * b.least - b.normal.x * a.least);
        (turn != 0.0).then(|| point / turn)
    };
    let feet = held.iter().map(foot);
    let crossings = held
        .iter()
        .enumerate()
        .flat_map(|(index, one)| held.iter().skip(index + 1).filter_map(move |other| crossing(one, other)));
    let distance = |q: &Vector2<f64>| (q - from).norm_squared();
    let all = std::iter::once(from).chain(feet).chain(crossings).filter(kept);
    all.min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

fn found(place: Place, shaft: Vector2<f64>, held: &[Held]) -> Nearest {
    let prime_radius = (shaft - place.of_roller()).norm();
    let mut binding: Vec<Binding> = Vec::new();
    for Held { plane, of } in held.iter().rev() {
        let near = |other: &Binding| other.falling == of.falling && (other.at - of.at).abs() < BINDS.sqrt();
        let room = plane.normal.dot(&shaft) - plane.least;
        if room <= BINDS * (prime_radius + plane.least.abs()) && !binding.iter().any(near) {
            binding.push(*of);
        }
    }
    binding.sort_by(|a, b| a.at.total_cmp(&b.at));
    Nearest { shaft, prime_radius, binding }
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
            (None, deg(30.0), 0.0),
            (named("3-4-5"), deg(150.0), 0.0),
            (None, deg(60.0), 0.0),
        ];
        Program::new(quantity, 0.0, &segments)
    }

    fn near(found: f64, exact: f64) {
        assert!((found - exact).abs() < 1e-10 * exact.abs(), "{found} {exact}");
    }

    /// Golden numbers of 40-digit arithmetic.
    #[test]
    fn smallest_cams_under_a_translating_roller() {
        let motion = program(Quantity::Length, 0.03);
        let place = Place::Offset { radius: 0.015 };
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
            let place = Place::Pivot { arm: 0.11, radius: 0.016, side };
            let found = nearest(&motion, place, [35.0_f64.to_radians(); 2]).expect("a place");
            near(1e3 * found.prime_radius, prime_radius);
            near(1e3 * place.chosen(found.shaft), pivot);
            near(libm::atan2(found.shaft.y, found.shaft.x).to_degrees(), start);
        }
    }

    /// A swing so large that no place keeps a small angle all the way.
    #[test]
    fn no_place_is_told() {
        let motion = program(Quantity::Angle, 100.0_f64.to_radians());
        let place = Place::Pivot { arm: 0.11, radius: 0.016, side: 1.0 };
        assert_eq!(nearest(&motion, place, [10.0_f64.to_radians(); 2]), None);
    }
}

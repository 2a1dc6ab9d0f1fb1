//! An open curve as arcs: between two places with their tangents two arcs that meet smoothly, halved until they keep the tolerance.
//!
//! The joint is that of equal tangent lengths (K. M. Bolton, Biarc curves, Computer-Aided Design 7, 1975).

use super::contour::Segment;
use nalgebra::Vector2;

/// Places of a stretch at which its arcs are compared with the curve, and how often a stretch is halved.
const PLACES: u32 = 8;
const HALVINGS: u32 = 16;
/// A turn below this, rad, or a sagitta below this, mm, is that of a straight line: the centre of so flat an arc has no digits left for its ends.
const STRAIGHT: f64 = 1e-12;
const FLAT: f64 = 1e-7;
/// An arc of a larger radius is a line, mm: the ends of an arc that is written by its centre and its angles are off by 1e-14 of it.
const LARGEST_RADIUS: f64 = 9e4;

/// A place of a curve (mm) and its unit tangent, by a parameter.
pub type Tangential<'a> = dyn Fn(f64) -> (Vector2<f64>, Vector2<f64>) + 'a;

/// The arcs that keep within a tolerance (mm) of a smooth curve over a range of its parameter; `None` where a curve cannot be followed.
#[must_use]
pub fn biarcs(curve: &Tangential<'_>, range: (f64, f64), tolerance: f64) -> Option<Vec<Segment>> {
    let mut found = Vec::new();
    add(curve, range.0, range.1, tolerance, HALVINGS, &mut found)?;
    Some(found)
}

fn add(curve: &Tangential<'_>, from: f64, to: f64, tolerance: f64, left: u32, found: &mut Vec<Segment>) -> Option<()> {
    let arcs = between(curve(from), curve(to));
    let off = (1..PLACES).map(|i| {
        let (place, _) = curve(from + (to - from) * f64::from(i) / f64::from(PLACES));
        arcs.iter().map(|arc| (arc.nearest(place).foot - place).norm()).fold(f64::INFINITY, f64::min)
    });
    if off.fold(0.0, |most: f64, next| if next <= most { most } else { next }) <= tolerance {
        found.extend(arcs);
        return Some(());
    }
    let left = left.checked_sub(1)?;
    let middle = 0.5 * (from + to);
    add(curve, from, middle, tolerance, left, found)?;
    add(curve, middle, to, tolerance, left, found)
}

/// The bulge of an arc with a chord that leads from a direction to another, neither of unit length; 0 where it is as good as straight.
fn bulge(from: Vector2<f64>, to: Vector2<f64>, chord: Vector2<f64>) -> f64 {
    let bulge = libm::tan(0.5 * libm::atan2(from.perp(&to), from.dot(&to)));
    let flat = 0.5 * bulge.abs() * from.norm().max(to.norm()) < FLAT;
    if flat || chord.norm() > 4.0 * bulge.abs() * LARGEST_RADIUS { 0.0 } else { bulge }
}

/// The two arcs between two places with their tangents, or the line where both lie on it.
fn between(
    (start, leaves): (Vector2<f64>, Vector2<f64>),
    (end, arrives): (Vector2<f64>, Vector2<f64>),
) -> Vec<Segment> {
    let (chord, both) = (end - start, leaves + arrives);
    let apart = 1.0 - leaves.dot(&arrives);
    let along = chord.dot(&both);
    let length = if apart < STRAIGHT {
        chord.norm_squared() / (2.0 * along)
    } else {
        ((along * along + 2.0 * apart * chord.norm_squared()).sqrt() - along) / (2.0 * apart)
    };
    let joint = 0.5 * (start + end + (leaves - arrives) * length);
    let (to_joint, from_joint) = (joint - start, end - joint);
    let first = Segment { start, end: joint, bulge: bulge(leaves, to_joint, to_joint) };
    let second = Segment { start: joint, end, bulge: bulge(from_joint, arrives, from_joint) };
    if first.bulge == 0.0 && second.bulge == 0.0 {
        vec![Segment { start, end, bulge: 0.0 }]
    } else {
        vec![first, second]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A circle is its own biarc, and a sine is followed within the tolerance with tangents that agree at every joint.
    #[test]
    fn a_curve_is_followed_within_the_tolerance() {
        let circle = |t: f64| {
            let (sin, cos) = libm::sincos(t);
            (Vector2::new(cos, sin) * 5.0, Vector2::new(-sin, cos))
        };
        assert_eq!(biarcs(&circle, (0.0, 1.0), 1e-9).expect("arcs").len(), 2);
        let sine = |t: f64| (Vector2::new(t, libm::sin(t)), Vector2::new(1.0, libm::cos(t)).normalize());
        let arcs = biarcs(&sine, (0.0, 6.0), 1e-4).expect("arcs");
        for pair in arcs.windows(2) {
            assert!((pair[0].end - pair[1].start).norm() < 1e-15);
            assert!((pair[0].end_tangent() - pair[1].start_tangent()).norm() < 1e-9);
        }
        for i in 0..=6000 {
            let place = sine(f64::from(i) * 1e-3).0;
            let off = arcs.iter().map(|arc| (arc.nearest(place).foot - place).norm()).fold(f64::INFINITY, f64::min);
            assert!(off < 1.3e-4, "{i}: {off}");
        }
        let line = |t: f64| (Vector2::new(t, 2.0), Vector2::x());
        assert_eq!(biarcs(&line, (0.0, 3.0), 1e-6).expect("a line").len(), 1);
    }
}

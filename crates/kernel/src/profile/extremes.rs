//! The worst places of a disc cam, solved from exact derivatives.

use super::Curves;
use crate::motion::{Jet, Motion, Piece};
use crate::numeric::chebyshev::{self, SearchStart};
use crate::numeric::extremum::{self, Extremum};
use nalgebra::Vector2;

/// Cells of every piece in the search.
fn everywhere(_piece: usize) -> bool {
    true
}

/// Largest value of a quantity over the pieces of the motion that are searched; `quantity` gives value and derivative at a cam
/// angle of a piece.
fn largest(
    curves: Curves<'_>,
    searched: impl Fn(usize) -> bool,
    quantity: impl Fn(usize, f64) -> (f64, f64),
) -> Extremum {
    largest_beyond(&places(curves, searched, &quantity), quantity)
}

/// Largest value of a quantity whose places between the cells, and the number of their piece, are given.
fn largest_beyond(
    all: &[(usize, Vec<extremum::ValueAndSlope>)],
    quantity: impl Fn(usize, f64) -> (f64, f64),
) -> Extremum {
    let known = all.iter().fold(NOTHING, |best, (_, places)| extremum::highest(best, places));
    all.iter().fold(known, |best, (index, places)| extremum::beyond(best, places, |at| quantity(*index, at)))
}

/// The places between the cells of every piece that is searched, with the number of the piece.
fn places(
    curves: Curves<'_>,
    searched: impl Fn(usize) -> bool,
    quantity: impl Fn(usize, f64) -> (f64, f64),
) -> Vec<(usize, Vec<extremum::ValueAndSlope>)> {
    let pieces = curves.motion.distinct().iter().enumerate().filter(|(index, _)| searched(*index));
    let places = pieces.map(|(index, piece)| {
        let cells = curves.motion.cells(index);
        (index, extremum::places(|at| quantity(index, at), (piece.start, piece.end), cells))
    });
    places.collect()
}

/// Cosine of the turn of the follower's curve within a cell below which the cell is halved, and how often: where a curve turns by half a
/// radian its curvature may have a spike, for example where a small radius is passed with a large acceleration.
const LEAST_COSINE: f64 = 0.88;
const MOST_HALVED: u32 = 20;
/// Places of a piece at which halving ends: a motion of a million waves turns in every cell, however short.
const MOST_PLACES: usize = 4096;

/// A place and the direction of the follower's curve there.
type PlaceAndDirection = (extremum::ValueAndSlope, Vector2<f64>);

/// Places of each piece with a quantity that comes with the direction of the follower's curve, cells halved where the curve turns much.
fn places_along(
    curves: Curves<'_>,
    searched: impl Fn(usize) -> bool,
    quantity: impl Fn(usize, f64) -> (f64, f64, Vector2<f64>),
) -> Vec<(usize, Vec<extremum::ValueAndSlope>)> {
    let pieces = curves.motion.distinct().iter().enumerate().filter(|(index, _)| searched(*index));
    let searched_pieces = pieces.map(|(index, piece)| {
        let at = |at: f64| {
            let (value, slope, direction) = quantity(index, at);
            (extremum::ValueAndSlope { at, value, slope }, direction)
        };
        let cells = curves.motion.cells(index);
        let mut places = Vec::with_capacity(cells as usize + 1);
        let mut before: Option<PlaceAndDirection> = None;
        for next in extremum::between_cells((piece.start, piece.end), cells).map(at) {
            if let Some(before) = before.filter(|_| !piece.dwell) {
                halved(before, next, MOST_HALVED, &at, &mut places);
            }
            places.push(next.0);
            before = Some(next);
        }
        (index, places)
    });
    searched_pieces.collect()
}

/// Adds the places within a cell in which the curve turns much.
fn halved(
    from: PlaceAndDirection,
    to: PlaceAndDirection,
    times: u32,
    at: &impl Fn(f64) -> PlaceAndDirection,
    places: &mut Vec<extremum::ValueAndSlope>,
) {
    if times > 0 && places.len() < MOST_PLACES && from.1.dot(&to.1) < LEAST_COSINE {
        let middle = at(0.5 * (from.0.at + to.0.at));
        halved(from, middle, times - 1, at, places);
        places.push(middle.0);
        halved(middle, to, times - 1, at, places);
    }
}

/// The larger of two, the first of equals; a number is preferred to NaN.
fn larger(best: Extremum, next: Extremum) -> Extremum {
    if next.value > best.value || best.value.is_nan() { next } else { best }
}

/// Cells of a piece, and golden sections, with which a value without derivative is searched: forces are smooth with one or two
/// maxima.
const FORCE_CELLS: u32 = 48;
const FORCE_SECTIONS: u32 = 30;

/// Largest value, where a follower runs, of something that depends on the cam angle of a piece and whose derivative is not known.
pub fn largest_without_slope(curves: Curves<'_>, value: impl Fn(usize, f64) -> f64) -> Extremum {
    let largest = curves.motion.distinct().iter().enumerate().filter(|(index, _)| curves.motion.is_rolled(*index)).map(
        |(index, piece)| {
            let (cells, sections) = if piece.dwell { (1, 0) } else { (FORCE_CELLS, FORCE_SECTIONS) };
            extremum::largest_without_slope(|angle| value(index, angle), (piece.start, piece.end), cells, sections)
        },
    );
    largest.fold(NOTHING, larger)
}

/// A closed range of the motion's parameter at whose ends a quantity may jump to its values within the range.
pub type JumpRange = (f64, f64);

/// How far from such an end the outside begins, as a share of the piece.
const OUTSIDE: f64 = 1e-12;

/// The stretches of a piece on which a quantity is smooth that may jump at the ends of these ranges.
#[must_use]
pub fn stretches(piece: &Piece, acting: &[JumpRange]) -> Vec<(f64, f64)> {
    let outside =
        (OUTSIDE * (piece.end - piece.start)).max(4.0 * f64::EPSILON * piece.end.abs().max(piece.start.abs()));
    let mut stretches = Vec::new();
    let mut from = piece.start;
    for &(start, end) in acting {
        if from < start && start < piece.end {
            stretches.push((from, start - outside));
            from = start;
        }
        if from < end && end < piece.end {
            stretches.push((from, end));
            from = end + outside;
        }
    }
    stretches.push((from, piece.end));
    stretches
}

/// Largest value, or size, where a follower runs, of something that is smooth on each piece except at the ends of the ranges
/// `acting`.
fn of_smooth(
    motion: &dyn Motion,
    (acting, negligible): (&[JumpRange], f64),
    value: impl Fn(usize, f64) -> f64,
    search: impl Fn(&dyn Fn(f64) -> f64, (f64, f64), SearchStart) -> Extremum,
) -> Extremum {
    let mut known = SearchStart::nothing(negligible);
    // Where the follower rests, a force may still change.
    for (index, piece) in motion.distinct().iter().enumerate().filter(|(index, _)| motion.is_rolled(*index)) {
        for range in stretches(piece, acting) {
            known.best = search(&|at| value(index, at), range, known);
        }
    }
    known.best
}

/// Largest value, where a follower runs, of something that is smooth on each piece except at the ends of the ranges `acting`;
/// differences below `negligible` do not matter.
pub fn largest_smooth(
    curves: Curves<'_>,
    (acting, negligible): (&[JumpRange], f64),
    value: impl Fn(usize, f64) -> f64,
) -> Extremum {
    largest_of_motion(curves.motion, (acting, negligible), value)
}

/// Largest value of something that does not depend on the follower, smooth except at the ends of the ranges `acting`.
pub fn largest_of_motion(
    motion: &dyn Motion,
    smooth: (&[JumpRange], f64),
    value: impl Fn(usize, f64) -> f64,
) -> Extremum {
    of_smooth(motion, smooth, value, |value, range, known| chebyshev::largest(value, range, known))
}

/// Largest size of something with a sign, where a follower runs.
pub fn largest_size(
    curves: Curves<'_>,
    (acting, negligible): (&[JumpRange], f64),
    value: impl Fn(usize, f64) -> f64,
) -> Extremum {
    largest_size_of_motion(curves.motion, (acting, negligible), value)
}

/// Largest size of something with a sign that does not depend on the follower.
pub fn largest_size_of_motion(
    motion: &dyn Motion,
    smooth: (&[JumpRange], f64),
    value: impl Fn(usize, f64) -> f64,
) -> Extremum {
    of_smooth(motion, smooth, value, |value, range, known| chebyshev::largest_size(value, range, known))
}

const NOTHING: Extremum = Extremum { at: 0.0, value: f64::NEG_INFINITY };

/// Largest |pressure angle| where a follower runs, rad.
#[must_use]
pub fn pressure_angle(curves: Curves<'_>) -> Extremum {
    let [rising, falling] = pressure_angles(curves);
    if rising.value >= falling.value { rising } else { falling }
}

/// Largest pressure angle and largest pressure angle of the opposite sign, as a positive number, where a follower runs, rad.
#[must_use]
pub fn pressure_angles(curves: Curves<'_>) -> [Extremum; 2] {
    let along = |piece: usize, angle: f64| {
        let contact = curves.contact(piece, angle);
        (contact.pressure_angle, contact.pressure_angle_slope, contact.curve.tangent)
    };
    let (motion, symmetric) = (curves.motion, curves.follower.is_symmetric());
    // Mirrored it has the opposite sign.
    let in_mirror_of = |piece: usize| {
        let (first, in_mirror) = motion.repeats(piece);
        (symmetric && in_mirror && first < piece && motion.is_rolled(first)).then_some(first)
    };
    let mut rising = places_along(curves, |piece| motion.is_rolled(piece) && in_mirror_of(piece).is_none(), along);
    for (index, piece) in motion.distinct().iter().enumerate().filter(|(index, _)| motion.is_rolled(*index)) {
        let first = in_mirror_of(index).and_then(|first| rising.iter().find(|(other, _)| *other == first));
        let Some(((_, places), own)) = first.and_then(|found| Some((found, motion.pieces().get(found.0)?))) else {
            continue;
        };
        let places = places.iter().rev().map(|place| {
            let at = (own.end - place.at + piece.start).clamp(piece.start, piece.end);
            extremum::ValueAndSlope { at, value: -place.value, slope: place.slope }
        });
        let places = places.collect();
        rising.push((index, places));
    }
    rising.sort_by_key(|(index, _)| *index);
    let falling: Vec<_> =
        rising.iter().map(|(index, places)| (*index, places.iter().map(|place| place.negative()).collect())).collect();
    [(rising, 1.0), (falling, -1.0)].map(|(all, sign)| {
        largest_beyond(&all, |piece, at| {
            let (angle, slope, _) = along(piece, at);
            (sign * angle, sign * slope)
        })
    })
}

/// Largest curvature of the follower's curve, 1/m: the sharpest convex place, as seen from the metal.
#[must_use]
pub fn convex_curvature(curves: Curves<'_>) -> Extremum {
    convex_curvature_on(curves, everywhere)
}

/// Largest curvature over the pieces that are searched; −∞ where there are none.
#[must_use]
pub fn convex_curvature_on(curves: Curves<'_>, searched: impl Fn(usize) -> bool) -> Extremum {
    largest_curvature(curves, searched, curves.metal_side())
}

/// The largest curvature of one sign.
fn largest_curvature(curves: Curves<'_>, searched: impl Fn(usize) -> bool, sign: f64) -> Extremum {
    let along = |piece: usize, at: f64| {
        let pitch = curves.touch(piece, at).curve;
        (sign * pitch.curvature, sign * pitch.curvature_slope * pitch.speed, pitch.tangent)
    };
    // Mirrored it is the same.
    let symmetric = curves.follower.is_symmetric();
    let is_first = |piece: usize| searched(piece) && !(symmetric && curves.motion.repeats(piece).0 != piece);
    largest_beyond(&places_along(curves, is_first, along), |piece, at| {
        let (curvature, slope, _) = along(piece, at);
        (curvature, slope)
    })
}

/// Smallest radius of curvature under a face, m, signed: not positive where the profile turns back on itself.
#[must_use]
pub fn least_radius(curves: Curves<'_>) -> Extremum {
    least_radius_on(curves, everywhere)
}

/// Smallest radius over the pieces that are searched; ∞ where there are none.
#[must_use]
pub fn least_radius_on(curves: Curves<'_>, searched: impl Fn(usize) -> bool) -> Extremum {
    let least = largest(curves, searched, |piece, angle| {
        let (radius, slope) = curves.face_radius(piece, angle);
        (-radius, -slope)
    });
    Extremum { at: least.at, value: -least.value }
}

/// The places where a flat face touches, least and largest, m, as [`FaceTouch::place`](crate::follower::FaceTouch::place), while the follower runs;
/// `None` for a roller.
#[must_use]
pub fn places_on_face(curves: Curves<'_>) -> Option<[Extremum; 2]> {
    curves.follower.on_face(&Jet::default())?;
    let place = |piece: usize, at: f64| {
        let face = curves.follower.on_face(&curves.motion.jet(piece, at));
        face.map_or(f64::NAN, |face| face.place)
    };
    let most = largest_smooth(curves, (&[], 0.0), place);
    let least = largest_smooth(curves, (&[], 0.0), |piece, at| -place(piece, at));
    Some([Extremum { value: -least.value, ..least }, most])
}

/// Least rate at which the normal of a flat face turns on the cam, and where; `None` for a roller.
#[must_use]
pub fn least_turn(curves: Curves<'_>) -> Option<Extremum> {
    curves.follower.on_face(&Jet::default())?;
    let backwards = largest(curves, everywhere, |piece, at| {
        let lift = curves.motion.jet(piece, at);
        // Linear in the velocity.
        let [turn, at_one, at_rest] = [lift.ds, 1.0, 0.0]
            .map(|ds| curves.follower.on_face(&Jet { ds, ..lift }).map_or(f64::NAN, |face| face.turn));
        (-turn, -(at_one - at_rest) * lift.dds)
    });
    Some(Extremum { value: -backwards.value, ..backwards })
}

/// Largest concave curvature of the profile, 1/m (positive; negative when nothing is concave), and the place; concave as seen from the metal.
///
/// The profile's concave radius is the pitch curve's plus the roller radius: both are sharpest at the same place.
#[must_use]
pub fn concave_profile_curvature(curves: Curves<'_>) -> Extremum {
    let pitch = largest_curvature(curves, everywhere, -curves.metal_side());
    Extremum { at: pitch.at, value: pitch.value / (1.0 + pitch.value * curves.offset().abs()) }
}

/// A shorter step back of the profile does not count, m: the motion it loses is its square over the radius of curvature.
const LEAST_FOLD: f64 = 1e-9;

/// Where the profile under a flat face steps back along itself because the velocity drops, the longest step: a length below 0, m, and the
/// end of the piece before it. `None` where there is no such step.
#[must_use]
pub fn fold(curves: Curves<'_>) -> Option<Extremum> {
    curves.follower.on_face(&Jet::default())?;
    let pieces = curves.motion.pieces();
    let steps = pieces.iter().enumerate().filter_map(|(index, before)| {
        let next = (index + 1) % pieces.len();
        let left = curves.touch(index, before.end).curve;
        let right = curves.touch(next, pieces.get(next)?.start).curve;
        // At the seam the first piece begins a turn earlier.
        Some(Extremum { at: before.end, value: (right.point - left.point).dot(&left.tangent) })
    });
    steps.filter(|step| step.value < -LEAST_FOLD).min_by(|a, b| a.value.total_cmp(&b.value))
}

/// A corner of the pitch curve between two pieces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// The motion's parameter.
    pub at: f64,
    /// Turn of the tangent, rad: positive to the left (convex), negative to the right (concave).
    pub turn: f64,
}

/// A turn below this is not a corner, rad: under a roller of 10 mm the profile steps back by 1 nm there, as where a fold begins under a
/// face, and 1e-17 m of the motion are lost. That is far below the 0.05° a shop tolerates, and above the rounding of any motion.
const LEAST_CORNER: f64 = 1e-7;

/// The corners of the pitch curve, in the order of the pieces; each is at the end of a piece.
#[must_use]
pub fn corners(curves: Curves<'_>) -> Vec<Corner> {
    let pieces = curves.motion.pieces();
    let joints = if curves.motion.period().is_some() { pieces.len() } else { pieces.len().saturating_sub(1) };
    let corners = (0..joints).filter_map(|index| {
        let next = (index + 1) % pieces.len();
        let (before, after) = (pieces.get(index)?, pieces.get(next)?);
        let left = curves.touch(index, before.end).curve.tangent;
        let right = curves.touch(next, after.start).curve.tangent;
        let turn = libm::atan2(left.perp(&right), left.dot(&right));
        (turn.abs() > LEAST_CORNER).then_some(Corner { at: before.end, turn })
    });
    corners.collect()
}

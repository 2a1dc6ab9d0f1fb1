//! A SPLINE entity as chords.

use crate::geometry::contour::Segment;
use dxf::entities::Spline;
use nalgebra::Vector2;

/// Turn of a chord against the next, degrees: well below the kink a shop tolerates.
const TURN: f64 = 0.02;
/// Chords of a knot span, at the least and at the most.
const CHORDS: (f64, f64) = (4.0, 5_000.0);
/// Shortest chord that is made, mm: a spline that turns within less has a corner there.
const SHORTEST_CHORD: f64 = 1e-3;
/// Chords from which the turn of a span is guessed.
const GUESS: u32 = 16;

/// The spline as chords; `None` when it has no consistent control points and knots.
pub(super) fn chords(spline: &Spline) -> Option<Vec<Segment>> {
    let degree = usize::try_from(spline.degree_of_curve).ok().filter(|degree| (1..=11).contains(degree))?;
    let points = &spline.control_points;
    let knots = &spline.knot_values;
    let weight = |i: usize| spline.weight_values.get(i).copied().filter(|w| *w > 0.0).unwrap_or(1.0);
    if points.len() <= degree || knots.len() != points.len() + degree + 1 || !knots.is_sorted() {
        return None;
    }
    // Homogeneous control points.
    let poles: Vec<[f64; 3]> =
        points.iter().enumerate().map(|(i, p)| [p.x * weight(i), p.y * weight(i), weight(i)]).collect();
    let mut places = Vec::new();
    for span in degree..points.len() {
        let (low, high) = (*knots.get(span)?, *knots.get(span + 1)?);
        if high <= low {
            continue;
        }
        let at = |share: f64| de_boor(degree, span, knots, &poles, low + (high - low) * share);
        let guess: Option<Vec<_>> = (0..=GUESS).map(|i| at(f64::from(i) / f64::from(GUESS))).collect();
        let sides: Vec<Vector2<f64>> = guess?
            .windows(2)
            .map(|pair| match pair {
                [a, b] => b - a,
                _ => Vector2::zeros(),
            })
            .collect();
        let turn = |pair: &[Vector2<f64>]| match pair {
            [a, b] => libm::atan2(a.perp(b), a.dot(b)).abs().to_degrees(),
            _ => 0.0,
        };
        let sharpest = sides.windows(2).map(turn).fold(0.0, f64::max);
        let length: f64 = sides.iter().map(nalgebra::Matrix::norm).sum();
        if !length.is_finite() {
            return None;
        }
        let most = (length / SHORTEST_CHORD).clamp(CHORDS.0, CHORDS.1);
        let count = (f64::from(GUESS) * sharpest / TURN).clamp(CHORDS.0, most).ceil();
        let mut step = if places.is_empty() { 0.0 } else { 1.0 };
        while step <= count {
            places.push(at(step / count)?);
            step += 1.0;
        }
    }
    let segment = |pair: &[Vector2<f64>]| match pair {
        [start, end] => Some(Segment { start: *start, end: *end, bulge: 0.0 }),
        _ => None,
    };
    places.windows(2).map(segment).collect()
}

/// De Boor's algorithm in homogeneous coordinates.
fn de_boor(degree: usize, span: usize, knots: &[f64], poles: &[[f64; 3]], t: f64) -> Option<Vector2<f64>> {
    let mut d: Vec<[f64; 3]> = poles.get(span - degree..=span)?.to_vec();
    for level in 1..=degree {
        for j in (level..=degree).rev() {
            let (low, high) = (*knots.get(span - degree + j)?, *knots.get(span + j - level + 1)?);
            let share = if high > low { (t - low) / (high - low) } else { 0.0 };
            let (before, here) = (*d.get(j - 1)?, *d.get(j)?);
            let mixed = std::array::from_fn(|k| match (before.get(k), here.get(k)) {
                (Some(a), Some(b)) => a * (1.0 - share) + b * share,
                _ => 0.0,
            });
            *d.get_mut(j)? = mixed;
        }
    }
    let [x, y, w] = *d.get(degree)?;
    Some(Vector2::new(x / w, y / w))
}

//! Points of a spline for a stretch that no law follows: the positions smoothed within the deviation, then as few points as keep it.

use super::positions::Positions;
use camgen_kernel::motion::Motion;
use camgen_kernel::motion::laws::{self, Parameters};
use camgen_kernel::motion::program::rows::{RowShape, RowWishes, SplineRows};
use camgen_kernel::motion::program::{EndState, Mover, Program, SegmentSpec};
use std::f64::consts::TAU;

/// The share of the deviation within which positions are smoothed: the rest is for the choice of points.
const SMOOTHED: f64 = 0.85;
/// Fewest points, and the growth of their number until they keep the deviation.
const FEWEST: usize = 6;
const GROWS: f64 = 1.25;
/// More points must not lower the largest acceleration by more than this.
const ACCELERATION: f64 = 1.05;

/// The points between the ends of a stretch, each an angle (rad) and a position, from the node at its start to that at its end.
pub(super) fn points(rows: &Positions, start: (f64, f64), end: (f64, f64), deviation: f64) -> Vec<[f64; 2]> {
    let inside: Vec<[f64; 2]> = (0..=2 * rows.len())
        .map(|at| [rows.angle(at) - turns(rows, start.0), rows.value(at)])
        .filter(|[angle, _]| *angle > start.0 + 1e-9 && *angle < end.0 - 1e-9)
        .collect();
    let Some(smooth) = program(rows, (start, end), &inside, Some(SMOOTHED * deviation)) else { return inside };
    let at = |program: &Program, angle: f64| position(program, angle);
    let off =
        |program: &Program| inside.iter().map(|[angle, value]| (at(program, *angle) - value).abs()).fold(0.0, f64::max);
    let peak = |program: &Program| program.segments().first().map_or(0.0, |segment| segment.peaks[1].0);
    let mut count = FEWEST.min(inside.len());
    loop {
        let chosen: Vec<[f64; 2]> = (1..=count)
            .map(|point| {
                #[expect(clippy::cast_precision_loss, reason = "few points")]
                let angle = start.0 + (end.0 - start.0) * point as f64 / (count + 1) as f64;
                [angle, at(&smooth, angle)]
            })
            .collect();
        let all = count >= inside.len();
        let made = program(rows, (start, end), &chosen, None);
        if made.is_some_and(|made| off(&made) <= deviation && peak(&made) <= ACCELERATION * peak(&smooth)) || all {
            return chosen;
        }
        #[expect(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "few points"
        )]
        let more = (GROWS * count as f64).ceil() as usize;
        count = more.min(inside.len());
    }
}

/// Whole fillings between the first position and an angle.
fn turns(rows: &Positions, angle: f64) -> f64 {
    let first = rows.angles.first().copied().unwrap_or(0.0);
    -((angle - first) / rows.fill).floor() * rows.fill
}

/// A program whose first segment is a spline through, or near, points between two nodes; the rest leads back.
fn program(
    rows: &Positions,
    (start, end): ((f64, f64), (f64, f64)),
    points: &[[f64; 2]],
    smooth: Option<f64>,
) -> Option<Program> {
    let own = points.iter().map(|[angle, value]| [angle - start.0, *value]).collect();
    let wishes = RowWishes { shape: RowShape::Natural, cubic: false, smooth };
    let spline = SplineRows { points: own, rounding: 0.0, wishes };
    let spec = |mover, over, to| SegmentSpec { mover, over, to, end: EndState::default(), free_start: false };
    let back = if start.1 == end.1 {
        Mover::Dwell
    } else {
        Mover::Law(laws::named("cycloidal")?, None, Parameters::default())
    };
    let over = end.0 - start.0;
    let steps = [spec(Mover::Spline(spline), over, end.1), spec(back, TAU - over, start.1)];
    Program::of_steps(rows.quantity, start.0, start.1, 1, &steps).ok()
}

/// The position of a program at an angle.
pub(super) fn position(program: &Program, angle: f64) -> f64 {
    let (piece, inside) = program.locate(angle);
    program.jet(piece, inside).s + program.origin().unwrap_or(0.0)
}

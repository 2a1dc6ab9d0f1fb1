//! Worst places over a turn of the cam, and along the rollers that touch it.

use super::groove::{CELLS, SweptGroove};
use super::line::RollerLine;
use super::{BlankSurface, FlankSide, SweptGeometry};
use camgen_kernel::motion::Jet;
use camgen_kernel::numeric::extremum::{self, Extremum};
use camgen_kernel::numeric::{parallel, quadrature};
use camgen_kernel::profile::Worst;

/// Golden sections to a place.
const SECTIONS: u32 = 50;
/// Panels of eight points for a radian of cam angle.
const PANELS_PER_RADIAN: f64 = 4.0;

/// The largest of a value of the motion.
pub(crate) fn largest_of_motion(groove: &SweptGroove, value: impl Fn(&Jet) -> f64) -> Worst {
    worst(over_pieces(groove, value))
}

/// The largest of a value of the centre lines of all rollers that are near.
pub(crate) fn largest<B: SweptGeometry>(body: &B, value: impl Fn(&Jet, &B::Line) -> f64 + Sync) -> Worst {
    let rollers: Vec<i32> = body.rollers().collect();
    let found = parallel::map(&rollers, |roller| {
        over_pieces(body.groove(), |lift| {
            let line = body.line(lift, *roller);
            if body.is_near(&line) { value(lift, &line) } else { f64::NEG_INFINITY }
        })
    });
    worst(found.into_iter().flatten().reduce(larger))
}

fn over_pieces(groove: &SweptGroove, value: impl Fn(&Jet) -> f64) -> Option<Extremum> {
    let pieces = groove.motion.pieces().iter().enumerate();
    let found = pieces.map(|(index, piece)| {
        let at = |angle: f64| value(&groove.motion.jet(index, angle));
        extremum::largest_without_slope(at, (piece.start, piece.end), CELLS, SECTIONS)
    });
    found.reduce(larger)
}

fn larger(a: Extremum, b: Extremum) -> Extremum {
    if b.value > a.value { b } else { a }
}

fn worst(found: Option<Extremum>) -> Worst {
    found.map_or(Worst::NONE, |Extremum { value, at, .. }| Worst { value, at, z: 0.0 })
}

/// Largest pressure angle with the lift growing, and falling as a positive number, rad, anywhere along the rollers.
pub(crate) fn pressure_angles<B: SweptGeometry>(body: &B) -> [Worst; 2] {
    let steepest = |sign: f64| {
        largest(body, |lift, line| {
            let angles = body.touched(line).map(|v| {
                // Where the roller misses the cam nothing keeps a limit.
                if v.is_nan() { f64::INFINITY } else { sign * body.pressure_angle(lift, line, v) }
            });
            angles.into_iter().fold(0.0, f64::max)
        })
    };
    let falling = if B::RETURNS { steepest(-1.0) } else { Worst { value: 0.0, at: 0.0, z: 0.0 } };
    [steepest(1.0), falling]
}

/// Smallest distance from a roller's axis at which a flank self-intersects, m, over the groove's depth. The depth is taken between the points at
/// which the flank itself meets the floor and the outside; at a pressure angle these are nearer to the shaft than those of the roller's axis.
pub(crate) fn least_fold<B: SweptGeometry>(body: &B) -> Worst {
    let sharpest = largest(body, |_, line| {
        let folds = FlankSide::BOTH.map(|flank| {
            let sign = body.groove().signed(flank).signum();
            let [floor, outside] = [BlankSurface::Floor, BlankSurface::Outside].map(|surface| {
                // A flank that does not reach a surface keeps no limit.
                body.contact_on(line, flank, surface).map_or(0.0, |point| line.folds_at(&point, sign))
            });
            floor.min(outside)
        });
        folds.into_iter().map(f64::recip).fold(0.0, f64::max)
    });
    Worst { value: sharpest.value.recip(), ..sharpest }
}

/// Largest reduced curvature of both flanks at the ends of the rollers' reach, 1/m.
pub(crate) fn sharpest_curvature<B: SweptGeometry>(body: &B) -> f64 {
    let [upper, lower] = body.groove().distances;
    let sharpest = largest(body, |_, line| {
        let curvatures = body.touched(line).into_iter().flat_map(|v| {
            let point = line.point(v);
            [upper, -lower].map(|distance| line.reduced_curvature(&point, distance))
        });
        curvatures.fold(0.0, f64::max)
    });
    sharpest.value
}

/// The integral over a range of cam angles within a piece.
pub(crate) fn integrate_smooth(value: impl Fn(f64) -> f64, (from, to): (f64, f64)) -> f64 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a turn has few panels")]
    let panels = ((to - from) * PANELS_PER_RADIAN).ceil().max(1.0) as u32;
    quadrature::integrate(value, (from, to), panels)
}

//! The exact profile as a closed loop, the reference for the proof of a written outline.

use super::envelope::{self, BreakSide, NoEnvelope, Parallel, UndercutLoss};
use super::outline::OutlineError;
use super::{Curves, extremes, outline};
use crate::geometry::MILLIMETRES;
use crate::geometry::boundary::BoundaryStretch;
use crate::geometry::contour::Segment;
use crate::motion::Piece;
use nalgebra::Vector2;

/// Stretches into which a piece of the motion is divided, so that none turns far: a piece turns by half a circle or little more.
const STRETCHES: u32 = 8;
/// A dwell turns evenly: stretches of this angle, rad.
const DWELL_STRETCH: f64 = 0.9;

/// The profile as stretches in millimetres, in the order of the motion, without the loops where it is undercut; with `sharp` where
/// loops are possible: where a convex radius of the follower's curve is not larger than its distance from the profile.
///
/// # Errors
/// [`NoEnvelope`] when the profile folds over itself without an envelope.
pub fn stretches(curves: Curves<'_>, sharp: bool) -> Result<Vec<BoundaryStretch>, NoEnvelope> {
    let losses: Vec<UndercutLoss> = if sharp { envelope::losses(curves)? } else { Vec::new() };
    let gaps: Vec<(f64, f64)> = losses.iter().map(|loss| (loss.from, loss.to)).collect();
    let (pieces, period) = (curves.motion.pieces(), curves.motion.period());
    let corners = extremes::corners(curves);
    let mut all = Vec::new();
    for (index, piece) in pieces.iter().enumerate() {
        for range in outline::parts(piece, &gaps, period) {
            all.extend(cut(index, piece, range.0, range.1, period.is_none()));
        }
        // At a concave corner of the pitch curve the roller turns in place: an arc of its own radius.
        if let Some(corner) = corners.iter().find(|corner| corner.turn < 0.0 && corner.at == piece.end)
            && curves.offset() > 0.0
        {
            let start = curves.profile(index, piece.end).point * MILLIMETRES;
            let next = (index + 1) % pieces.len();
            let end =
                pieces.get(next).map_or(start, |next_piece| curves.profile(next, next_piece.start).point * MILLIMETRES);
            all.push(BoundaryStretch::of_segment(Segment { start, end, bulge: libm::tan(0.25 * corner.turn) }));
        }
    }
    Ok(all)
}

/// The follower's own curve as stretches in millimetres: the path of a roller's centre.
#[must_use]
pub fn of_centre(curves: Curves<'_>) -> Vec<BoundaryStretch> {
    let period = curves.motion.period();
    let stretches = curves.motion.pieces().iter().enumerate().flat_map(|(index, piece)| {
        let ranges = outline::parts(piece, &[], period).into_iter();
        ranges.flat_map(|range| cut(index, piece, range.0, range.1, period.is_none())).collect::<Vec<_>>()
    });
    stretches.collect()
}

/// The exact path of the centre of a cutter (radius in m) along the profile as stretches in millimetres: parallel to the
/// follower's curve, with an arc of the cutter's radius about an edge of the profile.
///
/// # Errors
/// [`OutlineError`] when the cutter does not get into a concave part, or the profile folds over itself.
pub fn of_cutter(curves: Curves<'_>, cutter_radius: f64) -> Result<Vec<BoundaryStretch>, OutlineError> {
    outline::check_cutter_fits(curves, cutter_radius)?;
    let distance = curves.offset() - curves.metal_side() * cutter_radius;
    let gaps = outline::undrawn_stretches(curves, distance)?;
    let spans: Vec<(f64, f64)> = gaps.iter().map(|gap| (gap.from, gap.to)).collect();
    let (pieces, period) = (curves.motion.pieces(), curves.motion.period());
    let corners = extremes::corners(curves);
    let parallel = Parallel { curves, distance };
    let mut all = Vec::new();
    for (index, piece) in pieces.iter().enumerate() {
        let ranges = outline::parts(piece, &spans, period);
        for range in &ranges {
            all.extend(cut(index, piece, range.0, range.1, period.is_none()));
            if let Some(gap) = gaps.iter().find(|gap| gap.arc != 0.0 && outline::starts_at(gap, range.1, period)) {
                let start = parallel.in_piece(index, range.1).point;
                all.push(arc_stretch(start, parallel.point_at(gap.to, BreakSide::After).point, gap.arc));
            }
        }
        let whole = ranges.last().is_some_and(|range| range.1 == piece.end);
        // Along the arc that a roller makes at a concave corner of its path, a smaller cutter turns about the same centre.
        if let Some(corner) = corners.iter().find(|corner| corner.turn < 0.0 && corner.at == piece.end)
            && distance > 0.0
            && whole
        {
            let start = parallel.in_piece(index, piece.end).point;
            all.push(arc_stretch(start, parallel.point_at(piece.end, BreakSide::After).point, corner.turn));
        }
    }
    Ok(all)
}

/// An arc between two points (m) that turns by an angle (rad), in millimetres.
fn arc_stretch(start: Vector2<f64>, end: Vector2<f64>, turn: f64) -> BoundaryStretch {
    BoundaryStretch::of_segment(Segment {
        start: start * MILLIMETRES,
        end: end * MILLIMETRES,
        bulge: libm::tan(0.25 * turn),
    })
}

/// A range of a piece as stretches; the dwell of a cam without rotation is straight.
pub fn cut(
    index: usize,
    piece: &Piece,
    from: f64,
    to: f64,
    straight: bool,
) -> impl Iterator<Item = BoundaryStretch> + use<> {
    let count = match (piece.dwell, straight) {
        (true, true) => 1.0,
        (true, false) => ((to - from) / DWELL_STRETCH).ceil().max(1.0),
        (false, _) => f64::from(STRETCHES),
    };
    let at =
        move |step: u32| if f64::from(step) >= count { to } else { from + (to - from) * (f64::from(step) / count) };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a dozen")]
    let steps = count as u32;
    (0..steps).map(move |step| BoundaryStretch::of_curve(index, at(step), at(step + 1)))
}

//! A profile as a chain of tangent arcs or of cubic splines in millimetres, piece by piece: where curves are sampled, once, to a stated tolerance.
//!
//! Tolerances are in metres, like everything that comes in; contours and their measures are in millimetres.

mod laying;

use crate::document::NamedChoice;
use crate::refusal::Refusal;
use laying::{OutlineStrips, ParallelStretch};
pub use laying::{allowed, too_many_arcs};

use super::envelope::{BreakSide, NoEnvelope, Parallel, ParallelLoop};
use super::{Curves, extremes};
use crate::follower::Element;
use crate::geometry::arcs::FitError;
use crate::geometry::contour::{Contour, Segment, Vertex};
use crate::geometry::{CurvePoint, MILLIMETRES};
use crate::motion::Piece;
use std::f64::consts::PI;

/// A piece that turns by more than a half circle is fitted in two, so that no arc ends where it starts.
const LONGEST_PIECE: f64 = PI * (1.0 + 1e-12);

/// A dwell is one arc up to here; beyond, its ends are so close that readers cannot determine its centre.
const LONGEST_DWELL: f64 = 1.9 * PI;

/// Largest coordinate a drawing may have, mm: readers treat larger ones as mistakes.
pub const LARGEST_COORDINATE: f64 = 1e6;
/// Places of a piece at which its size is examined first.
const LOOKS: u32 = 8;
/// Most edges of an outline: some ten times as many as a busy cam has; a control reads some thousand blocks a second.
const MOST_EDGES: u32 = 20_000;

/// Tolerance of the pitch curve on a sheet, which is for viewing only: a fifth of a thin pen, m.
const PITCH_TOLERANCE: f64 = 0.05e-3;

/// A shorter arc about an edge is left out, mm: a reader would take its ends for one point.
const SHORTEST_ARC: f64 = 1e-5;

/// A gap may lie a turn before or after a piece.
const TURNS: [f64; 3] = [-1.0, 0.0, 1.0];

/// On which side of the exact curve an outline may lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Side {
    /// On either side.
    #[default]
    Both,
    /// Within the metal of the exact cam: no excess metal.
    Inside,
    /// Outside it: never cut too deep.
    Outside,
}

impl NamedChoice for Side {
    const ALL: &'static [(&'static str, Self)] =
        &[("both", Self::Both), ("inside", Self::Inside), ("outside", Self::Outside)];
}

/// Largest errors of the follower's motion as cut, by the angle of the shaft that gives the time, m or rad per rad and rad²;
/// infinite where they do not matter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionTolerance {
    /// Of the velocity.
    pub velocity: f64,
    /// Of the acceleration.
    pub acceleration: f64,
}

impl MotionTolerance {
    /// Only the distance matters.
    pub const ANY: Self = Self { velocity: f64::INFINITY, acceleration: f64::INFINITY };
}

/// The kind of segments of the curved pieces of an outline; dwells are true arcs, or lines on a plate, with either kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SegmentKind {
    /// Tangent arcs.
    #[default]
    Arcs,
    /// Cubic splines, one for each piece, without a jump of the curvature inside.
    Splines,
}

impl NamedChoice for SegmentKind {
    const ALL: &'static [(&'static str, Self)] = &[("arcs", Self::Arcs), ("spline", Self::Splines)];
}

/// The tolerances of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Largest distance, m.
    pub tolerance: f64,
    /// The side of the exact curve on which it lies.
    pub side: Side,
    /// Largest errors of the follower's motion.
    pub motion: MotionTolerance,
    /// The kind of its segments.
    pub laid: SegmentKind,
}

impl From<f64> for Fit {
    fn from(tolerance: f64) -> Self {
        Self { tolerance, side: Side::Both, motion: MotionTolerance::ANY, laid: SegmentKind::default() }
    }
}

impl Fit {
    /// The tolerance in the unit of drawings, mm.
    #[inline]
    #[must_use]
    pub fn tolerance_mm(&self) -> f64 {
        MILLIMETRES * self.tolerance
    }

    /// Without the tolerances of the motion; `None` where it has none.
    fn by_distance(&self) -> Option<Self> {
        (self.motion != MotionTolerance::ANY).then_some(Self { motion: MotionTolerance::ANY, ..*self })
    }

    /// As it is on a curve with the metal around it: what lies within the metal lies outside of the curve.
    fn on_side_of(self, curves: Curves<'_>) -> Self {
        let side = match self.side {
            Side::Inside if curves.metal_side() < 0.0 => Side::Outside,
            Side::Outside if curves.metal_side() < 0.0 => Side::Inside,
            side => side,
        };
        Self { side, ..self }
    }

    /// How far inwards the middle of the band lies, and half its width, m. A band on one side is as wide as the tolerance,
    /// one on both sides twice that.
    #[must_use]
    pub fn band(&self) -> (f64, f64) {
        match self.side {
            Side::Both => (0.0, self.tolerance),
            Side::Inside => (0.5 * self.tolerance, 0.5 * self.tolerance),
            Side::Outside => (-0.5 * self.tolerance, 0.5 * self.tolerance),
        }
    }
}

/// A closed outline with the measures of its accuracy.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// The chain, counter-clockwise.
    pub contour: Contour,
    /// Largest distance from the exact curve, mm.
    pub deviation: f64,
    /// Best possible number of arcs N*, or the number of spans of splines by theory; dwells not counted.
    pub best_possible: f64,
    /// Best possible numbers of arcs for the velocity and for the acceleration alone; 0 where they do not matter.
    pub best_for: [f64; 2],
    /// The path of the tool to the start of the chain, mm, when it was requested.
    pub lead_in: Option<Segment>,
}

/// Why there is no outline.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OutlineError {
    /// The profile folds over itself, and no envelope exists.
    #[error(transparent)]
    Undercut(#[from] NoEnvelope),
    /// A part of a turning cam is not smooth, or the tolerance cannot be kept there.
    #[error(
        "no arcs or splines fit the outline between {from_deg:.3} and {to_deg:.3} deg of the cam: {error}. Where the motion is too \
         steep, give it more cam angle or a larger cam.base_radius"
    )]
    Part {
        /// First cam angle, degrees.
        from_deg: f64,
        /// Last cam angle, degrees.
        to_deg: f64,
        /// The cause.
        error: FitError,
    },
    /// The curve is not smooth, or the tolerance cannot be kept.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// Of any other cause: the cam is too large to draw, a cutter does not get into a concave part.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

impl From<OutlineError> for Refusal {
    fn from(error: OutlineError) -> Self {
        match error {
            OutlineError::Refused(refusal) => refusal,
            other => Self::of(other),
        }
    }
}

impl OutlineError {
    /// With the range of cam angles that it concerns, if there is one.
    fn between(self, from: f64, to: f64, period: Option<f64>) -> Self {
        match self {
            Self::Fit(error) if period.is_some() => {
                Self::Part { from_deg: from.to_degrees(), to_deg: to.to_degrees(), error }
            }
            other => other,
        }
    }
}

impl Outline {
    /// An outline that has no segment yet.
    #[must_use]
    pub fn empty() -> Self {
        let contour = Contour { vertices: Vec::new() };
        Self { contour, deviation: 0.0, best_possible: 0.0, best_for: [0.0; 2], lead_in: None }
    }

    /// With the deviation measured from the exact curve, where the chain was fitted to a curve at the distance `shift` (m) from it.
    #[must_use]
    pub fn measured_from_exact(self, shift: f64) -> Self {
        let deviation = self.deviation + MILLIMETRES * shift.abs();
        Self { deviation, ..self }
    }
}

/// The profile as an outline. Where it is undercut, the loops are left out: what can be cut is drawn, with a sharp edge
/// where the loop was.
///
/// # Errors
/// [`OutlineError`] when the loops leave no outline, it is too large, or the tolerance cannot be kept.
pub fn profile(curves: Curves<'_>, fit: impl Into<Fit>) -> Result<Outline, OutlineError> {
    Ok(profile_within(curves, fit.into())?.0)
}

/// The profile as an outline, and how far inwards of the exact profile the middle of its band lies, m.
///
/// # Errors
/// As for [`profile`].
pub fn profile_within(curves: Curves<'_>, fit: Fit) -> Result<(Outline, f64), OutlineError> {
    let fit = fit.on_side_of(curves);
    // Half the radius is kept where a parallel has the smaller one, so that it stays as smooth as the profile.
    let room = match (fit.side, curves.metal_side() > 0.0) {
        (Side::Both, _) => f64::INFINITY,
        (Side::Inside, true) | (Side::Outside, false) => 0.5 * convex_radius(curves),
        (Side::Outside, true) | (Side::Inside, false) => 0.5 * concave_radius(curves),
    };
    parallel_outline(curves, curves.offset(), fit, room)
}

/// How often the tolerance of the path of a cutter is halved, at most, where its arcs turn too tightly.
const HALVINGS: u32 = 8;
/// Rounding of the radius of an arc, mm.
const ROUNDED: f64 = 1e-8;

/// The path of the centre of a cutter (radius in m) along the profile: parallel to the follower's curve at the difference of the
/// radii, and at the distance from it, on the same side, that the cut may have from the profile.
///
/// # Errors
/// [`OutlineError`] as for [`profile`]; also when the cutter does not get into a concave part.
pub fn cutter_path(curves: Curves<'_>, cutter_radius: f64, fit: impl Into<Fit>) -> Result<Outline, OutlineError> {
    check_cutter_fits(curves, cutter_radius)?;
    let fit: Fit = fit.into();
    let distance = curves.offset() - curves.metal_side() * cutter_radius;
    let least_radius = cutter_radius - 2.0 * fit.band().0.max(0.0);
    // A cutter along arcs and lines cuts arcs and lines, which the proof follows.
    let mut fit = Fit { laid: SegmentKind::Arcs, ..fit.on_side_of(curves) };
    let mut path = parallel_outline(curves, distance, fit, f64::INFINITY)?.0;
    for _ in 0..HALVINGS {
        if !turns_too_tightly(&path.contour, curves.metal_side(), MILLIMETRES * least_radius) {
            break;
        }
        fit.tolerance *= 0.5;
        path = parallel_outline(curves, distance, fit, f64::INFINITY)?.0;
    }
    Ok(path)
}

/// Whether the path of a cutter has an arc about the metal that is smaller than the cutter (mm): there the cut runs backwards. A wide
/// band has room for such arcs.
fn turns_too_tightly(path: &Contour, metal_side: f64, radius: f64) -> bool {
    let arcs = path.segments().into_iter().flatten().filter(|segment| metal_side * segment.bulge > 0.0);
    arcs.into_iter().any(|arc| arc.radius() < radius - ROUNDED)
}

/// Refuses a cutter (radius in m) that does not get into a concave part.
pub(super) fn check_cutter_fits(curves: Curves<'_>, cutter_radius: f64) -> Result<(), Refusal> {
    let corner = extremes::corners(curves).into_iter().find(|corner| corner.turn < 0.0);
    let concave = if let Some(corner) = corner.filter(|_| cutter_radius > curves.offset()) {
        corner.at
    } else {
        let concave = extremes::concave_profile_curvature(curves);
        if !(concave.value * cutter_radius >= 1.0) {
            return Ok(());
        }
        concave.at
    };
    Err(Refusal::new("the cutter cannot follow the profile, whose concave radius is smaller than that of the cutter")
        .at(format!("{:.3} deg", concave.to_degrees())))
}

/// Least convex radius of the profile, m; infinite where a sharp edge remains of it anyway.
fn convex_radius(curves: Curves<'_>) -> f64 {
    let radius = match curves.element() {
        Element::Roller { radius } => 1.0 / extremes::convex_curvature(curves).value.max(0.0) - radius.abs(),
        Element::Face => extremes::least_radius(curves).value,
    };
    if radius > 0.0 && extremes::corners(curves).iter().all(|corner| corner.turn < 0.0) {
        radius
    } else {
        f64::INFINITY
    }
}

/// Least concave radius of the profile, m.
fn concave_radius(curves: Curves<'_>) -> f64 {
    if extremes::corners(curves).iter().any(|corner| curves.metal_side() * corner.turn < 0.0) {
        return curves.offset().abs();
    }
    1.0 / extremes::concave_profile_curvature(curves).value.max(0.0)
}

/// A parallel of the follower's curve at a distance inwards (m) as an outline within a band, whose middle is no more than
/// `room` (m) away from it; with how far inwards the middle is.
fn parallel_outline(curves: Curves<'_>, distance: f64, fit: Fit, room: f64) -> Result<(Outline, f64), OutlineError> {
    let (shift, half) = fit.band();
    if shift == 0.0 {
        let within = Fit { tolerance: half, ..fit };
        return Ok((parallel(curves, distance, distance, &within, &undrawn_stretches(curves, distance)?)?, shift));
    }
    let shift = shift.clamp(-room, room);
    // From an edge of turn τ the edge of a parallel is 1/cos(τ/2) times as far as the adjacent curves.
    let sharp = undrawn_stretches(curves, distance + shift)?.iter().map(|gap| gap.edge).fold(0.0, f64::max);
    let closer = libm::cos(0.5 * sharp);
    let shift = shift * closer;
    let gaps = undrawn_stretches(curves, distance + shift)?;
    let within = Fit { tolerance: shift.abs(), ..fit };
    let outline = parallel(curves, distance + shift, distance, &within, &gaps)?;
    let outline = outline.measured_from_exact(shift);
    let deviation = outline.deviation.max(MILLIMETRES * shift.abs() / closer);
    Ok((Outline { deviation, ..outline }, shift))
}

/// A stretch of a parallel curve that is not drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct UndrawnStretch {
    pub(super) from: f64,
    pub(super) to: f64,
    /// Turn of the sharp edge that remains, rad.
    edge: f64,
    /// Turn of the arc about an edge of the profile, rad: outside an edge the parallel is that of a point.
    pub(super) arc: f64,
}

/// The gaps of a parallel of the follower's curve at a distance inwards, m.
pub(super) fn undrawn_stretches(curves: Curves<'_>, distance: f64) -> Result<Vec<UndrawnStretch>, NoEnvelope> {
    let parallel = Parallel { curves, distance };
    let (mut edges, mut sharp) = (Vec::new(), Vec::new());
    if distance < curves.offset() {
        edges = Parallel { curves, distance: curves.offset() }.loops()?;
    }
    if distance < 0.0 || distance >= curves.offset() {
        sharp = parallel.loops()?;
    }
    let mut gaps = Vec::with_capacity(edges.len() + sharp.len());
    for ParallelLoop { from, to } in edges {
        gaps.push(UndrawnStretch { from, to, edge: 0.0, arc: turn_over(parallel, from, to) });
    }
    for ParallelLoop { from, to } in sharp {
        gaps.push(UndrawnStretch { from, to, edge: turn_over(parallel, from, to).abs(), arc: 0.0 });
    }
    gaps.sort_by(|a, b| a.from.total_cmp(&b.from));
    Ok(gaps)
}

/// The follower's curve as an outline for viewing.
///
/// # Errors
/// As [`profile`], but a pitch curve cannot be undercut.
pub fn pitch(curves: Curves<'_>) -> Result<Outline, OutlineError> {
    pitch_within(curves, PITCH_TOLERANCE)
}

/// The follower's curve as an outline within a tolerance (m).
///
/// # Errors
/// As for [`pitch`].
pub fn pitch_within(curves: Curves<'_>, tolerance: f64) -> Result<Outline, OutlineError> {
    parallel(curves, 0.0, 0.0, &Fit::from(tolerance), &[])
}

/// The angle by which a parallel turns from before a loop to after it, rad.
fn turn_over(parallel: Parallel<'_>, from: f64, to: f64) -> f64 {
    let before = parallel.point_at(from, BreakSide::Before).tangent;
    let after = parallel.point_at(to, BreakSide::After).tangent;
    libm::atan2(before.perp(&after), before.dot(&after))
}

/// Refuses a curve too large for a drawing; `frame` gives its points in millimetres.
///
/// # Errors
/// [`Refusal`] with how far it would reach.
pub fn check_drawing_size(pieces: &[Piece], frame: impl Fn(usize, f64) -> CurvePoint) -> Result<(), Refusal> {
    let radii = pieces.iter().enumerate().flat_map(|(index, piece)| {
        let places =
            (0..LOOKS).map(|part| piece.start + (piece.end - piece.start) * f64::from(part) / f64::from(LOOKS));
        places.map(move |place| (index, place))
    });
    let radius_mm = radii.map(|(index, place)| frame(index, place).point.norm()).fold(0.0, f64::max);
    if radius_mm <= LARGEST_COORDINATE {
        return Ok(());
    }
    Err(Refusal::new(format!(
        "the cam would reach {radius_mm:.0} mm from its shaft, more than the largest coordinate of a drawing (1e6 mm)"
    ))
    .remedy("give a smaller cam.base_radius, or relax the limits that make an automatic one so large"))
}

/// The parallel of the follower's curve at a distance inwards (m), within the tolerances of a fit, without the gaps; the errors of the
/// motion are those on a parallel at another distance, which this one represents.
fn parallel(
    curves: Curves<'_>,
    distance: f64,
    stands_for: f64,
    fit: &Fit,
    gaps: &[UndrawnStretch],
) -> Result<Outline, OutlineError> {
    let period = curves.motion.period();
    let pieces = curves.motion.pieces();
    check_drawing_size(pieces, |piece, angle| laying::frame(curves, piece, angle, distance))?;
    let fit = &laying::within_reach(curves, fit);
    let corners = extremes::corners(curves);
    let spans: Vec<(f64, f64)> = gaps.iter().map(|gap| (gap.from, gap.to)).collect();
    // A closed chain that starts on a dwell has a repetition behind what it repeats.
    let first = period.and_then(|_| pieces.iter().position(|piece| piece.dwell)).unwrap_or(0);
    let (mut outline, mut strips) = (Outline::empty(), OutlineStrips::default());
    let in_turn = pieces.iter().enumerate().cycle().skip(first).take(pieces.len());
    for (index, piece) in in_turn {
        let ranges = parts(piece, &spans, period);
        for range in ranges.iter().copied() {
            if piece.dwell {
                // A circle about the shaft, also for an offset follower: one true arc. On a plate a straight line.
                let bulge = period.map_or(0.0, |_| libm::tan(0.25 * (range.1 - range.0)));
                let start = laying::frame(curves, index, range.0, distance).point;
                outline.contour.vertices.push(Vertex::new(start, bulge));
            } else {
                let stretch = ParallelStretch { curves, piece: index, range, distance, stands_for };
                let fitted = outline.add_repeatable_piece(&mut strips, stretch, fit);
                fitted.map_err(|error| error.between(range.0, range.1, period))?;
                if outline.contour.vertices.len() > MOST_EDGES as usize {
                    let by_distance = fit.by_distance().ok_or_else(too_many_edges)?;
                    return parallel(curves, distance, stands_for, &by_distance, gaps);
                }
            }
            // Readers drop shorter arcs.
            let mut long =
                gaps.iter().filter(|gap| MILLIMETRES * gap.arc.abs() * (curves.offset() - distance) > SHORTEST_ARC);
            if let Some(gap) = long.find(|gap| starts_at(gap, range.1, period)) {
                let start = laying::frame(curves, index, range.1, distance).point;
                outline.contour.vertices.push(Vertex::new(start, libm::tan(0.25 * gap.arc)));
            }
        }
        let whole = ranges.last().is_some_and(|range| range.1 == piece.end);
        let end = laying::frame(curves, index, piece.end, distance).point;
        // At a concave corner of the pitch curve the roller turns in place: an arc of its own radius.
        if let Some(corner) = corners.iter().find(|corner| corner.turn < 0.0 && corner.at == piece.end)
            && MILLIMETRES * corner.turn.abs() * distance > SHORTEST_ARC
            && whole
        {
            outline.contour.vertices.push(Vertex::new(end, libm::tan(0.25 * corner.turn)));
        }
        if whole && steps_forward(curves, index) {
            outline.contour.vertices.push(Vertex::new(end, 0.0));
        }
    }
    Ok(outline)
}

/// That an outline has more arcs than are of use.
fn too_many_edges() -> Refusal {
    Refusal::new(format!(
        "the outline needs more than {MOST_EDGES} arcs, more than a control should be given: the motion has too many waves or segments for these tolerances"
    ))
    .remedy("give a coarser --tolerance, or a motion with fewer waves")
}

/// Whether the contact under a flat face moves on along it at the end of a piece, because the velocity increases there abruptly: between the
/// two places the profile is straight.
fn steps_forward(curves: Curves<'_>, index: usize) -> bool {
    let pieces = curves.motion.pieces();
    let next = (index + 1) % pieces.len();
    let (Element::Face, Some(piece), Some(after)) = (curves.element(), pieces.get(index), pieces.get(next)) else {
        return false;
    };
    let here = curves.touch(index, piece.end).curve;
    let there = curves.touch(next, after.start).curve;
    MILLIMETRES * (there.point - here.point).dot(&here.tangent) > SHORTEST_ARC
}

/// Whether a gap starts at a parameter, by whole turns.
pub(super) fn starts_at(gap: &UndrawnStretch, parameter: f64, period: Option<f64>) -> bool {
    TURNS.iter().any(|turns| gap.from + turns * period.unwrap_or(0.0) == parameter)
}

/// The rest of a piece without the gaps, halved where it is longer than one arc or one fit may be.
#[must_use]
pub fn parts(piece: &Piece, gaps: &[(f64, f64)], period: Option<f64>) -> Vec<(f64, f64)> {
    let mut left = vec![(piece.start, piece.end)];
    for gap in gaps {
        for turns in TURNS {
            let turn = turns * period.unwrap_or(0.0);
            let (from, to) = (gap.0 + turn, gap.1 + turn);
            left = left
                .into_iter()
                .flat_map(|(start, end)| [(start, end.min(from)), (start.max(to), end)])
                .filter(|(start, end)| start < end)
                .collect();
        }
    }
    let longest = if piece.dwell { LONGEST_DWELL } else { LONGEST_PIECE };
    let parts = left.into_iter().flat_map(|(start, end)| {
        let middle = 0.5 * (start + end);
        if end - start > longest { vec![(start, middle), (middle, end)] } else { vec![(start, end)] }
    });
    parts.collect()
}

//! The outline of a cam: the profile, piece by piece, as one closed chain of tangent arcs in millimetres. A disc closes
//! on itself; a plate has two mirrored flanks and flat ends.

use super::arcs::{self, FitError};
use crate::cam::conoid::Conoid;
use crate::cam::envelope::{self, Loss, NoEnvelope};
use crate::cam::plate::Plate;
use crate::cam::{Curves, Frame, extremes};
use crate::contour::{Contour, Segment, Vertex};
use crate::follower::Follower;
use crate::law::{Law, Piece};
use nalgebra::Vector2;
use std::f64::consts::{PI, TAU};

/// Millimetres in a metre: geometry leaves SI here.
pub const MILLIMETRES: f64 = 1e3;

/// A piece that turns by more than a half circle is fitted in two, so that no arc ends where it starts.
const LONGEST_PIECE: f64 = PI * (1.0 + 1e-12);

/// A dwell is one arc up to here; beyond, its ends come so close that readers cannot tell its centre.
const LONGEST_DWELL: f64 = 1.9 * PI;

/// Largest coordinate a drawing may have, mm: readers take anything beyond for a mistake.
const LARGEST_COORDINATE: f64 = 1e6;

/// The pitch curve on a sheet is only looked at: a fifth of a thin pen, mm.
const PITCH_TOLERANCE: f64 = 0.05;

/// On which side of the exact curve an outline may lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Side {
    /// On either.
    #[default]
    Both,
    /// Within the metal of the exact cam: never metal in the way.
    Inside,
    /// Outside of it: never cut too deep.
    Outside,
}

/// How near an outline keeps to the exact curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Largest distance, m.
    pub tolerance: f64,
    /// On which side.
    pub side: Side,
}

impl From<f64> for Fit {
    fn from(tolerance: f64) -> Self {
        Self { tolerance, side: Side::Both }
    }
}

impl Fit {
    /// How far inwards the middle of the band lies, m, and half its width, mm. A band on one side is as wide as the
    /// tolerance, one on both sides twice that.
    fn band(&self) -> (f64, f64) {
        match self.side {
            Side::Both => (0.0, MILLIMETRES * self.tolerance),
            Side::Inside => (0.5 * self.tolerance, 0.5 * MILLIMETRES * self.tolerance),
            Side::Outside => (-0.5 * self.tolerance, 0.5 * MILLIMETRES * self.tolerance),
        }
    }
}

/// The deviation from the exact curve of an outline that was fitted to the middle of a band.
fn from_exact(outline: Outline, shift: f64) -> Outline {
    let deviation = outline.deviation + MILLIMETRES * shift.abs();
    Outline { deviation, ..outline }
}

/// A closed outline with its proof.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// The chain, counter-clockwise, starting on a dwell when there is one.
    pub contour: Contour,
    /// Largest distance from the exact curve, mm.
    pub deviation: f64,
    /// Best possible number of arcs N*, dwells not counted.
    pub best_possible: f64,
}

/// Why there is no outline.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum OutlineError {
    /// The profile folds over itself beyond repair.
    #[error(transparent)]
    Undercut(#[from] NoEnvelope),
    /// A cutter has no smooth path along the profile.
    #[error("the cutter cannot follow the profile at {cam_deg:.3} deg: an edge, or a concave part sharper than it")]
    CutterPath {
        /// Cam angle, degrees.
        cam_deg: f64,
    },
    /// The cam is too large to draw.
    #[error("the cam would reach {radius_mm:.0} mm from its shaft, more than a drawing holds (1e6 mm)")]
    TooLarge {
        /// Largest radius, mm.
        radius_mm: f64,
    },
    /// The flanks of a plate cross.
    #[error(
        "the plate would be {thinnest_mm:.3} mm high at x = {x_mm:.3} mm; translating.plate_height must exceed \
         {least_mm:.3} mm"
    )]
    Thin {
        /// Height where it is thinnest, mm.
        thinnest_mm: f64,
        /// Where, mm of overrun.
        x_mm: f64,
        /// Least height of the plate, mm.
        least_mm: f64,
    },
    /// A section of a conoid has a corner.
    #[error(
        "the sections of a conoid have a corner at {cam_deg:.3} deg: a crowned roller needs a smooth surface; use \
         transition.kind = \"run-up\" or \"blend\", and no buffer.lead"
    )]
    Corner {
        /// Cam angle, degrees.
        cam_deg: f64,
    },
    /// The tolerance cannot be kept.
    #[error("{0}: between 64 roundings of the coordinates and a millimetre it can")]
    Fit(#[from] FitError),
}

/// The profile of a disc as an outline. Where it is undercut the loops are left out: what can
/// be cut is drawn, with a sharp edge where the loop was.
///
/// # Errors
/// [`OutlineError`] when the loops leave no outline, it is too large, or the tolerance cannot be kept.
pub fn profile<L: Law, F: Follower>(curves: &Curves<L, F>, fit: impl Into<Fit>) -> Result<Outline, OutlineError> {
    let (shift, half) = fit.into().band();
    let distance = curves.follower.roller_radius() + shift;
    Ok(from_exact(parallel(curves, distance, half, &envelope::losses(curves)?)?, shift))
}

/// The path of the centre of a cutter (radius in m) along the profile, within `tolerance` (mm): parallel to the pitch
/// curve at the difference of the radii.
///
/// # Errors
/// [`OutlineError`] as for [`profile`]; also when the profile is undercut or the cutter does not get into a corner.
pub fn cutter_path<L: Law, F: Follower>(
    curves: &Curves<L, F>,
    cutter_radius: f64,
    tolerance: f64,
) -> Result<Outline, OutlineError> {
    if let Some(loss) = envelope::losses(curves)?.first() {
        return Err(OutlineError::CutterPath { cam_deg: loss.from.to_degrees() });
    }
    let distance = curves.follower.roller_radius() - cutter_radius;
    let concave = extremes::concave_profile_curvature(curves);
    if concave.value * cutter_radius >= 1.0 {
        return Err(OutlineError::CutterPath { cam_deg: concave.at.to_degrees() });
    }
    match extremes::corners(curves).first() {
        Some(corner) if distance <= 0.0 => Err(OutlineError::CutterPath { cam_deg: corner.angle.to_degrees() }),
        _ => parallel(curves, distance, tolerance, &[]),
    }
}

/// The path of the roller's centre as an outline, for the eye.
///
/// # Errors
/// As [`profile`], but a pitch curve cannot be undercut.
pub fn pitch<L: Law, F: Follower>(curves: &Curves<L, F>) -> Result<Outline, OutlineError> {
    parallel(curves, 0.0, PITCH_TOLERANCE, &[])
}

/// The cut of a conoid at z (m) as an outline, of a clockwise cam.
///
/// # Errors
/// [`OutlineError`] when the surface is undercut or has corners, or the tolerance cannot be kept.
pub fn section(conoid: &Conoid, z: f64, fit: impl Into<Fit>) -> Result<Outline, OutlineError> {
    let (shift, tolerance) = fit.into().band();
    let nowhere = Vector2::new(f64::NAN, f64::NAN);
    let broken =
        Frame { point: nowhere, tangent: nowhere, speed: f64::NAN, curvature: f64::NAN, curvature_slope: f64::NAN };
    let frame = |piece: usize, angle: f64| {
        conoid.cut(piece, angle, z).map_or(broken, |(frame, _)| frame.offset_inward(shift).scaled(MILLIMETRES))
    };
    let pieces = conoid.pieces();
    if let Some(corner) = extremes::corners(&conoid.plane(z)).first() {
        return Err(OutlineError::Corner { cam_deg: corner.angle.to_degrees() });
    }
    let radius_mm = pieces.iter().enumerate().map(|(i, p)| frame(i, p.start).point.norm()).fold(0.0, f64::max);
    if radius_mm > LARGEST_COORDINATE {
        return Err(OutlineError::TooLarge { radius_mm });
    }
    let first = pieces.iter().position(|piece| piece.dwell).unwrap_or(0);
    let mut outline = Outline { contour: Contour { vertices: Vec::new() }, deviation: 0.0, best_possible: 0.0 };
    for (index, piece) in pieces.iter().enumerate().cycle().skip(first).take(pieces.len()) {
        // A dwell that does not lean along the axis is a circle; one that does is nearly one.
        let round = piece.dwell && conoid.lift(index, piece.start, z)[0][1] == 0.0;
        for range in parts(&Piece { dwell: round, ..*piece }, &[], Some(TAU)) {
            if round {
                let bulge = libm::tan(0.25 * (range.1 - range.0));
                outline.contour.vertices.push(Vertex { point: frame(index, range.0).point, bulge });
                continue;
            }
            let chain = arcs::fit(|angle| frame(index, angle), range, tolerance)?;
            outline.contour.vertices.extend(chain.joints.iter().map(|j| Vertex { point: j.point, bulge: j.bulge }));
            outline.deviation = outline.deviation.max(chain.deviation);
            outline.best_possible += chain.best_possible;
        }
    }
    Ok(from_exact(outline, shift))
}

/// The path of the roller's centre as an outline within a tolerance (m).
///
/// # Errors
/// As [`profile`], but a pitch curve cannot be undercut.
pub fn pitch_within<L: Law, F: Follower>(curves: &Curves<L, F>, tolerance: f64) -> Result<Outline, OutlineError> {
    parallel(curves, 0.0, MILLIMETRES * tolerance, &[])
}

/// The pitch curve of a plate's lower flank, for the eye.
///
/// # Errors
/// As for [`pitch`].
pub fn pitch_of_plate(plate: &Plate) -> Result<Vec<Segment>, OutlineError> {
    let curves = &plate.curves;
    let mut vertices = parallel(curves, 0.0, PITCH_TOLERANCE, &[])?.contour.vertices;
    let last = curves.law.pieces().len().saturating_sub(1);
    let end = curves.contact(last, plate.stroke()).pitch.point * MILLIMETRES;
    vertices.push(Vertex { point: end, bulge: 0.0 });
    let pairs = vertices.iter().zip(vertices.iter().skip(1));
    Ok(pairs.map(|(a, b)| Segment { start: a.point, end: b.point, bulge: a.bulge }).collect())
}

/// The plate as an outline: lower flank, straight run-out, end, the upper flank as its mirror
/// image, other end.
///
/// # Errors
/// [`OutlineError`] as for [`profile`], and when the flanks cross.
pub fn plate(plate: &Plate, fit: impl Into<Fit>) -> Result<Outline, OutlineError> {
    let (shift, half) = fit.into().band();
    if !(plate.thinnest > 0.0) {
        return Err(OutlineError::Thin {
            thinnest_mm: MILLIMETRES * plate.thinnest,
            x_mm: MILLIMETRES * plate.thinnest_at,
            least_mm: MILLIMETRES * (plate.height - plate.thinnest),
        });
    }
    let curves = &plate.curves;
    let distance = curves.follower.roller_radius() + shift;
    let flank = from_exact(parallel(curves, distance, half, &envelope::losses(curves)?)?, shift);
    let mut lower = flank.contour.vertices;
    let last = curves.law.pieces().len().saturating_sub(1);
    let contact = curves.contact(last, plate.stroke()).pitch;
    let end = contact.offset_inward(distance).point * MILLIMETRES;
    let run_out = plate.run_out() * MILLIMETRES - contact.outward() * (MILLIMETRES * shift);
    lower.extend([end, run_out].map(|point| Vertex { point, bulge: 0.0 }));
    // Mirrored and run the other way a segment keeps its bulge, which then belongs to its other end.
    let bulges = lower.iter().map(|vertex| vertex.bulge);
    let bulges: Vec<f64> = std::iter::once(0.0).chain(bulges).collect();
    let mirror =
        |(vertex, bulge): (&Vertex, f64)| Vertex { point: Vector2::new(vertex.point.x, -vertex.point.y), bulge };
    let upper: Vec<Vertex> = lower.iter().zip(bulges).rev().map(mirror).collect();
    lower.extend(upper);
    Ok(Outline {
        contour: Contour { vertices: lower },
        deviation: flank.deviation,
        best_possible: 2.0 * flank.best_possible,
    })
}

fn parallel<L: Law, F: Follower>(
    curves: &Curves<L, F>,
    distance: f64,
    tolerance: f64,
    losses: &[Loss],
) -> Result<Outline, OutlineError> {
    let period = curves.law.period();
    let pieces = curves.law.pieces();
    let frame = |piece: usize, angle: f64| -> Frame {
        curves.contact(piece, angle).pitch.offset_inward(distance).scaled(MILLIMETRES)
    };
    let radius_mm = pieces.iter().enumerate().map(|(i, p)| frame(i, p.start).point.norm()).fold(0.0, f64::max);
    if !(radius_mm <= LARGEST_COORDINATE) {
        return Err(OutlineError::TooLarge { radius_mm });
    }
    let corners = extremes::corners(curves);
    // A closed outline starts on a dwell.
    let first = period.and_then(|_| pieces.iter().position(|piece| piece.dwell)).unwrap_or(0);
    let mut outline = Outline { contour: Contour { vertices: Vec::new() }, deviation: 0.0, best_possible: 0.0 };
    let in_turn = pieces.iter().enumerate().cycle().skip(first).take(pieces.len());
    for (index, piece) in in_turn {
        for range in parts(piece, losses, period) {
            if piece.dwell {
                // A circle about the shaft, also for an offset follower: one true arc. On a plate a straight line.
                let bulge = period.map_or(0.0, |_| libm::tan(0.25 * (range.1 - range.0)));
                outline.contour.vertices.push(Vertex { point: frame(index, range.0).point, bulge });
                continue;
            }
            let chain = arcs::fit(|angle| frame(index, angle), range, tolerance)?;
            let vertices = chain.joints.iter().map(|joint| Vertex { point: joint.point, bulge: joint.bulge });
            outline.contour.vertices.extend(vertices);
            outline.deviation = outline.deviation.max(chain.deviation);
            outline.best_possible += chain.best_possible;
        }
        // At a concave corner of the pitch curve the roller turns in place: an arc of its own radius.
        if let Some(corner) = corners.iter().find(|corner| corner.turn < 0.0 && corner.angle == piece.end)
            && distance > 0.0
        {
            let bulge = libm::tan(0.25 * corner.turn);
            outline.contour.vertices.push(Vertex { point: frame(index, piece.end).point, bulge });
        }
    }
    Ok(outline)
}

/// What is left of a piece without the losses, halved where it is longer than one arc or one fit may be.
fn parts(piece: &Piece, losses: &[Loss], period: Option<f64>) -> Vec<(f64, f64)> {
    let mut left = vec![(piece.start, piece.end)];
    for loss in losses {
        for turns in [-1.0, 0.0, 1.0] {
            let turn = turns * period.unwrap_or(0.0);
            let (from, to) = (loss.from + turn, loss.to + turn);
            left = left
                .into_iter()
                .flat_map(|(start, end)| [(start, end.min(from)), (start.max(to), end)])
                .filter(|(start, end)| start < end)
                .collect();
        }
    }
    let longest = if piece.dwell { LONGEST_DWELL } else { LONGEST_PIECE };
    left.into_iter()
        .flat_map(|(start, end)| {
            let middle = 0.5 * (start + end);
            if end - start > longest { vec![(start, middle), (middle, end)] } else { vec![(start, end)] }
        })
        .collect()
}

#[cfg(test)]
mod tests;

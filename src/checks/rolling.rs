//! The proof: a roller rolled all round on the outline as it stands in the file, against the law.
//!
//! For a cam angle the law and the follower's geometry say where the centre of the roller must be. Its distance from
//! the outline, less the roller radius, is the gap along the normal: positive where metal is missing, negative where
//! metal is in the way. Moved along its path until it touches, the roller shows the lift the cam really gives, and that
//! lift the force it really balances. Normals, offsets, curvatures and arc fitting, by which the outline was made, are
//! not used; the same distances are measured a second time by parry2d on chords.

use super::surface::{Chords, Surface};
use super::{Finding, Subject, cam_degrees, verdict};
use crate::cam::rotary::Rotary;
use crate::contour::Contour;
use crate::follower::Follower;
use crate::law::Law;
use crate::machine::Rotation;
use crate::numeric::extremum;
use nalgebra::Vector2;
use serde::Serialize;
use std::f64::consts::TAU;

/// Even angles beside those at which the roller touches the segments: half a degree shows the slowest fault.
const EVEN_ANGLES: u32 = 720;
/// Angles spread over the segments, at the least four on each.
const SEGMENT_ANGLES: usize = 320;
/// Distance to either side of a break of the law at which the roller is put as well, rad.
const BESIDE_BREAK: f64 = 1e-4;
/// Worst places that are looked at closer, and golden sections there: an angle step shrinks to a thousandth.
const CLOSER_LOOKS: usize = 6;
const CLOSER_SECTIONS: u32 = 14;
/// Every how many angles parry is asked as well.
const PARRY_EVERY: usize = 4;
/// Chords for parry lie within this share of the tolerance.
const CHORD_SHARE: f64 = 0.02;
/// Newton steps along the path, and the cosine below which the roller slides off rather than touches.
const TOUCH_STEPS: usize = 12;
const LEAST_COSINE: f64 = 0.05;
/// A roller touches when it is that near, mm.
const TOUCHING: f64 = 1e-10;
/// Rounding of a distance between points of a drawing, over its size.
const ROUNDING: f64 = 1e-14;

/// What rolling has shown.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rolled {
    /// Angles at which the roller was put.
    pub angles: usize,
    /// Segments it rolled on.
    pub segments: usize,
    /// Gap of largest size along the normal, mm, signed: positive where metal is missing.
    pub gap_mm: f64,
    /// Where it is, degrees of cam angle.
    pub gap_cam_deg: f64,
    /// Lift error of largest size, mm; `None` where the roller nowhere touches along its path.
    pub lift_error_max_mm: Option<f64>,
    /// 99 of 100 lift errors are smaller, mm.
    pub lift_error_q99_mm: Option<f64>,
    /// Angles at which the roller is within the tolerance of two separate places.
    pub double_contacts: usize,
    /// The first of them, degrees.
    pub double_contact_cam_deg: Option<f64>,
    /// Chords of the second measurement.
    pub chords: usize,
    /// Their largest distance from the arcs, mm.
    pub chord_sagitta_mm: f64,
    /// Largest difference between the two measurements, mm.
    pub chord_difference_mm: f64,
    /// Largest |inertia − air| over the reversal with the lift as rolled, N.
    pub residual_max_n: f64,
    /// Where it is, degrees of cam angle.
    pub residual_cam_deg: f64,
}

/// The roller at one angle.
#[derive(Debug, Clone, Copy)]
struct Sample {
    angle: f64,
    gap: f64,
    lift_error: Option<f64>,
    residual: f64,
}

struct Roll<'a> {
    rotary: &'a Rotary,
    surface: Surface,
    radius: f64,
}

impl Roll<'_> {
    /// Where the law wants the roller's centre, mm, and the direction of its path.
    fn centre(&self, angle: f64) -> (Vector2<f64>, Vector2<f64>) {
        let disc = &self.rotary.disc;
        let (piece, inside) = disc.law.locate(angle);
        let pitch = disc.follower.pitch(inside, &disc.law.jet(piece, inside));
        (pitch.point * 1e3, pitch.drive)
    }

    /// Distance from the outline less the roller radius, and the outward normal at the foot.
    fn clearance(&self, centre: Vector2<f64>) -> Option<(f64, Vector2<f64>)> {
        let nearest = self.surface.nearest(centre)?;
        Some((-nearest.left - self.radius, Vector2::new(nearest.tangent.y, -nearest.tangent.x)))
    }

    fn gap(&self, angle: f64) -> f64 {
        self.clearance(self.centre(angle).0).map_or(f64::INFINITY, |(gap, _)| gap)
    }

    /// How far along its path the roller stands from where the law wants it, mm.
    fn lift_error(&self, centre: Vector2<f64>, drive: Vector2<f64>) -> Option<f64> {
        let mut moved = 0.0;
        for _ in 0..TOUCH_STEPS {
            let (gap, normal) = self.clearance(centre + drive * moved)?;
            if gap.abs() <= TOUCHING {
                return Some(moved);
            }
            let cosine = drive.dot(&normal);
            if cosine < LEAST_COSINE {
                return None;
            }
            moved -= gap / cosine;
        }
        None
    }

    fn sample(&self, angle: f64) -> Sample {
        let (centre, drive) = self.centre(angle);
        let gap = self.clearance(centre).map_or(f64::INFINITY, |(gap, _)| gap);
        let lift_error = self.lift_error(centre, drive);
        Sample { angle, gap, lift_error, residual: self.residual(angle, lift_error.unwrap_or(gap)) }
    }

    /// |inertia − air| when the roller stands `lift_error` (mm) off the law, N; 0 outside the reversal.
    fn residual(&self, angle: f64, lift_error: f64) -> f64 {
        let law = &self.rotary.disc.law;
        let (piece, inside) = law.locate(angle);
        let state = law.state(piece, inside);
        if state.overrun == 0.0 {
            return 0.0;
        }
        let balance = self.rotary.balance();
        let bottom = state.displacement + 1e-3 * lift_error / law.law().lever;
        let air = balance.pressure_ratio(state.overrun, bottom) - 1.0;
        let residual = self.rotary.cylinder.unit_force() * (balance.loading * state.overrun - air).abs();
        // A bottom so far off that no air is left balances nothing.
        if residual.is_nan() { f64::INFINITY } else { residual }
    }

    /// Even angles, both sides of every break, and the angles at which the roller touches the segments.
    fn angles(&self) -> Vec<f64> {
        let even = (0..EVEN_ANGLES).map(|i| TAU * f64::from(i) / f64::from(EVEN_ANGLES));
        let breaks = self
            .rotary
            .disc
            .law
            .pieces()
            .iter()
            .flat_map(|p| [p.start - BESIDE_BREAK, p.start, p.start + BESIDE_BREAK]);
        let follower = &self.rotary.disc.follower;
        let count = (SEGMENT_ANGLES / self.surface.segments().len().max(1)).clamp(1, 8);
        let touching = self.surface.segments().iter().flat_map(|segment| {
            (0..count).map(|step| {
                #[expect(clippy::cast_precision_loss, reason = "at most eight")]
                let share = step as f64 / count as f64;
                let (point, tangent) = segment.at(share);
                let centre = point + Vector2::new(tangent.y, -tangent.x) * self.radius;
                follower.angle_of(centre * 1e-3)
            })
        });
        let mut angles: Vec<f64> = even.chain(breaks).chain(touching).map(|angle| angle.rem_euclid(TAU)).collect();
        angles.sort_by(f64::total_cmp);
        angles
    }

    /// The samples about the worst gaps, looked at closer.
    fn closer(&self, samples: &[Sample]) -> Vec<Sample> {
        let size = |index: usize| samples.get(index % samples.len()).map_or(0.0, |s| s.gap.abs());
        let n = samples.len();
        let mut peaks: Vec<usize> = (0..n).filter(|&i| size(i) >= size(i + n - 1) && size(i) >= size(i + 1)).collect();
        peaks.sort_by(|&a, &b| size(b).total_cmp(&size(a)));
        peaks.truncate(CLOSER_LOOKS);
        let angle = |index: usize| samples.get(index).map_or(0.0, |s| s.angle);
        let look = |&peak: &usize| {
            let low = if peak == 0 { angle(n - 1) - TAU } else { angle(peak - 1) };
            let high = if peak + 1 == n { angle(0) + TAU } else { angle(peak + 1) };
            let worst = extremum::largest_without_slope(|a| self.gap(a).abs(), (low, high), 2, CLOSER_SECTIONS);
            self.sample(worst.at)
        };
        peaks.iter().map(look).collect()
    }
}

/// Rolls the roller of a cam on an outline that lies as it was written, against the law; tolerance in mm.
#[must_use]
pub fn roll(rotary: &Rotary, contour: &Contour, tolerance: f64) -> Rolled {
    let contour = match rotary.machine.cam.rotation {
        Rotation::Clockwise => contour.clone(),
        Rotation::CounterClockwise => contour.mirrored_about_x(),
    };
    let roll = Roll { rotary, surface: Surface::new(&contour), radius: 1e3 * rotary.disc.follower.roller_radius() };
    let mut samples: Vec<Sample> = roll.angles().into_iter().map(|angle| roll.sample(angle)).collect();
    let mut errors: Vec<f64> = samples.iter().filter_map(|s| s.lift_error).map(f64::abs).collect();
    errors.sort_by(f64::total_cmp);
    let touches = errors.len() == samples.len();
    let q99 = errors.get((errors.len() * 99 / 100).min(errors.len().saturating_sub(1))).copied();
    let closer = roll.closer(&samples);
    samples.extend(closer);

    let chords = Chords::new(&contour, CHORD_SHARE * tolerance);
    let difference = samples.iter().step_by(PARRY_EVERY).map(|sample| {
        let exact = sample.gap + roll.radius;
        (chords.distance(roll.centre(sample.angle).0) - exact).abs()
    });
    let chord_difference_mm = difference.fold(0.0, f64::max);
    let doubles = |s: &&Sample| {
        s.gap.abs() <= tolerance && roll.surface.places_within(roll.centre(s.angle).0, roll.radius + tolerance) > 1
    };
    let doubles: Vec<&Sample> = samples.iter().filter(doubles).collect();
    let worst = samples.iter().max_by(|a, b| a.gap.abs().total_cmp(&b.gap.abs()));
    let residual = samples.iter().max_by(|a, b| a.residual.total_cmp(&b.residual));
    let lift_error = samples.iter().filter_map(|s| s.lift_error).map(f64::abs).fold(0.0, f64::max);
    Rolled {
        angles: samples.len(),
        segments: roll.surface.segments().len(),
        gap_mm: worst.map_or(f64::INFINITY, |s| s.gap),
        gap_cam_deg: worst.map_or(0.0, |s| cam_degrees(s.angle)),
        lift_error_max_mm: touches.then_some(lift_error),
        lift_error_q99_mm: if touches { q99 } else { None },
        double_contacts: doubles.len(),
        double_contact_cam_deg: doubles.first().map(|s| cam_degrees(s.angle)),
        chords: chords.count,
        chord_sagitta_mm: chords.sagitta,
        chord_difference_mm,
        residual_max_n: residual.map_or(0.0, |s| s.residual),
        residual_cam_deg: residual.map_or(0.0, |s| cam_degrees(s.angle)),
    }
}

/// The verdict on what rolling has shown.
pub(super) fn check(subject: &Subject<'_>) -> Option<Finding> {
    let rolled = subject.rolled?;
    let size = subject.outline.map_or(1.0, |outline| outline.extents().size().max());
    let agree = rolled.chord_difference_mm <= rolled.chord_sagitta_mm + ROUNDING * size;
    let kept = rolled.gap_mm.abs() <= subject.tolerance_mm;
    let fault = if rolled.gap_mm > 0.0 { "metal is missing" } else { "metal is in the way" };
    let lift = match (rolled.lift_error_max_mm, rolled.lift_error_q99_mm) {
        (Some(most), Some(q99)) => {
            format!("lift off by {:.4} µm at most, {:.4} µm in 99 of 100", 1e3 * most, 1e3 * q99)
        }
        _ => "somewhere the roller does not touch along its path".into(),
    };
    let compared = format!(
        "law against {} segments as read from the file, roller at {} angles; {lift}; parry2d on {} chords {}",
        rolled.segments,
        rolled.angles,
        rolled.chords,
        if agree { "agrees" } else { "DISAGREES" },
    );
    let double =
        rolled.double_contact_cam_deg.map_or(String::new(), |at| format!("; two contacts at once at {at:.3}°"));
    let note = if kept { format!("{compared}{double}") } else { format!("{fault}; {compared}{double}") };
    Some(Finding {
        check: "rolling",
        value: rolled.gap_mm.abs(),
        limit: Some(subject.tolerance_mm),
        unit: "mm",
        cam_deg: Some(rolled.gap_cam_deg),
        verdict: verdict(kept && agree),
        note: Some(note),
    })
}

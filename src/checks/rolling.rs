//! The proof: a roller rolled all round on the outline as it stands in the file, against the law.
//!
//! For a cam angle, or an overrun of the bed, the law and the follower's geometry say where the centre of the roller must be. Its distance from
//! the outline, less the roller radius, is the gap along the normal: positive where metal is missing, negative where
//! metal is in the way. Moved along its path until it touches, the roller shows the lift the cam really gives, and that
//! lift the force it really balances. Normals, offsets, curvatures and arc fitting, by which the outline was made, are
//! not used; the same distances are measured a second time by parry2d on chords.

use super::surface::{Chords, Surface};
use super::{Finding, Subject, verdict};
use crate::cam::{AnyCurves, Cam, Place};
use crate::contour::Contour;
use crate::numeric::extremum;
use nalgebra::Vector2;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// Even places beside those at which the roller touches the segments: half a degree of a turn shows the slowest fault.
const EVEN_PLACES: u32 = 720;
/// Places spread over the segments, at the least one on each.
const SEGMENT_PLACES: usize = 320;
/// Distance to either side of a break of the law at which the roller is put as well, as a share of the cam.
const BESIDE_BREAK: f64 = 1.6e-5;
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
    /// Places at which the roller was put.
    pub places: usize,
    /// Segments it rolled on.
    pub segments: usize,
    /// Gap of largest size along the normal, mm, signed: positive where metal is missing.
    pub gap_mm: f64,
    /// Where it is.
    #[serde(flatten, serialize_with = "gap_place")]
    pub gap_at: Place,
    /// Lift error of largest size, mm; `None` where the roller nowhere touches along its path.
    pub lift_error_max_mm: Option<f64>,
    /// 99 of 100 lift errors are smaller, mm.
    pub lift_error_q99_mm: Option<f64>,
    /// Places at which the roller is within the tolerance of two separate places of the outline.
    pub double_contacts: usize,
    /// The first of them.
    #[serde(flatten, serialize_with = "double_contact_place")]
    pub double_contact_at: Option<Place>,
    /// Chords of the second measurement.
    pub chords: usize,
    /// Their largest distance from the arcs, mm.
    pub chord_sagitta_mm: f64,
    /// Largest difference between the two measurements, mm.
    pub chord_difference_mm: f64,
    /// Largest |inertia − air and cam| over the reversal with the lift as rolled, N.
    pub residual_max_n: f64,
    /// Where it is.
    #[serde(flatten, serialize_with = "residual_place")]
    pub residual_at: Place,
}

/// A place under names of its own: `gap_cam_deg` of a disc, `gap_x_mm` of a plate.
fn named<S: Serializer>(place: Place, [angle, overrun]: [&str; 2], serializer: S) -> Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(None)?;
    match place.x_mm {
        Some(x) => map.serialize_entry(overrun, &x)?,
        None => map.serialize_entry(angle, &place.cam_deg)?,
    }
    map.end()
}

fn gap_place<S: Serializer>(place: &Place, serializer: S) -> Result<S::Ok, S::Error> {
    named(*place, ["gap_cam_deg", "gap_x_mm"], serializer)
}

#[expect(clippy::ref_option, reason = "the signature serde asks for")]
fn double_contact_place<S: Serializer>(place: &Option<Place>, serializer: S) -> Result<S::Ok, S::Error> {
    named(place.unwrap_or_default(), ["double_contact_cam_deg", "double_contact_x_mm"], serializer)
}

fn residual_place<S: Serializer>(place: &Place, serializer: S) -> Result<S::Ok, S::Error> {
    named(*place, ["residual_cam_deg", "residual_x_mm"], serializer)
}

/// The roller at one place.
#[derive(Debug, Clone, Copy)]
struct Sample {
    parameter: f64,
    gap: f64,
    lift_error: Option<f64>,
    residual: f64,
    /// How far parry's distance is from the exact one, where it was asked.
    difference: f64,
    double: bool,
}

/// The roller on one flank.
struct Roll<'a> {
    cam: &'a dyn Cam,
    curves: AnyCurves<'a>,
    surface: Surface,
    radius: f64,
}

impl Roll<'_> {
    /// Where the law wants the roller's centre, mm, and the direction of its path.
    fn centre(&self, parameter: f64) -> (Vector2<f64>, Vector2<f64>) {
        let (piece, inside) = self.curves.law.locate(parameter);
        let pitch = self.curves.follower.pitch(inside, &self.curves.law.jet(piece, inside));
        (pitch.point * 1e3, pitch.drive)
    }

    /// Distance from the outline less the roller radius, and the outward normal at the foot.
    fn clearance(&self, centre: Vector2<f64>) -> Option<(f64, Vector2<f64>)> {
        let nearest = self.surface.nearest(centre)?;
        Some((-nearest.left - self.radius, Vector2::new(nearest.tangent.y, -nearest.tangent.x)))
    }

    fn gap(&self, parameter: f64) -> f64 {
        self.clearance(self.centre(parameter).0).map_or(f64::INFINITY, |(gap, _)| gap)
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

    fn sample(&self, parameter: f64) -> Sample {
        let (centre, drive) = self.centre(parameter);
        let (gap, normal) = self.clearance(centre).unwrap_or((f64::INFINITY, drive));
        let lift_error = self.lift_error(centre, drive);
        let (piece, inside) = self.curves.law.locate(parameter);
        let residual = self.cam.unbalanced(piece, inside, 1e-3 * lift_error.unwrap_or(gap), normal);
        // A bottom so far off that no air is left balances nothing.
        let residual = if residual.is_nan() { f64::INFINITY } else { residual };
        Sample { parameter, gap, lift_error, residual, difference: 0.0, double: false }
    }

    /// Even places, both sides of every break, and those at which the roller touches the segments.
    fn places(&self) -> Vec<f64> {
        let (first, last) = self.curves.law.range();
        let period = self.curves.law.period();
        let even = (0..=EVEN_PLACES).map(|i| first + (last - first) * f64::from(i) / f64::from(EVEN_PLACES));
        let beside = BESIDE_BREAK * (last - first);
        let breaks = self.curves.law.pieces().iter().flat_map(|p| [p.start - beside, p.start, p.start + beside]);
        let count = (SEGMENT_PLACES / self.surface.segments().len().max(1)).clamp(1, 8);
        let touching = self.surface.segments().iter().flat_map(|segment| {
            (0..count).map(|step| {
                #[expect(clippy::cast_precision_loss, reason = "at most eight")]
                let share = step as f64 / count as f64;
                let (point, tangent) = segment.at(share);
                let centre = point + Vector2::new(tangent.y, -tangent.x) * self.radius;
                self.curves.follower.parameter_of(centre * 1e-3)
            })
        });
        let inside = |parameter: f64| match period {
            Some(period) => first + (parameter - first).rem_euclid(period),
            None => parameter,
        };
        let all = even.chain(breaks).chain(touching).map(inside);
        let mut places: Vec<f64> = all.filter(|p| (first..=last).contains(p)).collect();
        places.sort_by(f64::total_cmp);
        places
    }

    /// The samples about the worst gaps, looked at closer.
    fn closer(&self, samples: &[Sample]) -> Vec<Sample> {
        let n = samples.len();
        let (first, last) = self.curves.law.range();
        let turn = self.curves.law.period();
        let size = |index: usize| samples.get(index % n).map_or(0.0, |s| s.gap.abs());
        let mut peaks: Vec<usize> = (0..n).filter(|&i| size(i) >= size(i + n - 1) && size(i) >= size(i + 1)).collect();
        peaks.sort_by(|&a, &b| size(b).total_cmp(&size(a)));
        peaks.truncate(CLOSER_LOOKS);
        let at = |index: usize| samples.get(index).map_or(first, |s| s.parameter);
        let look = |&peak: &usize| {
            let low = if peak > 0 { at(peak - 1) } else { turn.map_or(first, |turn| at(n - 1) - turn) };
            let high = if peak + 1 < n { at(peak + 1) } else { turn.map_or(last, |turn| at(0) + turn) };
            let worst = extremum::largest_without_slope(|p| self.gap(p).abs(), (low, high), 2, CLOSER_SECTIONS);
            self.sample(worst.at)
        };
        peaks.iter().map(look).collect()
    }

    /// Every sample of this flank, the even ones first and the closer looks behind.
    fn samples(&self, chords: &Chords, tolerance: f64) -> (Vec<Sample>, usize) {
        let mut samples: Vec<Sample> = self.places().into_iter().map(|place| self.sample(place)).collect();
        let even = samples.len();
        samples.extend(self.closer(&samples));
        for (index, sample) in samples.iter_mut().enumerate() {
            let centre = self.centre(sample.parameter).0;
            if index % PARRY_EVERY == 0 {
                sample.difference = (chords.distance(centre) - (sample.gap + self.radius)).abs();
            }
            sample.double =
                sample.gap.abs() <= tolerance && self.surface.places_within(centre, self.radius + tolerance) > 1;
        }
        (samples, even)
    }
}

/// Rolls the roller of a cam on an outline that lies as it was written, against the law; tolerance in mm.
#[must_use]
pub fn roll(cam: &dyn Cam, contour: &Contour, tolerance: f64) -> Rolled {
    let (mut samples, mut errors) = (Vec::new(), Vec::new());
    let (mut chord_count, mut sagitta) = (0, 0.0_f64);
    let mut touches = true;
    for mirrored in cam.mirrored() {
        let contour = if *mirrored { contour.mirrored_about_x() } else { contour.clone() };
        let curves = cam.curves();
        let radius = 1e3 * curves.follower.roller_radius();
        let roll = Roll { cam, curves, surface: Surface::new(&contour), radius };
        let chords = Chords::new(&contour, CHORD_SHARE * tolerance);
        let (found, even) = roll.samples(&chords, tolerance);
        let lifts: Vec<f64> = found.iter().take(even).filter_map(|s| s.lift_error).map(f64::abs).collect();
        touches &= lifts.len() == even;
        errors.extend(lifts);
        samples.extend(found);
        (chord_count, sagitta) = (chord_count + chords.count, sagitta.max(chords.sagitta));
    }
    errors.sort_by(f64::total_cmp);
    let q99 = errors.get((errors.len() * 99 / 100).min(errors.len().saturating_sub(1))).copied();
    let doubles: Vec<&Sample> = samples.iter().filter(|s| s.double).collect();
    let worst = samples.iter().max_by(|a, b| a.gap.abs().total_cmp(&b.gap.abs()));
    let residual = samples.iter().max_by(|a, b| a.residual.total_cmp(&b.residual));
    let lift_error = samples.iter().filter_map(|s| s.lift_error).map(f64::abs).fold(0.0, f64::max);
    Rolled {
        places: samples.len(),
        segments: contour.vertices.len(),
        gap_mm: worst.map_or(f64::INFINITY, |s| s.gap),
        gap_at: worst.map_or_else(Place::default, |s| cam.place(s.parameter)),
        lift_error_max_mm: touches.then_some(lift_error),
        lift_error_q99_mm: if touches { q99 } else { None },
        double_contacts: doubles.len(),
        double_contact_at: doubles.first().map(|s| cam.place(s.parameter)),
        chords: chord_count,
        chord_sagitta_mm: sagitta,
        chord_difference_mm: samples.iter().map(|s| s.difference).fold(0.0, f64::max),
        residual_max_n: residual.map_or(0.0, |s| s.residual),
        residual_at: residual.map_or_else(Place::default, |s| cam.place(s.parameter)),
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
        "law against {} segments as read from the file, roller at {} places; {lift}; parry2d on {} chords {}",
        rolled.segments,
        rolled.places,
        rolled.chords,
        if agree { "agrees" } else { "DISAGREES" },
    );
    let double = rolled.double_contact_at.map_or(String::new(), |at| format!("; two contacts at once at {at}"));
    let note = if kept { format!("{compared}{double}") } else { format!("{fault}; {compared}{double}") };
    Some(Finding {
        check: "rolling",
        value: rolled.gap_mm.abs(),
        limit: Some(subject.tolerance_mm),
        unit: "mm",
        place: rolled.gap_at,
        verdict: verdict(kept && agree),
        note: Some(note),
    })
}

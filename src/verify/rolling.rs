//! The proof: a roller rolled all round on the outline as it is in the file, against the motion.
//!
//! For a cam angle, or an overrun of the bed, the motion and the follower's geometry give the place of the roller's centre. Its
//! distance from the outline, less the roller radius, is the gap along the normal: positive where metal is missing, negative where
//! metal is in the way. Moved along its path until it touches, the roller shows the lift the cam really gives, and that
//! lift the residual force it really leaves. Normals, offsets, curvatures and arc fitting, by which the outline was made, are
//! not used; the same distances are measured a second time by parry2d on chords.

use super::{Check, Evidence, On, sphere};
use crate::body::Body;
use crate::follower::{Element, Touch};
use crate::geometry::contour::Contour;
use crate::geometry::track::{Chords, Track};
use crate::numeric::extremum;
use crate::profile::Curves;
use crate::report::{Finding, Place, Rolled, Verdict};
use nalgebra::Vector2;

pub(super) const CHECK: Check = Check {
    name: "rolling",
    on: On::Outline,
    about: "The largest gap between the follower, placed as the motion requires, and the outline as it is in the file: positive \
            where metal is missing, negative where metal is in the way.",
    run: check,
};

/// Even places beside those at which the roller touches the segments: half a degree of a turn shows the widest fault.
const EVEN_PLACES: u32 = 720;
/// Places spread over the segments, at the least one on each.
const SEGMENT_PLACES: usize = 320;
/// Distance to either side of a break of the law at which the roller is put as well, as a share of the cam.
const BESIDE_BREAK: f64 = 1.6e-5;
/// Worst places that are looked at closer, and golden sections there: an angle step shrinks to a thousandth.
const CLOSER_LOOKS: usize = 6;
const CLOSER_SECTIONS: u32 = 14;
/// parry measures as well at one angle of so many.
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

/// The roller at one place.
#[derive(Debug, Clone, Copy)]
struct Sample {
    parameter: f64,
    gap: f64,
    lift_error: Option<f64>,
    residual: f64,
    /// How far parry's distance is from the exact one, where it was measured.
    difference: f64,
    double: bool,
}

/// The follower on one flank.
struct Roll<'a> {
    body: &'a dyn Body,
    curves: Curves<'a>,
    track: Track,
    /// How far the element reaches from the follower's curve, mm.
    radius: f64,
}

impl Roll<'_> {
    /// The place of the follower by the motion.
    fn contact(&self, parameter: f64) -> Touch {
        let (piece, inside) = self.curves.motion.locate(parameter);
        self.curves.touch(piece, inside)
    }

    /// Gap between the outline and the element with the point of its curve at a place (mm), and the outward normal where they
    /// are nearest.
    fn clearance(&self, contact: &Touch, centre: Vector2<f64>) -> Option<(f64, Vector2<f64>)> {
        match self.curves.element() {
            Element::Roller { .. } => {
                let nearest = self.track.nearest(centre)?;
                Some((-nearest.left - self.radius, Vector2::new(nearest.tangent.y, -nearest.tangent.x)))
            }
            // A face touches with the point of the outline that lies farthest along its normal.
            Element::Face => {
                let normal = contact.curve.outward();
                Some((centre.dot(&normal) - self.track.farthest(normal)?, normal))
            }
        }
    }

    fn gap(&self, parameter: f64) -> f64 {
        let contact = self.contact(parameter);
        self.clearance(&contact, contact.curve.point * 1e3).map_or(f64::INFINITY, |(gap, _)| gap)
    }

    /// How far along its path the roller stands from its place by the motion, mm.
    fn lift_error(&self, contact: &Touch) -> Option<f64> {
        let (centre, drive) = (contact.curve.point * 1e3, contact.drive);
        let mut moved = 0.0;
        for _ in 0..TOUCH_STEPS {
            let (gap, normal) = self.clearance(contact, centre + drive * moved)?;
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
        let (piece, inside) = self.curves.motion.locate(parameter);
        let contact = self.curves.touch(piece, inside);
        let clearance = self.clearance(&contact, contact.curve.point * 1e3);
        let (gap, normal) = clearance.unwrap_or((f64::INFINITY, contact.drive));
        let lift_error = self.lift_error(&contact);
        let residual = self.body.unbalanced(piece, inside, 1e-3 * lift_error.unwrap_or(gap), normal);
        // A bottom so far off that no air is left gives no force.
        let residual = if residual.is_nan() { f64::INFINITY } else { residual };
        Sample { parameter, gap, lift_error, residual, difference: 0.0, double: false }
    }

    /// Even places, both sides of every break, and those at which the roller touches the segments.
    fn places(&self) -> Vec<f64> {
        let (first, last) = self.curves.motion.range();
        let period = self.curves.motion.period();
        let even = (0..=EVEN_PLACES).map(|i| first + (last - first) * f64::from(i) / f64::from(EVEN_PLACES));
        let beside = BESIDE_BREAK * (last - first);
        let breaks = self.curves.motion.pieces().iter().flat_map(|p| [p.start - beside, p.start, p.start + beside]);
        let count = (SEGMENT_PLACES / self.track.segments().len().max(1)).clamp(1, 8);
        let touching = self.track.segments().iter().flat_map(|segment| {
            (0..count).map(|step| {
                #[expect(clippy::cast_precision_loss, reason = "at most eight")]
                let share = step as f64 / count as f64;
                let (point, tangent) = segment.at(share);
                let outward = Vector2::new(tangent.y, -tangent.x);
                self.curves.follower.parameter_of((point + outward * self.radius) * 1e-3, outward)
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
        let (first, last) = self.curves.motion.range();
        let turn = self.curves.motion.period();
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

    /// Every sample of this flank, the even ones first and the closer looks after them.
    fn samples(&self, chords: &Chords, tolerance: f64) -> (Vec<Sample>, usize) {
        let mut samples: Vec<Sample> = self.places().into_iter().map(|place| self.sample(place)).collect();
        let even = samples.len();
        samples.extend(self.closer(&samples));
        for (index, sample) in samples.iter_mut().enumerate() {
            let contact = self.contact(sample.parameter);
            let centre = contact.curve.point * 1e3;
            let rolls = matches!(self.curves.element(), Element::Roller { .. });
            if index % PARRY_EVERY == 0 {
                let normal = contact.curve.outward();
                let by_chords =
                    if rolls { chords.distance(centre) } else { centre.dot(&normal) - chords.farthest(normal) };
                sample.difference = (by_chords - (sample.gap + self.radius)).abs();
            }
            sample.double =
                rolls && sample.gap.abs() <= tolerance && self.track.places_within(centre, self.radius + tolerance) > 1;
        }
        (samples, even)
    }
}

/// Rolls the follower of a plane cam on an outline that lies as it was written, against the law; tolerance in mm.
#[must_use]
pub fn roll(body: &dyn Body, curves: Curves<'_>, contour: &Contour, tolerance: f64) -> Rolled {
    let (mut samples, mut errors) = (Vec::new(), Vec::new());
    let (mut chord_count, mut sagitta) = (0, 0.0_f64);
    let mut touches = true;
    for mirrored in body.mirrored() {
        let contour = if *mirrored { contour.mirrored_about_x() } else { contour.clone() };
        let roll = Roll { body, curves, track: Track::new(&contour), radius: 1e3 * curves.offset() };
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
        gap_at: worst.map_or_else(Place::default, |s| body.place(s.parameter)),
        lift_error_max_mm: touches.then_some(lift_error),
        lift_error_q99_mm: if touches { q99 } else { None },
        double_contacts: doubles.len(),
        double_contact_at: doubles.first().map(|s| body.place(s.parameter)),
        chords: chord_count,
        chord_sagitta_mm: sagitta,
        chord_difference_mm: samples.iter().map(|s| s.difference).fold(0.0, f64::max),
        residual_max_n: residual.map_or(0.0, |s| s.residual),
        residual_at: residual.map_or_else(Place::default, |s| body.place(s.parameter)),
    }
}

/// The verdict on what rolling has shown.
fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    if let Some(conoid) = evidence.body.spatial() {
        return sphere::on_sections(evidence, conoid, &CHECK);
    }
    let rolled = evidence.rolled?;
    let size = evidence.outlines.first().map_or(1.0, |outline| outline.contour.extents().size().max());
    let agree = rolled.chord_difference_mm <= rolled.chord_sagitta_mm + ROUNDING * size;
    let kept = rolled.gap_mm.abs() <= evidence.tolerance_mm;
    let found = CHECK.found(rolled.gap_mm.abs(), Some(evidence.tolerance_mm), "mm", Verdict::of(kept && agree));
    Some(Finding { place: rolled.gap_at, note: Some(words(rolled, kept, agree)), ..found })
}

fn words(rolled: &Rolled, kept: bool, agree: bool) -> String {
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
    if kept { format!("{compared}{double}") } else { format!("{fault}; {compared}{double}") }
}

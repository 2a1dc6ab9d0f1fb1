//! The figures of a cam that limits are set for, for every kind of body.

use super::{Body, groove_width};
use crate::check::contact_stress::{self, ContactKind};
use crate::check::continuity::RunMotion;
use crate::check::{
    Measures, Subject, continuity, curvature, cutter_radius, face_width, force_closure, noise, outlier, overshoot,
    pivot_clearance, pressure_angle, size, wall,
};
use crate::report::Place;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::{Curves, Worst, envelope};
use camgen_kernel::text::{KeyChange, Length, Remedy, Text, text};

/// Places that are named of those where motion is lost.
const MOST_LOSSES: usize = 8;

/// The figures of a cam that limits are set for, each found on demand. A body takes its measures of them
/// ([`Figures::measured`]), and its size is searched by them.
pub trait Figures: Body {
    /// The largest pressure angle, and the largest of the other sign as a positive number, where a follower runs, rad. A body that does
    /// not distinguish them has the largest of both first.
    fn pressure_angles(&self) -> [Worst; 2];

    /// Largest |pressure angle| where a follower runs, rad.
    fn pressure_angle(&self) -> Worst {
        let [rising, falling] = self.pressure_angles();
        rising.or_larger(falling)
    }

    /// Smallest convex radius of what the follower draws, m: 0 at a corner, infinite where nothing is convex; negative where a
    /// profile under a face turns back on itself.
    fn least_radius(&self) -> Worst;

    /// Smallest convex radius of that curve where a follower runs, m.
    fn least_rolled_radius(&self) -> Worst {
        self.least_radius()
    }

    /// Radius of the largest cutter that fits into the concave parts, m; `None` where nothing is concave.
    fn min_concave_radius(&self) -> Option<Worst>;

    /// Radius of the roller, m; `None` under a flat face or a knife edge.
    fn roller_radius(&self) -> Option<f64>;

    /// Least metal between the profile and what bounds it inside, m, if anything does; with its place where that is known.
    fn wall(&self) -> Option<(f64, Option<Worst>)>;

    /// Largest Hertzian pressure of roller on cam, Pa; `None` without contact length, material or forces.
    fn contact_stress(&self) -> Option<Worst>;

    /// Whether that pressure exceeds a limit, Pa; not where it is not known.
    fn exceeds_stress(&self, limit: f64) -> bool {
        self.contact_stress().is_some_and(|stress| !(stress.value <= limit))
    }

    /// How roller and cam touch.
    fn touching(&self) -> ContactKind {
        ContactKind::Line
    }

    /// Changes, each of which alone keeps that pressure below a limit (Pa) that it exceeds by `largest`.
    fn stress_remedies(&self, largest: f64, limit: f64) -> Vec<Remedy>;

    /// Largest force that lifts the follower from the cam along its path, N; negative where it is pressed on everywhere.
    fn largest_lifting_force(&self) -> Worst;

    /// Whether the cam holds the follower from both sides, so that no force has to.
    fn is_form_closed(&self) -> bool {
        false
    }

    /// Least force that presses the follower onto the cam along its path, N; `None` when the machine file gives
    /// neither mass nor preload of the follower.
    fn least_closing_force(&self) -> Option<Worst> {
        let follower = &self.machine().follower;
        let least = (follower.mass.is_some() || follower.preload.is_some()).then(|| self.largest_lifting_force());
        least.map(|least| Worst { value: -least.value, ..least })
    }

    /// A preload, as a key of the machine file, that keeps the follower on the cam at so many times the speed of the cam.
    fn preload_that_holds(&self, _speed: f64) -> Option<KeyChange> {
        None
    }

    /// The motions that a follower runs on.
    fn run_motions(&self) -> Vec<RunMotion<'_>> {
        let speed = self.shaft_speed();
        super::curves_of(self).map(|curves| RunMotion { motion: curves.motion, z: 0.0, speed }).into_iter().collect()
    }

    /// A change with which the motion keeps `limits.continuity`, tried before it is named.
    fn smoother(&self) -> Option<Text> {
        None
    }

    /// A change of the size that keeps every limit on it, tested before it is reported; or why no such change exists.
    fn remedy(&self) -> Option<Text> {
        None
    }

    /// Largest width of a blank whose edge is not a flank, mm; 0 without one.
    fn blank_width(&self) -> f64 {
        0.0
    }

    /// The measures of all of these.
    fn measured(&self, of: &mut Measures<'_>, subject: &Subject<'_>) {
        let lost = || super::curves_of(self).map_or_else(Vec::new, |curves| lost_motion(curves, &|at| self.place(at)));
        let roller = || self.roller_radius();
        of.add(&continuity::CHECK, |_| continuity::measure(&self.run_motions(), || self.smoother(), subject));
        of.add(&outlier::CHECK, |_| outlier::measure(subject));
        of.add(&overshoot::CHECK, |written| overshoot::measure(written.tolerance_mm, subject));
        of.add(&noise::CHECK, |_| noise::measure(subject));
        of.add(&face_width::CHECK, |_| face_width::measure(subject));
        of.add(&pressure_angle::CHECK, |_| pressure_angle::measure(self.pressure_angles(), subject));
        of.add(&curvature::UNDERCUT, |_| {
            curvature::undercut(&self.least_radius(), roller().unwrap_or(0.0), lost, subject)
        });
        of.add(&curvature::MIN_CONVEX_RADIUS, |_| {
            curvature::min_convex_radius(&self.least_rolled_radius(), roller(), subject)
        });
        of.add(&cutter_radius::CHECK, |_| {
            let half_width = groove_width(&self.cuts()).map(|width| 0.5 * width);
            cutter_radius::measure(self.min_concave_radius(), half_width, subject)
        });
        of.add(&wall::CHECK, |written| self.wall().map(|wall| wall::measure(wall, written, subject)));
        of.add(&pivot_clearance::CHECK, |_| pivot_clearance::measure(subject));
        of.add(&size::CHECK, |written| size::measure(written, self.blank_width(), subject));
        if !self.is_form_closed() {
            of.add(&force_closure::CHECK, |_| {
                force_closure::measure(self.least_closing_force(), || self.preload_that_holds(1.0), subject)
            });
        }
        of.add(&contact_stress::CHECK, |_| {
            let remedies = |largest: f64, limit: f64| self.stress_remedies(largest, limit);
            contact_stress::measure(self.contact_stress(), self.touching(), remedies, subject)
        });
    }
}

/// Calls `measures` with the body as checks know it.
pub fn with_subject<F: Figures>(body: &F, measures: impl FnOnce(&Subject<'_>)) {
    let at = |worst: &Worst| -> (Place, Option<Text>) { (body.place(worst.at), body.along_axis(worst.z)) };
    let remedy = || body.remedy();
    measures(&Subject {
        machine: body.machine(),
        curves: super::curves_of(body),
        speed: body.shaft_speed(),
        at: &at,
        remedy: &remedy,
    });
}

/// What the follower loses of its motion where the profile is undercut, a sentence each: of many places those where it is most.
pub(crate) fn lost_motion(curves: Curves<'_>, place: &dyn Fn(f64) -> Place) -> Vec<Text> {
    let mut losses = match envelope::losses(curves) {
        Err(error) => return vec![text!("{}, at {}", error.to_string(), place(error.parameter).text())],
        Ok(losses) => losses,
    };
    let more = losses.len().saturating_sub(MOST_LOSSES);
    if more > 0 {
        losses.sort_by(|a, b| b.lost.total_cmp(&a.lost));
        losses.truncate(MOST_LOSSES);
        losses.sort_by(|a, b| a.from.total_cmp(&b.from));
    }
    let texts = losses.iter().map(|loss| {
        let [from, to, at] = [loss.from, loss.to, loss.lost_at].map(place);
        let lost = Length::mm(MILLIMETRES * loss.lost);
        text!("motion is lost from {} to {}, {} at {}", from.text(), to.text(), lost, at.text())
    });
    let others = (more > 0).then(|| text!("and at {} other places, at none of them more", more));
    texts.chain(others).collect()
}

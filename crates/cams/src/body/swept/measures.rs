//! What is checked of every swept cam as it was solved.

use super::SweptBody;
use super::figures::{least_fold, pressure_angles};
use crate::body::{Body, in_groove};
use crate::check::continuity::RunMotion;
use crate::check::{Measures, Subject, continuity, curvature, cutter_radius, pressure_angle, size, wall};
use crate::report::Place;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::Worst;
use camgen_kernel::text::Text;

/// Takes the measures of a cam.
pub(crate) fn take_measures<B: SweptBody>(body: &B, of: &mut Measures<'_>) {
    let groove = body.groove();
    let at = |worst: &Worst| -> (Place, Option<Text>) { (body.place(worst.at), None) };
    let remedy = || body.remedy();
    let speed = groove.speed();
    let subject = Subject { machine: &groove.machine, curves: None, speed, at: &at, remedy: &remedy };
    let run = [RunMotion { motion: &*groove.motion, z: 0.0, speed }];
    of.add(&continuity::CHECK, |_| continuity::measure(&run, || None, &subject));
    of.add(&pressure_angle::CHECK, |_| pressure_angle::measure(pressure_angles(body), &subject));
    of.add(&curvature::UNDERCUT, |_| curvature::undercut(&least_fold(body), groove.farther(), Vec::new, &subject));
    let half = body.narrowest_half_width();
    let widest_cutter = Worst { value: half, at: 0.0, z: 0.0 };
    of.add(&cutter_radius::CHECK, |_| cutter_radius::measure(Some(widest_cutter), Some(half), &subject));
    of.add(&wall::CHECK, |written| wall::measure(body.wall(), written, &subject));
    let longest = MILLIMETRES * body.longest();
    let largest_size = MILLIMETRES * groove.machine.limits.largest_size();
    of.add(&size::CHECK, |_| size::CHECK.measure(longest, Some(largest_size)));
    in_groove::measured(body, of, &subject);
    body.measure(of, &subject);
}

//! The figures of a disc that checks judge, and its load as an outline shows it.

use super::{Disc, Hold, LARGEST_BASE, keyway_wall, residual_vibration};
use crate::body::load_as_cut::LoadAsCut;
use crate::body::{Figures, conjugate, no_radius, passing, stress};
use crate::check::contact_stress::ContactKind;
use crate::check::{Measures, Subject, guide, jump_speed};
use crate::report::shown;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Jet;
use camgen_kernel::profile::outline;
use camgen_kernel::profile::{Contact, Worst};
use camgen_kernel::text::{KeyChange, Remedy, Text, text};
use nalgebra::Vector2;

impl Figures for Disc {
    fn pressure_angles(&self) -> [Worst; 2] {
        self.worst.pressure_angles(self.curves())
    }

    fn least_radius(&self) -> Worst {
        self.worst.least_radius(self.curves())
    }

    fn least_rolled_radius(&self) -> Worst {
        self.worst.least_rolled_radius(self.curves())
    }

    fn min_concave_radius(&self) -> Option<Worst> {
        self.worst.min_concave_radius(self.curves())
    }

    fn roller_radius(&self) -> Option<f64> {
        self.curves().roller_radius()
    }

    fn wall(&self) -> Option<(f64, Option<Worst>)> {
        let about_bore = self.base_radius() - self.machine.cam.bore_radius?;
        Some(match self.machine.cam.keyway.and_then(|keyway| keyway_wall::nearest(self, keyway)) {
            Some(nearest) if nearest.value < about_bore => (nearest.value, Some(nearest)),
            _ => (about_bore, None),
        })
    }

    fn contact_stress(&self) -> Option<Worst> {
        let curves = (self.curves(), &*self.acting());
        let force = |at: (usize, f64), contact: &Contact| self.normal_force_of(at, contact);
        stress::largest(&force, curves, &self.machine, self.program_follower.crown_radius)
    }

    fn exceeds_stress(&self, limit: f64) -> bool {
        let force = |at: (usize, f64), contact: &Contact| self.normal_force_of(at, contact);
        let crown = self.program_follower.crown_radius;
        stress::exceeds_somewhere(&force, self.curves(), &self.machine, (crown, limit))
            || self.contact_stress().is_some_and(|stress| !(stress.value <= limit))
    }

    fn touching(&self) -> ContactKind {
        if self.program_follower.crown_radius.is_some() { ContactKind::Crown } else { ContactKind::Line }
    }

    fn stress_remedies(&self, largest: f64, limit: f64) -> Vec<Remedy> {
        self.keeping_stress(largest, limit)
    }

    fn largest_lifting_force(&self) -> Worst {
        self.largest_force(|piece, angle| self.path_force(piece, angle).map_or(f64::NAN, |force| -force))
    }

    /// Of a motion program wherever a force is known.
    fn least_closing_force(&self) -> Option<Worst> {
        let follower = &self.machine.follower;
        let described = follower.mass.is_some() || follower.preload.is_some();
        let known = if self.is_of_program() { self.pressing().is_some() && !self.is_closed() } else { described };
        let least = known.then(|| self.largest_lifting_force());
        least.map(|least| Worst { value: -least.value, ..least })
    }

    fn is_form_closed(&self) -> bool {
        self.is_closed()
    }

    fn preload_that_holds(&self, speed: f64) -> Option<KeyChange> {
        self.holding(speed)
    }

    fn smoother(&self) -> Option<Text> {
        self.duty.as_ref()?.smoother(&self.machine)
    }

    fn remedy(&self) -> Option<Text> {
        if let Some(main) = &self.main {
            return conjugate::remedy_of_counter(main);
        }
        let Some(base) = self.passing_base_radius() else {
            let largest = (self.follower.prime_radii().1 - self.curves().offset()).min(LARGEST_BASE);
            let of_size = || self.on(largest).and_then(|disc| disc.broken());
            let limit = if self.has_corner() { Some("undercut") } else { of_size() };
            return Some(no_radius(limit, self.motion.program().is_some()).into());
        };
        // A cam that no drawing holds is no remedy.
        let passes = match self.machine.cam.track.breadth {
            // The breadth of a yoke grows by twice the base radius.
            Some(breadth) => {
                let passing = MILLIMETRES * (breadth + 2.0 * (base - self.base_radius()));
                let change = KeyChange::new("cam.breadth", format!("{} mm", shown(passing)));
                text!("{} would pass", Remedy::new([change]))
            }
            None => passing(base),
        };
        (MILLIMETRES * base < outline::LARGEST_COORDINATE).then_some(passes)
    }
}

impl Disc {
    pub(super) fn measured_on(&self, of: &mut Measures<'_>, subject: &Subject<'_>) {
        self.measured(of, subject);
        self.measured_in_motion(of, subject);
    }

    /// The measures of what its follower does at speed.
    pub(in crate::body) fn measured_in_motion(&self, of: &mut Measures<'_>, subject: &Subject<'_>) {
        of.add(&jump_speed::CHECK, |_| {
            let holding = |speed: f64| self.holding(speed);
            self.jump().map(|jump| jump_speed::measure(jump, holding, subject))
        });
        of.add(&guide::CHECK, |_| self.least_guide_share().map(|least| guide::measure(&least, subject)));
        self.measured_in_bearing(of, subject);
        of.add(&residual_vibration::CHECK, |_| residual_vibration::measure(self, subject));
        if let Some(duty) = &self.duty {
            duty.measures(self, of, subject);
        }
    }
}

impl LoadAsCut for Disc {
    fn unbalanced(&self, (piece, angle): (usize, f64), moved: f64, _: Vector2<f64>) -> f64 {
        self.load.as_ref().map_or(0.0, |load| load.residual(piece, angle, moved).abs())
    }

    fn jumps(&self) -> Vec<f64> {
        self.load.iter().flat_map(|load| load.acting()).flat_map(|(from, to)| [from, to]).collect()
    }

    fn force_and_torque(&self, at: (usize, f64), lift: Jet) -> Option<[f64; 2]> {
        self.driving_force_and_torque(at, lift)
    }

    fn is_of_another_disc(&self) -> bool {
        matches!(self.hold, Hold::Pair { counter: Some(_), .. })
    }
}

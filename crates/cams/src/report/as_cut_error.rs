//! Errors of the follower on a written outline: velocity and acceleration as cut.

use super::Place;
use camgen_kernel::geometry::MILLIMETRES;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// The largest errors of velocity and acceleration as cut, per radian of the shaft, or per millimetre of the travel of a plate without one;
/// millimetres, or radians under a swinging follower.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AsCutError {
    /// Whether the follower swings.
    pub swings: bool,
    /// Whether they are per millimetre of travel.
    pub by_travel: bool,
    /// Largest error of the velocity, and where it is.
    pub velocity_error: (f64, Place),
    /// Largest error of the acceleration, and where it is.
    pub acceleration_error: (f64, Place),
    /// Largest step of the acceleration, and where it is.
    pub acceleration_step: (f64, Place),
    /// Largest step of the velocity, and where it is; `None` where the outline has no kink that the follower feels.
    pub velocity_step: Option<(f64, Place)>,
    /// Largest acceleration of the motion itself.
    pub acceleration_of_motion: f64,
    /// Speed of the shaft, rad/s, where it is known.
    pub shaft_speed: Option<f64>,
    /// Mass that moves with the follower, kg, where it is known.
    pub mass: Option<f64>,
}

impl AsCutError {
    /// The largest error of the acceleration over the largest acceleration of the motion; `None` for a motion without acceleration.
    #[must_use]
    pub fn acceleration_share(&self) -> Option<f64> {
        (self.acceleration_of_motion > 0.0).then(|| self.acceleration_error.0 / self.acceleration_of_motion)
    }

    /// A velocity at the speed of the shaft, mm/s or rad/s.
    fn velocity(&self, by_angle: f64) -> Option<f64> {
        self.shaft_speed.map(|speed| by_angle * speed)
    }

    /// An acceleration at the speed of the shaft, m/s² or rad/s².
    #[must_use]
    pub fn acceleration(&self, by_angle: f64) -> Option<f64> {
        let unit = if self.swings { 1.0 } else { 1e-3 };
        self.shaft_speed.map(|speed| unit * by_angle * speed * speed)
    }

    /// The force due to the error of the acceleration, N.
    #[must_use]
    pub fn force(&self) -> Option<f64> {
        self.acceleration(self.acceleration_error.0).zip(self.mass).map(|(acceleration, mass)| acceleration * mass)
    }

    /// Units of velocity and acceleration by the angle, as they are written.
    #[must_use]
    pub fn units(&self) -> [&'static str; 2] {
        Self::units_of(self.swings, self.by_travel)
    }

    /// Those of a follower that swings, or whose rates are by travel.
    #[must_use]
    pub fn units_of(swings: bool, by_travel: bool) -> [&'static str; 2] {
        match (swings, by_travel) {
            (true, _) => ["rad/rad", "rad/rad²"],
            (false, true) => ["mm/mm", "mm/mm²"],
            (false, false) => ["mm/rad", "mm/rad²"],
        }
    }

    /// What velocity and acceleration in SI units are multiplied by, of a follower that swings, or whose rates are by travel.
    #[must_use]
    pub fn sizes(swings: bool, by_travel: bool) -> [f64; 2] {
        match (swings, by_travel) {
            (true, _) => [1.0; 2],
            (false, true) => [1.0, 1.0 / MILLIMETRES],
            (false, false) => [MILLIMETRES; 2],
        }
    }
}

impl Serialize for AsCutError {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (unit, fast) = if self.swings { ("rad", "rad") } else { ("mm", "m") };
        let [by, by_square] = if self.by_travel { ["mm", "mm2"] } else { ["rad", "rad2"] };
        let mut map = serializer.serialize_map(None)?;
        let velocity = ("velocity_error_max", self.velocity_error, by);
        let acceleration = ("acceleration_error_max", self.acceleration_error, by_square);
        let step = ("acceleration_step_max", self.acceleration_step, by_square);
        let kink = self.velocity_step.map(|step| ("velocity_step_max", step, by));
        for (name, (value, place), per) in [velocity, acceleration, step].into_iter().chain(kink) {
            map.serialize_entry(&format!("{name}_{unit}_per_{per}"), &value)?;
            match place.x_mm {
                Some(x) => map.serialize_entry(&format!("{name}_x_mm"), &x)?,
                None => map.serialize_entry(&format!("{name}_cam_deg"), &place.cam_deg)?,
            }
        }
        map.serialize_entry(
            &format!("acceleration_of_motion_max_{unit}_per_{by_square}"),
            &self.acceleration_of_motion,
        )?;
        if let Some(velocity) = self.velocity(self.velocity_error.0) {
            map.serialize_entry(&format!("velocity_error_max_{unit}_per_s"), &velocity)?;
        }
        for (name, value) in [
            ("acceleration_error_max", self.acceleration_error.0),
            ("acceleration_step_max", self.acceleration_step.0),
            ("acceleration_of_motion_max", self.acceleration_of_motion),
        ] {
            if let Some(value) = self.acceleration(value) {
                map.serialize_entry(&format!("{name}_{fast}_per_s2"), &value)?;
            }
        }
        if let Some(force) = self.force() {
            map.serialize_entry("acceleration_error_force_max_n", &force)?;
        }
        map.end()
    }
}

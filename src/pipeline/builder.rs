//! A specification put together in code: the keys of a machine file as methods, checked by the same table.

use super::{Error, Spec};
use crate::machine::Machine;
use crate::motion::Motion;
use crate::write::number::shortest;
use std::sync::Arc;

/// Collects the keys of a machine file. Lengths are in metres, angles in radians.
#[derive(Debug, Clone)]
pub struct Builder {
    name: String,
    keys: Vec<String>,
}

impl Builder {
    pub(super) fn new(name: &str) -> Self {
        Self { name: name.to_owned(), keys: Vec::new() }
    }

    /// Sets any key by its dotted path, with a value as in `--set`: `set("cam.material", "steel")`.
    #[must_use]
    pub fn set(mut self, key: &str, value: &str) -> Self {
        self.keys.push(format!("{key}={value}"));
        self
    }

    fn length(self, key: &str, metres: f64) -> Self {
        self.set(key, &format!("{} m", shortest(metres)))
    }

    fn angle(self, key: &str, radians: f64) -> Self {
        self.set(key, &format!("{} rad", shortest(radians)))
    }

    /// A translating roller of a radius.
    #[must_use]
    pub fn roller(self, radius: f64) -> Self {
        self.length("follower.roller.radius", radius)
    }

    /// Offset of the roller's path from the shaft, positive against the rotation of the cam.
    #[must_use]
    pub fn offset(self, offset: f64) -> Self {
        self.length("follower.roller.offset", offset)
    }

    /// Base radius; without it the smallest is taken that keeps the limits, in whole millimetres.
    #[must_use]
    pub fn base_radius(self, radius: f64) -> Self {
        self.length("cam.base_radius", radius)
    }

    /// Thickness of the disc, which a solid needs.
    #[must_use]
    pub fn thickness(self, thickness: f64) -> Self {
        self.length("cam.thickness", thickness)
    }

    /// Radius of the bore.
    #[must_use]
    pub fn bore_radius(self, radius: f64) -> Self {
        self.length("cam.bore_radius", radius)
    }

    /// The cam turns counter-clockwise in the drawing.
    #[must_use]
    pub fn counter_clockwise(self) -> Self {
        self.set("cam.rotation", "ccw")
    }

    /// Limit of the pressure angle.
    #[must_use]
    pub fn pressure_angle(self, angle: f64) -> Self {
        self.angle("limits.pressure_angle", angle)
    }

    /// Radius of the cutter that must fit into the concave parts.
    #[must_use]
    pub fn cutter_radius(self, radius: f64) -> Self {
        self.length("limits.cutter_radius", radius)
    }

    /// The machine, every value in range.
    ///
    /// # Errors
    /// [`Error::Machine`] with all faults.
    pub fn machine(self) -> Result<Machine, Error> {
        // The name may hold anything a TOML text may; JSON escapes it in the same way.
        let name = serde_json::Value::from(self.name);
        Ok(Machine::from_toml("the builder", &format!("name = {name}\n"), &self.keys)?)
    }

    /// A disc cam for a motion of your own.
    ///
    /// # Errors
    /// [`Error::Machine`] with all faults.
    pub fn motion(self, motion: impl Motion + 'static) -> Result<Spec, Error> {
        Ok(Spec::of_motion(self.machine()?, Arc::new(motion), None))
    }
}

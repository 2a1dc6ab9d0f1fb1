//! What presses on the follower of a machine that is put together in code, and what moves with it.

use super::Builder;
use crate::machine::{GuideData, SpringData, VibrationData};
use crate::write::number::with_unit;

/// What the tables of followers that swing begin with.
const SWINGING: &str = "follower.swinging";

impl Builder {
    /// The spring that presses the follower onto the cam: N and m of a follower on a straight path, N·m and rad of one that swings.
    #[must_use]
    pub fn spring(self, spring: SpringData) -> Self {
        Self { spring: Some(spring), ..self }
    }

    /// The guide of a follower on a straight path, for its friction and whether it jams.
    #[must_use]
    pub fn guide(self, guide: GuideData) -> Self {
        let GuideData { friction, span, overhang } = guide;
        self.number("guide.friction", friction).length("guide.span", span).length("guide.overhang", overhang)
    }

    /// The elastic train from the follower to its load, as one mass on one spring.
    #[must_use]
    pub fn vibration(self, vibration: VibrationData) -> Self {
        let VibrationData { natural_frequency, damping } = vibration;
        self.quantity("vibration.natural_frequency", natural_frequency, "Hz").number("vibration.damping", damping)
    }

    /// The coefficient of speed fluctuation that a flywheel on the camshaft is to keep: largest less least speed over the mean.
    #[must_use]
    pub fn flywheel(self, fluctuation: f64) -> Self {
        self.number("flywheel.fluctuation", fluctuation)
    }
}

/// Adds the keys of a spring in the units of the follower that other keys describe.
pub(super) fn push_spring(keys: &mut Vec<String>, spring: &SpringData) {
    let [rate, force, damping] = if keys.iter().any(|key| key.starts_with(SWINGING)) {
        ["N*m/rad", "N*m", "N*m*s/rad"]
    } else {
        ["N/m", "N", "N*s/m"]
    };
    let quantities = [
        ("rate", spring.rate, rate),
        ("preload", spring.preload, force),
        ("damping", spring.damping, damping),
        ("load", spring.load, force),
    ];
    // What is 0 is the default of the file, but the table is there also with a rate of 0.
    let given = quantities.into_iter().filter(|(key, value, _)| *value != 0.0 || *key == "rate");
    keys.extend(given.map(|(key, value, unit)| format!("spring.{key}={}", with_unit(value, unit))));
}

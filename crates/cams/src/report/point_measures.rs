//! Tables of points in a report.

use super::{AsCutError, Section};
use camgen_kernel::text::{Length, Text, Value, text};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// A table of points, and the errors of the curve that a control makes of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointMeasures {
    /// Speed of its section, rpm, where there are several.
    pub rpm: Option<f64>,
    /// Rows.
    pub rows: usize,
    /// The interpolation of the control between them.
    pub interpolation: &'static str,
    /// Largest allowed distance from the exact curve, mm.
    pub tolerance_mm: f64,
    /// Bound of that distance, mm.
    pub error_mm: f64,
    /// Whether the follower swings.
    pub swings: bool,
    /// Whether its rates are by the travel of a plate.
    pub by_travel: bool,
    /// Largest error of the velocity, mm or rad per rad, or mm per mm, where it is known.
    pub velocity_error: Option<f64>,
    /// Largest error of the acceleration, mm or rad per rad², or mm per mm², where it is known.
    pub acceleration_error: Option<f64>,
}

impl PointMeasures {
    /// The section of a report; `None` where there is no table.
    #[must_use]
    pub fn section(all: &[Self]) -> Option<Section> {
        (!all.is_empty()).then(|| Section::new("points", &all).with_words(all.iter().map(Self::words).collect()))
    }

    fn words(&self) -> Text {
        let [of_velocity, of_acceleration] = AsCutError::units_of(self.swings, self.by_travel);
        let of = self.rpm.map_or_else(String::new, |rpm| format!(" for {rpm} rpm"));
        let mut words = text!(
            "{} rows{}, {} between them, off by {}",
            self.rows,
            of,
            self.interpolation,
            Length::mm(self.error_mm)
        );
        if let Some(error) = self.velocity_error {
            words += text!(", the velocity by {}", Value::with_unit(error, of_velocity));
        }
        if let Some(error) = self.acceleration_error {
            words += text!(", the acceleration by {}", Value::with_unit(error, of_acceleration));
        }
        words
    }
}

impl Serialize for PointMeasures {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        if let Some(rpm) = self.rpm {
            map.serialize_entry("rpm", &rpm)?;
        }
        map.serialize_entry("rows", &self.rows)?;
        map.serialize_entry("interpolation", self.interpolation)?;
        map.serialize_entry("tolerance_mm", &self.tolerance_mm)?;
        map.serialize_entry("error_mm", &self.error_mm)?;
        let keys = match (self.swings, self.by_travel) {
            (true, _) => ["velocity_error_rad_per_rad", "acceleration_error_rad_per_rad2"],
            (false, true) => ["velocity_error_mm_per_mm", "acceleration_error_mm_per_mm2"],
            (false, false) => ["velocity_error_mm_per_rad", "acceleration_error_mm_per_rad2"],
        };
        for (key, value) in keys.iter().zip([self.velocity_error, self.acceleration_error]) {
            if let Some(value) = value {
                map.serialize_entry(key, &value)?;
            }
        }
        map.end()
    }
}

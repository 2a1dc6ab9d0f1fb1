//! The unit of the lengths in files, and the names of columns in it.

use std::borrow::Cow;

/// The unit of the lengths in the files that are written. Inside there are millimetres from the drawing on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LengthUnit {
    /// Millimetres.
    #[default]
    Millimetre,
    /// Inches of 25.4 mm.
    Inch,
}

impl LengthUnit {
    /// The symbol, as the names of columns end with it.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Inch => "in",
        }
    }

    /// Millimetres in one.
    #[must_use]
    pub fn millimetres(self) -> f64 {
        match self {
            Self::Millimetre => 1.0,
            Self::Inch => 25.4,
        }
    }

    /// A length in mm in this unit.
    #[must_use]
    pub fn of_mm(self, millimetres: f64) -> f64 {
        millimetres / self.millimetres()
    }

    /// The name of a column of millimetres in this unit, and the power of the millimetre in it: `velocity_mm_per_rad` is `velocity_in_per_rad`, 1. Columns
    /// with forces and masses, such as `stiffness_n_per_mm`, and without lengths stay as they are.
    #[must_use]
    pub fn column(self, name: &str) -> (Cow<'_, str>, i32) {
        match self {
            Self::Millimetre => (Cow::Borrowed(name), 0),
            Self::Inch => renamed(name, Self::Millimetre, Self::Inch),
        }
    }

    /// A value of millimetres to a power in this unit.
    #[must_use]
    pub fn of_mm_to(self, value: f64, power: i32) -> f64 {
        let factor = (0..power.abs()).fold(1.0, |factor, _| factor * self.millimetres());
        if power < 0 { value * factor } else { value / factor }
    }
}

/// The name of a column of inches as one of millimetres, and the power of the inch in it.
#[must_use]
pub fn metric_column(name: &str) -> (Cow<'_, str>, i32) {
    renamed(name, LengthUnit::Inch, LengthUnit::Millimetre)
}

/// Parts of the names of columns whose unit is more than a length.
const NOT_OF_LENGTH: [&str; 6] = ["n", "kn", "nm", "g", "kg", "mpa"];

/// The name of a column with one unit in the place of another, and the power of that unit in it. A unit is the last part of a name, or next to
/// `per`.
fn renamed(name: &str, from: LengthUnit, to: LengthUnit) -> (Cow<'_, str>, i32) {
    let parts: Vec<&str> = name.split('_').collect();
    if parts.iter().any(|part| NOT_OF_LENGTH.contains(part)) {
        return (Cow::Borrowed(name), 0);
    }
    let mut power = 0;
    let mut found = false;
    let renamed = parts.iter().enumerate().map(|(index, part)| {
        let after = index.checked_sub(1).and_then(|before| parts.get(before)) == Some(&"per");
        let is_unit = after || index + 1 == parts.len() || parts.get(index + 1) == Some(&"per");
        let exponent = part.strip_prefix(from.symbol()).filter(|_| is_unit);
        let size = match exponent {
            Some("") => 1,
            Some("2") => 2,
            Some("3") => 3,
            _ => return (*part).to_owned(),
        };
        found = true;
        power += if after { -size } else { size };
        format!("{}{}", to.symbol(), exponent.unwrap_or_default())
    });
    let renamed: Vec<String> = renamed.collect();
    if found { (Cow::Owned(renamed.join("_")), power) } else { (Cow::Borrowed(name), 0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_named_for_the_unit_of_their_lengths() {
        for (metric, inch, power) in [
            ("x_mm", "x_in", 1),
            ("velocity_mm_per_rad", "velocity_in_per_rad", 1),
            ("acceleration_mm_per_mm2", "acceleration_in_per_in2", -1),
            ("velocity_mm_per_mm", "velocity_in_per_in", 0),
            ("added_volume_mm3", "added_volume_in3", 3),
            ("a_per_mm", "a_per_in", -1),
            ("run_in_mm", "run_in_in", 1),
        ] {
            assert_eq!(LengthUnit::Inch.column(metric), (Cow::Borrowed(inch), power), "{metric}");
            assert_eq!(metric_column(inch), (Cow::Borrowed(metric), power), "{inch}");
            assert_eq!(LengthUnit::Millimetre.column(metric), (Cow::Borrowed(metric), 0));
        }
        for other in ["stiffness_n_per_mm", "unbalance_g_mm", "cam_deg", "lift_per_z", "deflection_um_per_kn", "run_in"]
        {
            assert_eq!(LengthUnit::Inch.column(other).1, 0, "{other}");
            assert_eq!(LengthUnit::Inch.column(other).0, other);
        }
        assert_eq!(LengthUnit::Inch.of_mm_to(645.16, 2), 1.0);
        assert_eq!(LengthUnit::Inch.of_mm_to(2.0, -1), 50.8);
    }
}

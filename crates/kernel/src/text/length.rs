//! Lengths in sentences, and what else has a length in its unit.

use super::figures::{nominal, rounded, shown, significant};
use crate::units::LengthUnit;

/// A unit with a length, as sentences write it.
#[derive(Debug, PartialEq)]
pub struct LengthKind {
    /// With millimetres.
    metric: &'static str,
    /// With inches.
    inch: &'static str,
    /// Inches to the power that they have, in one of the metric unit.
    inches: f64,
}

const MM_IN_INCH: f64 = 25.4;
/// Significant digits of a figure of a summary.
pub const DIGITS: usize = 4;

impl LengthKind {
    const fn linear(metric: &'static str, inch: &'static str, mm: f64) -> Self {
        Self { metric, inch, inches: mm / MM_IN_INCH }
    }

    /// Millimetres.
    pub const MM: Self = Self::linear("mm", "in", 1.0);
    /// Micrometres.
    pub const UM: Self = Self::linear("µm", "in", 1e-3);
    /// Square millimetres.
    pub const MM2: Self = Self { metric: "mm²", inch: "in²", inches: 1.0 / (MM_IN_INCH * MM_IN_INCH) };
    /// Cubic millimetres.
    pub const MM3: Self = Self { metric: "mm³", inch: "in³", inches: 1.0 / (MM_IN_INCH * MM_IN_INCH * MM_IN_INCH) };
    /// Metres per second.
    pub const M_PER_S: Self = Self::linear("m/s", "in/s", 1e3);
    /// Metres per second squared.
    pub const M_PER_S2: Self = Self::linear("m/s²", "in/s²", 1e3);
    /// Metres per second cubed.
    pub const M_PER_S3: Self = Self::linear("m/s³", "in/s³", 1e3);
    /// Millimetres per radian.
    pub const MM_PER_RAD: Self = Self::linear("mm/rad", "in/rad", 1.0);
    /// Millimetres per radian squared.
    pub const MM_PER_RAD2: Self = Self::linear("mm/rad²", "in/rad²", 1.0);
    /// Millimetres per radian cubed.
    pub const MM_PER_RAD3: Self = Self::linear("mm/rad³", "in/rad³", 1.0);
    /// Millimetres per millimetre: a slope.
    pub const MM_PER_MM: Self = Self { metric: "mm/mm", inch: "in/in", inches: 1.0 };
    /// Millimetres per square millimetre: a curvature.
    pub const MM_PER_MM2: Self = Self { metric: "mm/mm²", inch: "in/in²", inches: MM_IN_INCH };
    /// Millimetres per cubic millimetre.
    pub const MM_PER_MM3: Self = Self { metric: "mm/mm³", inch: "in/in³", inches: MM_IN_INCH * MM_IN_INCH };
}

/// Every kind.
const KINDS: [&LengthKind; 13] = [
    &LengthKind::MM,
    &LengthKind::UM,
    &LengthKind::MM2,
    &LengthKind::MM3,
    &LengthKind::M_PER_S,
    &LengthKind::M_PER_S2,
    &LengthKind::M_PER_S3,
    &LengthKind::MM_PER_RAD,
    &LengthKind::MM_PER_RAD2,
    &LengthKind::MM_PER_RAD3,
    &LengthKind::MM_PER_MM,
    &LengthKind::MM_PER_MM2,
    &LengthKind::MM_PER_MM3,
];

impl Eq for LengthKind {}

impl LengthKind {
    /// As sentences write it.
    #[must_use]
    pub fn symbol(&self, unit: LengthUnit) -> &'static str {
        match unit {
            LengthUnit::Millimetre => self.metric,
            LengthUnit::Inch => self.inch,
        }
    }

    /// What a value in the metric unit is multiplied by to have it in that of a reader.
    #[must_use]
    pub fn scale(&self, unit: LengthUnit) -> f64 {
        match unit {
            LengthUnit::Millimetre => 1.0,
            LengthUnit::Inch => self.inches,
        }
    }

    /// The kind of a metric unit as sentences or as reports for programs write it, `mm²` or `mm2`; `None` where it has no length.
    #[must_use]
    pub fn of_symbol(symbol: &str) -> Option<&'static Self> {
        KINDS
            .into_iter()
            .find(|kind| symbol.chars().eq(kind.metric.chars()) || symbol.chars().eq(kind.metric.chars().map(plain)))
    }
}

/// A raised digit as a digit.
fn plain(letter: char) -> char {
    match letter {
        '²' => '2',
        '³' => '3',
        other => other,
    }
}

/// How the metric number is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Shown,
    Fixed(usize),
    Signed(usize),
    Rounded,
    Significant(usize),
    Nominal(usize),
}

/// A value in a unit with a length.
#[derive(Debug, Clone)]
pub struct Length {
    value: f64,
    kind: &'static LengthKind,
    form: Form,
    has_unit: bool,
}

/// Alike where they are written alike; a value that is not a number is like itself.
impl PartialEq for Length {
    fn eq(&self, other: &Self) -> bool {
        let written = |length: &Self| (length.value.to_bits(), length.kind.metric, length.form, length.has_unit);
        written(self) == written(other)
    }
}

impl Eq for Length {}

impl Length {
    /// A value in the metric unit of its kind.
    #[must_use]
    pub fn new(value: f64, kind: &'static LengthKind) -> Self {
        Self { value, kind, form: Form::Shown, has_unit: true }
    }

    /// A length in mm.
    #[must_use]
    pub fn mm(value: f64) -> Self {
        Self::new(value, &LengthKind::MM)
    }

    /// A length in mm, which sentences write in µm.
    #[must_use]
    pub fn um_of_mm(value: f64) -> Self {
        Self::new(1e3 * value, &LengthKind::UM)
    }

    /// With so many decimals in the metric unit, and not as many as [`shown`] gives.
    #[must_use]
    pub fn decimals(self, decimals: usize) -> Self {
        Self { form: Form::Fixed(decimals), ..self }
    }

    /// With so many decimals in the metric unit, and a sign also where it is positive.
    #[must_use]
    pub fn signed(self, decimals: usize) -> Self {
        Self { form: Form::Signed(decimals), ..self }
    }

    /// With at most three decimals in the metric unit, as [`rounded`] gives.
    #[must_use]
    pub fn rounded(self) -> Self {
        Self { form: Form::Rounded, ..self }
    }

    /// With four significant digits in either unit, as figures of a summary have them.
    #[must_use]
    pub fn brief(self) -> Self {
        Self { form: Form::Significant(DIGITS), ..self }
    }

    /// With at most four significant digits in either unit, as a chosen size in a summary has them.
    #[must_use]
    pub fn nominal(self) -> Self {
        Self { form: Form::Nominal(DIGITS), ..self }
    }

    /// Without its unit, which another one behind it has.
    #[must_use]
    pub fn bare(self) -> Self {
        Self { has_unit: false, ..self }
    }

    /// As a sentence has it, in a unit.
    #[must_use]
    pub fn in_unit(&self, unit: LengthUnit) -> String {
        let metric = match self.form {
            Form::Shown => shown(self.value),
            Form::Fixed(decimals) => format!("{:.decimals$}", self.value),
            Form::Signed(decimals) => format!("{:+.decimals$}", self.value),
            Form::Rounded => rounded(self.value),
            Form::Significant(digits) => significant(self.value, digits),
            Form::Nominal(digits) => nominal(self.value, digits),
        };
        let (number, unit) = match unit {
            LengthUnit::Millimetre => (metric, self.kind.metric),
            LengthUnit::Inch => {
                // As many digits as the metric number has: those behind them are not meant to be read.
                let inches = self.value * self.kind.inches;
                let brief = match self.form {
                    Form::Significant(digits) => Some(significant(inches, digits)),
                    Form::Nominal(digits) => Some(nominal(inches, digits)),
                    _ => None,
                };
                let value = if self.form == Form::Shown { self.value } else { metric.parse().unwrap_or(self.value) };
                let sign = if matches!(self.form, Form::Signed(_)) && value > 0.0 { "+" } else { "" };
                (brief.unwrap_or_else(|| format!("{sign}{}", shown(value * self.kind.inches))), self.kind.inch)
            }
        };
        if self.has_unit { format!("{number} {unit}") } else { number }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_written_in_either_unit() {
        let of_mm = |length: Length| [length.in_unit(LengthUnit::Millimetre), length.in_unit(LengthUnit::Inch)];
        assert_eq!(of_mm(Length::mm(69.0)), ["69 mm", "2.7165 in"]);
        assert_eq!(of_mm(Length::mm(53.135).decimals(3)), ["53.135 mm", "2.0919 in"]);
        assert_eq!(of_mm(Length::mm(12.7).bare()), ["12.7", "0.5"]);
        assert_eq!(of_mm(Length::um_of_mm(0.005_08)), ["5.08 µm", "0.0002 in"]);
        assert_eq!(of_mm(Length::new(645.16, &LengthKind::MM2)), ["645.16 mm²", "1 in²"]);
        assert_eq!(of_mm(Length::new(2.54, &LengthKind::MM_PER_RAD2)), ["2.54 mm/rad²", "0.1 in/rad²"]);
        assert_eq!(of_mm(Length::new(2.0, &LengthKind::MM_PER_MM2)), ["2 mm/mm²", "50.8 in/in²"]);
        assert_eq!(of_mm(Length::new(0.0254, &LengthKind::M_PER_S)), ["0.0254 m/s", "1 in/s"]);
    }
}

//! Lengths as a drawing writes them: in millimetres by ISO 129, or in inches by ASME Y14.5, without a zero before the point and with as many places
//! as their tolerance has.

use super::rounded;
use crate::report::shown;
use camgen_kernel::units::LengthUnit;

/// Places of a dimension in inches, and of one that would be off by more than [`EXACT`] with them.
const PLACES: usize = 3;
const MORE_PLACES: usize = 4;
/// How far a dimension of fewer places may be off, in.
const EXACT: f64 = 5e-5;
/// Smaller lengths than this have more places, in.
const SMALL: f64 = 1e-3;
/// A number of round digits must not lose its last one to rounding.
const NEARLY: f64 = 1e-7;

/// A decimal inch: without a zero before its point.
fn decimal_inch(inches: f64, places: usize) -> String {
    let text = format!("{:.places$}", inches + 0.0);
    match text.strip_prefix('-') {
        Some(size) if size.bytes().all(|byte| byte == b'0' || byte == b'.') => decimal_inch(0.0, places),
        Some(size) => format!("-{}", size.strip_prefix('0').unwrap_or(size)),
        None => text.strip_prefix('0').filter(|rest| rest.starts_with('.')).unwrap_or(&text).to_owned(),
    }
}

/// Lengths on a drawing in a unit.
pub trait Dimensions {
    /// A length, mm, as a dimension.
    #[must_use]
    fn dimension(self, millimetres: f64) -> String;

    /// The nominal size, mm, of a dimension with limits of its own: in inches it has the places of its limits.
    #[must_use]
    fn toleranced(self, millimetres: f64) -> String;

    /// The limits of a dimension, lower and upper, mm: ` +0.021/0`, in inches ` +.0008/-.0000`, rounded towards each other.
    #[must_use]
    fn limits(self, limits: [f64; 2]) -> String;

    /// The width of a zone, mm, never wider than it is.
    #[must_use]
    fn zone(self, millimetres: f64) -> String;

    /// A length, mm, in a cell of a table.
    #[must_use]
    fn cell(self, millimetres: f64) -> String;
}

impl Dimensions for LengthUnit {
    fn dimension(self, millimetres: f64) -> String {
        let inches = self.of_mm(millimetres);
        match self {
            _ if !millimetres.is_finite() => rounded(millimetres),
            Self::Millimetre => rounded(millimetres),
            Self::Inch if inches != 0.0 && inches.abs() < 0.1 * SMALL => shown(inches),
            Self::Inch => {
                let of_few = (inches * 1e3).round() / 1e3;
                let places = if (of_few - inches).abs() < EXACT { PLACES } else { MORE_PLACES };
                decimal_inch(inches, places)
            }
        }
    }

    fn toleranced(self, millimetres: f64) -> String {
        match self {
            Self::Millimetre => rounded(millimetres),
            Self::Inch => decimal_inch(self.of_mm(millimetres), MORE_PLACES),
        }
    }

    fn limits(self, [low, high]: [f64; 2]) -> String {
        if self == Self::Millimetre {
            let signed = |value: f64| {
                let text = rounded((value * 1e4).round() / 1e4);
                if value > 0.0 { format!("+{text}") } else { text.replace('-', "−") }
            };
            return if low == -high {
                format!("±{}", rounded(high))
            } else {
                format!("{}/{}", signed(high), signed(low))
            };
        }
        let ten_thousandths = |millimetres: f64| 1e4 * self.of_mm(millimetres);
        let (low, high) = ((ten_thousandths(low) - NEARLY).ceil(), (ten_thousandths(high) + NEARLY).floor());
        let text = |value: f64| decimal_inch(1e-4 * value.abs(), MORE_PLACES);
        if low == -high {
            return format!("±{}", text(high));
        }
        // A limit of zero has the sign that the other has not.
        let upper = if high > 0.0 || (high == 0.0 && low < 0.0) { '+' } else { '-' };
        let lower = if low < 0.0 || (low == 0.0 && high > 0.0) { '-' } else { '+' };
        format!("{upper}{}/{lower}{}", text(high), text(low))
    }

    fn zone(self, millimetres: f64) -> String {
        let inches = self.of_mm(millimetres);
        match self {
            Self::Millimetre => rounded(millimetres),
            Self::Inch => {
                let (places, per_inch) = if inches < SMALL { (MORE_PLACES + 1, 1e5) } else { (MORE_PLACES, 1e4) };
                decimal_inch((inches * per_inch + NEARLY).floor() / per_inch, places)
            }
        }
    }

    fn cell(self, millimetres: f64) -> String {
        match self {
            Self::Millimetre => format!("{:.3}", millimetres + 0.0),
            Self::Inch => decimal_inch(self.of_mm(millimetres), MORE_PLACES),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inches_have_no_zero_before_the_point_and_the_places_of_their_tolerance() {
        let inch = LengthUnit::Inch;
        for (millimetres, text) in
            [(12.7, ".500"), (69.0, "2.7165"), (63.5, "2.500"), (-6.35, "-.250"), (0.0, ".000"), (2540.0, "100.000")]
        {
            assert_eq!(inch.dimension(millimetres), text, "{millimetres}");
        }
        assert_eq!(
            (inch.zone(0.03).as_str(), inch.zone(0.0127).as_str(), inch.zone(0.0254).as_str()),
            (".0011", ".00050", ".0010")
        );
        assert_eq!(inch.limits([0.0, 0.025]), "+.0009/-.0000");
        assert_eq!(inch.limits([-0.025, 0.0]), "+.0000/-.0009");
        assert_eq!(inch.limits([-0.0127, 0.0127]), "±.0005");
        assert_eq!(inch.limits([0.025, 0.05]), "+.0019/+.0010");
        assert_eq!((inch.toleranced(50.0).as_str(), inch.cell(-0.00001).as_str()), ("1.9685", ".0000"));
        let metric = LengthUnit::Millimetre;
        assert_eq!((metric.limits([0.0, 0.021]), metric.dimension(0.5)), ("+0.021/0".to_owned(), "0.5".to_owned()));
    }
}

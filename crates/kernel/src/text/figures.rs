//! Figures as text: for a reader, and to be typed.

/// A value below this is only the rounding of larger ones in every unit of a report.
const ROUNDING: f64 = 1e-9;
/// A larger value needs an exponent to be read.
const LARGEST: f64 = 1e9;
/// Digits of a figure.
const DIGITS: f64 = 6.0;

/// A figure to be read: at most six digits and four decimals, without trailing zeros. Small values keep six decimals, tiny ones two digits, and
/// what is only rounding is 0.
#[must_use]
pub fn shown(value: f64) -> String {
    let size = value.abs();
    if !size.is_finite() {
        return value.to_string();
    } else if size < ROUNDING {
        return "0".into();
    } else if !(1e-6..LARGEST).contains(&size) {
        return exponent(value);
    }
    let decimals = if size < 0.1 {
        1e6
    } else if size < 1e2 {
        1e4
    } else {
        libm::pow(10.0, DIGITS - 1.0 - libm::log10(size).floor())
    };
    format!("{}", (value * decimals).round() / decimals + 0.0)
}

/// Two digits and a power of ten, "1.2·10⁻⁷".
fn exponent(value: f64) -> String {
    let text = format!("{value:.1e}");
    let (digits, power) = text.split_once('e').unwrap_or((&text, ""));
    let raised = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => digit.to_digit(10).and_then(|digit| char::from_u32(0x2070 + digit)).unwrap_or(digit),
    };
    format!("{digits}·10{}", power.chars().map(raised).collect::<String>())
}

/// A number for a person: at most three decimals, no trailing zeros.
#[must_use]
pub fn rounded(value: f64) -> String {
    if !value.is_finite() {
        return "none".into();
    }
    let rounded = (value * 1e3).round() / 1e3 + 0.0;
    if rounded == 0.0 { shown(value) } else { rounded.to_string() }
}

/// What is to be typed, such as a remedy: at most four decimals, and no more digits than are needed.
#[must_use]
pub fn to_type(value: f64) -> String {
    let decimals = if value.abs() < 0.1 { 1e6 } else { 1e4 };
    let rounded = (value * decimals).round() / decimals;
    if rounded == 0.0 && value != 0.0 { format!("{value:.1e}") } else { rounded.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_at_most_six_digits() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (5.55e-14, "0"),
            (1.234e-7, "1.2·10⁻⁷"),
            (0.001_234_567, "0.001235"),
            (29.508_912, "29.5089"),
            (313.333_33, "313.333"),
            (-1030.5308, "-1030.53"),
            (193_986.664_6, "193987"),
            (6_155_081.1, "6155080"),
            (2e12, "2.0·10¹²"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(shown(value), text);
        }
        assert_eq!((to_type(5416.005).as_str(), to_type(2e-9).as_str()), ("5416.005", "2.0e-9"));
    }
}

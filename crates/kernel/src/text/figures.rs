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
    format!("{digits}·10{}", raised(power))
}

/// A whole number as an exponent.
fn raised(power: &str) -> String {
    let raised_digit = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => digit.to_digit(10).and_then(|digit| char::from_u32(0x2070 + digit)).unwrap_or(digit),
    };
    power.chars().map(raised_digit).collect()
}

/// Values from here on are written with a power of ten, those below the other one as well.
const LARGEST_PLAIN: f64 = 1e4;
const SMALLEST_PLAIN: f64 = 1e-4;

/// A figure of a summary: so many significant digits, trailing zeros among them, "82.42", "1186", "194.0·10³", and a true minus. What is only
/// rounding is 0.
#[must_use]
pub fn significant(value: f64, digits: usize) -> String {
    let size = value.abs();
    if !value.is_finite() {
        return if value.is_nan() { "–".into() } else { if value > 0.0 { "∞" } else { "−∞" }.into() };
    } else if size < ROUNDING {
        return "0".into();
    }
    // The power of ten of the first digit, once rounded: 9.9996 has that of 10.
    let text = format!("{size:.*e}", digits.saturating_sub(1));
    let power: i32 = text.split_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or(0);
    let rounded_up = size.max(libm::pow(10.0, f64::from(power)));
    // Powers of 1000, so that the unit can be said with a prefix.
    let shift = if (SMALLEST_PLAIN..LARGEST_PLAIN).contains(&rounded_up) { 0 } else { power.div_euclid(3) * 3 };
    let decimals = i32::try_from(digits).unwrap_or(i32::MAX).saturating_sub(1).saturating_sub(power - shift).max(0);
    let number = format!("{:.*}", usize::try_from(decimals).unwrap_or(0), size / libm::pow(10.0, f64::from(shift)));
    let sign = if value < 0.0 { "−" } else { "" };
    if shift == 0 { format!("{sign}{number}") } else { format!("{sign}{number}·10{}", raised(&shift.to_string())) }
}

/// A figure of a summary that was chosen and not calculated, such as a diameter: as [`significant`] without trailing zeros, "69", "21.5".
#[must_use]
pub fn nominal(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    let (number, power) = text.split_once('·').map_or((&*text, None), |(number, power)| (number, Some(power)));
    let number = if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number };
    power.map_or_else(|| number.to_owned(), |power| format!("{number}·{power}"))
}

/// A figure of a summary with as many digits more as it takes to tell it from a limit that it differs from.
#[must_use]
pub fn significant_beside(value: f64, limit: f64, digits: usize) -> String {
    let most = digits + 4;
    let told_apart = |digits: &usize| nominal(value, *digits) != nominal(limit, *digits);
    let enough = (digits..most).find(told_apart).unwrap_or(digits);
    significant(value, if value == limit { digits } else { enough })
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
    fn figures_of_a_summary_have_four_digits() {
        for (value, text) in [
            (0.0, "0"),
            (1e-12, "0"),
            (82.419_02, "82.42"),
            (9.999_96, "10.00"),
            (999.96, "1000"),
            (9_999.6, "10.00·10³"),
            (1185.8, "1186"),
            (-7.842_6, "−7.843"),
            (193_986.66, "194.0·10³"),
            (0.001_773_4, "0.001773"),
            (0.000_196_86, "0.0001969"),
            (4.2e-5, "42.00·10⁻⁶"),
            (f64::INFINITY, "∞"),
        ] {
            assert_eq!(significant(value, 4), text, "{value}");
        }
        assert_eq!(
            [nominal(69.0, 4), nominal(21.5, 4), nominal(150.0, 4), nominal(2e6, 4)],
            ["69", "21.5", "150", "2·10⁶"]
        );
        assert_eq!(significant_beside(29.995_7, 30.0, 4), "29.996");
        assert_eq!(significant_beside(44.225_9, 45.0, 4), "44.23");
        assert_eq!(significant_beside(30.0, 30.0, 4), "30.00");
    }

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

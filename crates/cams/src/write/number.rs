//! Numbers as text.

/// Sizes written without an exponent: within them neither form is much longer than the other.
const PLAIN: std::ops::Range<f64> = 1e-6..1e17;

/// The shortest text that reads back as the same `f64`; `inf`, `-inf`, `NaN` as such, no negative zero.
#[must_use]
pub fn shortest(value: f64) -> String {
    let mut buffer = zmij::Buffer::new();
    let text = buffer.format(value);
    match (PLAIN.contains(&value.abs()), text.contains('e')) {
        _ if value == 0.0 => "0".into(),
        (true, false) => text.strip_suffix(".0").unwrap_or(text).to_owned(),
        // zmij starts exponents some decades later.
        (true, true) => value.to_string(),
        (false, _) => format!("{value:e}"),
    }
}

/// A number with its unit, `0.012 m`, with all its digits.
#[must_use]
pub fn with_unit(value: f64, unit: &str) -> String {
    format!("{} {unit}", shortest(value))
}

/// Significant digits of a number in the name of a file.
const NAME_DIGITS: usize = 6;
/// This many digits distinguish any two numbers.
const ALL_DIGITS: usize = 17;

/// Numbers for names of files: six significant digits, and as many more as are needed to distinguish them.
#[must_use]
pub fn names(values: &[f64]) -> Vec<String> {
    let rounded = |value: f64, digits: usize| {
        let text = format!("{value:.*e}", digits - 1);
        text.parse().map_or(text, shortest)
    };
    let name = |value: &f64| {
        let alone = |digits: &usize| {
            let own = rounded(*value, *digits);
            values.iter().filter(|other| rounded(**other, *digits) == own).count() == 1
        };
        rounded(*value, (NAME_DIGITS..ALL_DIGITS).find(alone).unwrap_or(ALL_DIGITS))
    };
    values.iter().map(name).collect()
}

/// A plain decimal with at most `decimals` decimals and at least one, as DXF and SVG readers expect it: no exponent,
/// no negative zero.
#[must_use]
pub fn plain(value: f64, decimals: usize) -> String {
    let text = short(value, decimals);
    if value.is_finite() && !text.contains('.') { text + ".0" } else { text }
}

/// A plain decimal without a point for whole numbers.
#[must_use]
pub fn short(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".into() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shortest_reads_back() {
        for value in [0.1, 1.0 / 3.0, 1e300, -2.5e-17, 123_456_789.125, 5e-324, 360.0] {
            let text = shortest(value);
            assert_eq!(text.parse::<f64>().expect("a number"), value, "{text}");
            assert!(text.len() < 26, "{text}");
        }
        assert_eq!(shortest(-0.0), "0");
        let ends = [u32::MAX - 1, u32::MAX].map(f64::from);
        for value in (-4000..4000).map(f64::from).chain(ends).chain([4_294_967_296.0]).map(|halves| 0.5 * halves) {
            assert_eq!(shortest(value), format!("{}", value + 0.0));
        }
        // As the standard library, except where two texts are equally short and near.
        let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
        for _ in 0..200_000 {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let exponent = 1023 - 70 + (bits >> 40) % 140;
            let value = f64::from_bits(exponent << 52 | bits & 0x000f_ffff_ffff_ffff);
            let size = value.abs();
            let plain = PLAIN.contains(&size);
            let (text, expected) = (shortest(value), if plain { format!("{value}") } else { format!("{value:e}") });
            assert_eq!((text.parse(), text.len()), (Ok(value), expected.len()));
            assert!(text == expected || size > 1e9, "{text} {expected}");
        }
        assert_eq!(shortest(f64::INFINITY), "inf");
    }

    #[test]
    fn names_are_short_and_distinct() {
        assert_eq!(names(&[40.0 / 3.0, 35.0, 0.001, 1e5]), ["13.3333", "35", "0.001", "100000"]);
        assert_eq!(names(&[13.333_31, 13.333_32, 20.0]), ["13.33331", "13.33332", "20"]);
        let next = 35.0_f64.next_up();
        assert_eq!(names(&[35.0, next]), ["35".to_owned(), next.to_string()]);
    }

    #[test]
    fn plain_has_no_exponent_and_no_negative_zero() {
        assert_eq!(plain(1e-20, 12), "0.0");
        assert_eq!(plain(-1e-20, 12), "0.0");
        assert_eq!(plain(-0.0, 12), "0.0");
        assert_eq!(plain(1.5, 12), "1.5");
        assert_eq!((plain(120.0, 12), short(120.0, 6), short(-0.05, 1)), ("120.0".into(), "120".into(), "-0.1".into()));
        assert_eq!(plain(-69.123_456_789_012_34, 12), "-69.123456789012");
        assert_eq!((plain(f64::NAN, 6), plain(f64::NEG_INFINITY, 6)), ("NaN".into(), "-inf".into()));
    }
}

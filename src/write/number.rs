//! Numbers as text. Files are written as bytes, since each number that joins a `String` would be checked to be UTF-8 once more.

use crate::numeric::decimal::{push_decimal, push_fixed, push_whole};
use std::io::Write as _;

/// Sizes written without an exponent: where neither form is much longer than the other.
pub(super) const PLAIN: std::ops::Range<f64> = 1e-6..1e17;

/// Sizes that zmij writes without an exponent, and some more that it does.
const WITHOUT_EXPONENT: std::ops::Range<f64> = 1e-4..1e15;

/// The shortest text that reads back as the same `f64`; `inf`, `-inf`, `NaN` as such, no negative zero.
#[must_use]
pub fn shortest(value: f64) -> String {
    let mut text = Vec::with_capacity(24);
    push_shortest(&mut text, value);
    String::from_utf8(text).unwrap_or_default()
}

/// Adds the same to a text.
#[inline]
pub fn push_shortest(text: &mut Vec<u8>, value: f64) {
    if value == 0.0 {
        text.push(b'0');
    } else {
        push_digits(text, value);
    }
}

/// A number behind which there is no place for less than a half: 3·2⁵⁰.
const TO_HALVES: f64 = 3_377_699_720_527_872.0;
/// Halves below this fit into 32 bits.
const LARGEST_HALVES: f64 = 1e9;

/// The same of what is not zero.
fn push_digits(text: &mut Vec<u8>, value: f64) {
    let size = value.abs();
    if !WITHOUT_EXPONENT.contains(&size) {
        return push_very_large_or_small(text, value);
    }
    let large = size >= LARGEST_HALVES;
    if !large && (size + TO_HALVES) - TO_HALVES == size {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number that fits")]
        return push_halves(text, value < 0.0, (2.0 * size) as u32);
    }
    let mut buffer = zmij::Buffer::new();
    let digits = buffer.format_finite(value).as_bytes();
    // Only what is large may be whole.
    text.extend_from_slice(digits.strip_suffix(b".0").filter(|_| large).unwrap_or(digits));
}

/// Adds so many halves: steps of an angle, and the units of a frame, whose digits need not be searched.
fn push_halves(text: &mut Vec<u8>, negative: bool, halves: u32) {
    if negative {
        text.push(b'-');
    }
    push_whole(text, u64::from(halves / 2));
    if halves % 2 == 1 {
        text.extend_from_slice(b".5");
    }
}

/// The same of what may need an exponent.
fn push_very_large_or_small(text: &mut Vec<u8>, value: f64) {
    let size = value.abs();
    if !size.is_finite() {
        text.extend_from_slice(match value {
            value if value.is_nan() => b"NaN",
            value if value > 0.0 => b"inf",
            _ => b"-inf",
        });
        return;
    }
    let mut buffer = zmij::Buffer::new();
    let digits = buffer.format_finite(value);
    if size < PLAIN.start {
        // Very small numbers would fill a line with zeros.
        text.extend_from_slice(digits.as_bytes());
    } else if !digits.contains('e') {
        text.extend_from_slice(digits.strip_suffix(".0").unwrap_or(digits).as_bytes());
    } else if PLAIN.contains(&size) {
        // A text in memory takes all that is written.
        let _ = write!(text, "{value}");
    } else {
        // So would very large ones.
        let _ = write!(text, "{value:e}");
    }
}

/// Significant digits of a number in the name of a file.
const NAME_DIGITS: usize = 6;
/// As many tell any two numbers apart.
const ALL_DIGITS: usize = 17;

/// Numbers for names of files: six significant digits, and as many more as it takes to tell them apart.
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

/// A plain decimal with at most `decimals` places and one at the least, as DXF and SVG readers expect it: no exponent,
/// no negative zero.
#[must_use]
pub fn plain(value: f64, decimals: usize) -> String {
    let mut text = Vec::with_capacity(20);
    push_plain(&mut text, value, decimals);
    String::from_utf8(text).unwrap_or_default()
}

/// Adds the same to a text.
pub fn push_plain(text: &mut Vec<u8>, value: f64, decimals: usize) {
    push_rounded(text, value, decimals, 1);
}

/// The same with no decimal where none is needed: a whole number has no point.
pub(super) fn push_short(text: &mut Vec<u8>, value: f64, decimals: usize) {
    push_rounded(text, value, decimals, 0);
}

fn push_rounded(text: &mut Vec<u8>, value: f64, decimals: usize, least: u32) {
    if decimals > 0 && push_decimal(text, value, decimals, least) {
        return;
    }
    // What is no number, or has too many digits.
    let from = text.len();
    push_fixed(text, value, decimals);
    if decimals == 0 || !value.is_finite() {
        return;
    }
    let zeros = text.iter().rev().take(decimals - least as usize).take_while(|digit| **digit == b'0').count();
    text.truncate(text.len() - zeros);
    if text.ends_with(b".") {
        text.pop();
    }
    if matches!(text.get(from..), Some(b"-0.0" | b"-0")) {
        text.remove(from);
    }
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
        // As the standard library has it, but where two texts are as short and as near.
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
    fn names_are_short_and_told_apart() {
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
        assert_eq!(plain(120.0, 12), "120.0");
        assert_eq!(plain(-69.123_456_789_012_34, 12), "-69.123456789012");
    }

    /// The standard library rounds the exact value, ties to even.
    #[test]
    fn plain_is_rounded_as_the_standard_library_does() {
        let by_library = |value: f64, decimals: usize| {
            let fixed = format!("{value:.decimals$}");
            let trimmed = fixed.trim_end_matches('0');
            let one = if trimmed.ends_with('.') { format!("{trimmed}0") } else { trimmed.to_owned() };
            if one == "-0.0" { "0.0".into() } else { one }
        };
        let ties = (0..4000).map(|i| (f64::from(i) - 2000.0) / 1024.0);
        let ends = [0.0, -0.0, 5e-324, 1e-310, -4.9e-13, 5e-13, 0.5e-6, 1e15, 4_503_599_627_370_495.5, 1e17, 1e300];
        let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
        let random = (0..200_000).map(|_| {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from_bits((1023 - 60 + (bits >> 40) % 120) << 52 | bits & 0x800f_ffff_ffff_ffff)
        });
        for value in ties.chain(ends).chain(random) {
            for decimals in [1, 4, 6, 12] {
                assert_eq!(plain(value, decimals), by_library(value, decimals), "{value:e} {decimals}");
            }
        }
        assert_eq!((plain(f64::NAN, 6), plain(f64::NEG_INFINITY, 6)), ("NaN".into(), "-inf".into()));
    }
}

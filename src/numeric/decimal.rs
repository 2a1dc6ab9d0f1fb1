//! Decimal digits of numbers, as the standard library writes them, which takes several times as long.

use std::io::Write as _;

/// Most decimals that are written here: a size of a metre in mm then still has a whole number of them.
const MOST_DECIMALS: usize = 12;

/// Powers of ten, up to the most decimals that are written.
const POWERS: [u64; MOST_DECIMALS + 1] = {
    let mut powers = [1; MOST_DECIMALS + 1];
    let mut index = 1;
    while index < powers.len() {
        powers[index] = 10 * powers[index - 1];
        index += 1;
    }
    powers
};

/// A size times a power of ten as a whole number, exact but for its own rounding, ties to even; `None` where it does not fit.
///
/// A double is m/2ⁿ with m below 2⁵³, and the power below 2⁴⁰: their product is exact in 128 bits.
fn times(size: f64, power: u64) -> Option<u64> {
    const FRACTION: u64 = (1 << 52) - 1;
    const HALF: u128 = 1 << 127;
    let bits = size.to_bits();
    let exponent = (bits >> 52) as u32;
    // A number below the normal ones is none of the decimals.
    if exponent == 0 {
        return Some(0);
    }
    let product = u128::from((bits & FRACTION) | (FRACTION + 1)) * u128::from(power);
    let shift = 1075_u32.checked_sub(exponent).filter(|shift| *shift > 0)?;
    if shift < 64 {
        // Mostly what is cut off is less than a word; it stands from the highest bit down.
        #[expect(clippy::cast_possible_truncation, reason = "the word that is cut")]
        let rest = (product as u64) << (64 - shift);
        let whole = u64::try_from(product >> shift).ok()?;
        return Some(whole + u64::from(rest > 1 << 63) + (whole & u64::from(rest == 1 << 63)));
    }
    if shift > 100 {
        return Some(0);
    }
    let (whole, rest) = (product >> shift, product << (128 - shift));
    let up = rest > HALF || (rest == HALF && whole & 1 == 1);
    u64::try_from(whole + u128::from(up)).ok()
}

/// Digits that are made at once, a byte each in one word.
const AT_ONCE: u32 = 8;
/// Numbers below this have no more digits.
const ALL_AT_ONCE: u64 = 10_u64.pow(AT_ONCE);
/// The digit 0 in each of eight bytes.
const ZEROS: u64 = 0x3030_3030_3030_3030;

/// The eight digits of a number below 10⁸, the first in the lowest byte; no characters yet.
///
/// Halves of four digits, of two and of one are parted in one word, by products in place of quotients (Khuong, "How to print integers
/// really fast", 2017): x/100 is 10486 x/2²⁰ below 10⁴, x/10 is 103 x/2¹⁰ below 100.
fn eight_digits(value: u64) -> u64 {
    let fours = (value / 10_000) | ((value % 10_000) << 32);
    let hundreds = ((10_486 * fours) >> 20) & 0x0000_007f_0000_007f;
    let pairs = hundreds + ((fours - 100 * hundreds) << 16);
    let tens = ((103 * pairs) >> 10) & 0x000f_000f_000f_000f;
    tens + ((pairs - 10 * tens) << 8)
}

/// Digits of a word that are 0 before the first that is not.
fn leading(digits: u64) -> u32 {
    digits.trailing_zeros() / 8
}

/// Digits of a word up to the last that is not 0.
fn used(digits: u64) -> u32 {
    AT_ONCE - digits.leading_zeros() / 8
}

/// Adds the first bytes of a field: to write all of them takes less than to ask how many.
fn push_first<const SIZE: usize>(text: &mut Vec<u8>, field: [u8; SIZE], count: u32) {
    let from = text.len();
    text.extend_from_slice(&field);
    text.truncate(from + count as usize);
}

/// Adds a whole number to a text.
#[inline]
pub(crate) fn push_whole(text: &mut Vec<u8>, value: u64) {
    if value >= ALL_AT_ONCE {
        return push_large(text, value);
    }
    let digits = eight_digits(value);
    let skipped = leading(digits).min(AT_ONCE - 1);
    push_first(text, ((digits | ZEROS) >> (8 * skipped)).to_le_bytes(), AT_ONCE - skipped);
}

/// The same of one of more digits than are made at once.
#[cold]
fn push_large(text: &mut Vec<u8>, value: u64) {
    push_whole(text, value / ALL_AT_ONCE);
    text.extend_from_slice(&(eight_digits(value % ALL_AT_ONCE) | ZEROS).to_le_bytes());
}

/// Adds a whole number of the last of so many decimals, at most twelve: as many of them as are not 0 at its end, and at least so many.
fn push_parts(text: &mut Vec<u8>, parts: u64, decimals: usize, least: u32) {
    // Whole numbers of more digits do not stand in one field with point and decimals.
    const MOST: u64 = ALL_AT_ONCE / 10;
    let (Some(each), Some(rest)) = (POWERS.get(decimals), POWERS.get(MOST_DECIMALS - decimals)) else { return };
    let (whole, of_sixteen) = (parts / each, 10_000 * rest * (parts % each));
    let (first, second) = (eight_digits(of_sixteen / ALL_AT_ONCE), of_sixteen % ALL_AT_ONCE);
    let second = if second == 0 { 0 } else { eight_digits(second) };
    let shown = if second == 0 { used(first) } else { AT_ONCE + used(second) }.max(least);
    let (before, skipped) = if whole < MOST {
        let digits = eight_digits(whole) >> 8;
        (digits, leading(digits).min(AT_ONCE - 2))
    } else {
        push_whole(text, whole);
        (0, AT_ONCE - 1)
    };
    // Seven digits, the point, eight digits.
    let before = before | (ZEROS >> 8) | (u64::from(b'.') << 56);
    let field = u128::from(before) | (u128::from(first | ZEROS) << 64);
    let count = if shown == 0 { AT_ONCE - 1 } else { AT_ONCE + shown.min(AT_ONCE) };
    push_first(text, (field >> (8 * skipped)).to_le_bytes(), count - skipped);
    if shown > AT_ONCE {
        push_first(text, (second | ZEROS).to_le_bytes(), shown - AT_ONCE);
    }
}

/// Adds a number rounded to so many decimals to a text, without the zeros at its end but for so many decimals that it has at least, and
/// without the sign of a zero; `false` where it is none, or too large to be written so.
pub(crate) fn push_decimal(text: &mut Vec<u8>, value: f64, decimals: usize, least: u32) -> bool {
    let Some(parts) = POWERS.get(decimals).and_then(|power| times(value.abs(), *power)) else { return false };
    if value < 0.0 && parts > 0 {
        text.push(b'-');
    }
    push_parts(text, parts, decimals, least);
    true
}

/// Adds a number with so many decimals to a text, as `{value:.decimals$}`.
pub(crate) fn push_fixed(text: &mut Vec<u8>, value: f64, decimals: usize) {
    let Some(parts) = POWERS.get(decimals).and_then(|power| times(value.abs(), *power)) else {
        // A text in memory takes all that is written.
        let _ = write!(text, "{value:.decimals$}");
        return;
    };
    if value.is_sign_negative() {
        text.push(b'-');
    }
    push_parts(text, parts, decimals, u32::try_from(decimals).unwrap_or(0));
}

/// The same as a text of its own.
pub(crate) fn fixed(value: f64, decimals: usize) -> String {
    let mut text = Vec::with_capacity(24);
    push_fixed(&mut text, value, decimals);
    String::from_utf8(text).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The standard library rounds the exact value, ties to even.
    #[test]
    fn whole_numbers_have_all_their_digits() {
        let ends = [0, 9, 10, 99_999_999, 100_000_000, 100_000_001, 10_000_000_000_000_000, u64::MAX];
        let steps = (0..10_000).chain((0..100_000_000).step_by(7_919)).chain((0..u64::MAX).step_by(1 << 50));
        for value in ends.into_iter().chain(steps) {
            let mut text = Vec::new();
            push_whole(&mut text, value);
            assert_eq!(String::from_utf8(text), Ok(value.to_string()));
        }
    }

    #[test]
    fn fixed_is_what_the_standard_library_writes() {
        let ties = (0..4000).map(|i| (f64::from(i) - 2000.0) / 1024.0);
        let ends =
            [0.0, -0.0, 5e-324, -1e-310, 1e15, 4_503_599_627_370_495.5, 1e17, 1e300, f64::NAN, f64::NEG_INFINITY];
        let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
        let random = (0..20_000).map(|_| {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from_bits((1023 - 60 + (bits >> 40) % 120) << 52 | bits & 0x800f_ffff_ffff_ffff)
        });
        for value in ties.chain(ends).chain(random) {
            for decimals in [0, 1, 3, 6, 8, 9, 12, 15] {
                assert_eq!(fixed(value, decimals), format!("{value:.decimals$}"), "{value:e} {decimals}");
            }
        }
    }
}

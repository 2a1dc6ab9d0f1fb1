//! Decimal digits of numbers, as the standard library writes them, which takes several times as long.

use std::io::Write as _;

/// Powers of ten, up to the most decimals that are written.
const POWERS: [u64; 13] = {
    let mut powers = [1; 13];
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
    let exponent = u32::try_from(bits >> 52).ok()?;
    // A number below the normal ones is none of the decimals.
    if exponent == 0 {
        return Some(0);
    }
    let product = u128::from((bits & FRACTION) | (FRACTION + 1)) * u128::from(power);
    let shift = 1075_u32.checked_sub(exponent).filter(|shift| *shift > 0)?;
    if shift > 100 {
        return Some(0);
    }
    // What is cut off, from the highest bit down.
    let (whole, rest) = (product >> shift, product << (128 - shift));
    let up = rest > HALF || (rest == HALF && whole & 1 == 1);
    u64::try_from(whole + u128::from(up)).ok()
}

/// The digits of each number below a hundred.
const PAIRS: [[u8; 2]; 100] = {
    let mut pairs = [[b'0'; 2]; 100];
    let mut number: u8 = 0;
    while number < 100 {
        pairs[number as usize] = [b'0' + number / 10, b'0' + number % 10];
        number += 1;
    }
    pairs
};

/// Fills a field with the last digits of a whole number; what is left of it before them.
fn fill(field: &mut [u8], value: u64) -> u64 {
    let mut left = value;
    let mut pairs = field.rchunks_exact_mut(2);
    for slot in pairs.by_ref() {
        slot.copy_from_slice(PAIRS.get((left % 100) as usize).unwrap_or(&[b'0'; 2]));
        left /= 100;
    }
    for slot in pairs.into_remainder() {
        *slot = b'0' + (left % 10) as u8;
        left /= 10;
    }
    left
}

/// Puts a whole number at the end of a field, from its last digit to its first; where it begins.
fn put_whole(field: &mut [u8], value: u64) -> usize {
    let (mut from, mut left) = (field.len(), value);
    for slot in field.iter_mut().rev() {
        *slot = b'0' + (left % 10) as u8;
        (from, left) = (from - 1, left / 10);
        if left == 0 {
            break;
        }
    }
    from
}

/// Place of the decimal point: before it there is room for the digits of any `u64` and a sign.
const POINT: usize = 21;

/// Adds a whole number to a text.
pub(crate) fn push_whole(text: &mut Vec<u8>, value: u64) {
    let mut digits = [b'0'; POINT];
    let from = put_whole(&mut digits, value);
    text.extend_from_slice(digits.get(from..).unwrap_or_default());
}

/// Adds a number with so many decimals to a text, as `{value:.decimals$}`.
pub(crate) fn push_fixed(text: &mut Vec<u8>, value: f64, decimals: usize) {
    let Some(scaled) = POWERS.get(decimals).and_then(|power| times(value.abs(), *power)) else {
        // A text in memory takes all that is written.
        let _ = write!(text, "{value:.decimals$}");
        return;
    };
    let mut digits = [b'.'; POINT + POWERS.len()];
    let (whole, fraction) = digits.split_at_mut(POINT);
    let mut from = put_whole(whole, fill(fraction.get_mut(1..=decimals).unwrap_or_default(), scaled));
    if let Some(sign) = whole.get_mut(from - 1).filter(|_| value.is_sign_negative()) {
        *sign = b'-';
        from -= 1;
    }
    let to = if decimals > 0 { POINT + 1 + decimals } else { POINT };
    text.extend_from_slice(digits.get(from..to).unwrap_or_default());
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
            for decimals in [0, 1, 3, 6, 12, 15] {
                assert_eq!(fixed(value, decimals), format!("{value:.decimals$}"), "{value:e} {decimals}");
            }
        }
    }
}

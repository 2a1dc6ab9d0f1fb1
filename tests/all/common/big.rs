//! Numbers of 60 digits, and how far an `f64` is from one.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

/// The oracle's number.
pub(crate) type Big = FBig<HalfEven, 2>;

/// Bits of every number: 60 digits.
const BITS: usize = 200;

pub(crate) fn big(value: f64) -> Big {
    Big::try_from(value).expect("finite").with_precision(BITS).value()
}

pub(crate) fn number(value: &Big) -> f64 {
    value.to_f64().value()
}

pub(crate) fn ulp(value: f64) -> f64 {
    f64::from_bits(value.abs().to_bits() + 1) - value.abs()
}

//! Numbers rounded to the digits that people write.

/// The next number of three digits that is not larger; for a positive number.
#[must_use]
pub fn three_digits_down(value: f64) -> f64 {
    let digit = libm::pow(10.0, 2.0 - libm::log10(value).floor());
    (value * digit).floor() / digit
}

/// The next number of three digits that is not smaller; for a positive number.
#[must_use]
pub fn three_digits_up(value: f64) -> f64 {
    let digit = libm::pow(10.0, 2.0 - libm::log10(value).floor());
    (value * digit).ceil() / digit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_cut_off() {
        for (value, cut) in [(612.9, 612.0), (0.012_39, 0.0123), (13.244, 13.2), (7.0, 7.0)] {
            assert_eq!(three_digits_down(value), cut);
        }
        for (value, cut) in [(612.1, 613.0), (0.012_31, 0.0124), (13.244, 13.3), (7.0, 7.0)] {
            assert_eq!(three_digits_up(value), cut);
        }
    }
}

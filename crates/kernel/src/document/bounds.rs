//! The range a value may have.

/// The range a value may have, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    pub(super) low: f64,
    pub(super) low_included: bool,
    pub(super) high: f64,
}

/// Above the low end, up to and including the high one.
#[must_use]
pub const fn above(low: f64, high: f64) -> Bounds {
    Bounds { low, low_included: false, high }
}

/// From the low end to the high one, both included.
#[must_use]
pub const fn within(low: f64, high: f64) -> Bounds {
    Bounds { low, low_included: true, high }
}

/// A value that must be above 0 must be at least this share of the largest value: far below anything real, and far enough above the
/// smallest number that quotients and powers of such values stay finite.
const LEAST_SHARE: f64 = 1e-18;

impl Bounds {
    /// The low and the high end, in SI units.
    #[must_use]
    pub fn ends(self) -> (f64, f64) {
        (self.low, self.high)
    }

    /// The smallest value of a range above 0.
    fn least(self) -> Option<f64> {
        (self.low == 0.0 && !self.low_included && self.high.is_finite()).then_some(LEAST_SHARE * self.high)
    }

    /// Whether a value is in the range; a NaN never is.
    #[must_use]
    pub fn holds(self, value: f64) -> bool {
        let above = if self.low_included { value >= self.low } else { value > self.low };
        above && value <= self.high && self.least().is_none_or(|least| value >= least)
    }

    /// Which end is broken, in words: `above 0 mm`.
    pub(super) fn broken(self, value: f64, show: impl Fn(f64) -> String) -> String {
        if value > self.high {
            format!("at most {}", show(self.high))
        } else if let Some(least) = self.least().filter(|_| value > self.low) {
            format!("at least {}", show(least))
        } else if self.low_included {
            format!("at least {}", show(self.low))
        } else {
            format!("above {}", show(self.low))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_above_nothing_is_not_next_to_it() {
        let bounds = above(0.0, 1e3);
        assert!(bounds.holds(1e3) && bounds.holds(1e-15) && !bounds.holds(1e-16) && !bounds.holds(0.0));
        let broken = [1e4, 1e-300, 0.0, -1.0].map(|value| bounds.broken(value, |value| format!("{value:e}")));
        assert_eq!(broken, ["at most 1e3", "at least 1e-15", "above 0e0", "above 0e0"]);
        assert!(within(0.0, 1.0).holds(0.0) && within(0.0, 1.0).holds(1e-300) && !within(0.0, 1.0).holds(f64::NAN));
    }
}

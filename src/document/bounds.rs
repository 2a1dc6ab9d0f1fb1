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

impl Bounds {
    /// Whether a value is in the range; a NaN is in none.
    #[must_use]
    pub fn holds(self, value: f64) -> bool {
        value <= self.high && if self.low_included { value >= self.low } else { value > self.low }
    }

    /// Which end is broken, in words: `above 0 mm`.
    pub(super) fn broken(self, value: f64, show: impl Fn(f64) -> String) -> String {
        if value > self.high {
            format!("at most {}", show(self.high))
        } else if self.low_included {
            format!("at least {}", show(self.low))
        } else {
            format!("above {}", show(self.low))
        }
    }
}

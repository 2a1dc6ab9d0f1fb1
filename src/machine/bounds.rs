//! The range a value of the machine file may have.

/// What a value may be.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    pub(super) low: f64,
    low_included: bool,
    high: f64,
}

/// Above the low end, up to and including the high one.
pub(crate) const fn above(low: f64, high: f64) -> Bounds {
    Bounds { low, low_included: false, high }
}

/// From the low end to the high one, both included.
pub(crate) const fn within(low: f64, high: f64) -> Bounds {
    Bounds { low, low_included: true, high }
}

impl Bounds {
    pub(super) fn holds(self, value: f64) -> bool {
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

//! The worst case of a quantity, told as a line of the table that `tests/run` shows.

/// The worst of a quantity so far, and where.
pub(crate) struct Worst {
    name: &'static str,
    unit: &'static str,
    value: f64,
    place: String,
}

impl Worst {
    pub(crate) fn new(name: &'static str, unit: &'static str) -> Self {
        Self { name, unit, value: 0.0, place: String::new() }
    }

    pub(crate) fn see(&mut self, value: f64, place: impl FnOnce() -> String) {
        assert!(!value.is_nan(), "{}: not a number at {}", self.name, place());
        if value > self.value {
            (self.value, self.place) = (value, place());
        }
    }

    pub(crate) fn told(&self, bound: f64) {
        println!("{:<44} {:>10.3e} {:<14} {}", self.name, self.value, self.unit, self.place);
        assert!(self.value <= bound, "{}: {:e} at {}", self.name, self.value, self.place);
    }
}

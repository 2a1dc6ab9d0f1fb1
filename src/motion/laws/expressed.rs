//! A formula as the shape of a segment.

use super::curve::{Curve, Part, Values};
use crate::motion::formula::{Formula, Scan};

/// s(x) = unit · (f(width · x) less a number).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Expressed {
    formula: Formula,
    width: f64,
    less: f64,
    unit: f64,
}

impl Expressed {
    /// Value and three derivatives.
    pub(super) fn at(&self, x: f64) -> Values {
        let (unit, width) = (self.unit, self.width);
        let [value, first, second, third] = self.formula.at(width * x);
        [
            unit * (value - self.less),
            unit * width * first,
            unit * width * width * second,
            unit * width * width * width * third,
        ]
    }

    /// The derivative of an order.
    pub(super) fn derivative(&self, x: f64, order: u32) -> f64 {
        let value = self.formula.derivative(self.width * x, order) - if order == 0 { self.less } else { 0.0 };
        (0..order).fold(self.unit * value, |product, _| product * self.width)
    }
}

/// A formula in a unit whose variable runs from 0 to a width, less a number; cut into stretches by what a scan of it found.
#[must_use]
pub fn expressed(formula: Formula, width: f64, (unit, less): (f64, f64), scan: &Scan) -> Curve {
    let stretches = scan.turns.div_ceil(TURNS_EACH).clamp(1, MOST_STRETCHES);
    Curve::cut(&Part::Expressed(std::sync::Arc::new(Expressed { formula, width, less, unit })), stretches)
}

/// Extremes of a derivative that are told apart in a stretch.
const TURNS_EACH: u32 = 4;
const MOST_STRETCHES: u32 = 60;

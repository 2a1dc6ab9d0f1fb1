//! A formula as the shape of a segment.

use super::values::Values;
use crate::motion::formula::Formula;

/// s(x) = unit · (f(width · x) less a number).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FormulaShape {
    pub(super) formula: Formula,
    pub(super) width: f64,
    pub(super) less: f64,
    pub(super) unit: f64,
}

impl FormulaShape {
    /// Value and three derivatives.
    pub(super) fn values_at(&self, x: f64) -> Values {
        let (unit, width) = (self.unit, self.width);
        let [value, first, second, third] = self.formula.values_at(width * x);
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

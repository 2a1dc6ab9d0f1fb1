//! By how much a cam is cut higher than the law of the bottom, so that its follower keeps the law on a shaft that deflects.

use super::Jet;
use camgen_kernel::numeric::chebyshev_series::{ChebyshevSeries, SeriesGroup};

/// By how much the bottom is raised over a reversal, by the crank angle from its start, m.
#[derive(Debug, Clone, PartialEq)]
pub struct RaiseSeries {
    /// Value and first four derivatives.
    orders: SeriesGroup<5>,
}

impl RaiseSeries {
    /// From the series of its value.
    #[must_use]
    pub fn new(value: &ChebyshevSeries) -> Self {
        let first = value.derivative();
        let second = first.derivative();
        let third = second.derivative();
        let fourth = third.derivative();
        Self { orders: SeriesGroup::new([value, &first, &second, &third, &fourth]) }
    }

    /// Value and first four derivatives at a crank angle of the reversal, rad.
    #[must_use]
    pub fn at(&self, crank: f64) -> [f64; 5] {
        self.orders.values_at(crank)
    }

    /// As a jet by the crank angle.
    #[must_use]
    pub fn jet(&self, crank: f64) -> Jet {
        let [s, ds, dds, ddds, _] = self.at(crank);
        Jet { s, ds, dds, ddds }
    }
}

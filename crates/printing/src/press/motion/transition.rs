//! How the dwell and the reversal are joined: polynomials of the fifth degree.

/// The transition between the dwell and the reversal, once before it and mirrored after it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Transition {
    /// The law as in the paper; its slope may jump at the dwell.
    None,
    /// A ramp before the reversal that ends with the law's value, slope and curvature; the force balance stays exact.
    RunUp {
        /// Crank angle, rad.
        width: f64,
    },
    /// The corner rounded over half the width on either side; costs a residual force.
    Blend {
        /// Crank angle, rad.
        width: f64,
    },
}

/// A polynomial Σ cₙ tⁿ, n = 0…5, on t = (φ − start)/width in [0, 1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Quintic {
    start: f64,
    width: f64,
    coefficients: [f64; 6],
}

/// Value and first three derivatives by the crank angle.
pub(crate) type Derivatives = [f64; 4];

impl Quintic {
    /// The ramp that rises from a dwell and ends at `start + width` with the given value, slope and curvature.
    ///
    /// Its velocity is t³ (b + c t): the drop d = 0.4 v + |a|/20 (v, a: slope and curvature by t at its end) that the
    /// monotone quintic needs at least for a law that starts upwards. There the jerk is continuous at the dwell
    /// too. For a law that starts downwards the same d stays continuous, and the velocity changes sign once at most.
    pub(crate) fn run_up(start: f64, width: f64, end: Derivatives) -> Self {
        let (v, a) = (end[1] * width, end[2] * width * width);
        let (b, c) = (4.0 * v - a, a - 3.0 * v);
        let level = end[0] - (0.4 * v - a / 20.0);
        Self { start, width, coefficients: [level, 0.0, 0.0, 0.0, b / 4.0, c / 5.0] }
    }

    /// The piece from rest at `level` to the given value, slope and curvature at `start + width`.
    pub(crate) fn blend(start: f64, width: f64, level: f64, end: Derivatives) -> Self {
        let (s, v, a) = (end[0] - level, end[1] * width, end[2] * width * width);
        let coefficients =
            [level, 0.0, 0.0, 10.0 * s - 4.0 * v + 0.5 * a, -15.0 * s + 7.0 * v - a, 6.0 * s - 3.0 * v + 0.5 * a];
        Self { start, width, coefficients }
    }

    /// The level of the dwell it leaves.
    pub(crate) fn level(&self) -> f64 {
        self.coefficients[0]
    }

    /// Its fourth derivative.
    pub(crate) fn fourth(&self, angle: f64) -> f64 {
        let (t, n) = ((angle - self.start) / self.width, 1.0 / self.width);
        let [.., c4, c5] = self.coefficients;
        (120.0 * c5 * t + 24.0 * c4) * n * n * n * n
    }

    pub(crate) fn at(&self, angle: f64) -> Derivatives {
        let t = (angle - self.start) / self.width;
        let n = 1.0 / self.width;
        let [c0, c1, c2, c3, c4, c5] = self.coefficients;
        [
            ((((c5 * t + c4) * t + c3) * t + c2) * t + c1) * t + c0,
            ((((5.0 * c5 * t + 4.0 * c4) * t + 3.0 * c3) * t + 2.0 * c2) * t + c1) * n,
            (((20.0 * c5 * t + 12.0 * c4) * t + 6.0 * c3) * t + 2.0 * c2) * n * n,
            ((60.0 * c5 * t + 24.0 * c4) * t + 6.0 * c3) * n * n * n,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_met() {
        for end in [[0.0, 0.0, -1.3, 0.0], [0.2, 0.9, -2.0, 0.0], [0.0, -0.3, -1.0, 0.0]] {
            for quintic in [Quintic::run_up(-0.4, 0.3, end), Quintic::blend(-0.4, 0.3, 0.05, end)] {
                let first = quintic.at(-0.4);
                assert_eq!(first[0], quintic.level());
                assert!(first[1].abs() + first[2].abs() < 1e-15);
                let last = quintic.at(-0.1);
                for order in 0..3 {
                    assert!((last[order] - end[order]).abs() < 1e-13, "order {order}: {last:?}");
                }
            }
        }
    }

    #[test]
    fn the_run_up_is_monotone_and_its_acceleration_a_quarter() {
        let end = [0.0, 0.0, -1.0, 0.0];
        let quintic = Quintic::run_up(-1.0, 1.0, end);
        assert!((quintic.level() + 1.0 / 20.0).abs() < 1e-15);
        let mut peak = 0.0_f64;
        for i in 0..=1000 {
            let [_, v, a, _] = quintic.at(-1.0 + f64::from(i) / 1000.0);
            assert!(v >= 0.0);
            peak = peak.max(a);
        }
        assert!((peak - 0.25).abs() < 1e-6, "{peak}");
    }

    #[test]
    fn a_law_that_starts_downwards_has_one_turning_point_at_most() {
        for slope in [-1e-3, -0.05, -0.2, -0.26, -1.0] {
            let quintic = Quintic::run_up(-1.0, 1.0, [0.0, slope, -1.0, 0.0]);
            let signs: Vec<bool> = (1..1000).map(|i| quintic.at(-1.0 + f64::from(i) / 1000.0)[1] > 0.0).collect();
            assert!(signs.windows(2).filter(|w| w[0] != w[1]).count() <= 1, "{slope}");
        }
    }
}

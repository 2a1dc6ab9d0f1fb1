//! Air that expands on another exponent than that on which it was compressed, and the length of the column that levels both ways.
//!
//! On the way in p/p0 = w^(−κ1), on the way back C w^(−κ2), C = w_r^(κ2−κ1): one pressure at the dead point, two everywhere else. No bottom
//! balances both. The law `level` balances their mean,
//!
//! ```text
//! 2 (1 + u) = w^(−κ1) + C w^(−κ2),   w_r = Q^(−1/κ1),   Q = 1 + A r
//! ```
//!
//! and leaves h = ½ U (w^(−κ1) − C w^(−κ2)) on either way, with opposite signs: half of what a cam that is exact on the way in leaves on
//! the way back. With y = −ln w both sides have logarithms that are nearly straight, so that Newton's steps are few. At the start of the
//! reversal w is w0 < 1: the port shuts a lead e = L (1 − w0) before it.

use camgen_kernel::numeric::extremum;

/// Parts of the stroke in which the residual of a fixed bottom has at most one maximum, and maxima that are refined.
const CELLS: u32 = 64;
const HILLS: usize = 3;
/// Newton's steps end by themselves: the logarithm of a sum of exponentials is convex, and each step doubles the digits.
const NEWTON: u32 = 60;

/// The air of a loop, and its mean.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelAir {
    /// κ1, on the way in.
    pub compression: f64,
    /// κ2, on the way back.
    pub expansion: f64,
    /// ln C.
    link: f64,
    /// y at the start of the reversal, −ln w0.
    start: f64,
}

/// w at a load u, and its first four derivatives by u.
pub type LengthDerivatives = [f64; 5];

impl LevelAir {
    /// The air for the load A r at the end of the stroke; `None` where no lead closes the loop: w0 is not between w_r and 1.
    #[must_use]
    pub fn new(compression: f64, expansion: f64, end_load: f64) -> Option<Self> {
        let end = libm::log1p(end_load) / compression;
        let open = Self { compression, expansion, link: (compression - expansion) * end, start: 0.0 };
        let start = open.logarithm(0.0);
        (start > 0.0 && start < end).then_some(Self { start, ..open })
    }

    /// Pressure ratios in and back with the length w of the air.
    #[must_use]
    pub fn pressures(&self, length: f64) -> [f64; 2] {
        let y = -libm::log(length);
        [libm::exp(self.compression * y), libm::exp(self.link + self.expansion * y)]
    }

    /// What a fixed bottom, its column by (7), leaves in this air on the way back: the largest |u − (p/p0 − 1)| up to the load at the end of the
    /// stroke.
    #[must_use]
    pub fn left_by_fixed_bottom(&self, end_load: f64) -> f64 {
        let end = libm::exp(-libm::log1p(end_load) / self.compression);
        let worst = extremum::largest_of_hills(
            |share| {
                let [_, back] = self.pressures(1.0 - share * (1.0 - end));
                (share * end_load - (back - 1.0)).abs()
            },
            (0.0, 1.0),
            CELLS,
            HILLS,
            extremum::TO_ROUNDING,
        );
        worst.value
    }

    /// y = −ln w where the mean of the pressures balances a load u.
    fn logarithm(&self, load: f64) -> f64 {
        let goal = libm::log1p(load);
        // On the way in alone; the other pressure is the smaller one, so that y is a little more.
        let mut y = goal / self.compression;
        for _ in 0..NEWTON {
            let (one, other) = (self.compression * y, self.link + self.expansion * y);
            let ratio = libm::exp(other - one);
            let value = one + libm::log1p(0.5 * (ratio - 1.0)) - goal;
            let step = value * (1.0 + ratio) / (self.compression + self.expansion * ratio);
            y -= step;
            if step.abs() <= 2.0 * f64::EPSILON * y.abs() {
                break;
            }
        }
        y
    }

    /// w at a load u.
    #[must_use]
    pub fn length(&self, load: f64) -> f64 {
        libm::exp(-self.logarithm(load))
    }

    /// w0.
    #[must_use]
    pub fn start_length(&self) -> f64 {
        libm::exp(-self.start)
    }

    /// w − w0 at a load u, which is 0 at the start of the reversal.
    #[must_use]
    pub fn shorter(&self, load: f64) -> f64 {
        self.start_length() * libm::expm1(self.start - self.logarithm(load))
    }

    /// w with its derivatives by u, from S(y) = e^(κ1 y) + C e^(κ2 y) = 2 (1 + u), S_n its n-th derivative by y.
    #[must_use]
    pub fn derivatives(&self, load: f64) -> LengthDerivatives {
        let y = self.logarithm(load);
        let (one, other) = (libm::exp(self.compression * y), libm::exp(self.link + self.expansion * y));
        let [of_one, of_other] = [self.compression, self.expansion].map(|k| [k, k * k, k * k * k, k * k * (k * k)]);
        let [s1, s2, s3, s4] = [0, 1, 2, 3].map(|order: usize| one * of_one[order] + other * of_other[order]);
        let y1 = 2.0 / s1;
        let square = y1 * y1;
        let y2 = -s2 * square / s1;
        let y3 = -(s3 * square * y1 + 3.0 * s2 * y1 * y2) / s1;
        let y4 = -(s4 * square * square + 6.0 * s3 * square * y2 + s2 * (4.0 * y1 * y3 + 3.0 * y2 * y2)) / s1;
        let w = libm::exp(-y);
        [
            w,
            -w * y1,
            w * (square - y2),
            w * (-square * y1 + 3.0 * y1 * y2 - y3),
            w * (square * square - 6.0 * square * y2 + 4.0 * y1 * y3 + 3.0 * y2 * y2 - y4),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition itself, and each derivative against the difference quotient of the one before: of fourth order, so that 1e-3 leaves
    /// 1e-12 of the fifth derivative and rounding of 1e-13.
    #[test]
    fn the_mean_of_the_pressures_balances() {
        for (compression, expansion, end) in
            [(1.35, 1.40, 1.0), (1.35, 1.40, 4.0), (1.0, 3.0, 30.0), (1.2, 1.200_001, 0.1)]
        {
            let air = LevelAir::new(compression, expansion, end).expect("a lead");
            for share in [0.0, 0.01, 0.3, 0.7, 1.0] {
                let load = share * end;
                let [on_way_in, back] = air.pressures(air.length(load));
                assert!((0.5 * (on_way_in + back) / (1.0 + load) - 1.0).abs() < 4e-15, "{share} of {end}");
                assert!(on_way_in >= back * (1.0 - 1e-14));
                assert!((air.length(load) - air.start_length() - air.shorter(load)).abs() < 4e-16);
            }
            assert_eq!(air.shorter(0.0), 0.0);
            let (middle, h) = (0.5 * end, 1e-3 * (1.0 + end));
            let at = |steps: f64| air.derivatives(middle + steps * h);
            for order in 1..5 {
                let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|steps| at(steps)[order - 1]);
                let quotient = (a - d + 8.0 * (c - b)) / (12.0 * h);
                let exact = at(0.0)[order];
                assert!((quotient / exact - 1.0).abs() < 1e-8, "{order} of {end}: {quotient} {exact}");
            }
        }
    }

    #[test]
    fn without_a_loop_there_is_no_lead() {
        assert_eq!(LevelAir::new(1.35, 1.35, 1.0), None);
        assert_eq!(LevelAir::new(1.35, 1.30, 1.0), None);
    }
}

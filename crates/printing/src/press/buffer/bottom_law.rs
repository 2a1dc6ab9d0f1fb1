//! The law of the moving bottom: equations (10) and (12), in forms that keep every digit.
//!
//! The air force equals the inertia force at every overrun x when the bottom is at
//!
//! ```text
//! Δx = L (1 − (A x + 1)^(−1/k)) − (x + e)                                            (10), (12)
//! ```
//!
//! Written like that it loses all digits where its two terms cancel: at small x for every column, and once more at
//! x = r for a column that brings the bottom back. With u = A x, U = A r, p = 1/k, c = L A/k and
//!
//! ```text
//! g(u) = (1 − (1+u)^−p)/(p u) = 1 − (p+1)/2 u + (p+1)(p+2)/6 u² − …
//! ```
//!
//! the law is x [(c − 1) + c (g(u) − 1)] (without lead), where g − 1 has a series at small u and c − 1 is kept as a
//! number of its own: exactly 0 for the matched column, 1/g(U) − 1 for the column of (7). For the latter the law is
//! x (g(u) − g(U))/g(U), and the difference is taken with the factor U − u = A (r − x) in front.

use super::level_air::LevelAir;
use camgen_kernel::numeric::double::DoubleDouble;
use camgen_kernel::numeric::root;

/// The rule for the length of the air column at the start of compression.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ColumnRule {
    /// L = k/A: the law starts with slope 0.
    Matched,
    /// (7) with `h_a` = r: the bottom is back at 0 at x = r.
    Return,
    /// A given length, m.
    Length(f64),
}

/// Below this u the series of g is summed, above it the closed form is accurate: at 0.25 the closed form of g − 1
/// (about −0.2) has lost less than three bits, and the series needs 27 terms (each factor is below 1 for k ≥ 1).
pub(super) const SERIES_LIMIT: f64 = 0.25;

/// Beyond this u the two terms of the law as printed no longer cancel, and it has fewer roundings than x (g − 1).
const PRINTED_LIMIT: f64 = 4.0;

/// Up to this overrun, m, the law of a matched or returning column is computed to its last digit, whatever its size.
const START: f64 = 1e-3;

/// Share of the stroke from its end where a returning law is taken by its slope: the difference of its two terms would lose
/// 30 of the 104 bits and more, and the slope in the middle errs by the square of the share.
const NEAR_END: f64 = 1e-9;

/// Column by (7) or (14), m, for a net shortening `h_a` (m) and U = A r: `h_a`/(1 − (1+U)^(−1/k)).
#[must_use]
pub fn column_for(shortening: f64, end_loading: f64, exponent: f64) -> f64 {
    shortening / -libm::expm1(-libm::log1p(end_loading) / exponent)
}

/// g(u) − 1 for p = 1/k and u ≥ 0, to a few ulp at any u; p = 0 is the limit g = ln(1+u)/u.
pub(super) fn g_minus_one(u: f64, p: f64) -> f64 {
    AirFactors::at(u, p).less
}

/// Factors of the air at a loading u, each to a few ulp at any u: nothing cancels from one to the other.
#[derive(Debug, Clone, Copy, PartialEq)]
struct AirFactors {
    /// g(u) − 1.
    less: f64,
    /// (1+u)^−p − 1 = −p u g(u).
    shrinks: f64,
    /// (1+u)^−p.
    shrunk: f64,
}

impl AirFactors {
    fn at(u: f64, p: f64) -> Self {
        if u < SERIES_LIMIT {
            let less = series(u, p);
            let shrinks = -p * u * (1.0 + less);
            return Self { less, shrinks, shrunk: 1.0 + shrinks };
        }
        let log = libm::log1p(u);
        let shrinks = libm::expm1(-p * log);
        let shrunk = if shrinks > -0.5 { 1.0 + shrinks } else { libm::exp(-p * log) };
        Self { less: if p == 0.0 { log / u - 1.0 } else { -shrinks / (p * u) - 1.0 }, shrinks, shrunk }
    }
}

/// g(u) − 1 below [`SERIES_LIMIT`].
fn series(u: f64, p: f64) -> f64 {
    let (mut term, mut sum, mut n) = (1.0, 0.0, 1.0);
    loop {
        term *= -u * (p + n) / (n + 1.0);
        sum += term;
        // Written so that a NaN ends it too.
        if !(term.abs() > f64::EPSILON * 0.125 * sum.abs()) {
            return sum;
        }
        n += 1.0;
    }
}

/// g(u) − 1 with twice the digits.
///
/// With w = √(1+u) − 1 the law of squares, (1+u)^−p = ((1+w)^−p)², makes g(u) = g(w) (2 − p w g(w))/(2 + w), so that
/// g(u) − 1 = [2 (g(w) − 1) − w − p w g(w)²]/(2 + w). All three terms are negative: nothing cancels on the way down to where
/// the series is short.
fn g_minus_one_to_the_end(u: DoubleDouble, p: DoubleDouble) -> DoubleDouble {
    let (one, two) = (DoubleDouble::from(1.0), DoubleDouble::from(2.0));
    if u.high >= SERIES_LIMIT {
        let w = u / (one + (one + u).sqrt());
        let less = g_minus_one_to_the_end(w, p);
        let g = one + less;
        return (two * less - w - p * w * g * g) / (two + w);
    }
    let (mut term, mut sum, mut n) = (one, DoubleDouble::from(0.0), 1.0);
    loop {
        term = -term * u * (p + DoubleDouble::from(n)) / DoubleDouble::from(n + 1.0);
        sum = sum + term;
        // A term that adds nothing to 104 bits, 0 where u is 0; written so that a NaN ends it too.
        if !(term.high.abs() > 1e-32 * sum.high.abs()) {
            return sum;
        }
        n += 1.0;
    }
}

/// (g(u) − g(U))/(U − u) for 0 ≤ u ≤ U below [`SERIES_LIMIT`], by the series with the factor taken out term by term. It is
/// symmetric in both, and −g'(u) where they are one.
pub(super) fn g_divided_difference(u: f64, end: f64, p: f64) -> f64 {
    // complete = Σ U^j u^(n−1−j), the complete symmetric polynomial, by complete_n = U·complete_(n−1) + uⁿ⁻¹.
    let (mut coefficient, mut power, mut complete, mut sum, mut n) = (-1.0, 1.0, 1.0, 0.0, 1.0);
    loop {
        coefficient *= -(p + n) / (n + 1.0);
        let term = coefficient * complete;
        sum += term;
        // Written so that a NaN ends it too.
        if !(term.abs() > f64::EPSILON * 0.125 * sum.abs()) {
            return sum;
        }
        power *= u;
        complete = complete * end + power;
        n += 1.0;
    }
}

/// Δx and its derivatives by x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bottom {
    /// Δx, m; negative is away from the piston.
    pub value: f64,
    /// dΔx/dx.
    pub slope: f64,
    /// d²Δx/dx², 1/m.
    pub second: f64,
    /// d³Δx/dx³, 1/m².
    pub third: f64,
    /// d⁴Δx/dx⁴, 1/m³.
    pub fourth: f64,
}

/// The law for one machine, one speed and one column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BottomLaw {
    /// A, 1/m.
    pub loading: f64,
    /// Polytropic exponent k.
    pub exponent: f64,
    /// Whole overrun r, m.
    pub stroke: f64,
    /// Column L, m.
    pub column: f64,
    /// Lead e, m: piston travel in the cylinder before the reversal.
    pub lead: f64,
    /// c − 1, the slope of the law at x = 0.
    pub start_slope: f64,
    /// Air that expands on another exponent, where the law levels both ways.
    pub level: Option<LevelAir>,
    returns: bool,
    /// The air at the end of the stroke.
    end: AirFactors,
    /// g(U) − 1 with twice the digits, of a column that brings the bottom back.
    end_less: DoubleDouble,
}

impl BottomLaw {
    /// The law for loading A > 0 (1/m), exponent k ≥ 1, stroke r > 0 (m) and lead e ≥ 0 (m).
    #[must_use]
    pub fn new(loading: f64, exponent: f64, stroke: f64, column: ColumnRule, lead: f64) -> Self {
        let end = loading * stroke;
        let at_end = AirFactors::at(end, 1.0 / exponent);
        let (column_length, start_slope) = match column {
            ColumnRule::Matched => (exponent / loading, 0.0),
            ColumnRule::Return => {
                // c = 1/g(U). Near U = 0 c − 1 is small and has the digits of g − 1, far from it c is large and has L's.
                let length = column_for(stroke, end, exponent);
                let less = at_end.less;
                let start_slope =
                    if end < SERIES_LIMIT { -less / (1.0 + less) } else { length * loading / exponent - 1.0 };
                (length, start_slope)
            }
            ColumnRule::Length(length) => {
                let matched = exponent / loading;
                (length, (length - matched) / matched)
            }
        };
        let returns = column == ColumnRule::Return;
        let end_less = if returns {
            let whole = DoubleDouble::product(loading, stroke);
            g_minus_one_to_the_end(whole, DoubleDouble::from(1.0) / DoubleDouble::from(exponent))
        } else {
            DoubleDouble::from(0.0)
        };
        let column = column_length;
        Self { loading, exponent, stroke, column, lead, start_slope, level: None, returns, end: at_end, end_less }
    }

    /// The law that leaves half of a loop of the air on either way, Δx = L (1 − w) − x − e with e = L (1 − w0): the port shuts a lead e before
    /// the reversal, in which the bottom rests. `None` where there is no loop. The column `Matched` starts it with slope 0, `Return` brings the
    /// bottom back at the dead point.
    #[must_use]
    pub fn level(loading: f64, stroke: f64, column: ColumnRule, compression: f64, expansion: f64) -> Option<Self> {
        let air = LevelAir::new(compression, expansion, loading * stroke)?;
        let [start, first, ..] = air.derivatives(0.0);
        let matched = -1.0 / (loading * first);
        let (length, start_slope) = match column {
            ColumnRule::Matched => (matched, 0.0),
            ColumnRule::Return => {
                let length = stroke / -air.shorter(loading * stroke);
                (length, (length - matched) / matched)
            }
            ColumnRule::Length(length) => (length, (length - matched) / matched),
        };
        let law = Self::new(loading, compression, stroke, ColumnRule::Length(length), length * (1.0 - start));
        Some(Self { start_slope, level: Some(air), ..law })
    }

    /// Travel over which the bottom retreats before the piston in front of the reversal, m: the lead, in which nothing may be compressed.
    #[must_use]
    pub fn retreat(&self) -> f64 {
        if self.level.is_some() { 0.0 } else { self.lead }
    }

    /// Δx at overrun x in [0, r], m.
    ///
    /// Without lead: for `Matched` and `Return` rounded correctly up to 1 mm (but for ties), beyond it with a relative error
    /// of a few ulp; for a given length with an absolute error within 2 ulp of L in addition to the rounding of the result (which
    /// exceeds that where x is many times L).
    #[must_use]
    pub fn displacement(&self, x: f64) -> f64 {
        self.displacement_between(x, self.stroke - x)
    }

    /// Δx at overrun x, with y = r − x from the caller, who may know it more accurately than the subtraction gives it.
    #[must_use]
    pub fn displacement_between(&self, x: f64, y: f64) -> f64 {
        match &self.level {
            Some(air) => -self.column * air.shorter(self.loading * x) - x,
            None => self.displacement_with(x, y, || self.air(x)),
        }
    }

    /// The air at overrun x.
    fn air(&self, x: f64) -> AirFactors {
        AirFactors::at(self.loading * x, 1.0 / self.exponent)
    }

    /// Δx at overrun x, with the factors of the air computed only where they are needed.
    fn displacement_with(&self, x: f64, y: f64, air: impl FnOnce() -> AirFactors) -> f64 {
        if x <= START && self.lead == 0.0 && (self.start_slope == 0.0 || self.returns) {
            return self.start(x, y);
        }
        let u = self.loading * x;
        let without_lead = if self.returns {
            self.returning(x, y, u, air)
        } else if self.start_slope == 0.0 && u < PRINTED_LIMIT {
            x * air().less
        } else if u < SERIES_LIMIT {
            x * (self.start_slope + (1.0 + self.start_slope) * air().less)
        } else {
            -self.column * air().shrinks - x
        };
        without_lead - self.lead
    }

    /// The law of a matched or returning column with twice the digits: x (g(u) − 1), or x (g(u) − g(U))/g(U). In the later
    /// half of the stroke x is what y leaves of it.
    fn start(&self, x: f64, y: f64) -> f64 {
        let p = DoubleDouble::from(1.0) / DoubleDouble::from(self.exponent);
        let loading = DoubleDouble::from(self.loading);
        let x = if self.returns && y < x { DoubleDouble::sum(self.stroke, -y) } else { DoubleDouble::from(x) };
        let less = g_minus_one_to_the_end(loading * x, p);
        if !self.returns {
            return (x * less).high;
        }
        let one = DoubleDouble::from(1.0);
        if y <= NEAR_END * self.stroke {
            let middle = loading * DoubleDouble::sum(self.stroke, -0.5 * y);
            let g = one + g_minus_one_to_the_end(middle, p);
            // g' = ((1+u)^(−p−1) − g)/u, (1+u)^−p = 1 − p u g.
            let slope = ((one - p * middle * g) / (one + middle) - g) / middle;
            return -(x * loading * DoubleDouble::from(y) * slope / (one + self.end_less)).high;
        }
        (x * (less - self.end_less) / (one + self.end_less)).high
    }

    fn returning(&self, x: f64, y: f64, u: f64, air: impl FnOnce() -> AirFactors) -> f64 {
        let (end, p) = (self.loading * self.stroke, 1.0 / self.exponent);
        if end < SERIES_LIMIT {
            x * self.loading * y * g_divided_difference(u, end, p) * (1.0 + self.start_slope)
        } else if x < y && u > PRINTED_LIMIT {
            -self.column * air().shrinks - x
        } else if x < y {
            x * (air().less - self.end.less) * (1.0 + self.start_slope)
        } else {
            let shrunk = self.column * self.end.shrunk;
            y - shrunk * libm::expm1(p * libm::log1p(self.loading * y / (1.0 + u)))
        }
    }

    /// Δx and its first four derivatives by x, exact.
    #[must_use]
    pub fn bottom(&self, x: f64, y: f64) -> Bottom {
        let (p, a, u) = (1.0 / self.exponent, self.loading, self.loading * x);
        let c = 1.0 + self.start_slope;
        if let Some(air) = &self.level {
            let [_, first, second, third, fourth] = air.derivatives(u);
            let [_, start, ..] = air.derivatives(0.0);
            let scale = -self.column * a;
            return Bottom {
                value: self.displacement_between(x, y),
                slope: self.start_slope + c * ((first - start) / start),
                second: scale * a * second,
                third: scale * a * a * third,
                fourth: scale * a * a * a * fourth,
            };
        }
        let air = AirFactors::at(u, p);
        // (1+u)^(−p−1) and its distance from 1, whose two terms are of one sign.
        let (power, fall) = (air.shrunk / (1.0 + u), (air.shrinks - u) / (1.0 + u));
        let second = -c * a * (p + 1.0) * power / (1.0 + u);
        let third = -second * a * (p + 2.0) / (1.0 + u);
        Bottom {
            value: self.displacement_with(x, y, || air),
            slope: self.start_slope + c * fall,
            second,
            third,
            fourth: -third * a * (p + 3.0) / (1.0 + u),
        }
    }

    /// The Δx of largest size over the stroke: (x, Δx), both m.
    ///
    /// Δx has one stationary point at most, where c (1+A x)^(−p−1) = 1; otherwise the end of the stroke has it.
    #[must_use]
    pub fn largest_displacement(&self) -> (f64, f64) {
        if self.level.is_some() {
            let top = root::bracketed(|x| self.bottom(x, self.stroke - x).slope, 0.0, self.stroke, 0.0);
            return self.largest_of(&[0.0, top.unwrap_or(0.0), self.stroke]);
        }
        let p = 1.0 / self.exponent;
        let top = libm::expm1(libm::log1p(self.start_slope) / (p + 1.0)) / self.loading;
        self.largest_of(&[0.0, top.clamp(0.0, self.stroke), self.stroke])
    }

    /// The Δx of largest size at some overruns.
    fn largest_of(&self, places: &[f64]) -> (f64, f64) {
        let (mut at, mut largest) = (0.0, 0.0_f64);
        for &x in places {
            let displacement = self.displacement(x);
            if displacement.abs() > largest.abs() {
                (at, largest) = (x, displacement);
            }
        }
        (at, largest)
    }

    /// Pressure ratio p/p0 with the piston at x and the bottom at Δx, equation (8) with lead.
    #[must_use]
    pub fn pressure_ratio(&self, x: f64, displacement: f64) -> f64 {
        // As a distance from the exact law, where the ratio is 1 + A x, so that an exact bottom has an exact force.
        let away = displacement - self.displacement(x);
        (1.0 + self.loading * x) * libm::exp(-self.exponent * libm::log1p(-away / self.air_left(x)))
    }

    /// Length of the air where the forces balance at overrun x, m: L (1 + A x)^(−1/k).
    #[must_use]
    pub fn air_left(&self, x: f64) -> f64 {
        match &self.level {
            Some(air) => self.column * air.length(self.loading * x),
            None => self.column * self.air(x).shrunk,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reference(q: f64, column: ColumnRule) -> BottomLaw {
        BottomLaw::new((q - 1.0) / 0.18, 1.35, 0.18, column, 0.0)
    }

    /// Values at φ = 10°, 30°, 60° to twenty digits, from 50-digit arithmetic.
    #[test]
    fn golden_values() {
        let matched = [-4.079_160_952_276_448_7, -26.956_817_407_290_616, -65.967_446_120_940_684];
        let returning = [52.332_443_294_506_367, 53.915_048_932_392_011, 17.242_204_536_200_625];
        for (bottom_law, golden) in
            [(reference(2.0, ColumnRule::Matched), matched), (reference(5.0, ColumnRule::Return), returning)]
        {
            for (degrees, value) in [10.0_f64, 30.0, 60.0].into_iter().zip(golden) {
                let got = 1e3 * bottom_law.displacement(0.18 * libm::sin(degrees.to_radians()));
                assert!((got / value - 1.0).abs() < 1e-14, "{degrees}°: {got} is not {value}");
            }
        }
    }

    #[test]
    fn shape_of_the_two_columns() {
        let matched = reference(2.0, ColumnRule::Matched);
        assert_eq!(matched.displacement(0.0), 0.0);
        assert!((matched.column - 0.243).abs() < 1e-15);
        let (x, least) = matched.largest_displacement();
        assert_eq!(x, 0.18);
        assert!((least + 0.082_42).abs() < 5e-6, "{least}");

        let (x, value) = reference(5.0, ColumnRule::Return).largest_displacement();
        assert!((x - 0.0584).abs() < 5e-5 && (value - 0.0605).abs() < 5e-5, "{x} {value}");
        // The reference gives the place of the largest Δx at 2 at for the returning column too.
        assert!((reference(2.0, ColumnRule::Return).largest_displacement().1 - 0.026_94).abs() < 5e-6);
        assert_eq!(reference(5.0, ColumnRule::Return).displacement(0.18), 0.0);
    }

    /// The fourth derivative is the difference quotient of the third; its error is the sixth derivative times h²/6 and the
    /// rounding 1e-16/h.
    #[test]
    fn the_fourth_derivative_belongs_to_the_third() {
        let h = 1e-6;
        for column in [ColumnRule::Matched, ColumnRule::Return, ColumnRule::Length(0.3)] {
            let law = reference(2.0, column);
            for x in [0.01, 0.09, 0.17] {
                let third = |x: f64| law.bottom(x, 0.18 - x).third;
                let quotient = (third(x + h) - third(x - h)) / (2.0 * h);
                let fourth = law.bottom(x, 0.18 - x).fourth;
                assert!((fourth / quotient - 1.0).abs() < 1e-8, "{column:?} at {x}: {fourth} {quotient}");
            }
        }
    }

    /// Each derivative of a law that levels a loop is the difference quotient of the one before; the bottom starts at 0 and, under a returning
    /// column, ends there.
    #[test]
    fn derivatives_of_a_law_that_levels() {
        for column in [ColumnRule::Matched, ColumnRule::Return, ColumnRule::Length(0.3)] {
            let law = BottomLaw::level(1.0 / 0.18, 0.18, column, 1.35, 1.40).expect("a loop");
            let at = |x: f64| {
                let Bottom { value, slope, second, third, fourth } = law.bottom(x, 0.18 - x);
                [value, slope, second, third, fourth]
            };
            let h = 1e-4;
            for x in [0.001, 0.09, 0.179] {
                for order in 1..5 {
                    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|steps| at(x + steps * h)[order - 1]);
                    let (quotient, exact) = ((a - d + 8.0 * (c - b)) / (12.0 * h), at(x)[order]);
                    assert!(
                        (quotient - exact).abs() < 1e-8 * exact.abs().max(1.0),
                        "{column:?} {order} {x}: {quotient} {exact}"
                    );
                }
            }
            assert_eq!((law.displacement(0.0), law.retreat()), (0.0, 0.0));
            assert_eq!(at(0.0)[1], law.start_slope);
            let end = law.displacement(0.18);
            assert!(column != ColumnRule::Return || end.abs() < 1e-16, "{end}");
            let (_, largest) = law.largest_displacement();
            let scanned = (0..=1800).map(|i| law.displacement(1e-4 * f64::from(i)).abs()).fold(0.0, f64::max);
            assert!((largest.abs() - scanned).abs() < 1e-7, "{column:?}: {largest} {scanned}");
        }
    }

    /// The law must give the force it was made for, by equation (8) as printed.
    #[test]
    fn the_air_force_is_the_inertia_force() {
        for column in [ColumnRule::Matched, ColumnRule::Return, ColumnRule::Length(0.3)] {
            for lead in [0.0, 0.01] {
                let bottom_law = BottomLaw::new(1.0 / 0.18, 1.35, 0.18, column, lead);
                for i in 0..=36 {
                    let x = 0.18 * f64::from(i) / 36.0;
                    let moved = bottom_law.displacement(x);
                    let left = bottom_law.column - (x + lead) - moved;
                    let printed = libm::pow(bottom_law.column / left, bottom_law.exponent);
                    assert!((printed / (1.0 + bottom_law.loading * x) - 1.0).abs() < 4e-15, "{column:?} at {x}");
                    // A bottom 1 mm off, once by the printed equation and once by ours.
                    let off = libm::pow(bottom_law.column / (left - 1e-3), bottom_law.exponent);
                    assert!((bottom_law.pressure_ratio(x, moved + 1e-3) / off - 1.0).abs() < 4e-15);
                }
            }
        }
    }
}

//! Taylor's method for one ordinary differential equation y' = f(x, y), to any order.
//!
//! The right-hand side is a [`Tape`]: a list of operations on power series. The n-th coefficient of every operation
//! follows from the coefficients before it by a recurrence, so the series of the solution grows by one coefficient a
//! pass and all derivatives are exact (A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed., 2008, ch. 13). Order
//! and step for a tolerance are those of À. Jorba and M. Zou, "A software package for the numerical integration of
//! ODEs by means of high-order Taylor methods", Experimental Mathematics 14 (2005) 99–117. The series is its own dense
//! output.

/// A series on a tape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Term(usize);

#[derive(Debug, Clone, Copy)]
enum Operation {
    Constant(f64),
    Abscissa,
    State,
    Sum(Term, Term),
    Scaled(Term, f64),
    Product(Term, Term),
    Quotient(Term, Term),
    Root(Term),
    PowerLessOne(Term, f64),
    TimesAbscissa(Term),
    OverAbscissa(Term),
}

/// The right-hand side of an equation as operations on series.
#[derive(Debug, Clone, Default)]
pub struct Tape {
    operations: Vec<Operation>,
    /// Whether a series is kept one coefficient ahead: those that depend on x·(…) and are divided by x again.
    ahead: Vec<bool>,
    result: Option<Term>,
}

/// A power series about `centre`, valid from there to `end`.
#[derive(Debug, Clone, PartialEq)]
pub struct Expansion {
    /// Where it was expanded.
    pub centre: f64,
    /// Last argument it is used for.
    pub end: f64,
    /// Coefficients of the powers of x − centre.
    pub coefficients: Vec<f64>,
}

impl Tape {
    fn push(&mut self, operation: Operation, ahead: bool) -> Term {
        self.operations.push(operation);
        self.ahead.push(ahead);
        Term(self.operations.len() - 1)
    }

    fn is_ahead(&self, term: Term) -> bool {
        self.ahead.get(term.0).copied().unwrap_or(false)
    }

    /// A number.
    pub fn constant(&mut self, value: f64) -> Term {
        self.push(Operation::Constant(value), false)
    }

    /// x.
    pub fn abscissa(&mut self) -> Term {
        self.push(Operation::Abscissa, false)
    }

    /// y.
    pub fn state(&mut self) -> Term {
        self.push(Operation::State, false)
    }

    /// a + b.
    pub fn sum(&mut self, a: Term, b: Term) -> Term {
        self.push(Operation::Sum(a, b), false)
    }

    /// a times a number.
    pub fn scaled(&mut self, a: Term, factor: f64) -> Term {
        self.push(Operation::Scaled(a, factor), self.is_ahead(a))
    }

    /// a b.
    pub fn product(&mut self, a: Term, b: Term) -> Term {
        self.push(Operation::Product(a, b), false)
    }

    /// a/b.
    pub fn quotient(&mut self, a: Term, b: Term) -> Term {
        self.push(Operation::Quotient(a, b), false)
    }

    /// √a.
    pub fn root(&mut self, a: Term) -> Term {
        self.push(Operation::Root(a), false)
    }

    /// (1 − a)^(−k) − 1, with every digit of a small a.
    pub fn power_less_one(&mut self, a: Term, exponent: f64) -> Term {
        self.push(Operation::PowerLessOne(a, exponent), self.is_ahead(a))
    }

    /// x a, on a tape that is expanded about 0 only.
    pub fn times_abscissa(&mut self, a: Term) -> Term {
        self.push(Operation::TimesAbscissa(a), true)
    }

    /// a/x for an `a` made from [`Tape::times_abscissa`] that vanishes at x = 0.
    pub fn over_abscissa(&mut self, a: Term) -> Term {
        self.push(Operation::OverAbscissa(a), false)
    }

    /// Says which series is f.
    #[must_use]
    pub fn finish(mut self, result: Term) -> Self {
        self.result = Some(result);
        self
    }

    /// f(x, y).
    #[must_use]
    pub fn value(&self, x: f64, y: f64) -> f64 {
        let mut pass = Pass::new(self, x, 1);
        pass.extend(y);
        pass.result(0)
    }

    /// The solution through (x, y) up to the power `order`.
    #[must_use]
    pub fn expand(&self, x: f64, y: f64, order: usize) -> Expansion {
        let mut pass = Pass::new(self, x, order);
        let mut next = y;
        let mut coefficients = Vec::with_capacity(order + 1);
        coefficients.push(y);
        let mut power = 1.0;
        for n in 0..order {
            pass.extend(next);
            next = pass.result(n) / power;
            coefficients.push(next);
            power += 1.0;
        }
        Expansion { centre: x, end: x, coefficients }
    }

    /// The solution y = x w(x) of y' = f(x, w) through the origin, where f depends on w without x in front, with the
    /// slope w(0) that solves w(0) = f(0, w(0)). The series returned is y's.
    ///
    /// x w' = f − w, and fₙ is linear in wₙ with one factor ∂f/∂w for all n.
    #[must_use]
    pub fn expand_from_origin(&self, slope: f64, order: usize) -> Expansion {
        let mut pass = Pass::new(self, 0.0, order);
        pass.extend(slope);
        let mut coefficients = vec![0.0, slope];
        let mut sensitivity = None;
        let mut power = 2.0;
        for n in 1..order {
            pass.extend(0.0);
            let without = pass.result(n);
            pass.retract();
            let factor = *sensitivity.get_or_insert_with(|| {
                pass.extend(1.0);
                let with = pass.result(n);
                pass.retract();
                with - without
            });
            let next = without / (power - factor);
            pass.extend(next);
            coefficients.push(next);
            power += 1.0;
        }
        Expansion { centre: 0.0, end: 0.0, coefficients }
    }
}

/// The coefficients of every series while an expansion grows.
struct Pass<'a> {
    tape: &'a Tape,
    x: f64,
    series: Vec<Vec<f64>>,
}

impl<'a> Pass<'a> {
    fn new(tape: &'a Tape, x: f64, order: usize) -> Self {
        let series = tape.operations.iter().map(|_| Vec::with_capacity(order + 2)).collect();
        Self { tape, x, series }
    }

    fn of(&self, term: Term) -> &[f64] {
        self.series.get(term.0).map_or(&[], Vec::as_slice)
    }

    fn result(&self, n: usize) -> f64 {
        self.tape.result.and_then(|term| self.of(term).get(n)).copied().unwrap_or(f64::NAN)
    }

    /// Takes the last coefficient of every series back.
    fn retract(&mut self) {
        for series in &mut self.series {
            series.pop();
        }
    }

    /// Adds a coefficient to the state and to every series.
    fn extend(&mut self, state: f64) {
        for (index, (operation, ahead)) in self.tape.operations.iter().zip(&self.tape.ahead).enumerate() {
            let started = self.series.get(index).is_some_and(|series| !series.is_empty());
            let passes = if *ahead && !started { 2 } else { 1 };
            for _ in 0..passes {
                let next = self.coefficient(index, *operation, state);
                if let Some(series) = self.series.get_mut(index) {
                    series.push(next);
                }
            }
        }
    }

    fn coefficient(&self, index: usize, operation: Operation, state: f64) -> f64 {
        let own = self.series.get(index).map_or(&[][..], Vec::as_slice);
        let n = own.len();
        let at = |term: Term, n: usize| self.of(term).get(n).copied().unwrap_or(0.0);
        match operation {
            Operation::Constant(value) => {
                if n == 0 {
                    value
                } else {
                    0.0
                }
            }
            Operation::Abscissa => match n {
                0 => self.x,
                1 => 1.0,
                _ => 0.0,
            },
            Operation::State => state,
            Operation::Sum(a, b) => at(a, n) + at(b, n),
            Operation::Scaled(a, factor) => factor * at(a, n),
            Operation::Product(a, b) => {
                let (a, b) = (self.of(a), self.of(b));
                let b = b.get(..=n).unwrap_or(b);
                a.iter().zip(b.iter().rev()).map(|(a, b)| a * b).sum()
            }
            Operation::Quotient(a, b) => {
                let rest: f64 = self.of(b).iter().skip(1).zip(own.iter().rev()).map(|(b, c)| b * c).sum();
                (at(a, n) - rest) / at(b, 0)
            }
            Operation::Root(a) => {
                let Some(first) = own.first() else { return at(a, 0).sqrt() };
                let inner = own.get(1..).unwrap_or_default();
                let rest: f64 = inner.iter().zip(inner.iter().rev()).map(|(b, c)| b * c).sum();
                (at(a, n) - rest) / (2.0 * first)
            }
            Operation::PowerLessOne(a, exponent) => power_less_one(self.of(a), own, exponent),
            Operation::TimesAbscissa(a) => {
                if n == 0 {
                    0.0
                } else {
                    at(a, n - 1)
                }
            }
            Operation::OverAbscissa(a) => at(a, n + 1),
        }
    }
}

/// The next coefficient of P = (1 − a)^(−k) − 1: with E = 1 + P, n (1 − a₀) Eₙ = Σ (k j + n − j) aⱼ Eₙ₋ⱼ, j = 1…n.
#[expect(clippy::cast_precision_loss, reason = "orders are small")]
fn power_less_one(a: &[f64], own: &[f64], exponent: f64) -> f64 {
    let first = a.first().copied().unwrap_or(f64::NAN);
    let n = own.len();
    let Some(power) = own.first() else { return libm::expm1(-exponent * libm::log1p(-first)) };
    let term = |(j, a): (usize, &f64)| {
        let before = own.get(n - j).copied().unwrap_or(0.0);
        let before = if n == j { 1.0 + power } else { before };
        (exponent * j as f64 + (n - j) as f64) * a * before
    };
    let sum: f64 = a.iter().enumerate().take(n + 1).skip(1).map(term).sum();
    sum / (n as f64 * (1.0 - first))
}

impl Expansion {
    /// Value and first three derivatives.
    #[must_use]
    pub fn at(&self, x: f64) -> [f64; 4] {
        let t = x - self.centre;
        let (mut value, mut first, mut second, mut third) = (0.0, 0.0, 0.0, 0.0);
        for coefficient in self.coefficients.iter().rev() {
            third = third * t + second;
            second = second * t + first;
            first = first * t + value;
            value = value * t + coefficient;
        }
        [value, first, 2.0 * second, 6.0 * third]
    }

    /// The value alone.
    #[must_use]
    pub fn value(&self, x: f64) -> f64 {
        let t = x - self.centre;
        self.coefficients.iter().rev().fold(0.0, |value, coefficient| value * t + coefficient)
    }

    /// How far from the centre the last three terms, each times its power, stay below `tolerance`: there the value is
    /// off by about that and its slope by that over the step. Infinite for a polynomial of lower degree; NaN when a
    /// coefficient is not a number.
    #[must_use]
    pub fn reach(&self, tolerance: f64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "orders are small")]
        let step = |(power, coefficient): (usize, &f64)| {
            let power = power as f64;
            libm::pow(tolerance / (power * coefficient.abs()), 1.0 / power)
        };
        if self.coefficients.iter().any(|coefficient| !coefficient.is_finite()) {
            return f64::NAN;
        }
        self.coefficients.iter().enumerate().skip(1).rev().take(3).map(step).fold(f64::INFINITY, f64::min)
    }
}

/// Least order: below, coarse tolerances need more steps than a higher order costs.
const LEAST_ORDER: f64 = 8.0;
const LARGEST_ORDER: f64 = 30.0;

/// The order that costs least for a tolerance relative to the size of the solution: −ln(tolerance)/2, and four for the
/// factor of the power in [`Expansion::reach`].
#[must_use]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
pub fn order(tolerance: f64) -> usize {
    (4.0 - 0.5 * libm::log(tolerance)).ceil().clamp(LEAST_ORDER, LARGEST_ORDER) as usize
}

#[cfg(test)]
mod tests;

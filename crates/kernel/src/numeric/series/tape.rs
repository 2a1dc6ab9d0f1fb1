//! Operations on power series in the order in which they are done, recorded at run time.

pub use super::functions::ElementaryFunction;

use super::functions::{coefficient, fill, quotient};
use super::product;
use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Range, Sub};

/// A result on a tape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TapeTerm(usize);

/// One operation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TapeOperation {
    /// A number.
    Constant(f64),
    /// x.
    Abscissa,
    /// y of a differential equation.
    State,
    /// a + b.
    Sum(TapeTerm, TapeTerm),
    /// a − b.
    Difference(TapeTerm, TapeTerm),
    /// a b.
    Product(TapeTerm, TapeTerm),
    /// a/b.
    Quotient(TapeTerm, TapeTerm),
    /// A function of one argument.
    Of(ElementaryFunction, TapeTerm),
}

impl TapeOperation {
    /// The terms it is made of.
    #[must_use]
    pub fn arguments(self) -> [Option<TapeTerm>; 2] {
        match self {
            Self::Constant(_) | Self::Abscissa | Self::State => [None, None],
            Self::Of(_, a) => [Some(a), None],
            Self::Sum(a, b) | Self::Difference(a, b) | Self::Product(a, b) | Self::Quotient(a, b) => [Some(a), Some(b)],
        }
    }
}

/// A function as operations.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tape {
    /// Each after those it is made of.
    pub operations: Vec<TapeOperation>,
    /// The operation that gives the function.
    pub result: Option<TapeTerm>,
}

/// A result on a tape that is being recorded, with the operators of numbers.
#[derive(Debug, Clone, Copy)]
pub struct TapeNumber<'t> {
    tape: &'t RefCell<Tape>,
    term: TapeTerm,
}

impl Tape {
    /// A function of x and y.
    pub fn recorded(function: impl for<'t> FnOnce(TapeNumber<'t>, TapeNumber<'t>) -> TapeNumber<'t>) -> Self {
        let tape = RefCell::default();
        let [x, y] = [TapeOperation::Abscissa, TapeOperation::State]
            .map(|operation| TapeNumber { tape: &tape, term: tape.borrow_mut().push(operation) });
        let result = function(x, y).term;
        Self { result: Some(result), ..tape.into_inner() }
    }

    /// Adds an operation.
    pub fn push(&mut self, operation: TapeOperation) -> TapeTerm {
        self.operations.push(operation);
        TapeTerm(self.operations.len() - 1)
    }

    /// The value of a term, where it is a constant.
    #[must_use]
    pub fn constant(&self, term: TapeTerm) -> Option<f64> {
        match self.operations.get(term.0)? {
            TapeOperation::Constant(value) => Some(*value),
            _ => None,
        }
    }

    /// The series of every operation of a function of x alone about a place, with this many coefficients.
    #[must_use]
    pub fn rows(&self, place: f64, count: usize) -> SeriesRows<'_> {
        let mut rows = SeriesRows::new(self, place, count);
        rows.extend(0..count, f64::NAN);
        rows
    }
}

impl TapeNumber<'_> {
    fn push(self, operation: TapeOperation) -> Self {
        Self { term: self.tape.borrow_mut().push(operation), ..self }
    }

    /// A number.
    #[must_use]
    pub fn constant(self, value: f64) -> Self {
        self.push(TapeOperation::Constant(value))
    }

    /// A function of it.
    #[must_use]
    pub fn apply(self, function: ElementaryFunction) -> Self {
        self.push(TapeOperation::Of(function, self.term))
    }
}

impl Add for TapeNumber<'_> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.push(TapeOperation::Sum(self.term, other.term))
    }
}

impl Sub for TapeNumber<'_> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.push(TapeOperation::Difference(self.term, other.term))
    }
}

impl Mul for TapeNumber<'_> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.push(TapeOperation::Product(self.term, other.term))
    }
}

impl Div for TapeNumber<'_> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.push(TapeOperation::Quotient(self.term, other.term))
    }
}

impl Add<f64> for TapeNumber<'_> {
    type Output = Self;
    fn add(self, number: f64) -> Self {
        self + self.constant(number)
    }
}

impl Mul<f64> for TapeNumber<'_> {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        self.apply(ElementaryFunction::Scaled(factor))
    }
}

/// The series of every operation on a tape, about a place.
#[derive(Debug, Clone)]
pub struct SeriesRows<'t> {
    tape: &'t Tape,
    place: f64,
    /// Coefficients of a series.
    count: usize,
    all: Vec<f64>,
}

impl<'t> SeriesRows<'t> {
    pub(super) fn new(tape: &'t Tape, place: f64, count: usize) -> Self {
        Self { tape, place, count, all: vec![0.0; tape.operations.len() * count] }
    }

    /// Computes the coefficients in a range of every series from those before it; `state` is y there.
    pub(super) fn extend(&mut self, range: Range<usize>, state: f64) {
        let (count, from) = (self.count, range.start);
        for (index, operation) in self.tape.operations.iter().enumerate() {
            let (done, rest) = self.all.split_at_mut(index * count);
            let Some(out) = rest.get_mut(..range.end) else { return };
            let row = |term: TapeTerm| done.get(term.0 * count..term.0 * count + range.end).unwrap_or_default();
            match *operation {
                TapeOperation::Constant(value) => fill(out, from, |n, _| if n == 0 { value } else { 0.0 }),
                TapeOperation::Abscissa => fill(out, from, |n, _| [self.place, 1.0].get(n).copied().unwrap_or(0.0)),
                TapeOperation::State => fill(out, from, |_, _| state),
                TapeOperation::Sum(a, b) => fill(out, from, |n, _| coefficient(row(a), n) + coefficient(row(b), n)),
                TapeOperation::Difference(a, b) => {
                    fill(out, from, |n, _| coefficient(row(a), n) - coefficient(row(b), n));
                }
                TapeOperation::Product(a, b) => fill(out, from, |n, _| product(row(a), row(b), n)),
                TapeOperation::Quotient(a, b) => quotient(row(a), row(b), out, from),
                TapeOperation::Of(function, a) => function.extend(row(a), out, from),
            }
        }
    }

    /// The n-th coefficient of the function where y has this n-th one and those before it unchanged.
    pub(super) fn next(&mut self, n: usize, state: f64) -> f64 {
        self.extend(n..n + 1, state);
        self.result().get(n).copied().unwrap_or(f64::NAN)
    }

    /// The series of an operation.
    #[must_use]
    pub fn series(&self, term: TapeTerm) -> &[f64] {
        self.all.get(term.0 * self.count..(term.0 + 1) * self.count).unwrap_or_default()
    }

    /// The series of the function.
    #[must_use]
    pub fn result(&self) -> &[f64] {
        self.tape.result.map_or(&[], |term| self.series(term))
    }

    /// The series of all operations, in their order.
    pub fn iter(&self) -> impl Iterator<Item = &[f64]> {
        self.all.chunks(self.count)
    }
}

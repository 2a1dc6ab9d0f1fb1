//! The operations of a formula in the order in which they are done.

use crate::numeric::power_series as series;

/// A result on a tape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Term(usize);

/// A function of one argument.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Function {
    Sine,
    Cosine,
    Tangent,
    ArcSine,
    ArcCosine,
    ArcTangent,
    Exponential,
    Logarithm,
    /// To a constant power that is not whole.
    Power(f64),
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Operation {
    Constant(f64),
    Variable,
    Sum(Term, Term),
    Difference(Term, Term),
    Product(Term, Term),
    Quotient(Term, Term),
    Of(Function, Term),
}

impl Operation {
    pub(super) fn arguments(self) -> [Option<Term>; 2] {
        match self {
            Operation::Constant(_) | Operation::Variable => [None, None],
            Operation::Of(_, a) => [Some(a), None],
            Operation::Sum(a, b)
            | Operation::Difference(a, b)
            | Operation::Product(a, b)
            | Operation::Quotient(a, b) => [Some(a), Some(b)],
        }
    }
}

/// An operation with the character of the text at which it stands, from 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placed {
    pub(super) operation: Operation,
    pub(super) at: usize,
}

/// A formula as operations.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Tape {
    pub(super) operations: Vec<Placed>,
    /// Its value.
    pub(super) result: Option<Term>,
}

impl Tape {
    /// Puts an operation behind the others.
    pub(super) fn push(&mut self, operation: Operation, at: usize) -> Term {
        self.operations.push(Placed { operation, at });
        Term(self.operations.len() - 1)
    }

    /// The value of a term, where it is a constant.
    pub(super) fn constant(&self, term: Term) -> Option<f64> {
        match self.operations.get(term.0)?.operation {
            Operation::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// The series of every operation about a place, so many coefficients each, one row behind the other.
    pub(super) fn rows(&self, place: f64, count: usize) -> Vec<f64> {
        let mut rows = vec![0.0; self.operations.len() * count];
        let mut other = vec![0.0; count];
        for (index, placed) in self.operations.iter().enumerate() {
            let (done, rest) = rows.split_at_mut(index * count);
            let Some(out) = rest.get_mut(..count) else { break };
            let row = |term: Term| row_of(done, term, count);
            match placed.operation {
                Operation::Constant(value) => begin(out, &[value]),
                Operation::Variable => begin(out, &[place, 1.0]),
                Operation::Sum(a, b) => each(out, row(a), row(b), |a, b| a + b),
                Operation::Difference(a, b) => each(out, row(a), row(b), |a, b| a - b),
                Operation::Product(a, b) => series::product(row(a), row(b), out),
                Operation::Quotient(a, b) => series::quotient(row(a), row(b), out),
                Operation::Of(Function::Sine, a) => series::sine_cosine(row(a), out, &mut other),
                Operation::Of(Function::Cosine, a) => series::sine_cosine(row(a), &mut other, out),
                Operation::Of(Function::Tangent, a) => series::tangent(row(a), out),
                Operation::Of(Function::ArcSine, a) => series::arc_sine(row(a), out),
                Operation::Of(Function::ArcCosine, a) => series::arc_cosine(row(a), out),
                Operation::Of(Function::ArcTangent, a) => series::arc_tangent(row(a), out),
                Operation::Of(Function::Exponential, a) => series::exponential(row(a), out),
                Operation::Of(Function::Logarithm, a) => series::logarithm(row(a), out),
                Operation::Of(Function::Power(exponent), a) => series::power(row(a), exponent, out),
            }
        }
        rows
    }

    /// The series of the formula itself.
    pub(super) fn result<'r>(&self, rows: &'r [f64], count: usize) -> &'r [f64] {
        self.result.map_or(&[], |term| row_of(rows, term, count))
    }
}

/// The series of a term among rows of so many coefficients.
pub(super) fn row_of(rows: &[f64], term: Term, count: usize) -> &[f64] {
    rows.get(term.0 * count..(term.0 + 1) * count).unwrap_or_default()
}

fn begin(out: &mut [f64], first: &[f64]) {
    for (slot, value) in out.iter_mut().zip(first) {
        *slot = *value;
    }
}

fn each(out: &mut [f64], a: &[f64], b: &[f64], f: impl Fn(f64, f64) -> f64) {
    for (slot, (a, b)) in out.iter_mut().zip(a.iter().zip(b)) {
        *slot = f(*a, *b);
    }
}

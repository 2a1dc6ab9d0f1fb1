//! A formula of one variable as a user types it, `20*(1-cos(th))/2`, with exact derivatives of every order.
//!
//! The text becomes a tape of operations (`parse`), which is evaluated on power series: the n-th coefficient at a place is the n-th
//! derivative there over n!. Where a formula has no value, or no derivative up to the jerk, is found when it is read (`scan`).

mod parse;
mod scan;
mod tape;

pub use scan::{Scan, Singular};

use tape::Tape;

/// Longest text, in characters.
pub const LONGEST: usize = 4096;

/// What is wrong with the text of a formula.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("character {at}: {message}")]
pub struct FormulaError {
    /// Which character, from 1.
    pub at: usize,
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub help: Option<String>,
}

/// A formula that reads.
#[derive(Debug, Clone, PartialEq)]
pub struct Formula {
    variable: String,
    tape: Tape,
}

impl Formula {
    /// Reads a formula of one variable.
    ///
    /// # Errors
    /// The first character that does not fit, and why.
    pub fn parse(text: &str, variable: &str) -> Result<Self, FormulaError> {
        Ok(Self { variable: variable.to_owned(), tape: parse::parse(text, variable)? })
    }

    /// What its variable is called.
    #[must_use]
    pub fn variable(&self) -> &str {
        &self.variable
    }

    /// Value and three derivatives.
    #[must_use]
    pub fn at(&self, place: f64) -> [f64; 4] {
        let rows = self.tape.rows(place, 4);
        let [value, first, second, third] =
            [0, 1, 2, 3].map(|n| self.tape.result(&rows, 4).get(n).copied().unwrap_or(f64::NAN));
        [value, first, 2.0 * second, 6.0 * third]
    }

    /// The derivative of an order.
    #[must_use]
    pub fn derivative(&self, place: f64, order: u32) -> f64 {
        let count = usize::try_from(order).unwrap_or(0) + 1;
        let rows = self.tape.rows(place, count);
        let coefficient = self.tape.result(&rows, count).last().copied().unwrap_or(f64::NAN);
        (1..=order).fold(coefficient, |product, factor| product * f64::from(factor))
    }

    /// Looks for places on [low, high] where the formula has no value or no derivative up to the third.
    ///
    /// # Errors
    /// The first such place, and what happens there.
    pub fn scanned(&self, low: f64, high: f64) -> Result<Scan, Singular> {
        scan::scan(&self.tape, low, high)
    }
}

#[cfg(test)]
mod tests;

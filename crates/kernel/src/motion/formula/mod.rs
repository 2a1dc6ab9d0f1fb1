//! A formula of one variable as a user types it, `20*(1-cos(th))/2`, with exact derivatives of every order.
//!
//! The text becomes a tape of operations (`parse`), which is evaluated on power series: the n-th coefficient at a place is the n-th
//! derivative there over n!. Places without a value, or without a derivative up to the jerk, are found when the formula is read (`scan`).

mod parse;
mod scan;

pub use scan::{Scan, Singularity};

use crate::numeric::series::tape::Tape;

/// Longest text, in characters.
pub const LONGEST: usize = 4096;

/// A fault in the text of a formula.
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

/// A formula that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Formula {
    variable: String,
    text: FormulaTape,
}

/// The operations of a text.
#[derive(Debug, Clone, PartialEq, Default)]
struct FormulaTape {
    tape: Tape,
    /// The character of each operation, from 1.
    characters: Vec<usize>,
}

impl Formula {
    /// Reads a formula of one variable.
    ///
    /// # Errors
    /// The first character that does not fit, and why.
    pub fn parse(text: &str, variable: &str) -> Result<Self, FormulaError> {
        Ok(Self { variable: variable.to_owned(), text: parse::parse(text, variable)? })
    }

    /// The name of its variable.
    #[must_use]
    pub fn variable(&self) -> &str {
        &self.variable
    }

    /// Value and three derivatives.
    #[must_use]
    pub fn values_at(&self, place: f64) -> [f64; 4] {
        let rows = self.text.tape.rows(place, 4);
        let [value, first, second, third] = [0, 1, 2, 3].map(|n| rows.result().get(n).copied().unwrap_or(f64::NAN));
        [value, first, 2.0 * second, 6.0 * third]
    }

    /// The derivative of an order.
    #[must_use]
    pub fn derivative(&self, place: f64, order: u32) -> f64 {
        let count = usize::try_from(order).unwrap_or(0) + 1;
        let coefficient = self.text.tape.rows(place, count).result().last().copied().unwrap_or(f64::NAN);
        (1..=order).fold(coefficient, |product, factor| product * f64::from(factor))
    }

    /// Looks for places on [low, high] where the formula has no value or no derivative up to the third.
    ///
    /// # Errors
    /// The first such place, and what happens there.
    pub fn scanned(&self, low: f64, high: f64) -> Result<Scan, Singularity> {
        scan::scan(&self.text, low, high)
    }
}

#[cfg(test)]
mod tests;

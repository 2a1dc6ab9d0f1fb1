//! Why a shaft is refused or has no answer, with what would pass.

use super::MOST_RATIO;
use camgen_kernel::refusal::Refusal;

/// Why a shaft is refused, or a query about it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShaftError {
    /// A massless shaft has only the modes its discs make; a thin disc in forward whirl has none by turning.
    #[error("the shaft has {exist} critical speed{}: number {asked} does not exist", if *exist == 1 { "" } else { "s" })]
    NoSuchMode {
        /// The requested number, from 1.
        asked: usize,
        /// How many there are.
        exist: usize,
    },
    /// Its digits are gone: the relative error of 1/ω_j² is about ε (ω_j/ω_1)².
    #[error("critical speed {mode} is more than {MOST_RATIO} times the first: it is lost in rounding; ask for {} at most", mode - 1)]
    ModeTooHigh {
        /// The first that is too high, from 1.
        mode: usize,
    },
    /// Of any other cause. Parts are counted from 1.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

impl From<ShaftError> for Refusal {
    fn from(error: ShaftError) -> Self {
        match error {
            ShaftError::Refused(refusal) => refusal,
            other => Self::of(other),
        }
    }
}

/// That a massless shaft has no disc that can move.
pub(super) fn without_mass() -> Refusal {
    Refusal::new("the shaft has no mass that can move")
        .remedy("give it a density above 0, or a disc away from the rigid supports")
}

/// Refuses values beyond the floating-point range.
pub(super) fn out_of_range() -> Refusal {
    Refusal::new("the numbers of the shaft leave the range of the arithmetic").remedy("check its units")
}

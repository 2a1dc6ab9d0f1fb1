//! Why a drive-speed law does not exist, and the changes with which it would.

use camgen_kernel::refusal::Refusal;

/// Each alone closes the machine, the other two as given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosingRemedies {
    /// Bore of each cylinder, m.
    pub bore: f64,
    /// Air column L, m; `None` where no column does that is longer than the stroke by more than rounding.
    pub column: Option<f64>,
    /// Ambient pressure, Pa, absolute.
    pub ambient_pressure: f64,
}

/// With as many digits as it takes to close within [`super::CLOSING`] when they are typed.
impl std::fmt::Display for ClosingRemedies {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "a bore of {:.10} mm of each cylinder closes it, or ", 1e3 * self.bore)?;
        match self.column {
            Some(column) => write!(f, "an air column of {:.10} mm", 1e3 * column)?,
            None => write!(f, "no column longer than the stroke does")?,
        }
        write!(f, ", or an ambient pressure of {:.13} bar", 1e-5 * self.ambient_pressure)
    }
}

/// Why there is no drive-speed law.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DriveError {
    /// The buffers take the bed's energy before the end of the stroke.
    #[error("the bed stops at {:.4} mm, before the end of its stroke of {:.4} mm: {remedies}", 1e3 * x, 1e3 * stroke)]
    StopsEarly {
        /// Where the bed stops, m.
        x: f64,
        /// r (1 + φ_в), m.
        stroke: f64,
        /// What closes the machine.
        remedies: ClosingRemedies,
    },
    /// The bed still moves where the crank must stop it.
    #[error("the bed arrives at the end of its stroke with {speed:.6} m/s: {remedies}")]
    ArrivesWithSpeed {
        /// Speed left, m/s.
        speed: f64,
        /// What closes the machine.
        remedies: ClosingRemedies,
    },
    /// An input is out of its range, or the stroke uses up the column.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

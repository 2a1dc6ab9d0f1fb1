//! Why a drive-speed law does not exist, and what would make it.

/// Each alone closes the machine, the other two as given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Remedies {
    /// Bore, m.
    pub bore: f64,
    /// Air column L, m; `None` where no column does that is longer than the stroke by more than rounding.
    pub column: Option<f64>,
    /// Ambient pressure, Pa, absolute.
    pub ambient_pressure: f64,
}

/// With as many digits as it takes to close within [`super::CLOSING`] when they are typed.
impl std::fmt::Display for Remedies {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "a bore of {:.10} mm closes it, or ", 1e3 * self.bore)?;
        match self.column {
            Some(column) => write!(f, "an air column of {:.10} mm", 1e3 * column)?,
            None => write!(f, "no column longer than the stroke does")?,
        }
        write!(f, ", or an ambient pressure of {:.13} bar", 1e-5 * self.ambient_pressure)
    }
}

/// Why there is no drive-speed law.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DriveError {
    /// An input must be positive (the lead angle at least 0) and finite.
    #[error("the {name} is {value}: it must be a finite number above 0 (a lead angle may be 0)")]
    NotPositive {
        /// Which.
        name: &'static str,
        /// Its value, SI.
        value: f64,
    },
    /// The polytropic exponent must be 1 or more.
    #[error("the polytropic exponent is {exponent}: it must be a finite number from 1")]
    Exponent {
        /// k.
        exponent: f64,
    },
    /// The bed would run through the bottom of the cylinders.
    #[error("the air column of {} mm is used up within the stroke of {} mm", 1e3 * column, 1e3 * stroke)]
    ColumnTooShort {
        /// L, m.
        column: f64,
        /// r (1 + φ_в), m.
        stroke: f64,
    },
    /// The buffers take the bed's energy before the end of the stroke.
    #[error("the bed stops at {:.4} mm, before the end of its stroke of {:.4} mm: {remedies}", 1e3 * x, 1e3 * stroke)]
    StopsEarly {
        /// Where the bed stops, m.
        x: f64,
        /// r (1 + φ_в), m.
        stroke: f64,
        /// What closes the machine.
        remedies: Remedies,
    },
    /// The bed still moves where the crank must stop it.
    #[error("the bed arrives at the end of its stroke with {speed:.6} m/s: {remedies}")]
    ArrivesWithSpeed {
        /// Speed left, m/s.
        speed: f64,
        /// What closes the machine.
        remedies: Remedies,
    },
}

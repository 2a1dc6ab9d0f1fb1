//! Critical speeds and modes, by the method that is asked for.

use super::{Asked, ShaftAnalysisError, Solver};
use crate::shaft::exact::{self, Mode};
use crate::shaft::{Shaft, Whirl, paper};

/// The critical speeds of a shaft.
pub(super) struct Spectrum {
    /// rad/s, rising.
    pub(super) speeds: Vec<f64>,
    /// The modes; none of the paper's method.
    pub(super) modes: Vec<Mode>,
    /// Order of the load polynomials; none of the paper's method.
    pub(super) order: Option<usize>,
    /// The first critical speed by the exact method, where the paper's was asked for, rad/s.
    pub(super) exact: Option<f64>,
}

impl Spectrum {
    pub(super) fn of(shaft: &Shaft, asked: &Asked) -> Result<Self, ShaftAnalysisError> {
        match asked.solver {
            Solver::Exact { order } => {
                let found = exact::modes(shaft, asked.whirl, asked.modes, order)?;
                let speeds = found.modes.iter().map(|mode| mode.speed).collect();
                Ok(Self { speeds, modes: found.modes, order: Some(found.order), exact: None })
            }
            Solver::Paper { .. } if asked.modes > 1 => Err(ShaftAnalysisError::OneMode),
            Solver::Paper { stations } => {
                let found = paper::first_critical(shaft, stations)?;
                let exact = exact::modes(shaft, Whirl::Forward, 1, None)?.modes.first().map(|mode| mode.speed);
                Ok(Self { speeds: vec![found.speed], modes: Vec::new(), order: None, exact })
            }
        }
    }

    /// The first one, rad/s.
    pub(super) fn first(&self) -> f64 {
        self.speeds.first().copied().unwrap_or(f64::NAN)
    }
}

//! Critical speeds and modes, by the method that is asked for.

use super::{Asked, ShaftAnalysisError, Solver};
use crate::shaft::exact::{self, Mode};
use crate::shaft::{Shaft, ShaftError, Whirl, paper};

/// Critical speeds that are looked for where no number is given.
const USUAL: usize = 3;

/// The critical speeds of a shaft.
pub(super) struct Spectrum {
    /// rad/s, rising.
    pub(super) speeds: Vec<f64>,
    /// The modes; none of the paper's method.
    pub(super) modes: Vec<Mode>,
    /// Order of the load polynomials; none of the paper's method.
    pub(super) order: Option<usize>,
    /// The first critical speed of forward whirl by the exact method, rad/s: what a speed is held against.
    pub(super) forward: f64,
}

impl Spectrum {
    pub(super) fn of(shaft: &Shaft, asked: &Asked) -> Result<Self, ShaftAnalysisError> {
        let forward = |whirl: Whirl, own: f64| match whirl {
            Whirl::Forward => Ok(own),
            Whirl::Planar | Whirl::Backward => first_forward(shaft),
        };
        match asked.solver {
            Solver::Exact { order } => {
                let found = as_many(shaft, asked, order)?;
                let speeds: Vec<f64> = found.modes.iter().map(|mode| mode.speed).collect();
                let whirl = if order.is_some() { Whirl::Planar } else { asked.whirl };
                let forward = forward(whirl, speeds.first().copied().unwrap_or(f64::NAN))?;
                Ok(Self { speeds, modes: found.modes, order: Some(found.order), forward })
            }
            Solver::Paper { .. } if asked.modes.is_some_and(|modes| modes > 1) => Err(ShaftAnalysisError::OneMode),
            Solver::Paper { stations } => {
                let found = paper::first_critical(shaft, stations)?;
                Ok(Self { speeds: vec![found.speed], modes: Vec::new(), order: None, forward: first_forward(shaft)? })
            }
        }
    }

    /// The first one, rad/s.
    pub(super) fn first(&self) -> f64 {
        self.speeds.first().copied().unwrap_or(f64::NAN)
    }
}

/// The first critical speed of forward whirl; of planar whirl where the gyroscopic moments leave none, rad/s.
fn first_forward(shaft: &Shaft) -> Result<f64, ShaftAnalysisError> {
    let first = |whirl| exact::modes(shaft, whirl, 1, None).map(|found| found.modes.first().map(|mode| mode.speed));
    let found = first(Whirl::Forward).or_else(|_| first(Whirl::Planar))?;
    Ok(found.unwrap_or(f64::NAN))
}

/// As many modes as are asked for, or, where no number is given, as many as there are up to the usual ones.
fn as_many(shaft: &Shaft, asked: &Asked, order: Option<usize>) -> Result<exact::Modes, ShaftAnalysisError> {
    if let Some(count) = asked.modes {
        return Ok(exact::modes(shaft, asked.whirl, count, order)?);
    }
    let mut count = USUAL;
    loop {
        match exact::modes(shaft, asked.whirl, count, order) {
            Err(ShaftError::NoSuchMode { .. } | ShaftError::ModeTooHigh { .. }) if count > 1 => count -= 1,
            found => return Ok(found?),
        }
    }
}

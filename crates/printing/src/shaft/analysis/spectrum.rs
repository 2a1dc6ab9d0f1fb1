//! Critical speeds and modes, by the method that is requested.

use super::{CriticalSpeedSolver, ShaftOptions};
use crate::shaft::mechanics::exact::{self, Mode};
use crate::shaft::mechanics::{Shaft, ShaftError, Whirl, paper};
use camgen_kernel::refusal::Refusal;

/// Critical speeds that are looked for where no number is given.
const USUAL: usize = 3;

/// The critical speeds of a shaft.
pub(super) struct CriticalSpeeds {
    /// rad/s, rising.
    pub(super) speeds: Vec<f64>,
    /// The modes; none of the paper's method.
    pub(super) modes: Vec<Mode>,
    /// Order of the load polynomials; none of the paper's method.
    pub(super) order: Option<usize>,
    /// Why there are fewer than requested.
    pub(super) fewer: Option<String>,
    /// The first critical speed of forward whirl by the exact method, rad/s: what a speed is held against.
    pub(super) forward: f64,
}

impl CriticalSpeeds {
    pub(super) fn find(shaft: &Shaft, asked: &ShaftOptions) -> Result<Self, Refusal> {
        match asked.solver {
            CriticalSpeedSolver::Exact { order } => {
                let (found, fewer) = as_many(shaft, asked, order)?;
                let speeds: Vec<f64> = found.modes.iter().map(|mode| mode.speed).collect();
                let whirl = if order.is_some() { Whirl::Planar } else { asked.whirl };
                let forward = match whirl {
                    Whirl::Forward => speeds.first().copied().unwrap_or(f64::NAN),
                    Whirl::Planar | Whirl::Backward => first_forward(shaft)?,
                };
                Ok(Self { speeds, modes: found.modes, order: Some(found.order), fewer, forward })
            }
            CriticalSpeedSolver::Paper { .. } if asked.modes.is_some_and(|modes| modes > 1) => {
                Err(Refusal::new("--solver paper finds the first critical speed only")
                    .remedy("leave out --modes, or use --solver exact"))
            }
            CriticalSpeedSolver::Paper { stations } => {
                let found = paper::first_critical(shaft, stations)?;
                let forward = first_forward(shaft)?;
                Ok(Self { speeds: vec![found.speed], modes: Vec::new(), order: None, fewer: None, forward })
            }
        }
    }

    /// The first one, rad/s.
    pub(super) fn first(&self) -> f64 {
        self.speeds.first().copied().unwrap_or(f64::NAN)
    }
}

/// The first critical speed of forward whirl; of planar whirl where the gyroscopic moments leave none, rad/s.
fn first_forward(shaft: &Shaft) -> Result<f64, Refusal> {
    let forward = exact::modes(shaft, Whirl::Forward, 1, None);
    let found = forward.or_else(|_| exact::modes(shaft, Whirl::Planar, 1, None))?;
    Ok(found.modes.first().map_or(f64::NAN, |mode| mode.speed))
}

/// The modes up to the requested number, or else the usual one; and why there are fewer than requested.
fn as_many(
    shaft: &Shaft,
    asked: &ShaftOptions,
    order: Option<usize>,
) -> Result<(exact::Modes, Option<String>), Refusal> {
    let mut count = asked.modes.unwrap_or(USUAL);
    let mut fewer = None;
    loop {
        match exact::modes(shaft, asked.whirl, count, order) {
            Err(why @ (ShaftError::NoSuchMode { .. } | ShaftError::ModeTooHigh { .. })) if count > 1 => {
                fewer = fewer.or_else(|| asked.modes.map(|_| why.to_string()));
                count -= 1;
            }
            found => return Ok((found?, fewer)),
        }
    }
}

//! Speed against accuracy of the disc that holds the tension of a belt brake.

use crate::brake::{BRAKE_CAM, BrakeMachine, spec};
use camgen_cams::analysis::Analysis;
use camgen_cams::body::Kind;
use camgen_cams::trade::{self, ACCELERATION, COMMAND, TradeLimits, TradeRun, TradeTask, of_disc};
use camgen_kernel::refusal::Refusal;
use std::sync::Arc;

/// The disc of a brake.
pub const KIND: Kind =
    Kind { command: COMMAND, noun: "time and accuracy of the disc of a belt brake", keys: BRAKE_CAM };

/// The disc of a brake over all settings. The advice is the setting that costs a shop least of those whose check of the tension passes and whose
/// acceleration is off by no more than a share of its largest, 5 % where none is given.
///
/// # Errors
/// [`Refusal`] when the file describes no disc, or a setting cannot be made.
pub fn analysis(brake: &BrakeMachine, acceleration: Option<f64>, run: TradeRun<'_>) -> Result<Analysis, Refusal> {
    let (own, disc) = (brake.clone(), Arc::new(brake.brake_disc()?));
    let no_disc = || Refusal::new("the file describes no disc on the shaft of the frame");
    let settings = of_disc(move || spec(&own, Arc::clone(&disc)).ok_or_else(no_disc))?;
    let limits = TradeLimits { residual: None, acceleration: Some(acceleration.unwrap_or(ACCELERATION)) };
    let machine = brake.machine().ok_or_else(no_disc)?;
    let (cam, inputs, others) = ("brake", brake.inputs().to_vec(), Vec::new());
    trade::analysis(&TradeTask { kind: &KIND, cam, machine, rpm: None, settings, limits, inputs, others }, run)
}

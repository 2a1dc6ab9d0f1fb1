//! The program for a machine in the form that the machine file asks for, or that the body needs.

pub(super) mod entry;
pub mod four_axes;
pub mod milling;
mod polar;

use crate::body::{Body, Request};
use crate::machine::CuttingForm;
use milling::{MillingError, MillingProgram};

/// The programs for all parts of a body; none where they were not requested.
///
/// # Errors
/// [`MillingError`] when the cutter does not get into a concave part, the tolerance is too fine for the control, no depth is known, no way to the flank is
/// free, or the control does not know what the form needs.
pub(super) fn programs(body: &dyn Body, request: &Request) -> Result<Vec<MillingProgram>, MillingError> {
    let Some(asked) = request.milling.filter(|_| milling::unfit(body).is_none()) else {
        return milling::programs(body, request);
    };
    match body.swept().and_then(|swept| swept.turned().ok()) {
        _ if body.machine().cutting().form == CuttingForm::Polar => polar::program(body, request, asked),
        Some(cam) => four_axes::program(body, request, (cam, asked)),
        None => milling::programs(body, request),
    }
}

//! What judging a program for a machine gives.

use super::check::WrittenProgram;
use super::safe_start::{assumed, assumed_home};
use crate::body::Body;
use crate::body::milling::rib_between;
use crate::report::shown;
use camgen_kernel::geometry::MILLIMETRES;
use nalgebra::Vector2;

/// A program that is not one of the cam.
pub(super) struct ProgramFault {
    pub(super) why: String,
    /// mm.
    pub(super) value: f64,
    pub(super) at: Option<Vector2<f64>>,
}

impl ProgramFault {
    pub(super) fn new(why: impl Into<String>) -> Self {
        Self { why: why.into(), value: f64::INFINITY, at: None }
    }
}

/// A program that was judged.
pub(super) struct JudgedProgram {
    /// Largest distance, mm.
    pub(super) value: f64,
    pub(super) at: Vector2<f64>,
    pub(super) note: String,
}

/// What else is to be known of a program: blocks that are passed over, and a rib that its passes leave; for a note.
pub(super) fn remarks(body: &dyn Body, written: &WrittenProgram) -> String {
    let unknown = match written.program.as_ref().map(|program| program.unknown.as_slice()) {
        Ok([]) | Err(_) => String::new(),
        Ok(blocks) => format!("; passed over: `{}`", blocks.join("`, `")),
    };
    let rib = rib_between(body, written.cutter.map(|radius| radius / MILLIMETRES));
    let rib = rib.map(|rib| {
        format!("; a rib of {} mm stands between the passes, to be cleared before", shown(MILLIMETRES * rib))
    });
    let named = written.program.as_ref().is_ok_and(|program| program.states.iter().any(|(_, state)| state.named));
    let tool = body.machine().cutting().tool.filter(|_| named);
    let tool = tool.map(|tool| format!("; a tool is called by its name, which is not compared with cut.tool = {tool}"));
    let assumed = written.program.as_ref().map_or_else(|_| String::new(), assumed);
    let home = written.program.as_ref().map(|program| assumed_home(&body.machine().cutting(), program));
    unknown + &assumed + &home.unwrap_or_default() + &tool.unwrap_or_default() + &rib.unwrap_or_default()
}

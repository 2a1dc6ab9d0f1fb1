//! What judging a program for a machine gives.

use super::super::plan::milling::rib_between;
use super::super::read::CutterProgram;
use super::safe_start::{assumed, assumed_home};
use crate::body::Body;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::text::{Length, Text, text};
use nalgebra::Vector2;

/// A program for a milling machine as its control would read it from the written file.
#[derive(Debug, Clone, PartialEq)]
pub(in super::super) struct WrittenProgram {
    /// Along which of the cuts of its body its passes run.
    pub(in super::super) cuts: Vec<usize>,
    /// Radius of the cutter whose centre is moved, mm; `None` where the control keeps its cutter on the profile.
    pub(in super::super) cutter: Option<f64>,
    /// Radius of the cutter that the control keeps on the profile, mm, if it is given.
    pub(in super::super) kept: Option<f64>,
    /// Largest radius of a cutter that the control may keep there, mm, as the program was planned.
    pub(in super::super) presumed: Option<f64>,
    /// Whether the blank is stated: by the plan, or by `cut.blank_margin`.
    pub(in super::super) knows_blank: bool,
    /// How far the middle of the tolerance band lies inwards of the exact profile, mm.
    pub(in super::super) middle: f64,
    /// How deep is cut, mm; `None` where it is not known.
    pub(in super::super) depth: Option<f64>,
    /// What the control does, or why it does nothing.
    pub(in super::super) program: Result<CutterProgram, String>,
}

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
    pub(super) note: Text,
}

/// What else is to be known of a program: blocks that are passed over, and a rib that its passes leave; for a note.
pub(super) fn remarks(body: &dyn Body, written: &WrittenProgram) -> Text {
    let unknown = match written.program.as_ref().map(|program| program.unknown.as_slice()) {
        Ok([]) | Err(_) => Text::default(),
        Ok(blocks) => text!("; passed over: `{}`", blocks.join("`, `")),
    };
    let rib = rib_between(body, written.cutter.map(|radius| radius / MILLIMETRES));
    let rib = rib.map(|rib| {
        text!("; a rib of {} stands between the passes, to be cleared before", Length::mm(MILLIMETRES * rib))
    });
    let named = written.program.as_ref().is_ok_and(|program| program.states.iter().any(|(_, state)| state.named));
    let tool = body.machine().cutting().tool.filter(|_| named);
    let tool = tool.map(|tool| text!("; a tool is called by its name, which is not compared with cut.tool = {}", tool));
    let assumed = written.program.as_ref().map_or_else(|_| String::new(), assumed);
    let home = written.program.as_ref().map(|program| assumed_home(&body.machine().cutting(), program));
    text!("{}{}{}{}{}", unknown, assumed, home.unwrap_or_default(), tool, rib)
}

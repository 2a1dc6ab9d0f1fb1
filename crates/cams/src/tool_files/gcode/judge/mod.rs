//! What the control of a milling machine makes of a program, compared with the cam.

mod cutting;
mod entry;
mod milling;
mod program;
mod safe_start;
mod turned;

pub(super) use milling::{CHECK, judge, keeps_its_cutter, left_by, no_program};
pub(super) use program::WrittenProgram;

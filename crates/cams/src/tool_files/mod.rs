//! Files that a machine runs: to cut from, to move a drive by, to measure with. Each has a folder with all that belongs to it: its formats, what
//! is planned of a cam, the writer, the reader and the judge.
//!
//! A [`ToolFile`] has no function that writes a file to the disk: what is planned is written to memory, and only [`prove`] makes a
//! [`ProvedFile`] of it, once its judge has read the bytes. What is only looked at (a sheet, a page, a table) is a [`View`](crate::write::View).
//!
//! A new one is a folder here and a line in [`LISTED`].

pub mod dxf;
pub mod gauge;
pub mod gcode;
mod head;
pub mod inspection;
mod list;
pub mod points;
mod proof;
pub(crate) mod section;
pub mod servo;
pub mod table;
mod tool_file;

pub use list::{Format, LISTED, Listed, formats, formats_by_name, recognised, requested, tool_files};
pub use proof::{PlannedFile, ProvedToolFile, plan, prove};
pub use tool_file::{
    DrawnCam, ExpectedFile, FileError, JudgedFile, Plan, ProvedFile, SolvedCam, ToolFile, ToolFileFacts, WrittenFile,
};

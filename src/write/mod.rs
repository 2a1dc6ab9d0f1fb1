//! Drawing to bytes, bytes to files. Writers only format: no trigonometry, no offsets, no clock.

pub mod csv;
pub mod dxf;
pub mod files;
pub mod formats;
pub mod json;
pub mod number;
pub mod proof;
pub mod step;
pub mod stl;
pub mod svg;

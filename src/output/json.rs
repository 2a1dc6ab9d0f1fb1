//! The report as JSON.

use serde::Serialize;

/// A report, indented, with a line feed at the end.
///
/// # Errors
/// Only what `serde_json` cannot write, which a report is not.
pub fn write(report: &impl Serialize) -> Result<Vec<u8>, serde_json::Error> {
    let mut bytes = serde_json::to_vec_pretty(report)?;
    bytes.push(b'\n');
    Ok(bytes)
}

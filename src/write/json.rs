//! The report as JSON.

use super::{Format, OfAnalysis, When, fits_all};
use serde::Serialize;

/// The report.
pub const FORMAT: Format = Format {
    name: "json",
    when: When::Asked,
    flank: false,
    unfit: fits_all,
    endings: |_| vec![".json".into()],
    write: |cam| Ok(vec![write(&**cam.report)?]),
    of_analysis: Some(OfAnalysis {
        endings: |_| vec![".json".into()],
        write: |account| Ok(vec![write(account.report)?]),
    }),
};

/// A report, indented, with a line feed at the end.
///
/// # Errors
/// Only what `serde_json` cannot write, which a report is not.
pub fn write(report: &impl Serialize) -> Result<Vec<u8>, serde_json::Error> {
    let mut bytes = serde_json::to_vec_pretty(report)?;
    bytes.push(b'\n');
    Ok(bytes)
}

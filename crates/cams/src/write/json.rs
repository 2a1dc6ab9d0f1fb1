//! The report as JSON.

use super::{AnalysisFormat, FormatSelection, View, fits_all};
use camgen_kernel::refusal::Refusal;
use serde::Serialize;

/// The report.
pub const FORMAT: View = View {
    name: "json",
    when: FormatSelection::Asked,
    flank: false,
    unfit: fits_all,
    endings: |_| vec![".json".into()],
    write: |cam| Ok(vec![write(&**cam.report).map_err(Refusal::of)?]),
    of_analysis: Some(AnalysisFormat {
        endings: |_| vec![".json".into()],
        write: |account| Ok(vec![write(account.report).map_err(Refusal::of)?]),
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

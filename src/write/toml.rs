//! What an analysis describes as a table of a machine file, to paste there.

use super::{Format, OfAnalysis, When};

/// A table of a machine file.
pub const FORMAT: Format = Format {
    name: "toml",
    when: When::Asked,
    flank: false,
    unfit: |_| Some("it is for a linkage; a cam is described by its machine file"),
    endings: |_| Vec::new(),
    write: |_| Ok(Vec::new()),
    of_analysis: Some(OfAnalysis {
        endings: |analysis| analysis.document.iter().map(|_| ".toml".into()).collect(),
        write: |account| {
            let mark = account.report.mark();
            Ok(account.analysis.document.iter().map(|text| format!("# {mark}\n\n{text}").into_bytes()).collect())
        },
    }),
};

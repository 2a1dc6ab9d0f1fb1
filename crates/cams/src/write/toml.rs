//! What an analysis describes as a table of a machine file, to paste there.

use super::{AnalysisFormat, FormatSelection, View};

/// A table of a machine file.
pub const FORMAT: View = View {
    name: "toml",
    when: FormatSelection::Asked,
    flank: false,
    unfit: |_| Some("toml is for a linkage; a cam is described by its machine file already"),
    endings: |_| Vec::new(),
    write: |_| Ok(Vec::new()),
    of_analysis: Some(AnalysisFormat {
        endings: |analysis| analysis.document.iter().map(|_| ".toml".into()).collect(),
        write: |account| {
            let mark = account.report.mark();
            Ok(account.analysis.document.iter().map(|text| format!("# {mark}\n\n{text}").into_bytes()).collect())
        },
    }),
};

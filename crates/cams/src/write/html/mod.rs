//! The interactive report: one HTML file with everything in it, for a browser without a network. Verdicts, the mechanism in motion, the
//! curves, the tables, and what is not modelled.
//!
//! The page is a template with its style and script and the chart library uPlot, all in `templates/`; the cam is put into it as JSON.
//! The script knows no kinematics: it interpolates between the samples of [`crate::report::mechanism`].

mod data;
#[cfg(feature = "live")]
pub mod live;
mod panels;
mod units;

use super::{AnalysisFormat, FormatSelection, Rendering, View, fits_all};
use crate::report::{Finding, Report};
use camgen_kernel::refusal::Refusal;
use serde_json::{Value, json};

/// The interactive report.
pub const FORMAT: View = View {
    name: "html",
    when: FormatSelection::Asked,
    flank: false,
    unfit: fits_all,
    endings: |_| vec![".html".into()],
    write: |cam| Ok(vec![of_cam(cam)?]),
    of_analysis: Some(AnalysisFormat {
        endings: |_| vec![".html".into()],
        write: |account| Ok(vec![page(&account.report.title(), &[data::of_analysis(account)])?]),
    }),
};

/// The unit of a figure by the end of its path, as people write it; `None` where it has none.
#[cfg(feature = "parquet")]
pub(crate) fn unit_of(path: &str) -> Option<&'static str> {
    let name = path.rsplit('.').next().unwrap_or(path);
    Some(units::named(name.split('[').next().unwrap_or(name)).unit).filter(|unit| !unit.is_empty())
}

const PAGE: &str = include_str!("../../../templates/report.html");
const STYLE: &str = include_str!("../../../templates/report.css");
/// What several pages have: their head, the moving mechanism with its controls, and their scripts.
const PARTS: [(&str, &str); 3] = [
    ("{{head}}", include_str!("../../../templates/parts/head.html")),
    ("{{moving}}", include_str!("../../../templates/parts/moving.html")),
    ("{{scripts}}", include_str!("../../../templates/parts/scripts.html")),
];
const COMMON: &str = include_str!("../../../templates/report/common.js");
const MARGINS: &str = include_str!("../../../templates/report/margins.js");
const MOVING_PARTS: &str = include_str!("../../../templates/report/parts.js");
const READOUT: &str = include_str!("../../../templates/report/readout.js");
const SOLID: &str = include_str!("../../../templates/report/solid.js");
const TABLES: &str = include_str!("../../../templates/report/tables.js");
const CURVES: &str = include_str!("../../../templates/report/curves.js");
const DIAGRAM: &str = include_str!("../../../templates/report/diagram.js");
const EXTREMES: &str = include_str!("../../../templates/report/extremes.js");
const STACK: &str = include_str!("../../../templates/report/stack.js");
const ANIMATION: &str = include_str!("../../../templates/report/page.js");
/// The scripts of the report. The live page has others for the mechanism and the plots, which change while a slider moves.
const SCRIPTS: [&str; 14] = [
    COMMON,
    MARGINS,
    MOVING_PARTS,
    include_str!("../../../templates/report/mechanism.js"),
    READOUT,
    SOLID,
    TABLES,
    CURVES,
    DIAGRAM,
    EXTREMES,
    STACK,
    include_str!("../../../templates/report/plot.js"),
    ANIMATION,
    include_str!("../../../templates/report/start.js"),
];
/// What the report may do in a browser.
const POLICY: &str = "script-src 'unsafe-inline'; img-src data:";
/// The page of a study, with its own script.
const STUDY: &str = include_str!("../../../templates/study.html");
const STUDY_SCRIPT: &str = include_str!("../../../templates/report/study.js");
const CHARTS: &str = include_str!("../../../templates/vendor/uplot/uPlot.iife.min.js");
const CHARTS_STYLE: &str = include_str!("../../../templates/vendor/uplot/uPlot.min.css");
const CHARTS_LICENCE: &str = include_str!("../../../templates/vendor/uplot/LICENSE");

/// The page of a cam, live where that was requested.
fn of_cam(cam: &Rendering<'_>) -> Result<Vec<u8>, Refusal> {
    #[cfg(feature = "live")]
    if let Some(design) = cam.live {
        // The engine makes the rest of the rows when the page opens.
        let first = Rendering { samples: cam.samples.min(live::FIRST_STEPS), ..*cam };
        return live::page((&cam.report.title(), data::of(&first)), std::slice::from_ref(design), None);
    }
    page(&cam.report.title(), &[data::of(cam)])
}

/// Two cams next to each other.
///
/// # Errors
/// Only what `serde_json` cannot write, which a report is not.
pub fn side_by_side(first: &Rendering<'_>, second: &Rendering<'_>) -> Result<Vec<u8>, Refusal> {
    let title = format!("{} | {}", first.report.title(), second.report.title());
    page(&title, &[data::of(first), data::of(second)])
}

/// What the page shows of a cam, as data.
#[must_use]
pub fn data_of(cam: &Rendering<'_>) -> Value {
    data::of(cam)
}

/// What the page shows of a cam that has no outline: its report, and no mechanism.
#[must_use]
pub fn data_without_outline(report: &Report) -> Value {
    data::report_page(report)
}

/// Checks as the page shows them.
#[must_use]
pub fn checks_of(findings: &[Finding]) -> Vec<Value> {
    findings.iter().map(data::check).collect()
}

/// The page of a study.
///
/// # Errors
/// As [`side_by_side`].
pub fn of_study(title: &str, data: &Value) -> Result<Vec<u8>, Refusal> {
    report_filled(STUDY, title, data, STUDY_SCRIPT)
}

/// The page of cams.
fn page(title: &str, cams: &[Value]) -> Result<Vec<u8>, Refusal> {
    report_filled(PAGE, title, &json!({"schema": 1, "cams": cams}), &without_comments(&SCRIPTS))
}

/// Scripts one behind the other, without their comments and the blanks at the start of a line: a page is sent and kept. No script has a text over
/// several lines, in which such blanks would count.
fn without_comments(scripts: &[&str]) -> String {
    let mut all = String::new();
    let mut in_comment = false;
    for line in scripts.iter().flat_map(|script| script.lines()).map(str::trim_start) {
        let is_comment = in_comment || line.starts_with("/**") || line.starts_with("//");
        in_comment = (in_comment || line.starts_with("/**")) && !line.contains("*/");
        if !is_comment && !line.is_empty() {
            all.push_str(line);
            all.push('\n');
        }
    }
    all
}

/// Data within a script: no tag can begin within the JSON, as `<` occurs in texts only.
fn in_script(data: &Value) -> Result<String, Refusal> {
    Ok(serde_json::to_string(data).map_err(Refusal::of)?.replace('<', "\\u003c"))
}

/// Fills the template of a report.
fn report_filled(template: &str, title: &str, data: &Value, script: &str) -> Result<Vec<u8>, Refusal> {
    let data = in_script(data)?;
    let lookup = |name: &str| match name {
        "policy" => POLICY.to_owned(),
        "title" => text(title),
        "style" => format!("{CHARTS_STYLE}\n{STYLE}"),
        "data" => data.clone(),
        "licence" => text(CHARTS_LICENCE),
        "charts" => CHARTS.to_owned(),
        "script" => script.to_owned(),
        _ => String::new(),
    };
    Ok(filled(template, lookup))
}

/// Fills a template and the parts that it shares with others: other inserted text is not searched again.
fn filled(template: &str, lookup: impl Fn(&str) -> String) -> Vec<u8> {
    let template = PARTS.iter().fold(template.to_owned(), |page, (name, part)| page.replace(name, part));
    let mut page = String::with_capacity(template.len());
    let mut rest = template.as_str();
    while let Some((before, behind)) = rest.split_once("{{") {
        let (name, after) = behind.split_once("}}").unwrap_or((behind, ""));
        page.push_str(before);
        page.push_str(&lookup(name.trim()));
        rest = after;
    }
    page.push_str(rest);
    page.into_bytes()
}

/// Text escaped for HTML.
fn text(text: &str) -> String {
    let printable: String = text.chars().filter(|c| !c.is_control() || *c == '\n').collect();
    printable.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

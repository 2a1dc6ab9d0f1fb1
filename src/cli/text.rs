//! The report for a person at a terminal.

use super::check::CheckReport;
use camgen::checks::{Finding, Verdict};
use camgen::drawing::Report;
use std::fmt::Write;

const GREEN: &str = "\u{1b}[32m";
const RED: &str = "\u{1b}[1;31m";
const PLAIN: &str = "\u{1b}[0m";

pub(super) fn report(report: &Report, colour: bool) -> String {
    let (cam, law, force) = (&report.cam, &report.law, &report.force);
    let mut lines = vec![
        format!("{} · {} cam for {} rpm", report.machine, report.command, report.rpm),
        format!(
            "  law      Δx {:.3} mm at x = {:.2} mm, air column {:.3} mm, bore {:.2} mm",
            law.dx_max_mm, law.dx_max_at_x_mm, law.column_length_mm, law.bore_mm
        ),
    ];
    if law.velocity_jump_mm_per_rad != 0.0 {
        lines.push(format!(
            "           its velocity jumps by {:.2} mm/rad of crank at the start of the reversal",
            law.velocity_jump_mm_per_rad
        ));
    }
    let smallest = cam
        .smallest_prime_radius_mm
        .map_or_else(|| "no radius keeps the limits".into(), |radius| format!("{radius:.3} would do"));
    lines.push(format!(
        "  cam      base radius {} mm, roller {} mm, prime radius {} mm ({smallest}), lift {:.3} mm",
        shown(cam.base_radius_mm),
        shown(cam.roller_radius_mm),
        shown(cam.prime_radius_mm),
        cam.max_lift_mm
    ));
    if let Some(area) = cam.area_mm2 {
        let mass = cam.mass_kg.map_or_else(|| "no thickness given".into(), |mass| format!("mass {mass:.3} kg"));
        let unbalance =
            cam.unbalance_g_mm.map_or(String::new(), |unbalance| format!(", unbalance {unbalance:.0} g·mm"));
        lines.push(format!("           area {area:.1} mm², {mass}{unbalance}"));
    }
    if let Some(outline) = &report.outline {
        let ratio = outline.arcs_over_best_possible.map_or(String::new(), |ratio| format!(" × {ratio:.2}"));
        lines.push(format!(
            "  outline  {} arcs and {} lines (best possible {:.1}{ratio}), {:.4} µm from the exact curve, tolerance {} µm",
            outline.arcs,
            outline.lines,
            outline.arcs_best_possible,
            1e3 * outline.deviation_max_mm,
            shown(1e3 * outline.tolerance_mm)
        ));
    }
    lines.push(format!(
        "  force    inertia {:.1} N; inertia less air {} N ({:.4} %) with this cam, {:.1} N with a fixed bottom",
        force.inertia_max_n,
        shown(force.residual_max_n),
        100.0 * force.residual_share,
        force.residual_fixed_bottom_max_n
    ));
    lines.push(format!(
        "           roller {:.1} N along its path, camshaft {:.1} N·m at the most",
        force.roller_force_max_n, force.torque_max_nm
    ));
    lines.push("  checks".into());
    lines.extend(report.checks.iter().map(|finding| check(finding, colour)));
    if !report.files.is_empty() {
        lines.push("  files".into());
        lines.extend(report.files.iter().map(|file| format!("    {file}")));
    }
    lines.push(String::new());
    lines.join("\n")
}

/// The report of a checked file: one plain sentence, then the checks.
pub(super) fn check_report(report: &CheckReport, passed: bool, colour: bool) -> String {
    let verdict = if passed { "is this cam" } else { "is NOT this cam" };
    let mut lines = vec![
        format!("{} {verdict}: {} · rotary cam for {} rpm", report.file, report.machine, report.rpm),
        "  checks".into(),
    ];
    lines.extend(report.checks.iter().map(|finding| check(finding, colour)));
    lines.push(String::new());
    lines.join("\n")
}

fn check(finding: &Finding, colour: bool) -> String {
    let (verdict, paint) = match finding.verdict {
        Verdict::Pass => ("pass", GREEN),
        Verdict::Fail => ("FAIL", RED),
        Verdict::Info => ("info", PLAIN),
    };
    let verdict = if colour { format!("{paint}{verdict}{PLAIN}") } else { verdict.into() };
    let value = if finding.value.is_finite() { shown(finding.value) } else { "–".into() };
    let with_unit = |value: String| if finding.unit.is_empty() { value } else { format!("{value} {}", finding.unit) };
    let mut line = format!("    {verdict}  {:<18} {}", finding.check, with_unit(value));
    if let Some(limit) = finding.limit {
        let _ = write!(line, ", limit {}", with_unit(shown(limit)));
    }
    if let Some(cam_deg) = finding.cam_deg {
        let _ = write!(line, ", at {cam_deg:.3}°");
    }
    if let Some(note) = &finding.note {
        let _ = write!(line, "; {note}");
    }
    line
}

/// Four decimals at the most, without trailing zeros; what is small keeps four digits, what is tiny two.
fn shown(value: f64) -> String {
    let size = value.abs();
    let decimals = if size < 1e-6 && size > 0.0 {
        return format!("{value:.1e}");
    } else if size < 0.1 {
        1e6
    } else {
        1e4
    };
    format!("{}", (value * decimals).round() / decimals)
}

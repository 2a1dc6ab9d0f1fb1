//! The report for a person at a terminal.

use super::check::CheckReport;
use camgen::cam::Place;
use camgen::checks::{Finding, Verdict};
use camgen::drawing::Report;
use camgen::drawing::conoid::ConoidReport;
use camgen::drawing::report::{BreakReport, CamReport, SolvedReport};
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
    if let Some(solved) = &law.equation_18 {
        lines.push(equation_18(solved, law.start_slope));
        let then = |at: &BreakReport| format!("{} from x = {:.3} mm", at.then, at.x_mm);
        if !solved.breaks.is_empty() {
            let breaks: Vec<String> = solved.breaks.iter().map(then).collect();
            lines.push(format!("           the bottom is {}", breaks.join(", ")));
        }
    }
    lines.push(cam_line(cam));
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
    lines.push(match force.torque_max_nm {
        Some(torque) => format!(
            "           roller {:.1} N along its path, camshaft {torque:.1} N·m at the most",
            force.roller_force_max_n
        ),
        None => format!("           each roller {:.1} N along the normal at the most", force.roller_force_max_n),
    });
    if let (Some(braking), Some(back), Some(at)) =
        (force.residual_braking_max_n, force.residual_return_max_n, force.residual_return_at_x_mm)
    {
        let share = |newtons: f64| 100.0 * newtons / force.inertia_max_n;
        lines.push(format!(
            "           the law leaves {} N ({:.2e} %) braking, {back:.1} N ({:.2} %) on the way back at x = {at:.2} mm",
            shown(braking),
            share(braking),
            share(back)
        ));
    }
    ended(lines, &report.checks, &report.files, colour)
}

/// Size and lift of a cam.
fn cam_line(cam: &CamReport) -> String {
    let roller = shown(cam.roller_radius_mm);
    if let Some(plate) = &cam.plate {
        return format!(
            "  cam      plate {:.2} × {} mm, {:.3} mm where it is thinnest (x = {:.2} mm), roller {roller} mm, lift {:.3} mm",
            plate.length_mm,
            shown(plate.height_mm),
            plate.thinnest_mm,
            plate.thinnest_at_x_mm,
            cam.max_lift_mm
        );
    }
    let smallest = cam
        .smallest_prime_radius_mm
        .map_or_else(|| "no radius keeps the limits".into(), |radius| format!("{radius:.3} would do"));
    format!(
        "  cam      base radius {} mm, roller {roller} mm, prime radius {} mm ({smallest}), lift {:.3} mm",
        shown(cam.base_radius_mm.unwrap_or(f64::NAN)),
        shown(cam.prime_radius_mm.unwrap_or(f64::NAN)),
        cam.max_lift_mm
    )
}

fn equation_18(solved: &SolvedReport, start_slope: f64) -> String {
    let how = match (solved.stations, solved.tolerance_mm) {
        (Some(stations), _) => format!("{stations} stations"),
        (None, tolerance) => {
            format!("{} steps to {:e} mm", solved.steps.unwrap_or(0), tolerance.unwrap_or(f64::NAN))
        }
    };
    format!(
        "           (18) by {} in {how}, efficiency {}, balanced: {}, slope at the start {start_slope:.8}",
        solved.solver, solved.efficiency_model, solved.balance
    )
}

/// The report of a conoid.
pub(super) fn conoid_report(report: &ConoidReport, colour: bool) -> String {
    let (cam, surface, between) = (&report.cam, &report.surface, &report.between);
    let speeds: Vec<String> = report.rpm.iter().map(|rpm| shown(*rpm)).collect();
    let mut lines = vec![format!("{} · conoid for {} rpm", report.machine, speeds.join(", "))];
    for section in &report.sections {
        let arcs = section.arcs.map_or(String::new(), |arcs| format!(", {arcs} arcs"));
        lines.push(format!(
            "  {:>6} rpm  z {:.3} mm, column {:.3} mm, slope at the start {:.4}, Δx {:.3} mm at x = {:.2} mm{arcs}",
            shown(section.rpm),
            section.z_mm,
            section.column_length_mm,
            section.start_slope,
            section.dx_max_mm,
            section.dx_max_at_x_mm
        ));
    }
    let smallest = cam
        .smallest_prime_radius_mm
        .map_or_else(|| "no radius keeps the limits".into(), |radius| format!("{radius:.3} would do"));
    lines.push(format!(
        "  cam      base radius {} mm, roller {} mm, prime radius {} mm ({smallest}), lift {:.3} mm, z {} to {} mm",
        shown(cam.base_radius_mm),
        shown(cam.roller_radius_mm),
        shown(cam.prime_radius_mm),
        cam.max_lift_mm,
        shown(cam.z_min_mm),
        shown(cam.z_max_mm)
    ));
    if let (Some(volume), Some(mass)) = (cam.volume_mm3, cam.mass_kg) {
        lines.push(format!("           volume {volume:.1} mm³, mass {mass:.3} kg"));
    }
    lines.push(format!(
        "  surface  the contact wanders {:.4} mm along the axis; plane offsets would miss by {:.4} mm; axial force {:.1} N",
        surface.axial_wander_mm, surface.plane_offset_error_max_mm, surface.axial_force_max_n
    ));
    if let (Some(patches), Some(deviation)) = (surface.patches, surface.deviation_max_mm) {
        lines.push(format!("           {patches} spline patches, {:.4} µm from the exact surface", 1e3 * deviation));
    }
    lines.push(format!(
        "  between  {} N left at {:.3} rpm, {:.2}°; straight strips would leave {} N",
        shown(between.residual_max_n),
        between.rpm,
        between.cam_deg,
        shown(between.residual_straight_strips_max_n)
    ));
    ended(lines, &report.checks, &report.files, colour)
}

/// The report of a checked file: one plain sentence, then the checks.
pub(super) fn check_report(report: &CheckReport, passed: bool, colour: bool) -> String {
    let verdict = if passed { "is this cam" } else { "is NOT this cam" };
    let lines = vec![format!("{} {verdict}: {} · {} for {} rpm", report.file, report.machine, report.cam, report.rpm)];
    ended(lines, &report.checks, &[], colour)
}

/// Checks and files below what a report begins with.
fn ended(mut lines: Vec<String>, checks: &[Finding], files: &[String], colour: bool) -> String {
    lines.push("  checks".into());
    lines.extend(checks.iter().map(|finding| check(finding, colour)));
    if !files.is_empty() {
        lines.push("  files".into());
        lines.extend(files.iter().map(|file| format!("    {file}")));
    }
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
    if finding.place != Place::default() {
        let _ = write!(line, ", at {}", finding.place);
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

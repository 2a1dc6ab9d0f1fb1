//! The report: everything that was solved, checked and written, as data.

use super::Part;
use super::outline::MILLIMETRES;
use crate::cam::rotary::Rotary;
use crate::checks::Finding;
use crate::checks::rolling::Rolled;
use crate::follower::Follower;
use serde::Serialize;

/// Grams in a kilogram.
const GRAMS: f64 = 1e3;

/// Version of the form of the report.
const SCHEMA: u32 = 1;

/// The report of a rotary cam.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Version of this form.
    pub schema: u32,
    /// The command that made it.
    pub command: &'static str,
    /// Name of the machine.
    pub machine: String,
    /// Speed of the main shaft.
    pub rpm: f64,
    /// Measures of the cam.
    pub cam: CamReport,
    /// The law.
    pub law: LawReport,
    /// Every check.
    pub checks: Vec<Finding>,
    /// The outline; `None` when there is none to draw.
    pub outline: Option<OutlineReport>,
    /// What rolling on the outline as written has shown.
    pub rolling: Option<Rolled>,
    /// Forces.
    pub force: ForceReport,
    /// Files written.
    pub files: Vec<String>,
}

/// Measures of the cam.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct CamReport {
    pub prime_radius_mm: f64,
    pub base_radius_mm: f64,
    pub roller_radius_mm: f64,
    pub max_lift_mm: f64,
    /// The smallest prime radius that keeps every limit, before rounding.
    pub smallest_prime_radius_mm: Option<f64>,
    /// Of the metal: outline less bore.
    pub area_mm2: Option<f64>,
    pub mass_kg: Option<f64>,
    pub centre_of_mass_mm: Option<[f64; 2]>,
    /// Static unbalance about the shaft, with the holes that balance it, if any.
    pub unbalance_g_mm: Option<f64>,
}

/// The law.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct LawReport {
    /// The Δx of largest size, signed.
    pub dx_max_mm: f64,
    pub dx_max_at_x_mm: f64,
    pub column_length_mm: f64,
    pub piston_area_mm2: f64,
    pub bore_mm: f64,
    /// c − 1: the slope dΔx/dx at the start of the reversal.
    pub start_slope: f64,
    /// Jump of the bottom's velocity at the start of the reversal.
    pub velocity_jump_mm_per_rad: f64,
}

/// The outline.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct OutlineReport {
    pub arcs: usize,
    pub lines: usize,
    pub deviation_max_mm: f64,
    pub tangent_break_max_deg: f64,
    pub tolerance_mm: f64,
    /// N*, the count no chain of tangent arcs can stay below, dwells not counted.
    pub arcs_best_possible: f64,
    pub arcs_over_best_possible: Option<f64>,
    pub length_mm: f64,
}

/// Forces.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct ForceReport {
    pub inertia_max_n: f64,
    /// Largest |inertia − air| over the reversal with the lift as rolled on the written outline, or, where nothing was
    /// rolled, of the law.
    pub residual_max_n: f64,
    pub residual_share: f64,
    pub residual_fixed_bottom_max_n: f64,
    /// Along the roller's path; with preload and inertia of the follower where they are given.
    pub roller_force_max_n: f64,
    pub torque_max_nm: f64,
}

/// The report of a cam; `files` are named by whoever writes them.
#[must_use]
pub fn report(
    rotary: &Rotary,
    part: Option<&Part>,
    rolling: Option<Rolled>,
    tolerance: f64,
    checks: Vec<Finding>,
) -> Report {
    let balance = rotary.balance();
    let (dx_max_at_x, dx_max) = balance.largest_displacement();
    let square_millimetres = MILLIMETRES * MILLIMETRES;
    let face = part.map(Part::area_and_moment);
    // kg per mm², where there is a thickness.
    let weight =
        rotary.machine.cam.thickness.map(|thickness| thickness * rotary.machine.cam.density() / square_millimetres);
    let residual_max_n = rolling.as_ref().map_or_else(|| rotary.residual_max(), |rolled| rolled.residual_max_n);
    Report {
        schema: SCHEMA,
        command: "rotary",
        machine: rotary.machine.name.clone(),
        rpm: rotary.rpm,
        cam: CamReport {
            prime_radius_mm: MILLIMETRES * rotary.disc.follower.prime_radius(),
            base_radius_mm: MILLIMETRES * rotary.base_radius(),
            roller_radius_mm: MILLIMETRES * rotary.disc.follower.roller_radius(),
            max_lift_mm: MILLIMETRES * rotary.max_lift(),
            smallest_prime_radius_mm: rotary.smallest_prime_radius.map(|radius| MILLIMETRES * radius),
            area_mm2: face.map(|(area, _)| area),
            mass_kg: face.zip(weight).map(|((area, _), weight)| area * weight),
            centre_of_mass_mm: face.map(|(area, moment)| (moment / area).into()),
            unbalance_g_mm: face.zip(weight).map(|((_, moment), weight)| GRAMS * weight * moment.norm()),
        },
        law: LawReport {
            dx_max_mm: MILLIMETRES * dx_max,
            dx_max_at_x_mm: MILLIMETRES * dx_max_at_x,
            column_length_mm: MILLIMETRES * balance.column,
            piston_area_mm2: square_millimetres * rotary.cylinder.piston_area,
            bore_mm: MILLIMETRES * rotary.cylinder.bore(),
            start_slope: balance.start_slope,
            velocity_jump_mm_per_rad: MILLIMETRES * rotary.disc.law.velocity_jump(),
        },
        checks,
        outline: part.map(|part| outline_report(part, tolerance)),
        force: ForceReport {
            inertia_max_n: rotary.inertia_max(),
            residual_max_n,
            residual_share: residual_max_n / rotary.inertia_max(),
            residual_fixed_bottom_max_n: rotary.residual_fixed_bottom(),
            roller_force_max_n: rotary.roller_force_max(),
            torque_max_nm: rotary.torque_max(),
        },
        rolling,
        files: Vec::new(),
    }
}

fn outline_report(part: &Part, tolerance: f64) -> OutlineReport {
    let outline = &part.outline;
    let lines = outline.contour.vertices.iter().filter(|vertex| vertex.bulge == 0.0).count();
    let arcs = outline.contour.vertices.len() - lines;
    let worst_break = outline.contour.tangent_breaks().into_iter().map(f64::abs).fold(0.0, f64::max);
    #[expect(clippy::cast_precision_loss, reason = "a few thousand arcs")]
    let ratio = (outline.best_possible > 0.0).then(|| arcs as f64 / outline.best_possible);
    OutlineReport {
        arcs,
        lines,
        deviation_max_mm: outline.deviation,
        tangent_break_max_deg: worst_break.to_degrees(),
        tolerance_mm: MILLIMETRES * tolerance,
        arcs_best_possible: outline.best_possible,
        arcs_over_best_possible: ratio,
        length_mm: outline.contour.length(),
    }
}

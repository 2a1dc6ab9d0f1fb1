//! The report: everything that was solved, checked and written, as data.

use super::Part;
use super::outline::MILLIMETRES;
use crate::cam::Cam;
use crate::cam::plate::Plate;
use crate::cam::rotary::Rotary;
use crate::checks::Finding;
use crate::checks::rolling::Rolled;
use crate::law::translating::{EfficiencyModel, Exact, Motion, Side, Solver, Way};
use crate::machine::Machine;
use serde::Serialize;

/// Grams in a kilogram.
const GRAMS: f64 = 1e3;

/// Version of the form of the report.
const SCHEMA: u32 = 1;

/// The report of a cam. What a kind of cam does not have is left out.
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
    #[serde(skip_serializing_if = "Option::is_none")]
    pub prime_radius_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base_radius_mm: Option<f64>,
    pub roller_radius_mm: f64,
    pub max_lift_mm: f64,
    /// The smallest prime radius that keeps every limit, before rounding.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub smallest_prime_radius_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate: Option<PlateReport>,
    /// Of the metal: outline less bore.
    pub area_mm2: Option<f64>,
    pub mass_kg: Option<f64>,
    pub centre_of_mass_mm: Option<[f64; 2]>,
    /// Static unbalance about the shaft, with the holes that balance it, if any.
    pub unbalance_g_mm: Option<f64>,
}

/// Measures of a plate.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct PlateReport {
    pub length_mm: f64,
    pub height_mm: f64,
    pub thinnest_mm: f64,
    pub thinnest_at_x_mm: f64,
    /// Of the roller's centre from the bed's axis where Δx = 0: what the pitch curve of (21) starts from.
    pub axis_distance_mm: f64,
}

/// How equation (18) was solved.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct SolvedReport {
    pub solver: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stations: Option<u32>,
    /// Steps of the integrator.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<usize>,
    pub efficiency_model: &'static str,
    /// The way of the bed on which the forces balance.
    pub balance: &'static str,
    /// Where the law of the slope changes.
    pub breaks: Vec<BreakReport>,
}

/// A place where the law of the slope changes.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct BreakReport {
    pub x_mm: f64,
    /// What the bottom does from there on while x grows: "rising", "falling", or "stuck" where the lever sticks.
    pub then: &'static str,
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
    /// The slope dΔx/dx at the start of the reversal; c − 1 for a rotary cam.
    pub start_slope: f64,
    /// Jump of the bottom's velocity at the start of the reversal.
    pub velocity_jump_mm_per_rad: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub equation_18: Option<SolvedReport>,
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
    /// Of the law of a plate, while the bed is braked and while it is sent back, with shares of the largest inertia.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_braking_max_n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_braking_share: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_return_max_n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_return_share: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_return_at_x_mm: Option<f64>,
    /// Along the roller's path; with preload and inertia of the follower where they are given.
    pub roller_force_max_n: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_max_nm: Option<f64>,
}

/// Area, mass and centre of mass of a part.
struct Weighed {
    area_mm2: Option<f64>,
    mass_kg: Option<f64>,
    centre_of_mass_mm: Option<[f64; 2]>,
    unbalance_g_mm: Option<f64>,
}

fn weighed(machine: &Machine, part: Option<&Part>) -> Weighed {
    let face = part.map(Part::area_and_moment);
    // kg per mm², where there is a thickness.
    let weight = machine.cam.thickness.map(|thickness| thickness * machine.cam.density() / (MILLIMETRES * MILLIMETRES));
    Weighed {
        area_mm2: face.map(|(area, _)| area),
        mass_kg: face.zip(weight).map(|((area, _), weight)| area * weight),
        centre_of_mass_mm: face.map(|(area, moment)| (moment / area).into()),
        unbalance_g_mm: face.zip(weight).map(|((_, moment), weight)| GRAMS * weight * moment.norm()),
    }
}

/// The report of a rotary cam; `files` are named by whoever writes them.
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
    let weighed = weighed(&rotary.machine, part);
    let residual_max_n = rolling.as_ref().map_or_else(|| rotary.residual_max(), |rolled| rolled.residual_max_n);
    Report {
        schema: SCHEMA,
        command: "rotary",
        machine: rotary.machine.name.clone(),
        rpm: rotary.rpm,
        cam: CamReport {
            prime_radius_mm: Some(MILLIMETRES * rotary.curves.follower.prime_radius()),
            base_radius_mm: Some(MILLIMETRES * rotary.base_radius()),
            roller_radius_mm: MILLIMETRES * rotary.machine.roller.radius,
            max_lift_mm: MILLIMETRES * rotary.max_lift(),
            smallest_prime_radius_mm: rotary.smallest_prime_radius.map(|radius| MILLIMETRES * radius),
            plate: None,
            area_mm2: weighed.area_mm2,
            mass_kg: weighed.mass_kg,
            centre_of_mass_mm: weighed.centre_of_mass_mm,
            unbalance_g_mm: weighed.unbalance_g_mm,
        },
        law: LawReport {
            dx_max_mm: MILLIMETRES * dx_max,
            dx_max_at_x_mm: MILLIMETRES * dx_max_at_x,
            column_length_mm: MILLIMETRES * balance.column,
            piston_area_mm2: MILLIMETRES * MILLIMETRES * rotary.cylinder.piston_area,
            bore_mm: MILLIMETRES * rotary.cylinder.bore(),
            start_slope: balance.start_slope,
            velocity_jump_mm_per_rad: MILLIMETRES * rotary.curves.law.velocity_jump(),
            equation_18: None,
        },
        checks,
        outline: part.map(|part| outline_report(rotary, part, tolerance)),
        force: ForceReport {
            inertia_max_n: rotary.inertia_max(),
            residual_max_n,
            residual_share: residual_max_n / rotary.inertia_max(),
            residual_fixed_bottom_max_n: rotary.residual_fixed_bottom(),
            residual_braking_max_n: None,
            residual_braking_share: None,
            residual_return_max_n: None,
            residual_return_share: None,
            residual_return_at_x_mm: None,
            roller_force_max_n: rotary.roller_force_max(),
            torque_max_nm: Some(rotary.torque_max()),
        },
        rolling,
        files: Vec::new(),
    }
}

fn solved(plate: &Plate) -> SolvedReport {
    let mechanism = plate.mechanism();
    let motion = plate.curves.law.motion();
    let (solver, tolerance_mm, stations) = match plate.solver {
        Solver::Ode { tolerance } => ("ode", Some(MILLIMETRES * tolerance), None),
        Solver::Paper { stations } => ("paper", None, Some(stations)),
    };
    let then = |side: Side| match side {
        Side::Rising => "rising",
        Side::Falling => "falling",
        Side::Stuck => "stuck",
    };
    SolvedReport {
        solver,
        tolerance_mm,
        stations,
        steps: match motion {
            Motion::Ode(solution) => Some(solution.steps()),
            Motion::Paper(_) => None,
        },
        efficiency_model: match mechanism.model {
            EfficiencyModel::Consistent => "consistent",
            EfficiencyModel::Printed => "printed",
        },
        balance: match mechanism.exact {
            Exact::Braking => "braking",
            Exact::Return => "return",
            Exact::Mean => "mean",
        },
        breaks: motion.breaks().iter().map(|b| BreakReport { x_mm: MILLIMETRES * b.x, then: then(b.then) }).collect(),
    }
}

/// The report of a plate; `files` are named by whoever writes them.
#[must_use]
pub fn plate_report(
    plate: &Plate,
    part: Option<&Part>,
    rolling: Option<Rolled>,
    tolerance: f64,
    checks: Vec<Finding>,
) -> Report {
    let balance = &plate.mechanism().balance;
    let (dx_max_at_x, dx_max) = plate.largest_displacement();
    let weighed = weighed(&plate.machine, part);
    let ((braking, _), (back, back_at)) = (plate.residual_max(Way::Braking), plate.residual_max(Way::Return));
    let inertia = plate.inertia_max();
    let of_law = if plate.balanced_ways() == [Way::Return] { back } else { braking };
    let residual_max_n = rolling.as_ref().map_or(of_law, |rolled| rolled.residual_max_n);
    Report {
        schema: SCHEMA,
        command: "translating",
        machine: plate.machine.name.clone(),
        rpm: plate.rpm,
        cam: CamReport {
            prime_radius_mm: None,
            base_radius_mm: None,
            roller_radius_mm: MILLIMETRES * plate.data.roller_radius,
            max_lift_mm: MILLIMETRES * plate.max_lift(),
            smallest_prime_radius_mm: None,
            plate: Some(PlateReport {
                length_mm: MILLIMETRES * (plate.run_out().x - plate.start().x),
                height_mm: MILLIMETRES * plate.height,
                thinnest_mm: MILLIMETRES * plate.thinnest,
                thinnest_at_x_mm: MILLIMETRES * plate.thinnest_at,
                axis_distance_mm: MILLIMETRES * plate.curves.follower.axis_distance,
            }),
            area_mm2: weighed.area_mm2,
            mass_kg: weighed.mass_kg,
            centre_of_mass_mm: weighed.centre_of_mass_mm,
            unbalance_g_mm: None,
        },
        law: LawReport {
            dx_max_mm: MILLIMETRES * dx_max,
            dx_max_at_x_mm: MILLIMETRES * dx_max_at_x,
            column_length_mm: MILLIMETRES * balance.column,
            piston_area_mm2: MILLIMETRES * MILLIMETRES * plate.cylinder.piston_area,
            bore_mm: MILLIMETRES * plate.cylinder.bore(),
            start_slope: plate.curves.law.motion().at(0.0, false)[1],
            velocity_jump_mm_per_rad: MILLIMETRES * plate.stroke() * plate.curves.law.slope_jump(),
            equation_18: Some(solved(plate)),
        },
        checks,
        outline: part.map(|part| outline_report(plate, part, tolerance)),
        force: ForceReport {
            inertia_max_n: inertia,
            residual_max_n,
            residual_share: residual_max_n / inertia,
            residual_fixed_bottom_max_n: plate.residual_fixed_bottom(),
            residual_braking_max_n: Some(braking),
            residual_braking_share: Some(braking / inertia),
            residual_return_max_n: Some(back),
            residual_return_share: Some(back / inertia),
            residual_return_at_x_mm: Some(MILLIMETRES * back_at),
            roller_force_max_n: plate.roller_force_max(),
            torque_max_nm: None,
        },
        rolling,
        files: Vec::new(),
    }
}

fn outline_report(cam: &dyn Cam, part: &Part, tolerance: f64) -> OutlineReport {
    let outline = &part.outline;
    let lines = outline.contour.vertices.iter().filter(|vertex| vertex.bulge == 0.0).count();
    let arcs = outline.contour.vertices.len() - lines;
    // The corners of a plate's ends are meant.
    let breaks = outline.contour.tangent_breaks().into_iter().zip(&outline.contour.vertices);
    let smooth = breaks.filter(|(_, vertex)| !cam.ends_at(vertex.point / MILLIMETRES));
    let worst_break = smooth.map(|(turn, _)| turn.abs()).fold(0.0, f64::max);
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

//! The drawings of a conoid: a cut for each section, the flank, the point table and the report.

use super::flank::Flank;
use super::outline::{self, Fit, MILLIMETRES, OutlineError};
use super::{Part, Table, as_turned, bore, point_as_turned};
use crate::cam::between::Residual;
use crate::cam::conoid::{Conoid, Measures};
use crate::checks::Finding;
use crate::law::Law;
use rayon::prelude::*;
use serde::Serialize;

/// Columns behind the place along the axis and those a conoid shares with a disc cam.
const MORE_COLUMNS: [&str; 8] = [
    "rpm",
    "lift_per_z",
    "contact_x_mm",
    "contact_y_mm",
    "contact_z_mm",
    "axial_angle_deg",
    "principal_curvature_radius_mm",
    "axial_force_n",
];
/// How many columns of a disc cam a conoid shares: all but the force along the normal.
const SHARED: usize = 17;

/// Columns of the table, in order.
#[must_use]
pub fn columns() -> Vec<&'static str> {
    let shared = super::table::COLUMNS.into_iter().take(SHARED);
    std::iter::once("z_mm").chain(shared).chain(MORE_COLUMNS).collect()
}

/// The speeds that have a cut of their own, with their places along the axis (m); equal speeds have one.
#[must_use]
pub fn cuts(conoid: &Conoid) -> Vec<(f64, f64)> {
    let mut cuts: Vec<(f64, f64)> = conoid.speeds.iter().copied().zip(conoid.positions.iter().copied()).collect();
    cuts.dedup_by(|later, first| later.0 == first.0);
    cuts
}

/// The cut drawings within a tolerance (m), one for each speed.
///
/// # Errors
/// [`OutlineError`] when a section cannot be drawn.
pub fn sections(conoid: &Conoid, fit: impl Into<Fit>) -> Result<Vec<Part>, OutlineError> {
    let fit = fit.into();
    let machine = &conoid.machine;
    let section = |&(_, z): &(f64, f64)| {
        let outline = outline::section(conoid, z, fit)?;
        let contour = as_turned(machine, outline.contour);
        Ok(Part { outline: outline::Outline { contour, ..outline }, bore: bore(machine), balancing: None })
    };
    cuts(conoid).par_iter().map(section).collect()
}

/// `samples` rows for each speed, at 360 i/samples degrees.
#[must_use]
pub fn table(conoid: &Conoid, samples: u32) -> Table {
    let rows = |&(rpm, z): &(f64, f64)| -> Vec<Vec<f64>> {
        let Some(section) = conoid.speeds.iter().position(|speed| *speed == rpm).and_then(|i| conoid.sections.get(i))
        else {
            return Vec::new();
        };
        let plane = conoid.plane(z);
        let row = |i: u32| {
            let cam_deg = 360.0 * f64::from(i) / f64::from(samples);
            let (piece, angle) = section.locate(cam_deg.to_radians());
            let (state, lift) = (section.state(piece, angle), conoid.lift(piece, angle, z));
            let contact = conoid.contact(piece, angle, z);
            let plane = plane.contact(piece, angle);
            let cut = conoid.cut(piece, angle, z).map(|(frame, _)| frame);
            let machine = &conoid.machine;
            let pitch = point_as_turned(machine, contact.centre.xy() * MILLIMETRES);
            let touch = point_as_turned(machine, contact.point.xy() * MILLIMETRES);
            let profile = cut.map(|frame| point_as_turned(machine, frame.point * MILLIMETRES));
            let force = conoid.roller_force(section, rpm, piece, angle);
            let row = [
                MILLIMETRES * z,
                cam_deg,
                (cam_deg / machine.cam.turns_per_crank_turn) % 360.0,
                MILLIMETRES * state.overrun,
                MILLIMETRES * state.displacement,
                MILLIMETRES * lift[0][0].max(0.0),
                MILLIMETRES * lift[1][0],
                MILLIMETRES * lift[2][0],
                MILLIMETRES * lift[3][0],
                pitch.x,
                pitch.y,
                profile.map_or(f64::NAN, |p| p.x),
                profile.map_or(f64::NAN, |p| p.y),
                plane.pressure_angle.to_degrees(),
                MILLIMETRES / plane.pitch.curvature,
                cut.map_or(f64::NAN, |frame| MILLIMETRES / frame.curvature),
                force,
                force * lift[1][0],
                rpm,
                lift[0][1],
                touch.x,
                touch.y,
                MILLIMETRES * contact.point.z,
                libm::asin(-contact.normal.z).to_degrees(),
                MILLIMETRES / conoid.principal_curvatures(piece, angle, z).0,
                -force * lift[0][1],
            ];
            // A negative zero is zero.
            row.iter().map(|value| value + 0.0).collect()
        };
        (0..samples).map(row).collect()
    };
    Table { columns: columns(), rows: cuts(conoid).par_iter().flat_map(rows).collect() }
}

/// The report of a conoid.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct ConoidReport {
    pub schema: u32,
    pub command: &'static str,
    pub machine: String,
    /// Speeds of the sections.
    pub rpm: Vec<f64>,
    pub cam: ConoidCam,
    pub sections: Vec<SectionReport>,
    pub surface: SurfaceReport,
    /// What is left at the speeds between the sections.
    pub between: BetweenReport,
    pub checks: Vec<Finding>,
    /// The outlines of all sections together.
    pub outline: Option<OutlinesReport>,
    pub force: ConoidForce,
    pub files: Vec<String>,
}

/// The outlines of all sections together.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct OutlinesReport {
    pub arcs: usize,
    pub lines: usize,
    pub deviation_max_mm: f64,
    pub tangent_break_max_deg: f64,
}

/// Forces at the speeds of the sections, and what is left between them.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct ConoidForce {
    pub inertia_max_n: f64,
    pub residual_max_n: f64,
    pub axial_force_max_n: f64,
}

/// Measures of a conoid.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct ConoidCam {
    pub prime_radius_mm: f64,
    pub base_radius_mm: f64,
    pub roller_radius_mm: f64,
    /// Largest lift over all sections, from their common lowest point.
    pub max_lift_mm: f64,
    pub smallest_prime_radius_mm: Option<f64>,
    pub z_min_mm: f64,
    pub z_max_mm: f64,
    /// Of the metal; `None` when no flank was drawn.
    pub volume_mm3: Option<f64>,
    pub mass_kg: Option<f64>,
}

/// One section.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct SectionReport {
    pub rpm: f64,
    pub z_mm: f64,
    pub column_length_mm: f64,
    pub start_slope: f64,
    pub dx_max_mm: f64,
    pub dx_max_at_x_mm: f64,
    pub inertia_max_n: f64,
    pub arcs: Option<usize>,
    pub area_mm2: Option<f64>,
    pub deviation_max_mm: Option<f64>,
    /// By how much a plane offset of this section's pitch curve would miss the section.
    pub plane_offset_error_mm: f64,
}

/// The surface.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct SurfaceReport {
    /// Largest distance of the contact from the roller's plane, along the axis.
    pub axial_wander_mm: f64,
    pub axial_wander_cam_deg: f64,
    pub axial_wander_z_mm: f64,
    /// Largest force the drive of the shift must hold.
    pub axial_force_max_n: f64,
    pub plane_offset_error_max_mm: f64,
    pub patches: Option<usize>,
    pub deviation_max_mm: Option<f64>,
}

/// Between the sections.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct BetweenReport {
    pub residual_max_n: f64,
    pub rpm: f64,
    pub cam_deg: f64,
    /// What straight strips from section to section would leave.
    pub residual_straight_strips_max_n: f64,
}

/// What the report is made of beside the cam.
#[derive(Debug, Clone, Copy)]
pub struct Found<'a> {
    /// Cut drawings, when there are some.
    pub parts: Option<&'a [Part]>,
    /// The flank, when it was asked for.
    pub flank: Option<&'a Flank>,
    /// Between the sections, by splines and by straight strips.
    pub between: (Residual, Residual),
    /// What was found of the surface.
    pub measures: &'a Measures,
}

/// The report; `files` are named by whoever writes them.
#[must_use]
pub fn report(conoid: &Conoid, found: &Found<'_>, checks: Vec<Finding>) -> ConoidReport {
    let cuts = cuts(conoid);
    let errors: Vec<f64> = cuts.par_iter().map(|(_, z)| conoid.plane_offset_error(*z)).collect();
    let section = |(index, (rpm, z)): (usize, &(f64, f64))| {
        let law = conoid.speeds.iter().position(|speed| speed == rpm).and_then(|i| conoid.sections.get(i))?;
        let balance = law.law().balance;
        let (dx_max_at_x, dx_max) = balance.largest_displacement();
        let part = found.parts.and_then(|parts| parts.get(index));
        Some(SectionReport {
            rpm: *rpm,
            z_mm: MILLIMETRES * z,
            column_length_mm: MILLIMETRES * balance.column,
            start_slope: balance.start_slope,
            dx_max_mm: MILLIMETRES * dx_max,
            dx_max_at_x_mm: MILLIMETRES * dx_max_at_x,
            inertia_max_n: conoid.cylinder.largest_load(&balance),
            arcs: part.map(|part| part.outline.contour.vertices.len()),
            area_mm2: part.map(|part| part.area_and_moment().0),
            deviation_max_mm: part.map(|part| part.outline.deviation),
            plane_offset_error_mm: MILLIMETRES * errors.get(index).copied().unwrap_or(f64::NAN),
        })
    };
    let (low, high) = conoid.ends();
    let volume = found.flank.map(|flank| {
        let hole = bore(&conoid.machine).map_or(0.0, |hole| hole.contour().area_and_centroid().0);
        flank.volume - hole * MILLIMETRES * (high - low)
    });
    let (left, straight) = found.between;
    let degrees = |angle: f64| crate::cam::Place::at_angle(angle).cam_deg.unwrap_or(0.0);
    ConoidReport {
        schema: 1,
        command: "conoid",
        machine: conoid.machine.name.clone(),
        rpm: cuts.iter().map(|(rpm, _)| *rpm).collect(),
        cam: ConoidCam {
            prime_radius_mm: MILLIMETRES * conoid.follower.prime_radius(),
            base_radius_mm: MILLIMETRES * conoid.base_radius(),
            roller_radius_mm: MILLIMETRES * conoid.machine.roller.radius,
            max_lift_mm: MILLIMETRES * conoid.max_lift(),
            smallest_prime_radius_mm: conoid.smallest_prime_radius.map(|radius| MILLIMETRES * radius),
            z_min_mm: MILLIMETRES * low,
            z_max_mm: MILLIMETRES * high,
            volume_mm3: volume,
            mass_kg: volume.map(|volume| 1e-9 * volume * conoid.machine.cam.density()),
        },
        sections: cuts.iter().enumerate().filter_map(section).collect(),
        surface: SurfaceReport {
            axial_wander_mm: MILLIMETRES * found.measures.wander.value,
            axial_wander_cam_deg: degrees(found.measures.wander.angle),
            axial_wander_z_mm: MILLIMETRES * found.measures.wander.z,
            axial_force_max_n: found.measures.axial_force.value,
            plane_offset_error_max_mm: MILLIMETRES * errors.iter().copied().fold(0.0, f64::max),
            patches: found.flank.map(|flank| flank.patches.len()),
            deviation_max_mm: found.flank.map(|flank| flank.deviation),
        },
        between: BetweenReport {
            residual_max_n: left.force,
            rpm: left.rpm,
            cam_deg: degrees(left.angle),
            residual_straight_strips_max_n: straight.force,
        },
        checks,
        outline: found.parts.map(outlines),
        force: ConoidForce {
            inertia_max_n: conoid.machine.bed.largest_inertia(conoid.speeds.last().copied().unwrap_or(0.0)),
            residual_max_n: left.force,
            axial_force_max_n: found.measures.axial_force.value,
        },
        files: Vec::new(),
    }
}

fn outlines(parts: &[Part]) -> OutlinesReport {
    let vertices = parts.iter().flat_map(|part| &part.outline.contour.vertices);
    let (lines, arcs): (Vec<&crate::contour::Vertex>, Vec<&crate::contour::Vertex>) =
        vertices.partition(|vertex| vertex.bulge == 0.0);
    let breaks = parts.iter().flat_map(|part| part.outline.contour.tangent_breaks());
    OutlinesReport {
        arcs: arcs.len(),
        lines: lines.len(),
        deviation_max_mm: parts.iter().map(|part| part.outline.deviation).fold(0.0, f64::max),
        tangent_break_max_deg: breaks.map(f64::abs).fold(0.0, f64::max).to_degrees(),
    }
}

//! The point table: one list of columns, walked for every kind of cam.
//!
//! A row holds what a cam knows at one place, in the units of the table; what a cam does not have stays empty, and so does the
//! column. A new column is one function and one line in [`COLUMNS`].

use crate::motion::{Jet, State};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::TAU;

/// What is known at one place of a cam: millimetres, degrees, newtons; derivatives by the parameter in radians.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Row {
    /// Cam angle.
    pub cam_deg: Option<f64>,
    /// Position in a motion program, metres or radians.
    pub position: Option<f64>,
    /// Lift in metres, of a cam that turns.
    pub lift: Option<Jet>,
    /// Piece of the motion, and the parameter in it, of which the lift of a cam that turns is.
    pub at: Option<(usize, f64)>,
    /// Lift in radians, of a cam under a swinging follower.
    pub swing: Option<Jet>,
    /// Bed, bottom and crank of a press.
    pub bed: Option<BedRow>,
    /// The press under a cam that turns, as its forces are computed from.
    pub state: Option<State>,
    /// A point of the follower's curve.
    pub curve: Option<Vector2<f64>>,
    /// A point of the profile.
    pub profile: Option<Vector2<f64>>,
    /// Angle between the follower's path and the normal.
    pub pressure_angle_deg: Option<f64>,
    /// Signed radius of curvature of the follower's curve, convex positive.
    pub curve_radius: Option<f64>,
    /// The same of the profile.
    pub profile_radius: Option<f64>,
    /// Forces of a turning cam.
    pub force: Option<ForceRow>,
    /// The force balance of a press.
    pub balance: Option<BalanceRow>,
    /// What only a plate on the bed has.
    pub plate: Option<PlateRow>,
    /// What only a body has whose sections differ.
    pub surface: Option<SurfaceRow>,
    /// Velocity and acceleration of the follower on the written outline, by the angle of the shaft; NaN where it is not in
    /// touch.
    pub cut: Option<[f64; 2]>,
    /// Size of the residual force with the lift as cut, N, of a cam of a press that turns.
    pub residual_cut: Option<f64>,
    /// Torque of a second disc on the same shaft, N·m.
    pub torque_of_second: Option<f64>,
    /// Where a flat face is touched, from its stem or its pivot.
    pub face: Option<f64>,
    /// Whether the follower swings.
    pub swings: bool,
}

/// The press at a place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BedRow {
    /// Crank angle in [0, 360), of a cam that turns.
    pub crank_deg: Option<f64>,
    /// Overrun of the bed.
    pub x: f64,
    /// Δx of the bottom.
    pub dx: f64,
}

/// Forces of a turning cam at a place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ForceRow {
    /// Along the follower's path.
    pub path: f64,
    /// On the camshaft, N·m.
    pub torque: f64,
    /// Along the normal, where it is known.
    pub contact: Option<f64>,
}

/// The force balance of a press at a place, N; 0 outside the reversal.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BalanceRow {
    /// Inertia force of the bed, (1).
    pub inertia: f64,
    /// Force of the air with this cam.
    pub air: f64,
    /// Force of the air of a plain buffer, (9): fixed bottom, column by (7) at this speed.
    pub air_fixed_bottom: f64,
    /// Inertia less air, where nothing else takes part in the balance.
    pub residual: Option<f64>,
}

/// A plate at a place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlateRow {
    /// Lift of the bottom by the angle of the crank, m.
    pub lift: Jet,
    /// ψ of (19).
    pub psi_deg: f64,
    /// α of (21).
    pub alpha_deg: f64,
    /// dΔx/dx.
    pub slope: f64,
    /// Normal force of one roller while the bed is braked, (17).
    pub roller_force: f64,
    /// Residual force of (18) on the way back.
    pub residual_return: f64,
    /// Residual force of (18) while the bed is braked.
    pub residual_braking: f64,
}

/// A surface at a place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SurfaceRow {
    /// Place along the axis.
    pub z: f64,
    /// Speed of its section, rpm.
    pub rpm: f64,
    /// Slope of the lift along the axis.
    pub lift_per_z: f64,
    /// Where the sphere touches.
    pub contact: Vector3<f64>,
    /// How far the normal leans along the axis.
    pub axial_angle_deg: f64,
    /// Sharpest principal radius of curvature of the pitch surface.
    pub principal_radius: f64,
    /// Component of the force along the axis.
    pub axial_force: f64,
}

/// A column: its name, with its unit, and its value; `None` for a cam that does not have it.
pub type Column = (&'static str, fn(&Row) -> Option<f64>);

/// Every column, in the order of the table. Two entries of one name stand where two kinds of cam have it at different
/// places; a cam has one of them.
pub const COLUMNS: &[Column] = &[
    ("z_mm", |row| Some(row.surface?.z)),
    ("cam_deg", |row| row.cam_deg),
    ("crank_deg", |row| row.bed?.crank_deg),
    ("x_mm", |row| Some(row.bed?.x)),
    ("dx_mm", |row| Some(row.bed?.dx)),
    ("psi_deg", |row| Some(row.plate?.psi_deg)),
    ("alpha_deg", |row| Some(row.plate?.alpha_deg)),
    ("position_mm", |row| row.lift.and(row.position).map(|position| 1e3 * position)),
    ("position_deg", |row| row.swing.and(row.position).map(f64::to_degrees)),
    // Rounding at the lowest point must not give a negative lift.
    ("lift_mm", |row| Some(1e3 * row.lift?.s.max(0.0))),
    ("lift_deg", |row| Some(row.swing?.s.max(0.0).to_degrees())),
    ("velocity_rad_per_rad", |row| Some(row.swing?.ds)),
    ("acceleration_rad_per_rad2", |row| Some(row.swing?.dds)),
    ("jerk_rad_per_rad3", |row| Some(row.swing?.ddds)),
    ("velocity_mm_per_rad", |row| Some(1e3 * row.lift?.ds)),
    ("acceleration_mm_per_rad2", |row| Some(1e3 * row.lift?.dds)),
    ("jerk_mm_per_rad3", |row| Some(1e3 * row.lift?.ddds)),
    ("pitch_x_mm", |row| Some(row.curve?.x)),
    ("pitch_y_mm", |row| Some(row.curve?.y)),
    ("profile_x_mm", |row| Some(row.profile?.x)),
    ("profile_y_mm", |row| Some(row.profile?.y)),
    ("roller_force_n", |row| Some(row.plate?.roller_force)),
    ("residual_return_n", |row| Some(row.plate?.residual_return)),
    ("residual_braking_n", |row| Some(row.plate?.residual_braking)),
    ("slope", |row| Some(row.plate?.slope)),
    ("pressure_angle_deg", |row| row.pressure_angle_deg),
    ("pitch_curvature_radius_mm", |row| row.curve_radius),
    ("profile_curvature_radius_mm", |row| row.profile_radius),
    ("roller_force_n", |row| Some(row.force?.path)),
    ("torque_nm", |row| Some(row.force?.torque)),
    ("contact_force_n", |row| row.force?.contact),
    ("rpm", |row| Some(row.surface?.rpm)),
    ("lift_per_z", |row| Some(row.surface?.lift_per_z)),
    ("contact_x_mm", |row| Some(row.surface?.contact.x)),
    ("contact_y_mm", |row| Some(row.surface?.contact.y)),
    ("contact_z_mm", |row| Some(row.surface?.contact.z)),
    ("axial_angle_deg", |row| Some(row.surface?.axial_angle_deg)),
    ("principal_curvature_radius_mm", |row| Some(row.surface?.principal_radius)),
    ("axial_force_n", |row| Some(row.surface?.axial_force)),
    ("velocity_cut_mm_per_rad", |row| row.cut.filter(|_| !row.swings).map(|[velocity, _]| 1e3 * velocity)),
    ("acceleration_cut_mm_per_rad2", |row| row.cut.filter(|_| !row.swings).map(|[_, acceleration]| 1e3 * acceleration)),
    ("velocity_cut_rad_per_rad", |row| row.cut.filter(|_| row.swings).map(|[velocity, _]| velocity)),
    ("acceleration_cut_rad_per_rad2", |row| row.cut.filter(|_| row.swings).map(|[_, acceleration]| acceleration)),
    ("inertia_n", |row| Some(row.balance?.inertia)),
    ("air_n", |row| Some(row.balance?.air)),
    ("air_fixed_bottom_n", |row| Some(row.balance?.air_fixed_bottom)),
    ("residual_n", |row| row.balance?.residual),
    ("residual_cut_n", |row| row.residual_cut),
    ("compensator_torque_nm", |row| row.torque_of_second),
    ("torque_left_nm", |row| Some(row.force?.torque + row.torque_of_second?)),
    ("lift_mm", |row| Some(1e3 * row.plate?.lift.s.max(0.0))),
    ("velocity_mm_per_rad", |row| Some(1e3 * row.plate?.lift.ds)),
    ("acceleration_mm_per_rad2", |row| Some(1e3 * row.plate?.lift.dds)),
    ("jerk_mm_per_rad3", |row| Some(1e3 * row.plate?.lift.ddds)),
    ("face_mm", |row| row.face),
];

/// In the names of columns of what the follower does on the outline as cut: nothing where it is not in touch.
const AS_CUT: &str = "_cut_";

/// A table of numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Names of the columns, with their units.
    pub columns: Vec<&'static str>,
    /// Rows, each as long as `columns`.
    pub rows: Vec<Vec<f64>>,
    /// Of each column whether a row may have no value in it, which is NaN then.
    pub may_lack: Vec<bool>,
    /// A column of words before the others, with its name: a word for each row.
    pub words: Option<(&'static str, Vec<&'static str>)>,
}

/// The columns that a cam has.
#[must_use]
pub fn columns(rows: &[Row]) -> Vec<&'static Column> {
    let has = |column: &&Column| rows.first().is_some_and(|row| (column.1)(row).is_some());
    COLUMNS.iter().filter(has).collect()
}

/// The value of a row in a column, NaN where there is none.
#[must_use]
pub fn value(row: &Row, (_, of): &Column) -> f64 {
    // A negative zero is zero.
    of(row).unwrap_or(f64::NAN) + 0.0
}

/// Whether a row may have no value in a column.
#[must_use]
pub fn may_lack((name, _): &Column) -> bool {
    name.contains(AS_CUT)
}

impl Table {
    /// The rows of a cam under the columns that it has.
    #[must_use]
    pub fn of(rows: &[Row]) -> Self {
        let columns = columns(rows);
        Self {
            columns: columns.iter().map(|(name, _)| *name).collect(),
            rows: rows.iter().map(|row| columns.iter().map(|column| value(row, column)).collect()).collect(),
            may_lack: columns.iter().map(|column| may_lack(column)).collect(),
            words: None,
        }
    }

    /// Rows of anything but a cam, under the names of what is told of each.
    #[must_use]
    pub fn listed<T>(told: &[Told<T>], rows: &[T]) -> Self {
        let values = |row: &T| told.iter().map(|(_, value)| value(row) + 0.0).collect();
        Self {
            columns: told.iter().map(|(name, _)| *name).collect(),
            rows: rows.iter().map(values).collect(),
            may_lack: vec![true; told.len()],
            words: None,
        }
    }
}

/// The name of a value with its unit, and the value of a row.
pub type Told<T> = (&'static str, fn(&T) -> f64);

/// Where a row of a turning cam's table stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turned {
    /// Cam angle, degrees in [0, 360).
    pub cam_deg: f64,
    /// The same in radians: at the start of a lobe the very number at which its motion starts.
    pub angle: f64,
    /// Crank angle of a cam with a lobe for each turn of the crank, degrees in [0, 360).
    pub crank_deg: f64,
}

/// The row `index` of `rows` in a turn of a cam of so many lobes, all at least 1. Whole turns of the crank are taken off as
/// whole numbers: an angle in degrees would lose the round ones.
#[must_use]
pub fn turned(index: u32, rows: u32, lobes: u32) -> Turned {
    let (rows, lobes) = (rows.max(1), lobes.max(1));
    let degrees = |index: f64| 360.0 * index / f64::from(rows);
    let (whole, part) = {
        let (turns, each) = (u64::from(index) * u64::from(lobes), u64::from(rows));
        (turns / each, turns % each)
    };
    #[expect(clippy::cast_precision_loss, reason = "fewer than 2^32 rows and lobes")]
    let (whole, crank_deg) = (whole as f64, degrees(part as f64));
    let angle = TAU * whole / f64::from(lobes) + crank_deg.to_radians() / f64::from(lobes);
    Turned { cam_deg: degrees(f64::from(index)), angle, crank_deg }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_lobes_count_the_crank_in_whole_turns() {
        for (rows, lobes) in [(720, 1), (720, 3), (700, 7), (17, 4), (1, 2)] {
            for index in 0..rows {
                let at = turned(index, rows, lobes);
                assert!((0.0..360.0).contains(&at.crank_deg) && (0.0..360.0).contains(&at.cam_deg), "{at:?}");
                assert!((at.angle - at.cam_deg.to_radians()).abs() < 2e-15, "{at:?}");
                let turns = (f64::from(lobes) * at.cam_deg - at.crank_deg) / 360.0;
                assert!((turns - turns.round()).abs() < 1e-14 * f64::from(lobes), "{at:?}");
            }
        }
        let third = turned(240, 720, 3);
        assert_eq!((third.cam_deg, third.crank_deg, third.angle), (120.0, 0.0, TAU / 3.0));
    }

    /// A name stands twice only for cams that cannot be the same.
    #[test]
    fn a_cam_has_every_column_once() {
        let turning = Row {
            cam_deg: Some(1.0),
            position: Some(1.0),
            lift: Some(Jet::default()),
            at: None,
            swing: None,
            bed: Some(BedRow { crank_deg: Some(1.0), ..BedRow::default() }),
            state: None,
            curve: Some(Vector2::zeros()),
            profile: Some(Vector2::zeros()),
            pressure_angle_deg: Some(1.0),
            curve_radius: Some(1.0),
            profile_radius: Some(1.0),
            force: Some(ForceRow { contact: Some(1.0), ..ForceRow::default() }),
            balance: Some(BalanceRow { residual: Some(1.0), ..BalanceRow::default() }),
            plate: None,
            surface: Some(SurfaceRow::default()),
            cut: Some([1.0; 2]),
            residual_cut: Some(1.0),
            torque_of_second: Some(1.0),
            face: Some(1.0),
            swings: false,
        };
        let plate = Row { lift: None, force: None, plate: Some(PlateRow::default()), ..turning };
        let swinging = Row { lift: None, swing: Some(Jet::default()), swings: true, ..turning };
        let mut all: Vec<&str> = Vec::new();
        for row in [turning, plate, swinging] {
            let columns = Table::of(&[row]).columns;
            let mut names = columns.clone();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), columns.len(), "{columns:?}");
            all.extend(names);
        }
        assert!(COLUMNS.iter().all(|(name, _)| all.contains(name)), "every column belongs to some cam");
        assert!(Table::of(&[]).columns.is_empty());
    }
}

//! The columns that the cams of a press add to the table.

use camgen_cams::table::AddedColumn;
use camgen_kernel::geometry::MILLIMETRES;

const CRANK: AddedColumn = AddedColumn { name: "crank_deg", after: "cam_deg" };
const OVERRUN: AddedColumn = AddedColumn { name: "x_mm", after: "cam_deg" };
const BOTTOM: AddedColumn = AddedColumn { name: "dx_mm", after: "cam_deg" };
const PSI: AddedColumn = AddedColumn { name: "psi_deg", after: "cam_deg" };
const ALPHA: AddedColumn = AddedColumn { name: "alpha_deg", after: "cam_deg" };
const ROLLER_FORCE: AddedColumn = AddedColumn { name: "roller_force_n", after: "profile_y_mm" };
const RESIDUAL_RETURN: AddedColumn = AddedColumn { name: "residual_return_n", after: "profile_y_mm" };
const RESIDUAL_BRAKING: AddedColumn = AddedColumn { name: "residual_braking_n", after: "profile_y_mm" };
const SLOPE: AddedColumn = AddedColumn { name: "slope", after: "profile_y_mm" };
const INERTIA: AddedColumn = AddedColumn { name: "inertia_n", after: "acceleration_cut_rad_per_rad2" };
const AIR: AddedColumn = AddedColumn { name: "air_n", after: "acceleration_cut_rad_per_rad2" };
const AIR_FIXED_BOTTOM: AddedColumn =
    AddedColumn { name: "air_fixed_bottom_n", after: "acceleration_cut_rad_per_rad2" };
const RESIDUAL: AddedColumn = AddedColumn { name: "residual_n", after: "acceleration_cut_rad_per_rad2" };
const LIFT: AddedColumn = AddedColumn { name: "lift_mm", after: "torque_left_nm" };
const VELOCITY: AddedColumn = AddedColumn { name: "velocity_mm_per_rad", after: "torque_left_nm" };
const ACCELERATION: AddedColumn = AddedColumn { name: "acceleration_mm_per_rad2", after: "torque_left_nm" };
const JERK: AddedColumn = AddedColumn { name: "jerk_mm_per_rad3", after: "torque_left_nm" };

/// Cubic millimetres in a cubic metre.
pub(super) const CUBIC: f64 = MILLIMETRES * MILLIMETRES * MILLIMETRES;

/// Columns of a row, with their values.
pub type ColumnValues = Vec<(&'static AddedColumn, f64)>;

/// Crank angle (deg, of a cam that turns), overrun of the bed and Δx of the bottom, mm.
pub(super) fn of_bed(crank_deg: Option<f64>, x: f64, dx: f64) -> ColumnValues {
    let crank = crank_deg.map(|crank| (&CRANK, crank));
    crank.into_iter().chain([(&OVERRUN, x), (&BOTTOM, dx)]).collect()
}

/// The force balance of a press in one row, N; 0 outside the reversal.
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

impl BalanceRow {
    /// Its columns.
    #[must_use]
    pub fn columns(&self) -> ColumnValues {
        let forces = [(&INERTIA, self.inertia), (&AIR, self.air), (&AIR_FIXED_BOTTOM, self.air_fixed_bottom)];
        forces.into_iter().chain(self.residual.map(|residual| (&RESIDUAL, residual))).collect()
    }
}

/// A wedge in one row.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WedgeRow {
    /// Lift of the bottom by the angle of the crank, m.
    pub lift: camgen_kernel::motion::Jet,
    /// ψ of (19).
    pub psi_deg: f64,
    /// α of (21).
    pub alpha_deg: f64,
    /// dΔx/dx.
    pub slope: f64,
    /// Normal force of one roller while the bed is braked, (17).
    pub roller_force: f64,
    /// Residual force of (18) on the return.
    pub residual_return: f64,
    /// Residual force of (18) while the bed is braked.
    pub residual_braking: f64,
}

impl WedgeRow {
    /// Its columns.
    #[must_use]
    pub fn columns(&self) -> ColumnValues {
        let lift = &self.lift;
        vec![
            (&PSI, self.psi_deg),
            (&ALPHA, self.alpha_deg),
            (&ROLLER_FORCE, self.roller_force),
            (&RESIDUAL_RETURN, self.residual_return),
            (&RESIDUAL_BRAKING, self.residual_braking),
            (&SLOPE, self.slope),
            (&LIFT, 1e3 * lift.s.max(0.0)),
            (&VELOCITY, 1e3 * lift.ds),
            (&ACCELERATION, 1e3 * lift.dds),
            (&JERK, 1e3 * lift.ddds),
        ]
    }
}

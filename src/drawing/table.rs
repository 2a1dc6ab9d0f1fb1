//! Point tables.

use super::outline::MILLIMETRES;
use super::point_as_turned;
use crate::cam::plate::Plate;
use crate::cam::rotary::Rotary;
use crate::follower::Follower;
use crate::law::Law;
use crate::law::translating::Way;

/// Columns of the table of a disc cam, in order.
pub const COLUMNS: [&str; 18] = [
    "cam_deg",
    "crank_deg",
    "x_mm",
    "dx_mm",
    "lift_mm",
    "velocity_mm_per_rad",
    "acceleration_mm_per_rad2",
    "jerk_mm_per_rad3",
    "pitch_x_mm",
    "pitch_y_mm",
    "profile_x_mm",
    "profile_y_mm",
    "pressure_angle_deg",
    "pitch_curvature_radius_mm",
    "profile_curvature_radius_mm",
    "roller_force_n",
    "torque_nm",
    "contact_force_n",
];

/// Columns of the table of a plate, in order.
pub const PLATE_COLUMNS: [&str; 15] = [
    "x_mm",
    "dx_mm",
    "psi_deg",
    "alpha_deg",
    "pitch_x_mm",
    "pitch_y_mm",
    "profile_x_mm",
    "profile_y_mm",
    "roller_force_n",
    "residual_return_n",
    "residual_braking_n",
    "slope",
    "pressure_angle_deg",
    "pitch_curvature_radius_mm",
    "profile_curvature_radius_mm",
];

/// A table of numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Names of the columns, with their units.
    pub columns: Vec<&'static str>,
    /// Rows, each as long as `columns`.
    pub rows: Vec<Vec<f64>>,
}

/// `samples` rows over one cam turn, at 360 i/samples degrees. At a break of the law the row belongs to the later piece.
#[must_use]
pub fn table(rotary: &Rotary, samples: u32) -> Table {
    let row = |i: u32| {
        let cam_deg = 360.0 * f64::from(i) / f64::from(samples);
        let (piece, angle) = rotary.curves.law.locate(cam_deg.to_radians());
        let contact = rotary.curves.contact(piece, angle);
        let state = rotary.curves.law.state(piece, angle);
        let profile = contact.pitch.offset_inward(rotary.curves.follower.roller_radius());
        let pitch_point = point_as_turned(&rotary.machine, contact.pitch.point * MILLIMETRES);
        let profile_point = point_as_turned(&rotary.machine, profile.point * MILLIMETRES);
        let force = rotary.roller_force(piece, angle);
        let row = [
            cam_deg,
            crank_degrees(cam_deg, rotary.machine.cam.turns_per_crank_turn),
            MILLIMETRES * state.overrun,
            MILLIMETRES * state.displacement,
            MILLIMETRES * contact.lift.s.max(0.0),
            MILLIMETRES * contact.lift.ds,
            MILLIMETRES * contact.lift.dds,
            MILLIMETRES * contact.lift.ddds,
            pitch_point.x,
            pitch_point.y,
            profile_point.x,
            profile_point.y,
            contact.pressure_angle.to_degrees(),
            MILLIMETRES / contact.pitch.curvature,
            MILLIMETRES / profile.curvature,
            force,
            rotary.torque(piece, angle),
            force / libm::cos(contact.pressure_angle),
        ];
        // A negative zero is zero.
        row.iter().map(|value| value + 0.0).collect()
    };
    Table { columns: COLUMNS.to_vec(), rows: (0..samples).map(row).collect() }
}

/// `samples` + 1 rows over the overrun, at x = r i/samples with both ends; points of the upper flank.
#[must_use]
pub fn plate_table(plate: &Plate, samples: u32) -> Table {
    let row = |i: u32| {
        let x_mm = MILLIMETRES * plate.stroke() * (f64::from(i) / f64::from(samples));
        let (piece, x) = plate.curves.law.locate(x_mm / MILLIMETRES);
        let bottom = plate.curves.law.bottom(piece, x);
        let contact = plate.curves.contact(piece, x);
        let profile = contact.pitch.offset_inward(plate.data.roller_radius);
        let row = [
            x_mm,
            MILLIMETRES * bottom.s,
            plate.mechanism().psi(bottom.s).to_degrees(),
            plate.mechanism().slope_angle(bottom.s, bottom.ds).to_degrees(),
            MILLIMETRES * contact.pitch.point.x,
            -MILLIMETRES * contact.pitch.point.y,
            MILLIMETRES * profile.point.x,
            -MILLIMETRES * profile.point.y,
            plate.roller_force(piece, x, Way::Braking),
            plate.residual(piece, x, Way::Return),
            plate.residual(piece, x, Way::Braking),
            bottom.ds,
            contact.pressure_angle.to_degrees(),
            MILLIMETRES / contact.pitch.curvature,
            MILLIMETRES / profile.curvature,
        ];
        // A negative zero is zero.
        row.iter().map(|value| value + 0.0).collect()
    };
    Table { columns: PLATE_COLUMNS.to_vec(), rows: (0..=samples).map(row).collect() }
}

/// Crank angle in [0, 360) from the cam angle, without a detour over radians that would lose the round numbers.
fn crank_degrees(cam_deg: f64, ratio: f64) -> f64 {
    (cam_deg / ratio) % 360.0
}

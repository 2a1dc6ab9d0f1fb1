//! The result of rolling the follower on a written outline.

use super::{AsCutError, Place};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// The result of rolling the follower on a written outline.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rolled {
    /// Number of places at which the follower was placed.
    pub places: usize,
    /// Segments it rolled on.
    pub segments: usize,
    /// Gap of largest size along the normal, mm, signed: positive where metal is missing.
    pub gap_mm: f64,
    /// Where it is.
    #[serde(flatten, serialize_with = "gap_place")]
    pub gap_at: Place,
    /// Lift error of largest size, mm; `None` where the follower never touches along its path.
    pub lift_error_max_mm: Option<f64>,
    /// 99 of 100 lift errors are smaller, mm.
    pub lift_error_q99_mm: Option<f64>,
    /// Places at which the follower is within the tolerance of two separate places of the outline.
    pub double_contacts: usize,
    /// The first of them.
    #[serde(flatten, serialize_with = "double_contact_place")]
    pub double_contact_at: Option<Place>,
    /// Chords of the second measurement.
    pub chords: usize,
    /// Their largest distance from the arcs, mm.
    pub chord_sagitta_mm: f64,
    /// Largest difference between the two measurements, mm.
    pub chord_difference_mm: f64,
    /// Largest residual force over the reversal with the lift as rolled, N; 0 without a load.
    pub residual_max_n: f64,
    /// Where it is.
    #[serde(flatten, serialize_with = "residual_place")]
    pub residual_at: Place,
    /// Velocity and acceleration as cut; `None` where the follower never touches.
    #[serde(flatten)]
    pub as_cut: Option<AsCutError>,
}

/// A place under names of its own: `gap_cam_deg` of a disc, `gap_x_mm` of a plate.
fn serialize_place<S: Serializer>(place: Place, [angle, overrun]: [&str; 2], serializer: S) -> Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(None)?;
    match place.x_mm {
        Some(x) => map.serialize_entry(overrun, &x)?,
        None => map.serialize_entry(angle, &place.cam_deg)?,
    }
    map.end()
}

fn gap_place<S: Serializer>(place: &Place, serializer: S) -> Result<S::Ok, S::Error> {
    serialize_place(*place, ["gap_cam_deg", "gap_x_mm"], serializer)
}

#[expect(clippy::ref_option, reason = "the signature that serde requires")]
fn double_contact_place<S: Serializer>(place: &Option<Place>, serializer: S) -> Result<S::Ok, S::Error> {
    serialize_place(place.unwrap_or_default(), ["double_contact_cam_deg", "double_contact_x_mm"], serializer)
}

fn residual_place<S: Serializer>(place: &Place, serializer: S) -> Result<S::Ok, S::Error> {
    serialize_place(*place, ["residual_cam_deg", "residual_x_mm"], serializer)
}

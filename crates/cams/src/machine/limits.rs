//! The limits of a cam.

use super::material::{CamMaterial, Material};
use camgen_kernel::document::Presence::{Default, Optional};
use camgen_kernel::document::cams::{MAKE, WITH_A_RATED_ROLLER};
use camgen_kernel::document::range::{HIGHEST_STRESS, LARGEST_NUMBER, LONGEST};
use camgen_kernel::document::{
    Field, Input, Key, KeySection, LengthAngleOrShare, LengthOrAngle, Occurrence, Reader, TableReader, above, within,
};
use camgen_kernel::follower::{Element, Follower};
use camgen_kernel::motion::Quantity;
use camgen_kernel::motion::program::keys::SECTION as MOTION;
use camgen_kernel::units::Dimension::{Angle, Length, Pressure};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// Customary largest pressures in a line of contact with a steel roller, Pa: hardened steel, grey cast iron, tin bronze, a
/// wrought aluminium alloy.
const LINE_STEEL: f64 = 1500e6;
const LINE_CAST_IRON: f64 = 700e6;
const LINE_BRONZE: f64 = 500e6;
const LINE_ALUMINIUM: f64 = 250e6;
/// The largest pressure of a point of contact at rest over that of running contact: 4200 MPa for hardened steel (ISO 76).
const AT_REST_OVER_RUNNING: (f64, f64) = (14.0, 5.0);

/// The customary largest pressure of running contact between a steel roller and a cam of a material, Pa. Of hardened steel it is the fatigue
/// limit of rolling bearings, along a line and in a point (ISO 281:2007).
#[must_use]
pub fn customary_stress(material: Material) -> f64 {
    match material {
        Material::Steel => LINE_STEEL,
        Material::CastIron => LINE_CAST_IRON,
        Material::Bronze => LINE_BRONZE,
        Material::Aluminium => LINE_ALUMINIUM,
    }
}

/// The customary largest pressure of running contact between a steel roller and a cam of a material as a file gives it, Pa; `None` where nothing
/// is known of it.
#[must_use]
pub fn customary_stress_of(material: &CamMaterial) -> Option<f64> {
    material.line_limit().or_else(|| material.is_known().then(|| customary_stress(material.class)))
}

/// The customary largest pressure in a point of contact at rest, whose material is held from all sides, Pa: beyond it a dent stays. `None` where
/// nothing is known of the material.
#[must_use]
pub fn stress_at_rest(material: &CamMaterial) -> Option<f64> {
    customary_stress_of(material).map(|running| running * AT_REST_OVER_RUNNING.0 / AT_REST_OVER_RUNNING.1)
}

/// Least customary wall, m, and over the radius of the bore: about half of the hub that ANSI/ASME B29.1 gives a wheel (3.2 mm and a sixth of the
/// bore's diameter).
const CUSTOMARY_WALL: (f64, f64) = (3e-3, 0.15);
/// A curve that leaves its rows by ten times the lift has nothing to do with them.
const LARGEST_SHARE: f64 = 10.0;
/// Longest life that is asked for, h: a thousand years.
const LARGEST_HOURS: f64 = 1e7;
/// Customary largest size of a cam, m: what a machining centre or a plate cutter of a shop takes.
const CUSTOMARY_SIZE: f64 = 2.0;

/// How far a curve through rows may leave them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OvershootLimit {
    /// So far, m or rad.
    By(f64),
    /// By a share of the lift.
    OfLift(f64),
}

/// The limits of a cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest |pressure angle|, rad; `None` under a flat face where the file gives no limit.
    pub pressure_angle: Option<f64>,
    /// Largest |pressure angle| where it is negative, under a falling follower, rad; where it is absent `pressure_angle` is the limit.
    pub pressure_angle_return: Option<f64>,
    /// Smallest convex radius of the pitch curve over the roller radius.
    pub min_convex_pitch_radius_over_roller: f64,
    /// Smallest convex radius of the profile, m, where the file gives one.
    pub min_convex_radius: Option<f64>,
    /// Radius of the tool that must get into the concave parts, m.
    pub cutter_radius: Option<f64>,
    /// Least metal between bore and profile, m; where it is absent the customary one holds.
    pub wall: Option<f64>,
    /// Largest size of the cam, m; where it is absent the customary one holds.
    pub size: Option<f64>,
    /// Least distance of the pivot of a swinging follower from the circle of the cam, m, where the file gives one.
    pub pivot_clearance: Option<f64>,
    /// Largest pressure in the contact of roller and cam, Pa; where it is absent the customary one of the material holds.
    pub contact_stress: Option<f64>,
    /// Largest error of the follower's acceleration as cut over the largest acceleration of the motion; where it is absent
    /// more than a tenth is a warning.
    pub acceleration_share: Option<f64>,
    /// Order of the last continuous derivative of the motion.
    pub continuity: f64,
    /// Least jump speed over the speed of the cam of a motion program.
    pub jump_margin: f64,
    /// How far a curve through rows may leave them; where it is absent a hundredth of the lift, at least the tolerance.
    pub overshoot: Option<OvershootLimit>,
    /// Least life of the roller's bearing, h; where it is absent the life is only reported.
    pub roller_life: Option<f64>,
    /// Largest residual vibration over the travel; where it is absent the vibration is only reported.
    pub residual: Option<f64>,
}

impl Limits {
    /// Largest pressure angles where it is positive and where it is negative, rad; infinite where there is no limit.
    #[must_use]
    pub fn pressure_angles(&self) -> [f64; 2] {
        let rising = self.pressure_angle.unwrap_or(f64::INFINITY);
        [rising, self.pressure_angle_return.unwrap_or(rising)]
    }

    /// Least metal that stays about a bore of a radius, or between the flanks of a plate, m.
    #[must_use]
    pub fn least_wall(&self, bore_radius: Option<f64>) -> f64 {
        let (least, share) = CUSTOMARY_WALL;
        self.wall.unwrap_or_else(|| least.max(share * bore_radius.unwrap_or(0.0)))
    }

    /// Largest size of the cam, m.
    #[must_use]
    pub fn largest_size(&self) -> f64 {
        self.size.unwrap_or(CUSTOMARY_SIZE)
    }

    /// Smallest convex radius of the curve of a follower that lies this far (m) outside of the profile, m.
    #[must_use]
    pub fn convex_radius(&self, offset: f64) -> f64 {
        let of_profile = self.min_convex_radius.map_or(0.0, |radius| radius + offset);
        (self.min_convex_pitch_radius_over_roller * offset).max(of_profile)
    }
}

const PRESSURE_ANGLE: Field<f64> = Field::quantity(
    "pressure_angle",
    "largest angle between the follower's path and the normal, at most 90 deg; when absent, 45 deg for a swinging roller and no limit for a flat face",
    Default("30 deg"),
    Angle,
    above(0.0, FRAC_PI_2),
);
const PRESSURE_ANGLE_RETURN: Field<f64> = Field::quantity(
    "pressure_angle_return",
    "limit of negative pressure angles, where a spring returns the follower; pressure_angle when absent",
    Optional("45 deg"),
    Angle,
    above(0.0, FRAC_PI_2),
)
.only(&[MAKE]);
const MIN_CONVEX: Field<f64> = Field::number(
    "min_convex_pitch_radius_over_roller",
    "smallest convex radius of the pitch curve over the roller radius",
    Default("2.0"),
    within(0.0, LARGEST_NUMBER),
);
const MIN_CONVEX_RADIUS: Field<f64> = Field::quantity(
    "min_convex_radius",
    "smallest convex radius of the profile, under a roller checked on the pitch curve with the radius of the roller added to figure and limit; under a flat face 1 mm is kept by base_radius = \"auto\" when absent",
    Optional("5 mm"),
    Length,
    above(0.0, LONGEST),
)
.only(&[MAKE]);
const CUTTER_RADIUS: Field<f64> = Field::quantity(
    "cutter_radius",
    "radius of the cutter, which must fit into the concave parts",
    Optional("10 mm"),
    Length,
    above(0.0, LONGEST),
);
const CUTTER_DIAMETER: Key =
    CUTTER_RADIUS.diameter("cutter_diameter", "diameter of the cutter, in the place of its radius", "20 mm");
const WALL: Field<f64> = Field::quantity(
    "wall",
    "smallest wall between what is cut: profile, bore with keyway and holes, or the flanks of a plate; when absent, the larger of 3 mm and 0.15 of the bore's radius (camgen's own rule, well below the hub of ANSI/ASME B29.1 for bores above 20 mm), 1 mm about balance holes",
    Optional("4 mm"),
    Length,
    within(0.0, LONGEST),
);
const SIZE: Field<f64> = Field::quantity(
    "size",
    "largest length or width of the cam; 2 m when absent, what the machine tools of a shop take",
    Optional("1 m"),
    Length,
    above(0.0, LONGEST),
);
const PIVOT_CLEARANCE: Field<f64> = Field::quantity(
    "pivot_clearance",
    "least distance from the pivot of a swinging follower to the circle that the cam sweeps over; only a warning where it is below 0 when absent",
    Optional("20 mm"),
    Length,
    within(0.0, LONGEST),
)
.only(&[MAKE]);
const CONTACT_STRESS: Field<f64> = Field::quantity(
    "contact_stress",
    "largest pressure between roller and cam (Hertz); when absent, the customary limit of running contact: 1500 MPa for hardened steel, the fatigue limit of ISO 281; of a point of contact a warning up to the limit at rest, 4200 MPa (ISO 76)",
    Optional("1200 MPa"),
    Pressure,
    above(0.0, HIGHEST_STRESS),
);
const ACCELERATION_SHARE: Field<f64> = Field::number(
    "acceleration_share",
    "largest error of the acceleration as cut over the largest acceleration of the motion; when absent, more than 0.1 is a warning",
    Optional("0.05"),
    above(0.0, LARGEST_NUMBER),
);

const CONTINUITY: Field<f64> = Field::number(
    "continuity",
    "order of the highest derivative of the motion that must be continuous, 0 to 3; 0 allows impacts",
    Default("1"),
    within(0.0, 3.0),
);

const JUMP_MARGIN: Field<f64> = Field::number(
    "jump_margin",
    "smallest speed at which the follower leaves the cam of a motion program, over the speed of the cam",
    Default("1"),
    above(0.0, LARGEST_NUMBER),
)
.only(&[MAKE]);
const ROLLER_LIFE: Field<f64> = Field::number(
    "roller_life",
    "least life L10 of the bearing of the roller, in hours; only reported when absent",
    Optional("20000"),
    above(0.0, LARGEST_HOURS),
)
.only(WITH_A_RATED_ROLLER);
const RESIDUAL: Field<f64> = Field::number(
    "residual",
    "for the check `vibration`: largest residual vibration after a movement of a motion program, over its travel; only reported when absent",
    Optional("0.01"),
    above(0.0, LARGEST_NUMBER),
)
.only(&[MAKE]);

const OVERSHOOT: Field<LengthAngleOrShare> = Field::length_angle_or_share(
    "overshoot",
    "how far the curve through rows, points or a spline may leave the range of two neighbouring rows: a length, an angle of a swing, or a share of the lift (\"1 %\"); 1 % of the lift, at least the tolerance, when absent",
    Optional("0.1 mm"),
    (within(0.0, LONGEST), within(0.0, FRAC_PI_2)),
    within(0.0, LARGEST_SHARE),
)
.only(&[MAKE]);

/// `[limits]`.
pub(super) const SECTION: KeySection = KeySection {
    path: "limits",
    about: "limits of the cam",
    occurs: Occurrence::Once,
    cams: &[],
    keys: &[
        PRESSURE_ANGLE.key,
        PRESSURE_ANGLE_RETURN.key,
        MIN_CONVEX.key,
        MIN_CONVEX_RADIUS.key,
        CUTTER_RADIUS.key,
        CUTTER_DIAMETER,
        WALL.key,
        SIZE.key,
        PIVOT_CLEARANCE.key,
        CONTACT_STRESS.key,
        ACCELERATION_SHARE.key,
        CONTINUITY.key,
        JUMP_MARGIN.key,
        RESIDUAL.key,
        ROLLER_LIFE.key,
        OVERSHOOT.key,
    ],
};

/// Customary limit of the pressure angle of a roller on an arm, rad: its side thrust goes into a bearing, not into a guide.
const SWINGING_PRESSURE_ANGLE: f64 = FRAC_PI_4;

/// The limit of the pressure angle under a follower whose table says this, rad: that of the file, or the customary one. Under a flat
/// face there is none: on a straight path the angle is the tilt of the face; on an arm tan α = f/ℓ, with the offset f of the face from its
/// pivot and the distance ℓ of the contact along the face.
fn pressure_angle(table: &TableReader<'_>, in_table: f64, follower: &dyn Follower, moves: Quantity) -> Option<f64> {
    match (table.has(&PRESSURE_ANGLE), follower.element(), moves) {
        (false, Element::Face, _) => None,
        (false, Element::Roller { .. }, Quantity::Angle) => Some(SWINGING_PRESSURE_ANGLE),
        _ => Some(in_table),
    }
}

/// The inputs of a file, the limit of the pressure angle as it holds for a follower in the place of the default of its key.
pub(super) fn inputs(reader: &Reader<'_>, follower: &dyn Follower, moves: Quantity) -> Vec<Input> {
    let (table, path) = (reader.table(&SECTION), SECTION.path_of(&PRESSURE_ANGLE.key));
    let inputs = reader.inputs().into_iter().filter_map(|input| {
        let in_table = if input.key == path { table.get(&PRESSURE_ANGLE) } else { None };
        let Some(in_table) = in_table else { return Some(input) };
        match pressure_angle(&table, in_table, follower, moves) {
            Some(limit) if limit != in_table => Some(Input::quantity(&path, limit, ("deg", 1.0_f64.to_radians()))),
            limit => limit.map(|_| input),
        }
    });
    inputs.collect()
}

/// The limits in effect, given or default, as a person would type them; limits that are checked only if given are left out.
#[cfg(feature = "html")]
pub(super) fn usual(limits: &Limits, material: Option<CamMaterial>, bore_radius: Option<f64>) -> Vec<Input> {
    let quantity = |key: &Key, si: f64, unit| Input::quantity(&SECTION.path_of(key), si, unit);
    let (degrees, millimetres, megapascals) = (("deg", 1.0_f64.to_radians()), ("mm", 1e-3), ("MPa", 1e6));
    let angle = limits.pressure_angle;
    let angle_return = limits.pressure_angle_return.or(angle);
    let stress = limits.contact_stress.or_else(|| customary_stress_of(&material?));
    [
        angle.map(|angle| quantity(&PRESSURE_ANGLE.key, angle, degrees)),
        angle_return.map(|angle| quantity(&PRESSURE_ANGLE_RETURN.key, angle, degrees)),
        Some(quantity(&WALL.key, limits.least_wall(bore_radius), millimetres)),
        Some(quantity(&SIZE.key, limits.largest_size(), millimetres)),
        stress.map(|stress| quantity(&CONTACT_STRESS.key, stress, megapascals)),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The limit of the overshoot, which must be of the kind of the follower's motion.
fn overshoot(reader: &Reader<'_>, wanted: Quantity) -> Option<OvershootLimit> {
    let table = reader.table(&SECTION);
    let (found, value) = match table.get(&OVERSHOOT).filter(|_| table.has(&OVERSHOOT))? {
        LengthAngleOrShare::Share(share) => return Some(OvershootLimit::OfLift(share)),
        LengthAngleOrShare::Size(LengthOrAngle::Length(value)) => (Quantity::Length, value),
        LengthAngleOrShare::Size(LengthOrAngle::Angle(value)) => (Quantity::Angle, value),
    };
    if found != wanted && reader.find(&MOTION).is_some() {
        let message = format!("`limits.overshoot` is {}, but the follower moves by {}", found.words(), wanted.words());
        let example = if wanted == Quantity::Angle { "0.1 deg" } else { "0.1 mm" };
        table.fail(&OVERSHOOT, message, Some(format!("e.g. overshoot = \"{example}\", or \"1 %\" of the lift")));
        return None;
    }
    Some(OvershootLimit::By(value))
}

/// Refuses limits of what is not known of a plate.
pub(super) fn refuse_for_plate(reader: &Reader<'_>) {
    let table = reader.table(&SECTION);
    let by_speed = [&JUMP_MARGIN, &RESIDUAL, &ROLLER_LIFE];
    for field in by_speed.into_iter().filter(|field| table.has(field)) {
        let message =
            format!("`limits.{}` is for the speed of a cam, and that of a plate is not known", field.key.name);
        table.fail(field, message, Some("remove it".into()));
    }
    if table.has(&PIVOT_CLEARANCE) {
        let message = "`limits.pivot_clearance` is for a follower that swings, and that of a plate does not".to_owned();
        table.fail(&PIVOT_CLEARANCE, message, Some("remove it".into()));
    }
}

pub(super) fn read(reader: &Reader<'_>, follower: &dyn Follower, moves: Quantity) -> Option<Limits> {
    let table = reader.table(&SECTION);
    Some(Limits {
        pressure_angle: pressure_angle(&table, table.get(&PRESSURE_ANGLE)?, follower, moves),
        pressure_angle_return: table.get(&PRESSURE_ANGLE_RETURN),
        min_convex_pitch_radius_over_roller: table.get(&MIN_CONVEX)?,
        min_convex_radius: table.get(&MIN_CONVEX_RADIUS),
        cutter_radius: table.get(&CUTTER_RADIUS),
        wall: table.get(&WALL),
        size: table.get(&SIZE),
        pivot_clearance: table.get(&PIVOT_CLEARANCE),
        contact_stress: table.get(&CONTACT_STRESS),
        acceleration_share: table.get(&ACCELERATION_SHARE),
        continuity: table.get(&CONTINUITY)?,
        jump_margin: table.get(&JUMP_MARGIN)?,
        residual: table.get(&RESIDUAL),
        roller_life: table.get(&ROLLER_LIFE),
        overshoot: overshoot(reader, moves),
    })
}

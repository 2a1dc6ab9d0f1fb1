//! The limits of a cam.

use super::brake::BrakeLimits;
use super::disc::Material;
use super::shaft::ShaftLimits;
use crate::document::Presence::{Default, Optional};
use crate::document::cams::{BRAKE, BRAKE_CAM, LINKAGE, MAKE, OF_A_PRESS, SHAFT};
use crate::document::range::{LARGEST_NUMBER, LONGEST};
use crate::document::{Field, Input, Occurs, Reader, Section, Table, above, within};
use crate::follower::{Element, Follower};
use crate::motion::Quantity;
use crate::units::Dimension::{Angle, Length, Pressure};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// Highest limit of contact pressure that is accepted, Pa: a hundred times what steel withstands.
const HIGHEST_STRESS: f64 = 1e12;

/// Customary largest pressures in a line of contact with a steel roller, Pa: hardened steel, grey cast iron, tin bronze, a
/// wrought aluminium alloy.
const LINE_STEEL: f64 = 1500e6;
const LINE_CAST_IRON: f64 = 700e6;
const LINE_BRONZE: f64 = 500e6;
const LINE_ALUMINIUM: f64 = 250e6;
/// How much more is customary in a point of contact, whose material is held from all sides: 4200 MPa for steel.
const POINT_OVER_LINE: (f64, f64) = (14.0, 5.0);

/// How roller and cam touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Touching {
    /// A cylinder along a line.
    Line,
    /// A sphere in an ellipse about a point.
    Point,
}

/// The customary largest pressure between a steel roller and a cam of a material, Pa.
#[must_use]
pub fn customary_stress(material: Material, touching: Touching) -> f64 {
    let line = match material {
        Material::Steel => LINE_STEEL,
        Material::CastIron => LINE_CAST_IRON,
        Material::Bronze => LINE_BRONZE,
        Material::Aluminium => LINE_ALUMINIUM,
    };
    match touching {
        Touching::Line => line,
        Touching::Point => line * POINT_OVER_LINE.0 / POINT_OVER_LINE.1,
    }
}

/// The limits of a linkage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkageLimits {
    /// Least transmission angle of the drag link, rad.
    pub transmission_angle: f64,
    /// Largest angle of the connecting rod from the line of the slider, rad.
    pub rod_angle: f64,
    /// Least coupler and follower over the driving crank.
    pub link_ratio: f64,
}

const TRANSMISSION_ANGLE: Field<f64> = Field::quantity(
    "transmission_angle",
    "least angle between coupler and driven crank of the drag link",
    Default("45 deg"),
    Angle,
    within(0.0, FRAC_PI_2),
)
.only(&[LINKAGE]);
const ROD_ANGLE: Field<f64> = Field::quantity(
    "rod_angle",
    "largest angle of the connecting rod from the line of the slider",
    Default("30 deg"),
    Angle,
    above(0.0, FRAC_PI_2),
)
.only(&[LINKAGE]);
const LINK_RATIO: Field<f64> = Field::number(
    "link_ratio",
    "least coupler and driven crank over the driving crank",
    Default("0.5"),
    within(0.0, LARGEST_NUMBER),
)
.only(&[LINKAGE]);

const CRITICAL_SPEED_RATIO: Field<f64> = Field::number(
    "critical_speed_ratio",
    "largest speed of the shaft over its first critical speed",
    Default("0.7"),
    above(0.0, LARGEST_NUMBER),
)
.only(&[SHAFT]);
const LIFT_ERROR: Field<f64> = Field::quantity(
    "lift_error",
    "by how much the follower may stand lower while shaft and supports give way; told only, when absent",
    Optional("0.1 mm"),
    Length,
    above(0.0, LONGEST),
)
.only(&[SHAFT]);
const SUPPORT_SLOPE: Field<f64> = Field::quantity(
    "support_slope",
    "largest slope of the shaft at a support; told only, when absent",
    Optional("0.001 rad"),
    Angle,
    above(0.0, FRAC_PI_2),
)
.only(&[SHAFT]);
const BALANCE_GRADE: Field<f64> = Field::number(
    "balance_grade",
    "grade of balance G of ISO 21940-11, mm/s: 0.4, 1, 2.5, 6.3, 16, 40, 100, 250, 630, 1600 or 4000; told only, when absent",
    Optional("16"),
    above(0.0, LARGEST_NUMBER),
)
.only(&[SHAFT]);

const TENSION_SPREAD: Field<f64> = Field::number(
    "tension_spread",
    "by how much the web tension may change over the roll, over the largest",
    Default("0.05"),
    within(0.0, 1.0),
)
.only(&[BRAKE, BRAKE_CAM]);
const WEB_STRESS: Field<f64> = Field::quantity(
    "web_stress",
    "largest stress in the web; told only, when absent",
    Optional("10 MPa"),
    Pressure,
    above(0.0, HIGHEST_STRESS),
)
.only(&[BRAKE]);

/// What a brake must keep.
pub(super) fn of_brake(reader: &Reader<'_>) -> Option<BrakeLimits> {
    let table = reader.table(&SECTION);
    Some(BrakeLimits { tension_spread: table.get(&TENSION_SPREAD)?, web_stress: table.get(&WEB_STRESS) })
}

/// What a shaft must keep.
pub(super) fn of_shaft(reader: &Reader<'_>) -> Option<ShaftLimits> {
    let table = reader.table(&SECTION);
    Some(ShaftLimits {
        critical_speed_ratio: table.get(&CRITICAL_SPEED_RATIO)?,
        lift_error: table.get(&LIFT_ERROR),
        support_slope: table.get(&SUPPORT_SLOPE),
        balance_grade: table.get(&BALANCE_GRADE),
    })
}

/// The limits of a cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest |pressure angle|, rad; `None` under a flat face where the file gives no limit.
    pub pressure_angle: Option<f64>,
    /// The same where it is negative, of a follower that falls; as the other where it is absent.
    pub pressure_angle_return: Option<f64>,
    /// Smallest convex radius of the pitch curve over the roller radius.
    pub min_convex_pitch_radius_over_roller: f64,
    /// Smallest convex radius of the profile, m, where one is asked for.
    pub min_convex_radius: Option<f64>,
    /// Radius of the tool that must get into the concave parts, m.
    pub cutter_radius: Option<f64>,
    /// Least metal between bore and profile, m.
    pub wall: f64,
    /// Largest pressure in the contact of roller and cam, Pa; where it is absent the customary one of the material holds.
    pub contact_stress: Option<f64>,
    /// Largest residual force over the largest inertia force; where it is absent it must stay below a fixed bottom's.
    pub residual_share: Option<f64>,
    /// Largest error of the follower's acceleration as cut over the largest acceleration of the motion; where it is absent a
    /// tenth is told.
    pub acceleration_share: Option<f64>,
    /// Order of the last continuous derivative of a motion program.
    pub continuity: f64,
    /// Least jump speed over the speed of the cam of a motion program.
    pub jump_margin: f64,
    /// Largest residual vibration over the travel; where it is absent it is told only.
    pub residual: Option<f64>,
    /// Of the linkage that moves a bed.
    pub linkage: LinkageLimits,
    /// Of the shaft.
    pub shaft: ShaftLimits,
    /// Of a brake.
    pub brake: BrakeLimits,
}

impl Limits {
    /// Largest pressure angles where it is positive and where it is negative, rad; infinite where there is no limit.
    #[must_use]
    pub fn pressure_angles(&self) -> [f64; 2] {
        let rising = self.pressure_angle.unwrap_or(f64::INFINITY);
        [rising, self.pressure_angle_return.unwrap_or(rising)]
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
    "largest angle between the follower's path and the normal, at most 90 deg; when absent 45 deg for a swinging roller, none for a flat face",
    Default("30 deg"),
    Angle,
    above(0.0, FRAC_PI_2),
);
const PRESSURE_ANGLE_RETURN: Field<f64> = Field::quantity(
    "pressure_angle_return",
    "limit of negative pressure angles, where a spring brings the follower back; as pressure_angle when absent",
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
    "smallest convex radius of the profile; under a flat face 1 mm is kept by base_radius = \"auto\" when absent",
    Optional("5 mm"),
    Length,
    above(0.0, LONGEST),
)
.only(&[MAKE]);
const CUTTER_RADIUS: Field<f64> = Field::quantity(
    "cutter_radius",
    "radius of the tool the shop cuts with; concave parts must let it in",
    Optional("10 mm"),
    Length,
    above(0.0, LONGEST),
);
const WALL: Field<f64> = Field::quantity(
    "wall",
    "least metal between bore and profile, or between the flanks of a plate",
    Default("0 mm"),
    Length,
    within(0.0, LONGEST),
);
const CONTACT_STRESS: Field<f64> = Field::quantity(
    "contact_stress",
    "largest pressure between roller and cam (Hertz); the customary one of the material when absent",
    Optional("1200 MPa"),
    Pressure,
    above(0.0, HIGHEST_STRESS),
);
const RESIDUAL_SHARE: Field<f64> = Field::number(
    "residual_share",
    "largest residual force over the largest inertia; when absent, less than a fixed bottom leaves",
    Optional("0.01"),
    above(0.0, LARGEST_NUMBER),
)
.only(OF_A_PRESS);
const ACCELERATION_SHARE: Field<f64> = Field::number(
    "acceleration_share",
    "largest error of the acceleration as cut over the largest of the motion; when absent, 0.1 only warns",
    Optional("0.05"),
    above(0.0, LARGEST_NUMBER),
);

const CONTINUITY: Field<f64> = Field::number(
    "continuity",
    "order of the last derivative of a motion program that must be continuous all round, 0 to 3",
    Default("1"),
    within(0.0, 3.0),
)
.only(&[MAKE]);

const JUMP_MARGIN: Field<f64> = Field::number(
    "jump_margin",
    "least speed at which the follower leaves the cam of a motion program, over the speed of the cam",
    Default("1"),
    above(0.0, LARGEST_NUMBER),
)
.only(&[MAKE]);
const RESIDUAL: Field<f64> = Field::number(
    "residual",
    "largest residual vibration behind a movement of a motion program, over its travel; told only, when absent",
    Optional("0.01"),
    above(0.0, LARGEST_NUMBER),
)
.only(&[MAKE]);

/// `[limits]`.
pub(super) const SECTION: Section = Section {
    path: "limits",
    about: "what a cam must keep",
    occurs: Occurs::Once,
    cams: &[],
    keys: &[
        PRESSURE_ANGLE.key,
        PRESSURE_ANGLE_RETURN.key,
        MIN_CONVEX.key,
        MIN_CONVEX_RADIUS.key,
        CUTTER_RADIUS.key,
        WALL.key,
        CONTACT_STRESS.key,
        RESIDUAL_SHARE.key,
        ACCELERATION_SHARE.key,
        CONTINUITY.key,
        JUMP_MARGIN.key,
        RESIDUAL.key,
        TRANSMISSION_ANGLE.key,
        ROD_ANGLE.key,
        LINK_RATIO.key,
        CRITICAL_SPEED_RATIO.key,
        LIFT_ERROR.key,
        SUPPORT_SLOPE.key,
        BALANCE_GRADE.key,
        TENSION_SPREAD.key,
        WEB_STRESS.key,
    ],
};

/// Customary limit of the pressure angle of a roller on an arm, rad: its side thrust goes into a bearing, not into a guide.
const SWINGING_PRESSURE_ANGLE: f64 = FRAC_PI_4;

/// The limit of the pressure angle under a follower whose table says this, rad: that of the file, or what is customary. Under a flat
/// face none is: the angle follows from how the face stands, not from the cam.
fn pressure_angle(table: &Table<'_>, in_table: f64, follower: &dyn Follower) -> Option<f64> {
    match (table.has(&PRESSURE_ANGLE), follower.element(), follower.quantity()) {
        (false, Element::Face, _) => None,
        (false, Element::Roller { .. }, Quantity::Angle) => Some(SWINGING_PRESSURE_ANGLE),
        _ => Some(in_table),
    }
}

/// The inputs of a file, the limit of the pressure angle as it holds for a follower in the place of the default of its key.
pub(super) fn inputs(reader: &Reader<'_>, follower: &dyn Follower) -> Vec<Input> {
    let (table, path) = (reader.table(&SECTION), SECTION.path_of(&PRESSURE_ANGLE.key));
    let of = |input: Input| {
        let in_table = if input.key == path { table.get(&PRESSURE_ANGLE) } else { None };
        let Some(in_table) = in_table else { return Some(input) };
        match pressure_angle(&table, in_table, follower) {
            Some(limit) if limit != in_table => Some(Input::quantity(&path, limit, ("deg", 1.0_f64.to_radians()))),
            limit => limit.map(|_| input),
        }
    };
    reader.inputs().into_iter().filter_map(of).collect()
}

pub(super) fn read(reader: &Reader<'_>, follower: &dyn Follower) -> Option<Limits> {
    let table = reader.table(&SECTION);
    Some(Limits {
        pressure_angle: pressure_angle(&table, table.get(&PRESSURE_ANGLE)?, follower),
        pressure_angle_return: table.get(&PRESSURE_ANGLE_RETURN),
        min_convex_pitch_radius_over_roller: table.get(&MIN_CONVEX)?,
        min_convex_radius: table.get(&MIN_CONVEX_RADIUS),
        cutter_radius: table.get(&CUTTER_RADIUS),
        wall: table.get(&WALL)?,
        contact_stress: table.get(&CONTACT_STRESS),
        residual_share: table.get(&RESIDUAL_SHARE),
        acceleration_share: table.get(&ACCELERATION_SHARE),
        continuity: table.get(&CONTINUITY)?,
        jump_margin: table.get(&JUMP_MARGIN)?,
        residual: table.get(&RESIDUAL),
        linkage: LinkageLimits {
            transmission_angle: table.get(&TRANSMISSION_ANGLE)?,
            rod_angle: table.get(&ROD_ANGLE)?,
            link_ratio: table.get(&LINK_RATIO)?,
        },
        shaft: of_shaft(reader)?,
        brake: of_brake(reader)?,
    })
}

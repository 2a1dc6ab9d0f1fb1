//! The keys of a belt brake.

use super::{BeltMode, BrakeModel};
use crate::brake::mechanics::RollRotation;
use crate::brake::{BRAKE, BRAKE_CAM};
use camgen_kernel::document::Presence::{Default, Optional, Required};
use camgen_kernel::document::range::{HIGHEST_PRESSURE, LARGEST_FORCE, LARGEST_NUMBER, LONGEST, STIFFEST};
use camgen_kernel::document::{self, Field, Key, KeySection, Occurrence, above, within};
use camgen_kernel::units::Dimension::{Acceleration, Angle, Density, Force, Length, Pressure, Speed, Stiffness};
use std::f64::consts::TAU;

/// Stiffest web, Pa, fastest, m/s, densest paper, kg/m³, and quickest start, m/s².
const STIFFEST_WEB: f64 = 1e3 * HIGHEST_PRESSURE;
const FASTEST: f64 = 1e3;
const DENSEST: f64 = 1e5;
const QUICKEST: f64 = 1e4;
/// Largest strain wound into a roll: more tears it.
const MOST_WOUND: f64 = 0.5;
/// Largest speed of a slipping belt / web speed.
const FASTEST_BELT: f64 = 0.999_999;
/// Largest friction coefficient.
const STICKIEST: f64 = 100.0;

pub(super) const MODE: Field<BeltMode> = Field::words(
    "mode",
    "\"slip\" (the belt slips on the roll) or \"no-slip\" (its speed stretches the web)",
    Default("slip"),
    &["slip", "no-slip"],
    &[BeltMode::Slip, BeltMode::NoSlip],
);
pub(super) const MODEL: Field<BrakeModel> = Field::words(
    "model",
    "\"consistent\" (moments about roll and pivot) or \"printed\" (the paper's equations (1) to (15))",
    Default("consistent"),
    &["consistent", "printed"],
    &[BrakeModel::Consistent, BrakeModel::Printed],
);
pub(super) const TENSION: Field<f64> =
    Field::quantity("tension", "wanted tension of the web", Required("300 N"), Force, above(0.0, LARGEST_FORCE));
pub(super) const FRICTION: Field<f64> =
    Field::number("friction", "friction coefficient between belt and roll", Required("0.25"), above(0.0, STICKIEST));
pub(super) const WEIGHT: Field<Option<f64>> = Field::words_or_quantity(
    "weight",
    "weight of the frame with its load, or \"auto\": the weight with which the full roll has the wanted tension",
    Default("auto"),
    (&["auto"], &[None]),
    (Force, above(0.0, LARGEST_FORCE), Some),
);
pub(super) const ROTATION: Field<RollRotation> = Field::words(
    "rotation",
    "rotation of the roll as seen in the axes of the frame: \"cw\" (the left span is the tight one) or \"ccw\"",
    Default("cw"),
    &["cw", "ccw"],
    &[RollRotation::Clockwise, RollRotation::CounterClockwise],
);
pub(super) const BELT_SPEED_RATIO: Field<f64> = Field::number(
    "belt_speed_ratio",
    "speed of a slipping belt divided by that of the web, at most 0.999999; it changes the power, not the tension",
    Default("0.0"),
    within(0.0, FASTEST_BELT),
);
pub(super) const GRIP: Field<f64> = Field::number(
    "grip",
    "least tension that a belt without slip can hold, divided by the wanted tension",
    Default("1.5"),
    above(0.0, LARGEST_NUMBER),
);
pub(super) const ACCELERATION: Field<f64> = Field::quantity(
    "acceleration",
    "acceleration of the web while the machine speeds up; needs brake.roll.density and [brake.web]",
    Default("0 m/s2"),
    Acceleration,
    within(0.0, QUICKEST),
);

/// `[brake]`.
pub(in crate::brake) const SECTION: KeySection = KeySection {
    path: "brake",
    about: "the belt brake of a paper roll: camgen brake",
    occurs: Occurrence::With(&["brake.roll", "brake.web", "brake.frame", "brake.ends", "brake.cam"]),
    cams: &[BRAKE, BRAKE_CAM],
    keys: &[
        MODE.key,
        MODEL.key,
        TENSION.key,
        FRICTION.key,
        WEIGHT.key,
        ROTATION.key,
        BELT_SPEED_RATIO.key,
        GRIP.key,
        ACCELERATION.key,
    ],
};

pub(super) const LARGEST_RADIUS: Field<f64> = Field::quantity(
    "largest_radius",
    "radius of the full roll, to the middle of the belt",
    Required("600 mm"),
    Length,
    above(0.0, LONGEST),
);
const LARGEST_DIAMETER: Key =
    LARGEST_RADIUS.diameter("largest_diameter", "diameter of the full roll, in the place of its radius", "1200 mm");
pub(super) const SMALLEST_RADIUS: Field<f64> = Field::quantity(
    "smallest_radius",
    "radius of the run-down roll, below the largest",
    Required("50 mm"),
    Length,
    above(0.0, LONGEST),
);
const SMALLEST_DIAMETER: Key = SMALLEST_RADIUS.diameter(
    "smallest_diameter",
    "diameter of the run-down roll, in the place of its radius",
    "100 mm",
);
pub(super) const DENSITY: Field<f64> = Field::quantity(
    "density",
    "density of the paper on the roll, for its inertia",
    Optional("700 kg/m3"),
    Density,
    above(0.0, DENSEST),
);

/// `[brake.roll]`.
pub(in crate::brake) const ROLL: KeySection = KeySection {
    path: "brake.roll",
    about: "the roll, with [brake.frame]",
    occurs: Occurrence::With(&["brake.frame"]),
    cams: &[BRAKE, BRAKE_CAM],
    keys: &[LARGEST_RADIUS.key, LARGEST_DIAMETER, SMALLEST_RADIUS.key, SMALLEST_DIAMETER, DENSITY.key],
};

pub(super) const THICKNESS: Field<f64> =
    Field::quantity("thickness", "of the web", Required("0.07 mm"), Length, above(0.0, LONGEST));
pub(super) const WIDTH: Field<f64> =
    Field::quantity("width", "of the web", Required("840 mm"), Length, above(0.0, LONGEST));
pub(super) const MODULUS: Field<f64> = Field::quantity(
    "modulus",
    "modulus of elasticity of the paper under fast loading; newsprint 4000 to 5000 MPa",
    Required("4500 MPa"),
    Pressure,
    above(0.0, STIFFEST_WEB),
);
pub(super) const SPEED: Field<f64> =
    Field::quantity("speed", "printing speed of the web", Required("10 m/s"), Speed, above(0.0, FASTEST));
pub(super) const WOUND_STRAIN: Field<f64> = Field::number(
    "wound_strain",
    "strain of the web as wound on the roll",
    Default("0.0"),
    within(-MOST_WOUND, MOST_WOUND),
);
pub(super) const WEB_LENGTH: Field<f64> = Field::quantity(
    "length",
    "length from the roll to the printing nip, for the stretch by equation (15)",
    Optional("6 m"),
    Length,
    above(0.0, LONGEST),
);

/// `[brake.web]`.
pub(in crate::brake) const WEB: KeySection = KeySection {
    path: "brake.web",
    about: "the web: for stress, strain, power and a belt that does not slip",
    occurs: Occurrence::Optional,
    cams: &[BRAKE],
    keys: &[THICKNESS.key, WIDTH.key, MODULUS.key, SPEED.key, WOUND_STRAIN.key, WEB_LENGTH.key],
};

/// Coordinates of a point, from the axis of the roll.
const AROUND: document::Bounds = within(-LONGEST, LONGEST);
pub(super) const PIVOT: Field<[f64; 2]> = Field::pair(
    "pivot",
    "pivot of the frame, to the right and upwards from the axis of the roll",
    Required("[\"-1100 mm\", \"550 mm\"]"),
    Length,
    AROUND,
);
pub(super) const RIGHT_PULLEY: Field<[f64; 2]> = Field::pair(
    "right_pulley",
    "axis of the right pulley at the largest radius",
    Required("[\"500 mm\", \"450 mm\"]"),
    Length,
    AROUND,
);
pub(super) const LEFT_PULLEY: Field<[f64; 2]> = Field::pair(
    "left_pulley",
    "axis of the left pulley at the largest radius",
    Required("[\"-550 mm\", \"450 mm\"]"),
    Length,
    AROUND,
);
pub(super) const CENTRE_OF_GRAVITY: Field<[f64; 2]> = Field::pair(
    "centre_of_gravity",
    "centre of gravity of frame and weight together at the largest radius",
    Required("[\"100 mm\", \"550 mm\"]"),
    Length,
    AROUND,
);
pub(super) const PULLEY_RADIUS: Field<f64> = Field::quantity(
    "pulley_radius",
    "radius of both pulleys, to the middle of the belt",
    Required("60 mm"),
    Length,
    above(0.0, LONGEST),
);
const PULLEY_DIAMETER: Key =
    PULLEY_RADIUS.diameter("pulley_diameter", "diameter of both pulleys, in the place of their radius", "120 mm");

/// `[brake.frame]`.
pub(in crate::brake) const FRAME: KeySection = KeySection {
    path: "brake.frame",
    about: "the hinged frame, in its position at the full roll",
    occurs: Occurrence::Optional,
    cams: &[BRAKE, BRAKE_CAM],
    keys: &[PIVOT.key, RIGHT_PULLEY.key, LEFT_PULLEY.key, CENTRE_OF_GRAVITY.key, PULLEY_RADIUS.key, PULLEY_DIAMETER],
};

pub(super) const WRAP: Field<[f64; 2]> = Field::pair(
    "wrap",
    "angles of wrap on the full roll and on the run-down roll, above 0 and below 360 deg",
    Required("[\"90 deg\", \"45 deg\"]"),
    Angle,
    above(0.0, TAU),
);
pub(super) const PRESS_RATIO: Field<f64> = Field::number(
    "press_ratio",
    "press force on the run-down roll divided by that on the full roll",
    Default("1.0"),
    above(0.0, LARGEST_NUMBER),
);

/// `[brake.ends]`.
pub(in crate::brake) const ENDS: KeySection = KeySection {
    path: "brake.ends",
    about: "instead of [brake.frame]: the paper's equations (7) to (10) for the full and the run-down roll",
    occurs: Occurrence::Optional,
    cams: &[BRAKE],
    keys: &[WRAP.key, PRESS_RATIO.key],
};

pub(super) const TURNS: Field<f64> = Field::number(
    "turns_per_frame_turn",
    "turns of the disc per turn of the frame; the disc itself must turn by less than 360 deg",
    Required("10"),
    above(0.0, LARGEST_NUMBER),
);
pub(super) const SPRING_RATE: Field<f64> = Field::quantity(
    "spring_rate",
    "rate of the spring of its follower",
    Required("20 N/mm"),
    Stiffness,
    above(0.0, STIFFEST),
);
pub(super) const PRELOAD: Field<f64> = Field::quantity(
    "preload",
    "force of that spring at the lowest position of the law, above 0: with 0 the law has a corner",
    Required("1 kN"),
    Force,
    above(0.0, LARGEST_FORCE),
);

/// `[brake.cam]`.
pub(in crate::brake) const CAM: KeySection = KeySection {
    path: "brake.cam",
    about: "a disc on the frame's shaft that holds the tension: camgen brake --cam",
    occurs: Occurrence::Optional,
    cams: &[BRAKE_CAM],
    keys: &[TURNS.key, SPRING_RATE.key, PRELOAD.key],
};

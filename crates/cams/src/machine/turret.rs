//! The turret that a globoid cam indexes.

use camgen_kernel::document::Presence::{Default, Optional};
use camgen_kernel::document::cams::{GLOBOID, MAKE};
use camgen_kernel::document::range::{HEAVIEST, LONGEST};
use camgen_kernel::document::{Field, Key, KeySection, Occurrence, Reader, TableReader, above, within};
use camgen_kernel::follower::FollowerData;
use camgen_kernel::motion::Quantity;
use camgen_kernel::units::Dimension::{Angle, Inertia, Length};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A turret with rollers all round, and how far the cam reaches about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurretData {
    /// Between the axes of cam and turret, m.
    pub distance: f64,
    /// From the axis of the turret to the middle of a roller's reach into the groove, m.
    pub arm: f64,
    /// How many rollers it has.
    pub rollers: u32,
    /// By how many of them a turn of the cam moves it on.
    pub advance: u32,
    /// Whether a roller stands in the middle of the cam while the turret rests; else two stand on either side of a rib.
    pub rests_in_groove: bool,
    /// Angle about the turret from the middle of the cam to its ends, rad; `None` is `auto`.
    pub end_angle: Option<f64>,
    /// Moment of inertia about its axis of everything that turns with it, kg·m².
    pub inertia: Option<f64>,
}

impl TurretData {
    /// The angle between two rollers, rad.
    #[must_use]
    pub fn pitch(&self) -> f64 {
        TAU / f64::from(self.rollers)
    }

    /// By how much a turn of the cam moves the turret on, rad.
    #[must_use]
    pub fn index(&self) -> f64 {
        f64::from(self.advance) * self.pitch()
    }
}

/// Fewest and most rollers: with two the cam would have to reach half round the turret.
const FEWEST: f64 = 3.0;
const MOST: f64 = 200.0;
/// Most rollers that a turn passes: each of them has a groove of its own.
const MOST_STARTS: f64 = 20.0;

const DISTANCE: Field<f64> = Field::quantity(
    "turret_distance",
    "distance of the axis of the turret from that of a globoid cam, which it crosses at right angles",
    Optional("120 mm"),
    Length,
    above(0.0, LONGEST),
)
.only(&[GLOBOID])
.also(&["centre_distance", "center_distance"]);
const ARM: Field<f64> = Field::quantity(
    "arm",
    "from the axis of the turret to the middle of the reach of its rollers into the groove of a globoid cam",
    Optional("55 mm"),
    Length,
    above(0.0, LONGEST),
)
.only(&[GLOBOID]);
const ROLLERS: Field<f64> = Field::number(
    "rollers",
    "how many rollers the turret of a globoid cam has, 3 to 200",
    Optional("8"),
    within(FEWEST, MOST),
)
.only(&[GLOBOID])
.also(&["stops", "stations"]);
const ADVANCE: Field<f64> = Field::number(
    "advance",
    "by how many rollers a turn of a globoid cam moves its turret on; as many grooves run side by side",
    Default("1"),
    within(1.0, MOST_STARTS),
)
.only(&[GLOBOID])
.also(&["starts"]);
const RESTS_ON: Field<bool> = Field::words(
    "rests_on",
    "what holds the turret of a globoid cam while it rests: \"rib\", two rollers on either side of a rib; \"groove\", a roller in the middle of the cam",
    Default("rib"),
    &["rib", "groove"],
    &[false, true],
)
.only(&[GLOBOID]);
const END_ANGLE: Field<Option<f64>> = Field::words_or_quantity(
    "end_angle",
    "angle about the turret from the middle of a globoid cam to its conical ends; \"auto\": in the middle between two places of a resting roller",
    Default("auto"),
    (&["auto"], &[None]),
    (Angle, above(0.0, FRAC_PI_2), Some),
)
.only(&[GLOBOID]);
const INERTIA: Field<f64> = Field::quantity(
    "turret_inertia",
    "moment of inertia about its axis of the turret of a globoid cam and of all that turns with it; enables forces and torque",
    Optional("0.4 kg*m2"),
    Inertia,
    above(0.0, HEAVIEST),
)
.only(&[GLOBOID]);

const KEYS: [Key; 7] = [DISTANCE.key, ARM.key, ROLLERS.key, ADVANCE.key, RESTS_ON.key, END_ANGLE.key, INERTIA.key];

/// The keys of `[cam]` that only a globoid has.
pub(super) const SECTION: KeySection =
    KeySection { path: "cam", about: "", occurs: Occurrence::Once, cams: &[MAKE], keys: &KEYS };

/// Whether a lift is a length or an angle: a turret turns, whatever its roller would do without it.
pub(super) fn quantity(body: Option<&str>, of_follower: Quantity) -> Quantity {
    if body == Some(GLOBOID) { Quantity::Angle } else { of_follower }
}

/// A follower that moves with a turret: what turns with it is its mass.
pub(super) fn carried(follower: FollowerData, turret: Option<TurretData>) -> FollowerData {
    match turret {
        Some(turret) => FollowerData { mass: turret.inertia, ..follower },
        None => follower,
    }
}

/// The turret of a globoid; what is missing or does not fit is reported.
pub(super) fn read(reader: &Reader<'_>, body: &str, follower: Option<&FollowerData>) -> Option<TurretData> {
    if body != GLOBOID {
        return None;
    }
    let table: TableReader<'_> = reader.table(&SECTION);
    let needed =
        [(DISTANCE.key.name, table.has(&DISTANCE)), (ARM.key.name, table.has(&ARM)), ("rollers", table.has(&ROLLERS))];
    for (name, _) in needed.into_iter().filter(|(_, given)| !given) {
        let help = match name {
            "arm" => "e.g. cam.arm = \"55 mm\"",
            "rollers" => "e.g. cam.rollers = 8",
            _ => "e.g. cam.turret_distance = \"120 mm\"",
        };
        reader.fail(format!("a globoid cam needs `cam.{name}`"), Some(help.into()));
    }
    if let Some(follower) = follower {
        fits(reader, follower);
    }
    let (rollers, advance) = (whole(&table, &ROLLERS), whole(&table, &ADVANCE));
    let end_angle = table.get(&END_ANGLE);
    let (distance, arm) = (table.get(&DISTANCE)?, table.get(&ARM)?);
    if arm >= distance {
        let message = format!("an arm of {} reaches the axis of the cam", table.typed(&ARM));
        table.fail(&ARM, message, Some(format!("it must be below cam.turret_distance, {}", table.typed(&DISTANCE))));
        return None;
    }
    let found = TurretData {
        distance,
        arm,
        rollers: rollers?,
        advance: advance?,
        rests_in_groove: table.get(&RESTS_ON)?,
        end_angle: end_angle?,
        inertia: table.get(&INERTIA),
    };
    if found.index() >= PI {
        let degrees = found.index().to_degrees();
        let message = format!("a turn of the cam would move the turret on by {degrees:.3} deg");
        table.fail(&ADVANCE, message, Some("give more cam.rollers, or a smaller cam.advance".into()));
        return None;
    }
    Some(found)
}

/// The follower of a turret is a roller whose axis passes through that of the turret.
fn fits(reader: &Reader<'_>, follower: &FollowerData) {
    let straight = follower.roller.is_some_and(|roller| roller.offset == 0.0) && follower.place.is_none();
    if !straight {
        let message = format!(
            "the rollers of a turret point away from its axis, and the follower is that of [{}]",
            follower.path
        );
        reader.fail(message, Some("give [follower.roller] with its radius and no offset".into()));
    }
    if follower.mass.is_some() || follower.preload.is_some() || follower.spring_rate > 0.0 {
        let message =
            format!("[{}] gives a mass or a force along a straight path, but the turret turns", follower.path);
        reader.fail(message, Some("give cam.turret_inertia, and moments in [spring]".into()));
    }
}

/// A whole number.
pub(super) fn whole(table: &TableReader<'_>, field: &Field<f64>) -> Option<u32> {
    let typed = table.get(field)?;
    if typed.fract() != 0.0 {
        table.fail(field, format!("`{}` must be a whole number, not {typed}", field.key.name), None);
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number of at most 200")]
    Some(typed as u32)
}

//! Which body is cut for a motion program, and the measures of one whose roller runs within it.

use super::barrel::BarrelData;
use super::plate;
use super::turret::TurretData;
use camgen_kernel::document::Presence::{Default, Optional};
use camgen_kernel::document::cams::{
    self, BODIES, BODY_KINDS, CONJUGATE, DISC_BODY, GROOVE, MAKE, RIB, RING, WEDGE, YOKE,
};
use camgen_kernel::document::range::{LARGEST_FORCE, LONGEST};
use camgen_kernel::document::{Field, Input, Key, KeySection, Occurrence, Reader, TableReader, above, within};
use camgen_kernel::follower::{Element, FollowerData};
use camgen_kernel::motion::Quantity;
use camgen_kernel::units::Dimension::{Angle, Force, Length};
use std::f64::consts::PI;

/// The body of a motion program with what only one within which a roller runs has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackData {
    /// The body, by the name that keys give it: [`MAKE`] for a disc.
    pub body: &'static str,
    /// Radius of the outside of a ring, m; `None` is `auto`.
    pub outer_radius: Option<f64>,
    /// Radius of the blank of a groove, m; `None` is `auto`.
    pub blank_radius: Option<f64>,
    /// Width of a groove less the diameter of its roller, m.
    pub clearance: f64,
    /// Share of the clearance on the inner flank.
    pub clearance_share: f64,
    /// Depth of a groove, m.
    pub groove_depth: Option<f64>,
    /// Between the centres of the two rollers of a rib, along their path, m.
    pub roller_distance: Option<f64>,
    /// Between the two faces, or the near sides of the two rollers, of a yoke, m.
    pub breadth: Option<f64>,
    /// The counter disc of a pair.
    pub counter: CounterData,
    /// What only a barrel has.
    pub barrel: BarrelData,
    /// The turret of a globoid.
    pub turret: Option<TurretData>,
}

/// The counter disc of a pair of conjugate discs; what is absent is that of the main one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CounterData {
    /// Radius of its roller, m.
    pub radius: Option<f64>,
    /// Arm of its roller, m.
    pub arm: Option<f64>,
    /// Between the centres of two rollers on a straight path, m.
    pub distance: Option<f64>,
    /// Between the arms of two rollers, rad.
    pub included_angle: Option<f64>,
    /// Force along the normal with which both rollers are pressed on at rest, N.
    pub preload: f64,
}

const BODY: Field<&'static str> = Field::words(
    "body",
    "what is cut: \"disc\", the roller outside of it; \"ring\", the roller inside of it; \"groove\", the roller between two flanks; \"conjugate\", two discs for two rollers of one follower; \"rib\", a wall between two rollers; \"yoke\", a disc between two faces or rollers; \"barrel\", a cylinder with a groove round its outside; \"tapered-barrel\", the same for a conical roller; \"globoid\", a hollow round body that moves a turret with rollers on, an indexer; \"wedge\", a plate that travels under its follower",
    Default(DISC_BODY),
    BODIES,
    BODY_KINDS,
)
.also(&["kind", "type"]);
const OUTER_RADIUS: Field<Option<f64>> = Field::words_or_quantity(
    "outer_radius",
    "radius of the outside of a ring or a barrel; \"auto\": the smallest that leaves the wall, of a barrel also the smallest that keeps the pressure angle, in whole millimetres",
    Default("auto"),
    (&["auto"], &[None]),
    (Length, above(0.0, LONGEST), Some),
)
.only(cams::WITH_AN_OUTSIDE);
const BLANK_RADIUS: Field<Option<f64>> = Field::words_or_quantity(
    "blank_radius",
    "radius of the blank that a groove is cut into; \"auto\": the smallest that leaves the wall, in whole millimetres",
    Default("auto"),
    (&["auto"], &[None]),
    (Length, above(0.0, LONGEST), Some),
)
.only(&[GROOVE])
.also(&["outer"]);
const CLEARANCE: Field<f64> = Field::quantity(
    "clearance",
    "width of a groove less the diameter of its roller",
    Default("0 mm"),
    Length,
    within(0.0, LONGEST),
)
.only(cams::WITH_A_GROOVE)
.also(&["play", "gap"]);
const CLEARANCE_SHARE: Field<f64> = Field::number(
    "clearance_share",
    "share of the clearance on the inner flank, or on that below the roller of a barrel or a globoid, 0 to 1; with 0 the motion is exact where the roller runs on that flank",
    Default("0"),
    within(0.0, 1.0),
)
.only(cams::WITH_A_GROOVE);
const GROOVE_DEPTH: Field<f64> = Field::quantity(
    "groove_depth",
    "depth of a groove, below the thickness or the radius of the outside",
    Optional("10 mm"),
    Length,
    above(0.0, LONGEST),
)
.only(cams::WITH_A_GROOVE)
.also(&["depth"]);

const ROLLER_DISTANCE: Field<f64> = Field::quantity(
    "roller_distance",
    "between the centres of the two rollers of a rib, along their path; above the sum of their radii by the thickness of the wall",
    Optional("40 mm"),
    Length,
    above(0.0, LONGEST),
)
.only(&[RIB]);
const BREADTH: Field<f64> = Field::quantity(
    "breadth",
    "between the two faces of a yoke, or the near sides of its two rollers, in the place of base_radius",
    Optional("120 mm"),
    Length,
    above(0.0, LONGEST),
)
.only(&[YOKE])
.also(&["width"]);

const COUNTER_RADIUS: Field<f64> = Field::quantity(
    "radius",
    "radius of its roller; that of the other one when absent",
    Optional("18 mm"),
    Length,
    above(0.0, LONGEST),
);
const COUNTER_DIAMETER: Key =
    COUNTER_RADIUS.diameter("diameter", "diameter of its roller, in the place of its radius", "36 mm");
const COUNTER_ARM: Field<f64> = Field::quantity(
    "arm",
    "arm from the pivot to its roller; that of the other one when absent",
    Optional("100 mm"),
    Length,
    above(0.0, LONGEST),
);
const DISTANCE: Field<f64> = Field::quantity(
    "distance",
    "between the centres of two rollers on a straight path, along it; that of two discs of one prime radius when absent",
    Optional("180 mm"),
    Length,
    above(0.0, LONGEST),
);
const INCLUDED_ANGLE: Field<f64> = Field::quantity(
    "included_angle",
    "between the arms of the two rollers; that with which both begin at the same angle when absent",
    Optional("85 deg"),
    Angle,
    above(0.0, PI),
);
const PRELOAD: Field<f64> = Field::quantity(
    "preload",
    "force along the normal with which both rollers are pressed on at rest",
    Default("0 N"),
    Force,
    within(0.0, LARGEST_FORCE),
);

/// `[cam.counter]`.
pub(super) const COUNTER: KeySection = KeySection {
    path: "cam.counter",
    about: "the counter disc of a pair of conjugate discs, on the same shaft",
    occurs: Occurrence::Optional,
    cams: &[CONJUGATE],
    keys: &[COUNTER_RADIUS.key, COUNTER_DIAMETER, COUNTER_ARM.key, DISTANCE.key, INCLUDED_ANGLE.key, PRELOAD.key],
};

/// The counter disc, as far as it is described.
pub(super) fn read_counter(reader: &Reader<'_>, follower: &FollowerData) -> CounterData {
    let Some(table) = reader.find(&COUNTER) else { return CounterData::default() };
    let swings = follower.arm.is_some();
    let other = [(&DISTANCE, swings), (&INCLUDED_ANGLE, !swings), (&COUNTER_ARM, !swings)];
    for (field, _) in other.into_iter().filter(|(field, idle)| *idle && table.has(field)) {
        let moves = if swings { "swings on an arm" } else { "moves on a straight path" };
        table.fail(field, format!("the follower {moves}: `{}` has no meaning", field.key.name), None);
    }
    CounterData {
        radius: table.get(&COUNTER_RADIUS),
        arm: table.get(&COUNTER_ARM),
        distance: table.get(&DISTANCE),
        included_angle: table.get(&INCLUDED_ANGLE),
        preload: table.get(&PRELOAD).unwrap_or(0.0),
    }
}

/// The keys of `[cam]` that say which body is cut.
pub(super) const SECTION: KeySection = KeySection {
    path: "cam",
    about: "",
    occurs: Occurrence::Once,
    cams: &[MAKE],
    keys: &[
        BODY.key,
        OUTER_RADIUS.key,
        BLANK_RADIUS.key,
        CLEARANCE.key,
        CLEARANCE_SHARE.key,
        GROOVE_DEPTH.key,
        ROLLER_DISTANCE.key,
        BREADTH.key,
    ],
};

impl TrackData {
    /// Radius of the edge of a ring or of the blank of a groove, m; `None` is `auto`.
    #[must_use]
    pub fn edge_radius(&self) -> Option<f64> {
        if self.is_ring() { self.outer_radius } else { self.blank_radius }
    }

    /// Whether the metal lies around the roller only.
    #[must_use]
    pub fn is_ring(&self) -> bool {
        self.body == RING
    }
}

pub(super) fn read(table: &TableReader<'_>, thickness: Option<f64>, bored: bool) -> Option<TrackData> {
    let body = table.get(&BODY)?;
    let (blank_radius, outer_radius) = (table.get(&BLANK_RADIUS)?, table.get(&OUTER_RADIUS)?);
    let groove_depth = table.get(&GROOVE_DEPTH);
    if body == GROOVE
        && let Some(thickness) = thickness
    {
        let help = || Some("it must be above 0 and below cam.thickness".to_owned());
        match groove_depth {
            None => table.fail(&GROOVE_DEPTH, "a groove in a disc of a thickness needs a depth".into(), help()),
            Some(depth) if depth >= thickness => {
                let message = format!("the groove of {} goes through the disc", table.typed(&GROOVE_DEPTH));
                table.fail(&GROOVE_DEPTH, message, help());
            }
            Some(_) => {}
        }
    }
    // A groove in a disc may go as deep as the disc is thick.
    if body != GROOVE && cams::is_body_of(body, cams::WITH_A_GROOVE) && groove_depth.is_none() {
        let help = "e.g. cam.groove_depth = \"12 mm\"";
        table.fail(&BODY, format!("a {body} needs the depth of its groove"), Some(help.into()));
    }
    if cams::is_body_of(body, cams::CYLINDERS)
        && let (Some(outer), Some(depth)) = (outer_radius, groove_depth)
        && depth >= outer
    {
        let message = format!("the groove of {} reaches the axis of the barrel", table.typed(&GROOVE_DEPTH));
        table.fail(
            &GROOVE_DEPTH,
            message,
            Some(format!("it must be below cam.outer_radius, {}", table.typed(&OUTER_RADIUS))),
        );
    }
    if (body == RING || body == RIB) && bored {
        let message = format!("a {body} has no bore: a roller runs inside of it");
        table.fail(&BODY, message, Some("leave cam.bore_radius out".into()));
    }
    if body == RIB && !table.has(&ROLLER_DISTANCE) {
        let help = "e.g. cam.roller_distance = \"40 mm\", the diameter of a roller and the thickness of the wall";
        table.fail(&BODY, "a rib needs the distance of its two rollers".into(), Some(help.into()));
    }
    Some(TrackData {
        body,
        outer_radius,
        blank_radius,
        clearance: table.get(&CLEARANCE)?,
        clearance_share: table.get(&CLEARANCE_SHARE)?,
        groove_depth,
        roller_distance: table.get(&ROLLER_DISTANCE),
        breadth: table.get(&BREADTH),
        counter: CounterData::default(),
        barrel: BarrelData::default(),
        turret: None,
    })
}

/// A roller runs in a ring or a groove, on either side of a rib, and a yoke moves along a straight line.
pub(super) fn rolled_by(reader: &Reader<'_>, track: &TrackData, follower: &FollowerData) {
    let table = reader.table(&SECTION);
    let radius = match follower.shape.element() {
        Element::Roller { radius } => Some(radius).filter(|radius| *radius != 0.0),
        Element::Face => None,
    };
    if track.body == WEDGE {
        if let Some((why, help)) = plate::misfit(follower) {
            table.fail(&BODY, why, Some(help.into()));
        }
    } else if track.body == YOKE {
        on_a_line(&table, follower, radius);
    } else if track.body != MAKE && radius.is_none() {
        let message = format!("a {} needs a roller, and the follower is that of [{}]", track.body, follower.path);
        let help = "give [follower.roller] or [follower.swinging-roller], or cam.body = \"disc\"";
        table.fail(&BODY, message, Some(help.into()));
    }
    if let (RIB, Some(distance), Some(radius)) = (track.body, track.roller_distance, radius)
        && distance <= 2.0 * radius
    {
        let message = format!("two rollers at {} leave no wall between them", table.typed(&ROLLER_DISTANCE));
        let help = format!("it must exceed the diameter of a roller, {} mm", 2e3 * radius);
        table.fail(&ROLLER_DISTANCE, message, Some(help));
    }
}

/// The two faces or rollers of a yoke are opposite to each other, on a line through the shaft.
fn on_a_line(table: &TableReader<'_>, follower: &FollowerData, radius: Option<f64>) {
    if follower.shape.quantity() == Quantity::Angle || (radius.is_none() && follower.face.is_none()) {
        let message = format!("a yoke moves along a straight line, and the follower is that of [{}]", follower.path);
        let help = "give [follower.flat] or [follower.roller]; two rollers on one arm need cam.body = \"conjugate\"";
        table.fail(&BODY, message, Some(help.into()));
    } else if follower.place.is_some() || follower.roller.is_some_and(|roller| roller.offset != 0.0) {
        let message = "the two rollers of a yoke lie on a line through the shaft: its roller has no offset".to_owned();
        table.fail(&BODY, message, Some("leave follower.roller.offset out".into()));
    }
}

/// The inputs of a file without the body where it is a disc: the files of a disc keep the hash that they had before there were others.
pub(super) fn without_disc(inputs: Vec<Input>) -> Vec<Input> {
    let body = SECTION.path_of(&BODY.key);
    inputs.into_iter().filter(|input| input.key != body || input.value != BODIES[0]).collect()
}

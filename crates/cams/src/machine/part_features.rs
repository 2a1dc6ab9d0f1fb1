//! Features of a disc besides its profile, bore and keyway: hub, timing mark, chamfers, and the joint of a disc in two halves.

use super::fit::{self, HoleFit};
use super::hole_pattern::HolePattern;
use camgen_kernel::document::Presence::{Default, Optional, Required};
use camgen_kernel::document::cams::WITH_HOLES;
use camgen_kernel::document::range::LONGEST;
use camgen_kernel::document::{Bounds, Field, KeySection, Occurrence, Reader, TableReader, above, cams, within};
use camgen_kernel::units::Dimension::{Angle, Length};
use std::f64::consts::PI;

/// The features of a disc.
#[derive(Debug, Clone, Copy, PartialEq, std::default::Default)]
pub struct PartFeatures {
    /// Its hub.
    pub hub: Option<Hub>,
    /// A timing mark that is not a hole.
    pub timing_mark: Option<TimingMark>,
    /// Chamfer of 45° at both ends of the bore, m.
    pub chamfer: Option<f64>,
    /// Cam angle of the joint of a disc in two halves, rad; the joint goes through the axis.
    pub split: Option<f64>,
}

/// A cylinder about the shaft that is longer than the disc is thick: `[cam.hub]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hub {
    /// Radius, m.
    pub radius: f64,
    /// How far it stands out behind the disc, m.
    pub behind: f64,
    /// How far it stands out in front of the disc, on the side that the drawing shows, m.
    pub in_front: f64,
}

/// A mark by which the cam is set on its shaft: `[cam.timing_mark]`. A hole is a [`HolePattern`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TimingMark {
    /// A line engraved in the front face along a radius.
    Line {
        /// Cam angle, rad.
        angle: f64,
        /// Distance of its inner end from the axis, m.
        from: f64,
        /// Distance of its outer end from the axis, m.
        to: f64,
    },
    /// A V of 90° in the rim of the blank.
    Notch {
        /// Cam angle, rad.
        angle: f64,
        /// Depth, m.
        depth: f64,
    },
}

const SIZE: Bounds = above(0.0, LONGEST);
/// Largest chamfer, m.
const LARGEST_CHAMFER: f64 = 0.05;

const HUB_DIAMETER: Field<f64> =
    Field::quantity("diameter", "its diameter", Required("48 mm"), Length, SIZE).only(WITH_HOLES);
const HUB_LENGTH: Field<f64> = Field::quantity(
    "length",
    "how far it stands out from the face of the disc, on each of its sides",
    Required("20 mm"),
    Length,
    SIZE,
)
.also(&["height", "width"])
.only(WITH_HOLES);
const HUB_SIDE: Field<HubSide> = Field::words(
    "side",
    "\"back\", \"front\" (the side that drawing and DXF show, on which a groove is open), or \"both\"",
    Default("back"),
    &["back", "front", "both"],
    &[HubSide::Back, HubSide::Front, HubSide::Both],
)
.only(WITH_HOLES);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum HubSide {
    Back,
    Front,
    Both,
}

/// `[cam.hub]`.
pub(super) const HUB: KeySection = KeySection {
    path: "cam.hub",
    about: "a hub: in the solid, the drawing, mass and balance; it is turned, and not in the DXF file",
    occurs: Occurrence::Optional,
    cams: &[],
    keys: &[HUB_DIAMETER.key, HUB_LENGTH.key, HUB_SIDE.key],
};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum MarkForm {
    Hole,
    Line,
    Notch,
}

const FORM: Field<MarkForm> = Field::words(
    "form",
    "\"hole\" through the disc; \"line\" engraved in the front face, for the drawing only; \"notch\" of 90° in the rim of a groove's blank",
    Default("hole"),
    &["hole", "line", "notch"],
    &[MarkForm::Hole, MarkForm::Line, MarkForm::Notch],
)
.only(WITH_HOLES);
const MARK_ANGLE: Field<f64> = Field::quantity(
    "angle",
    "cam angle of its middle, -360 deg to 360 deg",
    Default("0 deg"),
    Angle,
    within(-2.0 * PI, 2.0 * PI),
)
.only(WITH_HOLES);
const MARK_CIRCLE: Field<f64> = Field::quantity(
    "circle_diameter",
    "diameter of the circle on which a hole lies, or on which a line begins; a hole and a line need it",
    Optional("100 mm"),
    Length,
    SIZE,
)
.only(WITH_HOLES);
const MARK_DIAMETER: Field<f64> =
    Field::quantity("diameter", "diameter of a hole", Default("6 mm"), Length, SIZE).only(WITH_HOLES);
const MARK_FIT: Field<String> =
    Field::text("fit", "tolerance class of a hole, for the drawing: H7 for a pin", Optional("H7")).only(WITH_HOLES);
const MARK_LENGTH: Field<f64> =
    Field::quantity("length", "length of a line, outwards", Default("8 mm"), Length, SIZE).only(WITH_HOLES);
const MARK_DEPTH: Field<f64> =
    Field::quantity("depth", "depth of a notch", Default("2 mm"), Length, SIZE).only(WITH_HOLES);

/// `[cam.timing_mark]`.
pub(super) const TIMING_MARK: KeySection = KeySection {
    path: "cam.timing_mark",
    about: "a mark by which the cam is set on its shaft",
    occurs: Occurrence::Optional,
    cams: &[],
    keys: &[
        FORM.key,
        MARK_ANGLE.key,
        MARK_CIRCLE.key,
        MARK_DIAMETER.key,
        MARK_FIT.key,
        MARK_LENGTH.key,
        MARK_DEPTH.key,
    ],
};

/// A key of `[cam]`.
pub(super) const CHAMFER: Field<f64> = Field::quantity(
    "chamfer",
    "chamfer of 45° at both ends of the bore, for the drawing; the solid has sharp edges",
    Optional("1 mm"),
    Length,
    above(0.0, LARGEST_CHAMFER),
)
.only(WITH_HOLES);
/// A key of `[cam]`.
pub(super) const SPLIT: Field<f64> = Field::quantity(
    "split",
    "cam angle of the joint of a disc in two halves, -360 deg to 360 deg: the profile is cut with the halves clamped together, and the joint is drawn",
    Optional("90 deg"),
    Angle,
    within(-2.0 * PI, 2.0 * PI),
)
.only(WITH_HOLES);

/// The features of the disc of a file, of its table `[cam]`, and its timing hole, if it has one.
pub(super) fn read(
    reader: &Reader<'_>,
    table: &TableReader<'_>,
    (body, has_thickness): (&str, bool),
) -> (PartFeatures, Option<HolePattern>) {
    refuse_on_others(reader, (&HUB, &HUB_DIAMETER), body);
    refuse_on_others(reader, (&TIMING_MARK, &FORM), body);
    let mark = reader.find(&TIMING_MARK);
    let hub = reader.find(&HUB).and_then(|hub| read_hub(&hub, (body, has_thickness)));
    let form = mark.as_ref().and_then(|mark| mark.get(&FORM));
    let hole = mark.as_ref().filter(|_| form == Some(MarkForm::Hole)).and_then(read_hole);
    let timing_mark = mark.as_ref().zip(form).and_then(|(mark, form)| read_mark(mark, form, body));
    let features = PartFeatures { hub, timing_mark, chamfer: table.get(&CHAMFER), split: table.get(&SPLIT) };
    (features, hole)
}

/// A fault of a table that the body of a file cannot have: left out, the part would lack a feature that its designer expects.
pub(super) fn refuse_on_others<T>(reader: &Reader<'_>, (section, key): (&KeySection, &Field<T>), body: &str) {
    if cams::is_body_of(body, WITH_HOLES) {
        return;
    }
    if let Some(table) = reader.find(section) {
        let help = Some(format!("leave {} out: discs and grooves have it", section.path));
        table.fail(key, format!("camgen does not make {} in a {body} cam", section.path), help);
    }
}

fn read_hub(table: &TableReader<'_>, (body, has_thickness): (&str, bool)) -> Option<Hub> {
    let (diameter, length) = (table.get(&HUB_DIAMETER)?, table.get(&HUB_LENGTH)?);
    if !has_thickness {
        table.fail(&HUB_LENGTH, "a hub needs the thickness of the disc".into(), Some("add cam.thickness".into()));
    }
    if body == cams::CONJUGATE {
        let help = Some("leave [cam.hub] out, and draw a hub for each disc".into());
        table.fail(
            &HUB_DIAMETER,
            "the two discs of a pair lie on each other: a hub would stand in between".into(),
            help,
        );
        return None;
    }
    let (behind, in_front) = match table.get(&HUB_SIDE)? {
        HubSide::Back => (length, 0.0),
        HubSide::Front => (0.0, length),
        HubSide::Both => (length, length),
    };
    Some(Hub { radius: 0.5 * diameter, behind, in_front })
}

/// The diameter of the circle of a mark; a fault if it is missing.
fn circle(table: &TableReader<'_>) -> Option<f64> {
    if !table.has(&MARK_CIRCLE) {
        let help = Some("add cam.timing_mark.circle_diameter".into());
        table.fail(&FORM, "a hole or a line needs the circle on which it lies".into(), help);
    }
    table.get(&MARK_CIRCLE)
}

fn read_hole(table: &TableReader<'_>) -> Option<HolePattern> {
    let fit: Option<HoleFit> = fit::read(table, &MARK_FIT);
    Some(HolePattern {
        key: TIMING_MARK.path.into(),
        count: 1,
        circle_radius: 0.5 * circle(table)?,
        radius: 0.5 * table.get(&MARK_DIAMETER)?,
        angle: table.get(&MARK_ANGLE)?,
        fit,
        purpose: Some("timing".into()),
    })
}

fn read_mark(table: &TableReader<'_>, form: MarkForm, body: &str) -> Option<TimingMark> {
    let angle = table.get(&MARK_ANGLE)?;
    match form {
        MarkForm::Hole => None,
        MarkForm::Line => {
            let from = 0.5 * circle(table)?;
            Some(TimingMark::Line { angle, from, to: from + table.get(&MARK_LENGTH)? })
        }
        MarkForm::Notch if body != cams::GROOVE => {
            let help = Some("give form = \"hole\" or \"line\"".into());
            table.fail(&FORM, "the rim of this cam is its profile: a notch would be felt by the follower".into(), help);
            None
        }
        MarkForm::Notch => Some(TimingMark::Notch { angle, depth: table.get(&MARK_DEPTH)? }),
    }
}

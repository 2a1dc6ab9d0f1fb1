//! The linkage that moves the bed: what its crank does to it.

use crate::buffer::Bed;
use crate::document::Presence::{Default, Optional};
use crate::document::cams::{LINKAGE, OF_A_LINKAGE};
use crate::document::range::{LARGEST_NUMBER, LONGEST};
use crate::document::{Field, Occurs, Reader, Section, Table, above, within};
use crate::linkage::{Branch, DragLink, End, Linkage, LinkageError, Slider, StrokeEnd};
use crate::units::Dimension::{Angle, Length};
use std::f64::consts::PI;

/// What a file says of the linkage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkageData {
    /// The linkage, its links over their cranks.
    pub linkage: Linkage,
    /// Driving crank O1A of a six-bar, m: for drawings and lengths.
    pub driving_crank: Option<f64>,
    /// Angle of the base O1O2 from the line of the slider, rad.
    pub base_angle: f64,
}

impl LinkageData {
    /// The angle of the driving crank from the line of the slider, rad, where it stands at θ from its base.
    #[must_use]
    pub fn to_line(&self, theta: f64) -> f64 {
        if matches!(self.linkage, Linkage::SixBar(..)) { theta + self.base_angle } else { theta }
    }

    /// An end of the stroke of a bed; `None` under a yoke, and where no buffer can balance it.
    pub(super) fn stroke_end(&self, bed: &Bed, end: End) -> Option<StrokeEnd> {
        match self.linkage {
            Linkage::Yoke => None,
            linkage => StrokeEnd::new(linkage, bed.crank_radius, end),
        }
    }
}

/// Kinds by their names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Yoke,
    CrankSlider,
    SixBar,
}

const KIND: Field<Kind> = Field::words(
    "kind",
    "\"yoke\" (x = r sin φ), \"crank-slider\" or \"six-bar\" (a drag link before the crank-slider)",
    Default("yoke"),
    &["yoke", "crank-slider", "six-bar"],
    &[Kind::Yoke, Kind::CrankSlider, Kind::SixBar],
);
const ROD_RATIO: Field<f64> = Field::number(
    "rod_ratio",
    "connecting rod over the crank of the slider, bed.crank_radius",
    Optional("3"),
    above(0.0, LARGEST_NUMBER),
);
const ROD: Field<f64> = Field::quantity("rod", "the same as a length", Optional("540 mm"), Length, above(0.0, LONGEST));
const OFFSET_RATIO: Field<f64> = Field::number(
    "offset_ratio",
    "offset of the slider's line over that crank, positive to the left of its outward direction",
    Optional("0"),
    within(-LARGEST_NUMBER, LARGEST_NUMBER),
);
const OFFSET: Field<f64> =
    Field::quantity("offset", "the same as a length", Optional("0 mm"), Length, within(-LONGEST, LONGEST));
const BASE_RATIO: Field<f64> = Field::number(
    "base_ratio",
    "base of the drag link over its driving crank, below 1",
    Optional("0.1"),
    within(0.0, LARGEST_NUMBER),
);
const COUPLER_RATIO: Field<f64> = Field::number(
    "coupler_ratio",
    "coupler of the drag link over its driving crank",
    Optional("0.8"),
    above(0.0, LARGEST_NUMBER),
);
const FOLLOWER_RATIO: Field<f64> = Field::number(
    "follower_ratio",
    "driven crank of the drag link over its driving crank",
    Optional("0.6"),
    above(0.0, LARGEST_NUMBER),
);
const FOLLOWER_ANGLE: Field<f64> = Field::quantity(
    "follower_angle",
    "from the driven crank of the drag link to the crank of the slider",
    Default("180 deg"),
    Angle,
    within(-2.0 * PI, 2.0 * PI),
);
const BASE_ANGLE: Field<f64> = Field::quantity(
    "base_angle",
    "of the base of the drag link from the line of the slider",
    Default("0 deg"),
    Angle,
    within(-2.0 * PI, 2.0 * PI),
);
const DRIVING_CRANK: Field<f64> = Field::quantity(
    "driving_crank",
    "length of the driving crank, for lengths and the picture",
    Optional("180 mm"),
    Length,
    above(0.0, LONGEST),
)
.only(&[LINKAGE]);

/// `[linkage]`.
pub(super) const SECTION: Section = Section {
    path: "linkage",
    about: "what moves the bed between its cranks",
    occurs: Occurs::Optional,
    cams: OF_A_LINKAGE,
    keys: &[
        KIND.key,
        ROD_RATIO.key,
        ROD.key,
        OFFSET_RATIO.key,
        OFFSET.key,
        BASE_RATIO.key,
        COUPLER_RATIO.key,
        FOLLOWER_RATIO.key,
        FOLLOWER_ANGLE.key,
        BASE_ANGLE.key,
        DRIVING_CRANK.key,
    ],
};

pub(super) fn read(reader: &Reader<'_>, bed: Option<&Bed>) -> Option<LinkageData> {
    let table = reader.find(&SECTION)?;
    let kind = table.get(&KIND)?;
    let linkage = match kind {
        Kind::Yoke => {
            let links = [table.has(&ROD_RATIO), table.has(&ROD), table.has(&BASE_RATIO), table.has(&COUPLER_RATIO)];
            if links.contains(&true) {
                let help = Some("give linkage.kind = \"crank-slider\" or \"six-bar\", or leave them out".into());
                table.fail(&KIND, "a yoke has no rod and no drag link".into(), help);
            }
            Linkage::Yoke
        }
        Kind::CrankSlider => Linkage::CrankSlider(slider(&table, bed)?),
        Kind::SixBar => Linkage::SixBar(drag_link(&table)?, slider(&table, bed)?),
    };
    if let Err(error) = linkage.check() {
        let message = error.to_string();
        match error {
            LinkageError::RodTooShort { .. } if table.has(&ROD) => table.fail(&ROD, message, None),
            LinkageError::RodTooShort { .. } => table.fail(&ROD_RATIO, message, None),
            _ => table.fail(&BASE_RATIO, message, None),
        }
        return None;
    }
    let (driving_crank, base_angle) = (table.get(&DRIVING_CRANK), table.get(&BASE_ANGLE)?);
    Some(LinkageData { linkage, driving_crank, base_angle })
}

/// A ratio, given as such or as a length over the crank of the slider; what is in neither form is `default`.
fn ratio(
    table: &Table<'_>,
    (number, length): (&Field<f64>, &Field<f64>),
    default: Option<f64>,
    bed: Option<&Bed>,
) -> Option<f64> {
    match (table.get(number), table.get(length)) {
        (Some(_), Some(_)) => {
            let help = Some(format!("leave out linkage.{} or linkage.{}", number.key.name, length.key.name));
            table.fail(length, "the same is given twice".into(), help);
            None
        }
        (Some(ratio), None) => Some(ratio),
        (None, Some(length)) => Some(length / bed?.crank_radius),
        (None, None) if table.has(number) || table.has(length) => None,
        (None, None) => {
            if default.is_none() {
                let help = Some(format!("add it, e.g. {} = {}", number.key.name, number.key.presence.text()));
                table.fail(number, format!("missing key `linkage.{}`", number.key.name), help);
            }
            default
        }
    }
}

fn slider(table: &Table<'_>, bed: Option<&Bed>) -> Option<Slider> {
    let rod = ratio(table, (&ROD_RATIO, &ROD), None, bed);
    let offset = ratio(table, (&OFFSET_RATIO, &OFFSET), Some(0.0), bed);
    Some(Slider { rod_ratio: rod?, offset_ratio: offset? })
}

fn drag_link(table: &Table<'_>) -> Option<DragLink> {
    let needed = |field: &Field<f64>| {
        let value = table.get(field);
        if value.is_none() && !table.has(field) {
            let help = Some(format!("add it, e.g. {} = {}", field.key.name, field.key.presence.text()));
            table.fail(field, format!("missing key `linkage.{}`", field.key.name), help);
        }
        value
    };
    let (base, coupler, follower) = (needed(&BASE_RATIO), needed(&COUPLER_RATIO), needed(&FOLLOWER_RATIO));
    let turn = table.get(&FOLLOWER_ANGLE)? + table.get(&BASE_ANGLE)?;
    Some(DragLink { base: base?, coupler: coupler?, follower: follower?, turn, branch: Branch::Leading })
}

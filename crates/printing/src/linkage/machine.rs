//! The linkage that moves the bed: motion, forces and figures over a turn of its crank.

pub(super) mod limits;

pub use limits::LinkageLimits;

use crate::linkage::LINKAGE;
use crate::press::bed_motion::{Branch, DragLink, End, Linkage, Slider};
use crate::press::buffer::Bed;
use crate::press::cams::{CONOID, REGIMES, ROTARY, SCATTER, SPRING, TRANSLATING};
use crate::press::machine::{LinkageData, Press, bed};
use camgen_cams::machine::{CamData, FollowerData, Machine, MachineParts};
use camgen_kernel::document::Presence::{Default, Optional};
use camgen_kernel::document::range::{LARGEST_NUMBER, LONGEST};
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, TableReader, above, within};
use camgen_kernel::units::Dimension::{Angle, Length};
use std::f64::consts::PI;

/// Kinds by their names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum LinkageKind {
    Yoke,
    CrankSlider,
    SixBar,
}

const KIND: Field<LinkageKind> = Field::words(
    "kind",
    "\"yoke\" (x = r sin φ), \"crank-slider\" or \"six-bar\" (a drag link before the crank-slider)",
    Default("yoke"),
    &["yoke", "crank-slider", "six-bar"],
    &[LinkageKind::Yoke, LinkageKind::CrankSlider, LinkageKind::SixBar],
);
const ROD_RATIO: Field<f64> = Field::number(
    "rod_ratio",
    "connecting rod over the crank of the slider, bed.crank_radius",
    Optional("3"),
    above(0.0, LARGEST_NUMBER),
);
const ROD: Field<f64> = Field::quantity(
    "rod",
    "length of the connecting rod, in place of rod_ratio",
    Optional("540 mm"),
    Length,
    above(0.0, LONGEST),
);
const OFFSET_RATIO: Field<f64> = Field::number(
    "offset_ratio",
    "offset of the slider's line over that crank, positive to the left of its outward direction",
    Optional("0"),
    within(-LARGEST_NUMBER, LARGEST_NUMBER),
);
const OFFSET: Field<f64> = Field::quantity(
    "offset",
    "that offset as a length, in place of offset_ratio",
    Optional("0 mm"),
    Length,
    within(-LONGEST, LONGEST),
);
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
    "angle from the driven crank of the drag link to the crank of the slider",
    Default("180 deg"),
    Angle,
    within(-2.0 * PI, 2.0 * PI),
);
const BASE_ANGLE: Field<f64> = Field::quantity(
    "base_angle",
    "angle of the base of the drag link from the line of the slider",
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

/// Whatever a linkage moves.
const MOVED_BY_A_LINKAGE: &[&str] = &[ROTARY, TRANSLATING, CONOID, REGIMES, SPRING, SCATTER, LINKAGE];

/// `[linkage]`.
pub(super) const SECTION: KeySection = KeySection {
    path: "linkage",
    about: "the linkage that moves the bed",
    occurs: Occurrence::Optional,
    cams: MOVED_BY_A_LINKAGE,
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

/// Reads the linkage of a file and its limits, and puts the buffers of the press at the outer end of its stroke.
pub(super) fn read(reader: &Reader<'_>, _: (Option<&CamData>, Option<&FollowerData>), parts: &mut MachineParts) {
    if let Some(limits) = limits::read(reader) {
        parts.set(limits);
    }
    let bed = bed::read(reader);
    let Some(data) = linkage(reader, bed.as_ref()) else { return };
    parts.set(data);
    let press = parts.get::<Press>().copied();
    if let Some(press) = press {
        let stroke_end = data.stroke_end(&press.bed, End::Outer);
        parts.set(Press { linkage: Some(data), stroke_end, ..press });
    }
}

/// What a machine file says of a linkage: methods of the [`Machine`].
pub trait MachineOfLinkage {
    /// The linkage that moves the bed.
    #[must_use]
    fn linkage(&self) -> Option<&LinkageData>;

    /// The limits that a linkage must keep.
    #[must_use]
    fn linkage_limits(&self) -> LinkageLimits;
}

impl MachineOfLinkage for Machine {
    fn linkage(&self) -> Option<&LinkageData> {
        self.part()
    }

    fn linkage_limits(&self) -> LinkageLimits {
        self.part().copied().unwrap_or_default()
    }
}

fn linkage(reader: &Reader<'_>, bed: Option<&Bed>) -> Option<LinkageData> {
    let table = reader.find(&SECTION)?;
    let kind = table.get(&KIND)?;
    let linkage = match kind {
        LinkageKind::Yoke => {
            let links = [table.has(&ROD_RATIO), table.has(&ROD), table.has(&BASE_RATIO), table.has(&COUPLER_RATIO)];
            if links.contains(&true) {
                let help = Some("give linkage.kind = \"crank-slider\" or \"six-bar\", or leave them out".into());
                table.fail(&KIND, "a yoke has no rod and no drag link".into(), help);
            }
            Linkage::Yoke
        }
        LinkageKind::CrankSlider => Linkage::CrankSlider(slider(&table, bed)?),
        LinkageKind::SixBar => Linkage::SixBar(drag_link(&table)?, slider(&table, bed)?),
    };
    if let Err(error) = linkage.check() {
        let of_rod = linkage.slider().is_some_and(|slider| slider.check().is_err());
        let key = match (of_rod, table.has(&ROD)) {
            (true, true) => &ROD,
            (true, false) => &ROD_RATIO,
            (false, _) => &BASE_RATIO,
        };
        let remedy = error.remedy_words();
        table.fail(key, error.what, remedy);
        return None;
    }
    let (driving_crank, base_angle) = (table.get(&DRIVING_CRANK), table.get(&BASE_ANGLE)?);
    Some(LinkageData { linkage, driving_crank, base_angle })
}

/// A ratio, given as such or as a length over the crank of the slider; what is in neither form is `default`.
fn ratio(
    table: &TableReader<'_>,
    number: &Field<f64>,
    length: &Field<f64>,
    default: Option<f64>,
    bed: Option<&Bed>,
) -> Option<f64> {
    match (table.get(number), table.get(length)) {
        (Some(_), Some(_)) => {
            let help = Some(format!("leave out linkage.{} or linkage.{}", number.key.name, length.key.name));
            table.fail(length, "this dimension is given twice, as a ratio and as a length".into(), help);
            None
        }
        (Some(ratio), None) => Some(ratio),
        (None, Some(length)) => Some(length / bed?.crank_radius),
        (None, None) if table.has(number) || table.has(length) => None,
        (None, None) => {
            if default.is_none() {
                report_missing(table, number);
            }
            default
        }
    }
}

fn report_missing(table: &TableReader<'_>, field: &Field<f64>) {
    let help = Some(format!("add it, e.g. {} = {}", field.key.name, field.key.presence.text()));
    table.fail(field, format!("missing key `linkage.{}`", field.key.name), help);
}

/// The value of a key; a missing key is a fault.
fn required(table: &TableReader<'_>, field: &Field<f64>) -> Option<f64> {
    let value = table.get(field);
    if value.is_none() && !table.has(field) {
        report_missing(table, field);
    }
    value
}

fn slider(table: &TableReader<'_>, bed: Option<&Bed>) -> Option<Slider> {
    let rod = ratio(table, &ROD_RATIO, &ROD, None, bed);
    let offset = ratio(table, &OFFSET_RATIO, &OFFSET, Some(0.0), bed);
    Some(Slider { rod_ratio: rod?, offset_ratio: offset? })
}

fn drag_link(table: &TableReader<'_>) -> Option<DragLink> {
    let base = required(table, &BASE_RATIO);
    let coupler = required(table, &COUPLER_RATIO);
    let follower = required(table, &FOLLOWER_RATIO);
    let turn = table.get(&FOLLOWER_ANGLE)? + table.get(&BASE_ANGLE)?;
    Some(DragLink { base: base?, coupler: coupler?, follower: follower?, turn, branch: Branch::Leading })
}

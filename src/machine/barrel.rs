//! The measures of a barrel: what the roller reaches of its groove, and how long the blank is.

use crate::document::Presence::{Default, Optional};
use crate::document::cams::{BARREL, GLOBOID, MAKE};
use crate::document::range::LONGEST;
use crate::document::{Field, KeySection, Occurrence, Reader, TableReader, above};
use crate::units::Dimension::Length;

/// What only a barrel has.
#[derive(Debug, Clone, Copy, PartialEq, core::default::Default)]
pub struct BarrelData {
    /// How far the roller reaches into the groove, m; its depth when absent.
    pub roller_height: Option<f64>,
    /// Length of the blank along the axis, m; `None` is `auto`.
    pub blank_length: Option<f64>,
}

const ROLLER_HEIGHT: Field<f64> = Field::quantity(
    "roller_height",
    "how far the roller reaches into the groove of a barrel or a globoid; the depth of the groove when absent",
    Optional("11 mm"),
    Length,
    above(0.0, LONGEST),
)
.only(&[BARREL, GLOBOID]);
const BLANK_LENGTH: Field<Option<f64>> = Field::words_or_quantity(
    "blank_length",
    "length of the blank of a barrel along its axis; \"auto\": the groove and the wall on either side of it, in whole millimetres",
    Default("auto"),
    (&["auto"], &[None]),
    (Length, above(0.0, LONGEST), Some),
)
.only(&[BARREL]);

/// The keys of `[cam]` that only a barrel has.
pub(super) const SECTION: KeySection = KeySection {
    path: "cam",
    about: "",
    occurs: Occurrence::Once,
    cams: &[MAKE],
    keys: &[ROLLER_HEIGHT.key, BLANK_LENGTH.key],
};

pub(super) fn read(reader: &Reader<'_>) -> Option<BarrelData> {
    let table: TableReader<'_> = reader.table(&SECTION);
    Some(BarrelData { roller_height: table.get(&ROLLER_HEIGHT), blank_length: table.get(&BLANK_LENGTH)? })
}

//! The measures of a barrel: what the roller reaches of its groove, and how long the blank is.

use camgen_kernel::document::Presence::{Default, Optional};
use camgen_kernel::document::cams::{CYLINDERS, MAKE, WITH_A_GROOVE};
use camgen_kernel::document::range::LONGEST;
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, TableReader, above};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::units::Dimension::Length;

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
    "reach of the roller into a groove, its contact length: the depth of the groove minus the clearance at the floor and a chamfer; the depth of \
     the groove when absent",
    Optional("9 mm"),
    Length,
    above(0.0, LONGEST),
)
.only(WITH_A_GROOVE);
const BLANK_LENGTH: Field<Option<f64>> = Field::words_or_quantity(
    "blank_length",
    "length of the blank of a barrel along its axis; \"auto\": the groove and the wall on either side of it, in whole millimetres",
    Default("auto"),
    (&["auto"], &[None]),
    (Length, above(0.0, LONGEST), Some),
)
.only(CYLINDERS);

/// The keys of `[cam]` that only a barrel has.
pub(super) const SECTION: KeySection = KeySection {
    path: "cam",
    about: "",
    occurs: Occurrence::Once,
    cams: &[MAKE],
    keys: &[ROLLER_HEIGHT.key, BLANK_LENGTH.key],
};

pub(super) fn read(reader: &Reader<'_>, groove_depth: Option<f64>) -> Option<BarrelData> {
    let table: TableReader<'_> = reader.table(&SECTION);
    let roller_height = table.get(&ROLLER_HEIGHT);
    if let (Some(reach), Some(depth)) = (roller_height, groove_depth)
        && reach > depth
    {
        let message = format!("the roller reaches {} into a groove that is less deep", table.typed(&ROLLER_HEIGHT));
        let help = format!("it must not exceed cam.groove_depth, {} mm", MILLIMETRES * depth);
        table.fail(&ROLLER_HEIGHT, message, Some(help));
    }
    Some(BarrelData { roller_height, blank_length: table.get(&BLANK_LENGTH)? })
}

//! The air buffer: cylinder, column, and the speed it is sized for.

use super::losses::{BALANCE, EXPANSION_EXPONENT, ExpansionBalance, LEAK, PISTON_FRICTION};
use super::press::{AirColumn, DRIVE, PRESS, Press};
use crate::press::buffer::Bed;
use crate::press::buffer::bottom_law::ColumnRule;
use crate::press::cams::{OF_A_COLUMN, OF_A_DESIGN, OF_A_LAW, OF_A_SPEED, OF_AIR};
use camgen_kernel::document::Presence::{Default, Required, RequiredUnless};
use camgen_kernel::document::range::{HIGHEST_PRESSURE, LARGEST_NUMBER, LEAST_RPM, LONGEST, THINNEST, TURNS_FORWARD};
use camgen_kernel::document::{Bounds, Field, KeySection, Occurrence, Reader, above, within};
use camgen_kernel::units::Dimension::{Length, Pressure};

const PRESSURE: Bounds = above(0.0, HIGHEST_PRESSURE);

pub(super) const POLYTROPIC_EXPONENT: Field<f64> = Field::number(
    "polytropic_exponent",
    "k of p·v^k = const, 1 to 3; 1.35 to 1.40 for a quick air buffer",
    Default("1.35"),
    within(1.0, 3.0),
);
pub(super) const AMBIENT_PRESSURE: Field<f64> =
    Field::quantity("ambient_pressure", "pressure of the ambient air, absolute", Required("1 at"), Pressure, PRESSURE);
const END_PRESSURE: Field<f64> = Field::quantity(
    "end_pressure",
    "absolute pressure at the end of compression at the design speed; above ambient_pressure",
    RequiredUnless(DRIVE, "2 at"),
    Pressure,
    PRESSURE,
)
.only(OF_A_DESIGN);
pub(super) const COLUMN: Field<AirColumn> = Field::words_or_quantity(
    "column",
    "air column: \"matched\" (the law starts with slope 0), \"return\" (the bottom comes back), \"least-torque\" (on the camshaft) or \
     a length",
    Default("matched"),
    (
        &["matched", "return", "least-torque"],
        &[AirColumn::Of(ColumnRule::Matched), AirColumn::Of(ColumnRule::Return), AirColumn::LeastTorque],
    ),
    (Length, within(THINNEST, LONGEST), |length| AirColumn::Of(ColumnRule::Length(length))),
)
.only(OF_A_COLUMN);
const LEAD: Field<f64> = Field::quantity(
    "lead",
    "piston travel inside the cylinder before the reversal starts",
    Default("0 mm"),
    Length,
    within(0.0, LONGEST),
)
.only(OF_A_LAW);

/// `[buffer]`.
pub(super) const SECTION: KeySection = KeySection {
    path: "buffer",
    about: "the air buffer",
    occurs: Occurrence::With(PRESS),
    cams: OF_AIR,
    keys: &[
        POLYTROPIC_EXPONENT.key,
        AMBIENT_PRESSURE.key,
        END_PRESSURE.key,
        COLUMN.key,
        LEAD.key,
        EXPANSION_EXPONENT.key,
        BALANCE.key,
        LEAK.key,
        PISTON_FRICTION.key,
    ],
};

const RPM: Field<f64> = Field::number(
    "rpm",
    "main-shaft speed the cylinders are sized for, 0.001 to 100000",
    Default("35"),
    within(LEAST_RPM, LARGEST_NUMBER),
)
.hint(TURNS_FORWARD);

/// `[design]`.
pub(super) const DESIGN: KeySection = KeySection {
    path: "design",
    about: "the speed that the machine is designed for",
    occurs: Occurrence::With(PRESS),
    cams: OF_A_SPEED,
    keys: &[RPM.key],
};

/// The press with its bed, when the tables are there and have no fault.
pub(super) fn read(reader: &Reader<'_>, bed: Option<Bed>) -> Option<Press> {
    let table = reader.table(&SECTION);
    if let (Some(ambient), Some(end)) = (table.get(&AMBIENT_PRESSURE), table.get(&END_PRESSURE))
        && end <= ambient
    {
        let (end, ambient) = (table.typed(&END_PRESSURE), table.typed(&AMBIENT_PRESSURE));
        let message = format!("end_pressure must be above ambient_pressure: {end} ≤ {ambient}");
        let help = "both are absolute; an end pressure of 1 at gauge is 2 at absolute";
        table.fail(&END_PRESSURE, message, Some(help.into()));
    }
    if let Some(lead) = table.get(&LEAD).filter(|lead| *lead > 0.0 && *lead < THINNEST) {
        let message = format!("`buffer.lead` must be 0, or at least {} mm: {}", 1e3 * THINNEST, table.typed(&LEAD));
        let help = format!("a lead of {lead:e} m turns the cam by less than a file can resolve; write \"0 mm\"");
        table.fail(&LEAD, message, Some(help));
    }
    let levels = table.get(&BALANCE) == Some(ExpansionBalance::Level);
    if levels && table.get(&LEAD).is_some_and(|lead| lead > 0.0) {
        let message = "buffer.balance = \"level\" has a lead of its own, and `buffer.lead` is given";
        let help = "leave out buffer.lead: the report shows how early the port shuts";
        table.fail(&LEAD, message.into(), Some(help.into()));
    }
    let exponent = table.get(&POLYTROPIC_EXPONENT);
    Some(Press {
        bed: bed?,
        linkage: None,
        stroke_end: None,
        polytropic_exponent: exponent?,
        ambient_pressure: table.get(&AMBIENT_PRESSURE)?,
        end_pressure: table.get(&END_PRESSURE)?,
        column: table.get(&COLUMN)?,
        lead: table.get(&LEAD)?,
        design_rpm: reader.table(&DESIGN).get(&RPM)?,
        compensated_train: None,
        levelled: if levels { table.get(&EXPANSION_EXPONENT).or(exponent) } else { None },
    })
}

//! The bed and its crank.

use super::losses::BED_FRICTION;
use super::press::PRESS;
use crate::press::buffer::Bed;
use crate::press::cams::{OF_A_BED, OF_A_SPEED};
use camgen_kernel::document::Presence::{Default, Required};
use camgen_kernel::document::range::{HEAVIEST, LARGEST_NUMBER, LONGEST};
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, above};
use camgen_kernel::units::Dimension::{Length, Mass};

pub(super) const MASS: Field<f64> =
    Field::quantity("mass", "moving mass of the bed with its forme", Required("978.2 kg"), Mass, above(0.0, HEAVIEST));
pub(super) const CRANK_RADIUS: Field<f64> = Field::quantity(
    "crank_radius",
    "crank radius r = the whole overrun of the bed",
    Required("180 mm"),
    Length,
    above(0.0, LONGEST),
);
const CRANK_TURNS: Field<f64> = Field::number(
    "crank_turns_per_main_shaft_turn",
    "turns of the reversing crank for one turn of the main shaft",
    Default("3"),
    above(0.0, LARGEST_NUMBER),
)
.only(OF_A_SPEED);

/// `[bed]`.
pub(crate) const SECTION: KeySection = KeySection {
    path: "bed",
    about: "the bed and its crank",
    occurs: Occurrence::With(PRESS),
    cams: OF_A_BED,
    keys: &[MASS.key, CRANK_RADIUS.key, CRANK_TURNS.key, BED_FRICTION.key],
};

pub(crate) fn read(reader: &Reader<'_>) -> Option<Bed> {
    let table = reader.find(&SECTION)?;
    Some(Bed {
        mass: table.get(&MASS)?,
        crank_radius: table.get(&CRANK_RADIUS)?,
        crank_turns_per_main_shaft_turn: table.get(&CRANK_TURNS)?,
    })
}

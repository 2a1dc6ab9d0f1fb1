//! The transition between dwell and reversal.

use crate::press::cams::OF_A_PRESS;
use crate::press::motion::Transition;
use camgen_kernel::document::Presence::Default;
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, above};
use camgen_kernel::units::Dimension::Angle;
use std::f64::consts::PI;

const KIND: Field<fn(f64) -> Transition> = Field::words(
    "kind",
    "\"run-up\" (a ramp: the force balance stays exact), \"blend\" (rounds the corner) or \"none\"",
    Default("run-up"),
    &["run-up", "blend", "none"],
    &[|width| Transition::RunUp { width }, |width| Transition::Blend { width }, |_| Transition::None],
);
const WIDTH: Field<f64> = Field::quantity(
    "width",
    "crank angle of the transition, at most 180 deg",
    Default("20 deg"),
    Angle,
    above(0.0, PI),
);

/// `[transition]`.
pub(super) const SECTION: KeySection = KeySection {
    path: "transition",
    about: "the transition between dwell and reversal",
    occurs: Occurrence::Once,
    cams: OF_A_PRESS,
    keys: &[KIND.key, WIDTH.key],
};

pub(super) fn read(reader: &Reader<'_>) -> Option<Transition> {
    let table = reader.table(&SECTION);
    Some(table.get(&KIND)?(table.get(&WIDTH)?))
}

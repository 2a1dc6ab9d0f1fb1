//! What a press loses in a reversal: air, friction, and a train that gives way.

use crate::press::cams::{ROTARY, SCATTER};
use camgen_kernel::document::Presence::Optional;
use camgen_kernel::document::range::{LARGEST_FORCE, STIFFEST};
use camgen_kernel::document::{Field, above, within};
use camgen_kernel::units::Dimension::{Force, Length, Stiffness};

/// The only analysis that most of them have an effect on.
const ONLY: &[&str] = &[ROTARY, SCATTER];
/// A cam can be cut for its train, and for both exponents of its air.
const OF_ROTARY: &[&str] = &[ROTARY, SCATTER];

/// In which direction of the bed the forces of a rotary cam balance, where the air expands on an exponent of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ExpansionBalance {
    /// While the bed is braked.
    Braking,
    /// In neither: half of the loop is left in each.
    Level,
}

pub(super) const EXPANSION_EXPONENT: Field<f64> = Field::number(
    "expansion_exponent",
    "polytropic exponent of the air on its way back, at least polytropic_exponent; the same when absent",
    Optional("1.40"),
    within(1.0, 3.0),
)
.only(OF_ROTARY);
pub(super) const BALANCE: Field<ExpansionBalance> = Field::words(
    "balance",
    "where the forces of the rotary cam balance: \"braking\", exact while the bed is braked, or \"level\", half of the loop of expansion_exponent left in each direction of the bed",
    Optional("level"),
    &["braking", "level"],
    &[ExpansionBalance::Braking, ExpansionBalance::Level],
)
.only(OF_ROTARY);
pub(super) const LEAK: Field<f64> = Field::share(
    "leak",
    "share of the air that leaks out by the dead point, to first order; about twice as much by the end of the reversal",
    Optional("1 %"),
    within(0.0, 0.2),
)
.only(ONLY);
pub(super) const PISTON_FRICTION: Field<f64> = Field::share(
    "piston_friction",
    "friction of the pistons over the force of the air",
    Optional("2 %"),
    within(0.0, 0.5),
)
.only(ONLY);
pub(super) const BED_FRICTION: Field<f64> = Field::quantity(
    "friction",
    "friction of the bed on its rails",
    Optional("480 N"),
    Force,
    within(0.0, LARGEST_FORCE),
)
.only(ONLY);
pub(super) const TRAIN_STIFFNESS: Field<f64> = Field::quantity(
    "train_stiffness",
    "stiffness of the train from the cam to the bottoms of both cylinders, at the bottoms; rigid when absent",
    Optional("100 kN/mm"),
    Stiffness,
    above(0.0, STIFFEST),
)
.only(OF_ROTARY);
pub(super) const COMPENSATE_TRAIN: Field<bool> = Field::boolean(
    "compensate_train",
    "cut the rotary cam so that the forces balance while the train gives way by train_stiffness; exact at the speed of the cam",
    Optional("true"),
)
.only(OF_ROTARY);
pub(super) const PLAY: Field<f64> =
    Field::quantity("play", "play of that train at the bottoms", Optional("0.1 mm"), Length, within(0.0, 0.1))
        .only(ONLY);

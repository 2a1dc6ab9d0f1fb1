//! The three-dimensional cam for many speeds.

use crate::press::cams::CONOID;
use camgen_kernel::document::Presence::{Default, Required};
use camgen_kernel::document::range::LONGEST;
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, above, within};
use camgen_kernel::units::Dimension::Length;

/// The air column at each speed of a conoid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConoidMode {
    /// Reset by (14).
    Adjusted,
    /// Stays the same at all speeds.
    Fixed,
}

/// How the conoid shifts with the speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shift {
    /// z linear in n.
    Linear,
    /// z linear in n².
    Square,
    /// z linear in v = (n/n_c)² (m/m_c)/(p0/p0_c): a hand wheel for speed, forme and weather.
    Variable,
}

/// The cam for many speeds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConoidData {
    /// Axial travel between the extreme speeds, m.
    pub axial_travel: f64,
    /// The air column at each speed.
    pub mode: ConoidMode,
    /// How the cam shifts.
    pub shift: Shift,
    /// By how much the cam is extended at either end, m; `None` is `auto`, what the contact of the roller needs.
    pub overhang: Option<f64>,
}

const AXIAL_TRAVEL: Field<f64> = Field::quantity(
    "axial_travel",
    "axial distance between the sections of the lowest and the highest speed",
    Required("120 mm"),
    Length,
    above(0.0, LONGEST),
);
const MODE: Field<ConoidMode> = Field::words(
    "mode",
    "\"adjusted\" (the column is reset at each speed) or \"fixed\"",
    Default("adjusted"),
    &["adjusted", "fixed"],
    &[ConoidMode::Adjusted, ConoidMode::Fixed],
);
const SHIFT: Field<Shift> = Field::words(
    "shift",
    "axial shift in n (\"linear\"), n² (\"square\"), or v = (n/n_c)² (m/m_c)/(p0/p0_c) (\"v\"): a hand wheel for speed, forme and weather",
    Default("linear"),
    &["linear", "square", "v"],
    &[Shift::Linear, Shift::Square, Shift::Variable],
);
const OVERHANG: Field<Option<f64>> = Field::words_or_quantity(
    "overhang",
    "extra length at either end: \"auto\", as long as the contact needs, or a length",
    Default("auto"),
    (&["auto"], &[None]),
    (Length, within(0.0, LONGEST), Some),
);

/// `[conoid]`.
pub(super) const SECTION: KeySection = KeySection {
    path: "conoid",
    about: "the cam for many speeds",
    occurs: Occurrence::Optional,
    cams: &[CONOID],
    keys: &[AXIAL_TRAVEL.key, MODE.key, SHIFT.key, OVERHANG.key],
};

pub(super) fn read(reader: &Reader<'_>) -> Option<ConoidData> {
    let table = reader.find(&SECTION)?;
    Some(ConoidData {
        axial_travel: table.get(&AXIAL_TRAVEL)?,
        mode: table.get(&MODE)?,
        shift: table.get(&SHIFT)?,
        overhang: table.get(&OVERHANG)?,
    })
}

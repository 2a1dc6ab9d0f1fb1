//! In which unit the files of a machine are written.

use camgen_kernel::document::Presence::Optional;
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader};
use camgen_kernel::units::LengthUnit;

const UNITS: Field<LengthUnit> = Field::words(
    "units",
    "unit of the lengths in files and reports: \"mm\" or \"inch\"; --units takes precedence",
    Optional("inch"),
    &["mm", "inch"],
    &[LengthUnit::Millimetre, LengthUnit::Inch],
)
.also(&["unit"]);
/// The path of the key of the unit of files.
pub const UNITS_KEY: &str = "output.units";

/// `[output]`.
pub(super) const SECTION: KeySection = KeySection {
    path: "output",
    about: "how files are written",
    occurs: Occurrence::Optional,
    cams: &[],
    keys: &[UNITS.key],
};

pub(super) fn read(reader: &Reader<'_>) -> LengthUnit {
    reader.table(&SECTION).get(&UNITS).unwrap_or_default()
}

//! What the analyses of a press look at by default.

use crate::press::buffer::regime::Reset;
use crate::press::buffer::spring_body::SpringShape;
use crate::press::cams::{REGIMES, SPRING};
use camgen_kernel::document::Presence::{Default, Optional, Required};
use camgen_kernel::document::range::{HIGHEST_STRESS, LARGEST_NUMBER, LEAST_RPM, LONGEST, STIFFEST};
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, above, within};
use camgen_kernel::units::Dimension::{Length, Pressure, Stiffness};

/// Other speeds of a press.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RegimesData {
    /// Speeds of the main shaft, rpm.
    pub speeds: Vec<f64>,
    /// The condition that the reset of the column keeps.
    pub reset: Option<Reset>,
}

const SPEEDS: Field<Vec<f64>> = Field::numbers(
    "rpm",
    "speeds of the main shaft at which the press runs with one cam",
    Optional("[20, 25, 30, 35]"),
    within(LEAST_RPM, LARGEST_NUMBER),
);
const RESET: Field<Reset> = Field::words(
    "reset",
    "condition of the reset of the column: \"end\" (no residual force at the end of the stroke, under a linkage at its largest deceleration), \"half\" or \"level\"",
    Default("end"),
    &["end", "half", "level"],
    &[Reset::End, Reset::Half, Reset::Level],
);

/// `[regimes]`.
pub(super) const REGIMES_SECTION: KeySection = KeySection {
    path: "regimes",
    about: "one cam of a press at other speeds",
    occurs: Occurrence::Optional,
    cams: &[REGIMES],
    keys: &[SPEEDS.key, RESET.key],
};

const STIFFNESS: Field<f64> = Field::quantity(
    "stiffness",
    "stiffness of each of the two springs under the bottoms",
    Optional("82.5 kgf/cm"),
    Stiffness,
    above(0.0, STIFFEST),
);

/// `[spring_buffer]`.
pub(super) const SPRING_SECTION: KeySection = KeySection {
    path: "spring_buffer",
    about: "buffers whose bottoms rest on springs instead of a cam",
    occurs: Occurrence::Optional,
    cams: &[SPRING],
    keys: &[STIFFNESS.key],
};

const INDEX: Field<f64> = Field::number(
    "index",
    "mean diameter of the coils over that of the wire; the wire is the thinnest that keeps the stress",
    Default("6"),
    within(2.0, 30.0),
);
const STRESS: Field<f64> = Field::quantity(
    "stress",
    "allowable shear stress of the wire",
    Required("700 MPa"),
    Pressure,
    above(0.0, HIGHEST_STRESS),
);
const WIRE: Field<Option<f64>> = Field::words_or_quantity(
    "wire",
    "diameter of the wire, with coil in the place of index; or \"standard\", the thinnest standard wire that keeps the stress",
    Optional("18 mm"),
    (&["standard"], &[None]),
    (Length, above(0.0, LONGEST), Some),
);
const COIL: Field<f64> =
    Field::quantity("coil", "mean diameter of the coils", Optional("108 mm"), Length, above(0.0, LONGEST));

/// `[spring_buffer.body]`.
pub(super) const SPRING_BODY_SECTION: KeySection = KeySection {
    path: "spring_buffer.body",
    about: "the coil springs themselves: wire, coils, stress and surge",
    occurs: Occurrence::Optional,
    cams: &[SPRING],
    keys: &[INDEX.key, STRESS.key, WIRE.key, COIL.key],
};

/// The springs themselves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringBodyData {
    /// Index, or wire and coils.
    pub shape: SpringShape,
    /// Allowable shear stress, Pa.
    pub stress: f64,
}

/// The table of the springs themselves.
pub(super) fn read_body(reader: &Reader<'_>) -> Option<SpringBodyData> {
    let table = reader.find(&SPRING_BODY_SECTION)?;
    let (wire, coil) = (table.get(&WIRE), table.get(&COIL));
    let shape = match (wire, coil) {
        (None, None) => SpringShape::Index(table.get(&INDEX)?),
        (Some(None), None) => SpringShape::Standard(table.get(&INDEX)?),
        (Some(None), Some(coil)) => SpringShape::StandardFor(coil),
        (Some(Some(wire)), Some(coil)) if coil >= 2.0 * wire => SpringShape::Wire { wire, coil },
        (Some(_), Some(_)) => {
            let message = "the coils must be at least twice as wide as the wire is thick".to_owned();
            table.fail(&COIL, message, Some("give the mean diameter, 4 to 12 times that of the wire".into()));
            return None;
        }
        (wire, _) => {
            let help = Some("give both, or neither: then the index finds the wire".into());
            if wire.is_some() {
                table.fail(&WIRE, "`spring_buffer.body.wire` is given without `coil`".to_owned(), help);
            } else {
                table.fail(&COIL, "`spring_buffer.body.coil` is given without `wire`".to_owned(), help);
            }
            return None;
        }
    };
    Some(SpringBodyData { shape, stress: table.get(&STRESS)? })
}

pub(super) fn read(reader: &Reader<'_>) -> (RegimesData, Option<f64>) {
    let regimes = reader.table(&REGIMES_SECTION);
    let data = RegimesData { speeds: regimes.get(&SPEEDS).unwrap_or_default(), reset: regimes.get(&RESET) };
    (data, reader.table(&SPRING_SECTION).get(&STIFFNESS))
}

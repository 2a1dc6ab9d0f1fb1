//! What the title block of the review sheet tells besides the cam: who owns it, drew it, approved it.

use crate::document::Presence::Optional;
use crate::document::{Field, Occurs, Reader, Section};

/// `[title]`, each as given; nothing is made up.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Title {
    /// Legal owner.
    pub owner: Option<String>,
    /// Identification number.
    pub part_number: Option<String>,
    /// Revision index.
    pub revision: Option<String>,
    /// Date of issue, as given: camgen reads no clock.
    pub date: Option<String>,
    /// Creator.
    pub designer: Option<String>,
    /// Approval person.
    pub approved: Option<String>,
    /// General tolerance, e.g. "ISO 2768-mK".
    pub general_tolerance: Option<String>,
    /// Surface roughness of the profile, e.g. "Ra 0.8".
    pub surface_roughness: Option<String>,
}

impl Title {
    /// Every text that was given.
    #[must_use]
    pub fn all(&self) -> Vec<&str> {
        let Self { owner, part_number, revision, date, designer, approved, general_tolerance, surface_roughness } =
            self;
        let all = [owner, part_number, revision, date, designer, approved, general_tolerance, surface_roughness];
        all.into_iter().filter_map(|text| text.as_deref()).collect()
    }
}

const OWNER: Field<String> = Field::text("owner", "legal owner of the drawing", Optional("Polygraph Works"));
const PART_NUMBER: Field<String> = Field::text("part_number", "number of the part", Optional("PM-0417"));
const REVISION: Field<String> = Field::text("revision", "revision index", Optional("A"));
const DATE: Field<String> = Field::text("date", "date of issue, as it is to be printed", Optional("2026-11-22"));
const DESIGNER: Field<String> = Field::text("designer", "who made the cam", Optional("N. N."));
const APPROVED: Field<String> = Field::text("approved", "who approved it", Optional("N. N."));
const GENERAL_TOLERANCE: Field<String> = Field::text(
    "general_tolerance",
    "tolerance of all that has none of its own, e.g. of the bore",
    Optional("ISO 2768-mK"),
);
const SURFACE_ROUGHNESS: Field<String> =
    Field::text("surface_roughness", "largest roughness of the profile", Optional("Ra 0.8"));

/// `[title]`.
pub(super) const SECTION: Section = Section {
    path: "title",
    about: "what the title block of the review sheet tells; all as given",
    occurs: Occurs::Optional,
    cams: &[],
    keys: &[
        OWNER.key,
        PART_NUMBER.key,
        REVISION.key,
        DATE.key,
        DESIGNER.key,
        APPROVED.key,
        GENERAL_TOLERANCE.key,
        SURFACE_ROUGHNESS.key,
    ],
};

pub(super) fn read(reader: &Reader<'_>) -> Title {
    let table = reader.table(&SECTION);
    Title {
        owner: table.get(&OWNER),
        part_number: table.get(&PART_NUMBER),
        revision: table.get(&REVISION),
        date: table.get(&DATE),
        designer: table.get(&DESIGNER),
        approved: table.get(&APPROVED),
        general_tolerance: table.get(&GENERAL_TOLERANCE),
        surface_roughness: table.get(&SURFACE_ROUGHNESS),
    }
}

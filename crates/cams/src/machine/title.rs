//! The texts of the title block of the review sheet: who owns the drawing, drew it and approved it.

use super::disc::LARGEST_TOLERANCE;
use camgen_kernel::document::Presence::Optional;
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, above};
use camgen_kernel::units::Dimension::Length;

/// `[title]`, each as given; nothing is made up.
#[derive(Debug, Clone, PartialEq, Default)]
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
    /// General tolerance, e.g. "ISO 2768-m".
    pub general_tolerance: Option<String>,
    /// Surface roughness of the profile, e.g. "Ra 0.8".
    pub surface_roughness: Option<String>,
    /// Hardness of the flank, e.g. "58+4 HRC".
    pub hardness: Option<String>,
    /// Depth of the hard case, e.g. "0.8+0.4 mm".
    pub case_depth: Option<String>,
    /// Heat treatment, e.g. "case-hardened and tempered".
    pub heat_treatment: Option<String>,
    /// Broken edges, e.g. "0.3 x 45°".
    pub edges: Option<String>,
    /// Width of the zone in which the profile must lie, ISO 1101, m.
    pub profile_tolerance: Option<f64>,
    /// By how much the lift may be off, m, along the path of the follower's roller or face.
    pub lift_tolerance: Option<f64>,
}

impl Title {
    /// Every text that was given.
    #[must_use]
    pub fn all(&self) -> Vec<&str> {
        let Self { owner, part_number, revision, date, designer, approved, general_tolerance, .. } = self;
        let Self { surface_roughness, hardness, case_depth, heat_treatment, edges, .. } = self;
        let of_drawing = [owner, part_number, revision, date, designer, approved, general_tolerance];
        let of_part = [surface_roughness, hardness, case_depth, heat_treatment, edges];
        of_drawing.into_iter().chain(of_part).filter_map(|text| text.as_deref()).collect()
    }
}

const OWNER: Field<String> = Field::text("owner", "legal owner of the drawing", Optional("Polygraph Works"));
const PART_NUMBER: Field<String> = Field::text_or_number("part_number", "number of the part", Optional("PM-0417"));
const REVISION: Field<String> = Field::text_or_number("revision", "revision index", Optional("A"));
const DATE: Field<String> = Field::text_or_number("date", "date of issue, printed as given", Optional("2026-11-22"));
const DESIGNER: Field<String> = Field::text("designer", "who made the cam", Optional("N. N."));
const APPROVED: Field<String> = Field::text("approved", "who approved it", Optional("N. N."));
const GENERAL_TOLERANCE: Field<String> = Field::text(
    "general_tolerance",
    "tolerance of all dimensions without one of their own, e.g. of the bore",
    Optional("ISO 2768-m"),
);
const SURFACE_ROUGHNESS: Field<String> =
    Field::text("surface_roughness", "largest roughness of the profile", Optional("Ra 0.8"));
const HARDNESS: Field<String> = Field::text("hardness", "hardness of the profile", Optional("58+4 HRC"));
const CASE_DEPTH: Field<String> =
    Field::text_or_number("case_depth", "depth of the hard case", Optional("CHD 0.8+0.4 mm"));
const HEAT_TREATMENT: Field<String> =
    Field::text("heat_treatment", "heat treatment", Optional("case-hardened and tempered")).also(&["hardening"]);
const EDGES: Field<String> = Field::text("edges", "how edges are broken", Optional("0.3 x 45°"));
const PROFILE_TOLERANCE: Field<f64> = Field::quantity(
    "profile_tolerance",
    "the same as cam.profile_tolerance, under its older name",
    Optional("0.03 mm"),
    Length,
    above(0.0, LARGEST_TOLERANCE),
);
const LIFT_TOLERANCE: Field<f64> = Field::quantity(
    "lift_tolerance",
    "by how much the lift may be off, along the follower's path: the sheet proposes a tolerance of the profile from it",
    Optional("0.02 mm"),
    Length,
    above(0.0, LARGEST_TOLERANCE),
);

/// `[title]`.
pub(super) const SECTION: KeySection = KeySection {
    path: "title",
    about: "texts of the title block of the review sheet, printed as given",
    occurs: Occurrence::Optional,
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
        HARDNESS.key,
        CASE_DEPTH.key,
        HEAT_TREATMENT.key,
        EDGES.key,
        PROFILE_TOLERANCE.key,
        LIFT_TOLERANCE.key,
    ],
};

/// The title block; the zone of the profile may be given in `[cam]` (m) or here.
pub(super) fn read(reader: &Reader<'_>, profile_tolerance: Option<f64>) -> Title {
    let table = reader.table(&SECTION);
    let own = table.get(&PROFILE_TOLERANCE);
    if profile_tolerance.is_some() && own.is_some() && own != profile_tolerance {
        let message = "`title.profile_tolerance` is another name of `cam.profile_tolerance`, which has another value";
        table.fail(&PROFILE_TOLERANCE, message.into(), Some("leave one of them out".into()));
    }
    Title {
        owner: table.get(&OWNER),
        part_number: table.get(&PART_NUMBER),
        revision: table.get(&REVISION),
        date: table.get(&DATE),
        designer: table.get(&DESIGNER),
        approved: table.get(&APPROVED),
        general_tolerance: table.get(&GENERAL_TOLERANCE),
        surface_roughness: table.get(&SURFACE_ROUGHNESS),
        hardness: table.get(&HARDNESS),
        case_depth: table.get(&CASE_DEPTH),
        heat_treatment: table.get(&HEAT_TREATMENT),
        edges: table.get(&EDGES),
        profile_tolerance: profile_tolerance.or(own),
        lift_tolerance: table.get(&LIFT_TOLERANCE),
    }
}

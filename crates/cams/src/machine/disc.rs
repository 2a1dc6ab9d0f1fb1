//! The disc of a disc cam, its bore and its keyway; other cams use the keys that apply to them.

use super::fit::{self, HoleFit};
use super::material::{CamMaterial, Material};
use super::parallel_key;
use super::part_features;
use super::plate::{self, PlateData};
use super::track::{self, TrackData};
use camgen_kernel::document::Presence::{Default, Optional, Required};
use camgen_kernel::document::cams::{DISCS, EVEN, GROOVE, TURNING, WITH_A_BASE};
use camgen_kernel::document::range::{HIGHEST_STRESS, LONGEST, THINNEST};
use camgen_kernel::document::{Bounds, Field, Key, KeySection, Occurrence, Reader, TableReader, above, within};
use camgen_kernel::follower::FollowerData;
use camgen_kernel::units::Dimension::{Angle, Length, Pressure};
use std::f64::consts::PI;

/// How the cam turns, seen in the drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rotation {
    /// Clockwise: the cam angle grows counter-clockwise in the drawing.
    Clockwise,
    /// Counter-clockwise: the drawing is mirrored about X.
    CounterClockwise,
}

/// The disc of a disc cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CamData {
    /// Base radius, m; `None` is `auto`.
    pub base_radius: Option<f64>,
    /// Thickness, m.
    pub thickness: Option<f64>,
    /// Radius of the bore, m.
    pub bore_radius: Option<f64>,
    /// Tolerance class of the bore.
    pub bore_fit: Option<HoleFit>,
    /// Keyway in the bore.
    pub keyway: Option<Keyway>,
    /// Tolerance class of the width of the keyway.
    pub keyway_fit: Option<HoleFit>,
    /// Material; where it is absent the mass is that of steel.
    pub material: Option<CamMaterial>,
    /// Band of radii in which holes may balance the disc, m.
    pub balance: Option<(f64, f64)>,
    /// How it turns.
    pub rotation: Rotation,
    /// The body of a motion program.
    pub track: TrackData,
    /// What only a plate of a motion program has.
    pub plate: PlateData,
}

/// A keyway in the bore.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Keyway {
    /// Width, m.
    pub width: f64,
    /// Depth beyond the bore, m.
    pub depth: f64,
    /// Cam angle of its middle, rad.
    pub angle: f64,
}

impl CamData {
    /// How far bore and keyway reach from the shaft, m; `None` without a bore.
    #[must_use]
    pub fn bore_reach(&self) -> Option<f64> {
        let bore = self.bore_radius?;
        Some(self.keyway.map_or(bore, |keyway| {
            let (out, half) = (bore + keyway.depth, 0.5 * keyway.width);
            (out * out + half * half).sqrt()
        }))
    }

    /// Contact length of a straight roller on the cam, m: its reach into a groove, else the thickness.
    #[must_use]
    pub fn contact_length(&self) -> Option<f64> {
        let TrackData { body, barrel, groove_depth, .. } = &self.track;
        if *body == GROOVE { barrel.roller_height.or(*groove_depth) } else { self.thickness }
    }

    /// Density of the disc, kg/m³.
    #[must_use]
    pub fn density(&self) -> f64 {
        self.material.map_or(Material::Steel, |material| material.class).density()
    }
}

const LENGTH: Bounds = above(0.0, LONGEST);

const BASE_RADIUS: Field<Option<f64>> = Field::words_or_quantity(
    "base_radius",
    "\"auto\", the smallest that keeps the limits, in whole millimetres, or a length",
    Default("auto"),
    (&["auto"], &[None]),
    (Length, LENGTH, Some),
)
.only(WITH_A_BASE)
.also(&["radius", "base_circle"]);
const BASE_DIAMETER: Key =
    BASE_RADIUS.diameter("base_diameter", "diameter of the base circle, in the place of its radius", "90 mm");
const THICKNESS: Field<f64> = Field::quantity(
    "thickness",
    "thickness of the disc or plate, at least 1 um: for the solid, the mass and, except in a groove, the contact stress",
    Optional("30 mm"),
    Length,
    within(THINNEST, LONGEST),
)
.only(EVEN)
.also(&["width"]);
const BORE_RADIUS: Field<f64> = Field::quantity(
    "bore_radius",
    "radius of the bore for the shaft, below base_radius",
    Optional("25 mm"),
    Length,
    LENGTH,
)
.only(TURNING)
.also(&["hole", "shaft"]);
const BORE_DIAMETER: Key =
    BORE_RADIUS.diameter("bore_diameter", "diameter of the bore, in the place of its radius", "50 mm");
const BORE_FIT: Field<String> = Field::text("bore_fit", "tolerance class of the bore, for the sheet", Optional("H7"))
    .only(TURNING)
    .also(&["fit", "tolerance"]);
const MATERIAL: Field<String> = Field::text_or_number(
    "material",
    "\"steel\", \"cast-iron\", \"bronze\", \"aluminium\", a name such as C45, 42CrMo4, 16MnCr5, 100Cr6, GG25, or any other: for mass (steel when absent) and contact stress",
    Optional("steel"),
);
const CONTACT_LIMIT: Field<f64> = Field::quantity(
    "contact_limit",
    "largest pressure of the material in a line of contact; that which is customary for it when absent",
    Optional("1200 MPa"),
    Pressure,
    above(0.0, HIGHEST_STRESS),
);
const BALANCE: Field<(f64, f64)> = Field::band(
    "balance",
    "band of radii outside the bore in which holes may cancel the static unbalance",
    Optional("35 mm .. 60 mm"),
    Length,
    LENGTH,
)
.only(DISCS);
const ROTATION: Field<Rotation> = Field::words(
    "rotation",
    "sense of rotation as seen in the drawing: \"cw\" or \"ccw\"",
    Default("cw"),
    &["cw", "ccw"],
    &[Rotation::Clockwise, Rotation::CounterClockwise],
)
.only(TURNING)
.also(&["direction", "sense", "turns"]);

const PROFILE_TOLERANCE: Field<f64> = Field::quantity(
    "profile_tolerance",
    "width of the zone in which the manufactured profile must lie, ISO 1101: half of it on either side of the drawn profile, for the drawing, the inspection list and measured cams; 0.04 mm, customary for a milled profile, when absent",
    Optional("0.03 mm"),
    Length,
    above(0.0, LARGEST_TOLERANCE),
)
.also(&["tolerance"]);
/// Larger than any tolerance of a cam, m.
pub(super) const LARGEST_TOLERANCE: f64 = 0.01;

/// The zone of the profile, m, as `[cam]` gives it.
pub(super) fn profile_tolerance(reader: &Reader<'_>) -> Option<f64> {
    reader.table(&SECTION).get(&PROFILE_TOLERANCE)
}

/// `[cam]`.
pub(super) const SECTION: KeySection = KeySection {
    path: "cam",
    about: "the disc",
    occurs: Occurrence::Once,
    cams: &[],
    keys: &[
        BASE_RADIUS.key,
        BASE_DIAMETER,
        THICKNESS.key,
        BORE_RADIUS.key,
        BORE_DIAMETER,
        BORE_FIT.key,
        MATERIAL.key,
        CONTACT_LIMIT.key,
        BALANCE.key,
        PROFILE_TOLERANCE.key,
        ROTATION.key,
        part_features::CHAMFER.key,
        part_features::SPLIT.key,
    ],
};

const KEYWAY_WIDTH: Field<Option<f64>> = Field::words_or_quantity(
    "width",
    "width of the slot, below the bore's diameter; \"auto\": that of DIN 6885-1 for the bore",
    Required("8 mm"),
    (&["auto"], &[None]),
    (Length, LENGTH, Some),
)
.for_table("auto")
.only(TURNING);
const KEYWAY_DEPTH: Field<Option<f64>> = Field::words_or_quantity(
    "depth",
    "depth beyond the bore; \"auto\": t2 of DIN 6885-1 for the bore",
    Required("3.3 mm"),
    (&["auto"], &[None]),
    (Length, LENGTH, Some),
)
.for_table("auto")
.only(TURNING);
const KEYWAY_FIT: Field<String> = Field::text(
    "fit",
    "tolerance class of its width, for the sheet: JS9, or P9 for loads that reverse",
    Optional("JS9"),
)
.only(TURNING);
const KEYWAY_ANGLE: Field<f64> = Field::quantity(
    "angle",
    "cam angle of its middle, -360 deg to 360 deg",
    Default("0 deg"),
    Angle,
    within(-2.0 * PI, 2.0 * PI),
)
.only(TURNING);

/// `[cam.keyway]`.
pub(super) const KEYWAY: KeySection = KeySection {
    path: "cam.keyway",
    about: "a keyway in the bore; `keyway = \"auto\"` in [cam] is the one of DIN 6885-1 for it",
    occurs: Occurrence::Optional,
    cams: &[],
    keys: &[KEYWAY_WIDTH.key, KEYWAY_DEPTH.key, KEYWAY_ANGLE.key, KEYWAY_FIT.key],
};

pub(super) fn read(reader: &Reader<'_>) -> Option<CamData> {
    let table = reader.table(&SECTION);
    balance_and_bore(&table);
    base_radius_and_bore(&table);
    let keyway = reader.find(&KEYWAY);
    let keyway_fit = keyway.as_ref().and_then(|keyway| fit::read(keyway, &KEYWAY_FIT));
    let keyway = keyway.map(|keyway| read_keyway(&keyway, &table));
    let bore_fit = fit::read(&table, &BORE_FIT);
    if table.has(&BORE_FIT) && !table.has(&BORE_RADIUS) {
        table.fail(&BORE_FIT, "a fit of the bore needs a bore".into(), Some("add cam.bore_diameter".into()));
    }
    Some(CamData {
        base_radius: table.get(&BASE_RADIUS)?,
        thickness: table.get(&THICKNESS),
        bore_radius: table.get(&BORE_RADIUS),
        bore_fit,
        keyway: keyway.flatten(),
        keyway_fit,
        material: read_material(&table),
        balance: table.get(&BALANCE),
        rotation: table.get(&ROTATION)?,
        plate: plate::read(&table)?,
        track: track::read(&table, table.get(&THICKNESS), table.has(&BORE_RADIUS))?,
    })
}

/// The material as typed.
pub(super) fn material_name(reader: &Reader<'_>) -> Option<String> {
    reader.table(&SECTION).get(&MATERIAL)
}

fn read_material(table: &TableReader<'_>) -> Option<CamMaterial> {
    let limit = table.get(&CONTACT_LIMIT);
    if !table.has(&MATERIAL) {
        if table.has(&CONTACT_LIMIT) {
            let help = Some("add cam.material, or give limits.contact_stress".into());
            table.fail(&CONTACT_LIMIT, "`contact_limit` is that of a material".into(), help);
        }
        return None;
    }
    let name = table.get(&MATERIAL)?;
    CamMaterial::named(&name, limit)
        .map_err(|near| {
            let help = format!("did you mean \"{near}\"? A material of that name needs cam.contact_limit");
            table.fail(&MATERIAL, format!("`cam.material` cannot be \"{name}\""), Some(help));
        })
        .ok()
}

fn balance_and_bore(table: &TableReader<'_>) {
    if let (Some((inner, _)), Some(bore)) = (table.get(&BALANCE), table.get(&BORE_RADIUS))
        && inner <= bore
    {
        let typed = table.typed(&BORE_RADIUS);
        table.fail(&BALANCE, format!("the band of cam.balance must begin outside the bore of {typed}"), None);
    }
}

/// A given base radius must be in reach of the follower.
pub(super) fn reached_by(reader: &Reader<'_>, cam: &CamData, follower: &FollowerData) {
    let Some(base) = cam.base_radius.filter(|_| follower.place.is_none()) else { return };
    let offset = if cam.track.is_ring() { -1.0 } else { 1.0 } * follower.shape.element().offset();
    if follower.shape.sized(base + offset).is_none() {
        let table = reader.table(&SECTION);
        let millimetres = |prime: f64| format!("{:.3} mm", 1e3 * (prime - offset));
        let help = match follower.shape.prime_radii() {
            (least, f64::INFINITY) => format!("it must be above {}", millimetres(least)),
            (least, largest) => format!("it must be between {} and {}", millimetres(least), millimetres(largest)),
        };
        let help = Some(format!("{help}, or place the follower elsewhere"));
        table.fail(&BASE_RADIUS, "the follower does not reach a cam of this base radius".into(), help);
    }
}

/// Share of a radius within which two values in different units are equal: 10.4 cm and 104 mm differ in the last digit.
const SAME_RADIUS: f64 = 1e-12;

fn base_radius_and_bore(table: &TableReader<'_>) {
    if let (Some(Some(base)), Some(bore)) = (table.get(&BASE_RADIUS), table.get(&BORE_RADIUS))
        && bore >= base * (1.0 - SAME_RADIUS)
    {
        let (base, bore) = (table.typed(&BASE_RADIUS), table.typed(&BORE_RADIUS));
        table.fail(&BORE_RADIUS, format!("bore_radius must be below base_radius: {bore} ≥ {base}"), None);
    }
}

fn read_keyway(keyway: &TableReader<'_>, cam: &TableReader<'_>) -> Option<Keyway> {
    let (width, depth) = (keyway.get(&KEYWAY_WIDTH), keyway.get(&KEYWAY_DEPTH));
    if !cam.has(&BORE_RADIUS) {
        keyway.fail(&KEYWAY_WIDTH, "a keyway needs a bore".into(), Some("add cam.bore_radius".into()));
        return None;
    }
    let bore = 2.0 * cam.get(&BORE_RADIUS)?;
    let standard = parallel_key::of_bore(bore);
    if standard.is_none() && (width == Some(None) || depth == Some(None)) {
        let range = format!("{} mm to {} mm", parallel_key::SMALLEST_BORE, parallel_key::LARGEST_BORE);
        let message = format!("DIN 6885-1 has no keyway for a bore of Ø{:.3} mm", 1e3 * bore);
        keyway.fail(&KEYWAY_WIDTH, message, Some(format!("it has them for bores of {range}; give width and depth")));
        return None;
    }
    let width = width?.or(standard.map(|standard| standard.width))?;
    if width >= bore {
        let typed = cam.typed(&BORE_RADIUS);
        keyway.fail(&KEYWAY_WIDTH, format!("the keyway is not narrower than the bore: its radius is {typed}"), None);
    }
    Some(Keyway {
        width,
        depth: depth?.or(standard.map(|standard| standard.depth))?,
        angle: keyway.get(&KEYWAY_ANGLE)?,
    })
}

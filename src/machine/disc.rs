//! The disc of a disc cam, its bore and its keyway; other cams use the keys that apply to them.

use crate::document::Presence::{Default, Optional, Required};
use crate::document::cams::{CONOID, DISCS, MAKE, REGIMES, ROTARY, TRANSLATING, TURNING};
use crate::document::range::{LARGEST_NUMBER, LONGEST, THINNEST};
use crate::document::{Bounds, Field, Occurs, Reader, Section, Table, above, within};
use crate::follower::FollowerData;
use crate::units::Dimension::{Angle, Length};
use std::f64::consts::PI;

/// How the cam turns, seen in the drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rotation {
    /// Clockwise: the cam angle grows counter-clockwise in the drawing.
    Clockwise,
    /// Counter-clockwise: the drawing is mirrored about X.
    CounterClockwise,
}

/// Material of a cam, for its mass.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Material {
    /// Carbon and low-alloy steel.
    Steel,
    /// Grey cast iron.
    CastIron,
    /// Tin bronze.
    Bronze,
    /// Wrought aluminium alloy.
    Aluminium,
}

/// The materials by their names, in the order of [`Material`].
const MATERIALS: &[&str] = &["steel", "cast-iron", "bronze", "aluminium"];

impl Material {
    /// As the machine file names it.
    #[must_use]
    pub fn name(self) -> &'static str {
        let index = match self {
            Material::Steel => 0,
            Material::CastIron => 1,
            Material::Bronze => 2,
            Material::Aluminium => 3,
        };
        MATERIALS.get(index).copied().unwrap_or_default()
    }

    /// E, Pa, customary values.
    #[must_use]
    pub fn modulus(self) -> f64 {
        match self {
            Material::Steel => 210e9,
            Material::CastIron | Material::Bronze => 110e9,
            Material::Aluminium => 70e9,
        }
    }

    /// Poisson's ratio, customary values.
    #[must_use]
    pub fn poisson(self) -> f64 {
        match self {
            Material::Steel => 0.30,
            Material::CastIron => 0.26,
            Material::Bronze => 0.34,
            Material::Aluminium => 0.33,
        }
    }

    /// E/(1 − ν²), Pa, customary values.
    #[must_use]
    pub fn contact_modulus(self) -> f64 {
        let poisson = self.poisson();
        self.modulus() / (1.0 - poisson * poisson)
    }

    /// Density, kg/m³, customary values.
    #[must_use]
    pub fn density(self) -> f64 {
        match self {
            Material::Steel => 7850.0,
            Material::CastIron => 7200.0,
            Material::Bronze => 8800.0,
            Material::Aluminium => 2700.0,
        }
    }
}

/// The disc of a disc cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CamData {
    /// Equal lobes, which is also the crank's turns for one turn of the cam: so it stands right at every reversal.
    pub lobes: u32,
    /// Roller travel per bottom travel.
    pub lever: f64,
    /// Base radius, m; `None` is `auto`.
    pub base_radius: Option<f64>,
    /// Thickness, m.
    pub thickness: Option<f64>,
    /// Radius of the bore, m.
    pub bore_radius: Option<f64>,
    /// Keyway in the bore.
    pub keyway: Option<Keyway>,
    /// Material; where it is absent the mass is that of steel.
    pub material: Option<Material>,
    /// Band of radii in which holes may balance the disc, m.
    pub balance: Option<(f64, f64)>,
    /// How it turns.
    pub rotation: Rotation,
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

    /// Density of the disc, kg/m³.
    #[must_use]
    pub fn density(&self) -> f64 {
        self.material.unwrap_or(Material::Steel).density()
    }
}

const LENGTH: Bounds = above(0.0, LONGEST);

const TURNS: Field<f64> = Field::number(
    "cam_turns_per_crank_turn",
    "turns of the cam per turn of the crank: 1, or 1/n for n lobes",
    Default("1"),
    above(0.0, LARGEST_NUMBER),
)
.only(&[ROTARY, CONOID, REGIMES]);
const LEVER: Field<f64> = Field::number(
    "lever",
    "roller travel per travel of the cylinder's bottom",
    Default("1"),
    above(0.0, LARGEST_NUMBER),
)
.only(&[ROTARY, CONOID]);
const BASE_RADIUS: Field<Option<f64>> = Field::words_or_quantity(
    "base_radius",
    "\"auto\", the smallest that keeps the limits, in whole millimetres, or a length",
    Default("auto"),
    (&["auto"], &[None]),
    (Length, LENGTH, Some),
)
.only(TURNING);
const THICKNESS: Field<f64> = Field::quantity(
    "thickness",
    "thickness of disc or plate, at least 1 um: for solid, mass and contact stress",
    Optional("30 mm"),
    Length,
    within(THINNEST, LONGEST),
)
.only(&[ROTARY, TRANSLATING, MAKE]);
const BORE_RADIUS: Field<f64> = Field::quantity(
    "bore_radius",
    "radius of the bore for the shaft, below base_radius",
    Optional("25 mm"),
    Length,
    LENGTH,
)
.only(TURNING);
const MATERIAL: Field<Material> = Field::words(
    "material",
    "\"steel\", \"cast-iron\", \"bronze\" or \"aluminium\": for mass (steel when absent) and contact stress",
    Optional("steel"),
    MATERIALS,
    &[Material::Steel, Material::CastIron, Material::Bronze, Material::Aluminium],
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
.only(TURNING);

/// Most lobes: more would be teeth.
const MOST_LOBES: f64 = 100.0;
/// How far a ratio may be from 1/n to be taken for it, as a share: 0.3333 stands for a third, since gears are exact. With a
/// hair for the rounding of that very number.
const RATIO_ROUNDING: f64 = 1e-4 * (1.0 + 1e-9);

/// `[cam]`.
pub(super) const SECTION: Section = Section {
    path: "cam",
    about: "the disc",
    occurs: Occurs::Once,
    cams: &[],
    keys: &[
        TURNS.key,
        LEVER.key,
        BASE_RADIUS.key,
        THICKNESS.key,
        BORE_RADIUS.key,
        MATERIAL.key,
        BALANCE.key,
        ROTATION.key,
    ],
};

const KEYWAY_WIDTH: Field<f64> =
    Field::quantity("width", "width of the slot, below the bore's diameter", Required("8 mm"), Length, LENGTH)
        .only(TURNING);
const KEYWAY_DEPTH: Field<f64> =
    Field::quantity("depth", "depth beyond the bore", Required("3.3 mm"), Length, LENGTH).only(TURNING);
const KEYWAY_ANGLE: Field<f64> = Field::quantity(
    "angle",
    "cam angle of its middle, -360 deg to 360 deg",
    Default("0 deg"),
    Angle,
    within(-2.0 * PI, 2.0 * PI),
)
.only(TURNING);

/// `[cam.keyway]`.
pub(super) const KEYWAY: Section = Section {
    path: "cam.keyway",
    about: "a keyway in the bore",
    occurs: Occurs::Optional,
    cams: &[],
    keys: &[KEYWAY_WIDTH.key, KEYWAY_DEPTH.key, KEYWAY_ANGLE.key],
};

pub(super) fn read(reader: &Reader<'_>) -> Option<CamData> {
    let table = reader.table(&SECTION);
    balance_and_bore(&table);
    base_radius_and_bore(&table);
    let lobes = read_lobes(&table);
    let keyway = reader.find(&KEYWAY).map(|keyway| read_keyway(&keyway, &table));
    Some(CamData {
        lobes: lobes?,
        lever: table.get(&LEVER)?,
        base_radius: table.get(&BASE_RADIUS)?,
        thickness: table.get(&THICKNESS),
        bore_radius: table.get(&BORE_RADIUS),
        keyway: keyway.flatten(),
        material: table.get(&MATERIAL),
        balance: table.get(&BALANCE),
        rotation: table.get(&ROTATION)?,
    })
}

/// The lobes of a cam of 1/n turns for one of the crank.
fn read_lobes(table: &Table<'_>) -> Option<u32> {
    let turns = table.get(&TURNS)?;
    let lobes = (1.0 / turns).round().clamp(1.0, MOST_LOBES);
    if (turns * lobes - 1.0).abs() > RATIO_ROUNDING {
        let typed = table.typed(&TURNS);
        let message = format!(
            "with {typed} turns of the cam for one turn of the crank the cam would stand wrong at the next reversal; \
             1, or 1/n with n equal lobes (0.5, 0.3333, 0.25, … 0.01), stands right at each"
        );
        let nearest = (1e6 / lobes).round() / 1e6;
        table.fail(&TURNS, message, Some(format!("the nearest of these is {nearest}")));
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number from 1 to 100")]
    Some(lobes as u32)
}

fn balance_and_bore(table: &Table<'_>) {
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
    if follower.shape.sized(base + follower.shape.element().offset()).is_none() {
        let table = reader.table(&SECTION);
        let offset = follower.shape.element().offset();
        let millimetres = |prime: f64| format!("{:.3} mm", 1e3 * (prime - offset));
        let help = match follower.shape.prime_radii() {
            (least, f64::INFINITY) => format!("it must be above {}", millimetres(least)),
            (least, largest) => format!("it must be between {} and {}", millimetres(least), millimetres(largest)),
        };
        let help = Some(format!("{help}, or place the follower elsewhere"));
        table.fail(&BASE_RADIUS, "the follower does not reach a cam of this base radius".into(), help);
    }
}

/// Share of a radius by which one in other units may differ and be the same: 10.4 cm and 104 mm differ in the last digit.
const SAME_RADIUS: f64 = 1e-12;

fn base_radius_and_bore(table: &Table<'_>) {
    if let (Some(Some(base)), Some(bore)) = (table.get(&BASE_RADIUS), table.get(&BORE_RADIUS))
        && bore >= base * (1.0 - SAME_RADIUS)
    {
        let (base, bore) = (table.typed(&BASE_RADIUS), table.typed(&BORE_RADIUS));
        table.fail(&BORE_RADIUS, format!("bore_radius must be below base_radius: {bore} ≥ {base}"), None);
    }
}

fn read_keyway(keyway: &Table<'_>, cam: &Table<'_>) -> Option<Keyway> {
    let width = keyway.get(&KEYWAY_WIDTH);
    if !cam.has(&BORE_RADIUS) {
        keyway.fail(&KEYWAY_WIDTH, "a keyway needs a bore".into(), Some("add cam.bore_radius".into()));
    } else if let (Some(width), Some(bore)) = (width, cam.get(&BORE_RADIUS))
        && width >= 2.0 * bore
    {
        let typed = cam.typed(&BORE_RADIUS);
        keyway.fail(&KEYWAY_WIDTH, format!("the keyway is wider than the bore of radius {typed}"), None);
    }
    Some(Keyway { width: width?, depth: keyway.get(&KEYWAY_DEPTH)?, angle: keyway.get(&KEYWAY_ANGLE)? })
}

//! Holes of a disc in addition to its bore: for bolts, dowels and timing pins, or to make it lighter.

use super::fit::{self, HoleFit};
use super::turret;
use camgen_kernel::document::Presence::{Default, Optional, Required};
use camgen_kernel::document::cams::{self, WITH_HOLES};
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, above, within};
use camgen_kernel::units::Dimension::{Angle, Length};
use nalgebra::Vector2;
use std::f64::consts::{PI, TAU};

/// Equal holes through a disc, evenly spaced on a circle about its shaft: an element of `[[cam.holes]]`.
#[derive(Debug, Clone, PartialEq)]
pub struct HolePattern {
    /// The key of its table: `cam.holes[0]`.
    pub key: String,
    /// How many.
    pub count: u32,
    /// Radius of the circle of their centres, m.
    pub circle_radius: f64,
    /// Radius of a hole, m.
    pub radius: f64,
    /// Cam angle of the first, rad.
    pub angle: f64,
    /// Tolerance class of their diameter.
    pub fit: Option<HoleFit>,
    /// What they are for, in a word for the drawing.
    pub purpose: Option<String>,
}

const DIAMETER: Field<f64> =
    Field::quantity("diameter", "diameter of a hole", Required("6 mm"), Length, above(0.0, LARGEST)).only(WITH_HOLES);
const CIRCLE_DIAMETER: Field<f64> = Field::quantity(
    "circle_diameter",
    "diameter of the circle about the shaft on which their centres lie",
    Required("80 mm"),
    Length,
    above(0.0, LARGEST),
)
.also(&["bolt_circle", "pitch_circle", "pcd"])
.only(WITH_HOLES);
const COUNT: Field<f64> =
    Field::number("count", "how many, evenly spaced on the circle, 1 to 200", Default("1"), within(1.0, MOST))
        .also(&["number", "quantity", "holes"])
        .only(WITH_HOLES);
const ANGLE: Field<f64> = Field::quantity(
    "angle",
    "cam angle of the first, -360 deg to 360 deg",
    Default("0 deg"),
    Angle,
    within(-2.0 * PI, 2.0 * PI),
)
.only(WITH_HOLES);
const FIT: Field<String> =
    Field::text("fit", "tolerance class of their diameter, for the drawing: H7 for a dowel", Optional("H7"))
        .only(WITH_HOLES);
const PURPOSE: Field<String> =
    Field::text("purpose", "what they are for, in a word for the drawing", Optional("timing"))
        .also(&["name"])
        .only(WITH_HOLES);
/// Larger than any cam, m, and most holes of a pattern.
const LARGEST: f64 = 10.0;
const MOST: f64 = 200.0;

/// `[[cam.holes]]`.
pub(super) const SECTION: KeySection = KeySection {
    path: "cam.holes",
    about: "holes through the disc: a bolt circle, a dowel, a timing hole, or holes that make it lighter",
    occurs: Occurrence::Repeated,
    cams: &[],
    keys: &[DIAMETER.key, CIRCLE_DIAMETER.key, COUNT.key, ANGLE.key, FIT.key, PURPOSE.key],
};

/// The holes of a file with this body.
pub(super) fn read(reader: &Reader<'_>, body: &str) -> Vec<HolePattern> {
    if !cams::is_body_of(body, WITH_HOLES)
        && let Some(table) = reader.elements(&SECTION).next()
    {
        let help = Some(
            "leave cam.holes out, and drill the holes by a drawing of your own: discs and grooves have them".into(),
        );
        table.fail(&DIAMETER, format!("camgen does not drill holes in a {body} cam"), help);
    }
    let patterns = reader.elements(&SECTION).enumerate().map(|(index, table)| {
        Some(HolePattern {
            key: format!("{}[{index}]", SECTION.path),
            count: turret::whole(&table, &COUNT)?,
            circle_radius: 0.5 * table.get(&CIRCLE_DIAMETER)?,
            radius: 0.5 * table.get(&DIAMETER)?,
            angle: table.get(&ANGLE)?,
            fit: fit::read(&table, &FIT),
            purpose: table.get(&PURPOSE),
        })
    });
    patterns.collect::<Vec<_>>().into_iter().flatten().collect()
}

impl HolePattern {
    /// The centres, m, of a cam that turns clockwise.
    pub fn centres(&self) -> impl Iterator<Item = Vector2<f64>> {
        (0..self.count).map(|index| {
            let (sin, cos) = libm::sincos(self.angle + TAU * f64::from(index) / f64::from(self.count));
            Vector2::new(cos, sin) * self.circle_radius
        })
    }
}

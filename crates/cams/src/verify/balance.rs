//! The static unbalance that remains in a disc with its balance holes.

use super::check::{Evidence, FileCheck};
use crate::body::NEGLIGIBLE_MM;
use crate::body::balancing::{BalanceFailure, MOST_HOLES, moment};
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::report::{Bound, Finding, Verdict};
use camgen_kernel::text::{KeyChange, Length, Remedy, Text, text};
use std::f64::consts::PI;

pub(super) const CHECK: FileCheck = FileCheck {
    check: Check {
        name: "balance",
        on: CheckScope::Cam,
        unit: "g·mm",
        about: "The static unbalance that remains in a disc with its holes within cam.balance, for the metal as written: outline as read back, \
                bore with keyway, holes. Holes keep limits.wall, at least a millimetre, to all of these and to each other.",
        explained: CheckExplanation {
            bound: Bound::AtMost,
            formula: "U = m e, m the mass of the metal left, e the distance of its centre of mass from the shaft",
            usual: "camgen's own rule: e at most a nanometre, the rounding of the holes; for the grades of rotors see ISO 21940-11",
            change: "a wider band `cam.balance`, a larger `cam.base_radius`, or no balancing",
        },
    },
    run: check,
};

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let part = evidence.drawn?.parts.first()?;
    let balancing = part.balancing.as_ref()?;
    let machine = evidence.body.machine();
    // Grams times millimetres for a disc of this thickness, or of one millimetre where none is given.
    let thickness = machine.cam.thickness.unwrap_or(1e-3);
    let weight = 1e-3 * machine.cam.density() * thickness;
    let outline = evidence.outlines.first().map_or(&part.outline.contour, |written| &written.contour);
    let left = part.holes().iter().fold(moment(outline), |left, hole| left - moment(&hole.contour()));
    let area = outline.area_and_centroid().0;
    let (before, after) = (weight * balancing.before, weight * left.norm());
    let limit = weight * area * NEGLIGIBLE_MM;
    let note = match (balancing.holes.as_slice(), &balancing.unbalanced) {
        ([(centre, radius), ..], _) => text!(
            "{} holes of radius {} at {} from the shaft cancel {} g·mm",
            balancing.holes.len(),
            Length::mm(*radius).decimals(4),
            Length::mm(centre.norm()).decimals(4),
            format_args!("{:.0}", before)
        ),
        ([], Some(unbalanced)) => words(unbalanced, weight, before),
        ([], None) => "nothing to balance".into(),
    };
    Some(Finding { note: Some(note), ..CHECK.found(after, Some(limit), Verdict::of(after <= limit)) })
}

fn words(unbalanced: &BalanceFailure, weight: f64, before: f64) -> Text {
    let family = format!("1 to {MOST_HOLES} equal holes, evenly spaced on an arc about the heavy side");
    let best = unbalanced.best.map_or_else(
        || text!("no hole fits into the band of cam.balance; tried: {}", &family),
        |row| {
            text!(
                "the band of cam.balance is too narrow: with {}, at least {} g·mm remain; {} of radius {} at \
                 {} from the shaft, {}° apart, would leave {} g·mm",
                &family,
                format_args!("{:.0}", weight * unbalanced.least),
                row.count,
                Length::mm(row.radius).decimals(2),
                Length::mm(row.distance).decimals(2),
                format_args!("{:.2}", row.apart * 180.0 / PI),
                format_args!("{:.0}", before - weight * row.moment())
            )
        },
    );
    match unbalanced.band {
        Some((inner, outer)) => {
            let change = KeyChange::new("cam.balance", format!("{inner} mm .. {outer} mm"));
            best.and("; ", text!("{} would pass", Remedy::new([change])))
        }
        None => best.and("; ", "no wider band would help"),
    }
}

//! The sections of the report on a barrel.

use super::{Barrel, BarrelRoller};
use crate::body::DrawingEvidence;
use crate::body::flank_switch::SwitchFigures;
use crate::body::swept::{SweptGeometry, largest, sharpest_curvature};
use crate::report::{Fact, Section, Topic, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Quantity;
use camgen_kernel::profile::lifts;
use camgen_kernel::text::{DIGITS, Length, Text, Value, nominal, text};
use serde::Serialize;

/// The section `barrel`.
#[derive(Debug, Serialize)]
struct BarrelSection {
    outer_radius_mm: f64,
    floor_radius_mm: f64,
    groove_depth_mm: f64,
    groove_width_mm: f64,
    roller_radius_mm: f64,
    roller_height_mm: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    roller_half_angle_deg: Option<f64>,
    blank_length_mm: f64,
    z_from_mm: f64,
    z_to_mm: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_lift_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_lift_deg: Option<f64>,
    /// The smallest radius of the outside that keeps every limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    smallest_outer_radius_mm: Option<f64>,
    /// Largest at the inner end of the roller and at the outside.
    pressure_angle_deg: [f64; 2],
    largest_reduced_curvature_per_mm: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    volume_mm3: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mass_kg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    spline_patches: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    spline_deviation_mm: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    switches: Vec<SwitchFigures>,
}

/// The section with these changes of flank.
pub(super) fn section<R: BarrelRoller>(
    barrel: &Barrel<R>,
    found: &DrawingEvidence<'_>,
    switches: Vec<SwitchFigures>,
) -> Section {
    let drawn = found.drawn.and_then(|drawn| drawn.swept.as_deref());
    let swings = barrel.groove.motion.quantity() == Quantity::Angle;
    let top = lifts(&*barrel.groove.motion).1;
    let angle = |end: usize| {
        let at_end = largest(barrel, |lift, line| barrel.pressure_angle(lift, line, barrel.touched(line)[end]).abs());
        at_end.value.to_degrees()
    };
    let volume = drawn.map(|drawn| drawn.solid.volume);
    let value = BarrelSection {
        outer_radius_mm: MILLIMETRES * barrel.outer,
        floor_radius_mm: MILLIMETRES * barrel.floor(),
        groove_depth_mm: MILLIMETRES * barrel.depth,
        groove_width_mm: MILLIMETRES * barrel.groove.width(),
        roller_radius_mm: MILLIMETRES * barrel.groove.roller,
        roller_height_mm: MILLIMETRES * barrel.reach,
        roller_half_angle_deg: barrel.roller.half_angle(barrel.outer).map(f64::to_degrees),
        blank_length_mm: MILLIMETRES * (barrel.ends.1 - barrel.ends.0),
        z_from_mm: MILLIMETRES * barrel.ends.0,
        z_to_mm: MILLIMETRES * barrel.ends.1,
        max_lift_mm: (!swings).then_some(MILLIMETRES * top),
        max_lift_deg: swings.then_some(top.to_degrees()),
        smallest_outer_radius_mm: barrel.smallest_outer().ok().map(|radius| MILLIMETRES * radius),
        pressure_angle_deg: [angle(0), angle(1)],
        largest_reduced_curvature_per_mm: sharpest_curvature(barrel) / MILLIMETRES,
        volume_mm3: volume,
        mass_kg: volume.map(|volume| barrel.groove.mass(volume)),
        spline_patches: drawn.map(|_| barrel.patches()),
        spline_deviation_mm: drawn.map(|drawn| drawn.deviation),
        switches,
    };
    let words = words(&value, barrel, drawn.map(|drawn| drawn.developed.len()));
    let figures = words.iter().take(3).cloned().collect();
    let facts = facts(&value);
    Section::new("barrel", &value).with_words(words).with_figures(figures).with_facts(facts)
}

fn facts(section: &BarrelSection) -> Vec<Fact> {
    let size = text!(
        "outside Ø{}, {} long, roller Ø{}",
        Length::mm(2.0 * section.outer_radius_mm).nominal(),
        Length::mm(section.blank_length_mm).nominal(),
        Length::mm(2.0 * section.roller_radius_mm).nominal()
    );
    let mass = section.mass_kg.map(|mass| Text::from(Value::brief(mass, "kg")));
    let groove = text!(
        "{} wide, {} deep",
        Length::mm(section.groove_width_mm).nominal(),
        Length::mm(section.groove_depth_mm).nominal()
    );
    let lift = match (section.max_lift_mm, section.max_lift_deg) {
        (Some(lift), _) => Value::from(Length::mm(lift).brief()).into(),
        (None, degrees) => text!("{}°", nominal(degrees.unwrap_or(f64::NAN), DIGITS)),
    };
    vec![
        Fact::new(Topic::SIZE, size.and(", ", mass)),
        Fact::new(Topic::new(15, "groove"), groove),
        Fact::new(Topic::LIFT, lift),
    ]
}

fn words<R: BarrelRoller>(section: &BarrelSection, barrel: &Barrel<R>, arcs: Option<usize>) -> Vec<Text> {
    let BarrelSection { outer_radius_mm, floor_radius_mm, groove_width_mm, groove_depth_mm, .. } = section;
    let mut words = vec![
        text!(
            "outside Ø{}, floor Ø{}, {} long from z = {} to {}",
            Length::mm(2.0 * outer_radius_mm),
            Length::mm(2.0 * floor_radius_mm),
            Length::mm(section.blank_length_mm),
            Length::mm(section.z_from_mm).bare(),
            Length::mm(section.z_to_mm)
        ),
        text!(
            "groove {} wide, {} deep; the roller Ø{} reaches {} into it",
            Length::mm(*groove_width_mm),
            Length::mm(*groove_depth_mm),
            Length::mm(2.0 * section.roller_radius_mm),
            Length::mm(section.roller_height_mm)
        ),
    ];
    if let Some(angle) = section.roller_half_angle_deg {
        words.push(text!(
            "the roller is a cone of half angle {}°; diameter and width are those on the outside",
            shown(angle)
        ));
    }
    let [inner, outer] = section.pressure_angle_deg;
    words.push(text!(
        "largest pressure angle {}° at the inner end of the roller, {}° at the outside",
        shown(inner),
        shown(outer)
    ));
    if let Some(smallest) = section.smallest_outer_radius_mm {
        words.push(text!("the smallest outside that keeps every limit has a radius of {}", Length::mm(smallest)));
    }
    if let (Some(patches), Some(deviation)) = (section.spline_patches, section.spline_deviation_mm) {
        words.push(text!(
            "solid: {} spline patches, off the exact flanks by {} between their nodes",
            patches,
            Length::mm(deviation)
        ));
    }
    words.extend(arcs.map(|arcs| text!("developed view: {} arcs and lines", arcs)));
    if let Some(mass) = section.mass_kg {
        words.push(text!("mass {} kg", shown(mass)));
    }
    if barrel.groove.holes().is_empty() {
        words.push("without a bore".into());
    }
    words.extend(section.switches.iter().map(SwitchFigures::words));
    words
}

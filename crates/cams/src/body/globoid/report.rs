//! The sections of the report on a globoid.

use super::Globoid;
use crate::body::DrawingEvidence;
use crate::body::flank_switch::SwitchFigures;
use crate::body::swept::{pressure_angles, sharpest_curvature};
use crate::report::{Fact, Section, Topic, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::text::{DIGITS, Length, Text, Value, nominal, text};
use serde::Serialize;

/// The section `globoid`.
#[derive(Debug, Serialize)]
struct GloboidSection {
    rollers: u32,
    advance: u32,
    index_deg: f64,
    turret_distance_mm: f64,
    arm_mm: f64,
    roller_radius_mm: f64,
    roller_height_mm: f64,
    groove_width_mm: f64,
    groove_depth_mm: f64,
    /// Radii of the hollow outside and of the floor in the plane through the axes, about the turret.
    outside_about_turret_mm: f64,
    floor_about_turret_mm: f64,
    /// At the waist of the outside, and at its ends.
    waist_radius_mm: f64,
    outer_radius_mm: f64,
    blank_length_mm: f64,
    end_angle_deg: f64,
    pressure_angle_deg: f64,
    /// Of the turret in a turn of the cam.
    rest_deg: f64,
    thinnest_rib_mm: f64,
    largest_reduced_curvature_per_mm: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    volume_mm3: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mass_kg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    spline_deviation_mm: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    switches: Vec<SwitchFigures>,
}

/// The section with these changes of flank.
pub(super) fn section(globoid: &Globoid, found: &DrawingEvidence<'_>, switches: Vec<SwitchFigures>) -> Section {
    let drawn = found.drawn.and_then(|drawn| drawn.swept.as_deref());
    let rest: f64 =
        globoid.groove.motion.pieces().iter().filter(|piece| piece.dwell).map(|piece| piece.end - piece.start).sum();
    let volume = drawn.map(|drawn| drawn.solid.volume);
    let turret = globoid.turret;
    let value = GloboidSection {
        rollers: turret.rollers,
        advance: turret.advance,
        index_deg: turret.index().to_degrees(),
        turret_distance_mm: MILLIMETRES * turret.distance,
        arm_mm: MILLIMETRES * turret.arm,
        roller_radius_mm: MILLIMETRES * globoid.groove.roller,
        roller_height_mm: MILLIMETRES * (globoid.reached - globoid.outside),
        groove_width_mm: MILLIMETRES * globoid.groove.width(),
        groove_depth_mm: MILLIMETRES * (globoid.floor - globoid.outside),
        outside_about_turret_mm: MILLIMETRES * globoid.outside,
        floor_about_turret_mm: MILLIMETRES * globoid.floor,
        waist_radius_mm: MILLIMETRES * (turret.distance - globoid.outside),
        outer_radius_mm: MILLIMETRES * globoid.rim(globoid.outside).0,
        blank_length_mm: 2.0 * MILLIMETRES * globoid.rim(globoid.floor).1,
        end_angle_deg: globoid.end_angle.to_degrees(),
        pressure_angle_deg: pressure_angles(globoid)[0].value.to_degrees(),
        rest_deg: rest.to_degrees(),
        thinnest_rib_mm: MILLIMETRES * globoid.thinnest_rib().0,
        largest_reduced_curvature_per_mm: sharpest_curvature(globoid) / MILLIMETRES,
        volume_mm3: volume,
        mass_kg: volume.map(|volume| globoid.groove.mass(volume)),
        spline_deviation_mm: drawn.map(|drawn| drawn.deviation),
        switches,
    };
    let words = words(&value, globoid);
    let figures = words.iter().take(4).cloned().collect();
    let facts = facts(&value);
    Section::new("globoid", &value).with_words(words).with_figures(figures).with_facts(facts)
}

fn facts(section: &GloboidSection) -> Vec<Fact> {
    let turret = text!(
        "{} rollers Ø{}, {} from the cam's axis; {}° a turn, at rest over {}°",
        section.rollers,
        Length::mm(2.0 * section.roller_radius_mm).nominal(),
        Length::mm(section.turret_distance_mm).nominal(),
        nominal(section.index_deg, DIGITS),
        nominal(section.rest_deg, DIGITS)
    );
    let size = text!(
        "ends Ø{}, waist Ø{}, {} long",
        Length::mm(2.0 * section.outer_radius_mm).nominal(),
        Length::mm(2.0 * section.waist_radius_mm).nominal(),
        Length::mm(section.blank_length_mm).nominal()
    );
    let mass = section.mass_kg.map(|mass| Text::from(Value::brief(mass, "kg")));
    let groove = text!(
        "{} wide, {} deep, thinnest rib {}",
        Length::mm(section.groove_width_mm).nominal(),
        Length::mm(section.groove_depth_mm).nominal(),
        Length::mm(section.thinnest_rib_mm).brief()
    );
    vec![
        Fact::new(Topic::SIZE, size.and(", ", mass)),
        Fact::new(Topic::new(14, "turret"), turret),
        Fact::new(Topic::new(15, "groove"), groove),
    ]
}

fn words(section: &GloboidSection, globoid: &Globoid) -> Vec<Text> {
    let mut words = vec![
        text!(
            "turret with {} rollers Ø{}, its axis {} from that of the cam; a turn of the cam moves it on by {}°",
            section.rollers,
            Length::mm(2.0 * section.roller_radius_mm),
            Length::mm(section.turret_distance_mm),
            shown(section.index_deg)
        ),
        text!(
            "hollow outside R {} about the turret, waist Ø{}, ends Ø{}, {} long, conical ends at {}°",
            Length::mm(section.outside_about_turret_mm),
            Length::mm(2.0 * section.waist_radius_mm),
            Length::mm(2.0 * section.outer_radius_mm),
            Length::mm(section.blank_length_mm),
            shown(section.end_angle_deg)
        ),
        text!(
            "{} {} wide and {} deep; the rollers reach {} into {}",
            if section.advance == 1 { "one groove".to_owned() } else { format!("{} grooves", section.advance) },
            Length::mm(section.groove_width_mm),
            Length::mm(section.groove_depth_mm),
            Length::mm(section.roller_height_mm),
            if section.advance == 1 { "it" } else { "them" }
        ),
        text!(
            "largest pressure angle {}°; thinnest rib {}; the turret rests over {}° of a turn",
            shown(section.pressure_angle_deg),
            Length::mm(section.thinnest_rib_mm),
            shown(section.rest_deg)
        ),
    ];
    if let Some(deviation) = section.spline_deviation_mm {
        words.push(text!("solid: spline flanks off the exact ones by {} between their nodes", Length::mm(deviation)));
    }
    if let Some(mass) = section.mass_kg {
        words.push(text!("mass {} kg", shown(mass)));
    }
    if globoid.groove.holes().is_empty() {
        words.push("without a bore".into());
    }
    words.extend(section.switches.iter().map(SwitchFigures::words));
    words
}

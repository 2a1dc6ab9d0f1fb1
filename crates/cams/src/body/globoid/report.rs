//! The sections of the report on a globoid.

use super::Globoid;
use crate::body::DrawingEvidence;
use crate::body::flank_switch::SwitchFigures;
use crate::body::swept::{pressure_angles, sharpest_curvature};
use crate::report::{Section, shown};
use camgen_kernel::geometry::MILLIMETRES;
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
    Section::new("globoid", &value).with_words(words).with_figures(figures)
}

fn words(section: &GloboidSection, globoid: &Globoid) -> Vec<String> {
    let mut words = vec![
        format!(
            "turret with {} rollers Ø{} mm, its axis {} mm from that of the cam; a turn of the cam moves it on by {}°",
            section.rollers,
            shown(2.0 * section.roller_radius_mm),
            shown(section.turret_distance_mm),
            shown(section.index_deg)
        ),
        format!(
            "hollow outside R {} mm about the turret, waist Ø{} mm, ends Ø{} mm, {} mm long, conical ends at {}°",
            shown(section.outside_about_turret_mm),
            shown(2.0 * section.waist_radius_mm),
            shown(2.0 * section.outer_radius_mm),
            shown(section.blank_length_mm),
            shown(section.end_angle_deg)
        ),
        format!(
            "{} {} mm wide and {} mm deep; the rollers reach {} mm into {}",
            if section.advance == 1 { "one groove".to_owned() } else { format!("{} grooves", section.advance) },
            shown(section.groove_width_mm),
            shown(section.groove_depth_mm),
            shown(section.roller_height_mm),
            if section.advance == 1 { "it" } else { "them" }
        ),
        format!(
            "largest pressure angle {}°; thinnest rib {} mm; the turret rests over {}° of a turn",
            shown(section.pressure_angle_deg),
            shown(section.thinnest_rib_mm),
            shown(section.rest_deg)
        ),
    ];
    if let Some(deviation) = section.spline_deviation_mm {
        words.push(format!("solid: spline flanks off the exact ones by {} mm between their nodes", shown(deviation)));
    }
    if let Some(mass) = section.mass_kg {
        words.push(format!("mass {} kg", shown(mass)));
    }
    if globoid.groove.holes().is_empty() {
        words.push("without a bore".into());
    }
    words.extend(section.switches.iter().map(SwitchFigures::words));
    words
}

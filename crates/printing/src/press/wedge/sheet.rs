//! What the review sheet of a cam plate shows.

use super::{Wedge, mirrored_about_axis};
use camgen_cams::body::sheet::{length_cell, overall, pressure_angle, roller, side_view, tolerance_note, travelled};
use camgen_cams::body::{Body, Drawn, Figures};
use camgen_cams::report::sheet::Dimensions;
use camgen_cams::report::sheet::{Mark, PlaceTable, ShapeGroup, SheetShape, SheetView, TitleFacts, extents_of};
use camgen_cams::table::Row;
use camgen_kernel::geometry::contour::{Contour, Extents, Segment};
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::outline::OutlineError;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;
use std::sync::Arc;

/// Distance of the side view from the front view, over the length of the plate.
const SIDE_GAP: f64 = 0.08;
/// Steps of the finer coordinate table over the stroke.
const STEPS: u32 = 72;

/// What the review sheet of a plate shows: both flanks with their pitch curves, the rollers where the pressure angle is worst, the
/// bed's axis and the overrun.
///
/// # Errors
/// [`OutlineError`] when the pitch curve cannot be drawn.
pub(super) fn view(plate: &Wedge, drawn: &Drawn) -> Result<SheetView, OutlineError> {
    let lower = plate.pitch_curve()?;
    let upper = lower.iter().map(|segment| Segment {
        start: mirrored_about_axis(segment.start),
        end: mirrored_about_axis(segment.end),
        bulge: -segment.bulge,
    });
    let both: Vec<Segment> = lower.iter().copied().chain(upper).collect();
    let contours: Vec<_> = drawn.parts.iter().map(|part| part.outline.contour.clone()).collect();
    let outline = contours.iter().map(Contour::extents).reduce(|a, b| a.with(&b));
    let outline = outline.unwrap_or(Extents { least: Vector2::zeros(), largest: Vector2::zeros() });
    let profile = contours.into_iter().map(|contour| SheetShape::Entity(Entity::Polyline(contour))).collect();
    let pitch_curve = both.iter().map(|s| SheetShape::Arc(s.start, s.end, s.bulge)).collect();
    let (lines, names) = axes(plate, &outline);
    let (shapes, angle) = rollers(plate);
    let group = ShapeGroup::new;
    let mut groups = vec![
        group("profile", "profile", profile).with_legend(),
        group("axis", "bed's axis, ends of the overrun", lines).with_legend(),
        group("pitch-curve", "pitch curves", pitch_curve).with_legend(),
        group("roller", "rollers at their worst pressure angle", shapes).with_legend(),
    ];
    let gap = SIDE_GAP * outline.size().x;
    let side = plate.machine.cam.thickness.map(|thickness| MILLIMETRES * thickness).map(|thickness| {
        let front = extents_of(&groups);
        side_view(front.least.x - gap - thickness, &outline, (thickness, plate.machine.units()), None)
    });
    let (seen, thickness) = side.unwrap_or_default();
    groups.extend(seen);
    let weight = drawn.parts.first().map(|part| part.weight(&plate.machine));
    Ok(SheetView {
        groups,
        marks: [overall(&outline, plate.machine.units()), thickness, names, angle].concat(),
        tables: places(plate),
        facts: TitleFacts::of(&plate.machine, weight.and_then(|weight| weight.mass_kg)),
        notes: tolerance_note(&plate.machine),
        ..SheetView::default()
    })
}

/// The bed's axis, and a mark where the overrun starts and where it ends.
fn axes(plate: &Wedge, outline: &Extents) -> (Vec<SheetShape>, Vec<Mark>) {
    let beyond = 0.05 * outline.size().x;
    let ends = [outline.least.x - beyond, outline.largest.x + beyond];
    let mut shapes = vec![SheetShape::Line(Vector2::new(ends[0], 0.0), Vector2::new(ends[1], 0.0))];
    let mut marks = Vec::new();
    let (stroke, units) = (MILLIMETRES * plate.stroke(), plate.machine.units());
    let end = match plate.mechanism().bottom_law.in_line() {
        _ if units == LengthUnit::Inch => format!("x = {} in", units.cell(stroke)),
        None => format!("x = r = {stroke} mm"),
        Some(_) => format!("x = {stroke:.3} mm"),
    };
    for (x, text) in [(0.0, "x = 0".to_owned()), (stroke, end)] {
        let (piece, at) = plate.motion.locate(x / MILLIMETRES);
        let centre = plate.curves().contact(piece, at).curve.point * MILLIMETRES;
        shapes.push(SheetShape::Line(centre, Vector2::new(centre.x, -centre.y)));
        marks.push(Mark::Label { class: "axis", at: centre, towards: Vector2::new(0.0, -1.0), text });
    }
    (shapes, marks)
}

/// The rollers of both flanks where the pressure angle is worst, with path, normal and the angle between.
fn rollers(plate: &Wedge) -> (Vec<SheetShape>, Vec<Mark>) {
    let curves = plate.curves();
    let worst = plate.pressure_angle();
    let (piece, x) = curves.motion.locate(worst.at);
    let contact = curves.contact(piece, x);
    let radius = MILLIMETRES * plate.data.roller_radius;
    let (centre, drive, outward) = (contact.curve.point * MILLIMETRES, contact.drive, contact.curve.outward());
    let mut shapes = roller(centre, drive, outward, radius);
    let [upper, upper_drive, upper_outward] = [centre, drive, outward].map(mirrored_about_axis);
    shapes.extend(roller(upper, upper_drive, upper_outward, radius));
    let text = format!("α = {:.2}° at {}", worst.value.to_degrees(), travelled(&plate.machine, worst.at));
    (shapes, pressure_angle(upper, upper_drive, upper_outward, radius, text))
}

fn added_value(row: &Row, name: &str) -> Option<f64> {
    row.added.iter().find(|(column, _)| column.name == name).map(|(_, value)| *value)
}

/// Overrun, travel of the bottom and the upper flank's profile.
fn places(plate: &Wedge) -> Vec<PlaceTable> {
    let units = plate.machine.units();
    let unit = units.symbol();
    let mut rows = Vec::new();
    for row in plate.rows(STEPS) {
        let profile = [row.profile.map(|point| point.x), row.profile.map(|point| point.y)];
        let cells = [added_value(&row, "x_mm"), added_value(&row, "dx_mm")].into_iter().chain(profile);
        rows.push(cells.map(|value| length_cell(value, units)).collect());
    }
    let rows = PlaceTable::regular_rows(rows);
    let heads = ["x, mm", "Δx, mm", "profile x", "profile y"].map(|head| head.replace("mm", unit)).to_vec();
    [1, 2, 4]
        .map(|every| PlaceTable {
            title: format!("Overrun x, travel Δx of the bottom, place of the profile, {unit}"),
            remarks: Vec::new(),
            heads: heads.clone(),
            rows: Arc::clone(&rows),
            every,
        })
        .to_vec()
}

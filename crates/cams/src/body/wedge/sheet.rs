//! What the review sheet of a plate shows.

use super::Wedge;
use crate::body::part_tolerance::PartTolerance;
use crate::body::sheet::{length_cell, overall, pressure_angle, roller, side_view, tolerance_frame, travelled};
use crate::body::{Body, Drawn, Figures};
use crate::report::sheet::Dimensions;
use crate::report::sheet::{Mark, PlaceTable, ShapeGroup, SheetShape, SheetView, TitleFacts, extents_of};
use crate::table::{Row, named_value};
use camgen_kernel::geometry::contour::{Contour, Extents};
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::outline::OutlineError;
use nalgebra::Vector2;
use std::sync::Arc;

/// Distance of the side view from the front view, over the length of the plate.
const SIDE_GAP: f64 = 0.08;
/// Steps of the finest table of the flank over the stroke, and every how many of its rows the others have.
const STEPS: u32 = 72;
const EVERY: [usize; 4] = [1, 2, 4, 8];

/// The plate with its pitch curve and the roller where the pressure angle is worst, its length, height and run-in, and the flank by its
/// coordinates.
///
/// # Errors
/// [`OutlineError`] when the pitch curve cannot be drawn.
pub(super) fn view(wedge: &Wedge, drawn: &Drawn) -> Result<SheetView, OutlineError> {
    let part = drawn.parts.first();
    let contour = part.map(|part| part.outline.contour.clone());
    let nowhere = Extents { least: Vector2::zeros(), largest: Vector2::zeros() };
    let outline = contour.as_ref().map_or(nowhere, Contour::extents);
    let profile = contour.into_iter().map(|contour| SheetShape::Entity(Entity::Polyline(contour))).collect();
    let (lines, names) = travel(wedge, &outline);
    let (shapes, angle) = worst_place(wedge);
    let group = ShapeGroup::new;
    let mut groups = vec![
        group("profile", "profile", profile).with_legend(),
        group("axis", "start and end of the stroke", lines).with_legend(),
    ];
    if wedge.roller_radius().is_some() {
        let curve = wedge.pitch_curve()?.iter().map(|s| SheetShape::Arc(s.start, s.end, s.bulge)).collect();
        groups.push(group("pitch-curve", "pitch curve", curve).with_legend());
    }
    groups.push(group("roller", "follower at its worst pressure angle", shapes).with_legend());
    let gap = SIDE_GAP * outline.size().x;
    let side = wedge.machine.cam.thickness.map(|thickness| MILLIMETRES * thickness).map(|thickness| {
        let front = extents_of(&groups);
        side_view(
            front.least.x.min(outline.least.x) - gap - thickness,
            &outline,
            (thickness, wedge.machine.units()),
            None,
        )
    });
    let (mut seen, thickness) = side.unwrap_or_default();
    // It has no axis that turns.
    seen.retain(|group| group.class == "side");
    groups.extend(seen);
    let weight = part.map(|part| part.weight(&wedge.machine));
    let frame = Some(tolerance_frame(&wedge.machine, PartTolerance::of(wedge), flank_places(wedge), None));
    Ok(SheetView {
        groups,
        marks: [overall(&outline, wedge.machine.units()), thickness, names, angle, frame.into_iter().collect()]
            .concat(),
        tables: places(wedge),
        facts: TitleFacts::of(&wedge.machine, weight.and_then(|weight| weight.mass_kg)),
        ..SheetView::default()
    })
}

/// Places of the flank with the direction out of the metal.
fn flank_places(wedge: &Wedge) -> Vec<(Vector2<f64>, Vector2<f64>)> {
    let (from, to) = wedge.stroke();
    let at = |share: f64| {
        let (piece, x) = wedge.motion.locate(from + share * (to - from));
        let profile = wedge.curves().profile(piece, x);
        (profile.point * MILLIMETRES, profile.outward())
    };
    [0.3, 0.7, 0.5].map(at).to_vec()
}

/// Where the stroke starts and where it ends, on the path of the follower there.
fn travel(wedge: &Wedge, outline: &Extents) -> (Vec<SheetShape>, Vec<Mark>) {
    let units = wedge.machine.units();
    let (from, to) = wedge.stroke();
    let (mut shapes, mut marks) = (Vec::new(), Vec::new());
    for x in [from, to] {
        let (piece, at) = wedge.motion.locate(x);
        let contact = wedge.curves().contact(piece, at);
        let centre = contact.curve.point * MILLIMETRES;
        let touch = wedge.curves().profile(piece, at).point * MILLIMETRES;
        let below = Vector2::new(centre.x, outline.least.y.min(centre.y) - 0.04 * outline.size().x);
        shapes.push(SheetShape::Line(centre, touch));
        shapes.push(SheetShape::Line(centre, below));
        let text = format!("x = {}", units.dimension((MILLIMETRES * x * 1e6).round() / 1e6));
        marks.push(Mark::Label { class: "axis", at: below, towards: Vector2::new(0.0, -1.0), text });
    }
    let [start, ..] = wedge.corners().map(|corner| corner * MILLIMETRES);
    let middle = Vector2::new(start.x + 0.5 * MILLIMETRES * wedge.run_in, start.y);
    let text = format!("run-in {}", units.dimension((1e3 * MILLIMETRES * wedge.run_in).round() / 1e3));
    marks.push(Mark::Label { class: "dimension", at: middle, towards: Vector2::new(-0.5, -1.0), text });
    let middle = Vector2::new(0.5 * (outline.least.x + outline.largest.x), outline.largest.y);
    let text = format!(
        "thickness {} at x = {}",
        units.dimension((1e3 * MILLIMETRES * wedge.thinnest.0).round() / 1e3),
        units.dimension((1e3 * MILLIMETRES * wedge.thinnest.1).round() / 1e3)
    );
    marks.push(Mark::Label { class: "dimension", at: middle, towards: Vector2::new(0.0, 1.0), text });
    (shapes, marks)
}

/// The roller where the pressure angle is worst, with path, normal and the angle between.
fn worst_place(wedge: &Wedge) -> (Vec<SheetShape>, Vec<Mark>) {
    let curves = wedge.curves();
    let worst = wedge.pressure_angle();
    let (piece, x) = curves.motion.locate(worst.at);
    let contact = curves.contact(piece, x);
    let radius = MILLIMETRES * wedge.roller_radius().unwrap_or(0.15 * wedge.height);
    let (centre, drive, outward) = (contact.curve.point * MILLIMETRES, contact.drive, contact.curve.outward());
    let mut shapes = roller(centre, drive, outward, radius);
    if wedge.roller_radius().is_none() {
        // A knife edge has no roller.
        shapes.retain(|shape| !matches!(shape, SheetShape::Entity(_)));
    }
    let text = format!("α = {:.2}° at {}", worst.value.to_degrees(), travelled(&wedge.machine, worst.at));
    (shapes, pressure_angle(centre, drive, outward, radius, text))
}

/// Travel, lift and the flank.
fn places(wedge: &Wedge) -> Vec<PlaceTable> {
    let units = wedge.machine.units();
    let unit = units.symbol();
    let row = |row: &Row| {
        let cell = |value: Option<f64>| length_cell(value, units);
        vec![
            cell(named_value(row, "x_mm")),
            cell(named_value(row, "lift_mm")),
            cell(row.profile.map(|point| point.x)),
            cell(row.profile.map(|point| point.y)),
        ]
    };
    let rows = PlaceTable::regular_rows(wedge.rows(STEPS).iter().map(row));
    let heads = ["x, mm", "lift, mm", "flank x", "flank y"].map(|head| head.replace("mm", unit)).to_vec();
    let table = |every: usize| PlaceTable {
        title: format!(
            "Flank of the plate: travel x, lift there, place of contact, {unit} from the follower at x = 0, lift 0"
        ),
        remarks: Vec::new(),
        heads: heads.clone(),
        rows: Arc::clone(&rows),
        every,
    };
    EVERY.map(table).to_vec()
}

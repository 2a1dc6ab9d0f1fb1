//! What report and sheet say of a rib.

use super::Rib;
use crate::body::{Body, DrawingEvidence, Drawn, Figures, Layer};
use crate::report::sheet::Dimensions;
use crate::report::sheet::{Mark, ShapeGroup, SheetShape, SheetView};
use crate::report::{OutlineMeasures, Rolled, Section, Topic};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::outline::OutlineError;
use camgen_kernel::text::{Length, text};
use nalgebra::Vector2;
use serde::Serialize;

/// A flank.
#[derive(Debug, Serialize)]
struct FlankFigures {
    layer: &'static str,
    /// Of the path of its roller.
    prime_radius_mm: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    outline: Option<OutlineMeasures>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rolling: Option<Rolled>,
}

/// The section `rib`.
#[derive(Debug, Serialize)]
struct RibSection {
    /// Of the path of the middle between the rollers, less the radius of a roller.
    base_radius_mm: f64,
    roller_distance_mm: f64,
    /// Of the wall on the line through both rollers, where it is thinnest.
    #[serde(skip_serializing_if = "Option::is_none")]
    wall_mm: Option<f64>,
    flanks: Vec<FlankFigures>,
}

/// The section on a rib.
pub(super) fn section(rib: &Rib, found: &DrawingEvidence<'_>) -> Section {
    let part = found.drawn.and_then(|drawn| drawn.parts.first());
    let flank = |(index, (disc, layer)): (usize, (&crate::body::disc::Disc, Layer))| FlankFigures {
        layer: layer.name(),
        prime_radius_mm: MILLIMETRES * disc.prime_radius(),
        outline: part.and_then(|part| Some(part.measures_of(part.outlines().nth(index)?.1, found.tolerance_mm))),
        rolling: found.rolled.get(index).cloned(),
    };
    let value = RibSection {
        base_radius_mm: MILLIMETRES * rib.middle.base_radius(),
        roller_distance_mm: MILLIMETRES * rib.distance,
        wall_mm: rib.wall().map(|(wall, _)| MILLIMETRES * wall),
        flanks: rib.flanks().into_iter().enumerate().map(flank).collect(),
    };
    let wall = value.wall_mm.map(|wall| text!(", wall {} where it is thinnest", Length::mm(wall)));
    let mut words = vec![text!("rollers {} apart{}", Length::mm(value.roller_distance_mm), wall)];
    words.extend(value.flanks.iter().filter_map(|flank| {
        let (arcs, off) = (flank.outline.as_ref()?.arcs, flank.rolling.as_ref()?.gap_mm.abs());
        Some(text!("{}: {} arcs, off the exact flank by {} where it is rolled on", flank.layer, arcs, Length::mm(off)))
    }));
    let apart = text!("rollers {} apart", Length::mm(value.roller_distance_mm).brief());
    let wall = value.wall_mm.map(|wall| text!("wall {}", Length::mm(wall).brief()));
    Section::new("rib", &value).with_words(words).with_fact(Topic::new(15, "rib"), apart.and(", ", wall))
}

/// What the review sheet shows: the disc under the outer roller, with the hole around the inner one and both rollers at θ = 0.
pub(super) fn view(rib: &Rib, drawn: &Drawn) -> Result<SheetView, OutlineError> {
    let steeper = rib.inner.pressure_angle().value > rib.outer.pressure_angle().value;
    let mut view = rib.outer.view_within(if steeper { &rib.inner } else { &rib.outer }, drawn)?;
    let Some(part) = drawn.parts.first() else { return Ok(view) };
    let rims = part.rims();
    let hole = rims.iter().filter(|rim| rim.layer == Layer::RibInner).map(|rim| SheetShape::Entity(rim.curve.clone()));
    let place = view.groups.iter().position(|group| group.class == "bore").unwrap_or(view.groups.len());
    let hole = ShapeGroup { id: "inner-flank".into(), ..ShapeGroup::new("bore", "inner flank", hole.collect()) };
    view.groups.insert(place, hole);
    for group in view.groups.iter_mut().filter(|group| group.class == "profile") {
        group.label = "outer flank".into();
    }
    let centres = rib.flanks().map(|(disc, _)| {
        let (piece, angle) = disc.curves().motion.locate(0.0);
        let radius = disc.curves().roller_radius().unwrap_or(f64::NAN);
        let centre = disc.curves().touch(piece, angle).curve.point * MILLIMETRES;
        (crate::body::part::point_as_turned(rib.machine(), centre), MILLIMETRES * radius)
    });
    let circle = |(centre, radius): (Vector2<f64>, f64)| {
        SheetShape::Entity(camgen_kernel::geometry::Entity::Circle(centre, radius))
    };
    let rollers = ShapeGroup::new("arm", "rollers at θ = 0", centres.map(circle).to_vec()).with_legend();
    view.groups.push(rollers);
    let [(outer, _), (inner, _)] = centres;
    let units = rib.machine().units();
    let text = format!("rollers {} apart", units.dimension(MILLIMETRES * rib.distance));
    view.marks.push(Mark::Label { class: "arm", at: 0.5 * (outer + inner), towards: Vector2::new(0.3, 1.0), text });
    Ok(view)
}

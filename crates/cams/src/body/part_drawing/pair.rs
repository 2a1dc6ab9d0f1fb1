//! The drawing of a pair of discs on one shaft: how they lie to each other.

use super::proposals::{PROPOSED, THICKNESS};
use super::section::{SectionPlace, hatched};
use crate::body::{Layer, Part};
use crate::machine::Machine;
use crate::report::sheet::{Dimensions, Mark, PlaceRow, PlaceTable, ShapeGroup, SheetShape, SheetView, TitleFacts};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::{Contour, Extents};
use camgen_kernel::geometry::section::{SectionLayer, section};
use nalgebra::Vector2;

/// Distance of the section below the front view, and of the lines of its hatch, over the size of the pair.
const GAP: f64 = 0.2;
const HATCH: f64 = 0.016;

/// A disc of a pair.
pub(crate) struct PairedDisc<'a> {
    /// "main".
    pub(crate) name: &'a str,
    pub(crate) part: &'a Part,
    /// The name of its drawing.
    pub(crate) drawing: String,
    /// Its mass, kg.
    pub(crate) mass: Option<f64>,
}

/// The view of a pair: the disc in front with the other one dashed, the section through both, and the list of parts; `rollers` are those of the review sheet.
pub(crate) fn of_pair(machine: &Machine, discs: &[PairedDisc<'_>; 2], rollers: Vec<ShapeGroup>) -> SheetView {
    let units = machine.units();
    let thickness = MILLIMETRES * machine.cam.thickness.unwrap_or(0.0);
    let mass = discs.iter().map(|disc| disc.mass).sum::<Option<f64>>();
    let mut view = SheetView { facts: TitleFacts::of(machine, mass), ..SheetView::default() };
    view.facts.thickness_mm = Some(2.0 * thickness);
    let [behind, in_front] = discs;
    for rim in behind.part.rims() {
        let shape = SheetShape::Entity(rim.curve);
        view.groups.push(ShapeGroup { id: "behind".into(), ..ShapeGroup::new("hidden", "disc behind", vec![shape]) });
    }
    for rim in in_front.part.rims() {
        let (class, id) = if rim.layer == Layer::Bore { ("side", "bore") } else { ("outline", "in-front") };
        let shape = SheetShape::Entity(rim.curve);
        view.groups.push(ShapeGroup { id: id.into(), ..ShapeGroup::new(class, "disc in front", vec![shape]) });
    }
    // No colour on a drawing.
    view.groups.extend(rollers.into_iter().map(|group| ShapeGroup { class: "axis", ..group }));
    let front = behind.part.extents().with(&in_front.part.extents());
    let size = front.size().max();
    let place = SectionPlace::below(units, &front, GAP * size, [0.0, 2.0 * thickness]);
    let field = add_section(&place, discs, thickness, size, &mut view);
    view.marks.push(Mark::CuttingLine {
        ends: [Vector2::new(front.least.x, 0.0), Vector2::new(front.largest.x, 0.0)],
        sight: place.sight(),
        letter: place.letter,
    });
    let level = |z: f64| place.at(Vector2::new(0.0, z)).y;
    for (index, z) in [0.5 * thickness, 1.5 * thickness].into_iter().enumerate() {
        let at = Vector2::new(field.least.x, level(z));
        view.marks.push(Mark::Flag { at, outward: -Vector2::x(), name: (index + 1).to_string() });
    }
    view.marks.push(Mark::Size {
        from: Vector2::new(field.largest.x, level(0.0)),
        to: Vector2::new(field.largest.x, level(2.0 * thickness)),
        away: Vector2::x(),
        view: field,
        line: 1,
        text: format!("{} {}{PROPOSED}", units.toleranced(2.0 * thickness), units.limits(THICKNESS)),
        datum: None,
        is_half: false,
    });
    view.tables = vec![list_of_parts(discs)];
    view.notes = vec![
        "Item 2 lies in front of item 1, faces together; both are drawn in one frame, ψ = 0 along +x.".into(),
        if machine.cam.keyway.is_some() {
            "One key turns both discs: their keyways are at the same angle.".into()
        } else {
            "Nothing on the discs fixes their angle to each other: add cam.keyway before release.".into()
        },
        "Both rollers at θ = 0, double-dot: no play that can be felt all round, nowhere tight.".into(),
        super::PROPOSED_NOTE.into(),
    ];
    view
}

/// The section through both discs, hatched in opposite directions; the field that it takes.
fn add_section(
    place: &SectionPlace,
    discs: &[PairedDisc<'_>; 2],
    thickness: f64,
    size: f64,
    view: &mut SheetView,
) -> Extents {
    let mut contours: Vec<Contour> = Vec::new();
    let mut layers = Vec::new();
    let mut low = 0.0;
    for disc in discs {
        let first = contours.len();
        contours.extend(disc.part.standing_rims(thickness).into_iter().map(|rim| rim.wall.contour));
        layers.push(SectionLayer { rims: (first..contours.len()).collect(), low, high: low + thickness });
        low += thickness;
    }
    let cut = section(&contours, &layers, place.along);
    let line = |from: Vector2<f64>, to: Vector2<f64>| SheetShape::Line(place.at(from), place.at(to));
    let edges: Vec<SheetShape> = cut.edges.iter().map(|edge| line(edge.from, edge.to)).collect();
    let mut hatch = Vec::new();
    for field in &cut.cut {
        let [one, other] = [place.at(field.least), place.at(field.largest)];
        let on_paper = Extents { least: one.inf(&other), largest: one.sup(&other) };
        hatch.extend(if field.least.y < 0.5 * thickness {
            hatched(&on_paper, HATCH * size)
        } else {
            let across = Extents {
                least: Vector2::new(-on_paper.largest.x, on_paper.least.y),
                largest: Vector2::new(-on_paper.least.x, on_paper.largest.y),
            };
            hatched(&across, HATCH * size).into_iter().map(mirrored).collect()
        });
    }
    let lines = ShapeGroup { id: "section-A".into(), ..ShapeGroup::new("side", "edges of the section", edges) };
    let field = crate::report::sheet::extents_of(std::slice::from_ref(&lines));
    view.groups.push(ShapeGroup { id: "hatch-A".into(), ..ShapeGroup::new("hatch metal", "cut surfaces", hatch) });
    view.groups.push(lines);
    view.marks.push(Mark::Caption { view: field, text: "A–A".into() });
    field
}

/// A line on the other side of the axis x = 0.
fn mirrored(shape: SheetShape) -> SheetShape {
    let across = |point: Vector2<f64>| Vector2::new(-point.x, point.y);
    match shape {
        SheetShape::Line(from, to) => SheetShape::Line(across(from), across(to)),
        other => other,
    }
}

/// The list of parts, ISO 7573.
fn list_of_parts(discs: &[PairedDisc<'_>; 2]) -> PlaceTable {
    let row = |(index, disc): (usize, &PairedDisc<'_>)| {
        let mass = disc.mass.map_or_else(String::new, |mass| format!("{mass:.3}"));
        PlaceRow::regular(index, vec![(index + 1).to_string(), disc.name.to_owned(), mass, disc.drawing.clone()])
    };
    PlaceTable {
        title: "Parts".into(),
        heads: ["item", "disc", "kg", "drawing"].map(str::to_owned).to_vec(),
        remarks: Vec::new(),
        rows: discs.iter().enumerate().map(row).collect(),
        every: 1,
    }
}

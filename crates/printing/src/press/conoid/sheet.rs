//! The review sheet of a conoid: the sections over each other, coloured by speed, and the cam seen isometrically.

use super::report::mass_of;
use super::{Conoid, Slice};
use camgen_cams::body::sheet::{axes, bore, overall, section_profiles, side_view, tolerance_note, turning};
use camgen_cams::body::{Drawn, Part};
use camgen_cams::machine::Rotation;
use camgen_cams::report::sheet::Dimensions;
use camgen_cams::report::sheet::{Mark, PlaceTable, ShapeGroup, SheetShape, SheetView, TitleFacts, rounded};
use camgen_kernel::geometry::contour::{Contour, Extents};
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::motion::Motion;
use camgen_kernel::text::{Length, text};
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// Most speeds that are named one by one.
const MOST_NAMED: usize = 8;
/// Room between plan and isometric view, and width of that view, over the width of the plan.
const GAP_OVER_WIDTH: f64 = 0.12;
const PICTURE_OVER_WIDTH: f64 = 0.62;
/// Points of a turn and lines along the axis in the isometric view, and points of each such line.
const TURN: u32 = 180;
const RULERS: u32 = 24;
const RULER: u32 = 24;

/// Colour for a share in [0, 1]: from blue for the slowest to red for the fastest.
fn colour(share: f64) -> String {
    let [red, green, blue] =
        [(30.0, 200.0), (90.0, 40.0), (180.0, 30.0)].map(|(from, to)| (from + (to - from) * share).round());
    format!("rgb({red},{green},{blue})")
}

/// What the review sheet shows.
#[must_use]
pub(super) fn view(conoid: &Conoid, drawn: &Drawn) -> SheetView {
    let parts = &drawn.parts;
    let plan = parts.iter().map(|part| part.outline.contour.extents()).reduce(|a, b| a.with(&b));
    let plan = plan.unwrap_or(Extents { least: Vector2::zeros(), largest: Vector2::zeros() });
    let holes =
        parts.first().map_or_else(Vec::new, |part: &Part| part.holes().into_iter().map(SheetShape::Entity).collect());
    let mut groups = vec![ShapeGroup::new("axis", "axes", axes(&plan)), ShapeGroup::new("bore", "bore", holes)];
    let (picture, seen) = picture(conoid, &plan);
    groups.push(picture);
    let cuts = conoid.sections_cut();
    // Of many sections every few are named.
    let every = cuts.len().div_ceil(MOST_NAMED);
    groups.extend(cuts.iter().zip(parts).enumerate().map(|(index, (cut, part))| {
        let label = text!("section for {} rpm, z = {}", rounded(cut.rpm), Length::mm(MILLIMETRES * cut.z).rounded());
        ShapeGroup {
            id: format!("section-{index}"),
            class: "section",
            label,
            colour: Some(conoid.colour_of(cut.rpm)),
            shapes: vec![SheetShape::Entity(Entity::Polyline(part.outline.contour.clone()))],
            in_legend: index % every == 0 || index + 1 == cuts.len(),
        }
    }));
    groups.extend(seen);
    let (side, length) = from_the_side(conoid, parts, &plan);
    groups.extend(side);
    let (low, high) = conoid.ends();
    let mass = drawn.flank.as_ref().map(|flank| mass_of(conoid, flank));
    SheetView {
        groups,
        marks: [marks(conoid, parts, &plan), length].concat(),
        tables: tables(conoid, parts),
        facts: TitleFacts { thickness_mm: Some(MILLIMETRES * (high - low)), ..TitleFacts::of(&conoid.machine, mass) },
        notes: tolerance_note(&conoid.machine),
        ..SheetView::default()
    }
}

impl Conoid {
    /// The colour of a section for a speed, rpm.
    fn colour_of(&self, rpm: f64) -> String {
        let (first, last) = (self.speeds.first().copied().unwrap_or(0.0), self.speeds.last().copied().unwrap_or(0.0));
        colour(if last > first { (rpm - first) / (last - first) } else { 1.0 })
    }
}

/// A picture of the solid, not to scale, above the plan and in its middle, and the sections on it.
fn picture(conoid: &Conoid, plan: &Extents) -> (ShapeGroup, Vec<ShapeGroup>) {
    let seen = Isometric { conoid, turned: conoid.machine.cam.rotation == Rotation::CounterClockwise };
    let (low, high) = conoid.ends();
    let ends = [low, high].map(|z| seen.ring(z));
    let rulers: Vec<SeenLine> = (0..RULERS).map(|i| seen.ruler(i, low, high)).collect();
    let points = ends.iter().chain(&rulers).flatten().map(|(point, _)| point);
    let start = Extents { least: Vector2::repeat(f64::INFINITY), largest: Vector2::repeat(f64::NEG_INFINITY) };
    let solid = points.fold(start, |extents, p| extents.with(&Extents { least: *p, largest: *p }));
    let share = PICTURE_OVER_WIDTH * plan.size().x / solid.size().x.max(f64::MIN_POSITIVE);
    let shift = Vector2::new(
        0.5 * (plan.least.x + plan.largest.x) - 0.5 * share * (solid.least.x + solid.largest.x),
        plan.largest.y + GAP_OVER_WIDTH * plan.size().x - share * solid.least.y,
    );
    let placing = PicturePlacing { share, shift };
    // All of the upper end is seen.
    let upper: Vec<Vector2<f64>> = ends[1].iter().map(|(point, _)| *point).collect();
    let mut outlines = vec![placing.path(&upper)];
    for line in ends.iter().take(1).chain(&rulers) {
        outlines.extend(placing.visible_paths(line));
    }
    let sections = conoid.sections_cut().into_iter().enumerate().map(|(index, cut)| ShapeGroup {
        id: format!("seen-{index}"),
        colour: Some(conoid.colour_of(cut.rpm)),
        ..ShapeGroup::new("seen", "section in the isometric view", placing.visible_paths(&seen.ring(cut.z)))
    });
    let solid = ShapeGroup::new("isometric", "isometric view, not to scale", outlines).with_legend();
    (solid, sections.collect())
}

/// Scale and position of the picture on the sheet.
struct PicturePlacing {
    share: f64,
    shift: Vector2<f64>,
}

impl PicturePlacing {
    fn path(&self, line: &[Vector2<f64>]) -> SheetShape {
        SheetShape::Path(line.iter().map(|point| point * self.share + self.shift).collect())
    }

    fn visible_paths(&self, line: &SeenLine) -> Vec<SheetShape> {
        shown_parts(line).iter().map(|part| self.path(part)).collect()
    }
}

/// The cam from the side, with the positions of its sections.
fn from_the_side(conoid: &Conoid, parts: &[Part], plan: &Extents) -> (Vec<ShapeGroup>, Vec<Mark>) {
    let (low, high) = conoid.ends();
    let left = plan.largest.x + 2.0 * GAP_OVER_WIDTH * plan.size().x;
    let bore = conoid.machine.cam.bore_radius.map(|radius| MILLIMETRES * radius);
    let (mut groups, marks) = side_view(left, plan, (MILLIMETRES * (high - low), conoid.machine.units()), bore);
    groups.extend(conoid.sections_cut().into_iter().zip(parts).enumerate().map(|(index, (cut, part))| {
        let (at, seen) = (left + MILLIMETRES * (cut.z - low), part.outline.contour.extents());
        let line = SheetShape::Line(Vector2::new(at, seen.least.y), Vector2::new(at, seen.largest.y));
        ShapeGroup {
            id: format!("side-{index}"),
            colour: Some(conoid.colour_of(cut.rpm)),
            ..ShapeGroup::new("seen", "section in the side view", vec![line])
        }
    }));
    (groups, marks)
}

/// Dimensions, bore and rotation.
fn marks(conoid: &Conoid, parts: &[Part], plan: &Extents) -> Vec<Mark> {
    let base = parts.iter().map(|part| part.outline.contour.extents().largest.x).fold(0.0, f64::max);
    let marks = [
        overall(plan, conoid.machine.units()),
        bore(&conoid.machine, parts.first().and_then(|part| part.balancing.as_ref())),
        turning(&conoid.machine, 0.7 * base, base, "θ = 0, φ = 0"),
    ];
    marks.concat()
}

/// The profiles of the sections where there are few, else their sizes.
fn tables(conoid: &Conoid, parts: &[Part]) -> Vec<PlaceTable> {
    let units = conoid.machine.units();
    let mut named: Vec<(String, &Contour)> = Vec::new();
    for (cut, part) in conoid.sections_cut().iter().zip(parts) {
        let head = format!("z = {}", units.dimension((1e3 * MILLIMETRES * cut.z).round() / 1e3));
        named.push((head, &part.outline.contour));
    }
    let profiles = if named.len() <= MOST_NAMED { section_profiles(&named, units) } else { Vec::new() };
    profiles.into_iter().chain([sections_table(conoid, parts)]).collect()
}

/// Speed, axial position and extents of each section.
fn sections_table(conoid: &Conoid, parts: &[Part]) -> PlaceTable {
    let units = conoid.machine.units();
    let unit = units.symbol();
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (cut, part) in conoid.sections_cut().into_iter().zip(parts) {
        let size = part.outline.contour.extents().size();
        let area = part.area_and_moment().0;
        let lengths = [MILLIMETRES * cut.z, size.x, size.y].map(|length| units.dimension(length));
        let area = match units {
            LengthUnit::Millimetre => format!("{area:.1}"),
            LengthUnit::Inch => format!("{:.3}", units.of_mm_to(area, 2)),
        };
        rows.push(std::iter::once(rounded(cut.rpm)).chain(lengths).chain([area]).collect());
    }
    PlaceTable {
        title: "Sections: speed, place along the axis, width, height, area".into(),
        remarks: Vec::new(),
        heads: ["n, rpm", "z, mm", "width, mm", "height, mm", "area, mm²"]
            .map(|head| head.replace("mm", unit))
            .to_vec(),
        rows: PlaceTable::regular_rows(rows),
        every: 1,
    }
}

/// Points of a line of the isometric view, mm, and whether the surface there faces the viewer.
type SeenLine = Vec<(Vector2<f64>, bool)>;

/// The parts of a line that are seen.
fn shown_parts(line: &SeenLine) -> Vec<Vec<Vector2<f64>>> {
    let parts = line.split(|(_, faces)| !faces).map(|part| part.iter().map(|(point, _)| *point).collect());
    parts.filter(|part: &Vec<Vector2<f64>>| part.len() > 1).collect()
}

/// The isometric view.
struct Isometric<'a> {
    conoid: &'a Conoid,
    turned: bool,
}

impl Isometric<'_> {
    fn seen(&self, point: Vector2<f64>, z: f64) -> Vector2<f64> {
        let y = if self.turned { -point.y } else { point.y };
        // Isometric: x and y at 30° to either side, z upwards.
        let half = 0.5;
        let root = 0.5 * 3.0_f64.sqrt();
        Vector2::new((point.x - y) * root, z - (point.x + y) * half) * MILLIMETRES
    }

    /// The point at a share of the turn of a slice at z.
    fn point_at(&self, law: &Slice<'_>, share: f64, z: f64) -> (Vector2<f64>, bool) {
        let (first, last) = law.range();
        let (piece, angle) = law.locate(first + (last - first) * share);
        let Some((frame, roller)) = self.conoid.cut(piece, angle, z) else { return (Vector2::zeros(), false) };
        // From the surface to the centre of the sphere that touches it there; the viewer is at (1, 1, 1).
        let along = roller - z;
        let radius = self.conoid.roller.radius;
        let outward = frame.outward() * ((radius - along) * (radius + along)).max(0.0).sqrt();
        let faces = outward.x + if self.turned { -outward.y } else { outward.y } + along > 0.0;
        (self.seen(frame.point, z), faces)
    }

    fn ring(&self, z: f64) -> SeenLine {
        let law = self.conoid.slice(z);
        (0..=TURN).map(|i| self.point_at(&law, f64::from(i % TURN) / f64::from(TURN), z)).collect()
    }

    fn ruler(&self, index: u32, low: f64, high: f64) -> SeenLine {
        let share = f64::from(index) / f64::from(RULERS);
        let places = (0..=RULER).map(|i| low + (high - low) * f64::from(i) / f64::from(RULER));
        places.map(|z| self.point_at(&self.conoid.slice(z), share, z)).collect()
    }
}

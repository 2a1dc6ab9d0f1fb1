//! A mechanism in a few positions, one below the other at one scale, with a ruler.

use super::marks::label;
use super::paper::REDUCTIONS;
use super::placing::OccupiedPaper;
use super::{ShapeGroup, SheetShape, TextAnchor, font, rounded, words};
use crate::report::scheme::{Scheme, SchemeDimension, SchemeJoint, SchemeLabel, SchemePose, Stroke, StrokeKind};
use crate::report::trace::round_step;
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// Height of the texts, and of the line above a position, mm.
const TEXT: f64 = 3.4;
const HEAD: f64 = 5.0;
/// Size of the letters over the lettering of an A4.
const LETTERING: f64 = 0.9;
/// Room to the sides of a position, and above and below it, mm: letters also find room between the lines.
const MARGIN: [f64; 2] = [2.5, 1.2];
/// Radius of a joint, and of the ring about a fixed one, mm.
const JOINT: f64 = 0.7;
const RING: f64 = 1.3;
/// Distance of two dimension lines, the room for sizes about a position, and length and width of the heads of arrows, mm.
const LANE: f64 = 6.5;
const LABELS: f64 = 6.0;
const ARROW: [f64; 2] = [2.2, 0.7];
/// Enlargements of ISO 5455 before its reductions: a length on the sheet is a true length over this.
const ENLARGEMENTS: [f64; 5] = [0.02, 0.05, 0.1, 0.2, 0.5];
/// Least number of rulers that would fit in a row, and half the height of the ends of one, mm.
const RULERS: f64 = 6.0;
const TICK: f64 = 1.2;

/// The scheme in a field of paper, with a colour for each link.
#[must_use]
pub(in crate::report) fn draw(
    scheme: &Scheme,
    field: &Extents,
    colour: impl Fn(usize) -> &'static str,
) -> Vec<ShapeGroup> {
    let Some(covered) = covered(scheme) else { return Vec::new() };
    let lines = scheme.notes.iter().flat_map(|note| font::wrapped(note, TEXT, field.size().x)).collect::<Vec<_>>();
    #[expect(clippy::cast_precision_loss, reason = "a few lines and positions")]
    let (count, poses) = (lines.len() as f64, scheme.poses.len().max(1) as f64);
    // The ruler is below the positions, and the notes are below the ruler.
    let each = (field.size().y - (count * font::LEADING + 2.5) * TEXT) / poses;
    let lanes = || scheme.poses.iter().flat_map(|pose| &pose.dimensions).map(|dimension| f64::from(dimension.lane));
    let (below, above) = (lanes().fold(0.0, f64::max), lanes().map(|lane| -lane).fold(0.0, f64::max));
    let sizes = if scheme.poses.iter().any(|pose| !pose.labels.is_empty()) { 2.0 * LABELS } else { 0.0 };
    let margin = 2.0 * Vector2::from(MARGIN) + Vector2::new(sizes, sizes + (below + above) * LANE);
    let room = Vector2::new(field.size().x, each - HEAD) - margin;
    let reduction = reduction(covered.size(), room);
    let mut groups = Vec::new();
    let mut top = field.largest.y;
    for (index, pose) in scheme.poses.iter().enumerate() {
        let cell =
            Extents { least: Vector2::new(field.least.x, top - each), largest: Vector2::new(field.largest.x, top) };
        let middle = 0.5 * (cell.least + cell.largest) - Vector2::new(0.0, 0.5 * (HEAD + (above - below) * LANE));
        let at = |point: Vector2<f64>| middle + (point - 0.5 * (covered.least + covered.largest)) / reduction;
        let sizes = dimensions(&pose.dimensions, index, &covered, &at);
        let letters_keep_clear = sizes.iter().flat_map(|group| group.shapes.clone()).collect::<Vec<_>>();
        groups.extend(sizes);
        groups.extend(of_pose(pose, index, &cell, &letters_keep_clear, &at, &colour));
        top -= each;
    }
    groups.push(ruler(&Extents { largest: Vector2::new(field.largest.x, top), ..*field }, reduction));
    let mut height = top - 2.0 * TEXT;
    let mut notes = Vec::new();
    for line in lines {
        height -= font::LEADING * TEXT;
        notes.push(words(Vector2::new(field.least.x, height), TEXT, TextAnchor::Start, line));
    }
    groups.push(ShapeGroup { class: "facts", ..ShapeGroup::new("scheme-notes", "what the lines are", notes) });
    groups
}

/// The extents of all positions, mm; `None` for a scheme without a size.
fn covered(scheme: &Scheme) -> Option<Extents> {
    let (least, largest) = scheme
        .points()
        .fold((Vector2::repeat(f64::INFINITY), Vector2::repeat(f64::NEG_INFINITY)), |(least, largest), point| {
            (least.inf(&point), largest.sup(&point))
        });
    let size = largest - least;
    (size.x + size.y > 0.0 && size.x.is_finite() && size.y.is_finite()).then_some(Extents { least, largest })
}

/// True length over that on paper: the largest scale of ISO 5455 at which all fits, or the one that just does.
fn reduction(size: Vector2<f64>, room: Vector2<f64>) -> f64 {
    let needed = (size.x / room.x).max(size.y / room.y);
    ENLARGEMENTS.iter().chain(REDUCTIONS).copied().find(|reduction| *reduction >= needed).unwrap_or(needed)
}

/// The scale as people write it.
fn scale(reduction: f64) -> String {
    if reduction < 1.0 {
        format!("Scale {}:1", rounded(1.0 / reduction))
    } else {
        format!("Scale 1:{}", rounded(reduction))
    }
}

/// A ruler of a round length in millimetres at the head of the field, with the scale.
fn ruler(field: &Extents, reduction: f64) -> ShapeGroup {
    let length = round_step(field.size().x * reduction, RULERS);
    let start = Vector2::new(field.least.x, field.largest.y - TEXT);
    let end = start + Vector2::new(length / reduction, 0.0);
    let tick = Vector2::new(0.0, TICK);
    let text = format!("{} mm; {}", rounded(length), scale(reduction).to_lowercase());
    let shapes = vec![
        SheetShape::Line(start, end),
        SheetShape::Line(start - tick, start + tick),
        SheetShape::Line(end - tick, end + tick),
        words(end + Vector2::new(TEXT, -0.35 * TEXT), TEXT, TextAnchor::Start, text),
    ];
    ShapeGroup { class: "dimension", ..ShapeGroup::new("ruler", "ruler", shapes) }
}

/// The dimension lines of a position: below and above what all positions cover.
fn dimensions(
    all: &[SchemeDimension],
    index: usize,
    covered: &Extents,
    at: &impl Fn(Vector2<f64>) -> Vector2<f64>,
) -> Option<ShapeGroup> {
    let mut shapes = Vec::new();
    let (low, high) = (at(covered.least).y, at(covered.largest).y);
    for dimension in all {
        let lane = f64::from(dimension.lane);
        let y = if lane > 0.0 { low - lane * LANE } else { high - lane * LANE };
        let ends = dimension.ends.map(&at);
        let [a, b] = if ends[0].x <= ends[1].x { ends } else { [ends[1], ends[0]] };
        let beyond = if lane > 0.0 { -1.0 } else { 1.0 };
        for end in [a, b] {
            let start = Vector2::new(end.x, end.y + beyond);
            shapes.push(SheetShape::Line(start, Vector2::new(end.x, y + beyond)));
        }
        let width = b.x - a.x;
        shapes.push(SheetShape::Line(Vector2::new(a.x, y), Vector2::new(b.x, y)));
        // Arrows that have no room point from outside.
        let way = if width > 3.0 * ARROW[0] { 1.0 } else { -1.0 };
        for (x, side) in [(a.x, way), (b.x, -way)] {
            let back = x + side * ARROW[0];
            let corner = |up: f64| Vector2::new(back, y + up * 0.5 * ARROW[1]);
            shapes.push(SheetShape::Triangle([Vector2::new(x, y), corner(1.0), corner(-1.0)]));
        }
        let (text, size) =
            font::fitted_in_one(&dimension.text, TEXT, (width - 1.0).max(0.6 * font::width(&dimension.text, TEXT)));
        shapes.push(words(Vector2::new(0.5 * (a.x + b.x), y + 0.35 * TEXT), size, TextAnchor::Middle, text));
    }
    (!shapes.is_empty())
        .then(|| ShapeGroup { id: format!("dimensions-{index}"), ..ShapeGroup::new("dimension", "dimensions", shapes) })
}

/// The mechanism in one position in its cell.
fn of_pose(
    pose: &SchemePose,
    index: usize,
    cell: &Extents,
    before: &[SheetShape],
    at: &impl Fn(Vector2<f64>) -> Vector2<f64>,
    colour: &impl Fn(usize) -> &'static str,
) -> Vec<ShapeGroup> {
    let (head, size) = font::fitted_in_one(&pose.name, TEXT, cell.size().x);
    let head = words(Vector2::new(cell.least.x, cell.largest.y - TEXT), size, TextAnchor::Start, head);
    let line = |(number, stroke): (usize, &Stroke)| ShapeGroup {
        id: format!("stand-{index}-{number}"),
        class: class(stroke.kind),
        label: stroke.name.into(),
        colour: if let StrokeKind::Link(which) = stroke.kind { Some(colour(which).into()) } else { None },
        shapes: vec![SheetShape::Path(stroke.points.iter().map(|point| at(*point)).collect())],
        in_legend: false,
    };
    let mut groups: Vec<ShapeGroup> = pose.strokes.iter().enumerate().map(line).collect();
    let disc = |joint: &SchemeJoint| {
        let radii = if joint.fixed { vec![RING, JOINT] } else { vec![JOINT] };
        radii.into_iter().map(|radius| SheetShape::Entity(Entity::Circle(at(joint.at), radius))).collect::<Vec<_>>()
    };
    let discs = pose.joints.iter().flat_map(disc).collect();
    groups.push(ShapeGroup { id: format!("joints-{index}"), ..ShapeGroup::new("joint", "joints", discs) });
    let mut taken = OccupiedPaper::none(*cell);
    taken.put(&head);
    for shape in before {
        taken.put(shape);
    }
    for shape in groups.iter().flat_map(|group| &group.shapes) {
        taken.put(shape);
    }
    let letter = |joint: &SchemeJoint| label(&mut taken, LETTERING, at(joint.at), joint.towards, joint.letter);
    let mut letters: Vec<SheetShape> = pose.joints.iter().flat_map(letter).collect();
    letters.push(head);
    let size = |sized: &SchemeLabel| label(&mut taken, LETTERING, at(sized.at), sized.towards, &sized.text);
    let sizes: Vec<SheetShape> = pose.labels.iter().flat_map(size).collect();
    if !sizes.is_empty() {
        groups.push(ShapeGroup { id: format!("sizes-{index}"), ..ShapeGroup::new("dimension", "sizes", sizes) });
    }
    groups.push(ShapeGroup { class: "facts", ..ShapeGroup::new("letters", "letters of the joints", letters) });
    if let Some(last) = groups.last_mut() {
        last.id = format!("letters-{index}");
    }
    groups
}

fn class(kind: StrokeKind) -> &'static str {
    match kind {
        StrokeKind::Link(_) => "link",
        StrokeKind::Body => "bed",
        StrokeKind::Path => "joint-path",
        StrokeKind::Guide => "axis",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest scale of ISO 5455 that fits, for a watch and for a ship; beyond the standard scales, one that just fits.
    #[test]
    fn scales_are_standard() {
        let room = Vector2::new(200.0, 70.0);
        for (width, known) in [
            (1e-3, "Scale 50:1"),
            (90.0, "Scale 2:1"),
            (200.0, "Scale 1:1"),
            (201.0, "Scale 1:2"),
            (1e3, "Scale 1:5"),
            (1e6, "Scale 1:5000"),
        ] {
            let reduction = reduction(Vector2::new(width, 0.0), room);
            assert!(width / reduction <= room.x, "{width} mm");
            assert_eq!(scale(reduction), known);
        }
        assert_eq!(reduction(Vector2::new(0.0, 7e12), room), 1e11);
    }

    /// A ruler is as long on paper as the scale has it.
    #[test]
    fn a_ruler_is_of_its_length() {
        let field = Extents { least: Vector2::zeros(), largest: Vector2::new(200.0, 20.0) };
        let group = ruler(&field, 5.0);
        let Some(SheetShape::Line(from, to)) = group.shapes.first() else { panic!("a line") };
        assert!(((to - from).norm() - 40.0).abs() < 1e-12);
        let has_length =
            |shape: &SheetShape| matches!(shape, SheetShape::Text { text, .. } if text == "200 mm; scale 1:5");
        assert!(group.shapes.iter().any(has_length));
    }
}

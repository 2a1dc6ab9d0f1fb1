//! What the lines of the diagram are, its notes, and its segments, to the left of the title block.

use super::labels::SIZE;
use super::{DiagramPanel, DiagramSegment, MotionDiagram, figure};
use crate::report::sheet::{ShapeGroup, SheetShape, TextAnchor, font, words};
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// Room between the sides of the field and the texts, and between two columns, mm.
const PAD: f64 = 2.5;
const BETWEEN: f64 = 4.0;
/// Length of the sample of a line, mm.
const SAMPLE: f64 = 9.0;

/// A line of text, with the style of a sample before it, and how far it is set in.
struct Note {
    sample: Option<&'static str>,
    text: String,
}

/// Samples and notes in the left column, segments in the right one; what finds no room there is counted.
pub(super) fn groups(diagram: &MotionDiagram, remarks: &[String], field: &Extents) -> Vec<ShapeGroup> {
    let width = 0.5 * (field.size().x - 2.0 * PAD - BETWEEN);
    let step = font::LEADING * SIZE;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few lines")]
    let most = ((field.size().y - 2.0 * PAD) / step).floor() as usize;
    let mut left = samples(diagram);
    for remark in remarks {
        left.extend(font::wrapped(remark, SIZE, width).into_iter().map(|text| Note { sample: None, text }));
    }
    // A long left column goes on in the right one.
    let spilled = left.split_off(left.len().min(most));
    let room = most.saturating_sub(spilled.len());
    let right = spilled.into_iter().chain(segments(diagram, room).into_iter().map(|text| Note { sample: None, text }));
    let (mut texts, mut motion, mut cut) = (Vec::new(), Vec::new(), Vec::new());
    let top = field.largest.y - PAD - font::ASCENT * SIZE;
    let mut put = |column: f64, notes: Vec<Note>| {
        let x = field.least.x + PAD + column * (width + BETWEEN);
        let mut y = top;
        for Note { sample, text } in notes.into_iter().take(most) {
            let start = x + if sample.is_some() { SAMPLE + 2.0 } else { 0.0 };
            let line = SheetShape::Line(Vector2::new(x, y + 0.36 * SIZE), Vector2::new(x + SAMPLE, y + 0.36 * SIZE));
            match sample {
                Some("trace-cut") => cut.push(line),
                Some(_) => motion.push(line),
                None => {}
            }
            let (text, size) = font::fitted_in_one(&text, SIZE, width - (start - x));
            texts.push(words(Vector2::new(start, y), size, TextAnchor::Start, text));
            y -= step;
        }
    };
    put(0.0, left);
    put(1.0, right.collect());
    [("facts", texts), ("trace-motion", motion), ("trace-cut", cut)]
        .into_iter()
        .filter(|(_, shapes)| !shapes.is_empty())
        .map(|(class, shapes)| ShapeGroup {
            id: format!("diagram-notes-{class}"),
            ..ShapeGroup::new(class, "what the lines are", shapes)
        })
        .collect()
}

/// The lines of the diagram.
fn samples(diagram: &MotionDiagram) -> Vec<Note> {
    let cut: Vec<String> =
        diagram.panels.iter().filter(|panel| !panel.cut.is_empty()).map(|panel| panel.name.to_lowercase()).collect();
    let mut samples =
        vec![Note { sample: Some("trace-motion"), text: "by the motion; circles: largest and least".into() }];
    if !cut.is_empty() {
        let text = format!("{} as cut, on the written outline", cut.join(", "));
        samples.push(Note { sample: Some("trace-cut"), text });
    }
    let jumps = |panel: &DiagramPanel| !panel.impulses.is_empty();
    samples.extend(diagram.panels.iter().rfind(|panel| jumps(panel)).map(|panel| Note {
        sample: None,
        text: format!("Arrows: {} infinite for an instant, at a step of its integral.", panel.name.to_lowercase()),
    }));
    samples
}

/// A line for each segment, as many as there is room for.
fn segments(diagram: &MotionDiagram, room: usize) -> Vec<String> {
    let mut whole: Vec<(&DiagramSegment, (f64, f64))> = Vec::new();
    for segment in &diagram.segments {
        match whole.iter_mut().find(|(known, _)| known.number == segment.number) {
            // The part after the end of the axis is the first on it.
            Some((_, range)) => range.0 = segment.range.0,
            None => whole.push((segment, segment.range)),
        }
    }
    whole.sort_by_key(|(segment, _)| segment.number);
    let unit = if diagram.turns { "°".to_owned() } else { format!(" {}", diagram.units.symbol()) };
    let line = |(segment, (from, to)): &(&DiagramSegment, (f64, f64))| {
        let DiagramSegment { number, name, travel, .. } = segment;
        format!("{number}: {}{unit} to {}{unit} {name}, {travel}", figure(*from), figure(*to))
    };
    let mut lines: Vec<String> = whole.iter().map(line).collect();
    if lines.len() + 1 > room {
        let shown = room.saturating_sub(2);
        let more = lines.len() - shown;
        lines.truncate(shown);
        lines.push(format!("and {more} more segments, in the report"));
    }
    lines.insert(0, "Segments of the motion:".into());
    lines
}

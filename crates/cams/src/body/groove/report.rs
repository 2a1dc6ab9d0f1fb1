//! The section of the report on a groove or a ring.

use super::{Groove, RING};
use crate::body::flank_switch::SwitchFigures;
use crate::body::{Body, DrawingEvidence};
use crate::report::{OutlineMeasures, Rolled, Section, Topic};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::text::{Length, Text, text};
use serde::Serialize;

/// A flank.
#[derive(Debug, Serialize)]
struct FlankFigures {
    layer: &'static str,
    /// From the path of the roller's centre.
    distance_mm: f64,
    /// Smallest concave radius, which limits the cutter.
    #[serde(skip_serializing_if = "Option::is_none")]
    min_concave_radius_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    outline: Option<OutlineMeasures>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rolling: Option<Rolled>,
}

/// The section `groove`, or `ring`.
#[derive(Debug, Serialize)]
struct TrackSection {
    blank_radius_mm: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    width_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    clearance_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    depth_mm: Option<f64>,
    flanks: Vec<FlankFigures>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    switches: Vec<SwitchFigures>,
}

/// The section on a groove or a ring.
pub(super) fn section(groove: &Groove, found: &DrawingEvidence<'_>) -> Section {
    let part = found.drawn.and_then(|drawn| drawn.parts.first());
    let flank = |(index, flank): (usize, &super::Flank)| {
        let curves = groove.curves_of(flank);
        let outline = part.and_then(|part| Some(part.measures_of(part.outlines().nth(index)?.1, found.tolerance_mm)));
        FlankFigures {
            layer: flank.layer.name(),
            distance_mm: MILLIMETRES * curves.offset().abs(),
            min_concave_radius_mm: flank.worst.min_concave_radius(curves).map(|worst| MILLIMETRES * worst.value),
            outline,
            rolling: found.rolled.get(index).cloned(),
        }
    };
    let track = groove.machine().cam.track;
    let is_ring = *groove.kind == RING;
    let switches = groove.flank_switches().filter(|_| !is_ring).unwrap_or_default();
    let value = TrackSection {
        blank_radius_mm: MILLIMETRES * groove.blank_radius,
        width_mm: groove.width().map(|width| MILLIMETRES * width),
        clearance_mm: (!is_ring).then_some(MILLIMETRES * track.clearance),
        depth_mm: track.groove_depth.filter(|_| !is_ring).map(|depth| MILLIMETRES * depth),
        flanks: groove.flanks.iter().enumerate().map(flank).collect(),
        switches: switches.iter().map(|found| SwitchFigures::of(found, ["inner", "outer"])).collect(),
    };
    let words = words(&value);
    let width = value.width_mm.map(|width| text!("{} wide", Length::mm(width).nominal()));
    let depth = value.depth_mm.map(|depth| text!("{} deep", Length::mm(depth).nominal()));
    let blank = text!("blank Ø{}", Length::mm(2.0 * value.blank_radius_mm).nominal());
    let track = Text::joined([width, depth].into_iter().flatten().chain([blank]), ", ");
    Section::new(groove.kind.keys, &value).with_words(words).with_fact(Topic::new(15, groove.kind.keys), track)
}

fn words(section: &TrackSection) -> Vec<Text> {
    let TrackSection { blank_radius_mm, width_mm, clearance_mm, depth_mm, flanks, switches } = section;
    let size = match (width_mm, clearance_mm) {
        (Some(width), Some(clearance)) => {
            let deep = depth_mm.map(|depth| text!(", {} deep", Length::mm(depth)));
            text!("groove {} wide{}, clearance {}; ", Length::mm(*width), deep, Length::mm(*clearance))
        }
        _ => Text::default(),
    };
    let mut words = vec![text!("{}blank Ø{}", size, Length::mm(2.0 * blank_radius_mm))];
    words.extend(flanks.iter().filter_map(|flank| {
        let rolled = flank.rolling.as_ref()?;
        let (layer, arcs) = (flank.layer, flank.outline.as_ref()?.arcs);
        Some(text!(
            "{}: {} arcs, off the exact flank by {} where it is rolled on",
            layer,
            arcs,
            Length::mm(rolled.gap_mm.abs())
        ))
    }));
    words.extend(switches.iter().map(SwitchFigures::words));
    words
}

//! What the report says of a plate.

use super::Wedge;
use crate::body::disc::program::law_words;
use crate::body::{Body, CORNER_REACH, DrawingEvidence, Figures};
use crate::report::{Fact, Section, Topic, Weight, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Motion;
use camgen_kernel::motion::program::{EndClass, Program, SegmentSummary};
use camgen_kernel::numeric::extremum;
use camgen_kernel::text::{Length, LengthKind, Text, text};
use nalgebra::Vector2;
use serde::Serialize;

/// The section `cam`.
#[derive(Debug, Serialize)]
struct PlateSection {
    #[serde(skip_serializing_if = "Option::is_none")]
    roller_radius_mm: Option<f64>,
    max_lift_mm: f64,
    stroke_mm: f64,
    length_mm: f64,
    height_mm: f64,
    run_in_mm: f64,
    drive_angle_deg: f64,
    /// From the back to the flank.
    thinnest_mm: f64,
    thinnest_at_x_mm: f64,
    /// Largest, and largest of the other sign.
    pressure_angle_deg: [f64; 2],
    /// The shortest stroke that keeps the limits of the pressure angle with all lengths in proportion.
    shortest_stroke_mm: Option<f64>,
    #[serde(flatten)]
    weight: Weight,
}

/// Largest sizes on a segment by the travel in mm, and where; `None` of a jerk without bound.
#[derive(Debug, Serialize)]
struct Peaks {
    velocity_mm_per_mm: f64,
    velocity_at_x_mm: f64,
    acceleration_mm_per_mm2: f64,
    acceleration_at_x_mm: f64,
    jerk_mm_per_mm3: Option<f64>,
    jerk_at_x_mm: f64,
}

/// A segment; positions in mm.
#[derive(Debug, Serialize)]
struct SegmentFigures {
    law: &'static str,
    class: String,
    from_x_mm: f64,
    to_x_mm: f64,
    from: f64,
    to: f64,
    lowest: f64,
    highest: f64,
    overshoot: f64,
    peaks: Peaks,
    /// The shortest length of it that keeps the limits of the pressure angle.
    shortest_mm: Option<f64>,
    /// Of a spline or a table.
    #[serde(skip_serializing_if = "Option::is_none")]
    rows: Option<usize>,
}

/// The section `motion`.
#[derive(Debug, Serialize)]
struct MotionSection {
    unit: &'static str,
    stroke_mm: f64,
    segments: Vec<SegmentFigures>,
}

/// The sections of the report.
pub(super) fn sections(wedge: &Wedge, found: &DrawingEvidence<'_>) -> Vec<Section> {
    let part = found.drawn.and_then(|drawn| drawn.parts.first());
    // The corners of a plate's ends are intended.
    let reach = CORNER_REACH * found.tolerance_mm / MILLIMETRES;
    let corner = |point: Vector2<f64>| wedge.corner_within(point / MILLIMETRES, reach);
    let outline = part.map(|part| part.measures(found.tolerance_mm, corner).section());
    let mut weight = part.map(|part| part.weight(&wedge.machine)).unwrap_or_default();
    // A plate does not turn.
    weight.unbalance_g_mm = None;
    let mut sections = vec![cam(wedge, weight)];
    sections.extend(wedge.motion.program().map(|program| motion(wedge, program)));
    sections.push(outline.unwrap_or_else(|| Section::new("outline", &())));
    sections.push(Section::new("rolling", &found.rolled.first()));
    sections
}

fn cam(wedge: &Wedge, weight: Weight) -> Section {
    let (from, to) = wedge.stroke();
    let slopes = [1.0, -1.0].map(|way| wedge.largest(|piece, x| way * wedge.motion.jet(piece, x).ds).value.max(0.0));
    let shortest = wedge.shortest_share(slopes).map(|share| MILLIMETRES * share * (to - from));
    let value = PlateSection {
        roller_radius_mm: wedge.roller_radius().map(|radius| MILLIMETRES * radius),
        max_lift_mm: MILLIMETRES * wedge.max_lift(),
        stroke_mm: MILLIMETRES * (to - from),
        length_mm: MILLIMETRES * wedge.length(),
        height_mm: MILLIMETRES * wedge.height,
        run_in_mm: MILLIMETRES * wedge.run_in,
        drive_angle_deg: wedge.machine.cam.plate.drive_angle.to_degrees(),
        thinnest_mm: MILLIMETRES * wedge.thinnest.0,
        thinnest_at_x_mm: MILLIMETRES * wedge.thinnest.1,
        pressure_angle_deg: wedge.pressure_angles().map(|worst| worst.value.to_degrees()),
        shortest_stroke_mm: shortest,
        weight,
    };
    let follower = value
        .roller_radius_mm
        .map_or(Text::from("knife edge"), |radius| text!("roller Ø{}", Length::mm(2.0 * radius).rounded()));
    let inclined = if value.drive_angle_deg == 0.0 {
        String::new()
    } else {
        format!(", path inclined by {}°", shown(value.drive_angle_deg))
    };
    let size =
        text!("plate {} × {}", Length::mm(value.length_mm).rounded().bare(), Length::mm(value.height_mm).rounded());
    let lift =
        text!("lift {} over a stroke of {}", Length::mm(value.max_lift_mm).decimals(3), Length::mm(value.stroke_mm));
    let mut words = vec![
        text!(
            "{}, {} at its thinnest (x = {}), run-in {}, {}{}, {}",
            size.clone(),
            Length::mm(value.thinnest_mm).decimals(3),
            Length::mm(value.thinnest_at_x_mm).decimals(2),
            Length::mm(value.run_in_mm),
            follower.clone(),
            inclined,
            lift.clone()
        ),
        match shortest {
            Some(shortest) => text!("shortest stroke for the limit of the pressure angle {}", Length::mm(shortest)),
            None => "no stroke keeps the limit of the pressure angle on this inclined path".into(),
        },
    ];
    words.extend(value.weight.words());
    let figures: Vec<Text> = [text!("{}, {}", size, follower), lift].into_iter().chain(value.weight.figure()).collect();
    let follower = match value.roller_radius_mm {
        Some(radius) => text!("roller Ø{}", Length::mm(2.0 * radius).nominal()),
        None => "knife edge".into(),
    };
    let plate = text!(
        "plate {} × {}, {} at its thinnest, {}",
        Length::mm(value.length_mm).nominal().bare(),
        Length::mm(value.height_mm).nominal(),
        Length::mm(value.thinnest_mm).brief(),
        follower
    );
    let lift =
        text!("{} over a stroke of {}", Length::mm(value.max_lift_mm).brief(), Length::mm(value.stroke_mm).nominal());
    let facts = [Some(Fact::new(Topic::SIZE, plate)), value.weight.fact(), Some(Fact::new(Topic::LIFT, lift))];
    Section::new("cam", &value).with_words(words).with_figures(figures).with_facts(facts.into_iter().flatten())
}

fn motion(wedge: &Wedge, program: &Program) -> Section {
    let rows = |index: usize| program.rows().iter().find(|rows| rows.segment == Some(index)).map(|rows| rows.count);
    let all = program.segments().iter().enumerate();
    let segments: Vec<SegmentFigures> = all.map(|(index, summary)| segment(wedge, summary, rows(index))).collect();
    let mut words: Vec<Text> = segments.iter().map(line).collect();
    words.extend(program.rows().iter().flat_map(|rows| rows.told.iter().cloned().map(Text::from)));
    let (from, to) = wedge.stroke();
    let value = MotionSection { unit: "mm", stroke_mm: MILLIMETRES * (to - from), segments };
    Section::new("motion", &value).with_words(words).with_fact(Topic::MOTION, movements(&value.segments))
}

/// The segments one after the other.
fn movements(segments: &[SegmentFigures]) -> Text {
    let movement = |segment: &SegmentFigures| {
        let travel = segment.to - segment.from;
        if segment.peaks.velocity_mm_per_mm == 0.0 {
            return "dwell".into();
        }
        let word = if travel < 0.0 { "return" } else { "rise" };
        text!("{} {} {}", word, Length::mm(travel.abs()).nominal(), law_words(segment.law))
    };
    let all = segments.iter().enumerate().map(|(index, segment)| {
        let from =
            if index == 0 { text!("x = {} ", Length::mm(segment.from_x_mm).nominal().bare()) } else { Text::default() };
        text!("{}to {} {}", from, Length::mm(segment.to_x_mm).nominal(), movement(segment))
    });
    Text::joined(all, ", ")
}

/// The largest and the least slope between two places, m/m, the least as a positive number.
fn slopes(wedge: &Wedge, (from, to): (f64, f64)) -> [f64; 2] {
    let inside = |piece: &camgen_kernel::motion::Piece| {
        from <= 0.5 * (piece.start + piece.end) && 0.5 * (piece.start + piece.end) <= to
    };
    let pieces = wedge.motion.pieces().iter().enumerate().skip(1).filter(|(_, piece)| inside(piece));
    pieces.fold([0.0_f64; 2], |[rise, fall], (index, piece)| {
        let of = |x: f64| {
            let jet = wedge.motion.jet(index, x);
            [jet.ds, jet.dds, jet.ddds]
        };
        let cells = wedge.motion.cells(index);
        let [top, low] = extremum::largest_of_both_signs(of, (piece.start, piece.end), cells);
        [rise.max(top.value), fall.max(low.value)]
    })
}

fn segment(wedge: &Wedge, summary: &SegmentSummary, rows: Option<usize>) -> SegmentFigures {
    let [first, last] = summary.classes.map(EndClass::letter);
    let mm = |length: f64| MILLIMETRES * length;
    let [velocity, acceleration, jerk] = summary.peaks;
    let share = wedge.shortest_share(slopes(wedge, summary.angles));
    SegmentFigures {
        law: summary.law,
        class: format!("{first}-{last}"),
        from_x_mm: mm(summary.angles.0),
        to_x_mm: mm(summary.angles.1),
        from: mm(summary.positions.0),
        to: mm(summary.positions.1),
        lowest: mm(summary.range.0),
        highest: mm(summary.range.1),
        overshoot: mm(summary.overshoot),
        peaks: Peaks {
            velocity_mm_per_mm: velocity.0,
            velocity_at_x_mm: mm(velocity.1),
            acceleration_mm_per_mm2: acceleration.0 / MILLIMETRES,
            acceleration_at_x_mm: mm(acceleration.1),
            jerk_mm_per_mm3: Some(jerk.0 / (MILLIMETRES * MILLIMETRES)).filter(|jerk| jerk.is_finite()),
            jerk_at_x_mm: mm(jerk.1),
        },
        shortest_mm: share.map(|share| mm(share * (summary.angles.1 - summary.angles.0))),
        rows,
    }
}

fn line(segment: &SegmentFigures) -> Text {
    let SegmentFigures { law, class, from_x_mm, to_x_mm, from, to, overshoot, peaks, shortest_mm, rows, .. } = segment;
    let range = text!("x {} to {} {}", Length::mm(*from_x_mm).bare(), Length::mm(*to_x_mm), law);
    if peaks.velocity_mm_per_mm == 0.0 {
        return text!("{} at {}", range, Length::mm(*from));
    }
    let jerk = peaks
        .jerk_mm_per_mm3
        .map_or(Text::from(", j unbounded"), |jerk| text!(", j {}", Length::new(jerk, &LengthKind::MM_PER_MM3)));
    let through = rows.map_or(String::new(), |rows| format!(" through {rows} rows"));
    let mut words = text!(
        "{}{} {} from {} to {}: v {}, a {}{}",
        range,
        through,
        class,
        Length::mm(*from).bare(),
        Length::mm(*to),
        Length::new(peaks.velocity_mm_per_mm, &LengthKind::MM_PER_MM),
        Length::new(peaks.acceleration_mm_per_mm2, &LengthKind::MM_PER_MM2),
        jerk
    );
    if let Some(shortest) = shortest_mm {
        words += text!("; at least {} long for the pressure angle", Length::mm(*shortest));
    }
    if *overshoot > 0.0 {
        words += text!("; it overshoots its ends by {}", Length::mm(*overshoot));
    }
    words
}

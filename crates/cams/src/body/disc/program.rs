//! The section of the report on a motion program.

use super::Disc;
use crate::report::{Fact, Section, Topic, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::laws::optimum::{Objective, Optimum};
use camgen_kernel::motion::program::SegmentSummary;
use camgen_kernel::motion::program::rows::{RowFigures, Smoothing};
use camgen_kernel::motion::{Motion, Quantity};
use camgen_kernel::text::{DIGITS, Length, Text, Value, nominal, text};
use serde::Serialize;

/// A segment; positions in mm or degrees, rates by the cam angle in radians.
#[derive(Debug, Serialize)]
struct SegmentFigures {
    law: &'static str,
    class: String,
    from_deg: f64,
    to_deg: f64,
    from: f64,
    to: f64,
    /// Lowest and highest position on it.
    lowest: f64,
    highest: f64,
    overshoot: f64,
    #[serde(flatten)]
    optimum: Option<OptimumFigures>,
    peaks: Peaks,
    /// Of a spline or a table.
    #[serde(skip_serializing_if = "Option::is_none")]
    rows: Option<RowsSection>,
}

/// A polynomial that minimises a quantity.
#[derive(Debug, Serialize)]
struct OptimumFigures {
    degree: u32,
    minimise: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    ratio: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    robust: Option<bool>,
}

impl OptimumFigures {
    fn of(optimum: &Optimum) -> Self {
        let (ratio, robust) = if let Objective::Residual { ratio, robust } = optimum.least {
            (Some(ratio), Some(robust))
        } else {
            (None, None)
        };
        Self { degree: optimum.degree, minimise: optimum.least.name(), ratio, robust }
    }

    /// Behind the name of the law.
    fn words(&self) -> String {
        let ratio = self.ratio.map_or(String::new(), |ratio| format!(" at the ratio {}", shown(ratio)));
        let robust = if self.robust == Some(true) { ", robust" } else { "" };
        format!(" of degree {} with the least {}{ratio}{robust}", self.degree, self.minimise)
    }
}

/// Largest sizes and where they are; `None` of a jerk without bound.
#[derive(Debug, Serialize)]
struct Peaks {
    velocity: f64,
    velocity_at_deg: f64,
    acceleration: f64,
    acceleration_at_deg: f64,
    jerk: Option<f64>,
    jerk_at_deg: f64,
    /// By time, m or rad per second.
    #[serde(skip_serializing_if = "Option::is_none")]
    velocity_per_s: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    acceleration_per_s2: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    jerk_per_s3: Option<f64>,
}

/// The section `motion`.
#[derive(Debug, Serialize)]
struct MotionSection {
    unit: &'static str,
    /// Of rates by the time, where the speed is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    unit_by_time: Option<&'static str>,
    repeat: u32,
    segments: Vec<SegmentFigures>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rows: Option<RowsSection>,
}

/// A curve through rows; lengths in the unit of the section.
#[derive(Debug, Serialize)]
struct RowsSection {
    count: usize,
    spacing_deg: f64,
    dwells_deg: Vec<[f64; 2]>,
    overshoot: f64,
    overshoot_at_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    rounding: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    smoothing: Option<SmoothingFigures>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    read: Vec<String>,
}

/// How rows were smoothed.
#[derive(Debug, Serialize)]
struct SmoothingFigures {
    bound: f64,
    largest: f64,
    rms: f64,
}

impl RowsSection {
    fn of(rows: &RowFigures, size: f64) -> Self {
        Self {
            count: rows.count,
            spacing_deg: degrees(rows.spacing),
            dwells_deg: rows.dwells.iter().map(|(from, to)| [degrees(*from), degrees(*to)]).collect(),
            overshoot: size * rows.overshoot.0,
            overshoot_at_deg: degrees(rows.overshoot.1),
            rounding: (rows.rounding > 0.0).then_some(size * rows.rounding),
            smoothing: rows.smoothing.map(|Smoothing { bound, largest, rms }| SmoothingFigures {
                bound: size * bound,
                largest: size * largest,
                rms: size * rms,
            }),
            read: rows.told.clone(),
        }
    }

    fn words(&self, unit: &str) -> Vec<Text> {
        let mut words = vec![text!("{} rows, usually {}° apart", self.count, shown(self.spacing_deg))];
        if !self.dwells_deg.is_empty() {
            let all: Vec<String> =
                self.dwells_deg.iter().map(|[from, to]| format!("{} to {}°", shown(*from), shown(*to))).collect();
            words.push(text!("equal rows are kept as dwells: {}", all.join(", ")));
        }
        if let Some(SmoothingFigures { bound, largest, rms }) = &self.smoothing {
            let text = if *bound > 0.0 {
                text!(
                    "smoothed within {} of each row: largest deviation {}, rms {}",
                    Value::with_unit(*bound, unit),
                    Value::before_unit(*largest, unit),
                    Value::with_unit(*rms, unit)
                )
            } else {
                "not smoothed: no rounding is seen in the digits of the rows".into()
            };
            words.push(text);
        }
        words.extend(self.read.iter().cloned().map(Text::from));
        words
    }

    /// Of a segment only what is not as its rows say.
    fn words_of_segment(&self, unit: &str) -> Vec<Text> {
        let usual = self.smoothing.is_none() && self.dwells_deg.is_empty();
        if usual { Vec::new() } else { self.words(unit) }
    }
}

/// A position of less than this share of the travel is 0.
const ROUNDING: f64 = 1e-12;

/// Degrees without the rounding of the conversion.
pub(super) fn degrees(angle: f64) -> f64 {
    const DIGITS: f64 = 1e11;
    (angle.to_degrees() * DIGITS).round() / DIGITS + 0.0
}

/// A segment with its lengths or angles in a size, at an angular speed of the cam, rad/s, where that is known.
fn segment(summary: &SegmentSummary, size: f64, speed: Option<f64>) -> SegmentFigures {
    let [first, last] = summary.classes.map(camgen_kernel::motion::program::EndClass::letter);
    let [velocity, acceleration, jerk] = summary.peaks.map(|(value, at)| (size * value, degrees(at)));
    let by_time = |order: usize, power: i32| {
        let value = summary.peaks.get(order).map(|peak| peak.0).filter(|value| value.is_finite());
        value.zip(speed).map(|(value, speed)| value * speed.powi(power))
    };
    SegmentFigures {
        law: summary.law,
        class: format!("{first}-{last}"),
        from_deg: degrees(summary.angles.0),
        to_deg: degrees(summary.angles.1),
        from: size * summary.positions.0,
        to: size * summary.positions.1,
        lowest: size * summary.range.0,
        highest: size * summary.range.1,
        overshoot: size * summary.overshoot,
        optimum: summary.optimum.as_ref().map(OptimumFigures::of),
        peaks: Peaks {
            velocity: velocity.0,
            velocity_at_deg: velocity.1,
            acceleration: acceleration.0,
            acceleration_at_deg: acceleration.1,
            jerk: Some(jerk.0).filter(|jerk| jerk.is_finite()),
            jerk_at_deg: jerk.1,
            velocity_per_s: by_time(0, 1),
            acceleration_per_s2: by_time(1, 2),
            jerk_per_s3: by_time(2, 3),
        },
        rows: None,
    }
}

impl Disc {
    /// The segments of its program, where its motion is one.
    pub(super) fn program(&self) -> Option<Section> {
        of_motion(&*self.motion, self.speed)
    }
}

/// The segments of the program of a motion, where it is one, with the rates by the time at a speed of the cam, rad/s.
pub(in crate::body) fn of_motion(motion: &dyn Motion, speed: Option<f64>) -> Option<Section> {
    let program = motion.program()?;
    let swings = motion.quantity() == Quantity::Angle;
    let (unit, size) = if swings { ("deg", 1.0_f64.to_degrees()) } else { ("mm", MILLIMETRES) };
    let summary = program.segments();
    let mut segments: Vec<SegmentFigures> = summary.iter().map(|summary| segment(summary, size, speed)).collect();
    let mut words: Vec<Text> =
        segments.iter().zip(summary).map(|(segment, summary)| line(segment, summary, unit)).collect();
    let of_time = if swings { "rad" } else { "m" };
    words.extend(at_speed(&segments, of_time));
    if motion.lobes() > 1 {
        words.push(text!("{} equal lobes", motion.lobes()));
    }
    if let Some(load) = program.load() {
        words.push(text!(
            "for an elastic load, cam speed over natural frequency {}, damping {}: these are the figures of the cam, and the \
                program of the file is that of the load",
            shown(load.ratio),
            shown(load.damping)
        ));
    }
    let unit_by_time = speed.map(|_| of_time);
    let mut rows = None;
    for found in program.rows() {
        let section = RowsSection::of(found, size);
        let Some(index) = found.segment else {
            words.extend(section.words(unit));
            rows = Some(section);
            continue;
        };
        let of_segment = section.words_of_segment(unit);
        words.extend(of_segment.into_iter().map(|text| text!("segment {}: {}", index + 1, text)));
        if let Some(segment) = segments.get_mut(index) {
            segment.rows = Some(section);
        }
    }
    let value = MotionSection { unit, unit_by_time, repeat: motion.lobes(), segments, rows };
    let facts = facts(&value.segments, summary, unit, of_time);
    Some(Section::new("motion", &value).with_words(words).with_facts(facts))
}

/// Segments that a summary names one by one.
const MOST_NAMED: usize = 6;
/// Those that it names of more.
const NAMED_OF_MORE: usize = 4;

/// The segments one after the other, and the largest rates by the time.
fn facts(segments: &[SegmentFigures], summary: &[SegmentSummary], unit: &str, of_time: &str) -> Vec<Fact> {
    let named = if segments.len() > MOST_NAMED { NAMED_OF_MORE } else { segments.len() };
    let degrees = |angle: f64| nominal(angle, DIGITS);
    let mut told: Vec<Text> = segments
        .iter()
        .zip(summary)
        .take(named)
        .enumerate()
        .map(|(index, (segment, summary))| {
            let from = if index == 0 { format!("{}° ", degrees(segment.from_deg)) } else { String::new() };
            text!("{}to {}° {}", from, degrees(segment.to_deg), movement(segment, summary, unit))
        })
        .collect();
    if named < segments.len() {
        told.push(text!("and {} more segments (-v)", segments.len() - named));
    }
    let motion = Fact::new(Topic::MOTION, Text::joined(told, ", "));
    let peaks = peaks_by_time(segments).map(|peaks| {
        let brief = |value: f64, unit: &str| Value::brief(value, &format!("{of_time}{unit}"));
        let jerk = peaks.jerk.map_or("no limit of the jerk".into(), |jerk| brief(jerk, "/s³"));
        text!("{}, {}, {}", brief(peaks.velocity, "/s"), brief(peaks.acceleration, "/s²"), jerk)
    });
    std::iter::once(motion).chain(peaks.map(|peaks| Fact::new(Topic::PEAKS, peaks))).collect()
}

/// "rise 20° modified sine", "dwell".
fn movement(segment: &SegmentFigures, summary: &SegmentSummary, unit: &str) -> Text {
    if summary.peaks[0].0 == 0.0 {
        return "dwell".into();
    }
    let law = law_words(segment.law);
    let travel = segment.to - segment.from;
    let (word, travel) = if summary.whole {
        ("travel", segment.highest - segment.lowest)
    } else if travel < 0.0 {
        ("return", -travel)
    } else {
        ("rise", travel)
    };
    let travel = if unit == "deg" {
        Text::from(format!("{}°", nominal(travel, DIGITS)))
    } else {
        Value::from(Length::mm(travel).nominal()).into()
    };
    text!("{} {} {}", word, travel, law)
}

/// The name of a law in words: "modified sine", but "3-4-5".
pub(in crate::body) fn law_words(name: &str) -> String {
    if name.starts_with(|first: char| first.is_ascii_digit()) { name.to_owned() } else { name.replace('-', " ") }
}

/// The largest rates by the time, m or rad per second, of all segments.
struct PeaksByTime {
    velocity: f64,
    acceleration: f64,
    /// `None` where it has no bound.
    jerk: Option<f64>,
}

fn peaks_by_time(segments: &[SegmentFigures]) -> Option<PeaksByTime> {
    let most =
        |of: fn(&Peaks) -> Option<f64>| segments.iter().filter_map(|segment| of(&segment.peaks)).reduce(f64::max);
    let unbounded = segments.iter().any(|segment| segment.peaks.jerk.is_none());
    Some(PeaksByTime {
        velocity: most(|peaks| peaks.velocity_per_s)?,
        acceleration: most(|peaks| peaks.acceleration_per_s2)?,
        jerk: most(|peaks| peaks.jerk_per_s3).filter(|_| !unbounded),
    })
}

/// The largest rates by the time.
fn at_speed(segments: &[SegmentFigures], unit: &str) -> Option<Text> {
    let PeaksByTime { velocity, acceleration, jerk } = peaks_by_time(segments)?;
    let jerk = jerk.map_or("unbounded".into(), |jerk| Value::with_unit(jerk, &format!("{unit}/s³")));
    Some(text!(
        "at this speed at most v {}, a {}, j {}",
        Value::with_unit(velocity, &format!("{unit}/s")),
        Value::with_unit(acceleration, &format!("{unit}/s²")),
        jerk
    ))
}

fn line(segment: &SegmentFigures, summary: &SegmentSummary, unit: &str) -> Text {
    let SegmentFigures { law, class, from_deg, to_deg, from, to, overshoot, optimum, peaks, .. } = segment;
    let least = optimum.as_ref().map_or(String::new(), OptimumFigures::words);
    let law = format!("{} to {}° {law}{least}", shown(*from_deg), shown(*to_deg));
    if summary.peaks[0].0 == 0.0 {
        return text!("{} at {}", law, Value::with_unit(*from, unit));
    }
    let positions = if summary.whole {
        let size = if unit == "deg" { 1.0_f64.to_degrees() } else { MILLIMETRES };
        let (low, high) = summary.range;
        // A place that is 0 but for rounding is shown as 0.
        let [low, high] = [low, high].map(|at| if at.abs() > ROUNDING * (high - low) { size * at } else { 0.0 });
        text!("between {} and {}", Value::before_unit(low, unit), Value::with_unit(high, unit))
    } else {
        text!("{} from {} to {}", class, Value::before_unit(*from, unit), Value::with_unit(*to, unit))
    };
    // Rates of an angle are per radian in radians, as everywhere else.
    let (of_rate, size) = if unit == "deg" { ("rad", 1.0_f64.to_radians()) } else { (unit, 1.0) };
    let mut words = text!(
        "{} {}: v {}, a {}, j {}",
        law,
        positions,
        Value::with_unit(size * peaks.velocity, &format!("{of_rate}/rad")),
        Value::with_unit(size * peaks.acceleration, &format!("{of_rate}/rad²")),
        peaks.jerk.map_or("unbounded".into(), |jerk| Value::with_unit(size * jerk, &format!("{of_rate}/rad³")))
    );
    if *overshoot > 0.0 {
        words += text!("; it overshoots its ends by {}", Value::with_unit(*overshoot, unit));
    }
    if summary.humps {
        words += text!(
            "; its acceleration has two humps of one sign: another inflection or law = \"polynomial\" avoids that"
        );
    }
    words
}

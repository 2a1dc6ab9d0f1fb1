//! What the report tells of a motion program.

use super::Disc;
use crate::geometry::MILLIMETRES;
use crate::motion::Quantity;
use crate::motion::laws::optimum::{Least, Optimum};
use crate::motion::program::SegmentTold;
use crate::report::{Section, shown};
use serde::Serialize;

/// A segment; positions in mm or degrees, rates by the cam angle in radians.
#[derive(Debug, Serialize)]
struct Segment {
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
    optimum: Option<Optimal>,
    peaks: Peaks,
}

/// Of a polynomial that makes something least.
#[derive(Debug, Serialize)]
struct Optimal {
    degree: u32,
    minimise: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    ratio: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    robust: Option<bool>,
}

impl Optimal {
    fn of(optimum: &Optimum) -> Self {
        let (ratio, robust) = if let Least::Residual { ratio, robust } = optimum.least {
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
    /// By the time, m or rad per second.
    #[serde(skip_serializing_if = "Option::is_none")]
    velocity_per_s: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    acceleration_per_s2: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    jerk_per_s3: Option<f64>,
}

/// The section `motion`.
#[derive(Debug, Serialize)]
struct Told {
    unit: &'static str,
    /// Of rates by the time, where the speed is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    unit_by_time: Option<&'static str>,
    repeat: u32,
    segments: Vec<Segment>,
}

/// A position of less than this share of the travel is 0.
const ROUNDING: f64 = 1e-12;

/// Degrees without the rounding of the conversion.
pub(super) fn degrees(angle: f64) -> f64 {
    const DIGITS: f64 = 1e11;
    (angle.to_degrees() * DIGITS).round() / DIGITS + 0.0
}

/// A segment with its lengths or angles in a size, at an angular speed of the cam, rad/s, where that is known.
fn segment(told: &SegmentTold, size: f64, speed: Option<f64>) -> Segment {
    let [first, last] = told.classes.map(crate::motion::program::Class::letter);
    let [velocity, acceleration, jerk] = told.peaks.map(|(value, at)| (size * value, degrees(at)));
    let by_time = |order: usize, power: i32| {
        let value = told.peaks.get(order).map(|peak| peak.0).filter(|value| value.is_finite());
        value.zip(speed).map(|(value, speed)| value * speed.powi(power))
    };
    Segment {
        law: told.law,
        class: format!("{first}-{last}"),
        from_deg: degrees(told.angles.0),
        to_deg: degrees(told.angles.1),
        from: size * told.positions.0,
        to: size * told.positions.1,
        lowest: size * told.range.0,
        highest: size * told.range.1,
        overshoot: size * told.overshoot,
        optimum: told.optimum.as_ref().map(Optimal::of),
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
    }
}

impl Disc {
    /// The segments of its program, where its motion is one.
    pub(super) fn program(&self) -> Option<Section> {
        let program = self.motion.program()?;
        let swings = self.motion.quantity() == Quantity::Angle;
        let (unit, size) = if swings { ("deg", 1.0_f64.to_degrees()) } else { ("mm", MILLIMETRES) };
        let told = program.segments();
        let segments: Vec<Segment> = told.iter().map(|told| segment(told, size, self.speed)).collect();
        let mut words: Vec<String> =
            segments.iter().zip(told).map(|(segment, told)| line(segment, told, unit)).collect();
        let of_time = if swings { "rad" } else { "m" };
        words.extend(at_speed(&segments, of_time));
        if self.motion.lobes() > 1 {
            words.push(format!("{} equal lobes", self.motion.lobes()));
        }
        if let Some(load) = program.load() {
            words.push(format!(
                "for an elastic load, cam speed over natural {} and damping {}: the cam as told, the load as the file gives it",
                shown(load.ratio),
                shown(load.damping)
            ));
        }
        let unit_by_time = self.speed.map(|_| of_time);
        let value = Told { unit, unit_by_time, repeat: self.motion.lobes(), segments };
        Some(Section::new("motion", &value).with_words(words))
    }
}

/// The largest rates by the time.
fn at_speed(segments: &[Segment], unit: &str) -> Option<String> {
    let most =
        |of: fn(&Peaks) -> Option<f64>| segments.iter().filter_map(|segment| of(&segment.peaks)).reduce(f64::max);
    let (velocity, acceleration) = (most(|peaks| peaks.velocity_per_s)?, most(|peaks| peaks.acceleration_per_s2)?);
    let unbounded = segments.iter().any(|segment| segment.peaks.jerk.is_none());
    let jerk = most(|peaks| peaks.jerk_per_s3).filter(|_| !unbounded);
    let jerk = jerk.map_or("without bound".to_owned(), |jerk| format!("{} {unit}/s³", shown(jerk)));
    Some(format!(
        "at this speed v to {} {unit}/s, a to {} {unit}/s², j {jerk} at the most",
        shown(velocity),
        shown(acceleration)
    ))
}

fn line(segment: &Segment, told: &SegmentTold, unit: &str) -> String {
    let Segment { law, class, from_deg, to_deg, from, to, overshoot, optimum, peaks, .. } = segment;
    let least = optimum.as_ref().map_or(String::new(), Optimal::words);
    let mut text = format!("{} to {}° {law}{least}", shown(*from_deg), shown(*to_deg));
    if told.peaks[0].0 == 0.0 {
        return format!("{text} at {} {unit}", shown(*from));
    }
    let positions = if told.whole {
        let size = if unit == "deg" { 1.0_f64.to_degrees() } else { MILLIMETRES };
        let (low, high) = told.range;
        // A place that is 0 but for rounding is told as 0.
        let [low, high] = [low, high].map(|at| if at.abs() > ROUNDING * (high - low) { size * at } else { 0.0 });
        format!("between {} and {}", shown(low), shown(high))
    } else {
        format!("{class} from {} to {}", shown(*from), shown(*to))
    };
    text.push_str(&format!(
        " {positions} {unit}: v {} {unit}/rad, a {} {unit}/rad²",
        shown(peaks.velocity),
        shown(peaks.acceleration)
    ));
    text.push_str(&peaks.jerk.map_or(", j without bound".into(), |jerk| format!(", j {} {unit}/rad³", shown(jerk))));
    if *overshoot > 0.0 {
        text.push_str(&format!("; it goes {} {unit} beyond its ends", shown(*overshoot)));
    }
    if told.humps {
        text.push_str(
            "; its acceleration has two humps of one sign: another inflection or law = \"polynomial\" avoids that",
        );
    }
    text
}

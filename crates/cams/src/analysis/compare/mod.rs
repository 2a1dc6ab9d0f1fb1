//! A measured cam, compared with the exact one: deviations along the normal, the angle and the centre with which they agree best, what remains, what
//! the follower feels of it, and the waviness.

mod fit;
pub mod measured;

use super::{Analysis, Picture};
use crate::body::part_tolerance::PartTolerance;
use crate::body::{Body, Cut, Kind};
use crate::check::{Check, CheckExplanation, CheckScope, Measure};
use crate::report::plot::{Plot, PlotBand, PlotCurve, PlotPanel, PlotPoint, figure};
use crate::report::{Bound, Place, Section, Verdict, sha256, shown};
use crate::table::{ListedColumn, Table};
use camgen_kernel::document::{Input, cams};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Quantity;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{Length, LengthKind, Text, text};
pub use fit::ComparisonFit;
use fit::{ExactProfile, MeasuredMove, MeasuredPlace, covers, harmonics, highest_order, polar};
use nalgebra::Vector2;
use serde::Serialize;
use std::f64::consts::TAU;

/// The comparison.
pub const KIND: Kind = Kind { command: "compare", noun: "comparison of a measured cam", keys: cams::MAKE };

/// The check.
pub const DEVIATION: Check = Check {
    name: "profile_deviation",
    on: CheckScope::Analysis,
    unit: "mm",
    about: "The largest distance of a measured point from the exact profile along its normal, after the angle and, where asked for, the centre were fitted.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |distance of the point from the profile − radius of the ball|",
        usual: "half of cam.profile_tolerance, the zone of ISO 1101; half of 0.04 mm, customary for a milled profile, without it",
        change: "the part: grind it again, or permit a wider cam.profile_tolerance",
    },
};

/// Places at which the acceleration of the error is searched.
const PLACES: u32 = 1440;

/// How a cam was measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ComparisonOptions {
    /// Radius of the ball whose centres the points are, m; 0 where they lie on the profile.
    pub ball: f64,
    /// What may be moved.
    pub fit: ComparisonFit,
}

/// The section of the report.
#[derive(Debug, Serialize)]
struct Comparison {
    points: usize,
    ball_radius_mm: f64,
    /// By which the measured points were turned and shifted.
    turn_deg: f64,
    shift_mm: [f64; 2],
    /// Positive where there is too much metal.
    mean_mm: f64,
    rms_mm: f64,
    lowest_mm: f64,
    highest_mm: f64,
    /// Highest less lowest.
    form_error_mm: f64,
    largest_lift_error_mm: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    largest_acceleration_error_mm_per_rad2: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    largest_acceleration_error_m_per_s2: Option<f64>,
    /// Amplitudes of the deviation by the polar angle on the part, from the first order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    waviness_mm: Vec<f64>,
}

/// A point of the table.
struct PointRow {
    number: f64,
    place: MeasuredPlace,
    /// Before anything was fitted.
    raw: f64,
}

const COLUMNS: &[ListedColumn<PointRow>] = &[
    ("point", |row| row.number),
    ("x_mm", |row| row.place.point.x),
    ("y_mm", |row| row.place.point.y),
    ("polar_deg", |row| polar(row.place.foot).to_degrees()),
    ("cam_deg", |row| row.place.angle.to_degrees()),
    ("raw_deviation_mm", |row| row.raw),
    ("deviation_mm", |row| row.place.deviation),
    ("lift_error_mm", |row| row.place.lift),
];

/// Compares points (mm) that were measured on a cut of a body with its exact profile.
///
/// # Errors
/// [`Refusal`] when the body has no such profile, or no point can be placed on it.
pub fn analysis(
    body: &dyn Body,
    cut: &Cut<'_>,
    points: &[Vector2<f64>],
    options: ComparisonOptions,
) -> Result<Analysis, Refusal> {
    let no_profile = || {
        let noun = body.kind().noun;
        Refusal::new(format!("a {noun} has no profile about a shaft with which points are compared"))
            .remedy("give the design of a disc, a ring, a groove or a rib")
    };
    let exact = ExactProfile::new(cut, MILLIMETRES * options.ball).map_err(Refusal::of)?.ok_or_else(no_profile)?;
    let moved = exact.fitted(points, options.fit);
    refuse_other_frame(&exact, points, &moved)?;
    let rows = rows(&exact, points, &moved);
    if rows.is_empty() {
        return Err(
            Refusal::new("no measured point lies on the profile").remedy("give points in millimetres about the shaft")
        );
    }
    let by_polar: Vec<(f64, f64)> = rows.iter().map(|row| (polar(row.place.foot), row.place.deviation)).collect();
    let by_angle: Vec<(f64, f64)> = rows.iter().map(|row| (row.place.angle, row.place.lift)).collect();
    let waves = covers(&by_polar).then(|| harmonics(&by_polar, highest_order(&by_polar))).flatten().unwrap_or_default();
    let felt = covers(&by_angle).then(|| harmonics(&by_angle, highest_order(&by_angle))).flatten();
    let section = section(body, (&rows, options.ball), &moved, (&waves, felt.as_deref()));
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(body.machine().inputs(body.kind().keys));
    let lines: Vec<String> = points.iter().map(|point| format!("{} {}", point.x, point.y)).collect();
    inputs.push(Input::word("points", sha256(lines.join("\n").as_bytes())));
    inputs.push(Input::quantity("ball", options.ball, ("mm", 1e-3)));
    inputs.push(Input::word("fit", word(options.fit)));
    Ok(Analysis {
        kind: &KIND,
        variant: "",
        machine: body.machine().name().to_owned(),
        speeds: body.speeds(),
        inputs,
        measures: vec![measure(body, &rows, covers(&by_polar))],
        notes: if waves.is_empty() { vec![PART_OF_TURN.to_owned()] } else { Vec::new() },
        tables: vec![("", Table::listed(COLUMNS, &rows))],
        by: &[],
        along: "polar_deg",
        picture: Picture::Curves(plot(body, &rows, &moved, &waves)),
        mechanism: None,
        document: None,
        diagrams: &[],
        not_modelled: Vec::new(),
        sections: vec![section],
    })
}

/// Rms deviation above which other frames are tried, mm; the largest ratio of rms in another frame to rms as read that refuses the points.
const OFF: f64 = 0.02;
const BETTER: f64 = 0.2;
/// Largest number of points compared.
const LOOKED: usize = 720;
/// Micrometres in a millimetre.
const MICROMETRES: f64 = 1e3;
/// Millimetres in an inch.
const INCH: f64 = 25.4;

/// A wrong unit or mirror image of the points.
struct OtherFrame {
    /// Factors of x and y.
    by: Vector2<f64>,
    what: &'static str,
    remedy: &'static str,
}

const OTHER_FRAMES: [OtherFrame; 5] = [
    OtherFrame {
        by: Vector2::new(1.0, -1.0),
        what: "the mirror image of this cam",
        remedy: "negate y of the points, or set cam.rotation to the other direction in the file",
    },
    OtherFrame {
        by: Vector2::new(INCH, INCH),
        what: "this cam in inches",
        remedy: "name the columns x_in and y_in, or angle_deg and radius_in",
    },
    OtherFrame {
        by: Vector2::new(INCH, -INCH),
        what: "the mirror image of this cam in inches",
        remedy: "name the columns x_in and y_in, and negate y of the points",
    },
    OtherFrame {
        by: Vector2::new(1.0 / INCH, 1.0 / INCH),
        what: "this cam in millimetres, read as inches",
        remedy: "name the columns x_mm and y_mm, or angle_deg and radius_mm",
    },
    OtherFrame {
        by: Vector2::new(1.0 / INCH, -1.0 / INCH),
        what: "the mirror image of this cam in millimetres, read as inches",
        remedy: "name the columns x_mm and y_mm, and negate y of the points",
    },
];

/// Refuses points of the cam in another unit, or of its mirror image.
fn refuse_other_frame(exact: &ExactProfile<'_>, points: &[Vector2<f64>], moved: &MeasuredMove) -> Result<(), Refusal> {
    let every = points.len().div_ceil(LOOKED).max(1);
    let looked: Vec<Vector2<f64>> = points.iter().step_by(every).copied().collect();
    let found = rms(exact, &looked, moved);
    if found <= OFF {
        return Ok(());
    }
    // Turned points of a symmetric cam would also fit its mirror image.
    let turned = rms(exact, &looked, &exact.fitted(&looked, ComparisonFit::Angle)).min(found);
    if turned <= OFF {
        return Ok(());
    }
    let mut nearest: Option<(&OtherFrame, f64)> = None;
    for frame in &OTHER_FRAMES {
        let other: Vec<Vector2<f64>> = looked.iter().map(|point| point.component_mul(&frame.by)).collect();
        let best = rms(exact, &other, &exact.fitted(&other, ComparisonFit::Angle));
        // Of a mirror image in another unit the unit alone makes much of the error: a later frame is taken where it is clearly better.
        if best < BETTER * nearest.map_or(turned, |(_, before)| before) {
            nearest = Some((frame, best));
        }
    }
    let Some((frame, best)) = nearest else { return Ok(()) };
    let (best, found) = (shown(best), shown(found));
    let what = format!("the points are {}: they are {best} mm rms off it, and {found} mm as they are read", frame.what);
    Err(Refusal::new(what).remedy(frame.remedy))
}

/// Rms deviation of moved points, mm; a point without a foot on the profile counts with its radius.
fn rms(exact: &ExactProfile<'_>, points: &[Vector2<f64>], moved: &MeasuredMove) -> f64 {
    let off = |point: &Vector2<f64>| exact.place(moved.of(*point)).map_or(point.norm(), |place| place.deviation);
    let squares: f64 = points.iter().map(|point| off(point).powi(2)).sum();
    #[expect(clippy::cast_precision_loss, reason = "few points")]
    let count = points.len().max(1) as f64;
    (squares / count).sqrt()
}

/// The note on points that leave a part of the turn out.
const PART_OF_TURN: &str = "the points leave a part of the turn out: waviness is not found";

/// The name of a fit on the command line.
const fn word(fit: ComparisonFit) -> &'static str {
    match fit {
        ComparisonFit::Nothing => "none",
        ComparisonFit::Angle => "angle",
        ComparisonFit::Centre => "centre",
    }
}

impl camgen_kernel::document::NamedChoice for ComparisonFit {
    const ALL: &'static [(&'static str, Self)] =
        &[("angle", Self::Angle), ("centre", Self::Centre), ("center", Self::Centre), ("none", Self::Nothing)];
}

/// The points by their polar angle on the part.
fn rows(exact: &ExactProfile<'_>, points: &[Vector2<f64>], moved: &MeasuredMove) -> Vec<PointRow> {
    let mut rows = Vec::new();
    for (index, point) in points.iter().enumerate() {
        let Some(place) = exact.place(moved.of(*point)) else { continue };
        let raw = exact.place(*point).map_or(f64::NAN, |place| place.deviation);
        #[expect(clippy::cast_precision_loss, reason = "few points")]
        rows.push(PointRow { number: (index + 1) as f64, place, raw });
    }
    rows.sort_by(|a, b| polar(a.place.foot).total_cmp(&polar(b.place.foot)));
    rows
}

fn measure(body: &dyn Body, rows: &[PointRow], round: bool) -> Measure {
    let worst = rows.iter().max_by(|a, b| a.place.deviation.abs().total_cmp(&b.place.deviation.abs()));
    let (value, at) = worst.map_or((f64::NAN, 0.0), |row| (row.place.deviation, row.place.angle));
    let tolerance = PartTolerance::of(body);
    let limit = tolerance.half_mm();
    let measure = DEVIATION.measure(value.abs(), Some(limit));
    let what = if value > 0.0 { "too much metal there" } else { "too little metal there" };
    let note = match tolerance.proposed_from {
        None => Text::from(what),
        Some(from) => text!("{}; the limit is proposed ({}): cam.profile_tolerance gives another", what, from),
    };
    let assumed = tolerance.proposed_from.map_or_else(Text::default, Text::from);
    let measure = measure.assuming(assumed);
    let kept = value.abs() <= limit;
    // A few places of a cam do not show that it is right.
    let measure = if kept && !round { measure.judged(Verdict::Warn) } else { measure };
    let note = if round { note } else { note.and("; ", "the points leave a part of the turn out") };
    measure.placed(Place::at_angle(at)).noted(note)
}

/// The amplitude of a harmonic.
fn amplitude([cos, sin]: &[f64; 2]) -> f64 {
    libm::hypot(*cos, *sin)
}

/// The largest second derivative by the angle of a sum of harmonics.
fn largest_second(felt: &[[f64; 2]]) -> f64 {
    let at = |i: u32| {
        let angle = TAU * f64::from(i) / f64::from(PLACES);
        let of = |(k, [cos, sin]): (usize, &[f64; 2])| {
            #[expect(clippy::cast_precision_loss, reason = "a few dozen orders")]
            let k = k as f64;
            let (s, c) = libm::sincos(k * angle);
            -k * k * (cos * c + sin * s)
        };
        felt.iter().enumerate().map(of).sum::<f64>().abs()
    };
    (0..PLACES).map(at).fold(0.0, f64::max)
}

fn section(
    body: &dyn Body,
    (rows, ball): (&[PointRow], f64),
    moved: &MeasuredMove,
    (waves, felt): (&[[f64; 2]], Option<&[[f64; 2]]>),
) -> Section {
    let deviations = || rows.iter().map(|row| row.place.deviation);
    #[expect(clippy::cast_precision_loss, reason = "few points")]
    let count = rows.len() as f64;
    let (lowest, highest) =
        deviations().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), next| (low.min(next), high.max(next)));
    let second = felt.map(largest_second);
    let turn = moved.turn.to_degrees().rem_euclid(360.0);
    let value = Comparison {
        points: rows.len(),
        ball_radius_mm: MILLIMETRES * ball,
        turn_deg: if turn > 180.0 { turn - 360.0 } else { turn },
        shift_mm: [moved.shift.x, moved.shift.y],
        mean_mm: deviations().sum::<f64>() / count,
        rms_mm: (deviations().map(|value| value * value).sum::<f64>() / count).sqrt(),
        lowest_mm: lowest,
        highest_mm: highest,
        form_error_mm: highest - lowest,
        largest_lift_error_mm: rows.iter().map(|row| row.place.lift.abs()).fold(0.0, f64::max),
        largest_acceleration_error_mm_per_rad2: second,
        largest_acceleration_error_m_per_s2: second
            .zip(body.shaft_speed())
            .map(|(second, speed)| second * speed * speed / MILLIMETRES),
        waviness_mm: waves.iter().skip(1).map(amplitude).collect(),
    };
    let words = words(body, &value);
    Section::new("comparison", &value).with_words(words)
}

fn words(body: &dyn Body, found: &Comparison) -> Vec<Text> {
    let mut words = vec![
        text!(
            "{} points, turned by {}° and shifted by {} and {} to fit",
            found.points,
            shown(found.turn_deg),
            Length::mm(found.shift_mm[0]).bare(),
            Length::mm(found.shift_mm[1])
        ),
        text!(
            "deviation from {} to {}, form error {}, mean {}, rms {}",
            Length::mm(found.lowest_mm).bare(),
            Length::mm(found.highest_mm),
            Length::mm(found.form_error_mm),
            Length::mm(found.mean_mm),
            Length::mm(found.rms_mm)
        ),
    ];
    let swings = crate::body::curves(body).is_some_and(|curves| curves.motion.quantity() == Quantity::Angle);
    let along = if swings { "along the arc of the roller" } else { "along its path" };
    let by_time =
        found.largest_acceleration_error_m_per_s2.map(|value| text!(", {}", Length::new(value, &LengthKind::M_PER_S2)));
    let acceleration = found
        .largest_acceleration_error_mm_per_rad2
        .map(|value| text!("; acceleration off by {}{}", Length::new(value, &LengthKind::MM_PER_RAD2), by_time));
    words.push(text!(
        "the follower is off by up to {} {}{}",
        Length::mm(found.largest_lift_error_mm),
        along,
        acceleration
    ));
    let mut orders: Vec<(usize, f64)> = found.waviness_mm.iter().copied().enumerate().collect();
    orders.sort_by(|a, b| b.1.total_cmp(&a.1));
    let largest: Vec<Text> =
        orders.iter().take(3).map(|(index, value)| text!("order {}: {}", index + 1, Length::mm(*value))).collect();
    if !largest.is_empty() {
        words.push(text!("waviness, largest amplitudes: {}", Text::joined(largest, ", ")));
    }
    words
}

/// Whether the measured cam lies within the tolerance, with the figure and the place of the largest deviation, µm and degrees.
fn headline(worst: [f64; 2], half_zone: Option<f64>) -> String {
    let [at, value] = worst;
    let side = if value > 0.0 { "too much metal" } else { "too little metal" };
    let (size, at) = (figure(value.abs()), figure(at));
    match half_zone {
        Some(half) if value.abs() > half => {
            format!("Out of tolerance: {size} µm {side} at {at}°, {} µm allowed", figure(half))
        }
        Some(half) => format!("Within tolerance: at most {size} µm of {} µm, {side} at {at}°", figure(half)),
        None => format!("At most {size} µm off: {side} at {at}°"),
    }
}

fn plot(body: &dyn Body, rows: &[PointRow], moved: &MeasuredMove, waves: &[[f64; 2]]) -> Plot {
    let points = |value: fn(&PointRow) -> f64| {
        rows.iter().map(|row| [polar(row.place.foot).to_degrees(), MICROMETRES * value(row)]).collect::<Vec<_>>()
    };
    let fitted = points(|row| row.place.deviation);
    let worst = fitted.iter().copied().reduce(|best, next| if next[1].abs() > best[1].abs() { next } else { best });
    let worst = worst.unwrap_or([0.0; 2]);
    let half_zone = Some(1e3 * PartTolerance::of(body).half_mm());
    let limit = |half: f64| {
        [
            PlotBand::above(half, format!("too much metal: over {} µm", figure(half))),
            PlotBand::below(-half, format!("too little metal: below −{} µm", figure(half))),
        ]
    };
    let deviations = PlotPanel {
        points: vec![PlotPoint::dot(worst, 0, format!("{} µm at {}°", figure(worst[1]), figure(worst[0])))],
        bands: half_zone.into_iter().flat_map(limit).collect(),
        height: 1.5,
        ..PlotPanel::new(
            "Deviation along the normal, µm: positive with too much metal",
            vec![PlotCurve::grey("as measured", points(|row| row.raw)), PlotCurve::new("fitted", 0, fitted)],
        )
    };
    let lift = PlotPanel::new("Error of the lift, µm", vec![PlotCurve::new("", 0, points(|row| row.place.lift))]);
    let orders = waves.iter().enumerate().skip(1);
    #[expect(clippy::cast_precision_loss, reason = "a few dozen orders")]
    let amplitudes = orders.map(|(order, wave)| [order as f64, MICROMETRES * amplitude(wave)]).collect::<Vec<_>>();
    let largest = amplitudes.iter().copied().reduce(|best, next| if next[1] > best[1] { next } else { best });
    let spectrum = PlotPanel {
        points: largest
            .map(|at| PlotPoint::dot(at, 0, format!("order {}: {} µm", figure(at[0]), figure(at[1]))))
            .into_iter()
            .collect(),
        ..PlotPanel::new("Waviness: amplitude of each order, µm", vec![PlotCurve::new("", 0, amplitudes)])
    };
    let turn = (moved.turn.to_degrees() + 180.0).rem_euclid(360.0) - 180.0;
    let shift = format!("{} and {} mm", figure(moved.shift.x), figure(moved.shift.y));
    Plot {
        title: headline(worst, half_zone),
        subtitle: format!(
            "{}: {} measured points, turned by {}° and shifted by {shift} to fit",
            body.machine().name(),
            rows.len(),
            figure(turn)
        ),
        places: "polar angle on the part, degrees".into(),
        panels: vec![deviations, lift],
        own: if waves.is_empty() { Vec::new() } else { vec![("order".into(), spectrum)] },
        ..Plot::default()
    }
}

#[cfg(test)]
mod tests;

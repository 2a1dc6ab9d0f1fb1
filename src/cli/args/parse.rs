//! The values of flags, as they were typed.

use camgen::body::{Accuracy, Gauge, RateTolerance};
use camgen::document::{LengthOrAngle, NamedChoice, similar};
use camgen::domains::shaft::mechanics::MOST_ORDER;
use camgen::machine::{fault_of_stem, valid_rpm};
use camgen::motion::laws::{self, LAWS, Law};
use camgen::tool_files::dxf::Version;
use camgen::tool_files::formats_by_name;
use camgen::units::{self, Dimension};
use camgen::write::csv::MOST_ROWS;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use std::f64::consts::{PI, TAU};

/// A tolerance of velocity or acceleration, or none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum RateLimit {
    Any,
    Within(RateTolerance),
}

/// Units of velocity and of acceleration, as messages list them.
const VELOCITIES: &str = "mm/rad, mm/deg, mm/s, m/s, rad/rad, rad/s";
const ACCELERATIONS: &str = "mm/rad2, mm/deg2, mm/s2, m/s2, rad/rad2, rad/s2";

/// A speed, or `A..B` from one to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Speed {
    One(f64),
    Range(f64, f64),
}

pub(crate) fn velocity_error(text: &str) -> Result<RateLimit, String> {
    rate(text, 1, VELOCITIES)
}

pub(crate) fn acceleration_error(text: &str) -> Result<RateLimit, String> {
    rate(text, 2, ACCELERATIONS)
}

pub(crate) fn share(text: &str) -> Result<f64, String> {
    match rate(text, 2, ACCELERATIONS)? {
        RateLimit::Within(RateTolerance::Share(share)) => Ok(share),
        _ => Err("must be a share, e.g. 2%".into()),
    }
}

fn rate(text: &str, order: u32, known: &str) -> Result<RateLimit, String> {
    let text = text.trim();
    if text.eq_ignore_ascii_case("none") {
        return Ok(RateLimit::Any);
    }
    if let Some(share) = text.strip_suffix('%') {
        let share =
            units::parse_bare(share).map_err(|error| format!("{error}; e.g. 5%, none, or in one of {known}"))?;
        return match share {
            share if !(share > 0.0) => Err("must be above 0".into()),
            share if share <= 100.0 => Ok(RateLimit::Within(RateTolerance::Share(share / 100.0))),
            _ => Err("must be at most 100%".into()),
        };
    }
    match units::parse_rate(text, order) {
        Ok(rate) if rate.by_travel => Err(format!("of a plate the tolerance is a share (5%) or none: {text}")),
        Ok(rate) if rate.value > 0.0 => {
            let units::DerivativeValue { value, swing, by_time, .. } = rate;
            Ok(RateLimit::Within(RateTolerance::Rate { value, swing, by_time }))
        }
        Ok(_) => Err("must be above 0".into()),
        Err(error) => Err(format!("{error}; it is a share (5%), none, or in one of {known}")),
    }
}

pub(crate) fn speed(text: &str) -> Result<Speed, String> {
    match text.split_once("..") {
        None => rpm(text).map(Speed::One),
        Some((from, to)) => {
            let (from, to) = (rpm(from)?, rpm(to)?);
            if from < to {
                Ok(Speed::Range(from, to))
            } else {
                Err("a range goes from the slower to the faster speed".into())
            }
        }
    }
}

pub(crate) fn force(text: &str) -> Result<f64, String> {
    let quantity = units::parse(text, Dimension::Force)
        .map_err(|error| format!("{error}; a force has one of {}", Dimension::Force.unit_list()))?;
    if quantity.si > 0.0 { Ok(quantity.si) } else { Err("must be above 0".into()) }
}

/// Largest travel, m and rad: as in a file.
const TRAVELS: (f64, f64) = (100.0, 4.0 * PI);

pub(crate) fn lift(text: &str) -> Result<LengthOrAngle, String> {
    let (length, angle) = (units::parse(text, Dimension::Length), units::parse(text, Dimension::Angle));
    let found = match (length, angle) {
        (Ok(length), _) if length.si > 0.0 && length.si <= TRAVELS.0 => LengthOrAngle::Length(length.si),
        (_, Ok(angle)) if angle.si > 0.0 && angle.si <= TRAVELS.1 => LengthOrAngle::Angle(angle.si),
        (Ok(_), _) => return Err("must be above 0 and at most 100 m".into()),
        (_, Ok(_)) => return Err("must be above 0 and at most two turns".into()),
        (Err(error), _) => {
            let (lengths, angles) = (Dimension::Length.unit_list(), Dimension::Angle.unit_list());
            return Err(format!("{error}; a travel has one of {lengths}, a swing one of {angles}"));
        }
    };
    Ok(found)
}

pub(crate) fn segment_angle(text: &str) -> Result<f64, String> {
    let quantity = units::parse(text, Dimension::Angle)
        .map_err(|error| format!("{error}; an angle has one of {}", Dimension::Angle.unit_list()))?;
    let most = 2.0 * PI * (1.0 + 1e-12);
    if quantity.si > 0.0 && quantity.si <= most {
        Ok(quantity.si)
    } else {
        Err("must be above 0 and at most 360 deg".into())
    }
}

/// Widest and narrowest step of the crank angle, rad.
const STEPS: (f64, f64) = (1.0e-2 * PI / 180.0, PI / 2.0);

pub(crate) fn crank_step(text: &str) -> Result<f64, String> {
    let quantity = units::parse(text, Dimension::Angle)
        .map_err(|error| format!("{error}; an angle has one of {}", Dimension::Angle.unit_list()))?;
    // With a margin for the rounding of the conversion.
    let (least, most) = (STEPS.0 * (1.0 - 1e-12), STEPS.1 * (1.0 + 1e-12));
    if (least..=most).contains(&quantity.si) { Ok(quantity.si) } else { Err("must be from 0.01 deg to 90 deg".into()) }
}

pub(crate) fn power_share(text: &str) -> Result<f64, String> {
    let share = units::parse_bare(text).map_err(|error| format!("{error}; a share is a bare number, e.g. 0.831"))?;
    if share > 0.0 && share <= 10.0 { Ok(share) } else { Err("must be above 0 and at most 10".into()) }
}

pub(crate) fn stiffness(text: &str) -> Result<f64, String> {
    let quantity = units::parse(text, Dimension::Stiffness)
        .map_err(|error| format!("{error}; a stiffness has one of {}", Dimension::Stiffness.unit_list()))?;
    if quantity.si > 0.0 { Ok(quantity.si) } else { Err("must be above 0".into()) }
}

/// Two stiffnesses, the first below the second, N/m.
pub(crate) fn stiffnesses(text: &str) -> Result<(f64, f64), String> {
    let (from, to) =
        text.split_once("..").ok_or("a sweep goes from one stiffness to another, e.g. \"1e8 N/m .. 1e9 N/m\"")?;
    let (from, to) = (stiffness(from.trim())?, stiffness(to.trim())?);
    if from < to { Ok((from, to)) } else { Err("a sweep goes from the smaller to the larger stiffness".into()) }
}

/// An order of load polynomials, or as many as it takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Order {
    Auto,
    Of(usize),
}

pub(crate) fn order(text: &str) -> Result<Order, String> {
    if text.eq_ignore_ascii_case("auto") {
        return Ok(Order::Auto);
    }
    let order = text.parse().map_err(|_| "must be auto or a whole number")?;
    if (1..=MOST_ORDER).contains(&order) {
        Ok(Order::Of(order))
    } else {
        Err(format!("must be from 1 to {MOST_ORDER}"))
    }
}

pub(crate) fn rpm(text: &str) -> Result<f64, String> {
    let number =
        units::parse_bare(text).map_err(|error| format!("{error}; a speed is a bare number, e.g. --rpm 35"))?;
    valid_rpm(number)
}

/// Coarsest tolerance, m: a cam that is off by more than a millimetre is of no use.
const COARSEST: f64 = 1e-3;

pub(crate) fn tolerance(text: &str) -> Result<f64, String> {
    let quantity = units::parse(text, Dimension::Length)
        .map_err(|error| format!("{error}; a tolerance is a length with one of {}", Dimension::Length.unit_list()))?;
    if quantity.si > 0.0 && quantity.si <= COARSEST {
        Ok(quantity.si)
    } else {
        Err(format!("must be above 0 and at most {}", quantity.in_same_unit(COARSEST)))
    }
}

/// Radius of the largest cutter or wheel, m.
const LARGEST_CUTTER: f64 = 1.0;
/// Radius of the smallest cutter, beam or probing ball that can be had, m.
const SMALLEST_CUTTER: f64 = 5e-6;

/// The radius of a cutter of a diameter, m.
pub(crate) fn cutter_diameter(text: &str) -> Result<f64, String> {
    cutter(text, "diameter", 2.0)
}

pub(crate) fn cutter_radius(text: &str) -> Result<f64, String> {
    cutter(text, "radius", 1.0)
}

/// The radius of a cutter that is given by a number of radii, m.
fn cutter(text: &str, what: &str, radii: f64) -> Result<f64, String> {
    let quantity = units::parse(text, Dimension::Length)
        .map_err(|error| format!("{error}; a {what} is a length with one of {}", Dimension::Length.unit_list()))?;
    let [least, most] = [SMALLEST_CUTTER, LARGEST_CUTTER].map(|radius| radii * radius);
    if (least..=most).contains(&quantity.si) {
        Ok(quantity.si / radii)
    } else {
        let [least, most] = [least, most].map(|bound| quantity.in_same_unit(bound));
        Err(format!("must be at least {least} and at most {most}"))
    }
}

/// The gauge follower of the words of `--gauge`.
pub(in crate::cli) fn gauge_follower(words: &[String]) -> Result<Gauge, String> {
    let fault = |why: &str| {
        format!("--gauge {}: {why}; write --gauge ball 3mm, --gauge roller 20mm or --gauge flat", words.join(" "))
    };
    let is_round = |form: &String| ["ball", "roller"].iter().any(|known| form.eq_ignore_ascii_case(known));
    match words {
        [form] if form.eq_ignore_ascii_case("flat") => Ok(Gauge::Flat),
        [form] if is_round(form) => Err(fault("its diameter is missing")),
        [form, diameter] if is_round(form) => {
            cutter_diameter(diameter).map(Gauge::Round).map_err(|why| fault(&format!("the diameter {why}")))
        }
        _ => Err(fault("the form is ball or roller with a diameter, or flat")),
    }
}

/// The cam angle of a start, rad.
pub(crate) fn start(text: &str) -> Result<f64, String> {
    let quantity = units::parse(text, Dimension::Angle)
        .map_err(|error| format!("{error}; a start is an angle with one of {}", Dimension::Angle.unit_list()))?;
    if (0.0..TAU).contains(&quantity.si) {
        Ok(quantity.si)
    } else {
        Err(format!("must be at least 0 and below {}", quantity.in_same_unit(TAU)))
    }
}

/// `--cutter` alone names neither: a cutter bought by its diameter and moved by its radius leaves twice or half of what it should.
pub(crate) fn bare_cutter(text: &str) -> Result<f64, String> {
    let (typed, example) = if text.is_empty() { ("LENGTH", "8mm") } else { (text, text) };
    Err(format!(
        "is {typed} the diameter or the radius? For a cutter of Ø {example} write --cutter-diameter {example}, for one of radius {example} \
         --cutter-radius {example}"
    ))
}

pub(crate) fn samples(text: &str) -> Result<u32, String> {
    let rows = text.parse().map_err(|_| "must be a whole number")?;
    if (1..=MOST_ROWS).contains(&rows) {
        Ok(rows)
    } else {
        Err(format!("a table has from 1 to {MOST_ROWS} rows; for a curve that a control follows see --format points"))
    }
}

pub(crate) fn format(text: &str) -> Result<String, String> {
    if let Some(format) = formats_by_name().find(|format| format.name.eq_ignore_ascii_case(text)) {
        return Ok(format.name.to_owned());
    }
    let known: Vec<&str> = formats_by_name().map(|format| format.name).collect();
    Err(format!("no such format; {}one of {}", meant(text, &known), known.join(", ")))
}

pub(crate) fn law(text: &str) -> Result<&'static Law, String> {
    laws::named(text).ok_or_else(|| {
        let known: Vec<&str> = LAWS.iter().map(|law| law.name).collect();
        format!("no such law; {}one of {}", meant(text, &known), known.join(", "))
    })
}

/// A law, or what no law follows.
#[derive(Debug, Clone, Copy)]
pub(in crate::cli) enum LawOrSpline {
    Law(&'static Law),
    Spline,
}

pub(super) fn law_or_spline(text: &str) -> Result<LawOrSpline, String> {
    if text.eq_ignore_ascii_case("spline") {
        return Ok(LawOrSpline::Spline);
    }
    law(text).map(LawOrSpline::Law).map_err(|why| format!("{why}; or spline"))
}

pub(crate) fn dxf_version(text: &str) -> Result<Version, String> {
    Version::ALL.iter().find(|(name, _)| name.eq_ignore_ascii_case(text)).map(|(_, version)| *version).ok_or_else(
        || {
            let known: Vec<&str> = Version::ALL.iter().map(|(name, _)| *name).collect();
            format!("no such version; {}one of {}", meant(text, &known), known.join(", "))
        },
    )
}

/// One of the words of a choice.
pub(crate) fn word<T: NamedChoice>() -> impl TypedValueParser<Value = T> {
    let mut known: Vec<(PossibleValue, T)> = Vec::new();
    for (name, case) in T::ALL {
        match known.iter_mut().find(|(_, other)| other == case) {
            Some((value, _)) => *value = value.clone().alias(name),
            None => known.push((PossibleValue::new(*name), *case)),
        }
    }
    let known = known.into_iter().map(|(value, _)| value);
    PossibleValuesParser::new(known).try_map(|typed| T::named(&typed).ok_or("no such word"))
}

/// A named accuracy; help has what each is for.
pub(crate) fn accuracy() -> impl TypedValueParser<Value = Accuracy> {
    let values = Accuracy::ALL.iter().map(|(name, accuracy)| {
        PossibleValue::new(*name).help(match accuracy {
            Accuracy::Draft => "50 µm: for a first look",
            Accuracy::Standard => "5 µm and 5 % of the acceleration: for milling",
            Accuracy::Fine => "0.5 µm and 1 % of the acceleration: for grinding",
        })
    });
    PossibleValuesParser::new(values).try_map(|typed| Accuracy::named(&typed).ok_or("no such word"))
}

/// The known word that was probably meant, as the start of a message; empty when none is near.
fn meant(text: &str, known: &[&str]) -> String {
    similar(text, known.iter().copied()).map_or(String::new(), |word| format!("did you mean `{word}`? It is "))
}

/// A stem names files in the output directory and must not lead out of it.
pub(crate) fn stem(text: &str) -> Result<String, String> {
    fault_of_stem(text).map_or_else(|| Ok(text.to_owned()), Err)
}

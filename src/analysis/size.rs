//! The smallest disc for a motion program, what binds it, and how its size changes with the place of its follower.

use super::Analysis;
use crate::body::disc::{Best, Disc, DiscError, SizeTold};
use crate::body::{Body, Kind};
use crate::document::{Input, cams};
use crate::follower::Place;
use crate::geometry::MILLIMETRES;
use crate::machine::Machine;
use crate::numeric::parallel;
use crate::report::plot::{Curve, Panel, Plot};
use crate::report::{Section, Speeds, shown};
use crate::table::{Table, Told};
use serde::Serialize;
use std::f64::consts::TAU;

/// The smallest disc.
pub const KIND: Kind = Kind { command: "size", noun: "smallest cam", keys: cams::MAKE };

/// Steps of the tables.
const STEPS: u32 = 40;
/// How far a table of places reaches to both sides, over the prime radius of the smallest cam.
const PLACES_REACH: f64 = 0.6;
/// Rounding of the smallest size, as a share of it.
const ROUNDING: f64 = 1e-9;
/// From and to which share of the smallest base radius a table of sizes reaches.
const SIZES: (f64, f64) = (0.6, 2.0);

/// What may be left open beside the base radius.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Free {
    /// The offset of a roller or a knife edge on a straight path.
    Offset,
    /// Where the pivot of an arm stands.
    Pivot,
}

/// Why nothing is sized.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SizeError {
    /// There is nothing to size.
    #[error("the machine file has no [motion]: `camgen size` is for what `camgen make` cuts")]
    NoMotion,
    /// The follower has no such place to choose.
    #[error("--free {asked}: {path} has no {asked} to choose{}", has.map_or(String::new(), |has| format!("; it has --free {has}")))]
    NotFree {
        /// As asked for.
        asked: &'static str,
        /// The follower's table.
        path: &'static str,
        /// What may be chosen.
        has: Option<&'static str>,
    },
    /// There is no such disc.
    #[error(transparent)]
    Disc(#[from] DiscError),
}

/// A size with its figures; what is not known is NaN.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct Row {
    /// Offset or pivot distance, mm.
    place: f64,
    prime_radius_mm: f64,
    base_radius_mm: f64,
    by_pressure_angle_mm: f64,
    pressure_angle_deg: f64,
    convex_radius_mm: f64,
}

const BY_OFFSET: &[Told<Row>] = &[
    ("offset_mm", |row| row.place),
    ("prime_radius_mm", |row| row.prime_radius_mm),
    ("base_radius_mm", |row| row.base_radius_mm),
    ("prime_radius_by_pressure_angle_mm", |row| row.by_pressure_angle_mm),
    ("pressure_angle_deg", |row| row.pressure_angle_deg),
    ("min_convex_radius_mm", |row| row.convex_radius_mm),
];
const BY_PIVOT: &[Told<Row>] = &[
    ("pivot_distance_mm", |row| row.place),
    ("prime_radius_mm", |row| row.prime_radius_mm),
    ("base_radius_mm", |row| row.base_radius_mm),
    ("prime_radius_by_pressure_angle_mm", |row| row.by_pressure_angle_mm),
    ("pressure_angle_deg", |row| row.pressure_angle_deg),
    ("min_convex_radius_mm", |row| row.convex_radius_mm),
];
const BY_SIZE: &[Told<Row>] = &[
    ("base_radius_mm", |row| row.base_radius_mm),
    ("prime_radius_mm", |row| row.prime_radius_mm),
    ("pressure_angle_deg", |row| row.pressure_angle_deg),
    ("min_convex_radius_mm", |row| row.convex_radius_mm),
];

/// The section `size`.
#[derive(Debug, Serialize)]
struct Size {
    #[serde(flatten)]
    told: SizeTold,
    base_radius_mm: f64,
    prime_radius_mm: f64,
    /// The smallest by the pressure angle alone, over every place of the follower.
    #[serde(skip_serializing_if = "Option::is_none")]
    least_by_pressure_angle: Option<Best>,
    /// Where it binds there, degrees of cam angle.
    binding_there_deg: Vec<f64>,
}

/// The machine with its size left open, and what of its follower's place is.
fn opened(machine: &Machine, free: &[Free]) -> Result<Machine, SizeError> {
    let follower = &machine.follower;
    let has = follower.shape.place();
    let mut place = follower.place;
    for asked in free {
        let fits = matches!(
            (asked, has),
            (Free::Offset, Some(Place::Offset { .. })) | (Free::Pivot, Some(Place::Pivot { .. }))
        );
        if !fits {
            let asked = if *asked == Free::Offset { "offset" } else { "pivot_distance" };
            return Err(SizeError::NotFree { asked, path: follower.path, has: has.map(Place::key) });
        }
        place = has;
    }
    Ok(machine.left_open(place))
}

/// The smallest disc of the motion program of a machine, with more of it left open than its file does; `rpm` in place of the speed
/// of the file.
///
/// # Errors
/// [`SizeError`] when the file has no motion, its follower no such place, or no size keeps the limits.
pub fn analysis(machine: &Machine, free: &[Free], rpm: Option<f64>) -> Result<Analysis, SizeError> {
    let (motion, of_file) = machine.motion().ok_or(SizeError::NoMotion)?;
    let rpm = rpm.or(of_file);
    let disc = Disc::of_motion(&opened(machine, free)?, motion, rpm)?;
    let place = disc.follower().place();
    let nearest = place.and_then(|place| Some((place, disc.nearest(place).ok()?)));
    let told = disc.size();
    let size = Size {
        base_radius_mm: MILLIMETRES * disc.base_radius(),
        prime_radius_mm: MILLIMETRES * disc.prime_radius(),
        least_by_pressure_angle: nearest
            .as_ref()
            .map(|(place, nearest)| Best::of(*place, (place.chosen(nearest.shaft), nearest.prime_radius))),
        binding_there_deg: nearest
            .iter()
            .flat_map(|(_, nearest)| &nearest.binding)
            .map(|binding| binding.at.rem_euclid(TAU).to_degrees())
            .collect(),
        told,
    };
    let least = nearest.as_ref().map_or(0.0, |(_, nearest)| nearest.prime_radius * (1.0 - ROUNDING));
    let by_place = place.map(|place| (place, places(&disc, place, least)));
    let by_size = sizes(&disc);
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs(KIND.keys));
    inputs.extend(rpm.map(|rpm| Input::number("rpm", rpm)));
    inputs.push(Input::word("free", size.told.free.join(" ")));
    let of_place = by_place.as_ref().map(|(place, rows)| {
        let columns = if matches!(place, Place::Offset { .. }) { BY_OFFSET } else { BY_PIVOT };
        ("", Table::listed(columns, rows))
    });
    let size_suffix = if of_place.is_some() { "-sizes" } else { "" };
    Ok(Analysis {
        kind: &KIND,
        machine: machine.name().to_owned(),
        speeds: rpm.map_or(Speeds::Any(()), Speeds::One),
        inputs,
        sections: vec![Section::new(KIND.command, &size).with_words(words(&disc, &size, place))],
        measures: Vec::new(),
        notes: machine.idle_keys_told(KIND.keys, KIND.noun),
        plot: plot(machine.name(), by_place.as_ref(), &by_size),
        mechanism: None,
        document: None,
        tables: of_place.into_iter().chain([(size_suffix, Table::listed(BY_SIZE, &by_size))]).collect(),
        by: &[],
        along: "base_radius_mm",
        not_modelled: Vec::new(),
    })
}

/// Equal steps between two values, both included.
fn between(from: f64, to: f64) -> Vec<f64> {
    (0..=STEPS).map(|step| from + (to - from) * f64::from(step) / f64::from(STEPS)).collect()
}

/// A disc of some size, with its figures.
fn row(disc: Option<&Disc>, place: f64, by_pressure_angle: f64) -> Row {
    Row {
        place: MILLIMETRES * place,
        prime_radius_mm: disc.map_or(f64::NAN, |disc| MILLIMETRES * disc.prime_radius()),
        base_radius_mm: disc.map_or(f64::NAN, |disc| MILLIMETRES * disc.base_radius()),
        by_pressure_angle_mm: MILLIMETRES * by_pressure_angle,
        pressure_angle_deg: disc.map_or(f64::NAN, |disc| disc.pressure_angle().value.to_degrees()),
        convex_radius_mm: disc.map_or(f64::NAN, |disc| MILLIMETRES * disc.least_rolled_radius().value),
    }
}

/// The smallest sizes over the places of the follower about where it stands; no place has a prime radius below `least`, m.
fn places(disc: &Disc, place: Place, least: f64) -> Vec<Row> {
    let (here, reach) = (place.of(&**disc.follower()), PLACES_REACH * disc.prime_radius());
    let nearest = if matches!(place, Place::Pivot { .. }) { STEPS_ABOVE_ZERO * here } else { f64::NEG_INFINITY };
    let choices = between((here - reach).max(nearest), here + reach);
    parallel::map(&choices, |choice| {
        let smallest = disc.smallest_at(place, *choice, least);
        let alone = disc.smallest_inclined_at(place, *choice, least);
        let sized = smallest.and_then(|smallest| disc.placed_at(place, *choice).of_prime_radius(smallest.prime_radius));
        row(sized.as_ref(), *choice, alone.unwrap_or(f64::NAN))
    })
}

/// Least pivot distance of a table over that of the smallest cam.
const STEPS_ABOVE_ZERO: f64 = 0.05;

/// What other sizes have.
fn sizes(disc: &Disc) -> Vec<Row> {
    let (from, to) = SIZES;
    let smallest =
        disc.smallest_prime_radius().map_or_else(|| disc.base_radius(), |radius| radius - disc.curves().offset());
    let bases = between(from * smallest, to * smallest);
    let place = disc.follower().place().map_or(f64::NAN, |place| place.of(&**disc.follower()));
    parallel::map(&bases, |base| row(disc.of_prime_radius(base + disc.curves().offset()).as_ref(), place, f64::NAN))
}

fn words(disc: &Disc, size: &Size, place: Option<Place>) -> Vec<String> {
    let mut words =
        vec![format!("base radius {} mm, prime radius {} mm", shown(size.base_radius_mm), shown(size.prime_radius_mm))];
    words.extend(disc.size_words(&size.told));
    if let (Some(place), Some(least)) = (place, &size.least_by_pressure_angle) {
        let name = if matches!(place, Place::Offset { .. }) { "offset" } else { "pivot distance" };
        let at: Vec<String> = size.binding_there_deg.iter().map(|at| format!("{at:.3}°")).collect();
        let choice = least.offset_mm.or(least.pivot_distance_mm).unwrap_or(f64::NAN);
        words.push(format!(
            "by the pressure angle alone, over every {name}: prime radius {:.4} mm at {choice:.4} mm, held at {}",
            least.prime_radius_mm,
            at.join(" and ")
        ));
    }
    words
}

fn plot(machine: &str, by_place: Option<&(Place, Vec<Row>)>, by_size: &[Row]) -> Plot {
    let curve = |name: &str, colour: usize, rows: &[Row], at: fn(&Row) -> f64, value: fn(&Row) -> f64| Curve {
        name: name.into(),
        colour,
        bold: true,
        points: rows.iter().map(|row| [at(row), value(row)]).collect(),
    };
    let of_size = |name: &str, value: fn(&Row) -> f64, title: &str| Panel {
        name: title.into(),
        curves: vec![curve(name, 0, by_size, |row| row.base_radius_mm, value)],
    };
    let own = by_place.map(|(place, rows)| {
        let places = match place {
            Place::Offset { .. } => "offset of the follower, mm",
            Place::Pivot { .. } => "pivot distance, mm",
        };
        let curves = vec![
            curve("pressure angle alone", 1, rows, |row| row.place, |row| row.by_pressure_angle_mm),
            curve("every limit", 0, rows, |row| row.place, |row| row.prime_radius_mm),
        ];
        (places.to_owned(), Panel { name: "Smallest prime radius, mm".into(), curves })
    });
    Plot {
        title: format!("{machine}: the smallest cam"),
        places: "base radius, mm".into(),
        panels: vec![
            of_size("pressure angle", |row| row.pressure_angle_deg, "Largest pressure angle, degrees"),
            of_size("convex radius", |row| row.convex_radius_mm, "Least convex radius of the follower's curve, mm"),
        ],
        own: own.into_iter().collect(),
        ..Plot::default()
    }
}

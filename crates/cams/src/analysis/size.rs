//! The smallest disc for a motion program, the limit that decides, and how its size changes with the place of its follower.

use super::{Analysis, Picture};
use crate::body::disc::{BestPlace, Disc, SizeFigures};
use crate::body::{Body, Figures, Kind, needs_base_circle, sized_disc};
use crate::check::outlier;
use crate::machine::Machine;
use crate::report::diagram::{Diagram, PlottedValue, diagram};
use crate::report::plot::{PictureColour, Plot, PlotBand, PlotCurve, PlotLine, PlotPanel, PlotPoint, figure};
use crate::report::{Fact, Section, Speeds, Topic};
use crate::table::{ListedColumn, Table};
use camgen_kernel::document::{Input, NamedChoice, cams};
use camgen_kernel::follower::FollowerPlacement;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::numeric::parallel;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{Length, Text, text};
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
/// Cam angles that are listed of those that limit the size.
const MOST_ANGLES: usize = 8;
/// From and to which share of the smallest base radius a table of sizes reaches.
const SIZES: (f64, f64) = (0.6, 2.0);

/// What may be chosen in addition to the base radius.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FreeDimension {
    /// The offset of a roller or a knife edge on a straight path.
    Offset,
    /// The pivot distance of an arm.
    Pivot,
}

impl NamedChoice for FreeDimension {
    const ALL: &'static [(&'static str, Self)] = &[
        ("offset", Self::Offset),
        ("pivot_distance", Self::Pivot),
        ("pivot-distance", Self::Pivot),
        ("arm", Self::Pivot),
    ];
}

/// A size with its figures; what is not known is NaN.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct SizeRow {
    /// Offset or pivot distance, mm.
    place: f64,
    prime_radius_mm: f64,
    base_radius_mm: f64,
    by_pressure_angle_mm: f64,
    pressure_angle_deg: f64,
    convex_radius_mm: f64,
}

const BY_OFFSET: &[ListedColumn<SizeRow>] = &[
    ("offset_mm", |row| row.place),
    ("prime_radius_mm", |row| row.prime_radius_mm),
    ("base_radius_mm", |row| row.base_radius_mm),
    ("prime_radius_by_pressure_angle_mm", |row| row.by_pressure_angle_mm),
    ("pressure_angle_deg", |row| row.pressure_angle_deg),
    ("min_convex_radius_mm", |row| row.convex_radius_mm),
];
const BY_PIVOT: &[ListedColumn<SizeRow>] = &[
    ("pivot_distance_mm", |row| row.place),
    ("prime_radius_mm", |row| row.prime_radius_mm),
    ("base_radius_mm", |row| row.base_radius_mm),
    ("prime_radius_by_pressure_angle_mm", |row| row.by_pressure_angle_mm),
    ("pressure_angle_deg", |row| row.pressure_angle_deg),
    ("min_convex_radius_mm", |row| row.convex_radius_mm),
];
const BY_SIZE: &[ListedColumn<SizeRow>] = &[
    ("base_radius_mm", |row| row.base_radius_mm),
    ("prime_radius_mm", |row| row.prime_radius_mm),
    ("pressure_angle_deg", |row| row.pressure_angle_deg),
    ("min_convex_radius_mm", |row| row.convex_radius_mm),
];

/// The section `size`.
#[derive(Debug, Serialize)]
struct Size {
    #[serde(flatten)]
    figures: SizeFigures,
    base_radius_mm: f64,
    prime_radius_mm: f64,
    /// The smallest by the pressure angle alone, over every place of the follower.
    #[serde(skip_serializing_if = "Option::is_none")]
    least_by_pressure_angle: Option<BestPlace>,
    /// Where it binds there, degrees of cam angle.
    binding_there_deg: Vec<f64>,
}

/// The machine without a base radius, and with the requested part of its follower's position to be chosen.
fn opened(machine: &Machine, free: &[FreeDimension]) -> Result<Machine, Refusal> {
    let follower = &machine.follower;
    let has = follower.shape.place();
    let mut place = follower.place;
    for asked in free {
        let fits = matches!(
            (asked, has),
            (FreeDimension::Offset, Some(FollowerPlacement::Offset { .. }))
                | (FreeDimension::Pivot, Some(FollowerPlacement::Pivot { .. }))
        );
        if !fits {
            let asked = if *asked == FreeDimension::Offset { "offset" } else { "pivot_distance" };
            let path = follower.path;
            let refusal = Refusal::new(format!("--free {asked}: {path} has no {asked} to choose"));
            return Err(match has {
                Some(has) => refusal.remedy(format!("use --free {}", has.key())),
                None => refusal,
            });
        }
        place = has;
    }
    let opened = machine.left_open(place);
    // The roller of a ring runs inside of it.
    let inside = opened.follower.inside().filter(|_| opened.cam.track.is_ring());
    Ok(inside.map_or_else(|| opened.clone(), |follower| opened.with_follower(follower)))
}

/// The smallest disc of the motion program of a machine, with more of it to be chosen than in its file; `rpm` in place of the speed
/// of the file.
///
/// ```
/// # use camgen_cams as camgen;
/// use camgen::{Judged, Machine};
/// use camgen::analysis::size::{self, FreeDimension};
///
/// let (machine, _) = Machine::load("feeder", &[])?;
/// let smallest = Judged::new(size::analysis(&machine, &[FreeDimension::Offset], None)?);
/// let report = smallest.report();
/// assert!(report.section("size").is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Refusal`] when the file has no motion, its follower no such place, or no size keeps the limits.
pub fn analysis(machine: &Machine, free: &[FreeDimension], rpm: Option<f64>) -> Result<Analysis, Refusal> {
    let machine = &machine.at_rpm(rpm)?;
    let (motion, of_file) = machine.motion().ok_or_else(|| {
        Refusal::new("the machine file has no [motion]").remedy("give the file of a cam that `camgen make` cuts")
    })?;
    if motion.period().is_none() {
        let what = "a plate has no base radius whose smallest could be found";
        return Err(Refusal::new(what).remedy("`camgen make` reports the shortest stroke and lengths of its segments"));
    }
    let rpm = rpm.or(of_file);
    let outlier = outlier::of_motion(&*motion);
    needs_base_circle(machine, "the smallest cam of `camgen size`")?;
    let disc = sized_disc(&opened(machine, free)?, &motion, rpm)?;
    let place = disc.follower().place();
    let nearest = place.and_then(|place| Some((place, disc.nearest(place).ok()?)));
    let figures = disc.size();
    let size = Size {
        base_radius_mm: MILLIMETRES * disc.base_radius(),
        prime_radius_mm: MILLIMETRES * disc.prime_radius(),
        least_by_pressure_angle: nearest
            .as_ref()
            .map(|(place, nearest)| BestPlace::of(*place, (place.chosen(nearest.shaft), nearest.prime_radius))),
        binding_there_deg: nearest
            .iter()
            .flat_map(|(_, nearest)| &nearest.binding)
            .map(|binding| binding.at.rem_euclid(TAU).to_degrees())
            .collect(),
        figures,
    };
    let least = nearest.as_ref().map_or(0.0, |(_, nearest)| nearest.prime_radius * (1.0 - ROUNDING));
    let by_place = place.map(|place| (place, places(&disc, place, least)));
    let by_size = sizes(&disc);
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs(KIND.keys));
    inputs.extend(rpm.map(|rpm| Input::number("rpm", rpm)));
    inputs.push(Input::word("free", size.figures.free.join(" ")));
    let of_place = by_place.as_ref().map(|(place, rows)| {
        let columns = if matches!(place, FollowerPlacement::Offset { .. }) { BY_OFFSET } else { BY_PIVOT };
        ("", Table::listed(columns, rows))
    });
    let size_suffix = if of_place.is_some() { "-sizes" } else { "" };
    Ok(Analysis {
        kind: &KIND,
        variant: "",
        machine: machine.name().to_owned(),
        speeds: rpm.map_or(Speeds::Any(()), Speeds::One),
        inputs,
        sections: vec![summarised(
            &disc,
            &size,
            Section::new(KIND.command, &size).with_words(words(&disc, &size, place)),
        )],
        measures: outlier.into_iter().collect(),
        notes: machine.idle_key_notes(KIND.keys, KIND.noun),
        picture: Picture::Curves(plot(&disc, by_place.as_ref(), &by_size)),
        mechanism: None,
        document: None,
        tables: of_place.into_iter().chain([(size_suffix, Table::listed(BY_SIZE, &by_size))]).collect(),
        by: &[],
        along: "base_radius_mm",
        diagrams: DIAGRAMS,
        not_modelled: Vec::new(),
    })
}

/// What the page draws over the base radius.
const DIAGRAMS: &[Diagram] = &[
    diagram(
        "pressure-angle",
        "Largest pressure angle",
        &[("pressure_angle", "largest")],
        &[("pressure_angle", PlottedValue::Itself)],
        PlottedValue::Itself,
    ),
    diagram(
        "radii",
        "Prime radius, and smallest convex radius of curvature",
        &[("prime_radius", "prime radius"), ("min_convex_radius", "smallest convex radius")],
        &[],
        PlottedValue::Itself,
    ),
];

/// Equal steps between two values, both included.
fn between(from: f64, to: f64) -> Vec<f64> {
    (0..=STEPS).map(|step| from + (to - from) * f64::from(step) / f64::from(STEPS)).collect()
}

/// A disc of some size, with its figures.
fn row(disc: Option<&Disc>, place: f64, by_pressure_angle: f64) -> SizeRow {
    SizeRow {
        place: MILLIMETRES * place,
        prime_radius_mm: disc.map_or(f64::NAN, |disc| MILLIMETRES * disc.prime_radius()),
        base_radius_mm: disc.map_or(f64::NAN, |disc| MILLIMETRES * disc.base_radius()),
        by_pressure_angle_mm: MILLIMETRES * by_pressure_angle,
        pressure_angle_deg: disc.map_or(f64::NAN, |disc| disc.pressure_angle().value.to_degrees()),
        convex_radius_mm: disc.map_or(f64::NAN, |disc| MILLIMETRES * disc.least_rolled_radius().value),
    }
}

/// The smallest sizes over places of the follower about its own; no place has a prime radius below `least`, m.
fn places(disc: &Disc, place: FollowerPlacement, least: f64) -> Vec<SizeRow> {
    let (here, reach) = (place.chosen_by(&**disc.follower()), PLACES_REACH * disc.prime_radius());
    let nearest =
        if matches!(place, FollowerPlacement::Pivot { .. }) { STEPS_ABOVE_ZERO * here } else { f64::NEG_INFINITY };
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
fn sizes(disc: &Disc) -> Vec<SizeRow> {
    let (from, to) = SIZES;
    let smallest =
        disc.smallest_prime_radius().map_or_else(|| disc.base_radius(), |radius| radius - disc.curves().offset());
    let bases = between(from * smallest, to * smallest);
    let place = disc.follower().place().map_or(f64::NAN, |place| place.chosen_by(&**disc.follower()));
    parallel::map(&bases, |base| row(disc.of_prime_radius(base + disc.curves().offset()).as_ref(), place, f64::NAN))
}

/// The smallest cam, what keeps it from being smaller, and the place of the follower that would allow the smallest one.
fn summarised(disc: &Disc, size: &Size, section: Section) -> Section {
    let smallest = size.figures.smallest_base_radius_mm.map(|radius| {
        text!(
            "the smallest base radius with which pressure angle, curvature, wall and stress pass is {}",
            Length::mm(radius).brief()
        )
    });
    let chosen = text!(
        "base R{}, prime R{}",
        Length::mm(size.base_radius_mm).nominal(),
        Length::mm(size.prime_radius_mm).nominal()
    );
    let place = [("offset", size.figures.offset_mm), ("pivot distance", size.figures.pivot_distance_mm)];
    let place = place.into_iter().find_map(|(name, mm)| Some(text!("{} {}", name, Length::mm(mm?).nominal())));
    let binding = size.figures.binding.map(|limit| {
        let at = size.figures.binding_cam_deg.map(|at| format!(" at {at:.1}°"));
        text!("{}{}", limit.replace('_', " "), at.unwrap_or_default())
    });
    let best = size.least_by_pressure_angle.as_ref().map(|best| {
        let name = if best.offset_mm.is_some() { "offset" } else { "pivot distance" };
        let choice = best.offset_mm.or(best.pivot_distance_mm).unwrap_or(f64::NAN);
        text!(
            "{} {} would do with prime R{} by the pressure angle alone",
            name,
            Length::mm(choice).brief(),
            Length::mm(best.prime_radius_mm).brief()
        )
    });
    let answer = smallest.unwrap_or_else(|| text!("no base radius keeps every limit of {}", disc.machine().name()));
    let facts = [
        Some(Fact::new(Topic::SIZE, chosen.and(", ", place))),
        binding.map(|binding| Fact::new(Topic::new(20, "bound by"), binding)),
        best.map(|best| Fact::new(Topic::new(30, "elsewhere"), best)),
    ];
    section.with_answer(answer).with_facts(facts.into_iter().flatten())
}

fn words(disc: &Disc, size: &Size, place: Option<FollowerPlacement>) -> Vec<Text> {
    let mut words = vec![text!(
        "base radius {}, prime radius {}",
        Length::mm(size.base_radius_mm),
        Length::mm(size.prime_radius_mm)
    )];
    words.extend(disc.size_words(&size.figures));
    if let (Some(place), Some(least)) = (place, &size.least_by_pressure_angle) {
        let name = if matches!(place, FollowerPlacement::Offset { .. }) { "offset" } else { "pivot distance" };
        let mut at: Vec<String> =
            size.binding_there_deg.iter().take(MOST_ANGLES).map(|at| format!("{at:.3}°")).collect();
        let more = size.binding_there_deg.len().saturating_sub(MOST_ANGLES);
        at.extend((more > 0).then(|| format!("{more} more places")));
        let choice = least.offset_mm.or(least.pivot_distance_mm).unwrap_or(f64::NAN);
        words.push(text!(
            "by the pressure angle alone, over every {}: prime radius {} at {}, limited at {}",
            name,
            Length::mm(least.prime_radius_mm).decimals(4),
            Length::mm(choice).decimals(4),
            at.join(" and ")
        ));
    }
    words
}

/// A curve of rows.
fn curve(name: &str, rows: &[SizeRow], values: [fn(&SizeRow) -> f64; 2]) -> PlotCurve {
    PlotCurve::new(name, 0, rows.iter().map(|row| values.map(|value| value(row))).collect())
}

/// The mark of the chosen cam, with its figures.
fn chosen_point(chosen: &SizeRow, values: [fn(&SizeRow) -> f64; 2], unit: &str) -> PlotPoint {
    let at = values.map(|value| value(chosen));
    PlotPoint { colour: PictureColour::Line(0), ..PlotPoint::ring(at, figure(at[1]) + unit) }
}

/// A figure over the base radius, with its limit and the chosen cam.
fn over_base_radius(
    name: &str,
    value: fn(&SizeRow) -> f64,
    (rows, chosen): (&[SizeRow], &SizeRow),
    unit: &str,
    limit: Option<PlotBand>,
) -> PlotPanel {
    let values: [fn(&SizeRow) -> f64; 2] = [|row| row.base_radius_mm, value];
    PlotPanel {
        points: vec![chosen_point(chosen, values, unit)],
        lines: vec![PlotLine { at: chosen.base_radius_mm, text: "this cam".into(), dashed: false }],
        bands: limit.into_iter().collect(),
        ..PlotPanel::new(name, vec![curve("", rows, values)])
    }
}

/// The smallest prime radius over the places of the follower, and the chosen cam.
fn over_places(place: FollowerPlacement, rows: &[SizeRow], chosen: &SizeRow) -> (String, PlotPanel) {
    let places = match place {
        FollowerPlacement::Offset { .. } => "offset of the follower, mm",
        FollowerPlacement::Pivot { .. } => "pivot distance, mm",
    };
    let at: fn(&SizeRow) -> f64 = |row| row.place;
    let by_angle = rows.iter().map(|row| [row.place, row.by_pressure_angle_mm]).collect();
    let panel = PlotPanel {
        points: vec![chosen_point(chosen, [at, |row| row.prime_radius_mm], " mm")],
        ..PlotPanel::new(
            "Smallest prime radius, mm",
            vec![
                PlotCurve::grey("pressure angle alone", by_angle),
                curve("every limit", rows, [at, |row| row.prime_radius_mm]),
            ],
        )
    };
    (places.to_owned(), panel)
}

/// What keeps the cam from being smaller, in words; empty where no base radius is known to be the smallest.
fn headline(disc: &Disc, smallest: Option<f64>) -> String {
    let own = MILLIMETRES * disc.base_radius();
    match smallest.map(|prime| MILLIMETRES * (prime - disc.curves().offset())) {
        Some(least) if own > least * (1.0 + 1e-3) => {
            format!("A base radius of {} mm would do: this cam has {} mm", figure(least), figure(own))
        }
        Some(least) if own < least * (1.0 - 1e-9) => {
            format!("Too small by {} mm: the limits need a base radius of {} mm", figure(least - own), figure(least))
        }
        _ => format!("{} mm is the smallest base radius within every limit", figure(own)),
    }
}

fn plot(disc: &Disc, by_place: Option<&(FollowerPlacement, Vec<SizeRow>)>, by_size: &[SizeRow]) -> Plot {
    let place = disc.follower().place();
    let chosen = row(Some(disc), place.map_or(f64::NAN, |place| place.chosen_by(&**disc.follower())), f64::NAN);
    let limits = &disc.machine().limits;
    let [rising, falling] = limits.pressure_angles();
    let usable = |limit: f64| Some(limit).filter(|limit| limit.is_finite() && *limit > 0.0);
    let steepest = usable(rising.min(falling).to_degrees())
        .map(|limit| PlotBand::above(limit, format!("over the limit of {}°", figure(limit))));
    let sharpest = usable(MILLIMETRES * limits.convex_radius(disc.curves().offset()))
        .map(|limit| PlotBand::below(limit, format!("sharper than the limit of {} mm", figure(limit))));
    let sizes = (by_size, &chosen);
    let prime = figure(chosen.prime_radius_mm);
    Plot {
        title: headline(disc, disc.smallest_prime_radius()),
        subtitle: format!("{}: prime radius {prime} mm; what other sizes would have", disc.machine().name()),
        places: "base radius, mm".into(),
        panels: vec![
            over_base_radius("Largest pressure angle, degrees", |row| row.pressure_angle_deg, sizes, "°", steepest),
            over_base_radius(
                "Least convex radius of the follower's curve, mm",
                |row| row.convex_radius_mm,
                sizes,
                " mm",
                sharpest,
            ),
        ],
        own: by_place.map(|(place, rows)| over_places(*place, rows, &chosen)).into_iter().collect(),
        ..Plot::default()
    }
}

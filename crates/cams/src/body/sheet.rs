//! What the sheets of several bodies show alike.

use super::balancing::Balancing;
use super::part::point_as_turned;
use super::part_tolerance::PartTolerance;
use super::{curves_of, torque};
use crate::machine::fit::HoleFit;
use crate::machine::{Keyway, Machine, Rotation, parallel_key};
use crate::report::sheet::Dimensions;
use crate::report::sheet::{
    FeatureFrame, Mark, PlaceRow, PlaceTable, ShapeGroup, SheetShape, ToleranceSign, TurningArc, rounded,
};
use crate::report::trace::Trace;
use camgen_kernel::geometry::contour::{Contour, Extents};
use camgen_kernel::geometry::{Entity, MILLIMETRES, polar};
use camgen_kernel::motion::Quantity;
use camgen_kernel::profile::Curves;
use camgen_kernel::profile::followed::FollowerOnChain;
use camgen_kernel::text::{Text, text};
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;
use std::sync::Arc;

/// How far the roller's path and the normal reach beyond the roller, in its radii.
pub(crate) const PATH_OVER_RADIUS: f64 = 0.6;
/// How far axes reach beyond what is drawn, as a share of it.
const AXIS_BEYOND: f64 = 0.04;
/// Places of the diagram of the acceleration lie no farther apart than this share of the motion.
const TRACE_SHARE: f64 = 1.0 / 180.0;
/// Degrees of cam angle over which the sense of the angle is shown.
const SENSE_DEG: f64 = 24.0;

/// A roller with its path and the normal of the cam, mm.
#[must_use]
pub fn roller(centre: Vector2<f64>, drive: Vector2<f64>, outward: Vector2<f64>, radius: f64) -> Vec<SheetShape> {
    let path = radius * (1.0 + PATH_OVER_RADIUS);
    vec![
        SheetShape::Entity(Entity::Circle(centre, radius)),
        SheetShape::Line(centre - drive * path, centre + drive * path),
        SheetShape::Line(centre - outward * radius, centre + outward * path),
    ]
}

/// The pressure angle between path and normal, with the names of both.
#[must_use]
pub fn pressure_angle(
    centre: Vector2<f64>,
    drive: Vector2<f64>,
    outward: Vector2<f64>,
    radius: f64,
    text: String,
) -> Vec<Mark> {
    // Either way along the path: the one on the side of the normal.
    let drive = if drive.dot(&outward) < 0.0 { -drive } else { drive };
    let end = radius * (1.0 + PATH_OVER_RADIUS);
    let label = |along: Vector2<f64>, text: &str| Mark::Label {
        class: "roller",
        at: centre + along * end,
        towards: along,
        text: text.into(),
    };
    let arc = 1.3 * radius;
    vec![
        Mark::Angle { class: "roller", corner: centre, from: outward, to: drive, radius: arc, text },
        label(drive, "path"),
        label(outward, "normal"),
    ]
}

/// Horizontal and vertical axis through the origin, somewhat longer than what they cross.
#[must_use]
pub fn axes(crossed: &Extents) -> Vec<SheetShape> {
    let beyond = AXIS_BEYOND * crossed.size().max();
    vec![
        SheetShape::Line(Vector2::new(crossed.least.x - beyond, 0.0), Vector2::new(crossed.largest.x + beyond, 0.0)),
        SheetShape::Line(Vector2::new(0.0, crossed.least.y - beyond), Vector2::new(0.0, crossed.largest.y + beyond)),
    ]
}

/// A travel, m, for a text: "x = 12.34 mm".
#[must_use]
pub fn travelled(machine: &Machine, travel: f64) -> String {
    match machine.units() {
        LengthUnit::Millimetre => format!("x = {:.2} mm", MILLIMETRES * travel),
        LengthUnit::Inch => format!("x = {} in", LengthUnit::Inch.cell(MILLIMETRES * travel)),
    }
}

/// Length and height of an outline, as dimensions to its left and below.
#[must_use]
pub fn overall(outline: &Extents, units: LengthUnit) -> Vec<Mark> {
    let (least, largest) = (outline.least, outline.largest);
    let text = |length: f64| units.dimension((length * 1e3).round() / 1e3);
    vec![
        Mark::Distance {
            from: least,
            to: Vector2::new(largest.x, least.y),
            away: Vector2::new(0.0, -1.0),
            text: text(largest.x - least.x),
        },
        Mark::Distance {
            from: least,
            to: Vector2::new(least.x, largest.y),
            away: Vector2::new(-1.0, 0.0),
            text: text(largest.y - least.y),
        },
    ]
}

/// " H7 +0.021/0": a tolerance class with its deviations at a size (m), in a unit.
fn fit_words(fit: HoleFit, size: f64, units: LengthUnit) -> String {
    match fit.deviations(size) {
        Some(limits) => format!(" {fit} {}", units.limits(limits.map(|limit| MILLIMETRES * limit))),
        None => format!(" {fit}"),
    }
}

/// The standard of the zone of a profile on a drawing in a unit.
fn zone_standard(units: LengthUnit) -> &'static str {
    match units {
        LengthUnit::Millimetre => "ISO 1101",
        LengthUnit::Inch => "ASME Y14.5",
    }
}

/// A given zone of the profile as a note, for a body whose drawing has no place for the frame.
#[must_use]
pub fn tolerance_note(machine: &Machine) -> Vec<Text> {
    let units = machine.units();
    let width = machine.title.profile_tolerance.map(|width| units.zone(MILLIMETRES * width));
    width
        .map(|width| {
            text!(
                "all profiles within a zone of {} {} about the drawn ones ({})",
                width,
                units.symbol(),
                zone_standard(units)
            )
        })
        .into_iter()
        .collect()
}

/// The frame of the zone of a profile at one of some places of it, each with the direction outwards, with the datums that the machine's part has.
pub(crate) fn tolerance_frame(
    machine: &Machine,
    tolerance: PartTolerance,
    places: Vec<(Vector2<f64>, Vector2<f64>)>,
    second_datum: Option<&'static str>,
) -> Mark {
    let datums = [machine.cam.bore_radius.map(|_| "A"), machine.cam.bore_radius.and(second_datum)];
    let width = machine.units().zone(MILLIMETRES * tolerance.width);
    let cells = std::iter::once(width).chain(datums.into_iter().flatten().map(str::to_owned)).collect();
    Mark::Tolerance(FeatureFrame {
        places,
        above: String::new(),
        sign: Some(ToleranceSign::ProfileAllAround),
        cells,
        behind: String::new(),
        datum: None,
    })
}

fn size_with(fit: bool, length: f64, units: LengthUnit) -> String {
    if fit { units.toleranced(length) } else { units.dimension(length) }
}

/// The sizes and the place of a keyway in a bore of a radius, m.
fn keyway_words(machine: &Machine, bore: f64, keyway: &Keyway) -> String {
    let units = machine.units();
    let fit = machine.cam.keyway_fit.map(|fit| fit_words(fit, keyway.width, units)).unwrap_or_default();
    let standard = parallel_key::standard(2.0 * bore, keyway.width, keyway.depth);
    let deeper = standard.map(|standard| format!(" +{}", units.zone(MILLIMETRES * standard.deeper)));
    format!(
        "keyway {}{fit}, {}{} over the bore, at θ = {}°{}",
        size_with(machine.cam.keyway_fit.is_some(), MILLIMETRES * keyway.width, units),
        size_with(standard.is_some(), MILLIMETRES * (2.0 * bore + keyway.depth), units),
        deeper.unwrap_or_default(),
        rounded(keyway.angle.to_degrees()),
        standard.map_or("", |_| ", DIN 6885-1"),
    )
}

/// The keyway in words, for a sheet that does not show the bore from its end.
fn keyway_note(machine: &Machine) -> Option<Text> {
    let (bore, keyway) = (machine.cam.bore_radius?, machine.cam.keyway?);
    Some(text!("{}.", keyway_words(machine, bore, &keyway).replacen('k', "K", 1)))
}

/// The notes on profiles and keyway, of a body whose views do not show the keyway.
pub(crate) fn notes(machine: &Machine) -> Vec<Text> {
    tolerance_note(machine).into_iter().chain(keyway_note(machine)).collect()
}

/// Bore with its keyway, which are the datums, and balance holes, by their names.
#[must_use]
pub fn bore(machine: &Machine, balancing: Option<&Balancing>) -> Vec<Mark> {
    let mut marks = Vec::new();
    let Some(bore) = machine.cam.bore_radius else { return marks };
    let units = machine.units();
    let radius = MILLIMETRES * bore;
    let down_right = Vector2::new(0.6, -0.8);
    let fit = machine.cam.bore_fit.map(|fit| fit_words(fit, 2.0 * bore, units)).unwrap_or_default();
    marks.push(Mark::Label {
        class: "dimension",
        at: down_right * radius,
        towards: down_right,
        text: format!("Ø{}{fit}", size_with(machine.cam.bore_fit.is_some(), 2.0 * radius, units)),
    });
    let down_left = Vector2::new(-0.6, -0.8);
    marks.push(Mark::Datum { at: down_left * radius, towards: down_left, letter: "A" });
    if let Some(keyway) = machine.cam.keyway {
        let along = Vector2::new(libm::cos(keyway.angle), libm::sin(keyway.angle));
        let along = point_as_turned(machine, along);
        let (width, depth) = (MILLIMETRES * keyway.width, MILLIMETRES * keyway.depth);
        // Off the axis, which its leader would lie on.
        let (sin, cos) = libm::sincos(0.4);
        let towards = Vector2::new(along.x * cos - along.y * sin, along.x * sin + along.y * cos);
        marks.push(Mark::Label {
            class: "dimension",
            at: along * (radius + depth),
            towards,
            text: keyway_words(machine, bore, &keyway),
        });
        let side = Vector2::new(-along.y, along.x);
        marks.push(Mark::Datum {
            at: along * (radius + 0.5 * depth) + side * (0.5 * width),
            towards: side,
            letter: "B",
        });
    }
    let holes = balancing.map_or(&[][..], |balancing| balancing.holes.as_slice());
    marks.extend(holes.iter().map(|(centre, radius)| Mark::Label {
        class: "dimension",
        at: centre + Vector2::new(*radius, 0.0),
        towards: Vector2::new(1.0, 0.3),
        text: format!("Ø{}", units.dimension(2.0 * radius)),
    }));
    marks
}

/// How a cam turns, about its bore, and where its angle begins and how it grows, on a profile radius.
#[must_use]
pub fn turning(machine: &Machine, base: f64, profile: f64, zero: &str) -> Vec<Mark> {
    let bore = MILLIMETRES * machine.cam.bore_radius.unwrap_or(0.0);
    let (sense, way) = match machine.cam.rotation {
        Rotation::Clockwise => (-1.0, "clockwise"),
        Rotation::CounterClockwise => (1.0, "counter-clockwise"),
    };
    let right = Vector2::new(1.0, 0.0);
    vec![
        Mark::Turning {
            class: "rotation",
            arcs: vec![TurningArc {
                radius: 0.5 * (bore + base),
                from_deg: 135.0 - sense * 35.0,
                sweep_deg: sense * 70.0,
            }],
            text: format!("turns {way}"),
        },
        // The angle of the drawing grows against the rotation.
        Mark::Turning {
            class: "axis",
            arcs: vec![TurningArc { radius: 0.82 * profile.max(bore), from_deg: 0.0, sweep_deg: -sense * SENSE_DEG }],
            text: "θ".into(),
        },
        Mark::Label { class: "axis", at: right * profile, towards: Vector2::new(1.0, 0.4), text: zero.into() },
    ]
}

/// Rows of the finer table of the profile, and places of the motion between which a ray is looked for.
const ROWS: u32 = 72;
const CELLS: u32 = 720;

/// Degrees between the rows of a table of profiles, and every how many of its rows they are: the finest first.
const EVERY: [(u32, usize); 4] = [(5, 1), (10, 2), (15, 3), (30, 6)];

/// The polar angles of a table of profiles, degrees, and the directions there.
pub(crate) fn rays_of() -> (Vec<f64>, Vec<Vector2<f64>>) {
    let angles: Vec<f64> = (0..ROWS).map(|index| 360.0 * f64::from(index) / f64::from(ROWS)).collect();
    let ray = |degrees: &f64| {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        Vector2::new(cos, sin)
    };
    let rays = angles.iter().map(ray).collect();
    (angles, rays)
}

/// A cell of a table; a dash where there is no value.
fn cell(value: Option<f64>, decimals: usize) -> String {
    value.map_or("–".to_owned(), |value| format!("{:.decimals$}", value + 0.0))
}

/// A length, mm, as a cell of a table in a unit; a dash where there is no value.
#[must_use]
pub fn length_cell(value: Option<f64>, units: LengthUnit) -> String {
    value.map_or("–".to_owned(), |value| units.cell(value))
}

/// The profiles of several sections as a shop plots them: R of each at the polar angles ψ, with the head of its column.
#[must_use]
pub fn section_profiles(sections: &[(String, &Contour)], units: LengthUnit) -> Vec<PlaceTable> {
    let (angles, rays) = rays_of();
    let radii: Vec<Vec<Option<f64>>> = sections.iter().map(|(_, contour)| polar::outermost(contour, &rays)).collect();
    let row = |(index, degrees): (usize, &f64)| {
        let of = |radii: &Vec<Option<f64>>| length_cell(radii.get(index).copied().flatten(), units);
        PlaceRow::regular(index, std::iter::once(cell(Some(*degrees), 0)).chain(radii.iter().map(of)).collect())
    };
    let rows: Arc<[PlaceRow]> = angles.iter().enumerate().map(row).collect();
    let heads: Vec<String> =
        std::iter::once("ψ, °".to_owned()).chain(sections.iter().map(|(head, _)| head.clone())).collect();
    let table = |(degrees, every): &(u32, usize)| PlaceTable {
        title: format!("Profiles of the sections: radius R, {}, at polar angle ψ, each {degrees}°", units.symbol()),
        remarks: Vec::new(),
        heads: heads.clone(),
        rows: Arc::clone(&rows),
        every: *every,
    };
    EVERY.iter().map(table).collect()
}

/// A cam seen from the side: its thickness from a place on the sheet (x, mm), with the bore of a radius hidden.
#[must_use]
pub fn side_view(
    left: f64,
    outline: &Extents,
    (thickness, units): (f64, LengthUnit),
    bore: Option<f64>,
) -> (Vec<ShapeGroup>, Vec<Mark>) {
    let (low, high) = (Vector2::new(left, outline.least.y), Vector2::new(left + thickness, outline.largest.y));
    let across =
        |y: f64, beyond: f64| SheetShape::Line(Vector2::new(low.x - beyond, y), Vector2::new(high.x + beyond, y));
    let along = |x: f64| SheetShape::Line(Vector2::new(x, low.y), Vector2::new(x, high.y));
    let edges = vec![across(low.y, 0.0), across(high.y, 0.0), along(low.x), along(high.x)];
    let hidden: Vec<SheetShape> = bore.iter().flat_map(|radius| [across(*radius, 0.0), across(-radius, 0.0)]).collect();
    let groups = vec![
        ShapeGroup::new("side", "side view", edges),
        ShapeGroup::new("hidden", "hidden edges", hidden),
        ShapeGroup { id: "side-axis".into(), ..ShapeGroup::new("axis", "axis", vec![across(0.0, 0.25 * thickness)]) },
    ];
    let size = Mark::Distance {
        from: low,
        to: Vector2::new(high.x, low.y),
        away: Vector2::new(0.0, -1.0),
        text: units.dimension(thickness),
    };
    (groups, vec![size])
}

/// The tables of places of the drawing, from the finest to the coarsest.
pub(crate) fn tables_of(title: &str, heads: &[String], remarks: &[String], rows: Vec<PlaceRow>) -> Vec<PlaceTable> {
    let rows: Arc<[PlaceRow]> = rows.into();
    let table = |(_, every): &(u32, usize)| PlaceTable {
        title: title.to_owned(),
        heads: heads.to_vec(),
        remarks: remarks.to_vec(),
        rows: Arc::clone(&rows),
        every: *every,
    };
    EVERY.iter().map(table).collect()
}

/// The cam angle, rad, at which the follower touches the profile on each ray; of several the one whose radius is nearest to that of the
/// outline.
pub(crate) fn touched(
    machine: &Machine,
    curves: Curves<'_>,
    rays: &[Vector2<f64>],
    radii: &[Option<f64>],
) -> Vec<Option<f64>> {
    let point = |at: f64| {
        let (piece, angle) = curves.motion.locate(at);
        point_as_turned(machine, curves.profile(piece, angle).point * MILLIMETRES)
    };
    let angle = |index: u32| std::f64::consts::TAU * f64::from(index) / f64::from(CELLS);
    let points: Vec<Vector2<f64>> = (0..=CELLS).map(|index| point(angle(index))).collect();
    let on_ray = |(ray, radius): (&Vector2<f64>, &Option<f64>)| {
        let radius = (*radius)?;
        let cells = (0..CELLS).zip(points.windows(2)).filter_map(|(index, ends)| {
            let [a, b] = <[Vector2<f64>; 2]>::try_from(ends).ok()?;
            polar::crossing(point, [angle(index), angle(index + 1)], [a, b], *ray)
        });
        let apart = |at: f64| (point(at).norm() - radius).abs();
        cells.map(|at| (at, apart(at))).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(at, _)| at)
    };
    rays.iter().zip(radii).map(on_ray).collect()
}

/// What the follower of a plane cam does on its outline: its acceleration with that of the motion, and the torque of the shaft, with a
/// second disc on it that of both.
#[must_use]
pub fn traces(first: torque::DiscOutline<'_>, second: Option<torque::DiscOutline<'_>>) -> Vec<Trace> {
    let (Some(curves), Some(followed)) = (curves_of(first.0), torque::followed(first)) else { return Vec::new() };
    std::iter::once(acceleration(curves, &followed, first.0.machine().units()))
        .chain(torque::trace(first.0, &followed, second))
        .collect()
}

fn acceleration(curves: Curves<'_>, followed: &FollowerOnChain<'_>, units: LengthUnit) -> Trace {
    let turns = curves.motion.period().is_some();
    let swings = curves.motion.quantity() == Quantity::Angle;
    let by_travel = curves.motion.is_by_travel();
    let place = if turns { 1.0_f64.to_degrees() } else { units.of_mm(1e3) };
    let symbol = units.symbol();
    let (value, unit) = match (swings, by_travel) {
        (true, _) => (1.0, "rad/rad²".to_owned()),
        (false, true) => (units.of_mm_to(1e-3, -1), format!("{symbol}/{symbol}²")),
        (false, false) => (units.of_mm(1e3), format!("{symbol}/rad²")),
    };
    let points = followed.accelerations(TRACE_SHARE);
    Trace {
        head: format!("Follower's acceleration, {unit}: motion (thin), as cut (bold)"),
        places: match (turns, by_travel, units) {
            (true, ..) => "cam angle, deg",
            (false, true, LengthUnit::Millimetre) => "travel of the plate, mm",
            (false, true, LengthUnit::Inch) => "travel of the plate, in",
            (false, false, LengthUnit::Millimetre) => "overrun of the bed, mm",
            (false, false, LengthUnit::Inch) => "overrun of the bed, in",
        },
        step: match (turns, units) {
            (true, _) => 30.0,
            (false, LengthUnit::Millimetre) => 20.0,
            (false, LengthUnit::Inch) => 1.0,
        },
        period: turns.then_some(360.0),
        points: points.into_iter().map(|[at, motion, cut]| [place * at, value * motion, value * cut]).collect(),
    }
}

/// A stretch of a curve that nobody may overlook.
pub(crate) fn lost_motion(stretches: Vec<Vec<Vector2<f64>>>) -> Option<ShapeGroup> {
    let shapes: Vec<SheetShape> = stretches.into_iter().map(SheetShape::Path).collect();
    (!shapes.is_empty()).then(|| ShapeGroup::new("lost-motion", "motion that is lost", shapes).with_legend())
}

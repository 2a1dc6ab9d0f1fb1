//! An old cam as a design: its lift from a table, from an outline or from measured points, its dwells and laws, and the design file that makes it anew.

mod centre;
mod design;
mod measured_points;
mod model;
mod motion;
mod plateaus;
mod positions;
mod recognise;
mod report;
mod rolled;
mod round;
mod sought;
mod spline;

use super::compare::measured::PointsOf;
use super::{Analysis, Picture};
use crate::body::Kind;
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::machine::{Machine, Rotation};
use crate::report::{Bound, Speeds, sha256};
use camgen_kernel::document::{Input, LengthOrAngle, cams};
use camgen_kernel::follower::{Element, FOLLOWERS, Follower};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::motion::laws::{LAWS, Law};
use camgen_kernel::motion::program::rows::TableRows;
use camgen_kernel::motion::{Jet, Motion, Quantity};
use camgen_kernel::numeric::outlier::Sensitivity;
use camgen_kernel::refusal::Refusal;
use design::Design;
use motion::{FoundMotion, found};
use nalgebra::Vector2;
use positions::{FEWEST, Positions};
use report::Imported;
use sought::Sought;

/// The import.
pub const KIND: Kind = Kind { command: "import", noun: "import of an old cam", keys: cams::MAKE };

/// The check.
pub const DEVIATION: Check = Check {
    name: "import_deviation",
    on: CheckScope::Analysis,
    unit: "mm",
    about: "The largest distance of an imported position of the follower from that of the design, along its path or the arc of its arm.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |position of the design − imported position|",
        usual: "--deviation; without it 0.7 of the rounding of a table, five times the noise of points, 10 um of an outline",
        change: "permit more with --deviation, or leave --law out, so that what no law follows becomes a spline",
    },
};

/// Deviations that are allowed where none is given: in steps of the rounding, in standard deviations of the noise, of an outline, and at least, m.
const OF_ROUNDING: f64 = 0.7;
const OF_NOISE: f64 = 5.0;
const OF_OUTLINE: f64 = 10e-6;
const LEAST_OF_TABLE: f64 = 0.5e-6;
const LEAST_OF_POINTS: f64 = 1e-6;
/// Noise above this share of a step is not that of rounding.
const BEYOND_ROUNDING: f64 = 0.5;
/// How a cam is assumed to turn where it is not said.
const ROTATION: (&str, &str) = ("cam.rotation", "cw");
/// Times that the centre is found anew.
const CENTRED: usize = 3;
/// Round base radii, mm, and how far off one may be, over what is left of the positions and at least, mm.
const ROUND_RADII: [f64; 8] = [1.0, 0.5, 0.1, 0.05, 0.01, 0.005, 0.001, 1e-4];
const OF_LEFT: f64 = 0.3;
const LEAST_OFF: f64 = 1e-4;
/// Farthest position, m.
const LARGEST: f64 = 100.0;
/// The follower of a lift table where none is given.
const USUAL_FOLLOWER: (&str, &str) = ("roller", "30 mm");

/// What is imported.
#[derive(Debug, Clone)]
pub enum ImportSource {
    /// The rows of a lift table.
    Table(TableRows),
    /// An outline as it lies in its drawing, about the shaft, mm, with what was told of it.
    Outline(Contour, Vec<String>),
    /// Measured points, mm: centres of a ball of this radius, mm, or with 0 points of the profile.
    Points(Vec<Vector2<f64>>, f64),
}

/// What may be moved of measured points, or turned of an outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImportFit {
    /// Nothing: the cam lies as in its drawing.
    Nothing,
    /// The first rise begins at 0 degrees.
    Angle,
    /// That, and the centre is that of the dwells.
    Centre,
}

impl camgen_kernel::document::NamedChoice for ImportFit {
    const ALL: &'static [(&'static str, Self)] =
        &[("angle", Self::Angle), ("centre", Self::Centre), ("center", Self::Centre), ("none", Self::Nothing)];
}

/// How it is imported.
#[derive(Debug, Clone, Default)]
pub struct ImportOptions {
    /// The name of the design, and of what it is imported from.
    pub name: String,
    /// The file.
    pub source: String,
    /// The kind of follower; a roller of a table where it is not given.
    pub follower: Option<String>,
    /// Keys of the design, `follower.roller.diameter=24mm`: of the follower, the cam and everything but the motion.
    pub settings: Vec<String>,
    /// The laws that may be recognised; all where none is given.
    pub laws: Vec<&'static Law>,
    /// No law is recognised: the motion is only smoothed.
    pub only_spline: bool,
    /// Whether what no law follows becomes a spline.
    pub spline: bool,
    /// Largest deviation.
    pub deviation: Option<LengthOrAngle>,
    /// Speed of the cam, rpm.
    pub rpm: Option<f64>,
    /// Fitted offsets; if absent, the angle, except for points with their own angles.
    pub fit: Option<ImportFit>,
    /// The curve of the points; on the roller-centre path the ball radius is the roller radius.
    pub points_of: Option<PointsOf>,
    /// The points have their own angles, so the cam is not rotated.
    pub has_angles: bool,
}

impl ImportOptions {
    /// The keys of the follower and its table among the settings.
    #[must_use]
    pub fn follower_settings(&self) -> Vec<String> {
        self.settings.iter().filter(|key| key.trim_start().starts_with("follower.")).cloned().collect()
    }
}

/// The kind of follower of these options.
fn kind_of(options: &ImportOptions) -> Result<&'static camgen_kernel::follower::FollowerKind, Refusal> {
    let wanted = options.follower.as_deref().unwrap_or(USUAL_FOLLOWER.0);
    let name = |kind: &camgen_kernel::follower::FollowerKind| kind.section.path.rsplit('.').next().unwrap_or_default();
    FOLLOWERS.iter().find(|kind| name(kind).eq_ignore_ascii_case(wanted)).ok_or_else(|| {
        let known: Vec<&str> = FOLLOWERS.iter().map(name).collect();
        let near = camgen_kernel::document::similar(wanted, known.iter().copied());
        let near = near.map_or(String::new(), |name| format!("did you mean {name}? It is "));
        Refusal::new(format!("there is no follower {wanted}")).remedy(format!("{near}one of {}", known.join(", ")))
    })
}

/// The text of a file with this follower and any motion, against which keys of the design and rows of a table are read.
///
/// # Errors
/// [`Refusal`] where there is no such follower.
pub fn frame(options: &ImportOptions) -> Result<String, Refusal> {
    let kind = kind_of(options)?;
    let unit = if kind.swings() { "deg" } else { "mm" };
    let diameter =
        if options.follower.is_none() { format!("diameter = \"{}\"\n", USUAL_FOLLOWER.1) } else { String::new() };
    Ok(format!("name = \"import\"\n[motion]\nstart = \"0 {unit}\"\n[{}]\n{diameter}[cam]\n", kind.section.path))
}

/// The machine of the follower and the other keys, with any motion.
fn machine(options: &ImportOptions) -> Result<Machine, Refusal> {
    let kind = kind_of(options)?;
    let unit = if kind.swings() { "deg" } else { "mm" };
    let text = format!("{}[motion.fourier]\ncos = [1]\n", frame(options)?);
    let settings: Vec<String> = options.settings.clone();
    if let Some(key) = settings.iter().find(|key| key.trim_start().starts_with("motion")) {
        let what = format!("`{key}` is a key of the motion, which is what is imported ({unit} by the cam angle)");
        return Err(Refusal::new(what).remedy("set keys of the follower, the cam and the limits; the speed is --rpm"));
    }
    Machine::from_toml("import", &text, &settings).map_err(Refusal::of)
}

/// The design of an old cam.
///
/// # Errors
/// [`Refusal`] where the follower or a key is not right, the follower cannot run on the cam, or a row or point is an outlier.
pub fn analysis(source: &ImportSource, options: &ImportOptions) -> Result<Analysis, Refusal> {
    let given = options.follower.is_some();
    if !given && !matches!(source, ImportSource::Table(_)) {
        let what = "the lift of an outline or of points needs the follower that ran on it";
        return Err(Refusal::new(what).remedy("give it, e.g. --follower roller,diameter=24mm, or with a pivot --follower swinging-roller,diameter=32mm,arm=110mm,pivot_distance=140mm"));
    }
    let machine = machine(options)?;
    let (source, options) = (&on_curve(source, &machine, options)?, &placed(options));
    let mut imported = best(source, &machine, options)?;
    // Points about another centre than that of the dwells follow no law.
    let is_centred = options.fit == Some(ImportFit::Centre);
    if let (ImportSource::Points(..), false, splines @ 1..) = (source, is_centred, imported.splines()) {
        let centred = best(source, &machine, &ImportOptions { fit: Some(ImportFit::Centre), ..options.clone() });
        let fewer = centred.ok().filter(|centred| centred.splines() < splines);
        imported
            .told
            .extend(fewer.and_then(|centred| Some(other_centre((splines, centred.splines()), centred.shift?))));
    }
    if let (ImportSource::Points(..), true) = (source, is_centred) {
        let about_zero = best(source, &machine, &ImportOptions { fit: Some(ImportFit::Angle), ..options.clone() });
        // Short dwells do not fix a centre. A centre is wrong where fewer stretches follow a law about it than about (0, 0).
        let worse = imported.found.whole || about_zero.is_ok_and(|own| own.splines() < imported.splines());
        if let (true, Some(shift)) = (worse, imported.shift) {
            let what = format!(
                "the dwells are too short for a centre: the one that was found, ({:.4}, {:.4}) mm, leaves more of the motion without a law than (0, 0)",
                shift.x, shift.y
            );
            return Err(
                Refusal::new(what).remedy("leave --fit centre out, or measure longer dwells or more points of them")
            );
        }
    }
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs(KIND.keys).into_iter().filter(|input| !input.key.starts_with("motion")));
    let rows: Vec<String> =
        imported.rows.angles.iter().zip(&imported.rows.values).map(|(at, value)| format!("{at} {value}")).collect();
    inputs.push(Input::word("positions", sha256(rows.join("\n").as_bytes())));
    inputs.push(Input::number("deviation", imported.deviation));
    inputs.push(Input::word("laws", laws(options).iter().map(|law| law.name).collect::<Vec<_>>().join(", ")));
    Ok(Analysis {
        kind: &KIND,
        variant: "",
        machine: options.name.clone(),
        speeds: options.rpm.map_or(Speeds::Any(()), Speeds::One),
        inputs,
        measures: vec![imported.measure()],
        notes: imported.notes(given),
        tables: vec![("", imported.table())],
        by: &[],
        along: "cam_deg",
        picture: Picture::Curves(imported.plot(&options.name)),
        mechanism: None,
        document: Some(imported.text.clone()),
        diagrams: &[],
        not_modelled: Vec::new(),
        sections: vec![imported.section()],
    })
}

/// Reads points of the roller-centre path as centres of a ball with the roller's radius.
fn on_curve(source: &ImportSource, machine: &Machine, options: &ImportOptions) -> Result<ImportSource, Refusal> {
    let (ImportSource::Points(points, _), Some(PointsOf::Centre)) = (source, options.points_of) else {
        return Ok(source.clone());
    };
    let Element::Roller { radius } = machine.follower.shape.element() else {
        let what = format!("[{}] has no roller, so the points cannot be its centres", machine.follower.path);
        return Err(Refusal::new(what).remedy("give the follower that ran on the cam, or --as profile"));
    };
    Ok(ImportSource::Points(points.clone(), MILLIMETRES * radius))
}

/// Options without an angle fit if points or a keyway have their own angles.
fn placed(options: &ImportOptions) -> ImportOptions {
    let keyed = options.settings.iter().any(|key| key.trim_start().starts_with("cam.keyway"));
    let stays = options.fit.is_none() && (options.has_angles || keyed);
    ImportOptions { fit: if stays { Some(ImportFit::Nothing) } else { options.fit }, ..options.clone() }
}

/// The design by these options, through all positions as one spline where splines between rests leave too much.
fn best(source: &ImportSource, machine: &Machine, options: &ImportOptions) -> Result<Imported, Refusal> {
    let import = |whole: bool| {
        let imported = match source {
            ImportSource::Table(rows) => of_table(rows, machine, (options, whole))?,
            ImportSource::Outline(contour, told) => of_outline((contour, told), machine, (options, whole))?,
            ImportSource::Points(points, ball) => of_points((points, *ball), machine, (options, whole))?,
        };
        designed(imported, machine, options)
    };
    let imported = import(false)?;
    // The motion may not quite rest where a rest was taken.
    let whole = options.spline && imported.left.largest > imported.deviation && !imported.found.whole;
    if whole { import(true) } else { Ok(imported) }
}

/// A centre (mm) about which more of the motion follows laws than about the given one: splines of both.
fn other_centre((splines, left): (usize, usize), centre: Vector2<f64>) -> String {
    let shown = |value: f64| format!("{:.4}", value + 0.0);
    format!(
        "the cam may turn about another point than (0, 0): about ({}, {}) mm, {left} instead of {splines} stretches follow no law; try --fit centre",
        shown(centre.x),
        shown(centre.y)
    )
}

/// The laws that may be recognised.
fn laws(options: &ImportOptions) -> Vec<&'static Law> {
    if options.only_spline {
        Vec::new()
    } else if options.laws.is_empty() {
        LAWS.iter().collect()
    } else {
        options.laws.clone()
    }
}

/// The deviation as it was asked for, m or rad.
fn asked(options: &ImportOptions, quantity: Quantity, leverage: f64) -> Result<Option<f64>, Refusal> {
    Ok(match (options.deviation, quantity) {
        (None, _) => None,
        (Some(LengthOrAngle::Length(length)), Quantity::Length) => Some(length),
        (Some(LengthOrAngle::Length(length)), Quantity::Angle) => Some(length / leverage),
        (Some(LengthOrAngle::Angle(angle)), Quantity::Angle) => Some(angle),
        (Some(LengthOrAngle::Angle(_)), Quantity::Length) => {
            let what = "the deviation is an angle, but the follower moves along a straight path";
            return Err(Refusal::new(what).remedy("give a length, such as --deviation 3um"));
        }
    })
}

/// Too few positions, a motion that never moves, or a position that is wrong.
fn checked(rows: &Positions, deviation: f64, rounding: Option<f64>, what: &str) -> Result<(), Refusal> {
    if rows.len() < FEWEST {
        return Err(Refusal::new(format!("there are {} {what}s", rows.len())).remedy(format!("give at least {FEWEST}")));
    }
    let (low, high) = rows.range();
    if rows.quantity == Quantity::Length && low.abs().max(high.abs()) > LARGEST {
        let found = MILLIMETRES * low.abs().max(high.abs());
        let refusal = Refusal::new(format!(
            "a position is {found:.3e} mm from 0, the farthest possible {} mm",
            MILLIMETRES * LARGEST
        ));
        return Err(refusal.remedy("give the unit of the positions, --unit um, or a factor, --scale 0.001"));
    }
    if high - low <= 2.0 * deviation {
        let found = design::told(rows.quantity, high - low);
        let refusal = Refusal::new(format!("the follower does not move: its positions differ by {found} only"));
        return Err(refusal.remedy("give rows of a lift, or a smaller --deviation"));
    }
    // Rows follow laws of motion; a profile may have any corners.
    let sensitivity = if rounding.is_some() { Sensitivity::Fine } else { Sensitivity::Coarse };
    if let Some((at, off)) = rows.outlier(deviation, (rounding.unwrap_or(0.0), sensitivity)) {
        let row = rows.rows.get(at % rows.len()).map_or(at, |row| *row) + 1;
        let (unit, size) = design::unit(rows.quantity);
        let angle = rows.angle(at).to_degrees();
        let refusal = Refusal::new(format!(
            "a {what} is {} {unit} off the motion of its neighbours",
            crate::report::shown(off / size)
        ));
        let place = format!("{what} {row}, at {} deg of the cam", crate::report::shown(angle));
        return Err(refusal.at(place).remedy("correct it, or begin its line with # to leave it out"));
    }
    Ok(())
}

fn leverage(follower: &dyn Follower) -> f64 {
    if follower.quantity() == Quantity::Angle { follower.leverage(&Jet::default()) } else { 1.0 }
}

/// A table of lifts.
fn of_table(
    table: &TableRows,
    machine: &Machine,
    (options, whole): (&ImportOptions, bool),
) -> Result<Imported, Refusal> {
    let rows = Positions {
        quantity: table.quantity,
        fill: table.fill,
        angles: table.angles.clone(),
        values: table.positions.clone(),
        by_shift: Vec::new(),
        rows: (0..table.angles.len()).collect(),
    };
    let leverage = leverage(&*machine.follower.shape);
    let noise = rows.noise();
    let of_rounding = OF_ROUNDING * table.rounding;
    let usual = if noise > BEYOND_ROUNDING * table.rounding { OF_NOISE * noise } else { of_rounding };
    let deviation = asked(options, rows.quantity, leverage)?.unwrap_or_else(|| usual.max(LEAST_OF_TABLE / leverage));
    checked(&rows, deviation, Some(table.rounding), "row")?;
    let any_turn = matches!(options.fit, Some(ImportFit::Angle | ImportFit::Centre));
    if options.fit == Some(ImportFit::Centre) {
        return Err(Refusal::new("a table of lifts has no centre").remedy("leave --fit centre out"));
    }
    let found = sought(&rows, (options, whole), deviation, (any_turn, false))?;
    let told = table.told.clone();
    Ok(Imported { leverage, rounding: table.rounding, told, ..Imported::new("table", rows, noise, deviation, found) })
}

fn sought(
    rows: &Positions,
    (options, whole): (&ImportOptions, bool),
    deviation: f64,
    (any_turn, from_lowest): (bool, bool),
) -> Result<FoundMotion, Refusal> {
    if whole {
        return Ok(FoundMotion::whole(rows, rows.range().0, Vec::new()));
    }
    let laws = laws(options);
    found(rows, &Sought { laws: &laws, spline: options.spline, deviation, any_turn, from_lowest })
}

/// An outline under a follower.
fn of_outline(
    (contour, told): (&Contour, &[String]),
    machine: &Machine,
    (options, whole): (&ImportOptions, bool),
) -> Result<Imported, Refusal> {
    let mirrored = machine.cam.rotation == Rotation::CounterClockwise;
    let contour = if mirrored { contour.mirrored_about_x() } else { contour.clone() };
    let least = contour.edges().map(|edge| edge.start().norm().min(edge.middle().norm())).fold(f64::INFINITY, f64::min);
    let follower = rolled::sized(&*machine.follower.shape, least / MILLIMETRES)?;
    let rows = rolled::on_outline(&contour, &*follower)?;
    let leverage = leverage(&*follower);
    let deviation = asked(options, rows.quantity, leverage)?.unwrap_or(OF_OUTLINE / leverage);
    checked(&rows, deviation, None, "place")?;
    if options.fit == Some(ImportFit::Centre) {
        let what = "the centre of an outline is the origin of its drawing";
        return Err(Refusal::new(what).remedy("move the drawing, or import points of it"));
    }
    let found = sought(&rows, (options, whole), deviation, (options.fit == Some(ImportFit::Angle), true))?;
    let noise = rows.noise();
    Ok(Imported {
        leverage,
        told: told.to_vec(),
        follower: Some(follower),
        ..Imported::new("outline", rows, noise, deviation, found)
    })
}

/// Measured points under a follower.
fn of_points(
    (points, ball): (&[Vector2<f64>], f64),
    machine: &Machine,
    (options, whole): (&ImportOptions, bool),
) -> Result<Imported, Refusal> {
    let mirrored = machine.cam.rotation == Rotation::CounterClockwise;
    let points: Vec<Vector2<f64>> =
        points.iter().map(|point| if mirrored { Vector2::new(point.x, -point.y) } else { *point }).collect();
    let fit = options.fit.unwrap_or(ImportFit::Angle);
    let mut shift = if fit == ImportFit::Centre { centre::centre(&points)? } else { Vector2::zeros() };
    for pass in 1.. {
        let placed: Vec<Vector2<f64>> = points.iter().map(|point| point - shift).collect();
        let least = placed.iter().map(Vector2::norm).fold(f64::INFINITY, f64::min) - ball;
        let normals = measured_points::normals(&placed)?;
        let radii = measured_points::radii(&placed);
        checked(&radii, (OF_NOISE * radii.noise()).max(LEAST_OF_POINTS), None, "point")?;
        let follower = rolled::sized(&*machine.follower.shape, least / MILLIMETRES)?;
        let mut rows = measured_points::positions(&normals, &*follower, ball)?;
        let centred = fit == ImportFit::Centre && pass < CENTRED;
        if !centred {
            rows.by_shift.clear();
        }
        let (leverage, noise) = (leverage(&*follower), rows.noise());
        let usual = (OF_NOISE * noise).max(LEAST_OF_POINTS / leverage);
        let deviation = asked(options, rows.quantity, leverage)?.unwrap_or(usual);
        checked(&rows, deviation, None, "point")?;
        let (from, to) = rows.widest_gap();
        let found = sought(&rows, (options, whole), deviation, (fit != ImportFit::Nothing, true))?;
        if centred {
            let [x, y] = found.model.shift;
            shift += MILLIMETRES * Vector2::new(x, y);
            continue;
        }
        let shown = if mirrored { Vector2::new(shift.x, -shift.y) } else { shift };
        let widest = (to - from).to_degrees();
        let imported = Imported::new("points", rows, noise, deviation, found);
        return Ok(Imported {
            leverage,
            shift: Some(shown),
            widest: Some(widest),
            ball,
            follower: Some(follower),
            ..imported
        });
    }
    Err(Refusal::new("no centre was found"))
}

/// The design of what was found, read back.
fn designed(mut imported: Imported, machine: &Machine, options: &ImportOptions) -> Result<Imported, Refusal> {
    let first = imported.found.model.nodes.first().copied().unwrap_or(0.0);
    let fit = options.fit.unwrap_or(if imported.form == "points" { ImportFit::Angle } else { ImportFit::Nothing });
    if fit != ImportFit::Nothing {
        imported.move_by(-first, 0.0);
    }
    let mut settings = settings(options)?;
    if let Some(follower) = imported.follower.take() {
        let lowest = imported.lowest();
        let radius = round_radius(&imported, rolled::base_radius(&*follower, lowest));
        imported.base_radius = Some(radius);
        imported.move_by(0.0, -lowest);
        settings.retain(|(key, _)| key != "cam.base_radius");
        if !settings.iter().any(|(key, _)| key == ROTATION.0) {
            settings.push((ROTATION.0.into(), design::quoted(ROTATION.1)));
            imported.told.push(
                "the cam is assumed to turn clockwise: an outline does not show it; --set cam.rotation=ccw imports it the other way".into(),
            );
        }
        settings.push(("cam.base_radius".into(), design::quoted(&format!("{radius} mm"))));
    }
    let deviation = imported.deviation;
    let (name, source, rpm, turn) = (&options.name, &options.source, options.rpm, imported.turn);
    let mut design = Design { name, source, rpm, settings: &settings, deviation, turn };
    let mut text = design.text(&imported.rows, &imported.found);
    let read = |text: &str| {
        Machine::from_toml("the design", text, &[])
            .map_err(|why| Refusal::of(why).context("the design that was found cannot be made"))
    };
    let mut made = read(&text)?;
    // A spline may go below its ends: the base radius belongs to the lowest position.
    let dip = made.program().and_then(Motion::origin).filter(|_| imported.base_radius.is_some()).unwrap_or(0.0);
    let mut lower = settings.clone();
    if let (Some(radius), true) = (imported.base_radius, dip.abs() > LEAST_OFF / MILLIMETRES / imported.leverage) {
        let follower = rolled::sized(&*machine.follower.shape, radius / MILLIMETRES)?;
        let own = follower.sized(radius / MILLIMETRES + follower.element().offset()).unwrap_or(follower);
        let radius = round_radius(&imported, rolled::base_radius(&*own, dip));
        imported.base_radius = Some(radius);
        lower.pop();
        lower.push(("cam.base_radius".into(), design::quoted(&format!("{radius} mm"))));
        design.settings = &lower;
        text = design.text(&imported.rows, &imported.found);
        made = read(&text)?;
    }
    let program = made.program().ok_or_else(|| Refusal::new("the design has no motion"))?;
    imported.compare(program);
    imported.text = text;
    Ok(imported)
}

/// A base radius (m) in mm, as a round number where that is near enough.
fn round_radius(imported: &Imported, radius: f64) -> f64 {
    let radius = MILLIMETRES * radius;
    let off = (OF_LEFT * MILLIMETRES * imported.leverage * imported.left.rms).max(LEAST_OFF);
    let to = |grid: f64| {
        let whole = (1.0 / grid).round();
        (radius * whole).round() / whole
    };
    ROUND_RADII.into_iter().map(to).find(|round| (round - radius).abs() <= off).unwrap_or_else(|| to(1e-4))
}

/// The keys of the design as TOML.
fn settings(options: &ImportOptions) -> Result<Vec<(String, String)>, Refusal> {
    let kind = kind_of(options)?;
    let mut all: Vec<(String, String)> = Vec::new();
    if options.follower.is_none() {
        all.push((format!("{}.diameter", kind.section.path), design::quoted(USUAL_FOLLOWER.1)));
    }
    for setting in &options.settings {
        let (key, value) = setting.split_once('=').ok_or_else(|| {
            Refusal::new(format!("`{setting}` is not KEY=VALUE")).remedy("e.g. follower.roller.diameter=24mm")
        })?;
        let (key, value) = (key.trim(), value.trim());
        let bare = value.parse::<f64>().is_ok_and(f64::is_finite)
            || ["true", "false"].contains(&value)
            || value.starts_with(['[', '"']);
        let value = if bare { value.to_owned() } else { design::quoted(value) };
        all.retain(|(other, _)| other != key);
        if key != "name" {
            all.push((key.to_owned(), value));
        }
    }
    let has = |table: &str| all.iter().any(|(key, _)| key.rsplit_once('.').is_some_and(|(own, _)| own == table));
    let missing: Vec<String> =
        [kind.section.path, "cam"].into_iter().filter(|table| !has(table)).map(str::to_owned).collect();
    all.extend(missing.into_iter().map(|table| (table, String::new())));
    Ok(all)
}

#[cfg(test)]
mod tests;

//! Buffers whose bottoms rest on springs instead of a cam. Equations (26) to (28), figure 11.

use super::at_speeds::CurveAxis;
use crate::press::MachineOfPress;
use crate::press::buffer::spring::{self, BrakedBed, SpringBuffer};
use crate::press::buffer::spring_body::SpringBody;
use crate::press::cams;
use crate::press::checks::{column, springs};
use crate::press::load::ColumnAtSpeed;
use crate::press::machine::{Press, PressCams};
use crate::press::report::CylinderMeasures;
use camgen_cams::analysis::{Analysis, PLACES, Picture, places};
use camgen_cams::body::Kind;
use camgen_cams::check::Measure;
use camgen_cams::machine::Machine;
use camgen_cams::report::ReportLine;
use camgen_cams::report::plot::{Plot, PlotCurve, PlotPanel, figure};
use camgen_cams::report::{Section, Speeds, SummaryColumn, SummaryTable, length_cell, number_cell, shown};
use camgen_cams::table::{ListedColumn, Table};
use camgen_kernel::document::Input;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::refusal::{Refusal, WorkBound};
use camgen_kernel::text::{DIGITS, LengthKind, Text, Value, nominal, text};
use serde::Serialize;

/// Pneumatic-spring buffers.
pub const KIND: Kind = Kind { command: "spring", noun: "pneumatic-spring buffer", keys: cams::SPRING };

/// Springs of one call, each at a speed.
const SETS: WorkBound = WorkBound { what: "springs at a speed", most: 1000 };
/// Default stiffnesses / least stiffness: near the paper's figure.
const USUAL: [f64; 3] = [1.125, 1.375, 2.75];

fn braked_by(press: &Press) -> BrakedBed {
    BrakedBed { bed: press.bed, linkage: press.stroke_end }
}

/// The figures of a spring at a speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct SpringSet {
    stiffness_n_per_mm: f64,
    spring_travel_mm: f64,
    air_length_mm: f64,
    residual_max_n: f64,
    rpm: f64,
    compressed_length_mm: f64,
    residual_at_mm: f64,
    screw_mm: Option<f64>,
    spring_force_max_n: f64,
}

const COLUMNS: &[ListedColumn<SpringSet>] = &[
    ("stiffness_n_per_mm", |row| row.stiffness_n_per_mm),
    ("spring_travel_mm", |row| row.spring_travel_mm),
    ("air_length_mm", |row| row.air_length_mm),
    ("residual_max_n", |row| row.residual_max_n),
    ("rpm", |row| row.rpm),
    ("compressed_length_mm", |row| row.compressed_length_mm),
    ("residual_at_mm", |row| row.residual_at_mm),
    ("screw_mm", |row| row.screw_mm.unwrap_or(f64::NAN)),
    ("spring_force_max_n", |row| row.spring_force_max_n),
];

/// A point of a curve.
struct SpringRow {
    stiffness: f64,
    rpm: f64,
    /// Crank angle from the start of the reversal, rad.
    crank: f64,
    x: f64,
    inertia: f64,
    air: f64,
    residual: f64,
    travel: f64,
}

const CURVES: &[ListedColumn<SpringRow>] = &[
    ("stiffness_n_per_mm", |row| row.stiffness / MILLIMETRES),
    ("rpm", |row| row.rpm),
    ("x_mm", |row| MILLIMETRES * row.x),
    ("inertia_n", |row| row.inertia),
    ("air_n", |row| row.air),
    ("residual_n", |row| row.residual),
    ("spring_travel_mm", |row| MILLIMETRES * row.travel),
];

/// Under a linkage the bed passes one position with two forces: the curves run along the crank angle.
const CURVES_OF_A_LINKAGE: &[ListedColumn<SpringRow>] = &[
    ("stiffness_n_per_mm", |row| row.stiffness / MILLIMETRES),
    ("rpm", |row| row.rpm),
    ("crank_deg", |row| row.crank.to_degrees()),
    ("x_mm", |row| MILLIMETRES * row.x),
    ("inertia_n", |row| row.inertia),
    ("air_n", |row| row.air),
    ("residual_n", |row| row.residual),
    ("spring_travel_mm", |row| MILLIMETRES * row.travel),
];

/// The section `spring`.
#[derive(Debug, Serialize)]
struct Springs<'a> {
    #[serde(flatten)]
    cylinders: CylinderMeasures,
    least_stiffness_n_per_mm: f64,
    residual_fixed_bottom_max_n: f64,
    settings: &'a [SpringSet],
}

/// Buffers on springs of these stiffnesses (N/m), and of that which leaves a wanted residual force (N) at the design speed, at
/// some speeds of the main shaft (rpm; none: the design speed).
///
/// ```
/// use camgen::domains::press::analysis::spring;
/// use camgen::{Judged, Machine};
///
/// // Springs of 80 N/mm under the bottoms, and what they leave at 30 and 35 rpm.
/// let (machine, _) = Machine::load("dpi", &[])?;
/// let judged = Judged::new(spring::analysis(&machine, &[30.0, 35.0], &[80e3], None)?);
/// println!("{}", judged.report().title());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Refusal`] when the file has no press, a spring is too soft at one of the speeds, or none leaves that residual.
pub fn analysis(
    machine: &Machine,
    speeds: &[f64],
    stiffnesses: &[f64],
    residual: Option<f64>,
) -> Result<Analysis, Refusal> {
    let press = machine.press()?;
    let braked = braked_by(press);
    let (cylinder, own) = (press.cylinder(), [press.design_rpm]);
    let speeds = if speeds.is_empty() { &own[..] } else { speeds };
    let least = spring::least_stiffness(&braked, press.design_rpm);
    let mut all = stiffnesses.to_vec();
    if let Some(residual) = residual {
        all.push(spring::stiffness_for(residual, &braked, &cylinder, press.design_rpm)?);
    } else if all.is_empty() {
        let highest = speeds.iter().map(|rpm| spring::least_stiffness(&braked, *rpm)).fold(least, f64::max);
        all.extend(USUAL.map(|over| over * highest));
    }
    SETS.allow(all.len().saturating_mul(speeds.len()))?;
    let sets = sets_of(press, &all, speeds)?;
    let rows: Vec<SpringSet> = sets.iter().map(set_of).collect();
    let curves: Vec<SpringRow> = sets.iter().flat_map(|set| curve(press, set)).collect();
    let (curve_columns, along) = match press.stroke_end {
        None => (CURVES, "x_mm"),
        Some(_) => (CURVES_OF_A_LINKAGE, "crank_deg"),
    };
    let bodies = bodies_of(machine, &sets);
    let springs = Springs {
        cylinders: CylinderMeasures::new(cylinder.piston_area),
        least_stiffness_n_per_mm: least / MILLIMETRES,
        residual_fixed_bottom_max_n: spring::plain_residual(&braked, &cylinder, press.design_rpm).value,
        settings: &rows,
    };
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs(KIND.keys));
    inputs.extend([Input::numbers("rpm", speeds), Input::numbers("stiffness", stiffnesses)]);
    inputs.extend(residual.map(|residual| Input::quantity("residual", residual, ("N", 1.0))));
    Ok(Analysis {
        kind: &KIND,
        variant: "",
        machine: machine.name().to_owned(),
        speeds: Speeds::Several(speeds.to_vec()),
        inputs,
        sections: std::iter::once(
            Section::new(KIND.command, &springs)
                .with_words(describe(&springs, press))
                .with_answer(answer(&springs))
                .with_table(table(&springs)),
        )
        .chain(bodies.as_ref().map(|bodies| section_of_bodies(&bodies.rows)))
        .collect(),
        measures: measures(machine, &sets, bodies.as_ref()),
        notes: machine.idle_key_notes(KIND.keys, KIND.noun),
        picture: Picture::Curves(curves_of(
            machine.name(),
            press.design_rpm,
            springs.residual_fixed_bottom_max_n,
            &sets,
            &curves,
        )),
        mechanism: None,
        document: None,
        tables: std::iter::once(("", Table::listed(COLUMNS, &rows)))
            .chain(bodies.as_ref().map(|bodies| ("-bodies", Table::listed(BODIES, &bodies.rows))))
            .chain([("-curves", Table::listed(curve_columns, &curves))])
            .collect(),
        by: &["stiffness_n_per_mm", "rpm"],
        along,
        diagrams: &[],
        not_modelled: NOT_MODELLED.to_vec(),
    })
}

/// What checks judge: the columns, and the springs where the file describes them.
fn measures(machine: &Machine, sets: &[SpringAtSpeed], bodies: Option<&SpringBodies>) -> Vec<Measure> {
    let columns: Vec<ColumnAtSpeed> =
        sets.iter().map(|set| ColumnAtSpeed { length: set.spring.column, rpm: set.rpm }).collect();
    let of_bodies = bodies.map_or_else(Vec::new, SpringBodies::measures);
    column::measure_of_analysis(&columns, machine).into_iter().chain(of_bodies).collect()
}

/// A spring of a stiffness, for the largest force of all speeds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct SpringBodyRow {
    stiffness_n_per_mm: f64,
    force_max_n: f64,
    wire_mm: f64,
    coil_mm: f64,
    coils: f64,
    stress_mpa: f64,
    surge_hz: f64,
    crank_hz: f64,
    solid_length_mm: f64,
    free_length_mm: f64,
    buckling: f64,
}

const BODIES: &[ListedColumn<SpringBodyRow>] = &[
    ("stiffness_n_per_mm", |row| row.stiffness_n_per_mm),
    ("force_max_n", |row| row.force_max_n),
    ("wire_mm", |row| row.wire_mm),
    ("coil_mm", |row| row.coil_mm),
    ("coils", |row| row.coils),
    ("stress_mpa", |row| row.stress_mpa),
    ("surge_hz", |row| row.surge_hz),
    ("crank_hz", |row| row.crank_hz),
    ("solid_length_mm", |row| row.solid_length_mm),
    ("free_length_mm", |row| row.free_length_mm),
    ("buckling", |row| row.buckling),
];

/// The springs of each stiffness.
struct SpringBodies {
    rows: Vec<SpringBodyRow>,
    /// Allowable stress, Pa.
    allowable: f64,
}

/// `None` where the file does not describe the springs.
fn bodies_of(machine: &Machine, sets: &[SpringAtSpeed]) -> Option<SpringBodies> {
    let (data, bed) = (PressCams::of(machine).spring_body?, machine.bed()?);
    let fastest = sets.iter().map(|set| set.rpm).fold(0.0, f64::max);
    let crank_hz = bed.crank_speed(fastest) / std::f64::consts::TAU;
    let mut rows = Vec::new();
    for of_one in sets.chunk_by(|a, b| a.spring.stiffness == b.spring.stiffness) {
        let Some(first) = of_one.first() else { continue };
        let rate = first.spring.stiffness;
        let force = of_one.iter().map(|set| set.spring.spring_force_max).fold(0.0, f64::max);
        let body = SpringBody::new(data.shape, force, rate, data.stress);
        rows.push(SpringBodyRow {
            stiffness_n_per_mm: rate / MILLIMETRES,
            force_max_n: force,
            wire_mm: MILLIMETRES * body.wire,
            coil_mm: MILLIMETRES * body.coil,
            coils: body.coils,
            stress_mpa: 1e-6 * body.stress,
            surge_hz: body.surge,
            crank_hz,
            solid_length_mm: MILLIMETRES * body.solid_length,
            free_length_mm: MILLIMETRES * body.free_length,
            buckling: body.buckling,
        });
    }
    Some(SpringBodies { rows, allowable: data.stress })
}

fn section_of_bodies(rows: &[SpringBodyRow]) -> Section {
    let mut words = vec![ReportLine::row(format!(
        "{:>10} {:>10} {:>9} {:>9} {:>8} {:>10} {:>9} {:>9} {:>9}",
        "N/mm each", "N each", "wire/mm", "coil/mm", "coils", "stress/MPa", "surge/Hz", "solid/mm", "free/mm"
    ))];
    words.extend(rows.iter().map(|row| {
        ReportLine::row(format!(
            "{:>10.3} {:>10.1} {:>9.3} {:>9.2} {:>8.2} {:>10.1} {:>9.2} {:>9.1} {:>9.1}",
            row.stiffness_n_per_mm,
            row.force_max_n,
            row.wire_mm,
            row.coil_mm,
            row.coils,
            row.stress_mpa,
            row.surge_hz,
            row.solid_length_mm,
            row.free_length_mm
        ))
    }));
    Section::new("spring_bodies", &serde_json::json!({ "springs": rows })).with_words(words)
}

/// Rounding of the stress of a wire that is found for it.
const ROUNDING: f64 = 1e-12;

impl SpringBodies {
    fn measures(&self) -> Vec<Measure> {
        let rows = &self.rows;
        let largest = rows.iter().map(|row| row.stress_mpa).fold(0.0, f64::max);
        let slowest = rows.iter().map(|row| row.surge_hz / row.crank_hz).fold(f64::INFINITY, f64::min);
        let limit = 1e-6 * self.allowable;
        let bent = rows.iter().map(|row| row.buckling).fold(0.0, f64::max);
        let fewest_coils = rows.iter().map(|row| row.coils).fold(f64::INFINITY, f64::min);
        let least_index = rows.iter().map(|row| row.coil_mm / row.wire_mm).fold(f64::INFINITY, f64::min);
        let thickest = rows.iter().map(|row| row.wire_mm).fold(0.0, f64::max);
        let stress = springs::STRESS.measure(largest, Some(limit)).kept(largest <= limit * (1.0 + ROUNDING));
        std::iter::once(stress)
            .chain(springs::of_coils(fewest_coils, thickest, least_index))
            .chain([springs::SURGE.measure(slowest, Some(springs::LEAST_SURGE)), springs::of_buckling(bent)])
            .collect()
    }
}

/// A spring set for a speed.
struct SpringAtSpeed {
    rpm: f64,
    spring: SpringBuffer,
}

fn set_spring(press: &Press, stiffness: f64, rpm: f64) -> Result<SpringAtSpeed, Refusal> {
    let spring = spring::set_for(&braked_by(press), &press.cylinder(), stiffness, rpm);
    Ok(SpringAtSpeed { rpm, spring: spring.map_err(|soft| soft.at(format!("{rpm} rpm")))? })
}

/// Every spring at every speed.
fn sets_of(press: &Press, stiffnesses: &[f64], speeds: &[f64]) -> Result<Vec<SpringAtSpeed>, Refusal> {
    // The speed that needs the stiffest spring comes first: its report serves for all.
    let fastest = speeds.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    for stiffness in stiffnesses {
        set_spring(press, *stiffness, fastest)?;
    }
    let all = stiffnesses.iter().flat_map(|stiffness| speeds.iter().map(|rpm| (*stiffness, *rpm)));
    all.map(|(stiffness, rpm)| set_spring(press, stiffness, rpm)).collect()
}

const NOT_MODELLED: &[&str] = &[
    "Mass of spring and bottom, and their oscillation.",
    "Leakage and the flow of heat: the exponent of the air is the same at every speed.",
];

fn set_of(set: &SpringAtSpeed) -> SpringSet {
    let SpringAtSpeed { rpm, spring } = set;
    SpringSet {
        stiffness_n_per_mm: spring.stiffness / MILLIMETRES,
        spring_travel_mm: MILLIMETRES * spring.travel,
        air_length_mm: MILLIMETRES * spring.column,
        residual_max_n: spring.residual,
        rpm: *rpm,
        compressed_length_mm: MILLIMETRES * spring.compressed_length,
        residual_at_mm: MILLIMETRES * spring.residual_at,
        screw_mm: spring.screw.map(|screw| MILLIMETRES * screw),
        spring_force_max_n: spring.spring_force_max,
    }
}

/// Over the braking half under a yoke, whose other half is its mirror; over the whole reversal under a linkage.
fn curve(press: &Press, set: &SpringAtSpeed) -> Vec<SpringRow> {
    let SpringAtSpeed { rpm, spring } = set;
    match &press.stroke_end {
        None => places(press.bed.crank_radius)
            .map(|x| SpringRow {
                stiffness: spring.stiffness,
                rpm: *rpm,
                crank: f64::NAN,
                x,
                inertia: press.bed.inertia(*rpm, x),
                air: spring.air(x),
                residual: spring.residual(x),
                travel: spring.spring_travel(x),
            })
            .collect(),
        Some(end) => places(end.angle())
            .map(|crank| {
                let bed = end.at(crank);
                let [x, ..] = bed.x;
                SpringRow {
                    stiffness: spring.stiffness,
                    rpm: *rpm,
                    crank,
                    x,
                    inertia: press.bed.inertia(*rpm, bed.deceleration()[0].max(0.0)),
                    air: spring.air(x),
                    residual: spring.residual_at_crank(crank),
                    travel: spring.spring_travel(x),
                }
            })
            .collect(),
    }
}

fn answer(springs: &Springs<'_>) -> Text {
    let least = springs.settings.iter().map(|row| row.residual_max_n).fold(f64::INFINITY, f64::min);
    text!(
        "springs leave {} at best; a fixed bottom leaves {}",
        Value::brief(least, "N"),
        Value::brief(springs.residual_fixed_bottom_max_n, "N")
    )
}

/// What each spring does.
fn table(springs: &Springs<'_>) -> SummaryTable {
    let row = |row: &SpringSet| {
        vec![
            number_cell(row.stiffness_n_per_mm),
            Text::from(nominal(row.rpm, DIGITS)),
            length_cell(row.spring_travel_mm),
            length_cell(row.air_length_mm),
            number_cell(row.spring_force_max_n),
            number_cell(row.residual_max_n),
        ]
    };
    let least = text!(
        "more than {} N/mm each are needed at the design speed; one spring under each bottom",
        Value::brief_number(springs.least_stiffness_n_per_mm)
    );
    SummaryTable {
        heads: vec![
            SummaryColumn::numbers("stiffness", "N/mm each"),
            SummaryColumn::numbers("speed", "rpm"),
            SummaryColumn::lengths("travel", &LengthKind::MM),
            SummaryColumn::lengths("air column", &LengthKind::MM),
            SummaryColumn::numbers("force", "N each"),
            SummaryColumn::numbers("left over", "N"),
        ],
        rows: springs.settings.iter().map(row).collect(),
        rest: Some(least),
        ..SummaryTable::default()
    }
}

fn describe(springs: &Springs<'_>, press: &Press) -> Vec<ReportLine> {
    let design = press.design_rpm;
    let fastest = springs.settings.iter().map(|row| row.rpm).fold(design, f64::max);
    let faster = spring::least_stiffness(&braked_by(press), fastest) / MILLIMETRES;
    let faster = (fastest > design).then(|| format!(", at {} rpm more than {faster:.4}", shown(fastest)));
    let mut lines: Vec<ReportLine> = vec![
        format!("{}; a spring under the bottom of each", springs.cylinders.describe()).into(),
        format!(
            "at the design speed of {} rpm more than {:.4} N/mm each are needed{}; a fixed bottom leaves {:.2} N there",
            shown(design),
            springs.least_stiffness_n_per_mm,
            faster.unwrap_or_default(),
            springs.residual_fixed_bottom_max_n
        )
        .into(),
        ReportLine::row(format!(
            "{:>10} {:>8} {:>10} {:>9} {:>9} {:>11} {:>9} {:>9} {:>11}",
            "N/mm each", "rpm", "travel/mm", "air/mm", "left/mm", "residual/N", "at x/mm", "screw/mm", "N each"
        )),
    ];
    lines.extend(springs.settings.iter().map(|row| {
        ReportLine::row(format!(
            "{:>10.3} {:>8} {:>10.3} {:>9.3} {:>9.3} {:>11.2} {:>9.3} {:>9} {:>11.1}",
            row.stiffness_n_per_mm,
            shown(row.rpm),
            row.spring_travel_mm,
            row.air_length_mm,
            row.compressed_length_mm,
            row.residual_max_n,
            row.residual_at_mm,
            row.screw_mm.map_or("–".into(), |screw| format!("{screw:.3}")),
            row.spring_force_max_n
        ))
    }));
    lines
}

/// Springs whose curves are drawn.
const DRAWN: usize = 4;

/// What the best spring leaves, against a fixed bottom at the same speed, N.
fn headline(sets: &[SpringAtSpeed], fixed: f64, design_rpm: f64) -> String {
    let left = |set: &SpringAtSpeed| set.spring.residual.abs();
    let own = sets.iter().filter(|set| (set.rpm - design_rpm).abs() < 1e-9 * design_rpm);
    let Some(best) = own.min_by(|a, b| left(a).total_cmp(&left(b))).or(sets.first()) else { return String::new() };
    let stiffness = figure(best.spring.stiffness / MILLIMETRES);
    let spring = format!("A spring of {stiffness} N/mm leaves {} N at {} rpm", figure(left(best)), figure(best.rpm));
    if (best.rpm - design_rpm).abs() < 1e-9 * design_rpm {
        format!("{spring}, a fixed bottom {} N", figure(fixed))
    } else {
        spring
    }
}

/// The residual force of the springs, and figure 11 of the paper.
fn curves_of(machine: &str, design_rpm: f64, fixed: f64, sets: &[SpringAtSpeed], rows: &[SpringRow]) -> Plot {
    let of_sets: Vec<&[SpringRow]> = rows.chunks(PLACES as usize + 1).collect();
    let by_crank = rows.first().is_some_and(|row| row.crank.is_finite());
    let mut speeds: Vec<&[SpringRow]> = of_sets.iter().copied().take(DRAWN).collect();
    speeds.sort_by(|a, b| speed_of(a).total_cmp(&speed_of(b)));
    speeds.dedup_by(|a, b| speed_of(a) == speed_of(b));
    let mut forces = Vec::new();
    for rows in speeds {
        let all = points(rows, |row| row.inertia);
        // Under a yoke it is a straight line.
        let ends = [all.first(), all.last()].into_iter().flatten().copied().collect();
        let name = format!("inertia, {} rpm", figure(speed_of(rows)));
        forces.push(PlotCurve::grey(name, if by_crank { all } else { ends }));
    }
    // Their names stand in the panel above.
    forces.extend(
        curve_of_each(sets, &of_sets, |row| row.air)
            .into_iter()
            .map(|curve| PlotCurve { name: String::new(), ..curve }),
    );
    let residuals = curve_of_each(sets, &of_sets, |row| row.residual);
    let along = if by_crank { "crank angle from the start of the reversal, degrees" } else { CurveAxis::OVERRUN.words };
    let not_drawn = sets.len().saturating_sub(DRAWN);
    let more = if not_drawn > 0 { format!("; {not_drawn} more in the table") } else { String::new() };
    Plot {
        title: headline(sets, fixed, design_rpm),
        subtitle: format!("{machine}: buffers on springs{more}"),
        places: along.into(),
        panels: vec![
            PlotPanel { height: 1.4, ..PlotPanel::new("Residual force, inertia less air, N", residuals) },
            PlotPanel::new(
                "Force of the air in both cylinders, in the colours of the springs, and inertia of the bed, N",
                forces,
            ),
        ],
        ..Plot::default()
    }
}

/// A value over the crank angle (degrees) under a linkage, over the overrun (mm) under a yoke.
fn points(rows: &[SpringRow], value: fn(&SpringRow) -> f64) -> Vec<[f64; 2]> {
    let mut points = Vec::with_capacity(rows.len());
    for row in rows {
        let along = if row.crank.is_finite() { row.crank.to_degrees() } else { MILLIMETRES * row.x };
        points.push([along, value(row)]);
    }
    points
}

fn curve_of_each(sets: &[SpringAtSpeed], of_sets: &[&[SpringRow]], value: fn(&SpringRow) -> f64) -> Vec<PlotCurve> {
    let mut curves = Vec::new();
    for (colour, (set, rows)) in sets.iter().zip(of_sets).take(DRAWN).enumerate() {
        let name = format!("{} N/mm, {} rpm", figure(set.spring.stiffness / MILLIMETRES), figure(set.rpm));
        curves.push(PlotCurve::new(name, colour, points(rows, value)));
    }
    curves
}

fn speed_of(rows: &[SpringRow]) -> f64 {
    rows.first().map_or(f64::NAN, |row| row.rpm)
}

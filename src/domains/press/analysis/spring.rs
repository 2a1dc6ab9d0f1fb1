//! Buffers whose bottoms rest on springs instead of a cam. Equations (26) to (28), figure 11.

use crate::analysis::{Analysis, Picture, places};
use crate::body::Kind;
use crate::check::Measure;
use crate::document::Input;
use crate::domains::press::buffer::spring::{self, SpringBuffer};
use crate::domains::press::buffer::spring_body::SpringBody;
use crate::domains::press::cams;
use crate::domains::press::checks::{buckling, spring_stress, surge};
use crate::domains::press::machine::{Press, PressCams, only_under_a_yoke};
use crate::geometry::MILLIMETRES;
use crate::machine::Machine;
use crate::refusal::{Refusal, WorkBound};
use crate::report::plot::{self, Plot, PlotCurve, PlotPanel};
use crate::report::{Section, Speeds, shown};
use crate::table::{ListedColumn, Table};
use serde::Serialize;

/// Pneumatic-spring buffers.
pub const KIND: Kind = Kind { command: "spring", noun: "pneumatic-spring buffer", keys: cams::SPRING };

/// Springs of one call, each at a speed.
const SETS: WorkBound = WorkBound { what: "springs at a speed", most: 1000 };
/// Stiffnesses that are looked at by default, over the least one: near those of the paper's figure.
const USUAL: [f64; 3] = [1.125, 1.375, 2.75];

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

/// A place of a curve.
struct SpringRow {
    stiffness: f64,
    rpm: f64,
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

/// The section `spring`.
#[derive(Debug, Serialize)]
struct Springs<'a> {
    least_stiffness_n_per_mm: f64,
    residual_fixed_bottom_max_n: f64,
    settings: &'a [SpringSet],
}

/// The press, where a yoke moves its bed.
fn under_a_yoke(machine: &Machine) -> Result<&Press, Refusal> {
    let press = machine.press()?;
    let why = "the travel of the spring has no closed form";
    if press.stroke_end.is_some() { Err(only_under_a_yoke("springs are set", why)) } else { Ok(press) }
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
    let press = under_a_yoke(machine)?;
    let (bed, cylinder, own) = (press.bed, press.cylinder(), [press.design_rpm]);
    let speeds = if speeds.is_empty() { &own[..] } else { speeds };
    let least = spring::least_stiffness(&bed, press.design_rpm);
    let mut all = stiffnesses.to_vec();
    if let Some(residual) = residual {
        all.push(spring::stiffness_for(residual, &bed, &cylinder, press.design_rpm)?);
    } else if all.is_empty() {
        let highest = speeds.iter().map(|rpm| spring::least_stiffness(&bed, *rpm)).fold(least, f64::max);
        all.extend(USUAL.map(|over| over * highest));
    }
    SETS.allow(all.len().saturating_mul(speeds.len()))?;
    let sets = sets_of(press, &all, speeds)?;
    let rows: Vec<SpringSet> = sets.iter().map(|(rpm, spring)| set_of(*rpm, spring)).collect();
    let curves: Vec<SpringRow> = sets.iter().flat_map(|(rpm, spring)| curve(press, *rpm, spring)).collect();
    let bodies = bodies_of(machine, &sets);
    let springs = Springs {
        least_stiffness_n_per_mm: least / MILLIMETRES,
        residual_fixed_bottom_max_n: spring::plain_residual(&bed, &cylinder, press.design_rpm).value,
        settings: &rows,
    };
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs(KIND.keys));
    inputs.extend([Input::numbers("rpm", speeds), Input::numbers("stiffness", stiffnesses)]);
    inputs.extend(residual.map(|residual| Input::quantity("residual", residual, ("N", 1.0))));
    Ok(Analysis {
        kind: &KIND,
        machine: machine.name().to_owned(),
        speeds: Speeds::Several(speeds.to_vec()),
        inputs,
        sections: std::iter::once(Section::new(KIND.command, &springs).with_words(words(&springs, press.design_rpm)))
            .chain(bodies.as_ref().map(|(rows, _)| section_of_bodies(rows)))
            .collect(),
        measures: bodies.as_ref().map_or_else(Vec::new, |(rows, stress)| measures_of(rows, *stress)),
        notes: machine.idle_key_notes(KIND.keys, KIND.noun),
        picture: Picture::Curves(curves_of(machine.name(), press, &sets)),
        mechanism: None,
        document: None,
        tables: std::iter::once(("", Table::listed(COLUMNS, &rows)))
            .chain(bodies.as_ref().map(|(rows, _)| ("-bodies", Table::listed(BODIES, rows))))
            .chain([("-curves", Table::listed(CURVES, &curves))])
            .collect(),
        by: &["stiffness_n_per_mm", "rpm"],
        along: "x_mm",
        diagrams: &[],
        not_modelled: NOT_MODELLED.to_vec(),
    })
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

/// The springs of each stiffness, with the allowable stress, Pa; `None` where the file does not describe them.
fn bodies_of(machine: &Machine, sets: &[(f64, SpringBuffer)]) -> Option<(Vec<SpringBodyRow>, f64)> {
    let (data, bed) = (PressCams::of(machine).spring_body?, machine.bed()?);
    let fastest = sets.iter().map(|(rpm, _)| *rpm).fold(0.0, f64::max);
    let crank_hz = bed.crank_speed(fastest) / std::f64::consts::TAU;
    let of = |of_one: &[(f64, SpringBuffer)]| {
        let rate = of_one.first()?.1.stiffness;
        let force = of_one.iter().map(|(_, spring)| spring.spring_force_max).fold(0.0, f64::max);
        let body = SpringBody::new(data.shape, force, rate, data.stress);
        Some(SpringBodyRow {
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
        })
    };
    let rows = sets.chunk_by(|(_, a), (_, b)| a.stiffness == b.stiffness).filter_map(of).collect();
    Some((rows, data.stress))
}

fn section_of_bodies(rows: &[SpringBodyRow]) -> Section {
    let mut words = vec![format!(
        "{:>10} {:>10} {:>9} {:>9} {:>8} {:>10} {:>9} {:>9} {:>9}",
        "N/mm each", "force/N", "wire/mm", "coil/mm", "coils", "stress/MPa", "surge/Hz", "solid/mm", "free/mm"
    )];
    words.extend(rows.iter().map(|row| {
        format!(
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
        )
    }));
    Section::new("spring_bodies", &serde_json::json!({ "springs": rows })).with_words(words)
}

/// Rounding of the stress of a wire that is found for it.
const ROUNDING: f64 = 1e-12;

fn measures_of(rows: &[SpringBodyRow], allowable: f64) -> Vec<Measure> {
    let largest = rows.iter().map(|row| row.stress_mpa).fold(0.0, f64::max);
    let slowest = rows.iter().map(|row| row.surge_hz / row.crank_hz).fold(f64::INFINITY, f64::min);
    let limit = 1e-6 * allowable;
    let bent = rows.iter().map(|row| row.buckling).fold(0.0, f64::max);
    vec![
        spring_stress::CHECK.measure(largest, Some(limit)).kept(largest <= limit * (1.0 + ROUNDING)),
        surge::CHECK.measure(slowest, Some(surge::LEAST)),
        buckling::measure(bent),
    ]
}

/// Every spring at every speed.
fn sets_of(press: &Press, stiffnesses: &[f64], speeds: &[f64]) -> Result<Vec<(f64, SpringBuffer)>, Refusal> {
    let set = |stiffness: f64, rpm: f64| {
        let set = spring::set_for(&press.bed, &press.cylinder(), stiffness, rpm);
        set.map_err(|soft| soft.at(format!("{rpm} rpm")))
    };
    // The speed that needs the stiffest spring comes first: its report serves for all.
    let fastest = speeds.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    for stiffness in stiffnesses {
        set(*stiffness, fastest)?;
    }
    let all = stiffnesses.iter().flat_map(|stiffness| speeds.iter().map(|rpm| (*stiffness, *rpm)));
    all.map(|(stiffness, rpm)| Ok((rpm, set(stiffness, rpm)?))).collect()
}

const NOT_MODELLED: &[&str] = &[
    "Mass of spring and bottom, and their oscillation.",
    "Leakage and the flow of heat: the exponent of the air is the same at every speed.",
];

fn set_of(rpm: f64, spring: &SpringBuffer) -> SpringSet {
    SpringSet {
        stiffness_n_per_mm: spring.stiffness / MILLIMETRES,
        spring_travel_mm: MILLIMETRES * spring.travel,
        air_length_mm: MILLIMETRES * spring.column,
        residual_max_n: spring.residual,
        rpm,
        compressed_length_mm: MILLIMETRES * spring.compressed_length,
        residual_at_mm: MILLIMETRES * spring.residual_at,
        screw_mm: spring.screw.map(|screw| MILLIMETRES * screw),
        spring_force_max_n: spring.spring_force_max,
    }
}

fn curve<'a>(press: &Press, rpm: f64, spring: &'a SpringBuffer) -> impl Iterator<Item = SpringRow> + use<'a> {
    let slope = press.bed.largest_inertia(rpm) / press.bed.crank_radius;
    places(press.bed.crank_radius).map(move |x| SpringRow {
        stiffness: spring.stiffness,
        rpm,
        x,
        inertia: slope * x,
        air: spring.air(x),
        residual: spring.residual(x),
        travel: spring.spring_travel(x),
    })
}

fn words(springs: &Springs<'_>, design: f64) -> Vec<String> {
    let mut lines = vec![
        format!(
            "at {} rpm more than {:.4} N/mm are needed; a fixed bottom leaves {:.2} N",
            shown(design),
            springs.least_stiffness_n_per_mm,
            springs.residual_fixed_bottom_max_n
        ),
        format!(
            "{:>10} {:>8} {:>10} {:>9} {:>9} {:>11} {:>9} {:>9} {:>11}",
            "N/mm each", "rpm", "travel/mm", "air/mm", "left/mm", "residual/N", "at x/mm", "screw/mm", "spring/N"
        ),
    ];
    lines.extend(springs.settings.iter().map(|row| {
        format!(
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
        )
    }));
    lines
}

/// Figure 11 of the paper, with the residual below.
fn curves_of(machine: &str, press: &Press, sets: &[(f64, SpringBuffer)]) -> Plot {
    let stroke = press.bed.crank_radius;
    let name =
        |rpm: f64, spring: &SpringBuffer| format!("{:.2} N/mm, {} rpm", spring.stiffness / MILLIMETRES, shown(rpm));
    let curve = |colour: usize, (rpm, spring): &(f64, SpringBuffer), value: fn(&SpringBuffer, f64) -> f64| PlotCurve {
        name: name(*rpm, spring),
        colour,
        bold: true,
        points: places(stroke).map(|x| [MILLIMETRES * x, value(spring, x)]).collect(),
    };
    let of = |value: fn(&SpringBuffer, f64) -> f64| -> Vec<PlotCurve> {
        sets.iter().enumerate().map(|(colour, set)| curve(colour, set, value)).collect()
    };
    let mut speeds: Vec<f64> = sets.iter().map(|(rpm, _)| *rpm).collect();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    let inertia = |rpm: f64| PlotCurve {
        name: format!("inertia, {} rpm", shown(rpm)),
        colour: plot::GREY,
        bold: false,
        points: vec![[0.0, 0.0], [MILLIMETRES * stroke, press.bed.largest_inertia(rpm)]],
    };
    let forces = [speeds.into_iter().map(inertia).collect(), of(SpringBuffer::air)].concat();
    Plot {
        title: format!("{machine}: buffers on springs"),
        places: "overrun x of the bed, mm".into(),
        panels: vec![
            PlotPanel {
                name: "Force, N: inertia of the bed (thin), air of both cylinders (bold)".into(),
                curves: forces,
            },
            PlotPanel { name: "Residual force, inertia less air, N".into(), curves: of(SpringBuffer::residual) },
        ],
        ..Plot::default()
    }
}

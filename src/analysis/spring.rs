//! Buffers whose bottoms rest on springs instead of a cam. Equations (26) to (28), figure 11.

use super::{Analysis, places};
use crate::body::Kind;
use crate::buffer::spring::{self, NoStiffness, SpringBuffer, TooSoft};
use crate::document::{Input, cams};
use crate::geometry::MILLIMETRES;
use crate::machine::{Machine, NoPress, Press};
use crate::report::plot::{self, Curve, Panel, Plot};
use crate::report::{Section, Speeds, shown};
use crate::table::{Table, Told};
use serde::Serialize;

/// Pneumatic-spring buffers.
pub const KIND: Kind = Kind { command: "spring", noun: "pneumatic-spring buffer", keys: cams::SPRING };

/// Stiffnesses that are looked at by default, over the least one: near those of the paper's figure.
const USUAL: [f64; 3] = [1.125, 1.375, 2.75];

/// Why there is no such buffer.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpringError {
    /// The machine file describes no press.
    #[error(transparent)]
    NoPress(#[from] NoPress),
    /// The spring alone takes the whole stroke.
    #[error("at {rpm} rpm {soft}")]
    TooSoft {
        /// Speed of the main shaft.
        rpm: f64,
        /// What is wrong.
        soft: TooSoft,
    },
    /// No stiffness leaves that residual.
    #[error(transparent)]
    NoStiffness(#[from] NoStiffness),
}

/// What is told of a spring at a speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct Set {
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

const TOLD: &[Told<Set>] = &[
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
struct AtPlace {
    stiffness: f64,
    rpm: f64,
    x: f64,
    inertia: f64,
    air: f64,
    residual: f64,
    travel: f64,
}

const CURVES: &[Told<AtPlace>] = &[
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
    settings: &'a [Set],
}

/// Buffers on springs of these stiffnesses (N/m), and of that which leaves a wanted residual force (N) at the design speed, at
/// some speeds of the main shaft (rpm; none: the design speed).
///
/// # Errors
/// [`SpringError`] when the file has no press, a spring is too soft at one of the speeds, or none leaves that residual.
pub fn analysis(
    machine: &Machine,
    speeds: &[f64],
    stiffnesses: &[f64],
    residual: Option<f64>,
) -> Result<Analysis, SpringError> {
    let press = machine.press()?;
    if press.stroke_end.is_some() {
        let why = "the travel of the spring has no closed form";
        return Err(NoPress::Linkage { what: "springs are set", why }.into());
    }
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
    // The speed that needs the stiffest spring comes first: what is told there does for all.
    let fastest = speeds.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    for stiffness in &all {
        spring::set_for(&bed, &cylinder, *stiffness, fastest)
            .map_err(|soft| SpringError::TooSoft { rpm: fastest, soft })?;
    }
    let mut sets = Vec::new();
    for stiffness in &all {
        for rpm in speeds {
            let set = spring::set_for(&bed, &cylinder, *stiffness, *rpm);
            sets.push((*rpm, set.map_err(|soft| SpringError::TooSoft { rpm: *rpm, soft })?));
        }
    }
    let rows: Vec<Set> = sets.iter().map(|(rpm, spring)| told(*rpm, spring)).collect();
    let curves: Vec<AtPlace> = sets.iter().flat_map(|(rpm, spring)| curve(press, *rpm, spring)).collect();
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
        sections: vec![Section::new(KIND.command, &springs).with_words(words(&springs, press.design_rpm))],
        measures: Vec::new(),
        notes: machine.idle_keys_told(KIND.keys, KIND.noun),
        plot: curves_of(machine.name(), press, &sets),
        mechanism: None,
        document: None,
        tables: vec![("", Table::listed(TOLD, &rows)), ("-curves", Table::listed(CURVES, &curves))],
        by: &["stiffness_n_per_mm", "rpm"],
        along: "x_mm",
        not_modelled: NOT_MODELLED.to_vec(),
    })
}

const NOT_MODELLED: &[&str] = &[
    "Mass of spring and bottom, and their oscillation.",
    "Leakage and the flow of heat: the exponent of the air is the same at every speed.",
];

fn told(rpm: f64, spring: &SpringBuffer) -> Set {
    Set {
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

fn curve<'a>(press: &Press, rpm: f64, spring: &'a SpringBuffer) -> impl Iterator<Item = AtPlace> + use<'a> {
    let slope = press.bed.largest_inertia(rpm) / press.bed.crank_radius;
    places(press.bed.crank_radius).map(move |x| AtPlace {
        stiffness: spring.stiffness,
        rpm,
        x,
        inertia: slope * x,
        air: spring.air(x),
        residual: spring.residual(x),
        travel: spring.spring_travel(x),
    })
}

fn words(told: &Springs<'_>, design: f64) -> Vec<String> {
    let mut lines = vec![
        format!(
            "at {} rpm more than {:.4} N/mm are needed; a fixed bottom leaves {:.2} N",
            shown(design),
            told.least_stiffness_n_per_mm,
            told.residual_fixed_bottom_max_n
        ),
        format!(
            "{:>10} {:>8} {:>10} {:>9} {:>9} {:>11} {:>9} {:>9} {:>11}",
            "N/mm each", "rpm", "travel/mm", "air/mm", "left/mm", "residual/N", "at x/mm", "screw/mm", "spring/N"
        ),
    ];
    lines.extend(told.settings.iter().map(|row| {
        format!(
            "{:>10.4} {:>8} {:>10.4} {:>9.4} {:>9.4} {:>11.3} {:>9.3} {:>9} {:>11.2}",
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
    let curve = |colour: usize, (rpm, spring): &(f64, SpringBuffer), value: fn(&SpringBuffer, f64) -> f64| Curve {
        name: name(*rpm, spring),
        colour,
        bold: true,
        points: places(stroke).map(|x| [MILLIMETRES * x, value(spring, x)]).collect(),
    };
    let of = |value: fn(&SpringBuffer, f64) -> f64| -> Vec<Curve> {
        sets.iter().enumerate().map(|(colour, set)| curve(colour, set, value)).collect()
    };
    let mut speeds: Vec<f64> = sets.iter().map(|(rpm, _)| *rpm).collect();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    let inertia = |rpm: f64| Curve {
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
            Panel { name: "Force, N: inertia of the bed (thin), air of both cylinders (bold)".into(), curves: forces },
            Panel { name: "Residual force, inertia less air, N".into(), curves: of(SpringBuffer::residual) },
        ],
        ..Plot::default()
    }
}

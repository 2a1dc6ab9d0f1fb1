//! One cam at other speeds: the column is reset, or air is added, and a residual force is left. Equations (14) and (15), figure 5.

use super::{Analysis, Measure, PLACES, places};
use crate::body::{Kind, reversal_of_bed};
use crate::buffer::crank_law::CrankLaw;
use crate::buffer::regime::{self, Regime, Reset};
use crate::document::{Input, cams};
use crate::geometry::MILLIMETRES;
use crate::machine::{Machine, NoPress, Press};
use crate::motion::Transition;
use crate::report::plot::{Curve, Panel, Plot};
use crate::report::{Section, Speeds, shown};
use crate::table::{Table, Told};
use crate::units::TECHNICAL_ATMOSPHERE;
use serde::Serialize;

/// Resets for other speeds.
pub const KIND: Kind = Kind { command: "regimes", noun: "reset of the column", keys: cams::REGIMES };

/// The check that the volume of (15) can be had.
pub const ADDED_VOLUME: &str = "added_volume";

/// Cubic millimetres in a cubic metre.
const CUBIC: f64 = MILLIMETRES * MILLIMETRES * MILLIMETRES;
/// A volume of less than this share of the cylinders' is none: rounding.
const NO_VOLUME: f64 = 1e-12;

/// What is told of a speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct AtSpeed {
    rpm: f64,
    a_per_mm: f64,
    column_length_mm: f64,
    added_volume_mm3: f64,
    residual_max_n: f64,
    residual_share: f64,
    residual_at_mm: f64,
    end_residual_n: f64,
    lambda: f64,
    end_pressure_pa: f64,
    crank_torque_max_nm: f64,
    camshaft_torque_max_nm: f64,
}

const TOLD: &[Told<AtSpeed>] = &[
    ("rpm", |row| row.rpm),
    ("a_per_mm", |row| row.a_per_mm),
    ("column_length_mm", |row| row.column_length_mm),
    ("added_volume_mm3", |row| row.added_volume_mm3),
    ("residual_max_n", |row| row.residual_max_n),
    ("residual_share", |row| row.residual_share),
    ("residual_at_mm", |row| row.residual_at_mm),
    ("end_residual_n", |row| row.end_residual_n),
    ("lambda", |row| row.lambda),
    ("end_pressure_pa", |row| row.end_pressure_pa),
    ("crank_torque_max_nm", |row| row.crank_torque_max_nm),
    ("camshaft_torque_max_nm", |row| row.camshaft_torque_max_nm),
];

/// A place of a curve.
struct AtPlace {
    rpm: f64,
    /// Crank angle from the start of the reversal, rad; not told under a yoke.
    crank: f64,
    x: f64,
    inertia: f64,
    air: f64,
    residual: f64,
}

const CURVES: &[Told<AtPlace>] = &[
    ("rpm", |row| row.rpm),
    ("x_mm", |row| MILLIMETRES * row.x),
    ("inertia_n", |row| row.inertia),
    ("air_n", |row| row.air),
    ("residual_n", |row| row.residual),
];

/// Under a linkage the bed comes to one place with two forces: the curves run along the crank angle.
const CURVES_OF_A_LINKAGE: &[Told<AtPlace>] = &[
    ("rpm", |row| row.rpm),
    ("crank_deg", |row| row.crank.to_degrees()),
    ("x_mm", |row| MILLIMETRES * row.x),
    ("inertia_n", |row| row.inertia),
    ("air_n", |row| row.air),
    ("residual_n", |row| row.residual),
];

/// What the curves run along.
struct Along {
    told: &'static [Told<AtPlace>],
    column: &'static str,
    words: &'static str,
    value: fn(&AtPlace) -> f64,
}

impl Along {
    fn of(design: &CrankLaw) -> Self {
        match design {
            CrankLaw::Yoke(_) => Self {
                told: CURVES,
                column: "x_mm",
                words: "overrun x of the bed, mm",
                value: |place| MILLIMETRES * place.x,
            },
            CrankLaw::Linkage(_) => Self {
                told: CURVES_OF_A_LINKAGE,
                column: "crank_deg",
                words: "crank angle from the start of the reversal, degrees",
                value: |place| place.crank.to_degrees(),
            },
        }
    }
}

/// The section `regimes`.
#[derive(Debug, Serialize)]
struct Regimes<'a> {
    cam_rpm: f64,
    reset: &'static str,
    column_length_mm: f64,
    speeds: &'a [AtSpeed],
}

/// As the flag names it.
fn word(reset: Reset) -> &'static str {
    match reset {
        Reset::End => "end",
        Reset::Half => "half",
        Reset::Level => "level",
    }
}

/// The cam that is cut for `cam_rpm` at other speeds (all rpm of the main shaft), with its column reset for each.
///
/// # Errors
/// [`NoPress`] when the machine file describes none.
pub fn analysis(machine: &Machine, cam_rpm: f64, speeds: &[f64], reset: Reset) -> Result<Analysis, NoPress> {
    let press = machine.press()?;
    let (design, cylinder) = (press.bottom_law(cam_rpm), press.cylinder());
    let all: Vec<(f64, Regime)> =
        speeds.iter().map(|rpm| (*rpm, regime::reset(&design, &cylinder, *rpm, reset))).collect();
    let lobes = f64::from(machine.cam.lobes);
    let rows: Vec<AtSpeed> = all.iter().map(|(rpm, regime)| at_speed((press, &design), *rpm, regime, lobes)).collect();
    let curves: Vec<AtPlace> = all.iter().flat_map(|(rpm, regime)| curve(&design, *rpm, regime)).collect();
    let along = Along::of(&design);
    let told = Regimes { cam_rpm, reset: word(reset), column_length_mm: MILLIMETRES * design.column(), speeds: &rows };
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs(KIND.keys));
    inputs.extend([
        Input::numbers("rpm", speeds),
        Input::number("cut-for", cam_rpm),
        Input::word("reset", word(reset)),
    ]);
    Ok(Analysis {
        kind: &KIND,
        machine: machine.name().to_owned(),
        speeds: Speeds::Several(speeds.to_vec()),
        inputs,
        sections: std::iter::once(Section::new(KIND.command, &told).with_words(words(&told)))
            .chain(reversal_of_bed(machine))
            .collect(),
        measures: vec![volume(&rows, CUBIC * 2.0 * cylinder.piston_area * design.column())],
        notes: notes(machine),
        plot: plot(machine.name(), cam_rpm, &curves, &along),
        mechanism: None,
        document: None,
        tables: vec![("", Table::listed(TOLD, &rows)), ("-curves", Table::listed(along.told, &curves))],
        by: &["rpm"],
        along: along.column,
        not_modelled: NOT_MODELLED.to_vec(),
    })
}

fn notes(machine: &Machine) -> Vec<String> {
    let blend = matches!(machine.transition, Transition::Blend { .. });
    let follower = &machine.follower;
    let more = follower.mass.is_some() || follower.preload.is_some();
    let told = [
        (
            blend,
            "a blend leaves a residual force of its own, which `camgen rotary` tells: here the cam is taken as its law",
        ),
        (more, "the torque of the camshaft is that of the air alone, without preload and mass of the follower"),
    ];
    let of_press = told.into_iter().filter(|(holds, _)| *holds).map(|(_, words)| words.to_owned());
    // What is told here need not be called idle.
    let idle = machine.idle_keys_told(KIND.keys, KIND.noun).into_iter();
    idle.filter(|note| !note.contains("`transition.") && !note.contains("`follower.")).chain(of_press).collect()
}

const NOT_MODELLED: &[&str] = &[
    "The transition before the reversal: the cam is taken as its law.",
    "Leakage and the flow of heat: the exponent of the air is the same at every speed.",
    "Elasticity and play of what is between cam and bottom.",
];

fn at_speed((press, design): (&Press, &CrankLaw), rpm: f64, regime: &Regime, lobes: f64) -> AtSpeed {
    let residual_at = match design {
        CrankLaw::Yoke(_) => regime.residual_at,
        CrankLaw::Linkage(_) => design.bed(design.where_decelerated(regime.residual_at))[0],
    };
    AtSpeed {
        rpm,
        a_per_mm: regime.loading / MILLIMETRES,
        column_length_mm: MILLIMETRES * regime.column,
        added_volume_mm3: CUBIC * regime.added_volume,
        residual_max_n: regime.residual.abs(),
        residual_share: regime.residual.abs() / press.largest_inertia(rpm),
        residual_at_mm: MILLIMETRES * residual_at,
        end_residual_n: regime.end_residual,
        lambda: regime.length_ratio,
        end_pressure_pa: regime.end_pressure,
        crank_torque_max_nm: regime.crank_torque_max(),
        camshaft_torque_max_nm: lobes * regime.camshaft_torque_max(),
    }
}

/// Over the braking half under a yoke, whose other half is its mirror; over the whole reversal under a linkage.
fn curve(design: &CrankLaw, rpm: f64, regime: &Regime) -> Vec<AtPlace> {
    let at = |crank: f64, [x, a]: [f64; 2]| AtPlace {
        rpm,
        crank,
        x,
        inertia: regime.inertia(a),
        air: regime.air(a),
        residual: regime.residual(a),
    };
    match design {
        CrankLaw::Yoke(law) => places(law.stroke).map(|x| at(f64::NAN, [x, x])).collect(),
        CrankLaw::Linkage(law) => places(law.end.angle()).map(|crank| at(crank, design.bed(crank))).collect(),
    }
}

/// The least volume to add, mm³, to that of the cylinders: air cannot be taken away from a cylinder at ambient pressure.
fn volume(rows: &[AtSpeed], own: f64) -> Measure {
    let rounding = NO_VOLUME * own;
    let least = rows.iter().map(|row| row.added_volume_mm3).fold(f64::INFINITY, f64::min);
    let below: Vec<String> = rows
        .iter()
        .filter(|row| row.added_volume_mm3 < -rounding)
        .map(|row| format!("to {:.3} mm for {} rpm", row.column_length_mm, row.rpm))
        .collect();
    let note =
        format!("air would have to be taken away; shorten the column by its screw instead, {}", below.join(", "));
    Measure {
        check: ADDED_VOLUME,
        value: if least.abs() <= rounding { 0.0 } else { least },
        limit: Some(0.0),
        unit: "mm3",
        note: (!below.is_empty()).then_some(note),
    }
}

fn words(told: &Regimes<'_>) -> Vec<String> {
    let mut lines = vec![format!(
        "cam for {} rpm, column {:.3} mm there; reset: {}",
        told.cam_rpm, told.column_length_mm, told.reset
    )];
    lines.push(format!(
        "{:>8} {:>11} {:>8} {:>13} {:>11} {:>8} {:>9} {:>10} {:>9} {:>11} {:>11}",
        "rpm", "column/mm", "λ", "volume/cm³", "left/N", "left/%", "at x/mm", "end/N", "p_end/at", "crank/Nm", "cam/Nm"
    ));
    lines.extend(told.speeds.iter().map(|row| {
        format!(
            "{:>8} {:>11.3} {:>8.5} {:>13.3} {:>11.3} {:>8.3} {:>9.3} {:>10.3} {:>9.4} {:>11.2} {:>11.2}",
            row.rpm,
            row.column_length_mm,
            row.lambda,
            1e-3 * row.added_volume_mm3,
            row.residual_max_n,
            100.0 * row.residual_share,
            row.residual_at_mm,
            row.end_residual_n,
            row.end_pressure_pa / TECHNICAL_ATMOSPHERE,
            row.crank_torque_max_nm,
            row.camshaft_torque_max_nm
        )
    }));
    lines
}

/// Figure 5 of the paper, with the residual below.
fn plot(machine: &str, cam_rpm: f64, all: &[AtPlace], along: &Along) -> Plot {
    let speeds: Vec<&[AtPlace]> = all.chunks(PLACES as usize + 1).collect();
    let curve = |(colour, places): (usize, &&[AtPlace]), bold: bool, value: fn(&AtPlace) -> f64| Curve {
        name: places.first().filter(|_| bold).map_or_else(String::new, |place| format!("{} rpm", shown(place.rpm))),
        colour,
        bold,
        points: places.iter().map(|place| [(along.value)(place), value(place)]).collect(),
    };
    let of = |bold, value: fn(&AtPlace) -> f64| -> Vec<Curve> {
        speeds.iter().enumerate().map(|one| curve(one, bold, value)).collect()
    };
    let forces = [of(false, |place| place.inertia), of(true, |place| place.air)].concat();
    Plot {
        title: format!("{machine}: the cam for {} rpm at other speeds, column reset", shown(cam_rpm)),
        places: along.words.into(),
        panels: vec![
            Panel { name: "Force, N: inertia of the bed (thin), air of both cylinders (bold)".into(), curves: forces },
            Panel { name: "Residual force, inertia less air, N".into(), curves: of(true, |place| place.residual) },
        ],
        ..Plot::default()
    }
}

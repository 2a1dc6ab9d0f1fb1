//! One cam at other speeds: the column is reset, or air is added, and a residual force is left. Equations (14) and (15), figure 5.

use crate::analysis::{Analysis, PLACES, Picture, places};
use crate::body::Kind;
use crate::check::Measure;
use crate::document::{Input, NamedChoice};
use crate::domains::press::balance::reversal_of_bed;
use crate::domains::press::buffer::crank_law::CrankLaw;
use crate::domains::press::buffer::regime::{self, Regime, Reset};
use crate::domains::press::cams;
use crate::domains::press::checks::{added_volume, column};
use crate::domains::press::machine::Press;
use crate::domains::press::machine::PressCams;
use crate::domains::press::motion::Transition;
use crate::geometry::MILLIMETRES;
use crate::machine::Machine;
use crate::refusal::{Refusal, WorkBound};
use crate::report::plot::{Plot, PlotCurve, PlotPanel};
use crate::report::{Section, Speeds, shown};
use crate::table::{ListedColumn, Table};
use crate::units::TECHNICAL_ATMOSPHERE;
use serde::Serialize;

/// Resets for other speeds.
pub const KIND: Kind = Kind { command: "regimes", noun: "reset of the column", keys: cams::REGIMES };

/// Speeds of one call.
const SPEEDS: WorkBound = WorkBound { what: "speeds", most: 1000 };
/// Cubic millimetres in a cubic metre.
const CUBIC: f64 = MILLIMETRES * MILLIMETRES * MILLIMETRES;
/// A volume of less than this share of the cylinders' is rounding.
const NO_VOLUME: f64 = 1e-12;

/// The figures of a speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct SpeedRow {
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

const COLUMNS: &[ListedColumn<SpeedRow>] = &[
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
struct RegimeRow {
    rpm: f64,
    /// Crank angle from the start of the reversal, rad; not known under a yoke.
    crank: f64,
    x: f64,
    inertia: f64,
    air: f64,
    residual: f64,
}

const CURVES: &[ListedColumn<RegimeRow>] = &[
    ("rpm", |row| row.rpm),
    ("x_mm", |row| MILLIMETRES * row.x),
    ("inertia_n", |row| row.inertia),
    ("air_n", |row| row.air),
    ("residual_n", |row| row.residual),
];

/// Under a linkage the bed comes to one place with two forces: the curves run along the crank angle.
const CURVES_OF_A_LINKAGE: &[ListedColumn<RegimeRow>] = &[
    ("rpm", |row| row.rpm),
    ("crank_deg", |row| row.crank.to_degrees()),
    ("x_mm", |row| MILLIMETRES * row.x),
    ("inertia_n", |row| row.inertia),
    ("air_n", |row| row.air),
    ("residual_n", |row| row.residual),
];

/// The horizontal axis of the curves.
struct CurveAxis {
    list: &'static [ListedColumn<RegimeRow>],
    column: &'static str,
    words: &'static str,
    value: fn(&RegimeRow) -> f64,
}

impl CurveAxis {
    fn of(design: &CrankLaw) -> Self {
        match design {
            CrankLaw::Yoke(_) => Self {
                list: CURVES,
                column: "x_mm",
                words: "overrun x of the bed, mm",
                value: |place| MILLIMETRES * place.x,
            },
            CrankLaw::Linkage(_) => Self {
                list: CURVES_OF_A_LINKAGE,
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
    speeds: &'a [SpeedRow],
}

/// The cam that is cut for `cam_rpm` at other speeds (all rpm of the main shaft), with its column reset for each.
///
/// ```
/// use camgen::domains::press::analysis::regimes;
/// use camgen::domains::press::buffer::regime::Reset;
/// use camgen::{Judged, Machine};
///
/// let (machine, _) = Machine::load("dpi", &[])?;
/// let judged = Judged::new(regimes::analysis(&machine, 35.0, &[20.0, 25.0, 30.0, 35.0], Reset::End)?);
/// assert!(judged.report().section("regimes").is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Refusal`] when the machine file describes none.
pub fn analysis(machine: &Machine, cam_rpm: f64, speeds: &[f64], reset: Reset) -> Result<Analysis, Refusal> {
    SPEEDS.allow(speeds.len())?;
    let press = machine.press()?;
    let (design, cylinder) = (press.bottom_law(cam_rpm), press.cylinder());
    let all: Vec<(f64, Regime)> =
        speeds.iter().map(|rpm| (*rpm, regime::reset(&design, &cylinder, *rpm, reset))).collect();
    let lobes = f64::from(PressCams::of(machine).lobes);
    let rows: Vec<SpeedRow> = all.iter().map(|(rpm, regime)| at_speed((press, &design), *rpm, regime, lobes)).collect();
    let curves: Vec<RegimeRow> = all.iter().flat_map(|(rpm, regime)| curve(&design, *rpm, regime)).collect();
    let along = CurveAxis::of(&design);
    let columns: Vec<(f64, f64)> = rows.iter().map(|row| (row.column_length_mm / MILLIMETRES, row.rpm)).collect();
    let regimes =
        Regimes { cam_rpm, reset: reset.word(), column_length_mm: MILLIMETRES * design.column(), speeds: &rows };
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs(KIND.keys));
    inputs.extend([
        Input::numbers("rpm", speeds),
        Input::number("cut-for", cam_rpm),
        Input::word("reset", reset.word()),
    ]);
    Ok(Analysis {
        kind: &KIND,
        machine: machine.name().to_owned(),
        speeds: Speeds::Several(speeds.to_vec()),
        inputs,
        sections: std::iter::once(Section::new(KIND.command, &regimes).with_words(words(&regimes)))
            .chain(reversal_of_bed(machine))
            .collect(),
        measures: std::iter::once(volume(&rows, CUBIC * 2.0 * cylinder.piston_area * design.column()))
            .chain(column::measure(&columns, machine, |press, rpm| Some(press.bottom_law(rpm).column())))
            .collect(),
        notes: notes(machine),
        picture: Picture::Curves(plot(machine.name(), cam_rpm, &curves, &along)),
        mechanism: None,
        document: None,
        tables: vec![("", Table::listed(COLUMNS, &rows)), ("-curves", Table::listed(along.list, &curves))],
        by: &["rpm"],
        along: along.column,
        diagrams: &[],
        not_modelled: NOT_MODELLED.to_vec(),
    })
}

fn notes(machine: &Machine) -> Vec<String> {
    let blend = matches!(machine.transition(), Transition::Blend { .. });
    let follower = &machine.follower;
    let more = follower.mass.is_some() || follower.preload.is_some();
    let regimes = [
        (
            blend,
            "a blend leaves a residual force of its own, which `camgen rotary` reports; here the cam is assumed to follow its law",
        ),
        (more, "the torque of the camshaft is that of the air alone, without preload and mass of the follower"),
    ];
    let of_press = regimes.into_iter().filter(|(holds, _)| *holds).map(|(_, words)| words.to_owned());
    // A key that is reported here is not reported as without effect.
    let idle = machine.idle_key_notes(KIND.keys, KIND.noun).into_iter();
    idle.filter(|note| !note.contains("`transition.") && !note.contains("`follower.")).chain(of_press).collect()
}

const NOT_MODELLED: &[&str] = &[
    "The transition before the reversal: the cam is assumed to follow its law.",
    "Leakage and the flow of heat: the exponent of the air is the same at every speed.",
    "Elasticity and play between cam and bottom.",
];

fn at_speed((press, design): (&Press, &CrankLaw), rpm: f64, regime: &Regime, lobes: f64) -> SpeedRow {
    let residual_at = match design {
        CrankLaw::Yoke(_) => regime.residual_at,
        CrankLaw::Linkage(_) => design.bed(design.where_decelerated(regime.residual_at))[0],
    };
    SpeedRow {
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
fn curve(design: &CrankLaw, rpm: f64, regime: &Regime) -> Vec<RegimeRow> {
    let at = |crank: f64, [x, a]: [f64; 2]| RegimeRow {
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
fn volume(rows: &[SpeedRow], own: f64) -> Measure {
    let rounding = NO_VOLUME * own;
    let least = rows.iter().map(|row| row.added_volume_mm3).fold(f64::INFINITY, f64::min);
    let below: Vec<String> = rows
        .iter()
        .filter(|row| row.added_volume_mm3 < -rounding)
        .map(|row| format!("to {:.3} mm for {} rpm", row.column_length_mm, row.rpm))
        .collect();
    let note =
        format!("air would have to be taken away; shorten the column by its screw instead, {}", below.join(", "));
    let least = if least.abs() <= rounding { 0.0 } else { least };
    added_volume::CHECK.measure(least, Some(0.0)).noted((!below.is_empty()).then_some(note))
}

fn words(regimes: &Regimes<'_>) -> Vec<String> {
    let mut lines = vec![format!(
        "cam for {} rpm, column {:.3} mm there; reset: {}",
        regimes.cam_rpm, regimes.column_length_mm, regimes.reset
    )];
    lines.push(format!(
        "{:>8} {:>11} {:>8} {:>13} {:>11} {:>8} {:>9} {:>10} {:>9} {:>11} {:>11}",
        "rpm", "column/mm", "λ", "volume/cm³", "left/N", "left/%", "at x/mm", "end/N", "p_end/at", "crank/Nm", "cam/Nm"
    ));
    lines.extend(regimes.speeds.iter().map(|row| {
        format!(
            "{:>8} {:>11.3} {:>8.5} {:>13} {:>11.2} {:>8.3} {:>9.3} {:>10} {:>9.4} {:>11.2} {:>11.2}",
            row.rpm,
            row.column_length_mm,
            row.lambda,
            unsigned_zero(1e-3 * row.added_volume_mm3, 1),
            row.residual_max_n,
            100.0 * row.residual_share,
            row.residual_at_mm,
            unsigned_zero(row.end_residual_n, 3),
            row.end_pressure_pa / TECHNICAL_ATMOSPHERE,
            row.crank_torque_max_nm,
            row.camshaft_torque_max_nm
        )
    }));
    lines
}

/// A number with so many decimals; what is 0 with them has no sign.
fn unsigned_zero(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    text.strip_prefix('-')
        .filter(|size| size.bytes().all(|c| matches!(c, b'0' | b'.')))
        .map_or(text.clone(), str::to_owned)
}

/// Figure 5 of the paper, with the residual below.
fn plot(machine: &str, cam_rpm: f64, all: &[RegimeRow], along: &CurveAxis) -> Plot {
    let speeds: Vec<&[RegimeRow]> = all.chunks(PLACES as usize + 1).collect();
    let curve = |(colour, places): (usize, &&[RegimeRow]), bold: bool, value: fn(&RegimeRow) -> f64| PlotCurve {
        name: places.first().filter(|_| bold).map_or_else(String::new, |place| format!("{} rpm", shown(place.rpm))),
        colour,
        bold,
        points: places.iter().map(|place| [(along.value)(place), value(place)]).collect(),
    };
    let of = |bold, value: fn(&RegimeRow) -> f64| -> Vec<PlotCurve> {
        speeds.iter().enumerate().map(|one| curve(one, bold, value)).collect()
    };
    let forces = [of(false, |place| place.inertia), of(true, |place| place.air)].concat();
    Plot {
        title: format!("{machine}: the cam for {} rpm at other speeds, column reset", shown(cam_rpm)),
        places: along.words.into(),
        panels: vec![
            PlotPanel {
                name: "Force, N: inertia of the bed (thin), air of both cylinders (bold)".into(),
                curves: forces,
            },
            PlotPanel { name: "Residual force, inertia less air, N".into(), curves: of(true, |place| place.residual) },
        ],
        ..Plot::default()
    }
}

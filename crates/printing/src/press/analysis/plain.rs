//! Buffers without a cam, sized alone: a fixed bottom at the design speed and at others, and what the end pressure chooses. Equations (3) to (9), figures
//! 4 and 9.

use super::at_speeds::{
    CURVES, ColumnReset, CurveAxis, ForcePlace, SPEEDS, column_by, columns_curve, columns_of, residual_panel,
    rule_words, swept_speeds, too_long, unsigned_zero, volume, whole,
};
use super::regimes::KIND;
use super::trial_bottoms::{self, TrialRow};
use crate::press::MachineOfPress;
use crate::press::buffer::bottom_law::{BottomLaw, ColumnRule};
use crate::press::buffer::regime::Reset;
use crate::press::buffer::{Cylinder, PlainBuffer};
use crate::press::checks::column;
use crate::press::columns::CUBIC;
use crate::press::machine::{Press, only_under_a_yoke};
use crate::press::report::CylinderMeasures;
use crate::press::scatter::fault::FrozenBuffer;
use crate::press::scatter::settings::extremes_of_fixed;
use camgen_cams::analysis::{Analysis, Listing, Picture, places};
use camgen_cams::machine::{Machine, idle_key_note};
use camgen_cams::report::ReportLine;
use camgen_cams::report::plot::{
    Plot, PlotCurve, PlotLine, PlotPanel, PlotPoint, SideRow, SideTable, SmallPlot, SmallPlots, figure,
};
use camgen_cams::report::{Section, Speeds, SummaryColumn, SummaryTable, length_cell, number_cell, shown};
use camgen_cams::table::{ListedColumn, Table};
use camgen_kernel::document::{Input, NamedChoice};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{DIGITS, LengthKind, Text, Value, nominal, text};
use camgen_kernel::units::TECHNICAL_ATMOSPHERE;
use serde::Serialize;

/// End pressures of the family / ambient pressure; the pressure of the file is among them.
const FAMILY: [f64; 6] = [1.5, 2.0, 2.5, 3.0, 4.0, 5.0];
/// Two end pressures are one within this share.
const SAME: f64 = 1e-9;

/// A fixed bottom at a speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct PlainRow {
    rpm: f64,
    a_per_mm: f64,
    column_length_mm: f64,
    /// For all cylinders.
    added_volume_mm3: f64,
    residual_max_n: f64,
    residual_share: f64,
    residual_at_mm: f64,
    end_residual_n: f64,
    end_pressure_pa: f64,
    added_volume_each_mm3: f64,
}

impl PlainRow {
    fn reset(&self) -> ColumnReset {
        ColumnReset { rpm: self.rpm, column_mm: self.column_length_mm, added_mm3: self.added_volume_mm3 }
    }
}

const COLUMNS: &[ListedColumn<PlainRow>] = &[
    ("rpm", |row| row.rpm),
    ("a_per_mm", |row| row.a_per_mm),
    ("column_length_mm", |row| row.column_length_mm),
    ("added_volume_mm3", |row| row.added_volume_mm3),
    ("residual_max_n", |row| row.residual_max_n),
    ("residual_share", |row| row.residual_share),
    ("residual_at_mm", |row| row.residual_at_mm),
    ("end_residual_n", |row| row.end_residual_n),
    ("end_pressure_pa", |row| row.end_pressure_pa),
    ("added_volume_each_mm3", |row| row.added_volume_each_mm3),
];

/// The cylinders for an end pressure at the design speed, and the bottoms of a cam that balances them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct FamilyRow {
    end_pressure_pa: f64,
    #[serde(flatten)]
    cylinders: CylinderMeasures,
    /// By (7): of a fixed bottom, and of a cam that brings it back.
    column_length_mm: f64,
    residual_max_n: f64,
    residual_at_mm: f64,
    dx_max_mm: f64,
    dx_max_at_x_mm: f64,
    matched_column_length_mm: f64,
    matched_dx_max_mm: f64,
}

const FAMILY_COLUMNS: &[ListedColumn<FamilyRow>] = &[
    ("end_pressure_pa", |row| row.end_pressure_pa),
    ("bore_mm", |row| row.cylinders.bore_mm),
    ("column_length_mm", |row| row.column_length_mm),
    ("residual_max_n", |row| row.residual_max_n),
    ("residual_at_mm", |row| row.residual_at_mm),
    ("dx_max_mm", |row| row.dx_max_mm),
    ("dx_max_at_x_mm", |row| row.dx_max_at_x_mm),
    ("matched_column_length_mm", |row| row.matched_column_length_mm),
    ("matched_dx_max_mm", |row| row.matched_dx_max_mm),
    ("cylinders", |row| f64::from(row.cylinders.cylinders)),
    ("piston_area_mm2", |row| row.cylinders.piston_area_mm2),
    ("piston_area_total_mm2", |row| row.cylinders.piston_area_total_mm2),
];

/// A point of figure 4.
struct FamilyPlace {
    end_pressure: f64,
    x: f64,
    crank: f64,
    dx: f64,
    residual: f64,
}

const FAMILY_CURVES: &[ListedColumn<FamilyPlace>] = &[
    ("end_pressure_pa", |row| row.end_pressure),
    ("x_mm", |row| MILLIMETRES * row.x),
    ("crank_deg", |row| row.crank.to_degrees()),
    ("dx_mm", |row| MILLIMETRES * row.dx),
    ("residual_n", |row| row.residual),
];

/// The section `plain_buffers`.
#[derive(Debug, Serialize)]
struct PlainBuffers<'a> {
    reset: &'static str,
    #[serde(flatten)]
    cylinders: CylinderMeasures,
    speeds: &'a [PlainRow],
    end_pressures: &'a [FamilyRow],
}

/// The buffers of a press with fixed bottoms, without any cam: their column at speeds of the main shaft (rpm) by a rule for the end of the stroke,
/// and the cylinders for other end pressures.
///
/// ```
/// use camgen::domains::press::analysis::plain;
/// use camgen::domains::press::buffer::regime::Reset;
/// use camgen::{Judged, Machine};
///
/// let (machine, _) = Machine::load("dpi", &[])?;
/// let judged = Judged::new(plain::analysis(&machine, &[25.0, 35.0], Reset::End)?);
/// let section = judged.report().section("plain_buffers").expect("a section").clone();
/// assert!((section["speeds"][1]["residual_max_n"].as_f64().unwrap() - 3185.75).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Refusal`] when the file has no press under a yoke.
pub fn analysis(machine: &Machine, speeds: &[f64], reset: Reset) -> Result<Analysis, Refusal> {
    SPEEDS.allow(speeds.len())?;
    let press = machine.press()?;
    if press.stroke_end.is_some() {
        return Err(only_under_a_yoke("plain buffers are sized alone", "their residual force has no closed extremes"));
    }
    let cylinder = press.cylinder();
    let rows: Vec<PlainRow> = speeds.iter().map(|rpm| at_speed(press, &cylinder, *rpm, reset)).collect();
    let curves: Vec<ForcePlace> = rows.iter().flat_map(|row| curve(press, &cylinder, row)).collect();
    let pressures = pressures(press);
    let family: Vec<FamilyRow> = pressures.iter().map(|end| of_pressure(press, *end)).collect();
    let family_curves: Vec<FamilyPlace> = pressures.iter().flat_map(|end| family_curve(press, *end)).collect();
    let trials = trial_bottoms::trials(machine);
    let section = PlainBuffers {
        reset: reset.word(),
        cylinders: CylinderMeasures::new(cylinder.piston_area),
        speeds: &rows,
        end_pressures: &family,
    };
    let own = column_by(&frozen_at(press, &cylinder, press.design_rpm), reset);
    let resets: Vec<ColumnReset> = rows.iter().map(PlainRow::reset).collect();
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs(KIND.keys));
    inputs.extend([
        Input::numbers("rpm", speeds),
        Input::word("without-cam", "true"),
        Input::word("reset", reset.word()),
    ]);
    let words = describe(&section);
    Ok(Analysis {
        kind: &KIND,
        variant: "fixed",
        machine: machine.name().to_owned(),
        speeds: Speeds::Several(speeds.to_vec()),
        inputs,
        sections: vec![
            Section::new("plain_buffers", &section)
                .with_words(words)
                .with_answer(answer(&section))
                .with_table(table(&section)),
        ],
        measures: std::iter::once(volume(&resets, CUBIC * cylinder.volume(own)))
            .chain(column::measure(&columns_of(&resets), machine, |press, rpm| {
                Some(column_by(&frozen_at(press, &cylinder, rpm), reset))
            }))
            .collect(),
        notes: notes(machine),
        picture: Picture::Curves(picture(machine, press, (&rows, reset), &curves, (&family, &family_curves), &trials)),
        mechanism: None,
        document: None,
        tables: tables_of(&rows, &curves, &family, &family_curves, &trials),
        by: &["rpm"],
        along: "x_mm",
        diagrams: &[],
        not_modelled: vec![
            "Leakage and the flow of heat: the exponent of the air is the same at every speed and on both ways.",
        ],
    })
}

fn tables_of(
    rows: &[PlainRow],
    curves: &[ForcePlace],
    family: &[FamilyRow],
    family_curves: &[FamilyPlace],
    trials: &[TrialRow],
) -> Vec<Listing> {
    let trials = (!trials.is_empty()).then(|| ("-equation-18", Table::listed(trial_bottoms::COLUMNS, trials)));
    let first = [
        ("", Table::listed(COLUMNS, rows)),
        ("-pressures", Table::listed(FAMILY_COLUMNS, family)),
        ("-pressure-curves", Table::listed(FAMILY_CURVES, family_curves)),
    ];
    first.into_iter().chain(trials).chain([("-curves", Table::listed(CURVES, curves))]).collect()
}

/// The keys that were given and have an effect on a cam alone.
fn notes(machine: &Machine) -> Vec<String> {
    let of_cam = ["buffer.column", "buffer.lead"].into_iter();
    let of_cam = of_cam.filter(|key| machine.given().iter().any(|given| given == key));
    let of_cam = of_cam.map(|key| format!("`{key}` has no effect on fixed bottoms: the column is that of the reset, and the port shuts as the reversal starts"));
    // The plate of figure 9.
    let idle = machine.without_effect(KIND.keys).into_iter().filter(|key| !key.starts_with("translating."));
    idle.map(|key| idle_key_note(&key, KIND.noun)).chain(of_cam).collect()
}

/// The buffer at a speed, without its column.
fn frozen_at(press: &Press, cylinder: &Cylinder, rpm: f64) -> FrozenBuffer {
    let law = BottomLaw::new(cylinder.loading(rpm), cylinder.exponent, press.bed.crank_radius, ColumnRule::Return, 0.0);
    FrozenBuffer::of_cam(&law, cylinder)
}

fn at_speed(press: &Press, cylinder: &Cylinder, rpm: f64, reset: Reset) -> PlainRow {
    let frozen = frozen_at(press, cylinder, rpm);
    let column = column_by(&frozen, reset);
    let own = column_by(&frozen_at(press, cylinder, press.design_rpm), reset);
    let worst = extremes_of_fixed(&frozen, column, 1.0)
        .into_iter()
        .reduce(|a, b| if b.value.abs() > a.value.abs() { b } else { a });
    let (value, at) = worst.map_or((0.0, 0.0), |worst| (worst.value, worst.at));
    let air = libm::expm1(-frozen.exponent * libm::log1p(-frozen.path.stroke() / column));
    let end = frozen.end_load() - air;
    PlainRow {
        rpm,
        a_per_mm: frozen.path.loading() / MILLIMETRES,
        column_length_mm: MILLIMETRES * column,
        added_volume_mm3: CUBIC * cylinder.volume(column - own),
        residual_max_n: value.abs(),
        residual_share: value.abs() / press.largest_inertia(rpm),
        residual_at_mm: MILLIMETRES * at,
        // By (7) the air is the inertia there, to its rounding.
        end_residual_n: if reset == Reset::End { 0.0 } else { frozen.unit_force * end },
        end_pressure_pa: cylinder.ambient_pressure * (1.0 + air),
        added_volume_each_mm3: CUBIC * cylinder.piston_area * (column - own),
    }
}

fn curve<'a>(press: &'a Press, cylinder: &'a Cylinder, row: &PlainRow) -> impl Iterator<Item = ForcePlace> + use<'a> {
    let (rpm, column, unit) = (row.rpm, row.column_length_mm / MILLIMETRES, cylinder.unit_force());
    let (loading, exponent) = (cylinder.loading(rpm), cylinder.exponent);
    let (stroke, balanced) = (press.bed.crank_radius, row.end_residual_n == 0.0);
    places(stroke).map(move |x| {
        let inertia = unit * loading * x;
        let air = unit * libm::expm1(-exponent * libm::log1p(-x / column));
        // By (7) the air is the inertia at the end, to its rounding.
        let air = if balanced && x == stroke { inertia } else { air };
        ForcePlace { rpm, crank: f64::NAN, x, inertia, air, residual: inertia - air }
    })
}

/// The end pressures that are compared, Pa.
fn pressures(press: &Press) -> Vec<f64> {
    let (ambient, own) = (press.ambient_pressure, press.end_pressure);
    let others = FAMILY.map(|ratio| ratio * ambient).into_iter().filter(|end| (end / own - 1.0).abs() > SAME);
    let mut all: Vec<f64> = others.chain([own]).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// The cylinders for an end pressure, Pa, with the laws of a returning and a matched column.
fn of_end(press: &Press, end: f64) -> (Cylinder, [BottomLaw; 2]) {
    let (k, p0, r) = (press.polytropic_exponent, press.ambient_pressure, press.bed.crank_radius);
    let cylinder = Cylinder::sized(&press.bed, press.design_rpm, k, p0, end);
    let laws = [ColumnRule::Return, ColumnRule::Matched]
        .map(|rule| BottomLaw::new(cylinder.loading(press.design_rpm), k, r, rule, 0.0));
    (cylinder, laws)
}

fn of_pressure(press: &Press, end: f64) -> FamilyRow {
    let (cylinder, [returns, matched]) = of_end(press, end);
    let plain = PlainBuffer::new(returns.loading, returns.exponent, returns.stroke);
    let ((at, left), (dx_at, dx)) = (plain.largest_residual(), returns.largest_displacement());
    FamilyRow {
        end_pressure_pa: end,
        cylinders: CylinderMeasures::new(cylinder.piston_area),
        column_length_mm: MILLIMETRES * plain.column,
        residual_max_n: cylinder.unit_force() * left,
        residual_at_mm: MILLIMETRES * at,
        dx_max_mm: MILLIMETRES * dx,
        dx_max_at_x_mm: MILLIMETRES * dx_at,
        matched_column_length_mm: MILLIMETRES * matched.column,
        matched_dx_max_mm: MILLIMETRES * matched.largest_displacement().1,
    }
}

fn family_curve(press: &Press, end: f64) -> Vec<FamilyPlace> {
    let (cylinder, [law, _]) = of_end(press, end);
    let plain = PlainBuffer::new(law.loading, law.exponent, law.stroke);
    places(law.stroke)
        .map(|x| FamilyPlace {
            end_pressure: end,
            x,
            crank: libm::asin((x / law.stroke).min(1.0)),
            dx: law.displacement(x),
            residual: cylinder.unit_force() * (law.loading * x - plain.air(x)),
        })
        .collect()
}

fn answer(found: &PlainBuffers<'_>) -> Text {
    let most = found.speeds.iter().map(|row| row.residual_max_n).fold(0.0, f64::max);
    text!("fixed bottoms leave up to {}; columns by the rule \"{}\"", Value::brief(most, "N"), found.reset)
}

/// The column of a fixed bottom at each speed, and what it leaves.
fn table(found: &PlainBuffers<'_>) -> SummaryTable {
    let row = |row: &PlainRow| {
        vec![
            Text::from(nominal(row.rpm, DIGITS)),
            length_cell(row.column_length_mm),
            number_cell(row.residual_max_n),
            number_cell(100.0 * row.residual_share),
            length_cell(row.residual_at_mm),
            number_cell(row.end_pressure_pa / TECHNICAL_ATMOSPHERE),
        ]
    };
    SummaryTable {
        heads: vec![
            SummaryColumn::numbers("speed", "rpm"),
            SummaryColumn::lengths("set column", &LengthKind::MM),
            SummaryColumn::numbers("left over", "N"),
            SummaryColumn::numbers("of the inertia", "%"),
            SummaryColumn::lengths("at x", &LengthKind::MM),
            SummaryColumn::numbers("end pressure", "at"),
        ],
        rows: found.speeds.iter().map(row).collect(),
        rest: Some("other end pressures: -v, and the tables".into()),
        ..SummaryTable::default()
    }
}

fn describe(found: &PlainBuffers<'_>) -> Vec<ReportLine> {
    let mut lines: Vec<ReportLine> =
        vec![format!("fixed bottoms without a cam; reset: {}; {}", found.reset, found.cylinders.describe()).into()];
    lines.push(ReportLine::row(format!(
        "{:>8} {:>11} {:>13} {:>13} {:>11} {:>8} {:>9} {:>10} {:>9}",
        "rpm", "column/mm", "V each/cm³", "V all/cm³", "left/N", "left/%", "at x/mm", "end/N", "p_end/at"
    )));
    lines.extend(found.speeds.iter().map(|row| {
        ReportLine::row(format!(
            "{:>8} {:>11.3} {:>13} {:>13} {:>11.2} {:>8.3} {:>9.3} {:>10} {:>9.4}",
            shown(row.rpm),
            row.column_length_mm,
            unsigned_zero(1e-3 * row.added_volume_each_mm3, 1),
            unsigned_zero(1e-3 * row.added_volume_mm3, 1),
            row.residual_max_n,
            100.0 * row.residual_share,
            row.residual_at_mm,
            unsigned_zero(row.end_residual_n, 3),
            row.end_pressure_pa / TECHNICAL_ATMOSPHERE
        ))
    }));
    lines.push("cylinders for other end pressures at the design speed, and the bottom of a cam with the returning and the matched column:".into());
    lines.push(ReportLine::row(format!(
        "{:>8} {:>9} {:>11} {:>11} {:>9} {:>9} {:>9} {:>12} {:>11}",
        "p_end/at", "each Ø/mm", "column/mm", "left/N", "at x/mm", "Δx/mm", "at x/mm", "matched/mm", "its Δx/mm"
    )));
    lines.extend(found.end_pressures.iter().map(|row| {
        ReportLine::row(format!(
            "{:>8.3} {:>9.2} {:>11.3} {:>11.2} {:>9.3} {:>9.3} {:>9.3} {:>12.3} {:>11.3}",
            row.end_pressure_pa / TECHNICAL_ATMOSPHERE,
            row.cylinders.bore_mm,
            row.column_length_mm,
            row.residual_max_n,
            row.residual_at_mm,
            row.dx_max_mm,
            row.dx_max_at_x_mm,
            row.matched_column_length_mm,
            row.matched_dx_max_mm
        ))
    }));
    lines
}

/// Force and column over the speed, the bottom for each end pressure, and figure 9.
fn picture(
    machine: &Machine,
    press: &Press,
    (rows, reset): (&[PlainRow], Reset),
    curves: &[ForcePlace],
    (pressures, family): (&[FamilyRow], &[FamilyPlace]),
    trials: &[TrialRow],
) -> Plot {
    let cylinder = press.cylinder();
    let asked: Vec<f64> = rows.iter().map(|row| row.rpm).collect();
    let swept: Vec<PlainRow> =
        swept_speeds(press.design_rpm, &asked).into_iter().map(|rpm| at_speed(press, &cylinder, rpm, reset)).collect();
    let own = at_speed(press, &cylinder, press.design_rpm, reset);
    let design = |text: String| vec![PlotLine { at: press.design_rpm, text, dashed: false }];
    let left = PlotPanel {
        points: vec![PlotPoint::dot([own.rpm, own.residual_max_n], 0, format!("{} N", figure(own.residual_max_n)))],
        lines: design(format!("{} rpm: design speed", figure(own.rpm))),
        height: 1.2,
        ..PlotPanel::new(
            "Largest force left over, N",
            vec![PlotCurve::new("", 0, swept.iter().map(|row| [row.rpm, row.residual_max_n]).collect())],
        )
    };
    let too_long = too_long(machine);
    let limit = too_long.from;
    let columns = swept.iter().map(|row| [row.rpm, row.column_length_mm]);
    let column = PlotPanel {
        points: vec![PlotPoint::dot(
            [own.rpm, own.column_length_mm],
            0,
            format!("{} mm", figure(own.column_length_mm)),
        )],
        lines: design(String::new()),
        bands: vec![too_long],
        ..PlotPanel::new("Column to set by the screw, mm", vec![columns_curve("", 0, columns, limit)])
    };
    let residual = residual_panel(curves, &CurveAxis::OVERRUN);
    let mut panels = vec![(CurveAxis::OVERRUN.words.to_owned(), residual)];
    panels.extend(trial_bottoms::panel(trials));
    Plot {
        title: headline(&swept, &own),
        subtitle: format!(
            "{}: buffers without a cam, screw reset for each speed ({})",
            machine.name(),
            rule_words(reset)
        ),
        places: "speed of the press, rpm".into(),
        panels: vec![left, column],
        small: Some(by_pressure(press, pressures, family)),
        own: panels,
        table: Some(SideTable {
            title: "Set the screw".into(),
            heads: vec!["rpm".into(), "column, mm".into(), "left, N".into()],
            rows: rows
                .iter()
                .step_by(rows.len().div_ceil(SET).max(1))
                .map(|row| SideRow {
                    cells: vec![figure(row.rpm), whole(row.column_length_mm), whole(row.residual_max_n)],
                    tint: None,
                })
                .collect(),
            notes: vec!["fixed bottoms, no cam".into()],
        }),
        ..Plot::default()
    }
}

/// Speeds of the table next to the plots at the most.
const SET: usize = 14;

/// What a fixed bottom leaves at the design speed and at the slowest.
fn headline(swept: &[PlainRow], own: &PlainRow) -> String {
    let design = format!("A fixed bottom leaves {} N at {} rpm", figure(own.residual_max_n), figure(own.rpm));
    let slow = swept.first().filter(|slow| slow.rpm < own.rpm);
    slow.map_or(design.clone(), |slow| {
        format!("{design}, {} N at {} rpm", figure(slow.residual_max_n), figure(slow.rpm))
    })
}

/// Figure 4: the bottom of a cam that balances the cylinders of each end pressure.
fn by_pressure(press: &Press, pressures: &[FamilyRow], family: &[FamilyPlace]) -> SmallPlots {
    let plots = family.chunk_by(|a, b| a.end_pressure == b.end_pressure).zip(pressures);
    let plots = plots.map(|(places, row)| {
        let points: Vec<[f64; 2]> =
            places.iter().map(|place| [MILLIMETRES * place.x, MILLIMETRES * place.dx]).collect();
        SmallPlot {
            name: format!("{} at: {}", figure(row.end_pressure_pa / TECHNICAL_ATMOSPHERE), figure(row.dx_max_mm)),
            peak: None,
            points,
            figure: (format!("Ø{}", figure(row.cylinders.bore_mm)), false),
            note: format!("{} N", figure(row.residual_max_n)),
            is_own: (row.end_pressure_pa / press.end_pressure - 1.0).abs() <= SAME,
        }
    });
    SmallPlots {
        name: "Stroke Δx of a cam over the overrun for each end pressure, with the largest, mm; below: bore, mm, and force left by a fixed bottom"
            .into(),
        plots: plots.collect(),
        in_a_row: family.len(),
        left_out: String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn press() -> Press {
        *Machine::load("dpi", &[]).expect("valid").0.press().expect("a press")
    }

    /// At 5 at by 40-digit arithmetic, outside of the project, and the paper's Δx of figure 4.
    #[test]
    fn golden_end_pressure() {
        let row = of_pressure(&press(), 5.0 * TECHNICAL_ATMOSPHERE);
        assert!((row.residual_max_n / 7_155.125_152_580_824_6 - 1.0).abs() < 1e-11, "{row:?}");
        assert!((row.residual_at_mm / 118.885_941_857_911_937 - 1.0).abs() < 1e-11, "{row:?}");
        assert!((row.dx_max_mm - 60.5).abs() < 5e-3 && (row.dx_max_at_x_mm - 58.386).abs() < 5e-3, "{row:?}");
        assert!((of_pressure(&press(), 2.0 * TECHNICAL_ATMOSPHERE).residual_max_n / 3_185.746 - 1.0).abs() < 1e-6);
        assert_eq!(pressures(&press()).len(), FAMILY.len());
    }

    /// The residual of each rule by equation (9) as printed, on a scan: the end has what the rule says, the largest is found.
    #[test]
    fn each_rule_by_the_printed_equation() {
        let (press, cylinder) = (press(), press().cylinder());
        for rpm in [20.0, 35.0, 50.0] {
            for reset in [Reset::End, Reset::Half, Reset::Level] {
                let row = at_speed(&press, &cylinder, rpm, reset);
                let column = row.column_length_mm / MILLIMETRES;
                let left = |x: f64| {
                    let air = libm::pow(column / (column - x), 1.35) - 1.0;
                    press.largest_inertia(rpm) * x / 0.18 - cylinder.unit_force() * air
                };
                let scanned = (0..=18_000)
                    .map(|i| left(1e-5 * f64::from(i)))
                    .fold(0.0_f64, |a, b| if b.abs() > a.abs() { b } else { a });
                assert!((row.residual_max_n - scanned.abs()).abs() < 1e-3, "{rpm} {reset:?}: {row:?} {scanned}");
                let end = left(0.18);
                assert!((row.end_residual_n - end).abs() < 1e-7, "{rpm} {reset:?}: {row:?} {end}");
                match reset {
                    Reset::End => assert!(end.abs() < 1e-7),
                    Reset::Half => {
                        assert!((end + 0.5 * at_speed(&press, &cylinder, rpm, Reset::End).residual_max_n).abs() < 1e-7);
                    }
                    Reset::Level => assert!((row.residual_max_n - end.abs()).abs() < 1e-6 * row.residual_max_n),
                }
            }
        }
    }
}

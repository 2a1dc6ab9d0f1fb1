//! One cam at other speeds: the column is reset, or air is added, and a residual force is left. Equations (14) and (15), figure 5.

use super::at_speeds::{
    ColumnReset, CurveAxis, FixedSetting, ForcePlace, SPEEDS, columns_curve, columns_of, left_by_reset, residual_panel,
    rule_words, swept_speeds, too_long, unsigned_zero, volume, whole,
};
use crate::press::MachineOfPress;
use crate::press::balance::reversal_of_bed;
use crate::press::buffer::crank_law::CrankLaw;
use crate::press::buffer::regime::{self, Regime, Reset};
use crate::press::buffer::{CYLINDERS, Cylinder};
use crate::press::cams;
use crate::press::checks::column;
use crate::press::checks::fixed_bottom::{Rivals, over_speeds};
use crate::press::columns::CUBIC;
use crate::press::machine::Press;
use crate::press::machine::PressCams;
use crate::press::motion::Transition;
use crate::press::report::CylinderMeasures;
use crate::press::scatter::fault::FrozenBuffer;
use camgen_cams::analysis::{Analysis, Picture, places};
use camgen_cams::body::Kind;
use camgen_cams::machine::{Machine, idle_key_note};
use camgen_cams::report::ReportLine;
use camgen_cams::report::plot::{
    PictureColour, Plot, PlotBand, PlotCurve, PlotLine, PlotPanel, PlotPoint, SideRow, SideTable, figure,
};
use camgen_cams::report::{Section, Speeds, SummaryColumn, SummaryTable, Topic, length_cell, number_cell};
use camgen_cams::table::{ListedColumn, Table};
use camgen_kernel::document::{Input, NamedChoice};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::numeric::{parallel, root};
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{DIGITS, Length, LengthKind, Text, nominal, text};
use camgen_kernel::units::TECHNICAL_ATMOSPHERE;
use serde::Serialize;

/// Resets for other speeds.
pub const KIND: Kind = Kind { command: "regimes", noun: "reset of the column", keys: cams::REGIMES };

/// The figures of a speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct SpeedRow {
    rpm: f64,
    a_per_mm: f64,
    column_length_mm: f64,
    /// For all cylinders.
    added_volume_mm3: f64,
    residual_max_n: f64,
    residual_share: f64,
    residual_at_mm: f64,
    end_residual_n: f64,
    lambda: f64,
    end_pressure_pa: f64,
    crank_torque_max_nm: f64,
    camshaft_torque_max_nm: f64,
    added_volume_each_mm3: f64,
    /// A fixed bottom with its own reset by the same rule.
    fixed_column_length_mm: f64,
    fixed_residual_max_n: f64,
}

impl SpeedRow {
    fn reset(&self) -> ColumnReset {
        ColumnReset { rpm: self.rpm, column_mm: self.column_length_mm, added_mm3: self.added_volume_mm3 }
    }

    fn rivals(&self) -> Rivals {
        Rivals { rpm: self.rpm, cam: self.residual_max_n, fixed: self.fixed_residual_max_n }
    }
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
    ("added_volume_each_mm3", |row| row.added_volume_each_mm3),
    ("fixed_column_length_mm", |row| row.fixed_column_length_mm),
    ("fixed_residual_max_n", |row| row.fixed_residual_max_n),
];

/// The section `regimes`.
#[derive(Debug, Serialize)]
struct Regimes<'a> {
    cam_rpm: f64,
    reset: &'static str,
    column_length_mm: f64,
    #[serde(flatten)]
    cylinders: CylinderMeasures,
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
    let rows: Vec<SpeedRow> = all
        .iter()
        .map(|(rpm, regime)| {
            let fixed = left_by_reset(&FrozenBuffer::of_law(&press.bottom_law(*rpm), &cylinder), reset);
            at_speed(press, &design, *rpm, regime, fixed, lobes)
        })
        .collect();
    let curves: Vec<ForcePlace> = all.iter().flat_map(|(rpm, regime)| curve(&design, *rpm, regime)).collect();
    let along = CurveAxis::for_bed(&design);
    let resets: Vec<ColumnReset> = rows.iter().map(SpeedRow::reset).collect();
    let rivals: Vec<Rivals> = rows.iter().map(SpeedRow::rivals).collect();
    let regimes = Regimes {
        cam_rpm,
        reset: reset.word(),
        column_length_mm: MILLIMETRES * design.column(),
        cylinders: CylinderMeasures::new(cylinder.piston_area),
        speeds: &rows,
    };
    let rivals_of_picture = RegimeRivals { press, design: &design, cylinder, reset };
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs(KIND.keys));
    inputs.extend([
        Input::numbers("rpm", speeds),
        Input::number("cut-for", cam_rpm),
        Input::word("reset", reset.word()),
    ]);
    Ok(Analysis {
        kind: &KIND,
        variant: "",
        machine: machine.name().to_owned(),
        speeds: Speeds::Several(speeds.to_vec()),
        inputs,
        sections: std::iter::once(summarised(&regimes, Section::new(KIND.command, &regimes)))
            .chain(reversal_of_bed(machine))
            .collect(),
        measures: std::iter::once(volume(&resets, CUBIC * cylinder.volume(design.column())))
            .chain([over_speeds(&rivals)])
            .chain(column::measure(&columns_of(&resets), machine, |press, rpm| Some(press.bottom_law(rpm).column())))
            .collect(),
        notes: notes(machine),
        picture: Picture::Curves(plot(machine, cam_rpm, &rivals_of_picture, &rows, &curves)),
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
    let idle = machine.without_effect(KIND.keys).into_iter();
    let idle = idle.filter(|key| !key.starts_with("transition.") && !key.starts_with("follower."));
    idle.map(|key| idle_key_note(&key, KIND.noun)).chain(of_press).collect()
}

const NOT_MODELLED: &[&str] = &[
    "The transition before the reversal: the cam is assumed to follow its law.",
    "Leakage and the flow of heat: the exponent of the air is the same at every speed.",
    "Elasticity and play between cam and bottom.",
];

fn at_speed(press: &Press, design: &CrankLaw, rpm: f64, regime: &Regime, fixed: FixedSetting, lobes: f64) -> SpeedRow {
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
        added_volume_each_mm3: CUBIC * regime.added_volume / f64::from(CYLINDERS),
        fixed_column_length_mm: MILLIMETRES * fixed.column,
        fixed_residual_max_n: fixed.residual,
    }
}

/// Over the braking half under a yoke, whose other half is its mirror; over the whole reversal under a linkage.
fn curve(design: &CrankLaw, rpm: f64, regime: &Regime) -> Vec<ForcePlace> {
    match design {
        CrankLaw::Yoke(law) => places(law.stroke).map(|x| force_place(regime, rpm, f64::NAN, x, x)).collect(),
        CrankLaw::Linkage(law) => places(law.end.angle())
            .map(|crank| {
                let [x, deceleration] = design.bed(crank);
                force_place(regime, rpm, crank, x, deceleration)
            })
            .collect(),
    }
}

fn force_place(regime: &Regime, rpm: f64, crank: f64, x: f64, deceleration: f64) -> ForcePlace {
    ForcePlace {
        rpm,
        crank,
        x,
        inertia: regime.inertia(deceleration),
        air: regime.air(deceleration),
        residual: regime.residual(deceleration),
    }
}

/// Where the column stands at each speed, and which bottom leaves less there.
fn summarised(regimes: &Regimes<'_>, section: Section) -> Section {
    let better = |row: &SpeedRow| {
        if row.rpm == regimes.cam_rpm {
            "cam, as cut"
        } else if row.fixed_residual_max_n < row.residual_max_n {
            "fixed bottom"
        } else {
            "cam"
        }
    };
    let table = SummaryTable {
        heads: vec![
            SummaryColumn::numbers("speed", "rpm"),
            SummaryColumn::lengths("set column", &LengthKind::MM),
            SummaryColumn::lengths("screw", &LengthKind::MM),
            SummaryColumn::numbers("left over", "N"),
            SummaryColumn::numbers("fixed bottom", "leaves, N"),
            SummaryColumn::words("better"),
        ],
        rows: regimes
            .speeds
            .iter()
            .map(|row| {
                vec![
                    Text::from(nominal(row.rpm, DIGITS)),
                    length_cell(row.column_length_mm),
                    length_cell(row.column_length_mm - regimes.column_length_mm),
                    number_cell(row.residual_max_n),
                    number_cell(row.fixed_residual_max_n),
                    better(row).into(),
                ]
            })
            .collect(),
        ..SummaryTable::default()
    };
    let fixed = regimes.speeds.iter().filter(|row| better(row) == "fixed bottom").count();
    let answer = match (fixed, regimes.speeds.len()) {
        (0, _) => text!("the cam leaves least at every speed, with the column set by the screw"),
        (some, all) => text!("at {} of {} speeds a fixed bottom leaves less than the cam", some, all),
    };
    let cam = text!(
        "cut for {} rpm, column {} there; {}",
        nominal(regimes.cam_rpm, DIGITS),
        Length::mm(regimes.column_length_mm).brief(),
        text!("rule \"{}\" for the end of the stroke (--reset)", regimes.reset)
    );
    section.with_words(describe(regimes)).with_fact(Topic::new(20, "cam"), cam).with_answer(answer).with_table(table)
}

fn describe(regimes: &Regimes<'_>) -> Vec<ReportLine> {
    let mut lines: Vec<ReportLine> = vec![
        text!(
            "cam for {} rpm, column {} there; reset: {}; {}",
            regimes.cam_rpm,
            Length::mm(regimes.column_length_mm).decimals(3),
            regimes.reset,
            regimes.cylinders.describe()
        )
        .into(),
    ];
    lines.push(ReportLine::row(format!(
        "{:>8} {:>11} {:>8} {:>12} {:>12} {:>11} {:>10} {:>8} {:>9} {:>10} {:>9} {:>11} {:>11}",
        "rpm",
        "column/mm",
        "λ",
        "V each/cm³",
        "V all/cm³",
        "left/N",
        "fixed/N",
        "left/%",
        "at x/mm",
        "end/N",
        "p_end/at",
        "crank/Nm",
        "cam/Nm"
    )));
    lines.extend(regimes.speeds.iter().map(|row| {
        ReportLine::row(format!(
            "{:>8} {:>11.3} {:>8.5} {:>12} {:>12} {:>11.2} {:>10.2} {:>8.3} {:>9.3} {:>10} {:>9.4} {:>11.2} {:>11.2}",
            row.rpm,
            row.column_length_mm,
            row.lambda,
            unsigned_zero(1e-3 * row.added_volume_each_mm3, 1),
            unsigned_zero(1e-3 * row.added_volume_mm3, 1),
            row.residual_max_n,
            row.fixed_residual_max_n,
            100.0 * row.residual_share,
            row.residual_at_mm,
            unsigned_zero(row.end_residual_n, 3),
            row.end_pressure_pa / TECHNICAL_ATMOSPHERE,
            row.crank_torque_max_nm,
            row.camshaft_torque_max_nm
        ))
    }));
    lines
}

/// The cam and a fixed bottom at a speed, each with its own reset.
#[derive(Debug, Clone, Copy)]
struct RivalSettings {
    rpm: f64,
    /// Largest residual force, N, and column, mm: of the cam, and of the fixed bottom.
    left: [f64; 2],
    column: [f64; 2],
}

impl RivalSettings {
    fn fixed_is_better(&self) -> bool {
        self.left[1] < self.left[0]
    }
}

/// A cam and its rival, to be set for any speed.
struct RegimeRivals<'a> {
    press: &'a Press,
    design: &'a CrankLaw,
    cylinder: Cylinder,
    reset: Reset,
}

impl RegimeRivals<'_> {
    fn at(&self, rpm: f64) -> RivalSettings {
        let cam = regime::reset(self.design, &self.cylinder, rpm, self.reset);
        let fixed = left_by_reset(&FrozenBuffer::of_law(&self.press.bottom_law(rpm), &self.cylinder), self.reset);
        RivalSettings {
            rpm,
            left: [cam.residual.abs(), fixed.residual],
            column: [MILLIMETRES * cam.column, MILLIMETRES * fixed.column],
        }
    }

    /// The speeds between two at which both have the same residual force.
    fn crossings(&self, swept: &[RivalSettings]) -> Vec<RivalSettings> {
        let more = |rpm: f64| self.at(rpm).left;
        let between = swept.iter().zip(swept.iter().skip(1));
        between
            .filter(|(a, b)| a.fixed_is_better() != b.fixed_is_better())
            .filter_map(|(a, b)| {
                let difference = |rpm: f64| {
                    let [cam, fixed] = more(rpm);
                    cam - fixed
                };
                Some(self.at(root::bracketed(difference, a.rpm, b.rpm, 1e-4).ok()?))
            })
            .collect()
    }
}

/// At which speeds the cam is worth it.
fn headline(swept: &[RivalSettings], crossings: &[RivalSettings]) -> String {
    let first_is_fixed = swept.first().is_some_and(RivalSettings::fixed_is_better);
    match (first_is_fixed, crossings) {
        (true, []) => "A fixed bottom leaves less force than the cam at every speed".into(),
        (false, []) => match swept {
            [first, .., last] => format!(
                "From {} to {} rpm the cam leaves less force than a fixed bottom",
                figure(first.rpm),
                figure(last.rpm)
            ),
            _ => "The cam leaves less force than a fixed bottom".into(),
        },
        (true, [at]) => format!("Best below {} rpm: a fixed bottom; above it the cam", three(at.rpm)),
        (false, [at]) => format!("Best above {} rpm: a fixed bottom; below it the cam", three(at.rpm)),
        (true, [low, high, ..]) => {
            format!("Best from {} to {} rpm: the cam; else a fixed bottom", three(low.rpm), three(high.rpm))
        }
        (false, [low, high, ..]) => {
            format!("Best from {} to {} rpm: a fixed bottom; else the cam", three(low.rpm), three(high.rpm))
        }
    }
}

/// A speed that is read off, to a tenth.
fn three(rpm: f64) -> String {
    figure((10.0 * rpm).round() / 10.0)
}

/// Speeds of the table next to the plots at the most.
const SET: usize = 14;

/// What to set for the speeds that were asked for, by the better of both.
fn table(rows: &[SpeedRow]) -> SideTable {
    let every = rows.len().div_ceil(SET).max(1);
    let row = |row: &SpeedRow| {
        let is_fixed = row.fixed_residual_max_n < row.residual_max_n;
        let (column, left) = if is_fixed {
            (row.fixed_column_length_mm, row.fixed_residual_max_n)
        } else {
            (row.column_length_mm, row.residual_max_n)
        };
        SideRow {
            cells: vec![figure(row.rpm), whole(column), whole(left)],
            tint: is_fixed.then_some(PictureColour::Line(FIXED)),
        }
    };
    let tinted = rows.iter().any(|row| row.fixed_residual_max_n < row.residual_max_n);
    SideTable {
        title: "Set the screw".into(),
        heads: vec!["rpm".into(), "column, mm".into(), "left, N".into()],
        rows: rows.iter().step_by(every).map(row).collect(),
        notes: tinted.then(|| "tinted: a fixed bottom, the cam taken out".to_owned()).into_iter().collect(),
    }
}

/// Colours of the cam and of a fixed bottom.
const CAM: usize = 0;
const FIXED: usize = 1;

/// Both over the speed: the force that is left, the column to set, and where in the stroke the force is left.
fn plot(machine: &Machine, cam_rpm: f64, rivals: &RegimeRivals<'_>, rows: &[SpeedRow], curves: &[ForcePlace]) -> Plot {
    let along = CurveAxis::for_bed(rivals.design);
    let asked: Vec<f64> = rows.iter().map(|row| row.rpm).collect();
    let swept = parallel::map(&swept_speeds(cam_rpm, &asked), |rpm| rivals.at(*rpm));
    let crossings = rivals.crossings(&swept);
    let lines = || {
        let borders = crossings.iter().map(|at| PlotLine { at: at.rpm, text: String::new(), dashed: true });
        borders.chain([PlotLine { at: cam_rpm, text: String::new(), dashed: false }]).collect::<Vec<_>>()
    };
    let own = rivals.at(cam_rpm);
    let mut ends = vec![swept.first().map_or(0.0, |first| first.rpm)];
    ends.extend(crossings.iter().map(|at| at.rpm));
    ends.extend(swept.last().map(|last| last.rpm));
    let first_is_fixed = swept.first().is_some_and(RivalSettings::fixed_is_better);
    let bands =
        ends.iter().zip(ends.iter().skip(1)).enumerate().filter(|(index, _)| (index % 2 == 0) == first_is_fixed);
    let bands = bands.map(|(_, (low, high))| PlotBand::better(*low, *high, FIXED, "fixed bottom is better"));
    let by_speed = |which: usize, value: fn(&RivalSettings) -> [f64; 2]| {
        swept.iter().map(|at| [at.rpm, value(at).get(which).copied().unwrap_or(f64::NAN)]).collect::<Vec<_>>()
    };
    let mut points: Vec<PlotPoint> = crossings
        .iter()
        .map(|at| {
            PlotPoint::ring([at.rpm, at.left[0]], format!("{} rpm: both leave {} N", three(at.rpm), figure(at.left[0])))
        })
        .collect();
    points.push(PlotPoint::dot([cam_rpm, own.left[1]], FIXED, format!("{} N", figure(own.left[1]))));
    points.push(PlotPoint::dot([cam_rpm, own.left[0]], CAM, format!("{} N", figure(own.left[0]))));
    let mut cut = lines();
    if let Some(last) = cut.last_mut() {
        last.text = format!("{} rpm: as cut", figure(cam_rpm));
    }
    let left = PlotPanel {
        points,
        lines: cut,
        bands: bands.collect(),
        height: 2.0,
        ..PlotPanel::new(
            "Largest force left over, N",
            vec![
                PlotCurve::new("fixed bottom", FIXED, by_speed(1, |at| at.left)),
                PlotCurve::new("this cam", CAM, by_speed(0, |at| at.left)),
            ],
        )
    };
    let too_long = too_long(machine);
    let limit = too_long.from;
    let columns = |name, which: usize| columns_curve(name, which, by_speed(which, |at| at.column).into_iter(), limit);
    let column = PlotPanel {
        lines: lines(),
        bands: vec![too_long],
        height: 1.2,
        ..PlotPanel::new(
            "Column to set by the screw, mm",
            vec![columns("fixed bottom", FIXED), columns("this cam", CAM)],
        )
    };
    Plot {
        title: headline(&swept, &crossings),
        subtitle: format!(
            "{}: cam cut for {} rpm, screw reset for each speed ({})",
            machine.name(),
            figure(cam_rpm),
            rule_words(rivals.reset)
        ),
        places: "speed of the press, rpm".into(),
        panels: vec![left, column],
        own: vec![(along.words.into(), residual_panel(curves, &along))],
        table: Some(table(rows)),
        ..Plot::default()
    }
}

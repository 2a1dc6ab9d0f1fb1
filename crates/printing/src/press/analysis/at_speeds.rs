//! The forces of the buffers of a press at several speeds, with a cam and without one: the curves, their picture, and the volume of (15).

use crate::press::buffer::bottom_law::column_for;
use crate::press::buffer::crank_law::CrankLaw;
use crate::press::buffer::regime::Reset;
use crate::press::checks::air::ADDED_VOLUME;
use crate::press::checks::column;
use crate::press::load::ColumnAtSpeed;
use crate::press::machine::PressCams;
use crate::press::scatter::fault::FrozenBuffer;
use crate::press::scatter::reset::ScrewRule;
use crate::press::scatter::settings::FixedBottom;
use camgen_cams::analysis::PLACES;
use camgen_cams::check::Measure;
use camgen_cams::machine::Machine;
use camgen_cams::report::plot::{PlotBand, PlotCurve, PlotPanel, figure};
use camgen_cams::table::ListedColumn;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::refusal::WorkBound;
use camgen_kernel::text::{Length, Text, text};

/// Speeds of one call.
pub(super) const SPEEDS: WorkBound = WorkBound { what: "speeds", most: 1000 };
/// A volume of less than this share of the cylinders' is rounding.
const NO_VOLUME: f64 = 1e-12;

/// A fixed bottom with its own reset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FixedSetting {
    /// Column, m.
    pub(super) column: f64,
    /// Largest residual force, N.
    pub(super) residual: f64,
}

/// A fixed bottom set by a rule of `camgen regimes` for the loading A at a speed.
pub(super) fn left_by_reset(frozen: &FrozenBuffer, reset: Reset) -> FixedSetting {
    let column = column_by(frozen, reset);
    FixedSetting { column, residual: FixedBottom::new(frozen).left(column, 1.0) }
}

/// Column of a fixed bottom, m, by a rule of `camgen regimes` for the loading A at a speed.
pub(super) fn column_by(frozen: &FrozenBuffer, reset: Reset) -> f64 {
    let fixed = FixedBottom::new(frozen);
    match reset {
        Reset::End => fixed.column(1.0, ScrewRule::End),
        Reset::Half => {
            let worst = fixed.left(fixed.column(1.0, ScrewRule::End), 1.0) / frozen.unit_force;
            // By `end` the air is too weak in mid-stroke: half of that residual is added at the end.
            column_for(frozen.path.stroke(), frozen.end_load() + 0.5 * worst, frozen.exponent)
        }
        Reset::Level => fixed.column(1.0, ScrewRule::Level),
    }
}

/// The forces at a point of the reversal and a speed.
pub(super) struct ForcePlace {
    pub(super) rpm: f64,
    /// Crank angle from the start of the reversal, rad; not known under a yoke.
    pub(super) crank: f64,
    pub(super) x: f64,
    pub(super) inertia: f64,
    pub(super) air: f64,
    pub(super) residual: f64,
}

pub(super) const CURVES: &[ListedColumn<ForcePlace>] = &[
    ("rpm", |row| row.rpm),
    ("x_mm", |row| MILLIMETRES * row.x),
    ("inertia_n", |row| row.inertia),
    ("air_n", |row| row.air),
    ("residual_n", |row| row.residual),
];

/// Under a linkage the bed passes one position with two forces: the curves run along the crank angle.
const CURVES_OF_A_LINKAGE: &[ListedColumn<ForcePlace>] = &[
    ("rpm", |row| row.rpm),
    ("crank_deg", |row| row.crank.to_degrees()),
    ("x_mm", |row| MILLIMETRES * row.x),
    ("inertia_n", |row| row.inertia),
    ("air_n", |row| row.air),
    ("residual_n", |row| row.residual),
];

/// The horizontal axis of the curves.
pub(super) struct CurveAxis {
    pub(super) list: &'static [ListedColumn<ForcePlace>],
    pub(super) column: &'static str,
    pub(super) words: &'static str,
    value: fn(&ForcePlace) -> f64,
}

impl CurveAxis {
    pub(super) const OVERRUN: Self =
        Self { list: CURVES, column: "x_mm", words: "overrun x of the bed, mm", value: |place| MILLIMETRES * place.x };

    pub(super) fn for_bed(design: &CrankLaw) -> Self {
        match design {
            CrankLaw::Yoke(_) => Self::OVERRUN,
            CrankLaw::Linkage(_) => Self {
                list: CURVES_OF_A_LINKAGE,
                column: "crank_deg",
                words: "crank angle from the start of the reversal, degrees",
                value: |place| place.crank.to_degrees(),
            },
        }
    }
}

/// A reset of the air column for a speed.
pub(super) struct ColumnReset {
    pub(super) rpm: f64,
    pub(super) column_mm: f64,
    pub(super) added_mm3: f64,
}

/// The columns of resets.
pub(super) fn columns_of(resets: &[ColumnReset]) -> Vec<ColumnAtSpeed> {
    resets.iter().map(|reset| ColumnAtSpeed { length: reset.column_mm / MILLIMETRES, rpm: reset.rpm }).collect()
}

/// The least volume to add, mm³, to the own one of the cylinders: air cannot be taken away from a cylinder at ambient pressure.
pub(super) fn volume(resets: &[ColumnReset], own: f64) -> Measure {
    let rounding = NO_VOLUME * own;
    let least = resets.iter().map(|reset| reset.added_mm3).fold(f64::INFINITY, f64::min);
    let below: Vec<Text> = resets
        .iter()
        .filter(|reset| reset.added_mm3 < -rounding)
        .map(|reset| text!("to {} for {} rpm", Length::mm(reset.column_mm).decimals(3), reset.rpm))
        .collect();
    let note = (!below.is_empty()).then(|| {
        let below = Text::joined(below, ", ");
        text!("air would have to be taken away; shorten the column by its screw instead, {}", below)
    });
    let least = if least.abs() <= rounding { 0.0 } else { least };
    ADDED_VOLUME.measure(least, Some(0.0)).noted(note)
}

/// A number with these decimals; a rounded 0 has no sign.
pub(super) fn unsigned_zero(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    text.strip_prefix('-')
        .filter(|size| size.bytes().all(|c| matches!(c, b'0' | b'.')))
        .map_or(text.clone(), str::to_owned)
}

/// Speeds whose residual force is drawn.
const DRAWN: usize = 4;

/// The residual force over the reversal, a curve for each of a few speeds: the first, the last, and those between.
pub(super) fn residual_panel(all: &[ForcePlace], along: &CurveAxis) -> PlotPanel {
    let speeds: Vec<&[ForcePlace]> = all.chunks(PLACES as usize + 1).collect();
    let chosen = speeds.len().min(DRAWN);
    let mut curves = Vec::new();
    for index in 0..chosen {
        let at = if chosen > 1 { index * (speeds.len() - 1) / (chosen - 1) } else { 0 };
        let Some(places) = speeds.get(at) else { continue };
        let name = places.first().map_or_else(String::new, |place| format!("{} rpm", figure(place.rpm)));
        let points = places.iter().map(|place| [(along.value)(place), place.residual]).collect();
        curves.push(PlotCurve::new(name, index, points));
    }
    PlotPanel::new("Residual force over the stroke, inertia less air, N", curves)
}

/// Speeds of a picture over that of the cam or the design, and steps between them.
const SWEPT: [f64; 2] = [0.35, 1.15];
const STEPS: u32 = 60;

/// Round speeds about one, and about those that were asked for, rpm.
pub(super) fn swept_speeds(about: f64, asked: &[f64]) -> Vec<f64> {
    let asked = || asked.iter().copied().filter(|rpm| *rpm > 0.0 && rpm.is_finite());
    let low = asked().fold((SWEPT[0] * about).floor().max(0.1 * about), f64::min);
    let high = asked().fold((SWEPT[1] * about).round().max(about), f64::max);
    (0..=STEPS).map(|step| low + (high - low) * f64::from(step) / f64::from(STEPS)).collect()
}

/// What a rule for the screw does, in a few words.
pub(super) fn rule_words(reset: Reset) -> &'static str {
    match reset {
        Reset::End => "rule “end”: no force is left at the end of the stroke",
        Reset::Half => "rule “half”: half of the largest force is moved to the end of the stroke",
        Reset::Level => "rule “level”: the largest force is as small as the screw can make it",
    }
}

/// A figure of a table to set a press by: whole, that a column has one place of its point; a small one keeps its digits.
pub(super) fn whole(value: f64) -> String {
    figure(if value.abs() < 10.0 { value } else { value.round() })
}

/// Columns that a press has no room for, mm, with the reason.
pub(super) fn too_long(machine: &Machine) -> PlotBand {
    let given = PressCams::of(machine).largest_column;
    let limit = MILLIMETRES * given.unwrap_or(column::CUSTOMARY);
    let reason = match given {
        Some(_) => format!("longer than limits.column, {} mm", figure(limit)),
        None => format!("over the customary {} mm: no such cylinder", figure(limit)),
    };
    PlotBand::above(limit, reason)
}

/// Columns far beyond the limit would flatten the others.
const CUT_OFF: f64 = 1.15;

/// A curve of columns, as far as it is near the limit.
pub(super) fn columns_curve(
    name: &str,
    colour: usize,
    points: impl Iterator<Item = [f64; 2]>,
    limit: f64,
) -> PlotCurve {
    PlotCurve::new(name, colour, points.filter(|[_, column]| *column <= CUT_OFF * limit).collect())
}

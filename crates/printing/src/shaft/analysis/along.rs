//! The tables along the shaft.

use super::{MOST_MODES, ShaftResults, named};
use crate::shaft::mechanics::StepSide;
use camgen_cams::table::Table;

/// Names of the columns of the modes.
const MODES: [&str; MOST_MODES] =
    ["mode1", "mode2", "mode3", "mode4", "mode5", "mode6", "mode7", "mode8", "mode9", "mode10", "mode11", "mode12"];

/// Positions along the shaft, m, each with its side of a step: at a step both.
pub(super) fn places(found: &ShaftResults<'_>) -> Vec<(f64, StepSide)> {
    let (length, samples) = (found.shaft.length(), found.asked.samples.max(2));
    let mut places: Vec<(f64, StepSide)> = (0..samples)
        .map(|i| if i + 1 == samples { length } else { length * f64::from(i) / f64::from(samples - 1) })
        .map(|x| (x, StepSide::Right))
        .collect();
    let steps = found.shaft.steps();
    places.retain(|(x, _)| steps.iter().all(|step| (step - x).abs() > 1e-9 * length));
    places.extend(steps.iter().flat_map(|step| [(*step, StepSide::Left), (*step, StepSide::Right)]));
    places.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1 == StepSide::Right).cmp(&(b.1 == StepSide::Right))));
    places
}

/// The table of the shaft.
pub(super) fn table(found: &ShaftResults<'_>) -> Table {
    let mut rows = Vec::new();
    for (x, side) in places(found) {
        let (diameter, bore) = found.shaft.section_at(x, side);
        let mut row = vec![1e3 * x, 1e3 * diameter, 1e3 * bore];
        row.extend(found.spectrum.modes.iter().map(|mode| mode.shape.evaluate(x)[0] + 0.0));
        if let Some(statics) = &found.statics {
            let [deflection, slope] = statics.curve.evaluate(x);
            row.extend([1e9 * deflection + 0.0, 1e9 * slope + 0.0]);
        }
        rows.push(row);
    }
    let mut columns = vec!["x_mm", "diameter_mm", "bore_mm"];
    columns.extend(MODES.iter().take(found.spectrum.modes.len()));
    let more: &[&str] = if found.statics.is_some() { &["deflection_um_per_kn", "slope_urad_per_kn"] } else { &[] };
    named(columns, more, rows)
}

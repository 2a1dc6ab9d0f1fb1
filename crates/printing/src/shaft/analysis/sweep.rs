//! Critical speeds over the stiffness of the supports: the paper's figure 3.

use super::spectrum::CriticalSpeeds;
use super::{MOST_MODES, ShaftResults, named, rpm};
use crate::shaft::mechanics::Shaft;
use camgen_cams::table::Table;
use camgen_kernel::refusal::Refusal;

/// Names of the columns.
const SPEEDS: [&str; MOST_MODES] = [
    "n1_rpm", "n2_rpm", "n3_rpm", "n4_rpm", "n5_rpm", "n6_rpm", "n7_rpm", "n8_rpm", "n9_rpm", "n10_rpm", "n11_rpm",
    "n12_rpm",
];

/// A stiffness, N/m, and the critical speeds with it, rad/s.
pub(super) struct SweepRow {
    pub(super) stiffness: f64,
    pub(super) speeds: Vec<f64>,
}

/// Equal steps from the one stiffness to the other, both included.
pub(super) fn rows(found: &ShaftResults<'_>, from: f64, to: f64) -> Result<Vec<SweepRow>, Refusal> {
    if found.shaft.supports().iter().all(|support| support.stiffness.is_none()) {
        return Err(Refusal::new(
            "--sweep gives elastic supports their stiffness, and every support of this shaft is rigid",
        ));
    }
    let steps = found.asked.steps.max(1);
    let mut rows = Vec::new();
    for step in 0..=steps {
        let stiffness = if step == steps { to } else { from + (to - from) * f64::from(step) / f64::from(steps) };
        let shaft = found.shaft.with_stiffness(stiffness)?;
        let mut speeds = CriticalSpeeds::find(&shaft, found.asked)
            .map_err(|why| why.context(&format!("with supports of {stiffness:e} N/m")))?
            .speeds;
        // With a softer support fewer may be found.
        speeds.resize(found.spectrum.speeds.len(), f64::NAN);
        rows.push(SweepRow { stiffness, speeds });
    }
    Ok(rows)
}

/// The first critical speed on rigid supports, rad/s: the asymptote.
pub(super) fn rigid(found: &ShaftResults<'_>) -> Option<f64> {
    let supports =
        found.shaft.supports().iter().map(|support| crate::shaft::mechanics::Support { stiffness: None, ..*support });
    let shaft = Shaft::new(
        found.shaft.segments().to_vec(),
        supports.collect(),
        found.shaft.discs().to_vec(),
        found.shaft.beam(),
    );
    Some(CriticalSpeeds::find(&shaft.ok()?, found.asked).ok()?.first())
}

/// The table of a sweep.
pub(super) fn table(rows: &[SweepRow], modes: usize) -> Table {
    let count = rows.first().map_or(0, |row| row.speeds.len()).min(modes);
    let values =
        rows.iter().map(|row| std::iter::once(row.stiffness).chain(row.speeds.iter().copied().map(rpm)).collect());
    named(vec!["stiffness_n_per_m"], SPEEDS.get(..count).unwrap_or_default(), values.collect())
}

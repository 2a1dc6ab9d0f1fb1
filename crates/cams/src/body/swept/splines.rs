//! The flanks as bicubic spline patches.

use super::SweptWords;
use camgen_kernel::geometry::patch_fit::{FlankStretch, fitted};
use camgen_kernel::geometry::solid::SplineSurface;
use camgen_kernel::refusal::{Refusal, WorkBound};

/// Longest patch, rad.
pub(crate) const LONGEST_PATCH: f64 = std::f64::consts::PI / 6.0;
/// Share of the tolerance that the splines may miss: a flank that misses everywhere to one side would change the volume.
const SHARE: f64 = 0.02;
/// Spline cells of the flanks; each is compared with the exact flank at 64 points or more.
const CELLS: WorkBound = WorkBound { what: "spline cells of the flanks", most: 12_000 };

/// The patches of stretches of flanks, across a range (mm) of their second parameter, with their largest distance from the exact flanks between the nodes,
/// mm.
///
/// # Errors
/// [`Refusal`] when the tolerance (mm) is finer than splines of a reasonable size can keep.
pub(crate) fn fitted_flanks(
    stretches: &[FlankStretch<'_>],
    across: (f64, f64),
    tolerance: f64,
    words: SweptWords,
) -> Result<(Vec<SplineSurface>, f64), Refusal> {
    let (patches, deviation) = fitted(stretches, across, SHARE * tolerance).map_err(|(missed, rings)| {
        let noun = words.noun;
        Refusal::new(format!("the flanks of the {noun} miss by {missed:.2e} mm, with {rings} rings of splines"))
            .remedy(words.smoother)
    })?;
    let spans = |knots: &[f64]| knots.windows(2).filter(|pair| pair[1] > pair[0]).count();
    let cells = patches.iter().map(|patch| spans(&patch.u) * spans(&patch.v)).sum();
    CELLS.allow(cells).map_err(|refusal| refusal.remedy("give a coarser --tolerance"))?;
    Ok((patches, deviation))
}

//! The settings that are measured: arcs by distance and by acceleration, splines, points.

use super::measure::{TradeLaw, TradeProduct, TradeSetting};
use crate::pipeline::Spec;
use crate::write::number::shortest;
use camgen_kernel::document::NamedChoice;
use camgen_kernel::geometry::points::PointInterpolation;
use camgen_kernel::profile::outline::SegmentKind;
use camgen_kernel::refusal::Refusal;

/// Distances of the ladder, m, from coarse to fine.
const TOLERANCES: [(&str, f64); 9] = [
    ("100 µm", 100e-6),
    ("50 µm (draft)", 50e-6),
    ("10 µm", 10e-6),
    ("5 µm", 5e-6),
    ("1 µm", 1e-6),
    ("0.5 µm", 0.5e-6),
    ("0.1 µm", 0.1e-6),
    ("0.05 µm", 0.05e-6),
    ("0.01 µm", 0.01e-6),
];
/// Outlines that also keep the acceleration: name, distance in m, share of the acceleration, and what they are drawn in; those of
/// `--accuracy` with their names.
const WITH_ACCELERATION: [(&str, f64, Option<f64>, SegmentKind); 6] = [
    ("5 µm, 5 % (standard)", 5e-6, Some(0.05), SegmentKind::Arcs),
    ("5 µm, 2 %", 5e-6, Some(0.02), SegmentKind::Arcs),
    ("0.5 µm, 1 % (fine)", 0.5e-6, Some(0.01), SegmentKind::Arcs),
    ("spline, 5 µm", 5e-6, None, SegmentKind::Splines),
    ("spline, 5 µm, 5 %", 5e-6, Some(0.05), SegmentKind::Splines),
    ("spline, 0.5 µm, 1 %", 0.5e-6, Some(0.01), SegmentKind::Splines),
];
/// Points in x and y by equal chord error: name, distance in m, share of the acceleration, and the interpolation of the control between them.
const POINTS: [(&str, f64, Option<f64>, PointInterpolation); 5] = [
    ("points, linear, 5 µm", 5e-6, None, PointInterpolation::Linear),
    ("points, cubic, 5 µm", 5e-6, None, PointInterpolation::Cubic),
    ("points, cubic, 5 µm, 5 %", 5e-6, Some(0.05), PointInterpolation::Cubic),
    ("points, cubic, 0.5 µm", 0.5e-6, None, PointInterpolation::Cubic),
    ("points, cubic, 0.5 µm, 1 %", 0.5e-6, Some(0.01), PointInterpolation::Cubic),
];

/// Laws, and settings that use them.
pub type SettingLadder = (Vec<TradeLaw>, Vec<TradeSetting>);

/// The flags of an outline that is drawn to a distance, m, and keeps a share of the acceleration.
#[must_use]
pub fn flags(tolerance: f64, share: Option<f64>) -> String {
    // Flags give a tolerance in micrometres; rounding removes the digits that the conversion adds.
    let micrometres = shortest((1e12 * tolerance).round() / 1e6);
    let share = share.map_or("none".to_owned(), |share| format!("{}%", shortest((1e8 * share).round() / 1e6)));
    format!("--tolerance {micrometres}um --tolerance-acceleration {share}")
}

/// Outlines from coarse to fine, with the first law.
#[must_use]
pub fn ladder() -> Vec<TradeSetting> {
    let arcs = TOLERANCES.iter().map(|(name, tolerance)| (*name, *tolerance, None, SegmentKind::Arcs));
    let all = arcs.chain(WITH_ACCELERATION);
    all.map(|(name, tolerance, share, laid)| TradeSetting {
        name: name.into(),
        flags: Some(flags(tolerance, share) + if laid == SegmentKind::Splines { " --outline spline" } else { "" }),
        law: 0,
        tolerance,
        made: TradeProduct::Outline { laid, share },
    })
    .collect()
}

/// A disc cam over the ladder; its law is a closed form, exact to rounding.
///
/// # Errors
/// [`Refusal`] when there is no such cam.
pub fn of_disc(spec: impl Fn() -> Result<Spec, Refusal> + 'static) -> Result<SettingLadder, Refusal> {
    let solve = move || spec()?.solve().map_err(Refusal::of);
    let law = TradeLaw { cam: solve()?, solve: Box::new(solve), error_mm: 0.0, residual_n: 0.0 };
    let points = POINTS.iter().map(|(name, tolerance, share, between)| TradeSetting {
        name: (*name).into(),
        flags: Some(format!(
            "{} --format points --points-as xy --points-step chord --points-between {}",
            flags(*tolerance, *share),
            between.word()
        )),
        law: 0,
        tolerance: *tolerance,
        made: TradeProduct::Points { between: *between, share: *share },
    });
    Ok((vec![law], ladder().into_iter().chain(points).collect()))
}

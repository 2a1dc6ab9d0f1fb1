//! K_c over the base of a drag link, its other links as they are: figure 2 of the paper.

use crate::press::bed_motion::{self, DragLink, Linkage, Slider};
use camgen_cams::report::plot::{PlotCurve, PlotPanel, PlotPoint, figure};
use camgen_cams::report::trace::round_step;

/// Share of the base at which the drag link no longer turns up to which the curve goes: there K_c goes to 0 or beyond bounds.
const SHARE: f64 = 0.95;
/// Most steps of the curve; they are round, so that the bases of the paper are among them.
const STEPS: f64 = 100.0;

/// K_c of a six-bar with another base.
fn ratio(link: DragLink, slider: Slider, base: f64) -> f64 {
    bed_motion::characteristics(&Linkage::SixBar(DragLink { base, ..link }, slider)).acceleration_ratio
}

/// K_c at round bases, as far as the drag link turns.
pub(super) fn curve(link: DragLink, slider: Slider) -> Vec<[f64; 2]> {
    let end = SHARE * link.remedies().base.below;
    let step = round_step(end, STEPS);
    let bases = (0..).map(|i| f64::from(i) * step).take_while(|base| *base < end).chain([end]);
    bases.map(|base| [base, ratio(link, slider, base)]).collect()
}

/// The diagram with this design, and the name of its axis.
pub(super) fn diagram(link: DragLink, slider: Slider) -> (String, PlotPanel) {
    let points = curve(link, slider);
    let end = points.last().map_or(0.0, |[base, _]| *base);
    let own = ratio(link, slider, link.base);
    let level = vec![[0.0, 1.0], [end, 1.0]];
    let panel = PlotPanel {
        points: vec![PlotPoint::ring(
            [link.base, own],
            format!("this design: λ1 = {}, K_c = {}", figure(link.base), figure(own)),
        )],
        ..PlotPanel::new(
            "K_c, largest acceleration at the outer end over that at the inner one, for other bases",
            vec![PlotCurve::grey("equal at both ends", level), PlotCurve::new("", 0, points)],
        )
    };
    ("base of the drag link over its driving crank, λ1".into(), panel)
}

//! Where the joints of the best chain lie to first order, counted in best possible arcs.
//!
//! Within a stretch of growing or falling curvature the arcs of the best chain are one share long. An exact tangent at
//! an end of the piece leaves the arc there one lobe, e = −κ'/6 s²(s − h), which reaches the tolerance after
//! (40.5/124.7)^(1/3) = 0.69 of a share, whether κ' vanishes there or not. An extremum of the curvature lies in the middle
//! of an arc of three lobes, e = −κ''/24 (s⁴ − a²s² + b), which is 1.56 shares long. Between two such places the number
//! of arcs is whole, so that each stretch has a scale of its own.

use super::nodes::CurveSample;
use super::trial::JointPlace;

/// By how much the arc at an exact tangent is shorter.
const CLAMPED: f64 = 0.31;
/// How far an arc over an extremum of the curvature extends to either side.
const HALF_OVER: f64 = 0.78;
/// Least shares between two extrema, or an extremum and an end; nearer ones are ignored. Tried from 0.5 to 1.5
/// and from 0.2 to 0.7 on 1552 pieces: these give the fewest arcs, by one in fifty pieces.
const LEAST_BETWEEN: f64 = 1.0;
const LEAST_AT_END: f64 = 0.2;

/// Steepest heading relative to the curve to start from: where κ' changes within an arc, that of a node may not fit any chain.
const STEEPEST: f64 = 0.3;

/// Cosine of the turn between two joints beyond which more joints are inserted.
const SHARPEST: f64 = -0.9;

/// A stretch between the ends of the piece and the extrema of its curvature.
#[derive(Debug, Clone, Copy)]
struct CurvatureStretch {
    from: f64,
    to: f64,
    /// Whether it begins and ends at an end of the piece, not at an extremum.
    clamped: (bool, bool),
    /// Whole arcs in it.
    arcs: u32,
}

impl CurvatureStretch {
    /// How much its ends take in addition to its whole arcs, in arcs.
    fn taken(&self) -> f64 {
        let [first, last] = [self.clamped.0, self.clamped.1].map(|clamped| if clamped { -CLAMPED } else { HALF_OVER });
        first + last
    }

    /// Shares per arc.
    fn scale(&self) -> f64 {
        (self.to - self.from) / (f64::from(self.arcs) + self.taken())
    }
}

/// The stretches of a piece.
#[derive(Debug, Clone)]
pub(super) struct ArcSpacing(Vec<CurvatureStretch>);

impl ArcSpacing {
    /// The least number of arcs that may be sufficient.
    pub(super) fn new(nodes: &[CurveSample]) -> Self {
        let total = nodes.last().map_or(0.0, |node| node.share);
        let mut bounds: Vec<f64> = Vec::new();
        let signs = nodes.iter().filter(|node| node.best_heading != 0.0);
        for (before, node) in signs.clone().zip(signs.skip(1)) {
            if before.best_heading.signum() == node.best_heading.signum() {
                continue;
            }
            let share = 0.5 * (before.share + node.share);
            match bounds.last() {
                // Two extrema close together are ignored.
                Some(last) if share - last < LEAST_BETWEEN => _ = bounds.pop(),
                None if share < LEAST_AT_END => {}
                _ => bounds.push(share),
            }
        }
        while bounds.last().is_some_and(|last| total - last < LEAST_AT_END) {
            bounds.pop();
        }
        let starts = std::iter::once(0.0).chain(bounds.iter().copied());
        let ends = bounds.iter().copied().chain([total]);
        let last = bounds.len();
        let stretches = starts.zip(ends).enumerate().map(|(index, (from, to))| {
            let clamped = (index == 0, index == last);
            CurvatureStretch { from, to, clamped, arcs: u32::from(clamped.0 && clamped.1) }
        });
        let mut spacing = Self(stretches.collect());
        #[expect(clippy::cast_precision_loss, reason = "few extrema")]
        let ideal = spacing.0.iter().map(|s| s.to - s.from - s.taken()).sum::<f64>() + last as f64;
        while f64::from(spacing.arcs()) < ideal.max(2.0) {
            spacing.add_arc();
        }
        spacing
    }

    /// Number of arcs.
    pub(super) fn arcs(&self) -> u32 {
        let whole: u32 = self.0.iter().map(|stretch| stretch.arcs).sum();
        whole + u32::try_from(self.0.len()).unwrap_or(u32::MAX) - 1
    }

    /// Adds one arc where the arcs are longest.
    pub(super) fn add_arc(&mut self) {
        if let Some(widest) = self.0.iter_mut().max_by(|a, b| a.scale().total_cmp(&b.scale())) {
            widest.arcs += 1;
        }
    }

    /// Every joint, on the curve with the heading of the best chain; at the ends with that of the curve.
    pub(super) fn places(&self, nodes: &[CurveSample]) -> Vec<JointPlace> {
        let mut pairs = nodes.iter().zip(nodes.iter().skip(1)).peekable();
        let mut places: Vec<JointPlace> = nodes.iter().take(1).map(JointPlace::on_curve).collect();
        for stretch in &self.0 {
            let scale = stretch.scale();
            let first = if stretch.clamped.0 { -CLAMPED } else { HALF_OVER };
            let (skip, most) = (u32::from(stretch.clamped.0), stretch.arcs + u32::from(!stretch.clamped.1));
            for arc in skip..most {
                let share = stretch.from + (first + f64::from(arc)) * scale;
                while pairs.next_if(|(_, after)| after.share < share).is_some() {}
                let Some((before, after)) = pairs.peek() else { break };
                let part =
                    ((share - before.share) / (after.share - before.share).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
                let heading = before.best_heading + part * (after.best_heading - before.best_heading);
                places.push(JointPlace {
                    parameter: before.parameter + part * (after.parameter - before.parameter),
                    offset: 0.0,
                    slope: (heading * scale * scale).clamp(-STEEPEST, STEEPEST),
                });
            }
        }
        places.extend(nodes.last().map(JointPlace::on_curve));
        within_half_circles(places, nodes)
    }
}

/// Inserts further joints where the curve turns by almost half a circle from one to the next: a sharp tip of constant curvature
/// has almost no share.
fn within_half_circles(places: Vec<JointPlace>, nodes: &[CurveSample]) -> Vec<JointPlace> {
    let node_at = |place: &JointPlace| nodes.get(nodes.partition_point(|node| node.parameter < place.parameter));
    let mut result: Vec<JointPlace> = Vec::with_capacity(places.len());
    for place in places {
        if let (Some(from), Some(to)) = (result.last().and_then(node_at), node_at(&place))
            && from.tangent.dot(&to.tangent) < SHARPEST
        {
            for part in [0.25, 0.5, 0.75] {
                let parameter = from.parameter + part * (to.parameter - from.parameter);
                result.push(JointPlace { parameter, offset: 0.0, slope: 0.0 });
            }
        }
        result.push(place);
    }
    result
}

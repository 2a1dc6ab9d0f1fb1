//! Sampling a piece and laying chains of arcs on it, see the story in the module above.

use super::{FitError, Joint, SAME_HEADING};
use crate::cam::Frame;
use crate::numeric::extremum;
use nalgebra::Vector2;

/// Nodes per best possible arc: joints lie on nodes, and an arc that must stop at a node is shorter by half their
/// distance on the average.
const NODES_PER_ARC: f64 = 96.0;
/// Every how many nodes an arc is compared with the curve, and its ends are tried: 24 an arc see the lobes to 0.8 %.
const STRIDE: usize = 4;
/// Nodes a piece has at the least, so that a short piece or a nearly circular one is seen at all.
const LEAST_NODES: f64 = 192.0;
/// Cells in which I₃ is summed up; the integrand has cusps where κ' changes sign, seen to 1e-4 of I₃ with 512.
const SHARE_CELLS: u32 = 512;
/// Share of the nodes that is spread evenly over the piece, so that stretches of constant curvature are not empty.
const EVEN_SHARE: f64 = 0.05;
/// Furthest end of an arc that is looked at, in best possible arcs: an arc can be longer only where κ' changes sign.
const FURTHEST: f64 = 3.0;
/// Ends in a row that break the tolerance before no later one is looked at: half an arc.
const MOST_MISSES: u32 = 12;
/// A chain is tried to be closed when the gap is no longer than this, in best possible arcs.
const WIDEST_GAP: f64 = 2.6;
/// Charge for a heading off by the size of η*, in best possible arcs. Less forgets the alternation, more goes short.
const CHARGE: f64 = 0.35;
/// Chains laid side by side, those that may fall behind, and how many of these to an arc.
const BEAM: usize = 8;
const BEHIND: usize = 10;
const BINS_PER_ARC: f64 = 10.0;
/// Largest number of nodes: a curve whose κ' does not belong to it asks for millions of arcs.
const MOST_NODES: f64 = 4e6;
/// Cells in which the freedom of a biarc is searched, before golden sections.
const BIARC_CELLS: u32 = 8;
/// Golden sections after that: the deviation is flat about its least value.
const BIARC_SECTIONS: u32 = 8;
/// Shorter tangent length of a biarc over the longer one at the least: an arc of no length has no tangent.
const BIARC_LEAST: f64 = 0.1;
/// First tangent length of a biarc over half the chord, least and largest: beyond, one of its arcs is degenerate.
const BIARC_RANGE: (f64, f64) = (0.1, 1.9);
/// K of the best tangent-continuous chain.
const CHAIN: f64 = 124.707_658_144_958_9;

/// A place where the curve was sampled.
#[derive(Debug, Clone, Copy)]
struct Node {
    point: Vector2<f64>,
    tangent: Vector2<f64>,
    parameter: f64,
    /// I₃ up to here over (K tol)^(1/3): position in best possible arcs.
    share: f64,
    /// The heading of the best chain against the tangent, rad.
    best_heading: f64,
}

/// An arc that leaves a point with a heading.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc {
    pub(super) start: Vector2<f64>,
    pub(super) heading: Vector2<f64>,
    pub(super) curvature: f64,
    pub(super) bulge: f64,
}

impl Arc {
    /// The arc to a point and the heading there, the reflection at the chord; `None` past a half circle.
    pub(super) fn to(start: Vector2<f64>, heading: Vector2<f64>, end: Vector2<f64>) -> Option<(Self, Vector2<f64>)> {
        let chord = end - start;
        let length = chord.norm();
        let direction = chord / length;
        let (sine, cosine) = (heading.perp(&direction), heading.dot(&direction));
        // Written so that a NaN is refused too.
        if !(cosine > -SAME_HEADING) {
            return None;
        }
        let arc = Self { start, heading, curvature: 2.0 * sine / length, bulge: sine / (1.0 + cosine) };
        Some((arc, direction * (2.0 * cosine) - heading))
    }

    /// Signed distance of a point from the circle of the arc, for points near it.
    ///
    /// With a, b the coordinates along and across the heading it is g/(1 + √(1 − κ g)), g = 2 b − κ (a² + b²): no
    /// cancellation of large radii, and a straight line is no special case.
    pub(super) fn distance(&self, point: Vector2<f64>) -> f64 {
        let d = point - self.start;
        let g = 2.0 * self.heading.perp(&d) - self.curvature * d.norm_squared();
        g / (1.0 + (1.0 - self.curvature * g).max(0.0).sqrt())
    }
}

/// A chain under way: its last joint and the arc that led there.
#[derive(Debug, Clone, Copy)]
struct Laid {
    node: usize,
    heading: Vector2<f64>,
    score: f64,
    /// The chain before the last arc, as an index, and the arc; none at the start.
    last: Option<(usize, Arc)>,
}

/// Two arcs that close a gap.
#[derive(Debug, Clone, Copy)]
struct Biarc {
    arcs: [Arc; 2],
    deviation: f64,
}

/// The sampled piece.
pub(super) struct Nodes(Vec<Node>);

impl Nodes {
    /// Every arc that can follow a chain, not past node `furthest`.
    fn followers(&self, chains: &[Laid], index: usize, furthest: usize, tolerance: f64, next: &mut Vec<Laid>) {
        let Some(chain) = chains.get(index) else { return };
        let Some(start) = self.0.get(chain.node) else { return };
        let holds = |end: usize, node: &Node| {
            let (arc, heading) = Arc::to(start.point, chain.heading, node.point)?;
            let inside = self.0.get(chain.node + 1..end).unwrap_or_default();
            let keeps = inside.iter().step_by(STRIDE).all(|n| arc.distance(n.point).abs() <= tolerance);
            keeps.then_some((arc, heading))
        };
        let mut add = |end: usize, node: &Node, (arc, heading): (Arc, Vector2<f64>)| {
            let off = node.tangent.perp(&heading) - node.best_heading;
            // Where κ' vanishes so does η*; the size at the start keeps the charge finite there.
            let size = node.best_heading.abs().max(start.best_heading.abs()).max(SAME_HEADING);
            let score = node.share - CHARGE * off.abs() / size;
            next.push(Laid { node: end, heading, score, last: Some((index, arc)) });
        };
        let mut misses = 0;
        let mut kept = false;
        let ends = self.0.iter().enumerate().take(furthest + 1).skip(chain.node + STRIDE).step_by(STRIDE);
        for (end, node) in ends {
            if node.share - start.share > FURTHEST {
                break;
            }
            if let Some(arc) = holds(end, node) {
                add(end, node, arc);
                (misses, kept) = (0, true);
                continue;
            }
            if kept {
                // The longest arc ends between this node and the one before it.
                let between = (end + 1 - STRIDE..end).rev();
                let longest = between
                    .filter_map(|at| Some((at, self.0.get(at)?)))
                    .find_map(|(at, n)| Some((at, n, holds(at, n)?)));
                if let Some((at, n, arc)) = longest {
                    add(at, n, arc);
                }
            }
            kept = false;
            misses += 1;
            if misses > MOST_MISSES {
                break;
            }
        }
    }

    /// The biarc that closes the gap with the least deviation.
    fn bridge(&self, from: usize, heading: Vector2<f64>, to: usize, end_heading: Vector2<f64>) -> Option<Biarc> {
        let (start, end) = (self.0.get(from)?, self.0.get(to)?);
        let inside = self.0.get(from + 1..to)?;
        let with = |share: f64| {
            let arcs = biarc(start.point, heading, end.point, end_heading, share)?;
            let [first, second] = arcs;
            let distance = |node: &Node| {
                let behind = (node.point - second.start).dot(&second.heading) < 0.0;
                if behind { first } else { second }.distance(node.point).abs()
            };
            Some(Biarc { arcs, deviation: inside.iter().step_by(STRIDE).map(distance).fold(0.0, f64::max) })
        };
        let less = |share: f64| with(share).map_or(f64::NEG_INFINITY, |biarc| -biarc.deviation);
        with(extremum::largest_without_slope(less, BIARC_RANGE, BIARC_CELLS, BIARC_SECTIONS).at)
    }
}

/// The biarc between two points with headings whose first tangent length is `share` of half the chord.
///
/// The corners V₁ = P₀ + d₁ h₀ and V₂ = P₁ − d₂ h₁ of its tangent polygon are d₁ + d₂ apart, which gives d₂ for d₁.
fn biarc(p0: Vector2<f64>, h0: Vector2<f64>, p1: Vector2<f64>, h1: Vector2<f64>, share: f64) -> Option<[Arc; 2]> {
    let v = p1 - p0;
    let d1 = 0.5 * share * v.norm();
    let d2 = (0.5 * v.norm_squared() - d1 * v.dot(&h0)) / (v.dot(&h1) + d1 * (1.0 - h0.dot(&h1)));
    if !(d2 > BIARC_LEAST * d1 && d1 > BIARC_LEAST * d2) {
        return None;
    }
    let joint = ((p0 + h0 * d1) * d2 + (p1 - h1 * d2) * d1) / (d1 + d2);
    let (first, heading) = Arc::to(p0, h0, joint)?;
    let (second, _) = Arc::to(joint, heading, p1)?;
    Some([first, second])
}

/// Samples the curve at nodes of equal share, and returns N* for the whole tolerance.
pub(super) fn sample(
    curve: &impl Fn(f64) -> Frame,
    range: (f64, f64),
    tolerance: f64,
    seen: f64,
) -> Result<(Nodes, f64), FitError> {
    let step = (range.1 - range.0) / f64::from(SHARE_CELLS);
    let mut shares = vec![0.0];
    let mut total = 0.0;
    for cell in 0..SHARE_CELLS {
        let parameter = range.0 + step * (f64::from(cell) + 0.5);
        let frame = curve(parameter);
        let share = libm::cbrt(frame.curvature_slope.abs()) * frame.speed * step;
        // Written so that a NaN is refused too.
        if !(frame.speed > 0.0 && share.is_finite()) {
            return Err(FitError::NotSmooth { parameter });
        }
        total += share;
        shares.push(total);
    }
    let best_possible = total / libm::cbrt(CHAIN * tolerance);
    let scale = 1.0 / libm::cbrt(CHAIN * seen);
    let count = (NODES_PER_ARC * total * scale).ceil() + LEAST_NODES;
    if count > MOST_NODES {
        return Err(FitError::ToleranceTooFine { tolerance });
    }
    // Position over the piece in [0, 1]: mostly by share, a little by parameter.
    let even = if total > 0.0 { EVEN_SHARE } else { 1.0 };
    let position = |cell: usize| {
        let by_share = shares.get(cell).copied().unwrap_or(total) / total.max(f64::MIN_POSITIVE);
        #[expect(clippy::cast_precision_loss, reason = "a few hundred cells")]
        let by_parameter = cell as f64 / f64::from(SHARE_CELLS);
        (1.0 - even) * by_share + even * by_parameter
    };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked against MOST_NODES")]
    let count = count as usize;
    let mut nodes = Vec::with_capacity(count + 1);
    let mut cell = 0;
    for index in 0..=count {
        #[expect(clippy::cast_precision_loss, reason = "checked against MOST_NODES")]
        let wanted = index as f64 / count as f64;
        while cell + 2 < shares.len() && position(cell + 1) < wanted {
            cell += 1;
        }
        let within = ((wanted - position(cell)) / (position(cell + 1) - position(cell))).clamp(0.0, 1.0);
        #[expect(clippy::cast_precision_loss, reason = "a few hundred cells")]
        let inner = range.0 + step * (cell as f64 + within);
        let parameter = if index == count { range.1 } else { inner };
        let frame = curve(parameter);
        let (low, high) = (shares.get(cell).copied().unwrap_or(0.0), shares.get(cell + 1).copied().unwrap_or(total));
        let size = libm::cbrt(CHAIN * seen);
        nodes.push(Node {
            point: frame.point,
            tangent: frame.tangent,
            parameter,
            share: (low + within * (high - low)) * scale,
            best_heading: -libm::cbrt(frame.curvature_slope) * size * size / 12.0,
        });
    }
    Ok((Nodes(nodes), best_possible))
}

/// Lays chains until one can be closed at the end of the piece.
pub(super) fn lay(nodes: &Nodes, tolerance: f64) -> Option<Vec<Joint>> {
    let last = nodes.0.len() - 1;
    let (first, end) = (nodes.0.first()?, nodes.0.last()?);
    let mut chains = vec![Laid { node: 0, heading: first.tangent, score: 0.0, last: None }];
    let mut layer = 0..1;
    while !layer.is_empty() {
        let closed = layer.clone().filter_map(|index| {
            let chain = chains.get(index)?;
            let near = end.share - nodes.0.get(chain.node)?.share <= WIDEST_GAP;
            let biarc = near.then(|| nodes.bridge(chain.node, chain.heading, last, end.tangent))??;
            (biarc.deviation <= tolerance).then_some((index, biarc))
        });
        if let Some((index, biarc)) = closed.min_by(|a, b| a.1.deviation.total_cmp(&b.1.deviation)) {
            return nodes.joints(&chains, index, &biarc);
        }
        let mut next = Vec::new();
        for index in layer.clone() {
            // A stretch is left free for the joint of the biarc.
            nodes.followers(&chains, index, last.saturating_sub(3 * STRIDE), tolerance, &mut next);
        }
        // Of the chains that end at one node the one with the best heading goes on; then the best of all.
        next.sort_by(|a, b| b.node.cmp(&a.node).then(b.score.total_cmp(&a.score)));
        next.dedup_by_key(|chain| chain.node);
        next.sort_by(|a, b| b.score.total_cmp(&a.score));
        nodes.keep(&mut next);
        layer = chains.len()..chains.len() + next.len();
        chains.extend(next);
    }
    None
}

impl Nodes {
    /// Keeps the best chains, and of those that fall behind the best in every tenth of an arc: where the curvature has an
    /// extremum an arc of three lobes reaches half an arc further, but only from the right place before it.
    fn keep(&self, chains: &mut Vec<Laid>) {
        let share = |chain: &Laid| self.0.get(chain.node).map_or(0.0, |node| node.share);
        let furthest = chains.first().map_or(0.0, &share);
        let mut kept = Vec::with_capacity(BEAM + BEHIND);
        let mut bins = [false; BEHIND];
        for (rank, chain) in chains.iter().enumerate() {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a small whole number or nothing"
            )]
            let bin = ((furthest - share(chain)).max(0.0) * BINS_PER_ARC) as usize;
            match bins.get_mut(bin) {
                _ if rank < BEAM => kept.push(*chain),
                Some(taken) if !*taken => {
                    *taken = true;
                    kept.push(*chain);
                }
                _ => {}
            }
        }
        *chains = kept;
    }

    /// A chain and the biarc that closes it as joints; the parameter of the biarc's own joint is the nearest node's.
    fn joints(&self, chains: &[Laid], index: usize, biarc: &Biarc) -> Option<Vec<Joint>> {
        let at =
            |node: usize, bulge: f64| self.0.get(node).map(|n| Joint { point: n.point, parameter: n.parameter, bulge });
        let [first, second] = &biarc.arcs;
        let from = chains.get(index)?.node;
        let away = |node: &&Node| (node.point - second.start).norm_squared();
        let nearest = self.0.get(from..)?.iter().min_by(|a, b| away(a).total_cmp(&away(b)))?;
        let mut joints = vec![
            Joint { point: second.start, parameter: nearest.parameter, bulge: second.bulge },
            at(from, first.bulge)?,
        ];
        let mut chain = chains.get(index)?;
        while let Some((before, arc)) = chain.last {
            chain = chains.get(before)?;
            joints.push(at(chain.node, arc.bulge)?);
        }
        joints.reverse();
        Some(joints)
    }
}

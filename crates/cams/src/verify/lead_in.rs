//! The path of the tool to the start of an outline touches the cam only there.

use super::check::{Evidence, FileCheck, place};
use crate::body::Layer;
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::reading::Chain;
use crate::report::{Bound, Finding, Verdict};
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::geometry::lead_in;
use camgen_kernel::text::Text;
use nalgebra::Vector2;

pub(super) const CHECK: FileCheck = FileCheck {
    check: Check {
        name: "lead_in",
        on: CheckScope::ToolFile,
        unit: "mm",
        about: "How deep a lead-in on layer LEAD_IN cuts into the cam, or how far both of its ends are from the outline. It warns where a \
                lead-in meets the outline at an angle, which leaves a mark.",
        explained: CheckExplanation {
            bound: Bound::AtMost,
            formula: "max over the lead-in of its depth in the metal; the distance of its nearer end from the outline",
            usual: "the tolerance",
            change: "give a smaller --lead-in or another --start, or delete the lead-in from the file",
        },
    },
    run: check,
};

/// Depths are found to within this share of the tolerance.
const FINE_SHARE: f64 = 0.1;
/// Largest angle between a lead-in and the outline at which no mark is expected, rad.
const TANGENT: f64 = 0.5 / 180.0 * std::f64::consts::PI;

/// Whether a chain is a lead-in by its layer.
pub(crate) fn is_lead_in(chain: &Chain) -> bool {
    let layer = Layer::LeadIn.name();
    !chain.sources.is_empty() && chain.sources.iter().all(|source| source.on_layer(layer))
}

/// A lead-in before its outline.
struct Judged {
    /// mm.
    value: f64,
    fault: Option<String>,
    /// Angle at which it meets the outline, rad.
    angle: f64,
    at: Vector2<f64>,
}

fn judge(tree: &EdgeTree, chain: &Chain, tolerance: f64) -> Option<Judged> {
    let (first, last) = (chain.edges.first()?, chain.edges.last()?);
    let ends = [(first.start(), first.start_tangent()), (last.end(), last.end_tangent())];
    let meets = ends.map(|(end, along)| {
        let nearest = tree.nearest(end)?;
        Some((nearest.left.abs(), end, nearest.tangent.perp(&along).abs().min(1.0).asin()))
    });
    let (away, at, angle) = meets.into_iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0))?;
    let depth = chain.edges.iter().map(|edge| lead_in::depth(tree, edge, FINE_SHARE * tolerance)).fold(0.0, f64::max);
    let fault = if chain.closed {
        Some("a lead-in is closed: it would be cut as a contour".to_owned())
    } else if away > tolerance {
        Some("a lead-in does not reach the outline".to_owned())
    } else {
        (depth > tolerance).then(|| "a lead-in cuts into the cam".to_owned())
    };
    let value = if chain.closed { f64::INFINITY } else { away.max(depth) };
    Some(Judged { value, fault, angle, at })
}

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let of_outlines = evidence.outlines.iter().flat_map(|outline| {
        outline.others.iter().filter(|chain| is_lead_in(chain)).map(|chain| (&outline.contour, chain))
    });
    let of_path = evidence.cutter_paths.iter().flat_map(|path| {
        path.contour.iter().flat_map(|contour| path.lead_ins.iter().map(move |chain| (contour, chain)))
    });
    let limit = evidence.tolerance_mm;
    let judged = |(contour, chain): (&Contour, &Chain)| judge(&EdgeTree::new(contour), chain, limit);
    let all: Vec<Judged> = of_outlines.chain(of_path).filter_map(judged).collect();
    let worse = |a: &&Judged, b: &&Judged| {
        a.fault.is_some().cmp(&b.fault.is_some()).then(a.value.total_cmp(&b.value)).then(a.angle.total_cmp(&b.angle))
    };
    let worst = all.iter().max_by(worse)?;
    let slanted = all.iter().map(|judged| judged.angle).fold(0.0, f64::max);
    let (verdict, note) = match (&worst.fault, slanted > TANGENT) {
        (Some(fault), _) => (Verdict::Fail, Some(fault.clone())),
        (None, true) => {
            let note = format!("it meets the outline at {:.1}°, which leaves a mark", slanted.to_degrees());
            (Verdict::Warn, Some(note))
        }
        (None, false) => (Verdict::Pass, None),
    };
    Some(Finding {
        note: note.map(Text::from),
        place: place(evidence.body, worst.at),
        ..CHECK.found(worst.value, Some(limit), verdict)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use camgen_kernel::geometry::contour::{Edge, Segment};

    fn chain(points: &[(f64, f64)]) -> Chain {
        let points: Vec<Vector2<f64>> = points.iter().map(|(x, y)| Vector2::new(*x, *y)).collect();
        let edge = |pair: &[Vector2<f64>]| Edge::Segment(Segment { start: pair[0], end: pair[1], bulge: 0.0 });
        let edges = points.windows(2).map(edge).collect();
        Chain { edges, closed: points.first() == points.last(), sources: Vec::new() }
    }

    #[test]
    fn a_lead_in_ends_on_the_outline_and_stays_outside() {
        let tree = EdgeTree::new(&Contour::circle(Vector2::zeros(), 20.0));
        let of = |points: &[(f64, f64)]| judge(&tree, &chain(points), 0.005).expect("a chain");
        let right = of(&[(20.0, -8.0), (20.0, 0.0)]);
        assert!(right.fault.is_none() && right.value < 1e-9 && right.angle < 1e-9);
        // In either direction.
        assert!(of(&[(20.0, 0.0), (20.0, -8.0)]).fault.is_none());
        let short = of(&[(20.0, -8.0), (20.02, -0.01)]);
        assert!(short.fault.is_some_and(|fault| fault.contains("reach")) && (short.value - 0.020).abs() < 1e-4);
        let across = of(&[(-30.0, 0.0), (20.0, 0.0)]);
        assert!(across.fault.is_some_and(|fault| fault.contains("into the cam")) && (across.value - 20.0).abs() < 0.01);
        let square = of(&[(28.0, 0.0), (20.0, 0.0)]);
        assert!(square.fault.is_none() && (square.angle.to_degrees() - 90.0).abs() < 1e-6);
        assert!(
            of(&[(20.0, 0.0), (28.0, 0.0), (28.0, 8.0), (20.0, 0.0)])
                .fault
                .is_some_and(|fault| fault.contains("closed"))
        );
    }
}

//! Curves within the window of a panel: what is above or below it is left out, and lines end at its edge.

use super::{DiagramPanel, DiagramRun};

/// Two places of the axis nearer than this share of it are one.
const ONE_PLACE: f64 = 1e-7;

/// The values that a panel shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ValueWindow {
    /// Least value.
    pub(super) low: f64,
    /// Largest value.
    pub(super) high: f64,
    /// Values beyond it exist.
    pub(super) clipped: bool,
}

/// Share of the values that are no spikes, and how many times their size the largest may have before it is clipped.
const ORDINARY: f64 = 0.98;
const SPIKE: f64 = 25.0;
/// A clipped panel shows this many times the size of the ordinary values.
const SHOWN: f64 = 6.0;
/// A radius is shown up to so many times the smallest, and so many times the one in the middle of all.
const OVER_SMALLEST: f64 = 5.0;
const OVER_MIDDLE: f64 = 2.5;
/// A concave radius over what would be shown without it, up to which it is, and up to how many times it then is shown.
const NEARLY_STRAIGHT: f64 = 1.5;
const OVER_CONCAVE: f64 = 1.25;

impl ValueWindow {
    /// The window of a panel, with the limits that are to be seen in it.
    pub(super) fn of(panel: &DiagramPanel, limits: &[f64]) -> Self {
        let values = || panel.law.iter().chain(&panel.cut).flatten().map(|[_, value]| *value);
        let mut sizes: Vec<f64> = values().map(f64::abs).filter(|size| *size > 0.0 || !panel.radius).collect();
        sizes.sort_by(f64::total_cmp);
        let (low, high) = values()
            .chain(limits.iter().copied())
            .filter(|value| value.is_finite())
            .fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
        let concave = values().filter(|value| *value < 0.0).fold(f64::NEG_INFINITY, f64::max);
        let (least, most) = if panel.radius {
            radii_shown(&sizes, concave)
        } else {
            let most = size_shown(&sizes);
            (-most, most)
        };
        let clipped = values().any(|value| value < least || value > most);
        let (low, high) = if clipped { (low.max(least), high.min(most)) } else { (low, high) };
        let (low, high) = if high > low { (low, high) } else { (low - 1.0, high + 1.0) };
        Self { low, high, clipped }
    }

    /// Whether it shows a value.
    pub(super) fn holds(&self, value: f64) -> bool {
        value >= self.low && value <= self.high
    }
}

/// The size among sorted ones that a share of them do not exceed.
fn share_of(sizes: &[f64], share: f64) -> f64 {
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "an index"
    )]
    let index = (share * sizes.len() as f64) as usize;
    sizes.get(index.min(sizes.len().saturating_sub(1))).copied().unwrap_or(0.0)
}

/// Largest size of a value that is shown, from all sizes, sorted.
fn size_shown(sizes: &[f64]) -> f64 {
    let finite: Vec<f64> = sizes.iter().copied().filter(|size| size.is_finite()).collect();
    let (ordinary, largest) = (share_of(&finite, ORDINARY), finite.last().copied().unwrap_or(0.0));
    if ordinary > 0.0 && largest > SPIKE * ordinary { SHOWN * ordinary } else { largest }
}

/// Least, negative, and largest radius that are shown, from all sizes, sorted, and the sharpest concave one, which is negative.
fn radii_shown(sizes: &[f64], concave: f64) -> (f64, f64) {
    let smallest = sizes.first().copied().filter(|size| size.is_finite()).unwrap_or(1.0);
    let middle = Some(share_of(sizes, 0.5)).filter(|middle| middle.is_finite()).unwrap_or(smallest);
    let usual = (OVER_SMALLEST * smallest).max(OVER_MIDDLE * middle);
    let largest = sizes.iter().rev().find(|size| size.is_finite()).copied().unwrap_or(usual);
    let most = if largest <= 1.3 * usual { largest } else { usual };
    // Concave places that are all nearly straight need no room.
    let least = if -concave > NEARLY_STRAIGHT * most { 0.0 } else { (-most).min(OVER_CONCAVE * concave) };
    (if concave.is_finite() { least } else { -most }, most)
}

/// The runs of a curve joined to lines within a window. Where two runs meet at a place the line goes on: a step is a step.
pub(super) fn lines(runs: &[DiagramRun], window: &ValueWindow, radius: bool, length: f64) -> Vec<DiagramRun> {
    let mut lines: Vec<DiagramRun> = Vec::new();
    let mut line: DiagramRun = Vec::new();
    let mut last: Option<[f64; 2]> = None;
    for (index, point) in runs.iter().flat_map(|run| run.iter().enumerate()) {
        let before = last.replace(*point);
        // The first point of a run follows the last of the run before where both are at one place.
        let before = before.filter(|before| index > 0 || (point[0] - before[0]).abs() <= ONE_PLACE * length);
        let Some([from, to]) = before.and_then(|before| shown_part(before, *point, window, radius)) else {
            lines.push(std::mem::take(&mut line));
            continue;
        };
        if line.last() != Some(&from) {
            lines.push(std::mem::take(&mut line));
            line.push(from);
        }
        line.push(to);
    }
    lines.push(line);
    lines.retain(|line| line.len() > 1);
    lines
}

/// The part of the line between two points that a window shows; `None` where it shows nothing of it.
fn shown_part(from: [f64; 2], to: [f64; 2], window: &ValueWindow, radius: bool) -> Option<[[f64; 2]; 2]> {
    let ([_, a], [_, b]) = (from, to);
    if a.is_nan() || b.is_nan() {
        return None;
    }
    if window.holds(a) && window.holds(b) {
        // From a large convex to a large concave radius the curve goes through a straight line, not through a point.
        let through_infinity = radius && a * b < 0.0 && (a - b).abs() > window.high.max(-window.low);
        return (!through_infinity).then_some([from, to]);
    }
    let at = |edge: f64| {
        let share = if radius { (1.0 / edge - 1.0 / a) / (1.0 / b - 1.0 / a) } else { (edge - a) / (b - a) };
        let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { f64::from(u8::from(!a.is_finite())) };
        [from[0] + share * (to[0] - from[0]), edge]
    };
    let outside = |inner: f64, outer: f64| {
        let same_side = !radius || inner * outer > 0.0 || outer.is_infinite();
        let edge = if outer > window.high { window.high } else { window.low };
        // Beyond a straight line the other sign: the curve leaves at the edge of its own.
        let own = if inner > 0.0 { window.high } else { window.low };
        if same_side && !outer.is_infinite() { edge } else { own }
    };
    match (window.holds(a), window.holds(b)) {
        (true, false) => Some([from, at(outside(a, b))]),
        (false, true) => Some([at(outside(b, a)), to]),
        _ if !radius && a.min(b) < window.low && a.max(b) > window.high => {
            let [low, high] = [at(window.low), at(window.high)];
            Some(if a < b { [low, high] } else { [high, low] })
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WINDOW: ValueWindow = ValueWindow { low: -10.0, high: 10.0, clipped: true };

    #[test]
    fn a_step_is_a_step_and_a_gap_a_gap() {
        let runs = [vec![[0.0, 1.0], [1.0, 1.0]], vec![[1.0, -3.0], [2.0, -3.0]], vec![[2.5, 0.0], [3.0, 0.0]]];
        let drawn = lines(&runs, &WINDOW, false, 3.0);
        assert_eq!(drawn, [vec![[0.0, 1.0], [1.0, 1.0], [1.0, -3.0], [2.0, -3.0]], vec![[2.5, 0.0], [3.0, 0.0]]]);
    }

    #[test]
    fn lines_end_at_the_edge_of_the_window() {
        let drawn = lines(&[vec![[0.0, 0.0], [1.0, 20.0], [2.0, 20.0], [3.0, -20.0]]], &WINDOW, false, 3.0);
        assert_eq!(drawn, [vec![[0.0, 0.0], [0.5, 10.0]], vec![[2.25, 10.0], [2.75, -10.0]]]);
        let endless = lines(&[vec![[0.0, 5.0], [1.0, f64::INFINITY]]], &WINDOW, false, 1.0);
        assert_eq!(endless, [vec![[0.0, 5.0], [0.0, 10.0]]]);
    }

    /// 1/ρ falls evenly from 0.2 to −0.2: ρ passes 10 and −10 a quarter of the way from the middle.
    #[test]
    fn a_radius_goes_through_infinity() {
        let drawn = lines(&[vec![[0.0, 5.0], [2.0, f64::INFINITY], [4.0, -5.0]]], &WINDOW, true, 4.0);
        assert_eq!(drawn, [vec![[0.0, 5.0], [1.0, 10.0]], vec![[3.0, -10.0], [4.0, -5.0]]]);
        assert!(lines(&[vec![[0.0, 9.0], [1.0, -9.0]]], &WINDOW, true, 1.0).is_empty());
    }
}

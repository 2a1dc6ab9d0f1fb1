//! The curve through the rows of a turn, or near them, as a program.

use super::nodes::{Nodes, RowRun};
use super::turn::Turn;
use super::{RowFigures, RowOutlier, RowShape, RowWishes, Rows};
use crate::motion::laws::{LawCurve, spline};
use crate::motion::program::context::ProgramContext;
use crate::motion::program::{EndState, Program, ProgramSegment, Span, keys};
use crate::numeric::extremum;

/// Cells in which the extremes of a cubic are separated.
const CELLS: u32 = 8;

/// The program of the rows of a turn, with its figures.
pub(super) fn program(
    turn: &Turn,
    start: f64,
    lobes: u32,
    whole: ProgramContext,
    rows: &Rows,
    wishes: RowWishes,
) -> Program {
    let first = turn.values.first().copied().unwrap_or(0.0);
    let values: Vec<f64> = turn.values.iter().map(|value| value - first).collect();
    let run = RowRun {
        knots: &turn.knots,
        values: &values,
        dwells: turn.dwells.clone(),
        ends: None,
        spacing: turn.spacing / whole.fill,
        rounding: rows.rounding,
    };
    let smooth = wishes.smooth.unwrap_or(0.0);
    // Rests contradict nothing.
    let found = run.nodes(wishes.shape, smooth).or_else(|_| run.nodes(RowShape::Natural, smooth));
    let Ok(found) = found else { return Program::empty(whole.quantity, lobes) };
    let (dwells, base) = (found.dwells.clone(), start + first);
    let program = if dwells.contains(&true) {
        of_runs(turn, &found, wishes.cubic, base, lobes, whole, rows.name())
    } else {
        let curve = if wishes.cubic {
            spline::cubic(&turn.knots, &values)
        } else {
            // A curve begins at 0.
            let own = found.values.first().copied().unwrap_or(0.0);
            let nodes: Vec<[f64; 3]> = found.jets().into_iter().map(|[value, v, a]| [value - own, v, a]).collect();
            spline::chain(&turn.knots, &nodes)
        };
        let base = base + if wishes.cubic { 0.0 } else { found.values.first().copied().unwrap_or(0.0) };
        Program::of_curve(whole.quantity, Span::Turn { at: turn.at, lobes }, base, rows.name(), curve)
    };
    let figures = run.figures(&found, wishes, &rows.told).placed(turn.at, whole.fill, 1.0);
    let cubic_overshoot = wishes.cubic.then(|| overshoot_of(&program, turn, base, whole));
    let overshoot = cubic_overshoot.unwrap_or(figures.overshoot);
    // Rows of a turn begin at the first row after its start.
    let outlier = figures.outlier.map(|outlier| {
        let row = outlier.row.checked_sub(1).and_then(|index| rows.points.get(index));
        RowOutlier { row: row.map_or(outlier.row, |row| row.row + 1), line: row.and_then(|row| row.line), ..outlier }
    });
    Program { rows: vec![RowFigures { overshoot, outlier, ..figures }], ..program }
}

/// The curve through the rows of a run from one to another, over shares of its angle, from 0 on.
fn run_curve(turn: &Turn, found: &Nodes, cubic: bool, first: usize, end: usize) -> LawCurve {
    let (from, (own, _)) = (turn.knot(first), found.node(first));
    let width = turn.knot(end) - from;
    let knots: Vec<f64> =
        (first..=end).map(|at| if at == end { 1.0 } else { (turn.knot(at) - from) / width }).collect();
    if cubic {
        let values: Vec<f64> = (first..=end).map(|at| found.node(at).0 - own).collect();
        return spline::cubic_at_rest(&knots, &values);
    }
    let nodes = (first..=end).map(|at| {
        let (value, [v, a]) = found.node(at);
        [value - own, v * width, a * width * width]
    });
    spline::chain(&knots, &nodes.collect::<Vec<_>>())
}

/// Segments of rows that rest and of rows that move.
fn of_runs(
    turn: &Turn,
    found: &Nodes,
    cubic: bool,
    base: f64,
    lobes: u32,
    whole: ProgramContext,
    name: &'static str,
) -> Program {
    let mut program = Program::empty(whole.quantity, lobes.max(1));
    let fill = whole.fill;
    let mut at = 0;
    while let Some(dwell) = found.dwells.get(at).copied() {
        let end = (at..found.dwells.len()).find(|next| found.dwells.get(*next) != Some(&dwell));
        let end = end.unwrap_or(found.dwells.len());
        let (from, width) = (turn.knot(at), turn.knot(end) - turn.knot(at));
        let own = found.node(at).0;
        let curve = (!dwell).then(|| run_curve(turn, found, cubic, at, end));
        let ends = [at, end].map(|index| {
            let (_, [v, a]) = found.node(index);
            if cubic {
                EndState::default()
            } else {
                EndState { velocity: v / fill, acceleration: a / fill / fill, ..EndState::default() }
            }
        });
        let name = if dwell { keys::DWELL } else { name };
        let to = base + if dwell { own } else { found.node(end).0 };
        let segment = ProgramSegment {
            curve,
            name,
            start: turn.at + fill * from,
            width: fill * width,
            from: base + own,
            travel: 1.0,
            to,
            ends,
            whole: !dwell,
            optimum: None,
        };
        program.add(segment, turn.at + fill * turn.knot(end));
        at = end;
    }
    program.repeat(fill);
    program.with_lowest()
}

/// How far a program leaves the rows, by its own curve.
fn overshoot_of(program: &Program, turn: &Turn, base: f64, whole: ProgramContext) -> (f64, f64) {
    use crate::motion::Motion;
    let first = turn.values.first().copied().unwrap_or(0.0);
    let pairs =
        turn.knots.iter().zip(turn.knots.iter().skip(1)).zip(turn.values.iter().zip(turn.values.iter().skip(1)));
    let lowest = program.origin().unwrap_or(0.0);
    let all = pairs.map(|((from, to), (a, b))| {
        let range = (turn.at + whole.fill * from, turn.at + whole.fill * to);
        let middle = 0.5 * (range.0 + range.1);
        let piece = program.pieces().iter().position(|piece| piece.start <= middle && middle <= piece.end).unwrap_or(0);
        let [top, bottom] = extremum::largest_of_both_signs(
            |angle| {
                let jet = program.jet(piece, angle);
                [jet.s + lowest - base + first, jet.ds, jet.dds]
            },
            range,
            CELLS,
        );
        let (above, below) = (top.value - a.max(*b), a.min(*b) + bottom.value);
        if above >= below { (above.max(0.0), top.at) } else { (below.max(0.0), bottom.at) }
    });
    all.fold((0.0, turn.at), |worst, found| if found.0 > worst.0 { found } else { worst })
}

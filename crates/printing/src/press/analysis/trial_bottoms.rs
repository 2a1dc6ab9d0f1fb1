//! The graphical solution of equation (18), figure 9: its right side over trial positions of the bottom, and its left side, which does not depend on them.
//!
//! At each station of the bed the bottom at the station before is known, and the slope of a trial is the difference of both over the step of the bed.

use crate::press::MachineOfPress;
use crate::press::machine::{PressCams, exact_on};
use crate::press::motion::equation_18::{BedDirection, ExactOn, Solver};
use crate::press::wedge::{LAW_TOLERANCE, Wedge};
use camgen_cams::machine::Machine;
use camgen_cams::report::plot::{CurveStroke, PlotCurve, PlotPanel, figure};
use camgen_cams::table::ListedColumn;
use camgen_kernel::geometry::MILLIMETRES;

/// Places of the bed, in quarters of its stroke.
const QUARTERS: u32 = 4;
/// Step of the bed before each, as a share of the stroke: 180 stations.
const STEP: f64 = 1.0 / 180.0;
/// Trials about the solution on either side, and how far the last one is from it, as a share of the stroke.
const TRIALS: i32 = 20;
const REACH: f64 = 0.01;

/// A trial.
pub(super) struct TrialRow {
    x: f64,
    trial: f64,
    /// By how much it is off the bottom that balances.
    off: f64,
    right: f64,
    left: f64,
}

pub(super) const COLUMNS: &[ListedColumn<TrialRow>] = &[
    ("x_mm", |row| MILLIMETRES * row.x),
    ("trial_dx_mm", |row| MILLIMETRES * row.trial),
    ("right_n", |row| row.right),
    ("left_n", |row| row.left),
];

/// The trials for the plate of a machine at its design speed; none where the file has no plate, or (18) no solution.
pub(super) fn trials(machine: &Machine) -> Vec<TrialRow> {
    let (Some(plate), Ok(press)) = (plate(machine), machine.press()) else { return Vec::new() };
    let (mechanism, motion, stroke) = (plate.mechanism(), plate.motion().motion(), plate.stroke());
    let unit = press.cylinder().unit_force();
    let way = if mechanism.exact_on == ExactOn::Return { BedDirection::Return } else { BedDirection::Braking };
    let mut rows = Vec::new();
    for quarter in 1..=QUARTERS {
        let x = stroke * f64::from(quarter) / f64::from(QUARTERS);
        let (step, [found, ..]) = (STEP * stroke, motion.at(x, false));
        let [before, ..] = motion.at(x - step, false);
        for index in -TRIALS..=TRIALS {
            let off = REACH * stroke * f64::from(index) / f64::from(TRIALS);
            let trial = found + off;
            let left = unit * mechanism.load(x);
            let right = left - unit * mechanism.residual(x, trial, (trial - before) / step, way);
            rows.push(TrialRow { x, trial, off, right, left });
        }
    }
    rows
}

fn plate(machine: &Machine) -> Option<Wedge> {
    PressCams::of(machine).translating?;
    let rpm = machine.design_rpm()?;
    Wedge::solve(machine, rpm, Solver::Ode { tolerance: LAW_TOLERANCE }, exact_on(machine)).ok()
}

/// Figure 9: a curve and a level for each station of the bed.
pub(super) fn panel(rows: &[TrialRow]) -> Option<(String, PlotPanel)> {
    let places = rows.chunk_by(|a, b| a.x == b.x).enumerate();
    let mut curves = Vec::new();
    for (colour, rows) in places {
        let x = rows.first().map_or(f64::NAN, |row| MILLIMETRES * row.x);
        let right = rows.iter().map(|row| [MILLIMETRES * row.off, row.right]).collect();
        let left = rows.iter().map(|row| [MILLIMETRES * row.off, row.left]).collect();
        curves.push(PlotCurve::new(format!("x = {} mm", figure(x)), colour, right));
        curves.push(PlotCurve { stroke: CurveStroke::Dashed, ..PlotCurve::new("", colour, left) });
    }
    let name = "Both sides of equation (18), N; left side dashed";
    (!curves.is_empty()).then(|| ("trial Δx less the one that balances, mm".into(), PlotPanel::new(name, curves)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The right side crosses the left one within a station's error of the paper's scheme: 18 mm over the number of stations.
    #[test]
    fn the_sides_meet_at_the_solution() {
        let rows = trials(&Machine::load("dpi", &[]).expect("valid").0);
        assert_eq!(rows.len(), 4 * 41);
        for place in rows.chunk_by(|a, b| a.x == b.x) {
            let crossing = place.windows(2).find_map(|pair| match pair {
                [a, b] if (a.right - a.left) * (b.right - b.left) <= 0.0 => {
                    Some(a.trial + (b.trial - a.trial) * (a.left - a.right) / (b.right - a.right))
                }
                _ => None,
            });
            let (crossing, found) = (crossing.expect("a crossing"), place[20].trial);
            assert!((crossing - found).abs() < 18e-3 / 180.0, "{}: {crossing} {found}", place[0].x);
            // The left side is the inertia m ω² x.
            let inertia = 21_288.1 * place[0].x / 0.18;
            assert!((place[0].left / inertia - 1.0).abs() < 1e-5, "{}", place[0].left);
        }
    }
}

//! What the verdicts on a plate rest on: air, run-up, and changes that would make it worth while on the return.

use super::Wedge;
use crate::press::MachineOfPress;
use crate::press::buffer::bottom_law::ColumnRule;
use crate::press::buffer::place_law::PlaceLaw;
use crate::press::checks::column;
use crate::press::load::{RunUp, USEFUL};
use crate::press::machine::{AirColumn, Press, PressCams};
use crate::press::motion::equation_18::{BedDirection, ExactOn, Mechanism};
use crate::press::motion::{Transition, WedgeMotion};
use crate::press::scatter::fault::{STEPS, Station};
use crate::press::scatter::other_cams::{PlateStation, of_plate};
use camgen_cams::body::ROUNDING_OF_BALANCE;
use camgen_cams::report::{Section, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::{Worst, extremes};
use camgen_kernel::text::{KeyChange, Remedy, Text, text};

/// Steps in which friction angle (rad), efficiency and roller arm (m) are reported.
const ANGLE_STEP: f64 = 0.1;
const EFFICIENCY_STEPS: f64 = 100.0;
const ARM_STEP_MM: f64 = 10.0;
/// Trial roller arm / given roller arm.
const LONGEST_ARM: f64 = 4.0;
/// Trial columns / column of the plate.
const LONGER_COLUMNS: [f64; 7] = [1.1, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0];

impl Wedge {
    /// The direction of the bed in which the forces are not to balance; `None` where they are in both.
    pub(super) fn other_direction(&self) -> Option<BedDirection> {
        match self.mechanism().exact_on {
            ExactOn::Braking => Some(BedDirection::Return),
            ExactOn::Return => Some(BedDirection::Braking),
            ExactOn::Mean => None,
        }
    }

    /// Least air: as [`ForceBalanced::least_air`](crate::press::load::Balanced::least_air). Before the reversal x comes from below 0.
    pub(super) fn air(&self) -> Worst {
        let column = self.mechanism().bottom_law.column();
        let least = extremes::largest_of_motion(&self.motion, (&self.acting(), 0.0), |piece, x| {
            x + self.motion.bottom(piece, x).s - column
        });
        Worst { value: -least.value, at: least.at, z: 0.0 }
    }

    /// The run-up before the reversal.
    pub(super) fn ramp(&self) -> Option<RunUp> {
        let Transition::RunUp { width } = self.machine.transition() else { return None };
        let (stroke, [_, slope, second, _]) = (self.stroke(), self.motion.motion().at(0.0, false));
        let bed = &self.mechanism().bottom_law;
        if bed.in_line().is_none() {
            return Some(RunUp::new(stroke, width, slope * stroke, second * stroke * stroke));
        }
        // The quintic runs along the travel of the bed.
        Some(RunUp::along(stroke, width, |width| {
            let way = -bed.overrun(-width);
            (0.4 * slope * way - second * way * way / 20.0).abs()
        }))
    }

    /// The section on presses that differ.
    pub(super) fn scatter(&self) -> Option<Section> {
        let law = self.mechanism().bottom_law.by_crank();
        let motion = self.motion.motion();
        let mut stations = Vec::new();
        // At the very start there is no force, and its share of friction has no value.
        for step in 1..=STEPS {
            let angle = 0.5 * law.angle() * f64::from(step) / f64::from(STEPS);
            let [x, deceleration] = law.bed(angle);
            let x = if step == STEPS { law.stroke() } else { x };
            let [bottom, slope, ..] = motion.at(x, false);
            let (load, length) = (law.loading() * deceleration, (law.column() - x - bottom) / law.column());
            let air = libm::expm1(-law.exponent() * libm::log(length));
            let factors = [BedDirection::Braking, BedDirection::Return]
                .map(|way| (load - self.mechanism().residual(x, bottom, slope, way)) / air);
            stations.push(PlateStation { at: Station { angle, load, length, phase: 0.0 }, factors });
        }
        of_plate(&PressCams::of(&self.machine).scatter, &self.cylinder, law, &stations)
    }

    /// Friction angle, efficiency and roller arm, each of which alone brings the residual force in the direction in which the forces
    /// are not to balance below what a fixed bottom leaves.
    pub(super) fn worth_while(&self) -> Vec<Remedy> {
        let data = self.data;
        let Some(way) = self.other_direction() else { return Vec::new() };
        let own = *self.mechanism();
        let angle = first_passing(0.0, (data.friction_angle.to_degrees() / ANGLE_STEP).ceil(), |steps| {
            self.beats_fixed_bottom(&Mechanism { friction_angle: in_degrees(steps).to_radians(), ..own }, way)
        });
        let share = first_passing(EFFICIENCY_STEPS, (data.efficiency * EFFICIENCY_STEPS).floor(), |steps| {
            self.beats_fixed_bottom(&Mechanism { efficiency: steps / EFFICIENCY_STEPS, ..own }, way)
        });
        let from = (1e3 * data.roller_arm / ARM_STEP_MM).floor();
        let longer = first_passing((LONGEST_ARM * from).ceil(), from, |steps| {
            let arm_ratio = data.bottom_arm / (1e-3 * (steps * ARM_STEP_MM));
            self.beats_fixed_bottom(&Mechanism { arm_ratio, ..own }, way)
        });
        let remedies = [
            angle.map(|steps| {
                Remedy::new([KeyChange::new("translating.friction_angle", format!("{} deg", in_degrees(steps)))])
            }),
            share.map(|steps| {
                let efficiency = (steps / EFFICIENCY_STEPS).to_string();
                let words = format!("translating.efficiency = {efficiency}");
                Remedy::new([KeyChange::new("translating.efficiency", efficiency)]).in_words(words)
            }),
            longer.map(|steps| {
                Remedy::new([KeyChange::new("translating.roller_arm", format!("{} mm", steps * ARM_STEP_MM))])
            }),
        ];
        remedies.into_iter().flatten().collect()
    }
}

/// Steps of the friction angle in degrees.
fn in_degrees(steps: f64) -> f64 {
    (steps * ANGLE_STEP * 1e6).round() / 1e6
}

impl Wedge {
    /// Whether another mechanism leaves less than a fixed bottom in a direction.
    fn beats_fixed_bottom(&self, mechanism: &Mechanism, way: BedDirection) -> bool {
        self.left_by(mechanism, &[way]).is_some_and(|left| left < self.residual_fixed_bottom())
    }

    /// The largest residual force of another mechanism in these directions, N; `None` where (18) has no solution. The law alone is solved: the
    /// outline does not change what it leaves.
    fn left_by(&self, mechanism: &Mechanism, ways: &[BedDirection]) -> Option<f64> {
        let unit = self.cylinder.unit_force();
        let motion =
            WedgeMotion::new(*mechanism, self.solver, self.machine.transition(), self.data.roller_radius).ok()?;
        let negligible = ROUNDING_OF_BALANCE * self.inertia_max();
        let mut largest = 0.0_f64;
        for way in ways {
            let left = extremes::largest_size_of_motion(&motion, (&self.acting(), negligible), |piece, x| {
                unit * motion.residual(piece, x, *way)
            });
            largest = largest.max(left.value);
        }
        Some(largest)
    }

    /// A longer air column that leaves less in both directions: the shortest that is useful, else the best one that fits the press.
    pub(super) fn longer_column(&self) -> Option<Text> {
        let press = self.machine.press().ok()?;
        let (own, ways) = (self.mechanism().bottom_law.column(), [BedDirection::Braking, BedDirection::Return]);
        let (now, useful) = (self.left_by(self.mechanism(), &ways)?, USEFUL * self.residual_fixed_bottom());
        let longest = PressCams::of(&self.machine).largest_column.unwrap_or(column::CUSTOMARY);
        let longer = LONGER_COLUMNS.iter().map(|times| (1e3 * times * own).round() / 1e3);
        let tried = longer.take_while(|column| *column <= longest).filter_map(|column| {
            let press = Press { column: AirColumn::Of(ColumnRule::Length(column)), ..*press };
            let bottom_law = PlaceLaw::new(press.bottom_law(self.rpm))?;
            let left = self.left_by(&Mechanism { bottom_law, ..*self.mechanism() }, &ways)?;
            (left < now).then_some((column, left))
        });
        let tried: Vec<(f64, f64)> = tried.collect();
        let best = tried.iter().find(|(_, left)| *left < useful);
        let (column, left) = best.or_else(|| tried.iter().min_by(|a, b| a.1.total_cmp(&b.1)))?;
        let change = KeyChange::new("buffer.column", format!("{} mm", shown(MILLIMETRES * column)));
        Some(text!("{} leaves {} N", change.to_string(), shown(*left)))
    }
}

/// The whole number nearest to `failing` that passes, if `best` does.
fn first_passing(best: f64, mut failing: f64, passes: impl Fn(f64) -> bool) -> Option<f64> {
    let mut passing = best;
    if passing == failing || !passes(passing) {
        return None;
    }
    while (passing - failing).abs() > 1.0 {
        let middle = (0.5 * (passing + failing)).floor();
        *(if passes(middle) { &mut passing } else { &mut failing }) = middle;
    }
    Some(passing)
}

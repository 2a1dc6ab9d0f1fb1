//! The brake of a machine file at every radius of its roll, by the model of the file.

use crate::brake::BrakeDisc;
use crate::brake::machine::{BeltMode, BrakeData, BrakeModel};
use crate::brake::mechanics::{Brake, BrakeError, FramePose};
use camgen_kernel::motion::{Jet, Motion};
use camgen_kernel::numeric::extremum::{self, Extremum};

/// Parts of the roll in which an extreme of the tension is searched: it has two or three.
const CELLS: u32 = 48;

/// A brake with its weight.
#[derive(Debug, Clone)]
pub(super) struct LoadedBrake<'a> {
    pub(super) data: &'a BrakeData,
    pub(super) brake: &'a Brake,
    /// G, N.
    pub(super) weight: f64,
    /// G by the printed moment, or as given, N.
    pub(super) printed_weight: f64,
    /// The disc that holds the tension.
    pub(super) disc: Option<&'a BrakeDisc>,
    /// The full and the run-down roll.
    pub(super) ends: [FramePose; 2],
}

/// The least and the largest web tension over the roll, N, and the radii at which they are, m.
pub(super) struct TensionRange {
    pub(super) least: Extremum,
    pub(super) largest: Extremum,
}

/// Belt speed / web speed: as given while it slips, as the wanted tension needs it while it does not.
pub(super) fn belt_speed(data: &BrakeData) -> f64 {
    match (data.mode, &data.web, data.model) {
        (BeltMode::NoSlip, Some(web), BrakeModel::Consistent) => web.belt_speed(data.tension),
        (BeltMode::NoSlip, Some(web), BrakeModel::Printed) => web.belt_speed_printed(data.tension),
        _ => data.belt_speed_ratio,
    }
}

/// Web tension with the disc by its law, N.
fn least_held(disc: &BrakeDisc, pose: &FramePose, friction: f64) -> Option<f64> {
    let angle = disc.holding().turns_per_frame_turn() * pose.theta.abs();
    let jet = disc.jet(0, angle);
    let of_law = Jet { s: jet.s + disc.origin().unwrap_or(0.0), ..jet };
    disc.holding().tension_with(-disc.law().spring_torque(of_law), pose, friction).ok()
}

impl<'a> LoadedBrake<'a> {
    /// The brake with its weight; a weight that is not given is the one for the wanted tension on the full roll.
    pub(super) fn new(data: &'a BrakeData, brake: &'a Brake, disc: Option<&'a BrakeDisc>) -> Result<Self, BrakeError> {
        let roll = brake.roll();
        let ends = [brake.at(roll.largest_radius)?, brake.at(roll.smallest_radius)?];
        let [full, _] = &ends;
        let printed = data.weight.unwrap_or_else(|| brake.weight_for_printed(data.tension, full));
        let weight = match (data.weight, data.model, data.mode) {
            (Some(weight), ..) => weight,
            (None, BrakeModel::Consistent, _) => brake.weight_for(data.tension, full),
            (None, BrakeModel::Printed, BeltMode::NoSlip) => printed,
            // (8)
            (None, BrakeModel::Printed, BeltMode::Slip) => printed / (1.0 - data.belt_speed_ratio),
        };
        Ok(Self { data, brake, weight, printed_weight: printed, disc, ends })
    }

    /// Web tension, N, that the belt can hold by its grip, without the disc and for any belt speed.
    pub(super) fn grip(&self, pose: &FramePose) -> f64 {
        match self.data.model {
            BrakeModel::Consistent => self.brake.tension(self.weight, pose),
            BrakeModel::Printed => self.brake.tension_printed(self.weight, pose),
        }
    }

    /// Web tension, N, with another friction; `None` where the brake jams with it.
    pub(super) fn tension_with(&self, pose: &FramePose, friction: f64) -> Option<f64> {
        let grip = match (self.data.model, self.disc) {
            (BrakeModel::Consistent, Some(disc)) => least_held(disc, pose, friction)?,
            (BrakeModel::Consistent, None) => self.brake.tension_with(self.weight, pose, friction).ok()?,
            (BrakeModel::Printed, _) => self.brake.tension_printed_with(self.weight, pose, friction),
        };
        Some(self.of_grip(grip))
    }

    /// Web tension, N, with a belt that can hold this tension, N.
    fn of_grip(&self, grip: f64) -> f64 {
        match (self.data.mode, self.data.model) {
            // The speed gives the wanted tension, as far as the belt grips.
            (BeltMode::NoSlip, _) => grip.min(self.data.tension),
            (BeltMode::Slip, BrakeModel::Consistent) => grip,
            // (6)
            (BeltMode::Slip, BrakeModel::Printed) => grip * (1.0 - self.data.belt_speed_ratio),
        }
    }

    /// Whether the belt runs with the roll: its speed makes the tension, and friction only holds it.
    fn runs_with_roll(&self, pose: &FramePose) -> bool {
        self.data.mode == BeltMode::NoSlip && self.grip(pose) > self.data.tension
    }

    /// Tension of the slack span and of the tight one, N. The moments about the pivot are those of frame and weight,
    /// G h1 = T (q_t + q_s) + P q_t; by (3) both spans are equally tight, at any speed of the belt.
    pub(super) fn belt_tensions(&self, pose: &FramePose) -> (f64, f64) {
        let (grip, tension) = (self.grip(pose), self.tension(pose));
        match (self.data.model, self.runs_with_roll(pose)) {
            (BrakeModel::Consistent, false) => self.brake.belt_tensions(tension, pose),
            (BrakeModel::Printed, false) => self.brake.belt_tensions(grip, pose),
            (BrakeModel::Consistent, true) => {
                let slack = (self.weight * pose.h1 - tension * pose.q_tight) / (pose.q_tight + pose.q_slack);
                (slack, slack + tension)
            }
            (BrakeModel::Printed, true) => {
                // (5): 2 T_o = T1 + T, as tight as in the slip.
                let (slack, tight) = self.brake.belt_tensions(grip, pose);
                let mean = 0.5 * (slack + tight);
                (mean - 0.5 * tension, mean + 0.5 * tension)
            }
        }
    }

    /// d ln P/d ln f: 0 where the belt runs with the roll.
    pub(super) fn sensitivity(&self, pose: &FramePose) -> f64 {
        let friction = self.brake.friction();
        match self.data.model {
            _ if self.runs_with_roll(pose) => 0.0,
            BrakeModel::Consistent => pose.sensitivity(friction),
            BrakeModel::Printed => {
                let grip = pose.wrap * friction;
                grip / libm::sinh(grip)
            }
        }
    }

    /// Web tension, N.
    pub(super) fn tension(&self, pose: &FramePose) -> f64 {
        if let Some(disc) = self.disc {
            return least_held(disc, pose, self.brake.friction()).unwrap_or(f64::NAN);
        }
        self.of_grip(self.grip(pose))
    }

    /// Belt speed / web speed, by (9).
    pub(super) fn regulated(&self, pose: &FramePose) -> f64 {
        1.0 - self.data.tension / self.grip(pose)
    }

    /// Largest of something over the roll, and at which radius, m.
    pub(super) fn largest(&self, value: impl Fn(&FramePose) -> f64) -> Extremum {
        let roll = self.brake.roll();
        extremum::largest_without_slope(
            |radius| self.brake.at(radius).map_or(f64::NAN, |pose| value(&pose)),
            (roll.smallest_radius, roll.largest_radius),
            CELLS,
            extremum::TO_ROUNDING,
        )
    }

    /// Least of something over the roll, and at which radius, m.
    pub(super) fn least(&self, value: impl Fn(&FramePose) -> f64) -> Extremum {
        let found = self.largest(|pose| -value(pose));
        Extremum { value: -found.value, ..found }
    }

    /// Least and largest tension over the roll.
    pub(super) fn tensions(&self) -> TensionRange {
        TensionRange { least: self.least(|pose| self.tension(pose)), largest: self.largest(|pose| self.tension(pose)) }
    }

    /// Radii from the full roll down in equal steps, both ends included.
    pub(super) fn radii(&self, steps: u32) -> impl Iterator<Item = f64> + Clone + use<> {
        let (from, to) = (self.brake.roll().largest_radius, self.brake.roll().smallest_radius);
        (0..=steps).map(move |i| {
            if i == 0 {
                return from;
            }
            if i == steps {
                return to;
            }
            // To the nanometre: 55 mm, not 55.00000000000005.
            let radius = from + (to - from) * f64::from(i) / f64::from(steps);
            ((1e9 * radius).round() / 1e9).clamp(to, from)
        })
    }
}

//! The rotary cam of a machine at a speed.

use super::size::{self, Required};
use super::{AnyCurves, Cam, Curves, Place, extremes};
use crate::buffer::Cylinder;
use crate::buffer::balance::Balance;
use crate::follower::TranslatingRoller;
use crate::law::{Law, LawError, Reversal, ReversalLaw};
use crate::machine::{Machine, Rotation};
use crate::numeric::extremum;
use nalgebra::Vector2;

/// A disc cam for one speed.
#[derive(Debug, Clone)]
pub struct Rotary {
    /// The machine it is for.
    pub machine: Machine,
    /// Speed of the main shaft, rpm.
    pub rpm: f64,
    /// The pair of cylinders.
    pub cylinder: Cylinder,
    /// Law and follower.
    pub curves: Curves<Reversal, TranslatingRoller>,
    /// Smallest prime radius that keeps every limit, m; `None` when none does.
    pub smallest_prime_radius: Option<f64>,
}

/// Why there is no cam.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RotaryError {
    /// The motion does not go together.
    #[error("{0}; see transition.width, buffer.lead and cam.cam_turns_per_crank_turn")]
    Law(#[from] LawError),
    /// `auto` found nothing.
    #[error("{0}: relax limits.pressure_angle or limits.min_convex_pitch_radius_over_roller, or give cam.base_radius")]
    Size(#[from] size::NoRadius),
}

/// Whole millimetres an automatic base radius is rounded up to, m; rounding noise of 1 nm is not a millimetre.
const BASE_STEP: f64 = 1e-3;
const BASE_STEP_NOISE: f64 = 1e-6;

/// Cells of a piece in which the largest lift is searched: a piece has two extrema at the most.
const LIFT_CELLS: u32 = 64;

impl Rotary {
    /// Solves the law and sizes the cam.
    ///
    /// # Errors
    /// [`RotaryError`] when the motion cannot be put together or no radius keeps the limits.
    pub fn solve(machine: &Machine, rpm: f64) -> Result<Self, RotaryError> {
        let cylinder = machine.cylinder();
        let balance = Balance::new(
            cylinder.loading(rpm),
            machine.polytropic_exponent,
            machine.bed.crank_radius,
            machine.column,
            machine.lead,
        );
        let law = Reversal::new(ReversalLaw {
            balance,
            lever: machine.cam.lever,
            ratio: machine.cam.turns_per_crank_turn,
            transition: machine.transition,
        })?;
        let (roller, limits) = (machine.roller, machine.limits);
        let least_base = machine.cam.bore_reach().map_or(BASE_STEP, |reach| reach + limits.wall);
        let required = Required {
            pressure_angle: limits.pressure_angle,
            convex_pitch_radius: limits.min_convex_pitch_radius_over_roller.max(1.0) * roller.radius,
            least: (least_base + roller.radius).max(roller.offset.abs() * (1.0 + 1e-6)),
        };
        let follower = |prime_radius| TranslatingRoller::new(prime_radius, roller.offset, roller.radius);
        let smallest = size::smallest_prime_radius(&law, follower, &required);
        let base = match machine.cam.base_radius {
            Some(base) => base,
            None => round_up(smallest? - roller.radius),
        };
        let curves = Curves { law, follower: follower(base + roller.radius) };
        Ok(Self { machine: machine.clone(), rpm, cylinder, curves, smallest_prime_radius: smallest.ok() })
    }

    /// Base radius R_b, m.
    #[must_use]
    pub fn base_radius(&self) -> f64 {
        self.curves.follower.prime_radius() - self.machine.roller.radius
    }

    /// The base radius `auto` would take, m: the smallest that passes, in whole millimetres.
    #[must_use]
    pub fn passing_base_radius(&self) -> Option<f64> {
        self.smallest_prime_radius.map(|prime| round_up(prime - self.machine.roller.radius))
    }

    /// The law of the bottom.
    #[must_use]
    pub fn balance(&self) -> &Balance {
        &self.curves.law.law().balance
    }

    /// Largest lift, m.
    #[must_use]
    pub fn max_lift(&self) -> f64 {
        let law = &self.curves.law;
        let lifts = law.pieces().iter().enumerate().map(|(index, piece)| {
            let jet = |angle| law.jet(index, angle);
            extremum::largest(|a| jet(a).s, |a| jet(a).ds, (piece.start, piece.end), LIFT_CELLS).value
        });
        lifts.fold(0.0, f64::max)
    }

    /// Force between roller and cam along the roller's path, N: the air's, 2 (p − p0) F / lever, and, where they are
    /// given, preload and the inertia of what moves with the roller.
    #[must_use]
    pub fn roller_force(&self, piece: usize, angle: f64) -> f64 {
        let state = self.curves.law.state(piece, angle);
        let air = self.cylinder.force(state.pressure_ratio) / self.machine.cam.lever;
        let preload = self.machine.roller.preload.unwrap_or(0.0);
        let Some(mass) = self.machine.roller.mass else { return air + preload };
        let speed = self.machine.bed.crank_speed(self.rpm) * self.machine.cam.turns_per_crank_turn;
        air + preload + mass * speed * speed * self.curves.law.jet(piece, angle).dds
    }

    /// Inertia force of the bed at its largest, N.
    #[must_use]
    pub fn inertia_max(&self) -> f64 {
        self.cylinder.largest_load(self.balance())
    }

    /// Largest |inertia − air| the law leaves over the reversal, N: rounding, or what a blend costs.
    ///
    #[must_use]
    pub fn residual_max(&self) -> f64 {
        let law = &self.curves.law;
        let unit = self.cylinder.unit_force();
        let residual = |piece: usize, angle: f64| {
            let state = law.state(piece, angle);
            unit * (self.balance().loading * state.overrun - (state.pressure_ratio - 1.0)).abs()
        };
        extremes::largest_without_slope(&self.curves, residual).value
    }

    /// Largest force between roller and cam along the roller's path, N.
    #[must_use]
    pub fn roller_force_max(&self) -> f64 {
        extremes::largest_without_slope(&self.curves, |piece, angle| self.roller_force(piece, angle)).value
    }

    /// Torque the camshaft gives at a cam angle of a piece, N·m: force times ds/dθ.
    #[must_use]
    pub fn torque(&self, piece: usize, angle: f64) -> f64 {
        self.roller_force(piece, angle) * self.curves.law.jet(piece, angle).ds
    }

    /// Torque of largest size, N·m; symmetric over rise and fall where no mass is given.
    #[must_use]
    pub fn torque_max(&self) -> f64 {
        extremes::largest_without_slope(&self.curves, |piece, angle| self.torque(piece, angle).abs()).value
    }

    /// What a plain buffer with fixed bottom and column by (7) would leave at this speed, N.
    #[must_use]
    pub fn residual_fixed_bottom(&self) -> f64 {
        self.cylinder.residual_fixed_bottom(self.balance())
    }
}

impl Cam for Rotary {
    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn rpm(&self) -> f64 {
        self.rpm
    }

    fn kind(&self) -> &'static str {
        "rotary cam"
    }

    fn curves(&self) -> AnyCurves<'_> {
        Curves { law: &self.curves.law, follower: &self.curves.follower }
    }

    fn place(&self, parameter: f64) -> Place {
        Place::at_angle(parameter)
    }

    fn parameter_at(&self, point: Vector2<f64>) -> f64 {
        let angle = libm::atan2(point.y, point.x);
        match self.machine.cam.rotation {
            Rotation::Clockwise => angle,
            Rotation::CounterClockwise => -angle,
        }
    }

    fn mirrored(&self) -> &'static [bool] {
        match self.machine.cam.rotation {
            Rotation::Clockwise => &[false],
            Rotation::CounterClockwise => &[true],
        }
    }

    fn contact_force(&self, piece: usize, angle: f64) -> f64 {
        self.roller_force(piece, angle).max(0.0) / libm::cos(self.curves.contact(piece, angle).pressure_angle)
    }

    fn closing_force(&self, piece: usize, angle: f64) -> Option<f64> {
        let roller = self.machine.roller;
        (roller.mass.is_some() || roller.preload.is_some()).then(|| self.roller_force(piece, angle))
    }

    fn unbalanced(&self, piece: usize, angle: f64, moved: f64, _: Vector2<f64>) -> f64 {
        let law = &self.curves.law;
        let state = law.state(piece, angle);
        if state.overrun == 0.0 {
            return 0.0;
        }
        let balance = self.balance();
        let bottom = state.displacement + moved / law.law().lever;
        let air = balance.pressure_ratio(state.overrun, bottom) - 1.0;
        self.cylinder.unit_force() * (balance.loading * state.overrun - air).abs()
    }

    fn wall(&self) -> Option<f64> {
        self.machine.cam.bore_reach().map(|bore| self.base_radius() - bore)
    }

    fn remedy(&self) -> Option<String> {
        self.passing_base_radius().map(|base| format!("a base radius of {} mm would pass", 1e3 * base))
    }
}

pub(super) fn round_up(base: f64) -> f64 {
    let steps = (base / BASE_STEP - BASE_STEP_NOISE).ceil();
    // A quotient keeps "69 mm" the number nearest to 0.069.
    steps / (1.0 / BASE_STEP)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rotary(name: &str, overrides: &[&str]) -> Rotary {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        let machine = Machine::load(name, &overrides).expect("valid").0;
        Rotary::solve(&machine, machine.design_rpm).expect("a cam")
    }

    #[test]
    fn the_reference_cams_have_the_reference_radii() {
        let dpi = rotary("dpi", &["transition.kind=none"]);
        let prime = dpi.smallest_prime_radius.expect("a radius");
        assert!((prime - 0.098_98).abs() < 5e-6, "{prime}");
        assert_eq!(dpi.base_radius(), 0.069);
        assert!((dpi.max_lift() - 0.082_42).abs() < 5e-6);
        let dwell = prime + dpi.max_lift();
        assert!((dwell - 0.1814).abs() < 5e-5, "dwell at {dwell}");

        // At 5 at a pitch radius of 200 mm has 71.1° without transition; 30° needs 1015 mm.
        let paper = rotary("dpi-paper", &["transition.kind=none", "cam.base_radius=170mm"]);
        let worst = extremes::pressure_angle(&paper.curves);
        assert!((worst.value.to_degrees() - 71.1).abs() < 0.05, "{}", worst.value.to_degrees());
        let passing = paper.smallest_prime_radius.expect("a radius");
        assert!((passing - 1.015).abs() < 1e-3, "{passing}");
    }

    /// The solved radius is the smallest: it passes, and a hair less does not.
    #[test]
    fn the_solved_radius_is_the_smallest_that_passes() {
        for overrides in [
            vec![],
            vec!["follower.roller.offset=15mm"],
            vec!["follower.roller.offset=-15mm"],
            vec!["limits.pressure_angle=60deg"],
            vec!["limits.pressure_angle=60deg", "limits.min_convex_pitch_radius_over_roller=3"],
            vec!["buffer.column=return", "cam.lever=0.2"],
        ] {
            let cam = rotary("dpi", &overrides);
            let prime = cam.smallest_prime_radius.expect("a radius");
            let roller = cam.machine.roller;
            let passes = |prime: f64| {
                let curves = Curves {
                    law: &cam.curves.law,
                    follower: TranslatingRoller::new(prime, roller.offset, roller.radius),
                };
                let convex = cam.machine.limits.min_convex_pitch_radius_over_roller * roller.radius;
                extremes::pressure_angle(&curves).value <= cam.machine.limits.pressure_angle
                    && extremes::convex_pitch_curvature(&curves).value * convex <= 1.0
            };
            assert!(passes(prime), "{overrides:?}");
            assert!(!passes(prime * (1.0 - 1e-9)), "{overrides:?}");
            assert!(passes(cam.curves.follower.prime_radius()), "{overrides:?}");
        }
    }

    #[test]
    fn a_run_up_leaves_no_residual_and_a_blend_its_own() {
        let exact = rotary("dpi", &[]);
        assert!(exact.residual_max() < 1e-13 * exact.inertia_max(), "{}", exact.residual_max());
        assert!((exact.residual_fixed_bottom() / exact.inertia_max() - 0.150).abs() < 5e-4);
        let blend = rotary("dpi", &["transition.kind=blend", "transition.width=30deg"]);
        let share = blend.residual_max() / blend.inertia_max();
        assert!((share - 0.002_094_2).abs() < 1e-6, "{share}");
    }
}

//! The wedge cam of the press (a linear cam): the plate that rides on the bed, for one speed.

mod balance;
mod figures;
mod implementation;
mod mechanism;
pub mod roller_clearance;
mod sheet;

use crate::press::MachineOfPress;
use crate::press::bed_motion::Linkage;
use crate::press::buffer::Cylinder;
use crate::press::buffer::place_law::PlaceLaw;
use crate::press::cams;
use crate::press::machine::{Press, PressCams, TranslatingData};
use crate::press::motion::WedgeMotion;
use crate::press::motion::equation_18::{BedDirection, ExactOn, Mechanism, Solver};
use camgen_cams::body::{Kind, ROUNDING_OF_BALANCE, WorstPlaces, largest, plane};
use camgen_cams::machine::Machine;
use camgen_kernel::follower::BellCrank;
use camgen_kernel::motion::Motion;
use camgen_kernel::numeric::chebyshev::{self, SearchStart};
use camgen_kernel::profile::extremes::{self, JumpRange};
use camgen_kernel::profile::{Curves, Worst};
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;
use std::sync::Arc;

/// The wedge cam: the plate on the bed.
pub const KIND: Kind = Kind { command: "translating", noun: "translating cam", keys: cams::TRANSLATING };

/// Absolute tolerance of Δx, m, unless another is given: a thousandth of a nanometre. The outline adds its own,
/// a million times larger.
pub const LAW_TOLERANCE: f64 = 1e-15;

/// Flat before the run-in and straight run-out after the stroke, as shares of the roller radius: room for the roller to
/// stand on, and for the contact not to end on an edge.
const FLAT_OVER_ROLLER: f64 = 1.0;
const RUN_OUT_OVER_ROLLER: f64 = 0.1;

/// Whole millimetres a height that was not given is rounded up to, m.
const HEIGHT_STEP: f64 = 1e-3;

/// A cam plate for one speed.
#[derive(Debug, Clone)]
pub struct Wedge {
    machine: Arc<Machine>,
    data: TranslatingData,
    rpm: f64,
    /// Angular speed ω of the crank, rad/s.
    crank_speed: f64,
    cylinder: Cylinder,
    solver: Solver,
    /// Motion and follower of the lower flank; the upper one is its mirror image.
    motion: WedgeMotion,
    follower: BellCrank,
    /// Height of the plate, m.
    height: f64,
    /// Height where it is thinnest, m; not positive where the flanks would cross.
    thinnest: f64,
    /// Where it is thinnest, overrun in m.
    thinnest_at: f64,
    worst: WorstPlaces,
}

impl Wedge {
    /// Solves (18) and sizes the plate.
    ///
    /// # Errors
    /// [`Refusal`] when the machine has no plate or (18) no solution.
    pub fn solve(machine: &Machine, rpm: f64, solver: Solver, exact_on: ExactOn) -> Result<Self, Refusal> {
        let data = PressCams::of(machine).translating.ok_or_else(|| {
            Refusal::new("the machine file has no [translating] table")
                .remedy("a plate needs roller_arm, bottom_arm and delta")
        })?;
        let press = machine.press()?;
        if press.lead > 0.0 {
            return Err(Refusal::new("equation (18) holds without a lead only")
                .remedy("set buffer.lead to \"0 mm\" for a translating cam"));
        }
        let bottom_law = PlaceLaw::new(press.bottom_law(rpm)).ok_or_else(|| unsymmetric(press))?;
        let mechanism = Mechanism {
            bottom_law,
            bottom_arm: data.bottom_arm,
            arm_ratio: data.bottom_arm / data.roller_arm,
            delta: data.delta,
            friction_angle: data.friction_angle,
            efficiency: data.efficiency,
            model: data.efficiency_model,
            exact_on,
        };
        let flat = FLAT_OVER_ROLLER * data.roller_radius;
        let motion = WedgeMotion::new(mechanism, solver, machine.transition(), flat)?;
        let follower = BellCrank {
            roller_arm: data.roller_arm,
            bottom_arm: data.bottom_arm,
            delta: data.delta,
            lowest: motion.lowest(),
            axis_distance: 0.0,
            roller_radius: data.roller_radius,
        };
        let mut plate = Self {
            machine: Arc::new(machine.clone()),
            data,
            rpm,
            crank_speed: press.bed.crank_speed(rpm),
            cylinder: press.cylinder(),
            solver,
            motion,
            follower,
            height: 0.0,
            thinnest: 0.0,
            thinnest_at: 0.0,
            worst: WorstPlaces::default(),
        };
        plate.place_axis();
        Ok(plate)
    }

    /// Puts the bed's axis where the plate gets its height, and finds where it is thinnest.
    fn place_axis(&mut self) {
        let highest = largest(self.curves(), |piece, x| -self.curves().profile(piece, x).point.y);
        let lowest = largest(self.curves(), |piece, x| self.curves().profile(piece, x).point.y);
        let run_out = -self.run_out().y;
        let high = highest.value.max(run_out);
        let (low, at) = if run_out < -lowest.value { (run_out, self.stroke()) } else { (-lowest.value, lowest.at) };
        self.height = self.data.plate_height.unwrap_or_else(|| {
            let least = self.machine.limits.least_wall(None).max(self.data.roller_radius);
            ((2.0 * (high - low) + least) / HEIGHT_STEP).ceil() * HEIGHT_STEP
        });
        self.follower.axis_distance = 0.5 * self.height - high;
        self.thinnest = self.height - 2.0 * (high - low);
        self.thinnest_at = at;
    }

    /// Motion and follower of the lower flank.
    #[must_use]
    pub fn curves(&self) -> Curves<'_> {
        Curves { motion: &self.motion, follower: &self.follower }
    }

    /// The motion.
    #[must_use]
    pub fn motion(&self) -> &WedgeMotion {
        &self.motion
    }

    /// Where the lower flank starts, m.
    #[must_use]
    pub fn start(&self) -> Vector2<f64> {
        self.curves().profile(0, self.motion.range().0).point
    }

    /// Where the straight run-out of the lower flank ends, m.
    #[must_use]
    pub fn run_out(&self) -> Vector2<f64> {
        let last = self.motion.pieces().len().saturating_sub(1);
        let end = self.curves().profile(last, self.stroke());
        end.point + end.tangent * (RUN_OUT_OVER_ROLLER * self.data.roller_radius)
    }

    /// The whole overrun, m.
    #[must_use]
    pub fn stroke(&self) -> f64 {
        self.mechanism().bottom_law.stroke()
    }

    /// Overrun of the bed at a crank angle from the start of its reversal, in strokes.
    pub(super) fn place(&self, crank: f64) -> f64 {
        self.mechanism().bottom_law.by_crank().place(crank)
    }

    /// The machine of (18).
    #[must_use]
    pub fn mechanism(&self) -> &Mechanism {
        self.motion.mechanism()
    }

    /// Largest lift, m.
    #[must_use]
    pub fn max_lift(&self) -> f64 {
        largest(self.curves(), |piece, x| self.motion.jet(piece, x).s).value
    }

    /// The Δx of largest size over the stroke: (x, Δx), both m.
    #[must_use]
    pub fn largest_displacement(&self) -> (f64, f64) {
        let motion = self.motion.motion();
        let breaks = motion.breaks().iter().map(|b| b.x).chain([self.stroke()]);
        let (mut from, mut worst, mut size) = (0.0, 0.0, 0.0);
        for to in breaks {
            let range = (from, to);
            let found = chebyshev::largest_size(|x| motion.at(x, false)[0], range, SearchStart::nothing(0.0));
            if found.value > size {
                (worst, size) = (found.at, found.value);
            }
            from = to;
        }
        (worst, motion.at(worst, false)[0])
    }

    /// Inertia force of the bed at its largest, N.
    #[must_use]
    pub fn inertia_max(&self) -> f64 {
        self.cylinder.largest_load(self.mechanism().bottom_law.by_crank())
    }

    /// Left side less right side of (18), N, in a direction of the bed; 0 before the reversal.
    #[must_use]
    pub fn residual(&self, piece: usize, x: f64, way: BedDirection) -> f64 {
        self.cylinder.unit_force() * self.motion.residual(piece, x, way)
    }

    /// The range at whose start forces may jump: the reversal.
    pub(super) fn acting(&self) -> [JumpRange; 1] {
        [(0.0, self.stroke())]
    }

    /// Residual of largest size in a direction of the bed, N, and the overrun where it is, m.
    #[must_use]
    pub fn residual_max(&self, way: BedDirection) -> Worst {
        let negligible = ROUNDING_OF_BALANCE * self.inertia_max();
        let acting = self.acting();
        plane(extremes::largest_size(self.curves(), (&acting, negligible), |piece, x| self.residual(piece, x, way)))
    }

    /// The largest of something that is smooth but at the start of the reversal.
    pub(super) fn largest_force(&self, value: impl Fn(usize, f64) -> f64) -> Worst {
        plane(extremes::largest_smooth(self.curves(), (&self.acting(), 0.0), value))
    }

    /// Residual force of a plain buffer with fixed bottom and column by (7) at this speed, N.
    #[must_use]
    pub fn residual_fixed_bottom(&self) -> f64 {
        self.cylinder.residual_fixed_bottom(self.mechanism().bottom_law.by_crank())
    }

    /// Normal force of one roller on its flank in a direction of the bed, N, equation (17); 0 before the reversal.
    #[must_use]
    pub fn roller_force(&self, piece: usize, x: f64, way: BedDirection) -> f64 {
        if x < 0.0 {
            return 0.0;
        }
        let bottom = self.motion.bottom(piece, x);
        0.5 * self.cylinder.unit_force()
            * self.mechanism().normal_force(self.motion.trend(piece, x), way, x, bottom.s, bottom.ds)
    }

    /// Largest of these in either direction, N.
    #[must_use]
    pub fn roller_force_max(&self) -> f64 {
        let [braking, back] = [BedDirection::Braking, BedDirection::Return]
            .map(|way| self.largest_force(|piece, x| self.roller_force(piece, x, way)).value);
        braking.max(back).max(0.0)
    }

    /// The direction in which the forces are to balance, or both.
    #[must_use]
    pub fn balanced_directions(&self) -> &'static [BedDirection] {
        match self.mechanism().exact_on {
            ExactOn::Braking => &[BedDirection::Braking],
            ExactOn::Return => &[BedDirection::Return],
            ExactOn::Mean => &[BedDirection::Braking, BedDirection::Return],
        }
    }

    /// Normal force of a roller on its flank in the worse direction of the bed, N.
    fn normal_force(&self, piece: usize, x: f64) -> f64 {
        let [braking, back] = [BedDirection::Braking, BedDirection::Return].map(|way| self.roller_force(piece, x, way));
        braking.max(back).max(0.0)
    }

    /// Force that presses a roller onto its flank along its path, N: the air's share by the lever, preload, and the inertia of
    /// what moves with the roller, whose path is l1 ψ; the bed sets its pace.
    fn path_force(&self, piece: usize, x: f64) -> f64 {
        let follower = &self.machine.follower;
        let bottom = self.motion.bottom(piece, x);
        let (arm, sine) = (self.data.bottom_arm, bottom.s / self.data.bottom_arm);
        let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
        let first = bottom.ds / (arm * cosine);
        let second = (bottom.dds / arm + sine * first * first) / cosine;
        let [speed_squared, slowing] = self.mechanism().bottom_law.by_time(x, self.crank_speed);
        let inertia = follower.mass.unwrap_or(0.0) * self.data.roller_arm * (second * speed_squared - first * slowing);
        let air = if x >= 0.0 { self.mechanism().air(x, bottom.s) } else { 0.0 };
        let by_air = 0.5 * self.cylinder.unit_force() * air * self.mechanism().arm_ratio * cosine;
        by_air + follower.preload.unwrap_or(0.0) + inertia
    }
}

/// A point of the other flank.
fn mirrored_about_axis(point: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(point.x, -point.y)
}

/// Why there is no plate for a bed with two decelerations at one position.
fn unsymmetric(press: &Press) -> Refusal {
    let six_bar = press.stroke_end.is_some_and(|end| matches!(end.linkage(), Linkage::SixBar(..)));
    let which = if six_bar { "a six-bar" } else { "a crank-slider with an offset" };
    Refusal::new(format!(
        "the bed of this machine is moved by a linkage whose return stroke does not mirror its outward stroke \
         ({which}): at one place it \
         has two decelerations, and they meet at the dead point like a square root, where the flank of a plate that \
         balances one of them \
         would have no radius of curvature"
    ))
    .remedy(
        "use a crank-slider without offset (linkage.kind = \"crank-slider\", linkage.offset_ratio = 0) or a yoke, or \
         `camgen rotary`, \
         which makes the cam of any linkage",
    )
}

#[cfg(test)]
mod tests;

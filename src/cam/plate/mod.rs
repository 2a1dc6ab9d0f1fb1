//! The cam plate that rides on the bed, for a machine at a speed.

use super::{AnyCurves, Cam, Curves, Place, extremes};
use crate::buffer::Cylinder;
use crate::buffer::balance::Balance;
use crate::follower::BellCrank;
use crate::law::translating::{Exact, Mechanism, Solver, TranslatingError, Way};
use crate::law::{Law, Translating};
use crate::machine::{Machine, TranslatingData};
use crate::numeric::extremum;
use nalgebra::Vector2;

/// Absolute tolerance of Δx, m, when nothing else is asked for: a thousandth of a nanometre. The outline adds its own,
/// a million times larger.
pub const LAW_TOLERANCE: f64 = 1e-15;

/// Flat before the run-in and straight run-out after the stroke, as shares of the roller radius: room for the roller to
/// stand on, and for the contact not to end on an edge.
const FLAT_OVER_ROLLER: f64 = 1.0;
const RUN_OUT_OVER_ROLLER: f64 = 0.1;

/// What is nearer to an end of the plate than this is the end, m.
const END_WIDTH: f64 = 1e-4;

/// Whole millimetres a height that was not given is rounded up to, m.
const HEIGHT_STEP: f64 = 1e-3;

/// A cam plate for one speed.
#[derive(Debug, Clone)]
pub struct Plate {
    /// The machine it is for.
    pub machine: Machine,
    /// What the machine file tells of the plate.
    pub data: TranslatingData,
    /// Speed of the main shaft, rpm.
    pub rpm: f64,
    /// The pair of cylinders.
    pub cylinder: Cylinder,
    /// How (18) was solved.
    pub solver: Solver,
    /// Law and follower of the lower flank; the upper one is its mirror image.
    pub curves: Curves<Translating, BellCrank>,
    /// Height of the plate, m.
    pub height: f64,
    /// Height where it is thinnest, m; not positive where the flanks would cross.
    pub thinnest: f64,
    /// Where it is thinnest, overrun in m.
    pub thinnest_at: f64,
}

/// Why there is no plate.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlateError {
    /// The machine file does not describe one.
    #[error("the machine file has no [translating] table: a plate needs roller_arm, bottom_arm and delta")]
    NotDescribed,
    /// (18) has no lead.
    #[error("equation (18) knows no lead: set buffer.lead to \"0 mm\" for a translating cam")]
    Lead,
    /// The motion.
    #[error(transparent)]
    Law(#[from] TranslatingError),
}

impl Plate {
    /// Solves (18) and sizes the plate.
    ///
    /// # Errors
    /// [`PlateError`] when the machine has no plate or (18) no answer.
    pub fn solve(machine: &Machine, rpm: f64, solver: Solver, exact: Exact) -> Result<Self, PlateError> {
        let data = machine.translating.ok_or(PlateError::NotDescribed)?;
        if machine.lead > 0.0 {
            return Err(PlateError::Lead);
        }
        let cylinder = machine.cylinder();
        let balance = Balance::new(
            cylinder.loading(rpm),
            machine.polytropic_exponent,
            machine.bed.crank_radius,
            machine.column,
            0.0,
        );
        let mechanism = Mechanism {
            balance,
            bottom_arm: data.bottom_arm,
            arm_ratio: data.bottom_arm / data.roller_arm,
            delta: data.delta,
            friction_angle: data.friction_angle,
            efficiency: data.efficiency,
            model: data.efficiency_model,
            exact,
        };
        let flat = FLAT_OVER_ROLLER * data.roller_radius;
        let law = Translating::new(mechanism, solver, machine.transition, flat)?;
        let follower = BellCrank {
            roller_arm: data.roller_arm,
            bottom_arm: data.bottom_arm,
            delta: data.delta,
            lowest: law.lowest(),
            axis_distance: 0.0,
            roller_radius: data.roller_radius,
        };
        let mut plate = Self {
            machine: machine.clone(),
            data,
            rpm,
            cylinder,
            solver,
            curves: Curves { law, follower },
            height: 0.0,
            thinnest: 0.0,
            thinnest_at: 0.0,
        };
        plate.place_axis();
        Ok(plate)
    }

    /// Puts the bed's axis where the plate gets its height, and finds where it is thinnest.
    fn place_axis(&mut self) {
        let up = |piece: usize, x: f64| -self.curves.profile(piece, x).point.y;
        let highest = extremes::largest_without_slope(&self.curves, up);
        let lowest = extremes::largest_without_slope(&self.curves, |piece, x| -up(piece, x));
        let run_out = -self.run_out().y;
        let high = highest.value.max(run_out);
        let (low, at) = if run_out < -lowest.value { (run_out, self.stroke()) } else { (-lowest.value, lowest.at) };
        self.height = self.data.plate_height.unwrap_or_else(|| {
            let least = self.machine.limits.wall.max(self.data.roller_radius);
            ((2.0 * (high - low) + least) / HEIGHT_STEP).ceil() * HEIGHT_STEP
        });
        self.curves.follower.axis_distance = 0.5 * self.height - high;
        self.thinnest = self.height - 2.0 * (high - low);
        self.thinnest_at = at;
    }

    /// Where the lower flank starts, m.
    #[must_use]
    pub fn start(&self) -> Vector2<f64> {
        self.curves.profile(0, self.curves.law.range().0).point
    }

    /// Where the straight run-out of the lower flank ends, m.
    #[must_use]
    pub fn run_out(&self) -> Vector2<f64> {
        let last = self.curves.law.pieces().len().saturating_sub(1);
        let end = self.curves.profile(last, self.stroke());
        end.point + end.tangent * (RUN_OUT_OVER_ROLLER * self.data.roller_radius)
    }

    /// The whole overrun r, m.
    #[must_use]
    pub fn stroke(&self) -> f64 {
        self.machine.bed.crank_radius
    }

    /// The machine of (18).
    #[must_use]
    pub fn mechanism(&self) -> &Mechanism {
        self.curves.law.mechanism()
    }

    /// Largest lift, m.
    #[must_use]
    pub fn max_lift(&self) -> f64 {
        extremes::largest_without_slope(&self.curves, |piece, x| self.curves.law.jet(piece, x).s).value
    }

    /// The Δx of largest size over the stroke: (x, Δx), both m.
    #[must_use]
    pub fn largest_displacement(&self) -> (f64, f64) {
        let motion = self.curves.law.motion();
        let size = |x: f64| motion.at(x, false)[0].abs();
        let worst = extremum::largest_without_slope(size, (0.0, self.stroke()), 256, extremum::TO_ROUNDING);
        (worst.at, motion.at(worst.at, false)[0])
    }

    /// Inertia force of the bed at its largest, N.
    #[must_use]
    pub fn inertia_max(&self) -> f64 {
        self.cylinder.largest_load(&self.mechanism().balance)
    }

    /// Left side less right side of (18), N, on a way of the bed; 0 before the reversal.
    #[must_use]
    pub fn residual(&self, piece: usize, x: f64, way: Way) -> f64 {
        self.cylinder.unit_force() * self.curves.law.residual(piece, x, way)
    }

    /// Residual of largest size on a way of the bed, N, and the overrun where it is, m.
    #[must_use]
    pub fn residual_max(&self, way: Way) -> (f64, f64) {
        let worst = extremes::largest_without_slope(&self.curves, |piece, x| self.residual(piece, x, way).abs());
        (worst.value, worst.at)
    }

    /// What a plain buffer with fixed bottom and column by (7) would leave at this speed, N.
    #[must_use]
    pub fn residual_fixed_bottom(&self) -> f64 {
        self.cylinder.residual_fixed_bottom(&self.mechanism().balance)
    }

    /// Normal force of one roller on its flank on a way of the bed, N, equation (17); 0 before the reversal.
    #[must_use]
    pub fn roller_force(&self, piece: usize, x: f64, way: Way) -> f64 {
        if x <= 0.0 {
            return 0.0;
        }
        let bottom = self.curves.law.bottom(piece, x);
        0.5 * self.cylinder.unit_force()
            * self.mechanism().normal_force(self.curves.law.side(piece, x), way, x, bottom.s, bottom.ds)
    }

    /// Largest of these on either way, N.
    #[must_use]
    pub fn roller_force_max(&self) -> f64 {
        extremes::largest_without_slope(&self.curves, |piece, x| self.contact_force(piece, x)).value
    }

    /// The way on which the forces were to balance, or both.
    #[must_use]
    pub fn balanced_ways(&self) -> &'static [Way] {
        match self.mechanism().exact {
            Exact::Braking => &[Way::Braking],
            Exact::Return => &[Way::Return],
            Exact::Mean => &[Way::Braking, Way::Return],
        }
    }
}

impl Cam for Plate {
    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn rpm(&self) -> f64 {
        self.rpm
    }

    fn kind(&self) -> &'static str {
        "translating cam"
    }

    fn curves(&self) -> AnyCurves<'_> {
        Curves { law: &self.curves.law, follower: &self.curves.follower }
    }

    fn place(&self, x: f64) -> Place {
        Place::at_overrun(x)
    }

    fn parameter_at(&self, point: Vector2<f64>) -> f64 {
        point.x
    }

    fn ends_at(&self, point: Vector2<f64>) -> bool {
        point.x < self.start().x + END_WIDTH || point.x > self.run_out().x - END_WIDTH
    }

    fn mirrored(&self) -> &'static [bool] {
        &[false, true]
    }

    fn contact_force(&self, piece: usize, x: f64) -> f64 {
        let [braking, back] = [Way::Braking, Way::Return].map(|way| self.roller_force(piece, x, way));
        braking.max(back).max(0.0)
    }

    /// Along the roller's path: the air's share by the lever, preload, and the inertia of what moves with the roller,
    /// whose path is l1 ψ and whose time is that of the bed, x'' = −ω² x, at constant speed before the reversal.
    fn closing_force(&self, piece: usize, x: f64) -> Option<f64> {
        let roller = self.machine.roller;
        if roller.mass.is_none() && roller.preload.is_none() {
            return None;
        }
        let bottom = self.curves.law.bottom(piece, x);
        let (arm, sine) = (self.data.bottom_arm, bottom.s / self.data.bottom_arm);
        let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
        let first = bottom.ds / (arm * cosine);
        let second = (bottom.dds / arm + sine * first * first) / cosine;
        let omega = self.machine.bed.crank_speed(self.rpm);
        let (r, over) = (self.stroke(), x.max(0.0));
        let (speed_squared, slowing) = (omega * omega * (r - over) * (r + over), omega * omega * over);
        let inertia = roller.mass.unwrap_or(0.0) * self.data.roller_arm * (second * speed_squared - first * slowing);
        let air = if x > 0.0 { self.mechanism().air(x, bottom.s) } else { 0.0 };
        let by_air = 0.5 * self.cylinder.unit_force() * air * self.mechanism().arm_ratio * cosine;
        Some(by_air + roller.preload.unwrap_or(0.0) + inertia)
    }

    /// On the ways that were to balance. The roller moves on its arm l1, the bottom on l2; the slope is the flank's where
    /// the roller touches, dΔx/dx = C σ with tan α of the normal.
    fn unbalanced(&self, piece: usize, x: f64, moved: f64, normal: Vector2<f64>) -> f64 {
        if x <= 0.0 {
            return 0.0;
        }
        let law = self.curves.law.bottom(piece, x);
        let mechanism = self.mechanism();
        let sine = law.s / self.data.bottom_arm;
        let bottom = law.s + moved * mechanism.arm_ratio * ((1.0 - sine) * (1.0 + sine)).sqrt();
        let theta = self.data.delta + mechanism.psi(bottom);
        // Out of the lower flank the normal is (−sin α, −cos α).
        let (sin_alpha, cos_alpha) = (-normal.x, -normal.y);
        let beyond = libm::sin(theta) * cos_alpha - libm::cos(theta) * sin_alpha;
        let sigma = sin_alpha / beyond;
        let cos_psi = libm::cos(theta - self.data.delta);
        let (side, slope) = (self.curves.law.side(piece, x), mechanism.arm_ratio * cos_psi * sigma);
        let of = |way: &Way| (self.cylinder.unit_force() * mechanism.residual_on(side, x, bottom, slope, *way)).abs();
        self.balanced_ways().iter().map(of).fold(0.0, f64::max)
    }

    fn wall(&self) -> Option<f64> {
        Some(self.thinnest)
    }

    fn roller_clearance(&self) -> Option<(f64, Place)> {
        let away = |piece: usize, x: f64| self.curves.contact(piece, x).pitch.point.y;
        let nearest = extremes::largest_without_slope(&self.curves, away);
        Some((2.0 * (-nearest.value - self.data.roller_radius), Place::at_overrun(nearest.at)))
    }

    fn edges(&self) -> Vec<[Vector2<f64>; 2]> {
        let (start, run_out) = (self.start(), self.run_out());
        let end = self.curves.profile(self.curves.law.pieces().len().saturating_sub(1), self.stroke()).point;
        let mirror = |p: Vector2<f64>| Vector2::new(p.x, -p.y);
        vec![[start, mirror(start)], [run_out, mirror(run_out)], [end, run_out], [mirror(end), mirror(run_out)]]
    }

    fn remedy(&self) -> Option<String> {
        None
    }
}

#[cfg(test)]
mod tests;

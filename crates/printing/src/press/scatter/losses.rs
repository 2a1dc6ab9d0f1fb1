//! Air that does not come back as it went in, friction, play, and a train that gives way: the residual force of both ways.
//!
//! With P̂ = p/p0', pressure continuous at the dead point, and W = w + t + b/L + g (P̂ − 1) the length of the air where a train of the stiffness
//! `c_t` and the play b let the bottom stand too far, g = π U/(`c_t` L):
//!
//! ```text
//! in:   P̂ = τ (f s/W)^κ1                     r = U [M u − (1 + c_p) π (P̂ − 1)] − R0
//! back: P̂ = P̂_r ((f/f_r) W_r/W)^κ2           r = U [M u − (1 − c_p) π (P̂ − 1)] + R0,      df/dφ = −(leak/u_r)(P̂ − 1)
//! ```
//!
//! Under a linkage the air turns where the bed is decelerated most, before or after the dead point, or twice: κ1 holds while it becomes shorter, κ2
//! while it becomes longer.
//!
//! The mean of both ways is curable by cam or screw, half of their difference h, the loop, by neither.

use super::bed_path::BedPath;
use super::error::ScatterError;
use super::fault::{Fault, FrozenBuffer};
use camgen_kernel::numeric::extremum::{self, Extremum};
use camgen_kernel::numeric::root;
use std::f64::consts::PI;

/// What a press loses.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Losses {
    /// Exponent of the air on the way back.
    pub expansion_exponent: Option<f64>,
    /// Share of the air that leaks out by the dead point, to first order.
    pub leak: f64,
    /// Friction of the pistons over the force of the air.
    pub piston_friction: f64,
    /// Friction of the bed, N.
    pub bed_friction: f64,
    /// Stiffness of the train from the cam to the bottoms of both cylinders, N/m.
    pub train_stiffness: Option<f64>,
    /// Whether the cam is cut for that train.
    pub is_compensated: bool,
    /// Play of the train at the bottom, m.
    pub play: f64,
}

impl Losses {
    /// Nothing is lost.
    pub const NONE: Self = Self {
        expansion_exponent: None,
        leak: 0.0,
        piston_friction: 0.0,
        bed_friction: 0.0,
        train_stiffness: None,
        is_compensated: false,
        play: 0.0,
    };

    /// Whether anything is lost.
    #[must_use]
    pub fn is_any(&self) -> bool {
        *self != Self::NONE
    }
}

/// Steps of Runge and Kutta in a quarter of a turn: an error of 1e-13.
const STEPS: u32 = 1000;
/// Cells of a quarter of a turn in which the largest force is searched.
const CELLS: u32 = 90;
/// Newton's steps end by themselves: each doubles the digits.
const NEWTON: u32 = 60;

/// The reversal of a press that loses.
#[derive(Debug, Clone)]
pub struct LossyReversal {
    cam: FrozenBuffer,
    /// The bottom is fixed, w = 1 − x/L; no cam moves it.
    fixed: bool,
    fault: Fault,
    losses: Losses,
    /// The stretches in which the air is compressed or expands, in the order of the crank.
    strokes: Vec<AirStroke>,
}

/// A stretch of the reversal in which the air is only compressed, or only expands: P̂ = P̂0 ((f/f0) W0/W)^κ.
#[derive(Debug, Clone)]
struct AirStroke {
    /// Crank angles, rad.
    range: (f64, f64),
    /// κ.
    exponent: f64,
    /// P̂0, f0 and W0: where it starts, and at the port.
    from: [f64; 3],
    /// f where the steps begin; empty without a leak.
    air: Vec<f64>,
}

impl AirStroke {
    /// Where its steps begin, and how long they are.
    fn steps(&self) -> (f64, f64) {
        (self.range.0, (self.range.1 - self.range.0) / f64::from(STEPS))
    }
}

/// A way of the bed: in, while it is braked, or back.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BedWay {
    /// The bed is braked.
    In,
    /// The bed is accelerated.
    Back,
}

impl LossyReversal {
    /// The reversal of a cam in a machine.
    ///
    /// # Errors
    /// When the air would give work, the column is used up, or the train gives way faster than the bed comes.
    pub fn new(cam: &FrozenBuffer, fault: &Fault, losses: &Losses) -> Result<Self, ScatterError> {
        Self::solve(cam, false, fault, losses)
    }

    /// The same press with fixed bottoms, their column by (7): no train gives way and nothing has play.
    ///
    /// # Errors
    /// As [`LossyReversal::new`].
    pub fn with_fixed_bottom(&self) -> Result<Self, ScatterError> {
        let losses = Losses { train_stiffness: None, is_compensated: false, play: 0.0, ..self.losses };
        let fault = Fault { phase: 0.0, lead: 0.0, column: 0.0, ..self.fault };
        Self::solve(&self.cam.with_fixed_bottom(), true, &fault, &losses)
    }

    fn solve(cam: &FrozenBuffer, fixed: bool, fault: &Fault, losses: &Losses) -> Result<Self, ScatterError> {
        cam.fits(fault)?;
        if let Some(expansion) = losses.expansion_exponent.filter(|expansion| *expansion < fault.exponent) {
            return Err(ScatterError::ExpansionBelowCompression { expansion, compression: fault.exponent });
        }
        let per_overrun = fault.square * cam.unit_force * cam.path.loading();
        if let Some(stiffness) = losses.train_stiffness.filter(|stiffness| *stiffness <= per_overrun) {
            return Err(ScatterError::TrainTooSoft { stiffness, needed: per_overrun });
        }
        let mut reversal = Self { cam: *cam, fixed, fault: *fault, losses: *losses, strokes: Vec::new() };
        // At the port the gas that is left fills the whole column.
        let (mut from, mut left) = ([fault.closing, 1.0, 1.0 + fault.column / cam.column], fault.air);
        for range in reversal.turns() {
            let compressed = reversal.undisturbed(range.1) < reversal.undisturbed(range.0);
            let exponent = if compressed { fault.exponent } else { reversal.expansion() };
            let mut stroke = AirStroke { range, exponent, from, air: Vec::new() };
            if losses.leak > 0.0 {
                stroke.air = reversal.leak_through(&stroke, left);
                left = stroke.air.last().copied().unwrap_or(left);
            }
            let pressure = reversal.pressure_of(&stroke, range.1, left);
            from = [pressure, left, reversal.length(range.1, pressure)];
            reversal.strokes.push(stroke);
        }
        Ok(reversal)
    }

    /// The crank angles between which the air only becomes shorter or longer, rad: over a fixed bottom it turns at the dead point, under a cam where
    /// the bed is decelerated most, which under a linkage is elsewhere and may be twice.
    fn turns(&self) -> Vec<(f64, f64)> {
        let path = &self.cam.path;
        let turning: Vec<f64> = match path {
            BedPath::Linkage(_) if !self.fixed => (1..2 * CELLS)
                .map(|cell| (cell - 1, cell))
                .map(|(low, high)| (self.cell_edge(low), self.cell_edge(high)))
                .filter(|(low, high)| (path.load_slope(*low) > 0.0) != (path.load_slope(*high) > 0.0))
                .filter_map(|(low, high)| root::bracketed(|at| path.load_slope(at), low, high, 0.0).ok())
                .collect(),
            _ => vec![path.dead()],
        };
        let edges: Vec<f64> = std::iter::once(0.0).chain(turning).chain([path.whole()]).collect();
        edges.windows(2).filter_map(|pair| Some((*pair.first()?, *pair.get(1)?))).collect()
    }

    /// Crank angle at which a cell of the search ends, rad.
    fn cell_edge(&self, cell: u32) -> f64 {
        self.cam.path.whole() * f64::from(cell) / f64::from(2 * CELLS)
    }

    /// The stretch of a crank angle.
    fn stroke_at(&self, angle: f64) -> Option<&AirStroke> {
        self.strokes.iter().find(|stroke| angle <= stroke.range.1).or(self.strokes.last())
    }

    /// W at a crank angle in the reversal with the ratio P̂.
    fn length(&self, angle: f64, pressure: f64) -> f64 {
        let [closed, give] = self.closed(angle);
        closed + give * (pressure - 1.0)
    }

    /// W at the ambient pressure, and g.
    fn closed(&self, angle: f64) -> [f64; 2] {
        let (cam, longer) = (&self.cam, self.fault.column / self.cam.column);
        // A cam that is cut for its train stands higher by what the train gives way at its own speed; the screw takes the play.
        let cut = self.losses.train_stiffness.filter(|_| self.losses.is_compensated);
        let (higher, play) = cut
            .map_or((0.0, self.losses.play), |stiffness| (cam.unit_force * cam.path.load_at(angle) / stiffness, 0.0));
        let shift = longer + (play - self.fault.lead - higher) / cam.column;
        let give = self
            .losses
            .train_stiffness
            .map_or(0.0, |stiffness| self.fault.ambient * cam.unit_force / (stiffness * cam.column));
        [self.undisturbed(angle) + shift, give]
    }

    /// w at a crank angle in the reversal.
    fn undisturbed(&self, angle: f64) -> f64 {
        if self.fixed {
            self.cam.station_of_fixed_bottom(angle).length
        } else {
            self.cam.length(self.cam.path.load_at(angle))
        }
    }

    /// P̂ in a stretch with the share f of the air left: (K/W)^κ, where a train gives way by Newton's steps from the ambient pressure.
    fn pressure_of(&self, stroke: &AirStroke, angle: f64, air: f64) -> f64 {
        let [closed, give] = self.closed(angle);
        let ([pressure, left, length], kappa) = (stroke.from, stroke.exponent);
        let amount = libm::exp(libm::log(pressure) / kappa) * (air / left) * length;
        if give == 0.0 {
            return libm::exp(kappa * libm::log(amount / closed));
        }
        let mut pressure = 1.0_f64;
        for _ in 0..NEWTON {
            let held = amount * libm::exp(-libm::log(pressure) / kappa);
            let step = (closed + give * (pressure - 1.0) - held) / (give + held / (kappa * pressure));
            let next = (pressure - step).max(0.5 * pressure);
            if (next - pressure).abs() <= 2.0 * f64::EPSILON * pressure {
                return next;
            }
            pressure = next;
        }
        pressure
    }

    /// κ2.
    fn expansion(&self) -> f64 {
        self.losses.expansion_exponent.unwrap_or(self.fault.exponent)
    }

    /// df/dφ.
    fn rate(&self, stroke: &AirStroke, angle: f64, air: f64) -> f64 {
        -self.losses.leak / self.cam.path.load_by_dead() * (self.pressure_of(stroke, angle, air) - 1.0)
    }

    /// f after a step of Runge and Kutta.
    fn stepped(&self, stroke: &AirStroke, angle: f64, step: f64, air: f64) -> f64 {
        let half = angle + 0.5 * step;
        let first = self.rate(stroke, angle, air);
        let second = self.rate(stroke, half, air + 0.5 * step * first);
        let third = self.rate(stroke, half, air + 0.5 * step * second);
        let fourth = self.rate(stroke, angle + step, air + step * third);
        air + step / 6.0 * (first + 2.0 * (second + third) + fourth)
    }

    /// f at the steps of a stretch.
    fn leak_through(&self, stroke: &AirStroke, from: f64) -> Vec<f64> {
        let (start, step) = stroke.steps();
        let mut all = vec![from];
        let mut air = from;
        for index in 0..STEPS {
            air = self.stepped(stroke, start + step * f64::from(index), step, air);
            all.push(air);
        }
        all
    }

    /// Crank angles of a way, rad.
    fn range(&self, way: BedWay) -> (f64, f64) {
        let path = &self.cam.path;
        if way == BedWay::In { (0.0, path.dead()) } else { (path.dead(), path.whole()) }
    }

    /// f at a crank angle.
    #[must_use]
    pub fn air(&self, angle: f64) -> f64 {
        self.stroke_at(angle).map_or(self.fault.air, |stroke| self.air_in(stroke, angle))
    }

    fn air_in(&self, stroke: &AirStroke, angle: f64) -> f64 {
        let (start, step) = stroke.steps();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a step of the list")]
        let index = (((angle - start) / step).floor().max(0.0) as usize).min(STEPS as usize);
        let Some(air) = stroke.air.get(index) else { return self.fault.air };
        #[expect(clippy::cast_precision_loss, reason = "a thousand steps")]
        let from = start + step * index as f64;
        if angle == from { *air } else { self.stepped(stroke, from, angle - from, *air) }
    }

    /// P̂ at a crank angle.
    #[must_use]
    pub fn pressure(&self, angle: f64) -> f64 {
        self.stroke_at(angle).map_or(1.0, |stroke| self.pressure_of(stroke, angle, self.air_in(stroke, angle)))
    }

    /// Residual force on a way at the crank angle of the way in that has the same overrun, N.
    #[must_use]
    pub fn residual(&self, way: BedWay, braking: f64) -> f64 {
        self.residual_at(way, if way == BedWay::In { braking } else { self.cam.path.returning(braking) })
    }

    /// Residual force at a crank angle of the way itself, N.
    fn residual_at(&self, way: BedWay, angle: f64) -> f64 {
        let sign = if way == BedWay::In { 1.0 } else { -1.0 };
        let (cam, fault, losses) = (&self.cam, &self.fault, &self.losses);
        let air = fault.ambient * (self.pressure(angle) - 1.0);
        let force =
            cam.unit_force * (fault.square * cam.path.load_at(angle) - (1.0 + sign * losses.piston_friction) * air);
        let phase = match cam.path {
            BedPath::Yoke { .. } => sign * cam.phase_force(if way == BedWay::In { angle } else { PI - angle })[0],
            BedPath::Linkage(_) => cam.phase_force(angle)[0],
        };
        force + fault.phase * phase - sign * losses.bed_friction
    }

    /// The mean of both ways, and h, N, at a crank angle of the way in.
    #[must_use]
    pub fn mean_and_half_loop(&self, braking: f64) -> [f64; 2] {
        let [on_way_in, back] = [BedWay::In, BedWay::Back].map(|way| self.residual(way, braking));
        [0.5 * (on_way_in + back), 0.5 * (back - on_way_in)]
    }

    /// The value of a force of largest size over a way by its crank angle, N, signed, and the overrun, m.
    fn largest(&self, range: (f64, f64), force: impl Fn(f64) -> f64) -> Extremum {
        let [above, below] = [1.0, -1.0].map(|sign| {
            let found = extremum::largest_without_slope(|at| sign * force(at), range, CELLS, extremum::TO_ROUNDING);
            Extremum { at: self.cam.path.overrun_at(found.at), value: sign * found.value }
        });
        if above.value.abs() >= below.value.abs() { above } else { below }
    }

    /// The residual force of a way of largest size, N, signed, and the overrun, m.
    #[must_use]
    pub fn worst(&self, way: BedWay) -> Extremum {
        match self.cam.path {
            BedPath::Yoke { .. } => self.largest(self.range(BedWay::In), |braking| self.residual(way, braking)),
            BedPath::Linkage(_) => self.largest(self.range(way), |angle| self.residual_at(way, angle)),
        }
    }

    /// The largest h, N, and the overrun, m.
    #[must_use]
    pub fn largest_half_loop(&self) -> Extremum {
        self.largest(self.range(BedWay::In), |braking| self.mean_and_half_loop(braking)[1])
    }

    /// Share of the air that is left at the end of the reversal.
    #[must_use]
    pub fn air_left(&self) -> f64 {
        if self.losses.leak > 0.0 { self.air(self.cam.path.whole()) } else { self.fault.air }
    }

    /// Work that the air loses in a reversal, J: U L ∮ (P̂ − 1)(−dw), by Simpson's rule over each stretch. Bed and cam give it.
    #[must_use]
    pub fn work_lost(&self) -> f64 {
        let cam = &self.cam;
        let lost: f64 = self.strokes.iter().map(|stroke| self.work_over(stroke)).sum();
        (self.fault.ambient * cam.unit_force * cam.column * lost).max(0.0)
    }

    /// ∫ (P̂ − 1)(−dw) over a stretch.
    fn work_over(&self, stroke: &AirStroke) -> f64 {
        let (start, step) = stroke.steps();
        let weighted = (0..=STEPS).map(|index| {
            let weight = match index {
                0 | STEPS => 1.0,
                index if index % 2 == 1 => 4.0,
                _ => 2.0,
            };
            weight * self.power_in(stroke, start + step * f64::from(index))
        });
        weighted.sum::<f64>() * step / 3.0
    }

    /// −(P̂ − 1) dw/dφ.
    fn power_in(&self, stroke: &AirStroke, angle: f64) -> f64 {
        let cam = &self.cam;
        let fall = if self.fixed { 1.0 / (cam.path.loading() * cam.column) } else { cam.fall(cam.path.load_at(angle)) };
        (self.pressure_of(stroke, angle, self.air_in(stroke, angle)) - 1.0) * fall * cam.path.load_slope(angle)
    }
}

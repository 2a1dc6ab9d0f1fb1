//! The air buffers of a press under a disc cam: the air presses the roller on, and its
//! force is to equal the inertia force of the bed.

use super::RunUp;
use crate::press::buffer::Cylinder;
use crate::press::buffer::crank_law::CrankLaw;
use crate::press::columns::{self, BalanceRow, ColumnValues};
use crate::press::motion::{AirState, Reversal, ReversalState, Transition};
use crate::press::report::{AirLaw, CylinderMeasures};
use camgen_cams::load::Load;
use camgen_cams::report::Section;
use camgen_cams::table::{LoadState, TurnAngles};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::{Jet, Motion};
use camgen_kernel::profile::Worst;
use camgen_kernel::profile::extremes::{self, JumpRange};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// The cylinders whose bottoms the cam moves.
#[derive(Debug, Clone)]
pub struct AirBuffer {
    cylinder: Cylinder,
    reversal: Arc<Reversal>,
    /// By how much the train gives way under the law over the overrun of the bed, where the bottom is raised for that.
    train_gives: f64,
}

impl AirBuffer {
    /// The cylinders and the motion of their bottom.
    #[must_use]
    pub fn new(cylinder: Cylinder, reversal: Arc<Reversal>) -> Self {
        Self { cylinder, reversal, train_gives: 0.0 }
    }

    /// With a train that gives way by this share of the overrun, for which the bottom of the motion is raised.
    #[must_use]
    pub(crate) fn on_train(self, train_gives: f64) -> Self {
        Self { train_gives, ..self }
    }

    fn bottom_law(&self) -> &CrankLaw {
        &self.reversal.law().bottom_law
    }

    /// The motion of the bottom.
    #[must_use]
    pub fn reversal(&self) -> &Arc<Reversal> {
        &self.reversal
    }

    /// The cylinders.
    #[must_use]
    pub fn cylinder(&self) -> &Cylinder {
        &self.cylinder
    }

    /// State of the press at an angle of a piece of the motion.
    #[must_use]
    pub fn state(&self, piece: usize, at: f64) -> ReversalState {
        self.reversal.state(piece, at)
    }
}

/// Inertia less air, N.
fn residual_of(cylinder: &Cylinder, law: &CrankLaw, air: AirState) -> f64 {
    residual_off(cylinder, law, air, 1.0, 1.0)
}

/// The same with the inertia times `square`, the squared ratio of the speeds, and the air times `pressure`, the ratio of the pressures.
fn residual_off(cylinder: &Cylinder, law: &CrankLaw, air: AirState, square: f64, pressure: f64) -> f64 {
    let left = law.loading() * air.deceleration * square - (air.pressure_ratio - 1.0) * pressure;
    // A bottom that is beyond the piston leaves no air.
    if left.is_nan() { f64::NEG_INFINITY } else { cylinder.unit_force() * left }
}

/// The press behind a cam at one cam angle.
#[derive(Debug, Clone, Copy)]
struct PressState {
    cylinder: Cylinder,
    law: CrankLaw,
    lever: f64,
    state: ReversalState,
}

impl LoadState for PressState {
    fn pressing(&self) -> f64 {
        self.cylinder.force(self.state.pressure_ratio) / self.lever
    }

    fn residual(&self, moved: f64) -> f64 {
        let ReversalState { reversing, crank, deceleration, displacement, .. } = self.state;
        if !reversing {
            return 0.0;
        }
        let bottom = displacement + moved / self.lever;
        let air = AirState { deceleration, pressure_ratio: self.law.pressure_ratio(crank, bottom) };
        residual_of(&self.cylinder, &self.law, air).abs()
    }

    fn columns(&self, at: &TurnAngles) -> ColumnValues {
        let ReversalState { overrun, displacement, .. } = self.state;
        let bed = columns::of_bed(Some(at.crank_deg), MILLIMETRES * overrun, MILLIMETRES * displacement);
        bed.into_iter().chain(balance_row(&self.cylinder, &self.law, &self.state).columns()).collect()
    }
}

/// The figures of the cylinders under a law that takes the bottom furthest, by `dx_max`, at the overrun `dx_max_at_x`, both m.
#[must_use]
pub(crate) fn air_law(cylinder: &Cylinder, law: &CrankLaw, dx_max_at_x: f64, dx_max: f64) -> AirLaw {
    AirLaw {
        dx_max_mm: MILLIMETRES * dx_max,
        dx_max_at_x_mm: MILLIMETRES * dx_max_at_x,
        column_length_mm: MILLIMETRES * law.column(),
        cylinders: CylinderMeasures::new(cylinder.piston_area),
        start_slope: law.start_slope(),
        velocity_jump_mm_per_rad: 0.0,
        jumps_at_end: false,
        column_closed_at_crank_deg: None,
        equation_18: None,
    }
}

/// The force balance of the cylinders under a law in a state; none outside the reversal.
#[must_use]
pub(crate) fn balance_row(cylinder: &Cylinder, law: &CrankLaw, state: &ReversalState) -> BalanceRow {
    let (inertia, fixed) = if state.reversing {
        let inertia = cylinder.unit_force() * law.loading() * state.deceleration;
        (inertia, law.air_of_fixed_bottom(state.crank))
    } else {
        (0.0, 0.0)
    };
    balance_of(cylinder, state.reversing, inertia, fixed, state.pressure_ratio)
}

/// The forces from the inertia, N, the air of a plain buffer over 2 p0 F and the pressure ratio.
#[must_use]
pub(crate) fn balance_of(cylinder: &Cylinder, reversing: bool, inertia: f64, fixed: f64, ratio: f64) -> BalanceRow {
    let air = cylinder.force(ratio);
    let residual = Some(if reversing { inertia - air } else { 0.0 });
    BalanceRow { inertia, air, air_fixed_bottom: cylinder.unit_force() * fixed, residual }
}

/// Crank angle at which a blend closes the column, degrees.
pub(crate) fn closed_at(transition: Transition) -> Option<f64> {
    match transition {
        Transition::Blend { width } => Some(-0.5 * width.to_degrees()),
        Transition::None | Transition::RunUp { .. } => None,
    }
}

impl Load for AirBuffer {
    /// The reversal of the first lobe. A blend moves the bottom before: the column then is closed from the start of the blend on, but the
    /// inertia that it is to balance begins with the reversal.
    fn acting(&self) -> Vec<JumpRange> {
        vec![(0.0, self.bottom_law().angle() / f64::from(self.reversal.law().lobes.max(1)))]
    }

    fn pressing_when(&self, piece: usize, at: f64, moved: f64) -> f64 {
        let lever = self.reversal.law().lever;
        let ratio = self.reversal.air(piece, at, moved / lever).map_or(1.0, |air| air.pressure_ratio);
        self.cylinder.force(ratio) / lever
    }

    fn added_lift(&self, piece: usize, at: f64) -> f64 {
        // What it is raised for its train is taken by that.
        let train = if self.reversal.follows_law(piece) {
            self.train_gives * self.bottom_law().bed(self.reversal.crank_in(piece, at))[0]
        } else {
            0.0
        };
        self.reversal.law().lever * (self.reversal.raise_at(piece, at) - train)
    }

    /// Inertia less air; 0 outside the reversal, at its ends what it is inside.
    fn residual(&self, piece: usize, at: f64, moved: f64) -> f64 {
        let off = moved / self.reversal.law().lever;
        self.reversal.air(piece, at, off).map_or(0.0, |air| residual_of(&self.cylinder, self.bottom_law(), air))
    }

    fn residual_as_made(&self, piece: usize, at: f64, moved: f64, square_and_load: [f64; 2]) -> f64 {
        let off = moved / self.reversal.law().lever;
        let [square, pressure] = square_and_load;
        let air = self.reversal.air(piece, at, off);
        air.map_or(0.0, |air| residual_off(&self.cylinder, self.bottom_law(), air, square, pressure))
    }

    fn largest(&self) -> f64 {
        self.cylinder.largest_load(self.bottom_law())
    }

    fn state_and_lift(&self, piece: usize, at: f64) -> Option<(Arc<dyn LoadState>, Jet)> {
        let (state, lift) = self.reversal.state_and_lift(piece, at);
        let lever = self.reversal.law().lever;
        Some((Arc::new(PressState { cylinder: self.cylinder, law: *self.bottom_law(), lever, state }), lift))
    }
}

impl AirBuffer {
    /// Overrun of the bed at any angle of the crank, rad, in strokes.
    #[must_use]
    pub fn place(&self, crank: f64) -> f64 {
        self.bottom_law().place(crank)
    }

    /// What a plain buffer with fixed bottom and column by (7) leaves at this speed, N. For a law that levels a loop of the air: in the same air, the
    /// larger of both ways.
    #[must_use]
    pub fn residual_without_cam(&self) -> f64 {
        let on_way_in = self.cylinder.residual_fixed_bottom(self.bottom_law());
        let level = self.bottom_law().of_yoke().and_then(|law| Some((law.level?, law.loading * law.stroke)));
        let back = level.map(|(air, end_load)| self.cylinder.unit_force() * air.left_by_fixed_bottom(end_load));
        back.map_or(on_way_in, |back| back.max(on_way_in))
    }

    /// In the reversal as a distance from the exact law's, whose air is L (1 + A x)^(−1/k); before it the bed runs at constant
    /// speed.
    #[must_use]
    pub fn least_air(&self) -> Option<Worst> {
        let acting = self.acting();
        let least = extremes::largest_of_motion(&*self.reversal, (&acting, 0.0), |piece, at| -self.air_left(piece, at));
        Some(Worst { value: -least.value, at: least.at, z: 0.0 })
    }

    /// Air between piston and bottom at an angle of a piece, m.
    fn air_left(&self, piece: usize, at: f64) -> f64 {
        let law = self.bottom_law();
        // The piston is farther off while the bottom rests; nearest where the dwell begins and ends.
        let dwell = self.reversal.pieces().get(piece).filter(|piece| piece.dwell);
        let state = self.state(piece, dwell.map_or(at, |dwell| dwell.start));
        if state.reversing {
            let balanced = law.air_left(state.deceleration);
            return balanced - (state.displacement - law.displacement(state.crank));
        }
        let before = match law {
            CrankLaw::Linkage(_) => state.overrun,
            CrankLaw::Yoke(law) => {
                law.stroke * if state.crank > 1.5 * PI { state.crank - TAU } else { PI - state.crank }
            }
        };
        law.column() - law.lead() - before - state.displacement
    }

    /// The lift that a run-up before the load begins adds; `None` without one.
    #[must_use]
    pub fn run_up(&self) -> Option<RunUp> {
        let law = self.bottom_law();
        let Transition::RunUp { width } = self.reversal.law().transition else { return None };
        let ends = self.reversal.ends_of_run_ups();
        let run_ups = ends.into_iter().map(|[slope, curvature]| RunUp::new(law.stroke(), width, slope, curvature));
        run_ups.reduce(|best, next| if next.travel > best.travel { next } else { best })
    }

    /// The section on its law.
    #[must_use]
    pub fn section(&self) -> Section {
        let law = self.bottom_law();
        let (jump, jumps_at_end) = self.reversal.velocity_jump();
        let (dx_max_at_x, dx_max) = law.largest_displacement();
        AirLaw {
            velocity_jump_mm_per_rad: MILLIMETRES * jump,
            jumps_at_end,
            column_closed_at_crank_deg: closed_at(self.reversal.law().transition),
            ..air_law(&self.cylinder, law, dx_max_at_x, dx_max)
        }
        .section()
    }
}

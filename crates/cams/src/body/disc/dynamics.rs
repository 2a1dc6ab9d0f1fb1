//! Torque of the shaft of a motion program, and the spin of a roller.

use super::Disc;
use crate::body::shaft_torque::{self, DynamicsFigures, ShaftTorque, TorqueOverTurn};
use crate::body::{DrawingEvidence, plane};
use crate::report::Section;
use camgen_kernel::follower::Element;
use camgen_kernel::numeric::quadrature;
use camgen_kernel::profile::Worst;
use camgen_kernel::profile::extremes::{self, stretches};
use std::f64::consts::TAU;

/// Panels of a piece over which the spin of a roller is integrated.
const SPIN_PANELS: u32 = 24;
/// Share of the mean spin below which a difference does not matter.
const SPIN_MATTERS: f64 = 1e-9;

/// Turns of a roller about its own axis for a turn of the cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spin {
    /// Over the turn.
    pub mean: f64,
    /// The quickest, and where.
    pub largest: Worst,
}

impl Disc {
    /// What the shaft does over a turn; `None` where no force is known, or the follower jams.
    #[must_use]
    pub fn shaft_torque(&self) -> Option<ShaftTorque> {
        self.pressing()?;
        let torque = |piece: usize, angle: f64| self.torque(piece, angle);
        let extremes = [self.largest_force(torque), self.largest_force(|piece, angle| -torque(piece, angle))];
        let acting = self.acting();
        let pieces = self.motion.distinct().iter().enumerate();
        let all: Vec<(usize, (f64, f64))> = pieces
            .flat_map(|(index, piece)| stretches(piece, &acting).into_iter().map(move |of| (index, of)))
            .collect();
        // The friction of a guide has kinks where a bearing changes sides.
        let has_kinks = self.program_follower.guide.is_some();
        let damped = self.program_follower.spring.is_some_and(|spring| spring.damping > 0.0);
        let gives_back = !has_kinks && !damped && self.load.is_none();
        TorqueOverTurn { torque: &torque, stretches: &all, has_kinks, gives_back }.shaft(extremes)
    }

    /// Largest force along the normal, N; `None` where none is known, or the follower jams.
    #[must_use]
    pub fn largest_contact_force(&self) -> Option<f64> {
        self.pressing()?;
        let force = self.largest_force(|piece, angle| self.normal_force(piece, angle).unwrap_or(f64::NAN)).value;
        Some(force).filter(|force| force.is_finite())
    }

    /// How a roller turns about its own axis on the cam, |C'|/r − 1 − τψ' for a turn of the cam, rolling: |C'|/r by the path of its centre, the
    /// rest by the turning of what carries it. `None` of any other follower, and of an edge.
    #[must_use]
    pub fn spin(&self) -> Option<Spin> {
        let Element::Roller { radius } = self.follower.element() else { return None };
        if radius == 0.0 {
            return None;
        }
        let curves = self.curves();
        let spin = |piece: usize, angle: f64| {
            let touch = curves.touch(piece, angle);
            touch.curve.speed / radius - touch.drive_turn
        };
        let of_piece = |(index, piece): (usize, &camgen_kernel::motion::Piece)| {
            let panels = if piece.dwell { 1 } else { SPIN_PANELS };
            quadrature::integrate(|at| spin(index, at), (piece.start, piece.end), panels)
        };
        let turns: f64 = self.motion.distinct().iter().enumerate().map(of_piece).sum();
        let mean = turns * f64::from(self.motion.lobes()) / TAU;
        Some(Spin { mean, largest: plane(extremes::largest_smooth(curves, (&[], SPIN_MATTERS * mean), spin)) })
    }

    /// The section `dynamics` of a motion program whose forces are known, with the figures that are wanted.
    pub(super) fn dynamics(&self, found: &DrawingEvidence<'_>) -> Option<Section> {
        if !self.is_of_program() {
            return None;
        }
        let wants = |keys: &[&str]| keys.iter().any(|key| found.wants(key));
        // The friction of a guide may jam the follower, which only the whole turn shows.
        let of_turn = self.program_follower.guide.is_some() || wants(&shaft_torque::OF_TURN);
        let torque = if of_turn { Some(self.shaft_torque()?) } else { None };
        self.pressing()?;
        let largest = || self.largest_force(|piece, angle| self.torque(piece, angle));
        let normal = |piece: usize, angle: f64| self.normal_force(piece, angle).unwrap_or(f64::NAN);
        let force = || {
            let least = self.largest_force(|piece, angle| -normal(piece, angle));
            [self.largest_force(normal), Worst { value: -least.value, ..least }]
        };
        let jump = wants(&shaft_torque::OF_JUMP).then(|| self.jump()).flatten();
        let figures = DynamicsFigures {
            machine: &self.machine,
            speed: self.speed,
            largest_torque: torque.map_or_else(largest, |torque| torque.largest),
            torque,
            force: wants(&shaft_torque::OF_CONTACT_FORCE).then(force),
            jump: jump.and_then(Result::ok).filter(|jump| jump.value.is_finite()),
            is_closed: self.is_closed(),
        };
        Some(figures.section())
    }
}

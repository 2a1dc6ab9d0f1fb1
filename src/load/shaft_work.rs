//! The work that the camshaft gives to the follower of a press: air, preload and inertia together.

use crate::buffer::{Cylinder, camshaft};
use crate::motion::counter_torque::{Work, WorkJet, merged};
use crate::motion::{Jet, Motion, Piece, Reversal};
use crate::numeric::quadrature;
use std::f64::consts::PI;
use std::sync::Arc;

/// Panels over which the work on a blend is integrated: its force is smooth there, and eight points are exact to degree 15.
const PANELS: u32 = 4;

/// The work of the shaft on the follower of a disc cam of a press.
#[derive(Debug, Clone)]
pub struct ShaftWork {
    reversal: Arc<Reversal>,
    cylinder: Cylinder,
    /// Force on the follower beside the air, N.
    preload: f64,
    /// Mass on the follower's path times the square of the angular speed of the cam, N/m.
    inertia: f64,
    pieces: Vec<Piece>,
    /// The piece of the motion of each piece, and the shift of its angle.
    origins: Vec<(usize, f64)>,
    /// Work of the air where the law begins, J: not 0 behind a blend.
    blended: f64,
}

impl ShaftWork {
    /// The work on a follower with this preload (N) and mass (kg) on its path, on a cam that turns at this speed (rad/s).
    #[must_use]
    pub fn new(cylinder: Cylinder, reversal: Arc<Reversal>, preload: f64, mass: f64, speed: f64) -> Self {
        let inertia = mass * speed * speed;
        let rests: Vec<bool> = (0..reversal.pieces().len())
            .map(|index| {
                let dwell = reversal.pieces().get(index).is_some_and(|piece| piece.dwell);
                dwell || (preload == 0.0 && inertia == 0.0 && !reversal.compresses(index))
            })
            .collect();
        let all = merged(reversal.pieces(), &rests);
        let pieces = all.iter().map(|(piece, ..)| *piece).collect();
        let origins = all.iter().map(|(_, index, shift)| (*index, *shift)).collect();
        let mut work = Self { reversal, cylinder, preload, inertia, pieces, origins, blended: 0.0 };
        if let Some(from) = work.reversal.law_begins().filter(|from| *from > 0.0) {
            let closed = camshaft::work(&work.reversal.law().bottom_law, &work.cylinder, from).value;
            work.blended = work.by_quadrature(from) - closed;
        }
        work
    }

    /// Work of the air from the start of the reversal to a crank angle of the blend behind it, J.
    fn by_quadrature(&self, crank: f64) -> f64 {
        let count = f64::from(self.reversal.law().lobes.max(1));
        let torque = |crank: f64| {
            let (piece, angle) = self.reversal.locate(crank / count);
            let air = self.cylinder.force(self.reversal.state(piece, angle).pressure_ratio);
            air * self.reversal.bottom(piece, angle).ds / count
        };
        quadrature::integrate(torque, (0.0, crank), PANELS)
    }

    /// Work of the air at an angle of a piece of the motion.
    fn of_air(&self, piece: usize, angle: f64) -> WorkJet {
        let count = f64::from(self.reversal.law().lobes.max(1));
        if !self.reversal.compresses(piece) {
            return WorkJet::default();
        }
        let (crank, bottom) = (self.reversal.crank_in(piece, angle), self.reversal.bottom(piece, angle));
        if self.reversal.follows_law(piece) {
            let work = camshaft::work(&self.reversal.law().bottom_law, &self.cylinder, crank);
            return WorkJet {
                energy: self.blended + work.value,
                torque: count * work.torque,
                torque_slope: count * count * work.torque_slope,
                torque_second: count * count * count * work.torque_second,
            };
        }
        // A blend about the start or the end of the reversal; before and behind it the air is at rest.
        if !(0.0..=PI).contains(&crank) {
            return WorkJet::default();
        }
        let [force, slope, second] = self.air_force(crank, bottom, count);
        WorkJet {
            energy: self.by_quadrature(crank.min(PI - crank)),
            torque: force * bottom.ds,
            torque_slope: slope * bottom.ds + force * bottom.dds,
            torque_second: second * bottom.ds + 2.0 * slope * bottom.dds + force * bottom.ddds,
        }
    }

    /// Force of the air with its first two derivatives by the cam angle, N: U (ρ − 1), ρ = (L/l)^k, l the length of the air.
    fn air_force(&self, crank: f64, bottom: Jet, count: f64) -> [f64; 3] {
        let law = &self.reversal.law().bottom_law;
        let (k, unit, r) = (law.exponent, self.cylinder.unit_force(), law.stroke);
        let (x, x1) = (r * libm::sin(crank), r * libm::cos(crank) * count);
        let ratio = law.pressure_ratio(x, bottom.s);
        let length = law.column * libm::exp(-libm::log(ratio) / k);
        // l' = −(x' + Δx'); ρ' = −k ρ l'/l.
        let (first, second) = (-(x1 + bottom.ds), count * count * x - bottom.dds);
        let share = first / length;
        let force = unit * (ratio - 1.0);
        let slope = -unit * k * ratio * share;
        [force, slope, unit * k * ratio * ((k + 1.0) * share * share - second / length)]
    }

    /// Work against preload and inertia: P s + ½ m ω² s'².
    fn of_follower(&self, piece: usize, angle: f64) -> WorkJet {
        let (p, m) = (self.preload, self.inertia);
        if p == 0.0 && m == 0.0 {
            return WorkJet::default();
        }
        let s = self.reversal.jet(piece, angle);
        let fourth = if m == 0.0 { 0.0 } else { self.reversal.fourth(piece, angle) };
        WorkJet {
            energy: p * s.s + 0.5 * m * s.ds * s.ds,
            torque: p * s.ds + m * s.ds * s.dds,
            torque_slope: p * s.dds + m * (s.dds * s.dds + s.ds * s.ddds),
            torque_second: p * s.ddds + m * (3.0 * s.dds * s.ddds + s.ds * fourth),
        }
    }
}

impl Work for ShaftWork {
    fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    fn lobes(&self) -> u32 {
        self.reversal.lobes()
    }

    fn at(&self, piece: usize, angle: f64) -> WorkJet {
        let Some((origin, shift)) = self.origins.get(piece).copied() else { return WorkJet::default() };
        let angle = angle - shift;
        self.of_air(origin, angle) + self.of_follower(origin, angle)
    }
}

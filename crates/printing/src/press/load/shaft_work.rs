//! The work that the camshaft gives to the follower of a press: air, preload and inertia together.

use crate::press::buffer::crank_law::CrankLaw;
use crate::press::buffer::{Cylinder, camshaft};
use crate::press::motion::Reversal;
use camgen_kernel::motion::counter_torque::{Work, WorkJet, merged};
use camgen_kernel::motion::{Jet, Motion, Piece};
use camgen_kernel::numeric::quadrature;
use std::sync::Arc;

/// Panels over which the work on a blend is integrated: its force is smooth there, and eight points are exact to degree 15.
const PANELS: u32 = 4;

/// The part of the reversal that a piece of the work comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Origin {
    /// The piece of the motion.
    piece: usize,
    /// By how much its angle is shifted, rad.
    shift: f64,
    /// The air acts on it.
    compressed: bool,
}

/// The pieces of a motion, a blend split where the air begins or ceases to act: there the force jumps.
fn divided(reversal: &Reversal) -> (Vec<Piece>, Vec<(usize, bool)>) {
    let (mut pieces, mut shown) = (Vec::new(), Vec::new());
    for (index, piece) in reversal.pieces().iter().enumerate() {
        let compresses = reversal.compresses(index);
        let inside = reversal.air_begins_or_ends(index).filter(|at| piece.start < *at && *at < piece.end);
        let Some(at) = inside.filter(|_| compresses) else {
            pieces.push(*piece);
            shown.push((index, compresses));
            continue;
        };
        let begins = reversal.crank_in(index, piece.start) < 0.0;
        pieces.extend([Piece { end: at, ..*piece }, Piece { start: at, ..*piece }]);
        shown.extend([(index, !begins), (index, begins)]);
    }
    (pieces, shown)
}

/// The work of the shaft on the follower of a disc cam of a press.
#[derive(Debug, Clone)]
pub struct ShaftWork {
    reversal: Arc<Reversal>,
    /// Its law.
    law: CrankLaw,
    cylinder: Cylinder,
    /// Force on the follower in addition to the air, N.
    preload: f64,
    /// Mass on the follower's path times the square of the angular speed of the cam, N/m.
    inertia: f64,
    pieces: Vec<Piece>,
    /// The origin of each piece.
    origins: Vec<Origin>,
    /// Work of the air where the law begins, J: not 0 after a blend.
    blended: f64,
}

impl ShaftWork {
    /// The work on a follower with this preload (N) and mass (kg) on its path, on a cam that turns at this speed (rad/s). `None` for a
    /// bed whose return does not mirror its outward motion, and for air with a loop: work is left over at the end of the turn.
    #[must_use]
    pub fn new(cylinder: Cylinder, reversal: Arc<Reversal>, preload: f64, mass: f64, speed: f64) -> Option<Self> {
        let law = reversal.law().bottom_law;
        if !law.is_symmetric() {
            return None;
        }
        let inertia = mass * speed * speed;
        let (divided, shown) = divided(&reversal);
        let idle = preload == 0.0 && inertia == 0.0;
        let rests: Vec<bool> =
            divided.iter().zip(&shown).map(|(piece, (_, compressed))| piece.dwell || (idle && !compressed)).collect();
        let all = merged(&divided, &rests);
        let (mut pieces, mut origins) = (Vec::with_capacity(all.len()), Vec::with_capacity(all.len()));
        for &(piece, index, shift) in &all {
            let (shown, compressed) = shown.get(index).copied().unwrap_or((0, false));
            pieces.push(piece);
            origins.push(Origin { piece: shown, shift, compressed });
        }
        let mut work = Self { reversal, law, cylinder, preload, inertia, pieces, origins, blended: 0.0 };
        if let Some(from) = work.reversal.law_begins().filter(|from| *from > 0.0) {
            let closed = camshaft::work_of(&work.law, &work.cylinder, from).value;
            work.blended = work.by_quadrature(from) - closed;
        }
        Some(work)
    }

    /// Work of the air from the start of the reversal to a crank angle of the blend after it, J.
    fn by_quadrature(&self, crank: f64) -> f64 {
        let count = f64::from(self.reversal.law().lobes.max(1));
        quadrature::integrate(
            |crank| {
                let (piece, angle) = self.reversal.locate(crank / count);
                let ratio = self.reversal.air(piece, angle, 0.0).map_or(1.0, |air| air.pressure_ratio);
                self.cylinder.force(ratio) * self.reversal.bottom(piece, angle).ds / count
            },
            (0.0, crank),
            PANELS,
        )
    }

    /// Work of the air at an angle of a piece of the motion.
    fn of_air(&self, piece: usize, angle: f64) -> WorkJet {
        let count = f64::from(self.reversal.law().lobes.max(1));
        let crank = self.reversal.crank_in(piece, angle);
        if self.reversal.follows_law(piece) {
            let work = camshaft::work_of(&self.law, &self.cylinder, crank);
            return WorkJet {
                energy: self.blended + work.value,
                torque: count * work.torque,
                torque_slope: count * count * work.torque_slope,
                torque_second: count * count * count * work.torque_second,
            };
        }
        // A blend about the start or the end of the reversal.
        let whole = self.law.angle();
        let (crank, bottom) = (crank.clamp(0.0, whole), self.reversal.bottom(piece, angle));
        let [force, slope, second] = self.air_force(crank, bottom, count);
        WorkJet {
            energy: self.by_quadrature(crank.min(whole - crank)),
            torque: force * bottom.ds,
            torque_slope: slope * bottom.ds + force * bottom.dds,
            torque_second: second * bottom.ds + 2.0 * slope * bottom.dds + force * bottom.ddds,
        }
    }

    /// Force of the air with its first two derivatives by the cam angle, N: U (ρ − 1), ρ = (L/l)^k, l the length of the air.
    fn air_force(&self, crank: f64, bottom: Jet, count: f64) -> [f64; 3] {
        let law = &self.law;
        let (k, unit) = (law.exponent(), self.cylinder.unit_force());
        let [_, x1, x2] = law.travel(crank);
        let ratio = law.pressure_ratio(crank, bottom.s);
        let length = law.column() * libm::exp(-libm::log(ratio) / k);
        // l' = −(x' + Δx'); ρ' = −k ρ l'/l.
        let (first, second) = (-(count * x1 + bottom.ds), -(count * count * x2 + bottom.dds));
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

    fn work_at(&self, piece: usize, angle: f64) -> WorkJet {
        let Some(Origin { piece, shift, compressed }) = self.origins.get(piece).copied() else {
            return WorkJet::default();
        };
        let angle = angle - shift;
        let air = if compressed { self.of_air(piece, angle) } else { WorkJet::default() };
        air + self.of_follower(piece, angle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::press::buffer::Bed;
    use crate::press::buffer::bottom_law::{BottomLaw, ColumnRule};
    use crate::press::motion::{ReversalLaw, Transition};

    /// Every kind of transition, column, number of lobes, lever and load.
    fn works() -> Vec<(String, ShaftWork)> {
        let mut works = Vec::new();
        let width = 0.35;
        for transition in [Transition::None, Transition::RunUp { width }, Transition::Blend { width }] {
            for (column, lead) in
                [(ColumnRule::Matched, 0.0), (ColumnRule::Return, 0.0), (ColumnRule::Length(0.2), 0.01)]
            {
                for (lobes, lever) in [(1, 1.0), (3, 0.7)] {
                    for (preload, mass) in [(0.0, 0.0), (1500.0, 0.0), (1500.0, 40.0)] {
                        let bed = Bed { mass: 978.2, crank_radius: 0.18, crank_turns_per_main_shaft_turn: 3.0 };
                        let cylinder = Cylinder::sized(&bed, 35.0, 1.35, 98_066.5, 2.0 * 98_066.5);
                        let bottom_law = BottomLaw::new(cylinder.loading(35.0), 1.35, 0.18, column, lead);
                        let law = ReversalLaw { bottom_law: bottom_law.into(), lever, lobes, transition };
                        // A blend does not go with a lead.
                        let Ok(reversal) = Reversal::new(law) else { continue };
                        let speed = 11.0 / f64::from(lobes);
                        let work = ShaftWork::new(cylinder, Arc::new(reversal), preload, mass, speed).expect("a yoke");
                        let name = format!("{transition:?} {column:?} {lobes} lobes, {preload} N, {mass} kg");
                        works.push((name, work));
                    }
                }
            }
        }
        works
    }

    /// Each derivative against the central difference of the one before, of fourth order in the step: h⁴/30 of a derivative five
    /// orders on, which grows with the fifth power of the lobes, and rounding over h.
    #[test]
    fn derivatives_belong_to_their_values() {
        let h = 1e-4;
        for (name, work) in works() {
            let scale = f64::from(work.lobes()).powi(5);
            for (index, piece) in work.pieces().iter().enumerate() {
                for i in 1..12 {
                    let angle = piece.start + (piece.end - piece.start) * f64::from(i) / 12.0;
                    let at = |n: f64| work.work_at(index, angle + n * h);
                    let difference = |f: fn(WorkJet) -> f64| {
                        (8.0 * (f(at(1.0)) - f(at(-1.0))) - (f(at(2.0)) - f(at(-2.0)))) / (12.0 * h)
                    };
                    let here = at(0.0);
                    for (exact, near) in [
                        (here.torque, difference(|w| w.energy)),
                        (here.torque_slope, difference(|w| w.torque)),
                        (here.torque_second, difference(|w| w.torque_slope)),
                    ] {
                        let error = (exact - near).abs();
                        assert!(error < 1e-7 * scale * (1.0 + exact.abs()), "{name} at {angle}: {exact} {near}");
                    }
                }
            }
        }
    }

    /// The pieces cover a turn, the work is the same at both sides of each joint, and what is marked as rest is constant.
    #[test]
    fn the_work_is_continuous_and_rests_where_it_says() {
        for (name, work) in works() {
            let pieces = work.pieces();
            let turn = pieces[pieces.len() - 1].end - pieces[0].start;
            assert!((turn - std::f64::consts::TAU).abs() < 1e-13, "{name}: {turn}");
            for (index, piece) in pieces.iter().enumerate() {
                let next = (index + 1) % pieces.len();
                let (before, after) = (work.work_at(index, piece.end), work.work_at(next, pieces[next].start));
                // A corner of the law without transition jumps in velocity: only its work of air is continuous.
                let smooth = work.inertia == 0.0 || !name.starts_with("None") && !name.contains("Length");
                if smooth {
                    assert!((before.energy - after.energy).abs() < 1e-9, "{name}: {before:?} {after:?}");
                }
                if piece.dwell {
                    let middle = work.work_at(index, 0.5 * (piece.start + piece.end));
                    assert_eq!((middle.torque, middle.torque_slope), (0.0, 0.0), "{name}");
                    assert!((middle.energy - before.energy).abs() < 1e-12, "{name}");
                }
            }
        }
    }
}

//! The crossing of a groove's clearance by its roller when the force changes flank.

use crate::load::Pressing;
use camgen_kernel::motion::Jet;
use std::f64::consts::TAU;

/// Steps of the estimated time, and most steps: a longer flight lasts more than a turn or hardly moves.
const STEPS: f64 = 200.0;
const MOST_STEPS: u32 = 20_000;
/// Last step / first step: the relative accuracy of the velocity.
const LAST_STEP: f64 = 1e-6;
/// Half width of the difference of the play, and angle past a step of the force, rad.
const BESIDE: f64 = 1e-6;

/// A freely moving follower: m g'' + c g' + k g = |F|, with g its distance from the flank it leaves and F the force that would hold it there.
pub(super) struct Flight<'a> {
    pub(super) pressing: Pressing,
    /// The lift of the motion at a cam angle.
    pub(super) lift: &'a dyn Fn(f64) -> Jet,
    /// The play at a cam angle in units of the lift, m or rad.
    pub(super) play: &'a dyn Fn(f64) -> f64,
}

/// The distance from the first flank in units of the lift, and its rate.
#[derive(Clone, Copy)]
struct Gap {
    lift: f64,
    rate: f64,
}

impl Gap {
    fn moved(self, slope: Self, time: f64) -> Self {
        Self { lift: self.lift + time * slope.lift, rate: self.rate + time * slope.rate }
    }
}

impl Flight<'_> {
    /// Impact velocity on the other flank, in units of the lift per second, after a change of flank at cam angle `start`; the force then has `sign`.
    /// `None` without mass or speed, or if the force reverses before the impact.
    pub(super) fn impact(&self, start: f64, sign: f64) -> Option<f64> {
        let Pressing { mass, speed, .. } = self.pressing;
        if !(mass > 0.0 && speed > 0.0) {
            return None;
        }
        let longest = TAU / speed;
        let first = self.first_order_time(start).min(longest) / STEPS;
        let (mut time, mut step) = (0.0, first);
        let mut gap = Gap { lift: 0.0, rate: 0.0 };
        for _ in 0..MOST_STEPS {
            let next = self.next(gap, (start + BESIDE + speed * time, sign), step);
            let angle = start + speed * (time + step);
            if next.lift >= (self.play)(angle) {
                if step <= LAST_STEP * first {
                    let closing = ((self.play)(angle + BESIDE) - (self.play)(angle - BESIDE)) / (2.0 * BESIDE);
                    return Some((next.rate - speed * closing).abs());
                }
                step *= 0.5;
                continue;
            }
            (gap, time) = (next, time + step);
            if gap.lift < 0.0 || time > longest {
                return None;
            }
        }
        None
    }

    /// Time to cross the play under a constant or linearly growing force, the shorter one, s.
    fn first_order_time(&self, start: f64) -> f64 {
        let lift = (self.lift)(start + BESIDE);
        let Pressing { mass, speed, .. } = self.pressing;
        let play = (self.play)(start);
        let acceleration = (self.pressing.force_at(&lift) / mass).abs();
        let rate = (self.pressing.rate_at(&lift) * speed / mass).abs();
        (2.0 * play / acceleration).sqrt().min(libm::cbrt(6.0 * play / rate))
    }

    /// The gap one step (s) later, by the fourth-order Runge-Kutta method.
    fn next(&self, gap: Gap, (angle, sign): (f64, f64), step: f64) -> Gap {
        let Pressing { mass, damping, rate, speed, .. } = self.pressing;
        let slope = |gap: Gap, later: f64| {
            let force = sign * self.pressing.force_at(&(self.lift)(angle + speed * later));
            Gap { lift: gap.rate, rate: (force - damping * gap.rate - rate * gap.lift) / mass }
        };
        let a = slope(gap, 0.0);
        let b = slope(gap.moved(a, 0.5 * step), 0.5 * step);
        let c = slope(gap.moved(b, 0.5 * step), 0.5 * step);
        let d = slope(gap.moved(c, step), step);
        gap.moved(a, step / 6.0).moved(b, step / 3.0).moved(c, step / 3.0).moved(d, step / 6.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Impact velocity of a stepped force: √(2 j F/m); of a linearly growing one: F' t²/(2 m), t = ∛(6 j m/F').
    #[test]
    fn constant_and_growing_forces_give_the_known_velocities() {
        let pressing = Pressing { mass: 2.0, speed: 10.0, ..Pressing::default() };
        let play = |_: f64| 1e-4;
        let jump = |_: f64| Jet { dds: 0.03, ..Jet::default() };
        let found = Flight { pressing, lift: &jump, play: &play }.impact(1.0, 1.0).expect("an impact");
        let due = (2.0 * 1e-4 * 0.03_f64 * 100.0).sqrt();
        assert!((found / due - 1.0).abs() < 1e-6, "{found} {due}");
        let grows = |angle: f64| Jet { dds: -0.4 * (angle - 1.0), ddds: -0.4, ..Jet::default() };
        let found = Flight { pressing, lift: &grows, play: &play }.impact(1.0, -1.0).expect("an impact");
        let jerk = 0.4 * 1000.0;
        let due = 0.5 * jerk * libm::cbrt(6.0 * 1e-4_f64 / jerk).powi(2);
        assert!((found / due - 1.0).abs() < 1e-4, "{found} {due}");
    }

    /// A force that reverses at once causes no impact.
    #[test]
    fn a_force_that_turns_back_hits_nothing() {
        let pressing = Pressing { mass: 2.0, speed: 10.0, ..Pressing::default() };
        let short = |angle: f64| Jet { dds: if angle < 1.001 { 0.03 } else { -0.03 }, ddds: 0.1, ..Jet::default() };
        assert_eq!(Flight { pressing, lift: &short, play: &|_| 1e-3 }.impact(1.0, 1.0), None);
    }
}

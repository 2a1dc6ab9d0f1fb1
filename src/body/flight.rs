//! How a roller crosses the clearance of its groove where the force changes flank.

use crate::load::Pressing;
use crate::motion::Jet;
use std::f64::consts::TAU;

/// Steps of the first estimate of the time, and most steps: a flight of that many is over a turn, or hardly a flight.
const STEPS: f64 = 200.0;
const MOST_STEPS: u32 = 20_000;
/// The last step over the first one: the velocity is known to as much.
const LAST_STEP: f64 = 1e-6;
/// Cam angle to either side by which the play is differentiated, and by which a jump of the force is passed, rad.
const BESIDE: f64 = 1e-6;

/// A follower that moves freely: m g'' + c g' + k g = |F| for its distance g from the flank that it leaves, F the force that would keep it there.
pub(super) struct Flight<'a> {
    pub(super) pressing: Pressing,
    /// The lift of the motion at a cam angle.
    pub(super) lift: &'a dyn Fn(f64) -> Jet,
    /// The play as a lift at a cam angle, m or rad.
    pub(super) play: &'a dyn Fn(f64) -> f64,
}

/// The distance from the flank that was left, as a lift, and its rate.
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
    /// The velocity, as that of a lift, with which the other flank is hit after a change of flank at a cam angle, the force having a sign after it.
    /// `None` where nothing moves, or the force turns back before.
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

    /// The time in which the play would be crossed if the force jumped and were constant, or grew evenly, s.
    fn first_order_time(&self, start: f64) -> f64 {
        let lift = (self.lift)(start + BESIDE);
        let Pressing { mass, speed, .. } = self.pressing;
        let play = (self.play)(start);
        let acceleration = (self.pressing.at(&lift) / mass).abs();
        let rate = (self.pressing.rate_at(&lift) * speed / mass).abs();
        (2.0 * play / acceleration).sqrt().min(libm::cbrt(6.0 * play / rate))
    }

    /// The gap a step (s) later, by Runge and Kutta's method of fourth order.
    fn next(&self, gap: Gap, (angle, sign): (f64, f64), step: f64) -> Gap {
        let Pressing { mass, damping, rate, speed, .. } = self.pressing;
        let slope = |gap: Gap, later: f64| {
            let force = sign * self.pressing.at(&(self.lift)(angle + speed * later));
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

    /// Under a force that jumps the play is crossed with √(2 j F/m), under one that grows evenly with F' t²/(2 m), t = ∛(6 j m/F').
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

    /// A force that turns back at once hits nothing.
    #[test]
    fn a_force_that_turns_back_hits_nothing() {
        let pressing = Pressing { mass: 2.0, speed: 10.0, ..Pressing::default() };
        let short = |angle: f64| Jet { dds: if angle < 1.001 { 0.03 } else { -0.03 }, ddds: 0.1, ..Jet::default() };
        assert_eq!(Flight { pressing, lift: &short, play: &|_| 1e-3 }.impact(1.0, 1.0), None);
    }
}

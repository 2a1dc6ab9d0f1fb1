//! Where the force on the roller of a groove changes flank.
//!
//! On the inner flank the roller turns one way and on the outer one the other: n = ±|C'|/r − the turn of what carries it, so that its spin jumps
//! by 2|C'|/r. Before it touches the other flank it crosses the clearance. The follower then moves freely: from the moment at which the force F
//! along the path is 0 the cam moves away from it with F/m, which grows as F' t, so that the play k/cos α is crossed in t = ∛(6 k m/(F' cos α)) and
//! the flank is hit with v = F' t²/(2 m). Where the force jumps to F at once, v = √(2 k F/(m cos α)).

use super::Groove;
use crate::body::{Body, Figures};
use crate::check::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::numeric::root;
use crate::profile::Worst;
use crate::report::Bound;
use std::f64::consts::TAU;

/// The check.
pub const CHECK: Check = Check {
    name: "flank_switch",
    on: CheckScope::Cam,
    unit: "1",
    about: "How often in a turn the force on the roller of a groove changes flank. There the roller crosses the clearance, hits the other flank and \
            reverses its spin.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "the changes of sign of m ω² s'' + c ω s' + k s + F0 along the path, over a turn",
        usual: "information: twice for a rise and twice for a return; none where a spring outweighs the inertia",
        change: "a preload that holds the roller on one flank, less clearance, or a law without a jump of the acceleration",
    },
};

/// Cells of a stretch in which the force changes its sign once each.
const CELLS: u32 = 64;
/// A force below this share of the largest is rounding.
const ROUNDING: f64 = 1e-9;

/// A change of flank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlankSwitch {
    /// Cam angle, rad.
    pub at: f64,
    /// Whether the roller goes to the inner flank.
    pub to_inner: bool,
    /// Turns of the roller about its own axis for a turn of the cam, before and after.
    pub spin: [f64; 2],
    /// Velocity with which it hits the other flank along its path, m/s; `None` where no mass or no speed is known.
    pub impact: Option<f64>,
}

impl Groove {
    /// The changes of flank in the order of the cam angle; `None` where no force is known.
    #[must_use]
    pub fn flank_switches(&self) -> Option<Vec<FlankSwitch>> {
        let largest = self.disc.largest_force(|piece, at| self.disc.path_force(piece, at).map_or(f64::NAN, f64::abs));
        if !(largest.value.is_finite() && largest.value > 0.0) {
            return None;
        }
        let negligible = ROUNDING * largest.value;
        // Stretches of one sign: its piece, where it starts, and the sign.
        let mut signed: Vec<(usize, f64, f64)> = Vec::new();
        for (piece, (from, to)) in self.disc.smooth_stretches() {
            let force = |at: f64| self.disc.path_force(piece, at).unwrap_or(f64::NAN);
            let inside = root::sign_changes(force, (from, to), CELLS).into_iter().filter(|at| from < *at && *at < to);
            let ends: Vec<f64> = std::iter::once(from).chain(inside).chain([to]).collect();
            for part in ends.windows(2) {
                let &[start, end] = part else { continue };
                let sign = force(0.5 * (start + end));
                if sign.abs() > negligible {
                    signed.push((piece, start, sign.signum()));
                }
            }
        }
        let before = signed.iter().cycle().skip(signed.len().saturating_sub(1));
        let changes = signed.iter().zip(before).filter(|(now, before)| now.2 != before.2);
        Some(changes.map(|((piece, at, sign), _)| self.switch((*piece, *at), *sign)).collect())
    }

    fn switch(&self, (piece, at): (usize, f64), sign: f64) -> FlankSwitch {
        let contact = self.disc.curves().contact(piece, at);
        let (radius, turn) = (self.roller_radius().unwrap_or(f64::NAN), self.carrier_turn(piece, at));
        let by_path = contact.curve.speed / radius;
        let spin = [-sign, sign].map(|side| side * by_path - turn);
        FlankSwitch { at: at.rem_euclid(TAU), to_inner: sign > 0.0, spin, impact: self.impact((piece, at)) }
    }

    /// Turn of what carries the roller for a turn of the cam.
    fn carrier_turn(&self, piece: usize, at: f64) -> f64 {
        self.disc.curves().touch(piece, at).drive_turn
    }

    fn impact(&self, (piece, at): (usize, f64)) -> Option<f64> {
        let (pressing, speed) = (self.disc.pressing()?, self.disc.shaft_speed()?);
        let (curves, clearance) = (self.disc.curves(), self.machine().cam.track.clearance);
        let contact = curves.contact(piece, at);
        let leverage = curves.follower.leverage(&contact.lift);
        // The play as a lift, m or rad, and the force and its rate as those of the lift.
        let play = clearance / (libm::cos(contact.pressure_angle) * leverage);
        let acceleration = (pressing.at(&contact.lift) / pressing.mass).abs();
        let rate = (pressing.rate_at(&contact.lift) * speed / pressing.mass).abs();
        let by_jump = (2.0 * play * acceleration).sqrt();
        let time = libm::cbrt(6.0 * play / rate);
        let by_rate = if rate > 0.0 { 0.5 * rate * time * time } else { 0.0 };
        (pressing.mass > 0.0).then(|| leverage * by_jump.max(by_rate))
    }
}

/// Measure of the changes of flank.
pub(super) fn measure(groove: &Groove, subject: &Subject<'_>) -> Measure {
    let Some(found) = groove.flank_switches() else {
        return CHECK.unknown("no force is known: give the mass of the follower and motion.rpm, or a spring");
    };
    let worst = found.iter().max_by(|a, b| a.impact.unwrap_or(0.0).total_cmp(&b.impact.unwrap_or(0.0)));
    #[expect(clippy::cast_precision_loss, reason = "a few in a turn")]
    let measure = CHECK.measure(found.len() as f64, None);
    let Some(worst) = worst else { return measure.noted("the roller runs on one flank".to_owned()) };
    let jump = worst.spin[1] - worst.spin[0];
    let hit =
        worst.impact.map_or(String::new(), |velocity| format!("; it hits the other flank with {velocity:.4} m/s"));
    let note = format!("there the spin of the roller jumps by {:.2} turns for a turn of the cam{hit}", jump.abs());
    measure.noted(note).at(subject, &Worst { value: jump, at: worst.at, z: 0.0 })
}

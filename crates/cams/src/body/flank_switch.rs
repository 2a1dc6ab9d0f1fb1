//! Where the force on the roller of a groove changes flank.
//!
//! On one flank the roller turns one way and on the other the other: n = ±|C'|/r − the turn of what carries it, so that its spin jumps
//! by 2|C'|/r. Before it touches the other flank it crosses the clearance: once the force F along the path changes sign, the follower moves freely. Its
//! distance g from the first flank follows m g'' + c g' + k g = |F| until it equals the play j/cos α (`flight`).

use super::flight::Flight;
use crate::check::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::report::{Bound, degrees};
use camgen_kernel::numeric::root;
use camgen_kernel::profile::Worst;
use camgen_kernel::text::{Length, LengthKind, Text, text};
use serde::Serialize;
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
    /// Whether the roller goes to the flank that lifts the follower, the inner one of a groove in a disc.
    pub to_lifting: bool,
    /// Turns of the roller about its own axis for a turn of the cam, before and after.
    pub spin: [f64; 2],
    /// Impact velocity on the other flank along the path, m/s; `None` without mass or speed, or if the force reverses before the impact.
    pub impact: Option<f64>,
}

/// The force on a roller between two flanks over a turn.
pub(super) struct ForceOverTurn<'a> {
    /// The force that goes with the lift, positive where it presses the roller onto the flank that lifts it.
    pub(super) force: &'a dyn Fn(usize, f64) -> f64,
    /// Its largest size.
    pub(super) largest: f64,
    /// Stretches between whose ends it is smooth, each with its piece, in the order of the cam angle.
    pub(super) stretches: &'a [(usize, (f64, f64))],
}

impl ForceOverTurn<'_> {
    /// Where it changes its sign, and whether it is positive after that; in the order of the cam angle. None where no force is known.
    pub(super) fn changes(&self) -> Option<Vec<((usize, f64), bool)>> {
        if !(self.largest.is_finite() && self.largest > 0.0) {
            return None;
        }
        let negligible = ROUNDING * self.largest;
        // Stretches of one sign: its piece, where it starts, and whether it is positive.
        let mut signed: Vec<((usize, f64), bool)> = Vec::new();
        for (piece, (from, to)) in self.stretches {
            let force = |at: f64| (self.force)(*piece, at);
            let inside = root::sign_changes(force, (*from, *to), CELLS).into_iter().filter(|at| from < at && at < to);
            let ends: Vec<f64> = std::iter::once(*from).chain(inside).chain([*to]).collect();
            for part in ends.windows(2) {
                let &[start, end] = part else { continue };
                let middle = force(0.5 * (start + end));
                if middle.abs() > negligible {
                    signed.push(((*piece, start), middle > 0.0));
                }
            }
        }
        let before = signed.iter().cycle().skip(signed.len().saturating_sub(1));
        let changes = signed.iter().zip(before).filter(|(now, before)| now.1 != before.1);
        Some(changes.map(|(now, _)| *now).collect())
    }
}

/// A roller where the force changes flank.
pub(super) struct SwitchingRoller<'a> {
    /// |C'|/r, and the turn of what carries it, for a turn of the cam.
    pub(super) by_path: f64,
    pub(super) carrier_turn: f64,
    /// Way of the roller along its path for a lift, m or m/rad.
    pub(super) leverage: f64,
    /// Its motion across the play, if a force is known.
    pub(super) flight: Option<Flight<'a>>,
}

impl SwitchingRoller<'_> {
    /// The change of flank at a cam angle.
    pub(super) fn switch(&self, at: f64, to_lifting: bool) -> FlankSwitch {
        let sign = if to_lifting { 1.0 } else { -1.0 };
        let spin = [-sign, sign].map(|side| side * self.by_path - self.carrier_turn);
        let impact = self.flight.as_ref().and_then(|flight| flight.impact(at, sign));
        let impact = impact.map(|velocity| self.leverage * velocity);
        FlankSwitch { at: at.rem_euclid(TAU), to_lifting, spin, impact }
    }
}

/// A change of flank in the report.
#[derive(Debug, Serialize)]
pub(crate) struct SwitchFigures {
    cam_deg: f64,
    to: &'static str,
    spin_before: f64,
    spin_after: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    impact_m_per_s: Option<f64>,
}

impl SwitchFigures {
    /// Of a change between flanks with these names, that which lifts first.
    pub(super) fn of(found: &FlankSwitch, [lifting, other]: [&'static str; 2]) -> Self {
        Self {
            cam_deg: degrees(found.at),
            to: if found.to_lifting { lifting } else { other },
            spin_before: found.spin[0],
            spin_after: found.spin[1],
            impact_m_per_s: found.impact,
        }
    }

    /// As a sentence.
    pub(crate) fn words(&self) -> Text {
        let hit = self.impact_m_per_s.map(|hit| text!(", hit with {}", Length::new(hit, &LengthKind::M_PER_S)));
        text!(
            "to the {} flank at {}{}",
            self.to,
            format_args!(
                "{:.3}°: spin of the roller from {:.3} to {:.3}",
                self.cam_deg, self.spin_before, self.spin_after
            ),
            hit
        )
    }
}

/// Measure of the changes of flank; `None` where no force is known.
pub(super) fn measure(found: Option<Vec<FlankSwitch>>, subject: &Subject<'_>) -> Measure {
    let Some(found) = found else {
        return CHECK.unknown("no force is known: give the mass of the follower and motion.rpm, or a spring");
    };
    let worst = found.iter().max_by(|a, b| a.impact.unwrap_or(0.0).total_cmp(&b.impact.unwrap_or(0.0)));
    #[expect(clippy::cast_precision_loss, reason = "a few in a turn")]
    let measure = CHECK.measure(found.len() as f64, None);
    let Some(worst) = worst else { return measure.noted(Text::from("the roller runs on one flank")) };
    let jump = worst.spin[1] - worst.spin[0];
    let hit = worst.impact.map(|velocity| {
        text!("; it hits the other flank with {}", Length::new(velocity, &LengthKind::M_PER_S).decimals(4))
    });
    let turns = format!("{:.2}", jump.abs());
    let note = text!("there the spin of the roller jumps by {} turns for a turn of the cam{}", turns, hit);
    measure.noted(note).at(subject, &Worst { value: jump, at: worst.at, z: 0.0 })
}

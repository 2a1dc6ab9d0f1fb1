//! What makes the motion of a press cam smooth where its velocity jumps.

use super::buffer::crank_law::CrankLaw;
use super::machine::{Press, PressCams};
use super::motion::{Reversal, ReversalLaw, Transition};
use crate::press::MachineOfPress;
use camgen_cams::machine::Machine;
use camgen_kernel::motion::jump;
use camgen_kernel::text::{KeyChange, Remedy, Text, text};

/// Width of a run-up where the file gives none, rad of crank angle, as in the embedded machines.
const RUN_UP: f64 = std::f64::consts::PI / 9.0;

/// The first change with which the motions of these laws of a press keep `limits.continuity`: each is tried.
pub(super) fn smoother(machine: &Machine, laws: impl Fn(&Press) -> Vec<CrankLaw>) -> Option<Text> {
    let (press, cams) = (machine.press().ok()?, PressCams::of(machine));
    let direct = Press { lead: 0.0, ..*press };
    let ramp = if cams.transition == Transition::None { Transition::RunUp { width: RUN_UP } } else { cams.transition };
    let (no_lead, with_ramp) = (KeyChange::new("buffer.lead", "0 mm"), KeyChange::new("transition.kind", "run-up"));
    let tried = [
        (vec![no_lead.clone()], direct, cams.transition, press.lead > 0.0),
        (vec![with_ramp.clone()], *press, ramp, cams.transition == Transition::None),
        (vec![no_lead, with_ramp], direct, ramp, press.lead > 0.0 && cams.transition == Transition::None),
    ];
    for (changes, press, transition, applies) in tried {
        if !applies {
            continue;
        }
        let mut motions = laws(&press).into_iter().map(|bottom_law| {
            Reversal::new(ReversalLaw { bottom_law, lever: cams.lever, lobes: cams.lobes, transition })
        });
        if motions.all(|motion| motion.is_ok_and(|motion| keeps_continuity(machine, &motion))) {
            return Some(text!("{} would pass", Remedy::new(changes)));
        }
    }
    None
}

fn keeps_continuity(machine: &Machine, motion: &Reversal) -> bool {
    jump::largest(motion).is_none_or(|jump| f64::from(jump.order) - 1.0 >= machine.limits.continuity)
}

//! Which length of the tool the control takes into account: by G43 and H, on SINUMERIK by D.

use super::cutting_state::{ToolLength, whole};
use super::words::{Word, at_line, of};
use crate::machine::Controller;
use camgen_kernel::refusal::Refusal;

/// The words of a program about it.
#[derive(Debug, Default)]
pub(super) struct LengthWords {
    pub(super) is: ToolLength,
    /// Whether G43 holds, and the number H, which is modal by itself.
    on: bool,
    number: Option<f64>,
}

/// The tool in the spindle before a block and after it, where the block changes it in.
pub(super) type ToolChange = Option<(Option<f64>, Option<f64>)>;

impl LengthWords {
    pub(super) fn of(control: Option<Controller>) -> Self {
        // SINUMERIK begins with the first edge of its tool.
        let first = control == Some(Controller::Sinumerik);
        Self { is: if first { ToolLength::Number(1) } else { ToolLength::Unstated }, ..Self::default() }
    }

    /// What a block says. G49 before the first move only makes sure.
    pub(super) fn block(
        &mut self,
        (line, words): (usize, &[Word]),
        control: Option<Controller>,
        (change, loaded, has_moved): (ToolChange, Option<f64>, bool),
    ) -> Result<(), Refusal> {
        if control == Some(Controller::Sinumerik) {
            // A change of the tool takes its first edge (machine data 20270, as delivered).
            let edge = of(line, words, 'D')?.or(change.map(|_| 1.0));
            self.is = edge.and_then(numbered).unwrap_or(self.is);
            return Ok(());
        }
        let number = of(line, words, 'H')?;
        self.number = number.or(self.number);
        let other = change.is_some_and(|(before, now)| before.is_some() && before != now);
        let ends = words.contains(&('G', 49.0)) || (number == Some(0.0) && !words.contains(&('G', 43.0)));
        if other || ends {
            self.on &= !ends;
            let lost = self.is != ToolLength::Unstated || (ends && has_moved);
            self.is = if lost { ToolLength::Cancelled } else { self.is };
        }
        let begins = words.contains(&('G', 43.0));
        if number.is_some() && !begins && control == Some(Controller::LinuxCnc) {
            return Err(at_line(line, "LinuxCNC stops at H without G43").remedy("write G43 in the same block"));
        }
        self.on |= begins;
        if begins || (self.on && number.is_some()) {
            let taken = match control {
                Some(Controller::LinuxCnc) => number.or(loaded),
                // Without any number it is H00, no length.
                Some(Controller::Fanuc) => self.number.or(Some(0.0)),
                _ => number,
            };
            self.is = taken.and_then(numbered).unwrap_or(self.is);
        }
        Ok(())
    }
}

fn numbered(number: f64) -> Option<ToolLength> {
    whole(number).map(|number| if number == 0 { ToolLength::Cancelled } else { ToolLength::Number(number) })
}

/// Refuses words that add the length of the tool from the wrong side or to another.
pub(super) fn of_another_kind(line: usize, words: &[Word]) -> Result<(), Refusal> {
    let found = [(44.0, "G44 takes the length of the tool away"), (43.2, "G43.2 adds the length of another tool")];
    match found.iter().find(|(code, _)| words.contains(&('G', *code))) {
        Some((_, what)) => Err(at_line(line, *what).remedy("write G43 with the number of the tool (H)")),
        None => Ok(()),
    }
}

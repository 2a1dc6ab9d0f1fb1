//! Where the force on the roller of a groove changes flank.

use super::Groove;
use crate::body::flank_switch::{FlankSwitch, ForceOverTurn, SwitchingRoller};
use crate::body::flight::Flight;
use crate::body::{Body, Figures};

impl Groove {
    /// The changes of flank in the order of the cam angle; `None` where no force is known.
    #[must_use]
    pub fn flank_switches(&self) -> Option<Vec<FlankSwitch>> {
        let force = |piece: usize, at: f64| self.disc.path_force(piece, at).unwrap_or(f64::NAN);
        let largest = self.disc.largest_force(|piece, at| force(piece, at).abs()).value;
        let changes = ForceOverTurn { force: &force, largest, stretches: &self.disc.smooth_stretches() }.changes()?;
        Some(changes.into_iter().map(|(at, to_lifting)| self.switch(at, to_lifting)).collect())
    }

    fn switch(&self, (piece, at): (usize, f64), to_lifting: bool) -> FlankSwitch {
        let curves = self.disc.curves();
        let contact = curves.contact(piece, at);
        let lift = |angle: f64| {
            let (piece, inside) = curves.motion.locate(angle);
            curves.motion.jet(piece, inside)
        };
        let play = |angle: f64| {
            let (piece, inside) = curves.motion.locate(angle);
            let contact = curves.contact(piece, inside);
            let leverage = curves.follower.leverage(&contact.lift);
            self.machine().cam.track.clearance / (libm::cos(contact.pressure_angle) * leverage)
        };
        let flight = self.disc.pressing().map(|pressing| Flight { pressing, lift: &lift, play: &play });
        let roller = SwitchingRoller {
            by_path: contact.curve.speed / self.roller_radius().unwrap_or(f64::NAN),
            carrier_turn: curves.touch(piece, at).drive_turn,
            leverage: curves.follower.leverage(&contact.lift),
            flight,
        };
        roller.switch(at, to_lifting)
    }
}

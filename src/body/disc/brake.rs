//! The disc on the shaft of a brake's frame: it holds the web tension over the whole roll.

use super::{BRAKE, Disc, DiscError};
use crate::machine::{BrakeMachine, DiscOfBrakeError};
use crate::motion::{BrakeDisc, Motion};
use crate::report::{Section, shown};
use serde_json::json;
use std::sync::Arc;

impl Disc {
    /// The disc of a brake for its motion, sized by the limits of the machine file.
    ///
    /// # Errors
    /// [`DiscError`] when it is not described, or no radius keeps the limits.
    pub fn of_brake(machine: &BrakeMachine, disc: Arc<BrakeDisc>) -> Result<Self, DiscError> {
        // The law's lift counts from its own lowest place; the closing stretch may lie lower.
        let preload = disc.law().spring_force(disc.origin().unwrap_or(0.0));
        let own = machine.of_disc(preload).ok_or(DiscOfBrakeError::None)?;
        let motion: Arc<dyn Motion> = Arc::clone(&disc) as Arc<dyn Motion>;
        Self { kind: &BRAKE, brake: Some(disc), ..Self::unsized_of(&own, motion) }.sized()
    }

    /// How the disc stands on the shaft of the frame, and its spring.
    pub(super) fn on_its_frame(&self) -> Option<Section> {
        let disc = self.brake.as_ref()?;
        let (turns, end) = (disc.holding().turns_per_frame_turn(), disc.holding().total_angle().to_degrees());
        let (rate, preload) = (1e-3 * disc.law().rate(), disc.law().preload());
        let value = json!({
            "turns_per_frame_turn": turns, "cam_end_deg": end, "spring_rate_n_per_mm": rate, "preload_n": preload,
        });
        let place = format!(
            "0\u{b0} is the full roll, {:.4}\u{b0} the roll run down; the disc turns {} times as far as the frame, {} in the drawing",
            end,
            shown(turns),
            match self.machine.cam.rotation {
                crate::machine::Rotation::Clockwise => "clockwise",
                crate::machine::Rotation::CounterClockwise => "counter-clockwise",
            }
        );
        let rest = format!("from {end:.4}° on the outline only closes: no roller gets there");
        let spring = format!("spring {} N/mm, {} N where the law's lift is 0", shown(rate), shown(preload));
        let section = Section::new("mounting", &value).with_words(vec![format!("{place}; {spring}"), rest.clone()]);
        Some(section.with_figures(vec![place, rest, spring]))
    }
}

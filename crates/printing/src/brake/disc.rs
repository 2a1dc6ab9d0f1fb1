//! The disc on the shaft of a brake's frame: it holds the web tension over the whole roll.

use super::machine::limits::BrakeLimits;
use super::{BRAKE_CAM, BrakeDisc, BrakeMachine, checks};
use camgen_cams::body::Kind;
use camgen_cams::body::disc::{Disc, Duty, Purpose};
use camgen_cams::check::{Measures, Subject};
use camgen_cams::machine::{Machine, Rotation};
use camgen_cams::pipeline::Spec;
use camgen_cams::report::{Section, shown};
use camgen_kernel::motion::Motion;
use serde_json::json;
use std::sync::Arc;

/// The disc that holds the tension of a belt brake.
pub const KIND: Kind = Kind { command: "brake-cam", noun: "disc of a belt brake", keys: BRAKE_CAM };

/// The duty of the disc: to hold the tension.
#[derive(Debug)]
struct TensionDuty {
    disc: Arc<BrakeDisc>,
    limits: BrakeLimits,
}

/// The disc that holds the tension of a belt brake, with its motion; `None` of a brake that was read without.
#[must_use]
pub fn spec(brake: &BrakeMachine, disc: Arc<BrakeDisc>) -> Option<Spec> {
    // The law's lift counts from its own lowest point; the closing stretch may lie lower.
    let preload = disc.law().spring_force(disc.origin().unwrap_or(0.0));
    let own = brake.of_disc(preload)?;
    let duty = TensionDuty { disc: Arc::clone(&disc), limits: brake.limits };
    let spec = Spec::new(brake.machine()?.clone(), move |_: &Machine| {
        let purpose = Purpose { duty: Some(Arc::new(duty)), ..Purpose::default() };
        Disc::for_purpose(&own, disc, purpose)
    });
    Some(spec.with_inputs(Vec::new()))
}

impl Duty for TensionDuty {
    fn kind(&self) -> &'static Kind {
        &KIND
    }

    /// The mounting of the disc on the shaft of the frame, and its spring.
    fn mounting(&self, machine: &Machine) -> Option<Section> {
        let disc = &self.disc;
        let (turns, end) = (disc.holding().turns_per_frame_turn(), disc.holding().total_angle().to_degrees());
        let (rate, preload) = (1e-3 * disc.law().rate(), disc.law().preload());
        let value = json!({
            "turns_per_frame_turn": turns, "cam_end_deg": end, "spring_rate_n_per_mm": rate, "preload_n": preload,
        });
        let place = format!(
            "0\u{b0} is the full roll, {:.3}\u{b0} the run-down roll; the disc turns {} times as far as the frame, {} in the drawing",
            end,
            shown(turns),
            match machine.cam.rotation {
                Rotation::Clockwise => "clockwise",
                Rotation::CounterClockwise => "counter-clockwise",
            }
        );
        let rest = format!("from {end:.3}° on the outline only closes the profile: the roller never gets there");
        let spring = format!("spring {} N/mm, {} N where the law's lift is 0", shown(rate), shown(preload));
        let section = Section::new("mounting", &value).with_words(vec![format!("{place}; {spring}"), rest.clone()]);
        Some(section.with_figures(vec![place, rest, spring]))
    }

    fn measures(&self, _: &Disc, of: &mut Measures<'_>, subject: &Subject<'_>) {
        let limit = self.limits.tension_spread;
        of.add(&checks::TENSION, |written| checks::tension_as_cut(&self.disc, limit, written, subject));
    }
}

//! The tables of a machine file that describe a press: its bed, its air buffers and its cams.

pub(crate) mod bed;
pub(crate) mod buffer;
pub(super) mod cams;
mod compensator;
mod conoid;
mod drive;
mod losses;
mod press;
mod scatter;
mod settings;
mod transition;
mod translating;

pub use cams::PressCams;
pub use compensator::CompensatorData;
pub use conoid::{ConoidData, ConoidMode, Shift};
pub use drive::{DriveData, DriveMachine};
pub(in crate::press) use press::only_under_a_yoke;
pub use press::{AirColumn, LinkageData, Press};
pub use settings::{RegimesData, SpringBodyData};
pub use translating::TranslatingData;

use super::bed_motion::{End, Linkage, StrokeEnd};
use super::buffer::Bed;
use super::motion::Transition;
use camgen_cams::domain::Added;
use camgen_cams::machine::{CamData, FollowerData, Machine, MachineParts};
use camgen_kernel::document::{Input, KeySection, NamedChoice, Reader};
use camgen_kernel::refusal::Refusal;

/// The input that [`Machine::at_end`] changes.
const END: &str = "end";

/// The tables of a press.
pub(super) const SECTIONS: &[Added<&KeySection>] = &[
    Added { after: "", entries: &[&bed::SECTION, &buffer::SECTION, &buffer::DESIGN] },
    Added { after: "cam", entries: &[&cams::CAM] },
    Added {
        after: "cam.keyway",
        entries: &[
            &transition::SECTION,
            &translating::SECTION,
            &conoid::SECTION,
            &compensator::SECTION,
            &settings::REGIMES_SECTION,
            &settings::SPRING_SECTION,
            &settings::SPRING_BODY_SECTION,
            &scatter::SECTION,
            &drive::SECTION,
        ],
    },
    Added { after: "limits", entries: &[&cams::LIMITS] },
    Added { after: "follower.roller", entries: &[&cams::ROLLER] },
];

/// Where the forces of the plate of a machine balance: as its file says, else while the bed is braked.
#[must_use]
pub fn exact_on(machine: &Machine) -> super::motion::equation_18::ExactOn {
    let of_file = PressCams::of(machine).translating.as_ref().and_then(|plate| plate.balance);
    of_file.unwrap_or(super::motion::equation_18::ExactOn::Braking)
}

/// Reads what a file says of a press and its cams.
pub(super) fn read(
    reader: &Reader<'_>,
    (_, follower): (Option<&CamData>, Option<&FollowerData>),
    parts: &mut MachineParts,
) {
    if let Some(press) = buffer::read(reader, bed::read(reader)) {
        let press = Press { compensated_train: cams::compensated_train(reader), ..press };
        parts.set(press);
    }
    let roller = follower.and_then(|follower| follower.roller.map(|roller| roller.radius));
    // Without a follower there is no machine, and a plate without a roller would be a fault that follows from that.
    if follower.is_some()
        && let Some(cams) = cams::read(reader, roller)
    {
        parts.set(cams);
    }
}

/// What a machine file says of a press: methods of the [`Machine`].
pub trait MachineOfPress: Sized {
    /// The press.
    ///
    /// # Errors
    /// [`Refusal`] when the machine file describes none, or one whose linkage no buffer can balance.
    fn press(&self) -> Result<&Press, Refusal>;

    /// The end of the stroke at which its buffers are, and the driving crank where the reversal starts there, rad from the line of the
    /// slider; `None` under a yoke.
    #[must_use]
    fn stroke_end(&self) -> Option<(StrokeEnd, f64)>;

    /// The end of the stroke at which its buffers are, where a linkage distinguishes them.
    #[must_use]
    fn end(&self) -> Option<End>;

    /// The machine with its buffers at an end of the stroke of its linkage, the outer one unless another is chosen.
    ///
    /// # Errors
    /// [`Refusal`] when there is no linkage, or its ends cannot have buffers.
    fn at_end(self, end: End) -> Result<Self, Refusal>;

    /// The bed of the press, whatever moves it.
    #[must_use]
    fn bed(&self) -> Option<&Bed>;

    /// Design speed of the press, rpm, whatever moves its bed.
    #[must_use]
    fn design_rpm(&self) -> Option<f64>;

    /// The transition between dwell and reversal.
    #[must_use]
    fn transition(&self) -> Transition;

    /// The compensating cam, when it is described.
    #[must_use]
    fn compensator(&self) -> Option<&CompensatorData>;
}

impl MachineOfPress for Machine {
    fn press(&self) -> Result<&Press, Refusal> {
        let press = self.part::<Press>().ok_or_else(|| {
            Refusal::new("the machine file describes no press")
                .remedy("add the tables [bed], [buffer] and [design], or use `camgen make`")
        })?;
        let moved = press.linkage.is_some_and(|data| data.linkage != Linkage::Yoke);
        if moved && press.stroke_end.is_none() {
            return Err(Refusal::new(
                "the acceleration of the bed changes its sign more than twice in a turn of this linkage, and no \
                 buffer at an end of \
                 the stroke can balance it",
            )
            .remedy(
                "check `reversals` of `camgen linkage` shows where; a longer rod (linkage.rod_ratio) or a shorter base \
                 (linkage.base_ratio) makes the motion simpler",
            ));
        }
        Ok(press)
    }

    fn stroke_end(&self) -> Option<(StrokeEnd, f64)> {
        let press = self.part::<Press>()?;
        let (end, data) = (press.stroke_end?, press.linkage?);
        Some((end, data.to_line(end.start())))
    }

    fn end(&self) -> Option<End> {
        Some(self.part::<Press>()?.stroke_end?.end())
    }

    fn at_end(self, end: End) -> Result<Self, Refusal> {
        let data = self.part::<Press>().and_then(|press| press.linkage);
        let data = data.filter(|data| data.linkage != Linkage::Yoke).ok_or_else(|| {
            Refusal::new("--end chooses between the ends of the stroke of a linkage, and this machine has no linkage")
                .remedy("leave --end out: under a yoke both ends are alike")
        })?;
        let press = self.press()?;
        let press = Press { stroke_end: data.stroke_end(&press.bed, end), ..*press };
        Ok(self.with_part(Some(press)).with_input(Input::word(END, end.word())))
    }

    fn bed(&self) -> Option<&Bed> {
        self.part::<Press>().map(|press| &press.bed)
    }

    fn design_rpm(&self) -> Option<f64> {
        self.part::<Press>().map(|press| press.design_rpm)
    }

    fn transition(&self) -> Transition {
        PressCams::of(self).transition
    }

    fn compensator(&self) -> Option<&CompensatorData> {
        self.part::<PressCams>()?.compensator.as_ref()
    }
}

//! The sections of a conoid under load, each at its own speed.

use super::{Conoid, SectionCut};
use crate::press::load::AirBuffer;
use camgen_cams::body::loaded::{LoadedFollower, PressedFollower, ShaftCompliance};
use camgen_cams::body::plane;
use camgen_cams::table::turned;
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::{Worst, extremes};
use std::sync::Arc;

impl Conoid {
    /// A value by `found` of a section's follower, from the cam angle and the follower there.
    fn pressed<T>(
        &self,
        cut: SectionCut<'_>,
        shaft: &ShaftCompliance,
        found: impl FnOnce(&dyn Motion, &dyn Fn(usize, f64) -> LoadedFollower) -> T,
    ) -> T {
        let SectionCut { rpm, z, section } = cut;
        let slice = self.slice(z);
        let curves = self.plane_of(&slice);
        let load = AirBuffer::new(self.cylinder, Arc::new(section.clone()));
        let pressed = PressedFollower { curves, load: Some(&load), spring_rate: self.machine.follower.spring_rate };
        found(curves.motion, &|piece, angle| {
            pressed.loaded_follower((piece, angle), self.path_force(section, rpm, piece, angle), shaft)
        })
    }

    /// The largest of what is lowered on a section, and where.
    #[must_use]
    pub fn largest_loaded(
        &self,
        cut: SectionCut<'_>,
        shaft: &ShaftCompliance,
        value: impl Fn(&LoadedFollower) -> f64,
    ) -> (Worst, LoadedFollower) {
        self.pressed(cut, shaft, |motion, at| {
            let acting = self.acting();
            let worst = extremes::largest_of_motion(motion, (&acting, 0.0), |piece, angle| value(&at(piece, angle)));
            let worst = plane(worst);
            let (piece, angle) = motion.locate(worst.at);
            (worst, at(piece, angle))
        })
    }

    /// Cam angle, degrees, and the follower on a section, at equal steps of a turn.
    #[must_use]
    pub fn rows_lowered(
        &self,
        cut: SectionCut<'_>,
        shaft: &ShaftCompliance,
        samples: u32,
    ) -> Vec<(f64, LoadedFollower)> {
        self.pressed(cut, shaft, |motion, at| {
            let places = (0..samples).map(|index| turned(index, samples, motion.lobes()));
            places
                .map(|place| {
                    let (piece, angle) = motion.locate(place.angle);
                    (place.cam_deg, at(piece, angle))
                })
                .collect()
        })
    }
}

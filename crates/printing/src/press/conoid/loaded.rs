//! The sections of a conoid under load, each at its own speed.

use super::Conoid;
use crate::press::load::AirBuffer;
use crate::press::motion::Reversal;
use camgen_cams::body::loaded::{LoadedFollower, PressedFollower, ShaftCompliance};
use camgen_cams::body::plane;
use camgen_cams::table::turned;
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::{Worst, extremes};
use std::sync::Arc;

impl Conoid {
    /// What `found` makes of a section's follower: its place of the turn and the follower there.
    fn pressed<T>(
        &self,
        (rpm, z, section): (f64, f64, &Reversal),
        shaft: &ShaftCompliance,
        found: impl FnOnce(&dyn Motion, &dyn Fn(usize, f64) -> LoadedFollower) -> T,
    ) -> T {
        let slice = self.slice(z);
        let curves = self.plane_of(&slice);
        let load = AirBuffer::new(self.cylinder, Arc::new(section.clone()));
        let pressed = PressedFollower { curves, load: Some(&load), spring_rate: self.machine.follower.spring_rate };
        let at = |piece: usize, angle: f64| {
            pressed.loaded_follower((piece, angle), self.path_force(section, rpm, piece, angle), shaft)
        };
        found(curves.motion, &at)
    }

    /// The largest of what is lowered on a section, and where.
    #[must_use]
    pub fn largest_loaded(
        &self,
        cut: (f64, f64, &Reversal),
        shaft: &ShaftCompliance,
        of: impl Fn(&LoadedFollower) -> f64,
    ) -> (Worst, LoadedFollower) {
        self.pressed(cut, shaft, |motion, at| {
            let value = |piece: usize, angle: f64| of(&at(piece, angle));
            let worst = plane(extremes::largest_of_motion(motion, (&self.acting(), 0.0), value));
            let (piece, angle) = motion.locate(worst.at);
            (worst, at(piece, angle))
        })
    }

    /// Cam angle, degrees, and the follower on a section, at equal steps of a turn.
    #[must_use]
    pub fn rows_lowered(
        &self,
        cut: (f64, f64, &Reversal),
        shaft: &ShaftCompliance,
        samples: u32,
    ) -> Vec<(f64, LoadedFollower)> {
        self.pressed(cut, shaft, |motion, at| {
            let row = |index: u32| {
                let place = turned(index, samples, motion.lobes());
                let (piece, angle) = motion.locate(place.angle);
                (place.cam_deg, at(piece, angle))
            };
            (0..samples).map(row).collect()
        })
    }
}

//! The bearing of the roller of a disc.

use super::{Disc, Hold};
use crate::body::roller_bearing::{self, RollerBearing, RollerDuty, RollingOverTurn};
use crate::check::{Measures, Subject};
use crate::report::Section;
use camgen_kernel::numeric::root;
use camgen_kernel::profile::Worst;
use camgen_kernel::profile::extremes::stretches;

/// Cells of a stretch in which a force changes its sign once each.
const CELLS: u32 = 128;
/// A force below this share of the largest presses nothing on; between two flanks the roller crosses the play where the force changes sides.
const PRESSED: f64 = 1e-6;
const PRESSED_BETWEEN: f64 = 0.01;

impl Disc {
    /// Force along the normal with its sign, N, and turns of the roller for a turn of the cam on the flank on which the force holds it.
    fn load_and_turns(&self, piece: usize, at: f64) -> Option<(f64, f64)> {
        let curves = self.curves();
        let contact = curves.contact(piece, at);
        let signed = self.signed_normal_force((piece, at), &contact)?;
        let side = if self.hold == Hold::Flanks && signed < 0.0 { -1.0 } else { 1.0 };
        let touch = curves.touch(piece, at);
        Some((signed, side * touch.curve.speed / curves.offset() - touch.drive_turn))
    }

    /// The stretches of a turn on which force and spin are smooth.
    fn smooth_loads(&self) -> Vec<(usize, (f64, f64))> {
        let acting = self.acting();
        let pieces = self.motion.distinct().iter().enumerate();
        let all = pieces.flat_map(|(index, piece)| stretches(piece, &acting).into_iter().map(move |of| (index, of)));
        let cut = |(piece, (from, to)): (usize, (f64, f64))| {
            let force = |at: f64| self.load_and_turns(piece, at).map_or(f64::NAN, |(force, _)| force);
            let inside = root::sign_changes(force, (from, to), CELLS).into_iter().filter(|at| from < *at && *at < to);
            let ends: Vec<f64> = std::iter::once(from).chain(inside).chain([to]).collect();
            let parts: Vec<_> =
                ends.iter().copied().zip(ends.iter().copied().skip(1)).map(|part| (piece, part)).collect();
            parts
        };
        all.flat_map(cut).collect()
    }

    /// What the bearing of its roller goes through in a turn; `None` where no bearing or no force is given, or the follower jams.
    #[must_use]
    pub fn roller_duty(&self) -> Option<RollerDuty> {
        let bearing = self.machine.bearing()?;
        self.pressing()?;
        self.curves().roller_radius()?;
        let turns = |piece, at| self.load_and_turns(piece, at).map_or(f64::NAN, |(_, n)| n);
        let rolling = RollingOverTurn {
            bearing,
            rpm: self.rpm,
            stretches: &self.smooth_loads(),
            passing: &|piece, at| vec![(self.normal_force(piece, at).unwrap_or(f64::NAN), turns(piece, at))],
            largest_load: self.largest_contact_force()?,
            fastest: self.largest_force(|piece, at| turns(piece, at).abs()),
            share: 1.0,
        };
        Some(rolling.duty())
    }

    /// The largest share of the friction that the roller needs to follow the cam, and where; `None` where the inertia of its rim, the speed or a force
    /// is not given.
    #[must_use]
    pub fn roller_slip(&self) -> Option<Worst> {
        let (bearing, speed) = (self.machine.bearing()?, self.speed?);
        let (inertia, radius, curves) = (bearing.inertia?, self.curves().roller_radius()?, self.curves());
        let least = if self.hold == Hold::Flanks { PRESSED_BETWEEN } else { PRESSED };
        let pressed = least * self.largest_contact_force()?;
        let share = |piece: usize, at: f64| {
            let lift = curves.motion.jet(piece, at);
            let Some(([speed_slope, turn_slope], (force, _))) =
                curves.follower.speed_slopes(&lift).zip(self.load_and_turns(piece, at))
            else {
                return f64::NAN;
            };
            let side = if self.hold == Hold::Flanks && force < 0.0 { -1.0 } else { 1.0 };
            let slope = (side * speed_slope / curves.offset() - turn_slope).abs();
            let force = self.normal_force(piece, at).unwrap_or(f64::NAN);
            if force <= pressed { 0.0 } else { inertia * speed * speed * slope / (bearing.friction * force * radius) }
        };
        Some(self.largest_force(share))
    }

    /// Takes what its bearing shows, where the file gives one.
    fn with_bearing<T>(&self, take: impl FnOnce(&RollerBearing<'_>) -> T) -> Option<T> {
        let (duty, slip) = (|| self.roller_duty(), || self.roller_slip());
        let bearing = self.machine.bearing()?;
        Some(take(&RollerBearing { machine: &self.machine, bearing, rpm: self.rpm, duty: &duty, slip: &slip }))
    }

    /// The measures of the bearing of its roller.
    pub(super) fn measured_in_bearing(&self, of: &mut Measures<'_>, subject: &Subject<'_>) {
        self.with_bearing(|bearing| bearing.measured(of, subject));
    }

    /// The section `roller_bearing` where the file gives one.
    pub(super) fn bearing_section(&self) -> Option<Section> {
        self.with_bearing(roller_bearing::section)?
    }
}

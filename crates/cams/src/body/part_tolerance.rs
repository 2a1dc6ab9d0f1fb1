//! The zone in which a manufactured profile must lie: one figure for the drawing, the list for measuring machines and measured cams.

use super::{Body, largest};
use camgen_kernel::geometry::MILLIMETRES;

/// Width of the zone that is customary for a milled profile, m: about IT7 of 100 mm (0.035 mm, ISO 286-1), to which machining centres mill.
const CUSTOMARY: f64 = 0.04e-3;

/// The zone of a profile, ISO 1101.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartTolerance {
    /// Its width, m: half of it on either side of the drawn profile.
    pub width: f64,
    /// What it is proposed from; `None` where the file gives it.
    pub proposed_from: Option<&'static str>,
}

impl PartTolerance {
    /// That of a body: as given, else what the lift may be off, no wider than is customary.
    #[must_use]
    pub fn of(body: &dyn Body) -> Self {
        let machine = body.machine();
        if let Some(width) = machine.title.profile_tolerance {
            return Self { width, proposed_from: None };
        }
        let customary = Self { width: CUSTOMARY, proposed_from: Some("customary for a milled profile") };
        let of_lift = machine.title.lift_tolerance.map(|lift| (lift, "title.lift_tolerance"));
        let Some((along_path, from)) = of_lift.or_else(|| body.permitted_path_error()) else { return customary };
        let width = rounded_down(2.0 * along_path * libm::cos(steepest(body)));
        if width > 0.0 && width < customary.width { Self { width, proposed_from: Some(from) } } else { customary }
    }

    /// How far the profile may lie from the drawn one on either side, mm.
    #[must_use]
    pub fn half_mm(self) -> f64 {
        0.5 * MILLIMETRES * self.width
    }
}

/// The largest pressure angle of a body, rad.
fn steepest(body: &dyn Body) -> f64 {
    let of = |curves| largest(curves, |piece, at| curves.contact(piece, at).pressure_angle.abs()).value;
    body.cuts().iter().filter_map(|cut| cut.curves).map(of).fold(0.0, f64::max)
}

/// A width to two digits, no wider than it is.
fn rounded_down(width: f64) -> f64 {
    let step = libm::pow(10.0, libm::floor(libm::log10(width)) - 1.0);
    // A width of round digits must not lose its last one to rounding.
    step * (width / step + 1e-9).floor()
}

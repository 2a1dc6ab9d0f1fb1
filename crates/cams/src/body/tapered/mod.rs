//! A barrel cam with a conical roller, which rolls without sliding where its cone points at the axis of the cam, and has no play once it is pressed into
//! its groove.
//!
//! The groove, its drawing and its proof are those of a [barrel](super::barrel). What differs is stated here: the contact of a cone (`contact`), how far a point
//! is from it, the key of its half angle (`keys`), and what is refused.

mod contact;
mod keys;

use super::barrel::{Barrel, BarrelRoller, RollerPath, tried_about};
use super::swept::{FlankMiss, FlankSide, NearestRoller, SweptGeometry, SweptWords};
use super::{BodyKeys, Kind, ProgramCams};
use crate::machine::Machine;
use camgen_kernel::document::cams;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::{Jet, Motion};
use camgen_kernel::refusal::Refusal;
use contact::ConeLine;
use nalgebra::Vector3;
use std::sync::Arc;

/// The barrel of any motion with a conical roller.
pub(super) const TAPERED: Kind =
    Kind { command: cams::MAKE, noun: "barrel cam with a tapered roller", keys: "tapered-barrel" };

/// Its keys.
pub(super) const KEYS: BodyKeys = keys::KEYS;

/// Steps to the cam angle at which a cone comes nearest, halvings of one, and the last step, rad.
const STEPS: usize = 16;
const AT_REST: f64 = 1e-14;

/// A conical roller that points at the axis of the cam.
#[derive(Debug, Clone)]
pub(crate) struct TaperedRoller {
    path: RollerPath,
    /// Radius on the outside of the cam, m.
    radius: f64,
    /// Tangent of the half angle; `None` where the cone points at the axis of the cam.
    taper: Option<f64>,
}

/// Solves the barrel of a motion, at a speed of the cam (rpm) where it is known.
///
/// # Errors
/// [`Refusal`] when the roller is not carried straight along the axis, or as of any barrel.
pub(super) fn solve(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>) -> Result<ProgramCams, Refusal> {
    Ok(ProgramCams::alone(Barrel::<TaperedRoller>::of(machine, motion, rpm)?))
}

impl TaperedRoller {
    /// Tangent of the half angle in a cylinder of a radius, m.
    fn taper(&self, outer: f64) -> f64 {
        self.taper.unwrap_or(self.radius / outer)
    }
}

impl BarrelRoller for TaperedRoller {
    type Line = ConeLine;

    const KIND: &'static Kind = &TAPERED;
    const WORDS: SweptWords = SweptWords {
        noun: "barrel with a tapered roller",
        folds: "a flank folds over itself: the roller cannot follow it",
        smoother: "give a coarser --tolerance, a larger cam.outer_radius or a smoother motion",
        tables: &["-sections.csv"],
        points: "its table is -sections.csv",
        not_modelled: &[
            "Vibration, friction and the guide of the follower are not computed for a barrel.",
            "The thrust of the conical roller along its axis, on its bearing and its guide. The limit of the pressure angle is that in the plane across its axis.",
            "The ends of the roller: it is a straight cone without a rounded edge.",
            "Where the flank of a wide roller leaves the outside before the roller does: the contact counts as long as the roller reaches into the groove.",
        ],
    };

    fn of_machine(machine: &Machine, path: RollerPath) -> Result<Self, Refusal> {
        if !matches!(path, RollerPath::Straight { offset: 0.0 }) {
            let what =
                "the axis of a tapered roller must point at that of the cam, and an arm or an offset moves it beside";
            return Err(Refusal::new(what).remedy(
                "give [follower.roller] with offset = \"0 mm\", or cam.body = \"barrel\" with a cylindrical roller",
            ));
        }
        let radius = machine.follower.shape.element().offset();
        let half_angle = machine.part().and_then(|keys::HalfAngle(half_angle)| *half_angle);
        let taper = half_angle.map(libm::tan);
        let depth = machine.cam.track.groove_depth.unwrap_or(0.0);
        if let (Some(angle), Some(taper)) = (half_angle, taper)
            && taper * depth >= radius
        {
            let [radius, depth] = [radius, depth].map(|length| MILLIMETRES * length);
            let what = format!(
                "a roller of radius {radius:.3} mm and half angle {:.3} deg ends in a point above a floor {depth:.3} mm deep",
                angle.to_degrees()
            );
            return Err(Refusal::new(what).remedy("give a smaller cam.roller_half_angle, or \"auto\""));
        }
        Ok(Self { path, radius, taper })
    }

    fn line(&self, lift: &Jet, outer: f64) -> ConeLine {
        ConeLine { axis: self.path.at(lift), radius: self.radius, taper: self.taper(outer), outer }
    }

    fn path(&self) -> &RollerPath {
        &self.path
    }

    fn without_tool(&self) -> Option<&'static str> {
        Some("its flanks lean with the roller: a straight cutter does not cut them; mill them of the STEP file")
    }

    fn half_angle(&self, outer: f64) -> Option<f64> {
        Some(libm::atan(self.taper(outer)))
    }

    fn refuse_in(&self, outer: f64) -> Result<(), Refusal> {
        let half_angle = libm::atan(self.taper(outer));
        if half_angle <= keys::LARGEST {
            return Ok(());
        }
        let [radius, outer] = [self.radius, outer].map(|length| MILLIMETRES * length);
        let [half_angle, largest] = [half_angle, keys::LARGEST].map(f64::to_degrees);
        let what = format!(
            "a roller of radius {radius:.3} mm in a cylinder of radius {outer:.3} mm has a half angle of {half_angle:.3} deg, above the {largest:.0} deg beyond which it is pushed out of its groove"
        );
        Err(Refusal::new(what).remedy("give a larger cam.outer_radius or a smaller roller"))
    }

    fn miss(barrel: &Barrel<Self>, point: Vector3<f64>) -> FlankMiss {
        let groove = barrel.groove();
        let sense = groove.sense();
        let own = Vector3::new(point.x, sense * point.y, point.z) / MILLIMETRES;
        let (at, seen) = nearest_cone(barrel, own);
        let cone = barrel.line(&jet_at(barrel, at), 0);
        let flank = if seen.up > 0.0 { FlankSide::Upper } else { FlankSide::Lower };
        let (sin, cos) = libm::sincos(at);
        let (taper, slant) = (cone.taper, cone.taper.hypot(1.0));
        let [across, up] = [seen.across, seen.up].map(|part| part / (seen.away * slant));
        let along = taper / slant;
        let outward = Vector3::new(along * cos + across * sin, sense * (along * sin - across * cos), -up);
        let radius = groove.signed(flank).abs() + taper * (seen.along - cone.outer);
        FlankMiss { value: MILLIMETRES * (seen.away - radius) / slant, at: groove.motion.locate(at).1, outward }
    }
}

/// A point seen along the axis of the roller, m, with what Newton's method needs of it.
struct SeenFromCone {
    along: f64,
    across: f64,
    up: f64,
    /// Distance from the axis.
    away: f64,
    /// Of that distance less the radius of the cone, and its two derivatives by the cam angle.
    excess: [f64; 3],
}

fn jet_at(barrel: &Barrel<TaperedRoller>, angle: f64) -> Jet {
    let motion = &barrel.groove().motion;
    let (piece, inside) = motion.locate(angle);
    motion.jet(piece, inside)
}

fn see(barrel: &Barrel<TaperedRoller>, point: Vector3<f64>, angle: f64) -> SeenFromCone {
    let ConeLine { axis, taper, .. } = barrel.line(&jet_at(barrel, angle), 0);
    let (sin, cos) = libm::sincos(angle);
    let (along, across) = (point.x * cos + point.y * sin, point.y * cos - point.x * sin);
    let [height, rise, second] = axis.along;
    let up = point.z - height;
    let away = libm::hypot(across, up);
    // The point moves by −along across the roller and by across along it.
    let slope = (-across * along - up * rise) / away;
    let bend = (along * along + rise * rise - across * across - up * second - slope * slope) / away;
    SeenFromCone {
        along,
        across,
        up,
        away,
        excess: [away - taper * along, slope - taper * across, bend + taper * along],
    }
}

/// The cam angle at which the cone comes nearest to a point, m.
fn nearest_cone(barrel: &Barrel<TaperedRoller>, point: Vector3<f64>) -> (f64, SeenFromCone) {
    let longest = barrel.groove().farther() / point.xy().norm();
    let NearestRoller { at: of_axis, .. } = barrel.nearest(point);
    let (mut at, mut seen) = (of_axis, see(barrel, point, of_axis));
    // A wide cone comes nearest far from where its axis does.
    for tried in tried_about(libm::atan2(point.y, point.x), longest) {
        let found = see(barrel, point, tried);
        if found.excess[0] < seen.excess[0] {
            (at, seen) = (tried, found);
        }
    }
    for _ in 0..STEPS {
        let [excess, slope, bend] = seen.excess;
        let step = if bend > 0.0 { slope / bend } else { slope / seen.away };
        let mut by = step.clamp(-longest, longest);
        let mut next = see(barrel, point, at - by);
        // A step that does not come nearer is halved.
        for _ in 0..STEPS {
            if next.excess[0] <= excess {
                break;
            }
            by *= 0.5;
            next = see(barrel, point, at - by);
        }
        if next.excess[0] > excess {
            break;
        }
        (at, seen) = (at - by, next);
        if by.abs() <= AT_REST {
            break;
        }
    }
    (at, seen)
}

#[cfg(test)]
mod tests;

//! A barrel cam: a cylinder with a groove all round its outside, in which a roller moves along the axis, straight or on an arm.
//!
//! The axis of the roller meets that of the cam, or passes it at an offset. Both flanks follow from its motion exactly (`contact`); no unrolled curve is
//! offset. The groove is drawn three times: as the developed view of the outside, as the solid with spline flanks, and as tables for a machine with
//! four axes.

mod contact;
mod developed;
mod drawing;
mod flank;
mod implementation;
pub mod measures;
mod mechanism;
mod report;
mod sheet;
mod swept;
mod tables;
mod tool;

use super::swept::{
    FlankMiss, FlankSide, LinePoint, RollerLine, SweptGeometry, SweptGroove, SweptWords, largest, least_fold, miss,
    pressure_angles,
};
use super::{Kind, ProgramCams};
use crate::machine::Machine;
use camgen_kernel::document::cams;
use camgen_kernel::follower::{Carrier, Element};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::{Jet, Motion};
use camgen_kernel::profile::size::{first_that_keeps, rounded_up};
use camgen_kernel::profile::{Worst, lifts};
use camgen_kernel::refusal::Refusal;
use contact::FlankPoint;
pub(super) use contact::{AxisLine, BarrelLine, OffsetPoint, RollerPath};
use nalgebra::Vector3;
use std::fmt::Debug;
use std::sync::Arc;
pub(super) use swept::tried_about;

/// The barrel of any motion.
pub const BARREL: Kind = Kind { command: cams::MAKE, noun: "barrel cam", keys: cams::BARREL };

/// An outside so many times as large as that of the pressure angle is tried.
const LARGEST_GROWTH: f64 = 8.0;
/// The roller rests where the slope of the lift, over the lift itself, is below this, 1/rad.
const LEVEL: f64 = 1e-9;

/// A roller in the groove of a barrel: its form, and how it is carried.
pub(crate) trait BarrelRoller: Debug + Clone + Send + Sync + 'static {
    type Line: BarrelLine;

    const KIND: &'static Kind;
    const WORDS: SweptWords;

    /// The roller of a machine, carried so.
    ///
    /// # Errors
    /// [`Refusal`] when it cannot be carried so.
    fn of_machine(machine: &Machine, path: RollerPath) -> Result<Self, Refusal>;

    /// Its centre line at a lift, in a cylinder of a radius, m.
    fn line(&self, lift: &Jet, outer: f64) -> Self::Line;

    /// How its centre is carried.
    fn path(&self) -> &RollerPath;

    /// Why a tool on a machine with four axes does not cut its groove; `None` where one does.
    fn without_tool(&self) -> Option<&'static str> {
        None
    }

    /// Angle between its axis and its surface, rad; `None` of a cylinder.
    fn half_angle(&self, _outer: f64) -> Option<f64> {
        None
    }

    /// The refusal of a roller that does not suit a cylinder of a radius, m.
    ///
    /// # Errors
    /// [`Refusal`] with the reason.
    fn refuse_in(&self, _outer: f64) -> Result<(), Refusal> {
        Ok(())
    }

    /// How a point (mm) of a flank lies to the nearest flank.
    fn miss(barrel: &Barrel<Self>, point: Vector3<f64>) -> FlankMiss {
        miss(barrel, point)
    }
}

/// A barrel cam of a roller.
#[derive(Debug, Clone)]
pub(crate) struct Barrel<R> {
    groove: SweptGroove,
    roller: R,
    /// Radius of the outside, m.
    outer: f64,
    /// Depth of the groove, m.
    depth: f64,
    /// How far the roller reaches into it, m.
    reach: f64,
    /// Heights of the two ends, m.
    ends: (f64, f64),
}

/// Solves the barrel of a motion with a cylindrical roller, at a speed of the cam (rpm) where it is known.
///
/// # Errors
/// [`Refusal`] as [`Barrel::of`].
pub(super) fn solve(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>) -> Result<ProgramCams, Refusal> {
    Ok(ProgramCams::alone(Barrel::<RollerPath>::of(machine, motion, rpm)?))
}

impl<R: BarrelRoller> Barrel<R> {
    /// The barrel of a motion, at a speed of the cam (rpm) where it is known.
    ///
    /// # Errors
    /// [`Refusal`] when the follower does not run in a barrel, the velocity jumps, or no radius keeps the limits.
    pub(crate) fn of(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>) -> Result<Self, Refusal> {
        let track = machine.cam.track;
        let Element::Roller { radius } = machine.follower.shape.element() else { return Err(needs_a_roller()) };
        let top = lifts(&**motion).1;
        let roller = R::of_machine(machine, path_of(machine, top)?)?;
        let depth = track.groove_depth.ok_or_else(|| {
            Refusal::new("a barrel needs the depth of its groove").remedy("give cam.groove_depth, e.g. \"12 mm\"")
        })?;
        let mut found = Self {
            groove: SweptGroove::new(machine, motion, rpm, radius),
            roller,
            outer: track.outer_radius.unwrap_or(f64::NAN),
            depth,
            reach: track.barrel.roller_height.unwrap_or(depth),
            ends: (0.0, 0.0),
        };
        found.groove.refuse_jumps()?;
        if track.outer_radius.is_none() {
            found.outer = found.smallest_outer()?;
        }
        found.ends = found.blank_ends()?;
        found.refuse_what_leaves()?;
        Ok(found)
    }

    /// The smallest radius of the outside, in whole millimetres, that keeps the pressure angle at the inner end of the roller (R ≥ max s'/tan α of a
    /// straight path), the curvature of both flanks and the wall about the bore.
    fn smallest_outer(&self) -> Result<f64, Refusal> {
        let limits = &self.groove.machine.limits;
        let bore = self
            .groove
            .machine
            .cam
            .bore_reach()
            .map_or(0.0, |bore| bore + limits.least_wall(self.groove.machine.cam.bore_radius));
        let least = rounded_up(bore + self.depth.max(self.reach));
        let keeps = |outer: f64| {
            let tried = Self { outer, ..self.clone() };
            tried.roller.refuse_in(outer).is_ok() && tried.keeps_limits()
        };
        if keeps(least) {
            return Ok(least);
        }
        let steepest = largest(self, |_, line| line.axis().along[1].abs());
        let by_angle = steepest.value / libm::tan(limits.pressure_angles()[0].min(1.5)) + self.reach;
        let found = first_that_keeps(least, LARGEST_GROWTH * by_angle.max(least), keeps).map(rounded_up);
        found.ok_or_else(|| {
            Refusal::new("no outer radius of the barrel keeps the limits")
                .remedy("give a smaller roller, a longer movement or a smoother law, or another limits.pressure_angle")
        })
    }

    /// Whether the pressure angle and the curvature of both flanks keep their limits.
    fn keeps_limits(&self) -> bool {
        let limits = &self.groove.machine.limits;
        let [up, down] = limits.pressure_angles();
        let [rising, falling] = pressure_angles(self);
        let convex = self.least_radius().value >= limits.convex_radius(self.groove.roller);
        let free = least_fold(self).value > self.groove.farther() && convex;
        rising.value <= up && falling.value <= down && free
    }

    /// Heights of the ends of the blank: as long as asked, with the groove in its middle, or long enough for the wall on either side of it.
    fn blank_ends(&self) -> Result<(f64, f64), Refusal> {
        let wall = self.groove.machine.limits.least_wall(self.groove.machine.cam.bore_radius);
        let [top, bottom] = self.roller_heights();
        let [above, below] = self.groove.distances;
        let (top, bottom) = (top + above, bottom + below);
        let needed = top + bottom;
        let Some(length) = self.groove.machine.cam.track.barrel.blank_length else {
            let margin = 1e-3 * ((needed + 2.0 * wall) * MILLIMETRES - 1e-9).ceil() - needed;
            return Ok((-bottom - 0.5 * margin, top + 0.5 * margin));
        };
        if length <= needed {
            let [length, needed] = [length, needed].map(|length| MILLIMETRES * length);
            let what = format!("the blank of {length:.3} mm is not longer than the groove, which takes {needed:.3} mm");
            return Err(Refusal::new(what).remedy("give a larger cam.blank_length, or \"auto\""));
        }
        let margin = 0.5 * (length - needed);
        Ok((-bottom - margin, top + margin))
    }

    /// How far the roller's centre line goes above and below z = 0, m.
    fn roller_heights(&self) -> [f64; 2] {
        [1.0, -1.0].map(|sign| largest(self, |_, line| sign * line.axis().along[0]).value)
    }

    /// The refusal of a groove that leaves the cylinder, or whose roller misses it.
    fn refuse_what_leaves(&self) -> Result<(), Refusal> {
        self.roller.refuse_in(self.outer)?;
        let floor = self.floor();
        let deep = MILLIMETRES * self.depth;
        if !(floor > 0.0) {
            let what = format!("the groove of {deep:.3} mm reaches the axis of the barrel");
            return Err(Refusal::new(what).remedy("give a larger cam.outer_radius or a smaller cam.groove_depth"));
        }
        for (piece, at) in self.groove.places() {
            let axis = self.axis(piece, at);
            let known = |axis: &R::Line| {
                [(floor, 0, 1.0), (floor, 1, -1.0), (self.outer, 0, 1.0), (self.outer, 1, -1.0)].iter().all(
                    |(radius, flank, sign)| axis.on_cylinder(sign * self.groove.distances[*flank], *radius).is_some(),
                )
            };
            if !known(&axis) {
                let misses = known(&axis.without_offset());
                return Err(self
                    .leaves(misses.then_some(axis.axis().across[0]))
                    .at(format!("{:.3} deg", at.to_degrees())));
            }
        }
        Ok(())
    }

    /// The refusal of a roller that stands so far beside the radius, m, that it misses the floor, else of one that is too large.
    fn leaves(&self, beside: Option<f64>) -> Refusal {
        let Some(beside) = beside else {
            let what = "the flank of the groove does not reach from its floor to the outside: the roller is too large for the cylinder";
            return Refusal::new(what).remedy("give a larger cam.outer_radius or a smaller roller");
        };
        let [beside, floor] = [beside.abs(), self.floor()].map(|length| MILLIMETRES * length);
        let what = format!(
            "the roller stands {beside:.3} mm beside the axis of the barrel and misses its floor of radius {floor:.3} mm"
        );
        let straight = matches!(self.roller.path(), RollerPath::Straight { .. });
        Refusal::new(what).remedy(if straight {
            "give a smaller follower.roller.offset or a larger cam.outer_radius"
        } else {
            "give a pivot_distance near the arm, a smaller swing or a larger cam.outer_radius"
        })
    }

    /// Radius of the floor, m.
    fn floor(&self) -> f64 {
        self.outer - self.depth
    }

    /// The roller's centre line at a cam angle of a piece.
    fn axis(&self, piece: usize, angle: f64) -> R::Line {
        self.roller.line(&self.groove.motion.jet(piece, angle), self.outer)
    }

    /// A flank on the cylinder of a radius (m) at a cam angle of a piece.
    fn edge(&self, flank: FlankSide, radius: f64, (piece, angle): (usize, f64)) -> Option<FlankPoint> {
        self.axis(piece, angle).on_cylinder(self.groove.signed(flank), radius)
    }

    /// The smallest radius of curvature of the roller's path across its axis, m, anywhere along the roller: either flank is convex where it bends
    /// towards it.
    fn least_radius(&self) -> Worst {
        let sharpest = largest(self, |_, axis| {
            let bends = self.touched(axis).map(|v| path_radius(&axis.point(v)).abs().recip());
            bends.into_iter().fold(0.0, f64::max)
        });
        Worst { value: sharpest.value.recip(), ..sharpest }
    }

    /// Whether the roller rests at a place, so that both flanks are level there.
    fn is_level(&self, piece: usize, angle: f64) -> bool {
        let jet = self.groove.motion.jet(piece, angle);
        jet.ds.abs() <= LEVEL * lifts(&*self.groove.motion).1.max(1e-6)
    }
}

/// Radius of curvature of the roller's path across its axis, m, positive where the flank above is convex towards it.
fn path_radius(point: &LinePoint) -> f64 {
    point.speed / point.turn
}

fn needs_a_roller() -> Refusal {
    Refusal::new("a barrel needs a roller").remedy("give [follower.roller] or [follower.swinging-roller]")
}

/// How the follower of a machine carries its roller over a whole lift, m or rad.
fn path_of(machine: &Machine, top: f64) -> Result<RollerPath, Refusal> {
    let follower = &machine.follower;
    let place = || follower.shape.place().map(|place| place.chosen_by(&*follower.shape));
    match follower.shape.carrier() {
        Carrier::Arm { .. } => {
            let arm = follower.arm.ok_or_else(needs_a_roller)?;
            let pivot = place().filter(|_| follower.place.is_none()).ok_or_else(|| {
                Refusal::new("the pivot distance of a barrel's arm is not chosen for it")
                    .remedy("give follower.swinging-roller.pivot_distance, near the arm")
            })?;
            let side = match follower.shape.place() {
                Some(camgen_kernel::follower::FollowerPlacement::Pivot { side, .. }) => side,
                _ => 1.0,
            };
            Ok(RollerPath::Arm { arm, pivot, side, swing: top })
        }
        _ => match follower.roller {
            Some(roller) if follower.place.is_none() => Ok(RollerPath::Straight { offset: roller.offset }),
            _ => Err(Refusal::new("the offset of a barrel's roller is not chosen for it")
                .remedy("give follower.roller.offset, usually 0 mm")),
        },
    }
}

#[cfg(test)]
mod tests;

//! A barrel cam: a cylinder with a groove all round its outside, in which a roller moves along the axis, straight or on an arm.
//!
//! The axis of the roller meets that of the cam, or passes it at an offset. Both flanks follow from its motion exactly (`contact`); no unrolled curve is
//! offset. The groove is drawn three times: as the developed view of the outside, as the solid with spline flanks, and as tables for a machine with
//! four axes.

mod contact;
mod developed;
mod flank;
mod forces;
mod implementation;
pub mod measures;
mod mechanism;
mod report;
mod sheet;
mod solid;
mod swept;
mod tables;
mod tool;

use super::Kind;
use super::swept::refuse_jumps;
use crate::machine::Machine;
use camgen_kernel::document::cams;
use camgen_kernel::follower::{Carrier, Element};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::{Jet, Motion};
use camgen_kernel::numeric::extremum::{self, Extremum};
use camgen_kernel::profile::size::{first_that_keeps, rounded_up};
use camgen_kernel::profile::{Worst, lifts};
use camgen_kernel::refusal::Refusal;
use contact::{AxisLine, FlankPoint, RollerPath};
use std::sync::Arc;
pub use swept::{BarrelCurve, FlankSide};

/// The barrel of any motion.
pub const BARREL: Kind = Kind { command: cams::MAKE, noun: "barrel cam", keys: cams::BARREL };

/// An outside so many times as large as that of the pressure angle is tried.
const LARGEST_GROWTH: f64 = 8.0;
/// Cells of a piece in which figures are searched.
const CELLS: u32 = 32;
/// Golden sections to a place.
const SECTIONS: u32 = 50;
/// The roller rests where the slope of the lift, over the lift itself, is below this, 1/rad.
const LEVEL: f64 = 1e-9;

/// A barrel cam.
#[derive(Debug, Clone)]
pub struct Barrel {
    machine: Arc<Machine>,
    motion: Arc<dyn Motion>,
    path: RollerPath,
    /// Radius of the roller, m.
    roller: f64,
    /// Of the flanks above and below from the centre line of the roller, m.
    distances: [f64; 2],
    /// Radius of the outside, m.
    outer: f64,
    /// Depth of the groove, m.
    depth: f64,
    /// How far the roller reaches into it, m.
    reach: f64,
    /// Heights of the two ends, m.
    ends: (f64, f64),
    /// Speed of the cam, rpm and rad/s, where it is known.
    rpm: Option<f64>,
}

impl Barrel {
    /// The barrel of a motion, at a speed of the cam (rpm) where it is known.
    ///
    /// # Errors
    /// [`Refusal`] when the follower does not run in a barrel, the velocity jumps, or no radius keeps the limits.
    pub fn of(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>) -> Result<Self, Refusal> {
        let track = machine.cam.track;
        let Element::Roller { radius } = machine.follower.shape.element() else { return Err(needs_a_roller()) };
        let top = lifts(&**motion).1;
        let path = path_of(machine, top)?;
        let depth = track.groove_depth.ok_or_else(|| {
            Refusal::new("a barrel needs the depth of its groove").remedy("give cam.groove_depth, e.g. \"12 mm\"")
        })?;
        let inside = track.clearance * track.clearance_share;
        let mut found = Self {
            machine: Arc::new(machine.clone()),
            motion: Arc::clone(motion),
            path,
            roller: radius,
            distances: [radius + track.clearance - inside, radius + inside],
            outer: track.outer_radius.unwrap_or(f64::NAN),
            depth,
            reach: track.barrel.roller_height.unwrap_or(depth),
            ends: (0.0, 0.0),
            rpm,
        };
        refuse_jumps(&**motion)?;
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
        let limits = &self.machine.limits;
        let bore =
            self.machine.cam.bore_reach().map_or(0.0, |bore| bore + limits.least_wall(self.machine.cam.bore_radius));
        let least = rounded_up(bore + self.depth.max(self.reach));
        let keeps = |outer: f64| Self { outer, ..self.clone() }.keeps_limits();
        if keeps(least) {
            return Ok(least);
        }
        let steepest = self.largest(|jet| self.path.at(jet).along[1].abs());
        let by_angle = steepest.value / libm::tan(limits.pressure_angles()[0].min(1.5)) + self.reach;
        let found = first_that_keeps(least, LARGEST_GROWTH * by_angle.max(least), keeps).map(rounded_up);
        found.ok_or_else(|| {
            Refusal::new("no outer radius of the barrel keeps the limits")
                .remedy("give a smaller roller, a longer movement or a smoother law, or another limits.pressure_angle")
        })
    }

    /// Whether the pressure angle and the curvature of both flanks keep their limits.
    fn keeps_limits(&self) -> bool {
        let limits = &self.machine.limits;
        let [up, down] = limits.pressure_angles();
        let [rising, falling] = self.signed_pressure_angles();
        let convex = self.least_radius().value >= limits.convex_radius(self.roller);
        let free = self.least_fold().value > self.distances[0].max(self.distances[1]) && convex;
        rising.value <= up && falling.value <= down && free
    }

    /// Heights of the ends of the blank: as long as asked, with the groove in its middle, or long enough for the wall on either side of it.
    fn blank_ends(&self) -> Result<(f64, f64), Refusal> {
        let wall = self.machine.limits.least_wall(self.machine.cam.bore_radius);
        let heights = |sign: f64| self.largest(|jet| sign * self.path.at(jet).along[0]).value;
        let (top, bottom) = (heights(1.0) + self.distances[0], heights(-1.0) + self.distances[1]);
        let needed = top + bottom;
        let Some(length) = self.machine.cam.track.barrel.blank_length else {
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

    /// The refusal of a groove that leaves the cylinder, or whose roller misses it.
    fn refuse_what_leaves(&self) -> Result<(), Refusal> {
        let floor = self.floor();
        let deep = MILLIMETRES * self.depth;
        if !(floor > 0.0) {
            let what = format!("the groove of {deep:.3} mm reaches the axis of the barrel");
            return Err(Refusal::new(what).remedy("give a larger cam.outer_radius or a smaller cam.groove_depth"));
        }
        for (piece, at) in self.places() {
            let axis = self.axis(piece, at);
            let known = |axis: &AxisLine| {
                [(floor, 0, 1.0), (floor, 1, -1.0), (self.outer, 0, 1.0), (self.outer, 1, -1.0)]
                    .iter()
                    .all(|(radius, flank, sign)| axis.on_cylinder(sign * self.distances[*flank], *radius).is_some())
            };
            if !known(&axis) {
                let [_, by, second] = axis.across;
                let misses = known(&AxisLine { across: [0.0, by, second], ..axis });
                return Err(self.leaves(misses.then_some(axis.across[0])).at(format!("{:.3} deg", at.to_degrees())));
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
        let straight = matches!(self.path, RollerPath::Straight { .. });
        Refusal::new(what).remedy(if straight {
            "give a smaller follower.roller.offset or a larger cam.outer_radius"
        } else {
            "give a pivot_distance near the arm, a smaller swing or a larger cam.outer_radius"
        })
    }

    /// Places of all pieces, a few to each.
    fn places(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let of = |(index, piece): (usize, &camgen_kernel::motion::Piece)| {
            let (start, end) = (piece.start, piece.end);
            (0..=CELLS).map(move |i| (index, start + (end - start) * f64::from(i) / f64::from(CELLS)))
        };
        self.motion.pieces().iter().enumerate().flat_map(of)
    }

    /// The largest of a value of the lift.
    fn largest(&self, value: impl Fn(&Jet) -> f64) -> Worst {
        let of = |(index, piece): (usize, &camgen_kernel::motion::Piece)| {
            let at = |angle: f64| value(&self.motion.jet(index, angle));
            extremum::largest_without_slope(at, (piece.start, piece.end), CELLS, SECTIONS)
        };
        let found =
            self.motion.pieces().iter().enumerate().map(of).reduce(|a, b| if b.value > a.value { b } else { a });
        found.map_or(Worst::NONE, |Extremum { value, at, .. }| Worst { value, at, z: 0.0 })
    }

    /// Radius of the floor, m.
    fn floor(&self) -> f64 {
        self.outer - self.depth
    }

    /// Places along the roller between which it touches the flanks, m: its inner end, which stands so far below the outside as it reaches into the groove, and
    /// where it leaves the cylinder.
    fn touched(&self, axis: &AxisLine) -> [f64; 2] {
        [self.outer - self.reach, self.outer].map(|from_axis| axis.at_distance(from_axis))
    }

    /// The roller's centre line at a cam angle of a piece.
    fn axis(&self, piece: usize, angle: f64) -> AxisLine {
        self.path.at(&self.motion.jet(piece, angle))
    }

    /// Signed distance of a flank from the centre line, m: positive above.
    fn signed(&self, flank: FlankSide) -> f64 {
        match flank {
            FlankSide::Upper => self.distances[0],
            FlankSide::Lower => -self.distances[1],
        }
    }

    /// A flank on the cylinder of a radius (m) at a cam angle of a piece.
    fn edge(&self, flank: FlankSide, radius: f64, (piece, angle): (usize, f64)) -> Option<FlankPoint> {
        self.axis(piece, angle).on_cylinder(self.signed(flank), radius)
    }

    /// Largest pressure angle with the lift growing, and falling as a positive number, rad, anywhere along the roller.
    fn signed_pressure_angles(&self) -> [Worst; 2] {
        [1.0, -1.0].map(|sign| {
            let at = |jet: &Jet| {
                let ends = self.touched(&self.path.at(jet));
                // Where the roller misses the cylinder nothing keeps a limit.
                let known = |v: f64| if v.is_nan() { f64::INFINITY } else { sign * self.path.pressure_angle(jet, v) };
                ends.map(known).into_iter().fold(0.0, f64::max)
            };
            self.largest(at)
        })
    }

    /// The smallest radius of curvature of the roller's path across its axis, m, anywhere along the roller: either flank is convex where it bends
    /// towards it.
    fn least_radius(&self) -> Worst {
        let sharpest = self.largest(|jet| {
            let axis = self.path.at(jet);
            let bends = self.touched(&axis).map(|v| axis.point(v).path_radius().abs().recip());
            bends.into_iter().fold(0.0, f64::max)
        });
        Worst { value: sharpest.value.recip(), ..sharpest }
    }

    /// Smallest distance from the roller's axis at which a flank self-intersects, m, over the groove's depth. The depth is taken between the points at
    /// which the flank itself meets the floor and the outside; at a pressure angle these are nearer to the shaft than those of the roller's axis.
    /// 0 if a flank does not reach them.
    fn least_fold(&self) -> Worst {
        let sharpest = self.largest(|jet| {
            let axis = self.path.at(jet);
            let of = |flank: FlankSide, radius: f64| {
                let distance = self.signed(flank);
                let found = axis.on_cylinder(distance, radius);
                found.map_or(0.0, |found| found.line.folds_at(&axis, distance.signum()))
            };
            let folds = FlankSide::BOTH.map(|flank| of(flank, self.floor()).min(of(flank, self.outer)));
            folds.into_iter().map(f64::recip).fold(0.0, f64::max)
        });
        Worst { value: sharpest.value.recip(), ..sharpest }
    }

    /// Whether the roller rests at a place, so that both flanks are level there.
    fn is_level(&self, piece: usize, angle: f64) -> bool {
        let jet = self.motion.jet(piece, angle);
        jet.ds.abs() <= LEVEL * lifts(&*self.motion).1.max(1e-6)
    }

    /// Angular speed of the cam, rad/s.
    fn speed(&self) -> Option<f64> {
        self.rpm.map(|rpm| rpm * std::f64::consts::TAU / 60.0)
    }
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

//! A wedge, or linear cam: a flat plate that travels out and back over its follower, for any motion by its travel.
//!
//! The follower is under the lower flank and the metal above it. After a travel x of the plate the roller is at C(x) of
//! [`PlateRoller`] in the frame of the plate, and the flank is the parallel of that path at the radius of the roller. The plate begins with a
//! level run-in, ends with a straight run-out along the last tangent, and has a straight back:
//!
//! ```text
//!      back, y = top
//!    ┌───────────────────────────┐
//!    │                           │
//!    └────────╲                  │
//!     run-in    ╲______          │   lower flank, lift s downwards
//!                       ╲________┘
//!     x = 0 →                     run-out
//! ```

mod figures;
mod implementation;
mod mechanism;
mod motion;
mod report;
mod sheet;

use camgen_kernel::text::{Length, Text, text};
pub use motion::PlateMotion;

use super::{Figures, Kind, WorstPlaces, broken_limit, largest};
use crate::machine::{Machine, PlateData};
use crate::report::shown;
use camgen_kernel::document::cams;
use camgen_kernel::follower::{Element, PlateRoller};
use camgen_kernel::geometry::contour::{Segment, Vertex};
use camgen_kernel::geometry::{CurvePoint, MILLIMETRES};
use camgen_kernel::motion::{Motion, Quantity};
use camgen_kernel::profile::outline::{self, OutlineError};
use camgen_kernel::profile::{Curves, Worst, lifts, size};
use camgen_kernel::refusal::Refusal;
use motion::Stretched;
use nalgebra::Vector2;
use std::sync::Arc;

/// The plate of any motion by its travel.
pub const WEDGE: Kind = Kind { command: cams::MAKE, noun: "wedge cam", keys: cams::WEDGE };

/// Least run-in that is chosen, m: that of a knife edge or a small roller.
const LEAST_RUN_IN: f64 = 5e-3;
/// Whole millimetres a length or height that was not given is rounded up to, m.
const STEP: f64 = 1e-3;
/// Share of a step that is the rounding of a sum.
const ROUNDING: f64 = 1e-9;
/// A travel so many times as long is tried where a limit is broken.
const LONGEST_STRETCH: f64 = 64.0;

/// A plate that travels under its follower.
#[derive(Debug, Clone)]
pub struct Wedge {
    machine: Arc<Machine>,
    motion: PlateMotion,
    /// The same without its run-in.
    given: Arc<dyn Motion>,
    follower: PlateRoller,
    run_in: f64,
    /// Where the straight run-out ends.
    run_out: Vector2<f64>,
    /// Height of the back above the roller's centre at lift 0, m.
    top: f64,
    /// From the back to where the flank is lowest, m.
    height: f64,
    /// From the back to where it is highest, m; not positive where the flank would reach the back; and where that is.
    thinnest: (f64, f64),
    worst: WorstPlaces,
}

impl Wedge {
    /// As [`Wedge::of`], where no speed of a shaft is given.
    pub(super) fn at_speed(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>) -> Result<Self, Refusal> {
        if rpm.is_some() {
            let what = "a plate travels and has no shaft that turns at a speed";
            return Err(Refusal::new(what).remedy("leave --rpm out"));
        }
        Self::of(machine, motion)
    }

    /// The plate of a motion by its travel (x in m, lifts in m, no period), under the roller or knife edge of the machine.
    ///
    /// # Errors
    /// [`Refusal`] when the motion is one of a turn or of a swing, the follower does not run on a plate, or the plate is shorter than its motion.
    pub fn of(machine: &Machine, motion: &Arc<dyn Motion>) -> Result<Self, Refusal> {
        if motion.period().is_some() {
            let what = "the motion is by the angle of a turn, and a plate does not turn";
            return Err(Refusal::new(what).remedy("give motion.stroke and lengths, or another cam.body"));
        }
        let straight = motion.quantity() == Quantity::Length && machine.follower.shape.quantity() == Quantity::Length;
        let radius = match machine.follower.shape.element() {
            Element::Roller { radius } if straight => radius,
            _ => {
                return Err(
                    Refusal::new("a plate moves a roller along a straight path").remedy("give [follower.roller]")
                );
            }
        };
        let plate = machine.cam.plate;
        let run_in = plate.run_in.unwrap_or_else(|| radius.max(LEAST_RUN_IN));
        let mut wedge = Self {
            machine: Arc::new(machine.clone()),
            motion: PlateMotion::new(Arc::clone(motion), run_in),
            given: Arc::clone(motion),
            follower: PlateRoller::new(radius, plate.drive_angle),
            run_in,
            run_out: Vector2::zeros(),
            top: 0.0,
            height: 0.0,
            thinnest: (0.0, 0.0),
            worst: WorstPlaces::default(),
        };
        wedge.refuse_turning_back()?;
        wedge.run_out = wedge.end_of_run_out()?;
        wedge.place_back();
        Ok(wedge)
    }

    /// Refuses a path along which the roller moves back on the plate while it travels on.
    fn refuse_turning_back(&self) -> Result<(), Refusal> {
        let least = largest(self.curves(), |piece, x| -self.follower.advance(self.motion.jet(piece, x).ds));
        if least.value < 0.0 {
            return Ok(());
        }
        let what = "along its inclined path the follower would move back on the plate faster than that travels";
        Err(Refusal::new(what)
            .at(format!("x = {:.3} mm", MILLIMETRES * least.at))
            .remedy("give a longer stroke, or a cam.drive_angle nearer to 0"))
    }

    /// Where the run-out ends: at the given length of the plate, or as long as the run-in and on to whole millimetres.
    fn end_of_run_out(&self) -> Result<Vector2<f64>, Refusal> {
        let (start, end) = (self.start(), self.end());
        let needed = end.point.x - start.x;
        let length = match self.machine.cam.plate.length {
            Some(length) if length >= needed => length,
            Some(length) => {
                let what = format!(
                    "a plate of {} mm ends {} mm before its motion does",
                    shown(MILLIMETRES * length),
                    shown(MILLIMETRES * (needed - length))
                );
                let least = MILLIMETRES * rounded_up(needed);
                return Err(Refusal::new(what).remedy(format!("cam.length must be at least {least:.0} mm")));
            }
            None => rounded_up(needed + self.run_in),
        };
        let beyond = start.x + length - end.point.x;
        Ok(end.point + end.tangent * (beyond / end.tangent.x))
    }

    /// Puts the back where the plate gets its height, and finds where it is thinnest.
    fn place_back(&mut self) {
        let up = |piece: usize, x: f64| self.curves().profile(piece, x).point.y;
        let highest = largest(self.curves(), up);
        let lowest = largest(self.curves(), |piece, x| -up(piece, x));
        let (high, at) = if self.run_out.y > highest.value {
            (self.run_out.y, self.stroke().1)
        } else {
            (highest.value, highest.at)
        };
        let low = (-lowest.value).min(self.run_out.y);
        let radius = self.follower_radius();
        let height = self
            .machine
            .cam
            .plate
            .height
            .unwrap_or_else(|| rounded_up(high - low + self.machine.limits.least_wall(None).max(radius)));
        (self.top, self.height, self.thinnest) = (low + height, height, (low + height - high, at));
    }

    /// Motion, with the run-in, and follower.
    #[must_use]
    pub fn curves(&self) -> Curves<'_> {
        Curves { motion: &self.motion, follower: &self.follower }
    }

    /// First and last place of its motion, m.
    #[must_use]
    pub fn stroke(&self) -> (f64, f64) {
        self.motion.stroke()
    }

    /// Largest lift, m.
    #[must_use]
    pub fn max_lift(&self) -> f64 {
        lifts(&self.motion).1
    }

    /// Length of the level flank before its motion, m.
    #[must_use]
    pub fn run_in(&self) -> f64 {
        self.run_in
    }

    /// Length along its travel, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.run_out.x - self.start().x
    }

    /// Height from its back to where its flank is lowest, m.
    #[must_use]
    pub fn height(&self) -> f64 {
        self.height
    }

    fn follower_radius(&self) -> f64 {
        self.curves().offset()
    }

    /// Where the flank starts, m.
    fn start(&self) -> Vector2<f64> {
        self.curves().profile(0, self.motion.range().0).point
    }

    /// Where the motion ends on the flank, with its tangent.
    fn end(&self) -> CurvePoint {
        let last = self.motion.pieces().len().saturating_sub(1);
        self.curves().profile(last, self.stroke().1)
    }

    /// The corners of the plate, m, from the start of the flank on against the clock, with the end of the motion before that of the run-out.
    fn corners(&self) -> [Vector2<f64>; 5] {
        let start = self.start();
        let up = |x: f64| Vector2::new(x, self.top);
        [start, self.end().point, self.run_out, up(self.run_out.x), up(start.x)]
    }

    /// Force along the follower's path that presses it on at rest, N; `None` where no preload, spring or load is given.
    fn pressing(&self, lift: f64) -> Option<f64> {
        let (preload, spring) = (self.machine.follower.preload, self.machine.spring());
        let of_spring = spring.map(|spring| spring.preload + spring.load + spring.rate * lift);
        let known = preload.is_some() || spring.is_some();
        known.then(|| preload.unwrap_or(0.0) + of_spring.unwrap_or(0.0))
    }

    /// Shortest lengths of plate over which a movement of this slope (m/m, largest and least) keeps the limits of the pressure angle, as a
    /// share of the length that it has; `None` where a limit cannot be kept at any length.
    fn shortest_share(&self, [rising, falling]: [f64; 2]) -> Option<f64> {
        let slopes = self.follower.slopes_at(self.machine.limits.pressure_angles());
        let [of_rise, of_fall] = [(rising, slopes[0]), (falling, slopes[1])]
            .map(|(slope, limit)| if slope > 0.0 { (limit > 0.0).then_some(slope / limit) } else { Some(0.0) });
        Some(of_rise?.max(of_fall?))
    }

    /// The least factor of the travel with which every limit is kept, tried; `None` where none was found.
    fn stretch_that_keeps(&self) -> Option<f64> {
        let machine = {
            let plate = PlateData { length: None, height: None, ..self.machine.cam.plate };
            self.machine.with_plate(plate)
        };
        let keeps = |factor: f64| {
            let longer: Arc<dyn Motion> = Arc::new(Stretched::new(Arc::clone(&self.given), factor));
            Self::of(&machine, &longer).is_ok_and(|wedge| broken_limit(&wedge).is_none())
        };
        size::first_that_keeps(1.0, LONGEST_STRETCH, keeps)
    }

    /// A stroke that keeps every limit. All lengths of the program change with it, so that it is not the change of a key.
    fn longer_stroke(&self) -> Option<Text> {
        if self.least_radius().value <= 0.0 {
            return Some("no stroke would pass: the velocity of the follower jumps; avoid that by other states or laws of the segments that meet there".into());
        }
        let (from, to) = self.stroke();
        let factor = self.stretch_that_keeps()?;
        let stroke = rounded_up(factor * (to - from));
        let given = self.machine.cam.plate;
        let sizes = if given.length.is_some() || given.height.is_some() {
            ", and cam.length and cam.height \"auto\""
        } else {
            ""
        };
        Some(text!(
            "motion.stroke = \"{}\" with all lengths of the program in proportion{} would pass",
            Length::mm((MILLIMETRES * stroke).round()),
            sizes
        ))
    }

    /// The pitch curve, for viewing.
    fn pitch_curve(&self) -> Result<Vec<Segment>, OutlineError> {
        let mut vertices = outline::pitch(self.curves())?.contour.vertices;
        let last = self.motion.pieces().len().saturating_sub(1);
        let end = self.curves().contact(last, self.stroke().1).curve.point * MILLIMETRES;
        vertices.push(Vertex::new(end, 0.0));
        let pairs = vertices.iter().zip(vertices.iter().skip(1));
        // A pitch curve is laid as arcs.
        let segment = |(a, b): (&Vertex, &Vertex)| Some(Segment { start: a.point, end: b.point, bulge: a.bulge()? });
        Ok(pairs.filter_map(segment).collect())
    }

    /// The largest of something over the whole flank.
    fn largest(&self, value: impl Fn(usize, f64) -> f64) -> Worst {
        largest(self.curves(), value)
    }
}

/// A length in whole millimetres, m.
fn rounded_up(length: f64) -> f64 {
    (length / STEP - ROUNDING).ceil() * STEP
}

#[cfg(test)]
mod tests;

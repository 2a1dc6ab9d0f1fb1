//! The cam on the shaft: its mass, and what its force does to the lift.

use super::{ShaftAnalysisError, error_of};
use crate::body::disc::{Disc, Lowered, Yielding};
use crate::body::{Body, Request};
use crate::geometry::MILLIMETRES;
use crate::machine::{Machine, ShaftMachine};
use crate::profile::Worst;
use crate::report::shown;
use crate::shaft::exact::Statics;
use crate::shaft::{self, Shaft};
use crate::table::{Table, Told, turned};

/// The outline is drawn to this for mass and inertia, m; it leaves 1e-5 of them.
const TOLERANCE: f64 = 5e-6;

/// A cam and what it is as a disc.
pub(super) struct Carried {
    pub(super) body: Disc,
    /// As a disc on the shaft; `None` without a thickness.
    pub(super) disc: Option<shaft::Disc>,
    /// Angular speed of the cam, rad/s.
    pub(super) speed: Option<f64>,
    /// The speed it is told for, rpm: of the main shaft of a press, or of the cam itself.
    pub(super) rpm: Option<f64>,
}

impl Carried {
    /// The disc cam of a machine: that of its press, or of its motion program. `None` for a shaft alone.
    pub(super) fn of(machine: &ShaftMachine, rpm: Option<f64>) -> Result<Option<Self>, ShaftAnalysisError> {
        let Some(own) = machine.machine() else { return Ok(None) };
        let cannot = |why: &dyn std::fmt::Display| ShaftAnalysisError::Cam(why.to_string());
        let (body, rpm) = match (own.press(), own.motion()) {
            (Err(_), Some((motion, of_file))) => {
                let rpm = rpm.or(of_file);
                (Disc::of_motion(own, motion, rpm).map_err(|error| cannot(&error))?, rpm)
            }
            (press, _) => {
                let rpm = rpm.unwrap_or(press.map_err(|error| cannot(&error))?.design_rpm);
                (Disc::solve(own, rpm).map_err(|error| cannot(&error))?, Some(rpm))
            }
        };
        let disc = machine.data.cam_at.and_then(|at| as_disc(&body, own, at).transpose()).transpose()?;
        let speed = body.shaft_speed();
        Ok(Some(Self { body, disc, speed, rpm }))
    }
}

/// What a drawn cam is as a disc at a place of the shaft; `None` without a thickness.
fn as_disc(body: &Disc, machine: &Machine, at: f64) -> Result<Option<shaft::Disc>, ShaftAnalysisError> {
    let drawn = body.draw(&Request::within(TOLERANCE)).map_err(|error| ShaftAnalysisError::Cam(error.to_string()))?;
    let inertia = drawn.parts.first().and_then(|part| part.inertia(machine));
    Ok(inertia.map(|inertia| shaft::Disc {
        at,
        mass: inertia.mass,
        diametral_inertia: inertia.diametral,
        polar_inertia: inertia.polar,
        unbalance: inertia.unbalance,
    }))
}

/// The cam under the force of its follower.
pub(super) struct Under {
    body: Disc,
    yielding: Yielding,
    /// Twist from drive to cam, where it is modelled, rad/(N·m).
    pub(super) shaft_twist: Option<f64>,
    /// The largest lift error, m, and its cam angle.
    pub(super) largest: Worst,
    /// The follower there.
    pub(super) there: Lowered,
    /// The largest force that is left, N; `None` where nothing is to balance.
    pub(super) residual: Option<Worst>,
    /// Largest slope of a support, rad.
    pub(super) slope: f64,
    /// Forces of the supports under the largest force of the cam, N.
    pub(super) reactions: Vec<f64>,
}

impl Under {
    /// `None` where no force is known.
    pub(super) fn of(carried: &Carried, statics: &Statics, drive: Option<(f64, f64)>, shaft: &Shaft) -> Option<Self> {
        let body = &carried.body;
        let start = body.curves().motion.locate(0.0);
        body.path_force(start.0, start.1)?;
        let shaft_twist = drive.map(|(from, to)| shaft.twist_compliance(from, to));
        let yielding = Yielding { compliance: statics.own(), twist: shaft_twist.unwrap_or(0.0) };
        let largest = body.largest_lowered(&yielding, error_of);
        let (piece, angle) = body.curves().motion.locate(largest.at);
        let there = body.lowered(piece, angle, &yielding)?;
        let residual = body.largest_lowered(&yielding, |lowered| lowered.residual.abs());
        // Along and across the path together.
        let across = |lowered: &Lowered| lowered.force / libm::cos(lowered.pressure_angle);
        let force = body.largest_lowered(&yielding, across).value;
        let slopes = shaft.supports().iter().map(|support| statics.curve.at(support.at)[1].abs());
        Some(Self {
            body: body.clone(),
            yielding,
            shaft_twist,
            largest,
            there,
            residual: body.balance().map(|_| residual),
            slope: force * slopes.fold(0.0, f64::max),
            reactions: statics.reactions.iter().map(|reaction| force * reaction).collect(),
        })
    }

    /// The largest lift error on another shaft, m.
    pub(super) fn lift_on(&self, yielding: &Yielding) -> f64 {
        self.body.largest_lowered(yielding, error_of).value
    }

    /// The largest slope of a support on another shaft, rad.
    pub(super) fn slope_on(&self, (yielding, statics): &(Yielding, Statics), shaft: &Shaft) -> f64 {
        let across = |lowered: &Lowered| lowered.force / libm::cos(lowered.pressure_angle);
        let slopes = shaft.supports().iter().map(|support| statics.curve.at(support.at)[1].abs());
        self.body.largest_lowered(yielding, across).value * slopes.fold(0.0, f64::max)
    }

    /// Cam angle, degrees, and what the follower does there, at equal steps of a turn.
    pub(super) fn rows(&self, samples: u32) -> Vec<(f64, Lowered)> {
        let motion = self.body.curves().motion;
        let row = |index: u32| {
            let at = turned(index, samples, motion.lobes());
            let (piece, angle) = motion.locate(at.angle);
            Some((at.cam_deg, self.body.lowered(piece, angle, &self.yielding)?))
        };
        (0..samples).filter_map(row).collect()
    }

    /// The table of the lift under load.
    pub(super) fn table(&self, samples: u32) -> Table {
        Table::listed(LIFT, &self.rows(samples))
    }

    pub(super) fn words(&self) -> String {
        let twist = match self.shaft_twist {
            Some(_) => format!(" ({:.4} mm of it twist)", MILLIMETRES * self.there.twist),
            None => String::new(),
        };
        let left = self.residual.map_or(String::new(), |left| {
            format!("; {:.2} N are left of the force balance, at {:.3}°", left.value, left.at.to_degrees())
        });
        format!(
            "the follower stands up to {:.5} mm low{twist}, at {:.3}° of the cam under {} N{left}",
            MILLIMETRES * self.largest.value,
            self.largest.at.to_degrees(),
            shown(self.there.force.round())
        )
    }
}

const LIFT: &[Told<(f64, Lowered)>] = &[
    ("cam_deg", |row| row.0),
    ("force_n", |row| row.1.force),
    ("pressure_angle_deg", |row| row.1.pressure_angle.to_degrees()),
    ("bending_mm", |row| MILLIMETRES * row.1.bending),
    ("twist_mm", |row| MILLIMETRES * row.1.twist),
    ("lift_error_mm", |row| MILLIMETRES * row.1.error()),
    ("residual_n", |row| row.1.residual),
];

//! The cam on the shaft: its mass, and what its force does to the lift.

use super::{ShaftAnalysisError, error_of};
use crate::body::conoid::Conoid;
use crate::body::disc::Disc;
use crate::body::{Body, Lowered, Request, Yielding};
use crate::geometry::MILLIMETRES;
use crate::machine::{Machine, Rotation, ShaftMachine};
use crate::motion::Reversal;
use crate::profile::Worst;
use crate::report::shown;
use crate::shaft::exact::Statics;
use crate::shaft::{self, Shaft};
use crate::table::{Table, Told, turned};
use serde::Serialize;
use std::sync::Arc;

/// The outline is drawn to this for mass and inertia, m; it leaves 1e-5 of them.
const TOLERANCE: f64 = 5e-6;

/// What stands on the shaft.
pub(super) enum Cam {
    Disc(Box<Disc>),
    Conoid(Box<Conoid>),
}

/// A cam and what it is as a disc.
pub(super) struct Carried {
    pub(super) cam: Arc<Cam>,
    /// As a disc on the shaft; `None` without a thickness, and of a conoid.
    pub(super) disc: Option<shaft::Disc>,
    /// Angular speed of the cam, rad/s; of a conoid the fastest.
    pub(super) speed: Option<f64>,
    /// The speeds it is told for, rpm: of the main shaft of a press, or of the cam itself.
    pub(super) rpm: Vec<f64>,
}

impl Carried {
    /// The cam of a machine: the disc of its press or of its motion program, or, for several speeds, its conoid. `None` for a shaft
    /// alone.
    pub(super) fn of(machine: &ShaftMachine, rpm: &[f64]) -> Result<Option<Self>, ShaftAnalysisError> {
        let Some(own) = machine.machine() else { return Ok(None) };
        let cannot = |why: &dyn std::fmt::Display| ShaftAnalysisError::Cam(why.to_string());
        if rpm.len() > 1 {
            let conoid = Conoid::solve(own, rpm).map_err(|error| cannot(&error))?;
            let press = own.press().map_err(|error| cannot(&error))?;
            let fastest = rpm.iter().copied().fold(0.0, f64::max);
            let speed = Some(press.bed.crank_speed(fastest) / f64::from(own.cam.lobes));
            let cam = Arc::new(Cam::Conoid(Box::new(conoid)));
            return Ok(Some(Self { cam, disc: None, speed, rpm: rpm.to_vec() }));
        }
        let rpm = rpm.first().copied();
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
        Ok(Some(Self { cam: Arc::new(Cam::Disc(Box::new(body))), disc, speed, rpm: rpm.into_iter().collect() }))
    }

    /// Whether it is a conoid.
    pub(super) fn is_conoid(&self) -> bool {
        matches!(*self.cam, Cam::Conoid(_))
    }

    /// Largest radius of the cam, m, for its picture.
    pub(super) fn reach(&self) -> f64 {
        match &*self.cam {
            Cam::Disc(disc) => disc.base_radius() + disc.max_lift(),
            Cam::Conoid(conoid) => conoid.base_radius() + conoid.max_lift(),
        }
    }
}

/// What a drawn cam is as a disc at a place of the shaft; `None` without a thickness.
fn as_disc(body: &Disc, machine: &Machine, at: f64) -> Result<Option<shaft::Disc>, ShaftAnalysisError> {
    let drawn = body.draw(&Request::within(TOLERANCE)).map_err(|error| ShaftAnalysisError::Cam(error.to_string()))?;
    let inertia = drawn.parts.first().and_then(|part| part.inertia(machine));
    // A cam that turns counter-clockwise is drawn in the mirror; angles of unbalance are those of the cam.
    let side = if machine.cam.rotation == Rotation::CounterClockwise { -1.0 } else { 1.0 };
    Ok(inertia.map(|inertia| shaft::Disc {
        at,
        mass: inertia.mass,
        diametral_inertia: inertia.diametral,
        polar_inertia: inertia.polar,
        unbalance: [inertia.unbalance[0], side * inertia.unbalance[1]],
    }))
}

/// The largest lift error of a section, and the force that is left.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct Section {
    rpm: f64,
    lift_error_max_mm: f64,
    lift_error_cam_deg: f64,
    residual_max_n: f64,
}

/// What was found on a disc, or on a section of a conoid.
#[derive(Clone, Copy)]
struct Found {
    rpm: Option<f64>,
    largest: Worst,
    there: Lowered,
    residual: Worst,
    /// Largest force on the cam, along and across the path together, N.
    force: f64,
}

/// The cam under the force of its follower.
pub(super) struct Under {
    cam: Arc<Cam>,
    yielding: Yielding,
    found: Vec<Found>,
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
    /// That force, N.
    pub(super) force: f64,
}

fn across(lowered: &Lowered) -> f64 {
    lowered.force / libm::cos(lowered.pressure_angle)
}

/// The largest slope of a support under 1 N at the cam, rad/N.
fn steepest(statics: &Statics, shaft: &Shaft) -> f64 {
    let slopes = shaft.supports().iter().map(|support| statics.curve.at(support.at)[1].abs());
    slopes.fold(0.0, f64::max)
}

/// What is found on a cam whose shaft gives way; nothing where no force is known.
fn found_on(cam: &Cam, yielding: &Yielding) -> Vec<Found> {
    match cam {
        Cam::Disc(disc) => {
            let largest = disc.largest_lowered(yielding, error_of);
            let (piece, angle) = disc.curves().motion.locate(largest.at);
            let Some(there) = disc.lowered(piece, angle, yielding) else { return Vec::new() };
            let residual = disc.largest_lowered(yielding, |lowered| lowered.residual.abs());
            let force = disc.largest_lowered(yielding, across).value;
            vec![Found { rpm: None, largest, there, residual, force }]
        }
        Cam::Conoid(conoid) => {
            let of = |cut: &(f64, f64, &Reversal)| {
                let (largest, there) = conoid.largest_lowered(*cut, yielding, error_of);
                let residual = conoid.largest_lowered(*cut, yielding, |lowered| lowered.residual.abs()).0;
                let force = conoid.largest_lowered(*cut, yielding, across).0.value;
                Found { rpm: Some(cut.0), largest, there, residual, force }
            };
            conoid.cuts().iter().map(of).collect()
        }
    }
}

impl Under {
    /// `None` where no force is known.
    pub(super) fn of(carried: &Carried, statics: &Statics, drive: Option<(f64, f64)>, shaft: &Shaft) -> Option<Self> {
        let shaft_twist = drive.map(|(from, to)| shaft.twist_compliance(from, to));
        let yielding = Yielding { compliance: statics.own(), twist: shaft_twist.unwrap_or(0.0) };
        let found = found_on(&carried.cam, &yielding);
        let worst = *found.iter().reduce(|a, b| if b.largest.value > a.largest.value { b } else { a })?;
        let residual = found.iter().map(|one| one.residual).reduce(Worst::or_larger)?;
        let force = found.iter().map(|one| one.force).fold(0.0, f64::max);
        let balances = match &*carried.cam {
            Cam::Disc(disc) => disc.balance().is_some(),
            Cam::Conoid(_) => true,
        };
        Some(Self {
            cam: Arc::clone(&carried.cam),
            yielding,
            shaft_twist,
            largest: worst.largest,
            there: worst.there,
            residual: balances.then_some(residual),
            slope: force * steepest(statics, shaft),
            reactions: statics.reactions.iter().map(|reaction| force * reaction).collect(),
            force,
            found,
        })
    }

    /// The largest lift error on another shaft, m.
    pub(super) fn lift_on(&self, yielding: &Yielding) -> f64 {
        found_on(&self.cam, yielding).iter().map(|one| one.largest.value).fold(0.0, f64::max)
    }

    /// The largest slope of a support on another shaft, rad.
    pub(super) fn slope_on(&self, (yielding, statics): &(Yielding, Statics), shaft: &Shaft) -> f64 {
        let force = found_on(&self.cam, yielding).iter().map(|one| one.force).fold(0.0, f64::max);
        force * steepest(statics, shaft)
    }

    /// Whether it is a conoid, with a section for each speed.
    pub(super) fn has_sections(&self) -> bool {
        self.found.iter().any(|one| one.rpm.is_some())
    }

    /// The sections of a conoid.
    pub(super) fn told(&self) -> Vec<Section> {
        let of = |one: &Found| {
            Some(Section {
                rpm: one.rpm?,
                lift_error_max_mm: MILLIMETRES * one.largest.value,
                lift_error_cam_deg: one.largest.at.to_degrees(),
                residual_max_n: one.residual.value,
            })
        };
        self.found.iter().filter_map(of).collect()
    }

    /// Speed of a section (rpm; NaN of a disc), cam angle, degrees, and what the follower does there, at equal steps of a turn.
    pub(super) fn rows(&self, samples: u32) -> Vec<Row> {
        match &*self.cam {
            Cam::Disc(disc) => {
                let motion = disc.curves().motion;
                let row = |index: u32| {
                    let at = turned(index, samples, motion.lobes());
                    let (piece, angle) = motion.locate(at.angle);
                    Some((f64::NAN, at.cam_deg, disc.lowered(piece, angle, &self.yielding)?))
                };
                (0..samples).filter_map(row).collect()
            }
            Cam::Conoid(conoid) => {
                let of = |cut: (f64, f64, &Reversal)| {
                    let rows = conoid.rows_lowered(cut, &self.yielding, samples);
                    rows.into_iter().map(move |(cam_deg, lowered)| (cut.0, cam_deg, lowered))
                };
                conoid.cuts().into_iter().flat_map(of).collect()
            }
        }
    }

    /// The table of the lift under load; of a conoid with the speed of the section before.
    pub(super) fn table(&self, samples: u32) -> Table {
        let rows = self.rows(samples);
        if self.has_sections() { Table::listed(&[SPEED, LIFT].concat(), &rows) } else { Table::listed(LIFT, &rows) }
    }

    pub(super) fn words(&self) -> Vec<String> {
        let twist = match self.shaft_twist {
            Some(_) => format!(" ({:.4} mm of it twist)", MILLIMETRES * self.there.twist),
            None => String::new(),
        };
        let left = self.residual.map_or(String::new(), |left| {
            format!("; {:.2} N are left of the force balance, at {:.3}°", left.value, left.at.to_degrees())
        });
        let all = format!(
            "the follower stands up to {:.5} mm low{twist}, at {:.3}° of the cam under {} N{left}",
            MILLIMETRES * self.largest.value,
            self.largest.at.to_degrees(),
            shown(self.there.force.round())
        );
        let section = |one: Section| {
            format!(
                "section for {} rpm: up to {:.5} mm low at {:.3}°, {:.2} N left",
                shown(one.rpm),
                one.lift_error_max_mm,
                one.lift_error_cam_deg,
                one.residual_max_n
            )
        };
        std::iter::once(all).chain(self.told().into_iter().map(section)).collect()
    }
}

/// Speed of a section, rpm, cam angle, degrees, and the follower there.
pub(super) type Row = (f64, f64, Lowered);

const SPEED: &[Told<Row>] = &[("rpm", |row| row.0)];

const LIFT: &[Told<Row>] = &[
    ("cam_deg", |row| row.1),
    ("force_n", |row| row.2.force),
    ("pressure_angle_deg", |row| row.2.pressure_angle.to_degrees()),
    ("bending_mm", |row| MILLIMETRES * row.2.bending),
    ("twist_mm", |row| MILLIMETRES * row.2.twist),
    ("lift_error_mm", |row| MILLIMETRES * row.2.error()),
    ("residual_n", |row| row.2.residual),
];

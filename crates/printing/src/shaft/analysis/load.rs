//! The cam on the shaft: its mass, and the loss of lift by its force.

use super::error_of;
use crate::press::MachineOfPress;
use crate::press::conoid::Conoid;
use crate::press::machine::PressCams;
use crate::press::rotary;
use crate::shaft::machine::{ShaftData, ShaftMachine};
use crate::shaft::mechanics::exact::Statics;
use crate::shaft::mechanics::{self, Shaft};
use camgen_cams::body::disc::Disc;
use camgen_cams::body::{Body, LoadedFollower, Request, ShaftCompliance};
use camgen_cams::machine::{Machine, Rotation};
use camgen_cams::report::shown;
use camgen_cams::table::{ListedColumn, Table, turned};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::Worst;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{Length, Text, text};
use serde::Serialize;
use std::sync::Arc;

/// The outline is drawn to this for mass and inertia, m; it leaves 1e-5 of them.
const TOLERANCE: f64 = 5e-6;

/// The cam on the shaft.
pub(super) enum MountedCam {
    Disc(Box<Disc>),
    Conoid(Box<Conoid>),
}

/// A cam and what it is as a disc.
pub(super) struct CamOnShaft {
    pub(super) cam: Arc<MountedCam>,
    /// As a disc on the shaft; `None` without a thickness, and of a conoid.
    pub(super) disc: Option<mechanics::ShaftDisc>,
    /// Angular speed of the cam, rad/s; of a conoid the fastest.
    pub(super) speed: Option<f64>,
    /// The speeds it is reported for, rpm: of the main shaft of a press, or of the cam itself.
    pub(super) rpm: Vec<f64>,
}

impl CamOnShaft {
    /// The cam of a machine: the disc of its press or of its motion program, or, for several speeds, its conoid. `None` for a shaft
    /// alone.
    pub(super) fn solve(machine: &ShaftMachine, rpm: &[f64]) -> Result<Option<Self>, Refusal> {
        let Some(own) = machine.machine() else { return Ok(None) };
        if rpm.len() > 1 {
            let conoid = Conoid::solve(own, rpm).map_err(of_cam)?;
            let press = own.press().map_err(of_cam)?;
            let fastest = rpm.iter().copied().fold(0.0, f64::max);
            let speed = Some(press.bed.crank_speed(fastest) / f64::from(PressCams::of(own).lobes));
            let cam = Arc::new(MountedCam::Conoid(Box::new(conoid)));
            return Ok(Some(Self { cam, disc: None, speed, rpm: rpm.to_vec() }));
        }
        let rpm = rpm.first().copied();
        let own = &own.at_rpm(rpm).map_err(of_cam)?;
        let (body, rpm) = match (own.press(), own.motion()) {
            (Err(_), Some((motion, of_file))) => {
                let rpm = rpm.or(of_file);
                (Disc::of_motion(own, motion, rpm).map_err(of_cam)?, rpm)
            }
            (press, _) => {
                let rpm = rpm.unwrap_or(press.map_err(of_cam)?.design_rpm);
                (rotary::disc(own, rpm).map_err(of_cam)?, Some(rpm))
            }
        };
        let disc = machine.data.cam_at.and_then(|at| as_disc(&body, own, at).transpose()).transpose()?;
        let speed = body.shaft_speed();
        Ok(Some(Self { cam: Arc::new(MountedCam::Disc(Box::new(body))), disc, speed, rpm: rpm.into_iter().collect() }))
    }

    /// Whether it is a conoid.
    pub(super) fn is_conoid(&self) -> bool {
        matches!(*self.cam, MountedCam::Conoid(_))
    }

    /// Largest radius of the cam, m, for its picture.
    pub(super) fn reach(&self) -> f64 {
        match &*self.cam {
            MountedCam::Disc(disc) => disc.base_radius() + disc.max_lift(),
            MountedCam::Conoid(conoid) => conoid.base_radius() + conoid.max_lift(),
        }
    }
}

/// The refusal of the cam on the shaft.
fn of_cam(why: Refusal) -> Refusal {
    why.context("the cam on the shaft")
}

/// A drawn cam as a disc on the shaft; `None` without a thickness.
fn as_disc(body: &Disc, machine: &Machine, at: f64) -> Result<Option<mechanics::ShaftDisc>, Refusal> {
    let drawn = body.draw(&Request::within(TOLERANCE)).map_err(|error| of_cam(Refusal::of(error)))?;
    let inertia = drawn.parts.first().and_then(|part| part.inertia(machine));
    // A cam that turns counter-clockwise is drawn in the mirror; angles of unbalance are cam angles.
    let side = if machine.cam.rotation == Rotation::CounterClockwise { -1.0 } else { 1.0 };
    Ok(inertia.map(|inertia| mechanics::ShaftDisc {
        at,
        mass: inertia.mass,
        diametral_inertia: inertia.diametral,
        polar_inertia: inertia.polar,
        unbalance: [inertia.unbalance[0], side * inertia.unbalance[1]],
    }))
}

/// The largest lift error of a section, and the force that is left.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct SectionLiftError {
    rpm: f64,
    lift_error_max_mm: f64,
    lift_error_cam_deg: f64,
    residual_max_n: f64,
}

/// The follower under load on a disc, or on a section of a conoid.
#[derive(Clone, Copy)]
struct LoadedSection {
    rpm: Option<f64>,
    largest: Worst,
    there: LoadedFollower,
    residual: Worst,
    /// Largest force on the cam, along and across the path together, N.
    force: f64,
}

/// The cam under the force of its follower.
pub(super) struct CamUnderLoad {
    cam: Arc<MountedCam>,
    yielding: ShaftCompliance,
    found: Vec<LoadedSection>,
    /// Twist from drive to cam, where it is modelled, rad/(N·m).
    pub(super) shaft_twist: Option<f64>,
    /// The largest lift error, m, and its cam angle.
    pub(super) largest: Worst,
    /// The follower there.
    pub(super) there: LoadedFollower,
    /// The largest force that is left, N; `None` where nothing is to balance.
    pub(super) residual: Option<Worst>,
    /// Largest slope of a support, rad.
    pub(super) slope: f64,
    /// Forces of the supports under the largest force of the cam, N.
    pub(super) reactions: Vec<f64>,
    /// That force, N.
    pub(super) force: f64,
}

fn across(follower: &LoadedFollower) -> f64 {
    follower.force / libm::cos(follower.pressure_angle)
}

/// The largest slope of a support under 1 N at the cam, rad/N.
fn steepest(statics: &Statics, shaft: &Shaft) -> f64 {
    let slopes = shaft.supports().iter().map(|support| statics.curve.evaluate(support.at)[1].abs());
    slopes.fold(0.0, f64::max)
}

/// The loaded sections of a cam on a shaft that deflects; empty where no force is known.
fn sections_under_load(cam: &MountedCam, yielding: &ShaftCompliance) -> Vec<LoadedSection> {
    match cam {
        MountedCam::Disc(disc) => {
            let largest = disc.largest_loaded(yielding, error_of);
            let (piece, angle) = disc.curves().motion.locate(largest.at);
            let Some(there) = disc.loaded_follower(piece, angle, yielding) else { return Vec::new() };
            let residual = disc.largest_loaded(yielding, |follower| follower.residual.abs());
            let force = disc.largest_loaded(yielding, across).value;
            vec![LoadedSection { rpm: None, largest, there, residual, force }]
        }
        MountedCam::Conoid(conoid) => {
            let mut sections = Vec::new();
            for cut in conoid.sections_cut() {
                let (largest, there) = conoid.largest_loaded(cut, yielding, error_of);
                let residual = conoid.largest_loaded(cut, yielding, |follower| follower.residual.abs()).0;
                let force = conoid.largest_loaded(cut, yielding, across).0.value;
                sections.push(LoadedSection { rpm: Some(cut.rpm), largest, there, residual, force });
            }
            sections
        }
    }
}

impl CamUnderLoad {
    /// `None` where no force is known.
    pub(super) fn new(carried: &CamOnShaft, statics: &Statics, data: &ShaftData) -> Option<Self> {
        let shaft_twist = data.drive_to_cam();
        let yielding = ShaftCompliance { compliance: statics.own_compliance(), twist: shaft_twist.unwrap_or(0.0) };
        let found = sections_under_load(&carried.cam, &yielding);
        let worst = *found.iter().reduce(|a, b| if b.largest.value > a.largest.value { b } else { a })?;
        let residual = found.iter().map(|one| one.residual).reduce(Worst::or_larger)?;
        let force = found.iter().map(|one| one.force).fold(0.0, f64::max);
        let balances = match &*carried.cam {
            MountedCam::Disc(disc) => disc.is_balanced(),
            MountedCam::Conoid(_) => true,
        };
        Some(Self {
            cam: Arc::clone(&carried.cam),
            yielding,
            shaft_twist,
            largest: worst.largest,
            there: worst.there,
            residual: balances.then_some(residual),
            slope: force * steepest(statics, &data.shaft),
            reactions: statics.reactions.iter().map(|reaction| force * reaction).collect(),
            force,
            found,
        })
    }

    /// The largest lift error on another shaft, m.
    pub(super) fn lift_on(&self, yielding: &ShaftCompliance) -> f64 {
        sections_under_load(&self.cam, yielding).iter().map(|one| one.largest.value).fold(0.0, f64::max)
    }

    /// The largest slope of a support on another shaft, rad.
    pub(super) fn slope_on(&self, yielding: &ShaftCompliance, statics: &Statics, shaft: &Shaft) -> f64 {
        let force = sections_under_load(&self.cam, yielding).iter().map(|one| one.force).fold(0.0, f64::max);
        force * steepest(statics, shaft)
    }

    /// Whether it is a conoid, with a section for each speed.
    pub(super) fn has_sections(&self) -> bool {
        self.found.iter().any(|one| one.rpm.is_some())
    }

    /// The sections of a conoid.
    pub(super) fn lift_errors(&self) -> Vec<SectionLiftError> {
        let mut errors = Vec::new();
        for one in &self.found {
            let Some(rpm) = one.rpm else { continue };
            errors.push(SectionLiftError {
                rpm,
                lift_error_max_mm: MILLIMETRES * one.largest.value,
                lift_error_cam_deg: one.largest.at.to_degrees(),
                residual_max_n: one.residual.value,
            });
        }
        errors
    }

    /// Speed of a section (rpm; NaN of a disc), cam angle, degrees, and what the follower does there, at equal steps of a turn.
    pub(super) fn rows(&self, samples: u32) -> Vec<LiftErrorRow> {
        let mut rows = Vec::new();
        match &*self.cam {
            MountedCam::Disc(disc) => {
                let motion = disc.curves().motion;
                for index in 0..samples {
                    let at = turned(index, samples, motion.lobes());
                    let (piece, angle) = motion.locate(at.angle);
                    let follower = disc.loaded_follower(piece, angle, &self.yielding);
                    rows.extend(follower.map(|follower| (f64::NAN, at.cam_deg, follower)));
                }
            }
            MountedCam::Conoid(conoid) => {
                for cut in conoid.sections_cut() {
                    let section = conoid.rows_lowered(cut, &self.yielding, samples);
                    rows.extend(section.into_iter().map(|(cam_deg, follower)| (cut.rpm, cam_deg, follower)));
                }
            }
        }
        rows
    }

    /// The table of the lift under load; of a conoid with the speed of the section before.
    pub(super) fn table(&self, samples: u32) -> Table {
        let rows = self.rows(samples);
        if self.has_sections() { Table::listed(&[SPEED, LIFT].concat(), &rows) } else { Table::listed(LIFT, &rows) }
    }

    pub(super) fn describe(&self) -> Vec<Text> {
        let twist = match self.shaft_twist {
            Some(_) => text!(" ({} of it twist)", Length::mm(MILLIMETRES * self.there.twist).decimals(4)),
            None => Text::default(),
        };
        let left = self.residual.map(|left| {
            text!(
                "; a residual force of {} N is left, at {}°",
                format_args!("{:.2}", left.value),
                format_args!("{:.3}", left.at.to_degrees())
            )
        });
        let all = text!(
            "the follower is up to {} low{}, at {}° of the cam under {} N{}",
            Length::mm(MILLIMETRES * self.largest.value).decimals(5),
            twist,
            format_args!("{:.3}", self.largest.at.to_degrees()),
            shown(self.there.force.round()),
            left
        );
        let mut lines = vec![all];
        for one in self.lift_errors() {
            lines.push(text!(
                "section for {} rpm: up to {} low at {}°, {} N left",
                shown(one.rpm),
                Length::mm(one.lift_error_max_mm).decimals(5),
                format_args!("{:.3}", one.lift_error_cam_deg),
                format_args!("{:.2}", one.residual_max_n)
            ));
        }
        lines
    }
}

/// Speed of a section, rpm, cam angle, degrees, and the follower there.
pub(super) type LiftErrorRow = (f64, f64, LoadedFollower);

const SPEED: &[ListedColumn<LiftErrorRow>] = &[("rpm", |row| row.0)];

const LIFT: &[ListedColumn<LiftErrorRow>] = &[
    ("cam_deg", |row| row.1),
    ("force_n", |row| row.2.force),
    ("pressure_angle_deg", |row| row.2.pressure_angle.to_degrees()),
    ("bending_mm", |row| MILLIMETRES * row.2.bending),
    ("twist_mm", |row| MILLIMETRES * row.2.twist),
    ("lift_error_mm", |row| MILLIMETRES * row.2.error()),
    ("residual_n", |row| row.2.residual),
];

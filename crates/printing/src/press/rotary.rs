//! The disc cam of a press, for one speed.

use super::balance::{allowed_error, fitting_speed, reversal_of_bed};
use super::buffer::crank_law::CrankLaw;
use super::checks::balanced::of_balance;
use super::checks::{contact_life, fixed_bottom};
use super::load::{AirBuffer, AsCut, Balance, ColumnAtSpeed, ForceBalanced, RunUp};
use super::machine::{Press, PressCams};
use super::motion::{RaiseSeries, Reversal, ReversalLaw, Transition};
use super::picture::{BufferPicture, PressPicture, not_modelled_of, press_poses};
use super::raised_disc::CutForShaft;
use super::report::ForceMeasures;
use super::smoother::smoother;
use super::{cams, loop_of_air, raised_disc, roller_life, scatter};
use crate::press::MachineOfPress;
use camgen_cams::body::disc::{Disc, Duty, Purpose};
pub use camgen_cams::body::picture::DrivenMechanism;
use camgen_cams::body::roller_bearing::LIFE;
use camgen_cams::body::{Body, Figures, Kind};
use camgen_cams::check::{Measures, Subject};
use camgen_cams::load::Load;
use camgen_cams::machine::Machine;
use camgen_cams::report::{Rolled, Section, Shaft};
use camgen_kernel::numeric::digits::three_digits_down;
use camgen_kernel::profile::Worst;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::Text;
use std::sync::Arc;

/// The disc cam of a press.
pub const ROTARY: Kind = Kind { command: "rotary", noun: "rotary cam", keys: cams::ROTARY };

/// The disc cam of a press, with its load.
#[derive(Debug, Clone)]
pub struct RotaryCam {
    /// The disc.
    pub disc: Disc,
    /// Its load.
    pub(super) buffer: Arc<AirBuffer>,
    /// Whether it is cut higher for the deflection of its shaft.
    pub(super) cut_for_shaft: bool,
}

/// The duty of the disc: the air of the cylinders is to balance the inertia of the bed.
#[derive(Debug)]
struct BedBalanceDuty {
    press: Press,
    rpm: f64,
    lever: f64,
    buffer: Arc<AirBuffer>,
    cut_for_shaft: bool,
}

/// The disc cam of a press for a speed of its main shaft, rpm: its law solved, its size found.
///
/// # Errors
/// [`Refusal`] when the motion cannot be put together or no radius keeps the limits.
pub fn rotary(machine: &Machine, rpm: f64) -> Result<RotaryCam, Refusal> {
    let train = raised_disc::for_train(machine, rpm)?;
    let cam = of_reversal(machine, rpm, train.clone())?;
    let Some(CutForShaft(shaft)) = machine.part() else { return Ok(cam) };
    let shaft = shaft
        .as_ref()
        .map_err(|why| Refusal::new(why.as_str()).context("the cam is to be cut for its shaft (shaft.compensate)"))?;
    let (angle, lever) = (machine.press()?.bottom_law(rpm).angle(), PressCams::of(machine).lever);
    let raise = raised_disc::cut_for(&cam.disc, angle, lever, shaft, train.as_deref(), |raise| {
        of_reversal(machine, rpm, Some(raise)).map(|cam| cam.disc)
    })?;
    of_reversal(machine, rpm, Some(raise)).map(|cam| RotaryCam { cut_for_shaft: true, ..cam })
}

/// With the keys that decide whether the parts of a motion fit together.
pub(super) fn with_keys_of_motion(refusal: Refusal) -> Refusal {
    refusal.remedy("see transition.width, buffer.lead and cam.cam_turns_per_crank_turn")
}

/// The disc of a press that may be cut higher than its law.
pub(super) fn of_reversal(machine: &Machine, rpm: f64, raise: Option<Arc<RaiseSeries>>) -> Result<RotaryCam, Refusal> {
    let (press, cams) = (machine.press()?, PressCams::of(machine));
    if let Some(place) = machine.follower.place {
        let (path, key) = (machine.follower.path, place.key());
        return Err(Refusal::new(format!("{path}.{key} = \"auto\" is found for the motion of `camgen make` only"))
            .remedy("give a value"));
    }
    if press.lead > 0.0 && cams.transition == Transition::None {
        let what = "a lead without a transition has a corner where the bottom begins to retreat, and no outline \
                    guides a follower round it";
        return Err(Refusal::new(what).remedy("give transition.kind = \"run-up\", or buffer.lead = \"0 mm\""));
    }
    let cut_for_shaft = machine.part::<CutForShaft>().is_some();
    let law = ReversalLaw {
        bottom_law: press.rotary_law(rpm)?,
        lever: cams.lever,
        lobes: cams.lobes,
        transition: cams.transition,
    };
    let reversal = Arc::new(Reversal::with_raise(law, raise).map_err(with_keys_of_motion)?);
    let train_gives = press.train_gives(rpm).unwrap_or(0.0);
    let buffer = Arc::new(AirBuffer::new(press.cylinder(), Arc::clone(&reversal)).on_train(train_gives));
    let duty = BedBalanceDuty { press: *press, rpm, lever: cams.lever, buffer: Arc::clone(&buffer), cut_for_shaft };
    let purpose = Purpose {
        duty: Some(Arc::new(duty)),
        load: Some(Arc::clone(&buffer) as Arc<dyn Load>),
        rpm: Some(rpm),
        speed: Some(press.bed.crank_speed(rpm) / f64::from(cams.lobes)),
    };
    Ok(RotaryCam { disc: Disc::for_purpose(machine, reversal, purpose)?, buffer, cut_for_shaft })
}

/// The disc cam of a press for a speed of its main shaft, rpm, as [`rotary`] makes it.
///
/// # Errors
/// [`Refusal`] when the motion cannot be put together or no radius keeps the limits.
pub fn disc(machine: &Machine, rpm: f64) -> Result<Disc, Refusal> {
    Ok(rotary(machine, rpm)?.disc)
}

/// A disc with its duty, for the verdicts on the balance of forces.
struct BalancedDisc<'a> {
    disc: &'a Disc,
    duty: &'a BedBalanceDuty,
}

impl ForceBalanced for BalancedDisc<'_> {
    fn balance(&self) -> Balance {
        let buffer = &self.duty.buffer;
        Balance { inertia: buffer.largest(), without_cam: buffer.residual_without_cam(), mean: false }
    }

    fn residual_of_motion(&self) -> Worst {
        self.disc.residual_max()
    }

    /// Where the bottom stays off the piston.
    fn as_cut(&self, tolerance: f64) -> Option<AsCut> {
        let machine = self.disc.machine();
        // Along the path an error is larger than along the normal.
        let lean = self.disc.pressure_angle().value;
        let lean = machine.limits.pressure_angle.map_or(lean, |limit| lean.max(limit)).min(STEEPEST);
        let per_tolerance = 1.0 / (self.duty.lever * libm::cos(lean));
        self.duty.buffer.least_air()?;
        Some(AsCut {
            speed: fitting_speed(|rpm| self.duty.allowed_error_at(rpm), self.duty.rpm, tolerance * per_tolerance),
            tolerance: 1e-6 * three_digits_down(1e6 * self.duty.allowed_error_at(self.duty.rpm) / per_tolerance),
        })
    }

    fn least_air(&self) -> Option<Worst> {
        self.duty.buffer.least_air()
    }

    fn columns(&self) -> Vec<ColumnAtSpeed> {
        vec![ColumnAtSpeed { length: self.duty.law().column(), rpm: self.duty.rpm }]
    }

    fn run_up(&self) -> Option<RunUp> {
        self.duty.buffer.run_up()
    }
}

impl BedBalanceDuty {
    /// By how much the bottom may miss the law for a speed, m; 0 without a law for it.
    fn allowed_error_at(&self, rpm: f64) -> f64 {
        self.press.rotary_law(rpm).map_or(0.0, |law| allowed_error(&self.press.cylinder(), &law))
    }

    fn law(&self) -> &CrankLaw {
        &self.buffer.reversal().law().bottom_law
    }
}

impl Duty for BedBalanceDuty {
    fn kind(&self) -> &'static Kind {
        &ROTARY
    }

    fn sections(&self, disc: &Disc) -> Vec<Section> {
        let mut sections = vec![self.buffer.section()];
        sections.extend(loop_of_air::section(disc.machine(), self.buffer.cylinder(), self.law()));
        sections.extend(reversal_of_bed(disc.machine()));
        sections.extend(raised_disc::train_section(&self.press, self.rpm, self.lever));
        sections.extend(self.cut_for_shaft.then(|| raised_disc::section(disc)));
        sections.extend(roller_life::of_disc(disc).map(|life| life.section()));
        sections.extend(scatter::section::of_cam(disc.machine(), self.rpm));
        sections
    }

    fn forces(&self, disc: &Disc, rolled: Option<&Rolled>) -> Option<Section> {
        let residual_max_n = rolled.map_or_else(|| disc.residual_max().value, |rolled| rolled.residual_max_n);
        let largest = disc.largest_force(|piece, angle| disc.path_force(piece, angle).unwrap_or(f64::NAN));
        let inertia_max_n = self.buffer.largest();
        let forces = ForceMeasures {
            inertia_max_n,
            residual_max_n,
            residual_share: residual_max_n / inertia_max_n,
            residual_fixed_bottom_max_n: self.buffer.residual_without_cam(),
            by_direction: None,
            roller_force_max_n: largest.value,
            torque_max_nm: disc.torque_max().map(|torque| torque.value),
        };
        Some(forces.section())
    }

    fn measures(&self, disc: &Disc, of: &mut Measures<'_>, subject: &Subject<'_>) {
        of_balance(&BalancedDisc { disc, duty: self }, of, subject);
        of.add(&LIFE, |_| roller_life::measure(disc));
        of.add(&contact_life::CHECK, |_| contact_life::measure(disc.contact_stress(), disc.touching(), subject));
        of.add(&fixed_bottom::LOSSES, |_| loop_of_air::measure(disc.machine(), self.buffer.cylinder(), self.law()));
    }

    fn smoother(&self, machine: &Machine) -> Option<Text> {
        smoother(machine, |press| press.rotary_law(self.rpm).into_iter().collect())
    }

    fn driven_mechanism(&self, disc: &Disc, samples: u32) -> Option<Box<dyn DrivenMechanism>> {
        let reversal = self.buffer.reversal();
        Some(Box::new(PressPicture {
            buffer: BufferPicture::new(&self.press.cylinder(), self.law()),
            poses: press_poses(reversal, &reversal.law().bottom_law, disc.curves().motion.lobes(), samples),
            lever: self.lever,
            under_a_linkage: self.press.stroke_end.is_some(),
        }))
    }

    fn not_modelled(&self, machine: &Machine) -> &'static [&'static str] {
        not_modelled_of(machine)
    }

    fn shaft(&self, disc: &Disc) -> Option<Shaft> {
        self.press.bed.shaft("camshaft", disc.curves().motion.lobes())
    }

    fn permitted_path_error(&self, _disc: &Disc) -> Option<(f64, &'static str)> {
        self.buffer.least_air()?;
        let permitted = allowed_error(&self.press.cylinder(), self.law());
        Some((self.lever * permitted, "residual force"))
    }

    fn angle_origin(&self) -> &'static str {
        "θ = 0, φ = 0"
    }
}

/// Largest pressure angle at which an error along the normal is still converted into one along the path, rad.
const STEEPEST: f64 = 1.4;

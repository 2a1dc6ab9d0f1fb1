//! The second disc of a press: its spring takes the torque that the first one needs from the camshaft.

use super::buffer::regime::{self, Reset};
use super::load::ShaftWork;
use super::machine::{CompensatorData, PressCams};
use super::rotary::RotaryCam;
use super::scatter::losses::LossyReversal;
use super::{cams, loop_of_air};
use crate::press::MachineOfPress;
use camgen_cams::body::disc::{Disc, Duty, Purpose};
use camgen_cams::body::{Body, Kind, torque};
use camgen_cams::machine::Machine;
use camgen_cams::report::{Section, Speeds, degrees, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::counter_torque::CounterMotion;
use camgen_kernel::motion::{Jet, Motion, Piece};
use camgen_kernel::numeric::extremum;
use camgen_kernel::refusal::Refusal;
use serde_json::json;
use std::sync::Arc;

/// The disc that takes the torque of the disc cam of a press.
pub const COMPENSATOR: Kind = Kind { command: "compensator", noun: "compensating cam", keys: cams::ROTARY };

fn none_described() -> Refusal {
    Refusal::new("the machine file describes no compensating cam").remedy(
        "add the table [compensator] with spring_rate and preload, or give --set compensator.spring_rate=100N/mm \
         --set compensator.preload=10kN",
    )
}

/// The refusal of a motion that is not symmetric: no spring can take the work that it leaves at the end of a turn.
fn under_a_linkage() -> Refusal {
    Refusal::new(
        "the return of the bed of this machine does not mirror its outward stroke: the air of one end gives more or less work in a turn than it \
         takes up, and a spring gives back exactly what it takes up",
    )
    .remedy("use a yoke or a crank-slider without offset (linkage.offset_ratio = 0), or leave out [compensator]")
}

/// The refusal of air that takes work in every turn.
fn of_a_loop() -> Refusal {
    Refusal::new(
        "no compensating cam fits air with a loop: it gives back less work than it takes up, and a spring gives back exactly what it takes up",
    )
    .remedy("set buffer.balance = \"braking\", or leave out [compensator]")
}

/// A jump of the velocity of less than this share of the lift a radian is rounding.
const ROUNDING: f64 = 1e-9;
/// Angles of a piece at which the residual torque of the law is evaluated: it is rounding, or the smooth torque of inertia.
const PLACES: usize = 256;
/// How far within a piece its first and last angle lie, as a share of it.
const INSET: f64 = 1e-9;
/// Angles of a piece at which torques at other speeds are evaluated; a parabola through three of them finds the top between, so that
/// the largest is reported to a millionth.
const TURN: usize = 720;
/// Cells and golden sections in which the preload for another speed is searched.
const CELLS: u32 = 8;
const SECTIONS: u32 = 40;
/// Other speeds, in sevenths of the cam's own: 20, 25 and 30 rpm of the paper's 35.
const SEVENTHS: [f64; 3] = [4.0, 5.0, 6.0];

/// The torques on a camshaft at a speed, with the column reset for it, N·m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorqueAtSpeed {
    /// Speed of the main shaft, rpm.
    pub rpm: f64,
    /// The preload with the least torque left, N.
    pub preload: f64,
    /// Largest without the compensating cam.
    pub before: f64,
    /// Largest with it, its preload as it is.
    pub unchanged: f64,
    /// Largest with it and that preload.
    pub after: f64,
}

/// Work, torques and spring force of a compensating cam by its law.
#[derive(Debug, Clone, PartialEq)]
pub struct CompensatorFigures {
    /// Work that the spring takes up and gives back, J.
    pub work: f64,
    /// Largest torque on the camshaft without it, N·m.
    pub before: f64,
    /// Largest torque on the camshaft with it, N·m.
    pub after: f64,
    /// Largest torque that the losses of the machine file leave on the camshaft, N·m; `None` where it gives none.
    pub in_losses: Option<f64>,
    /// Largest force of its spring, N.
    pub spring_force: f64,
    /// At other speeds.
    pub by_speed: Vec<TorqueAtSpeed>,
}

/// The duty of a compensating cam: to take the torque of the first.
#[derive(Debug)]
struct CounterTorqueDuty(CompensatorData);

impl Duty for CounterTorqueDuty {
    fn kind(&self) -> &'static Kind {
        &COMPENSATOR
    }

    fn mounting(&self, _machine: &Machine) -> Option<Section> {
        let data = &self.0;
        let (angle, rate) = (data.angle.to_degrees(), data.spring_rate / MILLIMETRES);
        let value = json!({"angle_deg": angle, "spring_rate_n_per_mm": rate, "preload_n": data.preload});
        let spring = format!("spring {} N/mm, preload {} N", shown(rate), shown(data.preload));
        let place = format!("its follower is at {}° from the first one", shown(angle));
        let section = Section::new("mounting", &value).with_words(vec![format!("{place}, {spring}")]);
        Some(section.with_figures(vec![place, spring]))
    }
}

impl RotaryCam {
    /// The compensating cam that the machine file describes.
    ///
    /// # Errors
    /// [`Refusal`] when none is described, its law has no solution or no radius keeps the limits.
    pub fn compensating_disc(&self) -> Result<Disc, Refusal> {
        let machine = self.disc.machine();
        let data = machine.compensator().ok_or_else(none_described)?;
        let own = data.machine_of(machine);
        let motion: Arc<dyn Motion> = Arc::new(self.counter_torque()?);
        let purpose = Purpose {
            duty: Some(Arc::new(CounterTorqueDuty(*data))),
            load: None,
            rpm: rpm_of(&self.disc),
            speed: self.disc.shaft_speed(),
        };
        Disc::for_purpose(&own, motion, purpose)
    }

    /// The law of its motion.
    fn counter_torque(&self) -> Result<CounterMotion, Refusal> {
        let machine = self.disc.machine();
        let data = machine.compensator().ok_or_else(none_described)?;
        if self.cut_for_shaft {
            return Err(Refusal::new("a compensating cam is made for a rigid shaft")
                .remedy("set shaft.compensate = false, or leave out [compensator]"));
        }
        let follower = &machine.follower;
        let (mass, speed) = follower.mass.zip(self.disc.shaft_speed()).unwrap_or((0.0, 0.0));
        if let Some(at) = self.velocity_jump().filter(|_| follower.mass.is_some()) {
            let what = "with the mass of the follower no compensating cam can take the jump of its velocity";
            return Err(Refusal::new(what)
                .at(format!("{:.3} deg", degrees(at)))
                .remedy("give transition.kind = \"run-up\", or no follower mass"));
        }
        let (cylinder, reversal) = (*self.buffer.cylinder(), Arc::clone(self.buffer.reversal()));
        let work = ShaftWork::new(cylinder, reversal, follower.preload.unwrap_or(0.0), mass, speed);
        let levels = self.buffer.reversal().law().bottom_law.half_loop().is_some();
        let work = Arc::new(work.ok_or_else(|| if levels { of_a_loop() } else { under_a_linkage() })?);
        CounterMotion::new(work, data.spring_rate, data.preload).map_err(|error| {
            error.context("no compensating cam").remedy("see compensator.spring_rate and compensator.preload")
        })
    }

    /// The first joint of the motion at which its velocity jumps.
    fn velocity_jump(&self) -> Option<f64> {
        let motion = self.disc.curves().motion;
        let pieces = motion.pieces();
        (0..pieces.len()).find_map(|index| {
            let next = (index + 1) % pieces.len();
            let (end, start) = (pieces.get(index)?.end, pieces.get(next)?.start);
            let (before, after) = (motion.jet(index, end).ds, motion.jet(next, start).ds);
            ((before - after).abs() > ROUNDING * self.disc.max_lift()).then_some(end)
        })
    }

    /// The figures of a compensating cam that is made for this one, by its law.
    ///
    /// # Errors
    /// As [`RotaryCam::compensating_disc`].
    pub fn compensated_by(&self, second: &Disc) -> Result<CompensatorFigures, Refusal> {
        let law = self.counter_torque()?;
        let (machine, buffer) = (self.disc.machine(), &self.buffer);
        let lossy = loop_of_air::reversal(machine, buffer.cylinder(), &buffer.reversal().law().bottom_law);
        let in_losses = lossy.map(|lossy| {
            let pieces = self.disc.curves().motion.distinct();
            let angles = pieces.iter().flat_map(|piece| within(piece, TURN));
            angles.map(|angle| self.torque_of_losses(&lossy, angle).abs()).fold(0.0, f64::max)
        });
        let after = second.curves().motion.distinct().iter().flat_map(|piece| within(piece, PLACES));
        Ok(CompensatorFigures {
            work: law.stored(),
            before: self.disc.torque_max().map_or(0.0, |torque| torque.value),
            after: after.map(|angle| self.torque_left(second, angle).abs()).fold(0.0, f64::max),
            in_losses,
            spring_force: law.law().spring_force(second.max_lift()),
            by_speed: self.at_other_speeds(&law, second),
        })
    }

    /// The torque of both discs on the camshaft at a cam angle, N·m.
    fn torque_left(&self, second: &Disc, angle: f64) -> f64 {
        let [one, other] =
            [&self.disc, second].map(|disc| torque::force_and_torque(disc, angle).map_or(0.0, |[_, torque]| torque));
        one + other
    }

    /// The torque on the camshaft at a cam angle by the excess of the air force, with the losses of the press, over the law's, N·m.
    fn torque_of_losses(&self, lossy: &LossyReversal, angle: f64) -> f64 {
        let motion = self.disc.curves().motion;
        let (piece, inside) = motion.locate(angle);
        let state = self.buffer.state(piece, inside);
        if !state.reversing {
            return 0.0;
        }
        let beyond = lossy.pressure(state.crank) - state.pressure_ratio;
        let lever = PressCams::of(self.disc.machine()).lever;
        self.buffer.cylinder().unit_force() * beyond / lever * motion.jet(piece, inside).ds
    }

    /// The torques at other speeds of the press, the column reset by (14): air, preload and inertia of this disc, spring and inertia
    /// of the second.
    fn at_other_speeds(&self, law: &CounterMotion, second: &Disc) -> Vec<TorqueAtSpeed> {
        let machine = self.disc.machine();
        let (Ok(press), Some(own)) = (machine.press(), rpm_of(&self.disc)) else { return Vec::new() };
        let lever = PressCams::of(machine).lever;
        let (design, cylinder) = (press.bottom_law(own), press.cylinder());
        let (lead, exponent) = (design.lead(), design.exponent());
        let (rate, own_preload) = (law.law().rate(), law.law().preload());
        let first_preload = machine.follower.preload.unwrap_or(0.0);
        let [first_inertia, second_inertia] = [&self.disc, second].map(|disc| {
            let mass = disc.machine().follower.mass.zip(disc.shaft_speed());
            mass.map_or(0.0, |(mass, speed)| mass * speed * speed)
        });
        // Where the followers are does not depend on the speed.
        let places: Vec<CamAngleState> = second
            .curves()
            .motion
            .distinct()
            .iter()
            .filter(|piece| !piece.dwell)
            .flat_map(|piece| within(piece, TURN))
            .map(|angle| CamAngleState::new(self, second, angle))
            .collect();
        // Speed, and the square of its share of the cam's own.
        let speeds: Vec<(f64, f64)> = match PressCams::of(machine).compensator_speeds.as_slice() {
            [] => SEVENTHS.map(|sevenths| (own * sevenths / 7.0, sevenths * sevenths / 49.0)).to_vec(),
            given => given.iter().map(|rpm| (*rpm, (rpm / own) * (rpm / own))).collect(),
        };
        let mut found = Vec::with_capacity(speeds.len());
        for (rpm, slower) in speeds {
            let column = regime::reset(&design, &cylinder, rpm, Reset::End).column;
            let torques: Vec<TorqueParts> = places
                .iter()
                .map(|place| {
                    let left = column - (place.overrun + lead) - place.displacement;
                    let ratio = libm::exp(exponent * libm::log(column / left));
                    let air = if place.reversing { cylinder.force(ratio) / lever } else { 0.0 };
                    let (one, two) = (place.first, place.second);
                    TorqueParts {
                        first: (air + first_preload + slower * first_inertia * one.dds) * one.ds,
                        second: (rate * two.s + slower * second_inertia * two.dds) * two.ds,
                        preload_arm: two.ds,
                    }
                })
                .collect();
            let range = (0.0, 2.0 * own_preload * slower.max(1.0));
            let best = extremum::largest_without_slope(
                |preload| -largest_torque(&torques, preload, 1.0),
                range,
                CELLS,
                SECTIONS,
            );
            found.push(TorqueAtSpeed {
                rpm,
                preload: best.at,
                before: largest_torque(&torques, 0.0, 0.0),
                unchanged: largest_torque(&torques, own_preload, 1.0),
                after: -best.value,
            });
        }
        found
    }
}

/// The torques on the camshaft at a cam angle, N·m.
struct TorqueParts {
    /// Of the first disc.
    first: f64,
    /// Of the second disc without its preload.
    second: f64,
    /// Torque of its preload, m.
    preload_arm: f64,
}

/// The largest size of the torque over the pieces, with a preload (N) of the second disc and that disc counted by a share.
fn largest_torque(torques: &[TorqueParts], preload: f64, share: f64) -> f64 {
    let left: Vec<f64> =
        torques.iter().map(|parts| parts.first + share * (parts.second + preload * parts.preload_arm)).collect();
    left.chunks(TURN + 1).flat_map(|piece| piece.windows(3)).map(top).fold(0.0, f64::max)
}

/// The largest size of three neighbouring values and of the top of the parabola through them.
fn top(three: &[f64]) -> f64 {
    let &[before, at, after] = three else { return 0.0 };
    let (slope, bend) = (0.5 * (after - before), before - 2.0 * at + after);
    let inside = at.abs() >= before.abs().max(after.abs()) && slope.abs() <= bend.abs() && bend * at < 0.0;
    if inside { (at - 0.5 * slope * slope / bend).abs() } else { before.abs().max(at.abs()).max(after.abs()) }
}

/// Equal parts of a piece from slightly after its start to slightly before its end, where the force of one disc may have jumped already and
/// the force of the other not yet.
#[expect(clippy::cast_precision_loss, reason = "a few hundred")]
fn within(piece: &Piece, parts: usize) -> impl Iterator<Item = f64> + use<> {
    let (start, whole) = (piece.start, piece.end - piece.start);
    (0..=parts).map(move |i| start + whole * (INSET + (1.0 - 2.0 * INSET) * i as f64 / parts as f64))
}

/// Where bed and followers are at a cam angle.
struct CamAngleState {
    overrun: f64,
    displacement: f64,
    reversing: bool,
    first: Jet,
    second: Jet,
}

impl CamAngleState {
    fn new(first: &RotaryCam, second: &Disc, angle: f64) -> Self {
        let [first_jet, second_jet] = [&first.disc, second].map(|disc| {
            let motion = disc.curves().motion;
            let (piece, inside) = motion.locate(angle);
            motion.jet(piece, inside)
        });
        let (piece, inside) = first.disc.curves().motion.locate(angle);
        let state = first.buffer.state(piece, inside);
        Self {
            overrun: state.overrun,
            displacement: state.displacement,
            reversing: state.reversing,
            first: first_jet,
            second: second_jet,
        }
    }
}

/// The speed of the main shaft that a disc is for, rpm.
fn rpm_of(disc: &Disc) -> Option<f64> {
    match disc.speeds() {
        Speeds::One(rpm) => Some(rpm),
        Speeds::Several(_) | Speeds::Any(()) => None,
    }
}

//! The second disc of a press: its spring takes the torque that the first one asks of the camshaft.

use super::{COMPENSATOR, Disc, DiscError};
use crate::body::Body;
use crate::buffer::regime::{self, Reset};
use crate::geometry::MILLIMETRES;
use crate::load::Load;
use crate::machine::NoPress;
use crate::motion::counter_torque::CounterMotion;
use crate::motion::{Jet, Motion, Piece};
use crate::numeric::extremum;
use crate::report::{Section, degrees, shown};
use serde_json::json;
use std::sync::Arc;

/// What a motion that is not symmetric leaves over at the end of the turn no spring can take.
const UNDER_A_LINKAGE: NoPress = NoPress::Linkage {
    what: "compensating cams are solved",
    why: "the air of one end gives a turn more work, or less, than it takes, and a spring gives back what it takes",
};

/// A jump of the velocity of less than this share of the lift a radian is rounding.
const ROUNDING: f64 = 1e-9;
/// Places of a piece at which the torque left by the law is looked at: it is rounding, or the smooth torque of inertia.
const PLACES: usize = 256;
/// How far within a piece its first and last place lie, as a share of it.
const INSET: f64 = 1e-9;
/// Places of a piece at which torques at other speeds are looked at; the top between three of them is that of their parabola, so that
/// the largest is told to a millionth.
const TURN: usize = 720;
/// Cells and golden sections in which the preload for another speed is searched.
const CELLS: u32 = 8;
const SECTIONS: u32 = 40;
/// Other speeds that are looked at, in sevenths of the cam's own: 20, 25 and 30 rpm of the paper's 35.
const SEVENTHS: [f64; 3] = [4.0, 5.0, 6.0];

/// The torques on a camshaft at a speed, with the column reset for it, N·m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AtSpeed {
    /// Speed of the main shaft, rpm.
    pub rpm: f64,
    /// The preload with which least is left, N.
    pub preload: f64,
    /// Largest without the compensating cam.
    pub before: f64,
    /// Largest with it, its preload as it is.
    pub unchanged: f64,
    /// Largest with it and that preload.
    pub after: f64,
}

/// What a compensating cam does by its law.
#[derive(Debug, Clone, PartialEq)]
pub struct Compensated {
    /// Work that the spring takes up and gives back, J.
    pub work: f64,
    /// Largest torque on the camshaft without it, N·m.
    pub before: f64,
    /// The same with it.
    pub after: f64,
    /// Largest force of its spring, N.
    pub spring_force: f64,
    /// At other speeds.
    pub by_speed: Vec<AtSpeed>,
}

impl Disc {
    /// The compensating cam that the machine file describes.
    ///
    /// # Errors
    /// [`DiscError`] when none is described, its law has no solution or no radius keeps the limits.
    pub fn compensating_disc(&self) -> Result<Self, DiscError> {
        let machine = self.machine.of_compensator().ok_or(DiscError::NoCompensator)?;
        let motion: Arc<dyn Motion> = Arc::new(self.counter_torque()?);
        let (rpm, speed) = (self.rpm, self.speed);
        Self { rpm, speed, kind: &COMPENSATOR, ..Self::unsized_of(&machine, motion) }.sized()
    }

    /// How a compensating cam stands on the shaft, and its spring.
    pub(super) fn mounting(&self) -> Option<Section> {
        let data = self.machine.compensator().filter(|_| *self.kind == COMPENSATOR)?;
        let (angle, rate) = (data.angle.to_degrees(), data.spring_rate / MILLIMETRES);
        let value = json!({"angle_deg": angle, "spring_rate_n_per_mm": rate, "preload_n": data.preload});
        let spring = format!("spring {} N/mm, preload {} N", shown(rate), shown(data.preload));
        let place = format!("its follower stands at {}° from the first one", shown(angle));
        let section = Section::new("mounting", &value).with_words(vec![format!("{place}, {spring}")]);
        Some(section.with_figures(vec![place, spring]))
    }

    /// The law of its motion.
    fn counter_torque(&self) -> Result<CounterMotion, DiscError> {
        let data = self.machine.compensator().ok_or(DiscError::NoCompensator)?;
        let load = self.load.as_ref().ok_or(NoPress::None)?;
        if self.raised {
            return Err(DiscError::CompensatorOnShaft);
        }
        let follower = &self.machine.follower;
        let mass = follower.mass.zip(self.speed).unwrap_or((0.0, 0.0));
        if let Some(at) = self.velocity_jump().filter(|_| follower.mass.is_some()) {
            return Err(DiscError::Blow { cam_deg: degrees(at) });
        }
        let work = load.shaft_work(follower.preload.unwrap_or(0.0), mass).ok_or(UNDER_A_LINKAGE)?;
        Ok(CounterMotion::new(work, data.spring_rate, data.preload)?)
    }

    /// The first joint of the motion at which its velocity jumps.
    fn velocity_jump(&self) -> Option<f64> {
        let pieces = self.motion.pieces();
        let jump = |index: usize| {
            let next = (index + 1) % pieces.len();
            let (end, start) = (pieces.get(index)?.end, pieces.get(next)?.start);
            let (before, after) = (self.motion.jet(index, end).ds, self.motion.jet(next, start).ds);
            ((before - after).abs() > ROUNDING * self.max_lift()).then_some(end)
        };
        (0..pieces.len()).find_map(jump)
    }

    /// What a compensating cam, made for this one, does by its law.
    ///
    /// # Errors
    /// As [`Disc::compensating_disc`].
    pub fn compensated_by(&self, second: &Disc) -> Result<Compensated, DiscError> {
        let law = self.counter_torque()?;
        let left = |angle: f64| {
            let torque = |disc: &Disc| disc.force_and_torque(angle).map_or(0.0, |[_, torque]| torque);
            (torque(self) + torque(second)).abs()
        };
        let after = second.motion.distinct().iter().flat_map(|piece| within(piece, PLACES));
        Ok(Compensated {
            work: law.stored(),
            before: self.torque_max().map_or(0.0, |torque| torque.value),
            after: after.map(left).fold(0.0, f64::max),
            spring_force: law.law().spring_force(second.max_lift()),
            by_speed: self.at_other_speeds(&law, second),
        })
    }

    /// The torques at other speeds of the press, the column reset by (14): air, preload and inertia of this disc, spring and inertia
    /// of the second.
    fn at_other_speeds(&self, law: &CounterMotion, second: &Disc) -> Vec<AtSpeed> {
        let (Ok(press), Some(own), Some(load)) = (self.machine.press(), self.rpm, &self.load) else {
            return Vec::new();
        };
        let (design, cylinder) = (press.bottom_law(own), press.cylinder());
        let Some(law_of_x) = design.of_yoke() else { return Vec::new() };
        let (rate, own_preload) = (law.law().rate(), law.law().preload());
        let inertia = |disc: &Disc| {
            let mass = disc.machine.follower.mass.zip(disc.speed);
            mass.map_or(0.0, |(mass, speed)| mass * speed * speed)
        };
        let (first_preload, masses) = (self.machine.follower.preload.unwrap_or(0.0), (inertia(self), inertia(second)));
        // Where the followers are does not depend on the speed.
        let places: Vec<AtPlace> = second
            .motion
            .distinct()
            .iter()
            .filter(|piece| !piece.dwell)
            .flat_map(|piece| within(piece, TURN))
            .map(|angle| AtPlace::of(self, second, &**load, angle))
            .collect();
        let at = |sevenths: f64| {
            let rpm = own * sevenths / 7.0;
            let (column, slower) =
                (regime::reset(&design, &cylinder, rpm, Reset::End).column, sevenths * sevenths / 49.0);
            // What does not depend on the preload of the second disc, with and without that disc, and the slope the preload works on.
            let torques: Vec<(f64, f64, f64)> = places
                .iter()
                .map(|place| {
                    let left = column - (place.overrun + law_of_x.lead) - place.displacement;
                    let ratio = libm::exp(law_of_x.exponent * libm::log(column / left));
                    let air = if place.reversing { cylinder.force(ratio) / self.machine.cam.lever } else { 0.0 };
                    let (one, two) = (place.first, place.second);
                    let alone = (air + first_preload + slower * masses.0 * one.dds) * one.ds;
                    (alone, (rate * two.s + slower * masses.1 * two.dds) * two.ds, two.ds)
                })
                .collect();
            let largest = |preload: f64, share: f64| {
                let left: Vec<f64> =
                    torques.iter().map(|(alone, two, slope)| alone + share * (two + preload * slope)).collect();
                let of_piece = |left: &[f64]| left.windows(3).map(top).fold(0.0, f64::max);
                left.chunks(TURN + 1).map(of_piece).fold(0.0, f64::max)
            };
            let range = (0.0, 2.0 * own_preload);
            let best = extremum::largest_without_slope(|preload| -largest(preload, 1.0), range, CELLS, SECTIONS);
            let (before, unchanged) = (largest(0.0, 0.0), largest(own_preload, 1.0));
            AtSpeed { rpm, preload: best.at, before, unchanged, after: -best.value }
        };
        SEVENTHS.into_iter().map(at).collect()
    }
}

/// The largest size of three neighbouring values, or that of the top of the parabola through them.
fn top(three: &[f64]) -> f64 {
    let &[before, at, after] = three else { return 0.0 };
    let (slope, bend) = (0.5 * (after - before), before - 2.0 * at + after);
    let inside = at.abs() >= before.abs().max(after.abs()) && slope.abs() <= bend.abs() && bend * at < 0.0;
    if inside { (at - 0.5 * slope * slope / bend).abs() } else { before.abs().max(at.abs()).max(after.abs()) }
}

/// Equal parts of a piece from a hair behind its start to a hair before its end, where the force of one disc may have jumped already and
/// that of the other not yet.
fn within(piece: &Piece, parts: usize) -> impl Iterator<Item = f64> + use<> {
    let (start, whole) = (piece.start, piece.end - piece.start);
    #[expect(clippy::cast_precision_loss, reason = "a few hundred")]
    let place = move |i: usize| start + whole * (INSET + (1.0 - 2.0 * INSET) * i as f64 / parts as f64);
    (0..=parts).map(place)
}

/// Where bed and followers are at a cam angle.
struct AtPlace {
    overrun: f64,
    displacement: f64,
    reversing: bool,
    first: Jet,
    second: Jet,
}

impl AtPlace {
    fn of(first: &Disc, second: &Disc, load: &dyn Load, angle: f64) -> Self {
        let jet = |disc: &Disc| {
            let (piece, inside) = disc.motion.locate(angle);
            disc.motion.jet(piece, inside)
        };
        let (piece, inside) = first.motion.locate(angle);
        let state = load.state(piece, inside);
        Self {
            overrun: state.overrun,
            displacement: state.displacement,
            reversing: state.reversing,
            first: jet(first),
            second: jet(second),
        }
    }
}

//! The belt brake of a paper roll: a belt that a weight presses on the roll's surface, and the web tension it makes.
//!
//! The belt's inner run lies on the roll between two pulleys of a rigid frame. The frame is hinged at O and carries a weight G; it
//! follows the roll as that runs down from its largest radius. The belt slips, is at rest, or runs slower than the web. The source is an
//! article by Chekhman on printing machines, of which only the text survives, without the figures; its equations are numbered (1)–(15).
//!
//! Axes: the roll's axis is the origin, x to the right, y up. Pulleys p1 (right) and p2 (left) of radius ρ, frame turned by θ from its
//! place at the largest radius; a is the wrap, q1 and q2 are the arms of the two spans about O, h1 that of the weight, h2 that of the
//! bisector of the spans. With ε1 = e^(a f) − 1, T in the slack span and T (1 + ε1) in the tight one, the moments about O give
//!
//! ```text
//! P = T ε1 = G h1 ε1/((1 + ε1) q_t + q_s)                the web tension                       [`Brake::tension`]
//! dθ/dR = a/(q1 + q2),   q1 + q2 = 2 h2 sin(a/2)         the belt's length does not change
//! ```
//!
//! The tight span is the one the roll's surface comes from: the left one where the roll turns clockwise.
//!
//! # Errors of the paper
//!
//! 1. **(1) leaves out the power that the belt carries away.** P V is heat P (V − V_z) and the power P V_z of the belt's drive, and
//!    the moments about the roll's axis give P = T ε1 at any speed of the belt. The factor 1 − V_z/V in (2), (6), (8)–(10) is right for
//!    a standing belt only: at V_z/V = 0.8 the weight of (8) brakes five times too hard. A slipping belt's speed regulates nothing;
//!    [`ends`] keeps the paper's numbers.
//! 2. **(3) takes both spans as equally tight** and loses the moment of the friction about O: [`Brake::tension_printed`], with
//!    K = tanh(a f/2)/sin(a/2) of (7). For the brake of the tests that is 5 % of the weight.
//! 3. **Friction outweighs the geometry.** d ln P/d ln f is af/sinh(af) = 0.96…0.99 by the printed moment: from 0.25 to 0.30 the
//!    tension rises by a fifth, where the wrap costs 7 %. See [`FramePose::sensitivity`]; no frame removes this, [`synthesis`] finds those
//!    that depend on it least.
//! 4. **(13), (14) are of first order** and leave out the strain wound into the roll: [`strain`].
//!
//! The belt's own mass acts on both spans alike and drops out of P. [`holding`] is what a disc on the frame's shaft must add so that P
//! stays constant over the whole roll. SI throughout, radians.

mod belt;
pub mod ends;
mod error;
pub mod holding;
mod path;
pub mod strain;
pub mod synthesis;

pub use error::{BrakeError, Pulley, turned_too_far};
pub use holding::{DiscWork, TensionHolding};
pub use strain::Web;

use belt::{Belt, BeltState};
use camgen_kernel::refusal::Refusal;
use error::{finite, millimetres, positive, shrinking};
use path::Grip;

/// Steps of the radius from the largest to the smallest, at least.
const STATIONS: u32 = 64;

/// The direction in which the roll turns, seen in the axes of the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RollRotation {
    /// The left span is the tight one.
    Clockwise,
    /// The right span is the tight one.
    CounterClockwise,
}

/// The hinged frame at the largest radius of the roll; coordinates from the roll's axis, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BrakeFrame {
    /// O.
    pub pivot: [f64; 2],
    /// p1, at the end of the wrap with the smaller angle.
    pub right_pulley: [f64; 2],
    /// p2.
    pub left_pulley: [f64; 2],
    /// Centre of gravity of frame and weight together.
    pub centre_of_gravity: [f64; 2],
    /// ρ of both pulleys, to the middle of the belt; above 0.
    pub pulley_radius: f64,
}

/// The roll, to the middle of the belt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaperRoll {
    /// R1, m.
    pub largest_radius: f64,
    /// R2, m; above 0, below R1.
    pub smallest_radius: f64,
}

/// A brake that follows its roll from the largest radius to the smallest.
#[derive(Debug, Clone, PartialEq)]
pub struct Brake {
    frame: BrakeFrame,
    roll: PaperRoll,
    rotation: RollRotation,
    grip: Grip,
    belt: Belt,
    /// Largest radius first, the last at the smallest or just below.
    places: Vec<BeltState>,
}

/// The frame at one radius. Arms are about the pivot, m: positive where they turn the frame as a span under tension (q) or the
/// weight (h1) does in an ordinary brake, q against the weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FramePose {
    /// R, m.
    pub radius: f64,
    /// θ, rad, counter-clockwise; 0 at the largest radius.
    pub theta: f64,
    /// a, rad.
    pub wrap: f64,
    /// Arm of the weight, m.
    pub h1: f64,
    /// Arm of the bisector of the spans, m.
    pub h2: f64,
    /// Arm of the tight span, m; negative where friction presses the belt on.
    pub q_tight: f64,
    /// Arm of the slack span, m.
    pub q_slack: f64,
    /// Arm of the right span, m.
    pub q1: f64,
    /// Arm of the left span, m.
    pub q2: f64,
    /// K of (7) with the brake's friction.
    pub k: f64,
    /// dθ/dR, rad/m.
    pub theta_by_radius: f64,
}

impl FramePose {
    /// q_t + (q_t + q_s)/ε1, m: moment about the pivot over web tension. Not above 0 where the brake jams.
    fn resisting_arm(&self, friction: f64) -> f64 {
        self.q_tight + (self.q_tight + self.q_slack) / libm::expm1(self.wrap * friction)
    }

    /// S_f = d ln P/d ln f: by how many per cent a per cent of friction raises the tension; negative where it jams.
    #[must_use]
    pub fn sensitivity(&self, friction: f64) -> f64 {
        let grip = self.wrap * friction;
        let more = libm::expm1(grip);
        grip / more * (1.0 + 1.0 / more) * (self.q_tight + self.q_slack) / self.resisting_arm(friction)
    }

    /// f_lock = ln(−q_s/q_t)/a: the friction at which the brake jams; `None` where it never jams.
    #[must_use]
    pub fn locking_friction(&self) -> Option<f64> {
        // ln(−q_s/q_t) = ln(1 + (q_t + q_s)/(−q_t)), and q_t + q_s > 0.
        let over = (self.q_tight + self.q_slack) / -self.q_tight;
        (self.q_tight < 0.0).then(|| libm::log1p(over) / self.wrap)
    }
}

fn check_inputs(frame: &BrakeFrame, roll: &PaperRoll, friction: f64) -> Result<(), Refusal> {
    let places = [
        ("pivot", frame.pivot),
        ("right pulley", frame.right_pulley),
        ("left pulley", frame.left_pulley),
        ("centre of gravity", frame.centre_of_gravity),
    ];
    for (name, place) in places {
        place.into_iter().try_for_each(|value| finite(name, value))?;
    }
    let lengths = [
        ("pulley radius", frame.pulley_radius),
        ("largest radius", roll.largest_radius),
        ("smallest radius", roll.smallest_radius),
    ];
    lengths.into_iter().chain([("friction", friction)]).try_for_each(|(name, value)| positive(name, value))?;
    shrinking(roll)
}

impl Brake {
    /// The brake, followed from the largest radius to the smallest.
    ///
    /// # Errors
    /// A number out of its range, or the first limit of the movement, with its radius: a pulley meets the roll, the belt
    /// leaves it, the frame comes to a dead point, the brake jams, the weight lifts the belt.
    pub fn new(frame: BrakeFrame, roll: PaperRoll, friction: f64, rotation: RollRotation) -> Result<Self, BrakeError> {
        Self::with_stations(frame, roll, friction, rotation, STATIONS)
    }

    fn with_stations(
        frame: BrakeFrame,
        roll: PaperRoll,
        friction: f64,
        rotation: RollRotation,
        stations: u32,
    ) -> Result<Self, BrakeError> {
        check_inputs(&frame, &roll, friction)?;
        let (belt, first) = Belt::new(&frame, roll.largest_radius)?;
        let grip = Grip { friction, left_is_tight: rotation == RollRotation::Clockwise };
        let places = path::walk(&belt, first, grip, roll, stations)?;
        Ok(Self { frame, roll, rotation, grip, belt, places })
    }

    /// The frame, as given.
    #[must_use]
    pub fn frame(&self) -> &BrakeFrame {
        &self.frame
    }

    /// The roll, as given.
    #[must_use]
    pub fn roll(&self) -> &PaperRoll {
        &self.roll
    }

    /// The rotation, as given.
    #[must_use]
    pub fn rotation(&self) -> RollRotation {
        self.rotation
    }

    /// f, as given.
    #[must_use]
    pub fn friction(&self) -> f64 {
        self.grip.friction
    }

    /// ℓ = R' a + S1 + S2, m: the belt between the points where it leaves the pulleys, less what it gains on them as they turn.
    #[must_use]
    pub fn belt_length(&self) -> f64 {
        self.belt.length
    }

    /// Right pulley, left pulley and centre of gravity in this position of the frame, m from the roll's axis.
    #[must_use]
    pub fn parts(&self, pose: &FramePose) -> [[f64; 2]; 3] {
        let parts = self.belt.parts(pose.theta.abs());
        [parts.right.into(), parts.left.into(), (self.belt.pivot + parts.centre).into()]
    }

    /// The frame at a radius of the roll, m.
    ///
    /// # Errors
    /// A radius outside the roll; or a limit of the movement between two stations, found at neither of them.
    pub fn at(&self, radius: f64) -> Result<FramePose, BrakeError> {
        Ok(self.pose(&self.place(radius)?))
    }

    fn place(&self, radius: f64) -> Result<BeltState, BrakeError> {
        let PaperRoll { largest_radius: largest, smallest_radius: smallest } = self.roll;
        let after = self.places.partition_point(|place| place.radius >= radius);
        let before = after.checked_sub(1).and_then(|index| self.places.get(index));
        let Some(before) = before.filter(|_| radius >= smallest && radius <= largest) else {
            let [radius, smallest, largest] = [radius, smallest, largest].map(millimetres);
            return Err(Refusal::new(format!("a radius of {radius} mm is outside the roll"))
                .remedy(format!("it must be within {smallest}…{largest} mm"))
                .into());
        };
        let Some(behind) = self.places.get(after) else { return Ok(*before) };
        let guess = before.turn + (radius - before.radius) / before.radius_by_turn();
        let place = self.belt.at_radius(radius, before.turn, behind.turn, guess)?;
        self.grip.check(place, smallest)
    }

    fn pose(&self, place: &BeltState) -> FramePose {
        let (q_tight, q_slack) = self.grip.arms(place);
        FramePose {
            radius: place.radius,
            theta: -self.belt.side * place.turn,
            wrap: place.wrap,
            h1: place.weight_arm,
            h2: 0.5 * place.both_arms() / libm::sin(0.5 * place.wrap),
            q_tight,
            q_slack,
            q1: place.right_arm,
            q2: place.left_arm,
            k: ends::euler_coefficient(place.wrap, self.grip.friction),
            theta_by_radius: -self.belt.side / place.radius_by_turn(),
        }
    }

    /// Web tension, N, with a weight, N, on the slipping belt; its speed does not matter.
    #[must_use]
    pub fn tension(&self, weight: f64, pose: &FramePose) -> f64 {
        tension_of_moment(weight * pose.h1, pose, self.grip.friction)
    }

    /// Web tension, N, with a weight, N, and another friction.
    ///
    /// # Errors
    /// A friction that is not above 0; [`BrakeError::Jams`] where the brake locks with it.
    pub fn tension_with(&self, weight: f64, pose: &FramePose, friction: f64) -> Result<f64, BrakeError> {
        self.tension_under(weight * pose.h1, pose, friction)
    }

    /// Web tension, N, under a moment about the pivot, N·m, from weight, springs and discs together; a negative one lifts the belt.
    ///
    /// # Errors
    /// As [`Self::tension_with`].
    pub fn tension_under(&self, moment: f64, pose: &FramePose, friction: f64) -> Result<f64, BrakeError> {
        positive("friction", friction)?;
        if !(pose.resisting_arm(friction) > 0.0) {
            return Err(BrakeError::Jams { radius: pose.radius, friction });
        }
        Ok(tension_of_moment(moment, pose, friction))
    }

    /// Web tension, N, by the paper's moment G h1 = 2 T_o h2 sin(a/2), which takes both spans as equally tight: G (h1/h2) K, of
    /// a standing belt.
    #[must_use]
    pub fn tension_printed(&self, weight: f64, pose: &FramePose) -> f64 {
        weight * pose.h1 / pose.h2 * pose.k
    }

    /// Web tension, N, by the paper's moment, with another friction.
    #[must_use]
    pub fn tension_printed_with(&self, weight: f64, pose: &FramePose, friction: f64) -> f64 {
        weight * pose.h1 / pose.h2 * ends::euler_coefficient(pose.wrap, friction)
    }

    /// Weight, N, that makes a web tension, N, in this position of the frame.
    #[must_use]
    pub fn weight_for(&self, tension: f64, pose: &FramePose) -> f64 {
        self.moment_for(tension, pose) / pose.h1
    }

    /// Weight, N, that makes a web tension, N, by the printed moment.
    #[must_use]
    pub fn weight_for_printed(&self, tension: f64, pose: &FramePose) -> f64 {
        tension * pose.h2 / (pose.h1 * pose.k)
    }

    /// Moment about the pivot, N·m, that makes a web tension, N.
    #[must_use]
    pub fn moment_for(&self, tension: f64, pose: &FramePose) -> f64 {
        tension * pose.resisting_arm(self.grip.friction)
    }

    /// Tension of the slack span and of the tight one, N, at a web tension, N.
    #[must_use]
    pub fn belt_tensions(&self, tension: f64, pose: &FramePose) -> (f64, f64) {
        let slack = tension / libm::expm1(pose.wrap * self.grip.friction);
        (slack, slack + tension)
    }
}

fn tension_of_moment(moment: f64, pose: &FramePose, friction: f64) -> f64 {
    moment / pose.resisting_arm(friction)
}

#[cfg(test)]
mod tests;

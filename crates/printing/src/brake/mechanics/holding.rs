//! The torque that a disc on the frame's shaft must add to keep the web tension constant over the whole roll.
//!
//! The frame turns the disc by Θ = i φ, φ = |θ|. With the wanted tension P_n and the weight G it lacks the moment
//!
//! ```text
//! M(φ) = P_n (q_t + (q_t + q_s)/ε1) − G h1,   τ = M/i = dE/dΘ,   E = ∫ τ dΘ = ∫ M dφ from the largest radius
//! ```
//!
//! which a spring gives back over the disc (the counter-torque law of `motion::counter_torque`, with E, τ, τ', τ''). M is elementary in
//! R and φ; its derivatives along the roll are exact, by power series with dR/dφ = −(q1 + q2)/a. E is Gauss–Legendre between the
//! stations of the walk.
//!
//! The disc takes the radius out, not the friction: with another friction the tension is different, but still nearly constant over the roll
//! (`roll` of the tests, made for 0.25: with 0.30 it is 362.4 and 362.6 N at the ends of the roll, 363.4 N between).

use super::belt::{BeltState, turned};
use super::error::{finite, positive};
use super::{Brake, BrakeError, FramePose, turned_too_far};
use camgen_kernel::numeric::quadrature;
use camgen_kernel::numeric::series::PowerSeries;
use nalgebra::Vector2;
use std::f64::consts::TAU;
use std::sync::OnceLock;

/// A tension to hold with a disc, and the work of the disc for that.
#[derive(Debug, Clone)]
pub struct TensionHolding {
    brake: Brake,
    weight: f64,
    tension: f64,
    ratio: f64,
    /// φ at the smallest radius, rad.
    turn: f64,
    /// E at the stations of the brake's walk, J, once they are needed.
    energies: OnceLock<Vec<f64>>,
}

/// Work and torque of the disc on the frame by its angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscWork {
    /// E, J.
    pub energy: f64,
    /// τ = dE/dΘ, N·m.
    pub torque: f64,
    /// dτ/dΘ, N·m/rad.
    pub torque_slope: f64,
    /// d²τ/dΘ², N·m/rad².
    pub torque_second: f64,
}

/// A point of the plane as series.
type SeriesPoint = [PowerSeries<3>; 2];

fn along(a: SeriesPoint, b: SeriesPoint) -> PowerSeries<3> {
    let ([ax, ay], [bx, by]) = (a, b);
    ax * bx + ay * by
}

/// β and O·N of the span at a pulley, with R' = `inner`; `hand` is 1 for the right pulley, −1 for the left.
fn span(pulley: SeriesPoint, pivot: SeriesPoint, inner: PowerSeries<3>, hand: f64) -> (PowerSeries<3>, PowerSeries<3>) {
    let [x, y] = pulley;
    let square = along(pulley, pulley);
    let length = (square - inner * inner).sqrt();
    let across = along(pivot, [-y, x]) * length * hand;
    (length.atan2(inner), (along(pivot, pulley) * inner + across) / square)
}

/// The moment and the change of the radius as series along the roll.
struct MomentSeries {
    /// −(q1 + q2)/a.
    radius_by_turn: PowerSeries<3>,
    moment: PowerSeries<3>,
}

impl TensionHolding {
    /// The disc for a tension, N, in addition to a weight, N, that may be 0, with `turns_per_frame_turn` = i.
    ///
    /// # Errors
    /// Numbers out of their ranges, and a disc that would turn by a whole turn or more, with the largest i.
    pub fn new(brake: Brake, weight: f64, tension: f64, turns_per_frame_turn: f64) -> Result<Self, BrakeError> {
        positive("tension", tension)?;
        positive("turns per frame turn", turns_per_frame_turn)?;
        finite("weight", weight)?;
        let turn = brake.place(brake.roll.smallest_radius)?.turn;
        if !(turns_per_frame_turn * turn < TAU) {
            return Err(turned_too_far(turns_per_frame_turn, turn).into());
        }
        Ok(Self { brake, weight, tension, ratio: turns_per_frame_turn, turn, energies: OnceLock::new() })
    }

    /// E at the stations of the brake's walk, J.
    fn energies(&self) -> &[f64] {
        self.energies.get_or_init(|| {
            let steps = self.brake.places.windows(2).map(|pair| match pair {
                [from, to] => self.work_between(from, to.turn),
                _ => 0.0,
            });
            let mut energy = 0.0;
            let sums = steps.map(|step| {
                energy += step;
                energy
            });
            std::iter::once(0.0).chain(sums).collect()
        })
    }

    /// τ at an angle Θ of the disc, N·m, which is taken into 0…total.
    ///
    /// # Errors
    /// As [`Self::stand_at`].
    pub fn torque(&self, angle: f64) -> Result<f64, BrakeError> {
        Ok(self.moment(&self.stand_at(angle)?) / self.ratio)
    }

    /// The brake.
    #[must_use]
    pub fn brake(&self) -> &Brake {
        &self.brake
    }

    /// The tension it holds, N.
    #[must_use]
    pub fn tension(&self) -> f64 {
        self.tension
    }

    /// Θ at the smallest radius, rad; below a whole turn.
    #[must_use]
    pub fn total_angle(&self) -> f64 {
        self.ratio * self.turn
    }

    /// i.
    #[must_use]
    pub fn turns_per_frame_turn(&self) -> f64 {
        self.ratio
    }

    /// M, N·m: the moment that the disc must add to the moment of the weight.
    #[must_use]
    pub fn moment(&self, pose: &FramePose) -> f64 {
        self.brake.moment_for(self.tension, pose) - self.weight * pose.h1
    }

    /// Web tension, N, with a torque of the disc on itself, N·m, and a friction, for example as cut.
    ///
    /// # Errors
    /// As [`Brake::tension_with`].
    pub fn tension_with(&self, torque: f64, pose: &FramePose, friction: f64) -> Result<f64, BrakeError> {
        self.brake.tension_under(self.weight * pose.h1 + self.ratio * torque, pose, friction)
    }

    /// Θ at a radius of the roll, m.
    ///
    /// # Errors
    /// As [`Brake::at`].
    pub fn angle_at(&self, radius: f64) -> Result<f64, BrakeError> {
        Ok(self.ratio * self.brake.place(radius)?.turn)
    }

    /// The frame at an angle Θ of the disc, which is taken into 0…total.
    ///
    /// # Errors
    /// A limit of the movement between two stations, found at neither of them.
    pub fn stand_at(&self, angle: f64) -> Result<FramePose, BrakeError> {
        let (_, place) = self.located(angle)?;
        Ok(self.brake.pose(&place))
    }

    /// R at an angle Θ of the disc, m.
    ///
    /// # Errors
    /// As [`Self::stand_at`].
    pub fn radius_at(&self, angle: f64) -> Result<f64, BrakeError> {
        Ok(self.located(angle)?.1.radius)
    }

    /// E, τ, τ', τ'' at an angle Θ of the disc, which is taken into 0…total.
    ///
    /// # Errors
    /// As [`Self::stand_at`].
    pub fn at(&self, angle: f64) -> Result<DiscWork, BrakeError> {
        let (station, place) = self.located(angle)?;
        let from = self.brake.places.get(station).unwrap_or(&place);
        let energy = self.energies().get(station).copied().unwrap_or(0.0) + self.work_between(from, place.turn);
        let [moment, slope, half_second] = self.along(&place).moment.0;
        let i = self.ratio;
        Ok(DiscWork {
            energy,
            torque: moment / i,
            torque_slope: slope / (i * i),
            torque_second: 2.0 * half_second / (i * i * i),
        })
    }

    /// The last station before an angle, and the belt there.
    fn located(&self, angle: f64) -> Result<(usize, BeltState), BrakeError> {
        let turn = (angle / self.ratio).clamp(0.0, self.turn);
        let places = &self.brake.places;
        let station = places.partition_point(|place| place.turn <= turn).saturating_sub(1);
        let smallest = self.brake.roll.smallest_radius;
        let none = BrakeError::NotReached { radius: smallest, smallest };
        let from = places.get(station).ok_or(none)?;
        let place = if from.turn == turn { *from } else { self.place_from(from, turn)? };
        Ok((station, self.brake.grip.check(place, smallest)?))
    }

    fn place_from(&self, from: &BeltState, turn: f64) -> Result<BeltState, BrakeError> {
        self.brake.belt.at_turn(turn, from.radius + (turn - from.turn) * from.radius_by_turn())
    }

    /// ∫ M dφ from a station to a turn within its step, J.
    fn work_between(&self, from: &BeltState, turn: f64) -> f64 {
        // Within a step of the walk the belt has a solution at every turn.
        quadrature::integrate(
            |turn| self.place_from(from, turn).map_or(f64::NAN, |place| self.moment(&self.brake.pose(&place))),
            (from.turn, turn),
            1,
        )
    }

    /// M as a series in φ at one radius of the roll. R is first known to its slope only, from which the slope of M follows.
    fn along(&self, place: &BeltState) -> MomentSeries {
        let slope = place.radius_by_turn();
        let [_, bend, _] = self.series(PowerSeries([place.radius, slope, 0.0]), place.turn).radius_by_turn.0;
        self.series(PowerSeries([place.radius, slope, 0.5 * bend]), place.turn)
    }

    /// The formulas of `belt` on series.
    fn series(&self, radius: PowerSeries<3>, turn: f64) -> MomentSeries {
        let belt = &self.brake.belt;
        let (left, right, pivot) = (
            self.part(belt.left, turn),
            self.part(belt.right, turn),
            [belt.pivot.x, belt.pivot.y].map(PowerSeries::constant),
        );
        let ([lx, ly], [rx, ry], [ox, oy]) = (left, right, pivot);
        let (left, right) = ([ox + lx, oy + ly], [ox + rx, oy + ry]);
        let inner = radius + belt.pulley_radius;
        let (angle1, on1) = span(right, pivot, inner, 1.0);
        let (angle2, on2) = span(left, pivot, inner, -1.0);
        let [ax, ay] = right;
        let [bx, by] = left;
        let wrap = (ax * by - ay * bx).atan2(ax * bx + ay * by) - angle1 - angle2;
        let PowerSeries([value, first, second]) = wrap;
        let wrap = PowerSeries([if value < 0.0 { value + TAU } else { value }, first, second]);
        let (q1, q2) = ((radius - on1) * belt.side, (on2 - radius) * belt.side);
        let (tight, slack) = if self.brake.grip.left_is_tight { (q2, q1) } else { (q1, q2) };
        let more = (wrap * self.brake.grip.friction).exp_m1();
        let [weight_arm, _] = self.part(belt.centre, turn);
        let resisting = tight + (tight + slack) / more;
        MomentSeries {
            radius_by_turn: -(q1 + q2) / wrap,
            moment: resisting * self.tension - weight_arm * (self.weight * belt.side),
        }
    }

    /// A part of the frame, from the pivot, as a series in φ: d/dφ turns it by a right angle, clockwise with the pivot on the left.
    fn part(&self, part: Vector2<f64>, turn: f64) -> SeriesPoint {
        let side = self.brake.belt.side;
        let part = turned(part, -side * turn);
        let (x, y) = (part.x, part.y);
        [PowerSeries([x, side * y, -0.5 * x]), PowerSeries([y, -side * x, -0.5 * y])]
    }
}

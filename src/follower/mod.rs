//! Followers: cam angle and lift to the path of the roller's centre, seen from the cam.
//!
//! A follower gives the pitch curve with exact derivatives and the direction in which it is driven. What follows from
//! those (normal, curvature, pressure angle, profile) is the same for every follower and is derived once, in `cam`.

mod bell_crank;
mod translating_roller;

pub use bell_crank::BellCrank;
pub use translating_roller::TranslatingRoller;

use crate::law::Jet;
use nalgebra::Vector2;

/// The pitch curve at a value of the law's parameter, m and rad, in the frame of the cam: the cam angle θ of a disc, the
/// overrun x of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pitch {
    /// Centre of the roller.
    pub point: Vector2<f64>,
    /// First derivative by the parameter.
    pub first: Vector2<f64>,
    /// Second derivative by the parameter.
    pub second: Vector2<f64>,
    /// Third derivative by the parameter.
    pub third: Vector2<f64>,
    /// Unit vector of the roller's path on the machine.
    pub drive: Vector2<f64>,
    /// Derivative of the angle of `drive` by the parameter.
    pub drive_turn: f64,
}

/// A follower whose roller rides outside the cam.
pub trait Follower: Send + Sync {
    /// The pitch curve at a value of the parameter for the lift there.
    fn pitch(&self, parameter: f64, lift: &Jet) -> Pitch;

    /// The parameter at which the centre of the roller stands at a point seen from the cam: the inverse of the pitch
    /// curve, whatever the lift. NaN for a point the roller never gets to.
    fn parameter_of(&self, centre: Vector2<f64>) -> f64;

    /// Radius of the roller, m.
    fn roller_radius(&self) -> f64;
}

impl<F: Follower + ?Sized> Follower for &F {
    fn pitch(&self, parameter: f64, lift: &Jet) -> Pitch {
        (**self).pitch(parameter, lift)
    }

    fn parameter_of(&self, centre: Vector2<f64>) -> f64 {
        (**self).parameter_of(centre)
    }

    fn roller_radius(&self) -> f64 {
        (**self).roller_radius()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Each derivative of the pitch curve against the central difference of the one before.
    #[test]
    fn derivatives_belong_to_their_points() {
        let lift = |angle: f64| Jet {
            s: 0.02 * (1.0 + libm::sin(2.0 * angle)),
            ds: 0.04 * libm::cos(2.0 * angle),
            dds: -0.08 * libm::sin(2.0 * angle),
            ddds: -0.16 * libm::cos(2.0 * angle),
        };
        let crank = BellCrank {
            roller_arm: 0.3,
            bottom_arm: 0.2,
            delta: 1.3,
            lowest: -0.05,
            axis_distance: 0.06,
            roller_radius: 0.02,
        };
        let followers: [Box<dyn Follower>; 3] = [
            Box::new(TranslatingRoller::new(0.1, 0.0, 0.02)),
            Box::new(TranslatingRoller::new(0.1, -0.03, 0.02)),
            Box::new(crank),
        ];
        let h = 1e-3;
        for follower in followers {
            for i in 0..60 {
                let angle = 0.1 * f64::from(i);
                let at = |n: f64| follower.pitch(angle + n * h, &lift(angle + n * h));
                let difference = |f: fn(&Pitch) -> Vector2<f64>| {
                    ((f(&at(1.0)) - f(&at(-1.0))) * 8.0 - (f(&at(2.0)) - f(&at(-2.0)))) / (12.0 * h)
                };
                let here = at(0.0);
                assert!((here.first - difference(|p| p.point)).norm() < 1e-11);
                assert!((here.second - difference(|p| p.first)).norm() < 1e-11);
                assert!((here.third - difference(|p| p.second)).norm() < 1e-11);
                let back = follower.parameter_of(here.point) - angle;
                assert!((back - (back / TAU).round() * TAU).abs() < 1e-14, "{back}");
                let turn = difference(|p| p.drive);
                assert!((here.drive.perp(&turn) - here.drive_turn).abs() < 1e-11);
            }
        }
    }
}

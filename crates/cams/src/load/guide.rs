//! Friction in the guide of a follower on a straight path.
//!
//! The cam presses with N along its normal, at the pressure angle α from the path, under a face at the distance p from the axis of the stem. Two bearings, b apart,
//! the nearer one q from the foot of the stem, take the force across the path and the moment N p about the foot:
//!
//! ```text
//! R2 = N (p + q h)/b,   R1 = −N h − R2,   h = −sin α
//! ```
//!
//! With p = 0 the two are N sin|α| (1 + 2 q/b) together. Friction μ (|R1| + |R2|) is against the travel: while the follower is lifted,
//! N [cos α − μ (|R1| + |R2|)/N] is the force along its path, and where the bracket is not above 0 it jams.

use crate::machine::GuideData;

/// Friction over the force along the normal, μ (|R1| + |R2|)/N, with the contact at a distance from the axis of the stem, m.
#[must_use]
pub fn friction(guide: &GuideData, pressure_angle: f64, off_axis: f64) -> f64 {
    let across = -libm::sin(pressure_angle);
    let far = (off_axis + guide.overhang * across) / guide.span;
    guide.friction * (far.abs() + (across + far).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The reactions by the balance of forces and moments about the far bearing, which the formula does not use.
    #[test]
    fn reactions_balance_force_and_moment() {
        let guide = GuideData { friction: 0.2, span: 0.06, overhang: 0.025 };
        for (angle, off_axis) in [(0.4_f64, 0.0), (-0.4, 0.0), (0.0, 0.012), (-0.15, 0.01), (0.2, -0.02)] {
            // Contact at T·beside from the foot, pressed along the normal, which is at −α from the path.
            let (along, across) = (angle.cos(), -angle.sin());
            let (at_along, at_across) = (across * -off_axis, along * off_axis);
            let moment_about_far = (at_along - guide.overhang - guide.span) * across - at_across * along;
            let near = moment_about_far / guide.span;
            let far = -across - near;
            let expected = guide.friction * (near.abs() + far.abs());
            assert!((friction(&guide, angle, off_axis) - expected).abs() < 1e-15, "{angle} {off_axis}: {expected}");
        }
        let centred = friction(&guide, 0.4, 0.0);
        assert!((centred - 0.2 * 0.4_f64.sin() * (1.0 + 2.0 * 0.025 / 0.06)).abs() < 1e-16);
    }
}

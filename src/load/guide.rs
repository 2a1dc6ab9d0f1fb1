//! Friction in the guide of a follower on a straight path.
//!
//! The cam presses with N along its normal, at the pressure angle α from the path, p beside the stem under a face. Two bearings, b apart,
//! the nearer one q from the foot of the stem, take what is across the path and the moment N p about the foot:
//!
//! ```text
//! R2 = N (p + q h)/b,   R1 = −N h − R2,   h = −sin α
//! ```
//!
//! With p = 0 the two are N sin|α| (1 + 2 q/b) together. Friction μ (|R1| + |R2|) is against the travel: while the follower is lifted,
//! N [cos α − μ (|R1| + |R2|)/N] is what it bears, and where the bracket is not above 0 it jams.

use crate::machine::GuideData;

/// Friction over the force along the normal, μ (|R1| + |R2|)/N, with the contact so far beside the stem, m.
#[must_use]
pub fn friction(guide: &GuideData, pressure_angle: f64, beside: f64) -> f64 {
    let across = -libm::sin(pressure_angle);
    let far = (beside + guide.overhang * across) / guide.span;
    guide.friction * (far.abs() + (across + far).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The reactions by the balance of forces and moments about the far bearing, which the formula does not use.
    #[test]
    fn reactions_balance_force_and_moment() {
        let guide = GuideData { friction: 0.2, span: 0.06, overhang: 0.025 };
        for (angle, beside) in [(0.4_f64, 0.0), (-0.4, 0.0), (0.0, 0.012), (-0.15, 0.01), (0.2, -0.02)] {
            // Contact at T·beside from the foot, pressed along the normal, which stands at −α from the path.
            let (along, across) = (angle.cos(), -angle.sin());
            let (at_along, at_across) = (across * -beside, along * beside);
            let moment_about_far = (at_along - guide.overhang - guide.span) * across - at_across * along;
            let near = moment_about_far / guide.span;
            let far = -across - near;
            let expected = guide.friction * (near.abs() + far.abs());
            assert!((friction(&guide, angle, beside) - expected).abs() < 1e-15, "{angle} {beside}: {expected}");
        }
        let centred = friction(&guide, 0.4, 0.0);
        assert!((centred - 0.2 * 0.4_f64.sin() * (1.0 + 2.0 * 0.025 / 0.06)).abs() < 1e-16);
    }
}

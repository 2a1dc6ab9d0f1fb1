//! The modified sine law: the acceleration rises and ends as a sine over an eighth of the way each, and falls as a slower sine
//! between.

use super::{Law, Values};
use std::f64::consts::PI;

pub(super) const LAW: Law =
    Law { name: "modified-sine", formula: "s'' = A sin(4 pi x), then A cos(4 pi (x - 1/8)/3)", continuity: 2, at };

/// Where the two sines of the first half meet.
const JOINT: f64 = 1.0 / 8.0;
/// Largest acceleration: 4π²/(4 + π), so that the travel is 1.
const PEAK: f64 = 4.0 * PI * PI / (4.0 + PI);
/// Angular speeds of the quick and the slow sine.
const QUICK: f64 = 4.0 * PI;
const SLOW: f64 = 4.0 * PI / 3.0;

fn at(x: f64) -> Values {
    // The later half is the earlier one turned round, so that both ends keep their digits.
    if x > 0.5 {
        let [value, velocity, acceleration, jerk] = first_half(1.0 - x);
        [1.0 - value, velocity, -acceleration, jerk]
    } else {
        first_half(x)
    }
}

fn first_half(x: f64) -> Values {
    if x <= JOINT {
        let (sin, cos) = (libm::sin(QUICK * x), libm::cos(QUICK * x));
        let half = libm::sin(0.5 * QUICK * x);
        let value = super::turn_minus_sine(QUICK * x) / (QUICK * QUICK);
        return [PEAK * value, PEAK * 2.0 * half * half / QUICK, PEAK * sin, PEAK * QUICK * cos];
    }
    // From the joint on, where v = A/4π and s = A (π/2 − 1)/(4π)².
    let t = x - JOINT;
    let (sin, cos) = (libm::sin(SLOW * t), libm::cos(SLOW * t));
    let half = libm::sin(0.5 * SLOW * t);
    let start = (0.5 * PI - 1.0) / (QUICK * QUICK) + t / QUICK;
    [
        PEAK * (start + 2.0 * half * half / (SLOW * SLOW)),
        PEAK * (1.0 / QUICK + sin / SLOW),
        PEAK * cos,
        -PEAK * SLOW * sin,
    ]
}

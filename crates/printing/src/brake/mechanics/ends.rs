//! The paper's own sizing from the two ends of the roll: (6)–(10).
//!
//! Kept for comparison. Each formula holds for a stationary belt, V_z = 0; for a running belt it is wrong, because the
//! power P V_z that the belt carries to its drive is left out of (1). `n` is the full roll, `k` the empty one.
//!
//! ```text
//! (7)  K = (e^(af) − 1)/((e^(af) + 1) cos((π − a)/2)) = tanh(af/2)/sin(a/2)
//! (8)  N_n = (G h1/h2)_n = P/(K_n (1 − V_zn/V))
//! (9)  (V_z/V)_k = 1 − P/(K_k N_k)
//! (10) V_zk − V_zn = P V (K_k N_k − K_n N_n)/(K_k N_k K_n N_n)
//! ```

//!
//! | the paper says | computed | verdict |
//! |---|---|---|
//! | K over a wrap of 45…90° changes "within 7 %" | f 0.25: 0.255722 → 0.274166, 6.73 % of the start; f 0.30: 6.34 % | holds |
//! | the belt's speed range is "not beyond 15 %" with the press force 7 % lower | 15.28 % (f 0.25), 14.81 % (f 0.30) of the starting slip 1 − V_zn/V | holds as a share of the slip; of V it is 3.06 % at a slip of 0.2 |
//! | K rises with the wrap (figure 2) | d ln K/da = f/sinh(af) − ½ cot(a/2) > 0, K → f as a → 0 | holds |
//! | the press force stays "about the same" | a hinged frame in round numbers (`roll`): K falls by 1.8 %, the arms take 17 %; the tension falls by 18.6 % by the printed moment (f 0.25, its own weight), by 18.9 % by the exact one | of the same order as its 15 % |

use super::error::{millimetres, positive};
use camgen_kernel::refusal::Refusal;
use std::f64::consts::TAU;

/// K of (7), for a wrap a, rad, between 0 and 2π: web tension of a standing belt over the press force G h1/h2. It goes to f as a
/// goes to 0.
#[must_use]
pub fn euler_coefficient(wrap: f64, friction: f64) -> f64 {
    libm::tanh(0.5 * wrap * friction) / libm::sin(0.5 * wrap)
}

/// The wraps at both ends of the roll, without a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollEnds {
    friction: f64,
    press_ratio: f64,
    full: f64,
    empty: f64,
}

/// The regulation by (8)–(10).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Regulation {
    /// N_n of (8), N.
    pub press_full: f64,
    /// N_k, N.
    pub press_empty: f64,
    /// V_zn/V, as given.
    pub belt_speed_full: f64,
    /// (V_z/V)_k of (9); negative where the belt would have to run backwards.
    pub belt_speed_empty: f64,
    /// (V_zk − V_zn)/V of (10): negative, the belt must run slower at the end.
    pub range: f64,
}

impl RollEnds {
    /// Wraps of the full and of the empty roll, rad, friction, and the ratio of the press forces, empty roll / full roll.
    ///
    /// # Errors
    /// [`Refusal`] unless both are between 0 and 2π, and the others above 0.
    pub fn new(wraps: [f64; 2], friction: f64, press_ratio: f64) -> Result<Self, Refusal> {
        positive("friction", friction)?;
        positive("press ratio", press_ratio)?;
        for wrap in wraps {
            if !(wrap > 0.0 && wrap < TAU) {
                return Err(Refusal::new(format!("the wrap is {} deg", millimetres(wrap.to_degrees()) / 1e3))
                    .remedy("it must be above 0 and below 360 deg"));
            }
        }
        let [full, empty] = wraps;
        Ok(Self { friction, press_ratio, full, empty })
    }

    /// Wraps of the full and of the empty roll, rad.
    #[must_use]
    pub fn wraps(&self) -> [f64; 2] {
        [self.full, self.empty]
    }

    /// K_n and K_k.
    #[must_use]
    pub fn coefficients(&self) -> (f64, f64) {
        (euler_coefficient(self.full, self.friction), euler_coefficient(self.empty, self.friction))
    }

    /// K_n N_n/(K_k N_k) − 1: the range of (10) as a share of the starting slip 1 − V_zn/V. The paper's "15 %" is this, not a
    /// share of V.
    #[must_use]
    pub fn range_of_slip(&self) -> f64 {
        let (full, empty) = self.coefficients();
        (full - empty * self.press_ratio) / (empty * self.press_ratio)
    }

    /// (8)–(10) for a web tension P, N, and the starting slip 1 − V_zn/V, above 0 and at most 1.
    ///
    /// # Errors
    /// [`Refusal`] where either of them is not above 0.
    pub fn regulation(&self, tension: f64, slip: f64) -> Result<Regulation, Refusal> {
        positive("tension", tension)?;
        positive("starting slip", slip)?;
        let (full, empty) = self.coefficients();
        let press_full = tension / (full * slip);
        let press_empty = self.press_ratio * press_full;
        Ok(Regulation {
            press_full,
            press_empty,
            belt_speed_full: 1.0 - slip,
            belt_speed_empty: 1.0 - tension / (empty * press_empty),
            range: -slip * self.range_of_slip(),
        })
    }
}

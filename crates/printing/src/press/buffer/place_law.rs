//! The bed and its air as functions of the position of the bed, for a plate on the bed.
//!
//! A plate follows the overrun x of the bed alone, so the deceleration has to be one function a(x) of it. It is under a
//! yoke, a = x, and under a crank-slider without offset ([`InLine`]), whose return mirrors its outward motion.
//!
//! # Why no other linkage moves a plate
//!
//! Any other linkage brakes the bed otherwise than it brings it back. With the crank angle t from the dead point,
//! x_d − x = c₂ t² + c₃ t³ + …, and so near the dead point
//!
//! ```text
//! a = 2 c₂ + 6 c₃ t + … = 2 c₂ ∓ 6 c₃ √((x_d − x)/c₂) + …,   − while the bed is braked, + on the return
//! ```
//!
//! A plate that is right while the bed is braked follows that root. The curvature of its flank grows without bound towards the dead
//! point, so that no roller can follow it there, and on the return its force is off by twice the root.
//!
//! The mean of the two ways, (a_out + a_back)/2, is even in t and therefore smooth in x at the dead point. But it does not begin with
//! either reversal: at x = 0, where the bed begins to be braked, it is half of the deceleration of the return there, and a column that is
//! closed there has no pressure against it; (18) then requires Δx ~ √x. Closed at the zero of the mean, between the two ends of the
//! reversal, the column would balance the mean and leave |a_out − a_back|/2 in either direction without any friction: 2.5 % of the largest
//! inertia for the six-bar 0.1, 0.8, 0.6 at λ5 = 3, and 1.3 % (outer end) and 2.9 % (inner end) for a crank-slider with λ6 = 0.1 and
//! λ5 = 3. That is a law with a start and two paces of its own; [`PlaceLaw::new`] refuses such a linkage.

use super::PlainBuffer;
use super::bottom_law::BottomLaw;
use super::crank_law::{CrankLaw, fixed_column};
use crate::press::bed_motion::{InLine, StrokeEnd};
use std::f64::consts::{FRAC_PI_2, PI};

/// A law of the bottom under a bed whose deceleration depends on its position alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaceLaw {
    law: CrankLaw,
    /// A crank-slider without offset, which holds the bed all the time. Under a yoke x = r sin φ in the reversal, and before it the bed
    /// runs at constant speed.
    in_line: Option<InLine>,
}

impl From<BottomLaw> for PlaceLaw {
    fn from(law: BottomLaw) -> Self {
        Self { law: law.into(), in_line: None }
    }
}

impl PlaceLaw {
    /// `None` where the linkage brakes the bed otherwise than it brings it back.
    #[must_use]
    pub fn new(law: CrankLaw) -> Option<Self> {
        let in_line = match &law {
            CrankLaw::Yoke(_) => None,
            CrankLaw::Linkage(law) => Some(law.end.by_place()?),
        };
        Some(Self { law, in_line })
    }

    /// Motion of the bed as a function of its position and of the crank angle; `None` under a yoke.
    fn moved(&self) -> Option<(&InLine, &StrokeEnd)> {
        match &self.law {
            CrankLaw::Yoke(_) => None,
            CrankLaw::Linkage(law) => Some((self.in_line.as_ref()?, &law.end)),
        }
    }

    /// The law by the crank angle, with its cylinder and its fixed bottom.
    #[must_use]
    pub fn by_crank(&self) -> &CrankLaw {
        &self.law
    }

    /// A, 1/m.
    #[must_use]
    pub fn loading(&self) -> f64 {
        self.law.loading()
    }

    /// Polytropic exponent k.
    #[must_use]
    pub fn exponent(&self) -> f64 {
        self.law.exponent()
    }

    /// Column L, m.
    #[must_use]
    pub fn column(&self) -> f64 {
        self.law.column()
    }

    /// Overrun at the dead point, m.
    #[must_use]
    pub fn stroke(&self) -> f64 {
        self.law.stroke()
    }

    /// c − 1 with c = L A κ/k, κ = da/dx at x = 0.
    #[must_use]
    pub fn start_slope(&self) -> f64 {
        self.law.start_slope()
    }

    /// Motion of the bed as a function of its position; `None` under a yoke, where a = x.
    #[must_use]
    pub fn in_line(&self) -> Option<&InLine> {
        self.in_line.as_ref()
    }

    /// Deceleration a of the bed over the square of the crank speed at an overrun in [0, `stroke`], m.
    #[must_use]
    pub fn deceleration(&self, x: f64) -> f64 {
        self.in_line.map_or(x, |in_line| in_line.deceleration(x))
    }

    /// The first three derivatives of the overrun by the crank angle on the outward motion, also before the reversal, m.
    #[must_use]
    pub fn pace(&self, x: f64) -> [f64; 3] {
        let r = self.stroke();
        match self.in_line {
            Some(in_line) => {
                let speed = in_line.speed(x);
                [speed, -in_line.deceleration(x), -in_line.slope(x) * speed]
            }
            None if x < 0.0 => [r, 0.0, 0.0],
            None if x == 0.0 => [r, 0.0, -r],
            None => {
                let speed = ((r - x) * (r + x)).max(0.0).sqrt();
                [speed, -x, -speed]
            }
        }
    }

    /// Square of the speed of the bed, m²/s², and its deceleration, m/s², at a speed of the crank, rad/s.
    #[must_use]
    pub fn by_time(&self, x: f64, crank_speed: f64) -> [f64; 2] {
        let square = crank_speed * crank_speed;
        if let Some(in_line) = self.in_line {
            let speed = in_line.speed(x);
            [square * speed * speed, square * in_line.deceleration(x)]
        } else {
            let (r, over) = (self.stroke(), x.max(0.0));
            [square * (r - over) * (r + over), square * over]
        }
    }

    /// Crank angle from the start of the reversal to the dead point, rad.
    #[must_use]
    pub fn dead(&self) -> f64 {
        self.moved().map_or(FRAC_PI_2, |(_, end)| end.dead())
    }

    /// Crank angle before the reversal in which the bed moves one way, rad; a yoke lets it go.
    #[must_use]
    pub fn before(&self) -> f64 {
        self.moved().map_or(f64::INFINITY, |(_, end)| PI - end.dead())
    }

    /// Overrun of the bed at a crank angle up to the dead point, m; negative before the reversal.
    #[must_use]
    pub fn overrun(&self, crank: f64) -> f64 {
        match self.moved() {
            Some((_, end)) => end.at(crank).x[0],
            None if crank < 0.0 => self.stroke() * crank,
            None => self.stroke() * libm::sin(crank),
        }
    }

    /// The crank angle before the reversal at which the bed passes a position (m, at most 0), or where it turns back if it does not reach it.
    #[must_use]
    pub fn crank_before(&self, place: f64) -> f64 {
        match self.moved() {
            Some((_, end)) => end.ahead(-place).map_or(-self.before(), |[before, _]| before),
            None => place / self.stroke(),
        }
    }

    /// Air over 2 p0 F at an overrun of a plain buffer with a fixed bottom and its column by (7).
    #[must_use]
    pub fn air_of_fixed_bottom(&self, x: f64) -> f64 {
        match &self.law {
            CrankLaw::Yoke(law) => PlainBuffer::new(law.loading, law.exponent, law.stroke).air(x),
            CrankLaw::Linkage(law) => {
                let column = fixed_column(law.loading, law.exponent, &law.end);
                libm::expm1(-law.exponent * libm::log1p(-x / column))
            }
        }
    }
}

#[cfg(test)]
mod tests;

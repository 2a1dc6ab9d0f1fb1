//! The crank-slider whose line passes its shaft: the motion of the bed as a function of its position.
//!
//! Without offset the return mirrors the outward motion, so that the deceleration is one function of the position. With X = O2D and the rod λ
//! over the crank O2C, the triangle O2–C–D gives cos β = (X² − D)/(2X) and X − cos β = (X² + D)/(2X), D = λ² − 1, and from these
//!
//! ```text
//! −X'' = X (1 − 8 D λ² X²/(X² + D)³),   X' = −√[(1 − cos β)(1 + cos β)] · 2 X²/(X² + D)
//! ```
//!
//! rational in X, and so smooth up to the dead point and past it. In rods, T = X/λ and D = 1 − 1/λ², so that nothing grows with λ. At
//! the start T_a of a reversal −X'' = 0; taken out as a factor, the overrun x remains exact there:
//!
//! ```text
//! a/x = T (T + T_a) (V² + V V_a + V_a² − 8 D)/V³,   V = T² + D
//! ```

use super::{End, Linkage, StrokeEnd};
use camgen_kernel::numeric::series::tape::TapeNumber;
use std::ops::{Add, Div, Mul};

/// The bed of a crank-slider without offset at an end of its stroke, by its overrun x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InLine {
    /// Length of the crank O2C, m.
    radius: f64,
    /// Length of the rod, m.
    rod: f64,
    /// +1 at the outer end, −1 at the inner one.
    sign: f64,
    /// O2D at the start of the reversal over the rod.
    start: f64,
    /// D in rods.
    height: f64,
    /// Overrun at the dead point, m.
    stroke: f64,
}

impl StrokeEnd {
    /// Motion of the bed as a function of its position; `None` unless a crank-slider without offset moves it: any other linkage but the yoke brakes it
    /// otherwise than it brings it back.
    #[must_use]
    pub fn by_place(&self) -> Option<InLine> {
        let Linkage::CrankSlider(slider) = self.linkage() else { return None };
        if !self.symmetric() {
            return None;
        }
        let sign = match self.end() {
            End::Outer => 1.0,
            End::Inner => -1.0,
        };
        let rod = slider.rod_ratio * self.radius();
        let height = (1.0 - 1.0 / slider.rod_ratio) * (1.0 + 1.0 / slider.rod_ratio);
        let start = sign * self.place() / rod;
        Some(InLine { radius: self.radius(), rod, sign, start, height, stroke: self.stroke() })
    }
}

impl InLine {
    /// T at an overrun, m.
    fn place(&self, x: f64) -> f64 {
        self.start + self.sign * x / self.rod
    }

    /// Deceleration a over the square of the crank speed at an overrun (m), m; negative before the reversal.
    #[must_use]
    pub fn deceleration(&self, x: f64) -> f64 {
        x * self.share_at(self.place(x))
    }

    /// da/dx.
    #[must_use]
    pub fn slope(&self, x: f64) -> f64 {
        let (t, d) = (self.place(x), self.height);
        let (square, v) = (t * t, t * t + d);
        1.0 - 24.0 * d * square * (d - square) / (v * v * v * v)
    }

    /// Speed of the bed on its way out per crank speed, m/rad; 0 beyond the stroke of the slider.
    #[must_use]
    pub fn speed(&self, x: f64) -> f64 {
        // sin²β = δ (2 − δ) ((X + λ)² − 1)/(4 X²), δ the travel to the dead point in cranks.
        let (t, left) = (self.place(x), (self.stroke - x) / self.radius);
        let heron = left * (2.0 - left) * ((t + 1.0) * (t + 1.0) - (1.0 - self.height));
        self.radius * heron.max(0.0).sqrt() * t / (t * t + self.height)
    }

    /// a/x as a series of the overrun in units of this many metres.
    #[must_use]
    pub fn share<'t>(&self, x: TapeNumber<'t>, unit: f64) -> TapeNumber<'t> {
        self.share_at(x * (self.sign * unit / self.rod) + self.start)
    }

    /// a/x at T, of numbers and of series.
    fn share_at<T>(&self, t: T) -> T
    where
        T: Copy + Add<Output = T> + Add<f64, Output = T> + Mul<Output = T> + Div<Output = T>,
    {
        let d = self.height;
        let (v, start) = (t * t + d, self.start * self.start + d);
        t * (t + self.start) * (v * (v + start) + (start * start - 8.0 * d)) / (v * v * v)
    }
}

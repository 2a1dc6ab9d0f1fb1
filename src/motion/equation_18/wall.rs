//! Where equation (18) has no solution, and why.

/// A wall: a place beyond which no plate solves (18).
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Wall {
    /// No slope to start with.
    #[error(
        "equation (18) has no starting slope: with delta {delta_deg:.3} deg and friction angle {friction_deg:.3} deg \
         the flank jams at once; a smaller translating.friction_angle or a translating.delta nearer 90 deg would avoid it"
    )]
    NoStart {
        /// Δ, degrees.
        delta_deg: f64,
        /// ρ, degrees.
        friction_deg: f64,
    },
    /// sin(θ−α) → 0.
    #[error(
        "the slope of the bottom grows without bound near x = {x_mm:.6} mm (sin(θ−α) → 0: the roller's path lies along \
         the flank); a smaller translating.friction_angle, a better efficiency or a longer buffer.column would avoid it"
    )]
    Slope {
        /// Overrun, mm.
        x_mm: f64,
    },
    /// sin θ → 0.
    #[error(
        "the roller moves along the bed's line at x = {x_mm:.6} mm (sin θ → 0), where no flank moves it; a \
         translating.delta nearer 90 deg or a longer translating.bottom_arm would avoid it"
    )]
    Line {
        /// Overrun, mm.
        x_mm: f64,
    },
    /// |Δx| → l2.
    #[error(
        "the bottom's arm is used up at x = {x_mm:.6} mm (|Δx| → {arm_mm:.3} mm); a longer translating.bottom_arm would \
         avoid it"
    )]
    Arm {
        /// Overrun, mm.
        x_mm: f64,
        /// l2, mm.
        arm_mm: f64,
    },
    /// L − x − Δx → 0.
    #[error("the air column is used up at x = {x_mm:.6} mm (x + Δx → L); a longer buffer.column would avoid it")]
    Column {
        /// Overrun, mm.
        x_mm: f64,
    },
    /// sin[θ−(α+ρ)] → 0.
    #[error(
        "the flank jams at x = {x_mm:.6} mm (sin[θ−(α+ρ)] → 0 in (18)); a smaller translating.friction_angle, a \
         smaller arm of the bottom against the roller's, or `--solver ode` would avoid it"
    )]
    Jam {
        /// Overrun, mm.
        x_mm: f64,
    },
    /// x + Δx → 0.
    #[error(
        "the bottom gives way as fast as the bed comes near x = {x_mm:.6} mm (x + Δx → 0), and equation (18) is too stiff \
         to be followed; a longer buffer.column would avoid it"
    )]
    Stiff {
        /// Overrun, mm.
        x_mm: f64,
    },
    /// Too many steps, for none of the reasons above.
    #[error(
        "equation (18) could not be continued past x = {x_mm:.6} mm: the bottom moves too steeply there; a longer \
         translating.bottom_arm, a smaller translating.friction_angle or a longer buffer.column would avoid it"
    )]
    Unnamed {
        /// Overrun, mm.
        x_mm: f64,
    },
}

//! The bed over a reversal, for a buffer whose bottom is where it is: by a yoke or by a linkage.
//!
//! What the air does depends on the load u = A a alone, a the deceleration of the bed, since x + Δx of an exact cam does. The linkage enters by
//! the load at a crank angle, by the position of a load, and by what a phase error moves. Under a yoke, a = x, the return mirrors the outward motion.

use crate::press::buffer::crank_law::{CrankLaw, LinkageLaw};
use camgen_kernel::numeric::root;
use std::f64::consts::{FRAC_PI_2, PI};

/// The motion of the bed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "there is one for a cam, which is copied as a whole")]
pub enum BedPath {
    /// x = r sin φ.
    Yoke {
        /// A, 1/m.
        loading: f64,
        /// r, m.
        stroke: f64,
    },
    /// At one end of the stroke of a linkage, with the law of the cam.
    Linkage(LinkageLaw),
}

impl BedPath {
    /// A, 1/m.
    #[must_use]
    pub fn loading(&self) -> f64 {
        match self {
            Self::Yoke { loading, .. } => *loading,
            Self::Linkage(law) => law.loading,
        }
    }

    /// Overrun at the dead point, m: r under a yoke.
    #[must_use]
    pub fn stroke(&self) -> f64 {
        match self {
            Self::Yoke { stroke, .. } => *stroke,
            Self::Linkage(law) => law.end.stroke(),
        }
    }

    /// Crank angle of the dead point from the start of the reversal, rad.
    #[must_use]
    pub fn dead(&self) -> f64 {
        match self {
            Self::Yoke { .. } => FRAC_PI_2,
            Self::Linkage(law) => law.end.dead(),
        }
    }

    /// Crank angle that the reversal takes, rad.
    #[must_use]
    pub fn whole(&self) -> f64 {
        match self {
            Self::Yoke { .. } => PI,
            Self::Linkage(law) => law.end.angle(),
        }
    }

    /// Crank angle up to which the reversal is evaluated, rad: the braking half if the other one mirrors it.
    #[must_use]
    pub fn reach(&self) -> f64 {
        match self {
            Self::Yoke { .. } => FRAC_PI_2,
            Self::Linkage(law) => law.end.angle(),
        }
    }

    /// Crank angle at which the load is largest, rad.
    #[must_use]
    pub fn peak(&self) -> f64 {
        match self {
            Self::Yoke { .. } => FRAC_PI_2,
            Self::Linkage(law) => law.end.largest_deceleration().at,
        }
    }

    /// The leak whose share is lost by the dead point: the load integrated up to there, A x'(0).
    #[must_use]
    pub fn load_by_dead(&self) -> f64 {
        match self {
            Self::Yoke { .. } => self.loading() * self.stroke(),
            Self::Linkage(law) => law.loading * law.end.at(0.0).x[1],
        }
    }

    /// Load u at a crank angle of the reversal.
    #[must_use]
    pub fn load_at(&self, angle: f64) -> f64 {
        match self {
            Self::Yoke { loading, stroke } => {
                let (end, braking) = (loading * stroke, if angle > FRAC_PI_2 { PI - angle } else { angle });
                if braking == FRAC_PI_2 { end } else { end * libm::sin(braking) }
            }
            Self::Linkage(law) => law.loading * law.end.at(angle).deceleration()[0].max(0.0),
        }
    }

    /// du/dφ at a crank angle of the reversal.
    #[must_use]
    pub fn load_slope(&self, angle: f64) -> f64 {
        match self {
            Self::Yoke { .. } => self.loading() * self.stroke() * libm::cos(angle),
            Self::Linkage(law) => law.loading * law.end.at(angle).deceleration()[1],
        }
    }

    /// Overrun at a crank angle of the reversal, m.
    #[must_use]
    pub fn overrun_at(&self, angle: f64) -> f64 {
        match self {
            Self::Yoke { stroke, .. } => stroke * libm::sin(angle),
            Self::Linkage(law) => law.end.at(angle).x[0],
        }
    }

    /// Overrun where the growing load reaches a value, m.
    #[must_use]
    pub fn overrun_of(&self, load: f64) -> f64 {
        match self {
            Self::Yoke { loading, .. } => load / loading,
            Self::Linkage(law) => {
                let angle = CrankLaw::Linkage(*law).where_decelerated(load / law.loading);
                law.end.at(angle).x[0]
            }
        }
    }

    /// Crank angle of the way back with the overrun of one of the way in; the end of the reversal where it is not reached.
    #[must_use]
    pub fn returning(&self, braking: f64) -> f64 {
        match self {
            Self::Yoke { .. } => PI - braking,
            Self::Linkage(law) if law.end.symmetric() => law.end.angle() - braking,
            Self::Linkage(law) => {
                let (x, end) = (law.end.at(braking).x[0], law.end.angle());
                root::bracketed(|angle| law.end.at(angle).x[0] - x, law.end.dead(), end, 0.0).unwrap_or(end)
            }
        }
    }

    /// Crank angle of the way in with the overrun of one of the way back; the start of the reversal where it is not reached.
    #[must_use]
    pub fn outgoing(&self, back: f64) -> f64 {
        match self {
            Self::Yoke { .. } => PI - back,
            Self::Linkage(law) if law.end.symmetric() => law.end.angle() - back,
            Self::Linkage(law) => {
                let x = law.end.at(back).x[0];
                root::bracketed(|angle| law.end.at(angle).x[0] - x, 0.0, law.end.dead(), 0.0).unwrap_or(0.0)
            }
        }
    }
}

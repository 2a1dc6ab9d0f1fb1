//! Why a machine that differs has no figures.

use camgen_kernel::refusal::Refusal;
use thiserror::Error;

/// Why there is no residual force, or no setting of the screw.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ScatterError {
    /// The piston would reach the bottom: w + t ≤ 0.
    #[error("column used up: the piston reaches the bottom, {short_mm:.3} mm before the end of the stroke")]
    ColumnUsedUp {
        /// Length of the air at the end of the stroke, mm, at most 0, with its sign changed.
        short_mm: f64,
    },
    /// No position of the screw gives the end pressure: Y ≤ f, or L + ΔL ≤ 0.
    #[error(
        "no column balances the end: the air has {share:.4} of its mass, and the end of the stroke needs more than {needed:.4}"
    )]
    NoColumn {
        /// The ratio f.
        share: f64,
        /// The ratio Y, or what leaves no air.
        needed: f64,
    },
    /// Air that came back on a smaller exponent would give work.
    #[error(
        "expansion exponent below the compression's: {expansion} is below {compression}, and the air would give work"
    )]
    ExpansionBelowCompression {
        /// κ2.
        expansion: f64,
        /// κ1.
        compression: f64,
    },
    /// The loop of the air has no width: the length of the air at the start of the reversal is not below that where the port shuts.
    #[error(
        "no lead for this loop: the air expands on the exponent {expansion} and is compressed on {compression}, and buffer.balance = \"level\" has \
         nothing to halve"
    )]
    NoLead {
        /// κ1.
        compression: f64,
        /// κ2.
        expansion: f64,
    },
    /// The train gives way faster than the bed comes: c_t ≤ m ω².
    #[error("train too soft: its {stiffness} N/m do not exceed the {needed:.0} N/m of the bed, m ω²")]
    TrainTooSoft {
        /// c_t, N/m.
        stiffness: f64,
        /// m ω², N/m.
        needed: f64,
    },
}

impl From<ScatterError> for Refusal {
    fn from(why: ScatterError) -> Self {
        let remedy = match why {
            ScatterError::ColumnUsedUp { .. } => {
                "give a `column` and a `lead` of the machine that differs which are nearer to 0 (--fault), or smaller bands (--vary, [scatter])"
            }
            ScatterError::ExpansionBelowCompression { compression, .. } => {
                return Self::of(why).remedy(format!("give a buffer.expansion_exponent of {compression} or more"));
            }
            ScatterError::NoLead { compression, .. } => {
                return Self::of(why).remedy(format!(
                    "give a buffer.expansion_exponent above {compression}, or buffer.balance = \"braking\": against friction and leak alone that law leaves least already"
                ));
            }
            ScatterError::TrainTooSoft { .. } => {
                "give a stiffer cam.train_stiffness: that at the bottoms of both cylinders"
            }
            ScatterError::NoColumn { .. } => {
                "give a smaller loss of air or a smaller closing pressure (--fault, --vary)"
            }
        };
        Self::of(why).remedy(remedy)
    }
}

//! The press: the motion of its cams and the forces on them.

use crate::press::bed_motion::{End, Linkage, StrokeEnd};
use crate::press::buffer::bottom_law::{BottomLaw, ColumnRule};
use crate::press::buffer::crank_law::{self, CrankLaw, LinkageLaw};
use crate::press::buffer::{Bed, Cylinder, camshaft};
use crate::press::scatter::error::ScatterError;
use camgen_kernel::refusal::Refusal;

/// The tables that describe a press together.
pub(super) const PRESS: &[&str] = &["bed", "buffer", "design"];
/// The table of a drive, which has no end pressure.
pub(super) const DRIVE: &str = "drive";

/// The linkage of a machine file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkageData {
    /// The linkage, its links over their cranks.
    pub linkage: Linkage,
    /// Driving crank O1A of a six-bar, m: for drawings and lengths.
    pub driving_crank: Option<f64>,
    /// Angle of the base O1O2 from the line of the slider, rad.
    pub base_angle: f64,
}

impl LinkageData {
    /// The angle of the driving crank from the line of the slider, rad, where it is at θ from its base.
    #[must_use]
    pub fn to_line(&self, theta: f64) -> f64 {
        if matches!(self.linkage, Linkage::SixBar(..)) { theta + self.base_angle } else { theta }
    }

    /// An end of the stroke of a bed; `None` under a yoke, and where no buffer can balance it.
    pub(crate) fn stroke_end(&self, bed: &Bed, end: End) -> Option<StrokeEnd> {
        match self.linkage {
            Linkage::Yoke => None,
            linkage => StrokeEnd::new(linkage, bed.crank_radius, end),
        }
    }
}

/// How the air column of a press is chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AirColumn {
    /// By the law of the bottom, or given.
    Of(ColumnRule),
    /// With the least largest torque on the camshaft.
    LeastTorque,
}

/// A flat-bed press with air buffers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Press {
    /// Bed and crank.
    pub bed: Bed,
    /// What moves the bed, where a linkage is described.
    pub linkage: Option<LinkageData>,
    /// The end of the stroke at which the buffers are, where a linkage other than a yoke moves the bed.
    pub stroke_end: Option<StrokeEnd>,
    /// Polytropic exponent k.
    pub polytropic_exponent: f64,
    /// Ambient pressure, Pa, absolute.
    pub ambient_pressure: f64,
    /// End pressure at the design speed, Pa, absolute.
    pub end_pressure: f64,
    /// Air column.
    pub column: AirColumn,
    /// Lead e, m.
    pub lead: f64,
    /// Design speed of the main shaft, rpm.
    pub design_rpm: f64,
    /// Stiffness of the train that the cam is cut for, N/m.
    pub compensated_train: Option<f64>,
    /// Exponent of the air on its way back, where the rotary cam is to level both ways.
    pub levelled: Option<f64>,
}

/// That what there is for a yoke only, with its verb, cannot be had under a linkage, with the reason.
pub(in crate::press) fn only_under_a_yoke(what: &str, why: &str) -> Refusal {
    Refusal::new(format!(
        "the bed of this machine is moved by a linkage, and {what} for a yoke only, x = r sin φ: under a linkage {why}"
    ))
    .remedy("use a machine without [linkage], or linkage.kind = \"yoke\"")
}

impl Press {
    /// The pair of cylinders, sized at the design speed.
    #[must_use]
    pub fn cylinder(&self) -> Cylinder {
        let (k, p0, end) = (self.polytropic_exponent, self.ambient_pressure, self.end_pressure);
        Cylinder::sized_for(&self.bed, self.largest_deceleration(), self.design_rpm, k, p0, end)
    }

    /// Largest deceleration of the bed over the square of the crank speed, m: r under a yoke.
    #[must_use]
    pub fn largest_deceleration(&self) -> f64 {
        self.stroke_end.map_or(self.bed.crank_radius, |end| end.largest_deceleration().value)
    }

    /// Largest inertia force of the bed at a speed of the main shaft (rpm), N.
    #[must_use]
    pub fn largest_inertia(&self, rpm: f64) -> f64 {
        self.bed.inertia(rpm, self.largest_deceleration())
    }

    /// By how much the bottom gives way over the overrun of the bed where the train is compensated, m ω²/c, below 1; `None` where it is not, or
    /// gives way faster than the bed comes.
    #[must_use]
    pub fn train_gives(&self, rpm: f64) -> Option<f64> {
        let stiffness = self.compensated_train?;
        let speed = self.bed.crank_speed(rpm);
        Some(self.bed.mass * speed * speed / stiffness).filter(|share| *share < 1.0)
    }

    /// The law of the bottom at a speed of the main shaft, rpm.
    #[must_use]
    pub fn bottom_law(&self, rpm: f64) -> CrankLaw {
        self.with_column(rpm, self.column_rule(rpm))
    }

    /// The law of the rotary cam at a speed of the main shaft, rpm: the bottom law, or the law that levels both ways of the air loop.
    ///
    /// # Errors
    /// [`Refusal`] where both ways are to be levelled and there is no loop, or a linkage moves the bed.
    pub fn rotary_law(&self, rpm: f64) -> Result<CrankLaw, Refusal> {
        let Some(expansion) = self.levelled else { return Ok(self.bottom_law(rpm)) };
        if self.stroke_end.is_some() {
            let why = "the bed comes to one place with two forces, and its two ways have no common bottom";
            return Err(only_under_a_yoke("buffer.balance = \"level\" is solved", why));
        }
        if self.compensated_train.is_some() {
            let what = "a cam is cut for its train (cam.compensate_train) where both directions of the bed have one force, and with \
                        buffer.balance = \"level\" each has its own";
            return Err(Refusal::new(what).remedy("leave one of the two out"));
        }
        if self.column == AirColumn::LeastTorque {
            let what = "buffer.column = \"least-torque\" is found for buffer.balance = \"braking\", and \"level\" needs another length";
            return Err(Refusal::new(what).remedy("give buffer.column as a length, or \"matched\""));
        }
        let (compression, loading) = (self.polytropic_exponent, self.cylinder().loading(rpm));
        if expansion < compression {
            return Err(ScatterError::ExpansionBelowCompression { expansion, compression }.into());
        }
        let law = BottomLaw::level(loading, self.bed.crank_radius, self.column_rule(rpm), compression, expansion);
        Ok(law.ok_or(ScatterError::NoLead { compression, expansion })?.into())
    }

    /// The rule for the column, one of the least torque as a length.
    fn column_rule(&self, rpm: f64) -> ColumnRule {
        match (self.column, &self.stroke_end) {
            (AirColumn::Of(ColumnRule::Matched), None) if self.compensated_train.is_some() => {
                // The bottom gives way by a x, so that the law as cut starts with slope 0 at L = (1 − a) k/A.
                let matched = self.polytropic_exponent / self.cylinder().loading(rpm);
                ColumnRule::Length(matched * (1.0 - self.train_gives(rpm).unwrap_or(0.0)))
            }
            (AirColumn::Of(column), _) => column,
            (AirColumn::LeastTorque, end) => {
                let (loading, k) = (self.cylinder().loading(rpm), self.polytropic_exponent);
                ColumnRule::Length(match end {
                    None => camshaft::least_torque_column(loading, k, self.bed.crank_radius),
                    Some(end) => crank_law::least_torque_column(loading, k, end),
                })
            }
        }
    }

    /// The law with another air column.
    #[must_use]
    pub fn with_column(&self, rpm: f64, column: ColumnRule) -> CrankLaw {
        let (loading, k) = (self.cylinder().loading(rpm), self.polytropic_exponent);
        match self.stroke_end {
            None => BottomLaw::new(loading, k, self.bed.crank_radius, column, self.lead).into(),
            Some(end) => CrankLaw::Linkage(LinkageLaw::new(loading, k, end, column, self.lead)),
        }
    }
}

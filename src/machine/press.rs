//! The press: what makes the motion of its cams and what presses on them.

use crate::buffer::bottom_law::{BottomLaw, Column};
use crate::buffer::crank_law::{self, CrankLaw, LinkageLaw};
use crate::buffer::{Bed, Cylinder, camshaft};
use crate::linkage::StrokeEnd;

/// How the air column of a press is chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AirColumn {
    /// By the law of the bottom, or given.
    Of(Column),
    /// With the least largest torque on the camshaft.
    LeastTorque,
}

/// A flat-bed press with air buffers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Press {
    /// Bed and crank.
    pub bed: Bed,
    /// The end of the stroke at which the buffers stand, where a linkage other than a yoke moves the bed.
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
}

/// Why there is no press whose cams could be solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NoPress {
    /// The machine file describes none.
    #[error("the machine file describes no press: add the tables [bed], [buffer] and [design], or use `camgen make`")]
    None,
    /// Its bed moves otherwise than x = r sin φ.
    #[error(
        "the bed of this machine is moved by a linkage, and {what} for a yoke only, x = r sin φ: under a linkage {why}; use a machine \
         without [linkage], or linkage.kind = \"yoke\""
    )]
    Linkage {
        /// What there is for a yoke only, with its verb.
        what: &'static str,
        /// What keeps it from there.
        why: &'static str,
    },
    /// The acceleration of its bed changes its sign too often.
    #[error(
        "the acceleration of the bed changes its sign more than twice in a turn of this linkage: no buffer at an end of the stroke \
         can balance it; `camgen linkage` shows where, check `reversals`; a longer rod (linkage.rod_ratio) or a shorter base \
         (linkage.base_ratio) makes the motion simpler"
    )]
    Reversals,
    /// An end of the stroke is asked for, and both are one.
    #[error(
        "--end tells the ends of the stroke of a linkage apart; this machine has none, and under a yoke both ends are one"
    )]
    NoEnds,
}

/// The follower of the machine file is not the roller that the cam needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NoRoller {
    /// It is another one.
    #[error("this cam needs a translating roller: give the table [follower.roller]")]
    Another,
    /// Its place is to be chosen.
    #[error("follower.roller.offset = \"auto\" is chosen for the motion of `camgen make`: give an offset")]
    Auto,
}

impl Press {
    /// The pair of cylinders, sized at the design speed.
    #[must_use]
    pub fn cylinder(&self) -> Cylinder {
        let (k, p0, end) = (self.polytropic_exponent, self.ambient_pressure, self.end_pressure);
        Cylinder::sized_for(&self.bed, self.largest_deceleration(), (self.design_rpm, k), (p0, end))
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

    /// The law of the bottom at a speed of the main shaft, rpm.
    #[must_use]
    pub fn bottom_law(&self, rpm: f64) -> CrankLaw {
        let column = match (self.column, &self.stroke_end) {
            (AirColumn::Of(column), _) => column,
            (AirColumn::LeastTorque, end) => {
                let (loading, k) = (self.cylinder().loading(rpm), self.polytropic_exponent);
                Column::Length(match end {
                    None => camshaft::least_torque_column(loading, k, self.bed.crank_radius),
                    Some(end) => crank_law::least_torque_column(loading, k, end),
                })
            }
        };
        self.with_column(rpm, column)
    }

    /// The same with another air column.
    #[must_use]
    pub fn with_column(&self, rpm: f64, column: Column) -> CrankLaw {
        let (loading, k) = (self.cylinder().loading(rpm), self.polytropic_exponent);
        match self.stroke_end {
            None => BottomLaw::new(loading, k, self.bed.crank_radius, column, self.lead).into(),
            Some(end) => CrankLaw::Linkage(LinkageLaw::new(loading, k, end, column, self.lead)),
        }
    }
}

//! The press: what makes the motion of its cams and what presses on them.

use crate::buffer::bottom_law::{BottomLaw, Column};
use crate::buffer::{Bed, Cylinder, camshaft};

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
        "the bed of this machine is moved by a linkage, and cams, resets and springs are solved for a yoke, x = r sin φ: such a cam \
         would leave a large part of the inertia force at the dead point; `camgen linkage` analyses the drive"
    )]
    Linkage,
}

/// The follower of the machine file is not the roller that the cam needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("this cam needs a translating roller: give the table [follower.roller]")]
pub struct NoRoller;

impl Press {
    /// The pair of cylinders, sized at the design speed.
    #[must_use]
    pub fn cylinder(&self) -> Cylinder {
        let (k, p0, end) = (self.polytropic_exponent, self.ambient_pressure, self.end_pressure);
        Cylinder::sized(&self.bed, self.design_rpm, k, p0, end)
    }

    /// The law of the bottom at a speed of the main shaft, rpm.
    #[must_use]
    pub fn bottom_law(&self, rpm: f64) -> BottomLaw {
        let column = match self.column {
            AirColumn::Of(column) => column,
            AirColumn::LeastTorque => {
                let loading = self.cylinder().loading(rpm);
                let (k, stroke) = (self.polytropic_exponent, self.bed.crank_radius);
                Column::Length(camshaft::least_torque_column(loading, k, stroke))
            }
        };
        self.with_column(rpm, column)
    }

    /// The same with another air column.
    #[must_use]
    pub fn with_column(&self, rpm: f64, column: Column) -> BottomLaw {
        let loading = self.cylinder().loading(rpm);
        BottomLaw::new(loading, self.polytropic_exponent, self.bed.crank_radius, column, self.lead)
    }
}

//! What differs from machine to machine: ten parameters, their customary half widths, and their effect on the residual force.

use super::fault::{Fault, FrozenBuffer, Station};
use crate::press::buffer::level_air::LevelAir;
use camgen_kernel::geometry::MILLIMETRES;
use std::f64::consts::PI;

/// A parameter of a press, in the order in which its scatter is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Parameter {
    /// Polytropic exponent.
    Exponent,
    /// Ambient pressure.
    Ambient,
    /// Moving mass.
    Mass,
    /// Speed of the main shaft.
    Speed,
    /// Air column: the screw as it is set.
    Column,
    /// Place of the port: it shuts early.
    Lead,
    /// Mass of air that is lost.
    AirLost,
    /// Pressure where the port closes.
    Closing,
    /// Angle of the cam on its shaft.
    Phase,
    /// Error with which the screw is set by a reset.
    Screw,
}

/// The kind of a value of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParameterUnit {
    /// A share of the value, as a number.
    Share,
    /// A difference of the number.
    Number,
    /// A length, m.
    Length,
    /// A crank angle, rad.
    Angle,
}

impl ParameterUnit {
    /// The unit in tables, and how many of it are one in SI.
    #[must_use]
    pub fn shown(self) -> (&'static str, f64) {
        match self {
            Self::Share | Self::Number => ("1", 1.0),
            Self::Length => ("mm", MILLIMETRES),
            Self::Angle => ("deg", 180.0 / PI),
        }
    }
}

/// Half widths of all parameters in SI, in the order of [`Parameter::ALL`]; of `air_lost` the whole width from 0.
pub type HalfWidths = [f64; Parameter::ALL.len()];

impl Parameter {
    /// All of them, in the order of their draws.
    pub const ALL: [Self; 10] = [
        Self::Exponent,
        Self::Ambient,
        Self::Mass,
        Self::Speed,
        Self::Column,
        Self::Lead,
        Self::AirLost,
        Self::Closing,
        Self::Phase,
        Self::Screw,
    ];

    /// Its name, which is its key and what `--fault` and `--vary` call it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Exponent => "polytropic_exponent",
            Self::Ambient => "ambient_pressure",
            Self::Mass => "mass",
            Self::Speed => "speed",
            Self::Column => "column",
            Self::Lead => "lead",
            Self::AirLost => "air_lost",
            Self::Closing => "closing_pressure",
            Self::Phase => "phase",
            Self::Screw => "screw",
        }
    }

    /// The parameter of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|parameter| parameter.name() == name)
    }

    /// The kind of its values.
    #[must_use]
    pub fn unit(self) -> ParameterUnit {
        match self {
            Self::Exponent => ParameterUnit::Number,
            Self::Column | Self::Lead | Self::Screw => ParameterUnit::Length,
            Self::Phase => ParameterUnit::Angle,
            Self::Ambient | Self::Mass | Self::Speed | Self::AirLost | Self::Closing => ParameterUnit::Share,
        }
    }

    /// A machine with a deviation of this parameter, SI. An error of the screw acts after a reset only.
    #[must_use]
    pub fn changed(self, fault: Fault, by: f64) -> Fault {
        match self {
            Self::Exponent => Fault { exponent: fault.exponent + by, ..fault },
            Self::Ambient => Fault { ambient: fault.ambient * (1.0 + by), ..fault },
            Self::Mass => Fault { square: fault.square * (1.0 + by), ..fault },
            Self::Speed => Fault { square: fault.square * (1.0 + by) * (1.0 + by), ..fault },
            Self::Column => Fault { column: fault.column + by, ..fault },
            Self::Lead => Fault { lead: fault.lead + by, ..fault },
            Self::AirLost => Fault { air: fault.air - by, ..fault },
            Self::Closing => Fault { closing: fault.closing * (1.0 + by), ..fault },
            Self::Phase => Fault { phase: fault.phase + by, ..fault },
            Self::Screw => fault,
        }
    }

    /// The change of the residual force of a cam, N, for one of it in SI, to first order, at a crank angle on the way in.
    #[must_use]
    pub fn first_order(self, cam: &FrozenBuffer, angle: f64) -> f64 {
        self.effect(cam, &cam.station_of_cam(angle))
    }

    /// The change of the residual force of any buffer, N, per SI unit of the parameter, to first order, at a station of the way in.
    #[must_use]
    pub fn effect(self, buffer: &FrozenBuffer, at: &Station) -> f64 {
        if let Some(air) = &buffer.level {
            return self.effect_on_mean(buffer, air, at);
        }
        let (u, k, log) = (buffer.unit_force, buffer.exponent, libm::log(at.length));
        let pressure = libm::exp(-k * log);
        match self {
            Self::Exponent => u * pressure * log,
            Self::Ambient => -u * libm::expm1(-k * log),
            Self::Mass => u * at.load,
            Self::Speed => 2.0 * u * at.load,
            Self::Column | Self::Screw => u * k * pressure * libm::expm1(-log) / buffer.column,
            Self::Lead => -u * k * pressure / (at.length * buffer.column),
            Self::AirLost => u * k * pressure,
            Self::Closing => -u * pressure,
            Self::Phase => u * at.phase,
        }
    }

    /// The change of the mean of both ways under a cam that levels them: ln P̂ of the way back is κ1 ln(s/(w_r + t)) + κ2 ln((w_r + t)/(w + t)).
    fn effect_on_mean(self, buffer: &FrozenBuffer, air: &LevelAir, at: &Station) -> f64 {
        let (u, [on_way_in, back], end) = (buffer.unit_force, air.pressures(at.length), buffer.end_length());
        let (k, back_k) = (air.compression, air.expansion);
        // −d ln P̂/dt of both ways.
        let shorter = [k / at.length, (k - back_k) / end + back_k / at.length];
        let mean = |of_in: f64, of_back: f64| 0.5 * u * (on_way_in * of_in + back * of_back);
        match self {
            Self::Exponent => mean(libm::log(at.length), libm::log(end)),
            Self::Ambient => -u * (0.5 * (on_way_in + back) - 1.0),
            Self::Mass => u * at.load,
            Self::Speed => 2.0 * u * at.load,
            Self::Column | Self::Screw => mean(shorter[0] - k, shorter[1] - k) / buffer.column,
            Self::Lead => -mean(shorter[0], shorter[1]) / buffer.column,
            Self::AirLost => k * mean(1.0, 1.0),
            Self::Closing => -mean(1.0, 1.0),
            Self::Phase => u * at.phase,
        }
    }
}

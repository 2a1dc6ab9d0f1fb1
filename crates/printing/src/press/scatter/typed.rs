//! A machine that differs, as it is typed after `--fault`.

use super::fault::Fault;
use super::parameter::{Parameter, ParameterUnit};
use crate::press::machine::Press;
use camgen_kernel::document::Input;
use camgen_kernel::document::similar;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units::{self, Dimension};
use std::f64::consts::PI;

/// A share of this size and more may be meant as a ratio.
const AMBIGUOUS: f64 = 0.5;
/// Largest phase error, rad, with the rounding of its unit.
const LARGEST_PHASE: f64 = 5.0 * PI / 180.0 * (1.0 + 1e-12);

/// The machine of some `KEY=VALUE`, with the error of its screw, m, and what it was made of.
#[derive(Debug, Clone, PartialEq)]
pub struct TypedFault {
    /// The machine.
    pub fault: Fault,
    /// Error with which the screw is set by a reset, m.
    pub screw: f64,
    /// What was typed.
    pub inputs: Vec<Input>,
}

impl TypedFault {
    /// Reads the machine of a press. A share is a deviation, `mass=-5%`; with a unit the true value, `mass=930 kg`; the exponent is the true
    /// one.
    ///
    /// # Errors
    /// [`Refusal`] for a key that there is not, one that is given twice, and a value that is out of range.
    pub fn read(typed: &[String], press: &Press, rpm: f64) -> Result<Self, Refusal> {
        let column = press.rotary_law(rpm)?.column();
        let mut all = Self { fault: Fault::none(press.polytropic_exponent), screw: 0.0, inputs: Vec::new() };
        let mut given: Vec<Parameter> = Vec::new();
        for one in typed {
            let (key, value) = one.split_once('=').ok_or_else(|| {
                Refusal::new(format!("--fault {one}: KEY=VALUE is expected")).remedy("for example --fault mass=5%")
            })?;
            let key = key.trim();
            let parameter = Parameter::named(key).ok_or_else(|| unknown(key))?;
            if given.contains(&parameter) {
                return Err(Refusal::new(format!("--fault {key} is given twice")));
            }
            given.push(parameter);
            let by =
                deviation(parameter, value.trim(), press, rpm).map_err(|why| why.context(&format!("--fault {one}")))?;
            all.fault = parameter.changed(all.fault, by);
            if parameter == Parameter::Screw {
                all.screw = by;
            }
            if parameter.unit() == ParameterUnit::Share && !(1.0 + by > 0.0) {
                let why = Refusal::new("the value is out of range").remedy("mass, speed and pressures stay above 0");
                return Err(why.context(&format!("--fault {one}")));
            }
            in_range(parameter, &all.fault, column).map_err(|why| why.context(&format!("--fault {one}")))?;
            all.inputs.push(Input::number(&format!("fault.{key}"), by));
        }
        Ok(all)
    }

    /// Whether anything differs.
    #[must_use]
    pub fn is_any(&self) -> bool {
        !self.inputs.is_empty()
    }
}

fn unknown(key: &str) -> Refusal {
    let names = Parameter::ALL.map(Parameter::name);
    let nearest = similar(key, names).map_or(String::new(), |name| format!("did you mean `{name}`? "));
    Refusal::new(format!("--fault: there is no parameter `{key}`"))
        .remedy(format!("{nearest}there are {}", names.join(", ")))
}

fn parsed(value: &str, dimension: Dimension) -> Result<f64, Refusal> {
    units::parse(value, dimension)
        .map(|quantity| quantity.si)
        .map_err(|why| Refusal::of(why).remedy(format!("its units are {}", dimension.unit_list())))
}

/// The deviation in SI.
fn deviation(parameter: Parameter, value: &str, press: &Press, rpm: f64) -> Result<f64, Refusal> {
    match parameter.unit() {
        ParameterUnit::Length => parsed(value, Dimension::Length),
        ParameterUnit::Angle => parsed(value, Dimension::Angle),
        ParameterUnit::Number => {
            if value.starts_with(['+', '-']) {
                let what = format!("{value} is a deviation, and the exponent is given itself");
                return Err(Refusal::new(what).remedy("write the true exponent, such as 1.40"));
            }
            Ok(units::parse_bare(value).map_err(Refusal::of)? - press.polytropic_exponent)
        }
        ParameterUnit::Share => share(parameter, value, press, rpm),
    }
}

fn share(parameter: Parameter, value: &str, press: &Press, rpm: f64) -> Result<f64, Refusal> {
    if let Some(percent) = value.strip_suffix('%') {
        return units::parse_bare(percent).map(|percent| percent / 100.0).map_err(Refusal::of);
    }
    if let Ok(number) = units::parse_bare(value) {
        return if number.abs() < AMBIGUOUS {
            Ok(number)
        } else {
            let what = format!("{value} may be a ratio or a deviation");
            Err(Refusal::new(what)
                .remedy("write the deviation as a share, such as 5% or -3%, or the true value with its unit"))
        };
    }
    match parameter {
        Parameter::Mass => Ok(parsed(value, Dimension::Mass)? / press.bed.mass - 1.0),
        Parameter::Ambient => Ok(parsed(value, Dimension::Pressure)? / press.ambient_pressure - 1.0),
        Parameter::Speed => {
            let number = value.trim_end_matches("rpm").trim();
            let speed = units::parse_bare(number).map_err(|why| Refusal::of(why).remedy("write -3%, or 34 rpm"))?;
            Ok(speed / rpm - 1.0)
        }
        _ => Err(Refusal::new(format!("`{value}` is not a share")).remedy("write a share, such as 1%")),
    }
}

/// The ranges in which the formulas hold.
fn in_range(parameter: Parameter, fault: &Fault, column: f64) -> Result<(), Refusal> {
    let kept = match parameter {
        Parameter::Mass | Parameter::Speed => (fault.square > 0.0, "mass and speed stay above 0"),
        Parameter::Ambient => (fault.ambient > 0.0, "the ambient pressure stays above 0"),
        Parameter::Exponent => ((1.0..=3.0).contains(&fault.exponent), "the true exponent is from 1 to 3"),
        Parameter::Closing => {
            ((0.5..=2.0).contains(&fault.closing), "the port closes at half to twice the ambient pressure")
        }
        Parameter::AirLost => (fault.air > 0.5 && fault.air <= 1.0, "air_lost is from 0 to less than 50%"),
        Parameter::Phase => (fault.phase.abs() <= LARGEST_PHASE, "the phase is within 5 deg"),
        Parameter::Lead => (fault.lead.abs() < 0.5 * column, "the lead is within half of the column"),
        Parameter::Column | Parameter::Screw => {
            (fault.column.abs() < 100.0 * column, "the column is less than 100 times as long")
        }
    };
    if kept.0 { Ok(()) } else { Err(Refusal::new("the value is out of range").remedy(kept.1)) }
}

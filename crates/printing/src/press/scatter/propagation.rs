//! How far the bands of all parameters together move the residual force: the worst case exactly, the standard deviation to first order.

use super::bed_path::BedPath;
use super::error::ScatterError;
use super::fault::{Fault, FrozenBuffer};
use super::monte_carlo::Distribution;
use super::parameter::{HalfWidths, Parameter};
use super::reset::ScrewRule;
use camgen_kernel::numeric::extremum::Extremum;
use std::f64::consts::FRAC_PI_2;

/// The residual force is monotone in every parameter where the air is above the ambient pressure, so that two presses bound all others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corners {
    /// Its air is weakest.
    pub weak: Fault,
    /// Its air is strongest.
    pub strong: Fault,
    /// Half width of the phase, rad.
    pub phase: f64,
}

impl Corners {
    /// The corners of the bands of a cam, without the error of the screw, which acts after a reset only.
    #[must_use]
    pub fn of(cam: &FrozenBuffer, half_widths: &HalfWidths) -> Self {
        let corner = |sign: f64| {
            let none = Fault::none(cam.exponent);
            Parameter::ALL.into_iter().zip(half_widths).fold(none, |fault, (parameter, half_width)| match parameter {
                Parameter::Mass | Parameter::Speed | Parameter::Column => parameter.changed(fault, sign * half_width),
                Parameter::AirLost if sign < 0.0 => fault,
                Parameter::AirLost => parameter.changed(fault, *half_width),
                Parameter::Phase | Parameter::Screw => fault,
                _ => parameter.changed(fault, -sign * half_width),
            })
        };
        let phase = Parameter::ALL.into_iter().zip(half_widths).find(|(parameter, _)| *parameter == Parameter::Phase);
        Self { weak: corner(1.0), strong: corner(-1.0), phase: phase.map_or(0.0, |(_, half_width)| *half_width) }
    }

    /// Least and largest residual force at a crank angle, N.
    #[must_use]
    pub fn at(&self, cam: &FrozenBuffer, angle: f64) -> [f64; 2] {
        let load = cam.path.load_at(angle);
        let (length, phase) = (cam.length(load), (self.phase * cam.phase_force(angle)[0]).abs());
        [cam.residual(&self.strong, load, length) - phase, cam.residual(&self.weak, load, length) + phase]
    }

    /// The strongest and the weakest air where each is worst, N, with the phase error there, and the overrun, m.
    ///
    /// # Errors
    /// When a column is used up.
    pub fn worst(&self, cam: &FrozenBuffer) -> Result<[Extremum; 2], ScatterError> {
        if let BedPath::Linkage(_) = cam.path {
            return self.worst_of_linkage(cam);
        }
        let phase = |at: f64| {
            let angle = if at >= cam.path.stroke() { FRAC_PI_2 } else { libm::asin(at / cam.path.stroke()) };
            // At the end of the stroke the bed stands still, and the phase does not matter.
            if angle == FRAC_PI_2 { 0.0 } else { (self.phase * cam.phase_force(angle)[0]).abs() }
        };
        let ([strong, _], [_, weak]) = (cam.extremes(&self.strong)?, cam.extremes(&self.weak)?);
        let with = |found: Extremum, sign: f64| Extremum { value: found.value + sign * phase(found.at), ..found };
        Ok([with(strong, -1.0), with(weak, 1.0)])
    }

    /// Those at the stations: of one load a linkage has two places, where the phase counts differently.
    fn worst_of_linkage(&self, cam: &FrozenBuffer) -> Result<[Extremum; 2], ScatterError> {
        cam.fits(&self.strong)?;
        cam.fits(&self.weak)?;
        let mut worst = [Extremum { at: 0.0, value: 0.0 }; 2];
        for station in cam.stations_of_cam() {
            let phase = cam.unit_force * (self.phase * station.phase).abs();
            for ((found, fault), sign) in worst.iter_mut().zip([&self.strong, &self.weak]).zip([-1.0, 1.0]) {
                let value = cam.residual(fault, station.load, station.length) + sign * phase;
                if sign * value > sign * found.value {
                    *found = Extremum { at: cam.path.overrun_at(station.angle), value };
                }
            }
        }
        Ok(worst)
    }
}

/// What a parameter alone leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParameterBand {
    /// The parameter.
    pub parameter: Parameter,
    /// Its half width, SI.
    pub half_width: f64,
    /// h S, N: its largest effect to first order.
    pub sensitivity: f64,
    /// The residual force as built, in the worse direction, N, signed.
    pub residual: Extremum,
    /// ΔL of the end setting, m, and what it leaves.
    pub end: (f64, Extremum),
    /// ΔL of the level setting, m, and what it leaves, where that was asked for.
    pub level: Option<(f64, Extremum)>,
    /// Its share of the variance at the end of the stroke as built.
    pub share_of_variance: f64,
}

/// Both directions of a deviation are looked at; a difference below this share is rounding.
const ALIKE: f64 = 1e-9;

/// What a press leaves as built, and with the screw set by some rules: ΔL and the force.
type LeftBy = (Extremum, Vec<(f64, Extremum)>);

fn left_by(cam: &FrozenBuffer, fault: &Fault, screw: f64, rules: &[ScrewRule]) -> Result<LeftBy, ScatterError> {
    let after = |rule: &ScrewRule| -> Result<(f64, Extremum), ScatterError> {
        let column = cam.setting(fault, *rule)? + screw;
        Ok((column, cam.worst(&fault.with_column(column))?))
    };
    Ok((cam.worst(fault)?, rules.iter().map(after).collect::<Result<_, _>>()?))
}

/// What a phase error leaves whose largest force for a radian is known; no screw changes it.
fn left_by_phase(cam: &FrozenBuffer, found: Extremum, half_width: f64, rules: &[ScrewRule]) -> LeftBy {
    let left = Extremum { at: cam.path.overrun_at(found.at), value: half_width * found.value };
    (left, rules.iter().map(|_| (0.0, left)).collect())
}

/// In the direction that leaves more as built, or, where both leave alike, after the end setting.
fn worse(left: LeftBy, other: LeftBy) -> LeftBy {
    let end = |of: &LeftBy| of.1.first().map_or(0.0, |(_, end)| end.value.abs());
    let (built, of_other) = (left.0.value.abs(), other.0.value.abs());
    let alike = (of_other - built).abs() <= ALIKE * built;
    if of_other > built * (1.0 + ALIKE) || (alike && end(&other) > end(&left) * (1.0 + ALIKE)) { other } else { left }
}

/// What the bands leave, each alone, in its worse direction: as built, after the end setting, and after the level one where that is asked for.
///
/// # Errors
/// When a band reaches a press that cannot be.
pub fn bands(
    cam: &FrozenBuffer,
    half_widths: &HalfWidths,
    distribution: Distribution,
    levelled: bool,
) -> Result<Vec<ParameterBand>, ScatterError> {
    let (total, ahead) = (variance(cam, half_widths, distribution), cam.largest_phase_force());
    let rules = if levelled { &[ScrewRule::End, ScrewRule::Level][..] } else { &[ScrewRule::End] };
    let one = |(parameter, half_width): (Parameter, &f64)| -> Result<ParameterBand, ScatterError> {
        let at = |sign: f64| {
            let fault = parameter.changed(Fault::none(cam.exponent), sign * half_width);
            left_by(cam, &fault, if parameter == Parameter::Screw { sign * half_width } else { 0.0 }, rules)
        };
        let (residual, after) = match parameter {
            Parameter::Phase => left_by_phase(cam, ahead, *half_width, rules),
            Parameter::AirLost => at(1.0)?,
            _ => worse(at(1.0)?, at(-1.0)?),
        };
        // A screw that is not touched has no error.
        let none = Extremum { at: 0.0, value: 0.0 };
        let own = variance_of(cam, (parameter, *half_width), distribution);
        Ok(ParameterBand {
            parameter,
            half_width: *half_width,
            sensitivity: half_width
                * if parameter == Parameter::Phase { ahead.value } else { sensitivity(cam, parameter) },
            residual: if parameter == Parameter::Screw { none } else { residual },
            end: after.first().copied().unwrap_or((0.0, none)),
            level: after.get(1).copied(),
            share_of_variance: if total > 0.0 { own / total } else { 0.0 },
        })
    };
    Parameter::ALL.into_iter().zip(half_widths).map(one).collect()
}

/// S, N for one of a parameter in SI: its largest effect over the stroke, which is that at the largest load but for the phase.
#[must_use]
pub fn sensitivity(cam: &FrozenBuffer, parameter: Parameter) -> f64 {
    if parameter == Parameter::Phase {
        return cam.largest_phase_force().value;
    }
    parameter.first_order(cam, cam.path.peak()).abs()
}

/// Variance at the largest load as built of one band, N², to first order. The phase and the error of the screw have none.
fn variance_of(cam: &FrozenBuffer, (parameter, half_width): (Parameter, f64), distribution: Distribution) -> f64 {
    if matches!(parameter, Parameter::Phase | Parameter::Screw) {
        return 0.0;
    }
    let effect = half_width * parameter.first_order(cam, cam.path.peak());
    effect * effect * distribution.variance(parameter)
}

/// Variance at the end of the stroke as built, N², to first order.
#[must_use]
pub fn variance(cam: &FrozenBuffer, half_widths: &HalfWidths, distribution: Distribution) -> f64 {
    let all = Parameter::ALL.into_iter().zip(half_widths.iter().copied());
    all.map(|band| variance_of(cam, band, distribution)).sum()
}

/// Σ h S over what acts at the end of the stroke as built, N: a bound of the residual force to first order.
#[must_use]
pub fn linear_bound(cam: &FrozenBuffer, half_widths: &HalfWidths) -> f64 {
    let all = Parameter::ALL.into_iter().zip(half_widths);
    all.filter(|(parameter, _)| !matches!(parameter, Parameter::Phase | Parameter::Screw))
        .map(|(parameter, half_width)| half_width * sensitivity(cam, parameter))
        .sum()
}

/// Standard deviations from the mean that 95 % of a normal quantity stay within on both sides, and below on one.
pub(super) const BOTH_SIDES: f64 = 1.96;
pub(super) const ONE_SIDE: f64 = 1.645;

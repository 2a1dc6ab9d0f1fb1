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
    pub fn new(cam: &FrozenBuffer, half_widths: &HalfWidths) -> Self {
        let none = Fault::none(cam.exponent);
        let mut corners = Self { weak: none, strong: none, phase: 0.0 };
        for (parameter, half_width) in Parameter::ALL.into_iter().zip(half_widths) {
            match parameter {
                Parameter::Mass | Parameter::Speed | Parameter::Column => {
                    corners.weak = parameter.changed(corners.weak, *half_width);
                    corners.strong = parameter.changed(corners.strong, -half_width);
                }
                Parameter::AirLost => corners.weak = parameter.changed(corners.weak, *half_width),
                Parameter::Phase => corners.phase = *half_width,
                Parameter::Screw => {}
                _ => {
                    corners.weak = parameter.changed(corners.weak, -half_width);
                    corners.strong = parameter.changed(corners.strong, *half_width);
                }
            }
        }
        corners
    }

    /// Least and largest residual force at a crank angle, N.
    #[must_use]
    pub fn extremes_at(&self, cam: &FrozenBuffer, angle: f64) -> [f64; 2] {
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
        let ([strong, _], [_, weak]) = (cam.extremes(&self.strong)?, cam.extremes(&self.weak)?);
        Ok([
            Extremum { value: strong.value - self.phase_at_overrun(cam, strong.at), ..strong },
            Extremum { value: weak.value + self.phase_at_overrun(cam, weak.at), ..weak },
        ])
    }

    /// Largest force of the phase error at an overrun x, m, under a yoke, N.
    fn phase_at_overrun(&self, cam: &FrozenBuffer, x: f64) -> f64 {
        let angle = if x >= cam.path.stroke() { FRAC_PI_2 } else { libm::asin(x / cam.path.stroke()) };
        // At the end of the stroke the bed stands still, and the phase does not matter.
        if angle == FRAC_PI_2 { 0.0 } else { (self.phase * cam.phase_force(angle)[0]).abs() }
    }

    /// As [`Self::worst`] at the stations: under a linkage one load occurs at two angles, where the phase counts differently.
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
    /// ΔL of the level setting, m, and its residual force, on request.
    pub level: Option<(f64, Extremum)>,
    /// Its share of the variance at the end of the stroke as built.
    pub share_of_variance: f64,
}

/// Relative difference between the two directions of a deviation below which it is rounding.
const ALIKE: f64 = 1e-9;

/// The residual forces of a press.
struct PressResiduals {
    as_built: Extremum,
    /// ΔL, m, and the force after a reset by each of some rules.
    reset: Vec<(f64, Extremum)>,
}

impl PressResiduals {
    /// Of a press with this error of the screw, m.
    fn new(cam: &FrozenBuffer, fault: &Fault, screw: f64, rules: &[ScrewRule]) -> Result<Self, ScatterError> {
        let as_built = cam.worst(fault)?;
        let mut reset = Vec::with_capacity(rules.len());
        for rule in rules {
            let column = cam.setting(fault, *rule)? + screw;
            reset.push((column, cam.worst(&fault.with_column(column))?));
        }
        Ok(Self { as_built, reset })
    }

    /// Of a phase error, rad, by the largest force of a radian; no screw changes it.
    fn of_phase(cam: &FrozenBuffer, largest: Extremum, phase: f64, rules: &[ScrewRule]) -> Self {
        let as_built = Extremum { at: cam.path.overrun_at(largest.at), value: phase * largest.value };
        Self { as_built, reset: rules.iter().map(|_| (0.0, as_built)).collect() }
    }

    /// The force after the end setting, N.
    fn after_end_setting(&self) -> f64 {
        self.reset.first().map_or(0.0, |(_, end)| end.value.abs())
    }

    /// The one with the larger force as built or, if these are alike, after the end setting.
    fn or_worse(self, other: Self) -> Self {
        let (built, of_other) = (self.as_built.value.abs(), other.as_built.value.abs());
        let alike = (of_other - built).abs() <= ALIKE * built;
        let worse_reset = other.after_end_setting() > self.after_end_setting() * (1.0 + ALIKE);
        if of_other > built * (1.0 + ALIKE) || (alike && worse_reset) { other } else { self }
    }
}

/// What the bands leave, each alone, in its worse direction: as built, after the end setting, and, on request, after the level setting.
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
    let mut bands = Vec::with_capacity(half_widths.len());
    for (parameter, half_width) in Parameter::ALL.into_iter().zip(half_widths.iter().copied()) {
        let found = match parameter {
            Parameter::Phase => PressResiduals::of_phase(cam, ahead, half_width, rules),
            Parameter::AirLost => with_deviation(cam, parameter, half_width, rules)?,
            _ => with_deviation(cam, parameter, half_width, rules)?.or_worse(with_deviation(
                cam,
                parameter,
                -half_width,
                rules,
            )?),
        };
        // A screw that is not touched has no error.
        let none = Extremum { at: 0.0, value: 0.0 };
        let own = variance_of(cam, parameter, half_width, distribution);
        bands.push(ParameterBand {
            parameter,
            half_width,
            sensitivity: half_width
                * if parameter == Parameter::Phase { ahead.value } else { sensitivity(cam, parameter) },
            residual: if parameter == Parameter::Screw { none } else { found.as_built },
            end: found.reset.first().copied().unwrap_or((0.0, none)),
            level: found.reset.get(1).copied(),
            share_of_variance: if total > 0.0 { own / total } else { 0.0 },
        });
    }
    Ok(bands)
}

/// A press in which one parameter deviates.
fn with_deviation(
    cam: &FrozenBuffer,
    parameter: Parameter,
    deviation: f64,
    rules: &[ScrewRule],
) -> Result<PressResiduals, ScatterError> {
    let fault = parameter.changed(Fault::none(cam.exponent), deviation);
    PressResiduals::new(cam, &fault, if parameter == Parameter::Screw { deviation } else { 0.0 }, rules)
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
fn variance_of(cam: &FrozenBuffer, parameter: Parameter, half_width: f64, distribution: Distribution) -> f64 {
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
    all.map(|(parameter, half_width)| variance_of(cam, parameter, half_width, distribution)).sum()
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

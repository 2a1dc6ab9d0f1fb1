//! The short section `scatter` in the report of a plate and of a conoid.
//!
//! The roller of a plate rubs, so that its air acts on the bed by a factor T of its own in either direction: r = U [M u − T π (τ (s/(w + t))^κ − 1)],
//! with T from what equation (18) leaves without a difference. A conoid follows the speed, or all of v: those bands leave nothing of it.

use super::analysis::bands_of;
use super::fault::{FrozenBuffer, Station};
use super::monte_carlo::{self, Sampling};
use super::parameter::{HalfWidths, Parameter};
use super::propagation::{self, Corners};
use super::section::{Percentiles, whole_newtons};
use crate::press::buffer::Cylinder;
use crate::press::buffer::crank_law::CrankLaw;
use crate::press::machine::{PressCams, Shift};
use camgen_cams::report::ReportLine;
use camgen_cams::report::{Section, shown};
use camgen_kernel::document::NamedChoice;
use serde::Serialize;

/// A conoid at the speed of a section.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct SpeedScatter {
    rpm: f64,
    worst_weak_n: f64,
    worst_strong_n: f64,
    linear_bound_n: f64,
    sigma_n: f64,
    #[serde(flatten)]
    left: Percentiles,
}

/// The section's values for a conoid.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct ConoidScatter {
    /// Parameters that the shift follows.
    followed: Vec<&'static str>,
    reset: &'static str,
    speeds: Vec<SpeedScatter>,
}

fn followed(shift: Shift) -> &'static [Parameter] {
    match shift {
        Shift::Linear | Shift::Square => &[Parameter::Speed],
        Shift::Variable => &[Parameter::Mass, Parameter::Speed, Parameter::Ambient],
    }
}

/// The bands, some parameters left out.
fn without(half_widths: &HalfWidths, parameters: &[Parameter]) -> HalfWidths {
    let mut left = *half_widths;
    for (half_width, parameter) in left.iter_mut().zip(Parameter::ALL) {
        if parameters.contains(&parameter) {
            *half_width = 0.0;
        }
    }
    left
}

/// The law of a conoid's section at its speed.
#[derive(Debug, Clone, Copy)]
pub struct LawAtSpeed {
    /// Of the main shaft, rpm.
    pub rpm: f64,
    /// The law of the bottom.
    pub law: CrankLaw,
}

/// The section of a conoid with the laws of its sections; `None` where a band reaches a press that cannot be.
#[must_use]
pub fn of_conoid(cams: &PressCams, cylinder: &Cylinder, shift: Shift, laws: &[LawAtSpeed]) -> Option<Section> {
    let followed = followed(shift);
    let sampling = Sampling { half_widths: without(&cams.scatter.half_widths, followed), ..cams.scatter };
    let mut speeds = Vec::new();
    for LawAtSpeed { rpm, law } in laws {
        let cam = FrozenBuffer::of_law(law, cylinder);
        let bands = bands_of(&cam, &sampling, false).ok()?;
        let left = monte_carlo::left_in_practice(&cam, &sampling, cams.losses.bed_friction).ok().flatten();
        speeds.push(SpeedScatter {
            rpm: *rpm,
            worst_weak_n: bands.worst_weak_n,
            worst_strong_n: bands.worst_strong_n,
            linear_bound_n: bands.linear_bound_n,
            sigma_n: bands.sigma_n,
            left: left.into(),
        });
    }
    // A conoid for one speed has two sections of it.
    speeds.dedup_by(|next, before| next.rpm == before.rpm);
    let followed = followed.iter().map(|parameter| parameter.name()).collect();
    let values = ConoidScatter { followed, reset: sampling.rule.word(), speeds };
    let words = values.describe();
    Some(Section::new("scatter", &values).with_words(words))
}

impl ConoidScatter {
    fn describe(&self) -> Vec<ReportLine> {
        let names = self.followed.join(", ").replace('_', " ");
        let mut lines: Vec<ReportLine> = vec![
            format!(
                "presses that differ from the machine file at the speeds of the sections; the shift follows {names}"
            )
            .into(),
        ];
        lines.extend(self.speeds.iter().map(|at| {
            ReportLine::row(format!(
                "{:>6} rpm  all bands at once leave {} to {} N{}",
                shown(at.rpm),
                whole_newtons(at.worst_strong_n),
                whole_newtons(at.worst_weak_n),
                at.left.describe(self.reset)
            ))
        }));
        lines
    }
}

/// A station of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlateStation {
    /// Its load and the length of its air; no phase: the plate rides on the bed.
    pub at: Station,
    /// T while the bed is braked and while it is accelerated.
    pub factors: [f64; 2],
}

/// A plate in one direction of the bed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct WayScatter {
    way: &'static str,
    /// Largest of the press of the file.
    residual_n: f64,
    worst_weak_n: f64,
    worst_strong_n: f64,
    p95_as_built_n: f64,
    p95_reset_n: f64,
}

/// The section's values for a plate.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct PlateScatter {
    ways: Vec<WayScatter>,
    p95_fixed_bottom_n: Option<f64>,
}

/// A plate whose air has the length of its stations, in presses that differ.
struct FrozenPlate<'a> {
    buffer: FrozenBuffer,
    stations: &'a [PlateStation],
    half_widths: HalfWidths,
    sampling: &'a Sampling,
}

impl FrozenPlate<'_> {
    /// The change of the residual force for one of a parameter, N, to first order: the air has its factor.
    fn effect(&self, parameter: Parameter, station: &PlateStation, way: usize) -> f64 {
        let own = parameter.effect(&self.buffer, &station.at);
        match parameter {
            Parameter::Mass | Parameter::Speed => own,
            _ => station.factors.get(way).copied().unwrap_or(1.0) * own,
        }
    }

    /// Residual force of a press, N.
    fn residual(&self, fault: &super::fault::Fault, station: &PlateStation, way: usize) -> f64 {
        let [inertia, air] = self.parts(fault, station, way);
        inertia - air
    }

    /// Inertia, and what the air takes of it, N.
    fn parts(&self, fault: &super::fault::Fault, station: &PlateStation, way: usize) -> [f64; 2] {
        let inertia = self.buffer.unit_force * fault.square * station.at.load;
        let air = inertia - self.buffer.residual(fault, station.at.load, station.at.length);
        [inertia, station.factors.get(way).copied().unwrap_or(1.0) * air]
    }

    /// Standard deviation to first order, N: as built, and with the screw set by the residual at the end of the braking half.
    fn deviations(&self, station: &PlateStation, way: usize) -> [f64; 2] {
        let end = self.stations.last();
        let mut squares = [0.0; 2];
        for (parameter, half_width) in Parameter::ALL.into_iter().zip(&self.half_widths) {
            let own = self.effect(parameter, station, way);
            let taken = end.map_or(0.0, |end| {
                let by_screw = self.effect(Parameter::Column, station, way) / self.effect(Parameter::Column, end, 0);
                by_screw * self.effect(parameter, end, 0)
            });
            let forces = match parameter {
                Parameter::Screw => [0.0, half_width * own],
                _ => [half_width * own, half_width * (own - taken)],
            };
            let variance = self.sampling.distribution.variance(Parameter::Mass);
            for (square, force) in squares.iter_mut().zip(forces) {
                *square += force * force * variance;
            }
        }
        squares.map(libm::sqrt)
    }

    fn of_way(&self, way: usize, name: &'static str) -> WayScatter {
        let corners = Corners::new(&self.buffer, &self.half_widths);
        let none = super::fault::Fault::none(self.buffer.exponent);
        let mut found = WayScatter {
            way: name,
            residual_n: 0.0,
            worst_weak_n: 0.0,
            worst_strong_n: 0.0,
            p95_as_built_n: 0.0,
            p95_reset_n: 0.0,
        };
        for station in self.stations {
            let own = self.residual(&none, station, way);
            let [[light, strong], [heavy, weak]] =
                [&corners.strong, &corners.weak].map(|fault| self.parts(fault, station, way));
            // Where the friction turns the force of the air round, the strong air leaves more.
            let (strong, weak) = (light - strong.max(weak), heavy - strong.min(weak));
            let [built, reset] = self
                .deviations(station, way)
                .map(|sigma| (own.abs() + propagation::ONE_SIDE * sigma).max(propagation::BOTH_SIDES * sigma));
            found.residual_n = if own.abs() > found.residual_n.abs() { own } else { found.residual_n };
            found.worst_weak_n = found.worst_weak_n.max(weak);
            found.worst_strong_n = found.worst_strong_n.min(strong);
            found.p95_as_built_n = found.p95_as_built_n.max(built);
            found.p95_reset_n = found.p95_reset_n.max(reset);
        }
        found
    }
}

/// The section of a plate with the law of its column and its air by (18).
#[must_use]
pub fn of_plate(
    sampling: &Sampling,
    cylinder: &Cylinder,
    law: &CrankLaw,
    stations: &[PlateStation],
) -> Option<Section> {
    let buffer = FrozenBuffer::of_law(law, cylinder);
    let half_widths = without(&sampling.half_widths, &[Parameter::Phase]);
    let shortest = stations.iter().map(|station| station.at.length).fold(f64::INFINITY, f64::min);
    let most = half_widths.get(4).zip(half_widths.get(5)).map_or(0.0, |(column, lead)| column + lead);
    if !(law.column() * shortest > most) {
        return None;
    }
    let plate = FrozenPlate { buffer, stations, half_widths, sampling };
    let values = PlateScatter {
        ways: vec![plate.of_way(0, "in"), plate.of_way(1, "back")],
        p95_fixed_bottom_n: monte_carlo::left_in_practice(&buffer, sampling, 0.0).ok().flatten().map(|left| left.fixed),
    };
    let words = values.describe();
    Some(Section::new("scatter", &values).with_words(words))
}

impl PlateScatter {
    fn describe(&self) -> Vec<String> {
        let ways = self.ways.iter().map(|way| {
            format!(
                "{}: presses that differ leave {} to {} N, {} N where nothing differs; P95 about {} N as built, {} N with the screw reset",
                if way.way == "in" { "while braking" } else { "on the return" },
                whole_newtons(way.worst_strong_n),
                whole_newtons(way.worst_weak_n),
                whole_newtons(way.residual_n),
                whole_newtons(way.p95_as_built_n),
                whole_newtons(way.p95_reset_n)
            )
        });
        let fixed = self.p95_fixed_bottom_n.map(whole_newtons);
        ways.chain(fixed.map(|force| format!("P95 of a fixed bottom without friction {force} N"))).collect()
    }
}

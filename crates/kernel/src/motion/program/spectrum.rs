//! Harmonics of a program, and the residual vibration of its movements.
//!
//! Both are Fourier integrals of the acceleration, ∫ s'' e^{iκθ} dθ with the jumps of the velocity: over a turn and by parts twice those of the
//! position are −1/κ² times as large; over a movement from rest to rest, with κ = ω_n/Ω, a load on an undamped spring of the natural
//! frequency ω_n swings by |∫|/κ after it.

use super::{Program, ProgramSegment};
use crate::motion::laws::{AccelerationSpectrum, residual_peak};
use crate::numeric::extremum::Extremum;
use crate::numeric::quadrature;
use nalgebra::Complex;
use std::f64::consts::{PI, TAU};

/// Panels of a part over which the mean is integrated: 1e-16 of ten half waves.
const PANELS: u32 = 8;

/// The position of a program over a turn, as a mean and waves: a_k cos kθ + b_k sin kθ, of the lift, m or rad.
#[derive(Debug, Clone, PartialEq)]
pub struct Harmonics {
    /// a_0.
    pub mean: f64,
    /// a_k and b_k, k = 1, 2, …
    pub waves: Vec<[f64; 2]>,
}

/// Accelerations in the order of the angle.
#[derive(Debug, Clone)]
struct Accelerations {
    /// First angle, width, travel and shape of each segment that moves.
    moves: Vec<(f64, f64, f64, AccelerationSpectrum)>,
    /// Jumps of the velocity and their angles.
    jumps: Vec<(f64, f64)>,
}

fn on_unit_circle(angle: f64) -> Complex<f64> {
    let (sin, cos) = libm::sincos(angle);
    Complex::new(cos, sin)
}

impl Accelerations {
    /// The accelerations of segments in their order, each with the angle by which it is shifted; they begin and end with these velocities.
    fn new<'s>(segments: impl Iterator<Item = (&'s ProgramSegment, f64)>, before: f64, behind: f64) -> Self {
        let (mut moves, mut jumps, mut velocity, mut end) = (Vec::new(), Vec::new(), before, 0.0);
        for (segment, shift) in segments {
            let start = segment.start + shift;
            let [first, last] = end_velocities(segment);
            jumps.push((start, first - velocity));
            (velocity, end) = (last, start + segment.width);
            if let Some(curve) = &segment.curve {
                moves.push((start, segment.width, segment.travel, curve.spectrum()));
            }
        }
        jumps.push((end, behind - velocity));
        jumps.retain(|(_, by)| *by != 0.0);
        Self { moves, jumps }
    }

    /// ∫ s'' e^{iκθ} dθ.
    fn transform(&self, order: f64) -> Complex<f64> {
        let moves = self.moves.iter().map(|(start, width, travel, spectrum)| {
            spectrum.transform(order * width) * on_unit_circle(order * start) * (travel / width)
        });
        let jumps = self.jumps.iter().map(|(at, by)| on_unit_circle(order * at) * *by);
        moves.chain(jumps).sum()
    }
}

/// Velocities of a segment at both ends, by the angle.
fn end_velocities(segment: &ProgramSegment) -> [f64; 2] {
    let Some(curve) = &segment.curve else { return [0.0; 2] };
    let scale = segment.travel / segment.width;
    [(0, 0.0), (curve.parts().saturating_sub(1), 1.0)].map(|(part, x)| {
        let [_, velocity, ..] = curve.values_at(part, x);
        scale * velocity
    })
}

/// A movement of a program: segments from one rest to the next.
#[derive(Debug, Clone)]
pub struct ProgramMovement {
    /// First and last cam angle, rad.
    pub angles: (f64, f64),
    /// Largest less least position, m or rad.
    pub travel: f64,
    accelerations: Accelerations,
}

impl ProgramMovement {
    /// Amplitude of the residual vibration of a load on an undamped spring, over the travel, when the natural frequency is this multiple of
    /// the speed of the cam.
    #[must_use]
    pub fn residual(&self, frequency: f64) -> f64 {
        self.accelerations.transform(frequency).norm() / (frequency * self.travel)
    }

    /// The largest residual vibration over a range of frequencies, and where.
    #[must_use]
    pub fn largest_residual(&self, frequencies: (f64, f64)) -> Extremum {
        residual_peak(|frequency| self.residual(frequency), frequencies, self.periods(frequencies.1))
    }

    /// How many natural periods it takes.
    #[must_use]
    pub fn periods(&self, frequency: f64) -> f64 {
        frequency * (self.angles.1 - self.angles.0) / TAU
    }
}

impl Program {
    /// Its lift as a number of waves over the turn.
    #[must_use]
    pub fn harmonics(&self, count: u32) -> Harmonics {
        let last = self.segments.last().map_or(0.0, |segment| end_velocities(segment)[1]);
        let all = Accelerations::new(self.segments.iter().map(|segment| (segment, 0.0)), last, last);
        let waves = (1..=count).map(|order| {
            // Other waves cancel over the lobes.
            if !order.is_multiple_of(self.lobes) {
                return [0.0; 2];
            }
            let order = f64::from(order);
            let found = all.transform(order) * (-f64::from(self.lobes) / (PI * order * order));
            [found.re, found.im]
        });
        Harmonics { mean: self.mean() - self.lowest, waves: waves.collect() }
    }

    /// Mean position.
    fn mean(&self) -> f64 {
        self.segments
            .iter()
            .map(|segment| {
                let Some(curve) = &segment.curve else { return segment.width * segment.from };
                segment.width
                    * (segment.from
                        + segment.travel
                            * (0..curve.parts())
                                .map(|index| {
                                    quadrature::integrate(
                                        |x| curve.values_at(index, x)[0],
                                        curve.range_of(index),
                                        PANELS,
                                    )
                                })
                                .sum::<f64>())
            })
            .sum::<f64>()
            * f64::from(self.lobes)
            / TAU
    }

    /// Its movements from rest to rest in the first lobe; empty for a program that never rests. A movement across the end of the lobe starts
    /// before that end.
    #[must_use]
    pub fn movements(&self) -> Vec<ProgramMovement> {
        let count = self.segments.len();
        let whole = TAU / f64::from(self.lobes);
        let Some(first) = self.segments.iter().position(|segment| segment.curve.is_none()) else { return Vec::new() };
        // From the end of a rest, around to it.
        let round = self.segments.iter().map(|segment| (segment, 0.0)).chain(self.segments.iter().map(|s| (s, whole)));
        let all: Vec<(&ProgramSegment, f64)> = round.skip(first + 1).take(count).collect();
        let moving = all.split(|(segment, _)| segment.curve.is_none()).filter(|run| !run.is_empty());
        let movements = moving.filter_map(|run| {
            let ((begin, shift), (end, last_shift)) = (run.first()?, run.last()?);
            let accelerations = Accelerations::new(run.iter().map(|(s, by)| (*s, by - shift)), 0.0, 0.0);
            let angles = (begin.start, end.start + end.width + (last_shift - shift));
            let ranges = run.iter().map(|(segment, _)| super::summary::range(segment));
            let (low, top) =
                ranges.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, top), (l, t)| (low.min(l), top.max(t)));
            (top > low).then_some(ProgramMovement { angles, travel: top - low, accelerations })
        });
        let mut movements: Vec<ProgramMovement> = movements.collect();
        movements.sort_by(|a, b| a.angles.0.total_cmp(&b.angles.0));
        movements
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::laws::{LawTask, Parameters, named};
    use crate::motion::{Motion, Quantity};

    /// Rise 30 mm modified-sine 120°, dwell 30°, return 3-4-5 150°, dwell 60°.
    fn known() -> Program {
        let (rise, fall) = (named("modified-sine"), named("3-4-5"));
        let deg = f64::to_radians;
        let segments =
            [(rise, deg(120.0), 0.03), (None, deg(30.0), 0.03), (fall, deg(150.0), 0.0), (None, deg(60.0), 0.0)];
        Program::new(Quantity::Length, 0.0, &segments).expect("a program")
    }

    /// Values of 40-digit arithmetic, mm.
    #[test]
    fn harmonics_are_those_known() {
        let found = known().harmonics(20);
        let near = |found: f64, millimetres: f64| assert!((1e3 * found - millimetres).abs() < 2e-14, "{found}");
        near(found.mean, 13.75);
        for (order, cos, sin) in [
            (1, -13.550_642_463_425_68, 10.344_265_786_266_98),
            (2, -0.053_628_819_783_057_08, -1.669_988_578_856_582),
            (5, -0.034_878_285_129_560_7, 0.057_752_858_655_138_32),
            (12, 0.0, -0.003_656_685_825_343_279),
        ] {
            let [a, b] = found.waves[order - 1];
            near(a, cos);
            near(b, sin);
        }
    }

    /// The waves add up to the lift: with jumps of the velocity, lobes and a start elsewhere, to what is left of the others.
    #[test]
    fn harmonics_add_up_to_the_lift() {
        let steps = |lobes: f64| {
            let rest = super::super::EndState::default();
            let law = |name: &str| {
                let law = named(name).expect("a law");
                super::super::Mover::Law(law, None, Parameters::default())
            };
            let deg = |degrees: f64| degrees.to_radians() / lobes;
            let step = |mover, degrees, to| super::super::SegmentSpec {
                mover,
                over: deg(degrees),
                to,
                end: rest,
                free_start: false,
            };
            [
                step(law("3-4-5"), 100.0, 0.02),
                step(super::super::Mover::Dwell, 50.0, 0.02),
                step(law("line"), 80.0, 0.005),
                step(law("gutman-1-3"), 130.0, 0.0),
            ]
        };
        for lobes in [1_u32, 3] {
            let steps = steps(f64::from(lobes));
            let program = Program::of_steps(Quantity::Length, 0.7, 0.0, lobes, &steps).expect("a program");
            let found = program.harmonics(3000);
            for angle in [0.0, 0.7, 1.1, 2.9, 4.4, 6.0] {
                let waves = (1_u32..).map(f64::from).zip(&found.waves);
                let sum: f64 = waves.map(|(k, [a, b])| a * (k * angle).cos() + b * (k * angle).sin()).sum();
                let (piece, inside) = program.locate(angle);
                let lift = program.jet(piece, inside).s;
                assert!((found.mean + sum - lift).abs() < 2e-6, "{lobes} at {angle}: {} {lift}", found.mean + sum);
            }
        }
    }

    /// The residual vibration after each movement, by Duhamel's integral of the moving cam: z'' + κ² z = −s'' from rest.
    #[test]
    fn residuals_are_those_of_the_moving_load() {
        let program = known();
        let movements = program.movements();
        assert_eq!(movements.len(), 2);
        for movement in &movements {
            for frequency in [3.0, 7.5, 11.1, 40.0] {
                let part = |f: fn(f64) -> f64| {
                    let (from, to) = movement.angles;
                    let product = |angle: f64| {
                        // From inside the movement.
                        let (piece, inside) = program.locate(angle.min(to - 1e-12).max(from + 1e-12));
                        program.jet(piece, inside).dds * f(frequency * angle)
                    };
                    let middle = 0.5 * (from + to);
                    let eighths = [from, from + 0.125 * (to - from), middle, to - 0.125 * (to - from), to];
                    eighths.windows(2).map(|w| quadrature::integrate(product, (w[0], w[1]), 64)).sum::<f64>()
                };
                let known = part(libm::cos).hypot(part(libm::sin)) / (frequency * 0.03);
                let found = movement.residual(frequency);
                assert!((found - known).abs() < 1e-12, "{frequency}: {found} {known}");
            }
        }
        let rise = named("modified-sine").and_then(|law| law.solve(&LawTask::default()).ok()).expect("a law");
        assert!((movements[0].periods(7.5) - 2.5).abs() < 1e-15);
        assert!((movements[0].residual(7.5) - rise.residual(2.5)).abs() < 1e-15);
    }

    /// A movement may go over the end of the turn, and be made of several segments.
    #[test]
    fn movements_go_from_rest_to_rest() {
        let law = named("3-4-5");
        let segments = [(law, 1.0, 0.02), (None, 1.0, 0.02), (law, 2.0, 0.01), (law, 0.0, 0.0)];
        let movements = Program::new(Quantity::Length, 0.0, &segments).expect("a program").movements();
        assert_eq!(movements.len(), 1);
        assert!((movements[0].angles.0 - 2.0).abs() < 1e-15 && (movements[0].angles.1 - TAU - 1.0).abs() < 1e-14);
        assert!((movements[0].travel - 0.02).abs() < 1e-15);
        let restless = [(law, 3.0, 0.02), (law, 0.0, 0.0)];
        assert!(Program::new(Quantity::Length, 0.0, &restless).expect("a program").movements().is_empty());
    }
}

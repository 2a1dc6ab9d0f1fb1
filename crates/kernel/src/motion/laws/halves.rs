//! Laws of two halves, each from an end of the segment to the inflection, where the acceleration is 0 on both sides.
//!
//! A half describes how the velocity runs from 0 to 1, φ(y) over y ∈ [0, 1] from its outer end; F = ∫φ and m = F(1). Before the
//! inflection λ the velocity is v0 + (vm − v0) φ1(x/λ), after it v1 + (vm − v1) φ2((1 − x)/(1 − λ)): for any λ and end
//! velocities, value, velocity and acceleration are continuous there. That the travel is 1,
//!
//! ```text
//! λ v0 + λ (vm − v0) m1 + μ v1 + μ (vm − v1) m2 = 1,  μ = 1 − λ,
//! ```
//!
//! gives vm, the velocity at the inflection. The laws and their constants: Neklutin, "Mechanisms and cams for automatic
//! machines" (1969); Norton, "Cam design and manufacturing handbook", chapter 3; VDI 2143, part 1.

use super::curve::{CurvePart, LawCurve};
use super::law::{Half, Law, LawFamily, Ramp};
use super::local::{LocalPiece, LocalWave};
use super::task::{Inflection, LawError, LawTask, Parameters, SegmentEnd};
use std::f64::consts::PI;

/// The phase of the acceleration in a piece of a half.
#[derive(Debug, Clone, Copy, PartialEq)]
enum AccelerationPhase {
    Grows,
    /// Grows and falls as one sine.
    Swells,
    Stays,
    Falls,
    Rests,
}

/// A piece of a half from y on.
#[derive(Debug, Clone, Copy)]
struct HalfPiece {
    kind: AccelerationPhase,
    y: f64,
    width: f64,
    /// φ and F where it begins.
    velocity: f64,
    travel: f64,
}

impl Half {
    pub(super) const fn sine(fractions: [f64; 4]) -> Self {
        Self { ramp: Ramp::Sine, fractions }
    }

    pub(super) const fn straight(fractions: [f64; 4]) -> Self {
        Self { ramp: Ramp::Straight, fractions }
    }

    /// The half for an end at a turn, where the velocity is 0 and the acceleration is free. One that begins with its full
    /// acceleration turns as it is; straight ramps and the modified trapezoid hold it until they fall as between rests; all
    /// others fall as one cosine, as the harmonic does.
    fn at_turn(self) -> Self {
        let [a, b, c, _] = self.fractions;
        let fractions = if a == 0.0 {
            self.fractions
        } else if self.ramp == Ramp::Straight || self == MODIFIED_TRAPEZOID_HALF {
            [0.0, a + b, c, 0.0]
        } else {
            [0.0, 0.0, 1.0, 0.0]
        };
        Self { fractions, ..self }
    }

    /// Integral of a ramp of width 1 to 1, and its first moment from the foot.
    fn ramp_area(self) -> (f64, f64) {
        match self.ramp {
            Ramp::Sine => (2.0 / PI, 2.0 / PI * (1.0 - 2.0 / PI)),
            Ramp::Straight => (0.5, 1.0 / 6.0),
        }
    }

    /// φ' where the acceleration is largest.
    fn peak(self) -> f64 {
        let ([a, b, c, _], (area, _)) = (self.fractions, self.ramp_area());
        1.0 / (area * a + b + area * c)
    }

    /// φ' at the outer end.
    fn at_outer_end(self) -> f64 {
        let [a, b, c, _] = self.fractions;
        if a > 0.0 || b + c == 0.0 { 0.0 } else { self.peak() }
    }

    /// −φ'' at the inflection, where the acceleration falls to 0 just there.
    fn fall(self) -> Option<f64> {
        let [_, _, c, d] = self.fractions;
        let steepest = if self.ramp == Ramp::Sine { 0.5 * PI } else { 1.0 };
        (c > 0.0 && d == 0.0).then(|| steepest * self.peak() / c)
    }

    /// The pieces that have a width, from the outer end, and m = F(1).
    fn stretches(self) -> (Vec<HalfPiece>, f64) {
        let [a, b, c, d] = self.fractions;
        let (peak, (area, moment)) = (self.peak(), self.ramp_area());
        let swells = self.ramp == Ramp::Sine && b == 0.0 && a == c;
        let kinds = if swells {
            [
                (AccelerationPhase::Swells, a + c),
                (AccelerationPhase::Stays, 0.0),
                (AccelerationPhase::Falls, 0.0),
                (AccelerationPhase::Rests, d),
            ]
        } else {
            [
                (AccelerationPhase::Grows, a),
                (AccelerationPhase::Stays, b),
                (AccelerationPhase::Falls, c),
                (AccelerationPhase::Rests, d),
            ]
        };
        let mut stretches = Vec::with_capacity(4);
        let (mut y, mut velocity, mut travel) = (0.0, 0.0, 0.0);
        for (kind, width) in kinds {
            if width == 0.0 {
                continue;
            }
            stretches.push(HalfPiece { kind, y, width, velocity, travel });
            // Growth of φ, and of F in addition to the initial φ.
            let (gained, moved) = match kind {
                AccelerationPhase::Grows => (area, moment),
                AccelerationPhase::Swells => (area, 0.5 * area),
                AccelerationPhase::Stays => (1.0, 0.5),
                AccelerationPhase::Falls => (area, area - moment),
                AccelerationPhase::Rests => (0.0, 0.0),
            };
            travel += width * velocity + peak * width * width * moved;
            velocity += peak * width * gained;
            y += width;
        }
        (stretches, travel)
    }

    /// m = F(1).
    fn travel(self) -> f64 {
        self.stretches().1
    }

    /// The pieces by the distance from the outer end, with their beginnings: of a half of this width, from end velocity to
    /// that of the inflection.
    fn pieces(self, width: f64, end: f64, inflection: f64) -> Vec<(f64, LocalPiece)> {
        let gain = inflection - end;
        // Largest acceleration.
        let peak = gain * self.peak() / width;
        let pieces = self.stretches().0.into_iter().map(|stretch| {
            let (from, over) = (width * stretch.y, width * stretch.width);
            let value = end * from + gain * width * stretch.travel;
            let velocity = end + gain * stretch.velocity;
            let quarter = 0.5 * PI / over;
            let wave = |pace: f64, turn: f64, rise: f64| {
                let square = pace * pace;
                let wave = LocalWave { harmonic: 1, turn: turn * peak / square, rise: rise * peak / square };
                LocalPiece::waves(from, [value, velocity, 0.0, 0.0], pace, &[wave])
            };
            let cubic = |second: f64, third: f64| LocalPiece::polynomial(from, [value, velocity, second, third]);
            let local = match (stretch.kind, self.ramp) {
                (AccelerationPhase::Grows, Ramp::Sine) => wave(quarter, 1.0, 0.0),
                (AccelerationPhase::Falls, Ramp::Sine) => wave(quarter, 0.0, 1.0),
                (AccelerationPhase::Swells, _) => wave(2.0 * quarter, 1.0, 0.0),
                (AccelerationPhase::Grows, Ramp::Straight) => cubic(0.0, peak / (6.0 * over)),
                (AccelerationPhase::Falls, Ramp::Straight) => cubic(0.5 * peak, -peak / (6.0 * over)),
                (AccelerationPhase::Stays, _) => cubic(0.5 * peak, 0.0),
                (AccelerationPhase::Rests, _) => cubic(0.0, 0.0),
            };
            (from, local)
        });
        pieces.collect()
    }
}

/// Velocity at the inflection λ of two halves, in units of travel over width.
fn velocity_at(inflection: f64, v0: f64, m1: f64, v1: f64, m2: f64) -> f64 {
    let rest = 1.0 - inflection;
    (1.0 - inflection * v0 * (1.0 - m1) - rest * v1 * (1.0 - m2)) / (inflection * m1 + rest * m2)
}

/// λ with continuous jerk between rests: where −φ1''/λ² = −φ2''/μ².
fn smooth(first: Half, second: Half) -> f64 {
    match (first.fall(), second.fall()) {
        (Some(before), Some(after)) if first != second => 1.0 / (1.0 + (after / before).sqrt()),
        _ => 0.5,
    }
}

/// λ with this acceleration at the later turn: the root of a quadratic.
///
/// Seen from the turn, the acceleration is g = p vm/ν with ν the width of the turn's half, p its φ' at the turn, v and m the
/// velocity and F(1) of the half at the other end, M that of the turn's. With vm = (1 − (1 − ν) v (1 − m))/((1 − ν) m + ν M)
/// that is g ν ((1 − ν) m + ν M) = p (1 − (1 − ν) v (1 − m)).
fn matching(law: &'static str, task: &LawTask, first: Half, second: Half, wanted: f64) -> Result<f64, LawError> {
    let (turn, other, velocity, g) = match (task.from, task.to) {
        (from, SegmentEnd::Turn) => (second, first, from.velocity(), -wanted),
        (SegmentEnd::Turn, to) => (first, second, to.velocity(), wanted),
        _ => {
            return Err(LawError::new(
                "inflection",
                "an inflection that matches an acceleration needs a turn at one end",
            ));
        }
    };
    let (p, m, big) = (turn.at_outer_end(), other.travel(), turn.travel());
    let lost = velocity * (1.0 - m);
    let (square, linear, constant) = (g * (big - m), g * m - p * lost, -p * (1.0 - lost));
    let root = (linear * linear - 4.0 * square * constant).sqrt();
    // Without cancellation: the one root from the sum of like signs, the other from the product of both.
    let sum = -0.5 * (linear + if linear < 0.0 { -root } else { root });
    let inside = [sum / square, constant / sum].into_iter().filter(|width| 0.0 < *width && *width < 1.0);
    // Of two roots, the one nearer to half-way.
    let width = inside.min_by(|a, b| (a - 0.5).abs().total_cmp(&(b - 0.5).abs()));
    let width = width.ok_or_else(|| {
        let unit = "(in travel over width squared)";
        let what = format!("no inflection of {law} gives an acceleration of {wanted} at the turn {unit}");
        LawError::new("inflection", what)
    })?;
    Ok(if task.to == SegmentEnd::Turn { 1.0 - width } else { width })
}

/// The curve with the same half at both ends.
pub(super) fn solve(law: &'static str, half: Half, task: &LawTask) -> Result<LawCurve, LawError> {
    let [first, second] = [task.from, task.to].map(|end| if end == SegmentEnd::Turn { half.at_turn() } else { half });
    let (v0, v1) = (task.from.velocity(), task.to.velocity());
    let inflection = match task.inflection {
        Inflection::Smooth => smooth(first, second),
        Inflection::At(found) if (LEAST..=1.0 - LEAST).contains(&found) => found,
        Inflection::At(found) => {
            return Err(LawError::parameter("inflection", "at least 0.000001 and at most 0.999999", found));
        }
        Inflection::Match { acceleration } => matching(law, task, first, second, acceleration)?,
    };
    let rest = 1.0 - inflection;
    let middle = velocity_at(inflection, v0, first.travel(), v1, second.travel());
    let lower = first.pieces(inflection, v0, middle);
    let upper = second.pieces(rest, v1, middle);
    let joined = is_one_function((first, inflection, middle - v0), (second, rest, middle - v1));
    let (joints, parts) = joined_parts(lower, upper, inflection, joined);
    Ok(LawCurve::of_parts(joints, parts, inflection, (middle - v0) * (middle - v1) < 0.0))
}

/// The pieces of both halves in order of x, with the inflection a joint or not.
fn joined_parts(
    mut lower: Vec<(f64, LocalPiece)>,
    mut upper: Vec<(f64, LocalPiece)>,
    inflection: f64,
    joined: bool,
) -> (Vec<f64>, Vec<CurvePart>) {
    let (before, behind) = (lower.pop(), upper.pop());
    let mut joints: Vec<f64> = lower.iter().skip(1).map(|(from, _)| *from).collect();
    let mut parts: Vec<CurvePart> = lower.into_iter().map(|(_, local)| CurvePart::early(local)).collect();
    if let (Some((from, early)), Some((until, late))) = (before, behind) {
        // A piece's beginning is a joint unless it is the end of the segment.
        joints.extend((from > 0.0).then_some(from));
        if joined {
            parts.push(CurvePart::Waves { split: inflection, early, late });
        } else {
            joints.push(inflection);
            parts.extend([CurvePart::early(early), CurvePart::late(late)]);
        }
        joints.extend((until > 0.0).then_some(1.0 - until));
    }
    for (from, local) in upper.into_iter().rev() {
        joints.extend((from > 0.0).then_some(1.0 - from));
        parts.push(CurvePart::late(local));
    }
    (joints, parts)
}

/// Whether two halves, each of a width and a gain of velocity, pass the inflection as one function: two straight lines, or
/// falls of the same width and height, which then are one sine or line.
fn is_one_function(first: (Half, f64, f64), second: (Half, f64, f64)) -> bool {
    let [_, _, c1, d1] = first.0.fractions;
    let [_, _, c2, d2] = second.0.fractions;
    let [height, other] = [first, second].map(|(half, width, gain)| gain * half.peak() / width);
    d1 > 0.0 && d2 > 0.0
        || first.0.fall().is_some()
            && second.0.fall().is_some()
            && first.0.ramp == second.0.ramp
            && is_alike(c1 * first.1, c2 * second.1)
            && is_alike(height, other)
}

fn is_alike(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * a.abs().max(b.abs())
}

/// Two numbers that differ by less are equal up to rounding.
const SAME: f64 = 8.0 * f64::EPSILON;

const MODIFIED_TRAPEZOID_HALF: Half = Half::sine([0.25, 0.5, 0.25, 0.0]);

/// The least share of a half or a segment that is not 0: less than a millionth of a segment is not a real angle of a cam.
pub(super) const LEAST: f64 = 1e-6;

/// The half given by the parameters of scca.
fn scca_half(parameters: &Parameters) -> Result<Half, LawError> {
    let fractions = parameters.fractions.unwrap_or([0.25; 4]);
    let [a, b, c, _] = fractions;
    let whole = (fractions.iter().sum::<f64>() - 1.0).abs() <= WHOLE;
    if whole && fractions.iter().all(|fraction| *fraction == 0.0 || *fraction >= LEAST) && a + b + c > 0.0 {
        return Ok(Half::sine(fractions));
    }
    let expected = "four numbers with the sum 1, each 0 or at least 0.000001, the last below 1";
    Err(LawError::parameter("fractions", expected, format_args!("{fractions:?}")))
}

/// Largest difference of the sum of typed fractions from 1.
const WHOLE: f64 = 1e-12;

/// The share of a half that is a straight line.
fn line(parameters: &Parameters) -> Result<f64, LawError> {
    let line = parameters.line.unwrap_or(0.5);
    if (0.0..=1.0 - LEAST).contains(&line) {
        return Ok(line);
    }
    Err(LawError::parameter("line", "at least 0 and at most 0.999999", line))
}

const fn law(
    name: &'static str,
    aliases: &'static [&'static str],
    formula: &'static str,
    continuity: u32,
    half: fn(&Parameters) -> Result<Half, LawError>,
) -> Law {
    Law { name, aliases, formula, continuity, shape: LawFamily::Halves(half) }
}

pub(super) const PARABOLA: Law =
    law("parabola", &[], "2 x^2, then 1 - 2 (1 - x)^2", 1, |_| Ok(Half::sine([0.0, 1.0, 0.0, 0.0])));
pub(super) const HARMONIC: Law = law("harmonic", &[], "(1 - cos(pi x))/2", 1, |_| Ok(Half::sine([0.0, 0.0, 1.0, 0.0])));
pub(super) const CYCLOIDAL: Law =
    law("cycloidal", &["inclined-sine", "bestehorn"], "x - sin(2 pi x)/(2 pi)", 2, |_| {
        Ok(Half::sine([0.5, 0.0, 0.5, 0.0]))
    });
pub(super) const MODIFIED_SINE: Law =
    law("modified-sine", &[], "s'' = A sin(4 pi x), then A cos(4 pi (x - 1/8)/3)", 2, |_| {
        Ok(Half::sine([0.25, 0.0, 0.75, 0.0]))
    });
pub(super) const MODIFIED_TRAPEZOID: Law =
    law("modified-trapezoid", &[], "s'' = A sin(4 pi x), then A, then A cos(4 pi (x - 3/8))", 2, |_| {
        Ok(MODIFIED_TRAPEZOID_HALF)
    });
pub(super) const MODIFIED_SINE_CV20: Law =
    law("modified-sine-cv20", &[], "modified-sine with 20 % of the time a straight line", 2, |_| {
        Ok(Half::sine([0.2, 0.0, 0.6, 0.2]))
    });
pub(super) const MODIFIED_SINE_CV33: Law =
    law("modified-sine-cv33", &[], "modified-sine with a third of the time a straight line", 2, |_| {
        Ok(Half::sine([1.0 / 6.0, 0.0, 0.5, 1.0 / 3.0]))
    });
pub(super) const MODIFIED_SINE_CV50: Law =
    law("modified-sine-cv50", &[], "modified-sine with half of the time a straight line", 2, |_| {
        Ok(Half::sine([0.125, 0.0, 0.375, 0.5]))
    });
pub(super) const MODIFIED_SINE_CV66: Law =
    law("modified-sine-cv66", &[], "modified-sine with two thirds of the time a straight line", 2, |_| {
        Ok(Half::sine([1.0 / 12.0, 0.0, 0.25, 2.0 / 3.0]))
    });
pub(super) const CYCLOIDAL_CV50: Law =
    law("cycloidal-cv50", &[], "cycloidal with half of the time a straight line", 2, |_| {
        Ok(Half::sine([0.25, 0.0, 0.25, 0.5]))
    });
pub(super) const SCCA: Law = law("scca", &[], "s'' = a sine, A, a cosine, 0, by fractions of the half", 2, scca_half);
pub(super) const PARABOLA_LINE: Law =
    law("parabola-line", &["quadratic-line"], "parabola, straight line, parabola", 1, |parameters| {
        line(parameters).map(|line| Half::sine([0.0, 1.0 - line, 0.0, line]))
    });
pub(super) const SINE_LINE: Law = law("sine-line", &[], "harmonic, straight line, harmonic", 1, |parameters| {
    line(parameters).map(|line| Half::sine([0.0, 0.0, 1.0 - line, line]))
});

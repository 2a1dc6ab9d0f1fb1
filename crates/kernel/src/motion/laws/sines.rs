//! Laws that are one sum of sines over the whole segment.

use super::curve::{CurvePart, LawCurve};
use super::law::{Law, LawFamily, Sines};
use super::local::{LocalPiece, LocalWave};
use super::task::{LawError, Parameters, SegmentEnd};
use std::f64::consts::{PI, TAU};

const HARMONICS: [u32; 4] = [1, 2, 3, 5];

/// The shape sheared to one velocity at both ends: v x + (1 − v) f(x), antisymmetric as f is.
pub(super) fn solve(sines: Sines, velocity: f64) -> LawCurve {
    let used = HARMONICS.into_iter().zip(sines).filter(|(_, amplitude)| *amplitude != 0.0);
    // x − Σ b sin = Σ b (2πkx − sin 2πkx), since Σ 2πk b = 1: so small values keep their digits.
    let waves: Vec<LocalWave> =
        used.map(|(harmonic, b)| LocalWave { harmonic, turn: (1.0 - velocity) * b, rise: 0.0 }).collect();
    let local = LocalPiece::waves(0.0, [0.0, velocity, 0.0, 0.0], TAU, &waves);
    LawCurve::smooth(CurvePart::Waves { split: 0.5, early: local.clone(), late: local })
}

/// The double harmonic from rest to a turn, or mirrored from a turn to rest.
///
/// (1 − cos πx)/2 − (1 − cos 2πx)/8 from the rest; 1 − s = (1 − cos πz)/2 + (1 − cos 2πz)/8 by the distance z from the turn.
pub(super) fn double_harmonic(from: SegmentEnd) -> LawCurve {
    let [rest, turn] = [-0.125, 0.125].map(|second| {
        let waves =
            [LocalWave { harmonic: 1, turn: 0.0, rise: 0.5 }, LocalWave { harmonic: 2, turn: 0.0, rise: second }];
        LocalPiece::waves(0.0, [0.0; 4], PI, &waves)
    });
    let (early, late) = if from == SegmentEnd::Turn { (turn, rest) } else { (rest, turn) };
    LawCurve::smooth(CurvePart::Waves { split: 0.5, early, late })
}

/// The sines of accelerations A sin(2πkx), k = 1, 2, 3, scaled so that the travel Σ A/(2πk) is 1.
fn triple(parameters: &Parameters) -> Result<Sines, LawError> {
    let amplitudes = parameters.amplitudes.unwrap_or([2.25 * PI, 0.0, -0.75 * PI]);
    let [one, two, three] = amplitudes;
    let travel = (one + two / 2.0 + three / 3.0) / TAU;
    let size = (one.abs() + two.abs() + three.abs()) / TAU;
    if size.is_finite() && travel > LEAST_TRAVEL * size {
        return Ok([(one, 1.0), (two, 2.0), (three, 3.0), (0.0, 1.0)]
            .map(|(amplitude, waves)| amplitude / travel / (TAU * TAU * waves * waves)));
    }
    let expected = "three finite numbers with A1 + A2/2 + A3/3 above 0";
    Err(LawError::parameter("amplitudes", expected, format_args!("{amplitudes:?}")))
}

/// A smaller share of the amplitudes is rounding: the accelerations cancel, and there is no travel to scale.
const LEAST_TRAVEL: f64 = 1e-6;

const fn law(name: &'static str, formula: &'static str, continuity: u32, shape: LawFamily) -> Law {
    Law { name, aliases: &[], formula, continuity, shape }
}

pub(super) const DOUBLE_HARMONIC: Law =
    law("double-harmonic", "((1 - cos(pi x)) - (1 - cos(2 pi x))/4)/2, to a turn", 1, LawFamily::DoubleHarmonic);
/// Gutman's cut of the parabola's series after its third harmonic: Rothbart, "Cam design handbook", chapter 4.
pub(super) const GUTMAN: Law = law(
    "gutman-1-3",
    "x - 15 sin(2 pi x)/(32 pi) - sin(6 pi x)/(96 pi)",
    2,
    LawFamily::Sines(|_| Ok([15.0 / (32.0 * PI), 0.0, 1.0 / (96.0 * PI), 0.0])),
);
/// Rothbart, "Cam design handbook", (4.12).
pub(super) const FREUDENSTEIN_1_3: Law = law(
    "freudenstein-1-3",
    "x - (27 sin(2 pi x)/28 + sin(6 pi x)/84)/(2 pi)",
    2,
    LawFamily::Sines(|_| Ok([27.0 / 28.0 / TAU, 0.0, 1.0 / 84.0 / TAU, 0.0])),
);
/// Rothbart, "Cam design handbook", (4.13).
pub(super) const FREUDENSTEIN_1_3_5: Law = law(
    "freudenstein-1-3-5",
    "x - 1125 (sin(2 pi x) + sin(6 pi x)/54 + sin(10 pi x)/1250)/(2384 pi)",
    2,
    LawFamily::Sines(|_| {
        let unit = 1125.0 / 1192.0 / TAU;
        Ok([unit, 0.0, unit / 54.0, unit / 1250.0])
    }),
);
pub(super) const TRIPLE_HARMONIC: Law =
    law("triple-harmonic", "s'' = A1 sin(2 pi x) + A2 sin(4 pi x) + A3 sin(6 pi x)", 4, LawFamily::Sines(triple));

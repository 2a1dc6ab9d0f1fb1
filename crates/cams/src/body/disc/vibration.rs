//! The load driven through an elastic train, as one mass on one spring that the follower moves: ẍ + 2 ζ ω_n ẋ + ω_n² x = ω_n² y if damped against the
//! frame, ẍ + 2 ζ ω_n (ẋ − ẏ) + ω_n² (x − y) = 0 if damped in the train.

use super::steady_vibration::ElasticTrain;
use super::{Disc, program};
use crate::machine::{DampingAgainst, VibrationData};
use crate::report::{Section, degrees, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Quantity;
use camgen_kernel::motion::program::{Harmonics, Program};
use camgen_kernel::numeric::extremum::Extremum;
use serde_json::{Value, json};
use std::f64::consts::TAU;

/// Share of the natural frequency within which the worst is looked for: as exactly as it is known before the machine runs.
const BESIDE: f64 = 0.2;
/// Smallest and largest number of waves over a lobe that are summed up, and how many times as far as the natural frequency: their
/// amplitudes fall with at least the third power of their order.
const LEAST_WAVES: u32 = 128;
const MOST_WAVES: u32 = 2048;
const BEYOND: f64 = 4.0;
/// Waves that the report gives, and that its words give.
const GIVEN: usize = 20;
const SHOWN: usize = 8;

/// Residual vibration after a movement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Movement {
    /// First and last cam angle, rad.
    pub angles: (f64, f64),
    /// Natural periods that it takes.
    pub periods: f64,
    /// Amplitude of the load behind it over its travel, undamped.
    pub residual: f64,
    /// The largest of these within a fifth of the natural frequency.
    pub worst: f64,
    /// Its number of periods.
    pub worst_periods: f64,
}

/// A speed at which a wave of the lift has the natural frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resonance {
    /// Which wave of a turn.
    pub order: u32,
    /// Speed of the cam, rpm.
    pub rpm: f64,
    /// Amplitude of the wave, m or rad.
    pub amplitude: f64,
}

/// The vibration of the load behind an elastic train.
#[derive(Debug, Clone, PartialEq)]
pub struct Vibration {
    /// Natural frequency over that of the cam.
    pub frequency: f64,
    /// Residual vibration after each movement from rest to rest.
    pub movements: Vec<Movement>,
    /// Largest deviation of the load from the follower when nothing changes from turn to turn, m or rad, and where; infinite at an undamped
    /// resonance.
    pub deviation: Extremum,
    /// The nearest resonances below and above the speed.
    pub resonances: Vec<Resonance>,
    /// The lift by waves.
    pub harmonics: Harmonics,
}

impl Vibration {
    fn of(program: &Program, lobes: u32, (data, against): (VibrationData, DampingAgainst), speed: f64) -> Self {
        let frequency = TAU * data.natural_frequency / speed;
        let movement = |movement: &camgen_kernel::motion::program::ProgramMovement| {
            let worst = movement.largest_residual(((1.0 - BESIDE) * frequency, (1.0 + BESIDE) * frequency));
            Movement {
                angles: movement.angles,
                periods: movement.periods(frequency),
                residual: movement.residual(frequency),
                worst: worst.value,
                worst_periods: movement.periods(worst.at),
            }
        };
        let waves = (BEYOND * frequency / f64::from(lobes)).clamp(f64::from(LEAST_WAVES), f64::from(MOST_WAVES));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between its bounds")]
        let harmonics = program.harmonics(lobes * waves as u32);
        let resonance = |order: f64| {
            let order = order.clamp(1.0, f64::from(u32::MAX));
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between its bounds")]
            let whole = order as u32;
            let index = usize::try_from(whole).unwrap_or(usize::MAX) - 1;
            let amplitude = harmonics.waves.get(index).map_or(0.0, |[a, b]| libm::hypot(*a, *b));
            Resonance { order: whole, rpm: 60.0 * data.natural_frequency / order, amplitude }
        };
        let of_lobes = f64::from(lobes);
        let (next, last) = ((frequency / of_lobes).ceil() * of_lobes, (frequency / of_lobes).floor() * of_lobes);
        let mut resonances = vec![resonance(next)];
        resonances.extend((last >= 1.0 && last < next).then(|| resonance(last)));
        Self {
            frequency,
            movements: program.movements().iter().map(movement).collect(),
            deviation: ElasticTrain { frequency, damping: data.damping, against }.largest_deviation(program),
            resonances,
            harmonics,
        }
    }

    /// The largest residual, and the movement that leaves it.
    #[must_use]
    pub fn largest(&self) -> Option<Movement> {
        self.movements.iter().copied().max_by(|a, b| a.residual.total_cmp(&b.residual))
    }
}

impl Disc {
    /// As [`Body::vibration`](crate::body::Body::vibration).
    pub(super) fn vibrating(&self) -> Option<&Vibration> {
        let found = self.program_follower.vibration.get_or_init(|| {
            let (data, speed) = (self.machine.vibration().filter(|_| self.is_of_program())?, self.speed?);
            Some(Vibration::of(
                self.motion.program()?,
                self.motion.lobes(),
                (data, self.machine.damping_against()),
                speed,
            ))
        });
        found.as_ref()
    }

    /// The sections `vibration` and `harmonics`.
    pub(super) fn vibration_sections(&self) -> Vec<Section> {
        let (Some(found), Some(data)) = (self.vibrating(), self.machine.vibration()) else { return Vec::new() };
        let swings = self.motion.quantity() == Quantity::Angle;
        let (unit, size) = if swings { ("deg", 1.0_f64.to_degrees()) } else { ("mm", MILLIMETRES) };
        let finite = |value: f64| Some(value).filter(|value| value.is_finite());
        let movements: Vec<Value> = found.movements.iter().map(movement_value).collect();
        let resonances: Vec<Value> = found
            .resonances
            .iter()
            .map(|at| json!({"order": at.order, "rpm": at.rpm, "amplitude": size * at.amplitude}))
            .collect();
        let against = match self.machine.damping_against() {
            DampingAgainst::Frame => "frame",
            DampingAgainst::Follower => "follower",
        };
        let damped = if data.damping > 0.0 { format!(", damped against the {against},") } else { String::new() };
        let deviation = size * found.deviation.value;
        let value = json!({
            "unit": unit,
            "natural_frequency_hz": data.natural_frequency,
            "damping": data.damping,
            "damping_against": against,
            "frequency_ratio": found.frequency,
            "movements": movements,
            "deviation_max": finite(deviation),
            "deviation_at_deg": degrees(found.deviation.at),
            "resonances": resonances,
        });
        let mut words: Vec<String> = found.movements.iter().map(movement_words).collect();
        words.push(match finite(deviation) {
            Some(deviation) => format!(
                "in steady operation the load{damped} deviates from the follower by up to {} {unit}, at {:.3}°",
                shown(deviation),
                degrees(found.deviation.at)
            ),
            None => "undamped, at a resonance: the vibration of the load is unbounded".into(),
        });
        words.extend(found.resonances.iter().map(|at| {
            let amplitude = shown(size * at.amplitude);
            format!("wave {} of the lift, {amplitude} {unit}, is in resonance at {} rpm", at.order, shown(at.rpm))
        }));
        vec![Section::new("vibration", &value).with_words(words), harmonics_section(&found.harmonics, unit, size)]
    }
}

fn movement_value(movement: &Movement) -> Value {
    json!({
        "from_deg": program::degrees(movement.angles.0),
        "to_deg": program::degrees(movement.angles.1),
        "period_ratio": movement.periods,
        "residual": movement.residual,
        "residual_worst": movement.worst,
        "residual_worst_at_ratio": movement.worst_periods,
    })
}

fn movement_words(movement: &Movement) -> String {
    format!(
        "{:.3} to {:.3}° takes {} natural periods and leaves {} of its travel, undamped; the worst within 20 % is {} at {} periods",
        program::degrees(movement.angles.0),
        program::degrees(movement.angles.1),
        shown(movement.periods),
        shown(movement.residual),
        shown(movement.worst),
        shown(movement.worst_periods)
    )
}

fn harmonics_section(harmonics: &Harmonics, unit: &str, size: f64) -> Section {
    let given = |[a, b]: &[f64; 2]| [size * a, size * b];
    let waves: Vec<[f64; 2]> = harmonics.waves.iter().take(GIVEN).map(given).collect();
    let value = json!({
        "unit": unit,
        "mean": size * harmonics.mean,
        "cos": waves.iter().map(|[a, _]| *a).collect::<Vec<_>>(),
        "sin": waves.iter().map(|[_, b]| *b).collect::<Vec<_>>(),
    });
    let sizes: Vec<String> = waves.iter().take(SHOWN).map(|[a, b]| shown(libm::hypot(*a, *b))).collect();
    let words = format!("amplitudes of the first waves of the lift by the turn: {} {unit}", sizes.join(", "));
    Section::new("harmonics", &value).with_words(vec![words])
}

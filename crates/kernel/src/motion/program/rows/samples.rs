//! A motion through samples given by code, read like rows of a file.

use super::turn::Turn;
use super::{Origin, RowPlace, RowShape, RowWishes, Rows, curve, rounding};
use crate::document::range::LONGEST;
use crate::motion::Quantity;
use crate::motion::program::Program;
use crate::motion::program::context::ProgramContext;
use crate::motion::program::keys::LARGEST_SWING;
use crate::refusal::Refusal;
use std::f64::consts::TAU;

/// Unit in which the rounding of positions is detected: millimetres for lengths.
const TYPED: f64 = 1e-3;
/// Positions that differ by less than this share of the largest are equal.
const NO_MOTION: f64 = 1e-12;

/// The curve through samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SampleCurve {
    /// Its shape between samples.
    pub shape: RowShape,
    /// Its degree, 5 or 3.
    pub degree: u8,
    /// Largest deviation from a sample.
    pub smooth: Option<Smooth>,
}

/// The largest deviation of a curve from samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Smooth {
    /// Half of their rounding step.
    Auto,
    /// m or rad.
    By(f64),
}

impl Default for SampleCurve {
    fn default() -> Self {
        Self { shape: RowShape::Natural, degree: 5, smooth: None }
    }
}

impl SampleCurve {
    fn wishes(self, rounding: f64) -> Result<RowWishes, Refusal> {
        let cubic = match self.degree {
            5 => false,
            3 => true,
            other => return Err(Refusal::new(format!("`degree` cannot be {other}")).remedy("use 5 or 3")),
        };
        let smooth = match self.smooth {
            Some(Smooth::By(by)) if !(by > 0.0 && by.is_finite()) => {
                return Err(Refusal::new(format!("`smooth` must be above 0, not {by}")).remedy("e.g. 3e-6 m"));
            }
            Some(Smooth::By(by)) => Some(by),
            Some(Smooth::Auto) => Some(0.5 * rounding),
            None => None,
        };
        RowWishes { shape: self.shape, cubic, smooth }
            .checked()
            .map_err(|(message, help)| Refusal::new(message).remedy(help))
    }
}

impl Program {
    /// The closed curve of least jerk through or near samples: cam angles (rad) and positions (m, or rad of a swing). They must cover the
    /// turn like the rows of a table, and have the same checks: `overshoot`, `noise`, `outlier`.
    ///
    /// ```
    /// # use camgen_kernel as camgen;
    /// use camgen::{Motion, Program, Quantity, SampleCurve};
    ///
    /// let angles: Vec<f64> = (0..90).map(|row| f64::from(row).to_radians() * 4.0).collect();
    /// let lifts: Vec<f64> = angles.iter().map(|angle| 0.010 * (1.0 - angle.cos())).collect();
    /// let program = Program::through(Quantity::Length, &angles, &lifts, SampleCurve::default())?;
    /// let piece = program.pieces().iter().position(|piece| piece.start <= 1.0 && 1.0 <= piece.end).expect("the rows cover the turn");
    /// assert!((program.jet(piece, 1.0).s - 0.010 * (1.0 - 1.0_f64.cos())).abs() < 1e-9);
    /// // The same samples without the last third are a part of a turn.
    /// assert!(Program::through(Quantity::Length, &angles[..60], &lifts[..60], SampleCurve::default()).is_err());
    /// # Ok::<(), camgen::Refusal>(())
    /// ```
    ///
    /// # Errors
    /// [`Refusal`] if samples are not finite, not in order or do not cover a turn, or if there is no such curve.
    pub fn through(quantity: Quantity, angles: &[f64], positions: &[f64], curve: SampleCurve) -> Result<Self, Refusal> {
        let mut rows = rows_of(angles, positions)?;
        let wishes = curve.wishes(rows.rounding)?;
        possible(quantity, positions)?;
        let turn = Turn::new(TAU, &mut rows, false, None)?;
        let whole = ProgramContext {
            quantity,
            arc: None,
            arm: None,
            speed: None,
            has_faulty_speed: false,
            at: 0.0,
            fill: TAU,
            by_travel: false,
        };
        Ok(curve::program(&turn, 0.0, 1, whole, &rows, wishes))
    }
}

fn rows_of(angles: &[f64], positions: &[f64]) -> Result<Rows, Refusal> {
    if angles.len() != positions.len() {
        let message = format!("{} angles and {} positions", angles.len(), positions.len());
        return Err(Refusal::new(message).remedy("give one position for each angle"));
    }
    if let Some(index) = angles.iter().zip(positions).position(|(at, value)| !(at.is_finite() && value.is_finite())) {
        return Err(Refusal::new(format!("sample {} is not finite", index + 1)).remedy("give finite numbers"));
    }
    let typed: Vec<f64> = positions.iter().map(|position| position / TYPED).collect();
    let points = angles.iter().zip(positions).zip(0..);
    Ok(Rows {
        points: points
            .map(|((at, position), row)| RowPlace { at: *at, position: *position, row, line: None })
            .collect(),
        rounding: TYPED * rounding::step(&typed),
        rounding_of_angles: 0.0,
        origin: Origin::Samples,
        told: Vec::new(),
    })
}

/// Refuses positions that no follower reaches, or that never change.
fn possible(quantity: Quantity, positions: &[f64]) -> Result<(), Refusal> {
    let (reach, unit) = if quantity == Quantity::Angle { (LARGEST_SWING, "rad") } else { (LONGEST, "m") };
    let size = positions.iter().fold(0.0_f64, |most, position| most.max(position.abs()));
    if size > reach {
        let message = format!("the position must be at most {reach:.6e} {unit}, but reaches {size:.6e} {unit}");
        return Err(Refusal::new(message).remedy("give positions in metres, or radians of a swing"));
    }
    let first = positions.first().copied().unwrap_or(0.0);
    if positions.iter().all(|position| (position - first).abs() <= NO_MOTION * size) {
        return Err(Refusal::new("the position never changes").remedy("give a motion that moves"));
    }
    Ok(())
}

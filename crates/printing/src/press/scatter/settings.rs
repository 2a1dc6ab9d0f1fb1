//! The screw for forme and speed: one variable, v = (n/n_c)² (m/m_c)/(p0'/p0), gives the setting and what it leaves.

use super::bed_path::BedPath;
use super::error::ScatterError;
use super::fault::{Fault, FrozenBuffer};
use super::reset::ScrewRule;
use crate::press::buffer::bottom_law::column_for;
use camgen_kernel::numeric::extremum::Extremum;
use camgen_kernel::numeric::root;

/// A setting of the screw, and a fixed bottom with its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// v.
    pub variable: f64,
    /// ΔL of the cam's buffer, m.
    pub column: f64,
    /// What it leaves where that is largest, N, signed, and the overrun, m.
    pub residual: Extremum,
    /// Column of a fixed bottom for the same v, m.
    pub fixed_column: f64,
    /// What the fixed bottom leaves, N, at least 0.
    pub fixed_residual: f64,
}

/// Crank angles at which a fixed bottom under a linkage is evaluated; a parabola through three of them finds the top between.
const PLACES: u32 = 180;
/// Halvings of the air at the end of the stroke, and doublings of the column, in which a fixed bottom is bracketed.
const REACH: i32 = 200;

/// Factor between the steps of v in the search for the end of the useful range, and their number.
const STEP: f64 = 1.25;
const STEPS: i32 = 20;

/// A fixed bottom instead of a cam.
#[derive(Debug, Clone)]
pub struct FixedBottom<'a> {
    cam: &'a FrozenBuffer,
    /// Overrun, m, and load at angles of the reversal of a linkage; empty under a yoke.
    bed: Vec<[f64; 2]>,
}

impl<'a> FixedBottom<'a> {
    /// Instead of this cam.
    #[must_use]
    pub fn new(cam: &'a FrozenBuffer) -> Self {
        let path = &cam.path;
        let mut bed = Vec::new();
        if let BedPath::Linkage(_) = path {
            for place in 0..=PLACES {
                let angle = path.whole() * f64::from(place) / f64::from(PLACES);
                bed.push([path.overrun_at(angle), path.load_at(angle)]);
            }
        }
        Self { cam, bed }
    }

    /// Least and largest residual force of a column (m) at a variable v, N, over the stroke.
    #[must_use]
    pub fn extremes(&self, column: f64, variable: f64) -> [Extremum; 2] {
        match self.cam.path {
            BedPath::Yoke { .. } => extremes_of_fixed(self.cam, column, variable),
            BedPath::Linkage(_) => self.searched(column, variable),
        }
    }

    /// Least and largest residual force over the reversal of a linkage, N.
    fn searched(&self, column: f64, variable: f64) -> [Extremum; 2] {
        let k = self.cam.exponent;
        let forces = self.bed.iter().map(|[x, load]| variable * load - libm::expm1(-k * libm::log1p(-x / column)));
        let forces: Vec<f64> = forces.collect();
        [-1.0, 1.0].map(|sign| {
            let (mut index, mut value) = (0, 0.0);
            for (next, force) in forces.iter().enumerate() {
                if sign * force > sign * value {
                    (index, value) = (next, *force);
                }
            }
            // The top of the parabola through the three angles about it.
            let around = index.checked_sub(1).and_then(|before| forces.get(before..=index + 1));
            if let Some(&[before, at, after]) = around
                && (before - 2.0 * at + after) != 0.0
            {
                let slope = 0.5 * (after - before);
                value = at - 0.5 * slope * slope / (before - 2.0 * at + after);
            }
            Extremum { at: self.bed.get(index).map_or(0.0, |[x, _]| *x), value: self.cam.unit_force * value }
        })
    }

    /// The column by a rule at v, m: by (7) at v = 1 without a reset, by (7) at v, or the one with the least residual force.
    #[must_use]
    pub fn column(&self, variable: f64, rule: ScrewRule) -> f64 {
        match rule {
            ScrewRule::None => self.column_by_end(1.0),
            ScrewRule::End => self.column_by_end(variable),
            ScrewRule::Level => self.level(variable),
        }
    }

    /// The column by (7) at v, m.
    fn column_by_end(&self, variable: f64) -> f64 {
        column_for(self.cam.path.stroke(), variable * self.cam.end_load(), self.cam.exponent)
    }

    /// Largest |residual force| of a column (m) at v, N.
    #[must_use]
    pub fn left(&self, column: f64, variable: f64) -> f64 {
        let [least, largest] = self.extremes(column, variable);
        largest.value.max(-least.value)
    }

    /// The column with the least residual force at v, m.
    fn level(&self, variable: f64) -> f64 {
        // A short column stops the bed early, a long one hardly brakes it.
        let mut shorter = (1..REACH).map(|octave| f64::from(-octave));
        let low = shorter.find(|octave| self.sum_at(*octave, variable) < 0.0).unwrap_or(-1.0);
        let mut longer = (1..REACH).map(f64::from);
        let high = longer.find(|octave| self.sum_at(*octave, variable) > 0.0).unwrap_or(1.0);
        let octave = root::bracketed(|octave| self.sum_at(octave, variable), low, high, 0.0);
        self.column_beyond(octave.unwrap_or(0.0))
    }

    /// A column that leaves 2^octave strokes of air at the end of the stroke, m.
    fn column_beyond(&self, octave: f64) -> f64 {
        self.cam.path.stroke() * (1.0 + libm::exp2(octave))
    }

    /// Sum of the least and the largest residual force of that column, N.
    fn sum_at(&self, octave: f64, variable: f64) -> f64 {
        let [least, largest] = self.extremes(self.column_beyond(octave), variable);
        least.value + largest.value
    }

    /// The settings of cam and fixed bottom by a rule at v.
    ///
    /// # Errors
    /// When no column balances the end.
    pub fn setting(&self, variable: f64, rule: ScrewRule) -> Result<Setting, ScatterError> {
        let cam = self.cam;
        let fault = Fault { square: variable, ..Fault::none(cam.exponent) };
        // At v = 1 the cam is in the machine it was cut for.
        let (column, residual) = if variable == 1.0 {
            (0.0, Extremum { at: 0.0, value: 0.0 })
        } else {
            let column = cam.setting(&fault, rule)?;
            (column, cam.worst(&fault.with_column(column))?)
        };
        let fixed_column = self.column(variable, rule);
        Ok(Setting { variable, column, residual, fixed_column, fixed_residual: self.left(fixed_column, variable) })
    }

    /// Residual force with the cam − residual force with a fixed bottom, each reset by the rule, N.
    fn more(&self, variable: f64, rule: ScrewRule) -> Result<f64, ScatterError> {
        let setting = self.setting(variable, rule)?;
        Ok(setting.residual.value.abs() - setting.fixed_residual)
    }

    /// The v at which the cam begins to have more residual force, on one side of v = 1.
    fn bound(&self, side: f64, rule: ScrewRule, tolerance: f64) -> Option<f64> {
        let mut inside = 1.0;
        for step in 1..=STEPS {
            let outside = libm::pow(STEP, side * f64::from(step));
            // A press without air cannot run: there the comparison gives no bound.
            if self.more(outside, rule).ok()? > 0.0 {
                let found = root::bracketed(|v| self.more(v, rule).unwrap_or(f64::NAN), inside, outside, tolerance);
                return found.ok();
            }
            inside = outside;
        }
        None
    }
}

/// Least and largest residual force of a fixed bottom of a column (m) at a variable v, N, over its stroke under a yoke: 0 at the start, one stationary
/// place x = L − (k L^k/(v A))^(1/(k+1)), and the end.
#[must_use]
pub fn extremes_of_fixed(cam: &FrozenBuffer, column: f64, variable: f64) -> [Extremum; 2] {
    let (k, load) = (cam.exponent, variable * cam.path.loading());
    let still = libm::exp((libm::log(k / load) + k * libm::log(column)) / (k + 1.0));
    let place = (column - still).clamp(0.0, cam.path.stroke());
    let mut least = Extremum { at: 0.0, value: 0.0 };
    let mut largest = least;
    for x in [place, cam.path.stroke()] {
        let value = cam.unit_force * (load * x - libm::expm1(-k * libm::log1p(-x / column)));
        if value < least.value {
            least = Extremum { at: x, value };
        }
        if value > largest.value {
            largest = Extremum { at: x, value };
        }
    }
    [least, largest]
}

/// A range of v; `None` for a side without a bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VariableRange {
    /// Least v.
    pub least: Option<f64>,
    /// Largest v.
    pub most: Option<f64>,
}

/// The least v, to a tolerance, at which the cam has less residual force than a fixed bottom, each reset by the rule; `None` if at every v.
#[must_use]
pub fn least_useful(cam: &FrozenBuffer, rule: ScrewRule, tolerance: f64) -> Option<f64> {
    FixedBottom::new(cam).bound(-1.0, rule, tolerance)
}

/// The range of v in which the cam has less residual force than a fixed bottom, each reset by the rule.
#[must_use]
pub fn useful(cam: &FrozenBuffer, rule: ScrewRule) -> VariableRange {
    let fixed = FixedBottom::new(cam);
    VariableRange { least: fixed.bound(-1.0, rule, 0.0), most: fixed.bound(1.0, rule, 0.0) }
}

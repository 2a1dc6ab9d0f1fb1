//! What the screw of the bottom takes back: the column that balances the end of the stroke, or that leaves least.

use super::error::ScatterError;
use super::fault::{Fault, FrozenBuffer};
use camgen_kernel::document::NamedChoice;
use camgen_kernel::numeric::root;

/// The rule by which the screw is set in a machine that differs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ScrewRule {
    /// It stays where it is.
    None,
    /// No residual force at the end of the stroke.
    #[default]
    End,
    /// The least largest residual force.
    Level,
}

impl NamedChoice for ScrewRule {
    const ALL: &'static [(&'static str, Self)] = &[("none", Self::None), ("end", Self::End), ("level", Self::Level)];
}

/// Share of the column by which the port of a levelled cam is moved at most.
const PORT: f64 = 0.25;
/// Doublings of the air at the end of the stroke in which the level setting is bracketed.
const DOUBLINGS: u32 = 60;

impl FrozenBuffer {
    /// ΔL with which the air holds the bed at the end of the stroke, m: L (f − Y (w_r − ε))/(Y − f),
    /// Y = ((1 + M u_r/π)/τ)^(1/κ). The change of the column that the fault has is replaced by it.
    ///
    /// # Errors
    /// When no column balances the end.
    pub fn end_reset(&self, fault: &Fault) -> Result<f64, ScatterError> {
        let pressure = (1.0 + fault.variable() * self.end_load()) / fault.closing;
        let needed = libm::exp(libm::log(pressure) / fault.exponent);
        let none = ScatterError::NoColumn { share: fault.air, needed };
        if !(needed > fault.air) {
            return Err(none);
        }
        let closed = self.end_length() - fault.lead / self.column;
        let longer = self.column * (fault.air - needed * closed) / (needed - fault.air);
        if self.column + longer > 0.0 { Ok(longer) } else { Err(none) }
    }

    /// ΔL with the least largest residual force, m.
    ///
    /// At every angle r grows with ΔL, so that the largest and the least force are equal and opposite at one ΔL. The force at the start
    /// does not depend on ΔL where the port shuts in time: where it is the largest after [`FrozenBuffer::end_reset`], that one is kept.
    ///
    /// # Errors
    /// When no column balances the end.
    pub fn level_reset(&self, fault: &Fault) -> Result<f64, ScatterError> {
        let end = self.end_reset(fault)?;
        // Under a linkage the air may be shorter elsewhere than at the dead point, and used up there: then a longer column is the first to be tried.
        let mut longer = (0..=16 * DOUBLINGS)
            .map(|doublings| end + (self.column + end) * (libm::exp2(f64::from(doublings) / 16.0) - 1.0));
        let start = longer.find(|column| self.fits(&fault.with_column(*column)).is_ok()).unwrap_or(end);
        let (end, ends) = (start, start == end);
        let [least, largest] = self.extremes_by_load(&fault.with_column(end))?;
        let start = if least.value.abs() > largest.value.abs() { least.at } else { largest.at };
        let sum = least.value + largest.value;
        if sum == 0.0 || (ends && start == 0.0 && fault.lead == 0.0 && self.level.is_none()) {
            return Ok(end);
        }
        // The air at the end of the stroke is multiplied, so that it never is used up.
        let left = self.shortest_length() + (end - fault.lead) / self.column;
        let mut columns = (1..=16 * DOUBLINGS).map(|doublings| {
            let share = libm::exp2(f64::from(doublings) / 16.0 * if sum > 0.0 { -1.0 } else { 1.0 });
            end + self.column * left * (share - 1.0)
        });
        let beyond = columns.find(|column| {
            let value = self.sum_of_extremes(&fault.with_column(*column));
            value.is_nan() || (value > 0.0) != (sum > 0.0)
        });
        let level = beyond.and_then(|beyond| {
            root::bracketed(|column| self.sum_of_extremes(&fault.with_column(column)), end, beyond, 0.0).ok()
        });
        let level = level.unwrap_or(end);
        // A port that shuts late leaves a force at the start that the screw hardly moves: then the end setting may leave less.
        let [with_end, with_level] = [end, level].map(|column| self.largest_residual(&fault.with_column(column)));
        Ok(if with_end <= with_level { end } else { level })
    }

    /// Sum of the least and the largest residual force, N; NaN if the column is used up.
    fn sum_of_extremes(&self, fault: &Fault) -> f64 {
        let extremes = self.extremes_by_load(fault);
        extremes.map_or(f64::NAN, |[least, largest]| least.value + largest.value)
    }

    /// Largest size of the residual force, N; infinite if the column is used up.
    fn largest_residual(&self, fault: &Fault) -> f64 {
        let worst = match fault.phase {
            0.0 => self.extremes_by_load(fault).map(|[least, largest]| largest.value.max(-least.value)),
            _ => self.worst(fault).map(|worst| worst.value.abs()),
        };
        worst.unwrap_or(f64::INFINITY)
    }

    /// The setting of the screw by a rule, m; as in the fault if the rule keeps it.
    ///
    /// # Errors
    /// When no column balances the end.
    pub fn setting(&self, fault: &Fault, rule: ScrewRule) -> Result<f64, ScatterError> {
        match rule {
            ScrewRule::None => Ok(fault.column),
            ScrewRule::End => self.end_reset(fault),
            ScrewRule::Level => self.level_reset(fault),
        }
    }

    /// ΔL and Δe, m, that leave no residual force at both ends of the braking half: the screw, and the position of the port.
    ///
    /// # Errors
    /// When no column balances the end.
    pub fn reset_of_column_and_port(&self, fault: &Fault) -> Result<[f64; 2], ScatterError> {
        if self.level.is_some() {
            return self.reset_of_levelled(fault);
        }
        let [rise, closing] = [1.0 + fault.variable() * self.end_load(), fault.closing]
            .map(|ratio| libm::exp(libm::log(ratio) / fault.exponent));
        if !(rise > 1.0) {
            return Err(ScatterError::NoColumn { share: 1.0, needed: rise });
        }
        let share = rise * (1.0 - self.end_length()) / (rise - 1.0);
        let longer = self.column * (share / (fault.air * closing) - 1.0);
        Ok([longer, longer - self.column * (share - 1.0)])
    }

    /// As [`Self::reset_of_column_and_port`] for a cam that levels both ways, whose port shuts before the reversal: the end setting for each place of the port, and that place
    /// by the force at the start.
    fn reset_of_levelled(&self, fault: &Fault) -> Result<[f64; 2], ScatterError> {
        let reach = PORT * self.column;
        let lead = root::bracketed(|lead| self.residual_at_start(fault, lead), -reach, reach, 0.0);
        let lead = lead.unwrap_or(fault.lead);
        Ok([self.end_reset(&Fault { lead, ..*fault })?, lead])
    }

    /// The force at the start of the reversal after the end setting for a lead, m, of the port, N; NaN if no column balances the end.
    fn residual_at_start(&self, fault: &Fault, lead: f64) -> f64 {
        let moved = Fault { lead, ..*fault };
        let column = self.end_reset(&moved);
        column.map_or(f64::NAN, |column| self.residual(&moved.with_column(column), 0.0, self.length(0.0)))
    }
}

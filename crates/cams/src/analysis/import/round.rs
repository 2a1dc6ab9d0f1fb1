//! Round numbers in a motion that was found, as far as the positions do not contradict them: angles first, then positions, then parameters of laws.

use super::model::{Fixed, LawParameter, Left, Model, ModelLaw, ModelSegment};
use super::positions::Positions;
use super::sought::Sought;
use camgen_kernel::motion::Quantity;
use std::f64::consts::PI;

/// Round angles, degrees, lengths, mm or degrees, and shares, the roundest first; the last is that to which everything is rounded.
const ROUND_ANGLES: [f64; 8] = [5.0, 1.0, 0.5, 0.25, 0.1, 0.05, 0.01, 0.001];
const ROUND_LEVELS: [f64; 9] = [1.0, 0.5, 0.1, 0.05, 0.01, 0.005, 0.001, 1e-4, 1e-5];
const ROUND_SHARES: [f64; 6] = [0.1, 0.05, 0.01, 0.005, 0.001, 1e-4];
/// Round numbers may add to the sum of squares, over that of one position, so much and so much for each of them.
const ROUNDED: f64 = 9.0;
const FOR_EACH: f64 = 4.0;
/// Or they may cost this share of the deviation.
const OF_DEVIATION: f64 = 0.05;
/// Noise below this is rounding of the calculation, m or rad.
const LEAST_NOISE: f64 = 1e-9;
const DEGREE: f64 = PI / 180.0;

/// What stays where one kind of number is made round.
const STILL: Fixed = Fixed { nodes: true, together: false, levels: false, parameters: false, shift: true };

/// Positions, what is sought of them, and what the free numbers leave.
struct Rounding<'a> {
    rows: &'a Positions,
    sought: &'a Sought<'a>,
    free: Left,
}

/// Takes round numbers where the positions allow them.
pub(super) fn rounded(model: &mut Model, rows: &Positions, sought: &Sought<'_>) {
    let free = model.left(rows, (0, rows.len()));
    if free.count == 0 {
        return;
    }
    let rounding = Rounding { rows, sought, free };
    rounding.nodes(model);
    rounding.levels(model);
    rounding.usual_parameters(model);
    rounding.parameters(model);
}

impl Rounding<'_> {
    fn fit(&self, model: &mut Model, fixed: Fixed) {
        model.fit(self.rows, (0, self.rows.len(), 1), fixed);
    }

    /// Whether a model with so many round numbers is as good as the free one.
    fn is_kept(&self, model: &Model, count: usize) -> bool {
        let left = model.left(self.rows, (0, self.rows.len()));
        #[expect(clippy::cast_precision_loss, reason = "few positions")]
        let (added, of) = (ROUNDED + FOR_EACH * count as f64, self.free.count as f64);
        let by_chance = self.free.rms.max(LEAST_NOISE) * (1.0 + added / of).sqrt();
        let limit = by_chance.max(self.free.rms.hypot(OF_DEVIATION * self.sought.deviation));
        left.rms <= limit && left.largest <= self.free.largest.max(self.sought.deviation)
    }

    /// Angles: of a cam that may lie at any angle only those from the first node on.
    fn nodes(&self, model: &mut Model) {
        let first = model.nodes.first().copied().unwrap_or(0.0);
        let zero = if self.sought.any_turn { first } else { 0.0 };
        let last = ROUND_ANGLES.len() - 1;
        for (number, grid) in ROUND_ANGLES.iter().map(|degrees| degrees * DEGREE).enumerate() {
            let mut next = model.clone();
            for node in &mut next.nodes {
                *node = zero + ((*node - zero) / grid).round() * grid;
            }
            if !(0..next.segments.len()).all(|at| next.end(at) - next.start(at) > 0.5 * grid) {
                continue;
            }
            let fixed = if self.sought.any_turn { Fixed { nodes: false, together: true, ..STILL } } else { STILL };
            self.fit(&mut next, fixed);
            if self.is_kept(&next, next.nodes.len()) || number == last {
                *model = next;
                break;
            }
        }
    }

    fn levels(&self, model: &mut Model) {
        let unit = if self.rows.quantity == Quantity::Angle { DEGREE } else { 1e-3 };
        let lowest = model.levels.iter().copied().fold(f64::INFINITY, f64::min);
        let zero = if self.sought.from_lowest { lowest } else { 0.0 };
        for grid in ROUND_LEVELS.map(|size| size * unit) {
            let mut next = model.clone();
            for level in &mut next.levels {
                *level = zero + ((*level - zero) / grid).round() * grid;
            }
            self.fit(&mut next, Fixed { levels: true, ..STILL });
            if self.is_kept(&next, next.nodes.len() + next.levels.len()) {
                *model = next;
                break;
            }
        }
    }

    /// Gives the laws their usual parameter where that is as good.
    fn usual_parameters(&self, model: &mut Model) {
        for at in 0..model.segments.len() {
            let mut next = model.clone();
            if let Some(ModelSegment { law: ModelLaw::Law(law), .. }) = next.segments.get_mut(at)
                && law.parameter != LawParameter::Usual
            {
                law.parameter = LawParameter::Usual;
                self.fit(&mut next, Fixed { levels: true, ..STILL });
                if self.is_kept(&next, next.nodes.len() + next.levels.len() + 1) {
                    *model = next;
                }
            }
        }
    }

    fn parameters(&self, model: &mut Model) {
        for grid in ROUND_SHARES {
            let mut next = model.clone();
            for segment in &mut next.segments {
                if let ModelLaw::Law(law) = &mut segment.law
                    && let Some(value) = law.parameter.value()
                {
                    law.parameter = law.parameter.with((value / grid).round() * grid);
                }
            }
            if self.is_kept(&next, next.nodes.len() + next.levels.len() + next.segments.len()) {
                *model = next;
                break;
            }
        }
    }
}

//! A key that varies, and the value of it that a design has.

use super::sampling::{normal, normal_share};
use crate::write::number::shortest;

/// How values lie between a first and a last one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Equal steps.
    Linear,
    /// Equal ratios.
    Log,
}

/// The values that a key may have.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// These, as typed.
    List(Vec<String>),
    /// From one to another.
    Range {
        /// The first.
        from: f64,
        /// The last.
        to: f64,
        /// How many; `None` for any between them.
        steps: Option<u64>,
        /// How they lie.
        scale: Scale,
    },
    /// Normally distributed.
    Normal {
        /// The mean.
        mean: f64,
        /// The standard deviation.
        deviation: f64,
        /// Cut off below and above.
        within: (f64, f64),
    },
}

/// The key of the speed that a command takes as a flag.
pub(super) const SPEED: &str = "rpm";

/// A key that varies.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// The dotted path of the key in the base.
    pub key: String,
    /// The unit of the numbers, as typed; empty for bare numbers and words.
    pub unit: String,
    /// Its values.
    pub values: Values,
    /// The values are numbers.
    pub numeric: bool,
}

/// A typed number and its unit; `None` for a word.
pub(super) fn split(typed: &str) -> Option<(f64, &str)> {
    let typed = typed.trim();
    if !typed.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.')) {
        return None;
    }
    let ends = typed.char_indices().map(|(at, c)| at + c.len_utf8()).rev();
    ends.into_iter().find_map(|end| {
        let (number, unit) = typed.split_at_checked(end)?;
        let number: f64 = number.parse().ok().filter(|number: &f64| number.is_finite())?;
        let unit = unit.trim();
        // `3-4-5` is the name of a law.
        let of_unit =
            unit.is_empty() || unit.starts_with(|c: char| c.is_alphabetic() || matches!(c, '%' | '°' | '"' | '\''));
        of_unit.then_some((number, unit))
    })
}

impl Parameter {
    /// The name of its column: the key after `set.`, with the unit of its numbers.
    #[must_use]
    pub fn column(&self) -> String {
        let unit = self.unit.replace('/', "_per_").replace('*', "_").replace('%', "percent").replace('°', "deg");
        let unit = if unit.is_empty() { unit } else { format!("_{unit}") };
        format!("set.{}{unit}", self.key)
    }

    /// How many values it has; `None` for any in a range.
    #[must_use]
    pub fn count(&self) -> Option<u64> {
        match &self.values {
            Values::List(all) => Some(all.len() as u64),
            Values::Range { steps, .. } => *steps,
            Values::Normal { .. } => None,
        }
    }

    /// A value by its number.
    #[must_use]
    pub fn level(&self, index: u64) -> ParameterValue {
        match &self.values {
            Values::List(all) => {
                let typed = usize::try_from(index).ok().and_then(|index| all.get(index)).cloned().unwrap_or_default();
                let number = if self.numeric { split(&typed).map(|(number, _)| number) } else { None };
                ParameterValue { number, typed }
            }
            Values::Range { from, to, steps, scale } => {
                let last = steps.unwrap_or(2).saturating_sub(1).max(1);
                self.number(between((*from, *to), *scale, (index, last)))
            }
            Values::Normal { .. } => self.value_at(0.5),
        }
    }

    /// The value below which a share of all lies.
    #[must_use]
    #[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts")]
    pub fn value_at(&self, share: f64) -> ParameterValue {
        match (&self.values, self.count()) {
            (_, Some(count)) => self.level(((share * count as f64) as u64).min(count.saturating_sub(1))),
            (Values::Normal { mean, deviation, within: (low, high) }, _) => {
                let (below, above) = ((low - mean) / deviation, (high - mean) / deviation);
                // In the tail on the side of the value, where no digits are lost.
                let value = if below > 0.0 {
                    let (far, near) = (normal_share(-above), normal_share(-below));
                    -normal((near + share * (far - near)).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON))
                } else {
                    let (first, last) = (normal_share(below), normal_share(above));
                    normal((first + share * (last - first)).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0))
                };
                self.number((mean + deviation * value).clamp(*low, *high))
            }
            (Values::Range { from, to, scale: Scale::Linear, .. }, _) => self.number(from + share * (to - from)),
            (Values::Range { from, to, scale: Scale::Log, .. }, _) => {
                self.number(from * libm::exp(share * libm::log(to / from)))
            }
            (Values::List(_), None) => self.level(0),
        }
    }

    fn number(&self, number: f64) -> ParameterValue {
        let typed = shortest(number);
        let typed = if self.unit.is_empty() { typed } else { format!("{typed} {}", self.unit) };
        ParameterValue { number: Some(number), typed }
    }
}

/// One of the values from a first to a last one.
#[expect(clippy::cast_precision_loss, reason = "counts")]
fn between((from, to): (f64, f64), scale: Scale, (index, last): (u64, u64)) -> f64 {
    match scale {
        _ if index == 0 => from,
        _ if index >= last => to,
        Scale::Linear => (from * (last - index) as f64 + to * index as f64) / last as f64,
        Scale::Log => from * libm::exp(index as f64 / last as f64 * libm::log(to / from)),
    }
}

/// The value of a key in a design.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterValue {
    /// The number, in the unit of the column.
    pub number: Option<f64>,
    /// As it is set.
    pub typed: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(values: Values) -> Parameter {
        Parameter { key: "a.b".into(), unit: "mm".into(), values, numeric: true }
    }

    #[test]
    fn numbers_are_told_from_their_units() {
        for (typed, number, unit) in
            [("10 mm", 10.0, "mm"), ("-0.3mm/deg", -0.3, "mm/deg"), ("1e3", 1e3, ""), ("2e-3 N", 2e-3, "N")]
        {
            assert_eq!(split(typed), Some((number, unit)), "{typed}");
        }
        assert_eq!((split("cycloidal"), split("3-4-5"), split("auto")), (None, None, None));
    }

    #[test]
    fn the_ends_of_a_range_are_exact() {
        for scale in [Scale::Linear, Scale::Log] {
            let range = of(Values::Range { from: 0.1, to: 0.7, steps: Some(7), scale });
            assert_eq!((range.level(0).number, range.level(6).number), (Some(0.1), Some(0.7)));
        }
        let range = of(Values::Range { from: 10.0, to: 11.0, steps: Some(11), scale: Scale::Linear });
        assert_eq!(range.level(3).typed, "10.3 mm");
        let range = of(Values::Range { from: 1.0, to: 100.0, steps: Some(3), scale: Scale::Log });
        assert!((range.level(1).number.expect("a number") - 10.0).abs() < 1e-14);
    }

    /// Quantiles of a truncated normal distribution, in closed form: half of all below 0.6745 deviations of a half distribution.
    #[test]
    fn a_truncated_distribution_keeps_its_ends() {
        let half = of(Values::Normal { mean: 5.0, deviation: 2.0, within: (5.0, f64::INFINITY) });
        assert!((half.value_at(0.5).number.expect("a number") - (5.0 + 2.0 * 0.674_489_750_196_081_7)).abs() < 1e-13);
        let far = of(Values::Normal { mean: 0.0, deviation: 1.0, within: (30.0, 31.0) });
        for share in [1e-9, 0.5, 1.0 - 1e-9] {
            let value = far.value_at(share).number.expect("a number");
            assert!((30.0..=31.0).contains(&value), "{share} {value}");
        }
        // The mean excess of a tail at a is 1/a, its median ln 2/a, to 1/a² of it.
        assert!((far.value_at(0.5).number.expect("a number") - 30.0 - 2_f64.ln() / 30.0).abs() < 1e-4);
        assert_eq!(half.column(), "set.a.b_mm");
    }
}

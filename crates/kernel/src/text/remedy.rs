//! Changes of a machine file that were tried and pass.

use super::figures::shown;
use crate::units::{self, Dimension, LengthUnit};
use std::borrow::Cow;
use std::fmt;

/// A key of a machine file with another value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeyChange {
    /// Its dotted path.
    pub key: Cow<'static, str>,
    /// The value as it is typed.
    pub value: String,
}

impl KeyChange {
    /// A key with the value that is to be typed.
    #[must_use]
    pub fn new(key: impl Into<Cow<'static, str>>, value: impl Into<String>) -> Self {
        Self { key: key.into(), value: value.into() }
    }
}

impl KeyChange {
    /// As it is typed in a machine file, `key = "value"`. A value is never rounded to be shown in another unit, because it was tried as it is:
    /// where a reader has inches, a length has them behind it.
    #[must_use]
    pub fn in_unit(&self, unit: LengthUnit) -> String {
        format!("{} = \"{}\"{}", self.key, self.value, inches_behind(&self.value, unit))
    }
}

/// The inches of a typed length, ` (2.7165 in)`, where a reader has inches and the length has another unit.
fn inches_behind(typed: &str, unit: LengthUnit) -> String {
    let length = units::parse(typed, Dimension::Length).ok().filter(|length| length.unit().0 != unit.symbol());
    match length.filter(|_| unit == LengthUnit::Inch) {
        Some(length) => format!(" ({} in)", shown(unit.of_mm(1e3 * length.si))),
        None => String::new(),
    }
}

/// As it is typed in a machine file, `key = "value"`.
impl fmt::Display for KeyChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_unit(LengthUnit::Millimetre))
    }
}

/// Changes that were tried together and pass.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remedy {
    /// All of them are needed.
    pub changes: Vec<KeyChange>,
    /// What a reader sees instead of the keys, before the value of the only one.
    named: Option<&'static str>,
    /// What a reader sees instead of all.
    words: Option<String>,
}

impl Remedy {
    /// Changes that are shown as they are typed.
    #[must_use]
    pub fn new(changes: impl IntoIterator<Item = KeyChange>) -> Self {
        Self { changes: changes.into_iter().collect(), named: None, words: None }
    }

    /// Shown by a name before the value, "a base radius of 41 mm".
    #[must_use]
    pub fn named(self, name: &'static str) -> Self {
        Self { named: Some(name), ..self }
    }

    /// Shown in these words.
    #[must_use]
    pub fn in_words(self, words: impl Into<String>) -> Self {
        Self { words: Some(words.into()), ..self }
    }

    /// As a reader sees it.
    #[must_use]
    pub fn in_unit(&self, unit: LengthUnit) -> String {
        match (&self.words, self.named, self.changes.as_slice()) {
            (Some(words), ..) => words.clone(),
            (None, Some(name), [only]) => format!("{name} {}{}", only.value, inches_behind(&only.value, unit)),
            (None, _, changes) => changes.iter().map(|change| change.in_unit(unit)).collect::<Vec<_>>().join(" with "),
        }
    }
}

/// In millimetres.
impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_unit(LengthUnit::Millimetre))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_that_was_tried_is_never_rounded() {
        let base = Remedy::new([KeyChange::new("cam.base_radius", "69 mm")]).named("a base radius of");
        assert_eq!(base.to_string(), "a base radius of 69 mm");
        assert_eq!(base.in_unit(LengthUnit::Inch), "a base radius of 69 mm (2.7165 in)");
        let both = Remedy::new([KeyChange::new("cam.groove_depth", "12.7 mm"), KeyChange::new("limits.x", "3 deg")]);
        assert_eq!(both.to_string(), "cam.groove_depth = \"12.7 mm\" with limits.x = \"3 deg\"");
        let inches = both.in_unit(LengthUnit::Inch);
        assert_eq!(inches, "cam.groove_depth = \"12.7 mm\" (0.5 in) with limits.x = \"3 deg\"");
    }
}

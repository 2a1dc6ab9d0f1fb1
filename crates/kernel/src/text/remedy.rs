//! Changes of a machine file that were tried and pass.

use super::Text;
use crate::units::LengthUnit;
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

/// As it is typed in a machine file, `key = "value"`.
impl fmt::Display for KeyChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = \"{}\"", self.key, self.value)
    }
}

/// Changes that were tried together and pass.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remedy {
    /// All of them are needed.
    pub changes: Vec<KeyChange>,
    /// What a reader sees in the place of the keys and their values.
    named: Option<Box<Text>>,
}

impl Remedy {
    /// Changes that are shown as they are typed.
    #[must_use]
    pub fn new(changes: impl IntoIterator<Item = KeyChange>) -> Self {
        Self { changes: changes.into_iter().collect(), named: None }
    }

    /// Shown in these words.
    #[must_use]
    pub fn named(self, words: impl Into<Text>) -> Self {
        Self { named: Some(Box::new(words.into())), ..self }
    }

    /// As a reader sees it.
    #[must_use]
    pub fn in_unit(&self, unit: LengthUnit) -> String {
        match &self.named {
            Some(words) => words.in_unit(unit),
            None => self.changes.iter().map(KeyChange::to_string).collect::<Vec<_>>().join(" with "),
        }
    }
}

/// In millimetres.
impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_unit(LengthUnit::Millimetre))
    }
}

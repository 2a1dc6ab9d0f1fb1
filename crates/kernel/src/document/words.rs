//! Choices that are given by a word, in flags and in inputs.

use crate::units::LengthUnit;

/// A choice whose cases have words.
pub trait NamedChoice: Copy + PartialEq + Send + Sync + 'static {
    /// Each case with its word, in the order of help; a second word of a case is another name for it.
    const ALL: &'static [(&'static str, Self)];

    /// The word of a case.
    #[must_use]
    fn word(self) -> &'static str {
        Self::ALL.iter().find(|(_, case)| *case == self).map_or("", |(word, _)| word)
    }

    /// The case of a word, in small or capital letters.
    #[must_use]
    fn named(word: &str) -> Option<Self> {
        Self::ALL.iter().find(|(name, _)| name.eq_ignore_ascii_case(word)).map(|(_, case)| *case)
    }
}

impl NamedChoice for LengthUnit {
    const ALL: &'static [(&'static str, Self)] = &[("mm", Self::Millimetre), ("inch", Self::Inch), ("in", Self::Inch)];
}

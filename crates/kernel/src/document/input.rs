//! A value that determines a part, as it was typed and as it is compared.

/// A value that determines a part. Two are equal where their values in SI units are, however they were typed.
#[derive(Debug, Clone)]
pub struct Input {
    /// The dotted path of a key of the file, or the name of a flag.
    pub key: String,
    /// The value as one canonical text: numbers in SI units with all their digits.
    pub value: String,
    /// The value as a person typed it, or would.
    pub typed: String,
}

impl PartialEq for Input {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key && self.value == other.value
    }
}

impl Input {
    /// A value with the text it was typed as.
    #[must_use]
    pub fn new(key: impl Into<String>, value: impl Into<String>, typed: impl Into<String>) -> Self {
        Self { key: key.into(), value: value.into(), typed: typed.into() }
    }

    /// A word.
    #[must_use]
    pub fn word(key: &str, word: impl Into<String>) -> Self {
        let word = word.into();
        Self::new(key, word.clone(), word)
    }

    /// A bare number.
    #[must_use]
    pub fn number(key: &str, number: f64) -> Self {
        Self::word(key, exact(number))
    }

    /// Several numbers.
    #[must_use]
    pub fn numbers(key: &str, numbers: &[f64]) -> Self {
        Self::word(key, numbers.iter().copied().map(exact).collect::<Vec<_>>().join(", "))
    }

    /// A number in SI units, shown in a unit of that size.
    #[must_use]
    pub fn quantity(key: &str, si: f64, (unit, size): (&str, f64)) -> Self {
        // Twelve digits hide the rounding of the division.
        let shown = format!("{:.11e}", si / size).parse().unwrap_or(f64::NAN);
        Self::new(key, exact(si), format!("{} {unit}", exact(shown)))
    }
}

/// A number with all its digits; the two zeros are one.
pub(super) fn exact(number: f64) -> String {
    (number + 0.0).to_string()
}

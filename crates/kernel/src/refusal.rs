//! A refusal: what is wrong, where, and what would be right.

use crate::text::Text;
use std::fmt;

/// Why something is refused: what is wrong, where, and what would be right. Errors that no caller tells apart are of this type.
///
/// ```
/// # use camgen_kernel as camgen;
/// let refusal = camgen::Refusal::new("the velocity of the follower jumps").at("12 deg").remedy("give the motion a ramp");
/// assert_eq!(refusal.to_string(), "the velocity of the follower jumps at 12 deg; give the motion a ramp");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Refusal {
    /// What is wrong.
    pub what: String,
    /// Where, such that "at" fits before it.
    pub place: Option<String>,
    /// What would be right.
    pub remedy: Option<Text>,
}

impl Refusal {
    /// A refusal that states what is wrong.
    #[must_use]
    pub fn new(what: impl Into<String>) -> Self {
        Self { what: what.into(), place: None, remedy: None }
    }

    /// The text of another error as a refusal.
    #[must_use]
    pub fn of(error: impl fmt::Display) -> Self {
        Self::new(error.to_string())
    }

    /// With the place; "at" is put before it.
    #[must_use]
    pub fn at(self, place: impl Into<String>) -> Self {
        Self { place: Some(place.into()), ..self }
    }

    /// With what would be right, after a remedy that it has already.
    #[must_use]
    pub fn remedy(self, remedy: impl Into<Text>) -> Self {
        Self { remedy: Some(self.remedy.unwrap_or_default().and("; ", remedy)), ..self }
    }

    /// What would be right, in millimetres.
    #[must_use]
    pub fn remedy_words(&self) -> Option<String> {
        self.remedy.as_ref().map(Text::to_string)
    }

    /// With what fails because of it, before what is wrong: "no table of points: a plate has no angle".
    #[must_use]
    pub fn context(self, failed: &str) -> Self {
        Self { what: format!("{failed}: {}", self.what), ..self }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)?;
        if let Some(place) = &self.place {
            write!(f, " at {place}")?;
        }
        self.remedy.iter().try_for_each(|remedy| write!(f, "; {remedy}"))
    }
}

impl std::error::Error for Refusal {}

/// The most of something that one command takes: with it the command ends within 5 s and 512 MiB.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WorkBound {
    /// What is counted, in the plural.
    pub what: &'static str,
    /// Its largest number.
    pub most: usize,
}

impl WorkBound {
    /// Refuses a larger number.
    ///
    /// # Errors
    /// [`Refusal`] with the number and the bound.
    pub fn allow(self, count: usize) -> Result<(), Refusal> {
        let Self { what, most } = self;
        let refused = || Refusal::new(format!("{count} {what} are asked for")).remedy(format!("give at most {most}"));
        if count > most { Err(refused()) } else { Ok(()) }
    }
}

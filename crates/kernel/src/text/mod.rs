//! Sentences as data: templates with values that keep their kind, and changes of a machine file that were tried. Whoever shows a sentence
//! says in which unit its lengths are; nobody takes a sentence apart.
//!
//! ```
//! # use camgen_kernel as camgen;
//! use camgen::text;
//! use camgen::text::{KeyChange, Length, Remedy};
//! use camgen::units::LengthUnit;
//!
//! let remedy = Remedy::new([KeyChange::new("cam.base_radius", "41 mm")]);
//! let note = text!("the wall is {} thick; {} would pass", Length::mm(2.54), remedy);
//! assert_eq!(note.to_string(), "the wall is 2.54 mm thick; cam.base_radius = \"41 mm\" would pass");
//! assert!(note.in_unit(LengthUnit::Inch).starts_with("the wall is 0.1 in thick"));
//! assert_eq!(note.remedies()[0].changes[0].key, "cam.base_radius");
//! ```

mod figures;
mod length;
mod remedy;

pub use figures::{nominal, rounded, shown, significant, significant_beside, to_type};
pub use length::{DIGITS, Length, LengthKind};
pub use remedy::{KeyChange, Remedy};

use crate::units::LengthUnit;
use std::borrow::Cow;
use std::fmt::{self, Write};

/// A sentence, or several.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Text {
    phrases: Vec<Phrase>,
}

/// A template, in which each `{}` stands for a value.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Phrase {
    template: &'static str,
    values: Vec<Value>,
    /// Whether it only stands between others.
    is_between: bool,
}

impl Phrase {
    fn new(template: &'static str, values: Vec<Value>) -> Self {
        Self { template, values, is_between: false }
    }
}

/// What stands in a template.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Value {
    /// Words, names, and numbers that have no length in their unit.
    Words(Cow<'static, str>),
    /// A length, or another quantity whose unit has a length.
    Length(Length),
    /// A unit behind several lengths: "at (3, 4) mm".
    Unit(&'static LengthKind),
    /// A sentence in a sentence.
    Text(Text),
    /// Changes of a machine file.
    Remedy(Remedy),
}

/// A [`Text`] of a template and its values, in their order: `text!("{} deep", Length::mm(3.0))`.
#[macro_export]
macro_rules! text {
    ($template:literal $(, $value:expr)* $(,)?) => {
        $crate::text::Text::new($template, vec![$($crate::text::Value::from($value)),*])
    };
}
pub use text;

impl Text {
    /// A template and its values, as [`text!`](crate::text!) makes it.
    #[must_use]
    pub fn new(template: &'static str, values: Vec<Value>) -> Self {
        debug_assert_eq!(template.matches("{}").count(), values.len(), "{template}");
        Self { phrases: vec![Phrase::new(template, values)] }
    }

    /// Whether there is nothing in it.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.phrases.is_empty()
    }

    /// Texts one after the other, with something between them.
    #[must_use]
    pub fn joined(texts: impl IntoIterator<Item = Text>, between: &'static str) -> Self {
        texts.into_iter().fold(Self::default(), |all, text| all.and(between, text))
    }

    /// With a further text, and something between them where both have words.
    #[must_use]
    pub fn and(mut self, between: &'static str, next: impl Into<Text>) -> Self {
        let next = next.into();
        if !self.is_empty() && !next.is_empty() {
            self.phrases.push(Phrase { is_between: true, ..Phrase::new(between, Vec::new()) });
        }
        self.phrases.extend(next.phrases);
        self
    }

    /// The words, with lengths in a unit.
    #[must_use]
    pub fn in_unit(&self, unit: LengthUnit) -> String {
        let mut words = String::new();
        self.write(&mut words, unit);
        words
    }

    fn write(&self, words: &mut String, unit: LengthUnit) {
        for Phrase { template, values, .. } in &self.phrases {
            let mut values = values.iter();
            for (index, fixed) in template.split("{}").enumerate() {
                if index > 0 {
                    values.next().into_iter().for_each(|value| value.write(words, unit));
                }
                words.push_str(fixed);
            }
        }
    }

    /// The texts that it joins, without those that name a change of a machine file: what is wrong, without what to do.
    #[must_use]
    pub fn without_remedies(&self) -> Self {
        let mut kept = Self::default();
        let mut between = None;
        for phrase in &self.phrases {
            if phrase.is_between {
                between = Some(phrase.template);
                continue;
            }
            let own = Self { phrases: vec![phrase.clone()] };
            if own.remedies().is_empty() {
                kept = kept.and(between.unwrap_or_default(), own);
            }
            between = None;
        }
        kept
    }

    /// The changes of a machine file in it.
    #[must_use]
    pub fn remedies(&self) -> Vec<&Remedy> {
        let mut found = Vec::new();
        for value in self.phrases.iter().flat_map(|phrase| &phrase.values) {
            match value {
                Value::Remedy(remedy) => found.push(remedy),
                Value::Text(text) => found.extend(text.remedies()),
                Value::Words(_) | Value::Length(_) | Value::Unit(_) => {}
            }
        }
        found
    }
}

impl Value {
    /// A number with its unit, which may have a length: "mm/rad²", "rad/s".
    #[must_use]
    pub fn with_unit(number: f64, unit: &str) -> Self {
        match LengthKind::of_symbol(unit) {
            Some(kind) => Length::new(number, kind).into(),
            None => format!("{} {unit}", shown(number)).into(),
        }
    }

    /// A figure of a summary without a unit: four significant digits.
    #[must_use]
    pub fn brief_number(number: f64) -> Self {
        significant(number, DIGITS).into()
    }

    /// A figure of a summary with its unit: four significant digits; of forces, torques, works and powers from 10 000 on in thousands.
    #[must_use]
    pub fn brief(number: f64, unit: &str) -> Self {
        if let Some(kind) = LengthKind::of_symbol(unit) {
            return Length::new(number, kind).brief().into();
        }
        let in_thousands = number.abs() >= 1e4 && matches!(unit, "N" | "N·m" | "J" | "W");
        let (number, prefix) = if in_thousands { (1e-3 * number, "k") } else { (number, "") };
        let blank = if unit == "°" { "" } else { " " };
        format!("{}{blank}{prefix}{unit}", significant(number, DIGITS)).into()
    }

    /// A number whose unit another one behind it has.
    #[must_use]
    pub fn before_unit(number: f64, unit: &str) -> Self {
        match LengthKind::of_symbol(unit) {
            Some(kind) => Length::new(number, kind).bare().into(),
            None => shown(number).into(),
        }
    }

    fn write(&self, words: &mut String, unit: LengthUnit) {
        match self {
            Value::Words(own) => words.push_str(own),
            Value::Length(length) => words.push_str(&length.in_unit(unit)),
            Value::Unit(kind) => words.push_str(kind.symbol(unit)),
            Value::Text(text) => text.write(words, unit),
            Value::Remedy(remedy) => words.push_str(&remedy.in_unit(unit)),
        }
    }
}

/// In millimetres.
impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_unit(LengthUnit::Millimetre))
    }
}

impl From<&'static str> for Text {
    fn from(words: &'static str) -> Self {
        Self::from(Value::from(words))
    }
}

impl From<String> for Text {
    fn from(words: String) -> Self {
        Self::from(Value::from(words))
    }
}

impl From<Value> for Text {
    fn from(value: Value) -> Self {
        Self { phrases: vec![Phrase::new("{}", vec![value])] }
    }
}

impl From<Remedy> for Text {
    fn from(remedy: Remedy) -> Self {
        Self::from(Value::Remedy(remedy))
    }
}

/// Nothing where there is none.
impl<T: Into<Text>> From<Option<T>> for Text {
    fn from(text: Option<T>) -> Self {
        text.map_or_else(Self::default, Into::into)
    }
}

impl From<&Text> for Text {
    fn from(text: &Text) -> Self {
        text.clone()
    }
}

/// Without anything between them.
impl std::ops::AddAssign<Text> for Text {
    fn add_assign(&mut self, next: Text) {
        self.phrases.extend(next.phrases);
    }
}

impl From<&&str> for Value {
    fn from(words: &&str) -> Self {
        Value::from(*words)
    }
}

impl From<&str> for Value {
    fn from(words: &str) -> Self {
        Value::Words(Cow::Owned(words.to_owned()))
    }
}

impl From<String> for Value {
    fn from(words: String) -> Self {
        Value::Words(Cow::Owned(words))
    }
}

impl From<&String> for Value {
    fn from(words: &String) -> Self {
        Value::from(words.as_str())
    }
}

impl From<Cow<'static, str>> for Value {
    fn from(words: Cow<'static, str>) -> Self {
        Value::Words(words)
    }
}

impl From<fmt::Arguments<'_>> for Value {
    fn from(words: fmt::Arguments<'_>) -> Self {
        let mut written = String::new();
        // Writing to a String cannot fail.
        _ = written.write_fmt(words);
        Value::from(written)
    }
}

impl From<usize> for Value {
    fn from(count: usize) -> Self {
        Value::from(count.to_string())
    }
}

impl From<u64> for Value {
    fn from(count: u64) -> Self {
        Value::from(count.to_string())
    }
}

impl From<u32> for Value {
    fn from(count: u32) -> Self {
        Value::from(count.to_string())
    }
}

impl From<f64> for Value {
    /// All digits of a number without a length in its unit.
    fn from(number: f64) -> Self {
        Value::from(number.to_string())
    }
}

impl From<Length> for Value {
    fn from(length: Length) -> Self {
        Value::Length(length)
    }
}

impl From<&'static LengthKind> for Value {
    fn from(kind: &'static LengthKind) -> Self {
        Value::Unit(kind)
    }
}

impl From<Text> for Value {
    fn from(text: Text) -> Self {
        Value::Text(text)
    }
}

impl From<&Text> for Value {
    fn from(text: &Text) -> Self {
        Value::Text(text.clone())
    }
}

impl From<Option<Text>> for Value {
    fn from(text: Option<Text>) -> Self {
        Value::Text(text.unwrap_or_default())
    }
}

impl From<Remedy> for Value {
    fn from(remedy: Remedy) -> Self {
        Value::Remedy(remedy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_joined_with_something_between_them() {
        let empty = Text::default();
        let all = [empty.clone(), Text::from("a"), empty, text!("b {} {}", 3_u32, Length::mm(2.54))];
        let all = Text::joined(all, "; ");
        assert_eq!(all.to_string(), "a; b 3 2.54 mm");
        assert_eq!(all.in_unit(LengthUnit::Inch), "a; b 3 0.1 in");
        assert_eq!(Text::from("with {} braces").to_string(), "with {} braces");
    }

    #[test]
    fn remedies_are_found_in_texts_of_texts() {
        let remedy = |key: &'static str| Remedy::new([KeyChange::new(key, "3 mm")]);
        let inner = text!("{} or {}", remedy("cam.a"), remedy("cam.b"));
        let note = text!("{} would pass", inner).and("; ", remedy("cam.c"));
        let keys: Vec<&str> = note.remedies().iter().map(|remedy| &*remedy.changes[0].key).collect();
        assert_eq!(keys, ["cam.a", "cam.b", "cam.c"]);
        let wrong = text!("it lifts off").and("; ", note).and("; ", "at 3 rpm").without_remedies();
        assert_eq!(wrong.to_string(), "it lifts off; at 3 rpm");
    }
}

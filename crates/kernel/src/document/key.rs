//! What a file may contain: its tables, their keys, and what a value of each key may be.
//!
//! A [`KeySection`] and its [`Key`]s are constants, written where the part they describe is written. The reader, the
//! template, the schema and "did you mean" all use the same list of sections. A [`Field`] is a key together with the
//! type of its value, so that no caller can read it as another type.

use super::bounds::Bounds;
use super::columns::Columns;
use super::input::exact;
use crate::units::Dimension;
use std::sync::Arc;

/// What a value of a key may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum KeyForm {
    /// A text that is not empty.
    Text,
    /// A text that is not empty, or a number, as typed.
    TextOrNumber,
    /// True or false.
    Boolean,
    /// A bare number.
    Number(Bounds),
    /// A share, `5 %`, or the same as a bare number, `0.05`; its bounds are those of the number.
    Share(Bounds),
    /// A list of bare numbers.
    Numbers(Bounds),
    /// A list of texts or numbers, `["angle", 3]`.
    Texts,
    /// A number with a unit, `"180 mm"`.
    Quantity(Dimension, Bounds),
    /// A length or an angle, each in its range; which one it is decides what it means.
    LengthOrAngle(Bounds, Bounds),
    /// An angle, or in its place a length, each in its range: a place of a cam that turns, or of one that travels.
    AngleOrLength(Bounds, Bounds),
    /// A length, an angle, or a share such as `1 %` with its bounds as a number.
    LengthAngleOrShare(Bounds, Bounds, Bounds),
    /// A quantity of one of two kinds, each in its range; which one it is decides what it means.
    Either((Dimension, Bounds), (Dimension, Bounds)),
    /// One of several words.
    Words(&'static [&'static str]),
    /// One of several words, or a quantity.
    WordsOrQuantity(&'static [&'static str], Dimension, Bounds),
    /// Two quantities, the first below the second, `"35 mm .. 60 mm"`.
    Band(Dimension, Bounds),
    /// A list of two quantities, `["-1100 mm", "550 mm"]`.
    Pair(Dimension, Bounds),
    /// A list of points: an angle or a length, and a length or an angle, each in its range, `[["0 deg", "0 mm"], ["90 deg", "12 mm"]]`.
    Points((Bounds, Bounds), (Bounds, Bounds)),
    /// The path of a file with columns of numbers, from the folder of the file that names it.
    Columns,
}

/// How a value of a form is typed in TOML.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Typing {
    /// As a text, `"180 mm"`.
    Quoted,
    /// As it stands: `35`, `true`, `[1, 2]`.
    Bare,
    /// Bare where it is a number, else as a text.
    BareNumber,
}

/// The range of a single number of a form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ValueRange {
    /// What it measures; none for a bare number.
    pub dimension: Option<Dimension>,
    /// Its limits, in SI.
    pub bounds: Bounds,
}

impl KeyForm {
    /// How its values are typed in TOML.
    #[must_use]
    pub const fn typing(self) -> Typing {
        match self {
            KeyForm::Boolean
            | KeyForm::Number(_)
            | KeyForm::Numbers(_)
            | KeyForm::Texts
            | KeyForm::Pair(..)
            | KeyForm::Points(..) => Typing::Bare,
            KeyForm::Share(_) | KeyForm::TextOrNumber => Typing::BareNumber,
            KeyForm::Text
            | KeyForm::Quantity(..)
            | KeyForm::LengthOrAngle(..)
            | KeyForm::AngleOrLength(..)
            | KeyForm::LengthAngleOrShare(..)
            | KeyForm::Either(..)
            | KeyForm::Words(_)
            | KeyForm::WordsOrQuantity(..)
            | KeyForm::Band(..)
            | KeyForm::Columns => Typing::Quoted,
        }
    }

    /// What its values measure, in the order in which a reader tries them; none for words, texts and bare numbers.
    #[must_use]
    pub fn dimensions(self) -> Vec<Dimension> {
        match self {
            KeyForm::Quantity(dimension, _)
            | KeyForm::WordsOrQuantity(_, dimension, _)
            | KeyForm::Band(dimension, _)
            | KeyForm::Pair(dimension, _) => vec![dimension],
            KeyForm::LengthOrAngle(..) | KeyForm::LengthAngleOrShare(..) => vec![Dimension::Length, Dimension::Angle],
            KeyForm::AngleOrLength(..) | KeyForm::Points(..) => vec![Dimension::Angle, Dimension::Length],
            KeyForm::Either((first, _), (second, _)) => vec![first, second],
            KeyForm::Text
            | KeyForm::TextOrNumber
            | KeyForm::Boolean
            | KeyForm::Number(_)
            | KeyForm::Share(_)
            | KeyForm::Numbers(_)
            | KeyForm::Texts
            | KeyForm::Words(_)
            | KeyForm::Columns => Vec::new(),
        }
    }

    /// The ranges of a single number of this form; none where a value is a text, a list or a band.
    #[must_use]
    pub fn ranges(self) -> Vec<ValueRange> {
        let bare = |bounds| ValueRange { dimension: None, bounds };
        let quantity = |dimension, bounds| ValueRange { dimension: Some(dimension), bounds };
        match self {
            KeyForm::Number(bounds) | KeyForm::Share(bounds) => vec![bare(bounds)],
            KeyForm::Quantity(dimension, bounds) | KeyForm::WordsOrQuantity(_, dimension, bounds) => {
                vec![quantity(dimension, bounds)]
            }
            KeyForm::LengthOrAngle(length, angle) => {
                vec![quantity(Dimension::Length, length), quantity(Dimension::Angle, angle)]
            }
            KeyForm::AngleOrLength(angle, length) => {
                vec![quantity(Dimension::Angle, angle), quantity(Dimension::Length, length)]
            }
            KeyForm::LengthAngleOrShare(length, angle, share) => {
                vec![quantity(Dimension::Length, length), quantity(Dimension::Angle, angle), bare(share)]
            }
            KeyForm::Either((first, first_bounds), (second, second_bounds)) => {
                vec![quantity(first, first_bounds), quantity(second, second_bounds)]
            }
            KeyForm::Text
            | KeyForm::TextOrNumber
            | KeyForm::Boolean
            | KeyForm::Numbers(_)
            | KeyForm::Texts
            | KeyForm::Words(_)
            | KeyForm::Band(..)
            | KeyForm::Pair(..)
            | KeyForm::Points(..)
            | KeyForm::Columns => Vec::new(),
        }
    }
}

/// Whether a key must be given. The texts are values as typed, without the quotes of TOML.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Presence {
    /// It must be given; here is an example.
    Required(&'static str),
    /// It must be given, as in the example, unless the file has the table that replaces it.
    RequiredUnless(&'static str, &'static str),
    /// The value when it is absent.
    Default(&'static str),
    /// It may be absent; here is an example.
    Optional(&'static str),
}

impl Presence {
    /// The example or default as typed.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Presence::Required(text)
            | Presence::RequiredUnless(_, text)
            | Presence::Default(text)
            | Presence::Optional(text) => text,
        }
    }
}

/// One key of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Key {
    /// The name within its table.
    pub name: &'static str,
    /// Its meaning, and its range where that is not obvious.
    pub about: &'static str,
    /// Whether it must be given.
    pub presence: Presence,
    /// What a value may be.
    pub form: KeyForm,
    /// The kinds of cam on which it has an effect; empty: those of its table.
    pub cams: &'static [&'static str],
    /// What is right where a value is out of its range, when that is not obvious.
    pub hint: Option<&'static str>,
    /// Other names under which people look for it in its table.
    pub also: &'static [&'static str],
    /// The key of its table that it gives by half of its value, in the place of that key: a diameter gives a radius.
    pub halved: Option<&'static str>,
    /// A word of its form that may stand in the place of its whole table: `keyway = "auto"`.
    pub for_table: Option<&'static str>,
}

impl Key {
    /// A value as typed, as it is written in TOML.
    #[must_use]
    pub fn in_toml(&self, typed: &str) -> String {
        match self.form.typing() {
            Typing::Bare => typed.to_owned(),
            Typing::Quoted | Typing::BareNumber => {
                format!("\"{}\"", typed.replace('\\', "\\\\").replace('"', "\\\""))
            }
        }
    }
}

/// How often a table occurs in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Occurrence {
    /// Always: its required keys must be given even when its header is missing.
    Once,
    /// Optional, as a whole.
    Optional,
    /// When it or one of these tables is present: parts of something that is described as a whole or not at all.
    With(&'static [&'static str]),
    /// As an array of tables, `[[path]]`, in any number.
    Repeated,
}

/// One table of a file, or keys that are added to the table of the section before it, which has the same path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KeySection {
    /// Dotted path; empty for the keys before the first table.
    pub path: &'static str,
    /// What the table describes.
    pub about: &'static str,
    /// How often it occurs.
    pub occurs: Occurrence,
    /// The kinds of cam the whole table belongs to; empty: every one.
    pub cams: &'static [&'static str],
    /// Its keys, in the order of the template.
    pub keys: &'static [Key],
}

impl KeySection {
    /// Dotted path of a key in this table; in a repeated one the index is left open, `motion.segment[].law`.
    #[must_use]
    pub fn path_of(&self, key: &Key) -> String {
        if self.path.is_empty() {
            return key.name.to_owned();
        }
        [self.path, if self.occurs == Occurrence::Repeated { "[]." } else { "." }, key.name].concat()
    }

    /// The kinds of cam on which a key of this table has an effect; empty: every one.
    #[must_use]
    pub const fn cams_of(&self, key: &Key) -> &'static [&'static str] {
        if key.cams.is_empty() { self.cams } else { key.cams }
    }
}

/// Whether a section adds keys to the table of the one before it.
pub(super) fn continues(sections: &[&KeySection], index: usize) -> bool {
    let before = index.checked_sub(1).and_then(|before| sections.get(before));
    before.zip(sections.get(index)).is_some_and(|(before, own)| before.path == own.path)
}

/// The key at a path, indices left open, with its table.
pub(super) fn key_at<'s>(sections: &[&'s KeySection], path: &str) -> Option<(&'s KeySection, &'s Key)> {
    let (table, name) = match path.rsplit_once('.') {
        None => ("", path),
        Some(("", _)) => return None,
        Some(parts) => parts,
    };
    let (table, repeated) = table.strip_suffix("[]").map_or((table, false), |table| (table, true));
    let is_table =
        |section: &&&KeySection| section.path == table && (section.occurs == Occurrence::Repeated) == repeated;
    let mut keys = sections.iter().filter(is_table).flat_map(|section| section.keys.iter().map(|key| (*section, key)));
    keys.find(|(_, key)| key.name == name)
}

/// A path and a name below it.
pub(super) fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { [path, ".", name].concat() }
}

/// A length or an angle, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LengthOrAngle {
    /// Metres.
    Length(f64),
    /// Radians.
    Angle(f64),
}

/// A length or an angle, in SI units, or a share of something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LengthAngleOrShare {
    /// Of a length or an angle.
    Size(LengthOrAngle),
    /// A share: 0.01 of `1 %`.
    Share(f64),
}

/// A value that fits the form of its key.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum KeyValue {
    Text(String),
    Boolean(bool),
    /// A bare number, or a quantity in SI units.
    Number(f64),
    Numbers(Vec<f64>),
    Texts(Vec<String>),
    LengthOrAngle(LengthOrAngle),
    Share(f64),
    Either(Dimension, f64),
    /// Which of the words.
    Word(usize),
    Band(f64, f64),
    Pair([f64; 2]),
    Points(PointList),
    Columns(Arc<Columns>),
}

impl LengthOrAngle {
    /// The number with all its digits and its SI unit.
    fn canonical(self) -> String {
        match self {
            LengthOrAngle::Length(length) => format!("{} m", exact(length)),
            LengthOrAngle::Angle(angle) => format!("{} rad", exact(angle)),
        }
    }

    /// The same where an angle is what is usual, and needs no unit.
    fn canonical_place(self) -> String {
        match self {
            LengthOrAngle::Length(_) => self.canonical(),
            LengthOrAngle::Angle(angle) => exact(angle),
        }
    }
}

/// What a field reads of a value of its form; `None` of another form.
impl KeyValue {
    fn text(&self) -> Option<String> {
        if let Self::Text(text) = self { Some(text.clone()) } else { None }
    }

    fn boolean(&self) -> Option<bool> {
        if let Self::Boolean(truth) = self { Some(*truth) } else { None }
    }

    fn texts(&self) -> Option<Vec<String>> {
        if let Self::Texts(texts) = self { Some(texts.clone()) } else { None }
    }

    fn length_or_angle(&self) -> Option<LengthOrAngle> {
        if let Self::LengthOrAngle(either) = self { Some(*either) } else { None }
    }

    fn length_angle_or_share(&self) -> Option<LengthAngleOrShare> {
        match self {
            Self::LengthOrAngle(either) => Some(LengthAngleOrShare::Size(*either)),
            Self::Share(share) => Some(LengthAngleOrShare::Share(*share)),
            _ => None,
        }
    }

    fn band(&self) -> Option<(f64, f64)> {
        if let Self::Band(low, high) = self { Some((*low, *high)) } else { None }
    }

    fn pair(&self) -> Option<[f64; 2]> {
        if let Self::Pair(pair) = self { Some(*pair) } else { None }
    }

    fn points(&self) -> Option<PointList> {
        if let Self::Points(points) = self { Some(points.clone()) } else { None }
    }
}

impl KeyValue {
    /// Half of a number; of a number in SI units exactly.
    pub(super) fn halved(self) -> Self {
        if let KeyValue::Number(number) = self { KeyValue::Number(0.5 * number) } else { self }
    }

    /// The one text of this value, numbers in SI units with all their digits.
    pub(super) fn canonical(&self, form: KeyForm) -> String {
        match (self, form) {
            (KeyValue::Text(text), _) => text.clone(),
            (KeyValue::Boolean(truth), _) => truth.to_string(),
            (KeyValue::Number(number), _) => exact(*number),
            (KeyValue::Numbers(numbers), _) => numbers.iter().copied().map(exact).collect::<Vec<_>>().join(" "),
            (KeyValue::Texts(texts), _) => texts.join(", "),
            (KeyValue::LengthOrAngle(either), KeyForm::AngleOrLength(..)) => either.canonical_place(),
            (KeyValue::LengthOrAngle(either), _) => either.canonical(),
            (KeyValue::Share(share), _) => format!("{} of 1", exact(*share)),
            (KeyValue::Either(dimension, number), _) => format!("{} of {dimension}", exact(*number)),
            (KeyValue::Word(index), KeyForm::Words(words) | KeyForm::WordsOrQuantity(words, ..)) => {
                words.get(*index).copied().unwrap_or_default().to_owned()
            }
            (KeyValue::Word(index), _) => index.to_string(),
            (KeyValue::Band(low, high), _) => format!("{} .. {}", exact(*low), exact(*high)),
            (KeyValue::Pair(pair), _) => pair.map(exact).join(" "),
            (KeyValue::Points(points), _) => points
                .iter()
                .map(|(at, to)| format!("{} {}", at.canonical_place(), to.canonical()))
                .collect::<Vec<_>>()
                .join(", "),
            (KeyValue::Columns(columns), _) => columns.canonical(),
        }
    }
}

/// How a value is converted for the caller.
#[derive(Debug)]
enum Convert<T: 'static> {
    Plain(fn(&KeyValue) -> Option<T>),
    Words(&'static [T]),
    WordsOrNumber(&'static [T], fn(f64) -> T),
}

/// A key whose value is read as a `T`.
#[derive(Debug)]
pub struct Field<T: 'static> {
    /// The key.
    pub key: Key,
    convert: Convert<T>,
}

impl<T> Field<T> {
    const fn new(
        name: &'static str,
        about: &'static str,
        presence: Presence,
        form: KeyForm,
        convert: Convert<T>,
    ) -> Field<T> {
        Field {
            key: Key { name, about, presence, form, cams: &[], hint: None, also: &[], halved: None, for_table: None },
            convert,
        }
    }

    /// The key that may be given in the place of this radius: its diameter. The radius is read by its own key, however it was given.
    ///
    /// # Panics
    /// When this is not a key for a quantity, which stops the build of the constant.
    #[must_use]
    pub const fn diameter(&self, name: &'static str, about: &'static str, example: &'static str) -> Key {
        let form = match self.key.form {
            KeyForm::Quantity(dimension, bounds) | KeyForm::WordsOrQuantity(_, dimension, bounds) => {
                let Bounds { low, low_included, high } = bounds;
                KeyForm::Quantity(dimension, Bounds { low: 2.0 * low, low_included, high: 2.0 * high })
            }
            other => other,
        };
        assert!(matches!(form, KeyForm::Quantity(..)), "a radius is a quantity");
        let presence = Presence::Optional(example);
        let (cams, halved) = (self.key.cams, Some(self.key.name));
        Key { name, about, presence, form, hint: None, also: &[], cams, halved, for_table: None }
    }

    /// The key, with a word of it that may stand in the place of its whole table.
    #[must_use]
    pub const fn for_table(mut self, word: &'static str) -> Self {
        self.key.for_table = Some(word);
        self
    }

    /// The key, with an effect on these kinds of cam only.
    #[must_use]
    pub const fn only(mut self, cams: &'static [&'static str]) -> Self {
        self.key.cams = cams;
        self
    }

    /// The key with what is right where a value is out of its range.
    #[must_use]
    pub const fn hint(mut self, hint: &'static str) -> Self {
        self.key.hint = Some(hint);
        self
    }

    /// The key with other names under which people look for it in its table; they are suggested for it, and not accepted.
    #[must_use]
    pub const fn also(mut self, names: &'static [&'static str]) -> Self {
        self.key.also = names;
        self
    }

    /// A key for one of several words; `values` are what they mean, in the same order.
    ///
    /// # Panics
    /// When there are not as many values as words, which stops the build of the constant.
    #[must_use]
    pub const fn words(
        name: &'static str,
        about: &'static str,
        presence: Presence,
        words: &'static [&'static str],
        values: &'static [T],
    ) -> Self {
        assert!(words.len() == values.len(), "a value for each word");
        Self::new(name, about, presence, KeyForm::Words(words), Convert::Words(values))
    }

    /// A key for one of several words, or a quantity; `values` are what the words mean.
    ///
    /// # Panics
    /// When there are not as many values as words, which stops the build of the constant.
    #[must_use]
    pub const fn words_or_quantity(
        name: &'static str,
        about: &'static str,
        presence: Presence,
        (words, values): (&'static [&'static str], &'static [T]),
        (dimension, bounds, from): (Dimension, Bounds, fn(f64) -> T),
    ) -> Self {
        assert!(words.len() == values.len(), "a value for each word");
        let form = KeyForm::WordsOrQuantity(words, dimension, bounds);
        Self::new(name, about, presence, form, Convert::WordsOrNumber(values, from))
    }
}

impl<T: Clone> Field<T> {
    pub(super) fn of(&self, value: &KeyValue) -> Option<T> {
        match (&self.convert, value) {
            (Convert::Plain(convert), value) => convert(value),
            (Convert::Words(values) | Convert::WordsOrNumber(values, _), KeyValue::Word(index)) => {
                values.get(*index).cloned()
            }
            (Convert::WordsOrNumber(_, from), KeyValue::Number(number)) => Some(from(*number)),
            _ => None,
        }
    }
}

impl Field<String> {
    /// A key for a text.
    #[must_use]
    pub const fn text(name: &'static str, about: &'static str, presence: Presence) -> Self {
        Self::new(name, about, presence, KeyForm::Text, Convert::Plain(KeyValue::text))
    }

    /// A key for a text that may be a number, which needs no quotes then.
    #[must_use]
    pub const fn text_or_number(name: &'static str, about: &'static str, presence: Presence) -> Self {
        let Field { key, convert } = Self::text(name, about, presence);
        Field { key: Key { form: KeyForm::TextOrNumber, ..key }, convert }
    }
}

impl Field<bool> {
    /// A key that is true or false.
    #[must_use]
    pub const fn boolean(name: &'static str, about: &'static str, presence: Presence) -> Self {
        Self::new(name, about, presence, KeyForm::Boolean, Convert::Plain(KeyValue::boolean))
    }
}

impl Field<f64> {
    /// A key for a bare number.
    #[must_use]
    pub const fn number(name: &'static str, about: &'static str, presence: Presence, bounds: Bounds) -> Self {
        Self::new(name, about, presence, KeyForm::Number(bounds), Convert::Plain(number))
    }

    /// A key for a share, which may be typed as `5 %` or `0.05`; its value is the number.
    #[must_use]
    pub const fn share(name: &'static str, about: &'static str, presence: Presence, bounds: Bounds) -> Self {
        Self::new(name, about, presence, KeyForm::Share(bounds), Convert::Plain(number))
    }

    /// A key for a quantity; its value is in SI units, as its bounds are.
    #[must_use]
    pub const fn quantity(
        name: &'static str,
        about: &'static str,
        presence: Presence,
        dimension: Dimension,
        bounds: Bounds,
    ) -> Self {
        Self::new(name, about, presence, KeyForm::Quantity(dimension, bounds), Convert::Plain(number))
    }
}

fn number(value: &KeyValue) -> Option<f64> {
    if let KeyValue::Number(number) = value { Some(*number) } else { None }
}

impl Field<Vec<f64>> {
    /// A key for a list of bare numbers, each within the bounds.
    #[must_use]
    pub const fn numbers(name: &'static str, about: &'static str, presence: Presence, bounds: Bounds) -> Self {
        let convert =
            |value: &KeyValue| if let KeyValue::Numbers(numbers) = value { Some(numbers.clone()) } else { None };
        Self::new(name, about, presence, KeyForm::Numbers(bounds), Convert::Plain(convert))
    }
}

impl Field<Vec<String>> {
    /// A key for a list of texts or numbers. The example is as in TOML.
    #[must_use]
    pub const fn texts(name: &'static str, about: &'static str, presence: Presence) -> Self {
        Self::new(name, about, presence, KeyForm::Texts, Convert::Plain(KeyValue::texts))
    }
}

impl Field<LengthOrAngle> {
    /// A key for a length or an angle.
    #[must_use]
    pub const fn length_or_angle(
        name: &'static str,
        about: &'static str,
        presence: Presence,
        length: Bounds,
        angle: Bounds,
    ) -> Self {
        let form = KeyForm::LengthOrAngle(length, angle);
        Self::new(name, about, presence, form, Convert::Plain(KeyValue::length_or_angle))
    }

    /// A key for an angle, or in its place a length.
    #[must_use]
    pub const fn angle_or_length(
        name: &'static str,
        about: &'static str,
        presence: Presence,
        angle: Bounds,
        length: Bounds,
    ) -> Self {
        let Field { key, convert } = Self::length_or_angle(name, about, presence, length, angle);
        Field { key: Key { form: KeyForm::AngleOrLength(angle, length), ..key }, convert }
    }
}

impl Field<LengthAngleOrShare> {
    /// A key for a length, an angle or a share, with the bounds of each; those of the share as a number.
    #[must_use]
    pub const fn length_angle_or_share(
        name: &'static str,
        about: &'static str,
        presence: Presence,
        (length, angle): (Bounds, Bounds),
        share: Bounds,
    ) -> Self {
        let form = KeyForm::LengthAngleOrShare(length, angle, share);
        Self::new(name, about, presence, form, Convert::Plain(KeyValue::length_angle_or_share))
    }
}

impl Field<(Dimension, f64)> {
    /// A key for a quantity of one of two kinds; its value is the kind and the number in SI units.
    #[must_use]
    pub const fn either(
        name: &'static str,
        about: &'static str,
        presence: Presence,
        first: (Dimension, Bounds),
        second: (Dimension, Bounds),
    ) -> Self {
        let convert =
            |value: &KeyValue| if let KeyValue::Either(kind, number) = value { Some((*kind, *number)) } else { None };
        Self::new(name, about, presence, KeyForm::Either(first, second), Convert::Plain(convert))
    }
}

impl Field<(f64, f64)> {
    /// A key for a band of two quantities, the first below the second.
    #[must_use]
    pub const fn band(
        name: &'static str,
        about: &'static str,
        presence: Presence,
        dimension: Dimension,
        bounds: Bounds,
    ) -> Self {
        Self::new(name, about, presence, KeyForm::Band(dimension, bounds), Convert::Plain(KeyValue::band))
    }
}

impl Field<[f64; 2]> {
    /// A key for a list of two quantities, each within the bounds. Example and default are as in TOML.
    #[must_use]
    pub const fn pair(
        name: &'static str,
        about: &'static str,
        presence: Presence,
        dimension: Dimension,
        bounds: Bounds,
    ) -> Self {
        Self::new(name, about, presence, KeyForm::Pair(dimension, bounds), Convert::Plain(KeyValue::pair))
    }
}

/// Points as they are read: a place, an angle or a length, and a position, a length or an angle, each.
pub type PointList = Vec<(LengthOrAngle, LengthOrAngle)>;

impl Field<PointList> {
    /// A key for a list of points: the bounds of their places, as angles and as lengths, and of their positions, as lengths and as angles.
    /// Example and default are as in TOML.
    #[must_use]
    pub const fn points(
        name: &'static str,
        about: &'static str,
        presence: Presence,
        place: (Bounds, Bounds),
        position: (Bounds, Bounds),
    ) -> Self {
        Self::new(name, about, presence, KeyForm::Points(place, position), Convert::Plain(KeyValue::points))
    }
}

impl Field<Arc<Columns>> {
    /// A key for the path of a file with columns of numbers.
    #[must_use]
    pub const fn columns(name: &'static str, about: &'static str, presence: Presence) -> Self {
        let convert =
            |value: &KeyValue| if let KeyValue::Columns(columns) = value { Some(Arc::clone(columns)) } else { None };
        Self::new(name, about, presence, KeyForm::Columns, Convert::Plain(convert))
    }
}

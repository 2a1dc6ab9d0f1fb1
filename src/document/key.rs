//! What a file may contain: its tables, their keys, and what a value of each key may be.
//!
//! A [`Section`] and its [`Key`]s are constants, written where the part they describe is written. The reader, the
//! template, the schema and "did you mean" all walk the same list of sections. A [`Field`] is a key together with the
//! type its value becomes, so that no read can ask for the wrong type.

use super::bounds::Bounds;
use super::columns::{Columns, Row};
use super::input::exact;
use crate::units::Dimension;
use std::sync::Arc;

/// What a value of a key may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Form {
    /// A text that is not empty.
    Text,
    /// True or false.
    Boolean,
    /// A bare number.
    Number(Bounds),
    /// A list of bare numbers.
    Numbers(Bounds),
    /// A number with a unit, `"180 mm"`.
    Quantity(Dimension, Bounds),
    /// A length or an angle, each in its range; which one it is decides what it means.
    LengthOrAngle(Bounds, Bounds),
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
    /// A list of points: a quantity, and a length or an angle in its range, `[["0 deg", "0 mm"], ["90 deg", "12 mm"]]`.
    Points(Dimension, Bounds, (Bounds, Bounds)),
    /// The path of a file with two columns of numbers, from the folder of the file that names it.
    Columns,
}

/// Whether a key must be given. The texts are values as typed, without the quotes of TOML.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Presence {
    /// It must be given; here is an example.
    Required(&'static str),
    /// It must be given, with this example, but where another table stands that takes its place.
    RequiredUnless(&'static str, &'static str),
    /// What holds when it is absent.
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
    /// What it means, its range where that is not obvious.
    pub about: &'static str,
    /// Whether it must be given.
    pub presence: Presence,
    /// What a value may be.
    pub form: Form,
    /// The kinds of cam on which it has an effect; empty: as its table says.
    pub cams: &'static [&'static str],
}

impl Key {
    /// A value as typed, as it is written in TOML.
    #[must_use]
    pub fn in_toml(&self, typed: &str) -> String {
        match self.form {
            Form::Number(_) | Form::Numbers(_) | Form::Boolean | Form::Pair(..) | Form::Points(..) => typed.to_owned(),
            _ => format!("\"{}\"", typed.replace('\\', "\\\\").replace('"', "\\\"")),
        }
    }
}

/// How often a table occurs in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Occurs {
    /// Always: its required keys must be given even when its header is missing.
    Once,
    /// As a whole or not at all.
    Optional,
    /// When it or one of these tables is present: parts of something that is described as a whole or not at all.
    With(&'static [&'static str]),
    /// As an array of tables, `[[path]]`, in any number.
    Repeated,
}

/// One table of a file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// Dotted path; empty for the keys before the first table.
    pub path: &'static str,
    /// What the table describes.
    pub about: &'static str,
    /// How often it occurs.
    pub occurs: Occurs,
    /// The kinds of cam the whole table belongs to; empty: every one.
    pub cams: &'static [&'static str],
    /// Its keys, in the order of the template.
    pub keys: &'static [Key],
}

impl Section {
    /// Dotted path of a key in this table; in a repeated one the index is left open, `motion.segment[].law`.
    #[must_use]
    pub fn path_of(&self, key: &Key) -> String {
        if self.path.is_empty() {
            return key.name.to_owned();
        }
        [self.path, if self.occurs == Occurs::Repeated { "[]." } else { "." }, key.name].concat()
    }

    /// The kinds of cam on which a key of this table has an effect; empty: every one.
    #[must_use]
    pub const fn cams_of(&self, key: &Key) -> &'static [&'static str] {
        if key.cams.is_empty() { self.cams } else { key.cams }
    }
}

/// The key at a path, indices left open, with its table.
pub(super) fn key_at<'s>(sections: &[&'s Section], path: &str) -> Option<(&'s Section, &'s Key)> {
    let (table, name) = match path.rsplit_once('.') {
        None => ("", path),
        Some(("", _)) => return None,
        Some(parts) => parts,
    };
    let (table, repeated) = table.strip_suffix("[]").map_or((table, false), |table| (table, true));
    let is_table = |section: &&&Section| section.path == table && (section.occurs == Occurs::Repeated) == repeated;
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

/// A value that fits the form of its key.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Text(String),
    Boolean(bool),
    /// A bare number, or a quantity in SI units.
    Number(f64),
    Numbers(Vec<f64>),
    LengthOrAngle(LengthOrAngle),
    Either(Dimension, f64),
    /// Which of the words.
    Word(usize),
    Band(f64, f64),
    Pair([f64; 2]),
    Points(Vec<(f64, LengthOrAngle)>),
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
}

impl Value {
    /// The one text of this value, numbers in SI units with all their digits.
    pub(super) fn canonical(&self, form: Form) -> String {
        match (self, form) {
            (Value::Text(text), _) => text.clone(),
            (Value::Boolean(truth), _) => truth.to_string(),
            (Value::Number(number), _) => exact(*number),
            (Value::Numbers(numbers), _) => numbers.iter().copied().map(exact).collect::<Vec<_>>().join(" "),
            (Value::LengthOrAngle(either), _) => either.canonical(),
            (Value::Either(dimension, number), _) => format!("{} of {dimension}", exact(*number)),
            (Value::Word(index), Form::Words(words) | Form::WordsOrQuantity(words, ..)) => {
                words.get(*index).copied().unwrap_or_default().to_owned()
            }
            (Value::Word(index), _) => index.to_string(),
            (Value::Band(low, high), _) => format!("{} .. {}", exact(*low), exact(*high)),
            (Value::Pair(pair), _) => pair.map(exact).join(" "),
            (Value::Points(points), _) => points
                .iter()
                .map(|(at, to)| format!("{} {}", exact(*at), to.canonical()))
                .collect::<Vec<_>>()
                .join(", "),
            (Value::Columns(columns), _) => {
                let row = |row: &Row| row.values.map(exact).join(" ");
                columns.rows.iter().map(row).collect::<Vec<_>>().join(", ")
            }
        }
    }
}

/// How a value is converted for the caller.
#[derive(Debug)]
enum Convert<T: 'static> {
    Plain(fn(&Value) -> Option<T>),
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
        form: Form,
        convert: Convert<T>,
    ) -> Field<T> {
        Field { key: Key { name, about, presence, form, cams: &[] }, convert }
    }

    /// The same key with an effect on these kinds of cam only.
    #[must_use]
    pub const fn only(mut self, cams: &'static [&'static str]) -> Self {
        self.key.cams = cams;
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
        Self::new(name, about, presence, Form::Words(words), Convert::Words(values))
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
        let form = Form::WordsOrQuantity(words, dimension, bounds);
        Self::new(name, about, presence, form, Convert::WordsOrNumber(values, from))
    }
}

impl<T: Clone> Field<T> {
    pub(super) fn of(&self, value: &Value) -> Option<T> {
        match (&self.convert, value) {
            (Convert::Plain(convert), value) => convert(value),
            (Convert::Words(values) | Convert::WordsOrNumber(values, _), Value::Word(index)) => {
                values.get(*index).cloned()
            }
            (Convert::WordsOrNumber(_, from), Value::Number(number)) => Some(from(*number)),
            _ => None,
        }
    }
}

impl Field<String> {
    /// A key for a text.
    #[must_use]
    pub const fn text(name: &'static str, about: &'static str, presence: Presence) -> Self {
        let convert = |value: &Value| if let Value::Text(text) = value { Some(text.clone()) } else { None };
        Self::new(name, about, presence, Form::Text, Convert::Plain(convert))
    }
}

impl Field<bool> {
    /// A key that is true or false.
    #[must_use]
    pub const fn boolean(name: &'static str, about: &'static str, presence: Presence) -> Self {
        let convert = |value: &Value| if let Value::Boolean(truth) = value { Some(*truth) } else { None };
        Self::new(name, about, presence, Form::Boolean, Convert::Plain(convert))
    }
}

impl Field<f64> {
    /// A key for a bare number.
    #[must_use]
    pub const fn number(name: &'static str, about: &'static str, presence: Presence, bounds: Bounds) -> Self {
        Self::new(name, about, presence, Form::Number(bounds), Convert::Plain(number))
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
        Self::new(name, about, presence, Form::Quantity(dimension, bounds), Convert::Plain(number))
    }
}

fn number(value: &Value) -> Option<f64> {
    if let Value::Number(number) = value { Some(*number) } else { None }
}

impl Field<Vec<f64>> {
    /// A key for a list of bare numbers, each within the bounds.
    #[must_use]
    pub const fn numbers(name: &'static str, about: &'static str, presence: Presence, bounds: Bounds) -> Self {
        let convert = |value: &Value| if let Value::Numbers(numbers) = value { Some(numbers.clone()) } else { None };
        Self::new(name, about, presence, Form::Numbers(bounds), Convert::Plain(convert))
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
        let convert = |value: &Value| if let Value::LengthOrAngle(either) = value { Some(*either) } else { None };
        Self::new(name, about, presence, Form::LengthOrAngle(length, angle), Convert::Plain(convert))
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
            |value: &Value| if let Value::Either(kind, number) = value { Some((*kind, *number)) } else { None };
        Self::new(name, about, presence, Form::Either(first, second), Convert::Plain(convert))
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
        let convert = |value: &Value| if let Value::Band(low, high) = value { Some((*low, *high)) } else { None };
        Self::new(name, about, presence, Form::Band(dimension, bounds), Convert::Plain(convert))
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
        let convert = |value: &Value| if let Value::Pair(pair) = value { Some(*pair) } else { None };
        Self::new(name, about, presence, Form::Pair(dimension, bounds), Convert::Plain(convert))
    }
}

/// Points as they are read: a number in SI units and a length or angle each.
pub type Points = Vec<(f64, LengthOrAngle)>;

impl Field<Points> {
    /// A key for a list of points. Example and default are as in TOML.
    #[must_use]
    pub const fn points(
        name: &'static str,
        about: &'static str,
        presence: Presence,
        (dimension, bounds): (Dimension, Bounds),
        either: (Bounds, Bounds),
    ) -> Self {
        let convert = |value: &Value| if let Value::Points(points) = value { Some(points.clone()) } else { None };
        Self::new(name, about, presence, Form::Points(dimension, bounds, either), Convert::Plain(convert))
    }
}

impl Field<Arc<Columns>> {
    /// A key for the path of a file with two columns of numbers.
    #[must_use]
    pub const fn columns(name: &'static str, about: &'static str, presence: Presence) -> Self {
        let convert =
            |value: &Value| if let Value::Columns(columns) = value { Some(Arc::clone(columns)) } else { None };
        Self::new(name, about, presence, Form::Columns, Convert::Plain(convert))
    }
}

//! A value as written in a file, read by the form of its key.

use super::bounds::Bounds;
use super::fault::{Misfit, similar};
use super::key::{Key, KeyForm, KeyValue, LengthOrAngle};
use super::plain::{is_text, shown};
use crate::units::{self, Dimension, QuantityError};
use std::borrow::Cow;

/// A value as written in a file or after a flag.
#[derive(Debug, Clone)]
pub(super) enum Scalar {
    Text(String),
    /// A number as written, without underscores.
    Number(String),
    Boolean(bool),
    /// A date or a time as written.
    Date(String),
    List(Vec<Scalar>),
    /// A value that no key accepts, by its TOML name.
    Other(&'static str),
}

impl Scalar {
    fn kind(&self) -> &'static str {
        match self {
            Scalar::Text(_) => "text",
            Scalar::Number(_) => "number",
            Scalar::Boolean(_) => "boolean",
            Scalar::Date(_) => "date",
            Scalar::List(_) => "array",
            Scalar::Other(kind) => kind,
        }
    }

    /// The value as it was typed.
    pub(super) fn shown(&self) -> String {
        match self {
            Scalar::Text(text) | Scalar::Number(text) | Scalar::Date(text) => text.clone(),
            Scalar::Boolean(truth) => truth.to_string(),
            Scalar::List(items) => {
                format!("[{}]", items.iter().map(Scalar::shown).collect::<Vec<_>>().join(", "))
            }
            Scalar::Other(kind) => (*kind).to_owned(),
        }
    }

    /// The value as it was typed, where it is a text or a number.
    pub(super) fn typed(&self) -> Option<&str> {
        match self {
            Scalar::Text(text) | Scalar::Number(text) => Some(text),
            _ => None,
        }
    }
}

/// Longest text, in characters: the longest formula is shorter.
const LONGEST_TEXT: usize = 5000;
/// Characters of a value that a message quotes.
const MOST_QUOTED: usize = 60;

fn misfit<T>(message: String, help: Option<String>) -> Result<T, Misfit> {
    Err(Misfit { message, help })
}

/// Reads a value by the form of its key; `path` names the key in messages.
pub(super) fn read(key: &Key, path: &str, scalar: &Scalar) -> Result<KeyValue, Misfit> {
    let name = KeyAtPath { key, path };
    match key.form {
        // A file is read by the reader, which knows the folder.
        KeyForm::Text | KeyForm::Columns => name.text(scalar),
        KeyForm::TextOrNumber => match scalar {
            Scalar::Number(typed) | Scalar::Date(typed) => Ok(KeyValue::Text(typed.clone())),
            other => name.text(other),
        },
        KeyForm::Boolean => name.boolean(scalar),
        KeyForm::Number(bounds) => name.number(scalar, bounds).map(KeyValue::Number),
        KeyForm::Share(bounds) => name.share(scalar, bounds).map(KeyValue::Number),
        KeyForm::Numbers(bounds) => name.numbers(scalar, bounds),
        KeyForm::Texts => name.texts(scalar),
        KeyForm::Quantity(dimension, bounds) => name.quantity(scalar, &[], dimension, bounds),
        KeyForm::LengthOrAngle(length, angle) => name.length_or_angle(scalar, length, angle),
        KeyForm::AngleOrLength(angle, length) => name.angle_or_length(scalar, angle, length),
        KeyForm::LengthAngleOrShare(length, angle, share) => name.length_angle_or_share(scalar, length, angle, share),
        KeyForm::Either(first, second) => name.either(scalar, first, second),
        KeyForm::Words(words) => name.word(scalar, words),
        KeyForm::WordsOrQuantity(words, dimension, bounds) => name.quantity(scalar, words, dimension, bounds),
        KeyForm::Band(dimension, bounds) => name.band(scalar, dimension, bounds),
        KeyForm::Pair(dimension, bounds) => name.pair(scalar, dimension, bounds),
        KeyForm::Points(place, position) => name.points(scalar, place.0, place.1, position.0, position.1),
    }
}

fn position(words: &[&str], text: &str) -> Option<usize> {
    words.iter().position(|word| word.eq_ignore_ascii_case(text.trim()))
}

/// The items of a list in the file, or of one after a flag, where each is made of its text.
fn items(scalar: &Scalar, item: impl Fn(String) -> Scalar) -> Option<Cow<'_, [Scalar]>> {
    match scalar {
        Scalar::List(items) => Some(Cow::Borrowed(items)),
        Scalar::Text(text) => {
            let inside = text.trim().strip_prefix('[').and_then(|rest| rest.strip_suffix(']'))?;
            let parts = inside.split(',').map(str::trim).filter(|part| !part.is_empty());
            Some(Cow::Owned(parts.map(|part| item(part.into())).collect()))
        }
        _ => None,
    }
}

/// A kind of quantity, and its range.
type BoundedDimension = (Dimension, Bounds);

/// A key under the path it has in messages.
struct KeyAtPath<'a> {
    key: &'a Key,
    path: &'a str,
}

impl KeyAtPath<'_> {
    /// What is right where a value is out of range.
    fn hint(&self) -> Option<String> {
        self.key.hint.map(str::to_owned)
    }

    /// The example of the key, as written in TOML.
    fn example(&self) -> String {
        format!("e.g. {}", self.key.in_toml(self.key.presence.text()))
    }

    fn text(&self, scalar: &Scalar) -> Result<KeyValue, Misfit> {
        match scalar {
            Scalar::Text(text) if text.chars().nth(LONGEST_TEXT).is_some() => {
                misfit(format!("`{}` has more than {LONGEST_TEXT} characters", self.path), Some(self.example()))
            }
            Scalar::Text(text) if !text.chars().all(is_text) => {
                let help = "remove control characters and marks that change the text direction";
                misfit(format!("`{}` contains characters that cannot be displayed", self.path), Some(help.into()))
            }
            Scalar::Text(text) if !text.trim().is_empty() => Ok(KeyValue::Text(text.clone())),
            _ => misfit(format!("`{}` must be text", self.path), Some(self.example())),
        }
    }

    fn boolean(&self, scalar: &Scalar) -> Result<KeyValue, Misfit> {
        match (scalar, scalar.typed()) {
            (Scalar::Boolean(truth), _) => Ok(KeyValue::Boolean(*truth)),
            (_, Some(text)) if text.eq_ignore_ascii_case("true") => Ok(KeyValue::Boolean(true)),
            (_, Some(text)) if text.eq_ignore_ascii_case("false") => Ok(KeyValue::Boolean(false)),
            _ => misfit(format!("`{}` must be true or false", self.path), None),
        }
    }

    fn number(&self, scalar: &Scalar, bounds: Bounds) -> Result<f64, Misfit> {
        let path = self.path;
        let Some(text) = scalar.typed() else {
            return misfit(format!("`{path}` must be a number, not {}", scalar.kind()), None);
        };
        match units::parse_bare(text) {
            Ok(value) if bounds.holds(value) => Ok(value),
            Ok(value) => {
                let limit = bounds.broken(value, |v| v.to_string());
                misfit(format!("`{path}` must be {limit}: {value}"), self.hint())
            }
            Err(error) => {
                misfit(format!("`{path}`: {error}"), Some(format!("`{path}` is a bare number, without a unit")))
            }
        }
    }

    /// A share with its sign, `5 %`, or a bare number.
    fn share(&self, scalar: &Scalar, bounds: Bounds) -> Result<f64, Misfit> {
        let Some(typed) = scalar.typed() else {
            return misfit(format!("`{}` must be a share, not {}", self.path, scalar.kind()), Some(self.example()));
        };
        let read = match typed.trim().strip_suffix('%') {
            Some(percent) => units::parse_bare(percent).map(|percent| percent / 100.0),
            None => units::parse_bare(typed),
        };
        match read {
            Ok(share) if bounds.holds(share) => Ok(share),
            Ok(share) => {
                let limit = bounds.broken(share, |share| format!("{} %", 100.0 * share));
                let is_percent = !typed.contains('%') && bounds.holds(share / 100.0);
                let percent = is_percent.then(|| format!("a bare number is a share: write \"{} %\"", typed.trim()));
                misfit(format!("`{}` must be {limit}: {typed}", self.path), percent.or(self.hint()))
            }
            Err(error) => misfit(format!("`{}`: {error}", self.path), Some(self.example())),
        }
    }

    /// A list in the file, or `[1, 2, 3]` after a flag.
    fn numbers(&self, scalar: &Scalar, bounds: Bounds) -> Result<KeyValue, Misfit> {
        let Some(items) = items(scalar, Scalar::Number) else { return self.no_list() };
        items.iter().map(|item| self.number(item, bounds)).collect::<Result<_, _>>().map(KeyValue::Numbers)
    }

    /// A list in the file, or `[angle, 3]` after a flag.
    fn texts(&self, scalar: &Scalar) -> Result<KeyValue, Misfit> {
        let items = items(scalar, |text| Scalar::Text(text.trim().trim_matches('"').to_owned()));
        let texts: Option<Vec<String>> =
            items.and_then(|items| items.iter().map(|item| item.typed().map(str::to_owned)).collect());
        match texts {
            Some(texts) if texts.iter().all(|text| !text.trim().is_empty() && text.chars().all(is_text)) => {
                Ok(KeyValue::Texts(texts))
            }
            _ => misfit(format!("`{}` must be a list of texts or numbers", self.path), Some(self.example())),
        }
    }

    /// A list of two in the file, or `[1 mm, 2 mm]` after a flag.
    fn pair(&self, scalar: &Scalar, dimension: Dimension, bounds: Bounds) -> Result<KeyValue, Misfit> {
        let typed = items(scalar, |text| Scalar::Text(text.trim_matches('"').into()));
        let Some([first, second]) = typed.as_deref() else {
            let message = format!("`{}` must be a list of two quantities of {dimension}", self.path);
            return misfit(message, Some(self.example()));
        };
        let one = |item: &Scalar| match self.quantity(item, &[], dimension, bounds)? {
            KeyValue::Number(number) => Ok(number),
            _ => misfit(format!("`{}` must be a quantity of {dimension}", self.path), Some(self.example())),
        };
        Ok(KeyValue::Pair([one(first)?, one(second)?]))
    }

    /// A list of points in the file, or `[[0 deg, 0 mm], [90 deg, 12 mm]]` after a flag.
    fn points(
        &self,
        scalar: &Scalar,
        place_angle: Bounds,
        place_length: Bounds,
        length: Bounds,
        angle: Bounds,
    ) -> Result<KeyValue, Misfit> {
        let wrong = |what: String| misfit(format!("`{}` {what}", self.path), Some(self.example()));
        let typed: Cow<'_, [Scalar]> = match scalar {
            Scalar::List(points) => Cow::Borrowed(points),
            Scalar::Text(text) => Cow::Owned(points_of_flag(text)),
            _ => return wrong("must be a list of points".into()),
        };
        let mut points = Vec::with_capacity(typed.len());
        for (number, point) in (1..).zip(typed.iter()) {
            let Scalar::List(pair) = point else {
                return wrong(format!("must be a list of points, but point {number} is not a pair"));
            };
            let [at, to] = pair.as_slice() else {
                return wrong(format!("must have 2 values in each point: point {number} has {}", pair.len()));
            };
            let at = self.angle_or_length(at, place_angle, place_length);
            match at.and_then(|at| Ok((at, self.length_or_angle(to, length, angle)?))) {
                Ok((KeyValue::LengthOrAngle(at), KeyValue::LengthOrAngle(to))) => points.push((at, to)),
                Ok(_) => {}
                Err(fault) => {
                    return Err(Misfit { message: format!("{}, in point {number}", fault.message), ..fault });
                }
            }
        }
        Ok(KeyValue::Points(points))
    }

    fn no_list(&self) -> Result<KeyValue, Misfit> {
        misfit(format!("`{}` must be a list of numbers", self.path), Some(self.example()))
    }

    fn word(&self, scalar: &Scalar, words: &[&str]) -> Result<KeyValue, Misfit> {
        let list = words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ");
        match scalar {
            Scalar::Text(text) => position(words, text).map(KeyValue::Word).ok_or_else(|| {
                let near = similar(text, words.iter().copied());
                let near = near.map_or(String::new(), |word| format!("did you mean \"{word}\"? It is "));
                let message = format!("`{}` cannot be \"{}\"", self.path, shown(text, MOST_QUOTED));
                Misfit { message, help: Some(format!("{near}one of {list}")) }
            }),
            _ => misfit(format!("`{}` must be a word", self.path), Some(format!("one of {list}"))),
        }
    }

    /// A quantity, or one of a few words instead.
    fn quantity(
        &self,
        scalar: &Scalar,
        words: &[&str],
        dimension: Dimension,
        bounds: Bounds,
    ) -> Result<KeyValue, Misfit> {
        let or_words = words.iter().map(|word| format!(" or \"{word}\"")).collect::<Vec<_>>().concat();
        let text = match scalar {
            Scalar::Text(text) => text,
            Scalar::Number(text) => {
                let error = QuantityError::MissingUnit { found: text.clone() };
                return self.not_a_quantity(&[dimension], &error, &or_words);
            }
            other => {
                let kind = other.kind();
                return misfit(
                    format!("`{}` must be a quantity of {dimension}{or_words}, not {kind}", self.path),
                    None,
                );
            }
        };
        match position(words, text) {
            Some(index) => Ok(KeyValue::Word(index)),
            None => self.quantity_text(text, dimension, bounds, &or_words).map(KeyValue::Number),
        }
    }

    fn quantity_text(&self, text: &str, dimension: Dimension, bounds: Bounds, or_words: &str) -> Result<f64, Misfit> {
        // The sign of a diameter belongs to a key for one.
        let text = match text.trim().strip_prefix(['Ø', 'ø', '⌀']) {
            Some(diameter) if self.key.halved.is_some() || self.key.name.contains("diameter") => diameter,
            Some(_) if dimension == Dimension::Length => {
                let message = format!("`{}`: `{}` is a diameter", self.path, shown(text.trim(), MOST_QUOTED));
                return misfit(message, Some("give it without Ø, or give the key of the diameter".into()));
            }
            _ => text,
        };
        match units::parse(text, dimension) {
            Ok(quantity) if bounds.holds(quantity.si) => Ok(quantity.si),
            Ok(quantity) => {
                let limit = bounds.broken(quantity.si, |v| quantity.in_same_unit(v));
                misfit(format!("`{}` must be {limit}: {}", self.path, shown(text.trim(), MOST_QUOTED)), self.hint())
            }
            Err(error) => self.not_a_quantity(&[dimension], &error, or_words),
        }
    }

    fn not_a_quantity<T>(&self, dimensions: &[Dimension], error: &QuantityError, or_words: &str) -> Result<T, Misfit> {
        let path = self.path;
        let kinds = dimensions.iter().map(Dimension::to_string).collect::<Vec<_>>().join(" or ");
        let units = dimensions.iter().map(|dimension| dimension.unit_list()).collect::<Vec<_>>().join(", ");
        let article = if kinds.starts_with('a') { "an" } else { "a" };
        let help = format!("`{path}` is {article} {kinds}: a number and one of {units}{or_words}");
        misfit(format!("`{path}`: {error}"), Some(help))
    }

    fn length_or_angle(&self, scalar: &Scalar, length: Bounds, angle: Bounds) -> Result<KeyValue, Misfit> {
        let found = self.of_two(scalar, [(Dimension::Length, length), (Dimension::Angle, angle)])?;
        Ok(length_or_angle(found))
    }

    fn angle_or_length(&self, scalar: &Scalar, angle: Bounds, length: Bounds) -> Result<KeyValue, Misfit> {
        let found = self.of_two(scalar, [(Dimension::Angle, angle), (Dimension::Length, length)])?;
        Ok(length_or_angle(found))
    }

    /// A length or an angle, or a share with its sign, `1 %`.
    fn length_angle_or_share(
        &self,
        scalar: &Scalar,
        length: Bounds,
        angle: Bounds,
        bounds: Bounds,
    ) -> Result<KeyValue, Misfit> {
        let typed = if let Scalar::Text(text) = scalar { text.trim().strip_suffix('%') } else { None };
        let Some(typed) = typed else {
            return self.length_or_angle(scalar, length, angle).map_err(|fault| Misfit {
                help: fault.help.map(|help| format!("{help}; or a share of it, such as \"1 %\"")),
                ..fault
            });
        };
        match units::parse_bare(typed) {
            Ok(percent) if bounds.holds(0.01 * percent) => Ok(KeyValue::Share(0.01 * percent)),
            Ok(percent) => {
                let limit = bounds.broken(0.01 * percent, |share| format!("{} %", 100.0 * share));
                misfit(format!("`{}` must be {limit}: {percent} %", self.path), self.hint())
            }
            Err(error) => misfit(format!("`{}`: {error}", self.path), Some(self.example())),
        }
    }

    fn either(&self, scalar: &Scalar, first: BoundedDimension, second: BoundedDimension) -> Result<KeyValue, Misfit> {
        let (dimension, number) = self.of_two(scalar, [first, second])?;
        Ok(KeyValue::Either(dimension, number))
    }

    /// A quantity of one of two kinds: which one, and its number.
    fn of_two(&self, scalar: &Scalar, [first, second]: [BoundedDimension; 2]) -> Result<(Dimension, f64), Misfit> {
        let both = [first.0, second.0];
        let text = match scalar {
            Scalar::Text(text) => text,
            Scalar::Number(text) => {
                return self.not_a_quantity(&both, &QuantityError::MissingUnit { found: text.clone() }, "");
            }
            other => {
                let kind = other.kind();
                let article = if first.0 == Dimension::Angle { "an" } else { "a" };
                let message = format!("`{}` must be {article} {} or {}, not {kind}", self.path, first.0, second.0);
                return misfit(message, None);
            }
        };
        let (dimension, bounds) = match units::parse(text, first.0) {
            Err(_) if units::parse(text, second.0).is_ok() => second,
            Err(QuantityError::WrongKind { found, .. }) if found == second.0 => second,
            Err(error) => return self.not_a_quantity(&both, &error, ""),
            Ok(_) => first,
        };
        Ok((dimension, self.quantity_text(text, dimension, bounds, "")?))
    }

    fn band(&self, scalar: &Scalar, dimension: Dimension, bounds: Bounds) -> Result<KeyValue, Misfit> {
        let text = if let Scalar::Text(text) = scalar { text.as_str() } else { "" };
        let Some((low, high)) = text.split_once("..") else {
            let help = format!("two quantities of {dimension}, {}", self.example());
            return misfit(format!("`{}` must be a range", self.path), Some(help));
        };
        let low = self.quantity_text(low, dimension, bounds, "")?;
        let high = self.quantity_text(high, dimension, bounds, "")?;
        if low >= high {
            let text = shown(text, MOST_QUOTED);
            let message = format!("`{}` must go from the smaller to the larger value: {text}", self.path);
            return misfit(message, None);
        }
        Ok(KeyValue::Band(low, high))
    }
}

/// A quantity that is one of both.
fn length_or_angle((dimension, value): (Dimension, f64)) -> KeyValue {
    KeyValue::LengthOrAngle(match dimension {
        Dimension::Angle => LengthOrAngle::Angle(value),
        _ => LengthOrAngle::Length(value),
    })
}

/// The points of a text such as `[[0 deg, 0 mm], [90 deg, 12 mm]]`.
fn points_of_flag(text: &str) -> Vec<Scalar> {
    let points = text.trim().trim_start_matches('[').trim_end_matches(']').split(']');
    let points = points.map(|point| point.trim().trim_start_matches(',').trim().trim_start_matches('['));
    let points = points.map(|point| {
        Scalar::List(point.split(',').map(|text| Scalar::Text(text.trim().trim_matches('"').to_owned())).collect())
    });
    points.collect()
}

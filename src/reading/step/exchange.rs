//! The exchange structure of ISO 10303-21 ("part 21"): the instances of the data section, by their numbers.
//!
//! What instances mean is not known here. Sizes, counts and depths are bounded, so that no file can exhaust the reader.

use std::collections::BTreeMap;

/// Nested lists deeper than this hold nothing that a solid needs.
const DEEPEST: usize = 64;
/// More values than these are no cam; they would fill the memory.
const MOST_VALUES: usize = 4_000_000;
/// The same of instances.
const MOST_INSTANCES: usize = 1_000_000;
/// Digits of the longest number that is read.
const LONGEST_NUMBER: usize = 400;

/// Characters of the longest word that is read: no name of an entity has half as many.
const LONGEST_WORD: usize = 200;

/// Why a file is not an exchange structure.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("not a STEP file: line {line}: {what}")]
pub struct StepError {
    /// Line of the file, counted from 1.
    pub line: usize,
    /// What is wrong there, and what would be right.
    pub what: String,
}

/// A parameter of an entity.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    /// `#17`
    Reference(u64),
    /// A whole or a real number.
    Number(f64),
    /// `'text'`, as it stands in the file.
    Text(String),
    /// `.NAME.`
    Name(String),
    /// `$` or `*`
    Nothing,
    /// `(…)`
    List(Vec<Value>),
    /// `LENGTH_MEASURE(25.4)`
    Typed(String, Vec<Value>),
}

/// An instance: one entity, or the parts of a complex one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Instance {
    /// Line on which it begins.
    pub(super) line: usize,
    /// Keyword and parameters of every part.
    pub(super) parts: Vec<(String, Vec<Value>)>,
}

/// The instances of a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Exchange {
    pub(super) instances: BTreeMap<u64, Instance>,
}

#[derive(Debug, Clone, PartialEq)]
enum Token {
    Word(String),
    Reference(u64),
    Number(f64),
    Text(String),
    Name(String),
    Sign(u8),
    End,
}

struct Scanner<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    /// Values read so far.
    count: usize,
}

impl Scanner<'_> {
    fn error(&self, what: impl Into<String>) -> StepError {
        StepError { line: self.line, what: what.into() }
    }

    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn step(&mut self) {
        if self.peek() == Some(b'\n') {
            self.line += 1;
        }
        self.at += 1;
    }

    /// Past blanks, comments and the directives of a printed page.
    fn skip(&mut self) -> Result<(), StepError> {
        while let Some(byte) = self.peek() {
            let rest = self.bytes.get(self.at..).unwrap_or_default();
            if byte.is_ascii_whitespace() || byte == 0 {
                self.step();
            } else if rest.starts_with(b"/*") {
                let from = self.line;
                self.at += 2;
                while !self.bytes.get(self.at..).unwrap_or_default().starts_with(b"*/") {
                    if self.peek().is_none() {
                        return Err(StepError { line: from, what: "a comment has no end".into() });
                    }
                    self.step();
                }
                self.at += 2;
            } else if rest.starts_with(b"\\N\\") || rest.starts_with(b"\\F\\") {
                self.at += 3;
            } else {
                break;
            }
        }
        Ok(())
    }

    fn run(&mut self, fits: impl Fn(u8) -> bool) -> String {
        let from = self.at;
        while self.peek().is_some_and(&fits) {
            self.at += 1;
        }
        String::from_utf8_lossy(self.bytes.get(from..self.at).unwrap_or_default()).to_ascii_uppercase()
    }

    /// A word of the language, which is never long.
    fn word(&mut self, fits: impl Fn(u8) -> bool) -> Result<String, StepError> {
        let word = self.run(fits);
        if word.len() > LONGEST_WORD {
            return Err(self.error(format!("a word of more than {LONGEST_WORD} characters")));
        }
        Ok(word)
    }

    fn next(&mut self) -> Result<Token, StepError> {
        self.skip()?;
        let Some(byte) = self.peek() else { return Ok(Token::End) };
        match byte {
            b'#' => {
                self.at += 1;
                let digits = self.run(|b| b.is_ascii_digit());
                digits.parse().map(Token::Reference).map_err(|_| self.error("a `#` without a number after it"))
            }
            b'\'' => self.text(),
            b'"' => {
                self.at += 1;
                let digits = self.run(|b| b.is_ascii_hexdigit());
                if self.peek() != Some(b'"') {
                    return Err(self.error("a binary value has no end"));
                }
                self.at += 1;
                Ok(Token::Text(digits))
            }
            b'.' => {
                self.at += 1;
                let name = self.word(|b| b.is_ascii_alphanumeric() || b == b'_')?;
                if self.peek() != Some(b'.') {
                    return Err(self.error(format!("`.{name}` has no dot at its end")));
                }
                self.at += 1;
                Ok(Token::Name(name))
            }
            b'+' | b'-' | b'0'..=b'9' => self.number(),
            b'A'..=b'Z' | b'a'..=b'z' | b'_' | b'!' => {
                self.at += 1;
                let first = char::from(byte).to_ascii_uppercase();
                let rest = self.word(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'-')?;
                Ok(Token::Word(format!("{first}{rest}")))
            }
            b'(' | b')' | b',' | b';' | b'=' | b'$' | b'*' | b'{' | b'}' => {
                self.at += 1;
                Ok(Token::Sign(byte))
            }
            other => {
                Err(self.error(format!("the character `{}` has no place here", char::from(other).escape_default())))
            }
        }
    }

    fn number(&mut self) -> Result<Token, StepError> {
        let text = self.run(|b| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'E' | b'e'));
        let value = if text.len() > LONGEST_NUMBER { None } else { text.parse::<f64>().ok() };
        match value.filter(|value| value.is_finite()) {
            Some(value) => Ok(Token::Number(value)),
            None => Err(self.error(format!("`{}` is not a number", text.chars().take(40).collect::<String>()))),
        }
    }

    /// A text, its doubled apostrophes made single; its escapes stay as they are.
    fn text(&mut self) -> Result<Token, StepError> {
        let from = self.line;
        self.at += 1;
        let mut text = Vec::new();
        loop {
            match self.peek() {
                None => return Err(StepError { line: from, what: "a text has no end".into() }),
                Some(b'\'') if self.bytes.get(self.at + 1) == Some(&b'\'') => {
                    text.push(b'\'');
                    self.at += 2;
                }
                Some(b'\'') => {
                    self.at += 1;
                    return Ok(Token::Text(String::from_utf8_lossy(&text).into_owned()));
                }
                Some(byte) => {
                    text.push(byte);
                    self.step();
                }
            }
        }
    }

    fn expect(&mut self, sign: u8) -> Result<(), StepError> {
        match self.next()? {
            Token::Sign(found) if found == sign => Ok(()),
            other => Err(self.error(format!("`{}` is missing before {}", char::from(sign), told(&other)))),
        }
    }

    /// The values up to the closing parenthesis; the opening one has been read.
    fn values(&mut self, depth: usize) -> Result<Vec<Value>, StepError> {
        if depth > DEEPEST {
            return Err(self.error(format!("lists nested deeper than {DEEPEST}")));
        }
        let mut values = Vec::new();
        let mut token = self.next()?;
        if token == Token::Sign(b')') {
            return Ok(values);
        }
        loop {
            self.count += 1;
            if self.count > MOST_VALUES {
                return Err(self.error(format!("more than {MOST_VALUES} values")));
            }
            values.push(match token {
                Token::Reference(number) => Value::Reference(number),
                Token::Number(value) => Value::Number(value),
                Token::Text(text) => Value::Text(text),
                Token::Name(name) => Value::Name(name),
                Token::Sign(b'$' | b'*') => Value::Nothing,
                Token::Sign(b'(') => Value::List(self.values(depth + 1)?),
                Token::Word(word) => {
                    self.expect(b'(')?;
                    Value::Typed(word, self.values(depth + 1)?)
                }
                other => return Err(self.error(format!("{} where a value is due", told(&other)))),
            });
            match self.next()? {
                Token::Sign(b',') => token = self.next()?,
                Token::Sign(b')') => return Ok(values),
                other => return Err(self.error(format!("{} where `,` or `)` is due", told(&other)))),
            }
        }
    }

    /// The right side of an instance, up to its semicolon.
    fn parts(&mut self) -> Result<Vec<(String, Vec<Value>)>, StepError> {
        let mut parts = Vec::new();
        match self.next()? {
            Token::Word(word) => {
                self.expect(b'(')?;
                parts.push((word, self.values(0)?));
            }
            Token::Sign(b'(') => loop {
                match self.next()? {
                    Token::Word(word) => {
                        self.expect(b'(')?;
                        parts.push((word, self.values(0)?));
                    }
                    Token::Sign(b')') => break,
                    other => return Err(self.error(format!("{} within a complex entity", told(&other)))),
                }
            },
            other => return Err(self.error(format!("{} where an entity is due", told(&other)))),
        }
        self.expect(b';')?;
        Ok(parts)
    }

    /// Past everything up to and including a word and its semicolon.
    fn past(&mut self, word: &str) -> Result<(), StepError> {
        loop {
            match self.next()? {
                Token::End => return Err(self.error(format!("the file ends before `{word};`"))),
                Token::Word(found) if found == word => return self.expect(b';'),
                _ => {}
            }
        }
    }

    fn data(&mut self, exchange: &mut Exchange) -> Result<(), StepError> {
        loop {
            match self.next()? {
                Token::Word(word) if word == "ENDSEC" => return self.expect(b';'),
                Token::Reference(number) => {
                    let line = self.line;
                    if exchange.instances.len() >= MOST_INSTANCES {
                        return Err(self.error(format!("more than {MOST_INSTANCES} instances")));
                    }
                    self.expect(b'=')?;
                    let instance = Instance { line, parts: self.parts()? };
                    if exchange.instances.insert(number, instance).is_some() {
                        return Err(StepError { line, what: format!("#{number} is defined twice") });
                    }
                }
                other => return Err(self.error(format!("{} where an instance is due", told(&other)))),
            }
        }
    }
}

/// A token for a person.
fn told(token: &Token) -> String {
    match token {
        Token::Word(word) => format!("`{word}`"),
        Token::Reference(number) => format!("`#{number}`"),
        Token::Number(value) => format!("`{value}`"),
        Token::Text(_) => "a text".into(),
        Token::Name(name) => format!("`.{name}.`"),
        Token::Sign(sign) => format!("`{}`", char::from(*sign)),
        Token::End => "the end of the file".into(),
    }
}

/// Reads the data of a file.
pub(super) fn read(bytes: &[u8]) -> Result<Exchange, StepError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut scanner = Scanner { bytes, at: 0, line: 1, count: 0 };
    match scanner.next()? {
        Token::Word(word) if word == "ISO-10303-21" => scanner.expect(b';')?,
        _ => return Err(scanner.error("a STEP file begins with `ISO-10303-21;`")),
    }
    let mut exchange = Exchange::default();
    loop {
        match scanner.next()? {
            Token::Word(word) if word == "END-ISO-10303-21" => {
                scanner.expect(b';')?;
                return Ok(exchange);
            }
            Token::Word(word) if word == "DATA" => {
                // A data section of edition 2 may have parameters.
                match scanner.next()? {
                    Token::Sign(b';') => {}
                    Token::Sign(b'(') => {
                        scanner.values(0)?;
                        scanner.expect(b';')?;
                    }
                    other => return Err(scanner.error(format!("{} after `DATA`", told(&other)))),
                }
                scanner.data(&mut exchange)?;
            }
            Token::Word(word) if ["HEADER", "ANCHOR", "REFERENCE", "SIGNATURE"].contains(&word.as_str()) => {
                scanner.expect(b';')?;
                scanner.past("ENDSEC")?;
            }
            Token::End => return Err(scanner.error("the file is cut short: it does not end with `END-ISO-10303-21;`")),
            other => return Err(scanner.error(format!("{} where a section is due", told(&other)))),
        }
    }
}

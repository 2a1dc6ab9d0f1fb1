//! The exchange structure of ISO 10303-21 ("part 21"): the instances of the data section, by their numbers.
//!
//! The meaning of instances is not known here. Sizes, counts and depths are bounded, so that a file cannot exhaust the reader. What other
//! readers take for something else, or not at all, is refused.

use camgen_kernel::document::shown;
use camgen_kernel::refusal::Refusal;
use std::collections::BTreeMap;
use std::fmt::Display;

/// A solid needs no lists nested deeper than this.
const DEEPEST: usize = 64;
/// No cam has more values than these; they would fill the memory.
const MOST_VALUES: usize = 4_000_000;
/// No cam has more instances than these.
const MOST_INSTANCES: usize = 1_000_000;
/// Digits of the longest number that is read.
const LONGEST_NUMBER: usize = 400;

/// Characters of the longest word that is read: names of entities have less than half as many.
const LONGEST_WORD: usize = 200;
/// Characters of the longest text, and of the longest line of a comment: OpenCASCADE reads no longer ones.
const LONGEST_TEXT: usize = 16_000;
/// Characters of a name that are shown.
const LONGEST_NAME: usize = 40;
/// Largest number of an instance: others keep it in 32 bits.
const LARGEST_REFERENCE: u64 = i32::MAX as u64;
/// The schemas with solids as they are read here, by the beginnings of their names: AP203, AP214 and AP242.
const SCHEMAS: [&str; 5] = ["CONFIG_CONTROL", "AP203", "AUTOMOTIVE_DESIGN", "AP214", "AP242"];

/// A parameter of an entity.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum StepValue {
    /// `#17`
    Reference(u64),
    /// A whole or a real number.
    Number(f64),
    /// `'text'`, unchanged.
    Text(String),
    /// `.NAME.`
    Name(String),
    /// `$` or `*`
    Nothing,
    /// `(…)`
    List(Vec<StepValue>),
    /// `LENGTH_MEASURE(25.4)`
    Typed(String, Vec<StepValue>),
}

/// An instance: one entity, or the parts of a complex one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StepInstance {
    /// Line on which it begins.
    pub(super) line: usize,
    /// Keyword and parameters of every part.
    pub(super) parts: Vec<(String, Vec<StepValue>)>,
}

/// The instances of a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct ExchangeData {
    pub(super) instances: BTreeMap<u64, StepInstance>,
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
    fn error(&self, what: impl Display) -> Refusal {
        not_step(self.line, what)
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

    /// Skips blanks, comments and the directives of a printed page.
    fn skip(&mut self) -> Result<(), Refusal> {
        while let Some(byte) = self.peek() {
            let rest = self.bytes.get(self.at..).unwrap_or_default();
            // Some systems end a text with 0 or 26.
            if byte.is_ascii_whitespace() || matches!(byte, 0 | 26) {
                self.step();
            } else if rest.starts_with(b"/*") {
                self.comment()?;
            } else if rest.starts_with(b"\\N\\") || rest.starts_with(b"\\F\\") {
                self.at += 3;
            } else {
                break;
            }
        }
        Ok(())
    }

    fn comment(&mut self) -> Result<(), Refusal> {
        let (from, mut begin) = (self.line, self.at);
        self.at += 2;
        while !self.bytes.get(self.at..).unwrap_or_default().starts_with(b"*/") {
            match self.peek() {
                None => return Err(not_step(from, "a comment has no end")),
                Some(b'\n') => begin = self.at,
                Some(_) => {}
            }
            if self.at - begin > LONGEST_TEXT {
                return Err(self.error(format!("a line of a comment has more than {LONGEST_TEXT} characters")));
            }
            self.step();
        }
        self.at += 2;
        Ok(())
    }

    fn run(&mut self, fits: impl Fn(u8) -> bool) -> String {
        let from = self.at;
        while self.peek().is_some_and(&fits) {
            self.at += 1;
        }
        String::from_utf8_lossy(self.bytes.get(from..self.at).unwrap_or_default()).into_owned()
    }

    /// A word of the language, of bounded length and in capitals: other readers do not know it in small letters, or in part.
    fn word(&mut self, fits: impl Fn(u8) -> bool) -> Result<String, Refusal> {
        let word = self.run(fits);
        if word.len() > LONGEST_WORD {
            return Err(self.error(format!("a word of more than {LONGEST_WORD} characters")));
        }
        if word.bytes().any(|byte| byte.is_ascii_lowercase()) {
            return Err(self.error(format!("`{word}` has small letters; the words of a STEP file are in capitals")));
        }
        // A word of one's own is a mark and a word; that of a name has no mark.
        let plain = word.strip_prefix('!').unwrap_or(&word);
        if plain.contains('!') || word == "!" {
            return Err(self.error(format!("`{word}` is not a word: `!` begins a word of one's own")));
        }
        Ok(word)
    }

    fn next(&mut self) -> Result<Token, Refusal> {
        self.skip()?;
        let Some(byte) = self.peek() else { return Ok(Token::End) };
        match byte {
            b'#' => {
                self.at += 1;
                let digits = self.run(|b| b.is_ascii_digit());
                let number = digits.parse().map_err(|_| self.error("a `#` without a number after it"))?;
                if (1..=LARGEST_REFERENCE).contains(&number) {
                    Ok(Token::Reference(number))
                } else {
                    Err(self.error(format!("`#{number}` is not between #1 and #{LARGEST_REFERENCE}")))
                }
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
                let word = self.word(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'-' | b'!'))?;
                Ok(Token::Word(word))
            }
            b'(' | b')' | b',' | b';' | b'=' | b'$' | b'*' | b'{' | b'}' => {
                self.at += 1;
                Ok(Token::Sign(byte))
            }
            other => {
                Err(self.error(format!("the character `{}` is not allowed here", char::from(other).escape_default())))
            }
        }
    }

    fn number(&mut self) -> Result<Token, Refusal> {
        let text = self.run(|b| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'E' | b'e'));
        // In part 21 a number with an exponent has a decimal point: without it others read two numbers.
        let is_whole = !text.contains(['E', 'e']) || text.contains('.');
        let value = if text.len() > LONGEST_NUMBER || !is_whole { None } else { text.parse::<f64>().ok() };
        match value.filter(|value| value.is_finite()) {
            Some(value) => Ok(Token::Number(value)),
            None => Err(self.error(format!("`{}` is not a number", text.chars().take(40).collect::<String>()))),
        }
    }

    /// A text with doubled apostrophes made single; its escapes are left unchanged.
    fn text(&mut self) -> Result<Token, Refusal> {
        let from = self.line;
        self.at += 1;
        let mut text = Vec::new();
        loop {
            if text.len() > LONGEST_TEXT {
                return Err(not_step(from, format_args!("a text of more than {LONGEST_TEXT} characters")));
            }
            match self.peek() {
                None => return Err(not_step(from, "a text has no end")),
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

    fn expect(&mut self, sign: u8) -> Result<(), Refusal> {
        match self.next()? {
            Token::Sign(found) if found == sign => Ok(()),
            other => Err(self.error(format!("`{}` is missing before {}", char::from(sign), token_text(&other)))),
        }
    }

    /// The values up to the closing parenthesis; the opening one has been read.
    fn values(&mut self, depth: usize) -> Result<Vec<StepValue>, Refusal> {
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
                Token::Reference(number) => StepValue::Reference(number),
                Token::Number(value) => StepValue::Number(value),
                Token::Text(text) => StepValue::Text(text),
                Token::Name(name) => StepValue::Name(name),
                Token::Sign(b'$' | b'*') => StepValue::Nothing,
                Token::Sign(b'(') => StepValue::List(self.values(depth + 1)?),
                Token::Word(word) => {
                    self.expect(b'(')?;
                    StepValue::Typed(word, self.values(depth + 1)?)
                }
                other => return Err(self.error(format!("found {}, expected a value", token_text(&other)))),
            });
            match self.next()? {
                Token::Sign(b',') => token = self.next()?,
                Token::Sign(b')') => return Ok(values),
                other => return Err(self.error(format!("found {}, expected `,` or `)`", token_text(&other)))),
            }
        }
    }

    /// The right side of an instance, up to its semicolon.
    fn parts(&mut self) -> Result<Vec<(String, Vec<StepValue>)>, Refusal> {
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
                    other => return Err(self.error(format!("found {} in a complex entity", token_text(&other)))),
                }
            },
            other => return Err(self.error(format!("found {}, expected an entity", token_text(&other)))),
        }
        self.expect(b';')?;
        Ok(parts)
    }

    /// The values of an entity in the rest of a section, which is skipped up to and including its end.
    fn section(&mut self, entity: &str) -> Result<Option<Vec<StepValue>>, Refusal> {
        let mut found = None;
        loop {
            match self.next()? {
                Token::End => return Err(self.error("the file ends before `ENDSEC;`")),
                Token::Word(word) if word == "ENDSEC" => return self.expect(b';').map(|()| found),
                Token::Word(word) if word == entity && found.is_none() => {
                    self.expect(b'(')?;
                    found = Some(self.values(0)?);
                }
                _ => {}
            }
        }
    }

    /// The header, up to and including its end; refuses a file of a schema that has other solids.
    fn header(&mut self) -> Result<(), Refusal> {
        self.expect(b';')?;
        let named = self.section("FILE_SCHEMA")?.unwrap_or_default();
        let texts = |value: &StepValue| match value {
            StepValue::List(values) => values.clone(),
            _ => Vec::new(),
        };
        let names: Vec<String> = named.iter().flat_map(texts).filter_map(|value| value.text()).collect();
        if names.iter().any(|name| SCHEMAS.iter().any(|known| name.starts_with(known))) {
            return Ok(());
        }
        let named = names.first().map_or("none".into(), |name| format!("`{}`", shown(name, LONGEST_NAME)));
        Err(Refusal::new(format!("not a STEP file of a part: its schema is {named}"))
            .remedy("write the part as STEP AP203, AP214 or AP242"))
    }

    /// Refuses whatever follows the end of the file: another file, which others may read or not.
    fn finished(&mut self) -> Result<(), Refusal> {
        match self.next()? {
            Token::End => Ok(()),
            other => {
                Err(self.error(format!("found {} after the end of the file, `END-ISO-10303-21;`", token_text(&other))))
            }
        }
    }

    fn data(&mut self, exchange: &mut ExchangeData) -> Result<(), Refusal> {
        loop {
            match self.next()? {
                Token::Word(word) if word == "ENDSEC" => return self.expect(b';'),
                Token::Reference(number) => {
                    let line = self.line;
                    if exchange.instances.len() >= MOST_INSTANCES {
                        return Err(self.error(format!("more than {MOST_INSTANCES} instances")));
                    }
                    // Others know an instance by a number with `=` behind it on the same line.
                    while matches!(self.peek(), Some(b' ' | b'\t')) {
                        self.at += 1;
                    }
                    if self.peek() != Some(b'=') {
                        return Err(self.error(format!("`=` is missing behind `#{number}` on the same line")));
                    }
                    self.expect(b'=')?;
                    let instance = StepInstance { line, parts: self.parts()? };
                    if exchange.instances.insert(number, instance).is_some() {
                        return Err(not_step(line, format_args!("#{number} is defined twice")));
                    }
                }
                other => return Err(self.error(format!("found {}, expected an instance", token_text(&other)))),
            }
        }
    }
}

/// That a file is not an exchange structure, with what is wrong on a line, from 1.
fn not_step(line: usize, what: impl Display) -> Refusal {
    Refusal::new(format!("not a STEP file: {what}")).at(format!("line {line}"))
}

/// A token for a message.
fn token_text(token: &Token) -> String {
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

impl StepValue {
    /// A text in capitals.
    fn text(&self) -> Option<String> {
        match self {
            Self::Text(text) => Some(text.trim().to_ascii_uppercase()),
            _ => None,
        }
    }
}

/// Reads the data of a file.
pub(super) fn read(bytes: &[u8]) -> Result<ExchangeData, Refusal> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut scanner = Scanner { bytes, at: 0, line: 1, count: 0 };
    match scanner.next()? {
        Token::Word(word) if word == "ISO-10303-21" => scanner.expect(b';')?,
        _ => return Err(scanner.error("it does not begin with `ISO-10303-21;`")),
    }
    match scanner.next()? {
        Token::Word(word) if word == "HEADER" => scanner.header()?,
        other => return Err(scanner.error(format!("found {}, expected `HEADER;`", token_text(&other)))),
    }
    let mut exchange = ExchangeData::default();
    loop {
        match scanner.next()? {
            Token::Word(word) if word == "END-ISO-10303-21" => {
                scanner.expect(b';')?;
                return scanner.finished().map(|()| exchange);
            }
            Token::Word(word) if word == "DATA" => {
                // A data section of edition 2 may have parameters.
                match scanner.next()? {
                    Token::Sign(b';') => {}
                    Token::Sign(b'(') => {
                        scanner.values(0)?;
                        scanner.expect(b';')?;
                    }
                    other => return Err(scanner.error(format!("found {} after `DATA`", token_text(&other)))),
                }
                scanner.data(&mut exchange)?;
            }
            Token::Word(word) if ["ANCHOR", "REFERENCE", "SIGNATURE"].contains(&word.as_str()) => {
                scanner.expect(b';')?;
                scanner.section("")?;
            }
            Token::End => return Err(scanner.error("the file is incomplete: it does not end with `END-ISO-10303-21;`")),
            other => return Err(scanner.error(format!("found {}, expected a section", token_text(&other)))),
        }
    }
}

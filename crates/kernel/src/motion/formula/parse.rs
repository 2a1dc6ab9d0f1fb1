//! The text of a formula to its tape: a parser by recursive descent, of bounded depth.
//!
//! ```text
//! sum     = product { ("+" | "-") product }
//! product = signed { ("*" | "/") signed }
//! signed  = ("+" | "-") signed | power
//! power   = atom [ "^" signed ]
//! atom    = number | "pi" | "e" | variable | function "(" sum ")" | "(" sum ")"
//! ```

use super::{FormulaError, FormulaTape, LONGEST};
use crate::document::similar;
use crate::numeric::series::tape::{ElementaryFunction, TapeOperation, TapeTerm};

/// Deepest nesting of parentheses, signs and powers.
const DEEPEST: u32 = 100;
/// Most operations: with the length and the depth it bounds the time of an evaluation.
const MOST_OPERATIONS: usize = 3000;
/// Largest whole exponent that is done by multiplying.
const LARGEST_WHOLE: f64 = 1024.0;

const FUNCTIONS: &[(&str, ElementaryFunction)] = &[
    ("sin", ElementaryFunction::Sine),
    ("cos", ElementaryFunction::Cosine),
    ("tan", ElementaryFunction::Tangent),
    ("asin", ElementaryFunction::ArcSine),
    ("acos", ElementaryFunction::ArcCosine),
    ("atan", ElementaryFunction::ArcTangent),
    ("sqrt", ElementaryFunction::Power(0.5)),
    ("exp", ElementaryFunction::Exponential),
    ("log", ElementaryFunction::Logarithm),
];

const CONSTANTS: &[(&str, f64)] = &[("pi", std::f64::consts::PI), ("e", std::f64::consts::E)];

pub(super) fn parse(text: &str, variable: &str) -> Result<FormulaTape, FormulaError> {
    let characters: Vec<char> = text.chars().take(LONGEST + 1).collect();
    let mut parser = Parser { characters: &characters, at: 0, depth: 0, variable, text: FormulaTape::default() };
    if characters.len() > LONGEST {
        return Err(FormulaError {
            at: LONGEST + 1,
            message: format!("a formula has at most {LONGEST} characters"),
            help: None,
        });
    }
    let value = parser.sum()?;
    if let Some(left) = parser.peek() {
        return Err(parser.unexpected(left));
    }
    parser.text.tape.result = Some(value);
    Ok(parser.text)
}

struct Parser<'a> {
    characters: &'a [char],
    at: usize,
    depth: u32,
    variable: &'a str,
    text: FormulaTape,
}

impl Parser<'_> {
    /// The next character that is not blank.
    fn peek(&mut self) -> Option<char> {
        while self.characters.get(self.at).is_some_and(|next| next.is_whitespace()) {
            self.at += 1;
        }
        self.characters.get(self.at).copied()
    }

    /// Takes one of two signs, and gives its character.
    fn either(&mut self, signs: [char; 2]) -> Option<(char, usize)> {
        let found = self.peek().filter(|next| signs.contains(next))?;
        self.at += 1;
        Some((found, self.at))
    }

    fn fault<T>(&self, at: usize, message: String, help: Option<String>) -> Result<T, FormulaError> {
        Err(FormulaError { at: at.min(self.characters.len() + 1), message, help })
    }

    fn unexpected(&self, found: char) -> FormulaError {
        let help = match found {
            ')' => "this parenthesis was not opened".to_owned(),
            ',' => "write decimals with a point: 1.5".to_owned(),
            '=' => "write only the value, without `=`".to_owned(),
            '(' => "write products with `*`".to_owned(),
            found if found.is_alphanumeric() || found == '.' => "write products with `*`".to_owned(),
            _ => "a formula consists of + - * / ^ ( ), numbers and names".to_owned(),
        };
        FormulaError { at: self.at + 1, message: format!("`{found}` does not belong here"), help: Some(help) }
    }

    /// Something within, one level deeper.
    fn deeper<T>(&mut self, within: impl FnOnce(&mut Self) -> Result<T, FormulaError>) -> Result<T, FormulaError> {
        if self.depth >= DEEPEST {
            let help = Some("write it with fewer parentheses and signs".into());
            return self.fault(self.at + 1, format!("nested deeper than {DEEPEST}"), help);
        }
        self.depth += 1;
        let found = within(self);
        self.depth -= 1;
        found
    }

    /// An operation; one on constants is done at once.
    fn push(&mut self, operation: TapeOperation, at: usize) -> Result<TapeTerm, FormulaError> {
        let tape = &mut self.text.tape;
        if tape.operations.len() >= MOST_OPERATIONS {
            return self.fault(at, format!("more than {MOST_OPERATIONS} operations"), None);
        }
        let known = operation.arguments().iter().all(|term| term.is_none_or(|term| tape.constant(term).is_some()))
            && operation != TapeOperation::Abscissa;
        let term = tape.push(operation);
        self.text.characters.push(at);
        if !known || matches!(operation, TapeOperation::Constant(_)) {
            return Ok(term);
        }
        let value = tape.rows(0.0, 1).series(term).first().copied().unwrap_or(f64::NAN);
        if !value.is_finite() {
            return self.fault(at, "this has no finite value".into(), None);
        }
        if let Some(last) = tape.operations.last_mut() {
            *last = TapeOperation::Constant(value);
        }
        Ok(term)
    }

    fn sum(&mut self) -> Result<TapeTerm, FormulaError> {
        let mut value = self.product()?;
        while let Some((sign, at)) = self.either(['+', '-']) {
            let next = self.product()?;
            let operation =
                if sign == '+' { TapeOperation::Sum(value, next) } else { TapeOperation::Difference(value, next) };
            value = self.push(operation, at)?;
        }
        Ok(value)
    }

    fn product(&mut self) -> Result<TapeTerm, FormulaError> {
        let mut value = self.signed()?;
        while let Some((sign, at)) = self.either(['*', '/']) {
            if sign == '*' && self.peek() == Some('*') {
                return self.fault(self.at + 1, "`**` is not an operator".into(), Some("write powers with `^`".into()));
            }
            let next = self.signed()?;
            let operation =
                if sign == '*' { TapeOperation::Product(value, next) } else { TapeOperation::Quotient(value, next) };
            value = self.push(operation, at)?;
        }
        Ok(value)
    }

    fn signed(&mut self) -> Result<TapeTerm, FormulaError> {
        let Some((sign, at)) = self.either(['+', '-']) else { return self.power() };
        let value = self.deeper(Self::signed)?;
        if sign == '+' {
            return Ok(value);
        }
        let zero = self.push(TapeOperation::Constant(0.0), at)?;
        self.push(TapeOperation::Difference(zero, value), at)
    }

    fn power(&mut self) -> Result<TapeTerm, FormulaError> {
        let base = self.atom()?;
        let Some((_, at)) = self.either(['^', '^']) else { return Ok(base) };
        let exponent = self.deeper(Self::signed)?;
        match self.text.tape.constant(exponent) {
            Some(whole) if whole.fract() == 0.0 && whole.abs() <= LARGEST_WHOLE => self.whole_power(base, whole, at),
            Some(exponent) => self.push(TapeOperation::Of(ElementaryFunction::Power(exponent), base), at),
            None => {
                let logarithm = self.push(TapeOperation::Of(ElementaryFunction::Logarithm, base), at)?;
                let product = self.push(TapeOperation::Product(exponent, logarithm), at)?;
                self.push(TapeOperation::Of(ElementaryFunction::Exponential, product), at)
            }
        }
    }

    /// A whole power by squares.
    fn whole_power(&mut self, base: TapeTerm, exponent: f64, at: usize) -> Result<TapeTerm, FormulaError> {
        let one = self.push(TapeOperation::Constant(1.0), at)?;
        let (mut left, mut square, mut value) = (exponent.abs(), base, None);
        while left >= 1.0 {
            if left % 2.0 == 1.0 {
                value = Some(match value {
                    None => square,
                    Some(value) => self.push(TapeOperation::Product(value, square), at)?,
                });
            }
            left = (left / 2.0).floor();
            if left >= 1.0 {
                square = self.push(TapeOperation::Product(square, square), at)?;
            }
        }
        let value = value.unwrap_or(one);
        if exponent < 0.0 { self.push(TapeOperation::Quotient(one, value), at) } else { Ok(value) }
    }

    fn atom(&mut self) -> Result<TapeTerm, FormulaError> {
        match self.peek() {
            None => {
                let help = Some(format!("e.g. 10*(1-cos({}))", self.variable));
                self.fault(self.at + 1, "the formula ends where a value is expected".into(), help)
            }
            Some('(') => self.enclosed(),
            Some(next) if next.is_ascii_digit() || next == '.' => self.number(),
            Some(next) if next.is_alphabetic() || next == '_' => self.name(),
            Some(next) => Err(self.unexpected(next)),
        }
    }

    /// A sum in parentheses.
    fn enclosed(&mut self) -> Result<TapeTerm, FormulaError> {
        self.at += 1;
        let open = self.at;
        let value = self.deeper(Self::sum)?;
        match self.peek() {
            Some(')') => {
                self.at += 1;
                Ok(value)
            }
            None => self.fault(open, "the parenthesis opened here is not closed".into(), Some("add `)`".into())),
            Some(other) => Err(self.unexpected(other)),
        }
    }

    fn take_while(&mut self, mut holds: impl FnMut(char) -> bool) -> String {
        let mut taken = String::new();
        while let Some(next) = self.characters.get(self.at).copied().filter(|next| holds(*next)) {
            taken.push(next);
            self.at += 1;
        }
        taken
    }

    fn number(&mut self) -> Result<TapeTerm, FormulaError> {
        let from = self.at + 1;
        let mut text = self.take_while(|next| next.is_ascii_digit() || next == '.');
        // An exponent only where digits follow: `2e` is 2 times e without its `*`.
        let sign = usize::from(matches!(self.characters.get(self.at + 1), Some('+' | '-')));
        let digits = self.characters.get(self.at + 1 + sign).is_some_and(char::is_ascii_digit);
        if matches!(self.characters.get(self.at), Some('e' | 'E')) && digits {
            text.extend(self.characters.get(self.at..=self.at + sign).unwrap_or_default());
            self.at += 1 + sign;
            text.push_str(&self.take_while(|next| next.is_ascii_digit()));
        }
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => self.push(TapeOperation::Constant(value), from),
            _ => self.fault(from, format!("`{text}` is not a number"), None),
        }
    }

    fn name(&mut self) -> Result<TapeTerm, FormulaError> {
        let from = self.at + 1;
        let name = self.take_while(|next| next.is_alphanumeric() || next == '_');
        if name == self.variable {
            return self.push(TapeOperation::Abscissa, from);
        }
        if let Some((_, value)) = CONSTANTS.iter().find(|(known, _)| *known == name) {
            return self.push(TapeOperation::Constant(*value), from);
        }
        if let Some((_, function)) = FUNCTIONS.iter().find(|(known, _)| *known == name) {
            if self.peek() != Some('(') {
                let help = Some(format!("write {name}(…)"));
                return self.fault(self.at + 1, format!("`{name}` needs its argument in parentheses"), help);
            }
            let argument = self.enclosed()?;
            return self.push(TapeOperation::Of(*function, argument), from);
        }
        let known = FUNCTIONS.iter().map(|(known, _)| *known).chain(CONSTANTS.iter().map(|(known, _)| *known));
        let all: Vec<&str> = std::iter::once(self.variable).chain(known.clone()).collect();
        let near = similar(&name, all.iter().copied()).map_or(String::new(), |near| format!("did you mean `{near}`? "));
        let help =
            format!("{near}the variable is `{}`; known are {}", self.variable, known.collect::<Vec<_>>().join(", "));
        self.fault(from, format!("unknown name `{name}`"), Some(help))
    }
}

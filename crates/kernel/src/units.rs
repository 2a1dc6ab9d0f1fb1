//! Text to SI number of the right kind: the only place where units exist.
//!
//! A quantity is a decimal number followed by a unit, `"180 mm"` or `"5um"`. Everything after this module is SI `f64`
//! and radians.

mod length_unit;

pub use length_unit::{LengthUnit, metric_column};
use std::f64::consts::TAU;
use std::fmt;

/// The kind of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// Metres inside.
    Length,
    /// Radians inside.
    Angle,
    /// Kilograms inside.
    Mass,
    /// Pascals inside.
    Pressure,
    /// Newtons inside.
    Force,
    /// Seconds inside.
    Time,
    /// Newtons per metre inside.
    Stiffness,
    /// Metres per second inside.
    Speed,
    /// Kilograms times square metres inside.
    Inertia,
    /// Kilograms per cubic metre inside.
    Density,
    /// Kilograms times metres inside.
    Unbalance,
    /// Metres per second squared inside.
    Acceleration,
    /// Newton metres inside.
    Moment,
    /// Newton metres per radian inside.
    TorsionalStiffness,
    /// Newton seconds per metre inside.
    Damping,
    /// Newton metre seconds per radian inside.
    TorsionalDamping,
    /// Periods per second inside.
    Frequency,
}

struct UnitSymbol {
    symbol: &'static str,
    dimension: Dimension,
    /// SI = number × `multiply` / `divide`: a division by a power of ten is correctly rounded where a
    /// multiplication by its inverse is not, so that "180 mm" is the `f64` nearest to 0.18.
    multiply: f64,
    divide: f64,
}

const fn unit(symbol: &'static str, dimension: Dimension, multiply: f64, divide: f64) -> UnitSymbol {
    UnitSymbol { symbol, dimension, multiply, divide }
}

/// One kilogram-force in newtons (exact, CGPM 1901); one technical atmosphere is 1e4 of them per square metre.
pub const KILOGRAM_FORCE: f64 = 9.80665;
/// One technical atmosphere, 1 kgf/cm², in pascals.
pub const TECHNICAL_ATMOSPHERE: f64 = 98_066.5;
/// One pound-force in newtons: the pound times the standard acceleration, both exact.
const POUND_FORCE: f64 = 4.448_221_615_260_5;

const UNITS: &[UnitSymbol] = &[
    unit("um", Dimension::Length, 1.0, 1e6),
    unit("µm", Dimension::Length, 1.0, 1e6),
    unit("mm", Dimension::Length, 1.0, 1e3),
    unit("cm", Dimension::Length, 1.0, 1e2),
    unit("m", Dimension::Length, 1.0, 1.0),
    unit("in", Dimension::Length, 25.4, 1e3),
    unit("deg", Dimension::Angle, std::f64::consts::PI, 180.0),
    unit("rad", Dimension::Angle, 1.0, 1.0),
    unit("kg", Dimension::Mass, 1.0, 1.0),
    unit("lb", Dimension::Mass, 0.453_592_37, 1.0),
    unit("g", Dimension::Mass, 1.0, 1e3),
    unit("Pa", Dimension::Pressure, 1.0, 1.0),
    unit("kPa", Dimension::Pressure, 1e3, 1.0),
    unit("MPa", Dimension::Pressure, 1e6, 1.0),
    unit("GPa", Dimension::Pressure, 1e9, 1.0),
    unit("bar", Dimension::Pressure, 1e5, 1.0),
    unit("at", Dimension::Pressure, TECHNICAL_ATMOSPHERE, 1.0),
    unit("psi", Dimension::Pressure, 6_894.757_293_168_361, 1.0),
    unit("kgf/cm2", Dimension::Pressure, TECHNICAL_ATMOSPHERE, 1.0),
    unit("N", Dimension::Force, 1.0, 1.0),
    unit("kN", Dimension::Force, 1e3, 1.0),
    unit("kgf", Dimension::Force, KILOGRAM_FORCE, 1.0),
    unit("daN", Dimension::Force, 10.0, 1.0),
    unit("lbf", Dimension::Force, POUND_FORCE, 1.0),
    unit("s", Dimension::Time, 1.0, 1.0),
    unit("ms", Dimension::Time, 1.0, 1e3),
    unit("N/mm", Dimension::Stiffness, 1e3, 1.0),
    unit("kgf/cm", Dimension::Stiffness, 980.665, 1.0),
    unit("N/m", Dimension::Stiffness, 1.0, 1.0),
    unit("N/um", Dimension::Stiffness, 1e6, 1.0),
    unit("kN/mm", Dimension::Stiffness, 1e6, 1.0),
    unit("kN/m", Dimension::Stiffness, 1e3, 1.0),
    unit("N/cm", Dimension::Stiffness, 1e2, 1.0),
    unit("lbf/in", Dimension::Stiffness, POUND_FORCE * 1e3, 25.4),
    unit("daN/cm", Dimension::Stiffness, 1e3, 1.0),
    unit("m/s", Dimension::Speed, 1.0, 1.0),
    unit("mm/s", Dimension::Speed, 1.0, 1e3),
    unit("mm/min", Dimension::Speed, 1.0, 6e4),
    unit("kg*m2", Dimension::Inertia, 1.0, 1.0),
    unit("kg*cm2", Dimension::Inertia, 1.0, 1e4),
    unit("kg*mm2", Dimension::Inertia, 1.0, 1e6),
    unit("kg/m3", Dimension::Density, 1.0, 1.0),
    unit("kg/dm3", Dimension::Density, 1e3, 1.0),
    unit("g/cm3", Dimension::Density, 1e3, 1.0),
    unit("g*mm", Dimension::Unbalance, 1.0, 1e6),
    unit("kg*mm", Dimension::Unbalance, 1.0, 1e3),
    unit("m/s2", Dimension::Acceleration, 1.0, 1.0),
    unit("N*m", Dimension::Moment, 1.0, 1.0),
    unit("N*mm", Dimension::Moment, 1.0, 1e3),
    unit("kgf*cm", Dimension::Moment, KILOGRAM_FORCE, 1e2),
    unit("kN*m", Dimension::Moment, 1e3, 1.0),
    unit("lbf*in", Dimension::Moment, POUND_FORCE * 25.4, 1e3),
    unit("N*m/rad", Dimension::TorsionalStiffness, 1.0, 1.0),
    unit("N*m/deg", Dimension::TorsionalStiffness, 180.0, std::f64::consts::PI),
    unit("N*s/m", Dimension::Damping, 1.0, 1.0),
    unit("N*s/mm", Dimension::Damping, 1e3, 1.0),
    unit("N*m*s/rad", Dimension::TorsionalDamping, 1.0, 1.0),
    unit("Hz", Dimension::Frequency, 1.0, 1.0),
    unit("kHz", Dimension::Frequency, 1e3, 1.0),
];

/// Units as people write them, and the symbols of [`UNITS`] that they are.
const SPELLINGS: &[(&str, &str)] = &[
    ("°", "deg"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("radian", "rad"),
    ("radians", "rad"),
    // The Greek letter, which is another character than the sign for micro above.
    ("μm", "um"),
    ("micron", "um"),
    ("microns", "um"),
    ("\"", "in"),
    ("''", "in"),
    ("inch", "in"),
    ("inches", "in"),
    ("sec", "s"),
    ("lbs", "lb"),
    ("lb/in", "lbf/in"),
    ("lbf-in", "lbf*in"),
    ("lb-in", "lbf*in"),
    ("kp", "kgf"),
    ("kp/cm2", "kgf/cm2"),
    ("N/mm2", "MPa"),
    ("kN/mm2", "GPa"),
    ("N/m2", "Pa"),
];

/// The unit of a symbol as people write it: powers raised or with ^, products with a dot, a blank or nothing, other spellings, and,
/// among the units of a kind, small letters for capitals and the reverse.
fn unit_of(typed: &str, kind: Option<Dimension>) -> Option<&'static UnitSymbol> {
    if let Some(unit) = UNITS.iter().find(|unit| unit.symbol == typed) {
        return Some(unit);
    }
    let plain = typed.chars().filter(|c| !matches!(c, '^' | ' ' | '\u{a0}' | '\u{202f}')).map(|c| match c {
        '²' => '2',
        '³' => '3',
        '·' | '⋅' | '×' | '.' => '*',
        other => other,
    });
    let plain: String = plain.collect();
    let plain = SPELLINGS.iter().find(|(spelling, _)| *spelling == plain).map_or(plain.as_str(), |(_, symbol)| symbol);
    let mut exact = UNITS.iter().filter(|unit| unit.symbol == plain);
    let mut joined = UNITS.iter().filter(|unit| unit.symbol.replace('*', "") == plain.replace('*', ""));
    if let Some(unit) = exact.next().or_else(|| joined.next()) {
        return Some(unit);
    }
    // `mPa` and `Mm` are other units, a thousandth and a million times the size.
    let mut letters = plain.chars().filter(|c| c.is_alphabetic());
    let of_one_size = letters.clone().all(char::is_uppercase) || letters.all(char::is_lowercase);
    let symbol =
        SPELLINGS.iter().find(|(spelling, _)| folded(spelling) == folded(plain)).map_or(plain, |(_, symbol)| symbol);
    UNITS.iter().find(|unit| {
        kind == Some(unit.dimension)
            && folded(unit.symbol) == folded(symbol)
            && (of_one_size || milli_or_mega(unit.symbol) == milli_or_mega(plain))
    })
}

/// A symbol in small letters and without the signs of products.
fn folded(text: &str) -> String {
    text.to_lowercase().replace('*', "")
}

fn milli_or_mega(symbol: &str) -> Option<char> {
    symbol.chars().next().filter(|c| matches!(c, 'm' | 'M'))
}

impl Dimension {
    /// Spellings of the units that fit in addition to those of [`Dimension::unit_list`], for a schema.
    pub fn spellings(self) -> impl Iterator<Item = &'static str> {
        let own = UNITS.iter().filter(move |unit| unit.dimension == self);
        let others = own.clone().filter(|unit| !unit.symbol.is_ascii()).map(|unit| unit.symbol);
        let spelled = SPELLINGS.iter().filter(move |(_, symbol)| own.clone().any(|unit| unit.symbol == *symbol));
        others.chain(spelled.map(|(spelling, _)| *spelling))
    }

    /// The units that fit, in the order of the documentation, as one list for a message: `um, mm, cm, m, in`.
    #[must_use]
    pub fn unit_list(self) -> String {
        let symbols: Vec<&str> =
            UNITS.iter().filter(|u| u.dimension == self && u.symbol.is_ascii()).map(|u| u.symbol).collect();
        symbols.join(", ")
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Dimension::Length => "length",
            Dimension::Angle => "angle",
            Dimension::Mass => "mass",
            Dimension::Pressure => "pressure",
            Dimension::Force => "force",
            Dimension::Time => "time",
            Dimension::Stiffness => "stiffness",
            Dimension::Speed => "speed",
            Dimension::Inertia => "moment of inertia",
            Dimension::Density => "density",
            Dimension::Unbalance => "unbalance",
            Dimension::Acceleration => "acceleration",
            Dimension::Moment => "moment",
            Dimension::TorsionalStiffness => "torsional stiffness",
            Dimension::Damping => "damping",
            Dimension::TorsionalDamping => "torsional damping",
            Dimension::Frequency => "frequency",
        })
    }
}

/// Why a text is not a quantity of the required kind.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum QuantityError {
    /// No number at the start of the text.
    #[error("`{found}` does not start with a number")]
    NotANumber {
        /// The text.
        found: String,
    },
    /// NaN, infinite or beyond the range of `f64`.
    #[error("`{found}` is not a finite number")]
    NotFinite {
        /// The text.
        found: String,
    },
    /// A comma in a number.
    #[error("`{found}` has a comma: write a decimal point, `{meant}`")]
    Comma {
        /// The text.
        found: String,
        /// What was probably meant.
        meant: String,
    },
    /// A fraction such as 1/2.
    #[error("`{found}` is a fraction: write it with a decimal point, `{meant}`")]
    Fraction {
        /// The text.
        found: String,
        /// What was probably meant.
        meant: String,
    },
    /// A number without a unit.
    #[error("`{found}` has no unit")]
    MissingUnit {
        /// The text.
        found: String,
    },
    /// A unit camgen does not know.
    #[error("unknown unit `{unit}`")]
    UnknownUnit {
        /// What follows the number.
        unit: String,
    },
    /// A unit of another kind.
    #[error("`{unit}` is a unit of {found}, not of {expected}")]
    WrongKind {
        /// The unit.
        unit: &'static str,
        /// Its kind.
        found: Dimension,
        /// The required kind.
        expected: Dimension,
    },
    /// A unit where a bare number is expected.
    #[error("`{found}` is not a bare number")]
    NotBare {
        /// The text.
        found: String,
    },
}

/// A parsed quantity: its SI value and the unit it was written in, for messages in the user's own unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParsedQuantity {
    /// The value in SI units or radians.
    pub si: f64,
    symbol: &'static str,
    si_per_unit: f64,
}

impl ParsedQuantity {
    /// The unit it was written in: its symbol, and one of it in SI units or radians.
    #[must_use]
    pub fn unit(&self) -> (&'static str, f64) {
        (self.symbol, self.si_per_unit)
    }

    /// An SI value written in the unit of this quantity, `"0.9 at"`.
    #[must_use]
    pub fn in_same_unit(&self, si: f64) -> String {
        // Ten digits drop the rounding of the conversion and keep everything a user typed.
        let number: f64 = format!("{:.9e}", si / self.si_per_unit).parse().unwrap_or(si);
        format!("{number} {}", self.symbol)
    }
}

/// Longest text of a quantity, bytes: all digits of a number, and a unit.
const LONGEST: usize = 500;
/// Most characters of a text that an error quotes.
const MOST_QUOTED: usize = 60;

/// A text as an error quotes it.
fn quoted(text: &str) -> String {
    let text = text.trim();
    match text.char_indices().nth(MOST_QUOTED).and_then(|(end, _)| text.get(..end)) {
        Some(beginning) => format!("{beginning}…"),
        None => text.to_owned(),
    }
}

/// Splits a text into its leading number and the rest. The longest prefix that is a number wins, so that `1e-3 m`
/// keeps its exponent and `3 m` does not lose its unit.
fn split_number(text: &str) -> Option<(f64, &str)> {
    // Each beginning of the text is tried, the longest first.
    let text = Some(text.trim()).filter(|text| text.len() <= LONGEST)?;
    let mut ends: Vec<usize> = text.char_indices().map(|(at, _)| at).skip(1).collect();
    ends.push(text.len());
    ends.into_iter().rev().find_map(|end| {
        let (head, tail) = (text.get(..end)?, text.get(end..)?);
        head.trim_end().parse::<f64>().ok().map(|number| (number, tail.trim()))
    })
}

fn unit_in(symbol: &str, dimension: Dimension) -> Option<&'static UnitSymbol> {
    unit_of(symbol.trim(), Some(dimension)).filter(|unit| unit.dimension == dimension)
}

/// A number with a comma, or a fraction: read as far as the sign, what follows would be taken for a unit.
fn other_number(text: &str) -> Option<QuantityError> {
    let text = text.trim();
    let (whole, rest) = text.split_at(text.find([',', '/'])?);
    let (sign, rest) = rest.split_at(1);
    let whole_digits = whole.strip_prefix(['-', '+']).unwrap_or(whole);
    let count = rest.chars().take_while(char::is_ascii_digit).count();
    if count == 0 || whole_digits.is_empty() || text.len() > LONGEST {
        return None;
    }
    let (decimals, unit) = rest.split_at(count);
    let found = quoted(text);
    if sign == "," {
        // `1.234,5` is a number with points for the thousands.
        let is_number = whole_digits.chars().all(|c| c.is_ascii_digit() || c == '.');
        let whole = whole.replace('.', "");
        let mut meant = quoted(&format!("{whole}.{decimals}{unit}"));
        if count == 3 {
            // Three digits may be thousands as well.
            meant = format!("{meant}` or `{}", quoted(&format!("{whole}{decimals}{unit}")));
        }
        return is_number.then_some(QuantityError::Comma { found, meant });
    }
    let symbol = unit.trim();
    if !symbol.is_empty() && unit_of(symbol, None).is_none() {
        return Some(QuantityError::UnknownUnit { unit: quoted(symbol) });
    }
    // `1/2 in` and `1 1/2 in`.
    let (before, above) =
        whole.rsplit_once([' ', '-']).filter(|(before, _)| !before.is_empty()).unwrap_or(("0", whole));
    let (before, above, below) = (before.trim().parse::<f64>(), above.parse::<f64>(), decimals.parse::<f64>());
    let (before, above, below) = (before.ok()?, above.ok()?, below.ok()?);
    let meant = quoted(&format!("{}{unit}", before + above / below));
    (below > 0.0).then_some(QuantityError::Fraction { found, meant })
}

/// Parses a quantity of the given kind.
///
/// # Errors
/// Every case of [`QuantityError`] but `NotBare`.
pub fn parse(text: &str, dimension: Dimension) -> Result<ParsedQuantity, QuantityError> {
    let found = quoted(text);
    let Some((number, symbol)) = split_number(text) else {
        return Err(QuantityError::NotANumber { found });
    };
    if !number.is_finite() {
        return Err(QuantityError::NotFinite { found });
    }
    if symbol.is_empty() {
        return Err(QuantityError::MissingUnit { found });
    }
    let Some(unit) = unit_of(symbol, Some(dimension)) else {
        return Err(other_number(text).unwrap_or_else(|| QuantityError::UnknownUnit { unit: quoted(symbol) }));
    };
    if unit.dimension != dimension {
        return Err(QuantityError::WrongKind { unit: unit.symbol, found: unit.dimension, expected: dimension });
    }
    let si = number * unit.multiply / unit.divide;
    if !si.is_finite() {
        return Err(QuantityError::NotFinite { found });
    }
    Ok(ParsedQuantity { si, symbol: unit.symbol, si_per_unit: unit.multiply / unit.divide })
}

/// A derivative of a position, by the cam angle, by the travel of a plate or by the time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DerivativeValue {
    /// Metres or radians per radian, metre or second, to the power of its order.
    pub value: f64,
    /// Whether it is the derivative of an angle; else of a length.
    pub swing: bool,
    /// Whether it is per second.
    pub by_time: bool,
    /// Whether it is per metre of travel; where it is neither, it is per radian of the cam.
    pub by_travel: bool,
}

/// The speed of a shaft in rad/s.
#[inline]
#[must_use]
pub fn rad_per_s(rpm: f64) -> f64 {
    rpm * TAU / 60.0
}

/// The speed of a shaft in rpm.
#[inline]
#[must_use]
pub fn rpm(rad_per_s: f64) -> f64 {
    60.0 * rad_per_s / TAU
}

/// Parses a velocity (order 1), an acceleration (2) or a jerk (3): a length or an angle over `deg`, `rad`, a length or `s` with the order as
/// its power, `"-0.3 mm/deg"`, `"0.4 mm/mm"`, `"2 m/s2"`.
///
/// # Errors
/// Every case of [`QuantityError`] but `WrongKind` and `NotBare`.
pub fn parse_rate(text: &str, order: u32) -> Result<DerivativeValue, QuantityError> {
    let text = text.trim().replace('²', "2").replace('³', "3").replace('^', "");
    let found = quoted(&text);
    let Some((number, symbol)) = split_number(&text) else { return Err(QuantityError::NotANumber { found }) };
    if symbol.is_empty() {
        return Err(QuantityError::MissingUnit { found });
    }
    let unknown = || other_number(&text).unwrap_or_else(|| QuantityError::UnknownUnit { unit: quoted(symbol) });
    let (of, by) = symbol.split_once('/').ok_or_else(unknown)?;
    let of = unit_in(of, Dimension::Length).or_else(|| unit_in(of, Dimension::Angle)).ok_or_else(unknown)?;
    let power = if order == 1 { String::new() } else { order.to_string() };
    let by_text = by.trim().strip_suffix(power.as_str()).ok_or_else(unknown)?;
    let by = unit_in(by_text, Dimension::Angle)
        .or_else(|| unit_in(by_text, Dimension::Time).filter(|unit| unit.symbol == "s"))
        .or_else(|| unit_in(by_text, Dimension::Length))
        .ok_or_else(unknown)?;
    let each = by.multiply / by.divide;
    let value = number * of.multiply / of.divide / (0..order).fold(1.0, |power, _| power * each);
    if !value.is_finite() {
        return Err(QuantityError::NotFinite { found });
    }
    let (by_time, by_travel) = (by.dimension == Dimension::Time, by.dimension == Dimension::Length);
    Ok(DerivativeValue { value, swing: of.dimension == Dimension::Angle, by_time, by_travel })
}

/// Parses a bare number: a ratio, an exponent, revolutions per minute.
///
/// # Errors
/// `NotANumber`, `NotFinite`, or `NotBare` when something follows the number.
pub fn parse_bare(text: &str) -> Result<f64, QuantityError> {
    let found = quoted(text);
    match split_number(text) {
        None => Err(QuantityError::NotANumber { found }),
        Some((number, _)) if !number.is_finite() => Err(QuantityError::NotFinite { found }),
        Some((number, "")) => Ok(number),
        Some(_) => Err(other_number(text).unwrap_or(QuantityError::NotBare { found })),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_reads_as_its_si_value() {
        let cases = [
            ("180 mm", Dimension::Length, 0.18),
            ("7.1 in", Dimension::Length, 0.18034),
            ("5um", Dimension::Length, 5e-6),
            ("1e-3 m", Dimension::Length, 1e-3),
            ("3 deg", Dimension::Angle, 0.052_359_877_559_829_89),
            ("978.2 kg", Dimension::Mass, 978.2),
            ("2 at", Dimension::Pressure, 196_133.0),
            ("1.96 bar", Dimension::Pressure, 196_000.0),
            ("14.503773773020923 psi", Dimension::Pressure, 100_000.0),
            ("2170.8 kgf", Dimension::Force, 21_288.275_82),
            ("4 ms", Dimension::Time, 0.004),
            ("60.3 kgf/cm", Dimension::Stiffness, 59_134.099_5),
            ("250 N*mm", Dimension::Moment, 0.25),
            ("2 N*m/deg", Dimension::TorsionalStiffness, 114.591_559_026_164_64),
            ("3 N*s/mm", Dimension::Damping, 3000.0),
            ("0.2 N*m*s/rad", Dimension::TorsionalDamping, 0.2),
            ("40Hz", Dimension::Frequency, 40.0),
            ("12 kg*cm2", Dimension::Inertia, 1.2e-3),
            // As people type them.
            ("30°", Dimension::Angle, 0.523_598_775_598_298_8),
            ("30 degrees", Dimension::Angle, 0.523_598_775_598_298_8),
            ("12 MM", Dimension::Length, 0.012),
            ("1.5\"", Dimension::Length, 0.0381),
            ("1.5 inch", Dimension::Length, 0.0381),
            ("7 μm", Dimension::Length, 7e-6),
            ("12 Nm", Dimension::Moment, 12.0),
            ("12 N·m", Dimension::Moment, 12.0),
            ("12 N m", Dimension::Moment, 12.0),
            ("12 nm", Dimension::Moment, 12.0),
            ("8 kN/m", Dimension::Stiffness, 8000.0),
            ("8 n/mm", Dimension::Stiffness, 8000.0),
            ("10 lbf/in", Dimension::Stiffness, 1_751.268_352_464_764_5),
            ("450 g", Dimension::Mass, 0.45),
            ("4 KG", Dimension::Mass, 4.0),
            ("4 Kg", Dimension::Mass, 4.0),
            ("200 Mpa", Dimension::Pressure, 200e6),
            ("200 mpa", Dimension::Pressure, 200e6),
            ("200 N/mm²", Dimension::Pressure, 200e6),
            ("0.02 kg·m²", Dimension::Inertia, 0.02),
            ("0.02 kg m^2", Dimension::Inertia, 0.02),
            ("7.85 g/cm³", Dimension::Density, 7850.0),
        ];
        for (text, dimension, si) in cases {
            let got = parse(text, dimension).expect(text).si;
            assert!((got - si).abs() <= 4.0 * f64::EPSILON * si, "{text}: {got} is not {si}");
        }
        assert_eq!(parse("180 mm", Dimension::Length).expect("mm").si.to_bits(), 0.18_f64.to_bits());
    }

    #[test]
    fn rates_read_as_their_si_value() {
        let degree = std::f64::consts::PI / 180.0;
        for (text, order, value, swing, by_time) in [
            ("-0.3 mm/deg", 1, -0.3e-3 / degree, false, false),
            ("2 m/s2", 2, 2.0, false, true),
            ("2 mm/s^2", 2, 2e-3, false, true),
            ("1.5 deg/deg", 1, 1.5, true, false),
            ("90deg/s", 1, 0.5 * std::f64::consts::PI, true, true),
            ("3 mm/rad³", 3, 3e-3, false, false),
            ("0.5 mm/°", 1, 0.5e-3 / degree, false, false),
            ("90 °/s", 1, 0.5 * std::f64::consts::PI, true, true),
            ("2 MM/S", 1, 2e-3, false, true),
            ("0.4 mm/mm", 1, 0.4, false, false),
            ("0.02 mm/mm2", 2, 20.0, false, false),
            ("1 in/in³", 3, 1.0 / (0.0254 * 0.0254), false, false),
        ] {
            let rate = parse_rate(text, order).expect(text);
            assert!((rate.value - value).abs() <= 4.0 * f64::EPSILON * value.abs(), "{text}: {rate:?}");
            assert_eq!((rate.swing, rate.by_time), (swing, by_time), "{text}");
            assert_eq!(
                rate.by_travel,
                order == 1 && text.contains("mm/mm") || text.contains("/mm2") || text.contains("/in"),
                "{text}"
            );
        }
        for (text, order) in [("2 m/s", 2), ("2 m/s2", 1), ("2 kg/s", 1), ("2 mm/kg", 1), ("2 mm", 1), ("2 mm/", 1)] {
            assert!(matches!(parse_rate(text, order), Err(QuantityError::UnknownUnit { .. })), "{text}");
        }
        assert!(matches!(parse_rate("2", 1), Err(QuantityError::MissingUnit { .. })));
        assert!(matches!(parse_rate("fast", 1), Err(QuantityError::NotANumber { .. })));
    }

    #[test]
    fn each_error_has_its_text() {
        type E = QuantityError;
        let length = |text: &str| parse(text, Dimension::Length).expect_err(text);
        assert_eq!(length("mm"), E::NotANumber { found: "mm".into() });
        assert_eq!(length(""), E::NotANumber { found: String::new() });
        assert_eq!(length("nan mm"), E::NotFinite { found: "nan mm".into() });
        assert_eq!(length("1e999 mm"), E::NotFinite { found: "1e999 mm".into() });
        assert_eq!(length("180"), E::MissingUnit { found: "180".into() });
        assert_eq!(length("180 ells"), E::UnknownUnit { unit: "ells".into() });
        let comma = |found: &str, meant: &str| E::Comma { found: found.into(), meant: meant.into() };
        assert_eq!(length("2,5 mm"), comma("2,5 mm", "2.5 mm"));
        assert_eq!(length("1.234,5 mm"), comma("1.234,5 mm", "1234.5 mm"));
        assert_eq!(length("10,000 mm"), comma("10,000 mm", "10.000 mm` or `10000 mm"));
        assert!(length("-2,5mm").to_string().ends_with("write a decimal point, `-2.5mm`"));
        assert_eq!(parse_bare("0,5"), Err(comma("0,5", "0.5")));
        assert_eq!(parse_rate("0,5 mm/deg", 1), Err(comma("0,5 mm/deg", "0.5 mm/deg")));
        let fraction = |found: &str, meant: &str| E::Fraction { found: found.into(), meant: meant.into() };
        assert_eq!(length("1/2 in"), fraction("1/2 in", "0.5 in"));
        assert_eq!(length("1/3 turn"), E::UnknownUnit { unit: "turn".into() });
        assert_eq!(length("1 1/2 in"), fraction("1 1/2 in", "1.5 in"));
        assert_eq!(length("1-3/4\""), fraction("1-3/4\"", "1.75\""));
        // Of these the size of the letters says how large they are.
        for other in ["Mm", "mPa"] {
            assert_eq!(length(&format!("2 {other}")), E::UnknownUnit { unit: other.into() });
        }
        assert_eq!(length("180 kg"), E::WrongKind { unit: "kg", found: Dimension::Mass, expected: Dimension::Length });
        assert_eq!(parse_bare("35 rpm"), Err(E::NotBare { found: "35 rpm".into() }));
        assert_eq!(parse_bare(" 35 "), Ok(35.0));
        let digits = "1".repeat(100_000);
        let short = format!("{}…", &digits[..60]);
        assert_eq!(length(&format!("{digits} mm")), E::NotANumber { found: short.clone() });
        assert_eq!(length(&format!("1 {}", &digits[..400])), E::UnknownUnit { unit: short });
    }

    #[test]
    fn a_limit_is_told_in_the_unit_the_user_wrote() {
        let typed = parse("0.9 at", Dimension::Pressure).expect("at");
        assert_eq!(typed.in_same_unit(98_066.5), "1 at");
        assert_eq!(typed.in_same_unit(typed.si), "0.9 at");
    }
}

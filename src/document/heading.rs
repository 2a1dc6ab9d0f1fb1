//! The unit that a heading of a column names: `angle (rad)`, `lift, mm`, `cam_deg`, `Crank angle [°]`.

use crate::units::{self, Dimension};

/// What a heading says of the numbers below it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HeadingUnit {
    /// A unit of length or angle: its symbol, and one of it in SI units or radians.
    Quantity {
        /// The kind.
        dimension: Dimension,
        /// As `units` writes it.
        symbol: &'static str,
        /// m or rad.
        size: f64,
    },
    /// Hundredths.
    Percent,
    /// A unit of another kind, which a motion by the cam angle cannot use.
    Other(&'static str),
}

/// Why the numbers below a heading cannot be read by it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UnclearHeading {
    /// It names a unit that is not known.
    #[error("names \"{0}\", which is no unit that is known")]
    Unknown(String),
    /// It names a multiple or a part of a unit.
    #[error("has a factor beside the unit, \"{0}\"")]
    Factor(String),
}

/// Words of headings and the unit that each means, where that is not a symbol of `units`.
const WORDS: &[(&str, &str)] = &[
    ("degree", "deg"),
    ("degrees", "deg"),
    ("°", "deg"),
    ("grad", "deg"),
    ("radian", "rad"),
    ("radians", "rad"),
    ("inch", "in"),
    ("inches", "in"),
    ("\"", "in"),
    ("thou", "mil"),
    ("mils", "mil"),
    ("ins", "in"),
    ("zoll", "in"),
    ("''", "in"),
    ("″", "in"),
    ("”", "in"),
    ("micron", "um"),
    ("microns", "um"),
    ("micrometre", "um"),
    ("micrometres", "um"),
    ("micrometer", "um"),
    ("micrometers", "um"),
    ("mikrometer", "um"),
    ("μm", "um"),
    ("millimetre", "mm"),
    ("millimetres", "mm"),
    ("millimeter", "mm"),
    ("millimeters", "mm"),
    ("centimetre", "cm"),
    ("centimetres", "cm"),
    ("centimeter", "cm"),
    ("centimeters", "cm"),
    ("zentimeter", "cm"),
    ("metre", "m"),
    ("metres", "m"),
    ("meter", "m"),
    ("meters", "m"),
    ("decimetre", "dm"),
    ("decimetres", "dm"),
    ("decimeter", "dm"),
    ("decimeters", "dm"),
    ("dezimeter", "dm"),
    ("foot", "ft"),
    ("feet", "ft"),
    ("'", "ft"),
    ("microinch", "µin"),
    ("microinches", "µin"),
    ("uin", "µin"),
    ("cad", "deg"),
    ("%", "%"),
    ("percent", "%"),
];

/// Units that are known but not read, so that a column in them is refused instead of taken for another one.
const OTHERS: &[&str] = &["gon", "s", "ms", "sec", "dm", "ft", "µin", "rev", "rpm", "mm/deg", "mm/rad"];

/// What a bracket in a heading may say besides a unit.
const DESCRIPTIONS: &[&str] = &[
    "absolute",
    "actual",
    "arm",
    "cam",
    "corrected",
    "crank",
    "engine",
    "exhaust",
    "filtered",
    "follower",
    "inlet",
    "intake",
    "measured",
    "nominal",
    "offset",
    "outlet",
    "position",
    "raw",
    "roller",
    "shaft",
    "smoothed",
    "tappet",
    "valve",
];

/// Parts of a unit in words.
const PARTS: &[&str] = &[
    "tenth",
    "tenths",
    "hundredth",
    "hundredths",
    "thousandth",
    "thousandths",
    "zehntel",
    "hundertstel",
    "tausendstel",
];

/// Quantities that are not the position of a follower, as headings name them.
const DERIVATIVES: &[&str] = &[
    "velocity",
    "speed",
    "acceleration",
    "accel",
    "jerk",
    "force",
    "torque",
    "geschwindigkeit",
    "beschleunigung",
    "ruck",
    "kraft",
    "moment",
];

/// One thousandth of an inch, m.
const MIL: f64 = 25.4e-6;

impl HeadingUnit {
    /// The unit of a heading: that in brackets, or its last word that is a unit; `None` where it names none that can be read.
    #[must_use]
    pub fn of(heading: &str) -> Option<Self> {
        Self::read(heading).ok().flatten()
    }

    /// The unit of a heading: that in brackets, or its last word that is a unit; `None` where it names none.
    ///
    /// # Errors
    /// [`UnclearHeading`] where a bracket, or the word after `in`, is no unit that is known, or a factor stands beside the unit.
    pub fn read(heading: &str) -> Result<Option<Self>, UnclearHeading> {
        if let Some(factor) = factor_in(heading) {
            return Err(UnclearHeading::Factor(factor));
        }
        let bracket = inside(heading);
        if let Some(unit) = bracket.and_then(Self::last_in).or_else(|| Self::last_in(heading)) {
            return Ok(Some(unit));
        }
        let words: Vec<&str> = words(heading).collect();
        let after_in = words.iter().position(|word| word.eq_ignore_ascii_case("in")).and_then(|at| words.get(at + 1));
        let is_described = |text: &str| {
            let named = |word: &str| DESCRIPTIONS.contains(&word.to_lowercase().as_str());
            text.contains(|c: char| c.is_ascii_digit()) || self::words(text).any(named)
        };
        let unknown =
            bracket.map(str::trim).filter(|text| !text.is_empty() && !is_described(text)).or(after_in.copied());
        unknown.map_or(Ok(None), |text| Err(UnclearHeading::Unknown(text.to_owned())))
    }

    fn last_in(text: &str) -> Option<Self> {
        let words: Vec<&str> = words(text).collect();
        let last = words.len().saturating_sub(1);
        // A single letter is a unit only where nothing else is in it: the `s` of `s (mm)` is a name; the `in` of `in metres` is a
        // preposition.
        let is_unit = |at: usize, word: &str| match word {
            "m" | "in" | "In" => at == last,
            _ => word.chars().count() > 1 || words.len() == 1 || !word.chars().all(char::is_alphabetic),
        };
        let found =
            words.iter().enumerate().rev().find(|(at, word)| is_unit(*at, word) && Self::of_word(word).is_some());
        found.and_then(|(_, word)| Self::of_word(word))
    }

    /// The unit that a word is.
    #[must_use]
    pub fn of_word(word: &str) -> Option<Self> {
        let lower = word.trim().to_lowercase();
        let symbol = WORDS.iter().find(|(from, _)| *from == lower).map_or(lower.as_str(), |(_, to)| *to);
        if symbol == "%" {
            return Some(Self::Percent);
        }
        if symbol == "mil" {
            return Some(Self::Quantity { dimension: Dimension::Length, symbol: "mil", size: MIL });
        }
        let known = [Dimension::Length, Dimension::Angle].into_iter().find_map(|dimension| {
            let (symbol, size) = units::parse(&format!("1 {symbol}"), dimension).ok()?.unit();
            Some(Self::Quantity { dimension, symbol, size })
        });
        known.or_else(|| OTHERS.iter().find(|other| **other == symbol).map(|other| Self::Other(other)))
    }

    /// Its symbol.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Quantity { symbol, .. } | Self::Other(symbol) => symbol,
            Self::Percent => "%",
        }
    }
}

/// What is in the first brackets of a heading.
fn inside(heading: &str) -> Option<&str> {
    heading.split_once(['(', '[']).and_then(|(_, rest)| rest.split([')', ']']).next())
}

/// The words of a heading, and its numbers.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let apart = |c: char| !(c.is_alphanumeric() || matches!(c, '°' | '%' | '"' | '\'' | '″' | '”' | '/'));
    text.split(apart).filter(|word| !word.is_empty())
}

/// A factor beside the unit of a heading: `1/100 mm`, `(0.01 mm)`, `mm x 100`, `mm/100`, hundredths.
fn factor_in(heading: &str) -> Option<String> {
    let parts: Vec<&str> =
        heading.split(|c: char| c.is_whitespace() || "()[],;".contains(c)).filter(|part| !part.is_empty()).collect();
    let is_unit = |part: &str| HeadingUnit::of_word(part).is_some_and(|_| part.chars().count() > 1 || part == "\"");
    let is_number = |part: &str| {
        part.chars().any(|c| c.is_ascii_digit()) && part.chars().all(|c| c.is_ascii_digit() || "+-./^*x×eE".contains(c))
    };
    // A whole number before a unit may be the number of a cam.
    let is_factor =
        |part: &str| is_number(part) && (part.contains(['/', '.', '^']) || matches!(part, "10" | "100" | "1000"));
    for (at, part) in parts.iter().enumerate() {
        let (before, after) = (at.checked_sub(1).and_then(|at| parts.get(at)), parts.get(at + 1));
        let lower = part.to_lowercase();
        if PARTS.contains(&lower.as_str()) {
            return Some((*part).to_owned());
        }
        if let Some((unit, rest)) = part.split_once(['/', '*', '×'])
            && is_unit(unit)
            && is_number(rest)
        {
            return Some((*part).to_owned());
        }
        if let Some(before) = before.filter(|before| is_unit(part) && is_factor(before)) {
            return Some(format!("{before} {part}"));
        }
        if let Some((after, number)) = after.zip(parts.get(at + 2))
            && is_unit(part)
            && matches!(*after, "x" | "X" | "*" | "×" | "/")
            && is_number(number)
        {
            return Some(format!("{part} {after} {number}"));
        }
    }
    let bracket = inside(heading).map(str::trim).filter(|text| is_factor(text));
    bracket.map(str::to_owned)
}

/// The word of a heading that says that the column has no positions: a velocity, an acceleration or a force.
#[must_use]
pub fn derivative_in(heading: &str) -> Option<&'static str> {
    let lower = heading.to_lowercase();
    let found = words(&lower).find_map(|word| DERIVATIVES.iter().find(|name| **name == word));
    found.copied()
}

/// Whether a heading speaks of the angle of a crank: `crank deg`, `Crank Angle`, `°CA`.
#[must_use]
pub fn is_of_crank(heading: &str) -> bool {
    let lower = heading.to_lowercase();
    let words = lower.split(|c: char| !c.is_alphanumeric());
    words.into_iter().any(|word| ["crank", "crankshaft", "ca", "cad", "kw"].contains(&word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_of_a_heading_is_found() {
        for (heading, symbol) in [
            ("angle (rad)", "rad"),
            ("lift in mm", "mm"),
            ("cam_deg", "deg"),
            ("Crank angle [°]", "deg"),
            ("lift (in)", "in"),
            ("lift, inches", "in"),
            ("Lift %", "%"),
            ("deg", "deg"),
            ("s (mm)", "mm"),
            ("time (s)", "s"),
            ("lift [mil]", "mil"),
            ("position_mm", "mm"),
            ("m", "m"),
        ] {
            assert_eq!(HeadingUnit::of(heading).map(HeadingUnit::symbol), Some(symbol), "{heading}");
        }
        for (heading, symbol) in [
            ("lift in metres", "m"),
            ("lift_m", "m"),
            ("lift m", "m"),
            ("Hub (Zentimeter)", "cm"),
            ("Hub (Zoll)", "in"),
            ("lift ('')", "in"),
            ("lift (ins)", "in"),
            ("lift (feet)", "ft"),
            ("lift (dm)", "dm"),
            ("lift (Mikrometer)", "um"),
            ("valve 2 mm", "mm"),
            ("x (intake) mm", "mm"),
            ("angle (cam) deg", "deg"),
        ] {
            assert_eq!(
                HeadingUnit::read(heading).map(|unit| unit.map(HeadingUnit::symbol)),
                Ok(Some(symbol)),
                "{heading}"
            );
        }
        for (heading, unknown) in
            [("lift (furlong)", "furlong"), ("lift in furlongs", "furlongs"), ("Hub [Elle]", "Elle")]
        {
            assert_eq!(HeadingUnit::read(heading), Err(UnclearHeading::Unknown(unknown.to_owned())), "{heading}");
        }
        for heading in [
            "lift 1/100 mm",
            "lift mm x 100",
            "lift (0.01 mm)",
            "lift (10^-2 mm)",
            "lift mm/100",
            "lift (hundredths)",
            "lift (in x 10)",
            "lift 1/1000 in",
            "lift mm (1/100)",
            "lift, thousandths of an inch",
            "angle (0.1 deg)",
        ] {
            assert!(matches!(HeadingUnit::read(heading), Err(UnclearHeading::Factor(_))), "{heading}");
        }
        assert_eq!(derivative_in("Velocity"), Some("velocity"));
        assert_eq!(derivative_in("lift"), None);
        for heading in ["angle", "lift", "s", "x (intake)", "Opens at", "lift L1", "lift (cam 3)"] {
            assert!(HeadingUnit::of(heading).is_none_or(|unit| heading == "s" && unit.symbol() == "s"), "{heading}");
        }
        assert!(is_of_crank("crank deg") && is_of_crank("°CA") && !is_of_crank("cam deg"));
    }
}

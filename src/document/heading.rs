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
    ("micron", "um"),
    ("microns", "um"),
    ("μm", "um"),
    ("millimetre", "mm"),
    ("millimetres", "mm"),
    ("millimeter", "mm"),
    ("millimeters", "mm"),
    ("cad", "deg"),
    ("%", "%"),
    ("percent", "%"),
];

/// Units that are known but not read, so that a column in them is refused instead of taken for another one.
const OTHERS: &[&str] = &["gon", "s", "ms", "sec", "ft", "rev", "rpm", "mm/deg", "mm/rad"];

/// One thousandth of an inch, m.
const MIL: f64 = 25.4e-6;

impl HeadingUnit {
    /// The unit of a heading: that in brackets, or its last word that is a unit.
    #[must_use]
    pub fn of(heading: &str) -> Option<Self> {
        let inside = heading.split_once(['(', '[']).and_then(|(_, rest)| rest.split([')', ']']).next());
        if let Some(unit) = inside.and_then(Self::last_in) {
            return Some(unit);
        }
        Self::last_in(heading)
    }

    fn last_in(text: &str) -> Option<Self> {
        let apart = |c: char| !(c.is_alphanumeric() || matches!(c, '°' | '%' | '"' | '/'));
        let words: Vec<&str> = text.split(apart).filter(|word| !word.is_empty()).collect();
        // A single letter is a unit only where nothing else is in it: the `s` of `s (mm)` is a name.
        words.iter().rev().find_map(|word| {
            Self::of_word(word)
                .filter(|_| word.chars().count() > 1 || words.len() == 1 || !word.chars().all(char::is_alphabetic))
        })
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
        for heading in ["angle", "lift", "s", "x (intake)", "Opens at"] {
            assert!(HeadingUnit::of(heading).is_none_or(|unit| heading == "s" && unit.symbol() == "s"), "{heading}");
        }
        assert!(is_of_crank("crank deg") && is_of_crank("°CA") && !is_of_crank("cam deg"));
    }
}

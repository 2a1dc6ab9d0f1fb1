//! The unit that a heading of a column names: `angle (rad)`, `lift, mm`, `cam_deg`, `Crank angle [°]`.

mod factor;
mod names;

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
    #[error("names \"{0}\", which is not a known unit")]
    Unknown(String),
    /// It names a multiple or a part of a unit.
    #[error("has a factor, \"{0}\"")]
    Factor(String),
    /// It names counts of an instrument, of unknown size.
    #[error("names \"{0}\", whose size is unknown")]
    Counts(String),
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
    ("yard", "yd"),
    ("yards", "yd"),
    ("permille", "‰"),
    ("promille", "‰"),
    ("cad", "deg"),
    ("%", "%"),
    ("percent", "%"),
];

/// Units that are known but not read, so that a column in them is refused instead of taken for another one.
const OTHERS: &[&str] =
    &["gon", "s", "ms", "sec", "dm", "ft", "yd", "µin", "rev", "rpm", "mm/deg", "mm/rad", "nm", "km", "‰"];

/// Words for counts of an instrument; a count is a position only if its size is given.
const COUNTS: &[&str] = &[
    "adc",
    "bit",
    "bits",
    "cnt",
    "cnts",
    "count",
    "counts",
    "cts",
    "digit",
    "digits",
    "encoder",
    "imp",
    "imps",
    "impulse",
    "impulsen",
    "impulses",
    "incr",
    "increment",
    "increments",
    "inkr",
    "inkrement",
    "inkremente",
    "lsb",
    "lsbs",
    "mv",
    "pulse",
    "pulses",
    "raw",
    "schritte",
    "step",
    "steps",
    "tick",
    "ticks",
    "tics",
    "v",
    "volt",
    "volts",
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
    pub fn in_heading(heading: &str) -> Option<Self> {
        Self::read(heading).ok().flatten()
    }

    /// The unit of a heading: that in brackets, or its last word that is a unit; `None` where it names none.
    ///
    /// # Errors
    /// [`UnclearHeading`] where a bracket, the word after `in`, or one behind a quantity that is no usual name is no unit that is known, or a
    /// factor stands beside the unit.
    pub fn read(heading: &str) -> Result<Option<Self>, UnclearHeading> {
        if let Some(factor) = factor::factor_in(heading) {
            return Err(UnclearHeading::Factor(factor));
        }
        let bracket = inside(heading);
        if let Some(unit) = bracket.and_then(Self::last_in).or_else(|| Self::last_in(heading)) {
            return Ok(Some(unit));
        }
        if let Some(counts) = words(heading).find(|word| COUNTS.contains(&word.to_lowercase().as_str())) {
            return Err(UnclearHeading::Counts(counts.to_owned()));
        }
        let words: Vec<&str> = words(heading).collect();
        let after_in = words.iter().position(|word| word.eq_ignore_ascii_case("in")).and_then(|at| words.get(at + 1));
        let is_described =
            |text: &str| text.contains(|c: char| c.is_ascii_digit()) || self::words(text).any(names::is_name);
        let unknown =
            bracket.map(str::trim).filter(|text| !text.is_empty() && !is_described(text)).or(after_in.copied());
        let unknown = unknown.or_else(|| {
            names::strange_word(words.iter().flat_map(|word| word.split('/')).filter(|word| !word.is_empty()))
        });
        unknown.map_or(Ok(None), |text| Err(UnclearHeading::Unknown(text.to_owned())))
    }

    fn last_in(text: &str) -> Option<Self> {
        let words: Vec<&str> = words(text).collect();
        let last = words.len().saturating_sub(1);
        // A single letter is a unit only where nothing else is in it: the `s` of `s (mm)` is a name; the `in` of `in metres` is a
        // preposition.
        let mut found = words.iter().enumerate().rev().filter(|(at, word)| match **word {
            "m" | "in" | "In" => *at == last,
            word => word.chars().count() > 1 || words.len() == 1 || !word.chars().all(char::is_alphabetic),
        });
        found.find_map(|(_, word)| Self::of_word(word).or_else(|| Self::of_quotient(word)))
    }

    /// The unit after the slash: `Hub/mm`.
    fn of_quotient(word: &str) -> Option<Self> {
        let (quantity, unit) = word.rsplit_once('/')?;
        if Self::of_word(quantity).is_some() { None } else { Self::of_word(unit) }
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
    text.split(|c: char| !(c.is_alphanumeric() || matches!(c, '°' | '%' | '‰' | '"' | '\'' | '″' | '”' | '/')))
        .filter(|word| !word.is_empty())
}

/// The word of a heading that says that the column has no positions: a velocity, an acceleration or a force.
#[must_use]
pub fn derivative_in(heading: &str) -> Option<&'static str> {
    let lower = heading.to_lowercase();
    let found = words(&lower).find_map(|word| DERIVATIVES.iter().find(|name| **name == word));
    found.copied()
}

/// Whether a heading names radii, diameters or distances, which are no lift: they are those of the profile, or of the path of a roller's centre.
#[must_use]
pub fn is_radius(heading: &str) -> bool {
    const RADII: &[&str] =
        &["radius", "radii", "radial", "radien", "r", "rho", "halbmesser", "rayon", "raggio", "distance", "abstand"];
    (has_word(heading, RADII) || is_diameter(heading)) && !is_lift(heading)
}

/// Whether a heading names diameters.
#[must_use]
pub fn is_diameter(heading: &str) -> bool {
    const DIAMETERS: &[&str] =
        &["diameter", "diameters", "diam", "dia", "durchmesser", "diametre", "diamètre", "diametro", "ø"];
    has_word(heading, DIAMETERS)
}

/// Whether a heading names the lift of a follower.
#[must_use]
pub fn is_lift(heading: &str) -> bool {
    const LIFTS: &[&str] =
        &["lift", "position", "travel", "stroke", "rise", "displacement", "hub", "ventilhub", "weg", "levee", "levée"];
    has_word(heading, LIFTS)
}

fn has_word(heading: &str, names: &[&str]) -> bool {
    let lower = heading.to_lowercase();
    words(&lower).any(|word| names.contains(&word))
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

    /// Headings with multiples or parts of a unit.
    const FACTORS: &[&str] = &[
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
        "lift .001in",
        "lift (0.001in)",
        "lift 0,01mm",
        "lift 1/100mm",
        "lift 10µm",
        "lift mm x 0,01",
        "lift x 0,01",
        "lift mm *1000",
        "lift*1000",
        "lift e-3 in",
        "lift (E-3 in)",
        "lift 10⁻³ mm",
        "lift 1e-3 in",
        "lift mm·10",
        "lift 10-2 mm",
        "lift (mm) x10",
        "lift ÷ 100",
        "lift 1:100 mm",
        "lift in/1000",
        "lift mm (factor 2)",
        "lift mm scaled",
        "lift 0.001\"",
        "lift .01 mm",
        "lift (1/1000\")",
        "lift 1000ths",
        "lift in 1/1000 inch",
        "lift 5 µm",
        "lift 1mm",
        "lift 64ths in",
        "lift 10 thou",
        "lift mm e-2",
        "lift (x100) mm",
        "lift inch*1e3",
        "lift_mm_x10",
        "angle 10°",
        "angle deg*10",
        "Hub 0,001 Zoll",
        "lift (8 mm)",
        "lift milli-inch",
        "lift micro inch",
        "10 x lift mm",
        "lift mm 2x",
        "lift 2x mm",
        "2 x lift",
    ];
    /// Headings without a unit, as people write them.
    const NAMED: &[&str] = &[
        "angle",
        "lift",
        "x (intake)",
        "Opens at",
        "lift L1",
        "lift 1",
        "lift (cam 3)",
        "lift of follower",
        "lift of Smith's cam",
        "Hub s",
        "Hub Einlass",
        "Hub des Stößels",
        "s(phi)",
        "s (θ)",
        "Lift A",
        "lift_intake",
        "lift exhaust valve",
        "follower position",
        "position actual",
        "actual position",
        "Weg Schlitten Ist",
        "cam angle",
        "angle of cam",
        "crank angle",
        "Winkel Kurve",
        "phi",
        "master position",
        "slave position",
        "lift (measured)",
        "measured lift",
        "lift table",
        "lift curve of 1998",
        "rise left",
        "needle travel",
        "stroke ram",
        "valve lift intake",
        "opening",
    ];
    const COUNTED: &[&str] = &[
        "counts",
        "lift (pulses)",
        "encoder",
        "raw",
        "ADC",
        "lift raw",
        "lift [counts]",
        "lift in counts",
        "lift cts",
        "lift cnt",
        "Hub Imp",
        "Hub Inkr.",
        "position (incr)",
    ];

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
            assert_eq!(HeadingUnit::in_heading(heading).map(HeadingUnit::symbol), Some(symbol), "{heading}");
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
            ("Hub/mm", "mm"),
            ("s / mm", "mm"),
            ("lift ‰", "‰"),
            ("lift nm", "nm"),
            ("lift yards", "yd"),
            ("lift permille", "‰"),
            ("s(phi) mm", "mm"),
            ("Hub s (mm)", "mm"),
        ] {
            assert_eq!(
                HeadingUnit::read(heading).map(|unit| unit.map(HeadingUnit::symbol)),
                Ok(Some(symbol)),
                "{heading}"
            );
        }
    }

    #[test]
    fn headings_that_cannot_be_read_are_refused() {
        for (heading, unknown) in [
            ("lift (furlong)", "furlong"),
            ("lift in furlongs", "furlongs"),
            ("Hub [Elle]", "Elle"),
            ("lift dmm", "dmm"),
            ("lift/dmm", "dmm"),
            ("Ventilhub Linien", "Linien"),
            ("s u", "u"),
            ("lift valve zll", "zll"),
        ] {
            assert_eq!(HeadingUnit::read(heading), Err(UnclearHeading::Unknown(unknown.to_owned())), "{heading}");
        }
        for heading in FACTORS {
            assert!(matches!(HeadingUnit::read(heading), Err(UnclearHeading::Factor(_))), "{heading}");
        }
        for heading in COUNTED {
            assert!(matches!(HeadingUnit::read(heading), Err(UnclearHeading::Counts(_))), "{heading}");
        }
        for (heading, symbol) in
            [("lift raw (mm)", "mm"), ("raw lift mm", "mm"), ("lift 2 mm", "mm"), ("lift of 1998, mm", "mm")]
        {
            assert_eq!(
                HeadingUnit::read(heading).map(|unit| unit.map(HeadingUnit::symbol)),
                Ok(Some(symbol)),
                "{heading}"
            );
        }
        assert_eq!(derivative_in("Velocity"), Some("velocity"));
        assert_eq!(derivative_in("lift"), None);
        for heading in NAMED {
            assert_eq!(HeadingUnit::read(heading), Ok(None), "{heading}");
        }
        assert_eq!(HeadingUnit::in_heading("s").map(HeadingUnit::symbol), Some("s"));
        assert!(
            is_radius("radius_mm")
                && is_radius("R [mm]")
                && is_radius("pitch radius")
                && !is_radius("lift (roller radius 20)")
        );
        assert!(is_of_crank("crank deg") && is_of_crank("°CA") && !is_of_crank("cam deg"));
    }
}

//! Tolerance classes of holes and of the width of keyways: ISO 286-1:2010, tables 1 to 3.

use camgen_kernel::document::{Field, TableReader};
use std::fmt;
use std::str::FromStr;

/// A tolerance class of a hole, such as H7.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HoleFit {
    letter: Letter,
    /// Standard tolerance grade, 5 to 11.
    grade: u8,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Letter {
    D,
    E,
    F,
    G,
    H,
    Js,
    K,
    M,
    N,
    P,
}

const LETTERS: [(&str, Letter); 10] = [
    ("JS", Letter::Js),
    ("D", Letter::D),
    ("E", Letter::E),
    ("F", Letter::F),
    ("G", Letter::G),
    ("H", Letter::H),
    ("K", Letter::K),
    ("M", Letter::M),
    ("N", Letter::N),
    ("P", Letter::P),
];

/// What a text must be, for messages.
pub const KNOWN: &str = "D, E, F, G, H or JS with a grade of 5 to 11, such as H7, or K7, M7, N7, P7, N9, P9";

/// Ends of the ranges of nominal sizes, mm.
const RANGES: [f64; 13] = [3.0, 6.0, 10.0, 18.0, 30.0, 50.0, 80.0, 120.0, 180.0, 250.0, 315.0, 400.0, 500.0];
/// Standard tolerances IT5 to IT11, µm, for each range: table 1.
const TOLERANCES: [[f64; 13]; 7] = [
    [4.0, 5.0, 6.0, 8.0, 9.0, 11.0, 13.0, 15.0, 18.0, 20.0, 23.0, 25.0, 27.0],
    [6.0, 8.0, 9.0, 11.0, 13.0, 16.0, 19.0, 22.0, 25.0, 29.0, 32.0, 36.0, 40.0],
    [10.0, 12.0, 15.0, 18.0, 21.0, 25.0, 30.0, 35.0, 40.0, 46.0, 52.0, 57.0, 63.0],
    [14.0, 18.0, 22.0, 27.0, 33.0, 39.0, 46.0, 54.0, 63.0, 72.0, 81.0, 89.0, 97.0],
    [25.0, 30.0, 36.0, 43.0, 52.0, 62.0, 74.0, 87.0, 100.0, 115.0, 130.0, 140.0, 155.0],
    [40.0, 48.0, 58.0, 70.0, 84.0, 100.0, 120.0, 140.0, 160.0, 185.0, 210.0, 230.0, 250.0],
    [60.0, 75.0, 90.0, 110.0, 130.0, 160.0, 190.0, 220.0, 250.0, 290.0, 320.0, 360.0, 400.0],
];
/// Lower deviations of D to G, µm: table 2.
const D: [f64; 13] = [20.0, 30.0, 40.0, 50.0, 65.0, 80.0, 100.0, 120.0, 145.0, 170.0, 190.0, 210.0, 230.0];
const E: [f64; 13] = [14.0, 20.0, 25.0, 32.0, 40.0, 50.0, 60.0, 72.0, 85.0, 100.0, 110.0, 125.0, 135.0];
const F: [f64; 13] = [6.0, 10.0, 13.0, 16.0, 20.0, 25.0, 30.0, 36.0, 43.0, 50.0, 56.0, 62.0, 68.0];
const G: [f64; 13] = [2.0, 4.0, 5.0, 6.0, 7.0, 9.0, 10.0, 12.0, 14.0, 15.0, 17.0, 18.0, 20.0];
/// Upper deviations in grade 7, µm: table 3 with its Δ.
const K7: [f64; 13] = [0.0, 3.0, 5.0, 6.0, 6.0, 7.0, 9.0, 10.0, 12.0, 13.0, 16.0, 17.0, 18.0];
const M7: [f64; 13] = [-2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
const N7: [f64; 13] = [-4.0, -4.0, -4.0, -5.0, -7.0, -8.0, -9.0, -10.0, -12.0, -14.0, -14.0, -16.0, -17.0];
const P7: [f64; 13] = [-6.0, -8.0, -9.0, -11.0, -14.0, -17.0, -21.0, -24.0, -28.0, -33.0, -36.0, -41.0, -45.0];
/// Upper deviations in grade 9, µm: table 3.
const N9: [f64; 13] = [-4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
const P9: [f64; 13] = [-6.0, -12.0, -15.0, -18.0, -22.0, -26.0, -32.0, -37.0, -43.0, -50.0, -56.0, -62.0, -68.0];
const H: [f64; 13] = [0.0; 13];
const FIRST_GRADE: u8 = 5;
const MICROMETRE: f64 = 1e-6;

/// Which of the two deviations of a class is tabulated.
enum Tabulated {
    Lower(&'static [f64; 13]),
    Upper(&'static [f64; 13]),
    Symmetric,
}

/// The range of a nominal size, m: 18 mm as 0.018 m is at most 18 mm.
fn range_of(size: f64) -> Option<usize> {
    const ROUNDING: f64 = 1e-12;
    RANGES.iter().position(|end| 1e3 * size <= end * (1.0 + ROUNDING))
}

/// The standard tolerance of a grade (5 to 11) at a size, m; `None` above 500 mm.
#[must_use]
pub fn standard_tolerance(grade: u8, size: f64) -> Option<f64> {
    let range = range_of(size)?;
    Some(MICROMETRE * TOLERANCES.get(usize::from(grade.checked_sub(FIRST_GRADE)?))?.get(range)?)
}

impl HoleFit {
    /// Its limits of size relative to a nominal size (m), lower and upper, m; `None` above 500 mm.
    #[must_use]
    pub fn deviations(self, size: f64) -> Option<[f64; 2]> {
        let range = range_of(size)?;
        let tolerance = standard_tolerance(self.grade, size)? / MICROMETRE;
        let [low, high] = match self.tabulated()? {
            Tabulated::Lower(low) => [low[range], low[range] + tolerance],
            Tabulated::Upper(high) => [high[range] - tolerance, high[range]],
            Tabulated::Symmetric => [-0.5 * tolerance, 0.5 * tolerance],
        };
        Some([MICROMETRE * low, MICROMETRE * high])
    }

    fn tabulated(self) -> Option<Tabulated> {
        Some(match (self.letter, self.grade) {
            (Letter::D, _) => Tabulated::Lower(&D),
            (Letter::E, _) => Tabulated::Lower(&E),
            (Letter::F, _) => Tabulated::Lower(&F),
            (Letter::G, _) => Tabulated::Lower(&G),
            (Letter::H, _) => Tabulated::Lower(&H),
            (Letter::Js, _) => Tabulated::Symmetric,
            (Letter::K, 7) => Tabulated::Upper(&K7),
            (Letter::M, 7) => Tabulated::Upper(&M7),
            (Letter::N, 7) => Tabulated::Upper(&N7),
            (Letter::P, 7) => Tabulated::Upper(&P7),
            (Letter::N, 9) => Tabulated::Upper(&N9),
            (Letter::P, 9) => Tabulated::Upper(&P9),
            (Letter::K | Letter::M | Letter::N | Letter::P, _) => return None,
        })
    }
}

/// The tolerance class that a key gives.
pub(super) fn read(table: &TableReader<'_>, field: &Field<String>) -> Option<HoleFit> {
    let text = table.get(field)?;
    text.parse().map_err(|why| table.fail(field, why, Some(format!("give {KNOWN}")))).ok()
}

impl FromStr for HoleFit {
    type Err = String;

    /// Reads a class; the message says which are known.
    fn from_str(text: &str) -> Result<Self, String> {
        let unknown = || format!("`{text}` is not a known tolerance class of a hole");
        let upper = text.trim().to_ascii_uppercase();
        let (letter, grade) = LETTERS
            .iter()
            .find_map(|(name, letter)| Some((*letter, upper.strip_prefix(name)?.parse::<u8>().ok()?)))
            .ok_or_else(unknown)?;
        if text.starts_with(|first: char| first.is_ascii_lowercase()) {
            return Err(format!("`{text}` is a class of a shaft; a hole has capital letters"));
        }
        let fit = Self { letter, grade };
        let is_known = (FIRST_GRADE..=11).contains(&grade) && fit.tabulated().is_some();
        if is_known { Ok(fit) } else { Err(unknown()) }
    }
}

impl fmt::Display for HoleFit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = LETTERS.iter().find(|(_, letter)| *letter == self.letter).map_or("", |(name, _)| name);
        write!(f, "{name}{}", self.grade)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values as printed by others: Misumi's tables for determining metric tolerances (table 6, holes), and of keyways the table of Siemens
    /// MD 10.1 (2015), both after ISO 286-2.
    #[test]
    fn classes_have_their_printed_limits() {
        let known = [
            ("H7", 3.0, 0.0, 10.0),
            ("H7", 6.0, 0.0, 12.0),
            ("H7", 10.0, 0.0, 15.0),
            ("H7", 18.0, 0.0, 18.0),
            ("H7", 30.0, 0.0, 21.0),
            ("H7", 50.0, 0.0, 25.0),
            ("H7", 80.0, 0.0, 30.0),
            ("H7", 120.0, 0.0, 35.0),
            ("H7", 180.0, 0.0, 40.0),
            ("H7", 250.0, 0.0, 46.0),
            ("H11", 5.0, 0.0, 75.0),
            ("H11", 24.0, 0.0, 130.0),
            ("H11", 40.0, 0.0, 160.0),
            ("H11", 75.0, 0.0, 190.0),
            ("H11", 110.0, 0.0, 220.0),
            ("H11", 170.0, 0.0, 250.0),
            ("K7", 2.0, -10.0, 0.0),
            ("K7", 4.0, -9.0, 3.0),
            ("K7", 8.0, -10.0, 5.0),
            ("K7", 16.0, -12.0, 6.0),
            ("K7", 20.0, -15.0, 6.0),
            ("K7", 40.0, -18.0, 7.0),
            ("K7", 65.0, -21.0, 9.0),
            ("K7", 100.0, -25.0, 10.0),
            ("K7", 150.0, -28.0, 12.0),
            ("K7", 200.0, -33.0, 13.0),
            ("M7", 2.0, -12.0, -2.0),
            ("M7", 24.0, -21.0, 0.0),
            ("M7", 90.0, -35.0, 0.0),
            ("M7", 200.0, -46.0, 0.0),
            ("N7", 2.0, -14.0, -4.0),
            ("N7", 5.0, -16.0, -4.0),
            ("N7", 9.0, -19.0, -4.0),
            ("N7", 12.0, -23.0, -5.0),
            ("N7", 25.0, -28.0, -7.0),
            ("N7", 45.0, -33.0, -8.0),
            ("N7", 70.0, -39.0, -9.0),
            ("N7", 105.0, -45.0, -10.0),
            ("N7", 160.0, -52.0, -12.0),
            ("N7", 225.0, -60.0, -14.0),
            ("JS7", 25.0, -10.5, 10.5),
            ("JS7", 90.0, -17.5, 17.5),
            ("JS9", 3.0, -12.5, 12.5),
            ("JS9", 6.0, -15.0, 15.0),
            ("JS9", 10.0, -18.0, 18.0),
            ("JS9", 18.0, -21.5, 21.5),
            ("JS9", 28.0, -26.0, 26.0),
            ("JS9", 50.0, -31.0, 31.0),
            ("JS9", 80.0, -37.0, 37.0),
            ("P9", 3.0, -31.0, -6.0),
            ("P9", 6.0, -42.0, -12.0),
            ("P9", 8.0, -51.0, -15.0),
            ("P9", 16.0, -61.0, -18.0),
            ("P9", 20.0, -74.0, -22.0),
            ("P9", 45.0, -88.0, -26.0),
            ("P9", 70.0, -106.0, -32.0),
            ("P9", 100.0, -124.0, -37.0),
        ];
        for (class, size, low, high) in known {
            let fit: HoleFit = class.parse().expect(class);
            assert_eq!(fit.to_string(), class);
            let [found_low, found_high] = fit.deviations(1e-3 * size).expect("a size of the table");
            assert!(
                (1e6 * found_low - low).abs() < 1e-9 && (1e6 * found_high - high).abs() < 1e-9,
                "{class} at {size}"
            );
        }
        let h7: HoleFit = "H7".parse().expect("H7");
        assert_eq!(h7.deviations(0.5001), None);
        for wrong in ["H4", "H12", "K6", "Z7", "H", "7", "", "H7/g6"] {
            assert!(wrong.parse::<HoleFit>().is_err(), "{wrong}");
        }
        assert!("h7".parse::<HoleFit>().expect_err("a shaft").contains("shaft"));
    }
}

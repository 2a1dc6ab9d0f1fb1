//! The style of every picture of an analysis: colours, sizes of texts, ticks and digits. A picture is data; how it looks is decided here.
//!
//! The eight colours of lines stay apart for normal and colour-blind eyes and in grey. Red is only for limits and failures, amber only for what is
//! chosen.

use super::trace::round_step;

/// Sizes of texts over that of the lettering of a picture, mm.
pub(super) const TITLE: f64 = 5.4;
pub(super) const SUBTITLE: f64 = 3.5;
pub(super) const NAME: f64 = 3.2;
pub(super) const TEXT: f64 = 3.0;
pub(super) const SMALL: f64 = 2.7;

/// A colour of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PictureColour {
    /// One of the eight for lines, from 0; further ones begin again.
    Line(usize),
    /// What a line is compared with.
    #[default]
    Grey,
    /// A limit, or what breaks it.
    Limit,
    /// What is chosen.
    Chosen,
    /// As a text.
    Ink,
}

/// A colour for lines, for texts and for areas.
struct ColourShades {
    line: &'static str,
    text: &'static str,
    tint: &'static str,
}

const fn shades(line: &'static str, text: &'static str, tint: &'static str) -> ColourShades {
    ColourShades { line, text, tint }
}

/// Gold is too light for a text.
const LINES: [ColourShades; 8] = [
    shades("#372cbf", "#372cbf", "#dddbf4"),
    shades("#b38b1b", "#7d6008", "#f2ebd8"),
    shades("#6c0a40", "#6c0a40", "#e6d5df"),
    shades("#126b76", "#126b76", "#d7e6e8"),
    shades("#4188c0", "#2c6a9b", "#dfebf4"),
    shades("#ab5959", "#934444", "#f1e3e3"),
    shades("#595704", "#595704", "#e3e2d4"),
    shades("#142e02", "#142e02", "#d7dbd4"),
];
const GREY: ColourShades = shades("#98a2ac", "#4a5562", "#eceef0");
const LIMIT: ColourShades = shades("#b3261e", "#b3261e", "#f8e4e2");
const CHOSEN: ColourShades = shades("#ffb000", "#12171d", "#ffefcc");
const INK: ColourShades = shades("#12171d", "#12171d", "#d5dae0");

impl PictureColour {
    const fn shades(self) -> &'static ColourShades {
        match self {
            // The remainder is below the length.
            Self::Line(index) => &LINES[index % LINES.len()],
            Self::Grey => &GREY,
            Self::Limit => &LIMIT,
            Self::Chosen => &CHOSEN,
            Self::Ink => &INK,
        }
    }

    /// Of a line, as SVG has it.
    #[must_use]
    pub const fn line(self) -> &'static str {
        self.shades().line
    }

    /// Of a text about it, readable on white.
    #[must_use]
    pub const fn text(self) -> &'static str {
        self.shades().text
    }

    /// Of an area behind lines.
    #[must_use]
    pub const fn tint(self) -> &'static str {
        self.shades().tint
    }
}

/// Significant digits of a figure in a picture.
const DIGITS: i32 = 4;
/// Smaller sizes than this are rounding, and larger ones need an exponent.
const ROUNDING: f64 = 1e-9;
const LARGEST: f64 = 1e7;
const LEAST: f64 = 1e-4;

/// A figure of a picture: four significant digits, a true minus, thousands apart from 10 000 on.
#[must_use]
pub fn figure(value: f64) -> String {
    let size = value.abs();
    if !size.is_finite() {
        return "–".into();
    }
    if size < ROUNDING {
        return "0".into();
    }
    let sign = if value < 0.0 { "−" } else { "" };
    if !(LEAST..LARGEST).contains(&size) {
        return sign.to_owned() + &super::shown(size);
    }
    #[expect(clippy::cast_possible_truncation, reason = "between -4 and 7")]
    let magnitude = libm::log10(size).floor() as i32;
    let decimals = DIGITS - 1 - magnitude;
    let scale = libm::pow(10.0, f64::from(decimals));
    let text = if decimals > 0 {
        format!("{}", (size * scale).round() / scale)
    } else {
        format!("{:.0}", (size / libm::pow(10.0, f64::from(-decimals))).round() * libm::pow(10.0, f64::from(-decimals)))
    };
    sign.to_owned() + &apart(&text)
}

/// The thousands of a number of five and more digits before its point, apart.
fn apart(number: &str) -> String {
    let (whole, rest) = number.find('.').map_or((number, ""), |point| number.split_at(point));
    if whole.len() < 5 {
        return number.to_owned();
    }
    let mut text = String::new();
    for (index, digit) in whole.chars().enumerate() {
        if index > 0 && (whole.len() - index).is_multiple_of(3) {
            text.push('\u{a0}');
        }
        text.push(digit);
    }
    text + rest
}

/// Round values within a range, at most so many.
#[must_use]
pub fn ticks(range: (f64, f64), most: f64) -> Vec<f64> {
    let (low, high) = range;
    if !(high > low && (high - low).is_finite()) {
        return Vec::new();
    }
    let step = round_step(high - low, most);
    let (mut index, mut all) = ((low / step - 1e-9).ceil(), Vec::new());
    while index * step <= high + 1e-9 * step {
        all.push(index * step + 0.0);
        index += 1.0;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_four_digits() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (3185.75, "3186"),
            (21_288.1, "21\u{a0}290"),
            (-1_234_567.0, "−1\u{a0}235\u{a0}000"),
            (29.9962, "30"),
            (0.123_456, "0.1235"),
            (9.999_96, "10"),
            (99_996.0, "100\u{a0}000"),
            (1.2e-7, "1.2·10⁻⁷"),
            (f64::NAN, "–"),
        ] {
            assert_eq!(figure(value), text, "{value}");
        }
    }

    #[test]
    fn ticks_are_round_and_within() {
        assert_eq!(ticks((0.0, 5200.0), 6.0), [0.0, 1000.0, 2000.0, 3000.0, 4000.0, 5000.0]);
        assert_eq!(ticks((-0.3, 0.31), 4.0), [-0.2, 0.0, 0.2]);
        assert!(ticks((1.0, 1.0), 5.0).is_empty() && ticks((0.0, f64::NAN), 5.0).is_empty());
    }

    /// Contrast of texts with white by WCAG, at least 4.5.
    #[test]
    fn texts_are_readable_on_white() {
        let linear = |byte: u8| {
            let share = f64::from(byte) / 255.0;
            if share <= 0.03928 { share / 12.92 } else { libm::pow((share + 0.055) / 1.055, 2.4) }
        };
        let all = (0..8).map(PictureColour::Line).chain([PictureColour::Grey, PictureColour::Limit]);
        for colour in all {
            let parts = [1, 3, 5].map(|at| u8::from_str_radix(&colour.text()[at..at + 2], 16).expect("hex"));
            let [red, green, blue] = parts.map(linear);
            let light = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
            assert!(1.05 / (light + 0.05) > 4.5, "{colour:?}");
        }
    }
}

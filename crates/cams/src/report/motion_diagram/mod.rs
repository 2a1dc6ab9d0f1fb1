//! The motion diagram: what a cam does over its turn or its travel, one quantity below the other over a common axis, on a sheet of its own.
//!
//! A body says what is shown ([`MotionDiagram`]); [`sheet`] places it on paper.

mod clipped;
mod compose;
mod labels;
mod notes;
mod panel;

use camgen_kernel::units::LengthUnit;
pub use compose::sheet;

use super::sheet::rounded;
use super::shown;

/// Places and values of a curve that is smooth between its ends, in the order of the places.
pub type DiagramRun = Vec<[f64; 2]>;

/// A stretch of the motion with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct DiagramSegment {
    /// Its number in the order of the motion, from 1 on: one that goes over the end of the axis is shown in two parts.
    pub number: usize,
    /// First and last place.
    pub range: (f64, f64),
    /// Its name.
    pub name: String,
    /// How the follower moves in it: "0 to 30 mm".
    pub travel: String,
}

/// A largest or a least value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiagramExtreme {
    /// Where it is.
    pub place: f64,
    /// The value; of a radius of curvature the smallest convex or, negative, the smallest concave one.
    pub value: f64,
    /// Upwards: the largest value, or the sharpest convex place.
    pub upwards: bool,
    /// Of the whole diagram, not only of a segment.
    pub overall: bool,
}

/// A place at which a value is infinite for an instant, because what it is the derivative of jumps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impulse {
    /// Where it is.
    pub place: f64,
    /// Whether it is positive.
    pub upwards: bool,
}

/// A quantity over the common axis.
#[derive(Debug, Clone, PartialEq)]
pub struct DiagramPanel {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// The column of the table that has its values, and the factor of these.
    pub column: (&'static str, f64),
    /// A radius of curvature: it goes through infinity where a curve is straight.
    pub radius: bool,
    /// The values by the motion.
    pub law: Vec<DiagramRun>,
    /// The values on the outline as written, where the difference can be seen.
    pub cut: Vec<DiagramRun>,
    /// Largest and least values.
    pub extremes: Vec<DiagramExtreme>,
    /// Where it is infinite for an instant.
    pub impulses: Vec<Impulse>,
}

/// Everything that a motion diagram shows.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionDiagram {
    /// What the places are, with their unit.
    pub places: &'static str,
    /// Places are degrees of a turn, not millimetres of a travel.
    pub turns: bool,
    /// The unit of its lengths.
    pub units: LengthUnit,
    /// First and last place.
    pub range: (f64, f64),
    /// The stretches of the motion, in the order of the places.
    pub segments: Vec<DiagramSegment>,
    /// The quantities, from the top.
    pub panels: Vec<DiagramPanel>,
    /// What the reader should know, a sentence each.
    pub notes: Vec<String>,
}

impl MotionDiagram {
    /// A place as a label has it.
    pub(super) fn place(&self, place: f64) -> String {
        let rounded = |decimals: f64| (place * decimals).round() / decimals + 0.0;
        match (self.turns, self.units) {
            (true, _) => format!("{:.2}°", rounded(100.0)),
            (false, LengthUnit::Millimetre) => format!("x = {:.3} mm", rounded(1000.0)),
            (false, LengthUnit::Inch) => format!("x = {:.4} in", rounded(1e4)),
        }
    }

    /// The label of an extreme of a panel.
    #[must_use]
    pub fn words(&self, panel: &DiagramPanel, extreme: &DiagramExtreme) -> String {
        let DiagramExtreme { place, value, upwards, overall } = *extreme;
        let kind = match (overall, panel.radius, upwards) {
            (false, ..) => "",
            (true, false, true) => "max ",
            (true, false, false) => "min ",
            (true, true, true) => "least convex ",
            (true, true, false) => "least concave ",
        };
        let value = if panel.radius { value.abs() } else { value };
        format!("{kind}{} at {}", figure(value), self.place(place))
    }
}

/// Significant digits of a figure in a diagram.
const DIGITS: f64 = 5.0;

/// A figure with five significant digits, without trailing zeros.
#[must_use]
pub fn figure(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return rounded(value);
    }
    let decade = libm::log10(value.abs()).floor();
    if !(-5.0..6.0).contains(&decade) {
        return shown(value);
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 9")]
    let decimals = (DIGITS - 1.0 - decade).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::figure;

    #[test]
    fn figures_have_five_digits() {
        for (value, text) in [
            (0.0, "0"),
            (30.0, "30"),
            (-0.012_345_6, "-0.012346"),
            (1234.56, "1234.6"),
            (99_999.96, "100000"),
            (123_456.7, "123457"),
            (1.234_56e7, "12345600"),
            (1e-7, "1.0·10⁻⁷"),
        ] {
            assert_eq!(figure(value), text);
        }
    }
}

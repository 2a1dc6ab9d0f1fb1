//! Polynomial laws, and the polynomial of given conditions at both ends.

use super::bernstein::Bernstein;
use super::curve::{CurvePart, LawCurve};
use super::law::{Law, LawFamily};
use super::task::LawTask;

/// The polynomial of least degree with given values s, s', s'', … at x = 0 and at x = 1, in units of the segment's width.
///
/// `from` and `to` hold the value first, then as many derivatives as are given: n values in all make the degree n − 1. A list
/// without a value is taken as the value 0.
#[must_use]
pub fn hermite(from: &[f64], to: &[f64]) -> LawCurve {
    let [from, to] = [from, to].map(|list| if list.is_empty() { &[0.0][..] } else { list });
    LawCurve::smooth(CurvePart::Polynomial(Bernstein::hermite(from, to)))
}

/// The curve with this number of conditions at each end: value, velocity, and 0 for every further derivative.
pub(super) fn solve(conditions: usize, task: &LawTask) -> LawCurve {
    let mut ends = [(0.0, task.from), (1.0, task.to)].map(|(value, end)| vec![value, end.velocity()]);
    for end in &mut ends {
        end.resize(conditions, 0.0);
    }
    let [from, to] = &ends;
    hermite(from, to)
}

const fn law(
    name: &'static str,
    aliases: &'static [&'static str],
    formula: &'static str,
    continuity: u32,
    shape: LawFamily,
) -> Law {
    Law { name, aliases, formula, continuity, shape }
}

pub(super) const CONSTANT_VELOCITY: Law = law("constant-velocity", &["line", "poly1"], "x", 0, LawFamily::Line);
pub(super) const CUBIC: Law = law("cubic", &["2-3"], "3 x^2 - 2 x^3", 1, LawFamily::Polynomial(2));
pub(super) const QUINTIC: Law = law("3-4-5", &["poly5"], "10 x^3 - 15 x^4 + 6 x^5", 2, LawFamily::Polynomial(3));
pub(super) const SEPTIC: Law =
    law("4-5-6-7", &["poly7"], "35 x^4 - 84 x^5 + 70 x^6 - 20 x^7", 3, LawFamily::Polynomial(4));
pub(super) const NONIC: Law =
    law("5-6-7-8-9", &["poly9"], "126 x^5 - 420 x^6 + 540 x^7 - 315 x^8 + 70 x^9", 4, LawFamily::Polynomial(5));

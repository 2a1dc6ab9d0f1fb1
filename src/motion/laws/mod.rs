//! Laws of motion between two rests: s from 0 to 1 over x from 0 to 1, with three derivatives by x.
//!
//! A law knows x and nothing else: no angles, no followers. A new law is a file and one line in [`LAWS`].

mod cycloidal;
mod harmonic;
mod modified_sine;
mod polynomial;

/// s, s', s'', s''' at x.
pub type Values = [f64; 4];

/// A law of motion.
#[derive(Debug)]
pub struct Law {
    /// Its name in files and code.
    pub name: &'static str,
    /// Its formula, for a list.
    pub formula: &'static str,
    /// How many of its derivatives are continuous between two rests.
    pub continuity: u32,
    /// Its values at x in [0, 1].
    pub at: fn(f64) -> Values,
}

/// Every law.
pub const LAWS: &[Law] =
    &[cycloidal::LAW, modified_sine::LAW, harmonic::LAW, polynomial::CUBIC, polynomial::QUINTIC, polynomial::SEPTIC];

/// Below this t − sin t is summed as a series: there the closed form has lost four bits.
const SERIES_LIMIT: f64 = 0.6;

/// t − sin t for t ≥ 0 without cancellation at small t.
fn turn_minus_sine(t: f64) -> f64 {
    if t > SERIES_LIMIT {
        return t - libm::sin(t);
    }
    let square = t * t;
    let (mut term, mut sum, mut n) = (t * square / 6.0, 0.0, 3.0);
    while term.abs() > f64::EPSILON * f64::abs(sum) {
        sum += term;
        term *= -square / ((n + 1.0) * (n + 2.0));
        n += 2.0;
    }
    sum
}

/// The law with this name.
#[must_use]
pub fn named(name: &str) -> Option<&'static Law> {
    LAWS.iter().find(|law| law.name.eq_ignore_ascii_case(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From 0 to 1 without a jump of what it says is continuous, symmetric about the middle, each derivative that of the one
    /// before.
    #[test]
    fn every_law_rises_from_rest_to_rest() {
        let h = 1e-3;
        for law in LAWS {
            let (start, end) = ((law.at)(0.0), (law.at)(1.0));
            assert!(start[0].abs() < 1e-16 && (end[0] - 1.0).abs() < 1e-15, "{}: {start:?} {end:?}", law.name);
            // Of the derivatives in a row: behind one that jumps the next may well be 0 at both ends.
            let rests = |order: &usize| start[*order].abs().max(end[*order].abs()) < 1e-9;
            let continuous = (1..4).take_while(rests).count();
            assert_eq!(u32::try_from(continuous).expect("small"), law.continuity, "{}: {start:?} {end:?}", law.name);
            for i in 0..=50 {
                let x = f64::from(i) / 50.0;
                let (here, mirrored) = ((law.at)(x), (law.at)(1.0 - x));
                for (a, b) in [(here[0], 1.0 - mirrored[0]), (here[1], mirrored[1]), (here[2], -mirrored[2])] {
                    assert!((a - b).abs() < 1e-12, "{} at {x}", law.name);
                }
                let inside = x.clamp(2.0 * h, 1.0 - 2.0 * h);
                let at = |n: f64| (law.at)(inside + n * h);
                for order in 0..3 {
                    let by_difference =
                        (8.0 * (at(1.0)[order] - at(-1.0)[order]) - (at(2.0)[order] - at(-2.0)[order])) / (12.0 * h);
                    let exact = at(0.0)[order + 1];
                    // Fourth order in h: sixth derivatives of up to 1e5 leave 1e5 h⁴/30.
                    assert!((exact - by_difference).abs() < 1e-7, "{} at {x}: {exact} {by_difference}", law.name);
                }
            }
        }
    }

    /// Peaks and values known in closed form.
    #[test]
    fn known_values() {
        let at = |name: &str, x: f64| (named(name).expect(name).at)(x);
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-13, "{a} {b}");
        near(at("cycloidal", 0.25)[2], std::f64::consts::TAU);
        near(at("harmonic", 0.0)[2], 0.5 * std::f64::consts::PI * std::f64::consts::PI);
        for (value, golden) in at("4-5-6-7", 0.3).into_iter().zip([0.126_036, 1.296_54, 7.4088, -8.82]) {
            near(value, golden);
        }
        let golden = [0.010_697_212_791_433_88, 0.303_964_009_083_588_9, 5.257_399_593_740_826, 21.466_284_939_537_8];
        for (value, golden) in at("modified-sine", 0.1).into_iter().zip(golden) {
            near(value, golden);
        }
        near(at("3-4-5", 0.5)[1], 1.875);
        near(at("cubic", 0.5)[1], 1.5);
        assert!(named("no such law").is_none());
    }
}

//! Laws of motion: the shape s(x) of a segment, from 0 to 1 over x from 0 to 1, with derivatives of any order.
//!
//! A law knows x and nothing else: no angles, no followers. [`Law::solve`] makes the [`Curve`] for the ends of a segment: at
//! rest, moving with a constant velocity, or at a turn. A new law is a constant in the file of its family and one line in
//! [`LAWS`].

mod bernstein;
mod curve;
mod entire;
mod expressed;
mod halves;
mod harmonics;
mod local;
pub mod optimum;
mod peaks;
pub mod polynomial;
mod ramps;
mod rests;
mod sines;
mod spectrum;
pub mod spline;
mod task;
#[cfg(test)]
mod tests;

pub use curve::{Curve, Values};
pub use entire::{expressed, series};
pub use peaks::Peaks;
pub use spectrum::Spectrum;
pub(in crate::motion) use spectrum::residual_peak;
pub use task::{End, Inflection, LawError, Parameters, Task};

/// How a law is solved: the families.
#[derive(Debug, Clone, Copy)]
enum Shape {
    /// The straight line.
    Line,
    /// So many conditions at each end.
    Polynomial(usize),
    /// Two halves.
    Halves(fn(&Parameters) -> Result<halves::Half, LawError>),
    /// Sines over the whole segment.
    Sines(fn(&Parameters) -> Result<sines::Sines, LawError>),
    /// From rest to a turn only.
    DoubleHarmonic,
}

/// A law of motion.
#[derive(Debug)]
pub struct Law {
    /// Its name in files and code.
    pub name: &'static str,
    /// Other names of it.
    pub aliases: &'static [&'static str],
    /// Its formula between rests, for a list.
    pub formula: &'static str,
    /// How many of its derivatives are continuous between two rests: with all but special parameters.
    pub continuity: u32,
    shape: Shape,
}

/// Every law.
pub const LAWS: &[Law] = &[
    halves::CYCLOIDAL,
    halves::MODIFIED_SINE,
    halves::HARMONIC,
    polynomial::CUBIC,
    polynomial::QUINTIC,
    polynomial::SEPTIC,
    polynomial::NONIC,
    halves::MODIFIED_TRAPEZOID,
    halves::MODIFIED_SINE_CV20,
    halves::MODIFIED_SINE_CV33,
    halves::MODIFIED_SINE_CV50,
    halves::MODIFIED_SINE_CV66,
    halves::CYCLOIDAL_CV50,
    halves::SCCA,
    halves::PARABOLA,
    halves::PARABOLA_LINE,
    halves::SINE_LINE,
    ramps::S_CURVE,
    ramps::CONSTANT_JERK,
    sines::GUTMAN,
    sines::FREUDENSTEIN_1_3,
    sines::FREUDENSTEIN_1_3_5,
    sines::TRIPLE_HARMONIC,
    sines::DOUBLE_HARMONIC,
    polynomial::CONSTANT_VELOCITY,
];

/// The straight line.
pub const LINE: &str = polynomial::CONSTANT_VELOCITY.name;

/// A velocity, in units of travel over width, that differs from another by less is the same.
const SAME_VELOCITY: f64 = 1e-9;

/// The law with this name or alias, in any case.
#[must_use]
pub fn named(name: &str) -> Option<&'static Law> {
    LAWS.iter().find(|law| std::iter::once(&law.name).chain(law.aliases).any(|own| own.eq_ignore_ascii_case(name)))
}

impl Law {
    /// Whether it has a curve between such ends.
    #[must_use]
    pub fn serves(&self, from: End, to: End) -> bool {
        let turns = from == End::Turn || to == End::Turn;
        let (v0, v1) = (from.velocity(), to.velocity());
        let equal = (v0 - v1).abs() <= SAME_VELOCITY;
        match self.shape {
            Shape::Halves(_) => true,
            Shape::Polynomial(_) => !turns,
            Shape::Sines(_) => !turns && equal,
            Shape::Line => !turns && equal && (v0 - 1.0).abs() <= SAME_VELOCITY,
            Shape::DoubleHarmonic => matches!((from, to), (End::Rest, End::Turn) | (End::Turn, End::Rest)),
        }
    }

    /// Whether it leads from rest to rest.
    #[must_use]
    pub fn serves_rests(&self) -> bool {
        self.serves(End::Rest, End::Rest)
    }

    /// Its curve for the ends, the inflection and the parameters of a task.
    ///
    /// # Errors
    /// [`LawError`] when the law has no curve between such ends, or no such inflection; and when a number is out of its range.
    pub fn solve(&self, task: &Task) -> Result<Curve, LawError> {
        check_finite(task)?;
        let &Task { from, to, inflection, ref parameters } = task;
        if !self.serves(from, to) {
            let others = LAWS.iter().filter(|law| law.serves(from, to)).map(|law| law.name).collect();
            return Err(LawError::CannotServe { law: self.name, from, to, others });
        }
        if let Shape::Halves(half) = self.shape {
            return halves::solve(self.name, half(parameters)?, task);
        }
        if inflection != Inflection::Smooth {
            return Err(LawError::NoInflection { law: self.name });
        }
        match self.shape {
            Shape::Polynomial(conditions) => Ok(polynomial::solve(conditions, task)),
            Shape::Sines(sines) => Ok(sines::solve(sines(parameters)?, from.velocity())),
            Shape::DoubleHarmonic => Ok(sines::double_harmonic(from)),
            Shape::Line | Shape::Halves(_) => Ok(Curve::line()),
        }
    }
}

/// The velocities and accelerations of a task are numbers.
fn check_finite(task: &Task) -> Result<(), LawError> {
    let acceleration = if let Inflection::Match { acceleration } = task.inflection { acceleration } else { 0.0 };
    let numbers =
        [("a velocity", task.from.velocity()), ("a velocity", task.to.velocity()), ("an acceleration", acceleration)];
    match numbers.into_iter().find(|(_, found)| !found.is_finite()) {
        Some((what, found)) => Err(LawError::NotFinite { what, found }),
        None => Ok(()),
    }
}

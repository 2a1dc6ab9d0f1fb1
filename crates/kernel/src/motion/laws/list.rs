//! Every law, by its name, and how each family is solved.

use super::law::{Law, LawFamily};
use super::task::between;
use super::{Inflection, LawCurve, LawError, LawTask, halves, polynomial, ramps, sines};
use crate::document::similar;
use crate::refusal::Refusal;

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

/// The law with this name or alias, in any case; `None` if unknown.
#[must_use]
pub fn named(name: &str) -> Option<&'static Law> {
    LAWS.iter().find(|law| std::iter::once(&law.name).chain(law.aliases).any(|own| own.eq_ignore_ascii_case(name)))
}

/// The law with this name or alias, in any case.
///
/// ```
/// # use camgen_kernel as camgen;
/// use camgen::law;
/// use camgen::motion::laws::{LAWS, LawTask};
///
/// let cycloidal = law("cycloidal")?;
/// assert!(law("cycloidel").is_err_and(|why| why.to_string().contains("cycloidal")) && LAWS.len() > 20);
/// // From rest to rest, over a unit of travel and of angle: the largest acceleration is 2π.
/// let curve = cycloidal.solve(&LawTask::default())?;
/// assert!((curve.peaks().acceleration.value - std::f64::consts::TAU).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Refusal`] with the known names.
pub fn law(name: &str) -> Result<&'static Law, Refusal> {
    named(name).ok_or_else(|| {
        let known: Vec<&str> = LAWS.iter().map(|law| law.name).collect();
        let near = similar(name, known.iter().copied());
        let near = near.map_or(String::new(), |law| format!("did you mean {law}? It is "));
        Refusal::new(format!("there is no law {name}")).remedy(format!("{near}one of {}", known.join(", ")))
    })
}

impl Law {
    /// Its curve for the ends, the inflection and the parameters of a task.
    ///
    /// # Errors
    /// [`LawError`] when the law has no curve between such ends, or no such inflection; and when a number is out of its range.
    pub fn solve(&self, task: &LawTask) -> Result<LawCurve, LawError> {
        check_finite(task)?;
        let &LawTask { from, to, inflection, ref parameters } = task;
        if !self.serves(from, to) {
            let others: Vec<&str> = LAWS.iter().filter(|law| law.serves(from, to)).map(|law| law.name).collect();
            return Err(LawError::new("law", format!("{} cannot {}", self.name, between(from, to)))
                .remedy(format!("laws that can: {}", others.join(", "))));
        }
        if let LawFamily::Halves(half) = self.shape {
            return halves::solve(self.name, half(parameters)?, task);
        }
        if inflection != Inflection::Smooth {
            return Err(LawError::new("inflection", format!("the inflection of {} cannot be chosen", self.name))
                .remedy("only laws made of two halves allow that"));
        }
        match self.shape {
            LawFamily::Polynomial(conditions) => Ok(polynomial::solve(conditions, task)),
            LawFamily::Sines(sines) => Ok(sines::solve(sines(parameters)?, from.velocity())),
            LawFamily::DoubleHarmonic => Ok(sines::double_harmonic(from)),
            LawFamily::Line | LawFamily::Halves(_) => Ok(LawCurve::line()),
        }
    }
}

/// The velocities and accelerations of a task are numbers.
fn check_finite(task: &LawTask) -> Result<(), LawError> {
    let acceleration = if let Inflection::Match { acceleration } = task.inflection { acceleration } else { 0.0 };
    let numbers =
        [("a velocity", task.from.velocity()), ("a velocity", task.to.velocity()), ("an acceleration", acceleration)];
    match numbers.into_iter().find(|(_, found)| !found.is_finite()) {
        Some((what, found)) => Err(LawError::new("law", format!("{what} must be a finite number, not {found}"))),
        None => Ok(()),
    }
}

//! Unbalance: vectors, planes, grades and the weights that correct it.
//!
//! An unbalance is a vector U = mass × offset, kg m, in two directions that turn with the shaft. Vectors are added, not
//! lengths. V. P. Zakharov, "Norms of unbalance of grinding wheels", gives the unbalances of a wheel by their cause,
//! d = d_hole + d_faces + d_density, as vectors; when he calls the scalar of a batch normal, he errs: with normal components it
//! is Rayleigh distributed.

use camgen_kernel::refusal::Refusal;
use std::f64::consts::PI;

/// Grades G = e ω of ISO 21940-11, mm/s, each 2.5 times the one before. General machinery 6.3, drive shafts 16,
/// grinding-machine drives 1, precision spindles and gyroscopes 0.4.
pub const GRADES_MM_PER_S: [f64; 11] = [0.4, 1.0, 2.5, 6.3, 16.0, 40.0, 100.0, 250.0, 630.0, 1600.0, 4000.0];

/// Shares of one bearing plane in what a rotor may have: with the centre of mass between the bearings, and outside.
const BETWEEN: (f64, f64) = (0.3, 0.7);
const OUTSIDE: (f64, f64) = (0.3, 1.3);

/// An unbalance and its axial position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unbalance {
    /// m along the shaft.
    pub at: f64,
    /// kg m.
    pub vector: [f64; 2],
}

/// The sum, kg m: what one correction plane cancels.
#[must_use]
pub fn resultant(unbalances: &[Unbalance]) -> [f64; 2] {
    unbalances.iter().fold([0.0; 2], |[x, y], u| [x + u.vector[0], y + u.vector[1]])
}

/// The refusal of two correction planes at one position, m.
fn together(at: f64) -> Refusal {
    Refusal::new("both correction planes are").at(format!("{at} m")).remedy("they must be apart")
}

/// The same unbalance in two planes, m along the shaft: U_A = Σ U (x_B − x)/(x_B − x_A), U_B = Σ U (x − x_A)/(x_B − x_A), kg m.
///
/// # Errors
/// Both planes at one axial position.
pub fn split(unbalances: &[Unbalance], a: f64, b: f64) -> Result<[[f64; 2]; 2], Refusal> {
    let apart = b - a;
    if !(apart.abs() > 0.0 && apart.is_finite()) {
        return Err(together(a));
    }
    let mut planes = [[0.0; 2]; 2];
    for unbalance in unbalances {
        let shares = [(b - unbalance.at) / apart, (unbalance.at - a) / apart];
        for ([x, y], share) in planes.iter_mut().zip(shares) {
            *x += share * unbalance.vector[0];
            *y += share * unbalance.vector[1];
        }
    }
    Ok(planes)
}

/// U_per = G m/ω, kg m, of a grade in mm/s, a mass in kg and a speed in rad/s.
#[must_use]
pub fn permissible(grade_mm_per_s: f64, mass: f64, omega: f64) -> f64 {
    1e-3 * grade_mm_per_s * mass / omega
}

/// The finest grade, mm/s, that allows a centre of mass to run at e ω, m/s; none if that is beyond the list.
#[must_use]
pub fn grade_of(speed: f64) -> Option<f64> {
    // 6.3e-3 m/s from an e and an ω that were rounded is grade 6.3.
    GRADES_MM_PER_S.into_iter().find(|grade| 1e3 * speed <= grade * (1.0 + 1e-12))
}

/// The share of U_per that each of two bearing planes may have, by the lever rule for a centre of mass at `centre`, kept within
/// 0.3…0.7 between the planes and 0.3…1.3 outside.
///
/// # Errors
/// Both planes at one axial position.
pub fn shares(centre: f64, a: f64, b: f64) -> Result<[f64; 2], Refusal> {
    let apart = b - a;
    if !(apart.abs() > 0.0 && apart.is_finite()) {
        return Err(together(a));
    }
    let lever = [(b - centre) / apart, (centre - a) / apart];
    let between = lever.iter().all(|share| *share >= 0.0);
    let (least, most) = if between { BETWEEN } else { OUTSIDE };
    Ok(lever.map(|share| share.clamp(least, most)))
}

/// Angles, rad, at which two equal weights, kg m each, cancel an unbalance: the angle of U + π ∓ δ, cos δ = |U|/(2w).
///
/// One degree of misplacement of one of them leaves 0.0175 of it.
///
/// # Errors
/// Weights of less than half of the unbalance.
pub fn correction(unbalance: [f64; 2], weight: f64) -> Result<[f64; 2], Refusal> {
    let [x, y] = unbalance;
    let size = libm::hypot(x, y);
    let cos = 0.5 * size / weight;
    if !(weight > 0.0 && cos <= 1.0) {
        let what = format!("two weights of {weight} kg m cannot cancel an unbalance of {size} kg m");
        return Err(Refusal::new(what).remedy(format!("they must be {} kg m each", 0.5 * size)));
    }
    let (opposite, delta) = (libm::atan2(y, x) + PI, libm::acos(cos));
    Ok([opposite - delta, opposite + delta])
}

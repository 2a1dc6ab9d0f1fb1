//! Pressure between roller and cam, after Hertz.

use super::Body;
use crate::document::range::LONGEST;
use crate::follower::Element;
use crate::geometry::MILLIMETRES;
use crate::machine::{Machine, Material};
use crate::numeric::root;
use crate::profile::extremes::{self, Acting};
use crate::profile::{Curves, Worst};
use std::f64::consts::PI;

/// E* of a steel roller on a material, Pa: 1/E* = Σ (1 − ν²)/E.
fn contact_modulus(material: Material) -> f64 {
    1.0 / (1.0 / Material::Steel.contact_modulus() + 1.0 / material.contact_modulus())
}

/// The force where the motion begins, N; `None` where none is known anywhere.
fn force_at_start(body: &dyn Body, curves: Curves<'_>) -> Option<f64> {
    let (piece, start) = curves.motion.locate(curves.motion.range().0);
    body.contact_force((piece, start), &curves.contact(piece, start))
}

/// The largest pressure in the line of contact: p = √(F E*/(π b R)), 1/R = the sum of the curvatures, concave negative.
/// The roller is of steel and as wide as the cam is thick (K. L. Johnson, Contact Mechanics, 1985, §4.2).
pub(super) fn of_lines(body: &dyn Body, (curves, acting): (Curves<'_>, &[Acting]), machine: &Machine) -> Option<Worst> {
    // A knife edge touches with no radius, and any force would press without limit.
    if curves.element() == (Element::Roller { radius: 0.0 }) {
        return None;
    }
    let (width, modulus) = (machine.cam.thickness?, contact_modulus(machine.cam.material?));
    let bend = body.roller_radius().map_or(0.0, |radius| 1.0 / radius);
    let square = |piece: usize, at: f64| {
        let contact = curves.contact(piece, at);
        // On an edge (undercut) the curvature means nothing; there the check `undercut` fails.
        let curvature = (bend + contact.curve.offset_inward(curves.offset()).curvature).max(0.0);
        body.contact_force((piece, at), &contact).unwrap_or(f64::NAN) * modulus * curvature / (PI * width)
    };
    force_at_start(body, curves)?;
    let worst = super::plane(extremes::largest_smooth(curves, (acting, 0.0), square));
    Some(Worst { value: worst.value.max(0.0).sqrt(), ..worst })
}

/// The thickness at which a line of contact keeps a limit that it exceeds, as a key of the machine file: the pressure goes with
/// 1/√b. `None` where no thickness that is accepted would.
pub(super) fn thickness_for(machine: &Machine, largest: f64, limit: f64) -> Option<String> {
    let over = largest / limit;
    let thickness = (MILLIMETRES * machine.cam.thickness? * over * over).ceil();
    (thickness < MILLIMETRES * LONGEST).then(|| format!("cam.thickness = \"{thickness} mm\""))
}

/// Pressure in the middle of the ellipse where a steel sphere of a radius (m) is pressed with a force (N) onto a surface of a
/// material with the two principal curvatures (1/m, convex positive), Pa.
///
/// The sum of both curvatures is 2A in one principal direction and 2B in the other, A ≤ B. The ellipse has the half axes a ≥ b,
/// e² = 1 − b²/a² and, with the complete elliptic integrals K(e) and E(e) (K. L. Johnson, Contact Mechanics, 1985, §4.2),
///
/// ```text
/// A/B = (b/a)² (K − E)/(E − (b/a)² K),   A + B = (p/E*) E/b,   p = 3 F/(2 π a b)
/// ```
///
/// The first gives b/a, the other two b³ = 3 F (b/a) E/(2 π E* (A + B)).
pub(super) fn of_sphere(force: f64, radius: f64, curvatures: (f64, f64), material: Material) -> f64 {
    let relative = |curvature: f64| 1.0 / radius + curvature;
    in_ellipse(force, (relative(curvatures.0), relative(curvatures.1)), contact_modulus(material))
}

/// The same of any two bodies by the sums of their curvatures in the two principal directions, 2A and 2B in either order, 1/m, and E*, Pa.
fn in_ellipse(force: f64, sums: (f64, f64), modulus: f64) -> f64 {
    let (first, second) = ((0.5 * sums.0).max(0.0), (0.5 * sums.1).max(0.0));
    let (small, large) = (first.min(second), first.max(second));
    if !(force > 0.0 && large > 0.0) {
        return 0.0;
    }
    // A surface as hollow as the sphere would touch along a line; so thin an ellipse is as good as one.
    let share = (small / large).max(LEAST_SHARE);
    let ratio = axis_ratio(share);
    let (_, second_kind) = elliptic_integrals(1.0 - ratio * ratio);
    let sum = large * (1.0 + share);
    let short = libm::cbrt(3.0 * force * ratio * second_kind / (2.0 * PI * modulus * sum));
    3.0 * force * ratio / (2.0 * PI * short * short)
}

/// The largest pressure under a crowned roller, whose rim has this radius along the axis, m, on a disc that is straight along it.
pub(super) fn of_crown(
    body: &dyn Body,
    (curves, acting): (Curves<'_>, &[Acting]),
    machine: &Machine,
    crown: f64,
) -> Option<Worst> {
    let (modulus, roller) = (contact_modulus(machine.cam.material?), body.roller_radius()?);
    force_at_start(body, curves)?;
    // The cube is smooth where the force is 0.
    let cube = |piece: usize, at: f64| {
        let contact = curves.contact(piece, at);
        let bend = (1.0 / roller + contact.curve.offset_inward(curves.offset()).curvature).max(0.0);
        let force = body.contact_force((piece, at), &contact).unwrap_or(f64::NAN);
        let pressure = in_ellipse(force, (bend, 1.0 / crown), modulus);
        pressure * pressure * pressure
    };
    let worst = super::plane(extremes::largest_smooth(curves, (acting, 0.0), cube));
    Some(Worst { value: libm::cbrt(worst.value.max(0.0)), ..worst })
}

/// Least ratio of the two relative curvatures; below, the contact counts as a line.
const LEAST_SHARE: f64 = 1e-9;

/// b/a for A/B: the root of (b/a)² (K − E)/(E − (b/a)² K) = A/B, which grows with b/a from 0 to 1.
fn axis_ratio(share: f64) -> f64 {
    let excess = |log: f64| {
        let ratio = libm::exp(log);
        let square = ratio * ratio;
        let (first_kind, second_kind) = elliptic_integrals(1.0 - square);
        let round = second_kind - square * first_kind;
        // Within a millionth of the circle both differences are rounding; their quotient goes to 1.
        if round < 1e-6 { 1.0 - share } else { square * (first_kind - second_kind) / round - share }
    };
    if share >= 1.0 - 1e-9 {
        return 1.0;
    }
    root::bracketed(excess, libm::log(LEAST_SHARE), 0.0, 0.0).map_or(1.0, libm::exp)
}

/// The complete elliptic integrals K and E for the parameter m = e², by the arithmetic-geometric mean (Abramowitz & Stegun,
/// 17.6).
fn elliptic_integrals(parameter: f64) -> (f64, f64) {
    let (mut a, mut b, mut c) = (1.0, (1.0 - parameter).max(0.0).sqrt(), parameter.max(0.0).sqrt());
    let (mut sum, mut power) = (0.5 * c * c, 0.5);
    // The mean converges quadratically; the loop also ends where b is 0.
    for _ in 0..12 {
        (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
        power *= 2.0;
        sum += power * c * c;
        if c.abs() <= f64::EPSILON * a {
            break;
        }
    }
    let first_kind = PI / (2.0 * a);
    (first_kind, first_kind * (1.0 - sum))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// K and E at m = 0, ½ and near 1 (Abramowitz & Stegun, table 17.1).
    #[test]
    fn elliptic_integrals_are_those_of_the_tables() {
        for (m, k, e) in [
            (0.0, PI / 2.0, PI / 2.0),
            (0.5, 1.854_074_677_301_371_9, 1.350_643_881_047_675_5),
            (0.99, 3.695_637_362_989_874_7, 1.015_993_545_025_223_9),
        ] {
            let (first, second) = elliptic_integrals(m);
            assert!((first - k).abs() < 1e-14 * k && (second - e).abs() < 1e-14, "{m}: {first} {second}");
        }
    }

    /// On a plane a sphere has the circle of Hertz: p = (6 F E*²/(π³ R²))^(1/3); the same on every sphere of relative radius R.
    #[test]
    fn a_sphere_on_a_plane_and_on_a_sphere_touches_in_a_circle() {
        let modulus = contact_modulus(Material::Steel);
        for (curvature, relative) in [(0.0, 0.03), (1.0 / 0.05, 0.01875), (-1.0 / 0.06, 0.06)] {
            let expected = libm::cbrt(6.0 * 1000.0 * modulus * modulus / (PI * PI * PI * relative * relative));
            let found = of_sphere(1000.0, 0.03, (curvature, curvature), Material::Steel);
            assert!((found / expected - 1.0).abs() < 1e-9, "{curvature}: {found} {expected}");
        }
    }

    /// The pressure found bends the surface as Hertz' potential says, which is taken here by a sum over the angle:
    /// A = (p a b/E*) ∫ cos²φ dφ/(a² cos²φ + b² sin²φ)^(3/2),  B = (p a/(b E*)) ∫ cos²φ dφ/(a² cos²φ + b² sin²φ)^(1/2).
    #[test]
    fn the_pressure_bends_the_surface_as_the_potential_says() {
        let radius = 0.03;
        for curvatures in [(12.0, -5.0), (80.0, 0.0), (0.0, -33.0), (5.0, 4.9)] {
            let (force, modulus) = (2e4, contact_modulus(Material::CastIron));
            let pressure = of_sphere(force, radius, curvatures, Material::CastIron);
            let relative = |curvature: f64| 0.5 * (1.0 / radius + curvature);
            let (small, large) = (relative(curvatures.1), relative(curvatures.0));
            let ratio = axis_ratio(small / large);
            // From p = 3 F/(2 π a b).
            let short = (3.0 * force * ratio / (2.0 * PI * pressure)).sqrt();
            let long = short / ratio;
            let count = 200_000;
            let step = 0.5 * PI / f64::from(count);
            let (mut first, mut second) = (0.0, 0.0);
            for i in 0..count {
                let angle = (f64::from(i) + 0.5) * step;
                let (sin, cos) = (libm::sin(angle), libm::cos(angle));
                let square = long * long * cos * cos + short * short * sin * sin;
                first += step * cos * cos / (square * square.sqrt());
                second += step * cos * cos / square.sqrt();
            }
            let found_small = pressure * long * short / modulus * first;
            let found_large = pressure * long / (short * modulus) * second;
            // The midpoint rule of a smooth periodic integrand; sharpest at the thinnest ellipse.
            assert!((found_small / small - 1.0).abs() < 1e-6, "{curvatures:?}: {found_small} {small}");
            assert!((found_large / large - 1.0).abs() < 1e-6, "{curvatures:?}: {found_large} {large}");
        }
    }
}

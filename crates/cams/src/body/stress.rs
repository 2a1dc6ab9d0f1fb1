//! Pressure between roller and cam, after Hertz.

use crate::machine::{Machine, Material};
use camgen_kernel::document::cams::GROOVE;
use camgen_kernel::document::range::LONGEST;
use camgen_kernel::follower::Element;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::numeric::root;
use camgen_kernel::profile::extremes::{self, JumpRange};
use camgen_kernel::profile::{Contact, Curves, Worst};
use camgen_kernel::text::{KeyChange, Remedy};
use std::f64::consts::PI;

/// E* of a steel roller on a material, Pa: 1/E* = Σ (1 − ν²)/E.
fn contact_modulus(material: Material) -> f64 {
    1.0 / (1.0 / Material::Steel.contact_modulus() + 1.0 / material.contact_modulus())
}

/// Force between follower and cam along the normal, N, at a parameter of a piece with this contact; `None` where no force is
/// known.
pub(crate) type Force<'a> = &'a dyn Fn((usize, f64), &Contact) -> Option<f64>;

/// The force where the motion begins, N; `None` where none is known anywhere.
fn force_at_start(force: Force<'_>, curves: Curves<'_>) -> Option<f64> {
    let (piece, start) = curves.motion.locate(curves.motion.range().0);
    force((piece, start), &curves.contact(piece, start))
}

/// Places of a piece at which a pressure is looked at first.
const LOOKS: u32 = 4;

/// A power of the pressure that is smooth where the force vanishes, with its exponent.
type PowerOfPressure<'a> = (Box<dyn Fn(usize, f64) -> f64 + 'a>, i32);

/// The pressure in the contact line, p = √(F E*/(π b R)), 1/R = the sum of the curvatures, concave negative; or in the ellipse under a
/// roller with crown radius `crown` along the axis, m, on a disc straight along its axis. The roller is of steel; b is the thickness of the cam, or
/// the roller's reach into its groove (K. L. Johnson, Contact Mechanics, 1985, §4.2).
fn power_of_pressure<'a>(
    force: Force<'a>,
    curves: Curves<'a>,
    machine: &Machine,
    crown: Option<f64>,
) -> Option<PowerOfPressure<'a>> {
    // A knife edge touches with no radius, and any force would press without limit.
    if curves.element() == (Element::Roller { radius: 0.0 }) {
        return None;
    }
    let modulus = contact_modulus(machine.cam.material?.class);
    force_at_start(force, curves)?;
    // Groove flanks are farther from the roller's centre than its radius, by the clearance.
    let bend = match machine.follower.shape.element() {
        Element::Roller { radius } => radius.abs().recip(),
        Element::Face => 0.0,
    };
    let side = curves.metal_side();
    // On an edge (undercut) the curvature means nothing; there the check `undercut` fails.
    let both = move |piece: usize, at: f64| {
        let contact = curves.contact(piece, at);
        let curvature = (bend + side * contact.curve.offset_inward(curves.offset()).curvature).max(0.0);
        (force((piece, at), &contact).unwrap_or(f64::NAN), curvature)
    };
    if let Some(crown) = crown {
        curves.roller_radius()?;
        let cube = move |piece: usize, at: f64| {
            let (force, curvature) = both(piece, at);
            let pressure = in_ellipse(force, (curvature, 1.0 / crown), modulus);
            pressure * pressure * pressure
        };
        return Some((Box::new(cube), 3));
    }
    let width = machine.cam.contact_length()?;
    let square = move |piece: usize, at: f64| {
        let (force, curvature) = both(piece, at);
        force * modulus * curvature / (PI * width)
    };
    Some((Box::new(square), 2))
}

/// Largest pressure in a contact line or under a crowned roller; if the crown's ellipse would be longer than the cam, at least that of a straight roller.
pub fn largest(
    force: Force<'_>,
    curves: (Curves<'_>, &[JumpRange]),
    machine: &Machine,
    crown: Option<f64>,
) -> Option<Worst> {
    let found = largest_of_one(force, curves, machine, crown);
    let straight = crown.and_then(|_| largest_of_one(force, curves, machine, None));
    found.into_iter().chain(straight).reduce(Worst::or_larger)
}

fn largest_of_one(
    force: Force<'_>,
    (curves, acting): (Curves<'_>, &[JumpRange]),
    machine: &Machine,
    crown: Option<f64>,
) -> Option<Worst> {
    let (power, exponent) = power_of_pressure(force, curves, machine, crown)?;
    let worst = super::plane(extremes::largest_smooth(curves, (acting, 0.0), power));
    let power = worst.value.max(0.0);
    Some(Worst { value: if exponent == 2 { power.sqrt() } else { libm::cbrt(power) }, ..worst })
}

/// Whether the pressure exceeds a limit at one of a few places: nearly every cam that is much too small shows it there.
pub(crate) fn exceeds_somewhere(
    force: Force<'_>,
    curves: Curves<'_>,
    machine: &Machine,
    (crown, limit): (Option<f64>, f64),
) -> bool {
    let Some((power, exponent)) = power_of_pressure(force, curves, machine, crown) else { return false };
    let mut rolled = curves.motion.distinct().iter().enumerate().filter(|(index, _)| curves.motion.is_rolled(*index));
    rolled.any(|(index, piece)| {
        let at = |look: u32| piece.start + (piece.end - piece.start) * ((f64::from(look) + 0.5) / f64::from(LOOKS));
        (0..LOOKS).any(|look| power(index, at(look)) > limit.powi(exponent))
    })
}

/// Keys of the machine file that make the contact line long enough for a limit: the pressure is proportional to 1/√b. `None` if no accepted
/// length is.
#[must_use]
pub fn length_for(machine: &Machine, largest: f64, limit: f64) -> Option<Remedy> {
    let change = |key: &'static str, millimetres: f64| KeyChange::new(key, format!("{millimetres} mm"));
    let cam = &machine.cam;
    let over = largest / limit;
    let length = (MILLIMETRES * cam.contact_length()? * over * over).ceil();
    if length >= MILLIMETRES * LONGEST {
        return None;
    }
    if cam.track.body != GROOVE {
        return Some(Remedy::new([change("cam.thickness", length)]));
    }
    let depth = MILLIMETRES * cam.track.groove_depth?;
    let height = cam.track.barrel.roller_height.map(|_| change("cam.roller_height", length));
    let deeper = (length > depth || height.is_none()).then(|| change("cam.groove_depth", length));
    // As much metal behind the floor as now.
    let thickness = cam.thickness.map(|thickness| MILLIMETRES * thickness).filter(|thickness| length >= *thickness);
    let thicker = thickness.map(|thickness| change("cam.thickness", (length + thickness - depth).ceil()));
    Some(Remedy::new([height, deeper, thicker].into_iter().flatten()))
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
#[must_use]
pub fn of_sphere(force: f64, radius: f64, curvatures: (f64, f64), material: Material) -> f64 {
    let relative = |curvature: f64| 1.0 / radius + curvature;
    in_ellipse(force, (relative(curvatures.0), relative(curvatures.1)), contact_modulus(material))
}

/// A steel roller on a surface straight along the roller's axis.
pub(crate) struct RollerContact {
    /// The sum of both curvatures, 1/m.
    pub(crate) curvature: f64,
    /// Crown radius, m; `None` if straight.
    pub(crate) crown: Option<f64>,
    /// Contact length of a straight roller, m, if known.
    pub(crate) length: Option<f64>,
}

impl RollerContact {
    /// Largest pressure under a force (N), Pa; `None` for a straight roller without a contact length.
    pub(crate) fn pressure(&self, force: f64, material: Material) -> Option<f64> {
        let modulus = contact_modulus(material);
        let straight = self.length.map(|length| (force * modulus * self.curvature.max(0.0) / (PI * length)).sqrt());
        let crowned = self.crown.map(|crown| in_ellipse(force, (self.curvature, 1.0 / crown), modulus));
        straight.into_iter().chain(crowned).reduce(f64::max)
    }
}

/// Largest pressure between any two bodies, Pa, by the sums of their curvatures in the two principal directions, 2A and 2B in either order, 1/m, and E*, Pa.
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

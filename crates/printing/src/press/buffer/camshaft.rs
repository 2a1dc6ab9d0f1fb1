//! What the first cam needs from its shaft: the work E of the reversal and the torque T = dE/dφ, in closed form.
//!
//! With exact balance the pair of cylinders presses with 2 p0 F A x, and the lever cancels from torque and work, so with x = r
//! sin φ, u = A x, p = 1/k, c = L A/k
//!
//! ```text
//! dE/dx = 2 p0 F A x dΔx/dx,   dΔx/dx = c (1+u)^(−p−1) − 1
//! E(x)  = 2 p0 F A x² [(c − 1)/2 + c (H(u) − ½)]
//! H(u)  = [((1+u)^(1−p) − 1)/(1−p) + ((1+u)^−p − 1)/p]/u² = Σ (−1)ⁿ (p+1)…(p+n) uⁿ/(n! (n+2))
//! ```
//!
//! since ∫ u (1+u)^(−p−1) du = ∫ [(1+u)^−p − (1+u)^(−p−1)] du. E is counted from the dwell, is positive where the shaft drives
//! the follower, and E(π − φ) = E(φ). With c ≤ 1 it falls all the way; with c > 1 it rises to `x_top`, where the law turns.
//!
//! Under a linkage, whose deceleration a is not its overrun, the same integral is
//!
//! ```text
//! E(φ) = 2 p0 F A [c B + (c − 1) (x'(0)² − x'²)/2 + (c/κ) a² (H(A a) − ½)],   B = ∫ a (a'/κ − x') dφ = a²/(2κ) − (x'(0)² − x'²)/2
//! ```
//!
//! with κ = a'/x' at the start, and B = 0 for a yoke. Where the return does not mirror the outward motion it is not 0 at the end.
//!
//! Both humps of the torque are single. N = s cos 2φ + x s' cos²φ with s = dΔx/dx has the sign of dT/dφ. Where s > 0, −x s'/s
//! rises from 0 without bound and cos 2φ/cos²φ falls from 1. Where s < 0, x s'/s falls for c ≥ 1, and for c < 1 never grows
//! faster than 1/(2t) by t = (x/r)², while −cos 2φ/cos²φ grows faster than 4 from 0 at 45°.

use super::Cylinder;
use super::bottom_law::BottomLaw;
use super::crank_law::{CrankLaw, LinkageLaw};
use camgen_kernel::numeric::extremum::Extremum;
use camgen_kernel::numeric::{quadrature, root};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// Below this u the series of H − ½ is summed (50 terms at most); above it the closed form has lost less than five bits.
const SERIES_LIMIT: f64 = 0.5;

/// Work of the shaft on the first follower, and its derivatives by the crank angle φ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorkDerivatives {
    /// E, J, counted from the dwell.
    pub value: f64,
    /// dE/dφ, N·m per radian of crank angle.
    pub torque: f64,
    /// d²E/dφ².
    pub torque_slope: f64,
    /// d³E/dφ³.
    pub torque_second: f64,
}

/// H(u) − ½ for u ≥ 0 and 0 < p ≤ 1.
fn h_minus_half(u: f64, p: f64) -> f64 {
    if u < SERIES_LIMIT {
        let (mut product, mut sum, mut n) = (1.0, 0.0, 1.0);
        loop {
            product *= -u * (p + n) / n;
            let term = product / (n + 2.0);
            sum += term;
            // Written so that a NaN ends it too.
            if !(term.abs() > f64::EPSILON * 0.125 * sum.abs()) {
                return sum;
            }
            n += 1.0;
        }
    }
    let log = libm::log1p(u);
    let first = if p == 1.0 { log } else { libm::expm1((1.0 - p) * log) / (1.0 - p) };
    (first + libm::expm1(-p * log) / p) / (u * u) - 0.5
}

/// E(x) of the law at its own speed, J, for an overrun x in [0, r].
#[must_use]
pub fn work_at(law: &BottomLaw, cylinder: &Cylinder, x: f64) -> f64 {
    let (c, u) = (1.0 + law.start_slope, law.loading * x);
    cylinder.unit_force() * u * x * (0.5 * law.start_slope + c * h_minus_half(u, 1.0 / law.exponent))
}

/// The work and its derivatives at a crank angle in [0, π] of the reversal.
#[must_use]
pub fn work(law: &BottomLaw, cylinder: &Cylinder, crank: f64) -> WorkDerivatives {
    let r = law.stroke;
    let (x, first) = ((r * libm::sin(crank)).max(0.0), r * libm::cos(crank));
    let half = libm::sin(0.5 * (FRAC_PI_2 - crank));
    let bottom = law.bottom(x, 2.0 * r * half * half);
    let force = cylinder.unit_force() * law.loading;
    // f = dE/dx and its derivatives by x; x'' = −x, x''' = −x'.
    let f = force * x * bottom.slope;
    let f_slope = force * (bottom.slope + x * bottom.second);
    let f_second = force * (2.0 * bottom.second + x * bottom.third);
    WorkDerivatives {
        value: work_at(law, cylinder, x),
        torque: f * first,
        torque_slope: f_slope * first * first - f * x,
        torque_second: (f_second * first * first - 3.0 * f_slope * x - f) * first,
    }
}

/// The work and its derivatives at a crank angle of the reversal of any bed.
#[must_use]
pub fn work_of(law: &CrankLaw, cylinder: &Cylinder, crank: f64) -> WorkDerivatives {
    match law {
        CrankLaw::Yoke(law) => work(law, cylinder, crank),
        CrankLaw::Linkage(law) => work_of_linkage(law, cylinder, crank),
    }
}

/// Crank angle from the start of the reversal up to which B is integrated, rad: there its two terms cancel.
const NEAR: f64 = 0.2;
/// Panels in it, of eight points each.
const PANELS: u32 = 2;

fn work_of_linkage(law: &LinkageLaw, cylinder: &Cylinder, crank: f64) -> WorkDerivatives {
    let bed = law.end.at(crank);
    let ([_, speed, ..], [a, a1, a2, ..]) = (bed.x, bed.deceleration());
    let (c, ratio, start) = (1.0 + law.start_slope, law.end.start_ratio(), law.end.at(0.0).x[1]);
    let slowed = 0.5 * (start - speed) * (start + speed);
    // The return mirrors the outward motion, or its end is not near the start.
    let from_start = if law.end.symmetric() { crank.min(law.end.angle() - crank) } else { crank };
    let excess = if from_start < NEAR {
        quadrature::integrate(
            |crank| {
                let bed = law.end.at(crank);
                bed.deceleration()[0] * bed.excess[1]
            },
            (0.0, from_start.max(0.0)),
            PANELS,
        )
    } else {
        0.5 * a * a / ratio - slowed
    };
    let shape = h_minus_half(law.loading * a.max(0.0), 1.0 / law.exponent);
    let [_, b1, b2, b3, _] = law.at(crank);
    let force = cylinder.unit_force() * law.loading;
    WorkDerivatives {
        value: force * (c * excess + law.start_slope * slowed + c / ratio * a * a * shape),
        torque: force * a * b1,
        torque_slope: force * (a1 * b1 + a * b2),
        torque_second: force * (a2 * b1 + 2.0 * a1 * b2 + a * b3),
    }
}

/// Largest work of the shaft over the stroke, J, and the overrun where it is, m: 0 at the start for c ≤ 1, at the top of the law
/// for c > 1, or at x = r where the law has not turned by then.
#[must_use]
pub fn largest_work(law: &BottomLaw, cylinder: &Cylinder) -> Extremum {
    let at = top(law.start_slope, 1.0 / law.exponent, law.loading).clamp(0.0, law.stroke);
    Extremum { at, value: work_at(law, cylinder, at) }
}

/// Least work over the stroke, J, and where: E(r), or 0 at the start where E(r) is positive.
#[must_use]
pub fn least_work(law: &BottomLaw, cylinder: &Cylinder) -> Extremum {
    let end = work_at(law, cylinder, law.stroke);
    if end < 0.0 { Extremum { at: law.stroke, value: end } } else { Extremum { at: 0.0, value: 0.0 } }
}

/// Where dΔx/dx = 0, m: c^(1/(p+1)) = 1 + A x.
fn top(start_slope: f64, p: f64, loading: f64) -> f64 {
    libm::expm1(libm::log1p(start_slope) / (p + 1.0)) / loading
}

/// Greatest and least torque of the braking half, by crank angle; on the return they change sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorqueExtremes {
    /// Greatest torque, N·m per radian of crank angle, and its crank angle, rad; 0 at 0 for c ≤ 1.
    pub greatest: Extremum,
    /// Least torque and its crank angle; 0 at π/2 where the law has not turned by x = r.
    pub least: Extremum,
}

impl TorqueExtremes {
    /// The one of larger size.
    #[must_use]
    pub fn largest(&self) -> Extremum {
        if self.greatest.value > -self.least.value { self.greatest } else { self.least }
    }
}

/// The torque of a law over 2 p0 F r.
#[derive(Debug, Clone, Copy)]
struct TorqueShape {
    /// A r.
    end: f64,
    p: f64,
    start_slope: f64,
}

impl TorqueShape {
    /// s = dΔx/dx and x s' at u.
    fn slopes(&self, u: f64) -> (f64, f64) {
        let c = 1.0 + self.start_slope;
        let fall = libm::expm1(-(self.p + 1.0) * libm::log1p(u));
        (self.start_slope + c * fall, -c * (self.p + 1.0) * u * (1.0 + fall) / (1.0 + u))
    }

    fn torque(&self, crank: f64) -> f64 {
        let u = self.end * libm::sin(crank);
        u * self.slopes(u).0 * libm::cos(crank)
    }

    /// Has the sign of dT/dφ within a hump.
    fn rise(&self, crank: f64) -> f64 {
        let (slope, fall) = self.slopes(self.end * libm::sin(crank));
        let cos = libm::cos(crank);
        slope * libm::cos(2.0 * crank) + fall * cos * cos
    }

    fn extremes(&self) -> TorqueExtremes {
        let top = top(self.start_slope, self.p, self.end);
        let turn = if top < 1.0 { libm::asin(top.max(0.0)) } else { FRAC_PI_2 };
        let from = if turn < FRAC_PI_2 { turn.max(FRAC_PI_4) } else { FRAC_PI_2 };
        TorqueExtremes {
            greatest: self.hump(0.0, turn.min(FRAC_PI_4), 0.0),
            least: self.hump(from, FRAC_PI_2, FRAC_PI_2),
        }
    }

    /// The extreme between two crank angles; 0 at `none` where there is nothing between them.
    fn hump(&self, low: f64, high: f64, none: f64) -> Extremum {
        if !(low < high) {
            return Extremum { at: none, value: 0.0 };
        }
        let at = root::bracketed(|crank| self.rise(crank), low, high, 0.0).unwrap_or(none);
        Extremum { at, value: self.torque(at) }
    }
}

/// Greatest and least torque over the reversal at the law's own speed, each the root of its slope.
#[must_use]
pub fn torque_extremes(law: &BottomLaw, cylinder: &Cylinder) -> TorqueExtremes {
    let shape = TorqueShape { end: law.loading * law.stroke, p: 1.0 / law.exponent, start_slope: law.start_slope };
    let TorqueExtremes { greatest, least } = shape.extremes();
    let unit = cylinder.unit_force() * law.stroke;
    let [greatest, least] = [greatest, least].map(|e| Extremum { at: e.at, value: e.value * unit });
    TorqueExtremes { greatest, least }
}

/// The column L, m, with the least largest size of torque over the reversal, for a loading A (1/m), exponent k and stroke r (m).
///
/// At every φ the torque is 2 p0 F A x r cos φ (c (1+u)^(−p−1) − 1), which rises with c. So does its greatest value, from 0 at
/// c = 1, and its least rises to 0 at c = (1 + A r)^(p+1): the larger of both sizes is least where they are equal, at the one root
/// between. (Lead only shifts Δx.)
#[must_use]
pub fn least_torque_column(loading: f64, exponent: f64, stroke: f64) -> f64 {
    let (end, p) = (loading * stroke, 1.0 / exponent);
    let matched = exponent / loading;
    let most = libm::expm1((p + 1.0) * libm::log1p(end));
    let balanced = root::bracketed(
        |start_slope| {
            let extremes = TorqueShape { end, p, start_slope }.extremes();
            extremes.greatest.value + extremes.least.value
        },
        0.0,
        most,
        0.0,
    );
    // There is a change of sign for every finite machine.
    balanced.map_or(matched, |start_slope| matched + matched * start_slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::press::buffer::bottom_law::ColumnRule;
    use crate::press::buffer::regime::{Reset, reset};
    use crate::press::buffer::tests::{Random, reference};
    use camgen_kernel::numeric::extremum;

    fn machine(q: f64, column: ColumnRule) -> (BottomLaw, Cylinder) {
        let (_, cylinder) = reference(q);
        (BottomLaw::new(cylinder.loading(35.0), 1.35, 0.18, column, 0.0), cylinder)
    }

    /// Relative; a handful of roundings of powers and logarithms.
    fn close(got: f64, want: f64) {
        assert!((got / want - 1.0).abs() < 2e-14, "{got} is not {want}");
    }

    /// A place to the digits given in degrees.
    fn place(crank: f64, degrees: f64) {
        assert!((crank.to_degrees() - degrees).abs() < 1e-10, "{} is not {degrees}", crank.to_degrees());
    }

    #[test]
    fn golden_numbers() {
        let (law, cylinder) = machine(2.0, ColumnRule::Matched);
        let golden =
            [(30.0, -182.766_339_301_991_203), (60.0, -756.605_695_159_598_779), (90.0, -1_083.586_299_051_655_99)];
        for (degrees, energy) in golden {
            let crank = f64::to_radians(degrees);
            close(work(&law, &cylinder, crank).value, energy);
            close(work(&law, &cylinder, std::f64::consts::PI - crank).value, energy);
        }
        let largest = torque_extremes(&law, &cylinder).largest();
        close(largest.value, -1_185.799_485_705_874_39);
        place(largest.at, 50.247_293_204_326);
        assert_eq!(largest_work(&law, &cylinder), Extremum { at: 0.0, value: 0.0 });
        close(least_work(&law, &cylinder).value, -1_083.586_299_051_655_99);

        let (law, cylinder) = machine(5.0, ColumnRule::Return);
        close(largest_work(&law, &cylinder).value, 111.559_182_925_087_921);
        close(least_work(&law, &cylinder).value, -838.915_415_894_089_832);
        let extremes = torque_extremes(&law, &cylinder);
        close(extremes.greatest.value, 526.081_353_783_135_305);
        place(extremes.greatest.at, 6.499_884_478_83);
        close(extremes.least.value, -1_195.968_790_228_279);
        place(extremes.least.at, 52.685_846_313_4);
        let (law, cylinder) = machine(2.0, ColumnRule::Return);
        assert!((torque_extremes(&law, &cylinder).largest().value + 631.94).abs() < 5.1e-3);
        assert!((least_work(&law, &cylinder).value + 380.576).abs() < 5.1e-4);
    }

    /// For every column E(r) is the work that compresses the air less the energy of the bed.
    #[test]
    fn energy_is_kept() {
        for (q, column) in [(2.0, ColumnRule::Matched), (5.0, ColumnRule::Return), (2.0, ColumnRule::Length(0.5))] {
            let (bed, _) = reference(q);
            let (law, cylinder) = machine(q, column);
            let (k, p) = (1.35, 1.0 / 1.35);
            let gas = libm::expm1(p * (k - 1.0) * libm::log(q)) / (k - 1.0) + libm::expm1(-p * libm::log(q));
            let bed_energy = 0.5 * bed.largest_inertia(35.0) * 0.18;
            let kept = cylinder.unit_force() * law.column * gas - bed_energy;
            // The difference of two energies of some kJ.
            assert!(
                (work_at(&law, &cylinder, 0.18) - kept).abs() < 1e-14 * bed_energy * (1.0 + law.column / 0.18),
                "{kept}"
            );
        }
    }

    /// With (14) at another speed the disc that balances the design speed leaves the difference of both torques.
    #[test]
    fn a_disc_for_the_design_speed_leaves_the_difference() {
        let (law, cylinder) = machine(2.0, ColumnRule::Matched);
        for (rpm, before, after, digits) in [
            (30.0, 895.5, 292.3, 0.051),
            (25.0, 637.870_234_784_720_117, 550.750_992_947_320_793, 1e-10),
            (20.0, 417.6, 770.9, 0.051),
        ] {
            let regime = reset(&law.into(), &cylinder, rpm, Reset::End);
            let left = |crank: f64| {
                let x = 0.18 * libm::sin(crank);
                let first = regime.air(x) * law.bottom(x, 0.18 - x).slope * 0.18 * libm::cos(crank);
                (first - work(&law, &cylinder, crank).torque).abs()
            };
            let left = extremum::largest_without_slope(left, (0.0, FRAC_PI_2), 40, 38).value;
            assert!((regime.camshaft_torque_max() - before).abs() < digits, "{rpm}: {}", regime.camshaft_torque_max());
            assert!((left - after).abs() < digits, "{rpm}: {left}");
        }
    }

    #[test]
    fn the_column_of_least_torque() {
        let (_, cylinder) = reference(2.0);
        let loading = cylinder.loading(35.0);
        let column = least_torque_column(loading, 1.35, 0.18);
        assert!((column - 0.528_083).abs() < 5.1e-7, "{column}");
        assert!((column * loading / 1.35 - 2.173_180).abs() < 5.1e-7);
        let (law, cylinder) = machine(2.0, ColumnRule::Length(column));
        let extremes = torque_extremes(&law, &cylinder);
        assert!((extremes.greatest.value - 442.28).abs() < 5.1e-3, "{extremes:?}");
        close(-extremes.least.value, extremes.greatest.value);
        // mm/rad at φ = 0.
        assert!((180.0 * law.start_slope - 211.0).abs() < 0.51);
        // No work left at x = r: c = 1/(2 H(U)).
        let (law, cylinder) = machine(2.0, ColumnRule::Length(0.675 / loading / (0.5 + h_minus_half(1.0, 1.0 / 1.35))));
        assert!((law.column - 0.559_351).abs() < 5.1e-7 && (law.start_slope - 1.301_857).abs() < 5.1e-7);
        // Of some 400 J on the way.
        assert!(work_at(&law, &cylinder, 0.18).abs() < 1e-12);
    }

    /// The optimum against golden sections over the column; the corner there is sharp, so 60 sections of 1e-13 do.
    #[test]
    fn no_other_column_has_less_torque() {
        let mut random = Random(23);
        let (_, cylinder) = reference(2.0);
        for _ in 0..100 {
            let (k, end) = (random.between(1.0, 3.0), random.of_size(1e-3, 100.0));
            let largest = |column: f64| {
                let law = BottomLaw::new(end / 0.18, k, 0.18, ColumnRule::Length(column), 0.0);
                -torque_extremes(&law, &cylinder).largest().value.abs()
            };
            let ours = least_torque_column(end / 0.18, k, 0.18);
            let matched = k * 0.18 / end;
            let most = matched * libm::pow(1.0 + end, 1.0 / k + 1.0);
            let search = extremum::largest_without_slope(largest, (matched, most), 16, 60);
            // At small U the search knows c − 1 of about U to an ulp of c only.
            let known = 1e-12 + 1e-14 / end;
            assert!((largest(ours) / search.value - 1.0).abs() < known, "k {k}, U {end}: {ours} {search:?}");
            assert!((ours - search.at).abs() < 1e-10 * (most - matched), "k {k}, U {end}: {ours} {search:?}");
        }
    }

    /// 10 000 machines: work against quadrature of the force that the law leaves to the cam, the torque and its derivatives against
    /// differences of the one before.
    #[test]
    fn closed_forms_are_what_quadrature_finds() {
        let mut random = Random(19);
        for round in 0..10_000 {
            let k = if round % 10 == 0 { 1.0 } else { random.between(1.0, 3.0) };
            let q = 1.0 + random.of_size(1e-6, 1e3);
            let (_, cylinder) = reference(2.0);
            let column = match random.between(0.0, 3.0) {
                s if s < 1.0 => ColumnRule::Matched,
                s if s < 2.0 => ColumnRule::Return,
                _ => ColumnRule::Length(k * 0.18 / (q - 1.0) * random.of_size(0.3, 30.0)),
            };
            let law = BottomLaw::new((q - 1.0) / 0.18, k, 0.18, column, 0.0);
            let crank = random.between(0.05, FRAC_PI_2);
            let x = 0.18 * libm::sin(crank);
            let force = |x: f64| cylinder.unit_force() * law.loading * x * law.bottom(x, 0.18 - x).slope;
            // By t = ln(1 + u) the force is a sum of exponentials, smooth for every U.
            let by_log = |t: f64| force(libm::expm1(t) / law.loading) * libm::exp(t) / law.loading;
            let by_force = quadrature::integrate(by_log, (0.0, libm::log1p(law.loading * x)), 4);
            let got = work(&law, &cylinder, crank);
            // Of what the work would be with the largest slope: E crosses 0 for c > 1.
            let size = cylinder.unit_force() * law.loading * x * x * law.start_slope.abs();
            let off = 1e-10 * by_force.abs() + 1e-14 * size;
            assert!((got.value - by_force).abs() < off, "k {k} q {q} {column:?} {crank}: {got:?} {by_force}");
            let h = 1e-5;
            let difference = |f: fn(WorkDerivatives) -> f64| {
                (f(work(&law, &cylinder, crank + h)) - f(work(&law, &cylinder, crank - h))) / (2.0 * h)
            };
            // h² by the fifth derivative, of the size of the third times (U/(1+u))²/6; roundings 1e-16/h.
            let scale = got.value.abs() + got.torque.abs() + got.torque_slope.abs() + got.torque_second.abs() + size;
            for (exact, quotient) in [
                (got.torque, difference(|w| w.value)),
                (got.torque_slope, difference(|w| w.torque)),
                (got.torque_second, difference(|w| w.torque_slope)),
            ] {
                assert!((exact - quotient).abs() < 1e-6 * scale, "k {k} q {q} {column:?} {crank}: {exact} {quotient}");
            }
        }
    }

    /// The work under linkages against quadrature of the torque, which is that of the yoke where the linkage is nearly one; work is left where
    /// the return does not mirror the outward motion.
    #[test]
    fn work_under_a_linkage() {
        use crate::press::bed_motion::{End, Linkage, Slider, StrokeEnd};
        let (_, cylinder) = reference(2.0);
        let loading = cylinder.loading(35.0);
        for (rod_ratio, offset_ratio) in [(3.0, 0.0), (4.5, 0.0), (3.0, 0.1), (1e6, 0.0)] {
            for end in [End::Outer, End::Inner] {
                let slider = Linkage::CrankSlider(Slider { rod_ratio, offset_ratio });
                let end = StrokeEnd::new(slider, 0.18, end).expect("two zeros");
                for column in [ColumnRule::Matched, ColumnRule::Return, ColumnRule::Length(0.5)] {
                    let law = LinkageLaw::new(loading, 1.35, end, column, 0.0);
                    let crank_law = CrankLaw::Linkage(law);
                    let at = |crank: f64| work_of(&crank_law, &cylinder, crank);
                    for share in [1e-3, 0.02, 0.05, 0.07, 0.3, 0.5, 0.8, 0.99, 1.0] {
                        let crank = share * end.angle();
                        let summed = quadrature::integrate(|crank| at(crank).torque, (0.0, crank), 64);
                        let size = at(0.5 * end.angle()).value.abs();
                        assert!(
                            (at(crank).value - summed).abs() < 1e-12 * size.max(100.0),
                            "{slider:?} {column:?} {share}: {} {summed}",
                            at(crank).value
                        );
                        let h = 1e-5;
                        let slope =
                            |of: fn(WorkDerivatives) -> f64| (of(at(crank + h)) - of(at(crank - h))) / (2.0 * h);
                        let (own, scale) = (at(crank), 1e-6 * 1e4);
                        if share < 1.0 {
                            assert!((own.torque_slope - slope(|work| work.torque)).abs() < scale);
                            assert!((own.torque_second - slope(|work| work.torque_slope)).abs() < 10.0 * scale);
                        }
                    }
                    let left = at(end.angle()).value.abs();
                    assert!(
                        if offset_ratio == 0.0 { left < 1e-10 } else { left > 1.0 },
                        "{slider:?} {column:?}: {left}"
                    );
                }
            }
        }
    }

    /// The two extremes against a scan with golden sections.
    #[test]
    fn torque_extremes_are_what_a_search_finds() {
        let mut random = Random(29);
        for _ in 0..1000 {
            let q = 1.0 + random.of_size(1e-2, 1e2);
            let (_, cylinder) = reference(q);
            let column = ColumnRule::Length(1.35 * 0.18 / (q - 1.0) * random.of_size(0.3, 30.0));
            let law = BottomLaw::new((q - 1.0) / 0.18, 1.35, 0.18, column, 0.0);
            let extremes = torque_extremes(&law, &cylinder);
            for (sign, ours) in [(1.0, extremes.greatest.value), (-1.0, -extremes.least.value)] {
                let torque = |crank: f64| sign * work(&law, &cylinder, crank).torque;
                let search = extremum::largest_without_slope(torque, (0.0, FRAC_PI_2), 64, 30).value;
                // cos 90° is 6e-17 in floating point, a torque that is rounding.
                assert!((ours - search).abs() <= 1e-10 * search + 1e-12, "{law:?} {extremes:?} {search}");
            }
        }
    }
}

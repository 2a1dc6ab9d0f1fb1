//! Drag links that even the accelerations of a crank-slider out: K_c = 1 (V. O. Kuznetsov 1997, his first task), with K_φ = 1 as
//! well (his second), and the least C of all (`least`, derived here).
//!
//! To the first order in λ1 a drag link adds one harmonic, ψ ≈ θ + const + λ1/(λ3 sin μ0) cos(θ − γ), with μ0 the angle at B for
//! λ1 = 0 and a phase that δ turns freely. It takes the rod's second harmonic 1/(4 λ5) away where λ1 = λ3 sin μ0/(2 λ5) and
//! δ = 90° + μ0: the bed is nearly harmonic and C falls by about 1/(λ5 + 1) of itself. That rule starts the searches.

mod least;

pub use least::{SynthesisLimits, least};

use super::dual::Dual;
use crate::press::bed_motion::characteristics::{grid, jerk_zeros, power_extremes};
use crate::press::bed_motion::{Branch, DragLink, Linkage, Links, Slider, turned};
use camgen_kernel::numeric::root;
use camgen_kernel::numeric::series::{PowerSeries, SeriesCoefficient};
use camgen_kernel::refusal::Refusal;
use std::f64::consts::{FRAC_PI_2, PI};

/// Cells of the range of bases that is searched for K_c = 1.
const BASES: u32 = 40;

/// Largest C⁺ − C⁻ and φ1 − π (rad) together that a solution leaves.
const SOLVED: f64 = 1e-11;

/// Values of one linkage with their slopes by λ1, λ2, λ3 and δ.
#[derive(Debug, Clone, PartialEq)]
struct Local {
    /// Every extreme of π²(−x'')/S above 0.
    outward: Vec<Dual>,
    /// Every extreme of π² x''/S above 0.
    inward: Vec<Dual>,
    /// Every extreme of π³|x' x''|/S².
    power: Vec<Dual>,
    /// φ1, rad.
    forward: Dual,
}

/// The largest of some values.
fn top(values: &[Dual]) -> Dual {
    let none = Dual::constant(f64::NEG_INFINITY);
    values.iter().fold(none, |best, next| if next.value > best.value { *next } else { best })
}

fn dual_links(drag_link: &DragLink) -> Links<Dual> {
    let (cos, sin) = (libm::cos(drag_link.turn), libm::sin(drag_link.turn));
    Links {
        base: Dual { value: drag_link.base, slope: [1.0, 0.0, 0.0, 0.0] },
        coupler: Dual { value: drag_link.coupler, slope: [0.0, 1.0, 0.0, 0.0] },
        follower: Dual { value: drag_link.follower, slope: [0.0, 0.0, 1.0, 0.0] },
        turn: [Dual { value: cos, slope: [0.0, 0.0, 0.0, -sin] }, Dual { value: sin, slope: [0.0, 0.0, 0.0, cos] }],
        sign: drag_link.branch.sign(),
    }
}

/// x, x' and x'' of the bed with their slopes.
fn bed_motion(links: &Links<Dual>, slider: &Slider, theta: f64) -> [Dual; 3] {
    let (cos, sin): (PowerSeries<3, Dual>, _) = links.crank(theta);
    slider.slide(cos, sin).derivatives()
}

/// The extremes of a linkage. An extreme value has the slope of the value at a fixed angle: its angle moves along a level
/// tangent. A dead point moves by −(∂x'/∂link)/x''.
fn local(drag_link: &DragLink, slider: &Slider) -> Local {
    let linkage = Linkage::SixBar(*drag_link, *slider);
    let links = dual_links(drag_link);
    let stroke = slider.stroke();
    let normal = Dual::constant(PI * PI / stroke);
    let grid = grid(&linkage);
    let (mut outward, mut inward) = (Vec::new(), Vec::new());
    for theta in jerk_zeros(&linkage, &grid) {
        let [_, _, second] = bed_motion(&links, slider, theta);
        let scaled = normal * second;
        if scaled.value < 0.0 {
            outward.push(-scaled);
        } else {
            inward.push(scaled);
        }
    }
    let mut power = Vec::new();
    for theta in power_extremes(&linkage, &grid) {
        let [_, first, second] = bed_motion(&links, slider, theta);
        let product = Dual::constant(PI / stroke) * normal * first * second;
        power.push(if product.value < 0.0 { -product } else { product });
    }
    let [outer, inner] = linkage.dead_points().map(|theta| {
        let [_, first, second] = bed_motion(&links, slider, theta);
        Dual { value: theta, slope: first.scaled_slope(-1.0 / second.value) }
    });
    let forward = inner - outer;
    Local { outward, inward, power, forward: Dual { value: turned(forward.value), ..forward } }
}

/// K_c and its slopes.
fn acceleration_ratio(drag_link: &DragLink, slider: &Slider) -> Dual {
    let local = local(drag_link, slider);
    top(&local.outward) / top(&local.inward)
}

/// K_c at a base, and its slope along the bases.
#[derive(Clone, Copy)]
struct RatioAtBase {
    base: f64,
    ratio: f64,
    slope: f64,
}

/// The range of K_c over the bases that were tried.
struct RatioRange {
    least: f64,
    least_base: f64,
    largest: f64,
}

impl RatioRange {
    fn include(&mut self, tried: RatioAtBase) {
        if tried.ratio < self.least {
            (self.least, self.least_base) = (tried.ratio, tried.base);
        }
        self.largest = self.largest.max(tried.ratio);
    }
}

/// A base with K_c = 1 between two others.
fn base_between(low: f64, high: f64, ratio: &impl Fn(f64) -> RatioAtBase) -> Option<f64> {
    root::bracketed(|base| ratio(base).ratio - 1.0, low, high, 0.0).ok()
}

/// The smallest base in [0, `most`) with K_c = 1.
///
/// Between the points of a grid a change of sign holds a root; where K_c only dips towards 1 its extreme, by its slope, decides.
fn smallest_base(most: f64, ratio: impl Fn(f64) -> RatioAtBase) -> Result<f64, Refusal> {
    let mut range = RatioRange { least: f64::INFINITY, least_base: f64::NAN, largest: f64::NEG_INFINITY };
    let mut low = ratio(0.0);
    range.include(low);
    for cell in 1..BASES {
        let high = ratio(most * (f64::from(cell) / f64::from(BASES)));
        range.include(high);
        if (low.ratio < 1.0) == (high.ratio < 1.0) {
            let toward = if low.ratio < 1.0 { -1.0 } else { 1.0 };
            if toward * low.slope < 0.0
                && toward * high.slope > 0.0
                && let Ok(middle) = root::bracketed(|base| ratio(base).slope, low.base, high.base, 1e-12)
            {
                let middle = ratio(middle);
                range.include(middle);
                if toward * (middle.ratio - 1.0) < 0.0
                    && let Some(found) = base_between(low.base, middle.base, &ratio)
                {
                    return Ok(found);
                }
            }
        } else if let Some(found) = base_between(low.base, high.base, &ratio) {
            return Ok(found);
        }
        low = high;
    }
    let RatioRange { least, least_base, largest } = range;
    Err(Refusal::new(format!(
        "no base makes both largest accelerations equal: their ratio runs from {least} (at a base of {least_base}) to \
         {largest}"
    ))
    .remedy("take a coupler and a follower that are nearly equal"))
}

/// The smallest base λ1 that makes both largest accelerations of the bed equal, K_c = 1; the base of `drag_link` is not used.
///
/// # Errors
/// [`Refusal`] where the links turn with no base, and with the range of K_c where no base gives 1: not every pair of
/// coupler and follower has one, as Kuznetsov (1997) says.
pub fn equal(drag_link: DragLink, slider: Slider) -> Result<Linkage, Refusal> {
    slider.check()?;
    DragLink { base: 0.0, ..drag_link }.check()?;
    let most = drag_link.remedies().base.below;
    let base = smallest_base(most, |base| {
        let Dual { value: ratio, slope: [slope, ..] } = acceleration_ratio(&DragLink { base, ..drag_link }, &slider);
        RatioAtBase { base, ratio, slope }
    })?;
    Linkage::six_bar(DragLink { base, ..drag_link }, slider)
}

/// The refusal of a value that is not between two others.
fn out_of_range(name: &str, value: f64, low: f64, high: f64) -> Refusal {
    Refusal::new(format!("the {name} is {value}")).remedy(format!("it must be between {low} and {high}"))
}

/// The centric family, exactly symmetric (derived here): δ = 180°, λ6 = 0 and λ2² = 1 + λ1² − λ3² put the dead points at
/// cos θ = ±λ3, so K_φ = 1 whatever λ1, and the transmission angle deviates equally from 90°, cos μ = ∓λ1/(λ2 λ3). One equation for
/// λ1 is left, K_c = 1.
///
/// # Errors
/// [`Refusal`] for a follower λ3 that is not between 0 and 1, and where no base gives K_c = 1.
pub fn centric(follower: f64, rod_ratio: f64) -> Result<Linkage, Refusal> {
    let slider = Slider { rod_ratio, offset_ratio: 0.0 };
    slider.check()?;
    if !(follower > 0.0 && follower < 1.0) {
        return Err(out_of_range("follower ratio", follower, 0.0, 1.0));
    }
    let base = smallest_base(follower, |base| {
        let drag_link = centric_link(base, follower);
        let Dual { value: ratio, slope: [by_base, by_coupler, ..] } = acceleration_ratio(&drag_link, &slider);
        RatioAtBase { base, ratio, slope: by_base + by_coupler * base / drag_link.coupler }
    })?;
    Linkage::six_bar(centric_link(base, follower), slider)
}

/// The drag link of the centric family.
fn centric_link(base: f64, follower: f64) -> DragLink {
    let coupler = (1.0 + base * base - follower * follower).sqrt();
    DragLink { base, coupler, follower, turn: PI, branch: Branch::Leading }
}

/// The drag link that the first order in λ1 gives for a coupler and a follower, on the leading branch.
fn first_order(coupler: f64, follower: f64, slider: &Slider) -> DragLink {
    let link = DragLink { base: 0.0, coupler, follower, turn: 0.0, branch: Branch::Leading };
    let mu = libm::acos(link.transmission_cosine(1.0));
    DragLink { base: 0.5 * follower * libm::sin(mu) / slider.rod_ratio, turn: FRAC_PI_2 + mu, ..link }
}

/// What a drag link misses a symmetric motion by.
struct SymmetryMiss {
    /// C⁺ − C⁻.
    accelerations: Dual,
    /// φ1 − π, rad.
    times: Dual,
}

impl SymmetryMiss {
    fn new(link: &DragLink, slider: &Slider) -> Self {
        let local = local(link, slider);
        Self { accelerations: top(&local.outward) - top(&local.inward), times: local.forward - Dual::constant(PI) }
    }

    fn size(&self) -> f64 {
        self.accelerations.value.abs() + self.times.value.abs()
    }
}

/// λ1 and δ with K_c = K_φ = 1 for a coupler and a follower: Newton's method on C⁺ − C⁻ = 0 and φ1 = π from the first order.
///
/// # Errors
/// [`Refusal`] where the links turn with no base, and where the search ends without a solution.
pub fn symmetric(coupler: f64, follower: f64, branch: Branch, slider: Slider) -> Result<Linkage, Refusal> {
    slider.check()?;
    DragLink { base: 0.0, coupler, follower, turn: 0.0, branch }.check()?;
    // A trailing drag link is the mirror image of a leading one.
    let leading = Slider { offset_ratio: branch.sign() * slider.offset_ratio, ..slider };
    let mut link = first_order(coupler, follower, &leading);
    if !link.turns() {
        link.base = 0.5 * link.remedies().base.below;
    }
    let mut miss = SymmetryMiss::new(&link, &leading);
    for _ in 0..40 {
        let Dual { value: f, slope: [fb, .., ft] } = miss.accelerations;
        let Dual { value: g, slope: [gb, .., gt] } = miss.times;
        let determinant = fb * gt - ft * gb;
        let step = [(ft * g - gt * f) / determinant, (gb * f - fb * g) / determinant];
        let mut share = 1.0;
        let better = (0..12).find_map(|_| {
            let next = DragLink { base: link.base + share * step[0], turn: link.turn + share * step[1], ..link };
            share *= 0.5;
            let next_miss = next.turns().then(|| SymmetryMiss::new(&next, &leading))?;
            (next_miss.size() < miss.size()).then_some((next, next_miss))
        });
        let Some(better) = better else { break };
        (link, miss) = better;
    }
    if !(miss.size() < SOLVED) {
        let local = local(&link, &leading);
        let (ratio, turn) = (top(&local.outward).value / top(&local.inward).value, link.turn.to_degrees());
        return Err(Refusal::new(format!(
            "no symmetric motion found with these links: nearest, at a base of {} and a turn of {turn}°, are an \
             acceleration ratio of \
             {ratio} and a forward angle of {}°",
            link.base,
            local.forward.value.to_degrees()
        ))
        .remedy("take a follower from 0.5 to 0.9 without a coupler, which always has one"));
    }
    Linkage::six_bar(DragLink { turn: branch.sign() * link.turn, branch, ..link }, slider)
}

#[cfg(test)]
mod tests;

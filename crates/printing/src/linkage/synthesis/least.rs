//! The drag link with the least C = max(C⁺, C⁻) within limits: sequential linear programming in epigraph form, derived here.
//!
//! Unknowns are λ1, λ2, λ3, δ and a bound t of every extreme of ±π² x''/S. A step solves the linear program of their slopes in a
//! box, where the limits may be missed at a price; the box shrinks where the step does not keep what it promised.

use super::{Local, centric, first_order, local, out_of_range, top};
use crate::linkage::dual::{Dual, LINKS};
use crate::press::bed_motion::characteristics::characteristics;
use crate::press::bed_motion::{Branch, DragLink, Linkage, Slider};
use camgen_kernel::numeric::simplex::{self, Inequality};
use camgen_kernel::refusal::Refusal;
use std::f64::consts::{FRAC_PI_2, PI};

/// Price of missing a limit by 1 (of a cosine, a radian, a share of power), in C: above every multiplier met.
const PRICE: f64 = 30.0;

/// Half width of the first box, and of the widest.
const FIRST_BOX: f64 = 0.05;
const WIDEST_BOX: f64 = 0.2;

/// Half width of the box at which the search ends.
const LAST_BOX: f64 = 1e-10;

/// Steps of every start, and steps more of the best of them.
const FIRST_STEPS: u32 = 10;
const LAST_STEPS: u32 = 150;

/// How many of the starts are followed to the end.
const FOLLOWED: usize = 3;

/// A limit counts as kept when it is missed by less.
const KEPT: f64 = 1e-8;

/// The longest base searched, in driving cranks.
const LONGEST_BASE: f64 = 0.9;

/// Spread points that are tried as starts.
const SPREAD: u32 = 32;

/// Limits of a design.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SynthesisLimits {
    /// Least transmission angle of the drag link, rad, in (0, π/2).
    pub transmission_angle: f64,
    /// Least coupler and follower, in driving cranks.
    pub link_ratio: f64,
    /// Largest W / W of the crank-slider without drag link.
    pub power: Option<f64>,
    /// Whether the motion must take half a turn each way, K_φ = 1.
    pub symmetric: bool,
}

struct SynthesisProblem {
    slider: Slider,
    limits: SynthesisLimits,
    /// Largest W.
    power: f64,
}

#[derive(Debug, Clone)]
struct DesignPoint {
    link: DragLink,
    local: Local,
    /// Violation of each limit (negative where it is kept), with slopes.
    misses: Vec<Dual>,
    /// C.
    value: f64,
}

impl DesignPoint {
    fn violation(&self) -> f64 {
        self.misses.iter().map(|miss| miss.value).fold(0.0, f64::max)
    }

    fn merit(&self) -> f64 {
        self.value + PRICE * self.violation()
    }

    fn links(&self) -> [f64; LINKS] {
        [self.link.base, self.link.coupler, self.link.follower, self.link.turn]
    }
}

/// cos μ at the ends of its range, d = 1 ∓ λ1, with slopes.
fn transmission(link: &DragLink) -> [Dual; 2] {
    let DragLink { base, coupler, follower, .. } = *link;
    [-1.0, 1.0].map(|side| {
        let distance = 1.0 + side * base;
        let value = link.transmission_cosine(distance);
        let by_base = -side * distance / (coupler * follower);
        Dual { value, slope: [by_base, 1.0 / follower - value / coupler, 1.0 / coupler - value / follower, 0.0] }
    })
}

/// A value less its limit.
fn less(value: Dual, limit: f64) -> Dual {
    Dual { value: value.value - limit, ..value }
}

impl SynthesisProblem {
    /// The extremes of a drag link and what it misses the limits by; `None` if it does not turn.
    fn evaluate(&self, link: DragLink) -> Option<DesignPoint> {
        link.turns().then_some(())?;
        let local = local(&link, &self.slider);
        let value = top(&local.outward).value.max(top(&local.inward).value);
        let cosine = libm::cos(self.limits.transmission_angle);
        let mut misses: Vec<Dual> =
            transmission(&link).into_iter().flat_map(|value| [less(value, cosine), less(-value, cosine)]).collect();
        if self.limits.symmetric {
            let uneven = less(local.forward, PI);
            misses.extend([uneven, -uneven]);
        }
        if self.limits.power.is_some() {
            misses.extend(local.power.iter().map(|power| Dual {
                value: power.value / self.power - 1.0,
                slope: power.scaled_slope(1.0 / self.power),
            }));
        }
        value.is_finite().then_some(DesignPoint { link, local, misses, value })
    }

    /// Distance that each link may go down and up in a box, in half widths.
    fn room(&self, point: &DesignPoint, width: f64) -> [(f64, f64); LINKS] {
        let least = self.limits.link_ratio;
        let mut hard =
            [(0.0, LONGEST_BASE), (least, f64::INFINITY), (least, f64::INFINITY), (f64::NEG_INFINITY, f64::INFINITY)]
                .into_iter()
                .zip(point.links());
        std::array::from_fn(|_| {
            let ((low, high), at) = hard.next().unwrap_or(((0.0, 0.0), 0.0));
            (((low - at) / width).clamp(-1.0, 1.0), ((high - at) / width).clamp(-1.0, 1.0))
        })
    }

    /// The step of the linear program in a box, and the merit it promises.
    fn step(&self, point: &DesignPoint, width: f64) -> Option<(DragLink, f64)> {
        let room = self.room(point, width);
        let extremes: Vec<&Dual> = point.local.outward.iter().chain(&point.local.inward).collect();
        let steepest = extremes.iter().map(|c| c.slope.iter().map(|slope| slope.abs()).sum()).fold(1.0, f64::max);
        let reference = point.value - width * steepest;
        let mut rows = Vec::new();
        let bounded = extremes.into_iter().map(|extreme| (extreme, reference, [-1.0, 0.0]));
        let limited = point.misses.iter().map(|miss| (miss, 0.0, [0.0, -1.0]));
        for (value, reference, elastic) in bounded.chain(limited) {
            let to_corner = value.slope.iter().zip(&room).map(|(slope, (low, _))| slope * low).sum::<f64>();
            rows.push(Inequality {
                coefficients: value.slope.into_iter().chain(elastic).collect(),
                right: -(value.value - reference) / width - to_corner,
            });
        }
        for (index, (low, high)) in room.iter().enumerate() {
            let coefficients = (0..LINKS + 2).map(|other| if other == index { 1.0 } else { 0.0 }).collect();
            rows.push(Inequality { coefficients, right: high - low });
        }
        let costs = [0.0, 0.0, 0.0, 0.0, 1.0, PRICE];
        let found = simplex::least(&costs, &rows, &[LINKS, LINKS + 1])?.unknowns;
        let mut moved =
            found.iter().zip(&room).zip(point.links()).map(|((step, (low, _)), at)| at + width * (step + low));
        let (base, coupler, follower, turn) = (moved.next()?, moved.next()?, moved.next()?, moved.next()?);
        let [bound, violation] = found.get(LINKS..).and_then(|rest| <[f64; 2]>::try_from(rest).ok())?;
        let promised = reference + width * (bound + PRICE * violation);
        Some((DragLink { base, coupler, follower, turn, ..point.link }, promised))
    }

    /// Steps from a point until the box is spent; the box goes on.
    fn descend(&self, mut point: DesignPoint, mut width: f64, steps: u32) -> (DesignPoint, f64) {
        for _ in 0..steps {
            if width < LAST_BOX {
                break;
            }
            let Some((link, promised)) = self.step(&point, width) else { break };
            let hoped = point.merit() - promised;
            if hoped < 1e-14 {
                break;
            }
            let kept = self.evaluate(link).map(|next| ((point.merit() - next.merit()) / hoped, next));
            match kept {
                Some((share, next)) if share > 0.1 => {
                    point = next;
                    if share > 0.7 {
                        width = WIDEST_BOX.min(2.0 * width);
                    } else if share < 0.3 {
                        width *= 0.5;
                    }
                }
                _ => width *= 0.4,
            }
        }
        (point, width)
    }

    /// The centric family, and the first order for couplers and followers spread evenly (the sequence of the plastic number).
    fn starts(&self) -> Vec<DesignPoint> {
        let least = self.limits.link_ratio;
        let family = [0.5, 0.6, 0.7, 0.8, 0.9].into_iter();
        let centric = family.filter_map(|follower| centric(follower, self.slider.rod_ratio).ok()?.drag_link());
        let plastic = 1.324_717_957_244_746;
        let spread = (1..=SPREAD).map(|n| {
            let [coupler, follower] = [1.0 / plastic, 1.0 / (plastic * plastic)].map(|factor| {
                let value = f64::from(n) * factor;
                least + value - value.floor()
            });
            first_order(coupler, follower, &self.slider)
        });
        centric
            .chain(spread)
            .map(|link| DragLink { coupler: link.coupler.max(least), follower: link.follower.max(least), ..link })
            .filter_map(|link| self.evaluate(link))
            .collect()
    }
}

/// The drag link with the least C for a slider within limits, on the leading branch; K_c is 1 there or the design lies on a limit.
///
/// Starts are the centric family and the first order in λ1 for spread links; the best of them are followed to the end.
///
/// # Errors
/// [`Refusal`] for limits out of range and where no design that keeps them is found.
pub fn least(slider: Slider, limits: SynthesisLimits) -> Result<Linkage, Refusal> {
    slider.check()?;
    let inputs = [
        ("least transmission angle", limits.transmission_angle, 0.0, FRAC_PI_2),
        ("least link ratio", limits.link_ratio, 0.0, 10.0),
        ("largest share of power", limits.power.unwrap_or(1.0), 0.0, f64::INFINITY),
    ];
    for (name, value, low, high) in inputs {
        if !(value > low && value < high) {
            return Err(out_of_range(name, value, low, high));
        }
    }
    let plain = characteristics(&Linkage::CrankSlider(slider)).power.value;
    let problem = SynthesisProblem { slider, limits, power: plain * limits.power.unwrap_or(1.0) };
    let mut points: Vec<(DesignPoint, f64)> =
        problem.starts().into_iter().map(|start| problem.descend(start, FIRST_BOX, FIRST_STEPS)).collect();
    points.sort_by(|(a, _), (b, _)| a.merit().total_cmp(&b.merit()));
    points.truncate(FOLLOWED);
    let ends = points.into_iter().map(|(point, width)| problem.descend(point, width.max(1e-3), LAST_STEPS).0);
    let best = ends.min_by(|a, b| a.merit().total_cmp(&b.merit()));
    let remedy = "lower the least transmission angle, or let the power rise";
    let best = best.ok_or_else(|| Refusal::new("no drag link turns within the limits").remedy(remedy))?;
    if best.violation() < KEPT {
        return Linkage::six_bar(DragLink { branch: Branch::Leading, ..best.link }, slider);
    }
    let transmission_angle = best.link.transmission_angles().into_iter().fold(FRAC_PI_2, f64::min).to_degrees();
    let (power, forward_angle) = (top(&best.local.power).value / plain, best.local.forward.value.to_degrees());
    Err(Refusal::new(format!(
        "no design within the limits found: the nearest has a transmission angle of {transmission_angle}°, {power} \
         times the power of the \
         crank-slider and a forward angle of {forward_angle}°"
    ))
    .remedy(remedy))
}

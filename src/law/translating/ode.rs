//! The bottom of a translating cam as the solution of (18) for the slope, by Taylor's method.
//!
//! x = 0 is a removable singularity: there A x/P is 0/0 and tends to c/(1+w), w the slope, c = L A/k; w is the root of
//! the equation that this makes of (18), and the series is built on y = x w. With unequal efficiencies the slope has
//! three laws: rising, falling, and between them a lever that sticks. The changes are found on the series and kept as
//! breaks, so that every stretch is smooth.

use super::equation::{ARM_SHARE, Exact, Mechanism, Side};
use super::wall::Wall;
use crate::numeric::root;
use crate::numeric::taylor::{self, Expansion, Tape};

/// Share of the tolerance one step may take. The solution attracts its neighbours, so that errors of steps die out
/// rather than add up; near x = 0 the attraction is weak and a few of them may add.
const STEP_SHARE: f64 = 0.125;
/// Shortest step over the overrun reached: shorter ones mean a wall.
const SHORTEST_STEP: f64 = 1e-10;
/// Largest number of steps: even q = 1e5 takes a hundred.
const MOST_STEPS: usize = 5000;
/// Cells of a step in which a change of sign is looked for, and cells in which a stuck lever may come free.
const STEP_CELLS: u32 = 8;
const STUCK_CELLS: u32 = 128;
/// What is left of an arm, a sine or the column, as a share, where the solution ends for want of it.
const NEAR: f64 = 0.02;
/// A slope beyond this where the solution ends is the reason why: the roller's path lies within 1° of the flank.
const STEEP: f64 = 50.0;
/// Slopes of series and equation that differ by more belong to different branches; the error of a step is far smaller
/// at any tolerance, the difference of the branches far larger.
const SAME_SLOPE: f64 = 0.01;
/// Least overrun, in strokes, at which the equation is asked without its series.
const LEAST_OVERRUN: f64 = 1e-9;

/// A stretch of the solution, lengths in strokes.
#[derive(Debug, Clone, PartialEq)]
struct Stretch {
    side: Side,
    series: Expansion,
}

/// A place where the law of the slope changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Break {
    /// Overrun, m.
    pub x: f64,
    /// What the bottom does from there on.
    pub then: Side,
}

/// The solution over the whole stroke.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    stroke: f64,
    stretches: Vec<Stretch>,
    /// Where the law of the slope changes, in order.
    pub breaks: Vec<Break>,
}

impl Solution {
    /// Solves (18) to an absolute tolerance of Δx, m.
    ///
    /// # Errors
    /// The [`Wall`] the solution runs into.
    pub fn new(mechanism: &Mechanism, tolerance: f64) -> Result<Self, Wall> {
        let stroke = mechanism.balance.stroke;
        let share = STEP_SHARE * tolerance / stroke;
        let mut run = Run {
            mechanism,
            rising: mechanism.tape(Side::Rising),
            falling: mechanism.tape(Side::Falling),
            share,
            order: taylor::order(share),
            solution: Self { stroke, stretches: Vec::new(), breaks: Vec::new() },
        };
        run.start()?;
        for _ in 0..MOST_STEPS {
            let (x, y, side) = run.reached();
            if x >= 1.0 {
                return Ok(run.solution);
            }
            // A lever that still sticks has not come free before the column ended.
            if side == Side::Stuck {
                return Err(Wall::Column { x_mm: 1e3 * stroke * x });
            }
            run.step(x, y, side)?;
        }
        let (x, y, _) = run.reached();
        Err(run.wall(x, y))
    }

    /// Number of steps taken.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.stretches.len()
    }

    /// Δx and its first three derivatives by x at an overrun in [0, r], SI; at a break those of the later stretch, or,
    /// with `before`, of the earlier one.
    #[must_use]
    pub fn at(&self, x: f64, before: bool) -> [f64; 4] {
        let Some(stretch) = self.stretch(x, before) else { return [f64::NAN; 4] };
        let [value, first, second, third] = stretch.series.at(x / self.stroke);
        let r = self.stroke;
        [value * r, first, second / r, third / (r * r)]
    }

    /// What the bottom does there.
    #[must_use]
    pub fn side(&self, x: f64, before: bool) -> Side {
        self.stretch(x, before).map_or(Side::Stuck, |stretch| stretch.side)
    }

    fn stretch(&self, x: f64, before: bool) -> Option<&Stretch> {
        let scaled = x / self.stroke;
        let later = |s: &Stretch| s.series.centre < scaled || (!before && s.series.centre <= scaled);
        self.stretches.get(self.stretches.partition_point(later).saturating_sub(1))
    }

    /// Δx alone, m.
    #[must_use]
    pub fn value(&self, x: f64) -> f64 {
        self.at(x, false)[0]
    }
}

struct Run<'a> {
    mechanism: &'a Mechanism,
    rising: Tape,
    falling: Tape,
    share: f64,
    order: usize,
    solution: Solution,
}

impl Run<'_> {
    fn reached(&self) -> (f64, f64, Side) {
        self.solution
            .stretches
            .last()
            .map_or((0.0, 0.0, Side::Stuck), |s| (s.series.end, s.series.value(s.series.end), s.side))
    }

    fn tape(&self, side: Side) -> &Tape {
        if side == Side::Falling { &self.falling } else { &self.rising }
    }

    /// The series from x = 0.
    fn start(&mut self) -> Result<(), Wall> {
        let mechanism = self.mechanism;
        let none = Wall::NoStart {
            delta_deg: mechanism.delta.to_degrees(),
            friction_deg: mechanism.friction_angle.to_degrees(),
        };
        let from = |side: Side| -> Result<Expansion, Wall> {
            let slope = starting_slope(mechanism, side).ok_or(none)?;
            Ok(mechanism.starting_tape(side).expand_from_origin(slope, self.order))
        };
        // A slope of exactly 0 is decided by the next coefficient.
        let goes = |series: &Expansion, sign: f64| {
            let first = series.coefficients.iter().skip(1).find(|coefficient| **coefficient != 0.0);
            first.is_some_and(|coefficient| sign * coefficient > 0.0)
        };
        let (side, series) = if mechanism.two_sided() {
            let (rising, falling) = (from(Side::Rising)?, from(Side::Falling)?);
            if goes(&rising, 1.0) {
                (Side::Rising, rising)
            } else if goes(&falling, -1.0) {
                (Side::Falling, falling)
            } else {
                (Side::Stuck, Expansion { centre: 0.0, end: 0.0, coefficients: vec![0.0] })
            }
        } else {
            let series = from(Side::Rising)?;
            (if goes(&series, 1.0) { Side::Rising } else { Side::Falling }, series)
        };
        if side == Side::Stuck {
            self.turn(0.0, Side::Stuck);
            self.wait(0.0, 0.0, Side::Stuck);
            return Ok(());
        }
        self.accept(0.0, 0.0, side, series)
    }

    /// One step of a moving bottom.
    fn step(&mut self, x: f64, y: f64, side: Side) -> Result<(), Wall> {
        let series = self.tape(side).expand(x, y, self.order);
        self.accept(x, y, side, series)
    }

    /// Keeps a series as far as it holds, up to a change of side.
    fn accept(&mut self, x: f64, y: f64, side: Side, mut series: Expansion) -> Result<(), Wall> {
        let reach = series.reach(self.share);
        if !(reach > SHORTEST_STEP * x) || !self.passable(x, y) {
            return Err(self.wall(x, y));
        }
        series.end = if reach < 1.0 - x { x + reach } else { 1.0 };
        let mut then = None;
        if self.mechanism.two_sided() {
            let sign = if side == Side::Rising { 1.0 } else { -1.0 };
            if let Some(turn) = first_fall(|at| sign * series.at(at)[1], x, series.end, STEP_CELLS) {
                series.end = turn;
                then = Some(Side::Stuck);
            }
        }
        let end = series.end;
        let [bottom, slope, ..] = series.at(end);
        // The series runs on smoothly past the end of the arm, where cos ψ changes sign; the equation does not.
        let same = (self.tape(side).value(end, bottom) - slope).abs() <= SAME_SLOPE * (1.0 + slope * slope);
        self.solution.stretches.push(Stretch { side, series });
        if !same || !self.passable(end, bottom) {
            return Err(self.wall(end, bottom));
        }
        if let (Some(then), true) = (then, end < 1.0) {
            self.turn(end, then);
            self.wait(end, bottom, side);
        }
        Ok(())
    }

    fn turn(&mut self, x: f64, then: Side) {
        self.solution.breaks.push(Break { x: x * self.solution.stroke, then });
    }

    /// A lever that sticks from x on, until either law of the slope moves it the way it is for. The law of the side it
    /// came from is 0 at x, give or take a rounding, and frees it only later.
    fn wait(&mut self, x: f64, y: f64, came: Side) {
        let from = x.max(LEAST_OVERRUN);
        // A bottom that rests lets the column be used up at L − Δx.
        let limit = (self.mechanism.balance.column / self.solution.stroke - y).min(1.0);
        let up = |at: f64| -self.rising.value(at, y);
        let down = |at: f64| self.falling.value(at, y);
        let free = |law: &dyn Fn(f64) -> f64, side: Side| {
            if side != came && law(from) < 0.0 { Some(from) } else { first_fall(law, from, limit, STUCK_CELLS) }
        };
        let (up, down) = (free(&up, Side::Rising), free(&down, Side::Falling));
        let (end, then) = match (up, down) {
            (Some(up), Some(down)) if up < down => (up, Side::Rising),
            (_, Some(down)) => (down, Side::Falling),
            (Some(up), None) => (up, Side::Rising),
            (None, None) => (limit, Side::Stuck),
        };
        if end > x {
            let series = Expansion { centre: x, end, coefficients: vec![y] };
            self.solution.stretches.push(Stretch { side: Side::Stuck, series });
        } else {
            // It only passes through: the break is a change of law without a stay.
            self.solution.breaks.pop();
        }
        if then != Side::Stuck && end < 1.0 {
            self.turn(end, then);
            // The next step starts with the other law; a series of its own carries the side on.
            let series = Expansion { centre: end, end, coefficients: vec![y] };
            self.solution.stretches.push(Stretch { side: then, series });
        }
    }

    /// Whether the mechanism can stand at (x, y), in strokes.
    fn passable(&self, x: f64, y: f64) -> bool {
        let (r, m) = (self.solution.stroke, self.mechanism);
        let lever = m.lever(r * y);
        bottom_share(m, r * y) < ARM_SHARE && lever.sine > 0.0 && m.balance.column > r * (x + y)
    }

    /// The name of the wall at (x, y): the quantity that is nearest to nothing.
    fn wall(&self, x: f64, y: f64) -> Wall {
        let (r, m) = (self.solution.stroke, self.mechanism);
        let (x_mm, bottom) = (1e3 * r * x, r * y);
        let near = NEAR;
        let past = bottom_share(m, bottom) >= 1.0 - near;
        if past && m.delta.to_degrees() == 90.0 || bottom.abs() >= m.bottom_arm {
            return Wall::Arm { x_mm, arm_mm: 1e3 * m.bottom_arm };
        }
        let lever = m.lever(bottom);
        if lever.sine <= near {
            Wall::Line { x_mm }
        } else if past {
            Wall::Arm { x_mm, arm_mm: 1e3 * m.bottom_arm }
        } else if 1.0 - (r * x + bottom) / m.balance.column <= near {
            Wall::Column { x_mm }
        } else {
            let slope = |side| {
                if x > 0.0 {
                    self.tape(side).value(x, y).abs()
                } else {
                    starting_slope(m, side).map_or(f64::NAN, f64::abs)
                }
            };
            let steep = slope(Side::Rising).max(slope(Side::Falling));
            // A hundredth of the overrun is left as stroke of the air.
            if x + y < 0.01 * x {
                return Wall::Stiff { x_mm };
            }
            if steep.is_nan() || steep > STEEP { Wall::Slope { x_mm } } else { Wall::Unnamed { x_mm } }
        }
    }
}

fn bottom_share(mechanism: &Mechanism, bottom: f64) -> f64 {
    bottom.abs() / mechanism.bottom_arm
}

/// Where a function that starts at 0 or above first falls below 0 in (low, high], by cells.
fn first_fall(f: impl Fn(f64) -> f64, low: f64, high: f64, cells: u32) -> Option<f64> {
    let mut left = low;
    for cell in 1..=cells {
        let right = low + (high - low) * (f64::from(cell) / f64::from(cells));
        if f(right) < 0.0 {
            return Some(root::bracketed(&f, left, right, 0.0).unwrap_or(left));
        }
        left = right;
    }
    None
}

/// The slope w = dΔx/dx at x = 0: the root nearest 0 of w = f(c/(1+w) − 1), where f is the slope of (18).
///
/// In one direction it is a quadratic: with C = λ, θ = Δ and η (c − 1 − w)/(1 + w) for η B,
///
/// ```text
/// w² (η q − C s₊) − w [C (η s₋ + C q + s₊) + η (c−1) q] + C [η (c−1) s₋ − C q] = 0
/// ```
///
/// Its left side is positive at w = −1, so one root lies above −1 on the branch where C s₊ + η B q > 0, and the other is
/// past the wall. The mean of both directions has its root between theirs, since each is a falling function of w.
fn starting_slope(mechanism: &Mechanism, side: Side) -> Option<f64> {
    let (braking, returning) = mechanism.efficiencies(side);
    let q = libm::sin(mechanism.friction_angle);
    let lever = mechanism.lever(0.0);
    let (plus, minus) = (lever.plus, lever.minus);
    let surplus = mechanism.balance.start_slope;
    let one = |eta: f64, plus: f64, minus: f64, q: f64| {
        if !(plus > 0.0 && minus > 0.0) {
            return None;
        }
        let c = lever.ratio;
        let a2 = eta * q - c * plus;
        let a1 = c * (eta * minus + c * q + plus) + eta * surplus * q;
        let a0 = c * (eta * surplus * minus - c * q);
        let discriminant = a1 * a1 - 4.0 * a2 * a0;
        let below = a1 + discriminant.sqrt();
        let slope = 2.0 * a0 / below;
        // The branch: NaN and a slope past −1 are no start.
        let denominator = c * plus * (1.0 + slope) + eta * (surplus - slope) * q;
        (slope > -1.0 && denominator > 0.0 && below > 0.0).then_some(slope)
    };
    match mechanism.exact {
        Exact::Braking => one(braking, plus, minus, q),
        Exact::Return => one(returning, minus, plus, -q),
        Exact::Mean => {
            let (first, second) = (one(braking, plus, minus, q)?, one(returning, minus, plus, -q)?);
            let tape = mechanism.starting_tape(side);
            // Without friction the two agree to a rounding, and there is nothing to bracket.
            root::bracketed(|w| tape.value(0.0, w) - w, first, second, 0.0).ok().or(Some(0.5 * (first + second)))
        }
    }
}

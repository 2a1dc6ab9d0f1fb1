//! The bottom moved by a wedge cam as the solution of (18) for the slope, by Taylor's method.
//!
//! x = 0 is a removable singularity: there A a/P is 0/0 and tends to c/(1+w), w the slope, c = L A κ/k, κ = da/dx (1 under a
//! yoke); w is the root of the equation that this makes of (18), and the series is built on y = x w. With unequal efficiencies the
//! slope has three laws: rising, falling, and between them a lever that sticks. The changes are found on the series and kept as
//! breaks, so that every stretch is smooth.

use super::mechanism::{ARM_SHARE, ExactOn, Lever, Mechanism, Trend};
use super::wall;
use camgen_kernel::numeric::root;
use camgen_kernel::numeric::series::tape::Tape;
use camgen_kernel::numeric::series::taylor::{self, TaylorExpansion};
use camgen_kernel::refusal::Refusal;

/// Share of the tolerance one step may take. The solution attracts its neighbours, so that errors of steps die out
/// rather than add up; near x = 0 the attraction is weak and a few of them may add.
const STEP_SHARE: f64 = 0.125;
/// Shortest step over the overrun reached: shorter ones mean that the solution ends here.
const SHORTEST_STEP: f64 = 1e-10;
/// Largest number of steps: even q = 1e5 takes a hundred.
const MOST_STEPS: usize = 5000;
/// Cells of a step in which a change of sign is looked for, and cells in which a stuck lever may come free.
const STEP_CELLS: u32 = 8;
const STUCK_CELLS: u32 = 128;
/// Remaining share of an arm, a sine or the column below which the solution ends because it is used up.
const NEAR: f64 = 0.02;
/// Share of the overrun that the air has as its stroke, below which the equation is too stiff to be followed.
const STIFF: f64 = 0.01;
/// A slope beyond this where the solution ends is the reason why: the roller's path lies within 1° of the flank.
const STEEP: f64 = 50.0;
/// Slopes of series and equation that differ by more belong to different branches; the error of a step is far smaller
/// at any tolerance, the difference of the branches far larger.
const SAME_SLOPE: f64 = 0.01;
/// Least overrun, in strokes, at which the equation is evaluated without its series.
const LEAST_OVERRUN: f64 = 1e-9;

/// A stretch of the solution, lengths in strokes.
#[derive(Debug, Clone, PartialEq)]
struct SolutionStretch {
    side: Trend,
    series: TaylorExpansion,
}

/// An overrun at which the law of the slope changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Break {
    /// Overrun, m.
    pub x: f64,
    /// Direction of the bottom from there on.
    pub then: Trend,
}

/// The solution over the whole stroke.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    stroke: f64,
    stretches: Vec<SolutionStretch>,
    /// Where the law of the slope changes, in order.
    pub breaks: Vec<Break>,
}

impl Solution {
    /// Solves (18) to an absolute tolerance of Δx, m.
    ///
    /// # Errors
    /// The wall that the solution runs into.
    pub fn new(mechanism: &Mechanism, tolerance: f64) -> Result<Self, Refusal> {
        let stroke = mechanism.bottom_law.stroke();
        let share = STEP_SHARE * tolerance / stroke;
        let mut run = Run {
            mechanism,
            rising: mechanism.tape(Trend::Rising),
            falling: mechanism.tape(Trend::Falling),
            share,
            order: taylor::order(share),
            x: 0.0,
            y: 0.0,
            side: Trend::Stuck,
            solution: Self { stroke, stretches: Vec::new(), breaks: Vec::new() },
        };
        run.start()?;
        for _ in 0..MOST_STEPS {
            if run.x >= 1.0 {
                return Ok(run.solution);
            }
            // A lever that still sticks has not come free before the column ended.
            if run.side == Trend::Stuck {
                return Err(wall::column(stroke * run.x));
            }
            run.step()?;
        }
        Err(run.wall())
    }

    /// Number of steps taken.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.stretches.len()
    }

    /// Δx and its first three derivatives by x at an overrun in [0, r], SI; at a break of the later stretch, or,
    /// with `before`, of the earlier one.
    #[must_use]
    pub fn at(&self, x: f64, before: bool) -> [f64; 4] {
        let Some(stretch) = self.stretch(x, before) else { return [f64::NAN; 4] };
        let [value, first, second, third] = stretch.series.values_at(x / self.stroke);
        let r = self.stroke;
        [value * r, first, second / r, third / (r * r)]
    }

    /// Direction of the bottom there.
    #[must_use]
    pub fn trend(&self, x: f64, before: bool) -> Trend {
        self.stretch(x, before).map_or(Trend::Stuck, |stretch| stretch.side)
    }

    fn stretch(&self, x: f64, before: bool) -> Option<&SolutionStretch> {
        let scaled = x / self.stroke;
        let begun = self
            .stretches
            .partition_point(|stretch| stretch.series.centre < scaled || (!before && stretch.series.centre <= scaled));
        self.stretches.get(begun.saturating_sub(1))
    }

    /// Δx alone, m.
    #[must_use]
    pub fn value(&self, x: f64) -> f64 {
        self.at(x, false)[0]
    }
}

/// The solution under way: reached so far, in strokes, and what the bottom does from there.
struct Run<'a> {
    mechanism: &'a Mechanism,
    rising: Tape,
    falling: Tape,
    share: f64,
    order: usize,
    x: f64,
    y: f64,
    side: Trend,
    solution: Solution,
}

impl Run<'_> {
    fn tape(&self, side: Trend) -> &Tape {
        if side == Trend::Falling { &self.falling } else { &self.rising }
    }

    /// Goes to the end of a series.
    fn go(&mut self, series: TaylorExpansion) {
        (self.x, self.y) = (series.end, series.value(series.end));
        self.solution.stretches.push(SolutionStretch { side: self.side, series });
    }

    /// From here on the bottom moves differently.
    fn turn(&mut self, then: Trend) {
        self.side = then;
        self.solution.breaks.push(Break { x: self.x * self.solution.stroke, then });
    }

    /// The series from x = 0.
    fn start(&mut self) -> Result<(), Refusal> {
        let rising = self.series_from_origin(Trend::Rising)?;
        let (side, series) = if starts_towards(&rising, 1.0) {
            (Trend::Rising, rising)
        } else if !self.mechanism.two_sided() {
            (Trend::Falling, rising)
        } else {
            let falling = self.series_from_origin(Trend::Falling)?;
            if !starts_towards(&falling, -1.0) {
                self.turn(Trend::Stuck);
                self.wait(Trend::Stuck);
                return Ok(());
            }
            (Trend::Falling, falling)
        };
        self.side = side;
        self.accept(series)
    }

    /// The series about x = 0 with the slope of a side.
    fn series_from_origin(&self, side: Trend) -> Result<TaylorExpansion, Refusal> {
        let mechanism = self.mechanism;
        let slope =
            starting_slope(mechanism, side).ok_or_else(|| wall::no_start(mechanism.delta, mechanism.friction_angle))?;
        Ok(mechanism.starting_tape(side).expand_from_origin(slope, self.order))
    }

    /// One step of a moving bottom.
    fn step(&mut self) -> Result<(), Refusal> {
        let series = self.tape(self.side).expand(self.x, self.y, self.order);
        self.accept(series)
    }

    /// Keeps a series as far as it holds, up to a change of side.
    fn accept(&mut self, mut series: TaylorExpansion) -> Result<(), Refusal> {
        let (x, side) = (self.x, self.side);
        let reach = series.reach(self.share);
        if !(reach > SHORTEST_STEP * x) || !self.passable() {
            return Err(self.wall());
        }
        series.end = if reach < 1.0 - x { x + reach } else { 1.0 };
        let sign = if side == Trend::Rising { 1.0 } else { -1.0 };
        let turning = self.mechanism.two_sided();
        let turn =
            turning.then(|| first_fall(|at| sign * series.values_at(at)[1], x, series.end, STEP_CELLS)).flatten();
        series.end = turn.unwrap_or(series.end);
        let slope = series.values_at(series.end)[1];
        self.go(series);
        // The series runs on smoothly past the end of the arm, where cos ψ changes sign; the equation does not.
        let apart = (self.tape(side).value(self.x, self.y) - slope).abs();
        if !(apart <= SAME_SLOPE * (1.0 + slope * slope)) || !self.passable() {
            return Err(self.wall());
        }
        if turn.is_some() && self.x < 1.0 {
            self.turn(Trend::Stuck);
            self.wait(side);
        }
        Ok(())
    }

    /// A lever that sticks from here on, until either law of the slope moves it in its own direction. The law of the side it
    /// came from is 0 here, give or take a rounding, and frees it only later.
    fn wait(&mut self, came: Trend) {
        let (x, y) = (self.x, self.y);
        // A bottom that rests lets the column be used up at L − Δx.
        let limit = (self.mechanism.bottom_law.column() / self.solution.stroke - y).min(1.0);
        let [rises, falls] = [Trend::Rising, Trend::Falling].map(|side| self.comes_free(side, came, limit));
        let (end, then) = match (rises, falls) {
            (Some(up), Some(down)) if up < down => (up, Trend::Rising),
            (_, Some(down)) => (down, Trend::Falling),
            (Some(up), None) => (up, Trend::Rising),
            (None, None) => (limit, Trend::Stuck),
        };
        if end > x {
            self.go(TaylorExpansion { centre: x, end, coefficients: vec![y] });
        } else {
            // It only passes through: the break is a change of law without a stay.
            self.solution.breaks.pop();
        }
        if then != Trend::Stuck && end < 1.0 {
            self.turn(then);
        }
    }

    /// Where the law of a side first moves a lever that sticks from here on, before `limit`.
    fn comes_free(&self, side: Trend, came: Trend, limit: f64) -> Option<f64> {
        let from = self.x.max(LEAST_OVERRUN);
        if side != came && self.slope_back(side, from) < 0.0 {
            return Some(from);
        }
        first_fall(|x| self.slope_back(side, x), from, limit, STUCK_CELLS)
    }

    /// The slope that the law of a side gives the bottom where it is, at the overrun x; below 0 where it moves to that side.
    fn slope_back(&self, side: Trend, x: f64) -> f64 {
        if side == Trend::Rising { -self.rising.value(x, self.y) } else { self.falling.value(x, self.y) }
    }

    /// Share of the bottom's arm that is in use.
    fn arm_share(&self) -> f64 {
        self.y.abs() * self.solution.stroke / self.mechanism.bottom_arm
    }

    /// Remaining share of the column.
    fn column_left(&self) -> f64 {
        1.0 - (self.x + self.y) * self.solution.stroke / self.mechanism.bottom_law.column()
    }

    fn sine(&self) -> f64 {
        self.mechanism.lever(self.y * self.solution.stroke).sine
    }

    /// Whether the mechanism can reach this position.
    fn passable(&self) -> bool {
        self.arm_share() < ARM_SHARE && self.sine() > 0.0 && self.column_left() > 0.0
    }

    /// Why the solution ends ahead: the quantity that is nearest to zero.
    fn wall(&self) -> Refusal {
        let m = self.mechanism;
        let x = self.solution.stroke * self.x;
        let side = if self.y < 0.0 { Trend::Falling } else { Trend::Rising };
        // Where the arm ends before the roller moves along the bed, sin θ is small because the arm is used up.
        if !(self.sine() > NEAR) && m.furthest_before_line(side).is_finite() {
            return wall::line(x);
        }
        if self.arm_share() >= 1.0 - NEAR {
            return wall::arm(x, m.bottom_arm);
        }
        if self.column_left() <= NEAR {
            return wall::column(x);
        }
        if self.x + self.y < STIFF * self.x {
            return wall::stiff(x);
        }
        let [rising, falling] = [Trend::Rising, Trend::Falling].map(|side| {
            let slope =
                if self.x > 0.0 { Some(self.tape(side).value(self.x, self.y)) } else { starting_slope(m, side) };
            slope.map_or(f64::NAN, f64::abs)
        });
        let steep = rising.max(falling);
        if steep.is_nan() || steep > STEEP { wall::slope(x) } else { wall::unnamed(x) }
    }
}

/// Whether a series about x = 0 leaves it towards a sign. A slope of exactly 0 is decided by the next coefficient.
fn starts_towards(series: &TaylorExpansion, sign: f64) -> bool {
    let first = series.coefficients.iter().skip(1).find(|coefficient| **coefficient != 0.0);
    first.is_some_and(|coefficient| sign * coefficient > 0.0)
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
/// The mean of both directions has its root between theirs, since each is a falling function of w.
fn starting_slope(mechanism: &Mechanism, side: Trend) -> Option<f64> {
    let (braking, returning) = mechanism.efficiencies(side);
    let q = libm::sin(mechanism.friction_angle);
    let Lever { ratio, plus, minus, .. } = mechanism.lever(0.0);
    let surplus = mechanism.bottom_law.start_slope();
    match mechanism.exact_on {
        ExactOn::Braking => slope_one_way(ratio, plus, minus, q, braking, surplus),
        ExactOn::Return => slope_one_way(ratio, minus, plus, -q, returning, surplus),
        ExactOn::Mean => {
            let first = slope_one_way(ratio, plus, minus, q, braking, surplus)?;
            let second = slope_one_way(ratio, minus, plus, -q, returning, surplus)?;
            let tape = mechanism.starting_tape(side);
            // Without friction the two agree to a rounding, and there is nothing to bracket.
            root::bracketed(|w| tape.value(0.0, w) - w, first, second, 0.0).ok().or(Some(0.5 * (first + second)))
        }
    }
}

/// The slope at x = 0 in one direction, with `c` for C and `surplus` for c − 1: the root of a quadratic, which with C = λ, θ = Δ and
/// η (c − 1 − w)/(1 + w) for η B is
///
/// ```text
/// w² (η q − C s₊) − w [C (η s₋ + C q + s₊) + η (c−1) q] + C [η (c−1) s₋ − C q] = 0
/// ```
///
/// Its left side is positive at w = −1, so one root lies above −1 on the branch where C s₊ + η B q > 0, and the other is
/// past the wall.
fn slope_one_way(c: f64, plus: f64, minus: f64, q: f64, eta: f64, surplus: f64) -> Option<f64> {
    if !(plus > 0.0 && minus > 0.0) {
        return None;
    }
    let a2 = eta * q - c * plus;
    let a1 = c * (eta * minus + c * q + plus) + eta * surplus * q;
    let a0 = c * (eta * surplus * minus - c * q);
    let discriminant = a1 * a1 - 4.0 * a2 * a0;
    let below = a1 + discriminant.sqrt();
    let slope = 2.0 * a0 / below;
    // The branch: NaN and a slope past −1 cannot start a solution.
    let denominator = c * plus * (1.0 + slope) + eta * (surplus - slope) * q;
    (slope > -1.0 && denominator > 0.0 && below > 0.0).then_some(slope)
}

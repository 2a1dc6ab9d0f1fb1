//! The motion of the cam plate that rides on the bed: run-in, then the bottom's Δx over the overrun by equation (18).
//!
//! The parameter of the motion is the bed's position x in metres, 0 where the reversal starts. Before that the bed of a yoke runs at
//! constant speed, so that a crank angle w is a travel r w; a crank-slider holds its bed all the time.

mod mechanism;
mod ode;
mod stations;
mod wall;

pub use mechanism::{BedDirection, EfficiencyModel, ExactOn, Mechanism, Trend};
pub use ode::{Break, Solution};
pub use stations::Stations;

use super::transition::{Derivatives, Quintic, Transition};
use super::{Jet, Motion, Piece};
use camgen_kernel::numeric::extremum;
use camgen_kernel::refusal::Refusal;

/// How (18) is solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Solver {
    /// As a differential equation, to an absolute tolerance of Δx in m.
    Ode {
        /// The tolerance, m.
        tolerance: f64,
    },
    /// Station by station, as the paper does.
    Paper {
        /// Number of stations after the one at x = 0.
        stations: u32,
    },
}

/// Cells for the search of the lowest point in a piece.
const CELLS: u32 = 32;

/// Δx over the stroke.
#[derive(Debug, Clone, PartialEq)]
pub enum BottomMotion {
    /// By the differential equation.
    Ode(Solution),
    /// By stations.
    Paper(Stations),
}

impl BottomMotion {
    /// Solves (18).
    ///
    /// # Errors
    /// The wall that it runs into.
    pub fn solve(mechanism: &Mechanism, solver: Solver) -> Result<Self, Refusal> {
        match solver {
            Solver::Ode { tolerance } => Solution::new(mechanism, tolerance).map(Self::Ode),
            Solver::Paper { stations } => Stations::new(mechanism, stations).map(Self::Paper),
        }
    }

    /// Δx and its first three derivatives by x in [0, r], SI; at a break of the later side, or, with `before`, of the earlier one.
    #[must_use]
    pub fn at(&self, x: f64, before: bool) -> Derivatives {
        match self {
            Self::Ode(solution) => solution.at(x, before),
            Self::Paper(stations) => stations.at(x),
        }
    }

    /// Direction of the bottom there while x grows.
    #[must_use]
    pub fn trend(&self, x: f64, before: bool) -> Trend {
        match self {
            Self::Ode(solution) => solution.trend(x, before),
            Self::Paper(stations) => Mechanism::trend_of(stations.at(x)[1]),
        }
    }

    /// Where the law of the slope changes.
    #[must_use]
    pub fn breaks(&self) -> &[Break] {
        match self {
            Self::Ode(solution) => &solution.breaks,
            Self::Paper(_) => &[],
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum PieceShape {
    Flat(f64),
    Polynomial(Quintic),
    /// The motion, its end taken from before the break there.
    BottomMotion,
}

/// The motion of the plate.
#[derive(Debug, Clone)]
pub struct WedgeMotion {
    mechanism: Mechanism,
    motion: BottomMotion,
    pieces: Vec<Piece>,
    shapes: Vec<PieceShape>,
    lowest: f64,
}

impl WedgeMotion {
    /// Puts a flat of the given length (m), the transition and the motion together.
    ///
    /// # Errors
    /// [`Refusal`] when (18) has no solution or the transition does not fit.
    pub fn new(mechanism: Mechanism, solver: Solver, transition: Transition, flat: f64) -> Result<Self, Refusal> {
        let motion = BottomMotion::solve(&mechanism, solver)?;
        let bed = &mechanism.bottom_law;
        let stroke = bed.stroke();
        let mut law = Self { mechanism, motion, pieces: Vec::new(), shapes: Vec::new(), lowest: 0.0 };
        let (start, shape, motion_start) = match transition {
            Transition::None => (0.0, None, 0.0),
            Transition::RunUp { width } => {
                if width >= bed.before() {
                    let most_deg = degrees_down(bed.before());
                    let what =
                        format!("a run-up of {:.3} deg begins before the other end of the stroke", width.to_degrees());
                    return Err(Refusal::new(what).remedy(format!(
                        "give a transition.width below {most_deg} deg, which the bed takes from that end to the start \
                         of the reversal"
                    )));
                }
                let way = -bed.overrun(-width);
                let quintic = Quintic::run_up(-way, way, law.motion.at(0.0, false));
                (-way, Some(quintic), 0.0)
            }
            Transition::Blend { width } => {
                let half = 0.5 * width;
                if half > bed.dead() {
                    let most_deg = degrees_down(2.0 * bed.dead());
                    let what = format!("a blend of {:.3} deg reaches past the end of the stroke", width.to_degrees());
                    return Err(Refusal::new(what).remedy(format!("give a transition.width of {most_deg} deg at most")));
                }
                let (start, end) = (bed.overrun(-half), bed.overrun(half));
                (start, Some(Quintic::blend(start, end - start, 0.0, law.motion.at(end, false))), end)
            }
        };
        let level = shape.map_or(0.0, |quintic| quintic.level());
        law.push(start - flat, start, PieceShape::Flat(level));
        if let Some(quintic) = shape {
            law.push(start, motion_start, PieceShape::Polynomial(quintic));
        }
        let breaks: Vec<f64> =
            law.motion.breaks().iter().map(|b| b.x).filter(|x| (motion_start..stroke).contains(x)).collect();
        let mut from = motion_start;
        for end in breaks.into_iter().chain([stroke]) {
            law.push(from, end, PieceShape::BottomMotion);
            from = end;
        }
        law.lowest = law.find_lowest();
        Ok(law)
    }

    fn push(&mut self, start: f64, end: f64, shape: PieceShape) {
        // A nanometre of bed travel does not deserve a piece of its own.
        if end - start > 1e-9 {
            let dwell = matches!(shape, PieceShape::Flat(_)) || self.rests(start, end, shape);
            self.pieces.push(Piece { start, end, dwell });
            self.shapes.push(shape);
        } else if let Some(last) = self.pieces.last_mut() {
            last.end = end;
        }
    }

    /// A lever that sticks leaves a flat on the plate.
    fn rests(&self, start: f64, end: f64, shape: PieceShape) -> bool {
        shape == PieceShape::BottomMotion
            && matches!(self.motion, BottomMotion::Ode(_))
            && [start, 0.5 * (start + end)].into_iter().all(|x| self.motion.at(x, false)[1] == 0.0)
    }

    fn find_lowest(&self) -> f64 {
        let lowest = self.pieces.iter().enumerate().map(|(index, piece)| {
            let piece = (piece.start, piece.end);
            -extremum::largest(|x| -self.bottom(index, x).s, |x| -self.bottom(index, x).ds, piece, CELLS).value
        });
        lowest.fold(f64::INFINITY, f64::min)
    }

    /// Δx and its derivatives by x; m.
    #[must_use]
    pub fn bottom(&self, piece: usize, x: f64) -> Jet {
        let (Some(shape), Some(place)) = (self.shapes.get(piece), self.pieces.get(piece)) else {
            return Jet::default();
        };
        let [s, ds, dds, ddds] = match shape {
            PieceShape::Flat(level) => [*level, 0.0, 0.0, 0.0],
            PieceShape::Polynomial(quintic) => quintic.at(x),
            PieceShape::BottomMotion => self.motion.at(x, x >= place.end),
        };
        Jet { s, ds, dds, ddds }
    }

    /// Forces and lever.
    #[must_use]
    pub fn mechanism(&self) -> &Mechanism {
        &self.mechanism
    }

    /// Δx over the stroke.
    #[must_use]
    pub fn motion(&self) -> &BottomMotion {
        &self.motion
    }

    /// Δx at lift 0, m.
    #[must_use]
    pub fn lowest(&self) -> f64 {
        self.lowest
    }

    /// Jump of the slope dΔx/dx at x = 0: what a transition of kind `none` leaves.
    #[must_use]
    pub fn slope_jump(&self) -> f64 {
        let starts = self.shapes.iter().position(|shape| *shape == PieceShape::BottomMotion);
        match starts.and_then(|index| Some((index, self.shapes.get(index.checked_sub(1)?)?))) {
            Some((index, PieceShape::Flat(_))) => self.bottom(index, 0.0).ds,
            _ => 0.0,
        }
    }

    /// Direction of the bottom at x in a piece while x grows.
    #[must_use]
    pub fn trend(&self, piece: usize, x: f64) -> Trend {
        match (self.shapes.get(piece), self.pieces.get(piece)) {
            (Some(PieceShape::BottomMotion), Some(place)) => self.motion.trend(x, x >= place.end),
            _ => Mechanism::trend_of(self.bottom(piece, x).ds),
        }
    }

    /// Left side less right side of (18) over 2 p0 F in a direction of the bed; 0 before the reversal.
    #[must_use]
    pub fn residual(&self, piece: usize, x: f64, way: BedDirection) -> f64 {
        if x < 0.0 {
            return 0.0;
        }
        let bottom = self.bottom(piece, x);
        self.mechanism.residual_on(self.trend(piece, x), x, bottom.s, bottom.ds, way)
    }
}

/// An angle in degrees, as a value that may still be given.
fn degrees_down(angle: f64) -> f64 {
    (1e3 * angle.to_degrees()).floor() / 1e3
}

impl Motion for WedgeMotion {
    fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    fn jet(&self, piece: usize, x: f64) -> Jet {
        let bottom = self.bottom(piece, x);
        Jet { s: bottom.s - self.lowest, ..bottom }
    }

    fn period(&self) -> Option<f64> {
        None
    }

    /// The pace of the bed on its way out.
    fn pace(&self, x: f64) -> (f64, f64) {
        let [first, second, _] = self.mechanism.bottom_law.pace(x);
        (first, second)
    }
}

#[cfg(test)]
mod tests;

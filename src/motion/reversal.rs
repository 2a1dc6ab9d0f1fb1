//! The motion of one cam turn: dwell, transition, the press's law of the bottom over the reversal, mirrored transition.
//!
//! Everything is described by the crank angle φ of the braking half; the return half is its mirror, φ → π − φ, evaluated
//! through the same code so that both halves agree to the last bit. With lead, the bottom must retreat together with
//! the piston while x = r φ is still ahead of the reversal, from 0 at φ = −e/r to −e at φ = 0, or the air would be
//! compressed before; the ramp (key `run-up`) then ends at the start of that retreat.

use super::transition::{Derivatives, Quintic, Transition};
use super::{Jet, Motion, Piece};
use crate::buffer::bottom_law::BottomLaw;
use crate::numeric::extremum;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Cells for the search of the lowest point in a piece: the smooth pieces have two extrema at most.
const CELLS: u32 = 16;

/// Angle below which two breaks are one, rad: 1e-12 rad of a cam of a kilometre is a nanometre.
const SAME_ANGLE: f64 = 1e-12;

/// What a reversal law is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReversalLaw {
    /// The law of the bottom.
    pub bottom_law: BottomLaw,
    /// Roller travel per bottom travel, > 0.
    pub lever: f64,
    /// Cam turns per crank turn, > 0.
    pub ratio: f64,
    /// How the reversal is joined to the dwell.
    pub transition: Transition,
}

/// Why a motion cannot be put together.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// The pieces are longer than one turn.
    #[error("reversal and transitions take {needed_deg:.3} deg of the cam, more than one turn")]
    NoRoom {
        /// What they take, degrees of cam angle.
        needed_deg: f64,
    },
    /// A blend reaches past the middle of the reversal.
    #[error("a blend of {width_deg:.3} deg reaches past the middle of the reversal; at most 180 deg")]
    BlendTooWide {
        /// Its width, degrees of crank angle.
        width_deg: f64,
    },
    /// A blend cannot start from the retreat that a lead requires.
    #[error(
        "a lead needs the bottom to retreat before the reversal, which a blend would round off; use \
         transition.kind = \"run-up\" or \"none\""
    )]
    BlendWithLead,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Shape {
    Dwell(f64),
    Polynomial(Quintic),
    /// The retreat of a lead: −(lead + r φ).
    Retreat,
    Reversal,
}

/// The state of the machine at a cam angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Crank angle, rad, in [0, 2π).
    pub crank: f64,
    /// Bed overrun x, m; 0 outside the reversal.
    pub overrun: f64,
    /// Δx of the bottom, m.
    pub displacement: f64,
    /// p/p0 in the cylinders; 1 outside the reversal.
    pub pressure_ratio: f64,
}

/// The motion over one turn.
#[derive(Debug, Clone)]
pub struct Reversal {
    law: ReversalLaw,
    pieces: Vec<Piece>,
    /// Shape of each piece and whether it is seen mirrored.
    shapes: Vec<(Shape, bool)>,
    lowest: f64,
}

impl Reversal {
    /// Puts the pieces of one turn together.
    ///
    /// # Errors
    /// [`MotionError`] when they do not fit into the turn or exclude each other.
    pub fn new(law: ReversalLaw) -> Result<Self, MotionError> {
        let (bottom_law, ratio) = (&law.bottom_law, law.ratio);
        let retreat = bottom_law.lead / bottom_law.stroke;
        let mut before: Vec<(f64, Shape)> = Vec::new();
        let level;
        let mut law_start = 0.0;
        match law.transition {
            Transition::None => level = 0.0,
            Transition::RunUp { width } => {
                let end =
                    if retreat > 0.0 { [0.0, -bottom_law.stroke, 0.0, 0.0] } else { bottom_law_at(bottom_law, 0.0) };
                let quintic = Quintic::run_up(-retreat - width, width, end);
                level = quintic.level();
                before.push((-retreat - width, Shape::Polynomial(quintic)));
            }
            Transition::Blend { .. } if retreat > 0.0 => return Err(MotionError::BlendWithLead),
            Transition::Blend { width } if width > PI => {
                return Err(MotionError::BlendTooWide { width_deg: width.to_degrees() });
            }
            Transition::Blend { width } => {
                level = 0.0;
                let half = 0.5 * width;
                law_start = half;
                let quintic = Quintic::blend(-half, width, level, bottom_law_at(bottom_law, half));
                before.push((-half, Shape::Polynomial(quintic)));
            }
        }
        if retreat > 0.0 {
            before.push((-retreat, Shape::Retreat));
        }
        let first = before.first().map_or(0.0, |piece| piece.0);
        let needed = ratio * (PI - 2.0 * first);
        if needed > TAU + SAME_ANGLE {
            return Err(MotionError::NoRoom { needed_deg: needed.to_degrees() });
        }
        let ends: Vec<f64> = before.iter().skip(1).map(|piece| piece.0).chain([law_start]).collect();
        let mut motion = Self { law, pieces: Vec::new(), shapes: Vec::new(), lowest: 0.0 };
        for ((start, shape), end) in before.iter().zip(&ends) {
            motion.push(ratio * start, ratio * end, *shape, false);
        }
        motion.push(ratio * law_start, ratio * (PI - law_start), Shape::Reversal, false);
        for ((start, shape), end) in before.iter().zip(&ends).rev() {
            motion.push(ratio * (PI - end), ratio * (PI - start), *shape, true);
        }
        if TAU - needed > SAME_ANGLE {
            motion.push(ratio * (PI - first), TAU + ratio * first, Shape::Dwell(level), false);
        } else if let Some(last) = motion.pieces.last_mut() {
            // No dwell is left: the turn ends where it started.
            last.end = TAU + ratio * first;
        }
        motion.lowest = motion.find_lowest();
        Ok(motion)
    }

    fn push(&mut self, start: f64, end: f64, shape: Shape, mirrored: bool) {
        if end - start > SAME_ANGLE {
            self.pieces.push(Piece { start, end, dwell: matches!(shape, Shape::Dwell(_)) });
            self.shapes.push((shape, mirrored));
        }
    }

    fn find_lowest(&self) -> f64 {
        let lowest = self.pieces.iter().enumerate().map(|(index, piece)| {
            let value = |angle| -self.bottom(index, angle).s;
            let found =
                extremum::largest(value, |angle| -self.bottom(index, angle).ds, (piece.start, piece.end), CELLS);
            -found.value.max(value(0.5 * (piece.start + piece.end)))
        });
        lowest.fold(f64::INFINITY, f64::min)
    }

    /// Δx and its derivatives by the cam angle; m.
    #[must_use]
    pub fn bottom(&self, piece: usize, angle: f64) -> Jet {
        let Some(&(shape, mirrored)) = self.shapes.get(piece) else {
            return Jet::default();
        };
        let crank = angle / self.law.ratio;
        // The reversal is one smooth piece whose later half is the mirror of the earlier.
        let mirrored = mirrored || (shape == Shape::Reversal && crank > FRAC_PI_2);
        let crank = if mirrored { PI - crank } else { crank };
        let [s, ds, dds, ddds] = match shape {
            Shape::Dwell(level) => [level, 0.0, 0.0, 0.0],
            Shape::Polynomial(quintic) => quintic.at(crank),
            Shape::Retreat => {
                [-self.law.bottom_law.lead - self.law.bottom_law.stroke * crank, -self.law.bottom_law.stroke, 0.0, 0.0]
            }
            Shape::Reversal => bottom_law_at(&self.law.bottom_law, crank),
        };
        let jet = Jet { s, ds, dds, ddds }.by_angle_times(self.law.ratio);
        if mirrored { jet.mirrored() } else { jet }
    }

    /// The state of bed, bottom and air at a cam angle of a piece.
    #[must_use]
    pub fn state(&self, piece: usize, angle: f64) -> State {
        let crank = angle / self.law.ratio;
        let displacement = self.bottom(piece, angle).s;
        let (overrun, pressure_ratio) = if (0.0..=PI).contains(&crank) {
            let (x, _) = overrun(self.law.bottom_law.stroke, if crank > FRAC_PI_2 { PI - crank } else { crank });
            (x, self.law.bottom_law.pressure_ratio(x, displacement))
        } else {
            (0.0, 1.0)
        };
        let turn = if crank < 0.0 { crank + TAU / self.law.ratio } else { crank };
        let crank = turn % TAU;
        State { crank, overrun, displacement, pressure_ratio }
    }

    /// The lowest Δx of the turn, m: where the lift is counted from.
    #[must_use]
    pub fn lowest(&self) -> f64 {
        self.lowest
    }

    /// What the motion was made of.
    #[must_use]
    pub fn law(&self) -> &ReversalLaw {
        &self.law
    }

    /// Jump of the bottom's velocity by the crank angle at the start of the reversal, m/rad: what the transition `none` leaves.
    #[must_use]
    pub fn velocity_jump(&self) -> f64 {
        match (self.law.transition, self.law.bottom_law.lead > 0.0) {
            (_, true) => self.law.bottom_law.stroke * (1.0 + self.law.bottom_law.start_slope),
            (Transition::None, false) => self.law.bottom_law.stroke * self.law.bottom_law.start_slope,
            _ => 0.0,
        }
    }
}

/// x = r sin φ and y = r − x, both to full relative accuracy, for φ in [0, π/2].
fn overrun(stroke: f64, crank: f64) -> (f64, f64) {
    let half = libm::sin(0.5 * (FRAC_PI_2 - crank));
    (stroke * libm::sin(crank), 2.0 * stroke * half * half)
}

/// Δx by the crank angle in [0, π/2]: x' = r cos φ, x'' = −x, x''' = −x'.
fn bottom_law_at(bottom_law: &BottomLaw, crank: f64) -> Derivatives {
    let (x, y) = overrun(bottom_law.stroke, crank);
    let x1 = bottom_law.stroke * libm::sin(FRAC_PI_2 - crank);
    let bottom = bottom_law.bottom(x, y);
    [
        bottom.value,
        bottom.slope * x1,
        bottom.second * x1 * x1 - bottom.slope * x,
        bottom.third * x1 * x1 * x1 - 3.0 * bottom.second * x1 * x - bottom.slope * x1,
    ]
}

impl Motion for Reversal {
    fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    fn jet(&self, piece: usize, angle: f64) -> Jet {
        let bottom = self.bottom(piece, angle);
        Jet { s: bottom.s - self.lowest, ..bottom }.scaled(self.law.lever)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::buffer::bottom_law::Column;

    fn law(column: Column, lead: f64, transition: Transition) -> ReversalLaw {
        let bottom_law = BottomLaw::new(1.0 / 0.18, 1.35, 0.18, column, lead);
        ReversalLaw { bottom_law, lever: 1.0, ratio: 1.0, transition }
    }

    #[test]
    fn the_run_up_costs_the_known_extra_lift() {
        for (degrees, drop) in [(20.0_f64, 0.0019), (30.0, 0.0043)] {
            let width = degrees.to_radians();
            let motion = Reversal::new(law(Column::Matched, 0.0, Transition::RunUp { width })).expect("fits");
            let dwell = motion.pieces().iter().position(|p| p.dwell).expect("a dwell");
            let level = motion.bottom(dwell, 4.0).s;
            assert!((level + drop).abs() < 5e-5, "{degrees}°: {level}");
        }
    }

    /// Value, slope and acceleration are continuous wherever the transition promises it.
    #[test]
    fn joints_are_smooth_with_a_run_up_and_with_a_blend() {
        let width = 0.3;
        for column in [Column::Matched, Column::Return, Column::Length(0.2)] {
            for transition in [Transition::RunUp { width }, Transition::Blend { width }] {
                let motion = Reversal::new(law(column, 0.0, transition)).expect("fits");
                let pieces = motion.pieces();
                for i in 0..pieces.len() {
                    let next = (i + 1) % pieces.len();
                    let (a, b) = (motion.jet(i, pieces[i].end), motion.jet(next, pieces[next].start));
                    for (left, right) in [(a.s, b.s), (a.ds, b.ds), (a.dds, b.dds)] {
                        assert!((left - right).abs() < 1e-14, "{column:?} {transition:?}: {a:?} {b:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_blend_costs_the_known_residual() {
        for (degrees, share) in [(15.0_f64, 0.0004), (30.0, 0.0021)] {
            let width = degrees.to_radians();
            let motion = Reversal::new(law(Column::Matched, 0.0, Transition::Blend { width })).expect("fits");
            let mut worst = 0.0_f64;
            for i in 0..=2000 {
                let (piece, angle) = motion.locate(width * f64::from(i) / 2000.0);
                let state = motion.state(piece, angle);
                worst = worst.max((state.overrun / 0.18 - (state.pressure_ratio - 1.0)).abs());
            }
            assert!((worst - share).abs() < 5e-5, "{degrees}°: {worst}");
        }
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let wide = ReversalLaw { ratio: 1.9, ..law(Column::Matched, 0.0, Transition::RunUp { width: 0.3 }) };
        assert!(matches!(Reversal::new(wide), Err(MotionError::NoRoom { .. })));
        assert_eq!(
            Reversal::new(law(Column::Matched, 0.01, Transition::Blend { width: 0.3 })).err(),
            Some(MotionError::BlendWithLead)
        );
        assert!(matches!(
            Reversal::new(law(Column::Matched, 0.0, Transition::Blend { width: 3.2 })),
            Err(MotionError::BlendTooWide { .. })
        ));
        let whole = ReversalLaw { ratio: 2.0, ..law(Column::Matched, 0.0, Transition::None) };
        let motion = Reversal::new(whole).expect("a reversal as long as the turn has no dwell");
        assert!(motion.pieces().iter().all(|p| !p.dwell));
    }

    #[test]
    fn the_ends_of_the_reversal_are_exact() {
        let motion = Reversal::new(law(Column::Return, 0.0, Transition::None)).expect("fits");
        for degrees in [0.0_f64, 90.0, 180.0] {
            let (piece, angle) = motion.locate(degrees.to_radians());
            assert_eq!(motion.state(piece, angle).displacement, 0.0, "{degrees}°");
        }
        let with_lead = Reversal::new(law(Column::Matched, 0.02, Transition::RunUp { width: 0.3 })).expect("fits");
        let (piece, angle) = with_lead.locate(0.0);
        assert_eq!(with_lead.state(piece, angle).displacement, -0.02);
        let (piece, angle) = with_lead.locate(TAU - 0.02 / 0.18);
        assert!(with_lead.state(piece, angle).displacement.abs() < 1e-15, "the retreat starts at 0");
    }
}

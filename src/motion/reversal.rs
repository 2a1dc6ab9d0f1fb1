//! The motion of one cam turn: dwell, transition, the press's law of the bottom over the reversal, mirrored transition.
//!
//! Everything is described by the crank angle φ of the braking half; the return half is its mirror, φ → π − φ, evaluated
//! through the same code so that both halves agree to the last bit. A cam that turns once in n crank turns carries the
//! motion n times, in n equal lobes, so that it stands right at every reversal. With lead, the bottom must retreat together with
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
    /// Equal lobes of the cam, one for each crank turn in a turn of the cam; 0 counts as 1.
    pub lobes: u32,
    /// How the reversal is joined to the dwell.
    pub transition: Transition,
}

/// Why a motion cannot be put together.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// The pieces are longer than one turn.
    #[error("reversal and transitions take {needed_deg:.3} deg of the crank, more than one turn")]
    NoRoom {
        /// What they take, degrees of crank angle.
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
    /// Of all lobes, by the cam angle.
    pieces: Vec<Piece>,
    /// Of one lobe, by the crank angle.
    parts: Vec<Part>,
    lowest: f64,
}

/// A piece of one lobe.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Part {
    /// First and last crank angle, rad.
    start: f64,
    end: f64,
    shape: Shape,
    /// Whether the shape is seen mirrored.
    mirrored: bool,
}

impl Reversal {
    /// Puts the pieces of one turn together.
    ///
    /// # Errors
    /// [`MotionError`] when they do not fit into a turn of the crank or exclude each other.
    pub fn new(law: ReversalLaw) -> Result<Self, MotionError> {
        let parts = parts(&law)?;
        let mut motion = Self { law, pieces: Vec::new(), parts, lowest: 0.0 };
        motion.pieces = (0..law.lobes.max(1)).flat_map(|lobe| motion.lobe(lobe)).collect();
        motion.lowest = motion.find_lowest();
        Ok(motion)
    }

    fn count(&self) -> f64 {
        f64::from(self.law.lobes.max(1))
    }

    /// Cam angle at which the reversal of a lobe starts, rad.
    fn origin(&self, lobe: u32) -> f64 {
        TAU * f64::from(lobe) / self.count()
    }

    /// The pieces of a lobe by the cam angle; each starts where the one before it ends, also that of the lobe before.
    fn lobe(&self, lobe: u32) -> Vec<Piece> {
        let count = self.count();
        let first = self.parts.first().map_or(0.0, |part| part.start);
        let last = self.parts.len().saturating_sub(1);
        let piece = |(index, part): (usize, &Part)| {
            let place = |lobe: u32, crank: f64| self.origin(lobe) + crank / count;
            let end = match index == last {
                true if lobe + 1 < self.law.lobes => place(lobe + 1, first),
                true => TAU + first / count,
                false => place(lobe, part.end),
            };
            Piece { start: place(lobe, part.start), end, dwell: matches!(part.shape, Shape::Dwell(_)) }
        };
        self.parts.iter().enumerate().map(piece).collect()
    }

    /// The part of a lobe that a piece shows, and the crank angle in it at a cam angle, rad.
    fn part_at(&self, piece: usize, angle: f64) -> Option<(&Part, f64)> {
        let part = self.parts.get(piece.checked_rem(self.parts.len())?)?;
        let span = self.pieces.get(piece)?;
        // An end of a piece is the same crank angle in every lobe, to the last bit.
        if angle <= span.start {
            return Some((part, part.start));
        }
        if angle >= span.end {
            return Some((part, part.end));
        }
        let lobe = u32::try_from(piece / self.parts.len()).unwrap_or(0);
        let crank = (angle - self.origin(lobe)) * self.count();
        Some((part, crank.clamp(part.start, part.end)))
    }

    fn find_lowest(&self) -> f64 {
        let lowest = self.distinct().iter().enumerate().map(|(index, piece)| {
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
        let Some((&Part { shape, mirrored, .. }, crank)) = self.part_at(piece, angle) else {
            return Jet::default();
        };
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
        let jet = Jet { s, ds, dds, ddds }.by_angle_times(1.0 / self.count());
        if mirrored { jet.mirrored() } else { jet }
    }

    /// The state of bed, bottom and air at a cam angle of a piece.
    #[must_use]
    pub fn state(&self, piece: usize, angle: f64) -> State {
        let crank = self.part_at(piece, angle).map_or(0.0, |(_, crank)| crank);
        let displacement = self.bottom(piece, angle).s;
        let (overrun, pressure_ratio) = if (0.0..=PI).contains(&crank) {
            let (x, _) = overrun(self.law.bottom_law.stroke, if crank > FRAC_PI_2 { PI - crank } else { crank });
            (x, self.law.bottom_law.pressure_ratio(x, displacement))
        } else {
            (0.0, 1.0)
        };
        let turn = if crank < 0.0 { crank + TAU } else { crank };
        let crank = turn % TAU;
        State { crank, overrun, displacement, pressure_ratio }
    }

    /// The crank angle of the braking or returning half at an angle of a piece, rad; below 0 before the reversal.
    #[must_use]
    pub fn crank_in(&self, piece: usize, angle: f64) -> f64 {
        self.part_at(piece, angle).map_or(0.0, |(_, crank)| crank)
    }

    /// Whether the air is compressed on a piece, or a part of it.
    #[must_use]
    pub fn compresses(&self, piece: usize) -> bool {
        let part = self.parts.get(piece % self.parts.len().max(1));
        part.is_some_and(|part| part.end > 0.0 && part.start < PI)
    }

    /// The cam angle at which the air begins or ends to be compressed in the lobe of a piece, whichever is nearer to its middle, rad.
    #[must_use]
    pub fn air_begins_or_ends(&self, piece: usize) -> Option<f64> {
        let lobe = u32::try_from(piece.checked_div(self.parts.len())?).ok()?;
        let part = self.parts.get(piece % self.parts.len())?;
        let crank = if part.start + part.end < PI { 0.0 } else { PI };
        Some(self.origin(lobe) + crank / self.count())
    }

    /// Whether the force balance is exact on a piece.
    #[must_use]
    pub fn follows_law(&self, piece: usize) -> bool {
        self.parts.get(piece % self.parts.len().max(1)).is_some_and(|part| part.shape == Shape::Reversal)
    }

    /// The crank angle at which the exact law begins, rad: 0, or the end of a blend.
    #[must_use]
    pub fn law_begins(&self) -> Option<f64> {
        self.parts.iter().find(|part| part.shape == Shape::Reversal).map(|part| part.start)
    }

    /// Fourth derivative of the lift by the cam angle, m/rad⁴.
    #[must_use]
    pub fn fourth(&self, piece: usize, angle: f64) -> f64 {
        let Some((&Part { shape, mirrored, .. }, crank)) = self.part_at(piece, angle) else { return 0.0 };
        let mirrored = mirrored || (shape == Shape::Reversal && crank > FRAC_PI_2);
        let crank = if mirrored { PI - crank } else { crank };
        // An even derivative is the same in the mirror.
        let by_crank = match shape {
            Shape::Dwell(_) | Shape::Retreat => 0.0,
            Shape::Polynomial(quintic) => quintic.fourth(crank),
            Shape::Reversal => fourth_of_law(&self.law.bottom_law, crank),
        };
        let square = self.count() * self.count();
        self.law.lever * by_crank * square * square
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

/// The parts of one lobe by the crank angle: one turn of it, the dwell last.
fn parts(law: &ReversalLaw) -> Result<Vec<Part>, MotionError> {
    let bottom_law = &law.bottom_law;
    let retreat = bottom_law.lead / bottom_law.stroke;
    let mut before: Vec<(f64, Shape)> = Vec::new();
    let level;
    let mut law_start = 0.0;
    match law.transition {
        Transition::None => level = 0.0,
        Transition::RunUp { width } => {
            let end = if retreat > 0.0 { [0.0, -bottom_law.stroke, 0.0, 0.0] } else { bottom_law_at(bottom_law, 0.0) };
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
    let needed = PI - 2.0 * first;
    if needed > TAU + SAME_ANGLE {
        return Err(MotionError::NoRoom { needed_deg: needed.to_degrees() });
    }
    let ends: Vec<f64> = before.iter().skip(1).map(|piece| piece.0).chain([law_start]).collect();
    let rise = before.iter().zip(&ends).map(|(&(start, shape), &end)| Part { start, end, shape, mirrored: false });
    let reversal = Part { start: law_start, end: PI - law_start, shape: Shape::Reversal, mirrored: false };
    let mirror = |part: Part| Part { start: PI - part.end, end: PI - part.start, mirrored: true, ..part };
    let fall: Vec<Part> = rise.clone().rev().map(mirror).collect();
    let dwell = Part { start: PI - first, end: TAU + first, shape: Shape::Dwell(level), mirrored: false };
    let mut parts: Vec<Part> = rise.chain([reversal]).chain(fall).chain([dwell]).collect();
    parts.retain(|part| part.end - part.start > SAME_ANGLE);
    Ok(parts)
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

/// d⁴Δx/dφ⁴ in [0, π/2]; the fourth derivative of x = r sin φ is x itself.
fn fourth_of_law(bottom_law: &BottomLaw, crank: f64) -> f64 {
    let (x, y) = overrun(bottom_law.stroke, crank);
    let x1 = bottom_law.stroke * libm::sin(FRAC_PI_2 - crank);
    let bottom = bottom_law.bottom(x, y);
    let square = x1 * x1;
    let cross = bottom.second * (3.0 * x * x - 4.0 * square);
    bottom.fourth * square * square - 6.0 * bottom.third * square * x + cross + bottom.slope * x
}

impl Motion for Reversal {
    fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    fn lobes(&self) -> u32 {
        self.law.lobes.max(1)
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
        ReversalLaw { bottom_law, lever: 1.0, lobes: 1, transition }
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
        for lobes in [1, 2, 3] {
            let wide = ReversalLaw { lobes, ..law(Column::Matched, 0.0, Transition::RunUp { width: 1.6 }) };
            assert!(matches!(Reversal::new(wide), Err(MotionError::NoRoom { .. })), "{lobes} lobes");
        }
        assert_eq!(
            Reversal::new(law(Column::Matched, 0.01, Transition::Blend { width: 0.3 })).err(),
            Some(MotionError::BlendWithLead)
        );
        assert!(matches!(
            Reversal::new(law(Column::Matched, 0.0, Transition::Blend { width: 3.2 })),
            Err(MotionError::BlendTooWide { .. })
        ));
        let full = law(Column::Matched, 0.0, Transition::RunUp { width: 0.5 * PI });
        let motion = Reversal::new(full).expect("transitions as long as the rest of the turn leave no dwell");
        assert!(motion.pieces().iter().all(|p| !p.dwell));
    }

    /// n lobes are the one lobe n times, each derivative as much larger: an independent look at the angle n θ.
    #[test]
    fn n_lobes_repeat_the_motion_of_one() {
        for transition in [Transition::None, Transition::RunUp { width: 0.35 }, Transition::Blend { width: 0.3 }] {
            let one = Reversal::new(law(Column::Matched, 0.0, transition)).expect("fits");
            for lobes in [2_u32, 3, 4, 7, 30] {
                let n = f64::from(lobes);
                let many = Reversal::new(ReversalLaw { lobes, ..*one.law() }).expect("fits");
                assert_eq!(many.pieces().len(), one.pieces().len() * lobes as usize);
                assert_eq!(many.lowest(), one.lowest());
                for i in 0..3600 {
                    // Off the breaks, where either side is right.
                    let angle = (f64::from(i) + 0.37) * TAU / 3600.0;
                    let (piece, inside) = many.locate(angle);
                    let (same, crank) = one.locate((n * angle) % TAU);
                    let (found, known) = (many.jet(piece, inside), one.jet(same, crank));
                    // n θ is rounded where θ is not: 2π n ε of crank angle, on jets whose next derivative is at most that
                    // of a ramp's jerk, below 400 m/rad⁴.
                    for (found, known) in [
                        (found.s, known.s),
                        (found.ds / n, known.ds),
                        (found.dds / (n * n), known.dds),
                        (found.ddds / (n * n * n), known.ddds),
                    ] {
                        assert!((found - known).abs() < 2e-15 * n * 400.0, "{lobes} at {angle}: {found} {known}");
                    }
                    let (state, known) = (many.state(piece, inside), one.state(same, crank));
                    assert!((state.crank - known.crank).abs() < 2e-15 * n * 4.0, "{state:?} {known:?}");
                    assert!((state.overrun - known.overrun).abs() < 1e-15 * n);
                }
                for (index, piece) in many.pieces().iter().enumerate() {
                    let of_one = index % one.pieces().len();
                    for (at, by_one) in
                        [(piece.start, one.pieces()[of_one].start), (piece.end, one.pieces()[of_one].end)]
                    {
                        assert_eq!(
                            many.bottom(index, at).s.to_bits(),
                            one.bottom(of_one, by_one).s.to_bits(),
                            "{lobes}"
                        );
                    }
                }
            }
        }
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

//! The motion of one cam turn: dwell, transition, the press's law of the bottom over the reversal, mirrored transition.
//!
//! Under a yoke everything is described by the crank angle φ of the braking half; the return half is its mirror, φ → π − φ, evaluated
//! through the same code so that both halves agree to the last bit. A cam that turns once in n crank turns carries the
//! motion n times, in n equal lobes, so that it is in position at every reversal. With lead, the bottom must retreat together with
//! the piston while x = r φ is still ahead of the reversal, from 0 at φ = −e/r to −e at φ = 0, or the air would be
//! compressed before; the ramp (key `run-up`) then ends at the start of that retreat.
//!
//! Under any other linkage φ runs from the start of the reversal of one end of the stroke, and each of its two sides has a run-up, a
//! blend or a retreat of its own. A motion that is not symmetric leaves the bottom elsewhere than it took it: instead of a dwell a
//! ramp brings it back, with no air to compress.

mod sides;

use super::transition::{Derivatives, Quintic, Transition};
use super::{Jet, Motion, NamedStretch, Piece, RaiseSeries, own_pieces};
use crate::press::buffer::bottom_law::BottomLaw;
use crate::press::buffer::crank_law::CrankLaw;
use camgen_kernel::numeric::extremum;
use camgen_kernel::refusal::Refusal;
use sides::{parts, sides_of_linkage};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

/// Cells for the search of the lowest point in a piece: the smooth pieces have two extrema at most.
const CELLS: u32 = 16;

/// The parameters of a reversal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReversalLaw {
    /// The law of the bottom.
    pub bottom_law: CrankLaw,
    /// Roller travel per bottom travel, > 0.
    pub lever: f64,
    /// Equal lobes of the cam, one for each crank turn in a turn of the cam; 0 counts as 1.
    pub lobes: u32,
    /// How the reversal is joined to the dwell.
    pub transition: Transition,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum LobeShape {
    Dwell(f64),
    Polynomial(Quintic),
    /// The retreat of a lead: −(lead + x), under a yoke −(lead + r φ).
    Retreat,
    Reversal,
}

impl LobeShape {
    /// For people.
    fn name(self) -> &'static str {
        match self {
            Self::Dwell(_) => "dwell",
            Self::Polynomial(_) => "transition",
            Self::Retreat => "retreat with the bed",
            Self::Reversal => "reversal",
        }
    }
}

/// The state of the machine at a cam angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReversalState {
    /// Crank angle, rad, in [0, 2π).
    pub crank: f64,
    /// The bed is reversed at this angle: the air acts.
    pub reversing: bool,
    /// Bed overrun x, m; under a yoke 0 outside the reversal.
    pub overrun: f64,
    /// Deceleration a of the bed over the square of the crank speed, m; 0 outside the reversal. x itself under a yoke.
    pub deceleration: f64,
    /// Δx of the bottom, m.
    pub displacement: f64,
    /// p/p0 in the cylinders; 1 outside the reversal.
    pub pressure_ratio: f64,
}

/// Bed and air at one crank angle of the reversal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AirState {
    /// Deceleration of the bed over the square of the crank speed, m.
    pub deceleration: f64,
    /// p/p0 in the cylinders.
    pub pressure_ratio: f64,
}

impl AirState {
    /// Outside the reversal: the cylinders are open.
    const OPEN: Self = Self { deceleration: 0.0, pressure_ratio: 1.0 };
}

/// The motion over one turn.
#[derive(Debug, Clone)]
pub struct Reversal {
    law: ReversalLaw,
    /// By how much the cam is cut higher than the law over the reversal.
    raise: Option<Arc<RaiseSeries>>,
    /// The pieces of all lobes, by the cam angle.
    pieces: Vec<Piece>,
    /// The parts of one lobe, by the crank angle.
    parts: Vec<LobePart>,
    lowest: f64,
}

/// A piece of one lobe.
#[derive(Debug, Clone, Copy, PartialEq)]
struct LobePart {
    /// First and last crank angle, rad.
    start: f64,
    end: f64,
    shape: LobeShape,
    /// Whether the shape is seen mirrored.
    mirrored: bool,
}

impl Reversal {
    /// Puts the pieces of one turn together.
    ///
    /// # Errors
    /// [`Refusal`] when they do not fit into a turn of the crank or exclude each other.
    pub fn new(law: ReversalLaw) -> Result<Self, Refusal> {
        Self::with_raise(law, None)
    }

    /// The motion of a cam that is cut higher over the reversal. The machine is still in the state of the law: under load the follower
    /// is there.
    ///
    /// # Errors
    /// As [`Reversal::new`].
    pub fn with_raise(law: ReversalLaw, raise: Option<Arc<RaiseSeries>>) -> Result<Self, Refusal> {
        let parts = parts(&law, raise.as_deref())?;
        let mut motion = Self { law, raise, pieces: Vec::new(), parts, lowest: 0.0 };
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

    /// The pieces of a lobe by the cam angle; each starts where the one before it ends, across lobes too.
    fn lobe(&self, lobe: u32) -> Vec<Piece> {
        let count = self.count();
        let first = self.parts.first().map_or(0.0, |part| part.start);
        let last = self.parts.len().saturating_sub(1);
        let mut pieces = Vec::with_capacity(self.parts.len());
        for (index, part) in self.parts.iter().enumerate() {
            let end = match index == last {
                true if lobe + 1 < self.law.lobes => self.cam_angle(lobe + 1, first),
                true => TAU + first / count,
                false => self.cam_angle(lobe, part.end),
            };
            let start = self.cam_angle(lobe, part.start);
            pieces.push(Piece { start, end, dwell: matches!(part.shape, LobeShape::Dwell(_)) });
        }
        pieces
    }

    /// Cam angle at a crank angle of a lobe, rad.
    fn cam_angle(&self, lobe: u32, crank: f64) -> f64 {
        self.origin(lobe) + crank / self.count()
    }

    /// The part of a lobe that a piece shows, and the crank angle in it at a cam angle, rad.
    fn part_at(&self, piece: usize, angle: f64) -> Option<(&LobePart, f64)> {
        let part = self.parts.get(piece).or_else(|| self.parts.get(piece.checked_rem(self.parts.len())?))?;
        let span = self.pieces.get(piece)?;
        // An end of a piece is the same crank angle in every lobe, to the last bit.
        if angle <= span.start {
            return Some((part, part.start));
        }
        if angle >= span.end {
            return Some((part, part.end));
        }
        if self.law.lobes <= 1 {
            return Some((part, angle.clamp(part.start, part.end)));
        }
        let lobe = u32::try_from(piece / self.parts.len()).unwrap_or(0);
        let crank = (angle - self.origin(lobe)) * self.count();
        Some((part, crank.clamp(part.start, part.end)))
    }

    fn find_lowest(&self) -> f64 {
        let lowest = own_pieces(self).map(|(index, piece)| {
            let found = extremum::largest_with_slope(|angle| self.depth(index, angle), (piece.start, piece.end), CELLS);
            -found.value.max(self.depth(index, 0.5 * (piece.start + piece.end)).0)
        });
        lowest.fold(f64::INFINITY, f64::min)
    }

    /// How far the bottom is drawn back, −Δx in m, and its slope by the cam angle.
    fn depth(&self, piece: usize, angle: f64) -> (f64, f64) {
        let bottom = self.bottom(piece, angle);
        (-bottom.s, -bottom.ds)
    }

    /// Δx and its derivatives by the cam angle; m.
    #[must_use]
    pub fn bottom(&self, piece: usize, angle: f64) -> Jet {
        self.part_at(piece, angle).map_or(Jet::default(), |(part, at)| self.bottom_of(part, at))
    }

    fn bottom_of(&self, &LobePart { shape, mirrored, .. }: &LobePart, at: f64) -> Jet {
        let (mirrored, crank) = self.seen(shape, mirrored, at);
        let [s, ds, dds, ddds] = match (shape, &self.law.bottom_law) {
            (LobeShape::Dwell(level), _) => [level, 0.0, 0.0, 0.0],
            (LobeShape::Polynomial(quintic), _) => quintic.at(crank),
            (LobeShape::Retreat, CrankLaw::Yoke(law)) => [-law.lead - law.stroke * crank, -law.stroke, 0.0, 0.0],
            (LobeShape::Retreat, CrankLaw::Linkage(law)) => law.retreat(crank),
            (LobeShape::Reversal, law) => law_at(law, crank),
        };
        let jet = Jet { s, ds, dds, ddds };
        let jet = if self.law.lobes > 1 { jet.by_angle_times(1.0 / self.count()) } else { jet };
        let jet = if mirrored { jet.mirrored() } else { jet };
        match &self.raise {
            Some(raise) if shape == LobeShape::Reversal => jet.plus(raise.jet(at).by_angle_times(1.0 / self.count())),
            _ => jet,
        }
    }

    /// By how much the bottom is raised at a cam angle of a piece, m: 0 outside the reversal.
    #[must_use]
    pub fn raise_at(&self, piece: usize, angle: f64) -> f64 {
        self.part_at(piece, angle).map_or(0.0, |(part, crank)| self.raise_of(part, crank))
    }

    fn raise_of(&self, part: &LobePart, crank: f64) -> f64 {
        match &self.raise {
            Some(raise) if part.shape == LobeShape::Reversal => raise.at(crank)[0],
            _ => 0.0,
        }
    }

    /// Whether the cam is cut higher than the law.
    #[must_use]
    pub fn is_raised(&self) -> bool {
        self.raise.is_some()
    }

    /// Whether a shape is seen mirrored at a crank angle, and the angle at which it is evaluated. The reversal of a yoke is one smooth
    /// piece whose later half is the mirror of the earlier.
    fn seen(&self, shape: LobeShape, mirrored: bool, crank: f64) -> (bool, f64) {
        let of_yoke = matches!(self.law.bottom_law, CrankLaw::Yoke(_));
        let mirrored = mirrored || (of_yoke && shape == LobeShape::Reversal && crank > FRAC_PI_2);
        (mirrored, if mirrored { self.law.bottom_law.angle() - crank } else { crank })
    }

    /// The state of bed, bottom and air at a cam angle of a piece.
    #[must_use]
    pub fn state(&self, piece: usize, angle: f64) -> ReversalState {
        self.state_and_lift(piece, angle).0
    }

    /// The state of bed, bottom and air at a cam angle of a piece, and the lift there.
    #[must_use]
    pub fn state_and_lift(&self, piece: usize, angle: f64) -> (ReversalState, Jet) {
        let at = self.part_at(piece, angle);
        let bottom = at.map_or(Jet::default(), |(part, crank)| self.bottom_of(part, crank));
        let (crank, displacement, air) = at.map_or((0.0, 0.0, None), |(part, crank)| {
            let displacement = bottom.s - self.raise_of(part, crank);
            (crank, displacement, self.air_of(part, crank, 0.0, || displacement))
        });
        let law = &self.law.bottom_law;
        let (overrun, AirState { deceleration, pressure_ratio }) = match air {
            Some((overrun, air)) => (overrun, air),
            None if matches!(law, CrankLaw::Yoke(_)) => (0.0, AirState::OPEN),
            None => (law.place(crank) * law.stroke(), AirState::OPEN),
        };
        let turn = if crank < 0.0 { crank + TAU } else { crank };
        let crank = if turn < TAU { turn } else { turn % TAU };
        let reversing = crank <= law.angle();
        let state = ReversalState { crank, reversing, overrun, deceleration, displacement, pressure_ratio };
        (state, self.lift_over(bottom))
    }

    /// The lift for a bottom displacement, from its lowest.
    fn lift_over(&self, bottom: Jet) -> Jet {
        Jet { s: bottom.s - self.lowest, ..bottom }.scaled(self.law.lever)
    }

    /// Bed and air with the bottom off by so much (m, towards the piston) from its motion; `None` outside the reversal.
    #[must_use]
    pub fn air(&self, piece: usize, angle: f64, off: f64) -> Option<AirState> {
        let (part, crank) = self.part_at(piece, angle)?;
        let (_, air) = self.air_of(part, crank, off, || self.bottom_of(part, crank).s - self.raise_of(part, crank))?;
        Some(air)
    }

    /// Overrun of the bed, m, and [`Reversal::air`] of a part whose bottom may be known. Over the law itself the bottom is off by no more than that.
    fn air_of(
        &self,
        part: &LobePart,
        crank: f64,
        off: f64,
        displacement: impl FnOnce() -> f64,
    ) -> Option<(f64, AirState)> {
        let law = &self.law.bottom_law;
        if !(0.0..=law.angle()).contains(&crank) {
            return None;
        }
        let own = if part.shape == LobeShape::Reversal { 0.0 } else { displacement() - law.displacement(crank) };
        let [overrun, deceleration] = law.bed(crank);
        let pressure_ratio = law.pressure_ratio_off(crank, deceleration, own + off);
        Some((overrun, AirState { deceleration, pressure_ratio }))
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
        part.is_some_and(|part| part.end > 0.0 && part.start < self.law.bottom_law.angle())
    }

    /// The cam angle at which the air begins or ends to be compressed in the lobe of a piece, whichever is nearer to its middle, rad.
    #[must_use]
    pub fn air_begins_or_ends(&self, piece: usize) -> Option<f64> {
        let lobe = u32::try_from(piece.checked_div(self.parts.len())?).ok()?;
        let part = self.parts.get(piece % self.parts.len())?;
        let whole = self.law.bottom_law.angle();
        let crank = if part.start + part.end < whole { 0.0 } else { whole };
        Some(self.origin(lobe) + crank / self.count())
    }

    /// Whether the force balance is exact on a piece.
    #[must_use]
    pub fn follows_law(&self, piece: usize) -> bool {
        self.parts.get(piece % self.parts.len().max(1)).is_some_and(|part| part.shape == LobeShape::Reversal)
    }

    /// The crank angle at which the exact law begins, rad: 0, or the end of a blend.
    #[must_use]
    pub fn law_begins(&self) -> Option<f64> {
        self.parts.iter().find(|part| part.shape == LobeShape::Reversal).map(|part| part.start)
    }

    /// Fourth derivative of the lift by the cam angle, m/rad⁴.
    #[must_use]
    pub fn fourth(&self, piece: usize, angle: f64) -> f64 {
        let Some((&LobePart { shape, mirrored, .. }, at)) = self.part_at(piece, angle) else { return 0.0 };
        // An even derivative is the same in the mirror.
        let (_, crank) = self.seen(shape, mirrored, at);
        let by_crank = match (shape, &self.law.bottom_law) {
            (LobeShape::Dwell(_), _) | (LobeShape::Retreat, CrankLaw::Yoke(_)) => 0.0,
            (LobeShape::Retreat, CrankLaw::Linkage(law)) => -law.end.at(crank).x[4],
            (LobeShape::Polynomial(quintic), _) => quintic.fourth(crank),
            (LobeShape::Reversal, CrankLaw::Yoke(law)) => fourth_of_law(law, crank),
            (LobeShape::Reversal, CrankLaw::Linkage(law)) => law.at(crank)[4],
        };
        let of_raised =
            self.raise.as_ref().filter(|_| shape == LobeShape::Reversal).map_or(0.0, |raise| raise.at(at)[4]);
        let square = self.count() * self.count();
        self.law.lever * (by_crank + of_raised) * square * square
    }

    /// Slope and curvature of the bottom by the crank angle where the run-ups end, m/rad and m/rad²; the one after the reversal is seen in
    /// its mirror, and left out where it is that before. A lead ends its run-up with the speed of the bed.
    #[must_use]
    pub fn ends_of_run_ups(&self) -> Vec<[f64; 2]> {
        match &self.law.bottom_law {
            CrankLaw::Yoke(law) if law.retreat() > 0.0 => vec![[-law.stroke, 0.0]],
            CrankLaw::Yoke(law) => {
                let start = law.bottom(0.0, law.stroke);
                vec![[start.slope * law.stroke, start.second * law.stroke * law.stroke]]
            }
            CrankLaw::Linkage(law) => {
                let Ok(sides) = sides_of_linkage(&self.law, law, self.raise.as_deref()) else { return Vec::new() };
                let ends = sides.map(|side| [side.end_of_rise[1], side.end_of_rise[2]]);
                if law.end.symmetric() { ends.into_iter().take(1).collect() } else { ends.to_vec() }
            }
        }
    }

    /// The lowest Δx of the turn, m: where the lift is counted from.
    #[must_use]
    pub fn lowest(&self) -> f64 {
        self.lowest
    }

    /// The parameters of the motion.
    #[must_use]
    pub fn law(&self) -> &ReversalLaw {
        &self.law
    }

    /// Jump of the bottom's velocity by the crank angle at the start of the reversal, m/rad: what the transition `none` leaves. Under
    /// a linkage whose motion is not symmetric, the larger one of start and end, and whether it is that at the end.
    #[must_use]
    pub fn velocity_jump(&self) -> (f64, bool) {
        let law = &self.law.bottom_law;
        let leads = law.retreats();
        if !leads && self.law.transition != Transition::None {
            return (0.0, false);
        }
        let at_start = law.start_speed() * (f64::from(u8::from(leads)) + law.start_slope());
        let CrankLaw::Linkage(linkage) = law else { return (at_start, false) };
        let [_, after, ..] = linkage.at(linkage.end.angle());
        let retreats = leads && linkage.lead + linkage.end.overrun_at_end() > 0.0;
        let at_end = if retreats { linkage.retreat(linkage.end.angle())[1] - after } else { -after };
        // A jump that a run-up takes is none; a symmetric motion has the same at both ends.
        let jumps = retreats || self.law.transition == Transition::None;
        let larger = jumps && at_end.abs() > at_start.abs() * (1.0 + 1e-9);
        if larger { (at_end, true) } else { (at_start, false) }
    }
}

/// Δx by the crank angle of the reversal. Under a yoke the second half is computed in its mirror.
fn law_at(law: &CrankLaw, crank: f64) -> Derivatives {
    match law {
        CrankLaw::Yoke(law) => bottom_law_at(law, crank),
        CrankLaw::Linkage(law) => {
            let [value, first, second, third, _] = law.at(crank);
            [value, first, second, third]
        }
    }
}

/// x = r sin φ, y = r − x and x' = r cos φ, all to full relative accuracy, for φ in [0, π/2]. Where x is the larger part nothing is lost
/// in the difference.
fn overrun(stroke: f64, crank: f64) -> [f64; 3] {
    let (sine, cosine) = libm::sincos(0.5 * (FRAC_PI_2 - crank));
    let left = 2.0 * stroke * sine * sine;
    let x = if left <= 0.5 * stroke { stroke - left } else { stroke * libm::sin(crank) };
    [x, left, 2.0 * stroke * sine * cosine]
}

/// Δx by the crank angle in [0, π/2]: x' = r cos φ, x'' = −x, x''' = −x'.
fn bottom_law_at(bottom_law: &BottomLaw, crank: f64) -> Derivatives {
    let [x, y, x1] = overrun(bottom_law.stroke, crank);
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
    let [x, y, x1] = overrun(bottom_law.stroke, crank);
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

    fn named_stretches(&self) -> Vec<NamedStretch> {
        let mut stretches = Vec::with_capacity(self.pieces.len());
        for (index, piece) in self.pieces.iter().enumerate() {
            let part = self.parts.get(index % self.parts.len().max(1));
            let name = part.map_or("", |part| part.shape.name());
            stretches.push(NamedStretch { from: piece.start, to: piece.end, name: name.into() });
        }
        stretches
    }

    /// The part after the reversal of a symmetric motion mirrors the part before it.
    fn repeats(&self, piece: usize) -> (usize, bool) {
        let Some(own) = piece.checked_rem(self.parts.len()) else { return (piece, false) };
        let before = match self.parts.get(own) {
            Some(part) if part.mirrored => {
                self.parts.iter().take(own).position(|before| before.shape == part.shape && !before.mirrored)
            }
            _ => None,
        };
        before.map_or((own, false), |before| (before, true))
    }

    fn jet(&self, piece: usize, angle: f64) -> Jet {
        self.lift_over(self.bottom(piece, angle))
    }
}

#[cfg(test)]
mod tests;

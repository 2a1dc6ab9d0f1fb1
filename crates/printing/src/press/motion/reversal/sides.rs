//! The parts of one lobe: before and after the law, and the rest of the turn.

use super::{LobePart, LobeShape, ReversalLaw, bottom_law_at};
use crate::press::buffer::bottom_law::BottomLaw;
use crate::press::buffer::crank_law::{CrankLaw, LinkageLaw};
use crate::press::motion::RaiseSeries;
use crate::press::motion::transition::{Derivatives, Quintic, Transition};
use camgen_kernel::refusal::Refusal;
use std::f64::consts::TAU;

/// Angle below which two breaks are one, rad: 1e-12 rad of a cam of a kilometre is a nanometre.
const SAME_ANGLE: f64 = 1e-12;

/// Levels nearer to each other than this are one, m: what is raised on either side agrees to its rounding.
const SAME_LEVEL: f64 = 1e-15;

/// The parts before the law on one side of the reversal, by the crank angle of that side as if it were the braking one.
pub(super) struct ReversalSide {
    /// The parts before the law, with their first angles.
    before: Vec<(f64, LobeShape)>,
    /// Where the law begins.
    law_start: f64,
    /// Δx of the rest outside, m.
    level: f64,
    /// Motion of the bottom where a run-up ends.
    pub(super) end_of_rise: Derivatives,
}

impl ReversalSide {
    /// `retreat`: the angle that a lead takes; `end_of_rise` is what the bottom does there, `law_at` what the law does at an angle.
    fn new(
        transition: Transition,
        retreat: f64,
        level: f64,
        end_of_rise: Derivatives,
        law_at: impl Fn(f64) -> Derivatives,
    ) -> Self {
        let mut side = Self { before: Vec::new(), law_start: 0.0, level, end_of_rise };
        match transition {
            Transition::None => {}
            Transition::RunUp { width } => {
                let quintic = Quintic::run_up(-retreat - width, width, end_of_rise);
                side.level = quintic.level();
                side.before.push((-retreat - width, LobeShape::Polynomial(quintic)));
            }
            Transition::Blend { width } => {
                side.law_start = 0.5 * width;
                let quintic = Quintic::blend(-side.law_start, width, level, law_at(side.law_start));
                side.before.push((-side.law_start, LobeShape::Polynomial(quintic)));
            }
        }
        if retreat > 0.0 {
            side.before.push((-retreat, LobeShape::Retreat));
        }
        side
    }

    fn first(&self) -> f64 {
        self.before.first().map_or(0.0, |piece| piece.0)
    }

    /// The parts up to the law, in order.
    fn rise(&self) -> Vec<LobePart> {
        let ends = self.before.iter().skip(1).map(|piece| piece.0).chain([self.law_start]);
        self.before
            .iter()
            .zip(ends)
            .map(|(&(start, shape), end)| LobePart { start, end, shape, mirrored: false })
            .collect()
    }
}

/// A law with what the cam is raised by, at an angle of a side.
fn with_raise(law: Derivatives, raise: Option<&RaiseSeries>, angle: f64, whole: Option<f64>) -> Derivatives {
    let Some(raise) = raise else { return law };
    let [value, first, second, third, _] = raise.at(whole.map_or(angle, |whole| whole - angle));
    // A side behind the reversal is seen in its mirror.
    let sign = if whole.is_some() { -1.0 } else { 1.0 };
    let [s, ds, dds, ddds] = law;
    [s + value, ds + sign * first, dds + second, ddds + sign * third]
}

/// A side of the reversal of a yoke; the one behind it, in its mirror, differs from the one before by what the cam is raised by.
fn side_of_yoke(
    law: &ReversalLaw,
    bottom_law: &BottomLaw,
    raise: Option<&RaiseSeries>,
    whole: Option<f64>,
) -> ReversalSide {
    let retreat = bottom_law.retreat() / bottom_law.stroke;
    let end = if retreat > 0.0 {
        [0.0, -bottom_law.stroke, 0.0, 0.0]
    } else {
        with_raise(bottom_law_at(bottom_law, 0.0), raise, 0.0, whole)
    };
    let level = if retreat > 0.0 || raise.is_none() { 0.0 } else { end[0] };
    ReversalSide::new(law.transition, retreat, level, end, |angle| {
        with_raise(bottom_law_at(bottom_law, angle), raise, angle, whole)
    })
}

/// The law of a linkage as one side of the reversal sees it.
struct LinkageView<'a> {
    law: &'a LinkageLaw,
    raise: Option<&'a RaiseSeries>,
    /// Behind the reversal, seen in its mirror.
    mirrored: bool,
}

impl LinkageView<'_> {
    /// The crank angle of an angle of this side.
    fn crank(&self, angle: f64) -> f64 {
        if self.mirrored { self.law.end.angle() - angle } else { angle }
    }

    /// A motion by the crank angle, by the angle of this side.
    fn turned(&self, motion: Derivatives) -> Derivatives {
        let [value, first, second, third] = motion;
        if self.mirrored { [value, -first, second, -third] } else { motion }
    }

    /// Δx by the law, with what the cam is raised by.
    fn bottom(&self, angle: f64) -> Derivatives {
        let crank = self.crank(angle);
        let [value, first, second, third, _] = self.law.at(crank);
        self.turned(with_raise([value, first, second, third], self.raise, crank, None))
    }

    /// Δx while the bottom retreats with the piston.
    fn retreating(&self, angle: f64) -> Derivatives {
        self.turned(self.law.retreat(self.crank(angle)))
    }

    /// The side with a retreat of this angle; `level` is where the bottom then rests.
    fn side(&self, transition: Transition, retreat: f64, level: f64) -> ReversalSide {
        // The bottom retreats from where its column is closed, unless the piston is out of it at the end of the reversal already.
        let retreats = retreat > 0.0;
        let mut end = if retreats { self.retreating(-retreat) } else { self.bottom(0.0) };
        let level = if retreats || self.raise.is_none() { level } else { end[0] };
        end[0] = level;
        ReversalSide::new(transition, retreat.max(0.0), level, end, |angle| self.bottom(angle))
    }
}

/// The sides of the reversal of a linkage, the second one mirrored; of a symmetric motion they are one.
pub(super) fn sides_of_linkage(
    law: &ReversalLaw,
    of: &LinkageLaw,
    raise: Option<&RaiseSeries>,
) -> Result<[ReversalSide; 2], Refusal> {
    let whole = of.end.angle();
    let [before, after] = if of.lead > 0.0 {
        of.end.ahead(of.lead).ok_or_else(|| {
            Refusal::new(format!(
                "a lead of {} mm is longer than the bed moves from the start of its reversal to the other end of its \
                 stroke",
                1e3 * of.lead
            ))
        })?
    } else {
        [0.0, whole]
    };
    let seen_before = LinkageView { law: of, raise, mirrored: false };
    let seen_after = LinkageView { law: of, raise, mirrored: true };
    let left = -(of.lead + of.end.overrun_at_end());
    let first = seen_before.side(law.transition, -before, 0.0);
    let second = match of.end.symmetric() {
        true if raise.is_none() => seen_before.side(law.transition, -before, 0.0),
        true if of.lead > 0.0 => seen_after.side(law.transition, -before, 0.0),
        true => seen_after.side(law.transition, 0.0, 0.0),
        false if of.lead > 0.0 && left < 0.0 => seen_after.side(law.transition, after - whole, 0.0),
        false => seen_after.side(law.transition, 0.0, left),
    };
    Ok([first, second])
}

/// The parts of one lobe by the crank angle: one turn of it, the dwell last.
pub(super) fn parts(law: &ReversalLaw, raise: Option<&RaiseSeries>) -> Result<Vec<LobePart>, Refusal> {
    let (whole, levels) = (law.bottom_law.angle(), law.bottom_law.half_loop().is_some());
    let (most, retreats) = (law.bottom_law.widest_blend(), law.bottom_law.retreats());
    match law.transition {
        Transition::Blend { .. } if retreats => {
            let what = "a lead needs the bottom to retreat before the reversal, which a blend would round off";
            return Err(Refusal::new(what).remedy("use transition.kind = \"run-up\" or \"none\""));
        }
        Transition::Blend { .. } if levels => {
            let what = "a blend closes the air where it begins, and buffer.balance = \"level\" has its port shut a lead before the reversal";
            return Err(Refusal::new(what).remedy("use transition.kind = \"run-up\" or \"none\""));
        }
        Transition::Blend { width } if width > most => {
            let most_deg = (1e3 * most.to_degrees()).floor() / 1e3;
            let what = format!("a blend of {:.3} deg reaches past the middle of the reversal", width.to_degrees());
            return Err(Refusal::new(what).remedy(format!("give {most_deg} deg at most")));
        }
        _ => {}
    }
    let [first, second] = match &law.bottom_law {
        CrankLaw::Yoke(of) => [side_of_yoke(law, of, raise, None), side_of_yoke(law, of, raise, Some(whole))],
        CrankLaw::Linkage(of) => sides_of_linkage(law, of, raise)?,
    };
    let needed = whole - (first.first() + second.first());
    if needed > TAU + SAME_ANGLE {
        let what = "of the crank, more than one turn";
        return Err(Refusal::new(format!("reversal and transitions take {:.3} deg {what}", needed.to_degrees())));
    }
    let reversal =
        LobePart { start: first.law_start, end: whole - second.law_start, shape: LobeShape::Reversal, mirrored: false };
    let of_yoke = matches!(law.bottom_law, CrankLaw::Yoke(_));
    let fall = second.rise().into_iter().rev().map(|part| LobePart {
        start: whole - part.end,
        end: whole - part.start,
        // The retreat of a linkage is a function of the crank angle itself.
        mirrored: of_yoke || part.shape != LobeShape::Retreat,
        ..part
    });
    let (start, end) = (whole - second.first(), TAU + first.first());
    let back = LobePart { start, end, shape: rest(start, end, second.level, first.level)?, mirrored: false };
    let mut parts: Vec<LobePart> = first.rise().into_iter().chain([reversal]).chain(fall).chain([back]).collect();
    parts.retain(|part| part.end - part.start > SAME_ANGLE);
    Ok(parts)
}

/// The rest of the turn: a dwell, or a ramp from one level to another.
fn rest(start: f64, end: f64, from: f64, to: f64) -> Result<LobeShape, Refusal> {
    if (from - to).abs() <= SAME_LEVEL {
        return Ok(LobeShape::Dwell(from));
    }
    if end - start <= SAME_ANGLE {
        let apart = 1e3 * (to - from);
        return Err(Refusal::new(format!(
            "reversal and transitions take the whole turn of the crank and leave no room for the ramp that brings the \
             bottom back: it ends \
             {apart:.6} mm from where it began"
        )));
    }
    Ok(LobeShape::Polynomial(Quintic::blend(start, end - start, from, [to, 0.0, 0.0, 0.0])))
}

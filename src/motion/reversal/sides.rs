//! The parts of one lobe: what lies before and behind the law, and the rest of the turn.

use super::{MotionError, Part, ReversalLaw, Shape, bottom_law_at};
use crate::buffer::bottom_law::BottomLaw;
use crate::buffer::crank_law::{CrankLaw, LinkageLaw};
use crate::motion::Raised;
use crate::motion::transition::{Derivatives, Quintic, Transition};
use std::f64::consts::TAU;

/// Angle below which two breaks are one, rad: 1e-12 rad of a cam of a kilometre is a nanometre.
const SAME_ANGLE: f64 = 1e-12;

/// Levels nearer to each other than this are one, m: what is raised on either side agrees to its rounding.
const SAME_LEVEL: f64 = 1e-15;

/// What lies before the law on one side of the reversal, by the crank angle of that side as if it were the braking one.
pub(super) struct Side {
    /// The parts before the law, with their first angles.
    before: Vec<(f64, Shape)>,
    /// Where the law begins.
    law_start: f64,
    /// Δx of the rest outside, m.
    level: f64,
    /// What the bottom does where a run-up ends.
    pub(super) end_of_rise: Derivatives,
}

impl Side {
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
                side.before.push((-retreat - width, Shape::Polynomial(quintic)));
            }
            Transition::Blend { width } => {
                side.law_start = 0.5 * width;
                let quintic = Quintic::blend(-side.law_start, width, level, law_at(side.law_start));
                side.before.push((-side.law_start, Shape::Polynomial(quintic)));
            }
        }
        if retreat > 0.0 {
            side.before.push((-retreat, Shape::Retreat));
        }
        side
    }

    fn first(&self) -> f64 {
        self.before.first().map_or(0.0, |piece| piece.0)
    }

    /// The parts up to the law, in order.
    fn rise(&self) -> Vec<Part> {
        let ends = self.before.iter().skip(1).map(|piece| piece.0).chain([self.law_start]);
        self.before.iter().zip(ends).map(|(&(start, shape), end)| Part { start, end, shape, mirrored: false }).collect()
    }
}

/// A law with what the cam is raised by, at an angle of a side.
fn with_raised(law: Derivatives, raised: Option<&Raised>, angle: f64, whole: Option<f64>) -> Derivatives {
    let Some(raised) = raised else { return law };
    let [value, first, second, third, _] = raised.at(whole.map_or(angle, |whole| whole - angle));
    // A side behind the reversal is seen in its mirror.
    let sign = if whole.is_some() { -1.0 } else { 1.0 };
    let [s, ds, dds, ddds] = law;
    [s + value, ds + sign * first, dds + second, ddds + sign * third]
}

/// A side of the reversal of a yoke; the one behind it, in its mirror, differs from the one before by what the cam is raised by.
fn side_of_yoke(law: &ReversalLaw, bottom_law: &BottomLaw, raised: Option<&Raised>, whole: Option<f64>) -> Side {
    let retreat = bottom_law.lead / bottom_law.stroke;
    let at = |angle: f64| with_raised(bottom_law_at(bottom_law, angle), raised, angle, whole);
    let end = if retreat > 0.0 { [0.0, -bottom_law.stroke, 0.0, 0.0] } else { at(0.0) };
    let level = if retreat > 0.0 || raised.is_none() { 0.0 } else { end[0] };
    Side::new(law.transition, retreat, level, end, at)
}

/// The sides of the reversal of a linkage, the second one mirrored; of a symmetric motion they are one.
pub(super) fn sides_of_linkage(
    law: &ReversalLaw,
    of: &LinkageLaw,
    raised: Option<&Raised>,
) -> Result<[Side; 2], MotionError> {
    let whole = of.end.angle();
    let [before, after] = if of.lead > 0.0 {
        let lead_mm = 1e3 * of.lead;
        of.end.ahead(of.lead).ok_or(MotionError::LeadTooLong { lead_mm })?
    } else {
        [0.0, whole]
    };
    let in_mirror = |[value, first, second, third]: Derivatives| [value, -first, second, -third];
    let first_three = |angle: f64| {
        let [value, first, second, third, _] = of.at(angle);
        with_raised([value, first, second, third], raised, angle, None)
    };
    let retreating = |angle: f64| of.retreat(angle);
    let side = |retreat: f64, level: f64, mirrored: bool| {
        let seen = move |angle: f64, of: &dyn Fn(f64) -> Derivatives| {
            if mirrored { in_mirror(of(whole - angle)) } else { of(angle) }
        };
        // The bottom retreats from where its column is closed, unless the piston is out of it at the end of the reversal already.
        let retreats = retreat > 0.0;
        let mut end = if retreats { seen(-retreat, &retreating) } else { seen(0.0, &first_three) };
        let level = if retreats || raised.is_none() { level } else { end[0] };
        end[0] = level;
        Side::new(law.transition, retreat.max(0.0), level, end, |angle| seen(angle, &first_three))
    };
    let left = -(of.lead + of.end.overrun_at_end());
    let first = side(-before, 0.0, false);
    let second = match of.end.symmetric() {
        true if raised.is_none() => side(-before, 0.0, false),
        true if of.lead > 0.0 => side(-before, 0.0, true),
        true => side(0.0, 0.0, true),
        false if of.lead > 0.0 && left < 0.0 => side(after - whole, 0.0, true),
        false => side(0.0, left, true),
    };
    Ok([first, second])
}

/// The parts of one lobe by the crank angle: one turn of it, the dwell last.
pub(super) fn parts(law: &ReversalLaw, raised: Option<&Raised>) -> Result<Vec<Part>, MotionError> {
    let (whole, lead) = (law.bottom_law.angle(), law.bottom_law.lead());
    let (most, retreats) = (law.bottom_law.widest_blend(), lead > 0.0);
    match law.transition {
        Transition::Blend { .. } if retreats => return Err(MotionError::BlendWithLead),
        Transition::Blend { width } if width > most => {
            let most_deg = (1e3 * most.to_degrees()).floor() / 1e3;
            return Err(MotionError::BlendTooWide { width_deg: width.to_degrees(), most_deg });
        }
        _ => {}
    }
    let [first, second] = match &law.bottom_law {
        CrankLaw::Yoke(of) => [side_of_yoke(law, of, raised, None), side_of_yoke(law, of, raised, Some(whole))],
        CrankLaw::Linkage(of) => sides_of_linkage(law, of, raised)?,
    };
    let needed = whole - (first.first() + second.first());
    if needed > TAU + SAME_ANGLE {
        return Err(MotionError::NoRoom { needed_deg: needed.to_degrees() });
    }
    let reversal =
        Part { start: first.law_start, end: whole - second.law_start, shape: Shape::Reversal, mirrored: false };
    let of_yoke = matches!(law.bottom_law, CrankLaw::Yoke(_));
    let mirror = |part: Part| {
        // The retreat of a linkage is told by the crank angle itself.
        let mirrored = of_yoke || part.shape != Shape::Retreat;
        Part { start: whole - part.end, end: whole - part.start, mirrored, ..part }
    };
    let fall = second.rise().into_iter().rev().map(mirror);
    let (start, end) = (whole - second.first(), TAU + first.first());
    let back = Part { start, end, shape: rest((start, end), second.level, first.level)?, mirrored: false };
    let mut parts: Vec<Part> = first.rise().into_iter().chain([reversal]).chain(fall).chain([back]).collect();
    parts.retain(|part| part.end - part.start > SAME_ANGLE);
    Ok(parts)
}

/// The rest of the turn: a dwell, or a ramp from one level to another.
fn rest((start, end): (f64, f64), from: f64, to: f64) -> Result<Shape, MotionError> {
    if (from - to).abs() <= SAME_LEVEL {
        return Ok(Shape::Dwell(from));
    }
    if end - start <= SAME_ANGLE {
        return Err(MotionError::NoWayBack { apart_mm: 1e3 * (to - from) });
    }
    Ok(Shape::Polynomial(Quintic::blend(start, end - start, from, [to, 0.0, 0.0, 0.0])))
}

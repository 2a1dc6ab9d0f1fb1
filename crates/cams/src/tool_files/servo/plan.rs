//! Tables for a servo drive that moves as the follower would: nodes with position, velocity and acceleration, between which the drive runs on a
//! polynomial of degree 5.

use crate::body::{Body, Request};
use crate::report::shown;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::{Jet, Motion, Quantity};
use camgen_kernel::refusal::Refusal;
use std::f64::consts::TAU;

/// A node: master in degrees, slave in mm or degrees, and its first and second derivative by the master.
pub(super) type ServoNode = [f64; 4];

/// A table of a motion.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ServoTable {
    /// Whether the slave swings: then it is in degrees, else in mm.
    pub swings: bool,
    /// The nodes over one turn of the master, the last one a turn after the first.
    pub nodes: Vec<ServoNode>,
    /// By how much the slave goes on in a turn of the master, mm or degrees: 0 but for the turret of an indexer.
    pub advance: f64,
    /// Positions at equal parts of the turn, mm or degrees, so many that straight lines between them keep the tolerance; `None` where that would
    /// be more than a control takes.
    pub equal: Option<Vec<f64>>,
}

/// Largest error of the velocity over the largest velocity.
pub(super) const VELOCITY_SHARE: f64 = 1e-3;
/// What the plan leaves to rounding of the tolerance and of the error of the velocity.
const KEPT: f64 = 0.9;
/// Places of an interval at which the polynomial is compared.
const PLACES: u32 = 9;
/// Most halvings of an interval, and most nodes of a table: `nElements` of CODESYS is an INT.
const HALVINGS: u32 = 18;
const MOST_NODES: usize = 32_000;
/// Fewest and most lines of a table of equal parts.
const FEWEST_LINES: f64 = 360.0;
const MOST_LINES: f64 = 100_000.0;
/// Where the acceleration jumps by more than this share of the largest, two nodes stand, apart by twice this angle, rad.
const JUMP: f64 = 1e-6;
const APART: f64 = 1e-5;
/// A motion whose ends differ by less closes, m or rad.
const CLOSED: f64 = 1e-9;
/// A jump of the velocity beyond this share of the largest cannot be followed.
const VELOCITY_JUMP: f64 = 1e-6;

/// Why a cam has no table for a servo drive.
pub(super) fn unfit(body: &dyn Body) -> Option<&'static str> {
    match body.follower_motion() {
        None => Some("each of its sections has a motion of its own"),
        Some(motion) if motion.period().is_none() => Some("a plate has no turn of a master"),
        Some(_) => None,
    }
}

/// A piece of the motion, or a part of one, as it lies in the turn of the master.
#[derive(Debug, Clone, Copy)]
struct Span {
    piece: usize,
    from: f64,
    to: f64,
    /// From the angle of the master to that of the piece.
    shift: f64,
    /// From the position of the piece to that of the slave.
    rise: f64,
}

impl Span {
    fn state(&self, motion: &dyn Motion, at: f64) -> Jet {
        let jet = exact(motion, self.piece, at + self.shift);
        Jet { s: jet.s + self.rise, ..jet }
    }
}

/// By how much a motion goes on in a turn, m or rad.
pub(super) fn advance(motion: &dyn Motion) -> f64 {
    let pieces = motion.pieces();
    let ends = pieces.first().zip(pieces.last());
    let moved =
        ends.map_or(0.0, |(first, last)| motion.jet(pieces.len() - 1, last.end).s - motion.jet(0, first.start).s);
    if moved.abs() > CLOSED { moved } else { 0.0 }
}

/// The motion as a drive would run it: from its position at 0, by the master in rad, the slave in m or rad.
pub(super) fn exact(motion: &dyn Motion, piece: usize, angle: f64) -> Jet {
    let jet = motion.jet(piece, angle);
    Jet { s: jet.s + motion.origin().unwrap_or(0.0), ..jet }
}

/// The largest velocity of a motion, m or rad per rad, at many places.
pub(super) fn largest_velocity(body: &dyn Body) -> f64 {
    body.largest_rates()[0]
}

/// How far the position may be off, m or rad, for a tolerance in m at the follower.
pub(super) fn position_tolerance(body: &dyn Body, tolerance: f64) -> f64 {
    let arm = body.leverage();
    if arm > 0.0 { tolerance / arm } else { tolerance }
}

/// The table of a body.
///
/// # Errors
/// [`Refusal`] when it has no such motion, its velocity jumps, or too many nodes would be needed.
pub(super) fn table(body: &dyn Body, request: &Request) -> Result<ServoTable, Refusal> {
    if let Some(why) = unfit(body) {
        return Err(Refusal::new(why));
    }
    let motion = body.follower_motion().ok_or_else(|| Refusal::new("it has no motion of its own"))?;
    let allowed =
        [KEPT * position_tolerance(body, request.fit.tolerance), KEPT * VELOCITY_SHARE * largest_velocity(body)];
    let spans = spans(motion)?;
    let swings = motion.quantity() == Quantity::Angle;
    let mut nodes: Vec<ServoNode> = Vec::new();
    let node = |span: &Span, at: f64| node(&span.state(motion, at), at, swings);
    for span in &spans {
        nodes.push(node(span, span.from));
        let mut ends = Vec::new();
        halve(motion, span, (span.from, span.to), (allowed, HALVINGS), &mut ends)?;
        nodes.extend(ends.iter().map(|end| node(span, *end)));
        if nodes.len() > MOST_NODES {
            let what = format!("the table would have more than {MOST_NODES} nodes");
            return Err(Refusal::new(what).remedy("give a coarser --tolerance"));
        }
    }
    // Where nothing jumps the end of a span is the start of the next.
    nodes.dedup_by(|next, before| next[0] <= before[0]);
    let advance = advance(motion);
    // Straight lines over equal parts close the turn with the first position.
    let equal = if advance == 0.0 { equal(body, motion, allowed) } else { None };
    Ok(ServoTable { swings, nodes, advance: if swings { advance.to_degrees() } else { MILLIMETRES * advance }, equal })
}

/// Positions at equal parts of the turn between which straight lines keep what is allowed of position and velocity: over a part of length h such
/// a line is off by a h²/8 at most, its slope by a h/2, a being the largest acceleration.
fn equal(body: &dyn Body, motion: &dyn Motion, [position, velocity]: [f64; 2]) -> Option<Vec<f64>> {
    let [_, acceleration] = body.largest_rates();
    let longest = (8.0 * position / acceleration).sqrt().min(2.0 * velocity / acceleration);
    let count = (TAU / longest).ceil().max(FEWEST_LINES);
    if !(count <= MOST_LINES) {
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within its bounds")]
    let count = count as u32;
    let unit = if motion.quantity() == Quantity::Angle { 1f64.to_degrees() } else { MILLIMETRES };
    let at = |index: u32| {
        let (piece, angle) = motion.locate(TAU * f64::from(index) / f64::from(count));
        unit * exact(motion, piece, angle).s
    };
    Some((0..count).map(at).collect())
}

/// A state as a node.
fn node(jet: &Jet, at: f64, swings: bool) -> ServoNode {
    let (unit, degree) = (if swings { 1f64.to_degrees() } else { MILLIMETRES }, 1f64.to_radians());
    [at.to_degrees(), unit * jet.s, unit * jet.ds * degree, unit * jet.dds * degree * degree]
}

/// The pieces over one turn of the master from 0 on, shortened where the acceleration jumps.
fn spans(motion: &dyn Motion) -> Result<Vec<Span>, Refusal> {
    let (mut all, advance) = (Vec::new(), advance(motion));
    for (piece, own) in motion.pieces().iter().enumerate() {
        for turn in [-1.0, 0.0, 1.0, 2.0] {
            let shift = -turn * TAU;
            let (from, to) = ((own.start - shift).max(0.0), (own.end - shift).min(TAU));
            if to - from > APART {
                all.push(Span { piece, from, to, shift, rise: turn * advance });
            }
        }
    }
    all.sort_by(|a, b| a.from.total_cmp(&b.from));
    let largest = |of: fn(&Jet) -> f64| {
        let at = |span: &Span, share: f64| {
            of(&motion.jet(span.piece, span.from + share * (span.to - span.from) + span.shift))
        };
        let places = all.iter().flat_map(|span| (0..=8).map(move |i| at(span, f64::from(i) / 8.0).abs()));
        places.fold(0.0, f64::max)
    };
    let (velocity, acceleration) = (largest(|jet| jet.ds), largest(|jet| jet.dds));
    let count = all.len();
    let mut shortened = all.clone();
    for index in 0..count {
        let (before, after) = (all[index], all[(index + 1) % count]);
        let end = motion.jet(before.piece, before.to + before.shift);
        let start = motion.jet(after.piece, after.from + after.shift);
        if (end.ds - start.ds).abs() > VELOCITY_JUMP * velocity {
            let what = "the velocity of the motion jumps, and no drive follows";
            let place = format!("{:.3} deg", before.to.to_degrees());
            return Err(Refusal::new(what)
                .at(place)
                .remedy("give other laws or states of the segments that meet there"));
        }
        if (end.dds - start.dds).abs() > JUMP * acceleration && index + 1 < count {
            let least = (before.to - before.from).min(after.to - after.from);
            let apart = APART.min(0.1 * least);
            shortened[index].to -= apart;
            shortened[index + 1].from += apart;
        }
    }
    Ok(shortened)
}

/// The ends of the intervals into which a span is halved until the polynomial keeps what is allowed.
fn halve(
    motion: &dyn Motion,
    span: &Span,
    (from, to): (f64, f64),
    (allowed, left): ([f64; 2], u32),
    ends: &mut Vec<f64>,
) -> Result<(), Refusal> {
    let state = |at: f64| span.state(motion, at);
    let (start, end) = (state(from), state(to));
    let off = |step: u32| {
        let share = f64::from(step) / f64::from(PLACES);
        let (position, velocity) = hermite(&start, &end, to - from, share);
        let exact = state(from + share * (to - from));
        (position - exact.s).abs() <= allowed[0] && (velocity - exact.ds).abs() <= allowed[1]
    };
    if (1..PLACES).all(off) {
        ends.push(to);
        return Ok(());
    }
    if left == 0 || ends.len() > MOST_NODES {
        let place = format!("{:.3} deg", from.to_degrees());
        let allowed = shown(1e6 * allowed[0]);
        let refusal = Refusal::new(format!("no polynomial of degree 5 keeps {allowed} um or urad")).at(place);
        return Err(refusal.remedy("give a coarser --tolerance"));
    }
    let middle = 0.5 * (from + to);
    halve(motion, span, (from, middle), (allowed, left - 1), ends)?;
    halve(motion, span, (middle, to), (allowed, left - 1), ends)
}

/// Position and velocity of the polynomial of degree 5 with the states of both ends, at a share of its length: Hermite's basis.
fn hermite(start: &Jet, end: &Jet, length: f64, share: f64) -> (f64, f64) {
    let (t, u) = (share, 1.0 - share);
    let of = |t: f64, u: f64| {
        let position = u * u * u * (1.0 + 3.0 * t + 6.0 * t * t);
        let slope = -30.0 * t * t * u * u;
        let tangent = u * u * u * t * (1.0 + 3.0 * t);
        let tangent_slope = u * u * (1.0 + 2.0 * t - 15.0 * t * t);
        let bend = 0.5 * u * u * u * t * t;
        let bend_slope = 0.5 * u * u * t * (2.0 - 5.0 * t);
        [position, slope, tangent, tangent_slope, bend, bend_slope]
    };
    let ([p, ps, d, ds, b, bs], [q, qs, e, es, c, cs]) = (of(t, u), of(u, t));
    let square = length * length;
    let position = p * start.s + d * length * start.ds + b * square * start.dds + q * end.s - e * length * end.ds
        + c * square * end.dds;
    let velocity = ps * start.s + ds * length * start.ds + bs * square * start.dds - qs * end.s + es * length * end.ds
        - cs * square * end.dds;
    (position, velocity / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_basis_gives_back_every_polynomial_of_degree_5() {
        let at = |x: f64| {
            let s = 1.0 - 2.0 * x + 0.5 * x.powi(2) + 3.0 * x.powi(3) - x.powi(4) + 0.7 * x.powi(5);
            let ds = -2.0 + x + 9.0 * x.powi(2) - 4.0 * x.powi(3) + 3.5 * x.powi(4);
            let dds = 1.0 + 18.0 * x - 12.0 * x.powi(2) + 14.0 * x.powi(3);
            Jet { s, ds, dds, ddds: 0.0 }
        };
        let (from, to) = (0.3, 1.7);
        for step in 0..=20 {
            let share = f64::from(step) / 20.0;
            let (position, velocity) = hermite(&at(from), &at(to), to - from, share);
            let exact = at(from + share * (to - from));
            assert!((position - exact.s).abs() < 1e-12 && (velocity - exact.ds).abs() < 1e-12, "{share}");
        }
    }
}

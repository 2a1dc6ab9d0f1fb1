//! The proof: a follower rolled all round the outline as it is in the file, compared with the motion.
//!
//! For a cam angle, or an overrun of the bed, the motion and the follower's geometry give the place of the roller's centre. Its
//! distance from the outline, less the roller radius, is the gap along the normal: positive where metal is missing, negative where
//! metal is in excess. Moved along its path until it touches, the roller shows the lift the cam really gives, and that
//! lift the residual force that really remains. Normals, offsets, curvatures and arc fitting, by which the outline was made, are
//! not used; the same distances are measured a second time by parry2d on chords.

mod worst;

use super::check::{Evidence, FileCheck, WrittenOutline};
use super::{felt, sphere};
use crate::body::{Body, LoadAsCut};
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::report::{Bound, Finding, Place, Rolled, Verdict};
use camgen_kernel::follower::{Element, Touch};
use camgen_kernel::geometry::contour::{Contour, Edge};
use camgen_kernel::geometry::edge_tree::{Chords, EdgeTree, NearestCache};
use camgen_kernel::motion::{Jet, Quantity};
use camgen_kernel::profile::Curves;
use camgen_kernel::text::{Length, Text, text};
use nalgebra::Vector2;
use std::cell::Cell;

pub(super) const CHECK: FileCheck = FileCheck {
    check: Check {
        name: "rolling",
        on: CheckScope::Outline,
        unit: "mm",
        about: "The largest gap between the follower, placed as the motion requires, and the outline as it is in the file: positive \
                where metal is missing, negative where metal is in excess.",
        explained: CheckExplanation {
            bound: Bound::AtMost,
            formula: "the distance of the follower, placed by the motion, from the outline, less the roller's radius",
            usual: "the tolerance",
            change: "see `outline`, which shows where the file differs; an undercut cam cannot give this motion",
        },
    },
    run: check,
};

/// Two neighbouring places are no farther apart than this many evenly spaced ones over the motion would be.
const EVEN_PLACES: u32 = 360;
/// On a dwell they may be this many times farther apart: the gap from an arc is smooth, and its maximum is found by the slopes.
const RESTING: f64 = 10.0;
/// Every piece of the motion is divided into at least this many parts.
const PIECE_PLACES: u32 = 8;
/// How far from a jump of the force its sides are, rad or m.
const BESIDE: f64 = 1e-12;
/// With up to this many segments each has four places, beyond it one: an arc of a chain near the least possible number of arcs
/// misses the curve three times, to either side.
const FEW_SEGMENTS: usize = 1000;
const TOUCHED: u32 = 4;
/// An edge over which the roller moves by less than this, rad or m, is short.
const SHORT: f64 = 0.1;
/// Turn between two edges that is rounding, rad.
const SMOOTH: f64 = 1e-10;
/// With more than this many segments only some have a place: the others are too short to affect the motion, and `outline` follows them all.
const MOST_TOUCHED: usize = 50_000;
/// Places at which parry measures as well, and at which two simultaneous contacts are looked for.
const PARRY_PLACES: usize = 120;
/// The chords for parry lie within this share of the tolerance.
const CHORD_SHARE: f64 = 0.1;
/// Newton steps along the path, and the cosine below which the roller slides off instead of touching.
const TOUCH_STEPS: usize = 12;
const LEAST_COSINE: f64 = 0.05;
/// A roller nearer than this touches, mm.
const TOUCHING: f64 = 1e-10;
/// A longer step of Newton's method to the place over a point of the outline, rad or m, is not accepted.
const LONGEST_STEP: f64 = 0.01;
/// Rounding of a distance between points of a drawing, over its size.
const ROUNDING: f64 = 1e-14;

/// The roller at one place.
#[derive(Debug, Clone, Copy)]
struct RollSample {
    piece: usize,
    parameter: f64,
    gap: f64,
    /// Derivative of the gap by the parameter, mm; NaN under a face.
    gap_slope: f64,
    /// Error of the lift; `None` where the roller does not touch along its path, and where no follower runs.
    lift_error: Option<f64>,
    /// Derivative of the lift error by the parameter.
    lift_slope: f64,
    residual: f64,
    /// Where the roller, placed by the motion, is nearest to the outline, and its centre, mm.
    foot: Vector2<f64>,
    centre: Vector2<f64>,
    /// The edge of the foot.
    edge: usize,
    /// Whether no second place of the outline can lie within the tolerance of the roller.
    alone: bool,
    /// Difference between parry's distance and the exact one, where it was measured.
    difference: f64,
    double: bool,
}

/// The follower on one flank.
struct RolledFlank<'a> {
    body: &'a dyn Body,
    curves: Curves<'a>,
    tree: EdgeTree,
    /// The edges at whose end the outline has a corner.
    corners: Vec<usize>,
    /// Distance from the follower's curve to the surface of the element, mm.
    radius: f64,
    /// Tolerance, mm.
    tolerance: f64,
    /// What is known about the last place: the next one is usually near it.
    last: Cell<NearestCache>,
}

impl RolledFlank<'_> {
    /// Gap (mm) between the outline and the element with the point of its curve at a place, and the outward normal where they
    /// are nearest.
    fn clearance(&self, contact: &Touch, centre: Vector2<f64>) -> Option<(f64, Vector2<f64>)> {
        match self.curves.element() {
            Element::Roller { .. } => {
                let mut about = self.last.get();
                let nearest = self.tree.nearest_with_cache(centre, &mut about);
                self.last.set(about);
                let nearest = nearest?;
                // At a vertex the normal is that of the roller.
                let away = centre - nearest.foot;
                let distance = away.norm();
                // A knife edge lies on the outline itself, where the vector to the foot has no direction.
                let normal = if distance > TOUCHING && self.radius > 0.0 {
                    away * (-nearest.left.signum() / distance)
                } else {
                    Vector2::new(nearest.tangent.y, -nearest.tangent.x)
                };
                Some((-nearest.left - self.radius, normal))
            }
            // A face touches at the point of the outline that lies farthest along its normal.
            Element::Face => {
                let normal = contact.curve.outward();
                Some((centre.dot(&normal) - self.tree.farthest(normal)?, normal))
            }
        }
    }

    /// How far along its path the roller is from its place by the motion, mm, and the normal where it touches.
    fn lift_error(&self, contact: &Touch, first: (f64, Vector2<f64>)) -> Option<(f64, Vector2<f64>)> {
        let (centre, drive) = (contact.curve.point * 1e3, contact.drive);
        let (mut moved, (mut gap, mut normal)) = (0.0, first);
        for step in 0..TOUCH_STEPS {
            if gap.abs() <= TOUCHING {
                return Some((moved, normal));
            }
            let cosine = drive.dot(&normal);
            if cosine < LEAST_COSINE {
                return None;
            }
            let way = gap / cosine;
            moved -= way;
            // The error left by such a step is at most its square over the radius, once the last one has shown that the foot stays.
            if step > 0 && way * way <= TOUCHING * self.radius {
                return Some((moved, normal));
            }
            (gap, normal) = self.clearance(contact, centre + drive * moved)?;
        }
        (gap.abs() <= TOUCHING).then_some((moved, normal))
    }

    /// Lift error of a face on an arm, which swings until it touches: the travel is that of the place where it touches by the motion.
    fn swing_error(&self, piece: usize, parameter: f64, first: (f64, Vector2<f64>)) -> Option<(f64, Vector2<f64>)> {
        let (follower, law) = (self.curves.follower, self.curves.motion.jet(piece, parameter));
        let leverage = 1e3 * follower.leverage(&law);
        let mut rate = 1e3 * follower.on_face(&law)?.along_normal;
        if rate < LEAST_COSINE * leverage {
            return None;
        }
        let (mut swung, (mut gap, mut normal)) = (0.0, first);
        for _ in 0..TOUCH_STEPS {
            if gap.abs() <= TOUCHING {
                break;
            }
            let step = -gap / rate;
            swung += step;
            let touch = follower.touch(parameter, &Jet { s: law.s + swung, ..law });
            let before = gap;
            (gap, normal) = self.clearance(&touch, touch.curve.point * 1e3)?;
            rate = (gap - before) / step;
        }
        (gap.abs() <= TOUCHING).then_some((leverage * swung, normal))
    }

    fn gap(&self, piece: usize, parameter: f64) -> f64 {
        let contact = self.curves.touch(piece, parameter);
        self.clearance(&contact, contact.curve.point * 1e3).map_or(f64::INFINITY, |(gap, _)| gap)
    }

    fn sample(&self, piece: usize, parameter: f64) -> RollSample {
        let contact = self.curves.touch(piece, parameter);
        let centre = contact.curve.point * 1e3;
        let (gap, normal) = self.clearance(&contact, centre).unwrap_or((f64::INFINITY, contact.drive));
        let about = self.last.get();
        let alone = EdgeTree::is_single_within(&about, centre, self.radius.abs() + self.tolerance);
        let rolled = self.curves.motion.is_rolled(piece);
        let swings =
            matches!(self.curves.element(), Element::Face) && self.curves.follower.quantity() == Quantity::Angle;
        let touching = match (rolled, swings) {
            (false, _) => None,
            (true, true) => self.swing_error(piece, parameter, (gap, normal)),
            (true, false) => self.lift_error(&contact, (gap, normal)),
        };
        let lift_error = touching.map(|(moved, _)| moved);
        let moved = 1e-3 * lift_error.unwrap_or(gap);
        let residual = match self.body.load() {
            Some(load) if rolled => load.unbalanced((piece, parameter), moved, normal),
            _ => 0.0,
        };
        // A bottom so far off that no air remains gives no force.
        let residual = if residual.is_nan() { f64::INFINITY } else { residual };
        let rolls = matches!(self.curves.element(), Element::Roller { .. });
        // The centre moves, and the direction of its path turns; the distance from the outline changes with what lies along
        // the normal.
        let moves = contact.curve.tangent * (1e3 * contact.curve.speed);
        let turns = Vector2::new(-contact.drive.y, contact.drive.x) * contact.drive_turn;
        let lift_slope = touching
            .map_or(f64::NAN, |(moved, normal)| -normal.dot(&(moves + turns * moved)) / normal.dot(&contact.drive));
        RollSample {
            piece,
            parameter,
            gap,
            gap_slope: if rolls { normal.dot(&moves) } else { f64::NAN },
            lift_error,
            lift_slope: if rolls { lift_slope } else { f64::NAN },
            residual,
            foot: centre - normal * (self.radius + gap),
            centre,
            edge: about.edge(),
            alone,
            difference: 0.0,
            double: false,
        }
    }

    /// The parameter at which the roller, placed by the motion, is nearest to a place of the outline with this outward normal.
    fn parameter_over(&self, point: Vector2<f64>, outward: Vector2<f64>) -> f64 {
        let near = self.curves.follower.parameter_of((point + outward * self.radius) * 1e-3, outward);
        if !near.is_finite() || matches!(self.curves.element(), Element::Face) {
            return near;
        }
        let (piece, inside) = self.curves.motion.locate(near);
        let curve = self.curves.touch(piece, inside).curve;
        let away = curve.point * 1e3 - point;
        // (P − v)·P' = 0 by a step of Newton's method: the distance from a vertex is least or largest there.
        let run = curve.speed * (1e3 - curve.curvature * away.dot(&curve.outward()));
        let step = away.dot(&curve.tangent) / run;
        if step.abs() < LONGEST_STEP { near - step } else { near }
    }

    /// The parameters at which the roller touches the start of every edge, this many more places of it, and the end of an edge before a corner.
    fn touching(&self) -> Vec<f64> {
        let edges = self.tree.edges();
        let over = |edge: &Edge, share: f64| {
            let (point, tangent) = edge.point_and_tangent(share);
            self.parameter_over(point, Vector2::new(tangent.y, -tangent.x))
        };
        if edges.len() > FEW_SEGMENTS {
            return edges.iter().step_by(edges.len() / MOST_TOUCHED + 1).map(|edge| over(edge, 0.0)).collect();
        }
        let period = self.curves.motion.period();
        let mut before: Option<(Vector2<f64>, f64)> = None;
        let mut touching = Vec::with_capacity(edges.len() * TOUCHED as usize);
        for edge in edges {
            let tangent = edge.start_tangent();
            let smooth =
                before.filter(|(before, _)| before.perp(&tangent).abs() < SMOOTH && before.dot(&tangent) > 0.0);
            // At a corner the roller turns about the vertex, from its place on the edge before.
            touching.extend(before.filter(|_| smooth.is_none()).map(|(_, at)| at));
            let from = smooth.map_or_else(|| over(edge, 0.0), |(_, at)| at);
            let to = over(edge, 1.0);
            before = Some((edge.end_tangent(), to));
            let way = to - from;
            let way = period.map_or(way, |period| way - period * (way / period).round());
            // Over a short edge the places need not be exact.
            let short = way > 0.0 && way < SHORT;
            touching.extend((0..TOUCHED).map(|step| {
                let share = f64::from(step) / f64::from(TOUCHED);
                match step {
                    0 => from,
                    _ if short => from + share * way,
                    _ => over(edge, share),
                }
            }));
        }
        touching.extend(before.map(|(_, at)| at));
        touching
    }

    /// Both ends of every piece, places at which the roller touches the segments, and enough places between them that neighbours are
    /// no farther apart than even ones would be; by piece.
    fn places(&self) -> Vec<(usize, f64)> {
        let (first, last) = self.curves.motion.range();
        let period = self.curves.motion.period();
        let within =
            |parameter: &f64| parameter.is_finite() && (period.is_some() || (first..=last).contains(parameter));
        let located = self.touching().into_iter().filter(within).map(|parameter| self.curves.motion.locate(parameter));
        let pieces = self.curves.motion.pieces();
        let ends = pieces.iter().enumerate().flat_map(|(index, piece)| [(index, piece.start), (index, piece.end)]);
        // Where the air closes and opens, the residual force jumps, also in the middle of a piece: sampled on both sides of it.
        let jumps = self
            .body
            .load()
            .map_or_else(Vec::new, LoadAsCut::jumps)
            .into_iter()
            .flat_map(|at| [at - BESIDE, at, at + BESIDE]);
        let jumps = jumps.filter(within).map(|parameter| self.curves.motion.locate(parameter));
        // Every piece has its own places, however short it is.
        let own = pieces.iter().enumerate().filter(|(_, piece)| !piece.dwell);
        let own = own.flat_map(|(index, piece)| {
            (1..PIECE_PLACES).map(move |i| {
                let share = f64::from(i) / f64::from(PIECE_PLACES);
                (index, piece.start + (piece.end - piece.start) * share)
            })
        });
        let mut places: Vec<(usize, f64)> = located.chain(ends).chain(jumps).chain(own).collect();
        places.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        places.dedup();
        let most = (last - first) / f64::from(EVEN_PLACES);
        let mut all = Vec::with_capacity(2 * places.len());
        for (index, &(piece, from)) in places.iter().enumerate() {
            all.push((piece, from));
            let Some(&(_, to)) = places.get(index + 1).filter(|next| next.0 == piece) else { continue };
            let rests = pieces.get(piece).is_some_and(|piece| piece.dwell);
            let steps = ((to - from) / if rests { RESTING * most } else { most }).ceil();
            let mut step = 1.0;
            while step < steps {
                all.push((piece, from + (to - from) * step / steps));
                step += 1.0;
            }
        }
        all
    }

    /// Every sample of this flank.
    fn samples(&self, chords: &Chords) -> Vec<RollSample> {
        let places = self.places();
        // With room for the places found between them.
        let mut samples: Vec<RollSample> = Vec::with_capacity(places.len() + places.len() / 4);
        samples.extend(places.into_iter().map(|(piece, parameter)| self.sample(piece, parameter)));
        let rolls = matches!(self.curves.element(), Element::Roller { .. });
        let mut more = self.solved(&samples);
        if !rolls {
            more.extend(self.closer(&samples, |s| s.gap.abs(), |piece, at| self.gap(piece, at).abs()));
        }
        // Next to the even places, before others crowd about the largest gap.
        more.extend(self.worst_residual(&samples));
        samples.extend(more);
        let thinned = (samples.len() / PARRY_PLACES).max(1);
        for (index, sample) in samples.iter_mut().enumerate() {
            if index % thinned != 0 {
                continue;
            }
            let centre = sample.centre;
            let by_chords = if rolls {
                chords.distance_when_known(centre, sample.gap + self.radius)
            } else {
                let normal = self.curves.touch(sample.piece, sample.parameter).curve.outward();
                centre.dot(&normal) - chords.farthest(normal)
            };
            sample.difference = (by_chords - (sample.gap + self.radius)).abs();
            sample.double = rolls
                && !sample.alone
                && sample.gap.abs() <= self.tolerance
                && self.tree.places_within(centre, self.radius.abs() + self.tolerance) > 1;
        }
        samples
    }
}

/// Rolls the followers of a body on its outlines as they were written; the sections of a surface are left out. Tolerance in mm.
#[must_use]
pub fn roll_all(body: &dyn Body, outlines: &[WrittenOutline], tolerance: f64) -> Vec<Rolled> {
    let cuts = body.cuts();
    let of = |outline: &WrittenOutline| {
        let cut = cuts.get(outline.cut)?;
        Some(roll(body, (cut.curves?, cut.mirrored), &outline.contour, tolerance))
    };
    outlines.iter().filter_map(of).collect()
}

/// Rolls a follower on an outline as it was written, or mirrored about X as the follower meets it, and compares with the law; tolerance in mm.
#[must_use]
pub fn roll(body: &dyn Body, (curves, mirrored): (Curves<'_>, &[bool]), contour: &Contour, tolerance: f64) -> Rolled {
    let (mut samples, mut errors) = (Vec::new(), Vec::new());
    let (mut chord_count, mut sagitta) = (0, 0.0_f64);
    let mut touches = true;
    let mut trees = Vec::new();
    for mirrored in mirrored {
        let contour = if *mirrored { contour.mirrored_about_x() } else { contour.clone() };
        let (tree, radius) = (EdgeTree::new(&contour), 1e3 * curves.offset());
        let corners = worst::corners(tree.edges());
        let roll = RolledFlank { body, curves, tree, corners, radius, tolerance, last: Cell::default() };
        let chords = Chords::new(&contour, CHORD_SHARE * tolerance);
        let found = roll.samples(&chords);
        let lifts: Vec<f64> = found.iter().filter_map(|s| s.lift_error).map(f64::abs).collect();
        touches &= lifts.len() == found.iter().filter(|s| curves.motion.is_rolled(s.piece)).count();
        errors.extend(lifts);
        // A disc has one flank.
        samples = if samples.is_empty() { found } else { samples.into_iter().chain(found).collect() };
        (chord_count, sagitta) = (chord_count + chords.count, sagitta.max(chords.sagitta));
        trees.push(roll.tree);
    }
    let ninety_nine = (errors.len() * 99 / 100).min(errors.len().saturating_sub(1));
    let q99 = (!errors.is_empty()).then(|| *errors.select_nth_unstable_by(ninety_nine, f64::total_cmp).1);
    let doubles: Vec<&RollSample> = samples.iter().filter(|s| s.double).collect();
    let worst = samples.iter().max_by(|a, b| a.gap.abs().total_cmp(&b.gap.abs()));
    let residual = samples.iter().max_by(|a, b| a.residual.total_cmp(&b.residual));
    let lift_error = samples.iter().filter_map(|s| s.lift_error).map(f64::abs).fold(0.0, f64::max);
    Rolled {
        places: samples.len(),
        segments: contour.vertices.len(),
        gap_mm: worst.map_or(f64::INFINITY, |s| if curves.offset() < 0.0 { -s.gap } else { s.gap }),
        gap_at: worst.map_or_else(Place::default, |s| body.place(s.parameter)),
        lift_error_max_mm: touches.then_some(lift_error),
        lift_error_q99_mm: if touches { q99 } else { None },
        double_contacts: doubles.len(),
        double_contact_at: doubles.first().map(|s| body.place(s.parameter)),
        chords: chord_count,
        chord_sagitta_mm: sagitta,
        chord_difference_mm: samples.iter().map(|s| s.difference).fold(0.0, f64::max),
        residual_max_n: residual.map_or(0.0, |s| s.residual),
        residual_at: residual.map_or_else(Place::default, |s| body.place(s.parameter)),
        // Where motion is lost, there is no velocity to compare.
        as_cut: if touches { felt::of_flanks(body, curves, trees.iter().map(EdgeTree::edges)) } else { None },
    }
}

/// The verdict on the result of rolling.
fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    if let Some(surface) = evidence.body.surface() {
        return sphere::on_sections(evidence, surface, &CHECK);
    }
    let rolled = evidence.worst_rolled()?;
    let size = evidence.outlines.first().map_or(1.0, |outline| outline.contour.extents().size().max());
    let agree = rolled.chord_difference_mm <= rolled.chord_sagitta_mm + ROUNDING * size;
    let kept = rolled.gap_mm.abs() <= evidence.tolerance_mm;
    let found = CHECK.found(rolled.gap_mm.abs(), Some(evidence.tolerance_mm), Verdict::of(kept && agree));
    Some(Finding { place: rolled.gap_at, note: Some(words(rolled, kept, agree)), ..found })
}

fn words(rolled: &Rolled, kept: bool, agree: bool) -> Text {
    let fault = if rolled.gap_mm > 0.0 { "metal is missing" } else { "metal is in excess" };
    let lift = match (rolled.lift_error_max_mm, rolled.lift_error_q99_mm) {
        (Some(most), Some(q99)) => {
            text!("lift off by {} at most, {} in 99 of 100", Length::um_of_mm(most), Length::um_of_mm(q99))
        }
        _ => "there is a place at which the roller does not touch along its path".into(),
    };
    let compared = text!(
        "law against {} segments as read from the file, roller at {} places; {}; parry2d on {} chords {}",
        rolled.segments,
        rolled.places,
        lift,
        rolled.chords,
        if agree { "agrees" } else { "DISAGREES" },
    );
    let double = rolled.double_contact_at.map(|at| text!("two simultaneous contacts at {}", at.text()));
    let compared = compared.and("; ", double);
    if kept { compared } else { Text::from(fault).and("; ", compared) }
}

#[cfg(test)]
mod tests;

//! The flanks of a globoid as bicubic spline patches, and its solid: u runs along the groove, v from the floor to the outside. Every place of a flank
//! lies exactly at its distance from the turret's axis, so that the rims lie on their tori within what the splines miss; the first and the last patch end on the
//! cones, each place at its own cam angle.

use super::{End, FlankCurve, Globoid};
use crate::body::swept::{FlankSide, LONGEST_PATCH, SweptBody, fitted_flanks};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::patch_fit::FlankStretch;
use camgen_kernel::geometry::solid::CheckedSolid;
use camgen_kernel::geometry::solid::globoid::{GlobeGroove, GrooveGloboid};
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// Shortest patch between an end and a joint of the motion, rad.
const SHORTEST: f64 = 0.04;
/// Distances from the turret's axis at which the cam angles of an end are compared.
const PLACES: u32 = 8;
/// Joints whose angles differ by less are one, rad.
const SAME: f64 = 1e-9;

/// Where a stretch begins or ends.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Bound {
    /// At a cam angle of any turn.
    At(f64),
    /// At an end of the cam.
    End(End),
}

/// A stretch of a flank; its piece and the turns beyond it where it lies within one piece.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    piece: Option<(usize, f64)>,
    bounds: [Bound; 2],
}

/// The stretches of the flank of a roller.
struct Course {
    flank: FlankSide,
    roller: f64,
    stretches: Vec<Stretch>,
}

impl Course {
    /// The stretches that begin at one cam angle, with it.
    fn stations(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.stretches.iter().enumerate().filter_map(|(index, stretch)| match stretch.bounds[0] {
            Bound::At(angle) => Some((index, angle)),
            Bound::End(_) => None,
        })
    }
}

/// A place at which flanks are divided: a cam angle of any turn, and the piece of the motion that follows with the turns beyond it.
#[derive(Debug, Clone, Copy)]
struct Joint {
    at: f64,
    piece: (usize, f64),
}

/// The solid, how many patches its flanks have, and what they miss of the exact ones, mm.
pub(super) struct GloboidSolid {
    pub(super) solid: CheckedSolid,
    pub(super) deviation: f64,
}

impl Globoid {
    /// The solid within a tolerance, mm.
    ///
    /// # Errors
    /// [`Refusal`] when the tolerance is finer than splines of a reasonable size can keep, or a groove does not pass both ends.
    pub(super) fn solid(&self, tolerance: f64) -> Result<GloboidSolid, Refusal> {
        let starts = 0..self.turret.advance;
        let courses: Vec<Course> = starts
            .flat_map(|roller| FlankSide::BOTH.map(|flank| self.course(flank, f64::from(roller))))
            .collect::<Result<_, _>>()?;
        let stretches: Vec<FlankStretch<'_>> = courses
            .iter()
            .flat_map(|course| course.stretches.iter().map(|stretch| self.stretch(course, *stretch)))
            .collect();
        let depth = MILLIMETRES * (self.floor - self.outside);
        let (mut patches, deviation) = fitted_flanks(&stretches, (0.0, depth), tolerance, Self::WORDS)?;
        let mut grooves = Vec::new();
        for pair in courses.chunks(2) {
            let [upper, lower] = pair else { continue };
            let rest = patches.split_off(upper.stretches.len());
            let own = std::mem::replace(&mut patches, rest);
            let rest = patches.split_off(lower.stretches.len());
            grooves.push(GlobeGroove { upper: own, lower: std::mem::replace(&mut patches, rest) });
        }
        let solid = self.made(&courses, &grooves)?;
        Ok(GloboidSolid { solid, deviation })
    }

    fn made(&self, courses: &[Course], grooves: &[GlobeGroove]) -> Result<CheckedSolid, Refusal> {
        let course = |groove: usize, lower: usize| courses.get(2 * groove + lower);
        let count = grooves.len();
        let (mut ribs, mut floors) = (Vec::new(), Vec::new());
        for groove in 0..count {
            // Above the first groove lies the last one as it is a turn later.
            let (above, shift) = if groove == 0 { (count - 1, TAU) } else { (groove - 1, 0.0) };
            let (Some(upper), Some(lower), Some(next)) = (course(groove, 0), course(groove, 1), course(above, 1))
            else {
                continue;
            };
            ribs.push(self.seams(upper, next, shift));
            floors.push(self.seams(upper, lower, 0.0));
        }
        if ribs.iter().chain(&floors).any(Vec::is_empty) {
            let what = "two grooves pass the cam one after the other, and no rib lies between them";
            return Err(Refusal::new(what).remedy("give a larger cam.end_angle"));
        }
        let mirrored = !self.groove.is_clockwise();
        let holes: Vec<Contour> = self.groove.holes();
        let drilled: f64 = holes.iter().map(|hole| hole.area_and_centroid().0).sum();
        let in_own_frame: Vec<Contour> =
            if mirrored { holes.iter().map(Contour::mirrored_about_x).collect() } else { holes };
        let (outer, floor) = (MILLIMETRES * self.outside, MILLIMETRES * self.floor);
        let height = 2.0 * MILLIMETRES * self.rim(self.floor).1;
        let globoid = GrooveGloboid {
            grooves,
            ribs: &ribs,
            floors: &floors,
            tubes: (MILLIMETRES * self.turret.distance, [outer, floor]),
            end_angle: self.end_angle,
            holes: &in_own_frame,
            mirrored,
        };
        globoid.solid(self.volume() + drilled * height)
    }

    /// Stations of two flanks at one cam angle, that of the second one so much later in its own counting: those at which both are level, if there are any.
    fn seams(&self, first: &Course, second: &Course, shift: f64) -> Vec<(usize, usize)> {
        let small = super::LEVEL * self.turret.index();
        let others: Vec<(usize, f64)> = second.stations().collect();
        let pair = |(index, angle): (usize, f64)| {
            let other = others.iter().find(|(_, other)| (other - shift - angle).abs() < SAME)?;
            Some((index, other.0, angle))
        };
        let all: Vec<(usize, usize, f64)> = first.stations().filter_map(pair).collect();
        let is_level = |(.., angle): &&(usize, usize, f64)| self.line_at(*angle, first.roller).angle[1].abs() <= small;
        let level: Vec<&(usize, usize, f64)> = all.iter().filter(is_level).collect();
        let chosen = if level.is_empty() { all.iter().collect() } else { level };
        chosen.into_iter().map(|(first, second, _)| (*first, *second)).collect()
    }

    /// The range of cam angles at which a flank passes an end, between floor and outside.
    fn passage(&self, flank: FlankSide, end: End, roller: f64) -> Result<(f64, f64), Refusal> {
        let mut range = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 0..=PLACES {
            let from_turret = self.outside + (self.floor - self.outside) * f64::from(i) / f64::from(PLACES);
            let at = self.passes(FlankCurve { flank, roller, from_turret }, end).ok_or_else(|| {
                Refusal::new("a roller does not pass the end of the cam in one movement")
                    .remedy("give another cam.end_angle")
            })?;
            range = (range.0.min(at), range.1.max(at));
        }
        Ok(range)
    }

    /// The stretches of a flank: pieces of the motion, none longer than a twelfth of a turn, with those up to the ends of the cam.
    fn course(&self, flank: FlankSide, roller: f64) -> Result<Course, Refusal> {
        let entry = self.passage(flank, End::Bottom, roller)?;
        let exit = self.passage(flank, End::Top, roller)?;
        let joints = self.joints(entry.0, exit.1);
        let first = joints.iter().position(|joint| joint.at >= entry.1 + SHORTEST);
        let last = joints.iter().rposition(|joint| joint.at <= exit.0 - SHORTEST);
        let (Some(first), Some(last)) = (first, last.filter(|last| first.is_some_and(|first| first <= *last))) else {
            let what = "a groove is too short: its roller leaves the cam as it enters it";
            return Err(Refusal::new(what).remedy("give a larger cam.end_angle"));
        };
        let piece_at = |angle: f64| joints.iter().rfind(|joint| joint.at <= angle).map(|joint| joint.piece);
        let mut stretches = Vec::new();
        for (index, joint) in joints.iter().enumerate().take(last + 1).skip(first) {
            let before = index.checked_sub(1).and_then(|before| joints.get(before));
            if index == first {
                let piece = before.map(|before| before.piece).filter(|piece| piece_at(entry.0) == Some(*piece));
                stretches.push(Stretch { piece, bounds: [Bound::End(End::Bottom), Bound::At(joint.at)] });
            } else if let Some(before) = before {
                let bounds = [Bound::At(before.at), Bound::At(joint.at)];
                stretches.push(Stretch { piece: Some(before.piece), bounds });
            }
            if index == last {
                let piece = Some(joint.piece).filter(|piece| piece_at(exit.1) == Some(*piece));
                stretches.push(Stretch { piece, bounds: [Bound::At(joint.at), Bound::End(End::Top)] });
            }
        }
        Ok(Course { flank, roller, stretches })
    }

    /// The places at which flanks are divided, from before a cam angle to behind another: the joints of the motion, and as many between them as no stretch
    /// is longer than a twelfth of a turn.
    fn joints(&self, from: f64, to: f64) -> Vec<Joint> {
        let start = self.groove.motion.range().0;
        let mut joints = Vec::new();
        let mut turns = ((from - start) / TAU).floor();
        while start + turns * TAU <= to {
            for (index, piece) in self.groove.motion.pieces().iter().enumerate() {
                let width = piece.end - piece.start;
                let count = (width / LONGEST_PATCH - 1e-9).ceil().max(1.0);
                let mut i = 0.0;
                while i < count {
                    let at = piece.start + width * i / count + turns * TAU;
                    joints.push(Joint { at, piece: (index, turns) });
                    i += 1.0;
                }
            }
            turns += 1.0;
        }
        joints.push(Joint { at: start + turns * TAU, piece: (0, turns) });
        joints
    }

    /// A stretch for the splines: its parameter is the share between its bounds, or the cam angle where these are the same for all places.
    fn stretch(&self, course: &Course, stretch: Stretch) -> FlankStretch<'_> {
        let (flank, roller) = (course.flank, course.roller);
        let floor = MILLIMETRES * self.floor;
        let angle_of = move |bound: Bound, from_turret: f64| match bound {
            Bound::At(angle) => angle,
            Bound::End(end) => self.passes(FlankCurve { flank, roller, from_turret }, end).unwrap_or(f64::NAN),
        };
        let place = move |share: f64, v: f64| {
            let from_turret = (floor - v) / MILLIMETRES;
            let [from, to] = stretch.bounds.map(|bound| angle_of(bound, from_turret));
            let angle = if share == 1.0 { to } else { from + (to - from) * share };
            let [point, by_angle] = self.flank_at(FlankCurve { flank, roller, from_turret }, stretch.piece, angle);
            [point * MILLIMETRES, by_angle * (MILLIMETRES * (to - from))]
        };
        FlankStretch { along: (0.0, 1.0), place: Box::new(place) }
    }

    /// Point of a flank and its derivative by the cam angle, m, of any turn or within a piece and the turns beyond it.
    fn flank_at(&self, curve: FlankCurve, piece: Option<(usize, f64)>, angle: f64) -> [Vector3<f64>; 2] {
        let line = match piece {
            Some((piece, turns)) => {
                let own = self.groove.motion.pieces().get(piece).copied();
                let inside = own.map_or(f64::NAN, |own| (angle - turns * TAU).clamp(own.start, own.end));
                self.line_in(piece, inside, turns, curve.roller)
            }
            None => self.line_at(angle, curve.roller),
        };
        let Some(found) = line.at_distance(self.groove.signed(curve.flank), curve.from_turret) else {
            return [Vector3::repeat(f64::NAN); 2];
        };
        let (sin, cos) = libm::sincos(angle);
        let turned = |v: Vector3<f64>| Vector3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z);
        [turned(found.place), turned(found.by_angle)]
    }
}

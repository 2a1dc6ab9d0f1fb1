//! The sphere of a conoid's roller put on its written sections and on the flank of its solid.

use super::{Bound, Check, Evidence, Explained, On, WrittenOutline, at};
use crate::body::conoid::flank::Flank;
use crate::body::conoid::{AllStrips, Conoid, Slice, Strips, StripsNear};
use crate::geometry::MILLIMETRES;
use crate::geometry::solid::SplineSurface;
use crate::geometry::track::Track;
use crate::machine::Rotation;
use crate::motion::Motion;
use crate::numeric::{extremum, parallel};
use crate::profile::Worst;
use crate::report::{Finding, Verdict};
use nalgebra::Vector3;

pub(super) const ROLLING_FLANK: Check = Check {
    name: "rolling_flank",
    on: On::Outline,
    about: "The largest gap between the sphere of the roller, placed as the motion requires, and the flank of the solid as \
            written.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "the distance of the roller's centre from the flank, less its radius",
        usual: "the tolerance",
        change: "a finer --tolerance",
    },
    run: rolling_flank,
};

/// Cam angles at which the sphere is put on a written section, and on a slice of the flank.
const ANGLES: u32 = 360;
/// The worst of them on a section are looked at closer, with so many golden sections between their neighbours.
const CLOSER_LOOKS: usize = 3;
const CLOSER_SECTIONS: u32 = 19;
const FLANK_ANGLES: u32 = 180;

/// Whether the drawing is mirrored.
fn turned(conoid: &Conoid) -> bool {
    use crate::body::Body;
    conoid.machine().cam.rotation == Rotation::CounterClockwise
}

/// No deviation so far.
fn none(at: f64, z: f64) -> Worst {
    Worst { value: 0.0, at, z }
}

fn or_farther(best: Worst, next: Worst) -> Worst {
    if next.value.abs() > best.value.abs() { next } else { best }
}

/// A cam angle, the same in its piece, and what the sections of the conoid lift there.
struct Turned<L> {
    at: f64,
    inside: f64,
    lifts: L,
}

impl<'a> Turned<StripsNear<'a>> {
    /// For one place along the axis.
    fn near(conoid: &'a Conoid, slice: &Slice<'_>, at: f64) -> Self {
        let (piece, inside) = slice.locate(at);
        Self { at, inside, lifts: conoid.lifts(piece, inside) }
    }
}

impl Turned<AllStrips> {
    fn new(conoid: &Conoid, slice: &Slice<'_>, at: f64) -> Self {
        let (piece, inside) = slice.locate(at);
        Self { at, inside, lifts: conoid.all_lifts(piece, inside) }
    }

    /// The middles of so many equal parts of a turn: the same for every place along the axis.
    fn all(conoid: &Conoid, count: u32) -> Vec<Self> {
        let slice = conoid.slice(0.0);
        let (first, last) = slice.range();
        let place = |i: &u32| first + (last - first) * (f64::from(*i) + 0.5) / f64::from(count);
        parallel::map(&(0..count).collect::<Vec<u32>>(), |i| Self::new(conoid, &slice, place(i)))
    }
}

/// The sphere that touches the cut at z stands at ζ, and the plane cuts a circle of radius √(r² − (ζ − z)²) out of it that must
/// touch the outline.
pub(super) fn on_sections(evidence: &Evidence<'_>, conoid: &Conoid, check: &Check) -> Option<Finding> {
    let radius = conoid.roller().radius;
    let places = Turned::all(conoid, ANGLES);
    let of_section = |section: &WrittenOutline| {
        let outline = if turned(conoid) { section.contour.mirrored_about_x() } else { section.contour.clone() };
        let track = Track::new(&outline);
        let slice = conoid.slice(section.z);
        let gap = |lifts: &dyn Strips, angle: f64| {
            let (_, zeta, partials) = conoid.cut_of(lifts, angle, section.z)?;
            let sphere = conoid.contact_of(&partials, angle, zeta);
            let away = zeta - section.z;
            let circle = MILLIMETRES * ((radius - away) * (radius + away)).sqrt();
            Some(-track.nearest(sphere.centre.xy() * MILLIMETRES)?.left - circle)
        };
        let (first, last) = slice.range();
        let worst = |value: Option<f64>, at: f64| Worst { value: value.unwrap_or(f64::INFINITY), at, z: section.z };
        let of_place = |turned: &Turned<AllStrips>| worst(gap(&turned.lifts, turned.inside), turned.at);
        let mut all: Vec<Worst> = places.iter().map(of_place).collect();
        all.sort_by(|a, b| b.value.abs().total_cmp(&a.value.abs()));
        let step = (last - first) / f64::from(ANGLES);
        let closer = |around: &Worst| {
            let near = |angle: f64| {
                let turned = Turned::near(conoid, &slice, angle);
                worst(gap(&turned.lifts, turned.inside), angle)
            };
            let range = (around.at - step, around.at + step);
            near(extremum::largest_without_slope(|angle| near(angle).value.abs(), range, 2, CLOSER_SECTIONS).at)
        };
        let looked: Vec<Worst> = all.iter().take(CLOSER_LOOKS).map(closer).collect();
        all.into_iter().chain(looked).fold(none(first, section.z), or_farther)
    };
    let all: Vec<Worst> = parallel::map(evidence.outlines, of_section);
    let worst = all.into_iter().reduce(or_farther)?;
    let limit = evidence.tolerance_mm;
    let found = check.found(worst.value.abs(), Some(limit), "mm", Verdict::of(worst.value.abs() <= limit));
    let count = evidence.outlines.len();
    let note = format!("sphere on {count} sections as read from their files, at {ANGLES} angles each");
    Some(at(evidence.body, &worst, found, Some(note)))
}

fn rolling_flank(evidence: &Evidence<'_>) -> Option<Finding> {
    let (conoid, flank) = (evidence.body.spatial()?, evidence.drawn?.flank.as_ref()?);
    let worst = on_flank(conoid, flank);
    let limit = evidence.tolerance_mm;
    let found = ROLLING_FLANK.found(worst.value.abs(), Some(limit), "mm", Verdict::of(worst.value.abs() <= limit));
    Some(at(evidence.body, &worst, found, Some("sphere on the spline patches of the solid".into())))
}

/// The sphere on the flank, over the sections and between them: the gap of largest size, mm, signed as metal missing.
fn on_flank(conoid: &Conoid, flank: &Flank) -> Worst {
    let turned = turned(conoid);
    let (low, high) = conoid.ends();
    let radius = MILLIMETRES * conoid.roller().radius;
    let sense = if turned { -1.0 } else { 1.0 };
    let places = Turned::all(conoid, FLANK_ANGLES);
    let gap = |at: &Turned<AllStrips>, z: f64| {
        let contact = conoid.contact_of(&conoid.lift_of(&at.lifts, z), at.inside, z);
        // Beyond the ends of the cam there is nothing to touch.
        if !(low..=high).contains(&contact.point.z) {
            return 0.0;
        }
        let u = sense * at.inside;
        let near = |patch: &&SplineSurface| (patch.range()[0].0..=patch.range()[0].1).contains(&u);
        let centre = Vector3::new(contact.centre.x, sense * contact.centre.y, contact.centre.z) * MILLIMETRES;
        let away = |patch: &SplineSurface| patch.distance(&centre, (u, MILLIMETRES * contact.point.z)) - radius;
        flank.patches.iter().find(near).map_or(f64::INFINITY, away)
    };
    let (first, _) = conoid.slice(0.0).range();
    let at_slice = |z: &f64| {
        let all = places.iter().map(|at| Worst { value: gap(at, *z), at: at.at, z: *z });
        all.fold(none(first, *z), or_farther)
    };
    let all: Vec<Worst> = parallel::map(&conoid.slices(), at_slice);
    all.into_iter().fold(none(0.0, 0.0), or_farther)
}

//! The sphere of a conoid's roller put on its written sections and on the flank of its solid.

use super::check::{Evidence, FileCheck, WrittenOutline, at};
use crate::body::Flank;
use crate::body::surface::{AtAngle, Surface};
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::report::{Bound, Finding, Verdict};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::geometry::solid::SplineSurface;
use camgen_kernel::numeric::{extremum, parallel};
use camgen_kernel::profile::Worst;
use camgen_kernel::text::text;
use nalgebra::Vector3;

pub(super) const ROLLING_FLANK: FileCheck = FileCheck {
    check: Check {
        name: "rolling_flank",
        on: CheckScope::Outline,
        unit: "mm",
        about: "The largest gap between the sphere of the roller, placed as the motion requires, and the flank of the solid as \
                written.",
        explained: CheckExplanation {
            bound: Bound::AtMost,
            formula: "the distance of the roller's centre from the flank, less its radius",
            usual: "the tolerance",
            change: "a finer --tolerance",
        },
    },
    run: rolling_flank,
};

/// Cam angles at which the sphere is put on a written section, and on a slice of the flank.
const ANGLES: u32 = 360;
/// The worst angles on a section are refined with this many golden sections between their neighbours.
const CLOSER_LOOKS: usize = 3;
const CLOSER_SECTIONS: u32 = 19;
const FLANK_ANGLES: u32 = 180;

/// The least deviation, to start the comparison with.
fn none(at: f64, z: f64) -> Worst {
    Worst { value: 0.0, at, z }
}

fn or_farther(best: Worst, next: Worst) -> Worst {
    if next.value.abs() > best.value.abs() { next } else { best }
}

/// A cam angle, the angle within its piece, and the surface there.
struct SurfaceAngle<'a> {
    at: f64,
    inside: f64,
    there: Box<dyn AtAngle + Send + Sync + 'a>,
}

impl<'a> SurfaceAngle<'a> {
    /// The middles of this many equal parts of a turn: identical for every place along the axis.
    fn all(surface: &'a dyn Surface, count: u32) -> Vec<Self> {
        let law = surface.law(0.0);
        let (first, last) = law.range();
        let place = |i: &u32| first + (last - first) * (f64::from(*i) + 0.5) / f64::from(count);
        parallel::map(&(0..count).collect::<Vec<u32>>(), |i| {
            let at = place(i);
            let (piece, inside) = law.locate(at);
            Self { at, inside, there: surface.at_for_many(piece, inside) }
        })
    }
}

/// The sphere that touches the cut at z has its centre at ζ, and the plane cuts a circle of radius √(r² − (ζ − z)²) out of it that must
/// touch the outline.
pub(super) fn on_sections(evidence: &Evidence<'_>, surface: &dyn Surface, check: &Check) -> Option<Finding> {
    let [radius, _] = surface.sphere();
    let places = SurfaceAngle::all(surface, ANGLES);
    let cuts = evidence.body.cuts();
    let of_section = |section: &WrittenOutline| {
        let turned = cuts.get(section.cut).is_some_and(|cut| cut.mirrored == [true]);
        let outline = if turned { section.contour.mirrored_about_x() } else { section.contour.clone() };
        let tree = EdgeTree::new(&outline);
        let law = surface.law(section.z);
        let gap = |there: &dyn AtAngle| {
            let sphere = there.of_cut(section.z)?;
            let away = sphere.centre.z - section.z;
            let circle = MILLIMETRES * ((radius - away) * (radius + away)).sqrt();
            Some(-tree.nearest(sphere.centre.xy() * MILLIMETRES)?.left - circle)
        };
        let (first, last) = law.range();
        let worst = |value: Option<f64>, at: f64| Worst { value: value.unwrap_or(f64::INFINITY), at, z: section.z };
        let of_place = |turned: &SurfaceAngle<'_>| worst(gap(&*turned.there), turned.at);
        let mut all: Vec<Worst> = places.iter().map(of_place).collect();
        all.sort_by(|a, b| b.value.abs().total_cmp(&a.value.abs()));
        let step = (last - first) / f64::from(ANGLES);
        let closer = |around: &Worst| {
            let near = |angle: f64| {
                let (piece, inside) = law.locate(angle);
                worst(gap(&*surface.at(piece, inside)), angle)
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
    let found = check.found(worst.value.abs(), Some(limit), Verdict::of(worst.value.abs() <= limit));
    let count = evidence.outlines.len();
    let note = text!("sphere on {} sections as read from their files, at {} angles each", count, ANGLES);
    Some(at(evidence.body, &worst, found, Some(note)))
}

fn rolling_flank(evidence: &Evidence<'_>) -> Option<Finding> {
    let (surface, flank) = (evidence.body.surface()?, evidence.drawn?.flank.as_ref()?);
    let turned = evidence.body.cuts().first().is_some_and(|cut| cut.mirrored == [true]);
    let worst = on_flank(surface, flank, turned);
    let limit = evidence.tolerance_mm;
    let found = ROLLING_FLANK.found(worst.value.abs(), Some(limit), Verdict::of(worst.value.abs() <= limit));
    Some(at(evidence.body, &worst, found, Some("sphere on the spline patches of the solid".into())))
}

/// The sphere on the flank, on the sections and between them: the gap of largest size, mm, positive where metal is missing.
fn on_flank(surface: &dyn Surface, flank: &Flank, turned: bool) -> Worst {
    let (low, high) = surface.ends();
    let radius = MILLIMETRES * surface.sphere()[0];
    let sense = if turned { -1.0 } else { 1.0 };
    let places = SurfaceAngle::all(surface, FLANK_ANGLES);
    let gap = |at: &SurfaceAngle<'_>, z: f64| {
        let contact = at.there.contact(z);
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
    let (first, _) = surface.law(0.0).range();
    let at_slice = |z: &f64| {
        let all = places.iter().map(|at| Worst { value: gap(at, *z), at: at.at, z: *z });
        all.fold(none(first, *z), or_farther)
    };
    let all: Vec<Worst> = parallel::map(&surface.slices(), at_slice);
    all.into_iter().fold(none(0.0, 0.0), or_farther)
}

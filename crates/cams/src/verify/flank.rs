//! The flank of a conoid's solid as read from a file, compared with the exact surface: the distance of every patch from it, and
//! whether the patches go round once.
//!
//! The exact surface is the pitch surface offset by the roller. From a point of a patch the nearest place of the pitch surface is
//! found by Newton's method with exact derivatives; its distance less the roller's radius is the distance from the flank, since
//! the two lie on one normal. Neither the curves the patches were made from nor their parameters are used.

use super::check::{Evidence, FileCheck, at};
use super::patches::{ExactFlank, SLACK, of_patches};
use crate::body::Surface;
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::report::{Bound, Finding, Verdict};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::nurbs::NurbsSurface as Patch;
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::Worst;
use camgen_kernel::text::{Length, Text, text};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::TAU;

pub(super) const CHECK: FileCheck = FileCheck {
    check: Check {
        name: "flank",
        on: CheckScope::File,
        unit: "mm",
        about: "The largest distance of the flank of a conoid's solid, as read from a STEP file, from the exact surface, anywhere on its \
                patches.",
        explained: CheckExplanation {
            bound: Bound::AtMost,
            formula: "max distance of the file's patches from the exact surface, bounded between places",
            usual: "the tolerance",
            change: "a finer --tolerance in the program that wrote the file",
        },
    },
    run: check,
};

/// Newton steps to the nearest place of the pitch surface, and the step (m) at which they end.
const STEPS: usize = 12;
const AT_REST: f64 = 1e-10;
/// Points on each side of a patch by which the patches are counted round the axis, and how near one turn they must be.
const AROUND: u32 = 256;
const ONE_TURN: f64 = 1e-3;

/// The exact surface, as the reference for points of a patch.
struct ExactSurface<'a> {
    surface: &'a dyn Surface,
    /// The law in the plane z = 0.
    slice: Box<dyn Motion + 'a>,
    turned: bool,
}

impl ExactFlank for ExactSurface<'_> {
    /// By the sphere that touches there.
    fn deviation(&self, point: Vector3<f64>, normal: Vector3<f64>) -> (Worst, f64) {
        let slice = &self.slice;
        let sense = if self.turned { -1.0 } else { 1.0 };
        let mirrored = |v: Vector3<f64>| Vector3::new(v.x, sense * v.y, v.z);
        let (point, normal) = (mirrored(point) / MILLIMETRES, mirrored(normal));
        let [radius, offset] = self.surface.sphere();
        // The centre of a sphere that touches the patch there.
        let centre = point + normal * radius;
        let across = centre.xy();
        let height = (across.norm_squared() - offset * offset).max(0.0).sqrt();
        let mut angle = libm::atan2(across.y, across.x) - libm::atan2(offset, height);
        let mut z = centre.z;
        let mut away = Vector3::repeat(f64::NAN);
        let mut rests = false;
        for _ in 0..STEPS {
            let (piece, inside) = slice.locate(angle);
            let (place, [by_angle, by_z], [twice_angle, mixed, twice_z]) = self.surface.pitch(piece, inside, z);
            away = point - place;
            let (a, b) = (away.dot(&by_angle), away.dot(&by_z));
            let e = by_angle.norm_squared() - away.dot(&twice_angle);
            let f = by_angle.dot(&by_z) - away.dot(&mixed);
            let g = by_z.norm_squared() - away.dot(&twice_z);
            let determinant = e * g - f * f;
            let step = Vector2::new((g * a - f * b) / determinant, (e * b - f * a) / determinant);
            angle += step.x;
            z += step.y;
            rests = step.x.abs() * height + step.y.abs() <= AT_REST;
            if rests {
                break;
            }
        }
        let outward = -away.normalize();
        // Where the steps do not converge, the place is not the nearest.
        let value = if rests { MILLIMETRES * (away.norm() - radius) } else { f64::INFINITY };
        (Worst { value, at: slice.locate(angle).1, z }, outward.dot(&normal))
    }
}

/// Area of a patch in polar angle and height, rad mm, by its sides: the patches go round once where their sum is a full turn
/// times the height.
fn around(patch: &Patch, outward: bool) -> f64 {
    let mut area = 0.0;
    for side in patch.boundary().into_iter().flatten() {
        let (first, last) = side.knots.range();
        let at = |i: u32| side.point_and_slope(first + (last - first) * f64::from(i) / f64::from(AROUND)).0;
        for i in 0..AROUND {
            let (a, b) = (at(i), at(i + 1));
            let turn = libm::atan2(a.xy().perp(&b.xy()), a.xy().dot(&b.xy()));
            area -= 0.5 * (a.z + b.z) * turn;
        }
    }
    if outward { area } else { -area }
}

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let (surface, solid) = (evidence.body.surface()?, evidence.solid?);
    let patches = &solid.form.patches;
    let turned = evidence.body.cuts().first().is_some_and(|cut| cut.mirrored == [true]);
    let exact = ExactSurface { surface, slice: surface.law(0.0), turned };
    let limit = evidence.tolerance_mm;
    let found = of_patches(patches, &exact, limit);
    let (low, high) = surface.ends();
    let round: f64 = patches.iter().map(|(patch, outward)| around(patch, *outward)).sum();
    let turns = round / (TAU * MILLIMETRES * (high - low));
    let once = (turns - 1.0).abs() <= ONE_TURN;
    let size = if patches.is_empty() { f64::INFINITY } else { found.worst.value.abs() };
    let kept = once && !found.folded && size <= limit && found.bound <= SLACK * limit;
    let mut words = vec![text!(
        "{} patches as read from the file, at {} places, at most {} between them",
        patches.len(),
        found.samples,
        Length::mm(found.bound).decimals(6)
    )];
    if !once {
        words.push(text!(
            "the patches go {} times round the axis from end to end, not once",
            format_args!("{turns:.4}")
        ));
    }
    if found.folded {
        words.push("a patch is folded or turned inside out".into());
    }
    let finding = CHECK.found(size, Some(limit), Verdict::of(kept));
    Some(at(evidence.body, &found.worst, finding, Some(Text::joined(words, "; "))))
}

#[cfg(test)]
mod tests {
    use super::super::patches::{DOUBLINGS, PLACES, SpanCell};
    use super::*;
    use crate::body::surface::{AtAngle, Heading, PitchPoint, RateErrors};
    use camgen_kernel::geometry::boundary::Boundary;
    use camgen_kernel::geometry::nurbs::{Knots, weighted};
    use camgen_kernel::geometry::points::MotionErrors;
    use camgen_kernel::motion::{Jet, Piece};
    use camgen_kernel::profile::Curves;

    /// A wave on a circle of 80 mm, higher along the axis, under a sphere of 15 mm.
    struct Waves;

    /// The wave in a plane across the axis.
    #[derive(Debug)]
    struct Wave(f64);

    /// Lift and its first and second derivatives by the angle, each with those along the axis, m.
    fn lift(angle: f64, z: f64) -> [[f64; 3]; 3] {
        let (height, slope) = (4e-3 * (1.0 + z / 0.1) * (1.0 + z / 0.1), 8e-3 * (1.0 + z / 0.1) / 0.1);
        let (sin, cos) = (libm::sin(2.0 * angle), libm::cos(2.0 * angle));
        [1.0 - cos, 2.0 * sin, 4.0 * cos].map(|wave| [height * wave, slope * wave, 0.8 * wave])
    }

    impl Motion for Wave {
        fn pieces(&self) -> &[Piece] {
            &[Piece { start: 0.0, end: TAU, dwell: false }]
        }
        fn jet(&self, _: usize, angle: f64) -> Jet {
            let [[s, ..], [ds, ..], [dds, ..]] = lift(angle, self.0);
            Jet { s, ds, dds, ddds: -4.0 * ds }
        }
    }

    impl Surface for Waves {
        fn sphere(&self) -> [f64; 2] {
            [0.015, 0.0]
        }
        fn ends(&self) -> (f64, f64) {
            (-0.02, 0.02)
        }
        fn law(&self, z: f64) -> Box<dyn Motion + '_> {
            Box::new(Wave(z))
        }
        fn pitch(&self, _: usize, angle: f64, z: f64) -> PitchPoint {
            let [[s, by_z, twice_z], [by_angle, mixed, _], [twice_angle, ..]] = lift(angle, z);
            let (height, (sin, cos)) = (0.08 + s, libm::sincos(angle));
            let frame = |along: f64, across: f64, axial: f64| {
                Vector3::new(along * cos - across * sin, along * sin + across * cos, axial)
            };
            (
                frame(height, 0.0, z),
                [frame(by_angle, height, 0.0), frame(by_z, 0.0, 1.0)],
                [frame(twice_angle - height, 2.0 * by_angle, 0.0), frame(mixed, by_z, 0.0), frame(twice_z, 0.0, 0.0)],
            )
        }
        fn slices(&self) -> Vec<f64> {
            unreachable!("not of the flank")
        }
        fn in_plane(&self, _: f64, _: &mut dyn FnMut(Curves<'_>)) {
            unreachable!("not of the flank")
        }
        fn at(&self, _: usize, _: f64) -> Box<dyn AtAngle + '_> {
            unreachable!("not of the flank")
        }
        fn at_for_many(&self, _: usize, _: f64) -> Box<dyn AtAngle + Send + Sync + '_> {
            unreachable!("not of the flank")
        }
        fn rate_errors(&self, _: f64, _: Heading, _: f64) -> Option<RateErrors> {
            unreachable!("not of the flank")
        }
        fn cut_at(&self, _: f64) -> Boundary<'_> {
            unreachable!("not of the flank")
        }
        fn centre_at(&self, _: f64) -> Boundary<'_> {
            unreachable!("not of the flank")
        }
        fn motion_errors(&self, _: f64, _: bool) -> Box<dyn MotionErrors + '_> {
            unreachable!("not of the flank")
        }
    }

    /// A point on the normal of the flank is at its distance from it, also along a normal that is off by a tenth of a radian.
    #[test]
    fn a_deviation_is_the_distance_from_the_nearest_place() {
        let surface: &dyn Surface = &Waves;
        let (exact, slice) = (ExactSurface { surface, slice: surface.law(0.0), turned: false }, surface.law(0.0));
        let (low, high) = surface.ends();
        let radius = surface.sphere()[0];
        for i in 0..60 {
            let (piece, angle) = slice.locate(TAU * f64::from(i) / 60.0);
            let z = low + (high - low) * f64::from(i % 7 + 1) / 9.0;
            let (place, [by_angle, by_z], _) = surface.pitch(piece, angle, z);
            let outward = by_angle.cross(&by_z).normalize();
            for (off, turned) in [(0.0, 0.0), (2e-6, 0.1), (-3e-6, -0.1)] {
                let point = (place - outward * (radius - off)) * MILLIMETRES;
                let normal = (outward + by_angle.normalize() * turned).normalize();
                let (found, cosine) = exact.deviation(point, normal);
                assert!((found.value + MILLIMETRES * off).abs() < 1e-10, "{i} {off}: {found:?}");
                assert!((cosine - outward.dot(&normal)).abs() < 1e-6, "{i} {off}: {cosine}");
            }
        }
    }

    /// A bilinear patch between four corners.
    fn bilinear(corners: [[Vector3<f64>; 2]; 2]) -> Patch {
        let knots = || Knots { degree: 1, values: vec![0.0, 0.0, 1.0, 1.0] };
        let controls = corners.iter().map(|row| row.iter().map(|corner| weighted(*corner, 1.0)).collect()).collect();
        Patch { u: knots(), v: knots(), controls }
    }

    /// A quarter of a turn, four high, three above the plane: whichever way its sides run.
    #[test]
    fn a_patch_goes_round_by_its_angle_and_height() {
        let at = |x: f64, y: f64, z: f64| Vector3::new(x, y, z);
        let (a, b) = ([at(50.0, 0.0, 3.0), at(50.0, 0.0, 7.0)], [at(0.0, 40.0, 3.0), at(0.0, 40.0, 7.0)]);
        let area = around(&bilinear([a, b]), true);
        assert!((area - 0.25 * TAU * 4.0).abs() < 1e-9, "{area}");
        assert_eq!(around(&bilinear([a, b]), false), -area);
        let other = around(&bilinear([b, a]), true);
        assert!((other + area).abs() < 1e-9, "{other}");
    }

    /// Where the places are doubled, all of them are counted: 8², 16², 32² and 64².
    #[test]
    fn every_place_of_a_cell_is_counted() {
        let surface: &dyn Surface = &Waves;
        let (exact, slice) = (ExactSurface { surface, slice: surface.law(0.0), turned: false }, surface.law(0.0));
        let (low, high) = surface.ends();
        let on = |angle: f64, z: f64| {
            let (piece, inside) = slice.locate(angle);
            let (place, [by_angle, by_z], _) = surface.pitch(piece, inside, z);
            (place - by_angle.cross(&by_z).normalize() * surface.sphere()[0]) * MILLIMETRES
        };
        let (z, height) = (0.5 * (low + high), 0.1 * (high - low));
        let patch = bilinear([[on(1.0, z), on(1.0, z + height)], [on(1.1, z), on(1.1, z + height)]]);
        let cell = SpanCell { patch: &patch, outward: true, u: (0.0, 1.0), v: (0.0, 1.0) };
        let finest = cell.at_places(&exact, PLACES << DOUBLINGS);
        assert!(!finest.folded && finest.worst.value.abs() > 0.0 && finest.bound > finest.worst.value.abs());
        // Larger than any deviation found, and smaller than any bound.
        let found = cell.found(&exact, finest.worst.value.abs() * (1.0 + 1e-12));
        assert_eq!(found.samples, 64 + 256 + 1024 + 4096);
    }
}

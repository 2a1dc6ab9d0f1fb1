//! The files of a body whose flanks a roller sweeps in space: its solid and the developed view of its outside, as read from their bytes.
//!
//! The roller is rolled past every place of the spline patches: the least distance of a place from the path of its centre line, less the radius of the
//! flank, is the deviation. Neither the theorem that the flanks were made by nor their parameters are used. Floor, outside and ends are compared with
//! their places, and the volume with an integral over the exact flanks.

use super::check::{Evidence, FileCheck};
use super::patches::SLACK;
use super::solid::farthest;
use super::swept_files::{Developed, SweptSolid};
use crate::body::{Body, Layer, RoundFace, SweptFlanks};
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::reading::step::{FaceLoop, StepBoundary, StepCurve, StepFace, StepSurface};
use crate::reading::{Chain, FileUnit};
use crate::report::{Bound, Finding, Verdict};
use camgen_kernel::geometry::contour::{Contour, Edge};
use camgen_kernel::geometry::nurbs::NurbsSurface;
use camgen_kernel::text::{Length, Text, text};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::TAU;

/// What a check of these files is: it applies where such a file was read.
const fn check_of(
    name: &'static str,
    unit: &'static str,
    about: &'static str,
    explained: CheckExplanation,
    run: fn(&Evidence<'_>) -> Option<Finding>,
) -> FileCheck {
    FileCheck { check: Check { name, on: CheckScope::ToolFile, unit, about, explained }, run }
}

pub(super) const UNROLLED: FileCheck = check_of(
    "unrolled",
    "mm",
    "The largest distance of the curves of a developed view, as read from a DXF file, from the exact ones; each must run from end to end, once.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "max distance of the arcs and lines of FLANK_UPPER, FLANK_LOWER and PITCH from the exact curves on the outside",
        usual: "the tolerance",
        change: "a finer --tolerance in the program that wrote the file",
    },
    |evidence| unrolled(evidence, evidence.swept?.developed.as_ref()?),
);

pub(super) const FLANK_SURFACE: FileCheck = check_of(
    "flank_surface",
    "mm",
    "The largest distance of the flanks of a solid, as read from a STEP file, from the path of the roller less its radius, anywhere on their patches.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |least distance from the roller's centre line over the turn − radius of the flank|, bounded between places",
        usual: "the tolerance",
        change: "a finer --tolerance in the program that wrote the file",
    },
    |evidence| Some(flank_surface(evidence, evidence.swept?.solid.as_ref()?)),
);

pub(super) const SOLID_SHELL: FileCheck = check_of(
    "solid_shell",
    "",
    "How many faults the boundary of a grooved cylinder or globoid has: more or fewer than one solid, edges that are not shared by two faces or leave them, faces \
     that are no flank, floor, outside, end or wall of the bore, or lie elsewhere.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "the number of such faults",
        usual: "ISO 10303-42: every edge of a closed shell is used twice, in opposite senses",
        change: "write the solid with camgen again",
    },
    |evidence| Some(solid_shell(evidence, evidence.swept?.solid.as_ref()?)),
);

pub(super) const SOLID_VOLUME: FileCheck = check_of(
    "solid_volume",
    "mm³",
    "The volume that the faces of a grooved cylinder or globoid enclose, compared with the integral over the exact flanks.",
    CheckExplanation {
        bound: Bound::Exactly,
        formula: "∮ z n_z over all faces, compared with the blank less its grooves and the bore",
        usual: "the same to a share of 1e-5, camgen's own rule",
        change: "write the solid with camgen again",
    },
    |evidence| Some(solid_volume(evidence, evidence.swept?.solid.as_ref()?)),
);

/// Places on each edge of a developed curve, and how many tolerances its ends may lie from their places.
const PLACES: u32 = 8;
/// Largest relative difference of the volumes.
const VOLUME_TOLERANCE: f64 = 1e-5;
/// Largest rise of a face that is an end, over its size.
const LEVEL: f64 = 1e-9;

fn unrolled(evidence: &Evidence<'_>, found: &Developed) -> Option<Finding> {
    let exact = evidence.body.swept()?;
    let limit = evidence.tolerance_mm;
    let mut words: Vec<Text> = found.faults.iter().cloned().map(Text::from).collect();
    let mut worst = (0.0, 0.0);
    let mut segments = 0;
    for (layer, ends) in exact.developed() {
        let chains = found.curves.iter().find(|(other, _)| *other == layer).map_or(&[][..], |(_, chains)| chains);
        let [chain] = chains else {
            words.push(text!("layer {} has {} curves, not one", layer.name(), chains.len()));
            continue;
        };
        segments += chain.edges.len();
        for edge in &chain.edges {
            for i in 0..=PLACES {
                let (off, at) = exact.developed_miss(layer, edge.point_and_tangent(f64::from(i) / f64::from(PLACES)).0);
                if !(off <= worst.0) {
                    worst = (off, at);
                }
            }
        }
        if let Some(fault) = runs_once(layer, chain, ends, limit) {
            words.push(fault);
        }
    }
    let kept = words.is_empty() && worst.0 <= limit;
    words.push(text!("{} arcs and lines as read from the file", segments));
    let finding = UNROLLED.found(worst.0, Some(limit), Verdict::of(kept));
    Some(Finding { place: evidence.body.place(worst.1), note: Some(Text::joined(words, "; ")), ..finding })
}

/// What is wrong with the course of a chain that should run from one end to the other without turning back.
fn runs_once(layer: Layer, chain: &Chain, [first, last]: [Vector2<f64>; 2], limit: f64) -> Option<Text> {
    let (start, end) = (chain.edges.first()?.start(), chain.edges.last()?.end());
    let apart = |a: Vector2<f64>, b: Vector2<f64>| (a - first).norm().max((b - last).norm());
    let off = apart(start, end).min(apart(end, start));
    if !(off <= 2.0 * limit) {
        return Some(text!("the curve of {} misses its ends by {}", layer.name(), Length::mm(off)));
    }
    let way = (end.x - start.x).signum();
    let back = chain.edges.iter().any(|edge: &Edge| way * (edge.end().x - edge.start().x) <= 0.0);
    back.then(|| text!("the curve of {} turns back", layer.name()))
}

fn flank_surface(evidence: &Evidence<'_>, solid: &SweptSolid) -> Finding {
    let limit = evidence.tolerance_mm;
    let [upper, lower] = solid.rolled;
    let found = upper.with(lower);
    let both = solid.rolled.iter().all(|flank| flank.samples > 0);
    let kept = both && !found.folded && found.worst.value.abs() <= limit && found.bound <= SLACK * limit;
    let mut words = vec![text!(
        "{} patches as read from the file, at {} places, at most {} between them",
        solid.form.patches.len(),
        found.samples,
        Length::mm(found.bound).decimals(6)
    )];
    if !both {
        words.push("a flank is missing".into());
    }
    if found.folded {
        words.push("a patch is folded or turned inside out".into());
    }
    let value = if both { found.worst.value.abs() } else { f64::INFINITY };
    let finding = FLANK_SURFACE.found(value, Some(limit), Verdict::of(kept));
    Finding { place: evidence.body.place(found.worst.at), note: Some(Text::joined(words, "; ")), ..finding }
}

fn solid_shell(evidence: &Evidence<'_>, solid: &SweptSolid) -> Finding {
    let faults = [&solid.file.faults, &solid.form.open, &solid.form.strange];
    let mut sentences: Vec<Text> = faults.into_iter().flatten().cloned().map(Text::from).collect();
    if solid.file.bodies.len() != 1 {
        sentences.push(text!("the file holds {} bodies, not one solid", solid.file.bodies.len()));
    }
    sentences.extend(faults_of_faces(evidence, solid));
    #[expect(clippy::cast_precision_loss, reason = "a count")]
    let count = sentences.len() as f64;
    sentences.truncate(3);
    if let FileUnit::Other(name) = solid.file.unit {
        sentences.push(text!("the file is in {}, not in millimetres; its lengths are converted", name));
    }
    let note = (!sentences.is_empty()).then(|| Text::joined(sentences, "; "));
    Finding { note, ..SOLID_SHELL.found(count, Some(0.0), Verdict::of(count == 0.0)) }
}

/// Faces that lie elsewhere, a sentence each.
fn faults_of_faces(evidence: &Evidence<'_>, solid: &SweptSolid) -> Vec<Text> {
    let Some(exact) = evidence.body.swept().map(SweptFlanks::form) else { return Vec::new() };
    let limit = evidence.tolerance_mm;
    let mut sentences = Vec::new();
    for (heights, due, name) in [(&solid.form.low, exact.ends.0, "lower"), (&solid.form.high, exact.ends.1, "upper")] {
        if heights.is_empty() || heights.iter().any(|height| !((height - due).abs() <= limit)) {
            sentences.push(text!("the {} end is not at z = {}", name, Length::mm(due)));
        }
    }
    let rims = |face: &StepFace| {
        let curve = |edge: usize| solid.file.boundary.edges.get(edge).map(|edge| &edge.curve);
        face.loops.iter().flatten().any(|(edge, _)| matches!(curve(*edge), Some(StepCurve::Spline(_))))
    };
    let scale = exact.ends.1 - exact.ends.0;
    for face in solid.file.boundary.faces.iter().filter(|face| rims(face)) {
        if matches!(face.surface, StepSurface::Spline(_)) {
            continue;
        }
        let off = exact.faces.iter().map(|due| off_face(due, face, scale)).fold(f64::INFINITY, f64::min);
        if !(off <= limit) {
            sentences.push(text!("the face of line {} is no flank, floor, outside or end of this cam", face.line));
        }
    }
    sentences.extend(faults_of_ends(evidence, solid, exact.rim).into_iter().map(Text::from));
    sentences
}

/// How far a face is from a round face of the cam, mm; infinite where it is of another kind, or its metal lies on the other side.
fn off_face(due: &RoundFace, face: &StepFace, scale: f64) -> f64 {
    let tilted = |axis: &Vector3<f64>| if axis.xy().norm() > LEVEL { f64::INFINITY } else { axis.xy().norm() * scale };
    let off = match (due, &face.surface) {
        (RoundFace::Cylinder { radius: due }, StepSurface::Cylinder { origin, axis, radius }) => {
            (radius - due).abs() + origin.xy().norm() + tilted(axis)
        }
        (RoundFace::Cone { between }, StepSurface::Cone { origin, axis, radius, slope }) => {
            let at = |(due, z): &(f64, f64)| (radius + slope * (z - origin.z) * axis.z - due).abs();
            between.iter().map(at).fold(0.0, |most: f64, next| if next <= most { most } else { next })
                + origin.xy().norm()
                + tilted(axis)
        }
        (RoundFace::Torus { major: due, minor: tube }, StepSurface::Torus { origin, axis, major, minor }) => {
            (major - due).abs() + (minor - tube).abs() + origin.norm() + tilted(axis)
        }
        _ => f64::INFINITY,
    };
    let hollow = matches!(due, RoundFace::Torus { .. });
    if face.same_sense == hollow { f64::INFINITY } else { off }
}

/// The holes of the ends and their outer rims, compared with those of the drawing.
fn faults_of_ends(evidence: &Evidence<'_>, solid: &SweptSolid, outer: f64) -> Vec<String> {
    let limit = evidence.tolerance_mm;
    let due: Vec<Contour> = holes(evidence.body);
    let mut sentences = Vec::new();
    for (name, runs) in [("lower", &solid.form.under), ("upper", &solid.form.above)] {
        let contour = |run: &FaceLoop| match run {
            FaceLoop::Contour(contour) => Some(contour.clone()),
            FaceLoop::Splines(_) => None,
        };
        let all: Vec<Contour> = runs.iter().filter_map(contour).collect();
        let (rims, bores): (Vec<Contour>, Vec<Contour>) =
            all.into_iter().partition(|contour| contour.area_and_centroid().0 > 0.0);
        let round = [Contour::circle(Vector2::zeros(), outer)];
        if rims.len() != 1 || !(farthest(&rims, &round).max(farthest(&round, &rims)) <= limit) {
            sentences.push(format!("the {name} end is not bounded by the outside"));
        }
        if bores.len() != due.len() || !(farthest(&bores, &due).max(farthest(&due, &bores)) <= limit) {
            sentences.push(format!("the holes of the {name} end are not those of the cam"));
        }
    }
    sentences
}

/// The holes of a body, with the metal on their left.
fn holes(body: &dyn Body) -> Vec<Contour> {
    body.holes_within(&Contour { vertices: Vec::new() }).iter().map(|hole| hole.contour().reversed()).collect()
}

fn solid_volume(evidence: &Evidence<'_>, solid: &SweptSolid) -> Finding {
    let Some(exact) = evidence.body.swept().map(SweptFlanks::form) else { return SOLID_VOLUME.not_run("no flanks") };
    let area = |runs: &[FaceLoop]| {
        let of = |run: &FaceLoop| match run {
            FaceLoop::Contour(contour) => contour.area_and_centroid().0,
            FaceLoop::Splines(_) => f64::NAN,
        };
        runs.iter().map(of).sum::<f64>()
    };
    let height = |heights: &[f64]| heights.first().copied().unwrap_or(f64::NAN);
    let ends = height(&solid.form.high) * area(&solid.form.above) - height(&solid.form.low) * area(&solid.form.under);
    let lifted = |(patch, outward): &(NurbsSurface, bool)| if *outward { lifted(patch) } else { -lifted(patch) };
    let round: f64 = solid.file.boundary.faces.iter().map(|face| revolved(&solid.file.boundary, face)).sum();
    let volume = ends + round + solid.form.patches.iter().map(lifted).sum::<f64>();
    let drilled: f64 = holes(evidence.body).iter().map(|hole| hole.area_and_centroid().0).sum();
    let expected = exact.volume + drilled * (exact.ends.1 - exact.ends.0);
    let kept = (volume / expected - 1.0).abs() <= VOLUME_TOLERANCE;
    let note = format!("off the integral by a share of {:.1e}", (volume / expected - 1.0).abs());
    Finding { note: Some(note.into()), ..SOLID_VOLUME.found(volume, Some(expected), Verdict::of(kept)) }
}

/// ∬ z n_z over a part of a cone or a torus about the axis, mm³: by Stokes ∮ H dφ along its edges, with the polar angle φ and H the integral of z ρ dρ along the
/// surface from its axis outwards. 0 of any other face.
fn revolved(boundary: &StepBoundary, face: &StepFace) -> f64 {
    let height = |place: &Vector3<f64>| -> f64 {
        match &face.surface {
            StepSurface::Cone { origin, axis, radius, slope } => {
                // z = a + b ρ.
                let b = axis.z / slope;
                let a = origin.z - b * radius;
                let rho = place.xy().norm();
                rho * rho * (0.5 * a + b * rho / 3.0)
            }
            StepSurface::Torus { origin, major, minor, .. } => {
                let (z, rho) = (place.z - origin.z, place.xy().norm());
                let turn = libm::atan2(z, major - rho);
                let (sin, cos) = libm::sincos(turn);
                let about = minor * minor * (major * 0.5 * (turn - sin * cos) - minor * sin * sin * sin / 3.0);
                about + 0.5 * origin.z * rho * rho
            }
            _ => f64::NAN,
        }
    };
    if !matches!(face.surface, StepSurface::Cone { .. } | StepSurface::Torus { .. }) {
        return 0.0;
    }
    let along = |(index, forward): &(usize, bool)| {
        let Some(edge) = boundary.edges.get(*index) else { return f64::NAN };
        let place = |vertex: usize| boundary.vertices.get(vertex).copied().unwrap_or_else(|| Vector3::repeat(f64::NAN));
        let (start, end) = (place(edge.start), place(edge.end));
        let found = match &edge.curve {
            // About the axis, or along it.
            StepCurve::Circle { axis, .. } => {
                let counter = edge.forward == (axis.z > 0.0);
                let turn = libm::atan2(start.xy().perp(&end.xy()), start.xy().dot(&end.xy()));
                let turn = if counter { turn.rem_euclid(TAU) } else { -(-turn).rem_euclid(TAU) };
                height(&start) * turn
            }
            StepCurve::Spline(curve) => {
                let over = |span: (f64, f64)| {
                    let value = |u: f64| {
                        let (place, slope) = curve.point_and_slope(u);
                        height(&place) * place.xy().perp(&slope.xy()) / place.xy().norm_squared()
                    };
                    camgen_kernel::numeric::quadrature::integrate(value, span, 1)
                };
                let whole: f64 = curve.knots.spans().into_iter().map(over).sum();
                if edge.forward { whole } else { -whole }
            }
            // Straight down a cone: its polar angle is constant.
            StepCurve::Line { .. } => 0.0,
            StepCurve::Other(_) => f64::NAN,
        };
        if *forward { found } else { -found }
    };
    face.loops.iter().flatten().map(along).sum()
}

/// ∬ z (x_u y_v − y_u x_v) du dv over a patch, mm³.
fn lifted(patch: &NurbsSurface) -> f64 {
    let mut volume = 0.0;
    for u in patch.u.spans() {
        for v in patch.v.spans() {
            let across = |u: f64| {
                let value = |v: f64| {
                    let [p, by_u, by_v] = patch.point_and_slopes(u, v);
                    p.z * (by_u.x * by_v.y - by_u.y * by_v.x)
                };
                camgen_kernel::numeric::quadrature::integrate(value, v, 1)
            };
            volume += camgen_kernel::numeric::quadrature::integrate(across, u, 1);
        }
    }
    volume
}

/// The least width of the groove as it is in the file, mm, with where it is least: the room between the flanks less what they stand out.
pub(super) fn least_width(evidence: &Evidence<'_>) -> Option<(f64, f64)> {
    let solid = evidence.swept?.solid.as_ref()?;
    let [upper, lower] = solid.rolled.map(|flank| flank.worst);
    let at = if upper.value.abs() > lower.value.abs() { upper.at } else { lower.at };
    Some((upper.value.abs() + lower.value.abs(), at))
}

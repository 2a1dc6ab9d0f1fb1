//! What a conoid must keep: its sections, its surface, its written files.

use super::surface::Surface;
use super::{Finding, Verdict, verdict};
use crate::cam::between::Residual;
use crate::cam::conoid::{Conoid, Measures, Worst};
use crate::cam::{Place, extremes};
use crate::contour::Contour;
use crate::law::Law;
use crate::machine::{Crown, Rotation};
use rayon::prelude::*;

/// Cam angles at which the sphere is put on a written section.
const ANGLES: u32 = 720;

/// A written section: speed (rpm), place along the axis (m) and its outline as read back, mm.
#[derive(Debug, Clone, Copy)]
pub struct WrittenSection<'a> {
    /// Speed, rpm.
    pub rpm: f64,
    /// Place along the axis, m.
    pub z: f64,
    /// The outline.
    pub outline: &'a Contour,
}

/// What the checks want to know beside the cam.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// The cam.
    pub conoid: &'a Conoid,
    /// What was found of its surface.
    pub measures: &'a Measures,
    /// The sections as written, when they were.
    pub sections: &'a [WrittenSection<'a>],
    /// Largest gap of a sphere on the written flank, mm, and where; `None` when no flank was drawn.
    pub flank_gap: Option<(f64, Worst)>,
    /// What is left between the sections, and the limit for it (N), if any.
    pub between: (Residual, Option<f64>),
    /// Tolerance, mm.
    pub tolerance_mm: f64,
}

/// Runs every check of a conoid.
#[must_use]
pub fn run(subject: &Subject<'_>) -> Vec<Finding> {
    let conoid = subject.conoid;
    let mut findings = vec![pressure_angle(conoid), axial_force(conoid, &subject.measures.axial_force)];
    findings.extend(curvature(conoid, subject.measures.sharpest));
    findings.push(cutter_radius(conoid));
    findings.extend(wall(conoid));
    findings.extend(tangency(subject));
    findings.extend(rolling(subject));
    findings.extend(flank(subject));
    findings.push(axial_reach(conoid));
    findings.extend(cylinder_contact(conoid, subject.tolerance_mm));
    findings.push(force_closure(conoid));
    findings.push(between(subject));
    findings
}

fn at(conoid: &Conoid, worst: &Worst) -> (Place, String) {
    let between = |rpm: &[f64]| rpm.first() != rpm.last();
    let note = if between(&conoid.speeds) { format!("at z = {:.3} mm", 1e3 * worst.z) } else { String::new() };
    (Place::at_angle(worst.angle), note)
}

fn finding(check: &'static str, value: f64, limit: Option<f64>, unit: &'static str, kept: Verdict) -> Finding {
    Finding { check, value, limit, unit, place: Place::default(), verdict: kept, note: None }
}

/// Adds the place of a worst.
fn placed(conoid: &Conoid, worst: &Worst, finding: &Finding, more: Option<String>) -> Finding {
    let (place, place_note) = at(conoid, worst);
    let words: Vec<String> =
        [place_note, more.unwrap_or_default()].into_iter().filter(|word| !word.is_empty()).collect();
    Finding { place, note: (!words.is_empty()).then(|| words.join("; ")), ..finding.clone() }
}

fn remedy(conoid: &Conoid) -> Option<String> {
    let base = conoid.smallest_prime_radius? - conoid.machine.roller.radius;
    Some(format!("a base radius of {} mm would pass", (1e3 * base - 1e-3).ceil()))
}

/// The angle between the roller's path and the normal of the section, over every slice.
fn pressure_angle(conoid: &Conoid) -> Finding {
    let in_slice = |z: &f64| {
        let worst = extremes::pressure_angle(&conoid.plane(*z));
        Worst { value: worst.value, angle: worst.at, z: *z }
    };
    let all: Vec<Worst> = conoid.slices().par_iter().map(in_slice).collect();
    let none = Worst { value: f64::NEG_INFINITY, angle: 0.0, z: 0.0 };
    let worst = all.into_iter().fold(none, |best, next| if next.value > best.value { next } else { best });
    let limit = conoid.machine.limits.pressure_angle;
    let kept = worst.value <= limit * (1.0 + 1e-12);
    let limit = (limit.to_degrees() * 1e12).round() / 1e12;
    let found = finding("pressure_angle", worst.value.to_degrees(), Some(limit), "deg", verdict(kept));
    placed(conoid, &worst, &found, if kept { None } else { remedy(conoid) })
}

/// What the drive of the shift must hold, and how far the normal leans along the axis.
fn axial_force(conoid: &Conoid, force: &Worst) -> Finding {
    let lean = conoid.worst(|conoid, piece, angle, z| conoid.contact(piece, angle, z).normal.z.abs());
    let note = format!("the normal leans {:.3}° along the axis at the most", libm::asin(lean.value).to_degrees());
    placed(conoid, force, &finding("axial_force", force.value, None, "N", Verdict::Info), Some(note))
}

/// Undercut and sharpness by the principal curvatures of the pitch surface.
fn curvature(conoid: &Conoid, sharpest: Worst) -> [Finding; 2] {
    let corner = conoid.positions.iter().find_map(|z| {
        let corners = extremes::corners(&conoid.plane(*z));
        corners.iter().find(|c| c.turn > 0.0).map(|c| Worst { value: f64::INFINITY, angle: c.angle, z: *z })
    });
    let worst = corner.unwrap_or(sharpest);
    let radius = if worst.value > 0.0 { 1.0 / worst.value } else { f64::INFINITY };
    let roller = conoid.machine.roller.radius;
    let limit = conoid.machine.limits.min_convex_pitch_radius_over_roller * roller;
    let folds = radius - roller > 0.0;
    let sharp = radius >= limit * (1.0 - 1e-9);
    let help = |kept: bool| if kept { None } else { remedy(conoid) };
    [
        placed(
            conoid,
            &worst,
            &finding("undercut", 1e3 * (radius - roller), Some(0.0), "mm", verdict(folds)),
            help(folds),
        ),
        placed(
            conoid,
            &worst,
            &finding("min_convex_radius", 1e3 * radius, Some(1e3 * limit), "mm", verdict(sharp)),
            help(sharp),
        ),
    ]
}

/// The largest ball that gets into the hollows of the cam's surface.
fn cutter_radius(conoid: &Conoid) -> Finding {
    let hollow = conoid.worst_of_metal(|conoid, piece, angle, z| -conoid.principal_curvatures(piece, angle, z).1);
    let limit = conoid.machine.limits.cutter_radius;
    let radius = if hollow.value > 0.0 { 1.0 / hollow.value + conoid.machine.roller.radius } else { f64::INFINITY };
    let kept = limit.map_or(Verdict::Info, |limit| verdict(limit <= radius));
    let found = finding("cutter_radius", 1e3 * radius, limit.map(|limit| 1e3 * limit), "mm", kept);
    if hollow.value > 0.0 {
        placed(conoid, &hollow, &found, None)
    } else {
        Finding { note: Some("nothing is concave".into()), ..found }
    }
}

/// Metal between the bore and the nearest place of the surface.
fn wall(conoid: &Conoid) -> Option<Finding> {
    let bore = conoid.machine.cam.bore_reach()?;
    let nearest = conoid.smallest_radius();
    let found = super::wall::finding(nearest.value - bore, conoid.machine.limits.wall);
    Some(placed(conoid, &nearest, &found, None))
}

fn tangency(subject: &Subject<'_>) -> Option<Finding> {
    let of = |section: &WrittenSection<'_>| {
        let z = section.z;
        section.outline.tangent_breaks().into_iter().map(move |turn| (turn, z)).collect::<Vec<_>>()
    };
    let breaks = subject.sections.iter().flat_map(of);
    let (turn, z) = breaks.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    let note = Some(format!("at z = {:.3} mm", 1e3 * z));
    Some(Finding { note, ..super::tangency::finding(turn, Place::default()) })
}

/// The sphere of the roller on the sections as read back from their files: the sphere that touches the cut at z stands at
/// ζ, and the plane cuts a circle of radius √(r² − (ζ − z)²) out of it that must touch the outline.
fn rolling(subject: &Subject<'_>) -> Option<Finding> {
    let conoid = subject.conoid;
    let of_section = |section: &WrittenSection<'_>| {
        let turned = conoid.machine.cam.rotation == Rotation::CounterClockwise;
        let outline = if turned { section.outline.mirrored_about_x() } else { section.outline.clone() };
        let surface = Surface::new(&outline);
        let law = conoid.slice(section.z);
        let gap = |angle: f64| {
            let (piece, inside) = law.locate(angle);
            let (_, zeta) = conoid.cut(piece, inside, section.z)?;
            let sphere = conoid.contact(piece, inside, zeta);
            let (r, away) = (conoid.machine.roller.radius, zeta - section.z);
            let circle = 1e3 * ((r - away) * (r + away)).sqrt();
            Some(-surface.nearest(sphere.centre.xy() * 1e3)?.left - circle)
        };
        let (first, last) = law.range();
        let place = |i: u32| first + (last - first) * (f64::from(i) + 0.5) / f64::from(ANGLES);
        let worst = |best: Worst, i: u32| {
            let value = gap(place(i)).unwrap_or(f64::INFINITY);
            if value.abs() > best.value.abs() { Worst { value, angle: place(i), z: section.z } } else { best }
        };
        (0..ANGLES).fold(Worst { value: 0.0, angle: first, z: section.z }, worst)
    };
    let all: Vec<Worst> = subject.sections.par_iter().map(of_section).collect();
    let worst = all.into_iter().reduce(|a, b| if b.value.abs() > a.value.abs() { b } else { a })?;
    let kept = worst.value.abs() <= subject.tolerance_mm;
    let found = finding("rolling", worst.value.abs(), Some(subject.tolerance_mm), "mm", verdict(kept));
    let note =
        format!("sphere on {} sections as read from their files, at {ANGLES} angles each", subject.sections.len());
    Some(placed(conoid, &worst, &found, Some(note)))
}

/// The sphere on the flank as it is written.
fn flank(subject: &Subject<'_>) -> Option<Finding> {
    let (gap, worst) = subject.flank_gap?;
    let kept = gap.abs() <= subject.tolerance_mm;
    let found = finding("rolling_flank", gap.abs(), Some(subject.tolerance_mm), "mm", verdict(kept));
    Some(placed(subject.conoid, &worst, &found, Some("sphere on the spline patches of the solid".into())))
}

/// How far the contact leaves the cam at its ends; without an overhang in the machine file it is told, with one it fails.
fn axial_reach(conoid: &Conoid) -> Finding {
    let (low, high) = conoid.ends();
    let beyond = conoid.worst(|conoid, piece, angle, z| {
        let contact = conoid.contact(piece, angle, z).point.z;
        (contact - high).max(low - contact)
    });
    let reach = beyond.value.max(0.0);
    let asked = conoid.data.overhang > 0.0;
    let kept = reach <= 1e-12;
    let verdict = if asked || kept { verdict(kept) } else { Verdict::Info };
    let needed = (1e3 * (conoid.data.overhang + reach)).ceil();
    let note = (!kept).then(|| {
        format!("the roller touches beyond the end of the cam; conoid.overhang = \"{needed} mm\" would carry it")
    });
    placed(conoid, &beyond, &finding("axial_reach", 1e3 * reach, Some(0.0), "mm", verdict), note)
}

/// A straight roller on a flank that leans along the axis stands on an edge.
fn cylinder_contact(conoid: &Conoid, tolerance_mm: f64) -> Option<Finding> {
    let roller = conoid.machine.roller;
    let width = (roller.crown == Crown::Cylinder).then_some(roller.width)??;
    let gap = conoid.worst(|conoid, piece, angle, z| {
        let cosine = libm::cos(conoid.plane(z).contact(piece, angle).pressure_angle);
        let lift = |share: f64| conoid.lift(piece, angle, z + share * width)[0][0] * cosine;
        let all = [-0.5, -0.25, 0.0, 0.25, 0.5].map(lift);
        let (least, most) = all.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)));
        1e3 * (most - least)
    });
    let kept = gap.value <= tolerance_mm;
    let note = (!kept).then(|| "the roller bears on an edge; follower.roller.crown = \"sphere\" would not".into());
    let found = finding("cylinder_contact", gap.value, Some(tolerance_mm), "mm", verdict(kept));
    Some(placed(conoid, &gap, &found, note))
}

fn force_closure(conoid: &Conoid) -> Finding {
    let roller = conoid.machine.roller;
    if !super::force_closure::told(&roller) {
        return super::force_closure::not_run();
    }
    let least =
        conoid.worst_of_sections(|section, rpm, _, piece, angle| -conoid.roller_force(section, rpm, piece, angle));
    placed(conoid, &least, &super::force_closure::finding(-least.value, &roller, Place::default()), None)
}

fn between(subject: &Subject<'_>) -> Finding {
    let (left, limit) = subject.between;
    let kept = limit.map_or(Verdict::Info, |limit| verdict(left.force <= limit));
    let note = format!("at {:.3} rpm, of {} sections", left.rpm, subject.conoid.speeds.len());
    let place = Place::at_angle(left.angle);
    Finding { place, note: Some(note), ..finding("between_sections", left.force, limit, "N", kept) }
}

//! What the solid of a STEP file must be: one body with one closed shell, its ends where they belong, upright walls on
//! the edges of the ends, nothing turned inside out. As for a DXF file, the follower is rolled on its outline, and its holes are
//! compared.

use super::check::{Evidence, FileCheck, WrittenSolid};
use crate::body::Request;
use crate::check::{Check, CheckExplanation};
use crate::reading::step::FaceLoop;
use crate::report::{Bound, Finding, Verdict};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::text::{Length, LengthKind, Text, text};

pub(super) const SOLIDS: FileCheck = FileCheck::on_file(
    "solids",
    "",
    "How many bodies a STEP file holds; it must be one solid with one closed shell and nothing else.",
    CheckExplanation {
        bound: Bound::Exactly,
        formula: "the number of MANIFOLD_SOLID_BREP",
        usual: "1, camgen's own rule: a cam is one solid",
        change: "save the cam alone, as one solid",
    },
    |evidence| Some(solids(evidence.solid?)),
);

pub(super) const SHELL: FileCheck = FileCheck::on_file(
    "shell",
    "",
    "How many faults the boundary of a solid has: edges that are not shared by two faces in opposite senses, that miss their \
     vertices or leave their faces, and entities that cannot be read.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "the number of faults of the boundary",
        usual: "ISO 10303-42: every edge of a closed shell is used twice, in opposite senses",
        change: "repair the solid in CAD, or write the file with camgen again",
    },
    |evidence| Some(shell(evidence.solid?)),
);

pub(super) const WALLS: FileCheck = FileCheck::on_file(
    "walls",
    "",
    "How many faces of a solid are not one of its two ends, an upright wall on their edges or a patch of a conoid's flank, or are \
     turned inside out, or do not reach from end to end.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "the number of such faces",
        usual: "camgen's own rule: a plane cam is an extruded outline",
        change: "remove chamfers, drafts and other features from the file that is checked",
    },
    |evidence| Some(walls(evidence, evidence.solid?)),
);

pub(super) const THICKNESS: FileCheck = FileCheck::on_file(
    "thickness",
    "mm",
    "How far the end faces of a solid are from their places: z = 0 and the thickness, or the ends of a conoid.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |z − z₀| over the end faces",
        usual: "the tolerance",
        change: "set `cam.thickness` as in the file, or save the solid with its lower face at z = 0",
    },
    |evidence| Some(thickness(evidence, evidence.solid?)),
);

pub(super) const VOLUME: FileCheck = FileCheck::on_file(
    "volume",
    "mm³",
    "The volume that the walls of a solid enclose; it must be the area of its end face times its thickness.",
    CheckExplanation {
        bound: Bound::Exactly,
        formula: "∮ over the walls, compared with area × thickness",
        usual: "the same to a millionth, camgen's own rule",
        change: "write the solid with camgen again",
    },
    |evidence| volume(evidence, evidence.solid?),
);

pub(super) const HOLES: FileCheck = FileCheck::on_file(
    "holes",
    "mm",
    "How far bore, keyway and balance holes of a solid are from their places.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "the largest distance of a wall from the hole it belongs to",
        usual: "the tolerance",
        change: "set `cam.bore_radius`, `cam.keyway` and `cam.balance` as in the file, or correct the file",
    },
    |evidence| Some(holes(evidence, evidence.solid?)),
);

pub(super) const HUB: FileCheck = FileCheck::on_file(
    "hub",
    "mm",
    "The largest distance of the hub of a solid, its cylinder and its ends, from that of the design.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "the largest of |R − R₀| and |z − z₀|",
        usual: "the tolerance",
        change: "set `cam.hub` as in the file, or correct the file",
    },
    |evidence| Some(hub(evidence, evidence.solid?.hub?)),
);

/// Places on each segment at which the contours of holes are compared: a segment is an arc or a line, and so is its counterpart.
const PLACES: u32 = 32;

/// Edges and faces of a solid meet within this share of the tolerance, but this need not be closer than the uncertainty that STEP
/// files state, mm.
const REACH_SHARE: f64 = 0.01;
const UNCERTAINTY: f64 = 1e-6;
/// Most sentences of one finding.
const MOST_SENTENCES: usize = 3;
/// Largest relative difference of the two volumes: what results from edges that miss their faces by the reach above.
const VOLUME_TOLERANCE: f64 = 1e-6;

/// How near edges, vertices and faces of a solid must meet (mm), for a tolerance in mm.
#[must_use]
pub fn shell_reach(tolerance_mm: f64) -> f64 {
    (REACH_SHARE * tolerance_mm).max(UNCERTAINTY)
}

/// A finding of a count with its required value, with the first few of its sentences.
#[expect(clippy::cast_precision_loss, reason = "counts of things in a file")]
fn counted(check: &Check, found: usize, limit: usize, sentences: &[String]) -> Finding {
    let mut words: Vec<String> = sentences.iter().take(MOST_SENTENCES).cloned().collect();
    if sentences.len() > MOST_SENTENCES {
        words.push(format!("and {} more", sentences.len() - MOST_SENTENCES));
    }
    let verdict = Verdict::of(found == limit && sentences.is_empty());
    let note = (!words.is_empty()).then(|| words.join("; ").into());
    Finding { note, ..check.found(found as f64, Some(limit as f64), verdict) }
}

fn solids(solid: &WrittenSolid) -> Finding {
    let bodies = &solid.file.bodies;
    let alone = bodies.len() == 1 && !solid.file.boundary.faces.is_empty();
    let sentences = match bodies.as_slice() {
        [] => vec!["the file holds no MANIFOLD_SOLID_BREP".to_owned()],
        _ if alone => Vec::new(),
        bodies => bodies.to_vec(),
    };
    counted(&SOLIDS, bodies.len(), 1, &sentences)
}

fn shell(solid: &WrittenSolid) -> Finding {
    let sentences = [&solid.file.faults[..], &solid.form.open[..]].concat();
    counted(&SHELL, sentences.len(), 0, &sentences)
}

/// The closed runs of edges of an end face: outer contours and holes.
fn outer_runs(runs: &[FaceLoop]) -> usize {
    let is_outer = |run: &&FaceLoop| match run {
        FaceLoop::Contour(contour) => contour.area_and_centroid().0 > 0.0,
        FaceLoop::Splines(_) => true,
    };
    runs.iter().filter(is_outer).count()
}

fn walls(evidence: &Evidence<'_>, solid: &WrittenSolid) -> Finding {
    let form = &solid.form;
    let mut sentences = form.strange.clone();
    let flank = evidence.body.surface().is_some();
    // What stands within a groove has an outer contour of its own.
    let islands = evidence.body.cuts().iter().filter(|cut| cut.depth.is_some() && !cut.is_hollow()).count();
    for (name, runs, outer) in [("lower", &form.under, 1), ("upper", &form.above, 1 + islands)] {
        let splines = runs.iter().filter(|run| matches!(run, FaceLoop::Splines(_))).count();
        if outer_runs(runs) != outer {
            sentences.push(format!("the {name} end has {} outer contours", outer_runs(runs)));
        }
        if splines != usize::from(flank) {
            let due = if flank { "one, the flank's" } else { "no contours that cannot be read" };
            sentences.push(format!("the {name} end has {splines} contours of splines; it should have {due}"));
        }
    }
    let apart = form.end_difference;
    if apart.is_finite() && apart > 2.0 * shell_reach(evidence.tolerance_mm) {
        sentences.push(format!("the contours of the two ends are {apart:.6} mm apart"));
    } else if !apart.is_finite() && sentences.is_empty() {
        sentences.push("the two ends have different numbers of contours".to_owned());
    }
    counted(&WALLS, sentences.len(), 0, &sentences)
}

fn thickness(evidence: &Evidence<'_>, solid: &WrittenSolid) -> Finding {
    let (low, high) = (&solid.form.low, &solid.form.high);
    let Some((from, to)) = evidence.body.height() else {
        return THICKNESS.not_run("cam.thickness is not given");
    };
    let below = low.iter().map(|z| (z, z - from));
    // Without a groove there is no floor.
    let depth = evidence.body.cuts().iter().find_map(|cut| cut.depth).map_or(0.0, |depth| MILLIMETRES * depth);
    let floor = solid.form.floor.iter().map(|z| (z, z - (to - depth)));
    let worst =
        below.chain(high.iter().map(|z| (z, z - to))).chain(floor).max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let limit = evidence.tolerance_mm;
    let (value, note) = match worst {
        Some((z, off)) if !low.is_empty() && !high.is_empty() => {
            let sentences = (off.abs() > limit).then(|| {
                let [z, from, to] = [*z, from, to].map(|z| Length::mm(z).decimals(6));
                text!("an end face lies at z = {}; the ends should be at {} and {}", z, from.bare(), to)
            });
            (off.abs(), sentences)
        }
        _ => (f64::INFINITY, Some("the solid needs one end face above and one below".into())),
    };
    Finding { note, ..THICKNESS.found(value, Some(limit), Verdict::of(value <= limit)) }
}

fn volume(evidence: &Evidence<'_>, solid: &WrittenSolid) -> Option<Finding> {
    if evidence.body.surface().is_some() {
        return None;
    }
    let form = &solid.form;
    let area = |run: &FaceLoop| match run {
        FaceLoop::Contour(contour) => contour.area_and_centroid().0,
        FaceLoop::Splines(_) => f64::NAN,
    };
    let (low, high) = (form.low.first()?, form.high.first()?);
    let (above, under) = (form.above.iter().map(area).sum::<f64>(), form.under.iter().map(area).sum::<f64>());
    let expected = match form.floor {
        Some(floor) => under * (high - low) - (under - above) * (high - floor),
        None => above * (high - low),
    };
    let Some(volume) = form.volume else {
        return Some(VOLUME.not_run("a face or an edge was not read"));
    };
    let kept = volume > 0.0 && (volume / expected - 1.0).abs() <= VOLUME_TOLERANCE;
    let note =
        (!kept).then(|| text!("area times thickness is {}", Length::new(expected, &LengthKind::MM3).decimals(3)));
    Some(Finding { note, ..VOLUME.found(volume, Some(expected), Verdict::of(kept)) })
}

fn holes(evidence: &Evidence<'_>, solid: &WrittenSolid) -> Finding {
    let limit = evidence.tolerance_mm;
    let is_hole = |run: &FaceLoop| match run {
        FaceLoop::Contour(contour) if !(contour.area_and_centroid().0 > 0.0) => Some(contour.clone()),
        _ => None,
    };
    let mut found: Vec<Contour> = solid.form.under.iter().filter_map(is_hole).collect();
    if evidence.body.cuts().iter().any(|cut| cut.is_hollow() && cut.depth.is_none()) {
        // The widest hole of a ring is its profile.
        found.sort_by(|a, b| b.area_and_centroid().0.total_cmp(&a.area_and_centroid().0));
        found.pop();
    }
    let drawn = evidence.body.draw(&Request::within(limit / MILLIMETRES));
    let Some(part) = drawn.iter().find_map(|drawn| drawn.parts.first()) else {
        return HOLES.not_run("there is no outline to compare the holes with");
    };
    let expected = part.hole_contours();
    let value = farthest(&found, &expected).max(farthest(&expected, &found));
    let note = if found.len() == expected.len() {
        (value > limit).then(|| Text::from("a hole is in another place or has another shape"))
    } else {
        Some(text!("{} holes; there should be {}", found.len(), expected.len()))
    };
    let kept = value <= limit && found.len() == expected.len();
    Finding { note, ..HOLES.found(value, Some(limit), Verdict::of(kept)) }
}

fn hub(evidence: &Evidence<'_>, off: f64) -> Finding {
    let limit = evidence.tolerance_mm;
    let note = off.is_infinite().then(|| Text::from("the solid has no round hub about its axis"));
    Finding { note, ..HUB.found(off, Some(limit), Verdict::of(off <= limit)) }
}

/// The largest distance of any place on these contours from the others, mm.
pub(super) fn farthest(these: &[Contour], those: &[Contour]) -> f64 {
    let trees: Vec<EdgeTree> = those.iter().map(EdgeTree::new).collect();
    let places = these.iter().flat_map(Contour::edges);
    let places =
        places.flat_map(|edge| (0..PLACES).map(move |i| edge.point_and_tangent(f64::from(i) / f64::from(PLACES)).0));
    let nearest = |place: nalgebra::Vector2<f64>| {
        let all = trees.iter().filter_map(|tree| tree.nearest(place)).map(|nearest| nearest.left.abs());
        all.fold(f64::INFINITY, f64::min)
    };
    places.map(nearest).fold(0.0, f64::max)
}

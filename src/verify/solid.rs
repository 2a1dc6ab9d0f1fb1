//! What the solid of a STEP file must be: one body with one closed shell, its ends where they belong, upright walls that stand on
//! the edges of the ends, nothing turned inside out. Its outline is rolled on, and its holes are compared, as those of a DXF
//! file are.

use super::{Bound, Check, Evidence, Explained};
use crate::body::Request;
use crate::geometry::MILLIMETRES;
use crate::geometry::contour::Contour;
use crate::geometry::track::Track;
use crate::reading::step::{Form, Loop, StepFile};
use crate::report::{Finding, Verdict};

/// The solid of a STEP file as read, and what its boundary amounts to.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenSolid {
    /// The file.
    pub file: StepFile,
    /// What its boundary amounts to.
    pub form: Form,
}

pub(super) const SOLIDS: Check = Check::on_file(
    "solids",
    "How many bodies a STEP file holds; it must be one solid with one closed shell and nothing else.",
    Explained {
        bound: Bound::Exactly,
        formula: "the number of MANIFOLD_SOLID_BREP",
        usual: "camgen's own rule: a cam is one solid",
        change: "save the cam alone, as one solid",
    },
    |evidence| Some(solids(evidence.solid?)),
);

pub(super) const SHELL: Check = Check::on_file(
    "shell",
    "How often the boundary of a solid does not close: edges that have not two faces in opposite senses, that miss their \
     vertices or leave their faces, and what cannot be read.",
    Explained {
        bound: Bound::AtMost,
        formula: "the number of faults of the boundary",
        usual: "ISO 10303-42: every edge of a closed shell is used twice, in opposite senses",
        change: "mend the solid in CAD, or write the file with camgen again",
    },
    |evidence| Some(shell(evidence.solid?)),
);

pub(super) const WALLS: Check = Check::on_file(
    "walls",
    "How many faces of a solid are neither its two ends nor upright walls on their edges, nor patches of a conoid's flank, or are \
     turned inside out, or do not stand from end to end.",
    Explained {
        bound: Bound::AtMost,
        formula: "the number of such faces",
        usual: "camgen's own rule: a plane cam is its outline, extruded",
        change: "remove chamfers, drafts and other features from the file that is checked",
    },
    |evidence| Some(walls(evidence, evidence.solid?)),
);

pub(super) const THICKNESS: Check = Check::on_file(
    "thickness",
    "How far the end faces of a solid are from where they should be: at z = 0 and the thickness, or the ends of a conoid.",
    Explained {
        bound: Bound::AtMost,
        formula: "max |z − z₀| over the end faces",
        usual: "the tolerance",
        change: "set `cam.thickness` as in the file, or save the solid with its lower face at z = 0",
    },
    |evidence| Some(thickness(evidence, evidence.solid?)),
);

pub(super) const VOLUME: Check = Check::on_file(
    "volume",
    "The volume that the walls of a solid enclose; it must be the area of its end face times its thickness.",
    Explained {
        bound: Bound::Exactly,
        formula: "∮ over the walls, against area × thickness",
        usual: "camgen's own rule: a millionth",
        change: "write the solid with camgen again",
    },
    |evidence| volume(evidence, evidence.solid?),
);

pub(super) const HOLES: Check = Check::on_file(
    "holes",
    "How far bore, keyway and balance holes of a solid are from where they should be.",
    Explained {
        bound: Bound::AtMost,
        formula: "the largest distance of a wall from the hole it belongs to",
        usual: "the tolerance",
        change: "set `cam.bore_radius`, `cam.keyway` and `cam.balance` as in the file, or mend the file",
    },
    |evidence| Some(holes(evidence, evidence.solid?)),
);

/// Places on each segment at which contours of holes are compared: a segment is an arc or a line, and so is what it should be.
const PLACES: u32 = 32;

/// Edges and faces of a solid meet within this share of the tolerance, and no closer than the uncertainty that STEP files
/// state, mm.
const REACH_SHARE: f64 = 0.01;
const UNCERTAINTY: f64 = 1e-6;
/// Sentences of one finding that are told.
const TOLD: usize = 3;
/// Largest relative difference of the two volumes: what edges that miss their faces by the reach above leave.
const VOLUME_TOLERANCE: f64 = 1e-6;

/// How near edges, vertices and faces of a solid must meet (mm), for a tolerance in mm.
#[must_use]
pub fn shell_reach(tolerance_mm: f64) -> f64 {
    (REACH_SHARE * tolerance_mm).max(UNCERTAINTY)
}

/// A count that must be so many, with the first few of its sentences.
#[expect(clippy::cast_precision_loss, reason = "counts of things in a file")]
fn counted(check: &Check, found: usize, limit: usize, told: &[String]) -> Finding {
    let mut words: Vec<String> = told.iter().take(TOLD).cloned().collect();
    if told.len() > TOLD {
        words.push(format!("and {} more", told.len() - TOLD));
    }
    let verdict = Verdict::of(found == limit && told.is_empty());
    let note = (!words.is_empty()).then(|| words.join("; "));
    Finding { note, ..check.found(found as f64, Some(limit as f64), "", verdict) }
}

fn solids(solid: &WrittenSolid) -> Finding {
    let bodies = &solid.file.bodies;
    let alone = bodies.len() == 1 && !solid.file.boundary.faces.is_empty();
    let told = match bodies.as_slice() {
        [] => vec!["the file holds no MANIFOLD_SOLID_BREP".to_owned()],
        _ if alone => Vec::new(),
        bodies => bodies.to_vec(),
    };
    counted(&SOLIDS, bodies.len(), 1, &told)
}

fn shell(solid: &WrittenSolid) -> Finding {
    let told = [&solid.file.faults[..], &solid.form.open[..]].concat();
    counted(&SHELL, told.len(), 0, &told)
}

/// The runs round an end face, those with metal inside and the holes.
fn outer_runs(runs: &[Loop]) -> usize {
    let is_outer = |run: &&Loop| match run {
        Loop::Contour(contour) => contour.area_and_centroid().0 > 0.0,
        Loop::Splines(_) => true,
    };
    runs.iter().filter(is_outer).count()
}

fn walls(evidence: &Evidence<'_>, solid: &WrittenSolid) -> Finding {
    let form = &solid.form;
    let mut told = form.strange.clone();
    let flank = evidence.body.spatial().is_some();
    for (name, runs) in [("lower", &form.under), ("upper", &form.above)] {
        let splines = runs.iter().filter(|run| matches!(run, Loop::Splines(_))).count();
        if outer_runs(runs) != 1 {
            told.push(format!("the {name} end has {} outer contours", outer_runs(runs)));
        }
        if splines != usize::from(flank) {
            let due = if flank { "one, that of the flank" } else { "none that cannot be read" };
            told.push(format!("the {name} end has {splines} contours of splines; it should have {due}"));
        }
    }
    if !(form.apart <= 2.0 * shell_reach(evidence.tolerance_mm)) {
        told.push(format!("the contours of the two ends are {:.6} mm apart", form.apart));
    }
    counted(&WALLS, told.len(), 0, &told)
}

fn thickness(evidence: &Evidence<'_>, solid: &WrittenSolid) -> Finding {
    let (low, high) = (&solid.form.low, &solid.form.high);
    let Some((from, to)) = evidence.body.height() else {
        return THICKNESS.not_run("mm", "cam.thickness is not given");
    };
    let below = low.iter().map(|z| (z, z - from));
    let worst = below.chain(high.iter().map(|z| (z, z - to))).max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let limit = evidence.tolerance_mm;
    let (value, note) = match worst {
        Some((z, off)) if !low.is_empty() && !high.is_empty() => {
            let told = (off.abs() > limit)
                .then(|| format!("an end face lies at z = {z:.6} mm; the ends should be at {from:.6} and {to:.6} mm"));
            (off.abs(), told)
        }
        _ => (f64::INFINITY, Some("the solid has not an end face above and one below".into())),
    };
    Finding { note, ..THICKNESS.found(value, Some(limit), "mm", Verdict::of(value <= limit)) }
}

fn volume(evidence: &Evidence<'_>, solid: &WrittenSolid) -> Option<Finding> {
    if evidence.body.spatial().is_some() {
        return None;
    }
    let form = &solid.form;
    let area = |run: &Loop| match run {
        Loop::Contour(contour) => contour.area_and_centroid().0,
        Loop::Splines(_) => f64::NAN,
    };
    let (low, high) = (form.low.first()?, form.high.first()?);
    let expected = form.above.iter().map(area).sum::<f64>() * (high - low);
    let kept = form.volume > 0.0 && (form.volume / expected - 1.0).abs() <= VOLUME_TOLERANCE;
    let note = (!kept).then(|| format!("area times thickness is {expected:.3} mm³"));
    Some(Finding { note, ..VOLUME.found(form.volume, Some(expected), "mm³", Verdict::of(kept)) })
}

fn holes(evidence: &Evidence<'_>, solid: &WrittenSolid) -> Finding {
    let limit = evidence.tolerance_mm;
    let is_hole = |run: &Loop| match run {
        Loop::Contour(contour) if !(contour.area_and_centroid().0 > 0.0) => Some(contour.clone()),
        _ => None,
    };
    let found: Vec<Contour> = solid.form.under.iter().filter_map(is_hole).collect();
    let drawn = evidence.body.draw(&Request::within(limit / MILLIMETRES));
    let Some(part) = drawn.iter().find_map(|drawn| drawn.parts.first()) else {
        return HOLES.not_run("mm", "there is no outline to compare it with");
    };
    let expected = part.hole_contours();
    let value = farthest(&found, &expected).max(farthest(&expected, &found));
    let note = if found.len() == expected.len() {
        (value > limit).then(|| "a hole is not where it should be, or of another shape".to_owned())
    } else {
        Some(format!("{} holes; there should be {}", found.len(), expected.len()))
    };
    let kept = value <= limit && found.len() == expected.len();
    Finding { note, ..HOLES.found(value, Some(limit), "mm", Verdict::of(kept)) }
}

/// The largest distance of any place on these contours from those, mm.
fn farthest(these: &[Contour], those: &[Contour]) -> f64 {
    let tracks: Vec<Track> = those.iter().map(Track::new).collect();
    let places = these.iter().flat_map(Contour::edges);
    let places = places.flat_map(|edge| (0..PLACES).map(move |i| edge.at(f64::from(i) / f64::from(PLACES)).0));
    let nearest = |place: nalgebra::Vector2<f64>| {
        let all = tracks.iter().filter_map(|track| track.nearest(place)).map(|nearest| nearest.left.abs());
        all.fold(f64::INFINITY, f64::min)
    };
    places.map(nearest).fold(0.0, f64::max)
}

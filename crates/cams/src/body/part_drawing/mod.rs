//! The drawing for manufacture of a part of even thickness: front view, true sections, sizes, tolerances, and the table of its profile.

pub(in crate::body) mod fits;
mod front;
pub(crate) mod pair;
pub(in crate::body) mod proposals;
mod section;
mod table;

use super::{Body, Drawn, Part, curves};
use crate::machine::parallel_key;
use crate::report::sheet::{Dimensions, Mark, SheetView};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::text::Text;
use proposals::PROPOSED_NOTE;
use table::ProfileTable;

/// Groups of the review sheet that belong to the mechanism or to the check of the profile, and are not on the drawing.
const OF_MECHANISM: [&str; 8] =
    ["roller", "arm", "pitch-curve", "base-circle", "prime-circle", "lost-motion", "link", "isometric-roller"];

/// The drawing of a body whose review sheet shows the part in full.
pub(super) fn without_mechanism(mut view: SheetView) -> SheetView {
    view.groups.retain(|group| !OF_MECHANISM.contains(&group.class));
    view.marks.retain(|mark| match mark {
        Mark::Label { class, .. } | Mark::Angle { class, .. } | Mark::Turning { class, .. } => {
            !OF_MECHANISM.contains(class)
        }
        _ => true,
    });
    view.lost.clear();
    view.notes.push(PROPOSED_NOTE.into());
    view
}

/// The drawing of a plane part; `review` is the view of its review sheet.
pub(super) fn of_plane_part(body: &dyn Body, drawn: &Drawn, review: SheetView) -> SheetView {
    let (Some(part), Some(curves)) = (drawn.parts.first(), curves(body)) else { return without_mechanism(review) };
    let machine = body.machine();
    let mut view = SheetView { facts: review.facts, notes: notes(body, part, review.notes), ..SheetView::default() };
    front::add(body, part, &mut view);
    if let Some(thickness) = machine.cam.thickness.map(|thickness| MILLIMETRES * thickness) {
        section::add(machine, part, thickness, &mut view);
    }
    let table = ProfileTable::new(body, part, curves);
    view.marks.extend(table.flags());
    view.tables = table.tables();
    view
}

/// Notes for the shop on everything that no line shows.
fn notes(body: &dyn Body, part: &Part, of_review: Vec<Text>) -> Vec<Text> {
    let machine = body.machine();
    let units = machine.units();
    let mut notes: Vec<Text> = vec!["ψ = 0 along +x of the DXF; ψ grows counter-clockwise".into()];
    if let (Some(bore), Some(keyway)) = (machine.cam.bore_radius, machine.cam.keyway)
        && parallel_key::standard(2.0 * bore, keyway.width, keyway.depth).is_some()
    {
        notes.push("keyway DIN 6885-1, through".into());
    }
    if machine.cam.bore_radius.is_none() {
        notes.push("no bore is given: add datum and fixing before release".into());
    } else if machine.cam.keyway.is_none() && front::timing_hole(machine).is_none() {
        notes.push("nothing on the part fixes ψ = 0: no keyway, no timing hole".into());
    }
    if part.track.as_ref().is_some_and(|track| track.depth.is_some()) {
        notes.push("groove open on the side seen in the front view".into());
    }
    if part.track.is_none() {
        let size = part.outline.contour.extents().size();
        let rounded = |value: f64| units.dimension((10.0 * value).round() / 10.0);
        notes.push(format!("encloses {} × {} along x, y of the DXF", rounded(size.x), rounded(size.y)).into());
    }
    if machine.features.split.is_some() {
        notes.push("two halves: cut the profile with the halves clamped together".into());
    }
    notes.extend(of_review);
    notes.push(PROPOSED_NOTE.into());
    notes
}

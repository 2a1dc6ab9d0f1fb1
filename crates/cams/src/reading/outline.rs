//! The one closed outline of a drawing or a solid, whatever cam it is of.

use super::step::{self, FaceLoop, FlankShape};
use super::{Chain, FileUnit, Reading, few, read_with_outline};
use camgen_kernel::geometry::contour::{Contour, Edge};
use camgen_kernel::refusal::Refusal;

/// Ends that are nearer count as one, mm.
const JOIN: f64 = 1e-3;

/// An outline as it lies in its file, with the metal on its left, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct FileOutline {
    /// The outline.
    pub contour: Contour,
    /// What was read otherwise than one might expect, a sentence each.
    pub told: Vec<String>,
}

/// The outline of a DXF or STEP file: of a DXF file that on a layer, or where no layer is named that on `CAM_PROFILE` or the only closed contour; of
/// a STEP file that of the lower end face.
///
/// # Errors
/// [`Refusal`] where the file cannot be read, or has no outline, or several.
pub fn outline_of(bytes: &[u8], layer: Option<&str>) -> Result<FileOutline, Refusal> {
    if step::is_step(bytes) { of_solid(bytes) } else { of_drawing(&read_with_outline(bytes, JOIN, layer)?) }
}

/// A refusal of a file that is read but has not the one outline.
fn refused(what: impl Into<String>, remedy: &'static str) -> Refusal {
    Refusal::new(what).remedy(remedy)
}

fn of_drawing(reading: &Reading) -> Result<FileOutline, Refusal> {
    if let Some(stray) = reading.unreadable.first() {
        return Err(refused(
            format!("a drawing that is not only curves in a plane: {stray}"),
            "remove it or redraw it",
        ));
    }
    let told = unit(reading.unit)?;
    match reading.chains.as_slice() {
        [chain] if chain.closed => Ok(FileOutline { contour: chain.counter_clockwise(), told }),
        [chain] => {
            let end = chain.edges.last().map_or_else(Default::default, Edge::end);
            let what = format!(
                "not closed: its outline has a gap of {:.4} mm at ({:.3}, {:.3}) mm",
                chain.gap(),
                end.x,
                end.y
            );
            Err(refused(what, "close it"))
        }
        [] => Err(without_outline(reading)),
        several => {
            let open = several.iter().filter(|chain| !chain.closed).count();
            let what = if open > 0 {
                format!("not one outline: {} separate curves on its layer, {open} of them open", several.len())
            } else {
                format!("not one outline: {} closed curves on its layer", several.len())
            };
            Err(refused(what, "keep the outline of the cam on a layer of its own and name it with --layer"))
        }
    }
}

fn without_outline(reading: &Reading) -> Refusal {
    let closed: Vec<&Chain> = reading.others.iter().filter(|chain| chain.closed).collect();
    let layers = few(&reading.layers);
    if reading.layers.is_empty() {
        return refused("empty: nothing in it is cut", "give a drawing with the outline of the cam");
    }
    let what = match closed.len() {
        0 => format!("without a closed outline (layers: {layers})"),
        count => format!("without an outline that is known: it has {count} closed curves on the layers {layers}"),
    };
    refused(what, "name the layer of the outline with --layer")
}

/// Remarks on the unit of a file; its lengths have been converted.
fn unit(unit: FileUnit) -> Result<Vec<String>, Refusal> {
    Ok(match unit {
        FileUnit::Millimetres => Vec::new(),
        FileUnit::Unstated => vec!["the file states no unit: read as millimetres".to_owned()],
        FileUnit::UnstatedEnglish => {
            let what = "in no stated unit, and its $MEASUREMENT = 0 stands for inches";
            return Err(refused(what, "set $INSUNITS to 1 (inches) or 4 (millimetres)"));
        }
        FileUnit::Other(name) => vec![format!("the file is in {name}: converted to millimetres")],
    })
}

fn of_solid(bytes: &[u8]) -> Result<FileOutline, Refusal> {
    let file = step::read(bytes)?;
    if let Some(fault) = file.faults.first() {
        return Err(refused(format!("a STEP file that is not read whole: {fault}"), "export one solid"));
    }
    if file.bodies.len() != 1 {
        let what = format!("a STEP file with {} bodies", file.bodies.len());
        return Err(refused(what, "export the cam alone, as one solid"));
    }
    let form = step::form(&file.boundary, FlankShape::Upright, JOIN);
    if let Some(fault) = form.open.first().or(form.strange.first()) {
        return Err(refused(format!("not the solid of a plate with upright walls: {fault}"), "export the plain disc"));
    }
    let outer = |run: &FaceLoop| match run {
        FaceLoop::Contour(contour) if contour.area_and_centroid().0 > 0.0 => Some(contour.clone()),
        _ => None,
    };
    match form.under.iter().filter_map(outer).collect::<Vec<_>>().as_slice() {
        [contour] => Ok(FileOutline { contour: contour.clone(), told: unit(file.unit)? }),
        none_or_more => {
            let what = format!("a solid with {} outer contours at its lower end", none_or_more.len());
            Err(refused(what, "export the plain disc"))
        }
    }
}

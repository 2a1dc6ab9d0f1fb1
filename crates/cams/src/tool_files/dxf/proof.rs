//! The cut file in memory, as it would be on disk, and the outline read back from its bytes.
//!
//! `reading` reads it, and its outline is proved. With the feature `second-reader` the dxf crate, which shares no code with `reading`, reads
//! it as well and must find exactly the entities that were drawn.

#[cfg(feature = "second-reader")]
use super::second_reader;
use super::write::{self as dxf, DxfForm, Version};
use crate::body::{Layer, Part};
use crate::reading::{self, Chain, Reading};
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::profile::outline::Outline;
use camgen_kernel::refusal::Refusal;

/// Ends nearer than this count as one, mm: far above twelve decimals, far below any segment.
pub const JOIN: f64 = 1e-9;

/// A written cut file.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenCut {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// The outlines another program would read from them, counter-clockwise.
    pub outlines: Vec<Contour>,
    /// What else another program would cut.
    pub others: Vec<Chain>,
}

fn read_back(bytes: &[u8], layer: Layer) -> Result<Reading, Refusal> {
    reading::read_with_outline(bytes, JOIN, Some(layer.name()))
        .map_err(|error| error.context("the DXF file as written cannot be read back"))
}

fn not_one_outline() -> Refusal {
    Refusal::new(
        "the outline cannot be written as one closed DXF outline: some of its segments are shorter than 1e-6 mm, the \
         resolution of a file",
    )
    .remedy("choose a coarser --tolerance, and look in the machine file for a length or an angle that is nearly 0")
}

/// Writes the cut drawing to memory and reads its outline back.
///
/// # Errors
/// [`Refusal`] when what was written is not what was drawn.
pub fn write(part: &Part, form: impl Into<DxfForm>) -> Result<WrittenCut, Refusal> {
    write_marked(part, form.into(), "")
}

/// Writes a developed view to memory, with a comment at the head of the file.
///
/// # Errors
/// [`Refusal`] when what was written is not what was drawn.
pub fn developed(entities: &[(Layer, Entity)], form: DxfForm, mark: &str) -> Result<Vec<u8>, Refusal> {
    let bytes = dxf::marked(dxf::write(entities, form), mark);
    #[cfg(feature = "second-reader")]
    if !second_reader::holds(&bytes, &dxf::in_units(entities, form.units)) {
        return Err(other_entities());
    }
    Ok(bytes)
}

#[cfg(feature = "second-reader")]
fn other_entities() -> Refusal {
    Refusal::new("the DXF file as written holds other entities than were drawn").remedy("please report this")
}

/// As [`write`](write()), with a comment at the head of the file.
///
/// # Errors
/// As [`write`](write()).
pub fn write_marked(part: &Part, form: DxfForm, mark: &str) -> Result<WrittenCut, Refusal> {
    if form.version == Version::R12 && part.outlines().any(|(_, outline)| outline.contour.cubics() > 0) {
        return Err(Refusal::new("DXF R12 has no SPLINE").remedy("use --outline arcs, or --dxf-version r2000 or later"));
    }
    let entities = part.entities();
    let bytes = dxf::marked(dxf::write(&entities, form), mark);
    #[cfg(feature = "second-reader")]
    if !second_reader::holds(&bytes, &dxf::in_units(&entities, form.units)) {
        return Err(other_entities());
    }
    let layers: Vec<Layer> = part.outlines().map(|(layer, _)| layer).collect();
    let (mut outlines, mut others) = (Vec::new(), Vec::new());
    for layer in &layers {
        let reading = read_back(&bytes, *layer)?;
        let clean = reading.duplicates.is_empty() && reading.points.is_empty() && reading.unreadable.is_empty();
        match reading.chains.as_slice() {
            [chain] if chain.closed && clean => outlines.push(chain.counter_clockwise()),
            _ => return Err(not_one_outline()),
        }
        let names: Vec<&str> = layers.iter().map(|layer| layer.name()).collect();
        others = reading.beside(&names);
    }
    Ok(WrittenCut { bytes, outlines, others })
}

/// The path of a cutter and its lead-ins as another program would read them from its file.
///
/// # Errors
/// [`Refusal`] when what was written is not what was drawn.
pub fn cutter_path(path: &Outline, form: impl Into<DxfForm>) -> Result<(Contour, Vec<Chain>), Refusal> {
    let bytes = dxf::cutter_path(path, form);
    let reading = read_back(&bytes, Layer::CutterPath)?;
    match reading.chains.as_slice() {
        [chain] if chain.closed && reading.duplicates.is_empty() && reading.points.is_empty() => {
            Ok((chain.contour(), reading.others))
        }
        _ => Err(not_one_outline()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    /// A path that runs out and back along one line is two lines in one place, not an outline.
    #[test]
    fn a_path_that_covers_itself_is_no_outline() {
        let vertex = |x: f64| camgen_kernel::geometry::contour::Vertex::new(Vector2::new(x, 0.0), 0.0);
        let there_and_back = Contour { vertices: vec![vertex(0.0), vertex(30.0)] };
        let drawn = |contour: &Contour| Outline { contour: contour.clone(), ..Outline::empty() };
        let found = cutter_path(&drawn(&there_and_back), Version::R2000);
        assert_eq!(found, Err(not_one_outline()));
        let circle = Contour::circle(Vector2::new(3.0, 4.0), 50.0);
        assert!(
            cutter_path(&drawn(&circle), Version::R2000)
                .is_ok_and(|(found, _)| found.vertices.len() == circle.vertices.len())
        );
    }
}

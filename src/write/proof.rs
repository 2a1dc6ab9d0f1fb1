//! The cut file in memory, as it would be on disk, and the outline read back from its bytes.
//!
//! Two readers that share nothing read it: `reading`, whose outline is proved, reads all of it; the dxf crate reads its section of
//! entities, and must find those that were drawn and no others.

use super::dxf::{self, Version};
use crate::body::{Layer, Part};
use crate::geometry::Entity;
use crate::geometry::contour::Contour;
use crate::geometry::cubics::{Run, runs};
use crate::reading::{self, Chain, ReadError};
use ::dxf::entities::EntityType;
use nalgebra::Vector2;

/// Ends nearer than this are one, mm: far above twelve decimals, far below any segment.
const JOIN: f64 = 1e-9;
/// Rounding of a coordinate to twelve decimals, and of a bulge, mm.
const ROUNDING: f64 = 1e-11;

/// A written cut file.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// The outline another program would find in them.
    pub outline: Contour,
    /// What else it would find to be cut.
    pub beside: Vec<Chain>,
}

/// The bytes do not hold the outline that was put in: a fault of camgen.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ProofError {
    /// The file cannot be read.
    #[error("the DXF file as written cannot be read back: {0}")]
    Unreadable(#[from] ReadError),
    /// The dxf crate finds other entities in it than were drawn.
    #[error("the DXF file as written holds other entities than were drawn; please report this")]
    OtherEntities,
    /// It does not hold one closed outline.
    #[error(
        "the outline cannot be written as one closed DXF outline: some of its segments are shorter than a file can tell, 1e-6 mm; \
         choose a coarser --tolerance, and look in the machine file for a length or an angle that is nearly 0"
    )]
    NotOneOutline,
    /// The version has no splines.
    #[error("DXF R12 has no SPLINE: use --outline arcs, or --dxf-version r2000 or later")]
    NoSplines,
}

/// Writes the cut drawing to memory and reads its outline back.
///
/// # Errors
/// [`ProofError`] when what was written is not what was drawn.
pub fn write(part: &Part, version: Version) -> Result<Written, ProofError> {
    write_marked(part, version, "")
}

/// As [`write`](write()), with a comment at the head of the file.
///
/// # Errors
/// As [`write`](write()).
pub fn write_marked(part: &Part, version: Version, mark: &str) -> Result<Written, ProofError> {
    if version == Version::R12 && part.outline.contour.cubics() > 0 {
        return Err(ProofError::NoSplines);
    }
    let entities = part.entities();
    let bytes = dxf::marked(dxf::write(&entities, version), mark);
    if !holds(&bytes, &entities) {
        return Err(ProofError::OtherEntities);
    }
    let reading = reading::read(&bytes, JOIN)?;
    let clean = reading.duplicates.is_empty() && reading.points.is_empty() && reading.unreadable.is_empty();
    match reading.chains.as_slice() {
        [chain] if chain.closed && clean => Ok(Written { bytes, outline: chain.contour(), beside: reading.beside }),
        _ => Err(ProofError::NotOneOutline),
    }
}

/// The path of a cutter as another program would find it in its file.
///
/// # Errors
/// [`ProofError`] when what was written is not what was drawn.
pub fn cutter_path(path: &Contour, version: Version) -> Result<Contour, ProofError> {
    let bytes = dxf::cutter_path(path, version);
    // The reader takes the layer of the outline for what is cut.
    let text = String::from_utf8_lossy(&bytes).replace(Layer::CutterPath.name(), Layer::CamProfile.name());
    let reading = reading::read(text.as_bytes(), JOIN)?;
    match reading.chains.as_slice() {
        [chain] if chain.closed && reading.duplicates.is_empty() && reading.points.is_empty() => Ok(chain.contour()),
        _ => Err(ProofError::NotOneOutline),
    }
}

/// What the file says of one thing that was drawn.
enum Told<'a> {
    Entity(&'a Entity),
    /// A part of an outline with splines, which is told curve by curve.
    Run(Run),
}

/// How a section of entities begins and ends in a cut file.
const ENTITIES: &str = "  0\nSECTION\n  2\nENTITIES\n";
const END_OF_SECTION: &str = "  0\nENDSEC\n";

/// The section of entities as it stands in the bytes of a cut file; none where there is not one alone.
fn section_of_entities(bytes: &[u8]) -> Option<&[u8]> {
    let text = str::from_utf8(bytes).ok()?;
    let (_, section) = text.split_at_checked(text.find(ENTITIES)?)?;
    let (section, rest) = section.split_at_checked(section.find(END_OF_SECTION)? + END_OF_SECTION.len())?;
    (!rest.contains(ENTITIES)).then_some(section.as_bytes())
}

/// Whether the dxf crate finds these entities in the bytes, in their order and on their layers, and no others.
fn holds(bytes: &[u8], drawn: &[(Layer, Entity)]) -> bool {
    // Of the rest of a file, which cuts nothing, the crate would make as much again.
    let Some(mut section) = section_of_entities(bytes) else { return false };
    let Ok(drawing) = ::dxf::Drawing::load(&mut section) else { return false };
    let told = drawn.iter().flat_map(|(layer, entity)| {
        let all = match entity {
            Entity::Polyline(contour) if contour.cubics() > 0 => runs(contour).into_iter().map(Told::Run).collect(),
            Entity::Polyline(_) | Entity::Circle(..) => vec![Told::Entity(entity)],
        };
        all.into_iter().map(|told| (*layer, told))
    });
    let mut found = drawing.entities();
    let mut told = told.collect::<Vec<_>>().into_iter();
    told.all(|(layer, told)| {
        found.next().is_some_and(|other| {
            let same = match &told {
                Told::Entity(entity) => same_entity(entity, &other.specific),
                Told::Run(run) => same_run(run, &other.specific),
            };
            other.common.layer == layer.name() && same
        })
    }) && found.next().is_none()
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= ROUNDING
}

fn at(point: Vector2<f64>, found: &::dxf::Point) -> bool {
    near(point.x, found.x) && near(point.y, found.y)
}

fn same_chain(contour: &Contour, closed: bool, found: &mut dyn Iterator<Item = [f64; 3]>) -> bool {
    let all = contour.vertices.iter().all(|v| {
        let bulge = v.bulge().unwrap_or(f64::NAN);
        found.next().is_some_and(|[x, y, b]| near(v.point.x, x) && near(v.point.y, y) && near(bulge, b))
    });
    all && closed && found.next().is_none()
}

fn same_entity(entity: &Entity, found: &EntityType) -> bool {
    match (entity, found) {
        (Entity::Polyline(contour), EntityType::LwPolyline(line)) => {
            same_chain(contour, line.is_closed(), &mut line.vertices.iter().map(|v| [v.x, v.y, v.bulge]))
        }
        (Entity::Polyline(contour), EntityType::Polyline(line)) => {
            let mut vertices = line.vertices().map(|v| [v.location.x, v.location.y, v.bulge]);
            same_chain(contour, line.is_closed(), &mut vertices)
        }
        (Entity::Circle(centre, radius), EntityType::Circle(circle)) => {
            at(*centre, &circle.center) && near(*radius, circle.radius)
        }
        _ => false,
    }
}

fn same_run(run: &Run, found: &EntityType) -> bool {
    match (run, found) {
        (Run::Segment(segment), EntityType::Line(line)) => at(segment.start, &line.p1) && at(segment.end, &line.p2),
        (Run::Segment(segment), EntityType::Arc(arc)) => {
            let (from, to) = segment.angles();
            let angles = near(from, arc.start_angle) && near(to, arc.end_angle);
            at(segment.centre(), &arc.center) && near(segment.radius().abs(), arc.radius) && angles
        }
        (Run::Spline(spline), EntityType::Spline(found)) => {
            found.degree_of_curve == 3
                && found.weight_values.is_empty()
                && spline.knots.len() == found.knot_values.len()
                && spline.controls.len() == found.control_points.len()
                && spline.knots.iter().zip(&found.knot_values).all(|(a, b)| near(*a, *b))
                && spline.controls.iter().zip(&found.control_points).all(|(a, b)| at(*a, b))
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::contour::Bend;

    /// A chain of the dxf crate is the one that was drawn when it has every vertex, no other, and is closed.
    #[test]
    fn a_chain_is_the_same_with_all_of_it() {
        let circle = Contour::circle(Vector2::new(3.0, 4.0), 50.0);
        let rows = |contour: &Contour| -> Vec<[f64; 3]> {
            contour.vertices.iter().map(|v| [v.point.x, v.point.y, v.bulge().expect("an arc")]).collect()
        };
        let all = rows(&circle);
        let same = |closed: bool, found: &[[f64; 3]]| same_chain(&circle, closed, &mut found.iter().copied());
        assert!(same(true, &all));
        assert!(!same(false, &all), "open");
        assert!(!same(true, &[&all[..], &all[..1]].concat()), "one more");
        assert!(!same(true, &all[1..]), "one less");
    }

    /// A path that runs out and back along the same line is two lines in one place, and no outline.
    #[test]
    fn a_path_that_covers_itself_is_no_outline() {
        let vertex = |x: f64| crate::geometry::contour::Vertex::new(Vector2::new(x, 0.0), 0.0);
        let there_and_back = Contour { vertices: vec![vertex(0.0), vertex(30.0)] };
        let found = cutter_path(&there_and_back, Version::R2000);
        assert_eq!(found, Err(ProofError::NotOneOutline));
        let circle = Contour::circle(Vector2::new(3.0, 4.0), 50.0);
        assert!(cutter_path(&circle, Version::R2000).is_ok_and(|found| found.vertices.len() == circle.vertices.len()));
    }

    #[test]
    fn the_second_reader_misses_nothing_and_finds_nothing_more() {
        let drawn = [
            (Layer::CamProfile, Entity::Polyline(Contour::circle(Vector2::new(3.0, 4.0), 50.0))),
            (Layer::Bore, Entity::Circle(Vector2::new(1.0, 2.0), 5.0)),
        ];
        for (name, version) in Version::ALL {
            let bytes = dxf::write(&drawn, version);
            assert!(holds(&bytes, &drawn), "{name}");
            let all = [section_of_entities(&bytes).expect("one"), &bytes].concat();
            assert!(!holds(&all, &drawn), "{name}: entities in two sections");
            let whole = ::dxf::Drawing::load(&mut &*bytes).expect("a drawing");
            assert_eq!(whole.entities().count(), drawn.len(), "{name}: none but in the section");
            assert!(!holds(&bytes, &drawn[..1]), "{name}: one more than drawn");
            let mut moved = drawn.clone();
            moved[1].1 = Entity::Circle(Vector2::new(1.0, 2.0 + 1e-10), 5.0);
            assert!(!holds(&bytes, &moved), "{name}: moved");
            moved[1] = (Layer::CutterPath, drawn[1].1.clone());
            assert!(!holds(&bytes, &moved), "{name}: another layer");
            let Entity::Polyline(mut chain) = drawn[0].1.clone() else { unreachable!("a polyline") };
            chain.vertices[0].bend = Bend::Arc(1.0 + 1e-9);
            assert!(!holds(&bytes, &[(Layer::CamProfile, Entity::Polyline(chain)), drawn[1].clone()]), "{name}: bent");
        }
    }
}

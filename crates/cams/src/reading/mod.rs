//! Reads a DXF file back into everything that would be cut from it, whether `write` or another program wrote it.
//!
//! Cut are LINE, ARC, CIRCLE, ELLIPSE, SPLINE, LWPOLYLINE and POLYLINE in model space, including those of inserted blocks, on
//! layers that are on. Those of layer `CAM_PROFILE` are the outline, the others are separate; both are joined end to end.
//! What does not fit is kept and reported, not repaired. Texts, dimensions, points and the like are information. Arcs, lines and
//! polynomial splines up to degree 3 are read exactly, other curves as tangent arcs within a share of the reach.

mod contents;
mod curve;
mod groups;
mod join;
mod limits;
pub mod outline;
mod placement;
mod record;
mod shape;
mod shown;
mod spline;
pub mod step;
mod walk;

pub use join::Chain;
pub use limits::{LARGEST_FILE, MOST_SEGMENTS};

use camgen_kernel::geometry::contour::Edge;
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::refusal::Refusal;
use contents::DxfContents;
use join::JoinedChains;
use nalgebra::Vector2;
use walk::EntityWalk;

/// Layer of the outline.
pub const OUTLINE_LAYER: &str = "CAM_PROFILE";

/// Layer of the holes in files of camgen: what is on it is no outline.
const BORE_LAYER: &str = "BORE";

/// Largest distance of arcs from the curves they replace, over the reach of [`read`].
const CURVE_SHARE: f64 = 0.05;

/// What [`FileUnit::Other`] calls inches.
pub const INCHES: &str = "inches";
/// What [`FileUnit::Other`] calls several units that contradict each other.
pub(crate) const MANY_UNITS: &str = "more than one unit";
/// What [`FileUnit::Other`] calls a unit whose millimetres are not known.
pub(crate) const UNKNOWN_UNIT: &str = "an unknown unit";

/// The unit a file states.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileUnit {
    /// `$INSUNITS` = 4.
    Millimetres,
    /// `$INSUNITS` = 0 or absent.
    Unstated,
    /// The same, with `$MEASUREMENT` = 0, which stands for inches.
    UnstatedEnglish,
    /// Anything else.
    Other(&'static str),
}

/// The kind of an entity, and the layer on which it is cut.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct EntitySource {
    /// As in the file: `LINE`.
    pub kind: String,
    /// Its layer; for an entity on layer 0 of a block, the layer of the insertion.
    pub layer: String,
}

impl EntitySource {
    /// Whether it is on a layer, whose name is the same in capitals.
    #[must_use]
    pub fn on_layer(&self, layer: &str) -> bool {
        self.layer.eq_ignore_ascii_case(layer)
    }

    /// Whether it is on the layer of the holes.
    fn on_bore(&self) -> bool {
        self.on_layer(BORE_LAYER)
    }
}

/// `LINE on layer 0`.
impl std::fmt::Display for EntitySource {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{} on layer {}", self.kind, self.layer)
    }
}

/// An entity with a problem, or with something to report.
#[derive(Debug, Clone, PartialEq)]
pub struct StrayEntity {
    /// As in the file: `REGION`.
    pub kind: String,
    /// The problem, in words that follow its name; empty where there is no problem.
    pub why: String,
    /// Its layer.
    pub layer: String,
    /// Its place, mm.
    pub place: Vector2<f64>,
}

/// `REGION on layer 0 at (1.000, 2.000) mm is …`.
impl std::fmt::Display for StrayEntity {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { kind, why, layer, place } = self;
        write!(formatter, "{kind} on layer {layer} at ({:.3}, {:.3}) mm", place.x, place.y)?;
        if why.is_empty() { Ok(()) } else { write!(formatter, " {why}") }
    }
}

/// Where the outline of a file was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum OutlinePlace {
    /// On the layer of this name.
    Layer(String),
    /// It is the only closed contour of the file, which has nothing on the layer of the outline.
    OnlyContour,
    /// It is the outermost closed contour on the layer of this name, on which there is more.
    OutermostOn(String),
    /// It is the outermost of several closed contours of the file, which has nothing on the layer of the outline: the layers it is on.
    Outermost(String),
    /// On other layers than that of the outline, on which there is something else.
    Elsewhere(String),
    /// On layers that are off or frozen, so that it would not be cut.
    Hidden(String),
}

/// Whether entities are read that are not visible.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Hidden {
    /// They are not cut.
    Skipped,
    /// As if every layer were on.
    Shown,
}

/// The result of reading a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// The unit that it states; lengths are converted to millimetres from it.
    pub unit: FileUnit,
    /// Where its outline was found.
    pub outline: OutlinePlace,
    /// The chains on the layer of the outline, joined; a cam has exactly one, closed.
    pub chains: Vec<Chain>,
    /// The chains on all other layers, joined: bore, holes, and everything else that would be cut.
    pub others: Vec<Chain>,
    /// Middles of segments that lie on another one, mm.
    pub duplicates: Vec<Vector2<f64>>,
    /// Largest distance of such a segment from the one on which it lies, mm; infinite where an entity runs over a part of itself again.
    pub duplicates_apart: f64,
    /// Places of segments without length, mm.
    pub points: Vec<Vector2<f64>>,
    /// Entities that would or might be cut, and are not curves without width in the plane of the drawing.
    pub unreadable: Vec<StrayEntity>,
    /// Entities on the layer of the outline that are not cut.
    pub information: Vec<StrayEntity>,
    /// Other remarks, a sentence each.
    pub remarks: Vec<String>,
    /// Names of the layers with visible entities.
    pub layers: Vec<String>,
    /// Names of the layers with hidden entities.
    pub hidden: Vec<String>,
    /// Number of curves that are read as arcs: ellipses, and splines that are rational or of a degree above 3.
    pub splines: usize,
    /// Millimetres in the unit of the file.
    pub unit_mm: f64,
}

impl Reading {
    /// What is cut on other layers than its own and these.
    #[must_use]
    pub fn beside(&self, layers: &[&str]) -> Vec<Chain> {
        let on_one = |chain: &&Chain| layers.iter().any(|layer| chain.on_layer(layer));
        self.others.iter().filter(|chain| !on_one(chain)).cloned().collect()
    }

    /// Takes one of the other chains for the outline; the chains on its layer go to the others.
    #[must_use]
    pub fn with_outline(mut self, other: usize, found_at: OutlinePlace) -> Self {
        let own = self.others.remove(other);
        self.others.extend(std::mem::replace(&mut self.chains, vec![own]));
        self.outline = found_at;
        self
    }

    /// Keeps one of the chains on the layer of the outline; the rest goes to the others.
    fn keep_chain(&mut self, index: usize) {
        if let OutlinePlace::Layer(name) = &self.outline {
            self.outline = OutlinePlace::OutermostOn(name.clone());
        }
        let own = self.chains.swap_remove(index);
        self.others.extend(std::mem::replace(&mut self.chains, vec![own]));
    }

    /// Takes the outermost closed contour of a file without the layer of the outline.
    fn take_outermost_of_others(&mut self) {
        let closed = self.others.iter().filter(|chain| chain.closed).count();
        let Some(index) = outermost(&self.others) else { return };
        let Some(chain) = self.others.get(index).filter(|chain| !chain.touches_bore()) else { return };
        let layers = chain.layers();
        self.outline = if closed > 1 { OutlinePlace::Outermost(layers) } else { OutlinePlace::OnlyContour };
        let own = self.others.remove(index);
        self.chains = vec![own];
    }
}

/// That a file is not DXF, with the cause.
fn not_dxf(why: impl std::fmt::Display) -> Refusal {
    Refusal::new(format!("not a DXF file: {why}"))
}

/// That a file does not end as a DXF file ends.
fn cut_short() -> Refusal {
    Refusal::new("not a complete DXF file: it does not end with EOF")
}

/// That a file has more of something than is read.
fn too_much(what: &str, most: usize) -> Refusal {
    Refusal::new(format!("too large for a cam: the file has more than {most} {what}, the most that camgen reads"))
        .remedy("keep only what is cut of the part")
}

/// That a number of a file is not finite.
fn not_finite() -> Refusal {
    Refusal::new("not a drawing of a cam: an entity has a number that is not finite, or too large for a drawing")
}

/// Most names in one sentence.
const MOST_NAMED: usize = 20;

/// The first of some names, as a list.
pub(crate) fn few(names: &[String]) -> String {
    let shown_names = names.iter().take(MOST_NAMED).cloned().collect::<Vec<_>>().join(", ");
    let more = names.len().saturating_sub(MOST_NAMED);
    if more > 0 { format!("{shown_names} and {more} more") } else { shown_names }
}

/// Reads a DXF file, with the outline on layer `CAM_PROFILE`; ends nearer than `join` (mm) count as one, and arcs keep to curves within a
/// twentieth of it.
///
/// ```
/// # use camgen_cams as camgen;
/// use camgen::{Spec, reading};
///
/// # let motion = camgen::motion::EccentricCircle::new(0.005, 0.040);
/// let cam = Spec::builder("eccentric").roller(0.010).base_radius(0.030).bore_radius(0.008).motion(motion)?.solve()?;
/// let dxf = cam.draw(5e-6)?.prove()?.cut_files()[0].clone();
/// let found = reading::read(&dxf, 0.01)?;
/// assert!(found.chains.len() == 1 && found.chains[0].closed && found.others.len() == 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Refusal`] when the bytes are not a DXF file, or hold more than is read.
pub fn read(bytes: &[u8], join: f64) -> Result<Reading, Refusal> {
    read_with_outline(bytes, join, None)
}

/// As [`read`], with the outline on the layer of a name. Without a name it is on layer `CAM_PROFILE`, or, where nothing is cut on that
/// layer, it is the only closed contour of the file, unless that is on layer `BORE`.
///
/// # Errors
/// As [`read`].
pub fn read_with_outline(bytes: &[u8], join: f64, layer: Option<&str>) -> Result<Reading, Refusal> {
    let mut reading = read_all(bytes, join, layer, Hidden::Skipped)?;
    let mut closed = reading.others.iter().filter(|chain| chain.closed);
    let only = closed.next().filter(|_| closed.next().is_none());
    if layer.is_none() && reading.chains.is_empty() && only.is_some_and(|chain| !chain.touches_bore()) {
        (reading.chains, reading.others) = reading.others.into_iter().partition(|chain| chain.closed);
        reading.outline = OutlinePlace::OnlyContour;
    }
    reading.chains.iter().try_for_each(Chain::check_length)?;
    if layer.is_some()
        && let Some(outermost) = around_all(&reading.chains)
    {
        reading.keep_chain(outermost);
    }
    Ok(reading)
}

/// As [`read`], with the outermost closed contour as the outline: of the layer of a name; without a name of layer `CAM_PROFILE`, or,
/// where nothing is cut on that layer, of the whole file. A contour on layer `BORE` is never the outline of a whole file. Other contours
/// of the layer go to the others, wherever they lie. Where an open curve is larger than every closed one, nothing is chosen.
///
/// # Errors
/// As [`read`].
pub fn read_outermost(bytes: &[u8], join: f64, layer: Option<&str>) -> Result<Reading, Refusal> {
    let mut reading = read_all(bytes, join, layer, Hidden::Skipped)?;
    if layer.is_none() && reading.chains.is_empty() {
        reading.take_outermost_of_others();
    } else if reading.chains.len() > 1
        && let Some(outermost) = outermost(&reading.chains)
    {
        reading.keep_chain(outermost);
    }
    reading.chains.iter().try_for_each(Chain::check_length)?;
    Ok(reading)
}

/// As [`read_outermost`], as if every layer of the file were on; `None` where nothing is hidden.
///
/// # Errors
/// As [`read`].
pub fn read_hidden(bytes: &[u8], join: f64, layer: Option<&str>) -> Result<Option<Reading>, Refusal> {
    let mut reading = read_all(bytes, join, layer, Hidden::Shown)?;
    if reading.hidden.is_empty() {
        return Ok(None);
    }
    if reading.chains.is_empty() {
        reading.take_outermost_of_others();
    } else if let Some(outermost) = outermost(&reading.chains).filter(|_| reading.chains.len() > 1) {
        reading.keep_chain(outermost);
    }
    reading.chains.iter().try_for_each(Chain::check_length)?;
    Ok(Some(reading))
}

/// Everything that is cut, with the chains on the layer of the outline apart from the others.
fn read_all(bytes: &[u8], join: f64, layer: Option<&str>, hidden: Hidden) -> Result<Reading, Refusal> {
    let kept = groups::kept(bytes)?;
    let contents = DxfContents::of(&kept)?;
    let name = layer.unwrap_or(OUTLINE_LAYER);
    let mut walk = EntityWalk::over(&contents, name, CURVE_SHARE * join, hidden)?;
    let height = walk.heights(join);
    if height.abs() > join {
        walk.remarks.push(format!("everything lies at a height of {height} mm"));
    }
    let JoinedChains { outline, others, duplicates, duplicates_apart, points } =
        join::join(walk.cuts, (&walk.sources, name), join, &mut walk.effort)?;
    Ok(Reading {
        unit: contents.unit,
        outline: OutlinePlace::Layer(name.to_owned()),
        chains: outline,
        others,
        duplicates,
        duplicates_apart,
        points,
        unreadable: walk.unreadable,
        information: walk.information,
        remarks: walk.remarks,
        layers: walk.layers.into_iter().collect(),
        hidden: walk.hidden.into_iter().collect(),
        splines: walk.curves,
        unit_mm: contents.scale,
    })
}

/// The index of the closed chain that is larger than all others; `None` where there is none, or an open one is larger.
fn outermost(chains: &[Chain]) -> Option<usize> {
    let size = |chain: &Chain| chain.contour().extents().size().norm();
    let area = |chain: &Chain| chain.contour().area_and_centroid().0.abs();
    let closed = chains.iter().enumerate().filter(|(_, chain)| chain.closed);
    let (index, largest) = closed.max_by(|a, b| area(a.1).total_cmp(&area(b.1)))?;
    let most = size(largest);
    chains.iter().filter(|chain| !chain.closed).all(|open| size(open) <= most).then_some(index)
}

/// The one of several closed chains that lies around all others, by its index.
fn around_all(chains: &[Chain]) -> Option<usize> {
    if chains.len() < 2 || chains.iter().any(|chain| !chain.closed) {
        return None;
    }
    let area = |chain: &Chain| chain.contour().area_and_centroid().0.abs();
    let (index, largest) = chains.iter().enumerate().max_by(|a, b| area(a.1).total_cmp(&area(b.1)))?;
    let contour = largest.counter_clockwise();
    let tree = EdgeTree::new(&contour);
    let within = |edge: &Edge| {
        [0.0, 0.5]
            .into_iter()
            .all(|share| tree.nearest(edge.point_and_tangent(share).0).is_some_and(|nearest| nearest.left > 0.0))
    };
    let mut rest = chains.iter().enumerate().filter(|(other, _)| *other != index);
    rest.all(|(_, chain)| chain.edges.iter().all(within)).then_some(index)
}

#[cfg(test)]
mod tests {
    use super::*;
    use dxf::entities::{Entity, EntityType};
    use dxf::enums::Units;

    fn drawing(entities: Vec<(&str, EntityType)>, unit: Units) -> Vec<u8> {
        let mut drawing = dxf::Drawing::new();
        drawing.header.version = dxf::enums::AcadVersion::R2000;
        drawing.header.default_drawing_units = unit;
        for (layer, specific) in entities {
            let mut entity = Entity::new(specific);
            entity.common.layer = layer.into();
            drawing.add_entity(entity);
        }
        let mut bytes = Vec::new();
        drawing.save(&mut bytes).expect("saved");
        bytes
    }

    fn point(x: f64, y: f64) -> dxf::Point {
        dxf::Point::new(x, y, 0.0)
    }

    fn slot() -> Vec<(&'static str, EntityType)> {
        let line = |a, b| ("CAM_PROFILE", EntityType::Line(dxf::entities::Line::new(a, b)));
        let arc =
            |x, from, to| ("CAM_PROFILE", EntityType::Arc(dxf::entities::Arc::new(point(x, 0.0), 10.0, from, to)));
        vec![
            line(point(0.0, -10.0), point(40.0, -10.0)),
            // Out of order, and one of them reversed.
            line(point(40.0, 10.0), point(0.0, 10.0)),
            arc(40.0, 270.0, 90.0),
            arc(0.0, 90.0, 270.0),
        ]
    }

    #[test]
    fn a_heap_of_lines_and_arcs_becomes_one_closed_chain() {
        let reading = read(&drawing(slot(), Units::Millimeters), 1e-6).expect("read");
        assert_eq!((reading.unit, reading.chains.len()), (FileUnit::Millimetres, 1));
        let chain = &reading.chains[0];
        assert!(chain.closed && chain.edges.len() == 4);
        let (area, _) = chain.contour().area_and_centroid();
        assert!((area.abs() - (800.0 + 100.0 * std::f64::consts::PI)).abs() < 1e-9, "{area}");
        assert!(reading.duplicates.is_empty() && reading.unreadable.is_empty());
    }

    #[test]
    fn what_is_wrong_is_kept_and_reported() {
        let mut twice = slot();
        twice.push(slot().remove(2));
        let reading = read(&drawing(twice, Units::Inches), 1e-6).expect("read");
        assert_eq!(reading.unit, FileUnit::Other("inches"));
        assert_eq!((reading.duplicates.len(), reading.chains.len()), (1, 1));
        assert!((reading.duplicates[0] - Vector2::new(25.4 * 50.0, 0.0)).norm() < 1e-9, "in millimetres");

        let mut open = slot();
        open.remove(0);
        let reading = read(&drawing(open, Units::Unitless), 1e-6).expect("read");
        assert_eq!(
            (reading.unit, reading.chains.len(), reading.chains[0].closed),
            (FileUnit::UnstatedEnglish, 1, false)
        );

        let mut two = slot();
        two.push(("CAM_PROFILE", EntityType::Circle(dxf::entities::Circle::new(point(20.0, 0.0), 3.0))));
        two.push(("CAM_PROFILE", EntityType::Text(dxf::entities::Text::default())));
        two.push(("BORE", EntityType::Circle(dxf::entities::Circle::new(point(20.0, 0.0), 3.0))));
        let reading = read(&drawing(two, Units::Millimeters), 1e-6).expect("read");
        assert_eq!((reading.chains.len(), reading.unreadable.len(), reading.duplicates.len()), (2, 0, 2));
        assert_eq!(reading.information[0].kind, "TEXT");
        assert_eq!(reading.layers, ["BORE", "CAM_PROFILE"]);
    }

    /// Programs that save everything on one layer.
    #[test]
    fn holes_on_the_layer_that_is_named_for_the_outline_are_holes() {
        let circle = |x: f64, radius: f64| EntityType::Circle(dxf::entities::Circle::new(point(x, 0.0), radius));
        let chains = |x: f64, radius: f64, layer: Option<&str>| {
            let mut all: Vec<_> = slot().into_iter().map(|(_, entity)| ("0", entity)).collect();
            all.push(("0", circle(x, radius)));
            let reading = read_with_outline(&drawing(all, Units::Millimeters), 1e-6, layer).expect("read");
            (reading.chains.len(), reading.others.len())
        };
        assert_eq!(chains(20.0, 3.0, Some("0")), (1, 1));
        // It crosses the outline, or lies outside.
        assert_eq!(chains(20.0, 15.0, Some("0")), (2, 0));
        assert_eq!(chains(90.0, 3.0, Some("0")), (2, 0));
        assert_eq!(chains(20.0, 3.0, None), (0, 2));
    }

    #[test]
    fn a_spline_is_read_as_arcs() {
        let mut spline = dxf::entities::Spline { degree_of_curve: 2, ..Default::default() };
        // A circle as a rational spline of second degree.
        let w = std::f64::consts::FRAC_1_SQRT_2;
        for (i, (x, y)) in
            [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)].into_iter().enumerate()
        {
            spline.control_points.push(point(50.0 * f64::from(x), 50.0 * f64::from(y)));
            spline.weight_values.push(if i % 2 == 0 { 1.0 } else { w });
        }
        spline.knot_values = vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0];
        let bytes = drawing(vec![("CAM_PROFILE", EntityType::Spline(spline))], Units::Millimeters);
        let reading = read(&bytes, 1e-6).expect("read");
        assert_eq!((reading.splines, reading.chains.len()), (1, 1));
        let contour = reading.chains[0].contour();
        assert!(reading.chains[0].closed);
        assert!((contour.area_and_centroid().0 - 2500.0 * std::f64::consts::PI).abs() < 1e-2);
        assert!(contour.tangent_breaks().iter().all(|turn| turn.abs().to_degrees() < 0.05));
    }

    /// Points so far apart that their distance is not a number, and a weight that exceeds every point.
    #[test]
    fn a_spline_beyond_every_number_is_refused() {
        let spline = |far: f64, weight: f64| {
            let control_points = vec![point(0.0, 0.0), point(far, -far), point(-far, far)];
            let knot_values = vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
            let weight_values = vec![1.0, weight, 1.0];
            dxf::entities::Spline {
                degree_of_curve: 2,
                control_points,
                knot_values,
                weight_values,
                ..Default::default()
            }
        };
        let read = |spline| read(&drawing(vec![("CAM_PROFILE", EntityType::Spline(spline))], Units::Millimeters), 1e-6);
        for (far, weight) in [(1e300, 1.0), (f64::NAN, 1.0), (1.0, 1e300), (1.0, f64::NAN)] {
            assert_eq!(read(spline(far, weight)), Err(not_finite()), "{far} {weight}");
        }
        for (far, weight) in [(1.0, -1.0), (1.0, 0.0)] {
            let reading = read(spline(far, weight)).expect("numbers");
            assert!(reading.unreadable[0].why.contains("weights"), "{reading:?}");
        }
        let _ = read(spline(1e15, 1e-300)).expect("numbers");
    }

    fn is_not_dxf(read: Result<Reading, Refusal>) -> bool {
        read.is_err_and(|error| error.what.starts_with("not a DXF file: "))
    }

    /// The groups of a file as text, entities between head and end.
    fn of_entities(entities: &str) -> Vec<u8> {
        format!("0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n").into_bytes()
    }

    /// Other readers leave out what stands behind the mark of another class, and end the header where an entity begins in it.
    #[test]
    fn what_other_readers_leave_out_is_not_read() {
        let square = |mark: &str| {
            let corner = |x: i32, y: i32| format!("10\n{x}\n20\n{y}\n");
            let first = corner(0, 0) + &corner(9, 0);
            let entity = format!(
                "0\nLWPOLYLINE\n8\nCAM_PROFILE\n100\nAcDbEntity\n100\nAcDbPolyline\n90\n4\n70\n1\n{first}{mark}"
            );
            of_entities(&(entity + &corner(9, 9) + &corner(0, 9)))
        };
        assert_eq!(read(&square(""), 1e-6).expect("read").chains.len(), 1);
        let reading = read(&square("100\nAcDbSymbolTable\n"), 1e-6).expect("read");
        assert!(
            reading.chains.is_empty() && reading.unreadable[0].why.contains("another class, AcDbSymbolTable,"),
            "{:?}",
            reading.unreadable
        );
        let unit = |before: &str| {
            let header = format!("0\nSECTION\n2\nHEADER\n{before}9\n$INSUNITS\n70\n1\n0\nENDSEC\n").into_bytes();
            read(&[header, square("")].concat(), 1e-6).expect("read").unit
        };
        assert_eq!((unit(""), unit("0\nTABLE\n")), (FileUnit::Other("inches"), FileUnit::Unstated));
    }

    #[test]
    fn more_than_a_cam_is_refused_with_the_limit() {
        let line = |i: usize| format!("0\nLINE\n8\n0\n10\n{i}\n20\n0\n11\n{i}\n21\n1\n");
        let lines = |count: usize| of_entities(&(0..count).map(line).collect::<String>());
        assert!(read(&lines(MOST_SEGMENTS), 1e-6).is_ok());
        let too_much = |bytes: &[u8], what: &str| {
            let error = read(bytes, 1e-6).expect_err(what).what;
            assert!(error.starts_with("too large for a cam: ") && error.contains(what), "{error}");
        };
        too_much(&lines(MOST_SEGMENTS + 1), "more than 200000 segments");
        let vertices = "10\n1\n20\n2\n".repeat(MOST_SEGMENTS + 1);
        too_much(&of_entities(&format!("0\nLWPOLYLINE\n{vertices}")), "more than 200000 segments");
        let text = "0\nTEXT\n".repeat(1_000_001);
        too_much(&of_entities(&text), "more than 1000000 entities");
        too_much(&of_entities(&"40\n1\n".repeat(4_000_001)), "more than 4000000 values");
        let short = |i: u32| {
            let at = |share: f64| 1e-4 * (f64::from(i) * share).fract();
            let [a, b, c, d] = [0.618_034, 0.754_878, 0.549_700, 0.856_675].map(at);
            format!("0\nLINE\n10\n{a:e}\n20\n{b:e}\n11\n{c:e}\n21\n{d:e}\n")
        };
        let cloud = of_entities(&(0..20_000).map(short).collect::<String>());
        let error = read(&cloud, 1e-3).expect_err("a cloud").what;
        assert!(error.starts_with("too large for a cam: "), "{error}");
    }

    #[test]
    fn a_tangle_is_no_outline() {
        let vertices = |i: u32| format!("10\n{}\n20\n{}\n", i % 2 * 100, f64::from(i) * 1e-3);
        let tangle = |layer: &str| {
            let vertices: String = (0..20_000).map(vertices).collect();
            of_entities(&format!("0\nLWPOLYLINE\n8\n{layer}\n70\n1\n{vertices}"))
        };
        // Without its layer the only closed contour is taken for the outline.
        for layer in [OUTLINE_LAYER, "HATCHING"] {
            let error = read(&tangle(layer), 1e-6).expect_err("a tangle").what;
            assert!(error.starts_with("not the outline of a cam: its 20000 segments are"), "{error}");
        }
    }

    #[test]
    fn names_are_shown_without_terminal_controls() {
        let bytes = of_entities("0\nREGION\n8\nA\u{1b}[31m\u{202e}\u{9b}B\n");
        let shown_names = read(&bytes, 1e-6).expect("read").unreadable[0].to_string();
        assert!(shown_names.starts_with("REGION on layer A\\u001b[31m\\u202e\\u009bB at"), "{shown_names}");
        let long = of_entities(&format!("0\nLINE\n8\n{}\n", "x".repeat(3000)));
        assert!(is_not_dxf(read(&long, 1e-6)));
    }

    #[test]
    fn what_is_not_dxf_is_refused_without_a_panic() {
        let whole = drawing(slot(), Units::Millimeters);
        assert_eq!(read(b"", 1e-6), Err(cut_short()));
        assert_eq!(read(b"hello", 1e-6), Err(cut_short()));
        assert!(is_not_dxf(read(b"hello\nEOF", 1e-6)));
        assert_eq!(read(&[0xff; 64], 1e-6), Err(cut_short()));
        for cut in (0..whole.len()).step_by(whole.len() / 97) {
            let mut bytes = whole[..cut].to_vec();
            bytes.extend_from_slice(b"\n  0\nEOF\n");
            // Either there is an error, or the rest is read; it never panics.
            let _ = read(&bytes, 1e-6);
        }
    }
}

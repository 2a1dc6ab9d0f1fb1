//! Reads a DXF file back into all that would be cut of it: what `write` wrote, or what another program made of it.
//!
//! Cut are LINE, ARC, CIRCLE, ELLIPSE, SPLINE, LWPOLYLINE and POLYLINE in model space, those of inserted blocks among them, on
//! layers that are on. Those of layer `CAM_PROFILE` are the outline, the others lie beside it; either are joined end to end.
//! What does not fit is kept and reported, not repaired. Texts, dimensions, points and the like are information. Arcs, lines and
//! polynomial splines up to degree 3 are read exactly, other curves as tangent arcs within a share of the reach.

mod contents;
mod curve;
mod groups;
mod join;
mod limits;
mod placement;
mod record;
mod shape;
mod spline;
pub mod step;
mod walk;

pub use join::Chain;
pub use limits::{LARGEST_FILE, MOST_SEGMENTS};

use contents::Contents;
use join::Joined;
use nalgebra::Vector2;
use walk::Walk;

/// Layer of the outline.
pub const OUTLINE_LAYER: &str = "CAM_PROFILE";

/// How near arcs keep to the curves they are read from, over the reach of [`read`].
const CURVE_SHARE: f64 = 0.05;

/// The unit a file states.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// `$INSUNITS` = 4.
    Millimetres,
    /// `$INSUNITS` = 0 or absent.
    Untold,
    /// Anything else.
    Other(&'static str),
}

/// Of what kind an entity is, and on which layer it is cut.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Source {
    /// As the file calls it: `LINE`.
    pub kind: String,
    /// The layer, that of the insertion for what a block has on layer 0.
    pub layer: String,
}

impl Source {
    /// Whether it belongs to the outline.
    #[must_use]
    pub fn on_outline(&self) -> bool {
        self.layer.eq_ignore_ascii_case(OUTLINE_LAYER)
    }
}

/// `LINE on layer 0`.
impl std::fmt::Display for Source {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{} on layer {}", self.kind, self.layer)
    }
}

/// An entity that is not what it should be.
#[derive(Debug, Clone, PartialEq)]
pub struct Stray {
    /// As the file calls it: `REGION`.
    pub kind: String,
    /// What is wrong, in words that follow its name; empty where nothing is.
    pub why: String,
    /// Its layer.
    pub layer: String,
    /// Where it lies, mm.
    pub place: Vector2<f64>,
}

/// `REGION on layer 0 at (1.000, 2.000) mm is …`.
impl std::fmt::Display for Stray {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { kind, why, layer, place } = self;
        write!(formatter, "{kind} on layer {layer} at ({:.3}, {:.3}) mm", place.x, place.y)?;
        if why.is_empty() { Ok(()) } else { write!(formatter, " {why}") }
    }
}

/// What was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// The unit it is in.
    pub unit: Unit,
    /// The chains on the layer of the outline, joined; one closed one is what it should be.
    pub chains: Vec<Chain>,
    /// The chains on all other layers, joined: bore, holes, and whatever else would be cut.
    pub beside: Vec<Chain>,
    /// Middles of segments that lie on another one, mm.
    pub duplicates: Vec<Vector2<f64>>,
    /// Places of segments without length, mm.
    pub points: Vec<Vector2<f64>>,
    /// Entities that would be cut, or may be, and are not lines of no width in the plane of the drawing.
    pub unreadable: Vec<Stray>,
    /// Entities on the layer of the outline that cut nothing.
    pub information: Vec<Stray>,
    /// What else a reader should know, a sentence each.
    pub remarks: Vec<String>,
    /// Names of the layers on which something is seen.
    pub layers: Vec<String>,
    /// Names of the layers on which something is not seen.
    pub hidden: Vec<String>,
    /// Number of curves that are read as arcs: ellipses, and splines that are rational or of a degree above 3.
    pub splines: usize,
}

/// Why a file cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// It does not end as a DXF file ends.
    #[error("not a whole DXF file: it does not end with EOF")]
    CutShort,
    /// It is not DXF.
    #[error("not a DXF file: {0}")]
    NotDxf(String),
    /// It holds more than is read.
    #[error("more than a cam: it has over {most} {what}, and camgen reads no more; keep only what is cut of the part")]
    TooMuch {
        /// Of what.
        what: &'static str,
        /// The limit.
        most: usize,
    },
    /// The outline is far longer than one that goes round once.
    #[error(
        "no outline of a cam: {segments} segments on layer CAM_PROFILE are a tangle, {times} times as long as it is wide; an \
         outline goes round once"
    )]
    Tangle {
        /// Number of its segments.
        segments: usize,
        /// Their length over the diagonal of the rectangle about them.
        times: u64,
    },
    /// It holds a number that is not finite.
    #[error("an entity holds a number that is not finite, or beyond every drawing")]
    NotFinite,
}

/// Names that are told in one sentence.
const MOST_NAMED: usize = 20;

/// The first of some names, in a row.
pub(crate) fn few(names: &[String]) -> String {
    let told = names.iter().take(MOST_NAMED).cloned().collect::<Vec<_>>().join(", ");
    let more = names.len().saturating_sub(MOST_NAMED);
    if more > 0 { format!("{told} and {more} more") } else { told }
}

/// Reads a DXF file; ends nearer than `join` (mm) are one, and arcs keep to curves within a twentieth of it.
///
/// # Errors
/// [`ReadError`] when the bytes are not a DXF file, or hold more than is read.
pub fn read(bytes: &[u8], join: f64) -> Result<Reading, ReadError> {
    let kept = groups::kept(bytes)?;
    let contents = Contents::of(&kept)?;
    let mut walk = Walk::over(&contents, CURVE_SHARE * join)?;
    let height = walk.heights(join);
    if height.abs() > join {
        walk.remarks.push(format!("everything lies at a height of {height} mm"));
    }
    let Joined { outline, beside, duplicates, points } = join::join(walk.cuts, &walk.sources, join, &mut walk.effort)?;
    outline.iter().try_for_each(Chain::is_no_tangle)?;
    Ok(Reading {
        unit: contents.unit,
        chains: outline,
        beside,
        duplicates,
        points,
        unreadable: walk.unreadable,
        information: walk.information,
        remarks: walk.remarks,
        layers: walk.layers.into_iter().collect(),
        hidden: walk.hidden.into_iter().collect(),
        splines: walk.curves,
    })
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
            // Out of order and one of them the wrong way round.
            line(point(40.0, 10.0), point(0.0, 10.0)),
            arc(40.0, 270.0, 90.0),
            arc(0.0, 90.0, 270.0),
        ]
    }

    #[test]
    fn a_heap_of_lines_and_arcs_becomes_one_closed_chain() {
        let reading = read(&drawing(slot(), Units::Millimeters), 1e-6).expect("read");
        assert_eq!((reading.unit, reading.chains.len()), (Unit::Millimetres, 1));
        let chain = &reading.chains[0];
        assert!(chain.closed && chain.edges.len() == 4);
        let (area, _) = chain.contour().area_and_centroid();
        assert!((area.abs() - (800.0 + 100.0 * std::f64::consts::PI)).abs() < 1e-9, "{area}");
        assert!(reading.duplicates.is_empty() && reading.unreadable.is_empty());
    }

    #[test]
    fn what_is_wrong_is_kept_and_told() {
        let mut twice = slot();
        twice.push(slot().remove(2));
        let reading = read(&drawing(twice, Units::Inches), 1e-6).expect("read");
        assert_eq!(reading.unit, Unit::Other("inches"));
        assert_eq!((reading.duplicates.len(), reading.chains.len()), (1, 1));
        assert!((reading.duplicates[0] - Vector2::new(50.0, 0.0)).norm() < 1e-9);

        let mut open = slot();
        open.remove(0);
        let reading = read(&drawing(open, Units::Unitless), 1e-6).expect("read");
        assert_eq!((reading.unit, reading.chains.len(), reading.chains[0].closed), (Unit::Untold, 1, false));

        let mut two = slot();
        two.push(("CAM_PROFILE", EntityType::Circle(dxf::entities::Circle::new(point(20.0, 0.0), 3.0))));
        two.push(("CAM_PROFILE", EntityType::Text(dxf::entities::Text::default())));
        two.push(("BORE", EntityType::Circle(dxf::entities::Circle::new(point(20.0, 0.0), 3.0))));
        let reading = read(&drawing(two, Units::Millimeters), 1e-6).expect("read");
        assert_eq!((reading.chains.len(), reading.unreadable.len(), reading.duplicates.len()), (2, 0, 2));
        assert_eq!(reading.information[0].kind, "TEXT");
        assert_eq!(reading.layers, ["BORE", "CAM_PROFILE"]);
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

    /// Points so far apart that their distance is no number, and a weight that outgrows every point.
    #[test]
    fn a_spline_beyond_every_number_is_told() {
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
            assert_eq!(read(spline(far, weight)), Err(ReadError::NotFinite), "{far} {weight}");
        }
        for (far, weight) in [(1.0, -1.0), (1.0, 0.0)] {
            let reading = read(spline(far, weight)).expect("numbers");
            assert!(reading.unreadable[0].why.contains("weights"), "{reading:?}");
        }
        let _ = read(spline(1e15, 1e-300)).expect("numbers");
    }

    /// The groups of a file as text, entities between head and end.
    fn of_entities(entities: &str) -> Vec<u8> {
        format!("0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n").into_bytes()
    }

    #[test]
    fn more_than_a_cam_is_told_with_the_limit() {
        let line = |i: usize| format!("0\nLINE\n8\n0\n10\n{i}\n20\n0\n11\n{i}\n21\n1\n");
        let lines = |count: usize| of_entities(&(0..count).map(line).collect::<String>());
        assert!(read(&lines(MOST_SEGMENTS), 1e-6).is_ok());
        let too_much = |bytes: &[u8], what: &str| match read(bytes, 1e-6) {
            Err(error @ ReadError::TooMuch { .. }) => assert!(error.to_string().contains(what), "{error}"),
            other => panic!("{what}: {other:?}"),
        };
        too_much(&lines(MOST_SEGMENTS + 1), "over 200000 segments");
        let vertices = "10\n1\n20\n2\n".repeat(MOST_SEGMENTS + 1);
        too_much(&of_entities(&format!("0\nLWPOLYLINE\n{vertices}")), "over 200000 segments");
        let text = "0\nTEXT\n".repeat(1_000_001);
        too_much(&of_entities(&text), "over 1000000 entities");
        too_much(&of_entities(&"40\n1\n".repeat(4_000_001)), "over 4000000 values");
        let short = |i: u32| {
            let at = |share: f64| 1e-4 * (f64::from(i) * share).fract();
            let [a, b, c, d] = [0.618_034, 0.754_878, 0.549_700, 0.856_675].map(at);
            format!("0\nLINE\n10\n{a:e}\n20\n{b:e}\n11\n{c:e}\n21\n{d:e}\n")
        };
        let cloud = of_entities(&(0..20_000).map(short).collect::<String>());
        assert!(matches!(read(&cloud, 1e-3), Err(ReadError::TooMuch { .. })));
    }

    #[test]
    fn a_tangle_is_no_outline() {
        let vertices = |i: u32| format!("10\n{}\n20\n{}\n", i % 2 * 100, f64::from(i) * 1e-3);
        let tangle = |layer: &str| {
            let vertices: String = (0..20_000).map(vertices).collect();
            of_entities(&format!("0\nLWPOLYLINE\n8\n{layer}\n70\n1\n{vertices}"))
        };
        assert!(matches!(read(&tangle(OUTLINE_LAYER), 1e-6), Err(ReadError::Tangle { segments: 20_000, .. })));
        assert!(read(&tangle("HATCHING"), 1e-6).is_ok());
    }

    #[test]
    fn names_are_told_without_what_a_terminal_obeys() {
        let bytes = of_entities("0\nREGION\n8\nA\u{1b}[31m\u{202e}\u{9b}B\n");
        let told = read(&bytes, 1e-6).expect("read").unreadable[0].to_string();
        assert!(told.starts_with("REGION on layer A\\u001b[31m\\u202e\\u009bB at"), "{told}");
        let long = of_entities(&format!("0\nLINE\n8\n{}\n", "x".repeat(3000)));
        assert!(matches!(read(&long, 1e-6), Err(ReadError::NotDxf(_))));
    }

    #[test]
    fn what_is_not_dxf_is_told_without_a_panic() {
        let whole = drawing(slot(), Units::Millimeters);
        assert_eq!(read(b"", 1e-6), Err(ReadError::CutShort));
        assert_eq!(read(b"hello", 1e-6), Err(ReadError::CutShort));
        assert!(matches!(read(b"hello\nEOF", 1e-6), Err(ReadError::NotDxf(_))));
        assert!(matches!(read(&[0xff; 64], 1e-6), Err(ReadError::CutShort)));
        for cut in (0..whole.len()).step_by(whole.len() / 97) {
            let mut bytes = whole[..cut].to_vec();
            bytes.extend_from_slice(b"\n  0\nEOF\n");
            // Either it is told, or what is left is read; it never panics.
            let _ = read(&bytes, 1e-6);
        }
    }
}

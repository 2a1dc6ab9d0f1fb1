//! The cut drawing of one section: outline, bore, holes.

use super::balancing::{self, Balancing};
use super::part_shapes::{PartHub, RimNotch};
use crate::machine::{Machine, Rotation};
use crate::report::{OutlineMeasures, Weight};
use camgen_kernel::geometry::contour::{Contour, Extents, Vertex};
use camgen_kernel::geometry::cubics::{CurveRun, runs};
use camgen_kernel::geometry::solid::CheckedSolid;
use camgen_kernel::geometry::solid::stacked::{Wall, stacked};
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::profile::outline::Outline;
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;
use std::f64::consts::PI;

/// Grams in a kilogram.
const GRAMS: f64 = 1e3;

/// A centre of mass nearer to the shaft than this, mm, is on it: far below any grade of balancing, far above what arcs fitted
/// lobe by lobe differ by.
pub const NEGLIGIBLE_MM: f64 = 1e-6;

/// Layer of a cut file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// The outline of the cam.
    CamProfile,
    /// The flank of a groove nearer to the shaft.
    GrooveInner,
    /// The flank of a groove around the roller.
    GrooveOuter,
    /// The flank of a rib on which its outer roller runs.
    RibOuter,
    /// The flank of a rib on which its inner roller runs.
    RibInner,
    /// The flank of a barrel above its roller, in the developed view.
    FlankUpper,
    /// The flank of a barrel below its roller, in the developed view.
    FlankLower,
    /// The centre line of the roller of a barrel, in the developed view.
    Pitch,
    /// The edge of a part whose roller runs within it, or of a developed blank.
    Blank,
    /// Bore and holes.
    Bore,
    /// The path of a cutter's centre, in a file of its own.
    CutterPath,
    /// The path on which the tool comes to the start of the outline, or of the path of the cutter.
    LeadIn,
}

impl Layer {
    /// Its name in the file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Layer::CamProfile => "CAM_PROFILE",
            Layer::GrooveInner => "GROOVE_INNER",
            Layer::GrooveOuter => "GROOVE_OUTER",
            Layer::RibOuter => "RIB_OUTER",
            Layer::RibInner => "RIB_INNER",
            Layer::FlankUpper => "FLANK_UPPER",
            Layer::FlankLower => "FLANK_LOWER",
            Layer::Pitch => "PITCH",
            Layer::Blank => "BLANK",
            Layer::Bore => "BORE",
            Layer::CutterPath => "CUTTER_PATH",
            Layer::LeadIn => "LEAD_IN",
        }
    }

    /// What names of files call the flank on it: "inner".
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Layer::GrooveInner | Layer::RibInner => "inner",
            Layer::GrooveOuter | Layer::RibOuter => "outer",
            _ => "",
        }
    }
}

/// A flank of a part, as it lies in the drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct PartFlank {
    /// Its layer in the cut file.
    pub layer: Layer,
    /// Whether the metal lies around it.
    pub hollow: bool,
    /// Its outline, counter-clockwise, with its proof.
    pub outline: Outline,
}

/// What a part has in addition to one outline with the metal inside of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// Layer of the first outline, and whether the metal lies around it.
    pub first: (Layer, bool),
    /// The other flanks.
    pub others: Vec<PartFlank>,
    /// Radius of the blank, mm, of a part whose edge is not a flank.
    pub blank: Option<f64>,
    /// How deep the flanks reach below the upper face, mm; `None` of flanks that go through.
    pub depth: Option<f64>,
}

/// A closed curve that bounds the metal of a part, which lies on its left.
#[derive(Debug, Clone)]
pub struct Rim {
    /// Its layer.
    pub layer: Layer,
    /// The curve.
    pub curve: Entity,
    /// How deep it reaches below the upper face, mm; `None` of one that goes through.
    pub depth: Option<f64>,
}

impl Rim {
    fn of(layer: Layer, outline: &Outline, hollow: bool, depth: Option<f64>) -> Self {
        let contour = if hollow { outline.contour.reversed() } else { outline.contour.clone() };
        Self { layer, curve: Entity::Polyline(contour), depth }
    }
}

/// The cut drawing of a section.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Which of several outlines at one place it is, as [`Cut::name`](super::Cut::name).
    pub name: &'static str,
    /// Speed it is cut for, rpm, where there are several sections.
    pub rpm: Option<f64>,
    /// Place along the axis, m.
    pub z: f64,
    /// The outline with its proof, as it lies in the drawing.
    pub outline: Outline,
    /// The bore, a circle or, with a keyway, a contour; counter-clockwise.
    pub bore: Option<Entity>,
    /// Holes of the machine file, centre and radius, mm.
    pub drilled: Vec<(Vector2<f64>, f64)>,
    /// Holes that balance the disc, when they were requested.
    pub balancing: Option<Balancing>,
    /// Of a part whose roller runs within it.
    pub track: Option<Track>,
    /// Its hub.
    pub hub: Option<PartHub>,
    /// A notch in the rim of its blank.
    pub notch: Option<RimNotch>,
}

/// Mass and moments of a part, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inertia {
    /// kg.
    pub mass: f64,
    /// About an axis along the shaft through the centre of mass, kg·m².
    pub polar: f64,
    /// About a diameter through the centre of mass, kg·m²: the mean of two across each other.
    pub diametral: f64,
    /// Mass times the place of its centre from the shaft, kg·m.
    pub unbalance: [f64; 2],
}

impl Part {
    /// An outline and nothing else.
    #[must_use]
    pub fn solid_plate(outline: Outline) -> Self {
        Self {
            name: "",
            rpm: None,
            z: 0.0,
            outline,
            bore: None,
            drilled: Vec::new(),
            balancing: None,
            track: None,
            hub: None,
            notch: None,
        }
    }

    /// A section of a machine's turning cam: the outline of a clockwise one turned as the machine's, with its bore.
    #[must_use]
    pub fn turning(machine: &Machine, outline: Outline) -> Self {
        let outline = Outline { contour: as_turned(machine, outline.contour), ..outline };
        Self { bore: bore(machine), ..Self::solid_plate(outline) }
    }

    /// With the holes that balance it, when the machine file has `cam.balance`.
    pub(crate) fn balanced(self, machine: &Machine) -> Self {
        let wall = MILLIMETRES * machine.limits.wall.unwrap_or(0.0);
        let round = self.bore.as_ref().map(Entity::contour);
        let drilled: Vec<Contour> =
            self.drilled.iter().map(|(centre, radius)| Contour::circle(*centre, *radius)).collect();
        let balancing = machine.cam.balance.map(|(inner, outer)| {
            let band = (MILLIMETRES * inner, MILLIMETRES * outer);
            balancing::balance((&self.outline.contour, round.as_ref(), &drilled), band, wall, NEGLIGIBLE_MM)
        });
        Self { balancing, ..self }
    }

    /// What is cut in addition to an outline (mm) of a machine's turning cam: bore and balance holes, counter-clockwise.
    pub(crate) fn holes_within(machine: &Machine, contour: &Contour) -> Vec<Entity> {
        let outline = Outline { contour: contour.clone(), ..Outline::empty() };
        Self { bore: bore(machine), ..Self::solid_plate(outline) }.drilled(machine).balanced(machine).holes()
    }

    /// What is cut, layer by layer; holes clockwise.
    #[must_use]
    pub fn entities(&self) -> Vec<(Layer, Entity)> {
        let lead_in = self.outline.lead_in.map(|segment| (Layer::LeadIn, Entity::Segment(segment)));
        self.rims().into_iter().map(|rim| (rim.layer, rim.curve)).chain(lead_in).collect()
    }

    /// Everything that bounds its metal: flanks, blank, bore and holes.
    #[must_use]
    pub fn rims(&self) -> Vec<Rim> {
        let track = self.track.as_ref();
        let (layer, hollow) = track.map_or((Layer::CamProfile, false), |track| track.first);
        let depth = track.and_then(|track| track.depth);
        let others = track.map_or(&[][..], |track| track.others.as_slice());
        let others = others.iter().map(|flank| Rim::of(flank.layer, &flank.outline, flank.hollow, depth));
        let blank = self.blank().map(|curve| Rim { layer: Layer::Blank, curve, depth: None });
        let holes = self.holes().into_iter().map(|hole| match hole {
            Entity::Polyline(contour) => Entity::Polyline(contour.reversed()),
            other => other,
        });
        let holes = holes.map(|curve| Rim { layer: Layer::Bore, curve, depth: None });
        let first = Rim::of(layer, &self.outline, hollow, depth);
        std::iter::once(first).chain(others).chain(blank).chain(holes).collect()
    }

    /// Its outlines, each with its layer, in the order of the cuts of its body.
    pub fn outlines(&self) -> impl Iterator<Item = (Layer, &Outline)> {
        let first = self.track.as_ref().map_or(Layer::CamProfile, |track| track.first.0);
        let others = self.track.iter().flat_map(|track| &track.others);
        std::iter::once((first, &self.outline)).chain(others.map(|flank| (flank.layer, &flank.outline)))
    }

    /// Those outlines, to be changed.
    pub(crate) fn outlines_mut(&mut self) -> impl Iterator<Item = &mut Outline> {
        let others = self.track.iter_mut().flat_map(|track| &mut track.others);
        std::iter::once(&mut self.outline).chain(others.map(|flank| &mut flank.outline))
    }

    /// Extents of the part, mm.
    #[must_use]
    pub fn extents(&self) -> Extents {
        self.blank().map_or_else(|| self.outline.contour.extents(), |blank| blank.extents())
    }

    /// The edge of its blank.
    fn blank(&self) -> Option<Entity> {
        let radius = self.track.as_ref()?.blank?;
        Some(match &self.notch {
            Some(notch) => Entity::Polyline(notch.in_rim(radius)),
            None => Entity::Circle(Vector2::zeros(), radius),
        })
    }

    /// What is cut in addition to its outlines, counter-clockwise: bore, balance holes, and the edge of its blank.
    #[must_use]
    pub fn beside_outlines(&self) -> Vec<Entity> {
        self.holes().into_iter().chain(self.blank()).collect()
    }

    /// Bore and balance holes, counter-clockwise.
    #[must_use]
    pub fn holes(&self) -> Vec<Entity> {
        let drilled = self.drilled.iter().chain(self.balancing.iter().flat_map(|balancing| &balancing.holes));
        self.bore.iter().cloned().chain(drilled.map(|(centre, radius)| Entity::Circle(*centre, *radius))).collect()
    }

    /// Its holes as contours with the metal on their left: clockwise.
    #[must_use]
    pub fn hole_contours(&self) -> Vec<Contour> {
        self.holes().iter().map(|hole| hole.contour().reversed()).collect()
    }

    /// The part of a thickness (mm) as a solid.
    ///
    /// # Errors
    /// [`Refusal`] when its own checks fail: a fault of camgen.
    pub fn solid(&self, thickness: f64) -> Result<CheckedSolid, Refusal> {
        let walls: Vec<Wall> = self.standing_rims(thickness).into_iter().map(|rim| rim.wall).collect();
        stacked(&walls)
    }

    /// Area of the metal, mm², and its first moment about the shaft, mm³; of a part with a groove those of its upper face.
    #[must_use]
    pub fn area_and_moment(&self) -> (f64, Vector2<f64>) {
        self.swept(|_| 1.0)
    }

    /// The sum over all walls of area and first moment, each times a weight that belongs to its depth.
    fn swept(&self, weight: impl Fn(Option<f64>) -> f64) -> (f64, Vector2<f64>) {
        sum_of_areas(&self.areas(), weight)
    }

    /// What bounds its metal as areas: counter-clockwise, 1 where the metal lies inside and −1 where it lies around, and the depth.
    fn areas(&self) -> Vec<(Contour, f64, Option<f64>)> {
        let sign = |hollow: bool| if hollow { -1.0 } else { 1.0 };
        let of_track = |track: &Track| {
            let flanks = track.others.iter();
            let flanks = flanks.map(|flank| (flank.outline.contour.clone(), sign(flank.hollow), track.depth));
            let blank = self.blank().map(|blank| (blank.contour(), 1.0, None));
            flanks.chain(blank).collect::<Vec<_>>()
        };
        let (hollow, depth) = self.track.as_ref().map_or((false, None), |track| (track.first.1, track.depth));
        let first = (self.outline.contour.clone(), sign(hollow), depth);
        let holes = self.holes().into_iter().map(|hole| (hole.contour(), -1.0, None));
        std::iter::once(first).chain(self.track.iter().flat_map(of_track)).chain(holes).collect()
    }

    /// Which share of the thickness a wall of some depth (mm) takes; all of it where no thickness is known.
    fn share_of_thickness(machine: &Machine) -> impl Fn(Option<f64>) -> f64 + use<> {
        let thickness = machine.cam.thickness.map(|thickness| MILLIMETRES * thickness);
        move |depth| depth.zip(thickness).map_or(1.0, |(depth, thickness)| depth / thickness)
    }

    /// Area, mass and centre of mass, with the machine's thickness and material.
    #[must_use]
    pub fn weight(&self, machine: &Machine) -> Weight {
        let (area, _) = self.area_and_moment();
        // kg per mm², where there is a thickness.
        let weight =
            machine.cam.thickness.map(|thickness| thickness * machine.cam.density() / (MILLIMETRES * MILLIMETRES));
        let share = Self::share_of_thickness(machine);
        let (disc, of_disc) = self.swept(&share);
        let (hub, of_hub) = sum_of_areas(&self.hub_areas(), share);
        let (even, moment) = (disc + hub, of_disc + of_hub);
        Weight {
            area_mm2: Some(area),
            mass_kg: weight.map(|weight| even * weight),
            centre_of_mass_mm: Some((moment / even).into()),
            unbalance_g_mm: weight.map(|weight| GRAMS * weight * moment.norm()),
        }
    }

    /// Mass, inertia and unbalance, with the machine's thickness and material; `None` without a thickness.
    #[must_use]
    pub fn inertia(&self, machine: &Machine) -> Option<Inertia> {
        let thickness = machine.cam.thickness?;
        // kg per mm² of the drawing.
        let weight = thickness * machine.cam.density() / (MILLIMETRES * MILLIMETRES);
        let share = Self::share_of_thickness(machine);
        let (disc, of_disc) = self.swept(&share);
        let hub_areas = self.hub_areas();
        let (hub, of_hub) = sum_of_areas(&hub_areas, &share);
        let (area, moment) = (disc + hub, of_disc + of_hub);
        let polar =
            |(contour, sign, depth): &(Contour, f64, Option<f64>)| sign * share(*depth) * contour.polar_moment();
        let areas = self.areas();
        let (flanks, holes) = areas.split_at(areas.len() - self.holes().len());
        let of_areas = |areas: &[(Contour, f64, Option<f64>)]| areas.iter().map(polar).sum::<f64>();
        let polar = of_areas(flanks) + of_areas(holes) + of_areas(&hub_areas);
        let about_shaft = weight * polar / (MILLIMETRES * MILLIMETRES);
        let (mass, unbalance) = (weight * area, moment * (weight / MILLIMETRES));
        let polar = about_shaft - unbalance.norm_squared() / mass;
        // The mean of the two diameters.
        let mut diametral = 0.5 * polar + weight * disc * thickness * thickness / 12.0;
        if let Some(PartHub { behind, in_front, .. }) = self.hub {
            // Disc and hubs: mass, length, height of the middle.
            let length = behind + in_front;
            let of_hub = |part: f64| weight * hub * part / length;
            let layers = [
                (weight * disc, 0.0, 0.5 * thickness),
                (of_hub(behind), behind / MILLIMETRES, -0.5 * behind / MILLIMETRES),
                (of_hub(in_front), in_front / MILLIMETRES, thickness + 0.5 * in_front / MILLIMETRES),
            ];
            let centre = layers.iter().map(|(mass, _, middle)| mass * middle).sum::<f64>() / mass;
            let along = |(mass, length, middle): &(f64, f64, f64)| {
                mass * (length * length / 12.0 + (middle - centre) * (middle - centre))
            };
            diametral += layers.iter().map(along).sum::<f64>();
        }
        Some(Inertia { mass, polar, diametral, unbalance: unbalance.into() })
    }

    /// Measures of one of its outlines without corners, for the report.
    #[must_use]
    pub fn measures_of(&self, outline: &Outline, tolerance_mm: f64) -> OutlineMeasures {
        Self::solid_plate(outline.clone()).measures(tolerance_mm, |_| false)
    }

    /// Measures of the outline for the report; `is_corner` is true at places (mm) where a corner is intended.
    #[must_use]
    pub fn measures(&self, tolerance_mm: f64, is_corner: impl Fn(Vector2<f64>) -> bool) -> OutlineMeasures {
        let outline = &self.outline;
        let (arcs, lines, spans) = (outline.contour.arcs(), outline.contour.lines(), outline.contour.cubics());
        let splined = spans > 0;
        let splines =
            splined.then(|| runs(&outline.contour).iter().filter(|run| matches!(run, CurveRun::Spline(_))).count());
        let best_possible = if splined { 0.0 } else { outline.best_possible };
        let breaks = outline.contour.tangent_breaks().into_iter().zip(&outline.contour.vertices);
        let smooth = breaks.filter(|(_, vertex)| !is_corner(vertex.point));
        let worst_break = smooth.map(|(turn, _)| turn.abs()).fold(0.0, f64::max);
        let [best_for_velocity, best_for_acceleration] = outline.best_for;
        #[expect(clippy::cast_precision_loss, reason = "a few thousand arcs")]
        let ratio = (best_possible > 0.0).then(|| arcs as f64 / best_possible);
        OutlineMeasures {
            arcs,
            lines,
            splines,
            spans: splined.then_some(spans),
            spans_by_theory: splined.then_some(outline.best_possible),
            deviation_max_mm: outline.deviation,
            tangent_break_max_deg: worst_break.to_degrees(),
            tolerance_mm,
            arcs_best_possible: best_possible,
            arcs_over_best_possible: ratio,
            arcs_best_possible_velocity: Some(best_for_velocity).filter(|best| *best > 0.0),
            arcs_best_possible_acceleration: Some(best_for_acceleration).filter(|best| *best > 0.0),
            length_mm: outline.contour.length(),
        }
    }
}

/// The sum of areas and of their first moments, each times a weight that belongs to its depth.
fn sum_of_areas(areas: &[(Contour, f64, Option<f64>)], weight: impl Fn(Option<f64>) -> f64) -> (f64, Vector2<f64>) {
    areas.iter().fold((0.0, Vector2::zeros()), |(area, moment), (contour, sign, depth)| {
        let (own, centroid) = contour.area_and_centroid();
        let own = sign * own * weight(*depth);
        (area + own, moment + centroid * own)
    })
}

/// The bore of a clockwise cam, with its keyway merged into one contour.
#[must_use]
pub fn bore(machine: &Machine) -> Option<Entity> {
    let radius = MILLIMETRES * machine.cam.bore_radius?;
    let Some(keyway) = machine.cam.keyway else {
        return Some(Entity::Circle(Vector2::zeros(), radius));
    };
    let (half, bottom) = (0.5 * MILLIMETRES * keyway.width, radius + MILLIMETRES * keyway.depth);
    let edge = ((radius - half) * (radius + half)).sqrt();
    // The round part from the upper edge of the slot to the lower one, in two arcs.
    let round = libm::tan(0.25 * (PI - libm::asin(half / radius)));
    let (sin, cos) = (libm::sin(keyway.angle), libm::cos(keyway.angle));
    let at = |x: f64, y: f64, bulge: f64| Vertex::new(Vector2::new(cos * x - sin * y, sin * x + cos * y), bulge);
    let vertices = vec![
        at(edge, half, round),
        at(-radius, 0.0, round),
        at(edge, -half, 0.0),
        at(bottom, -half, 0.0),
        at(bottom, half, 0.0),
    ];
    Some(Entity::Polyline(as_turned(machine, Contour { vertices })))
}

/// A contour of a clockwise cam as it lies in the drawing of this one.
pub(crate) fn as_turned(machine: &Machine, contour: Contour) -> Contour {
    match machine.cam.rotation {
        Rotation::Clockwise => contour,
        Rotation::CounterClockwise => contour.mirrored_about_x(),
    }
}

/// A point or direction of a clockwise cam as it lies in the drawing of this one.
#[must_use]
pub fn point_as_turned(machine: &Machine, point: Vector2<f64>) -> Vector2<f64> {
    match machine.cam.rotation {
        Rotation::Clockwise => point,
        Rotation::CounterClockwise => Vector2::new(point.x, -point.y),
    }
}

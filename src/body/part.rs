//! The cut drawing of one section: outline, bore, holes.

use super::balancing::{self, Balancing};
use crate::geometry::contour::{Contour, Vertex};
use crate::geometry::cubics::{Run, runs};
use crate::geometry::solid::{Solid, SolidError, prism};
use crate::geometry::{Entity, MILLIMETRES};
use crate::machine::{Machine, Rotation};
use crate::profile::outline::Outline;
use crate::report::{OutlineMeasures, Weight};
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
    /// Bore and holes.
    Bore,
    /// The path of a cutter's centre, in a file of its own.
    CutterPath,
}

impl Layer {
    /// Its name in the file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Layer::CamProfile => "CAM_PROFILE",
            Layer::Bore => "BORE",
            Layer::CutterPath => "CUTTER_PATH",
        }
    }
}

/// The cut drawing of a section.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Speed it is cut for, rpm, where there are several sections.
    pub rpm: Option<f64>,
    /// Place along the axis, m.
    pub z: f64,
    /// The outline with its proof, as it lies in the drawing.
    pub outline: Outline,
    /// The bore, a circle or, with a keyway, a contour; counter-clockwise.
    pub bore: Option<Entity>,
    /// Holes that balance the disc, when they were requested.
    pub balancing: Option<Balancing>,
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
    pub(super) fn solid_plate(outline: Outline) -> Self {
        Self { rpm: None, z: 0.0, outline, bore: None, balancing: None }
    }

    /// A section of a machine's turning cam: the outline of a clockwise one turned as the machine's, with its bore.
    pub(super) fn turning(machine: &Machine, outline: Outline) -> Self {
        let outline = Outline { contour: as_turned(machine, outline.contour), ..outline };
        Self { bore: bore(machine), ..Self::solid_plate(outline) }
    }

    /// With the holes that balance it, when the machine file has `cam.balance`.
    pub(super) fn balanced(self, machine: &Machine) -> Self {
        let wall = MILLIMETRES * machine.limits.wall;
        let round = self.bore.as_ref().map(Entity::contour);
        let balancing = machine.cam.balance.map(|(inner, outer)| {
            let band = (MILLIMETRES * inner, MILLIMETRES * outer);
            balancing::balance(&self.outline.contour, round.as_ref(), band, wall, NEGLIGIBLE_MM)
        });
        Self { balancing, ..self }
    }

    /// What is cut beside an outline (mm) of a machine's turning cam: bore and balance holes, counter-clockwise.
    pub(super) fn holes_within(machine: &Machine, contour: &Contour) -> Vec<Entity> {
        let outline = Outline { contour: contour.clone(), deviation: 0.0, best_possible: 0.0, best_for: [0.0; 2] };
        Self { bore: bore(machine), ..Self::solid_plate(outline) }.balanced(machine).holes()
    }

    /// What is cut, layer by layer; holes clockwise.
    #[must_use]
    pub fn entities(&self) -> Vec<(Layer, Entity)> {
        let profile = (Layer::CamProfile, Entity::Polyline(self.outline.contour.clone()));
        let holes = self.holes().into_iter().map(|hole| match hole {
            Entity::Polyline(contour) => (Layer::Bore, Entity::Polyline(contour.reversed())),
            circle @ Entity::Circle(..) => (Layer::Bore, circle),
        });
        std::iter::once(profile).chain(holes).collect()
    }

    /// Bore and balance holes, counter-clockwise.
    #[must_use]
    pub fn holes(&self) -> Vec<Entity> {
        let drilled = self.balancing.iter().flat_map(|balancing| &balancing.holes);
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
    /// [`SolidError`] when its own checks fail: a fault of camgen.
    pub fn solid(&self, thickness: f64) -> Result<Solid, SolidError> {
        let contours: Vec<Contour> =
            std::iter::once(self.outline.contour.clone()).chain(self.hole_contours()).collect();
        prism(&contours, self.area_and_moment().0, thickness)
    }

    /// Area of the metal, mm², and its first moment about the shaft, mm³.
    #[must_use]
    pub fn area_and_moment(&self) -> (f64, Vector2<f64>) {
        let (outline, centroid) = self.outline.contour.area_and_centroid();
        self.holes().iter().fold((outline, centroid * outline), |(area, moment), hole| {
            let (hole, centroid) = hole.contour().area_and_centroid();
            (area - hole, moment - centroid * hole)
        })
    }

    /// Area, mass and centre of mass, with the machine's thickness and material.
    #[must_use]
    pub fn weight(&self, machine: &Machine) -> Weight {
        let (area, moment) = self.area_and_moment();
        // kg per mm², where there is a thickness.
        let weight =
            machine.cam.thickness.map(|thickness| thickness * machine.cam.density() / (MILLIMETRES * MILLIMETRES));
        Weight {
            area_mm2: Some(area),
            mass_kg: weight.map(|weight| area * weight),
            centre_of_mass_mm: Some((moment / area).into()),
            unbalance_g_mm: weight.map(|weight| GRAMS * weight * moment.norm()),
        }
    }

    /// Mass, inertia and unbalance, with the machine's thickness and material; `None` without a thickness.
    #[must_use]
    pub fn inertia(&self, machine: &Machine) -> Option<Inertia> {
        let thickness = machine.cam.thickness?;
        // kg per mm² of the drawing.
        let weight = thickness * machine.cam.density() / (MILLIMETRES * MILLIMETRES);
        let (area, moment) = self.area_and_moment();
        let holes: f64 = self.holes().iter().map(|hole| hole.contour().polar_moment()).sum();
        let square = MILLIMETRES * MILLIMETRES;
        let about_shaft = weight * (self.outline.contour.polar_moment() - holes) / square;
        let (mass, unbalance) = (weight * area, moment * (weight / MILLIMETRES));
        let polar = about_shaft - unbalance.norm_squared() / mass;
        // The mean of the two diameters.
        let diametral = 0.5 * polar + mass * thickness * thickness / 12.0;
        Some(Inertia { mass, polar, diametral, unbalance: unbalance.into() })
    }

    /// What is reported of the outline; `is_corner` is true at places (mm) where a corner is intended.
    #[must_use]
    pub fn measures(&self, tolerance_mm: f64, is_corner: impl Fn(Vector2<f64>) -> bool) -> OutlineMeasures {
        let outline = &self.outline;
        let (arcs, lines, spans) = (outline.contour.arcs(), outline.contour.lines(), outline.contour.cubics());
        let splined = spans > 0;
        let splines =
            splined.then(|| runs(&outline.contour).iter().filter(|run| matches!(run, Run::Spline(_))).count());
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

/// The bore of a clockwise cam, with its keyway merged into one contour.
pub(super) fn bore(machine: &Machine) -> Option<Entity> {
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
pub(super) fn as_turned(machine: &Machine, contour: Contour) -> Contour {
    match machine.cam.rotation {
        Rotation::Clockwise => contour,
        Rotation::CounterClockwise => contour.mirrored_about_x(),
    }
}

/// A point or direction of a clockwise cam as it lies in the drawing of this one.
pub(super) fn point_as_turned(machine: &Machine, point: Vector2<f64>) -> Vector2<f64> {
    match machine.cam.rotation {
        Rotation::Clockwise => point,
        Rotation::CounterClockwise => Vector2::new(point.x, -point.y),
    }
}

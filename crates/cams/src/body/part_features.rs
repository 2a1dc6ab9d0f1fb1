//! Holes, hub and notch of a part, as they lie in its drawing, and why they cannot be made.

use super::part::{Part, Rim, point_as_turned};
use super::part_shapes::{PartHub, RimNotch};
use super::{DrawError, Layer};
use crate::machine::{HolePattern, Machine, TimingMark};
use crate::report::sheet::Dimensions;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::geometry::section::crossings;
use camgen_kernel::geometry::solid::stacked::Wall;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;

/// A contour of a part with the metal on its left, and the heights between which its wall stands.
#[derive(Debug, Clone, PartialEq)]
pub struct StandingRim {
    /// The wall, mm.
    pub wall: Wall,
    /// Whether a follower runs on it.
    pub is_flank: bool,
}

/// The edge of a blank of a radius, mm, with the notch of the machine file.
pub(crate) fn edge_of_blank(machine: &Machine, radius: f64) -> Entity {
    match rim_notch(machine) {
        Some(notch) => Entity::Polyline(notch.in_rim(radius)),
        None => Entity::Circle(Vector2::zeros(), radius),
    }
}

/// The direction of a cam angle in the drawing.
pub(super) fn direction(machine: &Machine, angle: f64) -> Vector2<f64> {
    let (sin, cos) = libm::sincos(angle);
    point_as_turned(machine, Vector2::new(cos, sin))
}

fn rim_notch(machine: &Machine) -> Option<RimNotch> {
    match machine.features.timing_mark? {
        TimingMark::Notch { angle, depth } => {
            Some(RimNotch { towards: direction(machine, angle), depth: MILLIMETRES * depth })
        }
        TimingMark::Line { .. } => None,
    }
}

impl Part {
    /// With holes, hub and notch of the machine file, and the holes that balance it.
    ///
    /// # Errors
    /// [`DrawError::Refused`] when one of them cannot be made.
    pub(crate) fn with_features(self, machine: &Machine) -> Result<Self, DrawError> {
        let hub = machine.features.hub.map(|hub| PartHub {
            radius: MILLIMETRES * hub.radius,
            behind: MILLIMETRES * hub.behind,
            in_front: MILLIMETRES * hub.in_front,
        });
        let part = Self { hub, notch: rim_notch(machine), ..self }.drilled(machine);
        let fault = part.hub_fault(machine).or_else(|| part.hole_fault(machine)).or_else(|| part.mark_fault(machine));
        if let Some(fault) = fault {
            return Err(fault.into());
        }
        let part = part.balanced(machine);
        match part.joint_fault(machine) {
            Some(fault) => Err(fault.into()),
            None => Ok(part),
        }
    }

    /// With the holes of the machine file.
    pub(crate) fn drilled(self, machine: &Machine) -> Self {
        let mut drilled = Vec::new();
        for pattern in &machine.holes {
            let radius = MILLIMETRES * pattern.radius;
            drilled.extend(pattern.centres().map(|centre| (point_as_turned(machine, centre * MILLIMETRES), radius)));
        }
        Self { drilled, ..self }
    }

    /// Why the hub cannot be made: it must be wider than the bore with its keyway, and leave the flanks free.
    fn hub_fault(&self, machine: &Machine) -> Option<Refusal> {
        let hub = self.hub?;
        let units = machine.units();
        let size = |radius: f64| format!("Ø{} {}", units.dimension(2.0 * radius), units.symbol());
        let bore = machine.cam.bore_reach().map_or(0.0, |reach| MILLIMETRES * reach);
        let rims = self.rims_without_holes();
        let beside_hub =
            rims.iter().filter(|rim| rim.layer != Layer::Bore && (hub.in_front > 0.0 || rim.depth.is_none()));
        let trees = beside_hub.map(|rim| EdgeTree::new(&rim.curve.contour()));
        let nearest = trees.filter_map(|tree| tree.nearest(Vector2::zeros())).map(|nearest| nearest.left.abs());
        let room = nearest.fold(f64::INFINITY, f64::min);
        if bore >= room {
            return None;
        }
        if hub.radius <= bore {
            let what = format!(
                "cam.hub: a hub of {} is not wider than the bore with its keyway, {}",
                size(hub.radius),
                size(bore)
            );
            return Some(Refusal::new(what).remedy(format!(
                "give a cam.hub.diameter between {} and {}",
                size(bore),
                size(room)
            )));
        }
        if hub.radius >= room {
            let what = format!(
                "cam.hub: a hub of {} reaches the profile, which comes within {} of the axis",
                size(hub.radius),
                units.dimension(room)
            );
            return Some(Refusal::new(what).remedy(format!(
                "give a cam.hub.diameter between {} and {}",
                size(bore),
                size(room)
            )));
        }
        let band = machine.cam.balance.map(|(inner, _)| MILLIMETRES * inner).filter(|inner| *inner <= hub.radius);
        band.map(|_| {
            let what = format!("cam.balance: the band of holes begins within the hub of {}", size(hub.radius));
            Refusal::new(what).remedy("begin the band outside the hub")
        })
    }

    /// Why a hole of the machine file cannot be drilled, with a remedy: it must lie in the metal, clear of all other cuts and of the rim of the hub.
    fn hole_fault(&self, machine: &Machine) -> Option<Refusal> {
        let rims = self.rims_without_holes();
        let trees: Vec<(&'static str, EdgeTree)> =
            rims.iter().map(|rim| (rim_words(rim.layer), EdgeTree::new(&rim.curve.contour()))).collect();
        let patterns = machine.holes.iter().flat_map(|pattern| std::iter::repeat_n(pattern, pattern.count as usize));
        let mut drilled: Vec<(&HolePattern, Vector2<f64>, f64)> = Vec::new();
        for (pattern, (centre, radius)) in patterns.zip(&self.drilled) {
            let to_rims = trees.iter().filter_map(|(words, tree)| {
                let nearest = tree.nearest(*centre)?;
                Some((nearest.left.abs() - radius, (*words).to_owned()))
            });
            let to_holes = drilled
                .iter()
                .map(|(other, at, size)| ((centre - at).norm() - size - radius, format!("a hole of {}", other.key)));
            let to_hub =
                self.hub.iter().map(|hub| ((centre.norm() - hub.radius).abs() - radius, "the rim of the hub".into()));
            let all = to_rims.chain(to_holes).chain(to_hub);
            let nearest = all.min_by(|a, b| a.0.total_cmp(&b.0));
            let why = match nearest {
                _ if !is_metal(&rims, *centre) => Some("does not lie in the metal".to_owned()),
                Some((room, words)) if room <= 0.0 => {
                    let units = machine.units();
                    Some(format!("overlaps {words} by {} {}", units.dimension(-room), units.symbol()))
                }
                _ => None,
            };
            if let Some(why) = why {
                let what = format!("{}: {} {why}", pattern.key, hole_words(machine, pattern, *centre));
                return Some(Refusal::new(what).remedy("give another circle_diameter or angle, or a smaller diameter"));
            }
            drilled.push((pattern, *centre, *radius));
        }
        None
    }

    /// Why a mark on the front face or in the rim cannot be made.
    fn mark_fault(&self, machine: &Machine) -> Option<Refusal> {
        let units = machine.units();
        match machine.features.timing_mark? {
            TimingMark::Line { angle, from, to } => {
                let along = direction(machine, angle);
                let [from, to] = [MILLIMETRES * from, MILLIMETRES * to];
                let hub = self.hub.filter(|hub| hub.in_front > 0.0).map(|hub| hub.contour());
                let contours: Vec<Contour> = self.rims().iter().map(|rim| rim.curve.contour()).chain(hub).collect();
                let is_crossed = contours.iter().any(|contour| {
                    crossings(contour, Vector2::zeros(), along).into_iter().any(|at| from <= at && at <= to)
                });
                (is_crossed || !is_metal(&self.rims(), along * from)).then(|| {
                    let [from, to] = [from, to].map(|radius| units.dimension(radius));
                    let what = format!(
                        "cam.timing_mark: the line from {from} to {to} {} from the axis does not lie on the front face",
                        units.symbol()
                    );
                    Refusal::new(what).remedy("give another circle_diameter or angle, or a shorter length")
                })
            }
            TimingMark::Notch { .. } => {
                let (notch, blank) = (self.notch?, self.track.as_ref()?.blank?);
                let apex = notch.towards * (blank - notch.depth);
                // The bare blank, so that its apex would lie in the metal.
                let bare = Self { notch: None, ..self.clone() };
                (notch.depth >= blank || !is_metal(&bare.rims(), apex)).then(|| {
                    let what = format!(
                        "cam.timing_mark: a notch {} {} deep reaches the groove or a hole",
                        units.dimension(notch.depth),
                        units.symbol()
                    );
                    Refusal::new(what).remedy("give a smaller depth, or another angle")
                })
            }
        }
    }

    /// Why the disc cannot be split where it is to be: the joint must not run through a hole or the keyway.
    fn joint_fault(&self, machine: &Machine) -> Option<Refusal> {
        let along = direction(machine, machine.features.split?);
        let aside = |point: Vector2<f64>| along.perp(&point);
        let refused = |what: String| Refusal::new(what).remedy("give another angle of cam.split");
        let is_keyway_cut = machine.cam.keyway.zip(machine.cam.bore_radius).is_some_and(|(keyway, bore)| {
            let towards = direction(machine, keyway.angle);
            aside(towards).abs() * MILLIMETRES * bore <= 0.5 * MILLIMETRES * keyway.width
        });
        if is_keyway_cut {
            return Some(refused("cam.split: the joint runs through the keyway".into()));
        }
        let drilled = self.drilled.iter().chain(self.balancing.iter().flat_map(|balancing| &balancing.holes));
        let cut = drilled.into_iter().find(|(centre, radius)| aside(*centre).abs() <= *radius)?;
        let units = machine.units();
        let angle = libm::atan2(cut.0.y, cut.0.x).to_degrees().rem_euclid(360.0);
        Some(refused(format!(
            "cam.split: the joint runs through the hole of Ø{} {} at ψ {angle:.1}°",
            units.dimension(2.0 * cut.1),
            units.symbol()
        )))
    }

    /// Everything that bounds its metal but the holes of the machine file and those that balance it.
    fn rims_without_holes(&self) -> Vec<Rim> {
        let bare = Self { drilled: Vec::new(), balancing: None, ..self.clone() };
        let rims = bare.rims().into_iter();
        rims.map(|rim| Rim { curve: Entity::Polyline(metal_on_left(&rim)), ..rim }).collect()
    }

    /// The walls of the part of a thickness, mm, the rim of the blank first; z = 0 is its lower face, without the hub.
    #[must_use]
    pub fn standing_rims(&self, thickness: f64) -> Vec<StandingRim> {
        let (blank, rest): (Vec<Rim>, Vec<Rim>) = self.rims().into_iter().partition(|rim| rim.layer == Layer::Blank);
        let (pocket, through): (Vec<Rim>, Vec<Rim>) =
            rest.into_iter().partition(|rim| rim.depth.is_some_and(|depth| depth < thickness));
        let hub = self.hub.unwrap_or(PartHub { radius: 0.0, behind: 0.0, in_front: 0.0 });
        let standing = |rim: Rim| {
            let contour = metal_on_left(&rim);
            let is_in_hub = rim.layer == Layer::Bore && contour.edges().all(|edge| edge.start().norm() < hub.radius);
            let is_pocket = rim.depth.is_some_and(|depth| depth < thickness);
            let wall = match rim.depth.filter(|_| is_pocket) {
                Some(depth) => Wall { stands_on_metal: true, ..Wall::through(contour, thickness - depth, thickness) },
                None if is_in_hub => Wall::through(contour, -hub.behind, thickness + hub.in_front),
                None => Wall::through(contour, 0.0, thickness),
            };
            StandingRim { wall, is_flank: !matches!(rim.layer, Layer::Blank | Layer::Bore) }
        };
        let mut standing: Vec<StandingRim> = blank.into_iter().chain(through).chain(pocket).map(standing).collect();
        let walls = self.hub.into_iter().flat_map(|hub| {
            let behind = Wall { carries_metal: true, ..Wall::through(hub.contour(), -hub.behind, 0.0) };
            let in_front =
                Wall { stands_on_metal: true, ..Wall::through(hub.contour(), thickness, thickness + hub.in_front) };
            [behind, in_front]
        });
        standing.extend(walls.filter(|wall| wall.high > wall.low).map(|wall| StandingRim { wall, is_flank: false }));
        standing
    }

    /// The areas of the hub outside the thickness of the part: counter-clockwise, 1 for metal and −1 for a hole, with the height over which they count, mm.
    pub(super) fn hub_areas(&self) -> Vec<(Contour, f64, Option<f64>)> {
        let Some(hub) = self.hub else { return Vec::new() };
        let holes = self.holes().into_iter().map(|hole| hole.contour());
        let within = holes.filter(|hole| hole.edges().all(|edge| edge.start().norm() < hub.radius));
        let metal = (hub.contour(), 1.0, Some(hub.length()));
        std::iter::once(metal).chain(within.map(|hole| (hole, -1.0, Some(hub.length())))).collect()
    }
}

/// Whether a point of the front face is metal: an odd number of rims lies beyond it.
fn is_metal(rims: &[Rim], point: Vector2<f64>) -> bool {
    let beyond = rims.iter().flat_map(|rim| crossings(&rim.curve.contour(), point, Vector2::x()));
    beyond.filter(|distance| *distance > 0.0).count() % 2 == 1
}

/// The name of a rim in a message.
fn rim_words(layer: Layer) -> &'static str {
    match layer {
        Layer::Bore => "the bore with its keyway",
        Layer::Blank => "the rim of the blank",
        Layer::GrooveInner | Layer::GrooveOuter => "the groove",
        _ => "the profile",
    }
}

/// A rim as a contour with the metal on its left.
fn metal_on_left(rim: &Rim) -> Contour {
    match &rim.curve {
        Entity::Polyline(contour) => contour.clone(),
        round if rim.layer == Layer::Bore => round.contour().reversed(),
        round => round.contour(),
    }
}

/// "a hole of Ø6 mm on the circle Ø80 at 30.0°"
fn hole_words(machine: &Machine, pattern: &HolePattern, centre: Vector2<f64>) -> String {
    let units = machine.units();
    format!(
        "a hole of Ø{} {} on the circle Ø{} at {:.1}°",
        units.dimension(2.0 * MILLIMETRES * pattern.radius),
        units.symbol(),
        units.dimension(2.0 * MILLIMETRES * pattern.circle_radius),
        libm::atan2(centre.y, centre.x).to_degrees().rem_euclid(360.0)
    )
}

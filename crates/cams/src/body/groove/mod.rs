//! A body within which a roller runs: a groove with a flank on either side of the roller, or a ring that lies around it.
//!
//! The flanks are the parallels of the path of the roller's centre: the inner one at the radius of the roller and its share of the clearance, the
//! outer one on the other side of the path. Each is a cut with its own exact curve and its own proof. Forces, motion and size are those of the
//! disc under the same roller.

mod figures;
mod report;
mod sheet;
mod switches;

use super::disc::delegate::body_of_its_disc;
use super::disc::{self, Disc, DiscRole, Hold};
use super::figures::with_subject;
use super::part::{PartFlank, Track, as_turned};
use super::part_drawing;
use super::part_features::edge_of_blank;
use super::{Body, Cut, DrawError, DrawingEvidence, Drawn, Figures, Kind, Layer, Part, Request, WorstPlaces, largest};
use crate::check::{Measures, contact_stress};
use crate::machine::{Machine, Rotation};
use crate::report::Section;
use crate::report::mechanism::MovingMechanism;
use crate::report::sheet::SheetView;
use crate::table::{AddedColumn, Row};
use camgen_kernel::document::cams;
use camgen_kernel::follower::Follower;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::{Entity, MILLIMETRES, radius_of_curvature};
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::outline::{self, Outline, OutlineError};
use camgen_kernel::profile::{Curves, extremes, size};
use camgen_kernel::refusal::Refusal;
use std::sync::Arc;

/// The groove of any motion.
pub const GROOVE: Kind = Kind { command: cams::MAKE, noun: "groove cam", keys: cams::GROOVE };
/// The ring of any motion.
pub const RING: Kind = Kind { command: cams::MAKE, noun: "ring cam", keys: cams::RING };

/// The place of the outer flank of a groove.
const OUTER_X: AddedColumn = AddedColumn { name: "outer_x_mm", after: "profile_y_mm" };
const OUTER_Y: AddedColumn = AddedColumn { name: "outer_y_mm", after: "profile_y_mm" };

/// One flank.
#[derive(Debug, Clone)]
struct Flank {
    /// As names of files have it.
    name: &'static str,
    layer: Layer,
    /// The roller's path at the distance of the flank.
    follower: Arc<dyn Follower>,
    worst: WorstPlaces,
}

/// A groove or a ring.
#[derive(Debug, Clone)]
pub struct Groove {
    kind: &'static Kind,
    /// The disc that the same roller runs on: under the inner flank, or, of a ring, within the outer one.
    disc: Disc,
    motion: Arc<dyn Motion>,
    /// From the shaft outwards.
    flanks: Vec<Flank>,
    /// Radius of the blank, m.
    blank_radius: f64,
}

impl Groove {
    /// The groove of a motion, at a speed of the cam (rpm) where it is known.
    ///
    /// # Errors
    /// [`Refusal`] when motion and follower do not fit each other, the velocity jumps, or no radius keeps the limits.
    pub fn between_flanks(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>) -> Result<Self, Refusal> {
        Self::about(&GROOVE, Self::sized_disc(machine, motion, rpm)?)
    }

    /// The disc under the inner flank, sized for both flanks.
    ///
    /// # Errors
    /// As [`Groove::between_flanks`].
    pub(in crate::body) fn sized_disc(
        machine: &Machine,
        motion: &Arc<dyn Motion>,
        rpm: Option<f64>,
    ) -> Result<Disc, Refusal> {
        let role = DiscRole::with(&disc::GENERAL, Hold::Flanks, Self::broken_around);
        Disc::held(machine, Arc::clone(motion), rpm, role)
    }

    /// The first limit that a groove over `disc` breaks beyond those of the disc.
    fn broken_around(disc: &Disc) -> Option<&'static str> {
        Self::about(&GROOVE, disc.clone()).map_or(Some("undercut"), |groove| groove.broken_outside())
    }

    /// The ring around the roller of a motion, at a speed of the cam (rpm) where it is known.
    ///
    /// # Errors
    /// As [`Groove::between_flanks`].
    pub fn ring(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>) -> Result<Self, Refusal> {
        let follower = machine.follower.inside().ok_or_else(|| needs_a_roller(&RING))?;
        let disc = Disc::of_motion(&machine.with_follower(follower), Arc::clone(motion), rpm)?;
        Self::about(&RING, disc)
    }

    fn about(kind: &'static Kind, disc: Disc) -> Result<Self, Refusal> {
        if let Some(corner) = extremes::corners(disc.curves()).first() {
            let what = format!("the velocity of the follower jumps, and a {} has no corners", kind.noun);
            let remedy = "give other states or laws of the segments that meet there, or cam.body = \"disc\"";
            return Err(Refusal::new(what).at(format!("{:.3} deg", corner.at.to_degrees())).remedy(remedy));
        }
        let radius = disc.curves().roller_radius().ok_or_else(|| needs_a_roller(kind))?;
        let track = disc.machine().cam.track;
        let inside = track.clearance * track.clearance_share;
        let flank = |name, layer, distance: f64| {
            let follower = disc.follower().of_radius(distance).ok_or_else(|| needs_a_roller(kind))?;
            Ok::<_, Refusal>(Flank { name, layer, follower, worst: WorstPlaces::default() })
        };
        let flanks = if *kind == RING {
            vec![flank("", Layer::CamProfile, -radius)?]
        } else {
            let outer = -(radius + track.clearance - inside);
            vec![
                flank(Layer::GrooveInner.word(), Layer::GrooveInner, radius + inside)?,
                flank(Layer::GrooveOuter.word(), Layer::GrooveOuter, outer)?,
            ]
        };
        let blank_radius = track.edge_radius().unwrap_or(f64::NAN);
        let motion = Arc::clone(disc.motion());
        let found = Self { kind, disc, motion, flanks, blank_radius };
        let machine = found.disc.machine();
        let wall = machine.limits.least_wall(machine.cam.bore_radius);
        let auto = || size::rounded_up(found.reach() + wall);
        Ok(Self { blank_radius: track.edge_radius().unwrap_or_else(auto), ..found })
    }

    fn curves(&self, flank: usize) -> Option<Curves<'_>> {
        self.flanks.get(flank).map(|flank| self.curves_of(flank))
    }

    fn curves_of<'a>(&'a self, flank: &'a Flank) -> Curves<'a> {
        Curves { motion: &*self.motion, follower: &*flank.follower }
    }

    /// The outer flank.
    fn outer(&self) -> Option<(Curves<'_>, &WorstPlaces)> {
        self.flanks.last().map(|flank| (self.curves_of(flank), &flank.worst))
    }

    /// The limit that the groove breaks beyond those of its disc: a self-intersecting or overloaded outer flank.
    fn broken_outside(&self) -> Option<&'static str> {
        if self.cuts().last().is_some_and(Cut::is_undercut) {
            return Some("undercut");
        }
        let allowed = contact_stress::largest_allowed(self.machine(), self.touching());
        allowed.filter(|allowed| self.exceeds_stress(*allowed)).map(|_| "contact_stress")
    }

    /// How far the outer flank reaches from the shaft, m.
    fn reach(&self) -> f64 {
        let of = |(curves, _): (Curves<'_>, _)| {
            largest(curves, |piece, angle| curves.profile(piece, angle).point.norm()).value
        };
        self.outer().map_or(f64::NAN, of)
    }

    /// Depth of the groove, m.
    fn depth(&self) -> Option<f64> {
        self.machine().cam.track.groove_depth.filter(|_| *self.kind == GROOVE)
    }

    /// Nominal width of the groove, m.
    fn width(&self) -> Option<f64> {
        let [inner, outer] = self.flanks.as_slice() else { return None };
        Some(self.curves_of(inner).offset() - self.curves_of(outer).offset())
    }

    fn outlines(&self, of: impl Fn(Curves<'_>) -> Result<Outline, OutlineError>) -> Vec<Result<Outline, OutlineError>> {
        let turned = |outline: Outline| {
            let contour = as_turned(self.machine(), outline.contour);
            Outline { contour, ..outline }
        };
        self.flanks.iter().map(|flank| of(self.curves_of(flank)).map(turned)).collect()
    }
}

fn needs_a_roller(kind: &Kind) -> Refusal {
    Refusal::new(format!("a {} needs a roller", kind.noun))
        .remedy("give [follower.roller] or [follower.swinging-roller]")
}

impl Body for Groove {
    fn kind(&self) -> &'static Kind {
        self.kind
    }

    body_of_its_disc!(disc);

    fn cuts(&self) -> Vec<Cut<'_>> {
        let clockwise = self.machine().cam.rotation == Rotation::Clockwise;
        let mirrored: &[bool] = if clockwise { &[false] } else { &[true] };
        let mut cuts = Vec::with_capacity(self.flanks.len());
        for flank in &self.flanks {
            let cut = Cut::plane(self.curves_of(flank), mirrored, &flank.worst);
            cuts.push(Cut { name: flank.name, layer: flank.layer, depth: self.depth(), ..cut });
        }
        cuts
    }

    fn holes_within(&self, _: &Contour) -> Vec<Entity> {
        let blank = edge_of_blank(self.machine(), MILLIMETRES * self.blank_radius);
        Part { bore: super::part::bore(self.machine()), ..Part::solid_plate(Outline::empty()) }
            .drilled(self.machine())
            .holes()
            .into_iter()
            .chain([blank])
            .collect()
    }

    fn measures(&self, of: &mut Measures<'_>) {
        with_subject(self, |subject| {
            self.measured(of, subject);
            self.measured_outside(of, subject);
            self.disc.measured_in_motion(of, subject);
        });
    }

    fn draw(&self, request: &Request) -> Result<Drawn, DrawError> {
        if self.cuts().iter().any(Cut::is_undercut) {
            let why = "a flank folds over itself: the roller cannot be guided on it";
            return Err(DrawError::NoOutline(why.into()));
        }
        let outlines = self.outlines(|curves| outline::profile(curves, request.fit));
        let mut outlines = outlines.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter();
        let Some(first) = outlines.next() else { return Err(DrawError::NoOutline("no flank".into())) };
        let hollow = |flank: &Flank| self.curves_of(flank).metal_side() < 0.0;
        let of = |(flank, outline): (&Flank, Outline)| PartFlank { layer: flank.layer, hollow: hollow(flank), outline };
        let machine = self.machine();
        let track = Track {
            first: self.flanks.first().map_or((Layer::CamProfile, false), |flank| (flank.layer, hollow(flank))),
            others: self.flanks.iter().skip(1).zip(outlines).map(of).collect(),
            blank: Some(MILLIMETRES * self.blank_radius),
            depth: self.depth().map(|depth| MILLIMETRES * depth),
        };
        let part = Part { track: Some(track), bore: super::part::bore(machine), ..Part::solid_plate(first) };
        let part = part.with_features(machine)?;
        let path = |radius: f64| self.outlines(|curves| outline::cutter_path(curves, radius, request.fit));
        let mut paths = request.cutter_radius.map_or_else(Vec::new, path).into_iter();
        Ok(Drawn { cutter_path: paths.next(), other_cutter_paths: paths.collect(), ..Drawn::of(vec![part]) })
    }

    /// Those of the disc, with the places of both flanks.
    fn rows(&self, samples: u32) -> Vec<Row> {
        self.disc.rows(samples).into_iter().map(|row| self.with_flanks(row)).collect()
    }

    fn row_on(&self, piece: usize, parameter: f64) -> Option<Row> {
        self.disc.row_on(piece, parameter).map(|row| self.with_flanks(row))
    }

    fn sections(&self, found: &DrawingEvidence<'_>) -> Vec<Section> {
        let mut sections = self.disc.sections(found);
        let place = sections.iter().position(|section| section.key == "outline").unwrap_or(sections.len());
        sections.insert(place, report::section(self, found));
        sections
    }

    fn mechanism(&self, drawn: &Drawn, samples: u32) -> MovingMechanism {
        self.disc.mechanism(drawn, samples)
    }

    fn part_view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        Ok(part_drawing::of_plane_part(self, drawn, self.view(drawn)?))
    }

    fn view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        sheet::view(self, drawn)
    }
}

impl Groove {
    fn with_flanks(&self, row: Row) -> Row {
        let Some((piece, angle)) = row.at else { return row };
        let place = |curves: Curves<'_>| {
            super::part::point_as_turned(self.machine(), curves.profile(piece, angle).point * MILLIMETRES)
        };
        let profile = self.curves(0).map(place);
        let radius = self.curves(0).map(|curves| radius_of_curvature(curves.profile(piece, angle).curvature));
        let outer = self.curves(1).map(place);
        let added = outer.into_iter().flat_map(|outer| [(&OUTER_X, outer.x), (&OUTER_Y, outer.y)]);
        let added = row.added.iter().copied().chain(added).collect();
        Row { profile, profile_radius: radius, added, ..row }
    }
}

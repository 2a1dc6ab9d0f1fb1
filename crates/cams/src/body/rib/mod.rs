//! A rib: a wall that two rollers of one follower hold between them, one on either side.
//!
//! `cam.base_radius` and the roller give the path of the middle between the rollers. Along the follower's path either roller is half of
//! `cam.roller_distance` from there: on a straight path at the lift ± D/2, on an arm l across it, on an arm √(l² + D²/4) that is turned by
//! ± atan(D/2l). Each roller has a path of its own, and each flank of the wall is the parallel of one of them.

mod figures;
mod report;

use super::closure::{self, Closure, Pairing};
use super::disc::delegate::body_of_its_disc;
use super::disc::{self, Disc, DiscRole, Hold};
use super::figures::with_subject;
use super::part::{PartFlank, Track, as_turned, point_as_turned};
use super::part_drawing;
use super::{
    Body, Cut, DrawError, DrawingEvidence, Drawn, Figures, Kind, Layer, Part, Request, RowFollower, broken_limit,
};
use crate::check::{AsWritten, Measures};
use crate::machine::{FollowerData, Machine, Rotation};
use crate::report::mechanism::MovingMechanism;
use crate::report::sheet::SheetView;
use crate::report::{CamMeasures, Section};
use crate::table::{AddedColumn, Row};
use camgen_kernel::document::cams;
use camgen_kernel::follower::{Follower, FollowerPlacement, SwingingRoller, TranslatingRoller};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::outline::{self, Outline, OutlineError};
use camgen_kernel::profile::{Curves, extremes};
use camgen_kernel::refusal::Refusal;
use std::sync::Arc;

/// The rib of any motion.
pub const RIB: Kind = Kind { command: cams::MAKE, noun: "rib cam", keys: cams::RIB };

/// The place of the flank under the inner roller.
const INNER_X: AddedColumn = AddedColumn { name: "inner_x_mm", after: "profile_y_mm" };
const INNER_Y: AddedColumn = AddedColumn { name: "inner_y_mm", after: "profile_y_mm" };

/// A wall between two rollers.
#[derive(Debug, Clone)]
pub struct Rib {
    /// Under the outer roller.
    outer: Disc,
    /// Around the inner roller.
    inner: Disc,
    /// The disc midway between the rollers, not cut; its base radius is that of the file.
    middle: Disc,
    /// Between the centres of the rollers, m.
    distance: f64,
}

impl Rib {
    /// The rib of a motion, at a speed of the cam (rpm) where it is known.
    ///
    /// # Errors
    /// [`Refusal`] when motion and follower do not fit each other, the velocity jumps, a roller does not reach its flank, or no radius keeps
    /// the limits.
    pub fn of(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>) -> Result<Self, Refusal> {
        let middle = Self::sized_middle(machine, motion, rpm)?;
        if let Some(corner) = extremes::corners(middle.curves()).first() {
            let remedy = "give other states or laws of the segments that meet there, or cam.body = \"disc\"";
            return Err(Refusal::new("the velocity of the follower jumps, and a rib has no corners")
                .at(format!("{:.3} deg", corner.at.to_degrees()))
                .remedy(remedy));
        }
        Self::about(middle)
    }

    /// The disc midway between the rollers, sized for both flanks; it is not cut, so its own curve breaks no limit.
    ///
    /// # Errors
    /// As [`Rib::of`].
    pub(in crate::body) fn sized_middle(
        machine: &Machine,
        motion: &Arc<dyn Motion>,
        rpm: Option<f64>,
    ) -> Result<Disc, Refusal> {
        let role = DiscRole { is_cut: false, ..DiscRole::with(&disc::GENERAL, Hold::Flanks, Self::broken_beside) };
        Disc::held(machine, Arc::clone(motion), rpm, role)
    }

    /// The first limit that a flank on either side of the path of `middle` breaks.
    fn broken_beside(middle: &Disc) -> Option<&'static str> {
        Self::about(middle.clone()).map_or(Some("reach"), |rib| rib.broken_limit())
    }

    /// On either side of the path of a disc.
    fn about(middle: Disc) -> Result<Self, Refusal> {
        let machine = middle.machine();
        let distance = machine.cam.track.roller_distance.unwrap_or(f64::NAN);
        let flank = |way: f64, counter: Option<f64>| {
            let (shape, prime) = beside(&**middle.follower(), 0.5 * way * distance)?;
            let own = FollowerData { shape, place: None, ..machine.follower.clone() };
            let own = if way > 0.0 { own } else { own.inside().ok_or_else(needs_a_roller)? };
            let base = prime - own.shape.element().offset();
            let own = machine.with_follower(own).with_base_radius(base);
            let hold = Hold::Pair { preload: 0.0, counter };
            let role = DiscRole::alone(&disc::GENERAL, hold);
            Disc::held(&own, Arc::clone(middle.motion()), middle.rpm(), role)
        };
        // The inner roller carries the force that would lift the outer one off.
        let (outer, inner) = (flank(1.0, None)?, flank(-1.0, Some(0.0))?);
        Ok(Self { outer, inner, middle, distance })
    }

    /// The first limit that the rib breaks, by the figures that its checks judge.
    fn broken_limit(&self) -> Option<&'static str> {
        let folds = self.cuts().iter().any(Cut::is_undercut).then_some("undercut");
        folds.or_else(|| broken_limit(self))
    }

    /// Either disc, with the name and the layer of its flank: the outer one first.
    fn flanks(&self) -> [(&Disc, Layer); 2] {
        [(&self.outer, Layer::RibOuter), (&self.inner, Layer::RibInner)]
    }

    fn outlines(&self, of: impl Fn(Curves<'_>) -> Result<Outline, OutlineError>) -> [Result<Outline, OutlineError>; 2] {
        self.flanks().map(|(disc, _)| {
            let outline = of(disc.curves())?;
            let contour = as_turned(self.machine(), outline.contour);
            Ok(Outline { contour, ..outline })
        })
    }

    /// How far the lifts that both flanks of a file give differ.
    fn closure(&self, written: &AsWritten<'_>) -> Option<Closure> {
        let [outer, inner] = written.outlines else { return None };
        Closure::of((&self.outer, outer), (&self.inner, inner), (Pairing::Together, written.tolerance_mm))
    }
}

fn needs_a_roller() -> Refusal {
    Refusal::new("a rib needs rollers").remedy("give [follower.roller] or [follower.swinging-roller]")
}

/// A roller that lies a distance (m) beside another one in the direction of a growing lift, on the same follower, with its prime radius, m.
fn beside(shape: &dyn Follower, by: f64) -> Result<(Arc<dyn Follower>, f64), Refusal> {
    let (place, prime) = shape.place().zip(shape.prime_radius()).ok_or_else(needs_a_roller)?;
    let too_near = || {
        let what = format!("the inner roller of the rib would lie {:.3} mm behind the shaft", MILLIMETRES * -by);
        Refusal::new(what).remedy("give a larger cam.base_radius or a smaller cam.roller_distance")
    };
    match place {
        FollowerPlacement::Offset { radius } => {
            let offset = place.chosen_by(shape);
            let height = ((prime - offset) * (prime + offset)).sqrt() + by;
            if !(height > 0.0) {
                return Err(too_near());
            }
            let prime = libm::hypot(height, offset);
            Ok((Arc::new(TranslatingRoller::new(prime, offset, radius)), prime))
        }
        FollowerPlacement::Pivot { arm, radius, side } => {
            let pivot = place.chosen_by(shape);
            let start = libm::acos((pivot * pivot + arm * arm - prime * prime) / (2.0 * pivot * arm));
            let (own_arm, turned) = (libm::hypot(arm, by), start + libm::atan2(by, arm));
            if !(turned > 0.0) {
                return Err(too_near());
            }
            let square = pivot * pivot + own_arm * own_arm - 2.0 * pivot * own_arm * libm::cos(turned);
            Ok((Arc::new(SwingingRoller::new(own_arm, pivot, radius, side)), square.sqrt()))
        }
    }
}

impl Body for Rib {
    fn kind(&self) -> &'static Kind {
        &RIB
    }

    body_of_its_disc!(outer);

    fn cuts(&self) -> Vec<Cut<'_>> {
        let mirrored: &[bool] = if self.machine().cam.rotation == Rotation::Clockwise { &[false] } else { &[true] };
        let flanks = [("outer", &self.outer, Layer::RibOuter), ("inner", &self.inner, Layer::RibInner)];
        flanks.map(|(name, disc, layer)| disc.cut_as(name, layer, mirrored)).to_vec()
    }

    fn measures(&self, of: &mut Measures<'_>) {
        with_subject(self, |subject| {
            self.measured(of, subject);
            self.measured_inside(of, subject);
            self.outer.measured_in_motion(of, subject);
            of.add(&closure::CHECK, |written| Closure::measure(self.closure(written).as_ref(), self));
        });
    }

    fn draw(&self, request: &Request) -> Result<Drawn, DrawError> {
        if self.cuts().iter().any(Cut::is_undercut) {
            return Err(DrawError::NoOutline("a flank folds over itself: its roller cannot follow it".into()));
        }
        let [outer, inner] = self.outlines(|curves| outline::profile(curves, request.fit));
        let inner = PartFlank { layer: Layer::RibInner, hollow: true, outline: inner? };
        let track = Track { first: (Layer::RibOuter, false), others: vec![inner], blank: None, depth: None };
        let part = Part { track: Some(track), ..Part::solid_plate(outer?) };
        let path = |radius: f64| self.outlines(|curves| outline::cutter_path(curves, radius, request.fit));
        let mut paths = request.cutter_radius.map(path).into_iter().flatten();
        Ok(Drawn { cutter_path: paths.next(), other_cutter_paths: paths.collect(), ..Drawn::of(vec![part]) })
    }

    /// Those of the outer roller, with the places of the inner flank.
    fn rows(&self, samples: u32) -> Vec<Row> {
        self.outer.rows(samples).into_iter().map(|row| self.with_inner_flank(row)).collect()
    }

    fn row_follower(&self) -> Option<RowFollower> {
        Some(RowFollower { name: "outer roller", greatest_pressure_angle: self.pressure_angle().value })
    }

    fn row_on(&self, piece: usize, parameter: f64) -> Option<Row> {
        self.outer.row_on(piece, parameter).map(|row| self.with_inner_flank(row))
    }

    fn sections(&self, found: &DrawingEvidence<'_>) -> Vec<Section> {
        let mut sections = self.outer.sections(found);
        if let Some(cam) = sections.iter_mut().find(|section| section.key == "cam") {
            *cam = self.cam_measures(found).section();
        }
        let place = sections.iter().position(|section| section.key == "outline").unwrap_or(sections.len());
        sections.insert(place, report::section(self, found));
        sections
    }

    fn mechanism(&self, drawn: &Drawn, samples: u32) -> MovingMechanism {
        self.outer.mechanism_with((&self.inner, 0.0), drawn, samples)
    }

    fn part_view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        Ok(part_drawing::of_plane_part(self, drawn, self.view(drawn)?))
    }

    fn view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        report::view(self, drawn)
    }
}

impl Rib {
    /// Figures of the section `cam`; its radii are midway between the rollers, as in the file.
    fn cam_measures(&self, found: &DrawingEvidence<'_>) -> CamMeasures {
        let middle = self.middle.cam_measures(found);
        CamMeasures {
            prime_radius_mm: middle.prime_radius_mm,
            base_radius_mm: middle.base_radius_mm,
            smallest_prime_radius_mm: middle.smallest_prime_radius_mm,
            ..self.outer.cam_measures(found)
        }
    }

    fn with_inner_flank(&self, row: Row) -> Row {
        let Some((piece, angle)) = row.at else { return row };
        let inner = self.inner.curves().profile(piece, angle).point * MILLIMETRES;
        let inner = point_as_turned(self.machine(), inner);
        let added = row.added.iter().copied().chain([(&INNER_X, inner.x), (&INNER_Y, inner.y)]).collect();
        Row { added, ..row }
    }
}

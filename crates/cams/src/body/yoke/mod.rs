//! A yoke: one disc between two parallel faces, or two rollers on a line through the shaft, of one follower that it pushes both ways.
//!
//! Both are on the same profile, half a turn apart, so that their lifts add up to the largest one: s(θ) + s(θ + π) = h. The breadth between the
//! faces is then 2 R_b + h cos δ under faces tilted by δ, and that between the near sides of two rollers 2 R_b + h.

mod report;

use super::closure::{self, Closure, Pairing};
use super::conjugate::CounterMotion;
use super::disc::delegate::{body_of_its_disc, figures_of_its_disc};
use super::disc::{Disc, DiscRole, Hold};
use super::figures::with_subject;
use super::part_drawing;
use super::{Body, Cut, DrawError, DrawingEvidence, Drawn, Figures, Kind, Request, broken_limit};
use crate::check::{AsWritten, Measure, Measures};
use crate::machine::{FollowerData, Machine};
use crate::report::mechanism::MovingMechanism;
use crate::report::sheet::SheetView;
use crate::report::{Section, shown};
use crate::table::Row;
use camgen_kernel::document::cams;
use camgen_kernel::follower::{Carrier, Element};
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::motion::Motion;
use camgen_kernel::numeric::extremum;
use camgen_kernel::profile::outline::OutlineError;
use camgen_kernel::profile::{Worst, lifts};
use camgen_kernel::refusal::Refusal;
use std::f64::consts::PI;
use std::sync::Arc;

/// The yoke of a motion.
pub const YOKE: Kind = Kind { command: cams::MAKE, noun: "yoke cam", keys: cams::YOKE };

/// Lifts half a turn apart add up to the largest one within this, m: rounding, and what a table of 15 digits leaves.
const SAME_LIFT: f64 = 1e-9;
/// A given breadth and base radius agree within this, m.
const SAME_BREADTH: f64 = 1e-9;
/// Places of a piece between which the largest difference is found, how many of its hills are followed, and golden sections.
const PLACES: u32 = 24;
const HILLS: usize = 3;
const SECTIONS: u32 = 40;

/// A disc between two faces or rollers.
#[derive(Debug, Clone)]
pub struct Yoke {
    /// Under the first face or roller.
    disc: Disc,
    /// The disc under the opposite face or roller, with the lift h − s half a turn later.
    opposite: Disc,
    /// Between the faces, or the near sides of the rollers, m.
    breadth: f64,
}

impl Yoke {
    /// The yoke of a motion, at a speed of the cam (rpm) where it is known.
    ///
    /// # Errors
    /// [`Refusal`] when the second half turn of the motion is not the first one upside down, when the breadth and the base radius contradict
    /// each other, or no radius keeps the limits.
    pub fn of(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>) -> Result<Self, Refusal> {
        Self::around(Self::sized_disc(machine, motion, rpm)?)
    }

    /// The disc under the first face or roller, sized for both sides.
    ///
    /// # Errors
    /// As [`Yoke::of`].
    pub(in crate::body) fn sized_disc(
        machine: &Machine,
        motion: &Arc<dyn Motion>,
        rpm: Option<f64>,
    ) -> Result<Disc, Refusal> {
        let top = lifts(&**motion).1;
        upside_down(&**motion, top)?;
        let machine = sized_by_breadth(machine, top * along_normal(machine))?;
        let hold = Hold::Pair { preload: 0.0, counter: None };
        let role = DiscRole::with(&YOKE, hold, Self::broken_opposite);
        Disc::held(&machine, Arc::clone(motion), rpm, role)
    }

    /// The first limit that `disc` breaks under the opposite face or roller.
    fn broken_opposite(disc: &Disc) -> Option<&'static str> {
        Self::around(disc.clone()).map_or(Some("reach"), |yoke| broken_limit(&yoke.opposite))
    }

    /// Adds the opposite face or roller to `disc`.
    fn around(disc: Disc) -> Result<Self, Refusal> {
        let (machine, motion) = (disc.machine(), disc.motion());
        let top = lifts(&**motion).1;
        let own = FollowerData { shape: Arc::clone(disc.follower()), place: None, ..machine.follower.clone() };
        let own = machine.with_follower(own).with_base_radius(disc.base_radius());
        let counter = Arc::new(CounterMotion::new(Arc::clone(motion), top, PI));
        let hold = Hold::Pair { preload: 0.0, counter: Some(top) };
        let opposite = Disc::held(&own, counter, disc.rpm(), DiscRole::alone(&YOKE, hold))?;
        let breadth = 2.0 * disc.base_radius() + top * along_normal(machine);
        Ok(Self { disc, opposite, breadth })
    }

    /// How the outline of a file closes between the faces or rollers.
    fn closure(&self, written: &AsWritten<'_>) -> Option<Closure> {
        let outline = written.outlines.first()?;
        Closure::of((&self.disc, outline), (&self.opposite, outline), (Pairing::Opposite, written.tolerance_mm))
    }
}

/// The travel of a face along its normal for a unit of lift.
fn along_normal(machine: &Machine) -> f64 {
    match (machine.follower.shape.element(), machine.follower.shape.carrier()) {
        (Element::Face, Carrier::Stem { tilt, .. }) => libm::cos(tilt),
        _ => 1.0,
    }
}

/// Refuses a motion whose lifts half a turn apart do not add up to the largest one.
fn upside_down(motion: &dyn Motion, top: f64) -> Result<(), Refusal> {
    let off = |at: f64| {
        let lift = |at: f64| {
            let (piece, inside) = motion.locate(at);
            motion.jet(piece, inside).s
        };
        (lift(at) + lift(at + PI) - top).abs()
    };
    let of_piece = |piece: &camgen_kernel::motion::Piece| {
        extremum::largest_of_hills(off, (piece.start, piece.end), PLACES, HILLS, SECTIONS)
    };
    let worst = motion.pieces().iter().map(of_piece).reduce(|a, b| if b.value > a.value { b } else { a });
    match worst.filter(|worst| !(worst.value <= SAME_LIFT)) {
        None => Ok(()),
        Some(worst) => {
            let (off, top) = (shown(MILLIMETRES * worst.value), shown(MILLIMETRES * top));
            let what = format!(
                "in a yoke the lifts half a turn apart add up to the largest one, {top} mm: here they are off by {off} mm"
            );
            let remedy = "give the segments of the first half turn alone: the second one follows from them";
            Err(Refusal::new(what).at(format!("{:.3} deg", worst.at.to_degrees())).remedy(remedy))
        }
    }
}

/// The machine with the base radius that its breadth leaves at this lift along the normal, m.
fn sized_by_breadth(machine: &Machine, lift: f64) -> Result<Machine, Refusal> {
    let Some(breadth) = machine.cam.track.breadth else { return Ok(machine.clone()) };
    let base = 0.5 * (breadth - lift);
    if !(base > 0.0) {
        let least = shown(MILLIMETRES * lift);
        let what = format!("a breadth of {} mm leaves no cam: the follower moves by {least} mm", shown(1e3 * breadth));
        return Err(Refusal::new(what).remedy(format!("cam.breadth must exceed {least} mm")));
    }
    if let Some(given) = machine.cam.base_radius.filter(|given| (given - base).abs() > SAME_BREADTH) {
        let [given, base, breadth] = [given, base, 2.0 * given + lift].map(|length| shown(MILLIMETRES * length));
        let what = format!("cam.base_radius is {given} mm, and cam.breadth leaves {base} mm");
        return Err(Refusal::new(what).remedy(format!("leave one of them out, or give cam.breadth = \"{breadth} mm\"")));
    }
    Ok(machine.with_base_radius(base))
}

impl Figures for Yoke {
    figures_of_its_disc!(disc, sized: disc);

    fn pressure_angles(&self) -> [Worst; 2] {
        let ([a, b], [c, d]) = (self.disc.pressure_angles(), self.opposite.pressure_angles());
        [a.or_larger(c), b.or_larger(d)]
    }

    fn least_radius(&self) -> Worst {
        self.disc.least_radius()
    }

    fn least_rolled_radius(&self) -> Worst {
        self.disc.least_rolled_radius()
    }

    fn min_concave_radius(&self) -> Option<Worst> {
        self.disc.min_concave_radius()
    }

    fn wall(&self) -> Option<(f64, Option<Worst>)> {
        self.disc.wall()
    }

    /// On whichever side the force is.
    fn contact_stress(&self) -> Option<Worst> {
        let found = self.disc.contact_stress().into_iter().chain(self.opposite.contact_stress());
        found.reduce(Worst::or_larger)
    }

    fn is_form_closed(&self) -> bool {
        true
    }
}

impl Body for Yoke {
    fn kind(&self) -> &'static Kind {
        &YOKE
    }

    body_of_its_disc!(disc);

    fn cuts(&self) -> Vec<Cut<'_>> {
        self.disc.cuts()
    }

    fn holes_within(&self, outline: &Contour) -> Vec<Entity> {
        self.disc.holes_within(outline)
    }

    fn measures(&self, of: &mut Measures<'_>) {
        with_subject(self, |subject| {
            self.measured(of, subject);
            self.disc.measured_in_motion(of, subject);
            of.add(&closure::CHECK, |written| -> Measure { Closure::measure(self.closure(written).as_ref(), self) });
        });
    }

    fn draw(&self, request: &Request) -> Result<Drawn, DrawError> {
        self.disc.draw(request)
    }

    fn rows(&self, samples: u32) -> Vec<Row> {
        self.disc.rows(samples)
    }

    fn row_on(&self, piece: usize, parameter: f64) -> Option<Row> {
        self.disc.row_on(piece, parameter)
    }

    fn sections(&self, found: &DrawingEvidence<'_>) -> Vec<Section> {
        let mut sections = self.disc.sections(found);
        sections.insert(1.min(sections.len()), report::section(self));
        sections
    }

    fn mechanism(&self, drawn: &Drawn, samples: u32) -> MovingMechanism {
        self.disc.mechanism_with((&self.opposite, PI), drawn, samples)
    }

    fn part_view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        Ok(part_drawing::of_plane_part(self, drawn, self.view(drawn)?))
    }

    fn view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        let mut view = self.disc.view(drawn)?;
        report::add_breadth(self, &mut view);
        Ok(view)
    }
}

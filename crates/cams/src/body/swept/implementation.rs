//! Every swept cam as a [`Body`].

use super::figures::least_fold;
use super::{SweptBody, SweptDrawing, measures};
use crate::body::disc::program;
use crate::body::in_groove::{self, GrooveForces};
use crate::body::part;
use crate::body::part_drawing;
use crate::body::picture::RIGID;
use crate::body::sheet::notes;
use crate::body::{Body, Cut, DrawError, DrawingEvidence, Drawn, Kind, Request, SweptFlanks};
use crate::check::Measures;
use crate::machine::Machine;
use crate::report::mechanism::MovingMechanism;
use crate::report::sheet::{SheetView, TitleFacts};
use crate::report::{Section, Speeds, degrees};
use crate::table::{Row, Table, turned};
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::motion::{Motion, Quantity};
use camgen_kernel::profile::followed;
use camgen_kernel::profile::outline::{OutlineError, SegmentKind, Side};
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;

impl<B: SweptBody> Body for B {
    fn kind(&self) -> &'static Kind {
        B::KIND
    }

    fn machine(&self) -> &Machine {
        &self.groove().machine
    }

    fn speeds(&self) -> Speeds {
        self.groove().rpm.map_or(Speeds::Any(()), Speeds::One)
    }

    /// None: a groove in space has no outline in a plane.
    fn cuts(&self) -> Vec<Cut<'_>> {
        Vec::new()
    }

    fn swept(&self) -> Option<&dyn SweptFlanks> {
        Some(self)
    }

    fn further_tables(&self, samples: u32, cutter: Option<f64>) -> Vec<Table> {
        self.tables(samples, cutter)
    }

    fn holes_within(&self, _outline: &Contour) -> Vec<Entity> {
        part::bore(&self.groove().machine).into_iter().collect()
    }

    fn shaft_speed(&self) -> Option<f64> {
        self.groove().speed()
    }

    fn largest_rates(&self) -> [f64; 2] {
        followed::largest_rates(&*self.groove().motion)
    }

    fn parameter_at(&self, point: Vector2<f64>) -> f64 {
        self.angle_of(point)
    }

    fn measures(&self, of: &mut Measures<'_>) {
        measures::take_measures(self, of);
    }

    fn draw(&self, request: &Request) -> Result<Drawn, DrawError> {
        if least_fold(self).value <= self.groove().farther() {
            return Err(DrawError::NoOutline(B::WORDS.folds.into()));
        }
        self.refuse_drawing()?;
        refuse_wishes::<B>(request)?;
        let swept = self.drawing(MILLIMETRES * request.fit.tolerance)?;
        Ok(Drawn { swept: Some(Box::new(swept)), ..Drawn::of(Vec::new()) })
    }

    fn height(&self) -> Option<(f64, f64)> {
        let (bottom, top) = self.ends();
        Some((MILLIMETRES * bottom, MILLIMETRES * top))
    }

    fn rows(&self, samples: u32) -> Vec<Row> {
        let motion = &self.groove().motion;
        let angles = (0..samples).map(|index| turned(index, samples, self.lobes()));
        angles.map(|at| row(self, at.cam_deg, motion.locate(at.angle))).collect()
    }

    fn row_on(&self, piece: usize, parameter: f64) -> Option<Row> {
        Some(row(self, degrees(parameter), (piece, parameter)))
    }

    fn leverage(&self) -> f64 {
        self.way_of_lift()
    }

    fn follower_motion(&self) -> Option<&dyn Motion> {
        Some(&*self.groove().motion)
    }

    fn sections(&self, found: &DrawingEvidence<'_>) -> Vec<Section> {
        let groove = self.groove();
        let mut sections = vec![self.own_section(found, in_groove::switches(self))];
        sections.extend(program::of_motion(&*groove.motion, groove.speed()));
        sections.extend(in_groove::sections(self));
        sections
    }

    fn mechanism(&self, drawn: &Drawn, samples: u32) -> MovingMechanism {
        self.moving(drawn, samples)
    }

    fn not_modelled(&self) -> Vec<&'static str> {
        [RIGID, B::WORDS.not_modelled].concat()
    }

    fn view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        let swept = drawn.swept.as_deref();
        let mut view = titled(self, swept);
        view.notes = notes(&self.groove().machine);
        self.fill_sheet(swept, &mut view);
        Ok(view)
    }

    fn part_view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        let Some(swept) = drawn.swept.as_deref() else { return Ok(part_drawing::without_mechanism(self.view(drawn)?)) };
        let mut view = titled(self, Some(swept));
        self.fill_drawing(swept, &mut view);
        view.notes.push(part_drawing::proposals::PROPOSED_NOTE.into());
        Ok(view)
    }
}

/// An empty sheet with the title of a cam.
fn titled<B: SweptBody>(body: &B, swept: Option<&SweptDrawing>) -> SheetView {
    let groove = body.groove();
    let (bottom, top) = body.ends();
    let facts = TitleFacts {
        thickness_mm: Some(MILLIMETRES * (top - bottom)),
        ..TitleFacts::of(&groove.machine, swept.map(|swept| groove.mass(swept.solid.volume)))
    };
    SheetView { facts, ..SheetView::default() }
}

/// Refuses what is wished of an outline: these cams have none.
fn refuse_wishes<B: SweptBody>(request: &Request) -> Result<(), Refusal> {
    let noun = B::WORDS.noun;
    let without = |what: &str| Refusal::new(format!("{what} is not drawn for a {noun}")).remedy("leave it out");
    if request.lead_in.is_some() || request.start.is_some() {
        return Err(without("a start of the cut"));
    }
    if request.fit.side != Side::Both || request.fit.laid != SegmentKind::Arcs {
        return Err(without("--side, or an outline of splines,"));
    }
    if request.points.is_some() {
        return Err(without("a table of points of an outline").remedy(B::WORDS.points));
    }
    Ok(())
}

/// The row of the table at a cam angle of a piece.
fn row<B: SweptBody>(body: &B, cam_deg: f64, (piece, angle): (usize, f64)) -> Row {
    let motion = &body.groove().motion;
    let lift = motion.jet(piece, angle);
    let swings = motion.quantity() == Quantity::Angle;
    Row {
        cam_deg: Some(cam_deg),
        at: Some((piece, angle)),
        lift: (!swings).then_some(lift),
        swing: swings.then_some(lift),
        position: motion.origin().map(|origin| origin + lift.s),
        pressure_angle_deg: Some(body.steepest(&lift).to_degrees()),
        swings,
        force: GrooveForces::of(body).map(|forces| forces.row((piece, angle))),
        added: body.added_columns((piece, angle)),
        ..Row::default()
    }
}

//! The pipeline as types: [`Spec`] → [`Cam`] → [`Drawing`] → [`Proven`] → [`FileSet`], each step a method of the one before. Each owns what it
//! needs: it can be kept, returned and sent to another thread. An [`Assembly`] is several cams that walk it together.
//!
//! There is no other path from one to the next, so nothing can be written that was not proved: the files are made of what
//! [`Drawing::prove`] read back from their own bytes.

use camgen_kernel::text::Text;
mod assembly;
mod builder;
mod cam_files;
mod check;
mod diagnosis;
mod error;
mod file_kind;
mod file_set;
mod inputs;
mod judged;
mod pair;
mod proven;
mod remedy;
mod spec;
mod stem;

pub use crate::tool_files::ExpectedFile;
pub use assembly::{Assembly, AssemblyDrawing, AssemblyReport, ProvenAssembly};
pub use builder::SOURCE as OF_BUILDER;
pub use builder::{
    ArmSide, Builder, FlatFaceFollower, KnifeEdgeFollower, PlaceChoice, RollerFollower, SwingingFaceFollower,
    SwingingRollerFollower,
};
pub use diagnosis::Alternative;
pub use error::Error;
pub use file_kind::FileKind;
pub use file_set::{FileSet, Output, Writing};
pub use judged::Judged;
pub use proven::Proven;
pub use remedy::TriedChanges;
pub use spec::Spec;
pub use spec::{SolvedBodies, WantedCams};

use crate::body::{self, Body, DrawError, Drawn, Request};
use crate::machine::MachineValues;
use crate::report::{Inputs, Report, Section};
use crate::tool_files::{DrawnCam, PlannedFile, plan};
use camgen_kernel::document::Input;
use std::sync::Arc;

/// A solved cam: exact curves, nothing drawn yet. A copy shares its body.
///
/// ```
/// # use camgen_cams as camgen;
/// use camgen::{Cam, Machine, Request, Spec};
///
/// let (machine, _) = Machine::load("valve", &[])?;
/// let cam: Cam = Spec::of_program(machine, None).ok_or("no motion")?.solve()?;
///
/// // A cam owns what it needs: it can be kept, and drawn in another thread.
/// let copy = cam.clone();
/// let coarse = std::thread::spawn(move || copy.draw(Request::within(50e-6))).join().expect("no panic")?;
/// let fine = cam.draw(Request::within(2e-6))?;
/// let arcs = |drawing: &camgen::Drawing| drawing.drawn().map(|drawn| drawn.parts[0].outline.contour.arcs());
/// assert!(arcs(&coarse) < arcs(&fine));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Cam {
    body: Arc<dyn Body>,
    /// How it is solved for another speed, where it is made for one.
    resolver: Option<diagnosis::Resolver>,
    /// What determines it in addition to its machine.
    own: Vec<Input>,
    /// The values of its machine as it was before it was solved.
    values: MachineValues,
}

impl Cam {
    /// What determines it.
    fn inputs(&self) -> Vec<Input> {
        let kind = self.body.kind();
        let mut inputs = vec![Input::word("command", kind.command)];
        inputs.extend(self.values.inputs(kind.keys));
        inputs.extend(self.own.iter().cloned());
        inputs
    }

    /// The cam itself: its curves, worst places and tables.
    #[must_use]
    pub fn body(&self) -> &dyn Body {
        &*self.body
    }

    /// Draws what is cut, within a tolerance (m) or as a [`Request`] asks. A tolerance alone is that of [`Request::usual`], with which the
    /// command line draws, too.
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::{Fit, Machine, Request, Side, Spec};
    ///
    /// let (machine, _) = Machine::load("feeder", &[])?;
    /// let cam = Spec::of_program(machine, None).ok_or("no motion")?.solve()?;
    /// // Never cut too deep, with the path of an Ø12 mm cutter.
    /// let fit = Fit { side: Side::Outside, ..Fit::from(10e-6) };
    /// let drawing = cam.draw(Request { cutter_radius: Some(0.006), ..Request::within(fit) })?;
    /// let drawn = drawing.drawn().ok_or("no outline")?;
    /// assert!(drawn.cutter_path.is_some());
    /// assert!(drawn.parts[0].outline.deviation < 0.010);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Draw`] when the outline cannot be drawn. A cam that has no outline at all, because it is undercut too
    /// far, gives a drawing without one: its checks say why, and it cannot be written.
    pub fn draw(&self, request: impl Into<Request>) -> Result<Drawing, Error> {
        let request = request.into();
        let inputs = self.inputs_for(&request);
        let request = request.resolved(&*self.body).map_err(Error::Draw)?;
        body::finer_than_the_lift(&*self.body, request.fit.tolerance).map_err(Error::Draw)?;
        let drawn = match self.body.draw(&request) {
            Ok(drawn) => Ok(body::start::started(&*self.body, &request, drawn).map_err(Error::Draw)?),
            Err(DrawError::NoOutline(why)) => Err(why),
            Err(DrawError::Refused(why)) => return Err(Error::Draw(why)),
        };
        let drawn_cam = DrawnCam { body: self.body(), request: &request, drawn: drawn.as_ref().ok() };
        let tool_files = plan(&drawn_cam).map_err(Error::Draw)?;
        Ok(Drawing { cam: self.clone(), request, inputs, drawn, tool_files })
    }

    /// Whether it is made from the inputs of a recorded run; how it is drawn does not matter.
    #[must_use]
    pub fn is_made_from(&self, recorded: &[Input]) -> bool {
        let inputs: Vec<Input> = self.inputs().into_iter().filter(|input| !inputs::is_of_request(input)).collect();
        let known = |input: &Input| inputs.contains(input);
        let left = recorded.iter().filter(|input| !known(input));
        inputs.iter().all(|input| recorded.contains(input)) && left.into_iter().all(inputs::is_of_request)
    }

    /// Everything that determines the part as it is drawn.
    fn inputs_for(&self, request: &Request) -> Vec<Input> {
        self.inputs().into_iter().chain(inputs::of_request(request)).collect()
    }
}

impl From<f64> for Request {
    fn from(tolerance: f64) -> Self {
        Request::usual(tolerance)
    }
}

/// A cam as drawn to a tolerance, not yet proved.
#[derive(Debug, Clone)]
pub struct Drawing {
    cam: Cam,
    request: Request,
    inputs: Vec<Input>,
    /// What was drawn, or why there is no outline.
    drawn: Result<Drawn, String>,
    /// What was requested for machines to run, not yet written.
    tool_files: Vec<PlannedFile>,
}

impl Drawing {
    /// What was drawn; `None` when there is no outline.
    #[must_use]
    pub fn drawn(&self) -> Option<&Drawn> {
        self.drawn.as_ref().ok()
    }
}

/// The report of a body, without files.
fn report(body: &dyn Body, inputs: Inputs, sections: Vec<Section>, checks: Vec<crate::report::Finding>) -> Report {
    let (kind, machine) = (body.kind(), body.machine());
    Report {
        command: kind.command.into(),
        noun: kind.noun.into(),
        machine: machine.name().to_owned(),
        rpm: body.speeds(),
        shaft: body.shaft(),
        inputs,
        sections,
        checks,
        other_checks: Vec::new(),
        notes: machine
            .idle_key_notes(kind.keys, kind.noun)
            .into_iter()
            .chain(machine.material_note())
            .map(Text::from)
            .collect(),
        not_modelled: body.not_modelled().into_iter().map(str::to_owned).collect(),
        files: Vec::new(),
        units: machine.units(),
    }
}

//! The pipeline as types: [`Spec`] → [`Cam`] → [`Drawing`] → [`Proven`] → [`FileSet`], each step a method of the one before.
//!
//! There is no other way from one to the next, so nothing can be written that was not proved: the files are made of what
//! [`Drawing::prove`] read back from their own bytes.

mod builder;
mod check;
mod diagnosis;
mod error;
mod file_set;
mod inputs;
mod judged;
mod proven;
mod spec;

pub use builder::Builder;
pub use error::Error;
pub use file_set::{FileSet, Output, Writing};
pub use judged::Judged;
pub use proven::Proven;
pub use spec::Spec;

use crate::body::disc::Compensated;
use crate::body::points::{self, PointTable, TableError};
use crate::body::{Body, DrawError, Drawn, Request};
use crate::document::Input;
use crate::numeric::parallel;
use crate::report::{Inputs, Report, Section};

/// A solved cam: exact curves, nothing drawn yet.
#[derive(Debug)]
pub struct Cam {
    body: Box<dyn Body>,
    /// The same for another speed, where it is made for one.
    again: Option<diagnosis::Again>,
    /// What determines it.
    inputs: Vec<Input>,
    /// The disc that takes its torque, and what it does by its law.
    second: Option<(Box<Cam>, Compensated)>,
}

impl Cam {
    /// The cam itself: its curves, worst places and tables.
    #[must_use]
    pub fn body(&self) -> &dyn Body {
        &*self.body
    }

    /// Draws what is cut, within a tolerance (m) or as a [`Request`] asks.
    ///
    /// # Errors
    /// [`Error::Draw`] when the outline cannot be drawn. A cam that has no outline at all, because it is undercut too
    /// far, gives a drawing without one: its checks say why, and it cannot be written.
    pub fn draw(&self, request: impl Into<Request>) -> Result<Drawing<'_>, Error> {
        let request = request.into();
        let second = self.second.as_ref().map(|(cam, _)| || cam.draw(request));
        let (drawing, second) = parallel::both(|| self.draw_alone(request), second);
        let second = second.transpose()?.map(Box::new);
        Ok(Drawing { second, ..drawing? })
    }

    /// Without the second disc.
    fn draw_alone(&self, request: Request) -> Result<Drawing<'_>, Error> {
        let inputs = self.inputs_for(&request);
        let request = request.resolved(&*self.body)?;
        let (drawn, points) = match self.body.draw(&request) {
            Ok(drawn) => {
                let points = match points::tables(self.body(), &request, &drawn.parts) {
                    // The check of the cutter's radius says so, too, and what would pass.
                    Err(TableError::Cutter(why)) => Err(why.to_string()),
                    tables => Ok(tables.map_err(DrawError::Points)?),
                };
                (Ok(drawn), points)
            }
            Err(DrawError::NoOutline(why)) => (Err(why), Ok(Vec::new())),
            Err(error) => return Err(error.into()),
        };
        Ok(Drawing { cam: self, request, inputs, drawn, points, second: None })
    }

    /// Everything that determines the part as it is drawn.
    fn inputs_for(&self, request: &Request) -> Vec<Input> {
        self.inputs.iter().cloned().chain(inputs::of_request(request)).collect()
    }
}

impl From<f64> for Request {
    fn from(tolerance: f64) -> Self {
        Request::within(tolerance)
    }
}

/// A cam as drawn to a tolerance, not yet proved.
#[derive(Debug, Clone)]
pub struct Drawing<'c> {
    cam: &'c Cam,
    request: Request,
    inputs: Vec<Input>,
    /// What was drawn, or why there is no outline.
    drawn: Result<Drawn, String>,
    /// The tables of points that were requested, or why there are none.
    points: Result<Vec<PointTable>, String>,
    /// The disc that takes its torque.
    second: Option<Box<Self>>,
}

impl Drawing<'_> {
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
        inputs,
        sections,
        checks,
        notes: machine.idle_keys_told(kind.keys, kind.noun),
        files: Vec::new(),
    }
}

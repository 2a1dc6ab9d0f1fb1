//! Tables of points of a body: which curve they give, and in which coordinates where nothing is said.

use super::{Body, Part, Request};
use crate::geometry::MILLIMETRES;
use crate::geometry::boundary::{Boundary, Stretch};
use crate::geometry::points::{Between, Form, Path, PointsError, Rows, Step, Wish, place};
use crate::numeric::parallel;
use crate::profile::envelope::NoEnvelope;
use crate::profile::outline::{OutlineError, Side};
use crate::profile::{Curves, boundary};

/// The curve that a table gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Given {
    /// The profile.
    Profile,
    /// The path of the roller's centre.
    Centre,
    /// The path of the centre of the cutter, or of the wheel.
    Cutter,
}

/// A table of points as it is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Points {
    /// The curve.
    pub given: Given,
    /// Its coordinates; `None` for polar ones, or x and y of a plate.
    pub form: Option<Form>,
    /// Its places; `None` for equal angles, or equal chord error on a plate.
    pub step: Option<Step>,
    /// How the control interpolates.
    pub between: Between,
}

impl Default for Points {
    fn default() -> Self {
        Self { given: Given::Profile, form: None, step: None, between: Between::Linear }
    }
}

/// The table of points of a section.
#[derive(Debug, Clone, PartialEq)]
pub struct PointTable {
    /// Speed of the section, rpm, where there are several.
    pub rpm: Option<f64>,
    /// Place of the section along the axis, m.
    pub z: f64,
    /// The curve.
    pub given: Given,
    /// Radius of the roller or the cutter whose centre is given, m.
    pub radius: Option<f64>,
    /// What it is and what it keeps, mm.
    pub wish: Wish,
    /// Whether the last row is the first again.
    pub closed: bool,
    /// Whether y is negated in the file: on a cam that turns counter-clockwise, and on the upper flank of a plate.
    pub flipped: bool,
    /// The rows, of a clockwise cam or of the lower flank.
    pub rows: Rows,
}

impl PointTable {
    /// Rows as they lie in the drawing, or those of the drawing as they lie on a clockwise cam: polar ones are the same, since the
    /// cam angle runs against the rotation.
    #[must_use]
    pub fn turned(&self, rows: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let flips = self.flipped && self.wish.form == Form::Plane;
        rows.iter().map(|[a, b]| if flips { [*a, -b] } else { [*a, *b] }).collect()
    }
}

/// Why there is no table of points.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// A plate does not turn.
    #[error("a plate rides on the bed and has no angle: it is given in x and y by equal chord error")]
    PlateHasNoAngle,
    /// There is no roller.
    #[error("a flat face has no centre; give the profile, or the path of a cutter")]
    NoCentre,
    /// The radius of the cutter is not known.
    #[error("the path of a cutter needs its radius, --cutter RADIUS, which rotary and make have")]
    NoCutter,
    /// A wheel does not leave one section of a surface.
    #[error(
        "a cutter on a conoid touches beside the section, where the surface leans along the axis; give the profile or the centre"
    )]
    ConoidHasNoCutter,
    /// The band lies on one side.
    #[error("an interpolated curve lies on both sides of the exact one; leave --side out")]
    OneSided,
    /// The cutter has no path, as the check of its radius says, too.
    #[error(transparent)]
    Cutter(OutlineError),
    /// The profile folds over itself.
    #[error(transparent)]
    Undercut(#[from] NoEnvelope),
    /// The curve has no such table.
    #[error(transparent)]
    Points(#[from] PointsError),
}

/// The exact curve of a section at a place along the axis (m) with a cutter (radius in m), mm, of a clockwise cam or of the lower
/// flank of a plate.
///
/// # Errors
/// [`TableError`] when there is no such curve.
pub fn traced(body: &dyn Body, z: f64, given: Given, cutter: Option<f64>) -> Result<Path<'_>, TableError> {
    if let Some(conoid) = body.spatial() {
        return match given {
            Given::Profile => Ok(Path::new(conoid.cut_at(z, false), true)),
            Given::Centre => Ok(Path::new(conoid.centre_at(z), true)),
            Given::Cutter => Err(TableError::ConoidHasNoCutter),
        };
    }
    let Some(curves) = body.plane() else { return Err(TableError::PlateHasNoAngle) };
    let path = |stretches: Vec<Stretch>, distance: f64| {
        let frame =
            move |piece: usize, at: f64| curves.touch(piece, at).curve.offset_inward(distance).scaled(MILLIMETRES);
        let closed = turns(curves);
        let join = if closed { Boundary::new } else { Boundary::open };
        Path::new(join(Box::new(frame), &stretches), closed)
    };
    match given {
        Given::Profile => {
            let sharp = body.least_radius().value <= curves.offset();
            Ok(path(boundary::stretches(curves, sharp)?, curves.offset()))
        }
        Given::Centre if body.roller_radius().is_none() => Err(TableError::NoCentre),
        Given::Centre => Ok(path(boundary::of_centre(curves), 0.0)),
        Given::Cutter => {
            let radius = cutter.filter(|_| turns(curves)).ok_or(TableError::NoCutter)?;
            let stretches = boundary::of_cutter(curves, radius).map_err(TableError::Cutter)?;
            Ok(path(stretches, curves.offset() - radius))
        }
    }
}

/// Whether the cam turns, or is run over once and back.
fn turns(curves: Curves<'_>) -> bool {
    curves.motion.period().is_some()
}

/// The tables of every section of a drawing; none where they are not asked for.
///
/// # Errors
/// [`TableError`] when a cam has no such table, or it would have too many points.
pub fn tables(body: &dyn Body, request: &Request, parts: &[Part]) -> Result<Vec<PointTable>, TableError> {
    let Some(asked) = request.points else { return Ok(Vec::new()) };
    if request.fit.side != Side::Both {
        return Err(TableError::OneSided);
    }
    let plate = body.plane().is_some_and(|curves| !turns(curves));
    let usual = if plate { (Form::Plane, Step::Chord) } else { (Form::Polar, Step::Angle) };
    let (form, step) = (asked.form.unwrap_or(usual.0), asked.step.unwrap_or(usual.1));
    if plate && (form, step) != usual {
        return Err(TableError::PlateHasNoAngle);
    }
    let wish = Wish { form, step, between: asked.between, tolerance: MILLIMETRES * request.fit.tolerance };
    let table = |part: &Part| {
        let path = traced(body, part.z, asked.given, request.cutter)?;
        let rows = place(&path, &wish)?;
        let radius = match asked.given {
            Given::Profile => None,
            Given::Centre => body.roller_radius(),
            Given::Cutter => request.cutter,
        };
        Ok(PointTable {
            rpm: part.rpm,
            z: part.z,
            given: asked.given,
            radius,
            wish,
            closed: path.is_closed(),
            flipped: plate || body.mirrored() == [true],
            rows,
        })
    };
    parallel::map(parts, table).into_iter().collect()
}

//! Tables of points of a body: which curve they give, in which coordinates where nothing is said, and what the follower feels of them.

use super::conoid::OfSection;
use super::{Body, Part, Request};
use crate::geometry::MILLIMETRES;
use crate::geometry::boundary::{Boundary, Stretch};
use crate::geometry::points::{Between, Feel, Felt, Form, Interpolant, Path, PointsError, Rows, Step, Wish, place};
use crate::motion::Quantity;
use crate::numeric::parallel;
use crate::profile::envelope::NoEnvelope;
use crate::profile::extremes;
use crate::profile::interpolated::Interpolated;
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
    /// What it is, and the distance that it keeps, mm.
    pub wish: Wish,
    /// Largest errors of velocity and acceleration that it was to keep, m or rad per rad and rad² of the shaft that gives the time;
    /// infinite where none was asked for.
    pub allowed: [f64; 2],
    /// What the follower feels of it.
    pub felt: Judged,
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

/// What the follower feels of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Judged {
    /// The largest errors of velocity and acceleration, m or rad per rad and rad² of the shaft that gives the time. That of the
    /// acceleration is infinite where the control goes straight.
    Errors([f64; 2]),
    /// Nothing can be told, for a reason.
    Not(NotJudged),
}

/// Why it cannot be told what the follower feels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NotJudged {
    /// The motion has infinite accelerations of its own.
    #[error("the velocity of the motion jumps")]
    VelocityJumps,
    /// The follower does not touch all of the profile that the motion asks for.
    #[error("the profile is undercut")]
    Undercut,
}

/// Why there is no table of points.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// A plate does not turn.
    #[error("a plate rides on the bed and has no angle: it is given in x and y by equal chord error")]
    PlateHasNoAngle,
    /// There is no roller.
    #[error("neither a flat face nor a knife edge has a centre; give the profile, or the path of a cutter")]
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
    /// An acceleration is asked of a curve that turns at every row.
    #[error(
        "--tolerance-acceleration cannot be kept by a control that goes straight from point to point: the velocity jumps at each; \
         use --points-between cubic where the control has splines, or --tolerance-acceleration none"
    )]
    LinearHasNoAcceleration,
    /// Velocity or acceleration are asked of a cam of which they cannot be told.
    #[error("no table can be held to a tolerance of velocity or acceleration: {0}")]
    NotJudged(NotJudged),
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

/// The follower on tables of a section at a place along the axis (m) with a cutter (radius in m).
///
/// # Errors
/// [`NotJudged`] when what it feels cannot be told.
pub fn feeling(body: &dyn Body, z: f64, given: Given, cutter: Option<f64>) -> Result<Box<dyn Feel + '_>, NotJudged> {
    if let Some(conoid) = body.spatial() {
        let slice = conoid.slice(z);
        if !extremes::corners(conoid.plane_of(&slice)).is_empty() {
            return Err(NotJudged::VelocityJumps);
        }
        return Ok(Box::new(OfSection::new(conoid, z, given == Given::Centre)));
    }
    let Some(curves) = body.plane() else { return Err(NotJudged::Undercut) };
    if !extremes::corners(curves).is_empty() {
        return Err(NotJudged::VelocityJumps);
    }
    if given != Given::Centre && body.least_radius().value <= curves.offset() {
        return Err(NotJudged::Undercut);
    }
    let inwards = match given {
        Given::Profile => curves.offset(),
        Given::Centre => 0.0,
        Given::Cutter => curves.offset() - cutter.unwrap_or(0.0),
    };
    Ok(Box::new(Interpolated::new(curves, inwards)))
}

/// The largest errors of velocity and acceleration on the curve that a control makes of a table, m or rad per rad and rad².
#[must_use]
pub fn felt_on(feel: &dyn Feel, curve: &Interpolant, between: Between) -> [f64; 2] {
    let errors = feel.errors(curve, [true, between == Between::Cubic], [f64::INFINITY; 2]);
    let worst = errors.iter().fold([0.0_f64; 2], |worst, own| [worst[0].max(own[0]), worst[1].max(own[1])]);
    match between {
        Between::Linear => [worst[0], f64::INFINITY],
        Between::Cubic => worst,
    }
}

/// Whether the cam turns, or is run over once and back.
fn turns(curves: Curves<'_>) -> bool {
    curves.motion.period().is_some()
}

/// Whether the follower of a body swings: what it feels is told in radians.
#[must_use]
pub fn swings(body: &dyn Body) -> bool {
    body.plane().is_some_and(|curves| curves.motion.quantity() == Quantity::Angle)
}

/// The rows that keep everything that is asked for; of what is only told where it is not kept, as much as can be.
fn rows(path: &Path<'_>, wish: &Wish, felt: Option<Felt<'_>>, strict: [bool; 2]) -> Result<Rows, PointsError> {
    match (place(path, wish, felt), felt) {
        (Err(PointsError::Felt { .. }), Some(felt)) if felt.allowed != demanded(felt.allowed, strict) => {
            let allowed = demanded(felt.allowed, strict);
            place(path, wish, Some(Felt { allowed, ..felt }))
        }
        (found, _) => found,
    }
}

/// Only what must be kept of what is allowed.
fn demanded(allowed: [f64; 2], strict: [bool; 2]) -> [f64; 2] {
    let [velocity, acceleration] = allowed;
    [if strict[0] { velocity } else { f64::INFINITY }, if strict[1] { acceleration } else { f64::INFINITY }]
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
    let allowed = [request.fit.motion.velocity, request.fit.motion.acceleration];
    if asked.between == Between::Linear && request.strict[1] && allowed[1].is_finite() {
        return Err(TableError::LinearHasNoAcceleration);
    }
    let table = |part: &Part| one(body, request, part, (asked.given, wish, allowed), plate);
    parallel::map(parts, table).into_iter().collect()
}

/// The table of a section.
fn one(
    body: &dyn Body,
    request: &Request,
    part: &Part,
    (given, wish, allowed): (Given, Wish, [f64; 2]),
    plate: bool,
) -> Result<PointTable, TableError> {
    let path = traced(body, part.z, given, request.cutter)?;
    let feel = feeling(body, part.z, given, request.cutter);
    if let (Err(NotJudged::VelocityJumps), true) = (&feel, demanded(allowed, request.strict) != [f64::INFINITY; 2]) {
        return Err(TableError::NotJudged(NotJudged::VelocityJumps));
    }
    let linear = wish.between == Between::Linear;
    let kept = [allowed[0], if linear { f64::INFINITY } else { allowed[1] }];
    let felt = feel.as_ref().ok().map(|feel| Felt { feel: &**feel, allowed: kept });
    let rows = rows(&path, &wish, felt, request.strict)?;
    let felt = match &feel {
        Ok(feel) => {
            let curve = Interpolant::new(&rows.rows, wish.form, wish.between, path.is_closed());
            Judged::Errors(felt_on(&**feel, &curve, wish.between))
        }
        Err(why) => Judged::Not(*why),
    };
    let radius = match given {
        Given::Profile => None,
        Given::Centre => body.roller_radius(),
        Given::Cutter => request.cutter,
    };
    Ok(PointTable {
        rpm: part.rpm,
        z: part.z,
        given,
        radius,
        wish,
        allowed,
        felt,
        closed: path.is_closed(),
        flipped: plate || body.mirrored() == [true],
        rows,
    })
}

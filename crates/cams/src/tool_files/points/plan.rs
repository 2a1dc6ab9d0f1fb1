//! Tables of points of a body: which curve they give, their default coordinates, and the errors of the follower's motion on them.

use crate::body::{Body, Cut, Drawn, Part, PointCurve, Request, curves, radius_of_roller};
use crate::report::{AsCutError, PointMeasures};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::boundary::{Boundary, BoundaryStretch};
use camgen_kernel::geometry::points::{
    ExactPath, Interpolant, MotionErrors, MotionLimit, PointCoordinates, PointInterpolation, PointRows, PointStep,
    PointTableSpec, PointsError, place,
};
use camgen_kernel::motion::Quantity;
use camgen_kernel::numeric::parallel;
use camgen_kernel::profile::extremes;
use camgen_kernel::profile::interpolated::FollowerOnTable;
use camgen_kernel::profile::outline::{OutlineError, Side};
use camgen_kernel::profile::{Curves, boundary};
use camgen_kernel::refusal::Refusal;

/// The table of points of a section.
#[derive(Debug, Clone, PartialEq)]
pub struct PointTable {
    /// Speed of the section, rpm, where there are several.
    pub rpm: Option<f64>,
    /// Which of the cuts of its body it is of.
    pub cut: usize,
    /// The curve.
    pub curve: PointCurve,
    /// Radius of the roller or the cutter whose centre is given, m.
    pub radius: Option<f64>,
    /// What it is, and the distance that it keeps, mm.
    pub wish: PointTableSpec,
    /// Largest errors of velocity and acceleration that it was to keep, m or rad per rad and rad² of the shaft that gives the time;
    /// infinite where none was given.
    pub allowed: [f64; 2],
    /// Errors of the follower's motion on it.
    pub errors: PointErrors,
    /// Whether the last row is the first again.
    pub closed: bool,
    /// Whether y is negated in the file: on a cam that turns counter-clockwise, and on the upper flank of a plate.
    pub flipped: bool,
    /// The rows, of a clockwise cam or of the lower flank.
    pub rows: PointRows,
}

impl PointTable {
    /// Rows as they lie in the drawing, or those of the drawing as they lie on a clockwise cam: polar ones are the same, since the
    /// cam angle runs against the rotation.
    #[must_use]
    pub fn turned(&self, rows: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let flips = self.flipped && self.wish.form == PointCoordinates::Plane;
        rows.iter().map(|[a, b]| if flips { [*a, -b] } else { [*a, *b] }).collect()
    }
}

/// Errors of the follower's motion on a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PointErrors {
    /// The largest errors of velocity and acceleration, m or rad per rad and rad² of the shaft that gives the time. That of the
    /// acceleration is infinite where the control goes straight.
    Known([f64; 2]),
    /// They are not known, for a reason.
    Unknown(NotJudged),
}

/// Why the errors of the follower's motion are not known.
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
    /// The cutter has no path, as the check of its radius says, too.
    #[error(transparent)]
    Cutter(OutlineError),
    /// Of any other cause.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

/// That a plate has no table by the angle.
fn without_angle() -> Refusal {
    Refusal::new("a plate does not turn and has no angle").remedy("give x and y by equal chord error")
}

/// The exact curve of a cut with a cutter (radius in m), mm, of a clockwise cam or of the lower
/// flank of a plate.
///
/// # Errors
/// [`TableError`] when there is no such curve.
pub fn traced<'a>(
    body: &'a dyn Body,
    cut: &Cut<'a>,
    which: PointCurve,
    cutter: Option<f64>,
) -> Result<ExactPath<'a>, TableError> {
    if let Some(surface) = body.surface() {
        return match which {
            PointCurve::Profile => Ok(ExactPath::new(surface.cut_at(cut.z), true)),
            PointCurve::Centre => Ok(ExactPath::new(surface.centre_at(cut.z), true)),
            PointCurve::Cutter => Err(Refusal::new(
                "a cutter on a conoid does not touch at the section, where the surface leans along the axis",
            )
            .remedy("give the profile or the centre")
            .into()),
        };
    }
    let Some(curves) = cut.curves else { return Err(without_angle().into()) };
    let path = |stretches: Vec<BoundaryStretch>, distance: f64| {
        let frame =
            move |piece: usize, at: f64| curves.touch(piece, at).curve.offset_inward(distance).scaled(MILLIMETRES);
        let closed = turns(curves);
        let join = if closed { Boundary::new } else { Boundary::open };
        ExactPath::new(join(Box::new(frame), &stretches), closed)
    };
    match which {
        PointCurve::Profile => {
            Ok(path(boundary::stretches(curves, cut.is_undercut()).map_err(Refusal::of)?, curves.offset()))
        }
        PointCurve::Centre if curves.roller_radius().is_none() => {
            Err(Refusal::new("neither a flat face nor a knife edge has a centre")
                .remedy("give the profile, or the path of a cutter")
                .into())
        }
        PointCurve::Centre => Ok(path(boundary::of_centre(curves), 0.0)),
        PointCurve::Cutter => {
            let unknown = || {
                Refusal::new("the path of a cutter needs its size, which rotary and make take")
                    .remedy("add --cutter-diameter, or --cutter-radius")
            };
            let radius = cutter.filter(|_| turns(curves)).ok_or_else(unknown)?;
            let stretches = boundary::of_cutter(curves, radius).map_err(TableError::Cutter)?;
            Ok(path(stretches, curves.offset() - curves.metal_side() * radius))
        }
    }
}

/// The follower on tables of a cut with a cutter (radius in m).
///
/// # Errors
/// [`NotJudged`] when its errors are not known.
pub fn motion_errors<'a>(
    body: &'a dyn Body,
    cut: &Cut<'a>,
    which: PointCurve,
    cutter: Option<f64>,
) -> Result<Box<dyn MotionErrors + 'a>, NotJudged> {
    if let Some(surface) = body.surface() {
        let mut smooth = true;
        surface.in_plane(cut.z, &mut |curves| smooth = extremes::corners(curves).is_empty());
        return if smooth {
            Ok(surface.motion_errors(cut.z, which == PointCurve::Centre))
        } else {
            Err(NotJudged::VelocityJumps)
        };
    }
    let Some(curves) = cut.curves else { return Err(NotJudged::Undercut) };
    if !extremes::corners(curves).is_empty() {
        return Err(NotJudged::VelocityJumps);
    }
    if which != PointCurve::Centre && cut.is_undercut() {
        return Err(NotJudged::Undercut);
    }
    let inwards = match which {
        PointCurve::Profile => curves.offset(),
        PointCurve::Centre => 0.0,
        PointCurve::Cutter => curves.offset() - curves.metal_side() * cutter.unwrap_or(0.0),
    };
    Ok(Box::new(FollowerOnTable::new(curves, inwards)))
}

/// The largest errors of velocity and acceleration on the curve that a control makes of a table, m or rad per rad and rad².
#[must_use]
pub fn largest_errors(feel: &dyn MotionErrors, curve: &Interpolant, between: PointInterpolation) -> [f64; 2] {
    let errors = feel.errors(curve, [true, between == PointInterpolation::Cubic], [f64::INFINITY; 2]);
    let worst = errors.iter().fold([0.0_f64; 2], |worst, own| [worst[0].max(own[0]), worst[1].max(own[1])]);
    match between {
        PointInterpolation::Linear => [worst[0], f64::INFINITY],
        PointInterpolation::Cubic => worst,
    }
}

/// Whether the cam turns, or is run over once and back.
fn turns(curves: Curves<'_>) -> bool {
    curves.motion.period().is_some()
}

/// Whether the follower of a body swings: its errors are in radians.
pub(super) fn swings(body: &dyn Body) -> bool {
    curves(body).is_some_and(|curves| curves.motion.quantity() == Quantity::Angle)
}

/// Whether the rates of a body are by the travel of a plate.
pub(super) fn by_travel(body: &dyn Body) -> bool {
    curves(body).is_some_and(|curves| curves.motion.is_by_travel())
}

/// The rows that keep all tolerances; where that takes too many, those that keep the tolerances that must be kept.
fn rows(
    path: &ExactPath<'_>,
    wish: &PointTableSpec,
    limit: Option<MotionLimit<'_>>,
    strict: [bool; 2],
) -> Result<PointRows, PointsError> {
    match (place(path, wish, limit), limit) {
        (Err(PointsError::TooManyForMotion { .. }), Some(limit))
            if limit.allowed != demanded(limit.allowed, strict) =>
        {
            let allowed = demanded(limit.allowed, strict);
            place(path, wish, Some(MotionLimit { allowed, ..limit }))
        }
        (found, _) => found,
    }
}

/// Only what must be kept of what is allowed.
fn demanded(allowed: [f64; 2], strict: [bool; 2]) -> [f64; 2] {
    let [velocity, acceleration] = allowed;
    [if strict[0] { velocity } else { f64::INFINITY }, if strict[1] { acceleration } else { f64::INFINITY }]
}

/// The tables of every section of a drawing; none where they were not requested.
///
/// # Errors
/// [`TableError`] when a cam has no such table, or it would have too many points.
pub fn tables(body: &dyn Body, request: &Request, drawn: &Drawn) -> Result<Vec<PointTable>, TableError> {
    let Some(asked) = request.points else { return Ok(Vec::new()) };
    if request.fit.side != Side::Both {
        return Err(Refusal::new("an interpolated curve lies on both sides of the exact one")
            .remedy("leave --side out")
            .into());
    }
    let plate = curves(body).is_some_and(|curves| !turns(curves));
    let usual =
        if plate { (PointCoordinates::Plane, PointStep::Chord) } else { (PointCoordinates::Polar, PointStep::Angle) };
    let (form, step) = (asked.form.unwrap_or(usual.0), asked.step.unwrap_or(usual.1));
    if plate && (form, step) != usual {
        return Err(without_angle().into());
    }
    let wish = PointTableSpec { form, step, between: asked.between, tolerance: request.fit.tolerance_mm() };
    let allowed = [request.fit.motion.velocity, request.fit.motion.acceleration];
    if asked.between == PointInterpolation::Linear && request.strict[1] && allowed[1].is_finite() {
        return Err(Refusal::new(
            "--tolerance-acceleration cannot be kept by a control that goes straight from point to point: the \
             velocity jumps at each",
        )
        .remedy("use --points-between cubic where the control has splines, or --tolerance-acceleration none")
        .into());
    }
    let cuts = body.cuts();
    let all: Vec<(usize, &Cut<'_>, &Part)> =
        cuts.iter().zip(drawn.outlines()).enumerate().map(|(index, (cut, (part, ..)))| (index, cut, part)).collect();
    let table = |of: &(usize, &Cut<'_>, &Part)| one(body, request, *of, (asked.curve, wish, allowed));
    parallel::map(&all, table).into_iter().collect()
}

/// The table of a section.
fn one(
    body: &dyn Body,
    request: &Request,
    (index, cut, part): (usize, &Cut<'_>, &Part),
    (which, wish, allowed): (PointCurve, PointTableSpec, [f64; 2]),
) -> Result<PointTable, TableError> {
    let path = traced(body, cut, which, request.cutter_radius)?;
    let feel = motion_errors(body, cut, which, request.cutter_radius);
    if let (Err(NotJudged::VelocityJumps), true) = (&feel, demanded(allowed, request.strict) != [f64::INFINITY; 2]) {
        let what = "no table can be held to a tolerance of velocity or acceleration";
        return Err(Refusal::of(NotJudged::VelocityJumps).context(what).into());
    }
    let linear = wish.between == PointInterpolation::Linear;
    let kept = [allowed[0], if linear { f64::INFINITY } else { allowed[1] }];
    let limit = feel.as_ref().ok().map(|feel| MotionLimit { motion: &**feel, allowed: kept });
    let rows = rows(&path, &wish, limit, request.strict).map_err(Refusal::from)?;
    let errors = match &feel {
        Ok(feel) => {
            let curve = Interpolant::new(&rows.rows, wish.form, wish.between, path.is_closed());
            PointErrors::Known(largest_errors(&**feel, &curve, wish.between))
        }
        Err(why) => PointErrors::Unknown(*why),
    };
    let radius = match which {
        PointCurve::Profile => None,
        PointCurve::Centre => radius_of_roller(body),
        PointCurve::Cutter => request.cutter_radius,
    };
    Ok(PointTable {
        rpm: part.rpm,
        cut: index,
        curve: which,
        radius,
        wish,
        allowed,
        errors,
        closed: path.is_closed(),
        flipped: cut.mirrored.contains(&true),
        rows,
    })
}

/// The figures of a table, for the report.
pub(super) fn measures(body: &dyn Body, table: &PointTable) -> PointMeasures {
    let swings = swings(body);
    let by_travel = by_travel(body);
    let sizes = AsCutError::sizes(swings, by_travel);
    let [velocity, acceleration] = match table.errors {
        PointErrors::Known([velocity, acceleration]) => {
            [sizes[0] * velocity, sizes[1] * acceleration].map(|error| Some(error).filter(|error| error.is_finite()))
        }
        PointErrors::Unknown(_) => [None; 2],
    };
    PointMeasures {
        rpm: table.rpm,
        rows: table.rows.rows.len(),
        interpolation: if table.wish.between == PointInterpolation::Linear { "linear" } else { "cubic" },
        tolerance_mm: table.wish.tolerance,
        error_mm: table.rows.error,
        swings,
        by_travel,
        velocity_error: velocity,
        acceleration_error: acceleration,
    }
}

//! What determines a part: the values of its machine, how it is solved, and how it is drawn.

use crate::body::points::{Given, Points};
use crate::body::{Body, RateTolerance, Request};
use crate::document::Input;
use crate::geometry::points::{Between, Form, Step};
use crate::motion::equation_18::{ExactOn, Solver};
use crate::profile::Curves;
use crate::profile::outline::{Laid, Side};
use crate::report::sha256;

/// Places at which a motion is sampled in each of its pieces. A motion of one's own is known by these alone.
const SAMPLES: u32 = 64;

pub(super) fn of_wedge(solver: Solver, exact_on: ExactOn) -> Vec<Input> {
    let balance = match exact_on {
        ExactOn::Braking => "braking",
        ExactOn::Return => "return",
        ExactOn::Mean => "mean",
    };
    let solver = match solver {
        Solver::Ode { tolerance } => Input::new("solver", format!("ode {tolerance}"), "ode"),
        Solver::Paper { stations } => Input::word("solver", format!("paper, {stations} stations")),
    };
    vec![solver, Input::word("balance", balance)]
}

/// Of a body that code has solved in a way the specification cannot tell: samples of its exact curves.
pub(super) fn of_own(body: &dyn Body) -> Vec<Input> {
    let mut text = format!("{} {:?}\n", body.speeds(), body.shaft_speed());
    if let Some(curves) = body.plane() {
        sample(&curves, &mut text);
    }
    if let Some(conoid) = body.spatial() {
        for (_, z, _) in conoid.cuts() {
            text.push_str(&format!("z {z}\n"));
            sample(&conoid.plane_of(&conoid.slice(z)), &mut text);
        }
    }
    let mut hash = sha256(text.as_bytes());
    hash.truncate(16);
    vec![Input::word("motion", hash)]
}

fn sample(curves: &Curves<'_>, text: &mut String) {
    for (index, piece) in curves.motion.distinct().iter().enumerate() {
        text.push_str(&format!("piece {} {}\n", piece.start, piece.end));
        if !curves.motion.is_rolled(index) {
            text.push_str("no follower\n");
        }
        for sample in 0..=SAMPLES {
            let share = f64::from(sample) / f64::from(SAMPLES);
            let at = if sample == SAMPLES { piece.end } else { piece.start + share * (piece.end - piece.start) };
            let (lift, point) = (curves.motion.jet(index, at), curves.touch(index, at).curve.point);
            text.push_str(&format!("{} {} {} {} {}\n", lift.s, lift.ds, lift.dds, point.x, point.y));
        }
    }
}

/// Of what a drawing must contain. Whether errors refuse it, and which files show it, does not change the part.
pub(super) fn of_request(request: &Request) -> Vec<Input> {
    let fit = &request.fit;
    let side = match fit.side {
        Side::Both => "both",
        Side::Inside => "inside",
        Side::Outside => "outside",
    };
    let outline = match fit.laid {
        Laid::Arcs => "arcs",
        Laid::Splines => "spline",
    };
    let [velocity, acceleration] = request.rates;
    let mut inputs = vec![
        Input::quantity("tolerance", fit.tolerance, ("um", 1e-6)),
        Input::word("side", side),
        Input::word("outline", outline),
        of_rate("tolerance-velocity", velocity, fit.motion.velocity),
        of_rate("tolerance-acceleration", acceleration, fit.motion.acceleration),
    ];
    inputs.extend(request.cutter.map(|radius| Input::quantity("cutter", radius, ("mm", 1e-3))));
    inputs.extend(request.points.into_iter().flat_map(of_points));
    inputs
}

fn of_rate(name: &str, asked: Option<RateTolerance>, own: f64) -> Input {
    match asked {
        Some(RateTolerance::Share(share)) => {
            let told = Input::quantity(name, share, ("%", 0.01));
            Input::new(name, format!("{} of the largest", told.value), told.typed)
        }
        Some(RateTolerance::Rate { value, swing, by_time }) => {
            let unit = if swing { "rad" } else { "m" };
            let per = if by_time { "by time" } else { "by angle" };
            Input::word(name, format!("{value} {unit} {per}"))
        }
        None if own.is_finite() => Input::word(name, format!("{own} by angle")),
        None => Input::word(name, "none"),
    }
}

/// What is not by default of a table of points.
fn of_points(points: Points) -> Vec<Input> {
    let given = match points.given {
        Given::Profile => None,
        Given::Centre => Some("centre"),
        Given::Cutter => Some("cutter"),
    };
    let form = points.form.map(|form| match form {
        Form::Polar => "polar",
        Form::Plane => "xy",
    });
    let step = points.step.map(|step| match step {
        Step::Angle => "angle",
        Step::Chord => "chord",
    });
    let between = match points.between {
        Between::Linear => None,
        Between::Cubic => Some("cubic"),
    };
    let all = [("points-of", given), ("points-as", form), ("points-step", step), ("points-between", between)];
    all.into_iter().filter_map(|(name, word)| Some(Input::word(name, word?))).collect()
}

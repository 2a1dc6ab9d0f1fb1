//! The inputs that determine a part: the values of its machine, how it is solved, and how it is drawn.

use crate::body::{Body, PointCurve, Points, RateTolerance, Request};
use crate::machine::UNITS_KEY;
use crate::report::sha256;
use camgen_kernel::document::{Input, NamedChoice};
use camgen_kernel::geometry::lead_in::LeadInForm;
use camgen_kernel::geometry::points::PointInterpolation;
use camgen_kernel::profile::Curves;

/// Places at which a motion is sampled in each of its pieces. A motion of one's own is known by these alone.
const SAMPLES: u32 = 64;

/// Inputs of a body solved by code that the specification cannot describe: samples of its exact curves.
pub(super) fn of_own(body: &dyn Body) -> Vec<Input> {
    let mut text = format!("{} {:?}\n", body.speeds(), body.shaft_speed());
    for cut in body.cuts() {
        if let Some(curves) = cut.curves {
            sample(&curves, &mut text);
        } else if let Some(surface) = body.surface() {
            text.push_str(&format!("z {}\n", cut.z));
            surface.in_plane(cut.z, &mut |curves| sample(&curves, &mut text));
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

/// Inputs of a request for a drawing. Whether errors refuse it, and which files show it, does not change the part.
pub(super) fn of_request(request: &Request) -> Vec<Input> {
    let fit = &request.fit;
    let [velocity, acceleration] = request.rates;
    let mut inputs = vec![
        Input::quantity("tolerance", fit.tolerance, ("um", 1e-6)),
        Input::word("side", fit.side.word()),
        Input::word("outline", fit.laid.word()),
        of_rate("tolerance-velocity", velocity, fit.motion.velocity),
        of_rate("tolerance-acceleration", acceleration, fit.motion.acceleration),
    ];
    inputs.extend(request.cutter_radius.map(|radius| Input::quantity("cutter-diameter", 2.0 * radius, ("mm", 1e-3))));
    inputs.extend(request.points.into_iter().flat_map(of_points));
    inputs.extend(request.start.map(|start| Input::quantity("start", start, ("deg", 1_f64.to_radians()))));
    inputs
        .extend(request.lead_in.map(|lead_in| Input::quantity(lead_in_key(lead_in.form), lead_in.size, ("mm", 1e-3))));
    inputs
}

/// Whether an input is one of a request for a drawing.
pub(super) fn is_of_request(input: &Input) -> bool {
    let drawing = [
        "tolerance",
        "side",
        "outline",
        "tolerance-velocity",
        "tolerance-acceleration",
        "cutter",
        "cutter-diameter",
        "start",
        UNITS_KEY,
    ];
    let of_form = LeadInForm::ALL.iter().any(|(_, form)| input.key == lead_in_key(*form));
    drawing.contains(&input.key.as_str()) || of_form || input.key.starts_with("points-")
}

/// The key of a lead-in of a form.
fn lead_in_key(form: LeadInForm) -> &'static str {
    match form {
        LeadInForm::Tangent => "lead-in-tangent",
        LeadInForm::Arc => "lead-in-arc",
    }
}

fn of_rate(name: &str, asked: Option<RateTolerance>, own: f64) -> Input {
    match asked {
        Some(RateTolerance::Share(share)) => {
            let input = Input::quantity(name, share, ("%", 0.01));
            Input::new(name, format!("{} of the largest", input.value), input.typed)
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

/// The inputs of a table of points that differ from the default.
fn of_points(points: Points) -> Vec<Input> {
    let all = [
        ("points-of", Some(points.curve).filter(|given| *given != PointCurve::Profile).map(NamedChoice::word)),
        ("points-as", points.form.map(NamedChoice::word)),
        ("points-step", points.step.map(NamedChoice::word)),
        (
            "points-between",
            Some(points.between).filter(|between| *between != PointInterpolation::Linear).map(NamedChoice::word),
        ),
    ];
    all.into_iter().filter_map(|(name, word)| Some(Input::word(name, word?))).collect()
}

//! The diagrams of a brake: tension over the roll, K over the wrap (figure 2), tension over the belt's speed.

use super::braking::LoadedBrake;
use super::{PLACES, TensionDisc, picture};
use crate::brake::machine::{BeltMode, BrakeData};
use crate::brake::mechanics::ends::euler_coefficient;
use crate::brake::mechanics::{FramePose, Web};
use camgen_cams::report::diagram::{Diagram, PlottedValue, diagram};
use camgen_cams::report::plot::{CurveStroke, Plot, PlotBand, PlotCurve, PlotPanel, PlotPoint, figure};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::numeric::extremum::Extremum;
use std::f64::consts::PI;

/// The columns that are drawn together.
pub(super) const DIAGRAMS: &[Diagram] = &[
    diagram(
        "tension",
        "Web tension",
        &[("tension", "this brake"), ("tension_printed", "printed moment")],
        &[],
        PlottedValue::Itself,
    ),
    diagram(
        "belt",
        "Tension of the belt",
        &[("belt_slack", "slack span"), ("belt_tight", "tight span")],
        &[],
        PlottedValue::Itself,
    ),
    diagram(
        "arms",
        "Arms about the pivot",
        &[("weight_arm", "weight"), ("press_arm", "press"), ("tight_arm", "tight span"), ("slack_arm", "slack span")],
        &[],
        PlottedValue::Itself,
    ),
    diagram(
        "frame",
        "Angle of the frame, and wrap",
        &[("frame", "frame"), ("wrap", "wrap")],
        &[],
        PlottedValue::Itself,
    ),
    diagram("cam-moment", "Moment of the disc on the frame", &[("cam_moment", "moment")], &[], PlottedValue::Itself),
];

/// Wraps of figure 2, and steps of its curves.
const LEAST_WRAP: f64 = 0.05;
const LARGEST_WRAP: f64 = PI;
const STEPS: u32 = 120;
/// Range of belt speeds about the strain branch, over the strain at the plateau.
const AROUND: f64 = 1.6;
const THOUSANDTHS: f64 = 1e3;

/// Equal steps from one value to another, both included.
fn between(from: f64, to: f64) -> impl Iterator<Item = f64> {
    (0..=STEPS).map(move |i| from + (to - from) * f64::from(i) / f64::from(STEPS))
}

/// How far the tension leaves the wanted one, or changes over the roll.
fn headline(braking: &LoadedBrake<'_>, spread_limit: f64, held: Option<&TensionDisc<'_>>) -> String {
    let range = braking.tensions();
    let (least, largest) = (range.least.value, range.largest.value);
    let spread = 100.0 * (largest - least) / largest;
    let with = if held.is_some() { "The disc holds the web" } else { "The web is held" };
    if spread < NOTHING {
        return format!("{with} at {} N over the whole roll", figure(largest));
    }
    let apart = figure((10.0 * spread).round() / 10.0);
    let judged = if spread > 100.0 * spread_limit {
        format!("{apart} % apart, at most {} % allowed", figure(100.0 * spread_limit))
    } else {
        format!("{apart} % apart, {} N wanted", figure(braking.data.tension))
    };
    format!("{with} at {} to {} N over the roll: {judged}", figure(least), figure(largest))
}

/// A spread below this is none, %.
const NOTHING: f64 = 0.05;

/// The brake on paper, with the frame to scale next to its diagrams.
pub(super) fn plot(
    machine: &str,
    spread_limit: f64,
    braking: &LoadedBrake<'_>,
    held: Option<&TensionDisc<'_>>,
) -> Plot {
    let wraps = [braking.ends[0].wrap, braking.ends[1].wrap];
    let grip = braking.grip(&braking.ends[0]);
    let mut own = vec![coefficient(braking.brake.friction(), &wraps), by_belt_speed(braking.data, grip)];
    own.extend(braking.data.web.map(|web| by_strain(&web, grip)));
    let [full, run_down] = braking.ends.map(|pose| figure(MILLIMETRES * pose.radius));
    Plot {
        title: headline(braking, spread_limit, held),
        subtitle: format!(
            "{machine}: belt brake, weight {} N, friction {}, roll from {full} down to {run_down} mm",
            figure(braking.weight),
            figure(braking.brake.friction())
        ),
        places: "radius of the roll, mm".into(),
        panels: vec![PlotPanel { height: 1.4, ..over_roll(braking, spread_limit, held) }],
        own,
        scheme: Some(picture::scheme(braking)),
        ..Plot::default()
    }
}

/// P over R: without a disc, by the printed moment, and with the disc by its law and as cut.
fn over_roll(braking: &LoadedBrake<'_>, spread_limit: f64, held: Option<&TensionDisc<'_>>) -> PlotPanel {
    let poses: Vec<FramePose> = braking.radii(PLACES).filter_map(|radius| braking.brake.at(radius).ok()).collect();
    let plain = LoadedBrake { disc: None, ..braking.clone() };
    let printed = by_radius(&poses, |pose| braking.brake.tension_printed(braking.printed_weight, pose));
    let own = by_radius(&poses, |pose| plain.tension(pose));
    let mut curves = vec![PlotCurve::grey("printed moment", printed)];
    if let Some(held) = held {
        curves.push(PlotCurve::new("without the disc", 1, own).stroked(CurveStroke::Dashed));
        if let Some(cut) = held.as_cut {
            let mut points: Vec<[f64; 2]> =
                cut.points.iter().map(|point| [MILLIMETRES * point.radius, point.tension]).collect();
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            curves.push(PlotCurve::new("as cut", 2, points).stroked(CurveStroke::Thin));
        }
        curves.push(PlotCurve::new("with the disc", 0, by_radius(&poses, |pose| braking.tension(pose))));
    } else {
        curves.push(PlotCurve::new("this brake", 0, own));
    }
    let range = braking.tensions();
    let point = |at: &Extremum| PlotPoint::dot([MILLIMETRES * at.at, at.value], 0, format!("{} N", figure(at.value)));
    // Counted from the largest tension, as the check does.
    let least = (1.0 - spread_limit) * range.largest.value;
    let too_low = format!("more than {} % below the largest", figure(100.0 * spread_limit));
    PlotPanel {
        points: vec![point(&range.least), point(&range.largest)],
        bands: vec![PlotBand::below(least, too_low)],
        ..PlotPanel::new("Web tension, N", curves)
    }
}

/// A value over the radius, mm, from the run-down roll on.
fn by_radius(poses: &[FramePose], value: impl Fn(&FramePose) -> f64) -> Vec<[f64; 2]> {
    poses.iter().rev().map(|pose| [MILLIMETRES * pose.radius, value(pose)]).collect()
}

/// Figure 2: K over the wrap for the friction and a fifth more, with marks at the ends of the roll.
pub(super) fn coefficient(friction: f64, wraps: &[f64]) -> (String, PlotPanel) {
    let more = 1.2 * friction;
    let curves = vec![
        PlotCurve::grey(format!("f = {}", figure(more)), coefficient_by_wrap(more)),
        PlotCurve::new(format!("f = {}", figure(friction)), 0, coefficient_by_wrap(friction)),
    ];
    let points = wraps.iter().zip(["full roll", "run-down roll"]).map(|(wrap, name)| {
        let at = [wrap.to_degrees(), euler_coefficient(*wrap, friction)];
        PlotPoint::dot(at, 0, format!("{name}: {}", figure(at[1])))
    });
    let panel = PlotPanel { points: points.collect(), ..PlotPanel::new("Grip K of the belt by (7)", curves) };
    ("wrap, degrees".into(), panel)
}

fn coefficient_by_wrap(friction: f64) -> Vec<[f64; 2]> {
    between(LEAST_WRAP, LARGEST_WRAP).map(|wrap| [wrap.to_degrees(), euler_coefficient(wrap, friction)]).collect()
}

/// P over the belt's speed: the grip at any speed, the strain branch near V, and the printed (2).
pub(super) fn by_belt_speed(data: &BrakeData, grip: f64) -> (String, PlotPanel) {
    let branch = match &data.web {
        Some(web) => {
            let corner = web.belt_speed(grip);
            let free = 1.0 + web.wound_strain;
            vec![[0.0, grip], [corner, grip], [free, 0.0]]
        }
        None => vec![[0.0, grip], [1.0, grip]],
    };
    let curves =
        vec![PlotCurve::grey("printed (2)", vec![[0.0, grip], [1.0, 0.0]]), PlotCurve::new("exact", 0, branch)];
    let slips = data.mode == BeltMode::Slip;
    let own = slips.then(|| PlotPoint::dot([data.belt_speed_ratio, grip], 0, format!("this belt: {} N", figure(grip))));
    let panel = PlotPanel {
        points: own.into_iter().collect(),
        ..PlotPanel::new("Tension on the full roll over the belt's speed, N", curves)
    };
    ("V_z/V, belt over web".into(), panel)
}

/// P over the belt's speed near the strain branch, where a thousandth of the speed is all of the tension.
fn by_strain(web: &Web, grip: f64) -> (String, PlotPanel) {
    let free = 1.0 + web.wound_strain;
    let slowest = free / (1.0 + AROUND * web.strain(grip));
    // Slower from left to right, by thousandths of the web's speed.
    let points = between(free, slowest)
        .map(|ratio| [THOUSANDTHS * (1.0 - ratio), web.tension_within(grip, ratio).max(0.0)])
        .collect();
    let name = "Tension near V, N: strain up to the grip";
    ("1 − V_z/V, thousandths".into(), PlotPanel::new(name, vec![PlotCurve::new("", 0, points)]))
}

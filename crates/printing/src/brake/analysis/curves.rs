//! The diagrams of a brake: tension over the roll, K over the wrap (figure 2), tension over the belt's speed.

use super::braking::LoadedBrake;
use super::{PLACES, TensionDisc, picture};
use crate::brake::machine::{BeltMode, BrakeData};
use crate::brake::mechanics::ends::euler_coefficient;
use crate::brake::mechanics::{FramePose, Web};
use camgen_cams::report::diagram::{Diagram, PlottedValue, diagram};
use camgen_cams::report::plot::{self, Plot, PlotCurve, PlotPanel};
use camgen_cams::report::shown;
use camgen_kernel::geometry::MILLIMETRES;
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

fn curve(name: impl Into<String>, colour: usize, bold: bool, points: Vec<[f64; 2]>) -> PlotCurve {
    PlotCurve { name: name.into(), colour, bold, points }
}

/// Equal steps from one value to another, both included.
fn between(from: f64, to: f64) -> impl Iterator<Item = f64> {
    (0..=STEPS).map(move |i| from + (to - from) * f64::from(i) / f64::from(STEPS))
}

/// The brake on paper, with the frame to scale next to its diagrams.
pub(super) fn plot(machine: &str, braking: &LoadedBrake<'_>, held: Option<&TensionDisc<'_>>) -> Plot {
    let wraps = [braking.ends[0].wrap, braking.ends[1].wrap];
    let grip = braking.grip(&braking.ends[0]);
    let mut own = vec![coefficient(braking.brake.friction(), &wraps), by_belt_speed(braking.data, grip)];
    own.extend(braking.data.web.map(|web| by_strain(&web, grip)));
    Plot {
        title: format!("{machine}: tension of the web over the roll"),
        places: "radius of the roll, mm".into(),
        panels: vec![over_roll(braking, held)],
        own,
        scheme: Some(picture::scheme(braking)),
    }
}

/// P over R: without a disc, by the printed moment, and with the disc by its law and as cut.
fn over_roll(braking: &LoadedBrake<'_>, held: Option<&TensionDisc<'_>>) -> PlotPanel {
    let poses: Vec<FramePose> = braking.radii(PLACES).filter_map(|radius| braking.brake.at(radius).ok()).collect();
    let plain = LoadedBrake { disc: None, ..braking.clone() };
    let printed = by_radius(&poses, |pose| braking.brake.tension_printed(braking.printed_weight, pose));
    let mut curves = vec![
        curve("printed moment", plot::GREY, false, printed),
        curve("this brake", 1, held.is_none(), by_radius(&poses, |pose| plain.tension(pose))),
    ];
    if let Some(held) = held {
        curves.push(curve("with the disc", 0, true, by_radius(&poses, |pose| braking.tension(pose))));
        if let Some(cut) = held.as_cut {
            let mut points: Vec<[f64; 2]> =
                cut.points.iter().map(|point| [MILLIMETRES * point.radius, point.tension]).collect();
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            curves.push(curve("as cut", 2, false, points));
        }
    }
    PlotPanel { name: "Web tension, N".into(), curves }
}

/// A value over the radius, mm, from the run-down roll on.
fn by_radius(poses: &[FramePose], value: impl Fn(&FramePose) -> f64) -> Vec<[f64; 2]> {
    poses.iter().rev().map(|pose| [MILLIMETRES * pose.radius, value(pose)]).collect()
}

/// Figure 2: K over the wrap for the friction and a fifth more, with marks at the ends of the roll.
pub(super) fn coefficient(friction: f64, wraps: &[f64]) -> (String, PlotPanel) {
    let more = 1.2 * friction;
    let mut curves = vec![
        curve(format!("f = {}", shown(more)), plot::GREY, false, coefficient_by_wrap(more)),
        curve(format!("f = {}", shown(friction)), 0, true, coefficient_by_wrap(friction)),
    ];
    curves.extend(wraps.iter().map(|wrap| {
        let at = vec![[wrap.to_degrees(), euler_coefficient(*wrap, friction)]];
        curve("", 1, true, at)
    }));
    let name = "K of (7), rings: full roll and run-down roll".into();
    ("wrap, degrees".into(), PlotPanel { name, curves })
}

fn coefficient_by_wrap(friction: f64) -> Vec<[f64; 2]> {
    between(LEAST_WRAP, LARGEST_WRAP).map(|wrap| [wrap.to_degrees(), euler_coefficient(wrap, friction)]).collect()
}

/// P over the belt's speed: the grip at any speed, the strain branch near V, and the printed (2).
pub(super) fn by_belt_speed(data: &BrakeData, grip: f64) -> (String, PlotPanel) {
    let mut curves = vec![curve("printed (2)", plot::GREY, false, vec![[0.0, grip], [1.0, 0.0]])];
    let branch = match &data.web {
        Some(web) => {
            let corner = web.belt_speed(grip);
            let free = 1.0 + web.wound_strain;
            vec![[0.0, grip], [corner, grip], [free, 0.0]]
        }
        None => vec![[0.0, grip], [1.0, grip]],
    };
    curves.push(curve("exact", 0, true, branch));
    if data.mode == BeltMode::Slip {
        curves.push(curve("this belt", 1, true, vec![[data.belt_speed_ratio, grip]]));
    }
    let name = "Tension on the full roll, N, over the belt's speed".into();
    ("V_z/V, belt over web".into(), PlotPanel { name, curves })
}

/// P over the belt's speed near the strain branch, where a thousandth of the speed is all of the tension.
fn by_strain(web: &Web, grip: f64) -> (String, PlotPanel) {
    let free = 1.0 + web.wound_strain;
    let slowest = free / (1.0 + AROUND * web.strain(grip));
    // Slower from left to right, by thousandths of the web's speed.
    let points = between(free, slowest)
        .map(|ratio| [THOUSANDTHS * (1.0 - ratio), web.tension_within(grip, ratio).max(0.0)])
        .collect();
    let curves = vec![curve("strain, then grip", 0, true, points)];
    let name = "Tension near V, N: strain up to the grip".into();
    ("1 − V_z/V, thousandths".into(), PlotPanel { name, curves })
}

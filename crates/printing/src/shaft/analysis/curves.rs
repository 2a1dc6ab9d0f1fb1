//! The curves of a shaft on paper: modes, deflection, lift error, sweep.

use super::load::LiftErrorRow;
use super::sweep;
use super::{ShaftResults, along, picture, rpm};
use camgen_cams::body::LoadedFollower;
use camgen_cams::report::plot::{Plot, PlotBand, PlotCurve, PlotLine, PlotPanel, PlotPoint, figure};
use camgen_kernel::geometry::MILLIMETRES;

/// Meganewtons per metre, for the axis of a sweep.
const MEGA: f64 = 1e-6;

/// Modes and critical speeds that are drawn.
const DRAWN: usize = 4;

/// A length of the loaded follower, mm, over the cam angle, degrees.
fn over_cam_angle(rows: &[LiftErrorRow], value: fn(&LoadedFollower) -> f64) -> Vec<[f64; 2]> {
    rows.iter().map(|(_, cam_deg, follower)| [*cam_deg, MILLIMETRES * value(follower)]).collect()
}

/// The first critical speed against that of the shaft, and the lift error.
fn headline(found: &ShaftResults<'_>) -> String {
    let Some(first) = found.spectrum.speeds.first().map(|speed| rpm(*speed)) else {
        return "No critical speed".into();
    };
    let critical = format!("First critical speed {} rpm", figure(first.round()));
    let share = found.speed.filter(|speed| *speed > 0.0).map(|speed| rpm(speed) / first);
    let limit = found.machine.limits.critical_speed_ratio;
    let speed = share.map(|share| {
        let times = figure((10.0 / share).round() / 10.0);
        if share > limit {
            format!(": too near, {} % of it are reached", figure((100.0 * share).round()))
        } else {
            format!(", {times} times the speed of the shaft")
        }
    });
    let error = found.under.as_ref().map(|under| {
        let error = format!("; lift error {} mm", figure(MILLIMETRES * under.largest.value.abs()));
        match found.machine.limits.lift_error {
            Some(limit) => format!("{error} of at most {} mm", figure(MILLIMETRES * limit)),
            None => error,
        }
    });
    let stiffness = found
        .statics
        .as_ref()
        .filter(|_| found.under.is_none())
        .map(|statics| format!("; {} µm deflection under 1 kN", figure(1e9 * statics.own_compliance())));
    [Some(critical), speed, stiffness, error].into_iter().flatten().collect()
}

/// Modes and deflection along the shaft, lift error over a turn and the sweep below, and the shaft to scale.
pub(super) fn plot(found: &ShaftResults<'_>, sweep: Option<&[sweep::SweepRow]>) -> Plot {
    let places: Vec<f64> = along::places(found).into_iter().map(|(x, _)| x).collect();
    let modes = found.spectrum.modes.iter().zip(&found.spectrum.speeds).take(DRAWN).enumerate();
    let modes = modes.map(|(index, (mode, speed))| {
        let points = places.iter().map(|x| [MILLIMETRES * x, mode.shape.evaluate(*x)[0]]).collect();
        PlotCurve::new(format!("{} rpm", figure(rpm(*speed).round())), index, points)
    });
    let modes: Vec<PlotCurve> = modes.collect();
    let supports = || {
        let at = found.shaft.supports().iter().zip(picture::LETTERS);
        at.map(|(support, letter)| PlotLine { at: MILLIMETRES * support.at, text: letter.into(), dashed: true })
            .collect()
    };
    let mut panels = Vec::new();
    panels.extend(deflection(found, &places).map(|panel| PlotPanel { lines: supports(), ..panel }));
    if !modes.is_empty() {
        let name = "Shapes at the critical speeds, largest deflection 1";
        panels.push(PlotPanel { lines: supports(), ..PlotPanel::new(name, modes) });
    }
    let mut own = Vec::new();
    own.extend(found.under.as_ref().map(|under| {
        let rows = under.rows(found.asked.samples);
        let mut curves = Vec::new();
        if under.has_sections() {
            for (colour, rows) in rows.chunk_by(|a, b| a.0 == b.0).take(DRAWN).enumerate() {
                let name = rows.first().map_or_else(String::new, |row| format!("{} rpm", figure(row.0)));
                curves.push(PlotCurve::new(name, colour, over_cam_angle(rows, LoadedFollower::error)));
            }
        } else if under.shaft_twist.is_some() {
            curves.push(PlotCurve::new("bending", 1, over_cam_angle(&rows, |follower| follower.bending)));
            curves.push(PlotCurve::new("twist", 2, over_cam_angle(&rows, |follower| follower.twist)));
            curves.push(PlotCurve::new("in all", 0, over_cam_angle(&rows, LoadedFollower::error)));
        } else {
            curves.push(PlotCurve::new("", 0, over_cam_angle(&rows, LoadedFollower::error)));
        }
        let worst = [under.largest.at.to_degrees(), MILLIMETRES * under.largest.value];
        let limit = found.machine.limits.lift_error.map(|limit| MILLIMETRES * limit);
        let panel = PlotPanel {
            points: vec![PlotPoint::dot(worst, 0, format!("{} mm at {}°", figure(worst[1]), figure(worst[0])))],
            bands: limit
                .map(|limit| PlotBand::above(limit, format!("over the limit of {} mm", figure(limit))))
                .into_iter()
                .collect(),
            ..PlotPanel::new("Lift error under load, mm", curves)
        };
        ("cam angle, degrees".to_owned(), panel)
    }));
    own.extend(sweep.map(|rows| ("stiffness of the supports, MN/m".to_owned(), over_stiffness(found, rows))));
    Plot {
        title: headline(found),
        subtitle: format!(
            "{}: shaft of {} mm and {} kg, critical speeds and deflection",
            found.machine.name(),
            figure(MILLIMETRES * found.shaft.length()),
            figure(found.shaft.mass())
        ),
        places: "from the left end of the shaft, mm".into(),
        panels,
        own,
        scheme: Some(picture::scheme(found)),
        ..Plot::default()
    }
}

/// Under the largest force of the cam, or a kilonewton where no force is known.
fn deflection(found: &ShaftResults<'_>, places: &[f64]) -> Option<PlotPanel> {
    let statics = found.statics.as_ref()?;
    let force = found.under.as_ref().map_or(1e3, |under| under.force);
    let points: Vec<[f64; 2]> =
        places.iter().map(|x| [MILLIMETRES * x, 1e6 * force * statics.curve.evaluate(*x)[0]]).collect();
    let place = if found.carried.is_some() { "at the cam" } else { "at shaft.cam_at" };
    let name = format!("Deflection under {} N {place}, µm", figure(force));
    let worst = points.iter().copied().reduce(|best, next| if next[1].abs() > best[1].abs() { next } else { best });
    Some(PlotPanel {
        points: worst.map(|at| PlotPoint::dot(at, 0, format!("{} µm", figure(at[1])))).into_iter().collect(),
        ..PlotPanel::new(name, vec![PlotCurve::new("", 0, points)])
    })
}

fn over_stiffness(found: &ShaftResults<'_>, rows: &[sweep::SweepRow]) -> PlotPanel {
    // The others would hide how the first one bends.
    let points = rows.iter().filter_map(|row| Some([MEGA * row.stiffness, rpm(*row.speeds.first()?)])).collect();
    let mut curves = Vec::new();
    if let (Some(rigid), Some(first), Some(last)) = (sweep::rigid(found), rows.first(), rows.last()) {
        let points = [first, last].map(|row| [MEGA * row.stiffness, rpm(rigid)]).to_vec();
        curves.push(PlotCurve::grey("rigid supports", points));
    }
    curves.push(PlotCurve::new("", 0, points));
    PlotPanel::new("First critical speed, rpm", curves)
}

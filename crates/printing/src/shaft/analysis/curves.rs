//! The curves of a shaft on paper: modes, deflection, lift error, sweep.

use super::load::LiftErrorRow;
use super::sweep;
use super::{ShaftResults, along, picture, rpm};
use camgen_cams::body::LoadedFollower;
use camgen_cams::report::plot::{self, Plot, PlotCurve, PlotPanel};
use camgen_cams::report::shown;
use camgen_kernel::geometry::MILLIMETRES;

/// Meganewtons per metre, for the axis of a sweep.
const MEGA: f64 = 1e-6;

fn curve(name: String, colour: usize, points: Vec<[f64; 2]>) -> PlotCurve {
    PlotCurve { name, colour, bold: true, points }
}

/// A length of the loaded follower, mm, over the cam angle, degrees.
fn over_cam_angle(name: String, colour: usize, rows: &[LiftErrorRow], value: fn(&LoadedFollower) -> f64) -> PlotCurve {
    let points = rows.iter().map(|(_, cam_deg, follower)| [*cam_deg, MILLIMETRES * value(follower)]).collect();
    curve(name, colour, points)
}

/// Modes and deflection along the shaft, lift error over a turn and the sweep below, and the shaft to scale.
pub(super) fn plot(found: &ShaftResults<'_>, sweep: Option<&[sweep::SweepRow]>) -> Plot {
    let places: Vec<f64> = along::places(found).into_iter().map(|(x, _)| x).collect();
    let modes = found.spectrum.modes.iter().zip(&found.spectrum.speeds).enumerate().map(|(index, (mode, speed))| {
        let points = places.iter().map(|x| [MILLIMETRES * x, mode.shape.evaluate(*x)[0]]).collect();
        curve(format!("{} rpm", shown(rpm(*speed).round())), index, points)
    });
    let modes: Vec<PlotCurve> = modes.collect();
    let mut panels = Vec::new();
    if !modes.is_empty() {
        panels.push(PlotPanel { name: "Modes, largest deflection 1".into(), curves: modes });
    }
    panels.extend(deflection(found, &places));
    let mut own = Vec::new();
    own.extend(found.under.as_ref().map(|under| {
        let rows = under.rows(found.asked.samples);
        let curves = if under.has_sections() {
            let mut curves = Vec::new();
            for (colour, rows) in rows.chunk_by(|a, b| a.0 == b.0).enumerate() {
                let name = rows.first().map_or_else(String::new, |row| format!("{} rpm", shown(row.0)));
                curves.push(over_cam_angle(name, colour, rows, LoadedFollower::error));
            }
            curves
        } else {
            let mut curves = vec![over_cam_angle("in all".into(), 0, &rows, LoadedFollower::error)];
            if under.shaft_twist.is_some() {
                curves.push(over_cam_angle("bending".into(), 1, &rows, |follower| follower.bending));
                curves.push(over_cam_angle("twist".into(), 2, &rows, |follower| follower.twist));
            }
            curves
        };
        ("cam angle, degrees".to_owned(), PlotPanel { name: "Lift error under load, mm".into(), curves })
    }));
    own.extend(sweep.map(|rows| ("stiffness of the supports, MN/m".to_owned(), over_stiffness(found, rows))));
    Plot {
        title: format!("{}: shaft, critical speeds and deflection", found.machine.name()),
        places: "from the left end of the shaft, mm".into(),
        panels,
        own,
        scheme: Some(picture::scheme(found)),
    }
}

/// Under the largest force of the cam, or a kilonewton where no force is known.
fn deflection(found: &ShaftResults<'_>, places: &[f64]) -> Option<PlotPanel> {
    let statics = found.statics.as_ref()?;
    let force = found.under.as_ref().map_or(1e3, |under| under.force);
    let points = places.iter().map(|x| [MILLIMETRES * x, 1e6 * force * statics.curve.evaluate(*x)[0]]).collect();
    let place = if found.carried.is_some() { "at the cam" } else { "at shaft.cam_at" };
    let name = format!("Deflection under {} N {place}, µm", shown(force.round()));
    Some(PlotPanel { name, curves: vec![curve("deflection".into(), 0, points)] })
}

fn over_stiffness(found: &ShaftResults<'_>, rows: &[sweep::SweepRow]) -> PlotPanel {
    // The others would hide how the first one bends.
    let points = rows.iter().filter_map(|row| Some([MEGA * row.stiffness, rpm(*row.speeds.first()?)])).collect();
    let mut curves = vec![curve("n1".into(), 0, points)];
    if let (Some(rigid), Some(first), Some(last)) = (sweep::rigid(found), rows.first(), rows.last()) {
        let points = [first, last].map(|row| [MEGA * row.stiffness, rpm(rigid)]).to_vec();
        curves.push(PlotCurve { name: "n1, rigid supports".into(), colour: plot::GREY, bold: false, points });
    }
    PlotPanel { name: "First critical speed, rpm".into(), curves }
}

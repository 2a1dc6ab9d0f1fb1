//! Which columns of the table are drawn together. A column that no panel names appears by itself, with the others of its unit.

use super::units::{named, words};
use crate::report::Finding;
use crate::report::diagram::{Diagram, PlottedValue, diagram};
use serde_json::{Value, json};

const CUT: &str = "as cut";
const MOTION: &str = "motion";

/// The diagrams of a cam.
pub(super) const OF_A_CAM: &[Diagram] = &[
    diagram("lift", "Lift", &[("lift", MOTION)], &[], PlottedValue::Itself),
    diagram("velocity", "Velocity", &[("velocity", MOTION), ("velocity_cut", CUT)], &[], PlottedValue::Itself),
    diagram(
        "acceleration",
        "Acceleration",
        &[("acceleration", MOTION), ("acceleration_cut", CUT)],
        &[],
        PlottedValue::Itself,
    ),
    diagram("jerk", "Jerk", &[("jerk", MOTION)], &[], PlottedValue::Itself),
    diagram(
        "pressure-angle",
        "Pressure angle",
        &[("pressure_angle", "α")],
        &[("pressure_angle", PlottedValue::Both)],
        PlottedValue::Itself,
    ),
    diagram(
        "pitch-curvature",
        "Curvature of the pitch curve",
        &[("pitch_curvature_radius", "1/ρ"), ("principal_curvature_radius", "surface, sharpest")],
        &[("undercut", PlottedValue::Roller), ("min_convex_radius", PlottedValue::Curvature)],
        PlottedValue::Curvature,
    ),
    diagram(
        "profile-curvature",
        "Curvature of the profile",
        &[("profile_curvature_radius", "1/ρ")],
        &[("cutter_radius", PlottedValue::Hollow)],
        PlottedValue::Curvature,
    ),
    diagram(
        "balance",
        "Force balance",
        &[("inertia", "inertia"), ("air", "air, this cam"), ("air_fixed_bottom", "air, fixed bottom")],
        &[],
        PlottedValue::Itself,
    ),
    diagram(
        "residual",
        "Residual force",
        &[
            ("residual", MOTION),
            ("residual_cut", "as cut, size"),
            ("residual_braking", "braking"),
            ("residual_return", "on the return stroke"),
        ],
        &[],
        PlottedValue::Itself,
    ),
    diagram(
        "force",
        "Force on the roller",
        &[("roller_force", "along its path"), ("contact_force", "along the normal"), ("axial_force", "along the axis")],
        &[],
        PlottedValue::Itself,
    ),
    diagram(
        "torque",
        "Torque on the camshaft",
        &[("torque", "of this cam"), ("compensator_torque", "of the compensating cam"), ("torque_left", "of both")],
        &[],
        PlottedValue::Itself,
    ),
    diagram("press", "Bed and bottom", &[("x", "overrun x"), ("dx", "Δx of the bottom")], &[], PlottedValue::Itself),
];

/// The diagrams of an analysis, in which no cam is cut.
pub(super) const OF_AN_ANALYSIS: &[Diagram] = &[
    diagram("position", "Position of the bed", &[("x", "bed")], &[], PlottedValue::Itself),
    diagram("velocity", "Velocity", &[("velocity", "bed")], &[], PlottedValue::Itself),
    diagram("acceleration", "Acceleration", &[("acceleration", "bed")], &[], PlottedValue::Itself),
    diagram("jerk", "Jerk", &[("jerk", "bed")], &[], PlottedValue::Itself),
    diagram("balance", "Force balance", &[("inertia", "inertia"), ("air", "air")], &[], PlottedValue::Itself),
    diagram("residual", "Residual force", &[("residual", "inertia less air")], &[], PlottedValue::Itself),
    diagram("torque", "Torque on the driving crank", &[("torque", "torque")], &[], PlottedValue::Itself),
    diagram("power", "Power of the driving crank", &[("power", "power")], &[], PlottedValue::Itself),
    diagram(
        "transmission",
        "Transmission angle of the drag link",
        &[("transmission", "coupler to driven crank")],
        &[("transmission_angle", PlottedValue::Itself)],
        PlottedValue::Itself,
    ),
    diagram("lift", "Lift of the disc's law", &[("lift", "lift")], &[], PlottedValue::Itself),
    diagram(
        "rod",
        "Angle of the rod",
        &[("rod", "from the line of the slider")],
        &[("rod_angle", PlottedValue::Both)],
        PlottedValue::Itself,
    ),
];

/// Columns that are places or coordinates, or that repeat another column.
const NOT_DRAWN: &[&str] = &[
    "z",
    "cam",
    "crank",
    "position",
    "pitch_x",
    "pitch_y",
    "profile_x",
    "profile_y",
    "contact_x",
    "contact_y",
    "contact_z",
    "",
];

/// A diagram of more columns that no panel names is not called by them.
const MOST_NAMED: usize = 3;

/// The diagrams of the existing columns, drawn along the column `place`, with a roller of this radius.
pub(super) fn of(
    columns: &[&'static str],
    known: &[&Diagram],
    place: &str,
    (checks, roller_mm): (&[Finding], Option<f64>),
) -> Vec<Value> {
    let drawn: Vec<&'static str> =
        columns.iter().copied().filter(|name| *name != place && !NOT_DRAWN.contains(&named(name).stem)).collect();
    let of_panel = |panel: &Diagram| {
        let series: Vec<Value> = panel
            .stems
            .iter()
            .filter_map(|(stem, label)| {
                let name = drawn.iter().find(|name| named(name).stem == *stem)?;
                Some(json!({"column": name, "label": label}))
            })
            .collect();
        let first = panel.stems.iter().find_map(|(stem, _)| drawn.iter().find(|name| named(name).stem == *stem))?;
        let (unit, order) = (named(first).unit, named(first).order);
        let curvature = panel.shown == PlottedValue::Curvature;
        let limits: Vec<Value> = panel.limits.iter().flat_map(|limit| limits(limit, checks, roller_mm)).collect();
        Some(json!({
            "id": panel.id, "title": panel.title, "order": order, "curvature": curvature,
            "unit": if curvature { format!("1/{unit}") } else { unit.to_owned() },
            "series": series, "limits": limits,
        }))
    };
    let mut panels: Vec<Value> = known.iter().copied().filter_map(of_panel).collect();
    let in_panel =
        |name: &&&str| known.iter().any(|panel| panel.stems.iter().any(|(stem, _)| named(name).stem == *stem));
    let others: Vec<&'static str> = drawn.iter().filter(|name| !in_panel(name)).copied().collect();
    let mut units: Vec<(&str, u8)> = others.iter().map(|name| (named(name).unit, named(name).order)).collect();
    units.sort_unstable();
    units.dedup();
    for (unit, order) in units {
        let same = others.iter().filter(|name| (named(name).unit, named(name).order) == (unit, order));
        let all: Vec<String> = same.clone().map(|name| words(name)).collect();
        let series: Vec<Value> = same.map(|name| json!({"column": name, "label": words(name)})).collect();
        let title = if all.len() > MOST_NAMED { "Other values".to_owned() } else { capital(&all.join(", ")) };
        panels.push(json!({
            "id": format!("other-{unit}"), "title": title, "order": order, "curvature": false, "unit": unit,
            "series": series, "limits": [],
        }));
    }
    panels
}

/// A text with a capital letter at its beginning.
fn capital(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| first.to_uppercase().chain(rest).collect())
}

/// The lines of a limit, where its check has one.
fn limits((check, shown): &(&'static str, PlottedValue), checks: &[Finding], roller_mm: Option<f64>) -> Vec<Value> {
    let found = checks.iter().find(|finding| finding.check == *check).and_then(|finding| finding.limit);
    let Some(limit) = found else { return Vec::new() };
    let values = match shown {
        PlottedValue::Itself => vec![limit],
        PlottedValue::Both => vec![limit, -limit],
        PlottedValue::Curvature => vec![1.0 / limit],
        PlottedValue::Hollow => vec![-1.0 / limit],
        PlottedValue::Roller => roller_mm.iter().map(|radius| 1.0 / radius).collect(),
    };
    let label = match shown {
        PlottedValue::Roller => "curvature of the roller".to_owned(),
        _ => format!("limit of {}", check.replace('_', " ")),
    };
    values.into_iter().filter(|value| value.is_finite()).map(|value| json!({"label": label, "value": value})).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Place, Verdict};

    /// A column that no panel names is drawn nevertheless.
    #[test]
    fn every_column_is_drawn_once_or_is_a_place() {
        let columns = ["cam_deg", "lift_mm", "velocity_mm_per_rad", "surprise_n", "riddle_n", "pitch_x_mm"];
        let panels = of(&columns, &OF_A_CAM.iter().collect::<Vec<_>>(), "cam_deg", (&[], None));
        let drawn: Vec<&str> = panels
            .iter()
            .flat_map(|panel| panel["series"].as_array().expect("a list"))
            .map(|series| series["column"].as_str().expect("a name"))
            .collect();
        assert_eq!(drawn, ["lift_mm", "velocity_mm_per_rad", "surprise_n", "riddle_n"]);
        assert_eq!(panels[2]["title"], "Surprise, riddle");
    }

    #[test]
    fn limits_stand_where_they_bind() {
        let finding = |check: &'static str, limit| Finding {
            part: None,
            check: check.into(),
            value: 1.0,
            limit: Some(limit),
            bound: None,
            unit: "mm".into(),
            place: Place::default(),
            verdict: Verdict::Pass,
            missing: None,
            about: None,
            is_as_cut: false,
            named: None,
            fact: None,
            assumes: None,
            note: None,
        };
        let checks = [finding("pressure_angle", 30.0), finding("undercut", 0.0), finding("cutter_radius", 10.0)];
        let columns = ["cam_deg", "pressure_angle_deg", "pitch_curvature_radius_mm", "profile_curvature_radius_mm"];
        let panels = of(&columns, &OF_A_CAM.iter().collect::<Vec<_>>(), "cam_deg", (&checks, Some(20.0)));
        let values = |index: usize| -> Vec<f64> {
            let limits = panels[index]["limits"].as_array().expect("a list");
            limits.iter().map(|limit| limit["value"].as_f64().expect("a number")).collect()
        };
        assert_eq!((values(0), values(1), values(2)), (vec![30.0, -30.0], vec![0.05], vec![-0.1]));
        assert_eq!(panels[1]["unit"], "1/mm");
    }
}

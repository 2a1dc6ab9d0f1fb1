//! Which columns of the table are drawn together. A column that no panel names appears by itself, with the others of its unit.

use super::units::named;
use crate::report::Finding;
use serde_json::{Value, json};

/// What is drawn of a column, or at which place the limit of a check stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum As {
    /// The value.
    Itself,
    /// The value, and the same with its sign turned.
    Both,
    /// One over the value: a radius as a curvature.
    Curvature,
    /// The curvature of the roller, whatever the limit.
    Roller,
    /// The same of a hollow.
    Hollow,
}

/// A diagram: its name for programs, its title, its columns without their units and their names, the checks whose limits it shows,
/// and whether it shows radii as curvatures.
pub(super) struct Panel {
    id: &'static str,
    title: &'static str,
    stems: &'static [(&'static str, &'static str)],
    limits: &'static [(&'static str, As)],
    shown: As,
}

const fn panel(
    id: &'static str,
    title: &'static str,
    stems: &'static [(&'static str, &'static str)],
    limits: &'static [(&'static str, As)],
    shown: As,
) -> Panel {
    Panel { id, title, stems, limits, shown }
}

const CUT: &str = "as cut";
const MOTION: &str = "motion";

/// The diagrams of a cam.
pub(super) const OF_A_CAM: &[Panel] = &[
    panel("lift", "Lift", &[("lift", MOTION)], &[], As::Itself),
    panel("velocity", "Velocity", &[("velocity", MOTION), ("velocity_cut", CUT)], &[], As::Itself),
    panel("acceleration", "Acceleration", &[("acceleration", MOTION), ("acceleration_cut", CUT)], &[], As::Itself),
    panel("jerk", "Jerk", &[("jerk", MOTION)], &[], As::Itself),
    panel("pressure-angle", "Pressure angle", &[("pressure_angle", "α")], &[("pressure_angle", As::Both)], As::Itself),
    panel(
        "pitch-curvature",
        "Curvature of the pitch curve",
        &[("pitch_curvature_radius", "1/ρ"), ("principal_curvature_radius", "surface, sharpest")],
        &[("undercut", As::Roller), ("min_convex_radius", As::Curvature)],
        As::Curvature,
    ),
    panel(
        "profile-curvature",
        "Curvature of the profile",
        &[("profile_curvature_radius", "1/ρ")],
        &[("cutter_radius", As::Hollow)],
        As::Curvature,
    ),
    panel(
        "balance",
        "Force balance",
        &[("inertia", "inertia"), ("air", "air, this cam"), ("air_fixed_bottom", "air, fixed bottom")],
        &[],
        As::Itself,
    ),
    panel(
        "residual",
        "Residual force",
        &[
            ("residual", MOTION),
            ("residual_cut", "as cut, size"),
            ("residual_braking", "braking"),
            ("residual_return", "on the way back"),
        ],
        &[],
        As::Itself,
    ),
    panel(
        "force",
        "Force on the roller",
        &[("roller_force", "along its path"), ("contact_force", "along the normal"), ("axial_force", "along the axis")],
        &[],
        As::Itself,
    ),
    panel(
        "torque",
        "Torque on the camshaft",
        &[("torque", "of this cam"), ("compensator_torque", "of the compensating cam"), ("torque_left", "of both")],
        &[],
        As::Itself,
    ),
    panel("press", "Bed and bottom", &[("x", "overrun x"), ("dx", "Δx of the bottom")], &[], As::Itself),
];

/// The diagrams of an analysis, in which no cam is cut.
pub(super) const OF_AN_ANALYSIS: &[Panel] = &[
    panel("position", "Position of the bed", &[("x", "bed")], &[], As::Itself),
    panel("velocity", "Velocity", &[("velocity", "bed")], &[], As::Itself),
    panel("acceleration", "Acceleration", &[("acceleration", "bed")], &[], As::Itself),
    panel("jerk", "Jerk", &[("jerk", "bed")], &[], As::Itself),
    panel("balance", "Force balance", &[("inertia", "inertia"), ("air", "air")], &[], As::Itself),
    panel("residual", "Residual force", &[("residual", "inertia less air")], &[], As::Itself),
    panel("torque", "Torque on the driving crank", &[("torque", "torque")], &[], As::Itself),
    panel("power", "Power of the driving crank", &[("power", "power")], &[], As::Itself),
    panel(
        "transmission",
        "Transmission angle of the drag link",
        &[("transmission", "coupler to driven crank")],
        &[("transmission_angle", As::Itself)],
        As::Itself,
    ),
    panel(
        "tension",
        "Web tension",
        &[("tension", "this brake"), ("tension_printed", "printed moment")],
        &[],
        As::Itself,
    ),
    panel(
        "belt",
        "Tension of the belt",
        &[("belt_slack", "slack span"), ("belt_tight", "tight span")],
        &[],
        As::Itself,
    ),
    panel(
        "arms",
        "Arms about the pivot",
        &[("weight_arm", "weight"), ("press_arm", "press"), ("tight_arm", "tight span"), ("slack_arm", "slack span")],
        &[],
        As::Itself,
    ),
    panel("frame", "Angle of the frame, and wrap", &[("frame", "frame"), ("wrap", "wrap")], &[], As::Itself),
    panel("cam-moment", "Moment of the disc on the frame", &[("cam_moment", "moment")], &[], As::Itself),
    panel("lift", "Lift of the disc's law", &[("lift", "lift")], &[], As::Itself),
    panel("rod", "Angle of the rod", &[("rod", "from the line of the slider")], &[("rod_angle", As::Both)], As::Itself),
];

/// Columns that are places or coordinates, or that say the same as another.
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

/// The diagrams of the columns that there are, `place` the column along which they are drawn, under a roller of this radius.
pub(super) fn of(
    columns: &[&'static str],
    known: &[Panel],
    place: &str,
    (checks, roller_mm): (&[Finding], Option<f64>),
) -> Vec<Value> {
    let drawn: Vec<&'static str> =
        columns.iter().copied().filter(|name| *name != place && !NOT_DRAWN.contains(&named(name).stem)).collect();
    let of_panel = |panel: &Panel| {
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
        let curvature = panel.shown == As::Curvature;
        let limits: Vec<Value> = panel.limits.iter().flat_map(|limit| limits(limit, checks, roller_mm)).collect();
        Some(json!({
            "id": panel.id, "title": panel.title, "order": order, "curvature": curvature,
            "unit": if curvature { format!("1/{unit}") } else { unit.to_owned() },
            "series": series, "limits": limits,
        }))
    };
    let mut panels: Vec<Value> = known.iter().filter_map(of_panel).collect();
    let in_panel =
        |name: &&&str| known.iter().any(|panel| panel.stems.iter().any(|(stem, _)| named(name).stem == *stem));
    let others: Vec<&'static str> = drawn.iter().filter(|name| !in_panel(name)).copied().collect();
    let mut units: Vec<(&str, u8)> = others.iter().map(|name| (named(name).unit, named(name).order)).collect();
    units.sort_unstable();
    units.dedup();
    for (unit, order) in units {
        let same = others.iter().filter(|name| (named(name).unit, named(name).order) == (unit, order));
        let series: Vec<Value> = same.map(|name| json!({"column": name, "label": super::units::words(name)})).collect();
        let title = if unit.is_empty() { "Other".to_owned() } else { format!("Other, {unit}") };
        panels.push(json!({
            "id": format!("other-{unit}"), "title": title, "order": order, "curvature": false, "unit": unit,
            "series": series, "limits": [],
        }));
    }
    panels
}

/// The lines of a limit, where its check has one.
fn limits((check, shown): &(&'static str, As), checks: &[Finding], roller_mm: Option<f64>) -> Vec<Value> {
    let found = checks.iter().find(|finding| finding.check == *check).and_then(|finding| finding.limit);
    let Some(limit) = found else { return Vec::new() };
    let values = match shown {
        As::Itself => vec![limit],
        As::Both => vec![limit, -limit],
        As::Curvature => vec![1.0 / limit],
        As::Hollow => vec![-1.0 / limit],
        As::Roller => roller_mm.iter().map(|radius| 1.0 / radius).collect(),
    };
    let label = match shown {
        As::Roller => "curvature of the roller".to_owned(),
        _ => format!("limit of {}", check.replace('_', " ")),
    };
    values.into_iter().filter(|value| value.is_finite()).map(|value| json!({"label": label, "value": value})).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Place, Verdict};

    /// A column that nobody knows is drawn all the same.
    #[test]
    fn every_column_is_drawn_once_or_is_a_place() {
        let columns = ["cam_deg", "lift_mm", "velocity_mm_per_rad", "surprise_n", "riddle_n", "pitch_x_mm"];
        let panels = of(&columns, OF_A_CAM, "cam_deg", (&[], None));
        let drawn: Vec<&str> = panels
            .iter()
            .flat_map(|panel| panel["series"].as_array().expect("a list"))
            .map(|series| series["column"].as_str().expect("a name"))
            .collect();
        assert_eq!(drawn, ["lift_mm", "velocity_mm_per_rad", "surprise_n", "riddle_n"]);
        assert_eq!(panels[2]["title"], "Other, N");
    }

    #[test]
    fn limits_stand_where_they_bind() {
        let finding = |check: &'static str, limit| Finding {
            check: check.into(),
            value: 1.0,
            limit: Some(limit),
            bound: None,
            unit: "mm".into(),
            place: Place::default(),
            verdict: Verdict::Pass,
            note: None,
        };
        let checks = [finding("pressure_angle", 30.0), finding("undercut", 0.0), finding("cutter_radius", 10.0)];
        let columns = ["cam_deg", "pressure_angle_deg", "pitch_curvature_radius_mm", "profile_curvature_radius_mm"];
        let panels = of(&columns, OF_A_CAM, "cam_deg", (&checks, Some(20.0)));
        let values = |index: usize| -> Vec<f64> {
            let limits = panels[index]["limits"].as_array().expect("a list");
            limits.iter().map(|limit| limit["value"].as_f64().expect("a number")).collect()
        };
        assert_eq!((values(0), values(1), values(2)), (vec![30.0, -30.0], vec![0.05], vec![-0.1]));
        assert_eq!(panels[1]["unit"], "1/mm");
    }
}

//! The screw table as a card that hangs at the press: the setting for a forme and a speed by the one variable v.

use super::report::ScatterReport;
use crate::press::machine::Press;
use camgen_cams::report::card::Card;
use camgen_cams::report::shown;

/// The card of the settings, by the rule of the report.
pub(super) fn settings_card(press: &Press, machine: &str, report: &ScatterReport<'_>) -> Card {
    let (rpm, settings, useful) = (report.cam_rpm, report.settings, &report.useful);
    let mut rows = Vec::new();
    for row in settings {
        let cells = vec![
            format!("{:.2}", row.v),
            format!("{:.2}", row.rpm),
            format!("{:.0}", row.v * press.bed.mass),
            format!("{:+.2}", row.column_mm - report.column_length_mm),
            format!("{:.2}", row.column_mm),
            format!("{:.0}", row.residual_n),
            format!("{:.0}", row.fixed_residual_n),
        ];
        rows.push((cells, useful.excludes(row.v)));
    }
    let names = ["v", "speed\nrpm", "mass\nkg", "screw\nmm", "column\nmm", "left\nN", "fixed\nN"];
    let mut foot = vec![sentence(&useful.describe())];
    if settings.iter().any(|row| useful.excludes(row.v)) {
        foot.push("Rows with a mark are at such speeds.".into());
    }
    Card {
        ending: "-card",
        title: format!("{machine}: setting of the screw ({}), cam for {} rpm", report.reset, shown(rpm)),
        head: vec![
            format!(
                "v = (speed/{} rpm)² × (moving mass/{} kg) × ({} kPa/air pressure)",
                shown(rpm),
                shown(press.bed.mass),
                shown(1e-3 * press.ambient_pressure)
            ),
            format!("{}. Set the screws of all alike; forces are those of all together.", report.cylinders.describe()),
            format!("Rule of the setting: {}.", rule_words(report.reset)),
            "Find v, and set the screw as in its row: + makes the air column longer. Between rows take the value in proportion: there somewhat more is left. Speed: at the mass and pressure \
             above; mass: at the speed and pressure above. Left: largest force on the crank; fixed: the same of a fixed bottom set by the same rule."
                .into(),
        ],
        heads: names.map(str::to_owned).to_vec(),
        rows,
        foot,
    }
}

/// The screw setting of a rule, in words.
fn rule_words(rule: &str) -> &'static str {
    match rule {
        "end" => "end, no force is left at the end of the stroke",
        "level" => "level, the largest force over the stroke is the least possible",
        _ => "none, the screw stays where it is",
    }
}

/// Words as a sentence of their own.
fn sentence(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| format!("{}{}.", first.to_uppercase(), letters.as_str()))
}

//! The screw table as a card that hangs at the press: the setting for a forme and a speed by the one variable v.

use super::report::UsefulRange;
use super::tables::SettingRow;
use crate::domains::press::machine::Press;
use crate::geometry::MILLIMETRES;
use crate::report::card::Card;
use crate::report::shown;

/// The card of the settings of a cam that is cut for a speed, rpm.
pub(super) fn of(
    press: &Press,
    machine: &str,
    rpm: f64,
    column: f64,
    settings: &[SettingRow],
    useful: &UsefulRange,
) -> Card {
    let outside = |v: f64| useful.v_min.is_some_and(|least| v < least) || useful.v_max.is_some_and(|most| v > most);
    let row = |row: &SettingRow| {
        let cells = vec![
            format!("{:.2}", row.v),
            format!("{:.2}", row.rpm),
            format!("{:.0}", row.v * press.bed.mass),
            format!("{:+.2}", row.column_mm - MILLIMETRES * column),
            format!("{:.2}", row.column_mm),
            format!("{:.0}", row.residual_n),
            format!("{:.0}", row.fixed_residual_n),
        ];
        (cells, outside(row.v))
    };
    let names = ["v", "speed\nrpm", "mass\nkg", "screw\nmm", "column\nmm", "left\nN", "fixed\nN"];
    let mut foot = vec![sentence(&useful.words())];
    if settings.iter().any(|row| outside(row.v)) {
        foot.push("Rows with a mark are outside of that range.".into());
    }
    Card {
        ending: "-card",
        title: format!("{machine}: setting of the screw, cam for {} rpm", shown(rpm)),
        head: vec![
            format!(
                "v = (speed/{} rpm)² × (moving mass/{} kg) × ({} kPa/air pressure)",
                shown(rpm),
                shown(press.bed.mass),
                shown(1e-3 * press.ambient_pressure)
            ),
            "Find v, and set the screw as in its row: + makes the air column longer. Between rows take the value in proportion: there somewhat more is left. Speed: at the mass and pressure \
             above; mass: at the speed and pressure above. Left: largest force on the crank; fixed: the same of a fixed bottom with its own setting."
                .into(),
        ],
        heads: names.map(str::to_owned).to_vec(),
        rows: settings.iter().map(row).collect(),
        foot,
    }
}

/// Words as a sentence of their own.
fn sentence(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| format!("{}{}.", first.to_uppercase(), letters.as_str()))
}

//! The lift table of a gauge follower as a CSV file.

use super::super::head::head_lines;
use super::plan::GaugeTable;
use super::read::{COLUMNS, FLAT, FOLLOWER, ROUND};
use crate::body::{Body, Gauge};
use crate::write::number::shortest;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::units::LengthUnit;

/// A table under a mark.
pub(super) fn write(body: &dyn Body, table: &GaugeTable, mark: &str) -> Vec<u8> {
    let units = body.machine().units();
    let columns = COLUMNS.iter().find(|(_, of)| *of == units).map_or("", |(columns, _)| columns);
    let statements = head_lines("#", &statements(body, table.gauge, units));
    let mut text = format!("# {mark}\n{statements}{columns}\n");
    let lowest = table.rows.iter().map(|row| row[1]).fold(f64::INFINITY, f64::min);
    for [cam_deg, distance] in &table.rows {
        let cells = [*cam_deg, units.of_mm(*distance), units.of_mm(distance - lowest)].map(shortest);
        text.push_str(&format!("{}\n", cells.join(",")));
    }
    text.into_bytes()
}

/// The statements in the head of a table in a unit.
pub(super) fn statements(body: &dyn Body, gauge: Gauge, units: LengthUnit) -> Vec<String> {
    let unit = units.symbol();
    let (follower, rest) = match gauge {
        Gauge::Round(radius) => {
            (format!("{ROUND}{unit} {}", shortest(units.of_mm(2.0 * MILLIMETRES * radius))), "centre")
        }
        Gauge::Flat => (FLAT.to_owned(), "face"),
    };
    vec![
        format!("machine: {}", body.machine().name().replace(['\n', '\r'], " ")),
        format!("{FOLLOWER}{follower}"),
        "guided on a line through the axis of the cam, at cam_deg, which runs against the rotation".to_owned(),
        format!("distance_{unit}: of its {rest} from the axis; lift_{unit}: from the lowest row"),
    ]
}

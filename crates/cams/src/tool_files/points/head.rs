//! The head of a table of points, compared with what is read of its rows.

use super::super::head::{self, HeadLine, SAME, in_another_unit, lines_after, value};
use super::plan::PointTable;
use super::write::statements;
use crate::body::Body;
use camgen_kernel::units::LengthUnit;

/// The contradiction between the head of a table of points and the table as read, if any.
pub(super) fn contradiction(
    body: &dyn Body,
    text: &str,
    table: &PointTable,
    units: LengthUnit,
    tolerance_mm: f64,
) -> Option<String> {
    let found = lines_after(text, "#");
    let count = |key: &str| {
        let value = found.iter().find_map(|line| line.text.strip_prefix(key)?.strip_prefix(": "));
        value.and_then(|value| value.split([' ', ',']).next()?.parse::<usize>().ok()).unwrap_or(0)
    };
    let mut stated_table = table.clone();
    // Corners and jumps are both repeated rows, and a row does not show which.
    let (corners, jumps) = (count("corners"), count("jumps"));
    let twice = table.rows.corners + table.rows.jumps;
    if twice == corners + jumps {
        (stated_table.rows.corners, stated_table.rows.jumps) = (corners, jumps);
    }
    stated_table.wish.tolerance = tolerance_mm;
    // A table may be checked without the tolerances it was made for; it is then judged by its stated ones.
    let of_one = statements(body, &PointTable { allowed: [1.0; 2], ..stated_table.clone() }, units);
    if let Some(why) = in_another_unit(&found, &of_one) {
        return Some(why);
    }
    let keys = ["velocity_tolerance", "acceleration_tolerance"];
    let mut judged = keys.to_vec();
    for (own, key) in stated_table.allowed.iter_mut().zip(keys) {
        let stated = value(found.iter().map(|line| line.text), key);
        if own.is_infinite() {
            judged.retain(|other| *other != key);
            let one = value(of_one.iter().map(String::as_str), key);
            *own = stated.zip(one).map_or(f64::INFINITY, |(stated, one)| stated / one);
        } else if stated.is_none() {
            *own = f64::INFINITY;
        }
    }
    let mut expected = statements(body, &stated_table, units);
    expected.retain(|line| !keys.iter().any(|key| line.starts_with(key) && !judged.contains(key)));
    let tolerance = |line: &HeadLine<'_>| {
        let stated = line.text.strip_prefix("tolerance_")?.split_once(": ")?.1.parse::<f64>().ok()?;
        Some(units.millimetres() * stated)
    };
    // A table made for a finer tolerance also keeps this one.
    let finer = |stated: f64| stated <= tolerance_mm * (1.0 + SAME) && stated >= table.rows.error * (1.0 - SAME);
    if found.iter().filter_map(tolerance).all(finer) {
        expected.retain(|line| !line.starts_with("tolerance_"));
    }
    head::contradiction(&found, &expected)
}

//! Compares the head of a file with the cam: a statement that contradicts the cam is refused with its line.
//!
//! A statement has a key before its colon. Other lines are remarks, unless the mark names this version of camgen: then every statement of this
//! version must be present.

use crate::body::Body;
use crate::body::gauge::Gauge;
use crate::body::points::PointTable;
use crate::reading::gauge::GaugeRows;
use crate::reading::inspection::PLAIN_INCHES;
use crate::reading::servo::ServoRows;
use crate::write::{gauge, inspection, points, servo};
use camgen_kernel::document::HeadingUnit;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::units::LengthUnit;

/// Beginning of the mark of this version.
const MARK: &str = concat!("camgen ", env!("CARGO_PKG_VERSION"), ", inputs ");
/// Largest relative difference of equal numbers.
const SAME: f64 = 1e-6;
/// Largest relative difference of equal errors, computed again from rounded rows.
const SAME_ERROR: f64 = 0.02;

/// Where the unit begins in a key.
const UNITS: [&str; 3] = ["_mm", "_in", "_rad"];

/// A line of a head, without its mark of a comment.
struct HeadLine<'t> {
    line: usize,
    text: &'t str,
}

/// The contradiction between the head of a servo table and the cam, if any.
pub(super) fn of_servo(body: &dyn Body, text: &str, read: &ServoRows) -> Option<String> {
    if read.straight {
        return of_equal_parts(text, read.swings);
    }
    let expected = servo::statements(body, read.rows.len(), read.units);
    let found = if text.contains("(*") { in_comment(text) } else { behind(text, "#") };
    contradiction(&found, &expected)
}

/// The contradiction in the comments after the settings of an ISG table. A comment of one word names the setting.
fn of_equal_parts(text: &str, swings: bool) -> Option<String> {
    let [master, kind, function, slave] = servo::isg_statements(swings);
    let due = [("Tabletype", kind), ("Functiontype", function)];
    let found: Vec<HeadLine<'_>> = text
        .lines()
        .take_while(|line| line.trim() != "Begintable")
        .enumerate()
        .filter_map(|(index, line)| Some(HeadLine { line: index + 1, text: line.split_once('#')?.1.trim() }))
        .collect();
    let misnamed = text.lines().enumerate().find_map(|(index, line)| {
        let (setting, comment) = line.split_once('#')?;
        let (_, due) = due.iter().find(|(name, _)| setting.trim_start().starts_with(name))?;
        let named = !comment.trim().is_empty() && !comment.trim().contains(' ');
        (named && comment.trim() != due).then(|| told(index + 1, comment.trim(), due))
    });
    misnamed.or_else(|| contradiction(&found, &[master, slave]))
}

/// The contradiction between the head of a gauge follower's lift table and the cam, if any.
pub(super) fn of_gauge(body: &dyn Body, text: &str, read: &GaugeRows) -> Option<String> {
    let follower = read.radius.map_or(Gauge::Flat, |radius| Gauge::Round(radius / MILLIMETRES));
    contradiction(&behind(text, "#"), &gauge::statements(body, follower, read.units))
}

/// The contradiction between the head of an inspection list, with its ball radius, mm, and the cam, if any.
pub(super) fn of_places(body: &dyn Body, text: &str, ball_radius: f64) -> Option<String> {
    if text.trim_start().starts_with("DMISMN/") {
        let mut found = behind(text, "$$");
        let mark = text.lines().next().and_then(|line| line.split('\'').nth(1)).unwrap_or_default();
        found.insert(0, HeadLine { line: 1, text: mark });
        return contradiction(&found, &inspection::program_statements(body));
    }
    let found = behind(text, "#");
    if !text.lines().any(|line| line.starts_with("no,")) {
        // Plain lines of numbers state at most their unit.
        let inches = text.lines().any(|line| line.trim_end() == PLAIN_INCHES);
        return contradiction(&found, &[format!("units: {}, degrees", if inches { "inches" } else { "mm" })]);
    }
    let units = if text.contains("x_in,y_in") { LengthUnit::Inch } else { LengthUnit::Millimetre };
    contradiction(&found, &inspection::statements(body, units, units.of_mm(ball_radius)))
}

/// The contradiction between the head of a table of points and the table as read, if any.
pub(super) fn of_points(
    body: &dyn Body,
    text: &str,
    (table, units, tolerance_mm): (&PointTable, LengthUnit, f64),
) -> Option<String> {
    let found = behind(text, "#");
    let count = |key: &str| {
        let value = found.iter().find_map(|line| line.text.strip_prefix(key)?.strip_prefix(": "));
        value.and_then(|value| value.split([' ', ',']).next()?.parse::<usize>().ok()).unwrap_or(0)
    };
    let mut told = table.clone();
    // Corners and jumps are both repeated rows, and a row does not show which.
    let (corners, jumps) = (count("corners"), count("jumps"));
    let twice = table.rows.corners + table.rows.jumps;
    if twice == corners + jumps {
        (told.rows.corners, told.rows.jumps) = (corners, jumps);
    }
    told.wish.tolerance = tolerance_mm;
    // A table may be checked without the tolerances it was made for; it is then judged by its stated ones.
    let of_one = points::statements(body, &PointTable { allowed: [1.0; 2], ..told.clone() }, units);
    if let Some(why) = in_another_unit(&found, &of_one) {
        return Some(why);
    }
    let keys = ["velocity_tolerance", "acceleration_tolerance"];
    let mut judged = keys.to_vec();
    for (own, key) in told.allowed.iter_mut().zip(keys) {
        let stated = value(found.iter().map(|line| line.text), key);
        if own.is_infinite() {
            judged.retain(|other| *other != key);
            let one = value(of_one.iter().map(String::as_str), key);
            *own = stated.zip(one).map_or(f64::INFINITY, |(stated, one)| stated / one);
        } else if stated.is_none() {
            *own = f64::INFINITY;
        }
    }
    let mut expected = points::statements(body, &told, units);
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
    contradiction(&found, &expected)
}

/// The number in the first statement whose key begins with `key`.
fn value<'t>(mut lines: impl Iterator<Item = &'t str>, key: &str) -> Option<f64> {
    lines.find(|line| line.starts_with(key))?.split_once(": ")?.1.parse().ok()
}

/// The lines that begin with a comment mark.
fn behind<'t>(text: &'t str, mark: &str) -> Vec<HeadLine<'t>> {
    let numbered = text.lines().enumerate();
    let own = numbered.filter_map(|(index, line)| {
        Some(HeadLine { line: index + 1, text: line.trim_start().strip_prefix(mark)?.trim() })
    });
    own.collect()
}

/// The lines of the first comment in structured text.
fn in_comment(text: &str) -> Vec<HeadLine<'_>> {
    let lines = text.lines().enumerate().skip_while(|(_, line)| !line.contains("(*"));
    let own = lines.take_while(|(_, line)| line.trim() != "*)");
    own.map(|(index, line)| HeadLine { line: index + 1, text: line.trim().trim_start_matches("(*").trim() }).collect()
}

/// The first statement whose key is that of an expected one in another unit: `tolerance_in` of a file in millimetres.
fn in_another_unit(found: &[HeadLine<'_>], expected: &[String]) -> Option<String> {
    let without_unit = |key: &str| UNITS.iter().find_map(|unit| Some(key.split_once(unit)?.0.to_owned()));
    let keys: Vec<(&str, &String)> = expected.iter().filter_map(|due| Some((due.split_once(": ")?.0, due))).collect();
    found.iter().find_map(|line| {
        let (key, _) = line.text.split_once(": ")?;
        let bare = without_unit(key).filter(|_| keys.iter().all(|(own, _)| *own != key))?;
        let (_, due) = keys.iter().find(|(own, _)| without_unit(own).as_ref() == Some(&bare))?;
        Some(told(line.line, line.text, due))
    })
}

/// The first statement that is another than expected.
fn contradiction(found: &[HeadLine<'_>], expected: &[String]) -> Option<String> {
    if let Some(why) = in_another_unit(found, expected) {
        return Some(why);
    }
    let known = |text: &str| expected.iter().any(|due| due == text);
    let strange: Vec<&HeadLine<'_>> = found
        .iter()
        .filter(|line| !(known(line.text) || line.text.is_empty() || line.text.starts_with(MARK)))
        .collect();
    let contradicts = strange.iter().find_map(|line| {
        let (key, stated) = line.text.split_once(": ")?;
        let due = expected.iter().find(|due| due.split_once(": ").is_some_and(|(own, _)| own == key))?;
        let value = due.split_once(": ").map_or("", |(_, value)| value);
        (!same(key, stated, value)).then(|| told(line.line, line.text, due))
    });
    let own = found.iter().any(|line| line.text.starts_with(MARK));
    let has = |due: &String| {
        let key = due.split_once(": ").map(|(key, _)| key);
        found
            .iter()
            .any(|line| line.text == due || (key.is_some() && line.text.split_once(": ").map(|(own, _)| own) == key))
    };
    let lost = || {
        let due = expected.iter().find(|due| own && !has(due))?;
        Some(
            strange
                .first()
                .map_or_else(|| format!("its head lacks `{}`", short(due)), |line| told(line.line, line.text, due)),
        )
    };
    contradicts.or_else(lost)
}

/// Whether two values of a statement are equal, or nearly equal numbers.
fn same(key: &str, stated: &str, due: &str) -> bool {
    let share = if key.contains("error") { SAME_ERROR } else { SAME };
    let close = |(stated, due): (f64, f64)| (stated - due).abs() <= share * due.abs();
    stated == due
        || stated.parse().ok().zip(due.parse().ok()).is_some_and(close)
        || (key == "units" && same_units(stated, due))
}

/// Whether the stated units are the expected ones, or the first of them, in any spelling.
fn same_units(stated: &str, due: &str) -> bool {
    let named = |text: &str| text.split(", ").map(HeadingUnit::of_word).collect::<Vec<_>>();
    let (stated, due) = (named(stated), named(due));
    let is = |(stated, due): (&Option<HeadingUnit>, &Option<HeadingUnit>)| match (stated, due) {
        (
            Some(HeadingUnit::Quantity { dimension, size, .. }),
            Some(HeadingUnit::Quantity { dimension: own, size: due, .. }),
        ) => dimension == own && (size - due).abs() <= SAME * due,
        _ => false,
    };
    stated.len() <= due.len() && stated.iter().zip(&due).all(is)
}

fn told(line: usize, stated: &str, due: &str) -> String {
    format!("line {line} of its head states `{}`; of this cam it is `{}`", short(stated), short(due))
}

fn short(text: &str) -> String {
    let start: String = text.chars().take(80).collect();
    if start.len() < text.len() { start + "…" } else { start }
}

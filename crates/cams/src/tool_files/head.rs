//! The head of a file: statements on the cam, each in a line of its own after a comment mark. One that contradicts the cam is refused with its
//! line.
//!
//! A statement has a key before its colon. Other lines are remarks, unless the mark names this version of camgen: then every statement of this
//! version must be present.

use camgen_kernel::document::HeadingUnit;

/// Beginning of the mark of this version.
const MARK: &str = concat!("camgen ", env!("CARGO_PKG_VERSION"), ", inputs ");
/// Largest relative difference of equal numbers.
pub(super) const SAME: f64 = 1e-6;
/// Largest relative difference of equal errors, computed again from rounded rows.
const SAME_ERROR: f64 = 0.02;

/// Where the unit begins in a key.
const UNITS: [&str; 3] = ["_mm", "_in", "_rad"];

/// Statements as the lines of a head, each after a comment mark.
pub(super) fn head_lines(mark: &str, statements: &[String]) -> String {
    let mut head = String::new();
    for statement in statements {
        head.extend([mark, " ", statement, "\n"]);
    }
    head
}

/// A line of a head, without its mark of a comment.
pub(super) struct HeadLine<'t> {
    pub(super) line: usize,
    pub(super) text: &'t str,
}

/// The number in the first statement whose key begins with `key`.
pub(super) fn value<'t>(mut lines: impl Iterator<Item = &'t str>, key: &str) -> Option<f64> {
    lines.find(|line| line.starts_with(key))?.split_once(": ")?.1.parse().ok()
}

/// The lines that begin with a comment mark.
pub(super) fn lines_after<'t>(text: &'t str, mark: &str) -> Vec<HeadLine<'t>> {
    let numbered = text.lines().enumerate();
    let own = numbered.filter_map(|(index, line)| {
        Some(HeadLine { line: index + 1, text: line.trim_start().strip_prefix(mark)?.trim() })
    });
    own.collect()
}

/// The lines of the first comment in structured text.
pub(super) fn lines_in_comment(text: &str) -> Vec<HeadLine<'_>> {
    let lines = text.lines().enumerate().skip_while(|(_, line)| !line.contains("(*"));
    let own = lines.take_while(|(_, line)| line.trim() != "*)");
    own.map(|(index, line)| HeadLine { line: index + 1, text: line.trim().trim_start_matches("(*").trim() }).collect()
}

/// The first statement whose key is that of an expected one in another unit: `tolerance_in` of a file in millimetres.
pub(super) fn in_another_unit(found: &[HeadLine<'_>], expected: &[String]) -> Option<String> {
    let without_unit = |key: &str| UNITS.iter().find_map(|unit| Some(key.split_once(unit)?.0.to_owned()));
    let keys: Vec<(&str, &String)> = expected.iter().filter_map(|due| Some((due.split_once(": ")?.0, due))).collect();
    found.iter().find_map(|line| {
        let (key, _) = line.text.split_once(": ")?;
        let bare = without_unit(key).filter(|_| keys.iter().all(|(own, _)| *own != key))?;
        let (_, due) = keys.iter().find(|(own, _)| without_unit(own).as_ref() == Some(&bare))?;
        Some(mismatch(line.line, line.text, due))
    })
}

/// The first statement that is another than expected.
pub(super) fn contradiction(found: &[HeadLine<'_>], expected: &[String]) -> Option<String> {
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
        (!same(key, stated, value)).then(|| mismatch(line.line, line.text, due))
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
                .map_or_else(|| format!("its head lacks `{}`", short(due)), |line| mismatch(line.line, line.text, due)),
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

/// That a line states something else than is due.
pub(super) fn mismatch(line: usize, stated: &str, due: &str) -> String {
    format!("line {line} of its head states `{}`; of this cam it is `{}`", short(stated), short(due))
}

fn short(text: &str) -> String {
    let start: String = text.chars().take(80).collect();
    if start.len() < text.len() { start + "…" } else { start }
}

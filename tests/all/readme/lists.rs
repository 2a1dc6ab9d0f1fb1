//! Lists of the source, as tables and sections of Markdown.

use camgen::catalogue::{catalogue, checks};
use camgen::check::Check;
use camgen::document::{Key, KeyForm, KeySection, Occurrence, Presence};
use camgen::motion::laws::{LAWS, Law, LawTask};
use std::fmt::Write as _;

/// A list by the name that a page gives it.
pub(super) fn list(name: &str) -> String {
    match name {
        "checks" => checks().map(check).collect::<Vec<_>>().join("\n"),
        "keys" => tables(|_| true).replace("### ", "## "),
        "limits" => tables(|section| section.path == "limits"),
        "laws" => laws(),
        "study" => tables_of(camgen::study::SECTIONS, |_| true),
        "units" => units(),
        "flags" => super::flags::flags(),
        other => panic!("no list {other}"),
    }
}

/// A text in a cell of a table.
pub(super) fn cell(text: &str) -> String {
    plain(text).replace('|', "\\|")
}

/// A text whose signs are not those of Markdown, but for code.
fn plain(text: &str) -> String {
    let escaped = |text: &str| text.replace('*', "\\*").replace('<', "&lt;");
    let parts = text.split('`').enumerate().map(|(at, part)| if at % 2 == 0 { escaped(part) } else { part.to_owned() });
    parts.collect::<Vec<_>>().join("`")
}

fn check(check: &Check) -> String {
    let explained = &check.explained;
    let unit =
        if check.unit.is_empty() || check.unit == "1" { String::new() } else { format!(" Unit: {}.", check.unit) };
    format!(
        "### `{}`\n\n{}{unit}\n\n- How: {}\n- Limit: {}: {}\n- To change: {}\n",
        check.name,
        plain(check.about),
        plain(explained.formula),
        explained.bound.words(),
        plain(explained.usual),
        plain(explained.change)
    )
}

fn laws() -> String {
    let row = |law: &Law| {
        let peaks = law.solve(&LawTask::default()).map_or_else(
            |_| "– | – | –".into(),
            |curve| {
                let peaks = curve.peaks();
                // Where the acceleration jumps at the ends the jerk has no bound either.
                let jerk = if law.continuity < 2 { f64::INFINITY } else { peaks.jerk.value };
                [peaks.velocity.value, peaks.acceleration.value, jerk].map(figure).join(" | ")
            },
        );
        let names = law.aliases.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        format!("| `{}` | {names} | {peaks} | {} | {} |\n", law.name, law.continuity, cell(law.formula))
    };
    let head = "| law | other names | velocity | acceleration | jerk | continuous | formula between rests |\n|---|---|---|---|---|---|---|\n";
    LAWS.iter().map(row).fold(head.to_owned(), |all, row| all + &row)
}

/// A peak, with its digits that matter.
fn figure(value: f64) -> String {
    if value.is_finite() { format!("{:.3}", value.abs()) } else { "∞".into() }
}

/// The tables of a machine file with their keys.
fn tables(wanted: impl Fn(&KeySection) -> bool) -> String {
    tables_of(&catalogue().keys.sections, wanted)
}

/// Tables of a file with their keys.
fn tables_of(all: &[&KeySection], wanted: impl Fn(&KeySection) -> bool) -> String {
    let mut text = String::new();
    let mut path = None;
    for section in all.iter().filter(|section| wanted(section)) {
        if path != Some((section.path, section.occurs == Occurrence::Repeated)) {
            path = Some((section.path, section.occurs == Occurrence::Repeated));
            write!(
                text,
                "{}\n\n| key | value | meaning | required or default |\n|---|---|---|---|\n",
                heading(section)
            )
            .expect("a text");
        }
        for key in section.keys {
            text += &row(section, key);
        }
        if !text.ends_with("\n\n") {
            text.push('\n');
        }
    }
    // Keys that are added to a table continue it.
    text.replace("|\n\n|", "|\n|").trim_end().to_owned() + "\n"
}

/// The kinds of quantities that keys have, with their units.
fn units() -> String {
    let keys = catalogue().keys.sections.iter().flat_map(|section| section.keys);
    let mut rows: Vec<String> = Vec::new();
    for dimension in keys.flat_map(|key| key.form.dimensions()) {
        let symbols: Vec<String> = dimension.unit_list().split(", ").map(|unit| format!("`{unit}`")).collect();
        let row = format!("| {dimension} | {} |\n", symbols.join(", "));
        if !rows.contains(&row) {
            rows.push(row);
        }
    }
    "| quantity | units |\n|---|---|\n".to_owned() + &rows.concat()
}

fn heading(section: &KeySection) -> String {
    let path = section.path;
    let about = if section.about.is_empty() { String::new() } else { format!("\n\n{}.", capital(section.about)) };
    match section.occurs {
        _ if path.is_empty() => "### Before the first table".into(),
        Occurrence::Repeated => format!("### `[[{path}]]`{about}"),
        _ => format!("### `[{path}]`{about}"),
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn row(section: &KeySection, key: &Key) -> String {
    let own = if key.cams == section.cams { &[] } else { key.cams };
    let only =
        if own.is_empty() { String::new() } else { format!(" ({} only)", catalogue().keys.listed(own).join(", ")) };
    let example = |typed: &str| format!("`{}`", cell_code(&key.in_toml(typed)));
    let needed = match key.presence {
        Presence::Required(typed) => format!("required; e.g. {}", example(typed)),
        Presence::RequiredUnless(table, typed) => format!("required without `[{table}]`; e.g. {}", example(typed)),
        Presence::Default(typed) => format!("default {}", example(typed)),
        Presence::Optional(typed) => format!("optional; e.g. {}", example(typed)),
    };
    let about = cell(key.about);
    format!("| `{}` | {} | {about}{only} | {needed} |\n", key.name, value(key.form))
}

/// A text between back quotes in a cell.
fn cell_code(text: &str) -> String {
    text.replace('|', "\\|")
}

/// What a value may be.
fn value(form: KeyForm) -> String {
    let words = |words: &[&str]| words.iter().map(|word| format!("`\"{word}\"`")).collect::<Vec<_>>().join(", ");
    match form {
        KeyForm::Text => "text".into(),
        KeyForm::TextOrNumber => "text or number".into(),
        KeyForm::Boolean => "true or false".into(),
        KeyForm::Number(_) => "number".into(),
        KeyForm::Share(_) => "share".into(),
        KeyForm::Numbers(_) => "list of numbers".into(),
        KeyForm::Texts => "list of texts or numbers".into(),
        KeyForm::Quantity(dimension, _) => dimension.to_string(),
        KeyForm::LengthOrAngle(..) => "length or angle".into(),
        KeyForm::AngleOrLength(..) => "angle or length".into(),
        KeyForm::LengthAngleOrShare(..) => "length, angle or share".into(),
        KeyForm::Either((one, _), (other, _)) => format!("{one} or {other}"),
        KeyForm::Words(all) => words(all),
        KeyForm::WordsOrQuantity(all, dimension, _) => format!("{} or {dimension}", words(all)),
        KeyForm::Band(dimension, _) => format!("two of {dimension}: `\"low .. high\"`"),
        KeyForm::Pair(dimension, _) => format!("list of two of {dimension}"),
        KeyForm::Points(..) => "list of points: angle or length, position".into(),
        KeyForm::Columns => "path of a file".into(),
    }
}

//! A commented file to start from, written from the sections.

use super::key::{Key, KeySection, Occurrence, Presence, continues};
use super::tables::Tables;

/// Column at which the comments after the keys begin.
const COMMENT_COLUMN: usize = 38;
/// Longest line.
const WIDTH: usize = 120;

/// What a file to start from contains.
#[derive(Debug, Clone, Copy)]
pub struct TemplateOptions<'a> {
    /// Optional tables that are not commented out.
    pub tables: &'a [&'a str],
    /// Keys that may be absent and are not commented out, with their tables.
    pub keys: &'a [&'a str],
    /// The kind of cam it is for.
    pub cam: &'a str,
    /// Keys without effect on it are left out, instead of being commented out.
    pub only: bool,
}

/// A file with every key of the sections: required ones with an example, others with their default, and what may be
/// absent commented out, as are optional tables and keys without effect on the kind of cam. `title` becomes the comment at its head.
#[must_use]
pub fn template(title: &str, tables: &Tables, sections: &[&KeySection], start: &TemplateOptions<'_>) -> String {
    let mut text = comment(title);
    for (index, section) in sections.iter().enumerate() {
        // An optional table is commented out as a whole.
        let mark = if section.occurs == Occurrence::Once || start.tables.contains(&section.path) { "" } else { "# " };
        if !continues(sections, index) {
            text.push('\n');
            match (section.path, section.occurs) {
                ("", _) => {}
                (path, Occurrence::Repeated) => text.push_str(&line(&format!("{mark}[[{path}]]"), section.about)),
                (path, _) => text.push_str(&line(&format!("{mark}[{path}]"), section.about)),
            }
        }
        for key in section.keys {
            let idle = !key.cams.is_empty() && !tables.names(key.cams, start.cam);
            if idle && start.only {
                continue;
            }
            let absent =
                matches!(key.presence, Presence::Optional(_)) && !start.keys.contains(&section.path_of(key).as_str());
            let mark = if idle || absent { "# " } else { mark };
            let value = key.in_toml(key.presence.text());
            let about = if start.only { key.about.to_owned() } else { about(key, tables) };
            text.push_str(&line(&format!("{mark}{} = {value}", key.name), &about));
        }
    }
    text
}

/// What a key means and which kinds of cam it is for.
fn about(key: &Key, tables: &Tables) -> String {
    if key.cams.is_empty() {
        key.about.to_owned()
    } else {
        format!("{} ({} only)", key.about, tables.listed(key.cams).join(", "))
    }
}

/// A line with its comment after it, or above it where both do not fit.
fn line(code: &str, about: &str) -> String {
    let on_one_line = format!("{code:COMMENT_COLUMN$}# {about}");
    if about.is_empty() {
        format!("{code}\n")
    } else if code.chars().count() < COMMENT_COLUMN && on_one_line.chars().count() <= WIDTH {
        format!("{on_one_line}\n")
    } else {
        format!("{}{code}\n", comment(about))
    }
}

/// A text as comment lines.
fn comment(text: &str) -> String {
    let mut lines = String::new();
    let mut line = String::from("#");
    for word in text.split_whitespace() {
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push_str(&line);
            lines.push('\n');
            line = String::from("#");
        }
        line.push(' ');
        line.push_str(word);
    }
    format!("{lines}{line}\n")
}

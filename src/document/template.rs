//! A commented file to start from, written from the sections.

use super::key::{Key, Occurs, Presence, Section};

/// Column at which the comments after the keys begin.
const COMMENT_COLUMN: usize = 38;
/// Longest line.
const WIDTH: usize = 120;

/// A file with every key of the sections: required ones with an example, others with their default, and what may be
/// absent commented out; optional tables not in `shown`, and keys without effect on `cam`, are commented out too. `title`
/// becomes the comment at its head.
#[must_use]
pub fn template(title: &str, sections: &[&Section], shown: &[&str], cam: &str) -> String {
    let mut text = comment(title);
    for section in sections {
        // What may be absent as a whole is commented out as a whole.
        let mark = if section.occurs == Occurs::Once || shown.contains(&section.path) { "" } else { "# " };
        text.push('\n');
        match (section.path, section.occurs) {
            ("", _) => {}
            (path, Occurs::Repeated) => text.push_str(&line(&format!("{mark}[[{path}]]"), section.about)),
            (path, _) => text.push_str(&line(&format!("{mark}[{path}]"), section.about)),
        }
        for key in section.keys {
            let idle = !key.cams.is_empty() && !key.cams.contains(&cam);
            let mark = if idle || matches!(key.presence, Presence::Optional(_)) { "# " } else { mark };
            let value = key.in_toml(key.presence.text());
            text.push_str(&line(&format!("{mark}{} = {value}", key.name), &about(key)));
        }
    }
    text
}

/// What a key means and which kinds of cam it is for.
fn about(key: &Key) -> String {
    if key.cams.is_empty() { key.about.to_owned() } else { format!("{} ({} only)", key.about, key.cams.join(", ")) }
}

/// A line with its comment after it, or above it where both do not fit.
fn line(code: &str, about: &str) -> String {
    let beside = format!("{code:COMMENT_COLUMN$}# {about}");
    if about.is_empty() {
        format!("{code}\n")
    } else if code.chars().count() < COMMENT_COLUMN && beside.chars().count() <= WIDTH {
        format!("{beside}\n")
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

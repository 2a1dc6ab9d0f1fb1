//! Text from outside made safe to show and store: a terminal obeys control characters, some characters reverse the direction of a line,
//! and some code points are not characters.

use std::borrow::Cow;

/// Whether a character is a letter, sign or blank without any effect on the text around it.
#[must_use]
pub fn is_plain(c: char) -> bool {
    let marks = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}' | '\u{2029}' | '\u{feff}');
    is_text(c) && !marks
}

/// Whether a character may occur in a name: marks of right-to-left languages and of the ends of lines and paragraphs may,
/// marks that reverse the direction of the text after them may not.
pub(super) fn is_text(c: char) -> bool {
    let turns = matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let is_no_character = u32::from(c) & 0xfffe == 0xfffe || matches!(c, '\u{fdd0}'..='\u{fdef}');
    !(c.is_control() || turns || is_no_character)
}

fn escaped(text: &str, stays: impl Fn(char) -> bool) -> Cow<'_, str> {
    if text.chars().all(&stays) {
        return Cow::Borrowed(text);
    }
    let mut made = String::with_capacity(text.len());
    for c in text.chars() {
        if stays(c) {
            made.push(c);
            continue;
        }
        // As in JSON, so that a JSON text stays the same data.
        for unit in c.encode_utf16(&mut [0; 2]) {
            made.push_str(&format!("\\u{unit:04x}"));
        }
    }
    Cow::Owned(made)
}

/// A text of several lines, for a terminal: what is not plain becomes its code, `\u001b`. A JSON text stays the same data.
#[must_use]
pub fn plain(text: &str) -> Cow<'_, str> {
    escaped(text, |c| is_plain(c) || matches!(c, '\n' | '\t'))
}

/// A name or a value in a message: in one line, with the beginning of a long one.
#[must_use]
pub fn shown(text: &str, most: usize) -> String {
    let cut = text.char_indices().nth(most).and_then(|(end, _)| text.get(..end));
    let escaped = escaped(cut.unwrap_or(text), is_plain);
    if cut.is_some() { format!("{escaped}…") } else { escaped.into_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_becomes_its_code() {
        for (text, expected) in [
            ("Ø 25 µm\t→\n", "Ø 25 µm\t→\n"),
            ("\u{1b}[31mred", "\\u001b[31mred"),
            ("a\rb\u{7f}", "a\\u000db\\u007f"),
            ("\u{9b}31m", "\\u009b31m"),
            ("\u{202e}gpj.exe\u{2069}", "\\u202egpj.exe\\u2069"),
            ("\u{fffe}\u{ffff}\u{1fffe}", "\\ufffe\\uffff\\ud83f\\udffe"),
        ] {
            assert_eq!(plain(text), expected, "{text:?}");
            assert!(plain(text).chars().all(|c| is_plain(c) || c == '\n' || c == '\t'));
        }
    }

    #[test]
    fn json_stays_the_same_data() {
        let value = serde_json::json!({ "name": "a\u{9b}\u{202e}\u{ffff}\u{7f}\u{1b}\u{1ffff}" });
        let text = serde_json::to_string_pretty(&value).expect("JSON");
        assert_eq!(serde_json::from_str::<serde_json::Value>(&plain(&text)).expect("JSON"), value);
        assert_ne!(plain(&text), text);
    }

    #[test]
    fn long_names_are_cut() {
        assert_eq!(shown("CAM_PROFILE", 80), "CAM_PROFILE");
        assert_eq!(shown("öäü", 2), "öä…");
        assert_eq!(shown("a\nb", 80), "a\\u000ab");
    }
}

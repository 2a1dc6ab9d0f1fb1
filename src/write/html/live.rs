//! The live page: the moving report with the engine in it, or in the program that serves it. The engine is the library as WebAssembly
//! (`live/build`), the same call as `camgen::engine` in the program.

use super::{CHARTS, CHARTS_LICENCE, CHARTS_STYLE, SCRIPTS, STYLE, filled, in_script, text};
use crate::refusal::Refusal;
use serde_json::{Value, json};

/// The engine, compressed.
pub const ENGINE: &[u8] = include_bytes!("../../../templates/live/engine.wasm.gz");
/// Its digest, as hexadecimal digits and a line feed.
pub const ENGINE_DIGEST: &str = include_str!("../../../templates/live/engine.sha256");

/// Steps of a turn in the page itself.
pub(super) const FIRST_STEPS: u32 = 180;

const PAGE: &str = include_str!("../../../templates/live/page.html");
const OWN_STYLE: &str = include_str!("../../../templates/live/style.css");
const OWN_SCRIPTS: [&str; 7] = [
    include_str!("../../../templates/live/texts.js"),
    include_str!("../../../templates/live/engine.js"),
    include_str!("../../../templates/live/form.js"),
    include_str!("../../../templates/live/live.js"),
    include_str!("../../../templates/live/motion.js"),
    include_str!("../../../templates/live/designs.js"),
    include_str!("../../../templates/live/start.js"),
];
/// The texts of the page in each language.
const TEXTS: [(&str, &str); 2] = [
    ("en", include_str!("../../../templates/live/texts.en.json")),
    ("de", include_str!("../../../templates/live/texts.de.json")),
];

/// The design that a live page begins with.
#[derive(Debug, Clone, PartialEq)]
pub struct LiveDesign {
    /// What the names of its files begin with.
    pub name: String,
    /// The text of its machine file.
    pub toml: String,
    /// The command that makes its cam.
    pub command: String,
    /// The commands that make a cam of its file.
    pub commands: Vec<String>,
    /// Speeds, rpm; empty for that of the file.
    pub rpm: Vec<f64>,
    /// Tolerance of the outline, m.
    pub tolerance: f64,
}

/// A program that serves the page and answers its requests.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LiveServer {
    /// What requests must bring.
    pub token: String,
    /// The machine file that the page may write, as it is shown.
    pub file: Option<String>,
}

/// The live page of a cam: with its own engine, or with that of a program that serves it.
///
/// # Errors
/// Only what `serde_json` cannot write, which a report is not.
pub fn page((title, cam): (&str, Value), design: &LiveDesign, server: Option<&LiveServer>) -> Result<Vec<u8>, Refusal> {
    let live = json!({
        "name": design.name, "toml": design.toml, "command": design.command, "commands": design.commands, "rpm": design.rpm,
        "tolerance": design.tolerance,
        "served": server.map(|server| json!({"token": server.token, "file": server.file})),
    });
    let texts: Vec<String> = TEXTS.iter().map(|(name, table)| format!("\"{name}\":{table}")).collect();
    let engine = if server.is_some() { String::new() } else { printable(ENGINE) };
    let data = in_script(&json!({"schema": 1, "cams": [cam]}))?;
    let live = in_script(&live)?;
    let lookup = |name: &str| match name {
        "title" => text(title),
        "style" => format!("{CHARTS_STYLE}\n{STYLE}\n{OWN_STYLE}"),
        "data" => data.clone(),
        "live" => live.clone(),
        "texts" => format!("{{{}}}", texts.join(",")).replace('<', "\\u003c"),
        "engine" => engine.clone(),
        "licence" => text(CHARTS_LICENCE),
        "charts" => CHARTS.to_owned(),
        "script" => [SCRIPTS.concat(), OWN_SCRIPTS.concat()].concat(),
        _ => String::new(),
    };
    Ok(filled(PAGE, lookup))
}

/// The characters of the engine in the page, none of which means anything to HTML.
const ALPHABET: &[u8; 85] = b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%()*+,-./:;=?@[]^_|~";

/// Bytes as text, five characters for four bytes, after the number of zeros at the end that are not of them. Base64 would be a fifteenth longer.
fn printable(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len() / 4 * 5 + 6);
    text.push_str(&(bytes.len().next_multiple_of(4) - bytes.len()).to_string());
    for part in bytes.chunks(4) {
        let byte = |at: usize| u32::from(part.get(at).copied().unwrap_or(0));
        let mut value = byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3);
        let mut digits = [0; 5];
        for digit in digits.iter_mut().rev() {
            *digit = value % 85;
            value /= 85;
        }
        text.extend(
            digits.iter().filter_map(|digit| ALPHABET.get(usize::try_from(*digit).ok()?)).map(|c| char::from(*c)),
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_engine_is_the_one_whose_digest_is_stored() {
        assert_eq!(crate::report::sha256(ENGINE), ENGINE_DIGEST.trim());
        assert!(ENGINE.starts_with(&[0x1f, 0x8b]), "compressed by gzip");
    }

    #[test]
    fn the_engine_is_printable() {
        let text = printable(&[0xff, 0xff, 0xff, 0xff, 0, 0]);
        assert_eq!((text.len(), text.as_bytes()[0]), (11, b'2'), "{text}");
        let digit = |c: u8| ALPHABET.iter().position(|other| *other == c).expect("a digit") as u64;
        let value = |part: &str| part.bytes().fold(0, |all, c| 85 * all + digit(c));
        assert_eq!((value(&text[1..6]), value(&text[6..11])), (0xffff_ffff, 0));
        assert!(!ALPHABET.iter().any(|c| b"<>&\"'`\\{}".contains(c)), "no sign of HTML or of a template");
    }

    #[test]
    fn every_text_is_there_in_each_language() {
        let tables = TEXTS.map(|(_, table)| serde_json::from_str::<Value>(table).expect("JSON"));
        let names = |table: &Value| table["page"].as_object().expect("texts").keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(&tables[0]), names(&tables[1]));
        let scripts = OWN_SCRIPTS.concat();
        let asked = PAGE.split("data-text=\"").skip(1).map(|rest| rest.split('"').next().unwrap_or_default());
        let in_scripts = scripts.split("text(\"").skip(1).map(|rest| rest.split('"').next().unwrap_or_default());
        for name in asked.chain(in_scripts) {
            assert!(tables[0]["page"].get(name).is_some(), "no text `{name}`");
        }
    }

    #[test]
    fn a_page_has_one_engine_and_no_address() {
        let design = LiveDesign {
            name: "a".into(),
            toml: "name = \"</script>\"".into(),
            command: "make".into(),
            commands: vec!["make".into()],
            rpm: Vec::new(),
            tolerance: 5e-6,
        };
        let own = String::from_utf8(page(("A", json!({})), &design, None).expect("a page")).expect("text");
        assert!(own.len() < 3_000_000, "{} bytes", own.len());
        assert!(!own.contains("name = \\\"</script>"), "a text of the user is not closed");
        let server = LiveServer { token: "t".into(), file: None };
        let served = page(("A", json!({})), &design, Some(&server)).expect("a page");
        assert!(served.len() < 400_000, "{} bytes", served.len());
    }
}

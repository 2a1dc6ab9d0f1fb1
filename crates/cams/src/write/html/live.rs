//! The live page: the moving report with the engine in it, or in the program that serves it. The engine is the library as WebAssembly
//! (`live/build`), the same call as `camgen::engine` in the program.

use super::{
    ANIMATION, CHARTS, CHARTS_LICENCE, CHARTS_STYLE, COMMON, CURVES, DIAGRAM, EXTREMES, MARGINS, MOVING_PARTS, READOUT,
    SOLID, STACK, STYLE, TABLES, filled, in_script, text,
};
use camgen_kernel::refusal::Refusal;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// The engine, compressed by zstd.
pub const ENGINE: &[u8] = include_bytes!("../../../templates/live/engine.wasm.zst");
/// Its digest, as hexadecimal digits and a line feed.
pub const ENGINE_DIGEST: &str = include_str!("../../../templates/live/engine.sha256");
/// What unpacks the engine in the page.
const UNPACK: &str = include_str!("../../../templates/vendor/fzstd/fzstd.min.js");
const UNPACK_LICENCE: &str = include_str!("../../../templates/vendor/fzstd/LICENSE");

/// Steps of a turn in the page itself.
pub(super) const FIRST_STEPS: u32 = 180;

const PAGE: &str = include_str!("../../../templates/live/page.html");
const OWN_STYLE: &str = include_str!("../../../templates/live/style.css");
/// The scripts: those of the report, with a mechanism and plots that change while a slider moves.
const SCRIPTS: [&str; 30] = [
    COMMON,
    MARGINS,
    MOVING_PARTS,
    include_str!("../../../templates/live/outline.js"),
    include_str!("../../../templates/live/dimensions.js"),
    include_str!("../../../templates/live/mechanism.js"),
    READOUT,
    SOLID,
    TABLES,
    CURVES,
    DIAGRAM,
    EXTREMES,
    STACK,
    include_str!("../../../templates/live/plot.js"),
    ANIMATION,
    include_str!("../../../templates/live/texts.js"),
    include_str!("../../../templates/live/engine.js"),
    include_str!("../../../templates/live/units.js"),
    include_str!("../../../templates/live/form.js"),
    include_str!("../../../templates/live/live.js"),
    include_str!("../../../templates/live/zones.js"),
    include_str!("../../../templates/live/compare.js"),
    include_str!("../../../templates/live/motion.js"),
    include_str!("../../../templates/live/segments.js"),
    include_str!("../../../templates/live/laws.js"),
    include_str!("../../../templates/live/measured.js"),
    include_str!("../../../templates/live/newcam.js"),
    include_str!("../../../templates/live/designs.js"),
    include_str!("../../../templates/live/tabs.js"),
    include_str!("../../../templates/live/start.js"),
];
/// What the page may do in a browser.
const POLICY: &str =
    "script-src 'unsafe-inline' 'wasm-unsafe-eval'; worker-src blob:; connect-src 'self'; img-src data: blob:";
/// The texts of the page in each language.
const TEXTS: [(&str, &str); 2] = [
    ("en", include_str!("../../../templates/live/texts.en.json")),
    ("de", include_str!("../../../templates/live/texts.de.json")),
];

/// A design of a live page.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LiveDesign {
    /// What the names of its files begin with.
    pub name: String,
    /// Behind it they have command and speed, as those of the command line.
    pub usual_names: bool,
    /// The text of its machine file.
    pub toml: String,
    /// The texts of the files that it names, by these names.
    pub files: BTreeMap<String, String>,
    /// The command that makes its cam.
    pub command: String,
    /// The commands that make a cam of its file.
    pub commands: Vec<String>,
    /// Speeds, rpm; empty for that of the file.
    pub rpm: Vec<f64>,
    /// Tolerance of the outline, m.
    pub tolerance: f64,
    /// The machine file that the page may write, as it is shown.
    pub file: Option<String>,
}

/// The live page of a cam, that of the first design: with its own engine, or with that of a program that serves it to whoever has the token.
///
/// # Errors
/// Only what `serde_json` cannot write, which a report is not.
pub fn page((title, cam): (&str, Value), designs: &[LiveDesign], token: Option<&str>) -> Result<Vec<u8>, Refusal> {
    let of = |design: &LiveDesign| {
        json!({
            "name": design.name, "usual_names": design.usual_names, "toml": design.toml, "files": design.files, "command": design.command,
            "commands": design.commands, "rpm": design.rpm, "tolerance": design.tolerance, "file": design.file,
        })
    };
    let live = json!({"designs": designs.iter().map(of).collect::<Vec<Value>>(), "token": token});
    let texts: Vec<String> = TEXTS.iter().map(|(name, table)| format!("\"{name}\":{table}")).collect();
    let engine = if token.is_some() { String::new() } else { printable(ENGINE) };
    let data = in_script(&json!({"schema": 1, "cams": [cam]}))?;
    let live = in_script(&live)?;
    let lookup = |name: &str| match name {
        "policy" => POLICY.to_owned(),
        "title" => text(title),
        "style" => format!("{CHARTS_STYLE}\n{STYLE}\n{OWN_STYLE}"),
        "data" => data.clone(),
        "live" => live.clone(),
        "texts" => format!("{{{}}}", texts.join(",")).replace('<', "\\u003c"),
        "unpack" if token.is_none() => UNPACK.to_owned(),
        "engine" => engine.clone(),
        "licence" => text(&format!("{CHARTS_LICENCE}\n{UNPACK_LICENCE}")),
        "charts" => CHARTS.to_owned(),
        "script" => super::without_comments(&SCRIPTS),
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
        assert!(ENGINE.starts_with(&[0x28, 0xb5, 0x2f, 0xfd]), "compressed by zstd");
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
        let scripts = SCRIPTS.concat().replace("getContext(", "");
        let asked = PAGE.split("data-text=\"").skip(1).map(|rest| rest.split('"').next().unwrap_or_default());
        let in_scripts = scripts.split("text(\"").skip(1).map(|rest| rest.split('"').next().unwrap_or_default());
        let said = scripts.split("say(\"").skip(1).map(|rest| rest.split('"').next().unwrap_or_default());
        for name in asked.chain(in_scripts).chain(said) {
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
            tolerance: 5e-6,
            ..LiveDesign::default()
        };
        let own = String::from_utf8(page(("A", json!({})), std::slice::from_ref(&design), None).expect("a page"))
            .expect("text");
        assert!(own.len() < 3_000_000, "{} bytes", own.len());
        assert!(!own.contains("name = \\\"</script>"), "a text of the user is not closed");
        let served = page(("A", json!({})), &[design], Some("t")).expect("a page");
        assert!(served.len() < 400_000, "{} bytes", served.len());
    }
}

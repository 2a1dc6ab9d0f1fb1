//! Names that files may begin with, on every system.

use camgen_kernel::document::is_plain;

/// Longest stem, in characters and in bytes: what is added to it still fits a file system.
const LONGEST: usize = 100;
const MOST_BYTES: usize = 180;
/// The stem of a name without any character that fits.
const UNNAMED: &str = "machine";
/// Names of devices under Windows, whatever follows a point.
const DEVICES: [&str; 6] = ["con", "prn", "aux", "nul", "conin$", "conout$"];
const NUMBERED_DEVICES: [&str; 2] = ["com", "lpt"];

fn fits(c: char) -> bool {
    is_plain(c) && !"/\\:*?\"<>|".contains(c)
}

fn is_device(stem: &str) -> bool {
    let name = stem.split('.').next().unwrap_or_default().trim().to_ascii_lowercase();
    DEVICES.contains(&name.as_str())
        || NUMBERED_DEVICES.iter().any(|device| {
            let mut rest = name.strip_prefix(*device).unwrap_or_default().chars();
            // Windows also reads the Latin-1 superscript digits as digits.
            rest.next().is_some_and(|digit| digit.is_ascii_digit() || "¹²³".contains(digit)) && rest.next().is_none()
        })
}

/// Why files cannot be called by a stem; `None` where they can.
#[must_use]
pub fn fault_of(stem: &str) -> Option<String> {
    if stem.is_empty() || stem.starts_with(['.', '-', ' ']) || !stem.chars().all(fits) {
        let why =
            "a file stem has no path separators, no control characters, no wildcards and no leading dot, dash or blank";
        return Some(format!("{why}; see --out for a directory"));
    }
    if stem.chars().count() > LONGEST || stem.len() > MOST_BYTES {
        return Some(format!("a file stem has at most {LONGEST} characters, and {MOST_BYTES} bytes"));
    }
    is_device(stem).then(|| format!("`{stem}` is a device under Windows; choose another file stem"))
}

/// The stem nearest to a name that files can be called by.
#[must_use]
pub fn fitting(name: &str) -> String {
    let plain: String = name.chars().map(|c| if fits(c) { c } else { '-' }).collect();
    let mut stem: String = plain.trim_start_matches(['.', '-', ' ']).chars().take(LONGEST).collect();
    while stem.len() > MOST_BYTES {
        stem.pop();
    }
    let stem = stem.trim_end_matches(['.', '-', ' ']);
    match stem {
        "" => UNNAMED.to_owned(),
        stem if is_device(stem) => format!("{UNNAMED}-{stem}"),
        stem => stem.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_made_to_fit() {
        for (name, stem) in [
            ("press 2.1", "press 2.1"),
            ("über", "über"),
            ("-rf", "rf"),
            (".hidden", "hidden"),
            ("..", UNNAMED),
            ("", UNNAMED),
            ("a\nb\u{1b}[31m", "a-b-[31m"),
            ("a\u{202e}b\u{ffff}", "a-b"),
            ("c:\\a/b", "c--a-b"),
            ("NUL", "machine-NUL"),
            ("com1.x", "machine-com1.x"),
            ("company", "company"),
            ("COM¹", "machine-COM¹"),
            ("com12", "com12"),
            ("conin", "conin"),
        ] {
            assert_eq!(fitting(name), stem, "{name:?}");
            assert_eq!(fault_of(stem), None, "{stem:?}");
        }
        for long in ["x".repeat(250), "ü".repeat(250), "𝛼".repeat(250)] {
            assert!(fault_of(&long).is_some());
            assert_eq!(fault_of(&fitting(&long)), None);
        }
    }

    #[test]
    fn stems_that_do_not_fit_are_told() {
        for stem in [
            "",
            ".x",
            "-x",
            "a/b",
            "a\\b",
            "a\nb",
            "a\u{202e}",
            "con",
            "LPT1.dxf",
            " x",
            "COM¹",
            "lpt³.a",
            "CONIN$",
            "conout$",
        ] {
            assert!(fault_of(stem).is_some(), "{stem:?}");
        }
    }
}

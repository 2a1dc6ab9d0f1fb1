//! Files of other kinds that are given for a machine file.

/// What a text is instead of a machine file, and what to do; `None` where it may be one.
pub(super) fn instead_of_machine(name: &str, text: &[u8]) -> Option<(&'static str, String)> {
    let begins = |start: &str| text.trim_ascii_start().starts_with(start.as_bytes());
    let line = |number: usize| text.split(|byte| *byte == b'\n').nth(number).unwrap_or_default().trim_ascii();
    let check = || format!("`camgen check {name} --design DESIGN.toml` compares it with a design");
    let is_dxf = begins("AutoCAD Binary DXF") || line(0) == b"999" || (line(0) == b"0" && line(1) == b"SECTION");
    if text.trim_ascii().is_empty() {
        return Some((
            "an empty file",
            "`camgen init --follower roller` prints a motion program to start from, `camgen init` a press".into(),
        ));
    }
    if is_dxf {
        return Some(("a DXF drawing", check()));
    }
    if begins("ISO-10303-21") {
        return Some(("a STEP file", check()));
    }
    let made = [
        ("<?xml", "an XML or SVG file"),
        ("<svg", "an SVG picture"),
        ("<!", "an HTML page"),
        ("%PDF", "a PDF document"),
        ("PK\u{3}\u{4}", "a packed file"),
    ];
    if let Some((_, kind)) = made.iter().find(|(start, _)| begins(start)) {
        return Some((kind, "give the TOML file of the design".into()));
    }
    if begins("{") {
        return Some((
            "a JSON file",
            "give the TOML file of the design; of a report the key `machine` has its name".into(),
        ));
    }
    // Rows of numbers, with a header or without.
    let is_row = |row: &[u8]| {
        let cells = || row.split(|byte| matches!(byte, b',' | b';' | b'\t' | b' ')).filter(|cell| !cell.is_empty());
        cells().count() >= 2
            && cells().all(|cell| std::str::from_utf8(cell).is_ok_and(|cell| cell.trim().parse::<f64>().is_ok()))
    };
    if is_row(line(0)) || (!line(0).contains(&b'=') && is_row(line(1)) && is_row(line(2))) {
        let help = format!("in a machine file [motion] table = \"{name}\" makes it a motion");
        return Some(("a table of numbers", help));
    }
    None
}

#[cfg(test)]
mod tests {
    use super::instead_of_machine;

    #[test]
    fn other_files_are_recognised_and_machine_files_are_not() {
        for (text, kind) in [
            ("", Some("an empty file")),
            (" \n\r\n", Some("an empty file")),
            ("999\ncamgen\n0\nSECTION\n", Some("a DXF drawing")),
            ("  0\r\nSECTION\r\n", Some("a DXF drawing")),
            ("ISO-10303-21;\n", Some("a STEP file")),
            ("<?xml version=\"1.0\"?>", Some("an XML or SVG file")),
            ("%PDF-1.7", Some("a PDF document")),
            ("{\"schema\": 1}", Some("a JSON file")),
            ("0,0\n1,0.2\n", Some("a table of numbers")),
            ("cam_deg,lift_mm\n0,0\n1,0.2\n", Some("a table of numbers")),
            ("name = \"x\"\n", None),
            ("# 1 2\n[cam]\n", None),
            ("999 = 1\n", None),
        ] {
            assert_eq!(instead_of_machine("file", text.as_bytes()).map(|(kind, _)| kind), kind, "{text}");
        }
    }
}

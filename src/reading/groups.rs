//! The group codes of a DXF file, text or binary: what an outline can be made of is kept, before anything is made of it.
//!
//! Kept are the version and the unit of the header and the entities without extended data and application groups. What is left
//! out cannot cut metal, and a reader of whole drawings can be made to fail by it: dates that do not exist, groups nested
//! without end.

use super::ReadError;
use std::borrow::Cow;

/// First words of a binary file, with what stands between them and the first group.
const BINARY: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";
/// Variables of the header that are kept.
const VARIABLES: [&[u8]; 2] = [b"$ACADVER", b"$INSUNITS"];
/// Largest number an entity may hold, beyond every drawing: products of several of them are still finite.
const LARGEST: f64 = 1e15;

/// Group codes with a meaning here.
const TYPE: i32 = 0;
const SECTION_NAME: i32 = 2;
const VARIABLE: i32 = 9;
const EMBEDDED_OBJECT: i32 = 101;
const APPLICATION_GROUP: i32 = 102;
const COMMENT: i32 = 999;
const EXTENDED_DATA: i32 = 1000;

/// A code with its value, as the text of a DXF file has it.
struct Group<'a> {
    code: i32,
    value: Cow<'a, [u8]>,
}

/// The section that is being read.
#[derive(Clone, Copy)]
enum Within {
    /// None, or one that is left out.
    LeftOut,
    /// `SECTION` was read, its name was not.
    Unnamed,
    /// The header; whether the variable is kept.
    Header(bool),
    /// The entities.
    Entities,
}

/// The text of a DXF file with only what is kept of the file.
///
/// # Errors
/// [`ReadError`] where the file does not consist of groups, or a number of an entity is not finite.
pub(super) fn kept(bytes: &[u8]) -> Result<Vec<u8>, ReadError> {
    match bytes.strip_prefix(BINARY) {
        Some(rest) => kept_of(Binary { rest, wide: rest.starts_with(&[0, 0]) }),
        None => kept_of(Text { lines: bytes.split(|byte| *byte == b'\n'), line: 0 }),
    }
}

fn kept_of<'a>(groups: impl Iterator<Item = Result<Group<'a>, ReadError>>) -> Result<Vec<u8>, ReadError> {
    let mut text = Vec::new();
    let mut keep = |code: i32, value: &[u8]| {
        text.extend_from_slice(code.to_string().as_bytes());
        text.push(b'\n');
        text.extend_from_slice(value);
        text.push(b'\n');
    };
    let (mut within, mut entity) = (Within::LeftOut, WithinEntity::default());
    for group in groups {
        let Group { code, value } = group?;
        let value: &[u8] = &value;
        match (within, code, value.trim_ascii()) {
            (_, TYPE, b"EOF") => {
                keep(code, b"EOF");
                return Ok(text);
            }
            (_, TYPE, b"SECTION") => within = Within::Unnamed,
            (Within::Unnamed, SECTION_NAME, name) => {
                within = match name {
                    b"HEADER" => Within::Header(false),
                    b"ENTITIES" => Within::Entities,
                    _ => Within::LeftOut,
                };
                if !matches!(within, Within::LeftOut) {
                    keep(TYPE, b"SECTION");
                    keep(SECTION_NAME, name);
                }
            }
            (Within::Header(_) | Within::Entities, TYPE, b"ENDSEC") => {
                entity.keeps(code, value)?;
                keep(code, b"ENDSEC");
                within = Within::LeftOut;
            }
            (Within::Header(_), VARIABLE, name) => {
                let kept = VARIABLES.contains(&name);
                within = Within::Header(kept);
                if kept {
                    keep(code, name);
                }
            }
            (Within::Header(true), ..) => keep(code, value),
            // A name with blanks around it, or in small letters, is the same entity to other readers.
            (Within::Entities, TYPE, name) if entity.keeps(code, name)? => keep(code, &name.to_ascii_uppercase()),
            (Within::Entities, ..) if entity.keeps(code, value)? => keep(code, value),
            _ => {}
        }
    }
    Err(ReadError::CutShort)
}

/// What of an entity is open.
#[derive(Default)]
struct WithinEntity {
    /// An application group.
    group: bool,
    /// An object embedded in the entity, up to the next entity.
    embedded: bool,
}

impl WithinEntity {
    /// Whether the next entity, or the begin or end of an application group, may stand here.
    fn may_follow(&self, code: i32, value: &[u8]) -> bool {
        match (code, value) {
            (APPLICATION_GROUP, b"}") => self.group,
            (APPLICATION_GROUP, _) => !self.group && value.starts_with(b"{"),
            _ => !self.group,
        }
    }

    fn keeps(&mut self, code: i32, value: &[u8]) -> Result<bool, ReadError> {
        match code {
            // What a group that is not closed belongs to, each reader decides for itself.
            TYPE | APPLICATION_GROUP if !self.may_follow(code, value) => {
                return Err(ReadError::NotDxf("an application group (code 102) is not closed, or not opened".into()));
            }
            TYPE => self.embedded = false,
            EMBEDDED_OBJECT => self.embedded |= value.trim_ascii() == b"Embedded Object",
            APPLICATION_GROUP => {
                self.group = !self.group;
                return Ok(false);
            }
            _ => {}
        }
        let kept = !self.group && !self.embedded && code != COMMENT && code < EXTENDED_DATA;
        if kept && matches!(kind(code), Some(Kind::Real)) {
            let number = std::str::from_utf8(value).ok().and_then(|text| text.trim().parse::<f64>().ok());
            if number.is_some_and(|number| number.is_nan() || number.abs() > LARGEST) {
                return Err(ReadError::NotFinite);
            }
        }
        Ok(kept)
    }
}

/// What a value of a binary file is; the reference of DXF, "Group Code Value Types".
#[derive(Clone, Copy)]
enum Kind {
    /// Text that ends with 0.
    Text,
    /// Whole number of so many bytes.
    Whole(usize),
    /// A bool: one byte, two in files before R13.
    Truth,
    /// Eight bytes.
    Real,
    /// A length in one byte, then as many bytes.
    Chunk,
}

fn kind(code: i32) -> Option<Kind> {
    Some(match code {
        0..=9 | 100..=105 | 300..=309 | 320..=369 | 390..=399 | 410..=419 | 430..=439 | 470..=481 | 999..=1003 => {
            Kind::Text
        }
        1005..=1009 => Kind::Text,
        10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => Kind::Real,
        60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => Kind::Whole(2),
        90..=99 | 420..=429 | 440..=459 | 1071 => Kind::Whole(4),
        160..=169 => Kind::Whole(8),
        290..=299 => Kind::Truth,
        310..=319 | 1004 => Kind::Chunk,
        _ => return None,
    })
}

/// The groups of a text file, two lines each.
struct Text<L> {
    lines: L,
    line: usize,
}

impl<'a, L: Iterator<Item = &'a [u8]>> Iterator for Text<L> {
    type Item = Result<Group<'a>, ReadError>;

    fn next(&mut self) -> Option<Self::Item> {
        let code = self.lines.next()?;
        let value = self.lines.next()?;
        self.line += 2;
        let number = std::str::from_utf8(code).ok().and_then(|text| text.trim().parse().ok());
        let value = value.strip_suffix(b"\r").unwrap_or(value);
        if value.contains(&b'\r') {
            // Some readers take it for the end of a line.
            return Some(Err(ReadError::NotDxf(format!("line {} holds a carriage return within", self.line))));
        }
        Some(match number {
            Some(code) => Ok(Group { code, value: value.into() }),
            None => Err(ReadError::NotDxf(format!("line {} is not a group code", self.line - 1))),
        })
    }
}

/// The groups of a binary file.
struct Binary<'a> {
    rest: &'a [u8],
    /// Codes of two bytes, from R13 on; before, of one, or of two after 255.
    wide: bool,
}

impl<'a> Binary<'a> {
    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(count)?;
        self.rest = rest;
        Some(taken)
    }

    fn byte(&mut self) -> Option<u8> {
        self.take(1)?.first().copied()
    }

    fn code(&mut self) -> Option<i32> {
        let first = if self.wide { 255 } else { self.byte()? };
        if first < 255 {
            return Some(first.into());
        }
        let bytes: [u8; 2] = self.take(2)?.try_into().ok()?;
        Some(i16::from_le_bytes(bytes).into())
    }

    /// A value as the text of a DXF file would have it.
    fn value(&mut self, kind: Kind) -> Option<Cow<'a, [u8]>> {
        Some(match kind {
            Kind::Text => {
                let end = self.rest.iter().position(|byte| *byte == 0)?;
                let text = self.take(end)?;
                self.byte()?;
                text.into()
            }
            Kind::Whole(2) => i16::from_le_bytes(self.take(2)?.try_into().ok()?).to_string().into_bytes().into(),
            Kind::Whole(4) => i32::from_le_bytes(self.take(4)?.try_into().ok()?).to_string().into_bytes().into(),
            Kind::Whole(_) => i64::from_le_bytes(self.take(8)?.try_into().ok()?).to_string().into_bytes().into(),
            Kind::Truth if self.wide => self.byte()?.to_string().into_bytes().into(),
            Kind::Truth => i16::from_le_bytes(self.take(2)?.try_into().ok()?).to_string().into_bytes().into(),
            // The shortest text that is read back as the same number.
            Kind::Real => format!("{:?}", f64::from_le_bytes(self.take(8)?.try_into().ok()?)).into_bytes().into(),
            Kind::Chunk => {
                // A preview or another program's data.
                let length = self.byte()?.into();
                self.take(length)?;
                Cow::default()
            }
        })
    }
}

impl<'a> Iterator for Binary<'a> {
    type Item = Result<Group<'a>, ReadError>;

    fn next(&mut self) -> Option<Self::Item> {
        let code = self.code()?;
        let Some(kind) = kind(code) else {
            return Some(Err(ReadError::NotDxf(format!("{code} is not a group code"))));
        };
        Some(Ok(Group { code, value: self.value(kind)? }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(groups: &[(i32, &str)]) -> Vec<u8> {
        groups.iter().map(|(code, value)| format!("{code:3}\r\n{value}\r\n")).collect::<Vec<_>>().concat().into_bytes()
    }

    /// What may make a reader of whole drawings fail is gone; what cuts metal is not.
    #[test]
    fn only_what_cuts_is_kept() {
        let mut groups = vec![
            (0, "SECTION"),
            (2, "HEADER"),
            (9, "$TDCREATE"),
            (40, "1e300"),
            (9, "$INSUNITS"),
            (70, "4"),
            (0, "ENDSEC"),
            (0, "SECTION"),
            (2, "OBJECTS"),
            (0, "DICTIONARY"),
            (0, "ENDSEC"),
            (0, "SECTION"),
            (2, "ENTITIES"),
            (0, "LINE"),
            (8, "CAM_PROFILE"),
            (1001, "APP"),
            (1002, "{"),
            (102, "{ACAD_XDICTIONARY"),
            (10, "nan"),
            (102, "}"),
        ];
        groups.extend([(0, " line"), (999, "a remark"), (10, "1.5"), (0, "ENDSEC"), (0, "EOF")]);
        let left = kept(&text(&groups)).expect("groups");
        let expected = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nCAM_PROFILE\n\
                        0\nLINE\n10\n1.5\n0\nENDSEC\n0\nEOF\n";
        assert_eq!(String::from_utf8(left).expect("text"), expected);
    }

    #[test]
    fn a_number_beyond_every_drawing_is_told() {
        for value in ["nan", "inf", "-1e300"] {
            let bytes = text(&[(0, "SECTION"), (2, "ENTITIES"), (0, "LINE"), (10, value), (0, "ENDSEC"), (0, "EOF")]);
            assert_eq!(kept(&bytes), Err(ReadError::NotFinite), "{value}");
        }
        assert!(matches!(kept(b"x\ny\n"), Err(ReadError::NotDxf(_))));
        assert_eq!(kept(&text(&[(0, "SECTION")])), Err(ReadError::CutShort));
    }

    /// Where readers would differ on what is cut, nothing is read.
    #[test]
    fn what_readers_take_differently_is_refused() {
        let file = |groups: &[(i32, &str)]| {
            let head = [(0, "SECTION"), (2, "ENTITIES"), (0, "LINE")];
            text(&[&head, groups, &[(0, "ENDSEC"), (0, "EOF")]].concat())
        };
        assert!(kept(&file(&[(102, "{A"), (10, "1"), (102, "}")])).is_ok());
        for groups in [
            &[(102, "{A"), (10, "1")][..],
            &[(102, "{A"), (102, "{B")],
            &[(102, "}")],
            &[(102, " {A"), (102, "}")],
            &[(999, "a\r0\rLINE")],
        ] {
            assert!(matches!(kept(&file(groups)), Err(ReadError::NotDxf(_))), "{groups:?}");
        }
        // Only an embedded object hides what follows.
        let left = String::from_utf8(kept(&file(&[(101, "x"), (10, "1")])).expect("groups")).expect("text");
        assert!(left.contains("10\n1\n"), "{left}");
    }

    /// A binary file is the same groups, its numbers to the last bit.
    #[test]
    fn a_binary_file_is_kept_as_its_text() {
        let number = 0.1 + 0.2;
        for wide in [true, false] {
            let mut bytes = BINARY.to_vec();
            let mut add = |code: u8, value: &[u8]| {
                bytes.push(code);
                if wide {
                    bytes.push(0);
                }
                bytes.extend_from_slice(value);
            };
            add(0, b"SECTION\0");
            add(2, b"ENTITIES\0");
            add(0, b"LINE\0");
            add(70, &[5, 0]);
            add(90, &[7, 0, 0, 0]);
            add(10, &f64::to_le_bytes(number));
            add(0, b"ENDSEC\0");
            add(0, b"EOF\0");
            let left = String::from_utf8(kept(&bytes).expect("groups")).expect("text");
            let expected =
                format!("0\nSECTION\n2\nENTITIES\n0\nLINE\n70\n5\n90\n7\n10\n{number:?}\n0\nENDSEC\n0\nEOF\n");
            assert_eq!(left, expected, "{wide}");
        }
    }
}

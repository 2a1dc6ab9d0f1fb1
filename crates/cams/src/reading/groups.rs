//! The group codes of a DXF file, text or binary: what can be cut is kept, before it is interpreted.
//!
//! Kept are the unit in the header, the table of layers, and of blocks and entities the codes that are used here, without
//! extended data and application groups. What is left out cannot cut metal, but could make a reader of whole drawings
//! fail: invalid dates, groups nested without end. What is kept is counted, so that a file cannot fill the memory.

use super::limits::{LONGEST_VALUE, MOST_GROUPS};
use super::shown::shown;
use super::{cut_short, not_dxf, not_finite, too_much};
use camgen_kernel::refusal::Refusal;

/// First words of a binary file, with the bytes between them and the first group.
const BINARY: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";
/// The byte order mark that some editors put before a text.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
/// Largest number an entity may have, larger than in any drawing: products of several of them are still finite.
const LARGEST: f64 = 1e15;

/// Group codes that are used here.
pub(super) const TYPE: i32 = 0;
const SECTION_NAME: i32 = 2;
const EMBEDDED_OBJECT: i32 = 101;
const APPLICATION_GROUP: i32 = 102;
const COMMENT: i32 = 999;
const EXTENDED_DATA: i32 = 1000;

/// A value: as text in a text file, typed in a binary one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum GroupValue<'a> {
    Text(&'a [u8]),
    Real(f64),
    Whole(i64),
}

impl<'a> GroupValue<'a> {
    /// As text, without blanks around it; empty for a number.
    pub(super) fn text(self) -> &'a [u8] {
        self.as_it_stands().trim_ascii()
    }

    fn as_it_stands(self) -> &'a [u8] {
        match self {
            GroupValue::Text(text) => text,
            _ => b"",
        }
    }

    /// As a number that a drawing can hold.
    pub(super) fn real(self) -> Result<f64, Refusal> {
        let number = match self {
            GroupValue::Real(number) => number,
            #[expect(clippy::cast_precision_loss, reason = "compared with the largest number below")]
            GroupValue::Whole(number) => number as f64,
            GroupValue::Text(text) => {
                let text = std::str::from_utf8(text.trim_ascii()).ok();
                text.and_then(|text| text.parse().ok()).ok_or_else(|| not_a_number(self))?
            }
        };
        // A comparison with NaN is false.
        if number.abs() <= LARGEST { Ok(number) } else { Err(not_finite()) }
    }

    /// As a whole number.
    pub(super) fn whole(self) -> Result<i64, Refusal> {
        let number = self.real()?;
        #[expect(clippy::cast_possible_truncation, reason = "it is whole and not beyond the largest number")]
        if number.fract() == 0.0 { Ok(number as i64) } else { Err(not_a_number(self)) }
    }
}

fn not_a_number(value: GroupValue<'_>) -> Refusal {
    not_dxf(format_args!("`{}` is not a number, and a number is needed there", shown(value.text())))
}

/// A code with its value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DxfGroup<'a> {
    pub(super) code: i32,
    pub(super) value: GroupValue<'a>,
}

/// A section of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum DxfSection {
    Header,
    Tables,
    Blocks,
    Entities,
}

impl DxfSection {
    fn named(name: &[u8]) -> Option<Self> {
        match name {
            b"HEADER" => Some(Self::Header),
            b"TABLES" => Some(Self::Tables),
            b"BLOCKS" => Some(Self::Blocks),
            b"ENTITIES" => Some(Self::Entities),
            _ => None,
        }
    }

    /// Whether it contains anything that may be cut.
    fn cuts(self) -> bool {
        matches!(self, Self::Blocks | Self::Entities)
    }

    /// Whether a code is used in it.
    fn needs(self, code: i32) -> bool {
        match self {
            Self::Header => matches!(code, TYPE | 9 | 70),
            Self::Tables => matches!(code, TYPE | 2 | 62 | 70),
            // Kind and name, layer, points, numbers, angles, visibility and paper space, flags and counts, class, extrusion.
            Self::Blocks | Self::Entities => {
                matches!(code, TYPE | 2 | 8 | 10..=13 | 20..=23 | 30..=33 | 38..=45 | 50 | 51 | 60 | 67 | 70 | 71 | 90)
                    || matches!(code, 100 | 210 | 220 | 230)
            }
        }
    }
}

/// What is kept of a file: for each of its sections that are used, the groups between its name and its end.
#[derive(Debug, Default)]
pub(super) struct DxfSections<'a> {
    pub(super) sections: Vec<(DxfSection, Vec<DxfGroup<'a>>)>,
    /// Sections and groups.
    count: usize,
}

impl<'a> DxfSections<'a> {
    fn count(&mut self) -> Result<(), Refusal> {
        self.count += 1;
        if self.count > MOST_GROUPS { Err(too_much("values", MOST_GROUPS)) } else { Ok(()) }
    }

    fn open(&mut self, section: DxfSection) -> Result<(), Refusal> {
        self.count()?;
        self.sections.push((section, Vec::new()));
        Ok(())
    }

    fn add(&mut self, group: DxfGroup<'a>) -> Result<(), Refusal> {
        self.count()?;
        if group.value.as_it_stands().len() > LONGEST_VALUE {
            return Err(not_dxf(format_args!(
                "a value of group {} has more than {LONGEST_VALUE} characters",
                group.code
            )));
        }
        if let Some((_, groups)) = self.sections.last_mut() {
            groups.push(group);
        }
        Ok(())
    }
}

/// What is kept of a DXF file.
///
/// # Errors
/// [`Refusal`] where the file does not consist of groups.
pub(super) fn kept(bytes: &[u8]) -> Result<DxfSections<'_>, Refusal> {
    if let Some(rest) = bytes.strip_prefix(BINARY) {
        return kept_of(BinaryGroups { rest, wide: rest.starts_with(&[0, 0]) });
    }
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    // A file of the old Macintosh ends its lines with carriage returns alone.
    let end = if bytes.contains(&b'\n') { b'\n' } else { b'\r' };
    let returns = end == b'\n' && bytes.contains(&b'\r');
    kept_of(TextGroups { lines: bytes.split(move |byte| *byte == end), line: 0, returns })
}

fn kept_of<'a>(groups: impl Iterator<Item = Result<DxfGroup<'a>, Refusal>>) -> Result<DxfSections<'a>, Refusal> {
    let (mut kept, mut entity) = (DxfSections::default(), OpenGroups::default());
    // `SECTION` was read, but not yet its name.
    let mut unnamed = false;
    let mut within = None;
    for group in groups {
        let DxfGroup { code, value } = group?;
        match (code, value.text()) {
            (TYPE, b"EOF") => return entity.keeps(TYPE, b"EOF").map(|_| kept),
            (TYPE, b"SECTION") => {
                entity.keeps(TYPE, b"SECTION")?;
                (unnamed, within) = (true, None);
            }
            (SECTION_NAME, name) if unnamed => {
                (unnamed, within) = (false, DxfSection::named(name));
                if let Some(section) = within {
                    kept.open(section)?;
                }
            }
            (TYPE, b"ENDSEC") => {
                entity.keeps(TYPE, b"ENDSEC")?;
                within = None;
            }
            _ => {
                let Some(section) = within else { continue };
                // What is open is tracked whether the code is used or not.
                let cuts = !section.cuts() || entity.keeps(code, value.as_it_stands())?;
                if cuts && section.needs(code) {
                    kept.add(DxfGroup { code, value })?;
                }
            }
        }
    }
    Err(cut_short())
}

/// What is open in an entity.
#[derive(Default)]
struct OpenGroups {
    /// An application group.
    group: bool,
    /// An object embedded in the entity, up to the next entity.
    embedded: bool,
}

impl OpenGroups {
    /// Whether the next entity, or the beginning or end of an application group, may occur here.
    fn may_follow(&self, code: i32, value: &[u8]) -> bool {
        match (code, value) {
            (APPLICATION_GROUP, b"}") => self.group,
            (APPLICATION_GROUP, _) => !self.group && value.starts_with(b"{"),
            _ => !self.group,
        }
    }

    fn keeps(&mut self, code: i32, value: &[u8]) -> Result<bool, Refusal> {
        match code {
            // Readers differ about what an unclosed group belongs to.
            TYPE | APPLICATION_GROUP if !self.may_follow(code, value) => {
                return Err(not_dxf(
                    "an application group (code 102) is not closed, or is closed without having been opened",
                ));
            }
            TYPE => self.embedded = false,
            EMBEDDED_OBJECT => self.embedded |= value.trim_ascii() == b"Embedded Object",
            APPLICATION_GROUP => {
                self.group = !self.group;
                return Ok(false);
            }
            _ => {}
        }
        // Codes below zero belong to programs: comments, as 999.
        Ok(!self.group && !self.embedded && code != COMMENT && (0..EXTENDED_DATA).contains(&code))
    }
}

/// Type of a value in a binary file; the reference of DXF, "Group Code Value Types".
#[derive(Clone, Copy)]
enum ValueKind {
    /// Text that ends with 0.
    Text,
    /// Whole number of this many bytes.
    Whole(usize),
    /// A bool: one byte, two in files before R13.
    Truth,
    /// Eight bytes.
    Real,
    /// A length in one byte, then as many bytes.
    Chunk,
}

fn kind(code: i32) -> Option<ValueKind> {
    Some(match code {
        0..=9 | 100..=105 | 300..=309 | 320..=369 | 390..=399 | 410..=419 | 430..=439 | 470..=481 | 999..=1003 => {
            ValueKind::Text
        }
        1005..=1009 => ValueKind::Text,
        10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => ValueKind::Real,
        60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => ValueKind::Whole(2),
        90..=99 | 420..=429 | 440..=459 | 1071 => ValueKind::Whole(4),
        160..=169 => ValueKind::Whole(8),
        290..=299 => ValueKind::Truth,
        310..=319 | 1004 => ValueKind::Chunk,
        _ => return None,
    })
}

/// The groups of a text file, two lines each.
struct TextGroups<L> {
    lines: L,
    line: usize,
    /// Whether a line may contain a carriage return.
    returns: bool,
}

/// A group code as a line of text: nearly always digits alone, which are parsed directly.
fn code_of(line: &[u8]) -> Option<i32> {
    let digits = line.trim_ascii();
    if matches!(digits.len(), 1..=4) && digits.iter().all(u8::is_ascii_digit) {
        return Some(digits.iter().fold(0, |code, digit| 10 * code + i32::from(digit - b'0')));
    }
    std::str::from_utf8(line).ok()?.trim().parse().ok()
}

impl<'a, L: Iterator<Item = &'a [u8]>> Iterator for TextGroups<L> {
    type Item = Result<DxfGroup<'a>, Refusal>;

    fn next(&mut self) -> Option<Self::Item> {
        let code = self.lines.next()?;
        let value = self.lines.next()?;
        self.line += 2;
        let value = value.strip_suffix(b"\r").unwrap_or(value);
        if self.returns && value.contains(&b'\r') {
            // Some readers take it for the end of a line.
            return Some(Err(not_dxf(format_args!("line {} contains a carriage return before its end", self.line))));
        }
        Some(match code_of(code) {
            Some(code) => Ok(DxfGroup { code, value: GroupValue::Text(value) }),
            None => Err(not_dxf(format_args!("line {} is not a group code", self.line - 1))),
        })
    }
}

/// The groups of a binary file.
struct BinaryGroups<'a> {
    rest: &'a [u8],
    /// Codes have two bytes, from R13 on; before that one byte, or two after 255.
    wide: bool,
}

impl<'a> BinaryGroups<'a> {
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

    fn value(&mut self, kind: ValueKind) -> Option<GroupValue<'a>> {
        Some(match kind {
            ValueKind::Text => {
                let end = self.rest.iter().position(|byte| *byte == 0)?;
                let text = self.take(end)?;
                self.byte()?;
                GroupValue::Text(text)
            }
            ValueKind::Whole(2) => GroupValue::Whole(i16::from_le_bytes(self.take(2)?.try_into().ok()?).into()),
            ValueKind::Whole(4) => GroupValue::Whole(i32::from_le_bytes(self.take(4)?.try_into().ok()?).into()),
            ValueKind::Whole(_) => GroupValue::Whole(i64::from_le_bytes(self.take(8)?.try_into().ok()?)),
            ValueKind::Truth if self.wide => GroupValue::Whole(self.byte()?.into()),
            ValueKind::Truth => GroupValue::Whole(i16::from_le_bytes(self.take(2)?.try_into().ok()?).into()),
            ValueKind::Real => GroupValue::Real(f64::from_le_bytes(self.take(8)?.try_into().ok()?)),
            ValueKind::Chunk => {
                // A preview or data of another program.
                let length = self.byte()?.into();
                GroupValue::Text(self.take(length)?)
            }
        })
    }
}

impl<'a> Iterator for BinaryGroups<'a> {
    type Item = Result<DxfGroup<'a>, Refusal>;

    fn next(&mut self) -> Option<Self::Item> {
        let code = self.code()?;
        let Some(kind) = kind(code) else {
            return Some(Err(not_dxf(format_args!("{code} is not a group code"))));
        };
        Some(Ok(DxfGroup { code, value: self.value(kind)? }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(groups: &[(i32, &str)]) -> Vec<u8> {
        groups.iter().map(|(code, value)| format!("{code:3}\r\n{value}\r\n")).collect::<Vec<_>>().concat().into_bytes()
    }

    /// Everything that may make a reader of whole drawings fail is removed; what cuts metal is kept.
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
        let bytes = text(&groups);
        let left = kept(&bytes).expect("groups");
        let kinds: Vec<DxfSection> = left.sections.iter().map(|(section, _)| *section).collect();
        assert_eq!(kinds, [DxfSection::Header, DxfSection::Entities]);
        let entities: Vec<(i32, &[u8])> =
            left.sections[1].1.iter().map(|group| (group.code, group.value.text())).collect();
        let expected: [(i32, &[u8]); 4] = [(0, b"LINE"), (8, b"CAM_PROFILE"), (0, b"line"), (10, b"1.5")];
        assert_eq!(entities, expected);
    }

    #[test]
    fn a_code_is_a_whole_number_however_it_is_written() {
        let codes: [(&str, Option<i32>); 9] = [
            ("  0", Some(0)),
            ("10\r", Some(10)),
            ("\t1071 ", Some(1071)),
            ("0070", Some(70)),
            ("+8", Some(8)),
            ("-5", Some(-5)),
            ("\u{a0}000070", Some(70)),
            ("1 0", None),
            ("", None),
        ];
        for (line, code) in codes {
            assert_eq!(code_of(line.as_bytes()), code, "{line:?}");
        }
    }

    fn is_not_dxf<T>(read: Result<T, Refusal>) -> bool {
        read.is_err_and(|error| error.what.starts_with("not a DXF file: "))
    }

    #[test]
    fn a_number_too_large_for_a_drawing_is_refused() {
        for value in ["nan", "inf", "-1e300"] {
            assert_eq!(GroupValue::Text(value.as_bytes()).real(), Err(not_finite()), "{value}");
        }
        assert_eq!(GroupValue::Real(f64::NAN).real(), Err(not_finite()));
        assert!(is_not_dxf(GroupValue::Text(b"1,5").real()));
        assert!(is_not_dxf(GroupValue::Text(b"1.5").whole()));
        assert_eq!(GroupValue::Text(b"  -7 ").whole(), Ok(-7));
        assert!(is_not_dxf(kept(b"x\ny\n")));
        assert_eq!(kept(&text(&[(0, "SECTION")])).err(), Some(cut_short()));
    }

    /// Line ends of the old Macintosh, a byte order mark, other programs' comments, and whatever follows the end.
    #[test]
    fn harmless_dress_is_taken_off() {
        let groups = [(0, "SECTION"), (2, "ENTITIES"), (-666, "x"), (0, "LINE"), (999, "x"), (0, "ENDSEC"), (0, "EOF")];
        let plain = text(&groups);
        let returns: Vec<u8> = plain.iter().copied().filter(|byte| *byte != b'\n').collect();
        let marked = [BYTE_ORDER_MARK, &plain].concat();
        for bytes in [plain.clone(), returns, marked, [&plain[..], b"\x1a"].concat(), [&plain[..], b"\0\0bye"].concat()]
        {
            let left = kept(&bytes).expect("groups");
            assert_eq!(left.sections.len(), 1);
            assert_eq!(left.sections[0].1.len(), 1, "the line alone");
        }
    }

    /// Where readers would differ about what is cut, nothing is read.
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
            assert!(is_not_dxf(kept(&file(groups))), "{groups:?}");
        }
        // Only an embedded object hides what follows.
        let bytes = file(&[(101, "x"), (10, "1")]);
        let left = kept(&bytes).expect("groups");
        assert!(left.sections[0].1.iter().any(|group| group.code == 10), "{left:?}");
    }

    /// A binary file has the same groups, its numbers exact to the last bit.
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
            let left = kept(&bytes).expect("groups");
            let values: Vec<GroupValue<'_>> = left.sections[0].1.iter().map(|group| group.value).collect();
            assert_eq!(
                values,
                [GroupValue::Text(b"LINE"), GroupValue::Whole(5), GroupValue::Whole(7), GroupValue::Real(number)],
                "{wide}"
            );
        }
    }
}

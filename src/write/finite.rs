//! The last look at files before they are written: no number of theirs is NaN or infinite.

use super::files::{FilesError, Output};

/// The texts of what is no number, and of what is infinite.
const NONE: [&str; 7] = ["NaN", "nan", "NAN", "inf", "Inf", "infinity", "Infinity"];
/// Ends of the names of files that are numbers and few words. A page has programs, JSON has `null`; in a table a straight place has a radius
/// of `inf`, and what must be there is looked at when it is made.
const LOOKED_AT: [&str; 4] = [".dxf", ".svg", ".step", ".toml"];

/// Looks at all files; `words` are those of the user, which may hold such texts.
///
/// # Errors
/// [`FilesError::NotFinite`] for the first one found.
pub(super) fn all(outputs: &[Output], words: &[&str]) -> Result<(), FilesError> {
    let own = |text: &&str| !words.iter().any(|word| word.contains(text));
    let texts: Vec<&str> = NONE.into_iter().filter(own).collect();
    for output in outputs.iter().filter(|output| LOOKED_AT.iter().any(|end| output.name.ends_with(end))) {
        if let Some(at) = first(&output.bytes, &texts) {
            let line = output.bytes.get(..at).unwrap_or_default().split(|byte| *byte == b'\n').count();
            return Err(FilesError::NotFinite { name: output.name.clone(), line });
        }
    }
    Ok(())
}

/// Bytes looked at together: most blocks have nothing like the beginning of such a text.
const BLOCK: usize = 256;

/// 0 where letters are the first and the third of one of the texts, in capitals or not. Whole blocks of it take no branches.
fn off(first: u8, third: u8) -> u8 {
    let (first, third) = (first | 0x20, third | 0x20);
    let nan = (first ^ b'n') | (third ^ b'n');
    let inf = (first ^ b'i') | (third ^ b'f');
    nan.min(inf)
}

/// Where the first of the texts stands as a word of its own.
fn first(bytes: &[u8], texts: &[&str]) -> Option<usize> {
    let blocks = bytes.chunks(BLOCK).zip(bytes.get(2..)?.chunks(BLOCK)).enumerate();
    blocks.into_iter().find_map(|(index, (first, third))| {
        let places = || first.iter().zip(third).map(|(first, third)| off(*first, *third));
        if places().fold(u8::MAX, u8::min) > 0 {
            return None;
        }
        let found = places().enumerate().filter(|(_, off)| *off == 0).map(|(place, _)| BLOCK * index + place);
        found.into_iter().find(|place| texts.iter().any(|text| word(bytes, *place) == text.as_bytes()))
    })
}

/// The word of letters and digits around a place.
fn word(bytes: &[u8], place: usize) -> &[u8] {
    let (before, after) = bytes.split_at_checked(place).unwrap_or_default();
    let start = before.iter().rposition(|byte| !byte.is_ascii_alphanumeric()).map_or(0, |end| end + 1);
    let length = after.iter().position(|byte| !byte.is_ascii_alphanumeric()).unwrap_or(after.len());
    bytes.get(start..place + length).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(name: &str, text: &str, words: &[&str]) -> Option<usize> {
        match all(&[Output { name: name.into(), bytes: text.into() }], words) {
            Err(FilesError::NotFinite { line, .. }) => Some(line),
            _ => None,
        }
    }

    #[test]
    fn a_number_that_is_none_is_found() {
        let none = [("a,b\n1,NaN\n", Some(2)), ("1\n\n-nan", Some(3)), ("information, Nancy, cinf_1", None)];
        for (text, line) in none {
            assert_eq!((of("x.step", text, &[]), of("x.svg", text, &[])), (line, line), "{text}");
        }
        assert_eq!((of("x.csv", "1,inf", &[]), of("x.svg", "M0,-inf L1", &[])), (None, Some(1)));
        assert_eq!(of("x.html", "NaN", &[]), None);
        assert_eq!(of("x.dxf", "NaN", &["cam of NaN Ltd"]), None);
        assert_eq!(of("x.dxf", "inf", &["cam of NaN Ltd"]), Some(1));
    }
}

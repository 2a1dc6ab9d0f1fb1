//! The last look at files before they are written: no number of theirs is NaN or infinite.

use super::files::{FilesError, Output};

/// The texts of what is no number, and of what is infinite.
const NONE: [&str; 3] = ["NaN", "nan", "NAN"];
const INFINITE: [&str; 4] = ["inf", "Inf", "infinity", "Infinity"];
/// In a table a straight place has a radius of curvature of `inf`, and a law that jumps a jerk.
const TABLE: &str = ".csv";
/// Ends of the names of files that are numbers and few words. A page has programs, JSON has `null`, the others are not text.
const LOOKED_AT: [&str; 5] = [".csv", ".dxf", ".svg", ".step", ".toml"];

/// Looks at all files; `words` are those of the user, which may hold such texts.
///
/// # Errors
/// [`FilesError::NotFinite`] for the first one found.
pub(super) fn all(outputs: &[Output], words: &[&str]) -> Result<(), FilesError> {
    let own = |text: &&str| !words.iter().any(|word| word.contains(text));
    let none: Vec<&str> = NONE.into_iter().filter(own).collect();
    let all: Vec<&str> = NONE.into_iter().chain(INFINITE).filter(own).collect();
    for output in outputs.iter().filter(|output| LOOKED_AT.iter().any(|end| output.name.ends_with(end))) {
        let texts = if output.name.ends_with(TABLE) { &none } else { &all };
        let found = output.bytes.split(|byte| *byte == b'\n').position(|line| is_in(line, texts));
        if let Some(before) = found {
            return Err(FilesError::NotFinite { name: output.name.clone(), line: before + 1 });
        }
    }
    Ok(())
}

/// Whether one of the texts stands in a line as a word of its own.
fn is_in(line: &[u8], texts: &[&str]) -> bool {
    // Every one of them has this letter, and most lines have it not.
    if !line.iter().any(|byte| matches!(byte, b'n' | b'N')) {
        return false;
    }
    let mut words = line.split(|byte| !byte.is_ascii_alphanumeric());
    words.any(|word| texts.iter().any(|text| text.as_bytes() == word))
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
            assert_eq!((of("x.csv", text, &[]), of("x.svg", text, &[])), (line, line), "{text}");
        }
        assert_eq!((of("x.csv", "1,-inf", &[]), of("x.svg", "M0,-inf L1", &[])), (None, Some(1)));
        assert_eq!(of("x.html", "NaN", &[]), None);
        assert_eq!(of("x.dxf", "NaN", &["cam of NaN Ltd"]), None);
        assert_eq!(of("x.dxf", "inf", &["cam of NaN Ltd"]), Some(1));
    }
}

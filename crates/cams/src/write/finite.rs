//! The last look at files before they are written: none of their numbers is NaN or infinite.

use super::error::{FilesError, Output};

/// The texts of NaN and of infinity.
const NONE: [&str; 7] = ["NaN", "nan", "NAN", "inf", "Inf", "infinity", "Infinity"];
/// Endings of files that hold numbers and few words. A page has programs, JSON has `null`; in a table a straight place has a radius
/// of `inf`, and required values are checked when the table is made.
const LOOKED_AT: [&str; 4] = [".dxf", ".svg", ".step", ".toml"];

/// Looks at all files; `words` are texts of the user, which may contain such words.
///
/// # Errors
/// [`FilesError::NotFinite`] for the first one found.
pub(super) fn all(outputs: &[Output], words: &[&str]) -> Result<(), FilesError> {
    let own = |text: &&str| !words.iter().any(|word| word.contains(text));
    let texts: Vec<&[u8]> = NONE.into_iter().filter(own).map(str::as_bytes).collect();
    let faulty = |line: &[u8]| line.split(|byte| !byte.is_ascii_alphanumeric()).any(|word| texts.contains(&word));
    for output in outputs.iter().filter(|output| LOOKED_AT.iter().any(|end| output.name.ends_with(end))) {
        if let Some(index) = output.bytes.split(|byte| *byte == b'\n').position(faulty) {
            return Err(FilesError::NotFinite { name: output.name.clone(), line: index + 1 });
        }
    }
    Ok(())
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
    fn a_text_that_is_not_a_number_is_found() {
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

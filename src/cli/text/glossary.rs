//! Terms of a report that are not in every textbook on cams, each in a line, from the project's glossary.

const WORDS: &str = include_str!("../../../docs/words.md");
/// The heading of the part of the glossary that reports show.
const EXPLAINED: &str = "## Words that a report explains";

/// The terms that reports explain, each with its meaning.
fn terms() -> impl Iterator<Item = (&'static str, &'static str)> {
    let (_, behind) = WORDS.split_once(EXPLAINED).unwrap_or_default();
    let (part, _) = behind.split_once("\n## ").unwrap_or((behind, ""));
    let rows = part.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |")?.split_once(" | "));
    // After the row of headings.
    rows.skip(1)
}

/// The terms that occur in a text.
pub(super) fn terms_in(text: &str) -> Vec<String> {
    let widest = terms().map(|(term, _)| term.chars().count()).max().unwrap_or(0);
    let occurring = terms().filter(|(term, _)| occurs(text, term));
    occurring.map(|(term, meaning)| format!("{term:<widest$}  {meaning}")).collect()
}

/// Whether a term occurs in a text as whole words.
fn occurs(text: &str, term: &str) -> bool {
    text.match_indices(term).any(|(at, _)| {
        let before = text.get(..at).and_then(|before| before.chars().next_back());
        let behind = text.get(at + term.len()..).and_then(|behind| behind.chars().next());
        ![before, behind].into_iter().flatten().any(|c| c.is_alphanumeric() || c == '_')
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_whole_terms_are_explained() {
        assert!(terms_in("the bottomless pit, an undercutting").is_empty());
        let explained = terms_in("air column 243 mm, bottom");
        assert_eq!(explained.len(), 2);
        assert!(explained[0].starts_with("air column") && explained[1].starts_with("bottom  "), "{explained:?}");
        assert_eq!(terms().count(), 8);
    }
}

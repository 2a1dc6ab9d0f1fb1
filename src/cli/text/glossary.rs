//! Terms of a report that are not in every textbook on cams, each in a line.

/// A term, as reports write it, and what it means.
const TERMS: &[(&str, &str)] = &[
    ("air column", "length of the air between piston and bottom where the reversal begins"),
    ("bottom", "movable end of an air buffer, which the cam moves"),
    ("Δx", "way of the bottom by its law; negative away from the piston"),
    ("fixed bottom", "the same buffer without a cam"),
    ("inertia less air", "residual force: what the air does not balance of the bed's inertia"),
    ("best possible", "number of arcs below which no tangent arcs keep the tolerance, and the ratio to it"),
    ("kinks", "angles between neighbouring segments"),
    ("run_up", "ramp that brings the bottom to the slope of its law before the reversal"),
    ("sections", "plane cuts of a three-dimensional cam, one for each speed"),
];

/// The terms that occur in a text.
pub(super) fn of(text: &str) -> Vec<String> {
    let widest = TERMS.iter().map(|(term, _)| term.chars().count()).max().unwrap_or(0);
    let occurring = TERMS.iter().filter(|(term, _)| occurs(text, term));
    occurring.map(|(term, meaning)| format!("{term:<widest$}  {meaning}")).collect()
}

/// Whether a term stands in a text as whole words.
fn occurs(text: &str, term: &str) -> bool {
    let of_word = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(term).any(|(at, _)| {
        let before = text.get(..at).and_then(|before| before.chars().next_back());
        let behind = text.get(at + term.len()..).and_then(|behind| behind.chars().next());
        !before.is_some_and(of_word) && !behind.is_some_and(of_word)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_whole_terms_are_explained() {
        assert!(of("the bottomless pit, an undercutting").is_empty());
        let told = of("air column 243 mm, bottom");
        assert_eq!(told.len(), 2);
        assert!(told[0].starts_with("air column") && told[1].starts_with("bottom  "), "{told:?}");
    }
}

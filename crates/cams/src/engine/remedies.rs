//! What a text says would pass, as changes that a page can make at a click.

use super::TextChange;

/// The keys with their values in a text: `key = "value"`.
fn equations(text: &str) -> Vec<TextChange> {
    let parts: Vec<&str> = text.split(" = \"").collect();
    let pairs = parts.iter().zip(parts.iter().skip(1));
    let change = |(before, after): (&&str, &&str)| {
        let key = before.rsplit([' ', '(', '`']).next().unwrap_or_default().to_owned();
        TextChange::Set { key, to: after.split('"').next().unwrap_or_default().to_owned() }
    };
    pairs.map(change).collect()
}

/// The changes that a note of a check promises to pass with, each list by itself.
pub(super) fn of(note: &str) -> Vec<Vec<TextChange>> {
    let base = note.split("a base radius of ").nth(1).and_then(|rest| rest.split(" mm would pass").next());
    let base = base.filter(|base| base.parse::<f64>().is_ok());
    let promises = note.split("; ").filter(|clause| clause.contains(" would ") && !clause.contains("no base radius"));
    let changes = promises.flat_map(|clause| clause.split(" or ")).map(equations).filter(|keys| !keys.is_empty());
    let base = base.map(|base| vec![TextChange::Set { key: "cam.base_radius".to_owned(), to: format!("{base} mm") }]);
    base.into_iter().chain(changes).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_would_pass_becomes_a_change() {
        let set = |key: &str, to: &str| TextChange::Set { key: key.to_owned(), to: to.to_owned() };
        assert_eq!(of("a base radius of 41 mm would pass"), [vec![set("cam.base_radius", "41 mm")]]);
        let note = "no base radius would pass; cam.x = \"3 mm\" or limits.y = \"2 N\" would pass";
        assert_eq!(of(note), [vec![set("cam.x", "3 mm")], vec![set("limits.y", "2 N")]]);
        assert!(of("the customary limit").is_empty());
    }
}

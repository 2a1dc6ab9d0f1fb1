//! Figures of a JSON report by their paths, and what of a cam they need.

use crate::check::CheckScope;
use crate::report::{Finding, Section};
use serde_json::{Map, Value};

/// The list of findings in a report; its figures are named by the check, `checks.pressure_angle.value`.
const CHECKS: &str = "checks";
/// Whether every check passed, in the place of a section.
pub(super) const PASSED: &str = "passed";

/// The sections and checks that columns need, and whether the cam is drawn and proved for them.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Plan {
    pub(super) proves: bool,
    /// The columns; empty for everything.
    paths: Vec<String>,
    sections: Vec<String>,
    checks: Vec<String>,
}

/// The first part of a path, and the second.
fn head(path: &str) -> (&str, &str) {
    let (first, rest) = path.split_once('.').unwrap_or((path, ""));
    (first.split('[').next().unwrap_or_default(), rest.split(['.', '[']).next().unwrap_or_default())
}

impl Plan {
    /// Of columns, where a solved cam and the proved one gave these figures: what is the same before anything is drawn does not need a drawing.
    pub(super) fn new(columns: &[String], solved: &Value, proven: &Value) -> Self {
        let known = |path: &String| {
            figure_at(solved, path).is_some_and(|value| !value.is_null() && Some(value) == figure_at(proven, path))
        };
        Self { proves: !columns.iter().all(known), ..Self::proving(columns) }
    }

    /// Of columns for which nothing is known of the cam.
    pub(super) fn proving(columns: &[String]) -> Self {
        let (mut sections, mut checks) = (Vec::new(), Vec::new());
        for path in columns {
            match head(path) {
                (CHECKS, check) => checks.push(check.to_owned()),
                (section, _) => sections.push(section.to_owned()),
            }
        }
        Self { proves: true, paths: columns.to_vec(), sections, checks }
    }

    /// Everything.
    pub(super) fn whole() -> Self {
        Self { proves: true, ..Self::default() }
    }

    /// The figures that are needed; `None` for all.
    pub(super) fn paths(&self) -> Option<&[String]> {
        (!self.paths.is_empty()).then_some(self.paths.as_slice())
    }

    fn is_whole(&self) -> bool {
        self.paths.is_empty()
    }

    /// Whether a section is needed.
    pub(super) fn wants_sections(&self) -> bool {
        self.is_whole() || !self.sections.is_empty()
    }

    /// Whether a check is needed of a cam that is not drawn.
    pub(super) fn wants_check(&self, name: &str, scope: CheckScope) -> bool {
        scope == CheckScope::Cam && (self.is_whole() || self.checks.iter().any(|check| check == name))
    }

    /// The figures as they are in the JSON report, of what is needed.
    pub(super) fn figures(&self, sections: Vec<Section>, findings: &[Finding], passed: Option<bool>) -> Value {
        let mut all = Map::new();
        for section in sections {
            if self.is_whole() || self.sections.iter().any(|key| *key == section.key) {
                all.insert(section.key.into_owned(), section.value);
            }
        }
        let mut checks = Map::new();
        for finding in findings {
            // The first of a name is the worst.
            let wanted = self.is_whole() || self.checks.iter().any(|check| *check == finding.check);
            if wanted && !checks.contains_key(&*finding.check) {
                checks.insert(finding.check.to_string(), serde_json::to_value(finding).unwrap_or(Value::Null));
            }
        }
        all.insert(CHECKS.to_owned(), Value::Object(checks));
        if let Some(passed) = passed {
            all.insert(PASSED.to_owned(), Value::Bool(passed));
        }
        Value::Object(all)
    }
}

/// The value at a path, `cam.roller_turns[0]`.
pub(super) fn figure_at<'v>(figures: &'v Value, path: &str) -> Option<&'v Value> {
    path.split('.').try_fold(figures, |value, part| {
        let (name, indices) = part.split_once('[').map_or((part, ""), |(name, rest)| (name, rest));
        let found = value.get(name)?;
        indices
            .split('[')
            .filter(|index| !index.is_empty())
            .try_fold(found, |value, index| value.get(index.strip_suffix(']')?.parse::<usize>().ok()?))
    })
}

/// The paths of all numbers, words and truths.
pub(super) fn paths_of(figures: &Value) -> Vec<String> {
    let mut all = Vec::new();
    walk(figures, String::new(), &mut all);
    all
}

fn walk(value: &Value, path: String, all: &mut Vec<String>) {
    match value {
        Value::Object(map) => {
            for (key, inner) in map {
                walk(inner, if path.is_empty() { key.clone() } else { format!("{path}.{key}") }, all);
            }
        }
        Value::Array(items) => {
            for (index, inner) in items.iter().enumerate() {
                walk(inner, format!("{path}[{index}]"), all);
            }
        }
        _ => all.push(path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn figures_are_found_by_their_paths() {
        let report = json!({"cam": {"turns": [1.0, 2.5]}, "checks": {"wall": {"value": 3.0}}, "passed": true});
        assert_eq!(figure_at(&report, "cam.turns[1]"), Some(&json!(2.5)));
        assert_eq!(figure_at(&report, "checks.wall.value"), Some(&json!(3.0)));
        assert_eq!((figure_at(&report, "cam.turns[2]"), figure_at(&report, "cam.none")), (None, None));
        let all = paths_of(&report);
        assert_eq!(all, ["cam.turns[0]", "cam.turns[1]", "checks.wall.value", "passed"]);
        assert!(all.iter().all(|path| figure_at(&report, path).is_some()));
    }

    #[test]
    fn what_is_known_before_it_is_drawn_is_not_drawn() {
        let (solved, proven) = (json!({"cam": {"a": 1.0, "b": null}}), json!({"cam": {"a": 1.0, "b": 2.0}}));
        let plan = |path: &str| Plan::new(&[path.to_owned()], &solved, &proven).proves;
        assert_eq!((plan("cam.a"), plan("cam.b"), plan("cam.c")), (false, true, true));
    }
}

//! All that files may contain, and the kinds of cam on which their keys have an effect.

use super::cams::CamKind;
use super::input::Input;
use super::key::{Key, KeySection, Occurrence, Presence, key_at};
use super::reader::pattern;
use std::collections::BTreeMap;

/// The tables of a kind of file.
#[derive(Debug)]
pub struct Tables {
    /// The tables, in the order of the template.
    pub sections: Vec<&'static KeySection>,
    /// The kinds of cam, and the analyses, that keys name.
    pub kinds: Vec<CamKind>,
}

impl Tables {
    /// Whether a file may contain a key, by its dotted path.
    #[must_use]
    pub fn has_key(&self, path: &str) -> bool {
        key_at(&self.sections, &pattern(path).0).is_some()
    }

    /// Of the keys given, those that have no effect on a kind of cam, in the order given.
    #[must_use]
    pub fn without_effect(&self, given: &[String], cam: &str) -> Vec<String> {
        given.iter().filter(|path| self.is_idle(path, cam)).cloned().collect()
    }

    /// Of the values of a file, those that have an effect on a kind of cam, in the order given.
    #[must_use]
    pub fn with_effect(&self, inputs: &[Input], cam: &str) -> Vec<Input> {
        inputs.iter().filter(|input| !self.is_idle(&input.key, cam)).cloned().collect()
    }

    /// The text of a file with these values as they were typed; those that are not of keys of a file, and those that a key has without
    /// being given, are left out.
    #[must_use]
    pub fn text_of(&self, inputs: &[Input]) -> String {
        // By table, in the order of the tables and of the elements of each.
        let mut tables: BTreeMap<(usize, Vec<usize>), (String, Vec<String>)> = BTreeMap::new();
        for input in inputs {
            let (pattern, indices) = pattern(&input.key);
            let Some((section, key)) = key_at(&self.sections, &pattern) else { continue };
            // Given, it may be refused beside other keys.
            if matches!(key.presence, Presence::Default(text) if text == input.typed) {
                continue;
            }
            // A radius may have been given by its diameter.
            let doubled = input
                .typed
                .strip_prefix('Ø')
                .and_then(|typed| Some((section.keys.iter().find(|other| other.halved == Some(key.name))?, typed)));
            let (key, typed) = doubled.unwrap_or((key, &input.typed));
            let place = self.sections.iter().position(|other| other.path == section.path).unwrap_or_default();
            let indices = indices.iter().filter_map(|index| index.parse().ok()).collect();
            let head = match (section.path, section.occurs) {
                ("", _) => String::new(),
                (path, Occurrence::Repeated) => format!("[[{path}]]\n"),
                (path, _) => format!("[{path}]\n"),
            };
            let (_, lines) = tables.entry((place, indices)).or_insert((head, Vec::new()));
            lines.push(format!("{} = {}\n", key.name, key.in_toml(typed)));
        }
        // The keys before the first table come first.
        let (root, rest): (Vec<_>, Vec<_>) = tables.into_values().partition(|(head, _)| head.is_empty());
        root.into_iter().chain(rest).map(|(head, lines)| head + &lines.concat()).collect()
    }

    /// Whether a path is that of a key that has no effect on a kind of cam.
    fn is_idle(&self, path: &str, cam: &str) -> bool {
        let (pattern, _) = pattern(path);
        key_at(&self.sections, &pattern).is_some_and(|(section, key)| !self.has_effect(section, key, cam))
    }

    /// Whether a key has an effect on a kind of cam.
    #[must_use]
    pub fn has_effect(&self, section: &KeySection, key: &Key, cam: &str) -> bool {
        let cams = section.cams_of(key);
        if cams.is_empty() { !self.is_analysis(cam) } else { self.names(cams, cam) }
    }

    /// Whether nothing is cut of a kind.
    #[must_use]
    pub fn is_analysis(&self, cam: &str) -> bool {
        self.kinds.iter().any(|kind| kind.name == cam && kind.analysis)
    }

    /// Whether a list of kinds and classes names a kind of cam.
    pub(super) fn names(&self, cams: &[&str], cam: &str) -> bool {
        self.listed(cams).contains(&cam)
    }

    /// The kinds that a list of kinds and classes names.
    #[must_use]
    pub fn listed<'c>(&self, cams: &[&'c str]) -> Vec<&'c str> {
        let listed = cams.iter().flat_map(|cam| -> Vec<&'c str> {
            let members = self.kinds.iter().filter(|kind| kind.classes.contains(cam));
            let members: Vec<&'c str> = members.map(|kind| kind.name).collect();
            if members.is_empty() { vec![*cam] } else { members }
        });
        listed.collect()
    }
}

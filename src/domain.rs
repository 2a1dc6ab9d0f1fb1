//! A domain: a kind of machine with its keys, its cams, its analyses and its checks.

use crate::body::Kind;
use crate::check::Check;
use crate::document::KeySection;
use crate::document::cams::CamKind;
use crate::machine::{Embedded, ReadParts};

/// A domain, as the catalogue sees it.
#[derive(Debug)]
pub struct Domain {
    /// Its tables of a machine file, each group after the table of a path. They add keys to a table that has their path already.
    pub sections: &'static [Added<&'static KeySection>],
    /// Reads its part of a machine.
    pub read: Option<ReadParts>,
    /// Its kinds of cam and analyses, as keys name them.
    pub cams: &'static [CamKind],
    /// The kinds of cams that it makes.
    pub kinds: &'static [&'static Kind],
    /// Its analyses.
    pub analyses: &'static [&'static Kind],
    /// Its checks, each group after a check, by its name in reports.
    pub checks: &'static [Added<&'static Check>],
    /// Its machine files in the binary.
    pub embedded: &'static [Embedded],
}

/// Entries of a list that a domain adds after an existing one.
#[derive(Debug)]
pub struct Added<T: 'static> {
    /// The entry before them; without such an entry they come last.
    pub after: &'static str,
    /// The entries, in their order.
    pub entries: &'static [T],
}

impl<T: Copy> Added<T> {
    /// Puts the entries into a list, after the last one of the name.
    pub(crate) fn put_into(&self, list: &mut Vec<T>, name: impl Fn(&T) -> &'static str) {
        let at = list.iter().rposition(|entry| name(entry) == self.after).map_or(list.len(), |before| before + 1);
        list.splice(at..at, self.entries.iter().copied());
    }
}

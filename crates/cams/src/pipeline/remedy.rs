//! One change of a machine file with which every check passes, from the remedies that the checks name one by one.

use super::{Proven, ProvenAssembly};
use crate::report::{Finding, Verdict};
use camgen_kernel::text::KeyChange;

/// Rounds in which the remedies of what still fails are added.
const ROUNDS: usize = 4;

/// Changes that were tried together, and the cams that they make.
#[derive(Debug, Clone)]
pub struct TriedChanges {
    /// The changes; all of them are needed.
    pub changes: Vec<KeyChange>,
    /// The cams, which pass every check.
    pub cams: ProvenAssembly,
}

impl ProvenAssembly {
    /// The fewest changes found with which the cams pass every check: a remedy of a check that fails by itself, else the remedies of
    /// all that fail, of two values for a key the larger one, and those of what fails then. `None` where no such changes were found.
    ///
    /// `remake` makes the cams of the machine file with changes, or none.
    #[must_use]
    pub fn remedy(&self, remake: &dyn Fn(&[KeyChange]) -> Option<ProvenAssembly>) -> Option<TriedChanges> {
        if self.passed() || self.no_outline().is_some() {
            return None;
        }
        let passing = |changes: Vec<KeyChange>| {
            let cams = remake(&changes)?;
            cams.passed().then_some(TriedChanges { changes, cams })
        };
        let of_failures = remedies_of(&self.failures());
        if let Some(found) = of_failures.iter().find_map(|changes| passing(changes.clone())) {
            return Some(found);
        }
        let mut all: Vec<KeyChange> = Vec::new();
        let mut failures = self.failures();
        for _ in 0..ROUNDS {
            let before = all.clone();
            for changes in first_remedies_of(&failures) {
                for change in changes {
                    add(&mut all, change);
                }
            }
            if all == before {
                return None;
            }
            let cams = remake(&all)?;
            if cams.passed() {
                return Some(fewest(TriedChanges { changes: all, cams }, &passing));
            }
            failures = cams.failures();
        }
        None
    }
}

impl ProvenAssembly {
    /// What the checks of every cam found that fail.
    fn failures(&self) -> Vec<Finding> {
        let findings = self.all().flat_map(Proven::findings);
        findings.filter(|finding| finding.verdict == Verdict::Fail).cloned().collect()
    }
}

/// Without the changes that are not needed.
fn fewest(found: TriedChanges, passing: &dyn Fn(Vec<KeyChange>) -> Option<TriedChanges>) -> TriedChanges {
    let mut least = found;
    let mut at = 0;
    while least.changes.len() > 1 && at < least.changes.len() {
        let mut fewer = least.changes.clone();
        fewer.remove(at);
        match passing(fewer) {
            Some(passes) => least = passes,
            None => at += 1,
        }
    }
    least
}

/// The remedies of checks that failed, each with all of its changes.
fn remedies_of(failures: &[Finding]) -> Vec<Vec<KeyChange>> {
    let mut all: Vec<Vec<KeyChange>> = Vec::new();
    for remedy in failures.iter().flat_map(Finding::remedies) {
        if !all.contains(&remedy.changes) {
            all.push(remedy.changes.clone());
        }
    }
    all
}

/// The first remedy of each check that failed.
fn first_remedies_of(failures: &[Finding]) -> Vec<Vec<KeyChange>> {
    failures.iter().filter_map(|found| found.remedies().first().map(|remedy| remedy.changes.clone())).collect()
}

/// Adds a change; of two values for a key the larger one stays, where both are quantities of one kind.
fn add(all: &mut Vec<KeyChange>, change: KeyChange) {
    let Some(same) = all.iter_mut().find(|other| other.key == change.key) else {
        all.push(change);
        return;
    };
    let is_smaller = match (number_and_unit(&same.value), number_and_unit(&change.value)) {
        (Some((old, unit)), Some((new, other))) => unit == other && new <= old,
        _ => false,
    };
    if !is_smaller {
        *same = change;
    }
}

/// A typed quantity in its parts; `None` of words.
fn number_and_unit(typed: &str) -> Option<(f64, &str)> {
    let (number, unit) = typed.split_once(' ').unwrap_or((typed, ""));
    Some((number.parse().ok()?, unit))
}

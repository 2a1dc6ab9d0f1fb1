//! A domain: a kind of machine with its keys, its cams, its analyses and its checks.

use crate::body::Kind;
use crate::check::Check;
use crate::machine::{Embedded, Machine, ReadParts};
use crate::pipeline::Spec;
use camgen_kernel::document::KeySection;
use camgen_kernel::document::cams::CamKind;
use camgen_kernel::refusal::Refusal;

use std::sync::LazyLock;

/// The domains of a crate.
#[derive(Debug)]
pub struct PlugIn {
    /// Its name; the domains stand in the order of these.
    pub name: &'static str,
    /// Its domains, in the order in which they build on each other.
    pub domains: &'static [&'static Domain],
}

inventory::collect!(PlugIn);

/// Registers the domains of a crate, once, outside of any function: whatever is linked with the crate has them.
///
/// ```
/// # use camgen_cams as camgen;
/// use camgen::domain::Domain;
///
/// const DOMAINS: &[&Domain] = &[];
/// camgen::register!("example", DOMAINS);
/// # fn main() {}
/// ```
#[macro_export]
macro_rules! register {
    ($name:expr, $domains:expr) => {
        $crate::inventory::submit! { $crate::domain::PlugIn { name: $name, domains: $domains } }
    };
}

/// Every domain that a program is linked with.
#[must_use]
pub fn registered() -> &'static [&'static Domain] {
    static REGISTERED: LazyLock<Vec<&'static Domain>> = LazyLock::new(|| {
        let mut all: Vec<&PlugIn> = inventory::iter::<PlugIn>.into_iter().collect();
        // They come in any order.
        all.sort_by_key(|plug_in| plug_in.name);
        all.into_iter().flat_map(|plug_in| plug_in.domains).copied().collect()
    });
    &REGISTERED
}

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
    /// Its commands that make a cam of a design.
    pub commands: &'static [DesignCommand],
}

/// A command that makes a cam, with its defaults.
#[derive(Debug, Clone, Copy)]
pub struct DesignCommand {
    /// Its word on the command line.
    pub word: &'static str,
    /// Whether it is that of a machine for which none is named.
    pub usual: fn(&Machine) -> bool,
    /// The cam that it makes.
    pub makes: Makes,
}

/// How a command makes the cam of a machine.
#[derive(Debug, Clone, Copy)]
pub enum Makes {
    /// For a speed, or for that of the machine.
    ForOne(fn(Machine, Option<f64>) -> Result<Spec, Refusal>),
    /// For several speeds, or for that of the machine, wherever there is the cam of another command. A study does not make it.
    ForSeveral {
        /// The word of the other command.
        beside: &'static str,
        /// The cam.
        spec: fn(Machine, Vec<f64>) -> Result<Spec, Refusal>,
    },
}

impl DesignCommand {
    /// The cam of a machine for these speeds, or for that of the machine.
    ///
    /// # Errors
    /// [`Refusal`] where the machine has no such cam, or it is not one for several speeds.
    pub fn spec(&self, machine: Machine, rpm: &[f64]) -> Result<Spec, Refusal> {
        match (self.makes, rpm) {
            (Makes::ForOne(spec), []) => spec(machine, None),
            (Makes::ForOne(spec), [rpm]) => spec(machine, Some(*rpm)),
            (Makes::ForOne(_), several) => {
                Err(Refusal::new(format!("this cam is cut for one speed, not {}", several.len())))
            }
            (Makes::ForSeveral { spec, .. }, rpm) => spec(machine, rpm.to_vec()),
        }
    }

    /// Whether a study makes its cam: that of one speed.
    #[must_use]
    pub fn is_for_one_speed(&self) -> bool {
        matches!(self.makes, Makes::ForOne(_))
    }
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

//! Everything that the core and the domains of a program bring, in one catalogue: tables of keys, machine files, kinds of cam and of analysis, checks.

use crate::analysis::{compare, import, laws, size};
use crate::body::{self, Kind};
use crate::check::Check;
use crate::domain::{Added, DesignCommand, Domain, Makes, registered};
use crate::machine::{self, Catalogue, Machine, MachineError, MachineSource};
use crate::pipeline::Spec;
use crate::tool_files::tool_files;
use crate::trade;
use crate::verify::{CHECKS, CheckEntry};
use camgen_kernel::document::{InputFiles, KeySection, Tables, cams};
use camgen_kernel::motion::program::rows::TableRows;
use camgen_kernel::refusal::Refusal;
use std::sync::LazyLock;

/// What machine files may contain, and those in the binary: of the core and of every domain that the program is linked with.
///
/// ```
/// # use camgen_cams as camgen;
/// let catalogue = camgen::catalogue::catalogue();
/// assert!(catalogue.names().contains(&"feeder") && catalogue.checks.contains(&"pressure_angle"));
/// ```
#[must_use]
pub fn catalogue() -> &'static Catalogue {
    static CATALOGUE: LazyLock<Catalogue> = LazyLock::new(|| Catalogue::builder().with(registered()).build());
    &CATALOGUE
}

/// Puts a catalogue together: of the core, and of the domains that it is given.
#[derive(Debug, Default)]
pub struct CatalogueBuilder {
    domains: Vec<&'static Domain>,
}

impl Catalogue {
    /// A catalogue of the core and of chosen domains.
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::machine::Catalogue;
    ///
    /// assert!(Catalogue::builder().build().names().contains(&"feeder"));
    /// ```
    #[must_use]
    pub fn builder() -> CatalogueBuilder {
        CatalogueBuilder::default()
    }
}

impl CatalogueBuilder {
    /// With these domains, after those that it has.
    #[must_use]
    pub fn with(mut self, domains: &[&'static Domain]) -> Self {
        self.domains.extend(domains);
        self
    }

    /// The catalogue.
    #[must_use]
    pub fn build(self) -> Catalogue {
        let domains = &self.domains;
        let kinds = cams::KINDS.iter().chain(domains.iter().flat_map(|domain| domain.cams)).copied().collect();
        let embedded = domains.iter().flat_map(|domain| domain.embedded).chain(machine::EMBEDDED);
        Catalogue {
            keys: Tables { sections: sections(domains), kinds },
            embedded: embedded.copied().collect(),
            parts: body::BODIES
                .iter()
                .filter_map(|body| body.keys.map(|keys| keys.read))
                .chain(domains.iter().filter_map(|domain| domain.read))
                .collect(),
            checks: checks_with(domains).into_iter().map(|check| check.name).collect(),
            file_checks: file_checks().map(|check| check.name).collect(),
        }
    }
}

/// Every table of a machine file.
fn sections(domains: &[&Domain]) -> Vec<&'static KeySection> {
    let mut all = machine::sections();
    for keys in body::BODIES.iter().filter_map(|body| body.keys) {
        let added = Added { after: keys.section.path, entries: std::slice::from_ref(&keys.section) };
        added.put_into(&mut all, |section| section.path);
    }
    for added in domains.iter().flat_map(|domain| domain.sections) {
        added.put_into(&mut all, |section| section.path);
    }
    all
}

/// Every check of the core and these domains, in the order of reports.
fn checks_with(domains: &[&Domain]) -> Vec<&'static Check> {
    let mut all: Vec<&'static Check> =
        CHECKS.iter().map(|check| &**check).chain([&compare::DEVIATION, &import::DEVIATION]).collect();
    for file in tool_files() {
        let facts = file.facts();
        let before = all.iter().position(|check| check.name == facts.stands_after);
        all.insert(before.map_or(all.len(), |before| before + 1), facts.check);
    }
    for added in domains.iter().flat_map(|domain| domain.checks) {
        added.put_into(&mut all, |check| check.name);
    }
    all
}

/// The checks that read what was written.
fn file_checks() -> impl Iterator<Item = &'static Check> {
    let of_outlines = CHECKS.iter().filter_map(|entry| match entry {
        CheckEntry::File(check) => Some(&check.check),
        CheckEntry::Figure(_) => None,
    });
    of_outlines.chain(tool_files().map(|file| file.facts().check))
}

/// Every check, in the order of reports.
pub fn checks() -> impl Iterator<Item = &'static Check> {
    checks_with(registered()).into_iter()
}

/// Every kind of cam.
pub fn kinds() -> impl Iterator<Item = &'static Kind> {
    let of_domains = registered().iter().flat_map(|domain| domain.kinds);
    body::BODIES.iter().map(|body| &body.kind).chain(body::MADE_WITH).chain(of_domains).copied()
}

/// The analyses of any machine.
const ANALYSES: &[&Kind] = &[&size::KIND, &laws::KIND, &compare::KIND, &import::KIND, &trade::KIND];

/// Every kind of analysis.
pub fn analyses() -> impl Iterator<Item = &'static Kind> {
    ANALYSES.iter().chain(registered().iter().flat_map(|domain| domain.analyses)).copied()
}

/// Makes the cam of a motion program.
const MAKE: DesignCommand = DesignCommand { word: cams::MAKE, usual: |_| true, makes: Makes::ForOne(made) };

fn made(machine: Machine, rpm: Option<f64>) -> Result<Spec, Refusal> {
    Spec::of_program(machine, rpm).ok_or_else(|| {
        let refusal = Refusal::new("the base has no motion");
        match registered().iter().flat_map(|domain| domain.commands).next() {
            Some(command) => refusal.remedy(format!("write command = \"{}\"", command.word)),
            None => refusal.remedy("give it one: [motion]"),
        }
    })
}

/// Every command that makes a cam of a design.
pub fn commands() -> impl Iterator<Item = &'static DesignCommand> {
    std::iter::once(&MAKE).chain(registered().iter().flat_map(|domain| domain.commands))
}

/// The command of a machine for which none is named.
#[must_use]
pub fn usual_command(machine: &Machine) -> &'static DesignCommand {
    let of_domains = commands().skip(1).find(|command| (command.usual)(machine));
    of_domains.unwrap_or(&MAKE)
}

impl Machine {
    /// Reads an embedded machine by its name, or a file. Returns the machine and the word that names its files.
    ///
    /// # Errors
    /// All faults found; a file that cannot be read is one of them.
    pub fn load(name_or_path: &str, overrides: &[String]) -> Result<(Self, String), MachineError> {
        let source = MachineSource::load(name_or_path)?;
        Ok((Self::of_source(&source, overrides)?, source.stem().to_owned()))
    }

    /// Reads a machine from TOML text; `source` names it in messages, each override is `key=value`.
    ///
    /// # Errors
    /// All faults found, each with its place.
    pub fn from_toml(source: &str, text: &str, overrides: &[String]) -> Result<Self, MachineError> {
        Self::of_source(&MachineSource::from_toml(source, text), overrides)
    }
}

impl MachineSource {
    /// Reads the text of an embedded machine by its name, or of a file.
    ///
    /// # Errors
    /// A file that cannot be read, or is none of a machine; what is wrong in it shows when a machine is made of it.
    pub fn load(name_or_path: &str) -> Result<Self, MachineError> {
        Self::load_with(name_or_path, &InputFiles::default())
    }

    /// As [`MachineSource::load`], read by `files`, which says in which folders further files may lie, and records what is read.
    ///
    /// # Errors
    /// As [`MachineSource::load`].
    pub fn load_with(name_or_path: &str, files: &InputFiles) -> Result<Self, MachineError> {
        catalogue().source(name_or_path, files)
    }

    /// Reads `text` as the content of the machine file `file`, which need not have it yet; `files` reads the files that it names.
    ///
    /// # Errors
    /// If `text` is no machine file; its faults show when a machine is made of it.
    pub fn of_file(file: &str, text: &str, files: &InputFiles) -> Result<Self, MachineError> {
        catalogue().of_file(file, text, files)
    }

    /// Reads TOML text; `source` names it in messages.
    #[must_use]
    pub fn from_toml(source: &str, text: &str) -> Self {
        Self::of_user(catalogue(), source, text)
    }
}

/// Reads the lift table that the overrides name, `motion.table=FILE` among them, for the follower of a TOML text.
///
/// # Errors
/// All faults found, each with its place.
pub fn lift_table(text: &str, overrides: &[String], files: &InputFiles) -> Result<TableRows, MachineError> {
    MachineSource::from_toml("import", text).in_working_folder(files).read(overrides, machine::read_lift_table)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tests of this crate are linked with no other that has domains.
    #[test]
    fn the_core_alone_has_no_domain() {
        assert!(registered().is_empty());
        assert_eq!(commands().map(|command| command.word).collect::<Vec<_>>(), [cams::MAKE]);
        assert!(catalogue().names().contains(&"feeder") && !catalogue().names().contains(&"dpi"));
        let told = Machine::load("dpi", &[]).expect_err("a press").to_string();
        assert!(told.contains("feeder"), "{told}");
    }
}

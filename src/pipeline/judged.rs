//! An analysis with what its checks found: only it has files.

use super::{Error, FileSet, Writing, file_set};
use crate::analysis::Analysis;
use crate::report::{Finding, Inputs, Report, failed, passed};
use crate::verify;
use crate::write::{Account, OfAnalysis, When, by_name};

/// An analysis whose measures were judged.
#[derive(Debug, Clone)]
pub struct Judged {
    analysis: Analysis,
    findings: Vec<Finding>,
}

impl Judged {
    /// Judges an analysis.
    #[must_use]
    pub fn new(analysis: Analysis) -> Self {
        let findings = verify::judge(&analysis.measures);
        Self { analysis, findings }
    }

    /// What was found.
    #[must_use]
    pub fn analysis(&self) -> &Analysis {
        &self.analysis
    }

    /// Whether no check failed.
    #[must_use]
    pub fn passed(&self) -> bool {
        passed(&self.findings)
    }

    /// The report, without files.
    #[must_use]
    pub fn report(&self) -> Report {
        let analysis = &self.analysis;
        Report {
            command: analysis.kind.command.into(),
            noun: analysis.kind.noun.into(),
            machine: analysis.machine.clone(),
            rpm: analysis.speeds.clone(),
            inputs: Inputs::of(&analysis.inputs),
            sections: analysis.sections.clone(),
            checks: self.findings.clone(),
            notes: analysis.notes.clone(),
            files: Vec::new(),
        }
    }

    /// Makes the files in memory; of the formats those that the analysis has something for.
    ///
    /// # Errors
    /// [`Error::Refused`] when a check failed and `writing.force` is not set; [`Error::NoSuchFormat`], [`Error::Format`].
    pub fn files(&self, writing: &Writing) -> Result<FileSet, Error> {
        if !self.passed() && !writing.force {
            return Err(Error::Refused(failed(&self.findings).join(", ")));
        }
        let has = |of: &OfAnalysis| !(of.endings)(&self.analysis).is_empty();
        let known = || by_name().filter(|format| format.of_analysis.as_ref().is_some_and(has));
        if let Some(other) = writing.formats.iter().flatten().find(|name| !known().any(|format| format.name == **name))
        {
            let names: Vec<&str> = known().map(|format| format.name).collect();
            return Err(Error::NoSuchFormat { name: other.clone(), known: names.join(", ") });
        }
        let chosen = known().filter(|format| match &writing.formats {
            Some(names) => names.iter().any(|name| name == format.name),
            None => format.when == When::Usual,
        });
        let chosen: Vec<_> = chosen.filter_map(|format| format.of_analysis).collect();
        let endings = chosen.iter().flat_map(|format| (format.endings)(&self.analysis));
        let names: Vec<String> = endings.map(|ending| format!("{}{ending}", writing.stem)).collect();
        // A report in a file names the files.
        let mut report = self.report();
        report.files = names.iter().map(|name| writing.directory.join(name).display().to_string()).collect();
        let account = Account { analysis: &self.analysis, report: &report, template: &writing.template };
        let mut bytes = Vec::with_capacity(names.len());
        for format in chosen {
            bytes.extend((format.write)(&account)?);
        }
        let outputs = names.into_iter().zip(bytes).collect();
        Ok(file_set::set(writing, self.analysis.inputs.clone(), report, outputs))
    }
}

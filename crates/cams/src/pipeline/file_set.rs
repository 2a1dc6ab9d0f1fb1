//! Files in memory and the choice of formats; files are written all or none.

use super::Error;
use crate::body::Body;
use crate::report::{LazyReport, Report};
use crate::tool_files::{Format, formats, formats_by_name};
use crate::write::FormatSelection;
use crate::write::csv::MOST_ROWS;
use crate::write::files::{self, OutputDirectory, StagedFiles};
#[cfg(feature = "live")]
use crate::write::html::live::LiveDesign;
use crate::write::record::{WriteInputs, stage_recorded};
use crate::write::svg;
use camgen_kernel::document::Input;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::Text;
use std::path::{Path, PathBuf};

pub use files::Output;

/// Which files are written, and where.
#[derive(Debug, Clone)]
pub struct Writing {
    /// Directory, made when missing.
    pub directory: PathBuf,
    /// What the names of the files begin with.
    pub stem: String,
    /// Names of the formats; `None` for the default ones that the cam can have.
    pub formats: Option<Vec<String>>,
    /// Rows of the point table.
    pub samples: u32,
    /// The SVG template the review sheet is put into.
    pub template: String,
    /// The design with which the moving report (format `html`) is made live: its engine is in it.
    #[cfg(feature = "live")]
    pub live: Option<LiveDesign>,
    /// The time that the files bear, where their format has a place for it, seconds since 1970 UTC; `None` for no time.
    pub created: Option<u64>,
    /// Write although a check failed.
    pub force: bool,
    /// Replace files that were edited, or that camgen has not written. Its own are always replaced.
    pub overwrite: bool,
}

/// Rows of the point table by default: every half degree.
const SAMPLES: u32 = 720;

impl Writing {
    /// The default formats in a directory.
    pub fn to(directory: impl Into<PathBuf>, stem: impl Into<String>) -> Self {
        Self {
            directory: directory.into(),
            stem: stem.into(),
            formats: None,
            samples: SAMPLES,
            template: svg::TEMPLATE.to_owned(),
            #[cfg(feature = "live")]
            live: None,
            created: None,
            force: false,
            overwrite: false,
        }
    }

    /// Only these formats.
    #[must_use]
    pub fn formats(self, names: &[&str]) -> Self {
        Self { formats: Some(names.iter().map(|&name| name.to_owned()).collect()), ..self }
    }

    /// The formats that are written for a body, and the default ones it cannot have, with the reason.
    ///
    /// # Errors
    /// [`Error::NoSuchFormat`]; [`Error::Unfit`] when a format was requested that the body cannot have; [`Error::Format`] when the table would have too many rows.
    #[expect(clippy::type_complexity, reason = "two lists")]
    pub fn chosen(&self, body: &dyn Body) -> Result<(Vec<Format>, Vec<(&'static str, &'static str)>), Error> {
        let (mut chosen, mut left_out) = (Vec::new(), Vec::new());
        let sections = u32::try_from(body.cuts().len()).unwrap_or(u32::MAX);
        if self.samples.saturating_mul(sections) > MOST_ROWS {
            let (rows, most) = (self.samples, MOST_ROWS / sections.max(1));
            let what = format!(
                "the point table would have {rows} rows for each of {sections} sections, more than {MOST_ROWS} in all"
            );
            return Err(Error::Format(Refusal::new(what).remedy(format!("give --samples {most} at most"))));
        }
        if let Some(unknown) =
            self.formats.iter().flatten().find(|name| !formats_by_name().any(|format| format.name == *name))
        {
            let known: Vec<&str> = formats_by_name().map(|format| format.name).collect();
            return Err(Error::NoSuchFormat { name: unknown.clone(), known: known.join(", ") });
        }
        for format in formats() {
            let asked = self.formats.as_ref().map(|names| names.iter().any(|name| name == format.name));
            match (format.when, asked, format.unfit(body)) {
                (FormatSelection::Drawn, _, _) | (_, Some(true), None) | (FormatSelection::Usual, None, None) => {
                    chosen.push(format);
                }
                (_, Some(true), Some(why)) => return Err(Error::Unfit { format: format.name, why }),
                (FormatSelection::Usual, None, Some(why)) => left_out.push((format.name, why)),
                (_, Some(false), _) | (FormatSelection::Asked, None, _) => {}
            }
        }
        Ok((chosen, left_out))
    }
}

/// Files in memory, ready to be written.
#[derive(Debug)]
pub struct FileSet {
    directory: PathBuf,
    stem: String,
    machine: String,
    inputs: Vec<Input>,
    overwrite: bool,
    report: LazyReport,
    outputs: Vec<Output>,
}

impl FileSet {
    /// Named bytes where they are to be written.
    pub(super) fn new(
        writing: &Writing,
        (machine, inputs): (&str, Vec<Input>),
        report: LazyReport,
        named: Vec<(String, Vec<u8>)>,
    ) -> Self {
        let outputs = named.into_iter().map(|(name, bytes)| Output { name, bytes }).collect();
        let (directory, stem) = (writing.directory.clone(), writing.stem.clone());
        Self { directory, stem, machine: machine.to_owned(), inputs, overwrite: writing.overwrite, report, outputs }
    }

    /// The report, with the names of the files.
    #[must_use]
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// The files.
    #[must_use]
    pub fn outputs(&self) -> &[Output] {
        &self.outputs
    }

    /// The bytes of a file by the end of its name.
    #[must_use]
    pub fn bytes(&self, ending: &str) -> Option<&[u8]> {
        self.outputs.iter().find(|output| output.name.ends_with(ending)).map(|output| output.bytes.as_slice())
    }

    /// With the files of another set, which are written with these or not at all.
    pub(super) fn add(&mut self, other: Self) {
        self.outputs.extend(other.outputs);
    }

    /// With more files.
    pub(super) fn extend(&mut self, named: impl IntoIterator<Item = (String, Vec<u8>)>) {
        self.outputs.extend(named.into_iter().map(|(name, bytes)| Output { name, bytes }));
    }

    /// Where they go.
    #[must_use]
    pub fn directory(&self) -> &Path {
        &self.directory
    }

    /// Writes all files, or none, with a record of them, `.camgen.json`. Files that camgen wrote and nobody changed are replaced,
    /// and the notes of the report name the inputs that differ from the last time.
    ///
    /// ```no_run
    /// # use camgen_cams as camgen;
    /// use camgen::{Machine, Spec, Writing};
    ///
    /// let (machine, name) = Machine::load("feeder", &[])?;
    /// let proven = Spec::of_program(machine, None).ok_or("no motion")?.solve()?.draw(5e-6)?.prove()?;
    /// let report = proven.files(&Writing::to("output", name))?.commit()?;
    /// println!("{}: {}", report.title(), report.files.join(", "));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Files`], also when a file would be replaced that camgen has not written or that was changed since; then every file
    /// is as it was before.
    pub fn commit(self) -> Result<Report, Error> {
        let place = self.open()?;
        let (report, staged) = self.stage(place)?;
        staged.commit()?;
        Ok(Report::clone(&report))
    }

    /// The first step of [`FileSet::commit`]: the directory, where another run may have to be waited for.
    ///
    /// # Errors
    /// As [`FileSet::commit`].
    pub fn open(&self) -> Result<OutputDirectory, Error> {
        Ok(OutputDirectory::open(&self.directory)?)
    }

    /// The second step: the files are written to temporary names in the open directory, so that the report can be shown before they are renamed.
    ///
    /// # Errors
    /// As [`FileSet::commit`].
    pub fn stage(self, place: OutputDirectory) -> Result<(LazyReport, StagedFiles), Error> {
        let Self { stem, machine, inputs, overwrite, report, outputs, .. } = self;
        let run = WriteInputs { stem: &stem, machine: &machine, inputs: &inputs, overwrite };
        let (staged, changes) = stage_recorded(place, outputs, &run)?;
        let with_changes = LazyReport::new(Box::new(move || {
            let mut report = Report::clone(&report);
            report.notes.extend(changes.into_iter().map(Text::from));
            report
        }));
        Ok((with_changes, staged))
    }
}

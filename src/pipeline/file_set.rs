//! The files of a proven cam: made in memory, then written all or none.

use super::{Error, Proven};
use crate::body::Body;
use crate::document::Input;
use crate::numeric::parallel;
use crate::report::{Report, Told, failed};
use crate::write::csv::MOST_ROWS;
use crate::write::files::{self, Place, Staged};
use crate::write::record::{Run, stage_recorded};
use crate::write::svg;
use crate::write::{FORMATS, Format, Rendering, When, by_name};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

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
    /// [`Error::NoSuchFormat`]; [`Error::Unfit`] when a format was requested that the body cannot have; [`Error::TooManyRows`].
    #[expect(clippy::type_complexity, reason = "two lists")]
    pub fn chosen(&self, body: &dyn Body) -> Result<(Vec<&'static Format>, Vec<(&'static str, &'static str)>), Error> {
        let (mut chosen, mut left_out) = (Vec::new(), Vec::new());
        let sections = body.spatial().map_or(1, |conoid| u32::try_from(conoid.cuts().len()).unwrap_or(u32::MAX));
        if self.samples.saturating_mul(sections) > MOST_ROWS {
            return Err(Error::TooManyRows { rows: self.samples, sections, most: MOST_ROWS });
        }
        if let Some(unknown) = self.formats.iter().flatten().find(|name| !by_name().any(|format| format.name == *name))
        {
            let known: Vec<&str> = by_name().map(|format| format.name).collect();
            return Err(Error::NoSuchFormat { name: unknown.clone(), known: known.join(", ") });
        }
        for format in FORMATS {
            let asked = self.formats.as_ref().map(|names| names.iter().any(|name| name == format.name));
            match (format.when, asked, (format.unfit)(body)) {
                (When::Drawn, _, _) | (_, Some(true), None) | (When::Usual, None, None) => chosen.push(format),
                (_, Some(true), Some(why)) => return Err(Error::Unfit { format: format.name, why }),
                (When::Usual, None, Some(why)) => left_out.push((format.name, why)),
                (_, Some(false), _) | (When::Asked, None, _) => {}
            }
        }
        Ok((chosen, left_out))
    }
}

/// Files in memory, ready to be written.
#[derive(Debug)]
pub struct FileSet<'p> {
    directory: PathBuf,
    stem: String,
    inputs: Vec<Input>,
    overwrite: bool,
    report: Told<'p>,
    outputs: Vec<Output>,
}

/// Makes the files of a proven cam.
pub(super) fn files<'p>(proven: &'p Proven<'_>, writing: &Writing) -> Result<FileSet<'p>, Error> {
    let of_second = proven.second().map(|second| {
        let stem = format!("{}-{}", writing.stem, second.cam.body().kind().command);
        (second, Writing { stem, ..writing.clone() })
    });
    // The report of the first, which stands in some of its files, names those of both.
    let beside = match &of_second {
        Some((second, writing)) => names(second, writing)?,
        None => Vec::new(),
    };
    let second = of_second.as_ref().map(|(second, writing)| || files(second, writing));
    let (all, second) = parallel::both(|| files_alone(proven, writing, &beside), second);
    let mut all = all?;
    if let Some(second) = second.transpose()? {
        all.outputs.extend(second.outputs);
    }
    Ok(all)
}

/// The names of the files of a cam without those of its second disc.
pub(super) fn names(proven: &Proven<'_>, writing: &Writing) -> Result<Vec<String>, Error> {
    let drawn = proven.drawn.as_ref().map_err(|why| Error::NoOutline(why.clone()))?;
    let (formats, _) = writing.chosen(proven.cam.body())?;
    let endings = formats.iter().flat_map(|format| (format.endings)(drawn));
    Ok(endings.map(|ending| format!("{}{ending}", writing.stem)).collect())
}

/// Without those of the second disc.
fn files_alone<'p>(proven: &'p Proven<'_>, writing: &Writing, beside: &[String]) -> Result<FileSet<'p>, Error> {
    if !proven.passed() && !writing.force {
        return Err(Error::Refused(failed(proven.findings()).join(", ")));
    }
    let (formats, _) = writing.chosen(proven.cam.body())?;
    let names = names(proven, writing)?;
    let placed = names.iter().chain(beside).map(|name| writing.directory.join(name).display().to_string());
    let files: Vec<String> = placed.collect();
    let report = Told::new(Box::new(|| Report { files, ..proven.report() }));
    let rendering = proven.rendering(&report, writing.samples, &writing.template)?;
    let rendering = Rendering { created: writing.created, ..rendering };
    let filled: Vec<_> = formats.iter().filter(|format| !(format.endings)(rendering.drawn).is_empty()).collect();
    // Made by one of several at the same time, it could wait for itself: its sections spread over the threads that write the others.
    if filled.len() > 1 {
        LazyLock::force(&report);
    }
    let made = parallel::map(&filled, |format| (format.write)(&rendering));
    let bytes: Vec<Vec<Vec<u8>>> = made.into_iter().collect::<Result<_, _>>()?;
    Ok(set(writing, proven.inputs.clone(), report, names.into_iter().zip(bytes.into_iter().flatten()).collect()))
}

/// Named bytes where they are to be written.
pub(super) fn set<'p>(
    writing: &Writing,
    inputs: Vec<Input>,
    report: Told<'p>,
    named: Vec<(String, Vec<u8>)>,
) -> FileSet<'p> {
    let outputs = named.into_iter().map(|(name, bytes)| Output { name, bytes }).collect();
    let (directory, stem) = (writing.directory.clone(), writing.stem.clone());
    FileSet { directory, stem, inputs, overwrite: writing.overwrite, report, outputs }
}

impl<'p> FileSet<'p> {
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

    /// Where they go.
    #[must_use]
    pub fn directory(&self) -> &Path {
        &self.directory
    }

    /// Writes all files, or none, with a record of them, `.camgen.json`. Files that camgen wrote and nobody changed are replaced,
    /// and the notes of the report tell which inputs differ from the last time.
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

    /// The same step by step: the directory, where another run may have to be waited for.
    ///
    /// # Errors
    /// As [`FileSet::commit`].
    pub fn open(&self) -> Result<Place, Error> {
        Ok(Place::open(&self.directory)?)
    }

    /// The files are written beside their places in the directory that was opened, so that the report can be told before they are put there.
    ///
    /// # Errors
    /// As [`FileSet::commit`].
    pub fn stage(self, place: Place) -> Result<(Told<'p>, Staged), Error> {
        let run = Run { stem: &self.stem, inputs: &self.inputs, overwrite: self.overwrite };
        let (staged, changes) = stage_recorded(place, self.outputs, &run)?;
        let report = self.report;
        let told = Told::new(Box::new(move || {
            let mut report = Report::clone(&report);
            report.notes.extend(changes);
            report
        }));
        Ok((told, staged))
    }
}

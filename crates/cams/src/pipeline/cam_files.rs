//! The files of a proven cam, and of cams that belong together, in memory.

use super::{Error, FileSet, Proven, ProvenAssembly, Writing};
use crate::body::Body;
use crate::report::{LazyReport, Report, sha256};
use crate::tool_files::{Format, Listed};
use crate::verify::WrittenOutline;
use crate::write::{PartFile, Rendering};
use camgen_kernel::numeric::parallel;
use camgen_kernel::refusal::Refusal;
use std::sync::LazyLock;

impl Proven {
    /// Makes the files in memory.
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::{Error, Spec, Writing};
    ///
    /// # let motion = camgen::motion::EccentricCircle::new(0.005, 0.040);
    /// let builder = Spec::builder("eccentric").roller(0.010).base_radius(0.030).thickness(0.012);
    /// let proven = builder.bore_radius(0.008).motion(motion)?.solve()?.draw(5e-6)?.prove()?;
    /// let writing = Writing::to("output", "eccentric");
    /// let files = proven.files(&writing)?;
    /// let names: Vec<&str> = files.outputs().iter().map(|file| file.name.as_str()).collect();
    /// assert_eq!(names, ["eccentric.dxf", "eccentric.svg", "eccentric-review.svg", "eccentric.step", "eccentric.csv"]);
    ///
    /// assert!(matches!(proven.files(&writing.formats(&["dwg"])), Err(Error::NoSuchFormat { .. })));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Refused`] when a check failed and `writing.force` is not set; [`Error::NoOutline`], [`Error::Unfit`],
    /// [`Error::Format`].
    pub fn files(&self, writing: &Writing) -> Result<FileSet, Error> {
        of_first(&self.clone().into(), writing, &[])
    }
}

impl ProvenAssembly {
    /// The settings for the files of a cam of this name.
    fn writing(name: &str, writing: &Writing) -> Writing {
        let stem = if name.is_empty() { writing.stem.clone() } else { format!("{}-{name}", writing.stem) };
        Writing { stem, ..writing.clone() }
    }

    /// The names of the files of all cams together.
    fn names_of_all(&self, writing: &Writing) -> Result<Vec<String>, Error> {
        let Some(report) = self.joint_report() else { return Ok(Vec::new()) };
        let (formats, _) = writing.chosen(self.first().body())?;
        let formats: Vec<&str> = formats.iter().map(|format| format.name).collect();
        let names = report.file_names(self.first(), &formats);
        Ok(names.into_iter().map(|name| format!("{}{name}", writing.stem)).collect())
    }

    /// The names of the files of the others.
    fn names_of_others(&self, writing: &Writing) -> Result<Vec<String>, Error> {
        let names = self.others().iter().map(|(name, cam)| names(cam, &Self::writing(name, writing)));
        Ok(names.collect::<Result<Vec<_>, _>>()?.concat())
    }

    /// The names of all files.
    pub(super) fn names(&self, writing: &Writing) -> Result<Vec<String>, Error> {
        let first = names(self.first(), &Self::writing(self.name(), writing))?;
        Ok([first, self.names_of_others(writing)?, self.names_of_all(writing)?].concat())
    }

    /// Makes the files of all of them in memory.
    ///
    /// # Errors
    /// As [`Proven::files`], of the first cam that has none.
    pub fn files(&self, writing: &Writing) -> Result<FileSet, Error> {
        // The report of the first, which some of its files contain, names those of all.
        let of_all = self.names_of_all(writing)?;
        let other_names = [self.names_of_others(writing)?, of_all.clone()].concat();
        // What is changed in a live page is the design, and its page is that of the first.
        let plain = Writing {
            #[cfg(feature = "live")]
            live: None,
            ..writing.clone()
        };
        let made = |(name, cam): &(String, Proven)| cam.files(&Self::writing(name, &plain));
        let of_others = || parallel::map(self.others(), made);
        let (first, others) =
            parallel::both(|| of_first(self, writing, &other_names), (!self.others().is_empty()).then_some(of_others));
        let mut all = first?;
        for other in others.into_iter().flatten() {
            all.add(other?);
        }
        if let Some(report) = self.joint_report().filter(|_| !of_all.is_empty()) {
            let (title, mark) = (all.report().title(), all.report().mark());
            let bytes = report.files(self.first(), self.others(), (&title, &mark), writing)?;
            all.extend(of_all.into_iter().zip(bytes));
        }
        Ok(all)
    }
}

/// The names of the files of a cam.
fn names(proven: &Proven, writing: &Writing) -> Result<Vec<String>, Error> {
    proven.outlined()?;
    let (formats, _) = writing.chosen(proven.body())?;
    let endings: Vec<Vec<String>> = formats.iter().map(|format| proven.endings(format)).collect::<Result<_, _>>()?;
    Ok(endings.concat().iter().map(|ending| format!("{}{ending}", writing.stem)).collect())
}

/// The files of a format, with its place in the list of all.
type FormatFiles = (usize, Vec<Vec<u8>>);

/// The files of formats.
fn made_of(
    formats: &[(usize, &Format)],
    make: impl Fn(&(usize, &Format)) -> Result<Vec<Vec<u8>>, Refusal> + Sync,
) -> Result<Vec<FormatFiles>, Error> {
    let made = parallel::map(formats, |format| make(format).map(|files| (format.0, files)));
    made.into_iter().collect::<Result<_, _>>().map_err(Error::Format)
}

/// The format that has the profile.
const PROFILE: &str = "dxf";
/// What a drawing calls the files of a format from which the part is made.
const ROLES: [(&str, &str); 5] = [
    (PROFILE, "Profile, 1:1"),
    ("step", "Solid"),
    ("gcode", "Program"),
    ("inspect", "Points to inspect"),
    ("further tables", "Table"),
];

/// The files from which the part is made, those of this run and always the profile.
fn part_files(
    proven: &Proven,
    rendering: &Rendering<'_>,
    made: &[FormatFiles],
    formats: &[(usize, &Format)],
    stem: &str,
) -> Result<Vec<PartFile>, Error> {
    let is_made = formats.iter().any(|(_, format)| format.name == PROFILE);
    let profile = crate::tool_files::formats()
        .find(|format| !is_made && format.name == PROFILE && format.unfit(proven.body()).is_none());
    let of_profile = profile.as_ref().map(|format| proven.written_in(format, rendering).map_err(Error::Format));
    let of_profile = of_profile.transpose()?;
    let all = formats.iter().map(|(_, format)| *format).zip(made.iter().map(|(_, files)| files));
    let all = all.chain(profile.as_ref().zip(of_profile.as_ref()));
    let mut found = Vec::new();
    for (role, format, files) in ROLES.iter().flat_map(|(name, role)| {
        all.clone().filter(move |(format, _)| format.name == *name).map(move |(format, files)| (*role, format, files))
    }) {
        for (ending, bytes) in proven.endings(format)?.iter().zip(files) {
            found.push(PartFile { role, name: format!("{stem}{ending}"), sha256: sha256(bytes) });
        }
    }
    Ok(found)
}

/// The files of the first cam of an assembly, whose report also names those of the other cams.
fn of_first(whole: &ProvenAssembly, writing: &Writing, other_names: &[String]) -> Result<FileSet, Error> {
    let proven = whole.first();
    if !whole.passed() && !writing.force {
        return Err(Error::Refused(whole.failed().join(", ")));
    }
    let (formats, _) = writing.chosen(proven.body())?;
    let drawn = proven.outlined()?;
    if let Some(format) = formats.iter().find(|format| format.shows_flank())
        && proven.body().surface().is_some()
        && drawn.flank.is_none()
    {
        // The solid of one section would take its place.
        return Err(Error::Unfit { format: format.name, why: "the flank of this cam was not drawn (Request::flank)" });
    }
    let writing_of_first = ProvenAssembly::writing(whole.name(), writing);
    let names = names(proven, &writing_of_first)?;
    let placed = names.iter().chain(other_names).map(|name| crate::report::listed_path(&writing.directory.join(name)));
    let files: Vec<String> = placed.collect();
    let assembly = whole.clone();
    let report = LazyReport::new(Box::new(move || Report { files, ..assembly.report() }));
    let rendering = proven.rendering(&report, writing.samples, &writing.template)?;
    let others: Vec<(&dyn Body, &[WrittenOutline])> =
        whole.others().iter().map(|(_, other)| (other.body(), other.outlines())).collect();
    let rendering = Rendering {
        created: writing.created,
        other_cams: &others,
        #[cfg(feature = "live")]
        live: writing.live.as_ref(),
        ..rendering
    };
    let mut filled = Vec::with_capacity(formats.len());
    for format in &formats {
        // A file that was not requested with the drawing is refused when it is to be written.
        if matches!(format.source, Listed::Tool(_)) || !proven.endings(format)?.is_empty() {
            filled.push(format);
        }
    }
    // Made by one of several at the same time, it could wait for itself: its sections spread over the threads that write the others.
    if filled.len() > 1 {
        LazyLock::force(&report);
    }
    // The drawing names the files from which the part is made, with their hashes: they are made before it.
    let (of_part, shown): (Vec<_>, Vec<_>) = filled.into_iter().enumerate().partition(|(_, format)| {
        !matches!(format.source, Listed::View(_)) || ROLES.iter().any(|(name, _)| *name == format.name)
    });
    let make = |(_, format): &(usize, &Format)| proven.written_in(format, &rendering);
    let mut bytes = made_of(&of_part, make)?;
    let has_sheet = shown.iter().any(|(_, format)| ["svg", "pdf"].contains(&format.name));
    let part_files =
        if has_sheet { part_files(proven, &rendering, &bytes, &of_part, &writing_of_first.stem)? } else { Vec::new() };
    let rendering = Rendering { part_files: &part_files, ..rendering };
    let make = |(_, format): &(usize, &Format)| proven.written_in(format, &rendering);
    bytes.extend(made_of(&shown, make)?);
    bytes.sort_by_key(|(place, _)| *place);
    let bytes: Vec<Vec<Vec<u8>>> = bytes.into_iter().map(|(_, files)| files).collect();
    Ok(FileSet::new(
        writing,
        (proven.body().machine().name(), proven.inputs().to_vec()),
        report,
        names.into_iter().zip(bytes.into_iter().flatten()).collect(),
    ))
}

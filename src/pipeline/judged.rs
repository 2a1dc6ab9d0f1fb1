//! An analysis with what its checks found: only it has files.

use super::{Error, FileSet, Proven, Writing, file_set};
use crate::analysis::Analysis;
use crate::document::Input;
use crate::numeric::parallel;
use crate::report::{Finding, Inputs, Report, Told, failed, passed, worst_first};
use crate::verify;
use crate::write::{Account, Format, OfAnalysis, When, by_name};

/// An analysis whose measures were judged, with the cam that was cut for it, where there is one.
#[derive(Debug)]
pub struct Judged<'c> {
    analysis: Analysis,
    findings: Vec<Finding>,
    cam: Option<Proven<'c>>,
}

/// A report and named files.
type OwnFiles = (Report, Vec<(String, Vec<u8>)>);

/// What the names of the files of the cam of an analysis have behind their stem.
const OF_CAM: &str = "-cam";

impl<'c> Judged<'c> {
    /// Judges an analysis.
    #[must_use]
    pub fn new(analysis: Analysis) -> Self {
        let findings = verify::judge(&analysis.measures);
        Self { analysis, findings, cam: None }
    }

    /// With the cam that is cut for it: its findings are told with those of the analysis, and its files are written with them or not at
    /// all.
    #[must_use]
    pub fn with_cam(self, cam: Proven<'c>) -> Self {
        let all = self.findings.iter().chain(cam.findings()).cloned().collect();
        Self { findings: worst_first(all), cam: Some(cam), ..self }
    }

    /// What was found.
    #[must_use]
    pub fn analysis(&self) -> &Analysis {
        &self.analysis
    }

    /// Whether no check failed, and a cam has an outline.
    #[must_use]
    pub fn passed(&self) -> bool {
        passed(&self.findings) && self.cam.as_ref().is_none_or(Proven::passed)
    }

    /// Why there is no outline of its cam, where there is none.
    #[must_use]
    pub fn no_outline(&self) -> Option<&str> {
        self.cam.as_ref().and_then(|cam| cam.no_outline())
    }

    /// Everything that determines the analysis and its cam.
    fn inputs(&self) -> Vec<Input> {
        let own = &self.analysis.inputs;
        let of_cam = self.cam.iter().flat_map(|cam| &cam.inputs);
        own.iter().chain(of_cam.filter(|input| !own.iter().any(|other| other.key == input.key))).cloned().collect()
    }

    /// The report, without files.
    #[must_use]
    pub fn report(&self) -> Report {
        let analysis = &self.analysis;
        let cam = self.cam.as_ref().map(Proven::report);
        let (sections, notes) = cam.map_or_else(Default::default, |cam| (cam.sections, cam.notes));
        Report {
            command: analysis.kind.command.into(),
            noun: analysis.kind.noun.into(),
            machine: analysis.machine.clone(),
            rpm: analysis.speeds.clone(),
            inputs: Inputs::of(&self.inputs()),
            sections: analysis.sections.iter().cloned().chain(sections).collect(),
            checks: self.findings.clone(),
            notes: analysis.notes.iter().cloned().chain(notes).collect(),
            files: Vec::new(),
        }
    }

    /// Makes the files in memory; of the formats those that the analysis or its cam has something for.
    ///
    /// # Errors
    /// [`Error::Refused`] when a check failed and `writing.force` is not set; [`Error::NoSuchFormat`], [`Error::Format`],
    /// [`Error::NoOutline`].
    pub fn files(&self, writing: &Writing) -> Result<FileSet<'_>, Error> {
        if !self.passed() && !writing.force {
            return Err(Error::Refused(failed(&self.findings).join(", ")));
        }
        let (own, of_cam) = self.chosen(writing)?;
        let of_cam = self.cam.as_ref().zip(of_cam).filter(|(_, formats)| !formats.is_empty());
        let of_cam = of_cam.map(|(cam, formats)| {
            let stem = format!("{}{OF_CAM}", writing.stem);
            // What refuses the set has been looked at before.
            (cam, Writing { stem, formats: Some(formats), force: true, ..writing.clone() })
        });
        let beside = match &of_cam {
            Some((cam, writing)) => file_set::names(cam, writing)?,
            None => Vec::new(),
        };
        let cam_files = of_cam.as_ref().map(|(cam, writing)| || file_set::files(cam, writing));
        let (own, of_cam) = parallel::both(|| self.own_files(writing, &own, &beside), cam_files);
        let (report, mut named) = own?;
        let of_cam = of_cam.transpose()?;
        named
            .extend(of_cam.iter().flat_map(FileSet::outputs).map(|output| (output.name.clone(), output.bytes.clone())));
        Ok(file_set::set(writing, self.inputs(), Told::new(Box::new(|| report)), named))
    }

    /// The files of the analysis, and the report that names them and those beside them.
    fn own_files(&self, writing: &Writing, formats: &[OfAnalysis], beside: &[String]) -> Result<OwnFiles, Error> {
        let endings = formats.iter().flat_map(|format| (format.endings)(&self.analysis));
        let names: Vec<String> = endings.map(|ending| format!("{}{ending}", writing.stem)).collect();
        // A report in a file names the files.
        let mut report = self.report();
        let all = names.iter().chain(beside);
        report.files = all.map(|name| writing.directory.join(name).display().to_string()).collect();
        let account = Account { analysis: &self.analysis, report: &report, template: &writing.template };
        let made: Vec<_> = formats.iter().map(|format| (format.write)(&account)).collect::<Result<_, _>>()?;
        Ok((report, names.into_iter().zip(made.into_iter().flatten()).collect()))
    }

    /// The formats of the analysis, and the names of those of its cam, where there is one.
    fn chosen(&self, writing: &Writing) -> Result<(Vec<OfAnalysis>, Option<Vec<String>>), Error> {
        let has = |of: &OfAnalysis| !(of.endings)(&self.analysis).is_empty();
        let own: Vec<&Format> = by_name().filter(|format| format.of_analysis.as_ref().is_some_and(has)).collect();
        let wanted = |format: &Format| match &writing.formats {
            Some(names) => names.iter().any(|name| name == format.name),
            None => format.when == When::Usual,
        };
        let is_own = |name: &str| own.iter().any(|format| format.name == name);
        let of_cam = match &self.cam {
            None => None,
            Some(cam) => {
                // What only the analysis has is not asked of the cam.
                let fits = |format: &&Format| !is_own(format.name) || (format.unfit)(cam.body()).is_none();
                let names = |formats: Option<Vec<String>>| Writing { formats, ..writing.clone() };
                let asked = writing.formats.as_ref().map(|asked| {
                    let kept = by_name().filter(fits).map(|format| format.name);
                    let kept: Vec<&str> = kept.collect();
                    asked.iter().filter(|name| !is_own(name) || kept.contains(&name.as_str())).cloned().collect()
                });
                let (formats, _) = names(asked).chosen(cam.body())?;
                Some(formats.iter().filter(|format| format.when != When::Drawn).map(|f| f.name.to_owned()).collect())
            }
        };
        let other = writing.formats.iter().flatten().find(|name| !is_own(name));
        if let (Some(other), None) = (other, &of_cam) {
            let names: Vec<&str> = own.iter().map(|format| format.name).collect();
            return Err(Error::NoSuchFormat { name: other.clone(), known: names.join(", ") });
        }
        let own = own.into_iter().filter(|format| wanted(format)).filter_map(|format| format.of_analysis);
        Ok((own.collect(), of_cam))
    }
}

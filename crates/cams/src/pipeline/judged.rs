//! An analysis with what its checks found: only it has files.

use super::{Error, FileSet, ProvenAssembly, Writing};
use crate::analysis::Analysis;
use crate::machine::UNITS_KEY;
use crate::report::{Finding, Inputs, LazyReport, Report, failed, passed, worst_first};
use crate::tool_files::{Format, formats_by_name};
use crate::verify;
use crate::write::{AnalysisFormat, AnalysisRendering, FormatSelection};
use camgen_kernel::document::{Input, NamedChoice};
use camgen_kernel::numeric::parallel;
use camgen_kernel::text::Text;
use camgen_kernel::units::LengthUnit;

/// An analysis whose measures were judged, with the cam that was cut for it, where there is one.
///
/// ```
/// # use camgen_cams as camgen;
/// use camgen::{Judged, Machine, analysis::size};
///
/// let (machine, _) = Machine::load("lever", &[])?;
/// let judged = Judged::new(size::analysis(&machine, &[], None)?);
/// assert!(judged.passed());
/// println!("{}", serde_json::to_string(&judged.report())?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Judged {
    analysis: Analysis,
    findings: Vec<Finding>,
    cams: Option<ProvenAssembly>,
    units: LengthUnit,
}

/// A report and named files.
type OwnFiles = (Report, Vec<(String, Vec<u8>)>);

/// What the names of the files of the cam of an analysis have after the stem.
const OF_CAM: &str = "-cam";

impl ProvenAssembly {
    /// With an analysis of the machine that they are for: its report leads, and its files are written with theirs or not at all.
    #[must_use]
    pub fn with_analysis(self, analysis: Judged) -> Judged {
        analysis.with_cams(self)
    }
}

impl Judged {
    /// Judges an analysis.
    #[must_use]
    pub fn new(analysis: Analysis) -> Self {
        let findings = verify::judge(&analysis.measures);
        let of_file = analysis.inputs.iter().find(|input| input.key == UNITS_KEY);
        let units = of_file.and_then(|input| LengthUnit::named(&input.value)).unwrap_or_default();
        Self { analysis, findings, cams: None, units }
    }

    /// With its report and its files in a unit.
    #[must_use]
    pub fn in_units(self, units: LengthUnit) -> Self {
        Self { units, ..self }
    }

    /// With the cams that are cut for it: their findings are reported with those of the analysis, and their files are written with its own or
    /// not at all.
    fn with_cams(self, cams: ProvenAssembly) -> Self {
        let all = self.findings.iter().chain(cams.findings()).cloned().collect();
        Self { findings: worst_first(all), cams: Some(cams), ..self }
    }

    /// The analysis that was judged.
    #[must_use]
    pub fn analysis(&self) -> &Analysis {
        &self.analysis
    }

    /// Whether no check failed, and a cam has an outline.
    #[must_use]
    pub fn passed(&self) -> bool {
        passed(&self.findings) && self.cams.as_ref().is_none_or(ProvenAssembly::passed)
    }

    /// Why its cam has no outline, where it has none.
    #[must_use]
    pub fn no_outline(&self) -> Option<&str> {
        self.cams.as_ref().and_then(ProvenAssembly::no_outline)
    }

    /// Everything that determines the analysis and its cam.
    fn inputs(&self) -> Vec<Input> {
        let own = &self.analysis.inputs;
        let of_cam = self.cams.iter().flat_map(|cams| cams.first().inputs());
        own.iter().chain(of_cam.filter(|input| !own.iter().any(|other| other.key == input.key))).cloned().collect()
    }

    /// The report, without files.
    #[must_use]
    pub fn report(&self) -> Report {
        let analysis = &self.analysis;
        let cam = self.cams.as_ref().map(ProvenAssembly::report);
        let (sections, notes, of_cam) =
            cam.map_or_else(Default::default, |cam| (cam.sections, cam.notes, cam.not_modelled));
        let mut not_modelled: Vec<String> = analysis.not_modelled.iter().map(|&sentence| sentence.to_owned()).collect();
        not_modelled.extend(of_cam);
        Report {
            command: analysis.kind.command.into(),
            noun: analysis.kind.noun.into(),
            machine: analysis.machine.clone(),
            rpm: analysis.speeds.clone(),
            shaft: None,
            inputs: Inputs::of(&self.inputs()),
            sections: analysis.sections.iter().cloned().chain(sections).collect(),
            checks: self.findings.clone(),
            other_checks: Vec::new(),
            notes: analysis.notes.iter().cloned().map(Text::from).chain(notes).collect(),
            not_modelled,
            files: Vec::new(),
            units: self.units,
        }
    }

    /// The report, made when it is first read.
    #[must_use]
    pub fn lazy_report(&self) -> LazyReport {
        let judged = self.clone();
        LazyReport::new(Box::new(move || judged.report()))
    }

    /// Makes the files in memory; of the formats those that the analysis or its cam has something for.
    ///
    /// # Errors
    /// [`Error::Refused`] when a check failed and `writing.force` is not set; [`Error::NoSuchFormat`], [`Error::Format`],
    /// [`Error::NoOutline`].
    pub fn files(&self, writing: &Writing) -> Result<FileSet, Error> {
        if !self.passed() && !writing.force {
            return Err(Error::Refused(failed(&self.findings).join(", ")));
        }
        let (own, of_cam) = self.chosen(writing)?;
        let of_cam = self.cams.as_ref().zip(of_cam).filter(|(_, formats)| !formats.is_empty());
        let of_cam = of_cam.map(|(cam, formats)| {
            let stem = format!("{}{OF_CAM}", writing.stem);
            // What refuses the set has been looked at before.
            (cam, Writing { stem, formats: Some(formats), force: true, ..writing.clone() })
        });
        let cam_names = match &of_cam {
            Some((cams, writing)) => cams.names(writing)?,
            None => Vec::new(),
        };
        let cam_files = of_cam.as_ref().map(|(cam, writing)| || cam.files(writing));
        let (own, of_cam) = parallel::both(|| self.own_files(writing, &own, &cam_names), cam_files);
        let (report, mut named) = own?;
        let of_cam = of_cam.transpose()?;
        named
            .extend(of_cam.iter().flat_map(FileSet::outputs).map(|output| (output.name.clone(), output.bytes.clone())));
        Ok(FileSet::new(
            writing,
            (&self.analysis().machine, self.inputs()),
            LazyReport::new(Box::new(|| report)),
            named,
        ))
    }

    /// The files of the analysis, and the report that names them and those of its cam.
    fn own_files(
        &self,
        writing: &Writing,
        formats: &[AnalysisFormat],
        cam_names: &[String],
    ) -> Result<OwnFiles, Error> {
        let endings = formats.iter().flat_map(|format| (format.endings)(&self.analysis));
        let names: Vec<String> = endings.map(|ending| format!("{}{ending}", writing.stem)).collect();
        // A report in a file names the files.
        let mut report = self.report();
        let all = names.iter().chain(cam_names);
        report.files = all.map(|name| crate::report::listed_path(&writing.directory.join(name))).collect();
        let account = AnalysisRendering { analysis: &self.analysis, report: &report, template: &writing.template };
        let made: Vec<_> =
            formats.iter().map(|format| (format.write)(&account)).collect::<Result<_, _>>().map_err(Error::Format)?;
        Ok((report, names.into_iter().zip(made.into_iter().flatten()).collect()))
    }

    /// The formats of the analysis, and the names of those of its cam, where there is one.
    fn chosen(&self, writing: &Writing) -> Result<(Vec<AnalysisFormat>, Option<Vec<String>>), Error> {
        let has = |of: &AnalysisFormat| !(of.endings)(&self.analysis).is_empty();
        let own: Vec<Format> =
            formats_by_name().filter(|format| format.of_analysis().as_ref().is_some_and(has)).collect();
        let wanted = |format: &Format| match &writing.formats {
            Some(names) => names.iter().any(|name| name == format.name),
            None => format.when == FormatSelection::Usual,
        };
        let is_own = |name: &str| own.iter().any(|format| format.name == name);
        let of_cam = match &self.cams {
            None => None,
            Some(cams) => {
                let body = cams.first().body();
                // What only the analysis has is not asked of the cam.
                let fits = |format: &Format| !is_own(format.name) || format.unfit(body).is_none();
                let names = |formats: Option<Vec<String>>| Writing { formats, ..writing.clone() };
                let asked = writing.formats.as_ref().map(|asked| {
                    let kept = formats_by_name().filter(fits).map(|format| format.name);
                    let kept: Vec<&str> = kept.collect();
                    asked.iter().filter(|name| !is_own(name) || kept.contains(&name.as_str())).cloned().collect()
                });
                let (formats, _) = names(asked).chosen(body)?;
                Some(
                    formats
                        .iter()
                        .filter(|format| format.when != FormatSelection::Drawn)
                        .map(|f| f.name.to_owned())
                        .collect(),
                )
            }
        };
        let other = writing.formats.iter().flatten().find(|name| !is_own(name));
        if let (Some(other), None) = (other, &of_cam) {
            let names: Vec<&str> = own.iter().map(|format| format.name).collect();
            return Err(Error::NoSuchFormat { name: other.clone(), known: names.join(", ") });
        }
        let own = own.into_iter().filter(|format| wanted(format)).filter_map(|format| format.of_analysis());
        Ok((own.collect(), of_cam))
    }
}

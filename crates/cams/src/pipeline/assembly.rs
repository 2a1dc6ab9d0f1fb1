//! Cams that belong together: solved, drawn, proved and written as one, or not at all, with an analysis of the machine they are for.

use super::{Cam, Drawing, Error, Proven, Writing};
use crate::body::{Body, Request};
use crate::check::Measure;
use crate::report::{Finding, LazyReport, Report, Section, Verdict, failed};
use crate::table::Table;
use crate::tool_files::dxf::Version;
use crate::verify::WrittenOutline;
use crate::write::csv;
use camgen_kernel::numeric::parallel;
use std::fmt;
use std::sync::Arc;

/// Measures and sections of the report on the cams of an assembly together.
///
/// ```
/// # use camgen_cams as camgen;
/// use camgen::{Assembly, AssemblyReport, Proven, Section, Spec};
/// use std::sync::Arc;
///
/// /// Counts the arcs to cut.
/// #[derive(Debug)]
/// struct Arcs;
///
/// impl AssemblyReport for Arcs {
///     fn sections(&self, first: &Proven, others: &[(String, Proven)]) -> Vec<Section> {
///         let arcs = |cam: &Proven| cam.outlines()[0].contour.arcs();
///         let all: usize = arcs(first) + others.iter().map(|(_, cam)| arcs(cam)).sum::<usize>();
///         vec![Section::new("arcs", &all)]
///     }
/// }
///
/// # let motion = camgen::motion::EccentricCircle::new(0.005, 0.040);
/// let cam = Spec::builder("eccentric").roller(0.010).base_radius(0.030).motion(motion)?.solve()?;
/// let assembly = Assembly::from(cam.clone()).with("second", cam).reported(Arc::new(Arcs));
/// let report = assembly.draw(5e-6)?.prove()?.report();
/// assert!(report.section("arcs").is_some());
/// # Ok::<(), camgen::Error>(())
/// ```
pub trait AssemblyReport: fmt::Debug + Send + Sync {
    /// Measures of the first cam, as its outlines are written, that rest on the others.
    fn measures(&self, _first: (&dyn Body, &[WrittenOutline]), _others: &[(String, Proven)]) -> Vec<Measure> {
        Vec::new()
    }

    /// What the names of files of all cams together have after the stem, where these formats are written.
    fn file_names(&self, _first: &Proven, _formats: &[&str]) -> Vec<&'static str> {
        Vec::new()
    }

    /// Those files, under a title and with a mark.
    ///
    /// # Errors
    /// [`Error::Format`] when one cannot be made.
    fn files(
        &self,
        _first: &Proven,
        _others: &[(String, Proven)],
        _titled: (&str, &str),
        _writing: &Writing,
    ) -> Result<Vec<Vec<u8>>, Error> {
        Ok(Vec::new())
    }

    /// Sections of the report, once all are proved.
    fn sections(&self, _first: &Proven, _others: &[(String, Proven)]) -> Vec<Section> {
        Vec::new()
    }
}

/// Cams that belong together: a first one, and others that are made for it, each with what the names of its files have after the stem.
#[derive(Debug, Clone)]
pub struct Assembly {
    first: Cam,
    /// What the names of the files of the first have after the stem; empty where they have the stem alone.
    name: &'static str,
    others: Vec<(String, Cam)>,
    joint_report: Option<Arc<dyn AssemblyReport>>,
}

impl From<Cam> for Assembly {
    /// One cam alone.
    fn from(first: Cam) -> Self {
        Self { first, name: "", others: Vec::new(), joint_report: None }
    }
}

impl Assembly {
    /// With what the names of the files of the first cam have after the stem.
    #[must_use]
    pub(super) fn called(self, name: &'static str) -> Self {
        Self { name, ..self }
    }

    /// With another cam, whose files have this name after the stem.
    #[must_use]
    pub fn with(mut self, name: impl Into<String>, cam: Cam) -> Self {
        self.others.push((name.into(), cam));
        self
    }

    /// With measures and sections of the report on what its cams do together.
    #[must_use]
    pub fn reported(self, joint_report: Arc<dyn AssemblyReport>) -> Self {
        Self { joint_report: Some(joint_report), ..self }
    }

    /// The cam that the others are made for.
    #[must_use]
    pub fn first(&self) -> &Cam {
        &self.first
    }

    /// The others, by name.
    #[must_use]
    pub fn others(&self) -> &[(String, Cam)] {
        &self.others
    }

    /// Draws every cam.
    ///
    /// # Errors
    /// As [`Cam::draw`].
    pub fn draw(&self, request: impl Into<Request>) -> Result<AssemblyDrawing, Error> {
        let request = request.into();
        let others = self.others();
        let of_others = || parallel::map(others, |(name, cam)| Ok((name.clone(), cam.draw(request)?)));
        let (first, others) = parallel::both(|| self.first.draw(request), (!others.is_empty()).then_some(of_others));
        let others = others.into_iter().flatten().collect::<Result<_, Error>>()?;
        Ok(AssemblyDrawing { first: first?, name: self.name, others, joint_report: self.joint_report.clone() })
    }
}

/// The cams of an assembly as drawn, not yet proved.
#[derive(Debug, Clone)]
pub struct AssemblyDrawing {
    first: Drawing,
    name: &'static str,
    others: Vec<(String, Drawing)>,
    joint_report: Option<Arc<dyn AssemblyReport>>,
}

impl AssemblyDrawing {
    /// Proves every cam, as R2000.
    ///
    /// # Errors
    /// As [`Drawing::prove`].
    pub fn prove(self) -> Result<ProvenAssembly, Error> {
        self.prove_as(Version::default())
    }

    /// As [`AssemblyDrawing::prove`], in another version of DXF. The findings of the others are evidence for the first.
    ///
    /// # Errors
    /// As [`Drawing::prove`].
    pub fn prove_as(self, version: Version) -> Result<ProvenAssembly, Error> {
        let Self { first, name, others, joint_report } = self;
        let prove = |(name, drawing): &(String, Drawing)| Ok((name.clone(), drawing.clone().prove_as(version)?));
        let of_others = || parallel::map(&others, prove);
        let (written, proven) = parallel::both(|| first.written(version), (!others.is_empty()).then_some(of_others));
        let others: Vec<(String, Proven)> = proven.into_iter().flatten().collect::<Result<_, Error>>()?;
        let written = written?;
        let on_first = (first.body(), written.outlines());
        let measures =
            joint_report.as_ref().map_or_else(Vec::new, |joint_report| joint_report.measures(on_first, &others));
        let first = first.judged(written, &measures);
        Ok(ProvenAssembly { first, name, others, joint_report })
    }
}

/// Cams that were proved together.
#[derive(Debug, Clone)]
pub struct ProvenAssembly {
    first: Proven,
    name: &'static str,
    others: Vec<(String, Proven)>,
    joint_report: Option<Arc<dyn AssemblyReport>>,
}

impl From<Proven> for ProvenAssembly {
    /// One cam alone.
    fn from(first: Proven) -> Self {
        Self { first, name: "", others: Vec::new(), joint_report: None }
    }
}

impl ProvenAssembly {
    /// The cam that the others are made for.
    #[must_use]
    pub fn first(&self) -> &Proven {
        &self.first
    }

    /// The others, by name.
    #[must_use]
    pub fn others(&self) -> &[(String, Proven)] {
        &self.others
    }

    /// What the names of the files of the first cam have after the stem.
    pub(super) fn name(&self) -> &'static str {
        self.name
    }

    /// The report on all together, where there is one.
    pub(super) fn joint_report(&self) -> Option<&dyn AssemblyReport> {
        self.joint_report.as_deref()
    }

    pub(super) fn all(&self) -> impl Iterator<Item = &Proven> {
        std::iter::once(&self.first).chain(self.others.iter().map(|(_, cam)| cam))
    }

    /// What every check found of the first cam, that of the others among them.
    #[must_use]
    pub fn findings(&self) -> &[Finding] {
        self.first.findings()
    }

    /// Whether every cam has an outline and no check failed.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.all().all(Proven::passed)
    }

    /// The checks that failed, those of another cam after its name.
    pub(super) fn failed(&self) -> Vec<String> {
        let own = failed(self.findings()).into_iter().map(str::to_owned);
        let of = |(name, cam): &(String, Proven)| -> Vec<String> {
            failed(cam.findings()).into_iter().map(|check| format!("{name}: {check}")).collect()
        };
        own.chain(self.others.iter().flat_map(of)).collect()
    }

    /// The checks that the other cams fail, by their names.
    #[must_use]
    pub fn failures_of_others(&self) -> Vec<(&str, Vec<Finding>)> {
        let failed =
            |cam: &Proven| cam.findings().iter().filter(|finding| finding.verdict == Verdict::Fail).cloned().collect();
        self.others.iter().map(|(name, cam)| (name.as_str(), failed(cam))).collect()
    }

    /// What the checks of the other cams found, those of the written files only where they failed.
    fn other_checks(&self) -> Vec<Finding> {
        let of = |(name, cam): &(String, Proven)| -> Vec<Finding> {
            let told = |finding: &&Finding| !finding.is_as_cut || finding.verdict == Verdict::Fail;
            let named = |finding: &Finding| Finding { part: Some(name.clone()), fact: None, ..finding.clone() };
            cam.findings().iter().filter(told).map(named).collect()
        };
        self.others.iter().flat_map(of).collect()
    }

    /// Why there is no outline of a cam that has none.
    #[must_use]
    pub fn no_outline(&self) -> Option<&str> {
        self.all().find_map(Proven::no_outline)
    }

    /// The report of the first cam, with what all do together, without files.
    #[must_use]
    pub fn report(&self) -> Report {
        let report = self.first.report_with(self.joint_sections(), self.no_outline());
        Report { other_checks: self.other_checks(), ..report }
    }

    /// The sections of that report with these figures, by their paths; `None` for all.
    pub(crate) fn sections(&self, wanted: Option<&[String]>) -> Vec<Section> {
        self.first.sections(wanted).into_iter().chain(self.joint_sections()).collect()
    }

    fn joint_sections(&self) -> Vec<Section> {
        let sections = |joint_report: &Arc<dyn AssemblyReport>| joint_report.sections(&self.first, &self.others);
        self.joint_report.iter().flat_map(sections).collect()
    }

    /// The report, made when it is first read.
    #[must_use]
    pub fn lazy_report(&self) -> LazyReport {
        let whole = self.clone();
        LazyReport::new(Box::new(move || whole.report()))
    }

    /// The point table of the first cam, with what another does at its places.
    #[must_use]
    pub fn table(&self, samples: u32) -> Table {
        let other = self.others.first().map(|(_, other)| other.body());
        csv::table(self.first.body(), other, self.first.outlines(), samples)
    }
}

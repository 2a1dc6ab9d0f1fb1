//! Which of the sections of a conoid a file holds.

use super::tool_file::FileError;
use crate::body::{Body, Cut};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::refusal::Refusal;
use serde::Serialize;

/// File names give a speed with six digits: speeds that differ by less than half of the last digit are equal.
const SAME_SPEED: f64 = 5e-6;

/// The section of a conoid that a file should hold.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct CutSection {
    pub(crate) rpm: f64,
    z_mm: f64,
    /// Which of the cuts it is.
    #[serde(skip)]
    pub(crate) cut: usize,
    /// Its place in metres.
    #[serde(skip)]
    pub(crate) z: f64,
}

impl CutSection {
    /// That of a cut, where it is a section.
    fn of_cut(index: usize, cut: &Cut<'_>) -> Option<Self> {
        Some(Self { rpm: cut.rpm?, z_mm: MILLIMETRES * cut.z, cut: index, z: cut.z })
    }
}

/// The requested section, where there are sections.
///
/// # Errors
/// [`FileError::Section`] when there is no such section, or none is named of several.
pub(crate) fn section(body: &dyn Body, asked: Option<f64>) -> Result<Option<CutSection>, FileError> {
    let noun = body.kind().noun;
    let cuts = body.cuts();
    let sections = cuts.iter().enumerate().filter_map(|(index, cut)| CutSection::of_cut(index, cut));
    let all: Vec<CutSection> = sections.collect();
    if all.is_empty() {
        let what = format!("a {noun} has one outline for all its height, and no sections");
        let why = asked.map(|_| FileError::Section(Refusal::new(what).remedy("give no section")));
        return why.map_or(Ok(None), Err);
    }
    let known: Vec<String> = all.iter().map(|section| section.rpm.to_string()).collect();
    let known = known.join(", ");
    match (asked, all.as_slice()) {
        (None, [only]) => Ok(Some(*only)),
        (None, _) => {
            let refusal = Refusal::new(format!("a {noun} of several sections has a file for each"));
            Err(FileError::Section(refusal.remedy(format!("give one of {known} rpm"))))
        }
        (Some(rpm), _) => {
            let found = all.iter().find(|section| (section.rpm - rpm).abs() <= SAME_SPEED * rpm).copied();
            found.map(Some).ok_or_else(|| {
                let refusal = Refusal::new(format!("there is no section for {rpm} rpm"));
                FileError::Section(refusal.remedy(format!("give one of {known} rpm")))
            })
        }
    }
}

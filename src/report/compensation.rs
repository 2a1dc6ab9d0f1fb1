//! What a compensating cam does, for the report of the cam whose torque it takes.

use super::{Finding, OutlineMeasures, Rolled, Section, Verdict, shown};
use serde::Serialize;

/// The preload for another speed, and the torques there.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct PreloadAt {
    pub rpm: f64,
    pub preload_n: f64,
    pub torque_before_max_nm: f64,
    /// With the preload as it is.
    pub torque_unchanged_max_nm: f64,
    pub torque_after_max_nm: f64,
}

/// The section `compensator`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct Compensation {
    pub lift_max_mm: f64,
    pub prime_radius_mm: f64,
    pub base_radius_mm: f64,
    pub roller_radius_mm: f64,
    /// Where its follower stands, from the first one in the sense of the cam angle.
    pub angle_deg: f64,
    /// What its spring takes up and gives back.
    pub work_j: f64,
    pub spring_force_max_n: f64,
    pub torque_before_max_nm: f64,
    /// By the law: rounding, or the inertia of its follower.
    pub torque_after_max_nm: f64,
    /// Of both discs together, by the normals where the followers touch the written outlines.
    pub torque_as_cut_max_nm: Option<f64>,
    pub preload_by_rpm: Vec<PreloadAt>,
    pub outline: Option<OutlineMeasures>,
    pub rolling: Option<Rolled>,
    /// Every check of the second disc.
    pub checks: Vec<Finding>,
}

impl Compensation {
    /// The section.
    #[must_use]
    pub fn section(&self) -> Section {
        let as_cut = self.torque_as_cut_max_nm.map_or(String::new(), |torque| {
            let share = 100.0 * torque / self.torque_before_max_nm;
            format!(", as cut {} N·m ({} %)", shown(torque), shown(share))
        });
        let mut words = vec![
            format!(
                "second disc: prime radius {} mm, lift {:.3} mm, roller {} mm, follower at {}°",
                shown(self.prime_radius_mm),
                self.lift_max_mm,
                shown(self.roller_radius_mm),
                shown(self.angle_deg)
            ),
            format!(
                "torque on the camshaft {:.2} N·m without, {:.1e} N·m with it by the law{as_cut}",
                self.torque_before_max_nm, self.torque_after_max_nm
            ),
            format!("its spring stores {:.2} J, at most {:.0} N", self.work_j, self.spring_force_max_n),
        ];
        words.extend(self.preload_by_rpm.iter().map(|at| {
            format!(
                "{} rpm, column reset: {:.1} N·m without, {:.1} N·m with it, {:.1} N·m with a preload of {:.0} N",
                shown(at.rpm),
                at.torque_before_max_nm,
                at.torque_unchanged_max_nm,
                at.torque_after_max_nm,
                at.preload_n
            )
        }));
        let told = self.checks.iter().filter(|finding| matches!(finding.verdict, Verdict::Fail | Verdict::Warn));
        words.extend(told.map(|finding| {
            let limit = finding.limit_words().map_or(String::new(), |limit| format!(", {limit}"));
            let note = finding.note.as_ref().map_or(String::new(), |note| format!("; {note}"));
            format!("{} {} {}{limit}{note}", finding.verdict.word(), finding.check, finding.value_words())
        }));
        let figures = vec![format!("compensating cam: torque {:.1} N·m without", self.torque_before_max_nm)];
        Section::new("compensator", self).with_words(words).with_figures(figures)
    }
}

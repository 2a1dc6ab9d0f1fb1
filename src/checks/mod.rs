//! What a cam must keep: a check takes the cam and says value, limit and place, also when it passes.
//!
//! A new check is one file and one line in [`CHECKS`].

pub mod balance;
pub mod conoid;
mod contact_stress;
mod curvature;
mod cutter_radius;
pub mod file;
mod force_closure;
mod plate;
mod pressure_angle;
pub mod rolling;
pub mod surface;
mod tangency;
mod wall;

use crate::cam::{Cam, Place};
use crate::contour::Contour;
use balance::Balancing;
use nalgebra::Vector2;
use rolling::Rolled;
use serde::Serialize;

/// What came of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The limit is kept.
    Pass,
    /// The limit is broken.
    Fail,
    /// There is no limit.
    Info,
}

/// The result of a check.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// Name of the check.
    pub check: &'static str,
    /// What was found; `None` when there is nothing to measure (no concave part, say).
    #[serde(serialize_with = "finite")]
    pub value: f64,
    /// What it must keep, if anything.
    pub limit: Option<f64>,
    /// Unit of both.
    pub unit: &'static str,
    /// The worst place.
    #[serde(flatten)]
    pub place: Place,
    /// The verdict.
    pub verdict: Verdict,
    /// What would help, or what the figure means.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

/// JSON has no infinity.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature serde asks for")]
fn finite<S: serde::Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    if value.is_finite() { serializer.serialize_f64(*value) } else { serializer.serialize_none() }
}

/// What is checked.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// The cam.
    pub cam: &'a dyn Cam,
    /// Its outline, when it has one.
    pub outline: Option<&'a Contour>,
    /// What rolling on the outline has shown, when it was rolled on.
    pub rolled: Option<&'a Rolled>,
    /// What balancing came to, when it was asked for.
    pub balancing: Option<&'a Balancing>,
    /// Tolerance of the outline, mm.
    pub tolerance_mm: f64,
}

type Check = fn(&Subject<'_>) -> Option<Finding>;

/// Every check, in the order of the report. `None` is a check that the machine file does not ask for.
pub const CHECKS: &[Check] = &[
    pressure_angle::check,
    curvature::undercut,
    curvature::min_convex_radius,
    cutter_radius::check,
    wall::check,
    plate::roller_clearance,
    plate::ends,
    tangency::check,
    rolling::check,
    force_closure::check,
    contact_stress::check,
    balance::check,
];

/// Runs every check.
#[must_use]
pub fn run(subject: &Subject<'_>) -> Vec<Finding> {
    CHECKS.iter().filter_map(|check| check(subject)).collect()
}

/// Whether nothing failed.
#[must_use]
pub fn passed(findings: &[Finding]) -> bool {
    findings.iter().all(|finding| finding.verdict != Verdict::Fail)
}

fn verdict(kept: bool) -> Verdict {
    if kept { Verdict::Pass } else { Verdict::Fail }
}

/// Where a place of the drawing (mm) lies on the cam.
fn place(cam: &dyn Cam, point: Vector2<f64>) -> Place {
    cam.place(cam.parameter_at(point * 1e-3))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cam::rotary::Rotary;
    use crate::drawing;
    use crate::machine::Machine;

    fn findings(name: &str, overrides: &[&str]) -> Vec<Finding> {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        let machine = Machine::load(name, &overrides).expect("valid").0;
        let rotary = Rotary::solve(&machine, machine.design_rpm).expect("a cam");
        let part = drawing::part(&rotary, 5e-6).ok();
        let outline = part.as_ref().map(|part| &part.outline.contour);
        let balancing = part.as_ref().and_then(|part| part.balancing.as_ref());
        let rolled = outline.map(|outline| rolling::roll(&rotary, outline, 0.005));
        run(&Subject { cam: &rotary, outline, rolled: rolled.as_ref(), balancing, tolerance_mm: 0.005 })
    }

    fn of<'f>(findings: &'f [Finding], check: &str) -> &'f Finding {
        findings.iter().find(|f| f.check == check).unwrap_or_else(|| panic!("no {check} in {findings:?}"))
    }

    /// One good and one broken cam for each check.
    #[test]
    fn each_check_passes_a_good_cam_and_fails_a_broken_one() {
        let good = findings("dpi", &[]);
        assert!(passed(&good), "{good:?}");
        for (check, overrides) in [
            ("pressure_angle", vec!["cam.base_radius=60mm"]),
            ("undercut", vec!["cam.base_radius=30mm", "follower.roller.radius=80mm"]),
            ("min_convex_radius", vec!["cam.base_radius=30mm"]),
            ("cutter_radius", vec!["buffer.column=return", "limits.cutter_radius=900mm"]),
            ("wall", vec!["cam.base_radius=69mm", "cam.bore_radius=65mm"]),
        ] {
            assert_eq!(of(&good, check).verdict, Verdict::Pass, "{check}");
            let broken = findings("dpi", &overrides);
            assert_eq!(of(&broken, check).verdict, Verdict::Fail, "{check}: {broken:?}");
            assert!(!passed(&broken));
        }
        // Checks that are run when their keys are given.
        let pressed =
            vec!["follower.roller.mass=40kg", "follower.roller.preload=1600N", "limits.contact_stress=2000MPa"];
        let light = ["cam.lever=0.15", "cam.base_radius=90mm", "cam.balance=40mm .. 85mm"];
        for (check, good, bad) in [
            ("force_closure", pressed.clone(), "follower.roller.preload=1500N"),
            ("contact_stress", pressed, "limits.contact_stress=900MPa"),
            ("balance", light.to_vec(), "cam.balance=80mm .. 81mm"),
        ] {
            assert_eq!(of(&findings("dpi", &good), check).verdict, Verdict::Pass, "{check}");
            let bad = [&good[..], &[bad]].concat();
            assert_eq!(of(&findings("dpi", &bad), check).verdict, Verdict::Fail, "{check}");
        }
        assert_eq!(of(&good, "force_closure").verdict, Verdict::Info);
        for check in ["tangency", "rolling"] {
            assert_eq!(of(&good, check).verdict, Verdict::Pass, "{check}: {good:?}");
        }
    }

    #[test]
    fn a_refusal_names_what_would_pass() {
        let refused = findings("dpi-paper", &["cam.base_radius=200mm"]);
        let finding = of(&refused, "pressure_angle");
        assert_eq!(finding.verdict, Verdict::Fail);
        assert!(finding.value > 60.0 && finding.limit == Some(30.0), "{finding:?}");
        let note = finding.note.as_deref().expect("a note");
        let base = note.strip_prefix("a base radius of ").and_then(|n| n.strip_suffix(" would pass")).expect(note);
        let passing = findings("dpi-paper", &[&format!("cam.base_radius={base}")]);
        assert!(passed(&passing), "{base}: {passing:?}");
    }

    #[test]
    fn a_concave_corner_limits_the_cutter_to_the_roller() {
        let corner = findings("dpi", &["buffer.column=return", "transition.kind=none"]);
        assert!((of(&corner, "cutter_radius").value - 30.0).abs() < 1e-9);
        let convex = findings("dpi", &["buffer.column=200mm", "transition.kind=none"]);
        assert_eq!(of(&convex, "undercut").verdict, Verdict::Fail);
    }
}

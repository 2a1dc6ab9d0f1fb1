//! Whether the roller stays on the cam: air, preload and the inertia of the follower, all round.

use super::{Finding, Subject, Verdict, verdict};
use crate::cam::{Place, extremes};
use crate::machine::RollerData;

pub(super) fn check(subject: &Subject<'_>) -> Option<Finding> {
    let (cam, curves) = (subject.cam, subject.cam.curves());
    let roller = cam.machine().roller;
    if !told(&roller) {
        return Some(not_run());
    }
    let away = |piece: usize, at: f64| cam.closing_force(piece, at).map_or(f64::NAN, |force| -force);
    let least = extremes::largest_without_slope(&curves, away);
    Some(finding(-least.value, &roller, cam.place(least.at)))
}

/// Whether the machine file tells what beside the air presses the roller on.
pub(super) fn told(roller: &RollerData) -> bool {
    roller.mass.is_some() || roller.preload.is_some()
}

pub(super) fn not_run() -> Finding {
    Finding {
        check: "force_closure",
        value: f64::NAN,
        limit: None,
        unit: "N",
        place: Place::default(),
        verdict: Verdict::Info,
        note: Some("not run: neither follower.roller.mass nor follower.roller.preload is given".into()),
    }
}

/// The verdict on the least force along the roller's path, N.
pub(super) fn finding(force: f64, roller: &RollerData, place: Place) -> Finding {
    let kept = force > 0.0;
    let needed = (roller.preload.unwrap_or(0.0) - force).ceil() + 1.0;
    let note =
        (!kept).then(|| format!("the roller leaves the cam; follower.roller.preload = \"{needed} N\" would hold it"));
    Finding { check: "force_closure", value: force, limit: Some(0.0), unit: "N", place, verdict: verdict(kept), note }
}

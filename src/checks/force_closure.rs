//! Whether the roller stays on the cam: air, preload and the inertia of the follower, all round.

use super::{Finding, Subject, Verdict, verdict};
use crate::cam::{Place, extremes};

pub(super) fn check(subject: &Subject<'_>) -> Option<Finding> {
    let (cam, curves) = (subject.cam, subject.cam.curves());
    let force = |piece: usize, parameter: f64| cam.closing_force(piece, parameter);
    if force(0, curves.law.range().0).is_none() {
        return Some(Finding {
            check: "force_closure",
            value: f64::NAN,
            limit: None,
            unit: "N",
            place: Place::default(),
            verdict: Verdict::Info,
            note: Some("not run: neither follower.roller.mass nor follower.roller.preload is given".into()),
        });
    }
    let least = extremes::largest_without_slope(&curves, |piece, at| force(piece, at).map_or(f64::NAN, |force| -force));
    let force = -least.value;
    let kept = force > 0.0;
    let needed = (cam.machine().roller.preload.unwrap_or(0.0) - force).ceil() + 1.0;
    Some(Finding {
        check: "force_closure",
        value: force,
        limit: Some(0.0),
        unit: "N",
        place: cam.place(least.at),
        verdict: verdict(kept),
        note: (!kept)
            .then(|| format!("the roller leaves the cam; follower.roller.preload = \"{needed} N\" would hold it")),
    })
}

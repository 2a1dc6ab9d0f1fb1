//! Whether the roller stays on the cam: air, preload and the inertia of the follower, all round.

use super::{Finding, Subject, Verdict, cam_degrees, verdict};
use crate::cam::extremes;

pub(super) fn check(subject: &Subject<'_>) -> Option<Finding> {
    let rotary = subject.rotary;
    let roller = rotary.machine.roller;
    if roller.mass.is_none() && roller.preload.is_none() {
        return Some(Finding {
            check: "force_closure",
            value: f64::NAN,
            limit: None,
            unit: "N",
            cam_deg: None,
            verdict: Verdict::Info,
            note: Some("not run: neither follower.roller.mass nor follower.roller.preload is given".into()),
        });
    }
    let least = extremes::largest_without_slope(&rotary.disc, |piece, angle| -rotary.roller_force(piece, angle));
    let force = -least.value;
    let kept = force > 0.0;
    let needed = (roller.preload.unwrap_or(0.0) - force).ceil() + 1.0;
    Some(Finding {
        check: "force_closure",
        value: force,
        limit: Some(0.0),
        unit: "N",
        cam_deg: Some(cam_degrees(least.at)),
        verdict: verdict(kept),
        note: (!kept)
            .then(|| format!("the roller leaves the cam; follower.roller.preload = \"{needed} N\" would hold it")),
    })
}

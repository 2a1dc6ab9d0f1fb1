//! Whether the roller stays on the cam: air, preload and the inertia of the follower, all round.

use super::{Finding, Subject, Verdict, cam_degrees, verdict};
use crate::cam::rotary::Rotary;
use crate::law::Law;
use crate::numeric::extremum::{self, Extremum};

/// Cells of a piece, and golden sections, in which the force is searched: it is smooth with a hump or two.
const CELLS: u32 = 48;
const SECTIONS: u32 = 30;

/// Largest value over the turn of something that depends on the cam angle of a piece.
pub(super) fn largest(rotary: &Rotary, value: impl Fn(usize, f64) -> f64) -> Extremum {
    let pieces = rotary.disc.law.pieces();
    let of_piece = |(index, piece): (usize, &crate::law::Piece)| {
        let (cells, sections) = if piece.dwell { (1, 0) } else { (CELLS, SECTIONS) };
        extremum::largest_without_slope(|angle| value(index, angle), (piece.start, piece.end), cells, sections)
    };
    pieces.iter().enumerate().map(of_piece).fold(Extremum { at: 0.0, value: f64::NEG_INFINITY }, |best, next| {
        if next.value > best.value { next } else { best }
    })
}

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
    let least = largest(rotary, |piece, angle| -rotary.roller_force(piece, angle));
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

//! The metal between the profile of a disc and the keyway in its bore.

use super::Disc;
use crate::machine::Keyway;
use camgen_kernel::numeric::extremum;
use camgen_kernel::profile::Worst;

/// Cells of a piece in which its nearest place is searched, and golden sections: past a slot a profile comes near once or twice.
const CELLS: u32 = 48;
const SECTIONS: u32 = 60;

/// The least distance of the profile from the slot, m, negative within it, and its place; `None` without a bore.
pub(super) fn nearest(disc: &Disc, keyway: Keyway) -> Option<Worst> {
    let (bottom, half) = (disc.machine.cam.bore_radius? + keyway.depth, 0.5 * keyway.width);
    let (sin, cos) = (libm::sin(keyway.angle), libm::cos(keyway.angle));
    let curves = disc.curves();
    let distance = |piece: usize, angle: f64| {
        let point = curves.profile(piece, angle).point;
        let along = cos * point.x + sin * point.y;
        let across = (cos * point.y - sin * point.x).abs();
        // Beyond the bottom and a side of the slot, which begins in the middle of the bore.
        let [out, aside] = [along - bottom, across - half];
        match (out > 0.0, aside > 0.0, along > 0.0) {
            (true, true, _) => libm::hypot(out, aside),
            (_, _, true) => out.max(aside),
            _ => libm::hypot(along, aside.max(0.0)),
        }
    };
    let pieces = curves.motion.pieces().iter().enumerate();
    let of_piece = |(index, piece): (usize, &camgen_kernel::motion::Piece)| {
        let range = (piece.start, piece.end);
        extremum::largest_without_slope(|angle| -distance(index, angle), range, CELLS, SECTIONS)
    };
    let best = pieces.map(of_piece).reduce(|best, next| if next.value > best.value { next } else { best })?;
    Some(Worst { value: -best.value, at: best.at, z: 0.0 })
}

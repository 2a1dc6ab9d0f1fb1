//! How much is read: work and memory grow with the content of a file, and no cam needs as much as these limits.
//!
//! With these a file is read and rolled on within some two seconds and 512 MiB, whatever it contains; what exceeds them is reported
//! before the work is done. The largest cam files of practice have some ten thousand segments.

use super::too_much;
use camgen_kernel::refusal::Refusal;

/// Largest file, bytes.
pub const LARGEST_FILE: u64 = 128 << 20;
/// Arcs, lines and curves once blocks are resolved.
pub const MOST_SEGMENTS: usize = 200_000;
/// Groups that are used, and sections: a segment has some ten.
pub(super) const MOST_GROUPS: usize = 4_000_000;
/// Longest value, bytes: a line of a DXF file has at most this many characters.
pub(super) const LONGEST_VALUE: usize = 2048;
/// Layers, and blocks.
pub(super) const MOST_NAMES: usize = 100_000;
/// Entities examined once blocks are resolved.
pub(super) const MOST_ENTITIES: usize = 1_000_000;
/// Groups examined once blocks are resolved.
const MOST_VISITED: usize = 20_000_000;
/// Coefficients of curves that are converted to arcs.
const MOST_COEFFICIENTS: usize = 10_000_000;
/// Segments near another one that are compared with it.
const MOST_COMPARED: usize = 30_000_000;
/// An outline with more segments than these may be at most this many times longer than its size: in a tangle every part lies near all others.
const MANY_SEGMENTS: usize = 2_000;
const LONGEST_SHARE: f64 = 200.0;

/// The work done so far, each kind against its limit.
#[derive(Debug, Default)]
pub(super) struct WorkCount {
    segments: usize,
    entities: usize,
    visited: usize,
    coefficients: usize,
    compared: usize,
}

/// Adds to a count that has a limit.
fn count(counted: &mut usize, more: usize, what: &'static str, most: usize) -> Result<(), Refusal> {
    *counted = counted.saturating_add(more);
    if *counted > most { Err(too_much(what, most)) } else { Ok(()) }
}

impl WorkCount {
    pub(super) fn segments(&mut self, more: usize) -> Result<(), Refusal> {
        count(&mut self.segments, more, "segments", MOST_SEGMENTS)
    }

    /// Refuses a count that would be too large, without counting it.
    pub(super) fn check_room(&self, more: usize) -> Result<(), Refusal> {
        count(&mut self.segments.clone(), more, "segments", MOST_SEGMENTS)
    }

    /// An entity with its groups.
    pub(super) fn entity(&mut self, groups: usize) -> Result<(), Refusal> {
        count(&mut self.entities, 1, "entities with those of inserted blocks", MOST_ENTITIES)?;
        count(&mut self.visited, groups, "values with those of inserted blocks", MOST_VISITED)
    }

    /// A piece of a curve with this many poles that is converted to arcs.
    pub(super) fn piece(&mut self, poles: usize) -> Result<(), Refusal> {
        count(&mut self.coefficients, poles * poles, "coefficients of curves", MOST_COEFFICIENTS)
    }

    /// Segments that are compared with another.
    pub(super) fn compared(&mut self, more: usize) -> Result<(), Refusal> {
        count(&mut self.compared, more, "pairs of segments that lie within the reach of each other", MOST_COMPARED)
    }
}

/// Refuses an outline of many segments that is a tangle.
pub(super) fn check_length(segments: usize, length: f64, size: f64) -> Result<(), Refusal> {
    if segments <= MANY_SEGMENTS || length <= LONGEST_SHARE * size {
        return Ok(());
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a quotient of lengths, for a message")]
    let times = (length / size) as u64;
    Err(Refusal::new(format!(
        "not the outline of a cam: its {segments} segments are together {times} times as long as the outline is wide"
    ))
    .remedy("an outline goes round once"))
}

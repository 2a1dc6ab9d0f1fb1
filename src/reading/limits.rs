//! How much is read: work and memory grow with what a file holds, and no cam needs as much.
//!
//! With these a file is read and rolled on within some two seconds and 512 MiB, whatever it holds; what is beyond them is told before
//! the work is done. The largest cam files of practice have some ten thousand segments.

use super::ReadError;

/// Largest file, bytes.
pub const LARGEST_FILE: u64 = 128 << 20;
/// Arcs, lines and curves once blocks are resolved.
pub const MOST_SEGMENTS: usize = 200_000;
/// Groups with a meaning, and sections: a segment has some ten.
pub(super) const MOST_GROUPS: usize = 4_000_000;
/// Longest value, bytes: a line of a DXF file has at most so many characters.
pub(super) const LONGEST_VALUE: usize = 2048;
/// Layers, and blocks.
pub(super) const MOST_NAMES: usize = 100_000;
/// Entities that are looked at once blocks are resolved.
pub(super) const MOST_ENTITIES: usize = 1_000_000;
/// Groups that are looked at once blocks are resolved.
const MOST_VISITED: usize = 20_000_000;
/// Coefficients of curves that are laid out as arcs.
const MOST_COEFFICIENTS: usize = 10_000_000;
/// Segments near another one that are compared with it.
const MOST_COMPARED: usize = 30_000_000;
/// An outline of more segments than these is no longer than so many times its size: all of a tangle lies near all the rest.
const MANY_SEGMENTS: usize = 10_000;
const LONGEST_SHARE: f64 = 200.0;

/// What has been done so far, each kind of work against its limit.
#[derive(Debug, Default)]
pub(super) struct Effort {
    segments: usize,
    entities: usize,
    visited: usize,
    coefficients: usize,
    compared: usize,
}

/// Adds to a count that has a limit.
fn count(counted: &mut usize, more: usize, what: &'static str, most: usize) -> Result<(), ReadError> {
    *counted = counted.saturating_add(more);
    if *counted > most { Err(ReadError::TooMuch { what, most }) } else { Ok(()) }
}

impl Effort {
    pub(super) fn segments(&mut self, more: usize) -> Result<(), ReadError> {
        count(&mut self.segments, more, "segments", MOST_SEGMENTS)
    }

    /// Refuses what would be too many, without counting it.
    pub(super) fn has_room(&self, more: usize) -> Result<(), ReadError> {
        count(&mut self.segments.clone(), more, "segments", MOST_SEGMENTS)
    }

    /// An entity with its groups.
    pub(super) fn entity(&mut self, groups: usize) -> Result<(), ReadError> {
        count(&mut self.entities, 1, "entities with those of inserted blocks", MOST_ENTITIES)?;
        count(&mut self.visited, groups, "values with those of inserted blocks", MOST_VISITED)
    }

    /// A piece of a curve with so many poles that is laid out as arcs.
    pub(super) fn piece(&mut self, poles: usize) -> Result<(), ReadError> {
        count(&mut self.coefficients, poles * poles, "coefficients of curves", MOST_COEFFICIENTS)
    }

    /// Segments that are compared with another.
    pub(super) fn compared(&mut self, more: usize) -> Result<(), ReadError> {
        count(&mut self.compared, more, "pairs of segments that lie within the reach of each other", MOST_COMPARED)
    }
}

/// Refuses an outline of many segments that is a tangle.
pub(super) fn no_tangle(segments: usize, length: f64, size: f64) -> Result<(), ReadError> {
    if segments <= MANY_SEGMENTS || length <= LONGEST_SHARE * size {
        return Ok(());
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a quotient of lengths, to be told")]
    Err(ReadError::Tangle { segments, times: (length / size) as u64 })
}

//! Rows of a study on all processors, in their order.

use super::specification::Study;
use camgen_kernel::numeric::parallel;

/// Rows that one thread makes at a time: of solved cams, and of proved ones.
const BLOCK: [u64; 2] = [8, 1];
/// Blocks between two writes: enough that all processors are busy to the end of them.
const BLOCKS: u64 = 256;

impl Study {
    fn block(&self) -> u64 {
        BLOCK[usize::from(self.proves())]
    }

    /// The lines of the rows from `start` up to and without `end`; no line beyond the last row. Each depends on the study and on its number
    /// alone.
    #[must_use]
    pub fn rows(&self, start: u64, end: u64) -> Vec<u8> {
        let (end, block) = (end.min(self.count()), self.block());
        let starts: Vec<u64> = (start..end).step_by(usize::try_from(block).unwrap_or(1)).collect();
        let lines = parallel::map(&starts, |from| {
            let mut out = Vec::new();
            (*from..(from + block).min(end)).for_each(|row| self.write_row(row, &mut out));
            out
        });
        lines.concat()
    }

    /// Hands on the lines from a row to the last one, in their order, a stretch at a time; what is in memory does not grow with their number.
    ///
    /// # Errors
    /// The first one of `take`, which is given the number of rows done and their lines.
    pub fn each<E>(&self, start: u64, mut take: impl FnMut(u64, &[u8]) -> Result<(), E>) -> Result<(), E> {
        let stretch = BLOCKS * self.block();
        let mut from = start;
        while from < self.count() {
            let end = (from + stretch).min(self.count());
            take(end, &self.rows(from, end))?;
            from = end;
        }
        Ok(())
    }
}

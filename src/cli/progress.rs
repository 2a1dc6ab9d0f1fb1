//! Progress of long work at a terminal: on stderr, after half a second, removed when the work ends.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::thread;
use std::time::Duration;

/// Shorter work shows nothing.
const PATIENCE: Duration = Duration::from_millis(500);
/// Period between updates of the line.
const TICK: Duration = Duration::from_millis(100);

/// The stage of the work, or how much of it is done. Nothing is shown without a terminal.
#[derive(Debug)]
pub(super) struct Progress(ProgressBar);

impl Progress {
    /// Progress through stages.
    pub(super) fn of_stages(shown: bool) -> Self {
        Self::new(shown, None, "{spinner} {msg} {elapsed}")
    }

    /// Progress through a number of steps.
    pub(super) fn of_steps(shown: bool, steps: usize) -> Self {
        Self::new(shown, Some(steps as u64), "{bar:32} {pos}/{len} {elapsed}")
    }

    /// Progress through rows of which some are done, with the rate and the time that is left.
    pub(super) fn of_rows(shown: bool, rows: u64, done: u64) -> Self {
        let progress = Self::new(shown, Some(rows), "{bar:32} {pos}/{len} {per_sec} {eta} left");
        progress.0.set_position(done);
        progress.0.reset_eta();
        progress
    }

    /// So many rows are done.
    pub(super) fn reached(&self, done: u64) {
        self.0.set_position(done);
    }

    fn new(shown: bool, steps: Option<u64>, template: &str) -> Self {
        let bar = ProgressBar::with_draw_target(steps, ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.tick_chars("|/-\\ ").progress_chars("##-"));
        }
        let patient = bar.downgrade();
        let show = move || {
            thread::sleep(PATIENCE);
            if let Some(bar) = patient.upgrade() {
                bar.set_draw_target(ProgressDrawTarget::stderr());
                bar.enable_steady_tick(TICK);
            }
        };
        if shown {
            // Without a thread nothing is shown, and the work goes on.
            _ = thread::Builder::new().spawn(show);
        }
        Self(bar)
    }

    /// The next stage.
    pub(super) fn stage(&self, name: &'static str) {
        self.0.set_message(name);
    }

    /// A step is done.
    pub(super) fn step(&self) {
        self.0.inc(1);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

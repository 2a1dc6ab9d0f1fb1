//! What a person at a terminal sees of work that takes long: on stderr, from half a second on, gone when it ends.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::Duration;

/// Work that is done sooner shows nothing.
const PATIENCE: Duration = Duration::from_millis(500);
/// The spinner turns so often.
const TICK: Duration = Duration::from_millis(100);

/// The stage of the work, or how much of it is done. Nobody is shown anything where there is no terminal.
#[derive(Debug, Default)]
pub(super) struct Progress(Option<Shown>);

#[derive(Debug)]
struct Shown {
    bar: ProgressBar,
    done: Sender<()>,
    waiting: Option<JoinHandle<()>>,
}

impl Progress {
    /// Of stages.
    pub(super) fn of_stages(shown: bool) -> Self {
        Self(shown.then(|| Shown::new(ProgressBar::new_spinner(), "{spinner} {msg} {elapsed}")))
    }

    /// Of so many steps.
    pub(super) fn of_steps(shown: bool, steps: usize) -> Self {
        let steps = u64::try_from(steps).unwrap_or(u64::MAX);
        Self(shown.then(|| Shown::new(ProgressBar::new(steps), "{bar:32} {pos}/{len} {msg} {elapsed}")))
    }

    /// The next stage.
    pub(super) fn stage(&self, name: &'static str) {
        if let Some(shown) = &self.0 {
            shown.bar.set_message(name);
        }
    }

    /// A step is done.
    pub(super) fn step(&self) {
        if let Some(shown) = &self.0 {
            shown.bar.inc(1);
        }
    }
}

impl Shown {
    fn new(bar: ProgressBar, template: &str) -> Self {
        bar.set_draw_target(ProgressDrawTarget::hidden());
        // A template that is not one would leave the usual style.
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        let (done, ended) = mpsc::channel();
        let shown = bar.clone();
        let wait = move || {
            if ended.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                shown.enable_steady_tick(TICK);
            }
        };
        let waiting = std::thread::Builder::new().spawn(wait).ok();
        Self { bar, done, waiting }
    }
}

impl Drop for Shown {
    fn drop(&mut self) {
        // Whoever waits may have begun to show it.
        let _ = self.done.send(());
        if let Some(waiting) = self.waiting.take() {
            let _ = waiting.join();
        }
        self.bar.finish_and_clear();
    }
}

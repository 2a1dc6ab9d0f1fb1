//! What a person at a terminal sees of work that takes long: on stderr, from half a second on, gone when it ends.

use std::io::Write;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Work that is done sooner shows nothing.
const PATIENCE: Duration = Duration::from_millis(500);
/// The line is written anew so often.
const TICK: Duration = Duration::from_millis(100);
/// The sign before the stage turns.
const TURNS: [char; 4] = ['|', '/', '-', '\\'];
/// Width of the bar of work that has steps, in characters.
const BAR: usize = 32;
/// Takes the cursor to the start of its line and clears the line (ECMA-48, EL).
const CLEAR: &str = "\r\x1b[K";

/// The stage of the work, or how much of it is done. Nobody is shown anything where there is no terminal.
#[derive(Debug, Default)]
pub(super) struct Progress(Option<Shown>);

/// How far the work is.
#[derive(Debug, Default)]
struct State {
    stage: &'static str,
    /// Steps that are done, and all of them, where it has steps.
    steps: Option<(usize, usize)>,
}

#[derive(Debug)]
struct Shown {
    state: Arc<Mutex<State>>,
    done: Sender<()>,
    showing: Option<JoinHandle<()>>,
}

impl Progress {
    /// Of stages.
    pub(super) fn of_stages(shown: bool) -> Self {
        Self(shown.then(|| Shown::new(State::default())))
    }

    /// Of so many steps.
    pub(super) fn of_steps(shown: bool, steps: usize) -> Self {
        Self(shown.then(|| Shown::new(State { stage: "", steps: Some((0, steps)) })))
    }

    /// The next stage.
    pub(super) fn stage(&self, name: &'static str) {
        self.change(|state| state.stage = name);
    }

    /// A step is done.
    pub(super) fn step(&self) {
        self.change(|state| state.steps = state.steps.map(|(done, all)| (done + 1, all)));
    }

    fn change(&self, change: impl FnOnce(&mut State)) {
        if let Some(Ok(mut state)) = self.0.as_ref().map(|shown| shown.state.lock()) {
            change(&mut state);
        }
    }
}

impl State {
    fn line(&self, tick: usize, elapsed: Duration) -> String {
        let seconds = elapsed.as_secs();
        match self.steps {
            Some((done, all)) => {
                let filled = (BAR * done.min(all)).checked_div(all).unwrap_or(BAR);
                let bar = "#".repeat(filled) + &"-".repeat(BAR - filled);
                format!("{bar} {done}/{all} {seconds} s")
            }
            None => format!("{} {} {seconds} s", TURNS[tick % TURNS.len()], self.stage),
        }
    }
}

impl Shown {
    fn new(state: State) -> Self {
        let state = Arc::new(Mutex::new(state));
        let (done, ended) = mpsc::channel();
        let told = Arc::clone(&state);
        let begun = Instant::now();
        let show = move || {
            let mut wait = PATIENCE;
            let mut ticks = 0;
            // A terminal that takes no more is none.
            while ended.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                let Ok(line) = told.lock().map(|state| state.line(ticks, begun.elapsed())) else { break };
                let _ = write!(std::io::stderr(), "{CLEAR}{line}");
                (wait, ticks) = (TICK, ticks + 1);
            }
            if ticks > 0 {
                let _ = write!(std::io::stderr(), "{CLEAR}");
            }
        };
        let showing = std::thread::Builder::new().spawn(show).ok();
        Self { state, done, showing }
    }
}

impl Drop for Shown {
    fn drop(&mut self) {
        // Whoever shows it may have ended before.
        let _ = self.done.send(());
        if let Some(showing) = self.showing.take() {
            let _ = showing.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_tells_stage_steps_and_seconds() {
        let elapsed = Duration::from_millis(2900);
        assert_eq!(State { stage: "drawing", steps: None }.line(5, elapsed), "/ drawing 2 s");
        let at = |done, all| State { stage: "", steps: Some((done, all)) }.line(0, elapsed);
        assert_eq!(at(1, 4), format!("{}{} 1/4 2 s", "#".repeat(8), "-".repeat(24)));
        assert_eq!(at(5, 4), format!("{} 5/4 2 s", "#".repeat(32)));
        assert_eq!(at(0, 0), format!("{} 0/0 2 s", "#".repeat(32)));
    }
}

//! With what a program cuts: its tool, the radius that the control takes, the spindle and the feed.

/// How the spindle turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Spindle {
    /// The program does not say: it is started by hand, or at a speed that was set before.
    #[default]
    Unstated,
    /// It stands: M5, or a speed of 0.
    Stopped,
    /// Clockwise: M3.
    Clockwise,
    /// Counter-clockwise: M4.
    CounterClockwise,
}

impl Spindle {
    /// What a word of a program makes of a spindle: M3, M4, M5; `None` for other words.
    pub(super) fn of(number: f64) -> Option<Self> {
        let ways = [(3.0, Self::Clockwise), (4.0, Self::CounterClockwise), (5.0, Self::Stopped)];
        ways.iter().find(|(word, _)| *word == number).map(|(_, way)| *way)
    }

    /// The same at a speed: at 0 it stands, and without any the program does not say how fast.
    pub(super) fn at(self, speed: Option<f64>) -> Self {
        match (self, speed) {
            (Self::Clockwise | Self::CounterClockwise, Some(0.0)) => Self::Stopped,
            (Self::Clockwise, None) => Self::Unstated,
            (way, _) => way,
        }
    }
}

/// The length of the tool that the control takes into account.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ToolLength {
    /// The program does not say.
    #[default]
    Unstated,
    /// That with a number: H with G43, D on SINUMERIK.
    Number(u32),
    /// None: G49, H0, D0, or another tool was changed in since.
    Cancelled,
}

/// What holds while the tool cuts.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CuttingState {
    /// Number of the tool in the spindle; `None` where the program changes none in, or one with a name.
    pub tool: Option<u32>,
    /// Whether it was changed in by its name.
    pub named: bool,
    /// Whether the control keeps the cutter beside its path.
    pub compensated: bool,
    /// Number of the radius by which it does (D), where the program gives one.
    pub offset: Option<u32>,
    /// Which length of the tool the control takes into account.
    pub length: ToolLength,
    /// How the spindle turns.
    pub spindle: Spindle,
    /// Its speed, 1/min, where the program gives one.
    pub speed: Option<f64>,
}

/// The feed of a cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CuttingFeed {
    /// Line of the file.
    pub line: usize,
    /// How fast, mm/min.
    pub feed: f64,
    /// Whether it goes into the material rather than along the path.
    pub plunges: bool,
}

/// A whole number of a word, such as that of a tool.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number within its type")]
pub(super) fn whole(number: f64) -> Option<u32> {
    (number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number)).then_some(number as u32)
}

impl super::CutterProgram {
    /// Keeps the lowest Z of the machine, mm, to which the tool retracts.
    pub(super) fn retracts_to(&mut self, line: usize, z: f64) {
        if self.lowest_home.is_none_or(|(_, lowest)| z < lowest) {
            self.lowest_home = Some((line, z));
        }
    }

    /// Keeps the length with which the tool moves along Z, where it is another than before.
    pub(super) fn moves_with(&mut self, line: usize, length: ToolLength) {
        if self.lengths.last().is_none_or(|(_, last)| *last != length) {
            self.lengths.push((line, length));
        }
    }

    /// Keeps what holds during a cut, where it is another than before.
    pub(super) fn cuts_with(&mut self, line: usize, state: CuttingState, feed: CuttingFeed) {
        if self.states.last().is_none_or(|(_, last)| *last != state) {
            self.states.push((line, state));
        }
        let alike = |last: &CuttingFeed| last.feed == feed.feed && last.plunges == feed.plunges;
        if !self.feeds.last().is_some_and(alike) {
            self.feeds.push(feed);
        }
    }
}

//! Facts: the few lines of a summary, each with its topic, in the order in which a designer asks for them.

use camgen_kernel::text::Text;

/// What a line of a summary is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Topic {
    /// Its place among the others: smaller ones come first.
    pub order: u8,
    /// Its name at the start of the line.
    pub label: &'static str,
}

impl Topic {
    /// A topic; those of the core have the orders 10, 20, ….
    #[must_use]
    pub const fn new(order: u8, label: &'static str) -> Self {
        Self { order, label }
    }

    /// How large the part is, and what it weighs.
    pub const SIZE: Self = Self::new(10, "size");
    /// How far the follower moves.
    pub const LIFT: Self = Self::new(20, "lift");
    /// The segments of the motion.
    pub const MOTION: Self = Self::new(30, "motion");
    /// The largest velocity, acceleration and jerk.
    pub const PEAKS: Self = Self::new(40, "peaks");
    /// The forces on the follower.
    pub const FORCE: Self = Self::new(50, "force");
    /// The torque of the shaft.
    pub const TORQUE: Self = Self::new(60, "torque");
    /// The pressure between roller and cam.
    pub const STRESS: Self = Self::new(70, "stress");
    /// What holds the follower on the cam.
    pub const SPRING: Self = Self::new(80, "spring");
    /// The bearing of the roller.
    pub const ROLLER: Self = Self::new(90, "roller");
    /// What oscillates behind the follower.
    pub const VIBRATION: Self = Self::new(100, "vibration");
}

/// A line of a summary.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fact {
    /// What it is about. Facts of a topic stand in one line.
    pub topic: Topic,
    /// Its words.
    pub text: Text,
}

impl Fact {
    /// A fact about a topic.
    #[must_use]
    pub fn new(topic: Topic, text: impl Into<Text>) -> Self {
        Self { topic, text: text.into() }
    }
}

//! Why a linkage does not turn, and what would make it.

/// An open interval of lengths that would pass, to be printed; empty where no length does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passing {
    /// Every value must be above this.
    pub above: f64,
    /// And below this; infinite where nothing limits it.
    pub below: f64,
}

impl std::fmt::Display for Passing {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // To six digits, inwards.
        let (above, below) = ((1e6 * self.above).ceil() / 1e6, (1e6 * self.below + 1e-3).floor() / 1e6);
        if self.is_empty() {
            write!(f, "of no length at all")
        } else if self.below.is_infinite() {
            write!(f, "above {above}")
        } else if self.above <= 0.0 {
            write!(f, "below {below}")
        } else {
            write!(f, "between {above} and {below}")
        }
    }
}

impl Passing {
    fn is_empty(&self) -> bool {
        !(self.below > self.above)
    }
}

/// Each alone lets a drag link turn all the way round, the other two as given: all three inequalities hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Remedies {
    /// λ1.
    pub base: Passing,
    /// λ2.
    pub coupler: Passing,
    /// λ3.
    pub follower: Passing,
}

impl std::fmt::Display for Remedies {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let all = [("a base", self.base), ("a coupler", self.coupler), ("a follower", self.follower)];
        let lengths: Vec<String> = all
            .iter()
            .filter(|(_, passing)| !passing.is_empty())
            .map(|(name, passing)| format!("{name} {passing}"))
            .collect();
        f.write_str(&if lengths.is_empty() { "two other lengths at least".to_owned() } else { lengths.join(", or ") })
    }
}

/// Why a linkage cannot turn all the way round. Every length is a ratio, as in [`super::Slider`] and [`super::DragLink`].
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinkageError {
    /// A ratio or an angle is not a number, or a length is not positive.
    #[error("the {name} is {value}: it must be a finite number{}", if *length { " above 0 (a base may be 0)" } else { "" })]
    NotFinite {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Whether it is a length, which must be positive.
        length: bool,
    },
    /// λ5 > 1 + |λ6| does not hold: the rod does not let the crank through.
    #[error(
        "the rod is {rod_ratio} cranks long and its line passes {offset_ratio} cranks from the shaft: the rod ratio \
         must be above {least_rod}{}",
        if *largest_offset > 0.0 { format!(", or the offset ratio within ±{largest_offset}") } else { String::new() }
    )]
    RodTooShort {
        /// λ5.
        rod_ratio: f64,
        /// λ6.
        offset_ratio: f64,
        /// 1 + |λ6|: any longer rod passes.
        least_rod: f64,
        /// λ5 − 1: any smaller offset passes, if this is positive.
        largest_offset: f64,
    },
    /// λ1 < 1 does not hold: the base is not the shortest link.
    #[error("the base is {base} driving cranks long, and must be shorter than the crank: a base {passing} turns")]
    BaseTooLong {
        /// λ1.
        base: f64,
        /// λ1 that passes with the other links as they are.
        passing: Passing,
    },
    /// |λ2 − λ3| < 1 − λ1 does not hold: the drag link locks where the driving crank points along the base.
    #[error("coupler {coupler} and follower {follower} differ by 1 − the base {base} or more: {remedies} would turn")]
    LinksDiffer {
        /// λ1.
        base: f64,
        /// λ2.
        coupler: f64,
        /// λ3.
        follower: f64,
        /// What turns.
        remedies: Remedies,
    },
    /// 1 + λ1 < λ2 + λ3 does not hold: the drag link tears where the driving crank points away from the base.
    #[error("coupler {coupler} and follower {follower} do not reach over 1 + the base {base}: {remedies} would turn")]
    LinksTooShort {
        /// λ1.
        base: f64,
        /// λ2.
        coupler: f64,
        /// λ3.
        follower: f64,
        /// What turns.
        remedies: Remedies,
    },
}

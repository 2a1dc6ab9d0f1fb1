//! Why a linkage does not turn, and the changes with which it would.

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
pub struct DragLinkRemedies {
    /// λ1.
    pub base: Passing,
    /// λ2.
    pub coupler: Passing,
    /// λ3.
    pub follower: Passing,
}

impl std::fmt::Display for DragLinkRemedies {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let all = [("a base", self.base), ("a coupler", self.coupler), ("a follower", self.follower)];
        let lengths: Vec<String> = all
            .iter()
            .filter(|(_, passing)| !passing.is_empty())
            .map(|(name, passing)| format!("{name} {passing}"))
            .collect();
        f.write_str(&if lengths.is_empty() { "two other lengths".to_owned() } else { lengths.join(", or ") })
    }
}

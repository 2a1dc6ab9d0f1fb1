//! What is studied, and by what its designs are judged.

/// What is studied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StudyKind {
    /// Every combination of values.
    Sweep,
    /// Random designs.
    MonteCarlo,
    /// The designs that no other beats in every objective.
    Pareto,
}

/// Which values of an objective are better.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Goal {
    /// Small ones.
    Least,
    /// Large ones.
    Largest,
}

/// A limit that a design must keep.
#[derive(Debug, Clone, PartialEq)]
pub struct Constraint {
    /// The number of its column, from 0.
    pub column: usize,
    /// Least and largest value, in the unit of the column.
    pub within: (f64, f64),
}

/// A figure by which designs are compared.
#[derive(Debug, Clone, PartialEq)]
pub struct Objective {
    /// The number of its column, from 0.
    pub column: usize,
    /// Which values are better.
    pub goal: Goal,
}

impl StudyKind {
    /// Its word in the file.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Sweep => "sweep",
            Self::MonteCarlo => "monte-carlo",
            Self::Pareto => "pareto",
        }
    }
}

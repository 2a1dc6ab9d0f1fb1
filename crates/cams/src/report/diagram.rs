//! Diagrams: which columns of a table are drawn together.

/// How the values of a column, or the limit of a check, are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlottedValue {
    /// The value.
    Itself,
    /// The value, and the value with its sign reversed.
    Both,
    /// One over the value: a radius as a curvature.
    Curvature,
    /// The curvature of the roller instead of the limit.
    Roller,
    /// The curvature of the roller, for a concave part.
    Hollow,
}

/// A diagram.
#[derive(Debug, PartialEq)]
pub struct Diagram {
    /// Name for programs.
    pub id: &'static str,
    /// Title.
    pub title: &'static str,
    /// Columns without their units, and their names.
    pub stems: &'static [(&'static str, &'static str)],
    /// Checks whose limits it shows.
    pub limits: &'static [(&'static str, PlottedValue)],
    /// How its columns are shown.
    pub shown: PlottedValue,
}

/// A diagram.
#[must_use]
pub const fn diagram(
    id: &'static str,
    title: &'static str,
    stems: &'static [(&'static str, &'static str)],
    limits: &'static [(&'static str, PlottedValue)],
    shown: PlottedValue,
) -> Diagram {
    Diagram { id, title, stems, limits, shown }
}

//! What the sheets of a cam are for.

/// What a sheet is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SheetKind {
    /// The part and nothing else: what the shop makes.
    Drawing,
    /// Discs on one shaft: how they lie to each other.
    Pair,
    /// The part in its mechanism, with checks and curves: what is looked at before the part is released.
    Review,
    /// The places at which the part is measured.
    Inspection,
    /// How the part is set up on a machine for its program.
    Setup,
}

impl SheetKind {
    /// Whether a shop works from it.
    #[must_use]
    pub fn is_drawing(self) -> bool {
        matches!(self, Self::Drawing | Self::Pair)
    }

    /// Its name in the title block (ISO 7200: document type).
    #[must_use]
    pub fn document(self) -> &'static str {
        match self {
            Self::Drawing => "part drawing",
            Self::Pair => "drawing of the pair",
            Self::Review => "review sheet",
            Self::Inspection => "inspection sheet",
            Self::Setup => "setup sheet",
        }
    }
}

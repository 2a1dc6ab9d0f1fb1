//! Tolerances that a drawing proposes if the machine file gives none.

/// Behind a value that nobody has given.
pub(in crate::body) const PROPOSED: &str = " *";
/// The note that explains the mark.
pub(in crate::body) const PROPOSED_NOTE: &str =
    "* and the frames of tolerances: proposed by camgen, to be confirmed at release";
/// Deviations, mm: of the thickness, the depth of a groove, its width, the length and the diameter of a hub.
pub(in crate::body) const THICKNESS: [f64; 2] = [-0.1, 0.1];
pub(in crate::body) const DEPTH: [f64; 2] = [0.0, 0.1];
pub(in crate::body) const WIDTH: [f64; 2] = [0.0, 0.02];
pub(in crate::body) const HUB: [f64; 2] = [-0.3, 0.3];
/// Widths of zones, mm: symmetry of a keyway, a face square to the bore, position of a hole with a tolerance class.
pub(in crate::body) const SYMMETRY: f64 = 0.03;
pub(in crate::body) const SQUARE: f64 = 0.02;
pub(in crate::body) const POSITION: f64 = 0.05;
/// Tolerance classes of a bore and of the width of a keyway.
pub(in crate::body) const BORE_FIT: &str = "H7";
pub(in crate::body) const KEYWAY_FIT: &str = "P9";

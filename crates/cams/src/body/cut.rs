//! What is cut of a body: its outlines, each with the motion and the follower that it is made for.

use super::{Layer, WorstPlaces};
use camgen_kernel::profile::Curves;

/// A closed outline that is cut.
#[derive(Debug, Clone, Copy)]
pub struct Cut<'a> {
    /// Which of the outlines of a body with several at one place it is, as names of files have it; empty where there is one.
    pub name: &'static str,
    /// Layer on which it is cut.
    pub layer: Layer,
    /// How deep it is cut from the upper face, m; `None` of one that goes through.
    pub depth: Option<f64>,
    /// Place along the axis, m.
    pub z: f64,
    /// Speed it is cut for, rpm, where there are several sections.
    pub rpm: Option<f64>,
    /// Motion and follower that roll on it in its plane; `None` where it is the section of a [`Surface`](super::Surface).
    pub curves: Option<Curves<'a>>,
    /// Ways in which the follower meets the drawing: as it is, or with the drawing mirrored about X.
    pub mirrored: &'static [bool],
    /// Worst places of these curves, kept once they are found.
    pub worst: Option<&'a WorstPlaces>,
}

impl<'a> Cut<'a> {
    /// The one outline of a body whose section does not change along its axis.
    #[must_use]
    pub fn plane(curves: Curves<'a>, mirrored: &'static [bool], worst: &'a WorstPlaces) -> Self {
        Self {
            name: "",
            layer: Layer::CamProfile,
            depth: None,
            z: 0.0,
            rpm: None,
            curves: Some(curves),
            mirrored,
            worst: Some(worst),
        }
    }

    /// Whether its metal lies around the roller.
    #[must_use]
    pub fn is_hollow(&self) -> bool {
        self.curves.is_some_and(|curves| curves.metal_side() < 0.0)
    }

    /// Whether its profile is undercut, or has a corner.
    #[must_use]
    pub fn is_undercut(&self) -> bool {
        let found = self.curves.zip(self.worst);
        found.is_some_and(|(curves, worst)| worst.least_radius(curves).value <= curves.offset().abs())
    }
}

/// The width of a groove between these cuts, m.
#[must_use]
pub fn groove_width(cuts: &[Cut<'_>]) -> Option<f64> {
    let [inner, outer] = cuts else { return None };
    let groove = inner.layer == Layer::GrooveInner && outer.layer == Layer::GrooveOuter;
    let width = inner.curves?.offset() - outer.curves?.offset();
    groove.then_some(width)
}

//! A mechanism drawn to scale, as it stands at a few moments: lines, joints and their letters. Whoever draws it needs no kinematics.
//!
//! Millimetres, y upwards, all stands in one frame.

use nalgebra::Vector2;

/// The mechanism at a few moments.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scheme {
    /// How it stands, one below the other.
    pub stands: Vec<Stand>,
    /// What the lines are, and what the drawing assumes, a sentence each.
    pub notes: Vec<String>,
}

/// The mechanism at one moment.
#[derive(Debug, Clone, PartialEq)]
pub struct Stand {
    /// Which moment it is.
    pub name: String,
    /// Its lines, from the back to the front.
    pub strokes: Vec<Stroke>,
    /// Its joints, on top of the lines.
    pub joints: Vec<Joint>,
}

/// What a line is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A link, or a side of one, in one of the colours of curves.
    Link(usize),
    /// The outline of a body.
    Body,
    /// What a joint describes over a turn.
    Path,
    /// A line on which something moves.
    Guide,
}

/// A chain of straight lines.
#[derive(Debug, Clone, PartialEq)]
pub struct Stroke {
    /// What it shows.
    pub name: &'static str,
    /// What it is.
    pub kind: Kind,
    /// Its points, mm.
    pub points: Vec<Vector2<f64>>,
}

/// A joint with its letter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// Its letter.
    pub letter: &'static str,
    /// Its place, mm.
    pub at: Vector2<f64>,
    /// Whether it stands on the frame of the machine.
    pub fixed: bool,
    /// Where its letter would best stand from it.
    pub towards: Vector2<f64>,
}

impl Scheme {
    /// Every point of every stand, mm.
    pub fn points(&self) -> impl Iterator<Item = Vector2<f64>> + '_ {
        let of_stand = |stand: &Stand| {
            let of_strokes = stand.strokes.iter().flat_map(|stroke| stroke.points.iter().copied());
            of_strokes.chain(stand.joints.iter().map(|joint| joint.at)).collect::<Vec<_>>()
        };
        self.stands.iter().flat_map(of_stand)
    }
}

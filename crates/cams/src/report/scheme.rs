//! A mechanism drawn to scale, in a few positions: lines, joints and their letters. Drawing it needs no kinematics.
//!
//! Millimetres, y upwards, all positions in one frame.

use nalgebra::Vector2;

/// The mechanism in a few positions.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scheme {
    /// Its positions, one below the other.
    pub poses: Vec<SchemePose>,
    /// What the lines are, and what the drawing assumes, a sentence each.
    pub notes: Vec<String>,
}

/// The mechanism in one position.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SchemePose {
    /// The name of the position.
    pub name: String,
    /// Its lines, from the back to the front.
    pub strokes: Vec<Stroke>,
    /// Its joints, on top of the lines.
    pub joints: Vec<SchemeJoint>,
    /// Sizes, each next to what it is of.
    pub labels: Vec<SchemeLabel>,
    /// Distances along the horizontal.
    pub dimensions: Vec<SchemeDimension>,
}

/// A size next to what it is of.
#[derive(Debug, Clone, PartialEq)]
pub struct SchemeLabel {
    /// The size with what it is of, such as `Ø80`.
    pub text: String,
    /// Where it is, mm.
    pub at: Vector2<f64>,
    /// The preferred direction of its text.
    pub towards: Vector2<f64>,
}

/// A horizontal distance, dimensioned below the position or above it.
#[derive(Debug, Clone, PartialEq)]
pub struct SchemeDimension {
    /// Its ends, mm.
    pub ends: [Vector2<f64>; 2],
    /// Its line: 1 is the first below, −1 the first above.
    pub lane: i32,
    /// The distance.
    pub text: String,
}

/// What a line is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StrokeKind {
    /// A link, or a side of one, in one of the colours of curves.
    Link(usize),
    /// The outline of a body.
    Body,
    /// The path of a joint over a turn.
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
    pub kind: StrokeKind,
    /// Its points, mm.
    pub points: Vec<Vector2<f64>>,
}

/// A joint with its letter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SchemeJoint {
    /// Its letter.
    pub letter: &'static str,
    /// Its place, mm.
    pub at: Vector2<f64>,
    /// Whether it is fixed to the frame of the machine.
    pub fixed: bool,
    /// The preferred direction of its letter.
    pub towards: Vector2<f64>,
}

impl Scheme {
    /// Every point of every position, mm.
    pub fn points(&self) -> impl Iterator<Item = Vector2<f64>> + '_ {
        let of_pose = |pose: &SchemePose| {
            let of_strokes = pose.strokes.iter().flat_map(|stroke| stroke.points.iter().copied());
            of_strokes.chain(pose.joints.iter().map(|joint| joint.at)).collect::<Vec<_>>()
        };
        self.poses.iter().flat_map(of_pose)
    }
}

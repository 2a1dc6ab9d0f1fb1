//! The followers of a machine that is put together in code.

use super::Builder;
use crate::write::number::with_unit;

/// A dimension of the follower's place: given, or chosen for the smallest cam. A number in metres is [`PlaceChoice::At`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum PlaceChoice {
    /// At this distance, m.
    At(f64),
    /// Where the cam is smallest; see [`crate::analysis::size`].
    SmallestCam,
}

impl Default for PlaceChoice {
    fn default() -> Self {
        Self::At(0.0)
    }
}

impl From<f64> for PlaceChoice {
    fn from(distance: f64) -> Self {
        Self::At(distance)
    }
}

/// On which side of its pivot an arm touches the cam, in the sense in which the cam turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ArmSide {
    /// The contact is behind the pivot.
    #[default]
    Trailing,
    /// The contact is before the pivot.
    Leading,
}

/// A roller on a straight path: `[follower.roller]`. A number is the radius of a roller whose path goes through the axis of the shaft.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RollerFollower {
    /// Radius of the roller, m.
    pub radius: f64,
    /// Distance of its path from the shaft, positive against the rotation of the cam.
    pub offset: PlaceChoice,
    /// Mass that moves with it along its path, kg.
    pub mass: Option<f64>,
    /// Force of a spring or weight that presses it onto the cam, N.
    pub preload: Option<f64>,
    /// Radius of a crowned rim along the roller's axis, m; a straight rim when absent.
    pub crown_radius: Option<f64>,
    /// Width of a cylindrical rim on a conoid, m; when absent the roller of a conoid is a sphere.
    pub rim_width: Option<f64>,
}

impl From<f64> for RollerFollower {
    fn from(radius: f64) -> Self {
        Self { radius, ..Self::default() }
    }
}

/// A roller on a swinging arm: `[follower.swinging-roller]`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SwingingRollerFollower {
    /// Radius of the roller, m.
    pub radius: f64,
    /// From the pivot to the roller, m.
    pub arm: f64,
    /// From the shaft to the pivot.
    pub pivot_distance: PlaceChoice,
    /// Where the roller touches.
    pub side: ArmSide,
    /// Moment of inertia of all swinging parts about the pivot, kg·m².
    pub inertia: Option<f64>,
    /// Radius of a crowned rim along the roller's axis, m; a straight rim when absent.
    pub crown_radius: Option<f64>,
}

/// A flat face on a straight path: `[follower.flat]`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FlatFaceFollower {
    /// Angle of the face's normal from its path, rad, positive against the rotation of the cam.
    pub tilt: f64,
    /// Distance of its stem from the shaft, m, positive against the rotation of the cam.
    pub offset: f64,
    /// Width of the face, m.
    pub width: Option<f64>,
    /// Mass that moves with it along its path, kg.
    pub mass: Option<f64>,
    /// Force of a spring or weight that presses it onto the cam, N.
    pub preload: Option<f64>,
}

/// A flat face on a swinging arm: `[follower.swinging-flat]`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SwingingFaceFollower {
    /// From the shaft to the pivot, m.
    pub pivot_distance: f64,
    /// Distance of the face from its pivot, m, positive towards the cam.
    pub face_offset: f64,
    /// Where the face touches.
    pub side: ArmSide,
    /// Width of the face, m.
    pub width: Option<f64>,
    /// Moment of inertia of all swinging parts about the pivot, kg·m².
    pub inertia: Option<f64>,
}

/// A knife edge on a straight path: `[follower.knife]`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct KnifeEdgeFollower {
    /// Distance of its path from the shaft, positive against the rotation of the cam.
    pub offset: PlaceChoice,
    /// Mass that moves with it along its path, kg.
    pub mass: Option<f64>,
    /// Force of a spring or weight that presses it onto the cam, N.
    pub preload: Option<f64>,
}

impl Builder {
    /// A roller on a straight path, by its radius (m) or with everything that is known of it.
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::{PlaceChoice, RollerFollower, Spec};
    ///
    /// let centred = Spec::builder("centred").roller(0.012).machine()?;
    /// let roller = RollerFollower { radius: 0.012, offset: PlaceChoice::SmallestCam, mass: Some(1.2), ..Default::default() };
    /// let offset = Spec::builder("offset").roller(roller).machine()?;
    /// # Ok::<(), camgen::Error>(())
    /// ```
    #[must_use]
    pub fn roller(self, roller: impl Into<RollerFollower>) -> Self {
        let RollerFollower { radius, offset, mass, preload, crown_radius, rim_width } = roller.into();
        let builder = self
            .length("follower.roller.radius", radius)
            .straight("follower.roller", mass, preload)
            .length("follower.roller.crown_radius", crown_radius)
            .length("follower.roller.width", rim_width);
        let builder = if rim_width.is_some() { builder.set("follower.roller.crown", "cylinder") } else { builder };
        // An offset of 0 is the default of the file, and does not undo [`Builder::offset`].
        if offset == PlaceChoice::default() { builder } else { builder.place("follower.roller.offset", offset) }
    }

    /// Distance (m) of a roller's path from the shaft, for a roller that is given by its radius alone: as [`RollerFollower::offset`].
    #[must_use]
    pub fn offset(self, offset: f64) -> Self {
        self.length("follower.roller.offset", offset)
    }

    /// A roller on a swinging arm.
    #[must_use]
    pub fn swinging_roller(self, roller: SwingingRollerFollower) -> Self {
        let SwingingRollerFollower { radius, arm, pivot_distance, side, inertia, crown_radius } = roller;
        self.length("follower.swinging-roller.radius", radius)
            .length("follower.swinging-roller.arm", arm)
            .place("follower.swinging-roller.pivot_distance", pivot_distance)
            .side("follower.swinging-roller.side", side)
            .quantity("follower.swinging-roller.inertia", inertia, "kg*m2")
            .length("follower.swinging-roller.crown_radius", crown_radius)
    }

    /// A flat face on a straight path.
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::{FlatFaceFollower, Program, Quantity, Spec, law};
    ///
    /// // Up and down over 1.5 rad each; the last segment takes what is left of the turn.
    /// let polynomial = Some(law("4-5-6-7")?);
    /// let motion = Program::new(Quantity::Length, 0.0, &[(polynomial, 1.5, 0.009), (polynomial, 1.5, 0.0), (None, 3.0, 0.0)])?;
    /// let face = FlatFaceFollower { width: Some(0.045), ..Default::default() };
    /// let cam = Spec::builder("valve").flat_face(face).bore_radius(0.008).motion(motion)?.solve()?;
    /// assert!(cam.draw(10e-6)?.prove()?.passed());
    /// # Ok::<(), camgen::Error>(())
    /// ```
    #[must_use]
    pub fn flat_face(self, face: FlatFaceFollower) -> Self {
        let FlatFaceFollower { tilt, offset, width, mass, preload } = face;
        self.angle("follower.flat.tilt", tilt)
            .length("follower.flat.offset", offset)
            .straight("follower.flat", mass, preload)
            .length("follower.flat.width", width)
    }

    /// A flat face on a swinging arm.
    #[must_use]
    pub fn swinging_flat_face(self, face: SwingingFaceFollower) -> Self {
        let SwingingFaceFollower { pivot_distance, face_offset, side, width, inertia } = face;
        self.length("follower.swinging-flat.pivot_distance", pivot_distance)
            .length("follower.swinging-flat.face_offset", face_offset)
            .side("follower.swinging-flat.side", side)
            .length("follower.swinging-flat.width", width)
            .quantity("follower.swinging-flat.inertia", inertia, "kg*m2")
    }

    /// A knife edge on a straight path.
    #[must_use]
    pub fn knife_edge(self, edge: KnifeEdgeFollower) -> Self {
        let KnifeEdgeFollower { offset, mass, preload } = edge;
        self.place("follower.knife.offset", offset).straight("follower.knife", mass, preload)
    }

    /// What moves with a follower on a straight path and presses it on.
    fn straight(self, table: &str, mass: Option<f64>, preload: Option<f64>) -> Self {
        self.quantity(&format!("{table}.mass"), mass, "kg").quantity(&format!("{table}.preload"), preload, "N")
    }

    fn place(self, key: &str, place: PlaceChoice) -> Self {
        match place {
            PlaceChoice::At(distance) => self.set(key, &with_unit(distance, "m")),
            PlaceChoice::SmallestCam => self.set(key, "auto"),
        }
    }

    fn side(self, key: &str, side: ArmSide) -> Self {
        self.set(
            key,
            match side {
                ArmSide::Trailing => "trailing",
                ArmSide::Leading => "leading",
            },
        )
    }
}

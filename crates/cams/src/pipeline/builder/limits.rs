//! The limits of a machine that is put together in code.

use super::Builder;

impl Builder {
    /// Largest pressure angle, rad.
    #[must_use]
    pub fn pressure_angle(self, angle: f64) -> Self {
        self.angle("limits.pressure_angle", angle)
    }

    /// Largest pressure angle where it is negative, rad: where a spring brings the follower back.
    #[must_use]
    pub fn pressure_angle_return(self, angle: f64) -> Self {
        self.angle("limits.pressure_angle_return", angle)
    }

    /// Smallest convex radius of the pitch curve over the radius of the roller.
    #[must_use]
    pub fn min_convex_pitch_radius_over_roller(self, ratio: f64) -> Self {
        self.number("limits.min_convex_pitch_radius_over_roller", ratio)
    }

    /// Smallest convex radius of the profile, m.
    #[must_use]
    pub fn min_convex_radius(self, radius: f64) -> Self {
        self.length("limits.min_convex_radius", radius)
    }

    /// Radius of the cutter that must fit into the concave parts, m.
    #[must_use]
    pub fn cutter_radius(self, radius: f64) -> Self {
        self.length("limits.cutter_radius", radius)
    }

    /// Least metal between the bore and the profile, or between the flanks of a plate, m.
    #[must_use]
    pub fn wall(self, thickness: f64) -> Self {
        self.length("limits.wall", thickness)
    }

    /// Largest length or width of the cam, m.
    #[must_use]
    pub fn largest_size(self, length: f64) -> Self {
        self.length("limits.size", length)
    }

    /// Least distance from the pivot of a swinging follower to the circle that the cam sweeps over, m.
    #[must_use]
    pub fn pivot_clearance(self, distance: f64) -> Self {
        self.length("limits.pivot_clearance", distance)
    }

    /// Largest pressure between roller and cam, Pa.
    #[must_use]
    pub fn contact_stress(self, pressure: f64) -> Self {
        self.quantity("limits.contact_stress", pressure, "Pa")
    }

    /// Largest error of the follower's acceleration as cut, over the largest acceleration of the motion.
    #[must_use]
    pub fn acceleration_share(self, share: f64) -> Self {
        self.number("limits.acceleration_share", share)
    }

    /// Order of the last derivative of the motion that must be continuous all round, 0 to 3.
    #[must_use]
    pub fn continuity(self, order: u8) -> Self {
        self.number("limits.continuity", f64::from(order))
    }

    /// Least speed at which the follower leaves the cam, over the speed of the cam.
    #[must_use]
    pub fn jump_margin(self, ratio: f64) -> Self {
        self.number("limits.jump_margin", ratio)
    }

    /// Largest residual vibration after a movement, over its travel.
    #[must_use]
    pub fn residual_vibration(self, share: f64) -> Self {
        self.number("limits.residual", share)
    }
}

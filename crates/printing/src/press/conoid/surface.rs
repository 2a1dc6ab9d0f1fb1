//! The surface of a conoid: contact of the sphere, principal curvatures, cuts.

use super::{Conoid, Partials, Strips};
use camgen_cams::body::surface::SpatialContact;
use camgen_kernel::geometry::CurvePoint;
use camgen_kernel::numeric::series::PowerSeries;
use nalgebra::{Vector2, Vector3};

/// Newton steps to the roller that touches a cut.
const CUT_STEPS: usize = 20;
/// A step of Newton's method to a roller behind which no further one is made, m.
const LAST_STEP: f64 = 1e-10;

impl Conoid {
    /// Where the sphere at a cam angle and an axial position touches, m: its centre, the unit normal out of the
    /// metal, the point of contact.
    #[must_use]
    pub fn contact(&self, piece: usize, angle: f64, z: f64) -> SpatialContact {
        self.contact_of(&self.lift(piece, angle, z), angle, z)
    }

    /// [`Conoid::contact`] by lift and derivatives there.
    #[must_use]
    pub fn contact_of(&self, partials: &Partials, angle: f64, z: f64) -> SpatialContact {
        let (u, a) = self.height_and_slope(partials);
        let axes = Axes::new(angle);
        let length = libm::hypot(a, u);
        let normal = axes.along * (u / length) - axes.across * (a / length);
        let taper = partials[0][1] * u / length;
        let stretch = (1.0 + taper * taper).sqrt();
        let centre = axes.along * u + axes.across * self.roller.offset;
        let normal = Vector3::new(normal.x, normal.y, -taper) / stretch;
        let centre = Vector3::new(centre.x, centre.y, z);
        SpatialContact { centre, normal, point: centre - normal * self.roller.radius, slope: partials[0][1] }
    }

    /// Height of the roller's centre over the shaft along the path, m, and its slope by the angle less the offset of the path, m.
    #[must_use]
    pub fn height_and_slope(&self, partials: &Partials) -> (f64, f64) {
        let (offset, prime) = (self.roller.offset, self.prime_radius());
        (((prime - offset) * (prime + offset)).sqrt() + partials[0][0], partials[1][0] - offset)
    }

    /// Largest and smallest principal curvature of the pitch surface, 1/m, convex positive.
    #[must_use]
    pub fn principal_curvatures(&self, piece: usize, angle: f64, z: f64) -> (f64, f64) {
        self.curvatures_of(&self.lift(piece, angle, z))
    }

    /// [`Conoid::principal_curvatures`] by lift and derivatives there.
    #[must_use]
    pub fn curvatures_of(&self, p: &Partials) -> (f64, f64) {
        let offset = self.roller.offset;
        let (u, a) = self.height_and_slope(p);
        // In the basis along, across, axis.
        let normal = Vector3::new(u, -a, -u * p[0][1]);
        let by_angle = Vector3::new(a, u, 0.0);
        let by_axis = Vector3::new(p[0][1], 0.0, 1.0);
        let second = [
            Vector3::new(p[2][0] - u, 2.0 * p[1][0] - offset, 0.0),
            Vector3::new(p[1][1], p[0][1], 0.0),
            Vector3::new(p[0][2], 0.0, 0.0),
        ];
        let size = normal.norm();
        let [l, m, n] = second.map(|vector| -vector.dot(&normal) / size);
        let (e, f, g) = (by_angle.norm_squared(), by_angle.dot(&by_axis), by_axis.norm_squared());
        let area = e * g - f * f;
        let mean = 0.5 * (e * n - 2.0 * f * m + g * l) / area;
        let gauss = (l * n - m * m) / area;
        let apart = (mean * mean - gauss).max(0.0).sqrt();
        (mean + apart, mean - apart)
    }

    /// The cut of the cam at z (m) where the roller at a cam angle of a piece touches it: a point of the section with
    /// its tangent and curvature, parametrised by the cam angle, and the axial position ζ of that roller. `None` where the
    /// surface folds along the axis.
    #[must_use]
    pub fn cut(&self, piece: usize, angle: f64, z: f64) -> Option<(CurvePoint, f64)> {
        let (frame, zeta, _) = self.cut_of(&self.lifts(piece, angle), angle, z)?;
        Some((frame, zeta))
    }

    /// [`Conoid::cut`] by the lifts of the sections at the angle; also lift and derivatives at that roller.
    #[must_use]
    pub fn cut_of<L: Strips + ?Sized>(&self, lifts: &L, angle: f64, z: f64) -> Option<(CurvePoint, f64, Partials)> {
        let (partials, zeta) = self.roller_of_cut(lifts, z)?;
        // Each coefficient of ζ enters the coefficient of its power linearly, and all with the same factor.
        let without = self.across(&partials, PowerSeries([zeta, 0.0, 0.0])).axial.0[1];
        let factor = self.across(&partials, PowerSeries([zeta, 1.0, 0.0])).axial.0[1] - without;
        let first = -without / factor;
        let second = -self.across(&partials, PowerSeries([zeta, first, 0.0])).axial.0[2] / factor;
        let along = self.along(&partials, angle, PowerSeries([zeta, first, second]));
        let [heading, turn, turn2] = along.heading.0;
        let [speed, speed1, _] = along.speed.0;
        let tangent = Vector2::new(libm::cos(heading), libm::sin(heading));
        let axes = Axes::new(angle);
        let centre = axes.along * along.height + axes.across * self.roller.offset;
        let outward = Vector2::new(tangent.y, -tangent.x);
        let frame = CurvePoint {
            point: centre - outward * along.reach,
            tangent,
            speed,
            curvature: turn / speed,
            curvature_slope: (2.0 * turn2 * speed - turn * speed1) / (speed * speed * speed),
        };
        Some((frame, zeta, partials))
    }

    /// The roller that touches the cut at z (m) at the cam angle of these lifts of the sections: lift and derivatives there,
    /// and its axial position ζ. `None` where the surface folds along the axis.
    pub(super) fn roller_of_cut<L: Strips + ?Sized>(&self, lifts: &L, z: f64) -> Option<(Partials, f64)> {
        let mut zeta = z;
        for _ in 0..CUT_STEPS {
            let (wander, slope) = self.wander(&self.lift_of(lifts, zeta));
            // A surface that folds back along the axis has no single roller for the cut.
            if !(1.0 + slope > 0.0) {
                return None;
            }
            let step = (zeta + wander - z) / (1.0 + slope);
            zeta -= step;
            // The next step would be its square, over a length of the cam.
            if step.abs() <= LAST_STEP {
                break;
            }
        }
        Some((self.lift_of(lifts, zeta), zeta))
    }

    /// Place of the contact along θ ↦ (θ, ζ(θ)), as series in θ.
    fn across(&self, p: &Partials, zeta: PowerSeries<3>) -> Across {
        let (height, _) = self.height_and_slope(p);
        let u = along_path(p, 0, 0, zeta) + (height - p[0][0]);
        let a = along_path(p, 1, 0, zeta) - self.roller.offset;
        let slope = along_path(p, 0, 1, zeta);
        let length = (a * a + u * u).sqrt();
        let taper = slope * u / length;
        let stretch = (taper * taper + 1.0).sqrt();
        Across { u, a, slope, length, stretch, axial: zeta + taper * self.roller.radius / stretch }
    }

    /// What follows from the lift along θ ↦ (θ, ζ(θ)).
    fn along(&self, p: &Partials, angle: f64, zeta: PowerSeries<3>) -> CutSeries {
        let Across { u, a, slope, length, stretch, .. } = self.across(p, zeta);
        let heading = u.atan2(a) + PowerSeries([angle, 1.0, 0.0]);
        let reach = PowerSeries::constant(self.roller.radius) / stretch;
        let speed = length + slope * zeta.slope() * a / length - reach * heading.slope();
        CutSeries { heading, speed, reach: reach.0[0], height: u.0[0] }
    }

    /// How far the contact lies from the roller's plane along the axis, r τ/√(1+τ²), m, and its derivative by z.
    pub(super) fn wander(&self, p: &Partials) -> (f64, f64) {
        let (u, a) = self.height_and_slope(p);
        let length = libm::hypot(a, u);
        let (s_z, s_zz, a_z) = (p[0][1], p[0][2], p[1][1]);
        let taper = s_z * u / length;
        let by_axis = s_zz * u / length + s_z * (s_z / length - u * (a * a_z + u * s_z) / (length * length * length));
        let stretch = (1.0 + taper * taper).sqrt();
        let radius = self.roller.radius;
        (radius * taper / stretch, radius * by_axis / (stretch * stretch * stretch))
    }
}

/// The derivative of the lift by θ m times and by z n times along θ ↦ (θ, ζ(θ)), as a series in θ.
fn along_path(p: &Partials, m: usize, n: usize, zeta: PowerSeries<3>) -> PowerSeries<3> {
    let [_, z1, z2] = zeta.0;
    PowerSeries([
        partial(p, m, n),
        partial(p, m + 1, n) + partial(p, m, n + 1) * z1,
        0.5 * (partial(p, m + 2, n) + 2.0 * partial(p, m + 1, n + 1) * z1 + partial(p, m, n + 2) * z1 * z1)
            + partial(p, m, n + 1) * z2,
    ])
}

fn partial(p: &Partials, m: usize, n: usize) -> f64 {
    p.get(m).and_then(|row| row.get(n)).copied().unwrap_or(0.0)
}

/// Height and slopes of the lift along a cut, what follows from them, and the axial position of the contact.
struct Across {
    u: PowerSeries<3>,
    a: PowerSeries<3>,
    slope: PowerSeries<3>,
    length: PowerSeries<3>,
    stretch: PowerSeries<3>,
    axial: PowerSeries<3>,
}

/// Series along a cut.
struct CutSeries {
    heading: PowerSeries<3>,
    speed: PowerSeries<3>,
    reach: f64,
    height: f64,
}

/// Directions of the roller's path and across it.
struct Axes {
    along: Vector2<f64>,
    across: Vector2<f64>,
}

impl Axes {
    fn new(angle: f64) -> Self {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        Self { along: Vector2::new(cos, sin), across: Vector2::new(-sin, cos) }
    }
}

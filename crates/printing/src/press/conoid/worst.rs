//! The worst points of a conoid: over every turn of slices along its axis, and over its sections.

use super::{Conoid, FEWEST_SLICES, MOST_SEARCHED, Partials, SLICES, SectionCut, SurfacePlace};
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::Worst;
use camgen_kernel::profile::extremes::{self, JumpRange};
use nalgebra::Vector2;
use std::f64::consts::PI;

impl Conoid {
    /// Axial positions at which the surface is evaluated, m: the sections and some between
    /// them.
    #[must_use]
    pub fn slices(&self) -> Vec<f64> {
        self.sliced(SLICES)
    }

    /// The sections, and `each` slices from each to the next.
    fn sliced(&self, each: u32) -> Vec<f64> {
        let pairs = self.positions.iter().zip(self.positions.iter().skip(1));
        let between = pairs.flat_map(|(a, b)| (0..each).map(move |i| a + (b - a) * f64::from(i) / f64::from(each)));
        between.chain(self.positions.last().copied()).collect()
    }

    /// Places along the axis from which the worst ones are searched, m.
    pub(super) fn searched(&self) -> Vec<f64> {
        let pairs = u32::try_from(self.positions.len()).unwrap_or(u32::MAX).saturating_sub(1).max(1);
        self.sliced((MOST_SEARCHED / pairs).clamp(FEWEST_SLICES, SLICES))
    }

    /// Those points and the ends of the cam.
    fn searched_and_ends(&self) -> Vec<f64> {
        let (low, high) = self.ends();
        let mut all = self.searched();
        all.extend([low, high]);
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }

    /// The sharpest convex point of the pitch surface but for corners: the curvature, 1/m.
    pub(super) fn sharpest_smooth(&self) -> Worst {
        let sharpest = &self.found.sharpest;
        *sharpest.get_or_init(|| self.worst_of_metal(|conoid, partials| conoid.curvatures_of(partials).0))
    }

    /// The larger principal curvature of the pitch surface at the roller that touches the cut at z (m) at a cam
    /// angle, 1/m; infinite where the surface folds along the axis.
    pub(super) fn sharpness(&self, angle: f64, z: f64) -> f64 {
        let (piece, angle) = self.slice(z).locate(angle);
        let touching = self.roller_of_cut(&self.lifts(piece, angle), z);
        touching.map_or(f64::INFINITY, |(partials, _)| self.curvatures_of(&partials).0)
    }

    /// The largest value of something, by lift and derivatives at the roller, over all the spheres that make the
    /// metal: those that touch a cut between the ends of the cam. Infinite where the surface folds along the axis.
    #[must_use]
    pub fn worst_of_metal(&self, value: impl Fn(&Self, &Partials) -> f64 + Sync) -> Worst {
        self.worst_over(&self.searched_and_ends(), |conoid, place| {
            let touching = conoid.roller_of_cut(place.lifts, place.z);
            touching.map_or(f64::INFINITY, |(partials, _)| value(conoid, &partials))
        })
    }

    /// The largest value of something over the surface of all positions of the roller.
    #[must_use]
    pub fn worst(&self, value: impl Fn(&Self, &SurfacePlace<'_>) -> f64 + Sync) -> Worst {
        self.worst_over(&self.searched(), value)
    }

    /// How far beyond the axial travel the roller touches at most while it is within it, m, and the position of the
    /// roller then: not positive where the contact always stays within.
    #[must_use]
    pub fn reach(&self) -> Worst {
        let travel = self.data.axial_travel;
        let above = self.worst(|conoid, place| place.z + conoid.wander(&place.partials).0 - travel);
        above.or_larger(self.worst(|conoid, place| -(place.z + conoid.wander(&place.partials).0)))
    }

    /// The range at whose ends forces may jump: the reversal of the first lobe.
    pub(super) fn acting(&self) -> [JumpRange; 1] {
        let angle = self.sections.first().map_or(PI, |section| section.law().bottom_law.angle());
        [(0.0, angle / f64::from(self.lobes.max(1)))]
    }

    /// The largest of something over the turns of the sections, each at its own speed; smooth but for the ends of the reversal.
    #[must_use]
    pub fn worst_of_sections(&self, value: impl Fn(SectionCut<'_>, usize, f64) -> f64 + Sync) -> Worst {
        let mut worst = Worst::NONE;
        for cut in self.all_sections() {
            let slice = self.slice(cut.z);
            let found =
                extremes::largest_of_motion(&slice, (&self.acting(), 0.0), |piece, angle| value(cut, piece, angle));
            worst = worst.or_larger(Worst { value: found.value, at: found.at, z: cut.z });
        }
        worst
    }

    /// The axial component of the contact force that the drive of the shift must resist, N: the force along the path times
    /// the slope of the lift along the axis.
    #[must_use]
    pub fn axial_force(&self) -> Worst {
        *self.found.axial_force.get_or_init(|| {
            // The square of its size is smooth where it vanishes.
            let square = self.worst_of_sections(|cut, piece, angle| {
                let axial = self.path_force(cut.section, cut.rpm, piece, angle) * self.lift(piece, angle, cut.z)[0][1];
                axial * axial
            });
            Worst { value: square.value.max(0.0).sqrt(), ..square }
        })
    }

    /// Largest lift over all sections, m.
    #[must_use]
    pub fn max_lift(&self) -> f64 {
        let highest = self.worst_of_sections(|cut, piece, angle| cut.section.bottom(piece, angle).s).value;
        (highest - self.lowest) * self.lever
    }

    /// By how much the plane offset of the pitch curve at z misses the cut there, m: from a point of the one along the
    /// normal of the other, its foot found by Newton's method.
    #[must_use]
    pub fn plane_offset_error(&self, z: f64) -> f64 {
        let slice = self.slice(z);
        let plane = self.plane_of(&slice);
        let largest = extremes::largest_without_slope(plane, |piece, angle| {
            self.distance_from_cut(plane.profile(piece, angle).point, piece, angle, z)
        });
        largest.value
    }

    /// Distance of a point from the cut at z (m), m, the foot found from a cam angle.
    fn distance_from_cut(&self, point: Vector2<f64>, piece: usize, angle: f64, z: f64) -> f64 {
        let Some(span) = self.pieces().get(piece) else { return f64::NAN };
        let mut foot = angle;
        let mut left = f64::NAN;
        for _ in 0..4 {
            let Some((cut, _)) = self.cut(piece, foot, z) else { return f64::NAN };
            let away = point - cut.point;
            left = away.dot(&cut.outward());
            foot = (foot + away.dot(&cut.tangent) / cut.speed).clamp(span.start, span.end);
        }
        left.abs()
    }

    /// Largest distance of the contact from the roller's plane along the axis, m.
    #[must_use]
    pub fn largest_wander(&self) -> Worst {
        let wander = &self.found.wander;
        *wander.get_or_init(|| self.worst(|conoid, place| conoid.wander(&place.partials).0.abs()))
    }

    /// The largest angle by which the normal leans along the axis, rad.
    #[must_use]
    pub fn largest_lean(&self) -> f64 {
        libm::asin(self.largest_wander().value / self.roller.radius)
    }

    /// The smallest radius of the cam about its axis, m, and where it is.
    #[must_use]
    pub fn smallest_radius(&self) -> Worst {
        let worst = self.worst_over(&self.searched_and_ends(), |conoid, place| {
            let touching = conoid.roller_of_cut(place.lifts, place.z);
            touching.map_or(0.0, |(partials, zeta)| -conoid.contact_of(&partials, place.angle, zeta).point.xy().norm())
        });
        Worst { value: -worst.value, ..worst }
    }
}

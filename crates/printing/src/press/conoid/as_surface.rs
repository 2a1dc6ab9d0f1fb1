//! The conoid as a [`Surface`].

use super::missed::FollowerOnSection;
use super::{AllStrips, Conoid, Strips, StripsNear};
use camgen_cams::body::surface::{AtAngle, Heading, PitchPoint, RateErrors, SpatialContact, Surface};
use camgen_kernel::geometry::boundary::Boundary;
use camgen_kernel::geometry::points::MotionErrors;
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::Curves;
use nalgebra::Vector3;

/// A vector along the roller's path, across it and along the axis, in the axes of the drawing.
fn turned(v: Vector3<f64>, sin: f64, cos: f64) -> Vector3<f64> {
    Vector3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z)
}

/// A cam angle with what the sections lift there.
struct SectionLifts<'a, L> {
    conoid: &'a Conoid,
    angle: f64,
    lifts: L,
}

impl<L: Strips> AtAngle for SectionLifts<'_, L> {
    fn contact(&self, z: f64) -> SpatialContact {
        self.conoid.contact_of(&self.conoid.lift_of(&self.lifts, z), self.angle, z)
    }

    fn of_cut(&self, z: f64) -> Option<SpatialContact> {
        let (_, zeta, partials) = self.conoid.cut_of(&self.lifts, self.angle, z)?;
        Some(self.conoid.contact_of(&partials, self.angle, zeta))
    }
}

impl Surface for Conoid {
    fn sphere(&self) -> [f64; 2] {
        [self.roller.radius, self.roller.offset]
    }

    fn ends(&self) -> (f64, f64) {
        Conoid::ends(self)
    }

    fn slices(&self) -> Vec<f64> {
        Conoid::slices(self)
    }

    fn law(&self, z: f64) -> Box<dyn Motion + '_> {
        Box::new(self.slice(z))
    }

    fn in_plane(&self, z: f64, done: &mut dyn FnMut(Curves<'_>)) {
        let slice = self.slice(z);
        done(self.plane_of(&slice));
    }

    fn at(&self, piece: usize, angle: f64) -> Box<dyn AtAngle + '_> {
        let lifts: StripsNear<'_> = self.lifts(piece, angle);
        Box::new(SectionLifts { conoid: self, angle, lifts })
    }

    fn at_for_many(&self, piece: usize, angle: f64) -> Box<dyn AtAngle + Send + Sync + '_> {
        let lifts: AllStrips = self.all_lifts(piece, angle);
        Box::new(SectionLifts { conoid: self, angle, lifts })
    }

    fn pitch(&self, piece: usize, angle: f64, z: f64) -> PitchPoint {
        let lift = self.lift(piece, angle, z);
        let (height, slope) = self.height_and_slope(&lift);
        let point = Vector3::new(height, self.roller.offset, z);
        let slopes = [Vector3::new(slope, height, 0.0), Vector3::new(lift[0][1], 0.0, 1.0)];
        let second = [
            Vector3::new(lift[2][0] - height, lift[1][0] + slope, 0.0),
            Vector3::new(lift[1][1], lift[0][1], 0.0),
            Vector3::new(lift[0][2], 0.0, 0.0),
        ];
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        (turned(point, sin, cos), slopes.map(|v| turned(v, sin, cos)), second.map(|v| turned(v, sin, cos)))
    }

    fn rate_errors(&self, z: f64, heading: Heading, inwards: f64) -> Option<RateErrors> {
        self.rate_errors_at(z, heading, inwards)
    }

    fn cut_at(&self, z: f64) -> Boundary<'_> {
        self.exact_cut(z, false)
    }

    fn centre_at(&self, z: f64) -> Boundary<'_> {
        self.exact_centre(z)
    }

    fn motion_errors(&self, z: f64, centre: bool) -> Box<dyn MotionErrors + '_> {
        Box::new(FollowerOnSection::new(self, z, centre))
    }
}

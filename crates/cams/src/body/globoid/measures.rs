//! What is checked of a globoid as it was solved.

use super::Globoid;
use super::contact::TurretLine;
use crate::body::swept::{FlankSide, RollerLine, SweptMeasures, least_fold, pressure_angles};
use crate::check::{Check, CheckExplanation, CheckScope, Measures, Subject};
use crate::report::{Bound, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::Worst;
use camgen_kernel::profile::size::{first_that_keeps, rounded_up};
use camgen_kernel::text::{KeyChange, Remedy, Text, text};

/// Rounding of an angle at an end.
const AT_END: f64 = 1e-9;
/// Bisections to find the end of a contact line.
const HALVINGS: u32 = 40;
/// Places between two joints at which the rollers are counted.
const PLACES: u32 = 64;

/// The check.
pub const MESHING: Check = Check {
    name: "meshing",
    on: CheckScope::Cam,
    unit: "",
    about: "How many rollers of a turret touch either flank of a globoid over their whole reach, at least: without one the turret would be loose, or be pressed by \
            a roller that is entering.",
    explained: CheckExplanation {
        bound: Bound::AtLeast,
        formula: "the least number, over a turn, of rollers whose line of contact lies between the ends of the cam, of the flanks above and of those below",
        usual: "one on each flank",
        change: "a larger `cam.end_angle`, more `cam.rollers`",
    },
};

/// Largest growth of the distance of the turret that is tried.
const LARGEST_GROWTH: f64 = 4.0;

impl Globoid {
    /// Least number of rollers that touch each flank over their whole reach, with the cam angle where that is.
    pub(super) fn least_touching(&self) -> (f64, f64) {
        let mut least = (f64::INFINITY, 0.0);
        for (index, piece) in self.groove.motion.pieces().iter().enumerate() {
            for i in 0..=PLACES {
                let angle = piece.start + (piece.end - piece.start) * f64::from(i) / f64::from(PLACES);
                for flank in FlankSide::BOTH {
                    let inside =
                        |roller: &i32| self.touches_wholly(&self.line_in(index, angle, 0.0, f64::from(*roller)), flank);
                    #[expect(clippy::cast_precision_loss, reason = "a few rollers")]
                    let count = self.passing_rollers().filter(inside).count() as f64;
                    if count < least.0 {
                        least = (count, angle);
                    }
                }
            }
        }
        least
    }

    /// Whether a flank of a roller's groove lies between the ends over the whole reach of the roller.
    pub(super) fn touches_wholly(&self, line: &TurretLine, flank: FlankSide) -> bool {
        [self.outside, self.reached].into_iter().all(|v| {
            let place = line.flank(&line.point(v), self.groove.signed(flank));
            let about = libm::atan2(place.z, self.turret.distance - place.xy().norm());
            about.abs() <= self.end_angle + AT_END
        })
    }

    /// Contact length of a roller and a flank within its reach, m: between the cam's ends and inside its outer surface.
    pub(super) fn length_of_contact(&self, line: &TurretLine, flank: FlankSide) -> f64 {
        let touches = |v: f64| {
            let place = line.flank(&line.point(v), self.groove.signed(flank));
            let off = self.turret.distance - place.xy().norm();
            let between = libm::atan2(place.z, off).abs() <= self.end_angle + AT_END;
            between && libm::hypot(off, place.z) >= self.outside * (1.0 - AT_END)
        };
        let [outside, reached] = [self.outside, self.reached];
        let (mut touching, mut beyond) = match [outside, reached].map(touches) {
            [true, true] => return reached - outside,
            [false, false] => return 0.0,
            [true, false] => (outside, reached),
            [false, true] => (reached, outside),
        };
        let whole = touching;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (touching + beyond);
            *(if touches(middle) { &mut touching } else { &mut beyond }) = middle;
        }
        (touching - whole).abs()
    }
}

impl SweptMeasures for Globoid {
    /// About the bore, and of the ribs on the outside, with the cam angle of the latter.
    fn wall(&self) -> (f64, Option<Worst>) {
        let bore =
            self.groove.machine.cam.bore_reach().map_or(f64::INFINITY, |bore| self.turret.distance - self.floor - bore);
        let (rib, at) = self.thinnest_rib();
        if rib < bore { (rib, Some(Worst { value: rib, at, z: 0.0 })) } else { (bore, None) }
    }

    /// A distance of the turret with which the pressure angle, the flanks and the walls keep their limits.
    fn remedy(&self) -> Option<Text> {
        let limits = self.groove.machine.limits;
        let least_wall = limits.least_wall(self.groove.machine.cam.bore_radius);
        let keeps = |distance: f64| {
            self.at_distance(distance).is_some_and(|other| {
                let free = least_fold(&other).value > other.groove.farther();
                let [rising, _] = pressure_angles(&other);
                free && rising.value <= limits.pressure_angles()[0] && other.wall().0 >= least_wall
            })
        };
        let distance = self.turret.distance;
        let found = first_that_keeps(distance, LARGEST_GROWTH * distance, keeps).map(rounded_up)?;
        keeps(found)
            .then(|| KeyChange::new("cam.turret_distance", format!("{} mm", shown(MILLIMETRES * found))))
            .map(|change| text!("with {} pressure angle, flanks and walls would pass", Remedy::new([change])))
    }

    fn longest(&self) -> f64 {
        let (radius, height) = self.rim(self.outside);
        (2.0 * radius).max(2.0 * self.rim(self.floor).1.max(height))
    }

    fn measure(&self, of: &mut Measures<'_>, subject: &Subject<'_>) {
        of.add(&MESHING, |_| {
            let (count, at) = self.least_touching();
            let kept = count >= 1.0;
            let note = (!kept).then(|| {
                text!(
                    "cam.end_angle is {} deg; a larger one keeps more rollers in contact",
                    format!("{:.3}", self.end_angle.to_degrees())
                )
            });
            MESHING.measure(count, Some(1.0)).kept(kept).noted(note).at(subject, &Worst { value: count, at, z: 0.0 })
        });
    }
}

//! A point of the cam and the roller that comes nearest to it.

use super::Globoid;
use super::contact::TurretLine;
use crate::body::swept::{Descent, NearestRoller, SeenPoint};
use nalgebra::Vector3;

/// Cam angles to either side of a point at which rollers are tried first, their distance over that of a flank from the roller's path, and steps to the nearest.
const TRIED: i32 = 4;
const APART: f64 = 0.4;
/// A place that is left out: the square of its distance is larger than the least so many times, which half a step does not explain.
const WORTH: f64 = 2.0;
/// Rollers are tried that stand no farther from the point about the turret, in the distances of two: a flank lies within half of that of its roller, which moves on as
/// far at most between its contact and the point's own angle.
const FARTHEST: f64 = 1.2;
const STEPS: usize = 16;

impl Globoid {
    /// A point (m) seen along the centre line of a roller at a cam angle.
    fn see(point: Vector3<f64>, angle: f64, line: TurretLine) -> SeenPoint {
        let [turret, by, second] = line.angle;
        let (sin, cos) = libm::sincos(angle);
        let (s, c) = libm::sincos(turret);
        let (out, across) = (point.x * cos + point.y * sin, point.y * cos - point.x * sin);
        let off = out - line.distance;
        let up = off * s + point.z * c;
        let back = off * c - point.z * s;
        let back_by = across * c - up * by;
        SeenPoint {
            off: [across, up],
            first: [-out, across * s + back * by],
            second: [-across, -out * s + across * c * by + back_by * by + back * second],
            rise: (s, c),
        }
    }

    /// Where the roller of a number comes nearest to a point, m, near a cam angle.
    fn nearest_of(&self, point: Vector3<f64>, start: f64, roller: f64) -> NearestRoller {
        let longest = APART * self.groove.farther() / point.xy().norm();
        let descent = Descent { longest, steps: STEPS };
        descent.from(start, |angle| Self::see(point, angle, self.line_at(angle, roller)))
    }

    /// The roller that comes nearest to a point, m.
    pub(super) fn nearest_roller(&self, point: Vector3<f64>) -> NearestRoller {
        let polar = libm::atan2(point.y, point.x);
        let radius = point.xy().norm();
        let about = libm::atan2(point.z, self.turret.distance - radius);
        let step = APART * self.groove.farther() / radius;
        let lead = (self.line_at(polar, 0.0).angle[0] - about) / self.turret.pitch();
        let places: Vec<(f64, TurretLine)> = (-TRIED - 1..=TRIED + 1)
            .map(|i| polar + step * f64::from(i))
            .map(|angle| (angle, self.line_at(angle, 0.0)))
            .collect();
        // Cam angle, roller and square of the distance where that is least among its neighbours.
        let mut starts: Vec<(f64, f64, f64)> = Vec::new();
        let mut roller = (lead - FARTHEST).ceil();
        while roller <= lead + FARTHEST {
            let back = roller * self.turret.pitch();
            let square = |(angle, line): &(f64, TurretLine)| {
                let [turret, by, second] = line.angle;
                Self::see(point, *angle, TurretLine { angle: [turret - back, by, second], ..*line }).square()
            };
            let tried: Vec<f64> = places.iter().map(square).collect();
            for ((start, _), around) in places.iter().skip(1).zip(tried.windows(3)) {
                let [before, here, after] = around else { continue };
                if before >= here && after >= here {
                    starts.push((*start, roller, *here));
                }
            }
            roller += 1.0;
        }
        let least = starts.iter().map(|start| start.2).fold(f64::INFINITY, f64::min);
        let near = starts.iter().filter(|start| start.2 <= WORTH * least);
        let found = near.map(|(angle, roller, _)| self.nearest_of(point, *angle, *roller));
        let found = found.reduce(|best, next| if next.seen.square() < best.seen.square() { next } else { best });
        let [off, first, second] = [[f64::NAN; 2]; 3];
        found.unwrap_or(NearestRoller { at: polar, seen: SeenPoint { off, first, second, rise: libm::sincos(about) } })
    }

    /// The least thickness of the ribs on the outside, m, where they are thinnest, with the cam angle: what lies between a flank and the nearest roller above it.
    pub(super) fn thinnest_rib(&self) -> (f64, f64) {
        let mut least = (f64::INFINITY, 0.0);
        for (piece, angle) in self.groove.places() {
            let line = self.line_in(piece, angle, 0.0, 0.0);
            // Of the roller that then is nearest to the middle.
            let roller = (line.angle[0] / self.turret.pitch()).round();
            let Some(found) =
                self.line_in(piece, angle, 0.0, roller).at_distance(self.groove.distances[0], self.outside)
            else {
                continue;
            };
            let (sin, cos) = libm::sincos(angle);
            let place = found.place;
            let point = Vector3::new(place.x * cos - place.y * sin, place.x * sin + place.y * cos, place.z);
            let nearest = self.nearest_of(point, angle, roller - 1.0);
            let thick = nearest.seen.square().sqrt() - self.groove.distances[1];
            if !(thick >= least.0) {
                least = (thick, angle);
            }
        }
        least
    }
}

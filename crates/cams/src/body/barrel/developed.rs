//! The developed view of the outside: both flanks and the centre line of the roller as arcs, and what the customary drawings of it would miss.

use super::swept::{CURVES, nearest_about};
use super::{Barrel, BarrelLine, BarrelRoller};
use crate::body::Layer;
use crate::body::swept::{FlankSide, RollerLine, SeenPoint};
use camgen_kernel::geometry::biarcs::biarcs;
use camgen_kernel::geometry::contour::Segment;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::profile::Worst;
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Share of the tolerance that the arcs may take at the places where they are compared.
const SHARE: f64 = 0.8;
/// A dwell is drawn in stretches no longer than this, rad: an arc of the other pieces is shorter anyway.
const LONGEST: f64 = TAU;

impl<R: BarrelRoller> Barrel<R> {
    /// The entities of the developed view within a tolerance, mm.
    ///
    /// # Errors
    /// [`Refusal`] when the tolerance is finer than arcs can keep.
    pub(super) fn developed_view(&self, tolerance: f64) -> Result<Vec<(Layer, Entity)>, Refusal> {
        let mut entities = Vec::new();
        for (flank, layer) in CURVES {
            for (index, piece) in self.groove.motion.pieces().iter().enumerate() {
                let place = |angle: f64| self.developed_at(flank, (index, angle));
                let range = (piece.start, piece.end.min(piece.start + LONGEST));
                let arcs = biarcs(&place, range, SHARE * tolerance).ok_or_else(|| {
                    Refusal::new(format!("no arcs keep {tolerance} mm of the developed view"))
                        .remedy("give a coarser --tolerance")
                })?;
                entities.extend(joined(arcs).into_iter().map(|segment| (layer, Entity::Segment(segment))));
            }
        }
        entities.extend(self.rectangle().map(|segment| (Layer::Blank, Entity::Segment(segment))));
        Ok(entities)
    }

    /// The edge of the developed blank.
    fn rectangle(&self) -> [Segment; 4] {
        let start = self.groove.motion.range().0;
        let x = |angle: f64| MILLIMETRES * self.groove.sense() * self.outer * angle;
        let (left, right) = (x(start).min(x(start + TAU)), x(start).max(x(start + TAU)));
        let (low, high) = (MILLIMETRES * self.ends.0, MILLIMETRES * self.ends.1);
        let corners = [(left, low), (right, low), (right, high), (left, high)].map(|(x, y)| Vector2::new(x, y));
        let line = |start: Vector2<f64>, end: Vector2<f64>| Segment { start, end, bulge: 0.0 };
        let [a, b, c, d] = corners;
        [line(a, b), line(b, c), line(c, d), line(d, a)]
    }

    /// How far a flank is, on the cylinder of a radius (m), from the curve at its distance from the unrolled centre line of the roller there, which is what
    /// drawings customarily show, m: the largest of both flanks.
    pub(super) fn offset_error(&self, radius: f64) -> Worst {
        self.farthest(|side, at| self.edge(side, radius, at).map(|found| (at.1 + found.ahead, found.height)), radius)
    }

    /// How far walls drawn radially from the outside are, on the cylinder of a radius (m), from that curve there, m.
    pub(super) fn radial_error(&self, radius: f64) -> Worst {
        self.farthest(
            |side, at| self.edge(side, self.outer, at).map(|found| (at.1 + found.ahead, found.height)),
            radius,
        )
    }

    /// The largest distance of places (angle and height) of both flanks from the offset of the unrolled centre line on the cylinder of a radius, m.
    fn farthest(&self, place: impl Fn(FlankSide, (usize, f64)) -> Option<(f64, f64)>, radius: f64) -> Worst {
        let mut worst = Worst { value: 0.0, ..Worst::NONE };
        for (piece, angle) in self.groove.places() {
            for side in FlankSide::BOTH {
                let Some((polar, height)) = place(side, (piece, angle)) else { continue };
                let due = self.axis(piece, angle).radius_at(radius, self.groove.signed(side).abs());
                let off = (self.distance_unrolled((polar, height), radius) - due).abs();
                if off > worst.value {
                    worst = Worst { value: off, at: angle, z: 0.0 };
                }
            }
        }
        worst
    }

    /// Distance of a place (angle and height, m) from the centre line of the roller unrolled at a radius, m.
    fn distance_unrolled(&self, (polar, height): (f64, f64), radius: f64) -> f64 {
        let see = |angle: f64| {
            let (piece, inside) = self.groove.motion.locate(angle);
            let line = self.axis(piece, inside);
            let axis = line.axis();
            let x = radius * (polar - angle) - axis.across[0];
            SeenPoint {
                off: [x, height - axis.along[0]],
                first: [-radius - axis.across[1], -axis.along[1]],
                second: [-axis.across[2], -axis.along[2]],
                rise: (0.0, 1.0),
            }
        };
        let [a, b] = nearest_about(polar, self.groove.farther() / radius, see).seen.off;
        libm::hypot(a, b)
    }
}

/// Lines that follow each other on one line as one.
fn joined(arcs: Vec<Segment>) -> Vec<Segment> {
    let mut all: Vec<Segment> = Vec::with_capacity(arcs.len());
    for arc in arcs {
        match all.last_mut() {
            Some(last)
                if last.bulge == 0.0 && arc.bulge == 0.0 && last.start.y == arc.end.y && last.end.y == arc.end.y =>
            {
                last.end = arc.end;
            }
            _ => all.push(arc),
        }
    }
    all
}

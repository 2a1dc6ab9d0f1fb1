//! The registration of one outline to another: the rotation, shift, scale and offset with which they agree best.
//!
//! Points of the one are mapped back onto the other, and the sum of the squares of their distances from it is minimised: Gauss–Newton
//! steps, damped where they overshoot (Marquardt 1963), with the normal at the nearest point for the slope of the distance
//! (Chen & Medioni 1992). The remaining distance is measured in both directions, so that no part of either outline is left out.

use super::contour::Contour;
use super::edge_tree::EdgeTree;
use nalgebra::{SMatrix, SVector, Vector2};
use std::f64::consts::TAU;

/// Points along an outline for the fit, for a first look at many angles, and for the remaining distance.
const FITTED: usize = 240;
const LOOKED: usize = 60;
const MEASURED: usize = 2000;
/// Angles of the first look, two degrees apart, and how many of the best are followed.
const ANGLES: u32 = 180;
const FOLLOWED: usize = 3;
/// Steps of a fit; it takes about six.
const STEPS: usize = 40;
/// Damping, as a share of the diagonal: at the start, and where no step helps any more.
const LEAST_DAMPING: f64 = 1e-9;
const MOST_DAMPING: f64 = 1e3;
/// A sum of squares that falls by less than this share has reached its minimum.
const SETTLED: f64 = 1e-14;

/// Changes that map one outline to another: offset, then scaled, turned and shifted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Registration {
    /// Turn counter-clockwise about the origin, rad.
    pub turn: f64,
    /// Shift, mm.
    pub shift: Vector2<f64>,
    /// Factor about the origin.
    pub scale: f64,
    /// Distance outward along the normal, mm.
    pub offset: f64,
}

/// Which of the changes are free; the others stay as they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[expect(clippy::struct_excessive_bools, reason = "four changes, in any combination")]
pub struct FreeParameters {
    /// The turn.
    pub turn: bool,
    /// The shift.
    pub shift: bool,
    /// The factor.
    pub scale: bool,
    /// The offset.
    pub offset: bool,
}

/// An outline, prepared for registration.
pub struct RegistrationOutline {
    tree: EdgeTree,
    looked: Vec<Vector2<f64>>,
    fitted: Vec<Vector2<f64>>,
    measured: Vec<Vector2<f64>>,
    area: f64,
    centroid: Vector2<f64>,
    length: f64,
}

impl Registration {
    /// No change.
    pub const SAME: Registration = Registration { turn: 0.0, shift: Vector2::new(0.0, 0.0), scale: 1.0, offset: 0.0 };

    /// The image of a point of the original, without the offset.
    fn moved(&self, point: Vector2<f64>) -> Vector2<f64> {
        turned(point, self.turn) * self.scale + self.shift
    }

    /// The original of a point.
    fn back(&self, point: Vector2<f64>) -> Vector2<f64> {
        turned(point - self.shift, -self.turn) / self.scale
    }
}

fn turned(point: Vector2<f64>, angle: f64) -> Vector2<f64> {
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    Vector2::new(cos * point.x - sin * point.y, sin * point.x + cos * point.y)
}

/// This many points along a contour, evenly by its length.
fn along(contour: &Contour, length: f64, count: usize) -> Vec<Vector2<f64>> {
    #[expect(clippy::cast_precision_loss, reason = "a few thousand")]
    let step = length / count as f64;
    let (mut passed, mut next) = (0.0, 0.5 * step);
    let mut points = Vec::with_capacity(count);
    for edge in contour.edges() {
        let own = edge.length();
        while next < passed + own && points.len() < count {
            points.push(edge.point_and_tangent((next - passed) / own).0);
            next += step;
        }
        passed += own;
    }
    points
}

impl RegistrationOutline {
    /// A contour that runs counter-clockwise; `None` for one that encloses nothing or is not finite.
    #[must_use]
    pub fn new(contour: &Contour) -> Option<Self> {
        let (length, (area, centroid)) = (contour.length(), contour.area_and_centroid());
        if !(length.is_finite() && length > 0.0 && area.is_finite() && area > 0.0) {
            return None;
        }
        Some(Self {
            tree: EdgeTree::new(contour),
            looked: along(contour, length, LOOKED),
            fitted: along(contour, length, FITTED),
            measured: along(contour, length, MEASURED),
            area,
            centroid,
            length,
        })
    }

    /// Distance of a point, positive outside, and the outward normal there.
    fn outside(&self, point: Vector2<f64>) -> (f64, Vector2<f64>) {
        self.tree.nearest(point).map_or((f64::INFINITY, Vector2::zeros()), |nearest| {
            (-nearest.left, Vector2::new(nearest.tangent.y, -nearest.tangent.x))
        })
    }

    /// Root of the mean square of the distances of another outline's points from this one, mm.
    #[must_use]
    pub fn mean_distance(&self, other: &Self) -> f64 {
        mean_square(self, &other.fitted, &Registration::SAME).sqrt()
    }

    /// The changes, of those that are free, that map this outline best to `found`.
    #[must_use]
    pub fn registration(&self, found: &Self, free: FreeParameters) -> Registration {
        let fits = starts(self, found, free).into_iter().map(|start| fit(self, found, free, start));
        let best = fits.min_by(|a, b| a.1.total_cmp(&b.1));
        best.map_or(Registration::SAME, |(registration, _)| registration)
    }

    /// The largest distance between this outline, changed, and `found`, in both directions, in mm of this outline.
    #[must_use]
    pub fn remaining(&self, found: &Self, registration: &Registration) -> f64 {
        let there = found.measured.iter().map(|p| self.outside(registration.back(*p)).0 - registration.offset);
        let back = self
            .measured
            .iter()
            .map(|p| found.outside(registration.moved(*p)).0 / registration.scale + registration.offset);
        there.chain(back).map(f64::abs).fold(0.0, f64::max)
    }

    /// The largest distance of one of these points from this outline, mm.
    #[must_use]
    pub fn farthest(&self, points: &[Vector2<f64>]) -> f64 {
        points.iter().map(|point| self.outside(*point).0.abs()).fold(0.0, f64::max)
    }
}

fn mean_square(model: &RegistrationOutline, points: &[Vector2<f64>], registration: &Registration) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a few thousand")]
    let count = points.len().max(1) as f64;
    points
        .iter()
        .map(|p| {
            let off = model.outside(registration.back(*p)).0 - registration.offset;
            off * off
        })
        .sum::<f64>()
        / count
}

/// Starts of a fit: sizes and centroids brought together, at the most promising angles.
fn starts(model: &RegistrationOutline, found: &RegistrationOutline, free: FreeParameters) -> Vec<Registration> {
    let scale = if free.scale { (found.area / model.area).sqrt() } else { 1.0 };
    let offset = if free.offset && !free.scale { (found.area - model.area) / model.length } else { 0.0 };
    let turns = (0..if free.turn { ANGLES } else { 1 }).map(|step| TAU * f64::from(step) / f64::from(ANGLES));
    let starts = turns.map(|turn| {
        let unshifted = Registration { turn, shift: Vector2::zeros(), scale, offset };
        let shift = if free.shift { found.centroid - unshifted.moved(model.centroid) } else { Vector2::zeros() };
        Registration { shift, ..unshifted }
    });
    let starts: Vec<Registration> = starts.collect();
    if !free.turn {
        return starts;
    }
    let looks: Vec<f64> = starts.iter().map(|start| mean_square(model, &found.looked, start)).collect();
    let before = looks.iter().cycle().skip(looks.len() - 1);
    let after = looks.iter().cycle().skip(1);
    let mut lowest: Vec<(f64, Registration)> = Vec::new();
    for (((look, before), after), start) in looks.iter().zip(before).zip(after).zip(starts) {
        if look <= after && look <= before {
            lowest.push((*look, start));
        }
    }
    lowest.sort_by(|a, b| a.0.total_cmp(&b.0));
    lowest.into_iter().take(FOLLOWED).map(|(_, start)| start).collect()
}

type NormalEquations = (SMatrix<f64, 5, 5>, SVector<f64, 5>);

/// The normal equations of the steps of turn, shift, factor and offset. Turn and factor are multiplied by `size`, so that every
/// unknown is a length.
fn normal_equations(
    model: &RegistrationOutline,
    found: &RegistrationOutline,
    free: FreeParameters,
    at: &Registration,
    size: f64,
) -> NormalEquations {
    let wanted = [free.turn, free.shift, free.shift, free.scale, free.offset];
    let (mut matrix, mut right) = (SMatrix::<f64, 5, 5>::zeros(), SVector::<f64, 5>::zeros());
    for point in &found.fitted {
        let original = at.back(*point);
        let (distance, normal) = model.outside(original);
        let pushed = -turned(normal, at.turn) / at.scale;
        // The slopes of the point mapped back, along the normal.
        let slopes = [
            normal.dot(&Vector2::new(original.y, -original.x)) / size,
            pushed.x,
            pushed.y,
            -normal.dot(&original) / (at.scale * size),
            -1.0,
        ];
        let row = SVector::<f64, 5>::from_fn(|i, _| match (slopes.get(i), wanted.get(i)) {
            (Some(slope), Some(true)) => *slope,
            _ => 0.0,
        });
        matrix += row * row.transpose();
        right -= row * (distance - at.offset);
    }
    (matrix, right)
}

/// The fitted changes from a start on, and the remaining mean square.
fn fit(
    model: &RegistrationOutline,
    found: &RegistrationOutline,
    free: FreeParameters,
    start: Registration,
) -> (Registration, f64) {
    let size = model.area.sqrt();
    let (mut at, mut left) = (start, mean_square(model, &found.fitted, &start));
    let mut damping = LEAST_DAMPING;
    let mut equations = normal_equations(model, found, free, &at, size);
    for _ in 0..STEPS {
        let (mut matrix, right) = equations;
        // A change that is not free, or has no effect, stays.
        let floor = SETTLED * matrix.trace();
        for i in 0..5 {
            matrix[(i, i)] += damping * matrix[(i, i)] + floor;
        }
        let Some(step) = matrix.cholesky().map(|factors| factors.solve(&right)) else { break };
        let next = Registration {
            turn: at.turn + step[0] / size,
            shift: at.shift + Vector2::new(step[1], step[2]),
            scale: at.scale + step[3] / size,
            offset: at.offset + step[4],
        };
        let square = if next.scale > 0.0 { mean_square(model, &found.fitted, &next) } else { f64::INFINITY };
        if square < left {
            let settled = left - square <= SETTLED * left;
            (at, left, damping) = (next, square, (0.1 * damping).max(LEAST_DAMPING));
            if settled {
                break;
            }
            equations = normal_equations(model, found, free, &at, size);
        } else {
            damping *= 10.0;
            if damping > MOST_DAMPING {
                break;
            }
        }
    }
    (at, left)
}

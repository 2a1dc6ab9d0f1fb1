//! The curve that a control makes of a table of points: between the rows, with exact derivatives.
//!
//! | | linear | cubic |
//! |---|---|---|
//! | x, y | the chord from row to row | the cubic spline x(s), y(s) by the chord length s summed up from row to row |
//! | polar | the radius linear in the angle, an arc of Archimedes' spiral | the cubic spline of the radius over the angle |
//!
//! A cubic spline has continuous first and second derivatives. Over a closed table without double rows it is periodic. A row that
//! occurs twice is a break, at a corner or where the acceleration jumps: there one spline ends and the next begins, each with
//! "not-a-knot" ends; the same holds at the ends of an open table, and of a closed one with breaks. The first row occurs
//! twice where the break is the start of a closed table.

use super::{PointCoordinates, PointInterpolation};
use crate::geometry::CurvePoint;
use crate::geometry::contour::{Cubic, Edge, Segment};
use crate::numeric::spline::Spline;
use nalgebra::Vector2;
use std::ops::Range;

/// The curve from one row to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
struct RowInterval {
    /// Its parameter at the two rows: the angle in rad, or the chord length in mm.
    from: f64,
    to: f64,
    /// Coefficients of the radius, or of x, by the parameter from `from` on.
    first: [f64; 4],
    /// Coefficients of y; zero in polar coordinates.
    second: [f64; 4],
}

/// The curve through the rows of a table, an interval from each row to the next, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Interpolant {
    form: PointCoordinates,
    straight: bool,
    intervals: Vec<RowInterval>,
}

/// Value and first three derivatives of a cubic.
fn jet([a, b, c, d]: [f64; 4], t: f64) -> [f64; 4] {
    [((d * t + c) * t + b) * t + a, (3.0 * d * t + 2.0 * c) * t + b, 6.0 * d * t + 2.0 * c, 6.0 * d]
}

impl Interpolant {
    /// Through the rows of a table (degrees and mm, or x and y in mm); `closed` where the last row repeats the first.
    #[must_use]
    pub fn new(rows: &[[f64; 2]], form: PointCoordinates, between: PointInterpolation, closed: bool) -> Self {
        let (mut knots, mut so_far) = (Vec::with_capacity(rows.len()), 0.0);
        let mut before: Option<&[f64; 2]> = None;
        for row in rows {
            so_far += before.map_or(0.0, |[x, y]| libm::hypot(row[0] - x, row[1] - y));
            knots.push(match form {
                PointCoordinates::Polar => row[0].to_radians(),
                PointCoordinates::Plane => so_far,
            });
            before = Some(row);
        }
        let [first, second] = match form {
            PointCoordinates::Polar => [rows.iter().map(|row| row[1]).collect(), vec![0.0; rows.len()]],
            PointCoordinates::Plane => {
                [0, 1].map(|axis: usize| rows.iter().map(|row| if axis == 0 { row[0] } else { row[1] }).collect())
            }
        };
        let [first, second] = [first, second].map(|values: Vec<f64>| match between {
            PointInterpolation::Linear => linear(&knots, &values),
            PointInterpolation::Cubic => cubic(&knots, &values, &runs(rows), closed),
        });
        let ranges = knots.iter().zip(knots.iter().skip(1));
        let intervals = ranges
            .zip(first.into_iter().zip(second))
            .map(|((from, to), (first, second))| RowInterval { from: *from, to: *to, first, second })
            .collect();
        Self { form, straight: form == PointCoordinates::Plane && between == PointInterpolation::Linear, intervals }
    }

    /// Its intervals as lines and cubic curves; `None` in polar coordinates, where they are of another kind.
    #[must_use]
    pub fn edges(&self) -> Option<Vec<Edge>> {
        if self.form != PointCoordinates::Plane {
            return None;
        }
        // The two rows of a double row have no interval between them.
        let long = self.intervals.iter().filter(|interval| interval.from < interval.to);
        let edges = long.map(|interval| {
            let length = interval.to - interval.from;
            let [(start, leaves), (end, arrives)] = [0.0, length].map(|t| {
                let (x, y) = (jet(interval.first, t), jet(interval.second, t));
                (Vector2::new(x[0], y[0]), Vector2::new(x[1], y[1]) * (length / 3.0))
            });
            if self.straight {
                Edge::Segment(Segment { start, end, bulge: 0.0 })
            } else {
                Edge::Cubic(Cubic { points: [start, start + leaves, end - arrives, end] })
            }
        });
        Some(edges.collect())
    }

    /// The number of its intervals: one less than the table has rows.
    #[must_use]
    pub fn count(&self) -> usize {
        self.intervals.len()
    }

    /// Whether its intervals are chords.
    #[must_use]
    pub fn is_straight(&self) -> bool {
        self.straight
    }

    /// The parameter at both ends of an interval.
    #[must_use]
    pub fn range(&self, interval: usize) -> Option<(f64, f64)> {
        self.intervals.get(interval).map(|interval| (interval.from, interval.to))
    }

    /// The point at a parameter of an interval, mm.
    #[must_use]
    pub fn point_at(&self, interval: usize, parameter: f64) -> Option<CurvePoint> {
        let interval = self.intervals.get(interval)?;
        let t = parameter - interval.from;
        let ([a, b, c, d], [y, y1, y2, y3]) = (jet(interval.first, t), jet(interval.second, t));
        Some(match self.form {
            PointCoordinates::Plane => CurvePoint::from_derivatives(
                Vector2::new(a, y),
                Vector2::new(b, y1),
                Vector2::new(c, y2),
                Vector2::new(d, y3),
            ),
            PointCoordinates::Polar => {
                let along = Vector2::new(libm::cos(parameter), libm::sin(parameter));
                let across = Vector2::new(-along.y, along.x);
                CurvePoint::from_derivatives(
                    along * a,
                    along * b + across * a,
                    along * (c - a) + across * (2.0 * b),
                    along * (d - 3.0 * b) + across * (3.0 * c - a),
                )
            }
        })
    }

    /// The speed at a parameter of an interval, mm per unit of the parameter.
    #[must_use]
    pub fn speed(&self, interval: usize, parameter: f64) -> f64 {
        let Some(interval) = self.intervals.get(interval) else { return f64::NAN };
        let t = parameter - interval.from;
        let ([value, slope, ..], [_, other, ..]) = (jet(interval.first, t), jet(interval.second, t));
        match self.form {
            PointCoordinates::Plane => libm::hypot(slope, other),
            PointCoordinates::Polar => libm::hypot(slope, value),
        }
    }
}

fn linear(knots: &[f64], values: &[f64]) -> Vec<[f64; 4]> {
    let widths = knots.iter().zip(knots.iter().skip(1)).map(|(from, to)| to - from);
    let rises = values.iter().zip(values.iter().skip(1));
    widths.zip(rises).map(|(width, (from, to))| [*from, (to - from) / width, 0.0, 0.0]).collect()
}

/// The runs of rows between double rows.
fn runs(rows: &[[f64; 2]]) -> Vec<Range<usize>> {
    let mut runs = Vec::new();
    let mut start = 0;
    for (index, (row, next)) in rows.iter().zip(rows.iter().skip(1)).enumerate() {
        if row == next {
            runs.push(start..index + 1);
            start = index + 1;
        }
    }
    runs.push(start..rows.len());
    runs
}

fn cubic(knots: &[f64], values: &[f64], runs: &[Range<usize>], closed: bool) -> Vec<[f64; 4]> {
    let mut cubics: Vec<[f64; 4]> = Vec::with_capacity(knots.len());
    for run in runs {
        let (Some(knots), Some(values)) = (knots.get(run.clone()), values.get(run.clone())) else { continue };
        // The two rows of a double row have no interval between them.
        if let Some(value) = values.first().filter(|_| run.start > 0) {
            cubics.push([*value, 0.0, 0.0, 0.0]);
        }
        // The first of a double row that begins the table.
        if knots.len() < 2 {
            continue;
        }
        let spline =
            if closed && runs.len() == 1 { Spline::periodic(knots, values) } else { Spline::not_a_knot(knots, values) };
        cubics.extend_from_slice(spline.cubics());
    }
    cubics
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: [[f64; 2]; 6] = [[0.0, 10.0], [50.0, 11.0], [130.0, 14.0], [200.0, 13.0], [290.0, 9.5], [360.0, 10.0]];

    fn in_plane(rows: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let point = |row: &[f64; 2]| {
            let angle = row[0].to_radians();
            [row[1] * libm::cos(angle), row[1] * libm::sin(angle)]
        };
        rows.iter().map(point).collect()
    }

    /// Every interval starts and ends on its rows, and its derivatives belong to its points.
    #[test]
    fn intervals_join_the_rows_and_have_their_own_derivatives() {
        for form in [PointCoordinates::Polar, PointCoordinates::Plane] {
            for between in [PointInterpolation::Linear, PointInterpolation::Cubic] {
                let points = in_plane(&ROWS);
                let rows = if form == PointCoordinates::Polar { ROWS.to_vec() } else { points.clone() };
                for closed in [true, false] {
                    let curve = Interpolant::new(&rows, form, between, closed);
                    assert_eq!(curve.count(), rows.len() - 1);
                    for interval in 0..curve.count() {
                        let (from, to) = curve.range(interval).expect("an interval");
                        let at = |u: f64| curve.point_at(interval, u).expect("a point");
                        for (u, point) in [(from, points[interval]), (to, points[interval + 1])] {
                            assert!((at(u).point - Vector2::from(point)).norm() < 1e-12, "{form:?} {between:?}");
                        }
                        let (u, h) = (0.5 * (from + to), 1e-4 * (to - from));
                        let difference = (at(u + h).point - at(u - h).point) / (2.0 * h);
                        let here = at(u);
                        assert!((difference - here.tangent * here.speed).norm() < 1e-6 * here.speed);
                        assert!((here.speed - curve.speed(interval, u)).abs() < 1e-12 * here.speed);
                        let turn = (at(u + h).tangent - at(u - h).tangent) / (2.0 * h);
                        let bend = here.tangent.perp(&turn) / here.speed;
                        assert!((bend - here.curvature).abs() < 1e-6 * (1.0 + bend.abs()), "{form:?} {between:?}");
                    }
                }
            }
        }
    }

    /// A double row breaks the spline: what lies beyond it does not matter.
    #[test]
    fn a_double_row_ends_a_spline() {
        let mut rows = ROWS.to_vec();
        rows.insert(3, rows[2]);
        let broken = Interpolant::new(&rows, PointCoordinates::Polar, PointInterpolation::Cubic, true);
        let alone = Interpolant::new(&rows[..3], PointCoordinates::Polar, PointInterpolation::Cubic, false);
        assert_eq!(broken.count(), 6);
        for u in [0.1, 0.5, 1.3] {
            let interval = usize::from(u > 50.0_f64.to_radians());
            assert_eq!(broken.point_at(interval, u), alone.point_at(interval, u));
        }
        assert_eq!(broken.range(2).map(|(from, to)| to - from), Some(0.0));
    }
}

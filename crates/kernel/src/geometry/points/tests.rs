use super::*;
use crate::geometry::CurvePoint;
use crate::geometry::boundary::{Boundary, BoundaryStretch};
use nalgebra::Vector2;
use std::f64::consts::{PI, TAU};

/// A circle of radius 50 mm about (8, 3) mm, counter-clockwise, in stretches.
fn eccentric<'a>() -> ExactPath<'a> {
    let frame = |_: usize, at: f64| {
        let (sin, cos) = (libm::sin(at), libm::cos(at));
        CurvePoint::from_derivatives(
            Vector2::new(8.0 + 50.0 * cos, 3.0 + 50.0 * sin),
            Vector2::new(-50.0 * sin, 50.0 * cos),
            Vector2::new(-50.0 * cos, -50.0 * sin),
            Vector2::new(50.0 * sin, -50.0 * cos),
        )
    };
    let stretch = |i: u32| BoundaryStretch::of_curve(0, PI * f64::from(i) / 4.0, PI * f64::from(i + 1) / 4.0);
    let stretches: Vec<BoundaryStretch> = (0..8).map(stretch).collect();
    ExactPath::new(Boundary::new(Box::new(frame), &stretches), true)
}

fn wishes(tolerance: f64) -> Vec<PointTableSpec> {
    let mut wishes = Vec::new();
    for form in [PointCoordinates::Polar, PointCoordinates::Plane] {
        for step in [PointStep::Angle, PointStep::Chord] {
            for between in [PointInterpolation::Linear, PointInterpolation::Cubic] {
                wishes.push(PointTableSpec { form, step, between, tolerance });
            }
        }
    }
    wishes
}

/// The distance from a circle is known in closed form: at a thousand places of every table it is below the reported one, and
/// somewhere nearly as much.
#[test]
fn the_reported_error_of_a_circle_is_its_distance() {
    for tolerance in [0.1, 5e-3, 1e-4] {
        for wish in wishes(tolerance) {
            let table = place(&eccentric(), &wish, None).unwrap_or_else(|error| panic!("{wish:?}: {error}"));
            assert!(table.error <= tolerance, "{wish:?}: {}", table.error);
            let curve = Interpolant::new(&table.rows, wish.form, wish.between, true);
            let mut worst: f64 = 0.0;
            for interval in 0..curve.count() {
                let (from, to) = curve.range(interval).expect("an interval");
                for i in 0..=40 {
                    let point =
                        curve.point_at(interval, from + (to - from) * f64::from(i) / 40.0).expect("a point").point;
                    worst = worst.max(((point - Vector2::new(8.0, 3.0)).norm() - 50.0).abs());
                }
            }
            assert!(worst <= table.error + 1e-10, "{wish:?}: {worst} above {}", table.error);
            assert!(worst >= 0.99 * table.error - 2e-10, "{wish:?}: {worst} far below {}", table.error);
            assert!(
                table.error > 0.7 * tolerance || table.intervals < 30,
                "{wish:?}: {} of {}",
                table.error,
                table.intervals
            );
        }
    }
}

/// Chords of a circle of radius R turn by 2 acos(1 − tolerance/R): this gives their exact number.
#[test]
fn as_few_chords_as_a_circle_needs() {
    for tolerance in [0.1, 5e-3, 1e-4] {
        let wish = PointTableSpec {
            form: PointCoordinates::Plane,
            step: PointStep::Chord,
            between: PointInterpolation::Linear,
            tolerance,
        };
        let table = place(&eccentric(), &wish, None).expect("a table");
        let least = (PI / libm::acos(1.0 - tolerance / 50.0)).ceil();
        let intervals = f64::from(u32::try_from(table.intervals).expect("few"));
        assert!(intervals >= least && intervals <= 1.01 * least + 1.0, "{tolerance}: {intervals} of {least}");
    }
}

/// With one point less at equal angles, the tolerance is not kept any more.
#[test]
fn as_few_angles_as_the_tolerance_allows() {
    for wish in wishes(2e-3).into_iter().filter(|wish| wish.step == PointStep::Angle) {
        let table = place(&eccentric(), &wish, None).expect("a table");
        let closer = PointTableSpec { tolerance: table.error * 0.999_9, ..wish };
        let more = place(&eccentric(), &closer, None).expect("a table");
        assert!(more.intervals > table.intervals, "{wish:?}: {} {}", more.intervals, table.intervals);
        assert!(more.intervals <= table.intervals + 2, "{wish:?}: {} {}", more.intervals, table.intervals);
    }
}

/// Every interval has the same error.
#[test]
fn errors_are_equal_by_chord_error() {
    for between in [PointInterpolation::Linear, PointInterpolation::Cubic] {
        for form in [PointCoordinates::Polar, PointCoordinates::Plane] {
            let wish = PointTableSpec { form, step: PointStep::Chord, between, tolerance: 1e-4 };
            let path = eccentric();
            let table = place(&path, &wish, None).expect("a table");
            let curve = Interpolant::new(&table.rows, form, between, true);
            let errors = deviations(&path, &curve, &table.places, 0.0, f64::INFINITY).expect("followed");
            let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
            // A polar table has inflections, where the error of an interval changes its sign.
            let share = if form == PointCoordinates::Polar { 0.1 } else { 0.7 };
            assert!(least > share * table.error, "{wish:?}: {least} of {}, {}", table.error, table.intervals);
        }
    }
}

/// A row that is off, or one that is missing, is found.
#[test]
fn a_wrong_row_is_found() {
    for wish in wishes(1e-3) {
        let path = eccentric();
        let table = place(&path, &wish, None).expect("a table");
        for change in [0.01, -0.01] {
            for column in [0, 1] {
                let mut rows = table.rows.clone();
                rows[table.rows.len() / 3][column] += change;
                let curve = Interpolant::new(&rows, wish.form, wish.between, true);
                let found = deviations(&path, &curve, &table.places, 0.0, f64::INFINITY);
                let worst = found.map(|errors| errors.into_iter().fold(0.0, f64::max));
                assert!(worst.is_err() || worst.is_ok_and(|worst| worst > 1e-3), "{wish:?} {column} {change}");
            }
        }
    }
}

#[test]
fn what_has_no_table_is_refused() {
    let wish = PointTableSpec {
        form: PointCoordinates::Polar,
        step: PointStep::Angle,
        between: PointInterpolation::Linear,
        tolerance: 1e-11,
    };
    let error = place(&eccentric(), &wish, None).expect_err("too many").to_string();
    assert!(error.contains(" mm would need more than "), "{error}");
    // A circle that the shaft is not in.
    let frame = |_: usize, at: f64| {
        let (sin, cos) = (libm::sin(at), libm::cos(at));
        let (first, third) = (Vector2::new(-sin, cos), Vector2::new(sin, -cos));
        CurvePoint::from_derivatives(Vector2::new(8.0 + cos, sin), first, Vector2::new(-cos, -sin), third)
    };
    let halves = [BoundaryStretch::of_curve(0, 0.0, PI), BoundaryStretch::of_curve(0, PI, TAU)];
    let path = ExactPath::new(Boundary::new(Box::new(frame), &halves), true);
    let wish = PointTableSpec { tolerance: 1e-3, ..wish };
    let error = place(&path, &wish, None).expect_err("not around").to_string();
    assert!(error.starts_with("the angle about the shaft does not determine the points"), "{error}");
    let plane = PointTableSpec { form: PointCoordinates::Plane, step: PointStep::Chord, ..wish };
    assert!(place(&path, &plane, None).is_ok_and(|table| table.error <= 1e-3));
}

/// r = 50 + 5 sin(θ/2 − turn/2) mm about the shaft: smooth but for one corner, at a polar angle.
fn drop<'a>(turn: f64) -> ExactPath<'a> {
    let frame = move |_: usize, at: f64| {
        let (sin, cos) = (libm::sin(0.5 * (at - turn)), libm::cos(0.5 * (at - turn)));
        let [r, r1, r2, r3] = [50.0 + 5.0 * sin, 2.5 * cos, -1.25 * sin, -0.625 * cos];
        let along = Vector2::new(libm::cos(at), libm::sin(at));
        let across = Vector2::new(-along.y, along.x);
        CurvePoint::from_derivatives(
            along * r,
            along * r1 + across * r,
            along * (r2 - r) + across * (2.0 * r1),
            along * (r3 - 3.0 * r1) + across * (3.0 * r2 - r),
        )
    };
    let place = |i: u32| turn + PI * f64::from(i) / 4.0;
    let stretches: Vec<BoundaryStretch> =
        (0..8).map(|i| BoundaryStretch::of_curve(0, place(i), place(i + 1))).collect();
    ExactPath::new(Boundary::new(Box::new(frame), &stretches), true)
}

/// A corner exactly where the table starts is an ordinary corner: no spline crosses it, and its row occurs twice there.
#[test]
fn a_corner_may_be_where_the_table_starts() {
    for (turn, at_start) in [(0.0, true), (1.0, false), (-1e-13, true), (1e-13, true)] {
        for tolerance in [0.01, 1e-4] {
            for wish in wishes(tolerance) {
                let path = drop(turn);
                let table = place(&path, &wish, None).unwrap_or_else(|error| panic!("{wish:?}: {error}"));
                assert_eq!((table.corners, table.jumps), (1, 0), "{wish:?} {turn}");
                let doubles: Vec<usize> =
                    (1..table.rows.len()).filter(|index| table.rows[*index] == table.rows[*index - 1]).collect();
                assert_eq!(doubles.len(), usize::from(wish.between == PointInterpolation::Cubic), "{wish:?} {turn}");
                assert!(!at_start || doubles.iter().all(|index| *index == 1), "{wish:?}: {doubles:?}");
                let curve = Interpolant::new(&table.rows, wish.form, wish.between, true);
                let mut worst: f64 = 0.0;
                for interval in 0..curve.count() {
                    let (from, to) = curve.range(interval).expect("an interval");
                    for i in 1..40 {
                        let point =
                            curve.point_at(interval, from + (to - from) * f64::from(i) / 40.0).expect("a point").point;
                        let angle = (libm::atan2(point.y, point.x) - turn).rem_euclid(TAU);
                        let radius = 50.0 + 5.0 * libm::sin(0.5 * angle);
                        // The curve departs from the perpendicular of the ray by no more than 2.5 in 50.
                        worst = worst.max((point.norm() - radius).abs() * 0.998);
                    }
                }
                assert!(worst <= table.error + 1e-9 && table.error <= tolerance, "{wish:?} {turn}: {worst}");
                assert!(worst > 0.9 * table.error, "{wish:?} {turn}: {worst} of {}", table.error);
                // As few rows as where the corner is elsewhere, except for its own row.
                let elsewhere = place(&drop(0.3), &wish, None).expect("a table").intervals;
                let few = wish.step == PointStep::Angle || table.intervals <= elsewhere + 2;
                assert!(few, "{wish:?} {turn}: {} {elsewhere}", table.intervals);
            }
        }
    }
}

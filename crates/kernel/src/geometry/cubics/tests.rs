use super::*;
use nalgebra::Vector2;
use std::f64::consts::{FRAC_PI_2, PI};

/// An ellipse by its parameter.
fn ellipse(a: f64, b: f64) -> impl Fn(f64) -> CurvePoint {
    move |t| {
        let (sin, cos) = (libm::sin(t), libm::cos(t));
        CurvePoint::from_derivatives(
            Vector2::new(a * cos, b * sin),
            Vector2::new(-a * sin, b * cos),
            Vector2::new(-a * cos, -b * sin),
            Vector2::new(a * sin, -b * cos),
        )
    }
}

/// A radius of 50 with a bump of a height and a width (rad) at a place.
fn bumped(height: f64, width: f64, place: f64) -> impl Fn(f64) -> CurvePoint {
    move |t: f64| {
        let x = (t - place) / width;
        let g = height * libm::exp(-x * x);
        let radii = [
            50.0 + g,
            -2.0 * x * g / width,
            (4.0 * x * x - 2.0) * g / (width * width),
            (12.0 - 8.0 * x * x) * x * g / (width * width * width),
        ];
        let u = Vector2::new(libm::cos(t), libm::sin(t));
        let v = Vector2::new(-u.y, u.x);
        let [r, d, dd, ddd] = radii;
        CurvePoint::from_derivatives(
            u * r,
            u * d + v * r,
            u * (dd - r) + v * (2.0 * d),
            u * (ddd - 3.0 * d) + v * (3.0 * dd - r),
        )
    }
}

fn any(_: f64, _: &CurvePoint) -> ChainTolerance {
    ChainTolerance::ANY
}

fn count(fitted: &FittedSpline) -> f64 {
    f64::from(u32::try_from(fitted.spline.spans()).expect("few"))
}

/// The largest distance, heading and difference of curvature from many places of the spline, each with its nearest point of
/// the curve among many, found without anything of the fit; the last also as the share of what is allowed.
fn scanned(
    curve: &impl Fn(f64) -> CurvePoint,
    range: (f64, f64),
    fitted: &FittedSpline,
    allowed: &dyn Fn(f64, &CurvePoint) -> ChainTolerance,
) -> ([f64; 3], f64) {
    let (mut worst, mut share) = ([0.0_f64; 3], 0.0_f64);
    let mut parameter = range.0;
    for piece in fitted.spline.pieces() {
        for i in 0..=300 {
            let (t, s) = (f64::from(i) / 300.0, 1.0 - f64::from(i) / 300.0);
            let legs = [piece[1] - piece[0], piece[2] - piece[1], piece[3] - piece[2]];
            let point = piece[0] * (s * s * s)
                + piece[1] * (3.0 * s * s * t)
                + piece[2] * (3.0 * s * t * t)
                + piece[3] * (t * t * t);
            let first = (legs[0] * (s * s) + legs[1] * (2.0 * s * t) + legs[2] * (t * t)) * 3.0;
            let second = ((legs[1] - legs[0]) * s + (legs[2] - legs[1]) * t) * 6.0;
            for _ in 0..60 {
                let frame = curve(parameter);
                let ahead = (point - frame.point).dot(&frame.tangent);
                let away = (point - frame.point).dot(&frame.outward());
                let next = parameter + ahead / (frame.speed * (1.0 + frame.curvature * away));
                parameter = next.clamp(range.0, range.1);
                if ahead.abs() < 1e-14 {
                    break;
                }
            }
            let frame = curve(parameter);
            let found = [
                (point - frame.point).norm(),
                libm::asin(frame.tangent.perp(&first) / first.norm()).abs(),
                (first.perp(&second) / first.norm().powi(3) - frame.curvature).abs(),
            ];
            for (worst, found) in worst.iter_mut().zip(found) {
                *worst = worst.max(found);
            }
            let limit = allowed(parameter, &frame);
            share = share.max(found[1] / limit.heading).max(found[2] / limit.curvature);
        }
    }
    (worst, share)
}

/// The number of spans compared with theory over four decades; the reported errors compared with many places, and not far above them even
/// where they do not matter.
#[test]
fn the_count_stays_near_theory_and_the_reported_errors_are_true() {
    for (a, b) in [(60.0, 40.0), (50.0, 50.0), (60.0, 2.0)] {
        let curve = ellipse(a, b);
        for decade in [-2, -4, -6] {
            let tolerance = libm::pow(10.0, f64::from(decade));
            for range in [(0.0, FRAC_PI_2), (0.3, 2.0), (0.0, PI), (-1.4, 1.4)] {
                let fitted = fit(&curve, range, tolerance, &any).expect("a spline");
                let most = (1.12 * fitted.by_theory).ceil() + 2.0;
                assert!(count(&fitted) <= most, "{a} {b} {tolerance:e} {range:?}: {} {}", count(&fitted), most);
                assert!(fitted.deviation <= tolerance);
                let ([distance, heading, curvature], _) = scanned(&curve, range, &fitted, &any);
                let rounding = 1e-12;
                assert!(distance <= fitted.deviation + rounding && fitted.deviation <= 1.03 * distance + rounding);
                assert!(heading <= fitted.heading + rounding && fitted.heading <= 1.2 * heading + 1e-10);
                assert!(curvature <= fitted.curvature * (1.0 + 1e-9) + 1e-10, "{curvature} {fitted:?}");
                assert!(fitted.curvature <= 1.3 * curvature + 1e-10, "{curvature} {}", fitted.curvature);
            }
        }
    }
}

/// A hundredth of the tolerance of distance requires 100^¼ times as many spans, of heading 100^⅓, of curvature 10.
#[test]
fn orders_are_four_three_and_two() {
    let curve = ellipse(60.0, 30.0);
    let range = (0.2, 1.9);
    let spans = |tolerance: f64, heading: f64, curvature: f64| {
        let allowed = move |_: f64, _: &CurvePoint| ChainTolerance::symmetric(heading, curvature);
        let fitted = fit(&curve, range, tolerance, &allowed).expect("a spline");
        assert!(fitted.deviation <= tolerance && fitted.heading <= heading && fitted.curvature <= curvature);
        let (_, share) = scanned(&curve, range, &fitted, &allowed);
        assert!(share <= 1.0, "{share}");
        count(&fitted)
    };
    let none = f64::INFINITY;
    for (fine, coarse, order) in [
        (spans(1e-7, none, none), spans(1e-5, none, none), 4.0),
        (spans(1.0, 1e-6, none), spans(1.0, 1e-4, none), 3.0),
        (spans(1.0, none, 1e-6), spans(1.0, none, 1e-4), 2.0),
    ] {
        let found = libm::log(100.0) / libm::log(fine / coarse);
        assert!((found - order).abs() < 0.12 * order, "{fine} {coarse}: {found} instead of {order}");
    }
}

/// Each place has a tolerance of its own: a share of the curvature there.
#[test]
fn local_tolerances_are_kept() {
    for (a, b) in [(60.0, 40.0), (60.0, 2.0)] {
        let curve = ellipse(a, b);
        for part in [0.1, 0.01, 0.001] {
            let allowed = |_: f64, point: &CurvePoint| ChainTolerance::symmetric(0.01, part * point.curvature);
            let fitted = fit(&curve, (-1.4, 1.4), 0.005, &allowed).expect("a spline");
            let (_, share) = scanned(&curve, (-1.4, 1.4), &fitted, &allowed);
            assert!(share <= 1.0, "{a} {b} {part}: {share}");
            assert!(count(&fitted) <= (1.2 * fitted.by_theory).ceil() + 3.0, "{} {}", count(&fitted), fitted.by_theory);
        }
    }
}

#[test]
fn ends_and_their_tangents_are_kept() {
    let curve = ellipse(60.0, 40.0);
    let fitted = fit(&curve, (0.2, 2.9), 1e-3, &any).expect("a spline");
    let (start, end, pieces) = (curve(0.2), curve(2.9), fitted.spline.pieces());
    let (first, last) = (pieces[0], pieces[pieces.len() - 1]);
    assert_eq!((first[0], last[3]), (start.point, end.point));
    let (leaves, arrives) = ((first[1] - first[0]).normalize(), (last[3] - last[2]).normalize());
    assert!((leaves - start.tangent).norm() < 1e-12 && (arrives - end.tangent).norm() < 1e-12);
}

#[test]
fn a_line_is_one_span_and_a_narrow_bump_is_seen() {
    let line = |t: f64| {
        let zero = Vector2::zeros();
        CurvePoint::from_derivatives(Vector2::new(t, 0.5 * t), Vector2::new(1.0, 0.5), zero, zero)
    };
    let straight = fit(line, (0.0, 9.0), 1e-6, &any).expect("a spline");
    assert!(straight.spline.spans() == 1 && straight.deviation < 1e-13, "{straight:?}");
    for place in [0.4, 1.0, 1.237] {
        let curve = bumped(0.05, 0.01, place);
        let fitted = fit(&curve, (0.0, 2.0), 0.005, &any).expect("a spline");
        let ([distance, ..], _) = scanned(&curve, (0.0, 2.0), &fitted, &any);
        assert!(distance <= fitted.deviation + 1e-12, "{distance} {}", fitted.deviation);
        assert!(count(&fitted) <= (1.25 * fitted.by_theory).ceil() + 3.0, "{} {}", count(&fitted), fitted.by_theory);
    }
}

#[test]
fn what_cannot_be_is_refused() {
    let curve = ellipse(60.0, 40.0);
    assert_eq!(fit(&curve, (0.0, 1.0), 1e-15, &any), Err(FitError::ToleranceTooFine { tolerance: 1e-15 }));
    let broken = |t: f64| CurvePoint { curvature: f64::NAN, ..curve(t) };
    assert!(matches!(fit(broken, (0.0, 1.0), 1e-3, &any), Err(FitError::NotSmooth { .. })));
    let none = |_: f64, _: &CurvePoint| ChainTolerance::symmetric(0.0, 0.0);
    assert!(fit(&curve, (0.0, 1.0), 1e-3, &none).is_err());
}

//! Where a value is highest between samples, in closed form.

use super::worst::{bound_at_jump, bound_by_cubic, top_of};
use super::*;

const GAP: fn(&RollSample) -> (f64, f64) = |s| (s.gap, s.gap_slope);

fn sample(parameter: f64, (gap, gap_slope): (f64, f64), residual: f64) -> RollSample {
    let (foot, centre) = (Vector2::new(parameter, 0.0), Vector2::new(parameter, 1.0));
    RollSample {
        piece: 0,
        parameter,
        gap,
        gap_slope,
        lift_error: None,
        lift_slope: f64::NAN,
        residual,
        foot,
        centre,
        edge: 0,
        alone: false,
        difference: f64::NAN,
        double: false,
    }
}

fn near(found: (f64, f64), expected: (f64, f64)) -> bool {
    (found.0 - expected.0).abs() < 1e-12 && (found.1 - expected.1).abs() < 1e-12
}

#[test]
fn a_parabola_has_its_own_top() {
    let of = |r: fn(f64) -> f64| [0.0, 0.2, 0.5].map(|at| sample(at, (0.0, 0.0), r(at)));
    assert!(near(top_of(&of(|x| 7.0 - 3.0 * (x - 0.3) * (x - 0.3))), (0.3, 7.0)));
    // A parabola that is open above, and one whose top lies outside, give the middle.
    assert_eq!(top_of(&of(|x| (x - 0.3) * (x - 0.3))).0, 0.2);
    assert_eq!(top_of(&of(|x| -(x - 0.9) * (x - 0.9))).0, 0.2);
}

/// 27/4 t (1 − t)² is 1 at t = 1/3, and mirrored at 2/3, with 0 at both ends; a quarter more is promised.
#[test]
fn a_cubic_promises_its_top() {
    for sign in [1.0, -1.0] {
        let slope = sign * 6.75 / 0.6;
        let of = |at, slope| sample(at, (0.0, slope), 0.0);
        let promise = |rise, fall| bound_by_cubic((&of(2.0, rise), &of(2.6, fall)), &GAP);
        assert!(promise(slope, 0.0).is_some_and(|(top, at)| near((top, at), (1.25, 2.2))));
        assert!(promise(0.0, -slope).is_some_and(|(top, at)| near((top, at), (1.25, 2.4))));
    }
}

#[test]
fn where_the_foot_jumps_the_tangents_cross() {
    for sign in [1.0, -1.0] {
        let (a, b) = (sample(3.0, (sign, 2.0 * sign), 0.0), sample(4.0, (1.5 * sign, -sign), 0.0));
        assert_eq!(bound_at_jump((&a, &b), &GAP), None);
        let far = RollSample { foot: b.foot + Vector2::new(9.0, 0.0), ..b };
        // 1 + 2 x and 2.5 − x are 2 at x = 0.5.
        assert!(bound_at_jump((&a, &far), &GAP).is_some_and(|found| near(found, (2.0, 3.5))));
    }
}
